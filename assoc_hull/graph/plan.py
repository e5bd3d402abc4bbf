"""The plan of an update: the closure of what an edit touches, an upper bound of the run."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.node import Network

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
    found = np.unique(seeds)
    front = found
    while len(front):
        front = np.setdiff1d(network.readers(front).reader, found)
        found = np.union1d(found, front)
    return found
