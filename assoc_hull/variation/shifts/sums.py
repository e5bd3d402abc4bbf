"""Volume and moment of a shifted curve of areas: linear and quadratic in the free sizes.

    V' = V1 + c_f alpha_f + c_a alpha_a
    M' = M1 + c_f beta_f + c_a beta_a + (c_f^2 gamma_ff + 2 c_f c_a gamma_fa + c_a^2 gamma_aa) / 2

    V1 = int A (1 + g') dx          alpha_i = int A e_i' dx
    M1 = int A (x + g) (1 + g') dx  beta_i = int A ((x + g) e_i)' dx
                                    gamma_ij = int A (e_i e_j)' dx

Both are exact. They are the integrals of H. Lackenby, "On the systematic geometrical variation of
ship forms", Trans. INA 92, 1950, without his neglect of squares.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.variation.shifts.elements import Elements
from assoc_hull.variation.shifts.shift_terms import ShiftTerms

__all__ = ["Sums"]


@attrs.frozen(eq=False)
class Sums:
    """What volume and moment become.

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
        dM' by them where both are nil.
    gamma : (2, 2), m2
        Second derivatives of M'.

    Examples
    --------
    >>> from assoc_hull.variation.shifts.elements import Elements
    >>> from assoc_hull.variation.shifts.sums import Sums
    >>> from assoc_hull.variation.shifts.shift_terms import ShiftTerms, Terminals
    >>> terms = ShiftTerms(Terminals(0.0, 5.0, 5.0, 10.0), "lackenby")
    >>> sums = Sums.of(Elements.of(lambda x: x * (10.0 - x), terms.nodes, 5.0), terms)
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
    def of(cls, elements: Elements, terms: ShiftTerms) -> Sums:
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
    half = -0.5 * (b + np.copysign(np.sqrt(left), b))
    found = [half / a] if a != 0.0 else []
    return tuple(float(each) for each in (*found, *([c / half] if half != 0.0 else [])))
