"""Areas below arcs of a zero set: height functions, by rules that contain one another.

In a cell where each line v = constant meets the zero set once, at u = g(v), the part of the cell
below the arc is the integral over v of that of the area element from the cell's border to g(v).
Each g(v) is a root of the polynomial itself, so the integrand is smooth, and no chord is ever
taken. The first rule has 7 points, of which two are the ends of the arc, which are known. It is
judged by the last terms of the series through these values, which are far larger than those that
it leaves out. Where they are too large 6 points more make the rule of 13; where that is not enough
the arc is halved. Roots are looked for from the polynomial through those that are known.

Source: height functions are those of R. I. Saye, SIAM J. Sci. Comput. 37(2), 2015, and J. Comput.
Phys. 448, 2022.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.arc_areas import below
>>> from assoc_hull.geometry.patches.arc_curves import arc_curves
>>> from assoc_hull.geometry.patches.arcs import arcs_of
>>> from assoc_hull.geometry.patches.area_ground import AreaGround
>>> from assoc_hull.geometry.patches.curvature_functions import IsoFunction
>>> from assoc_hull.geometry.patches.patches import Patches
>>> from assoc_hull.geometry.patches.solve import solve
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0], net[:, 1, 1] = 2.0, 3.0
>>> b = np.array([[[-1.0, -1.0], [3.0, 3.0]]])
>>> cells = solve(IsoFunction(b, 1e-15 + 0.0 * b))
>>> [(curves, rows)] = arc_curves(cells, arcs_of(cells), np.array([0]))
>>> area, error = below(AreaGround.of(Patches.single(net), 1e-6), curves, np.array([1e-6]))
>>> area.round(12)
array([1.5])
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.arc_curves import ArcCurves
from assoc_hull.geometry.patches.arc_rules import arc_rules
from assoc_hull.geometry.patches.area_elements import added
from assoc_hull.geometry.patches.area_ground import AreaGround

__all__ = ["below"]

_ROUNDS = 30


def below(
    ground: AreaGround, curves: ArcCurves, tolerance: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Integrate from the lower border in u of each cell to its arc, as far as the arc goes.

    Parameters
    ----------
    ground : AreaGround
        What areas are taken from.
    curves : ArcCurves
        The arcs, a of them.
    tolerance : (a,) float, m2
        How large the estimate of the error of each may be.

    Returns
    -------
    (a,), (a,) float, m2
        Areas and estimates of their errors, the `error` of the ground not counted.
    """
    count = len(curves)
    value, error = np.zeros((2, count))
    pieces = _Pieces.whole(ground, curves, tolerance)
    for turn in range(_ROUNDS):
        found, off, u = pieces.integrate()
        good = off <= pieces.allowed
        if turn == _ROUNDS - 1:
            good[:] = True
        value += np.bincount(pieces.row[good], found[good], count)
        error += np.bincount(pieces.row[good], off[good], count)
        if good.all():
            break
        pieces = pieces.halved(np.flatnonzero(~good), u)
    return value, error


@attrs.frozen(eq=False)
class _Pieces:
    """Pieces of arcs, c of them: v and u of their ends, and u between them, roughly."""

    ground: AreaGround
    curves: ArcCurves
    row: IntArray
    span: FloatArray
    ends: FloatArray
    rough: FloatArray
    allowed: FloatArray

    @classmethod
    def whole(cls, ground: AreaGround, curves: ArcCurves, tolerance: FloatArray) -> Self:
        """Begin with all of each arc, and what is between its ends on a straight line."""
        nodes = arc_rules().first[1:-1]
        ends, rows = curves.ends, np.arange(len(curves))
        rough = ends[:, :1] + (ends[:, 1:] - ends[:, :1]) * nodes
        return cls(ground, curves, rows, curves.span, ends, rough, tolerance)

    def integrate(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Integrate each by 7 points, or by 13; give the u of these, too."""
        rules, every = arc_rules(), np.arange(len(self.row))
        u = np.zeros((len(every), 13))
        u[:, 0], u[:, 6] = self.ends.T
        u[:, 1:6] = self._heights(every, rules.first[1:-1], self.rough)
        values, slack = self._values(every, rules.first, u[:, :7])
        width = self.span[:, 1] - self.span[:, 0]
        found, off = _judged(values, rules.few, width)
        off += slack * width
        more = np.flatnonzero(off > self.allowed)
        if len(more):
            rough = _mixed(rules.between, u[more, :7])
            u[more, 7:] = self._heights(more, rules.second, rough)
            further, slack = self._values(more, rules.second, u[more, 7:])
            width = width[more]
            found[more], off[more] = _judged(
                np.concatenate([values[:, more], further]), rules.many, width
            )
            off[more] += slack * width
        return found, off, u

    def _heights(self, part: IntArray, nodes: FloatArray, rough: FloatArray) -> FloatArray:
        return self.curves.at(self.row[part], self._places(part, nodes), rough)

    def _places(self, part: IntArray, nodes: FloatArray) -> FloatArray:
        span = self.span[part]
        return span[:, :1] + (span[:, 1:] - span[:, :1]) * nodes

    def _values(
        self, part: IntArray, nodes: FloatArray, u: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Give the inner integrals (q, c), and the most they may be off by, (c,)."""
        curves, row = self.curves, self.row[part]
        width = self.span[part, 1] - self.span[part, 0]
        allowed = 0.25 * self.allowed[part] / np.where(width > 0.0, width, 1.0)
        values, off = self.ground.between(
            curves.patch[row], curves.flip[row], curves.box[row, 0, 0], u,
            self._places(part, nodes), allowed,
        )  # fmt: skip
        return values.T.copy(), off.max(axis=1)

    def halved(self, chosen: IntArray, u: FloatArray) -> Self:
        """Halve the chosen ones, of which the u of 13 points are known."""
        span, ends = self.span[chosen].repeat(2, axis=0), self.ends[chosen].repeat(2, axis=0)
        half = 0.5 * (self.span[chosen, 0] + self.span[chosen, 1])
        for place, at in ((span, half), (ends, u[chosen, 3])):
            place[::2, 1], place[1::2, 0] = at, at
        rough = _mixed(arc_rules().inside, u[chosen]).reshape(-1, 5)
        return attrs.evolve(
            self, row=self.row[chosen].repeat(2), span=span, ends=ends, rough=rough,
            allowed=(0.5 * self.allowed[chosen]).repeat(2),
        )  # fmt: skip


def _mixed(matrix: FloatArray, values: FloatArray) -> FloatArray:
    """Multiply each row by a matrix, all in the same way however many rows there are."""
    return np.asarray((matrix @ values[..., None])[..., 0])


def _judged(
    values: FloatArray, rules: FloatArray, width: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give integrals by a rule, and the last two terms of the series through the values."""
    found, *terms = (width * added(values * weights[:, None]) for weights in rules)
    return found, np.abs(terms[0]) + np.abs(terms[1])
