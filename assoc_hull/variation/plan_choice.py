"""Which plan carries a set of values: the first that is taken and leaves no kink, else the fairest.

A plan that is refused at a stage is refined there. What no plan can do is refused by values of the
request: which one stands in the way of the others, and how much of all changes can be had.
"""

from __future__ import annotations

from collections.abc import Mapping

import attrs

from assoc_hull.arguments import small_length
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import (
    AssocHullError,
    BadInputError,
    DependentTargetsError,
    FoldError,
    OutOfRangeError,
    RefusedSetError,
    TooFewFreeError,
    UnknownNameError,
    UnreachableError,
)
from assoc_hull.graph.derived import Objects
from assoc_hull.model.tables import HullState
from assoc_hull.variation.aiming.outputs import Outputs
from assoc_hull.variation.aiming.reach_targets import SettledPlan, settle_plan, targets_before
from assoc_hull.variation.carrying.admissible_values import AdmissibleValues
from assoc_hull.variation.carrying.carry_stages import DoneStage, StagedCarry
from assoc_hull.variation.comparing.line_fairness import (
    FairnessChange,
    FairnessComparison,
    LineFairness,
    comb_within,
    compare_fairness,
    measure_fairness,
)
from assoc_hull.variation.parameters.catalogue import CATALOGUE
from assoc_hull.variation.parameters.stages import Plan, class_plan, finer_plan, single_plan
from assoc_hull.variation.request import TargetRequest, VariationRequest

__all__ = ["KINK", "beyond_fair", "choose_plan", "parent_fairness"]

KINK = 10.0
"""A line whose comb is larger than this many times the parent's has a kink, though nothing folds:
4 times is usual, and a line that folds nearly has hundreds."""

_BEYOND = 100.0
"""A comb that becomes so many times sharper is of a hull that no one would take: ten times is a
kink, and a line that folds nearly has hundreds."""

_OF_TARGETS = (UnreachableError, DependentTargetsError, TooFewFreeError, UnknownNameError)
"""What is wrong with targets is so whatever the plan."""

_HALVINGS = 3
"""How often the part of all changes that can be had is halved."""


def choose_plan(
    edit: Transaction, room: AdmissibleValues, ask: VariationRequest
) -> tuple[SettledPlan, FairnessComparison]:
    """Carry the hull of an edit by the best plan there is.

    Parameters
    ----------
    edit : Transaction
        The edit, which holds nothing yet; afterwards it holds the varied hull.
    room : AdmissibleValues
        What is measured of the parent.
    ask : VariationRequest
        What is asked for.

    Raises
    ------
    RefusedSetError
        Several values that no plan can give together; what can be had.
    AssocHullError
        What is wrong with a single value, or with targets.
    """
    before, targets = parent_fairness(edit.state), targets_before(room, ask)
    lines = None
    if ask.fair:
        if not isinstance(ask.fair, bool):
            small_length(ask.fair, "fair", "in vary", edit.state.particulars.length)
        # What solves sparse systems is imported by whoever asks for it.
        from assoc_hull.variation.faired_followers import ParentLines

        lines = ParentLines.of(edit.state, before)
    best = list[tuple[float, int, StagedCarry]]()
    refusal: tuple[AssocHullError, StagedCarry] | None = None
    tried = set[tuple[Plan, bool]]()
    left, done = _candidates(ask), list[DoneStage]()
    # What reaches targets or fairs followers comes after the first round, and may mend a line.
    last = ask.reach is None and lines is None
    while left:
        plan, together = left.pop(0)
        if (plan, together) in tried:
            continue
        carry = StagedCarry(
            edit, ask, plan, not best, together, base=room, lines=lines, done=done
        )  # fmt: skip
        try:
            if (best or last) and not together:  # one round shows whether it is worth more
                carry.run(ask.values)
                fair, worst = _judged(edit, before)
                if last and worst > KINK:
                    best.append((worst, fair.added, carry))
                    continue
                if best and worst >= min(each[0] for each in best):
                    continue
            found = settle_plan(carry, room, targets)
        except _OF_TARGETS:
            raise
        except AssocHullError as error:
            refusal = refusal or (error, carry)
            # At its finest it is refused as well.
            left = left if best or together else left[-1:]
            continue
        finally:
            tried |= {(plan, together), (carry.plan, together)}
        fair, worst = _judged(edit, before)
        if worst <= KINK:
            return found, fair
        best.append((worst, fair.added, carry))
    # None is without a kink: the fairest that meets what is asked.
    for _, _, carry in sorted(best, key=lambda each: each[:2]):
        try:
            # What is done is shared: what stands of it is not done anew.
            found = settle_plan(attrs.evolve(carry, carried=[], refused=None), room, targets)
        except AssocHullError as error:
            refusal = refusal or (error, carry)
            continue
        return found, _judged(edit, before)[0]
    assert refusal is not None, "there is a plan at least"
    raise _refused(edit, room, ask, before, *refusal) from None


def parent_fairness(state: HullState) -> Mapping[str, LineFairness]:
    """Measure all lines of a parent; once, as long as they stay."""
    lines = state.lines
    made = [state.spline(curve) for curve in state.live("curves").tolist()]
    depends_on = (
        Objects(made), state.curves.alive, state.curves.line, lines.alive, lines.planar,
        lines.normal, tuple(lines.name.data), tuple(lines.key.data),
    )  # fmt: skip
    return state.derived(("fairness",), depends_on, lambda: measure_fairness(state), most=2)


def beyond_fair(fairness: FairnessComparison, state: HullState) -> list[tuple[str, float]]:
    """Give the lines that bend as sharply as no one would take, worst first, and how many times.

    A border alone, as a stem that is to be raked, may come to bend as it has not. A line that is
    fair within the adoption tolerance bends sharply between points close together, and is seen by
    nobody.
    """
    found = sorted(fairness.unfairness, key=lambda each: -each[1])
    return [
        (line.name, times) for line, times in found
        if times > _BEYOND and not line.before.border and _is_seen(line, times, state)
    ]  # fmt: skip


def _is_seen(line: FairnessChange, times: float, state: HullState) -> bool:
    """Tell whether a line that bends too sharply does so beyond the adoption tolerance, too."""
    enough = line.after.comb * _BEYOND / times
    return comb_within(state, line.after, state.tolerances.adoption, enough) > enough


def _candidates(ask: VariationRequest) -> list[tuple[Plan, bool]]:
    """Give plans in the order in which they are tried, each with whether what is free goes along.

    What is free to reach targets goes in one map with what is set where that is of one class: no
    lines are lost to it as drivers.
    """
    layers, reaches = bool(ask.layers), ask.reach is not None and bool(ask.values)
    first, whole = (make(ask.values, layers=layers) for make in (class_plan, single_plan))
    finer = finer_plan(first)
    plans = [(first, True)] if reaches and len(first) == 1 else []
    return [*plans, (first, False), (finer, False), (finer_plan(finer), False), (whole, reaches)]


def _judged(
    edit: Transaction, before: Mapping[str, LineFairness]
) -> tuple[FairnessComparison, float]:
    """Compare the lines of the hull as it is by now with those of the parent.

    Given is also the largest comb of a line at the size that it had in the parent, in parts of that
    one. Boundary curves are left out of it: they drive whatever the plan, so no plan is to blame.
    """
    state = edit.state
    after = measure_fairness(state, like=before)
    lines = state.live("lines")
    outer = {
        str(state.lines.key[line]) for line in lines[state.lines.boundary[lines] >= 0].tolist()
    }
    inner = {key: each for key, each in after.items() if key not in outer}
    return compare_fairness(before, after), compare_fairness(before, inner).worst_shape


# --------------------------------------------------------------------------------------
# Refusals.


def _refused(
    edit: Transaction,
    room: AdmissibleValues,
    ask: VariationRequest,
    before: Mapping[str, LineFairness],
    error: AssocHullError,
    carry: StagedCarry,
) -> AssocHullError:
    """Say what of the request can be had, of several values."""
    if ask.reach is not None and ask.values:
        return _refused_reach(edit, room, ask, ask.reach, before, error, carry)
    alone = isinstance(error, OutOfRangeError) or (isinstance(error, FoldError) and not error.part)
    if len(ask.values) < 2 or alone:
        return error  # it names a value, and what may be asked for
    blamed = () if carry.refused is None else carry.refused.names
    leave_out = next(
        (name for name in blamed if _goes(edit, room, _without(ask, name), before)), None
    )
    parts, low, high = list[float](), 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if _goes(edit, room, _part(ask, room, middle), before, in_full=False):
            low = middle
            parts.insert(0, middle)
        else:
            high = middle
    part = next((each for each in parts if _goes(edit, room, _part(ask, room, each), before)), 0.0)
    edit.take_back()
    if not part:
        return error  # one value can hardly be had at all, whatever stands beside it
    values = dict(_part(ask, room, part).values)
    told = ", ".join(f"{name}={value:.6g}" for name, value in values.items())
    remedies = [] if leave_out is None else [f"leave out {leave_out}: the rest can be had"]
    remedies.append(f"ask for {100.0 * part:.3g} % of all changes: {told}")
    return RefusedSetError(
        f"{', '.join(ask.values)} cannot be had together ({error})", "in vary",
        "; or ".join(remedies), leave_out, part, values,
    )  # fmt: skip


def _refused_reach(
    edit: Transaction, room: AdmissibleValues, ask: VariationRequest, reach: TargetRequest,
    before: Mapping[str, LineFairness], error: AssocHullError, carry: StagedCarry,
) -> AssocHullError:  # fmt: skip
    """Say whether it is the values that cannot be had, or the targets beside them."""
    values = attrs.evolve(ask, reach=None)
    if not _goes(edit, room, values, before):
        return _refused(edit, room, values, before, error, carry)
    names = tuple(reach.targets)
    there = Outputs.of(edit.state, names).values(edit.state).tolist()
    edit.take_back()
    given = ", ".join(f"{name} {value:.6g}" for name, value in zip(names, there, strict=True))
    return BadInputError(
        f"{', '.join(ask.values)} can be had, but not while {', '.join(names)} "
        f"{'is' if len(names) == 1 else 'are'} reached by {', '.join(reach.names)} ({error})",
        "in vary",
        f"ask for targets nearer to what the values give by themselves ({given}), or free other "
        "parameters",
    )  # fmt: skip


def _goes(
    edit: Transaction, room: AdmissibleValues, ask: VariationRequest,
    before: Mapping[str, LineFairness], *, in_full: bool = True,
) -> bool:  # fmt: skip
    """Tell whether a request is taken, beside the lines of the parent.

    If not `in_full`, whether its first round is: later ones meet the values.
    """
    carry = StagedCarry(edit, ask, class_plan(ask.values, layers=bool(ask.layers)), base=room)
    try:
        carry.run(ask.values)
        if beyond_fair(_judged(edit, before)[0], edit.state) and not ask.accept:
            return False
        if in_full:
            settle_plan(carry, room, None)  # without targets
    except AssocHullError:
        return False
    return not in_full or ask.accept or not beyond_fair(_judged(edit, before)[0], edit.state)


def _without(ask: VariationRequest, name: str) -> VariationRequest:
    return attrs.evolve(ask, values={key: each for key, each in ask.values.items() if key != name})


def _part(ask: VariationRequest, room: AdmissibleValues, part: float) -> VariationRequest:
    """Ask for a part of all changes, with the digits that a message has."""
    now = {name: 0.0 if CATALOGUE[name].amplitude else room.present[name] for name in ask.values}
    return attrs.evolve(ask, values={
        name: float(f"{now[name] + part * (value - now[name]):.6g}")
        for name, value in ask.values.items()
    })  # fmt: skip
