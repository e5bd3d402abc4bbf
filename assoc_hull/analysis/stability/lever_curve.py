"""The curve of righting levers of a condition: computed heels, and cubics between them.

Between computed heels stands the cubic that has their levers and their exact slopes. Heels are
added in between until the next computed lever agrees with the cubic, for the curve bends
suddenly where a deck edge goes under or a bilge comes out.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property

import attrs
import numpy as np
from scipy.interpolate import CubicHermiteSpline

from assoc_hull.analysis.hydrostatics.bracketed_roots import sign_changes
from assoc_hull.analysis.stability.righting_lever import HeeledShip, StabilityCase, float_at_heels
from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["LeverCurve", "lever_curve"]

_CLOSE = 1e-4
"""A cubic may miss a lever by so much (m), or by this part of the largest."""

_FALL = 4.0
"""The cubic over two intervals misses the heel between them by so much more, at the least."""

_ROUNDS = 4


@attrs.frozen(eq=False)
class LeverCurve:
    """Righting levers over the heel.

    Attributes
    ----------
    case : StabilityCase
        Of what.
    heels : HeeledShip
        The computed ones, rising.
    side : int
        Towards which side the ship is judged: 1 starboard, -1 port.
    """

    case: StabilityCase
    heels: HeeledShip
    side: int

    @cached_property
    def _cubics(self) -> CubicHermiteSpline:
        return CubicHermiteSpline(
            np.radians(self.heels.heel_deg), self.heels.gz, self.heels.growth, extrapolate=False
        )

    @cached_property
    def _areas(self) -> CubicHermiteSpline:
        return self._cubics.antiderivative()

    def through(self, heel_deg: Iterable[float | None]) -> LeverCurve:
        """Give the curve with levers computed at more heels (degrees, to the side judged)."""
        more = [self.side * each for each in heel_deg if each is not None]
        if not more:
            return self
        found = _afloat(float_at_heels(self.case, np.array(more), near=self.heels))
        return LeverCurve(self.case, self.heels.joined(found), self.side)

    @property
    def end(self) -> float:
        """The largest heel (degrees) to the side on which the ship is judged."""
        return float((self.side * self.heels.heel_deg).max())

    def gz(self, heel_deg: FloatArray | float) -> FloatArray:
        """Give levers (m) at heels (degrees, + starboard down); nan beyond the computed ones."""
        found: FloatArray = self._cubics(np.radians(heel_deg))
        return found

    def arm(self, heel_deg: FloatArray | float) -> FloatArray:
        """Give dynamic arms (m rad): the integrals of GZ from upright to heels (degrees)."""
        found: FloatArray = self._areas(np.radians(heel_deg)) - self._areas(0.0)
        return found

    def area(self, low: float, high: float) -> float:
        """Give the area (m rad) under the curve between heels (degrees) to the side judged."""
        one, other = self._areas(np.radians(self.side * np.array([low, high])))
        return float(other - one)

    @cached_property
    def _judged(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Heels (degrees), levers and slopes to the side judged, from upright."""
        heel = self.side * self.heels.heel_deg
        rows = np.flatnonzero(heel >= 0.0)
        rows = rows[np.argsort(heel[rows])]
        return heel[rows], self.side * self.heels.gz[rows], self.heels.growth[rows]

    @property
    def gm(self) -> float:
        """Slope upright, m."""
        return float(self._judged[2][0])

    @cached_property
    def largest(self) -> tuple[float, float]:
        """The largest lever (m), and its heel (degrees)."""
        return self._most(0.0)

    def most(self, least_deg: float) -> tuple[float, float]:
        """Give the largest lever (m) at that heel or beyond, and its heel (degrees)."""
        return self.largest if self.largest[1] >= least_deg else self._most(least_deg)

    def _most(self, least_deg: float) -> tuple[float, float]:
        """Look for the largest lever from a heel on."""
        heel, gz, growth = (each[self._judged[0] >= least_deg] for each in self._judged)
        k = int(gz.argmax())
        low = k if growth[k] > 0.0 else k - 1
        if low < 0 or low + 1 >= len(heel) or growth[low] * growth[low + 1] >= 0.0:
            return float(gz[k]), float(heel[k])
        place = self._crossing("growth", heel[low], heel[low + 1])
        top = float_at_heels(self.case, np.array([self.side * place]), near=self.heels)
        return self.side * float(top.gz[0]), place

    @cached_property
    def positive(self) -> tuple[float | None, float | None]:
        """Between which heels (degrees) the levers are positive, to the side judged.

        None for the first: they are nowhere; for the second: they still are at the end.
        """
        heel, gz, growth = self._judged
        if not (gz > 0.0).any():
            return None, None
        first = int(np.argmax(gz > 0.0))
        start = 0.0
        if gz[0] < -1e-12 or (growth[0] < 0.0 and first > 0):
            low = max(float(heel[first - 1]), 1e-6)
            start = self._crossing("gz", low, heel[first])
        gone = np.flatnonzero(gz[first:] <= 0.0)
        if not len(gone):
            return start, None
        last = first + int(gone[0])
        return start, self._crossing("gz", heel[last - 1], heel[last])

    def _crossing(self, name: str, low: float, high: float) -> float:
        """Find where levers or slopes change their sign, computed anew."""

        def value(heel: FloatArray, _: IntArray) -> FloatArray:
            found: FloatArray = getattr(
                float_at_heels(self.case, self.side * heel, near=self.heels), name
            )
            return found

        return float(sign_changes(value, np.array([low]), np.array([high]))[0])


def lever_curve(case: StabilityCase, heel_deg: FloatArray, side: int) -> LeverCurve:
    """Compute the curve of a condition.

    Parameters
    ----------
    case : StabilityCase
        The ship; one displacement.
    heel_deg : (k,), degrees
        Rising; those at which she does not float are left out.
    side : int
        Towards which side the ship is judged: 1 starboard, -1 port.

    Returns
    -------
    LeverCurve
        At these heels, and at some in between.
    """
    known = _afloat(float_at_heels(case, heel_deg))
    close = _CLOSE * max(1.0, float(np.abs(known.gz).max(initial=0.0)))
    low, high = _suspect(known, _FALL * close)
    for _ in range(_ROUNDS):
        if not len(low):
            break
        curve = LeverCurve(case, known, side)
        middle = 0.5 * (low + high)
        found = float_at_heels(case, middle, near=known)
        poor = np.abs(found.gz - curve.gz(middle)) > close
        known = known.joined(_afloat(found))
        low, high = (
            np.concatenate([low[poor], middle[poor]]),
            np.concatenate([middle[poor], high[poor]]),
        )
    return LeverCurve(case, known, side)


def _afloat(heels: HeeledShip) -> HeeledShip:
    """Leave out the heels at which she does not float."""
    good = np.isfinite(heels.gz)
    return HeeledShip(*(each[good] for each in attrs.astuple(heels, recurse=False)))


def _suspect(heels: HeeledShip, close: float) -> tuple[FloatArray, FloatArray]:
    """Give the intervals beside heels whose lever the cubic between their neighbours misses."""
    at, gz, growth = np.radians(heels.heel_deg), heels.gz, heels.growth
    if len(at) < 3:
        return heels.heel_deg[:-1], heels.heel_deg[1:]
    span = at[2:] - at[:-2]
    t = (at[1:-1] - at[:-2]) / span
    rise = gz[2:] - gz[:-2]
    out, into = growth[:-2] * span - rise, rise - growth[2:] * span
    seen = gz[:-2] + t * (rise + (1.0 - t) * ((1.0 - t) * out + t * into))
    poor = np.abs(seen - gz[1:-1]) > close
    either = np.append(poor, False) | np.append(False, poor)
    return heels.heel_deg[:-1][either], heels.heel_deg[1:][either]
