"""Who keeps the committed steps of a hull beyond the life of the process: a hull file.

The document asks it before a step counts as committed, so that what is told to be committed is
kept; where it fails, the edit is taken back.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import attrs

from assoc_hull.edit.step import Step

__all__ = ["Keeper", "Label"]


@attrs.frozen
class Label:
    """A name for a state of the hull.

    Attributes
    ----------
    name : str
        The name.
    step : int
        Number of the step after which the hull is in this state; 0 as it came.
    branch : bool
        Whether it was given to undone steps when another edit was made in their place; else a
        checkpoint, that somebody asked for.
    author, time : str
        Who gave the name, and when: ISO 8601, UTC.
    """

    name: str
    step: int
    branch: bool = False
    author: str = attrs.field(default="", eq=False)
    time: str = attrs.field(default="", eq=False)


class Keeper(Protocol):
    """Keeps what is committed; every method raises, and keeps nothing of it, if it cannot."""

    def begin(self) -> None:
        """Take the right to write; nobody else has it until `end`."""

    def commit(self, step: Step, branch: Label | None) -> None:
        """Keep a step that was just made, and a name for the steps that it takes the place of."""

    def move(self, head: int, tip: int, steps: Sequence[Step], branch: Label | None) -> None:
        """Keep that the hull is now as after step `head`, where these steps were run."""

    def label(self, label: Label) -> None:
        """Keep a name."""

    def agree(self, steps: int) -> None:
        """Take note that what was kept last is in memory as well, where there are so many steps."""

    def end(self) -> None:
        """Give the right to write back; what was not kept by now is not kept."""
