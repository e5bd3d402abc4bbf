"""Where the spans of a block meet: between stations, along the girth, and as its masters have them.

Along a border a block takes the breaks of its master, so that both have the same border to the bit.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fitting.breaks import subdivided
from assoc_hull.surface.blocks.block import Block, Stretch

__all__ = ["Breaks", "breaks_of", "ends_on", "master_part"]

Breaks = tuple[FloatArray, FloatArray]

_EACH_BAY = 2
"""Spans between two stations, or other places worth a knot, along the ship."""

_LONGEST = 0.05
"""The longest span along the ship, as a part of its length."""

_NEAR = 0.2
"""Places so near to a neighbour, as a part of the spans that are wanted, are not worth a knot."""

_FEWEST = 20
"""Spans along a side that has no stations, at least."""

_END_SPAN = 0.6
"""How much shorter spans of bow and stern are."""

_CLEAR = 0.4
"""Breaks nearer than this part of a span give way."""

_FINER = np.array([0.25, 0.5])
"""Breaks beside the place where a side leaves the centre plane, as parts of the span there.
Shorter ones hold no points of their own: beside a singular corner of the DTC they folded."""

_GRID = 2.0**-15
"""Breaks are rounded to about this part of the length of the ship."""

_SAME = 1e-9
_ALONG = {"u0": 1, "u1": 1, "v0": 0, "v1": 0}
"""The parameter that runs along each side: 0 for u, 1 for v."""


def breaks_of(
    block: Block,
    girth_span: float,
    length: float,
    known: Mapping[str, Breaks],
    ends: tuple[FloatArray, FloatArray],
) -> Breaks:
    """Give where spans of a block meet, over all of its reach.

    Parameters
    ----------
    block : Block
        The block.
    girth_span : float, m
        How long spans along the girth are.
    length : float, m
        Of the ship.
    known : mapping of str to (breaks in u, breaks in v)
        Those of its masters.
    ends : (n,), (n,), m
        Where borders of other blocks end on its sides, in u and in v.
    """
    (u0, u1), (v0, v1) = block.reach.tolist()
    if block.kind == "body":
        inner = block.stations[(block.stations > u0) & (block.stations < u1)]
        places = np.unique(np.concatenate([[u0], inner, block.extent[0], [u1]]))
        along = _along_ship(places, length, girth_span)
    else:
        along = _evenly(u0, u1, _END_SPAN * girth_span)
        girth_span *= _END_SPAN
    own = along, _evenly(v0, v1, girth_span)
    grid = 2.0 ** round(math.log2(_GRID * length))
    first, second = (
        _leaving_centre(block, axis, _with_places(_on_grid(own[axis], grid), ends[axis]))
        for axis in (0, 1)
    )
    return _with_masters(block, 0, first, known), _with_masters(block, 1, second, known)


def ends_on(block: Block, others: Iterable[Block]) -> tuple[FloatArray, FloatArray]:
    """Give where borders of other blocks end within the sides of a block, in u and in v, m."""
    found: tuple[set[float], set[float]] = set(), set()
    for other in others:
        for stretches in other.sides.values():
            for each in stretches:
                if each.master == block.name:
                    found[_ALONG[each.master_side]].update((each.master_low, each.master_high))
    inner = [
        sorted(at for at in places if low + _SAME < at < high - _SAME)
        for places, (low, high) in zip(found, block.extent.tolist(), strict=True)
    ]
    return np.array(inner[0]), np.array(inner[1])


def _on_grid(places: FloatArray, grid: float) -> FloatArray:
    """Round places within to a grid: small changes of lengths shall not move all knots."""
    found = np.round(places[1:-1] / grid) * grid
    return np.concatenate([places[:1], found, places[-1:]])


def _with_places(places: FloatArray, wanted: FloatArray) -> FloatArray:
    """Put breaks in at wanted places; others near there give way."""
    for place in wanted.tolist():
        span = float(np.diff(places)[np.clip(np.searchsorted(places, place) - 1, 0, None)])
        kept = places[1:-1][np.abs(places[1:-1] - place) > _CLEAR * span]
        places = np.unique(np.concatenate([places[:1], kept, [place], places[-1:]]))
    return places


def _leaving_centre(block: Block, axis: int, places: FloatArray) -> FloatArray:
    """Put finer spans where a side leaves the centre plane: it stays in it smoothly, and turns."""
    for side, stretches in block.sides.items():
        if _ALONG[side] != axis:
            continue
        low, high = block.extent[axis].tolist()
        for each in stretches:
            if not each.centre:
                continue
            for end, way in ((each.low, -1.0), (each.high, 1.0)):
                if low + _SAME < end < high - _SAME:
                    near = int(np.searchsorted(places, end - _SAME))
                    span = float(np.diff(places)[near if way > 0.0 else near - 1])
                    places = _merged(np.concatenate([places, end + way * span * _FINER]))
    return places


def _along_ship(places: FloatArray, length: float, least: float) -> FloatArray:
    """Part the bays between stations."""
    kept = _thinned(places, _NEAR * least)
    parts = np.maximum(np.ceil(np.diff(kept) / (_LONGEST * length)).astype(np.int64), _EACH_BAY)
    short = np.diff(kept) < least
    return subdivided(kept, np.where(short, 1, parts))


def _evenly(low: float, high: float, span: float) -> FloatArray:
    """Part a side evenly."""
    return np.linspace(low, high, max(round((high - low) / span), _FEWEST) + 1)


def _thinned(places: FloatArray, least: float) -> FloatArray:
    """Leave out places within that are too near to the one before, or to the end."""
    kept = [float(places[0])]
    for place in places[1:-1].tolist():
        if place - kept[-1] > least and places[-1] - place > least:
            kept.append(place)
    return np.array([*kept, float(places[-1])])


def master_part(breaks: FloatArray, stretch: Stretch) -> FloatArray:
    """Give the breaks of a master between the ends of a stretch, in parameters of the slave.

    Parameters
    ----------
    breaks : (b,), m
        Of the master, along its side.
    stretch : Stretch
        What of the side of the slave lies there.
    """
    low, high = stretch.master_low, stretch.master_high
    inner = breaks[(breaks > low + _SAME) & (breaks < high - _SAME)]
    ratio = (stretch.high - stretch.low) / (high - low)
    moved = stretch.low + (inner - low) * ratio
    return np.concatenate([[stretch.low], moved, [stretch.high]])


def _with_masters(
    block: Block, axis: int, own: FloatArray, known: Mapping[str, Breaks]
) -> FloatArray:
    """Let breaks of masters take the place of the block's own where the block meets these."""
    forced = []
    for side, stretches in block.sides.items():
        if _ALONG[side] != axis:
            continue
        for stretch in stretches:
            if stretch.master:
                breaks = known[stretch.master][_ALONG[stretch.master_side]]
                forced.append(master_part(breaks, stretch))
    for each in forced:
        inside = (own > each[0] - _SAME) & (own < each[-1] + _SAME)
        keep = own[~inside] if each is forced[0] else own
        own = _merged(np.concatenate([keep, each]))
    return own


def _merged(places: FloatArray) -> FloatArray:
    """Sort places, each once."""
    found = np.sort(places)
    return np.asarray(found[np.concatenate([[True], np.diff(found) > _SAME])])
