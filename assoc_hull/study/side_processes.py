"""Rows made in this process or in others of this machine, and how they are handed out.

`pack_run` puts a hull and a design into bytes, of which `unpack_run` prepares the hull again: so
every process has the same tables, and makes the same rows. Libraries of linear algebra are held to
one thread: more would fight for the processor with other processes, and might add up in another
order.

The rows that are still to be made, handed out in batches that take about as long as is wanted.

A batch is what one process makes without being asked: long ones save messages, short ones are lost
less of when a process dies, and are shared out more evenly. So the first has one row, and each that
comes back says how long the next may be.
"""

from __future__ import annotations

import pickle
import signal
import sys
import tempfile
import time
from collections.abc import Generator
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    Future,
    ProcessPoolExecutor,
    wait,
)
from multiprocessing import get_context, parent_process
from pathlib import Path

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.geometry.numeric.blas_threads import one_thread
from assoc_hull.geometry.splines.backend import backend
from assoc_hull.model.tables import copy_state
from assoc_hull.study.prepared_parent import StudyParent
from assoc_hull.study.run import StudyRow, StudyRun, make_rows

__all__ = [
    "MOST_ROWS",
    "RowBatch",
    "RowQueue",
    "make_batch",
    "pack_run",
    "process_ended",
    "require_first_process",
    "rows_here",
    "rows_in_processes",
    "unpack_run",
    "versions",
]

MOST_ROWS = 64
"""Rows of a batch."""


@attrs.define(eq=False)
class RowQueue:
    """Rows that are to be made.

    Attributes
    ----------
    left : (n,) int
        Their numbers, rising.
    sharers : int
        Processes that make them.
    seconds : float
        How long a batch is to take.
    """

    left: IntArray
    sharers: int = 1
    seconds: float = 0.5
    _size: int = 1
    _next: int = 0
    _back: list[tuple[int, ...]] = attrs.field(factory=list)

    def take(self) -> tuple[int, ...]:
        """Give the numbers of the next batch; empty if there is none."""
        if self._back:
            return self._back.pop()
        share = -(-(len(self.left) - self._next) // (2 * self.sharers))
        size = max(1, min(self._size, MOST_ROWS, share))
        found = tuple(self.left[self._next : self._next + size].tolist())
        self._next += len(found)
        return found

    def give_back(self, numbers: tuple[int, ...]) -> None:
        """Hand in a batch that was not made."""
        self._back.append(numbers)

    def learn(self, rows: int, seconds: float) -> None:
        """Hear how long a batch has taken; the next ones are at most twice as long as that was."""
        fit = self.seconds * rows / max(seconds, 1e-9)
        self._size = int(np.clip(fit, 1, min(2 * max(rows, self._size), MOST_ROWS)))


_AHEAD = 2
"""Batches handed out for each process: enough to keep it at work."""


@attrs.frozen(eq=False)
class RowBatch:
    """Rows that were made together, and how long it took, s."""

    rows: tuple[StudyRow, ...]
    seconds: float


def make_batch(run: StudyRun, numbers: tuple[int, ...]) -> RowBatch:
    """Make rows, and tell how long it took."""
    start = time.perf_counter()
    rows = make_rows(run, numbers)
    return RowBatch(rows, time.perf_counter() - start)


def pack_run(run: StudyRun) -> bytes:
    """Put into bytes what another process needs to make rows."""
    return pickle.dumps((copy_state(run.ground.maps.state), run.design, run.model))


def unpack_run(given: bytes) -> StudyRun:
    """Prepare the hull anew, of what `pack_run` gave in a process of the same program."""
    state, design, model = pickle.loads(given)
    return StudyRun(design, StudyParent.of(state, design), model)


def versions() -> dict[str, str]:
    """Give the versions of what the last digits of a row depend on."""
    import scipy

    package = vars(sys.modules[__name__.partition(".")[0]])
    numerical = {each.__name__: each.__version__ for each in (np, scipy)}
    # compiled sums differ from those of numpy in the last digits
    return {"assoc-hull": str(package["__version__"]), "sums": backend()} | numerical


def rows_here(run: StudyRun, queue: RowQueue) -> Generator[tuple[StudyRow, ...]]:
    """Yield rows made in this process."""
    while numbers := queue.take():
        batch = make_batch(run, numbers)
        queue.learn(len(numbers), batch.seconds)
        yield batch.rows


def rows_in_processes(run: StudyRun, queue: RowQueue, stay: str) -> Generator[tuple[StudyRow, ...]]:
    """Yield rows made in processes of this machine, in any order.

    `stay` says what becomes of them where a process ends early, and what to do.

    Raises
    ------
    BadInputError
        A process came to an end, as it does where a program begins a study whenever it is imported.
    """
    require_first_process()
    # in a file: a process that ends before it has read a long message would block this one
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "study.pickle"
        file.write_bytes(pack_run(run))
        try:
            yield from _handed_out(queue, str(file))
        except BrokenExecutor as error:
            raise process_ended(stay) from error


def _handed_out(queue: RowQueue, file: str) -> Generator[tuple[StudyRow, ...]]:
    """Hand batches out, a few at a time: no more results wait than are worked on."""
    pool = ProcessPoolExecutor(queue.sharers, get_context("spawn"), _begin, (file,))
    running = set[Future[RowBatch]]()
    try:
        while True:
            while len(running) < _AHEAD * queue.sharers and (numbers := queue.take()):
                running.add(pool.submit(_make, numbers))
            if not running:
                return
            done, running = wait(running, return_when=FIRST_COMPLETED)
            for each in done:
                batch = each.result()
                queue.learn(len(batch.rows), batch.seconds)
                yield batch.rows
    finally:
        pool.shutdown(cancel_futures=True)


def require_first_process() -> None:
    """Refuse to begin processes from one that was itself begun so.

    Raises
    ------
    BadInputError
        A program begins a study whenever it is imported.
    """
    if parent_process() is not None:
        raise process_ended()


def process_ended(stay: str = "") -> BadInputError:
    """Give the error for a process that ended, or began a study itself."""
    remedy = "begin the program under if __name__ == '__main__':, or give workers=1"
    return BadInputError(
        "a process of the study began another study, or came to an end", "in study",
        f"{remedy}; {stay}" if stay else remedy,
    )  # fmt: skip


_own: StudyRun | None = None
"""What a process of a study works on."""


def _begin(file: str) -> None:
    """Prepare a process; an interrupt is left to the process that began it."""
    global _own
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    one_thread()
    _own = unpack_run(Path(file).read_bytes())


def _make(numbers: tuple[int, ...]) -> RowBatch:
    """Make rows in a process that `_begin` has prepared."""
    assert _own is not None
    return make_batch(_own, numbers)
