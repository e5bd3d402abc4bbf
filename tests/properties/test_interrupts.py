"""An interrupt anywhere: memory, history and file agree afterwards, and the next edit works.

Acts are run under a trace function that raises `KeyboardInterrupt` at one line of the package,
drawn from all that the act passes: in edits, undo, redo, checkpoints and variations of a hull that
lives in a hull file.
"""

import os
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from types import FrameType
from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from tests.properties.test_program_edits import Count, by_program
from tests.properties.test_published_states import content

LONG = os.environ.get("ASSOC_HULL_LONG") == "1"
ROOT = str(Path(ah.__file__).parent)
COUNT = 400 if LONG else 15
"""Interrupts an act."""


def _move(hull: ah.Hull) -> None:
    with hull.edit("move") as edit:
        edit.move("WL 2.5 x ST 7", y=2.95)


def _insert(hull: ah.Hull) -> None:
    with hull.edit("insert") as edit:
        edit.insert("ST 7", (35.0, 0.43, 0.3))


def _undo(hull: ah.Hull) -> None:
    hull.undo()


def _redo(hull: ah.Hull) -> None:
    hull.redo()


def _name(hull: ah.Hull) -> None:
    hull.checkpoint("as drawn")


def _move_by_program(hull: ah.Hull) -> None:
    with by_program(Count(), always=True):
        _move(hull)


ACTS: dict[str, tuple[Callable[[ah.Hull], None], int]] = {
    "a moved point": (_move, 1), "a point moved by the program": (_move_by_program, 1),
    "an inserted point": (_insert, 1), "undo": (_undo, 1), "redo": (_redo, 2),
    "a checkpoint": (_name, 1),
}  # fmt: skip
"""Each with what is done before: 1 an edit, 2 an edit that is taken back."""


class Tracer:
    """Counts the lines of the package that are passed, and raises at one of them."""

    def __init__(self, at: int = -1) -> None:
        self.at, self.seen, self.where = at, 0, ""

    def __call__(self, frame: FrameType, event: str, argument: Any) -> Any:
        """Trace the package only."""
        if not frame.f_code.co_filename.startswith(ROOT):
            return None
        if event == "line":
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


@pytest.mark.parametrize("name", ACTS)
def test_an_interrupt_anywhere_leaves_one_truth(name: str, tmp_path: Path) -> None:
    """Whatever line it comes at, hull and file are as before the act or as after it."""
    act, done = ACTS[name]
    counter = Tracer()
    first = tmp_path / "first"
    first.mkdir()
    hull = ready(first, done)
    before = hull.fingerprint
    traced(act, hull, counter)
    after = hull.fingerprint
    hull.close()
    draw = np.random.default_rng(28)
    for number, at in enumerate(sorted(draw.integers(1, counter.seen + 1, COUNT).tolist())):
        folder = tmp_path / str(number)
        folder.mkdir()
        hull, tracer = ready(folder, done), Tracer(at)
        with pytest.raises(KeyboardInterrupt):
            traced(act, hull, tracer)
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
