"""Areas under a patch by one series: |r_u x r_v| in Chebyshev polynomials of both parameters.

Where the normal vector does not vanish, nor is about to, its length is analytic and the series of
few terms is as exact as one wants: then the area over a box, or from a border of the patch to a
curve, is a sum of these terms. As many terms are taken as are needed; a patch whose series does not
end in reach gets none, and is integrated point by point (`area_direct`).

The error of a series is taken for the sum of the amounts of its last eighth of terms. The error
proper is that of terms left out, which are smaller by some orders where the series converges.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.area_series import area_series
>>> from assoc_hull.geometry.patches.patches import Patches
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0], net[:, 1, 1] = 2.0, 3.0
>>> [series] = area_series(Patches.single(net), np.array([1e-9]))
>>> series.over(np.array([0]), np.array([[[0.0, 1.0], [0.0, 0.5]]])).round(12)
array([3.])
"""

from __future__ import annotations

from functools import cache

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.algebra import across
from assoc_hull.geometry.patches.area_elements import added, on_grid, taken
from assoc_hull.geometry.patches.patches import Patches

__all__ = ["TERMS", "AreaSeries", "area_series"]

# Rows at a time, so that their values stay in the cache.
_BLOCK = 256

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
        """Integrate over boxes.

        Parameters
        ----------
        row : (c,) int
            The row of the series for each.
        box : (c, 2, 2)
            ``[[u0, u1], [v0, v1]]``.

        Returns
        -------
        (c,) float, m2
            The areas.
        """
        found = np.empty(len(row))
        for first in range(0, len(row), _BLOCK):
            part = slice(first, first + _BLOCK)
            found[part] = _over(self.terms[0, row[part]], box[part])
        return found

    def between(
        self, row: IntArray, flip: IntArray, start: FloatArray, u: FloatArray, v: FloatArray
    ) -> FloatArray:
        """Integrate along lines v = constant.

        Parameters
        ----------
        row : (c,) int
            The row of the series for each.
        flip : (c,) int
            1 where u and v are exchanged, else 0.
        start : (c,)
            Where the lines begin.
        u, v : (c, q)
            Where they end.

        Returns
        -------
        (c, q) float, m2
            The integrals, per unit of v.
        """
        found = np.empty_like(u)
        for first in range(0, len(row), _BLOCK):
            part = slice(first, first + _BLOCK)
            terms = self.terms[flip[part], row[part]]
            found[part] = _along(terms, start[part], u[part], v[part])
        return found


def _over(terms: FloatArray, box: FloatArray) -> FloatArray:
    ends = _integrals(terms.shape[1], box)
    u, v = np.moveaxis(ends[..., 1] - ends[..., 0], 2, 0)
    lines = terms @ np.ascontiguousarray(v.T)[..., None]
    return added(u * lines[..., 0].T)


def _along(terms: FloatArray, start: FloatArray, u: FloatArray, v: FloatArray) -> FloatArray:
    count = terms.shape[1]
    lines = terms @ np.ascontiguousarray(np.moveaxis(_chebyshev(count, v), 0, 1))
    weight = _integrals(count, u)
    weight -= _integrals(count, start)[..., None]
    weight *= np.moveaxis(lines, 1, 0)
    return added(weight)


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
        terms = _terms(taken(patches, left), count)
        error = _tail(terms)
        enough = error <= tolerance[left]
        if enough.any():
            both = np.stack([terms[enough], terms[enough].swapaxes(1, 2)])
            found.append(AreaSeries(left[enough], both, error[enough]))
        left = left[~enough]
    return tuple(found)


def _terms(patches: Patches, count: int) -> FloatArray:
    places, transform = _rule(count)
    return across(transform, on_grid(patches, places, places), transform)


def _tail(terms: FloatArray) -> FloatArray:
    """Add the amounts of the last eighth of terms, two at least."""
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
