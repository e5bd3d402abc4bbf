"""Targets of outputs reached together with values that are set.

Amplitudes of what is free are found by aiming, on hulls that have the set values but for what
lofting leaves over; that is added to what is asked of the map, and aimed again, until both hold.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.state import HullState
from assoc_hull.variation.aiming.corrections import Settled, changes, measured, settle
from assoc_hull.variation.aiming.hull_problem import HullProblem, Reached
from assoc_hull.variation.aiming.outputs import Outputs
from assoc_hull.variation.aiming.report import Aimed
from assoc_hull.variation.aiming.target_solver import solve
from assoc_hull.variation.ask import Ask
from assoc_hull.variation.ask_reach import AskReach
from assoc_hull.variation.carrying.hull_maps import HullMaps
from assoc_hull.variation.carrying.room import Room
from assoc_hull.variation.parameters.compose_map import refuse_clashes
from assoc_hull.variation.parameters.freedom import Freedom

__all__ = ["freedoms", "problem_of", "settle_reach"]

_RESIDUAL = 1e-10
"""Targets are met where they are missed by no more than this part of their size."""


def settle_reach(state: HullState, room: Room, ask: Ask, reach: AskReach) -> Settled:
    """Find the map at which targets are reached and values are as they are set.

    Parameters
    ----------
    state : HullState
        The tables of the parent.
    room : Room
        Lays out maps of named parameters.
    ask : Ask
        What is asked for.
    reach : AskReach
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
    return settle(
        ask, room.present,
        lambda aim, rounds: _aimed(HullMaps(room, ask, aim, free), outputs, before, reach, rounds),
    )  # fmt: skip


def problem_of(state: HullState, ask: Ask) -> HullProblem:
    """Give the problem that is solved to reach targets, at the values that are set.

    Parameters
    ----------
    state : HullState
        The tables of the parent.
    ask : Ask
        What is asked for; it names targets, and what is free.

    Raises
    ------
    UnknownNameError, BadInputError
        Targets, or what is free, that the hull has not; nothing to reach.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.variation.ask import Ask
    >>> from assoc_hull.variation.aiming.reach import problem_of
    >>> ask = Ask.of(reach={"volume": 2800.0}, free=["breadth"])
    >>> hull = problem_of(wigley(stations=5, waterlines=4), ask).at(np.zeros(1))
    >>> [each.name for each in hull.moves()], hull.jacobian.round(1).tolist()
    (['breadth'], [[275.5]])
    """
    if ask.reach is None:
        raise BadInputError("nothing to reach", "in vary", "give reach={name: value}")
    room = Room.of(state, ask.layout, ask.tolerance)
    free, outputs = freedoms(room, ask, ask.reach), Outputs.of(state, tuple(ask.reach.targets))
    return HullProblem(HullMaps(room, ask, changes(ask, room.present), free), outputs)


def freedoms(room: Room, ask: Ask, reach: AskReach) -> tuple[Freedom, ...]:
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
    maps: HullMaps, outputs: Outputs, before: FloatArray, reach: AskReach, rounds: int
) -> Settled:
    """Aim at the targets, with the values that are set as a map gives them."""
    targets = np.array(list(reach.targets.values()))
    sizes = np.maximum(np.abs(before), np.abs(targets))
    scales = np.where(sizes > 0.0, sizes, 1.0)
    for quick in (True, False):
        aimed = solve(
            HullProblem(maps, outputs, quick=quick), targets,
            start=np.zeros(len(maps.free)),
            scales_free=[each.usual for each in maps.free], scales_out=scales,
            bounds=reach.limits([each.present for each in maps.free]),
            exact=reach.exact, units=outputs.units, before=before,
        )  # fmt: skip
        if not aimed.reached or _holds(aimed, outputs, scales):
            break
    return _settled(maps, aimed, rounds)


def _holds(aimed: Aimed, outputs: Outputs, scales: FloatArray) -> bool:
    """Tell whether targets are met as well on a hull that is laid out by itself."""
    off = outputs.values(_hull(aimed).state) - aimed.targets
    return bool((np.abs(off) <= _RESIDUAL * scales).all())


def _hull(aimed: Aimed) -> Reached:
    assert isinstance(aimed.hull, Reached), "the problem gives no other"
    return aimed.hull


def _settled(maps: HullMaps, aimed: Aimed, rounds: int) -> Settled:
    """Say how the hull that was found is made of the parent."""
    hull = _hull(aimed)
    whole, certificate = maps.certified(hull.amplitudes)
    got = measured(hull.state, maps.ask)
    miss = {name: value - got[name] for name, value in maps.ask.values.items()}
    base = hull.base
    return Settled(
        maps.map(base.amplitudes), rounds, certificate, miss, maps.values(base.amplitudes),
        whole, base.nudge_to(hull.amplitudes), aimed,
    )  # fmt: skip
