"""Chains of cubics: cut at planes, put end to end, mirrored and closed, and what they enclose.

A chain is a run of cubics, each of which begins where the one before it ends; a cubic is given by
the coefficients of 1, t, t^2, t^3, t from 0 to 1, m. The first functions take cubics of space, or
of a plane, and cut them at planes and where a coordinate turns. `PlaneChains` are what is left of
curves when only two coordinates, u and v, are looked at; series and areas are taken of them.
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.polynomials import differentiate, horner, unit_roots
from assoc_hull.geometry.numeric.quadrature import gauss
from assoc_hull.geometry.splines.paths import restrict_cubics
from assoc_hull.geometry.splines.segments import power_coefficients

__all__ = [
    "PlaneChains",
    "area_along",
    "chain_ends",
    "clip_cubics",
    "closed_loop",
    "continuous_runs",
    "cut_chain",
    "join_chains",
    "mirrored_chain",
    "monotone_cubics",
    "reversed_chain",
    "straight_chain",
]

_GAP = 1e-9
"""Cubics whose ends lie farther apart (m) do not join."""

_SLIVER = 1e-12
"""Parts of a smaller part of a cubic are not made."""

_POINTS = 6
"""Gauss points: exact for all that is integrated here, up to the degree 11."""


def clip_cubics(cubic: FloatArray, normal: FloatArray, offset: float) -> FloatArray:
    """Keep of cubics (s, 4, 3), or (s, 4, 2), what lies where ``normal . P <= offset``.

    The normal may have any length. The parts that are left are cubics from 0 to 1 again, in order.
    """
    height = cubic @ normal
    height[:, 0] -= offset
    one = np.ones((len(cubic), 1))
    edge = np.concatenate([0.0 * one, unit_roots(height), one], axis=1)
    inside = horner(height, 0.5 * (edge[:, :-1] + edge[:, 1:])) <= 0.0
    inside &= np.diff(edge, axis=1) > _SLIVER
    segment, part = np.nonzero(inside)
    found = restrict_cubics(cubic[segment], edge[segment, part], edge[segment, part + 1])
    freeze(found)
    return found


def monotone_cubics(cubic: FloatArray, axis: int) -> FloatArray:
    """Part cubics where a coordinate turns, so that along each it only rises or only falls."""
    one = np.ones((len(cubic), 1))
    edge = np.concatenate([0.0 * one, unit_roots(differentiate(cubic)[:, :, axis]), one], axis=1)
    segment, part = np.nonzero(np.diff(edge, axis=1) > _SLIVER)
    return restrict_cubics(cubic[segment], edge[segment, part], edge[segment, part + 1])


def continuous_runs(cubic: FloatArray) -> list[FloatArray]:
    """Part cubics into runs, each of which goes on without a gap."""
    if not len(cubic):
        return []
    gap = np.abs(cubic[1:, 0] - cubic[:-1].sum(axis=1)).max(axis=1)
    return np.split(cubic, np.flatnonzero(gap > _GAP) + 1)


def area_along(cubic: FloatArray, axes: tuple[int, int], power: tuple[int, int] = (1, 0)) -> float:
    """Integrate ``a^p b^q db`` along cubics (s, 4, 3): a and b are the coordinates `axes`.

    `power` is (p, q), together up to 2; the result is in m to the power p + q + 1.
    """
    nodes, weights = gauss(_POINTS)
    places = np.broadcast_to(nodes, (len(cubic), _POINTS))
    a, b = (horner(cubic[:, :, axis], places) for axis in axes)
    step = horner(differentiate(cubic)[:, :, axes[1]], places)
    return float((a ** power[0] * b ** power[1] * step * weights).sum())


# --------------------------------------------------------------------------------------
# Chains in a plane.

_SHORTEST = 1e-12  # m: a shorter straight line is left out


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
        return cls(start, np.ascontiguousarray(power_coefficients(batch)[:, :, list(axes)]))

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


def straight_chain(begin: FloatArray, end: FloatArray) -> FloatArray:
    """Give the straight line between two places (2,) as a chain; none if they are one."""
    step = end - begin
    if np.abs(step).max() <= _SHORTEST:
        return np.zeros((0, 4, 2))
    zero = np.zeros(2)
    return np.stack([begin, step, zero, zero])[None]


def reversed_chain(chain: FloatArray) -> FloatArray:
    """Run through a chain (p, 4, 2) from its end to its beginning."""
    turned = chain[::-1]
    return restrict_cubics(turned, np.ones(len(turned)), np.zeros(len(turned)))


def mirrored_chain(chain: FloatArray, axis: int) -> FloatArray:
    """Change the sign of a coordinate of a chain (p, 4, 2)."""
    sign = np.ones(2)
    sign[axis] = -1.0
    found: FloatArray = chain * sign
    return found


def chain_ends(chain: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give the first and the last place (2,) of a chain (p, 4, 2)."""
    return chain[0, 0], chain[-1].sum(axis=0)


def join_chains(chains: list[FloatArray]) -> FloatArray:
    """Put chains (p, 4, 2) end to end; where there is a gap, a straight line fills it.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.integrals.chains import join_chains, straight_chain
    >>> one = straight_chain(np.array([0.0, 0]), np.array([1.0, 0]))
    >>> other = straight_chain(np.array([1.0, 2]), np.array([3.0, 2]))
    >>> len(join_chains([one, other]))
    3
    """
    parts: list[FloatArray] = []
    for chain in chains:
        if parts and len(chain):
            parts.append(straight_chain(chain_ends(parts[-1])[1], chain[0, 0]))
        parts += [chain] if len(chain) else []
        parts = [part for part in parts if len(part)]
    return np.concatenate(parts) if parts else np.zeros((0, 4, 2))


def cut_chain(chain: FloatArray, axis: int, low: float, high: float) -> list[FloatArray]:
    """Give the runs of a chain (p, 4, 2) on which a coordinate (0 for u, 1 for v) lies in limits.

    The limits are in m. Runs come in order, (k, 4, 2) each; cubics that follow on one another are
    in one chain.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.integrals.chains import cut_chain, straight_chain
    >>> line = straight_chain(np.array([0.0, 0]), np.array([4.0, 2]))
    >>> cut_chain(line, 1, 0.5, 1.0)[0].sum(axis=1).tolist()
    [[2.0, 1.0]]
    """
    normal = np.eye(2)[axis]
    return continuous_runs(clip_cubics(clip_cubics(chain, -normal, -low), normal, high))


def closed_loop(half: FloatArray, axis: int) -> FloatArray:
    """Close a chain (p, 4, 2) with its mirror image, counter-clockwise, from a place on the axis.

    `axis` is the coordinate that changes sign: 0 for u, 1 for v. An end off the mirror is led there
    by a straight line.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.integrals.chains import closed_loop, straight_chain
    >>> side = straight_chain(np.array([2.0, 0]), np.array([2.0, 3]))
    >>> closed_loop(side, 0)[:, 0].tolist()
    [[0.0, 0.0], [2.0, 0.0], [2.0, 3.0], [0.0, 3.0], [-2.0, 3.0], [-2.0, 0.0]]
    """
    first, last = chain_ends(half)
    foot, top = first.copy(), last.copy()
    foot[axis] = top[axis] = 0.0
    side = join_chains([straight_chain(foot, first), half, straight_chain(last, top)])
    found = join_chains([side, reversed_chain(mirrored_chain(side, axis))])
    return found if _area(found) >= 0.0 else reversed_chain(found)


def _area(chain: FloatArray) -> float:
    """Give twice the area inside a closed chain, counter-clockwise positive, roughly."""
    place = _at(chain, np.array([0.0, 0.25, 0.5, 0.75])).reshape(-1, 2)
    after = np.roll(place, -1, axis=0)
    return float((place[:, 0] * after[:, 1] - place[:, 1] * after[:, 0]).sum())
