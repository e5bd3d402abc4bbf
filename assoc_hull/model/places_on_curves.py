"""Where crossings lie on curves, many curves in one batch: taken out, and put back.

A crossing lies on each of its curves where the curve meets the other line's plane. A few lie on
a curve without such a meeting, as the end of a line on a boundary does: these are *stray*. Both
together are all that the tables hold of places on curves; nothing of it is ever computed again.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.model.places_on_curves import put_places_of, places_of
>>> state = wigley()
>>> found = places_of(state, np.arange(state.curves.count))
>>> put_places_of(state, found)
>>> places_of(state, found.curve).same_bits(found)
True
"""

from __future__ import annotations

from typing import Any, Self

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.model.state import HullState, Meets

__all__ = ["PlacesOn", "Then", "places_of", "put_places_of"]

_STRAY = -1


@attrs.frozen(eq=False)
class PlacesOn:
    """Places of crossings on curves, curve by curve: meetings first, in their order, then strays.

    Attributes
    ----------
    curve, count : (m,) int
        The curves, and how many places each has.
    line, sign, row : (n,) int
        Of each place: the line whose plane is met (-1 for a stray one), the sense, and the
        crossing (-1 where the other line does not come).
    at : (n, 4), m
        Parameter along the curve, and x, y, z.
    """

    curve: IntArray
    count: IntArray
    line: IntArray
    sign: IntArray
    row: IntArray
    at: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.curve, self.count, self.line, self.sign, self.row, self.at)

    @property
    def owner(self) -> IntArray:
        """Index in `curve` of each place."""
        found: IntArray = np.repeat(np.arange(len(self.curve)), self.count)
        return found

    def take(self, chosen: NDArray[np.bool_]) -> Self:
        """Give some of the curves, by mask."""
        mine = chosen[self.owner]
        return attrs.evolve(
            self, curve=self.curve[chosen], count=self.count[chosen], line=self.line[mine],
            sign=self.sign[mine], row=self.row[mine], at=self.at[mine],
        )  # fmt: skip

    def alike(self, other: PlacesOn) -> NDArray[np.bool_]:
        """Tell for each curve whether lines, senses and crossings agree in two batches."""
        found: NDArray[np.bool_] = self.count == other.count
        mine, theirs = self.take(found), other.take(found)
        odd = (mine.line != theirs.line) | (mine.sign != theirs.sign) | (mine.row != theirs.row)
        found[np.flatnonzero(found)[np.unique(mine.owner[odd])]] = False
        return found

    def still(self, other: PlacesOn) -> NDArray[np.bool_]:
        """Tell for each curve whether two batches that are alike agree in every bit."""
        odd = (self.at.view(np.int64) != other.at.view(np.int64)).any(axis=1)
        found = np.ones(len(self.curve), np.bool_)
        found[np.unique(self.owner[odd])] = False
        return found

    def same_bits(self, other: PlacesOn) -> bool:
        """Tell whether two batches of the same curves agree in all."""
        return bool(self.alike(other).all() and self.still(other).all())


@attrs.frozen(eq=False)
class Then:
    """The columns that places are taken from, as they were at another time; None: as now."""

    meets: dict[int, Meets]
    curve: IntArray
    spot: FloatArray
    parameter: FloatArray


def places_of(state: HullState, curves: IntArray, then: Then | None = None) -> PlacesOn:
    """Take out the places on curves.

    Parameters
    ----------
    state : HullState
        The tables.
    curves : (m,) int
        Numbers of the curves, each once.
    then : Then or None
        What the columns held at the time that is meant.
    """
    table = state.rows
    now = Then({}, table.curve.data, table.spot.data, table.parameter.data)
    when = then or now
    meets = [when.meets.get(curve, state.curves.meets.data[curve]) for curve in curves.tolist()]
    met = _join(meets)
    stray_owner, row, side = _strays(when, curves, met[0], met[3])
    owner = np.concatenate([met[0], stray_owner])
    order = np.argsort(owner, kind="stable")
    nothing = np.full(len(row), _STRAY)
    places = np.concatenate(
        [met[4], np.column_stack([when.parameter[row, side], when.spot[row, side]])]
    )
    return PlacesOn(
        curves.copy(),
        np.bincount(owner, minlength=len(curves)).astype(np.int64),
        np.concatenate([met[1], nothing])[order],
        np.concatenate([met[2], np.zeros_like(nothing)])[order],
        np.concatenate([met[3], row])[order],
        np.ascontiguousarray(places[order]),
    )


def _join(meets: list[Meets]) -> tuple[Any, ...]:
    """Put meetings one behind the other: owner, line, sign, row, place."""
    whole = np.zeros(0, np.int64)
    owner = np.repeat(np.arange(len(meets)), [len(each.line) for each in meets])
    line = np.concatenate([whole, *(each.line for each in meets)])
    sign = np.concatenate([whole, *(each.sign for each in meets)])
    row = np.concatenate([whole, *(each.row for each in meets)])
    at = np.concatenate([np.zeros(0), *(each.parameter for each in meets)])
    xyz = np.concatenate([np.zeros((0, 3)), *(each.xyz for each in meets)])
    return owner, line, sign, row, np.column_stack([at, xyz])


def _strays(
    when: Then, curves: IntArray, owner: IntArray, met: IntArray
) -> tuple[IntArray, IntArray, IntArray]:
    """Find crossings that lie on curves without a meeting: index of the curve, row, side."""
    place = np.full(max(int(when.curve.max(initial=-1)), int(curves.max(initial=-1))) + 2, -1)
    place[curves] = np.arange(len(curves))
    on = place[when.curve]
    actual = met >= 0
    side = (when.curve[met[actual], 0] != curves[owner[actual]]).astype(np.int64)
    on[met[actual], side] = -1
    known = ~(np.isnan(when.spot).all(axis=2) & np.isnan(when.parameter))
    row, side = np.nonzero((on >= 0) & known)
    return on[row, side], row, side


def put_places_of(state: HullState, places: PlacesOn) -> None:
    """Put places on curves back; the crossings must know their curves already."""
    starts = np.cumsum(places.count) - places.count
    for curve, start, count in zip(
        places.curve.tolist(), starts.tolist(), places.count.tolist(), strict=True
    ):
        span = slice(start, start + count)
        met = int((places.line[span] >= 0).sum())
        span = slice(start, start + met)
        state.curves.meets.data[curve] = Meets(
            places.line[span].copy(), places.sign[span].astype(np.int8), places.row[span].copy(),
            places.at[span, 0].copy(), places.at[span, 1:].copy(),
        )  # fmt: skip
    actual = places.row >= 0
    row, table = places.row[actual], state.rows
    side = (table.curve.data[row, 0] != places.curve[places.owner[actual]]).astype(np.int64)
    part = 2 * row + side
    table.parameter.parts()[part] = places.at[actual, 0]
    table.spot.parts()[part] = places.at[actual, 1:]
    table.parameter.writes += 1
    table.spot.writes += 1
