"""A feature after its line has changed: its points anew, its plane that of its line.

Examples
--------
>>> from assoc_hull.edit.followup.feature_points import followed
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.model.features import Feature
>>> from assoc_hull.model.feature_geometry import line_numbers
>>> state = wigley(stations=5, waterlines=4)
>>> line, rows = state.lines.key.data[4], state.curves.rows.data[state.lines.curves.data[4][0]]
>>> run = Feature("run", "straight", "run", (line,), rows[[0, 2]].tolist())
>>> followed(state, run, line_numbers(state)).points == tuple(rows[:3].tolist())
True
"""

from __future__ import annotations

from collections.abc import Mapping

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.model.feature_geometry import ROUNDING, host_curve
from assoc_hull.model.features import FEATURE_LEAST, Feature
from assoc_hull.model.state import HullState

__all__ = ["followed", "in_plane"]


def followed(
    state: HullState,
    feature: Feature,
    numbers: Mapping[str, int],
    places: Mapping[int, FloatArray] | None = None,
) -> Feature | None:
    """Give a feature as it lies on its line now.

    Parameters
    ----------
    state : HullState
        The tables.
    feature : Feature
        As it was; its points may have gone.
    numbers : mapping of str to int
        The live lines, by key.
    places : mapping of int to (3,), m, or None
        Where a mapping has sent points that may have gone; as in the tables if None.

    Returns
    -------
    Feature or None
        None if its line, one of its ends or too much of it has gone.
    """
    lines = [numbers[key] for key in feature.lines if key in numbers]
    if len(lines) < len(feature.lines):
        return None
    if feature.kind in ("flat", "knuckle"):
        parts = [state.curves.rows.data[c] for line in lines for c in state.lines.curves.data[line]]
        rows: IntArray | None = np.concatenate([np.zeros(0, np.int64), *parts])
    else:
        rows = _between_ends(state, feature, lines, places or {})
    if rows is None or len(rows) < FEATURE_LEAST[feature.kind]:
        return None
    return in_plane(state, attrs.evolve(feature, points=rows.tolist()), lines[0])


def _between_ends(
    state: HullState, feature: Feature, lines: list[int], places: Mapping[int, FloatArray]
) -> IntArray | None:
    """Give the points of the line between the ends of a feature, the ends included."""
    for line in lines:
        for curve in state.lines.curves.data[line]:
            rows: IntArray = state.curves.rows.data[curve]
            first = _stands(state, rows, feature.points[0], places)
            last = _stands(state, rows, feature.points[-1], places)
            if 0 <= first <= last:
                return rows[first : last + 1]
    return None


def _stands(state: HullState, rows: IntArray, row: int, places: Mapping[int, FloatArray]) -> int:
    """Tell where a point stands among those of a curve, or what took its place; -1 if nowhere."""
    at = np.flatnonzero(rows == row)
    if not len(at) and not state.rows.alive.data[row]:
        away = state.rows.xyz.data[rows] - places.get(row, state.rows.xyz.data[row])
        at = np.flatnonzero(dot(away, away) <= ROUNDING * ROUNDING)
    return int(at[0]) if len(at) else -1


def in_plane(state: HullState, feature: Feature, line: int) -> Feature | None:
    """Lay a feature into the plane of its line; turn a join as its point is turned.

    Returns
    -------
    Feature or None
        None for a join whose point is no tangent point any more.
    """
    if feature.kind == "tangent":
        return _turned(state, feature)
    if feature.normal is None or not state.lines.planar.data[line]:
        return feature
    normal, offset = state.lines.normal.data[line], float(state.lines.offset.data[line])
    if feature.centre is None:
        return attrs.evolve(feature, normal=normal, offset=offset)
    centre = np.array(feature.centre)
    beside = float((centre * normal).sum()) - offset
    if beside != 0.0:
        centre = centre - beside * normal
    return attrs.evolve(feature, normal=normal, centre=centre.tolist())


def _turned(state: HullState, feature: Feature) -> Feature | None:
    """Give a join the direction of its point; None if that is no tangent point any more."""
    row, curve = feature.points[0], host_curve(state, feature)
    on = np.flatnonzero(state.rows.curve.data[row] == curve)
    if curve < 0 or state.rows.kind.data[row, on[0]] != PointKind.TANGENT:
        return None
    along = state.rows.direction.data[row, on[0]]
    return attrs.evolve(feature, direction=along / np.sqrt((along * along).sum()))
