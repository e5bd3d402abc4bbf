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

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.cells import CellKind

__all__ = ["changes", "edge_lines", "first_and_last", "kinds", "signs"]

Signs = NDArray[np.int8]


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


def _edges(dead: NDArray[np.bool_]) -> tuple[NDArray[np.bool_], ...]:
    return dead[:, 0], dead[:, -1], dead[:, :, 0], dead[:, :, -1]


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
    flat = len(b), b.shape[1] * b.shape[2]
    above = (b > err).reshape(flat).any(axis=1)
    below = (b < -err).reshape(flat).any(axis=1)
    found = np.where(above, 1, 0) - np.where(below, 1, 0)
    pure = np.flatnonzero(found)
    found[pure[_doubtful_edges(b[pure], err[pure], outer[pure])]] = CellKind.UNRESOLVED
    open_ = np.flatnonzero(above & below)
    found[open_] = _simple(b[open_], err[open_], outer[open_])
    return found


def _doubtful_edges(b: FloatArray, err: FloatArray, outer: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Tell where coefficients on a shared edge lie in the dead band."""
    dead = _edges(np.abs(b) <= err)
    lines = np.stack([edge.any(axis=1) for edge in dead], axis=1)
    return np.asarray((lines & ~outer.reshape(-1, 4)).any(axis=1))


def _doubtful_corners(
    b: FloatArray, err: FloatArray, outer: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """Tell where a corner at a shared edge lies in the dead band."""
    ends = np.ix_([0, b.shape[1] - 1], [0, b.shape[2] - 1])
    dead = np.abs(b[:, *ends]) <= err[:, *ends]
    alone = outer[:, 0, :, None] & outer[:, 1, None, :]
    return np.asarray((dead & ~alone).any(axis=(1, 2)))


def _simple(b: FloatArray, err: FloatArray, outer: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Tell what is proved where both signs occur."""
    u, u_size = _along(b, err)
    v, v_size = _along(b.swapaxes(1, 2), err.swapaxes(1, 2))
    over = (v == CellKind.U_SIMPLE) & (u == CellKind.U_SIMPLE) & (v_size > u_size)
    v = np.where(v == CellKind.U_SIMPLE, CellKind.V_SIMPLE, v)
    found = np.where((u == CellKind.UNRESOLVED) | over, v, u)
    found[_doubtful_corners(b, err, outer)] = CellKind.UNRESOLVED
    return found


def _along(b: FloatArray, err: FloatArray) -> tuple[NDArray[np.intp], FloatArray]:
    """Tell what the differences along the first axis of a cell prove, and how large they are."""
    found = np.full(len(b), int(CellKind.UNRESOLVED))
    size = np.zeros(len(b))
    step, wide = np.diff(b, axis=1), err[:, 1:] + err[:, :-1]
    monotone = (step > wide).all(axis=(1, 2)) | (step < -wide).all(axis=(1, 2))
    rows = np.flatnonzero(monotone)
    ends = signs(b[rows][:, [0, -1]], err[rows][:, [0, -1]])
    rows = rows[(changes(ends) <= 1).all(axis=1)]
    found[rows] = CellKind.U_SIMPLE
    size[rows] = np.abs(step[rows]).sum(axis=(1, 2))
    return found, size
