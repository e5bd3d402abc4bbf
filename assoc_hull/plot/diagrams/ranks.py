"""Places for the nodes of a graph that stand in columns, by blocks."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Sequence
from typing import TypeVar

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.sheet.paper import Paper

__all__ = ["MARGIN", "TALL", "WIDE", "stand"]

N = TypeVar("N", bound=Hashable)

MARGIN = 10.0
"""Of the sheet, mm at A3; so are the other lengths."""

WIDE, TALL = 26.0, 2.9
"""Size of a node."""

_HEAD = 11.0  # for the title
_LEAST, _MOST = 3.7, 8.0  # between two nodes
_BLOCK = 2.0  # nodes' room that is left between two blocks


def stand(paper: Paper, columns: Sequence[Sequence[Sequence[N]]]) -> dict[N, FloatArray]:
    """Stand nodes in columns, block above block, each column in the middle of the sheet.

    Parameters
    ----------
    paper : Paper
        The sheet.
    columns : sequence of columns, each a sequence of blocks, each a sequence of nodes
        From left to right, from below upward. A column that is too long becomes several.

    Returns
    -------
    dict
        The middle of each node, (2,), mm.
    """
    factor = paper.factor
    tall = paper.height - (2.0 * MARGIN + _HEAD) * factor
    most = int(tall / (_LEAST * factor)) - 2
    rows = [part for column in columns for part in _parts(list(_steps(column)), most)]
    width = (paper.width - (2.0 * MARGIN + WIDE) * factor) / max(len(rows) - 1, 1)
    left = (MARGIN + 0.5 * WIDE) * factor if len(rows) > 1 else 0.5 * paper.width
    found = {}
    for i, row in enumerate(rows):
        high = sum(step for _, step in row)
        step = min((tall - 5.0 * factor) / max(high, 1.0), _MOST * factor)
        y = MARGIN * factor + 0.5 * (tall - step * high)
        for node, ahead in row:
            y += step * ahead
            found[node] = np.array([left + i * width, y])
    return found


def _steps(column: Sequence[Sequence[N]]) -> Iterator[tuple[N, float]]:
    """Give each node with its distance from the one below, in nodes' room."""
    for k, block in enumerate(column):
        for i, node in enumerate(block):
            yield node, 1.0 + (_BLOCK if k and not i else 0.0)


def _parts(steps: list[tuple[N, float]], most: int) -> list[list[tuple[N, float]]]:
    """Divide a column into equal ones that are not too long."""
    count = max(1, -(-len(steps) // most))
    size = max(1, -(-len(steps) // count))
    return [steps[i : i + size] for i in range(0, len(steps), size)]
