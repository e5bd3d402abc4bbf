"""Labels on a rail: moved apart until none covers another, as little as possible.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.numeric.interval_spacing import space_intervals
>>> space_intervals(np.array([0.0, 0.0, 9.0]), np.array([2.0, 2.0, 2.0])).tolist()
[-1.0, 1.0, 9.0]
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = ["space_intervals"]


def space_intervals(wanted: FloatArray, size: FloatArray, gap: float = 0.0) -> FloatArray:
    """Move intervals on a line apart, with the least sum of squared movements.

    Parameters
    ----------
    wanted : (k,)
        Where the middle of each would best lie; any order, which is kept (ties as given).
    size : (k,)
        Length of each.
    gap : float
        Least space between two neighbours.

    Returns
    -------
    (k,)
        The middles. Runs that touch are centred on their wanted places (pooled adjacent
        violators, the exact solution).
    """
    order = np.argsort(wanted, kind="stable")
    pitch = 0.5 * (size[order][1:] + size[order][:-1]) + gap
    before = np.concatenate([np.zeros(min(1, len(order))), np.cumsum(pitch)])
    target = np.asarray(wanted, np.float64)[order] - before
    pools: list[tuple[float, int]] = []
    for value in target.tolist():
        mean, count = value, 1
        while pools and pools[-1][0] > mean:
            other, members = pools.pop()
            mean = (mean * count + other * members) / (count + members)
            count += members
        pools.append((mean, count))
    flat = [np.full(count, mean) for mean, count in pools]
    found = np.empty(len(order))
    found[order] = np.concatenate([np.zeros(0), *flat]) + before
    return found
