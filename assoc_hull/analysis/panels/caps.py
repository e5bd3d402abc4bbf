"""Panels over what the surface leaves open at its ends: transoms, bossing ends.

The half face between an arc and the centre plane is a patch of four sides: the arc is cut at the
place that lies farthest off its chord, into bottom and side; the waterline and the centre line
face them. An arc that does not begin on the centre plane is closed with itself.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.panels.arc_division import Arc, Divided
from assoc_hull.analysis.panels.bands import Waterplane
from assoc_hull.analysis.panels.fill import blended
from assoc_hull.analysis.panels.sheets import Sheet
from assoc_hull.geometry.curves import FloatArray

__all__ = ["Cap", "caps"]


@attrs.frozen(eq=False)
class Cap:
    """A face as a grid of places.

    Attributes
    ----------
    grid : (m, n, 3), m
        First direction outward along bottom and waterline, second upward.
    turned : bool
        Its panels face against the cross product of these directions.
    water : (m, n) bool
        Places on the waterplane.
    """

    grid: FloatArray
    turned: bool
    water: NDArray[np.bool_]


@attrs.frozen(eq=False)
class _Open:
    """A run of points at the end of a band beyond which nothing is.

    `where` is the band, its end and whether this is port; `begins` and `water` say whether the
    first and the last point lie on the waterplane.
    """

    places: FloatArray
    where: tuple[int, int, bool]
    begins: bool
    water: bool

    @property
    def end(self) -> int:
        return self.where[1]

    @property
    def port(self) -> bool:
        return self.where[2]


def caps(every: list[Sheet], divided: Divided, plane: Waterplane, centre: float) -> list[Cap]:
    """Close all open ends.

    Parameters
    ----------
    every : list of Sheet
        All sheets.
    divided : Divided
        Their points.
    plane : Waterplane
        The water, as port sees it.
    centre : float, m
        Places so near to the centre plane lie on it.
    """
    found = []
    left = _open(every, divided, centre)
    while left:
        each = left.pop(0)
        if abs(each.places[0, 1]) > centre:
            found.append(_with_itself(each))
            continue
        partner = next((other for other in left if _faces(other, each, centre)), None)
        halves = [each] if partner is None else [each, partner]
        if partner is not None:
            left.remove(partner)
        top = _top(each, partner, plane)
        # Both halves of a face share the centre line, and with it the number of points there.
        side = len(each.places) - 1 - _corner(each.places)
        side = min(side, *(len(half.places) - 2 for half in halves))
        found += [_half(half, len(half.places) - 1 - side, top) for half in halves]
    return found


def _open(every: list[Sheet], divided: Divided, centre: float) -> list[_Open]:
    """Find what is open at the ends of bands."""
    found: list[_Open] = []
    for arc in divided.arcs:
        sheet = every[arc.sheet]
        if not (sheet.open_fore if arc.end else sheet.open_aft):
            continue
        for each in _alone(sheet, arc, divided, centre):
            before = found[-1] if found else None
            if before is not None and _goes_on(before, each):
                places = np.concatenate([before.places, each.places])
                found[-1] = attrs.evolve(each, places=places, begins=before.begins)
            else:
                found.append(each)
    return found


def _alone(sheet: Sheet, arc: Arc, divided: Divided, centre: float) -> list[_Open]:
    """Find the runs of pieces off the centre plane that no other sheet has."""
    pieces = [divided.pieces[each] for each in arc.pieces]
    alone = [
        len(piece.users) == 1 and bool((np.abs(piece.places[:, 1]) > centre).any())
        for piece in pieces
    ]
    edge = np.diff(np.array([False, *alone, False]).astype(int))
    afloat = sheet.afloat[arc.chain]
    found = []
    for first, last in zip(
        np.flatnonzero(edge > 0).tolist(), np.flatnonzero(edge < 0).tolist(), strict=True
    ):
        run = [each.points for each in pieces[first:last]]
        places = np.concatenate([*(each[:-1] for each in run), run[-1][-1:]])
        begins = first == 0 and bool(afloat[0])
        ends = last == len(pieces) and bool(afloat[1])
        found.append(_Open(places, (sheet.band, arc.end, sheet.port), begins, ends))
    return found


def _goes_on(one: _Open, other: _Open) -> bool:
    """Tell whether an arc comes back into the water inboard of where it left it: one face."""
    if one.where != other.where or not (one.water and other.begins):
        return False
    return abs(float(other.places[0, 1])) < abs(float(one.places[-1, 1]))


def _faces(one: _Open, other: _Open, near: float) -> bool:
    """Tell whether two runs are halves of one face."""
    apart = float(np.abs(one.places[0] - other.places[0]).max())
    return one.end == other.end and one.port != other.port and apart <= 10.0 * near


def _corner(places: FloatArray) -> int:
    """Give the point that lies farthest off the chord: between bottom and side."""
    chord = places[-1] - places[0]
    way = places - places[0]
    size = float((chord**2).sum())
    off = way - ((way @ chord) / (size if size > 0.0 else 1.0))[:, None] * chord
    far = (off**2).sum(axis=1)
    corner = int(far.argmax()) if far.max() > 1e-6 * size else len(places) // 2
    return min(max(corner, 1), len(places) - 2)


def _top(each: _Open, partner: _Open | None, plane: Waterplane) -> FloatArray:
    """Give the upper end of the centre line."""
    last: FloatArray = each.places[-1]
    if not each.water:
        return last
    if partner is not None and partner.water and partner.places[-1, 1] != last[1]:
        other = partner.places[-1]
        # In the same order whichever half asks, so that both get the same place.
        a, b = (last, other) if each.port else (other, last)
        part = a[1] / (a[1] - b[1])
        found: FloatArray = a + part * (b - a)
        found[1] = 0.0
        return found
    x = float(last[0])
    return np.array([x, 0.0, plane.height + plane.tan_trim * x])


def _half(each: _Open, corner: int, top: FloatArray) -> Cap:
    """Fill the half face between an arc and the centre line."""
    places = each.places
    bottom, side = places[: corner + 1], places[corner:]
    left = _line(places[0], top, len(side))
    grid = blended(bottom, side, _line(top, places[-1], len(bottom)), left)
    water = np.zeros(grid.shape[:2], np.bool_)
    water[:, -1] = each.water
    return Cap(grid, _turned(each), water)


def _with_itself(each: _Open) -> Cap:
    """Fill what an arc cuts off between its two ends."""
    places = each.places
    count = len(places)
    half = (count + 1) // 2
    grid = np.stack([places[:half], places[::-1][:half]], axis=1)
    water = np.zeros(grid.shape[:2], np.bool_)
    water[0] = each.water
    return Cap(grid[:, ::1], _turned(each), water)


def _turned(each: _Open) -> bool:
    """Tell whether the face runs against its grid: bottom to port times up looks forward."""
    return bool((each.end == 0) == each.port)


def _line(first: FloatArray, last: FloatArray, count: int) -> FloatArray:
    part = np.linspace(0.0, 1.0, count)[:, None]
    found: FloatArray = first + part * (last - first)
    found[-1] = last
    return found
