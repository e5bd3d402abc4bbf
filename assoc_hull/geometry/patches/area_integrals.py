"""Areas under patches, and how much surface lies over a square of parameters.

`AreaIntegrator` is made once for a batch and then asked for areas over boxes and along lines.
Errors are estimates of the rules themselves; the total is taken by a rule of its own.

How much surface lies over a square of parameters: |r_u x r_v| of Bezier patches.

Taken from the control points themselves, not from the polynomial |S|**2, which has lost digits
where |S| is small.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.area_integrals import elements_on_grid
>>> from assoc_hull.geometry.patches.bezier_patches import Patches
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0], net[:, 1, 1] = 2.0, 3.0
>>> elements_on_grid(Patches.single(net), np.array([0.5]), np.array([0.0, 1.0]))
array([[[6., 6.]]])
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Self

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.quadrature import gauss
from assoc_hull.geometry.patches.bernstein_polynomials import (
    binomials,
    degrees,
    transform_coefficients,
    u_derivative,
    v_derivative,
)
from assoc_hull.geometry.patches.bezier_patches import Patches

__all__ = [
    "TERMS",
    "AreaIntegrator",
    "AreaSeries",
    "area_series",
    "areas_over_boxes",
    "bernstein_values",
    "elements_on_grid",
    "elements_on_lines",
    "integrals_along_lines",
    "pairwise_sum",
    "select_rows",
    "swap_parameters",
]


def pairwise_sum(terms: FloatArray) -> FloatArray:
    """Add along the first axis, in an order that depends on nothing but its length.

    Parameters
    ----------
    terms : (p, ...) float
        What to add; overwritten.

    Returns
    -------
    (...) float
        The sums. Those of numpy differ by a bit where there is one column only.

    Examples
    --------
    >>> float(pairwise_sum(np.array([1.0, 2.0, 3.0])))
    6.0
    """
    count = len(terms)
    while count > 1:
        half = (count + 1) // 2
        terms[: count - half] += terms[half:count]
        count = half
    found: FloatArray = terms[0]
    return found


def bernstein_values(degree: int, t: FloatArray) -> FloatArray:
    """Give the Bernstein polynomials of a degree at places.

    Parameters
    ----------
    degree : int
        The degree.
    t : (...) float
        Places, in [0, 1].

    Returns
    -------
    (degree + 1, ...) float
        The values.

    Examples
    --------
    >>> bernstein_values(2, np.array([0.5])).ravel()
    array([0.25, 0.5 , 0.25])
    """
    found = np.empty((degree + 1, *t.shape))
    falling = np.empty_like(found)
    rest = 1.0 - t
    found[0], falling[degree] = 1.0, 1.0
    for i in range(degree):
        np.multiply(found[i], t, out=found[i + 1])
        np.multiply(falling[degree - i], rest, out=falling[degree - i - 1])
    found *= falling
    found *= binomials(degree).reshape(-1, *(1,) * t.ndim)
    return found


def swap_parameters(patches: Patches) -> Patches:
    """Exchange the parameters of patches.

    Parameters
    ----------
    patches : Patches
        The patches.

    Returns
    -------
    Patches
        The same with u and v exchanged.

    Examples
    --------
    >>> swap_parameters(Patches.single(np.zeros((2, 4, 3)))).degrees
    (3, 1)
    """
    weight = None if patches.weight is None else patches.weight.swapaxes(1, 2)
    return Patches(patches.net.swapaxes(1, 2), patches.box[:, ::-1], patches.surface, weight)


def select_rows(patches: Patches, rows: IntArray) -> Patches:
    """Take some patches of a batch.

    Parameters
    ----------
    patches : Patches
        The patches.
    rows : (r,) int
        Which.

    Returns
    -------
    Patches
        These.

    Examples
    --------
    >>> len(select_rows(Patches.single(np.zeros((2, 4, 3))), np.array([0, 0])))
    2
    """
    return patches[rows]


def elements_on_grid(patches: Patches, u: FloatArray, v: FloatArray) -> FloatArray:
    """Give |r_u x r_v| of each patch on the same grid of parameters.

    Parameters
    ----------
    patches : Patches
        The patches, k of them.
    u, v : (p,), (q,)
        Parameters in [0, 1].

    Returns
    -------
    (k, p, q), m2
        The area elements, per unit of u times v of the patch.

    Examples
    --------
    >>> net = np.zeros((2, 2, 3))
    >>> net[1, :, 0] = net[:, 1, 1] = 1.0
    >>> elements_on_grid(Patches.single(net), np.array([0.5]), np.array([0.5]))
    array([[[1.]]])
    """

    def values(a: FloatArray) -> FloatArray:
        in_u, in_v = (
            bernstein_values(degree, t) for degree, t in zip(degrees(a), (u, v), strict=True)
        )
        return np.moveaxis(transform_coefficients(in_u.T, a, in_v.T), 1, 0)

    return _elements(patches, values)


def elements_on_lines(
    patches: Patches, patch: IntArray, u: FloatArray, v: FloatArray
) -> FloatArray:
    """Give |r_u x r_v| on lines v = constant, each with its own places.

    Parameters
    ----------
    patches : Patches
        The patches.
    patch : (c,) int
        Which patch the lines of each row lie on.
    u : (c, p, q)
        The places on each of p lines.
    v : (c, p)
        The lines.

    Returns
    -------
    (c, p, q), m2
        The area elements, per unit of u times v of the patch.

    Examples
    --------
    >>> net = np.zeros((2, 2, 3))
    >>> net[1, :, 0] = net[:, 1, 1] = 1.0
    >>> row, u, v = np.array([0]), np.array([[[0.1, 0.2]]]), np.array([[0.5]])
    >>> elements_on_lines(Patches.single(net), row, u, v)
    array([[[1., 1.]]])
    """

    def values(a: FloatArray) -> FloatArray:
        m, n = degrees(a)
        return _on_lines(a[patch], bernstein_values(m, u), bernstein_values(n, v))

    return _elements(patches, values)


def _elements(patches: Patches, values: Callable[[FloatArray], FloatArray]) -> FloatArray:
    """Give |r_u x r_v| where `values` evaluates polynomials, components first.

    A rational patch is X / w, with X the weighted points, and (X / w)_u = (X_u - w_u X / w) / w.
    """
    r = patches.components
    if patches.weight is None:
        return _lengths(values(u_derivative(r)), values(v_derivative(r)))
    weight = patches.weight[:, None]
    h = np.concatenate([weight * (r - r[..., :1, :1]), weight], axis=1)
    point, *both = (values(each) for each in (h, u_derivative(h), v_derivative(h)))
    place = point[:3] / point[3]
    return _lengths(*((each[:3] - each[3] * place) / point[3] for each in both))


def _on_lines(a: FloatArray, in_u: FloatArray, in_v: FloatArray) -> FloatArray:
    """Give vectors (d, c, p, q) of coefficients (c, d, m + 1, n + 1) on lines."""
    lines = a @ np.moveaxis(in_v, 0, 1)[:, None]
    found = np.zeros((a.shape[1], *in_u.shape[1:]))
    for i, values in enumerate(in_u):
        found += np.moveaxis(lines[:, :, i], 1, 0)[..., None] * values
    return found


def _lengths(a: FloatArray, b: FloatArray) -> FloatArray:
    """Give the lengths of vector products; components along the first axis."""
    x = a[1] * b[2] - a[2] * b[1]
    y = a[2] * b[0] - a[0] * b[2]
    z = a[0] * b[1] - a[1] * b[0]
    return np.asarray(np.sqrt(x * x + y * y + z * z))


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
