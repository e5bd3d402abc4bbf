"""Layouts of the named parameters of the stern: shaft, bossing, transom."""

from __future__ import annotations

from assoc_hull.variation.fields.field import Field, Piece, Tube, stack
from assoc_hull.variation.fields.hat import level
from assoc_hull.variation.fields.piecewise_linear import Chain
from assoc_hull.variation.parameters.layout import Layout
from assoc_hull.variation.parameters.parent_places import Parent
from assoc_hull.variation.parameters.share import Share

__all__ = ["bossing_radius", "shaft_height", "transom_half_breadth", "transom_height"]


_WINDOW, _DOME, _HIGHEST = 0.3, 0.95, 0.65
"""Windows as parts of the gaps they lie in: the usual one, that of a dome down, and most up."""

_BOSS = {"boss-": (_HIGHEST, 0.0), "boss+": (0.0, _HIGHEST)}
"""Between them heights are stretched evenly, so that a circle stays one."""

_SLENDER = 1.25
"""A transom less than the ship's breadth by this factor is widened with nothing at the sides."""

_FOOT = {"transom foot": (_WINDOW, 0.0), "transom": (0.5, 0.5)}
"""A long slow bend from the foot up; nothing of it lies above the foot."""


def _fade(layout: Layout, x: float, reach: float) -> Chain:
    """Give 1 up to x, and 0 from a reach (m) forward of it."""
    return Chain.through([x, x + reach], [1.0, 0.0], layout.curve, "stern")


def shaft_height(parent: Parent, asked: float, layout: Layout) -> Share:
    """Raise the shaft: a hat over base, bossing and above the design waterline.

    One dome rises from the base, is level at the shaft and comes down far above it: frames of the
    after body are nearly straight, and show every bend of a field.
    """
    name = "shaft_height"
    boss = parent.at("boss", name)
    x, z = float(boss[0]), float(boss[2])
    change, top = asked - z, layout.shaft_top * parent.draught
    fade = _fade(layout, _cylinder(parent, x), layout.shaft * parent.length)
    if layout.blend == "paper":
        return Share.at(name, "z", change, boss, _ratio_shaft(parent, change, layout, fade))
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
    up = min(_DOME * z * level(z, top - z, layout.curve), _HIGHEST * (top - z))
    return {"base": (_WINDOW, 0.0), "shaft": (_DOME, up / (top - z))}


def _cylinder(parent: Parent, x: float) -> float:
    """Give where the cylinder ends that the bossing, which ends at x, begins with."""
    return max(x, float(parent.places["boss fore"][0])) if parent.has("boss fore") else x


def bossing_radius(parent: Parent, asked: float, layout: Layout) -> Share:
    """Widen the bossing about its own centre; psi keeps the hull beside it as it is."""
    name = "bossing_radius"
    side, boss, top = (parent.at(key, name) for key in ("boss side", "boss", "boss top"))
    x, h, y = float(boss[0]), float(boss[2]), float(side[1])
    r = float(top[2]) - h
    fade = _fade(layout, _cylinder(parent, x), layout.bossing * r)
    if layout.blend == "paper":
        return Share.at(name, "y", asked - y, side, *_ratio_bossing(parent, asked, layout, fade))
    names = [f"boss{each}r" for each in ("-6", "-", "+", "+4")]
    walls = stack(names, [h - 6.0 * r, h - r, h + r, h + 4.0 * r])
    wide, high = asked / y - 1.0, asked - r
    none, broad = Piece.along(fade, 0.0, 0.0), Piece.along(fade, wide, 0.0)
    out = Field(
        name, "y", walls, (none, broad, broad, none), layout.curve,
        Tube(y, layout.tube, layout.curve),
    )  # fmt: skip
    anchors = [
        ("boss-6r", h - 6.0 * r, 0.0), ("boss-", h - r, -high),
        ("boss+", h + r, high), ("boss+5r", h + 5.0 * r, 0.0),
    ]  # fmt: skip
    # breadths need the length: the hull must not become narrower than its bossing ahead of it
    sooner = _fade(layout, _cylinder(parent, x), 0.5 * layout.bossing * r)
    up = layout.over(name, anchors, sooner, windows=_BOSS)
    return Share.at(name, "y", asked - y, side, out, up)


def _ratio_shaft(parent: Parent, change: float, layout: Layout, fade: Chain) -> Field:
    """Give the field of the shaft's height as Choi & Lee lay it out, of ratios of heights."""
    h = float(parent.at("boss", "shaft_height")[2])
    anchors = [("shaft", h, change)]
    if parent.has("boss top"):
        r = float(parent.places["boss top"][2]) - h
        anchors = [("shaft-r", h - r, change), *anchors, ("shaft+r", h + r, change)]
    anchors = [("base", 0.0, 0.0), *anchors, ("T", parent.draught, 0.0)]
    return layout.over("shaft_height", anchors, fade)


def _ratio_bossing(
    parent: Parent, asked: float, layout: Layout, fade: Chain
) -> tuple[Field, Field]:
    """Give the bossing's fields as Choi & Lee lay them out: no tube, no pivot at its centre."""
    name = "bossing_radius"
    side, boss, top = (parent.at(key, name) for key in ("boss side", "boss", "boss top"))
    h, y = float(boss[2]), float(side[1])
    r = float(top[2]) - h
    walls = stack(["shaft-3r", "shaft", "shaft+3r"], [h - 3.0 * r, h, h + 3.0 * r])
    none, broad = Piece.along(fade, 0.0, 0.0), Piece.along(fade, asked / y - 1.0, 0.0)
    anchors = [
        ("base", 0.0, 0.0), ("shaft-r", h - r, r - asked), ("shaft", h, 0.0),
        ("shaft+r", h + r, asked - r), ("T", parent.draught, 0.0),
    ]  # fmt: skip
    out = Field(name, "y", walls, (none, broad, none), layout.curve)
    return out, layout.over(name, anchors, fade)


def transom_height(parent: Parent, asked: float, layout: Layout) -> Share:
    """Raise the transom's lowest point; what lies above it, the deck included, moves along."""
    name = "transom_height"
    low = parent.at("transom", name)
    x, z = float(low[0]), float(low[2])
    foot = min(layout.transom_low * parent.draught, 0.5 * z)
    anchors = [("transom foot", foot, 0.0), ("transom", z, asked - z)]
    fade = _fade(layout, x, layout.stern * parent.length)
    field = layout.over(name, anchors, fade, windows=_FOOT)
    return Share.at(name, "z", asked - z, low, field)


def transom_half_breadth(parent: Parent, asked: float, layout: Layout) -> Share:
    """Widen the transom by a ratio, full from its lowest point up."""
    name = "transom_half_breadth"
    side, low = parent.at("transom side", name), parent.at("transom", name)
    x, y, z = float(low[0]), float(side[1]), float(low[2])
    foot = min(layout.transom_side * parent.draught, 0.5 * z)
    fade = _fade(layout, x, layout.stern * parent.length)
    pieces = Piece.along(fade, 0.0, 0.0), Piece.along(fade, asked / y - 1.0, 0.0)
    walls = stack(["transom foot", "transom"], [foot, z])
    n = 0.5 * parent.breadth / y
    tube = Tube(y, n, layout.curve) if n > _SLENDER else None
    field = Field(name, "y", walls, pieces, layout.curve, tube)
    return Share.at(name, "y", asked - y, side, field)
