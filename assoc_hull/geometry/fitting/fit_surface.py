"""A smooth surface through points of lines: least squares, parameters corrected, knots refined.

Each round solves for the control points and moves the parameters to the nearest places.
Spans whose points stay further off than the tolerance are halved; the fit goes on from there.

Control points that lie nearest to points and bend least: one banded system of equations.

The normal equations are kept as stencils, by the distance of two control points.
Cholesky's method solves them; coordinates with the same held points share their factors.
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.arguments import not_negative, positive
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.fitting.basis import DEGREE, basis_rows, clamped_knots
from assoc_hull.geometry.fitting.fit_input import HeldControls, Samples
from assoc_hull.geometry.fitting.foot_points import STEPS, foot_points
from assoc_hull.geometry.patches.spline_surface import SplineSurface

__all__ = [
    "SurfaceFit",
    "banded",
    "bending",
    "checked_breaks",
    "even_breaks",
    "fit_refined",
    "fit_surface",
    "gram",
    "halve_spans",
    "normal_equations",
    "solve_controls",
    "solve_once",
    "spans_to_halve",
    "subdivide_bays",
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
    >>> from assoc_hull.geometry.fitting.fit_surface import gram
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
    >>> from assoc_hull.geometry.fitting.fit_surface import solve_controls
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


_SHARE = 0.95
"""The part of the points of a span that must be within the tolerance."""

_NEAR = 1e-9
"""Spans shorter than this part of the domain are an error of the caller."""


def checked_breaks(values: FloatArray, name: str, where: str) -> FloatArray:
    """Take breaks, or say what is wrong with them.

    Raises
    ------
    BadInputError
        Fewer than two, not finite, falling, repeated more than three times within or at all at
        the ends, or so close that only rounding keeps them apart.
    """
    found = np.array(values, np.float64)
    if found.ndim != 1 or len(found) < 2 or not np.isfinite(found).all():
        raise BadInputError(f"{name} is of shape {found.shape}", where, "give two numbers or more")
    steps, room = np.diff(found), _NEAR * abs(found[-1] - found[0])
    if steps[0] <= 0.0 or steps[-1] <= 0.0 or ((steps != 0.0) & (steps < room)).any():
        least = float(steps.min())
        raise BadInputError(f"a span of {name} is {least:g} m long", where, "give rising places")
    if len(found) > 4 and (found[3:] == found[:-3]).any():
        raise BadInputError(f"{name} repeats a place four times", where, "repeat it three times")
    return found


def even_breaks(low: float, high: float, spans: int) -> FloatArray:
    """Give equal spans, (spans + 1,), m."""
    return np.linspace(low, high, spans + 1)


def subdivide_bays(places: FloatArray, parts: int | IntArray) -> FloatArray:
    """Divide each bay between rising places (b,), m, in equal parts, one number or (b - 1,).

    The places are among the breaks to the last bit.
    """
    counts = np.broadcast_to(np.asarray(parts, np.int64), len(places) - 1)
    bay = np.repeat(np.arange(len(counts)), counts)
    part = np.arange(len(bay)) - np.repeat(np.cumsum(counts) - counts, counts)
    return np.append(places[bay] + part / counts[bay] * np.diff(places)[bay], places[-1])


def halve_spans(breaks: FloatArray, which: NDArray[np.bool_]) -> FloatArray:
    """Halve chosen spans (b - 1,) of breaks (b,); the others stay to the last bit."""
    return subdivide_bays(breaks, np.where(which & (np.diff(breaks) > 0.0), 2, 1))


def spans_to_halve(
    breaks: FloatArray, at: FloatArray, residual: FloatArray, tolerance: float
) -> NDArray[np.bool_]:
    """Say which spans (b - 1,) of breaks (b,), m, do not follow their points.

    That is where they have points in both halves and more than 5 % of the points, `residual` (k,) m
    off at parameters `at` (k,), are off by more than the tolerance, m.
    """
    count = len(breaks) - 1
    span = np.clip(np.searchsorted(breaks, at, "right") - 1, 0, count - 1)
    off = np.bincount(span, residual > tolerance, count)
    number = np.bincount(span, minlength=count)
    middle = 0.5 * (breaks[:-1] + breaks[1:])
    right = np.bincount(span, at > middle[span], count)
    spread = (right > 0) & (right < number)
    return np.asarray((off > (1.0 - _SHARE) * number) & spread)


# --------------------------------------------------------------------------------------
# The fit on given breaks.

ROUNDS = 4
"""How often a fit solves and then corrects the parameters."""

START = 30.0
STIFF = 2
"""In so many first rounds the penalty is `START` times as large."""


@attrs.frozen(eq=False)
class SurfaceFit:
    """A surface, and the points that it was fitted to.

    Attributes
    ----------
    surface : SplineSurface
        A bicubic B-spline.
    samples : Samples
        The points, with parameters of the places of the surface nearest to them.
    residual : (k,), m
        How far they lie from these.
    smoothing : float, m3
        The factor of the penalty.
    """

    surface: SplineSurface
    samples: Samples
    residual: FloatArray
    smoothing: float

    def __attrs_post_init__(self) -> None:
        freeze(self.residual)

    @property
    def spans(self) -> tuple[int, int]:
        """How many spans of knots there are in u and in v."""
        knots = self.surface.knots_u, self.surface.knots_v
        return len(np.unique(knots[0])) - 1, len(np.unique(knots[1])) - 1


def fit_surface(
    name: str,
    samples: Samples,
    breaks_u: FloatArray,
    breaks_v: FloatArray,
    smoothing: float,
    *,
    held: HeldControls | None = None,
    rounds: int = ROUNDS,
    start: float = START,
    stiff: int = STIFF,
) -> SurfaceFit:
    """Fit a bicubic B-spline to points of lines.

    Parameters
    ----------
    name : str
        What messages and tables call the surface.
    samples : Samples
        The points, with parameters to start from and weights.
    breaks_u, breaks_v : (b,), m
        Where spans meet, with both ends.
    smoothing : float, m3
        The factor of the penalty: as all parameters are lengths, it is a volume.
    held : HeldControls, optional
        Coordinates of control points that are given.
    rounds : int
        How often to solve and then to correct the parameters, at least once.
    start, stiff : float, int
        In the first `stiff` rounds, but not the last, the penalty is `start` times as large, so
        that bad parameters do not lock in.

    Returns
    -------
    SurfaceFit
        The surface and the corrected points; the same bits for the same bits given.

    Raises
    ------
    BadInputError
        Breaks that do not rise, parameters beyond them, a penalty below 0, or points
        that leave control points free.
    """
    where = f"in the fit of {name!r}"
    breaks = (
        checked_breaks(breaks_u, "breaks_u", where),
        checked_breaks(breaks_v, "breaks_v", where),
    )
    _check(samples, breaks, smoothing, where)
    factors = [start] * min(stiff, rounds - 1) + [1.0] * (rounds - min(stiff, rounds - 1))
    found = solve_once(name, samples, breaks, smoothing * factors[0], held)
    for factor in factors[1:]:
        found = solve_once(name, found.samples, breaks, smoothing * factor, held)
    return found


def _check(
    samples: Samples, breaks: tuple[FloatArray, FloatArray], smoothing: float, where: str
) -> None:
    """Refuse points that lie beyond the breaks, and a penalty that is none."""
    not_negative(smoothing, "smoothing", where)
    if not len(samples):
        raise BadInputError("there are no points", where, "give points of lines")
    for axis, each in enumerate(breaks):
        at = samples.uv[:, axis]
        bad = at[~((at >= each[0]) & (at <= each[-1]))]
        if len(bad):
            raise BadInputError(
                f"{'uv'[axis]} of a point is {bad[0]:g}",
                where, f"give parameters from {each[0]:g} to {each[-1]:g}",
            )  # fmt: skip


def solve_once(
    name: str,
    samples: Samples,
    breaks: tuple[FloatArray, FloatArray],
    smoothing: float,
    held: HeldControls | None = None,
    steps: int = STEPS,
) -> SurfaceFit:
    """Solve once with the parameters as they are, then correct them; see `fit_surface`.

    `breaks` are those of both parameters, `steps` those of the correction.
    """
    knots = clamped_knots(breaks[0]), clamped_knots(breaks[1])
    where = f"in the fit of {name!r}"
    net = solve_controls(samples, knots[0], knots[1], smoothing, held, where)
    surface = SplineSurface(name, (DEGREE, DEGREE), knots[0], knots[1], net)
    uv, away = foot_points(surface, samples.point, samples.uv, held=samples.held, steps=steps)
    return SurfaceFit(surface, attrs.evolve(samples, uv=uv), away, smoothing)


# --------------------------------------------------------------------------------------
# More knots where it does not follow its points.

PASSES = 4
"""How often spans are halved at most."""

Breaks = tuple[FloatArray, FloatArray]


def fit_refined(
    name: str,
    samples: Samples,
    breaks_u: FloatArray,
    breaks_v: FloatArray,
    smoothing: float,
    tolerance: float,
    *,
    held: Callable[[FloatArray, FloatArray], HeldControls] | None = None,
    rounds: int = ROUNDS,
    start: float = START,
    stiff: int = STIFF,
    passes: int = PASSES,
    enough: Callable[[SurfaceFit], bool] | None = None,
) -> SurfaceFit:
    """Fit, halve spans whose points stay further off than the tolerance, and fit again.

    Parameters
    ----------
    name, samples, breaks_u, breaks_v, smoothing, rounds, start, stiff
        As of `fit_surface`.
    tolerance : float, m
        What 95 % of the points of a span, right across the surface, may be off.
    held : callable, optional
        Gives what is held for breaks in u and in v.
    passes : int
        How often to halve at most: spans of u or spans of v, whichever leaves less beyond the
        tolerance. There are never more control points than points.
    enough : callable, optional
        Says whether a fit will do as it is: no spans are halved then.

    Returns
    -------
    SurfaceFit
        The last fit; some spans may still be off, as its residuals tell.

    Raises
    ------
    BadInputError
        As of `fit_surface`.
    """
    tolerance = positive(tolerance, "tolerance", f"in the fit of {name!r}")
    breaks = np.array(breaks_u, np.float64), np.array(breaks_v, np.float64)
    holding = held if held is not None else _nothing
    found = fit_surface(
        name, samples, *breaks, smoothing,
        held=holding(*breaks), rounds=rounds, start=start, stiff=stiff,
    )  # fmt: skip
    for _ in range(passes):
        if enough is not None and enough(found):
            break
        best = min(
            (
                (_excess(trial, tolerance), axis, finer, trial)
                for axis in (0, 1)
                if (finer := _finer(found, breaks, tolerance, axis)) is not None
                for trial in [solve_once(name, found.samples, finer, smoothing, holding(*finer))]
            ),
            key=lambda each: each[:2],
            default=None,
        )
        if best is None:
            break
        _, _, breaks, found = best
        for _ in range(max(rounds // 2 - 1, 0)):
            found = solve_once(name, found.samples, breaks, smoothing, holding(*breaks))
    return found


def _nothing(breaks_u: FloatArray, breaks_v: FloatArray) -> None:
    """Hold nothing."""


def _excess(found: SurfaceFit, tolerance: float) -> float:
    """Give by how much points are off beyond the tolerance, times the lengths they stand for."""
    return float((found.samples.weight * np.maximum(found.residual - tolerance, 0.0)).sum())


def _finer(found: SurfaceFit, breaks: Breaks, tolerance: float, axis: int) -> Breaks | None:
    """Halve spans of one parameter that do not follow; None if none is, or points are too few."""
    at = found.samples.uv[:, axis]
    which = spans_to_halve(breaks[axis], at, found.residual, tolerance)
    both = list(breaks)
    both[axis] = halve_spans(breaks[axis], which)
    count = (len(both[0]) + DEGREE - 1) * (len(both[1]) + DEGREE - 1)
    return (both[0], both[1]) if which.any() and count <= len(found.samples) else None
