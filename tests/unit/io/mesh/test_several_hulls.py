"""Two hulls side by side are refused, told what to give, and read so; no others are refused."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.geometry.surfaces.triangles import Triangles
from assoc_hull.io.digitised.read import read_lines
from assoc_hull.io.lines.several_hulls import HullChoice
from assoc_hull.io.lines.slices import HullSlices
from assoc_hull.io.placing.options import FrameOptions
from assoc_hull.io.slicing.mesh_lines import refuse_bottomless, slice_mesh
from tests import meshes, several_hulls
from tests.foreign_hulls import write_lines
from tests.twin_skeg import twin_skeg_ship

CUTS: dict[str, Any] = {"stations": [30.0, 50.0, 75.0], "waterlines": [2.0, 4.0], "buttocks": [2.0]}


def cut(mesh: Triangles, **options: Any) -> HullSlices:
    """The lines of a mesh, with a choice of hull."""
    choice = {key: options.pop(key) for key in ("centre", "depth", "draught") if key in options}
    return slice_mesh(mesh, choice=HullChoice(**choice), **(CUTS | options))


def check_wigley(slices: HullSlices) -> None:
    """All lines lie on the formula within what the facets of the mesh allow, 10 mm."""
    for line in slices.lines:
        for piece in line.pieces:
            x, y, z = piece.points.T
            assert np.abs(y - meshes.wigley_y(x, z)).max() <= 0.01


def refusal(mesh: Triangles, **options: Any) -> str:
    """The words with which a mesh is refused."""
    with pytest.raises(BadInputError) as found:
        cut(mesh, **options)
    return str(found.value)


def test_the_remedy_for_two_hulls_leads_to_one() -> None:
    """The centre plane that is proposed is followed to the letter, to port and to starboard."""
    both = several_hulls.catamaran(deck=False)
    words = refusal(both)
    assert "there are two hulls side by side" in words
    given = re.search(r"centre=([-0-9.]+)$", words)
    assert given is not None
    assert float(given[1]) == several_hulls.OFF
    for side in (1.0, -1.0):
        slices = cut(both, centre=side * float(given[1]))
        check_wigley(slices)
        assert slices.report.kinds("suspicions") == ()
        assert "one hull" in slices.report.kinds("assumptions")


def test_a_bridge_deck_is_cut_off_where_it_begins_and_told() -> None:
    """The remedy names depth too; without depth that height is taken, and told."""
    ship = several_hulls.catamaran(deck=True)
    words = refusal(ship)
    assert f"centre=8 and depth={several_hulls.ROOF:g}, below the bridge deck" in words
    for depth in (several_hulls.ROOF, None):
        slices = cut(ship, centre=8.0, depth=depth)
        check_wigley(slices)
        assert slices.high[2] == pytest.approx(several_hulls.ROOF, abs=1e-12)
        assert "bridge deck" in slices.report.kinds("repairs")
        assert ("depth" in slices.report.kinds("assumptions")) == (depth is None)


def test_a_bridge_deck_below_the_depth_is_named_with_its_height() -> None:
    """The remedy of that refusal works as well."""
    ship = several_hulls.catamaran(deck=True)
    assert "the bridge deck hangs down to 5.5 m, and depth is 6 m" in refusal(
        ship, centre=8.0, depth=6.0
    )


def test_a_low_bridge_deck_hides_no_catamaran() -> None:
    """Below half the depth its deck joins the hulls; lower down there are two."""
    one = meshes.closed_wigley()
    ship = several_hulls.joined(
        [several_hulls.catamaran(deck=False, demihull=one), several_hulls.bridge(8.0, 2.5)]
    )
    assert "there are two hulls" in refusal(ship)


@pytest.mark.parametrize(
    ("change", "centre"),
    [
        pytest.param(lambda xyz: 1e3 * xyz + [0.0, 2e3, 0.0], 10_000.0, id="in mm, off y = 0"),
        pytest.param(lambda xyz: 1e3 * xyz + [0.0, 2e3, 0.0], "10 m", id="in mm, given in m"),
        pytest.param(lambda xyz: xyz[:, [1, 0, 2]] * [1, -1, 1], 8.0, id="length along y"),
        pytest.param(lambda xyz: xyz[:, [0, 2, 1]] * [1, 1, -1], -8.0, id="on its side"),
        pytest.param(lambda xyz: xyz * [1, -1, -1] + [0, 0, 9], -8.0, id="keel up"),
        pytest.param(lambda xyz: xyz * [-1, -1, 1], -8.0, id="the bow at negative x"),
    ],
)
def test_the_centre_is_a_place_in_the_file(change: Any, centre: float | str) -> None:
    """Whatever its unit and axes are: of the hull that was at y = 8 m."""
    ship = several_hulls.joined(
        [several_hulls.shifted(meshes.closed_wigley(), 0.0, 8.0, 0.0),
         several_hulls.shifted(meshes.closed_wigley(41, 21), 0.0, -8.0, 0.0)]
    )  # fmt: skip
    slices = cut(meshes.moved(ship, change), centre=centre, frame=FrameOptions(length=meshes.L))
    check_wigley(slices)


def test_a_demihull_that_is_not_symmetric_is_refused_with_its_largest_difference() -> None:
    """Its inner side has 60 % of the outer's half-breadth, 5 m at the deck amidships."""
    ship = several_hulls.catamaran(deck=False, demihull=several_hulls.one_sided())
    words = refusal(ship, centre=8.0)
    assert "asymmetric demihulls are not taken" in words
    much = re.search(r"by up to ([0-9.]+) m \(at x = ([0-9.]+) m", words)
    assert much is not None
    assert float(much[1]) == pytest.approx(0.4 * 5.0, rel=2e-3)
    assert float(much[2]) == pytest.approx(50.0, abs=2.0)


def test_a_wrong_centre_is_answered_with_the_right_one() -> None:
    """Of a demihull, of the gap between both, and of a ship of one hull that lies off y = 0."""
    both = several_hulls.catamaran(deck=False)
    for centre in (7.0, 8.5):
        assert "give centre=8" in refusal(both, centre=centre)
    assert re.search("give centre=-?8", refusal(both, centre=0.0))
    beside = several_hulls.shifted(meshes.closed_wigley(), 0.0, 3.0, 0.0)
    assert "give centre=3" in refusal(beside, centre=2.0)
    check_wigley(cut(beside, centre=3.0))
    check_wigley(cut(beside))


def test_three_hulls_are_counted() -> None:
    """Two short ones beside a long one; any of them can be read by its centre plane."""
    assert "there are three hulls side by side" in refusal(several_hulls.trimaran())
    check_wigley(cut(several_hulls.trimaran(), centre=0.0))
    small = cut(
        several_hulls.trimaran(), centre=12.0, stations=[30.0], waterlines=[2.0], buttocks=1
    )
    assert float(small.high[1]) == pytest.approx(1.5, abs=1e-3)


@pytest.mark.parametrize(
    "mesh",
    [
        pytest.param(several_hulls.grooved(40.0), id="a tunnel over 40 % of the length"),
        pytest.param(several_hulls.with_thruster(), id="a bow thruster"),
        pytest.param(meshes.mirrored(meshes.wigley_half()), id="an open deck"),
        pytest.param(meshes.wigley_half(), id="a half hull"),
        pytest.param(
            several_hulls.shifted(meshes.closed_wigley(), 0.0, 8.0, 0.0), id="one demihull alone"
        ),
    ],
)
def test_what_parts_a_bottom_over_less_than_half_of_the_length_is_no_catamaran(
    mesh: Triangles,
) -> None:
    """Each is cut as the one hull that it is."""
    assert set(cut(mesh).report.kinds("repairs")) <= {"centre plane", "weld"}


def test_half_a_hull_with_a_hole_and_one_without_a_bottom_are_told_apart_by_words() -> None:
    """A hole in the side is suspected with its place; a bottom that is missing is refused."""
    half = meshes.wigley_half()
    middle = half.corners.mean(axis=1)
    near = (np.abs(middle[:, 0] - 50.0) < 5.0) & (np.abs(middle[:, 2] - 3.0) < 0.5)
    holed = cut(half.part(~near))
    assert "hole" in holed.report.kinds()
    assert "bottom missing" not in holed.report.kinds()
    refuse_bottomless(holed)
    bottomless = cut(meshes.mirrored(half.part(middle[:, 2] > 1.5)))
    with pytest.raises(BadInputError, match="the bottom is missing"):
        refuse_bottomless(bottomless)


@pytest.mark.parametrize("deck", [True, False], ids=["closed", "open deck"])
def test_axes_that_lay_a_hull_on_its_side_are_refused(deck: bool) -> None:
    """Left out, as the message says, they are found."""
    mesh = meshes.closed_wigley() if deck else meshes.mirrored(meshes.wigley_half())
    lying = meshes.moved(mesh, lambda xyz: xyz[:, [0, 2, 1]] + [0.0, 1.0, 0.0])
    assert "the hull lies on its side: it mirrors along z, not along y" in refusal(
        lying, axes="+x+y+z"
    )
    check_wigley(cut(lying, frame=FrameOptions(length=meshes.L)))


@pytest.mark.parametrize("centre", ["here", "4 miles", "nan", float("nan"), True, "1 2 m", ""])
def test_a_centre_that_is_none_is_refused(centre: Any) -> None:
    """By its name, with the form that it has."""
    with pytest.raises(AssocHullError, match="centre"):
        cut(several_hulls.catamaran(deck=False), centre=centre)


def test_a_catamaran_is_read_by_its_remedy_and_floats_as_a_ship(tmp_path: Path) -> None:
    """From the file to the ship's numbers: V within .05 % of the demihull's twice, KM_T by hand."""
    path = meshes.write(several_hulls.catamaran(deck=True), tmp_path / "cat.stl")
    with pytest.raises(BadInputError, match="two hulls side by side"):
        ah.read(path, draught=4.0)
    hull = ah.read(path, draught=4.0, centre=8.0, depth=5.5, stations=21, waterlines=6, buttocks=2)
    truth = ah.examples.wigley().hydrostatics(draught=4.0)
    ship = hull.hydrostatics(demihulls=2, separation=16.0)
    assert ship.volume == pytest.approx(2.0 * truth.volume, rel=5e-4)
    inertia = 2.0 * (truth.i_t + 8.0**2 * truth.waterplane_area)
    assert ship.kmt == pytest.approx(truth.kb + inertia / (2.0 * truth.volume), rel=1e-3)
    assert hull.adoption is not None
    assert any("of 2 hulls side by side" in note for note in hull.adoption.notes)


def test_a_surface_that_crosses_itself_is_told_as_that_with_a_place() -> None:
    """Its folds look like hulls side by side, and no centre plane would help."""
    hull = meshes.wigley_half(81, 31)
    x, y, z = hull.xyz.T
    near = (np.abs(z - 3.0) < 1.0) * y
    folded = np.column_stack(
        [
            x, y + 0.3 * near * np.sin(2.0 * np.pi * z + 1.0),
            z + 0.7 * near * np.sin(np.pi * (z - 3.0)),
        ]
    )  # fmt: skip
    words = refusal(Triangles(folded, hull.face))
    assert "the surface crosses itself" in words
    assert "side by side" not in words
    at = [float(each) for each in re.findall(r"[xyz] = ([-0-9.]+)", words)]
    # The place lies on the fold, which is 1 m high about z = 3.
    assert 0.0 < at[0] < 100.0
    assert abs(at[2] - 3.0) < 2.0


def test_a_ship_with_twin_skegs_is_no_catamaran(tmp_path: Path) -> None:
    """Her contours part aft only: as a mesh and as lines she is cut as the one hull that she is."""
    ship = twin_skeg_ship()
    mesh = ship.mesh(points=4)
    slices = cut(Triangles(mesh.xyz, mesh.triangle), stations=[20.0, 150.0], waterlines=[10.0])
    assert "one hull" not in slices.report.kinds("assumptions")
    # Both sides of her are one hull: the section of the middle body reaches from keel to side.
    middle = slices.group("sections")[-1].pieces[0].points
    assert float(middle[0, 1]) == pytest.approx(0.0, abs=1e-6)
    assert float(middle[:, 1].max()) == pytest.approx(0.5 * ship.particulars.breadth, rel=0.01)
    lines = read_lines(write_lines(ship, tmp_path / "twin.csv"))
    assert "one hull" not in lines.report.kinds("assumptions")
