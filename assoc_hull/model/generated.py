"""Which points come from definitions now: those of generated curves that are attached.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.model.generated import attached, attached_rows
>>> state = wigley(stations=5, waterlines=4)
>>> dict(attached(state)), attached_rows(state).tolist()
({}, [])
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from assoc_hull.geometry.curves import IntArray, freeze
from assoc_hull.model.definition_part import GeneratedCurve
from assoc_hull.model.lofting import same_objects
from assoc_hull.model.state import HullState

__all__ = ["attached", "attached_rows", "generated_on", "kept_rows", "unmade_rows"]

_Known = tuple[list[object], Mapping[int, GeneratedCurve], IntArray, IntArray]


def attached(state: HullState) -> Mapping[int, GeneratedCurve]:
    """Give the attached generated curves by the number of the curve, in that order."""
    return _known(state)[1]


def attached_rows(state: HullState) -> IntArray:
    """Give the points that are computed from definitions, ascending."""
    return _known(state)[2]


def kept_rows(state: HullState) -> IntArray:
    """Give the points that are computed from definitions, or were until their curve was edited.

    They ride with no other point: what was drawn by hand keeps its shape.
    """
    return _known(state)[3]


def generated_on(state: HullState, curve: int) -> GeneratedCurve | None:
    """Give what is known of a curve that comes, or came, from definitions; else None."""
    found = [each for each in state.generated if each.curve == curve]
    return found[0] if found else None


def unmade_rows(state: HullState, rows: IntArray) -> np.typing.NDArray[np.bool_]:
    """Tell for each of some points whether no definition computes it."""
    mine = attached_rows(state)
    if not len(mine):
        return np.ones(len(rows), np.bool_)
    found: np.typing.NDArray[np.bool_] = ~np.isin(rows, mine)
    return found


def _known(state: HullState) -> _Known:
    """Look the table through; what was found last holds as long as its objects do."""
    table = state.produced
    objects = [
        curve if alive else None
        for curve, alive in zip(table.curve.data, table.alive.data.tolist(), strict=True)
    ]
    known: _Known | None = state.kept.get("attached")
    if known is None or not same_objects(known[0], objects):
        curves = {each.curve: each for each in objects if each is not None and each.attached}
        rows = np.array(sorted(row for each in curves.values() for row in each.rows), np.int64)
        every = [row for each in objects if isinstance(each, GeneratedCurve) for row in each.rows]
        kept = np.array(sorted(every), np.int64)
        freeze(rows, kept)
        known = objects, dict(sorted(curves.items())), rows, kept
        state.kept["attached"] = known
    return known
