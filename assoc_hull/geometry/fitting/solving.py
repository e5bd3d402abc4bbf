"""Control points that lie nearest to points and bend least: one banded system of equations.

Minimised is ``sum w |S(u, v) - X|^2 + lam II |S_uu|^2 + 2 |S_uv|^2 + |S_vv|^2 du dv`` over cubic
tensor-product splines S, an approximation by a thin plate (P. H. C. Eilers and B. D. Marx,
Flexible smoothing with B-splines and penalties, Statist. Sci. 11, 1996, with integrals in place
of differences). The equations are ``(A' W A + lam E) C = A' W X``.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fitting.basis import DEGREE, basis_rows
from assoc_hull.geometry.fitting.held_controls import HeldControls
from assoc_hull.geometry.fitting.samples import Samples
from assoc_hull.geometry.fitting.stencils import banded, bending, gathered

__all__ = ["controls"]


def controls(
    samples: Samples,
    knots_u: FloatArray,
    knots_v: FloatArray,
    smoothing: float,
    held: HeldControls | None = None,
    where: str = "in a fit",
) -> FloatArray:
    """Solve for the control points of a bicubic spline, parameters as they are.

    Parameters
    ----------
    samples : Samples
        Points with parameters and weights.
    knots_u, knots_v : (nu + 4,), (nv + 4,), m
        Clamped knots.
    smoothing : float, m3
        The factor lam of the penalty, nil or more.
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
    >>> from assoc_hull.geometry.fitting.basis import clamped
    >>> from assoc_hull.geometry.fitting.samples import Samples
    >>> from assoc_hull.geometry.fitting.solving import controls
    >>> uv = np.array([[0.0, 0.0], [3.0, 0.0], [0.0, 3.0]])
    >>> flat = Samples.of(uv, np.column_stack([uv, np.zeros(3)]))
    >>> knots = clamped(np.array([0.0, 3.0]))
    >>> controls(flat, knots, knots, 1.0)[3, 3].round(9).tolist()
    [3.0, 3.0, 0.0]
    """
    shape = len(knots_u) - DEGREE - 1, len(knots_v) - DEGREE - 1
    turn = shape[1] > shape[0]
    axes = ((samples.uv[:, 1], knots_v), (samples.uv[:, 0], knots_u))
    if not turn:
        axes = axes[::-1]
    found = [basis_rows(knots, at) for at, knots in axes]
    stencil, right = gathered(
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
    found[0, mask] = band[0].mean()
    return found
