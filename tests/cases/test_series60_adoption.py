"""Series 60 from Todd's table: what is given is kept, what is cut moves nothing."""

from __future__ import annotations

import numpy as np
import pytest

from assoc_hull.edit.lines.curve_deviation import deviation
from assoc_hull.geometry.curves import CurveData, SplineBatch
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.hull import Hull
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.shipped.series60 import series60_adopted, todd_table

CASES = pytest.mark.parametrize("cb", [0.60, 0.70], ids=["CB .60", "CB .70"])


@pytest.fixture(scope="module")
def adopted() -> dict[float, Hull]:
    """The table alone, as a net."""
    return {cb: Hull(series60_adopted(cb)[0]) for cb in (0.60, 0.70)}


@pytest.fixture(scope="module")
def whole(series60_60: Hull, series60_70: Hull) -> dict[float, Hull]:
    """The nets of 41 stations, 20 waterlines and 12 buttocks."""
    return {0.60: series60_60, 0.70: series60_70}


def _given(cb: float, group: str) -> dict[float, np.ndarray]:
    """Give the table's own offsets per station or waterline, those above nil."""
    table = todd_table(cb)[0]
    found: dict[float, list[list[float]]] = {}
    for i, x in enumerate(table.x.tolist()):
        for j, z in enumerate(table.z.tolist()):
            y = float(table.half_breadth[i, j])
            inner = 0 < j < len(table.z) - 1
            if y > 0.0 and (inner or (group == "sections" and j > 0)):
                found.setdefault(x if group == "sections" else z, []).append([x, y, z])
    return {key: np.array(points) for key, points in found.items()}


@CASES
@pytest.mark.parametrize("group", ["sections", "waterlines"])
def test_every_given_line_passes_its_offsets_within_1_mm(
    adopted: dict[float, Hull], cb: float, group: str
) -> None:
    """With no smoothing, adoption keeps every offset of the table within a millimetre."""
    hull = adopted[cb]
    for line in hull.groups[group].lines.values():
        assert line.position is not None
        position = float(line.position)
        points = _given(cb, group)[min(_given(cb, group), key=lambda k: abs(k - position))]
        away = closest_points(line.curves[0].spline, 0, points)[2]
        assert away.max() <= 1e-3, f"{line.name}: {1e3 * away.max():.2f} mm"


@CASES
def test_an_adopted_line_has_no_more_inflections_than_the_spline_through_its_offsets(
    adopted: dict[float, Hull], cb: float
) -> None:
    """Lobes of 0.2 degrees and more are counted on both."""
    hull = adopted[cb]
    for group, axis in (("sections", 0), ("waterlines", 2)):
        for line in hull.groups[group].lines.values():
            curve = line.curves[0]
            own = [p for p in curve.points if p.sort != "adopted" or p.role == "defining"]
            xyz = np.array([p.position for p in own if p.role == "defining"])
            kinds = [
                {"smooth": 0, "tangent": 1, "knuckle": 2}[p.kind]
                for p in own
                if p.role == "defining"
            ]
            tables = hull.state.rows
            direction = np.array(
                [tables.direction[p.row, p.side] for p in own if p.role == "defining"]
            )
            source = loft(CurveData.single(xyz, kinds, direction))
            normal = np.eye(3)[axis]
            assert inflections(curve.spline, normal)[0][0] <= inflections(source, normal)[0][0]


@CASES
def test_cut_lines_move_no_given_line_by_more_than_1_mm(
    adopted: dict[float, Hull], whole: dict[float, Hull], cb: float
) -> None:
    """Adding 14 waterlines, 16 sections and 12 buttocks is no change of shape."""
    before = adopted[cb].state
    count = before.curves.count
    keys = before.curves.key[:count]
    after = [whole[cb].state.curves.key.data.index(key) for key in keys]
    old = SplineBatch.join([before.spline(i) for i in range(count)])
    new = SplineBatch.join([whole[cb].state.spline(i) for i in after])
    assert deviation(old, new).max() <= 1e-3


@CASES
def test_the_net_has_41_stations_20_waterlines_and_12_buttocks(
    whole: dict[float, Hull], cb: float
) -> None:
    """20 waterlines count the deck edge, the table's waterline 1.5 T, as in the table."""
    groups = whole[cb].groups
    counts = [len(groups[name].lines) for name in ("sections", "waterlines", "buttocks")]
    assert counts == [41, 20, 12]


@CASES
def test_watched_gaps_stay_within_6_mm_and_3_mm_at_p95(whole: dict[float, Hull], cb: float) -> None:
    """The families of the adopted net agree wherever no crossing ties them."""
    rows = whole[cb].state.rows
    watched = rows.alive.data & (rows.sort.data == Sort.CROSSING) & (rows.role.data == Role.WATCHED)
    gap = rows.gap[watched]
    assert np.isfinite(gap).all()
    assert gap.max() <= 6e-3
    assert np.percentile(gap, 95) <= 3e-3


@CASES
def test_the_report_says_how_coarsely_the_table_is_printed(cb: float) -> None:
    """0.5 T and up: three decimals of B/2, 4.1 mm (.60) and 4.4 mm (.70) at full scale."""
    table = todd_table(cb)[0]
    report = series60_adopted(cb)[1]
    upper = {0.60: 4.064e-3, 0.70: 4.354e-3}[cb]
    assert table.rounding[3:] == pytest.approx(upper, rel=1e-3)
    assert table.rounding[:3] == pytest.approx(0.1 * upper, rel=1e-3)
    printed = {0.60: "+-4.1 mm", 0.70: "+-4.4 mm"}[cb]
    assert any(printed in note and "0.5, 0.75, 1, 1.25, 1.5 T" in note for note in report.notes)


@CASES
def test_check_and_verify_find_nothing(whole: dict[float, Hull], cb: float) -> None:
    """The shipped examples are clean, and rebuild to the bit from their definition."""
    assert whole[cb].check() == ()
    assert whole[cb].verify() == ()
