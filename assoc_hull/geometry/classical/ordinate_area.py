"""The area of a section of ordinates below any height, in closed form.

Examples
--------
>>> from assoc_hull.geometry.classical.ordinate_area import area_below
>>> from assoc_hull.geometry.classical.paired_parabolas import PairedParabolas
>>> side = PairedParabolas.make("side", 0.0, 2.0, [3, 3, 3])
>>> round(area_below(None, side, 1.5, 0.0), 12)
4.5
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.classical.paired_parabolas import PairedParabolas
from assoc_hull.geometry.curves import FloatArray

__all__ = ["area_below"]


def area_below(
    bottom: PairedParabolas | None, side: PairedParabolas, level: float, hb: float
) -> float:
    """Give the area of one side below a height, m2.

    Parameters
    ----------
    bottom : PairedParabolas or None
        Height over y, m.
    side : PairedParabolas
        Half-breadth over z, m.
    level : float, m
        Up to here, not beyond the last waterline.
    hb : float, m
        Where the bottom part ends.
    """
    above = side.integral(None, level) if level > side.first else 0.0
    if bottom is None:
        return above
    wet = min(level, hb)
    under = _under(bottom, wet)
    foot, wide = float(bottom.values[-1]), float(side.values[0]) - bottom.last
    if wet > foot and hb > foot:
        under += 0.5 * (wet - foot) ** 2 / (hb - foot) * wide
    return under + above


def _under(curve: PairedParabolas, level: float) -> float:
    """Integrate what lies between a curve and a height above it, where it does."""
    edges = np.unique(np.concatenate([curve.places, _crossings(curve, level)]))
    middle = 0.5 * (edges[:-1] + edges[1:])
    wet = curve.at(middle) < level
    if not wet.any():
        return 0.0
    parts = [
        level * (last - first) - curve.integral(first, last)
        for first, last in zip(edges[:-1][wet].tolist(), edges[1:][wet].tolist(), strict=True)
    ]
    return float(sum(parts))


def _crossings(curve: PairedParabolas, level: float) -> FloatArray:
    """Give the places where a curve has a height, each step by its quadratic."""
    c0, c1, c2 = curve.coefficients().T
    c0 = c0 - level
    with np.errstate(divide="ignore", invalid="ignore"):
        root = np.sqrt(c1 * c1 - 4.0 * c2 * c0)
        # The form that keeps its digits: one root by the sum, the other by the product.
        sum_ = -0.5 * (c1 + np.where(c1 < 0.0, -root, root))
        u = np.stack([sum_ / c2, c0 / sum_])
    there = np.isfinite(u) & (u > 0.0) & (u < 1.0)
    found: FloatArray = (curve.places[:-1] + curve.step * u)[there]
    return found
