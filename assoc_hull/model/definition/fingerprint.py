"""The fingerprint of a hull taken again and again, while its structure stays.

An edit of shape changes where points lie and where curves meet, not what there is. What a
fingerprint holds of the rest is put into bytes once.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.model.definition.definition import fingerprint
>>> from assoc_hull.model.definition.fingerprint import Printer
>>> state = wigley()
>>> Printer(state).take() == fingerprint(state)
True
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.change import Change
from assoc_hull.model.definition.canonical_columns import Column, meet_turn, places, point_columns
from assoc_hull.model.definition.definition import column_bytes, fingerprint_parts
from assoc_hull.model.state import HullState

__all__ = ["Printer", "is_shape"]

_SHAPE = frozenset({"rows.xyz", "rows.gap"})
"""Columns that an edit of shape changes, besides places on curves and splines."""


def is_shape(change: Change) -> bool:
    """Tell whether a change leaves alone all that a `Printer` takes for granted."""
    return not (
        change.objects or change.sizes or change.births or len(change.before.curve)
        or any(change.kept) or not _SHAPE.issuperset(change.bits)
    )  # fmt: skip


class Printer:
    """Takes the fingerprint of tables whose structure does not change meanwhile.

    Parameters
    ----------
    state : HullState
        The tables; make another printer when `is_shape` says no of a change of theirs.
    """

    def __init__(self, state: HullState) -> None:
        self.state, self.order = state, places(state)
        columns = point_columns(state, self.order)
        self._stored = np.asarray(columns["stored"])
        self._watched = np.asarray(columns["watched"])
        self._turn = meet_turn(state, self.order)[2]
        find = self._finders()
        self._parts: list[bytes | tuple[str, Callable[[], Column]]] = [
            (name, find[name]) if name in find else part
            for name, part in fingerprint_parts(state, self.order, leave=find.keys())
        ]

    def take(self) -> str:
        """Give the fingerprint of the tables as they are now; see `definition.fingerprint`."""
        digest = hashlib.sha256()
        self._meets = [self.state.curves.meets.data[curve] for curve in self.order.curves.tolist()]
        self._splines = [self.state.spline(curve) for curve in self.order.curves.tolist()]
        for part in self._parts:
            digest.update(part if isinstance(part, bytes) else column_bytes(part[0], part[1]()))
        return digest.hexdigest()

    def _finders(self) -> Mapping[str, Callable[[], Column]]:
        """Give how to find the columns that an edit of shape changes, by name."""
        return {
            "meet.parameter": lambda: self._met("parameter", 1),
            "meet.xyz": lambda: self._met("xyz", 3),
            "point.value": lambda: np.where(self._stored[:, None], self._xyz(), 0.0),
            "value.xyz": self._xyz,
            "value.gap": self._gap,
            "spline.knot": lambda: self._spline("knot", 1),
            "spline.xyz": lambda: self._spline("xyz", 3),
            "spline.leave": lambda: self._spline("leave", 3),
            "spline.arrive": lambda: self._spline("arrive", 3),
        }

    def _xyz(self) -> FloatArray:
        found: FloatArray = self.state.rows.xyz.data[self.order.rows]
        return found

    def _gap(self) -> FloatArray:
        return np.where(self._watched, self.state.rows.gap.data[self.order.rows], 0.0)

    def _met(self, name: str, width: int) -> Any:
        return _join([getattr(each, name) for each in self._meets], width)[self._turn]

    def _spline(self, name: str, width: int) -> Any:
        return _join([getattr(each, name) for each in self._splines], width)


def _join(parts: list[FloatArray], width: int) -> FloatArray:
    empty = np.zeros(0 if width == 1 else (0, width))
    return np.concatenate([empty, *parts])
