"""Hollows that an edit spreads: whether their areas are kept once all has followed."""

from __future__ import annotations

from collections.abc import Iterable

import attrs
import numpy as np

from assoc_hull.edit.modification import Modification, Work
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.evaluation import derivative, evaluate

__all__ = ["SpreadArea", "SpreadAreas", "area_beside"]

_KEPT = 0.02
"""Part of its area by which a hollow may be off when lines that drive it have followed."""

_GAUSS = np.array([0.5 - np.sqrt(0.15), 0.5, 0.5 + np.sqrt(0.15)]), np.array([5.0, 8.0, 5.0]) / 18.0
"""Places and weights that integrate polynomials of degree 5 from 0 to 1."""


@attrs.frozen(eq=False)
class SpreadArea:
    """A hollow that is spread.

    Attributes
    ----------
    curve : int
        Its curve.
    old : SplineBatch
        The curve before.
    way, up : (3,)
        Unit vectors along the hollow and across it.
    area : float, m2
        Of the hollow.
    """

    curve: int
    old: SplineBatch
    way: FloatArray
    up: FloatArray
    area: float


@attrs.define(eq=False)
class SpreadAreas(Modification):
    """The hollows that an edit spreads."""

    areas: list[SpreadArea] = attrs.field(factory=list)

    @property
    def idle(self) -> bool:
        """Whether there is none."""
        return not self.areas

    def check(self, work: Work) -> Iterable[str]:
        """Say whose area was not kept."""
        for each in self.areas:
            off = area_beside(each.old, work.state.spline(each.curve), each.way, each.up)
            if abs(off) > _KEPT * each.area:
                name = work.state.lines.name[work.state.line_of(each.curve)]
                yield (
                    f"{name}: the hollow has come to another area, by {100 * off / each.area:.1f} %"
                    ", as lines drive it that follow not so far; make their crossings shared "
                    "(edit.set_role), or give another length"
                )


def area_beside(old: SplineBatch, new: SplineBatch, way: FloatArray, up: FloatArray) -> float:
    """Give the area (m2) between two curves with the same ends, above the old one positive."""
    return _area_below(new, way, up) - _area_below(old, way, up)


def _area_below(spline: SplineBatch, way: FloatArray, up: FloatArray) -> float:
    """Integrate the height over the length of a curve, exactly: a polynomial piece by piece."""
    step = np.diff(spline.knot)
    at = (spline.knot[:-1, None] + step[:, None] * _GAUSS[0]).ravel()
    curve: IntArray = np.zeros(len(at), np.int64)
    height = ((evaluate(spline, curve, at) - spline.xyz[0]) * up).sum(axis=1)
    speed = (derivative(spline, curve, at) * way).sum(axis=1)
    weight = (step[:, None] * _GAUSS[1]).ravel()
    return float((height * speed * weight).sum())
