"""What aiming asks of a problem, and the same in scaled numbers.

What aiming asks of a problem: outputs of a hull at given amplitudes, and their derivatives.
"""

from __future__ import annotations

from functools import cached_property
from typing import Protocol

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray

__all__ = ["Evaluated", "Iterate", "Problem", "ScaledProblem"]


class Evaluated(Protocol):
    """A certified hull at some amplitudes."""

    @property
    def values(self) -> FloatArray:
        """Outputs in their own units, (m,)."""
        ...

    @property
    def jacobian(self) -> FloatArray:
        """Derivatives of outputs by amplitudes, (m, k); may be computed when first asked for."""
        ...


class Problem(Protocol):
    """Outputs of a hull as functions of amplitudes of its free parameters.

    An amplitude is the change of a named parameter from its present value, in m or degrees, or
    the factor on a layer as it was given.
    """

    @property
    def free(self) -> tuple[str, ...]:
        """Names of the k free parameters."""
        ...

    @property
    def outputs(self) -> tuple[str, ...]:
        """Names of the m outputs that are aimed at."""
        ...

    def at(self, amplitudes: FloatArray) -> Evaluated:
        """Give the hull at amplitudes, (k,).

        Raises
        ------
        AssocHullError
            There is no certified hull there.
        """
        ...


_AT = 1e-12
"""A change so near to a bound (times 1 + |bound|) lies at it."""

_NIL = 1e-9
"""What usual changes move by less than this part of its size they do not move."""


@attrs.frozen(eq=False)
class ScaledProblem:
    """Misses of targets as a function of scaled changes.

    Attributes
    ----------
    problem : Problem
        With k free parameters and m outputs.
    targets, sizes : (m,) float
        What outputs are to be, and the sizes by which their misses are divided; output units.
    origin, usual : (k,) float
        Amplitudes that changes are counted from, and those that count as a change of 1.
    low, high : (k,) float
        Bounds of amplitudes; may be infinite.
    """

    problem: Problem
    targets: FloatArray
    sizes: FloatArray
    origin: FloatArray
    usual: FloatArray
    low: FloatArray
    high: FloatArray

    @cached_property
    def least(self) -> FloatArray:
        """The least scaled changes, (k,)."""
        return (self.low - self.origin) / self.usual

    @cached_property
    def most(self) -> FloatArray:
        """The greatest scaled changes, (k,)."""
        return (self.high - self.origin) / self.usual

    def start(self) -> Iterate:
        """Give the place that is nearest to the origin within the bounds."""
        return self.at(np.clip(np.zeros(len(self.origin)), self.least, self.most))

    def at(self, changes: FloatArray) -> Iterate:
        """Give the hull at scaled changes, (k,).

        Raises
        ------
        AssocHullError
            There is no certified hull there.
        """
        amplitudes = np.clip(self.origin + self.usual * changes, self.low, self.high)
        # where a bound is touched it is met to the bit
        amplitudes = np.where(self.near(changes, self.least), self.low, amplitudes)
        amplitudes = np.where(self.near(changes, self.most), self.high, amplitudes)
        return Iterate(self, changes, amplitudes, self.problem.at(amplitudes))

    @staticmethod
    def near(changes: FloatArray, bounds: FloatArray) -> NDArray[np.bool_]:
        """Tell which changes lie at their bounds, (k,) bool."""
        with np.errstate(invalid="ignore"):
            close = np.abs(changes - bounds) <= _AT * (1.0 + np.abs(bounds))
        found: NDArray[np.bool_] = close & np.isfinite(bounds)
        return found


@attrs.frozen(eq=False, slots=False)
class Iterate:
    """A hull on the way.

    Attributes
    ----------
    scaled : ScaledProblem
        Where it lies.
    changes, amplitudes : (k,) float
        Scaled, and as the problem takes them.
    hull : Evaluated
        What the problem gave.
    """

    scaled: ScaledProblem
    changes: FloatArray
    amplitudes: FloatArray
    hull: Evaluated

    @cached_property
    def misses(self) -> FloatArray:
        """Scaled misses of the targets, (m,)."""
        return (self.hull.values - self.scaled.targets) / self.scaled.sizes

    @property
    def worst(self) -> float:
        """The largest scaled miss."""
        return float(np.abs(self.misses).max())

    @cached_property
    def size(self) -> float:
        """The root of the sum of squared misses."""
        return float(np.linalg.norm(self.misses))

    @property
    def change(self) -> float:
        """The root of the sum of squared scaled changes."""
        return float(np.linalg.norm(self.changes))

    @cached_property
    def jacobian(self) -> FloatArray:
        """Derivatives of the misses by scaled changes, (m, k); rows of rounding are nil."""
        scaled = self.scaled
        found: FloatArray = self.hull.jacobian * scaled.usual / scaled.sizes[:, None]
        found[np.abs(found).max(axis=1) < _NIL] = 0.0
        return found

    @cached_property
    def at_low(self) -> NDArray[np.bool_]:
        """Which changes lie at their least, (k,)."""
        return self.scaled.near(self.changes, self.scaled.least)

    @cached_property
    def at_high(self) -> NDArray[np.bool_]:
        """Which changes lie at their greatest, (k,); at both where they are held."""
        return self.scaled.near(self.changes, self.scaled.most)

    @property
    def shut(self) -> NDArray[np.bool_]:
        """Which changes cannot go where misses would get less, as far as slopes tell, (k,)."""
        slope = self.jacobian.T @ self.misses
        found: NDArray[np.bool_] = (self.at_low & (slope > 0.0)) | (self.at_high & (slope < 0.0))
        return found
