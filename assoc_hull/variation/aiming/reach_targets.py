"""Set values and targets met on the lofted hull: lay out, measure, correct, until both hold.

A map moves the measured places exactly, but the hull that is lofted again through its images keeps
them only within a tolerance. What is missing is added to what is asked of the map. Targets of
outputs are reached on hulls that have the set values but for what lofting leaves over; then that
is added, and the targets are solved for again.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import attrs
import numpy as np

from assoc_hull.edit.nudge import Nudge
from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.tables import HullState
from assoc_hull.variation.aiming.hull_problem import HullProblem, Reached
from assoc_hull.variation.aiming.outputs import Outputs
from assoc_hull.variation.aiming.report import AimReport
from assoc_hull.variation.aiming.target_solver import solve_targets
from assoc_hull.variation.carrying.admissible_values import SAME, AdmissibleValues
from assoc_hull.variation.carrying.hull_maps import HullMaps
from assoc_hull.variation.certificate.fold_check import Certificate
from assoc_hull.variation.fields.space_map import VariationMap
from assoc_hull.variation.parameters.catalogue import CATALOGUE, Freedom
from assoc_hull.variation.parameters.compose_map import refuse_clashes
from assoc_hull.variation.parameters.parameter_measures import measure_all
from assoc_hull.variation.parameters.value_limits import present_values
from assoc_hull.variation.request import TargetRequest, VariationRequest

__all__ = [
    "SettledMap",
    "changed_values",
    "freedoms",
    "measure_requested",
    "problem_of",
    "settle_map",
    "settle_reach",
]

# --------------------------------------------------------------------------------------
# Set values, without targets.

_MET = 1e-7
"""A set value (m, degrees) is met where its residual is less than this; 1e-6 is promised."""

_PROMISED = 1e-6
_ROUNDS = 6


@attrs.frozen(eq=False)
class SettledMap:
    """A map whose applied values are nearly the asked ones, how it was found, its residuals.

    Attributes
    ----------
    map : VariationMap
        The map by which the hull is carried.
    rounds : int
        How often it was laid out.
    certificate : Certificate
        Of the whole map.
    miss : dict of str to float, m or degrees
        Asked less measured values, by name.
    values : mapping of str to float
        What named parameters get by it, free ones among them.
    whole : VariationMap
        The map together with what is nudged after it.
    nudge : Nudge or None
        What moves when the map has been applied.
    aimed : AimReport or None
        What was found for targets that were to be reached.
    """

    map: VariationMap
    rounds: int
    certificate: Certificate
    miss: dict[str, float]
    values: Mapping[str, float]
    whole: VariationMap
    nudge: Nudge | None = None
    aimed: AimReport | None = None

    @property
    def worst(self) -> float:
        """The largest residual of a set value, m or degrees."""
        return max((abs(each) for each in self.miss.values()), default=0.0)


Attempt = Callable[[Mapping[str, float], int], SettledMap]
"""Takes what the map is to give to parameters, and the number of the round."""


def changed_values(ask: VariationRequest, was: Mapping[str, float]) -> dict[str, float]:
    """Give the values that are set, without those that the hull has already."""
    return {name: value for name, value in ask.values.items() if abs(value - was[name]) > SAME}


def settle_map(ask: VariationRequest, was: Mapping[str, float], attempt: Attempt) -> SettledMap:
    """Find what is to be asked of a map so that its applied values are the asked ones.

    Parameters
    ----------
    ask : VariationRequest
        What is asked for.
    was : mapping of str to float
        Present values.
    attempt : callable
        Lays out a map, and measures what it gives beside the published hull.

    Raises
    ------
    BadInputError
        A value cannot be had to 1e-6.
    AssocHullError
        What the first attempt raises.
    """
    aim = changed_values(ask, was)
    best = found = attempt(aim, 1)
    for rounds in range(2, _ROUNDS + 1):
        if best.worst <= _MET:
            break
        aim = _corrected(aim, ask, found.miss)
        try:
            found = attempt(aim, rounds)
        except AssocHullError:
            break  # the correction went astray: what was asked for is not at fault
        if found.worst < best.worst:
            best = found
    if best.worst > _PROMISED:
        raise _missed(best, ask)
    return best


def measure_requested(state: HullState, ask: VariationRequest) -> dict[str, float]:
    """Measure the values that were asked for; amplitudes, no measures of a hull, stay as asked.

    Raises
    ------
    BadInputError
        A value has no meaning on this hull any more.
    """
    names = [name for name in ask.values if not CATALOGUE[name].amplitude]
    found = present_values(measure_all(state, names), ask.layout) if names else {}
    lost = [name for name in names if name not in found]
    if lost:
        raise BadInputError(
            f"cannot measure '{lost[0]}' on the varied hull", "in vary", "ask for less"
        )
    return {name: found.get(name, value) for name, value in ask.values.items()}


def _corrected(
    aim: Mapping[str, float], ask: VariationRequest, miss: Mapping[str, float]
) -> dict[str, float]:
    """Add the residuals to what the map is to give.

    A value that was to stay, but that others move away, is asked for as well.
    """
    return {
        name: aim.get(name, ask.values[name]) + each
        for name, each in miss.items() if name in aim or abs(each) > _MET
    }  # fmt: skip


def _missed(best: SettledMap, ask: VariationRequest) -> BadInputError:
    """Say which value cannot be had, and what came nearest to it."""
    name, miss = max(best.miss.items(), key=lambda each: abs(each[1]))
    asked, unit = ask.values[name], CATALOGUE[name].unit
    return BadInputError(
        f"{name} reached {asked - miss:.9g} {unit}, asked {asked:.9g} {unit}, {abs(miss):.2g} off",
        "in vary", "ask for less, or give a finer tolerance",
    )  # fmt: skip


# --------------------------------------------------------------------------------------
# Targets of outputs, together with values that are set.

_RESIDUAL = 1e-10
"""Targets are met where their residual is no more than this part of their size."""


def settle_reach(
    state: HullState, room: AdmissibleValues, ask: VariationRequest, reach: TargetRequest
) -> SettledMap:
    """Find the map at which targets are reached and values are as they are set.

    Parameters
    ----------
    state : HullState
        The tables of the parent.
    room : AdmissibleValues
        Lays out maps of named parameters.
    ask : VariationRequest
        What is asked for.
    reach : TargetRequest
        Its targets.

    Raises
    ------
    UnknownNameError, BadInputError
        Targets, or what is free, that the hull has not.
    UnreachableError, DependentTargetsError, TooFewFreeError
        Targets that cannot be reached.
    """
    free = freedoms(room, ask, reach)
    outputs = Outputs.of(state, tuple(reach.targets))
    before = outputs.values(state)
    return settle_map(
        ask, room.present,
        lambda aim, rounds: _aimed(HullMaps(room, ask, aim, free), outputs, before, reach, rounds),
    )  # fmt: skip


def problem_of(state: HullState, ask: VariationRequest) -> HullProblem:
    """Give the problem that is solved to reach targets, at the values that are set.

    Parameters
    ----------
    state : HullState
        The tables of the parent.
    ask : VariationRequest
        What is asked for; it names targets, and what is free.

    Raises
    ------
    UnknownNameError, BadInputError
        Targets, or what is free, that the hull has not; nothing to reach.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.variation.request import VariationRequest
    >>> from assoc_hull.variation.aiming.reach_targets import problem_of
    >>> ask = VariationRequest.of(reach={"volume": 2800.0}, free=["breadth"])
    >>> hull = problem_of(wigley(stations=5, waterlines=4), ask).at(np.zeros(1))
    >>> [each.name for each in hull.moves()], hull.jacobian.round(1).tolist()
    (['breadth'], [[275.5]])
    """
    if ask.reach is None:
        raise BadInputError("nothing to reach", "in vary", "give reach={name: value}")
    room = AdmissibleValues.of(state, ask.layout, ask.tolerance)
    free, outputs = freedoms(room, ask, ask.reach), Outputs.of(state, tuple(ask.reach.targets))
    return HullProblem(HullMaps(room, ask, changed_values(ask, room.present), free), outputs)


def freedoms(
    room: AdmissibleValues, ask: VariationRequest, reach: TargetRequest
) -> tuple[Freedom, ...]:
    """Take what is free, as the hull has it.

    Raises
    ------
    BadInputError
        The hull has no such parameter; two that are one number.
    """
    named = [each for each in reach.free if isinstance(each, str)]
    for name in named:
        if name not in room.present:
            why = room.parent.absent.get(name, "the hull has none")
            raise BadInputError(f"cannot free '{name}': {why}", "in vary", "leave it out")
    refuse_clashes({**ask.values, **{name: room.present[name] for name in named}}, ask.layout)
    return tuple(
        Freedom.named(each, room.present[each], room.parent.length)
        if isinstance(each, str) else Freedom.raw(each)
        for each in reach.free
    )  # fmt: skip


def _aimed(
    maps: HullMaps, outputs: Outputs, before: FloatArray, reach: TargetRequest, rounds: int
) -> SettledMap:
    """Solve for the targets, with the values that are set as a map gives them."""
    targets = np.array(list(reach.targets.values()))
    sizes = np.maximum(np.abs(before), np.abs(targets))
    scales = np.where(sizes > 0.0, sizes, 1.0)
    # quick hulls first; in full only where these do not hold on a hull laid out by itself
    for quick in (True, False):
        aimed = solve_targets(
            HullProblem(maps, outputs, quick=quick), targets,
            start=np.zeros(len(maps.free)),
            scales_free=[each.usual for each in maps.free], scales_out=scales,
            bounds=reach.limits([each.present for each in maps.free]),
            exact=reach.exact, units=outputs.units, before=before,
        )  # fmt: skip
        if not aimed.reached or _holds(aimed, outputs, scales):
            break
    return _settled(maps, aimed, rounds)


def _holds(aimed: AimReport, outputs: Outputs, scales: FloatArray) -> bool:
    """Tell whether targets are met as well on a hull that is laid out by itself."""
    off = outputs.values(_hull(aimed).state) - aimed.targets
    return bool((np.abs(off) <= _RESIDUAL * scales).all())


def _hull(aimed: AimReport) -> Reached:
    """Give the hull that the solver ended at."""
    assert isinstance(aimed.hull, Reached), "the problem gives no other"
    return aimed.hull


def _settled(maps: HullMaps, aimed: AimReport, rounds: int) -> SettledMap:
    """Say how the hull that was found comes of the parent, and its residuals of set values."""
    hull = _hull(aimed)
    whole, certificate = maps.certified(hull.amplitudes)
    got = measure_requested(hull.state, maps.ask)
    miss = {name: value - got[name] for name, value in maps.ask.values.items()}
    base = hull.base
    return SettledMap(
        maps.map(base.amplitudes), rounds, certificate, miss, maps.values(base.amplitudes),
        whole, base.nudge_to(hull.amplitudes), aimed,
    )  # fmt: skip
