"""Measures of the centre-line profile: where it stands, its bulb, what lies before FP."""

from __future__ import annotations

import numpy as np

from assoc_hull.analysis.form.shape import Shape
from assoc_hull.analysis.form.value import Absent
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.integrals.beside import area_along, beside, runs
from assoc_hull.geometry.splines.plane_places import Places, across, turning_places
from assoc_hull.geometry.splines.segments import power

__all__ = [
    "LEAST_BULB", "NO_PROFILE", "area_before_fp", "bulb_tip", "profile_at", "profile_curves",
    "slope_deg", "tips",
]  # fmt: skip

NO_PROFILE = Absent("no profile drawn")

LEAST_BULB = 1e-3
"""A profile that reaches before FP by less (m) has no bulb."""

_MEET = 1e-4
"""Ends of curves so near to one another (m) are one place."""

_TURN = 1e-6
"""A profile that runs back by less (m) does not turn."""


def profile_curves(shape: Shape) -> SplineBatch | None:
    """Give the curves of the centre plane at which the hull ends."""
    net = shape.body.net
    chosen = np.flatnonzero(net.end & net.centre)
    if not len(chosen):
        return None
    return SplineBatch.join([net.batch.part(i, i + 1) for i in chosen.tolist()])


def profile_at(shape: Shape, axis: int, value: float) -> Places | None:
    """Give where the profile has an x (axis 0) or a z (axis 2), m; None without a profile."""
    curves = shape.take(profile_curves)
    return None if curves is None else across(curves, axis, value)


def slope_deg(along: FloatArray) -> float:
    """Give the angle between a direction in the centre plane and the base line, 0 to 90 deg."""
    return float(np.degrees(np.arctan2(abs(along[2]), abs(along[0]))))


def bulb_tip(shape: Shape) -> FloatArray | Absent:
    """Give the foremost place of the bulb, (3,), m.

    It is the foremost place before FP and below the design draught from which the profile runs
    back both ways, and so a root of dx = 0 or a corner.
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
    """Give the places of a profile from which it runs back both ways, (k, 3), m.

    Parameters
    ----------
    curves : SplineBatch
        Of the centre plane, in any order and sense; curves that meet at their ends are one.
    sense : float
        1: it runs aft from there both ways, as from the nose of a bulb; -1: forward.
    """
    return _tips(_chained(list(turning_places(curves, 0))), sense)


def _chained(runs: list[FloatArray]) -> list[FloatArray]:
    """Join runs of places that end where others begin."""
    left, found = list(runs), list[FloatArray]()
    while left:
        run = left.pop(0)
        i = 0
        while i < len(left):
            for other in (left[i], left[i][::-1]):
                if np.abs(run[-1] - other[0]).max() <= _MEET:
                    run = np.concatenate([run, other[1:]])
                elif np.abs(run[0] - other[-1]).max() <= _MEET:
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
    """Give places, (k, 3), before which a run of turning places advances and then goes back."""
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


def area_before_fp(shape: Shape, height: float, tan_trim: float) -> float:
    """Give the lateral area of the profile before FP and below a waterline, m2.

    Parameters
    ----------
    shape : Shape
        The hull.
    height, tan_trim : float
        The waterline z = height + tan_trim x.
    """
    curves = shape.take(profile_curves)
    if curves is None:
        return 0.0
    total = 0.0
    for i in range(curves.count):
        cubic = power(curves.part(i, i + 1)).copy()
        # Measured from FP and from the waterline; a shear leaves areas as they are.
        cubic[:, :, 2] -= tan_trim * cubic[:, :, 0]
        cubic[:, 0, 0] -= shape.length
        before = beside(cubic, np.array([-1.0, 0.0, 0.0]), 0.0)
        for run in runs(beside(before, np.array([0.0, 0.0, 1.0]), height)):
            rises = run[-1].sum(axis=0)[2] >= run[0, 0, 2]
            total += (1.0 if rises else -1.0) * area_along(run, (0, 2))
    return total
