"""From tables to splines: what a batch of curves is made from, and the lofting of it."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import overload

import attrs
import numpy as np

from assoc_hull.geometry.curves import (
    CurveData,
    FloatArray,
    IntArray,
    PointKind,
    SplineBatch,
    freeze,
)
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.graph.derived import Objects
from assoc_hull.model.tables import Ends, HullState

__all__ = ["curve_data", "loft_curves", "remember"]

_KEPT = 16
"""So many batches are recalled."""


@attrs.frozen(eq=False)
class _Plan:
    """Where the data of a batch of curves lie."""

    start: IntArray
    row: IntArray
    part: IntArray
    end_kind: np.typing.NDArray[np.int8]
    end_vector: FloatArray
    nowhere: FloatArray
    """The directions where no point is given one."""


def remember(recall: dict[Hashable, object], key: Hashable, value: object) -> None:
    """Keep something, and let go of what was not kept again for the longest time."""
    recall.pop(key, None)
    recall[key] = value
    if len(recall) > _KEPT:
        del recall[next(iter(recall))]


def curve_data(state: HullState, curves: IntArray, *, keep: bool = False) -> CurveData:
    """Gather the defining points, kinds and end conditions of curves.

    Parameters
    ----------
    state : HullState
        The tables.
    curves : (m,) int
        Numbers of the curves.
    keep : bool
        Whether where the data of the batch lie is kept until the next time.

    Returns
    -------
    CurveData
        The curves in the order given.
    """
    table, numbers = state.curves, curves.tolist()
    rows = [table.rows.data[curve] for curve in numbers]
    side = [table.side.data[curve] for curve in numbers]
    ends = [table.ends.data[curve] for curve in numbers]
    if keep:
        held = Objects(rows), Objects(side), Objects(ends)
        key = ("recipe", curves.tobytes())
        plan = state.derived(key, held, lambda: _plan(rows, side, ends), most=_KEPT)
    else:
        plan = _plan(rows, side, ends)
    points = state.rows
    kind = points.kind.data.reshape(-1).take(plan.part)
    directed = bool((kind == PointKind.TANGENT).any())
    return CurveData(
        plan.start,
        points.xyz.data.take(plan.row, axis=0),
        kind,
        points.direction.data.reshape(-1, 3).take(plan.part, axis=0) if directed else plan.nowhere,
        plan.end_kind,
        plan.end_vector,
    )


def _plan(rows: list[IntArray], side: list[IntArray], ends: list[Ends]) -> _Plan:
    row = np.concatenate(rows)
    start = np.zeros(len(rows) + 1, np.int64)
    np.cumsum([len(part) for part in rows], out=start[1:])
    kind = np.array([end.kind for end in ends], np.int8)
    vector = np.array([end.vector for end in ends], np.float64)
    part = 2 * row + np.concatenate(side)
    nowhere = np.zeros((len(row), 3))
    freeze(start, row, part, kind, vector, nowhere)
    return _Plan(start, row, part, kind, vector, nowhere)


@attrs.frozen(eq=False)
class _Names(Sequence[str]):
    """What error messages call the curves; made when one is asked for."""

    state: HullState
    curves: IntArray

    def __len__(self) -> int:
        return len(self.curves)

    @overload
    def __getitem__(self, place: int) -> str: ...

    @overload
    def __getitem__(self, place: slice) -> Sequence[str]: ...

    def __getitem__(self, place: int | slice) -> str | Sequence[str]:
        if isinstance(place, slice):
            return _Names(self.state, self.curves[place])
        return self.state.curves.key[int(self.curves[place])]


def loft_curves(state: HullState, curves: IntArray, *, keep: bool = False) -> SplineBatch:
    """Loft curves from their defining points, in one batch; `keep` as for `curve_data`.

    Raises
    ------
    TooFewPointsError, CoincidentPointsError, BadInputError
        Naming the curve.
    """
    return loft(curve_data(state, curves, keep=keep), _Names(state, curves))
