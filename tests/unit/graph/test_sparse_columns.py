"""Columns of few rows: whatever is written and asked, they answer as a column of all rows does."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.graph.journal import Journal
from assoc_hull.graph.table import MatrixColumn, SparseMatrices, SparseNumbers, SparseVectors

ROWS = 70

ACTS = st.one_of(
    st.tuples(st.sampled_from(["put", "parts", "clear"]), st.integers(0, ROWS - 1)),
    st.tuples(st.just("several"), st.integers(1, ROWS)),
    st.tuples(st.sampled_from(["share", "undo"]), st.just(0)),
    st.tuples(st.just("resize"), st.integers(1, ROWS)),
)


def _same_bits(one: np.ndarray, other: np.ndarray) -> bool:
    return (
        one.dtype == other.dtype and one.shape == other.shape and one.tobytes() == other.tobytes()
    )


@given(acts=st.lists(ACTS, max_size=40))
def test_a_sparse_column_has_the_bits_of_a_dense_one(acts: list[tuple[str, int]]) -> None:
    """Writes, undone writes and changes of length; what was shared stays as it was."""
    sparse = SparseMatrices(np.float64, (2, 3), 0.0)
    dense = MatrixColumn(np.float64, (2, 3), 0.0)
    kept = list[tuple[SparseMatrices[np.float64], np.ndarray]]()
    journals = Journal(), Journal()
    for column in (sparse, dense):
        column.resize(ROWS)
    for number, (act, size) in enumerate(acts, 1):
        rows = np.array([size % len(dense.data)])
        if act == "several":
            rows = np.arange(min(size, len(dense.data)))[::-2]
        value = np.full((len(rows), 2, 3), 0.0 if act == "clear" else float(number))
        value[..., 1] = -0.0  # is not what a new row holds
        if act == "clear":
            value[:] = 0.0
        for column, journal in zip((sparse, dense), journals, strict=True):
            if act == "share":
                continue
            if act == "undo":
                journal.undo()
            elif act == "resize":
                column.resize(size)
                journal.entries.clear()
            elif act == "parts":
                column.put_parts(2 * rows + 1, value[:, 1])
                journal.entries.clear()
            else:
                journal.put(column, rows, value)
        if act == "share":
            kept.append((sparse.share(), dense.data.copy()))
        assert _same_bits(sparse.data, dense.data)
    for column, was in kept:
        assert _same_bits(column.data, was)
    assert _same_bits(pickle.loads(pickle.dumps(sparse)).data, dense.data)


ROW_SETS = {
    "one": 3,
    "of numpy": np.int64(40),
    "from the end": -1,
    "several": np.array([5, 3, 69, 3]),
    "many": np.arange(ROWS)[::-1],
    "pairs": np.array([[3, 4], [5, -1]]),
    "mask": np.arange(ROWS) % 3 == 0,
    "slice": slice(2, 40, 3),
    "list": [3, 5],
    "row and side": (3, 1),
    "several and one side": (np.array([3, 4, 5]), 1),
    "several and their sides": (np.array([3, 4, 5]), np.array([0, 1, 1])),
    "all of one side": (slice(None), 1),
    "mask and side": (np.arange(ROWS) % 3 == 0, 0),
    "new axis": (slice(None), None),
}


@pytest.mark.parametrize("rows", ROW_SETS.values(), ids=ROW_SETS.keys())
@pytest.mark.parametrize("held", [0, 1, 20], ids=["none", "one", "some"])
def test_rows_are_named_in_all_ways_that_arrays_know(rows: Any, held: int) -> None:
    """The same numbers in the same shape, whether any row holds something or not."""
    sparse = SparseMatrices(np.float64, (2, 3), 0.0)
    dense = MatrixColumn(np.float64, (2, 3), 0.0)
    some = 3 + np.arange(held) * 2
    for column in (sparse, dense):
        column.resize(ROWS)
        column.put(some, np.arange(6.0 * held).reshape(held, 2, 3) + 1.0)
    assert _same_bits(np.asarray(sparse[rows]), np.asarray(dense[rows]))


def test_numbers_and_vectors_are_taken_as_such() -> None:
    """A column of numbers gives numbers; its fill value stands in rows that were not written."""
    weight, anchor = SparseNumbers(np.float64, (), 0.0), SparseVectors(np.int64, (2,), -1)
    for column in (weight, anchor):
        column.resize(4)
    weight.put(np.array([2]), np.array([0.5]))
    anchor.put(np.array([1]), np.array([[7, -1]]))
    assert (float(weight[2]), float(weight[0])) == (0.5, 0.0)
    assert weight[np.array([2, 0])].tolist() == [0.5, 0.0]
    assert anchor.data.tolist() == [[-1, -1], [7, -1], [-1, -1], [-1, -1]]
    assert int(anchor[1, 0]) == 7


@pytest.mark.parametrize("row", [4, -5, np.array([0, 4])], ids=["above", "below", "among others"])
def test_a_row_that_is_not_there_is_refused(row: Any) -> None:
    """As numpy does."""
    column = SparseNumbers(np.float64, (), 0.0)
    column.resize(4)
    with pytest.raises(IndexError):
        column[row]


def test_a_column_that_was_written_to_and_back_is_known_to_be_the_same() -> None:
    """So nothing is published anew after an edit that was taken back."""
    column, journal = SparseNumbers(np.float64, (), 0.0), Journal()
    column.resize(4)
    published = column.share()
    assert column.share(published) is published
    journal.put(column, [1], [2.0])
    assert not column.equals(published)
    journal.undo()
    assert column.equals(published)
