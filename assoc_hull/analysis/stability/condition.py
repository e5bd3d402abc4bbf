"""The condition of a ship: what she weighs, where its centre lies, and how she floats upright."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.appendage import require_volume
from assoc_hull.analysis.hydrostatics.floating import (
    FloatingPosition,
    planes_of,
    require_afloat,
    require_numbers,
)
from assoc_hull.analysis.hydrostatics.floating_body import FloatingBody
from assoc_hull.analysis.hydrostatics.hydrostatic_header import HydrostaticHeader
from assoc_hull.analysis.hydrostatics.hydrostatics import position_of
from assoc_hull.analysis.hydrostatics.loading import Load, immersion
from assoc_hull.analysis.stability.afloat import Afloat
from assoc_hull.analysis.stability.levers import Case, TrimRule
from assoc_hull.errors import BadInputError

__all__ = ["Asked", "Condition", "case_of", "condition_of"]

_WHERE = "in stability"


@attrs.frozen
class Asked:
    """What a caller tells of the condition; all as for `stability`."""

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


def condition_of(body: FloatingBody, header: HydrostaticHeader, asked: Asked) -> Condition:
    """Work out a condition.

    Parameters
    ----------
    body : FloatingBody
        The hull.
    header : HydrostaticHeader
        Its dimensions, water, shell factor and appendages.
    asked : Asked
        A weight (at even keel, or trimmed by its `lcg`), or draughts, whose centre of buoyancy
        then tells where gravity is; the design draught if nothing is given.

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
    found = Afloat(body, header.length, header.appendages).measure(planes)
    require_volume(found.volume, header.appendages, planes, _WHERE)
    volume = float(found.volume[0])
    lcg = asked.lcg
    if lcg is None:
        lift = 0.0 if asked.kg is None else float(found.moment_z[0]) / volume - asked.kg
        lcg = float(found.moment_x[0]) / volume + lift * float(planes.tan_trim[0])
    weight = volume * header.rho * header.shell_factor if asked.weight is None else asked.weight
    return Condition(weight, volume, lcg, asked.tcg, asked.kg, upright)


def _upright(body: FloatingBody, header: HydrostaticHeader, asked: Asked) -> FloatingPosition:
    """Give where she floats at no heel."""
    if asked.weight is None:
        return position_of(header, asked.draught, asked.draughts, 0.0, "moulded")
    load = Load(
        asked.weight, header.rho, header.shell_factor, asked.lcg, asked.kg,
        appendages=header.appendages,
    )  # fmt: skip
    return immersion(body, load, header.length)


def case_of(
    body: FloatingBody, header: HydrostaticHeader, conditions: list[Condition], trim: TrimRule
) -> Case:
    """Put conditions of one ship together, to be heeled."""
    planes = planes_of([each.upright for each in conditions], header.length)
    return Case(
        Afloat(body, header.length, header.appendages),
        np.array([each.volume for each in conditions]),
        np.array([each.upright.draught_mean for each in conditions]),
        planes.tan_trim,
        np.array([each.lcg for each in conditions]),
        conditions[0].tcg,
        conditions[0].kg,
        trim,
    )
