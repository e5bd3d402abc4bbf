"""The surface of a hull made ready to be cut into plates: patches, places, curvature.

x, z and girth are polynomials over each patch, so a seam is the zero set of a polynomial.
Girth is measured from the lowest point of a section upward, and interpolated between sections.
Patches beside a border of blocks are marked: curvature there is that of the joint.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.quadrature import lobatto
from assoc_hull.geometry.numeric.tensor_bernstein import bernstein_basis
from assoc_hull.geometry.patches.bernstein_polynomials import EPS, BoundedPolynomial
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.plating.curvature_nodes import CurvatureNodes, curvature_nodes
from assoc_hull.surface.regions.surface_batches import batches_of

__all__ = [
    "NODES",
    "STEP",
    "HullShell",
    "girth_of",
    "margin_patches",
]


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


def girth_of(patches: Patches) -> BoundedPolynomial:
    """Give the girth as polynomials over patches: the way from the lowest point of the section.

    A section x = constant is looked up on lines v = constant, thirty times as many as there are
    patches, and its chords are added from below upward; a block that lies above another at this
    section, as the stem above a bulb, counts on from it. What is found at sections `STEP` apart is
    interpolated, and written as a bicubic polynomial on each patch: continuous, and good to about a
    centimetre.

    Parameters
    ----------
    patches : Patches
        Those of all blocks of a half hull, each block in rows of equal u, u along the ship.

    Returns
    -------
    BoundedPolynomial
        (k, 4, 4) coefficients, m.
    """
    x = patches.net[..., 0]
    planes = np.linspace(x.min(), x.max(), round(1.0 / STEP) + 1)
    numbers = range(int(patches.surface.max()) + 1)
    rows = [np.flatnonzero(patches.surface == number) for number in numbers]
    blocks = [_block(_grid(patches[each]), planes) for each in rows]
    found = np.empty((len(patches), 4, 4))
    solved = np.linalg.inv(bernstein_basis(3, np.arange(4) / 3.0))
    for number, each in enumerate(rows):
        values = _values(blocks[number], planes, _below(blocks, number))
        found[each] = solved @ values @ solved.T
    return BoundedPolynomial(found, 4.0 * EPS * (np.abs(found) + 1.0))


def _grid(patches: Patches) -> FloatArray:
    """Give the places of one surface at even steps of each patch, (m, n, 3)."""
    nv = len(np.unique(patches.box[:, 1, 0]))
    p, q = patches.degrees
    at = np.arange(_FINE + 1) / _FINE
    along, across = bernstein_basis(p, at), bernstein_basis(q, at)
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
    # np.interp wants x that does not fall; that of a fitted block may, by a little.
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


# --------------------------------------------------------------------------------------
# Margins.

_TOUCH = 0.01
"""m: sides that come so near one another are a common border; chords of them stray by less."""

_LOOKS = 9
"""Places on a side."""

_AT_ONCE = 1 << 21
"""Distances at a time."""


def margin_patches(
    patches: Patches, singular: Sequence[Sequence[tuple[float, float]]]
) -> NDArray[np.bool_]:
    """Tell which patches (k,) lie beside a border of two surfaces, or at a tangent corner.

    `singular` are parameters of tangent corners, surface by surface; empty for none. Across a
    border two fits were joined: normals agree there, curvature need not. So what lies within one
    span of it tells nothing about the hull.
    """
    found = np.zeros(len(patches), np.bool_)
    for number, corners in enumerate(singular):
        for corner in corners:
            inside = (patches.box[..., 0] <= corner) & (corner <= patches.box[..., 1])
            found |= inside.all(axis=1) & (patches.surface == number)
    row, points = _outer_sides(patches)
    for number in np.unique(patches.surface).tolist():
        own = patches.surface[row] == number
        if own.all():
            continue
        near = _near(points[own], points[~own])
        found[row[own][near]] = True
    return found


def _outer_sides(patches: Patches) -> tuple[IntArray, FloatArray]:
    """Give sides of patches on the borders of their surfaces: patch, and places (s, looks, 3)."""
    count = int(patches.surface.max()) + 1
    low, high = np.full((count, 2), np.inf), np.full((count, 2), -np.inf)
    np.minimum.at(low, patches.surface, patches.box[..., 0])
    np.maximum.at(high, patches.surface, patches.box[..., 1])
    net, rows, sides = patches.net, [], []
    polygons = ((net[:, 0], net[:, -1]), (net[:, :, 0], net[:, :, -1]))
    for axis, (first, last) in enumerate(polygons):
        along = bernstein_basis(first.shape[1] - 1, np.linspace(0.0, 1.0, _LOOKS))
        at_low = patches.box[:, axis, 0] == low[patches.surface, axis]
        at_high = patches.box[:, axis, 1] == high[patches.surface, axis]
        for chosen, polygon in ((at_low, first), (at_high, last)):
            rows.append(np.flatnonzero(chosen))
            sides.append(along @ polygon[chosen])
    return np.concatenate(rows), np.concatenate(sides)


def _near(sides: FloatArray, others: FloatArray) -> NDArray[np.bool_]:
    """Tell of which sides (s, looks, 3) two places or more lie on other sides (t, looks, 3)."""
    start, step = others[:, :-1].reshape(-1, 3), np.diff(others, axis=1).reshape(-1, 3)
    length = np.maximum((step * step).sum(axis=1), 1e-30)
    points = sides.reshape(-1, 3)
    touch = np.zeros(len(points), np.bool_)
    size = max(1, _AT_ONCE // len(start))
    for first in range(0, len(points), size):
        off = points[first : first + size, None] - start
        t = np.clip((off * step).sum(axis=2) / length, 0.0, 1.0)
        far = ((off - t[..., None] * step) ** 2).sum(axis=2)
        touch[first : first + size] = far.min(axis=1) <= _TOUCH**2
    return np.asarray(touch.reshape(sides.shape[:2]).sum(axis=1) >= 2)


# --------------------------------------------------------------------------------------
# The shell.

NODES = 7
"""Nodes each way on a patch: a plate of 10 by 2.5 m has some hundreds of them."""


@attrs.frozen(eq=False, slots=False)
class HullShell:
    """A surface of k Bezier patches.

    Attributes
    ----------
    surfaces : tuple of SplineSurface
        The surfaces of its blocks.
    patches : Patches
        Their patches; `Patches.surface` numbers the blocks.
    nodes : CurvatureNodes
        Curvature at `NODES` by `NODES` places of each.
    margin : (k,) bool
        Patches whose curvature is not settled: beside a border of blocks, or at a corner where
        the sides of a block are tangent.
    places : mapping of str to BoundedPolynomial
        x, z and, where it is asked for, girth, as polynomials over each patch, m.
    """

    surfaces: tuple[SplineSurface, ...]
    patches: Patches
    nodes: CurvatureNodes
    margin: NDArray[np.bool_]
    places: Mapping[str, BoundedPolynomial]

    def __attrs_post_init__(self) -> None:
        freeze(self.margin)

    @cached_property
    def extremes(self) -> dict[str, tuple[FloatArray, FloatArray]]:
        """The least and greatest coefficient of each patch, (k,) and (k,) m, by axis."""
        return {
            axis: (place.b.min(axis=(1, 2)), place.b.max(axis=(1, 2)))
            for axis, place in self.places.items()
        }

    @classmethod
    def of(
        cls,
        surfaces: Sequence[SplineSurface],
        singular: Sequence[Sequence[tuple[float, float]]] = (),
        girth: bool = False,
    ) -> Self:
        """Make the surfaces of the blocks of a half hull ready; with girth if it is wanted.

        `singular` as of `margin_patches`. Raises BadInputError for rational surfaces, or several
        bidegrees.
        """
        batches = batches_of(surfaces)
        if len(batches) != 1 or batches[0].patches.weight is not None:
            what = "the surfaces are rational, or of several bidegrees"
            remedy = "give surfaces of one bidegree, without weights"
            raise BadInputError(what, "in plates of a hull", remedy)
        patches = batches[0].patches
        places = {axis: _exact(patches.net[..., i]) for axis, i in (("x", 0), ("z", 2))}
        if girth:
            places["girth"] = girth_of(patches)
        found = curvature_nodes(patches, NODES)
        return cls(tuple(surfaces), patches, found, margin_patches(patches, singular), places)

    def at(self, axis: str, rows: IntArray, count: int = NODES) -> FloatArray:
        """Give x, z or girth at `count` by `count` nodes of some patches, (p, q, q), m."""
        b, (at, _) = self.places[axis].b[rows], lobatto(count)
        return np.asarray(
            bernstein_basis(b.shape[1] - 1, at) @ b @ bernstein_basis(b.shape[2] - 1, at).T
        )


def _exact(coordinate: FloatArray) -> BoundedPolynomial:
    """Take a coordinate of control points, (k, m + 1, n + 1), for exact."""
    b = np.ascontiguousarray(coordinate)
    return BoundedPolynomial(b, 4.0 * EPS * (np.abs(b) + 1.0))
