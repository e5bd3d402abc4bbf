"""Every tolerance of the kernel in one frozen value: lengths in metres, and why each is so.

Examples
--------
>>> from assoc_hull.tolerance import Tolerances
>>> Tolerances().coincident
1e-06
"""

from __future__ import annotations

from typing import Any

import attrs

from assoc_hull.arguments import not_negative

__all__ = ["IN_PLANE", "SAME_PLANE", "Tolerances"]

IN_PLANE = 1e-6
"""A place handed in as near as this (m) to the plane of its line is meant to lie in it, and is
put there: coordinates are written with micrometres at best."""

SAME_PLANE = 1e-6
"""Planes of one family nearer than this (m) are one plane, by the same reason."""


def _not_negative(value: object) -> float:
    return not_negative(value, "a tolerance", "in Tolerances")


def _least(default: float) -> Any:
    """Give a field of a number not below 0, with its default."""
    return attrs.field(default=default, converter=_not_negative)


@attrs.frozen
class Tolerances:
    """The tolerances of a hull; part of its definition.

    Attributes
    ----------
    coincident : float
        Two defining points of one curve closer than this (m) are an error: a chord so
        short carries no direction.
    consistent : float
        Largest distance (m) of a shared or driven crossing from either of its curves.
    adoption : float
        Largest deviation (m) an adopted line may keep from its source.
    prune : float
        A point that was left behind by a line is dropped where the curve stays within
        this (m) of its shape.
    keep : float
        A crossing of a new line defines the old curves only if these stay within this (m).
    gap_floor : float
        Least limit (m) of a watched gap; a net whose gaps are nil has this as its limit.
    transversal_deg : float
        Least angle between a curve and a plane whose crossing may define the curve.
    spacing : float
        Least spacing of defining crossings, as a part of the median spacing.
    turn_deg : float
        A curve that turns by this between two crossings may keep both.
    turn_spacing : float
        They must then be this far (m) apart at least.
    turn_spacing_part : float
        Or this part of the median spacing, whichever is more.
    adopted_spacing : float
        No point is added on adoption closer than this (m) to one that defines the curve.
    field_normal : float
        A row whose freedom makes a smaller cosine with the hull normal is left alone.
    substep : float
        Largest displacement (m) in one sub-step of a field.
    """

    coincident: float = _least(1e-6)
    consistent: float = _least(1e-9)
    adoption: float = _least(5e-3)
    prune: float = _least(1e-3)
    keep: float = _least(1e-4)
    gap_floor: float = _least(1e-3)
    transversal_deg: float = _least(15.0)
    spacing: float = _least(0.25)
    turn_deg: float = _least(3.0)
    turn_spacing: float = _least(0.15)
    turn_spacing_part: float = _least(0.02)
    adopted_spacing: float = _least(0.2)
    field_normal: float = _least(0.15)
    substep: float = _least(0.1)
