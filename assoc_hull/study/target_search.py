"""The values of free parameters at which a variant of a study has what is asked of it.

A model of second order near the parent gives the least change that meets all targets; from there
steps on the hull itself, with the slopes of the model, which each step corrects (C.G. Broyden, "A
class of methods for solving nonlinear simultaneous equations", Math. Comp. 19, 1965). Each trial
begins at the parent, so the result depends on nothing but what is asked.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import combinations

import attrs
import numpy as np

from assoc_hull.errors import AssocHullError, BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.study.design import StudyDesign
from assoc_hull.study.prepared_parent import StudyParent, Variant

__all__ = [
    "EXACT",
    "NotReachedError",
    "QuadraticModel",
    "SearchResult",
    "search_variant",
]

# --------------------------------------------------------------------------------------
# The model, with mu = (values - present) / usual changes:
#
#     y(mu) = y0 + G mu + mu^T H mu / 2
#
# G and H come of central differences over a part of the usual changes, on hulls of the study. They
# need not be exact: what a variant reaches is measured on itself.

_PARTS = (0.25, 0.1, 0.03, 0.01)
"""Parts of usual changes over which differences are taken; the first at which all hulls exist."""


@attrs.frozen(eq=False)
class QuadraticModel:
    """Outputs as a function of scaled changes of parameters.

    Attributes
    ----------
    value : (m,)
        Outputs of the parent.
    slope : (m, p)
    bend : (m, p, p)
    size : (m,)
        Residuals are parts of it: the output's value for the parent, or 1 if that is zero.
    """

    value: FloatArray
    slope: FloatArray
    bend: FloatArray
    size: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.value, self.slope, self.bend, self.size)

    @classmethod
    def of(cls, ground: StudyParent) -> QuadraticModel:
        """Take differences.

        Parameters
        ----------
        ground : StudyParent
            The parent, with what is aimed at.

        Raises
        ------
        AssocHullError
            A parameter cannot even be changed by a hundredth of a usual change.
        """
        for part in _PARTS:
            try:
                return cls._of(ground, part)
            except AssocHullError:
                if part == _PARTS[-1]:
                    raise
        raise AssertionError

    @classmethod
    def _of(cls, ground: StudyParent, part: float) -> QuadraticModel:
        names, count = ground.aims.names, len(ground.usual)

        def at(*moves: tuple[int, float]) -> FloatArray:
            mu = np.zeros(count)
            for i, sign in moves:
                mu[i] += sign * part
            return ground.measured(ground.variant(ground.present + mu * ground.usual))

        middle = at()
        slope, bend = np.zeros((len(names), count)), np.zeros((len(names), count, count))
        up = [at((i, 1.0)) for i in range(count)]
        down = [at((i, -1.0)) for i in range(count)]
        for i in range(count):
            slope[:, i] = (up[i] - down[i]) / (2.0 * part)
            bend[:, i, i] = (up[i] - 2.0 * middle + down[i]) / part**2
        for i, j in combinations(range(count), 2):
            mixed = (at((i, 1.0), (j, 1.0)) - up[i] - up[j] + middle) / part**2
            bend[:, i, j] = bend[:, j, i] = mixed
        if not (np.isfinite(slope).all() and np.isfinite(bend).all()):
            name = names[int(np.argmin(np.isfinite(slope).all(axis=1)))]
            raise BadInputError(f"{name} is not known of this hull", "in study", "leave it out")
        return cls(middle, slope, bend, np.where(middle == 0.0, 1.0, np.abs(middle)))

    def at(self, mu: FloatArray) -> FloatArray:
        """Give outputs, (m,)."""
        found: FloatArray = self.value + self.slope @ mu + 0.5 * (self.bend @ mu) @ mu
        return found

    def jacobian(self, mu: FloatArray) -> FloatArray:
        """Give their derivatives by mu, (m, p)."""
        found: FloatArray = self.slope + self.bend @ mu
        return found


@attrs.define(slots=False, eq=False)
class NotReachedError(AssocHullError, ValueError):
    """Steps towards targets did not converge; the output that is farthest off is named."""

    names: Sequence[str]
    target: FloatArray
    best: FloatArray
    trials: int

    def __str__(self) -> str:
        part = np.abs(self.target - self.best) / np.maximum(np.abs(self.target), 1e-300)
        worst = int(part.argmax())
        return (
            f"{self.names[worst]} came to {self.best[worst]:.9g}, {self.target[worst]:.9g} was "
            f"asked, in study after {self.trials} trials; ask for less, or free other parameters"
        )


# --------------------------------------------------------------------------------------
# The search: least change on the model, then steps on hulls.

EXACT = 1e-10
"""A target is met where its residual is no more than this part of the parent's value."""

_TRIALS, _LAST = 12, 4
"""Most hulls tried: measured by the parent's layout, and then in full."""

_ROUNDS = 60
_STILL = 1e-13
_SINGULAR = 1e-10
"""Singular values below this part of the largest count as zero."""

_SLACK = 1e-9
"""A bound holds if it is passed by no more than this part of a usual change."""


@attrs.frozen(eq=False)
class SearchResult:
    """What a search has found.

    Attributes
    ----------
    values : (p,)
        Of all parameters.
    variant : Variant
    outputs : (o,)
        What is measured of it.
    residual : float
        The largest residual, in parts of the parent's values; 0 without targets.
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

    ground: StudyParent
    design: StudyDesign
    model: QuadraticModel
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

    def run(self) -> SearchResult:
        """Go on until the targets are met, first by the parent's layout, then in full."""
        variant = self._made()
        for measure, most in ((self.ground.measured, _TRIALS), (self.ground.fully, _LAST)):
            found = self._settled(variant, measure, most)
            variant = found.variant
        return found

    def _settled(
        self, variant: Variant, measure: Callable[[Variant], FloatArray], most: int
    ) -> SearchResult:
        """Step until what is measured is what is asked."""
        before: tuple[FloatArray, FloatArray] | None = None
        for _ in range(most):
            outputs = measure(variant)
            values = outputs[: len(self.target)]
            lacking = self.target - values
            residual = float((np.abs(lacking) / self.model.size).max(initial=0.0))
            if residual <= EXACT:
                return SearchResult(self._parameters(), variant, outputs, residual, self.trials)
            if before is not None:
                self._learn(self.mu - before[0], values - before[1])
            before = self.mu.copy(), values
            self.mu[self.free] += _least(self.slope[:, self.free], lacking, self.model.size)
            self._require_bounds()
            variant = self._made()
        raise NotReachedError(self.design.aims, self.target, values, self.trials)

    def _made(self) -> Variant:
        """Make the hull at `mu`, and count it."""
        self.trials += 1
        return self.ground.variant(self._parameters())

    def _learn(self, step: FloatArray, change: FloatArray) -> None:
        """Correct the slopes by what a step has changed: Broyden's update of least change."""
        size = float((step * step).sum())
        if size > 0.0:
            self.slope = self.slope + np.outer(change - self.slope @ step, step) / size

    def _parameters(self) -> FloatArray:
        return _values(self.ground, self.design, self.number, self.mu)

    def _require_bounds(self) -> None:
        given = len(self.design.given)
        usual = self.ground.usual[given:]
        _require_within(self.design, self._parameters()[given:], _SLACK * usual)


def search_variant(
    ground: StudyParent, model: QuadraticModel | None, design: StudyDesign, number: int
) -> SearchResult:
    """Find a variant of a study.

    Parameters
    ----------
    ground : StudyParent
        The parent.
    model : QuadraticModel or None
        Of the outputs that are aimed at; None where nothing is.
    design : StudyDesign
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
        return SearchResult(values, variant, ground.fully(variant), 0.0, 1)
    start, free = _on_model(ground, model, design, mu, design.targets[number])
    return _Search(ground, design, model, number, start, free, model.jacobian(start)).run()


def _values(ground: StudyParent, design: StudyDesign, number: int, mu: FloatArray) -> FloatArray:
    """Give the values of all parameters; those that are given as they were, to the bit."""
    found: FloatArray = ground.present + mu * ground.usual
    found[: len(design.given)] = design.values[number]
    return found


def _on_model(
    ground: StudyParent,
    model: QuadraticModel,
    design: StudyDesign,
    mu: FloatArray,
    target: FloatArray,
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
        # one more held would leave fewer parameters than targets
        if len(free) - 1 < len(target):
            values = (ground.present + mu * usual)[given:]
            _require_within(design, values, np.zeros(len(values)))
        held[worst], mu[worst] = True, within[worst - given]


def _settle_model(
    model: QuadraticModel, mu: FloatArray, free: IntArray, target: FloatArray
) -> FloatArray:
    """Step on the model until the least change settles, (p,)."""
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
    """Give the least change of what is free, (f,), that removes the residuals, (m,)."""
    least = np.linalg.lstsq(slope / size[:, None], lacking / size, rcond=_SINGULAR)[0]
    return np.asarray(least, np.float64)


def _require_within(design: StudyDesign, values: FloatArray, slack: FloatArray) -> None:
    """Refuse free parameters that leave their bounds."""
    over = np.maximum(design.bounds[:, 0] - values, values - design.bounds[:, 1]) - slack
    if over.max(initial=0.0) > 0.0:
        worst = int(over.argmax())
        low, high = design.bounds[worst].tolist()
        raise OutOfRangeError(
            design.free[worst], float(values[worst]), "in study",
            "would be needed to reach the targets", low, high, "",
        )  # fmt: skip
