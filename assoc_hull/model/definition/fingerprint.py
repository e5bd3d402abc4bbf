"""The fingerprint of a hull: SHA-256 of its definition and its published values.

Every column in canonical order goes in with its name, type and shape; the bits themselves
are hashed. History, row numbers and the order of creation play no part. `FingerprintCache` takes
the fingerprint again and again while the structure of a hull stays, and hashes only what an edit
of shape can have changed.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.model.definition.fingerprint import fingerprint
>>> from assoc_hull.model.definition.fingerprint import FingerprintCache
>>> state = wigley()
>>> FingerprintCache(state).take() == fingerprint(state)
True
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Collection, Iterator, Mapping

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.change import TableChange
from assoc_hull.model.definition.canonical_columns import (
    CanonicalOrder,
    Column,
    canonical_order,
    curve_columns,
    feature_columns,
    line_columns,
    meet_columns,
    meet_turn,
    point_columns,
    retired_keys,
    spline_columns,
    value_columns,
)
from assoc_hull.model.definition.records import (
    association_records,
    birth_records,
    definition_columns,
    generated_columns,
    plain_fields,
)
from assoc_hull.model.tables import HullState

__all__ = [
    "FingerprintCache",
    "column_bytes",
    "fingerprint",
    "fingerprint_parts",
    "is_shape",
]


def fingerprint(state: HullState) -> str:
    """Give the SHA-256 of definition and published values, 64 hexadecimal digits.

    Every column in canonical order, with its name, type and shape; floats as 8 bytes IEEE
    754, little end first, whole numbers as 8 bytes likewise, texts as JSON. The bits
    themselves are hashed: -0.0 and 0.0 are two numbers here, as they are to the update.
    Revisions, history, causes, times, row numbers and the order of creation play no part.
    """
    digest = hashlib.sha256()
    for _, part in fingerprint_parts(state, canonical_order(state)):
        digest.update(part)
    return digest.hexdigest()


def fingerprint_parts(
    state: HullState, order: CanonicalOrder, leave: Collection[str] = ()
) -> Iterator[tuple[str, bytes]]:
    """Give what a fingerprint is taken of, part by part, each column with its name.

    Columns that are to be left stand without their bytes.
    """
    for each in (state.particulars, state.tolerances):
        fields = plain_fields(each)
        texts = [value for value in fields.values() if isinstance(value, str)]
        numbers = [value for value in fields.values() if not isinstance(value, str)]
        head = column_bytes(",".join(fields), texts)
        yield "", head + column_bytes("", np.array(numbers, np.float64))
    yield "", json.dumps(_settings(state, order)).encode()
    tables = {
        "line": line_columns(state, order),
        "curve": curve_columns(state, order),
        "meet": meet_columns(state, order),
        "point": point_columns(state, order),
        "value": value_columns(state, order),
        "spline": spline_columns(state, order),
    }
    if state.features:
        tables["feature"] = feature_columns(state, order)
    if state.definitions:
        tables["definition"] = definition_columns(state)
    if state.generated:
        tables["generated"] = generated_columns(state, order)
    for title, columns in tables.items():
        for column, values in columns.items():
            name = f"{title}.{column}"
            yield name, b"" if name in leave else column_bytes(name, values)


def _settings(state: HullState, order: CanonicalOrder) -> list[object]:
    """Give the parts of a definition that hold texts and counts only."""
    names = [(state.groups.name[i], state.groups.family[i]) for i in order.groups.tolist()]
    return [names, association_records(state), birth_records(state), retired_keys(state)]


def column_bytes(name: str, column: Column) -> bytes:
    """Serialise a column so that no two differ in meaning and agree in bytes."""
    if isinstance(column, list):
        return f"{name}:text:".encode() + json.dumps(column).encode()
    kind = "<f8" if column.dtype.kind == "f" else "<i8"
    return f"{name}:{kind}{column.shape}:".encode() + column.astype(kind).tobytes()


_SHAPE = frozenset({"rows.xyz", "rows.gap"})
"""Columns that an edit of shape changes, besides places on curves and splines."""


def is_shape(change: TableChange) -> bool:
    """Tell whether a change leaves alone all that a `FingerprintCache` takes for granted."""
    return not (
        change.objects or change.sizes or change.births or len(change.before.curve)
        or any(change.kept) or not _SHAPE.issuperset(change.bits)
    )  # fmt: skip


class FingerprintCache:
    """Takes the fingerprint of tables whose structure does not change meanwhile.

    Parameters
    ----------
    state : HullState
        The tables; make another printer when `is_shape` says no of a change of theirs.
    """

    def __init__(self, state: HullState) -> None:
        self.state, self.order = state, canonical_order(state)
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
        self._meets = [self.state.curves.meets[curve] for curve in self.order.curves.tolist()]
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
        found: FloatArray = self.state.rows.xyz[self.order.rows]
        return found

    def _gap(self) -> FloatArray:
        return np.where(self._watched, self.state.rows.gap[self.order.rows], 0.0)

    def _met(self, name: str, width: int) -> FloatArray:
        return _join([getattr(each, name) for each in self._meets], width)[self._turn]

    def _spline(self, name: str, width: int) -> FloatArray:
        return _join([getattr(each, name) for each in self._splines], width)


def _join(parts: list[FloatArray], width: int) -> FloatArray:
    empty = np.zeros(0 if width == 1 else (0, width))
    return np.concatenate([empty, *parts])
