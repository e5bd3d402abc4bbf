"""Which of the points that a follower may pass or leave make it as fair as it was.

A follower that slides over the hull is made through what it must pass. Of other places it is
known how far it may pass them off: which of these it is made through is free, and decides
whether it waves. They are chosen one after the other, each time the one that helps most.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.edit.followup.thread import interval_of
from assoc_hull.edit.recut.carried_points import Carried, Through, through
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.fairness.comb_integrals import (
    DEAD_BAND,
    comb_integrals,
    curvature_sign_changes,
)
from assoc_hull.geometry.splines.closest import closest
from assoc_hull.geometry.splines.curve_order import folds
from assoc_hull.geometry.splines.loft import loft

__all__ = ["Option", "choose_fair", "too_near"]

_COMB = 1.5
"""A comb integral may grow to so many times what it was."""

_ROUNDS = 12

_NEAR = 0.15
"""No option is taken as near as this (m) to a point of the follower."""

_PART = 0.2
"""Nor nearer to an end of the chord that it comes into than this part of it."""


@attrs.frozen(eq=False)
class Option:
    """A place that a follower may pass.

    Attributes
    ----------
    row : int
        The point; -1 for a new adopted one.
    place : (3,), m
        Where it is.
    limit : float, m
        How far the follower may pass it off where it is not made through it.
    near : float, m
        Not taken where a point of the follower is as near as this, or nearly so; nil: anywhere.
    """

    row: int
    place: FloatArray
    limit: float
    near: float = _NEAR


@attrs.frozen(eq=False)
class _Trial:
    """Points of a follower, and which of the options are among them."""

    points: Through
    taken: frozenset[int]


def too_near(places: FloatArray, index: int, place: FloatArray, least: float) -> bool:
    """Tell whether a place is too near to points of a curve to come before the one at an index.

    Two points near to each other and a little off wave more than the curve strays without one.
    """
    away = np.sqrt(((places - place) ** 2).sum(axis=1))
    step = places[index] - places[index - 1]
    chord = float(np.sqrt((step * step).sum()))
    beside = float(min(away[index], away[index - 1]))
    return float(away.min()) <= least or beside < _PART * chord


def choose_fair(
    work: Carried, curve: int, found: Through, options: Sequence[Option]
) -> tuple[int, ...]:
    """Take and leave options until a follower is as fair as it was, or none helps any more.

    Parameters
    ----------
    work : Carried
        The transformation.
    curve : int
        The follower.
    found : Through
        Its points, options among them; changed in place.
    options : sequence of Option
        Places that it may pass.

    Returns
    -------
    tuple of int
        The options that it is made through now, by place in the sequence.
    """
    best = _Trial(found, frozenset(i for i, each in enumerate(options) if _is_in(found, each)))
    normal = work.planes.normal[work.state.line_of(curve)]
    was = _unfair(work.state.spline(curve), normal)
    cost = _costs(work, curve, [best], normal, was)[0]
    for _ in range(_ROUNDS):
        if cost == (0, 0.0):
            break
        trials = _toggled(best, options)
        costs = _costs(work, curve, trials, normal, was)
        order = sorted(range(len(trials)), key=lambda i: costs[i])
        better = [trials[i] for i in order if costs[i] < cost][:_ROUNDS]
        chosen = next((each for each in better if _may(work, curve, each, options)), None)
        if chosen is None:
            break
        best, cost = chosen, costs[trials.index(chosen)]
    found.row, found.place = best.points.row, best.points.place
    return tuple(sorted(best.taken))


def _is_in(found: Through, option: Option) -> bool:
    """Tell whether a follower is made through an option."""
    if option.row >= 0:
        return option.row in found.row
    return any(
        row < 0 and bool((place == option.place).all())
        for row, place in zip(found.row, found.place, strict=True)
    )


def _toggled(best: _Trial, options: Sequence[Option]) -> list[_Trial]:
    """Give the trials that differ by one option."""
    trials = list[_Trial]()
    for i, option in enumerate(options):
        if i in best.taken:
            trials.append(_Trial(_without(best.points, option), best.taken - {i}))
            continue
        places = np.array(best.points.place)
        index = interval_of(places, option.place)
        if not option.near or not too_near(places, index, option.place, option.near):
            trials.append(_Trial(_with(best.points, option, index), best.taken | {i}))
    return trials


def _with(points: Through, option: Option, index: int) -> Through:
    row, place = list(points.row), list(points.place)
    row.insert(index, option.row)
    place.insert(index, option.place.copy())
    return Through(row, place, [])


def _without(points: Through, option: Option) -> Through:
    left = [
        (row, place) for row, place in zip(points.row, points.place, strict=True)
        if row != option.row or (row < 0 and not bool((place == option.place).all()))
    ]  # fmt: skip
    return Through([row for row, _ in left], [place for _, place in left], [])


def _unfair(spline: SplineBatch, normal: FloatArray) -> tuple[IntArray, FloatArray]:
    """Give changes of sign of the curvature, and comb integrals, curve by curve."""
    normals = np.broadcast_to(normal, (spline.count, 3))
    return curvature_sign_changes(spline, normals, DEAD_BAND), comb_integrals(spline, normals)


def _costs(
    work: Carried, curve: int, trials: Sequence[_Trial], normal: FloatArray,
    was: tuple[IntArray, FloatArray],
) -> list[tuple[int, float]]:  # fmt: skip
    """Give how much less fair trials are than the follower was: nil where they are not."""
    if not trials:
        return []
    batch = loft(through(work, [curve] * len(trials), [each.points for each in trials]))
    signs, comb = _unfair(batch, normal)
    more = np.maximum(signs - was[0][0], 0)
    grown = np.where((more > 0) | (comb > _COMB * was[1][0]), comb, 0.0)
    return list(zip(more.tolist(), grown.tolist(), strict=True))


def _may(work: Carried, curve: int, trial: _Trial, options: Sequence[Option]) -> bool:
    """Tell whether a trial passes all options within their limits, and does not fold."""
    spline = loft(through(work, [curve], [trial.points]))
    if len(folds(spline)) > len(folds(work.state.spline(curve))):
        return False
    left = [each for i, each in enumerate(options) if i not in trial.taken]
    if not left:
        return True
    _, _, away = closest(spline, 0, np.array([each.place for each in left]))
    return bool((away <= np.array([each.limit for each in left])).all())
