"""The fields of the bulb's section at FP: its area, and the height of its centre.

Half-breadths are changed from the tip down by one ratio, or below and above by two of other signs,
so that what one adds the other takes. Both fade aft along the bow, upward above the draught, and
outward before the side of the ship. Both measures are linear in half-breadths: fields are sized and
solved for by the measures themselves.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.field import AffinePiece, StackedField, Tube, level_boundaries
from assoc_hull.variation.parameters.field_layout import Layout, Share
from assoc_hull.variation.parameters.measurement import SectionFrames
from assoc_hull.variation.parameters.parameter_fields import bow_fade, bulb_walls
from assoc_hull.variation.parameters.parent import Parent, cannot_vary

__all__ = ["bulb_area_field", "bulb_section_height_field"]

_LOW, _HIGH = 0.25, 0.75
"""Parts of the height of the bulb: as far as the one ratio is full, and from where the other is."""

_TUBE = 3.0
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
    return _share(name, frame, frame.dz, change, unit)


def bulb_section_height_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Take area from below and give it above, or the other way round."""
    name = "bulb_section_height"
    frame, fade = _frame(parent, name), bow_fade(parent, layout)
    z, tube = frame.xyz[:, 2], _tube(frame, layout)
    foot, height = float(z.min()), float(z.max() - z.min())
    low, high = foot + _LOW * height, foot + _HIGH * height
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
    return _share(name, frame, (z - now) * frame.dz, (asked - now) * area, unit)


def _frame(parent: Parent, name: str) -> SectionFrames:
    """Give the section at FP, or refuse with the reason why there is none."""
    parent.at("bulb tip", name)
    frame = parent.bulb()
    if not len(frame.x):
        why = parent.absent.get(name, "the parent has no section at FP")
        raise cannot_vary(name, why)
    return frame


def _tube(frame: SectionFrames, layout: Layout) -> Tube:
    return Tube(float(frame.xyz[:, 1].max()), _TUBE, layout.curve)


def _share(
    name: str, frame: SectionFrames, weight: FloatArray, change: float, unit: StackedField
) -> Share:
    """Size a field by what its sum over the section changes; in the solution it counts as a mean.

    The sum is that of movements times weights (n,), so that the mean is in m as those of others.
    """
    whole = float(np.abs(weight).sum())
    places = np.array(frame.xyz)
    answer = float((weight * unit.displacement(places)).sum())
    return Share(name, "y", change / whole, places, weight / whole, (unit.scaled(change / answer),))
