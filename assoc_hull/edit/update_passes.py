"""One update while it runs: its passes, and what is found on the way."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.edit.checks.update_findings import WideGaps
from assoc_hull.edit.document import Document
from assoc_hull.edit.failed_curves import blocked_nodes, note_states
from assoc_hull.edit.pending_changes import Pending, Settings
from assoc_hull.errors import RefusedEditError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.run_update import UpdatePass, run_update
from assoc_hull.model.network import HullNetwork
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState

__all__ = ["Work"]

_NONE: IntArray = np.zeros(0, np.int64)


@attrs.define(eq=False)
class Work:
    """One update while it runs.

    Attributes
    ----------
    document, name, journal, pending, settings : Document, str, Journal, Pending, Settings
        What is updated, and how.
    network : HullNetwork
        The hull as the engine sees it.
    passes : list of UpdatePass
        Those that have run.
    born, gone, mended : list of str
        Keys of crossings that came or went, and of curves that were given a point.
    ends : list of (int, int)
        Ends of lines that an alignment put at risk.
    seconds : dict of str to float
        Time per phase.
    failed : dict of int to str
        Nodes that could not be made, and why.
    wide : WideGaps or None
        Gaps over their limit, when they have been measured.
    planned : int
        Curves that could at most be lofted in the main pass.
    watched : list of int
        Crossings that define no line any more, as others have passed them.
    forms : (k,) int
        Nodes of the definitions that the edit set; the first pass starts from them as well.
    """

    document: Document
    name: str
    journal: Journal
    pending: Pending
    settings: Settings
    network: HullNetwork
    passes: list[UpdatePass] = attrs.field(factory=list)
    born: list[str] = attrs.field(factory=list)
    gone: list[str] = attrs.field(factory=list)
    mended: list[str] = attrs.field(factory=list)
    ends: list[tuple[int, int]] = attrs.field(factory=list)
    seconds: dict[str, float] = attrs.field(factory=dict)
    failed: dict[int, str] = attrs.field(factory=dict)
    wide: WideGaps | None = None
    planned: int = 0
    watched: list[int] = attrs.field(factory=list)
    forms: IntArray = attrs.field(factory=lambda: _NONE)

    @property
    def state(self) -> HullState:
        """The tables."""
        return self.document.state

    def evaluated(self) -> IntArray:
        """Curves evaluated in any pass, in order, each once."""
        nodes = np.concatenate([_NONE, *(part.evaluated for part in self.passes)])
        curves = Node.number(nodes[Node.is_curve(nodes)])
        if len(self.passes) == 1:
            return curves  # in one pass no node stands twice
        once: IntArray = curves[np.sort(np.unique(curves, return_index=True)[1])]
        return once

    def changed_points(self) -> IntArray:
        """Points that changed in any pass; one may stand more than once."""
        changed = np.concatenate([_NONE, *(part.changed for part in self.passes)])
        return Node.number(changed[Node.is_point(changed)])

    def touched(self) -> IntArray:
        """Curves evaluated in any pass or made in this edit, but for those removed since."""
        fresh = np.array(self.pending.fresh, np.int64)
        curves = np.concatenate([self.evaluated(), fresh]) if len(fresh) else self.evaluated()
        alive: IntArray = curves[self.state.curves.alive[curves]]
        return alive

    def go(self, rows: IntArray, curves: IntArray) -> None:
        """Run one pass from points that were set and curves whose recipe changed."""
        if self.pending.stopped():
            raise RefusedEditError(self.name, ("it was stopped",))
        seeds = Node.point(rows)
        if not self.passes:
            seeds = np.concatenate([seeds, self.forms])
            self.planned = self.network.reached(np.concatenate([seeds, Node.curve(curves)]))
        carried = np.array(sorted(self.pending.held), np.int64)
        held = Node.point(carried)
        blocked = blocked_nodes(self.network, self.state.failed)
        result = run_update(
            self.network, seeds, self.journal, self.settings.policy,
            also=self._also(curves), held=np.concatenate([held, blocked]),
        )  # fmt: skip
        self.passes.append(result)
        self.failed |= result.failed
        self._refuse_unmade(result)
        note_states(self.network, result, self.journal)
        freed = blocked
        if len(blocked):
            freed = np.setdiff1d(blocked, blocked_nodes(self.network, self.state.failed))
        if len(freed):
            self.passes.append(
                run_update(
                    self.network, _NONE, self.journal, self.settings.policy, also=freed, held=held
                )
            )

    def _refuse_unmade(self, result: UpdatePass) -> None:
        """Points that no definition can give refuse the edit: they have no last good place.

        What the tables held would be neither what the definitions say nor what was drawn.
        """
        for node, why in result.failed.items():
            if not Node.is_curve(node):
                raise RefusedEditError(self.name, (why,))

    def _also(self, curves: IntArray) -> IntArray:
        """Give the nodes to evaluate although nothing they read has changed; each only once."""
        rows, table = np.array(sorted(self.pending.computed), np.int64), self.state.rows
        self.pending.computed.clear()
        rows = rows[table.alive[rows] & (table.driver[rows] >= 0)]
        return np.concatenate([Node.curve(curves), Node.point(rows)])

    def renew(self) -> None:
        """Derive the look-ups anew after crossings or points came or went."""
        self.pending.structural = True
        self.document.refresh()
        self.network.index = self.document.index
