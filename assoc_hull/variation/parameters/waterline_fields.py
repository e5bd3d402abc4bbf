"""The fields of the design waterline: entrance, run, fullness, by half-breadths about the draught.

They fade out downward and upward, and where the side is as far out as the ship is broad.
"""

from __future__ import annotations

import math

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.bounded_functions import BlendChain
from assoc_hull.variation.fields.field import AffinePiece, StackedField, Tube, level_boundaries
from assoc_hull.variation.parameters.field_layout import Layout, Share
from assoc_hull.variation.parameters.parent import Parent, cannot_vary

__all__ = ["entrance_field", "run_field", "waterline_fullness_field"]

_LOW, _TOP = 0.1, 1.5
"""Parts of the draught between which they act, full at the draught itself."""

_TUBE = 2.0
"""Half-breadths are changed in full up to this part of that of the ship, and less beyond."""

_WEAK = 0.01
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
    if not abs(apart) > _WEAK * float(place[1]):
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
    if not more > _WEAK * now:
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
    names, heights, pieces = ["below T", "T"], [_LOW * t, t], [none, full]
    if parent.top > t:
        names.append("above T")
        heights.append(min(_TOP * t, parent.top))
        pieces.append(none)
    tube = Tube(0.5 * parent.breadth / _TUBE, _TUBE, layout.curve)
    walls = level_boundaries(names, heights)
    return StackedField(name, "y", walls, tuple(pieces), layout.curve, tube)
