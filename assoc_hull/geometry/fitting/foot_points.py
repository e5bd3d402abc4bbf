"""Parameters of the places of a surface that are nearest to points, from near ones.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.fitting.foot_points import foot_points
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> net = np.zeros((4, 4, 3))
>>> net[..., 0], net[..., 1] = np.mgrid[0:4, 0:4]
>>> knots = [0, 0, 0, 0, 3, 3, 3, 3]
>>> plane = SplineSurface("plane", (3, 3), knots, knots, net)
>>> uv, away = foot_points(plane, np.array([[1.0, 2.0, 0.5]]), np.array([[1.05, 1.95]]))
>>> uv.round(9).tolist(), away.tolist()
([[1.0, 2.0]], [0.5])
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fitting.basis import DEGREE, basis_rows
from assoc_hull.geometry.patches.spline_surface import SplineSurface

__all__ = ["derivatives", "distances", "foot_points"]

STEPS = 3
_LONGEST = 1.0 / 40.0
"""The longest step, as a part of the domain: parameters of bad starts do not jump away."""

_FLAT = 1e-12


def derivatives(surface: SplineSurface, uv: FloatArray) -> tuple[FloatArray, ...]:
    """Give points of a bicubic surface and their derivatives: S, S_u, S_v, each (k, 3), m or 1.

    Raises
    ------
    BadInputError
        Weights, or degrees other than 3.
    """
    _require_bicubic(surface)
    first_u, (value_u, slope_u) = basis_rows(surface.knots_u, uv[:, 0], 1)
    first_v, (value_v, slope_v) = basis_rows(surface.knots_v, uv[:, 1], 1)
    flat, width = surface.net.reshape(-1, 3), surface.net.shape[1]
    corner = first_u * width + first_v
    point, along, across = (np.zeros((len(uv), 3)) for _ in range(3))
    for p in range(DEGREE + 1):
        value, slope = np.zeros_like(point), np.zeros_like(point)
        for q in range(DEGREE + 1):
            control = flat[corner + (p * width + q)]
            value += value_v[:, q, None] * control
            slope += slope_v[:, q, None] * control
        point += value_u[:, p, None] * value
        along += slope_u[:, p, None] * value
        across += value_u[:, p, None] * slope
    return point, along, across


def _require_bicubic(surface: SplineSurface) -> None:
    """Refuse other surfaces."""
    if surface.degrees != (DEGREE, DEGREE) or surface.rational:
        kind = "rational" if surface.rational else f"of degrees {surface.degrees}"
        raise BadInputError(f"the surface is {kind}", surface.where, "give a bicubic B-spline")


def foot_points(
    surface: SplineSurface,
    points: FloatArray,
    uv: FloatArray,
    *,
    held: NDArray[np.bool_] | None = None,
    steps: int = STEPS,
) -> tuple[FloatArray, FloatArray]:
    """Move parameters to where the surface is nearest to points.

    Parameters
    ----------
    surface : SplineSurface
        A bicubic B-spline.
    points : (k, 3), m
        The points.
    uv : (k, 2), m
        Parameters to start from, in the domain.
    held : (k, 2) bool, optional
        Parameters that stay.
    steps : int
        Steps of the method of Gauss and Newton; each at most 1/40 of the domain long, and taken
        back where it leads away.

    Returns
    -------
    uv : (k, 2), m
        The best parameters on the way, in the domain.
    distance : (k,), m
        How far the points lie from there.
    """
    domain = np.array(surface.domain).T
    fixed = np.zeros(uv.shape, np.bool_) if held is None else held
    at = np.clip(uv, domain[0], domain[1])
    best, least = at, np.full(len(at), np.inf)
    for step in range(steps + 1):
        point, along, across = derivatives(surface, at)
        miss = points - point
        away = np.einsum("ij,ij->i", miss, miss)
        nearer = away < least
        best, least = np.where(nearer[:, None], at, best), np.where(nearer, away, least)
        if step == steps:
            break
        move = _step(miss, along, across, fixed, at, domain)
        at = np.where(nearer[:, None], at + move, 0.5 * (at + best))
        at = np.clip(at, domain[0], domain[1])
    return best, np.sqrt(least)


def _step(
    miss: FloatArray,
    along: FloatArray,
    across: FloatArray,
    fixed: NDArray[np.bool_],
    at: FloatArray,
    domain: FloatArray,
) -> FloatArray:
    """Give one step; a parameter that would leave the domain, or is held, takes none."""
    uu, uv, vv = (
        np.einsum("ij,ij->i", a, b) for a, b in ((along, along), (along, across), (across, across))
    )
    pull = np.stack([(along * miss).sum(axis=1), (across * miss).sum(axis=1)], axis=1)
    stop = fixed | ((at <= domain[0]) & (pull < 0.0)) | ((at >= domain[1]) & (pull > 0.0))
    pull = np.where(stop, 0.0, pull)
    uv = np.where(stop.any(axis=1), 0.0, uv)
    uu, vv = np.where(stop[:, 0], 1.0, uu), np.where(stop[:, 1], 1.0, vv)
    room = _FLAT * (uu + vv) + np.finfo(float).tiny
    uu, vv = uu + room, vv + room
    area = uu * vv - uv * uv
    move = np.stack([vv * pull[:, 0] - uv * pull[:, 1], uu * pull[:, 1] - uv * pull[:, 0]], axis=1)
    longest = _LONGEST * (domain[1] - domain[0])
    return np.asarray(np.clip(move / area[:, None], -longest, longest))


def distances(surface: SplineSurface, points: FloatArray, uv: FloatArray) -> FloatArray:
    """Give how far points (k, 3) lie from the surface, found from near parameters, (k,), m."""
    return foot_points(surface, points, uv, steps=2 * STEPS)[1]
