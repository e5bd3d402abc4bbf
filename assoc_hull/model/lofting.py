"""From tables to splines: what a batch of curves is made from, and the lofting of it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import overload

import attrs
import numpy as np

from assoc_hull.geometry.curves import (
    CurveData,
    IntArray,
    SplineBatch,
)
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.model.address import AddressBook
from assoc_hull.model.tables import HullState

__all__ = ["curve_data", "loft_curves"]


def curve_data(state: HullState, curves: IntArray) -> CurveData:
    """Gather the defining points, kinds and end conditions of curves.

    Parameters
    ----------
    state : HullState
        The tables.
    curves : (m,) int
        Numbers of the curves.

    Returns
    -------
    CurveData
        The curves in the order given.
    """
    table, numbers = state.curves, curves.tolist()
    rows = [table.rows.data[curve] for curve in numbers]
    ends = [table.ends.data[curve] for curve in numbers]
    row, start = np.concatenate(rows), np.zeros(len(rows) + 1, np.int64)
    np.cumsum([len(part) for part in rows], out=start[1:])
    part = 2 * row + np.concatenate([table.side.data[curve] for curve in numbers])
    points = state.rows
    return CurveData(
        start,
        points.xyz.data.take(row, axis=0),
        points.kind.data.reshape(-1).take(part),
        points.direction.take_parts(part),
        np.array([end.kind for end in ends], np.int8),
        np.array([end.vector for end in ends], np.float64),
    )


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
        return AddressBook(self.state).curve_name(int(self.curves[place]))


def loft_curves(state: HullState, curves: IntArray) -> SplineBatch:
    """Loft curves from their defining points, in one batch.

    Raises
    ------
    TooFewPointsError, CoincidentPointsError, BadInputError
        Naming the curve.
    """
    return loft(curve_data(state, curves), _Names(state, curves))
