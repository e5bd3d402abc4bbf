"""The errors of aiming: what cannot be reached, and why."""

from __future__ import annotations

import attrs

from assoc_hull.errors.family import AssocHullError

__all__ = ["DependentTargetsError", "TooFewFreeError", "UnreachableError"]


@attrs.define(slots=False, eq=False)
class TooFewFreeError(AssocHullError, ValueError):
    """There are more targets than free parameters; numbers of both."""

    targets: int
    free: int

    def __str__(self) -> str:
        return (
            f"aim: {self.targets} targets need at least {self.targets} free parameters for an "
            f"exact answer ({self.free} given); best compromise returned only with exact=False"
        )


@attrs.define(slots=False, eq=False)
class DependentTargetsError(AssocHullError, ValueError):
    """Free parameters move some targets only together, or one not at all; nothing was changed.

    Attributes
    ----------
    targets : tuple of str
        Their names; one name where nothing moves it.
    condition : float
        Of the scaled derivatives; infinite where they have no full rank.
    """

    targets: tuple[str, ...]
    condition: float

    def __str__(self) -> str:
        if len(self.targets) == 1:
            return f"aim: no free parameter moves {self.targets[0]}; drop it or free another one"
        size = f"{self.condition:.0e}".replace("e+0", "e").replace("e+", "e")
        return (
            f"aim: targets {_in_words(self.targets)} move together (condition {size}); drop one "
            "or free another parameter"
        )


@attrs.define(slots=False, eq=False)
class UnreachableError(AssocHullError, ValueError):
    """A target cannot be reached by what is free; nothing was changed.

    Attributes
    ----------
    target, unit : str
        The one that is farthest from what was asked, in the scale of its usual size; "-" and
        nothing stand for no unit.
    asked, best, before : float
        Asked for, of the nearest hull, and of the parent.
    bounds : tuple of str
        Free parameters at their bounds.
    why : str
        What keeps the hull from coming nearer where no bound does; may be empty.
    """

    target: str
    unit: str
    asked: float
    best: float
    before: float
    bounds: tuple[str, ...] = ()
    why: str = ""

    @property
    def shortfall(self) -> float:
        """How far the nearest hull is above what was asked, in per cent of the parent."""
        return 100.0 * (self.best - self.asked) / abs(self.before) if self.before else float("inf")

    def __str__(self) -> str:
        unit = f" {self.unit}" if self.unit not in ("", "-") else ""
        digits = next(
            (n for n in (6, 8, 10, 12) if f"{self.asked:.{n}g}" != f"{self.best:.{n}g}"), 17
        )
        short = f" ({self.shortfall:+.3g} % of the parent)" if self.before else ""
        return (
            f"aim: cannot reach {self.target} {self.asked:.{digits}g}{unit}: best "
            f"{self.best:.{digits}g}{unit}{short}{self._reason()}"
        )

    def _reason(self) -> str:
        parts = list[str]()
        if self.bounds:
            end = "at its bound" if len(self.bounds) == 1 else "at their bounds"
            parts.append(f", {_in_words(self.bounds)} {end}")
        if self.why:
            parts.append(f"; {self.why}")
        return "".join(parts) or "; free another parameter, or ask for less"


def _in_words(names: tuple[str, ...]) -> str:
    """Give names as one speaks them: A, B and C."""
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)
