"""A variation carried out: lay out, certify, apply, measure, and correct until all is met.

The map is found beside the published hull: what is missing of the asked values, as measured on a
lofted trial, is added to what is asked of the map. Then `vary_document` varies the hull in one
step. The notes of its report say what a designer should know besides: folds beyond the hull,
planes that went along, values that changed as well.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import attrs
import numpy as np

from assoc_hull.edit.document import Document
from assoc_hull.edit.mapped_planes import IN_PLANE
from assoc_hull.edit.report import EditReport
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.tables import HullState, copy_state
from assoc_hull.variation.aiming.reach_targets import (
    SettledMap,
    measure_requested,
    settle_map,
    settle_reach,
)
from assoc_hull.variation.aiming.report import AimReport
from assoc_hull.variation.carrying.admissible_values import AdmissibleValues
from assoc_hull.variation.carrying.carry_hull import carry_out
from assoc_hull.variation.certificate.fold_check import Certificate, fold_outside
from assoc_hull.variation.fields.field import FieldRegion
from assoc_hull.variation.fields.space_map import VariationMap
from assoc_hull.variation.parameters.catalogue import CATALOGUE
from assoc_hull.variation.parameters.parameter_fields import shift_terminals
from assoc_hull.variation.parameters.parameter_measures import measure_all
from assoc_hull.variation.parameters.parent import Parent
from assoc_hull.variation.parameters.value_limits import hull_box, present_values
from assoc_hull.variation.request import VariationRequest, script_of

__all__ = [
    "Target",
    "VariationReport",
    "also_changed",
    "folds_outside",
    "shifted_without_body",
    "vary_document",
    "went_along",
]

# --------------------------------------------------------------------------------------
# Notes of the report: what a designer should know besides.

_SEEN = 1e-3
"""A named value that changes by less (m, degrees) is not reported."""


def folds_outside(vmap: VariationMap, state: HullState, tolerance: float) -> tuple[str, ...]:
    """Give a note where a map folds beyond the hull; none where it does not."""
    beyond = fold_outside(vmap, hull_box(state, tolerance))
    if beyond is None:
        return ()
    x, _, z = beyond.witness
    return (f"fold_outside_hull: the map folds at x={x:.3f} z={z:.3f}, where there is no hull",)


def went_along(before: FloatArray, state: HullState) -> tuple[str, ...]:
    """Give a note on waterlines and buttocks that went with the map, as names may say a height.

    Parameters
    ----------
    before : (l,), m
        Offsets of the planes of all lines.
    state : HullState
        The hull afterwards.
    """
    lines = np.array([
        line for line in state.live("lines").tolist()
        if state.family(line).axis in (1, 2) and state.lines.boundary[line] < 0
    ], np.int64)  # fmt: skip
    moved = np.abs(state.lines.offset[lines] - before[lines])
    gone = lines[moved > IN_PLANE]
    if not len(gone):
        return ()
    farthest = int(lines[np.nanargmax(moved)])
    name, level = state.lines.name[farthest], float(state.lines.offset[farthest])
    told = f"{len(gone)} waterlines and buttocks went along and kept their names"
    return (f"{told}: {name} is at {level:.6g} m",)


def also_changed(
    before: Mapping[str, float], after: Mapping[str, float], asked: Mapping[str, float]
) -> tuple[str, ...]:
    """Give a note on values that changed unasked: a field moves all that it reaches.

    Examples
    --------
    >>> from assoc_hull.variation.vary import also_changed
    >>> was = {"shaft_height": 5.0, "transom_height": 18.4}
    >>> also_changed(was, {"shaft_height": 6.0, "transom_height": 18.632}, {"shaft_height": 6.0})
    ('also changed: transom_height 18.4 -> 18.632 m',)
    """
    told = [
        f"{name} {before[name]:.6g} -> {after[name]:.6g} {CATALOGUE[name].unit}"
        for name in CATALOGUE
        if name in before and name in after and name not in asked
        and abs(after[name] - before[name]) > _SEEN
    ]  # fmt: skip
    return (f"also changed: {', '.join(told)}",) if told else ()


def shifted_without_body(
    parent: Parent, asked: Iterable[str] = ("fore_shift", "aft_shift")
) -> tuple[str, ...]:
    """Give a note on what stands for the parallel body where sections shift and there is none.

    Parameters
    ----------
    parent : Parent
    asked : iterable of str
        Names of the parameters that are asked for.
    """
    shifts = any(name in ("fore_shift", "aft_shift") for name in asked)
    if not shifts or parent.has("body start") or not parent.has("largest aft"):
        return ()
    _, start, end, _ = shift_terminals(parent, "section shifts")
    where = f"at {start:.6g} m" if start == end else f"from {start:.6g} to {end:.6g} m"
    what = "the largest station stands" if start == end else "the two largest stations stand"
    return (f"no parallel middle body: {what} for it, {where}",)


# --------------------------------------------------------------------------------------
# The variation and its report.


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
    regions : tuple of FieldRegion
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
        What was asked for as data: with it, `Hull.vary_by` repeats the variation.
        None where layers were given that are not data.
    aim : AimReport or None
        How targets of outputs were reached; None where none were given.
    """

    targets: tuple[Target, ...]
    rounds: int
    regions: tuple[FieldRegion, ...]
    drivers: tuple[str, ...]
    added: int
    certificate: Certificate
    edit: EditReport
    notes: tuple[str, ...] = ()
    script: Mapping[str, Any] | None = None
    aim: AimReport | None = None

    def __str__(self) -> str:
        aimed = () if self.aim is None else (str(self.aim),)
        targets = (str(each) for each in self.targets)
        return "\n".join([*targets, *aimed, *self.notes, str(self.edit)])


def vary_document(
    document: Document, ask: VariationRequest
) -> tuple[VariationMap, VariationReport]:
    """Vary a hull in place, as one step that can be undone.

    Parameters
    ----------
    document : Document
        The hull.
    ask : VariationRequest
        What is asked for.

    Raises
    ------
    BadInputError, FoldError, RefusedEditError
        What is asked for cannot be had; the hull is unchanged.
    """
    room = AdmissibleValues.of(document.state, ask.layout, ask.tolerance)
    parent, was = room.parent, room.present
    for name in ask.values:
        if name in parent.absent:
            raise BadInputError(
                f"cannot vary '{name}': {parent.absent[name]}", "in vary", "leave it out"
            )
    found = _settled(document, room, ask)
    levels = document.state.lines.offset.data.copy()
    applied, report = carry_out(document, found.map, parent, ask, was, found.values, found.nudge)
    reached = measure_requested(document.state, ask)
    targets = tuple(
        Target(name, CATALOGUE[name].unit, was[name], value, reached[name])
        for name, value in ask.values.items()
    )
    regions = (*found.whole.regions(), *applied.regions)
    now = present_values(measure_all(document.state), ask.layout)
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


def _settled(document: Document, room: AdmissibleValues, ask: VariationRequest) -> SettledMap:
    """Find the map whose applied values are the asked ones, and what is nudged after it."""
    room.check(ask.values)
    if ask.reach is not None:
        return settle_reach(document.state, room, ask, ask.reach)
    return settle_map(
        ask, room.present, lambda aim, rounds: _tried(document.state, room, ask, aim, rounds)
    )


def _tried(
    state: HullState,
    room: AdmissibleValues,
    ask: VariationRequest,
    aim: Mapping[str, float],
    rounds: int,
) -> SettledMap:
    """Lay out the map of an aim, and measure what it gives beside the published hull."""
    vmap = VariationMap((*room.map(aim).layers, *ask.layers))
    certificate = room.certified(vmap, aim)
    trial = Document(copy_state(state))
    carry_out(trial, vmap, room.parent, ask, room.present)
    reached = measure_requested(trial.state, ask)
    miss = {name: value - reached[name] for name, value in ask.values.items()}
    return SettledMap(vmap, rounds, certificate, miss, ask.values, vmap)
