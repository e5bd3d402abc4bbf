"""The first layer: the hull scaled as a whole by its principal dimensions."""

from __future__ import annotations

from collections.abc import Mapping

from assoc_hull.variation.fields.field import Field, Piece, stack
from assoc_hull.variation.fields.fields_layer import FieldLayer
from assoc_hull.variation.fields.piecewise_linear import Chain
from assoc_hull.variation.parameters.layout import Layout
from assoc_hull.variation.parameters.parent_places import Parent

__all__ = ["main_layer"]

_ALL = Chain.constant(1.0)


def main_layer(parent: Parent, asked: Mapping[str, float], layout: Layout) -> FieldLayer | None:
    """Scale lengths, breadths and the heights below the draught; None if none is asked for.

    Where length, breadth, draught and depth are all asked for in one ratio, heights above the
    draught are scaled by it as well: the hull becomes a similar one.
    """
    fields = list[Field]()
    for name, axis, now in (("length", "x", parent.length), ("breadth", "y", parent.breadth)):
        if name in asked and asked[name] != now:
            piece = Piece.along(_ALL, asked[name] / now - 1.0, 0.0)
            fields.append(
                Field(name, "x" if axis == "x" else "y", stack(["base"], [0.0]), (piece,))
            )
    if "draught" in asked and asked["draught"] != parent.draught:
        fields.append(_draught(parent, asked["draught"], layout, _even(parent, asked)))
    return FieldLayer("principal dimensions", tuple(fields)) if fields else None


def _even(parent: Parent, asked: Mapping[str, float]) -> bool:
    """Tell whether the depth is asked for in the ratio of the draught."""
    ratio = asked["draught"] / parent.draught
    return "depth" in asked and abs(asked["depth"] / parent.depth - ratio) <= 1e-15


def _draught(parent: Parent, asked: float, layout: Layout, even: bool) -> Field:
    """Scale heights up to the draught; shift what lies well above it, depth included."""
    old = parent.draught
    scale = Piece.along(_ALL, asked / old - 1.0, 0.0)
    if even:
        return Field("draught", "z", stack(["base"], [0.0]), (scale,))
    top = min(layout.draught_top * old, parent.top)
    if not top > old:
        return Field("draught", "z", stack(["T"], [old]), (scale,))
    shift = Piece.along(_ALL, 0.0, asked - old)
    return Field("draught", "z", stack(["T", "top"], [old, top]), (scale, shift), layout.curve)
