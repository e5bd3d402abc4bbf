"""What the panel of the history asks: the steps with their authors, and the hull as it was then.

A state of the past is found on the document itself, in its worker: the tables walk there and back.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from assoc_hull.edit.document import Document
from assoc_hull.edit.explain.compare_states import compare_states, state_at
from assoc_hull.edit.hull_normals import normals_at
from assoc_hull.edit.shapes import joined
from assoc_hull.errors import BadInputError
from assoc_hull.model.tables import HullState
from assoc_hull.page.wire import Frame, FrameKind

__all__ = [
    "describe_steps", "ghost_of_step", "movements_of_step", "require_own_steps", "require_step",
    "state_of_step",
]  # fmt: skip

_MOST = 200
"""So many steps are listed, the newest ones."""


def describe_steps(document: Document) -> dict[str, Any]:
    """Give the steps of all branches, oldest first, where the hull is, and what states are called.

    ``way`` is -1 of a step that was taken back and 1 of one that the hull has gone; 0 lies on a
    branch. ``normal`` is the largest movement, m, or None.
    """
    done = {each.number for each in document.history}
    undone = {each.number for each in document.undone}
    steps = sorted(document.steps.values(), key=lambda each: each.number)
    found = []
    for each in steps[-_MOST:]:
        report, way = each.report, 1 if each.number in done else -1 if each.number in undone else 0
        normal = report.largest_normal
        found.append({
            "number": each.number, "parent": each.parent, "name": each.name, "way": way,
            "author": report.author, "time": report.time,
            "normal": None if normal is None else normal.distance,
        })  # fmt: skip
    return {
        "head": document.head, "steps": found, "older": max(len(steps) - _MOST, 0),
        "labels": [{"name": each.name, "step": each.step} for each in document.labels.values()],
    }  # fmt: skip


def require_step(document: Document, number: int, act: str) -> None:
    """Refuse a step that there is not."""
    if number and number not in document.steps:
        what, remedy = f"there is no step {number}", "list the history again"
        raise BadInputError(what, f"in {act}", remedy)


def require_own_steps(document: Document, number: int, author: str) -> None:
    """Refuse to go back over edits of others: who goes takes back own ones only."""
    kept = {each.number for each in document.path(number)}
    others = [each for each in document.history if each.number not in kept]
    theirs = [each.report for each in others if each.report.author != author]
    if theirs:
        last = theirs[-1]
        who = last.author or "nobody who signed it"
        what = f"{len(theirs)} edits on the way are not yours, the last is {last.name!r} of {who}"
        remedy = "compare with that state, or ask for them to be undone"
        raise BadInputError(what, "in going back", remedy)


def state_of_step(document: Document, number: int) -> HullState:
    """Give the hull as it was after a step, as a copy for a reader."""
    require_step(document, number, "comparing")
    return state_at(document, number)


def movements_of_step(document: Document, number: int) -> dict[str, tuple[float, float]]:
    """Give by key how far (m) a step moved points off the hull, and how far they slid on it.

    A curve has the largest movement of its points, and no slide.
    """
    now = state_at(document, number)
    then = state_at(document, document.steps[number].parent)
    both = np.intersect1d(then.live("rows"), now.live("rows"))
    way = now.rows.xyz[both] - then.rows.xyz[both]
    rows, way = both[way.any(axis=1)], way[way.any(axis=1)]
    normal, size = normals_at(now, rows), np.linalg.norm(way, axis=1)
    # Where no normal is known all of it is movement.
    off = np.where(normal.any(axis=1), np.abs((way * normal).sum(axis=1)), size)
    slid = np.sqrt(np.maximum(size**2 - off**2, 0.0))
    found = dict[str, tuple[float, float]]()
    for row, one, other in zip(rows.tolist(), off.tolist(), slid.tolist(), strict=True):
        found[str(now.rows.key[row])] = one, other
        for curve in now.rows.curve[row].tolist():
            if curve >= 0:
                key = str(now.curves.key[curve])
                found[key] = max(one, found.get(key, (0.0, 0.0))[0]), 0.0
    return found


def ghost_of_step(then: HullState, now: HullState) -> tuple[Frame, dict[str, Any]]:
    """Give the curves of an earlier state that are others now, and what differs in words."""
    curves = then.live("curves")
    differs = [curve for curve in curves.tolist() if not _same(then, now, curve)]
    shapes = joined([then.spline(curve) for curve in differs])
    none = now.live("rows")[:0]
    frame = Frame(FrameKind.GHOST, now.number, np.array(differs, np.int64), shapes,
                  none, now.rows.xyz[none])  # fmt: skip
    found = compare_states(then, now, ("then", "now"))
    volume, lcb = (found.numbers.get(each) for each in ("volume", "lcb"))
    return frame, {
        "lines": [str(each) for each in found.lines[:12]], "count": len(found.lines),
        "volume": None if volume is None else list(volume),
        "lcb": None if lcb is None else list(lcb),
    }  # fmt: skip


def _same(then: HullState, now: HullState, curve: int) -> bool:
    """Whether a curve is the same in both, to the bit."""
    if curve >= now.curves.count or not now.curves.alive[curve]:
        return False
    old, new = then.spline(curve), now.spline(curve)
    return all(
        np.array_equal(getattr(old, each), getattr(new, each))
        for each in ("xyz", "leave", "arrive")
    )
