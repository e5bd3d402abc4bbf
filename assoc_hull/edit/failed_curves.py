"""Failed and blocked objects, when an edit was told to go on past a curve that fails.

A failed curve keeps its last good shape; what is made from it is blocked, and stays so over
later edits until the curve can be lofted again.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.run_update import UpdatePass
from assoc_hull.model.kinds import State
from assoc_hull.model.network import HullNetwork
from assoc_hull.model.node import Node

__all__ = ["blocked_nodes", "note_states"]


def blocked_nodes(network: HullNetwork, failed: tuple[int, ...]) -> IntArray:
    """Give all nodes made from failed curves, at any distance, ascending."""
    found = np.zeros(0, np.int64)
    front = Node.curve(np.array(failed, np.int64))
    while len(front):
        front = np.setdiff1d(network.readers(front).reader, found)
        found = np.union1d(found, front)
    return found


def note_states(network: HullNetwork, result: UpdatePass, journal: Journal) -> None:
    """Write which curves have failed, which are well again, and what is blocked now."""
    state = network.state
    broken = {Node.number(node) for node in result.failed if Node.is_curve(node)}
    curves = result.evaluated[Node.is_curve(result.evaluated)]
    mended = set(Node.number(curves).tolist()) - broken
    # A curve that was removed with its line has failed no more.
    there = [curve for curve in set(state.failed) | broken if state.curves.alive[curve]]
    failed = tuple(sorted(set(there) - mended))
    if failed == state.failed:
        return
    before = blocked_nodes(network, state.failed)
    after = blocked_nodes(network, failed)
    journal.set(state.settings.failed, [0], [failed])
    journal.put(state.curves.state, sorted(mended), int(State.CLEAN))
    for nodes, value in ((np.setdiff1d(before, after), State.CLEAN), (after, State.BLOCKED)):
        odd = Node.is_curve(nodes)
        journal.put(state.curves.state, Node.number(nodes[odd]), int(value))
        journal.put(state.rows.state, Node.number(nodes[~odd]), int(value))
    journal.put(state.curves.state, sorted(broken), int(State.FAILED))
