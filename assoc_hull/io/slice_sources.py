"""From digitised pieces to smooth lines that can be adopted: split at features, smoothed."""

from __future__ import annotations

from itertools import pairwise

import attrs
import numpy as np

from assoc_hull.geometry.crossing import meet_planes
from assoc_hull.geometry.curves import FloatArray, PointKind, SplineBatch
from assoc_hull.geometry.polyline import arc_length
from assoc_hull.geometry.smooth import smooth
from assoc_hull.geometry.straight import Run, find_runs
from assoc_hull.io.slice_features import FeatureRules, PieceFeatures, plane_columns
from assoc_hull.io.slice_types import AXES
from assoc_hull.model.family import BoundaryKind
from assoc_hull.model.source import LineSource

__all__ = ["SmoothReport", "make_source", "snap_ends"]


@attrs.frozen
class SmoothReport:
    """How one piece was smoothed.

    Attributes
    ----------
    line : str
        The line.
    given, points : int
        Points before and after.
    noise : float, m
        Scatter or depth of facets.
    band : float, m
        How far the hull may lie off the smooth line: its residual, what its ends were moved by
        to lie on boundary curves, and the depth of facets or twice the scatter.
    residual : float, m
        Largest distance of a given place from the smooth curve.
    knuckles, tangents : int
        Knuckle and tangent points.
    onsets : tuple of (str, float, float, float)
        Every end of a straight run: kind, length along the piece (m), radius or nan (m) and
        uncertainty (m).
    """

    line: str
    given: int
    points: int
    noise: float
    band: float
    residual: float
    knuckles: int
    tangents: int
    onsets: tuple[tuple[str, float, float, float], ...]


@attrs.define(eq=False)
class _Break:
    """A place where a piece is split; no direction at a corner."""

    at: float
    place: FloatArray
    direction: FloatArray | None


_REACH = 0.1
"""How far (m) an end may lie from the smooth boundary curve it is on."""


def snap_ends(
    part: PieceFeatures, borders: dict[str, list[SplineBatch]], least: float
) -> PieceFeatures:
    """Move the ends of a piece onto the smooth boundary curves they lie on.

    Parameters
    ----------
    part : PieceFeatures
        A piece of a section, waterline or buttock.
    borders : dict of str to list of SplineBatch
        The smooth boundary curves by name.
    least : float, m
        Ends that lie closer stay: the crossing with the boundary takes their place.
    """
    axis, columns = AXES[part.line.group], plane_columns(part.line.group)
    plane = np.eye(3)[axis], np.array([part.line.offset])
    points, keep = part.points.copy(), np.ones(len(part.points), np.bool_)
    most = 0.0
    for end, name in ((0, part.piece.ends[0]), (-1, part.piece.ends[1])):
        met = [meet_planes(border, *plane).xyz for border in borders.get(name, [])]
        places = np.concatenate(met)[:, columns] if met else np.zeros((0, 2))
        away = np.linalg.norm(places - part.points[end], axis=1)
        # Where the plane cuts the hull at a small angle, a move along the line is no matter.
        if not len(away) or not least / part.sine[end] < away.min() < _REACH:
            continue
        points[end] = places[int(away.argmin())]
        most = max(most, float(away.min()))
        # Points that the end has come close to would make the line turn back.
        keep &= np.linalg.norm(part.points - part.points[end], axis=1) > 3.0 * away.min()
        keep[end] = True
    if most == 0.0 or keep.sum() < 3:
        return part
    return attrs.evolve(
        part, points=points[keep], allowed=part.allowed[keep], sine=part.sine[keep], moved=most
    )


def make_source(
    part: PieceFeatures, tolerance: float, rules: FeatureRules | None = None
) -> tuple[LineSource, SmoothReport]:
    """Smooth a piece within its noise, split at its features.

    Parameters
    ----------
    part : PieceFeatures
        The piece.
    tolerance : float, m
        How far the adopted curve may pass the smooth one.
    rules : FeatureRules or None
        Defaults if None.

    Returns
    -------
    LineSource, SmoothReport
    """
    wanted = rules or FeatureRules()
    points, at = part.points, arc_length(part.points)
    breaks = [_Break(corner.at, corner.place, None) for corner in part.corners]
    runs = _runs(part, breaks, wanted)
    breaks += [
        _Break(onset.at, onset.place, run.direction)
        for run in runs
        for onset in (run.before, run.after)
        if onset.kind == "arc" and onset.uncertainty < wanted.onset
    ]
    breaks = _apart(breaks, float(at[-1]))
    straight = [
        (run.before.at if run.before.kind == "arc" else run.begin, run.after.at)
        for run in runs
        if run.before.kind != "gradual" and run.after.kind != "gradual"
    ]
    xy, kind, direction, residual = _join(part, breaks, straight)
    xyz = _in_space(part, xy)
    way = np.zeros_like(xyz)
    way[:, _columns(part)] = direction
    line, sine = part.line, np.interp(arc_length(xy), at, part.sine)
    # Ends and tangent points of all lines lie on boundary curves, so these are held closer.
    near = tolerance / sine if line.group != "boundary" else np.full(len(xy), 0.2 * tolerance)
    source = LineSource.make(
        line.group, line.name, xyz, kind=kind.tolist(), direction=way, tolerance=near, dense=True,
        plane=_plane(part), boundary=BoundaryKind.END if line.group == "boundary" else None,
    )  # fmt: skip
    onsets = tuple(
        (o.kind, o.at, o.radius, o.uncertainty)
        for run in runs for o in (run.before, run.after) if o.kind != "end"
    )  # fmt: skip
    band = residual + part.moved + max(part.depth, 2.0 * part.noise)
    report = SmoothReport(
        line.name, len(points), len(xyz), part.noise, band,
        residual, int((kind == PointKind.KNUCKLE).sum()), int((kind == PointKind.TANGENT).sum()),
        onsets,
    )  # fmt: skip
    return source, report


def _runs(part: PieceFeatures, corners: list[_Break], rules: FeatureRules) -> list[Run]:
    """Find straight runs between the corners of a plane piece."""
    if part.points.shape[1] != 2 or part.piece.closed:
        return []
    at = arc_length(part.points)
    edges = [0.0, *(each.at for each in corners), float(at[-1])]
    found: list[Run] = []
    for low, high in pairwise(edges):
        inside = (at >= low - 1e-9) & (at <= high + 1e-9)
        if inside.sum() < 6:
            continue
        first = float(at[inside][0])
        found += [
            _shifted(run, first) for run in find_runs(part.points[inside], part.noise, rules.run)
        ]
    return found


def _shifted(run: Run, by: float) -> Run:
    """Count lengths from the beginning of the whole piece."""
    before, after = (attrs.evolve(each, at=each.at + by) for each in (run.before, run.after))
    return attrs.evolve(run, begin=run.begin + by, end=run.end + by, before=before, after=after)


def _apart(breaks: list[_Break], length: float) -> list[_Break]:
    """Leave out breaks at the ends and tangent points that lie close to another break."""
    out: list[_Break] = []
    for each in sorted(breaks, key=lambda b: (b.direction is not None, b.at)):
        clear = all(abs(each.at - other.at) > 0.3 for other in out)
        if clear and 0.3 < each.at < length - 0.3:
            out.append(each)
    return sorted(out, key=lambda b: b.at)


def _join(
    part: PieceFeatures, breaks: list[_Break], straight: list[tuple[float, float]]
) -> tuple[FloatArray, np.typing.NDArray[np.int8], FloatArray, float]:
    """Smooth between the breaks; give points, kinds, directions and the largest residual."""
    points, at = part.points, arc_length(part.points)
    ends = [
        _Break(0.0, points[0], None), *breaks, _Break(float(at[-1]), points[-1], None)
    ]  # fmt: skip
    size = points.shape[1]
    places: list[FloatArray] = []
    kinds: list[int] = []
    ways: list[FloatArray] = []
    worst = 0.0
    for i, (low, high) in enumerate(pairwise(ends)):
        inside = (at > low.at + 1e-3) & (at < high.at - 1e-3)
        mine = np.concatenate([low.place[None], points[inside], high.place[None]])
        allowed = np.interp([low.at, *at[inside], high.at], at, part.allowed)
        if any(a - 0.05 <= low.at and high.at <= b + 0.05 for a, b in straight):
            drawn = mine[0] + np.linspace(0.0, 1.0, 5)[:, None] * (mine[-1] - mine[0])
        else:
            fit = smooth(mine, allowed, low.direction, high.direction)
            drawn, worst = fit.points, max(worst, fit.residual)
        drawn = drawn if i == 0 else drawn[1:]
        places.append(drawn)
        kinds += [int(PointKind.SMOOTH)] * len(drawn)
        ways += [np.zeros(size)] * len(drawn)
        if i < len(breaks):
            corner = high.direction is None
            kinds[-1] = int(PointKind.KNUCKLE if corner else PointKind.TANGENT)
            ways[-1] = np.zeros(size) if high.direction is None else high.direction
    return np.concatenate(places), np.array(kinds, np.int8), np.array(ways), worst


def _columns(part: PieceFeatures) -> list[int]:
    """Give the coordinates in which the points of a piece are given."""
    if part.line.group != "boundary":
        return plane_columns(part.line.group)
    if part.points.shape[1] == 3:
        return [0, 1, 2]
    flat = int(np.argmin(np.ptp(part.piece.points, axis=0)))
    return [axis for axis in range(3) if axis != flat]


def _in_space(part: PieceFeatures, xy: FloatArray) -> FloatArray:
    columns = _columns(part)
    out = np.empty((len(xy), 3))
    out[:, columns] = xy
    for axis in set(range(3)) - set(columns):
        out[:, axis] = _level(part, axis)
    return out


def _level(part: PieceFeatures, axis: int) -> float:
    """Give the place of the plane of a piece."""
    if part.line.group != "boundary":
        return part.line.offset
    level = round(float(np.median(part.piece.points[:, axis])), 6)
    return level + 0.0


def _plane(part: PieceFeatures) -> tuple[FloatArray, float] | None:
    if part.line.group != "boundary":
        return np.eye(3)[AXES[part.line.group]], part.line.offset
    if part.points.shape[1] == 3:
        return None
    axis = next(iter(set(range(3)) - set(_columns(part))))
    return np.eye(3)[axis], _level(part, axis)
