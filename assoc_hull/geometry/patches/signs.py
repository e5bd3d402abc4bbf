"""Signs of Bernstein coefficients that are known to some error, and what follows from them.

A coefficient has a sign where it exceeds its error; else it lies in the *dead band* and has none.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.signs import changes, signs
>>> s = signs(np.array([[2.0, 1e-9, -1.0, -2.0]]), np.array([[1e-6, 1e-6, 1e-6, 1e-6]]))
>>> s.tolist(), changes(s).tolist()
([[1, 0, -1, -1]], [1])
"""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.cells import CellKind

__all__ = ["changes", "edge_lines", "first_and_last", "kinds", "signs"]

Signs = NDArray[np.int8]
_Scalar = TypeVar("_Scalar", bound=np.generic)


def signs(b: FloatArray, err: FloatArray) -> Signs:
    """Give 1 above the dead band, -1 below it, 0 within."""
    return np.asarray((b > err).astype(np.int8) - (b < -err).astype(np.int8))


def carried(s: Signs) -> Signs:
    """Give each coefficient in the dead band the sign of the one before it, if any."""
    place = np.where(s != 0, np.arange(s.shape[-1]), 0)
    return np.take_along_axis(s, np.maximum.accumulate(place, axis=-1), axis=-1)


def changes(s: Signs) -> NDArray[np.intp]:
    """Count the changes of sign along the last axis; the dead band is passed over."""
    full = carried(s)
    return np.asarray(np.count_nonzero(full[..., 1:] * full[..., :-1] < 0, axis=-1))


def first_and_last(s: Signs) -> tuple[Signs, Signs]:
    """Give the first and the last sign along the last axis; 0 where there is none."""
    full, back = carried(s), carried(s[..., ::-1])
    return back[..., -1], full[..., -1]


def edge_lines(b: FloatArray, err: FloatArray) -> NDArray[np.bool_]:
    """Tell on which edges of its square a polynomial is nil.

    Parameters
    ----------
    b, err : (k, M + 1, N + 1)
        Coefficients and their errors.

    Returns
    -------
    (k, 4) bool
        Whether all coefficients on the edges u = 0, u = 1, v = 0, v = 1 lie in the dead band.
    """
    return np.stack([edge.all(axis=1) for edge in _edges(signs(b, err) == 0)], axis=1)


def _edges(a: NDArray[_Scalar]) -> tuple[NDArray[_Scalar], ...]:
    """Give the coefficients on the edges u = 0, u = 1, v = 0 and v = 1."""
    return a[:, 0], a[:, -1], a[:, :, 0], a[:, :, -1]


def kinds(b: FloatArray, err: FloatArray, outer: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Tell what the coefficients prove of the signs in a cell.

    Coefficients of one sign prove that the polynomial has it. Where all differences in u have one
    sign, beyond their error, and each of the edges u = 0 and u = 1 changes sign at most once, a
    line v = constant meets the zero set at most once, no loop has room, and there is one arc.

    Coefficients in the dead band prove nothing on an edge that is shared with another cell: the
    two might see an arc cross it in one and not in the other. Elsewhere they do no harm.

    Parameters
    ----------
    b, err : (c, M + 1, N + 1)
        Coefficients and their errors.
    outer : (c, 2, 2) bool
        Whether the edges u = 0, u = 1 and v = 0, v = 1 of a cell are shared with no other.

    Returns
    -------
    (c,) int
        A `CellKind` each; UNRESOLVED where nothing is proved.
    """
    least, most = b - err, b + err
    flat = len(b), b.shape[1] * b.shape[2]
    above = (least > 0.0).reshape(flat).any(axis=1)
    below = (most < 0.0).reshape(flat).any(axis=1)
    found = np.where(above, 1, 0) - np.where(below, 1, 0)
    pure = np.flatnonzero(found)
    found[pure[_doubtful_edges(least[pure], most[pure], outer[pure])]] = CellKind.UNRESOLVED
    open_ = np.flatnonzero(above & below)
    found[open_] = _simple(least[open_], most[open_], outer[open_])
    return found


def _doubtful_edges(
    least: FloatArray, most: FloatArray, outer: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """Tell where coefficients on a shared edge lie in the dead band."""
    lines = [
        ((low <= 0.0) & (high >= 0.0)).any(axis=1)
        for low, high in zip(_edges(least), _edges(most), strict=True)
    ]
    return np.asarray((np.stack(lines, axis=1) & ~outer.reshape(-1, 4)).any(axis=1))


def _doubtful_corners(
    least: FloatArray, most: FloatArray, outer: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """Tell where a corner at a shared edge lies in the dead band."""
    corners = np.ix_([0, least.shape[1] - 1], [0, least.shape[2] - 1])
    dead = (least[:, *corners] <= 0.0) & (most[:, *corners] >= 0.0)
    alone = outer[:, 0, :, None] & outer[:, 1, None, :]
    return np.asarray((dead & ~alone).any(axis=(1, 2)))


def _simple(least: FloatArray, most: FloatArray, outer: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Tell what is proved where both signs occur: simple the way the polynomial changes more."""
    u = _change(least, most)
    v = _change(least.swapaxes(1, 2), most.swapaxes(1, 2))
    found = np.where(v > u, int(CellKind.V_SIMPLE), int(CellKind.U_SIMPLE))
    found[np.maximum(u, v) < 0.0] = CellKind.UNRESOLVED
    found[_doubtful_corners(least, most, outer)] = CellKind.UNRESOLVED
    return found


def _change(least: FloatArray, most: FloatArray) -> FloatArray:
    """Tell how much cells change along their first axis; -1 where they are not simple that way.

    Most cells that are not are known by their first column.
    """
    found = np.full(len(least), -1.0)
    rows = np.flatnonzero(_monotone(least[:, :, :1], most[:, :, :1]))
    rows = rows[_monotone(least[rows], most[rows])]
    low, high = least[rows][:, [0, -1]], most[rows][:, [0, -1]]
    once = (changes((low > 0.0).astype(np.int8) - (high < 0.0).astype(np.int8)) <= 1).all(axis=1)
    low, high = low[once], high[once]
    found[rows[once]] = np.abs(low[:, 1] + high[:, 1] - low[:, 0] - high[:, 0]).sum(axis=1)
    return found


def _monotone(least: FloatArray, most: FloatArray) -> NDArray[np.bool_]:
    """Tell which cells rise, or fall, along their first axis by more than their errors."""
    rising = (least[:, 1:] > most[:, :-1]).all(axis=(1, 2))
    return np.asarray(rising | (most[:, 1:] < least[:, :-1]).all(axis=(1, 2)))
