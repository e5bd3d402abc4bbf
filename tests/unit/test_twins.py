"""Twins of hulls, which tests of several processes share."""

from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.graph.table import Column, SparseColumn
from tests.twins import made_once, packed, twin

POINT = "WL 2.5 x ST 3"


def small() -> ah.Hull:
    """A net that is quickly made."""
    return ah.examples.wigley(stations=7, waterlines=6)


def test_a_twin_is_a_hull_of_its_own() -> None:
    """It has the same bits, takes the same edits, and leaves the other alone."""
    hull = small()
    other: ah.Hull = twin(packed(hull))
    assert other.fingerprint == hull.fingerprint
    assert other.adoption == hull.adoption
    with other.edit("move") as edit:
        edit.move(POINT, y=other.points[POINT].y + 0.01)
    assert other.check() == ()
    assert other.verify() == ()
    assert other.fingerprint != hull.fingerprint
    with hull.edit("move") as edit:
        edit.move(POINT, y=hull.points[POINT].y + 0.01)
    assert other.fingerprint == hull.fingerprint
    other.undo()
    assert other.fingerprint == twin(packed(small())).fingerprint


def test_what_was_read_only_is_so_still() -> None:
    """Columns in use and splines; and a column shows what stands in its store."""
    state = twin(packed(small())).state
    for column in state.rows.columns.values():
        if isinstance(column, Column):
            assert not column.data.flags.writeable
            sparse = isinstance(column, SparseColumn)  # makes what it shows when it is asked
            assert sparse or np.shares_memory(column.data, column._store)
    for curve in state.live("curves").tolist():
        assert not state.spline(curve).xyz.flags.writeable
        assert not state.curves.rows[curve].flags.writeable


def test_a_history_is_not_lost_unseen() -> None:
    """A hull that was edited is not packed."""
    hull = small()
    with hull.edit("move") as edit:
        edit.move(POINT, y=hull.points[POINT].y + 0.01)
    with pytest.raises(AssertionError, match="history"):
        packed(hull)


def test_the_second_process_does_not_make_it_again(
    tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """It loads what the first one made."""
    monkeypatch.setenv("PYTEST_XDIST_WORKER", "gw0")
    monkeypatch.setattr(tmp_path_factory, "getbasetemp", lambda: tmp_path / "popen-gw0")
    made = list[ah.Hull]()

    def make() -> ah.Hull:
        made.append(small())
        return made[-1]

    first, second = (made_once(tmp_path_factory, "small", make) for _ in range(2))
    assert made == [first]
    assert second is not first
    assert second.fingerprint == first.fingerprint
