"""Rows made by the workers of a Dask cluster: on this machine, or on many.

The hull and the design are sent to each worker once, which prepares them once; then batches of
numbers go out, and rows come back as they are made. A worker that dies takes its batches with it,
and the scheduler has them made by others. Where the scheduler goes away, that is told.
"""

from __future__ import annotations

import hashlib
import logging
import math
import os
import pickle
import signal
import tempfile
import time
import uuid
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from queue import Empty, SimpleQueue
from typing import TYPE_CHECKING

import attrs

from assoc_hull.arguments import shown
from assoc_hull.edit.garbage_collection import PausedCollector
from assoc_hull.errors import (
    BadInputError,
    ClusterError,
    MissingExtraError,
    WrongTypeError,
)
from assoc_hull.geometry.numeric.blas_threads import one_thread
from assoc_hull.graph.derived import Gate
from assoc_hull.study.run import StudyRow, StudyRun
from assoc_hull.study.side_processes import (
    RowBatch,
    RowQueue,
    make_batch,
    pack_run,
    process_ended,
    require_first_process,
    unpack_run,
    versions,
)

if TYPE_CHECKING:
    from distributed import Client, Future, LocalCluster

__all__ = ["LOCAL", "dask_setup", "open_cluster", "rows_on_cluster"]

LOCAL = "local"
"""Names a cluster of processes of this machine."""

_WHERE = "in study"
_AHEAD = 3
"""Batches handed out for each thread of a worker."""

_TRIES = 5
"""So often a batch is handed out anew whose workers have died."""

_PATIENCE, _LOOK, _ASK = 30.0, 0.5, 3.0
"""s: how long a worker is waited for; how often it is looked whether the scheduler is there, and
asked how many workers it has."""

_STALL, _SLOWER = 120.0, 10.0
"""One that says nothing is lost after so long, s, and so many times what the slowest batch took."""

_SETTINGS = {"distributed.worker.profile.enabled": False}
_THREADS = {"NUMBA_NUM_THREADS": "1"}
"""Of workers of this machine: no record of an hour of samples of what runs, which takes 0.4 MB for
each second, and one thread, to which Dask itself holds linear algebra."""


# --------------------------------------------------------------------------------------
# The cluster.


@contextmanager
def open_cluster(cluster: object, workers: int | None) -> Iterator[Client]:
    """Give a client of a cluster; what is begun for it ends with the block.

    Parameters
    ----------
    cluster : str or Client
        "local", the address of a scheduler, or a client of `distributed`, which stays open.
    workers : int or None
        Processes of a local one; a core each if None.

    Raises
    ------
    MissingExtraError
        Dask is not installed.
    ClusterError
        Nobody answers there.
    BadInputError, WrongTypeError
        Something else, or the number of workers of a cluster that has its own.
    """
    try:
        import distributed
    except ImportError:
        raise MissingExtraError("distributed", "cluster") from None
    local = isinstance(cluster, str) and cluster == LOCAL
    if not local and workers is not None:
        what = f"workers is {workers}, and the cluster has its own"
        raise BadInputError(what, _WHERE, "leave workers out, or give cluster='local'")
    if isinstance(cluster, distributed.Client):
        if cluster.asynchronous:
            what = "the client is an asynchronous one"
            raise BadInputError(what, _WHERE, "give a plain distributed.Client")
        yield cluster
    elif local:
        require_first_process()
        with (
            tempfile.TemporaryDirectory() as folder,
            _begun(workers or os.cpu_count() or 1, folder) as made,
            _client_of(made) as client,
        ):
            yield client
    elif isinstance(cluster, str):
        with _quiet(), _called(cluster) as client:
            yield client
    else:
        what = f"cluster is {shown(cluster)}"
        raise WrongTypeError(what, _WHERE, "give 'local', an address, or a distributed.Client")


def _begun(workers: int, folder: str) -> LocalCluster:
    """Begin processes of this machine."""
    import distributed

    try:
        return distributed.LocalCluster(
            n_workers=workers, threads_per_worker=1, processes=True, local_directory=folder,
            dashboard_address=":0", silence_logs=logging.ERROR, preload=__name__,
            config=_SETTINGS, env=_THREADS,
        )  # fmt: skip
    except RuntimeError as error:  # a process did not come up
        raise process_ended() from error


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep the client from printing what is told by an error."""
    logger = logging.getLogger("distributed.client")
    before = logger.level
    logger.setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        logger.setLevel(before)


def _client_of(cluster: LocalCluster) -> Client:
    """Give a client of processes of this machine."""
    import distributed

    with PausedCollector():  # as in `_called`
        return distributed.Client(cluster, set_as_default=False)


def _called(address: str) -> Client:
    """Call the scheduler at an address."""
    import distributed

    try:
        # A client that was lost ends itself when it is collected, under the lock that a new one
        # holds while it begins: the two would wait for one another for ever.
        with PausedCollector():
            return distributed.Client(address, timeout=_PATIENCE / 3.0, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        place, why = (" ".join(str(each).split())[:120] for each in (address, error))
        raise ClusterError(
            place, f"no scheduler answers ({why})",
            "begin one by `dask scheduler`, and give its address, as tcp://host:8786",
        ) from error  # fmt: skip


# --------------------------------------------------------------------------------------
# Handing out.


@attrs.define(eq=False)
class _Hands:
    """Batches that are on their way: `back` takes the futures that have come to an end."""

    client: Client
    queue: RowQueue
    packed: bytes
    stay: str
    key: str
    sent: Future | bytes | None = None
    running: dict[Future, tuple[int, ...]] = attrs.field(factory=dict)
    back: SimpleQueue[Future] = attrs.field(factory=SimpleQueue)
    lost: dict[int, int] = attrs.field(factory=dict)
    ask_at: float = -math.inf
    heard: float = attrs.field(factory=time.monotonic)
    slowest: float = 0.0

    def trouble(self, what: str, remedy: str) -> ClusterError:
        """Give the error that says what the cluster lacks."""
        address = str(getattr(self.client.scheduler, "address", None) or "the cluster")
        return ClusterError(address, what, f"{remedy}; {self.stay}")

    def gone(self) -> ClusterError:
        """Give the error for a scheduler that does not answer any more."""
        return self.trouble("the scheduler has gone away", "begin it again")

    def send_parent(self) -> None:
        """Send the hull and the design to each worker."""
        try:
            self.client.wait_for_workers(1, timeout=_PATIENCE)
            self.sent = self.client.scatter(self.packed, broadcast=True)
        except OSError as error:
            what = f"the cluster has no workers that answer within {_PATIENCE:g} s"
            raise self.trouble(what, "begin some") from error

    def hand_out(self) -> None:
        """Hand out batches, so many that no worker waits."""
        self.require_scheduler()
        self._count_threads()
        while len(self.running) < _AHEAD * self.queue.sharers and (numbers := self.queue.take()):
            future = self.client.submit(
                _make_at_worker, self.sent, self.key, numbers, pure=False,
                key=f"study-rows-{numbers[0]}-{uuid.uuid4().hex}",
            )  # fmt: skip
            self.running[future] = numbers
            future.add_done_callback(self.back.put)

    def _count_threads(self) -> None:
        """Ask now and then how many there are: workers come and go."""
        if time.monotonic() < self.ask_at:
            return
        try:
            self.queue.sharers = max(sum(self.client.nthreads().values()), 1)
        except OSError as error:
            raise self.gone() from error
        self.ask_at = time.monotonic() + _ASK

    def next_batch(self) -> tuple[StudyRow, ...]:
        """Wait for a batch; empty where it was lost, and is to be made again.

        Raises
        ------
        ClusterError, BadInputError
            The scheduler has gone, workers die again and again, or have other programs.
        """
        while True:
            try:
                future = self.back.get(timeout=_LOOK)
            except Empty:
                self.require_scheduler()
                if time.monotonic() - self.heard > _STALL + _SLOWER * self.slowest:
                    self._give_up_waiting()
                    return ()
            else:
                self.heard = time.monotonic()
                if future in self.running:  # else it was given up, and is made by others
                    return self._rows(future, self.running.pop(future))

    def _give_up_waiting(self) -> None:
        """Hand in all that is on its way: the scheduler knows of it, and nobody works on it.

        What was sent may have been lost with workers, and the scheduler not know it: from now on
        each batch brings the hull and the design along.
        """
        self.sent = self.packed
        silent, self.running = self.running, {}
        self.client.cancel(list(silent), force=True)
        self.heard = time.monotonic()
        for numbers in silent.values():
            self._hand_in(numbers, None)

    def require_scheduler(self) -> None:
        """Refuse to wait for a scheduler that has gone."""
        if self.client.status != "running":
            raise self.gone()

    def _rows(self, future: Future, numbers: tuple[int, ...]) -> tuple[StudyRow, ...]:
        """Take the rows of a batch that has come to an end."""
        from distributed import CancelledError, KilledWorker

        try:
            batch: RowBatch = future.result(timeout=_PATIENCE)
        except (CancelledError, KilledWorker, OSError) as error:
            if getattr(error, "reason", "") == "scheduler-connection-lost":
                raise self.gone() from error
            self.require_scheduler()
            self._hand_in(numbers, error)
            return ()
        except (ImportError, AttributeError) as error:
            what = f"its workers have another program ({' '.join(str(error).split())[:200]})"
            raise self.trouble(what, "install assoc-hull there as here") from error
        self.queue.learn(len(numbers), batch.seconds)
        self.slowest = max(self.slowest, batch.seconds)
        return batch.rows

    def _hand_in(self, numbers: tuple[int, ...], error: BaseException | None) -> None:
        """Take back a batch that was lost with its workers, and the parent if that was, too."""
        first = numbers[0]
        self.lost[first] = self.lost.get(first, 0) + 1
        if self.lost[first] > _TRIES:
            how = "said nothing" if error is None else "died"
            what = f"workers {how} {self.lost[first]} times over rows {first} to {numbers[-1]}"
            raise self.trouble(what, "see their logs, and their memory") from error
        self.queue.give_back(numbers)
        if self.sent is not self.packed and getattr(self.sent, "status", "") != "finished":
            self.send_parent()

    def drop(self) -> None:
        """Have no more batches made."""
        if self.client.status == "running" and self.running:
            self.client.cancel(list(self.running), force=True)
        self.running.clear()


def rows_on_cluster(
    run: StudyRun, queue: RowQueue, client: Client, stay: str
) -> Generator[tuple[StudyRow, ...]]:
    """Yield rows made by the workers of a cluster, in any order.

    Parameters
    ----------
    run : StudyRun
        The hull and the design.
    queue : RowQueue
        What is to be made.
    client : Client
        Of the cluster.
    stay : str
        What becomes of the rows that have been made if the cluster fails, and what to do.

    Raises
    ------
    ClusterError
        The scheduler has gone, or there are no workers, or they die again and again.
    BadInputError
        Workers have other versions of what makes the rows.
    """
    packed = pickle.dumps((versions(), pack_run(run)))
    hands = _Hands(client, queue, packed, stay, hashlib.sha256(packed).hexdigest())
    hands.send_parent()
    try:
        hands.hand_out()
        while hands.running:
            if rows := hands.next_batch():
                yield rows
            hands.hand_out()
    finally:
        hands.drop()


# --------------------------------------------------------------------------------------
# At the worker.


def dask_setup(worker: object) -> None:
    """Prepare a worker of this machine: an interrupt is left to the process that began it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


_gate = Gate()
"""Held while rows are made: a worker of several threads makes one batch at a time."""

_own: tuple[str, StudyRun] | None = None
"""What this worker works on, by its key."""


def _make_at_worker(packed: bytes, key: str, numbers: tuple[int, ...]) -> RowBatch:
    """Make rows, of what was sent; it is prepared once."""
    return _gate.alone(lambda: _make(packed, key, numbers))


def _make(packed: bytes, key: str, numbers: tuple[int, ...]) -> RowBatch:
    global _own
    with one_thread():
        if _own is None or _own[0] != key:
            theirs, given = pickle.loads(packed)
            _require_same(theirs)
            _own = key, unpack_run(given)
        return make_batch(_own[1], numbers)


def _require_same(theirs: dict[str, str]) -> None:
    """Refuse another program than asked: it might make other bits."""
    for name, ours in versions().items():
        if ours != theirs[name]:
            what = f"a worker has {name} {ours}, and {theirs[name]} began the study"
            remedy = "install the same there: other versions may make other last digits"
            raise BadInputError(what, _WHERE, remedy)
