"""Newton's way to targets: steps with exact derivatives, halved where they do not serve.

With scaled changes mu, scaled misses r and their derivatives J, a step p keeps within the bounds
and solves J p = -r. Of several such steps it is the one that makes

    1/2 |mu + p|^2 + 1/2 p (sum_i lambda_i B_i) p

least: the step of Newton's method for the least change that reaches the targets, with lambda the
multipliers of the equations and B_i the second derivatives of r_i as far as they are known
(`broyden_update`). With nothing known it is mu <- J' (J J')^-1 (J mu - r). Where no step solves the
equations it is the one that makes |r|^2 least, to the same order.
"""

from __future__ import annotations

from typing import Literal

import attrs

from assoc_hull.variation.aiming.broyden_update import no_curvature, updated_curvature
from assoc_hull.variation.aiming.kkt_conditions import release_slope, unbalanced
from assoc_hull.variation.aiming.newton_step import Way, choose_step, damp_step
from assoc_hull.variation.aiming.scaled_problem import Iterate
from assoc_hull.variation.aiming.stopping_rule import StoppingRule

__all__ = ["AimStep", "End", "NewtonIteration", "iterate"]

End = Literal["met", "nearest", "blocked", "spent"]

_CUTS = 3
"""Where refusals have cut so many steps in a row, no certified hull is much nearer."""


@attrs.frozen
class AimStep:
    """One step of aiming, or the start.

    Attributes
    ----------
    way : {"start", "exact", "nearest"}
        Whether the step solves the equations, or comes as near as it can.
    residual : float
        The largest scaled miss after it.
    kkt : float
        Where it is nil no smaller change would do, or, after a step of the way "nearest", none
        would bring the targets nearer.
    change : float
        The size of the scaled change after it.
    part : float
        How much of the whole step was after.
    """

    way: Way
    residual: float
    kkt: float
    change: float
    part: float = 1.0


@attrs.frozen(eq=False)
class NewtonIteration:
    """A walk that has ended.

    Attributes
    ----------
    steps : tuple of AimStep
        The start among them.
    place : Iterate
        The last, and best, one.
    end : {"met", "nearest", "blocked", "spent"}
        Targets are met; nothing is nearer; no step brought anything nearer; too many steps.
    why : str
        What the last hull was refused for.
    """

    steps: tuple[AimStep, ...]
    place: Iterate
    end: End
    why: str = ""


def iterate(place: Iterate, rule: StoppingRule) -> NewtonIteration:
    """Go from a place until a rule says that it is enough, or nothing is nearer."""
    curvature = no_curvature(*place.jacobian.shape)
    steps, cuts = [_step("start", place, 0.0)], 0
    while any(rule.left(place)):
        if rule.met(place) and _stands(steps, *rule.left(place)):
            break  # rounding is all that is left
        if len(steps) > rule.steps:
            return _ended(steps, place, rule, "spent")
        wish = choose_step(place, curvature, rule)
        if wish is None:
            return _ended(steps, place, rule, "nearest")
        after = damp_step(place, wish, rule)
        if isinstance(after, str):
            return _ended(steps, place, rule, "blocked", after)
        moved = after.place.changes - place.changes
        curvature = updated_curvature(curvature, moved, after.place.jacobian - place.jacobian)
        place = after.place
        steps.append(_step(wish.way, place, after.part))
        cuts = cuts + 1 if after.why else 0
        if cuts == _CUTS:
            return _ended(steps, place, rule, "blocked", after.why)
    return NewtonIteration(tuple(steps), place, "met")


def _stands(steps: list[AimStep], far: bool, uneven: bool) -> bool:
    """Tell whether the last step has brought nothing of what is left to do."""
    if len(steps) < 2:
        return False
    before, now = steps[-2:]
    closer = far and now.residual < 0.5 * before.residual
    return not closer and not (uneven and now.kkt < 0.5 * before.kkt)


def _step(way: Way, place: Iterate, part: float) -> AimStep:
    """Note a step."""
    kkt = release_slope(place) if way == "nearest" else unbalanced(place)
    return AimStep(way, place.worst, kkt, place.change, part)


def _ended(
    steps: list[AimStep], place: Iterate, rule: StoppingRule, end: End, why: str = ""
) -> NewtonIteration:
    """End a walk; where targets are met, a change that might be a little smaller is none."""
    return NewtonIteration(tuple(steps), place, "met" if rule.met(place) else end, why)
