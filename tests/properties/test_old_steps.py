"""Steps of a hull in memory that are old hold little, and run and tell as they did when new.

The same edits are made on two hulls: one lets steps be old at once, the other never.
"""

from __future__ import annotations

import contextlib
import copy
import gc
import pickle
import sqlite3
import sys
import threading
import tracemalloc
from collections.abc import Callable, Iterator
from pathlib import Path
from types import FrameType
from typing import Any
from unittest import mock

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.edit import document as documents
from assoc_hull.edit import past_states, program_edit
from assoc_hull.edit.past_states import PackedWrites
from assoc_hull.edit.step import Step, StepBody
from assoc_hull.graph import derived
from assoc_hull.graph.journal import Journal
from assoc_hull.model import change as changes
from assoc_hull.model.packed_change import with_strays
from tests.long_forms import draws
from tests.net_strategies import POOL, SHAPES, STRUCTURE, Task, carry_out, fresh, tasks
from tests.properties.test_program_edits import Count, by_program, content


@contextlib.contextmanager
def old_after(count: int, program: Count | None = None) -> Iterator[None]:
    """Let so many steps be held in full, and every edit that can be take the program."""
    with (
        by_program(program or Count(), always=True),
        mock.patch.object(documents, "_HELD_IN_MEMORY", count),
    ):
        yield


NEVER = 10**9


def is_old(step: Step) -> bool:
    """Whether a step holds what it wrote packed."""
    return isinstance(step.journal, PackedWrites)


def tables(hull: ah.Hull) -> dict[str, object]:
    """All numbers of the tables."""
    return {name: value for name, value in content(hull).items() if name != "history"}


def told(hull: ah.Hull) -> list[tuple[object, ...]]:
    """What all steps say of themselves, those of other branches as well."""
    return [
        (
            number, step.name, step.structural, step.parent, step.author,
            attrs.evolve(step.report, seconds={}, time="", fairness=None), step.report.inflections,
            *((each.dtype, each.tobytes()) for each in (
                step.changed, step.moved, step.seeds, step.cause.reader, step.cause.source,
                step.rows, step.curves, step.forms,
            )),
        )
        for number, step in hull.document.steps.items()
    ]  # fmt: skip


def edited(number: int, edits: list[Task], back: int, held: int) -> ah.Hull:
    """A net after edits; some are undone on the way, so that they are left on a branch."""
    hull = fresh(number)
    with old_after(held):
        for each in edits:
            carry_out(hull, each)
        hull.undo(min(back, len(hull.history))) if hull.history and back else None
        for each in edits[::-1]:
            carry_out(hull, each)
    return hull


@settings(max_examples=draws(12), deadline=None)
@given(number=st.integers(0, POOL - 1), edits=tasks(SHAPES + STRUCTURE), back=st.integers(0, 2))
def test_old_steps_run_and_tell_as_new_ones(number: int, edits: list[Task], back: int) -> None:
    """Causes, reports and inflections read late, undo and redo of each and all: the same bits."""
    one, other = (edited(number, edits, back, held) for held in (1, NEVER))
    assert not any(map(is_old, other.document.steps.values()))
    assert all(map(is_old, list(one.document.steps.values())[:-1]))
    assert told(one) == told(other)
    count = len(one.history)
    for hull in (one, other):
        hull.undo(count) if count else None
    assert tables(one) == tables(other)
    for _ in range(count):
        for hull in (one, other):
            hull.redo()
        assert one.fingerprint == other.fingerprint
    for hull in (one, other):
        hull.undo(count) if count else None
        hull.redo(count) if count else None
    assert tables(one) == tables(other)
    assert one.verify() == ()


@settings(max_examples=draws(12), deadline=None)
@given(number=st.integers(0, POOL - 1), edits=tasks(SHAPES))
def test_what_the_numbers_tell_of_an_edit_is_what_was_written(
    number: int, edits: list[Task]
) -> None:
    """The change that runs of the program give is the one that its writes to the tables give."""
    hull = fresh(number)
    with old_after(NEVER):
        for each in edits:
            count = len(hull.history)
            carry_out(hull, each)
            if len(hull.history) == count:
                continue
            step, tables = hull.document.history[-1], hull.document.state
            assert step.change is not None
            assert isinstance(step.journal, Journal)
            found = with_strays(tables, step.change)
            expected = changes.change_of(tables, step.journal)
            assert list(found.bits) == list(expected.bits)
            for mine, written in zip(
                [*found.bits.values(), found.moved, found.met],
                [*expected.bits.values(), expected.moved, expected.met], strict=True,
            ):  # fmt: skip
                assert mine[0].tolist() == written[0].tolist()
                assert mine[1].tobytes() == written[1].tobytes()
            assert found.lofted.tolist() == expected.lofted.tolist()


@settings(max_examples=6, deadline=None)
@given(number=st.integers(0, POOL - 1), edits=tasks(SHAPES + STRUCTURE))
def test_old_steps_are_saved_and_copied_as_new_ones(
    number: int, edits: list[Task], tmp_path_factory: pytest.TempPathFactory
) -> None:
    """A hull file has the same rows, and a copy of the hull tells the same."""
    one, other = (edited(number, edits, 1, held) for held in (1, NEVER))
    expected = told(other)
    assert told(pickle.loads(pickle.dumps(one))) == expected
    assert told(copy.deepcopy(one)) == expected
    folder = tmp_path_factory.mktemp("saved")
    rows = [_saved(hull, folder / f"{i}.hull") for i, hull in enumerate((one, other))]
    assert rows[0] == rows[1]
    assert told(one) == expected
    for hull in (one, other):
        hull.close()


def _saved(hull: ah.Hull, path: Path) -> list[tuple[object, ...]]:
    """The rows of the steps; not when they were made, and how long that took."""
    hull.save(path)
    with contextlib.closing(sqlite3.connect(path)) as database:
        found = database.execute(
            "SELECT number, parent, name, structural, fingerprint, script, trace, change "
            "FROM steps ORDER BY number"
        )
        return list(found.fetchall())


def _points(hull: ah.Hull, count: int) -> list[str]:
    """Some points amidships that can be moved without a change of structure."""
    middle = 0.5 * hull.particulars.length
    free = [
        key for key, point in hull.points.items()
        if point.free == ("y",) and abs(point.x - middle) < 0.25 * middle and point.y > 0.0
    ]  # fmt: skip
    return free[:: len(free) // count][:count]


def _move(hull: ah.Hull, points: list[str], number: int) -> None:
    point = points[number % len(points)]
    with contextlib.suppress(ah.errors.AssocHullError), hull.edit("move") as edit:
        edit.move(point, y=hull.points[point].y + 1e-4 * (-1) ** (number // len(points)))


@pytest.mark.parametrize("program", [True, False], ids=["by the program", "the full way"])
def test_a_session_grows_by_a_few_kilobytes_with_each_edit(program: bool) -> None:
    """The history of a session in memory holds what an undo needs, and no states of the hull."""
    hull, held = ah.examples.series60(), list[tuple[int, int]]()
    points = _points(hull, 7)
    tracemalloc.start()
    try:
        with by_program(Count(), always=program):
            for number in range(240):
                _move(hull, points, number)
                if number + 1 in (80, 240):
                    gc.collect()
                    held.append((len(hull.history), tracemalloc.get_traced_memory()[0]))
    finally:
        tracemalloc.stop()
    (few, before), (many, after) = held
    assert many - few > 60
    assert (after - before) / (many - few) < 16e3
    assert hull.verify() == ()


def test_an_undo_of_old_steps_that_is_broken_off_leaves_the_hull_as_it_was() -> None:
    """At whatever step it breaks: what lies packed cannot be run from the middle."""
    hull = ah.examples.wigley()
    points = _points(hull, 3)
    with old_after(2):
        for number in range(12):
            _move(hull, points, number)
    before, count = hull.fingerprint, len(hull.history)
    shape = changes.shape_curves
    for allowed in range(3):
        left = [allowed]

        def broken(*given: object, left: list[int] = left) -> None:
            if not left[0]:
                raise KeyboardInterrupt
            left[0] -= 1
            shape(*given)  # type: ignore[arg-type]

        for back in (count, 3, count):
            left[0] = min(allowed, left[0])
            with (
                mock.patch.object(changes, "shape_curves", broken),
                contextlib.suppress(KeyboardInterrupt),
            ):
                hull.undo(back)
            if len(hull.history) < count:
                hull.redo(count - len(hull.history))
            assert (hull.fingerprint, len(hull.history)) == (before, count)
            assert hull.verify() == ()


def test_old_steps_are_told_while_another_thread_edits() -> None:
    """Readers see a step as it was, whatever is written, undone and made old meanwhile."""
    hull, other = ah.examples.wigley(), ah.examples.wigley()
    points, failed = _points(hull, 5), list[BaseException]()
    with old_after(NEVER):
        for number in range(60):
            _move(other, points, number)
    expected = {row[0]: row for row in told(other)}
    with old_after(3):
        for number in range(20):
            _move(hull, points, number)

        def read() -> None:
            try:
                for each in np.random.default_rng(3).integers(1, 16, 40).tolist():
                    step = hull.document.steps[each]
                    assert step.report.inflections == expected[each][6]
                    assert step.changed.tobytes() == expected[each][7][1]  # type: ignore[index]
            except BaseException as error:
                failed.append(error)

        readers = [threading.Thread(target=read) for _ in range(2)]
        for each in readers:
            each.start()
        for number in range(20, 60):
            _move(hull, points, number)
            if number % 7 == 0:
                hull.undo(5)
                hull.redo(5)
        for each in readers:
            each.join()
    assert not failed
    assert told(hull) == told(other)


def test_old_steps_on_a_branch_are_old_as_well() -> None:
    """Edit, undo, edit, undo: what is left behind does not stay in full."""
    hull = ah.examples.wigley()
    points = _points(hull, 3)
    with old_after(4):
        for number in range(20):
            _move(hull, points, number)
            hull.undo()
    steps = list(hull.document.steps.values())
    assert all(map(is_old, steps[:-4]))
    assert not any(map(is_old, steps[-4:]))


def test_a_hull_that_is_saved_and_detached_runs_and_tells_all_its_steps(tmp_path: Path) -> None:
    """Packed steps, those that lie in the file, and packed ones made after it was let go of."""
    one, other = ah.examples.wigley(), ah.examples.wigley()
    points = _points(one, 5)
    for hull, held in ((one, 2), (other, NEVER)):
        hull.document.author = "x"  # saving names who is at work
        with old_after(held):
            for number in range(30):
                _move(hull, points, number)
                if number == 9 and hull is one:
                    hull.save(tmp_path / "ship.hull")
                if number == 19 and hull is one:
                    hull.detach()
    assert told(one) == told(other)
    count = len(one.history)
    for _ in range(2):
        for hull in (one, other):
            hull.undo(count)
        assert tables(one) == tables(other)
        for hull in (one, other):
            hull.redo(count)
        assert tables(one) == tables(other)
    assert one.verify() == ()


def test_an_interrupt_while_an_old_step_is_told_leaves_it_to_others_to_ask() -> None:
    """At whatever instruction it comes: nobody waits for one who is gone."""
    hull = ah.examples.wigley()
    points = _points(hull, 3)
    with old_after(1):
        for number in range(4):
            _move(hull, points, number)
    past = hull.document._past
    assert past is not None
    left = [0]

    def trace(frame: FrameType, event: str, argument: object) -> Callable[..., Any] | None:
        if frame.f_code.co_filename not in (past_states.__file__, derived.__file__):
            return None
        frame.f_trace_opcodes = True
        if event == "opcode":
            left[0] -= 1
            if not left[0]:
                raise KeyboardInterrupt
        return trace

    def tell() -> int:
        return past.tell(1, lambda state: state.rows.count, lambda state, count: count)

    def ask(found: list[int]) -> None:
        found.append(tell())

    expected, known = tell(), sys.gettrace()
    for number in range(1, 1000):
        left[0] = number
        sys.settrace(trace)
        try:
            tell()
        except KeyboardInterrupt:
            pass
        finally:
            sys.settrace(known)
        found = list[int]()
        other = threading.Thread(target=ask, args=(found,), daemon=True)
        other.start()
        other.join(20.0)
        assert found == [expected], number
        if left[0] > 0:
            break
    assert left[0] > 0


def test_a_step_that_grows_old_while_another_thread_asks_for_it_is_old() -> None:
    """What the other thread has made by then is given to it, and not held on."""
    hull = ah.examples.wigley()
    points, begun, gone_on = _points(hull, 3), threading.Event(), threading.Event()
    body = program_edit._Notes.body

    def slowly(self: program_edit._Notes) -> StepBody:
        found = body(self)
        begun.set()
        assert gone_on.wait(60.0)
        return found

    found = list[bytes]()
    with old_after(1):
        _move(hull, points, 0)
        step = hull.document.steps[1]
        reader = threading.Thread(target=lambda: found.append(step.changed.tobytes()))
        with mock.patch.object(program_edit._Notes, "body", slowly):
            reader.start()
            assert begun.wait(60.0)
        _move(hull, points, 1)
        gone_on.set()
        reader.join()
    assert is_old(step)
    assert found == [step.changed.tobytes()]


def test_a_line_that_was_cut_anew_has_no_inflections_before_in_an_old_step_either() -> None:
    """The tables had another curve in its place, which is not what it came from."""
    one, other = ah.examples.series60(), ah.examples.series60()
    for hull, held in ((one, 1), (other, NEVER)):
        with old_after(held):
            for position in (0.55, 0.25):
                with hull.edit("shift") as edit:
                    edit.shift_line("BTK 0.06", position)
            _move(hull, _points(hull, 1), 0)
    assert [is_old(step) for step in one.document.steps.values()] == [True, True, False]
    for mine, theirs in zip(one.history, other.history, strict=True):
        assert mine.inflections == theirs.inflections


def _faired_and_edited(hull: ah.Hull) -> list[str]:
    """Fair, move and pull by the program; give the fingerprint after each."""
    found = [hull.fingerprint]
    for turn in range(3):
        hull.fair(noise=0.2e-3)
        found.append(hull.fingerprint)
        with hull.edit("a faired point is given anew") as edit:
            edit.move("WL 2.5 x ST 7", y=hull.points["WL 2.5 x ST 7"].y + 0.01)
        found.append(hull.fingerprint)
        with hull.edit("others go along") as edit:
            edit.pull("WL 3.75 x ST 12", 0.005 * (turn + 1))
        found.append(hull.fingerprint)
    return found


@pytest.mark.parametrize("held", [0, 1, NEVER])
def test_how_far_fairing_took_points_is_there_after_undo(held: int) -> None:
    """To the bit, whether steps are old or not."""
    count = Count()
    with old_after(held, count):
        hull = ah.examples.wigley()
        found = _faired_and_edited(hull)
        assert count.kept > 3, "by the program"
        for expected in found[-2::-1]:
            hull.undo()
            assert hull.fingerprint == expected
        for expected in found[1:]:
            hull.redo()
            assert hull.fingerprint == expected
        hull.undo(len(found) - 1)
        assert hull.fingerprint == found[0]
        hull.redo(len(found) - 1)
        assert hull.fingerprint == found[-1]


def test_how_far_fairing_took_points_is_in_the_file(tmp_path: Path) -> None:
    """Steps of the program are told to the file by their numbers, and by what fairing did."""
    with old_after(NEVER):
        hull = ah.examples.wigley()
        hull.save(tmp_path / "ship.hull")
        found = _faired_and_edited(hull)
        hull.close()
    again = ah.open(tmp_path / "ship.hull")
    assert again.fingerprint == found[-1]
    assert again.verify() == ()
    for expected in found[-2::-1]:
        again.undo()
        assert again.fingerprint == expected
    again.close()
