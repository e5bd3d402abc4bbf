"""A map carried out on a hull, as one step: lines, features, principal dimensions.

`apply_map` carries the net within an open transaction: drivers exactly, all others cut again at
their own planes. Drivers are by default all lines whose planes the map keeps. `carry_out` does it
on a document, with the lines that a request names, and changes the principal dimensions with it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal

import attrs
import numpy as np

from assoc_hull.edit.arguments import GivenObjects
from assoc_hull.edit.carried_net import Nudge, nudge
from assoc_hull.edit.document import Document
from assoc_hull.edit.recut.transform import transform
from assoc_hull.edit.step import EditReport
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError
from assoc_hull.model.tables import HullState, Particulars
from assoc_hull.variation.carrying.admissible_values import requested_radii
from assoc_hull.variation.carrying.driving_lines import DrivingLines, choose_drivers, section_planes
from assoc_hull.variation.features.redrawn_features import redraw_features
from assoc_hull.variation.fields.field import FieldRegion
from assoc_hull.variation.fields.space_map import SlopedMap, VariationMap
from assoc_hull.variation.parameters.parent import Parent
from assoc_hull.variation.request import VariationRequest

__all__ = [
    "AppliedMap",
    "apply_map",
    "carry_map",
    "carry_out",
    "resized_particulars",
]

Stations = Literal["number", "x"]


@attrs.frozen
class AppliedMap:
    """How a map was applied to a net.

    Attributes
    ----------
    drivers : tuple of str
        Names of the lines that drove, boundary curves among them.
    driving : DrivingLines
        How they were chosen.
    added : int
        How many adopted points hold the drivers to their images.
    regions : tuple of FieldRegion
        Boxes of the profile plane in which features that were drawn again change the map.
    """

    drivers: tuple[str, ...]
    driving: DrivingLines
    added: int
    regions: tuple[FieldRegion, ...] = ()


def apply_map(
    edit: Transaction,
    vmap: VariationMap,
    *,
    drivers: Sequence[int] | None = None,
    stations: Stations = "number",
    follow: bool = False,
    tolerance: float = 2e-3,
    particulars: Particulars | None = None,
    radii: Mapping[str, float] | None = None,
) -> AppliedMap:
    """Carry a net by a map, within an edit that holds nothing else.

    Parameters
    ----------
    edit : Transaction
        The edit: one undo step, refused as a whole.
    vmap : VariationMap
        The map.
    drivers : sequence of int or None
        Numbers of the driving lines; None for all whose planes the map keeps.
    stations : {"number", "x"}
        Whether sections go with the map and keep their numbers, or stay where they are along
        the ship and are cut again. Where the map bends their planes they are cut again where
        the part of it goes that bends none.
    follow : bool
        Whether waterlines and buttocks go where the map sends most of each of them to a parallel
        plane; else they stay at their heights and half-breadths.
    tolerance : float, m
        How far a driver may leave its exact image.
    particulars : Particulars or None
        Those of the hull afterwards; None leaves them.
    radii : mapping of str to float or None
        Radii (m) that are asked for of circles, by the keys of features.

    Raises
    ------
    BadInputError
        Nothing can drive, the map folds, or lines cannot follow it.
    """
    state, anew = edit.state, redraw_features(edit.state, vmap, radii)
    space = anew.space
    chosen = choose_drivers(state, space, drivers, stations, follow=follow)
    levels = section_planes(state, vmap.layers if stations == "number" else ())
    added = transform(
        edit, space, chosen.lines, follow=chosen.follow, levels=levels, tolerance=tolerance,
        reshape=anew.settle, particulars=particulars, lines_may_go=True,
    )  # fmt: skip
    if edit.pending.features is not None:
        edit.pending.features = anew.features(edit.pending.features)
    return AppliedMap(_names(state, chosen.lines), chosen, added, anew.regions())


def _names(state: HullState, lines: Sequence[int]) -> tuple[str, ...]:
    """Give the names of driving lines, with all boundary curves, in the order of their keys."""
    boundary = state.live("lines")[state.lines.boundary[state.live("lines")] >= 0]
    every = sorted({*lines, *boundary.tolist()}, key=lambda line: str(state.lines.key[line]))
    return tuple(str(state.lines.name[line]) for line in every)


def carry_out(
    document: Document,
    vmap: VariationMap,
    parent: Parent,
    ask: VariationRequest,
    was: Mapping[str, float],
    values: Mapping[str, float] | None = None,
    by: Nudge | None = None,
) -> tuple[AppliedMap, EditReport]:
    """Carry a hull by a map, as one step.

    Parameters
    ----------
    document : Document
        The hull.
    vmap : VariationMap
        The map.
    parent : Parent
        What is measured of the hull.
    ask : VariationRequest
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
    with Transaction(document, ask.name) as edit:
        applied = carry_map(
            edit, vmap, parent, ask, was, ask.values if values is None else values, by
        )
    report = edit.report
    if report is None:
        raise BadInputError("an edit is open", "in vary", "finish it before")
    return applied, report


def carry_map(
    edit: Transaction,
    vmap: VariationMap,
    parent: Parent,
    ask: VariationRequest,
    was: Mapping[str, float],
    values: Mapping[str, float],
    by: Nudge | None = None,
) -> AppliedMap:
    """Carry the hull of an open edit by a map; the rest as `carry_out`."""
    state = edit.state
    drivers = None if ask.drivers is None else GivenObjects(state).driving(ask.drivers)
    size = resized_particulars(state, vmap, parent, values)
    applied = apply_map(
        edit, vmap, drivers=drivers, stations=ask.stations,
        follow=ask.planes == "follow", tolerance=ask.tolerance,
        particulars=None if size == state.particulars else size,
        radii=requested_radii(state, parent, values, was),
    )  # fmt: skip
    if by is not None:
        nudge(edit, by)
    return applied


def resized_particulars(
    state: HullState, vmap: SlopedMap, parent: Parent, asked: Mapping[str, float]
) -> Particulars:
    """Give the principal dimensions of a hull after a map.

    Parameters
    ----------
    state : HullState
        The tables, before.
    vmap : SlopedMap
        The map; the deck amidships tells what becomes of the depth.
    parent : Parent
        What is measured of the hull.
    asked : mapping of str to float
        Values of named parameters that are asked for.
    """
    ship = state.particulars
    found = {name: asked[name] for name in ("length", "breadth", "draught") if name in asked}
    deck = parent.places.get("deck", np.array([0.5 * ship.length, 0.0, ship.depth]))
    rise = float(vmap(deck[None, :])[0, 2] - deck[2])
    if rise != 0.0:
        found["depth"] = ship.depth + rise
    if "depth" in asked:
        found["depth"] = _in_proportion(ship.depth, parent.depth, asked["depth"])
    return attrs.evolve(
        ship, length=found.get("length", ship.length), breadth=found.get("breadth", ship.breadth),
        depth=found.get("depth", ship.depth), draught=found.get("draught", ship.draught),
    )  # fmt: skip


def _in_proportion(stored: float, measured: float, asked: float) -> float:
    """Give a stored dimension (m) in the ratio of asked and measured, which may differ from it."""
    return asked if stored == measured else stored * (asked / measured)
