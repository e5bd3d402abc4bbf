"""The journal: every write can be taken back and made again, to the last bit."""

from __future__ import annotations

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.graph.journal import Journal, PickedRows
from assoc_hull.graph.table import (
    NumberColumn,
    Table,
    ValueColumn,
    VectorColumn,
    numbers,
    values,
    vectors,
)

Picture = tuple[int, bytes, bytes, tuple[object, ...]]


@attrs.frozen(eq=False)
class Towers(Table):
    """A table with a column of each sort."""

    height: NumberColumn[np.float64] = numbers(np.float64, np.nan)
    place: VectorColumn[np.float64] = vectors(np.float64, 2)
    name: ValueColumn[str] = values("")


def picture(of: Towers) -> Picture:
    """All that a table holds, as bits."""
    return of.count, of.height.data.tobytes(), of.place.data.tobytes(), tuple(of.name.data)


@st.composite
def writes(draw: st.DrawFn) -> list[tuple[str, int, float]]:
    """Give writes of all kinds."""
    kind = st.sampled_from(["grow", "put", "rows", "set"])
    return draw(
        st.lists(st.tuples(kind, st.integers(0, 9), st.floats(allow_nan=True)), max_size=25)
    )


def write(journal: Journal, to: Towers, kind: str, which: int, value: float) -> None:
    """Carry one out."""
    if kind == "grow" or not to.count:
        journal.grow(to, which)
    elif kind == "put":
        journal.put(to.height, [which % to.count], [value])
    elif kind == "rows":
        rows = np.arange(which % to.count, to.count)
        journal.put(to.place, rows, np.full((len(rows), 2), value))
    else:
        journal.set(to.name, [which % to.count], [f"{value}"])


@given(writes())
def test_back_and_forth_are_exact(steps: list[tuple[str, int, float]]) -> None:
    """Any writes, run backward, forward, and backward again; then forgotten."""
    of, journal = Towers(), Journal()
    start = picture(of)
    for step in steps:
        write(journal, of, *step)
    end = picture(of)
    for _ in range(2):
        journal.back()
        assert picture(of) == start
        journal.forth()
        assert picture(of) == end
    journal.undo()
    assert picture(of) == start
    assert journal.entries == []


@given(writes(), writes())
def test_undo_to_a_mark_keeps_what_was_before(
    first: list[tuple[str, int, float]], second: list[tuple[str, int, float]]
) -> None:
    """As a batch that fails in the middle of an update needs it."""
    of, journal = Towers(), Journal()
    for step in first:
        write(journal, of, *step)
    middle, mark = picture(of), len(journal.entries)
    for step in second:
        write(journal, of, *step)
    journal.undo(keep=mark)
    assert picture(of) == middle
    assert len(journal.entries) == mark


@given(writes())
def test_before_gives_what_stood_there_first(steps: list[tuple[str, int, float]]) -> None:
    """Of every row that was written, however often."""
    of, journal = Towers(), Journal()
    of.resize(4)
    of.height.store[:4] = [0.0, 1.0, 2.0, 3.0]
    for step in steps:
        write(journal, of, *step)
    rows, old = journal.before(of.height)
    assert rows.tolist() == sorted(set(rows.tolist()))
    for row, value in zip(rows.tolist(), old.tolist(), strict=True):
        assert np.isnan(value) if row >= 4 else value == row


def test_a_column_cannot_be_written_but_through_a_journal() -> None:
    """What is read is frozen."""
    of = Towers()
    Journal().grow(of, 2)
    with pytest.raises(ValueError, match="read-only"):
        of.height.data[0] = 1.0


def test_new_rows_hold_the_fill_value_even_where_others_were() -> None:
    """A row that is taken back and made anew does not remember."""
    of, journal = Towers(), Journal()
    journal.grow(of, 20)
    journal.put(of.height, [19], [7.0])
    journal.undo()
    journal.grow(of, 20)
    assert np.isnan(of.height.data).all()


def test_growth_keeps_what_is_there() -> None:
    """Past any size of the store."""
    of, journal = Towers(), Journal()
    journal.grow(of, 3)
    journal.put(of.height, [0, 1, 2], [1.0, 2.0, 3.0])
    assert journal.grow(of, 100).tolist() == list(range(3, 103))
    assert of.height.data[:3].tolist() == [1.0, 2.0, 3.0]
    journal.back()
    assert of.count == 0


def test_one_value_may_be_written_to_many_rows() -> None:
    """And none to none."""
    of, journal = Towers(), Journal()
    journal.grow(of, 3)
    journal.put(of.place, [0, 2], 5.0)
    journal.put(of.place, [], [])
    assert of.place.data.tolist() == [[5.0, 5.0], [0.0, 0.0], [5.0, 5.0]]
    assert len(journal.entries) == 2


def test_a_journal_keeps_its_own_copy_of_what_it_wrote() -> None:
    """Whoever wrote it may go on using the array."""
    of, journal = Towers(), Journal()
    journal.grow(of, 1)
    mine = np.array([4.0])
    journal.put(of.height, [0], mine)
    mine[0] = 9.0
    journal.back()
    journal.forth()
    assert of.height.data.tolist() == [4.0]


@given(writes())
def test_writes_are_counted(steps: list[tuple[str, int, float]]) -> None:
    """A column whose count of writes stands has the same bits, undo and redo included."""
    of, journal = Towers(), Journal()
    known: dict[int, bytes] = {}

    def look() -> None:
        assert known.setdefault(of.height.writes, of.height.data.tobytes()) == (
            of.height.data.tobytes()
        )

    for step in steps:
        write(journal, of, *step)
        look()
    journal.back()
    look()
    journal.forth()
    look()
    journal.undo()
    look()


def test_writes_to_parts_are_counted() -> None:
    """Forward, backward and forward again."""
    of, journal = Towers(), Journal()
    journal.grow(of, 2)
    counts = [of.place.writes]
    journal.put_parts(of.place, np.array([0, 3]), PickedRows(np.array([1.0, 2.0])))
    counts.append(of.place.writes)
    journal.back()
    counts.append(of.place.writes)
    journal.forth()
    assert len({*counts, of.place.writes}) == 4
