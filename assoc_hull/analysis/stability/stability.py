"""Stability of a hull: righting levers in a condition, and whether they satisfy the code."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.appendage import Appendage
from assoc_hull.analysis.hydrostatics.equilibrium import tons
from assoc_hull.analysis.hydrostatics.floating import planes_of
from assoc_hull.analysis.hydrostatics.floating_body import FloatingBody
from assoc_hull.analysis.hydrostatics.hydrostatic_header import SALT, HydrostaticHeader
from assoc_hull.analysis.hydrostatics.measured_hull import HasState, body_of, header_of
from assoc_hull.analysis.stability.asked import (
    HEELS,
    OnError,
    checked_on_error,
    heels_of,
    require_sound,
)
from assoc_hull.analysis.stability.condition import Asked, case_of, condition_of
from assoc_hull.analysis.stability.criteria import Judged, intact_criteria
from assoc_hull.analysis.stability.flooding import (
    Flooding,
    FloodingPoint,
    both_sides,
    drowned_at,
    open_deck_limit,
)
from assoc_hull.analysis.stability.heeled import heeled
from assoc_hull.analysis.stability.lever_curve import lever_curve
from assoc_hull.analysis.stability.levers import TrimRule
from assoc_hull.analysis.stability.notes import notes_of, why_it_ends
from assoc_hull.analysis.stability.result import Stability, StabilityAngles
from assoc_hull.arguments import all_of, choice, number
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray

__all__ = ["stability", "stability_of"]

_WHERE = "in stability"
_STEP = 5.0
_LEAST = 40.0
"""The curve goes at least so far (degrees), for the criteria."""

_RIM = 1e-6
"""Degrees by which the curve stays short of the edge of an open deck."""


def stability(
    hull: HasState,
    *,
    kg: float,
    weight: float | None = None,
    draught: float | None = None,
    draughts: tuple[float, float] | None = None,
    lcg: float | None = None,
    tcg: float = 0.0,
    trim: TrimRule = "fixed",
    heels: Sequence[float] = HEELS,
    flooding: Iterable[FloodingPoint] = (),
    rho: float = SALT,
    shell_factor: float = 1.0,
    appendages: Iterable[Appendage] = (),
    on_error: OnError = "refuse",
    date: str | None = None,
) -> Stability:
    """Compute the righting levers of a ship in a condition, and judge them.

    Parameters
    ----------
    hull : Hull
        The hull; its `particulars.deck` tells whether the deck is open or closed.
    kg : float, m
        Centre of gravity above the base line, corrected for free surfaces by the caller.
    weight : float, t
        All of it; or `draught`, or `draughts`; the design draught if none is given.
    draught, draughts : float or (float, float), m
        At even keel, or T_A and T_F: upright, moulded.
    lcg : float or None, m
        With `weight`: centre of gravity from AP. Without, she is at even keel upright.
    tcg : float, m
        Centre of gravity to port.
    trim : "fixed" or "free"
        Keep the trim that she has upright, or find that of equilibrium at each heel.
    heels : (d,), degrees
        For the table: rising, + starboard down, from -90 to 90.
    flooding : iterable of FloodingPoint
        Openings through which water comes in.
    rho, shell_factor, appendages, on_error
        As for `hydrostatics`.
    date : str or None
        For the head.

    Returns
    -------
    Stability
        Levers, angles and criteria.

    Raises
    ------
    OutOfRangeError
        A weight that she does not carry, draughts at which she does not float, with the range.
    BadInputError
        A number that cannot be used; a doubtful hull.

    Examples
    --------
    >>> from assoc_hull.analysis.stability.stability import stability
    >>> from assoc_hull.sources import examples
    >>> found = stability(examples.wigley(), draught=6.25, kg=4.0, heels=[0, 10, 20, 30])
    >>> found.kn.round(3).tolist()
    [0.0, 0.918, 1.82, 2.694]
    """
    terms: dict[str, object] = {
        "rho": rho, "shell_factor": shell_factor, "kg": number(kg, "kg", _WHERE),
        "appendages": appendages, "date": date,
    }  # fmt: skip
    choice(trim, "trim", ("fixed", "free"), _WHERE)
    checked_on_error(on_error)
    points = all_of(flooding, FloodingPoint, "flooding", _WHERE)
    wanted = heels_of(heels)
    body = body_of(hull)
    header = header_of(hull, body, terms)
    centre = None if lcg is None else number(lcg, "lcg", _WHERE)
    aside = number(tcg, "tcg", _WHERE)
    asked = Asked(
        None if weight is None else tons(weight), draught, draughts, centre, aside, header.kg
    )
    found = stability_of(body, header, asked, trim, wanted, points)
    upright = planes_of([found.condition.upright], header.length)
    doubts = require_sound(body, upright, on_error)
    return attrs.evolve(found, notes=(*found.notes, *doubts))


def stability_of(
    body: FloatingBody,
    header: HydrostaticHeader,
    asked: Asked,
    trim: TrimRule,
    heels: FloatArray,
    points: Sequence[FloodingPoint] = (),
) -> Stability:
    """Compute the stability of a floating body; as `stability`, of which it is the inner part.

    Parameters
    ----------
    body : FloatingBody
        The hull.
    header : HydrostaticHeader
        Dimensions, water and appendages.
    asked : Asked
        The condition.
    trim : "fixed" or "free"
        What becomes of the trim.
    heels : (d,), degrees
        For the table.
    points : sequence of FloodingPoint
        Openings.
    """
    condition = condition_of(body, header, asked)
    case = case_of(body, header, [condition], trim)
    upright = heeled(case, np.zeros(1))
    if not np.isfinite(upright.gz[0]):
        remedy = "give another condition"
        raise BadInputError("she does not float upright", _WHERE, remedy)
    side = -1 if upright.gz[0] > 1e-12 else 1
    limit = None if body.limits.closed else open_deck_limit(case, condition, side)
    curve = lever_curve(case, _nodes(heels, side, _end(limit)), side)
    drowned = drowned_at(curve, [both_sides(body.limits.deck), *(each.places for each in points)])
    floodings = tuple(map(Flooding, points, drowned[1:]))
    first = min((each for each in drowned[1:] if each is not None), default=None)
    curve = curve.through([*drowned[:1], first])
    why = why_it_ends(curve.end, limit)
    at = heeled(case, heels, near=curve.heels)
    gz_max, largest = curve.largest
    return Stability(
        header, condition, trim, at, curve,
        StabilityAngles(drowned[0] if limit is None else limit, first, largest, *curve.positive),
        curve.gm, gz_max, intact_criteria(Judged(curve, first, bool(points), why)), floodings,
        notes_of(at, case, limit, side),
    )  # fmt: skip


def _end(limit: float | None) -> float:
    """Give the largest heel that is computed, degrees."""
    if limit is not None and limit <= 2.0 * _RIM:
        remedy = "give less draught, or close the deck"
        raise BadInputError("the edge of the open deck is in the water upright", _WHERE, remedy)
    return 90.0 if limit is None else limit - _RIM


def _nodes(heels: FloatArray, side: int, end: float) -> FloatArray:
    """Give the heels from which the curve is begun: all that are asked, and every 5 degrees."""
    most = max(_LEAST, float(np.abs(heels).max()))
    least = min(0.0, float((side * heels).min()))
    steps = np.arange(0.0, 90.0 + _STEP, _STEP)
    judged = np.concatenate([steps[steps < most], [most], -steps[-steps > least], [least]])
    inside = np.clip(np.concatenate([judged, side * heels]), -end, end)
    return np.unique(side * inside)
