"""Set values and targets met on the lofted hull: carry, measure, correct, until both hold.

A map moves the measured places exactly, but the hull that is lofted again through its images keeps
them only within a tolerance, and maps that come later move what earlier ones have placed. Misses
are small, mostly: the hull is nudged by the map that makes up for them, in which no point comes or
goes, so that what is measured is smooth. Where that will not do, what the maps are to give, the
aims, is corrected, and the whole plan is carried out anew from the parent: lines that are cut anew
on top of a carried hull would come with an error of lofting of their own each time. Targets of
outputs are reached on the hull that the plan gives, in each round; a nudge holds them, by what is
free for it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import attrs
import numpy as np

from assoc_hull.errors import AssocHullError, BadInputError, RefusedEditError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.model.tables import HullState, copy_state
from assoc_hull.variation.aiming.hull_problem import HullProblem, NudgeBase, Reached
from assoc_hull.variation.aiming.outputs import Outputs
from assoc_hull.variation.aiming.report import AimReport
from assoc_hull.variation.aiming.target_solver import solve_targets
from assoc_hull.variation.carrying.admissible_values import SAME, AdmissibleValues
from assoc_hull.variation.carrying.carry_stages import CarriedMap, StagedCarry
from assoc_hull.variation.carrying.hull_maps import HullMaps
from assoc_hull.variation.fields.space_map import VariationMap
from assoc_hull.variation.parameters.catalogue import CATALOGUE, Freedom
from assoc_hull.variation.parameters.compose_map import compose_map, refuse_clashes
from assoc_hull.variation.parameters.parameter_measures import measure_all
from assoc_hull.variation.parameters.value_limits import present_values
from assoc_hull.variation.request import TargetRequest, VariationRequest

if TYPE_CHECKING:
    from assoc_hull.variation.faired_followers import FairedFollowers

__all__ = [
    "PROMISED",
    "SettledPlan",
    "changed_values",
    "freedoms",
    "measure_requested",
    "problem_of",
    "settle_plan",
    "targets_before",
]

# --------------------------------------------------------------------------------------
# Aims: corrected by the rule of C. G. Broyden, "A class of methods for solving nonlinear
# simultaneous equations", Mathematics of Computation 19, 1965: with e the misses, d the last step
# of the aims and B at first the identity,
#
#     a <- a + B e        B <- B + (d - B y) (d B) / (d . B y)        y = e_old - e_new

_MET = 1e-7
"""A set value (m, degrees) is met where its residual is less than this; 1e-6 is promised."""

PROMISED = 1e-6

_HELD, _HELD_PROMISED = 1e-9, 1e-8
"""Targets are held by fairing where they are off by less than this part of their size."""

_ROUNDS = 7

_SEARCHED = 2
"""So often what fairs the followers is searched for anew, as each search gives another hull; then
it is done again as it was found, and values are met with it."""

_JUMPED = 0.1
"""A miss of more than this part of a value, and than the change that was asked for, is no miss of
a map: what is measured has jumped to another place of the hull."""

_JUMP = 2e-2
"""Nor is one of less than this times Lpp, m, or than this many times 100 degrees."""


@attrs.frozen(eq=False)
class SettledPlan:
    """A plan carried out so that all set values are met, and how that was found.

    Attributes
    ----------
    carry : StagedCarry
        The maps, which have carried the hull of the edit.
    aims : mapping of str to float, m or degrees
        What they were to give the parameters.
    miss : mapping of str to float, m or degrees
        Asked less measured values, by name.
    start : (k,) or None
        The amplitudes of what is free from which targets were sought; None for none.
    aimed : AimReport or None
        What was found for targets that were to be reached.
    values : mapping of str to float
        What named parameters get, free ones among them.
    rounds : int
        How often the plan was carried out in full.
    faired : FairedFollowers or None
        How followers were faired after it.
    off, shift : (m,), of the size of targets; (m,)
        By how much targets are missed with followers faired, and by how much less was aimed at.
    again : FairedFollowers or None
        The fairing that was to be repeated; None where it was searched for at once.
    insist : bool
        Whether it was taken as it came.
    """

    carry: StagedCarry
    aims: Mapping[str, float]
    miss: Mapping[str, float]
    start: FloatArray | None
    aimed: AimReport | None
    values: Mapping[str, float]
    rounds: int = 1
    faired: FairedFollowers | None = None
    off: FloatArray | None = None
    shift: FloatArray | None = None
    again: FairedFollowers | None = None
    insist: bool = False

    @property
    def missed(self) -> float:
        """By what part of its size a target is missed at most, with followers faired."""
        return 0.0 if self.off is None else float(np.abs(self.off).max())

    @property
    def unmet(self) -> float:
        """How large misses are beside those that are taken for none."""
        return max(self.worst / _MET, self.missed / _HELD)

    @property
    def worst(self) -> float:
        """The largest residual of a set value, m or degrees."""
        return max((abs(each) for each in self.miss.values()), default=0.0)


@attrs.frozen(eq=False)
class _Aims:
    """Aims of set values, and what the rounds have told of how they act."""

    names: tuple[str, ...]
    aim: FloatArray
    inverse: FloatArray
    step: FloatArray | None = None
    miss: FloatArray | None = None

    @classmethod
    def of(cls, ask: VariationRequest) -> _Aims:
        names = tuple(ask.values)
        return cls(names, np.array([ask.values[name] for name in names]), np.eye(len(names)))

    @property
    def values(self) -> dict[str, float]:
        return dict(zip(self.names, self.aim.tolist(), strict=True))

    def corrected(self, miss: Mapping[str, float]) -> _Aims:
        """Give the aims of the next round."""
        now, inverse = np.array([miss[name] for name in self.names]), self.inverse
        if self.step is not None and self.miss is not None:
            gone = inverse @ (self.miss - now)
            along = float(self.step @ gone)
            if along:
                inverse = inverse + np.outer(self.step - gone, self.step @ inverse) / along
        step = inverse @ now
        return _Aims(self.names, self.aim + step, inverse, step, now)

    def afresh(self) -> _Aims:
        """Forget the last step: what came of it was another hull than that before it."""
        return _Aims(self.names, self.aim, self.inverse)


def targets_before(room: AdmissibleValues, ask: VariationRequest) -> FloatArray | None:
    """Measure the targets (m,) of the parent; None if there are none.

    Raises
    ------
    UnknownNameError, BadInputError
        Targets, or what is free, that the hull has not.
    """
    if ask.reach is None:
        return None
    freedoms(room, ask, ask.reach)  # refused before anything is carried
    return Outputs.of(room.state, tuple(ask.reach.targets)).values(room.state)


def settle_plan(
    carry: StagedCarry, room: AdmissibleValues, before: FloatArray | None
) -> SettledPlan:
    """Carry out a plan so that the set values are met, and targets are reached if there are any.

    Parameters
    ----------
    carry : StagedCarry
        The plan; when this returns, the hull of its edit is the varied one.
    room : AdmissibleValues
        What is measured of the parent; its tables may be those of the edit.
    before : (m,) or None
        Targets as the parent has them, by `targets_before`.

    Raises
    ------
    BadInputError
        A value cannot be had to 1e-6.
    UnreachableError, DependentTargetsError, TooFewFreeError
        Targets that cannot be reached.
    AssocHullError
        What the first round raises.
    """
    ask, aims, start = carry.ask, _Aims.of(carry.ask), None
    carry.base = room
    best = found = _attempt(carry, aims.values, before, start)
    _refuse_jump(found, room)
    there: SettledPlan | None = found
    rounds, searched = 1, 0
    while best.unmet > 1.0 and rounds < _ROUNDS + searched:
        if (nudged := _nudged(carry, found, before)) is not None:
            return attrs.evolve(nudged, rounds=rounds)
        aims, rounds, again = aims.corrected(found.miss), rounds + 1, found.faired
        start = None if found.aimed is None else _hull(found.aimed).amplitudes
        try:
            found = there = _attempt(
                carry,
                aims.values,
                before,
                start,
                again,
                _shifted(found),
                insist=searched >= _SEARCHED,
            )
        except AssocHullError:
            there = None  # the correction went astray: what was asked for is not at fault
            break
        if again is not None and found.faired is not None and found.faired.steps is not again.steps:
            searched, aims = searched + 1, aims.afresh()
        if found.unmet < best.unmet:
            best = found
    if best.worst > PROMISED or best.missed > _HELD_PROMISED:
        raise _missed(best, ask)
    if best is not there:
        best = _attempt(
            carry, best.aims, before, best.start, best.again, best.shift, insist=best.insist
        )
    return attrs.evolve(best, rounds=rounds)


def _attempt(
    carry: StagedCarry,
    aims: Mapping[str, float],
    before: FloatArray | None,
    start: FloatArray | None,
    again: FairedFollowers | None = None,
    shift: FloatArray | None = None,
    *,
    insist: bool = False,
) -> SettledPlan:
    """Carry out the plan with some aims, and measure what it gives.

    What fairs the followers is searched for, or done `again`, which `insist` takes as it comes;
    `shift` (m,) is by how much less than the targets is aimed at.
    """
    ask, aimed, values = carry.ask, None, dict(carry.ask.values)
    if carry.together:
        carry.edit.take_back()
        carry.carried.clear()
    else:
        carry.run(aims)
    if before is not None and ask.reach is not None:
        left = aims if carry.together else {}
        aimed, free = _reached(carry, ask.reach, left, before, start, shift)
        values |= free
    elif not carry.carried:
        carry.carry_by_nothing()
    faired, off = _faired(carry, again, insist=insist), None
    if faired is not None and aimed is not None and ask.reach is not None and before is not None:
        aimed, off = _after_fairing(carry, aimed, ask.reach, before)
    miss = _misses(carry.edit.state, ask)
    return SettledPlan(
        carry, dict(aims), miss, start, aimed, values,
        faired=faired, off=off, shift=shift, again=again, insist=insist,
    )  # fmt: skip


# --------------------------------------------------------------------------------------
# Small misses: the carried hull is nudged, which keeps its points, so that values are smooth in it.

_TRIALS = 6

_STRAY = 1e-8
"""m or degrees: what is off by more after one nudge takes part in the next."""


@attrs.frozen(eq=False)
class _Held:
    """Targets that are held while set values are met.

    Attributes
    ----------
    outputs : Outputs
    targets, sizes : (m,)
        `sizes` are those by which misses count as much as those of set values, m.
    free : tuple of str
        What is free for it: parameters that are at none of their bounds.
    """

    outputs: Outputs
    targets: FloatArray
    sizes: FloatArray
    free: tuple[str, ...]

    @classmethod
    def of(cls, found: SettledPlan, before: FloatArray) -> _Held | None:
        """Take what a plan has reached; None if a nudge cannot hold it."""
        aimed, reach = found.aimed, found.carry.ask.reach
        named = reach is not None and all(isinstance(each, str) for each in reach.free)
        if aimed is None or reach is None or not aimed.reached or not named:
            return None
        outputs = Outputs.of(found.carry.edit.state, tuple(reach.targets))
        targets = np.array(list(reach.targets.values()))
        free = tuple(name for name in aimed.free if name not in aimed.active)
        if not free:
            return None
        return cls(outputs, targets, _sizes(before, targets) * (_RESIDUAL / _STRAY), free)

    def misses(self, state: HullState, like: HullState | None) -> dict[str, float]:
        """Give by how much targets are missed, m; `like` lends its layout."""
        off = (self.targets - self.outputs.values(state, like=like)) / self.sizes
        return dict(zip(self.outputs.names, off.tolist(), strict=True))

    def inverse(self, base: NudgeBase, count: int) -> FloatArray:
        """Give the amplitudes by misses: of `count` values that are set, and of the targets.

        What is set goes by what it is missed; what is free takes out what that does to targets,
        and what is missed of these, by the least change.
        """
        at = Reached(base.state, base.amplitudes, base, self.outputs, base.state)
        usual = np.array([each.usual for each in base.maps.free[count:]])
        rates = at.jacobian / self.sizes[:, None]
        back = usual[:, None] * np.linalg.pinv(rates[:, count:] * usual)
        head = np.eye(count, count + len(self.targets))
        return np.vstack([head, np.hstack([-back @ rates[:, :count], back])])

    def made_up(self, found: SettledPlan, by: FloatArray) -> SettledPlan:
        """Take what is free as it was changed, and targets as they are on the hull of the edit."""
        aimed, state = found.aimed, found.carry.edit.state
        assert aimed is not None, "what is held was reached"
        change = dict(zip(self.free, by.tolist(), strict=True))
        more = np.array([change.get(name, 0.0) for name in aimed.free])
        values = self.outputs.values(state)
        off = (values - self.targets) / self.sizes * (_RESIDUAL / _STRAY)
        size = [float(np.linalg.norm(each)) for each in (aimed.amplitudes, aimed.amplitudes + more)]
        step = attrs.evolve(
            aimed.steps[-1], way="exact", residual=float(np.abs(off).max()),
            change=aimed.change * (size[1] / size[0] if size[0] else 1.0),
        )  # fmt: skip
        told = attrs.evolve(
            aimed, amplitudes=aimed.amplitudes + more, targets=self.targets, values=values,
            steps=(*aimed.steps, step),
        )  # fmt: skip
        freeze(told.amplitudes, values, self.targets)
        named = {name: found.values[name] + each for name, each in change.items()}
        return attrs.evolve(found, aimed=told, off=off, values={**found.values, **named})


def _nudged(
    carry: StagedCarry, found: SettledPlan, before: FloatArray | None
) -> SettledPlan | None:
    """Nudge the hull that a plan has carried so that all is met; None if no nudge does it.

    The map of what is missed, no larger than the misses are, follows the last one of the plan.
    """
    ask = carry.ask
    held = None if before is None else _Held.of(found, before)
    if ask.layout.blend == "paper" or (ask.reach is not None and held is None):
        return None  # maps of ratios are to stay few; what is no number cannot be added to
    state, stages = copy_state(carry.edit.state), carry.edit.stages
    room = AdmissibleValues.of(state, ask.layout, ask.tolerance)
    try:
        base, by = _nudge_for(room, ask, found.miss, held)
        last, (whole, certificate) = carry.carried[-1], base.maps.certified(by)
        carry.carry(room, VariationMap(()), {}, by=base.nudge_to(by))
        met = attrs.evolve(found, miss=_misses(carry.edit.state, ask))
        if held is not None:
            met = held.made_up(met, by[len(by) - len(held.free) :])
    except AssocHullError:
        carry.edit.take_back(stages)
        return None
    del carry.carried[-1]
    if met.unmet > 1.0 or not _within(met):
        carry.edit.take_back(stages)
        return None
    carry.carried[-1] = CarriedMap(
        VariationMap((*last.map.layers, *whole.layers)),
        min(last.certificate, certificate, key=lambda each: each.least), last.applied,
    )  # fmt: skip
    return met


def _within(found: SettledPlan) -> bool:
    """Tell whether what is free is within its bounds."""
    reach = found.carry.ask.reach
    limits = {} if reach is None else reach.bounds
    return all(low <= found.values[name] <= high for name, (low, high) in limits.items())


def _nudge_for(
    room: AdmissibleValues,
    ask: VariationRequest,
    missed: Mapping[str, float],
    held: _Held | None,
) -> tuple[NudgeBase, FloatArray]:
    """Find from where, and by which amplitudes of what is missed and free, all is met.

    Raises
    ------
    BadInputError
        No small change of these does it.
    """
    bare, free = attrs.evolve(ask, values={}, layers=()), () if held is None else held.free
    if any(name not in room.present for name in free):
        raise BadInputError("what is free has no value now", "in vary", "carry the hull in full")
    names, more = tuple[str, ...](), _astray(missed)
    while True:
        names = (*names, *more)
        named = [Freedom.named(n, room.present[n], room.parent.length) for n in (*names, *free)]
        base = NudgeBase.of(HullMaps(room, bare, {}, tuple(named)))
        by, miss = _tried_nudges(base, ask, names, missed, held)
        # What was met at first and is lost to the changes of others takes part from then on.
        more = tuple(name for name in _astray(miss) if name not in names)
        if not more:
            return base, by


def _astray(missed: Mapping[str, float]) -> tuple[str, ...]:
    """Name the values that are off."""
    return tuple(name for name, each in missed.items() if abs(each) > _STRAY)


def _tried_nudges(
    base: NudgeBase,
    ask: VariationRequest,
    names: tuple[str, ...],
    missed: Mapping[str, float],
    held: _Held | None,
) -> tuple[FloatArray, Mapping[str, float]]:
    """Find the amplitudes by which all is met, and what set values are missed by then."""
    count, like = len(names), base.state
    aims, miss = _Aims(names, np.zeros(count), np.eye(count)), missed
    off: dict[str, float] = {}
    if held is not None:
        off = held.misses(base.state, like)
        every = (*names, *off)
        aims = _Aims(every, np.zeros(len(base.maps.free)), held.inverse(base, count))
    for _ in range(_TRIALS):
        aims = aims.corrected({**miss, **off})
        state = base.nudged(aims.aim) if base.near(aims.aim) else None
        if state is None:
            break
        miss = _misses(state, ask)
        off = {} if held is None else held.misses(state, like)
        if max(abs({**miss, **off}[name]) for name in aims.names) <= _STRAY:
            return aims.aim, miss
    raise BadInputError("no nudge meets the values", "in vary", "carry the hull in full")


# --------------------------------------------------------------------------------------
# Followers that are faired: what is met is then met with them.

_USUAL = 0.02
"""How far followers move unless it is said, m, of a ship of 100 m or more."""


def _faired(
    carry: StagedCarry, again: FairedFollowers | None, *, insist: bool
) -> FairedFollowers | None:
    """Fair the followers if it is asked for, or do again what was found."""
    fair, lines, edit = carry.ask.fair, carry.lines, carry.edit
    if lines is None:
        return None
    # What solves sparse systems is imported by whoever asks for it.
    from assoc_hull.variation.faired_followers import fair_followers, repeat_fairing

    if again is not None:
        stages = edit.stages
        try:
            found = repeat_fairing(edit, lines, again)
        except RefusedEditError:
            found = None
        if found is not None and found.after <= (again.before - 1 if insist else again.after):
            return found
        edit.take_back(stages)  # the map differs enough to want another answer
        if insist:  # no answer lasts while values are met: they are met as the map takes them
            return repeat_fairing(edit, lines, again.without())
    within = _USUAL * edit.state.tolerances.factor if fair is True else float(fair)
    return fair_followers(edit, lines, within)


def _after_fairing(
    carry: StagedCarry, aimed: AimReport, reach: TargetRequest, before: FloatArray
) -> tuple[AimReport, FloatArray]:
    """Give the report with the outputs of the faired hull, and what these are off by.

    What is a compromise is left as one: nothing is off.
    """
    targets = np.array(list(reach.targets.values()))
    values = Outputs.of(carry.edit.state, tuple(reach.targets)).values(carry.edit.state)
    freeze(targets, values)
    off = (values - targets) / _sizes(before, targets)
    told = attrs.evolve(aimed, targets=targets, values=values)
    return told, off if aimed.reached else np.zeros_like(off)


def _shifted(found: SettledPlan) -> FloatArray | None:
    """Give by how much less than the targets is to be aimed at next."""
    reach = found.carry.ask.reach
    if found.off is None or found.aimed is None or reach is None or not found.aimed.reached:
        return found.shift
    off = found.aimed.values - found.aimed.targets
    return off if found.shift is None else found.shift + off


def _sizes(before: FloatArray, targets: FloatArray) -> FloatArray:
    """Give the sizes of targets, of which misses are parts."""
    sizes = np.maximum(np.abs(before), np.abs(targets))
    return np.where(sizes > 0.0, sizes, 1.0)


def _misses(state: HullState, ask: VariationRequest) -> dict[str, float]:
    """Give by how much set values are missed, m or degrees: asked less measured ones, by name."""
    reached = measure_requested(state, ask)
    return {name: value - reached[name] for name, value in ask.values.items()}


def _refuse_jump(found: SettledPlan, room: AdmissibleValues) -> None:
    """Refuse a measure that has jumped: its miss tells nothing of the map."""
    for name, miss in found.miss.items():
        asked = found.carry.ask.values[name]
        change = abs(asked - room.present[name])
        least = _JUMP * (100.0 if CATALOGUE[name].unit == "deg" else room.parent.length)
        if abs(miss) > max(change, _JUMPED * abs(asked), least):
            unit = CATALOGUE[name].unit
            raise BadInputError(
                f"{name} is measured at another place of the varied hull: {asked - miss:.6g} "
                f"{unit}, asked {asked:.6g} {unit}", "in vary",
                f"leave {name} out, or ask for less",
            )  # fmt: skip


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


def _missed(best: SettledPlan, ask: VariationRequest) -> BadInputError:
    """Say which value cannot be had, and what came nearest to it."""
    if best.worst <= PROMISED and best.aimed is not None:
        at = int(np.abs(best.off if best.off is not None else best.aimed.misses).argmax())
        return BadInputError(
            f"{best.aimed.outputs[at]} is {best.aimed.misses[at]:.2g} off after the followers were "
            "faired", "in vary", "leave fair out, or let them move less",
        )  # fmt: skip
    name, miss = max(best.miss.items(), key=lambda each: abs(each[1]))
    asked, unit = ask.values[name], CATALOGUE[name].unit
    return BadInputError(
        f"{name} reached {asked - miss:.9g} {unit}, asked {asked:.9g} {unit}, {abs(miss):.2g} off",
        "in vary", "ask for less, or give a finer tolerance"
        + ("" if best.faired is None else ", or leave fair out"),
    )  # fmt: skip


# --------------------------------------------------------------------------------------
# Targets of outputs, together with values that are set.

_RESIDUAL = 1e-10
"""Targets are met where their residual is no more than this part of their size."""


def changed_values(ask: VariationRequest, was: Mapping[str, float]) -> dict[str, float]:
    """Give the values that are set, without those that the hull has already."""
    return {name: value for name, value in ask.values.items() if abs(value - was[name]) > SAME}


def _reached(
    carry: StagedCarry,
    reach: TargetRequest,
    left: Mapping[str, float],
    before: FloatArray,
    start: FloatArray | None,
    shift: FloatArray | None,
) -> tuple[AimReport, dict[str, float]]:
    """Carry the hull by what is free so that targets are reached, together with aims that are left.

    `shift` (m,) is by how much less than the targets is aimed at.

    Gives the solver's report, and the values of what is free.
    """
    state = copy_state(carry.edit.state)
    room = AdmissibleValues.of(state, carry.ask.layout, carry.ask.tolerance)
    aims = {name: aim for name, aim in left.items() if abs(aim - room.present[name]) > SAME}
    # Else what is set is there now, and raw layers have acted.
    ask = carry.ask if left else attrs.evolve(carry.ask, values={}, layers=())
    maps = HullMaps(room, ask, aims, freedoms(room, ask, reach))
    aimed = _aimed(maps, Outputs.of(state, tuple(reach.targets)), before, reach, start, shift)
    hull = _hull(aimed)
    base = hull.base
    whole, certificate = maps.certified(hull.amplitudes)
    values = maps.values(base.amplitudes)
    carry.carry(room, maps.map(base.amplitudes), values, by=base.nudge_to(hull.amplitudes))
    # What is nudged after the map belongs to it.
    carry.carried[-1] = CarriedMap(whole, certificate, carry.carried[-1].applied)
    return aimed, maps.values(hull.amplitudes)


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
        try:
            compose_map(room.parent, {name: room.present[name]}, ask.layout)
        except BadInputError as error:
            # What is measured may have no field: a bilge of a hull without parallel body.
            what, why = error.what.split(": ", 1) if ": " in error.what else (error.what, "")
            if what == f"cannot vary '{name}'":
                raise attrs.evolve(error, what=f"cannot free '{name}': {why}") from None
    refuse_clashes({**ask.values, **{name: room.present[name] for name in named}}, ask.layout)
    return tuple(
        Freedom.named(each, room.present[each], room.parent.length)
        if isinstance(each, str) else Freedom.raw(each)
        for each in reach.free
    )  # fmt: skip


def _aimed(
    maps: HullMaps,
    outputs: Outputs,
    before: FloatArray,
    reach: TargetRequest,
    start: FloatArray | None,
    shift: FloatArray | None,
) -> AimReport:
    """Solve for the targets on a hull that has what is set."""
    targets = np.array(list(reach.targets.values()))
    scales = _sizes(before, targets)
    targets = targets if shift is None else targets - shift
    # quick hulls first; in full only where these do not hold on a hull laid out by itself
    for quick in (True, False):
        aimed = solve_targets(
            HullProblem(maps, outputs, quick=quick), targets,
            start=np.zeros(len(maps.free)) if start is None else start,
            scales_free=[each.usual for each in maps.free], scales_out=scales,
            bounds=reach.limits([each.present for each in maps.free]),
            exact=reach.exact, units=outputs.units, before=before,
        )  # fmt: skip
        if not aimed.reached or _holds(aimed, outputs, scales):
            break
    return aimed


def _holds(aimed: AimReport, outputs: Outputs, scales: FloatArray) -> bool:
    """Tell whether targets are met as well on a hull that is laid out by itself."""
    off = outputs.values(_hull(aimed).state) - aimed.targets
    return bool((np.abs(off) <= _RESIDUAL * scales).all())


def _hull(aimed: AimReport) -> Reached:
    """Give the hull that the solver ended at."""
    assert isinstance(aimed.hull, Reached), "the problem gives no other"
    return aimed.hull
