"""How good a fitted surface is: distances of lines, angles at borders, and doubts in sentences.

A distance is that to the foot of a point on the surface as published.
Lines that were left out are measured in the same way, and counted by themselves.
Each doubt is a sentence with its size and, where it has one, its place.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.curve_net import CurveNet
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.fitting.folds import SurfaceElements
from assoc_hull.geometry.fitting.foot_points import foot_points
from assoc_hull.geometry.patches.knots import span_limits
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.splines.segments import evaluate
from assoc_hull.surface.blocks.fit_options import FitOptions

__all__ = [
    "LEFT_OUT",
    "BlockBorder",
    "LineDistances",
    "Residuals",
    "doubts_of_border",
    "doubts_of_fit",
    "doubts_of_half",
    "doubts_of_limits",
    "doubts_of_penalty",
    "doubts_of_shape",
    "line_distances",
    "residual_place",
    "shown_place",
    "sum_residuals",
]


@attrs.frozen(eq=False)
class Residuals:
    """How far points of lines lie from the surface.

    Attributes
    ----------
    kind : str
        ``"fitted"``, or ``"left out"`` of the fit.
    count : int
        Points.
    median, p95, p99, largest : float, m
        Of the distances.
    place : (3,), m
        Where the largest is; nan without points.
    line : str
        The line it is on.
    """

    kind: str
    count: int
    median: float
    p95: float
    p99: float
    largest: float
    place: FloatArray
    line: str

    def __attrs_post_init__(self) -> None:
        freeze(self.place)


@attrs.frozen(eq=False)
class BlockBorder:
    """Where two blocks meet.

    Attributes
    ----------
    names : (str, str)
        The blocks.
    gap : (3,), m
        Median, 95 % and largest distance of the two surfaces, before they were joined.
    joined_gap : float, m
        The largest after it.
    angle : (3,), degrees
        Median, 95 % and largest angle between the normals as published.
    place : (3,), m
        Where the largest angle is.
    limit : float, degrees
        What the angle should keep; 180 along a knuckle line, where it is free.
    """

    names: tuple[str, str]
    gap: FloatArray
    joined_gap: float
    angle: FloatArray
    place: FloatArray
    limit: float

    def __attrs_post_init__(self) -> None:
        freeze(self.gap, self.angle, self.place)


# --------------------------------------------------------------------------------------
# Distances of lines.

_SEEDS = 2
"""Places on each span from which the nearest is taken as a start."""

_STEPS = 8
"""Steps of the search for a foot."""

_CHORD = 0.1
"""Chords for arc lengths, as a part of the distance of points."""


@attrs.frozen(eq=False)
class LineDistances:
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


def sum_residuals(
    kind: str, distance: FloatArray, point: FloatArray, line: IntArray, names: Sequence[str]
) -> Residuals:
    """Sum up distances (k,), m, of points (k, 3), m, on curves (k,).

    `kind` is ``"fitted"`` or ``"left out"``. The first of several that are largest is named by its
    line.
    """
    if not len(distance):
        return Residuals(kind, 0, 0.0, 0.0, 0.0, 0.0, np.full(3, np.nan), "")
    worst = int(distance.argmax())
    median, p95, p99 = np.percentile(distance, [50.0, 95.0, 99.0]).tolist()
    largest, place = float(distance[worst]), np.array(point[worst])
    return Residuals(kind, len(distance), median, p95, p99, largest, place, names[int(line[worst])])


LEFT_OUT = "not in the surface: "
"""With this begins a note on what a hull has beside its lines."""


def residual_place(net: CurveNet, found: Residuals) -> str:
    """Say on which line the largest distance is, and near which crossing, as "on WL 3 near ST 7".

    A line without crossings is named alone; nothing where there are no distances.
    """
    if not found.count:
        return ""
    mine = np.array([name == found.line for name in net.name])
    meeting, side = np.nonzero(mine[net.meets] & ~net.watched[:, None])
    if not len(meeting):
        return f"on {found.line}"
    at = evaluate(net.batch, net.meets[meeting, side], net.place[meeting, side])
    nearest = int(np.linalg.norm(at - found.place, axis=1).argmin())
    other = net.meets[meeting[nearest], 1 - side[nearest]]
    return f"on {found.line} near {net.name[int(other)]}"


def line_distances(
    surfaces: Sequence[SplineSurface], net: CurveNet, chosen: NDArray[np.bool_], step: float
) -> LineDistances:
    """Measure how far the chosen curves of a net lie from bicubic surfaces, every `step`, m.

    The distance of a point is that to its foot on the surface as published, not to the point with
    its parameters: so it does not matter how a line runs along the surface.
    """
    curves = np.flatnonzero(chosen).tolist()
    parts = [_along(net, curve, step) for curve in curves]
    if not parts:
        none = np.zeros(0)
        return LineDistances(np.zeros(0, np.int64), np.zeros((0, 3)), np.zeros(0, np.int64), none)
    point = np.concatenate(parts)
    line = np.repeat(np.array(curves, np.int64), [len(each) for each in parts])
    every = np.stack([_distance(surface, point) for surface in surfaces])
    home = every.argmin(axis=0)
    return LineDistances(home, point, line, every[home, np.arange(len(point))])


def _distance(surface: SplineSurface, point: FloatArray) -> FloatArray:
    """Give how far points lie from a surface, (k,), m."""
    from scipy.spatial import cKDTree

    uv = _grid(surface)
    start = uv[cKDTree(surface.at(*uv.T)).query(point)[1]]
    return foot_points(surface, point, start, steps=_STEPS)[1]


def _along(net: CurveNet, curve: int, step: float) -> FloatArray:
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
        _divided(span_limits(knots, degree))
        for knots, degree in zip((surface.knots_u, surface.knots_v), surface.degrees, strict=True)
    )
    return np.stack(np.meshgrid(u, v, indexing="ij"), axis=-1).reshape(-1, 2)


def _divided(spans: FloatArray) -> FloatArray:
    """Part spans (s, 2) equally."""
    low, high = spans[:, :1], spans[:, 1:]
    inner = low + (high - low) * np.arange(_SEEDS) / _SEEDS
    return np.append(inner.ravel(), spans[-1, 1])


# --------------------------------------------------------------------------------------
# Doubts.

_KNUCKLE = 5.0
"""So many times as large as p95 the p99 is where a bend was smoothed that is a knuckle."""

_LEAST = 0.02
"""Below this part of the median an element of area is in doubt."""

_ROUNDING = 1e-10
"""Borders that agree to this, m, have control points that agree to the last bits."""

_STEM = 4.0
"""A largest residual over so many limits, beside the centre plane, tells of too sharp a stem."""

_BESIDE = 0.002
"""So near to the centre plane, as a part of the length, is beside it."""

_ACROSS = 0.0001
"""By so much, m on a hull of 300 m, a half may wave across the centre plane."""


def shown_place(place: FloatArray) -> str:
    """Write a place, m."""
    return "({:.2f}, {:.2f}, {:.2f})".format(*np.asarray(place).tolist())


def doubts_of_fit(kind: str, found: Residuals, options: FitOptions) -> Iterator[str]:
    """Say where the surface of a block of this kind leaves the lines that it was fitted to."""
    yield from doubts_of_limits(kind, found, options)
    limit, largest = options.limit(kind), _largest(found)
    if found.largest > _STEM * limit and _beside_centre(found, options) and kind != "body":
        yield f"stem not resolved: {largest}"
    elif found.p99 > max(_KNUCKLE * found.p95, limit):
        p99 = 1e3 * found.p99
        yield f"missing knuckle? 99 % of the residuals are up to {p99:.1f} mm; {largest}"


def doubts_of_limits(kind: str, found: Residuals, options: FitOptions) -> Iterator[str]:
    """Say that the residuals of a block of this kind are over their limits."""
    limit, largest = options.limit(kind), _largest(found)
    if found.p95 > limit:
        yield (
            f"95 % of the residuals are up to {1e3 * found.p95:.1f} mm, over the limit of "
            f"{1e3 * limit:.1f} mm; {largest}"
        )
    if found.median > options.median_limit:
        yield (
            f"the median residual is {1e3 * found.median:.2f} mm, over the limit of "
            f"{1e3 * options.median_limit:.2f} mm; {largest}"
        )


def _largest(found: Residuals) -> str:
    where = f"at {shown_place(found.place)} on {found.line}"
    return f"the largest is {1e3 * found.largest:.1f} mm {where}"


def _beside_centre(found: Residuals, options: FitOptions) -> bool:
    return bool(abs(found.place[1]) < _BESIDE * options.length)


def doubts_of_penalty(used: float, usual: float) -> Iterator[str]:
    """Say that a surface was made stiffer than asked for, as it was folded; factors in m3."""
    if used > usual:
        yield f"stiffened: the penalty is {used / usual:g} times as large, as it was folded without"


def doubts_of_shape(
    surface: SplineSurface, shape: SurfaceElements, folded: FloatArray
) -> Iterator[str]:
    """Say where a surface is folded, at places (f, 2), m, of its grid, or almost has no normal."""
    if len(folded):
        where = shown_place(surface.at(*folded[0]))
        yield f"folded: the normal turns over at {len(folded)} place(s) of the grid, as at {where}"
    for corner in shape.singular:
        yield f"singular corner: the sides are tangent at {shown_place(surface.at(*corner))}"
    if shape.least < _LEAST and shape.place not in shape.singular:
        place = surface.at(*shape.place)
        yield f"the element of area is {shape.least:.3f} of the median at {shown_place(place)}"


def doubts_of_half(
    surface: SplineSurface, shape: SurfaceElements, options: FitOptions, most: float | None = None
) -> Iterator[str]:
    """Say where the half y >= 0 waves across the centre plane, so that the two halves intersect.

    By more than `most` (m), or by what may be told of.
    """
    least = -_ACROSS * options.scale if most is None else -most
    if surface.net[..., 1].min() >= least:
        return
    place = surface.at(shape.u[:, None], shape.v[None, :]).reshape(-1, 3)
    worst = place[int(place[:, 1].argmin())]
    if worst[1] < least:
        yield (
            f"waves across the centre plane by {-1e3 * worst[1]:.2f} mm at {shown_place(worst)}: "
            "the two halves intersect there"
        )


def doubts_of_border(border: BlockBorder) -> Iterator[str]:
    """Say where two blocks meet at an angle, or do not meet."""
    name = " | ".join(border.names)
    if border.joined_gap > _ROUNDING:
        yield f"{name}: a gap of {1e3 * border.joined_gap:.2g} mm is left"
    if border.angle[2] > border.limit:
        yield (
            f"{name}: the normals differ by up to {border.angle[2]:.2f} degrees, over the limit "
            f"of {border.limit:g}, at {shown_place(border.place)}"
        )
