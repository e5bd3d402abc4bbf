"""What curvature is made of on rational patches: planes T, and products of them.

With the weighted points H = (w x, w y, w z, w), of degrees (m, n), the tangent plane is the vector
of 3 x 3 minors T of [H, H_u, H_v], T = w**3 (S, -r.S) with S = r_u x r_v, and

    L* = T.H_uu = w**4 L      M* = T.H_uv = w**4 M      N* = T.H_vv = w**4 N

are determinants of order 4. So A* = L* N* - M***2 = w**8 A has the sign of K, its degrees are
(8m - 4, 8n - 4), and with S*, the first three components of T,

    K = A* w**4 / |S*|**4

of degrees (12m - 4, 12n - 4) above and below. Points are taken from a corner of the patch, which
changes none of this; a difference of weighted points is w_1 (P_1 - P_0) + (w_1 - w_0) P_0, both of
them exact but for their last digit. Minors of differing weights are small sums of large terms: so
errors are carried from operation to operation (`running_bounds`).

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.patches import Patches
>>> from assoc_hull.geometry.patches.rational_terms import RationalTerms
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0], net[:, 1, 1] = 2.0, 1.0
>>> RationalTerms.of(Patches.single(net, np.ones((2, 2))), 0.0).area().b[0, 0, 0].item()
4.0
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.curvature_terms import Delta
from assoc_hull.geometry.patches.patches import Patches
from assoc_hull.geometry.patches.running_bounds import EPS, Running

__all__ = ["RationalTerms"]

_FIRST, _SECOND = [0, 0, 0, 1, 1, 2], [1, 2, 3, 2, 3, 3]
"""The pairs of rows of the 2 x 2 minors of [H_u, H_v]."""

_EXPANSION = (
    ([1, 0, 0, 0], [5, 5, 4, 3], 1.0),
    ([2, 2, 1, 1], [4, 2, 2, 1], -1.0),
    ([3, 3, 3, 2], [3, 1, 0, 0], 1.0),
)
"""How T is summed: components of H, minors, and the sign of the first component; they alternate."""

_ALTERNATING = np.array([1.0, -1.0, 1.0, -1.0]).reshape(4, 1, 1)


@attrs.frozen(eq=False)
class RationalTerms:
    """Derivatives of weighted points, and tangent planes, with their errors.

    Attributes
    ----------
    weight : Running, (k, m + 1, n + 1)
        The weights, which are exact.
    huu, huv, hvv : Running, (k, 4, ...), m
        Second derivatives of (w x, w y, w z, w); None where the degree is 1.
    plane : Running, (k, 4, 3m, 3n)
        The minors T.
    """

    weight: Running
    huu: Running | None
    huv: Running
    hvv: Running | None
    plane: Running

    @classmethod
    def of(cls, patches: Patches, delta: Delta) -> Self:
        """Give the terms of rational patches.

        Parameters
        ----------
        patches : Patches
            The patches.
        delta : float or (k,), m
            How far each coordinate of a control point may be off.
        """
        weight = np.ones(patches.net.shape[:3]) if patches.weight is None else patches.weight
        off = np.asarray(delta, np.float64).reshape(-1, 1, 1, 1)
        h, hu, hv = _weighted(patches, weight[:, None], off)
        m, n = patches.degrees
        huu = hu.derivative(-2) if m > 1 else None
        hvv = hv.derivative(-1) if n > 1 else None
        exact = Running(weight, np.zeros_like(weight))
        return cls(exact, huu, hu.derivative(-1), hvv, _plane(h, hu, hv))

    def gauss(self) -> Running:
        """Give A* = L* N* - M***2, (k, 8m - 3, 8n - 3), m6."""
        middle = self.plane.dot(self.huv)
        square = middle.times(middle)
        if self.huu is None or self.hvv is None:
            return Running(0.0 - square.b, square.err)
        product = self.plane.dot(self.huu).times(self.plane.dot(self.hvv))
        return product.plus(square, -1.0)

    def weighted(self, a: Running) -> Running:
        """Give A* times w**4, (k, 12m - 3, 12n - 3), m6."""
        square = self.weight.times(self.weight)
        return a.times(square.times(square))

    def area(self) -> Running:
        """Give |S*|**2, (k, 6m - 1, 6n - 1), m4."""
        s = self.plane[:3]
        return s.dot(s)

    def quartic(self, area: Running) -> Running:
        """Give |S*|**4 of |S*|**2, (k, 12m - 3, 12n - 3), m8."""
        return area.times(area)


def _weighted(
    patches: Patches, weight: FloatArray, off: FloatArray
) -> tuple[Running, Running, Running]:
    """Give H, H_u and H_v with coordinates that are off by so much."""
    points = patches.components
    place = points - points[..., :1, :1]
    place_off = off + EPS * np.abs(place)
    exact = np.zeros_like(weight)
    point = weight * place
    found = [_joined(point, weight * place_off + EPS * np.abs(point), weight, exact)]
    for axis, degree in zip((-2, -1), patches.degrees, strict=True):
        low, high = (np.arange(degree) + i for i in (0, 1))
        step, rise = np.diff(points, axis=axis), np.diff(weight, axis=axis)
        rise_off = EPS * np.abs(rise)
        first, second = weight.take(high, axis) * step, rise * place.take(low, axis)
        err = weight.take(high, axis) * (2.0 * off + EPS * np.abs(step))
        err = err + (np.abs(rise) + rise_off) * place_off.take(low, axis)
        err = err + 5.0 * EPS * (np.abs(first) + np.abs(second))
        found.append(
            _joined(degree * (first + second), degree * err, degree * rise, 2 * degree * rise_off)
        )
    return found[0], found[1], found[2]


def _joined(
    point: FloatArray, err: FloatArray, weight: FloatArray, weight_err: FloatArray
) -> Running:
    """Put three components and the fourth together, (k, 4, m + 1, n + 1)."""
    return Running(
        np.concatenate([point, weight], axis=1), np.concatenate([err, weight_err], axis=1)
    )


def _plane(h: Running, hu: Running, hv: Running) -> Running:
    """Give the minors of [H, H_u, H_v]."""
    minors = hu[_FIRST].times(hv[_SECOND]).plus(hu[_SECOND].times(hv[_FIRST]), -1.0)
    parts = []
    for rows, pairs, sign in _EXPANSION:
        part = h[rows].times(minors[pairs])
        parts.append(Running(sign * _ALTERNATING * part.b, part.err))
    return parts[0].plus(parts[1]).plus(parts[2])
