"""Tiles of curves across a hull, and what each contributes to volumes and areas.

A tile is a cubic P(u) with a cubic P_v(u), u from 0 to 1. With the normal ``N = P_u x P_v``
it contributes to a volume ``int y N_y du``: the divergence theorem with the flux along y,
which the centre plane does not see. Six Gauss points integrate every such product of cubics
without error (degree 11), and also the part of a tile from 0 to a root. Areas are not
polynomial: the same six points are accurate for them, as tiles are short.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.isocurves import IsoCurves
from assoc_hull.geometry.quadrature import gauss
from assoc_hull.geometry.tile_sums import mix

__all__ = ["COLUMNS", "Tiles", "from_curves", "integrals", "powers", "subset"]

COLUMNS = 7
"""Columns of `integrals`: y N_y, x y N_y, y^2/2 N_y, y z N_y, |N|, girth, |N| on deck."""

_POINTS = 6  # exact to degree 11
_SMOOTH = 0.05  # rad: below this angle two tiles meet without a knuckle


@attrs.frozen(eq=False)
class Tiles:
    """Tiles of k curves, tile by tile from keel to deck, curve by curve.

    Attributes
    ----------
    coefficients : (6, 4, s), m
        Of x, y, z, x_v, y_v, z_v in 1, u, u^2, u^3.
    whole : (7, s)
        The tiles' integrals (`COLUMNS`), per unit of v.
    curve : (s,) int
        The curve of each tile.
    start : (k + 1,) int
        Where the tiles of each curve begin.
    deck : (s,) bool
        The tile is closed deck.
    knuckle : (n,) int
        Tiles that begin at a knuckle.
    """

    coefficients: FloatArray
    whole: FloatArray
    curve: IntArray
    start: IntArray
    deck: NDArray[np.bool_]
    knuckle: IntArray

    @property
    def curves(self) -> int:
        """Number of curves."""
        return len(self.start) - 1


_NODES, _WEIGHTS = gauss(_POINTS)
_VALUE = _NODES[:, None] ** np.arange(4)
_SLOPE = np.arange(4) * _NODES[:, None] ** np.maximum(np.arange(4) - 1, 0)
_BOTH = np.concatenate([_VALUE, _SLOPE])


def powers(u: FloatArray) -> FloatArray:
    """Give 1, u, u^2, u^3 as rows, (4, k)."""
    square = u * u
    return np.stack([1.0 + 0.0 * u, u, square, square * u])


def from_curves(curves: IsoCurves) -> Tiles:
    """Take over curves and integrate their tiles.

    Parameters
    ----------
    curves : IsoCurves
        The curves.

    Returns
    -------
    Tiles
        The same tiles with their integrals.
    """
    point, across = curves.point.transpose(2, 1, 0), curves.across.transpose(2, 1, 0)
    coefficients = np.concatenate([point, across])
    sizes = np.diff(curves.start)
    owner = np.repeat(np.arange(curves.count), sizes)
    return Tiles(
        coefficients,
        integrals(coefficients, curves.deck),
        owner,
        curves.start,
        curves.deck,
        _knuckles(coefficients, owner),
    )


def subset(tiles: Tiles, curve: IntArray) -> Tiles:
    """Take some curves, possibly repeatedly.

    Parameters
    ----------
    tiles : Tiles
        Where from.
    curve : (n,) int
        Which curves.

    Returns
    -------
    Tiles
        Their tiles, in that order.
    """
    sizes = np.diff(tiles.start)[curve]
    start = np.concatenate([[0], np.cumsum(sizes)])
    owner = np.repeat(np.arange(len(curve)), sizes)
    rows = np.arange(start[-1]) + (tiles.start[curve] - start[:-1])[owner]
    sharp = np.zeros(len(tiles.curve), bool)
    sharp[tiles.knuckle] = True
    return Tiles(
        np.take(tiles.coefficients, rows, axis=2),
        np.take(tiles.whole, rows, axis=1),
        owner,
        start,
        tiles.deck[rows],
        np.flatnonzero(sharp[rows]),
    )


def integrals(coefficients: FloatArray, deck: NDArray[np.bool_]) -> FloatArray:
    """Integrate over tiles, or over parts of them that are given as tiles.

    Parameters
    ----------
    coefficients : (6, 4, k), m
        As in `Tiles`.
    deck : (k,) bool
        The tile is deck.

    Returns
    -------
    (7, k)
        The columns `COLUMNS`, per unit of v.
    """
    both, across = mix(_BOTH, coefficients[:3]), mix(_VALUE, coefficients[3:])
    x, y, z = both[0, :_POINTS], both[1, :_POINTS], both[2, :_POINTS]
    x_u, y_u, z_u = both[0, _POINTS:], both[1, _POINTS:], both[2, _POINTS:]
    x_v, y_v, z_v = across[0], across[1], across[2]
    n_x, n_y, n_z = y_u * z_v - z_u * y_v, z_u * x_v - x_u * z_v, x_u * y_v - y_u * x_v
    flux = y * n_y
    round_about = n_y * n_y + n_z * n_z
    size = np.sqrt(n_x * n_x + round_about)
    values = np.stack([flux, x * flux, 0.5 * y * flux, z * flux, size, np.sqrt(round_about)])
    sums = mix(_WEIGHTS[None], values)[:, 0]
    return np.concatenate([sums, (sums[4] * deck)[None]])


def _knuckles(coefficients: FloatArray, curve: IntArray) -> IntArray:
    """Find the tiles that begin at a knuckle: places where the direction jumps."""
    point = coefficients[:3].real
    before, after = point[:, 1] + 2.0 * point[:, 2] + 3.0 * point[:, 3], point[:, 1]
    before, after = before[:, :-1], after[:, 1:]
    along = (before * after).sum(axis=0)
    lengths = (before * before).sum(axis=0) * (after * after).sum(axis=0)
    bent = along < np.cos(_SMOOTH) * np.sqrt(lengths)
    return np.flatnonzero(bent & (curve[1:] == curve[:-1])) + 1
