"""Springs between neighbours of a grid on a surface: along, across and on both diagonals.

The length of a spring is that of the geodesic between its ends, not of the chord. With c the
chord and d the normal distance of the surface from its middle

    length = c + 8 d**2 / (3 c)

which is exact but for the fourth power of the step. A chord would make every curved plate a
little too small, and unevenly where rulings run askew to the grid.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.surface.plates.springs import springs_of
>>> fine = np.zeros((5, 3, 3))
>>> fine[..., 0], fine[..., 1] = np.mgrid[0:5, 0:3] / 2.0
>>> springs_of(fine).along
array([[1., 1.],
       [1., 1.]])
"""

from __future__ import annotations

from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = ["Springs", "springs_of"]

_SHORT = 1e-7
"""A spring below this part of the mean joins points that are one, as at a pole."""


@attrs.frozen(eq=False)
class Springs:
    """The springs of a grid of r by c nodes; node (i, j) has the number i c + j.

    Attributes
    ----------
    along : (r - 1, c), m
        Length from (i, j) to (i + 1, j).
    across : (r, c - 1), m
        Length from (i, j) to (i, j + 1).
    falling : (r - 1, c - 1), m
        Length from (i, j) to (i + 1, j + 1).
    rising : (r - 1, c - 1), m
        Length from (i + 1, j) to (i, j + 1).
    cell : (r - 1, c - 1), m2
        Area of each cell.
    """

    along: FloatArray
    across: FloatArray
    falling: FloatArray
    rising: FloatArray
    cell: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.along, self.across, self.falling, self.rising, self.cell)

    @property
    def shape(self) -> tuple[int, int]:
        """The numbers of nodes along and across."""
        return self.across.shape[0], self.along.shape[1]

    @property
    def length(self) -> FloatArray:
        """All lengths (s,), m: along, across, falling, rising."""
        return _in_a_row(self.along, self.across, self.falling, self.rising)

    @property
    def ends(self) -> IntArray:
        """The nodes that each spring joins, (2, s)."""
        node = np.arange(self.along.shape[1] * self.across.shape[0]).reshape(self.shape)
        first = _in_a_row(node[:-1], node[:, :-1], node[:-1, :-1], node[1:, :-1])
        second = _in_a_row(node[1:], node[:, 1:], node[1:, 1:], node[:-1, 1:])
        return np.stack([first, second])

    @property
    def weight(self) -> FloatArray:
        """The area that each spring stands for, (s,), m2: half of each cell beside it."""
        along, across = np.zeros_like(self.along), np.zeros_like(self.across)
        along[:, :-1] += 0.5 * self.cell
        along[:, 1:] += 0.5 * self.cell
        across[:-1] += 0.5 * self.cell
        across[1:] += 0.5 * self.cell
        return _in_a_row(along, across, self.cell, self.cell)

    @property
    def short(self) -> NDArray[np.bool_]:
        """Which join points that are one, (s,) bool."""
        length = self.length
        return np.asarray(length <= _SHORT * length.mean())

    def parted(self, values: FloatArray) -> tuple[FloatArray, ...]:
        """Give values of all springs (s,) as arrays of along, across, falling, rising."""
        (r, c), found, at = self.shape, [], 0
        for shape in ((r - 1, c), (r, c - 1), (r - 1, c - 1), (r - 1, c - 1)):
            size = shape[0] * shape[1]
            found.append(values[at : at + size].reshape(shape))
            at += size
        return tuple(found)


def springs_of(fine: FloatArray) -> Springs:
    """Give the springs of every other point of a fine grid.

    Parameters
    ----------
    fine : (2r - 1, 2c - 1, 3), m
        Points of the surface; those between the nodes tell how it bends there.

    Returns
    -------
    Springs
        Lengths and areas.
    """
    normal = _normals(fine)
    node = fine[::2, ::2]
    middle, there = fine[1::2, 1::2], normal[1::2, 1::2]
    return Springs(
        along=_lengths(node[:-1], node[1:], fine[1::2, ::2], normal[1::2, ::2]),
        across=_lengths(node[:, :-1], node[:, 1:], fine[::2, 1::2], normal[::2, 1::2]),
        falling=_lengths(node[:-1, :-1], node[1:, 1:], middle, there),
        rising=_lengths(node[1:, :-1], node[:-1, 1:], middle, there),
        cell=_cells(fine),
    )


def _in_a_row(*parts: NDArray[Any]) -> NDArray[Any]:
    """Lay arrays of along, across, falling, rising one behind the other."""
    found: NDArray[Any] = np.concatenate([part.ravel() for part in parts])
    return found


def _normals(fine: FloatArray) -> FloatArray:
    """Give unit normals at all points of a grid; nil where there is none."""
    normal = np.cross(np.gradient(fine, axis=0), np.gradient(fine, axis=1))
    size = np.linalg.norm(normal, axis=-1, keepdims=True)
    return np.asarray(np.divide(normal, size, out=np.zeros_like(normal), where=size > 0.0))


def _lengths(
    start: FloatArray, end: FloatArray, middle: FloatArray, normal: FloatArray
) -> FloatArray:
    """Give geodesic lengths from chords and what the surface stands off their middles."""
    chord = np.linalg.norm(end - start, axis=-1)
    off = ((middle - 0.5 * (start + end)) * normal).sum(axis=-1)
    more = np.divide(8.0 * off**2, 3.0 * chord, out=np.zeros_like(chord), where=chord > 0.0)
    return np.asarray(chord + more)


def _cells(fine: FloatArray) -> FloatArray:
    """Give the area of each cell: its own quadrangle and the four in it, extrapolated."""
    four = _quadrangles(fine)
    r, c = four.shape
    sums = four.reshape(r // 2, 2, c // 2, 2).sum(axis=(1, 3))
    return np.asarray((4.0 * sums - _quadrangles(fine[::2, ::2])) / 3.0)


def _quadrangles(place: FloatArray) -> FloatArray:
    """Give half the cross products of the diagonals of all cells of a grid, m2."""
    one, other = place[1:, 1:] - place[:-1, :-1], place[:-1, 1:] - place[1:, :-1]
    return np.asarray(0.5 * np.linalg.norm(np.cross(one, other), axis=-1))
