"""What sections move by along the ship: a given part, and two shapes with free sizes.

    delta = g + c_f e_f + c_a e_a

g is known: it moves the ends of the parallel body. e_f acts between the fore end of the parallel
body and the fore terminal, e_a between the after terminal and the after end; both are exactly
nil elsewhere, so that what lies beyond the terminals stays to the last bit.
"""

from __future__ import annotations

from typing import Any, Literal

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import numbers
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.bounded_functions import BlendChain, BoundedFunction
from assoc_hull.variation.fields.field import AffinePiece, StackedField, level_boundaries
from assoc_hull.variation.fields.field_data import course_data
from assoc_hull.variation.fields.layers import FieldLayer
from assoc_hull.variation.fields.shift_shapes import Bump, BumpShape, Polyline

__all__ = ["SHIFT_SHAPES", "Fade", "ShiftShape", "ShiftTerms", "Terminals"]

ShiftShape = BumpShape | Literal["1-cp"]

SHIFT_SHAPES: tuple[ShiftShape, ...] = ("c1", "c2", "end", "half", "lackenby", "1-cp")

Fade = Literal["b5", "linear"]
"""How the movement of an end of the parallel body fades out to its terminal."""

_WHERE = "in shift_sections"


@attrs.frozen
class Terminals:
    """Between which places sections move.

    Attributes
    ----------
    aft, fore : float, m from AP
        Nothing moves abaft the one and forward of the other.
    start, end : float, m from AP
        After and fore end of the parallel body, or of what stands for it.
    """

    aft: float
    start: float
    end: float
    fore: float

    @classmethod
    def of(cls, given: ArrayLike) -> Terminals:
        """Take four places as a designer gives them.

        Raises
        ------
        BadInputError
            Not four numbers; or they do not rise (`start` and `end` may be one place).
        """
        four = numbers(given, "terminals", _WHERE)
        if four.shape != (4,):
            raise BadInputError(
                f"terminals are {four.size} numbers", _WHERE,
                "give after terminal, start and end of the parallel body, fore terminal, m from AP",
            )  # fmt: skip
        aft, start, end, fore = four.tolist()
        if not (aft < start <= end < fore):
            raise BadInputError(
                f"terminals {aft:g}, {start:g}, {end:g}, {fore:g} m do not rise", _WHERE,
                "give them from aft, each forward of the one before",
            )  # fmt: skip
        return cls(aft, start, end, fore)

    @property
    def places(self) -> FloatArray:
        """All four, (4,), m."""
        return np.array([self.aft, self.start, self.end, self.fore])


@attrs.frozen(eq=False)
class ShiftTerms:
    """The parts of a shift: g, e_f and e_a.

    Attributes
    ----------
    terminals : Terminals
    shape : str
        Of e_f and e_a: one of `assoc_hull.variation.fields.shift_shapes.BUMP_SHAPES`, or
        ``"1-cp"``, a straight line
        from the parallel body to the terminal, which moves the ends of the parallel body along.
    start, end : float, m
        By how much g moves the ends of the parallel body.
    fade : {"b5", "linear"}
        How g fades out to the terminals; between the ends it goes over by the quintic blend.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.shifts.shift_terms import ShiftTerms, Terminals
    >>> terms = ShiftTerms(Terminals(0.0, 40.0, 60.0, 100.0))
    >>> terms.fore.at(np.array([50.0, 80.0, 100.0])).tolist()
    [0.0, 1.0, 0.0]
    """

    terminals: Terminals
    shape: ShiftShape = "c2"
    start: float = 0.0
    end: float = 0.0
    fade: Fade = "b5"

    def __attrs_post_init__(self) -> None:
        if self.shape == "1-cp" and self.terminals.start == self.terminals.end:
            raise BadInputError(
                "shape '1-cp' pushes both bodies from one place", _WHERE,
                "give two places for the ends of the parallel body, or another shape",
            )  # fmt: skip

    @property
    def fore(self) -> BoundedFunction:
        """e_f: largest value 1, but for ``lackenby``."""
        at = self.terminals
        if self.shape == "1-cp":
            return Polyline(np.array([at.start, at.end, at.fore]), np.array([0.0, 1.0, 0.0]))
        return Bump(at.end, at.fore, 1.0, self.shape)

    @property
    def aft(self) -> BoundedFunction:
        """e_a: likewise."""
        at = self.terminals
        if self.shape == "1-cp":
            return Polyline(np.array([at.aft, at.start, at.end]), np.array([0.0, 1.0, 0.0]))
        return Bump(at.start, at.aft, 1.0, self.shape)

    @property
    def given(self) -> BoundedFunction:
        """g, m."""
        places, moves = self._ends()
        if self.fade == "linear":
            return Polyline(places, moves)
        return BlendChain(places, moves)

    def _ends(self) -> tuple[FloatArray, FloatArray]:
        """Give the nodes of g and its values; one where both ends are one place."""
        places, moves = self.terminals.places, np.array([0.0, self.start, self.end, 0.0])
        if self.terminals.start < self.terminals.end:
            return places, moves
        if self.start != self.end:
            raise BadInputError(
                "both ends of the parallel body are one place, and are to move apart", _WHERE,
                "give two places for them as terminals",
            )  # fmt: skip
        return np.delete(places, 1), np.delete(moves, 1)

    @property
    def courses(self) -> tuple[BoundedFunction, BoundedFunction, BoundedFunction]:
        """g, e_f and e_a."""
        return self.given, self.fore, self.aft

    @property
    def nodes(self) -> FloatArray:
        """Where their polynomials join, rising."""
        return np.unique(np.concatenate([each.nodes for each in self.courses]))

    @property
    def tops(self) -> FloatArray:
        """Where e_f and e_a are fullest, (2,), m."""
        fore, aft = self.fore, self.aft
        if isinstance(fore, Bump) and isinstance(aft, Bump):
            return np.array([fore.top, aft.top])
        return np.array([self.terminals.end, self.terminals.start])

    def sized(self, fore: float, aft: float) -> tuple[BoundedFunction, ...]:
        """Give the parts of delta that act, for sizes c_f and c_a (m)."""
        parts = list[BoundedFunction]()
        if self.start != 0.0 or self.end != 0.0:
            parts.append(self.given)
        for course, size in ((self.fore, fore), (self.aft, aft)):
            if size != 0.0:
                parts.append(course.scaled(size))
        return tuple(parts)

    def layer(self, fore: float, aft: float, name: str = "section shifts") -> FieldLayer:
        """Give delta as a layer of x-fields, for sizes c_f and c_a (m)."""
        none, base = BlendChain.constant(0.0), level_boundaries(["base"], [0.0])
        return FieldLayer(
            name,
            tuple(
                StackedField(name, "x", base, (AffinePiece(none, 0.0, part),))
                for part in self.sized(fore, aft)
            ),
        )

    def data(self, fore: float, aft: float, name: str = "section shifts") -> list[dict[str, Any]]:
        """Give the same as data, in the form of `assoc_hull.variation.fields.field_data`."""
        return [
            {"stack": {"name": name, "axis": "x", "boundaries": [["base", 0.0]],
                       "pieces": [{"d": course_data(part)}]}}
            for part in self.sized(fore, aft)
        ]  # fmt: skip
