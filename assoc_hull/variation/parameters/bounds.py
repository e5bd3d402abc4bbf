"""Bounds of named parameters that follow from the hull and from how far fields reach.

A map may be one to one and yet make no hull: a transom broader than the ship, or a bulb that is
drawn out so far that the stem above it overhangs.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import attrs

from assoc_hull.variation.certificate.certify import MARGIN
from assoc_hull.variation.parameters.catalogue import CATALOGUE
from assoc_hull.variation.parameters.compose_map import STEEPEST
from assoc_hull.variation.parameters.layout import Layout
from assoc_hull.variation.parameters.parent_places import Parent

__all__ = ["Bounds", "bounds"]

_ROUNDING = 1e-9
"""What lies beyond a bound by no more (m, degrees) was asked for at the bound."""

_SPARE = 1.0 - MARGIN
"""What is left of a stretch, as of a squeeze, for the margin of minors."""

_BROADEST = 0.999
"""A transom of so much of the breadth is the broadest part itself: widening it widens the ship."""


@attrs.frozen
class Bounds:
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


def bounds(name: str, parent: Parent, present: float, layout: Layout) -> Bounds:
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
    >>> from assoc_hull.variation.parameters.bounds import bounds
    >>> from assoc_hull.variation.parameters.layout import Layout
    >>> from assoc_hull.variation.parameters.parent_places import Parent
    >>> ship = Parent(300, 50, 27, 18, 27, {})
    >>> bounds("transom_half_breadth", ship, 12.0, Layout())
    Bounds(low=0.0, high=25.0, why='makes the transom broader than the ship')
    """
    rule = _RULES.get(name)
    if rule is not None:
        return rule(parent, present, layout)
    if name.endswith("_deg"):
        return Bounds(-STEEPEST, STEEPEST, "is too steep")
    return Bounds(0.0) if CATALOGUE[name].positive else Bounds()


def _transom_half_breadth(parent: Parent, present: float, layout: Layout) -> Bounds:
    half = 0.5 * parent.breadth
    high = half if present < _BROADEST * half else math.inf
    return Bounds(0.0, high, "makes the transom broader than the ship")


def _flat_of_bottom(parent: Parent, present: float, layout: Layout) -> Bounds:
    return Bounds(0.0, 0.5 * parent.breadth, "leaves no bilge")


def _bulb_length(parent: Parent, present: float, layout: Layout) -> Bounds:
    """Stretch the bow as much as it may be compressed: beyond, frames cross the stem twice."""
    most = _SPARE * (1.0 - layout.bow_from) * parent.length / layout.curve.steepest
    why = "stretches the bow nearly twofold, or folds it"
    return Bounds(max(0.0, present - most), present + most, why)


def _deadrise_deg(parent: Parent, present: float, layout: Layout) -> Bounds:
    """Let the bottom fall no more than it may rise."""
    low = float(parent.places["bilge high"][2]) if parent.has("bilge high") else 0.0
    tall = _SPARE * (layout.deadrise_top * parent.draught - low) / layout.curve.steepest
    slope, half = math.tan(math.radians(present)), 0.5 * parent.breadth
    least, most = (math.degrees(math.atan(slope + sign * tall / half)) for sign in (-1.0, 1.0))
    return Bounds(least, most, "turns the bottom too far for the side to take it up")


_RULES: Mapping[str, Callable[[Parent, float, Layout], Bounds]] = {
    "transom_half_breadth": _transom_half_breadth, "flat_of_bottom": _flat_of_bottom,
    "bulb_length": _bulb_length, "deadrise_deg": _deadrise_deg,
}  # fmt: skip
