"""A study from its first row to its last: rows are made somewhere, and land in a table.

Whoever makes them (`side_processes`, `dask_cluster`), they come here in batches, and a table
takes each row once. What has landed is not made again, so a study that was broken off goes on where
it stopped, and has the rows of one that was not.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Generator, Sequence
from contextlib import ExitStack
from typing import Protocol

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.numeric.blas_threads import one_thread
from assoc_hull.study.dask_cluster import open_cluster, rows_on_cluster
from assoc_hull.study.run import StudyRow, StudyRun
from assoc_hull.study.side_processes import MOST_ROWS, RowQueue, rows_here, rows_in_processes

__all__ = ["RowTable", "Tell", "run_study"]

Tell = Callable[[str, int, int], None]
"""Takes what is being done, how many variants are done, and of how many."""

_FAR = 2.0
"""s that a batch on a cluster is to take: messages go far."""

_WARM = 3.0
"""s after which it is told how fast rows are made."""


class RowTable(Protocol):
    """Where rows land."""

    @property
    def patience(self) -> float:
        """For how long rows may be kept back, s, before they land together."""
        ...

    @property
    def stay(self) -> str:
        """What becomes of its rows where a study fails, and what to do."""
        ...

    def landed(self) -> NDArray[np.bool_]:
        """Tell for each row whether it is there, (n,)."""
        ...

    def land(self, rows: Sequence[StudyRow]) -> None:
        """Take rows, all or none; one that is there already stays as it is."""
        ...


def run_study(
    run: StudyRun,
    table: RowTable,
    *,
    workers: int | None = None,
    cluster: object = None,
    tell: Tell | None = None,
) -> bool:
    """Make all variants that have not landed yet.

    Parameters
    ----------
    run : StudyRun
        The hull and the design.
    table : RowTable
        Where rows land, in the order in which they are made.
    workers : int or None
        Processes; with one, all is done in this one.
    cluster : str, Client or None
        Of Dask; see `open_cluster`.
    tell : callable or None
        Called with "variants", and how fast they are made; how many are done; and of how many.

    Returns
    -------
    bool
        Whether it was interrupted: then rows are missing.

    Raises
    ------
    BadInputError, ClusterError
        Processes came to an end, or the cluster failed. What was made has landed.
    """
    there = table.landed()
    queue = RowQueue(np.flatnonzero(~there), workers or 1)
    landing = _Landing(table, tell, len(there), int(there.sum()))
    if not len(queue.left):
        return False
    with one_thread(), ExitStack() as stack:
        try:
            made = _source(run, queue, table, workers, cluster, stack)
            stack.callback(made.close)
            for rows in made:
                landing.take(rows)
            landing.land()
        except KeyboardInterrupt:
            return True
        finally:
            landing.flush()
    return False


def _source(
    run: StudyRun,
    queue: RowQueue,
    table: RowTable,
    workers: int | None,
    cluster: object,
    stack: ExitStack,
) -> Generator[tuple[StudyRow, ...]]:
    """Choose who makes the rows."""
    if cluster is not None:
        queue.seconds = _FAR
        client = stack.enter_context(open_cluster(cluster, workers))
        return rows_on_cluster(run, queue, client, table.stay)
    if queue.sharers == 1:
        return rows_here(run, queue)
    return rows_in_processes(run, queue, table.stay)


@attrs.define(eq=False)
class _Landing:
    """Rows on their way into the table; `first` says when the first were there, and how many."""

    table: RowTable
    tell: Tell | None
    count: int
    done: int
    waiting: list[StudyRow] = attrs.field(factory=list)
    last: float = -np.inf
    first: tuple[float, int] | None = None

    def take(self, rows: tuple[StudyRow, ...]) -> None:
        """Take rows; let them land if they are many, or have waited."""
        patience = self.table.patience
        for part in (rows,) if patience else [(row,) for row in rows]:
            self.waiting += part
            if len(self.waiting) >= MOST_ROWS or time.monotonic() - self.last >= patience:
                self.land()

    def land(self) -> None:
        """Let all land that wait, and tell how many are there."""
        if self.waiting:
            self.flush()
            if self.tell is not None:
                self.tell(self._words(), self.done, self.count)

    def flush(self) -> None:
        """Let all land that wait."""
        if self.waiting:
            self.table.land(self.waiting)
            self.done += len(self.waiting)
            self.waiting = []
        self.last = time.monotonic()
        self.first = self.first or (self.last, self.done)

    def _words(self) -> str:
        """Say how fast it goes, and how long it will take."""
        start, before = self.first or (self.last, self.done)
        spent = self.last - start  # without what was prepared before the first rows
        if spent < _WARM:
            return "variants"
        pace = (self.done - before) / spent
        left = round((self.count - self.done) / pace)
        hours, minutes = divmod(left // 60, 60)
        clock = f"{hours}:{minutes:02}:{left % 60:02}"
        return f"variants, {pace:.3g} a second, {clock} left"
