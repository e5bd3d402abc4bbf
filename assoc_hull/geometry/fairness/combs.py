"""Curvature along curves: combs for the eye, and numbers for how unfair a comb is.

`comb_teeth` gives the teeth of a drawing. `curvature_sign_changes`, `sampled_curvatures` and
`comb_integrals` say the same in numbers, before and after a curve was varied: so they forgive
what nobody sees, curvature within a dead band. That is another count than `inflections`, which
looks at how far the tangent turns: a long flat wave turns much and bends little.
"""

from __future__ import annotations

import itertools

import attrs
import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.polynomials import differentiate, horner
from assoc_hull.geometry.numeric.quadrature import gauss
from assoc_hull.geometry.numeric.vectors import check_normals, dot
from assoc_hull.geometry.splines.segments import (
    plane_curvature,
    power_coefficients,
    segment_curve,
    segment_start,
    space_curvature,
    sum_per_curve,
)

__all__ = [
    "DEAD_BAND",
    "comb_integrals",
    "comb_teeth",
    "curvature_sign_changes",
    "sampled_curvatures",
    "signs_without_waves",
]


def comb_teeth(
    batch: SplineBatch, normals: ArrayLike, per_segment: int = 8, scale: float = 1.0
) -> tuple[FloatArray, FloatArray]:
    """Give curvature combs: points of the curves, and the tips of the teeth on them.

    A tooth points to the centre of curvature and is `scale` times the curvature long; with
    a negative scale the comb stands on the outside. Both ends of each segment have a tooth,
    so that a knuckle shows both of its curvatures.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    normals : (m, 3) or (3,)
        Unit normal of the plane of each curve; a row of nan for the comb of a space curve.
    per_segment : int
        Teeth on each segment, two or more.
    scale : float
        Length of a tooth (m) at unit curvature (1/m), m2.

    Returns
    -------
    base : (s, per_segment, 3), m
        Points at equal steps of the parameter, segment by segment.
    tip : (s, per_segment, 3), m
        The tips; nan where the curve has no direction.

    Raises
    ------
    BadInputError
        A normal is not of unit length, or there are fewer than two teeth per segment.
    TooFewPointsError
        A curve has fewer than two points.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.geometry.fairness.combs import comb_teeth
    >>> xyz = np.array([[0.0, 0, 0], [2, 0, 0]])
    >>> leave, arrive = np.array([[1.0, -2, 0]] * 2), np.array([[1.0, 2, 0]] * 2)
    >>> parabola = SplineBatch(np.array([0, 2]), np.array([0.0, 2]), xyz, leave, arrive)
    >>> base, tip = comb_teeth(parabola, [0, 0, 1], per_segment=3, scale=0.5)
    >>> base[0, 1].tolist(), tip[0, 1].tolist()
    ([1.0, -1.0, 0.0], [1.0, 0.0, 0.0])
    """
    if per_segment < 2:
        raise BadInputError(
            f"{per_segment} teeth per segment", "in a curvature comb", "give two or more"
        )
    normal = check_normals(normals, batch.count)[segment_curve(batch), None]
    cubics = power_coefficients(batch)
    u = np.broadcast_to(np.linspace(0.0, 1.0, per_segment), (len(cubics), per_segment))
    slopes = differentiate(cubics)
    base = horner(cubics, u).copy()
    base[:, -1] = batch.xyz[segment_start(batch) + 1]
    tooth = _teeth(horner(slopes, u), horner(differentiate(slopes), u), normal)
    tip = base + scale * tooth
    freeze(base, tip)
    return base, tip


def _teeth(first: FloatArray, second: FloatArray, normal: FloatArray) -> FloatArray:
    """Give curvature vectors: in the plane where there is one, else in space."""
    left = np.cross(normal, first)
    size = np.sqrt(dot(left, left))
    with np.errstate(invalid="ignore", divide="ignore"):
        signed = plane_curvature(first, second, normal) / size
    return np.where(np.isnan(normal), space_curvature(first, second), signed[..., None] * left)


# --------------------------------------------------------------------------------------
# How unfair curves are, in numbers.

DEAD_BAND = 2e-3
"""Curvature, 1/m, that nobody sees: a radius of 500 m."""

_SAMPLES = 17
"""Places on each segment, both ends among them, where the sign is looked at."""

_NODES = 8
"""Places of Gauss's rule on each segment."""


def curvature_sign_changes(batch: SplineBatch, normals: ArrayLike, band: float) -> IntArray:
    """Count the changes of sign of the curvature beyond a dead band, along each curve.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    normals : (m, 3) or (3,)
        Unit normal of the plane that each curve is seen in; a row of nan counts 0.
    band : float, 1/m
        Curvature up to this, of either sign, has none.

    Returns
    -------
    (m,) int
        Changes along each curve. A knuckle is no bend, and begins no new count.

    Raises
    ------
    BadInputError
        A normal is not of unit length, or the band is negative.
    TooFewPointsError
        A curve has fewer than two points.
    """
    return sampled_curvatures(batch, normals).sign_changes(band)


@attrs.frozen(eq=False)
class SampledCurvatures:
    """The signed curvature at places along curves.

    Attributes
    ----------
    count : int
        How many curves there are.
    curve : (n,) int
        The curve of each place, rising.
    value : (n,), 1/m
        nan where a curve has no plane.
    """

    count: int
    curve: IntArray
    value: FloatArray

    def sign_changes(self, band: float) -> IntArray:
        """Count the changes of sign beyond a dead band (1/m) along each curve, (m,)."""
        if not band >= 0.0:
            raise BadInputError(
                f"a dead band of {band} 1/m", "where signs of curvature were counted",
                "give 0 or more",
            )  # fmt: skip
        # The comparison is false for nan, which drops curves that have no plane, and cusps.
        beyond = np.flatnonzero(np.abs(self.value) > band)
        sign, owner = self.value[beyond] > 0.0, self.curve[beyond]
        changed = (sign[1:] != sign[:-1]) & (owner[1:] == owner[:-1])
        found: IntArray = np.bincount(owner[1:][changed], minlength=self.count)
        freeze(found)
        return found

    def greatest(self) -> FloatArray:
        """Give the greatest amount along each curve, (m,), 1/m; 0 where it has no plane."""
        value = np.nan_to_num(np.abs(self.value), posinf=np.inf)
        first = np.searchsorted(self.curve, np.arange(self.count))
        found: FloatArray = np.maximum.reduceat(value, first) if len(value) else np.zeros(0)
        freeze(found)
        return found


def sampled_curvatures(batch: SplineBatch, normals: ArrayLike) -> SampledCurvatures:
    """Give the signed curvature at places along curves, seen in planes with unit normals."""
    first, second, normal = _derivatives(batch, normals, np.linspace(0.0, 1.0, _SAMPLES), 2)
    # As `plane_curvature`, by components: such arrays are one piece each.
    flat = first - _dot(first, normal) * normal
    with np.errstate(invalid="ignore", divide="ignore"):
        value = _dot(normal, _cross(first, second)) / np.sqrt(_dot(flat, flat)) ** 3
    owner = np.repeat(segment_curve(batch), _SAMPLES)
    return SampledCurvatures(batch.count, owner, np.ascontiguousarray(value).ravel())


def signs_without_waves(
    value: FloatArray, turn: FloatArray, curve: IntArray, most: int
) -> NDArray[np.int8]:
    """Give the signs that curvature along a line would have without its smallest waves.

    Parameters
    ----------
    value : (n,), 1/m
        Curvature at places along the curves of a line, one curve after the other.
    turn : (n,), rad
        By how much the tangent turns about each place.
    curve : (n,) int
        The curve of each place.
    most : int
        So many changes of sign may be left over all curves.

    Returns
    -------
    (n,) int8
        1 or -1; 0 between two runs of different signs, where there is none beyond the dead band.

    Examples
    --------
    A small hollow between two rounds goes:

    >>> import numpy as np
    >>> from assoc_hull.geometry.fairness.combs import signs_without_waves
    >>> value, one = np.array([0.1, 0.2, -0.01, 0.1, 0.0, -0.3]), np.zeros(6, np.int64)
    >>> signs_without_waves(value, np.abs(value), one, 1).tolist()
    [1, 1, 1, 1, 0, -1]
    """
    runs = _runs_of_sign(value, turn, curve)
    while (meets := _changing(runs)).sum() > most:
        beside = np.append(False, meets) | np.append(meets, False)
        least = int(
            np.argmin(
                [run.turn if near else np.inf for run, near in zip(runs, beside, strict=True)]
            )
        )
        first = least - int(np.append(False, meets)[least])
        last = least + int(np.append(meets, False)[least])
        parts = runs[first : last + 1]
        runs[first : last + 1] = [
            _Run(-runs[least].sign, parts[0].first, parts[-1].last, runs[least].curve,
                 sum(part.turn for part in parts))
        ]  # fmt: skip
    signs = np.zeros(len(value), np.int8)
    for run in runs:
        signs[run.first : run.last + 1] = run.sign
    return signs


@attrs.frozen
class _Run:
    """Places of a curve, from the first to the last, where curvature is of one sign."""

    sign: int
    first: int
    last: int
    curve: int
    turn: float


def _runs_of_sign(value: FloatArray, turn: FloatArray, curve: IntArray) -> list[_Run]:
    """Part places beyond the dead band into runs of one sign, on one curve."""
    beyond = np.flatnonzero(np.abs(value) > DEAD_BAND)
    sign = np.sign(value[beyond]).astype(np.int64)
    new = (np.diff(sign) != 0) | (np.diff(curve[beyond]) != 0)
    return [
        _Run(int(np.sign(value[part[0]])), int(part[0]), int(part[-1]), int(curve[part[0]]),
             float(turn[part].sum()))
        for part in np.split(beyond, np.flatnonzero(new) + 1) if len(part)
    ]  # fmt: skip


def _changing(runs: list[_Run]) -> NDArray[np.bool_]:
    """Say which runs are followed by one of the same curve."""
    return np.array([one.curve == other.curve for one, other in itertools.pairwise(runs)], np.bool_)


def _derivatives(
    batch: SplineBatch, normals: ArrayLike, u: FloatArray, count: int
) -> tuple[FloatArray, ...]:
    """Give derivatives (3, s, k) by the segments' parameters, and normals (3, s, 1)."""
    normal = check_normals(normals, batch.count)[segment_curve(batch)]
    cubics, found = power_coefficients(batch), list[FloatArray]()
    at = np.broadcast_to(u, (3 * len(cubics), len(u)))
    for _ in range(count):
        cubics = differentiate(cubics)
        # One polynomial a component.
        rows = np.moveaxis(cubics, 2, 0).reshape(-1, cubics.shape[1])
        found.append(horner(rows, at).reshape(3, len(cubics), len(u)))
    return *found, np.ascontiguousarray(normal.T)[:, :, None]


def _dot(left: FloatArray, right: FloatArray) -> FloatArray:
    """Give scalar products of vectors (3, ...), as `dot` does of vectors (..., 3)."""
    product: FloatArray = left[0] * right[0] + left[1] * right[1] + left[2] * right[2]
    return product


def _cross(left: FloatArray, right: FloatArray) -> FloatArray:
    """Give vector products of vectors (3, ...)."""
    return np.stack(
        [
            left[1] * right[2] - left[2] * right[1],
            left[2] * right[0] - left[0] * right[2],
            left[0] * right[1] - left[1] * right[0],
        ]
    )


def comb_integrals(batch: SplineBatch, normals: ArrayLike) -> FloatArray:
    """Give the integral of (dk/ds)^2 ds along each curve, k the curvature in its plane.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    normals : (m, 3) or (3,)
        Unit normal of the plane that each curve is seen in; a row of nan gives 0.

    Returns
    -------
    (m,), 1/m3
        The integrals over the segments; what curvature jumps by at a knuckle is not counted.

    Raises
    ------
    BadInputError
        A normal is not of unit length.
    TooFewPointsError
        A curve has fewer than two points.

    Notes
    -----
    With derivatives by any parameter, c = n . (P' x P'') and w the square of the speed v,
    k = c / v^3, so dk/ds = (c' w - 1.5 c w') / v^6.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.fairness.combs import comb_integrals
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> xyz = np.array([[0.0, 0, 0], [3, 0, 0]])
    >>> along = np.array([[1.0, 0, 0], [1, 0, 0]])
    >>> line = SplineBatch(np.array([0, 2]), np.array([0.0, 3]), xyz, along, along.copy())
    >>> comb_integrals(line, [0, 0, 1]).tolist()
    [0.0]
    """
    nodes, weights = gauss(_NODES)
    first, second, third, normal = _derivatives(batch, normals, nodes, 3)
    first, second, third = (
        each - _dot(each, normal) * normal for each in (first, second, third)
    )  # fmt: skip
    square, growth = _dot(first, first), 2.0 * _dot(first, second)
    bend = _dot(normal, _cross(first, second))
    turn = _dot(normal, _cross(first, third))
    with np.errstate(invalid="ignore", divide="ignore"):
        # (dk/ds)^2 ds = (c' w - 1.5 c w')^2 / v^12 v du
        density = (turn * square - 1.5 * bend * growth) ** 2 / square**5.5
    inside = np.where(np.isfinite(density), density, 0.0) @ weights
    found = sum_per_curve(batch, inside)
    freeze(found)
    return found
