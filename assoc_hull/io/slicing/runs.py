"""Straight runs and circular arcs of pieces, found between their corners."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import attrs

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.circular_arcs import Arc, find_arcs
from assoc_hull.geometry.polylines.operations import arc_length
from assoc_hull.geometry.polylines.straight import Onset, Run, find_runs
from assoc_hull.io.slicing.features import FeatureRules, PieceFeatures

__all__ = ["is_known", "runs_of", "with_arcs"]


def runs_of(part: PieceFeatures, rules: FeatureRules) -> tuple[Run, ...]:
    """Give the straight runs between the corners of a plane piece.

    Parameters
    ----------
    part : PieceFeatures
        The piece; runs it holds already are given as they are.
    rules : FeatureRules
        With the rule of runs.
    """
    if part.runs is not None:
        return part.runs
    if part.points.shape[1] != 2 or part.piece.closed:
        return ()
    found: list[Run] = []
    for first, points in _smooth_parts(part):
        found += [_shifted(run, first) for run in find_runs(points, part.noise, rules.run)]
    return tuple(found)


def with_arcs(part: PieceFeatures, rules: FeatureRules) -> PieceFeatures:
    """Give a plane piece with the circular arcs between its corners.

    Parameters
    ----------
    part : PieceFeatures
        The piece, its points as they were given.
    rules : FeatureRules
        With the rule of arcs.
    """
    found: list[Arc] = []
    for first, points in _smooth_parts(part):
        found += [_moved(arc, first) for arc in find_arcs(points, part.noise, rules.arc)]
    return attrs.evolve(part, arcs=tuple(found))


def _smooth_parts(part: PieceFeatures) -> Iterator[tuple[float, FloatArray]]:
    """Give the parts of a plane piece between its corners, each with where it begins, m."""
    if part.points.shape[1] != 2 or part.piece.closed:
        return
    at = arc_length(part.points)
    edges = [0.0, *(corner.at for corner in part.corners), float(at[-1])]
    for low, high in pairwise(edges):
        inside = (at >= low - 1e-9) & (at <= high + 1e-9)
        if inside.sum() >= 6:
            yield float(at[inside][0]), part.points[inside]


def _shifted(run: Run, by: float) -> Run:
    """Count lengths from the beginning of the whole piece."""
    before, after = _later(run.before, by), _later(run.after, by)
    return attrs.evolve(run, begin=run.begin + by, end=run.end + by, before=before, after=after)


def _moved(arc: Arc, by: float) -> Arc:
    before, after = _later(arc.before, by), _later(arc.after, by)
    return attrs.evolve(arc, begin=arc.begin + by, end=arc.end + by, before=before, after=after)


def _later(onset: Onset, by: float) -> Onset:
    return attrs.evolve(onset, at=onset.at + by)


def is_known(onset: Onset, noise: float, rules: FeatureRules) -> bool:
    """Tell whether the place of a tangent point is known well enough to split a line there.

    That is where it is known in metres, and where an error along the line moves the line across
    by less than its points scatter.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polylines.straight import Onset
    >>> from assoc_hull.io.slicing.features import FeatureRules
    >>> from assoc_hull.io.slicing.runs import is_known
    >>> shoulder = Onset("arc", 60.0, np.zeros(2), 120.0, 0.4)
    >>> is_known(shoulder, 1e-3, FeatureRules()), is_known(shoulder, 1e-4, FeatureRules())
    (True, False)
    """
    if onset.kind != "arc":
        return onset.kind == "border"
    across = onset.uncertainty**2 / (2.0 * onset.radius)
    return onset.uncertainty < rules.onset or across < noise
