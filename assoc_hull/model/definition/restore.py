"""From a definition back to a hull.

With published values, they are put back as they are: nothing is computed. Without, every
derived value is made from the definition alone, curve by curve in the order of the driven
links; the result has the bits of a hull that was brought there by edits.

Examples
--------
>>> from assoc_hull.model.definition.definition import definition, fingerprint
>>> from assoc_hull.model.definition.restore import from_definition
>>> from assoc_hull.model.state import HullState, Particulars
>>> hull = HullState(Particulars("S", 9.0, 2.0, 1.0, 1.0))
>>> fingerprint(from_definition(definition(hull))) == fingerprint(hull)
True
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.journal import Journal
from assoc_hull.model.definition.schema import check_definition, check_published
from assoc_hull.model.definition.shapes import put_kept, put_published
from assoc_hull.model.definition.tables import make_tables
from assoc_hull.model.gaps import gap_at, watched_on
from assoc_hull.model.generated import unmade_rows
from assoc_hull.model.index import build_index
from assoc_hull.model.kinds import State
from assoc_hull.model.network import HullNetwork
from assoc_hull.model.state import HullState, curve_node, row_node

__all__ = ["from_definition", "rebuilt"]


def from_definition(
    given: Mapping[str, Any], published: Mapping[str, Any] | None = None
) -> HullState:
    """Make a hull of its definition.

    Parameters
    ----------
    given : mapping
        As `assoc_hull.model.definition.definition.definition` gives it.
    published : mapping or None
        As `assoc_hull.model.definition.definition.published` gives it: put back as it is. If None,
        all derived values are made from the definition.

    Returns
    -------
    HullState
        Rows in canonical order; revisions begin at nil.

    Raises
    ------
    BadInputError
        If the form is wrong, a name refers to nothing, parts contradict one another, or a
        rebuilt curve meets its partners otherwise than the definition says.
    AssocHullError
        If a curve cannot be made.
    """
    check_definition(given)
    if published is None:
        state, misfits = rebuilt(given)
    else:
        check_published(published)
        state, misfits = _stored(given, published), []
    if misfits:
        raise BadInputError(
            f"{len(misfits)} curves meet other lines than the definition says",
            f"first at the curve {misfits[0]!r}",
            "take the file from where it was written",
        )
    return state


def _stored(given: Mapping[str, Any], published: Mapping[str, Any]) -> HullState:
    state, journal = make_tables(given), Journal()
    put_kept(state, journal, list(given["curves"]))
    put_published(state, journal, published)
    _settle_spots(state, journal)
    return state


def rebuilt(given: Mapping[str, Any]) -> tuple[HullState, list[str]]:
    """Make everything from a definition of the right form.

    Returns
    -------
    HullState, list of str
        The hull, and the keys of the curves that meet their partners' planes otherwise
        than the definition says.
    """
    state, journal = make_tables(given), Journal()
    put_kept(state, journal, list(given["curves"]))
    misfits = _rebuild(state, journal)
    _settle_spots(state, journal)
    return state, misfits


def _rebuild(state: HullState, journal: Journal) -> list[str]:
    """Evaluate all that is up to date, level by level; what failed or is blocked stays."""
    network = HullNetwork(state, build_index(state))
    for nodes in _by_level(network, _all_nodes(state)):
        network.evaluate(nodes, journal)
    watched = watched_on(state, state.live("curves"))
    if len(watched):
        journal.put(state.rows.gap, watched, gap_at(state, watched))
        journal.put(state.rows.xyz, watched, state.rows.spot.data[watched, 0])
    return [str(state.curves.key.data[each.curve]) for each in network.realigned]


def _all_nodes(state: HullState) -> IntArray:
    """Give every curve, computed, riding and generated point that is up to date."""
    rows, curves = state.live("rows"), state.live("curves")
    table = state.rows
    made = (table.driver.data[rows] >= 0) | (table.anchor.data[rows] >= 0).any(axis=1)
    made |= ~unmade_rows(state, rows)
    rows = rows[made & (table.state.data[rows] == State.CLEAN)]
    curves = curves[state.curves.state.data[curves] == State.CLEAN]
    return np.concatenate([row_node(rows), curve_node(curves)])


def _by_level(network: HullNetwork, nodes: IntArray) -> list[IntArray]:
    if not len(nodes):
        return []
    level = network.level(nodes)
    return [nodes[level == each] for each in np.unique(level).tolist()]


def _settle_spots(state: HullState, journal: Journal) -> None:
    """Where a curve has no meeting at a crossing, the crossing itself is its place there."""
    rows = state.live("rows")
    spot, xyz = state.rows.spot.data[rows], state.rows.xyz.data[rows]
    unknown = np.isnan(spot) & (state.rows.curve.data[rows] >= 0)[:, :, None]
    journal.put(state.rows.spot, rows, np.where(unknown, xyz[:, None, :], spot))
