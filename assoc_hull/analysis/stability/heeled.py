"""A ship at constant displacement, heeled: righting levers and how they grow.

There are no draughts on the centre line of a ship on her side. At fixed trim, heels nearer to
90 degrees than a quarter degree are read from a cubic through 89, 89.25, 89.5 and 89.75 degrees.
At free trim nothing is computed beyond 85 degrees, for there e1 turns upright with the least trim.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.stability.afloat import EXACT, sinkage
from assoc_hull.analysis.stability.free_trim import Sought, trimmed
from assoc_hull.analysis.stability.levers import Case, levers_of
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.floating.immersed import Immersed

__all__ = ["FREE_MOST", "Heeled", "heeled"]

_STEEP = 89.75
FREE_MOST = 85.0
"""Degrees: the largest heel at free trim."""

_KNOTS = np.array([89.0, 89.25, 89.5, 89.75])


@attrs.frozen(eq=False)
class Heeled:
    """A ship at d heels; nan where she does not float there.

    Attributes
    ----------
    heel_deg : (d,), degrees
        + starboard down.
    mean, slope : (d,), m and 1
        Mean draught on the centre line, tangent of the trim; nan beyond 89.75 degrees.
    kn, gz : (d,), m
        Levers; + rights a heel to starboard.
    growth : (d,), m
        dGZ per radian of heel.
    energy : (d,), m
        Height of G over B above the water, which grows by the work that a heel takes.
    normal : (d, 3)
        Of the water, upward.
    distance : (d,), m
        Of the water from the origin, along the normal.
    """

    heel_deg: FloatArray
    mean: FloatArray
    slope: FloatArray
    kn: FloatArray
    gz: FloatArray
    growth: FloatArray
    energy: FloatArray
    normal: FloatArray
    distance: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(*attrs.astuple(self, recurse=False))

    def dry(self, places: FloatArray) -> FloatArray:
        """Give how high places (k, 3) lie above the water, at right angles to it, (d, k), m."""
        found: FloatArray = self.normal @ places.T - self.distance[:, None]
        return found

    def joined(self, other: Heeled) -> Heeled:
        """Give these heels and others, by rising heel."""
        mine, others = (attrs.astuple(each, recurse=False) for each in (self, other))
        fields = [np.concatenate(pair) for pair in zip(mine, others, strict=True)]
        order = np.unique(fields[0], return_index=True)[1]
        return Heeled(*(each[order] for each in fields))


def heeled(
    case: Case, heel_deg: FloatArray, row: IntArray | None = None, near: Heeled | None = None
) -> Heeled:
    """Float a ship at heels.

    Parameters
    ----------
    case : Case
        The ship.
    heel_deg : (d,), degrees
        From -90 to 90.
    row : (d,) or None
        Which of the displacements; the first if None.
    near : Heeled or None
        Where the first displacement is known to float, for the first trials.

    Returns
    -------
    Heeled
        At these heels, in their order.
    """
    row = np.zeros(len(heel_deg), np.int64) if row is None else row
    steep = (np.abs(heel_deg) > _STEEP) & (case.trim == "fixed")
    if not steep.any():
        return _direct(case, heel_deg, row, near)
    side = np.sign(heel_deg[steep])[:, None]
    heels = np.concatenate([heel_deg[~steep], (side * _KNOTS).ravel()])
    rows = np.concatenate([row[~steep], np.repeat(row[steep], len(_KNOTS))])
    return _extended(_direct(case, heels, rows, near), heel_deg, steep)


def _extended(found: Heeled, heel_deg: FloatArray, steep: NDArray[np.bool_]) -> Heeled:
    """Put in the place of the knots what the cubics through them give."""
    plain = int((~steep).sum())
    weight = _lagrange(np.abs(heel_deg[steep]))
    fields = []
    for each in attrs.astuple(found, recurse=False):
        values = np.empty((len(heel_deg), *each.shape[1:]))
        values[~steep] = each[:plain]
        knots = each[plain:].reshape(-1, len(_KNOTS), *each.shape[1:])
        values[steep] = np.einsum("ij,ij...->i...", weight, knots)
        fields.append(values)
    whole = Heeled(*fields)
    fix = {"heel_deg": heel_deg.copy()}
    for name in ("mean", "slope"):
        fix[name] = np.where(steep, np.nan, getattr(whole, name))
    return attrs.evolve(whole, **fix)


def _lagrange(place: FloatArray) -> FloatArray:
    """Give the weights of the knots at places, (k, 4)."""
    weight = np.ones((len(place), len(_KNOTS)))
    for i, own in enumerate(_KNOTS):
        for other in np.delete(_KNOTS, i):
            weight[:, i] *= (place - other) / (own - other)
    return weight


def _direct(case: Case, heel_deg: FloatArray, row: IntArray, near: Heeled | None) -> Heeled:
    """Float a ship at heels at which she has draughts on the centre line."""
    beyond = (np.abs(heel_deg) > FREE_MOST) & (case.trim == "free")
    heel = np.tan(np.radians(np.where(beyond, 0.0, heel_deg)))
    volume, lcg, slope = case.volume[row], case.lcg[row], case.slope[row]
    mean, known = (case.mean[row], None) if near is None else _start(heel_deg, near)
    if known is None or case.trim == "fixed":
        mean = sinkage(case.afloat, volume, slope, heel, mean)
    if case.trim == "free":
        sought = Sought(volume, lcg, case.kg, heel)
        thorough = np.isfinite(mean)  # an open deck that one trim drowns another may leave dry
        mean = np.where(beyond, np.nan, np.where(thorough, mean, case.mean[row]))
        slope = slope if known is None else known
        mean, slope = trimmed(case.afloat, sought, mean, slope, thorough)
    there = np.flatnonzero(np.isfinite(mean))
    found = case.afloat.measure(case.afloat.planes(mean[there], slope[there], heel[there]))
    good = np.abs(found.volume - volume[there]) <= EXACT * volume[there]
    there = there[good]
    found = Immersed(*(each[good] for each in attrs.astuple(found, recurse=False)))
    planes = case.afloat.planes(mean[there], slope[there], heel[there])
    full = []
    for each in levers_of(case, lcg[there], planes, found):
        spread = np.full((len(heel), *each.shape[1:]), np.nan)
        spread[there] = each
        full.append(spread)
    afloat = np.isfinite(full[0])
    mean, slope = np.where(afloat, mean, np.nan), np.where(afloat, slope, np.nan)
    return Heeled(heel_deg.copy(), mean, slope, *full)


def _start(heel_deg: FloatArray, near: Heeled) -> tuple[FloatArray, FloatArray]:
    """Guess mean draughts and trims from those at other heels."""
    known = np.argsort(near.heel_deg)
    known = known[np.isfinite(near.mean[known])]
    at = near.heel_deg[known]
    cosine = np.cos(np.radians(heel_deg))
    known_cosine = np.cos(np.radians(at))
    mean = np.interp(heel_deg, at, near.mean[known] * known_cosine) / cosine
    slope = np.interp(heel_deg, at, near.slope[known] * known_cosine) / cosine
    return mean, slope
