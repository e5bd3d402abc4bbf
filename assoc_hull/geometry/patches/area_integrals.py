"""Areas under patches: by a Chebyshev series where there is one, by Gauss rules elsewhere.

`AreaIntegrator` is made once for a batch and then asked for areas over boxes and along lines.
Errors are estimates of the rules themselves; the total is taken by a rule of its own.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Self

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.quadrature import gauss
from assoc_hull.geometry.patches.area_elements import (
    elements_on_grid,
    elements_on_lines,
    pairwise_sum,
    select_rows,
    swap_parameters,
)
from assoc_hull.geometry.patches.bernstein_polynomials import transform_coefficients
from assoc_hull.geometry.patches.bezier_patches import Patches

__all__ = [
    "TERMS",
    "AreaIntegrator",
    "AreaSeries",
    "area_series",
    "areas_over_boxes",
    "integrals_along_lines",
]

# Point by point: Gauss's rules of 5 and 8 points on boxes and lines, whose difference estimates the
# error; a box or piece of a line for which it is too large is halved. This needs many more points
# than a series, but also works where the normal vector vanishes, or almost does.

_FEW, _MANY = 5, 8
_ROUNDS = 24
# Rows at a time, so that the values stay in the cache.
_POINT_BLOCK = 512

Rule = Callable[[IntArray, FloatArray, int], FloatArray]


def areas_over_boxes(
    patches: Patches, patch: IntArray, box: FloatArray, tolerance: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Integrate the area element over boxes of parameters, (c, 2, 2), ``[[u0, u1], [v0, v1]]``.

    Gives areas and estimates of their errors, (c,) and (c,), m2. An estimate above its `tolerance`
    (c,), m2, says that splitting ended first.
    """

    def rule(rows: IntArray, part: FloatArray, count: int) -> FloatArray:
        nodes, weights = gauss(count)
        width = part[:, :, 1] - part[:, :, 0]
        u, v = np.moveaxis(part[..., :1] + width[..., None] * nodes, 1, 0)
        places = np.repeat(u[:, None], count, axis=1)
        values = elements_on_lines(patches, patch[rows], places, v) * weights * weights[:, None]
        return width[:, 0] * width[:, 1] * pairwise_sum(values.reshape(len(rows), -1).T.copy())

    return _halved(rule, box, tolerance)


def integrals_along_lines(
    patches: Patches,
    patch: IntArray,
    span: FloatArray,
    v: FloatArray,
    tolerance: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Integrate the area element along lines v (c,) = constant, over u in `span` (c, 2).

    Gives integrals and estimates of their errors, (c,) and (c,), m2 per unit of v; `tolerance` (c,)
    likewise.
    """

    def rule(rows: IntArray, part: FloatArray, count: int) -> FloatArray:
        nodes, weights = gauss(count)
        width = part[:, 0, 1] - part[:, 0, 0]
        u = part[:, 0, :1] + width[:, None] * nodes
        values = elements_on_lines(patches, patch[rows], u[:, None], v[rows, None])[:, 0] * weights
        return width * pairwise_sum(values.T.copy())

    return _halved(rule, span[:, None], tolerance)


def _halved(rule: Rule, box: FloatArray, tolerance: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Integrate over boxes (c, d, 2) of any dimension d; halve what is not good enough."""
    count = len(box)
    value, error = np.zeros((2, count))
    rows, allowed = np.arange(count), tolerance
    for turn in range(_ROUNDS):
        fine, off = _by_blocks(rule, rows, box)
        good = off <= np.maximum(allowed, 1e-15 * np.abs(fine))
        if turn == _ROUNDS - 1:
            good[:] = True
        value += np.bincount(rows[good], fine[good], count)
        error += np.bincount(rows[good], off[good], count)
        if good.all():
            break
        rows, allowed, box = rows[~good], allowed[~good], _parts(box[~good])
        parts = box.shape[1]
        rows, allowed = rows.repeat(parts), (allowed / parts).repeat(parts)
        box = box.reshape(-1, *box.shape[2:])
    return value, error


def _by_blocks(rule: Rule, rows: IntArray, box: FloatArray) -> tuple[FloatArray, FloatArray]:
    fine, coarse = np.empty((2, len(rows)))
    for first in range(0, len(rows), _POINT_BLOCK):
        part = slice(first, first + _POINT_BLOCK)
        fine[part] = rule(rows[part], box[part], _MANY)
        coarse[part] = rule(rows[part], box[part], _FEW)
    return fine, np.abs(fine - coarse)


def _parts(box: FloatArray) -> FloatArray:
    """Halve boxes (c, d, 2) in all directions: (c, 2 ** d, d, 2)."""
    middle = 0.5 * (box[..., 0] + box[..., 1])
    found = box[:, None]
    for axis in range(box.shape[1]):
        low, high = found.copy(), found.copy()
        low[:, :, axis, 1] = middle[:, None, axis]
        high[:, :, axis, 0] = middle[:, None, axis]
        found = np.concatenate([low, high], axis=1)
    return found


# --------------------------------------------------------------------------------------
# One series a patch: |r_u x r_v| in Chebyshev polynomials of both parameters. Where the normal
# vector stays clear of zero its length is analytic and few terms are as exact as one wants; areas
# over boxes, or from a border to a curve, are sums of these terms. A patch whose series does not
# end in reach gets none.

# Rows at a time, so that their values stay in the cache.
_SERIES_BLOCK = 256

TERMS = (8, 12, 18, 27, 40, 60)
"""How many terms are tried in each parameter."""


@attrs.frozen(eq=False)
class AreaSeries:
    """Series of one length, of patches for which it is long enough.

    Attributes
    ----------
    patch : (r,) int
        The patches, in rising order.
    terms : (2, r, p, p), m2
        Coefficients of Chebyshev polynomials of 2u - 1 and 2v - 1; then the same exchanged.
    error : (r,) float, m2
        What an area may be off by.
    """

    patch: IntArray
    terms: FloatArray
    error: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.patch, self.terms, self.error)

    @property
    def count(self) -> int:
        """The number of terms in each parameter."""
        return int(self.terms.shape[2])

    def over(self, row: IntArray, box: FloatArray) -> FloatArray:
        """Integrate over boxes (c, 2, 2), by rows (c,) of the series: areas (c,), m2.

        Boxes are ``[[u0, u1], [v0, v1]]``.
        """
        found = np.empty(len(row))
        for first in range(0, len(row), _SERIES_BLOCK):
            part = slice(first, first + _SERIES_BLOCK)
            found[part] = _over(self.terms[0, row[part]], box[part])
        return found

    def between(
        self, row: IntArray, flip: IntArray, start: FloatArray, u: FloatArray, v: FloatArray
    ) -> FloatArray:
        """Integrate along lines v (c, q) = constant, u from `start` (c,) to (c, q).

        Gives m2 per unit of v, (c, q). `row` (c,) is the row of the series for each, `flip` (c,) is
        1 where u and v are exchanged, else 0.
        """
        found = np.empty_like(u)
        for first in range(0, len(row), _SERIES_BLOCK):
            part = slice(first, first + _SERIES_BLOCK)
            terms = self.terms[flip[part], row[part]]
            found[part] = _along(terms, start[part], u[part], v[part])
        return found


def _over(terms: FloatArray, box: FloatArray) -> FloatArray:
    ends = _integrals(terms.shape[1], box)
    u, v = np.moveaxis(ends[..., 1] - ends[..., 0], 2, 0)
    lines = terms @ np.ascontiguousarray(v.T)[..., None]
    return pairwise_sum(u * lines[..., 0].T)


def _along(terms: FloatArray, start: FloatArray, u: FloatArray, v: FloatArray) -> FloatArray:
    count = terms.shape[1]
    lines = terms @ np.ascontiguousarray(np.moveaxis(_chebyshev(count, v), 0, 1))
    weight = _integrals(count, u)
    weight -= _integrals(count, start)[..., None]
    weight *= np.moveaxis(lines, 1, 0)
    return pairwise_sum(weight)


def area_series(patches: Patches, tolerance: FloatArray) -> tuple[AreaSeries, ...]:
    """Find series of the area elements of patches.

    Parameters
    ----------
    patches : Patches
        The patches, k of them.
    tolerance : (k,) float, m2
        What an area of each may be off by.

    Returns
    -------
    tuple of AreaSeries
        One for each number of terms that some patch needs. Patches for which even the longest is
        too short are in none.

    Examples
    --------
    >>> net = np.zeros((2, 2, 3))
    >>> net[1, :, 0] = net[:, 1, 1] = 1.0
    >>> [series] = area_series(Patches.single(net), np.array([1e-9]))
    >>> series.terms.shape
    (2, 1, 8, 8)
    """
    left = np.arange(len(patches))
    found = list[AreaSeries]()
    for count in TERMS:
        if not len(left):
            break
        terms = _terms(select_rows(patches, left), count)
        error = _tail(terms)
        enough = error <= tolerance[left]
        if enough.any():
            both = np.stack([terms[enough], terms[enough].swapaxes(1, 2)])
            found.append(AreaSeries(left[enough], both, error[enough]))
        left = left[~enough]
    return tuple(found)


def _terms(patches: Patches, count: int) -> FloatArray:
    places, transform = _rule(count)
    return transform_coefficients(transform, elements_on_grid(patches, places, places), transform)


def _tail(terms: FloatArray) -> FloatArray:
    """Estimate the error of series: the amounts of the last eighth of terms, two at least, added.

    The true error is that of the terms left out, smaller by some orders where the series converges.
    """
    count = terms.shape[1]
    kept = count - max(2, count // 8)
    amount = np.abs(terms)
    amount[:, :kept, :kept] = 0.0
    return np.asarray(amount.sum(axis=2).sum(axis=1))


@cache
def _rule(count: int) -> tuple[FloatArray, FloatArray]:
    """Give places in [0, 1], and the matrix from values there to terms."""
    turn = np.pi * (np.arange(count) + 0.5) / count
    transform = 2.0 / count * np.cos(np.outer(np.arange(count), turn))
    transform[0] *= 0.5
    places = 0.5 + 0.5 * np.cos(turn)
    freeze(places, transform)
    return places, transform


def _chebyshev(count: int, t: FloatArray) -> FloatArray:
    """Give the polynomials of degrees 0 to count - 1 of 2t - 1: (count, ...)."""
    found = np.empty((count, *t.shape))
    x = 2.0 * t - 1.0
    found[0], found[1] = 1.0, x
    twice = 2.0 * x
    for i in range(2, count):
        np.multiply(twice, found[i - 1], out=found[i])
        found[i] -= found[i - 2]
    return found


def _integrals(count: int, t: FloatArray) -> FloatArray:
    """Give their integrals from some place to t: (count, ...)."""
    values = _chebyshev(count + 1, t)
    found = np.empty((count, *t.shape))
    np.multiply(values[1], 0.5, out=found[0])
    np.multiply(values[2], 0.125, out=found[1])
    order = np.arange(2.0, count).reshape(-1, *(1,) * t.ndim)
    np.multiply(values[3:], 0.25 / (order + 1.0), out=found[2:])
    found[2:] -= values[1:-2] * (0.25 / (order - 1.0))
    return found


# --------------------------------------------------------------------------------------
# Areas by series where there is one, point by point elsewhere.

_ROUGH = 8
# Patches without a series are cut into so many parts in each parameter before all else: a rule
# judges well what is nearly smooth only.
_PARTS = 4
# What of the tolerance the series may take, and its least: what rounding leaves of an area.
_SHARE, _LEAST = 0.25, 2e-14


@attrs.frozen(eq=False)
class AreaIntegrator:
    """What areas under patches are taken from.

    Attributes
    ----------
    patches : Patches
        The patches, k of them.
    series : tuple of AreaSeries
        Series, by their length.
    kind : (k,) int
        Which of these each patch has; -1 for none.
    row : (k,) int
        Its row there.
    scale : (k,) float, m2
        The area of each patch, roughly.
    total : (k,) float, m2
        The area of each patch by a rule of its own, not from the series.
    error : (k,) float, m2
        What any area under a patch may be off by.
    """

    patches: Patches
    series: tuple[AreaSeries, ...]
    kind: IntArray
    row: IntArray
    scale: FloatArray
    total: FloatArray
    error: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.kind, self.row, self.scale, self.total, self.error)

    @classmethod
    def of(cls, patches: Patches, area_tol: float, by_series: bool = True) -> Self:
        """Prepare areas that may be off by `area_tol`, in parts of that of their patch."""
        count = len(patches)
        scale = _totals(patches, _ROUGH)
        allowed = max(_SHARE * area_tol, _LEAST) * scale
        found = area_series(patches, allowed) if by_series else ()
        kind, row = np.full(count, -1), np.zeros(count, np.intp)
        total, error = np.zeros((2, count))
        for index, series in enumerate(found):
            kind[series.patch], row[series.patch] = index, np.arange(len(series.patch))
            total[series.patch] = _totals(select_rows(patches, series.patch), series.count)
            error[series.patch] = series.error
        rest = np.flatnonzero(kind < 0)
        if len(rest):
            total[rest], error[rest] = _direct_totals(patches, rest, allowed[rest])
        return cls(patches, found, kind, row, scale, total, error)

    def over(
        self, patch: IntArray, box: FloatArray, tolerance: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Integrate over boxes (c, 2, 2), in parameters of their patches (c,).

        Boxes are ``[[u0, u1], [v0, v1]]``. Gives areas, and what they may be off by beyond the
        `error` of the patch, (c,) and (c,), m2; where there is no series that is to stay below
        `tolerance` (c,), m2.
        """
        value, error = np.zeros((2, len(patch)))
        kind = self.kind[patch]
        for index, series in enumerate(self.series):
            rows = np.flatnonzero(kind == index)
            if len(rows):
                value[rows] = series.over(self.row[patch[rows]], box[rows])
        rows = np.flatnonzero(kind < 0)
        if len(rows):
            value[rows], error[rows] = areas_over_boxes(
                self.patches, patch[rows], box[rows], tolerance[rows]
            )
        return value, error

    def between(
        self, patch: IntArray, flip: IntArray, start: FloatArray, u: FloatArray, v: FloatArray,
        tolerance: FloatArray,
    ) -> tuple[FloatArray, FloatArray]:  # fmt: skip
        """Integrate along lines v (c, q) = constant, u from `start` (c,) to (c, q).

        Gives integrals and what they may be off by, (c, q) and (c, q), m2 per unit of v;
        `tolerance` (c,) likewise, where there is no series. `flip` (c,) is 1 where u and v are
        exchanged, else 0.
        """
        value, error = np.zeros((2, *u.shape))
        kind = self.kind[patch]
        for index, series in enumerate(self.series):
            rows = np.flatnonzero(kind == index)
            if len(rows):
                value[rows] = series.between(
                    self.row[patch[rows]], flip[rows], start[rows], u[rows], v[rows]
                )
        for way in (0, 1):
            rows = np.flatnonzero((kind < 0) & (flip == way))
            if len(rows):
                patches = swap_parameters(self.patches) if way else self.patches
                value[rows], error[rows] = _directly(
                    patches, patch[rows], start[rows], u[rows], v[rows], tolerance[rows]
                )
        return value, error


def _directly(
    patches: Patches, patch: IntArray, start: FloatArray, u: FloatArray, v: FloatArray,
    tolerance: FloatArray,
) -> tuple[FloatArray, ...]:  # fmt: skip
    count = u.shape[1]
    each = np.arange(len(u)).repeat(count)
    span = np.stack([start[each], u.reshape(-1)], axis=1)
    found = integrals_along_lines(patches, patch[each], span, v.reshape(-1), tolerance[each])
    return tuple(part.reshape(-1, count) for part in found)


def _direct_totals(
    patches: Patches, rows: IntArray, tolerance: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give the areas of patches that have no series, and their errors, from parts of each."""
    count = len(rows)
    each = np.arange(count).repeat(_PARTS**2)
    lines = np.arange(_PARTS + 1) / _PARTS
    spans = np.stack([lines[:-1], lines[1:]], axis=1)
    box = np.empty((count, _PARTS, _PARTS, 2, 2))
    box[..., 0, :], box[..., 1, :] = spans[:, None], spans
    found = areas_over_boxes(
        patches, rows[each], box.reshape(-1, 2, 2), (tolerance / _PARTS**2)[each]
    )
    value, error = (np.bincount(each, part, count).astype(np.float64) for part in found)
    return value, error


def _totals(patches: Patches, count: int) -> FloatArray:
    """Give the areas of patches by Gauss's rule of so many points in each parameter."""
    nodes, weights = gauss(count)
    values = elements_on_grid(patches, nodes, nodes) * weights * weights[:, None]
    return pairwise_sum(values.reshape(len(patches), -1).T.copy())
