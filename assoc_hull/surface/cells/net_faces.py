"""The cells of a net: what its edges enclose, and what is wrong where they enclose nothing.

Cells are found by walking round along half-edges, in the tangent planes of the nodes.
Lines at fault are named in the error: open ends, crossings without a row, more than one border.
`sound_cells` tries again with unlisted crossings before it refuses a net.
"""

from __future__ import annotations

from functools import cached_property

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.curve_net import CurveNet
from assoc_hull.errors import OpenNetError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.surface.cells.net_graph import (
    WIDE_CORNER,
    NetGraph,
    edge_angles,
    net_graph,
    node_normals,
)
from assoc_hull.surface.cells.net_nodes import REACH, merge_linked, unlisted_crossings

__all__ = [
    "NetCells",
    "check_faces",
    "check_lines",
    "check_outline",
    "find_cells",
    "half_edge_origins",
    "missed_crossings",
    "next_half_edges",
    "permutation_cycles",
    "sound_cells",
]


_FAR = 5e-3
"""So far apart (lengths of the hull) lines are named that may have been meant to cross."""


def check_lines(graph: NetGraph) -> None:
    """Refuse lines that enclose nothing, that end nowhere, and that do not hang together.

    Raises
    ------
    OpenNetError
        With the lines.
    """
    if not len(graph.edge):
        raise OpenNetError(
            "they cross nowhere, or enclose nothing", (),
            "a profile, a deck edge and sections are the least",
        )  # fmt: skip
    if len(graph.loose):
        raise OpenNetError(
            "lines end on no other line", _ends(graph.net, graph.loose),
            _where_to_end(graph.net, graph.loose[:, 0]),
        )  # fmt: skip
    part = merge_linked(len(graph.place), graph.edge)
    if (part != part[0]).any():
        size = np.bincount(part)
        lost = np.unique(graph.curve[part[graph.edge[:, 0]] != size.argmax()])
        raise OpenNetError(
            f"they fall into {np.count_nonzero(size)} parts that do not meet",
            tuple(graph.net.name[c] for c in lost.tolist()),
            "draw lines that cross both, or leave these out",
        )  # fmt: skip


def _where_to_end(net: CurveNet, loose: IntArray) -> str:
    """Say what to do about lines that end on no other line."""
    profile = net.end & net.centre
    if profile[loose].any():
        return (
            "where the hull ends in a flat plate, as a transom, end the profile at its foot: the "
            "plate goes on from there to the deck edge; else draw the line that they end on"
        )
    if profile.any():
        return "draw the line that they end on, or lead them to one"
    return (
        "the hull has no profile to end on: import her once more with one, of a table by a column "
        "'keel' that goes up to the deck at both ends, of lines by a curve called 'profile'"
    )


def check_faces(graph: NetGraph, start: IntArray, member: IntArray) -> None:
    """Refuse edges that cannot be drawn on half a hull without crossing one another.

    Faces are the `member` half-edges from each `start` to the next.

    Raises
    ------
    OpenNetError
        With crossings that the table does not hold; where there are none, with places that one
        face passes twice.
    """
    euler = len(graph.place) - len(graph.edge) + len(start) - 1
    if euler != 2:
        raise OpenNetError(
            f"lines pass one another and do not cross (nodes - edges + faces is {euler}, not 2)",
            missed_crossings(graph, _FAR) or _pinched(graph, start, member),
            "associate the groups of these lines, or leave one of them out",
        )


def _pinched(graph: NetGraph, start: IntArray, member: IntArray) -> tuple[str, ...]:
    """Name the lines that meet where a face passes a node twice: there edges lie across another."""
    face = np.repeat(np.arange(len(start) - 1), np.diff(start))
    node = half_edge_origins(graph)[member]
    key, count = np.unique(np.column_stack([face, node]), axis=0, return_counts=True)
    told = []
    for at in np.unique(key[count > 1, 1]).tolist():
        curves = np.unique(graph.curve[(graph.edge == at).any(axis=1)]).tolist()
        names = " x ".join(dict.fromkeys(graph.net.name[c] for c in curves))
        told.append(f"{names} at {_told(graph.place[at])}")
    return tuple(told)


def missed_crossings(graph: NetGraph, reach: float = REACH) -> tuple[str, ...]:
    """Name the lines that cross where the table holds no crossing, each pair once.

    Lines cross that are no farther apart than `reach`, in lengths of the hull. Borders of flats and
    knuckles are not looked at: their crossings are searched for anyway.
    """
    net = graph.net
    keep = np.isin(np.arange(net.batch.count), graph.curve)
    plain = keep & ~net.flat & ~net.knuckle
    found = unlisted_crossings(net, keep, np.flatnonzero(plain), reach)
    told: dict[tuple[int, ...], str] = {}
    # By gap: of each pair the closest place is named.
    for i in np.lexsort((found.pair[:, 1], found.pair[:, 0], found.gap)).tolist():
        a, b = sorted(found.pair[i].tolist())
        where = f"near {_told(found.xyz[i])}, {found.gap[i]:.3f} m apart"
        told.setdefault((a, b), f"{net.name[a]} x {net.name[b]} {where}")
    return tuple(told.values())


def check_outline(graph: NetGraph, outline: IntArray) -> None:
    """Refuse a half hull with more than one border.

    Raises
    ------
    OpenNetError
        With the boundary lines that lie within it.
    """
    inside = np.setdiff1d(np.flatnonzero(graph.net.end[graph.curve]), outline >> 1)
    if len(inside):
        curves = np.unique(graph.curve[inside]).tolist()
        raise OpenNetError(
            "there is more than one outer face; lines at which the hull ends lie within it",
            tuple(graph.net.name[c] for c in curves),
            "join them to the outer border: an end in a flat plate, as a transom, runs from the "
            "end of the profile to that of the deck edge and no farther; or make them knuckles",
        )  # fmt: skip


def _ends(net: CurveNet, loose: IntArray) -> tuple[str, ...]:
    knot = np.where(
        loose[:, 1] == 1, net.batch.start[loose[:, 0] + 1] - 1, net.batch.start[loose[:, 0]]
    )
    return tuple(
        f"{net.name[c]} at {_told(place)}"
        for c, place in zip(loose[:, 0].tolist(), net.batch.xyz[knot], strict=True)
    )


def _told(place: FloatArray) -> str:
    x, y, z = place.tolist()
    return f"({x:.3f}, {y:.3f}, {z:.3f}) m"


# --------------------------------------------------------------------------------------
# The cells.


@attrs.frozen(eq=False)
class NetCells:
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
        return half_edge_origins(self.graph)[self.half[self.start[cell] : self.start[cell + 1]]]


def half_edge_origins(graph: NetGraph) -> IntArray:
    """Give the node at which each half-edge begins, (2 e,)."""
    return graph.edge.ravel()


def next_half_edges(graph: NetGraph) -> IntArray:
    """Give the half-edge that comes next round the face to the left of each half-edge, (2 e,).

    At its end it is the neighbour, clockwise, of the half-edge itself turned round.
    """
    node = half_edge_origins(graph)
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


def permutation_cycles(following: IntArray) -> tuple[IntArray, IntArray]:
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


def find_cells(graph: NetGraph) -> NetCells:
    """Find the cells of a net.

    Parameters
    ----------
    graph : NetGraph
        Nodes and edges.

    Returns
    -------
    NetCells
        Each but the longest loop, which goes round the outside.

    Raises
    ------
    OpenNetError
        Lines end nowhere or do not hang together, crossings are missing, or there is more than
        one outer face.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.analysis.net.curve_net import gather_net
    >>> from assoc_hull.surface.cells.net_faces import find_cells
    >>> from assoc_hull.surface.cells.net_graph import net_graph
    >>> found = find_cells(net_graph(gather_net(ah.examples.wigley().state)))
    >>> found.count, len(found.outline)
    (220, 62)
    """
    check_lines(graph)
    start, member = permutation_cycles(next_half_edges(graph))
    check_faces(graph, start, member)
    length = np.add.reduceat(graph.length[member >> 1], start[:-1])
    outer = int(length.argmax())
    check_outline(graph, member[start[outer] : start[outer + 1]])
    inside = np.ones(len(member), bool)
    inside[start[outer] : start[outer + 1]] = False
    sides = np.delete(np.diff(start), outer)
    return NetCells(
        graph,
        np.concatenate([[0], np.cumsum(sides)]),
        member[inside],
        member[~inside],
    )


def sound_cells(net: CurveNet, leave_out: NDArray[np.bool_] | None = None) -> NetCells:
    """Find the cells of a net, with crossings that its tables do not hold if need be.

    Where the edges do not fit on half a hull, corners are told from tangent planes with more room;
    then crossings are looked for along all lines; if they still do not, borders of flats are left
    out: they are found on some lines and drawn through, and two of them may run into one another.
    The last two are reported in the notes.

    Parameters
    ----------
    net : CurveNet
        Curves and crossings.
    leave_out : (m,) bool or None
        Curves to do without.

    Raises
    ------
    OpenNetError
        As `find_cells`.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.analysis.net.curve_net import gather_net
    >>> from assoc_hull.surface.cells.net_faces import sound_cells
    >>> found = sound_cells(gather_net(ah.examples.wigley().state))
    >>> found.count, found.notes
    (220, ())
    """
    first = net_graph(net, leave_out=leave_out)
    if _fits(first):
        return find_cells(first)
    normal = node_normals(first.place, first.edge, first.leave, along=WIDE_CORNER)
    if _fits(again := attrs.evolve(first, normal=normal)):
        return find_cells(again)
    gone = np.zeros(net.batch.count, bool) if leave_out is None else leave_out
    flat = net.flat & ~gone
    for search, without in ((True, gone), (False, gone | flat), (True, gone | flat)):
        graph = net_graph(net, leave_out=without, search=search)
        if _fits(graph):
            return attrs.evolve(find_cells(graph), notes=_notes(first, search, without & flat))
    return find_cells(first)


def _fits(graph: NetGraph) -> bool:
    """Tell whether the edges can be drawn on half a hull without crossing one another."""
    if not len(graph.edge):
        return False
    faces = len(permutation_cycles(next_half_edges(graph))[0]) - 1
    return len(graph.place) - len(graph.edge) + faces == 2


def _notes(graph: NetGraph, search: bool, flats: NDArray[np.bool_]) -> tuple[str, ...]:
    """Say what was done."""
    found = []
    if search:
        missed = missed_crossings(graph)
        found.append("crossings that the tables do not hold: " + "; ".join(missed))
    if flats.any():
        names = dict.fromkeys(graph.net.name[c] for c in np.flatnonzero(flats).tolist())
        found.append("left out, as they do not fit the lines: " + ", ".join(names))
    return tuple(found)
