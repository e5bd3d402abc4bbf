"""An interrupt anywhere: memory, history and file agree afterwards, and the next edit works.

Acts are run under a trace function that raises `KeyboardInterrupt` at one line of the package,
drawn from all that the act passes: in edits, undo, redo, checkpoints and variations of a hull that
lives in a hull file.
"""

import contextlib
import gc
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from types import FrameType
from typing import Any
from unittest import mock

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.drag import _QuickWay
from assoc_hull.edit.transaction import Transaction
from tests.long_forms import LONG
from tests.properties.test_program_edits import Count, by_program
from tests.properties.test_published_states import content

ROOT = str(Path(ah.__file__).parent)
COUNT = 80 if LONG else 3
"""Interrupts an act; 2,000 and more over all acts in the long form."""


def _move(hull: ah.Hull) -> None:
    with hull.edit("move") as edit:
        edit.move("WL 2.5 x ST 7", y=2.95)


def _insert(hull: ah.Hull) -> None:
    with hull.edit("insert") as edit:
        edit.insert("ST 7", (35.0, 0.43, 0.3), lead=False)


def _undo(hull: ah.Hull) -> None:
    hull.undo()


def _redo(hull: ah.Hull) -> None:
    hull.redo()


def _name(hull: ah.Hull) -> None:
    hull.checkpoint("as drawn")


def _move_by_program(hull: ah.Hull) -> None:
    with by_program(Count(), always=True):
        _move(hull)


def _refused(hull: ah.Hull) -> None:
    with contextlib.suppress(ah.errors.AssocHullError), hull.edit("refused") as edit:
        edit.move("WL 2.5 x ST 7", y=1e6)


def _given_up(hull: ah.Hull) -> None:
    with contextlib.suppress(LookupError), hull.edit("given up") as edit:
        edit.insert("ST 7", (35.0, 0.5, 0.35), lead=False)
        raise LookupError


def _preview(hull: ah.Hull) -> None:
    hull.preview([{"op": "move", "point": "WL 2.5 x ST 7", "y": 2.8}], measure=False)


def _drag(hull: ah.Hull) -> None:
    with mock.patch.object(_QuickWay, "of", return_value=None):
        hull.drag("WL 2.5 x ST 7", radius=(20.0, 4.0)).to(d=0.02)


def _vary(hull: ah.Hull) -> None:
    hull.vary(set={"breadth": 1.01 * hull.particulars.breadth})


TAKEN_BACK: dict[str, Callable[[ah.Hull], None]] = {
    "a refused edit": _refused, "an edit given up": _given_up, "a preview": _preview,
    "a step of a drag": _drag,
}  # fmt: skip
BACK = ("/graph/journal.py", "/graph/table.py", "/edit/transaction.py")
"""Where what was done is taken back."""

ACTS: dict[str, tuple[Callable[[ah.Hull], None], int]] = {
    "a moved point": (_move, 1), "a point moved by the program": (_move_by_program, 1),
    "an inserted point": (_insert, 1), "undo": (_undo, 1), "redo": (_redo, 2),
    "a checkpoint": (_name, 1), "a variation": (_vary, 1),
    "what a file does for a move": (_move, 1),
    **{name: (act, 1) for name, act in TAKEN_BACK.items()},
}  # fmt: skip
"""Each with what is done before: 1 an edit, 2 an edit that is taken back."""

ONLY = {
    "what a file does for a move": ("/io/hull_file/storage.py", "/graph/derived.py"),
    **dict.fromkeys(TAKEN_BACK, BACK),
}
"""Where interrupts of an act come; anywhere in the package if it is not here."""


LEAVE = Transaction.__exit__.__code__
ENTERED = sorted({line for *_, line in LEAVE.co_lines() if line is not None})[2]
"""What ends an edit begins with two lines that say `try`: no Python lies before them that could
answer an interrupt that comes there, and none is raised at them."""


class Tracer:
    """Counts the lines of the package, or of some modules, that are passed; raises at one."""

    def __init__(self, at: int = -1, only: tuple[str, ...] = ("",)) -> None:
        self.at, self.seen, self.where = at, 0, ""
        self.only = tuple(ROOT + each for each in only)

    def __call__(self, frame: FrameType, event: str, argument: Any) -> Any:
        """Trace the package only."""
        if not frame.f_code.co_filename.startswith(ROOT):
            return None
        if frame.f_code is LEAVE and frame.f_lineno <= ENTERED:
            return self
        if event == "line" and frame.f_code.co_filename.startswith(self.only):
            self.seen += 1
            if self.seen == self.at:
                self.where = f"{frame.f_code.co_filename[len(ROOT) :]}:{frame.f_lineno}"
                raise KeyboardInterrupt
        return self


def traced(act: Callable[[ah.Hull], None], hull: ah.Hull, tracer: Tracer) -> None:
    """Run an act under a tracer."""
    before = sys.gettrace()
    sys.settrace(tracer)
    try:
        act(hull)
    finally:
        sys.settrace(before)


def ready(folder: Path, done: int) -> ah.Hull:
    """A small hull in a file with one edit, taken back or not."""
    hull = ah.examples.wigley()
    path = folder / "ship.hull"
    hull.save(path)
    with hull.edit("before") as edit:
        edit.move("WL 3.75 x ST 9", y=3.9)
    if done == 2:
        hull.undo()
    return hull


def in_thread(hull: ah.Hull) -> str:
    """The fingerprint in another thread; none if that waits for what nobody gives back."""
    found = list[str]()
    thread = threading.Thread(target=lambda: found.append(hull.fingerprint), daemon=True)
    thread.start()
    thread.join(60.0)
    return found[0] if found else ""


@pytest.fixture(autouse=True)
def in_numpy(monkeypatch: pytest.MonkeyPatch) -> None:
    """One arithmetic: the compiled form may come in the middle, and passes other lines."""
    monkeypatch.setenv("ASSOC_HULL_FAST", "0")


@pytest.mark.parametrize("name", ACTS)
def test_an_interrupt_anywhere_leaves_one_truth(name: str, tmp_path: Path) -> None:
    """Whatever line it comes at, hull and file are as before the act or as after it."""
    act, done = ACTS[name]
    only = ONLY.get(name, ("",))
    counter = Tracer(only=only)
    first, once = tmp_path / "first", tmp_path / "once"
    first.mkdir()
    once.mkdir()
    act(ready(once, done))  # what is imported or made once in a process is not counted
    hull = ready(first, done)
    before = hull.fingerprint
    traced(act, hull, counter)
    after = hull.fingerprint
    hull.close()
    draw = np.random.default_rng(28)
    for number, at in enumerate(sorted(draw.integers(1, counter.seen + 1, COUNT).tolist())):
        folder = tmp_path / str(number)
        folder.mkdir()
        hull, tracer = ready(folder, done), Tracer(at, only)
        # What is asked of the same state once more passes a few lines less: then all has been done.
        with contextlib.suppress(KeyboardInterrupt):
            traced(act, hull, tracer)
        assert tracer.where or tracer.seen > 0.9 * counter.seen
        again = ah.open(folder / "ship.hull")
        told = f"interrupted at {tracer.where}"
        assert hull.fingerprint in {before, after}, told
        assert again.fingerprint == hull.fingerprint, told
        assert [each.name for each in again.history] == [each.name for each in hull.history], told
        assert sorted(again.labels) == sorted(hull.labels), told
        again.close()
        assert hull.verify() == (), told
        assert in_thread(hull) == hull.fingerprint, told
        assert content(hull.state) == content(hull.document.state), told
        try:
            with hull.edit("next") as edit:
                edit.move("WL 3.75 x ST 5", y=3.17)
        except ah.errors.AssocHullError as error:
            pytest.fail(f"{told}: {error}")
        again = ah.open(folder / "ship.hull")
        assert again.fingerprint == hull.fingerprint, told
        assert again.verify() == (), told
        hull.close()
        again.close()


def _undo_two(hull: ah.Hull) -> None:
    hull.undo(2)


def _redo_two(hull: ah.Hull) -> None:
    hull.redo(2)


def _go(hull: ah.Hull) -> None:
    hull.go("first")


def edited(back: int) -> ah.Hull:
    """A small hull in memory with three edits, one of them of the structure; some taken back."""
    hull = ah.examples.wigley()
    _move(hull)
    hull.checkpoint("first")
    _insert(hull)
    with hull.edit("after") as edit:
        edit.move("WL 3.75 x ST 9", y=3.9)
    if back:
        hull.undo(back)
    return hull


IN_MEMORY: dict[str, tuple[Callable[[ah.Hull], None], int]] = {
    "undo": (_undo_two, 0), "redo": (_redo_two, 2), "go": (_go, 0),
    **{name: (act, 0) for name, act in TAKEN_BACK.items()},
}  # fmt: skip


@pytest.mark.parametrize("name", IN_MEMORY)
def test_an_interrupt_in_memory_leaves_what_was_or_what_was_asked(name: str) -> None:
    """Without a file nothing but memory tells what the hull is."""
    act, back = IN_MEMORY[name]
    only = BACK if name in TAKEN_BACK else ("/graph", "/edit/document.py", "/model/tables.py")
    act(edited(back))
    hull, counter = edited(back), Tracer(only=only)
    known = {hull.fingerprint: len(hull.history)}
    traced(act, hull, counter)
    known[hull.fingerprint] = len(hull.history)
    draw = np.random.default_rng(29)
    for at in sorted(draw.integers(1, counter.seen + 1, 2 * COUNT).tolist()):
        hull, tracer = edited(back), Tracer(at, only)
        # What is asked of the same state once more passes a few lines less: then all has been done.
        with contextlib.suppress(KeyboardInterrupt):
            traced(act, hull, tracer)
        assert tracer.where or tracer.seen > 0.9 * counter.seen
        told = f"interrupted at {tracer.where}"
        assert known.get(hull.fingerprint) == len(hull.history), told
        assert hull.verify() == (), told
        assert in_thread(hull) == hull.fingerprint, told
        with hull.edit("next") as edit:
            edit.move("WL 3.75 x ST 5", y=3.17)
        assert hull.verify() == (), told


@pytest.mark.parametrize("line", range(1, 12))
def test_an_interrupt_of_a_pause_leaves_the_collector_off_until_the_next_at_most(
    line: int,
) -> None:
    """An edit pauses garbage collection; broken off there, the next edit gives it back."""
    hull, was = ah.examples.wigley(), gc.isenabled()
    gc.enable()
    try:
        with contextlib.suppress(KeyboardInterrupt):
            traced(_move, hull, Tracer(line, ("/edit/garbage_collection.py",)))
        with hull.edit("next") as edit:
            edit.move("WL 3.75 x ST 5", y=3.17)
        assert gc.isenabled()
        gc.disable()
        _insert(hull)
        assert not gc.isenabled()  # whoever turned it off himself finds it so
    finally:
        (gc.enable if was else gc.disable)()
