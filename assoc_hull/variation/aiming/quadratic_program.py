"""The step of aiming: a small quadratic problem with equations and bounds, solved exactly.

    least of 1/2 p H p + g p    where    A p = b    and    low <= p <= high

The equations are met by their least solution and a step in their null space (singular values);
bounds make the rest a problem of least distance, which is one of non-negative least squares
(Lawson & Hanson, "Solving Least Squares Problems", 1974, ch. 23). With the bounds known that
hold, it is solved once more as if there were no others.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray

__all__ = ["RANK", "Quadratic", "least_squares_step", "split"]

RANK = 1e-10
"""Singular values below this part of the largest are nil."""

_OUT = 1e-12
"""So far beyond a bound (times 1 + its distance) a step is still taken to be within,"""

_OFF = 1e-9
"""and equations so much off (times their right sides) to be met: Newton's next step mends it."""

_ROUNDING = 1e-14

_NEAR = 1e-6
"""The step solved once more lies so near to the first one (times 1 + its size), or is not used."""

_FLAT = 1e-7
"""The cost of a step of 1 that misses nothing, beside the largest effect that it can have."""

_Bools = NDArray[np.bool_]


def split(matrix: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give the pseudoinverse of a matrix (m, k), and a basis of its null space, (k, n).

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.aiming.quadratic_program import split
    >>> inverse, null = split(np.array([[2.0, 0.0, 0.0]]))
    >>> inverse.T.tolist(), null.shape
    ([[0.5, 0.0, 0.0]], (3, 2))
    """
    left, values, right = np.linalg.svd(matrix, full_matrices=True)
    rank = int((values > RANK * values.max(initial=0.0)).sum())
    inverse = (right[:rank].T / values[:rank]) @ left[:, :rank].T
    return inverse, right[rank:].T


@attrs.frozen(eq=False)
class Quadratic:
    """A quadratic problem with equations and bounds.

    Attributes
    ----------
    H : (k, k) float
        Symmetric and positive definite.
    g : (k,) float
        The gradient without a step.
    A, b : (m, k), (m,) float
        Equations; m may be 0. Rows that depend on others must agree with them.
    low, high : (k,) float
        Bounds of the step, low <= 0 <= high; may be infinite.

    Examples
    --------
    The nearest place to the origin on a line, without bounds and within some:

    >>> import numpy as np
    >>> from assoc_hull.variation.aiming.quadratic_program import Quadratic
    >>> def nearest(high):
    ...     unit, line, free = np.eye(2), np.ones((1, 2)), np.full(2, np.inf)
    ...     return Quadratic(unit, np.zeros(2), line, np.array([2.0]), -free, np.array(high)).step()
    >>> nearest([np.inf, np.inf]).round(12).tolist()
    [1.0, 1.0]
    >>> nearest([0.5, 9.0]).round(12).tolist()
    [0.5, 1.5]
    >>> nearest([0.5, 1.0]) is None
    True
    """

    H: FloatArray
    g: FloatArray
    A: FloatArray
    b: FloatArray
    low: FloatArray
    high: FloatArray

    def step(self) -> FloatArray | None:
        """Give the best step, (k,); None where no step meets equations and bounds."""
        found = self._unbounded()
        if found is None:
            return None
        step, ways = found
        if not self._within(step):
            held = self._held(step, ways)
            if held is None:
                return None
            step = self._polished(*held)
        inside: FloatArray = np.clip(step, self.low, self.high)
        return inside if self._solved(inside) else None

    def _solved(self, step: FloatArray) -> bool:
        """Tell whether a step meets the equations."""
        off = np.abs(self.A @ step - self.b).max(initial=0.0)
        sums = np.abs(self.A) @ np.abs(step)
        size = _OFF * np.abs(self.b).max(initial=0.0) + _ROUNDING * sums.max(initial=0.0)
        return bool(off <= size)

    def _unbounded(self) -> tuple[FloatArray, FloatArray] | None:
        """Give the step without bounds, and ways to leave it, (k, n), that cost alike."""
        inverse, null = split(self.A) if len(self.A) else (self.A.T, np.eye(len(self.g)))
        step = inverse @ self.b
        if not self._solved(step):
            return None
        ways: FloatArray = null @ np.linalg.inv(np.linalg.cholesky(null.T @ self.H @ null)).T
        return step - ways @ (ways.T @ (self.g + self.H @ step)), ways

    def _within(self, step: FloatArray) -> bool:
        """Tell whether a step keeps within bounds, to rounding."""
        over = np.maximum(self.low - step, step - self.high)
        return bool((over <= _OUT * (1.0 + np.abs(step))).all())

    def _held(self, step: FloatArray, ways: FloatArray) -> tuple[FloatArray, _Bools, _Bools] | None:
        """Bring a step within bounds at the least cost; say which low and high bounds hold it."""
        from scipy.optimize import nnls

        low, high = np.isfinite(self.low), np.isfinite(self.high)
        walls = np.concatenate([ways[low], -ways[high]])
        beyond = np.concatenate([(self.low - step)[low], (step - self.high)[high]])
        unit = np.append(np.zeros(ways.shape[1]), 1.0)
        matrix = np.vstack([walls.T, beyond])
        try:
            forces, _ = nnls(matrix, unit, maxiter=30 * len(beyond) + 30)
        except RuntimeError:  # it went round in a circle: the bounds leave next to nothing
            return None
        rest = unit - matrix @ forces
        if rest[-1] < _OFF**2:
            return None
        at_low, at_high = np.zeros_like(low), np.zeros_like(high)
        at_low[low], at_high[high] = np.split(forces > 0.0, [low.sum()])
        return step - ways @ rest[:-1] / rest[-1], at_low, at_high

    def _polished(self, near: FloatArray, at_low: _Bools, at_high: _Bools) -> FloatArray:
        """Solve once more with what is held at its bounds, which leaves no rounding there."""
        free = ~(at_low | at_high)
        step = np.where(at_low, self.low, np.where(at_high, self.high, 0.0))
        if free.any():
            rest = attrs.evolve(
                self, H=self.H[np.ix_(free, free)], g=(self.g + self.H @ step)[free],
                A=self.A[:, free], b=self.b - self.A @ step,
            )._unbounded()  # fmt: skip
            if rest is None:
                return near
            step[free] = rest[0]
        off = np.abs(step - near).max()
        return step if off <= _NEAR * (1.0 + np.abs(near).max()) else near


def least_squares_step(
    A: FloatArray, b: FloatArray, low: FloatArray, high: FloatArray
) -> FloatArray:
    """Give the step, (k,), within bounds that comes nearest to A p = b.

    Of steps that come alike near it is a short one: directions that change next to nothing are
    not used.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.aiming.quadratic_program import least_squares_step
    >>> high = np.array([0.5, 1.0])
    >>> least_squares_step(np.ones((1, 2)), np.array([2.0]), -high, high).round(9).tolist()
    [0.5, 1.0]
    """
    from scipy.optimize import lsq_linear

    weight = _FLAT * (float(np.linalg.norm(A, 2)) or 1.0)
    matrix = np.vstack([A, weight * np.eye(A.shape[1])])
    right = np.append(b, np.zeros(A.shape[1]))
    wide = low < high  # the rule wants some room between bounds
    step = np.zeros(len(low))
    if wide.any():
        limits = low[wide], high[wide]
        step[wide] = lsq_linear(matrix[:, wide], right, limits, method="bvls", tol=1e-15).x
    return np.clip(step, low, high)
