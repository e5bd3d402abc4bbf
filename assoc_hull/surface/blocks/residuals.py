"""How far lines lie from a surface: those it was fitted to, and those that were left out.

The distance of a point is that to its foot on the surface as published, not to the point with its
parameters: so it does not matter how a line runs along the surface.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.gather import Net
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.fitting.foot_points import foot_points
from assoc_hull.geometry.patches.knots import limits
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.splines.evaluation import evaluate
from assoc_hull.surface.blocks.net_records import Residuals

__all__ = ["Misses", "misses_of", "residuals_of"]

_SEEDS = 2
"""Places on each span from which the nearest is taken as a start."""

_STEPS = 8
_CHORD = 0.1
"""Chords for arc lengths, as a part of the distance of points."""


@attrs.frozen(eq=False)
class Misses:
    """Points of lines beside surfaces.

    Attributes
    ----------
    surface : (k,) int
        The nearest surface.
    point : (k, 3), m
        The points.
    line : (k,) int
        The curves of the net that they are on.
    distance : (k,), m
        From the surface.
    """

    surface: IntArray
    point: FloatArray
    line: IntArray
    distance: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.surface, self.point, self.line, self.distance)


def residuals_of(
    kind: str, distance: FloatArray, point: FloatArray, line: IntArray, names: Sequence[str]
) -> Residuals:
    """Sum distances up; the first of several that are largest is named.

    Parameters
    ----------
    kind : str
        ``"fitted"`` or ``"left out"``.
    distance : (k,), m
        The distances.
    point : (k, 3), m
        The points.
    line : (k,) int
        Their curves.
    names : sequence of str
        The names of the curves' lines.
    """
    if not len(distance):
        return Residuals(kind, 0, 0.0, 0.0, 0.0, 0.0, np.full(3, np.nan), "")
    worst = int(distance.argmax())
    median, p95, p99 = np.percentile(distance, [50.0, 95.0, 99.0]).tolist()
    largest, place = float(distance[worst]), np.array(point[worst])
    return Residuals(kind, len(distance), median, p95, p99, largest, place, names[int(line[worst])])


def misses_of(
    surfaces: Sequence[SplineSurface], net: Net, chosen: NDArray[np.bool_], step: float
) -> Misses:
    """Measure how far curves of a net lie from surfaces.

    Parameters
    ----------
    surfaces : sequence of SplineSurface
        Bicubic surfaces.
    net : Net
        The curves.
    chosen : (m,) bool
        Which of them.
    step : float, m
        The distance of neighbouring points.
    """
    curves = np.flatnonzero(chosen).tolist()
    parts = [_along(net, curve, step) for curve in curves]
    if not parts:
        none = np.zeros(0)
        return Misses(np.zeros(0, np.int64), np.zeros((0, 3)), np.zeros(0, np.int64), none)
    point = np.concatenate(parts)
    line = np.repeat(np.array(curves, np.int64), [len(each) for each in parts])
    every = np.stack([_distance(surface, point) for surface in surfaces])
    home = every.argmin(axis=0)
    return Misses(home, point, line, every[home, np.arange(len(point))])


def _distance(surface: SplineSurface, point: FloatArray) -> FloatArray:
    """Give how far points lie from a surface, (k,), m."""
    from scipy.spatial import cKDTree

    uv = _grid(surface)
    start = uv[cKDTree(surface.at(*uv.T)).query(point)[1]]
    return foot_points(surface, point, start, steps=_STEPS)[1]


def _along(net: Net, curve: int, step: float) -> FloatArray:
    """Give points of a curve at equal arcs, (k, 3)."""
    length = net.length(curve)
    count = max(int(np.ceil(length / (_CHORD * step))), 16)
    t = np.linspace(0.0, length, count + 1)
    found = evaluate(net.batch, np.full(len(t), curve), t)
    arc = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(found, axis=0), axis=1))])
    parts = max(int(np.ceil(arc[-1] / step)), 2)
    places = np.interp(np.linspace(0.0, arc[-1], parts + 1), arc, t)
    return evaluate(net.batch, np.full(parts + 1, curve), places)


def _grid(surface: SplineSurface) -> FloatArray:
    """Give parameters at equal parts of the spans, borders included, (k, 2)."""
    u, v = (
        _divided(limits(knots, degree))
        for knots, degree in zip((surface.knots_u, surface.knots_v), surface.degrees, strict=True)
    )
    return np.stack(np.meshgrid(u, v, indexing="ij"), axis=-1).reshape(-1, 2)


def _divided(spans: FloatArray) -> FloatArray:
    """Part spans (s, 2) equally."""
    low, high = spans[:, :1], spans[:, 1:]
    inner = low + (high - low) * np.arange(_SEEDS) / _SEEDS
    return np.append(inner.ravel(), spans[-1, 1])
