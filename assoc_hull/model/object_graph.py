"""A hull as a graph for people and tools: objects and links, and who drives whom.

An exported view in networkx, which the update never reads: `object_graph` has every group, line,
curve, point and link, `dependencies` who drives whom now. Keys are the names of the nodes. The
links (container, parent, friend, what a curve touches actually or latently) are those of Choi &
Lee, "A Study on the Hull Form Design System on the Basis of the Associative Geometry Objects",
J. SNAK 36(4), 1999.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from assoc_hull.model.address import AddressBook
from assoc_hull.model.definition.canonical_columns import CanonicalOrder, canonical_order
from assoc_hull.model.forms.generate_points import definitions_read
from assoc_hull.model.kinds import Role, Sort, State
from assoc_hull.model.links import defines, generates_on, latent_curves
from assoc_hull.model.tables import HullState

if TYPE_CHECKING:
    import networkx

__all__ = [
    "ONE_WAY",
    "TWO_WAY",
    "add_definitions",
    "dependencies",
    "generated_by",
    "object_graph",
    "point_id",
]

if TYPE_CHECKING:
    Any_Graph = networkx.DiGraph[str] | networkx.MultiDiGraph[str]


def generated_by(state: HullState) -> Iterator[tuple[str, str, tuple[str, ...]]]:
    """Give the key of a definition, that of a curve made of it, and those of the points."""
    uses = {each.use: each.key for each in state.definitions}
    for made in state.generated:
        if not made.attached:
            continue
        rows = tuple(str(state.rows.key[row]) for row in made.rows)
        for use in sorted(definitions_read(made)):
            if use in uses:
                yield uses[use], made.key, rows


def add_definitions(found: Any_Graph, state: HullState, points: bool = False) -> None:
    """Add the definitions of a hull, and an edge ``generates`` to each curve made of them.

    If `points`, the edges go to the points that are generated. Their ends must be in the graph.
    """
    for each in state.definitions:
        found.add_node(each.key, kind="definition", name=each.name)
    for definition, curve, rows in generated_by(state):
        for reader in rows if points else (curve,):
            found.add_edge(definition, reader, kind="generates")


# --------------------------------------------------------------------------------------
# Objects and links.

Reach = Mapping[int, frozenset[int]]

ONE_WAY, TWO_WAY = "one-way", "two-way"


def point_id(state: HullState, row: int, side: int) -> str:
    """Name the node of a point on one of its curves: its key, and the curve it lies on."""
    key = str(state.rows.key[row])
    if state.rows.sort[row] != Sort.CROSSING:
        return key
    return f"{key} on {state.curves.key[int(state.rows.curve.data[row, side])]}"


def object_graph(state: HullState) -> networkx.MultiDiGraph[str]:
    """Give all objects and links of a hull.

    Parameters
    ----------
    state : HullState
        The tables.

    Returns
    -------
    networkx.MultiDiGraph
        Nodes are keys, with ``kind`` (group, line, curve, point, definition), ``name``, and for
        curves and points ``state``, ``revision`` and ``role``. Edges have a ``kind``:

        - ``membership``: from a line or a group to its groups, from a curve to its line;
        - ``container``: from a point to the curve it lies on;
        - ``parent``: from a point to the curve that generated it;
        - ``friend``: between the two points of a crossing, both ways;
        - ``touch actual``: from a curve to a point it has generated on another;
        - ``touch latent``: from a curve to one it may come to meet;
        - ``association``: from a group to one on which it generates;
        - ``generates``: from a definition by form parameters to a curve that is made of it.

        Touches and associations have a ``way``: two-way where the other side generates
        back, else one-way. Nodes and edges come in the order of the keys.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.object_graph import object_graph
    >>> found = object_graph(wigley())
    >>> found.nodes["sections:35.000000"]["name"]
    'ST 7'
    """
    import networkx

    found: networkx.MultiDiGraph[str] = networkx.MultiDiGraph()
    book, order = AddressBook(state), canonical_order(state)
    reach = {
        group: frozenset(generates_on(state, group).tolist()) for group in order.groups.tolist()
    }
    _add_groups(found, state, order, reach)
    _add_lines(found, state, order, book)
    _add_curves(found, state, order, book)
    _add_latent(found, state, order)
    _add_points(found, state, order, book)
    _add_links(found, state, order, reach)
    add_definitions(found, state)
    return found


def _way(back: bool) -> str:
    return TWO_WAY if back else ONE_WAY


def _add_groups(
    found: networkx.MultiDiGraph[str], state: HullState, order: CanonicalOrder, reach: Reach
) -> None:
    names = state.groups.name.data
    for group in order.groups.tolist():
        family = state.groups.family[group]
        found.add_node(names[group], kind="group", name=names[group], family=family)
    for group in order.groups.tolist():
        for other in order.groups.tolist():
            if other in reach[group]:
                way = _way(group in reach[other])
                found.add_edge(names[group], names[other], kind="association", way=way)


def _add_lines(
    found: networkx.MultiDiGraph[str], state: HullState, order: CanonicalOrder, book: AddressBook
) -> None:
    for line in order.lines.tolist():
        key, group = state.lines.key[line], int(state.lines.group[line])
        found.add_node(key, kind="line", name=book.line_name(line))
        if group >= 0:
            found.add_edge(key, state.groups.name[group], kind="membership")
    for group in order.groups.tolist():
        for name in state.groups.members[group]:
            found.add_edge(name, state.groups.name[group], kind="membership")


def _add_curves(
    found: networkx.MultiDiGraph[str], state: HullState, order: CanonicalOrder, book: AddressBook
) -> None:
    keys = state.curves.key.data
    for curve in order.curves.tolist():
        found.add_node(
            keys[curve], kind="curve", name=book.curve_name(curve), role="curve",
            state=State(int(state.curves.state[curve])).name.lower(),
            revision=state.revision_curve.get(curve, 0),
        )  # fmt: skip
        line = state.line_of(curve)
        if line >= 0:
            found.add_edge(keys[curve], state.lines.key[line], kind="membership")


def _add_latent(found: networkx.MultiDiGraph[str], state: HullState, order: CanonicalOrder) -> None:
    keys = state.curves.key.data
    latent = {
        curve: frozenset(latent_curves(state, curve).tolist()) for curve in order.curves.tolist()
    }
    for curve, others in latent.items():
        for other in sorted(others, key=order.curve.__getitem__):
            way = _way(curve in latent[other])
            found.add_edge(keys[curve], keys[other], kind="touch latent", way=way)


def _add_points(
    found: networkx.MultiDiGraph[str], state: HullState, order: CanonicalOrder, book: AddressBook
) -> None:
    for row, side in _points(state, order):
        crossing = state.rows.sort[row] == Sort.CROSSING
        found.add_node(
            point_id(state, row, side), kind="point", name=book.address(row, side),
            sort=Sort(int(state.rows.sort[row])).name.lower(),
            role="defining" if defines(state, row, side) else "derived",
            crossing_role=Role(int(state.rows.role[row])).text if crossing else "",
            state=State(int(state.rows.state[row])).name.lower(),
            revision=state.revision_row.get(row, 0),
        )  # fmt: skip


def _points(state: HullState, order: CanonicalOrder) -> list[tuple[int, int]]:
    curve = state.rows.curve.data
    return [(row, side) for row in order.rows.tolist() for side in (0, 1) if curve[row, side] >= 0]


def _add_links(
    found: networkx.MultiDiGraph[str], state: HullState, order: CanonicalOrder, reach: Reach
) -> None:
    keys, curves = state.curves.key.data, state.rows.curve.data
    groups = state.lines.group[state.curves.line.data]
    for row, side in _points(state, order):
        here, mine, parent = point_id(state, row, side), curves[row, side], curves[row, 1 - side]
        found.add_edge(here, keys[mine], kind="container")
        if parent < 0:
            continue
        found.add_edge(here, keys[parent], kind="parent")
        found.add_edge(here, point_id(state, row, 1 - side), kind="friend")
        giver, taker = int(groups[parent]), int(groups[mine])
        if taker in reach.get(giver, ()):
            way = _way(giver in reach.get(taker, ()))
            found.add_edge(keys[parent], here, kind="touch actual", way=way)


# --------------------------------------------------------------------------------------
# Who drives whom.


def dependencies(state: HullState, points: bool = False) -> networkx.DiGraph[str]:
    """Give who drives whom now.

    Parameters
    ----------
    state : HullState
        The tables.
    points : bool
        Whether to show the points between the curves: what the update really follows.

    Returns
    -------
    networkx.DiGraph
        Edges run from what drives to what is made from it, with a ``kind``: ``drives``
        between curves, with the keys of the points through which (``through``); or, with
        points, ``defines`` (a point and a curve made through it), ``gives`` (a curve and a
        point computed from it), ``carries`` (a point and one that rides with it). From
        definitions run edges ``generates`` to the curves, or to the points, made of them.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.object_graph import dependencies
    >>> dependencies(wigley()).number_of_nodes()
    31
    """
    import networkx

    found: networkx.DiGraph[str] = networkx.DiGraph()
    book, order = AddressBook(state), canonical_order(state)
    for curve in order.curves.tolist():
        name = book.curve_name(curve)
        found.add_node(state.curves.key[curve], kind="curve", name=name)
    if points:
        _add_rows(found, state, order, book)
    else:
        _add_drives(found, state, order)
    add_definitions(found, state, points)
    return found


def _add_drives(found: networkx.DiGraph[str], state: HullState, order: CanonicalOrder) -> None:
    keys, table = state.curves.key.data, state.rows
    for row in order.rows.tolist():
        driver = int(table.driver[row])
        for reader in table.reader[row].tolist():
            if driver < 0 or reader < 0:
                continue
            tail, head = keys[driver], keys[reader]
            through = found.edges[tail, head]["through"] if found.has_edge(tail, head) else []
            found.add_edge(tail, head, kind="drives", through=[*through, table.key[row]])


def _add_rows(
    found: networkx.DiGraph[str], state: HullState, order: CanonicalOrder, book: AddressBook
) -> None:
    keys, table = state.curves.key.data, state.rows
    for row in order.rows.tolist():
        readers = [reader for reader in table.reader[row].tolist() if reader >= 0]
        if not readers:
            continue
        key = table.key[row]
        found.add_node(key, kind="point", name=book.address(row))
        for reader in readers:
            found.add_edge(key, keys[reader], kind="defines")
        if table.driver[row] >= 0:
            found.add_edge(keys[int(table.driver[row])], key, kind="gives")
        for anchor in table.anchor[row].tolist():
            if anchor >= 0:
                found.add_edge(table.key[anchor], key, kind="carries")
