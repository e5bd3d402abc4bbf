"""Draughts, and trim, at which a heeled hull displaces given volumes, all in one go.

`draughts_of_volumes` keeps the inclination; `balance_trim` also looks for the trim at which
buoyancy lies below gravity, by Newton's rule in both unknowns, and in a bracket where that fails.
All arrays are (d,): volumes in m3, mean draughts in m, tangents of trim and heel.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.hydrostatics.bracketed_roots import bracketed_newton
from assoc_hull.analysis.hydrostatics.draughts_from_weight import STEEPEST, trim_lever
from assoc_hull.analysis.hydrostatics.floating_body import Appendage, Floatable, with_appendages
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.immersion import FloatingPlanes, ImmersedIntegrals

__all__ = [
    "EXACT",
    "DisplacingHull",
    "TrimTarget",
    "balance_trim",
    "draughts_of_volumes",
]

# --------------------------------------------------------------------------------------
# Draughts of given volumes, at given inclinations.

EXACT = 1e-9
"""Part of the volume by which it may be missed."""

_FINE = 1e-9
"""Part of the range of draughts: after a step of this size no more than rounding is left."""


@attrs.frozen
class DisplacingHull:
    """A hull with what else displaces water.

    Attributes
    ----------
    body : Floatable
        The hull.
    length : float, m
        Between perpendiculars.
    appendages : tuple of Appendage
        That carry as well.
    """

    body: Floatable
    length: float
    appendages: tuple[Appendage, ...] = ()

    def planes(self, mean: FloatArray, slope: FloatArray, heel: FloatArray) -> FloatingPlanes:
        """Give planes by mean draughts (m) and the tangents of trim and heel, (d,) each."""
        return FloatingPlanes(mean - 0.5 * self.length * slope, slope.copy(), heel.copy())

    def measure(self, planes: FloatingPlanes) -> ImmersedIntegrals:
        """Give the integrals below planes, appendages included."""
        return with_appendages(self.body.measure(planes), self.appendages, planes)

    def range(self, slope: FloatArray, heel: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give the admissible mean draughts (m) at tangents of trim and heel."""
        level = self.planes(np.zeros(len(slope)), slope, heel)
        return self.body.limits.mean_draughts(level, self.length)

    def most(self, slope: FloatArray, heel: FloatArray) -> FloatArray:
        """Give what the hull displaces at the deepest, m3; 0 where no draught is admissible."""
        low, high = self.range(slope, heel)
        found = np.zeros(len(slope))
        some = np.flatnonzero(low < high)
        if len(some):
            found[some] = self.measure(self.planes(high[some], slope[some], heel[some])).volume
        return found


def draughts_of_volumes(
    afloat: DisplacingHull,
    volume: FloatArray,
    slope: FloatArray,
    heel: FloatArray,
    start: FloatArray | None = None,
) -> FloatArray:
    """Find the mean draughts (d,), m, at which given volumes are displaced, at given inclinations.

    `start` are first trials. Nan where an open deck would be drowned; where a hull is too small, or
    an appendage gets wet just there, the nearest that there is.
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

    mean[some] = bracketed_newton(excess, mean[some], low[some], high[some], _FINE)
    return np.where(there, mean, np.nan)


# --------------------------------------------------------------------------------------
# Draught and trim together: at a given heel, the plane of a volume below a centre of gravity.

_TRIALS = 25
_STEP = 0.05
"""Tangent of the largest change of trim in one step, along the ship."""

_LAST_STEP, _SMALL = 1e-9, 1e-7
"""Of the range of draughts: steps after which rounding is left, and small ones."""

_OFF = 1e-8
"""Part of the length by which buoyancy may stay ahead of gravity."""


@attrs.frozen(eq=False)
class TrimTarget:
    """What is to be in equilibrium lengthwise, (d,) each.

    Attributes
    ----------
    volume : (d,), m3
        To displace.
    lcg : (d,), m
        Centre of gravity from AP.
    kg : float or None, m
        Above base; None: as high as the centre of buoyancy.
    heel : (d,)
        Tangents of the heel.
    """

    volume: FloatArray
    lcg: FloatArray
    kg: float | None
    heel: FloatArray

    def some(self, rows: IntArray) -> TrimTarget:
        """Give some of them."""
        return TrimTarget(self.volume[rows], self.lcg[rows], self.kg, self.heel[rows])

    @property
    def cosine(self) -> FloatArray:
        """Of the heel."""
        found: FloatArray = 1.0 / np.sqrt(1.0 + self.heel**2)
        return found


def balance_trim(
    afloat: DisplacingHull,
    sought: TrimTarget,
    mean: FloatArray,
    slope: FloatArray,
    thorough: NDArray[np.bool_],
) -> tuple[FloatArray, FloatArray]:
    """Find mean draughts (m) and tangents of trim, (d,), at which buoyancy lies below gravity.

    `mean` (nan where none is to be found) and `slope` are first trials. Where `thorough`, a trim is
    looked for in a bracket if Newton's rule fails. Nan where there is no such plane.
    """
    mean, slope = mean.copy(), slope.copy()
    slope[~np.isfinite(mean)] = np.nan
    known = np.flatnonzero(np.isfinite(mean))
    mean[known], slope[known] = _together(afloat, sought.some(known), mean[known], slope[known])
    left = known[~_balanced(afloat, sought.some(known), mean[known], slope[known])]
    mean[left] = slope[left] = np.nan
    left = left[thorough[left]]
    if len(left):
        rest = sought.some(left)
        mean[left], slope[left] = _one_by_one(afloat, rest)
        off = left[~_balanced(afloat, rest, mean[left], slope[left])]
        mean[off] = slope[off] = np.nan
    return mean, slope


def _balanced(
    afloat: DisplacingHull, sought: TrimTarget, mean: FloatArray, slope: FloatArray
) -> NDArray[np.bool_]:
    """Tell where volume and trim are right."""
    good = np.isfinite(mean) & np.isfinite(slope)
    some = np.flatnonzero(good)
    if len(some):
        of = sought.some(some)
        planes = afloat.planes(mean[some], slope[some], of.heel)
        found = afloat.measure(planes)
        ahead = trim_lever(found, planes, of.lcg, of.kg)[0]
        right = np.abs(found.volume - of.volume) <= EXACT * of.volume
        good[some] = right & (np.abs(ahead) <= _OFF * afloat.length)
    return good


def _together(
    afloat: DisplacingHull, sought: TrimTarget, mean: FloatArray, slope: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Run Newton's rule in both unknowns."""
    mean, slope = mean.copy(), slope.copy()
    last = np.full(len(mean), np.inf)
    rows = np.arange(len(mean))
    for _ in range(_TRIALS):
        if not len(rows):
            break
        of = sought.some(rows)
        low, high = afloat.range(slope[rows], of.heel)
        step, turn = _step(afloat, of, mean[rows], slope[rows])
        # A trim that would change by more than `_STEP` is cut back, and the draught with it.
        part = np.minimum(1.0, _STEP / np.maximum(np.abs(turn) * of.cosine, 1e-300))
        size = np.maximum(np.abs(step), np.abs(turn) * afloat.length) / (high - low)
        slope[rows] += part * turn
        mean[rows] = _inside(afloat, of, mean[rows], part * step, slope[rows])
        done = (size <= _LAST_STEP) | ((size <= _SMALL) & (size >= 0.5 * last[rows]))
        last[rows] = size
        lost = ~(np.isfinite(mean[rows]) & (np.abs(slope[rows]) * of.cosine < STEEPEST))
        mean[rows[lost]] = np.nan
        rows = rows[~done & ~lost]
    return mean, slope


def _inside(
    afloat: DisplacingHull,
    sought: TrimTarget,
    mean: FloatArray,
    step: FloatArray,
    slope: FloatArray,
) -> FloatArray:
    """Take steps of mean draughts, at most half way to an end of the admissible ones.

    These are those at the new trims; nan where there are none.
    """
    low, high = afloat.range(slope, sought.heel)
    within = (low < mean) & (mean < high)
    old = np.where(within, mean, 0.5 * (low + high))
    new = np.where(within, mean + step, old)
    new = np.where(new <= low, 0.5 * (old + low), np.where(new >= high, 0.5 * (old + high), new))
    return np.where(low < high, new, np.nan)


def _step(
    afloat: DisplacingHull, sought: TrimTarget, mean: FloatArray, slope: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give Newton's steps of mean draught t (m) and slope tt.

    With X = x - Lpp / 2 and z = h + tt x - th y on the plane, dV = A dt + A_X dtt and d(M_x + tt
    M_z) = (A_x + tt Z) dt + (A_xX + tt Z_X + M_z) dtt, Z = int z dA, Z_X = int z X dA; less x_G and
    tt z_G times the same of the volume.
    """
    planes = afloat.planes(mean, slope, sought.heel)
    f, half = afloat.measure(planes), 0.5 * afloat.length
    x, h, th, g = sought.lcg, planes.height, planes.tan_heel, sought.kg
    a_x, a_xx = f.area_x - half * f.area, f.area_xx - half * f.area_x
    excess, moment = f.volume - sought.volume, f.moment_x - x * f.volume
    down, turn = f.area_x - x * f.area, a_xx - x * a_x
    if g is not None:
        z = h * f.area + slope * f.area_x - th * f.area_y
        z_x = h * f.area_x + slope * f.area_xx - th * f.area_xy - half * z
        high = f.moment_z - g * f.volume
        moment = moment + slope * high
        down = down + slope * (z - g * f.area)
        turn = turn + slope * (z_x - g * a_x) + high
    det = f.area * turn - a_x * down
    det = np.where(det > 0.0, det, np.nan)
    return (-excess * turn + moment * a_x) / det, (-moment * f.area + excess * down) / det


def _one_by_one(afloat: DisplacingHull, sought: TrimTarget) -> tuple[FloatArray, FloatArray]:
    """Look for each trim in a bracket; the draught is solved anew at every trial."""
    cosine = sought.cosine

    def lever(lean: FloatArray, rows: IntArray) -> tuple[FloatArray, FloatArray]:
        of, slope = sought.some(rows), lean / cosine[rows]
        mean = draughts_of_volumes(afloat, of.volume, slope, of.heel)
        ahead = np.where(lean > 0.0, np.inf, -np.inf)
        growth = np.zeros(len(rows))
        some = np.flatnonzero(np.isfinite(mean))
        if len(some):
            planes = afloat.planes(mean[some], slope[some], of.heel[some])
            found = afloat.measure(planes)
            ahead[some], growth[some] = trim_lever(found, planes, of.lcg[some], of.kg)
        return ahead, growth / cosine[rows]

    ends = np.full(len(cosine), STEEPEST)
    slope = bracketed_newton(lever, 0.0 * ends, -ends, ends) / cosine
    return draughts_of_volumes(afloat, sought.volume, slope, sought.heel), slope
