"""Fields of the bulb's section at FP, of the character of frames, of the design waterline.

Half-breadths are changed from the tip down by one ratio, or below and above by two of other signs,
so that what one adds the other takes. Both fade aft along the bow, upward above the draught, and
outward before the side of the ship. Both measures are linear in half-breadths: fields are sized and
solved for by the measures themselves.

The fields that change the character of frames, from U to V, at areas that stay.

Half-breadths are changed below by one ratio and above, up to the draught, by another of the other
sign, section by section so that what one adds the other takes. Where the side is as far out as the
ship is broad nothing moves.

The fields of the design waterline: entrance, run, fullness, by half-breadths about the draught.

They fade out downward and upward, and where the side is as far out as the ship is broad.
"""

from __future__ import annotations

import math

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.bounded_functions import BlendChain, Contour
from assoc_hull.variation.fields.field import (
    AffinePiece,
    StackedField,
    Tube,
    level_boundaries,
)
from assoc_hull.variation.parameters.field_layout import Layout, Share
from assoc_hull.variation.parameters.hull_and_end_measures import FRAMES
from assoc_hull.variation.parameters.measurement import SectionFrames
from assoc_hull.variation.parameters.parameter_fields import bow_fade, bulb_walls
from assoc_hull.variation.parameters.parent import Parent, cannot_vary

__all__ = [
    "aft_frame_height_field",
    "bulb_area_field",
    "bulb_section_height_field",
    "entrance_field",
    "fore_frame_height_field",
    "run_field",
    "waterline_fullness_field",
]

_BULB_LOW, _BULB_HIGH = 0.25, 0.75
"""Parts of the height of the bulb: as far as the one ratio is full, and from where the other is."""

_BULB_TUBE = 3.0
"""Half-breadths are changed in full up to that of the bulb, and not at all from so many of it on:
frames behind the bulb that are broader than it keep their sides."""


def bulb_area_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Widen the bulb by a ratio, full from its foremost point down."""
    name = "bulb_area"
    frame, tip = _frame(parent, name), parent.at("bulb tip", name)
    fade = bow_fade(parent, layout)
    walls = bulb_walls(parent, layout, float(tip[2]), layout.bulb_side)
    pieces = AffinePiece.along(fade, 1.0, 0.0), AffinePiece.along(fade, 0.0, 0.0)
    unit = StackedField(name, "y", walls, pieces, layout.curve, _tube(frame, layout))
    change = 0.5 * asked - float(frame.areas[0])
    return _bulb_share(name, frame, frame.dz, change, unit)


def bulb_section_height_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Take area from below and give it above, or the other way round."""
    name = "bulb_section_height"
    frame, fade = _frame(parent, name), bow_fade(parent, layout)
    z, tube = frame.xyz[:, 2], _tube(frame, layout)
    foot, height = float(z.min()), float(z.max() - z.min())
    low, high = foot + _BULB_LOW * height, foot + _BULB_HIGH * height
    up = layout.curve.value(np.clip((z - low) / (high - low), 0.0, 1.0))
    out = np.array(tube.at(frame.xyz[:, 1]))
    under, over = (float(frame.sums(part * out)[0]) for part in (1.0 - up, up))
    below, above = (AffinePiece.along(fade, part / (under + over), 0.0) for part in (-over, under))
    none = AffinePiece.along(fade, 0.0, 0.0)
    walls = level_boundaries(
        ["bulb low", "bulb high", "bulb top", "above T"],
        [low, high, foot + height, max(layout.bulb_side * parent.draught, foot + 1.05 * height)],
    )
    unit = StackedField(name, "y", walls, (below, above, above, none), layout.curve, tube)
    area, now = float(frame.areas[0]), float(frame.heights[0])
    return _bulb_share(name, frame, (z - now) * frame.dz, (asked - now) * area, unit)


def _frame(parent: Parent, name: str) -> SectionFrames:
    """Give the section at FP, or refuse with the reason why there is none."""
    parent.at("bulb tip", name)
    frame = parent.bulb()
    if not len(frame.x):
        why = parent.absent.get(name, "the parent has no section at FP")
        raise cannot_vary(name, why)
    return frame


def _tube(frame: SectionFrames, layout: Layout) -> Tube:
    return Tube(float(frame.xyz[:, 1].max()), _BULB_TUBE, layout.curve)


def _bulb_share(
    name: str, frame: SectionFrames, weight: FloatArray, change: float, unit: StackedField
) -> Share:
    """Size a field by what its sum over the section changes; in the solution it counts as a mean.

    The sum is that of movements times weights (n,), so that the mean is in m as those of others.
    """
    whole = float(np.abs(weight).sum())
    places = np.array(frame.xyz)
    answer = float((weight * unit.displacement(places)).sum())
    return Share(name, "y", change / whole, places, weight / whole, (unit.scaled(change / answer),))


_LOW, _HIGH, _TOP = 0.25, 0.75, 1.5
"""Parts of the draught: as far as the one ratio is full, from where the other is, and where that
has faded out."""

_TUBE = 2.0
"""Half-breadths are changed in full up to this part of that of the ship, and less beyond."""

_WEAK = 1e-3
"""A field of strength 1 that moves the centre by less than this part of its height moves nothing:
it would have to fold the ship before it is seen."""

_SPREAD = 0.02
"""So far (in parts of Lpp) the section that is measured lies from both ends of the field."""


def fore_frame_height_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Shift area of the frames of the fore body in height, fading to its parallel body and FP."""
    name = "fore_frame_height"
    begin = parent.at("body end" if parent.has("body end") else "largest fore", name)
    return _frame_height(parent, name, asked, (float(begin[0]), parent.length), layout)


def aft_frame_height_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Shift area of the frames of the after body, fading to its parallel body and the bossing."""
    name = "aft_frame_height"
    end = parent.at("body start" if parent.has("body start") else "largest aft", name)
    hubs = [float(parent.places[each][0]) for each in ("boss", "boss fore") if parent.has(each)]
    return _frame_height(parent, name, asked, (max([0.0, *hubs]), float(end[0])), layout)


def _frame_height(
    parent: Parent, name: str, asked: float, ends: tuple[float, float], layout: Layout
) -> Share:
    """Lay out the field between two ends, for a height of the centre of area, m."""
    middle, frames = FRAMES[name] * parent.length, parent.frames()
    room = _SPREAD * parent.length
    inside = np.flatnonzero((frames.x > ends[0]) & (frames.x < ends[1]))
    if not ends[0] + room < middle < ends[1] - room:
        raise cannot_vary(
            name, f"its field lies between the parallel body and the end of the ship, x = "
            f"{ends[0]:.6g} to {ends[1]:.6g} m, and the section at x = {middle:.6g} m that it is "
            f"measured at does not stand {room:.3g} m inside",
        )  # fmt: skip
    if len(inside) < 2:
        raise cannot_vary(
            name, f"{len(inside)} sections stand between x = {ends[0]:.6g} and {ends[1]:.6g} m, "
            "and it takes two to tell how area shifts", "add sections there",
        )  # fmt: skip
    course = BlendChain.through([ends[0], middle, ends[1]], [0.0, 1.0, 0.0], layout.curve, name)
    tube = Tube(0.5 * parent.breadth / _TUBE, _TUBE, layout.curve)
    out = np.array(tube.at(frames.xyz[:, 1]))
    up = _upward(parent, layout, frames.xyz[:, 2])
    low, high = frames.sums((1.0 - up) * out), frames.sums(up * out)
    # By these parts both add up to nothing, and neither is large where there is little to move.
    below, above = (
        Contour(
            np.concatenate([[ends[0]], frames.x[inside], [ends[1]]]),
            np.concatenate([[0.0], course.at(frames.x[inside]) * part[inside], [0.0]]),
        )
        for part in (-high / (low + high), low / (low + high))
    )
    unit = _stack(parent, name, (below, above), tube, layout)
    return _share(parent, name, asked, frames, middle, unit)


def _upward(parent: Parent, layout: Layout, z: FloatArray) -> FloatArray:
    """Give how much of the upper ratio acts at heights up to the draught."""
    low, high = _LOW * parent.draught, _HIGH * parent.draught
    return layout.curve.value(np.clip((z - low) / (high - low), 0.0, 1.0))


def _stack(
    parent: Parent, name: str, courses: tuple[Contour, Contour], tube: Tube, layout: Layout
) -> StackedField:
    """Give the field of strength 1, which takes area up."""
    none = BlendChain.constant(0.0)
    below, above = (AffinePiece(each, 0.0, none) for each in courses)
    pieces = [below, above, above]
    t = parent.draught
    names, heights = ["low", "high", "T"], [_LOW * t, _HIGH * t, t]
    if parent.top > t:
        names.append("above T")
        heights.append(min(_TOP * t, parent.top))
        pieces.append(AffinePiece(none, 0.0, none))
    walls = level_boundaries(names, heights)
    return StackedField(name, "y", walls, tuple(pieces), layout.curve, tube)


def _share(
    parent: Parent, name: str, asked: float, frames: SectionFrames, middle: float,
    unit: StackedField,
) -> Share:  # fmt: skip
    """Size the field by how the centre of area answers; it is anchored where it moves most."""
    weights = frames.beside(middle)
    moved = unit.displacement(np.array(frames.xyz))
    height, area = frames.heights, frames.areas
    lever = frames.xyz[:, 2] - np.repeat(height, np.diff(frames.start))
    answer = float((weights * frames.sums(lever * moved) / area).sum())
    if not abs(answer) > _WEAK * float((weights * height).sum()):
        raise cannot_vary(
            name, f"the section at x = {middle:.6g} m is as broad as the ship at all heights, and "
            "where the side is that far out nothing moves",
        )  # fmt: skip
    strength = (asked - float((weights * height).sum())) / answer
    nearest = int(weights.argmax())
    mine = slice(int(frames.start[nearest]), int(frames.start[nearest + 1]))
    most = int(np.abs(moved[mine]).argmax())
    place = frames.xyz[mine][most]
    return Share.at(name, "y", strength * float(moved[mine][most]), place, unit.scaled(strength))


_WATERLINE_LOW, _WATERLINE_TOP = 0.1, 1.5
"""Parts of the draught between which they act, full at the draught itself."""


_WEAK_CHORD = 0.01
"""A field of strength 1 that turns a chord by less than this part of its half-breadth turns
nothing: it would have to fold the ship before it is seen."""

_FADE = 0.25
"""Part of Lpp over which entrance and run fade out toward midship."""

_AFT, _FORE = 0.12, 0.9
"""Parts of Lpp at which the fullness is changed most."""


def entrance_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Widen the waterline at the stem by a ratio that fades out toward midship."""
    name = "entrance_deg"
    place, end = parent.at("entrance", name), parent.at("waterline fore", name)
    x = float(place[0])
    course = BlendChain.through([x - _FADE * parent.length, x], [0.0, 1.0], layout.curve, name)
    return _angle(parent, name, asked, (place, end), course, layout)


def run_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Widen the waterline at the stern, but for its end."""
    name = "run_deg"
    place, end = parent.at("run", name), parent.at("waterline aft", name)
    x = float(place[0])
    nodes = [float(end[0]), x, x + _FADE * parent.length]
    course = BlendChain.through(nodes, [0.0, 1.0, 0.0], layout.curve, name)
    return _angle(parent, name, asked, (place, end), course, layout)


def _angle(
    parent: Parent, name: str, asked: float, chord: tuple[FloatArray, FloatArray],
    course: BlendChain, layout: Layout,
) -> Share:  # fmt: skip
    """Size a field so that a chord has an angle, degrees."""
    place, end = chord
    change = math.tan(math.radians(asked)) * abs(float(place[0] - end[0]))
    change -= float(place[1] - end[1])
    unit = _about(parent, name, course, layout)
    grip = unit.displacement(np.array(chord))
    apart = float(grip[0] - grip[1])
    if not abs(apart) > _WEAK_CHORD * float(place[1]):
        raise cannot_vary(
            name, f"the design waterline is {place[1]:.4g} m out at x = {place[0]:.6g} m and "
            f"{end[1]:.4g} m at its end, x = {end[0]:.6g} m: that is as broad as the ship, and "
            "where the side is that far out nothing moves",
        )  # fmt: skip
    strength = change / apart
    return Share(
        name, "y", change, np.array(chord), np.array([1.0, -1.0]), (unit.scaled(strength),)
    )


def waterline_fullness_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Widen the waterline between its ends and the parallel body."""
    name = "waterline_fullness"
    body = parent.has("body start")
    start, end = (
        float(parent.at(place, name)[0])
        for place in (("body start", "body end") if body else ("largest aft", "largest fore"))
    )
    line = parent.waterline()
    nodes = [float(line[0, 0]), _AFT * parent.length, start]
    values = [0.0, 1.0, 0.0]
    if end > start:
        nodes.append(end)
        values.append(0.0)
    nodes += [_FORE * parent.length, float(line[-1, 0])]
    if (np.diff(nodes) <= 0.0).any():
        raise cannot_vary(
            name, f"the design waterline, x = {nodes[0]:.6g} to {nodes[-1]:.6g} m, is changed most "
            f"at x = {nodes[1]:.6g} and {nodes[-2]:.6g} m and nowhere in between from x = "
            f"{start:.6g} to {end:.6g} m, where the ship is fullest: on this ship the one leaves "
            "no room for the other",
        )  # fmt: skip
    unit = _about(
        parent, name, BlendChain.through(nodes, [*values, 1.0, 0.0], layout.curve, name), layout
    )
    moved = unit.displacement(line)
    half = 0.5 * parent.breadth * parent.length
    now, more = (float(np.trapezoid(each, line[:, 0])) / half for each in (line[:, 1], moved))
    if not more > _WEAK_CHORD * now:
        raise cannot_vary(
            name, "the design waterline is as broad as the ship all along, and where the side is "
            "that far out nothing moves",
        )  # fmt: skip
    strength = (asked - now) / more
    most = int(moved.argmax())
    return Share.at(name, "y", strength * float(moved[most]), line[most], unit.scaled(strength))


def _about(parent: Parent, name: str, course: BlendChain, layout: Layout) -> StackedField:
    """Give the field of strength 1, a ratio of half-breadths that is full at the draught."""
    t = parent.draught
    none, full = AffinePiece.along(course, 0.0, 0.0), AffinePiece.along(course, 1.0, 0.0)
    names, heights, pieces = ["below T", "T"], [_WATERLINE_LOW * t, t], [none, full]
    if parent.top > t:
        names.append("above T")
        heights.append(min(_WATERLINE_TOP * t, parent.top))
        pieces.append(none)
    tube = Tube(0.5 * parent.breadth / _TUBE, _TUBE, layout.curve)
    walls = level_boundaries(names, heights)
    return StackedField(name, "y", walls, tuple(pieces), layout.curve, tube)
