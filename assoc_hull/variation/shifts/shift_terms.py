"""What a shift of sections is asked for, and what sections move by along the ship.

    delta = g + c_f e_f + c_a e_a

g is known: it moves the ends of the parallel body. e_f acts between the fore end of the parallel
body and the fore terminal, e_a between the after terminal and the after end; both are exactly
nil elsewhere, so that what lies beyond the terminals stays to the last bit.

What a shift of sections is asked for, checked and frozen.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Literal

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import (
    choice,
    number,
    numbers,
    positive,
    shown_name,
    text,
)
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.bounded_functions import BlendChain, BoundedFunction
from assoc_hull.variation.fields.field import AffinePiece, StackedField, level_boundaries
from assoc_hull.variation.fields.field_data import course_data
from assoc_hull.variation.fields.layers import FieldLayer
from assoc_hull.variation.fields.shift_shapes import Bump, BumpShape, Polyline
from assoc_hull.variation.request import TOLERANCE

__all__ = [
    "BODIES",
    "CENTRES",
    "ENDS",
    "SHIFTED",
    "SHIFT_SHAPES",
    "SIZES",
    "Fade",
    "ShiftRequest",
    "ShiftShape",
    "ShiftTerms",
    "Terminals",
]

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


SIZES = ("cb", "cp", "volume")
"""Values that tell the volume of the whole hull."""

CENTRES = ("lcb", "lcb_percent")
"""Values that tell where its centre is."""

BODIES = ("Cpf", "Cpa")
"""Prismatic coefficients of fore and after body."""

ENDS = ("parallel_body_start", "parallel_body_end")
"""Ends of the parallel body, m from AP."""

SHIFTED = (*SIZES, *CENTRES, *BODIES, *ENDS)
"""All that can be asked for."""


@attrs.frozen(eq=False)
class ShiftRequest:
    """What a shift is asked for.

    Attributes
    ----------
    to, by : mapping of str to float
        Values that are to be had, and changes of present ones.
    shape : str
        Of the two free parts; see `assoc_hull.variation.shifts.shift_terms.SHIFT_SHAPES`.
    terminals : Terminals or None
        Between which places sections move; None: as measured on the hull.
    fade : {"b5", "linear"}
        How the movement of an end of the parallel body fades out.
    tolerance : float, m
        How far drivers may leave their exact images.
    name : str
        Of the step in the history.
    """

    to: Mapping[str, float]
    by: Mapping[str, float]
    shape: ShiftShape = "c2"
    terminals: Terminals | None = None
    fade: Fade = "b5"
    tolerance: float = TOLERANCE
    name: str = "shift sections"

    @classmethod
    def of(
        cls,
        to: Mapping[str, float] | None = None,
        by: Mapping[str, float] | None = None,
        *,
        shape: str = "c2",
        terminals: ArrayLike | Terminals | None = None,
        fade: str = "b5",
        tolerance: float = TOLERANCE,
        name: str | None = None,
    ) -> ShiftRequest:
        """Take what a designer gives.

        Raises
        ------
        UnknownNameError
            A value that shifts do not set.
        BadInputError
            Nothing is asked for; one thing is asked for twice; a value that is no number.
        """
        found, changes = _values(to, "to"), _values(by, "by")
        _refuse_twice(found, changes)
        chosen = choice(shape, "shape", SHIFT_SHAPES, _WHERE)
        fading = choice(fade, "fade", ("b5", "linear"), _WHERE)
        places = terminals if terminals is None or isinstance(terminals, Terminals) else (
            Terminals.of(terminals)
        )  # fmt: skip
        return cls(
            MappingProxyType(found), MappingProxyType(changes),
            next(each for each in SHIFT_SHAPES if each == chosen), places,
            "linear" if fading == "linear" else "b5", positive(tolerance, "tolerance", _WHERE),
            _title(found, changes) if name is None else text(name, "the name", _WHERE),
        )  # fmt: skip

    @property
    def names(self) -> tuple[str, ...]:
        """All that is asked for."""
        return tuple(name for name in SHIFTED if name in self.to or name in self.by)

    @property
    def by_body(self) -> bool:
        """Whether fore and after body are asked for on their own."""
        return any(name in BODIES for name in self.names)

    def asked(self, name: str, now: float) -> float:
        """Give the value that is to be had of what has a value now; that one if it is held."""
        return self.to[name] if name in self.to else now + self.by.get(name, 0.0)


def _values(given: object, argument: str) -> dict[str, float]:
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise WrongTypeError(
            f"{argument} is {type(given).__name__}", _WHERE, f"give numbers by {', '.join(SHIFTED)}"
        )
    for name in given:
        if name not in SHIFTED:
            raise UnknownNameError("value that shifts set", shown_name(name), SHIFTED)
    return {name: number(given[name], name, _WHERE) for name in SHIFTED if name in given}


def _refuse_twice(to: Mapping[str, float], by: Mapping[str, float]) -> None:
    """Refuse two words for one thing, and nothing at all."""
    every = [*to, *by]
    if not every:
        raise BadInputError("nothing is asked for", _WHERE, f"give some of {', '.join(SHIFTED)}")
    for alike in (SIZES, CENTRES, *((each,) for each in (*BODIES, *ENDS))):
        found = [name for name in every if name in alike]
        if len(found) > 1:
            both = " and ".join(f"'{name}'" for name in found)
            what = f"'{found[0]}' is in to and in by" if found[0] == found[1] else (
                f"{both} ask for one thing twice"
            )  # fmt: skip
            raise BadInputError(what, _WHERE, "give one of them")
    bodies = [name for name in every if name in BODIES]
    whole = [name for name in every if name in (*SIZES, *CENTRES)]
    if bodies and whole:
        raise BadInputError(
            f"'{bodies[0]}' and '{whole[0]}' cannot be asked for together: two bodies have two "
            "sizes", _WHERE, "give Cpf and Cpa, or size and centre of the whole hull",
        )  # fmt: skip


def _title(to: Mapping[str, float], by: Mapping[str, float]) -> str:
    words = [f"{name}={value:g}" for name, value in to.items()]
    words += [f"{name}{value:+g}" for name, value in by.items()]
    return f"shift sections {', '.join(words)}"
