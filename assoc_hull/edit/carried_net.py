"""What a mapping of the whole hull leaves to the update: adopted points, lines that come back."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import attrs
import numpy as np

from assoc_hull.edit.crossings.adopted_points import link_adopted_points
from assoc_hull.edit.modification import Modification, Work

__all__ = ["CarriedNet", "relink_adopted_points"]


@attrs.define(eq=False)
class CarriedNet(Modification):
    """What is done to a net that a mapping carries when its main pass has run.

    Attributes
    ----------
    relink : set of int
        Curves whose adopted points ride from where they and their neighbours are then.
    after : list of callable
        What is done to the structure then.
    """

    relink: set[int] = attrs.field(factory=set)
    after: list[Callable[[], None]] = attrs.field(factory=list)

    @property
    def idle(self) -> bool:
        """Whether nothing is to be done."""
        return not (self.relink or self.after)

    def follow(self, work: Work) -> None:
        """Link adopted points anew, and run a second pass for lines that come back."""
        relink_adopted_points(work, self.relink)
        if not self.after:
            return
        pending = work.pending
        pending.curves.clear()
        for act in self.after:
            act()
        work.link_riders()
        work.renew()
        live = [curve for curve in sorted(pending.curves) if work.state.curves.alive[curve]]
        work.go(np.zeros(0, np.int64), np.array(live, np.int64))
        work.settle()


def relink_adopted_points(work: Work, curves: Iterable[int]) -> None:
    """Let adopted points that were carried ride from where they and their neighbours are now."""
    chosen = np.array(sorted(curves), np.int64)
    chosen = chosen[work.state.curves.alive[chosen]]
    link_adopted_points(work.state, chosen, work.journal)
    if len(chosen):
        work.renew()
    work.pending.held.clear()
