"""Derivatives of outputs of a hull by parameters, as a table.

`HullMoves` finds how a hull moves with a named parameter, a layer, a point or its floating
position. `sensitivities` differentiates outputs by them; `Sensitivities` is the table. Derivatives
are in the unit of the output per unit of the parameter (m or degrees; 1 for a layer).
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.derivatives.parameters import DRAUGHT, TRIM, Parameter
from assoc_hull.arguments import choice, shown
from assoc_hull.display import ShownAsText
from assoc_hull.errors import (
    BadInputError,
    FoldError,
    OutOfRangeError,
    UnknownNameError,
    WrongTypeError,
)
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.model.tables import HasState, HullState, state_of
from assoc_hull.variation.aiming.hull_problem import HullProblem
from assoc_hull.variation.aiming.outputs import Outputs
from assoc_hull.variation.carrying.admissible_values import AdmissibleValues
from assoc_hull.variation.carrying.hull_maps import HullMaps
from assoc_hull.variation.fields.layers import Layer
from assoc_hull.variation.parameters.catalogue import NAMES, Freedom
from assoc_hull.variation.parameters.field_layout import Layout
from assoc_hull.variation.parameters.parameter_measures import measure_all
from assoc_hull.variation.parameters.parent import parent_of
from assoc_hull.variation.parameters.value_limits import hull_box, present_values
from assoc_hull.variation.request import VariationRequest

__all__ = [
    "USUAL_OUTPUTS",
    "HullMoves",
    "MovingParameter",
    "Sensitivities",
    "sensitivities",
]

_TABLE_WHERE = "in a table of sensitivities"
_DIGITS = 6


def _read_only(given: Mapping[str, str]) -> Mapping[str, str]:
    return MappingProxyType(dict(given))


@attrs.frozen(eq=False, repr=False)
class Sensitivities(ShownAsText):
    """Derivatives of m outputs by k parameters.

    Attributes
    ----------
    ship : str
        Name.
    outputs, units : tuple of m str
        What is differentiated, and its units.
    values : (m,)
        Present values, in these units.
    parameters, per : tuple of k str
        By what, and the units of the parameters; a dash where there is none.
    matrix : (m, k)
        In the unit of the output per unit of the parameter.
    usual : (k,)
        A usual change of each parameter, in its unit.
    exact : (m,) bool
        The derivatives are those of the sums themselves; else extrapolated differences.
    absent : mapping of str to str
        By name: why the hull cannot be varied by a parameter, where none were chosen.
    """

    ship: str
    outputs: tuple[str, ...]
    units: tuple[str, ...]
    values: FloatArray
    parameters: tuple[str, ...]
    per: tuple[str, ...]
    matrix: FloatArray
    usual: FloatArray
    exact: NDArray[np.bool_]
    absent: Mapping[str, str] = attrs.field(factory=dict, converter=_read_only)

    def __attrs_post_init__(self) -> None:
        freeze(self.values, self.matrix, self.usual, self.exact)

    def of(self, output: str, parameter: str) -> float:
        """Give one derivative.

        Raises
        ------
        UnknownNameError
            The table has no such output or parameter.
        """
        column = _place("parameter of the table", parameter, self.parameters)
        return float(self.row(output)[column])

    def row(self, output: str) -> FloatArray:
        """Give the derivatives of one output, (k,); raises as `of`."""
        found: FloatArray = self.matrix[_place("output of the table", output, self.outputs)]
        return found

    @property
    def per_usual(self) -> FloatArray:
        """By how much outputs change with a usual change of each parameter, (m, k)."""
        found: FloatArray = self.matrix * self.usual
        return found

    @property
    def percent(self) -> FloatArray:
        """The same changes in percent of the present values, (m, k); nan where a value is 0."""
        size = np.where(self.values == 0.0, np.nan, np.abs(self.values))
        found: FloatArray = 100.0 * self.per_usual / size[:, None]
        return found

    def table(self, scale: str = "unit") -> str:
        """Give the table as text: a row for each parameter, a column for each output.

        Parameters
        ----------
        scale : {"unit", "usual", "percent"}
            Changes per unit of the parameter, per usual change of it, or these in percent of
            the present value.

        Raises
        ------
        BadInputError
            Another scale.
        """
        shown_as = choice(scale, "scale", ("unit", "usual", "percent"), _TABLE_WHERE)
        numbers = {"unit": self.matrix, "usual": self.per_usual, "percent": self.percent}[shown_as]
        marks = ["" if sure else " ~" for sure in self.exact.tolist()]
        head = ["", "per", *(f"{n}{mark}" for n, mark in zip(self.outputs, marks, strict=True))]
        units = ["", "", *("%" if shown_as == "percent" else unit for unit in self.units)]
        rows = [head, units, ["now", "", *(_words(each) for each in self.values.tolist())]]
        for k, name in enumerate(self.parameters):
            step = self.per[k] if shown_as == "unit" else f"{self.usual[k]:.4g} {self.per[k]}"
            rows.append([name, step, *(_words(each) for each in numbers[:, k].tolist())])
        notes = ["~ by differences, extrapolated"] if not self.exact.all() else []
        notes += [f"{name}: {why}" for name, why in self.absent.items()]
        return "\n".join([*_aligned(rows), *notes])

    def __str__(self) -> str:
        return self.table()

    def document(self) -> dict[str, Any]:
        """Give the table as data: numbers, words, lists and mappings; null for nan."""
        return {
            "ship": self.ship,
            "outputs": [
                {"name": name, "unit": unit, "value": value, "exact": sure}
                for name, unit, value, sure in zip(
                    self.outputs, self.units, self.values.tolist(), self.exact.tolist(), strict=True
                )
            ],
            "parameters": [
                {"name": name, "unit": unit, "usual": usual}
                for name, unit, usual in zip(
                    self.parameters, self.per, self.usual.tolist(), strict=True
                )
            ],
            "derivatives": [
                [None if np.isnan(each) else each for each in row] for row in self.matrix.tolist()
            ],
            "absent": dict(self.absent),
        }

    def to_json(self) -> str:
        """Give `document` as JSON."""
        return json.dumps(self.document(), indent=1, allow_nan=False)


def _place(kind: str, name: str, known: Sequence[str]) -> int:
    """Give the number of a name among known ones."""
    if name not in known:
        raise UnknownNameError(kind, str(name), tuple(known))
    return known.index(name)


def _words(number: float) -> str:
    """Give a number with six digits; a dash for nan."""
    return "-" if np.isnan(number) else f"{number:.{_DIGITS}g}"


def _aligned(rows: Sequence[Sequence[str]]) -> list[str]:
    """Align columns, the first to the left and all others to the right."""
    wide = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    lines = []
    for first, *others in rows:
        cells = [each.rjust(room) for each, room in zip(others, wide[1:], strict=True)]
        lines.append("  ".join([first.ljust(wide[0]), *cells]))
    return lines


_WHERE = "in sensitivities"

_POSITIONS = {"mean_draught": DRAUGHT, "trim": TRIM}
"""Words for parameters of the floating position."""


@attrs.frozen(eq=False)
class MovingParameter:
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
    _kept: list[tuple[AdmissibleValues, Mapping[str, str]]] = attrs.field(factory=list, init=False)

    def every(self) -> tuple[list[MovingParameter], dict[str, str]]:
        """Give all named parameters that the hull can be varied by, and why not by others."""
        found, absent = list[MovingParameter](), dict[str, str]()
        for name in NAMES:
            try:
                found.append(self._named(name))
            except (BadInputError, OutOfRangeError, FoldError) as error:
                # before the colon stands what cannot be varied, which the table names already
                words = getattr(error, "what", str(error))
                absent[name] = words.partition(": ")[2] or words
        return found, absent

    def chosen(self, given: object) -> list[MovingParameter]:
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

    def _one(self, given: object) -> MovingParameter:
        if isinstance(given, str):
            if given in _POSITIONS:
                return MovingParameter(given, _POSITIONS[given])
            if given not in NAMES:
                raise UnknownNameError("parameter", given, (*NAMES, *_POSITIONS))
            return self._named(given)
        if isinstance(given, Parameter):
            return MovingParameter(given.title, given)
        if isinstance(given, Layer):
            return self._moving(Freedom.raw(given))
        what = f"an item of parameters is {shown(given)}"
        raise WrongTypeError(what, _WHERE, "give a name, a layer or a Parameter")

    def _named(self, name: str) -> MovingParameter:
        room, absent = self._room()
        if name not in room.present:
            raise BadInputError(
                f"cannot vary {name!r}: {absent.get(name, 'it has no value')}", _WHERE,
                "leave it out",
            )  # fmt: skip
        length = self.state.particulars.length
        return self._moving(Freedom.named(name, room.present[name], length))

    def _moving(self, free: Freedom) -> MovingParameter:
        """Find how the hull moves with one freedom, all others at rest."""
        maps = HullMaps(self._room()[0], VariationRequest({}, layout=self.layout), {}, (free,))
        (moves,) = HullProblem(maps, Outputs((), ())).at(np.zeros(1)).moves()
        return MovingParameter(free.name, moves, free.usual)

    def _room(self) -> tuple[AdmissibleValues, Mapping[str, str]]:
        """Measure the hull, once."""
        if not self._kept:
            state, ask = self.state, VariationRequest({}, layout=self.layout)
            measured = measure_all(state)
            box = hull_box(state, ask.tolerance)
            now = present_values(measured, ask.layout)
            room = AdmissibleValues(state, parent_of(state, measured), now, ask.layout, box)
            self._kept.append((room, measured.absent))
        return self._kept[0]


_CALL_WHERE = "in sensitivities"

USUAL_OUTPUTS = ("volume", "lcb", "kb", "kmt", "cb", "cp", "cm", "cw", "wetted_surface")
"""What is differentiated if nothing is named."""


def sensitivities(
    hull: HasState,
    outputs: Iterable[str] | None = None,
    parameters: Iterable[object] | None = None,
    *,
    kg: float | None = None,
    layout: Mapping[str, Any] | Layout | None = None,
) -> Sensitivities:
    """Differentiate outputs of a hull by parameters of its shape and position.

    The arguments and what is raised are those of `Hull.sensitivities`.
    """
    state = state_of(hull, _CALL_WHERE)
    wanted = Outputs.of(state, USUAL_OUTPUTS if outputs is None else outputs, kg=kg)
    reach = attrs.asdict(layout) if isinstance(layout, Layout) else layout
    known = HullMoves(state, Layout.of(reach))
    taken, absent = known.every() if parameters is None else (known.chosen(parameters), {})
    found = wanted.differentiated(state, [each.parameter for each in taken])
    return Sensitivities(
        state.particulars.name, wanted.names, wanted.units, found.values,
        tuple(each.name for each in taken), tuple(each.parameter.per or "-" for each in taken),
        found.jacobian, np.array([each.usual for each in taken], np.float64), found.exact, absent,
    )  # fmt: skip
