"""Measures of the stern: shaft, bossing, transom."""

from __future__ import annotations

import numpy as np

from assoc_hull.analysis.form.profile import tips
from assoc_hull.analysis.form.stern_profile import boss_curve, transom_curves
from assoc_hull.analysis.net.sections import CENTRE
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.numeric.circle_fit import Circle, fit_circle
from assoc_hull.geometry.splines.evaluation import sample
from assoc_hull.variation.parameters.anchor import Anchor
from assoc_hull.variation.parameters.drawn_curves import Drawn

__all__ = ["bossing_radius", "shaft_height", "transom_half_breadth", "transom_height"]

_ROUND = 1e-6
"""Defining points of a circle lie so near to it (m)."""

_BETWEEN = 20e-6
"""So near (m) lies a spline through points on a circle to it between them."""

_NO_TRANSOM = "parent has no transom across the ship"


def bossing_radius(hull: Drawn) -> Anchor:
    """Give the radius of the bossing's end circle; `x`, `h`: where its centre stands."""
    end = boss_curve(hull.net, hull.length)
    circle = None if end is None else _circle(hull.one(end))
    if end is None or circle is None:
        return Anchor("bossing_radius", "m", None, reason="parent has no bossing circle")
    x, h = float(hull.net.x[end]), float(circle.centre[1])
    return Anchor(
        "bossing_radius", "m", circle.radius, "circle through the bossing's end",
        [[x, 0.0, h], [x, 0.0, h - circle.radius], [x, 0.0, h + circle.radius]],
        hull.keys([end]), {"x": x, "h": h},
    )  # fmt: skip


def _circle(edge: SplineBatch) -> Circle | None:
    """Give the circle about the centre plane on which an edge lies, if it does.

    It is fitted to the defining points, as between them a spline is no circle to the last micron.
    """
    if len(edge.xyz) < 3:
        return None
    whole = np.concatenate([edge.xyz[:, 1:], edge.xyz[:, 1:] * [-1.0, 1.0]])
    circle = fit_circle(whole)
    between = sample(edge, 4)[1][:, 1:]
    for places, within in ((edge.xyz[:, 1:], _ROUND), (between, _BETWEEN)):
        off = np.sqrt(((places - circle.centre) ** 2).sum(axis=1)) - circle.radius
        if np.abs(off).max() > within:
            return None
    return circle


def shaft_height(hull: Drawn) -> Anchor:
    """Give the height of the shaft; `x`: of the boss end, `r`: half its height, if it is drawn.

    Without a drawn boss end it is the height at which the profile, between base line and
    design draught, comes farthest aft and goes forward again: the end of a rounded hub.
    """
    end = boss_curve(hull.net, hull.length)
    if end is None:
        return _hub(hull)
    edge = hull.one(end)
    low, high = np.sort(edge.xyz[[0, -1], 2]).tolist()
    circle, x = _circle(edge), float(hull.net.x[end])
    h = 0.5 * (low + high) if circle is None else float(circle.centre[1])
    how = "middle of the bossing's end" if circle is None else "centre of the bossing's end circle"
    return Anchor(
        "shaft_height", "m", h, how, [[x, 0.0, h]], hull.keys([end]),
        {"x": x, "r": 0.5 * (high - low) if circle is None else circle.radius},
    )  # fmt: skip


def _hub(hull: Drawn) -> Anchor:
    places = tips(hull.some(hull.profile), -1.0) if hull.profile else np.zeros((0, 3))
    z = places[:, 2]
    hubs = places[(places[:, 0] < hull.middle) & (z > 0.0) & (z < hull.ship.draught)]
    if not len(hubs):
        why = "parent has no bossing end, and its stern profile no hub below the draught"
        return Anchor("shaft_height", "m", None, reason=why)
    hub = hubs[int(hubs[:, 0].argmin())]
    return Anchor(
        "shaft_height", "m", float(hub[2]), "aftmost place of the hub on the profile", [hub],
        hull.keys(hull.profile), {"x": float(hub[0])},
    )  # fmt: skip


def transom_height(hull: Drawn) -> Anchor:
    """Give the lowest height of the transom on the centre line; `x`: where it stands."""
    low = _foot(hull)
    if low is None:
        return Anchor("transom_height", "m", None, reason=_NO_TRANSOM)
    return Anchor(
        "transom_height", "m", float(low[2]), "lowest place of the transom on the centre line",
        [low], hull.keys(transom_curves(hull.net, hull.length)), {"x": float(low[0])},
    )  # fmt: skip


def transom_half_breadth(hull: Drawn) -> Anchor:
    """Give the greatest half-breadth of the transom.

    `x`: where it stands; `z`: where it is broadest; `foot`: its lowest z on the centre line.
    """
    edge, low = transom_curves(hull.net, hull.length), _foot(hull)
    if low is None:
        return Anchor("transom_half_breadth", "m", None, reason=_NO_TRANSOM)
    wide = hull.extreme(edge, 1)
    return Anchor(
        "transom_half_breadth", "m", float(wide[1]), "greatest y of the transom's edge", [wide],
        hull.keys(edge), {"x": float(wide[0]), "z": float(wide[2]), "foot": float(low[2])},
    )  # fmt: skip


def _foot(hull: Drawn) -> FloatArray | None:
    """Give the lowest place of the transom on the centre line, (3,), m."""
    edge = transom_curves(hull.net, hull.length)
    if not edge:
        return None
    xyz = hull.some(edge).xyz
    centre = xyz[np.abs(xyz[:, 1]) <= CENTRE]
    if not len(centre):
        return None
    found: FloatArray = centre[int(centre[:, 2].argmin())]
    return found
