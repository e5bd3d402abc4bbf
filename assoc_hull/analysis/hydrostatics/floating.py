"""Where a hull floats: draughts at the perpendiculars and heel, and what of them can be.

A plane is ``z = T_A + (T_F - T_A) x / Lpp - y tan(heel)``: draughts are those of the centre
line, moulded (from the base line), heel is + with starboard down.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.arguments import checked, number, numbers, plain
from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.floating.immersed import Planes

__all__ = ["FloatingPosition", "Limits", "planes_of", "require_afloat", "require_numbers", "rising"]

_WHERE = "in a floating position"


def _heel(_: object, __: object, value: object) -> None:
    if not -90.0 < number(value, "heel_deg", _WHERE) < 90.0:
        raise OutOfRangeError(
            "heel", float(str(value)), _WHERE, "lays the ship on her side", -89.9, 89.9, "deg"
        )


@attrs.frozen
class FloatingPosition:
    """A floating position.

    Attributes
    ----------
    draught_aft, draught_fore : float, m
        T_A and T_F: on the centre line, at the perpendiculars, moulded.
    heel_deg : float, degrees
        + starboard down; between -90 and 90.

    Examples
    --------
    >>> from assoc_hull.analysis.hydrostatics.floating import FloatingPosition
    >>> FloatingPosition(6.0, 5.0).trim_by_stern
    1.0
    """

    draught_aft: float = attrs.field(converter=plain, validator=checked(number, _WHERE))
    draught_fore: float = attrs.field(converter=plain, validator=checked(number, _WHERE))
    heel_deg: float = attrs.field(default=0.0, converter=plain, validator=_heel)

    @property
    def draught_mean(self) -> float:
        """Mean of the two draughts, m."""
        return 0.5 * (self.draught_aft + self.draught_fore)

    @property
    def trim_by_stern(self) -> float:
        """T_A - T_F, m."""
        return self.draught_aft - self.draught_fore

    def __str__(self) -> str:
        return (
            f"at T_A {self.draught_aft:g} m, T_F {self.draught_fore:g} m, "
            f"heel {self.heel_deg:g} deg"
        )


def planes_of(positions: Sequence[FloatingPosition], length: float) -> Planes:
    """Give the planes of floating positions.

    Parameters
    ----------
    positions : sequence of d FloatingPosition
        Where the hull floats.
    length : float, m
        Between perpendiculars.

    Returns
    -------
    Planes
        One per position.

    Examples
    --------
    >>> from assoc_hull.analysis.hydrostatics.floating import FloatingPosition, planes_of
    >>> planes_of([FloatingPosition(6.0, 5.0)], 100.0).tan_trim.tolist()
    [-0.01]
    """
    aft = np.array([each.draught_aft for each in positions], np.float64)
    fore = np.array([each.draught_fore for each in positions], np.float64)
    heel = np.array([each.heel_deg for each in positions], np.float64)
    return Planes(aft, (fore - aft) / length, np.tan(np.radians(heel)))


@attrs.frozen(eq=False)
class Limits:
    """Between what a plane must lie to be a waterplane of a hull; port side, m.

    Attributes
    ----------
    bottom : (n, 3)
        Places of the hull among which the lowest is, at any trim and heel.
    deck : (k, 3)
        The deck edge.
    closed : bool
        The deck is closed: it may go under, as long as some of it is dry. An open deck is
        drowned as soon as its edge is.
    """

    bottom: FloatArray
    deck: FloatArray
    closed: bool

    def __attrs_post_init__(self) -> None:
        freeze(self.bottom, self.deck)

    def mean_draughts(self, planes: Planes, length: float) -> tuple[FloatArray, FloatArray]:
        """Give the least and the most mean draught (m) at the trim and heel of each plane."""
        lift = 0.5 * length * planes.tan_trim
        low = _heights(self.bottom, planes, up=-1.0).min(axis=1)
        top = _heights(self.deck, planes, up=1.0 if self.closed else -1.0)
        return low + lift, (top.max(axis=1) if self.closed else top.min(axis=1)) + lift


def _heights(points: FloatArray, planes: Planes, up: float) -> FloatArray:
    """Give the heights at x = y = 0 of planes through points, (d, n).

    Of port and starboard that is taken which lies higher over the water (`up` 1), or deeper (-1).
    """
    x, y, z = points.T
    side = up * np.abs(planes.tan_heel[:, None]) * np.abs(y)
    found: FloatArray = z - planes.tan_trim[:, None] * x + side
    return found


def require_afloat(positions: Sequence[FloatingPosition], limits: Limits, length: float) -> Planes:
    """Give the planes of floating positions, or say which cannot be.

    Parameters
    ----------
    positions : sequence of d FloatingPosition
        Where the hull floats.
    limits : Limits
        Of the hull.
    length : float, m
        Between perpendiculars.

    Raises
    ------
    OutOfRangeError
        A plane misses the ship, below or above, or drowns an open deck; with the range of
        mean draughts at that trim and heel.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.floating import (
    ...     FloatingPosition,
    ...     Limits,
    ...     require_afloat,
    ... )
    >>> box = np.array([[0.0, 10, 0], [100, 10, 0]])
    >>> limits = Limits(box, box + [0, 0, 12.0], closed=False)
    >>> require_afloat([FloatingPosition(13.0, 13.0)], limits, 100.0)
    Traceback (most recent call last):
    ...
    assoc_hull.errors.OutOfRangeError: a mean draught of 13 m drowns the open deck, at T_A 13 m, \
T_F 13 m, heel 0 deg; give one from 0 to 12 m
    """
    planes = planes_of(positions, length)
    least, most = limits.mean_draughts(planes, length)
    for each, low, high in zip(positions, least.tolist(), most.tolist(), strict=True):
        value = each.draught_mean
        if low >= high:
            what = f"no draught keeps the deck dry, {each}"
            raise BadInputError(
                what, "in hydrostatics", "give less trim or heel, or close the deck"
            )
        if not low < value <= high:
            over = "lies above the deck" if limits.closed else "drowns the open deck"
            why = "lies below the keel" if value <= low else over
            raise OutOfRangeError("a mean draught", value, str(each), why, low, high, "m")
    return planes


def require_numbers(draughts: object, limits: Limits) -> None:
    """Refuse draughts of which one is no finite number, with the range at even keel.

    Parameters
    ----------
    draughts : float, or (k,), m
        What was given; what is no number at all is left to others.
    limits : Limits
        Of the hull.

    Raises
    ------
    OutOfRangeError
        One that is nan or infinite.
    """
    try:
        given = np.ravel(np.array(draughts, np.float64)) if draughts is not None else np.zeros(0)
    except (TypeError, ValueError, OverflowError):
        return
    odd = given[~np.isfinite(given)]
    if len(odd):
        level = Planes(np.zeros(1), np.zeros(1), np.zeros(1))
        least, most = (float(each[0]) for each in limits.mean_draughts(level, 0.0))
        why = "is no finite number"
        raise OutOfRangeError("a draught", float(odd[0]), _WHERE, why, least, most, "m")


def rising(values: object, name: str, where: str) -> FloatArray:
    """Take numbers (k,), m, that rise; one number will do.

    Raises
    ------
    BadInputError
        No number, one that is not finite, or one that is not above the one before.

    Examples
    --------
    >>> from assoc_hull.analysis.hydrostatics.floating import rising
    >>> rising([4, 5, 6.5], "draughts", "in a table").tolist()
    [4.0, 5.0, 6.5]
    """
    found = np.atleast_1d(numbers(values, name, where))
    if not len(found):
        raise BadInputError(f"{name} is empty", where, "give one number or more")
    step = np.diff(found)
    if (step <= 0.0).any():
        k = int(np.argmax(step <= 0.0))
        pair = f"{found[k + 1]:g} stands after {found[k]:g}"
        raise BadInputError(
            f"{name} does not rise: {pair}", where, "give rising numbers, each once"
        )
    return found
