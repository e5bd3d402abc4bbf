"""From digitised pieces to smooth lines that can be adopted: split at features, smoothed."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, PointKind, SplineBatch
from assoc_hull.geometry.polylines.circular_arcs import Arc
from assoc_hull.geometry.polylines.operations import arc_length
from assoc_hull.geometry.polylines.smooth import Smooth
from assoc_hull.geometry.splines.plane_intersections import meet_planes
from assoc_hull.io.lines.slices import AXES
from assoc_hull.io.slicing.features import PieceFeatures, plane_columns
from assoc_hull.io.slicing.plan import Plan, in_space, piece_columns, piece_plane
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource

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
    arcs : tuple of Arc
        Its circular arcs, in the coordinates that vary on the piece.
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
    arcs: tuple[Arc, ...] = ()


_FADE = 400.0
"""The line follows its end over this many times the move: it turns by a sixth of a degree."""

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
        step = places[int(away.argmin())] - part.points[end]
        far = arc_length(part.points) if end == 0 else arc_length(part.points[::-1])[::-1]
        part_way = np.maximum(1.0 - far / (_FADE * away.min()), 0.0)
        points += (part_way * part_way * (3.0 - 2.0 * part_way))[:, None] * step
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


def make_source(plan: Plan, tolerance: float) -> tuple[LineSource, SmoothReport]:
    """Draw the smooth curves of a piece as a line that can be adopted.

    Parameters
    ----------
    plan : Plan
        The piece, split at its features.
    tolerance : float, m
        How far the adopted curve may pass the smooth one.

    Returns
    -------
    LineSource, SmoothReport
    """
    part = plan.part
    drawn = [stretch.draw() for stretch in plan.stretches]
    xy, kind, direction = _chain(plan, drawn)
    way = np.zeros((len(xy), 3))
    way[:, piece_columns(part)] = direction
    line, sine = part.line, np.interp(arc_length(xy), arc_length(part.points), part.sine)
    # Ends and tangent points of all lines lie on boundary curves, so these are held closer.
    near = tolerance / sine if line.group != "boundary" else np.full(len(xy), 0.2 * tolerance)
    source = LineSource.make(
        line.group, line.name, in_space(part, xy), kind=kind.tolist(), direction=way,
        tolerance=near, dense=True, plane=piece_plane(part),
        boundary=BoundaryKind.END if line.group == "boundary" else None,
    )  # fmt: skip
    onsets = tuple(
        (o.kind, o.at, o.radius, o.uncertainty)
        for run in plan.runs for o in (run.before, run.after) if o.kind != "end"
    )  # fmt: skip
    residual = max(each.residual for each in drawn)
    band = residual + part.moved + max(part.depth, 2.0 * part.noise)
    report = SmoothReport(
        line.name, len(part.points), len(xy), part.noise, band, residual,
        int((kind == PointKind.KNUCKLE).sum()), int((kind == PointKind.TANGENT).sum()), onsets,
        part.arcs,
    )  # fmt: skip
    return source, report


def _chain(
    plan: Plan, drawn: list[Smooth]
) -> tuple[FloatArray, np.typing.NDArray[np.int8], FloatArray]:
    """Put the curves of a piece one behind the other: points, kinds and given directions."""
    places = [each.points if i == 0 else each.points[1:] for i, each in enumerate(drawn)]
    last = np.cumsum([len(each) for each in places])[:-1] - 1
    points = np.concatenate(places)
    kind = np.full(len(points), PointKind.SMOOTH, np.int8)
    direction = np.zeros_like(points)
    for i, each in zip(last.tolist(), plan.breaks, strict=True):
        kind[i] = PointKind.KNUCKLE if each.direction is None else PointKind.TANGENT
        if each.direction is not None:
            direction[i] = each.direction
    return points, kind, direction
