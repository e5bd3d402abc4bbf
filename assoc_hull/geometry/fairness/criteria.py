"""Criteria of fairness as numbers, and the residual of the loftsman's batten.

Atkins asks of a fair line that its first and second derivatives are continuous, that it has no
unwanted inflections, that it passes its offsets closely, and that it looks natural and smooth.
With phi the direction of a curve, k its curvature, s arc length and L its length:

    first derivative     J1 = the largest jump of phi at inner knots, knuckles left out
    second derivative    J2 = the largest jump of k over max(RMS k, 1 / L), knuckles left out
    inflections          changes of sign of k, less those that are wanted
    deviation            largest, and root mean square, of distance over tolerance of offsets
    look                 E3 = L^3 integral (dk/ds)^2 ds; J3 = root of the sum of squared jumps
                         of y''' (support forces of a batten); number of extremes of k
    energy               E2 = L integral k^2 ds

The first four have a limit; the look of a line can only be compared before and after. E2 and E3
have no unit and do not change with scale. An arc has no slope of curvature: a chain of arcs has
E3 = L^3 sum (dk)^2 / ds between their middles, and no J3.

Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK, for the criteria; the numbers are our reading of them.

The batten residual: how far a batten springs off a point that it is lifted from.

The loftsman lifts the batten off one nail and lets it run through the two points on either side:
the distance it springs is the residual of the point. For five neighbouring points at parameters t
it is their divided difference of order four,

    c_j = prod over k != j of 1 / (t_j - t_k),  scaled so that the largest |c_j| is 1,
    residual = sum over j of c_j P_j

so it is a length, and every cubic has none.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.quadrature import gauss
from assoc_hull.geometry.splines.curve_pieces import PieceDerivatives, PiecewiseCurves

__all__ = [
    "LIMITS",
    "WINDOW",
    "FairnessLimits",
    "FairnessRecord",
    "OffsetDeviations",
    "batten_coefficients",
    "batten_sharpness",
    "criteria",
]

WINDOW = 5
"""Points of a window: the one that is asked about, and two on either side."""


def batten_coefficients(nodes: FloatArray) -> FloatArray:
    """Give the coefficients of the residual of windows, (n, 5), for their parameters, (n, 5).

    The parameters of a window rise; the largest coefficient of each is 1 in size.
    """
    found = _unscaled(nodes)
    found /= np.abs(found).max(axis=1, keepdims=True)
    return found


def batten_sharpness(nodes: FloatArray) -> FloatArray:
    """Give what times a residual of windows (n, 5) is a divided difference, (n,), 1/m4.

    Those of two lines that run alike are alike, however their points are spaced.
    """
    found: FloatArray = np.abs(_unscaled(nodes)).max(axis=1)
    return found


def _unscaled(nodes: FloatArray) -> FloatArray:
    apart = nodes[:, :, None] - nodes[:, None, :]
    apart[:, np.arange(WINDOW), np.arange(WINDOW)] = 1.0
    found: FloatArray = 1.0 / apart.prod(axis=2)
    return found


_NODES = 8
_SAMPLES = 20
_DEAD = 1e-3
"""Of the greatest amount: what is less has no sign."""

_STRAIGHT = 1e-6
"""Curvature times length up to which a curve is straight, and its bends are rounding."""


@attrs.frozen
class FairnessLimits:
    """Up to which values the first four criteria hold.

    Attributes
    ----------
    angle : float, rad
        Of J1.
    curvature : float
        Of J2.
    deviation : float
        Of the largest distance over its tolerance.
    """

    angle: float = 1e-6
    curvature: float = 1e-3
    deviation: float = 1.0


LIMITS = FairnessLimits()


@attrs.frozen(eq=False)
class OffsetDeviations:
    """Points that curves are meant to pass, by how much each has gone astray.

    Attributes
    ----------
    curve : (k,) int
        The curve that each belongs to.
    distance, tolerance : (k,), m
        How far off it lies, and may lie.
    """

    curve: IntArray
    distance: FloatArray
    tolerance: FloatArray

    @classmethod
    def measured(
        cls, pieces: PiecewiseCurves, points: ArrayLike, tolerances: ArrayLike
    ) -> OffsetDeviations:
        """Measure points (k, d), m, from the first curve; one tolerance (m), or one each.

        Raises
        ------
        GeometryError
            ``"fairness: offsets and tolerances differ in length"``; numbers that are not finite,
            or tolerances that are not above 0.
        """
        try:
            given, allowed = np.array(points, np.float64), np.array(tolerances, np.float64)
        except (TypeError, ValueError, OverflowError):
            raise _no_offsets() from None
        if given.ndim != 2 or given.shape[1] not in (2, 3) or not np.isfinite(given).all():
            raise _no_offsets()
        if allowed.ndim and allowed.shape != given.shape[:1]:
            raise GeometryError(
                "fairness: offsets and tolerances differ in length",
                "give one tolerance, or one for each offset",
                {"offsets": len(given), "tolerances": allowed.size},
            )
        if not (np.isfinite(allowed).all() and (allowed > 0.0).all()):
            raise GeometryError("fairness: tolerances must be above 0", "give lengths in m")
        curve = np.zeros(len(given), np.int64)
        away = pieces.distance(curve, given) if len(given) else np.zeros(0)
        return cls(curve, away, np.broadcast_to(allowed, (len(given),)))


def _no_offsets() -> GeometryError:
    return GeometryError("fairness: offsets are not points", "give rows of 2 or 3 finite numbers")


@attrs.frozen
class FairnessRecord:
    """The numbers of one curve.

    Attributes
    ----------
    name : str
        Of the curve.
    length : float, m
        L.
    knuckles : int
        Joints that were left out.
    angle_jump : float, rad
        J1.
    curvature_jump : float
        J2.
    angle_at, curvature_at : int or None
        Knot (from 0) of the largest jump; None where there is none.
    inflections : int or None
        Changes of sign of curvature; None in space, where it has no sign.
    inflections_allowed : int
        That are wanted.
    deviation_max, deviation_rms : float or None
        Of distance over tolerance; None without offsets.
    offsets : int
        Points that it was measured at.
    bending : float
        E2.
    variation : float
        E3.
    support_jumps : float or None, 1/m2
        J3; None of arcs.
    extrema : int
        Extremes of curvature.
    limits : FairnessLimits
        What is passed or failed by.
    """

    name: str
    length: float
    knuckles: int
    angle_jump: float
    curvature_jump: float
    angle_at: int | None
    curvature_at: int | None
    inflections: int | None
    inflections_allowed: int
    deviation_max: float | None
    deviation_rms: float | None
    offsets: int
    bending: float
    variation: float
    support_jumps: float | None
    extrema: int
    limits: FairnessLimits = attrs.field(default=LIMITS, repr=False)

    @property
    def unwanted_inflections(self) -> int | None:
        """Inflections beyond those that are wanted, at least 0; None in space."""
        if self.inflections is None:
            return None
        return max(0, self.inflections - self.inflections_allowed)

    @property
    def passed(self) -> dict[str, bool | None]:
        """Tell by criterion whether its limit is kept; None where there is nothing to tell."""
        unwanted, deviation = self.unwanted_inflections, self.deviation_max
        return {
            "first derivative": self.angle_jump <= self.limits.angle,
            "second derivative": self.curvature_jump <= self.limits.curvature,
            "inflections": None if unwanted is None else unwanted == 0,
            "deviation": None if deviation is None else deviation <= self.limits.deviation,
            "look": None,
        }

    @property
    def failed(self) -> tuple[str, ...]:
        """The criteria whose limit is not kept."""
        return tuple(name for name, kept in self.passed.items() if kept is False)


def criteria(
    pieces: PiecewiseCurves,
    *,
    names: Sequence[str] = (),
    knuckles: NDArray[np.bool_] | None = None,
    allowed: int | IntArray = 0,
    offsets: OffsetDeviations | None = None,
    limits: FairnessLimits = LIMITS,
) -> tuple[FairnessRecord, ...]:
    """Take the numbers of curves.

    Parameters
    ----------
    pieces : PiecewiseCurves
        The curves, m of them.
    names : sequence of m str, optional
        What they are called.
    knuckles : (p - 1,) bool, optional
        For each piece but the last, whether it ends at a knuckle.
    allowed : int or (m,) int
        Inflections that are wanted.
    offsets : OffsetDeviations, optional
        Points that the curves are meant to pass.
    limits : FairnessLimits
        Of the criteria.

    Raises
    ------
    GeometryError
        ``"fairness: curve has no length"``, with its name.

    Examples
    --------
    >>> import numpy as np
    >>> from scipy.interpolate import CubicSpline
    >>> from assoc_hull.geometry.fairness.criteria import criteria
    >>> from assoc_hull.geometry.splines.curve_pieces import GraphPieces
    >>> y = [0, 1, 1.8, 2.45, 2.85, 3.1, 3.2]
    >>> record = criteria(GraphPieces.of(CubicSpline(np.arange(7.0), y, bc_type="natural")))[0]
    >>> round(record.variation, 8), round(record.support_jumps, 10), record.inflections
    (41.94225245, 0.9759219583, 0)
    """
    owner, count = pieces.owner, len(pieces.signed)
    titles = tuple(names) or ("curve",) * count
    wanted = np.broadcast_to(np.asarray(allowed, np.int64), (count,))
    nodes, weights = gauss(_NODES)
    inner = pieces.seen(nodes)
    first = np.searchsorted(owner, np.arange(count))
    size = _summed(inner.speed * weights, first)
    _check_lengths(size, titles)
    square = _summed(inner.curvature**2 * inner.speed * weights, first)
    bending = size * square
    joint = owner[1:] == owner[:-1]
    knuckle = np.zeros(len(joint), np.bool_) if knuckles is None else knuckles & joint
    grid = pieces.seen(np.linspace(0.0, 1.0, _SAMPLES))
    jumps = _Jumps.across(grid, joint & ~knuckle)
    scale = np.maximum(np.sqrt(square / size), 1.0 / size)
    angles, angles_at = jumps.largest(jumps.angle, owner, count)
    steps, steps_at = jumps.largest(jumps.curvature, owner, count)
    if pieces.of_arcs:
        variation, extrema = _arcs(inner, weights, owner, count)
        supports: FloatArray | None = None
    else:
        variation = _summed(inner.rate**2 * inner.speed * weights, first)
        extrema = _sign_changes(grid.rate, owner, count, _STRAIGHT / size**2)
        supports = np.sqrt(np.bincount(owner[:-1], jumps.third**2, minlength=count))
    changes = _sign_changes(grid.curvature, owner, count, _STRAIGHT / size)
    hits, worst, rms = _deviation(offsets, count)
    bent = np.bincount(owner[:-1][knuckle], minlength=count)
    return tuple(
        FairnessRecord(
            titles[i], float(size[i]), int(bent[i]), float(angles[i]),
            float(steps[i] / scale[i]),
            _knot(angles_at[i], first[i]), _knot(steps_at[i], first[i]),
            int(changes[i]) if pieces.signed[i] else None, int(wanted[i]),
            float(worst[i]) if hits[i] else None, float(rms[i]) if hits[i] else None,
            int(hits[i]), float(bending[i]), float(size[i] ** 3 * variation[i]),
            None if supports is None else float(supports[i]), int(extrema[i]), limits,
        )
        for i in range(count)
    )  # fmt: skip


def _summed(parts: FloatArray, first: IntArray) -> FloatArray:
    """Add up parts (p, k) of each curve: elementwise, so that a neighbour changes no bit."""
    found: FloatArray = np.add.reduceat(parts.sum(axis=1), first)
    return found


def _check_lengths(size: FloatArray, titles: Sequence[str]) -> None:
    none = np.flatnonzero(~(size > 0.0))
    if len(none):
        raise GeometryError(
            "fairness: curve has no length", "leave it out", {"curve": int(none[0])},
            titles[none[0]],
        )  # fmt: skip


def _knot(joint: int, first: int) -> int | None:
    """Give the knot of its own curve at which a joint lies."""
    return int(joint - first) + 1 if joint >= 0 else None


@attrs.frozen(eq=False)
class _Jumps:
    """What jumps between each piece and the next: 0 where they are no neighbours."""

    angle: FloatArray
    curvature: FloatArray
    third: FloatArray

    @classmethod
    def across(cls, ends: PieceDerivatives, counted: NDArray[np.bool_]) -> _Jumps:
        before, after = ends.tangent[:-1, -1], ends.tangent[1:, 0]
        apart = np.sqrt(((after - before) ** 2).sum(axis=1))
        # The chord between unit vectors tells small angles with all digits.
        angle = 2.0 * np.arcsin(np.clip(0.5 * apart, 0.0, 1.0))
        step = np.sqrt(((ends.bend[1:, 0] - ends.bend[:-1, -1]) ** 2).sum(axis=1))
        if ends.tangent.shape[2] == 2:
            step = np.abs(ends.curvature[1:, 0] - ends.curvature[:-1, -1])
        third = ends.third[1:, 0] - ends.third[:-1, -1]
        return cls(*(np.where(counted, each, 0.0) for each in (angle, step, third)))

    def largest(self, jump: FloatArray, owner: IntArray, count: int) -> tuple[FloatArray, IntArray]:
        """Give the largest jump of each curve, and the joint where it is (-1 without one)."""
        found, at = np.zeros(count), np.full(count, -1)
        order = np.argsort(jump, kind="stable")
        order = order[jump[order] > 0.0]
        found[owner[order]], at[owner[order]] = jump[order], order
        return found, at


def _sign_changes(value: FloatArray, owner: IntArray, count: int, least: FloatArray) -> IntArray:
    """Count changes of sign of values (p, k) along each curve, those near zero left out."""
    line = np.repeat(owner, value.shape[1])
    flat = value.ravel()
    greatest = np.zeros(count)
    np.maximum.at(greatest, line, np.abs(flat))
    told = np.flatnonzero(np.abs(flat) > np.maximum(_DEAD * greatest, least)[line])
    sign, mine = flat[told] > 0.0, line[told]
    changed = (sign[1:] != sign[:-1]) & (mine[1:] == mine[:-1])
    return np.bincount(mine[1:][changed], minlength=count)


def _arcs(
    inner: PieceDerivatives, weights: FloatArray, owner: IntArray, count: int
) -> tuple[FloatArray, IntArray]:
    """Give the sum of squared steps of curvature over distances between middles; extremes."""
    length, bend = (inner.speed * weights).sum(axis=1), inner.curvature[:, 0]
    joint = owner[1:] == owner[:-1]
    apart = 0.5 * (length[1:] + length[:-1])
    step = np.where(joint, np.diff(bend), 0.0)
    variation = np.bincount(owner[:-1], step**2 / apart, minlength=count)
    return np.asarray(variation, np.float64), _sign_changes(
        step[:, None], owner[:-1], count, np.zeros(count)
    )


def _deviation(
    offsets: OffsetDeviations | None, count: int
) -> tuple[IntArray, FloatArray, FloatArray]:
    """Count the offsets of each curve; largest and root mean square of distance over tolerance."""
    worst, squares = np.zeros(count), np.zeros(count)
    if offsets is None:
        return np.zeros(count, np.int64), worst, squares
    share = offsets.distance / offsets.tolerance
    hits = np.bincount(offsets.curve, minlength=count)
    np.maximum.at(worst, offsets.curve, share)
    np.add.at(squares, offsets.curve, share**2)
    return hits.astype(np.int64), worst, np.sqrt(squares / np.maximum(hits, 1))
