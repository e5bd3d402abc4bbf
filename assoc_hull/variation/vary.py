"""A variation carried out: lay out, certify, apply, measure, and correct until all is met.

A map moves the measured places exactly; the lines that are lofted again through its images do so
within a tolerance. What is missing is added to what is asked, beside the published hull, until
the measured values are the asked ones; then the hull is varied, in one step.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import attrs
import numpy as np

from assoc_hull.edit.document import Document
from assoc_hull.edit.given import Given
from assoc_hull.edit.report import EditReport
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.model.copy import copy_of
from assoc_hull.model.state import HullState
from assoc_hull.variation.anchors import measure_all
from assoc_hull.variation.apply import Applied, apply
from assoc_hull.variation.ask import Ask
from assoc_hull.variation.catalogue import CATALOGUE
from assoc_hull.variation.certificate import Certificate
from assoc_hull.variation.field import Region
from assoc_hull.variation.limits import hull_box, present
from assoc_hull.variation.notes import (
    also_changed,
    folds_outside,
    shifted_without_body,
    went_along,
)
from assoc_hull.variation.parent import Parent
from assoc_hull.variation.parent_of import parent_of
from assoc_hull.variation.room import SAME, Room, asked_radii
from assoc_hull.variation.script import script_of
from assoc_hull.variation.vmap import VMap

__all__ = ["Target", "VariationReport", "vary_document"]

_MET = 1e-7
"""A target (m, degrees) is met where it is missed by less than this; 1e-6 is promised."""

_PROMISED = 1e-6
_ROUNDS = 6


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

    def __str__(self) -> str:
        return "\n".join([*(str(each) for each in self.targets), *self.notes, str(self.edit)])


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
    before = measure_all(document.state)
    parent = parent_of(document.state, before)
    for name in ask.values:
        if name in before.absent:
            raise BadInputError(
                f"cannot vary '{name}': {before.absent[name]}", "in vary", "leave it out"
            )
    was = present(before, ask.layout)
    found = _settle(document.state, parent, ask, was)
    levels = document.state.lines.offset.data.copy()
    applied, report = _apply(document, found.map, parent, ask, was)
    reached = _measured(document.state, ask)
    targets = tuple(
        Target(name, CATALOGUE[name].unit, was[name], value, reached[name])
        for name, value in ask.values.items()
    )
    regions = (*found.map.regions(), *applied.regions)
    now = present(measure_all(document.state), ask.layout)
    notes = (
        *shifted_without_body(parent, ask.values),
        *folds_outside(found.map, document.state, ask.tolerance),
        *went_along(levels, document.state), *also_changed(was, now, ask.values),
    )  # fmt: skip
    return found.map, VariationReport(
        targets, found.rounds, regions, applied.drivers, applied.added, found.certificate, report,
        notes, script_of(ask),
    )  # fmt: skip


@attrs.frozen
class _Settled:
    """A map whose applied values are nearly the asked ones, how it was found, what it misses."""

    map: VMap
    rounds: int
    certificate: Certificate
    miss: dict[str, float]

    @property
    def worst(self) -> float:
        """The largest miss, m or degrees."""
        return max((abs(each) for each in self.miss.values()), default=0.0)


def _settle(state: HullState, parent: Parent, ask: Ask, was: Mapping[str, float]) -> _Settled:
    """Find the map whose applied values are the asked ones."""
    room = Room(state, parent, was, ask.layout, hull_box(state, ask.tolerance))
    room.check(ask.values)
    aim = {name: value for name, value in ask.values.items() if abs(value - was[name]) > SAME}
    best = found = _tried(state, room, ask, aim, 1)
    for rounds in range(2, _ROUNDS + 1):
        if best.worst <= _MET:
            break
        # what others move away from a value that was to stay is asked for as well
        aim = {
            name: aim.get(name, ask.values[name]) + each
            for name, each in found.miss.items() if name in aim or abs(each) > _MET
        }  # fmt: skip
        try:
            found = _tried(state, room, ask, aim, rounds)
        except AssocHullError:
            break  # the aim went astray: what was asked for is not at fault
        if found.worst < best.worst:
            best = found
    if best.worst > _PROMISED:
        raise _missed(best, ask)
    return best


def _tried(
    state: HullState, room: Room, ask: Ask, aim: Mapping[str, float], rounds: int
) -> _Settled:
    """Lay out the map of an aim, and measure what it gives beside the published hull."""
    vmap = VMap((*room.map(aim).layers, *ask.layers))
    certificate = room.certified(vmap, aim)
    trial = Document(copy_of(state))
    _apply(trial, vmap, room.parent, ask, room.present)
    reached = _measured(trial.state, ask)
    miss = {name: value - reached[name] for name, value in ask.values.items()}
    return _Settled(vmap, rounds, certificate, miss)


def _missed(best: _Settled, ask: Ask) -> BadInputError:
    """Say which value cannot be had, and what came nearest to it."""
    name, miss = max(best.miss.items(), key=lambda each: abs(each[1]))
    asked, unit = ask.values[name], CATALOGUE[name].unit
    return BadInputError(
        f"{name} reached {asked - miss:.9g} {unit}, asked {asked:.9g} {unit}, {abs(miss):.2g} off",
        "in vary", "ask for less, or give a finer tolerance",
    )  # fmt: skip


def _apply(
    document: Document, vmap: VMap, parent: Parent, ask: Ask, was: Mapping[str, float]
) -> tuple[Applied, EditReport]:
    """Apply a map as one step."""
    drivers = None if ask.drivers is None else Given(document.state).driving(ask.drivers)
    with Transaction(document, ask.name) as edit:
        applied = apply(
            edit, vmap, drivers=drivers, stations=ask.stations,
            follow=ask.planes == "follow", tolerance=ask.tolerance,
            particulars=_particulars(document.state, vmap, parent, ask),
            radii=asked_radii(document.state, parent, ask.values, was),
        )  # fmt: skip
    report = edit.report
    if report is None:
        raise BadInputError("an edit is open", "in vary", "finish it before")
    return applied, report


def _particulars(state: HullState, vmap: VMap, parent: Parent, ask: Ask) -> dict[str, float]:
    """Give the principal dimensions that change with the map."""
    ship, aim = state.particulars, ask.values
    found = {name: aim[name] for name in ("length", "draught") if name in aim}
    deck = parent.places.get("deck", np.array([0.5 * ship.length, 0.0, ship.depth]))
    rise = float(vmap(deck[None, :])[0, 2] - deck[2])
    if rise != 0.0:
        found["depth"] = ship.depth + rise
    sizes = ("breadth", ship.breadth, parent.breadth), ("depth", ship.depth, parent.depth)
    for name, stored, measured in sizes:
        if name in aim:
            found[name] = _in_proportion(stored, measured, aim[name])
    return found


def _in_proportion(stored: float, measured: float, asked: float) -> float:
    """Give what becomes of a stored dimension whose measured value differs a little."""
    return asked if stored == measured else stored * (asked / measured)


def _measured(state: HullState, ask: Ask) -> dict[str, float]:
    """Measure what was asked for; amplitudes are what was asked for."""
    names = [name for name in ask.values if not CATALOGUE[name].amplitude]
    found = present(measure_all(state, names), ask.layout)
    lost = [name for name in names if name not in found]
    if lost:
        raise BadInputError(
            f"cannot measure '{lost[0]}' on the varied hull", "in vary", "ask for less"
        )
    return {name: found.get(name, value) for name, value in ask.values.items()}
