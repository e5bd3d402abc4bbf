"""Points at equal steps along pieces of curves, from node to node."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.geometry.splines.evaluation import evaluate

__all__ = ["Pieces", "measured_pieces"]

_CHORDS = 24
"""Chords by which the length along a piece of a curve is measured."""


@attrs.frozen(eq=False)
class Pieces:
    """Pieces of curves between nodes, measured along their chords.

    Curves that pass one another by a gap have their node on one of them only; pieces of the
    others are moved there, by less and less towards their other end.

    Attributes
    ----------
    batch : SplineBatch
        The curves.
    curve : (e,) int
        The curve of each piece.
    at : (e, s), m
        Parameters on it, at even steps from one end to the other.
    along : (e, s), m
        How far along the piece they lie.
    shift : (e, 2, 3), m
        From the ends of the pieces to their nodes.
    """

    batch: SplineBatch
    curve: IntArray
    at: FloatArray
    along: FloatArray
    shift: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.curve, self.at, self.along, self.shift)

    @property
    def length(self) -> FloatArray:
        """The length of each piece, (e,), m."""
        return self.along[:, -1]

    def chosen(self, which: IntArray) -> Pieces:
        """Give some of the pieces."""
        curve, at, along, shift = self.curve, self.at, self.along, self.shift
        return Pieces(self.batch, curve[which], at[which], along[which], shift[which])

    def points(self, part: FloatArray) -> FloatArray:
        """Give points on the pieces.

        Parameters
        ----------
        part : (k,) or (e, k)
            How far along each of them, from 0 to 1 of its length.

        Returns
        -------
        (e, k, 3), m
            The points; the ends are the nodes but for rounding.
        """
        part = np.broadcast_to(part, (len(self.curve), np.shape(part)[-1]))
        t = self._parameters(part)
        place = evaluate(self.batch, self.curve.repeat(t.shape[1]), t.ravel())
        first, last = (1.0 - part)[..., None], part[..., None]
        moved = first * self.shift[:, None, 0] + last * self.shift[:, None, 1]
        return np.asarray(place.reshape(*t.shape, 3) + moved)

    def _parameters(self, part: FloatArray) -> FloatArray:
        """Give the parameters at parts of the length of each piece, (e, k), m."""
        wanted = part * self.along[:, -1:]
        after = (self.along[:, None, :] <= wanted[:, :, None]).sum(axis=2)
        after = np.clip(after, 1, self.along.shape[1] - 1)
        row = np.arange(len(part))[:, None]
        low, high = self.along[row, after - 1], self.along[row, after]
        share = np.divide(wanted - low, high - low, out=np.zeros_like(low), where=high > low)
        begin, finish = self.at[row, after - 1], self.at[row, after]
        return np.asarray(np.where(share >= 1.0, finish, begin + (finish - begin) * share))


def measured_pieces(batch: SplineBatch, curve: IntArray, t: FloatArray, ends: FloatArray) -> Pieces:
    """Measure pieces of curves.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    curve : (e,) int
        The curve of each piece.
    t : (e, 2), m
        Where it begins and ends on it.
    ends : (e, 2, 3), m
        The nodes that it runs between.

    Returns
    -------
    Pieces
        Lengths are those of 24 chords.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.surface.cells.edge_points import measured_pieces
    >>> xyz = np.array([[0.0, 0, 0], [4, 0, 0]])
    >>> along = np.array([[1.0, 0, 0], [1, 0, 0]])
    >>> line = SplineBatch(np.array([0, 2]), np.array([0.0, 4]), xyz, along, along.copy())
    >>> end = np.array([[[1.0, 0, 0], [3, 0, 0]]])
    >>> piece = measured_pieces(line, np.array([0]), np.array([[1.0, 3.0]]), end)
    >>> piece.length.tolist(), piece.points(np.array([0.5])).tolist()
    ([2.0], [[[2.0, 0.0, 0.0]]])
    """
    at = t[:, :1] + (t[:, 1:] - t[:, :1]) * np.linspace(0.0, 1.0, _CHORDS + 1)
    at[:, -1] = t[:, 1]
    place = evaluate(batch, curve.repeat(at.shape[1]), at.ravel()).reshape(*at.shape, 3)
    step = np.diff(place, axis=1)
    along = np.zeros(at.shape)
    np.cumsum(np.sqrt(dot(step, step)), axis=1, out=along[:, 1:])
    return Pieces(batch, curve.copy(), at, along, ends - place[:, [0, -1]])
