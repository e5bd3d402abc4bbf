"""The edits of one hull made again on another.

Examples
--------
>>> from assoc_hull.edit.document import Document
>>> from assoc_hull.edit.replay import replay
>>> from assoc_hull.edit.session import Edit
>>> from assoc_hull.shipped.wigley import wigley
>>> one, other = Document(wigley()), Document(wigley(breadth=11.0))
>>> with Edit(one, "fuller") as edit:
...     edit.move("WL 2.5 x ST 7", y=2.95)
>>> [str(each) for each in replay(other, one.history)]
['fuller: made again']
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs

from assoc_hull.edit.document import Document
from assoc_hull.edit.report import EditReport
from assoc_hull.edit.script import carry_out, settings_of
from assoc_hull.edit.session import Edit
from assoc_hull.edit.step import Step
from assoc_hull.errors import AssocHullError

__all__ = ["Replayed", "replay"]

_UNKNOWN = "it was given a function, or was not made through the public methods: nothing tells it"


@attrs.frozen
class Replayed:
    """What became of one edit.

    Attributes
    ----------
    name : str
        Name of the edit.
    report : EditReport or None
        Its report on this hull; None if it was not made.
    why : str
        Why it was not made.
    """

    name: str
    report: EditReport | None
    why: str = ""

    def __str__(self) -> str:
        return f"{self.name}: {'made again' if self.report else self.why}"


def replay(
    document: Document, steps: Sequence[Step], *, skip: bool = False
) -> tuple[Replayed, ...]:
    """Make edits again, each as one step, in their order.

    Parameters
    ----------
    document : Document
        The hull.
    steps : sequence of Step
        The edits, of this or another hull; objects are found by their addresses.
    skip : bool
        Go on behind an edit that cannot be made; else stop there.

    Returns
    -------
    tuple of Replayed
        One for each edit that was tried.
    """
    found: list[Replayed] = []
    for step in tuple(steps):  # on the same hull, the history grows meanwhile
        found.append(_again(document, step))
        if found[-1].report is None and not skip:
            break
    return tuple(found)


def _again(document: Document, step: Step) -> Replayed:
    script = step.script
    if not script.repeatable:
        return Replayed(step.name, None, _UNKNOWN)
    try:
        with Edit(document, step.name, settings_of(script.policy, script.gaps)) as edit:
            carry_out(edit, script.edits)
    except AssocHullError as error:
        return Replayed(step.name, None, str(error))
    return Replayed(step.name, edit.report)
