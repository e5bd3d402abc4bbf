"""A cubic spline through samples of a curve, with a penalty on the change of curvature."""

from __future__ import annotations

from typing import Any

import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = ["PenalisedFit"]

_HOLD = 1e5
"""Weight of what is given at an end, against the data."""


class PenalisedFit:
    """The fits of one curve on given knots.

    Everything is measured in spans, so that long flat and short round parts count alike.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polylines.penalised import PenalisedFit
    >>> at = np.linspace(0.0, 4.0, 41)
    >>> line = np.column_stack([at, 0.5 * at])
    >>> fit = PenalisedFit(at, line, np.full(41, 1e-3), np.linspace(0.0, 4.0, 5))
    >>> bool(fit.off(fit.solve(1.0)).max() < 1e-9)
    True
    """

    def __init__(
        self,
        at: FloatArray,
        data: FloatArray,
        allowed: FloatArray,
        knots: FloatArray,
        first: FloatArray | None = None,
        last: FloatArray | None = None,
    ) -> None:
        """Set up the equations.

        Parameters
        ----------
        at, data, allowed : (n,), (n, d), (n,), m
            Lengths along the curve, places there, and how far the fit may pass them.
        knots : (k + 1,), m
            From the first to the last length.
        first, last : (d,) or None
            Given directions at the ends, along the curve.
        """
        from scipy.interpolate import BSpline

        self.at, self.data, self.allowed, self.knots = at, data, allowed, knots
        self.full = full = np.concatenate([[knots[0]] * 3, knots, [knots[-1]] * 3])
        span = np.diff(knots)
        mine = span[np.clip(np.searchsorted(knots, at, "right") - 1, 0, len(span) - 1)]
        weight = np.gradient(at) / mine * (allowed.mean() / allowed) ** 2
        weight[[0, -1]] = _HOLD * weight.mean()
        lower = [_differences(full, 3 - order, order) for order in range(3)]
        self.basis = BSpline.design_matrix(at, full, 3)
        self.slope = BSpline.design_matrix(at, full[1:-1], 2) @ lower[0]
        third = lower[2] @ lower[1] @ lower[0]
        self.normal = _bands(self.basis.T @ self.basis.multiply(weight[:, None]))
        self.right = np.asarray(self.basis.T @ (weight[:, None] * data))
        self.penalty = _bands(third.T @ third.multiply((span**6)[:, None]))
        for row, given in ((0, first), (-1, last)):
            if given is not None:
                # Lengths are the parameter, so the derivative is the unit direction.
                unit = np.asarray(given, np.float64) / np.linalg.norm(given)
                one = self.slope[[row]]
                size = _HOLD * weight[1:-1].mean() * (span.min() if len(span) else 1.0) ** 2
                self.normal = self.normal + size * _bands(one.T @ one)
                self.right = self.right + size * np.asarray(one.T @ unit[None, :])

    def solve(self, size: float) -> FloatArray:
        """Give the control points for a size of the penalty, (m, d)."""
        return self.respond(size, self.right)

    def respond(self, size: float, right: FloatArray) -> FloatArray:
        """Solve the equations with a size of the penalty for another right side, (m, k)."""
        from scipy.linalg import solveh_banded

        found: FloatArray = solveh_banded(
            self.normal + size * self.penalty, right, lower=True, check_finite=False
        )
        return found

    def scale(self) -> float:
        """Give the size at which penalty and data weigh the same."""
        return float(self.normal[0].sum() / max(float(self.penalty[0].sum()), 1e-300))

    def off(self, control: FloatArray) -> FloatArray:
        """Give the distance of each sample across the curve, (n,), m."""
        away, slope = self.basis @ control - self.data, self.slope @ control
        along = (away * slope).sum(axis=1) / np.maximum((slope * slope).sum(axis=1), 1e-24)
        across = away - along[:, None] * slope
        return np.asarray(np.sqrt((across * across).sum(axis=1)))

    def misfit(self, control: FloatArray) -> float:
        """Give the distance of the samples as a part of what is allowed."""
        part = self.off(control) / self.allowed
        return max(float(np.percentile(part, 98)), 0.5 * float(part.max()))

    def too_coarse(self) -> np.typing.NDArray[np.bool_]:
        """Say which spans to halve: those too far off, and those far longer than a neighbour."""
        off = self.off(self.solve(1e-9 * self.scale()))
        number = np.clip(np.searchsorted(self.knots, self.at, "right") - 1, 0, len(self.knots) - 2)
        worst = np.zeros(len(self.knots) - 1)
        np.maximum.at(worst, number, off / self.allowed)
        span = np.diff(self.knots)
        split = (worst > 1.0) & (np.bincount(number, minlength=len(span)) >= 4)
        after = np.where(split, 0.5 * span, span)
        shorter = np.minimum(np.append(after[1:], np.inf), np.append(np.inf, after[:-1]))
        return np.asarray(split | (span > 3.9 * shorter))

    def largest(self) -> float:
        """Give the largest penalty with which the fit stays as near as allowed."""
        low, high = np.log(self.scale()) - 18.0, np.log(self.scale()) + 25.0
        for _ in range(14):
            middle = 0.5 * (low + high)
            if self.misfit(self.solve(float(np.exp(middle)))) <= 1.0:
                low = middle
            else:
                high = middle
        return float(np.exp(low))

    def rows(self, at: FloatArray) -> Any:
        """Give the sparse matrix from control points to places at lengths within the ends."""
        from scipy.interpolate import BSpline

        return BSpline.design_matrix(np.clip(at, self.knots[0], self.knots[-1]), self.full, 3)


def _differences(full: FloatArray, degree: int, order: int) -> Any:
    """Give the sparse matrix from control points to those of the derivative."""
    from scipy.sparse import diags_array

    knots = full[order : len(full) - order]
    count = len(knots) - degree - 1
    gap = knots[degree + 1 : degree + count] - knots[1:count]
    size = degree / np.where(gap > 0.0, gap, np.inf)
    both: Any = [-size, size]
    return diags_array(both, offsets=[0, 1], shape=(count - 1, count)).tocsr()


def _bands(matrix: Any) -> FloatArray:
    """Give the diagonal and the three below it, (4, m)."""
    out = np.zeros((4, matrix.shape[0]))
    for i in range(min(4, matrix.shape[0])):
        below = matrix.diagonal(-i)
        out[i, : len(below)] = below
    return out
