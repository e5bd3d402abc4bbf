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

__all__ = ["PausedCollector", "freeze_loaded_objects"]


class PausedCollector:
    """Holds the collector off; may be entered again inside, and leaves it as it was."""

    def __init__(self) -> None:
        self._was: list[bool] = []

    def __enter__(self) -> None:
        self._was.append(gc.isenabled())
        gc.disable()

    def __exit__(self, *_: object) -> None:
        if self._was and self._was.pop():  # empty where entering was broken off
            gc.enable()


def freeze_loaded_objects() -> None:
    """Take all that has been loaded out of the collector's sight; to be called after a load.

    What is there now stays, as a hull does; later collections then look at new objects only.
    """
    gc.collect()
    gc.freeze()
