"""Integrals of one side of a body below planes of one inclination."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.immersion_columns import Cross, Half, add_solid, cross
from assoc_hull.geometry.floating.immersion_events import Parts, parts_of
from assoc_hull.geometry.floating.immersion_extents import wider, widest
from assoc_hull.geometry.floating.immersion_roots import Tilted, candidates, tilt
from assoc_hull.geometry.floating.immersion_states import batches, states
from assoc_hull.geometry.floating.immersion_tips import tips
from assoc_hull.geometry.floating.prepared_strips import Prepared
from assoc_hull.geometry.floating.tiles import HEELED, PLAIN, Tiles, expand, integrals
from assoc_hull.geometry.numeric.dual import is_plain, real
from assoc_hull.geometry.numeric.generic_sums import mix, sum_by

__all__ = ["Half", "curve_by_curve", "half"]


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
    ground = real(levels)
    tile, plane = candidates(tilted, ground)
    weight = np.take(prepared.weight, tiles.curve[tile])
    cut = cross(tiles, tilted, (tile, plane), levels, weight)
    plain = add_solid(cut.half, _whole(prepared.weighted(tilted.heeled), tilted, ground))
    plain = _as_wide(plain, widest(tiles, tilted, cut.places, prepared.v, prepared.strip))
    parts = parts_of(prepared, tilted, levels, _table(prepared, tilted, ground, cut))
    if parts is not None:
        plain = _corrected(prepared, plain, levels, tilted, parts)
    return Half(_in_plane(plain.columns, heel), plain.extent) if tilted.heeled else plain


def _table(prepared: Prepared, tilted: Tilted, levels: FloatArray, cut: Cross) -> IntArray:
    """Tell the states of all curves for each plane, (d, k)."""
    tiles, planes = prepared.tiles, len(levels)
    key = cut.plane * tiles.curves + tiles.curve[cut.tile]
    times = np.bincount(key, minlength=planes * tiles.curves).reshape(planes, -1)
    return states(tiles, tilted, np.arange(tiles.curves)[None], levels[:, None], times)


def curve_by_curve(
    tiles: Tiles, level: FloatArray, trim: FloatArray, heel: FloatArray
) -> FloatArray:
    """Integrate the port half of each curve by itself, as if it were a strip of weight 1.

    Parameters
    ----------
    tiles : Tiles
        k curves.
    level : (k,), m
        Height of the plane below which each is looked at.
    trim, heel : (1,)
        Tangents of the inclination.

    Returns
    -------
    (13, k)
        The columns.
    """
    tilted = tilt(tiles, trim, heel)
    each = np.arange(tiles.curves)
    columns = _pairs(tiles, tilted, level, (each, each), np.ones(tiles.curves)).columns
    return _in_plane(columns, heel) if tilted.heeled else columns


def _in_plane(columns: FloatArray, heel: FloatArray) -> FloatArray:
    """Turn the flux along y into one along (0, 1, -heel), which does not cross the plane.

    The fluxes whose divergences are 1, x, y and z are y, x y, y^2/2 and y z + heel y^2/2.
    """
    volume, x, y, z = columns[:4]
    volume_z, x_z, y_z, z_z = columns[PLAIN:HEELED]
    bent = [volume - heel * volume_z, x - heel * x_z, y - heel * y_z]
    bent.append(z + heel * (y - z_z) - heel * heel * y_z)
    return np.concatenate([np.stack(bent), columns[4:PLAIN], columns[HEELED:]])


def _as_wide(half: Half, breadth: FloatArray) -> Half:
    """Take account of breadths between curves."""
    extent = half.extent
    return Half(half.columns, wider(extent, np.stack([*extent[:3], breadth])))


def _whole(weighted: FloatArray, tilted: Tilted, levels: FloatArray) -> FloatArray:
    """Add up the tiles that end below each level."""
    end = tilted.control[3]
    if len(levels) == 1:
        wet = (end <= levels[0]).astype(np.float64)
        return mix(wet[None], weighted.T).T
    each = sum_by(weighted, np.searchsorted(levels, end), len(levels) + 1)
    return mix(np.tri(len(levels), len(levels) + 1), each.T).T


def _corrected(
    prepared: Prepared, plain: Half, levels: FloatArray, tilted: Tilted, parts: Parts
) -> Half:
    """Put the fine rule in the place of the plain one where something happens."""
    weight = parts.share * np.take(prepared.weight, parts.replaced)
    known = _pairs(prepared.tiles, tilted, levels, (parts.replaced, parts.instead), weight)
    columns = plain.columns - known.columns
    extent = wider(plain.extent, tips(prepared.strips, tilted, levels, parts.places))
    for rows, curve, tiles in batches(prepared.strips, parts.strip, parts.v):
        seen = tilt(tiles, tilted.trim, tilted.heel)
        pairs, weight = (curve, parts.plane[rows]), np.take(parts.weight, rows)
        fine = _pairs(tiles, seen, levels, pairs, weight)
        columns, extent = columns + fine.columns, wider(extent, fine.extent)
    return Half(columns, extent)


def _pairs(
    tiles: Tiles,
    tilted: Tilted,
    levels: FloatArray,
    pairs: tuple[IntArray, IntArray],
    weight: FloatArray,
) -> Half:
    """Integrate pairs of a curve and a plane, of which each has its own weight."""
    curve, plane = pairs
    tile, row = expand(tiles, curve)
    whose = plane[row]
    ground = real(levels)[whose]
    hit = np.flatnonzero((tilted.low[tile] <= ground) & (tilted.high[tile] > ground))
    cut = cross(tiles, tilted, (tile[hit], whose[hit]), levels, np.take(weight, row[hit]))
    wet = np.flatnonzero(tilted.control[3][tile] <= ground)
    some, which = np.unique(tile[wet], return_inverse=True)
    whole = integrals(
        np.take(tiles.coefficients, some, axis=2),
        tiles.deck[some],
        tiles.lean[some],
        tilted.heeled,
    )
    shares = np.take(whole, which, axis=1) * np.take(weight, row[wet])
    return add_solid(cut.half, sum_by(shares, whose[wet], len(levels)))
