"""Between which values a named parameter may be asked for.

Bounds follow from what makes a hull at all (a map may be one to one and yet make a transom broader
than the ship) and from how far fields reach. The interval of a parameter goes from its present
value (m or degrees) as far as the map is certified, or to a bound. The box of a hull, in which
maps are certified, is given here as well.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.tables import HullState
from assoc_hull.variation.certificate.fold_check import MARGIN, admissible_amplitudes
from assoc_hull.variation.fields.space_map import VariationMap
from assoc_hull.variation.parameters.catalogue import CATALOGUE
from assoc_hull.variation.parameters.compose_map import STEEPEST
from assoc_hull.variation.parameters.field_layout import Layout
from assoc_hull.variation.parameters.measurement import Measures
from assoc_hull.variation.parameters.midship_measures import SHORTEST_BODY
from assoc_hull.variation.parameters.paper_regions import regions_of
from assoc_hull.variation.parameters.parent import Parent

__all__ = [
    "ValueBounds",
    "admissible_interval",
    "fair_end",
    "hull_box",
    "present_values",
    "value_bounds",
]

_ROUNDING = 1e-9
"""A value beyond a bound by no more (m, degrees) counts as the bound."""

_SPARE = 1.0 - MARGIN
"""A stretch is bounded as a squeeze is, by what the margin of minors leaves."""

_BROADEST = 0.999
"""A transom as broad as this part of the ship is its broadest: widening it widens the ship."""


@attrs.frozen
class ValueBounds:
    """Between which values a parameter has a meaning.

    Attributes
    ----------
    low, high : float
        m or degrees; infinite where nothing bounds it.
    why : str
        What becomes of the hull beyond.
    """

    low: float = -math.inf
    high: float = math.inf
    why: str = ""

    def hold(self, value: float) -> bool:
        """Tell whether a value lies between them."""
        return self.low - _ROUNDING <= value <= self.high + _ROUNDING


def value_bounds(name: str, parent: Parent, present: float, layout: Layout) -> ValueBounds:
    """Give the bounds of a named parameter.

    Parameters
    ----------
    name : str
    parent : Parent
    present : float
        Its value now, m or degrees.
    layout : Layout

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.parameters.value_limits import value_bounds
    >>> from assoc_hull.variation.parameters.field_layout import Layout
    >>> from assoc_hull.variation.parameters.parent import Parent
    >>> ship = Parent(300, 50, 27, 18, 27, {})
    >>> value_bounds("transom_half_breadth", ship, 12.0, Layout())
    ValueBounds(low=0.0, high=25.0, why='makes the transom broader than the ship')
    """
    rule = _RULES.get(name)
    if rule is not None:
        return rule(parent, present, layout)
    if name.endswith("_deg"):
        return ValueBounds(-STEEPEST, STEEPEST, "is too steep")
    return ValueBounds(0.0) if CATALOGUE[name].positive else ValueBounds()


def _transom_half_breadth(parent: Parent, present: float, layout: Layout) -> ValueBounds:
    """Keep the transom no broader than the ship, unless it is her broadest part."""
    half = 0.5 * parent.breadth
    high = half if present < _BROADEST * half else math.inf
    return ValueBounds(0.0, high, "makes the transom broader than the ship")


def _flat_of_bottom(parent: Parent, present: float, layout: Layout) -> ValueBounds:
    """Keep the edge of the flat within the half-breadth."""
    return ValueBounds(0.0, 0.5 * parent.breadth, "leaves no bilge")


def _bulb_length(parent: Parent, present: float, layout: Layout) -> ValueBounds:
    """Stretch the bow as much as it may be compressed: beyond, frames cross the stem twice."""
    regions = regions_of(parent, layout)
    room = (1.0 - layout.bow_from) * parent.length
    if regions is not None:
        room = regions.lengths["EX0"] - regions.lengths["EX1"]
    most = _SPARE * room / layout.curve.steepest
    why = "stretches the bow nearly twofold, or folds it"
    return ValueBounds(max(0.0, present - most), present + most, why)


def _deadrise_deg(parent: Parent, present: float, layout: Layout) -> ValueBounds:
    """Let the bottom fall no more than it may rise."""
    low = float(parent.places["bilge high"][2]) if parent.has("bilge high") else 0.0
    tall = _SPARE * (layout.deadrise_top * parent.draught - low) / layout.curve.steepest
    slope, half = math.tan(math.radians(present)), 0.5 * parent.breadth
    least, most = (math.degrees(math.atan(slope + sign * tall / half)) for sign in (-1.0, 1.0))
    return ValueBounds(least, most, "turns the bottom too far for the side to take it up")


_SHORT = f"leaves a parallel body of less than {100.0 * SHORTEST_BODY:g} % of Lpp, which is none"


def _parallel_body_start(parent: Parent, present: float, layout: Layout) -> ValueBounds:
    """Leave a parallel body that is long enough to be measured."""
    room = SHORTEST_BODY * parent.length
    high = float(parent.places["body end"][0]) - room if parent.has("body end") else math.inf
    return ValueBounds(0.0, high, _SHORT)


def _parallel_body_end(parent: Parent, present: float, layout: Layout) -> ValueBounds:
    """Leave a parallel body that is long enough to be measured."""
    room = SHORTEST_BODY * parent.length
    low = float(parent.places["body start"][0]) + room if parent.has("body start") else 0.0
    return ValueBounds(low, math.inf, _SHORT)


def _parallel_body_length(parent: Parent, present: float, layout: Layout) -> ValueBounds:
    """Leave a parallel body that is long enough to be measured."""
    return ValueBounds(SHORTEST_BODY * parent.length, math.inf, _SHORT)


_RULES: Mapping[str, Callable[[Parent, float, Layout], ValueBounds]] = {
    "transom_half_breadth": _transom_half_breadth, "flat_of_bottom": _flat_of_bottom,
    "bulb_length": _bulb_length, "deadrise_deg": _deadrise_deg,
    "parallel_body_start": _parallel_body_start, "parallel_body_end": _parallel_body_end,
    "parallel_body_length": _parallel_body_length,
}  # fmt: skip


# --------------------------------------------------------------------------------------
# Intervals: as far as maps are certified, or to a bound.

_STEP = 0.02
"""First step of the search, as a part of the value, and the least one, m or degrees."""

_NEAR = 1e-6
"""m or degrees: an end as near as this to a bound is the bound."""

_LARGEST = 1e6
"""m: no ship is larger, and nothing can be asked that is."""


def hull_box(state: HullState, tolerance: float) -> FloatArray:
    """Give the box of a hull, both sides, grown by a tolerance: (2, 3), m."""
    xyz = state.rows.xyz[state.live("rows")]
    low, high = xyz.min(axis=0) - tolerance, xyz.max(axis=0) + tolerance
    low[1] = -high[1]
    return np.array([low, high])


def present_values(measures: Measures, layout: Layout) -> dict[str, float]:
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


def admissible_interval(
    laid: Callable[[float], VariationMap], now: float, rule: ValueBounds, box: FloatArray
) -> tuple[float, float]:
    """Give the least and greatest value that a parameter may have.

    Parameters
    ----------
    laid : callable
        Gives the map of a value, m or degrees.
    now : float
        The present value.
    rule : ValueBounds
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
    >>> from assoc_hull.variation.parameters.value_limits import ValueBounds
    >>> from assoc_hull.variation.parameters.compose_map import compose_map
    >>> from assoc_hull.variation.parameters.field_layout import Layout
    >>> from assoc_hull.variation.parameters.value_limits import admissible_interval
    >>> from assoc_hull.variation.parameters.parent import Parent
    >>> ship = Parent(300, 50, 27, 18, 27, {})
    >>> box = np.array([[-5.0, -25.0, 0.0], [306.0, 25.0, 27.0]])
    >>> def laid(value):
    ...     return compose_map(ship, {"draught": value}, Layout())
    >>> low, high = admissible_interval(laid, 18.0, ValueBounds(), box)
    >>> round(low, 2), round(high, 2)
    (0.9, 39.99)
    """
    laid(now)
    low, high = admissible_amplitudes(laid, box, present=now, first=max(_STEP * abs(now), _STEP))
    low, high = (
        each if abs(each) < _LARGEST else math.copysign(math.inf, each) for each in (low, high)
    )
    # an end that a bound sets was found only nearly
    low = rule.low if low <= rule.low + _NEAR else low
    return low, rule.high if high >= rule.high - _NEAR else high


# --------------------------------------------------------------------------------------
# Fair ends: as far as no line gets bends.

_SHARPEST = math.log(4.0)
"""Logarithm of how much sharper a comb may become: a line drawn through its own points is up to
two and a half times as sharp as its image, and above ten times it has a kink."""

_FIRST = 0.1
"""First step, as a part of the value, towards an end that nothing sets; and the least one."""

_WIDER = 2.0
_TRIALS = 6


def fair_end(sharper: Callable[[float], float], now: float, end: float) -> float:
    """Give the last value towards an end at which lines are about as fair as they are.

    Parameters
    ----------
    sharper : callable
        Gives the logarithm of how much sharper the sharpest comb becomes at a value.
    now, end : float
        The present value, and that beyond which there is none, m or degrees; it may be infinite.

    Examples
    --------
    >>> import math
    >>> from assoc_hull.variation.parameters.value_limits import fair_end
    >>> round(fair_end(lambda value: 2.0 * math.log(value), 1.0, math.inf), 2)
    1.93
    """
    if math.isfinite(end) and sharper(end) <= _SHARPEST:
        return end
    step = max(_FIRST * abs(now), _FIRST)
    way = math.copysign(1.0, end - now)
    held, known, failed, over = now, 0.0, now, 0.0
    while over <= _SHARPEST:
        if failed == end or abs(failed) > _LARGEST:
            return end
        held, known = failed, over
        failed += way * min(step, abs(end - failed))
        over, step = sharper(failed), _WIDER * step
    for trial in range(_TRIALS):
        part = (_SHARPEST - known) / (over - known) if math.isfinite(over) and trial % 2 else 0.5
        tried = held + part * (failed - held)
        value = sharper(tried)
        if value <= _SHARPEST:
            held, known = tried, value
        else:
            failed, over = tried, value
    return held
