"""Threads that answer from copies of the hull, and are stopped in the middle of it.

An answer that is not wanted any more ends as Ctrl+C ends a script, between two steps of Python. A
library that is busy outside Python goes on until it comes back; nobody waits for these threads.
"""

from __future__ import annotations

import ctypes
import threading
from collections import deque
from collections.abc import Callable

import attrs

from assoc_hull.graph.derived import Gate

__all__ = ["CopyReaders"]


class _Stopped(BaseException):
    """Raised in a thread whose answer is not wanted any more; nobody may take it for an error."""


@attrs.define(eq=False)
class _Job:
    """What one thread does; it is ended once at most, and only inside `run`."""

    owner: object
    kind: object
    number: int
    act: Callable[[], None]
    _gate: Gate = attrs.field(factory=Gate, init=False)
    _thread: int | None = attrs.field(default=None, init=False)
    _wanted: bool = attrs.field(default=True, init=False)

    def run(self) -> None:
        """Do it, unless it was ended before; no exception that ends it leaves this body."""
        try:
            if not self._gate.alone(self._begin):
                return
            try:
                self.act()
            finally:  # what was to end it until here has come when this is passed
                self._gate.alone(self._leave)
        except _Stopped:
            return

    def _begin(self) -> bool:
        if self._wanted:
            self._thread = threading.get_ident()
        return self._wanted

    def _leave(self) -> None:
        self._thread = None

    def end(self) -> None:
        """End it, from another thread."""
        self._gate.alone(self._end)

    def _end(self) -> None:
        if self._wanted and self._thread is not None:
            ctypes.pythonapi.PyThreadState_SetAsyncExc(
                ctypes.c_ulong(self._thread), ctypes.py_object(_Stopped)
            )
        self._wanted = False


class CopyReaders:
    """A few threads, and what waits for them; of each owner and kind there is one job at most.

    Each job has a thread of its own, so that what ends it can come at no other place; those that
    wait for jobs, and hold what all share, are never ended so.

    Parameters
    ----------
    name : str
        Of the threads.
    count : int
        How many jobs run at once at most.
    """

    def __init__(self, name: str, count: int) -> None:
        self._name, self._count = name, count
        self._waiting = deque[_Job]()
        self._running = list[_Job]()
        self._threads = list[threading.Thread]()
        self._awake = threading.Condition()
        self._open = True

    def submit(self, owner: object, kind: object, number: int, act: Callable[[], None]) -> None:
        """Do something when a thread is free, in place of what its owner wanted of that kind."""
        with self._awake:
            self._end(lambda job: job.owner is owner and job.kind is kind)
            if not self._open:
                return
            self._waiting.append(_Job(owner, kind, number, act))
            idle = len(self._threads) - len(self._running)
            if idle < len(self._waiting) and len(self._threads) < self._count:
                self._threads.append(self._begin(self._serve))
            self._awake.notify()

    def stop(self, owner: object, number: int | None = None) -> None:
        """End what an owner waits for, or the job of that number, at once; from any thread."""
        with self._awake:
            self._end(lambda job: job.owner is owner and number in (None, job.number))

    def close(self) -> None:
        """End all jobs and the threads, and wait for none."""
        with self._awake:
            self._open = False
            self._end(lambda _: True)
            self._awake.notify_all()

    def _end(self, wanted: Callable[[_Job], bool]) -> None:
        self._waiting = deque(each for each in self._waiting if not wanted(each))
        for job in self._running:
            if wanted(job):
                job.end()

    def _begin(self, act: Callable[[], None]) -> threading.Thread:
        thread = threading.Thread(target=act, name=self._name, daemon=True)
        thread.start()
        return thread

    def _serve(self) -> None:
        """Do job after job, as long as there may be more."""
        while True:
            with self._awake:
                self._awake.wait_for(lambda: self._waiting or not self._open)
                if not self._open:
                    return
                job = self._waiting.popleft()
                self._running.append(job)
            self._begin(job.run).join()
            with self._awake:
                self._running.remove(job)
