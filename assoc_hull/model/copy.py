"""A copy of a hull's tables, which can be changed without the hull.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.model.copy import copy_of
>>> from assoc_hull.model.definition.definition import fingerprint
>>> state = wigley()
>>> fingerprint(copy_of(state)) == fingerprint(state)
True
"""

from __future__ import annotations

from assoc_hull.graph.table import ArrayColumn, ListColumn, Table
from assoc_hull.model.change import TABLES
from assoc_hull.model.state import HullState

__all__ = ["copy_of", "put_back"]


def copy_of(state: HullState) -> HullState:
    """Copy the tables of a hull; row numbers stay, values that never change are shared."""
    found = HullState(state.particulars, state.tolerances)
    put_back(found, state)
    return found


def put_back(found: HullState, state: HullState) -> None:
    """Give tables the content of a copy; they stay the same objects, so handles on them hold."""
    for name in TABLES:
        _copy(getattr(state, name), getattr(found, name))
    found.settings.births.data[0] = dict(state.births)
    found.revision_row, found.revision_curve = dict(state.revision_row), dict(state.revision_curve)


def _copy(given: Table, found: Table) -> None:
    found.resize(given.count)
    for name, column in given.columns.items():
        other = found.columns[name]
        if isinstance(column, ArrayColumn) and isinstance(other, ArrayColumn):
            other.store[: given.count] = column.data
            other.writes += 1
        elif isinstance(column, ListColumn):
            other.data[:] = column.data
