"""What a ship by boundary data is made of besides its lines: midship section, deck, appendages."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import instance
from assoc_hull.creation.classical.midship import Midship
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.appendage import Appendage
from assoc_hull.geometry.classical.camber import KINDS
from assoc_hull.geometry.classical.checks import finite
from assoc_hull.geometry.classical.choices import one_of
from assoc_hull.geometry.classical.knuckle_codes import KnuckleLine
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["WHERE", "Attached", "DeckCamber", "Knuckle", "Parallel", "is_a"]

WHERE = "in a ship by boundary data"
"""What errors of type say of the place."""


def is_a(kind: type) -> Callable[[object, attrs.Attribute[Any], object], None]:
    """Give a validator: the value of a field is of this class."""

    def look(_: object, field: attrs.Attribute[Any], value: object) -> None:
        instance(value, kind, field.name, WHERE)

    return look


def _place(given: object) -> float:
    return float(finite(given, "midship", ()))  # type: ignore[arg-type]


@attrs.frozen
class Knuckle:
    """A knuckle line: its name, and half-breadths and heights over x."""

    name: str = attrs.field(validator=is_a(str))
    line: KnuckleLine = attrs.field(validator=is_a(KnuckleLine))


@attrs.frozen
class Parallel:
    """A midship section, and from where to where (m) the ship has it."""

    section: Midship = attrs.field(validator=is_a(Midship))
    first: float = attrs.field(converter=_place)
    last: float = attrs.field(converter=_place)


@attrs.frozen
class Attached:
    """An appendage: its name, and whether it is drawn on one side and stands on both."""

    name: str = attrs.field(validator=is_a(str))
    body: Appendage = attrs.field(validator=is_a(Appendage))
    both: bool = attrs.field(default=True, validator=is_a(bool))

    @property
    def volume(self) -> float:
        """With its sign, of both sides, m3."""
        return (2.0 if self.both else 1.0) * self.body.volume


def _rows(given: ArrayLike) -> FloatArray:
    return finite(given, "deck", (None, 2))


@attrs.frozen(eq=False)
class DeckCamber:
    """Camber and rounded corners of the deck, in straight lines between given places.

    Attributes
    ----------
    rise : (n, 2), m
        Rows (x, c), c from the side to the centre line; empty for a deck straight across.
    kind : {"line", "parabola"}
        Of the camber.
    corner : (k, 2), m
        Rows (x, r), radii of the corner; empty for none. Beyond its ends there is none.
    """

    rise: FloatArray = attrs.field(factory=lambda: np.zeros((0, 2)), converter=_rows)
    kind: str = "parabola"
    corner: FloatArray = attrs.field(factory=lambda: np.zeros((0, 2)), converter=_rows)

    def __attrs_post_init__(self) -> None:
        freeze(self.rise, self.corner)
        one_of(self.kind, KINDS, "camber: kind")
        for rows, name in ((self.rise, "camber"), (self.corner, "corner radius")):
            if (np.diff(rows[:, 0]) <= 0.0).any():
                row = int(np.argmax(np.diff(rows[:, 0]) <= 0.0)) + 1
                what = f"{name}: x not strictly increasing at row {row}"
                raise GeometryError(what, "put the rows in order from aft", {"row": row})

    def at(self, x: float) -> tuple[float | None, float]:
        """Give rise (m; None without camber) and corner radius (m) at x (m)."""
        rise = float(np.interp(x, *self.rise.T)) if len(self.rise) else None
        if not len(self.corner) or not self.corner[0, 0] <= x <= self.corner[-1, 0]:
            return rise, 0.0
        return rise, float(np.interp(x, *self.corner.T))
