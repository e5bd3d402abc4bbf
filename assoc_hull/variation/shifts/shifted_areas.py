"""The sectional area curve as elements of volume, and its volume and moment after a shift.

Sections that move rigidly along the ship, ``A'(x + delta(x)) = A(x)``, enclose a volume that is
linear, and a moment that is quadratic, in the free sizes of the shift. Both hold exactly for any
curve of areas, one that jumps at a transom included. x in m from AP, + forward; moments about AP.
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import numbers
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.variation.shifts.shift_terms import ShiftTerms

__all__ = [
    "ShiftSums",
    "VolumeElements",
]

# --------------------------------------------------------------------------------------
# Elements of volume, for
#
#     V' = int A (1 + delta') dx        M' = int (x + delta) A (1 + delta') dx
#
# Integrated by parts these are the integrals of ``-A' delta`` with each jump of A as a part of A';
# so all that is needed of a curve are its areas at the places of a Gauss rule.

_POINTS = 8
"""Points of the Gauss rule on each part: exact for cubic areas and all shapes of shifts."""

_WHERE = "in shift_sections"


@attrs.frozen(eq=False)
class VolumeElements:
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
    >>> from assoc_hull.variation.shifts.shifted_areas import VolumeElements
    >>> parabola = VolumeElements.of(lambda x: x * (10.0 - x), [0.0, 10.0], 5.0)
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
    ) -> VolumeElements:
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


# --------------------------------------------------------------------------------------
# Sums, with delta = g + c_f e_f + c_a e_a:
#
#     V' = V1 + c_f alpha_f + c_a alpha_a
#     M' = M1 + c_f beta_f + c_a beta_a + (c_f^2 gamma_ff + 2 c_f c_a gamma_fa + c_a^2 gamma_aa) / 2
#
#     V1 = int A (1 + g') dx          alpha_i = int A e_i' dx
#     M1 = int A (x + g) (1 + g') dx  beta_i = int A ((x + g) e_i)' dx
#                                     gamma_ij = int A (e_i e_j)' dx
#
# Both are exact: the integrals of H. Lackenby, "On the systematic geometrical variation of ship
# forms", Trans. INA 92, 1950, without his neglect of squares.


@attrs.frozen(eq=False)
class ShiftSums:
    """Coefficients of volume and moment after a shift.

    Attributes
    ----------
    volume, moment : float, m3, m4
        V1, M1: with g alone.
    bodies : (2,), m3
        Of fore and after body, with g alone.
    alpha : (2,), m2
        dV' by c_f and c_a.
    by_body : (2, 2), m2
        The same of each body: a row for the fore one and a row for the after one.
    beta : (2,), m3
        dM' by them where both are zero.
    gamma : (2, 2), m2
        Second derivatives of M'.

    Examples
    --------
    >>> from assoc_hull.variation.shifts.shifted_areas import VolumeElements
    >>> from assoc_hull.variation.shifts.shifted_areas import ShiftSums
    >>> from assoc_hull.variation.shifts.shift_terms import ShiftTerms, Terminals
    >>> terms = ShiftTerms(Terminals(0.0, 5.0, 5.0, 10.0), "lackenby")
    >>> sums = ShiftSums.of(VolumeElements.of(lambda x: x * (10.0 - x), terms.nodes, 5.0), terms)
    >>> sums.alpha.round(9).tolist()
    [4.166666667, -4.166666667]
    """

    volume: float
    moment: float
    bodies: FloatArray
    alpha: FloatArray
    by_body: FloatArray
    beta: FloatArray
    gamma: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.bodies, self.alpha, self.by_body, self.beta, self.gamma)

    @classmethod
    def of(cls, elements: VolumeElements, terms: ShiftTerms) -> ShiftSums:
        """Integrate over the elements of a curve, whose breaks hold the nodes of the terms."""
        x, dv = elements.x, elements.volume
        g, slope = terms.given.at(x), 1.0 + terms.given.slope(x)
        free = terms.fore, terms.aft
        e = np.array([each.at(x) for each in free])
        rise = np.array([each.slope(x) for each in free])
        middle = np.array([elements.middle])
        across = [float(each.at(middle)[0]) for each in terms.courses]
        gains = [elements.halves(r, at) for r, at in zip(rise, across[1:], strict=True)]
        products = e[:, None, :] * rise[None, :, :]
        return cls(
            float((dv * slope).sum()), float((dv * slope * (x + g)).sum()),
            elements.halves(slope, across[0]), (rise * dv).sum(axis=1), np.array(gains).T,
            ((slope * e + (x + g) * rise) * dv).sum(axis=1),
            ((products + products.transpose(1, 0, 2)) * dv).sum(axis=2),
        )  # fmt: skip

    def volume_at(self, sizes: FloatArray) -> float:
        """Give V', m3, of sizes (2,), m."""
        return self.volume + float(self.alpha @ sizes)

    def moment_at(self, sizes: FloatArray) -> float:
        """Give M', m4, of sizes (2,), m."""
        return self.moment + float(self.beta @ sizes + 0.5 * sizes @ self.gamma @ sizes)

    def jacobian(self, sizes: FloatArray) -> FloatArray:
        """Give the derivatives of V' and M' by the sizes there, (2, 2), m2 and m3."""
        return np.array([self.alpha, self.beta + self.gamma @ sizes])

    def whole(self, volume: float, moment: float) -> FloatArray | None:
        """Find the sizes, (2,), m, that give a volume (m3) and a moment (m4).

        The after size is eliminated; of the two roots of the quadratic that is left, that with
        the smaller fore size is taken. None if it has no real root, or nothing can be shifted.
        """
        if self.alpha[1] == 0.0:
            return None
        # c_a = p + q c_f
        p = (volume - self.volume) / float(self.alpha[1])
        q = -float(self.alpha[0]) / float(self.alpha[1])
        (ff, fa), (_, aa) = self.gamma.tolist()
        of_f, of_a = self.beta.tolist()
        roots = _roots(
            0.5 * ff + fa * q + 0.5 * aa * q * q,
            of_f + of_a * q + (fa + aa * q) * p,
            self.moment - moment + of_a * p + 0.5 * aa * p * p,
        )
        if not roots:
            return None
        fore = min(roots, key=lambda each: (abs(each), each))
        return np.array([fore, p + q * fore])

    def each(self, bodies: FloatArray) -> FloatArray | None:
        """Find the sizes, (2,), m, that give volumes (2,), m3, of fore and after body: linear."""
        if abs(float(np.linalg.det(self.by_body))) == 0.0:
            return None
        return np.asarray(np.linalg.solve(self.by_body, bodies - self.bodies))


def _roots(a: float, b: float, c: float) -> tuple[float, ...]:
    """Give the real roots of a quadratic without loss of digits; of a line if it is one."""
    left = b * b - 4.0 * a * c
    if left < 0.0 or (a == 0.0 and b == 0.0):
        return ()
    # the root of larger size first, the other from the product of both: nothing cancels
    half = -0.5 * (b + np.copysign(np.sqrt(left), b))
    found = [half / a] if a != 0.0 else []
    return tuple(float(each) for each in (*found, *([c / half] if half != 0.0 else [])))
