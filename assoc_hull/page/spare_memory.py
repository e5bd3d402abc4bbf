"""Memory that nothing needs any more goes back to the system, while nobody waits.

The reader threads of a session work with large arrays on copies of the hull. A copy that was
measured knows its flotation, and that its copy: such a ring goes with a full collection only, which
Python makes rarely. What it frees the allocator of glibc keeps, in many pieces. On Series 60 both
took 6 MB for each edit that was followed by hydrostatics, without end.
"""

from __future__ import annotations

import ctypes
import gc
import sys
import time
from collections.abc import Callable

import attrs

__all__ = ["SpareMemory"]

_REST = 5.0  # s between two times that it is given back: that takes up to 0.1 s


def _find_trim() -> Callable[[int], int] | None:
    """Give what hands memory back; None where the allocator does so itself."""
    if not sys.platform.startswith("linux"):
        return None
    try:
        found: Callable[[int], int] = ctypes.CDLL(None).malloc_trim
    except (OSError, AttributeError):  # musl, as in Alpine, has none and needs none
        return None
    return found


@attrs.define
class SpareMemory:
    """Gives memory back after work, now and then."""

    used: bool = False
    _last: float = attrs.field(factory=lambda: time.monotonic())
    _trim: Callable[[int], int] | None = attrs.field(factory=_find_trim)

    def give_back(self) -> bool:
        """Give back what is free, if there was work since and time for it; tells whether."""
        now = time.monotonic()
        if not self.used or now - self._last < _REST:
            return False
        self.used, self._last = False, now
        gc.collect()
        if self._trim is not None:
            self._trim(0)
        return True
