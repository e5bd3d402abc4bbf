"""The cells of a net: what its edges enclose, found by walking round along half-edges."""

from __future__ import annotations

from functools import cached_property

import attrs
import numpy as np

from assoc_hull.geometry.curves import IntArray, freeze
from assoc_hull.surface.cells.net_graph import NetGraph
from assoc_hull.surface.cells.normals import edge_angles
from assoc_hull.surface.cells.soundness import check_faces, check_lines, check_outline

__all__ = ["Cells", "cells", "following", "loops", "origins"]


@attrs.frozen(eq=False)
class Cells:
    """The cells of a net.

    Half-edge 2 e is the edge e in the sense of its curve, 2 e + 1 the same edge back.

    Attributes
    ----------
    graph : NetGraph
        Nodes and edges.
    start : (c + 1,) int
        Where the half-edges of each cell begin.
    half : (h,) int
        The half-edges round each cell, counter-clockwise seen from outside the hull.
    outline : (k,) int
        The half-edges with nothing on their left, in the order in which they follow each other:
        the border of the half hull, with the hull to the right.
    notes : tuple of str
        What was done to lines that do not part the hull into cells as they are.
    """

    graph: NetGraph
    start: IntArray
    half: IntArray
    outline: IntArray
    notes: tuple[str, ...] = ()

    def __attrs_post_init__(self) -> None:
        freeze(self.start, self.half, self.outline)

    @property
    def count(self) -> int:
        """Number of cells."""
        return len(self.start) - 1

    @property
    def sides(self) -> IntArray:
        """How many edges each cell has, (c,)."""
        return np.diff(self.start)

    @cached_property
    def cell_of(self) -> IntArray:
        """The cell to the left of each half-edge, (2 e,); -1 outside."""
        found = np.full(2 * len(self.graph.edge), -1, np.int64)
        found[self.half] = np.repeat(np.arange(self.count), self.sides)
        return found

    def nodes(self, cell: int) -> IntArray:
        """Give the nodes round one cell, beginning with that of its first half-edge."""
        return origins(self.graph)[self.half[self.start[cell] : self.start[cell + 1]]]


def origins(graph: NetGraph) -> IntArray:
    """Give the node at which each half-edge begins, (2 e,)."""
    return graph.edge.ravel()


def following(graph: NetGraph) -> IntArray:
    """Give the half-edge that comes next round the face to the left of each half-edge, (2 e,).

    At its end it is the neighbour, clockwise, of the half-edge itself turned round.
    """
    node = origins(graph)
    angle = edge_angles(graph.normal, graph.edge, graph.leave)
    order = np.lexsort((angle, node))
    first = np.append(True, np.diff(node[order]) != 0)
    start = np.flatnonzero(first)
    size = np.diff(np.append(start, len(order)))
    # The neighbour clockwise has the next smaller angle; before the smallest comes the largest.
    before = np.arange(-1, len(order) - 1)
    before[start] = start + size - 1
    clockwise = np.empty(len(order), np.int64)
    clockwise[order] = order[before]
    return np.asarray(clockwise[np.arange(len(order)) ^ 1])


def loops(following: IntArray) -> tuple[IntArray, IntArray]:
    """Give the cycles of a permutation: where each begins, and its members one after another."""
    count = len(following)
    after = following.tolist()
    seen = [False] * count
    start, member = [0], []
    for first in range(count):
        if seen[first]:
            continue
        at = first
        while not seen[at]:
            seen[at] = True
            member.append(at)
            at = after[at]
        start.append(len(member))
    return np.array(start, np.int64), np.array(member, np.int64)


def cells(graph: NetGraph) -> Cells:
    """Find the cells of a net.

    Parameters
    ----------
    graph : NetGraph
        Nodes and edges.

    Returns
    -------
    Cells
        Each but the longest loop, which goes round the outside.

    Raises
    ------
    OpenNetError
        Lines end nowhere or do not hang together, crossings are missing, or there is more than
        one outer face.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.analysis.net.gather import gather
    >>> from assoc_hull.surface.cells.faces import cells
    >>> from assoc_hull.surface.cells.net_graph import net_graph
    >>> found = cells(net_graph(gather(ah.examples.wigley().state)))
    >>> found.count, len(found.outline)
    (220, 62)
    """
    check_lines(graph)
    start, member = loops(following(graph))
    check_faces(graph, len(start) - 1)
    length = np.add.reduceat(graph.length[member >> 1], start[:-1])
    outer = int(length.argmax())
    check_outline(graph, member[start[outer] : start[outer + 1]])
    inside = np.ones(len(member), bool)
    inside[start[outer] : start[outer + 1]] = False
    sides = np.delete(np.diff(start), outer)
    return Cells(
        graph,
        np.concatenate([[0], np.cumsum(sides)]),
        member[inside],
        member[~inside],
    )
