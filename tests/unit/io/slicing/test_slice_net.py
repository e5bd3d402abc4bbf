"""From slices of hulls with a formula to smooth lines and a net."""

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, FloatArray
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.geometry.surfaces.triangles import Triangles
from assoc_hull.hull import Hull
from assoc_hull.io.digitised.read import read_lines
from assoc_hull.io.lines.slices import HullSlices
from assoc_hull.io.slicing.mesh_lines import slice_mesh
from assoc_hull.io.slicing.net import SliceReport, net_from_slices, sources_from_slices
from assoc_hull.model.definition.restore import verify
from assoc_hull.model.tables import HullState
from tests import meshes

HULLS = [
    pytest.param(meshes.wigley_half(81, 21), meshes.wigley_off, id="Wigley, coarse"),
    pytest.param(meshes.wigley_half(161, 41), meshes.wigley_off, id="Wigley, medium"),
    pytest.param(meshes.wigley_half(321, 81), meshes.wigley_off, id="Wigley, fine"),
    pytest.param(meshes.ellipsoid_half(81, 25), meshes.ellipsoid_off, id="ellipsoid, coarse"),
    pytest.param(meshes.ellipsoid_half(161, 49), meshes.ellipsoid_off, id="ellipsoid, medium"),
    pytest.param(meshes.ellipsoid_half(321, 97), meshes.ellipsoid_off, id="ellipsoid, fine"),
]


@cache
def slices_of(mesh: Triangles) -> HullSlices:
    """Slices of a mesh, which several tests look at."""
    return slice_mesh(mesh, stations=9, waterlines=5, buttocks=3)


@cache
def net_of(mesh: Triangles) -> tuple[HullState, SliceReport]:
    """The net made of them; no test changes it."""
    return net_from_slices(slices_of(mesh))


@pytest.mark.parametrize(("mesh", "off"), HULLS)
def test_smooth_lines_are_the_hull_within_their_band(
    mesh: Triangles, off: Callable[[FloatArray], FloatArray]
) -> None:
    """Each smooth line lies on the hull within its stated band and has no inflection."""
    sources, reports, knuckles, _, borders = sources_from_slices(slices_of(mesh))
    assert (knuckles, borders) == ([], [])
    for source, report in zip(sources, reports, strict=True):
        if source.group == "boundary":
            continue
        spline = loft(CurveData.single(source.points, source.kind.tolist()))
        assert (source.kind == 0).all()
        assert off(sample(spline, 9)[1]).max() <= report.band
        assert inflections(spline, source.normal)[0].tolist() == [0]  # type: ignore[arg-type]


@pytest.mark.parametrize(("mesh", "off"), HULLS)
def test_the_net_is_the_hull(mesh: Triangles, off: Callable[[FloatArray], FloatArray]) -> None:
    """Every adopted curve lies on the hull within its stated band, and bends as the hull does.

    Sections, waterlines and buttocks of both hulls have no inflection (see below).
    """
    state, report = net_of(mesh)
    seen = []
    for line, band in zip(report.adoption.lines, report.bands, strict=True):
        curve = state.curves.key.data.index(line.curve)
        spline = state.spline(curve)
        seen.append(line.group)
        away = off(sample(spline, 17)[1]).max()
        assert away <= band, line.line
        assert away <= 1.5 * report.tolerance, line.line  # bands in grazing planes are wide
        if line.group != "boundary":
            normal = state.lines.normal[state.line_of(curve)]
            assert inflections(spline, normal)[0].tolist() == [0], line.line
            assert (line.inflections_given, line.inflections) == (0, 0), line.line
    assert [seen.count(name) for name in ("sections", "waterlines", "buttocks")] == [9, 5, 3]
    assert report.inflections == (0, 0)
    assert Hull(state).check() == ()
    assert list(verify(state)) == []


@pytest.mark.parametrize(("mesh", "off"), HULLS)
def test_adopted_curves_end_where_the_hull_ends(
    mesh: Triangles, off: Callable[[FloatArray], FloatArray]
) -> None:
    """Sections at keel and deck, waterlines on stem and stern, buttocks on the deck twice."""
    state, report = net_of(mesh)
    deck = float(slices_of(mesh).high[2])
    for line in report.adoption.lines:
        first, last = state.spline(state.curves.key.data.index(line.curve)).xyz[[0, -1]]
        if line.group == "sections":
            assert [first[1], last[2]] == pytest.approx([0.0, deck], abs=1e-6)
        elif line.group == "waterlines":
            assert [first[1], last[1]] == pytest.approx([0.0, 0.0], abs=1e-6)
            assert first[0] < 50.0 < last[0]
        elif line.group == "buttocks":
            assert [first[2], last[2]] == pytest.approx([deck, deck], abs=1e-6)
            assert first[0] < 50.0 < last[0]


@pytest.mark.parametrize("form", [meshes.wigley_sheet, meshes.ellipsoid_sheet])
def test_the_true_lines_have_no_inflection(form: Callable[[str, float], FloatArray]) -> None:
    """Of the formulas themselves, from dense places: the bend of every line keeps its sign."""
    for family, offset in (
        ("sections", 2.3), ("sections", 50.0), ("sections", 97.7), ("waterlines", 0.6),
        ("waterlines", 5.6), ("buttocks", 0.8), ("buttocks", 4.0),
    ):  # fmt: skip
        places = form(family, offset)
        chord = np.diff(places, axis=0)
        bend = chord[:-1, 0] * chord[1:, 1] - chord[:-1, 1] * chord[1:, 0]
        bend = bend[np.abs(bend) > 1e-12 * np.abs(bend).max()]
        assert (np.sign(bend) == np.sign(bend[0])).all(), (family, offset)


def test_digitised_and_sliced_lines_make_the_same_kind_of_net() -> None:
    """Lines with 1 mm noise, given as text, are adopted within 3 sigma and without inflections."""
    import attrs

    from assoc_hull.io.lines.slices import HullSlices, LinePiece, SliceLine
    from tests.unit.io.digitised.test_digitised import as_csv

    slices = slice_mesh(meshes.wigley_half(401, 81), stations=7, waterlines=4, buttocks=0)
    draw = np.random.default_rng(7)

    def noisy(line: SliceLine) -> SliceLine:
        pieces = []
        for piece in line.pieces:
            points = piece.points.copy()
            points[1:-1, 1] += draw.normal(0.0, 1e-3, len(points) - 2)
            pieces.append(LinePiece(points, piece.ends))
        return attrs.evolve(line, pieces=tuple(pieces))

    given: HullSlices = attrs.evolve(slices, lines=tuple(map(noisy, slices.lines)))
    state, report = net_from_slices(read_lines(as_csv(given)))
    assert report.inflections == (0, 0)
    rows, live = state.rows, state.live("rows")
    crossings = live[(rows.curve[live, 1] >= 0) & ~rows.contact[live]]
    assert meshes.wigley_off(rows.xyz[crossings]).max() <= 3e-3


def test_one_line_is_no_net() -> None:
    """Slices with a single line are refused."""
    slices = slice_mesh(meshes.wigley_half(), stations=1, waterlines=0, buttocks=0)
    with pytest.raises(BadInputError, match="two or more"):
        net_from_slices(slices)


def test_dtc_is_adopted(dtc_with_report: tuple[Hull, SliceReport]) -> None:
    """DTC: at most 600 adopted points, 45 inflections more, gaps p95 4 mm, nothing found."""
    hull, report = dtc_with_report
    gaps = [each.gap for each in hull.crossings.values() if each.gap is not None]
    assert report.adopted <= 600
    assert report.inflections[1] <= 45
    assert len(report.knuckles) >= 1
    assert sorted(border.name for border in report.borders) == ["flat of bottom", "flat of side"]
    assert report.tolerance == pytest.approx(max(0.010, 3.0 * report.noise))
    assert np.percentile(gaps, 95) <= 0.004
    assert hull.check() == ()
    assert hull.verify() == ()


def test_a_mesh_too_coarse_for_its_shape_is_suspected() -> None:
    """A Wigley hull of 9 by 4 is adopted in decimetres: told, and not of a fine one or a barge."""
    coarse = slice_mesh(meshes.wigley_half(9, 4), stations=5, waterlines=3, buttocks=1)
    assert net_from_slices(coarse)[1].suspicions[0].startswith("tolerance: adopted within")
    x, y, z = 40.0, 5.0, 6.0
    corner = np.array([[i, j, k] for i in (0, x) for j in (-y, y) for k in (0, z)], float)
    quads = [[0, 2, 6, 4], [0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [1, 5, 7, 3]]
    face = np.array([[a, b, c] for q in quads for a, b, c in (q[:3], (q[0], q[2], q[3]))])
    barge = slice_mesh(Triangles(corner, face), stations=7, waterlines=3, buttocks=2)
    fine = slice_mesh(meshes.wigley_half(161, 41), stations=5, waterlines=3, buttocks=1)
    for sound in (barge, fine):
        assert net_from_slices(sound)[1].suspicions == ()


def test_a_foot_moved_onto_the_keel_leaves_the_other_end_where_it_is() -> None:
    """Sections that begin 40 mm above the profile are led down to it, and end on the deck edge."""
    z = np.linspace(0.0, 6.0, 25)
    rows = [f"ST {x},{x},{4 * (c / 6.0) ** 0.5},{c}" for x in range(10, 91, 10) for c in z]
    rows += [f"profile,{x},0,-0.04" for x in range(0, 101, 5)]
    rows += [f"deck edge,{x},4,6" for x in range(0, 101, 5)]
    sources = sources_from_slices(read_lines("\n".join(["line,x,y,z", *rows, ""])))[0]
    sections = [each.points for each in sources if each.group == "sections"]
    assert len(sections) == 9
    assert max(abs(points[0, 2] + 0.04) for points in sections) < 1e-6
    assert max(np.abs(points[-1, 1:] - [4.0, 6.0]).max() for points in sections) < 1e-6


def _wedge(*more: str) -> str:
    """Sections of a wedge-shaped hull of two points each, and a waterline of two, as text."""
    rows = [f"ST {x},{x},{y},{z}" for x in (0, 10, 20) for y, z in ((0, 0), (3 + 0.1 * x, 4))]
    return "\n".join(["line,x,y,z", *rows, *more, ""])


def test_lines_of_two_points_are_adopted() -> None:
    """Straight sections, a waterline and a transom given by their ends are curves of the net."""
    text = _wedge("WL 2,0,1.5,2", "WL 2,20,2.5,2", "transom,0,0,0", "transom,0,3,4")
    state, report = net_from_slices(read_lines(text))
    assert sorted(line.line for line in report.adoption.lines) == [
        "ST 0", "ST 10", "ST 20", "WL 2", "transom",
    ]  # fmt: skip
    assert max(line.deviation for line in report.adoption.lines) < 1e-9
    assert report.slices.suspicions == ()
    assert Hull(state).check() == ()


def test_pieces_too_short_to_be_adopted_are_told() -> None:
    """A line of 10 mm of a hull of 20 m is left out, and its name stands in the report."""
    _, report = net_from_slices(read_lines(_wedge("ST 15,15,1,1", "ST 15,15,1.005,1.01")))
    assert "ST 15" not in [line.line for line in report.adoption.lines]
    (note,) = [each for each in report.slices.suspicions if each.kind == "crumbs"]
    assert note.amount == 1
    assert "of ST 15" in note.what


def test_nothing_long_enough_to_be_adopted_is_refused() -> None:
    """Crumbs alone make no net: how short they are, and what to give."""
    text = "line,x,y,z\nST 1,0,1,1\nST 1,0,1.005,1.009\nST 2,10,1,1\nST 2,10,1.005,1.009\n"
    with pytest.raises(BadInputError, match=r"shorter than 0\.01 m.*unit or scale"):
        net_from_slices(read_lines(text))


@pytest.mark.parametrize("tolerance", [0, -1.0, "x", [1], np.nan, np.inf, True, 1e6, 25.0])
def test_the_tolerance_is_a_number_above_nil(tolerance: object) -> None:
    """Anything else is refused before lines are smoothed, by its name."""
    with pytest.raises(BadInputError, match="tolerance is"):
        net_from_slices(read_lines(_wedge()), tolerance=tolerance)  # type: ignore[arg-type]


@pytest.mark.parametrize(("around", "told"), [(9, True), (33, False)], ids=["coarse", "fine"])
def test_a_mesh_of_deep_facets_is_doubtful(around: int, told: bool) -> None:
    """What its facets cut off the hull is told, and that a finer mesh is the remedy."""
    mesh = meshes.ellipsoid_half(10 * (around - 1) + 1, around)
    _, report = net_of(mesh)
    found = [each for each in report.suspicions if each.startswith("coarse mesh: ")]
    assert bool(found) is told
    if found:
        assert f"{1e3 * report.facet_depth:.3g} mm" in found[0]
        assert "give a finer mesh" in found[0]
