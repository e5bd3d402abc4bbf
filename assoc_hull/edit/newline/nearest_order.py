"""Putting marks of an unknown line in order: from an end, always to the nearest one left."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["chain"]


def chain(xyz: FloatArray, is_end: np.typing.NDArray[np.bool_], axis: int) -> list[IntArray]:
    """Order marks into connected pieces.

    Parameters
    ----------
    xyz : (k, 3), m
        The marks.
    is_end : (k,) bool
        Marks at which a piece ends.
    axis : int
        Pieces begin at the end with the lower coordinate along this axis.

    Returns
    -------
    list of (n,) int
        The pieces, the one with the lowest beginning first. Without ends, one piece from
        the lowest mark. Ties by the order given.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.edit.newline.nearest_order import chain
    >>> marks = np.array([[3.0, 0, 0], [0, 0, 0], [1, 1, 0], [2, 1, 0]])
    >>> [piece.tolist() for piece in chain(marks, np.array([True, True, False, False]), 0)]
    [[1, 2, 3, 0]]
    """
    left = np.ones(len(xyz), bool)
    pieces: list[IntArray] = []
    while left.any():
        starts = np.flatnonzero(left & is_end)
        if not len(starts):
            if pieces:
                break
            starts = np.flatnonzero(left)
        at = int(starts[np.argmin(xyz[starts, axis])])
        pieces.append(_walk(xyz, is_end, left, at))
    return [piece for piece in pieces if len(piece) > 1]


def _walk(
    xyz: FloatArray,
    is_end: np.typing.NDArray[np.bool_],
    left: np.typing.NDArray[np.bool_],
    at: int,
) -> IntArray:
    """Walk from a mark to the nearest one left, until an end or the last mark."""
    piece = [at]
    left[at] = False
    while left.any():
        rest = np.flatnonzero(left)
        step = xyz[rest] - xyz[at]
        at = int(rest[np.argmin((step * step).sum(axis=1))])
        piece.append(at)
        left[at] = False
        if is_end[at]:
            break
    return np.array(piece, np.int64)
