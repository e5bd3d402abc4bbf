"""Areas below arcs of a zero set: height functions, by rules that contain one another.

In a cell where each line v = constant meets the zero set once, at u = g(v), the part of the cell
below the arc is the integral over v of that of the area element from the cell's border to g(v). Each
g(v) is a root of the polynomial itself, so the integrand is smooth and no chord is ever taken. The
first rule has 7 points, of which two are the ends of the arc, which are known; it is judged by the
rule of 4 of them. Where the difference is too large 6 points more make the rule of 13, judged by
that of 7; where that is not enough the arc is halved.

Source: height functions are those of R. I. Saye, SIAM J. Sci. Comput. 37(2), 2015, and J. Comput.
Phys. 448, 2022; the rules are those of W. Gander and W. Gautschi, "Adaptive quadrature - revisited",
BIT 40, 2000.

Examples
--------
>>> from assoc_hull.geometry.patches.arc_areas import rule
>>> [len(part) for part in rule()[0][:2]]
[7, 6]
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.area_elements import added, bernstein_values
from assoc_hull.geometry.patches.area_ground import AreaGround
from assoc_hull.geometry.patches.cells import Arcs, Cells
from assoc_hull.geometry.patches.roots import crossing

__all__ = ["Heights", "below", "rule"]

_ROUNDS = 30
# How much the second measure of an error counts.
_TWIN = 0.2
# Arcs at a time, so that their values stay in the cache.
_BLOCK = 512


@attrs.frozen(eq=False)
class Heights:
    """Arcs u = g(v), one a row, with what is needed to find g.

    Attributes
    ----------
    patch : (a,) int
        The patch of each.
    box : (a, 2, 2)
        Its cell, ``[[u0, u1], [v0, v1]]`` in parameters of the patch.
    b : (a, M + 1, N + 1)
        The polynomial in the cell.
    rising : (a,) bool
        Whether it is positive on the side of larger u.
    span : (a, 2)
        v at both ends of the arc.
    ends : (a, 2)
        u there.
    """

    patch: IntArray
    box: FloatArray
    b: FloatArray
    rising: NDArray[np.bool_]
    span: FloatArray
    ends: FloatArray

    @classmethod
    def of(cls, cells: Cells, arcs: Arcs, across: int) -> tuple[Self, IntArray]:
        """Take the arcs that run across one way, and their rows.

        Parameters
        ----------
        cells : Cells
            The cells.
        arcs : Arcs
            Their arcs.
        across : 0 or 1
            0 for arcs u = g(v); 1 for v = g(u), of which the parameters are exchanged.

        Returns
        -------
        Heights, (a,) int
            The arcs and which rows of `arcs` they are.
        """
        rows = np.nonzero(arcs.across == across)[0]
        cell = arcs.cell[rows]
        box, b = cells.box[cell], cells.b[cells.row[cell]]
        if across:
            box, b = box[:, ::-1], np.ascontiguousarray(b.swapaxes(1, 2))
        ends = arcs.ends[rows, :, across]
        return cls(cells.patch[cell], box, b, arcs.rising[rows], arcs.span[rows], ends), rows

    def at(self, row: IntArray, v: FloatArray) -> FloatArray:
        """Find g at places.

        Parameters
        ----------
        row : (c,) int
            The arc of each row of places.
        v : (c, q)
            The places.

        Returns
        -------
        (c, q) float
            The values of g, in parameters of the patch.
        """
        found = np.empty_like(v)
        for first in range(0, len(row), _BLOCK):
            part = slice(first, first + _BLOCK)
            found[part] = self._at(row[part], v[part])
        return found

    def _at(self, row: IntArray, v: FloatArray) -> FloatArray:
        box, b = self.box[row], self.b[row]
        t = (v - box[:, 1, :1]) / (box[:, 1, 1:] - box[:, 1, :1])
        basis = bernstein_values(b.shape[2] - 1, np.clip(t, 0.0, 1.0))
        lines = (b @ np.ascontiguousarray(np.moveaxis(basis, 0, 1))).swapaxes(1, 2)
        rising = self.rising[row].repeat(v.shape[1])
        s = crossing(lines.reshape(-1, b.shape[1]), rising).reshape(v.shape)
        return box[:, 0, :1] + (box[:, 0, 1:] - box[:, 0, :1]) * s


def below(
    ground: AreaGround, heights: Heights, tolerance: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Integrate from the lower border in u of each cell to its arc, as far as the arc goes.

    Parameters
    ----------
    ground : AreaGround
        What areas are taken from; with the parameters exchanged, if those of the arcs are.
    heights : Heights
        The arcs, a of them.
    tolerance : (a,) float, m2
        How large the estimate of the error of each may be.

    Returns
    -------
    (a,), (a,) float, m2
        Areas and estimates of their errors, the `error` of the ground not counted.
    """
    count = len(heights.patch)
    value, error = np.zeros((2, count))
    pieces = _Pieces(ground, heights, np.arange(count), heights.span, heights.ends, tolerance)
    for turn in range(_ROUNDS):
        if not len(pieces.row):
            break
        found, off, middle = pieces.integrate()
        good = off <= pieces.allowed
        if turn == _ROUNDS - 1:
            good[:] = True
        value += np.bincount(pieces.row[good], found[good], count)
        error += np.bincount(pieces.row[good], off[good], count)
        pieces = pieces.halved(~good, middle)
    return value, error


@attrs.frozen(eq=False)
class _Pieces:
    """Pieces of arcs, c of them, with the v and u of their ends."""

    ground: AreaGround
    heights: Heights
    row: IntArray
    span: FloatArray
    ends: FloatArray
    allowed: FloatArray

    def integrate(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Integrate each by 7 points, or by 13; give the u of the middle, too."""
        (first, second), few, many = rule()
        width = self.span[:, 1] - self.span[:, 0]
        inside = self._heights(np.arange(len(self.row)), first[1:-1])
        u = np.concatenate([self.ends[:, :1], inside, self.ends[:, 1:]], axis=1)
        values, slack = self._values(np.arange(len(self.row)), first, u)
        found, off = _judged(values, few, width)
        off += slack * width
        more = np.nonzero(off > self.allowed)[0]
        if len(more):
            added_values, slack = self._values(more, second, self._heights(more, second))
            every = np.concatenate([values[:, more], added_values])
            found[more], off[more] = _judged(every, many, width[more])
            off[more] += slack * width[more]
        return found, off, inside[:, 2]

    def _heights(self, part: IntArray, nodes: FloatArray) -> FloatArray:
        return self.heights.at(self.row[part], self._places(part, nodes))

    def _places(self, part: IntArray, nodes: FloatArray) -> FloatArray:
        span = self.span[part]
        return span[:, :1] + (span[:, 1:] - span[:, :1]) * nodes

    def _values(
        self, part: IntArray, nodes: FloatArray, u: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Give the inner integrals (q, c), and the most they may be off by, (c,)."""
        row = self.row[part]
        width = self.span[part, 1] - self.span[part, 0]
        allowed = 0.25 * self.allowed[part] / np.where(width > 0.0, width, 1.0)
        start = self.heights.box[row, 0, 0]
        patch = self.heights.patch[row]
        v = self._places(part, nodes)
        values, off = self.ground.between(patch, start, u, v, allowed)
        return values.T.copy(), off.max(axis=1)

    def halved(self, chosen: NDArray[np.bool_], middle: FloatArray) -> _Pieces:
        """Halve the chosen ones."""
        span, ends = self.span[chosen].repeat(2, axis=0), self.ends[chosen].repeat(2, axis=0)
        half = 0.5 * (self.span[chosen, 0] + self.span[chosen, 1])
        for place, at in ((span, half), (ends, middle[chosen])):
            place[::2, 1], place[1::2, 0] = at, at
        allowed = (0.5 * self.allowed[chosen]).repeat(2)
        return attrs.evolve(
            self, row=self.row[chosen].repeat(2), span=span, ends=ends, allowed=allowed
        )


def _judged(
    values: FloatArray, rules: FloatArray, width: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give integrals by the first rule, and what the others make of their errors."""
    found, even, odd = (width * added(values * weights[:, None]) for weights in rules)
    return found, np.abs(even) + np.abs(odd)


Rules = tuple[tuple[FloatArray, FloatArray], FloatArray, FloatArray]


@cache
def rule() -> Rules:
    """Give the rules on [0, 1].

    Returns
    -------
    ((7,), (6,)), (3, 7), (3, 13)
        Nodes of the smaller rule and those that the larger one adds; for both, weights of the rule
        itself and of two measures of its error, which are nil for polynomials.

    Examples
    --------
    >>> nodes, few, many = rule()
    >>> abs(few.sum(axis=1)).round(12)
    array([1., 0., 0.])
    """
    inner, outer = 1.0 / np.sqrt(5.0), np.sqrt(2.0 / 3.0)
    more = np.array([0.942882415695480, 0.641853342345781, 0.236383199662150])
    first = np.array([-1.0, -outer, -inner, 0.0, inner, outer, 1.0])
    second = np.concatenate([-more, more[::-1]])
    every = np.concatenate([first, second])
    few = _weights(first, range(7)), _weights(first, (0, 2, 4, 6))
    many = _weights(every, range(13)), _weights(every, range(7))
    places = 0.5 * (1.0 + first), 0.5 * (1.0 + second)
    found = places, _judges(first, *few), _judges(every, *many)
    freeze(*places, *found[1:])
    return found


def _judges(nodes: FloatArray, rule: FloatArray, coarse: FloatArray) -> FloatArray:
    """Give the weights of a rule, of what the coarse one gives beyond it, and of a twin of that.

    The second is nil for all odd functions, and might vanish by chance for others; the twin is nil
    for all even ones, and for polynomials of one degree less than the coarse rule knows.
    """
    even = coarse - rule
    degree = int((coarse != 0.0).sum())
    odd = np.polynomial.legendre.legvander(nodes, len(nodes))[:, 1::2]
    values = odd[:, : (degree + 1) // 2]
    twin = odd[:, (degree + 1) // 2] * rule
    twin -= rule * (
        values @ np.linalg.lstsq((values * rule[:, None]).T @ values, values.T @ twin)[0]
    )
    twin *= _TWIN * np.linalg.norm(even) / np.linalg.norm(twin)
    return np.array([rule, even, twin])


def _weights(nodes: FloatArray, used: Sequence[int]) -> FloatArray:
    """Give the weights, on [0, 1], of the rule that has only some of the nodes."""
    chosen = list(used)
    moments = np.zeros(len(chosen))
    moments[0] = 1.0
    found = np.zeros(len(nodes))
    values = np.polynomial.legendre.legvander(nodes[chosen], len(chosen) - 1).T
    found[chosen] = np.linalg.solve(values, moments)
    return found
