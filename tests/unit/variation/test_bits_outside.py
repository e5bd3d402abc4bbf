"""Outside the reported region a variation leaves the bits of what defines the hull."""

from __future__ import annotations

import numpy as np

import assoc_hull as ah


def test_lines_that_come_to_end_elsewhere_keep_their_bits_outside(bulk_carrier: ah.Hull) -> None:
    """A raised shaft: two waterlines swap the bossing's end for the profile, and back.

    Crossings that are computed from a driver which passes through the region may drift; all
    else that defines a curve stays, the points of followers too.
    """
    found = bulk_carrier.vary(set={"shaft_height": 6.0})
    before, after = bulk_carrier.state, found.hull.state
    rows = before.live("rows")
    place = before.rows.xyz[rows]
    outside = np.ones(len(rows), bool)
    for region in found.report.regions:
        (left, right), (low, high) = region.x, region.z
        outside &= ~(
            (place[:, 0] >= left) & (place[:, 0] <= right)
            & (place[:, 2] >= low) & (place[:, 2] <= high)
        )  # fmt: skip
    defining = (before.rows.reader[rows] >= 0).any(axis=1)
    free = before.rows.driver[rows] < 0
    kept = rows[outside & defining & free]
    assert len(kept) > 1000
    there = {str(after.rows.key[row]): row for row in after.live("rows").tolist()}
    same = [there[str(before.rows.key[row])] for row in kept.tolist()]
    assert (after.rows.xyz[same] == before.rows.xyz[kept]).all()
    for name in ("WL 5", "WL 6"):
        ends = [hull.lines[name].points[0].position for hull in (bulk_carrier, found.hull)]
        assert abs(ends[0][0] - ends[1][0]) > 0.5
