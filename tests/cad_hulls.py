"""A small ship of two spline surfaces, and what may have happened to it on its way through CAD."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface

LENGTH, DEPTH, HALF = 100.0, 9.0, 8.0
"""Length and depth, and the half-breadth of the control points, m."""

_DECK = np.array([6.0, HALF, HALF, 0.0])
_FLAT = np.array([2.0, 6.0, 6.0, 0.0])
_RISE = np.array([3.0, 0.0, 0.0, 0.0])
"""A transom aft, a raked stem, a flat bottom that rises aft: ordinates of cubics along the ship."""


def bottom() -> SplineSurface:
    """The bottom, to the centre plane, cubic by linear."""
    return SplineSurface.bezier(_net([(94.0, _FLAT, _RISE), (94.0, 0.0 * _FLAT, _RISE)]), "bottom")


def side() -> SplineSurface:
    """Side and bilge, which meets the bottom smoothly, cubic by quadratic."""
    top = np.full(4, DEPTH)
    rows = [(LENGTH, _DECK, top), (97.0, _DECK, _RISE), (94.0, _FLAT, _RISE)]
    return SplineSurface.bezier(_net(rows), "side")


def _net(rows: Sequence[tuple[float, FloatArray, FloatArray]]) -> FloatArray:
    """Rows of control points, each with its foremost x, half-breadths and heights."""
    return np.stack([np.column_stack([np.linspace(0, x, 4), y, z]) for x, y, z in rows], axis=1)


def port() -> list[SplineSurface]:
    """Half the hull, y >= 0."""
    return [bottom(), side()]


def moved(
    surfaces: Sequence[SplineSurface], change: Callable[[FloatArray], FloatArray]
) -> list[SplineSurface]:
    """Surfaces with their control points changed by an affine map."""
    return [attrs.evolve(each, net=change(each.net)) for each in surfaces]


def starboard() -> list[SplineSurface]:
    """The other half, as its own surfaces."""
    image = moved(port(), lambda net: net * [1.0, -1.0, 1.0])
    return [attrs.evolve(each, name=f"{each.name} to starboard") for each in image]


def off_side(xyz: FloatArray) -> FloatArray:
    """How far places lie off the surfaces, by the nearest of many points of these, m."""
    from scipy.spatial import cKDTree

    u, v = np.meshgrid(np.linspace(0, 1, 801), np.linspace(0, 1, 401), indexing="ij")
    places = np.concatenate([each.at(u, v).reshape(-1, 3) for each in port()])
    return np.asarray(cKDTree(places).query(xyz)[0])
