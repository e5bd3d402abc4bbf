"""Integrals of one side of a body below planes of one inclination."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.immersion_columns import Waterline, along
from assoc_hull.geometry.immersion_events import Parts, parts_of
from assoc_hull.geometry.immersion_places import states
from assoc_hull.geometry.immersion_roots import Tilted, candidates, cuts, tilt
from assoc_hull.geometry.immersion_strips import Prepared
from assoc_hull.geometry.immersion_tiles import COLUMNS, Tiles, from_curves, subset
from assoc_hull.geometry.tile_sums import is_plain, mix, real, sum_by

__all__ = ["Half", "half"]


@attrs.frozen(eq=False)
class Half:
    """Integrals of one side, and extents of its waterplane.

    Attributes
    ----------
    columns : (13, d)
        The sums, see `immersion_columns`.
    extent : (4, d), m
        Least and greatest x, least and greatest y; infinite where there is no waterplane.
    """

    columns: FloatArray
    extent: FloatArray


def half(prepared: Prepared, levels: FloatArray, trim: FloatArray, heel: FloatArray) -> Half:
    """Integrate the port half below planes of one inclination.

    Parameters
    ----------
    prepared : Prepared
        The body.
    levels : (d,), m
        Heights of the planes, ascending.
    trim, heel : (1,)
        Tangents of the inclination.

    Returns
    -------
    Half
        The integrals.
    """
    tiles = prepared.tiles
    straight = is_plain(trim) and is_plain(heel) and trim[0] == 0.0 == heel[0]
    tilted = prepared.upright if straight else tilt(tiles, trim, heel)
    tile, plane = candidates(tilted, real(levels))
    found = cuts(tilted, tile, levels[plane])
    tile, plane = tile[found.pair], plane[found.pair]
    line = along(tiles, tilted, tile, found)
    curve = tiles.curve[tile]
    columns = sum_by(line.columns * prepared.weight[curve], plane, len(levels))
    columns = _with_whole(columns, prepared.weighted, tilted, real(levels))
    extent = _extents(line, plane, len(levels))
    state = states(tiles, tilted, real(levels)[:, None], plane, curve)
    parts = parts_of(prepared, trim, heel, levels, state)
    return _corrected(prepared, Half(columns, extent), levels, tilted, parts)


def _with_whole(
    columns: FloatArray, weighted: FloatArray, tilted: Tilted, levels: FloatArray
) -> FloatArray:
    """Add the tiles that end below each level."""
    end = tilted.control[3]
    if len(levels) == 1:
        wet = (end <= levels[0]).astype(np.float64)
        whole = mix(wet[None], weighted.T).T
    else:
        each = sum_by(weighted, np.searchsorted(levels, end), len(levels) + 1)
        whole = mix(np.tri(len(levels), len(levels) + 1), each.T).T
    return np.concatenate([columns[:COLUMNS] + whole, columns[COLUMNS:]])


def _extents(line: Waterline, plane: IntArray, count: int) -> FloatArray:
    """Give the extents of the cuts, plane by plane."""
    x, y = line.point[0], line.point[1]
    rows = [-_most(-x, plane, count), _most(x, plane, count)]
    return np.stack([*rows, -_most(-y, plane, count), _most(y, plane, count)])


def _most(values: FloatArray, plane: IntArray, count: int) -> FloatArray:
    """Give the greatest value of each plane, minus infinity where there is none."""
    if is_plain(values):
        most = np.full(count, -np.inf)
        if count == 1:
            most[0] = values.max(initial=-np.inf)
        else:
            np.maximum.at(most, plane, values)
        return most
    order = np.lexsort((real(values), plane))
    last = np.searchsorted(plane[order], np.arange(count), "right") - 1
    known = (last >= 0) & (np.bincount(plane, minlength=count) > 0)
    if not len(order):
        return np.full(count, -np.inf)
    return np.where(known, np.take(values, order[np.maximum(last, 0)]), -np.inf)


def _corrected(
    prepared: Prepared, plain: Half, levels: FloatArray, tilted: Tilted, parts: Parts | None
) -> Half:
    """Put the fine rule in the place of the plain one where something happens."""
    if parts is None:
        return plain
    fine = from_curves(prepared.strips.curves(parts.strip, parts.v))
    level = levels[parts.plane]
    better = _curves(
        fine, tilt(fine, tilted.trim, tilted.heel), level, parts.plane, parts.weight, len(levels)
    )
    coarse = subset(prepared.tiles, parts.replaced)
    known = _curves(
        coarse,
        tilt(coarse, tilted.trim, tilted.heel),
        levels[parts.instead],
        parts.instead,
        parts.share * prepared.weight[parts.replaced],
        len(levels),
    )
    return Half(plain.columns + better.columns - known.columns, _wider(plain.extent, better.extent))


def _wider(one: FloatArray, other: FloatArray) -> FloatArray:
    """Join extents."""
    sign = np.array([[-1.0], [1.0], [-1.0], [1.0]])
    return np.where(real(sign * one) >= real(sign * other), one, other)


def _curves(
    tiles: Tiles, tilted: Tilted, level: FloatArray, plane: IntArray, weight: FloatArray, count: int
) -> Half:
    """Integrate curves of which each has its own level."""
    ground = real(level)[tiles.curve]
    tile = np.flatnonzero((tilted.low <= ground) & (tilted.high > ground))
    found = cuts(tilted, tile, level[tiles.curve[tile]])
    tile = tile[found.pair]
    line = along(tiles, tilted, tile, found)
    curve = tiles.curve[tile]
    columns = sum_by(line.columns * weight[curve], plane[curve], count)
    wet = np.flatnonzero(tilted.control[3] <= ground)
    owner = tiles.curve[wet]
    whole = sum_by(np.take(tiles.whole, wet, axis=1) * weight[owner], plane[owner], count)
    return Half(
        np.concatenate([columns[:COLUMNS] + whole, columns[COLUMNS:]]),
        _extents(line, plane[curve], count),
    )
