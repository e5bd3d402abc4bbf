"""What lies below floating planes: any strips of curves, integrated.

`FloatingPlanes` cut a body, `ImmersedIntegrals` are what it has below them; plain integrals, no
ship's words yet. `prepare_strips` integrates every tile once, `integrate_immersed` integrates only
tiles that a plane crosses, up to the cut, exactly. Both sides are integrals over the port half:
starboard's are those of the plane heeled the other way. Axes: x forward, y to port, z up; m.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.floating.immersion import FloatingPlanes, integrate_immersed
>>> from assoc_hull.geometry.floating.immersed_strips import prepare_strips
>>> from assoc_hull.geometry.curves import IsoCurves
>>> class Wedge:  # 8 m long, 3 m deep, 2 m wide at either side
...     count, order = 1, np.array([2])
...
...     def curves(self, strip, v):
...         point, across = np.zeros((2, len(v), 4, 3))
...         point[:, 0, 0], point[:, 1], across[:, 0, 0] = 8.0 * v, [0.0, 2.0, 3.0], 8.0
...         return IsoCurves(np.arange(len(v) + 1), point, across, np.zeros(len(v), bool))
>>> below = integrate_immersed(
...     prepare_strips(Wedge()), FloatingPlanes(np.array([1.5, 2.25]), np.zeros(2), np.zeros(2))
... )
>>> below.volume.round(12).tolist(), below.area.round(12).tolist()
([12.0, 27.0], [16.0, 24.0])
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.floating.immersed_strips import PreparedStrips, curve_batches, curve_states
from assoc_hull.geometry.floating.strip_events import RefinedCurves, refine_strips, waterplane_tips
from assoc_hull.geometry.floating.tiles import (
    HEELED,
    PLAIN,
    CurveTiles,
    TiltedTiles,
    candidate_pairs,
    integrate_tiles,
    tile_rows,
    tilt_tiles,
)
from assoc_hull.geometry.floating.waterplane_cuts import (
    CutIntegrals,
    HalfIntegrals,
    add_whole_tiles,
    greatest_breadths,
    integrate_cuts,
    join_extents,
)
from assoc_hull.geometry.numeric.dual import combine_rows, is_plain, real, sum_columns_by

__all__ = [
    "FloatingPlanes",
    "ImmersedIntegrals",
    "in_plane",
    "integrate_curves",
    "integrate_half",
    "integrate_immersed",
    "join_sides",
]


@attrs.frozen(eq=False)
class FloatingPlanes:
    """Floating planes ``z = height + tan_trim x - tan_heel y``.

    Attributes
    ----------
    height : (d,), m
        Height of the plane at x = 0, y = 0: the draught at AP.
    tan_trim : (d,)
        Rise of the plane per metre forward, (T_F - T_A) / Lpp.
    tan_heel : (d,)
        Tangent of the heel, + starboard down.
    """

    height: FloatArray
    tan_trim: FloatArray
    tan_heel: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.height, self.tan_trim, self.tan_heel)


@attrs.frozen(eq=False)
class ImmersedIntegrals:
    """Integrals of both sides of a body below each of d planes, all (d,).

    Attributes
    ----------
    volume : m3
        Below the plane.
    moment_x, moment_y, moment_z : m4
        Integrals of x, y, z over that volume.
    area : m2
        Of the waterplane, projected on z = 0 ("in plan").
    area_x, area_y : m3
        Integrals of x and y over the waterplane in plan.
    area_xx, area_xy, area_yy : m4
        Integrals of x x, x y and y y over the waterplane in plan.
    shell : m2
        True area of the shell below the plane: neither faces, nor a closed deck, nor the plane.
    girth : m2
        Integral of the girth over the length, ``sqrt(n_y^2 + n_z^2) dS`` over the same surface.
    wet_deck : m2
        True area of the closed deck below the plane.
    x_least, x_most, y_least, y_most : m
        Extent of the waterplane; nan where there is none.
    """

    volume: FloatArray
    moment_x: FloatArray
    moment_y: FloatArray
    moment_z: FloatArray
    area: FloatArray
    area_x: FloatArray
    area_y: FloatArray
    area_xx: FloatArray
    area_xy: FloatArray
    area_yy: FloatArray
    shell: FloatArray
    girth: FloatArray
    wet_deck: FloatArray
    x_least: FloatArray
    x_most: FloatArray
    y_least: FloatArray
    y_most: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(*attrs.astuple(self, recurse=False))


# --------------------------------------------------------------------------------------
# Integrals of one side of a body below planes of one inclination.


def integrate_half(
    prepared: PreparedStrips, levels: FloatArray, trim: FloatArray, heel: FloatArray
) -> HalfIntegrals:
    """Integrate the port half below planes of one inclination; levels (d,), m, ascend.

    Volume and moments are fluxes through the shell alone, along a direction in the plane.
    """
    tiles = prepared.tiles
    straight = is_plain(trim) and is_plain(heel) and trim[0] == 0.0 == heel[0]
    tilted = prepared.upright if straight else tilt_tiles(tiles, trim, heel)
    ground = real(levels)
    tile, plane = candidate_pairs(tilted, ground)
    weight = np.take(prepared.weight, tiles.curve[tile])
    cut = integrate_cuts(tiles, tilted, (tile, plane), levels, weight)
    plain = add_whole_tiles(
        cut.half, _sum_whole_tiles(prepared.weighted(tilted.heeled), tilted, ground)
    )
    plain = _widen_extent(
        plain, greatest_breadths(tiles, tilted, cut.places, prepared.v, prepared.strip)
    )
    parts = refine_strips(prepared, tilted, levels, _state_table(prepared, tilted, ground, cut))
    if parts is not None:
        plain = _refine(prepared, plain, levels, tilted, parts)
    return HalfIntegrals(in_plane(plain.columns, heel), plain.extent) if tilted.heeled else plain


def _state_table(
    prepared: PreparedStrips, tilted: TiltedTiles, levels: FloatArray, cut: CutIntegrals
) -> IntArray:
    """Give the states of all curves for each plane, (d, k)."""
    tiles, planes = prepared.tiles, len(levels)
    key = cut.plane * tiles.curves + tiles.curve[cut.tile]
    times = np.bincount(key, minlength=planes * tiles.curves).reshape(planes, -1)
    return curve_states(tiles, tilted, np.arange(tiles.curves)[None], levels[:, None], times)


def integrate_curves(
    tiles: CurveTiles, level: FloatArray, trim: FloatArray, heel: FloatArray
) -> FloatArray:
    """Integrate the port half of each of k curves by itself, as if it were a strip of weight 1.

    Levels are (k,), m, one for each curve; the result is (13, k), see `HalfIntegrals.columns`.
    """
    tilted = tilt_tiles(tiles, trim, heel)
    each = np.arange(tiles.curves)
    columns = _integrate_pairs(tiles, tilted, level, (each, each), np.ones(tiles.curves)).columns
    return in_plane(columns, heel) if tilted.heeled else columns


def in_plane(columns: FloatArray, heel: FloatArray) -> FloatArray:
    """Turn the flux along y into one along (0, 1, -heel), which does not cross the plane.

    The fluxes whose divergences are 1, x, y and z are y, x y, y^2/2 and y z + heel y^2/2.
    """
    volume, x, y, z = columns[:4]
    volume_z, x_z, y_z, z_z = columns[PLAIN:HEELED]
    bent = [volume - heel * volume_z, x - heel * x_z, y - heel * y_z]
    bent.append(z + heel * (y - z_z) - heel * heel * y_z)
    return np.concatenate([np.stack(bent), columns[4:PLAIN], columns[HEELED:]])


def _widen_extent(half: HalfIntegrals, breadth: FloatArray) -> HalfIntegrals:
    """Widen the extent by the greatest breadths between curves."""
    extent = half.extent
    return HalfIntegrals(half.columns, join_extents(extent, np.stack([*extent[:3], breadth])))


def _sum_whole_tiles(weighted: FloatArray, tilted: TiltedTiles, levels: FloatArray) -> FloatArray:
    """Add up the tiles that end below each level."""
    end = tilted.control[3]
    if len(levels) == 1:
        wet = (end <= levels[0]).astype(np.float64)
        return combine_rows(wet[None], weighted.T).T
    each = sum_columns_by(weighted, np.searchsorted(levels, end), len(levels) + 1)
    return combine_rows(np.tri(len(levels), len(levels) + 1), each.T).T


def _refine(
    prepared: PreparedStrips,
    plain: HalfIntegrals,
    levels: FloatArray,
    tilted: TiltedTiles,
    parts: RefinedCurves,
) -> HalfIntegrals:
    """Put the fine rule in the place of the plain one where something happens."""
    weight = parts.share * np.take(prepared.weight, parts.replaced)
    known = _integrate_pairs(
        prepared.tiles, tilted, levels, (parts.replaced, parts.instead), weight
    )
    columns = plain.columns - known.columns
    extent = join_extents(
        plain.extent, waterplane_tips(prepared.strips, tilted, levels, parts.places)
    )
    for rows, curve, tiles in curve_batches(prepared.strips, parts.strip, parts.v):
        seen = tilt_tiles(tiles, tilted.trim, tilted.heel)
        pairs, weight = (curve, parts.plane[rows]), np.take(parts.weight, rows)
        fine = _integrate_pairs(tiles, seen, levels, pairs, weight)
        columns, extent = columns + fine.columns, join_extents(extent, fine.extent)
    return HalfIntegrals(columns, extent)


def _integrate_pairs(
    tiles: CurveTiles,
    tilted: TiltedTiles,
    levels: FloatArray,
    pairs: tuple[IntArray, IntArray],
    weight: FloatArray,
) -> HalfIntegrals:
    """Integrate pairs of a curve and a plane, of which each has its own weight."""
    curve, plane = pairs
    tile, row = tile_rows(tiles, curve)
    whose = plane[row]
    ground = real(levels)[whose]
    hit = np.flatnonzero((tilted.low[tile] <= ground) & (tilted.high[tile] > ground))
    cut = integrate_cuts(tiles, tilted, (tile[hit], whose[hit]), levels, np.take(weight, row[hit]))
    wet = np.flatnonzero(tilted.control[3][tile] <= ground)
    some, which = np.unique(tile[wet], return_inverse=True)
    whole = integrate_tiles(
        np.take(tiles.coefficients, some, axis=2),
        tiles.deck[some],
        tiles.lean[some],
        tilted.heeled,
    )
    shares = np.take(whole, which, axis=1) * np.take(weight, row[wet])
    return add_whole_tiles(cut.half, sum_columns_by(shares, whose[wet], len(levels)))


# --------------------------------------------------------------------------------------
# Both sides, below planes of any inclination.

_MOST = 256  # planes at a time, which bounds the memory
_ODD = frozenset({"moment_y", "area_y", "area_xy"})


def integrate_immersed(prepared: PreparedStrips, planes: FloatingPlanes) -> ImmersedIntegrals:
    """Integrate both sides of a body below d floating planes; the integrals are (d,) each.

    Points on a plane are below it: at the very height of a flat bottom or a flat deck all
    values are those just above. Every integral changes continuously with the plane.

    The numbers may be complex or carry tangents; decisions are taken on their real values.

    Extents are those of the cuts of all curves, of the ends of strips, and of the places where
    pieces appear, which are exact. Between curves only the greatest half breadth is looked
    for: its error goes with the fourth power of the distance of the curves.

    A body must be closed: an end that lies off the centre plane has to lie in a plane
    x = const, or under heel it lacks the flux and the waterline there.
    """
    height, trim, heel = planes.height, planes.tan_trim, planes.tan_heel
    parts, places = [], []
    for rows in _groups(planes):
        for begin in range(0, len(rows), _MOST):
            some = rows[begin : begin + _MOST]
            parts.append(_both_sides(prepared, height[some], trim[some[:1]], heel[some[:1]]))
            places.append(some)
    return _joined(parts, places)


def _groups(planes: FloatingPlanes) -> list[IntArray]:
    """Part planes by inclination, each group by ascending height."""
    trim, heel = planes.tan_trim, planes.tan_heel
    if len(trim) == 1 or not (is_plain(trim) and is_plain(heel)):
        # The derivatives that inclinations carry along may be different ones.
        return [np.array([row]) for row in range(len(trim))]
    order = np.lexsort((real(planes.height), heel, trim))
    new = (np.diff(trim[order]) != 0.0) | (np.diff(heel[order]) != 0.0)
    return np.split(order, np.flatnonzero(new) + 1)


def _joined(parts: list[dict[str, FloatArray]], places: list[IntArray]) -> ImmersedIntegrals:
    """Put the planes back into their order."""
    if len(parts) == 1 and len(places[0]) == 1:
        return ImmersedIntegrals(**parts[0])
    if not parts:
        return ImmersedIntegrals(*np.zeros((len(attrs.fields(ImmersedIntegrals)), 0)))
    order = np.argsort(np.concatenate(places))
    return ImmersedIntegrals(
        **{name: np.concatenate([part[name] for part in parts])[order] for name in parts[0]}
    )


def _both_sides(
    prepared: PreparedStrips, height: FloatArray, trim: FloatArray, heel: FloatArray
) -> dict[str, FloatArray]:
    """Integrate below planes of one inclination, by ascending height."""
    port = integrate_half(prepared, height, trim, heel)
    upright = is_plain(heel) and heel[0] == 0.0
    starboard = port if upright else integrate_half(prepared, height, trim, -heel)
    return join_sides(port, starboard)


def join_sides(port: HalfIntegrals, starboard: HalfIntegrals) -> dict[str, FloatArray]:
    """Give the fields of `ImmersedIntegrals`; starboard is integrated as a port half."""
    return _sums(port.columns, starboard.columns) | _extents(port, starboard)


def _sums(port: FloatArray, starboard: FloatArray) -> dict[str, FloatArray]:
    """Add both sides; what is odd in y changes its sign to starboard."""
    names = ("volume", "moment_x", "moment_y", "moment_z", "shell", "girth", "wet_deck")
    plane = ("area", "area_x", "area_y", "area_xx", "area_xy", "area_yy")
    both, odd = port + starboard, port - starboard
    rows = zip((*names, *plane), both, odd, strict=True)
    return {name: difference if name in _ODD else total for name, total, difference in rows}


def _extents(port: HalfIntegrals, starboard: HalfIntegrals) -> dict[str, FloatArray]:
    """Give the extents of the waterplane of both sides."""
    # Starboard was integrated as a port half: its y change sign, and its least is the greatest.
    one, other = port.extent, starboard.extent
    none = ~np.isfinite(real(one[1])) & ~np.isfinite(real(other[1]))
    rows = {
        "x_least": -_larger(-one[0], -other[0]),
        "x_most": _larger(one[1], other[1]),
        "y_least": -_larger(-one[2], other[3]),
        "y_most": _larger(one[3], -other[2]),
    }
    return {name: np.where(none, np.nan, row) for name, row in rows.items()}


def _larger(one: FloatArray, other: FloatArray) -> FloatArray:
    return np.where(real(one) >= real(other), one, other)
