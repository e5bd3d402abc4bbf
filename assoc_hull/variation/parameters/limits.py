"""Between which values a named parameter may be asked for."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.state import HullState
from assoc_hull.variation.certificate.admissible_amplitudes import admissible
from assoc_hull.variation.fields.space_map import VMap
from assoc_hull.variation.parameters.anchor import Measures
from assoc_hull.variation.parameters.bounds import Bounds
from assoc_hull.variation.parameters.layout import Layout

__all__ = ["hull_box", "interval", "present"]

_STEP = 0.02
"""A usual change of a parameter, as a part of its value, and the least one, m or degrees."""

_NEAR = 1e-6
"""m or degrees: an end so near to a bound is the bound."""


_LARGEST = 1e6
"""m: no ship is larger, and nothing can be asked that is."""


def hull_box(state: HullState, tolerance: float) -> FloatArray:
    """Give the box of a hull, both sides, grown by a tolerance: (2, 3), m."""
    xyz = state.rows.xyz.data[state.live("rows")]
    low, high = xyz.min(axis=0) - tolerance, xyz.max(axis=0) + tolerance
    low[1] = -high[1]
    return np.array([low, high])


def present(measures: Measures, layout: Layout) -> dict[str, float]:
    """Give measured values by name; the deck's height is taken where the layout sets it."""
    found = dict(measures)
    place = {"fore": "at_FP", "aft": "at_AP"}.get(layout.deck)
    if place is not None and "deck_height" in found:
        there = measures.anchors["deck_height"].numbers.get(place)
        if there is None:
            found.pop("deck_height")
        else:
            found["deck_height"] = there
    return found


def interval(
    laid: Callable[[float], VMap], now: float, rule: Bounds, box: FloatArray
) -> tuple[float, float]:
    """Give the least and greatest value that a parameter may have.

    Parameters
    ----------
    laid : callable
        Gives the map of a value, m or degrees.
    now : float
        The present value.
    rule : Bounds
        What bounds it besides folds.
    box : (2, 3), m
        Of the hull.

    Raises
    ------
    BadInputError
        The parent has not what the parameter is laid out on.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.parameters.bounds import Bounds
    >>> from assoc_hull.variation.parameters.compose_map import compose
    >>> from assoc_hull.variation.parameters.layout import Layout
    >>> from assoc_hull.variation.parameters.limits import interval
    >>> from assoc_hull.variation.parameters.parent_places import Parent
    >>> ship = Parent(300, 50, 27, 18, 27, {})
    >>> box = np.array([[-5.0, -25.0, 0.0], [306.0, 25.0, 27.0]])
    >>> def laid(value):
    ...     return compose(ship, {"draught": value}, Layout())
    >>> low, high = interval(laid, 18.0, Bounds(), box)
    >>> round(low, 2), round(high, 2)
    (0.9, 39.99)
    """
    laid(now)
    low, high = admissible(laid, box, present=now, first=max(_STEP * abs(now), _STEP))
    low, high = (
        each if abs(each) < _LARGEST else math.copysign(math.inf, each) for each in (low, high)
    )
    # an end that a bound sets was found only nearly
    low = rule.low if low <= rule.low + _NEAR else low
    return low, rule.high if high >= rule.high - _NEAR else high
