"""Circular arcs of polylines, and the circle on which points of a curve lie.

Every smooth curve is a circle within a tolerance for a short stretch. A stretch counts as an arc
only if what is left over shows no trend, if it hardly grows when the tolerance is quadrupled (one
of a curve whose curvature changes all along grows by two fifths or more), and if the curvature
steps at one of its ends at least, or it is the whole line.

The circle on which the points of a plane curve lie.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.polylines.circular_arcs import find_arcs
>>> angle = np.linspace(0.0, 0.5 * np.pi, 60)
>>> bilge = np.column_stack([10.0 + 2.4 * np.sin(angle), 2.4 - 2.4 * np.cos(angle)])
>>> bottom = np.column_stack([np.arange(6.0, 10.0, 0.1), np.zeros(40)])
>>> side = np.column_stack([np.full(40, 12.4), np.arange(2.5, 6.5, 0.1)])
>>> [arc] = find_arcs(np.concatenate([bottom, bilge, side]), 1e-4)
>>> round(arc.radius, 3), arc.centre.round(2).tolist(), round(arc.turn_deg)
(2.4, [10.0, 2.4], 90)
>>> from assoc_hull.geometry.polylines.circular_arcs import fit_circle_in_plane
>>> t = np.linspace(-1.5, 1.5, 9)
>>> points = np.column_stack([np.full(9, 6.0), 0.725 * np.cos(t), 5.0 + 0.725 * np.sin(t)])
>>> found = fit_circle_in_plane(points, np.array([1.0, 0.0, 0.0]), closed=True)
>>> found.centre.tolist(), found.radius
([6.0, 0.0, 5.0], 0.725)
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.numeric.circle_fit import (
    CircleFit,
    fit_circle,
    quick_circle_residuals,
    three_point_residuals,
    unroll_on_circle,
)
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.geometry.plane import plane_axes
from assoc_hull.geometry.polylines.operations import cumulative_lengths
from assoc_hull.geometry.polylines.straight_runs import Onset, fit_onset
from assoc_hull.tolerance import round_at_size

__all__ = [
    "ArcRule",
    "CircularArc",
    "EndCircle",
    "FeatureCircle",
    "circle_on_ends",
    "find_arcs",
    "fit_circle_in_plane",
]

_DIGITS = 6
"""Centre and radius are told to this digit of a metre: points that make a feature lie on it within
as much, and another machine's last bit must not show."""


@attrs.frozen(eq=False)
class FeatureCircle:
    """A circle through points, as nearly as they allow.

    Attributes
    ----------
    centre : (3,), m
    radius : float, m
        Both rounded to 1e-6 m, of a short hull finer.
    off : float, m
        How far the farthest point lies off the circle, before it is rounded.
    turn : float, rad
        The angle over which the points stretch, seen from the centre.
    """

    centre: FloatArray
    radius: float
    off: float
    turn: float

    def __attrs_post_init__(self) -> None:
        freeze(self.centre)


def fit_circle_in_plane(
    xyz: FloatArray, normal: FloatArray, *, closed: bool = False, factor: float = 1.0
) -> FeatureCircle:
    """Fit a circle to points in a plane.

    Parameters
    ----------
    xyz : (n, 3), m
        The points in order, three or more that are not on one line.
    normal : (3,)
        Unit normal of their plane.
    closed : bool
        Whether the mirror image closes it: then the centre lies in the centre plane.
    factor : float
        Of lengths, of the hull; see `assoc_hull.tolerance.length_factor`.
    """
    axes = plane_axes(normal)
    flat = np.column_stack([dot(xyz, axis) for axis in axes])
    found = fit_circle(flat)
    away = flat - found.centre
    off = np.abs(np.sqrt((away * away).sum(axis=1)) - found.radius)
    turn = np.ptp(np.unwrap(np.arctan2(away[:, 1], away[:, 0])))
    height = float((normal * xyz[0]).sum())
    centre = height * normal + found.centre[0] * axes[0] + found.centre[1] * axes[1]
    centre = factor * np.round(centre / factor, _DIGITS) + 0.0
    if closed:
        centre[1] = 0.0
    radius = round_at_size(found.radius, _DIGITS, factor)
    return FeatureCircle(centre, radius, float(off.max()), float(turn))


@attrs.frozen(eq=False)
class EndCircle:
    """A circle through two given ends.

    Attributes
    ----------
    centre : (3,), m
    radius : float, m
    turned : float, rad
        How far its tangents at the ends are turned from those of before, by as much at both.
    """

    centre: FloatArray
    radius: float
    turned: float

    def __attrs_post_init__(self) -> None:
        freeze(self.centre)


def circle_on_ends(
    centre: FloatArray, normal: FloatArray, ends: FloatArray, before: FloatArray, *, side: int
) -> EndCircle | None:
    """Give the circle that an arc lies on when its ends have moved in its plane.

    Its tangents at both ends are those of before, or where no circle has both, turned from them
    by one angle at both ends, as little as can be.

    Parameters
    ----------
    centre, normal : (3,), m, and (3,)
        Of the circle before.
    ends, before : (2, 3), m
        The ends of the arc now and before, in the plane of the circle.
    side : int
        1 where the centre lies left of the arc, seen against the normal, -1 to the right.

    Returns
    -------
    EndCircle or None
        None where the ends have fallen together, or the arc would turn to the other side.
    """
    chord = ends[1] - ends[0]
    length = float(np.sqrt((chord * chord).sum()))
    if length == 0.0:
        return None
    way = chord / length
    inward = side * np.cross(normal, way)
    angles = list[float]()
    for place, sign in zip(before, (1.0, -1.0), strict=True):
        tangent = side * np.cross(centre - place, normal)
        ahead, across = (tangent * way).sum(), (tangent * inward).sum()
        angles.append(float(np.arctan2(-sign * across, ahead)))
    half = 0.5 * (angles[0] + angles[1])
    if not 0.0 < half < np.pi:
        return None
    radius = 0.5 * length / float(np.sin(half))
    middle = 0.5 * (ends[0] + ends[1]) + radius * float(np.cos(half)) * inward
    return EndCircle(middle, radius, abs(0.5 * (angles[0] - angles[1])))


@attrs.frozen
class ArcRule:
    """What counts as an arc.

    Attributes
    ----------
    within : float, m
        Points of an arc lie this close to its circle, or within `scatters` times the noise.
    scatters : float
        See `within`.
    least_deg : float
        Least angle over which it turns.
    least_depth : float
        Least depth of the arc over its chord, as a multiple of the tolerance.
    growth : float
        An arc may grow by less than this part of its length when the tolerance is quadrupled.
    step : float
        By which part of its own the curvature must step at one end at least, unless the arc is
        the whole polyline.
    trend : float
        Largest part of what is left over that follows a cubic or a quartic, in standard
        deviations.
    uncertainty : float
        Largest standard deviation of the radius as a part of it.
    """

    within: float = 1e-3
    scatters: float = 3.0
    least_deg: float = 25.0
    least_depth: float = 8.0
    growth: float = 0.2
    step: float = 0.3
    trend: float = 4.5
    uncertainty: float = 0.01


@attrs.frozen(eq=False)
class CircularArc:
    """A circular arc.

    Attributes
    ----------
    begin, end : float, m
        Lengths along the polyline.
    centre : (2,), m
        Of its circle.
    radius : float, m
        Of its circle.
    uncertainty : float, m
        Standard deviation of the radius.
    turn_deg : float
        Angle over which it turns.
    residual : float, m
        Root of the mean squared distance of its points from the circle.
    growth : float
        By which part it grows when the tolerance is quadrupled.
    before, after : Onset
        How it begins and ends: in a curve of another curvature ("arc": the radius is that of the
        step of curvature), gradually, or with the polyline.
    """

    begin: float
    end: float
    centre: FloatArray
    radius: float
    uncertainty: float
    turn_deg: float
    residual: float
    growth: float
    before: Onset
    after: Onset

    def __attrs_post_init__(self) -> None:
        freeze(self.centre)


def find_arcs(points: FloatArray, noise: float, rule: ArcRule | None = None) -> list[CircularArc]:
    """Find the circular arcs of a polyline.

    Parameters
    ----------
    points : (n, 2), m
        In order, corners not among the inner points.
    noise : float, m
        Scatter of the points.
    rule : ArcRule or None
        Defaults if None.

    Returns
    -------
    list of CircularArc
        In order along the polyline.
    """
    wanted = rule or ArcRule()
    if len(points) < 8:
        return []
    at = cumulative_lengths(points)
    within = max(wanted.within, wanted.scatters * noise)
    found: list[CircularArc] = []
    tried: list[tuple[int, int]] = []
    for first, last in _seeds(points, at, within, wanted):
        middle = float(at[(first + last) // 2])
        # Such a seed would settle to a stretch that was looked at already.
        if any(low <= first and last <= high for low, high in tried) or any(
            arc.begin < middle < arc.end for arc in found
        ):
            continue
        stretch = _settle(points, first, last, within)
        if stretch is None:
            continue
        tried.append(stretch)
        arc = _arc(points, at, stretch, within, noise, wanted)
        # Arcs may follow one another end to end; that they overlap by rounding is no matter.
        if arc is not None and all(
            arc.begin > each.end - 1e-9 or arc.end < each.begin + 1e-9 for each in found
        ):
            found.append(arc)
    return sorted(found, key=lambda arc: arc.begin)


def _seeds(
    points: FloatArray, at: FloatArray, within: float, rule: ArcRule
) -> list[tuple[int, int]]:
    """Give (first, last) of windows that look like arcs, the longest first."""
    found: list[tuple[float, float, int, int]] = []
    whole = float(at[-1])
    window = max(whole / 256.0, 6.0 * whole / len(at))
    while window <= whole:
        starts = np.arange(0.0, whole - window + 1e-9, 0.25 * window)
        first = np.searchsorted(at, starts - 1e-9)
        last = np.minimum(np.searchsorted(at, starts + window, "right") - 1, len(at) - 1)
        good = last - first >= 6
        first, last = first[good], last[good]
        off, depth = three_point_residuals(points, first, last)
        # Of an arc that turns enough some window shows two fifths of the turn.
        turn = 8.0 * np.abs(depth) / np.maximum(at[last] - at[first], 1e-12)
        keep = (np.abs(depth) > 0.4 * rule.least_depth * within) & (off < 2.0 * within)
        keep &= turn > 0.4 * np.deg2rad(rule.least_deg)
        found += [
            (-window, float(o), int(i), int(j))
            for o, i, j in zip(off[keep], first[keep], last[keep], strict=True)
        ]
        window *= 1.5
    return [(i, j) for _, _, i, j in sorted(found)]


def _settle(points: FloatArray, first: int, last: int, within: float) -> tuple[int, int] | None:
    """Give the stretch around a seed that lies within a tolerance of its own circle."""
    for _ in range(12):
        new = _grow(quick_circle_residuals(points, first, last), first, last, within)
        if new[1] - new[0] < 6:
            return None
        if new == (first, last):
            return new
        # By a part only: a circle of a short stretch leads far astray.
        most = max(2, (last - first) // 3)
        first, last = max(new[0], first - most), min(new[1], last + most)
    return first, last


def _grow(off: FloatArray, first: int, last: int, within: float) -> tuple[int, int]:
    """Give the ends of the stretch around the middle of a seed that lies within a tolerance."""
    out = np.append(np.append(True, np.abs(off) > within), True)
    # A single wild point does not end an arc.
    far = np.flatnonzero(out[1:-1] & (out[:-2] | out[2:]))
    middle = (first + last) // 2
    before, after = far[far < middle], far[far > middle]
    return (int(before[-1]) + 1 if len(before) else 0,
            int(after[0]) - 1 if len(after) else len(off) - 1)  # fmt: skip


def _arc(
    points: FloatArray,
    at: FloatArray,
    stretch: tuple[int, int],
    within: float,
    noise: float,
    rule: ArcRule,
) -> CircularArc | None:
    """Give the arc of a stretch, None if it is none."""
    growth = _growth(points, at, stretch, within)
    core = _core(at, stretch)
    if growth >= rule.growth or core.sum() < 6:
        return None
    circle = fit_circle(points[core])
    radius, length = circle.radius, float(at[stretch[1]] - at[stretch[0]])
    if length < 0.8 * np.deg2rad(rule.least_deg) * radius:
        return None
    along, off = unroll_on_circle(points, circle)[:2]
    residual = float(np.sqrt((off[core] ** 2).mean()))
    scale = max(noise, residual, 1e-7)
    doubt = circle.spread * scale
    if _trend(along[core], off[core], noise) > rule.trend or doubt > rule.uncertainty * radius:
        return None
    before, after = _ends(points, at, circle, stretch, within, scale)
    begin, end = max(before.at, 0.0), min(after.at, float(at[-1]))
    turn = float(np.rad2deg((end - begin) / radius))
    found = CircularArc(
        begin, end, circle.centre.copy(), radius, doubt, turn, residual, growth, before, after
    )
    return found if _counts(found, within, rule) else None


def _growth(points: FloatArray, at: FloatArray, stretch: tuple[int, int], within: float) -> float:
    """Give by which part a stretch grows when the tolerance is quadrupled."""
    wide = _settle(points, *stretch, 4.0 * within)
    if wide is None:
        return float(np.inf)
    length = at[stretch[1]] - at[stretch[0]]
    return float((at[wide[1]] - at[wide[0]]) / length - 1.0)


def _core(at: FloatArray, stretch: tuple[int, int]) -> np.typing.NDArray[np.bool_]:
    """Give the points of a stretch without its ends, where the line may have left it already."""
    low, high = float(at[stretch[0]]), float(at[stretch[1]])
    margin = 0.08 * (high - low)
    low += margin * (stretch[0] > 0)
    high -= margin * (stretch[1] < len(at) - 1)
    return np.asarray((at >= low) & (at <= high))


def _ends(
    points: FloatArray,
    at: FloatArray,
    circle: CircleFit,
    stretch: tuple[int, int],
    within: float,
    noise: float,
) -> tuple[Onset, Onset]:
    """Say how an arc begins and ends."""
    along, off, angle, sense = unroll_on_circle(points, circle)
    first, radius = len(at) - 1 - stretch[0], circle.radius
    after = _onset(along, off, at, stretch[1], within, noise, radius)
    before = _onset(-along[::-1], off[::-1], -at[::-1], first, within, noise, radius)
    found = []
    for onset in (attrs.evolve(before, at=-before.at), after):
        there = angle + sense * float(np.interp(onset.at, at, along)) / radius
        place = circle.centre + radius * np.array([np.cos(there), np.sin(there)])
        found.append(onset if onset.kind == "gradual" else attrs.evolve(onset, place=place))
    return found[0], found[1]


def _counts(arc: CircularArc, within: float, rule: ArcRule) -> bool:
    """Say whether an arc turns enough, is deep enough, and ends in a step of curvature."""
    depth = arc.radius * (1.0 - np.cos(min(np.deg2rad(arc.turn_deg), np.pi) / 2.0))
    whole = arc.before.kind == "end" and arc.after.kind == "end"
    step = np.fmin(arc.before.radius, arc.after.radius) <= arc.radius / rule.step
    return bool(
        arc.turn_deg >= rule.least_deg and depth >= rule.least_depth * within and (whole or step)
    )


def _trend(along: FloatArray, off: FloatArray, noise: float) -> float:
    """Give how plainly distances off a circle follow a cubic or quartic, in deviations."""
    t = 2.0 * (along - along[0]) / max(float(along[-1] - along[0]), 1e-12) - 1.0
    table = np.polynomial.legendre.legvander(t, 4)
    found = np.linalg.lstsq(table, off, rcond=None)[0]
    left = off - table @ found
    spread = float(np.sqrt((left * left).sum() / max(len(off) - 5, 1)))
    inverse = np.linalg.pinv(table.T @ table)
    # Rounding leaves less than nothing where the points hardly tell the terms apart.
    doubt = np.sqrt(np.maximum(np.diag(inverse), 1e-300)) * max(spread, noise, 1e-7)
    return float(np.abs(found[3:] / doubt[3:]).max())


def _onset(
    along: FloatArray,
    off: FloatArray,
    at: FloatArray,
    last: int,
    within: float,
    noise: float,
    radius: float,
) -> Onset:
    """Say where a line leaves a circle after point `last`, whose polyline goes on forward.

    Its place is not filled in.
    """
    nowhere, beyond = np.full(2, np.nan), len(at) - 1 - last
    if beyond < 4:
        return Onset("end", float(at[-1 if beyond < 2 else last]), nowhere, np.nan, 0.0)
    sign = 1.0 if off[last + 1] > 0.0 else -1.0
    # Farther away the distance from a circle no longer grows as the square of the way.
    stop = max(last + 6, int(np.searchsorted(at, at[last] + 0.5 * radius)))
    way = np.append(along[: last + 1], along[last] + at[last + 1 : stop] - at[last])
    fitted = fit_onset(way, sign * off[:stop], last, within, noise, 6.0)
    zero = float(at[last] + fitted.zero - along[last])
    if fitted.radius is None:
        return Onset("gradual", zero, nowhere, np.nan, fitted.uncertainty)
    return Onset("arc", zero, nowhere, fitted.radius, fitted.uncertainty)
