"""Pictures of curvature regions: exact borders, signs and words, scales, roll axes."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from matplotlib.collections import PolyCollection
from matplotlib.colors import rgb_to_hsv, to_rgb
from matplotlib.figure import Figure

import assoc_hull as ah
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.plates.colour_legend import CURVATURE, STRAIN, shades
from assoc_hull.plot.plates.curvature_map import curvature_figure
from assoc_hull.plot.plates.paint_tiles import SIGNS, TINTS
from assoc_hull.plot.sheet.paper import PAPERS
from assoc_hull.surface.plating.plate_table import PlateTable
from assoc_hull.surface.regions.result import RegionResult
from tests.curved_patches import patch

Boxes = Callable[[Figure], dict[str, FloatArray]]
Lines = Callable[[Figure, str], list[FloatArray]]


def bezier(name: str) -> ah.surface.SplineSurface:
    """A reference patch as a surface."""
    return ah.surface.SplineSurface.bezier(patch(name), name)


@pytest.fixture(scope="module")
def wavy() -> RegionResult:
    """A plate with all three regions and two loops."""
    return ah.surface.curvature_regions(bezier("P08_wavy_plate"))


@pytest.fixture(scope="module")
def picture(wavy: RegionResult) -> Figure:
    """It, in plan and in space."""
    return curvature_figure(wavy)


@pytest.fixture(scope="module")
def shell() -> PlateTable:
    """A saddle with a slanting roll axis, a flat plate, a cylinder turned in space."""
    return ah.surface.plates([bezier(name) for name in ("P11_hypar", "P13_plane", "P15_cyl_rot")])


def tiles(figure: Figure, name: str) -> tuple[FloatArray, FloatArray]:
    """Corners of tiles (k, 4, 2), mm, and their colours (k, 3), of the collections with this id."""
    corner, colour = [], []
    for each in figure.axes[0].collections:
        if isinstance(each, PolyCollection) and each.get_gid() == name:
            corner += [np.asarray(path.vertices, np.float64)[:4] for path in each.get_paths()]
            colour += np.asarray(each.get_facecolor(), np.float64)[:, :3].tolist()
    return np.array(corner), np.array(colour)


def turned(corner: FloatArray) -> FloatArray:
    """Areas of tiles (k, 4, 2), above 0 if they go round anticlockwise."""
    first, second = corner[:, 2] - corner[:, 0], corner[:, 3] - corner[:, 1]
    return np.asarray(0.5 * (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]))


def words(figure: Figure, begin: str) -> list[str]:
    """Words whose ids begin like this."""
    return [text.get_text() for text in figure.axes[0].texts
            if str(text.get_gid()).startswith(begin)]  # fmt: skip


def test_regions_have_their_colours_and_sizes(wavy: RegionResult, picture: Figure) -> None:
    """Red, green and blue; in plan about as large as the surface, by its slope smaller."""
    corner, colour = tiles(picture, "P08_wavy_plate/plan/tiles")
    assert any("1:35" in each for each in words(picture, "label/bar"))
    own = {sign: np.isclose(colour, to_rgb(tint)).all(axis=1) for sign, tint in TINTS.items()}
    assert np.logical_or.reduce(list(own.values())).all()
    size = np.abs(turned(corner)) * (35.0 / 1e3) ** 2
    # The ground of all the plate is green.
    for sign, area in ((1, wavy.positive), (-1, wavy.negative), (0, wavy.total)):
        assert size[own[sign]].sum() == pytest.approx(area, rel=0.03)


def test_colour_alone_does_not_carry_the_regions(picture: Figure) -> None:
    """Signs stand on each region, in both views; tints differ in lightness by a tenth."""
    for view in ("plan", "space"):
        for sign, letter in SIGNS.items():
            found = words(picture, f"P08_wavy_plate/{view}/sign/{sign}")
            assert found
            assert set(found) == {letter}
    light = sorted(float(np.dot(to_rgb(tint), (0.2126, 0.7152, 0.0722))) for tint in TINTS.values())
    assert min(np.diff(light)) > 0.1
    hue = {sign: float(rgb_to_hsv(to_rgb(tint))[0]) for sign, tint in TINTS.items()}
    assert (hue[1] < 0.05, 0.2 < hue[0] < 0.4, 0.5 < hue[-1] < 0.7) == (True, True, True)


def test_signs_stand_in_their_regions(wavy: RegionResult, picture: Figure, boxes_of: Boxes) -> None:
    """No line or edge runs through one: a border is 1 mm from its middle at least."""
    edges = [line.get_xydata() for line in picture.axes[0].lines
             if re.search("plan/(line|edge)", str(line.get_gid()))]  # fmt: skip
    places = np.concatenate([np.asarray(each) for each in edges])
    for name, box in boxes_of(picture).items():
        if "/plan/sign/" in name:
            middle = 0.5 * (box[:2] + box[2:])
            assert np.hypot(*(places - middle).T).min() > 1.0


def test_signs_are_those_of_the_colour_they_stand_on(picture: Figure, boxes_of: Boxes) -> None:
    """The tile that was painted last below each has the tint of the sign."""
    corner, colour = tiles(picture, "P08_wavy_plate/plan/tiles")
    edge = np.roll(corner, -1, axis=1) - corner
    looked = 0
    for name, box in boxes_of(picture).items():
        if "/plan/sign/" in name:
            off = 0.5 * (box[:2] + box[2:]) - corner
            turn = edge[..., 0] * off[..., 1] - edge[..., 1] * off[..., 0]
            top = np.flatnonzero((turn >= 0.0).all(axis=1))[-1]
            sign = int(name.split("/sign/")[1].split()[0])
            assert colour[top] == pytest.approx(to_rgb(TINTS[sign]))
            looked += 1
    assert looked >= 5


def test_borders_are_the_lines_that_were_found(
    wavy: RegionResult, picture: Figure, lines_of: Lines
) -> None:
    """Each polyline stands there whole, to scale, in plan as in space."""
    for view in ("plan", "space"):
        for piece in wavy.components:
            (drawn,) = lines_of(picture, f"P08_wavy_plate/{view}/line/{piece.level:g}")
            assert len(drawn) == sum(map(len, piece.xyz))
    (drawn,) = lines_of(picture, f"P08_wavy_plate/plan/line/{wavy.k0:g}")
    (place,) = (piece.xyz[0] for piece in wavy.components if piece.level > 0.0)
    apart = np.linalg.norm(place[1:] - place[0], axis=1)
    assert (np.linalg.norm(drawn[1:] - drawn[0], axis=1) * 0.035 <= apart + 1e-9).all()


def test_block_and_legend_tell_areas_and_band(wavy: RegionResult, picture: Figure) -> None:
    """What stands there are the numbers of the result."""
    found = words(picture, "label/legend/area")
    expected = (wavy.positive, wavy.zero, wavy.negative, wavy.unresolved)
    assert found == [f"{area:.4f} m²" for area in expected]
    block = " ".join(words(picture, "label/block"))
    for each in ("0.00128 1/m²", "ε 0.001, b 2.5 m", "2 closed", f"{wavy.total:.4f} m²"):
        assert each in block


@pytest.mark.parametrize("name", ["several", "tiny"])
def test_all_lies_on_the_sheet(shell: PlateTable, boxes_of: Boxes, name: str) -> None:
    """Words, lines and tiles of several plates, and of one that needs no scale bar."""
    found = shell if name == "several" else ah.surface.curvature_regions(1e-3 * patch("P12_bowl"))
    figure = curvature_figure(found, paper="A1")
    size = PAPERS["A1"]
    for line in figure.axes[0].lines:
        places = np.asarray(line.get_xydata())
        assert np.nanmin(places) > 0.0
        assert (np.nanmax(places, axis=0) < (size.width, size.height)).all()
    for box in boxes_of(figure).values():
        assert (box[:2] > 0.0).all()
        assert (box[2:] < (size.width, size.height)).all()
    for each in figure.axes[0].collections:
        for path in each.get_paths():
            corner = np.asarray(path.vertices)
            assert (corner > 0.0).all()
            assert (corner < (size.width, size.height)).all()


def test_plates_have_their_class_and_roll_axis(shell: PlateTable, lines_of: Lines) -> None:
    """The axis stands at its angle, clockwise from the long side; a flat plate has none."""
    figure = curvature_figure(shell, views=["plan"])
    below = " ".join(words(figure, "label/shares"))
    for plate in shell:
        assert str(plate.kind) in below
        drawn = lines_of(figure, f"{plate.name}/plan/axis")
        if plate.roll_axis is None:
            assert drawn == []
            continue
        (ends,) = drawn
        across, up = ends[1] - ends[0]
        angle = np.degrees(np.arctan2(-up, across)) % 180.0
        off = abs(angle - plate.roll_axis) % 180.0
        assert min(off, 180.0 - off) < 1e-6


def test_plates_may_have_a_band_each(lines_of: Lines) -> None:
    """The block tells the least and the largest K0; each plate has the lines of its own."""
    found = ah.surface.plates([bezier("P08_wavy_plate"), bezier("P12_bowl")], breadth=None)
    figure = curvature_figure(found, views=["plan"])
    k0 = [plate.k0 for plate in found]
    assert f"{min(k0):.3g} to {max(k0):.3g} 1/m²" in words(figure, "label/block")
    assert len(lines_of(figure, f"P08_wavy_plate/plan/line/{k0[0]:g}")) == 1


def test_a_picture_in_plan_sees_the_side_of_the_normal() -> None:
    """Seen from there a net runs anticlockwise from u to v; from behind it is mirrored."""
    net = patch("P12_bowl")
    for each in (net, net[:, ::-1], net[::-1, ::-1]):
        figure = curvature_figure(ah.surface.curvature_regions(each), views=["plan"])
        corner, _ = tiles(figure, "/plan/tiles")
        assert (turned(corner) > 0.0).all()


def test_a_continuous_map_is_symmetric_and_names_its_lines() -> None:
    """The bar reaches equally far on both sides; further levels bear their curvature."""
    found = ah.surface.curvature_regions(bezier("P20_five_arcs"), levels=(-0.01,))
    figure = curvature_figure(found, views=["parameters"], quantity="curvature")
    corner, colour = tiles(figure, "P20_five_arcs/parameters/tiles")
    low, high = corner.min(axis=(0, 1)), corner.max(axis=(0, 1))
    share = (corner.mean(axis=1) - low) / (high - low)
    for place, red in (((0.1, 0.7), True), ((0.6, 0.2), False)):  # convex, and saddle
        near = np.abs(share - place).sum(axis=1).argmin()
        assert bool(colour[near, 0] > colour[near, 2]) == red
    marks = words(figure, "label/bar")
    assert {"0", "K0", "−K0"} <= set(marks)
    high = next(mark for mark in marks if f"−{mark}" in marks and mark != "K0")
    assert float(high) == pytest.approx(0.09, rel=0.9)
    assert "K = −0.01" in words(figure, "label/P20_five_arcs/parameters/level")
    for palette in (CURVATURE, STRAIN):
        assert not np.allclose(shades(np.array(-0.5), palette), shades(np.array(0.5), palette))


def test_spots_that_are_unresolved_are_marked(lines_of: Lines) -> None:
    """A point contact has a ring; along a double line cells are black, and no ring stands."""
    point = ah.surface.curvature_regions(bezier("P02_monkey"), zero="exact", delta=0.0)
    figure = curvature_figure(point, views=["plan"])
    assert len(lines_of(figure, "P02_monkey/plan/ring")) == 1
    double = ah.surface.curvature_regions(
        bezier("P07_double_cross"), zero="exact", depth=7, delta=0.0
    )
    figure = curvature_figure(double, views=["plan"])
    assert lines_of(figure, "P07_double_cross/plan/ring") == []
    marked = [each for each in figure.axes[0].collections
              if each.get_gid() == "P07_double_cross/plan/unresolved"]  # fmt: skip
    assert sum(len(each.get_paths()) for each in marked) > 100


def test_what_is_hidden_is_not_drawn(lines_of: Lines) -> None:
    """The far edges of a steep trough pass behind its near wall; a saddle hides nothing."""
    x, y = np.mgrid[-1:1:3j, -1:1:4j]
    trough = np.stack([x, 0.2 * y, np.where(np.abs(y) == 1.0, 3.0, -1.0)], axis=-1)
    for net, hides in ((trough, True), (patch("P11_hypar"), False)):
        figure = curvature_figure(ah.surface.curvature_regions(net), views=["space"])
        edges = np.concatenate(lines_of(figure, "/space/edge"))
        assert np.isnan(edges).any() == hides


def test_bad_arguments_and_files(wavy: RegionResult, tmp_path: Path) -> None:
    """Unknown words are refused by name; a file is told by its ending."""
    curvature_figure(wavy, tmp_path / "map.svg", views=["plan"])
    assert (tmp_path / "map.svg").stat().st_size > 1000
    for more, told in (
        ({"views": ["plan", "plan"]}, "each once"), ({"views": []}, "none"),
        ({"views": ["top"]}, "'top'"), ({"views": "plan"}, "views"), ({"title": ""}, "title"),
        ({"quantity": "mean"}, "'mean'"), ({"paper": "A5"}, "A5"),
    ):  # fmt: skip
        with pytest.raises(BadInputError, match=told):
            curvature_figure(wavy, **more)
    with pytest.raises(BadInputError, match="RegionResult"):
        curvature_figure([wavy])  # type: ignore[arg-type]
