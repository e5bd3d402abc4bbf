"""Columns that share what they hold: each keeps what it showed, whatever is written to another."""

from __future__ import annotations

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.graph.journal import Journal
from assoc_hull.graph.table import NumberColumn, Table, ValueColumn, VectorColumn, numbers, values

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
