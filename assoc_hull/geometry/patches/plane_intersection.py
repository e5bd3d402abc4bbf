"""Points near a spline surface put on it, in planes across the axes: Newton's method in parameters.

A point goes to the place in its plane that is reached by the shortest way along the surface; on
the border of the parameters it stays there.

Source: N.M. Patrikalakis, T. Maekawa, Shape Interrogation for Computer Aided Design and
Manufacturing, Springer 2002, chapter 5.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.plane_intersection import intersect_plane
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> net = np.zeros((3, 2, 3))
>>> net[..., 0], net[..., 1] = np.mgrid[0:3, 0:2]
>>> net[1, :, 2] = 1.0
>>> found = intersect_plane(SplineSurface.bezier(net), [[0.3, 0.5]], [2], [0.375])
>>> found.xyz.round(12), found.sine.round(6)
(array([[0.5  , 0.5  , 0.375]]), array([0.447214]))
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.bezier_patches import inner, jets
from assoc_hull.geometry.patches.knots import nonempty_spans, span_limits
from assoc_hull.geometry.patches.spline_surface import SplineSurface

__all__ = ["SurfacePlaneIntersection", "intersect_plane", "surface_derivatives"]

_STEPS = 6
_BORDER = 1e-9
"""Parameters this part of the domain from its border are on it."""

_FLAT = 1e-12


@attrs.frozen(eq=False)
class SurfacePlaneIntersection:
    """Points of a surface in planes.

    Attributes
    ----------
    xyz : (n, 3), m
        Points of the surface.
    uv : (n, 2)
        Their parameters.
    off : (n,), m
        How far each is still off its plane.
    sine : (n,)
        Sine of the angle between plane and surface.
    """

    xyz: FloatArray
    uv: FloatArray
    off: FloatArray
    sine: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.xyz, self.uv, self.off, self.sine)


def surface_derivatives(
    surface: SplineSurface, uv: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give points of a surface and both first derivatives at parameters (n, 2), each (n, 3)."""
    rows, local, width = [], [], []
    counts = []
    for axis, knots in enumerate((surface.knots_u, surface.knots_v)):
        limit = span_limits(knots, surface.degrees[axis])
        at = np.clip(np.searchsorted(limit[:, 0], uv[:, axis], "right") - 1, 0, len(limit) - 1)
        rows.append(at)
        width.append(limit[at, 1] - limit[at, 0])
        local.append((uv[:, axis] - limit[at, 0]) / width[-1])
        counts.append(len(nonempty_spans(knots, surface.degrees[axis])))
    found = jets(surface.patches(), rows[0] * counts[1] + rows[1], np.stack(local, axis=1))
    return found.r, found.ru / width[0][:, None], found.rv / width[1][:, None]


def intersect_plane(
    surface: SplineSurface,
    uv: ArrayLike,
    axis: ArrayLike,
    offset: ArrayLike,
    also: tuple[ArrayLike, int, float] | None = None,
) -> SurfacePlaneIntersection:
    """Bring points of a surface into planes.

    Parameters
    ----------
    surface : SplineSurface
        The surface.
    uv : (n, 2)
        Where to begin.
    axis : (n,) int
        The coordinate that is constant in the plane of each.
    offset : (n,), m
        What it is there.
    also : ((n,) bool, int, float), optional
        Which points are to lie in a second plane too: its axis, and its place in m.

    Returns
    -------
    SurfacePlaneIntersection
    """
    at = np.array(uv, np.float64).reshape(-1, 2)
    axes = np.asarray(axis, np.int64).reshape(-1)
    wanted = np.asarray(offset, np.float64).reshape(-1)
    chosen, other, place = (np.zeros(len(at), np.bool_), 0, 0.0) if also is None else also
    low, high = np.array(surface.domain).T
    near = _BORDER * (high - low)
    at = np.where(at < low + near, low, np.where(at > high - near, high, at))
    held = (at == low) | (at == high)
    both: NDArray[np.bool_] = np.array(chosen, np.bool_) & ~held.any(axis=1) & (axes != other)
    every = np.arange(len(at))
    for _ in range(_STEPS):
        r, ru, rv = surface_derivatives(surface, at)
        miss = wanted - r[every, axes]
        step = _steps(ru, rv, axes, miss, held)
        if both.any():
            away = place - r[both, other]
            step[both] = _two(ru[both], rv[both], axes[both], miss[both], other, away)
        limited = np.clip(step, -0.25 * (high - low), 0.25 * (high - low))
        at = np.clip(at + limited, low, high)
    r, ru, rv = surface_derivatives(surface, at)
    return SurfacePlaneIntersection(r, at, np.abs(wanted - r[every, axes]), _sines(ru, rv, axes))


def _steps(
    ru: FloatArray, rv: FloatArray, axis: IntArray, miss: FloatArray, held: NDArray[np.bool_]
) -> FloatArray:
    """Give the shortest steps (n, 2) that mend the miss; along a border where it is held."""
    every = np.arange(len(axis))
    gu, gv = ru[every, axis], rv[every, axis]
    e, f, g = inner(ru, ru), inner(ru, rv), inner(rv, rv)
    w = np.stack([g * gu - f * gv, e * gv - f * gu], axis=1)  # of unit length: det times this
    rate = w[:, 0] * gu + w[:, 1] * gv
    size = e * g
    free = _over(w * miss[:, None], rate[:, None], _FLAT * (size * (e + g))[:, None])
    along_v = np.stack([np.zeros_like(gv), _over(miss, gv, _FLAT * np.sqrt(g))], axis=1)
    along_u = np.stack([_over(miss, gu, _FLAT * np.sqrt(e)), np.zeros_like(gu)], axis=1)
    found = np.where(held[:, :1], along_v, np.where(held[:, 1:], along_u, free))
    return np.where(held[:, :1] & held[:, 1:], 0.0, found)


def _two(
    ru: FloatArray, rv: FloatArray, axis: IntArray, miss: FloatArray, other: int, away: FloatArray
) -> FloatArray:
    """Give the steps (n, 2) that bring points into both their planes at once."""
    every = np.arange(len(axis))
    gu, gv, hu, hv = ru[every, axis], rv[every, axis], ru[:, other], rv[:, other]
    det = gu * hv - gv * hu
    least = 1e-6 * np.sqrt(inner(ru, ru) * inner(rv, rv))
    in_u = _over(miss * hv - away * gv, det, least)
    return np.stack([in_u, _over(away * gu - miss * hu, det, least)], axis=1)


def _over(top: FloatArray, bottom: FloatArray, least: FloatArray) -> FloatArray:
    """Divide where the divisor is of a size, else give 0."""
    good = np.abs(bottom) > least
    return np.asarray(np.where(good, top / np.where(good, bottom, 1.0), 0.0))


def _sines(ru: FloatArray, rv: FloatArray, axis: IntArray) -> FloatArray:
    """Give the sine of the angle between the surface and the planes; 0 where there is no normal."""
    normal = np.cross(ru, rv)
    length = np.sqrt(inner(normal, normal))
    cosine = _over(np.abs(normal[np.arange(len(axis)), axis]), length, np.full(len(axis), 1e-300))
    sine = np.sqrt(np.maximum(1.0 - cosine * cosine, 0.0))
    return np.asarray(np.where(length > 1e-300, sine, 0.0))
