"""Polynomials that have the sign of Gaussian and mean curvature, and what rounding may do to them.

With S = r_u x r_v and the unnormalised second form L = S.r_uu, M = S.r_uv, N = S.r_vv

    A = L N - M**2         K = A / |S|**4
    B = E N - 2 F M + G L  H = B / (2 |S|**3)

so K has the sign of A. All are polynomials in Bernstein form; beside A stands a bound of the error
of each of its coefficients, found by the same algebra on amounts with all signs positive.

Source: the idea of iso-curves of curvature on the patches of a plate is that of "Curvature Region
Analysis for Application of Plates Forming", J. SNAK; the degrees and bounds here are our own.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.curvature_functions import gauss_function
>>> from assoc_hull.geometry.patches.patches import Patches
>>> net = np.zeros((4, 4, 3))
>>> net[..., 0], net[..., 1] = np.mgrid[0:4, 0:4] / 3.0
>>> found = gauss_function(Patches.single(net), 0.0)
>>> found.b.shape, bool((found.b == 0.0).all())
((1, 15, 15), True)
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.patches.algebra import (
    add,
    cross,
    degrees,
    dot,
    elevated,
    multiply,
    subtract,
    u_derivative,
    v_derivative,
)  # fmt: skip
from assoc_hull.geometry.patches.patches import Patches

__all__ = ["IsoFunction", "gauss_function"]

_EPS = 2.0**-53

Operation = Callable[[FloatArray, FloatArray], FloatArray]


@attrs.frozen(eq=False)
class IsoFunction:
    """Polynomials, one a patch, whose zero sets are wanted.

    Attributes
    ----------
    b : (k, M + 1, N + 1)
        Bernstein coefficients; positive where the curvature lies above the level.
    err : (k, M + 1, N + 1)
        What each coefficient may be off by: rounding, and the uncertainty of the control points.
    """

    b: FloatArray
    err: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.b, self.err)


def gauss_function(
    patches: Patches, level: float, delta: float | FloatArray = 0.0
) -> IsoFunction:
    """Give the polynomial that is positive where the Gaussian curvature exceeds a level.

    Parameters
    ----------
    patches : Patches
        The patches.
    level : float, 1/m2
        The curvature K0; for 0 the polynomial is A itself, else A - K0 |S|**4.
    delta : float or (k,), m
        Each coordinate of a control point may be wrong by so much, in all patches or in each.

    Returns
    -------
    IsoFunction
        Coefficients and their error bounds; degrees (6m - 4, 6n - 4) for 0, else (8m - 4, 8n - 4).
    """
    r = patches.components
    ru, rv = u_derivative(r), v_derivative(r)
    s = cross(ru, rv)
    second = u_derivative(ru), v_derivative(ru), v_derivative(rv)
    a = _gauss(s, *second, subtract)
    none, off = np.zeros((1, 1, 1, 1)), np.reshape(delta, (-1, 1, 1, 1))
    amount, normal = _amounts(ru, rv, none)
    err = 200.0 * _EPS * amount
    if off.any():
        err = err + (_amounts(ru, rv, off)[0] - amount)
    if level == 0.0:
        return IsoFunction(a, err)
    return _shifted(a, err, level, s, normal)


def _shifted(
    a: FloatArray, err: FloatArray, level: float, s: FloatArray, normal: FloatArray
) -> IsoFunction:
    """Subtract the level times |S|**4, with the error of that."""
    area, amount = dot(s, s), dot(normal, normal)
    quartic, wide = multiply(area, area), multiply(amount, amount)
    m, n = degrees(quartic)
    raised = elevated(a, m, n)
    off = elevated(err, m, n) + 60.0 * _EPS * elevated(np.abs(a), m, n)
    return IsoFunction(raised - level * quartic, off + abs(level) * 350.0 * _EPS * wide)


def _gauss(
    s: FloatArray, ruu: FloatArray, ruv: FloatArray, rvv: FloatArray, minus: Operation
) -> FloatArray:
    """Give L N - M**2, or with amounts and `add` what bounds the sizes of its terms."""
    l, m, n = dot(s, ruu), dot(s, ruv), dot(s, rvv)
    return minus(multiply(l, n), multiply(m, m))


def _sums(a: FloatArray, axis: int) -> FloatArray:
    """Bound the derivative of what has coefficients of these amounts."""
    degree = a.shape[axis] - 1
    if degree == 0:
        return np.zeros_like(a)
    low, high = a.take(range(degree), axis), a.take(range(1, degree + 1), axis)
    return np.asarray(degree * (low + high))


def _amounts(ru: FloatArray, rv: FloatArray, delta: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give the amounts that A and the vector S are summed of, coefficient by coefficient."""
    m, n = ru.shape[-2], rv.shape[-1]
    du, dv = np.abs(ru) + 2 * m * delta, np.abs(rv) + 2 * n * delta
    ruu = _sums(np.abs(ru), -2) + 4 * m * (m - 1) * delta
    ruv = _sums(np.abs(ru), -1) + 4 * m * n * delta
    rvv = _sums(np.abs(rv), -1) + 4 * n * (n - 1) * delta
    after, last = [1, 2, 0], [2, 0, 1]
    s = multiply(du[..., after, :, :], dv[..., last, :, :])
    s += multiply(du[..., last, :, :], dv[..., after, :, :])
    return _gauss(s, ruu, ruv, rvv, add), s
