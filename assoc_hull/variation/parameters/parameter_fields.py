"""The fields of the named parameters, one function each, laid out on a parent.

The whole hull is scaled by its principal dimensions first, in a layer of its own. Deck, parallel
body, shifts of sections, bulb and stem, shaft, bossing and transom are shares of one layer of
fields after that; bilge and bottom are layers of their own. Each function takes the parent, the
asked value (m or degrees) and the layout; `parameters.catalogue` says which name it belongs to.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.anchor_fields import level_window
from assoc_hull.variation.fields.bounded_functions import BlendChain
from assoc_hull.variation.fields.field import (
    AffinePiece,
    Boundary,
    StackedField,
    Tube,
    level_boundaries,
)
from assoc_hull.variation.fields.layers import CornerLayer, DeadriseLayer, FieldLayer, Rake
from assoc_hull.variation.fields.shift_shapes import Bump
from assoc_hull.variation.parameters.field_layout import Layout, Share
from assoc_hull.variation.parameters.paper_regions import bossing_ratios, regions_of, shaft_ratios
from assoc_hull.variation.parameters.parent import Parent, cannot_vary

__all__ = [
    "aft_shift_field",
    "bilge_radius_layer",
    "body_length_field_beside",
    "bossing_radius_field",
    "bow_fade",
    "bulb_half_breadth_field",
    "bulb_height_field",
    "bulb_length_field",
    "bulb_walls",
    "deadrise_layer",
    "deck_height_field",
    "depth_field",
    "flat_of_bottom_layer",
    "fore_shift_field",
    "main_layer",
    "parallel_body_end_field",
    "parallel_body_length_field",
    "parallel_body_start_field",
    "shaft_height_field",
    "sheer_aft_field",
    "sheer_fore_field",
    "shift_terminals",
    "stem_rake_field",
    "transom_half_breadth_field",
    "transom_height_field",
]

_ALL = BlendChain.constant(1.0)


def main_layer(parent: Parent, asked: Mapping[str, float], layout: Layout) -> FieldLayer | None:
    """Scale lengths, breadths and the heights below the draught; None if none is asked for.

    Where length, breadth, draught and depth are all asked for in one ratio, heights above the
    draught are scaled by it as well: the hull becomes a similar one.
    """
    fields = list[StackedField]()
    for name, axis, now in (("length", "x", parent.length), ("breadth", "y", parent.breadth)):
        if name in asked and asked[name] != now:
            piece = AffinePiece.along(_ALL, asked[name] / now - 1.0, 0.0)
            fields.append(
                StackedField(
                    name, "x" if axis == "x" else "y", level_boundaries(["base"], [0.0]), (piece,)
                )
            )
    if "draught" in asked and asked["draught"] != parent.draught:
        fields.append(_draught(parent, asked["draught"], layout, _even(parent, asked)))
    return FieldLayer("principal dimensions", tuple(fields)) if fields else None


def _even(parent: Parent, asked: Mapping[str, float]) -> bool:
    """Tell whether the depth is asked for in the ratio of the draught: heights scale alike."""
    ratio = asked["draught"] / parent.draught
    return "depth" in asked and abs(asked["depth"] / parent.depth - ratio) <= 1e-15


def _draught(parent: Parent, asked: float, layout: Layout, even: bool) -> StackedField:
    """Scale heights up to the draught; shift what lies well above it, depth included."""
    old = parent.draught
    scale = AffinePiece.along(_ALL, asked / old - 1.0, 0.0)
    if even:
        return StackedField("draught", "z", level_boundaries(["base"], [0.0]), (scale,))
    top = min(layout.draught_top * old, parent.top)
    if not top > old:
        return StackedField("draught", "z", level_boundaries(["T"], [old]), (scale,))
    shift = AffinePiece.along(_ALL, 0.0, asked - old)
    return StackedField(
        "draught", "z", level_boundaries(["T", "top"], [old, top]), (scale, shift), layout.curve
    )


# --------------------------------------------------------------------------------------
# The whole body: decks, parallel body, shifts of sections.

_NOTHING = AffinePiece.along(_ALL, 0.0, 0.0)


def depth_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Raise the deck by a ratio of heights, from the design waterline up."""
    name = "depth"
    deck = parent.at("deck", name)
    z = float(deck[2])
    walls = level_boundaries(["T", "deck"], [parent.draught, z])
    pieces = _NOTHING, AffinePiece.along(_ALL, asked / z - 1.0, 0.0)
    return Share.at(
        name, "z", asked - z, deck, StackedField(name, "z", walls, pieces, layout.curve)
    )


def deck_height_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Raise the deck by a ratio of heights, or by a fade from amidships to a perpendicular."""
    name = "deck_height"
    deck = parent.at({"fore": "deck fore", "aft": "deck aft", "midship": "deck"}[layout.deck], name)
    middle, z = 0.5 * parent.length, float(deck[2])
    course = {
        "fore": BlendChain.through([middle, parent.length], [0.0, 1.0], layout.curve, name),
        "aft": BlendChain.through([0.0, middle], [1.0, 0.0], layout.curve, name),
        "midship": _ALL,
    }[layout.deck]
    walls = level_boundaries(["T", "deck"], [parent.draught, z])
    pieces = AffinePiece.along(course, 0.0, 0.0), AffinePiece.along(course, asked / z - 1.0, 0.0)
    return Share.at(
        name, "z", asked - z, deck, StackedField(name, "z", walls, pieces, layout.curve)
    )


def sheer_fore_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Raise the deck at FP, fading out to amidships."""
    course = [0.5 * parent.length, parent.length], [0.0, 1.0]
    return _sheer(parent, "sheer_fore", "deck fore", asked, course, layout)


def sheer_aft_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Raise the deck at AP, fading out to amidships."""
    course = [0.0, 0.5 * parent.length], [1.0, 0.0]
    return _sheer(parent, "sheer_aft", "deck aft", asked, course, layout)


def _sheer(
    parent: Parent, name: str, end: str, asked: float, course: tuple[list[float], list[float]],
    layout: Layout,
) -> Share:  # fmt: skip
    """Raise the deck by a ratio of heights from the design waterline up, full at one end."""
    middle, place = parent.at("deck", name), parent.at(end, name)
    change = asked - float(place[2] - middle[2])
    chain = BlendChain.through(*course, layout.curve, name)
    walls = level_boundaries(["T", "deck"], [parent.draught, float(place[2])])
    ratio = change / float(place[2])
    pieces = AffinePiece.along(chain, 0.0, 0.0), AffinePiece.along(chain, ratio, 0.0)
    field = StackedField(name, "z", walls, pieces, layout.curve)
    return Share(name, "z", change, np.array([place, middle]), np.array([1.0, -1.0]), (field,))


def _shift(name: str, chain: BlendChain, change: float, place: float, layout: Layout) -> Share:
    """Shift stations by a chain times a change (m), all heights alike, in full at `place`."""
    field = StackedField(
        name,
        "x",
        level_boundaries(["base"], [0.0]),
        (AffinePiece.along(chain, 0.0, change),),
        layout.curve,
    )
    return Share.at(name, "x", change, np.array([place, 0.0, 0.0]), field)


def _middle(parent: Parent, name: str) -> tuple[float, float]:
    """Give both ends of the parallel middle body, m from AP."""
    start, end = (float(parent.at(each, name)[0]) for each in ("body start", "body end"))
    for reaches, what in (
        (name != "parallel_body_end" and not start > 0.0, "AP"),
        (name != "parallel_body_start" and not end < parent.length, "FP"),
    ):
        if reaches:
            raise cannot_vary(
                name, f"the parallel body, x = {start:.6g} to {end:.6g} m, reaches the {what}, and "
                "leaves no sections beyond it to be shifted",
            )  # fmt: skip
    return start, end


def parallel_body_start_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Move the after end of the parallel middle body; its fore end and the AP stay."""
    name = "parallel_body_start"
    start, end = _middle(parent, name)
    chain = BlendChain.through([0.0, start, end], [0.0, 1.0, 0.0], layout.curve, name)
    return _shift(name, chain, asked - start, start, layout)


def parallel_body_end_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Move the fore end of the parallel middle body; its after end and the FP stay."""
    name = "parallel_body_end"
    start, end = _middle(parent, name)
    chain = BlendChain.through([start, end, parent.length], [0.0, 1.0, 0.0], layout.curve, name)
    return _shift(name, chain, asked - end, end, layout)


def parallel_body_length_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Move both ends of the parallel middle body apart, each by half; AP and FP stay."""
    name = "parallel_body_length"
    start, end = _middle(parent, name)
    change = asked - (end - start)
    nodes = [0.0, start, end, parent.length]
    chain = BlendChain.through(nodes, [0.0, -0.5, 0.5, 0.0], layout.curve, name)
    share = _shift(name, chain, change, end, layout)
    places = np.array([[end, 0.0, 0.0], [start, 0.0, 0.0]])
    return attrs.evolve(share, places=places, weights=np.array([1.0, -1.0]))


def body_length_field_beside(parent: Parent, asked: Mapping[str, float], layout: Layout) -> Share:
    """Give the length by the end that is not asked for, where one of them is.

    Moved by half each way, both ends would have to undo what is asked of the one: fields of
    several times the change, which work against each other.
    """
    name, length = "parallel_body_length", asked["parallel_body_length"]
    start, end = _middle(parent, name)
    if "parallel_body_start" in asked:
        nodes, at, wanted = [start, end, parent.length], end, asked["parallel_body_start"] + length
    else:
        nodes, at, wanted = [0.0, start, end], start, asked["parallel_body_end"] - length
    chain = BlendChain.through(nodes, [0.0, 1.0, 0.0], layout.curve, name)
    return _shift(name, chain, wanted - at, at, layout)


def fore_shift_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Shift the sections between the parallel body and where the profile rises, forward."""
    _, _, inner, outer = shift_terminals(parent, "fore_shift")
    if outer <= inner:
        raise _no_run(parent, "fore_shift", inner)
    return _bump("fore_shift", inner, outer, asked, layout)


def aft_shift_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Shift the sections between where the profile rises and the parallel body, aft."""
    outer, inner, _, _ = shift_terminals(parent, "aft_shift")
    if outer >= inner:
        raise _no_run(parent, "aft_shift", inner)
    return _bump("aft_shift", inner, outer, asked, layout)


def _no_run(parent: Parent, name: str, inner: float) -> BadInputError:
    """Say that the bottom rises from x (m) on, and what moves volume there all the same."""
    aft = name == "aft_shift"
    if parent.has("body start"):
        what, remedy = "parallel body", "parallel_body_start" if aft else "parallel_body_end"
    else:  # the end of a parallel body cannot be varied where there is none
        what, remedy = "largest section", "fore_shift" if aft else "aft_shift"
    return BadInputError(
        f"{name}: the bottom rises from the {what} on, at x = {inner:.6g} m, and no stretch lies "
        "between them to be shifted",
        "in vary", f"vary {remedy}",
    )  # fmt: skip


def shift_terminals(parent: Parent, name: str) -> tuple[float, float, float, float]:
    """Give between which places sections shift, m from AP, from aft.

    They are where the profile begins to rise and the ends of the parallel body; where there is
    none, the two stations with the largest areas.

    Parameters
    ----------
    parent : Parent
    name : str
        Of the parameter, for the error.

    Raises
    ------
    BadInputError
        The parent has neither.
    """
    largest = parent.has("largest aft") and not parent.has("body start")
    inner = ("largest aft", "largest fore") if largest else ("body start", "body end")
    aft, start, end, fore = (
        float(parent.at(place, name)[0]) for place in ("aft terminal", *inner, "fore terminal")
    )
    return aft, start, end, fore


def _bump(name: str, inner: float, outer: float, asked: float, layout: Layout) -> Share:
    """Shift between two terminals: the bump is full where its shape is."""
    bump = Bump(inner, outer, 1.0, layout.shift)
    full = bump.top
    course = bump.scaled(asked / float(bump.at(np.array(full))))
    field = StackedField(
        name,
        "x",
        level_boundaries(["base"], [0.0]),
        (AffinePiece(BlendChain.constant(0.0), 0.0, course),),
        layout.curve,
    )
    return Share.at(name, "x", asked, np.array([full, 0.0, 0.0]), field)


# --------------------------------------------------------------------------------------
# The bow: bulb and stem.

_BULB = {"base": (0.3, 0.0), "bulb": (0.95, 0.3)}
"""Windows of the bulb's hat (down, up) as parts of the gaps: one long bend from the base up."""


def bow_fade(parent: Parent, layout: Layout) -> BlendChain:
    """Give 0 up to where the bow begins, 1 from the fore perpendicular on."""
    regions = regions_of(parent, layout)
    if regions is not None:
        return regions.fore()
    nodes = [layout.bow_from * parent.length, parent.length]
    return BlendChain.through(nodes, [0.0, 1.0], layout.curve, "bow")


def bulb_walls(parent: Parent, layout: Layout, tip: float, part: float) -> tuple[Boundary, ...]:
    """Give where the bulb ends upward, its tip (m), and where its fields do, a part of T."""
    regions = regions_of(parent, layout)
    heights = [tip, part * parent.draught]
    if regions is not None:
        heights = [regions.heights["Hbulb"], regions.heights["Hdraft"]]
    return level_boundaries(["bulb", "above T"], heights)


def bulb_height_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Raise the bulb's foremost point: a hat from the base to above the design waterline."""
    name = "bulb_height"
    tip = parent.at("bulb tip", name)
    z, top = float(tip[2]), layout.bulb_top * parent.draught
    anchors = [("base", 0.0, 0.0), ("bulb", z, asked - z), ("above T", top, 0.0)]
    regions = regions_of(parent, layout)
    if regions is not None:
        anchors = [("bulb", regions.heights["Hbulb"], asked - z)]
        anchors = regions.at_rest(anchors, "Hbase", "Hdraft", "Hmax")
    field = layout.over(name, anchors, bow_fade(parent, layout), windows=_BULB)
    return Share.at(name, "z", asked - z, tip, field)


def bulb_half_breadth_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Widen the bulb by a ratio, full from its foremost point down."""
    name = "bulb_half_breadth"
    side, tip = parent.at("bulb side", name), parent.at("bulb tip", name)
    y, fade = float(side[1]), bow_fade(parent, layout)
    walls = bulb_walls(parent, layout, float(tip[2]), layout.bulb_side)
    # the widest place may lie above the tip, where the ratio has begun to fade
    unit = StackedField(
        name,
        "y",
        walls,
        (AffinePiece.along(fade, 1.0, 0.0), AffinePiece.along(fade, 0.0, 0.0)),
        layout.curve,
    )
    grip = float(unit.displacement(side[None, :])[0])
    return Share.at(name, "y", asked - y, side, unit.scaled((asked - y) / grip))


def bulb_length_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Shift the bulb forward, full from its foremost point down; the stem moves by what fades."""
    name = "bulb_length"
    tip = parent.at("bulb tip", name)
    change = asked - (float(tip[0]) - parent.length)
    fade = bow_fade(parent, layout)
    walls = bulb_walls(parent, layout, float(tip[2]), layout.bulb_stem)
    pieces = AffinePiece.along(fade, 0.0, change), AffinePiece.along(fade, 0.0, 0.0)
    return Share.at(name, "x", change, tip, StackedField(name, "x", walls, pieces, layout.curve))


def stem_rake_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Rake the stem above the design waterline; the fore perpendicular and the bulb stay."""
    name = "stem_rake_deg"
    foot, top = parent.at("stem", name), parent.at("stem top", name)
    height = float(top[2] - foot[2])
    change = math.tan(math.radians(asked)) * height - float(top[0] - foot[0])
    width = 0.5 * height
    # the ramp has grown to height - width / 2 at the top
    field = Rake(
        name, bow_fade(parent, layout), change / (height - 0.5 * width), float(foot[2]), width,
        layout.curve,
    )  # fmt: skip
    return Share(name, "x", change, np.array([top, foot]), np.array([1.0, -1.0]), (field,))


# --------------------------------------------------------------------------------------
# The stern: shaft, bossing, transom.

_WINDOW, _DOME, _HIGHEST = 0.3, 0.95, 0.65
"""Windows as parts of their gaps: the usual one, that of a dome downward, and the most upward."""

_BOSS = {"boss-": (_HIGHEST, 0.0), "boss+": (0.0, _HIGHEST)}
"""Between them heights are stretched evenly, so that a circle stays one."""

_SLENDER = 1.25
"""Where the ship is broader than the transom by this factor, a tube keeps its sides as they are."""

_ALIKE = 1e-6
"""m: tangents that differ by less are those of a circle; heights that do are one."""

_FOOT = {"transom foot": (_WINDOW, 0.0), "transom": (0.5, 0.5)}
"""A long slow bend from the foot up; nothing of it lies above the foot."""


def _stern_fade(layout: Layout, x: float, reach: float) -> BlendChain:
    """Give 1 up to x, and 0 from a reach (m) forward of it."""
    return BlendChain.through([x, x + reach], [1.0, 0.0], layout.curve, "stern")


def shaft_height_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Raise the shaft: a hat over base, bossing and above the design waterline.

    One dome rises from the base, is level at the shaft and comes down far above it: frames of the
    after body are nearly straight, and show every bend of a field.
    """
    name = "shaft_height"
    boss = parent.at("boss", name)
    x, z = float(boss[0]), float(boss[2])
    change, top = asked - z, layout.shaft_top * parent.draught
    fade = _stern_fade(layout, _cylinder(parent, x), layout.shaft * parent.length)
    if layout.blend == "paper":
        return Share.at(name, "z", change, boss, shaft_ratios(parent, change, layout, fade))
    anchors, rigid = [("shaft", z, change)], tuple[str, ...]()
    if layout.rigid and parent.has("boss top"):
        r = float(parent.places["boss top"][2]) - z
        anchors = [("shaft-r", z - r, change), ("shaft+r", z + r, change)]
        rigid = ("shaft-r", "shaft+r")
    anchors = [("base", 0.0, 0.0), *anchors, ("above T", top, 0.0)]
    windows = {} if rigid else _dome(z, top, layout)
    field = layout.over(name, anchors, fade, rigid, windows)
    return Share.at(name, "z", change, boss, field)


def _dome(z: float, top: float, layout: Layout) -> dict[str, tuple[float, float]]:
    """Give windows of one dome over z (m), level there; below the base there is no hull to bend."""
    up = min(_DOME * z * level_window(z, top - z, layout.curve), _HIGHEST * (top - z))
    return {"base": (_WINDOW, 0.0), "shaft": (_DOME, up / (top - z))}


def _cylinder(parent: Parent, x: float) -> float:
    """Give where the cylinder ends that the bossing, which ends at x, begins with."""
    return max(x, float(parent.places["boss fore"][0])) if parent.has("boss fore") else x


def bossing_radius_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Widen the bossing about its own centre; psi keeps the hull beside it as it is."""
    name = "bossing_radius"
    side, boss, top = (parent.at(key, name) for key in ("boss side", "boss", "boss top"))
    x, h, y = float(boss[0]), float(boss[2]), float(side[1])
    r = float(top[2]) - h
    fade = _stern_fade(layout, _cylinder(parent, x), layout.bossing * r)
    if layout.blend == "paper":
        return Share.at(name, "y", asked - y, side, *bossing_ratios(parent, asked, layout, fade))
    names = [f"boss{each}r" for each in ("-6", "-", "+", "+4")]
    walls = level_boundaries(names, [h - 6.0 * r, h - r, h + r, h + 4.0 * r])
    wide, high = asked / y - 1.0, asked - r
    none, broad = AffinePiece.along(fade, 0.0, 0.0), AffinePiece.along(fade, wide, 0.0)
    out = StackedField(
        name, "y", walls, (none, broad, broad, none), layout.curve,
        Tube(y, layout.tube, layout.curve),
    )  # fmt: skip
    anchors = [
        ("boss-6r", h - 6.0 * r, 0.0), ("boss-", h - r, -high),
        ("boss+", h + r, high), ("boss+5r", h + 5.0 * r, 0.0),
    ]  # fmt: skip
    # breadths need the length: the hull must not become narrower than its bossing ahead of it
    sooner = _stern_fade(layout, _cylinder(parent, x), 0.5 * layout.bossing * r)
    up = layout.over(name, anchors, sooner, windows=_BOSS)
    return Share.at(name, "y", asked - y, side, out, up)


def _above_base(name: str, z: float) -> None:
    """Refuse a transom from the base line up: its fields fade out below its lowest point."""
    if not z > _ALIKE:
        raise cannot_vary(
            name, f"the transom reaches down to the base line (z = {z:.4g} m), and the change has "
            "no height below it to fade out in",
        )  # fmt: skip


def transom_height_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Raise the transom's lowest point; what lies above it, the deck included, moves along."""
    name = "transom_height"
    low = parent.at("transom", name)
    x, z = float(low[0]), float(low[2])
    foot = min(layout.transom_low * parent.draught, 0.5 * z)
    _above_base(name, z)
    anchors = [("transom foot", foot, 0.0), ("transom", z, asked - z)]
    fade = _stern_fade(layout, x, layout.stern * parent.length)
    regions = regions_of(parent, layout)
    if regions is not None:
        fade, level = regions.aft(x), regions.heights["Htransom"]
        above = [each for each in ("Hdraft", "Hmax") if regions.heights[each] > level]
        anchors = [("transom", level, asked - z)]
        anchors = regions.at_rest(anchors, "Hbase", "Hbilge", "Hshaft", *above)
    field = layout.over(name, anchors, fade, windows=_FOOT)
    return Share.at(name, "z", asked - z, low, field)


def transom_half_breadth_field(parent: Parent, asked: float, layout: Layout) -> Share:
    """Widen the transom by a ratio, full from its lowest point up."""
    name = "transom_half_breadth"
    side, low = parent.at("transom side", name), parent.at("transom", name)
    x, y, z = float(low[0]), float(side[1]), float(low[2])
    foot = min(layout.transom_side * parent.draught, 0.5 * z)
    _above_base(name, z)
    fade = _stern_fade(layout, x, layout.stern * parent.length)
    pieces = AffinePiece.along(fade, 0.0, 0.0), AffinePiece.along(fade, asked / y - 1.0, 0.0)
    regions = regions_of(parent, layout)
    if regions is not None:
        fade, z = regions.aft(x), regions.heights["Htransom"]
        foot = regions.below(z)
    walls = level_boundaries(["transom foot", "transom"], [foot, z])
    n = 0.5 * parent.breadth / y
    tube = Tube(y, n, layout.curve) if n > _SLENDER else None
    field = StackedField(name, "y", walls, pieces, layout.curve, tube)
    return Share.at(name, "y", asked - y, side, field)


# --------------------------------------------------------------------------------------
# Bilge and bottom: layers of their own.

_INNER = 0.95
"""A corner fades out within this part of the half-breadth, so that the centre plane stays."""


def _range(parent: Parent, layout: Layout, name: str) -> BlendChain:
    """Give how much acts along the ship: 1 along the parallel body, fading beyond."""
    regions = regions_of(parent, layout)
    if regions is not None:
        return regions.middle()
    start = float(parent.at("body start", name)[0])
    end = float(parent.at("body end", name)[0])
    reach = layout.bilge_length * parent.length
    return BlendChain.through(
        [start - reach, start, end, end + reach], [0.0, 1.0, 1.0, 0.0], layout.curve, name
    )


def _corner(
    parent: Parent, layout: Layout, name: str, size: float, ratios: tuple[float, float]
) -> CornerLayer:
    """Stretch about the corner by ratios (bottom, side), full as far as `size` (m) from it."""
    corner, low = parent.at("corner", name), parent.at("bilge low", name)
    along = _range(parent, layout, name)
    y, z = float(corner[1]), float(corner[2])
    rise = math.atan2(z - float(low[2]), y - float(low[1]))
    largest = size * max(*ratios, 1.0)
    reach = min(layout.bilge * size, _INNER * y, _INNER * (parent.depth - z))
    if not reach > largest:
        raise BadInputError(
            f"bilge: {name} of {largest:.4g} m from the corner leaves no bottom or side to fade in "
            f"({reach:.4g} m)", "in vary",
            "ask for a broader flat" if name == "flat_of_bottom" else "ask for less",
        )  # fmt: skip
    fade = BlendChain.through([size, reach], [1.0, 0.0], layout.curve, name)
    return CornerLayer(name, along, y, z, rise, *ratios, fade)


def bilge_radius_layer(parent: Parent, asked: float, layout: Layout) -> CornerLayer:
    """Make the bilge's circle larger or smaller, touching side and bottom as before."""
    name = "bilge_radius"
    corner, low, high = (parent.at(each, name) for each in ("corner", "bilge low", "bilge high"))
    along = math.dist(corner.tolist(), low.tolist())
    up = math.dist(corner.tolist(), high.tolist())
    rise = math.atan2(float(corner[2] - low[2]), float(corner[1] - low[1]))
    # both tangents of a fillet are as long
    tangent = asked * math.tan(0.5 * (0.5 * math.pi - rise))
    return _corner(parent, layout, name, max(along, up), (tangent / along, tangent / up))


def flat_of_bottom_layer(parent: Parent, asked: float, layout: Layout) -> CornerLayer:
    """Move the edge of the flat bottom in or out.

    Heights stay, unless the bilge is as high as it is wide: then it is a fillet, and stays one, as
    high as it comes to be wide.
    """
    name = "flat_of_bottom"
    edge, corner = parent.at("flat edge", name), parent.at("corner", name)
    y, half = float(edge[1]), float(corner[1])
    _range(parent, layout, name)  # without a parallel body no half-breadth can be had
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


def deadrise_layer(parent: Parent, asked: float, layout: Layout) -> DeadriseLayer:
    """Turn the bottom about the side of the keel; what lies above the bilge stays."""
    name = "deadrise_deg"
    keel, inner, outer = (parent.at(each, name) for each in ("keel side", "bottom", "bottom edge"))
    q = math.tan(math.radians(asked)) - float((outer[2] - inner[2]) / (outer[1] - inner[1]))
    low = float(parent.places["bilge high"][2]) if parent.has("bilge high") else 0.0
    top = layout.deadrise_top * parent.draught
    fade = BlendChain.through([low, top], [1.0, 0.0], layout.curve, name)
    return DeadriseLayer(
        name, _range(parent, layout, name), q, float(keel[1]), 0.0, fade, layout.curve
    )
