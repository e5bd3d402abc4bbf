"""What would be: a window that is faired, edits that somebody thinks of, a variant.

Each comes as a ghost of a copy of the hull, with what it does in figures: nothing is changed.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import attrs
import numpy as np

from assoc_hull.edit.shapes import joined
from assoc_hull.edit.step import EditReport
from assoc_hull.errors import BadInputError, RefusedEditError
from assoc_hull.hull.hull import Hull
from assoc_hull.model.objects import Point
from assoc_hull.page.wire import Frame, FrameKind

__all__ = ["Ghost", "ghost_of_edits", "ghost_of_variant", "ghost_of_window"]

_LEAST = 1e-4
"""Points that move less (m) are not counted."""


def ghost_of_window(
    hull: Hull, row: int, radius: tuple[float, float], noise: float
) -> tuple[Frame, dict[str, Any]]:
    """Fair a window of a copy: the curves that would be others, and what that does, or why not.

    Both are of the edit itself, tried on the copy: what is shown is what is made. Where it is
    refused, the window is shown to first order.
    """
    if row >= hull.state.rows.count or not hull.state.rows.alive[row]:
        raise BadInputError(f"there is no point {row}", "in a fair window", "reload the page")
    window = hull.fair_window(at=Point.of(hull.state, row), radius=radius)
    frame = window.to(noise=noise)
    number, before = hull.state_number, hull.hydrostatics(on_error="report", estimate=False)
    words = {"moved": int((np.abs(frame.displacement) > _LEAST).sum()), "points": len(frame.rows)}
    try:
        edit = window.commit().edit
    except RefusedEditError as error:
        shapes, state = frame.shapes, hull.state
        none = state.live("rows")[:0]
        ghost = Frame(FrameKind.GHOST, number, shapes.curves, shapes.spline, none,
                      state.rows.xyz[none])  # fmt: skip
        return ghost, {**words, "normal": None, "refused": list(error.findings)}
    after = hull.hydrostatics(on_error="report", estimate=False)
    return _changed_since(hull, number), {
        **words, "normal": _normal(edit), "volume_change": after.volume - before.volume,
        "lcb_change": after.lcb - before.lcb, "refused": [],
    }  # fmt: skip


def _changed_since(hull: Hull, number: int) -> Frame:
    """Show the curves of a copy that are others since a state."""
    state, changed = hull.state, hull.since(number).curves
    curves = changed[state.curves.alive[changed]]
    shapes = joined([state.spline(curve) for curve in curves.tolist()])
    none = state.live("rows")[:0]
    return Frame(FrameKind.GHOST, number, curves, shapes, none, state.rows.xyz[none])


def _normal(report: EditReport | None) -> float | None:
    """Give how far (m) an edit moves the hull off itself, as it is told when it is made."""
    normal = None if report is None else report.largest_normal
    return None if normal is None else normal.distance


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
    frame = Frame(FrameKind.GHOST, hull.state_number, found.shapes.curves, found.shapes.spline,
                  none, state.rows.xyz[none])  # fmt: skip
    return frame, {
        "normal": _normal(found.report), "moved": len(found.lines),
        "volume_change": found.volume_change, "lcb_change": found.lcb_change,
        "notes": list(found.report.notes), "refused": [],
    }  # fmt: skip


@attrs.frozen(eq=False)
class Ghost:
    """A variant to be shown: its curves that differ, and what it would be in words."""

    frame: Frame
    words: dict[str, Any]


def ghost_of_variant(copy: Hull, values: Mapping[str, float], *, accept: bool = False) -> Ghost:
    """Vary a copy of the hull, which is its variant afterwards; `accept` as of `Hull.vary`.

    Volume (m3) and LCB (m forward of AP) are those at the design draught.
    """
    number, before = copy.state_number, copy.hydrostatics()
    report = copy.vary(set=values, accept=accept, in_place=True).report
    after = copy.hydrostatics()
    return Ghost(_changed_since(copy, number), {
        "targets": [str(target) for target in report.targets],
        "normal": _normal(report.edit),
        "volume": after.volume, "volume_change": after.volume - before.volume,
        "lcb": after.lcb, "lcb_change": after.lcb - before.lcb,
        "notes": list(report.notes),
    })  # fmt: skip
