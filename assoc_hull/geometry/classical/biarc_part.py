"""Tangents of one part of a line, between its ends or knuckles; `biarc_tangents` has the equations.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.classical.biarc_part import TangentPart
>>> part = TangentPart.of(np.array([[0.0, 0.0], [3.0, 4.0]]), 0, "chord", 1e-9)
>>> part.tangents(None, None).tolist()
[[0.6, 0.8], [0.6, 0.8]]
"""

from __future__ import annotations

from typing import Literal, Self, cast, get_args

import attrs
import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.biarc_runs import straight_runs
from assoc_hull.geometry.classical.checks import finite
from assoc_hull.geometry.classical.choices import one_of
from assoc_hull.geometry.curves import FloatArray

__all__ = ["TangentForm", "TangentPart", "known_form"]

TangentForm = Literal["chord", "graph"]
Known = FloatArray | None


def known_form(form: object) -> TangentForm:
    """Take the name of a form.

    Raises
    ------
    GeometryError
        No such form.
    """
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

        Raises
        ------
        GeometryError
            As `biarc_tangents` says; numbers of points count from the start of the line.
        """
        step = np.diff(points, axis=0)
        length = np.hypot(step[:, 0], step[:, 1])
        runs = straight_runs(step / length[:, None], collinear, offset)
        if known_form(form) == "chord":
            return cls(points, length, step / length[:, None], runs, False)
        _refuse_graph(step[:, 0], offset)
        return cls(points, step[:, 0], step / step[:, :1], runs, True)

    def tangents(self, begin: ArrayLike | None, finish: ArrayLike | None) -> FloatArray:
        """Give unit tangents at all points, (n, 2).

        Parameters
        ----------
        begin, finish : (2,) or None
            Directions of travel at both ends, where they are known.

        Raises
        ------
        GeometryError
            ``"biarc: given end tangent points backwards"``, and as `biarc_tangents` says.
        """
        first = None if begin is None else self._given(begin, self.chord[0])
        last = None if finish is None else self._given(finish, self.chord[-1])
        if len(self.points) == 2:
            found = self._of_two(first, last)
        else:
            found = self._of_more(first, last)
        if self.graph:
            found = found * np.sign(self.width[0])
        return np.asarray(found / np.hypot(found[:, :1], found[:, 1:]))

    def _of_two(self, first: Known, last: Known) -> FloatArray:
        chord = self.chord[0]
        one = first if first is not None else chord if last is None else self._over(chord, last)
        two = last if last is not None else chord if first is None else self._over(chord, first)
        return np.stack([one, two])

    def _of_more(self, first: Known, last: Known) -> FloatArray:
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

    def _inside(self, first: Known, last: Known) -> tuple[FloatArray, NDArray[np.bool_]]:
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
        """Give the tangent of a free end; an estimate inside is of no unit length."""
        return self._over(chord, inner) if exact else np.asarray(2.0 * chord - inner)

    def _given(self, direction: ArrayLike, chord: FloatArray) -> FloatArray:
        """Take a direction that was handed in."""
        found = finite(direction, "biarc", (2,))
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
