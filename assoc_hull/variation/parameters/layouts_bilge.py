"""Layouts of the named parameters of bilge and bottom: layers of their own."""

from __future__ import annotations

import math

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.corner import CornerLayer
from assoc_hull.variation.fields.piecewise_linear import Chain
from assoc_hull.variation.fields.shear import DeadriseLayer
from assoc_hull.variation.parameters.layout import Layout
from assoc_hull.variation.parameters.parent_places import Parent

__all__ = ["bilge_radius", "deadrise_deg", "flat_of_bottom"]

_INNER = 0.95
"""The centre plane stays: a corner fades out within this part of the half-breadth."""

_ALIKE = 1e-6
"""m: tangents that differ by less are those of a circle."""


def _range(parent: Parent, layout: Layout, name: str) -> Chain:
    """Give 1 along the parallel body, fading beyond."""
    start = float(parent.at("body start", name)[0])
    end = float(parent.at("body end", name)[0])
    reach = layout.bilge_length * parent.length
    return Chain.through(
        [start - reach, start, end, end + reach], [0.0, 1.0, 1.0, 0.0], layout.curve, name
    )


def _corner(
    parent: Parent, layout: Layout, name: str, size: float, ratios: tuple[float, float]
) -> CornerLayer:
    """Stretch about the corner, full as far as `size` (m) from it."""
    corner, low = parent.at("corner", name), parent.at("bilge low", name)
    y, z = float(corner[1]), float(corner[2])
    rise = math.atan2(z - float(low[2]), y - float(low[1]))
    largest = size * max(*ratios, 1.0)
    reach = min(layout.bilge * size, _INNER * y, _INNER * (parent.depth - z))
    if not reach > largest:
        raise BadInputError(
            f"bilge: {name} of {largest:.4g} m from the corner leaves no bottom or side to fade in "
            f"({reach:.4g} m)", "in vary", "ask for less",
        )  # fmt: skip
    fade = Chain.through([size, reach], [1.0, 0.0], layout.curve, name)
    return CornerLayer(name, _range(parent, layout, name), y, z, rise, *ratios, fade)


def bilge_radius(parent: Parent, asked: float, layout: Layout) -> CornerLayer:
    """Make the bilge's circle larger or smaller, touching side and bottom as before."""
    name = "bilge_radius"
    corner, low, high = (parent.at(each, name) for each in ("corner", "bilge low", "bilge high"))
    along = math.dist(corner.tolist(), low.tolist())
    up = math.dist(corner.tolist(), high.tolist())
    rise = math.atan2(float(corner[2] - low[2]), float(corner[1] - low[1]))
    # both tangents of a fillet are as long
    tangent = asked * math.tan(0.5 * (0.5 * math.pi - rise))
    return _corner(parent, layout, name, max(along, up), (tangent / along, tangent / up))


def flat_of_bottom(parent: Parent, asked: float, layout: Layout) -> CornerLayer:
    """Move the edge of the flat bottom in or out.

    Heights stay, unless the bilge is as high as it is wide: then it is a fillet, and stays one, as
    high as it comes to be wide.
    """
    name = "flat_of_bottom"
    edge, corner = parent.at("flat edge", name), parent.at("corner", name)
    y, half = float(edge[1]), float(corner[1])
    if not 0.0 < asked < half:
        raise BadInputError(
            f"flat_of_bottom of {asked:.6g} m", "in vary",
            f"ask for a half-breadth between 0 and {half:.6g} m",
        )  # fmt: skip
    wide, ratio = half - y, (half - asked) / (half - y)
    low, high = parent.places.get("bilge low"), parent.places.get("bilge high")
    round_ = low is not None and high is not None and _fillet(edge, corner, low, high)
    return _corner(parent, layout, name, wide, (ratio, ratio if round_ else 1.0))


def _fillet(edge: FloatArray, corner: FloatArray, low: FloatArray, high: FloatArray) -> bool:
    """Tell whether a bilge begins at the edge of the flat, as far from the corner as it ends."""
    away = math.dist(corner.tolist(), low.tolist()), math.dist(corner.tolist(), high.tolist())
    return abs(float(edge[1] - low[1])) <= _ALIKE and abs(away[0] - away[1]) <= _ALIKE


def deadrise_deg(parent: Parent, asked: float, layout: Layout) -> DeadriseLayer:
    """Turn the bottom about the side of the keel; what lies above the bilge stays."""
    name = "deadrise_deg"
    keel, inner, outer = (parent.at(each, name) for each in ("keel side", "bottom", "bottom edge"))
    q = math.tan(math.radians(asked)) - float((outer[2] - inner[2]) / (outer[1] - inner[1]))
    low = float(parent.places["bilge high"][2]) if parent.has("bilge high") else 0.0
    top = layout.deadrise_top * parent.draught
    fade = Chain.through([low, top], [1.0, 0.0], layout.curve, name)
    return DeadriseLayer(
        name, _range(parent, layout, name), q, float(keel[1]), 0.0, fade, layout.curve
    )
