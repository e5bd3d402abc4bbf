"""A ship at constant displacement, heeled: righting levers and how they grow with the heel.

`levers_of` gives GZ and KN below given planes; `float_at_heels` finds the planes. There are no
draughts on the centre line of a ship on her side: at fixed trim, heels near 90 degrees are read
from a cubic; at free trim nothing is computed beyond 85 degrees.
"""

from __future__ import annotations

from typing import Literal

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.hydrostatics.draughts_from_weight import trim_lever
from assoc_hull.analysis.stability.sinkage_and_trim import (
    EXACT,
    DisplacingHull,
    TrimTarget,
    balance_trim,
    draughts_of_volumes,
)
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.floating.immersion import FloatingPlanes, ImmersedIntegrals

__all__ = [
    "FREE_MOST",
    "HeeledShip",
    "StabilityCase",
    "TrimRule",
    "float_at_heels",
    "levers_of",
    "rough_levers",
]

# --------------------------------------------------------------------------------------
# Levers below planes. With the tangents tt of trim and th of heel the water's normal is n = (-tt,
# th, 1) / N, the direction along the ship e1 = (1, 0, tt) / M, and e2 = n x e1 = (th tt, 1 + tt^2,
# -th) / (N M). The righting lever is GZ = (G - B).e2, positive where it rights a heel to starboard.
# With K = (x_G, 0, 0) it is KN + KG e2_z + y_G e2_y, KN = (K - B).e2.

TrimRule = Literal["fixed", "free"]


@attrs.frozen(eq=False)
class StabilityCase:
    """What floats: n displacements of one hull.

    Attributes
    ----------
    afloat : DisplacingHull
        The hull.
    volume : (n,), m3
        Displaced.
    mean, slope : (n,), m and 1
        Mean draughts and tangents of the trim upright; the trim is kept at fixed trim.
    lcg : (n,), m
        Centres of gravity from AP.
    tcg : float, m
        Centre of gravity to port.
    kg : float or None, m
        Above base; None: levers are KN only, and free trim takes G to lie as high as B.
    trim : "fixed" or "free"
        Whether the trim stays, or is that of equilibrium at each heel.
    """

    afloat: DisplacingHull
    volume: FloatArray
    mean: FloatArray
    slope: FloatArray
    lcg: FloatArray
    tcg: float
    kg: float | None
    trim: TrimRule

    def __attrs_post_init__(self) -> None:
        freeze(self.volume, self.mean, self.slope, self.lcg)


def levers_of(
    case: StabilityCase, lcg: FloatArray, planes: FloatingPlanes, f: ImmersedIntegrals
) -> tuple[FloatArray, ...]:
    """Give kn, gz, growth, energy, normal and distance, as `HeeledShip` has them; `lcg` (d,), m."""
    tt, th, one = planes.tan_trim, planes.tan_heel, np.ones(len(lcg))
    b = np.stack([f.moment_x, f.moment_y, f.moment_z], axis=1) / f.volume[:, None]
    across = np.stack([th * tt, 1.0 + tt * tt, -th], axis=1)
    size = np.linalg.norm(across, axis=1)[:, None]
    e2 = across / size
    normal = np.stack([-tt, th, one], axis=1)
    length = np.linalg.norm(normal, axis=1)
    normal, distance = normal / length[:, None], planes.height / length
    k = np.stack([lcg, 0.0 * one, 0.0 * one], axis=1)
    kn = _dot(k - b, e2)
    if case.kg is None:
        none = np.full(len(lcg), np.nan)
        return kn, none, none.copy(), none.copy(), normal, distance
    arm = k + np.array([0.0, case.tcg, case.kg]) - b
    turn_trim, b_turn = _turning(case, lcg, planes, f)
    turn_heel = 1.0 + th * th
    across_turn = np.stack(
        [turn_heel * tt + th * turn_trim, 2.0 * tt * turn_trim, -turn_heel], axis=1
    )
    e2_turn = (across_turn - e2 * _dot(e2, across_turn)[:, None]) / size
    growth = _dot(arm, e2_turn) - _dot(b_turn, e2)
    return kn, _dot(arm, e2), growth, _dot(arm, normal), normal, distance


def _turning(
    case: StabilityCase, lcg: FloatArray, planes: FloatingPlanes, f: ImmersedIntegrals
) -> tuple[FloatArray, FloatArray]:
    """Give by how much tt (d,) and the centre of buoyancy (d, 3) change per radian of heel.

    The plane turns about the centroid of the waterplane, whose second moments move B.
    """
    tt, th = planes.tan_trim, planes.tan_heel
    x, y = f.area_x / f.area, f.area_y / f.area
    i_l, i_lt = f.area_xx - f.area_x * x, f.area_xy - f.area_x * y
    i_t = f.area_yy - f.area_y * y
    turn_heel, turn_trim = 1.0 + th * th, np.zeros(len(tt))
    if case.trim == "free":
        growth = trim_lever(f, planes, lcg, case.kg)[1]
        pull = ((1.0 + tt * tt) * i_lt - tt * th * i_t) / f.volume
        turn_trim = turn_heel * pull / growth
    ahead = i_l * turn_trim - i_lt * turn_heel
    aside = i_lt * turn_trim - i_t * turn_heel
    return turn_trim, np.stack([ahead, aside, tt * ahead - th * aside], axis=1) / f.volume[:, None]


def _dot(one: FloatArray, other: FloatArray) -> FloatArray:
    found: FloatArray = (one * other).sum(axis=1)
    return found


# --------------------------------------------------------------------------------------
# Heeled positions.

_STEEP = 89.75
FREE_MOST = 85.0
"""Degrees: the largest heel at free trim, beyond which e1 turns upright with the least trim."""

_KNOTS = np.array([89.0, 89.25, 89.5, 89.75])
"""Degrees: at fixed trim, heels beyond the last are read from a cubic through these."""

_NOISE = 6.0
"""What grows as the tangent squared is 5.6 times larger at 90 degrees than its third difference."""

_TOLD = 1e-3  # m: doubts of less are not told


@attrs.frozen(eq=False)
class HeeledShip:
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
    doubt : (d,), m
        How far a lever that is read from a cubic may be off; 0 where it is computed.
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
    doubt: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(*attrs.astuple(self, recurse=False))

    def dry(self, places: FloatArray) -> FloatArray:
        """Give how high places (k, 3) lie above the water, at right angles to it, (d, k), m."""
        found: FloatArray = self.normal @ places.T - self.distance[:, None]
        return found

    def joined(self, other: HeeledShip) -> HeeledShip:
        """Give these heels and others, by rising heel."""
        mine, others = (attrs.astuple(each, recurse=False) for each in (self, other))
        fields = [np.concatenate(pair) for pair in zip(mine, others, strict=True)]
        order = np.unique(fields[0], return_index=True)[1]
        return HeeledShip(*(each[order] for each in fields))


def float_at_heels(
    case: StabilityCase,
    heel_deg: FloatArray,
    row: IntArray | None = None,
    near: HeeledShip | None = None,
) -> HeeledShip:
    """Float a ship at heels (d,), degrees, from -90 to 90, in their order.

    `row` says which of the displacements, the first if None; `near` where the first displacement is
    known to float, for the first trials.
    """
    row = np.zeros(len(heel_deg), np.int64) if row is None else row
    steep = (np.abs(heel_deg) > _STEEP) & (case.trim == "fixed")
    if not steep.any():
        return _direct(case, heel_deg, row, near)
    side = np.sign(heel_deg[steep])[:, None]
    heels = np.concatenate([heel_deg[~steep], (side * _KNOTS).ravel()])
    rows = np.concatenate([row[~steep], np.repeat(row[steep], len(_KNOTS))])
    return _extended(_direct(case, heels, rows, near), heel_deg, steep)


def _extended(found: HeeledShip, heel_deg: FloatArray, steep: NDArray[np.bool_]) -> HeeledShip:
    """Replace the knots by what the cubics through them give."""
    plain = int((~steep).sum())
    weight = _lagrange(np.abs(heel_deg[steep]))
    fields = []
    for each in attrs.astuple(found, recurse=False):
        values = np.empty((len(heel_deg), *each.shape[1:]))
        values[~steep] = each[:plain]
        knots = each[plain:].reshape(-1, len(_KNOTS), *each.shape[1:])
        values[steep] = np.einsum("ij,ij...->i...", weight, knots)
        fields.append(values)
    whole = HeeledShip(*fields)
    fix = {"heel_deg": heel_deg.copy()}
    for name in ("mean", "slope"):
        fix[name] = np.where(steep, np.nan, getattr(whole, name))
    fix["doubt"] = np.zeros(len(heel_deg))
    # Levers bend too little within a degree to show a third difference: what there is, is noise.
    noise = np.abs(np.diff(found.kn[plain:].reshape(-1, len(_KNOTS)), n=3, axis=1)[:, 0])
    fix["doubt"][steep] = _NOISE * noise
    return attrs.evolve(whole, **fix)


def rough_levers(heels: HeeledShip) -> list[str]:
    """Say which levers are known roughly only, and how roughly; nothing where all are smooth."""
    rough = np.flatnonzero(heels.doubt > _TOLD)
    if not len(rough):
        return []
    angles = ", ".join(f"{each:g}" for each in np.unique(heels.heel_deg[rough]).tolist())
    return [
        f"KN and GZ at {angles} deg are known to +-{1e3 * float(heels.doubt[rough].max()):.2g} mm "
        "only: levers from 89 deg on do not run smoothly, as happens where lines are few"
    ]


def _lagrange(place: FloatArray) -> FloatArray:
    """Give the weights of the knots at places, (k, 4)."""
    weight = np.ones((len(place), len(_KNOTS)))
    for i, own in enumerate(_KNOTS):
        for other in np.delete(_KNOTS, i):
            weight[:, i] *= (place - other) / (own - other)
    return weight


def _direct(
    case: StabilityCase, heel_deg: FloatArray, row: IntArray, near: HeeledShip | None
) -> HeeledShip:
    """Float a ship at heels at which she has draughts on the centre line."""
    beyond = (np.abs(heel_deg) > FREE_MOST) & (case.trim == "free")
    heel = np.tan(np.radians(np.where(beyond, 0.0, heel_deg)))
    volume, lcg, slope = case.volume[row], case.lcg[row], case.slope[row]
    mean, known = (case.mean[row], None) if near is None else _start(heel_deg, near)
    if known is None or case.trim == "fixed":
        mean = draughts_of_volumes(case.afloat, volume, slope, heel, mean)
    if case.trim == "free":
        sought = TrimTarget(volume, lcg, case.kg, heel)
        thorough = np.isfinite(mean)  # an open deck that one trim drowns another may leave dry
        mean = np.where(beyond, np.nan, np.where(thorough, mean, case.mean[row]))
        slope = slope if known is None else known
        mean, slope = balance_trim(case.afloat, sought, mean, slope, thorough)
    there = np.flatnonzero(np.isfinite(mean))
    found = case.afloat.measure(case.afloat.planes(mean[there], slope[there], heel[there]))
    good = np.abs(found.volume - volume[there]) <= EXACT * volume[there]
    there = there[good]
    found = ImmersedIntegrals(*(each[good] for each in attrs.astuple(found, recurse=False)))
    planes = case.afloat.planes(mean[there], slope[there], heel[there])
    full = []
    for each in levers_of(case, lcg[there], planes, found):
        spread = np.full((len(heel), *each.shape[1:]), np.nan)
        spread[there] = each
        full.append(spread)
    afloat = np.isfinite(full[0])
    mean, slope = np.where(afloat, mean, np.nan), np.where(afloat, slope, np.nan)
    kn, gz, growth, energy, normal, distance = full
    return HeeledShip(
        heel_deg.copy(), mean, slope, kn, gz, growth, energy, normal, distance, np.zeros(len(heel))
    )


def _start(heel_deg: FloatArray, near: HeeledShip) -> tuple[FloatArray, FloatArray]:
    """Guess mean draughts and trims from those at other heels.

    Times the cosine they change little: draughts on the centre line grow without end towards 90
    degrees.
    """
    known = np.argsort(near.heel_deg)
    known = known[np.isfinite(near.mean[known])]
    at = near.heel_deg[known]
    cosine = np.cos(np.radians(heel_deg))
    known_cosine = np.cos(np.radians(at))
    mean = np.interp(heel_deg, at, near.mean[known] * known_cosine) / cosine
    slope = np.interp(heel_deg, at, near.slope[known] * known_cosine) / cosine
    return mean, slope
