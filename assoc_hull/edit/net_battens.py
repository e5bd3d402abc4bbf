"""The batten residuals of a hull, and which of its points fairing may move.

These are the points that a field may move, less those of features and all between the ends of a
feature on its curve: a straight run or an arc would be bent off its shape by them. All others stay
in the windows as they are, so that lines run smoothly into flats, knuckles and the profile.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.analysis.fairness.batten_problem import BattenProblem, batten_problem
from assoc_hull.edit.displacement_field import FieldContext
from assoc_hull.edit.hull_normals import free_normals, hull_normals, shape_columns
from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.feature_geometry import host_curve
from assoc_hull.model.tables import HullState

__all__ = ["fairable_rows", "feature_rows", "net_battens"]


def net_battens(state: HullState) -> BattenProblem:
    """Give the residuals of a whole net and how they change with all points that may be faired."""
    depends_on = (
        *shape_columns(state), state.rows.role, state.rows.driver, state.rows.anchor,
        state.rows.anchor_weight, state.rows.key, state.featured.alive, state.featured.feature,
    )  # fmt: skip

    def make() -> BattenProblem:
        normal = hull_normals(state)
        along = free_normals(state, np.arange(state.rows.count), normal)
        return batten_problem(state, fairable_rows(state), normal, along)

    return state.derived(("battens",), depends_on, make, most=1)


def fairable_rows(state: HullState) -> IntArray:
    """Give the points that fairing may move, by key."""
    ground = FieldContext(state, across_flats=False)
    free = ground.free()
    free = free[ground.freedoms(free).good]
    rows = np.setdiff1d(free, feature_rows(state))
    keys = state.rows.key
    return np.array(sorted(rows.tolist(), key=keys.__getitem__), np.int64)


def feature_rows(state: HullState) -> IntArray:
    """Give the points of features, and all between the ends of each on its curve, ascending."""
    found: list[IntArray] = []
    for feature in state.features:
        points = np.array(feature.points, np.int64)
        found.append(points)
        curve = host_curve(state, feature)
        if curve >= 0:
            rows = state.curves.rows.data[curve]
            on = np.flatnonzero(np.isin(rows, points))
            if len(on) > 1:
                found.append(rows[on[0] : on[-1] + 1])
    return np.unique(np.concatenate([np.zeros(0, np.int64), *found]))
