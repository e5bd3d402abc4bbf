"""An edit: a curve of the net is made to pass through places, its points moving least.

What moves are points that the designer may move: shared crossings and placed points, each
along its freedom. Driven points stay, adopted ones that have to move become placed.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import all_of, instance, places
from assoc_hull.edit.session import Edit
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.plane import AXES
from assoc_hull.model.curve import Curve
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.links import free_axes
from assoc_hull.model.lofting import curve_data
from assoc_hull.model.point import Point
from assoc_hull.model.state import HullState
from assoc_hull.variation.direct.least_change_net import pass_places

__all__ = ["pull_through"]

_MOVED = 1e-12
"""A point moved by less (m) is left alone."""


def pull_through(
    edit: Edit,
    curve: Curve,
    targets: ArrayLike,
    *,
    pins: ArrayLike | None = None,
    fixed: Sequence[Point] = (),
) -> tuple[Point, ...]:
    """Make a curve pass through places, with the least change of its defining points.

    Parameters
    ----------
    edit : Edit
        An open edit.
    curve : Curve
        The curve.
    targets : (k, 3), m
        Places that it is to pass through.
    pins : (p, 3) or None, m
        Places on the curve that it is to keep passing through.
    fixed : sequence of Point
        Points that stay; ends of the curve, for instance.

    Returns
    -------
    tuple of Point
        The points that move, in order along the curve.

    Raises
    ------
    BadInputError
        A place off the plane of the curve, two on one point, or no point that may move.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.variation.direct.pull_through import pull_through
    >>> hull = ah.examples.wigley()
    >>> with hull.edit("a little fuller") as edit:
    ...     moved = pull_through(edit, hull.find("WL 2.5").curves[0], [[52.0, 3.25, 2.5]])
    >>> round(hull.half_breadth(52.0, 2.5), 9)
    3.25
    """
    own = instance(curve, Curve, "curve", "in pull_through")
    state, number = own.tables, own.row
    wanted = places(targets, "targets", "in pull_through")
    if pins is not None:
        wanted = np.concatenate([wanted, places(pins, "pins", "in pull_through")])
    data = curve_data(state, np.array([number]))
    rows: list[int] = state.curves.rows.data[number].tolist()
    stays = {each.row for each in all_of(fixed, Point, "fixed", "in pull_through")}
    motions = _motions(state, [-1 if row in stays else row for row in rows])
    if not len(motions):
        raise BadInputError(
            "pull: no point that may move", f"on {own.name}", "free a point, or pull its driver"
        )
    xyz = pass_places(data, wanted, motions).xyz
    moved = np.flatnonzero(np.abs(xyz - data.xyz).max(axis=1) > _MOVED)
    handles = {point.row: point for point in own.defining}
    for i in moved.tolist():
        to = {axis: float(xyz[i, AXES.index(axis)]) for axis in free_axes(state, rows[i])}
        edit.move(handles[rows[i]], **to)
    return tuple(handles[rows[i]] for i in moved.tolist())


def _motions(state: HullState, rows: Sequence[int]) -> FloatArray:
    """Give the unit motions (m, n, 3) of the points that may move; -1 stands for one that stays."""
    motions = []
    for i, row in enumerate(rows):
        for direction in _directions(state, row):
            motion = np.zeros((len(rows), 3))
            motion[i] = direction
            motions.append(motion)
    return np.array(motions).reshape(-1, len(rows), 3)


def _directions(state: HullState, row: int) -> FloatArray:
    """Give orthogonal unit directions in which a point may move, (f, 3)."""
    table = state.rows
    if row < 0 or (table.sort.data[row] == Sort.CROSSING and table.role.data[row] != Role.SHARED):
        return np.zeros((0, 3))
    lines = [state.line_of(curve) for curve in table.curve.data[row].tolist() if curve >= 0]
    normals = [state.lines.normal.data[line] for line in lines if state.lines.planar.data[line]]
    if not normals:
        return np.eye(3)
    # The planes' normals span what is forbidden; the rest of a full basis is free.
    _, value, right = np.linalg.svd(np.array(normals), full_matrices=True)
    free: FloatArray = right[int((value > 1e-9).sum()) :]
    return free
