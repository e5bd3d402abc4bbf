"""A ship at constant displacement, heeled: draughts, trim and righting levers.

`levers_of` gives GZ and KN below given planes; `float_at_heels` finds the planes. There are no
draughts on the centre line of a ship on her side: at fixed trim, heels near 90 degrees are read
from a cubic; at free trim nothing is computed beyond 85 degrees.

Draughts, and trim, at which a heeled hull displaces given volumes, all in one go.

`draughts_of_volumes` keeps the inclination; `balance_trim` also looks for the trim at which
buoyancy lies below gravity, by Newton's rule in both unknowns, and in a bracket where that fails.
All arrays are (d,): volumes in m3, mean draughts in m, tangents of trim and heel.
"""

from __future__ import annotations

from typing import Literal

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.hydrostatics.bracketed_roots import bracketed_newton
from assoc_hull.analysis.hydrostatics.draughts_from_weight import STEEPEST, trim_lever
from assoc_hull.analysis.hydrostatics.floating_body import Appendage, Floatable, with_appendages
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.floating.immersion import FloatingPlanes, ImmersedIntegrals

__all__ = [
    "EXACT",
    "FREE_MOST",
    "DisplacingHull",
    "HeeledShip",
    "StabilityCase",
    "TrimRule",
    "TrimTarget",
    "balance_trim",
    "draughts_of_volumes",
    "float_at_heels",
    "levers_of",
    "rough_levers",
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
