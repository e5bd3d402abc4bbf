"""A hull made larger as a whole: each length of its definition and of its curves, no angle."""

from __future__ import annotations

from typing import Any

from assoc_hull.hull import Hull
from assoc_hull.model.definition import definition, published
from assoc_hull.model.restore import from_definition

__all__ = ["scaled"]

_LENGTHS = {"length", "breadth", "depth", "draught", "offset", "value", "base", "from", "knot",
            "limit", "gap"}  # fmt: skip
"""Under these keys stand lengths, or lists of them."""


def scaled(hull: Hull, factor: float) -> Hull:
    """Give a hull whose every length is so many times that of another.

    Nothing is lofted anew: a factor that is a power of two leaves all digits as they are.
    """
    shape, curves = definition(hull.state), published(hull.state)
    return Hull(from_definition(_times(shape, factor), _times(_met(curves, factor), factor)))


def _met(curves: dict[str, Any], factor: float) -> dict[str, Any]:
    """Places where curves meet, each a knot and three coordinates, are all lengths."""
    found = {
        key: {**curve, "meets": {each: _each(at, factor) for each, at in curve["meets"].items()}}
        for key, curve in curves["curves"].items()
    }
    return {**curves, "curves": found}


def _times(part: Any, factor: float) -> Any:
    if isinstance(part, dict):
        return {
            key: _each(value, factor) if key in _LENGTHS else _times(value, factor)
            for key, value in part.items()
        }
    return [_times(each, factor) for each in part] if isinstance(part, list) else part


def _each(part: Any, factor: float) -> Any:
    """Numbers times the factor, in lists of any depth; what is no number stays."""
    if isinstance(part, list):
        return [_each(each, factor) for each in part]
    return part * factor if isinstance(part, float) else part
