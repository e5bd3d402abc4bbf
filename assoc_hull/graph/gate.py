"""A lock for a few statements, which an interrupt at any of them leaves open.

A ``with`` block of a lock has a place, between its last statement and the release, at which an
interrupt leaves the lock taken: every other thread would wait for ever.

Examples
--------
>>> from assoc_hull.graph.gate import Gate
>>> Gate().alone(lambda: 1 + 1)
2
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TypeVar

import attrs

__all__ = ["Gate"]

T = TypeVar("T")


@attrs.frozen(eq=False)
class Gate:
    """Lets one thread in at a time; what is done inside must not come to the gate again."""

    # A lock of this kind alone refuses to be released by a thread that has not taken it.
    _lock: threading.RLock = attrs.field(factory=threading.RLock, init=False)

    def __reduce__(self) -> tuple[type[Gate], tuple[()]]:
        # In another process, or in a copy, nobody is inside.
        return Gate, ()

    def alone(self, act: Callable[[], T]) -> T:
        """Do something while no other thread is inside."""
        try:
            with self._lock:
                return act()
        finally:
            try:  # noqa: SIM105  # `suppress` takes three times as long, thirty times an edit
                self._lock.release()
            except RuntimeError:  # it has been given back: the usual case
                pass
