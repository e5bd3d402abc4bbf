"""Every tolerance of the kernel in one frozen value: lengths in metres, and why each is so.

Lengths hold for hulls of 100 m and more, and are less in proportion for others. These stay what
they are, whatever the hull:

- `IN_PLANE` and `SAME_PLANE`, and points of a file that repeat one another (1e-6 m): coordinates
  are written with micrometres at best;
- what is of the order of rounding (1e-9 m and less): it comes from the digits of numbers, and lies
  far below what any hull of 1 m or more shows;
- the lengths between which a hull may lie at full scale (1 to 600 m): others show a wrong unit.

Examples
--------
>>> from assoc_hull.tolerance import Tolerances
>>> Tolerances().coincident
1e-06
"""

from __future__ import annotations

import math
from typing import Any

import attrs
import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.arguments import not_negative

FloatArray = NDArray[np.float64]

__all__ = [
    "FULL_LENGTH",
    "IN_PLANE",
    "SAME_PLANE",
    "Tolerances",
    "at_full_length",
    "length_factor",
    "round_at_size",
    "settled",
]  # fmt: skip

FULL_LENGTH = 100.0
"""Lengths in this package hold for hulls of this length (m) and more; shorter hulls take them in
proportion, while 5 mm is no better for being 15 mm on a tanker."""

IN_PLANE = 1e-6
"""A place handed in as near as this (m) to the plane of its line is meant to lie in it, and is
put there. Absolute, whatever the hull: coordinates are written with micrometres at best."""

SAME_PLANE = 1e-6
"""Planes of one family nearer than this (m) are one plane; absolute, by the same reason."""


_DECIMALS = 9
"""Places are decimals down to 1e-9 m at 100 m, if they are decimals at all."""

_LAST_BITS = 8.0
"""Spacings of floating point numbers by which two ways to one place may differ."""


def length_factor(length: float) -> float:
    """Give what absolute lengths are multiplied by for a hull of a length (m), at most 1.

    The length is that between perpendiculars where it is known, given or found; else that of the
    extent. Factors of hulls that differ by a power of two do so to the bit.

    Examples
    --------
    >>> from assoc_hull.tolerance import length_factor
    >>> length_factor(320.0), length_factor(25.0)
    (1.0, 0.25)
    """
    return min(1.0, length / FULL_LENGTH)


def at_full_length(values: ArrayLike, factor: float) -> FloatArray:
    """Give lengths (m) of a hull with a factor of lengths as they are of the hull of 100 m.

    What was a decimal there (down to 1e-9 m) before a file was scaled is that again, to the last
    bit: no rounding of places may turn on what scaling has left. Powers of two leave nothing.

    Examples
    --------
    >>> from assoc_hull.tolerance import at_full_length
    >>> at_full_length([4.7 / 7.0, 1.5], 1.0 / 7.0).tolist(), 4.7 / 7.0 / (1.0 / 7.0)
    ([4.7, 10.5], 4.700000000000001)
    """
    grown = np.asarray(values, np.float64) / factor
    return grown if math.frexp(factor)[0] == 0.5 else _decimals(grown)


def settled(values: ArrayLike, factor: float) -> FloatArray:
    """Give lengths (m) free of what a change of unit or a shift has left in their last bits.

    What is a decimal of the hull of 100 m, by the factor of lengths, becomes just that; so one hull
    in metres and in feet has the same bits.

    Examples
    --------
    >>> from assoc_hull.tolerance import settled
    >>> 0.1 + 0.2, settled(0.1 + 0.2, 1.0).item(), settled([0.7 / 3.0], 0.5).tolist()
    (0.30000000000000004, 0.3, [0.2333333333333333])
    """
    return np.asarray(factor * _decimals(np.asarray(values, np.float64) / factor))


def _decimals(grown: FloatArray) -> FloatArray:
    """Give lengths (m) at 100 m, those that rounding alone keeps from a decimal as decimals."""
    decimal = np.round(grown, _DECIMALS)
    # A difference of places has the rounding of these, not of its own.
    rounding = _LAST_BITS * np.spacing(np.maximum(np.abs(grown), FULL_LENGTH))
    return np.where(np.abs(decimal - grown) <= rounding, decimal, grown)


def round_at_size(length: float, digits: int, factor: float) -> float:
    """Round a length (m) to a digit as fine as a hull's factor of lengths asks for.

    The digit is that of the hull of 100 m; what is a short decimal there stays what it is here.

    Examples
    --------
    >>> from assoc_hull.tolerance import round_at_size
    >>> [round_at_size(0.123456, 3, each) for each in (1.0, 0.125)], round_at_size(0.3, 3, 0.04)
    ([0.123, 0.1235], 0.3)
    """
    full = float(at_full_length(length, factor))
    part, power = math.frexp(factor)
    if part != 0.5 and round(full, digits) == full:
        return length
    # Of a unit that is a power of two short decimals of a metre stay what they are too.
    unit = 2.0 ** (power - 1)
    return round(length / unit, digits) * unit


_COINCIDENT = 1e-6


def _not_negative(value: object) -> float:
    return not_negative(value, "a tolerance", "in Tolerances")


def _least(default: float) -> Any:
    """Give a field of a number not below 0, with its default."""
    return attrs.field(default=default, converter=_not_negative)


@attrs.frozen
class Tolerances:
    """The tolerances of a hull; part of its definition.

    The defaults are those of hulls of 100 m and more; `of_length` gives those of any hull.

    Attributes
    ----------
    coincident : float
        Two defining points of one curve closer than this (m) are an error: a chord so
        short carries no direction. It goes with the size of the hull and with nothing else, so
        that `factor` is read from it.
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

    coincident: float = _least(_COINCIDENT)
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

    @classmethod
    def of_length(cls, length: float, **given: float) -> Tolerances:
        """Give the tolerances of a hull of a length (m); those that are `given` stay as they are.

        Examples
        --------
        >>> from assoc_hull.tolerance import Tolerances
        >>> Tolerances.of_length(30.0).adopted_spacing, Tolerances.of_length(300.0) == Tolerances()
        (0.06, True)
        """
        return attrs.evolve(cls().scaled(length_factor(length)), **given)

    def scaled(self, factor: float) -> Tolerances:
        """Give them with every length times a factor; angles and parts stay."""
        return attrs.evolve(self, **{name: factor * getattr(self, name) for name in _LENGTHS})

    @property
    def factor(self) -> float:
        """What lengths that are fixed in the code are multiplied by for this hull, at most 1."""
        # Nil is no size: such tolerances were given by hand.
        return min(1.0, self.coincident / _COINCIDENT) if self.coincident else 1.0


_LENGTHS = (
    "coincident", "consistent", "adoption", "prune", "keep", "gap_floor", "turn_spacing",
    "adopted_spacing", "substep",
)  # fmt: skip
