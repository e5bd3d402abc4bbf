"""Measures of the midship section: bilge, deadrise, flat of bottom."""

from __future__ import annotations

import numpy as np

from assoc_hull.analysis.net.sections import CENTRE
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.splines.evaluation import derivative
from assoc_hull.geometry.splines.plane_places import across
from assoc_hull.variation.parameters.anchor import Anchor
from assoc_hull.variation.parameters.bilge import Bilge, bilge_of
from assoc_hull.variation.parameters.drawn_curves import Drawn

__all__ = ["bilge_radius", "deadrise_deg", "flat_of_bottom"]

_LEVEL = 1e-6
"""So near to the lowest place (m) the bottom is level."""


def bilge_radius(hull: Drawn) -> Anchor:
    """Give the radius of the bilge at the section nearest to midship.

    `yc`, `zc`: centre; `low_y`, `low_z`, `high_y`, `high_z`: where it leaves bottom and side;
    `rise_deg`: slope of the bottom; `off`: how far its defining points lie off the circle, m;
    `corner_y`, `corner_z`: where bottom and side would meet.
    """
    bilge = hull.take(bilge_of)
    if isinstance(bilge, str):
        return Anchor("bilge_radius", "m", None, reason=bilge)
    slope = _slope(hull, bilge)
    how = (
        "circle through the bilge amidships" if bilge.arc
        else "circle through both ends of the bilge amidships and the place half-way between"
    )  # fmt: skip
    low, high = bilge.low, bilge.high
    return Anchor(
        "bilge_radius", "m", bilge.radius, how, [low, high], hull.keys([bilge.section]),
        {
            "x": float(low[0]), "yc": float(bilge.centre[0]), "zc": float(bilge.centre[1]),
            "low_y": float(low[1]), "low_z": float(low[2]),
            "high_y": float(high[1]), "high_z": float(high[2]),
            "rise_deg": float(np.degrees(np.arctan(slope))), "off": bilge.off,
            "corner_y": float(high[1]),
            "corner_z": float(low[2] + slope * (high[1] - low[1])),
        },
    )  # fmt: skip


def deadrise_deg(hull: Drawn) -> Anchor:
    """Give the slope of the bottom at the section nearest to midship.

    With a bilge it is that of the chord over the outer half of the bottom, which a level keel
    plate and a rounding beside it do not change; else that of the section at the keel. `keel`:
    half-breadth of the level part at the keel, nil if all is level; `x`; `edge_y`, `edge_z`: where
    the bottom ends.
    """
    bilge = hull.take(bilge_of)
    if isinstance(bilge, str):
        return _at_keel(hull)
    slope, low = _slope(hull, bilge), bilge.low
    place = low - 0.5 * low[1] * np.array([0.0, 1.0, slope])
    return Anchor(
        "deadrise_deg", "deg", float(np.degrees(np.arctan(slope))),
        "slope of the outer half of the bottom amidships", np.array([place, low]),
        hull.keys([bilge.section]),
        {"x": float(low[0]), "keel": _keel(hull, bilge), "edge_y": float(low[1]),
         "edge_z": float(low[2])},
    )  # fmt: skip


def _slope(hull: Drawn, bilge: Bilge) -> float:
    """Give the slope of the bottom over its outer half."""
    curve, low = hull.one(bilge.section), bilge.low
    half = across(curve, 1, 0.5 * float(low[1])).xyz
    inner = half[int(half[:, 2].argmin())]
    return float((low[2] - inner[2]) / (low[1] - inner[1]))


def _keel(hull: Drawn, bilge: Bilge) -> float:
    """Give the half-breadth (m) over which the bottom is level at the keel; 0 if all of it is."""
    xyz = hull.one(bilge.section).xyz
    level = xyz[xyz[:, 2] <= xyz[:, 2].min() + _LEVEL, 1].max()
    return 0.0 if level >= bilge.low[1] - _LEVEL else float(level)


def _at_keel(hull: Drawn) -> Anchor:
    section = hull.section_amidships
    if section is None:
        reason = "parent has no section across the ship"
        return Anchor("deadrise_deg", "deg", None, reason=reason)
    curve = hull.one(section)
    end = 0 if curve.xyz[0, 2] <= curve.xyz[-1, 2] else -1
    keel = curve.xyz[end]
    if abs(keel[1]) > CENTRE:
        reason = "the section amidships does not reach the centre plane"
        return Anchor("deadrise_deg", "deg", None, reason=reason)
    ahead = derivative(curve, np.zeros(1, np.int64), curve.knot[[end]])[0]
    value = float(np.degrees(np.arctan2(abs(ahead[2]), abs(ahead[1]))))
    return Anchor(
        "deadrise_deg", "deg", value, "slope of the section amidships at the keel", [keel],
        hull.keys([section]),
        {"x": float(keel[0]), "keel": 0.0, "edge_y": 0.0, "edge_z": float(keel[2])},
    )  # fmt: skip


def flat_of_bottom(hull: Drawn) -> Anchor:
    """Give the half-breadth of the flat of bottom amidships; `x`, `z`: where its edge is."""
    xyz = hull.across(hull.flats_of_bottom, 0, hull.middle).xyz
    if len(xyz):
        edge = xyz[int(xyz[:, 1].argmax())]
        return _edge(edge, "border of the flat of bottom amidships", hull, hull.flats_of_bottom)
    bilge = hull.take(bilge_of)
    if isinstance(bilge, str):
        return Anchor("flat_of_bottom", "m", None, reason="parent has no flat of bottom amidships")
    return _edge(bilge.low, "end of the straight bottom amidships", hull, [bilge.section])


def _edge(place: FloatArray, how: str, hull: Drawn, curves: list[int]) -> Anchor:
    return Anchor(
        "flat_of_bottom", "m", float(place[1]), how, [place], hull.keys(curves),
        {"x": float(place[0]), "z": float(place[2])},
    )  # fmt: skip
