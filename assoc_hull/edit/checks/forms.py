"""Findings on definitions: lines that keep a shape of their own, against what defines them.

Nothing is wrong with such a line; but who changes a definition must know that it stays.
"""

from __future__ import annotations

from collections.abc import Iterator

from assoc_hull.edit.checks.finding import Finding
from assoc_hull.model.address import AddressBook
from assoc_hull.model.state import HullState

__all__ = ["find_detached"]

_MOST = 10
"""More lines than these are told in one finding."""

_TOLD = 3


def find_detached(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Tell, line by line, which are detached from the definitions; many of them at once.

    Examples
    --------
    >>> from assoc_hull.edit.checks.forms import find_detached
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.address import AddressBook
    >>> state = wigley(stations=5, waterlines=4)
    >>> list(find_detached(state, AddressBook(state)))
    []
    """
    live = set(state.live("curves").tolist())
    lost = [made for made in state.generated if not made.attached and made.curve in live]
    lines = {state.line_of(made.curve) for made in lost}
    names = sorted(book.line_name(line) for line in lines)
    if len(names) > _MOST:
        told = ", ".join(names[1 : 1 + _TOLD])
        text = (
            f"and {len(names) - 1} other lines ({told} ...) are detached from the definitions: "
            "their shape was edited since; edit.reattach returns one"
        )
        yield Finding("detached", names[0], None, float(len(names)), text)
        return
    for name in names:
        text = (
            "is detached from the definitions since its shape was edited: edit.reattach returns it"
        )
        yield Finding("detached", name, None, None, text)
