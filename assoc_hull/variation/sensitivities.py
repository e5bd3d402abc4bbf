"""What of a hull changes with what: a table of derivatives of outputs by parameters."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import attrs
import numpy as np

from assoc_hull.analysis.measured_hull import HasState, state_of
from assoc_hull.analysis.parameters import DRAUGHT, TRIM, Parameter
from assoc_hull.arguments import shown
from assoc_hull.errors import (
    BadInputError,
    FoldError,
    OutOfRangeError,
    UnknownNameError,
    WrongTypeError,
)
from assoc_hull.model.state import HullState
from assoc_hull.variation.anchors import measure_all
from assoc_hull.variation.ask import Ask
from assoc_hull.variation.catalogue import NAMES
from assoc_hull.variation.freedom import Freedom
from assoc_hull.variation.hull_maps import HullMaps
from assoc_hull.variation.hull_problem import HullProblem
from assoc_hull.variation.layer import Layer
from assoc_hull.variation.layout import Layout
from assoc_hull.variation.limits import hull_box, present
from assoc_hull.variation.outputs import Outputs
from assoc_hull.variation.parent_of import parent_of
from assoc_hull.variation.room import Room
from assoc_hull.variation.sensitivity_table import Sensitivities

__all__ = ["USUAL_OUTPUTS", "sensitivities"]

_WHERE = "in sensitivities"

USUAL_OUTPUTS = ("volume", "lcb", "kb", "kmt", "cb", "cp", "cm", "cw", "wetted_surface")
"""What is differentiated if nothing is named."""

_POSITIONS = {"mean_draught": DRAUGHT, "trim": TRIM}
"""Words for parameters of the floating position."""


def sensitivities(
    hull: HasState,
    outputs: Iterable[str] | None = None,
    parameters: Iterable[object] | None = None,
    *,
    kg: float | None = None,
    layout: Mapping[str, Any] | Layout | None = None,
) -> Sensitivities:
    """Differentiate outputs of a hull by parameters of its shape and position.

    The hull floats upright at its design draught, the new one where a parameter changes that.

    Parameters
    ----------
    hull : Hull
        The hull.
    outputs : iterable of m str or None
        Fields of the record of hydrostatics ("volume", "lcb"), symbols of form parameters
        ("Cpa"), section areas ("A ST 5", "A x=42.5"); None: `USUAL_OUTPUTS`.
    parameters : iterable of k or None
        Each the name of a parameter that `vary` knows ("breadth", m or degrees),
        "mean_draught" or "trim" (m), a raw layer (by its strength), or one of
        `assoc_hull.analysis.parameters` such as a `PointMove`; None: all that `vary` knows and
        this hull has.
    kg : float or None, m
        Centre of gravity above the base line, for metacentric heights.
    layout : mapping or Layout or None
        How far the fields of named parameters reach, as for `vary`.

    Returns
    -------
    Sensitivities
        The table. A named parameter changes alone, as in `vary` with it alone: lines, dimensions
        and features go along, other parameters may change with it.

    Raises
    ------
    UnknownNameError
        No such output or parameter, with the nearest names.
    BadInputError
        The hull lacks one; a name that stands twice; a hull that is doubtful.
    WrongTypeError, OutOfRangeError
        What is no parameter; a hull that does not float at its design draught.

    Examples
    --------
    >>> from assoc_hull.sources import examples
    >>> from assoc_hull.variation.sensitivities import sensitivities
    >>> found = sensitivities(examples.wigley(), ["volume", "cb"], ["breadth", "mean_draught"])
    >>> print(found)
                  per   volume           cb
                            m3            -
    now                2777.45     0.444392
    breadth         m  277.747  2.97793e-07
    mean_draught    m  666.625    0.0355574
    """
    state = state_of(hull, _WHERE)
    wanted = Outputs.of(state, USUAL_OUTPUTS if outputs is None else outputs, kg=kg)
    maker = _Maker(state, Layout.of(attrs.asdict(layout) if isinstance(layout, Layout) else layout))
    taken, absent = maker.every() if parameters is None else (maker.chosen(parameters), {})
    found = wanted.differentiated(state, [each.parameter for each in taken])
    return Sensitivities(
        state.particulars.name, wanted.names, wanted.units, found.values,
        tuple(each.name for each in taken), tuple(each.parameter.per or "-" for each in taken),
        found.jacobian, np.array([each.usual for each in taken], np.float64), found.exact, absent,
    )  # fmt: skip


@attrs.frozen(eq=False)
class _Taken:
    """A parameter, by the name it has in the table, and a usual change of it."""

    name: str
    parameter: Parameter
    usual: float = 1.0


@attrs.frozen(eq=False)
class _Maker:
    """Makes parameters of what they are asked for by."""

    state: HullState
    layout: Layout
    _kept: list[tuple[Room, Mapping[str, str]]] = attrs.field(factory=list, init=False)

    def every(self) -> tuple[list[_Taken], dict[str, str]]:
        """Give all named parameters that the hull can be varied by, and why not by others."""
        found, absent = list[_Taken](), dict[str, str]()
        for name in NAMES:
            try:
                found.append(self._named(name))
            except (BadInputError, OutOfRangeError, FoldError) as error:
                # What cannot be varied stands before the reason.
                words = getattr(error, "what", str(error))
                absent[name] = words.partition(": ")[2] or words
        return found, absent

    def chosen(self, given: object) -> list[_Taken]:
        """Take what a designer gives."""
        if isinstance(given, str | bytes) or not isinstance(given, Iterable):
            raise WrongTypeError(f"parameters is {shown(given)}", _WHERE, "give a list of them")
        found = [self._one(each) for each in given]
        names = [each.name for each in found]
        for name in names:
            if names.count(name) > 1:
                raise BadInputError(f"{name!r} stands twice", _WHERE, "ask for it once")
        return found

    def _one(self, given: object) -> _Taken:
        if isinstance(given, str):
            if given in _POSITIONS:
                return _Taken(given, _POSITIONS[given])
            if given not in NAMES:
                raise UnknownNameError("parameter", given, (*NAMES, *_POSITIONS))
            return self._named(given)
        if isinstance(given, Parameter):
            return _Taken(given.title, given)
        if isinstance(given, Layer):
            return self._moving(Freedom.raw(given))
        what = f"an item of parameters is {shown(given)}"
        raise WrongTypeError(what, _WHERE, "give a name, a layer or a Parameter")

    def _named(self, name: str) -> _Taken:
        room, absent = self._room()
        if name not in room.present:
            raise BadInputError(
                f"cannot vary {name!r}: {absent.get(name, 'it has no value')}", _WHERE,
                "leave it out",
            )  # fmt: skip
        length = self.state.particulars.length
        return self._moving(Freedom.named(name, room.present[name], length))

    def _moving(self, free: Freedom) -> _Taken:
        """Find how the hull moves with what is free, alone."""
        maps = HullMaps(self._room()[0], Ask({}, layout=self.layout), {}, (free,))
        (moves,) = HullProblem(maps, Outputs((), ())).at(np.zeros(1)).moves()
        return _Taken(free.name, moves, free.usual)

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
