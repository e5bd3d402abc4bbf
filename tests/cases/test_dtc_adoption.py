"""What the adoption of a real hull promises: the DTC container ship, from its mesh."""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.geometry.curves import PointKind
from assoc_hull.model.gaps import tangents
from assoc_hull.model.kinds import Role, Sort

SPACING = 0.2
"""Adopted points keep this far from crossings, along the curve, m."""


def test_watched_gaps_are_4_mm_at_p95_and_nothing_is_found(dtc: ah.Hull) -> None:
    """Lines of three families, smoothed jointly, meet; check and verify are clean."""
    gaps = [each.gap for each in dtc.crossings.values() if each.gap is not None]
    print(f"\n{len(gaps)} watched gaps, p95 {1e3 * np.percentile(gaps, 95):.2f} mm")
    assert len(gaps) > 100
    assert np.percentile(gaps, 95) <= 0.004
    assert dtc.check() == ()
    assert dtc.verify() == ()


def test_at_most_600_points_are_adopted(dtc: ah.Hull) -> None:
    """Points that no crossing holds, of all curves."""
    rows, live = dtc.state.rows, dtc.state.live("rows")
    assert int((rows.sort[live] == Sort.ADOPTED).sum()) <= 600


def test_only_steep_crossings_define_a_curve(dtc: ah.Hull) -> None:
    """The role rule asks for 15 degrees with the plane of the partner, whatever was re-admitted.

    A degree is left for the curve that came to differ from the line the rule looked at.
    """
    state = dtc.state
    rows, live = state.rows, state.live("rows")
    crossing = live[(rows.curve[live] >= 0).all(axis=1) & ~rows.contact[live]]
    seen = 0
    for side, driven in ((0, Role.DRIVES_A), (1, Role.DRIVES_B)):
        mine = crossing[np.isin(rows.role[crossing], [Role.SHARED, driven])]
        planes = np.array([state.line_of(c) for c in rows.curve[mine, 1 - side].tolist()])
        along = tangents(state, rows.curve[mine, side], rows.parameter[mine, side])
        sine = np.abs((along * state.lines.normal[planes]).sum(axis=1))
        assert np.degrees(np.arcsin(sine)).min() > 14.0
        seen += len(mine)
    assert seen > 2000


def test_adopted_points_keep_clear_of_crossings(dtc: ah.Hull) -> None:
    """A drag of 50 mm at a crossing shall not fold the curve at the point beside it."""
    state, rows = dtc.state, dtc.state.rows
    for curve in state.live("curves").tolist():
        own = state.curves.rows[curve]
        knot = state.curves.spline[curve].knot
        both = (rows.curve[own] >= 0).all(axis=1) & ~rows.contact[own]
        smooth = (rows.sort[own] == Sort.ADOPTED) & (rows.kind[own, 0] == PointKind.SMOOTH)
        smooth[[0, -1]] = False
        if both.any() and smooth.any():
            beside = np.abs(knot[smooth][:, None] - knot[both]).min(axis=1)
            assert beside.min() > 0.9 * SPACING


def test_curves_off_or_wavier_than_their_lines_are_few_and_named(dtc: ah.Hull) -> None:
    """Of 81 curves at most 6 exceed their tolerance, by 2 at most, each with a note.

    All together have at most 10 inflections that the lines lack.
    """
    report = dtc.adoption
    assert report is not None
    given, more = report.inflections
    print(f"\n{given} inflections given, {more} more; {report.own_points} adopted points")
    assert more <= 10  # 13 where adopted points are not moved for it
    over = {each.line: each.tolerance_used for each in report.lines if each.tolerance_used > 1.05}
    print(f"\nover their tolerance: {over}")
    assert len(over) <= 6
    assert max(over.values(), default=0.0) <= 2.0
    assert all(any(note.startswith(f"{line} ") for note in report.notes) for line in over)


def test_bilge_arcs_amidships_are_features_that_tell_their_gap(dtc: ah.Hull) -> None:
    """The scanned bilge is a circle of 4.7 m within a few millimetres where flats bound it."""
    arcs = [each for each in dtc.features.values() if each.kind == "arc"]
    print(f"\n{[(each.name, each.parameters['radius'], each.gap) for each in arcs]}")
    assert len(arcs) >= 2
    assert all(each.parameters["radius"] == pytest.approx(4.71, abs=0.01) for each in arcs)
    assert all(1e-6 < each.gap < 0.003 for each in arcs)
    assert {"flat of side", "flat of bottom"} <= set(dtc.features)


def test_the_flat_of_side_ends_at_the_bow_without_a_hook(dtc: ah.Hull) -> None:
    """From its last corner upward it stays within 0.7 m; a vague mark drew it back by 2.1 m."""
    xyz = dtc.lines["flat of side"].curves[0].spline.xyz
    above = xyz[xyz[:, 2] > 28.0]
    assert len(above) >= 3
    assert np.ptp(above[above[:, 0] > 280.0, 0]) < 0.7
