"""The 207,000 TDW bulk carrier: what its construction promises, measured on its splines."""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.hydrostatics.flotation import even_keel_displacement
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.geometry.splines.segments import evaluate, sample
from assoc_hull.model.kinds import Role, Sort
from tests.independent import lost_meetings, trouble

AXIS = {"sections": 0, "waterlines": 2, "buttocks": 1}


def _changes(hull: ah.Hull, group: str) -> dict[str, int]:
    """Count the changes of curvature of each line: of the worst of its pieces."""
    normal = np.eye(3)[AXIS[group]]
    return {
        name: max(int(inflections(curve.spline, normal)[0][0]) for curve in line.curves)
        for name, line in hull.groups[group].lines.items()
    }


def _points(spline: SplineBatch) -> FloatArray:
    return sample(spline, 16)[1]


def test_the_volume_is_that_of_the_block_coefficient_within_half_a_per_cent(
    bulk_carrier: ah.Hull,
) -> None:
    """0.84 Lpp B T at the design draught, from section areas by the exact Gauss rules."""
    volume = even_keel_displacement(bulk_carrier.state).volume
    print(f"\nvolume {volume:.0f} m3, CB {volume / (300 * 50 * 18):.4f}")
    assert volume == pytest.approx(0.84 * 300.0 * 50.0 * 18.0, rel=0.005)


def test_lcb_lies_2_to_3_5_per_cent_of_the_length_before_midship(bulk_carrier: ah.Hull) -> None:
    """As full ships have it."""
    lcb = (even_keel_displacement(bulk_carrier.state).lcb - 150.0) / 300.0
    assert 0.02 < lcb < 0.035


def test_the_net_has_41_stations_20_waterlines_and_12_buttocks(bulk_carrier: ah.Hull) -> None:
    """0.5 m and 1.0 m among the waterlines and among the buttocks."""
    groups = bulk_carrier.groups
    assert [len(groups[name].lines) for name in AXIS] == [41, 20, 12]
    assert {"WL 0.5", "WL 1", "BTK 0.5", "BTK 1"} <= set(bulk_carrier.lines)


def test_no_section_changes_its_curvature_more_than_twice(bulk_carrier: ah.Hull) -> None:
    """Lobes of 0.2 degrees and more; sections end at the deck."""
    assert {name: n for name, n in _changes(bulk_carrier, "sections").items() if n > 2} == {}


def test_no_waterline_changes_its_curvature_more_than_three_times(bulk_carrier: ah.Hull) -> None:
    """Lobes of 0.2 degrees and more."""
    assert {name: n for name, n in _changes(bulk_carrier, "waterlines").items() if n > 3} == {}


def test_check_and_verify_find_nothing(bulk_carrier: ah.Hull) -> None:
    """The net is clean, rebuilds to the bit from its definition, and misses no crossing."""
    assert bulk_carrier.check() == ()
    assert bulk_carrier.verify() == ()
    assert list(trouble(bulk_carrier)) == []
    assert list(lost_meetings(bulk_carrier)) == []


def test_the_bilge_amidships_is_a_circle_of_2_4_m(bulk_carrier: ah.Hull) -> None:
    """Within 0.2 mm, on all stations of the parallel middle body."""
    for number in (8, 10, 12):
        points = _points(bulk_carrier.lines[f"ST {number}"].curves[0].spline)
        bilge = points[(points[:, 1] > 22.6) & (points[:, 2] < 2.4)]
        radius = np.hypot(bilge[:, 1] - 22.6, bilge[:, 2] - 2.4)
        assert len(bilge) > 16
        assert np.abs(radius - 2.4).max() < 2e-4


def test_the_flats_are_flat(bulk_carrier: ah.Hull) -> None:
    """Inside its border the bottom has z = 0, and the side y = 25 m, to rounding."""
    for name, line in bulk_carrier.groups["sections"].lines.items():
        rows = {point.parent_curve.line.name: point for point in line.points if point.parent_curve}
        points = np.concatenate([_points(curve.spline) for curve in line.curves])
        if "flat of bottom" in rows:
            inside = points[(points[:, 1] < rows["flat of bottom"].y) & (points[:, 2] < 1.0)]
            assert np.abs(inside[:, 2]).max() < 1e-12, name
        if "flat of side" in rows:
            above = points[points[:, 2] > rows["flat of side"].z]
            assert np.abs(above[:, 1] - 25.0).max() < 1e-12, name


def test_the_bossing_ends_as_a_cylinder_about_the_shaft(bulk_carrier: ah.Hull) -> None:
    """0.725 m about z = 5 m within 0.01 mm: its end, and the stations at 6.75 and 7.5 m."""
    ends = [bulk_carrier.lines["bossing end"].curves[0]]
    for name in ("ST 0.45", "ST 0.5"):
        lobes = [curve for curve in bulk_carrier.lines[name].curves if _low(curve.spline) < 5.0]
        assert len(bulk_carrier.lines[name].curves) == 2
        assert len(lobes) == 1
        ends += lobes
    for curve in ends:
        points = _points(curve.spline)
        assert np.abs(np.hypot(points[:, 1], points[:, 2] - 5.0) - 0.725).max() < 1e-5


def _low(spline: SplineBatch) -> float:
    return float(spline.xyz[:, 2].min())


def test_the_profile_meets_the_bossing_end_and_runs_along_the_cylinder(
    bulk_carrier: ah.Hull,
) -> None:
    """Both pieces of the profile end on the circle; below, the slope is nil where it begins."""
    circle = bulk_carrier.lines["bossing end"].curves[0].spline.xyz
    ends = np.concatenate(
        [curve.spline.xyz[[0, -1]] for curve in bulk_carrier.lines["profile"].curves]
    )
    for tip in circle[[0, -1]]:
        assert np.abs(ends - tip).max(axis=1).min() == 0.0
    for curve in bulk_carrier.lines["profile"].curves:
        points = _points(curve.spline)
        along = points[(points[:, 0] < 7.5) & (np.abs(points[:, 2] - 5.0) < 0.8)]
        assert np.abs(np.abs(along[:, 2] - 5.0) - 0.725).max() < 1e-9


def test_the_waterline_at_the_shaft_ends_on_the_bossing_end(bulk_carrier: ah.Hull) -> None:
    """At y = 0.725 m, within 0.01 mm; the buttock at 1.0 m misses the bossing."""
    spline = bulk_carrier.lines["WL 5"].curves[0].spline
    start = evaluate(spline, np.array([0]), np.array([0.0]))[0]
    assert np.abs(start - [6.0, 0.725, 5.0]).max() < 1e-5
    groups = {
        point.parent_curve.line.name
        for point in bulk_carrier.lines["BTK 1"].points
        if point.parent_curve
    }
    assert "bossing end" not in groups


def test_watched_gaps_stay_within_5_mm_and_2_mm_at_p95(bulk_carrier: ah.Hull) -> None:
    """The families agree wherever no crossing ties them."""
    rows = bulk_carrier.state.rows
    watched = rows.alive.data & (rows.sort.data == Sort.CROSSING) & (rows.role.data == Role.WATCHED)
    gap = rows.gap[watched]
    print(f"\nwatched gaps: p95 {1e3 * np.percentile(gap, 95):.2f}, max {1e3 * gap.max():.2f} mm")
    assert np.isfinite(gap).all()
    assert gap.max() <= 5e-3
    assert np.percentile(gap, 95) <= 2e-3


def test_every_given_point_is_kept(bulk_carrier: ah.Hull) -> None:
    """Within 2 mm, on the two buttocks that are drawn within 5 mm; nothing is left out."""
    assert bulk_carrier.adoption is not None
    assert bulk_carrier.adoption.notes == ()
    for line in bulk_carrier.adoption.lines:
        assert line.deviation <= (5e-3 if line.curve.startswith("buttocks") else 2e-3), line


def test_the_end_of_the_bossing_is_no_transom(bulk_carrier: ah.Hull) -> None:
    """Her transom is dry at the design draught, and wet only above its foot; S with it says so.

    The disc at which the bossing ends has 1.651 m2, and counted as a transom at every draught.
    """
    edge = bulk_carrier.lines["transom"].curves[0].spline.xyz
    foot = float(edge[:, 2].min())
    draughts = [8.0, 18.0, foot, foot + 1.0, foot + 2.0]
    table = bulk_carrier.hydrostatic_table(draughts)
    area = table.columns["transom_area"]
    assert area[:3].tolist() == [0.0, 0.0, 0.0]
    assert table.errors["transom_area"][:3].tolist() == [0.0, 0.0, 0.0]
    # Area of a polygon through places on the drawn edge.
    run = _points(bulk_carrier.lines["transom"].curves[0].spline)
    for height, found in zip(draughts[3:], area[3:].tolist(), strict=True):
        z = np.linspace(foot, height, 4001)
        y = np.interp(z, run[:, 2], run[:, 1])
        assert found == pytest.approx(2.0 * float(np.trapezoid(y, z)), rel=2e-3)
    with_it = bulk_carrier.hydrostatics(draught=18.0, transom=True)
    assert with_it.wetted_surface == bulk_carrier.hydrostatics(draught=18.0).wetted_surface
