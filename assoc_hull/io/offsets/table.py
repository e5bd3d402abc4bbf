"""A table of offsets in ship axes.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.offsets.table import OffsetTable
>>> x, z, y = np.array([0.0, 9.0]), np.array([0.0, 1.0]), np.array([[0.0, 1.0], [2.0, 2.0]])
>>> none = np.empty(0)
>>> table = OffsetTable(
...     "box", x, z, y, None, None, None, none, None, 9.0, 4.0, 1.0, None, np.full(2, 5e-4))
>>> table.half_breadth.flags.writeable
False
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.tolerance import at_full_length

__all__ = ["OffsetTable", "half_section_areas"]


@attrs.frozen(eq=False)
class OffsetTable:
    """Offsets in ship axes; all arrays are frozen.

    Attributes
    ----------
    name : str
        Name of the ship or file.
    x : (s,), m
        Stations, from the aft perpendicular, forward positive, ascending.
    z : (w,), m
        Waterlines above the base line, ascending.
    half_breadth : (s, w), m
        nan where the table is blank: below the local keel or above the deck.
    keel : (s,) or None, m
        Local height of the keel.
    deck_height, deck_half_breadth : (s,) or None, m
        Deck edge; nan where blank.
    buttock_y : (b,), m
        Buttocks, ascending; empty when there are none.
    buttock_height : (s, b) or None, m
        Heights of the buttocks; nan where blank.
    length, breadth : float, m
        Between perpendiculars; moulded.
    draught, depth : float or None, m
        Design draught; height of the deck amidships.
    rounding : (w,), m
        Half unit of the last printed digit of each waterline, at full scale.
    station : (s,) or None
        The station numbers as printed; nan where the name is no number.
    level : (w,) or None
        The waterlines as printed, where these are parts of the draught or numbers; None: heights.
    stated : mapping of str to float
        What the file says of the hull as a whole: "Lpp", "B", "T", "D" (m), "L/B", "B/T", "CB",
        "CM", "CP", "CW"; those that it says.
    closing : float or None
        Overhang of the waterline at the draught abaft the AP, as a part of the length, where a
        stern is drawn beyond the last station; None: that of Series 60.
    """

    name: str
    x: FloatArray
    z: FloatArray
    half_breadth: FloatArray
    keel: FloatArray | None
    deck_height: FloatArray | None
    deck_half_breadth: FloatArray | None
    buttock_y: FloatArray
    buttock_height: FloatArray | None
    length: float
    breadth: float
    draught: float | None
    depth: float | None
    rounding: FloatArray
    station: FloatArray | None = None
    level: FloatArray | None = None
    stated: Mapping[str, float] = attrs.field(factory=dict)
    closing: float | None = None

    def at_full_length(self, factor: float) -> OffsetTable:
        """Give the table of a hull with a factor of lengths as that of the hull of 100 m."""
        return self._with_lengths(lambda each: at_full_length(each, factor))

    def scaled(self, factor: float) -> OffsetTable:
        """Give the table with every length times a factor."""
        return self._with_lengths(lambda each: np.asarray(each) * factor)

    def _with_lengths(self, change: Callable[[Any], FloatArray]) -> OffsetTable:
        lengths = (
            "x", "z", "half_breadth", "keel", "deck_height", "deck_half_breadth", "buttock_y",
            "buttock_height", "length", "breadth", "draught", "depth", "rounding",
        )  # fmt: skip
        known = {name: getattr(self, name) for name in lengths}
        grown: dict[str, Any] = {
            name: change(each) for name, each in known.items() if each is not None
        }
        numbers = {name: float(each) for name, each in grown.items() if not each.ndim}
        return attrs.evolve(self, **(grown | numbers))

    def __attrs_post_init__(self) -> None:
        arrays = (self.x, self.z, self.half_breadth, self.buttock_y, self.rounding)
        maybe = (self.keel, self.deck_height, self.deck_half_breadth, self.buttock_height)
        freeze(*arrays, *(a for a in (*maybe, self.station, self.level) if a is not None))


def half_section_areas(
    half_breadth: FloatArray, z: FloatArray, top: float | None = None
) -> FloatArray:
    """Give the areas of half sections up to a height, (s,), m2, by trapezoids.

    Of half-breadths (s, w), m, at heights z (w,), m, ascending; blanks count 0.
    """
    y = np.nan_to_num(half_breadth)
    if top is None or top >= z[-1]:
        return np.asarray(np.trapezoid(y, z, axis=1))
    below = z < top
    at_top = np.array([np.interp(top, z, row) for row in y])
    return np.asarray(
        np.trapezoid(np.column_stack([y[:, below], at_top]), np.append(z[below], top), axis=1)
    )
