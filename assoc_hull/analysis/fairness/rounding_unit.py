"""The unit to which values were rounded: the noise of a table that was read off or printed."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = ["rounding_noise", "rounding_unit"]

_INCH = 0.0254
_UNITS = tuple(
    sorted((0.1, 0.01, 0.005, 0.002, 1e-3, 1e-4, _INCH / 8.0, _INCH / 16.0), reverse=True)
)
"""Units that are looked for, m; a finer one is none that fairing could mend."""

_OFF = 1e-3
"""By this part of a unit values may miss whole numbers of it: as they were scaled."""

_LEAST = 30
"""Fewer values prove nothing."""


def rounding_unit(values: FloatArray, breadth: float) -> float | None:
    """Give the largest unit (m) of which all values (k,), m, are whole numbers; None if none.

    Units of a table of parts of the half-breadth are looked for too; nil proves nothing.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.fairness.rounding_unit import rounding_unit
    >>> y = np.sqrt(np.linspace(1.0, 20.0, 50))
    >>> rounding_unit(np.round(y, 3), 20.0), rounding_unit(y, 20.0)
    (0.001, None)
    """
    some = values[np.abs(values) > 0.0]
    if len(some) < _LEAST:
        return None
    own = (0.5 * breadth * 1e-3, 0.5 * breadth * 1e-4)
    for unit in sorted({*_UNITS, *own}, reverse=True):
        whole = some / unit
        if (np.abs(whole - np.round(whole)) < _OFF).all():
            return float(unit)
    return None


def rounding_noise(unit: float) -> float:
    """Give the standard deviation of what rounding to a unit adds, m."""
    return unit / float(np.sqrt(12.0))
