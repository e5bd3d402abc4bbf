"""The last touch on densely drawn curves: adopted points that bend them too often.

An adopted point may give its curve an inflection that its line lacks. A neighbouring given
point often does as well without it; else the point is dropped where the curve still passes its
line by less than twice the tolerance, and the line is reported.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.edit.adoption.thin_worst import distances
from assoc_hull.edit.adoption.thinning_state import (
    Item,
    Left,
    Work,
    add_point,
    knots_of,
    loft_orders,
)
from assoc_hull.geometry.curves import PointKind, SplineBatch
from assoc_hull.geometry.fairness.inflections import inflections

__all__ = ["polish"]

_MOST = 2.0
"""A point is dropped for an inflection where the line is passed by less than this many times
its tolerance."""

_TRIES = 6
"""Given points to each side of an adopted one that are tried in its place."""


@attrs.frozen
class _Change:
    """A change of one adopted point: to another given point, or none; what is then allowed."""

    place: int
    point: int
    allowed: float


@attrs.frozen
class _Shape:
    """How a curve stands to its line: inflections too many, and the part of the tolerance."""

    excess: int
    part: float


def polish(work: Work, orders: list[list[Item]]) -> tuple[list[list[Item]], list[Left]]:
    """Move or drop adopted points of dense plane curves that add inflections.

    Parameters
    ----------
    work : Work
        Points that take the place of others are added to it.
    orders : list of list of Item
        What defines each curve.

    Returns
    -------
    orders : list of list of Item
        With the changes.
    left : list of Left
        Given points passed farther off than the tolerance for it.
    """
    out, left = list(orders), []
    for curve, source in enumerate(work.net.sources):
        if not source.dense or source.normal is None:
            continue
        goal = int(inflections(work.net.reference.curve(curve), source.normal)[0][0])
        shape = _shape(work, curve, out[curve], goal)
        before = shape
        while shape.excess > 0:
            better = _better(work, curve, out[curve], goal, shape)
            if better is None:
                break
            out[curve], shape = better
        if shape.part > max(1.0, before.part):
            left.append(_left(work, curve, out[curve]))
    return out, left


def _better(
    work: Work, curve: int, order: list[Item], goal: int, shape: _Shape
) -> tuple[list[Item], _Shape] | None:
    """Change the one adopted point that leaves the fewest inflections; None if none does."""
    normal = work.net.sources[curve].normal
    assert normal is not None
    changes = [
        change
        for place in range(1, len(order) - 1)
        if _may_go(work, order[place])
        for change in _changes(work, curve, order, place)
    ]
    trials = [_changed(work, curve, order, change) for change in changes]
    if not trials:
        return None
    splines = loft_orders(work, [curve] * len(trials), trials)
    excess = np.maximum(inflections(splines, np.tile(normal, (len(trials), 1)))[0] - goal, 0)
    found = None
    for i in np.argsort(excess, kind="stable").tolist():
        if excess[i] >= shape.excess or (found and excess[i] > found[1].excess):
            break
        part = _part(work, curve, trials[i], splines, i)
        if part <= max(changes[i].allowed, shape.part) and (not found or part < found[1].part):
            found = trials[i], _Shape(int(excess[i]), part)
    return found


def _may_go(work: Work, item: Item) -> bool:
    """Tell whether an item is an adopted point, no crossing and no placed point or knuckle."""
    if item.number < work.fixed_count:
        return False
    point = work.points[item.number - work.fixed_count]
    return point.kind == PointKind.SMOOTH and not point.placed


def _changes(work: Work, curve: int, order: list[Item], place: int) -> list[_Change]:
    """List the given points that may take the place of one, and the change that drops it."""
    knots = knots_of(work, curve)
    low, high = order[place - 1].at, order[place + 1].at
    here = int(np.abs(knots - order[place].at).argmin())
    spacing = work.net.state.tolerances.adopted_spacing
    near = range(max(here - _TRIES, 1), min(here + _TRIES + 1, len(knots) - 1))
    moves = [
        _Change(place, point, 1.0)
        for point in near
        if point != here and low + spacing < float(knots[point]) < high - spacing
    ]
    return [*moves, _Change(place, -1, _MOST)]


def _changed(work: Work, curve: int, order: list[Item], change: _Change) -> list[Item]:
    before, after = order[: change.place], order[change.place + 1 :]
    if change.point < 0:
        return [*before, *after]
    return [*before, add_point(work, curve, change.point), *after]


def _shape(work: Work, curve: int, order: list[Item], goal: int) -> _Shape:
    source = work.net.sources[curve]
    spline = loft_orders(work, [curve], [order])
    assert source.normal is not None
    excess = int(inflections(spline, source.normal)[0][0]) - goal
    return _Shape(max(excess, 0), _part(work, curve, order, spline, 0))


def _part(work: Work, curve: int, order: list[Item], splines: SplineBatch, number: int) -> float:
    away = distances(work, [curve], [order], splines, [number])[0][0]
    return float((away / work.net.sources[curve].tolerance).max())


def _left(work: Work, curve: int, order: list[Item]) -> Left:
    """Say which given point is passed farthest off for its tolerance."""
    spline = loft_orders(work, [curve], [order])
    away, beside = distances(work, [curve], [order], spline, [0])[0]
    point = int((away / work.net.sources[curve].tolerance).argmax())
    return Left(curve, point, float(away[point]), float(beside[point]), True)
