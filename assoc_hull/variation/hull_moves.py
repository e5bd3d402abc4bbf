"""How a hull moves with parameters that it is asked about by name, or otherwise."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import attrs
import numpy as np

from assoc_hull.analysis.derivatives.parameters import DRAUGHT, TRIM, Parameter
from assoc_hull.arguments import shown
from assoc_hull.errors import (
    BadInputError,
    FoldError,
    OutOfRangeError,
    UnknownNameError,
    WrongTypeError,
)
from assoc_hull.model.state import HullState
from assoc_hull.variation.aiming.hull_problem import HullProblem
from assoc_hull.variation.aiming.outputs import Outputs
from assoc_hull.variation.ask import Ask
from assoc_hull.variation.carrying.hull_maps import HullMaps
from assoc_hull.variation.carrying.room import Room
from assoc_hull.variation.fields.layer import Layer
from assoc_hull.variation.parameters.catalogue import NAMES
from assoc_hull.variation.parameters.freedom import Freedom
from assoc_hull.variation.parameters.layout import Layout
from assoc_hull.variation.parameters.limits import hull_box, present
from assoc_hull.variation.parameters.parameter_measures import measure_all
from assoc_hull.variation.parameters.read_parent import parent_of

__all__ = ["HullMoves", "Taken"]

_WHERE = "in sensitivities"

_POSITIONS = {"mean_draught": DRAUGHT, "trim": TRIM}
"""Words for parameters of the floating position."""


@attrs.frozen(eq=False)
class Taken:
    """A parameter of a hull, ready to differentiate by.

    Attributes
    ----------
    name : str
        That it was asked for by.
    parameter : Parameter
        With the points of the hull, where it is of the shape.
    usual : float
        A usual change of it, in its unit.
    """

    name: str
    parameter: Parameter
    usual: float = 1.0


@attrs.frozen(eq=False)
class HullMoves:
    """What a hull can be moved by: named parameters, layers, points, its floating position.

    Attributes
    ----------
    state : HullState
        The tables.
    layout : Layout
        How far the fields of named parameters reach.
    """

    state: HullState
    layout: Layout
    _kept: list[tuple[Room, Mapping[str, str]]] = attrs.field(factory=list, init=False)

    def every(self) -> tuple[list[Taken], dict[str, str]]:
        """Give all named parameters that the hull can be varied by, and why not by others."""
        found, absent = list[Taken](), dict[str, str]()
        for name in NAMES:
            try:
                found.append(self._named(name))
            except (BadInputError, OutOfRangeError, FoldError) as error:
                # What cannot be varied stands before the reason.
                words = getattr(error, "what", str(error))
                absent[name] = words.partition(": ")[2] or words
        return found, absent

    def chosen(self, given: object) -> list[Taken]:
        """Take what a designer gives: see `assoc_hull.variation.sensitivities.sensitivities`.

        Raises
        ------
        UnknownNameError, WrongTypeError, BadInputError
            What is no parameter, or none of this hull, or stands twice.
        """
        if isinstance(given, str | bytes) or not isinstance(given, Iterable):
            raise WrongTypeError(f"parameters is {shown(given)}", _WHERE, "give a list of them")
        found = [self._one(each) for each in given]
        names = [each.name for each in found]
        for name in names:
            if names.count(name) > 1:
                raise BadInputError(f"{name!r} stands twice", _WHERE, "ask for it once")
        return found

    def _one(self, given: object) -> Taken:
        if isinstance(given, str):
            if given in _POSITIONS:
                return Taken(given, _POSITIONS[given])
            if given not in NAMES:
                raise UnknownNameError("parameter", given, (*NAMES, *_POSITIONS))
            return self._named(given)
        if isinstance(given, Parameter):
            return Taken(given.title, given)
        if isinstance(given, Layer):
            return self._moving(Freedom.raw(given))
        what = f"an item of parameters is {shown(given)}"
        raise WrongTypeError(what, _WHERE, "give a name, a layer or a Parameter")

    def _named(self, name: str) -> Taken:
        room, absent = self._room()
        if name not in room.present:
            raise BadInputError(
                f"cannot vary {name!r}: {absent.get(name, 'it has no value')}", _WHERE,
                "leave it out",
            )  # fmt: skip
        length = self.state.particulars.length
        return self._moving(Freedom.named(name, room.present[name], length))

    def _moving(self, free: Freedom) -> Taken:
        """Find how the hull moves with what is free, alone."""
        maps = HullMaps(self._room()[0], Ask({}, layout=self.layout), {}, (free,))
        (moves,) = HullProblem(maps, Outputs((), ())).at(np.zeros(1)).moves()
        return Taken(free.name, moves, free.usual)

    def _room(self) -> tuple[Room, Mapping[str, str]]:
        """Measure the hull, once."""
        if not self._kept:
            state, ask = self.state, Ask({}, layout=self.layout)
            measured = measure_all(state)
            box = hull_box(state, ask.tolerance)
            now = present(measured, ask.layout)
            room = Room(state, parent_of(state, measured), now, ask.layout, box)
            self._kept.append((room, measured.absent))
        return self._kept[0]
