"""Measures of the hull and of its ends: dimensions, deck, bulb, stem, stern, frames, waterline.

Each function takes the drawn curves and gives a `MeasuredParameter`; its name is the name of the
parameter, and what it puts into `numbers` stands in its docstring, in m. x from AP forward, z from
the base line up. Extremes are roots of derivatives of the splines, not defining points.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

import attrs
import numpy as np

from assoc_hull.analysis.form.profile import LEAST_BULB, boss_curve, tips, transom_curves
from assoc_hull.geometry.curves import CurveData, FloatArray, SplineBatch
from assoc_hull.geometry.numeric.circle_fit import CircleFit, fit_circle
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import coordinate_turns, points_at_coordinate
from assoc_hull.geometry.splines.segments import derivative, evaluate, sample
from assoc_hull.variation.parameters.measurement import (
    GAUSS,
    DrawnCurves,
    MeasuredParameter,
    SectionFrames,
    frame_at,
    frames_beside,
)

__all__ = [
    "ENTRANCE",
    "FRAMES",
    "RUN",
    "aft_frame_height",
    "bossing_radius",
    "breadth",
    "bulb_area",
    "bulb_frame",
    "bulb_half_breadth",
    "bulb_height",
    "bulb_length",
    "bulb_section_height",
    "deck_height",
    "depth",
    "design_waterline",
    "draught",
    "drawn_breadth",
    "entrance_deg",
    "fore_end_at_draught",
    "fore_frame_height",
    "length",
    "run_deg",
    "shaft_height",
    "sheer_aft",
    "sheer_fore",
    "stem_rake_deg",
    "transom_half_breadth",
    "transom_height",
    "waterline_ends",
    "waterline_fullness",
]

# --------------------------------------------------------------------------------------
# The whole hull: dimensions and deck.

_NO_DECK = "parent has no deck edge amidships"


def fore_end_at_draught(hull: DrawnCurves) -> FloatArray | None:
    """Give where the stem passes the design draught, (3,), m; None without a profile there.

    Of several places the aftmost: those before it are of a bulb whose top is above the draught.
    """
    xyz = hull.across(hull.profile, 2, hull.ship.draught).xyz
    fore = xyz[xyz[:, 0] > hull.middle]
    if not len(fore):
        return None
    found: FloatArray = fore[int(fore[:, 0].argmin())]
    return found


def length(hull: DrawnCurves) -> MeasuredParameter:
    """Give Lpp as stored; `stem`: x at which the profile passes the design draught."""
    stem = fore_end_at_draught(hull)
    aft = [0.0, 0.0, hull.ship.draught]
    return MeasuredParameter(
        "length", "m", hull.length, "the stored particular",
        [aft, [hull.length, 0.0, hull.ship.draught]], hull.keys(hull.profile),
        {} if stem is None else {"stem": float(stem[0])},
    )  # fmt: skip


def breadth(hull: DrawnCurves) -> MeasuredParameter:
    """Give B as stored; `drawn`: twice the greatest y of all curves, which may differ from it.

    Lines may bulge between the offsets of a table, and flare above the waterline that B is of.
    """
    place = hull.extreme(range(hull.net.batch.count), 1)
    return MeasuredParameter(
        "breadth", "m", hull.ship.breadth, "the stored particular", [place],
        numbers={"drawn": 2.0 * float(place[1])},
    )  # fmt: skip


_SHOWN = 5e-4
"""m: breadths that differ by less are printed alike."""


def drawn_breadth(measured: MeasuredParameter) -> tuple[str, ...]:
    """Tell where lines are not drawn as broad as the ship is; nothing where they are.

    Examples
    --------
    >>> from assoc_hull.variation.parameters.hull_and_end_measures import drawn_breadth
    >>> from assoc_hull.variation.parameters.measurement import MeasuredParameter
    >>> flared = MeasuredParameter(
    ...     "breadth", "m", 9.0, places=[[29.8, 4.6, 4.0]], numbers={"drawn": 9.2}
    ... )
    >>> drawn_breadth(flared)
    ('the lines are at most 9.2 m broad, at x=29.8 z=4, where the breadth of the ship is 9 m',)
    """
    ship, drawn = measured.value, measured.numbers["drawn"]
    if ship is None or abs(drawn - ship) < _SHOWN:
        return ()
    x, _, z = np.round(measured.places[0], 3).tolist()
    return (
        f"the lines are at most {round(drawn, 3):g} m broad, at x={x:g} z={z:g}, where the breadth "
        f"of the ship is {round(ship, 3):g} m",
    )


def draught(hull: DrawnCurves) -> MeasuredParameter:
    """Give the stored design draught."""
    place = [hull.middle, 0.0, hull.ship.draught]
    return MeasuredParameter("draught", "m", hull.ship.draught, "the stored particular", [place])


def depth(hull: DrawnCurves) -> MeasuredParameter:
    """Give the height of the deck edge amidships."""
    place = _deck_at(hull, hull.middle)
    if place is None:
        return MeasuredParameter("depth", "m", None, reason=_NO_DECK)
    return MeasuredParameter(
        "depth", "m", float(place[2]), "deck edge amidships", [place], hull.keys(hull.deck_edge)
    )


def deck_height(hull: DrawnCurves) -> MeasuredParameter:
    """Give the height of the deck edge amidships, from which the deck is raised as it is.

    `at_AP`, `at_midship`, `at_FP`: its heights there, where it reaches so far.
    """
    at = {"at_midship": hull.middle, "at_AP": 0.0, "at_FP": hull.length}
    found = {name: _deck_at(hull, x) for name, x in at.items()}
    there = {name: place for name, place in found.items() if place is not None}
    if "at_midship" not in there:
        return MeasuredParameter("deck_height", "m", None, reason=_NO_DECK)
    return MeasuredParameter(
        "deck_height", "m", float(there["at_midship"][2]), "deck edge amidships",
        np.array(list(there.values())), hull.keys(hull.deck_edge),
        {name: float(place[2]) for name, place in there.items()},
    )  # fmt: skip


def sheer_fore(hull: DrawnCurves) -> MeasuredParameter:
    """Give by how much the deck edge is higher at FP than amidships."""
    return _sheer(hull, "sheer_fore", "FP", hull.length)


def sheer_aft(hull: DrawnCurves) -> MeasuredParameter:
    """Give by how much the deck edge is higher at AP than amidships."""
    return _sheer(hull, "sheer_aft", "AP", 0.0)


def _sheer(hull: DrawnCurves, name: str, end: str, x: float) -> MeasuredParameter:
    """Give the sheer at one end."""
    middle, there = _deck_at(hull, hull.middle), _deck_at(hull, x)
    if middle is None or there is None:
        why = _NO_DECK if middle is None else f"the deck edge does not reach the {end}"
        return MeasuredParameter(name, "m", None, reason=why)
    return MeasuredParameter(
        name, "m", float(there[2] - middle[2]), f"deck edge at {end}, above that amidships",
        np.array([there, middle]), hull.keys(hull.deck_edge),
    )  # fmt: skip


def _deck_at(hull: DrawnCurves, x: float) -> FloatArray | None:
    """Give the highest place of the deck edge at an x, (3,), m."""
    xyz = hull.across(hull.deck_edge, 0, x).xyz
    if not len(xyz):
        return None
    found: FloatArray = xyz[int(xyz[:, 2].argmax())]
    return found


# --------------------------------------------------------------------------------------
# The bow: bulb and stem.

_ON = 1e-4
"""A section as near as this (m) to FP is that at FP."""

_APART = 1e-3
"""Waterlines nearer than this (m) to the profile give no place of their own to a section."""


def bulb_tip(hull: DrawnCurves) -> FloatArray | None:
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


def _no_bulb(hull: DrawnCurves, name: str) -> MeasuredParameter:
    """Give the measure of a bulb that the hull does not have."""
    reason = f"no profile forward of FP below z={hull.ship.draught:.3f}"
    return MeasuredParameter(name, "m", None, reason=reason)


def _reach(hull: DrawnCurves, tip: FloatArray) -> tuple[float, float]:
    """Give the heights (m) between which the bulb stands at FP; the draught if it has no top."""
    z = np.sort(hull.across(hull.profile, 0, hull.length).xyz[:, 2])
    under, over = z[z < tip[2]], z[z > tip[2]]
    return (float(under[-1]) if len(under) else 0.0,
            float(over[0]) if len(over) else hull.ship.draught)  # fmt: skip


def _shape(hull: DrawnCurves, tip: FloatArray) -> dict[str, float]:
    """Give tip (`x`, `z`), and lowest and highest z of the bulb at FP (`low`, `top`)."""
    low, top = _reach(hull, tip)
    return {"x": float(tip[0]), "z": float(tip[2]), "low": low, "top": top}


def bulb_length(hull: DrawnCurves) -> MeasuredParameter:
    """Give how far the bulb reaches before FP; `x`, `z`, `low`, `top`: tip, and bulb at FP."""
    tip = bulb_tip(hull)
    if tip is None:
        return _no_bulb(hull, "bulb_length")
    return MeasuredParameter(
        "bulb_length", "m", float(tip[0]) - hull.length, "x of the bulb's tip from FP", [tip],
        hull.keys(hull.profile), _shape(hull, tip),
    )  # fmt: skip


def bulb_height(hull: DrawnCurves) -> MeasuredParameter:
    """Give the height of the bulb's tip; `x`, `z`, `low`, `top`: tip, and bulb at FP."""
    tip = bulb_tip(hull)
    if tip is None:
        return _no_bulb(hull, "bulb_height")
    return MeasuredParameter(
        "bulb_height", "m", float(tip[2]), "z of the bulb's tip", [tip],
        hull.keys(hull.profile), _shape(hull, tip),
    )  # fmt: skip


def bulb_half_breadth(hull: DrawnCurves) -> MeasuredParameter:
    """Give the greatest half-breadth at FP below the design draught.

    `at`: its height; `x`, `z`, `low`, `top`: the bulb's tip, and the bulb at FP.
    """
    tip = bulb_tip(hull)
    if tip is None:
        return _no_bulb(hull, "bulb_half_breadth")
    used, curves, whence = _section_at_fp(hull, tip)
    if curves is None:
        return MeasuredParameter("bulb_half_breadth", "m", None, reason=_NO_SECTION)
    level = points_at_coordinate(curves, 2, hull.ship.draught).xyz
    places = np.concatenate([*coordinate_turns(curves, 1), level])
    low = places[places[:, 2] <= hull.ship.draught + 1e-9]
    wide = low[int(low[:, 1].argmax())]
    return MeasuredParameter(
        "bulb_half_breadth", "m", float(wide[1]), f"greatest y of {whence}", [wide],
        hull.keys(used), {**_shape(hull, tip), "at": float(wide[2])},
    )  # fmt: skip


def bulb_area(hull: DrawnCurves) -> MeasuredParameter:
    """Give the area of the section at FP below the design draught, both halves, m2."""
    return _of_bulb_section(
        hull, "bulb_area", "m2", "area up to T of", lambda frame: 2.0 * float(frame.areas[0])
    )


def bulb_section_height(hull: DrawnCurves) -> MeasuredParameter:
    """Give the height of the centre of area of the section at FP below the design draught."""
    return _of_bulb_section(
        hull, "bulb_section_height", "m", "centre of area up to T of",
        lambda frame: float(frame.heights[0]),
    )  # fmt: skip


def _of_bulb_section(
    hull: DrawnCurves, name: str, unit: str, how: str, value: Callable[[SectionFrames], float]
) -> MeasuredParameter:
    """Measure the section at FP; `x`, `z`, `low`, `top`: the bulb's tip, and the bulb at FP."""
    tip = bulb_tip(hull)
    if tip is None:
        return attrs.evolve(_no_bulb(hull, name), unit=unit)
    frame = hull.take(bulb_frame)
    if frame is None:
        return MeasuredParameter(name, unit, None, reason=_NO_SECTION)
    used, _, whence = _section_at_fp(hull, tip)
    return MeasuredParameter(
        name, unit, value(frame), f"{how} {whence}", [[hull.length, 0.0, float(frame.heights[0])]],
        hull.keys(used), _shape(hull, tip),
    )  # fmt: skip


def bulb_frame(hull: DrawnCurves) -> SectionFrames | None:
    """Give the bulb's section at FP up to the draught; None for a hull that has none."""
    tip = bulb_tip(hull)
    if tip is None:
        return None
    curves = _section_at_fp(hull, tip)[1]
    frame = None if curves is None else frame_at(curves, hull.length, hull.ship.draught)
    return frame if frame is not None and frame.areas[0] > 0.0 else None


_NO_SECTION = "fewer than two waterlines pass the bulb at FP, and no section stands there"


def _section_at_fp(hull: DrawnCurves, tip: FloatArray) -> tuple[list[int], SplineBatch | None, str]:
    """Give the section at FP, the curves it was taken from, and how.

    Without a section that stands there it is lofted through the places where the waterlines and
    the profile pass FP, as a section that is added to the net is.
    """
    there = [i for i in hull.sections.tolist() if abs(hull.net.x[i] - hull.length) <= _ON]
    if there:
        return there, hull.some(there), "the section at FP"
    low, top = _reach(hull, tip)
    found = hull.across(hull.waterlines.tolist(), 0, hull.length)
    inside = (found.xyz[:, 2] > low + _APART) & (found.xyz[:, 2] < top - _APART)
    xyz, curve = found.xyz[inside], found.curve[inside]
    # from below, and of several at one height the outermost first: only that is kept
    order = np.lexsort((-xyz[:, 1], xyz[:, 2]))
    xyz, curve = xyz[order], curve[order]
    outer = np.append(True, np.diff(xyz[:, 2]) > _APART)
    if outer.sum() < 2:
        return [], None, ""
    ends = hull.across(hull.profile, 0, hull.length).xyz
    foot, head = ends[np.abs(ends[:, 2] - low) <= 1e-9][:1], ends[ends[:, 2] == top][:1]
    section = loft(CurveData.single(np.concatenate([foot, xyz[outer], head])))
    used = [*hull.waterlines[curve[outer]].tolist(), *hull.profile]
    return used, section, "the section cut from waterlines and profile at FP"


def stem_rake_deg(hull: DrawnCurves) -> MeasuredParameter:
    """Give the angle between the stem, from the design draught to its top, and the vertical.

    `x`, `z` where it passes the design draught; `top_x`, `top_z` of its top.
    """
    stem = fore_end_at_draught(hull)
    if stem is None:
        why = f"no profile forward at z={hull.ship.draught:.3f}"
        return MeasuredParameter("stem_rake_deg", "deg", None, reason=why)
    xyz = hull.some(hull.profile).xyz
    fore = xyz[xyz[:, 0] > hull.middle]
    top = fore[int(fore[:, 2].argmax())]
    if top[2] <= stem[2] + LEAST_BULB:
        why = f"no stem above z={hull.ship.draught:.3f}"
        return MeasuredParameter("stem_rake_deg", "deg", None, reason=why)
    rake = float(np.degrees(np.arctan2(top[0] - stem[0], top[2] - stem[2])))
    return MeasuredParameter(
        "stem_rake_deg", "deg", rake, "chord of the stem above the draught, from the vertical",
        [stem, top], hull.keys(hull.profile),
        {"x": float(stem[0]), "z": float(stem[2]), "top_x": float(top[0]), "top_z": float(top[2])},
    )  # fmt: skip


# --------------------------------------------------------------------------------------
# The stern: shaft, bossing, transom.

_ROUND = 1e-6
"""Defining points of a circle lie as near as this (m) to it."""

_BETWEEN = 20e-6
"""A spline through points of a circle lies as near as this (m) to it between them."""

_NO_TRANSOM = "parent has no transom across the ship"


def bossing_radius(hull: DrawnCurves) -> MeasuredParameter:
    """Give the radius of the bossing's end circle; `x`, `h`: where its centre stands."""
    end = boss_curve(hull.net, hull.length)
    circle = None if end is None else _circle(hull.one(end))
    if end is None or circle is None:
        return MeasuredParameter("bossing_radius", "m", None, reason="parent has no bossing circle")
    x, h = float(hull.net.x[end]), float(circle.centre[1])
    return MeasuredParameter(
        "bossing_radius", "m", circle.radius, "circle through the bossing's end",
        [[x, 0.0, h], [x, 0.0, h - circle.radius], [x, 0.0, h + circle.radius]],
        hull.keys([end]), {"x": x, "h": h},
    )  # fmt: skip


def _circle(edge: SplineBatch) -> CircleFit | None:
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


def shaft_height(hull: DrawnCurves) -> MeasuredParameter:
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
    return MeasuredParameter(
        "shaft_height", "m", h, how, [[x, 0.0, h]], hull.keys([end]),
        {"x": x, "r": 0.5 * (high - low) if circle is None else circle.radius},
    )  # fmt: skip


def _hub(hull: DrawnCurves) -> MeasuredParameter:
    """Give the shaft's height from the profile: the aftmost place of a rounded hub."""
    places = tips(hull.some(hull.profile), -1.0) if hull.profile else np.zeros((0, 3))
    z = places[:, 2]
    hubs = places[(places[:, 0] < hull.middle) & (z > 0.0) & (z < hull.ship.draught)]
    if not len(hubs):
        why = "parent has no bossing end, and its stern profile no hub below the draught"
        return MeasuredParameter("shaft_height", "m", None, reason=why)
    hub = hubs[int(hubs[:, 0].argmin())]
    return MeasuredParameter(
        "shaft_height", "m", float(hub[2]), "aftmost place of the hub on the profile", [hub],
        hull.keys(hull.profile), {"x": float(hub[0])},
    )  # fmt: skip


def transom_height(hull: DrawnCurves) -> MeasuredParameter:
    """Give the lowest height of the transom on the centre line; `x`: where it stands."""
    low = _foot(hull)
    if low is None:
        return MeasuredParameter("transom_height", "m", None, reason=_NO_TRANSOM)
    return MeasuredParameter(
        "transom_height", "m", float(low[2]), "lowest place of the transom on the centre line",
        [low], hull.keys(transom_curves(hull.net, hull.length)), {"x": float(low[0])},
    )  # fmt: skip


def transom_half_breadth(hull: DrawnCurves) -> MeasuredParameter:
    """Give the greatest half-breadth of the transom.

    `x`: where it stands; `z`: where it is broadest; `foot`: its lowest z on the centre line.
    """
    edge, low = transom_curves(hull.net, hull.length), _foot(hull)
    if low is None:
        return MeasuredParameter("transom_half_breadth", "m", None, reason=_NO_TRANSOM)
    wide = hull.extreme(edge, 1)
    return MeasuredParameter(
        "transom_half_breadth", "m", float(wide[1]), "greatest y of the transom's edge", [wide],
        hull.keys(edge), {"x": float(wide[0]), "z": float(wide[2]), "foot": float(low[2])},
    )  # fmt: skip


def _foot(hull: DrawnCurves) -> FloatArray | None:
    """Give the lowest place of the transom on the centre line, (3,), m."""
    edge = transom_curves(hull.net, hull.length)
    if not edge:
        return None
    xyz = hull.some(edge).xyz
    centre = xyz[np.abs(xyz[:, 1]) <= hull.net.on_centre]
    if not len(centre):
        return None
    found: FloatArray = centre[int(centre[:, 2].argmin())]
    return found


# --------------------------------------------------------------------------------------
# The character of frames.

FRAMES: Mapping[str, float] = MappingProxyType(
    {"fore_frame_height": 0.925, "aft_frame_height": 0.1}
)
"""Where the character of frames is measured, in parts of Lpp."""


def fore_frame_height(hull: DrawnCurves) -> MeasuredParameter:
    """Give the height of the centre of area up to the draught at .925 Lpp; `area`: of it all."""
    return _frame_height(hull, "fore_frame_height")


def aft_frame_height(hull: DrawnCurves) -> MeasuredParameter:
    """Give the height of the centre of area up to the draught at .1 Lpp; `area`: of it all."""
    return _frame_height(hull, "aft_frame_height")


def _frame_height(hull: DrawnCurves, name: str) -> MeasuredParameter:
    """Measure between the two sections beside the place, in proportion."""
    x = FRAMES[name] * hull.length
    frames = frames_beside(hull, x)
    if frames is None or len(frames.x) < 2:
        why = f"no sections with area below the draught on both sides of x={x:.6g}"
        return MeasuredParameter(name, "m", None, reason=why)
    weights = frames.beside(x)
    z = float((weights * frames.heights).sum())
    return MeasuredParameter(
        name, "m", z, f"centre of area up to T of the section at {FRAMES[name]:g} Lpp",
        [[x, 0.0, z]], numbers={"area": 2.0 * float((weights * frames.areas).sum())},
    )  # fmt: skip


# --------------------------------------------------------------------------------------
# The design waterline.

ENTRANCE, RUN = 0.05, 0.05
"""Over these parts of Lpp from its ends the chord of the design waterline is taken."""

_SAME = 1e-6
"""m: a waterline as near as this to the draught is the design waterline."""

_FEW = 4
"""Places through which a waterline is lofted, at least."""


def design_waterline(hull: DrawnCurves) -> SplineBatch | str:
    """Give the waterline at the draught, or say why there is none.

    Without one that is drawn there it is lofted through the outermost places of sections and the
    ends of the profile.
    """
    t = hull.ship.draught
    drawn = [i for i in hull.waterlines.tolist() if abs(hull.one(i).xyz[0, 2] - t) <= _SAME]
    if drawn:
        return hull.some(drawn)
    across = np.flatnonzero(np.isfinite(hull.net.x)).tolist()
    xyz = np.concatenate([hull.across(across, 2, t).xyz, hull.across(hull.profile, 2, t).xyz])
    order = np.lexsort((-xyz[:, 1], xyz[:, 0]))
    xyz = xyz[order]
    outer = np.append(True, np.diff(xyz[:, 0]) > _SAME) if len(xyz) else np.zeros(0, bool)
    if outer.sum() < _FEW:
        return f"fewer than {_FEW} sections pass the draught, z={t:.3f}"
    return loft(CurveData.single(xyz[outer]))


def waterline_ends(waterline: SplineBatch) -> tuple[FloatArray, FloatArray]:
    """Give the aftmost and the foremost place of a waterline, (3,), m."""
    xyz = waterline.xyz
    return xyz[int(xyz[:, 0].argmin())].copy(), xyz[int(xyz[:, 0].argmax())].copy()


def entrance_deg(hull: DrawnCurves) -> MeasuredParameter:
    """Give the half angle of entrance of the design waterline, by its chord at the fore end."""
    return _chord(hull, "entrance_deg", 1, ENTRANCE)


def run_deg(hull: DrawnCurves) -> MeasuredParameter:
    """Give the half angle of run of the design waterline, by its chord at the after end."""
    return _chord(hull, "run_deg", 0, RUN)


def _chord(hull: DrawnCurves, name: str, end: int, part: float) -> MeasuredParameter:
    """Measure the angle of the chord from an end (0 aft, 1 fore) over a part of Lpp."""
    waterline = hull.take(design_waterline)
    if isinstance(waterline, str):
        return MeasuredParameter(name, "deg", None, reason=waterline)
    tip, reach = waterline_ends(waterline)[end], part * hull.length
    there = points_at_coordinate(waterline, 0, float(tip[0]) + (reach if end == 0 else -reach)).xyz
    if not len(there):
        why = f"the design waterline is shorter than {reach:.4g} m"
        return MeasuredParameter(name, "deg", None, reason=why)
    inner = there[int(there[:, 1].argmax())]
    angle = float(np.degrees(np.arctan2(inner[1] - tip[1], reach)))
    return MeasuredParameter(
        name, "deg", angle, f"chord of the design waterline over {part:g} Lpp", [inner, tip],
    )  # fmt: skip


def waterline_fullness(hull: DrawnCurves) -> MeasuredParameter:
    """Give the coefficient of the design waterline: its area by Lpp and B."""
    waterline = hull.take(design_waterline)
    if isinstance(waterline, str):
        return MeasuredParameter("waterline_fullness", "-", None, reason=waterline)
    ends = waterline_ends(waterline)
    value = 2.0 * abs(_area_over_x(waterline)) / (hull.length * hull.ship.breadth)
    return MeasuredParameter(
        "waterline_fullness", "-", value, "area of the design waterline by Lpp and breadth",
        np.array(ends),
    )  # fmt: skip


def _area_over_x(batch: SplineBatch) -> float:
    """Give the integral of y over x of curves, m2, exactly."""
    owner = np.repeat(np.arange(batch.count), np.diff(batch.start))
    inside = owner[1:] == owner[:-1]
    begin, end = batch.knot[:-1][inside], batch.knot[1:][inside]
    half, nodes = 0.5 * (end - begin), GAUSS[0]
    t = (0.5 * (begin + end))[:, None] + half[:, None] * nodes
    curve = np.repeat(owner[:-1][inside], len(nodes))
    y = evaluate(batch, curve, t.ravel())[:, 1]
    slope = derivative(batch, curve, t.ravel())[:, 0]
    return float((y * slope * (half[:, None] * GAUSS[1]).ravel()).sum())
