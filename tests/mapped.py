"""A hull made larger as a whole, or turned end for end: another hull of which all is known."""

from __future__ import annotations

from typing import Any

import numpy as np

from assoc_hull.hull import Hull
from assoc_hull.model.definition.records import definition, published
from assoc_hull.model.definition.restore import from_definition

__all__ = ["scaled", "turned"]

_LENGTHS = {"length", "breadth", "depth", "draught", "offset", "knot", "limit", "gap"}
_PLACES = {"value", "base", "from"}
_DIRECTIONS = {"directions", "vector", "leave", "arrive"}
"""Keys under which numbers stand, in lists of any depth."""


class _Map:
    """Places p become factor * p + shift, one by one; `size` is that of the factors."""

    def __init__(self, factor: tuple[float, float, float], shift: tuple[float, float, float]):
        self.factor, self.shift = np.array(factor), np.array(shift)
        self.size = abs(factor[0])

    def of(self, hull: Hull) -> Hull:
        """Map a hull; nothing is lofted anew."""
        shape: dict[str, Any] = definition(hull.state)
        curves: dict[str, Any] = published(hull.state)
        lines = [self._line(line) for line in shape["lines"]]
        met = {key: self._curve(each) for key, each in curves["curves"].items()}
        return Hull(
            from_definition(
                {**self._part(shape), "lines": lines}, {**self._part(curves), "curves": met}
            )
        )

    def _line(self, line: dict[str, Any]) -> dict[str, Any]:
        """Move a line's plane n . p = d; that of a station looks forward as before."""
        if "normal" not in line:
            return line
        normal = np.sign(self.factor) * line["normal"]
        offset = self.size * line["offset"] + float(normal @ self.shift)
        if normal[0] < 0.0 and not normal[1:].any():
            normal, offset = -normal, -offset
        return {**line, "normal": normal.tolist(), "offset": offset}

    def _curve(self, curve: dict[str, Any]) -> dict[str, Any]:
        """Map a published curve; where it meets others is told by its knots and places."""
        meets = {
            key: [[at[0] * self.size, *self._place(at[1:])] for at in rows]
            for key, rows in curve["meets"].items()
        }
        return {**self._part(curve), "meets": meets}

    def _part(self, part: Any) -> Any:
        if isinstance(part, dict):
            return {key: self._named(key, value) for key, value in part.items()}
        return [self._part(each) for each in part] if isinstance(part, list) else part

    def _named(self, key: str, value: Any) -> Any:
        if key in _PLACES:
            return self._rows(value, self._place)
        if key in _DIRECTIONS:
            return self._rows(value, self._direction)
        if key in _LENGTHS:
            return (np.array(value) * self.size).tolist()
        return self._part(value)

    def _rows(self, value: Any, change: Any) -> Any:
        if isinstance(value, list) and value and isinstance(value[0], float):
            return change(value)
        return [self._rows(each, change) for each in value] if isinstance(value, list) else value

    def _place(self, place: list[float]) -> list[float]:
        return list((self.factor * np.array(place) + self.shift).tolist())

    def _direction(self, direction: list[float]) -> list[float]:
        return list((np.sign(self.factor) * np.array(direction)).tolist())


def scaled(hull: Hull, factor: float) -> Hull:
    """Give a hull whose every length is so many times that of another.

    A factor that is a power of two leaves all digits as they are.
    """
    return _Map((factor, factor, factor), (0.0, 0.0, 0.0)).of(hull)


def turned(hull: Hull) -> Hull:
    """Give a hull whose stern is the bow of another: x becomes Lpp - x."""
    return _Map((-1.0, 1.0, 1.0), (hull.state.particulars.length, 0.0, 0.0)).of(hull)
