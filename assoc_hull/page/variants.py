"""What the panel of named parameters asks of a copy of the hull: a list, and a variant to show."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import attrs

from assoc_hull.edit.shapes import joined
from assoc_hull.hull.hull import Hull
from assoc_hull.page.wire import Frame, FrameKind
from assoc_hull.variation.carrying.admissible_values import list_parameters

__all__ = ["Ghost", "describe_parameters", "ghost_of_variant"]


@attrs.frozen(eq=False)
class Ghost:
    """A variant to be shown: its curves that differ, and what it would be in words."""

    frame: Frame
    words: dict[str, Any]


def describe_parameters(hull: Hull, of: str | None = None) -> list[dict[str, Any]]:
    """Give the named parameters of a hull: value, unit, or the reason for none; limits of one."""
    return [
        {"name": each.name, "unit": each.unit, "meaning": each.meaning, "value": each.value,
         "low": each.low, "high": each.high, "reason": each.reason}
        for each in list_parameters(hull.state, limits=() if of is None else (of,))
    ]  # fmt: skip


def ghost_of_variant(copy: Hull, values: Mapping[str, float]) -> Ghost:
    """Vary a copy of the hull, which is its variant afterwards.

    Volume (m3) and LCB (m forward of AP) are those at the design draught.
    """
    number, before = copy.state_number, copy.hydrostatics()
    report = copy.vary(set=values, in_place=True).report
    after, state = copy.hydrostatics(), copy.state
    changed = copy.since(number).curves
    curves = changed[state.curves.alive[changed]]
    shapes = joined([state.spline(curve) for curve in curves.tolist()])
    none = state.live("rows")[:0]
    frame = Frame(FrameKind.GHOST, number, curves, shapes, none, state.rows.xyz[none])
    normal = report.edit.largest_normal
    return Ghost(frame, {
        "targets": [str(target) for target in report.targets],
        "normal": None if normal is None else normal.distance,
        "volume": after.volume, "volume_change": after.volume - before.volume,
        "lcb": after.lcb, "lcb_change": after.lcb - before.lcb,
        "notes": list(report.notes),
    })  # fmt: skip
