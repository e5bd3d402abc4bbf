"""Borders of flats as boundary curves: drawn from the ends of straight runs, and taken by lines.

A border is drawn from the ends of runs that are known well enough and chain over neighbouring
lines. A run of the flat then ends where the border crosses the plane of its line, in a direction
that lies in the flat, unless its points leave the flat before.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.polylines.borders import order_places
from assoc_hull.geometry.polylines.operations import arc_length, foot_on
from assoc_hull.geometry.polylines.straight import Onset
from assoc_hull.io.lines.slices import AXES
from assoc_hull.io.slicing.curves import Border, Course, draw, loft_source, meet
from assoc_hull.io.slicing.features import FeatureRules, KnuckleLine, PieceFeatures, plane_columns
from assoc_hull.io.slicing.flats import FlatFound, Mark, find_flats
from assoc_hull.io.slicing.knuckles import draw_knuckles
from assoc_hull.io.slicing.plan import in_space
from assoc_hull.io.slicing.runs import runs_of
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource

__all__ = ["draw_borders", "draw_flats"]

_NEAR = 0.3
"""How much farther (m) than its doubt the end of a run may lie from a border that takes it."""

_LEAST_DOUBT = 5e-3


def draw_borders(
    parts: list[PieceFeatures],
    knuckles: list[KnuckleLine],
    rules: FeatureRules,
    tolerance: float,
) -> tuple[list[PieceFeatures], list[LineSource], list[Border]]:
    """Draw knuckle lines and the borders of flats; lines have their corners and tangents there.

    Parameters
    ----------
    parts : list of PieceFeatures
        Pieces of sections, waterlines and buttocks.
    knuckles : list of KnuckleLine
        Found on them.
    rules : FeatureRules
        The thresholds.
    tolerance : float, m
        How far the adopted curves may pass the smooth ones.

    Returns
    -------
    pieces with their runs, sources of the boundary curves, borders
    """
    parts = [_measured_again(part) for part in parts]
    parts, sources, borders = draw_knuckles(parts, knuckles, rules, tolerance)
    parts = [attrs.evolve(part, runs=runs_of(part, rules)) for part in parts]
    parts, more, flats = draw_flats(parts, rules, tolerance)
    return parts, sources + more, borders + flats


def _measured_again(part: PieceFeatures) -> PieceFeatures:
    """Find the corners of a piece again along it, where its end was moved."""
    if part.moved == 0.0 or not part.corners:
        return part
    at = arc_length(part.points)
    corners = [
        attrs.evolve(corner, at=foot_on(part.points, at, corner.place)[0])
        for corner in part.corners
    ]
    return attrs.evolve(part, corners=tuple(corners))


def draw_flats(
    parts: list[PieceFeatures], rules: FeatureRules, tolerance: float
) -> tuple[list[PieceFeatures], list[LineSource], list[Border]]:
    """Draw the borders of flats, and let the runs of the flats end on them.

    Parameters
    ----------
    parts : list of PieceFeatures
        Pieces of sections, waterlines and buttocks, with their runs.
    rules : FeatureRules
        The thresholds.
    tolerance : float, m
        How far the adopted border may pass the smooth one.

    Returns
    -------
    pieces, sources of the boundary curves, borders
    """
    out = list(parts)
    sources: list[LineSource] = []
    borders: list[Border] = []
    for flat in find_flats(parts, rules):
        for course in _courses(flat, parts):
            source, border = draw(flat.name, BoundaryKind.FLAT, course, rules, tolerance)
            taken = _take(out, flat, loft_source(source))
            sources.append(source)
            borders.append(attrs.evolve(border, taken=taken))
    return out, sources, borders


def _courses(flat: FlatFound, parts: list[PieceFeatures]) -> Iterator[Course]:
    """Give the chained marks of a flat in order along its rim, split where they do not go on."""
    marks = [mark for mark in flat.marks if mark.chain is not None]
    chains = sorted({mark.chain for mark in marks if mark.chain is not None})
    members = [[i for i, mark in enumerate(marks) if mark.chain == chain] for chain in chains]
    doubt = _across(flat, marks, members, parts)
    places = np.array([mark.place for mark in marks]).reshape(-1, 3)
    plane = flat.normal, flat.offset
    while members:
        first = min(members, key=lambda each: (float(np.median(doubt[each])), each))
        rest = sorted(i for each in members for i in each)
        order = order_places(places[rest], doubt[rest], [rest.index(i) for i in first])
        path = _unbroken([rest[k] for k in order], first, marks, places)
        lines = tuple(parts[marks[i].part].line.name for i in path)
        yield Course(lines, places[path], doubt[path], plane)
        members = [each for each in members if set(path).isdisjoint(each)]


def _across(
    flat: FlatFound, marks: list[Mark], members: list[list[int]], parts: list[PieceFeatures]
) -> FloatArray:
    """Give how far each mark may lie off the border, from its doubt along the run, (n,), m."""
    out = np.array([mark.doubt for mark in marks])
    for mine in members:
        along = np.gradient(np.array([marks[i].place for i in mine]), axis=0)
        along = along / np.sqrt((along * along).sum(axis=1))[:, None]
        way = np.array([_ahead(flat, parts[marks[i].part]) for i in mine])
        cosine = (along * way).sum(axis=1)
        out[mine] *= np.sqrt(np.maximum(1.0 - cosine * cosine, 0.05**2))
    return np.asarray(np.maximum(out, _LEAST_DOUBT))


def _ahead(flat: FlatFound, part: PieceFeatures) -> FloatArray:
    """Give the direction of a line that lies in a flat."""
    way = np.cross(np.eye(3)[AXES[part.line.group]], flat.normal)
    return np.asarray(way / np.sqrt(way @ way))


def _unbroken(
    path: list[int], first: list[int], marks: list[Mark], places: FloatArray
) -> list[int]:
    """Give the part of a path around its first marks in which no gap is wider than usual."""
    numbers = [path.index(i) for i in first]
    gaps = [
        marks[i].chain != marks[j].chain
        and float(np.linalg.norm(places[i] - places[j]))
        > 2.0 * max(marks[i].spacing, marks[j].spacing)
        for i, j in pairwise(path)
    ]
    begin = max([k + 1 for k in range(min(numbers)) if gaps[k]], default=0)
    end = min([k for k in range(max(numbers), len(gaps)) if gaps[k]], default=len(path) - 1)
    return path[begin : end + 1]


def _take(parts: list[PieceFeatures], flat: FlatFound, spline: SplineBatch) -> int:
    """Let the runs of a flat end on its border; give how many do."""
    count = 0
    for mark in flat.marks:
        part = parts[mark.part]
        met = meet(spline, part)
        if not len(met):
            continue
        along = np.abs((met - mark.place) @ _ahead(flat, part))
        place = met[int(np.argmin(along))]
        near = along.min() <= max(1.5 * mark.doubt, _NEAR)
        if near and _is_flat(part, mark, place, flat):
            parts[mark.part] = _held(part, mark, place, flat)
            count += 1
    return count


def _is_flat(part: PieceFeatures, mark: Mark, place: FloatArray, flat: FlatFound) -> bool:
    """Tell whether the points of a run lie on the flat up to a place, as near as is smoothed."""
    at, xyz = arc_length(part.points), in_space(part, part.points)
    run = (part.runs or ())[mark.run]
    middle = 0.5 * (run.begin + run.end)
    foot = float(at[np.argmin(((xyz - place) ** 2).sum(axis=1))])
    inside = (at >= min(foot, middle)) & (at <= max(foot, middle))
    off = np.abs(xyz[inside] @ flat.normal - flat.offset)
    return bool((off > part.allowed[inside]).sum() <= 0.05 * len(off))


def _held(part: PieceFeatures, mark: Mark, place: FloatArray, flat: FlatFound) -> PieceFeatures:
    """Let a run begin or end at a place on a border, in a direction that lies in the flat."""
    columns = plane_columns(part.line.group)
    runs = list(part.runs or ())
    run = runs[mark.run]
    ahead = _ahead(flat, part)[columns]
    ahead = ahead if ahead @ run.direction > 0.0 else -ahead
    old = run.after if mark.side else run.before
    at = old.at + float((place - mark.place)[columns] @ ahead)
    kind = old.kind if old.kind == "arc" else "border"
    new = Onset(kind, at, place[columns], old.radius, old.uncertainty)
    run = attrs.evolve(run, direction=ahead + 0.0)
    runs[mark.run] = attrs.evolve(run, after=new) if mark.side else attrs.evolve(run, before=new)
    return attrs.evolve(part, runs=tuple(runs))
