"""Tangents at points that have none: slopes of parabolas through three points each.

In chord length (the default) the parabola is one in the plane, the same in every frame; interior
tangents of points on a circle are exact. ``form="graph"`` is the literal y(x) of the source, Kim
and Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and Production",
J. SNAK. With unit chords s of lengths h:

    inside      T_i = (h_i s_(i-1) + h_(i-1) s_i) / (h_(i-1) + h_i)
    first       T_0 = 2 s_0 - T_1, the last likewise
    where one end of a chord has a known direction t: 2 (t.s) s - t at the other

Three points in a row belong to a straight run: they take its direction.

Examples
--------
>>> from assoc_hull.geometry.classical.biarc_tangents import biarc_tangents
>>> found = biarc_tangents([[0, 0], [1, 0.8], [2.5, 1.5], [4, 1.7], [6, 1.2]])
>>> found.leaving_angles.round(6).tolist()
[0.776027, 0.570949, 0.277722, -0.026922, -0.446491]
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.biarc_family import biarc_points
from assoc_hull.geometry.classical.biarc_part import TangentForm, TangentPart
from assoc_hull.geometry.classical.checks import called, finite
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["BiarcTangents", "biarc_tangents"]

_TOLERANCE = 1e-9
"""Points as near as this part of the size of all coincide."""
_SMALLEST = 1e-150


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
    >>> from assoc_hull.geometry.classical.biarc_tangents import biarc_tangents
    >>> found = biarc_tangents([[0, 0], [1, 0], [2, 0], [2, 3]], knuckles=[2])
    >>> found.arriving[2].tolist(), found.leaving[2].tolist()
    ([1.0, 0.0], [0.0, 1.0])
    """
    placed = biarc_points(points)
    _refuse_points(placed)
    sine = float(finite(collinear, "biarc", ()))
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
            number = each if isinstance(each, int | float | np.number) else called(each)
            raise GeometryError(
                f"biarc: knuckle {number} is no inner point of {count}",
                f"give whole numbers from 1 to {count - 2}" if count > 2 else "there is none",
                {"knuckle": each, "count": count},
            )  # fmt: skip
        found.add(int(place))
    return [0, *sorted(found), count - 1]
