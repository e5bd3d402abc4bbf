"""Where thinned curves pass what was given too far off."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from assoc_hull.edit.adoption.dense_lines import near, room, sharp
from assoc_hull.edit.adoption.thin_gaps import wide_gaps
from assoc_hull.edit.adoption.thinning_state import (
    SAME,
    Item,
    Left,
    Net,
    Work,
    knots_of,
    thinned_at,
)
from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.splines.closest import closest_each
from assoc_hull.model.kinds import Role

__all__ = ["distances", "find_wide", "find_worst"]

_GAP = 0.4
"""Densely drawn curves are held so that watched gaps keep below this part of the tolerance."""


def find_worst(
    net: Net, splines: SplineBatch, orders: list[list[Item]], work: Work
) -> tuple[list[tuple[int, int]], list[Left]]:
    """Give, per curve that passes given points too far off, the worst one to be taken in.

    Also given are the points that cannot be: beside a point that defines the curve already a
    second one would only make it turn.
    """
    found: list[tuple[int, int]] = []
    left: list[Left] = []
    numbers = [[item.number for item in order] for order in orders]
    # A curve made through the same points as when it held its line holds it still.
    todo = [i for i, order in enumerate(numbers) if work.held.get(i) != order]
    measured = distances(work, todo, [orders[i] for i in todo], splines, todo)
    for curve, (away, beside) in zip(todo, measured, strict=True):
        source = net.sources[curve]
        for point in np.flatnonzero(away > source.tolerance).tolist():
            close = beside[point] < net.state.tolerances.adopted_spacing
            if close and not source.dense and thinned_at(work, curve, point) is None:
                left.append(Left(curve, point, float(away[point]), float(beside[point])))
                away[point] = 0.0
        worst = int((away / source.tolerance).argmax())
        if not (away > source.tolerance).any():
            worst = _sharp(work, curve, orders[curve]) if source.dense else -1
        if worst >= 0:
            found.append((curve, worst))
        elif not any(each.curve == curve for each in left):
            work.held[curve] = numbers[curve]
    return found, left


def find_wide(
    net: Net, splines: SplineBatch, orders: list[list[Item]], work: Work, roles: list[Role]
) -> list[tuple[int, int]]:
    """Give, per curve, a given point to be taken in because a watched gap is wide."""
    watched = [
        meeting
        for meeting, role in zip(net.meetings, roles[len(net.contacts) :], strict=True)
        if role is Role.WATCHED and net.sources[meeting.a].dense and net.sources[meeting.b].dense
    ]
    found = iter(wide_gaps(net.reference, splines, watched, _GAP * net.state.tolerances.adoption))
    return _rooms(work, orders, zip(found, found, strict=True))


def _rooms(
    work: Work, orders: list[list[Item]], places: Iterable[tuple[tuple[int, float], ...]]
) -> list[tuple[int, int]]:
    """Give a given point for the first curve of each place that has room; one per curve."""
    found: dict[int, int] = {}
    for choice in places:
        for curve, at in choice:
            edges = np.array([item.at for item in orders[curve]])
            spacing = work.net.state.tolerances.adopted_spacing
            point = near(edges, knots_of(work, curve), at, spacing)
            if point >= 0:
                found.setdefault(curve, point)
                break
    return sorted(found.items())


def distances(
    work: Work,
    curves: Sequence[int],
    orders: Sequence[list[Item]],
    splines: SplineBatch,
    numbers: Sequence[int],
) -> list[tuple[FloatArray, FloatArray]]:
    """Give how far curves pass the given points, and how far those are from defining ones.

    Parameters
    ----------
    work : Work
        What was given.
    curves : (m,) int
        The curves.
    orders : (m,) list of Item
        What defines each.
    splines, numbers : SplineBatch, (m,) int
        A batch with the curves lofted through them, and which of its curves they are.

    Returns
    -------
    (m,) pairs
        away : (n,), m
            Nil at a defining point; of a dense line, also where there is no room for one more.
        beside : (n,), m
            From the nearest defining point.
    """
    pairs = list(zip(curves, orders, strict=True))
    measured = [_beside(work, curve, order) for curve, order in pairs]
    asked = [
        work.net.sources[curve].points[there]
        for curve, (there, _) in zip(curves, measured, strict=True)
    ]
    sizes = [len(points) for points in asked]
    off = closest_each(
        splines,
        np.repeat(np.array(numbers, np.int64), sizes),
        np.concatenate([np.zeros((0, 3)), *asked]),
    )[2]
    found, begin = [], 0
    for (curve, order), (there, beside) in zip(pairs, measured, strict=True):
        away = np.zeros(len(beside))
        away[there] = off[begin : begin + len(there)]
        begin += len(there)
        _close_off(work, curve, order, away)
        found.append((away, beside))
    return found


def _beside(work: Work, curve: int, order: list[Item]) -> tuple[IntArray, FloatArray]:
    """Find the given points of a curve that define it not, and how far all are from those."""
    known = work.given.xyz[work.numbers(order)]
    step = work.net.sources[curve].points[:, None, :] - known[None, :, :]
    there = np.flatnonzero(np.abs(step).max(axis=2).min(axis=1) > SAME)
    return there, np.sqrt((step * step).sum(axis=2)).min(axis=1)


def _close_off(work: Work, curve: int, order: list[Item], away: FloatArray) -> None:
    """Pass over the points of a dense line where there is no room for one more."""
    if work.net.sources[curve].dense:
        edges = np.array([item.at for item in order])
        spacing = work.net.state.tolerances.adopted_spacing
        away[~room(edges, knots_of(work, curve), spacing)] = 0.0


def _sharp(work: Work, curve: int, order: list[Item]) -> int:
    """Give a given point where the chords of a dense line would fold; -1 if nowhere."""
    edges = np.array([item.at for item in order])
    numbers = work.numbers(order)
    kind, _ = work.given.on(np.array(curve), numbers)
    known = work.given.xyz[numbers]
    return sharp(known, edges, knots_of(work, curve), kind == PointKind.KNUCKLE)
