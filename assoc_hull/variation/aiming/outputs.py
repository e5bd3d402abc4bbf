"""The outputs of a hull that can be targets: names, values, derivatives.

Outputs are fields of the hydrostatic record, sectional areas by station or place, form parameters,
and the resistance at a speed, of a hull that floats upright at its design draught; where the
draught changes with a parameter, at the new one. Each `OutputKind` works on all its keys together,
as they share what is measured; `Outputs` understands the names and joins the kinds.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Protocol

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.derivatives.hydrostatic_derivatives import (
    TangentHull,
    tangents_by,
    tangents_of,
)
from assoc_hull.analysis.derivatives.parameters import Parameter, Position
from assoc_hull.analysis.derivatives.reused_layout import flotation_with_layout_of
from assoc_hull.analysis.form.floating_shape import FloatingShape
from assoc_hull.analysis.form.form_parameters import CATALOGUE
from assoc_hull.analysis.form.form_rates import form_rates
from assoc_hull.analysis.form.longitudinal_parts import ship_slices
from assoc_hull.analysis.form.parameter import evaluate
from assoc_hull.analysis.hydrostatics.floating_body import FloatingPosition
from assoc_hull.analysis.hydrostatics.flotation import Flotation, flotation, header_of
from assoc_hull.analysis.hydrostatics.record import FIELDS, SALT
from assoc_hull.analysis.resistance.hull_resistance import (
    SYMBOLS,
    total_resistance,
    total_resistance_rates,
)
from assoc_hull.arguments import all_of, number, shown, shown_name
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.floating.sections import area_with_tangents
from assoc_hull.model.tables import HullState, Particulars

__all__ = [
    "KINDS",
    "OutputKind",
    "OutputRates",
    "Outputs",
    "Rates",
]

# --------------------------------------------------------------------------------------
# The kinds of outputs. A key is what a kind calls an output: the field, the station, ...

_WHERE = "among the outputs"

Rates = tuple[FloatArray, NDArray[np.bool_]]
"""Derivatives (n, k), and (n,) which of them are exact, taken without differences."""


class OutputKind(Protocol):
    """Outputs of one kind; a key is text."""

    def unit(self, key: str) -> str:
        """Give the unit of an output."""
        ...

    def values(self, keys: Sequence[str], shape: FloatingShape) -> FloatArray:
        """Give the outputs of a hull, (n,).

        Raises
        ------
        BadInputError, UnknownNameError
            The hull has no such value.
        """
        ...

    def rates(self, keys: Sequence[str], shape: FloatingShape, some: TangentHull) -> Rates:
        """Give their derivatives by k parameters of the shape."""
        ...


def _lacks(name: str, why: str) -> BadInputError:
    """Give the error for an output that the hull does not have."""
    return BadInputError(f"the hull has no {name!r}: {why}", _WHERE, "aim at something else")


def _exact(rows: Sequence[FloatArray]) -> Rates:
    """Stack derivatives (k,) of outputs that are all exact."""
    return np.stack(rows), np.ones(len(rows), np.bool_)


@attrs.frozen
class _Fields:
    """Values of the record of hydrostatics."""

    def unit(self, key: str) -> str:
        return FIELDS[key].unit

    def values(self, keys: Sequence[str], shape: FloatingShape) -> FloatArray:
        given = [getattr(shape.record, key) for key in keys]
        for key, value in zip(keys, given, strict=True):
            if value is None:
                raise _lacks(key, "no centre of gravity is given")
            if np.isnan(value):
                raise _lacks(key, "no waterplane")
        return np.array(given, np.float64)

    def rates(self, keys: Sequence[str], shape: FloatingShape, some: TangentHull) -> Rates:
        count = some.count
        return _exact([tangents_of(some.values[key], count) for key in keys])


@attrs.frozen
class _Stations:
    """Immersed areas of sections as drawn, by name; a section that moves takes its name along."""

    def unit(self, key: str) -> str:
        return "m2"

    def values(self, keys: Sequence[str], shape: FloatingShape) -> FloatArray:
        found = shape.body.stations(shape.planes)
        for key in keys:
            if key not in found.names:
                raise UnknownNameError("station", key, found.names)
        return np.array([found.area[0, found.names.index(key)] for key in keys])

    def rates(self, keys: Sequence[str], shape: FloatingShape, some: TangentHull) -> Rates:
        found = some.body.stations(some.planes)
        places = [found.names.index(key) for key in keys]
        return _exact([tangents_of(found.area[0, i], some.count) for i in places])


@attrs.frozen
class _Places:
    """Immersed areas of the surface at fixed places along the ship, m from AP."""

    def unit(self, key: str) -> str:
        return "m2"

    def values(self, keys: Sequence[str], shape: FloatingShape) -> FloatArray:
        found = np.array([shape.take(ship_slices).area(float(key)) for key in keys])
        for key, area in zip(keys, found.tolist(), strict=True):
            if not area > 0.0:
                raise _lacks(f"A x={key}", "nothing is immersed there")
        return found

    def rates(self, keys: Sequence[str], shape: FloatingShape, some: TangentHull) -> Rates:
        strips, body = some.body.prepared.strips, shape.body.spans
        rows = [area_with_tangents(body, strips, float(key), some.planes) for key in keys]
        for key, row in zip(keys, rows, strict=True):
            if row is None:
                raise _lacks(f"A x={key}", "a raked end of the hull is there")
        return _exact([tangents_of(row, some.count) for row in rows])


@attrs.frozen
class _Forms:
    """Form parameters of the catalogue."""

    def unit(self, key: str) -> str:
        return CATALOGUE[key].unit

    def values(self, keys: Sequence[str], shape: FloatingShape) -> FloatArray:
        found = evaluate(CATALOGUE, keys, shape, {})
        for key, value in found.items():
            if value.number is None:
                raise _lacks(key, value.reason or "it cannot be told")
        return np.array([found[key].number for key in keys], np.float64)

    def rates(self, keys: Sequence[str], shape: FloatingShape, some: TangentHull) -> Rates:
        found = form_rates(keys, shape, some)
        exact = np.array([key in found.exact for key in keys], np.bool_)
        return np.stack([found.rates[key] for key in keys]), exact


@attrs.frozen
class _Resistances:
    """Total resistance of the bare hull at speeds, kn, by Holtrop's regression of 1984."""

    def unit(self, key: str) -> str:
        return "kN"

    def values(self, keys: Sequence[str], shape: FloatingShape) -> FloatArray:
        return total_resistance(shape, [float(key) for key in keys])

    def rates(self, keys: Sequence[str], shape: FloatingShape, some: TangentHull) -> Rates:
        found = form_rates(SYMBOLS.values(), shape, some)
        rates = total_resistance_rates(shape, [float(key) for key in keys], found.rates)
        return rates, np.zeros(len(keys), np.bool_)


KINDS: Mapping[str, OutputKind] = {
    "field": _Fields(), "station": _Stations(), "place": _Places(), "form": _Forms(),
    "resistance": _Resistances(),
}  # fmt: skip
"""All kinds by name."""


_AREA, _AT = "A ", "x="
_RESISTANCE, _KNOTS = "R ", " kn"


@attrs.frozen(eq=False)
class OutputRates:
    """Outputs of a hull and their derivatives by k parameters.

    Attributes
    ----------
    values : (m,)
        The outputs, in their units.
    jacobian : (m, k)
        In the unit of the output per unit of the parameter.
    exact : (m,) bool
        The derivatives are those of the sums themselves; else extrapolated differences.
    """

    values: FloatArray
    jacobian: FloatArray
    exact: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.values, self.jacobian, self.exact)


@attrs.frozen
class _Tables:
    """Tables of a hull, in the form that hydrostatics read."""

    state: HullState


@attrs.frozen
class Outputs:
    """Names of what is wanted of a hull, understood.

    Attributes
    ----------
    names : tuple of m str
        As given: a field of `assoc_hull.analysis.hydrostatics.record.FIELDS` ("volume", "lcb");
        the symbol of a form parameter of the catalogue ("Cp", "Cpa"); "A ST 5" for the immersed
        area of the station of that name, "A x=42.5" for that of the surface at a place, m
        from AP; "R 14 kn" for the total resistance at a speed, kN, of the bare hull by Holtrop's
        regression of 1984 in salt water (`Hull.resistance` with nothing stated).
    keys : tuple of m (str, str)
        The kind of each, and how that kind calls it.
    kg : float or None, m
        Centre of gravity above the base line, for metacentric heights.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.hull.sources import examples
    >>> from assoc_hull.variation.aiming.outputs import Outputs
    >>> state = examples.wigley().state
    >>> outputs = Outputs.of(state, ["volume", "Cp", "A ST 7"])
    >>> outputs.units, outputs.values(state).round(3).tolist()
    (('m3', '-', 'm2'), [2777.447, 0.667, 37.915])
    """

    names: tuple[str, ...]
    keys: tuple[tuple[str, str], ...]
    kg: float | None = None

    @classmethod
    def of(cls, state: HullState, names: Iterable[str], *, kg: float | None = None) -> Outputs:
        """Understand names, and see that a hull has such values.

        Parameters
        ----------
        state : HullState
            The hull.
        names : iterable of m str
            See the attributes.
        kg : float or None, m
            Centre of gravity above the base line.

        Raises
        ------
        UnknownNameError
            A name of nothing, with those that are nearest.
        BadInputError
            A name that stands twice; a value that this hull does not have, and why.
        """
        given = _names(names)
        height = None if kg is None else number(kg, "kg", _WHERE)
        found = cls(given, tuple(_key(each, state) for each in given), height)
        found.values(state)
        return found

    @property
    def units(self) -> tuple[str, ...]:
        """The unit of each output; a dash where there is none."""
        return tuple(KINDS[kind].unit(key) for kind, key in self.keys)

    def values(self, state: HullState, *, like: HullState | None = None) -> FloatArray:
        """Give the outputs of a hull, (m,), in their units.

        Parameters
        ----------
        state : HullState
            The hull.
        like : HullState or None
            A hull from which it differs by places only: its layout is used, and its doubts count.

        Raises
        ------
        OutOfRangeError
            It does not float at its design draught.
        BadInputError
            It is doubtful, or lacks a value.
        """
        return self._values(self.afloat(state, like))

    def values_of(
        self, body: Flotation, particulars: Particulars | None = None, *, strict: bool = False
    ) -> FloatArray:
        """Give the outputs of a hull whose surface is at hand, (m,).

        Parameters
        ----------
        body : Flotation
            For instance of points that have moved
            (`assoc_hull.analysis.derivatives.reused_layout`).
        particulars : Particulars or None
            Its dimensions, m; those of its tables if None.
        strict : bool
            Whether to refuse a doubtful hull, as `values` does.
        """
        shape = self._shape(body, particulars)
        if strict:
            _refuse_doubts(body.doubts(shape.planes, numbers=False))
        return self._values(shape)

    def derivatives(
        self, state: HullState, shapes: Sequence[Parameter], *, like: HullState | None = None
    ) -> tuple[FloatArray, FloatArray]:
        """Give the outputs of a hull (m,), and their derivatives by parameters (m, k)."""
        found = self.differentiated(state, shapes, like=like)
        return found.values, found.jacobian

    def differentiated(
        self, state: HullState, wrt: Sequence[Parameter], *, like: HullState | None = None
    ) -> OutputRates:
        """Give the outputs of a hull, their derivatives, and how these were taken.

        Parameters
        ----------
        state : HullState
            The hull.
        wrt : sequence of k parameters
            Of `assoc_hull.analysis.derivatives.parameters`, or `Moves`; not of a position that
            heels.
        like : HullState or None
            As for `values`.

        Raises
        ------
        OutOfRangeError, BadInputError, WrongTypeError
            As `values`; a parameter that cannot be used.
        """
        shape = self.afloat(state, like)
        values = self._values(shape)
        jacobian = np.zeros((len(self.names), len(wrt)))
        exact = np.ones(len(self.names), np.bool_)
        for some in tangents_by(shape.body, shape.planes, shape.header, _upright(wrt), sinks=True):
            for kind, rows, keys in self._by_kind():
                rates, sure = KINDS[kind].rates(keys, shape, some)
                jacobian[np.ix_(rows, some.where)] = rates
                exact[rows] &= sure
        return OutputRates(values, jacobian, exact)

    def afloat(self, state: HullState, like: HullState | None = None) -> FloatingShape:
        """Give a hull as its outputs are taken of it, or say what makes it doubtful."""
        looked_at = flotation(state if like is None else like)
        body = looked_at if like is None else flotation_with_layout_of(like, state)
        shape = self._shape(body, None)
        _refuse_doubts(looked_at.doubts(shape.planes, numbers=False))
        return shape

    def _shape(self, body: Flotation, particulars: Particulars | None) -> FloatingShape:
        """Float a hull upright at its design draught, in salt water."""
        ship = body.state.particulars if particulars is None else particulars
        terms: dict[str, object] = {
            "rho": SALT, "shell_factor": 1.0, "kg": self.kg, "appendages": (), "fingerprint": "",
        }  # fmt: skip
        header = attrs.evolve(
            header_of(_Tables(body.state), body, terms),
            length=ship.length, breadth=ship.breadth, draught=ship.draught,
        )  # fmt: skip
        return FloatingShape(body, header, FloatingPosition(ship.draught, ship.draught), ship.depth)

    def _values(self, shape: FloatingShape) -> FloatArray:
        found = np.zeros(len(self.names))
        for kind, rows, keys in self._by_kind():
            found[rows] = KINDS[kind].values(keys, shape)
        return found

    def _by_kind(self) -> list[tuple[str, list[int], list[str]]]:
        """Give each kind with the rows of its outputs and their keys."""
        found: dict[str, list[int]] = {}
        for i, (kind, _) in enumerate(self.keys):
            found.setdefault(kind, []).append(i)
        return [(kind, rows, [self.keys[i][1] for i in rows]) for kind, rows in found.items()]


def _refuse_doubts(doubts: Sequence[str]) -> None:
    if doubts:
        raise BadInputError(doubts[0], _WHERE, "mend the hull")


def _upright(wrt: Iterable[Parameter]) -> list[Parameter]:
    """Take parameters that leave the hull upright, or refuse."""
    found = all_of(wrt, Parameter, "wrt", _WHERE)  # type: ignore[type-abstract]
    for each in found:
        if isinstance(each, Position) and each.rates[2] != 0.0:
            raise BadInputError(
                f"{each.title!r} heels the hull", _WHERE, "ask hydrostatic_derivatives by it"
            )
    return found


def _names(names: object) -> tuple[str, ...]:
    if isinstance(names, str) or not isinstance(names, Iterable):
        raise WrongTypeError(f"names is {shown(names)}", _WHERE, "give a list of names")
    found = tuple(names)
    for each in found:
        if not isinstance(each, str):
            raise WrongTypeError(f"a name is {shown(each)}", _WHERE, "give text")
        if found.count(each) > 1:
            raise BadInputError(f"{each!r} stands twice", _WHERE, "ask for it once")
    return found


def _spoken(word: str) -> float:
    """Read the number in the name of an output; not a number where it is none."""
    try:
        return float(word)
    except ValueError:
        return math.nan


def _key(name: str, state: HullState) -> tuple[str, str]:
    """Find the kind of an output, and what that kind calls it."""
    if name in FIELDS:
        return "field", name
    if name in CATALOGUE:
        return "form", name
    if name.startswith(_AREA + _AT):
        place = _spoken(name.removeprefix(_AREA + _AT))
        return "place", repr(number(place, f"the place in {name!r}", _WHERE))
    if name.startswith(_AREA):
        return "station", name.removeprefix(_AREA)
    if name.startswith(_RESISTANCE) and name.endswith(_KNOTS):
        speed = _spoken(name[len(_RESISTANCE) : -len(_KNOTS)])
        return "resistance", repr(number(speed, f"the speed in {name!r}", _WHERE, unit="kn"))
    stations = (_AREA + each for each in flotation(state).sections.names)
    known = (*FIELDS, *CATALOGUE, *stations, "R 14 kn")
    raise UnknownNameError("output", shown_name(name), known)
