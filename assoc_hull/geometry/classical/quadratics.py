"""Pieces of plane curves whose two coordinates are quadratic in the length along their chord.

Lines, parabolas over chords, and cambers are such; their area against the axis is exact, also
below a level.

Examples
--------
>>> from assoc_hull.geometry.classical.quadratics import Quadratics
>>> side = Quadratics.over([(7.5, 0), (11, 0.8), (13.5, 2.5)], [0.0, 0.0])
>>> round(side.area(), 9), round(side.area_below(0.8), 9)
(28.225, 7.4)
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.geometry.classical.checks import finite
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = ["Quadratics"]

_FAR = 1e9
"""Beyond this level (m) nothing lies."""

_SLACK = 1e-12
"""So far (as a part of the length) beyond an end is the end."""

_GAUSS = np.polynomial.legendre.leggauss(3)


@attrs.frozen(eq=False)
class Quadratics:
    """Pieces, one behind the other.

    Attributes
    ----------
    y, z : (n, 3)
        Coefficients of both coordinates in powers of p, from the constant on; m.
    length : (n,), m
        p runs from 0 to this.
    """

    y: FloatArray
    z: FloatArray
    length: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.y, self.z, self.length)

    @classmethod
    def over(cls, points: ArrayLike, bend: ArrayLike) -> Self:
        """Give the parabolas q = K/2 p (p - l) over the chords of points.

        Parameters
        ----------
        points : (n + 1, 2) array_like, m
            Not coincident; p runs along each chord, q to its left.
        bend : (n,) array_like, 1/m
            K of each.
        """
        place = finite(points, "parabolas", (None, 2))
        k = finite(bend, "parabolas", (len(place) - 1,))
        step = np.diff(place, axis=0)
        length = np.hypot(*step.T)
        cosine, sine = step.T / length
        lean = 0.5 * k * length
        y = np.stack([place[:-1, 0], cosine + sine * lean, -0.5 * sine * k], axis=1)
        z = np.stack([place[:-1, 1], sine - cosine * lean, 0.5 * cosine * k], axis=1)
        return cls(y, z, length)

    @classmethod
    def join(cls, parts: Sequence[Quadratics]) -> Self:
        """Put pieces behind one another."""
        names = ("y", "z", "length")
        return cls(*(np.concatenate([getattr(each, name) for each in parts]) for name in names))

    def __len__(self) -> int:
        return len(self.length)

    def at(self, piece: IntArray, p: ArrayLike) -> FloatArray:
        """Give points (k, 2), m, on the pieces numbered `piece` (k,) at lengths `p` (k,), m."""
        t = np.asarray(p, np.float64)
        found = [
            each[piece, 0] + t * (each[piece, 1] + t * each[piece, 2]) for each in (self.y, self.z)
        ]
        return np.stack(found, axis=-1)

    def angles(self) -> tuple[FloatArray, FloatArray]:
        """Give directions (rad) at the beginning and the end of each, two of (n,)."""
        ends = [
            [each[:, 1] + 2.0 * t * each[:, 2] for each in (self.y, self.z)]
            for t in (np.zeros(len(self)), self.length)
        ]
        return np.arctan2(ends[0][1], ends[0][0]), np.arctan2(ends[1][1], ends[1][0])

    def area(self) -> float:
        """Give the integral of y dz over all of them, m2."""
        return float((self._integral(self.length) - self._integral(0.0 * self.length)).sum())

    def area_below(self, level: float) -> float:
        """Give the integral of y dz over what lies at or below a level (m), m2."""
        if not np.isfinite(level):
            return self.area() if level > 0.0 else 0.0
        return float(self.each_below(level)[0].sum())

    def moment_below(self, level: float) -> float:
        """Give the integral of y z dz over what lies at or below a level (m), m3."""
        return float(self.each_below(min(max(level, -_FAR), _FAR))[1].sum())

    def each_below(self, level: float) -> tuple[FloatArray, FloatArray]:
        """Give both integrals, m2 and m3, of each piece by itself, two of (n,)."""
        inner = np.sort(np.nan_to_num(np.clip(self._roots(level), 0.0, self.length[:, None])))
        breaks = np.column_stack([np.zeros(len(self)), inner, self.length])
        low, high = breaks[:, :-1], breaks[:, 1:]
        wet = self._polynomial(self.z, 0.5 * (low + high)) <= level
        area = self._integral(high) - self._integral(low)
        # Three nodes of Gauss are exact to the fifth power, which is what stands here.
        node, weight = _GAUSS
        p = (0.5 * (low + high)[..., None] + 0.5 * (high - low)[..., None] * node).reshape(
            len(self), -1
        )
        y, z = (self._polynomial(each, p) for each in (self.y, self.z))
        rise = self.z[:, 1:2] + 2.0 * p * self.z[:, 2:]
        moment = (y * z * rise).reshape(*wet.shape, 3) @ weight * 0.5 * (high - low)
        return np.where(wet, area, 0.0).sum(axis=1), np.where(wet, moment, 0.0).sum(axis=1)

    def crossings(self, level: float) -> FloatArray:
        """Give y (m) where each passes a level (m), (n, 2); nan where it does not."""
        p = self._roots(level)
        return np.asarray(self._polynomial(self.y, p))

    def _roots(self, level: float) -> FloatArray:
        """Give p where each passes a level, (n, 2), nan where it does not."""
        a, b, c = self.z[:, 2], self.z[:, 1], self.z[:, 0] - level
        root = np.sqrt(np.maximum(b * b - 4.0 * a * c, 0.0))
        # The stable form: no difference of numbers that are nearly the same.
        half = -0.5 * (b + np.where(b < 0.0, -root, root))
        with np.errstate(divide="ignore", invalid="ignore"):
            roots = np.stack([c / half, half / a], axis=1)
        slack = _SLACK * self.length[:, None]
        real = (b * b - 4.0 * a * c >= 0.0)[:, None] & np.isfinite(roots)
        real &= (roots >= -slack) & (roots <= self.length[:, None] + slack)
        return np.where(real, roots, np.nan)

    def _polynomial(self, of: FloatArray, p: FloatArray) -> FloatArray:
        c = of if p.ndim == 1 else of[:, :, None]
        return np.asarray(c[:, 0] + p * (c[:, 1] + p * c[:, 2]))

    def _integral(self, p: FloatArray) -> FloatArray:
        """Integrate y dz from 0 to p, (n,) or (n, k)."""
        y, z = (each if p.ndim == 1 else each[:, :, None] for each in (self.y, self.z))
        one = y[:, 0] * z[:, 1]
        two = 0.5 * (y[:, 1] * z[:, 1] + 2.0 * y[:, 0] * z[:, 2])
        three = (y[:, 2] * z[:, 1] + 2.0 * y[:, 1] * z[:, 2]) / 3.0
        four = 0.5 * y[:, 2] * z[:, 2]
        return np.asarray(p * (one + p * (two + p * (three + p * four))))
