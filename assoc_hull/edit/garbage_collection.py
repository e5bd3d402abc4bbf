"""No garbage collection in the middle of an edit.

A collection of all generations takes tens of milliseconds in a large hull, hundreds of
times as long as the drag it falls into. Nothing that an edit makes is held by a ring of
references, so nothing is lost by waiting until it is over.

Examples
--------
>>> import gc
>>> from assoc_hull.edit.garbage_collection import PausedCollector
>>> with PausedCollector():
...     gc.isenabled()
False
>>> gc.isenabled()
True
"""

from __future__ import annotations

import gc
from typing import ClassVar
from weakref import WeakSet

__all__ = ["PausedCollector", "freeze_loaded_objects"]


class PausedCollector:
    """Holds the collector off while any pause stands, and then leaves it as it was.

    An interrupt may come at any line, also of a pause itself: what it leaves off is known to the
    class, and the end of the next pause turns it on again.
    """

    # One that was broken off dies, and is out.
    _standing: ClassVar[WeakSet[PausedCollector]] = WeakSet()
    _off: ClassVar[bool] = False  # whether the collector was turned off here

    def __enter__(self) -> None:
        own = PausedCollector
        if not own._standing:
            own._off = own._off or gc.isenabled()
        own._standing.add(self)
        gc.disable()

    def __exit__(self, *_: object) -> None:
        own = PausedCollector
        own._standing.discard(self)
        if own._off and not own._standing:
            gc.enable()
            own._off = False


def freeze_loaded_objects() -> None:
    """Take all that has been loaded out of the collector's sight; to be called after a load.

    What is there now stays, as a hull does; later collections then look at new objects only.
    """
    gc.collect()
    gc.freeze()
