"""A line through points as a chain of biarcs.

First tangents are estimated at the points, part by part between ends and knuckles; then two arcs
are laid in each interval. The chain has a tangent everywhere but at its knuckles; its curvature
jumps. Its distance from a smooth curve falls with the third power of the spacing. Source: Kim and
Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and Production",
J. SNAK.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from typing import Literal, Self, cast, get_args

import attrs
import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.biarc_family import biarc_points
from assoc_hull.geometry.classical.biarcs import BiarcRule, Biarcs, biarcs
from assoc_hull.geometry.classical.checked_input import (
    argument_text,
    finite_array,
    one_of,
    within_range,
)
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = [
    "BiarcChain",
    "BiarcTangents",
    "TangentForm",
    "TangentPart",
    "biarc_chain",
    "biarc_tangents",
    "check_tangent_form",
    "collinear_runs",
]


def collinear_runs(unit: FloatArray, sine: float, offset: int = 0) -> list[tuple[int, int]]:
    """Give the first and last points of all straight runs of three points or more.

    `unit` (n - 1, 2) are unit chords; chords lie in a row where the sine of the angle between them
    is at most `sine`. `offset` is the number of the first point in messages. Raises GeometryError
    where the curve reverses, and for a point of two straight runs.
    """
    before, behind = unit[:-1], unit[1:]
    across = np.abs(before[:, 0] * behind[:, 1] - before[:, 1] * behind[:, 0])
    ahead = np.sum(before * behind, axis=1) > 0.0
    level = across <= sine
    _refuse(level & ~ahead, "curve reverses at point {}", "mark it as a knuckle", offset)
    row = level & ahead
    # A point that is in no row, between two that are, ends one run and begins another.
    twice = np.zeros_like(row)
    twice[1:-1] = row[:-2] & row[2:] & ~row[1:-1]
    what = "point {} belongs to two different straight runs; mark it as a knuckle"
    _refuse(twice, what, "the line has a corner there", offset)
    edges = np.diff(np.concatenate([[False], row, [False]]).astype(np.int8))
    first, behind_last = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    return list(zip(first.tolist(), (behind_last + 1).tolist(), strict=True))


def _refuse(bad: NDArray[np.bool_], what: str, remedy: str, offset: int) -> None:
    """Refuse where an inner point is bad; numbers count from the first point."""
    if bad.any():
        index = offset + 1 + int(np.argmax(bad))
        raise GeometryError(f"biarc: {what.format(index)}", remedy, {"index": index})


# --------------------------------------------------------------------------------------
# Tangents at points that have none: slopes of parabolas through three points each. In chord length
# (the default) the parabola is one in the plane, the same in every frame; interior tangents of
# points on a circle are exact. ``form="graph"`` is the literal y(x) of the source. With unit chords
# s of lengths h:
#
#     inside      T_i = (h_i s_(i-1) + h_(i-1) s_i) / (h_(i-1) + h_i)
#     first       T_0 = 2 s_0 - T_1, the last likewise
#     where one end of a chord has a known direction t: 2 (t.s) s - t at the other
#
# Three points in a row belong to a straight run: they take its direction.

TangentForm = Literal["chord", "graph"]
KnownTangent = FloatArray | None


def check_tangent_form(form: object) -> TangentForm:
    """Take the name of a form; raises GeometryError for another."""
    what = "biarc: no form of tangents is called"
    return cast(TangentForm, one_of(form, get_args(TangentForm), what))


@attrs.frozen(eq=False)
class TangentPart:
    """Points between two breaks, with what both forms need.

    Attributes
    ----------
    points : (n, 2), m
        In order.
    width : (n - 1,), m
        Of the intervals: lengths of chords, or of a graph differences of the abscissa.
    chord : (n - 1, 2)
        Chords by `width`.
    straight : list of (int, int)
        First and last points of straight runs.
    graph : bool
        Whether tangents are (1, slope) until they are handed out.
    """

    points: FloatArray
    width: FloatArray
    chord: FloatArray
    straight: list[tuple[int, int]]
    graph: bool

    @classmethod
    def of(cls, points: FloatArray, offset: int, form: object, collinear: float) -> Self:
        """Look at points (n, 2), m, none twice in a row; `offset` is the number of the first.

        Raises GeometryError as `biarc_tangents`; points are numbered from the start of the line.
        """
        step = np.diff(points, axis=0)
        length = np.hypot(step[:, 0], step[:, 1])
        runs = collinear_runs(step / length[:, None], collinear, offset)
        if check_tangent_form(form) == "chord":
            return cls(points, length, step / length[:, None], runs, False)
        _refuse_graph(step[:, 0], offset)
        return cls(points, step[:, 0], step / step[:, :1], runs, True)

    def tangents(self, begin: ArrayLike | None, finish: ArrayLike | None) -> FloatArray:
        """Give unit tangents at all points, (n, 2).

        `begin` and `finish` are directions of travel (2,) at both ends, where they are known.
        Raises GeometryError for one that points backwards.
        """
        first = None if begin is None else self._given(begin, self.chord[0])
        last = None if finish is None else self._given(finish, self.chord[-1])
        if len(self.points) == 2:
            found = self._of_two(first, last)
        else:
            found = self._of_more(first, last)
        if self.graph:
            # (1, slope) points to greater x; the line may run the other way.
            found = found * np.sign(self.width[0])
        return np.asarray(found / np.hypot(found[:, :1], found[:, 1:]))

    def _of_two(self, first: KnownTangent, last: KnownTangent) -> FloatArray:
        chord = self.chord[0]
        one = first if first is not None else chord if last is None else self._over(chord, last)
        two = last if last is not None else chord if first is None else self._over(chord, first)
        return np.stack([one, two])

    def _of_more(self, first: KnownTangent, last: KnownTangent) -> FloatArray:
        found, exact = self._inside(first, last)
        found[0] = self._outward(self.chord[0], found[1], exact[1])
        found[-1] = self._outward(self.chord[-1], found[-2], exact[-2])
        for begin, end in self.straight:
            found[begin : end + 1] = self._run(begin, end)
        if first is not None:
            found[0] = first
        if last is not None:
            found[-1] = last
        return found

    def _inside(
        self, first: KnownTangent, last: KnownTangent
    ) -> tuple[FloatArray, NDArray[np.bool_]]:
        """Give tangents of the inner points, and which of them are known as directions."""
        found, exact = np.empty_like(self.points), np.zeros(len(self.points), bool)
        before, behind = self.width[:-1, None], self.width[1:, None]
        found[1:-1] = (behind * self.chord[:-1] + before * self.chord[1:]) / (before + behind)
        guesses = dict[int, FloatArray]()
        if first is not None:
            guesses[1] = self._over(self.chord[0], first)
        if last is not None:
            at, guess = len(found) - 2, self._over(self.chord[-1], last)
            guesses[at] = self._mean(guesses[at], guess) if at in guesses else guess
        for at, guess in guesses.items():
            found[at], exact[at] = guess, True
        for begin, end in self.straight:
            found[begin : end + 1], exact[begin : end + 1] = self._run(begin, end), True
        return found, exact

    def _run(self, begin: int, end: int) -> FloatArray:
        """Give the direction of a straight run."""
        step = self.points[end] - self.points[begin]
        return np.asarray(step / (step[0] if self.graph else np.hypot(*step)))

    def _mean(self, one: FloatArray, other: FloatArray) -> FloatArray:
        found = one + other
        return np.asarray(found / (found[0] if self.graph else np.hypot(*found)))

    def _over(self, chord: FloatArray, known: FloatArray) -> FloatArray:
        """Give the direction at the other end of a chord from the one that is known."""
        weight = 1.0 if self.graph else float(known @ chord)
        return np.asarray(2.0 * weight * chord - known)

    def _outward(self, chord: FloatArray, inner: FloatArray, exact: bool) -> FloatArray:
        """Give the tangent of a free end; an estimate inside is not of unit length."""
        return self._over(chord, inner) if exact else np.asarray(2.0 * chord - inner)

    def _given(self, direction: ArrayLike, chord: FloatArray) -> FloatArray:
        """Take a direction of travel; for a graph as (1, slope)."""
        found = finite_array(direction, "biarc", (2,))
        size = float(np.hypot(*found))
        way = chord * np.sign(self.width[0])
        if size == 0.0 or float(found @ way) <= 0.0:
            raise GeometryError(
                "biarc: given end tangent points backwards", "give the direction of travel",
                {"tangent": tuple(found.tolist())},
            )  # fmt: skip
        if not self.graph:
            return found / size
        if found[0] * self.width[0] <= 0.0:
            raise GeometryError(
                "biarc: given end tangent of a graph stands upright", "take the form of chords",
                {"tangent": tuple(found.tolist())},
            )  # fmt: skip
        return np.asarray(found / found[0])


def _refuse_graph(width: FloatArray, offset: int) -> None:
    bad = np.flatnonzero(width * width[0] <= 0.0)
    if len(bad):
        index = offset + int(bad[0])
        raise GeometryError(
            f"biarc: graph does not go on from point {index} to {index + 1}",
            "take the form of chords", {"index": index},
        )  # fmt: skip


_TOLERANCE = 1e-9
"""Points as near as this part of the extent of all coincide."""

_SMALLEST = 1e-150
"""m: squares of shorter chords would be lost below the smallest number."""


@attrs.frozen(eq=False)
class BiarcTangents:
    """Unit tangents at points; two at knuckles.

    Attributes
    ----------
    arriving : (n, 2)
        At the end of the interval before each point; at the first point as `leaving`.
    leaving : (n, 2)
        At the start of the interval behind each point; at the last point as `arriving`.
    """

    arriving: FloatArray
    leaving: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.arriving, self.leaving)

    @property
    def arriving_angles(self) -> FloatArray:
        """Directions of `arriving`, (n,), rad, -pi to pi."""
        return np.arctan2(self.arriving[:, 1], self.arriving[:, 0])

    @property
    def leaving_angles(self) -> FloatArray:
        """Directions of `leaving`, (n,), rad, -pi to pi."""
        return np.arctan2(self.leaving[:, 1], self.leaving[:, 0])


def biarc_tangents(
    points: ArrayLike,
    *,
    start: ArrayLike | None = None,
    end: ArrayLike | None = None,
    knuckles: Iterable[int] = (),
    form: TangentForm = "chord",
    collinear: float = 1e-9,
) -> BiarcTangents:
    """Estimate the tangents of a line at its points.

    Parameters
    ----------
    points : (n, 2), m
        At least two, in order, none twice in a row.
    start, end : (2,), optional
        Directions of travel at the first and last point, of any length.
    knuckles : iterable of int
        Numbers of inner points where the line breaks; the parts know nothing of each other.
    form : "chord" or "graph"
        Parabolas in chord length, or y(x), for which abscissae must rise or fall all the way.
    collinear : float
        Three points are in a row where the sine of the angle between their chords is at most this.

    Returns
    -------
    BiarcTangents
        Frozen.

    Raises
    ------
    GeometryError
        ``"biarc: at least 2 points"``, ``"biarc: coincident points {i},{i+1}"``,
        ``"biarc: curve reverses at point {i}"``, ``"biarc: given end tangent points backwards"``,
        ``"biarc: point {i} belongs to two different straight runs; mark it as a knuckle"``; a
        knuckle that is no inner point; a graph that turns back or stands upright.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.biarc_chain import biarc_tangents
    >>> found = biarc_tangents([[0, 0], [1, 0], [2, 0], [2, 3]], knuckles=[2])
    >>> found.arriving[2].tolist(), found.leaving[2].tolist()
    ([1.0, 0.0], [0.0, 1.0])
    """
    placed = biarc_points(points)
    _refuse_points(placed)
    sine = float(finite_array(collinear, "biarc", ()))
    breaks = _breaks(knuckles, len(placed))
    arriving, leaving = np.empty((2, len(placed), 2))
    for first, last in pairwise(breaks):
        begin = start if first == 0 else None
        finish = end if last == len(placed) - 1 else None
        part = TangentPart.of(placed[first : last + 1], first, form, sine)
        found = part.tangents(begin, finish)
        leaving[first:last], arriving[first + 1 : last + 1] = found[:-1], found[1:]
    arriving[0], leaving[-1] = leaving[0], arriving[-1]
    return BiarcTangents(arriving, leaving)


def _refuse_points(points: FloatArray) -> None:
    if len(points) < 2:
        raise GeometryError(
            "biarc: at least 2 points", f"there are {len(points)}", {"count": len(points)}
        )
    step = np.diff(points, axis=0)
    least = max(_TOLERANCE * float(np.hypot(*np.ptp(points, axis=0))), _SMALLEST)
    same = np.flatnonzero(np.hypot(step[:, 0], step[:, 1]) <= least)
    if len(same):
        index = int(same[0])
        raise GeometryError(
            f"biarc: coincident points {index},{index + 1}", "leave one of them out",
            {"index": index},
        )  # fmt: skip


def _breaks(knuckles: object, count: int) -> list[int]:
    """Give the numbers of both ends and of the knuckles between, in order."""
    given: Iterable[object] = knuckles if isinstance(knuckles, Iterable) else (knuckles,)
    found = set[int]()
    for each in given:
        place = each if isinstance(each, int | np.integer) else 0
        if not 0 < place < count - 1:
            number = each if isinstance(each, int | float | np.number) else argument_text(each)
            raise GeometryError(
                f"biarc: knuckle {number} is no inner point of {count}",
                f"give whole numbers from 1 to {count - 2}" if count > 2 else "there is none",
                {"knuckle": each, "count": count},
            )  # fmt: skip
        found.add(int(place))
    return [0, *sorted(found), count - 1]


# --------------------------------------------------------------------------------------
# The chain.

_BLOCK = 200_000
"""Distances that are held at once."""


@attrs.frozen(eq=False)
class BiarcChain:
    """Biarcs end to end.

    Attributes
    ----------
    points : (n, 2), m
        What the chain passes through.
    tangents : BiarcTangents
        At the points; two at knuckles.
    biarcs : Biarcs, n - 1 of them
        One for each interval.
    """

    points: FloatArray
    tangents: BiarcTangents
    biarcs: Biarcs
    _ends: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.points, self._ends)

    @property
    def arcs(self) -> PlaneArcs:
        """All arcs in order, two for each interval."""
        return self.biarcs.arcs

    @property
    def notes(self) -> tuple[str, ...]:
        """What is to be said about the biarcs, whole sentences."""
        return self.biarcs.notes

    @property
    def length(self) -> float:
        """Length of the whole, m."""
        return float(self._ends[-1])

    def at(self, s: ArrayLike) -> FloatArray:
        """Give points at arc lengths from the start, m, of any shape: the shape and 2, m.

        Raises
        ------
        GeometryError
            ``"biarc chain: x={} outside [0, {length}]"``.
        """
        arc, t, shape = self._places(s)
        return self.arcs.at(arc, t).reshape(*shape, 2)

    def direction(self, s: ArrayLike) -> FloatArray:
        """Give directions (rad, not wrapped) at arc lengths (m); at knuckles the arriving one.

        Raises
        ------
        GeometryError
            ``"biarc chain: x={} outside [0, {length}]"``.
        """
        arc, t, shape = self._places(s)
        return self.arcs.direction(arc, t).reshape(shape)

    def distances(self, points: ArrayLike) -> FloatArray:
        """Give how far points (k, 2), m, lie from the chain, (k,), m."""
        asked = finite_array(points, "biarc chain", (None, 2))
        found = np.empty(len(asked))
        arcs = np.arange(len(self.arcs))
        many = max(1, _BLOCK // len(arcs))
        for first in range(0, len(asked), many):
            part = asked[first : first + many]
            every = np.tile(arcs, len(part))
            away = self.arcs.distance(every, np.repeat(part, len(arcs), axis=0))
            found[first : first + many] = away.reshape(len(part), -1).min(axis=1)
        return found

    def _places(self, s: ArrayLike) -> tuple[IntArray, FloatArray, tuple[int, ...]]:
        """Give arc and arc length on it of places along the chain, flat, and their shape."""
        length = self.length
        along = within_range(s, "biarc chain", 0.0, length, 1e-12 * length)
        flat = along.ravel()
        arc = np.minimum(np.searchsorted(self._ends, flat), len(self._ends) - 1)
        before = np.where(arc > 0, self._ends[arc - 1], 0.0)
        return arc, flat - before, along.shape


def biarc_chain(
    points: ArrayLike,
    *,
    start: ArrayLike | None = None,
    end: ArrayLike | None = None,
    knuckles: Iterable[int] = (),
    form: TangentForm = "chord",
    rule: BiarcRule = "inverse",
    least_radius: ArrayLike = 0.0,
) -> BiarcChain:
    """Pass a chain of biarcs through points.

    Parameters
    ----------
    points : (n, 2), m
        At least two, in order.
    start, end : (2,), optional
        Directions of travel at both ends.
    knuckles : iterable of int
        Numbers of inner points where the line breaks.
    form : "chord" or "graph"
        How tangents are estimated; see `biarc_tangents`.
    rule : "inverse", "as_printed", "min_jump" or "equal_chord"
        See `biarcs`.
    least_radius : float or (n - 1,), m
        No arc is sharper; 0 for none.

    Raises
    ------
    GeometryError
        As `biarc_tangents` and `biarcs` say.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.biarc_chain import biarc_chain
    >>> chain = biarc_chain([[0, 0], [2, 0], [4, 0], [4, 1]], knuckles=[2])
    >>> chain.biarcs.kind.tolist(), chain.length
    (['line', 'line', 'line'], 5.0)
    """
    placed = biarc_points(points)
    tangents = biarc_tangents(placed, start=start, end=end, knuckles=knuckles, form=form)
    begin, finish = tangents.leaving_angles[:-1], tangents.arriving_angles[1:]
    found = biarcs(placed[:-1], begin, placed[1:], finish, rule=rule, least_radius=least_radius)
    return BiarcChain(placed, tangents, found, np.cumsum(found.arcs.length))
