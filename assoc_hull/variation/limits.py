"""Between which values a named parameter may be asked for."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import attrs
import numpy as np

from assoc_hull.errors import BadInputError, FoldError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.state import HullState
from assoc_hull.variation.admissible import admissible
from assoc_hull.variation.anchor import Measures
from assoc_hull.variation.bounds import bounds
from assoc_hull.variation.catalogue import CATALOGUE
from assoc_hull.variation.certificate import Certificate
from assoc_hull.variation.certify import certify
from assoc_hull.variation.compose import compose, refuse_clashes
from assoc_hull.variation.layout import Layout
from assoc_hull.variation.parent import Parent
from assoc_hull.variation.vmap import VMap

__all__ = ["Room", "hull_box", "interval", "present"]

_STEP = 0.02
"""A usual change of a parameter, as a part of its value, and the least one, m or degrees."""

_NEAR = 1e-6
"""m or degrees: an end so near to a bound is the bound."""


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
    parent: Parent, name: str, now: float, layout: Layout, box: FloatArray
) -> tuple[float, float]:
    """Give the least and greatest value that a parameter may have, asked for alone.

    Parameters
    ----------
    parent : Parent
    name : str
        Of the parameter.
    now : float
        Its present value, m or degrees.
    layout : Layout
    box : (2, 3), m
        Of the hull.

    Raises
    ------
    BadInputError
        The parent has not what the parameter is laid out on.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.layout import Layout
    >>> from assoc_hull.variation.limits import interval
    >>> from assoc_hull.variation.parent import Parent
    >>> ship = Parent(300, 50, 27, 18, 27, {})
    >>> box = np.array([[-5.0, -25.0, 0.0], [306.0, 25.0, 27.0]])
    >>> low, high = interval(ship, "draught", 18.0, Layout(), box)
    >>> round(low, 2), round(high, 2)
    (0.9, 39.99)
    """
    laid = _alone(parent, name, layout)
    laid(now)
    step, rule = max(_STEP * abs(now), _STEP), bounds(name, parent, now, layout)
    low, high = admissible(laid, box, present=now, first=step)
    # an end that a bound sets was found only nearly
    low = rule.low if low <= rule.low + _NEAR else low
    return low, rule.high if high >= rule.high - _NEAR else high


def _alone(parent: Parent, name: str, layout: Layout) -> Callable[[float], VMap]:
    """Give what lays out the map of one parameter."""
    return lambda value: compose(parent, {name: value}, layout)


@attrs.frozen(eq=False)
class Room:
    """What named parameters of a hull may be asked for.

    Attributes
    ----------
    parent : Parent
    present : mapping of str to float
        Values now, of those that are asked for.
    layout : Layout
    box : (2, 3), m
        Of the hull.
    """

    parent: Parent
    present: Mapping[str, float]
    layout: Layout
    box: FloatArray
    _found: dict[str, tuple[float, float]] = attrs.field(factory=dict, init=False, repr=False)

    def interval(self, name: str) -> tuple[float, float]:
        """Give the least and greatest value of a parameter, asked for alone; sought once."""
        if name not in self._found:
            now = self.present[name]
            self._found[name] = interval(self.parent, name, now, self.layout, self.box)
        return self._found[name]

    def check(self, asked: Mapping[str, float]) -> None:
        """Refuse values that make no hull, or contradict each other.

        Raises
        ------
        OutOfRangeError
            With the interval, and what becomes of the hull beyond.
        BadInputError
            Two parameters that are one number.
        """
        refuse_clashes(asked, self.layout)
        parent = attrs.evolve(self.parent, breadth=asked.get("breadth", self.parent.breadth))
        for name, value in asked.items():
            rule = bounds(name, parent, self.present[name], self.layout)
            if not rule.hold(value):
                raise self._outside(name, value, rule.why)

    def map(self, asked: Mapping[str, float]) -> VMap:
        """Lay out a map, or tell which value cannot be laid out.

        Raises
        ------
        OutOfRangeError
            One of the values cannot be laid out even alone; with the interval.
        BadInputError
            As `compose`.
        """
        try:
            return compose(self.parent, asked, self.layout)
        except BadInputError as error:
            for name, value in asked.items():
                if self._refused(name, value) and not self._refused(name, self.present[name]):
                    raise self._outside(name, value, f"cannot be laid out ({error.what})") from None
            raise

    def certified(self, vmap: VMap, asked: Mapping[str, float]) -> Certificate:
        """Certify a map, or refuse it with the room that the parameter at fault has.

        Raises
        ------
        FoldError
            It folds, or nearly; where, by how much, and what would do.
        """
        found = certify(vmap, self.box)
        try:
            found.check()
        except FoldError as error:
            raise self._told(error, asked) from None
        return found

    def _told(self, error: FoldError, asked: Mapping[str, float]) -> FoldError:
        """Add to a fold between which values the parameter at fault may be asked for."""
        name = error.field or error.layer
        if name not in asked:
            return error
        low, high = self.interval(name)
        alone = low <= asked[name] <= high
        return attrs.evolve(
            error, interval=(low, high), unit=CATALOGUE[name].unit,
            part=self._part(asked) if alone and len(asked) > 1 else None,
        )  # fmt: skip

    def _part(self, asked: Mapping[str, float]) -> float:
        """Give how much of all changes is certified."""

        def laid(part: float) -> VMap:
            values = {
                name: self.present[name] + part * (value - self.present[name])
                for name, value in asked.items()
            }
            return compose(self.parent, values, self.layout)

        return admissible(laid, self.box, first=_STEP)[1]

    def _refused(self, name: str, value: float) -> bool:
        try:
            _alone(self.parent, name, self.layout)(value)
        except BadInputError:
            return True
        return False

    def _outside(self, name: str, value: float, why: str) -> OutOfRangeError:
        low, high = self.interval(name)
        return OutOfRangeError(name, value, "in vary", why, low, high, CATALOGUE[name].unit)
