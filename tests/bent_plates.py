"""Plates with shapes that are known in closed form, as Bezier surfaces."""

from collections.abc import Callable

import numpy as np
from scipy.integrate import quad

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.tensor_bernstein import bernstein_basis
from assoc_hull.geometry.patches.spline_surface import SplineSurface

Shape = Callable[[FloatArray, FloatArray], tuple[FloatArray, ...]]


def interpolated(shape: Shape, m: int = 7, n: int = 7, name: str = "") -> SplineSurface:
    """The Bezier surface through a shape (x, y, z) of u and v from -1 to 1."""
    at = [np.cos(np.pi * np.arange(degree, -1, -1) / degree) for degree in (m, n)]
    u, v = np.meshgrid(*at, indexing="ij")
    place = np.stack(np.broadcast_arrays(*shape(u, v)), axis=-1)
    rows, columns = (bernstein_basis(d, 0.5 + 0.5 * t) for d, t in zip((m, n), at, strict=True))
    net = np.linalg.solve(rows, place.reshape(m + 1, -1)).reshape(place.shape)
    net = np.linalg.solve(columns, np.swapaxes(net, 0, 1).reshape(n + 1, -1))
    return SplineSurface.bezier(np.swapaxes(net.reshape(n + 1, m + 1, 3), 0, 1), name)


def sphere(length: float, breadth: float, radius: float = 10.0) -> SplineSurface:
    """A strip of a sphere along its equator: K = 1 / radius**2."""
    a, b = 0.5 * length / radius, 0.5 * breadth / radius
    return interpolated(
        lambda u, v: (
            radius * np.cos(b * v) * np.sin(a * u), radius * np.sin(b * v),
            radius * np.cos(b * v) * np.cos(a * u),
        )
    )  # fmt: skip


def pseudosphere(length: float, breadth: float, radius: float = 10.0) -> SplineSurface:
    """A strip about the waist of a surface of revolution with K = -1 / radius**2."""
    a, b = 0.5 * length / radius, 0.5 * breadth / radius

    def height(v: float) -> float:
        return float(quad(lambda t: np.sqrt(1.0 - np.sinh(t) ** 2), 0.0, v)[0])

    heights = np.vectorize(height)
    return interpolated(
        lambda u, v: (
            radius * np.cosh(b * v) * np.cos(a * u), radius * np.cosh(b * v) * np.sin(a * u),
            radius * heights(b * v),
        )
    )  # fmt: skip


def cylinder(length: float, girth: float, radius: float, askew: float = 0.0) -> SplineSurface:
    """A part of a cylinder, with parameter lines at an angle (radians) to its rulings."""

    def shape(u: FloatArray, v: FloatArray) -> tuple[FloatArray, ...]:
        x, y = 0.5 * length * u, 0.5 * girth * v
        along = np.cos(askew) * x - np.sin(askew) * y
        around = (np.sin(askew) * x + np.cos(askew) * y) / radius
        return along, radius * np.sin(around), radius * np.cos(around)

    return interpolated(shape)


def cone(near: float, far: float, half_angle_deg: float, turn_deg: float) -> SplineSurface:
    """A sector of a cone from one distance to another from its tip, v about its axis."""
    half, turn = np.radians(half_angle_deg), 0.5 * np.radians(turn_deg)

    def shape(u: FloatArray, v: FloatArray) -> tuple[FloatArray, ...]:
        r = 0.5 * (near + far) + 0.5 * (far - near) * u
        across = r * np.sin(half)
        return across * np.cos(turn * v), across * np.sin(turn * v), r * np.cos(half) + 0.0 * v

    return interpolated(shape, 1)


def moved(surface: SplineSurface, seed: int = 0) -> SplineSurface:
    """The same shape, turned and shifted somewhere in a ship."""
    rng = np.random.default_rng(seed)
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    turn *= np.sign(np.linalg.det(turn))
    net = surface.net @ turn.T + rng.uniform(-20.0, 100.0, 3)
    return SplineSurface(surface.name, surface.degrees, surface.knots_u, surface.knots_v, net)
