"""Layouts of the named parameters of the bow: bulb and stem."""

from __future__ import annotations

import math

import numpy as np

from assoc_hull.variation.fields.field import Field, Piece, stack
from assoc_hull.variation.fields.fields_layer import Rake
from assoc_hull.variation.fields.piecewise_linear import Chain
from assoc_hull.variation.parameters.layout import Layout
from assoc_hull.variation.parameters.parent_places import Parent
from assoc_hull.variation.parameters.share import Share

__all__ = ["bulb_half_breadth", "bulb_height", "bulb_length", "stem_rake_deg"]

_BULB = {"base": (0.3, 0.0), "bulb": (0.95, 0.3)}
"""Windows of the bulb's hat, as parts of the gaps: one long bend from the base up."""


def _fade(parent: Parent, layout: Layout) -> Chain:
    """Give 0 up to where the bow begins, 1 from the fore perpendicular on."""
    nodes = [layout.bow_from * parent.length, parent.length]
    return Chain.through(nodes, [0.0, 1.0], layout.curve, "bow")


def bulb_height(parent: Parent, asked: float, layout: Layout) -> Share:
    """Raise the bulb's foremost point: a hat from the base to above the design waterline."""
    name = "bulb_height"
    tip = parent.at("bulb tip", name)
    z, top = float(tip[2]), layout.bulb_top * parent.draught
    anchors = [("base", 0.0, 0.0), ("bulb", z, asked - z), ("above T", top, 0.0)]
    field = layout.over(name, anchors, _fade(parent, layout), windows=_BULB)
    return Share.at(name, "z", asked - z, tip, field)


def bulb_half_breadth(parent: Parent, asked: float, layout: Layout) -> Share:
    """Widen the bulb by a ratio, full from its foremost point down."""
    name = "bulb_half_breadth"
    side, tip = parent.at("bulb side", name), parent.at("bulb tip", name)
    y, fade = float(side[1]), _fade(parent, layout)
    walls = stack(["bulb", "above T"], [float(tip[2]), layout.bulb_side * parent.draught])
    # the widest place may lie above the tip, where the ratio has begun to fade
    unit = Field(
        name, "y", walls, (Piece.along(fade, 1.0, 0.0), Piece.along(fade, 0.0, 0.0)), layout.curve
    )
    grip = float(unit.displacement(side[None, :])[0])
    return Share.at(name, "y", asked - y, side, unit.scaled((asked - y) / grip))


def bulb_length(parent: Parent, asked: float, layout: Layout) -> Share:
    """Shift the bulb forward, full from its foremost point down; the stem moves by what fades."""
    name = "bulb_length"
    tip = parent.at("bulb tip", name)
    change = asked - (float(tip[0]) - parent.length)
    fade = _fade(parent, layout)
    walls = stack(["bulb", "above T"], [float(tip[2]), layout.bulb_stem * parent.draught])
    pieces = Piece.along(fade, 0.0, change), Piece.along(fade, 0.0, 0.0)
    return Share.at(name, "x", change, tip, Field(name, "x", walls, pieces, layout.curve))


def stem_rake_deg(parent: Parent, asked: float, layout: Layout) -> Share:
    """Rake the stem above the design waterline; the fore perpendicular and the bulb stay."""
    name = "stem_rake_deg"
    foot, top = parent.at("stem", name), parent.at("stem top", name)
    height = float(top[2] - foot[2])
    change = math.tan(math.radians(asked)) * height - float(top[0] - foot[0])
    width = 0.5 * height
    # the ramp has grown to height - width / 2 at the top
    field = Rake(
        name, _fade(parent, layout), change / (height - 0.5 * width), float(foot[2]), width,
        layout.curve,
    )  # fmt: skip
    return Share(name, "x", change, np.array([top, foot]), np.array([1.0, -1.0]), (field,))
