"""What a shift of sections is asked for, checked and frozen."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import attrs
from numpy.typing import ArrayLike

from assoc_hull.arguments import choice, number, positive, shown_name, text
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError
from assoc_hull.variation.request import TOLERANCE
from assoc_hull.variation.shifts.shift_terms import SHIFT_SHAPES, Fade, ShiftShape, Terminals

__all__ = ["BODIES", "CENTRES", "ENDS", "SHIFTED", "SIZES", "ShiftRequest"]

_WHERE = "in shift_sections"

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
