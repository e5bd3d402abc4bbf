"""Control points that lie nearest to points and bend least: one banded system of equations.

The normal equations are kept as stencils, by the distance of two control points.
Cholesky's method solves them; coordinates with the same held points share their factors.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.fitting.basis import DEGREE, basis_rows
from assoc_hull.geometry.fitting.fit_input import HeldControls, Samples

__all__ = [
    "banded",
    "bending",
    "gram",
    "normal_equations",
    "solve_controls",
]

# Control points whose numbers differ by more than three, in u or in v, share no patch. So an array
# ``[a, b + 3, i, j]``, a stencil, holds a symmetric matrix of them all: what links control point
# (i, j) with (i + a, j + b), for a from 0 to 3 and b from -3 to 3. Counted along the axis that has
# fewer points, it is a matrix of narrow band, solved without any search for an order.

_NEXT = DEGREE + 1
_REACH = 2 * DEGREE + 1
_PAIRS = [(a, p) for a in range(_NEXT) for p in range(_NEXT - a)]
"""Pairs of two of the four splines along the first axis: (p + a, p)."""


def gram(knots: FloatArray, order: int) -> FloatArray:
    """Give the integrals of products of two derivatives of cubic B-splines.

    Parameters
    ----------
    knots : (count + 4,), m
        The knots.
    order : int
        The derivative, 0 to 2.

    Returns
    -------
    (7, count), m**(1 - 2 order)
        Row d + 3 holds those of j + d and j; zero where there is no j + d.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.fitting.basis import clamped_knots
    >>> from assoc_hull.geometry.fitting.least_squares import gram
    >>> round(float(gram(clamped_knots(np.array([0.0, 2.0])), 0).sum()), 12)
    2.0
    """
    node, weight = np.polynomial.legendre.leggauss(_NEXT)
    low, high = knots[:-1], knots[1:]
    spans = np.flatnonzero(high > low)
    half, middle = 0.5 * (high - low)[spans], 0.5 * (high + low)[spans]
    at = (middle[:, None] + half[:, None] * node).ravel()
    first, rows = basis_rows(knots, at, order)
    values, size = rows[order], (half[:, None] * weight).ravel()
    found = np.zeros((_REACH, len(knots) - _NEXT))
    for p in range(_NEXT):
        for q in range(_NEXT):
            product = size * values[:, p] * values[:, q]
            found[p - q + DEGREE] += np.bincount(first + q, product, found.shape[1])
    return found


def bending(knots_u: FloatArray, knots_v: FloatArray) -> FloatArray:
    """Give the matrix of II |S_uu|^2 + 2 |S_uv|^2 + |S_vv|^2 du dv, as a stencil.

    It is (4, 7, nu, nv), 1/m2, for knots (nu + 4,), (nv + 4,), m: products of the integrals of one
    variable, as the splines are.
    """
    along, across = ([gram(knots, order) for order in range(3)] for knots in (knots_u, knots_v))
    return np.asarray(
        sum(
            factor * along[order][DEGREE:, None, :, None] * across[2 - order][None, :, None, :]
            for order, factor in ((2, 1.0), (1, 2.0), (0, 1.0))
        )
    )


def normal_equations(
    first: tuple[IntArray, IntArray],
    rows: tuple[FloatArray, FloatArray],
    weight: FloatArray,
    right: FloatArray,
    shape: tuple[int, int],
) -> tuple[FloatArray, FloatArray]:
    """Sum up what points ask of the control points: A' W A as a stencil (4, 7, nu, nv), and A' W X.

    For the `first` of the four splines that each of k points depends on, in u and in v, their
    values `rows` (k, 4), weights (k,), points `right` (k, 3) and the `shape` (nu, nv); A' W X is
    (nu, nv, 3).
    """
    cell = first[0] * shape[1] + first[1]
    order = np.argsort(cell, kind="stable")
    cell = cell[order]
    begin = np.flatnonzero(np.append(True, cell[1:] != cell[:-1]))
    along, across = rows[0][order] * weight[order, None], rows[1][order]
    plain = rows[0][order]
    upper = np.stack([along[:, p + a] * plain[:, p] for a, p in _PAIRS], axis=1)
    lower = (across[:, :, None] * across[:, None, :]).reshape(len(cell), -1)
    squares = np.add.reduceat(upper[:, :, None] * lower[:, None, :], begin, axis=0)
    pulls = (along[:, :, None] * across[:, None, :]).reshape(len(cell), -1, 1)
    pulled = np.add.reduceat(pulls * right[order, None, :], begin, axis=0)
    return _placed(squares, cell[begin], shape), _pulled(pulled, cell[begin], shape)


def _placed(squares: FloatArray, cell: IntArray, shape: tuple[int, int]) -> FloatArray:
    """Put sums of products (cells, 10, 16) where they belong in a stencil."""
    a, p = np.array(_PAIRS).T
    r, q = (each.ravel() for each in np.mgrid[0:_NEXT, 0:_NEXT])
    size = shape[0] * shape[1]
    offset = (
        (a[:, None] * _REACH + (r - q + DEGREE)[None, :]) * size
        + p[:, None] * shape[1] + q[None, :]
    )  # fmt: skip
    number = (cell[:, None, None] + offset).ravel()
    found = np.bincount(number, squares.ravel(), _NEXT * _REACH * size)
    return np.asarray(found.reshape(_NEXT, _REACH, *shape), np.float64)


def _pulled(pulled: FloatArray, cell: IntArray, shape: tuple[int, int]) -> FloatArray:
    """Add up pulls of cells (cells, 16, 3) on control points."""
    p, q = (each.ravel() for each in np.mgrid[0:_NEXT, 0:_NEXT])
    number = (cell[:, None] + p * shape[1] + q).ravel()
    size = shape[0] * shape[1]
    sums = [np.bincount(number, pulled[..., axis].ravel(), size) for axis in range(3)]
    return np.asarray(np.stack(sums, axis=-1).reshape(*shape, 3), np.float64)


def banded(stencil: FloatArray) -> FloatArray:
    """Give a stencil (4, 7, nu, nv) as the diagonal and what is below it, (band, nu nv)."""
    inner = stencil.shape[3]
    found = np.zeros((DEGREE * inner + DEGREE + 1, stencil.shape[2] * inner))
    for a in range(_NEXT):
        for b in range(-DEGREE, _NEXT):
            if a * inner + b >= 0 and (a > 0 or b >= 0):
                found[a * inner + b] += stencil[a, b + DEGREE].ravel()
    return found


# --------------------------------------------------------------------------------------
# The solution for control points.


def solve_controls(
    samples: Samples,
    knots_u: FloatArray,
    knots_v: FloatArray,
    smoothing: float,
    held: HeldControls | None = None,
    where: str = "in a fit",
) -> FloatArray:
    """Solve for the control points of a bicubic spline, parameters as they are.

    Minimised is ``sum w |S(u, v) - X|^2 + lam II |S_uu|^2 + 2 |S_uv|^2 + |S_vv|^2 du dv``, an
    approximation by a thin plate (P. H. C. Eilers and B. D. Marx, Flexible smoothing with B-splines
    and penalties, Statist. Sci. 11, 1996, with integrals in place of differences). The equations
    are ``(A' W A + lam E) C = A' W X``.

    Parameters
    ----------
    samples : Samples
        Points with parameters and weights.
    knots_u, knots_v : (nu + 4,), (nv + 4,), m
        Clamped knots.
    smoothing : float, m3
        The factor lam of the penalty, zero or more.
    held : HeldControls, optional
        Coordinates that are given; they are met to the last bit.
    where : str
        How messages call the surface.

    Returns
    -------
    (nu, nv, 3), m
        The control points.

    Raises
    ------
    BadInputError
        Points and penalty leave control points free.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.fitting.basis import clamped_knots
    >>> from assoc_hull.geometry.fitting.fit_input import Samples
    >>> from assoc_hull.geometry.fitting.least_squares import solve_controls
    >>> uv = np.array([[0.0, 0.0], [3.0, 0.0], [0.0, 3.0]])
    >>> flat = Samples.of(uv, np.column_stack([uv, np.zeros(3)]))
    >>> knots = clamped_knots(np.array([0.0, 3.0]))
    >>> solve_controls(flat, knots, knots, 1.0)[3, 3].round(9).tolist()
    [3.0, 3.0, 0.0]
    """
    shape = len(knots_u) - DEGREE - 1, len(knots_v) - DEGREE - 1
    turn = shape[1] > shape[0]
    axes = ((samples.uv[:, 1], knots_v), (samples.uv[:, 0], knots_u))
    if not turn:
        axes = axes[::-1]
    found = [basis_rows(knots, at) for at, knots in axes]
    stencil, right = normal_equations(
        (found[0][0], found[1][0]), (found[0][1][0], found[1][1][0]),
        samples.weight, samples.point, shape[::-1] if turn else shape,
    )  # fmt: skip
    band = banded(stencil + smoothing * bending(axes[0][1], axes[1][1]))
    hold = held.turned() if held is not None and turn else held
    net = _solved(band, right.reshape(-1, 3), hold, where).reshape(right.shape)
    return np.ascontiguousarray(net.swapaxes(0, 1)) if turn else net


def _solved(
    band: FloatArray, right: FloatArray, held: HeldControls | None, where: str
) -> FloatArray:
    """Solve for three coordinates; those that hold the same points share their factors."""
    if held is None or not held.mask.any():
        return _cholesky(band, right, where)
    mask, value = held.mask.reshape(-1, 3), held.value.reshape(-1, 3)
    found = np.empty_like(right)
    open_axes = [0, 1, 2]
    while open_axes:
        first = open_axes[0]
        alike = [axis for axis in open_axes if (mask[:, axis] == mask[:, first]).all()]
        open_axes = [axis for axis in open_axes if axis not in alike]
        given = np.where(mask[:, alike], value[:, alike], 0.0)
        rest = right[:, alike] - _times(band, given)
        solved = _cholesky(_without(band, mask[:, first]), rest, where)
        found[:, alike] = np.where(mask[:, alike], given, solved)
    return found


def _cholesky(band: FloatArray, right: FloatArray, where: str) -> FloatArray:
    """Solve, or say that points and penalty leave something free."""
    from scipy.linalg import LinAlgError, solveh_banded

    try:
        found: FloatArray = solveh_banded(band, right, lower=True, check_finite=False)
    except LinAlgError:
        found = np.full_like(right, np.nan)
    if not np.isfinite(found).all():
        raise BadInputError(
            "points and penalty do not determine all control points",
            where, "give more points, fewer spans, or smoothing above 0",
        )  # fmt: skip
    return found


def _times(band: FloatArray, value: FloatArray) -> FloatArray:
    """Multiply a symmetric band matrix with columns (n, c)."""
    found: FloatArray = band[0][:, None] * value
    for below in np.flatnonzero(band[1:].any(axis=1)) + 1:
        entry = band[below, : len(value) - below, None]
        found[below:] += entry * value[:-below]
        found[:-below] += entry * value[below:]
    return found


def _without(band: FloatArray, mask: NDArray[np.bool_]) -> FloatArray:
    """Take rows and columns out of a symmetric band matrix: a diagonal entry is left of them."""
    found = band.copy()
    found[:, mask] = 0.0
    for below in range(1, min(len(band), band.shape[1])):
        found[below, :-below][mask[below:]] = 0.0
    # Any positive entry would do; the mean is of the size of the others.
    found[0, mask] = band[0].mean()
    return found
