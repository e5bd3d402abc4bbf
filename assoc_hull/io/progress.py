"""How long work says how far it is: a callable that whoever waits may hand in."""

from __future__ import annotations

from collections.abc import Callable

__all__ = ["Tell", "silent"]

Tell = Callable[[str, int, int], None]
"""Takes what is being done, how many parts of it are done, and of how many; 0 if unknown."""


def silent(what: str, done: int, of: int) -> None:
    """Tell nobody.

    Examples
    --------
    >>> from assoc_hull.io.progress import silent
    >>> silent("cutting", 3, 73)
    """
