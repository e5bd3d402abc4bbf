"""The plan of an update: the closure of what an edit touches, an upper bound of the run."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.node import Network, distinct

__all__ = ["closure"]


def closure(network: Network, seeds: IntArray) -> IntArray:
    """Give all nodes that are made from the seeds, at any distance, and the seeds.

    Parameters
    ----------
    network : Network
        Who reads whom.
    seeds : (k,) int
        Nodes that an edit sets or evaluates.

    Returns
    -------
    (n,) int
        Ascending. No run from these seeds evaluates any other node in its main pass.
    """
    found = front = distinct(seeds)
    while len(front):
        reached = distinct(network.readers(front).reader)
        place = found.searchsorted(reached)
        front = reached[found.take(place, mode="clip") != reached]
        found = distinct(np.concatenate([found, front]))
    return found
