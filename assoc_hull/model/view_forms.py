"""Definitions in the graphs of a hull: what generates which curves.

Examples
--------
>>> import networkx
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.model.view_forms import add_definitions
>>> found = networkx.MultiDiGraph()
>>> add_definitions(found, wigley(stations=5, waterlines=4))
>>> found.number_of_nodes()
0
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from assoc_hull.model.forms.generate import reads
from assoc_hull.model.state import HullState

if TYPE_CHECKING:
    import networkx

    Any_Graph = networkx.DiGraph[str] | networkx.MultiDiGraph[str]

__all__ = ["add_definitions", "generating"]


def generating(state: HullState) -> Iterator[tuple[str, str, tuple[str, ...]]]:
    """Give the key of a definition, that of a curve made of it, and those of the points."""
    uses = {each.use: each.key for each in state.definitions}
    for made in state.generated:
        if not made.attached:
            continue
        rows = tuple(str(state.rows.key.data[row]) for row in made.rows)
        for use in sorted(reads(made)):
            if use in uses:
                yield uses[use], made.key, rows


def add_definitions(found: Any_Graph, state: HullState, points: bool = False) -> None:
    """Add the definitions of a hull, and an edge ``generates`` to each curve made of them.

    Parameters
    ----------
    found : networkx.DiGraph or MultiDiGraph
        The graph; curves, and points if these are asked for, are in it.
    state : HullState
        The tables.
    points : bool
        Whether the edges go to the points that are generated.
    """
    for each in state.definitions:
        found.add_node(each.key, kind="definition", name=each.name)
    for definition, curve, rows in generating(state):
        for reader in rows if points else (curve,):
            found.add_edge(definition, reader, kind="generates")
