"""What earlier variations of a hull set, reached and spent, and what has become of it.

Each step of a variation keeps its values as data. So a later one can say that it left a volume that
was reached before, and a hull can tell by how much its sections have been shifted in all, of which
its lines show nothing.
"""

from __future__ import annotations

from collections.abc import Mapping

import attrs

from assoc_hull.edit.document import Document
from assoc_hull.edit.recording import VariedValues
from assoc_hull.errors import AssocHullError
from assoc_hull.model.tables import HullState
from assoc_hull.variation.aiming.outputs import Outputs
from assoc_hull.variation.aiming.report import AimReport
from assoc_hull.variation.parameters.catalogue import CATALOGUE
from assoc_hull.variation.parameters.compose_map import conflicts
from assoc_hull.variation.request import VariationRequest

__all__ = ["left_values", "values_before", "values_of_variation", "varied_values"]

_SAME = 1e-6
"""A value as near as this to what was asked before (m, degrees, or that part of it) is held."""


def values_of_variation(
    ask: VariationRequest, was: Mapping[str, float], aim: AimReport | None
) -> VariedValues:
    """Give what a variation set, reached and spent, to be kept with its step.

    Parameters
    ----------
    ask : VariationRequest
        What was asked for.
    was : mapping of str to float
        Values of named parameters before, of those that have any.
    aim : AimReport or None
        How targets were reached.
    """
    amplitudes = {name: value for name, value in ask.values.items() if CATALOGUE[name].amplitude}
    spent = {name: value for name, value in ask.values.items() if name in amplitudes}
    spent |= {
        name: value - was[name] for name, value in ask.values.items()
        if name not in amplitudes and name in was
    }  # fmt: skip
    spent |= {layer.name: 1.0 for layer in ask.layers}
    reached = dict[str, float]()
    if aim is not None:
        spent |= dict(zip(aim.free, aim.amplitudes.tolist(), strict=True))
        if aim.reached:
            reached = dict(zip(aim.outputs, aim.targets.tolist(), strict=True))
    held = {name: value for name, value in ask.values.items() if name not in amplitudes}
    return VariedValues(held, reached, spent)


def varied_values(document: Document) -> VariedValues:
    """Give what variations gave a hull in all: in its history, and before that began."""
    found = values_before(document)
    for step in tuple(document.history):
        found = found.then(step.script.varied)
    return found


def values_before(document: Document) -> VariedValues:
    """Give what it had been given before its history began.

    A file keeps that with a step, be it undone or on another branch.
    """
    told = (step.script.before for step in tuple(document.steps.values()))
    return next(filter(None, told), document.varied_before)


@attrs.frozen
class _Earlier:
    """A value that an earlier variation gave."""

    name: str
    act: str
    value: float
    step: int


def left_values(
    document: Document, ask: VariationRequest, now: Mapping[str, float]
) -> tuple[str, ...]:
    """Give notes on values that earlier variations set or reached, and that this one has left.

    Parameters
    ----------
    document : Document
        The hull as it is now, its history without this one.
    ask : VariationRequest
        What this one was asked for: what it was given anew is not told.
    now : mapping of str to float
        Named parameters as they are now.
    """
    asked = {*ask.values, *({} if ask.reach is None else ask.reach.targets)}
    latest, state = dict[str, _Earlier](), document.state
    steps = [(step.number, step.script.varied) for step in tuple(document.history)]
    for number, varied in ((0, values_before(document)), *steps):
        for act, values in (("set", varied.set), ("reached", varied.reached)):
            for name, amount in values.items():
                latest[name] = _Earlier(name, act, amount, number)
    found = list[str]()
    for each in latest.values():
        if each.name in asked:
            continue
        value = now.get(each.name) if each.act == "set" else _output(each.name, state)
        if value is not None and not _held(each, value):
            found.append(f"{_left(each, value)}; {_remedy(each, ask)}")
    return tuple(found)


def _output(name: str, state: HullState) -> float | None:
    """Measure an output; None where the hull has it no more."""
    try:
        return float(Outputs.of(state, [name]).values(state)[0])
    except AssocHullError:
        return None


def _held(each: _Earlier, value: float) -> bool:
    size = abs(each.value) if each.act == "reached" else 1.0
    return abs(value - each.value) <= _SAME * max(size, 1e-300)


def _left(each: _Earlier, value: float) -> str:
    """Say what has become of a value."""
    off = f"{100.0 * (value / each.value - 1.0):+.2g} %" if each.value else f"{value:+.3g}"
    when = f"in step {each.step}" if each.step else "before"
    return f"{each.name} was {each.act} {when} ({each.value:.9g}): now {off}"


_FREE = ("fore_shift", "aft_shift", "breadth", "draught")
_ONE = frozenset({"volume", "displacement"})
"""Outputs that are one number."""


def _remedy(each: _Earlier, ask: VariationRequest) -> str:
    """Say what would hold a value beside what is asked; `vary` takes it."""
    targets, free = ((), ()) if ask.reach is None else (tuple(ask.reach.targets), ask.reach.names)
    told = f"{{{each.name!r}: {each.value:.9g}}}"
    if each.act == "set":
        apart = [name for name in conflicts(each.name, ask.layout) if name in ask.values]
        if apart:
            return f"nothing holds it beside {apart[0]}"
        if each.name in free:
            return f"set={told} with something else free in its place would hold it"
        return f"set={told} beside what is asked would hold it"
    if each.name in _ONE and _ONE.intersection(targets):
        return f"nothing holds it beside {', '.join(sorted(_ONE.intersection(targets)))}"
    names = [name for name in _FREE if name not in ask.values and name not in free]
    more = ", ".join(f'"{name}"' for name in names[:2])
    return f"reach={told} beside what is asked and something free, as free=[{more}] would hold it"
