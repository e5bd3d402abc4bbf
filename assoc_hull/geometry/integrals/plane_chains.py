"""Chains of cubics in a plane: curves put end to end, cut, mirrored and closed.

A chain is what is left of a curve when only two of its coordinates, u and v, are looked at. One
cubic begins where the one before it ends.
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.integrals.beside import beside, runs
from assoc_hull.geometry.numeric.polynomials import differentiate, horner
from assoc_hull.geometry.splines.paths import stretch
from assoc_hull.geometry.splines.segments import power

__all__ = ["PlaneChains", "backward", "cut", "ends_of", "joined", "loop", "mirrored", "straight"]

_NIL = 1e-12  # m: a shorter straight line is left out


@attrs.frozen(eq=False)
class PlaneChains:
    """Several chains, one behind the other.

    Attributes
    ----------
    start : (m + 1,) int
        Where each chain begins.
    cubic : (p, 4, 2), m
        Coefficients of 1, t, t^2, t^3 of u and v, t from 0 to 1 along each cubic.
    """

    start: IntArray
    cubic: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.start, self.cubic)

    @property
    def count(self) -> int:
        """Number of chains."""
        return len(self.start) - 1

    @property
    def owner(self) -> IntArray:
        """The chain of each cubic, (p,)."""
        return np.repeat(np.arange(self.count, dtype=np.int64), np.diff(self.start))

    @classmethod
    def of(cls, batch: SplineBatch, axes: tuple[int, int]) -> Self:
        """Take two coordinates (0 for x, 1 for y, 2 for z) of curves."""
        start = batch.start - np.arange(batch.count + 1)
        return cls(start, np.ascontiguousarray(power(batch)[:, :, list(axes)]))

    @classmethod
    def single(cls, cubic: FloatArray) -> Self:
        """Take one chain, (p, 4, 2)."""
        return cls(np.array([0, len(cubic)], np.int64), cubic.copy())

    @property
    def ends(self) -> FloatArray:
        """First and last point of each chain, (m, 2, 2), m."""
        first = self.cubic[self.start[:-1], 0]
        return np.stack([first, self.cubic[self.start[1:] - 1].sum(axis=1)], axis=1)

    def at(self, t: FloatArray) -> FloatArray:
        """Give the places at parameters t (n,) of every cubic, (p, n, 2), m."""
        return _at(self.cubic, t)

    def slope(self, t: FloatArray) -> FloatArray:
        """Give the derivatives by t at parameters t (n,) of every cubic, (p, n, 2), m."""
        return _at(differentiate(self.cubic), t)

    def total(self, parts: FloatArray) -> FloatArray:
        """Add up what belongs to each chain, (p, ...) to (m, ...)."""
        sums: FloatArray = np.add.reduceat(parts, self.start[:-1], axis=0)
        return sums


def _at(cubic: FloatArray, t: FloatArray) -> FloatArray:
    return horner(cubic, np.broadcast_to(t, (len(cubic), len(t))))


def straight(begin: FloatArray, end: FloatArray) -> FloatArray:
    """Give the straight line between two places (2,) as a chain; none if they are one."""
    step = end - begin
    if np.abs(step).max() <= _NIL:
        return np.zeros((0, 4, 2))
    nil = np.zeros(2)
    return np.stack([begin, step, nil, nil])[None]


def backward(chain: FloatArray) -> FloatArray:
    """Run through a chain (p, 4, 2) from its end to its beginning."""
    turned = chain[::-1]
    return stretch(turned, np.ones(len(turned)), np.zeros(len(turned)))


def mirrored(chain: FloatArray, axis: int) -> FloatArray:
    """Change the sign of a coordinate of a chain (p, 4, 2)."""
    sign = np.ones(2)
    sign[axis] = -1.0
    found: FloatArray = chain * sign
    return found


def ends_of(chain: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give the first and the last place (2,) of a chain (p, 4, 2)."""
    return chain[0, 0], chain[-1].sum(axis=0)


def joined(chains: list[FloatArray]) -> FloatArray:
    """Put chains (p, 4, 2) end to end; where they do not meet, straight lines lie between.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.integrals.plane_chains import joined, straight
    >>> one = straight(np.array([0.0, 0]), np.array([1.0, 0]))
    >>> other = straight(np.array([1.0, 2]), np.array([3.0, 2]))
    >>> len(joined([one, other]))
    3
    """
    parts: list[FloatArray] = []
    for chain in chains:
        if parts and len(chain):
            parts.append(straight(ends_of(parts[-1])[1], chain[0, 0]))
        parts += [chain] if len(chain) else []
        parts = [part for part in parts if len(part)]
    return np.concatenate(parts) if parts else np.zeros((0, 4, 2))


def cut(chain: FloatArray, axis: int, low: float, high: float) -> list[FloatArray]:
    """Give the runs of a chain on which a coordinate lies between two limits.

    Parameters
    ----------
    chain : (p, 4, 2), m
        The chain.
    axis : int
        0 for u, 1 for v.
    low, high : float, m
        The limits.

    Returns
    -------
    list of (k, 4, 2)
        What lies between, in order; cubics that follow on one another are in one chain.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.integrals.plane_chains import cut, straight
    >>> line = straight(np.array([0.0, 0]), np.array([4.0, 2]))
    >>> cut(line, 1, 0.5, 1.0)[0].sum(axis=1).tolist()
    [[2.0, 1.0]]
    """
    normal = np.eye(2)[axis]
    return runs(beside(beside(chain, -normal, -low), normal, high))


def loop(half: FloatArray, axis: int) -> FloatArray:
    """Close a chain with its mirror image, counter-clockwise, from a place on the axis.

    Parameters
    ----------
    half : (p, 4, 2), m
        One side; an end off the mirror is led there by a straight line.
    axis : int
        The coordinate that changes sign: 0 for u, 1 for v.

    Returns
    -------
    (k, 4, 2), m
        The closed chain.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.integrals.plane_chains import loop, straight
    >>> side = straight(np.array([2.0, 0]), np.array([2.0, 3]))
    >>> loop(side, 0)[:, 0].tolist()
    [[0.0, 0.0], [2.0, 0.0], [2.0, 3.0], [0.0, 3.0], [-2.0, 3.0], [-2.0, 0.0]]
    """
    first, last = ends_of(half)
    foot, top = first.copy(), last.copy()
    foot[axis] = top[axis] = 0.0
    side = joined([straight(foot, first), half, straight(last, top)])
    found = joined([side, backward(mirrored(side, axis))])
    return found if _area(found) >= 0.0 else backward(found)


def _area(chain: FloatArray) -> float:
    """Give twice the area inside a closed chain, counter-clockwise positive, roughly."""
    place = _at(chain, np.array([0.0, 0.25, 0.5, 0.75])).reshape(-1, 2)
    after = np.roll(place, -1, axis=0)
    return float((place[:, 0] * after[:, 1] - place[:, 1] * after[:, 0]).sum())
