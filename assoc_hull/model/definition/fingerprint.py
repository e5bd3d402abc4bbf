"""The fingerprint of a hull: SHA-256 of its definition and its published values.

Every column in canonical order goes in with its name, type and shape; the bits themselves
are hashed. History, row numbers and the order of creation play no part. A hull file is guarded by
another one, of which an edit makes a part only: `assoc_hull.model.definition.hash_tree`.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.model.definition.fingerprint import fingerprint
>>> fingerprint(wigley()) == fingerprint(wigley())
True
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator

import numpy as np

from assoc_hull.model.attachments import attachment_records
from assoc_hull.model.definition.canonical_columns import (
    CanonicalOrder,
    Column,
    canonical_order,
    curve_columns,
    feature_columns,
    line_columns,
    meet_columns,
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
    ruling_records,
)
from assoc_hull.model.tables import HullState

__all__ = [
    "column_bytes",
    "fingerprint",
    "fingerprint_parts",
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


def fingerprint_parts(state: HullState, order: CanonicalOrder) -> Iterator[tuple[str, bytes]]:
    """Give what a fingerprint is taken of, part by part, each column with its name."""
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
            yield name, column_bytes(name, values)


def _settings(state: HullState, order: CanonicalOrder) -> list[object]:
    """Give the parts of a definition that hold texts and counts only."""
    names = [(state.groups.name[i], state.groups.family[i]) for i in order.groups.tolist()]
    members = [state.groups.members[i] for i in order.groups.tolist()]
    found = [names, association_records(state), birth_records(state), retired_keys(state)]
    found += [ruling_records(state)] if state.rulings else []
    found += [{kind: held} for kind, held in attachment_records(state).items() if held]
    return [*found, *([{"members": members}] if any(members) else ())]


def column_bytes(name: str, column: Column) -> bytes:
    """Serialise a column so that no two differ in meaning and agree in bytes."""
    if isinstance(column, list):
        return f"{name}:text:".encode() + json.dumps(column).encode()
    kind = "<f8" if column.dtype.kind == "f" else "<i8"
    return f"{name}:{kind}{column.shape}:".encode() + column.astype(kind).tobytes()
