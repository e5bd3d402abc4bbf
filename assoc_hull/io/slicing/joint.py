"""Smooth lines of all families that meet: fitted one by one, then all at once."""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.edit.adoption.adopt import where_they_meet
from assoc_hull.edit.adoption.match_crossings import Meeting
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.polylines.joint import Tie, join_fits
from assoc_hull.geometry.polylines.smooth import Fitted
from assoc_hull.geometry.splines.evaluation import derivative
from assoc_hull.io.slicing.plan import Plan, piece_columns, piece_plane
from assoc_hull.io.slicing.sources import make_source
from assoc_hull.model.state import Association

__all__ = ["join_plans"]

_ROUNDS = 2
"""How often the meetings are found again: where lines meet moves as they do."""

_LEAST_SINE = 0.05
"""Lines that run together at less than this have no normal that can be told."""


def join_plans(
    plans: Sequence[Plan], associations: Sequence[Association], near: float
) -> list[Plan]:
    """Fit the smooth lines again, all at once, so that they meet.

    Parameters
    ----------
    plans : sequence of Plan
        Pieces of sections, waterlines and buttocks, each smoothed for itself.
    associations : sequence of Association
        Which groups meet.
    near : float, m
        A gap of two lines that weighs as much as a datum passed by all that is allowed.

    Returns
    -------
    list of Plan
        In the order given.
    """
    found = list(plans)
    for _ in range(_ROUNDS):
        fits = [each.fitted for plan in found for each in plan.stretches]
        numbers = _numbers(fits)
        ties = _ties(found, associations, numbers)
        joined = iter(join_fits([each for each in fits if each is not None], ties, near))
        found = [
            attrs.evolve(
                plan,
                stretches=tuple(
                    each if each.fitted is None else attrs.evolve(each, fitted=next(joined))
                    for each in plan.stretches
                ),
            )
            for plan in found
        ]
    return found


def _numbers(fits: Sequence[Fitted | None]) -> list[int]:
    """Give each stretch that is fitted its number, -1 to straight ones."""
    count = iter(range(len(fits)))
    return [-1 if each is None else next(count) for each in fits]


@attrs.frozen(eq=False)
class _Track:
    """Where the points of a line come from: its stretches, by first point, and lengths."""

    first: IntArray
    number: list[int]
    at: list[FloatArray]

    def find(self, interval: int, part: float) -> tuple[int, float]:
        """Give the fit, -1 if straight, and the length for a place in an interval of points."""
        stretch = int(np.searchsorted(self.first, interval, "right")) - 1
        at, i = self.at[stretch], interval - int(self.first[stretch])
        return self.number[stretch], float(at[i] + part * (at[i + 1] - at[i]))


def _tracks(plans: Sequence[Plan], numbers: Sequence[int]) -> list[_Track]:
    tracks, begin = [], 0
    for plan in plans:
        at = [each.draw().at for each in plan.stretches]
        first = np.concatenate([[0], np.cumsum([len(each) - 1 for each in at])[:-1]])
        tracks.append(_Track(first, list(numbers[begin : begin + len(at)]), at))
        begin += len(at)
    return tracks


def _ties(
    plans: Sequence[Plan], associations: Sequence[Association], numbers: Sequence[int]
) -> list[Tie]:
    """Give a tie for every meeting at which at least one line may move."""
    sources = [make_source(plan, 1.0)[0] for plan in plans]
    reference, meetings = where_they_meet(sources, associations)
    tracks = _tracks(plans, numbers)
    curve = np.array([[each.a, each.b] for each in meetings]).reshape(-1, 2)
    at = np.array([each.at for each in meetings]).reshape(-1, 2)
    one, other = (_unit(derivative(reference, curve[:, i], at[:, i])) for i in (0, 1))
    across = np.cross(one, other)
    sine = np.sqrt((across * across).sum(axis=1))
    found = []
    for i in np.flatnonzero(sine > _LEAST_SINE).tolist():
        tie = _tie(plans, tracks, reference, meetings[i], across[i] / sine[i])
        if tie is not None:
            found.append(tie)
    return found


def _unit(slope: FloatArray) -> FloatArray:
    return np.asarray(slope / np.sqrt((slope * slope).sum(axis=1))[:, None])


def _tie(
    plans: Sequence[Plan],
    tracks: Sequence[_Track],
    reference: SplineBatch,
    meeting: Meeting,
    normal: FloatArray,
) -> Tie | None:
    ends = []
    for curve, at, spot in zip((meeting.a, meeting.b), meeting.at, meeting.spots, strict=True):
        knot = reference.knot[int(reference.start[curve]) : int(reference.start[curve + 1])]
        interval = int(np.clip(np.searchsorted(knot, at, "right") - 1, 0, len(knot) - 2))
        part = (at - float(knot[interval])) / float(knot[interval + 1] - knot[interval])
        number, length = tracks[curve].find(interval, part)
        way = normal[piece_columns(plans[curve].part)]
        ends.append((number, length, way, _rest(plans[curve], number, normal, spot)))
    ends.sort(key=lambda end: end[0] < 0)
    (a, at_a, way_a, rest_a), (b, at_b, way_b, rest_b) = ends
    return None if a < 0 else Tie(a, at_a, way_a, b, at_b, way_b, rest_b - rest_a)


def _rest(plan: Plan, number: int, normal: FloatArray, spot: FloatArray) -> float:
    """Give what adds to the height along the normal and may not move, m."""
    plane = piece_plane(plan.part)
    if number < 0 or plane is None:
        return float(spot @ normal)
    return float(plane[0] @ normal) * plane[1]
