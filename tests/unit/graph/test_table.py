"""Columns that share what they hold: each keeps what it showed, whatever is written to another."""

from __future__ import annotations

import inspect
import pickle
import sys
from types import FrameType
from typing import Any

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.graph.journal import Journal
from assoc_hull.graph.table import (
    Column,
    NumberColumn,
    Table,
    ValueColumn,
    VectorColumn,
    numbers,
    values,
)

ROWS = 12

ACTS = st.one_of(
    st.tuples(st.sampled_from(["put", "parts", "store"]), st.integers(0, ROWS - 1)),
    st.tuples(st.sampled_from(["share", "view", "drop"]), st.just(0)),
    st.tuples(st.just("grow"), st.integers(1, 30)),
)


@given(acts=st.lists(ACTS, max_size=60))
def test_what_was_shared_or_looked_at_never_changes(acts: list[tuple[str, int]]) -> None:
    """Arrays are used again only when nobody has them: a column, or a view of one alone."""
    column = VectorColumn(np.float64, (2,), 0.0)
    column.resize(ROWS)
    wanted, held, seen = np.zeros((ROWS, 2)), list[object](), list[np.ndarray]()
    for number, (act, row) in enumerate(acts, 1):
        if act == "put":
            column.put(np.array([row]), np.full((1, 2), float(number)))
            wanted[row] = number
        elif act == "parts":
            column.put_parts(np.array([2 * row + 1]), np.array([float(number)]))
            wanted[row, 1] = number
        elif act == "store":
            column.store[row] = number
            column.written()
            wanted[row] = number
        elif act == "grow":
            column.resize(len(wanted) + row)
            wanted = np.concatenate([wanted, np.zeros((row, 2))])
        elif act == "drop":
            del held[:], seen[:]
        else:
            other = column.share()
            held.append(other if act == "share" else other.data[2:])
            seen.append(wanted.copy() if act == "share" else wanted[2:].copy())
            del other
        assert column.data.tolist() == wanted.tolist()
        for kept, as_it_was in zip(held, seen, strict=True):
            content = kept.data if isinstance(kept, VectorColumn) else kept
            assert np.asarray(content).tolist() == as_it_was.tolist()


def test_an_array_that_nobody_has_is_used_again() -> None:
    """Publishing again and again copies the rows that were written, not the column."""
    column = NumberColumn(np.float64, (), 0.0)
    column.resize(ROWS)
    published, stores = column.share(), set[int]()
    for number in range(20):
        column.put(np.array([number % ROWS]), np.array([1.0]))
        stores.add(column.data.ctypes.data)
        published = column.share()
    assert len(stores) <= 3
    assert published.data.tolist() == column.data.tolist()


@attrs.frozen(eq=False)
class Named(Table):
    """A table with a column of each kind."""

    size: NumberColumn[np.float64] = numbers(np.float64)
    name: ValueColumn[str] = values("")


@pytest.mark.parametrize("what", ["size", "name"])
def test_the_number_of_the_last_write_comes_back_when_all_is_taken_back(what: str) -> None:
    """What was derived from a column is true again; after another write it is not."""
    table, journal = Named(), Journal()
    table.resize(3)
    column = table.columns[what]
    before = column.writes
    for _ in range(2):
        if what == "size":
            journal.put(table.size, [1], [2.0])
        else:
            journal.set(table.name, [1], ["b"])
        assert column.writes != before
    journal.undo()
    assert column.writes == before
    assert column.share().writes == before


@pytest.mark.parametrize("what", ["size", "name"])
def test_what_was_shared_is_given_again_until_something_is_written(what: str) -> None:
    """So states that differ in a few columns are the same in all others."""
    table, journal = Named(), Journal()
    table.resize(3)
    column = table.columns[what]
    before = column.share()
    assert column.share(before) is before
    if what == "size":
        journal.put(table.size, [1], [2.0])
    else:
        journal.set(table.name, [1], ["b"])
    after = column.share(before)
    assert after is not before
    assert list(after.data) == list(column.data) != list(before.data)
    assert column.share(after) is after


@pytest.mark.parametrize("what", ["size", "name"])
def test_a_column_equals_what_was_shared_of_it_until_something_is_written(what: str) -> None:
    """And again when all is taken back; what nobody has noted is never taken back."""
    table, journal = Named(), Journal()
    table.resize(3)
    column = table.columns[what]
    before = column.share()
    assert column.equals(before)
    if what == "size":
        journal.put(table.size, [1], [2.0])
    else:
        journal.set(table.name, [1], ["b"])
    assert not column.equals(before)
    journal.undo()
    assert column.equals(before)
    if what == "size":
        table.size.store[1] = 3.0
    else:
        table.name.store[1] = "c"
    assert not column.equals(before)


def test_an_interrupt_at_any_line_leaves_a_column_that_shows_what_is_written() -> None:
    """The array that is written to is the one that is shown, and what was shared stays."""
    lines, first = inspect.getsourcelines(Column._own)
    met = 0
    for line in range(first + 1, first + len(lines)):
        column = NumberColumn(np.float64, (), 0.0)
        column.resize(ROWS)
        for number in range(3):  # so that there is an earlier array to be used again
            held = column.share()
            column.put(np.array([number]), np.array([1.0]))
        held = column.share()
        before = column.data.tolist()

        def broken(frame: FrameType, event: str, _: object, at: int = line) -> Any:
            if event == "line" and frame.f_code is Column._own.__code__ and frame.f_lineno == at:
                raise KeyboardInterrupt
            return broken

        was = sys.gettrace()
        sys.settrace(broken)
        try:
            column.put(np.array([5]), np.array([2.0]))
        except KeyboardInterrupt:
            met += 1
        finally:
            sys.settrace(was)
        column.put(np.array([5]), np.array([3.0]))
        assert held.data.tolist() == before, line
        before[5] = 3.0
        assert column.data.tolist() == before, line
        assert column.share().data.tolist() == before, line
    assert met > 5


def test_a_table_from_elsewhere_has_numbers_of_writes_of_its_own() -> None:
    """Those of another process stand for other content here."""
    table = Named()
    table.resize(2)
    table.size.put(np.array([1]), np.array([4.0]))
    again = pickle.loads(pickle.dumps(table))
    assert again.size.data.tolist() == [0.0, 4.0]
    assert {each.writes for each in again.columns.values()}.isdisjoint(table.stamps().values())
    again.size.put(np.array([0]), np.array([5.0]))
    assert again.size.data.tolist() == [5.0, 4.0]
