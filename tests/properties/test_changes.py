"""A change keeps what an edit did: run backward and forward it gives every bit of the tables."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.table import Column
from assoc_hull.model.change import apply_change, change_of
from assoc_hull.model.definition.fingerprint import FingerprintCache, fingerprint, is_shape
from assoc_hull.model.tables import TABLES, HullState
from tests.net_strategies import POOL, SHAPES, STRUCTURE, Task, carry_out, fresh, tasks


def picture(state: HullState) -> dict[str, object]:
    """Take down every bit of every column, splines and meetings by what they hold."""
    found: dict[str, object] = {}
    for table in TABLES:
        for name, column in getattr(state, table).columns.items():
            if isinstance(column, Column):
                found[f"{table}.{name}"] = column.data.tobytes()
            else:
                found[f"{table}.{name}"] = [
                    _plain(state, table, name, x, i) for i, x in enumerate(column.data)
                ]
    return found


def _plain(state: HullState, table: str, name: str, value: object, row: int) -> object:
    if isinstance(value, np.ndarray):
        return value.tolist()
    if name == "spline":
        if value is None or not state.curves.alive[row]:
            return None  # nothing reads the spline of a curve that has gone
        return [getattr(value, each).tobytes() for each in ("knot", "xyz", "leave", "arrive")]
    if name == "meets":
        return [
            getattr(value, each).tobytes() for each in ("line", "sign", "row", "parameter", "xyz")
        ]
    return value


@settings(max_examples=30)
@given(st.integers(0, POOL - 1), tasks((*SHAPES, *STRUCTURE), most=5))
def test_a_change_runs_both_ways_to_the_last_bit(which: int, todo: list[Task]) -> None:
    """Every edit of a session, taken back and made again by its change, leaves the same tables."""
    hull = fresh(which)
    pictures, changes = [picture(hull.document.state)], []
    for task in todo:
        count = len(hull.history)
        carry_out(hull, task)
        if len(hull.history) > count:
            journal = hull.document.history[-1].journal
            assert isinstance(journal, Journal)
            changes.append(change_of(hull.document.state, journal))
            pictures.append(picture(hull.document.state))
    prints = [fingerprint(hull.document.state)]
    for _ in range(2):
        for i in range(len(changes) - 1, -1, -1):
            apply_change(hull.document.state, changes[i], forward=False)
            compare(hull, pictures[i])
        for i, change in enumerate(changes, start=1):
            apply_change(hull.document.state, change, forward=True)
            compare(hull, pictures[i])
    prints.append(fingerprint(hull.document.state))
    assert prints[0] == prints[1]


def compare(hull: ah.Hull, then: dict[str, object]) -> None:
    """Compare column by column."""
    now = picture(hull.document.state)
    assert [name for name in then if now[name] != then[name]] == []


@settings(max_examples=30)
@given(st.integers(0, POOL - 1), tasks((*SHAPES, *STRUCTURE), most=5))
def test_a_printer_takes_the_fingerprint_while_the_structure_stays(
    which: int, todo: list[Task]
) -> None:
    """Made anew where a change is not one of shape only, it never differs from the slow way."""
    hull = fresh(which)
    printer = FingerprintCache(hull.document.state)
    for task in todo:
        if carry_out(hull, task) is None:
            continue
        journal = hull.document.history[-1].journal
        assert isinstance(journal, Journal)
        if not is_shape(change_of(hull.document.state, journal)):
            printer = FingerprintCache(hull.document.state)
        assert printer.take() == fingerprint(hull.document.state)
