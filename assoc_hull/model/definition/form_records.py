"""Definitions and generated curves in the definition of a hull, and in its fingerprint.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.model.definition.form_records import definition_records, generated_records
>>> state = wigley(stations=5, waterlines=4)
>>> list(definition_records(state)), list(generated_records(state))
([], [])
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import numpy as np

from assoc_hull.model.definition.canonical_columns import Column, Places
from assoc_hull.model.state import HullState

__all__ = ["definition_columns", "definition_records", "generated_columns", "generated_records"]

Record = dict[str, Any]


def definition_records(state: HullState) -> Iterator[Record]:
    """Give each definition as plain values, by key; values that are None are left out."""
    for each in state.definitions:
        record: Record = {"use": each.use, "name": each.name, "kind": each.kind}
        record |= {"rule": each.rule, "nodes": list(each.nodes)}
        yield record | {"values": {n: v for n, v in each.values.items() if v is not None}}


def generated_records(state: HullState) -> Iterator[Record]:
    """Give each generated curve as plain values, by key; of an attached one that is not told."""
    keys = state.rows.key.data
    for each in state.generated:
        record: Record = {"curve": each.key, "what": each.what, "layout": each.layout}
        record |= {"points": [str(keys[row]) for row in each.rows]}
        record |= {"marks": [[piece, t] for piece, t in each.marks]}
        yield record | ({} if each.attached else {"attached": False})


def definition_columns(state: HullState) -> dict[str, Column]:
    """Give the definitions by key, their values one behind the other; nan for None."""
    found = state.definitions
    values = [np.nan if v is None else v for each in found for v in each.values.values()]
    return {
        "use": [each.use for each in found],
        "name": [each.name for each in found],
        "kind": [each.kind for each in found],
        "rule": [each.rule for each in found],
        "nodes": [json.dumps(each.nodes) for each in found],
        "value": np.array(values, np.float64),
    }


def generated_columns(state: HullState, order: Places) -> dict[str, Column]:
    """Give the generated curves by key; points and marks one curve behind the other."""
    found = state.generated
    rows = np.array([row for each in found for row in each.rows], np.int64)
    return {
        "key": [each.key for each in found],
        "what": [each.what for each in found],
        "layout": [each.layout for each in found],
        "attached": np.array([each.attached for each in found], np.int64),
        "count": np.array([len(each.rows) for each in found], np.int64),
        "row": order.row[rows],
        "mark": np.array([m for each in found for m in each.marks], np.float64).reshape(-1, 2),
    }
