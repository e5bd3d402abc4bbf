"""Cross curves of stability: KN over displacement and heel."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.floating_body import (
    Appendage,
    FloatingBody,
    rising_numbers,
)
from assoc_hull.analysis.hydrostatics.flotation import body_of, header_of
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import doubts_of
from assoc_hull.analysis.hydrostatics.record import SALT, HydrostaticHeader
from assoc_hull.analysis.stability.condition import (
    Condition,
    ConditionRequest,
    OnError,
    case_of,
    checked_on_error,
    condition_of,
    heels_of,
)
from assoc_hull.analysis.stability.righting_lever import TrimRule, float_at_heels, rough_levers
from assoc_hull.arguments import choice, number
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.model.tables import HasState

__all__ = ["CrossCurves", "cross_curves", "cross_curves_of"]

_WHERE = "in cross curves"

ANGLES: tuple[float, ...] = tuple(float(each) for each in range(5, 95, 5))
"""Heels that are taken if none are given, degrees."""


@attrs.frozen(eq=False)
class CrossCurves:
    """KN of n displacements at k heels.

    Attributes
    ----------
    header : HydrostaticHeader
        What the numbers hold good for; whether the deck is open or closed.
    trim : str
        "fixed" or "free".
    conditions : tuple of n Condition
        The displacements, with the floating position upright.
    heel_deg : (k,), degrees
        + starboard down.
    kn : (n, k), m
        GZ = KN - KG sin(heel) at no trim; nan where she does not float so.
    notes : tuple of str
        What else there is to say.
    """

    header: HydrostaticHeader
    trim: str
    conditions: tuple[Condition, ...]
    heel_deg: FloatArray
    kn: FloatArray
    notes: tuple[str, ...]

    def __attrs_post_init__(self) -> None:
        freeze(self.heel_deg, self.kn)

    @property
    def displacement(self) -> FloatArray:
        """Of the conditions, t, (n,)."""
        return np.array([each.weight for each in self.conditions])

    @property
    def volume(self) -> FloatArray:
        """Of the conditions, m3, (n,)."""
        return np.array([each.volume for each in self.conditions])

    @property
    def draught(self) -> FloatArray:
        """Mean draughts upright, m, (n,)."""
        return np.array([each.upright.draught_mean for each in self.conditions])

    def lines(self) -> Iterator[tuple[str, str]]:
        """Give head and notes as pairs of a title and words."""
        yield from self.header.lines()
        yield "trim", f"{self.trim} as she heels"
        for note in self.notes:
            yield "note", note


def cross_curves(
    hull: HasState,
    *,
    weights: Sequence[float] | None = None,
    draughts: Sequence[float] | None = None,
    heels: Sequence[float] = ANGLES,
    trim_by_stern: float = 0.0,
    trim: TrimRule = "fixed",
    rho: float = SALT,
    shell_factor: float = 1.0,
    kg: float | None = None,
    appendages: Iterable[Appendage] = (),
    on_error: OnError = "refuse",
    date: str | None = None,
) -> CrossCurves:
    """Compute KN over displacement and heel, all in one go.

    The arguments and what is raised are those of `Hull.cross_curves`.
    """
    terms: dict[str, object] = {
        "rho": rho, "shell_factor": shell_factor, "kg": kg, "appendages": appendages, "date": date,
    }  # fmt: skip
    choice(trim, "trim", ("fixed", "free"), _WHERE)
    checked_on_error(on_error)
    wanted = heels_of(heels)
    body = body_of(hull)
    header = header_of(hull, body, terms)
    asked = _asked(weights, draughts, number(trim_by_stern, "trim_by_stern", _WHERE), header.kg)
    found = cross_curves_of(body, header, asked, trim, wanted)
    doubts = doubts_of(body, header, [each.upright for each in found.conditions], on_error, _WHERE)
    return attrs.evolve(found, notes=(*found.notes, *doubts))


def cross_curves_of(
    body: FloatingBody,
    header: HydrostaticHeader,
    asked: Sequence[ConditionRequest],
    trim: TrimRule,
    heels: FloatArray,
) -> CrossCurves:
    """Compute KN of a floating body; as `cross_curves`, of which it is the inner part."""
    conditions = [condition_of(body, header, each) for each in asked]
    case = case_of(body, header, conditions, trim)
    rows = np.repeat(np.arange(len(conditions)), len(heels))
    found = float_at_heels(case, np.tile(heels, len(conditions)), rows)
    kn = found.kn.reshape(len(conditions), len(heels))
    deck = "closed" if body.limits.closed else "open"
    notes = [f"the deck is {deck}"]
    if deck == "open" and np.isnan(kn).any():
        notes[0] += ": where its edge would be under water there is no KN"
    notes += rough_levers(found)
    return CrossCurves(header, trim, tuple(conditions), heels, kn.copy(), tuple(notes))


def _asked(
    weights: object, draughts: object, trim_by_stern: float, kg: float | None
) -> list[ConditionRequest]:
    """Take the displacements."""
    if (weights is None) == (draughts is None):
        raise BadInputError(
            "neither or both of weights and draughts are given", _WHERE, "give one of them"
        )
    if weights is not None:
        if trim_by_stern:
            raise BadInputError("trim_by_stern is given with weights", _WHERE, "give draughts")
        return [
            ConditionRequest(weight=each, kg=kg)
            for each in rising_numbers(weights, "weights", _WHERE).tolist()
        ]
    half = 0.5 * trim_by_stern
    levels = rising_numbers(draughts, "draughts", _WHERE).tolist()
    return [ConditionRequest(draughts=(each + half, each - half), kg=kg) for each in levels]
