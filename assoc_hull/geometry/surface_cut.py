"""A strip of a surface cut by a plane across the ship, where its own curves lie in none."""

from __future__ import annotations

import itertools

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.isocurves import IsoCurves, Strips
from assoc_hull.geometry.polynomials import horner
from assoc_hull.geometry.roots import unit_roots

__all__ = ["cut_across"]

_NODES = 13
"""Places on each part of a tile that is cut."""

_TRIALS = 60
"""Halvings of a bracket, at the utmost."""

_NEAR = 1e-12
"""Of x (m), when a place is found."""


def cut_across(strips: Strips, strip: int, x: float) -> list[FloatArray]:
    """Cut a strip by the plane of all places at x.

    Parameters
    ----------
    strips : Strips
        The surface; along each of its lines u = const x only grows, or only falls.
    strip : int
        Which of them.
    x : float, m
        Where the plane stands.

    Returns
    -------
    list of (s, 4, 3), m
        The pieces of the section as cubics from 0 to 1, from keel to deck, decks left out; none
        where the plane misses the strip.
    """
    both = strips.curves(np.array([strip, strip]), np.array([0.0, 1.0]))
    count = int(both.start[1])
    rails = both.point[:count], both.point[count:]
    runs: list[list[tuple[int, float, float]]] = [[]]
    for tile in np.flatnonzero(~both.deck[:count]).tolist():
        for low, high in _spans(rails[0][tile, :, 0] - _at(x), rails[1][tile, :, 0] - _at(x)):
            last = runs[-1][-1] if runs[-1] else None
            if last is not None and not (last[0] == tile - 1 and last[2] == 1.0 and low == 0.0):
                runs.append([])
            runs[-1].append((tile, low, high))
    return [_cubics(strips, strip, x, run) for run in runs if run]


def _at(x: float) -> FloatArray:
    return np.array([x, 0.0, 0.0, 0.0])


def _spans(aft: FloatArray, fore: FloatArray) -> list[tuple[float, float]]:
    """Give the parts of a tile along which the plane lies between both rails."""
    roots = unit_roots(np.stack([aft, fore]))
    edge = np.unique(np.concatenate([[0.0, 1.0], roots.ravel()])).tolist()
    found: list[tuple[float, float]] = []
    for low, high in itertools.pairwise(edge):
        middle = np.full((2, 1), 0.5 * (low + high))
        a, f = horner(np.stack([aft, fore]), middle)[:, 0].tolist()
        if a * f > 0.0 or high - low < 1e-12:
            continue
        if found and found[-1][1] == low:
            found[-1] = (found[-1][0], high)
        else:
            found.append((low, high))
    return found


def _cubics(
    strips: Strips, strip: int, x: float, run: list[tuple[int, float, float]]
) -> FloatArray:
    """Trace the plane along a run of parts of tiles."""
    t, slope = _chebyshev(_NODES)
    # With the nodes bunched at both ends a section that ends round is smooth in t.
    bunch = np.sin(0.5 * np.pi * t) ** 2
    tile = np.repeat(np.array([each[0] for each in run]), _NODES)
    low, high = (np.array([each[i] for each in run]) for i in (1, 2))
    u = (low[:, None] + (high - low)[:, None] * bunch).ravel()
    place = _solved(strips, strip, tile, u, x).reshape(len(run), _NODES, 3).copy()
    place[:, :, 0] = x
    along = np.einsum("ij,rjk->rik", slope, place)
    step = np.diff(t)[:, None]
    begin, end = place[:, :-1], place[:, 1:]
    leave, arrive = along[:, :-1] * step, along[:, 1:] * step
    rise = end - begin
    cubic = np.stack([begin, leave, 3.0 * rise - 2.0 * leave - arrive, leave + arrive - 2.0 * rise])
    return np.moveaxis(cubic, 0, 2).reshape(-1, 4, 3)


def _solved(strips: Strips, strip: int, tile: IntArray, u: FloatArray, x: float) -> FloatArray:
    """Find the places (k, 3) at which lines u = const of tiles reach x."""
    rising = _on(strips, strip, tile, u, np.ones(len(u)))[0][:, 0] >= x
    low, high = np.zeros(len(u)), np.ones(len(u))
    v = 0.5 * np.ones(len(u))
    for _ in range(_TRIALS):
        place, rate = _on(strips, strip, tile, u, v)
        off = place[:, 0] - x
        if float(np.abs(off).max()) <= _NEAR:
            break
        beyond = (off > 0.0) == rising
        low, high = np.where(beyond, low, v), np.where(beyond, v, high)
        with np.errstate(divide="ignore", invalid="ignore"):
            newton = v - off / rate[:, 0]
        inside = (newton > low) & (newton < high)
        v = np.where(inside, newton, 0.5 * (low + high))
    return _on(strips, strip, tile, u, v)[0]


def _on(
    strips: Strips, strip: int, tile: IntArray, u: FloatArray, v: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give P and P_v of places of a strip, (k, 3) each."""
    curves: IsoCurves = strips.curves(np.full(len(v), strip), v)
    row = curves.start[:-1] + tile
    at = u[:, None]
    return horner(curves.point[row], at)[:, 0], horner(curves.across[row], at)[:, 0]


def _chebyshev(count: int) -> tuple[FloatArray, FloatArray]:
    """Give places on [0, 1], and the matrix that differentiates a polynomial through them."""
    angle = np.linspace(0.0, np.pi, count)
    t = 0.5 * (1.0 - np.cos(angle))
    weight = np.ones(count)
    weight[[0, -1]] = 2.0
    weight *= (-1.0) ** np.arange(count)
    away = t[:, None] - t + np.eye(count)
    table = weight[:, None] / weight / away
    table -= np.diag(table.sum(axis=1))
    return t, table
