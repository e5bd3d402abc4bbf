"""A map that is a similarity about a bossing, faded to base and waterline, and forward."""

from __future__ import annotations

from assoc_hull.variation.fields.bounded_functions import QUINTIC, Blend, BlendChain
from assoc_hull.variation.fields.field import AffinePiece, StackedField, Tube, level_boundaries
from assoc_hull.variation.fields.layers import FieldLayer
from assoc_hull.variation.fields.space_map import VariationMap

__all__ = ["boss_map"]


def boss_map(
    x: float,
    shaft: tuple[float, float],
    radius: tuple[float, float],
    blend: Blend = QUINTIC,
) -> VariationMap:
    """Give the map that carries height and radius from the first to the second value.

    It is the similarity from `x` aft; the radius fades over 24 m, the height over 60 m.
    """
    (height, high), (small, large), still = shaft, radius, BlendChain.constant(0.0)
    grow = BlendChain.through([x, x + 24.0], [large / small - 1.0, 0.0], blend)
    rise = BlendChain.through([x, x + 60.0], [high - height, 0.0], blend)
    levels = level_boundaries(
        ["base", "shaft-r", "shaft+r", "T"], [0.0, height - small, height + small, 18.0]
    )
    none = AffinePiece(still, 0.0, still)
    up, out = AffinePiece(grow, height, rise), AffinePiece(grow, 0.0, still)
    tube = Tube(small, 6.0, blend)
    z = StackedField("shaft_height", "z", levels, (none, up, up, none), blend)
    y = StackedField("bossing_radius", "y", levels, (none, out, out, none), blend, tube)
    return VariationMap((FieldLayer("boss", (z, y)),))
