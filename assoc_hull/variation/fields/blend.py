"""Blends: how a field goes over from one piece to the next, and their integrals.

A blend b rises from 0 at s = 0 to 1 at s = 1 with level ends. The cubic one has continuous
slope, the quintic one continuous curvature as well. A ramp is the integral of a blend: it
leaves 0 as smoothly and ends in a straight line of slope 1.
"""

from __future__ import annotations

from typing import Literal

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = ["BLENDS", "CUBIC", "QUINTIC", "Blend"]


@attrs.frozen
class Blend:
    """A blend and its derivatives, elementwise on arrays of any shape.

    Attributes
    ----------
    name : {"cubic", "quintic"}
    steepest : float
        Largest slope, at s = 1/2: 3/2 or 15/8.

    Examples
    --------
    >>> from assoc_hull.variation.fields.blend import CUBIC, QUINTIC
    >>> import numpy as np
    >>> [round(float(each.value(np.array(0.3))), 10) for each in (CUBIC, QUINTIC)]
    [0.216, 0.16308]
    """

    name: Literal["cubic", "quintic"]
    steepest: float

    @property
    def degree(self) -> int:
        """That of b between 0 and 1."""
        return 3 if self.name == "cubic" else 5

    def value(self, s: FloatArray) -> FloatArray:
        """Give b(s); exactly 0 below s = 0 and exactly 1 above s = 1."""
        s = _within(s)
        if self.name == "cubic":
            return np.asarray(s * s * (3.0 - 2.0 * s))
        return np.asarray(s * s * s * (10.0 + s * (6.0 * s - 15.0)))

    def slope(self, s: FloatArray) -> FloatArray:
        """Give b'(s), nil outside 0 <= s <= 1."""
        s = _within(s)
        part = s * (1.0 - s)
        return np.asarray(6.0 * part if self.name == "cubic" else 30.0 * part * part)

    def second(self, s: FloatArray) -> FloatArray:
        """Give b''(s), nil outside 0 <= s <= 1; the cubic's jumps there, its inner value counts."""
        inside = (s >= 0.0) & (s <= 1.0)
        s = _within(s)
        bend = 6.0 - 12.0 * s
        if self.name == "quintic":
            bend = 10.0 * s * (1.0 - s) * bend
        return np.where(inside, bend, 0.0)

    def ramp(self, t: FloatArray) -> FloatArray:
        """Give the integral of b from 0 to t: nil below 0, t - 1/2 above 1."""
        s = _within(t)
        if self.name == "cubic":
            rise = s * s * s * (1.0 - 0.5 * s)
        else:
            rise = s * s * s * s * (2.5 + s * (s - 3.0))
        return np.asarray(np.where(t > 1.0, t - 0.5, rise))

    def value_range(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give least and greatest b on intervals: b is monotone."""
        return self.value(low), self.value(high)

    def slope_range(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give least and greatest b' on intervals: b' rises to s = 1/2 and falls from there."""
        first, last = self.slope(low), self.slope(high)
        peak = (np.asarray(low) <= 0.5) & (np.asarray(high) >= 0.5)
        most = np.where(peak, self.steepest, np.maximum(first, last))
        return np.minimum(first, last), most


def _within(s: FloatArray) -> FloatArray:
    """Bring numbers into 0 to 1; `np.clip` is slow where arrays are short, as most are here."""
    return np.asarray(np.minimum(np.maximum(s, 0.0), 1.0))


CUBIC = Blend("cubic", 1.5)
QUINTIC = Blend("quintic", 1.875)
BLENDS = {"cubic": CUBIC, "quintic": QUINTIC}
