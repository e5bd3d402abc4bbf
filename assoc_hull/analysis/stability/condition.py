"""The condition of a ship: what she weighs, where its centre lies, and how she floats upright.

Also the checks of what callers of stability, cross curves and equilibrium give: heels (degrees),
and what to do about doubts.
"""

from __future__ import annotations

from typing import Literal, get_args

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.draughts_from_weight import Load, position_under_load
from assoc_hull.analysis.hydrostatics.floating_body import (
    FloatingBody,
    FloatingPosition,
    planes_of,
    require_afloat,
    require_numbers,
    require_volume,
    rising_numbers,
)
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import position_of
from assoc_hull.analysis.hydrostatics.record import HydrostaticHeader
from assoc_hull.analysis.stability.righting_lever import DisplacingHull, StabilityCase, TrimRule
from assoc_hull.arguments import choice
from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray

__all__ = [
    "HEELS",
    "Condition",
    "ConditionRequest",
    "OnError",
    "case_of",
    "checked_on_error",
    "condition_of",
    "heels_of",
]

# --------------------------------------------------------------------------------------
# Checks of arguments.

_WHERE = "in stability"

HEELS: tuple[float, ...] = tuple(float(each) for each in range(0, 95, 5))
"""Heels of a table that are taken if none are given, degrees."""

OnError = Literal["refuse", "report"]


def heels_of(heels: object) -> FloatArray:
    """Take rising heels, degrees, from -90 to 90.

    Raises
    ------
    BadInputError
        No numbers, or some that do not rise.
    OutOfRangeError
        One beyond.
    """
    found = rising_numbers(heels, "heels", _WHERE)
    far = found[np.abs(found) > 90.0]
    if len(far):
        why = "turns the ship over"
        raise OutOfRangeError("a heel", float(far[0]), _WHERE, why, -90.0, 90.0, "deg")
    return found


def checked_on_error(on_error: object) -> None:
    """Refuse what is no way to deal with doubts, before anything is computed."""
    choice(on_error, "on_error", get_args(OnError), _WHERE)


# --------------------------------------------------------------------------------------
# Conditions.


@attrs.frozen
class ConditionRequest:
    """What a caller says of the condition; all as for `stability`."""

    weight: float | None = None
    draught: float | None = None
    draughts: tuple[float, float] | None = None
    lcg: float | None = None
    tcg: float = 0.0
    kg: float | None = None


@attrs.frozen
class Condition:
    """A condition of a ship.

    Attributes
    ----------
    weight, volume : float, t and m3
        All of it, and the moulded volume that carries it, appendages included.
    lcg, tcg : float, m
        Centre of gravity from AP and to port.
    kg : float or None, m
        Above the base line; None: none was given.
    upright : FloatingPosition
        Where she floats at no heel, in equilibrium lengthwise.
    """

    weight: float
    volume: float
    lcg: float
    tcg: float
    kg: float | None
    upright: FloatingPosition


def condition_of(
    body: FloatingBody, header: HydrostaticHeader, asked: ConditionRequest
) -> Condition:
    """Work out a condition from what was asked, and from dimensions, water and appendages.

    Given is a weight (at even keel, or trimmed by its `lcg`), or draughts, whose centre of buoyancy
    then shows where gravity is; the design draught if nothing is given.

    Raises
    ------
    OutOfRangeError
        A weight that she does not carry, or draughts at which she does not float.
    BadInputError
        Weight and draughts both, or an `lcg` with draughts.
    """
    given = [asked.weight is not None, asked.draught is not None, asked.draughts is not None]
    if sum(given) > 1:
        what = "more than one of weight, draught and draughts is given"
        raise BadInputError(what, _WHERE, "give one of them")
    if asked.weight is None and asked.lcg is not None:
        remedy = "give it with a weight: draughts tell where the centre of gravity is"
        raise BadInputError("lcg is given without a weight", _WHERE, remedy)
    require_numbers(asked.draughts if asked.draught is None else asked.draught, body.limits)
    upright = _upright(body, header, asked)
    planes = require_afloat([upright], body.limits, header.length)
    found = DisplacingHull(body, header.length, header.appendages).measure(planes)
    require_volume(found.volume, header.appendages, planes, _WHERE)
    volume = float(found.volume[0])
    lcg = asked.lcg
    if lcg is None:
        lift = 0.0 if asked.kg is None else float(found.moment_z[0]) / volume - asked.kg
        # G stands above B at right angles to the water, not to the base line.
        lcg = float(found.moment_x[0]) / volume + lift * float(planes.tan_trim[0])
    weight = volume * header.rho * header.shell_factor if asked.weight is None else asked.weight
    return Condition(weight, volume, lcg, asked.tcg, asked.kg, upright)


def _upright(
    body: FloatingBody, header: HydrostaticHeader, asked: ConditionRequest
) -> FloatingPosition:
    """Give where she floats at no heel."""
    if asked.weight is None:
        return position_of(header, asked.draught, asked.draughts, 0.0, "moulded")
    load = Load(
        asked.weight, header.rho, header.shell_factor, asked.lcg, asked.kg,
        appendages=header.appendages,
    )  # fmt: skip
    return position_under_load(body, load, header.length)


def case_of(
    body: FloatingBody, header: HydrostaticHeader, conditions: list[Condition], trim: TrimRule
) -> StabilityCase:
    """Put conditions of one ship together, to be heeled."""
    planes = planes_of([each.upright for each in conditions], header.length)
    return StabilityCase(
        DisplacingHull(body, header.length, header.appendages),
        np.array([each.volume for each in conditions]),
        np.array([each.upright.draught_mean for each in conditions]),
        planes.tan_trim,
        np.array([each.lcg for each in conditions]),
        conditions[0].tcg,
        conditions[0].kg,
        trim,
    )
