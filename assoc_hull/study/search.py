"""The values of free parameters at which a variant has what is asked of it.

On the model of second order the least change is sought at which all targets are met; from there
steps on the hull itself, with the slopes of the model, which each step corrects by what it found
(C.G. Broyden, "A class of methods for solving nonlinear simultaneous equations", Math. Comp. 19,
1965). Each trial begins at the parent, so what comes out depends on nothing but what is asked.
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.errors import OutOfRangeError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.study.design import Design
from assoc_hull.study.failure import NotReachedError
from assoc_hull.study.model import Model
from assoc_hull.study.prepared_parent import Ground, Variant

__all__ = ["EXACT", "Found", "searched"]

EXACT = 1e-10
"""A target is met where what is lacking is no more than this part of the parent's value."""

_TRIALS, _LAST = 12, 4
"""Hulls that are tried by the parent's layout, and measured in full at last."""

_ROUNDS = 60
_STILL = 1e-13
_SINGULAR = 1e-10
"""A smaller part of the largest singular value than this is nil."""

_SLACK = 1e-9
"""A bound is kept if it is passed by no more usual changes than this."""


@attrs.frozen(eq=False)
class Found:
    """What a search has found.

    Attributes
    ----------
    values : (p,)
        Of all parameters.
    variant : Variant
    outputs : (o,)
        What is measured of it.
    residual : float
        The largest part of a target that is lacking; 0 without targets.
    trials : int
        Hulls that were made.
    """

    values: FloatArray
    variant: Variant
    outputs: FloatArray
    residual: float
    trials: int


@attrs.define(eq=False)
class _Search:
    """One search under way: `mu` are scaled changes of all parameters, `free` those that step."""

    ground: Ground
    design: Design
    model: Model
    number: int
    mu: FloatArray
    free: IntArray
    slope: FloatArray
    trials: int = 0

    @property
    def target(self) -> FloatArray:
        """What is aimed at, (m,)."""
        found: FloatArray = self.design.targets[self.number]
        return found

    def run(self) -> Found:
        """Go on until the targets are met, first by the parent's layout, then in full."""
        variant = self._made()
        for measure, most in ((self.ground.measured, _TRIALS), (self.ground.fully, _LAST)):
            found = self._settled(variant, measure, most)
            variant = found.variant
        return found

    def _settled(
        self, variant: Variant, measure: Callable[[Variant], FloatArray], most: int
    ) -> Found:
        """Step until what is measured is what is asked."""
        before: tuple[FloatArray, FloatArray] | None = None
        for _ in range(most):
            outputs = measure(variant)
            values = outputs[: len(self.target)]
            lacking = self.target - values
            residual = float((np.abs(lacking) / self.model.size).max(initial=0.0))
            if residual <= EXACT:
                return Found(self._parameters(), variant, outputs, residual, self.trials)
            if before is not None:
                self._learn(self.mu - before[0], values - before[1])
            before = self.mu.copy(), values
            self.mu[self.free] += _least(self.slope[:, self.free], lacking, self.model.size)
            self._require_bounds()
            variant = self._made()
        raise NotReachedError(self.design.aims, self.target, values, self.trials)

    def _made(self) -> Variant:
        self.trials += 1
        return self.ground.variant(self._parameters())

    def _learn(self, step: FloatArray, change: FloatArray) -> None:
        """Correct the slopes by what a step has changed."""
        size = float((step * step).sum())
        if size > 0.0:
            self.slope = self.slope + np.outer(change - self.slope @ step, step) / size

    def _parameters(self) -> FloatArray:
        return _values(self.ground, self.design, self.number, self.mu)

    def _require_bounds(self) -> None:
        given = len(self.design.given)
        usual = self.ground.usual[given:]
        _require_within(self.design, self._parameters()[given:], _SLACK * usual)


def searched(ground: Ground, model: Model | None, design: Design, number: int) -> Found:
    """Find a variant of a study.

    Parameters
    ----------
    ground : Ground
        The parent.
    model : Model or None
        Of the outputs that are aimed at; None where nothing is.
    design : Design
        What is asked for.
    number : int
        Which variant.

    Raises
    ------
    AssocHullError
        There is none; why.
    """
    mu = np.zeros(len(design.names))
    given = len(design.given)
    mu[:given] = (design.values[number] - ground.present[:given]) / ground.usual[:given]
    if model is None:
        values = _values(ground, design, number, mu)
        variant = ground.variant(values)
        return Found(values, variant, ground.fully(variant), 0.0, 1)
    start, free = _on_model(ground, model, design, mu, design.targets[number])
    return _Search(ground, design, model, number, start, free, model.jacobian(start)).run()


def _values(ground: Ground, design: Design, number: int, mu: FloatArray) -> FloatArray:
    """Give the values of all parameters; those that are given as they were, to the bit."""
    found: FloatArray = ground.present + mu * ground.usual
    found[: len(design.given)] = design.values[number]
    return found


def _on_model(
    ground: Ground, model: Model, design: Design, mu: FloatArray, target: FloatArray
) -> tuple[FloatArray, IntArray]:
    """Give the least change that meets the targets on the model, and what is free within bounds.

    The rule is mu <- J^T (J J^T)^-1 (J mu + lacking), which settles where the change is least.
    A parameter that would leave its bounds is held there, and the others are sought again.
    """
    given, usual = len(design.given), ground.usual
    low, high = (design.bounds.T - ground.present[given:]) / usual[given:]
    held = np.zeros(len(mu), bool)
    held[:given] = True
    while True:
        free = np.flatnonzero(~held)
        mu = _settle_model(model, mu.copy(), free, target)
        within = np.clip(mu[given:], low, high)
        over = np.abs(mu[given:] - within)
        if not over.max(initial=0.0) > _SLACK:
            return mu, free
        worst = given + int(over.argmax())
        if len(free) - 1 < len(target):
            values = (ground.present + mu * usual)[given:]
            _require_within(design, values, np.zeros(len(values)))
        held[worst], mu[worst] = True, within[worst - given]


def _settle_model(model: Model, mu: FloatArray, free: IntArray, target: FloatArray) -> FloatArray:
    for _ in range(_ROUNDS):
        slope = model.jacobian(mu)[:, free]
        lacking = target - model.at(mu) + slope @ mu[free]
        new = _least(slope, lacking, model.size)
        step = float(np.abs(new - mu[free]).max(initial=0.0))
        mu[free] = new
        if step <= _STILL * (1.0 + float(np.abs(new).max(initial=0.0))):
            break
    return mu


def _least(slope: FloatArray, lacking: FloatArray, size: FloatArray) -> FloatArray:
    """Give the least change that makes up for what is lacking."""
    least = np.linalg.lstsq(slope / size[:, None], lacking / size, rcond=_SINGULAR)[0]
    return np.asarray(least, np.float64)


def _require_within(design: Design, values: FloatArray, slack: FloatArray) -> None:
    """See that free parameters keep to their bounds."""
    over = np.maximum(design.bounds[:, 0] - values, values - design.bounds[:, 1]) - slack
    if over.max(initial=0.0) > 0.0:
        worst = int(over.argmax())
        low, high = design.bounds[worst].tolist()
        raise OutOfRangeError(
            design.free[worst], float(values[worst]), "in study",
            "would be needed to reach the targets", low, high, "",
        )  # fmt: skip
