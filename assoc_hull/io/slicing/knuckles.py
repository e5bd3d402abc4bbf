"""Knuckle lines as boundary curves, on which the lines that cross them are split."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.polylines.borders import order_places
from assoc_hull.geometry.polylines.corners import Corner
from assoc_hull.geometry.polylines.flats import fit_plane
from assoc_hull.geometry.polylines.operations import arc_length, foot_on, resample
from assoc_hull.geometry.splines.closest import closest
from assoc_hull.geometry.splines.evaluation import derivative
from assoc_hull.io.lines.slices import AXES
from assoc_hull.io.slicing.curves import Border, Course, draw, loft_source, meet
from assoc_hull.io.slicing.features import FeatureRules, KnuckleLine, PieceFeatures, plane_columns
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource

__all__ = ["draw_knuckles"]

_SAME = 0.1
"""Two knuckle lines are one where a place of one lies this near (m) to the other."""

_APART = 0.3
"""Length (m) of a line around a knuckle line in which its corner is looked for; nearer to an end
of a line there is none."""

_LEAST_DOUBT = 5e-3


def draw_knuckles(
    parts: list[PieceFeatures], knuckles: list[KnuckleLine], rules: FeatureRules, tolerance: float
) -> tuple[list[PieceFeatures], list[LineSource], list[Border]]:
    """Draw knuckle lines, and let every line that crosses one have its corner there.

    Parameters
    ----------
    parts : list of PieceFeatures
        Pieces of sections, waterlines and buttocks.
    knuckles : list of KnuckleLine
        Found on lines of single groups.
    rules : FeatureRules
        The thresholds.
    tolerance : float, m
        How far the adopted curve may pass the smooth one.

    Returns
    -------
    pieces, sources of the boundary curves, borders
    """
    out = list(parts)
    sources: list[LineSource] = []
    borders: list[Border] = []
    known = [line for each in knuckles for line in _known(each, rules)]
    for number, course in enumerate(_courses(known, tolerance), 1):
        name = f"knuckle {number}"
        source, border = draw(name, BoundaryKind.KNUCKLE, course, rules, tolerance)
        spline, taken = loft_source(source), 0
        least = float(course.doubt.max()) / (2.0 * rules.onset)
        for i, part in enumerate(out):
            for place in meet(spline, part):
                # Where a line runs along it nobody can tell where it crosses.
                if _sine(spline, place, part) < least:
                    continue
                split = _split(part, place, tolerance)
                if split is not None:
                    part = out[i] = split
                    taken += 1
        sources.append(source)
        borders.append(attrs.evolve(border, taken=taken))
    return out, sources, borders


def _known(line: KnuckleLine, rules: FeatureRules) -> list[KnuckleLine]:
    """Give the parts of a knuckle line whose places are known as well as is asked for.

    On a coarse mesh a corner may lie a metre off, which would move the lines by decimetres.
    """
    good = np.append(line.doubt < 2.0 * rules.onset, False)
    edges = np.flatnonzero(np.diff(np.append(False, good).astype(np.int8)))
    return [
        KnuckleLine(line.group, line.lines[a:b], line.places[a:b].copy(),
                    line.turn_deg[a:b].copy(), line.doubt[a:b].copy())
        for a, b in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True)
        if b - a >= rules.chain.lines
    ]  # fmt: skip


def _courses(knuckles: list[KnuckleLine], tolerance: float) -> list[Course]:
    """Put together what groups show of one knuckle line."""
    groups: list[list[KnuckleLine]] = []
    for line in sorted(knuckles, key=lambda each: -len(each.lines)):
        same = [mine for mine in groups if any(_meets(line, other) for other in mine)]
        if same:
            same[0].append(line)
        else:
            groups.append([line])
    return [_course(mine, tolerance) for mine in groups]


def _meets(line: KnuckleLine, other: KnuckleLine) -> bool:
    """Tell whether a place of one knuckle line lies between two of another, on the way."""
    start, step = other.places[:-1], np.diff(other.places, axis=0)
    away = line.places[:, None, :] - start
    part = (away * step).sum(axis=2) / (step * step).sum(axis=1)
    foot = start + np.clip(part, 0.0, 1.0)[:, :, None] * step
    gap = np.sqrt(((line.places[:, None, :] - foot) ** 2).sum(axis=2))
    near = np.maximum(_SAME, line.doubt)[:, None] + 0.02 * np.sqrt((step * step).sum(axis=1))
    return bool((gap <= near).any())


def _course(mine: list[KnuckleLine], tolerance: float) -> Course:
    names = [name for line in mine for name in line.lines]
    places = np.concatenate([line.places for line in mine])
    doubt = np.maximum(np.concatenate([line.doubt for line in mine]), _LEAST_DOUBT)
    path = order_places(places, doubt, range(len(mine[0].lines)))
    normal, offset, off = fit_plane(places[path], 0.1 * tolerance)
    flat = 1.0 in normal.tolist() and off <= 0.1 * tolerance
    plane = (normal, round(offset, 4) + 0.0) if flat else None
    return Course(tuple(names[i] for i in path), places[path], doubt[path], plane)


def _split(part: PieceFeatures, place: FloatArray, tolerance: float) -> PieceFeatures | None:
    """Give a piece with its corner at a place of a knuckle line, None where it has none."""
    if part.piece.closed or part.points.shape[1] != 2:
        return None
    here = place[plane_columns(part.line.group)]
    at = arc_length(part.points)
    foot, away = foot_on(part.points, at, here)
    sine = float(np.interp(foot, at, part.sine))
    if not _APART < foot < at[-1] - _APART:
        return None
    near = [corner for corner in (*part.corners, *part.suggested) if abs(corner.at - foot) < _APART]
    if not near and away > max(tolerance, 3.0 * part.noise) / sine:
        return None
    old = min(near, key=lambda each: abs(each.at - foot)) if near else None
    new = _turning(part, foot, here) if old is None else attrs.evolve(old, at=foot, place=here)
    kept = [corner for corner in part.corners if corner is not old]
    rest = tuple(corner for corner in part.suggested if corner is not old)
    corners = tuple(sorted([*kept, new], key=lambda corner: corner.at))
    return attrs.evolve(part, corners=corners, suggested=rest)


def _sine(spline: SplineBatch, place: FloatArray, part: PieceFeatures) -> float:
    """Give the sine of the angle between a knuckle line and the plane of a piece."""
    at = closest(spline, 0, place[None])[0]
    slope = derivative(spline, np.array([0]), at)[0]
    return abs(float(slope[AXES[part.line.group]])) / float(np.sqrt(slope @ slope))


def _turning(part: PieceFeatures, foot: float, here: FloatArray) -> Corner:
    """Give a corner where the piece shows none of its own, with the turn of its chords there."""
    chain = resample(part.points, foot + _APART * np.array([-1.0, 0.0, 1.0]))
    before, after = np.diff(chain, axis=0)
    cross = before[0] * after[1] - before[1] * after[0]
    turn = abs(float(np.rad2deg(np.arctan2(cross, before @ after))))
    return Corner(foot, here.copy(), turn, np.nan, 2.0 * _APART, np.nan)
