"""One writer at a time: what another thread, another task and an inner edit get."""

import asyncio
import gc
import threading
import time
from collections.abc import Callable
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.edit.session import Edit
from assoc_hull.edit.write_lock import WriteLock
from assoc_hull.errors import BadInputError, HullBusyError
from tests.long_forms import LONG

POINT, OTHER = "WL 2.5 x ST 7", "WL 2.5 x ST 12"


@pytest.fixture
def hull() -> ah.Hull:
    """A hull to edit."""
    return ah.examples.wigley()


def shift(hull: ah.Hull, name: str, by: float = 0.01, **asked: object) -> None:
    """Move a point a little."""
    with hull.edit(name, **asked) as edit:  # type: ignore[arg-type]
        edit.move(POINT, y=hull.points[POINT].y + by)


def in_thread(act: Callable[[], object]) -> list[BaseException]:
    """Carry out an act in another thread, and give what it raised."""
    raised = list[BaseException]()

    def run() -> None:
        try:
            act()
        except BaseException as error:
            raised.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    return raised


def names(hull: ah.Hull) -> list[str]:
    """The edits that were made."""
    return [each.name for each in hull.history]


# --------------------------------------------------------------------------------------
# Threads.


@pytest.mark.parametrize("act", [
    lambda hull: shift(hull, "two", wait=0.05),
    lambda hull: hull.close(),
    lambda hull: hull.detach(),
], ids=["edit", "close", "detach"])  # fmt: skip
def test_another_thread_is_told_who_is_at_work(
    hull: ah.Hull, act: Callable[[ah.Hull], None]
) -> None:
    """With the edit, its author, and for how long it has waited."""
    with hull.edit("one", author="anna") as edit:
        (error,) = in_thread(lambda: act(hull))
        edit.move(POINT, y=2.9)
    assert isinstance(error, HullBusyError)
    assert isinstance(error, TimeoutError)
    assert (error.what, error.author, error.same_thread) == ("the edit 'one'", "anna", False)
    assert "the edit 'one' of anna" in str(error)
    assert names(hull) == ["one"]


def test_another_thread_waits_for_its_turn(hull: ah.Hull) -> None:
    """Both edits are made, one after the other, each under its own name."""
    entered, raised = threading.Event(), list[BaseException]()

    def second() -> None:
        try:
            entered.set()
            shift(hull, "two", wait=20.0)
        except BaseException as error:
            raised.append(error)

    thread = threading.Thread(target=second)
    with hull.edit("one") as edit:
        edit.move(POINT, y=2.9)
        thread.start()
        entered.wait()
    thread.join()
    assert not raised
    assert names(hull) == ["one", "two"]


def test_undo_waits_for_the_edit_of_another_thread_and_takes_that_back(hull: ah.Hull) -> None:
    """What is taken back is chosen when its turn has come."""
    shift(hull, "one")
    before = hull.fingerprint
    entered = threading.Event()

    def undo() -> None:
        entered.set()
        hull.undo()

    thread = threading.Thread(target=undo)
    with hull.edit("two") as edit:
        edit.move(POINT, y=2.9)
        thread.start()
        entered.wait()
    thread.join()
    assert names(hull) == ["one"]
    assert hull.fingerprint == before


def test_an_edit_that_waits_in_vain_leaves_the_other_one_whole(hull: ah.Hull) -> None:
    """And may be entered again when the other has ended."""
    late = hull.edit("late", wait=0.0)
    with hull.edit("one") as edit:
        edit.move(POINT, y=2.9)

        def enter() -> None:
            with late:
                pass

        (error,) = in_thread(enter)
    assert isinstance(error, HullBusyError)
    with late:
        late.move(POINT, y=2.8)
    assert names(hull) == ["one", "late"]


@pytest.mark.parametrize("act", [
    lambda edit: edit.move(OTHER, y=2.2),
    lambda edit: edit.delete("no such point"),
    lambda edit: edit.add_line("waterlines", 1.1),
], ids=["move", "look-up", "line"])  # fmt: skip
def test_an_open_edit_takes_nothing_from_another_thread(
    hull: ah.Hull, act: Callable[[Edit], object]
) -> None:
    """Nor does it look anything up there in what is half written; it goes on where it is."""
    with hull.edit("one") as edit:
        edit.move(POINT, y=2.9)
        (error,) = in_thread(lambda: act(edit))
    assert isinstance(error, HullBusyError)
    assert error.what == "the edit 'one'"
    assert [each["point"] for each in hull.document.history[-1].script.edits] == [POINT]
    assert hull.points[OTHER].y != 2.2


def test_a_wait_that_is_none_is_told_in_seconds(hull: ah.Hull) -> None:
    """It is no length."""
    with pytest.raises(BadInputError, match=r"up to 1e\+06 s$"):
        hull.edit("one", wait=float("nan"))


# --------------------------------------------------------------------------------------
# Tasks.


def test_another_task_of_the_same_thread_is_told_at_once(hull: ah.Hull) -> None:
    """To wait would stop the loop that the first one needs to end."""

    async def first(begun: asyncio.Event, over: asyncio.Event) -> None:
        with hull.edit("one") as edit:
            edit.move(POINT, y=2.9)
            begun.set()
            await over.wait()

    async def both() -> HullBusyError:
        begun, over = asyncio.Event(), asyncio.Event()
        task = asyncio.create_task(first(begun, over))
        await begun.wait()
        with pytest.raises(HullBusyError, match="async with") as said:
            shift(hull, "two")
        over.set()
        await task
        return said.value

    error = asyncio.run(both())
    assert error.same_thread
    assert error.waited < 1.0
    assert names(hull) == ["one"]


def test_a_task_that_was_begun_inside_an_edit_does_not_join_it(hull: ah.Hull) -> None:
    """It has the context of its maker, and is another task all the same."""

    async def inner() -> None:
        shift(hull, "inner")

    async def outer() -> None:
        async with hull.edit("outer") as edit:
            edit.move(POINT, y=2.9)
            with pytest.raises(HullBusyError):
                await asyncio.create_task(inner())

    asyncio.run(outer())
    assert names(hull) == ["outer"]


def test_two_async_editors_take_turns(hull: ah.Hull) -> None:
    """`async with` waits without stopping the loop; no edit is lost or under another's name."""

    async def editor(name: str) -> None:
        for turn in range(20):
            async with hull.edit(f"{name} {turn}", author=name) as edit:
                await asyncio.sleep(0)
                edit.move(POINT, y=2.9 + 0.001 * turn + (0.0005 if name == "anna" else 0.0))
                await asyncio.sleep(0)

    async def both() -> None:
        await asyncio.gather(editor("anna"), editor("bert"))

    asyncio.run(both())
    assert len(hull.history) == 40
    assert all(each.name.startswith(each.author) for each in hull.history)
    for name in ("anna", "bert"):
        mine = [each.name for each in hull.history if each.author == name]
        assert mine == [f"{name} {turn}" for turn in range(20)]


def test_async_with_waits_no_longer_than_asked(hull: ah.Hull) -> None:
    """Then it is told as a thread is."""

    async def both() -> None:
        async with hull.edit("one") as edit:
            edit.move(POINT, y=2.9)

            async def second() -> None:
                async with hull.edit("two", wait=0.05):
                    pass

            with pytest.raises(HullBusyError) as said:
                await asyncio.create_task(second())
            assert said.value.waited >= 0.05

    asyncio.run(both())
    assert names(hull) == ["one"]


# --------------------------------------------------------------------------------------
# Inside one task.


def test_inner_edits_join_if_they_ask_for_nothing_else(hull: ah.Hull) -> None:
    """One step in the history; what is not named is as outside."""
    with hull.edit("outer", gaps="report", author="anna") as edit:
        edit.move(POINT, y=2.9)
        with hull.edit("inner", policy="all_or_nothing", author="anna") as inner:
            assert inner is edit
    assert names(hull) == ["outer"]


@pytest.mark.parametrize(
    "asked", [{"policy": "keep_going"}, {"gaps": "report"}, {"author": "bert"}]
)
def test_inner_edits_that_ask_for_something_else_are_refused(
    hull: ah.Hull, asked: dict[str, str]
) -> None:
    """Nothing that was asked for is dropped in silence; the outer edit goes on."""
    hull.author = "anna"
    with hull.edit("outer") as edit:
        with pytest.raises(BadInputError, match="inside the edit 'outer'"):
            hull.edit("inner", **asked)  # type: ignore[arg-type]
        edit.move(POINT, y=2.9)
    assert names(hull) == ["outer"]


def test_garbage_is_collected_while_an_edit_merely_stands_open(hull: ah.Hull) -> None:
    """Only the update itself holds the collector off."""
    with hull.edit("one") as edit:
        assert gc.isenabled()
        edit.move(POINT, y=2.9)
    assert gc.isenabled()


# --------------------------------------------------------------------------------------
# Authors.


def test_an_edit_may_have_an_author_of_its_own(hull: ah.Hull) -> None:
    """Else it is the hull's."""
    hull.author = "anna"
    shift(hull, "one")
    shift(hull, "two", author="bert")
    assert [each.author for each in hull.history] == ["anna", "bert"]


def test_undo_of_an_author_takes_back_what_is_theirs(hull: ah.Hull) -> None:
    """Where it lies on top."""
    shift(hull, "one", author="anna")
    shift(hull, "two", author="bert")
    shift(hull, "three", author="bert")
    hull.undo(2, author="bert")
    assert names(hull) == ["one"]
    hull.redo(2)
    assert [each.author for each in hull.history] == ["anna", "bert", "bert"]


def test_undo_of_an_author_names_what_lies_above(hull: ah.Hull) -> None:
    """And changes nothing."""
    shift(hull, "one", author="anna")
    shift(hull, "two", author="bert")
    before = hull.fingerprint
    with pytest.raises(BadInputError, match="above it lie 'two' of 'bert'"):
        hull.undo(author="anna")
    with pytest.raises(BadInputError, match="1 steps of theirs to undo, and 2 were asked"):
        hull.undo(2, author="anna")
    with pytest.raises(BadInputError, match="0 steps of theirs"):
        hull.undo(author="carl")
    assert (names(hull), hull.fingerprint) == (["one", "two"], before)


def test_who_came_first_is_next() -> None:
    """One who gives it back and asks again at once comes after those that wait."""
    lock, order, first = WriteLock(), list[str](), object()
    lock.take(first, "the first", where="in the first")
    came = threading.Event()

    def other() -> None:
        mine = object()
        lock.line_up(mine, "the second")
        came.set()
        lock.take(mine, "the second", where="in the second")
        order.append("second")
        lock.give_back(mine)
        lock.leave(mine)

    thread = threading.Thread(target=other)
    thread.start()
    came.wait()
    lock.give_back(first)
    lock.take(third := object(), "the third", where="in the third")
    order.append("third")
    lock.give_back(third)
    thread.join()
    assert order == ["second", "third"]


def test_who_waited_and_was_broken_off_keeps_nobody_waiting() -> None:
    """It has not looked for its turn for half a second."""
    lock = WriteLock()
    thread = threading.Thread(target=lock.line_up, args=(object(), "the first"))
    thread.start()
    thread.join()
    lock.take(mine := object(), "the second", where="in the second", wait=5.0)
    assert lock.held_by(mine)


def test_a_task_that_waits_does_not_stop_its_own_thread() -> None:
    """It stands before the thread's own edit, and cannot look before that is done."""
    lock = WriteLock()
    lock.line_up(object(), "the first")
    lock.take(mine := object(), "the second", where="in the second", wait=0.0)
    assert lock.held_by(mine)


@pytest.mark.parametrize("pause", [0.0, 0.6], ids=["at once", "after long work"])
def test_of_tasks_in_one_loop_who_came_first_is_next(hull: ah.Hull, pause: float) -> None:
    """One that comes again and again keeps no other out, also where its edits stop the loop."""
    ended = list[str]()

    async def busy() -> None:
        turn = 0
        while "other" not in ended and turn < 8:
            turn += 1
            async with hull.edit(f"busy {turn}", wait=30.0) as edit:
                await asyncio.sleep(0.005)
                edit.move(POINT, y=2.9 - 1e-4 * turn)
                time.sleep(pause if turn == 1 else 0.0)  # as an edit of a large hull does
            ended.append("busy")

    async def other() -> None:
        await asyncio.sleep(0)
        async with hull.edit("other", wait=30.0) as edit:
            edit.move(OTHER, y=2.2)
        ended.append("other")

    async def both() -> None:
        await asyncio.gather(busy(), other())

    asyncio.run(both())
    assert ended[:2] == ["busy", "other"]


def test_a_task_that_edits_without_waiting_is_not_kept_out_by_one_that_waits() -> None:
    """What stops the loop can let nobody of that loop go first."""
    lock = WriteLock()

    async def both() -> None:
        over = asyncio.Event()

        async def waits() -> None:
            lock.line_up(object(), "the first")
            await over.wait()

        first = asyncio.create_task(waits())
        await asyncio.sleep(0)
        lock.take(mine := object(), "the second", where="in the second", wait=0.0)
        over.set()
        await first
        assert lock.held_by(mine)

    asyncio.run(both())


def test_two_editors_in_one_loop_for_many_turns(hull: ah.Hull) -> None:
    """Each edit is in the history under its own name, or was refused to who asked for it."""
    turns, made, refused, idle = (500 if LONG else 60), list[str](), list[str](), 0

    async def editor(name: str, waits: bool) -> None:
        nonlocal idle
        for turn in range(turns):
            edit, title = hull.edit(f"{name} {turn}", author=name), f"{name} {turn}"
            try:
                if waits:
                    async with edit:
                        await asyncio.sleep(0)
                        edit.move(POINT, y=2.9 + 1e-4 * (turn % 7))
                else:
                    with edit:
                        await asyncio.sleep(0)
                        edit.move(OTHER, y=2.2 + 1e-4 * (turn % 5))
            except HullBusyError:
                refused.append(title)
            else:
                assert edit.report is not None
                if edit.report.changed:
                    made.append(title)
                idle += not edit.report.changed
            await asyncio.sleep(0)

    async def both() -> None:
        await asyncio.gather(editor("waits", True), editor("does not", False))

    asyncio.run(both())
    assert len(made) + len(refused) + idle == 2 * turns
    assert len(made) > turns
    assert not any(title.startswith("waits") for title in refused)
    assert [each.name for each in hull.history] == made
    assert all(each.name.startswith(each.author) for each in hull.history)
    assert hull.verify() == ()


def test_an_edit_does_not_hold_its_hull_in_a_ring(hull: ah.Hull, tmp_path: Path) -> None:
    """A hull file is closed as soon as nobody has the hull, whenever a collector runs."""
    path = tmp_path / "ship.hull"
    hull.save(path)
    again = ah.open(path)
    gc.disable()
    try:
        shift(again, "fuller")
        again.drag(POINT).to(d=0.01)
        del again
        hull.close()
        assert [each.name for each in tmp_path.iterdir()] == ["ship.hull"]
    finally:
        gc.enable()
