"""A map that is a similarity about a bossing, faded to base and waterline, and forward."""

from __future__ import annotations

from assoc_hull.variation.fields.blend import QUINTIC, Blend
from assoc_hull.variation.fields.field import Field, Piece, Tube, stack
from assoc_hull.variation.fields.fields_layer import FieldLayer
from assoc_hull.variation.fields.piecewise_linear import Chain
from assoc_hull.variation.fields.space_map import VMap

__all__ = ["boss_map"]


def boss_map(
    x: float,
    shaft: tuple[float, float],
    radius: tuple[float, float],
    blend: Blend = QUINTIC,
) -> VMap:
    """Give the map that carries height and radius from the first to the second value.

    It is the similarity from `x` aft; the radius fades over 24 m, the height over 60 m.
    """
    (height, high), (small, large), still = shaft, radius, Chain.constant(0.0)
    grow = Chain.through([x, x + 24.0], [large / small - 1.0, 0.0], blend)
    rise = Chain.through([x, x + 60.0], [high - height, 0.0], blend)
    levels = stack(["base", "shaft-r", "shaft+r", "T"], [0.0, height - small, height + small, 18.0])
    none = Piece(still, 0.0, still)
    up, out = Piece(grow, height, rise), Piece(grow, 0.0, still)
    tube = Tube(small, 6.0, blend)
    z = Field("shaft_height", "z", levels, (none, up, up, none), blend)
    y = Field("bossing_radius", "y", levels, (none, out, out, none), blend, tube)
    return VMap((FieldLayer("boss", (z, y)),))
