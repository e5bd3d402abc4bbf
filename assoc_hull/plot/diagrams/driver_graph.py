"""Who drives whom around one curve, as a graph: families in columns, drivers to driven.

Pairs of curves are read off the crossings of the hull: a driven crossing has one direction, a
shared one both. Nodes within some hops of the centre are placed in columns, block above block.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, TypeVar

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.address import AddressBook
from assoc_hull.model.kinds import FAMILIES
from assoc_hull.model.named_mapping import NamedMapping
from assoc_hull.model.tables import HasState, HullState
from assoc_hull.plot.lines_plan.drawing import tables_of
from assoc_hull.plot.sheet.paper import FAMILY_COLOURS, Paper, PaperName, Pen
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, save

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = [
    "GRAPH_MARGIN",
    "NODE_TALL",
    "NODE_WIDE",
    "CurveNode",
    "DriveLink",
    "drive_links",
    "neighbourhood",
    "place_nodes",
]

# --------------------------------------------------------------------------------------
# Who drives whom in a hull, pair by pair of curves.


@attrs.frozen
class CurveNode:
    """A curve in the network: its name, the family, and where its plane lies (m)."""

    name: str
    family: str
    offset: float


@attrs.frozen
class DriveLink:
    """That one curve makes another through some crossings.

    Attributes
    ----------
    tail, head : Node
        What drives, and what is made from it.
    driven, shared : int
        Crossings at which the tail drives the head, and those that define both.
    """

    tail: CurveNode
    head: CurveNode
    driven: int
    shared: int


def drive_links(hull: HasState | HullState) -> tuple[DriveLink, ...]:
    """Give who drives whom, by crossings; a pair with shared crossings comes once each way."""
    state = tables_of(hull)
    book = AddressBook(state)
    node: dict[int, CurveNode] = {}
    for curve in state.live("curves").tolist():
        line = state.line_of(curve)
        offset = float(state.lines.offset[line])
        node[curve] = CurveNode(book.curve_name(curve), state.family(line).name, offset)
    counts: dict[tuple[int, int], list[int]] = {}
    for tail, head, shared in _links(state):
        counts.setdefault((tail, head), [0, 0])[shared] += 1
    return tuple(DriveLink(node[a], node[b], *count) for (a, b), count in sorted(counts.items()))


def _links(state: HullState) -> Iterator[tuple[int, int, int]]:
    """Give tail, head, and whether the crossing is shared, for each crossing that counts."""
    table = state.rows
    for row in state.live("rows").tolist():
        driver = int(table.driver[row])
        readers = table.reader[row][table.reader[row] >= 0].tolist()
        if driver >= 0:
            yield from ((driver, reader, 0) for reader in readers)
        elif len(readers) == 2:
            first, second = readers
            yield first, second, 1
            yield second, first, 1


# --------------------------------------------------------------------------------------
# Places for the nodes of a graph that stand in columns, by blocks.

N = TypeVar("N", bound=Hashable)

GRAPH_MARGIN = 10.0
"""Of the sheet, mm at A3; so are the other lengths."""

NODE_WIDE, NODE_TALL = 26.0, 2.9
"""Size of a node."""

_HEAD = 11.0  # for the title
_LEAST, _MOST = 3.7, 8.0  # between two nodes
_BLOCK = 2.0  # nodes' room that is left between two blocks


def place_nodes(paper: Paper, columns: Sequence[Sequence[Sequence[N]]]) -> dict[N, FloatArray]:
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
    tall = paper.height - (2.0 * GRAPH_MARGIN + _HEAD) * factor
    most = int(tall / (_LEAST * factor)) - 2
    rows = [part for column in columns for part in _parts(list(_steps(column)), most)]
    width = (paper.width - (2.0 * GRAPH_MARGIN + NODE_WIDE) * factor) / max(len(rows) - 1, 1)
    left = (GRAPH_MARGIN + 0.5 * NODE_WIDE) * factor if len(rows) > 1 else 0.5 * paper.width
    found = {}
    for i, row in enumerate(rows):
        high = sum(step for _, step in row)
        step = min((tall - 5.0 * factor) / max(high, 1.0), _MOST * factor)
        y = GRAPH_MARGIN * factor + 0.5 * (tall - step * high)
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


# --------------------------------------------------------------------------------------
# Who drives whom around one curve, as a graph: families in columns, drivers to driven.

_BOTH = "black"
_FARTHER = Pen(0.04, "0.78", over=1.0)
_PART = 0.35  # how far arrows part at the node in the middle, as a part of their distances


@attrs.frozen
class _Edge:
    """One pair of curves: crossings at which the tail drives the head, or that both share."""

    tail: CurveNode
    head: CurveNode
    count: int
    both: bool


def neighbourhood(
    hull: HasState | HullState,
    name: str,
    path: Path_ | None = None,
    *,
    hops: int = 1,
    paper: PaperName = "A3",
) -> Figure:
    """Draw what a curve is made from and what is made from it.

    Parameters
    ----------
    hull : Hull or HullState
        The hull.
    name : str
        Name of the curve; of a line, its first curve.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    hops : int
        How many links to follow, whichever way they run.
    paper : "A3", "A1" or "A4"
        Size of the sheet, landscape.

    Returns
    -------
    matplotlib.figure.Figure
        The curve stands in the middle, the others farther out by hops, each family on one
        side. An arrow runs from what drives to what is made from it, with the number of
        crossings, in the colour of the driver's family; where either drives the other it is
        black and has two heads. Links farther out are pale.

    Raises
    ------
    UnknownNameError
        No curve has this name.
    BadInputError
        Fewer than one hop.
    MissingExtraError
        Matplotlib is not installed.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.plot.diagrams.driver_graph import neighbourhood
    >>> figure = neighbourhood(wigley(), "WL 2.5")
    """
    if hops < 1:
        raise BadInputError(f"{hops} hops were asked", "in neighbourhood", "ask for 1 or more")
    every = drive_links(hull)
    centre = _centre(every, name)
    edges = _near(_pairs(every), centre, hops)
    nodes = {centre} | {node for edge in edges for node in (edge.tail, edge.head)}
    sheet = Sheet(paper)
    place = place_nodes(sheet.paper, _columns(edges, centre))
    for edge in edges:
        _draw_edge(sheet, edge, centre, place)
    for node in sorted(nodes, key=lambda each: each.name):
        _draw_node(sheet, node, centre, place)
    _legend(sheet, centre, edges, place)
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def _centre(every: Sequence[DriveLink], name: str) -> CurveNode:
    nodes = {node.name: node for link in every for node in (link.tail, link.head)}
    known = NamedMapping("curve", nodes, spoken=True)
    first = f"{name} [1]"
    return known[first if name not in known and first in known else name]


def _pairs(every: Sequence[DriveLink]) -> list[_Edge]:
    """Make one edge of each pair: two-headed where anything runs both ways."""
    by_pair = {(link.tail, link.head): link for link in every}
    found = []
    for (tail, head), link in by_pair.items():
        back = by_pair.get((head, tail))
        if back is None:
            found.append(_Edge(tail, head, link.driven + link.shared, False))
        elif (tail.family, tail.name) < (head.family, head.name):
            found.append(_Edge(tail, head, link.driven + link.shared + back.driven, True))
    return found


def _near(edges: Iterable[_Edge], centre: CurveNode, hops: int) -> list[_Edge]:
    """Keep the edges on ways of at most so many hops from the centre."""
    left, reached, found = list(edges), {centre}, []
    for _ in range(hops):
        touching = [edge for edge in left if edge.tail in reached or edge.head in reached]
        left = [edge for edge in left if edge.tail not in reached and edge.head not in reached]
        reached |= {node for edge in touching for node in (edge.tail, edge.head)}
        found += touching
    return found


def _columns(edges: Sequence[_Edge], centre: CurveNode) -> list[list[list[CurveNode]]]:
    """Give columns from left to right, each of blocks of nodes of one family."""
    hop, front = {centre: 0}, {centre}
    while front:
        pairs = {
            (a, b) for edge in edges for a, b in ((edge.tail, edge.head), (edge.head, edge.tail))
        }
        front = {b for a, b in pairs if a in front and b not in hop}
        hop |= dict.fromkeys(front, 1 + max(hop.values()))
    side = _sides([node for node in hop if node != centre])
    found: dict[int, dict[str, list[CurveNode]]] = {}
    for node in sorted(hop, key=lambda each: (np.nan_to_num(each.offset), each.name)):
        column = hop[node] * side.get(node.family, 0) if node != centre else 0
        found.setdefault(column, {}).setdefault(node.family, []).append(node)
    rank = {name: FAMILIES[name].rank for name in FAMILIES}
    return [
        [found[at][family] for family in sorted(found[at], key=lambda name: -rank[name])]
        for at in sorted(found)
    ]


def _sides(nodes: Sequence[CurveNode]) -> dict[str, int]:
    """Put each family left (-1) or right (1), so that both sides hold about as many."""
    count = Counter(node.family for node in nodes)
    held, side = {-1: 0, 1: 0}, {}
    for family, size in sorted(count.items(), key=lambda each: (-each[1], each[0])):
        side[family] = -1 if held[-1] <= held[1] else 1
        held[side[family]] += size
    return side


def _half_height(
    node: CurveNode, centre: CurveNode, place: dict[CurveNode, FloatArray], factor: float
) -> float:
    """Give half the height of a node (mm): that in the middle is tall, so that arrows part."""
    if node != centre:
        return 0.5 * NODE_TALL * factor
    reach = max(abs(float(at[1] - place[centre][1])) for at in place.values())
    return 0.5 * NODE_TALL * factor + _PART * reach


def _draw_node(
    sheet: Sheet, node: CurveNode, centre: CurveNode, place: dict[CurveNode, FloatArray]
) -> None:
    middle, chosen = place[node], node == centre
    high = _half_height(node, centre, place, sheet.paper.factor)
    half = np.array([0.5 * NODE_WIDE * sheet.paper.factor, high])
    corners = middle + half * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]])
    colour = FAMILY_COLOURS[node.family]
    fill = colour if chosen else "white"
    sheet.axes.fill(corners[:, 0], corners[:, 1], color=fill, linewidth=0.0, zorder=3.0)
    sheet.line(corners, Pen(0.25, colour, over=3.5), f"node/{node.name}")
    text = sheet.text(
        (float(middle[0]), float(middle[1])), node.name, size=1.4 if chosen else 1.0,
        colour="white" if chosen else "black", bold=chosen, name=f"label/node/{node.name}",
    )  # fmt: skip
    sheet.take(text)


def _draw_edge(
    sheet: Sheet, edge: _Edge, centre: CurveNode, place: dict[CurveNode, FloatArray]
) -> None:
    """Draw an arrow between two nodes, with the number of crossings at its far end."""
    start, end = _ports(edge, centre, place, sheet.paper.factor)
    if centre not in (edge.tail, edge.head):
        name = f"edge/{edge.tail.name} - {edge.head.name}"
        sheet.arrow((start[0], start[1]), (end[0], end[1]), _FARTHER, name, both=edge.both)
        return
    colour = _BOTH if edge.both else FAMILY_COLOURS[edge.tail.family]
    pen = Pen(0.12, colour, over=2.0)
    name = f"edge/{edge.tail.name} - {edge.head.name}"
    sheet.arrow((start[0], start[1]), (end[0], end[1]), pen, name, both=edge.both)
    if edge.head == centre:
        start, end = end, start
    near = end + (start - end) * 0.14
    sheet.text(
        (float(near[0]), float(near[1])), str(edge.count), size=0.9, halo=True, colour=colour,
        name=f"count/{edge.tail.name} - {edge.head.name}",
    )  # fmt: skip


def _ports(
    edge: _Edge, centre: CurveNode, place: dict[CurveNode, FloatArray], factor: float
) -> tuple[FloatArray, FloatArray]:
    """Give where an arrow leaves one node and meets the other: at their facing sides."""
    tail, head = place[edge.tail], place[edge.head]
    side = np.sign(head[0] - tail[0]) or 1.0
    out = np.array([0.5 * NODE_WIDE * factor * side, 0.0])
    found = [tail + out, head - out if head[0] != tail[0] else head + out]
    for i, node in enumerate((edge.tail, edge.head)):
        if node == centre:
            found[i] = found[i] + np.array([0.0, _PART * float(found[1 - i][1] - found[i][1])])
    return found[0], found[1]


def _legend(
    sheet: Sheet, centre: CurveNode, edges: Sequence[_Edge], place: dict[CurveNode, FloatArray]
) -> None:
    """Write what the picture shows, and the names of the families above their blocks."""
    factor = sheet.paper.factor
    top, left = sheet.paper.height - GRAPH_MARGIN * factor, GRAPH_MARGIN * factor
    shared = sum(edge.both and centre in (edge.tail, edge.head) for edge in edges)
    into = sum(edge.head == centre and not edge.both for edge in edges)
    out = sum(edge.tail == centre and not edge.both for edge in edges)
    title = f"Around {centre.name}"
    sheet.text((left, top), title, size=2.0, bold=True, across="left", up="top", name="label/title")
    words = (
        f"{into} drive it, {out} are driven by it, with {shared} it drives both ways. "
        "Arrows run from driver to driven, black ones both ways; the number is that of crossings."
    )
    low = top - 6.0 * factor
    sheet.text((left, low), words, size=1.1, across="left", up="top", name="label/legend")
    heads: dict[tuple[str, float], float] = {}
    for node, (x, y) in place.items():
        heads[node.family, float(x)] = max(float(y), heads.get((node.family, float(x)), 0.0))
    heads.pop((centre.family, float(place[centre][0])))
    for (family, x), y in heads.items():
        sheet.text(
            (x, y + 0.5 * NODE_TALL * factor + 0.8 * factor),
            family,
            size=1.1,
            bold=True,
            up="bottom",
            colour=FAMILY_COLOURS[family],
            name=f"label/family/{family}",
        )
