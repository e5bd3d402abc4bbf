"""Threads that answer from copies of the hull, and are stopped in the middle of it.

An answer that is not wanted any more ends as Ctrl+C ends a script, between two steps of Python. A
library that is busy outside Python goes on until it comes back; nobody waits for these threads.
"""

from __future__ import annotations

import contextlib
import ctypes
import threading
from collections import deque
from collections.abc import Callable

import attrs

__all__ = ["CopyReaders"]


class _Stopped(BaseException):
    """Raised in a thread whose answer is not wanted any more; nobody may take it for an error."""


@attrs.frozen(eq=False)
class _Job:
    owner: object
    kind: object
    number: int
    act: Callable[[], None]


class CopyReaders:
    """A few threads, and what waits for them; of each owner and kind there is one job at most.

    Parameters
    ----------
    name : str
        Of the threads.
    count : int
        How many there are; each is started when it is first needed.
    """

    def __init__(self, name: str, count: int) -> None:
        self._name, self._count = name, count
        self._waiting = deque[_Job]()
        self._running = dict[int, _Job]()
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
            self._threads = [each for each in self._threads if each.is_alive()]
            idle = len(self._threads) - len(self._running)
            if idle < len(self._waiting) and len(self._threads) < self._count:
                thread = threading.Thread(target=self._work, name=self._name, daemon=True)
                self._threads.append(thread)
                thread.start()
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
        for thread, job in self._running.items():
            if wanted(job):
                ctypes.pythonapi.PyThreadState_SetAsyncExc(
                    ctypes.c_ulong(thread), ctypes.py_object(_Stopped)
                )

    def _work(self) -> None:
        me, on = threading.get_ident(), True
        while on:
            # It may also come when the job is just done.
            with contextlib.suppress(_Stopped):
                on = self._serve(me)

    def _serve(self, me: int) -> bool:
        """Do the next job; tells whether there may be more."""
        with self._awake:
            self._running.pop(me, None)
            self._awake.wait_for(lambda: self._waiting or not self._open)
            if not self._open:
                return False
            job = self._running[me] = self._waiting.popleft()
        job.act()
        return True
