"""Measuring side by side: the machine is shared, so only ratios of one run count.

Taken is the time of the processor. On a busy machine the wall time of a job depends on how
long it is: one of 4 ms ends before the system turns to somebody else, one of 7 ms does not.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from time import process_time
from typing import Literal

import attrs
import numpy as np

__all__ = ["Figure", "side_by_side"]


@attrs.frozen
class Figure:
    """One line of the table.

    Attributes
    ----------
    name : str
        What was measured.
    value : float
        The figure.
    unit : str
        Its unit; "x" for a ratio.
    goal : float or None
        What it should reach.
    sense : "least", "most" or "equal"
        Whether the goal is the least, the most or the only value allowed.
    """

    name: str
    value: float
    unit: str = "x"
    goal: float | None = None
    sense: Literal["least", "most", "equal"] = "least"

    @property
    def holds(self) -> bool:
        """Tell whether the goal is reached."""
        if self.goal is None:
            return True
        if self.sense == "equal":
            return self.value == self.goal
        return self.value >= self.goal if self.sense == "least" else self.value <= self.goal

    def cells(self) -> tuple[str, str, str, str]:
        """Give name, figure, goal and verdict for a table."""
        figure = f"{self.value:,.4g} {self.unit}"
        if self.goal is None:
            return self.name, figure, "", ""
        word = {"least": "at least", "most": "at most", "equal": "exactly"}[self.sense]
        return self.name, figure, f"{word} {self.goal:g} {self.unit}", "yes" if self.holds else "NO"


def side_by_side(
    jobs: Mapping[str, Callable[[], object]], rounds: int, repeats: Mapping[str, int] | None = None
) -> dict[str, float]:
    """Give the median time of the processor of each job, s, the jobs taking turns.

    Parameters
    ----------
    jobs : mapping of str to callable
        What to measure.
    rounds : int
        How many turns.
    repeats : mapping of str to int
        How often a short job runs in one turn; once if not named.
    """
    times: dict[str, list[float]] = {name: [] for name in jobs}
    for job in jobs.values():
        job()
    for _ in range(rounds):
        for name, job in jobs.items():
            for _ in range((repeats or {}).get(name, 1)):
                begin = process_time()
                job()
                times[name].append(process_time() - begin)
    return {name: float(np.median(taken)) for name, taken in times.items()}
