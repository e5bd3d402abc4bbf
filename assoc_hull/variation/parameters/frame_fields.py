"""The fields that change the character of frames, from U to V, at areas that stay.

Half-breadths are changed below by one ratio and above, up to the draught, by another of the other
sign, section by section so that what one adds the other takes. Where the side is as far out as the
ship is broad nothing moves.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.bounded_functions import BlendChain, Contour
from assoc_hull.variation.fields.field import AffinePiece, StackedField, Tube, level_boundaries
from assoc_hull.variation.parameters.field_layout import Layout, Share
from assoc_hull.variation.parameters.hull_and_end_measures import FRAMES
from assoc_hull.variation.parameters.measurement import SectionFrames
from assoc_hull.variation.parameters.parent import Parent, cannot_vary

__all__ = ["aft_frame_height_field", "fore_frame_height_field"]

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
