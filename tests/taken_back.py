"""A hull that is dear to make, shared by tests that each edit it as if it were their own."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import assoc_hull as ah

__all__ = ["taken_back"]


@contextmanager
def taken_back(hull: ah.Hull) -> Iterator[ah.Hull]:
    """Take back, when the block ends, every edit that was made in it, to the last bit."""
    steps, start = len(hull.history), hull.fingerprint
    yield hull
    if len(hull.history) > steps:
        hull.undo(len(hull.history) - steps)
    assert hull.fingerprint == start
