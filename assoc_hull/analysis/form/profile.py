"""Measures of the centre-line profile: bulb, what lies before FP, transom, boss end, aperture.

The profile is made of the curves in the centre plane at which the hull ends. Transom and boss end
are flat ends of the net: the transom across the ship, aft of all lines; the boss end begins and
ends on the centre plane. Points are (3,), m, x from the AP.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.form.floating_shape import FloatingShape
from assoc_hull.analysis.form.half_section import section_at
from assoc_hull.analysis.form.parameter import Absent
from assoc_hull.analysis.net.curve_net import ON_CENTRE, CurveNet
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.integrals.chains import area_along, clip_cubics, continuous_runs
from assoc_hull.geometry.numeric.circle_fit import fit_circle
from assoc_hull.geometry.splines.plane_intersections import (
    PointsOnCurves,
    coordinate_turns,
    points_at_coordinate,
)
from assoc_hull.geometry.splines.segments import power_coefficients, sample
from assoc_hull.tolerance import length_factor

__all__ = [
    "LEAST_BULB",
    "NO_PROFILE",
    "Boss",
    "aft_end",
    "area_before_fp",
    "boss",
    "boss_curve",
    "bottom_at",
    "bulb_tip",
    "height_above",
    "leaves_boss",
    "profile_at",
    "profile_curves",
    "slope_deg",
    "tips",
    "transom",
    "transom_curves",
]

# --------------------------------------------------------------------------------------
# Profile and bulb.

NO_PROFILE = Absent("no profile drawn")

LEAST_BULB = 1e-3
"""A profile that reaches before FP by less (m) has no bulb."""

_JOINED = 1e-4
"""Ends of curves this near to one another (m) are one point."""

_TURN = 1e-6
"""A profile that runs back by less (m) does not turn."""


def profile_curves(shape: FloatingShape) -> SplineBatch | None:
    """Give the curves of the centre plane at which the hull ends."""
    net = shape.body.net
    chosen = np.flatnonzero(net.end & net.centre)
    if not len(chosen):
        return None
    return SplineBatch.join([net.batch.part(i, i + 1) for i in chosen.tolist()])


def profile_at(shape: FloatingShape, axis: int, value: float) -> PointsOnCurves | None:
    """Give where the profile has an x (axis 0) or a z (axis 2), m; None without a profile."""
    curves = shape.take(profile_curves)
    return None if curves is None else points_at_coordinate(curves, axis, value)


def slope_deg(along: FloatArray) -> float:
    """Give the angle between a direction in the centre plane and the base line, 0 to 90 deg."""
    return float(np.degrees(np.arctan2(abs(along[2]), abs(along[0]))))


def bulb_tip(shape: FloatingShape) -> FloatArray | Absent:
    """Give the foremost point of the bulb, (3,), m.

    It is the foremost point before FP and below the design draught from which the profile runs back
    both ways, and so a root of dx = 0 or a corner.
    """
    curves = shape.take(profile_curves)
    if curves is None:
        return NO_PROFILE
    places = tips(curves)
    low = places[places[:, 2] < shape.header.draught]
    if not len(low) or low[:, 0].max() <= shape.length + LEAST_BULB:
        return Absent("no bulb")
    tip: FloatArray = low[int(low[:, 0].argmax())]
    return tip


def tips(curves: SplineBatch, sense: float = 1.0) -> FloatArray:
    """Give the points of a profile from which it runs back both ways, (k, 3), m.

    Curves come in any order and sense; those that join at their ends are one. `sense` 1: it runs
    aft from there both ways, as from the nose of a bulb; -1: forward.
    """
    return _tips(_chained(list(coordinate_turns(curves, 0))), sense)


def _chained(runs: list[FloatArray]) -> list[FloatArray]:
    """Join runs of points that end where others begin."""
    left, found = list(runs), list[FloatArray]()
    while left:
        run = left.pop(0)
        i = 0
        while i < len(left):
            for other in (left[i], left[i][::-1]):
                if np.abs(run[-1] - other[0]).max() <= _JOINED:
                    run = np.concatenate([run, other[1:]])
                elif np.abs(run[0] - other[-1]).max() <= _JOINED:
                    run = np.concatenate([other[:-1], run])
                else:
                    continue
                left.pop(i)
                i = -1
                break
            i += 1
        found.append(run)
    return found


def _tips(runs: list[FloatArray], sense: float) -> FloatArray:
    """Give points, (k, 3), m, before which a run of turning points advances and then goes back."""
    found = [np.zeros((0, 3))]
    for run in runs:
        moved = np.concatenate([[True], np.abs(np.diff(run[:, 0])) > 0.0])
        clear = run[moved]
        ahead = sense * clear[:, 0]
        step = np.diff(ahead)
        tops = np.flatnonzero((step[:-1] > 0.0) & (step[1:] < 0.0)) + 1
        true = [i for i in tops.tolist() if _falls(ahead[i::-1]) and _falls(ahead[i:])]
        found.append(clear[true])
    return np.concatenate(found)


def _falls(ahead: FloatArray) -> bool:
    """Tell whether a run goes back from where it begins, before it goes on beyond that.

    Where a run only passes a knot, rounding may make it turn.
    """
    beyond, back = ahead > ahead[0], ahead < ahead[0] - _TURN
    return bool(back.any() and not beyond[: int(back.argmax())].any())


def area_before_fp(shape: FloatingShape, height: float, tan_trim: float) -> float:
    """Give the lateral area (m2) of the profile before FP and below z = height + tan_trim x."""
    curves = shape.take(profile_curves)
    if curves is None:
        return 0.0
    total = 0.0
    for i in range(curves.count):
        cubic = power_coefficients(curves.part(i, i + 1)).copy()
        # Measured from FP and from the waterline; a shear leaves areas as they are.
        cubic[:, :, 2] -= tan_trim * cubic[:, :, 0]
        cubic[:, 0, 0] -= shape.length
        before = clip_cubics(cubic, np.array([-1.0, 0.0, 0.0]), 0.0)
        for run in continuous_runs(clip_cubics(before, np.array([0.0, 0.0, 1.0]), height)):
            rises = run[-1].sum(axis=0)[2] >= run[0, 0, 2]
            total += (1.0 if rises else -1.0) * area_along(run, (0, 2))
    return total


# --------------------------------------------------------------------------------------
# Stern: transom, boss end, bottom above the screw, aperture.

_AT_END = 1e-3
"""A flat end this near to the aftmost point of the lines (m) is the transom."""

_LEVEL = 1e-4
"""Points that differ in height by less (m) are level."""


def _flat_ends(net: CurveNet, length: float) -> list[int]:
    """Give the curves of the net that are flat ends of the after body."""
    return np.flatnonzero(net.end & (net.x < 0.5 * length)).tolist()


def transom_curves(net: CurveNet, length: float) -> list[int]:
    """Give the curves of the transom's edge: a transverse flat end aft of all lines; Lpp in m."""
    aftmost = float(net.batch.xyz[:, 0].min())
    return [i for i in _flat_ends(net, length) if net.x[i] <= aftmost + _AT_END]


def transom(shape: FloatingShape) -> SplineBatch | Absent:
    """Give the edge of the transom: a flat end across the ship at the aft end of all lines."""
    net = shape.body.net
    chosen = transom_curves(net, shape.length)
    if not chosen:
        return Absent("no transom")
    return SplineBatch.join([net.batch.part(i, i + 1) for i in chosen])


@attrs.frozen
class Boss:
    """A boss end on the centre line, as drawn.

    Attributes
    ----------
    x : float, m
        Of its aft face.
    top : float, m
        z of its upper side.
    height, diameter : float, m
        Centre above the base line, and size, of the circle through its edge.
    """

    x: float
    top: float
    height: float
    diameter: float


def boss_curve(net: CurveNet, length: float) -> int | None:
    """Give the edge of a boss end: a flat end from the centre plane to it, not the transom."""
    edge = transom_curves(net, length)
    aft = float(net.batch.part(edge[0], edge[0] + 1).xyz[0, 0]) if edge else np.nan
    for i in _flat_ends(net, length):
        ends = net.batch.part(i, i + 1).xyz[[0, -1], 1]
        if net.x[i] != aft and np.abs(ends).max() <= net.on_centre:
            return i
    return None


def boss(shape: FloatingShape) -> Boss | None:
    """Give the boss end: a flat end that begins and ends on the centre plane, not the transom."""
    net = shape.body.net
    i = boss_curve(net, shape.length)
    if i is None:
        return None
    one = net.batch.part(i, i + 1)
    places = sample(one)[1][:, 1:]
    # With the mirror image, so that the centre lies on the centre plane.
    edge_of = fit_circle(np.concatenate([places, places * [-1.0, 1.0]]))
    top = float(one.xyz[[0, -1], 2].max())
    return Boss(float(net.x[i]), top, float(edge_of.centre[1]), 2.0 * edge_of.radius)


def leaves_boss(shape: FloatingShape, end: Boss) -> float | Absent:
    """Give x where the profile above leaves the boss, whose upper side is level, m."""
    curves = shape.take(profile_curves)
    if curves is None:
        return NO_PROFILE
    near = length_factor(shape.length) * ON_CENTRE
    for i in range(curves.count):
        xyz = curves.part(i, i + 1).xyz
        for run in (xyz, xyz[::-1]):
            if max(abs(run[0, 0] - end.x), abs(run[0, 2] - end.top)) <= near:
                level = np.abs(run[:, 2] - end.top) <= _LEVEL
                return float(run[int(np.append(level, False).argmin()) - 1, 0])
    return Absent("no profile above the boss")


def aft_end(shape: FloatingShape) -> float | Absent:
    """Give x of the aft end of the profile, m."""
    curves = shape.take(profile_curves)
    if curves is None:
        return NO_PROFILE
    return float(np.concatenate(coordinate_turns(curves, 0))[:, 0].min())


def bottom_at(shape: FloatingShape, x: float) -> tuple[float, FloatArray] | Absent:
    """Give height (m) and direction of the profile at a place, where it is lowest."""
    found = profile_at(shape, 0, x)
    if found is None:
        return NO_PROFILE
    if not len(found.t):
        return Absent("the profile does not reach there")
    lowest = int(found.xyz[:, 2].argmin())
    return float(found.xyz[lowest, 2]), found.along[lowest]


def height_above(shape: FloatingShape, x: float, y: float, z: float) -> float | Absent:
    """Give the height (m) of the hull over a point: its lowest z there that is above `z`."""
    if y == 0.0:
        places = profile_at(shape, 0, x)
        found = np.zeros(0) if places is None else places.xyz[:, 2]
    else:
        section = section_at(shape, x)
        found = np.zeros(0) if section is None else section.heights(y)
    above = found[found > z]
    return float(above.min()) if len(above) else Absent("no hull above the screw")
