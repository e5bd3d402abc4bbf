"""Columns that share what they hold: each keeps what it showed, whatever is written to another."""

from __future__ import annotations

import inspect
import pickle
import sys
import tracemalloc
from types import FrameType
from typing import Any

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.graph.journal import Journal, PickedRows
from assoc_hull.graph.table import (
    BLOCK,
    Column,
    NumberColumn,
    Table,
    ValueColumn,
    VectorColumn,
    numbers,
    values,
    vectors,
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
class Mixed(Table):
    """A table of more than one block of rows, with a column of each kind."""

    size: NumberColumn[np.float64] = numbers(np.float64)
    place: VectorColumn[np.float64] = vectors(np.float64, 2)
    few: NumberColumn[np.float64] = numbers(np.float64, np.nan, sparse=True)
    name: ValueColumn[str] = values("")


MANY = 3 * BLOCK + 5
JOURNALLED = st.one_of(
    st.tuples(st.sampled_from(["size", "place", "parts", "few", "name"]), st.integers(0, MANY - 1)),
    st.tuples(st.sampled_from(["share", "drop", "mark", "undo", "publish"]), st.just(0)),
    st.tuples(st.just("grow"), st.integers(1, 3)),
)


def _held_content(table: Mixed) -> dict[str, list[object]]:
    return {name: np.asarray(each.data).tolist() for name, each in table.columns.items()}


@given(acts=st.lists(JOURNALLED, max_size=40))
def test_what_is_taken_back_is_what_it_was_whoever_shares_it(acts: list[tuple[str, int]]) -> None:
    """Arrays change places in place of copies: contents, numbers of writes and notes stay true."""
    table, journal, marks = Mixed(), Journal(), [(0, 0)]
    journal.grow(table, MANY)
    marks = [(1, table.count)]
    held, published = list[tuple[Mixed, dict[str, list[object]]]](), table.share()
    known = dict[int, list[object]]()
    contents = [_held_content(table)]
    for number, (act, row) in enumerate(acts, 1):
        if act == "size" or act == "few":
            journal.put(table.columns[act], [row], [float(number)])  # type: ignore[arg-type]
        elif act == "place":
            journal.put(table.place, [row], [[float(number), 0.5]])
        elif act == "parts":
            put = PickedRows(np.array([float(number)]))
            journal.put_parts(table.place, np.array([2 * row + 1]), put)
        elif act == "name":
            journal.set(table.name, [row], [f"{number}"])
        elif act == "grow":
            journal.grow(table, row)
        elif act == "mark":
            marks.append((len(journal.entries), table.count))
            contents.append(_held_content(table))
        elif act == "undo":
            journal.undo(keep=marks.pop()[0] if len(marks) > 1 else 1)
            back = contents.pop() if len(contents) > 1 else contents[0]
            assert str(_held_content(table)) == str(back)
        elif act == "share":
            held.append((table.share(), _held_content(table)))
        elif act == "publish":
            published = table.share(published)
            assert str(_held_content(published)) == str(_held_content(table))
        else:
            held.clear()
        now = _held_content(table)
        for name, column in table.columns.items():
            assert str(known.setdefault(column.writes, now[name])) == str(now[name])
        for other, as_it_was in held:
            assert str(_held_content(other)) == str(as_it_was)
            if other.count == table.count:
                for name in ("size", "place", "few"):
                    mine, theirs = table.columns[name], other.columns[name]
                    pairs = zip(now[name], as_it_was[name], strict=True)
                    odd = np.array([str(a) != str(b) for a, b in pairs])
                    assert np.isin(np.flatnonzero(odd), mine.differing(theirs)).all()  # type: ignore[union-attr,arg-type]


def test_what_is_tried_and_taken_back_is_not_copied() -> None:
    """As by a preview, whose result shares the tables: the array of before comes back."""
    table, journal = Mixed(), Journal()
    journal.grow(table, MANY)
    published = table.share()
    for _ in range(3):
        before = table.size.data.ctypes.data, id(table.name.data)
        journal.put(table.size, [3], [1.0])
        journal.set(table.name, [3], ["tried"])
        result = table.share()
        journal.undo(keep=1)
        assert (table.size.data.ctypes.data, id(table.name.data)) == before
        assert table.share(published) is published
        assert result.size[3] == 1.0
        assert result.name[3] == "tried"


@pytest.mark.parametrize("what", ["size", "name", "few"])
def test_an_interrupt_at_any_line_of_a_write_or_of_taking_it_back_is_taken_back_once_more(
    what: str,
) -> None:
    """What was broken off is undone again, and then all is as it was, whoever shares it."""
    met, line = 0, 0
    traced = ("table.py", "journal.py")
    while True:
        table, journal = Mixed(), Journal()
        journal.grow(table, 8)
        held = [table.share()]
        for number in range(2):
            journal.put(table.size, [number], [1.0])
            journal.put(table.few, [number], [1.0])
            journal.set(table.name, [number], ["a"])
            held.append(table.share())
        before, keep, seen = _held_content(table), len(journal.entries), 0

        def broken(frame: FrameType, event: str, _: object, at: int = line) -> Any:
            nonlocal seen
            if not frame.f_code.co_filename.endswith(traced):
                return None
            if event == "line":
                seen += 1
                if seen == at + 1:
                    raise KeyboardInterrupt
            return broken

        was = sys.gettrace()
        sys.settrace(broken)
        try:
            if what == "name":
                journal.set(table.name, [1], ["b"])
                journal.set(table.name, [2], ["c"])
            else:
                journal.put(table.columns[what], [1], [2.0])  # type: ignore[arg-type]
                journal.put(table.columns[what], [2], [3.0])  # type: ignore[arg-type]
            journal.undo(keep=keep)
        except KeyboardInterrupt:
            met += 1
        finally:
            sys.settrace(was)
        whole = seen <= line
        journal.undo(keep=keep)
        assert str(_held_content(table)) == str(before), line
        assert str(_held_content(held[-1])) == str(before), line
        journal.put(table.size, [5], [9.0])
        journal.set(table.name, [5], ["z"])
        assert table.size[5] == 9.0
        assert str(_held_content(held[-1])) == str(before), line
        if whole:
            break
        line += 1
    assert met > 20


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


def test_a_write_after_sharing_takes_no_memory_of_the_size_of_the_column() -> None:
    """The array of before is taken again; a copy may come to lie at its address: bytes tell."""
    column = VectorColumn(np.float64, (3,), 0.0)
    column.resize(50_000)
    rows, published = np.arange(5), column.share()
    for _ in range(3):
        column.put(rows, np.ones((5, 3)))
        published = column.share()
    tracemalloc.start()
    for _ in range(5):
        column.put(rows, np.full((5, 3), 2.0))
        published = column.share()
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most < column.data.nbytes / 10
    assert published.data.tobytes() == column.data.tobytes()
