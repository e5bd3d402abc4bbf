"""A line through points as a chain of biarcs: tangents first, then two arcs for each interval.

The chain has a tangent everywhere but at its knuckles; its curvature jumps. Its distance from a
smooth curve falls with the third power of the spacing. Source: Kim and Chang, "Some
Representations of Ship Hulls by Mathematical Method for Design and Production", J. SNAK.

Examples
--------
>>> from assoc_hull.geometry.classical.biarc_chain import biarc_chain
>>> chain = biarc_chain([[0, 0], [1, 0.8], [2.5, 1.5], [4, 1.7], [6, 1.2]])
>>> round(chain.length, 9)
6.539769452
>>> chain.at([0.0, chain.length]).round(12).tolist()
[[0.0, 0.0], [6.0, 1.2]]
"""

from __future__ import annotations

from collections.abc import Iterable

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.geometry.classical.arcs import Arcs
from assoc_hull.geometry.classical.biarc_family import biarc_points
from assoc_hull.geometry.classical.biarc_part import TangentForm
from assoc_hull.geometry.classical.biarc_rules import BiarcRule
from assoc_hull.geometry.classical.biarc_tangents import BiarcTangents, biarc_tangents
from assoc_hull.geometry.classical.biarcs import Biarcs, biarcs
from assoc_hull.geometry.classical.checks import finite, inside
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = ["BiarcChain", "biarc_chain"]

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
    def arcs(self) -> Arcs:
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
        asked = finite(points, "biarc chain", (None, 2))
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
        along = inside(s, "biarc chain", 0.0, length, 1e-12 * length)
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
