"""A sectional area curve as elements of volume: places along the ship, and what stands for each.

Sections that move rigidly along the ship, ``A'(x + delta(x)) = A(x)``, enclose

    V' = int A (1 + delta') dx        M' = int (x + delta) A (1 + delta') dx

for any curve of areas, one that jumps at a transom included: integrated by parts, these are the
integrals of ``-A' delta`` with each jump of A as a part of A'. So all that is asked of a curve
are its areas at the places of a Gauss rule.
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import numbers
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["Elements"]

_POINTS = 8
"""Of the Gauss rule a part: exact for cubic areas, and for all shapes that sections move by."""

_WHERE = "in shift_sections"


@attrs.frozen(eq=False)
class Elements:
    """Elements of volume along a ship.

    Attributes
    ----------
    x : (n,), m
        Where they are.
    volume : (n,), m3
        What each stands for.
    middle : float, m
        x of midship, which parts fore and after body.
    area : float, m2
        Of the section there.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.shifts.elements import Elements
    >>> parabola = Elements.of(lambda x: x * (10.0 - x), [0.0, 10.0], 5.0)
    >>> round(parabola.total, 9), round(parabola.moment / parabola.total, 9)
    (166.666666667, 5.0)
    """

    x: FloatArray
    volume: FloatArray
    middle: float
    area: float

    def __attrs_post_init__(self) -> None:
        freeze(self.x, self.volume)

    @classmethod
    def of(
        cls, area: Callable[[FloatArray], FloatArray], breaks: ArrayLike, middle: float
    ) -> Elements:
        """Take a curve of areas.

        Parameters
        ----------
        area : callable
            Areas (n,), m2, at places (n,), m.
        breaks : (b,), m
            The ends of the curve, and all places where it, or what sections move by, goes over
            from one polynomial into another; in any order.
        middle : float, m
            x of midship.

        Raises
        ------
        BadInputError
            Fewer than two places; no volume between them.
        """
        given = numbers(breaks, "breaks", _WHERE)
        ends = np.unique(np.append(given, np.clip(middle, given.min(), given.max())))
        if len(ends) < 2:
            raise BadInputError("a curve of areas has one place", _WHERE, "give both ends")
        node, weight = np.polynomial.legendre.leggauss(_POINTS)
        half = 0.5 * np.diff(ends)[:, None]
        x = (ends[:-1, None] + half * (1.0 + node)).ravel()
        volume = (half * weight).ravel() * area(x)
        if not volume.sum() > 0.0:
            raise BadInputError("a curve of areas encloses no volume", _WHERE, "look at the areas")
        return cls(x, volume, middle, float(area(np.array([middle]))[0]))

    @property
    def total(self) -> float:
        """V, m3."""
        return float(self.volume.sum())

    @property
    def moment(self) -> float:
        """Integral of x dV, m4."""
        return float((self.x * self.volume).sum())

    def halves(self, slope: FloatArray, at_middle: float) -> FloatArray:
        """Give what fore and after body gain: (2,), m3.

        Parameters
        ----------
        slope : (n,)
            Derivative of what sections move by, at the elements.
        at_middle : float, m
            By how much the section amidships moves. Those beside it are taken to be as large.
        """
        fore = self.x > self.middle
        gained, across = slope * self.volume, self.area * at_middle
        return np.array([gained[fore].sum() + across, gained[~fore].sum() - across])

    @property
    def bodies(self) -> FloatArray:
        """Volumes of fore and after body, (2,), m3."""
        return self.halves(np.ones_like(self.x), 0.0)
