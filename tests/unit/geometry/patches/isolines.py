"""Polynomials with known zero sets, and signs of curvature found without polynomials."""

from math import comb

import numpy as np
from scipy.interpolate import BSpline

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.curvature_functions import IsoFunction

Box = tuple[float, float, float, float]


def batch(nets: FloatArray) -> Patches:
    """Patches of nets (k, m + 1, n + 1, 3)."""
    box = np.tile(np.array([[0.0, 1.0], [0.0, 1.0]]), (len(nets), 1, 1))
    return Patches(nets.copy(), box, np.zeros(len(nets), np.int64))


def polynomial(
    terms: dict[tuple[int, int], float], degree: int, box: Box = (0.0, 1.0, 0.0, 1.0)
) -> FloatArray:
    """Bernstein coefficients of a sum of c x**i y**j on a box."""
    c = np.zeros((degree + 1, degree + 1))
    for (i, j), value in terms.items():
        c[i, j] = value
    return _from_powers(degree, *box[:2]) @ c @ _from_powers(degree, *box[2:]).T


def _from_powers(degree: int, low: float, high: float) -> FloatArray:
    """The matrix from coefficients of powers of x to Bernstein coefficients on an interval."""
    found = np.zeros((degree + 1, degree + 1))
    power = np.ones(1)
    for i in range(degree + 1):
        for j in range(degree + 1):
            found[j, i] = sum(power[k] * comb(j, k) / comb(degree, k) for k in range(min(i, j) + 1))
        power = np.convolve(power, [low, high - low])
    return found


def function(*polynomials: FloatArray) -> IsoFunction:
    """Polynomials that are known to rounding."""
    b = np.stack(polynomials)
    size = np.abs(b).max(axis=(1, 2), keepdims=True)
    return IsoFunction(b, np.broadcast_to(1e-14 * size, b.shape).copy())


def plate(terms: dict[tuple[int, int], float], box: Box = (-1.0, 1.0, -1.0, 1.0)) -> FloatArray:
    """The net (4, 4, 3) of the bicubic plate z(x, y), a sum of c x**i y**j, on a box."""
    net = np.zeros((4, 4, 3))
    net[..., 0] = np.linspace(box[0], box[1], 4)[:, None]
    net[..., 1] = np.linspace(box[2], box[3], 4)
    net[..., 2] = polynomial(terms, 3, box)
    return net


def monkey(radius: float, box: Box = (-0.8, 1.0, -0.9, 0.7)) -> FloatArray:
    """A monkey saddle that is convex in a disc about x = y = 0, and nowhere else."""
    terms = {(3, 0): 1.0, (1, 2): -3.0, (2, 0): 3.0 * radius, (0, 2): 3.0 * radius}
    return plate(terms, box)


def pointwise(nets: FloatArray, patch: IntArray, uv: FloatArray) -> FloatArray:
    """L N - M**2 of bicubic nets at (c, p, 2), from derivatives by scipy, no polynomial of it."""
    spline = BSpline(np.repeat([0.0, 1.0], 4), np.eye(4), 3)
    u, v = ([spline(uv[..., axis], order) for order in range(3)] for axis in (0, 1))
    control = nets[patch]

    def at(i: int, j: int) -> FloatArray:
        lines = np.einsum("cpi,cijk->cpjk", u[i], control)
        return np.asarray(np.einsum("cpj,cpjk->cpk", v[j], lines))

    normal = np.cross(at(1, 0), at(0, 1))
    l, m, n = ((normal * at(i, 2 - i)).sum(axis=-1) for i in (2, 1, 0))
    return np.asarray(l * n - m * m)
