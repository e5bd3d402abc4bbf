"""Sides of hulls y = f(x, z) with a formula, as exact spline surfaces, and what is true of them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.polynomial.legendre import leggauss

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface

__all__ = ["BOWL", "HYPAR", "Side"]

Formula = Callable[[FloatArray, FloatArray], FloatArray]


class Side:
    """A side y = c0 + cx x**2 + cz z**2 + cxz x z over a rectangle, m."""

    def __init__(self, c0: float, cx: float, cz: float, cxz: float) -> None:
        self.c0, self.cx, self.cz, self.cxz = c0, cx, cz, cxz

    def y(self, x: FloatArray, z: FloatArray) -> FloatArray:
        """The half breadth, m."""
        return self.c0 + self.cx * x * x + self.cz * z * z + self.cxz * x * z

    def surface(
        self, x: tuple[float, float], z: tuple[float, float], spans: tuple[int, int], name: str
    ) -> SplineSurface:
        """The biquadratic spline surface over a rectangle: v runs downward, normals outward."""
        ends = zip((x, z[::-1]), spans, strict=True)
        u, v = (np.linspace(low, high, count + 1) for (low, high), count in ends)
        ku, kv = (np.concatenate([[k[0]] * 2, k, [k[-1]] * 2]) for k in (u, v[::-1]))
        a, b = (np.stack([k[1:-2], k[2:-1]], axis=-1) for k in (ku, kv))  # pairs of a blossom
        mean_a, mean_b = a.mean(axis=-1)[:, None], b.mean(axis=-1)[None, :]
        y = (
            self.c0 + self.cx * a.prod(axis=-1)[:, None] + self.cz * b.prod(axis=-1)[None, :]
            + self.cxz * mean_a * mean_b
        )  # fmt: skip
        net = np.stack(np.broadcast_arrays(mean_a, y, mean_b), axis=-1)[:, ::-1]
        return SplineSurface(name, (2, 2), ku, -kv[::-1], net)

    def element(self, x: FloatArray, z: FloatArray) -> FloatArray:
        """The area for a unit of x and z."""
        fx, fz = self.slopes(x, z)
        return np.sqrt(1.0 + fx * fx + fz * fz)

    def slopes(self, x: FloatArray, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """dy/dx and dy/dz."""
        return 2.0 * self.cx * x + self.cxz * z, 2.0 * self.cz * z + self.cxz * x

    def gauss(self, x: FloatArray, z: FloatArray) -> FloatArray:
        """Gaussian curvature, 1/m2."""
        return (4.0 * self.cx * self.cz - self.cxz**2) / self.element(x, z) ** 4

    def area(self, x: tuple[float, float], z: tuple[float, float], above: float = 0.0) -> float:
        """The area over a rectangle where |K| exceeds a level, m2.

        Along a line x = constant it is where |slope|**2, a quadratic in z, stays below a limit.
        """
        panels, (at, weight) = 4000, leggauss(3)
        step = (x[1] - x[0]) / panels
        xs = (x[0] + step * (np.arange(panels)[:, None] + 0.5 + 0.5 * at)).ravel()
        low, high = np.full(len(xs), z[0]), np.full(len(xs), z[1])
        if above > 0.0:
            limit = np.sqrt(abs(4.0 * self.cx * self.cz - self.cxz**2) / above) - 1.0
            a = 4.0 * self.cz**2 + self.cxz**2
            b = 2.0 * (2.0 * self.cx * self.cxz + 2.0 * self.cz * self.cxz) * xs
            c = (4.0 * self.cx**2 + self.cxz**2) * xs**2 - limit
            root = np.sqrt(np.maximum(b * b - 4.0 * a * c, 0.0))
            low = np.clip((-b - root) / (2.0 * a), *z)
            high = np.clip((-b + root) / (2.0 * a), *z)
        inner, inner_weight = leggauss(24)
        zs = 0.5 * (low + high)[:, None] + 0.5 * (high - low)[:, None] * inner
        along = 0.5 * (high - low) * (self.element(xs[:, None], zs) @ inner_weight)
        return float((along.reshape(panels, 3) @ weight).sum() * 0.5 * step)


BOWL = Side(8.0, -2.5e-2, -0.1, 0.0)
"""Convex: K = 0.01 1/m2 in the middle, less outward."""

HYPAR = Side(8.0, 0.0, 0.0, 6e-2)
"""A saddle: K = -0.0036 1/m2 in the middle, less outward."""
