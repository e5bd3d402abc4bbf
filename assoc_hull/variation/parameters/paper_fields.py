"""The fields of shaft and bossing as Choi & Lee (1999) lay them out: ratios of coordinates.

No tube, no pivot at the bossing's centre: a small radius that is to grow has a large ratio, and all
that lies beside the bossing grows with it, as the paper says of itself.
"""

from __future__ import annotations

from assoc_hull.errors import BadInputError
from assoc_hull.variation.fields.bounded_functions import BlendChain
from assoc_hull.variation.fields.field import AffinePiece, StackedField, level_boundaries
from assoc_hull.variation.parameters.field_layout import Layout
from assoc_hull.variation.parameters.paper_regions import PaperRegions, regions_of
from assoc_hull.variation.parameters.parent import Parent

__all__ = ["bossing_ratios", "shaft_ratios"]

_ALL = ("Hbase", "Hbilge", "Htransom", "Hdraft", "Hmax")
"""Heights at which ratios of shaft and bossing are 1."""


def shaft_ratios(parent: Parent, change: float, layout: Layout, fade: BlendChain) -> StackedField:
    """Give the field that raises the shaft: full over the bossing's end, nothing at base and T.

    Parameters
    ----------
    parent : Parent
    change : float, m
    layout : Layout
        With regions their heights are at rest, and their lengths end the field.
    fade : BlendChain
        How it fades along the ship without regions.
    """
    regions = regions_of(parent, layout)
    boss = parent.at("boss", "shaft_height")
    h, r = float(boss[2]), 0.0
    if parent.has("boss top"):
        r = float(parent.places["boss top"][2]) - h
    if regions is not None:
        h = _centre(regions, h, r)
    anchors = [("shaft", h, change)]
    if r:
        anchors = [("shaft-r", h - r, change), *anchors, ("shaft+r", h + r, change)]
    if regions is None:
        anchors = [("base", 0.0, 0.0), *anchors, ("T", parent.draught, 0.0)]
        return layout.over("shaft_height", anchors, fade)
    return layout.over(
        "shaft_height", regions.at_rest(anchors, *_ALL), regions.aft(float(fade.x[0]))
    )


def bossing_ratios(
    parent: Parent, asked: float, layout: Layout, fade: BlendChain
) -> tuple[StackedField, StackedField]:
    """Give the fields that widen the bossing and make it higher; the rest as `shaft_ratios`."""
    name = "bossing_radius"
    side, boss, top = (parent.at(key, name) for key in ("boss side", "boss", "boss top"))
    h, y = float(boss[2]), float(side[1])
    r = float(top[2]) - h
    anchors = [
        ("shaft-r", h - r, r - asked), ("shaft", h, 0.0), ("shaft+r", h + r, asked - r),
    ]  # fmt: skip
    low, middle, high = h - 3.0 * r, h, h + 3.0 * r
    regions = regions_of(parent, layout)
    if regions is None:
        anchors = [("base", 0.0, 0.0), *anchors, ("T", parent.draught, 0.0)]
    else:
        fade, anchors = regions.aft(float(fade.x[0])), regions.at_rest(anchors, *_ALL)
        middle = _centre(regions, h, r)
        low, high = regions.below(h - r), regions.above(h + r)
    walls = level_boundaries(["below", "shaft", "above"], [low, middle, high])
    none, broad = AffinePiece.along(fade, 0.0, 0.0), AffinePiece.along(fade, asked / y - 1.0, 0.0)
    out = StackedField(name, "y", walls, (none, broad, none), layout.curve)
    return out, layout.over(name, anchors, fade)


def _centre(regions: PaperRegions, h: float, r: float) -> float:
    """Give where ratios of the shaft are full, which is within its bossing, m."""
    found = regions.heights["Hshaft"]
    if r and abs(found - h) > r:
        raise BadInputError(
            f"Hshaft of {found:.6g} m lies beyond the bossing, {h - r:.6g} to {h + r:.6g} m",
            "in vary", "give a height within it, or leave Hshaft out",
        )  # fmt: skip
    return found
