"""What panels of fairing and variation ask of a copy of the hull: lists, and what would be.

Where lines are wavy, which parameters there are; a window that is faired, edits that somebody
thinks of, and a variant come as ghosts: nothing is changed.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import attrs
import numpy as np

from assoc_hull.edit.shapes import joined
from assoc_hull.errors import BadInputError, RefusedEditError
from assoc_hull.hull.hull import Hull
from assoc_hull.model.objects import Point
from assoc_hull.page.wire import Frame, FrameKind
from assoc_hull.variation.carrying.admissible_values import list_parameters

__all__ = [
    "Ghost", "describe_fairness", "describe_parameters", "ghost_of_edits", "ghost_of_variant",
    "ghost_of_window",
]  # fmt: skip

_LINES, _POINTS = 15, 10
_LEAST = 1e-4
"""Points that move less (m) are not counted."""


def describe_fairness(hull: Hull) -> dict[str, Any]:
    """Give the waviest lines first, how far (m) battens spring there, and points out of line."""
    found = hull.fairness()
    wavy = [
        (record, batten) for record, batten in zip(found.records, found.battens, strict=True)
        if batten is not None
    ]  # fmt: skip
    wavy.sort(key=lambda each: (-each[1].ratio, -each[1].largest, each[0].name))
    lines = [
        {"line": record.name, "springs": abs(batten.there), "ratio": batten.ratio, "at": batten.at,
         "inflections": record.inflections} for record, batten in wavy[:_LINES]
    ]  # fmt: skip
    doctor = hull.doctor(top=_POINTS)
    return {
        "lines": lines,
        "unfair": [
            {"line": each.line, "point": each.point, "residual": each.residual,
             "ratio": each.ratio} for each in found.unfair[:_POINTS]
        ],
        "points": [
            {"point": each.point, "off": each.off, "score": each.score, "alarm": each.alarm}
            for each in doctor.findings[:_POINTS]
        ],
    }  # fmt: skip


def ghost_of_window(
    hull: Hull, row: int, radius: tuple[float, float], noise: float
) -> tuple[Frame, dict[str, Any]]:
    """Fair a window of a copy as a hand at a slider does: to first order, nothing is published.

    What it does to volume (m3) and LCB (m) is told by the edit itself, tried on the copy.
    """
    if row >= hull.state.rows.count or not hull.state.rows.alive[row]:
        raise BadInputError(f"there is no point {row}", "in a fair window", "reload the page")
    window = hull.fair_window(at=Point.of(hull.state, row), radius=radius)
    frame = window.to(noise=noise)
    most = float(np.abs(frame.displacement).max(initial=0.0))
    shapes, state = frame.shapes, hull.state
    none = state.live("rows")[:0]
    ghost = Frame(FrameKind.GHOST, hull.state_number, shapes.curves, shapes.spline, none,
                  state.rows.xyz[none])  # fmt: skip
    before = hull.hydrostatics(on_error="report", estimate=False)
    words = {"normal": most, "moved": int((np.abs(frame.displacement) > _LEAST).sum()),
             "points": len(frame.rows)}  # fmt: skip
    try:
        window.commit()
    except RefusedEditError as error:
        return ghost, {**words, "refused": list(error.findings)}
    after = hull.hydrostatics(on_error="report", estimate=False)
    return ghost, {**words, "volume_change": after.volume - before.volume,
                   "lcb_change": after.lcb - before.lcb, "refused": []}  # fmt: skip


def ghost_of_edits(
    hull: Hull, edits: Sequence[Mapping[str, object]]
) -> tuple[Frame, dict[str, Any]]:
    """Try edits on a copy: the curves that would be others, and what that does, or why not."""
    found = hull.preview(edits, shapes=True, measure="about")
    state = hull.state
    none = state.live("rows")[:0]
    if found.refused or found.shapes is None or found.report is None:
        nothing = Frame(FrameKind.GHOST, hull.state_number, none, joined(()), none,
                        state.rows.xyz[none])  # fmt: skip
        return nothing, {"refused": list(found.refused)}
    normal = found.report.largest_normal
    frame = Frame(FrameKind.GHOST, hull.state_number, found.shapes.curves, found.shapes.spline,
                  none, state.rows.xyz[none])  # fmt: skip
    return frame, {
        "normal": None if normal is None else normal.distance, "moved": len(found.lines),
        "volume_change": found.volume_change, "lcb_change": found.lcb_change,
        "notes": list(found.report.notes), "refused": [],
    }  # fmt: skip


@attrs.frozen(eq=False)
class Ghost:
    """A variant to be shown: its curves that differ, and what it would be in words."""

    frame: Frame
    words: dict[str, Any]


def describe_parameters(hull: Hull, of: str | None = None) -> list[dict[str, Any]]:
    """Give the named parameters of a hull: value, unit, or the reason for none; limits of one."""
    return [
        {"name": each.name, "unit": each.unit, "meaning": each.meaning, "value": each.value,
         "low": each.fair_low, "high": each.fair_high, "reason": each.reason}
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
