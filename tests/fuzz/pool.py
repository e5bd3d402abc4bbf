"""Trials in processes of their own, watched: one that takes too long is ended and named."""

from __future__ import annotations

import multiprocessing
import multiprocessing.connection
import os
import tempfile
import time
from collections.abc import Iterable, Iterator
from multiprocessing.connection import Connection
from pathlib import Path

import attrs

from tests.fuzz.kind import Kind, made
from tests.fuzz.trial import Outcome, trial

__all__ = ["HANG", "Item", "run_all"]

HANG, DEAD = "no end", "the process ended"
LIMIT = 5.0
"""Seconds that an input may take of a processor; by the clock, where that cannot be told."""
_PATIENCE = 12.0
"""By the clock it may take so many times as long: the machine may be busy."""

_START = 60.0
"""Seconds that a process may take to start, on a busy machine."""

_SPAWN = multiprocessing.get_context("spawn")


@attrs.frozen
class Item:
    """An input: that of a number, made where it is tried."""

    kind: Kind
    seed: int
    number: int

    @property
    def data(self) -> bytes:
        """The input itself."""
        return made(self.kind, self.seed, self.number)


def _serve(ours: Connection) -> None:
    """Try what comes, until nothing more does."""
    import tests.fuzz.all_kinds  # noqa: F401  # before it starts: no input pays for it

    with tempfile.TemporaryDirectory(prefix="fuzz-") as folder:
        ours.send(None)
        while (item := ours.recv()) is not None:
            try:
                ours.send(trial(item.kind, item.data, Path(folder)))
            except Exception as error:  # a fault of the kind, not of the program it tries
                ours.send(RuntimeError(f"{item.kind.name} {item.number}: {error!r}"))


class _Worker:
    """A process, what it tries, and until when."""

    def __init__(self) -> None:
        self.ours, theirs = _SPAWN.Pipe()
        self.process = _SPAWN.Process(target=_serve, args=(theirs,), daemon=True)
        self.process.start()
        theirs.close()
        self.item: Item | None = None
        self.since = time.monotonic()
        self.until = self.since + _START
        self.spent: float | None = None

    def give(self, item: Item, limit: float) -> None:
        """Hand over the next input."""
        self.item, self.since, self.spent = item, time.monotonic(), self._time()
        self.until = self.since + limit * (1.0 if self.spent is None else _PATIENCE)
        self.ours.send(item)

    def _time(self) -> float | None:
        """Processor time (s) the process has used, where the system tells it."""
        try:
            words = Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()
        except OSError:
            return None
        return (int(words[11]) + int(words[12])) / float(os.sysconf("SC_CLK_TCK"))

    def late(self, limit: float) -> bool:
        """Tell whether its input takes too long."""
        now = time.monotonic()
        if now > self.until or now < self.since + limit or self.spent is None:
            return now > self.until
        spent = self._time()
        return spent is not None and spent - self.spent > limit

    def answer(self, ready: bool, limit: float) -> Outcome | None:
        """What became of its input; None while that is not known, or when it has just started."""
        if ready:
            try:
                found: Outcome | Exception | None = self.ours.recv()
            except EOFError:
                return Outcome(-1, DEAD)
            if isinstance(found, Exception):
                raise found
            return found
        return Outcome(-1, HANG, limit) if self.late(limit) else None

    def end(self) -> None:
        """End the process, whatever it does."""
        self.process.kill()
        self.process.join()
        self.ours.close()


class _Course:
    """What is still to be tried: what came late first, by itself and once more."""

    def __init__(self, items: Iterable[Item]) -> None:
        self.waiting, self.again, self.tried = iter(items), list[Item](), set[Item]()

    def next(self) -> Item | None:
        """Give the next input."""
        return self.again.pop() if self.again else next(self.waiting, None)

    def once_more(self, item: Item) -> bool:
        """Put an input back, unless it was already."""
        if item in self.tried:
            return False
        self.tried.add(item)
        self.again.append(item)
        return True


def run_all(
    items: Iterable[Item], processes: int = 1, limit: float = LIMIT
) -> Iterator[tuple[Item, Outcome]]:
    """Try all inputs; gives each with what became of it, in the order in which they end.

    An input that takes too long is tried once more, by a new process: only one that takes
    too long twice is a fault of the program and not of a busy machine.
    """
    course = _Course(items)
    workers = [_Worker() for _ in range(processes)]
    try:
        while workers:
            ready = multiprocessing.connection.wait([each.ours for each in workers], 0.1)
            for place, worker in reversed(list(enumerate(workers))):
                outcome = worker.answer(worker.ours in ready, limit)
                if outcome is None and worker.ours not in ready:
                    continue
                if outcome is not None and worker.item is not None:
                    again = outcome.fault == HANG and course.once_more(worker.item)
                    if not again:
                        yield worker.item, outcome
                if outcome is not None and outcome.fault in (HANG, DEAD):
                    worker.end()
                    workers[place] = _Worker()
                    continue
                item = course.next()
                if item is None:
                    worker.end()
                    del workers[place]
                else:
                    worker.give(item, limit)
    finally:
        for worker in workers:
            worker.end()
