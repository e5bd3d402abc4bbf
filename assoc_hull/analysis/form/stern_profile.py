"""Measures of the stern: transom, boss end, bottom above the screw, aperture."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.form.profile import NO_PROFILE, profile_at, profile_curves
from assoc_hull.analysis.form.section_shape import section_at
from assoc_hull.analysis.form.shape import Shape
from assoc_hull.analysis.form.value import Absent
from assoc_hull.analysis.net.gather import Net
from assoc_hull.analysis.net.sections import CENTRE
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.numeric.circle_fit import fit_circle
from assoc_hull.geometry.splines.evaluation import sample
from assoc_hull.geometry.splines.plane_places import turning_places

__all__ = [
    "Boss", "aft_end", "boss", "boss_curve", "bottom_at", "height_above", "leaves_boss", "transom",
    "transom_curves",
]  # fmt: skip

_AT_END = 1e-3
"""A flat end so near to the aftmost place of the lines (m) is the transom."""

_LEVEL = 1e-4
"""Places that differ in height by less (m) are level."""


def _flat_ends(net: Net, length: float) -> list[int]:
    """Give the curves of the net that are flat ends of the after body."""
    return np.flatnonzero(net.end & (net.x < 0.5 * length)).tolist()


def transom_curves(net: Net, length: float) -> list[int]:
    """Give the curves of the transom's edge: a flat end across the ship aft of all lines.

    Parameters
    ----------
    net : Net
        The lines.
    length : float, m
        Lpp.
    """
    aftmost = float(net.batch.xyz[:, 0].min())
    return [i for i in _flat_ends(net, length) if net.x[i] <= aftmost + _AT_END]


def transom(shape: Shape) -> SplineBatch | Absent:
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


def boss_curve(net: Net, length: float) -> int | None:
    """Give the edge of a boss end: a flat end from the centre plane to it, not the transom.

    Parameters
    ----------
    net : Net
        The lines.
    length : float, m
        Lpp.
    """
    edge = transom_curves(net, length)
    aft = float(net.batch.part(edge[0], edge[0] + 1).xyz[0, 0]) if edge else np.nan
    for i in _flat_ends(net, length):
        ends = net.batch.part(i, i + 1).xyz[[0, -1], 1]
        if net.x[i] != aft and np.abs(ends).max() <= CENTRE:
            return i
    return None


def boss(shape: Shape) -> Boss | None:
    """Give the boss end: a flat end that begins and ends on the centre plane, not the transom."""
    net = shape.body.net
    i = boss_curve(net, shape.length)
    if i is None:
        return None
    one = net.batch.part(i, i + 1)
    places = sample(one)[1][:, 1:]
    edge_of = fit_circle(np.concatenate([places, places * [-1.0, 1.0]]))
    top = float(one.xyz[[0, -1], 2].max())
    return Boss(float(net.x[i]), top, float(edge_of.centre[1]), 2.0 * edge_of.radius)


def leaves_boss(shape: Shape, end: Boss) -> float | Absent:
    """Give x where the profile above leaves the boss, whose upper side is level, m."""
    curves = shape.take(profile_curves)
    if curves is None:
        return NO_PROFILE
    for i in range(curves.count):
        xyz = curves.part(i, i + 1).xyz
        for run in (xyz, xyz[::-1]):
            if abs(run[0, 0] - end.x) <= CENTRE and abs(run[0, 2] - end.top) <= CENTRE:
                level = np.abs(run[:, 2] - end.top) <= _LEVEL
                return float(run[int(np.append(level, False).argmin()) - 1, 0])
    return Absent("no profile above the boss")


def aft_end(shape: Shape) -> float | Absent:
    """Give x of the aft end of the profile, m."""
    curves = shape.take(profile_curves)
    if curves is None:
        return NO_PROFILE
    return float(np.concatenate(turning_places(curves, 0))[:, 0].min())


def bottom_at(shape: Shape, x: float) -> tuple[float, FloatArray] | Absent:
    """Give height (m) and direction of the profile at a place, where it is lowest."""
    found = profile_at(shape, 0, x)
    if found is None:
        return NO_PROFILE
    if not len(found.t):
        return Absent("the profile does not reach there")
    lowest = int(found.xyz[:, 2].argmin())
    return float(found.xyz[lowest, 2]), found.along[lowest]


def height_above(shape: Shape, x: float, y: float, z: float) -> float | Absent:
    """Give the height of the hull over a place, m: its lowest z there that is above `z`."""
    if y == 0.0:
        places = profile_at(shape, 0, x)
        found = np.zeros(0) if places is None else places.xyz[:, 2]
    else:
        section = section_at(shape, x)
        found = np.zeros(0) if section is None else section.heights(y)
    above = found[found > z]
    return float(above.min()) if len(above) else Absent("no hull above the screw")
