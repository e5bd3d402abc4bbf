"""Corners of neighbouring lines joined to knuckle lines.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.polylines.corners import Corner
>>> from assoc_hull.geometry.polylines.knuckle_lines import join_corners
>>> lines = [[Corner(1.0, np.array([5.0, 2.0 + 0.1 * i]), 6.0, 0.9, 0.6)] for i in range(4)]
>>> join_corners(np.array([0.0, 2.0, 4.0, 6.0]), lines)
[((0, 0), (1, 0), (2, 0), (3, 0))]
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.corners import Corner

__all__ = ["ChainRule", "join_corners"]


@attrs.frozen
class ChainRule:
    """What counts as a knuckle line.

    Attributes
    ----------
    lines : int
        Neighbouring lines that must agree.
    drift : float
        How far a knuckle may move from line to line, as a part of their distance ...
    slack : float, m
        ... plus this; beyond three lines it is measured from where the last two lead.
    ratio : float
        By which factor its turn may change.
    """

    lines: int = 3
    drift: float = 0.5
    slack: float = 0.3
    ratio: float = 1.6


def join_corners(
    offsets: FloatArray, corners: list[list[Corner]], rule: ChainRule | None = None
) -> list[tuple[tuple[int, int], ...]]:
    """Join corners of neighbouring lines.

    Parameters
    ----------
    offsets : (n,), m
        Places of the lines, ascending.
    corners : list of list of Corner
        Of each line.
    rule : ChainRule or None
        Defaults if None.

    Returns
    -------
    list of tuple of (int, int)
        Per knuckle line the corners, as (line, number on it); each corner is in one at most.
    """
    wanted = rule or ChainRule()
    chains: list[list[tuple[int, int]]] = []
    for line in range(len(offsets)):
        open_ends = [chain for chain in chains if chain[-1][0] == line - 1]
        pairs = [
            (away, i, j)
            for i, chain in enumerate(open_ends)
            for j, corner in enumerate(corners[line])
            if (away := _misfit(chain, corner, line, offsets, corners, wanted)) < 1.0
        ]
        taken: set[int] = set()
        grown: set[int] = set()
        for _, i, j in sorted(pairs):
            if i not in grown and j not in taken:
                open_ends[i].append((line, j))
                grown.add(i)
                taken.add(j)
        chains += [[(line, j)] for j in range(len(corners[line])) if j not in taken]
    return [tuple(chain) for chain in chains if len(chain) >= wanted.lines]


def _misfit(
    chain: list[tuple[int, int]],
    corner: Corner,
    line: int,
    offsets: FloatArray,
    corners: list[list[Corner]],
    rule: ChainRule,
) -> float:
    """Give the distance from where a chain leads, as a part of what is allowed."""
    last = corners[chain[-1][0]][chain[-1][1]]
    low, high = sorted((last.turn_deg, corner.turn_deg))
    if high > rule.ratio * low + 1.0:
        return np.inf
    gap = float(offsets[line] - offsets[line - 1])
    guess = last.place
    if len(chain) > 1:
        before = corners[chain[-2][0]][chain[-2][1]]
        step = float(offsets[line - 1] - offsets[chain[-2][0]])
        guess = last.place + (last.place - before.place) * min(gap / step, 2.0)
    away = min(float(np.linalg.norm(corner.place - guess)),
               float(np.linalg.norm(corner.place - last.place)))  # fmt: skip
    return away / (rule.drift * gap + rule.slack)
