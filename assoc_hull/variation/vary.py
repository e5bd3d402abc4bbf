"""A variation carried out: lay out, certify, apply, measure, and correct until all is met.

A map moves the measured places exactly; the lines that are lofted again through its images do so
within a tolerance. What is missing is added to what is asked, beside the published hull, until
the measured values are the asked ones; then the hull is varied, in one step.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import attrs

from assoc_hull.edit.document import Document
from assoc_hull.edit.report import EditReport
from assoc_hull.errors import BadInputError
from assoc_hull.model.copy import copy_of
from assoc_hull.model.state import HullState
from assoc_hull.variation.aiming.corrections import Settled, measured, settle
from assoc_hull.variation.aiming.reach import settle_reach
from assoc_hull.variation.aiming.report import Aimed
from assoc_hull.variation.ask import Ask
from assoc_hull.variation.carrying.carry_out import carry_out
from assoc_hull.variation.carrying.room import Room
from assoc_hull.variation.certificate.record import Certificate
from assoc_hull.variation.fields.field import Region
from assoc_hull.variation.fields.space_map import VMap
from assoc_hull.variation.notes import (
    also_changed,
    folds_outside,
    shifted_without_body,
    went_along,
)
from assoc_hull.variation.parameters.catalogue import CATALOGUE
from assoc_hull.variation.parameters.limits import present
from assoc_hull.variation.parameters.parameter_measures import measure_all
from assoc_hull.variation.script import script_of

__all__ = ["Target", "VariationReport", "vary_document"]


@attrs.frozen
class Target:
    """A named parameter of a variation.

    Attributes
    ----------
    name, unit : str
    before, asked, reached : float
        Measured on the parent, asked for, measured on the varied hull; an amplitude reaches
        what is asked for.
    """

    name: str
    unit: str
    before: float
    asked: float
    reached: float

    def __str__(self) -> str:
        return f"{self.name} {self.before:.6g} -> {self.reached:.9g} {self.unit}"


@attrs.frozen
class VariationReport:
    """What a variation did.

    Attributes
    ----------
    targets : tuple of Target
    rounds : int
        How often the map was laid out until all targets were met.
    regions : tuple of Region
        Boxes of the profile plane outside which no map moves anything.
    drivers : tuple of str
        Lines that were carried as they are; all others were cut again.
    added : int
        Adopted points that hold the drivers to their images.
    certificate : Certificate
        That the map folds nothing.
    edit : EditReport
        What changed, as of any edit.
    notes : tuple of str
        What else there is to know.
    script : mapping or None
        What was asked for as data: with it, `assoc_hull.variants.vary_by` repeats the variation.
        None where layers were given that are not data.
    aim : Aimed or None
        How targets of outputs were reached; None where none were given.
    """

    targets: tuple[Target, ...]
    rounds: int
    regions: tuple[Region, ...]
    drivers: tuple[str, ...]
    added: int
    certificate: Certificate
    edit: EditReport
    notes: tuple[str, ...] = ()
    script: Mapping[str, Any] | None = None
    aim: Aimed | None = None

    def __str__(self) -> str:
        aimed = () if self.aim is None else (str(self.aim),)
        targets = (str(each) for each in self.targets)
        return "\n".join([*targets, *aimed, *self.notes, str(self.edit)])


def vary_document(document: Document, ask: Ask) -> tuple[VMap, VariationReport]:
    """Vary a hull in place, as one step that can be undone.

    Parameters
    ----------
    document : Document
        The hull.
    ask : Ask
        What is asked for.

    Raises
    ------
    BadInputError, FoldError, RefusedEditError
        What is asked for cannot be had; the hull is unchanged.
    """
    room = Room.of(document.state, ask.layout, ask.tolerance)
    parent, was = room.parent, room.present
    for name in ask.values:
        if name in parent.absent:
            raise BadInputError(
                f"cannot vary '{name}': {parent.absent[name]}", "in vary", "leave it out"
            )
    found = _settled(document, room, ask)
    levels = document.state.lines.offset.data.copy()
    applied, report = carry_out(document, found.map, parent, ask, was, found.values, found.nudge)
    reached = measured(document.state, ask)
    targets = tuple(
        Target(name, CATALOGUE[name].unit, was[name], value, reached[name])
        for name, value in ask.values.items()
    )
    regions = (*found.whole.regions(), *applied.regions)
    now = present(measure_all(document.state), ask.layout)
    notes = (
        *shifted_without_body(parent, found.values),
        *folds_outside(found.whole, document.state, ask.tolerance),
        *went_along(levels, document.state), *also_changed(was, now, found.values),
    )  # fmt: skip
    return found.whole, VariationReport(
        targets, found.rounds, regions, applied.drivers, applied.added, found.certificate, report,
        notes, script_of(ask),
        None if found.aimed is None else attrs.evolve(found.aimed, hull=None),  # a hull is large
    )  # fmt: skip


def _settled(document: Document, room: Room, ask: Ask) -> Settled:
    """Find the map whose applied values are the asked ones, and what is nudged after it."""
    room.check(ask.values)
    if ask.reach is not None:
        return settle_reach(document.state, room, ask, ask.reach)
    return settle(
        ask, room.present, lambda aim, rounds: _tried(document.state, room, ask, aim, rounds)
    )


def _tried(
    state: HullState, room: Room, ask: Ask, aim: Mapping[str, float], rounds: int
) -> Settled:
    """Lay out the map of an aim, and measure what it gives beside the published hull."""
    vmap = VMap((*room.map(aim).layers, *ask.layers))
    certificate = room.certified(vmap, aim)
    trial = Document(copy_of(state))
    carry_out(trial, vmap, room.parent, ask, room.present)
    reached = measured(trial.state, ask)
    miss = {name: value - reached[name] for name, value in ask.values.items()}
    return Settled(vmap, rounds, certificate, miss, ask.values, vmap)
