"""Published states: once read they stay, and nobody but an edit itself sees what it writes.

Readers are other threads, previews and drags beside them, and the edit's own body, which reads the
hull as it was published.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any

import attrs
import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.errors import AssocHullError, HullBusyError
from assoc_hull.graph.table import (
    NumberColumn,
    Table,
    ValueColumn,
    VectorColumn,
    numbers,
    values,
    vectors,
)
from assoc_hull.model.definition.fingerprint import fingerprint
from assoc_hull.model.tables import HullState, copy_state
from tests.conftest import Shipped
from tests.long_forms import LONG, draws
from tests.net_strategies import POOL, SHAPES, STRUCTURE, Task, carry_out, fresh, tasks

tasks_of_all_kinds = tasks(SHAPES + STRUCTURE)


def content(state: HullState) -> tuple[object, ...]:
    """Every bit of the tables; of lists the texts, or the very objects."""
    tables = state.rows, state.curves, state.lines, state.groups, state.settings
    columns = [
        each.data.tobytes()
        if isinstance(each.data, np.ndarray)
        else [x if isinstance(x, str) else id(x) for x in each.data]
        for table in tables
        for each in table.columns.values()
    ]
    return columns, dict(state.revision_row), dict(state.revision_curve)


@settings(max_examples=draws(20), deadline=None)
@given(number=st.integers(0, POOL - 1), edits=tasks_of_all_kinds, back=st.integers(0, 3))
def test_a_state_that_was_read_stays_whatever_is_done_later(
    number: int, edits: list[Task], back: int
) -> None:
    """To the bit, with all that is asked of it; so do snapshots, which are hulls of their own."""
    hull = fresh(number)
    kept = [(hull.state, hull.snapshot(), content(hull.state), hull.fingerprint)]
    for each in edits:
        carry_out(hull, each)
        kept.append((hull.state, hull.snapshot(), content(hull.state), hull.fingerprint))
    hull.undo(min(back, len(hull.history))) if back and hull.history else None
    for state, snapshot, bits, mark in kept:
        assert content(state) == bits
        assert fingerprint(state) == mark == snapshot.fingerprint
    assert content(hull.state) == content(hull.document.state)


@settings(max_examples=draws(12), deadline=None)
@given(number=st.integers(0, POOL - 1), edits=tasks_of_all_kinds)
def test_an_edit_of_a_snapshot_and_one_of_its_hull_do_not_meet(
    number: int, edits: list[Task]
) -> None:
    """Whichever is written to first."""
    hull = fresh(number)
    snapshot = hull.snapshot()
    before = content(hull.state)
    for each in edits:
        carry_out(snapshot, each)
    assert content(hull.state) == before
    assert hull.verify() == ()
    theirs = content(snapshot.state), snapshot.fingerprint
    for each in edits:
        carry_out(hull, each)
    assert (content(snapshot.state), snapshot.fingerprint) == theirs
    assert snapshot.fingerprint == hull.fingerprint


@attrs.frozen(eq=False)
class Towers(Table):
    """A column of each kind."""

    height: NumberColumn[np.int64] = numbers(np.int64)
    place: VectorColumn[np.int64] = vectors(np.int64, 2)
    name: ValueColumn[str] = values("")


WRITES = ("number", "vector", "value", "resize", "share")


@example([("resize", 0, 9), ("number", 0, 8), ("share", 0, 0), ("resize", 0, 4), ("resize", 0, 9)])
@example([("resize", 0, 9), ("share", 0, 0), ("number", 1, 1), ("share", 1, 0)])
@given(st.lists(st.tuples(st.sampled_from(WRITES), st.integers(0, 99), st.integers(0, 24))))
def test_tables_that_share_columns_hold_what_was_written_to_each(
    acts: list[tuple[str, int, int]],
) -> None:
    """As lists of their own would, whichever of them grows, shrinks or is written to first."""
    tables, wanted = [Towers()], [list[tuple[int, int, str]]()]
    by_stamp = dict[int, list[int]]()
    for turn, (act, which, amount) in enumerate(acts, 1):
        table, rows = tables[which % len(tables)], wanted[which % len(tables)]
        if act == "share":
            tables.append(table.share())
            wanted.append(rows.copy())
        elif act == "resize":
            table.resize(amount)
            rows[:] = (rows + [(0, 0, "")] * amount)[:amount]
        elif rows:
            row = amount % len(rows)
            number, vector, value = rows[row]
            if act == "number":
                table.height.store[row] = number = turn
                table.height.written()
            elif act == "vector":
                table.place.store[row, 1] = vector = turn
            else:
                table.name.store[row] = value = str(turn)
            rows[row] = number, vector, value
        for each, known in zip(tables, wanted, strict=True):
            assert each.count == len(known)
            assert each.height.data.tolist() == [number for number, _, _ in known]
            # What was derived from one of them is true of all that have the stamp.
            stamp = each.height.writes
            assert (
                by_stamp.setdefault(stamp, each.height.data.tolist()) == each.height.data.tolist()
            )
            assert each.place.data.tolist() == [[0, vector] for _, vector, _ in known]
            assert each.name.data == [value for _, _, value in known]


def test_inside_an_edit_the_hull_reads_as_published() -> None:
    """What the edit has made answers, and is seen by nobody else; a refusal leaves no trace."""
    hull = ah.examples.wigley()
    before, count = content(hull.state), len(hull.points)
    made = list[ah.Point]()
    with pytest.raises(AssocHullError):
        insert_and_fail(hull, made, before, count)
    assert not made[0].alive
    assert content(hull.state) == before == content(hull.document.state)


def insert_and_fail(hull: ah.Hull, made: list[ah.Point], before: object, count: int) -> None:
    """Insert a point, look at what is seen of it, and ask for what is refused."""
    with hull.edit("failing") as edit:
        point = edit.insert("ST 7", (35.0, 2.2, 1.3), lead=False)
        made.append(point)
        assert point.alive
        assert point.x == 35.0
        assert point.container_curve.name == "ST 7"
        assert len(hull.points) == count
        assert content(hull.state) == before
        seen = list[bool]()
        thread = threading.Thread(target=lambda: seen.append(point.alive))
        thread.start()
        thread.join()
        assert seen == [False]
        edit.move("WL 2.5 x ST 7", y=1e9)


def test_points_written_without_an_edit_are_published_and_leave_earlier_states_alone() -> None:
    """The number of the state stays then, so the columns tell whether anything was written."""
    state = copy_state(ah.examples.wigley().state)
    before, row = state.published(), int(state.live("rows")[5])
    assert state.published() is before
    place = before.rows.xyz[row].copy()
    state.rows.xyz.put(np.array([row]), place[None] + 1.0)
    assert state.published().rows.xyz[row].tolist() == (place + 1.0).tolist()
    assert before.rows.xyz[row].tolist() == place.tolist()


def test_an_edit_of_nothing_but_the_name_is_published() -> None:
    """It lies in the settings, and in no other table; undo brings the old one back."""
    hull = ah.examples.wigley()
    before, read = hull.particulars.name, hull.state
    with hull.edit("name") as edit:
        edit.rename(hull, "Thetis")
    assert (hull.particulars.name, read.particulars.name) == ("Thetis", before)
    hull.undo()
    assert hull.particulars.name == before


def test_what_an_edit_has_deleted_is_not_given_to_it_again() -> None:
    """A handle that the published hull still knows is one on nothing in this edit."""
    hull = ah.examples.wigley()
    with hull.edit("insert") as edit:
        point = edit.insert("ST 7", (35.0, 2.2, 1.3), lead=False)
    with hull.edit("delete") as edit:
        edit.delete(point)
        assert point.alive
        with pytest.raises(ah.errors.ForeignPointError):
            edit.pin(point)
    assert not point.alive


# --------------------------------------------------------------------------------------
# Threads.


def _readings(hull: ah.Hull, point: str) -> dict[str, Callable[[], object]]:
    """What readers ask for: each gives something that is known of every committed state."""

    def of_snapshot() -> object:
        snapshot = hull.snapshot()
        return snapshot.fingerprint, snapshot.points[point].y

    def tried() -> None:
        hull.preview([{"op": "move", "point": point, "y": -1e3}], measure=False)

    return {
        "fingerprint": lambda: hull.fingerprint,
        "point": lambda: hull.points[point].y,
        "curve": lambda: hull.points[point].container_curve.spline.xyz.tobytes(),
        "snapshot": of_snapshot,
        "hydrostatics": lambda: hull.hydrostatics(draught=hull.particulars.draught).volume,
        "check": hull.check,
        "preview": tried,
        "again": lambda: hull.fingerprint,
    }


_READ_AT_ONCE: dict[str, tuple[Callable[[ah.Hull], Any], Callable[[Any], object]]] = {
    "lines": (lambda hull: hull, lambda hull: dict(hull.lines)),
    "crossings": (lambda hull: hull, lambda hull: dict(hull.crossings)),
    "groups": (lambda hull: hull, lambda hull: dict(hull.groups)),
    "points": (lambda hull: hull.points, lambda points: dict(points.items())),
    "group": (lambda hull: hull.groups["waterlines"], lambda group: dict(group.lines)),
    "line": (lambda hull: hull.lines["ST 7"], lambda line: line.points),
    "curve": (lambda hull: hull.lines["ST 7"].curves[0], lambda curve: curve.points),
    "reach": (lambda hull: hull.lines["ST 7"].curves[0], lambda curve: curve.touch_objects),
    "crossing": (lambda hull: hull.crossings["WL 1.111 x ST 7"], lambda met: met.b),
    "driver": (lambda hull: hull.points["WL 1.111 x ST 7"], lambda point: point.driver),
    "place": (lambda hull: hull.points["WL 1.111 x ST 7"], lambda point: tuple(point.position)),
}
"""By name: what is looked up first, and what is read of it."""


@pytest.mark.parametrize("what", _READ_AT_ONCE)
def test_one_reading_is_of_one_state(what: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever another thread commits as soon as the reading has begun."""
    hull = ah.examples.wigley()
    with hull.edit("one more") as edit:
        edit.add_line("waterlines", 1.111)
    find, read = _READ_AT_ONCE[what]
    thing, published, begun = find(hull), HullState.published, list[HullState]()
    known = read(thing)

    def overtaken(state: HullState) -> HullState:
        found = published(state)
        if state is hull.document.state and not begun:
            begun.append(found)
            hull.undo()
        return found

    monkeypatch.setattr(HullState, "published", overtaken)
    assert read(thing) == known
    assert begun


@pytest.mark.parametrize("name", ["wigley", *(["series60_70"] if LONG else [])])
def test_readers_in_other_threads_see_committed_states_only(name: str, shipped: Shipped) -> None:
    """Eight of them beside one writer, which edits and takes back; 60 s in the long form."""
    hull = shipped(name)
    point = next(each for each, found in hull.points.items() if "y" in found.free and found.y > 1.0)
    ask, seconds = _readings(hull, point), 60.0 if LONG else 3.0
    seen: dict[str, set[object]] = {each: set() for each in ask}
    raised, over = list[BaseException](), threading.Event()

    def read(each: str) -> None:
        while not over.is_set():
            try:
                seen[each].add(ask[each]())
            except HullBusyError:
                assert each == "preview"
            except BaseException as error:
                raised.append(error)
                over.set()

    known: dict[str, set[object]] = {each: set() for each in ask}

    def commit() -> None:
        for each in set(ask) - {"preview"}:
            known[each].add(ask[each]())

    commit()
    threads = [threading.Thread(target=read, args=(each,)) for each in ask]
    for thread in threads:
        thread.start()
    start, end, step = hull.points[point].y, time.monotonic() + seconds, 0
    try:
        while (time.monotonic() < end or step < 5) and not over.is_set():
            step += 1
            if step % 4 == 0:
                hull.undo()
            else:
                with hull.edit("move", wait=60.0) as edit:
                    edit.move(point, y=start - 1e-3 * (step % 7))
            commit()
    finally:
        over.set()
        for thread in threads:
            thread.join()
    assert not raised
    for each in set(ask) - {"preview"}:
        assert seen[each] <= known[each], each
    assert hull.verify() == ()
