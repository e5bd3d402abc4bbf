"""The bulk carrier read back from digitised lines: its flats, bilge and bossing end are found."""

import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray, PointKind
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.hull import Hull
from assoc_hull.io.digitised.read import read_lines
from assoc_hull.io.slicing.net import SliceReport, net_from_slices
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.tables import HullState
from assoc_hull.shipped import bulk_carrier_207k_form as form
from tests.digitise import as_digitised

NOISE = 1e-3
LEFT_OUT = ("flat of side", "flat of bottom", "bossing end")


@pytest.fixture(scope="module")
def read_back(bulk_carrier: Hull) -> tuple[HullState, SliceReport]:
    """The net of the carrier's lines, digitised with 1 mm noise and without its flats."""
    return net_from_slices(read_lines(as_digitised(bulk_carrier, 1, NOISE, LEFT_OUT)))


def test_the_flats_are_found(read_back: tuple[HullState, SliceReport]) -> None:
    """Flat of side and of bottom come back as one border each, in their planes."""
    state, report = read_back
    assert sorted(border.name for border in report.borders) == ["flat of bottom", "flat of side"]
    assert {border.kind for border in report.borders} == {BoundaryKind.FLAT}
    for border in report.borders:
        axis, level = (2, 0.0) if border.name == "flat of bottom" else (1, form.BREADTH / 2.0)
        assert np.abs(border.places[:, axis] - level).max() < NOISE
        line = state.lines.name.data.index(border.name)
        assert state.lines.normal[line].tolist() == np.eye(3)[axis].tolist()
        assert abs(float(state.lines.offset[line]) - level) < NOISE


def bottom_off(places: FloatArray) -> FloatArray:
    """How far places lie off the border of the flat of bottom, along y, m."""
    return np.abs(places[:, 1] - form.carrier_half_breadth(places[:, 0], 0.0 * places[:, 0]))


def side_off(places: FloatArray) -> FloatArray:
    """How far places lie off the border of the flat of side, m."""
    z = np.linspace(form.BILGE, form.DEPTH, 4000)
    aft = np.column_stack([form.aft_shoulder(z), z])
    fore = np.column_stack([form.fore_shoulder(z), z])
    x = np.linspace(aft[0, 0], fore[0, 0], 4000)
    whole = np.concatenate([aft, np.column_stack([x, np.full(4000, form.BILGE)]), fore])
    away = places[:, None, [0, 2]] - whole
    return np.asarray(np.sqrt((away * away).sum(axis=2).min(axis=1)))


@pytest.mark.parametrize(
    ("name", "median", "most"), [("flat of bottom", 0.1, 0.6), ("flat of side", 0.3, 1.5)]
)
def test_the_borders_lie_where_they_were(
    read_back: tuple[HullState, SliceReport], name: str, median: float, most: float
) -> None:
    """Borders lie on the true ones within what such shoulders tell.

    The waterlines leave the flat of side with curvature that grows from nil: nobody can tell to
    a metre where. The bottom is left with a radius nearly everywhere.
    """
    _, report = read_back
    border = next(each for each in report.borders if each.name == name)
    off = bottom_off(border.places) if name == "flat of bottom" else side_off(border.places)
    print(
        f"\n{name}: {len(border.lines)} marks, {border.taken} taken, off by {np.median(off):.3f} m "
        f"(median), p95 {np.percentile(off, 95):.3f}, max {off.max():.3f} m"
    )
    assert np.median(off) < median
    assert off.max() < most


def test_borders_generate_the_tangent_points(read_back: tuple[HullState, SliceReport]) -> None:
    """Each line that ends a run on a border has its tangent point there, in the flat."""
    state, report = read_back
    rows, live = state.rows, state.live("rows")
    names = {border.name: border for border in report.borders}
    count = dict.fromkeys(names, 0)
    for row in live[rows.contact[live]].tolist():
        on = [state.lines.name[state.line_of(c)] for c in rows.curve[row].tolist()]
        if on[0] not in names:
            continue
        count[on[0]] += 1
        line = state.line_of(int(rows.curve[row, 0]))
        normal, offset = state.lines.normal[line], float(state.lines.offset[line])
        assert rows.kind[row, 1] == PointKind.TANGENT
        assert abs(float(rows.xyz[row] @ normal) - offset) < 1e-9
        assert abs(float(rows.direction[row, 1] @ normal)) < 1e-9
    assert count == {name: border.taken for name, border in names.items()}
    hull = Hull(state)
    assert hull.check() == ()
    assert hull.verify() == ()


def test_lines_are_flat_in_the_flat(read_back: tuple[HullState, SliceReport]) -> None:
    """Above the border a section of the parallel body is straight, to 0.3 mm."""
    state, _ = read_back
    line = state.lines.name.data.index("ST 10")
    [curve] = state.lines.curves[line]
    z = np.linspace(3.0, 26.0, 50)
    wanted = np.column_stack([np.full(50, 150.0), np.full(50, form.BREADTH / 2.0), z])
    away = closest_points(state.spline(curve), 0, wanted)[2]
    assert away.max() < 3e-4


def test_bilge_and_bossing_end_are_arcs(read_back: tuple[HullState, SliceReport]) -> None:
    """The bilge amidships and the bossing end come back within 1 % of their radius."""
    _, report = read_back
    arcs = {each.line: each.arcs for each in report.smoothing if each.arcs}
    for name, radius in [(f"ST {n}", form.BILGE) for n in (8, 10, 12)] + [
        (f"ST {n}", form.BOSS) for n in ("0.45", "0.5")
    ]:
        [arc] = arcs[name]
        print(f"{name}: radius {arc.radius:.4f} +- {arc.uncertainty:.4f} m, true {radius} m")
        assert arc.radius == pytest.approx(radius, rel=0.01)
        assert abs(arc.radius - radius) < 4.0 * arc.uncertainty
