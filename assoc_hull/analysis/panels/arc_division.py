"""Points on the arcs of sheets: the same ones wherever two sheets meet.

Every arc is parted into equal lengths. At its two ends a sheet may meet others along a part of
its arc only: there it is parted at their corners first, and each piece gets its share of the
points by the largest remainder. A piece that several sheets have gets the same points in each.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.panels.wet_sheets import WetSheet
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.polynomials import differentiate
from assoc_hull.geometry.splines.arc_length import CubicChains, length_until, share_by_length

__all__ = ["ArcPiece", "DividedSheets", "SheetArc", "divide_sheets"]

_POINT = 1e-6
"""An arc so short, in lengths of the ship, is a point."""

_NEAR = 1e-6
"""A corner so near to an arc, in lengths of the ship, lies on it."""

_SAMPLES = 32
_STEPS = 12
_MAIN = 0.5
"""A sheet with an arc of this part of the longest gets the full number of points."""


@attrs.define(eq=False)
class ArcPiece:
    """A stretch of an arc at the end of sheets; `users` are (sheet, end) that run along it.

    `places` are its beginning, middle and end, `points` what all who have it take.
    """

    places: FloatArray
    parts: int
    points: FloatArray
    users: list[tuple[int, int]] = attrs.field(factory=list)


@attrs.define(eq=False)
class SheetArc:
    """The arc at one end of a sheet: lengths and places where it is parted, and its pieces."""

    sheet: int
    end: int
    chain: int
    cut: FloatArray
    places: FloatArray
    middles: FloatArray
    pieces: list[int] = attrs.field(factory=list)


@attrs.frozen(eq=False)
class DividedSheets:
    """Sheets with their points.

    Attributes
    ----------
    points : list of list of (n, 3), m
        Of each sheet and level; a single point where an arc is none.
    arcs : list of SheetArc
        Those at the ends of sheets that are more than a point.
    pieces : list of ArcPiece
        What they consist of.
    """

    points: list[list[FloatArray]]
    arcs: list[SheetArc]
    pieces: list[ArcPiece]


def divide_sheets(
    every: list[WetSheet], panels: int, length: float, knuckle_deg: float | None = None
) -> DividedSheets:
    """Put points on all arcs.

    Parameters
    ----------
    every : list of WetSheet
        Of all bands and sides.
    panels : int
        How many parts a whole section has.
    length : float, m
        Of the ship.
    knuckle_deg : float or None
        Points are put where an arc turns by more; None for nowhere.
    """
    arcs = _arcs(every, length, knuckle_deg)
    pieces: list[ArcPiece] = []
    parts = _counts(every, arcs, pieces, panels, _NEAR * length)
    points = [
        _points(sheet, parts[i], [arc for arc in arcs if arc.sheet == i], pieces, length,
                knuckle_deg)
        for i, sheet in enumerate(every)
    ]  # fmt: skip
    return DividedSheets(points, arcs, pieces)


def _arcs(every: list[WetSheet], length: float, knuckle_deg: float | None) -> list[SheetArc]:
    """Find where the arcs at the ends of sheets are parted."""
    found, corner = [], []
    for i, sheet in enumerate(every):
        for end in (0, 1):
            chain = (sheet.chains.count - 1) * end
            if sheet.chains.length[chain] > _POINT * length:
                found.append((i, end, chain))
                corner += [place[chain] for place in sheet.chains.ends]
    corners = _gathered(np.array(corner).reshape(-1, 3), _NEAR * length)
    arcs = []
    for number, (i, end, chain) in enumerate(found):
        sheet = every[i]
        own = corners[2 * number : 2 * number + 2]
        one = sheet.chains.take(np.array([chain]))
        cut, places = _corners_on(one, corners, _NEAR * length)
        more = _knuckles(sheet, chain, knuckle_deg)
        cut, places = np.append(cut, more), np.vstack([places, _at(one, more)])
        arcs.append(_parted(one, (i, end, chain), own, cut, places, _NEAR * length))
    return arcs


def _gathered(corners: FloatArray, near: float) -> FloatArray:
    """Put corners that lie near one another where the first of them lies."""
    found = corners.copy()
    for i in range(len(found)):
        close = (np.abs(found[:i] - found[i]) <= near).all(axis=1)
        if close.any():
            found[i] = found[int(close.argmax())]
    return found


def _parted(
    one: CubicChains,
    who: tuple[int, int, int],
    own: FloatArray,
    cut: FloatArray,
    places: FloatArray,
    near: float,
) -> SheetArc:
    """Put cuts in order, between the ends of the arc, each once."""
    whole = float(one.length[0])
    inside = (cut > 2.0 * near) & (cut < whole - 2.0 * near)
    cut, places = cut[inside], places[inside]
    order = np.argsort(cut, kind="stable")
    cut, places = cut[order], places[order]
    new = np.diff(cut, prepend=-np.inf) > 2.0 * near
    cut = np.concatenate([[0.0], cut[new], [whole]])
    places = np.vstack([own[:1], places[new], own[1:]])
    return SheetArc(*who, cut, places, _at(one, 0.5 * (cut[1:] + cut[:-1])))


def _at(one: CubicChains, lengths: FloatArray) -> FloatArray:
    return one.at_lengths(np.zeros(len(lengths), np.int64), lengths)


def _knuckles(sheet: WetSheet, chain: int, knuckle_deg: float | None) -> FloatArray:
    """Give the lengths at which an arc turns sharply."""
    if knuckle_deg is None:
        return np.zeros(0)
    run = slice(int(sheet.chains.start[chain]), int(sheet.chains.start[chain + 1]))
    found: FloatArray = sheet.chains.before[run][sheet.turn[run] > knuckle_deg]
    return found


def _corners_on(
    one: CubicChains, corners: FloatArray, near: float
) -> tuple[FloatArray, FloatArray]:
    """Find the corners that lie on an arc: their lengths along it, and the corners themselves."""
    u = (np.arange(_SAMPLES) + 0.5) / _SAMPLES
    count, many = len(one.cubic), len(corners)
    sample = _place(np.repeat(one.cubic, _SAMPLES, axis=0), np.tile(u, count))
    away = ((sample.reshape(count, _SAMPLES, 1, 3) - corners) ** 2).sum(axis=3)
    # On every cubic the foot lies in the cell whose middle is the nearest, or next to it.
    at = u[away.argmin(axis=1)].ravel()
    cubic, place = np.repeat(one.cubic, many, axis=0), np.tile(corners, (count, 1))
    slopes = differentiate(cubic)
    low, high = np.clip(at - 2.0 * u[0], 0.0, 1.0), np.clip(at + 2.0 * u[0], 0.0, 1.0)
    for _ in range(_STEPS):
        along = _slope(slopes, at)
        size = (along**2).sum(axis=1)
        step = ((_place(cubic, at) - place) * along).sum(axis=1) / np.where(size > 0.0, size, 1.0)
        at = np.clip(at - step, low, high)
    off = np.sqrt(((_place(cubic, at) - place) ** 2).sum(axis=1)).reshape(count, many)
    best = off.argmin(axis=0)
    on = np.flatnonzero(off[best, np.arange(many)] <= near)
    pair = best[on] * many + on
    lengths = one.before[best[on]] + length_until(slopes[pair], at[pair])
    return lengths, corners[on]


def _place(c: FloatArray, u: FloatArray) -> FloatArray:
    at = u[:, None]
    found: FloatArray = ((c[:, 3] * at + c[:, 2]) * at + c[:, 1]) * at + c[:, 0]
    return found


def _slope(slopes: FloatArray, u: FloatArray) -> FloatArray:
    at = u[:, None]
    found: FloatArray = (slopes[:, 2] * at + slopes[:, 1]) * at + slopes[:, 0]
    return found


def _counts(
    every: list[WetSheet], arcs: list[SheetArc], pieces: list[ArcPiece], panels: int, near: float
) -> list[int]:
    """Give the number of parts of each sheet, and of each piece; the longest arcs come first."""
    girth = [float(sheet.chains.length.max(initial=0.0)) for sheet in every]
    most = max(girth, default=0.0)
    parts = [0] * len(every)
    for i in sorted(range(len(every)), key=lambda i: (-girth[i], i)):
        own = [arc for arc in arcs if arc.sheet == i]
        known = [[_known(pieces, arc, j, near) for j in range(len(arc.cut) - 1)] for arc in own]
        whole = [
            sum(pieces[j].parts for j in found if j is not None)
            for found in known
            if None not in found
        ]
        wish = panels if girth[i] >= _MAIN * most else max(2, round(panels * girth[i] / most))
        parts[i] = max(whole) if whole and girth[i] < _MAIN * most else wish
        for arc in own:
            _claim(every[i], pieces, arc, parts[i], near)
    return parts


def _known(pieces: list[ArcPiece], arc: SheetArc, j: int, near: float) -> int | None:
    """Find the piece that a stretch of an arc is."""
    own = np.array([arc.places[j], arc.middles[j], arc.places[j + 1]])
    for i, piece in enumerate(pieces):
        if np.abs(piece.places - own).max() <= 10.0 * near:
            return i
    return None


def _claim(sheet: WetSheet, pieces: list[ArcPiece], arc: SheetArc, total: int, near: float) -> None:
    """Give the stretches of an arc their pieces, new ones with a share of the points."""
    known = [_known(pieces, arc, j, near) for j in range(len(arc.cut) - 1)]
    free = [j for j, each in enumerate(known) if each is None]
    left = total - sum(pieces[each].parts for each in known if each is not None)
    if free:
        # What is not straight in the centre plane would vanish if it were parted once only.
        least = np.where(np.abs(arc.middles[free, 1]) > 10.0 * near, 2, 1)
        share = iter(share_by_length(np.diff(arc.cut)[free], left, least).tolist())
    for j, each in enumerate(known):
        if each is None:
            pieces.append(_piece(sheet, arc, j, next(share)))
            each = len(pieces) - 1
        pieces[each].users.append((arc.sheet, arc.end))
        arc.pieces.append(each)


def _piece(sheet: WetSheet, arc: SheetArc, j: int, parts: int) -> ArcPiece:
    """Make a piece of a stretch of an arc."""
    lengths = np.linspace(arc.cut[j], arc.cut[j + 1], parts + 1)
    points = sheet.chains.at_lengths(np.full(parts + 1, arc.chain), lengths)
    points[[0, -1]] = arc.places[j : j + 2]
    return ArcPiece(np.array([arc.places[j], arc.middles[j], arc.places[j + 1]]), parts, points)


def _points(
    sheet: WetSheet,
    parts: int,
    own: list[SheetArc],
    pieces: list[ArcPiece],
    length: float,
    knuckle_deg: float | None,
) -> list[FloatArray]:
    """Give the points of all levels of a sheet."""
    chains = sheet.chains
    ends = {arc.chain: arc for arc in own}
    cuts: list[FloatArray] = []
    for chain in range(chains.count):
        if chain in ends:
            cuts.append(np.zeros(0))
        elif chains.length[chain] <= _POINT * length:
            cuts.append(np.array([0.5 * chains.length[chain]]))
        else:
            cut = _knuckles(sheet, chain, knuckle_deg)
            cut = np.concatenate([[0.0], cut, [chains.length[chain]]])
            cuts.append(_lengths(cut, share_by_length(np.diff(cut), parts).tolist()))
    number = np.repeat(np.arange(chains.count), [len(each) for each in cuts])
    every = chains.at_lengths(number, np.concatenate(cuts))
    found = np.split(every, np.cumsum([len(each) for each in cuts])[:-1])
    for chain, arc in ends.items():
        run = [pieces[each].points for each in arc.pieces]
        found[chain] = np.concatenate([*(each[:-1] for each in run), run[-1][-1:]])
    return found


def _lengths(cut: FloatArray, parts: list[int]) -> FloatArray:
    """Part each stretch into equal lengths."""
    steps = [
        low + (high - low) * np.arange(count) / count
        for low, high, count in zip(cut[:-1], cut[1:], parts, strict=True)
    ]
    return np.append(np.concatenate(steps), cut[-1])
