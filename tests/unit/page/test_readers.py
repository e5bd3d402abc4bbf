"""Answers that are not wanted any more end at once, and no other waits for them."""

import sys
import threading
import time
from collections.abc import Iterator
from functools import partial

import attrs
import pytest

from assoc_hull.page.readers import CopyReaders


@attrs.define(eq=False)
class Work:
    """Something that takes for ever; it tells when it has begun, and when it has ended."""

    begun: threading.Event = attrs.field(factory=threading.Event)
    ended: threading.Event = attrs.field(factory=threading.Event)

    def run(self) -> None:
        """Count, and swallow errors, as careless code does."""
        try:
            self.begun.set()
            while True:
                try:
                    time.sleep(0.001)
                except Exception:
                    continue
        finally:
            self.ended.set()


@pytest.fixture
def readers() -> Iterator[CopyReaders]:
    """One thread."""
    found = CopyReaders("reader of a test", 1)
    yield found
    found.close()


def test_a_stopped_answer_ends_and_the_next_is_given(readers: CopyReaders) -> None:
    """By its number; one of another owner goes on waiting, and then is done in the same thread."""
    long, done = Work(), threading.Event()
    readers.submit("anna", "list", 1, long.run)
    assert long.begun.wait(5.0)
    readers.submit("bert", "list", 2, done.set)
    readers.stop("bert", 1)
    readers.stop("anna", 7)
    assert not long.ended.wait(0.1)
    readers.stop("anna", 1)
    assert long.ended.wait(5.0)
    assert done.wait(5.0)


def test_a_newer_question_of_the_same_kind_ends_the_older(readers: CopyReaders) -> None:
    """Also one that still waits; that of another kind does not."""
    long, waits, last = Work(), threading.Event(), threading.Event()
    readers.submit("anna", "list", 1, long.run)
    assert long.begun.wait(5.0)
    readers.submit("anna", "window", 2, waits.set)
    readers.submit("anna", "window", 3, last.set)
    assert not long.ended.wait(0.1)
    readers.submit("anna", "list", 4, lambda: None)
    assert long.ended.wait(5.0)
    assert last.wait(5.0)
    assert not waits.is_set()


def test_closing_waits_for_nothing_and_leaves_no_thread() -> None:
    """What runs ends, what waits is not begun, and what is asked later neither."""
    readers = CopyReaders("reader that is closed", 2)
    works, later = [Work(), Work()], threading.Event()
    for number, work in enumerate(works):
        readers.submit("anna", number, number, work.run)
        assert work.begun.wait(5.0)
    readers.submit("anna", "later", 3, later.set)
    begin = time.monotonic()
    readers.close()
    assert time.monotonic() - begin < 1.0
    assert all(work.ended.wait(5.0) for work in works)
    readers.submit("anna", "later", 4, later.set)
    assert not later.wait(0.1)
    deadline = time.monotonic() + 5.0
    while any(each.name == "reader that is closed" for each in threading.enumerate()):
        assert time.monotonic() < deadline
        time.sleep(0.01)


def test_a_thousand_stops_leave_the_thread_at_work(readers: CopyReaders) -> None:
    """Whenever they come: before a job, in it, or when it is just done."""
    for number in range(1000):
        readers.submit("anna", "list", number, lambda: None)
        readers.stop("anna", number)
    done = threading.Event()
    readers.submit("anna", "list", 1000, done.set)
    assert done.wait(5.0)


def test_no_stop_is_told_as_an_error_of_its_thread(
    readers: CopyReaders, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A short job is ended at its first step, its last one, or just behind it: nothing escapes."""
    told: list[str] = []
    monkeypatch.setattr(threading, "excepthook", lambda args: told.append(args.exc_type.__name__))
    switch = sys.getswitchinterval()

    def short(begun: threading.Event, steps: int) -> None:
        begun.set()
        for _ in range(steps):
            pass

    sys.setswitchinterval(1e-6)
    try:
        for number in range(2000):
            begun = threading.Event()
            readers.submit("anna", "list", number, partial(short, begun, number % 50))
            if number % 2:
                assert begun.wait(5.0)  # else the stop may come before the job
            for _ in range(number % 97):
                pass
            readers.stop("anna", number)
    finally:
        sys.setswitchinterval(switch)
    done = threading.Event()
    readers.submit("anna", "list", 2000, done.set)
    assert done.wait(5.0)
    assert told == []
