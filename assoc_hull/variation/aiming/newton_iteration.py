"""Newton's way to targets: steps, second derivatives learnt on the way, and when it is done.

With scaled changes mu, scaled misses r and their derivatives J, a step p keeps within the bounds
and solves J p = -r. Of several such steps it is the one that makes

    1/2 |mu + p|^2 + 1/2 p (sum_i lambda_i B_i) p

least: the step of Newton's method for the least change that reaches the targets, with lambda the
multipliers of the equations and B_i the second derivatives of r_i as far as they are
known. With nothing known it is mu <- J' (J J')^-1 (J mu - r). Where no step solves the equations it
is the one that makes |r|^2 least, to the same order.

Second derivatives of misses, learnt from the exact first ones on the way.

Each miss has a symmetric matrix B_i that follows the change y_i of its gradient over a step s by
the least change of itself (Powell 1970, "A new algorithm for unconstrained optimization": the
symmetric form of Broyden's rule),

    B_i <- B_i + (e s' + s e') / s's - (e's) s s' / (s's)^2        e = y_i - B_i s

What holds a change where it is: the conditions of Karush, Kuhn and Tucker.

When aiming is done.
"""

from __future__ import annotations

from typing import Literal

import attrs
import numpy as np

from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.aiming.quadratic_program import Quadratic, least_squares_step, split
from assoc_hull.variation.aiming.scaled_problem import Iterate

__all__ = [
    "AimStep",
    "End",
    "NewtonIteration",
    "StoppingRule",
    "iterate",
    "multipliers",
    "no_curvature",
    "release_slope",
    "unbalanced",
    "updated_curvature",
]

_SHORT = 1e-7
"""A shorter scaled step tells nothing: the change of gradients is rounding."""


def no_curvature(targets: int, free: int) -> FloatArray:
    """Give what is known before a step, (m, k, k)."""
    return np.zeros((targets, free, free))


def updated_curvature(curvature: FloatArray, step: FloatArray, change: FloatArray) -> FloatArray:
    """Give the matrices after a step.

    Parameters
    ----------
    curvature : (m, k, k) float
        Before.
    step : (k,) float
        Scaled changes.
    change : (m, k) float
        Of the gradients of the misses.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.aiming.newton_iteration import no_curvature, updated_curvature
    >>> step = np.array([0.5, 0.0])
    >>> updated_curvature(no_curvature(1, 2), step, np.array([[1.0, 0.25]])).tolist()
    [[[2.0, 0.5], [0.5, 0.0]]]
    """
    square = float(step @ step)
    if square < _SHORT**2:
        return curvature
    error = change - curvature @ step
    half = error[:, :, None] * step / square
    along = (error @ step / square**2)[:, None, None]
    found: FloatArray = curvature + half + half.transpose(0, 2, 1) - along * np.outer(step, step)
    return found


def unbalanced(place: Iterate) -> float:
    """Tell by how much a change is not the least one with these misses.

    It is the size of what is left of mu beside the gradients of misses and of bounds that hold it:
    the residual of the conditions of Karush, Kuhn and Tucker.
    """
    _, null = split(place.jacobian)
    return float(np.linalg.norm(null.T @ _pull(place)))


def release_slope(place: Iterate) -> float:
    """Give the slope of half the squared misses along which bounds let go."""
    slope = place.jacobian.T @ place.misses
    return float(np.linalg.norm(np.where(place.shut, 0.0, slope)))


def _pull(place: Iterate) -> FloatArray:
    """Give mu without what bounds take up of it best: they push inward only, (k,)."""
    from scipy.optimize import nnls

    _, null = split(place.jacobian)
    unit = np.eye(len(place.changes))
    walls = np.concatenate([unit[place.at_high], -unit[place.at_low]])
    if not len(walls) or not null.shape[1]:
        return place.changes
    forces, _ = nnls(null.T @ walls.T, -(null.T @ place.changes))
    found: FloatArray = place.changes + forces @ walls
    return found


def multipliers(place: Iterate) -> FloatArray:
    """Give the multipliers of the equations that balance mu best, (m,)."""
    inverse, _ = split(place.jacobian)
    found: FloatArray = -inverse.T @ _pull(place)
    return found


_SPARE = 0.1
"""Rules are kept with this part of what they allow, unless rounding is in the way."""


@attrs.frozen
class StoppingRule:
    """When a walk ends.

    Attributes
    ----------
    residual : float
        Targets are met where no scaled miss is larger.
    kkt : float
        The change is the least where it is out of balance by no more, times itself where
        that is below 1.
    steps : int
        So many at most.
    least : bool
        Whether the change is to be the least; else steps are as short as they can be.
    """

    residual: float = 1e-10
    kkt: float = 1e-6
    steps: int = 40
    least: bool = True

    def met(self, place: Iterate) -> bool:
        """Tell whether targets are met."""
        return place.worst <= self.residual

    def left(self, place: Iterate) -> tuple[bool, bool]:
        """Tell what is left to do: targets, which are met with something to spare; the change."""
        limit = max(self.kkt * min(1.0, place.change), _SPARE * self.kkt)
        far = place.worst > _SPARE * self.residual
        return far, self.least and (far or unbalanced(place) > limit)


# --------------------------------------------------------------------------------------
# One step: which way it goes, and how much of it is taken.

Way = Literal["start", "exact", "nearest"]

_HALVINGS = 8
_LESS = 1e-4
"""A step must bring this part of what it promises."""

_PENALTY = 1.5
"""How much a miss weighs against a change, in multipliers."""

_FLAT = 1e-12
"""Where a step promises less than this part of the squared misses, there is no better place."""

_FIRM = 1e-6
"""The least curvature of misses that is trusted, as a part of the largest,"""

_STAYS = 0.1
"""and that of the change itself, which is 1 without targets."""


@attrs.frozen(eq=False)
class WholeStep:
    """A whole step, which way it goes, and how much a miss weighs against a change."""

    step: FloatArray
    way: Way
    penalty: float = 0.0


@attrs.frozen(eq=False)
class TakenStep:
    """A step that was taken: where it led, how much of it, what cut it short."""

    place: Iterate
    part: float
    why: str


def choose_step(place: Iterate, curvature: FloatArray, rule: StoppingRule) -> WholeStep | None:
    """Give the whole step from a place; None where no step brings targets nearer."""
    weights = multipliers(place) if rule.least else np.zeros_like(place.misses)
    unit, (_, null) = np.eye(len(place.changes)), split(place.jacobian)
    H = unit + np.einsum("i,ijk->jk", weights, curvature)
    if not _firm(null.T @ H @ null, _STAYS):
        H = unit
    g = place.changes if rule.least else np.zeros_like(place.changes)
    scaled = place.scaled
    low, high = scaled.least - place.changes, scaled.most - place.changes
    low, high = np.minimum(low, 0.0), np.maximum(high, 0.0)
    step = Quadratic(H, g, place.jacobian, -place.misses, low, high).step()
    if step is not None:
        return WholeStep(step, "exact", _PENALTY * float(np.linalg.norm(weights)))
    return _nearer(place, curvature, low, high)


def _nearer(
    place: Iterate, curvature: FloatArray, low: FloatArray, high: FloatArray
) -> WholeStep | None:
    """Give the step that makes misses least within bounds; None where they are."""
    J, misses = place.jacobian, place.misses
    H = J.T @ J + np.einsum("i,ijk->jk", misses, curvature)
    g = J.T @ misses
    enough = -_FLAT * place.size**2
    if _firm(H, _FIRM):
        step = Quadratic(H, g, np.zeros((0, len(g))), np.zeros(0), low, high).step()
        if step is not None and g @ step < enough:
            return WholeStep(step, "nearest")
    step = least_squares_step(J, -misses, low, high)
    return WholeStep(step, "nearest") if g @ step < enough else None


def _firm(H: FloatArray, least: float) -> bool:
    """Tell whether a symmetric matrix is positive, the least by a part of the largest."""
    values = np.linalg.eigvalsh(H) if len(H) else np.ones(1)
    return bool(values[0] > least * values[-1])


def damp_step(place: Iterate, wish: WholeStep, rule: StoppingRule) -> TakenStep | str:
    """Take the whole step, or halves of it until it serves; else say why none did."""
    part, why = 1.0, ""
    for _ in range(_HALVINGS):
        try:
            after = place.scaled.at(place.changes + part * wish.step)
            if _serves(place, after, wish, part, rule):
                return TakenStep(after, part, why)
        except AssocHullError as error:
            why = str(error)
        part *= 0.5
    return why


def _serves(
    place: Iterate, after: Iterate, wish: WholeStep, part: float, rule: StoppingRule
) -> bool:
    """Tell whether a step has brought what it should."""
    if wish.way == "nearest":
        promised = _LESS * part * 2.0 * float(place.jacobian.T @ place.misses @ wish.step)
        return after.size**2 <= (1.0 + 0.1 * _FLAT) * place.size**2 + promised
    if after.size <= (1.0 - _LESS * part) * place.size or rule.met(after):
        return True
    before, now = (0.5 * each.change**2 + wish.penalty * each.size for each in (place, after))
    return rule.least and now < before


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
