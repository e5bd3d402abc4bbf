"""Checks of what is asked of stability."""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np

from assoc_hull.analysis.hydrostatics.floating import rising
from assoc_hull.analysis.hydrostatics.floating_body import FloatingBody
from assoc_hull.arguments import choice
from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersed import Planes

__all__ = ["HEELS", "OnError", "checked_on_error", "heels_of", "require_sound"]

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
    found = rising(heels, "heels", _WHERE)
    far = found[np.abs(found) > 90.0]
    if len(far):
        why = "turns the ship over"
        raise OutOfRangeError("a heel", float(far[0]), _WHERE, why, -90.0, 90.0, "deg")
    return found


def checked_on_error(on_error: object) -> None:
    """Refuse what is no way to deal with doubts, before anything is computed."""
    choice(on_error, "on_error", get_args(OnError), _WHERE)


def require_sound(body: FloatingBody, planes: Planes, on_error: str) -> tuple[str, ...]:
    """Give the doubts about a hull.

    Raises
    ------
    BadInputError
        There are some, and they are to be refused.
    """
    checked_on_error(on_error)
    doubts = tuple(body.doubts(planes, numbers=False))
    if doubts and on_error == "refuse":
        more = f" (and {len(doubts) - 1} more)" if len(doubts) > 1 else ""
        remedy = "mend the hull, or take the numbers with on_error='report'"
        raise BadInputError(doubts[0] + more, _WHERE, remedy)
    return doubts
