"""The public function: what it takes and refuses, lines of further levels, notes, failures."""

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.errors import AssocHullError, BadInputError, DanglingArcError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.cells import SignCells, ZeroSetArcs
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.patches.zero_set_arcs import arcs_of
from assoc_hull.surface.regions import curvature_regions as solving
from tests.curved_patches import patch, random_nets
from tests.long_forms import draws

REPOSITORY = Path(__file__).resolve().parents[3]


def strip(points: Any) -> FloatArray:
    """A bilinear patch of four points."""
    return np.array(points, np.float64).reshape(2, 2, 3)


def test_a_result_says_what_was_asked_for() -> None:
    """Mode, K0, strain, breadth, delta and tolerances stand in the result."""
    result = ah.surface.curvature_regions(
        patch("P08_wavy_plate"), strain_tol=2e-3, breadth=2.0, area_tol=1e-5, depth=12,
        chord_tol=0.01, delta=1e-9,
    )  # fmt: skip
    assert (result.zero_mode, result.strain_tol, result.breadth) == ("strain", 2e-3, 2.0)
    assert result.k0 == pytest.approx(4e-3, rel=1e-15)
    assert (result.delta, result.depth, result.area_tol, result.chord_tol) == (1e-9, 12, 1e-5, 0.01)
    assert "K0 = 0.004 1/m2 (strain 0.002 over 2 m)" in str(result)
    assert len(str(result).splitlines()) == 1


def test_delta_is_that_of_each_patch_without_a_band() -> None:
    """1e-9 of the diagonal of the patch's own box, so that it does not depend on others."""
    net = strip([[0, 0, 0], [0, 4, 0], [3, 0, 0], [3, 4, 1]])
    surfaces = [SplineSurface.bezier(each) for each in (net, 2.0 * net, patch("P08_wavy_plate"))]
    result = ah.surface.curvature_regions(surfaces, zero="exact")
    small, other = (part.delta.tolist() for part in result.parts)
    assert small == pytest.approx([1e-9 * 26**0.5, 2e-9 * 26**0.5], rel=1e-12)
    assert result.delta == max(small + other)


def test_areas_of_one_surface_and_of_all() -> None:
    """The sum of the surfaces is the result; a number that is none is refused."""
    surfaces = [SplineSurface.bezier(patch(name)) for name in ("P11_hypar", "P12_bowl")]
    result = ah.surface.curvature_regions(surfaces)
    hypar, bowl = result.of_surface(0), result.of_surface(1)
    assert (hypar.negative_share, bowl.positive_share) == pytest.approx((1.0, 1.0), rel=1e-6)
    assert result.total == hypar.total + bowl.total
    with pytest.raises(BadInputError, match="number is 2"):
        result.of_surface(2)


def test_lines_of_further_levels() -> None:
    """Lines of other curvatures are given beside; areas are those without them."""
    net = patch("P20_five_arcs")
    plain = ah.surface.curvature_regions(net, zero="exact", delta=0.0)
    result = ah.surface.curvature_regions(net, zero="exact", delta=0.0, levels=[1e-3, -1e-2, 0.0])
    assert result.areas == plain.areas
    assert list(dict.fromkeys(piece.level for piece in result.components)) == [0.0, 1e-3, -1e-2]
    own = [piece for piece in result.components if piece.level == 0.0]
    assert len(own) == len(plain.components) == 5
    band = ah.surface.curvature_regions(net, zero="absolute", k0=1e-3)
    lines = [[piece.xyz[0].tolist() for piece in each.components if piece.level == 1e-3]
             for each in (band, result)]  # fmt: skip
    assert lines[0] == lines[1] != []


def test_polylines_keep_the_chord_tolerance() -> None:
    """Twice as many points in between lie no farther from the chords than was asked for."""
    net, tolerance = patch("P03_circle_loop"), 1e-3
    coarse = ah.surface.curvature_regions(net, zero="exact", chord_tol=tolerance).components[0]
    fine = ah.surface.curvature_regions(net, zero="exact", chord_tol=tolerance / 100).components[0]
    chords, places = coarse.xyz[0], fine.xyz[0]
    assert len(places) > 2 * len(chords)
    assert np.array_equal(chords[0], chords[-1])
    low, step = chords[:-1], np.diff(chords, axis=0)
    along = ((places[:, None] - low) * step).sum(-1) / (step**2).sum(-1)
    nearest = low + np.clip(along, 0.0, 1.0)[..., None] * step
    assert np.linalg.norm(places[:, None] - nearest, axis=-1).min(axis=1).max() <= tolerance
    radius = np.hypot(*(places[:, :2]).T)
    assert radius == pytest.approx(0.5, abs=1e-12)


@pytest.mark.parametrize(
    ("surfaces", "told"),
    [
        pytest.param([], "surfaces is empty", id="none"),
        pytest.param(None, "surfaces is None", id="nothing"),
        pytest.param("P08", "surfaces is 'P08'", id="text"),
        pytest.param([np.zeros((2, 2, 3))], "surfaces[0] is array", id="nets in a list"),
        pytest.param(np.zeros((4, 4)), "net", id="net without coordinates"),
        pytest.param(np.full((2, 2, 3), np.nan), "", id="points that are no numbers"),
        pytest.param(np.zeros((2, 2, 3)), "it measures 0 m, and has no area", id="point"),
        pytest.param(1e-100 * patch("P08_wavy_plate"), "it measures 6e-100 m", id="dust"),
        pytest.param(strip([[0, 0, 0], [1, 1, 1], [2, 2, 2], [5, 5, 5]]), "no area", id="line"),
        pytest.param(strip([[0, 0, 1e5], [1, 1, 1e5], [2, 2, 1e5], [5, 5, 1e5]]), "no area",
                     id="line far away"),
    ],
)  # fmt: skip
def test_what_is_no_surface_is_refused(surfaces: Any, told: str) -> None:
    """Each with an error of the family that says what is wrong and where."""
    with pytest.raises(AssocHullError) as caught:
        ah.surface.curvature_regions(surfaces)
    assert told in str(caught.value)


def test_a_thin_plate_is_no_line() -> None:
    """A tenth of a millimetre over ten metres is a plate; it has the area it has."""
    net = strip([[0, 0, 0], [0, 1e-4, 0], [10, 0, 0], [10, 1e-4, 0]])
    assert ah.surface.curvature_regions(net).zero == pytest.approx(1e-3, rel=1e-12)


def test_notes_tell_a_search_that_ended() -> None:
    """Which surface and patch, how much is left, and what may be done: sentences with numbers."""
    surface = SplineSurface.bezier(patch("P07_double_cross"), "saddle of the fourth order")
    notes = ah.surface.curvature_regions(surface, zero="exact", delta=0.0, budget=500).notes
    assert len(notes) == 2
    assert "In surface 'saddle of the fourth order' the" in notes[0]
    assert "budget of 500 cells in 1 patch (1)" in notes[0]
    assert "unresolved, more than area_tol (1e-06)" in notes[1]
    assert all(note[0].isupper() and note.endswith(".") for note in notes)


def test_notes_tell_spots_without_a_tangent_plane() -> None:
    """K has false zeros there: they are told apart, by their places, once for all levels."""
    net = random_nets(6, 1)[5]
    result = ah.surface.curvature_regions(net, zero="exact", delta=0.0, levels=(1.0,))
    singular = [piece for piece in result.components if piece.singular]
    assert [(piece.level, piece.kind) for piece in singular] == [(0, "junction"), (1, "junction")]
    ((x, y, z),) = singular[0].spots
    (note,) = result.notes
    assert f"no tangent plane at 1 spot (x {x:.3f}, y {y:.3f}, z {z:.3f} m)" in note
    ends = np.concatenate([line[[0, -1]] for line in singular[0].xyz])
    assert np.linalg.norm(ends - [x, y, z], axis=1).min() < 1e-3


def test_notes_tell_lines_that_end_at_knots() -> None:
    """At a double knot of a cubic the curvature jumps, and so do lines and regions."""
    place = np.moveaxis(np.mgrid[0:6, 0:4], 0, -1) * [1.0, 0.6]
    draw = np.random.default_rng(8).standard_normal((6, 4, 1))
    net = np.concatenate([place, 0.2 * draw], axis=-1)
    knots = np.array([0, 0, 0, 0, 1, 1, 2, 2, 2, 2]), np.repeat([0.0, 1.0], 4)
    result = ah.surface.curvature_regions(SplineSurface("bent", (3, 3), *knots, net), zero="exact")
    ends = [piece for piece in result.components if "knot-line" in piece.tags]
    assert ends
    assert any("at knots" in note and "surface 'bent'" in note for note in result.notes)


def test_notes_tell_borders_without_curvature() -> None:
    """K = 0 along the border of a plate is no line, and is told."""
    result = ah.surface.curvature_regions(patch("P18_inflect_edge"), zero="exact")
    assert [piece.kind for piece in result.components] == ["edge_line"]
    assert any("K = 0 1/m2 along 1 border of patches (1)" in note for note in result.notes)
    (line,) = result.components[0].uv
    assert np.array_equal(line[:, 0], np.zeros(len(line)))


@pytest.mark.parametrize("zero", ["strain", "exact"])
def test_a_pole_is_no_line(zero: str) -> None:
    """Where a side is drawn together in a point, no border and no line of the curvature is told."""
    result = ah.surface.curvature_regions(patch("P17_pole_sphere"), zero=zero)
    assert (result.components, result.notes, result.unresolved) == ((), (), 0.0)
    assert result.positive == pytest.approx(result.total, rel=1e-9)


@pytest.mark.parametrize("name", ["P14_cyl", "P18_inflect_edge"])
def test_coordinates_are_known_to_their_rounding(name: str) -> None:
    """With a delta of 0, what is nil but for the rounding of the net is nil."""
    result = ah.surface.curvature_regions(patch(name), zero="exact", delta=0.0)
    assert result.delta == 2.0**-52 * np.abs(patch(name)).max()
    assert (result.negative, {piece.kind for piece in result.components} - {"edge_line"}) == (
        0,
        set(),
    )


def test_a_line_that_breaks_off_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    """If an arc were lost, the result would be refused, not given with a gap."""

    def without_one(cells: SignCells) -> ZeroSetArcs:
        arcs = arcs_of(cells)
        return ZeroSetArcs(
            *(value[np.arange(len(arcs)) != 5] for value in attrs.astuple(arcs, recurse=False))
        )

    monkeypatch.setattr(solving, "arcs_of", without_one)
    with pytest.raises(DanglingArcError, match="break off"):
        ah.surface.curvature_regions(patch("P08_wavy_plate"), zero="exact")


def test_a_failure_leaves_the_earlier_result_as_it_was(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever fails within, what was found before can be used on."""
    net = patch("P08_wavy_plate")
    before = ah.surface.curvature_regions(net)
    areas, text = before.areas, str(before)

    def fails(*_: object) -> None:
        raise MemoryError

    with monkeypatch.context() as patched:
        patched.setattr(solving, "sign_areas", fails)
        with pytest.raises(MemoryError):
            ah.surface.curvature_regions(net * 1.01, previous=before)
    assert (before.areas, str(before)) == (areas, text)
    assert ah.surface.curvature_regions(net, previous=before).computed == 0


def test_what_is_found_is_frozen() -> None:
    """Arrays of a result cannot be written to."""
    result = ah.surface.curvature_regions(patch("P08_wavy_plate"))
    (part,), piece = result.parts, result.components[0]
    for array in (part.areas, part.delta, part.solutions[0].edges, piece.uv[0], piece.xyz[0]):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


@settings(max_examples=draws(10), deadline=None)
@given(
    m=st.integers(1, 3),
    n=st.integers(1, 3),
    seed=st.integers(0, 10**6),
    zero=st.sampled_from(["strain", "exact"]),
    scale=st.sampled_from([1e-3, 1.0, 1e3]),
)
def test_parts_are_the_whole_of_any_net(m: int, n: int, seed: int, zero: str, scale: float) -> None:
    """Four areas of 0 or more add up to the total; the same net gives the same bits again."""
    net = scale * np.random.default_rng(seed).standard_normal((m + 1, n + 1, 3))
    result = ah.surface.curvature_regions(net, zero=zero, area_tol=1e-4, depth=8)
    areas = result.areas
    parts = areas.positive, areas.negative, areas.zero, areas.unresolved
    assert min(parts) >= 0.0
    # The total is found by another rule: within ten times area_tol.
    assert sum(parts) == pytest.approx(areas.total, rel=1e-3)
    again = ah.surface.curvature_regions(net.copy(), zero=zero, area_tol=1e-4, depth=8)
    assert again.areas == areas
    assert [piece.xyz[0].tobytes() for piece in again.components] == [
        piece.xyz[0].tobytes() for piece in result.components
    ]


def test_no_order_of_hashes_is_seen() -> None:
    """Another process with other hashes finds the same, to the last digit."""
    script = (
        "import assoc_hull as ah\n"
        "from assoc_hull.geometry.patches.spline_surface import SplineSurface\n"
        "from tests.curved_patches import graph_plates\n"
        "many = [SplineSurface.bezier(n[: 3 + i % 2]) for i, n in enumerate(graph_plates(4, 3))]\n"
        "found = ah.surface.curvature_regions(many, levels=(0.0, 0.01))\n"
        "told = [(c.kind, c.surface, c.xyz[0].sum()) for c in found.components]\n"
        "text = repr(found.areas) + repr(told)\n"
    )
    here: dict[str, str] = {}
    exec(script, here)
    other = subprocess.run(
        [sys.executable, "-c", script + "print(text)"], capture_output=True, text=True,
        check=True, cwd=REPOSITORY, env={**os.environ, "PYTHONHASHSEED": "4711"},
    ).stdout  # fmt: skip
    assert other.strip() == here["text"]


def test_notes_tell_parts_that_count_as_nil() -> None:
    """Part of a patch that points off by delta could make developable is told, with its K."""
    net = patch("P07_double_cross")
    (note,) = (
        n for n in ah.surface.curvature_regions(net, zero="exact").notes if "count as K = 0" in n
    )
    assert "parts of patches, count as K = 0, since points that are off by delta" in note
    assert "1/m2 there: a smaller delta" in note
    notes = ah.surface.curvature_regions(net, zero="exact", delta=0.0).notes
    assert not any("count as K = 0" in each for each in notes)


@pytest.mark.parametrize("seed", [2, 9, 13])
def test_regions_do_not_know_where_a_plate_lies(seed: int) -> None:
    """Turned and moved 100 m, with points known to the usual delta: areas and lines stay."""
    rng = np.random.default_rng(seed)
    knots = np.array([0.0, 0, 0, 0, 1, 2, 3, 3, 3, 3])
    x, y = np.meshgrid(np.linspace(0.0, 12.0, 6), np.linspace(0.0, 5.0, 6), indexing="ij")
    plate = SplineSurface(
        "plate", (3, 3), knots, knots, np.stack([x, y, 0.2 * rng.standard_normal(x.shape)], -1)
    )
    turn = np.linalg.qr(rng.standard_normal((3, 3)))[0]
    moved = attrs.evolve(plate, net=plate.net @ turn.T + [100.0, 20.0, 5.0])
    here, there = (
        ah.surface.curvature_regions(each, zero="exact", area_tol=1e-9) for each in (plate, moved)
    )
    assert abs(here.positive - there.positive) <= 1e-12 * here.total
    assert here.zero == there.zero == 0.0
    assert [each.kind for each in here.components] == [each.kind for each in there.components]
