"""A hull that is to displace given volumes: the draughts at given inclinations, all in one go."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.appendage import Appendage, with_appendages
from assoc_hull.analysis.hydrostatics.bracketed import newton
from assoc_hull.analysis.hydrostatics.floating_body import Floats
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.immersed import Immersed, Planes

__all__ = ["EXACT", "Afloat", "sinkage"]

EXACT = 1e-9
"""Part of the volume by which it may be missed."""

_FINE = 1e-9
"""Part of the range of draughts: after a step of this size no more than rounding is left."""


@attrs.frozen
class Afloat:
    """A hull with what else displaces water.

    Attributes
    ----------
    body : Floats
        The hull.
    length : float, m
        Between perpendiculars.
    appendages : tuple of Appendage
        That carry as well.
    """

    body: Floats
    length: float
    appendages: tuple[Appendage, ...] = ()

    def planes(self, mean: FloatArray, slope: FloatArray, heel: FloatArray) -> Planes:
        """Give planes by mean draughts (m) and the tangents of trim and heel, (d,) each."""
        return Planes(mean - 0.5 * self.length * slope, slope.copy(), heel.copy())

    def measure(self, planes: Planes) -> Immersed:
        """Give the integrals below planes, appendages included."""
        return with_appendages(self.body.measure(planes), self.appendages, planes)

    def range(self, slope: FloatArray, heel: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give the admissible mean draughts (m) at tangents of trim and heel."""
        level = self.planes(np.zeros(len(slope)), slope, heel)
        return self.body.limits.mean_draughts(level, self.length)

    def most(self, slope: FloatArray, heel: FloatArray) -> FloatArray:
        """Give what the hull displaces at the deepest; nil where no draught is admissible."""
        low, high = self.range(slope, heel)
        found = np.zeros(len(slope))
        some = np.flatnonzero(low < high)
        if len(some):
            found[some] = self.measure(self.planes(high[some], slope[some], heel[some])).volume
        return found


def sinkage(
    afloat: Afloat,
    volume: FloatArray,
    slope: FloatArray,
    heel: FloatArray,
    start: FloatArray | None = None,
) -> FloatArray:
    """Find the mean draughts at which given volumes are displaced, at given inclinations.

    Parameters
    ----------
    afloat : Afloat
        The hull.
    volume : (d,), m3
        What is to be displaced.
    slope, heel : (d,)
        Tangents of trim and heel.
    start : (d,), m, or None
        First trials.

    Returns
    -------
    (d,), m
        Mean draughts; nan where an open deck would be drowned. Where a hull is too small, or an
        appendage gets wet just there, the nearest that there is.
    """
    low, high = afloat.range(slope, heel)
    mean = 0.5 * (low + high)
    if start is not None:
        mean = np.where((low < start) & (start < high), start, mean)
    there = low < high
    if not afloat.body.limits.closed:
        there = volume <= afloat.most(slope, heel)
    some = np.flatnonzero(there)

    def excess(t: FloatArray, rows: IntArray) -> tuple[FloatArray, FloatArray]:
        of = some[rows]
        found = afloat.measure(afloat.planes(t, slope[of], heel[of]))
        return found.volume - volume[of], found.area

    mean[some] = newton(excess, mean[some], low[some], high[some], _FINE)
    return np.where(there, mean, np.nan)
