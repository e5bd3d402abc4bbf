"""Girth over the patches of a hull: how far a place lies from the lowest point of its section.

Each block runs along the ship with u, and round its girth with v. A section x = constant is looked
up on lines v = constant, thirty times as many as there are patches, and its chords are added from
below upward; a block that lies above another at this section, as the stem above a bulb, counts on
from it. What is found at sections `STEP` apart is interpolated, and written as a bicubic polynomial
on each patch: continuous, and good to about a centimetre.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.patches import Patches
>>> from assoc_hull.surface.plates.girth import girth_of
>>> x, z = np.mgrid[0:30:4j, 0:3:4j]
>>> side = Patches.single(np.stack([x, 5.0 + 0.0 * x, z], axis=-1))
>>> girth_of(side).b[0, 0].round(9).tolist()
[0.0, 1.0, 2.0, 3.0]
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.tensor_bernstein import basis
from assoc_hull.geometry.patches.patches import Patches
from assoc_hull.geometry.patches.running_bounds import EPS, Running

__all__ = ["STEP", "girth_of"]

STEP = 1.0 / 1500.0
"""Of the length: how far sections lie apart."""

_FINE = 12
"""Steps on a patch, along u and v; a multiple of 3."""

_SAME = 1e-6
"""m: a plane so near the end of a line goes through it."""

_ABOVE = 0.05
"""m: so far two pieces of a section may overlap in height, and still lie above one another."""


@attrs.frozen(eq=False)
class _Block:
    """Sections of a block: on (s,) planes, at (j,) lines v = constant from below upward.

    `up` tells whether v rises from below; `length` is counted from the lower end, (s, j), m.
    """

    grid: FloatArray
    up: bool
    length: FloatArray
    there: NDArray[np.bool_]
    low: FloatArray
    high: FloatArray


def girth_of(patches: Patches) -> Running:
    """Give the girth as polynomials over patches.

    Parameters
    ----------
    patches : Patches
        Those of all blocks of a half hull, each block in rows of equal u, u along the ship.

    Returns
    -------
    Running
        (k, 4, 4) coefficients, m.
    """
    x = patches.net[..., 0]
    planes = np.linspace(x.min(), x.max(), round(1.0 / STEP) + 1)
    numbers = range(int(patches.surface.max()) + 1)
    rows = [np.flatnonzero(patches.surface == number) for number in numbers]
    blocks = [_block(_grid(patches[each]), planes) for each in rows]
    found = np.empty((len(patches), 4, 4))
    solved = np.linalg.inv(basis(3, np.arange(4) / 3.0))
    for number, each in enumerate(rows):
        values = _values(blocks[number], planes, _below(blocks, number))
        found[each] = solved @ values @ solved.T
    return Running(found, 4.0 * EPS * (np.abs(found) + 1.0))


def _grid(patches: Patches) -> FloatArray:
    """Give the places of one surface at even steps of each patch, (m, n, 3)."""
    nv = len(np.unique(patches.box[:, 1, 0]))
    p, q = patches.degrees
    at = np.arange(_FINE + 1) / _FINE
    along, across = basis(p, at), basis(q, at)
    fine = np.einsum("ai,kijc,bj->kabc", along, patches.net, across)
    cells = fine.reshape(-1, nv, _FINE + 1, _FINE + 1, 3)
    whole = cells[:, :, :-1, :-1].transpose(0, 2, 1, 3, 4)
    nu = len(cells)
    found = np.empty((nu * _FINE + 1, nv * _FINE + 1, 3))
    found[:-1, :-1] = whole.reshape(nu * _FINE, nv * _FINE, 3)
    found[-1, :-1] = cells[-1, :, -1, :-1].reshape(-1, 3)
    found[:-1, -1] = cells[:, -1, :-1, -1].reshape(-1, 3)
    found[-1, -1] = cells[-1, -1, -1, -1]
    return found


def _block(grid: FloatArray, planes: FloatArray) -> _Block:
    """Cut a block by planes."""
    if grid[0, :, 0].mean() > grid[-1, :, 0].mean():
        grid = grid[::-1]
    up = bool(grid[:, 0, 2].mean() < grid[:, -1, 2].mean())
    rising = grid if up else grid[:, ::-1]
    x = np.maximum.accumulate(rising[..., 0], axis=0)
    place = np.empty((len(planes), x.shape[1], 3))
    for j in range(x.shape[1]):
        for axis in range(3):
            place[:, j, axis] = np.interp(planes, x[:, j], rising[:, j, axis])
    there = (planes[:, None] >= x[0] - _SAME) & (planes[:, None] <= x[-1] + _SAME)
    length = _lengths(place, there, rising, planes)
    z = np.where(there, place[..., 2], np.nan)
    some = there.any(axis=1)
    low, high = np.full((2, len(planes)), np.nan)
    low[some], high[some] = np.nanmin(z[some], axis=1), np.nanmax(z[some], axis=1)
    return _Block(grid, up, length, there, low, high)


def _lengths(
    place: FloatArray, there: NDArray[np.bool_], grid: FloatArray, planes: FloatArray
) -> FloatArray:
    """Add chords from the lower end; where lines do not reach a plane it ends at the border."""
    steps = np.linalg.norm(np.diff(place, axis=1), axis=2)
    steps[~(there[:, 1:] & there[:, :-1])] = 0.0
    first = there.argmax(axis=1)
    for row in np.flatnonzero(there.any(axis=1) & (first > 0)).tolist():
        j = int(first[row])
        end = -1 if planes[row] > grid[-1, j - 1, 0] else 0
        below, above = grid[end, j - 1], grid[end, j]
        t = (planes[row] - below[0]) / (above[0] - below[0]) if above[0] != below[0] else 1.0
        border = below + min(max(t, 0.0), 1.0) * (above - below)
        steps[row, j - 1] = np.linalg.norm(place[row, j] - border)
    return np.concatenate([np.zeros((len(place), 1)), np.cumsum(steps, axis=1)], axis=1)


def _below(blocks: list[_Block], number: int) -> FloatArray:
    """Give the lengths of all pieces that lie below a block, at each plane, (s,), m."""
    own, found = blocks[number], np.zeros(len(blocks[number].low))
    for other, block in enumerate(blocks):
        if other != number:
            under = block.high <= own.low + _ABOVE
            found += np.where(under, block.length[:, -1], 0.0)
    return found


def _values(block: _Block, planes: FloatArray, below: FloatArray) -> FloatArray:
    """Give the girth at 4 by 4 places of each patch of a block, (k, 4, 4), m."""
    table = block.length + below[:, None]
    if not block.up:
        table = table[:, ::-1]
    third = _FINE // 3
    x = block.grid[::third, ::third, 0]
    there = block.there if block.up else block.there[:, ::-1]
    values = np.stack(
        [
            _interpolated(x[:, j], planes, table[:, j * third], there[:, j * third])
            for j in range(x.shape[1])
        ],
        axis=1,
    )
    nu, nv = (len(values) - 1) // 3, (values.shape[1] - 1) // 3
    i, j = 3 * np.arange(nu)[:, None] + np.arange(4), 3 * np.arange(nv)[:, None] + np.arange(4)
    cut = values[i[:, None, :, None], j[None, :, None, :]]
    return np.asarray(cut.reshape(nu * nv, 4, 4))


def _interpolated(
    x: FloatArray, planes: FloatArray, table: FloatArray, there: NDArray[np.bool_]
) -> FloatArray:
    """Interpolate along a line, and go on straight to its ends from the last planes through it."""
    at, value = planes[there], table[there]
    if len(at) < 2:
        return np.full(len(x), value[0] if len(at) else 0.0)
    found = np.interp(x, at, value)
    for end, beyond in ((0, x < at[0]), (-2, x > at[-1])):
        slope = (value[end + 1] - value[end]) / (at[end + 1] - at[end])
        found = np.where(beyond, value[end] + slope * (x - at[end]), found)
    return np.maximum(found, 0.0)
