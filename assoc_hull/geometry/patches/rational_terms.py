"""What curvature is made of on rational patches: planes T, and products of them.

With the weighted points H = (w x, w y, w z, w), of degrees (m, n), the tangent plane is the vector
of 3 x 3 minors T of [H, H_u, H_v], T = w**3 (S, -r.S) with S = r_u x r_v, and

    L* = T.H_uu = w**4 L      M* = T.H_uv = w**4 M      N* = T.H_vv = w**4 N

are determinants of order 4. So A* = L* N* - M***2 = w**8 A has the sign of K, its degrees are
(8m - 4, 8n - 4), and with S*, the first three components of T,

    K = A* w**4 / |S*|**4

of degrees (12m - 4, 12n - 4) above and below. Points are taken from a corner of the patch, which
changes none of this; a difference of weighted points is w_1 (P_1 - P_0) + (w_1 - w_0) P_0, both of
them exact but for their last digit. Amounts are those of `curvature_terms`.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.patches import Patches
>>> from assoc_hull.geometry.patches.rational_terms import area_squared, values
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0], net[:, 1, 1] = 2.0, 1.0
>>> area_squared(values(Patches.single(net, np.ones((2, 2)))))[0, 0, 0].item()
4.0
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.algebra import dot, multiply, u_derivative, v_derivative
from assoc_hull.geometry.patches.curvature_terms import Delta, Steps, less, sums
from assoc_hull.geometry.patches.patches import Patches

__all__ = [
    "RationalTerms", "amounts", "area_squared", "gauss_numerator", "steps", "values",
    "weight_fourth",
]  # fmt: skip

_FIRST, _SECOND = [0, 0, 0, 1, 1, 2], [1, 2, 3, 2, 3, 3]
"""The pairs of rows of the 2 x 2 minors of [H_u, H_v]."""

_EXPANSION = (
    ([1, 0, 0, 0], [5, 5, 4, 3], 1.0),
    ([2, 2, 1, 1], [4, 2, 2, 1], -1.0),
    ([3, 3, 3, 2], [3, 1, 0, 0], 1.0),
)
"""How T is summed: components of H, minors, and the sign of the first component; they alternate."""


@attrs.frozen(eq=False)
class RationalTerms:
    """Derivatives of weighted points, and tangent planes: values, or amounts.

    Attributes
    ----------
    signed : bool
        Whether these are values.
    weight : (k, m + 1, n + 1)
        The weights.
    huu, huv, hvv : (k, 4, ...), m
        Second derivatives of (w x, w y, w z, w); None where the degree is 1.
    plane : (k, 4, 3m, 3n)
        The minors T.
    """

    signed: bool
    weight: FloatArray
    huu: FloatArray | None
    huv: FloatArray
    hvv: FloatArray | None
    plane: FloatArray


def _weights(patches: Patches) -> FloatArray:
    weight = patches.weight
    return np.ones(patches.net.shape[:3]) if weight is None else weight


def _homogeneous(
    patches: Patches, off: FloatArray, signed: bool
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give H, H_u and H_v, or the amounts of them with coordinates that are off by so much."""
    size = np.positive if signed else np.abs
    points, weight = patches.components, _weights(patches)[:, None]
    place = size(points - points[..., :1, :1]) + off
    found = [np.concatenate([weight * place, weight], axis=1)]
    for axis, degree in zip((-2, -1), patches.degrees, strict=True):
        low, high = (np.arange(degree) + i for i in (0, 1))
        steps = size(np.diff(points, axis=axis)) + 2.0 * off
        rise = size(np.diff(weight, axis=axis))
        moved = weight.take(high, axis) * steps + rise * place.take(low, axis)
        found.append(degree * np.concatenate([moved, rise], axis=1))
    return found[0], found[1], found[2]


def _plane(h: FloatArray, hu: FloatArray, hv: FloatArray, signed: bool) -> FloatArray:
    """Give the minors of [H, H_u, H_v]; of amounts, the sums of sizes."""
    minors = less(
        multiply(hu[:, _FIRST], hv[:, _SECOND]), multiply(hu[:, _SECOND], hv[:, _FIRST]), signed
    )
    alternating = np.array([1.0, -1.0, 1.0, -1.0]).reshape(4, 1, 1)
    parts = []
    for rows, pairs, sign in _EXPANSION:
        part = multiply(h[:, rows], minors[:, pairs])
        parts.append(sign * alternating * part if signed else part)
    return parts[0] + parts[1] + parts[2]


def values(patches: Patches) -> RationalTerms:
    """Give the terms of rational patches."""
    h, hu, hv = _homogeneous(patches, np.zeros((1, 1, 1, 1)), True)
    m, n = patches.degrees
    huu = u_derivative(hu) if m > 1 else None
    hvv = v_derivative(hv) if n > 1 else None
    plane = _plane(h, hu, hv, True)
    return RationalTerms(True, _weights(patches), huu, v_derivative(hu), hvv, plane)


def amounts(patches: Patches, delta: Delta) -> RationalTerms:
    """Give the amounts of terms, with control points that may be wrong; weights are exact.

    Parameters
    ----------
    patches : Patches
        The patches.
    delta : float or (k,), m
        How far each coordinate of a control point may be off.
    """
    off = np.asarray(delta, np.float64).reshape(-1, 1, 1, 1)
    h, hu, hv = _homogeneous(patches, off, False)
    m, n = patches.degrees
    huu = sums(hu, -2) if m > 1 else None
    hvv = sums(hv, -1) if n > 1 else None
    plane = _plane(h, hu, hv, False)
    return RationalTerms(False, _weights(patches), huu, sums(hu, -1), hvv, plane)


def gauss_numerator(terms: RationalTerms) -> FloatArray:
    """Give A* = L* N* - M***2, (k, 8m - 3, 8n - 3), m6."""
    middle = dot(terms.plane, terms.huv)
    square = multiply(middle, middle)
    if terms.huu is None or terms.hvv is None:
        return 0.0 - square if terms.signed else square
    product = multiply(dot(terms.plane, terms.huu), dot(terms.plane, terms.hvv))
    return less(product, square, terms.signed)


def area_squared(terms: RationalTerms) -> FloatArray:
    """Give |S*|**2, (k, 6m - 1, 6n - 1), m4."""
    s = terms.plane[:, :3]
    return dot(s, s)


def weight_fourth(terms: RationalTerms) -> FloatArray:
    """Give w**4, (k, 4m + 1, 4n + 1)."""
    square = multiply(terms.weight, terms.weight)
    return multiply(square, square)


def steps(m: int, n: int) -> dict[str, Steps]:
    """Give how many roundings A*, |S*|**2 and w**4 have, one behind the other."""
    h, hu, hv = Steps((m, n), 2), Steps((m - 1, n), 6), Steps((m, n - 1), 6)
    plane = hu.times(hv, 1).times(h, 2)
    seconds = (max(m - 2, 0), n), (m - 1, n - 1), (m, max(n - 2, 0))
    l, middle, right = (plane.times(Steps(degrees, 8), 3) for degrees in seconds)
    gauss = max(l.times(right, 1), middle.times(middle, 1), key=lambda each: each.count)
    weight = Steps((m, n), 0)
    square = weight.times(weight)
    return {"gauss": gauss, "area": plane.times(plane, 2), "weight": square.times(square)}
