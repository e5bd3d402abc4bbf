"""Where thinned curves pass what was given too far off."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from assoc_hull.edit.dense import near, room, sharp
from assoc_hull.edit.thin_gaps import wide_gaps
from assoc_hull.edit.thin_work import (
    SAME,
    Item,
    Left,
    Net,
    Work,
    knots_of,
    thinned_at,
)
from assoc_hull.geometry.closest import closest
from assoc_hull.geometry.curves import FloatArray, PointKind, SplineBatch
from assoc_hull.model.family import Role

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
    for curve, source in enumerate(net.sources):
        numbers = [item.number for item in orders[curve]]
        if work.held.get(curve) == numbers:  # made through the same points as when it held
            continue
        away, beside = distances(work, curve, orders[curve], splines, curve)
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
            work.held[curve] = numbers
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
    work: Work, curve: int, order: list[Item], splines: SplineBatch, number: int
) -> tuple[FloatArray, FloatArray]:
    """Give how far a curve passes the given points, and how far they are from defining ones.

    Parameters
    ----------
    work : Work
        What was given.
    curve : int
        The curve.
    order : list of Item
        What defines it.
    splines, number : SplineBatch, int
        A batch with the curve lofted through them, and which of its curves that is.

    Returns
    -------
    away : (n,), m
        Nil at a defining point; of a dense line, also where there is no room for one more.
    beside : (n,), m
        From the nearest defining point.
    """
    net, source = work.net, work.net.sources[curve]
    known = work.given.xyz[work.numbers(order)]
    step = source.points[:, None, :] - known[None, :, :]
    open_ = np.flatnonzero(np.abs(step).max(axis=2).min(axis=1) > SAME)
    away = np.zeros(len(source.points))
    away[open_] = closest(splines, number, source.points[open_])[2]
    if source.dense:
        edges = np.array([item.at for item in order])
        away[~room(edges, knots_of(work, curve), net.state.tolerances.adopted_spacing)] = 0.0
    return away, np.sqrt((step * step).sum(axis=2)).min(axis=1)


def _sharp(work: Work, curve: int, order: list[Item]) -> int:
    """Give a given point where the chords of a dense line would fold; -1 if nowhere."""
    edges = np.array([item.at for item in order])
    numbers = work.numbers(order)
    kind, _ = work.given.on(np.array(curve, np.int64), numbers)
    known = work.given.xyz[numbers]
    return sharp(known, edges, knots_of(work, curve), kind == PointKind.KNUCKLE)
