"""Where strips lie along the ship, and sections of those that are raked.

A plane across the ship stands at one v of a flat strip. It cuts the curves of a raked strip, at a
stem or where a piece of a section ends, at many places. Such a strip is sampled along v; between
two samples cubics along v have the surface nearly, so that the v at which the surface stands in
the plane is nearly the root of one cubic. A step of Newton's rule on the surface itself leads on,
and a section is lofted from such points.
"""

from __future__ import annotations

from functools import cached_property

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, IsoCurves, Strips, freeze
from assoc_hull.geometry.floating.immersed_strips import PreparedStrips
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.numeric.interpolation import differentiation_matrix
from assoc_hull.geometry.numeric.polynomials import (
    bracketed_roots,
    differentiate,
    hermite,
    horner,
    unit_roots,
)
from assoc_hull.geometry.numeric.quadrature import root_walk

__all__ = [
    "RakedStrip",
    "StripSpans",
    "sample_raked_strip",
    "strip_parameters_at",
    "strip_spans",
]

# --------------------------------------------------------------------------------------
# Raked strips: those whose curves do not lie in planes across the ship.

_CURVES = 65  # at which a strip is taken
_NODES = 9  # on each part of a tile

_ON = 1e-9
"""m: a rail that is so near to a plane lies in it."""

_NEAR = 1e-6
"""m: places along the ship that are nearer to one another are one."""

_SLIVER = 1e-9
"""Parts of a smaller part of a tile are not made."""


@attrs.frozen(eq=False)
class RakedStrip:
    """A strip of t tiles at m places along v.

    Attributes
    ----------
    strips : Strips
        The body.
    strip : int
        Which of its strips.
    v : (m,)
        The places, from 0 to 1.
    point, across : (m, t, 4, 3), m
        Coefficients in u of P and of P_v, as in `IsoCurves`.
    deck : (t,) bool
        The tile is closed deck.
    """

    strips: Strips
    strip: int
    v: FloatArray
    point: FloatArray
    across: FloatArray
    deck: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.v, self.point, self.across, self.deck)

    @property
    def rails(self) -> FloatArray:
        """Coefficients of the curves at v = 0 and 1, (2, t, 4, 3), m."""
        return self.point[[0, -1]]

    @property
    def forward(self) -> bool:
        """The surface runs forward with v everywhere, as far as the middles of the tiles show."""
        half = np.array([1.0, 0.5, 0.25, 0.125])
        middle = self.point[..., 0] @ half
        return bool((np.diff(middle, axis=0) >= -_ON).all())

    def turns(self, plane: FloatingPlanes) -> FloatArray:
        """Give where along the ship sections of the strip change their kind, ascending, m.

        There a rail turns from forward to aft or to standing across, or passes through an upright
        floating plane.
        """
        found = []
        for rail in self.rails:
            x, over = rail[..., 0], rail[..., 2] - plane.tan_trim[0] * rail[..., 0]
            over[:, 0] -= plane.height[0]
            found += [_sign_change_places(x, over), _sign_change_places(x, differentiate(x))]
            rise = x.sum(axis=1) - x[:, 0]
            way = np.where(np.abs(rise) <= _ON, 0.0, np.sign(rise))
            found += [x[1:, 0][way[1:] != way[:-1]], x[[0], 0], x[[-1]].sum(axis=1)]
        every = np.sort(np.concatenate(found))
        return every[np.diff(every, prepend=-np.inf) > _NEAR]

    def section(self, x: float, *, quick: bool = False) -> IsoCurves:
        """Give the section at x inside the strip, piece by piece from keel to deck.

        A quick one is as good as the cubics along v, which is enough for one of many in a sum.

        Its `across` is that of a strip of sections that runs forward by 1 m.
        """
        aft, fore = self.rails[..., 0].copy()
        aft[:, 0] -= x
        fore[:, 0] -= x
        parts = _parts(aft, fore)
        t = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, _NODES))
        walked, _ = root_walk(t, parts.starts, parts.ends)
        u = parts.begin[:, None] + (parts.finish - parts.begin)[:, None] * walked
        place = self._points(np.repeat(parts.tile, _NODES), u.ravel(), x, quick).reshape(
            -1, _NODES, 3
        )
        return _loft_section(place, parts, t, self.deck)

    def _points(self, tile: IntArray, u: FloatArray, x: float, quick: bool) -> FloatArray:
        """Give the points (k, 3) at places up the strip that stand at x."""
        powers = u[:, None] ** np.arange(4)
        over = np.einsum("mkp,kp->mk", self.point[..., 0][:, tile], powers) - x
        last = len(self.v) - 1
        behind = np.where(over < 0.0, np.arange(last + 1)[:, None], -1).max(axis=0)
        low = np.clip(behind, 0, last - 1)
        step = (self.v[low + 1] - self.v[low])[:, None]
        begin, end, leave, arrive = (
            np.einsum("kpc,kp->kc", given[row, tile], powers)
            for given in (self.point, self.across)
            for row in (low, low + 1)
        )
        cubic = np.stack(hermite(begin, end, leave * step, arrive * step))
        s = _unit_root(cubic[:, :, 0] - np.array([[x], [0], [0], [0]]))[:, None]
        if not quick:
            return self._refined(tile, u, self.v[low] + (s * step)[:, 0], step[:, 0], x)
        found: FloatArray = ((cubic[3] * s + cubic[2]) * s + cubic[1]) * s + cubic[0]
        found[:, 0] = x
        return found

    def _refined(
        self, tile: IntArray, u: FloatArray, v: FloatArray, most: FloatArray, x: float
    ) -> FloatArray:
        """Give the points (k, 3) a step of Newton's rule from v, no longer than `most`."""
        curves = self.strips.curves(np.full(len(v), self.strip), v)
        row = curves.start[:-1] + tile
        point, across = (
            horner(each[row], u[:, None])[:, 0] for each in (curves.point, curves.across)
        )
        rising = across[:, 0] > 0.0
        step = (x - point[:, 0]) / np.where(rising, across[:, 0], np.inf)
        step = np.clip(v + np.clip(step, -most, most), 0.0, 1.0) - v
        found: FloatArray = point + step[:, None] * across
        found[:, 0] = x
        return found


@attrs.frozen(eq=False)
class _Parts:
    """Parts of tiles over which a section runs, (p,) each.

    Attributes
    ----------
    tile : int
    begin, finish : from 0 to 1, along the tile
    starts, ends : bool
        There the section leaves the strip over a rail, maybe as a root of the distance from it.
    """

    tile: IntArray
    begin: FloatArray
    finish: FloatArray
    starts: NDArray[np.bool_]
    ends: NDArray[np.bool_]


def sample_raked_strip(strips: Strips, strip: int) -> RakedStrip:
    """Sample one of the strips at `_CURVES` places along it."""
    v = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, _CURVES))
    curves = strips.curves(np.full(_CURVES, strip), v)
    tiles = int(curves.start[1])
    point, across = (
        each.reshape(_CURVES, tiles, 4, 3).copy() for each in (curves.point, curves.across)
    )
    return RakedStrip(strips, strip, v, point, across, curves.deck[:tiles].copy())


def _sign_change_places(x: FloatArray, over: FloatArray) -> FloatArray:
    """Give x where polynomials in u, one for each tile, change their sign inside the tile."""
    u = unit_roots(over)
    # `unit_roots` gives places without a change of sign, too: values beside each show which.
    beside = np.stack([u - 1e-6, u + 1e-6])
    low, high = (horner(over, each) for each in beside)
    inner = (u > 0.0) & (u < 1.0) & (low * high < 0.0) & (np.abs(high - low) > 1e-12)
    found: FloatArray = horner(x, u)[inner]
    return found


def _unit_root(cubic: FloatArray) -> FloatArray:
    """Give the roots of rising cubics (4, k) between 0 and 1; the nearer end where none is."""
    count = cubic.shape[1]
    low, high = cubic[0], cubic.sum(axis=0)
    through = np.flatnonzero((low < 0.0) & (high > 0.0))
    found = np.where(low >= 0.0, 0.0, np.ones(count))
    zero = np.zeros(len(through))
    found[through] = bracketed_roots(
        cubic[:, through], zero, zero + 1.0, low[through], high[through]
    )
    return found


def _parts(aft: FloatArray, fore: FloatArray) -> _Parts:
    """Find where a plane stands between two rails, given how far these are before it, (t, 4)."""
    count = len(aft)
    end = [np.zeros((count, 1)), unit_roots(aft), unit_roots(fore), np.ones((count, 1))]
    edge = np.sort(np.concatenate(end, axis=1), axis=1)
    tile, part = np.nonzero(np.diff(edge, axis=1) > _SLIVER)
    begin, finish = edge[tile, part], edge[tile, part + 1]
    three = np.stack([begin, 0.5 * (begin + finish), finish], axis=1)
    behind, before = horner(aft[tile], three), horner(fore[tile], three)
    inside = (behind[:, 1] <= _ON) & (before[:, 1] >= -_ON)
    inside &= before[:, 1] - behind[:, 1] > _ON
    leaves = np.minimum(np.abs(behind), np.abs(before)) <= _ON
    rows = np.flatnonzero(inside)
    return _Parts(tile[rows], begin[rows], finish[rows], leaves[rows, 0], leaves[rows, 2])


def _loft_section(
    place: FloatArray, parts: _Parts, t: FloatArray, deck: NDArray[np.bool_]
) -> IsoCurves:
    """Lay cubics between places (p, n, 3) at t, with the slopes of the polynomial through all."""
    slope = np.einsum("ij,pjk->pik", differentiation_matrix(t), place)
    step = np.diff(t)[None, :, None]
    cubic = hermite(place[:, :-1], place[:, 1:], slope[:, :-1] * step, slope[:, 1:] * step)
    point = np.stack(cubic, axis=2).reshape(-1, 4, 3)
    point[:, 1:, 0] = 0.0  # a section stands at one x, to the last bit
    up = parts.tile + parts.begin
    new = np.ones(len(up), np.bool_)
    new[1:] = np.abs(up[1:] - (parts.tile + parts.finish)[:-1]) > _SLIVER
    start = np.append(np.flatnonzero(new), len(up)) * (len(t) - 1)
    covered = np.repeat(deck[parts.tile], len(t) - 1)
    across = np.zeros_like(point)
    across[:, 0, 0] = 1.0
    return IsoCurves(start, point, across, covered)


# --------------------------------------------------------------------------------------
# Where along the ship strips lie, and at which v a plane across the ship cuts them.

_FLAT = 1e-9
"""m: curves that leave their planes by less lie in them."""

_CLOSE = 1e-12
"""Of how far a strip lies from AP: rounding."""

_TRIALS = 60

_BEZIER = np.array([[1.0, 0, 0, 0], [1.0, 1 / 3, 0, 0], [1.0, 2 / 3, 1 / 3, 0], [1.0, 1, 1, 1]])


@attrs.frozen(eq=False)
class StripSpans:
    """How far the strips of a body reach along the ship, (n,) each.

    Attributes
    ----------
    prepared : PreparedStrips
        The body.
    aft, fore : m
        Least and greatest x.
    flat : bool
        All curves v = const lie in planes across the ship.
    """

    prepared: PreparedStrips
    aft: FloatArray
    fore: FloatArray
    flat: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.aft, self.fore, self.flat)

    @cached_property
    def near(self) -> FloatArray:
        """So near to one another places on a strip cannot be distinguished, (n,), m."""
        found: FloatArray = _CLOSE * np.maximum(np.abs(self.aft), np.abs(self.fore))
        return found

    @cached_property
    def raked(self) -> dict[int, RakedStrip]:
        """The strips that are not flat and lie between two places."""
        rest = np.flatnonzero(~self.flat & (self.fore > self.aft + _FLAT))
        return {strip: sample_raked_strip(self.prepared.strips, strip) for strip in rest.tolist()}


def strip_spans(prepared: PreparedStrips) -> StripSpans:
    """Give how far strips reach, by the curves on which they are integrated."""
    tiles, count = prepared.tiles, prepared.strips.count
    strip = prepared.strip[tiles.curve]
    control = _BEZIER @ tiles.coefficients[0]
    aft, fore = np.full(count, np.inf), np.full(count, -np.inf)
    np.minimum.at(aft, strip, control.min(axis=0))
    np.maximum.at(fore, strip, control.max(axis=0))
    begin = tiles.coefficients[0, 0, tiles.start[tiles.curve]]
    lean = np.abs(tiles.coefficients[::3, 1:]).max(axis=(0, 1)) > _FLAT
    lean |= np.abs(tiles.coefficients[0, 0] - begin) > _FLAT
    return StripSpans(prepared, aft, fore, np.bincount(strip, lean, count) == 0.0)


def strip_parameters_at(body: StripSpans, strip: IntArray, x: FloatArray | float) -> FloatArray:
    """Give the v at which flat strips (k,) stand at x (m) in them, (k,) or one for all."""
    strips, begin, end = body.prepared.strips, body.aft[strip], body.fore[strip]
    low, high = np.zeros(len(strip)), np.ones(len(strip))
    v = np.clip((x - begin) / (end - begin), 0.0, 1.0)
    for _ in range(_TRIALS):
        curves = strips.curves(strip, v)
        first = curves.start[:-1]
        over = curves.point[first, 0, 0] - x
        if (np.abs(over) <= body.near[strip]).all():
            break
        low, high = np.where(over < 0.0, v, low), np.where(over > 0.0, v, high)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = v - over / curves.across[first, 0, 0]
        v = np.where((step >= low) & (step <= high), step, 0.5 * (low + high))
    return v
