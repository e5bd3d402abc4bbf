"""What aiming found: reached values, bounds, and what derivatives say of the targets."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.display import ShownAsText
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.variation.aiming.newton_iteration import AimStep, NewtonIteration
from assoc_hull.variation.aiming.quadratic_program import RANK
from assoc_hull.variation.aiming.scaled_problem import Evaluated, Iterate

__all__ = ["AimReport", "make_report"]

_WORTH = 0.1
"""Targets that have less than this part in a combination are not named with it."""

_NEARLY_ONE = 1e3
"""The condition number from which targets are nearly one target, so that changes grow large."""


@attrs.frozen(eq=False, repr=False)
class AimReport(ShownAsText):
    """What aiming at targets found.

    Attributes
    ----------
    free, outputs, units : tuple of str
        Names of the k free parameters and of the m targets, with the units of these.
    amplitudes : (k,) float
        Of the hull that was found: m or degrees, or factors on layers.
    before, targets, values : (m,) float
        Of the hull at the start, asked for, and of the hull that was found.
    active : tuple of str
        Free parameters at a bound.
    singular : (min(m, k),) float
        Singular values of the scaled derivatives, the largest first.
    combination : (m,) float
        Of scaled targets, of size 1: what free parameters move least, or not at all.
    steps : tuple of AimStep
        The start, and every step that was taken.
    reached : bool
        Whether all targets are met; else this is the best compromise.
    why : str
        What the last hull beyond was refused for; empty where nothing was in the way.
    hull : Evaluated or None
        The hull that was found, as the problem gave it; None in the report of a variation, which
        holds the hull itself.
    """

    free: tuple[str, ...]
    outputs: tuple[str, ...]
    units: tuple[str, ...]
    amplitudes: FloatArray
    before: FloatArray
    targets: FloatArray
    values: FloatArray
    active: tuple[str, ...]
    singular: FloatArray
    combination: FloatArray
    steps: tuple[AimStep, ...]
    reached: bool
    why: str
    hull: Evaluated | None = attrs.field(repr=False)

    @property
    def misses(self) -> FloatArray:
        """Values less targets, (m,), in their units."""
        return self.values - self.targets

    @property
    def shortfalls(self) -> FloatArray:
        """Misses in per cent of the values at the start, (m,); infinite where these are nil."""
        with np.errstate(divide="ignore", invalid="ignore"):
            parts = 100.0 * self.misses / np.abs(self.before)
        return np.where(self.misses == 0.0, 0.0, parts)

    @property
    def residual(self) -> float:
        """The largest scaled miss."""
        return self.steps[-1].residual

    @property
    def kkt(self) -> float:
        """What is left of the conditions of the least change, or of the best compromise."""
        return self.steps[-1].kkt

    @property
    def change(self) -> float:
        """The size of the scaled change of all free parameters."""
        return self.steps[-1].change

    @property
    def condition(self) -> float:
        """The largest singular value over the least; infinite without full rank."""
        full = len(self.singular) == len(self.outputs) and self.rank == len(self.singular)
        return float(self.singular[0] / self.singular[-1]) if full else float("inf")

    @property
    def rank(self) -> int:
        """How many combinations of targets move independently."""
        return int((self.singular > RANK * self.singular.max(initial=0.0)).sum())

    @property
    def together(self) -> tuple[str, ...]:
        """The targets of the combination that moves least."""
        worth = np.abs(self.combination) >= _WORTH * np.abs(self.combination).max()
        return tuple(name for name, is_worth in zip(self.outputs, worth, strict=True) if is_worth)

    def __str__(self) -> str:
        return "\n".join([self._verdict(), *self._reached(), *self._changes()])

    def _verdict(self) -> str:
        count = len(self.steps) - 1
        what = "met" if self.reached else "best compromise"
        # of targets that are met the residual is rounding
        rest = "" if self.reached else f", residual {self.residual:.1e}"
        # One target has none, and of a few that are independent it tells a designer nothing.
        if self.condition >= _NEARLY_ONE:
            rest += f"; the targets hardly differ (condition number {self.condition:.3g})"
        return (
            f"aim: {what} after {count} step{'s' * (count != 1)}{rest}; "
            f"all changes together are {self.change:.4g} times the usual ones"
        )

    def _reached(self) -> list[str]:
        rows = zip(
            self.outputs, self.units, self.before, self.values, self.targets, self.misses,
            strict=True,
        )  # fmt: skip
        return [
            f"{name} {before:.6g} -> {value:.9g}{'' if unit in ('', '-') else f' {unit}'}"
            + ("" if self.reached else f", asked {asked:.9g}, {miss:+.3g} off")
            for name, unit, before, value, asked, miss in rows
        ]

    def _changes(self) -> list[str]:
        return [
            f"{name} by {amount:+.6g}" + (", at its bound" if name in self.active else "")
            for name, amount in zip(self.free, self.amplitudes, strict=True)
        ]


def make_report(found: NewtonIteration, before: FloatArray, units: tuple[str, ...]) -> AimReport:
    """Give the report of a walk.

    Parameters
    ----------
    found : NewtonIteration
        As it ended.
    before : (m,) float
        Values at the start.
    units : tuple of str
        Of the outputs.
    """
    place, problem = found.place, found.place.scaled.problem
    singular, least = _singular(place)
    arrays = (
        place.amplitudes.copy(), before.copy(), place.scaled.targets.copy(),
        np.array(place.hull.values), singular, least,
    )  # fmt: skip
    freeze(*arrays)
    amplitudes, was, targets, values, singular, least = arrays
    return AimReport(
        problem.free, problem.outputs, units, amplitudes, was, targets, values,
        _active(found), singular, least, found.steps, found.end == "met", found.why, place.hull,
    )  # fmt: skip


def _singular(place: Iterate) -> tuple[FloatArray, FloatArray]:
    """Give singular values, and the combination of targets that moves least, (m,).

    Where some do not move at all it is the one of these that is missed.
    """
    left, singular, _ = np.linalg.svd(place.jacobian, full_matrices=True)
    rank = int((singular > RANK * singular.max(initial=0.0)).sum())
    stuck = left[:, rank:] @ (left[:, rank:].T @ place.misses)
    size = float(np.linalg.norm(stuck))
    least = stuck / size if size > 0.0 else left[:, -1]
    return singular, least * np.sign(least[np.abs(least).argmax()])


def _active(found: NewtonIteration) -> tuple[str, ...]:
    """Name the free parameters at bounds; of a compromise, those that would go on beyond."""
    place = found.place
    at = place.at_low | place.at_high if found.end == "met" else place.shut
    return tuple(name for name, is_at in zip(place.scaled.problem.free, at, strict=True) if is_at)
