"""A map of which it is known that its applied values are the asked ones, nearly."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import attrs

from assoc_hull.edit.nudge import Nudge
from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.model.state import HullState
from assoc_hull.variation.aiming.report import Aimed
from assoc_hull.variation.ask import Ask
from assoc_hull.variation.carrying.room import SAME
from assoc_hull.variation.certificate.record import Certificate
from assoc_hull.variation.fields.space_map import VMap
from assoc_hull.variation.parameters.catalogue import CATALOGUE
from assoc_hull.variation.parameters.limits import present
from assoc_hull.variation.parameters.parameter_measures import measure_all

__all__ = ["Settled", "changes", "measured", "settle"]

_MET = 1e-7
"""A target (m, degrees) is met where it is missed by less than this; 1e-6 is promised."""

_PROMISED = 1e-6
_ROUNDS = 6


@attrs.frozen(eq=False)
class Settled:
    """A map whose applied values are nearly the asked ones, how it was found, what it misses.

    Attributes
    ----------
    map : VMap
        The map by which the hull is carried.
    rounds : int
        How often it was laid out.
    certificate : Certificate
        Of the whole map.
    miss : dict of str to float, m or degrees
        Asked less measured values, by name.
    values : mapping of str to float
        What named parameters get by it, free ones among them.
    whole : VMap
        The map together with what is nudged after it.
    nudge : Nudge or None
        What moves when the map has been applied.
    aimed : Aimed or None
        What was found for targets that were to be reached.
    """

    map: VMap
    rounds: int
    certificate: Certificate
    miss: dict[str, float]
    values: Mapping[str, float]
    whole: VMap
    nudge: Nudge | None = None
    aimed: Aimed | None = None

    @property
    def worst(self) -> float:
        """The largest miss, m or degrees."""
        return max((abs(each) for each in self.miss.values()), default=0.0)


Attempt = Callable[[Mapping[str, float], int], Settled]
"""Takes what the map is to give to parameters, and the number of the round."""


def changes(ask: Ask, was: Mapping[str, float]) -> dict[str, float]:
    """Give the values that are set, but for those that are so already."""
    return {name: value for name, value in ask.values.items() if abs(value - was[name]) > SAME}


def settle(ask: Ask, was: Mapping[str, float], attempt: Attempt) -> Settled:
    """Find what is to be asked of a map so that its applied values are the asked ones.

    Parameters
    ----------
    ask : Ask
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
    aim = changes(ask, was)
    best = found = attempt(aim, 1)
    for rounds in range(2, _ROUNDS + 1):
        if best.worst <= _MET:
            break
        aim = _corrected(aim, ask, found.miss)
        try:
            found = attempt(aim, rounds)
        except AssocHullError:
            break  # the aim went astray: what was asked for is not at fault
        if found.worst < best.worst:
            best = found
    if best.worst > _PROMISED:
        raise _missed(best, ask)
    return best


def measured(state: HullState, ask: Ask) -> dict[str, float]:
    """Measure what was asked for; amplitudes are what was asked for.

    Raises
    ------
    BadInputError
        A value has no meaning on this hull any more.
    """
    names = [name for name in ask.values if not CATALOGUE[name].amplitude]
    found = present(measure_all(state, names), ask.layout) if names else {}
    lost = [name for name in names if name not in found]
    if lost:
        raise BadInputError(
            f"cannot measure '{lost[0]}' on the varied hull", "in vary", "ask for less"
        )
    return {name: found.get(name, value) for name, value in ask.values.items()}


def _corrected(aim: Mapping[str, float], ask: Ask, miss: Mapping[str, float]) -> dict[str, float]:
    """Add what is missing to what the map is to give.

    What others move away from a value that was to stay is asked for as well.
    """
    return {
        name: aim.get(name, ask.values[name]) + each
        for name, each in miss.items() if name in aim or abs(each) > _MET
    }  # fmt: skip


def _missed(best: Settled, ask: Ask) -> BadInputError:
    """Say which value cannot be had, and what came nearest to it."""
    name, miss = max(best.miss.items(), key=lambda each: abs(each[1]))
    asked, unit = ask.values[name], CATALOGUE[name].unit
    return BadInputError(
        f"{name} reached {asked - miss:.9g} {unit}, asked {asked:.9g} {unit}, {abs(miss):.2g} off",
        "in vary", "ask for less, or give a finer tolerance",
    )  # fmt: skip
