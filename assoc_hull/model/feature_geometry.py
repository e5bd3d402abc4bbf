"""How far points lie off their feature, and on which curve of the hull a feature lies.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.model.features import Feature
>>> from assoc_hull.model.feature_geometry import places_off
>>> flat = Feature("f", "flat", "f", ("l",), (1, 2), normal=(0, 1, 0), offset=25.0)
>>> places_off(flat, np.array([[0.0, 25.0, 3.0], [9.0, 25.5, 3.0]])).tolist()
[0.0, 0.5]
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.model.features import Feature
from assoc_hull.model.tables import HullState
from assoc_hull.tolerance import round_at_size

__all__ = ["host_curve", "line_numbers", "off_shapes", "places_off", "rounded_gap", "rounding_of"]

_ROUNDING = 1e-6


def rounding_of(state: HullState) -> float:
    """Give how near (m) points to a feature, its gap aside, lie on it."""
    return _ROUNDING * state.tolerances.factor


def rounded_gap(state: HullState, gap: float) -> float:
    """Give a gap in whole nanometres, of a short hull finer: the last bit must not show in it."""
    return round_at_size(gap, 9, state.tolerances.factor)


def places_off(feature: Feature, xyz: FloatArray) -> FloatArray:
    """Measure how far places lie off a feature.

    Parameters
    ----------
    feature : Feature
        A knuckle line and a join have no shape of their own to be off.
    xyz : (n, 3), m
        The places of its points, in order.

    Returns
    -------
    (n,), m
    """
    if feature.centre is not None and feature.normal is not None and feature.radius is not None:
        return _off_circle(xyz - feature.centre, np.array(feature.normal), feature.radius)
    if feature.kind == "flat" and feature.normal is not None and feature.offset is not None:
        return np.abs(dot(xyz, np.array(feature.normal)) - feature.offset)
    if feature.kind == "straight":
        return _off_chord(xyz)
    return np.zeros(len(xyz))


def off_shapes(shape: int, numbers: FloatArray, xyz: FloatArray) -> FloatArray:
    """Measure as `places_off`, of a feature as `CompiledFeatures` has it; (n,), m."""
    if shape == 0:
        return _off_circle(xyz - numbers[:3], numbers[4:], float(numbers[3]))
    if shape == 1:
        off: FloatArray = np.abs(dot(xyz, numbers[4:]) - numbers[3])
        return off
    return _off_chord(xyz) if shape == 2 else np.zeros(len(xyz))


def _off_circle(away: FloatArray, normal: FloatArray, radius: float) -> FloatArray:
    beside = dot(away, normal)
    inside = away - beside[:, None] * normal
    radial = np.sqrt(dot(inside, inside)) - radius
    return np.sqrt(radial * radial + beside * beside)


def _off_chord(xyz: FloatArray) -> FloatArray:
    """Measure distances from the straight line through the first and the last place."""
    chord, away = xyz[-1] - xyz[0], xyz - xyz[0]
    square = float((chord * chord).sum()) or 1.0
    across = away - (dot(away, chord) / square)[:, None] * chord
    return np.sqrt(dot(across, across))


def line_numbers(state: HullState) -> dict[str, int]:
    """Give the numbers of the live lines by key."""
    keys = state.lines.key.data
    return {str(keys[line]): line for line in state.live("lines").tolist()}


def host_curve(state: HullState, feature: Feature) -> int:
    """Give the curve of its lines that a feature of one curve lies on; -1 if there is none."""
    keys = state.lines.key.data
    curves = state.rows.curve[feature.points[0]].tolist()
    for curve in (each for each in curves if each >= 0):
        if keys[state.line_of(curve)] in feature.lines:
            return int(curve)
    return -1
