"""A map carried out on a hull, as one step: lines, features, principal dimensions."""

from __future__ import annotations

from collections.abc import Mapping

import attrs
import numpy as np

from assoc_hull.edit.document import Document
from assoc_hull.edit.given import Given
from assoc_hull.edit.nudge import Nudge, nudge
from assoc_hull.edit.report import EditReport
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError
from assoc_hull.model.state import HullState, Particulars
from assoc_hull.variation.ask import Ask
from assoc_hull.variation.carrying.apply import Applied, apply
from assoc_hull.variation.carrying.room import asked_radii
from assoc_hull.variation.fields.space_map import VMap
from assoc_hull.variation.parameters.parent_places import Parent

__all__ = ["carry_out", "resized"]


def carry_out(
    document: Document,
    vmap: VMap,
    parent: Parent,
    ask: Ask,
    was: Mapping[str, float],
    values: Mapping[str, float] | None = None,
    by: Nudge | None = None,
) -> tuple[Applied, EditReport]:
    """Carry a hull by a map, as one step.

    Parameters
    ----------
    document : Document
        The hull.
    vmap : VMap
        The map.
    parent : Parent
        What is measured of the hull.
    ask : Ask
        Which lines drive, how near they stay to their images, and so on.
    was : mapping of str to float
        Present values of named parameters.
    values : mapping of str to float or None
        Values that they get; None for those of `ask`.
    by : Nudge or None
        What moves after that.

    Raises
    ------
    BadInputError, RefusedEditError
        The hull cannot be carried; it is unchanged.
    """
    drivers = None if ask.drivers is None else Given(document.state).driving(ask.drivers)
    asked = ask.values if values is None else values
    size = resized(document.state, vmap, parent, asked)
    with Transaction(document, ask.name) as edit:
        applied = apply(
            edit, vmap, drivers=drivers, stations=ask.stations,
            follow=ask.planes == "follow", tolerance=ask.tolerance,
            particulars=None if size == document.state.particulars else size,
            radii=asked_radii(document.state, parent, asked, was),
        )  # fmt: skip
        if by is not None:
            nudge(edit, by)
    report = edit.report
    if report is None:
        raise BadInputError("an edit is open", "in vary", "finish it before")
    return applied, report


def resized(
    state: HullState, vmap: VMap, parent: Parent, asked: Mapping[str, float]
) -> Particulars:
    """Give the principal dimensions of a hull after a map.

    Parameters
    ----------
    state : HullState
        The tables, before.
    vmap : VMap
        The map; the deck amidships tells what becomes of the depth.
    parent : Parent
        What is measured of the hull.
    asked : mapping of str to float
        Values of named parameters that are asked for.
    """
    ship = state.particulars
    found = {name: asked[name] for name in ("length", "draught") if name in asked}
    deck = parent.places.get("deck", np.array([0.5 * ship.length, 0.0, ship.depth]))
    rise = float(vmap(deck[None, :])[0, 2] - deck[2])
    if rise != 0.0:
        found["depth"] = ship.depth + rise
    sizes = ("breadth", ship.breadth, parent.breadth), ("depth", ship.depth, parent.depth)
    for name, stored, measured in sizes:
        if name in asked:
            found[name] = _in_proportion(stored, measured, asked[name])
    return attrs.evolve(
        ship, length=found.get("length", ship.length), breadth=found.get("breadth", ship.breadth),
        depth=found.get("depth", ship.depth), draught=found.get("draught", ship.draught),
    )  # fmt: skip


def _in_proportion(stored: float, measured: float, asked: float) -> float:
    """Give what becomes of a stored dimension whose measured value differs a little."""
    return asked if stored == measured else stored * (asked / measured)
