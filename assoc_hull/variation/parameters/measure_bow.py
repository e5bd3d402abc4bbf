"""Measures of the bow: bulb and stem."""

from __future__ import annotations

import numpy as np

from assoc_hull.analysis.form.profile import LEAST_BULB, tips
from assoc_hull.geometry.curves import CurveData, FloatArray, SplineBatch
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_places import across, turning_places
from assoc_hull.variation.parameters.anchor import Anchor
from assoc_hull.variation.parameters.drawn_curves import Drawn
from assoc_hull.variation.parameters.measure_hull import fore_end_at_draught

__all__ = ["bulb_half_breadth", "bulb_height", "bulb_length", "stem_rake_deg"]

_ON = 1e-4
"""So near to FP (m) a section is that at FP."""

_APART = 1e-3
"""Waterlines nearer than this (m) to the profile give no place of their own to a section."""


def bulb_tip(hull: Drawn) -> FloatArray | None:
    """Give the foremost place of the bulb, (3,), m: a root of dx = 0 of the profile, or a corner.

    It lies before FP and below the design draught, and the profile runs back both ways.
    """
    if not hull.profile:
        return None
    places = tips(hull.some(hull.profile))
    fore = places[(places[:, 2] < hull.ship.draught) & (places[:, 0] > hull.length + LEAST_BULB)]
    if not len(fore):
        return None
    found: FloatArray = fore[int(fore[:, 0].argmax())]
    return found


def _none(hull: Drawn, name: str) -> Anchor:
    reason = f"no profile forward of FP below z={hull.ship.draught:.3f}"
    return Anchor(name, "m", None, reason=reason)


def _reach(hull: Drawn, tip: FloatArray) -> tuple[float, float]:
    """Give the heights (m) between which the bulb stands at FP; the draught if it has no top."""
    z = np.sort(hull.across(hull.profile, 0, hull.length).xyz[:, 2])
    under, over = z[z < tip[2]], z[z > tip[2]]
    return (float(under[-1]) if len(under) else 0.0,
            float(over[0]) if len(over) else hull.ship.draught)  # fmt: skip


def _shape(hull: Drawn, tip: FloatArray) -> dict[str, float]:
    """Give tip (`x`, `z`), and lowest and highest z of the bulb at FP (`low`, `top`)."""
    low, top = _reach(hull, tip)
    return {"x": float(tip[0]), "z": float(tip[2]), "low": low, "top": top}


def bulb_length(hull: Drawn) -> Anchor:
    """Give how far the bulb reaches before FP; `x`, `z`, `low`, `top`: tip, and bulb at FP."""
    tip = bulb_tip(hull)
    if tip is None:
        return _none(hull, "bulb_length")
    return Anchor(
        "bulb_length", "m", float(tip[0]) - hull.length, "x of the bulb's tip from FP", [tip],
        hull.keys(hull.profile), _shape(hull, tip),
    )  # fmt: skip


def bulb_height(hull: Drawn) -> Anchor:
    """Give the height of the bulb's tip; `x`, `z`, `low`, `top`: tip, and bulb at FP."""
    tip = bulb_tip(hull)
    if tip is None:
        return _none(hull, "bulb_height")
    return Anchor(
        "bulb_height", "m", float(tip[2]), "z of the bulb's tip", [tip],
        hull.keys(hull.profile), _shape(hull, tip),
    )  # fmt: skip


def bulb_half_breadth(hull: Drawn) -> Anchor:
    """Give the greatest half-breadth at FP below the design draught.

    `at`: its height; `x`, `z`, `low`, `top`: the bulb's tip, and the bulb at FP.
    """
    tip = bulb_tip(hull)
    if tip is None:
        return _none(hull, "bulb_half_breadth")
    used, curves, how = _section_at_fp(hull, tip)
    if curves is None:
        why = "fewer than two waterlines pass the bulb at FP, and no section stands there"
        return Anchor("bulb_half_breadth", "m", None, reason=why)
    level = across(curves, 2, hull.ship.draught).xyz
    places = np.concatenate([*turning_places(curves, 1), level])
    low = places[places[:, 2] <= hull.ship.draught + 1e-9]
    wide = low[int(low[:, 1].argmax())]
    return Anchor(
        "bulb_half_breadth", "m", float(wide[1]), how, [wide], hull.keys(used),
        {**_shape(hull, tip), "at": float(wide[2])},
    )  # fmt: skip


def _section_at_fp(hull: Drawn, tip: FloatArray) -> tuple[list[int], SplineBatch | None, str]:
    """Give the section at FP, the curves it was taken from, and how.

    Without a section that stands there it is lofted through the places where the waterlines and
    the profile pass FP, as a section that is added to the net is.
    """
    there = [i for i in hull.sections.tolist() if abs(hull.net.x[i] - hull.length) <= _ON]
    if there:
        return there, hull.some(there), "greatest y of the section at FP"
    low, top = _reach(hull, tip)
    found = hull.across(hull.waterlines.tolist(), 0, hull.length)
    inside = (found.xyz[:, 2] > low + _APART) & (found.xyz[:, 2] < top - _APART)
    xyz, curve = found.xyz[inside], found.curve[inside]
    order = np.lexsort((-xyz[:, 1], xyz[:, 2]))
    xyz, curve = xyz[order], curve[order]
    outer = np.append(True, np.diff(xyz[:, 2]) > _APART)
    if outer.sum() < 2:
        return [], None, ""
    ends = hull.across(hull.profile, 0, hull.length).xyz
    foot, head = ends[np.abs(ends[:, 2] - low) <= 1e-9][:1], ends[ends[:, 2] == top][:1]
    section = loft(CurveData.single(np.concatenate([foot, xyz[outer], head])))
    used = [*hull.waterlines[curve[outer]].tolist(), *hull.profile]
    return used, section, "greatest y of the section cut from waterlines and profile at FP"


def stem_rake_deg(hull: Drawn) -> Anchor:
    """Give the angle between the stem, from the design draught to its top, and the vertical.

    `x`, `z` where it passes the design draught; `top_x`, `top_z` of its top.
    """
    stem = fore_end_at_draught(hull)
    if stem is None:
        why = f"no profile forward at z={hull.ship.draught:.3f}"
        return Anchor("stem_rake_deg", "deg", None, reason=why)
    xyz = hull.some(hull.profile).xyz
    fore = xyz[xyz[:, 0] > hull.middle]
    top = fore[int(fore[:, 2].argmax())]
    if top[2] <= stem[2] + LEAST_BULB:
        why = f"no stem above z={hull.ship.draught:.3f}"
        return Anchor("stem_rake_deg", "deg", None, reason=why)
    rake = float(np.degrees(np.arctan2(top[0] - stem[0], top[2] - stem[2])))
    return Anchor(
        "stem_rake_deg", "deg", rake, "chord of the stem above the draught, from the vertical",
        [stem, top], hull.keys(hull.profile),
        {"x": float(stem[0]), "z": float(stem[2]), "top_x": float(top[0]), "top_z": float(top[2])},
    )  # fmt: skip
