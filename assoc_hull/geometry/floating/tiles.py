"""Tiles of curves across a hull, and what each contributes to volumes and areas.

A tile is a cubic P(u) with a cubic P_v(u), u from 0 to 1. With the normal ``N = P_u x P_v``
it contributes to a volume ``int y N_y du``: the divergence theorem with the flux along y,
which neither the centre plane nor a plane without heel sees. Below a plane with heel the flux
runs along the direction (0, 1, -tan_heel) in that plane, which takes integrals with N_z, too:
``int y (N_y - tan_heel N_z) du``. So no integral over the waterplane enters a volume, and the
derivative of a volume by the plane's height is the waterplane's area curve by curve.

Six Gauss points integrate every such product of cubics without error (degree 11), and also
the part of a tile from 0 to a cut. Areas are not polynomial: the same six points are accurate
for them, as tiles are short.

Most curves are sections: x and x_v are the same all along. Then N_y is x_v z_u, and half of
the work can be left out.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, IsoCurves
from assoc_hull.geometry.numeric.dual import real
from assoc_hull.geometry.numeric.generic_sums import combine_rows, differs_from_zero, safe_sqrt
from assoc_hull.geometry.numeric.quadrature import gauss

__all__ = [
    "CHUNK",
    "HEELED",
    "PLAIN",
    "CurveTiles",
    "cubic_powers",
    "integrate_tiles",
    "tile_rows",
    "tiles_of_curves",
    "tiles_subset",
]

CHUNK = 2048
"""Tiles or cuts at a time, so that the work on them stays in the processor's cache."""

PLAIN, HEELED = 7, 11
"""Rows of `integrate_tiles`: y N_y, x y N_y, y^2/2 N_y, y z N_y; |N| and girth but on deck, |N| on
deck; with heel the first four once more, with N_z."""

_POINTS = 6  # exact to degree 11

_NODES, _WEIGHTS = gauss(_POINTS)
_VALUE = _NODES[:, None] ** np.arange(4)
_SLOPE = np.arange(4) * _NODES[:, None] ** np.maximum(np.arange(4) - 1, 0)
_BOTH = np.concatenate([_VALUE, _SLOPE])


@attrs.frozen(eq=False)
class CurveTiles:
    """Tiles of k curves, tile by tile from keel to deck, curve by curve.

    Attributes
    ----------
    coefficients : (6, 4, s), m
        Of x, y, z, x_v, y_v, z_v in 1, u, u^2, u^3.
    curve : (s,) int
        The curve of each tile.
    start : (k + 1,) int
        Where the tiles of each curve begin.
    deck : (s,) bool
        The tile is closed deck.
    lean : (s,) bool
        x or x_v are not the same all along the tile.
    edge : (k,) int
        The tile with which the closed deck of each curve begins; -1 where there is none.
    """

    coefficients: FloatArray
    curve: IntArray
    start: IntArray
    deck: NDArray[np.bool_]
    lean: NDArray[np.bool_]
    edge: IntArray

    @property
    def curves(self) -> int:
        """Number of curves."""
        return len(self.start) - 1


def cubic_powers(u: FloatArray) -> FloatArray:
    """Give 1, u, u^2, u^3 as rows, (4, k)."""
    square = u * u
    return np.stack([1.0 + 0.0 * u, u, square, square * u])


def tiles_of_curves(curves: IsoCurves) -> CurveTiles:
    """Lay out the tiles of curves for work on many at once."""
    # Row by row in memory: all that follows runs along rows.
    both = (curves.point, curves.across)
    rows = [each[:, power, axis] for each in both for axis in range(3) for power in range(4)]
    coefficients = np.stack(rows).reshape(6, 4, -1)
    owner = np.repeat(np.arange(curves.count), np.diff(curves.start))
    lean = np.asarray(differs_from_zero(coefficients[0::3, 1:]).any(axis=(0, 1)))
    edge = _edges(curves.deck, owner, curves.count)
    return CurveTiles(coefficients, owner, curves.start, curves.deck, lean, edge)


def tile_rows(tiles: CurveTiles, curve: IntArray) -> tuple[IntArray, IntArray]:
    """List the tiles of curves (n,), which may be repeated, and to which of the n each belongs."""
    sizes = tiles.start[curve + 1] - tiles.start[curve]
    begin = np.cumsum(sizes) - sizes
    row = np.repeat(np.arange(len(curve)), sizes)
    return np.arange(len(row)) + (tiles.start[curve] - begin)[row], row


def tiles_subset(tiles: CurveTiles, curve: IntArray) -> CurveTiles:
    """Give the tiles of curves (n,), in that order."""
    rows, owner = tile_rows(tiles, curve)
    start = np.searchsorted(owner, np.arange(len(curve) + 1))
    deck = tiles.deck[rows]
    return CurveTiles(
        np.take(tiles.coefficients, rows, axis=2),
        owner,
        start,
        deck,
        tiles.lean[rows],
        _edges(deck, owner, len(curve)),
    )


def integrate_tiles(
    coefficients: FloatArray, deck: NDArray[np.bool_], lean: NDArray[np.bool_], heeled: bool
) -> FloatArray:
    """Integrate over tiles, (6, 4, k), or over parts of them that are given as tiles.

    The result is (7, k), or (11, k) if integrals with N_z are wanted (`heeled`): the rows `PLAIN`
    or `HEELED`, per unit of v.
    """
    if len(deck) > CHUNK:
        parts = [slice(i, i + CHUNK) for i in range(0, len(deck), CHUNK)]
        done = [
            integrate_tiles(coefficients[..., some], deck[some], lean[some], heeled)
            for some in parts
        ]
        return np.concatenate(done, axis=1)
    sums = (_general if lean.any() else _sections)(coefficients, heeled)
    # A deck bounds the volume, and is no shell.
    size, girth = sums[4:6]
    return np.stack([*sums[:4], size * ~deck, girth * ~deck, size * deck, *sums[6:]])


def _sections(coefficients: FloatArray, heeled: bool) -> list[FloatArray]:
    """Integrate over tiles of constant x and x_v."""
    (y, z), (y_u, z_u) = _values_slopes(coefficients[1:3])
    y_v, z_v = combine_rows(_VALUE, coefficients[4:])
    x, x_v = coefficients[0, 0], coefficients[3, 0]
    flux, stretch = y * z_u, y_u * y_u + z_u * z_u
    n_x = y_u * z_v - z_u * y_v
    volume = x_v * combine_rows(_WEIGHTS, flux)
    sums = [
        volume,
        x * volume,
        0.5 * x_v * combine_rows(_WEIGHTS, y * flux),
        x_v * combine_rows(_WEIGHTS, z * flux),
        combine_rows(_WEIGHTS, safe_sqrt(n_x * n_x + (x_v * x_v) * stretch)),
        np.where(real(x_v) < 0.0, -x_v, x_v) * combine_rows(_WEIGHTS, safe_sqrt(stretch)),
    ]
    if heeled:
        rise = y * y_u
        volume = -x_v * combine_rows(_WEIGHTS, rise)
        sums += [volume, x * volume, -0.5 * x_v * combine_rows(_WEIGHTS, y * rise)]
        sums.append(-x_v * combine_rows(_WEIGHTS, z * rise))
    return sums


def _general(coefficients: FloatArray, heeled: bool) -> list[FloatArray]:
    """Integrate over any tiles."""
    (x, y, z), (x_u, y_u, z_u) = _values_slopes(coefficients[:3])
    x_v, y_v, z_v = combine_rows(_VALUE, coefficients[3:])
    n_x, n_y, n_z = y_u * z_v - z_u * y_v, z_u * x_v - x_u * z_v, x_u * y_v - y_u * x_v
    flux, round_about = y * n_y, n_y * n_y + n_z * n_z
    size = safe_sqrt(n_x * n_x + round_about)
    values = [flux, x * flux, 0.5 * y * flux, z * flux, size, safe_sqrt(round_about)]
    if heeled:
        flux = y * n_z
        values += [flux, x * flux, 0.5 * y * flux, z * flux]
    return [combine_rows(_WEIGHTS, each) for each in values]


def _values_slopes(point: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give values and slopes at the Gauss points, (c, 6, k) each, of cubics (c, 4, k)."""
    both = combine_rows(_BOTH, point)
    return both[:, :_POINTS], both[:, _POINTS:]


def _edges(deck: NDArray[np.bool_], curve: IntArray, count: int) -> IntArray:
    """Find the tiles with which decks begin."""
    tile = np.flatnonzero(deck[1:] & ~deck[:-1] & (curve[1:] == curve[:-1])) + 1
    edge = np.full(count, -1)
    edge[curve[tile]] = tile
    return edge
