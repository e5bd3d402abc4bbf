"""A form parameter: its entry in the catalogue, what it gives, and how entries are evaluated.

An entry is a function with a description. `needs` names what it takes: values of other entries, by
symbol, or `SHAPE`, the hull at its floating position; so a formula is written once and serves a
measured hull as well as printed values. It gives a number, a `Warned` number, or `Absent` with the
reason. `evaluate` calls each entry once, after what it needs.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from typing import Literal, get_args

import attrs
import numpy as np

from assoc_hull.arguments import choice, shown
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError

__all__ = [
    "HOLTROP",
    "ITTC",
    "KRACHT",
    "LEWIS",
    "SHAPE",
    "TABLE_3",
    "TABLE_4",
    "Absent",
    "FormParameter",
    "FormValue",
    "MeasuredValue",
    "Table",
    "Warned",
    "check_catalogue",
    "entries_in",
    "evaluate",
    "parameter",
]

# --------------------------------------------------------------------------------------
# Sources of definitions.

_SON_KIM = "Son and Kim, J. CAD/CAM (Korea) 13(6), 2008"

TABLE_3 = f"{_SON_KIM}, Table 3"
TABLE_4 = f"{_SON_KIM}, Table 4"

ITTC = "ITTC Symbols and Terminology List 2021, ship geometry"

KRACHT = "Kracht, Design of bulbous bows, SNAME Transactions 86, 1978"

HOLTROP = "Holtrop and Mennen, International Shipbuilding Progress 29, no. 335, 1982"

LEWIS = "E.V. Lewis, ed., Principles of Naval Architecture, vol. I, SNAME 1988, ch. I"


# --------------------------------------------------------------------------------------
# What an entry gives.


@attrs.frozen
class Absent:
    """That a hull does not have a parameter.

    Attributes
    ----------
    reason : str
        Why: no bulb, single skeg, no screw given ...; lower case, no full stop.
    """

    reason: str


@attrs.frozen
class Warned:
    """A number to be read with care.

    Attributes
    ----------
    number : float
        In the unit of its parameter.
    warning : str
        What to mind; lower case, no full stop.
    """

    number: float
    warning: str


MeasuredValue = float | Absent | Warned
"""What the function of a parameter gives."""


@attrs.frozen
class FormValue:
    """A form parameter of a hull.

    Attributes
    ----------
    number : float or None
        In `unit`; None where there is none, for the `reason`.
    unit : str
        A dash where there is none.
    definition : str
        The symbol under which the catalogue holds the definition.
    reason : str or None
        Why there is no number.
    warning : str or None
        What to mind about the number.

    Examples
    --------
    >>> from assoc_hull.analysis.form.parameter import FormValue
    >>> FormValue(None, "m", "BL", reason="no bulb").reason
    'no bulb'
    """

    number: float | None
    unit: str
    definition: str
    reason: str | None = None
    warning: str | None = None

    def __attrs_post_init__(self) -> None:
        if (self.number is None) == (self.reason is None):
            raise BadInputError(
                f"{self.definition} has {'neither' if self.number is None else 'both'} "
                "a number and a reason",
                "in a form parameter", "give one of them",
            )  # fmt: skip


# --------------------------------------------------------------------------------------
# The entry.

SHAPE = "shape"
"""Among `needs`: the `assoc_hull.analysis.form.floating_shape.FloatingShape`."""

Table = Literal["particulars", "hydrostatic", "hull form", "bulb and resistance", "measures"]
"""Part of the catalogue: what is given, Tables 3 and 4 of Son and Kim (2008), what others use,
and what only serves other entries."""


@attrs.frozen(eq=False)
class FormParameter:
    """An entry of the catalogue.

    Attributes
    ----------
    symbol : str
        Under which the catalogue holds it; as in its source, in plain letters.
    name : str
        In words, lower case.
    unit : str
        A dash where there is none.
    table : str
        One of `Table`.
    definition : str
        How it is measured or computed.
    datum : str
        From where it counts and which way is plus; a dash where that says nothing.
    source : str
        Paper, book or standard.
    ittc : str or None
        Symbol in the ITTC's list, where it has one.
    needs : tuple of str
        What `compute` takes, in order.
    digits : int
        After the point, in a table for people.
    compute : callable
        Gives a number, or an `Absent`, or a `Warned`.
    """

    symbol: str
    name: str
    unit: str
    table: Table
    definition: str
    datum: str
    source: str
    ittc: str | None
    needs: tuple[str, ...]
    digits: int
    compute: Callable[..., MeasuredValue]

    @property
    def placed_name(self) -> str:
        """The name, and of a place along the ship from where it counts and which way is plus."""
        along = self.datum.endswith(("+ forward", "+ aft"))
        return f"{self.name}, {self.datum}" if along else self.name


def parameter(
    symbol: str,
    *,
    name: str,
    unit: str,
    table: Table,
    definition: str,
    source: str,
    datum: str = "-",
    ittc: str | None = None,
    needs: tuple[str, ...] = (SHAPE,),
    digits: int = 4,
) -> Callable[[Callable[..., MeasuredValue]], FormParameter]:
    """Make an entry of a function; the attributes of `Parameter` say what to give.

    Raises
    ------
    BadInputError
        A table that is none of the catalogue's.

    Examples
    --------
    >>> from assoc_hull.analysis.form.parameter import parameter
    >>> @parameter("L/B", name="length over breadth", unit="-", table="measures",
    ...            definition="Lpp / B", source="-", needs=("Lpp", "B"))
    ... def length_over_breadth(length: float, breadth: float) -> float:
    ...     return length / breadth
    >>> length_over_breadth.compute(254.0, 46.0) > 5.5
    True
    """
    choice(table, "table", get_args(Table), "in an entry of the catalogue")

    def entry(compute: Callable[..., MeasuredValue]) -> FormParameter:
        return FormParameter(
            symbol, name, unit, table, definition, datum, source, ittc, needs, digits, compute
        )

    return entry


def entries_in(names: Mapping[str, object]) -> tuple[FormParameter, ...]:
    """Give the entries among the names of a module, in the order in which they stand there."""
    return tuple(each for each in names.values() if isinstance(each, FormParameter))


# --------------------------------------------------------------------------------------
# Evaluation.

_WHERE = "in the catalogue of form parameters"


def check_catalogue(entries: Iterable[FormParameter]) -> dict[str, FormParameter]:
    """Give entries by symbol, in their order.

    Raises
    ------
    BadInputError
        A symbol that stands twice, a need that is no entry, or entries that need one another.
    """
    found: dict[str, FormParameter] = {}
    for each in entries:
        if each.symbol in found or each.symbol == SHAPE:
            raise BadInputError(
                f"the symbol {each.symbol!r} stands twice", _WHERE, "give it another"
            )
        found[each.symbol] = each
    for each in found.values():
        for need in each.needs:
            if need != SHAPE and need not in found:
                what = f"{each.symbol!r} needs {need!r}, which is no entry"
                raise BadInputError(what, _WHERE, "add the entry or mend the name")
    for symbol in found:
        _refuse_ring(found, symbol, ())
    return found


def _refuse_ring(entries: Mapping[str, FormParameter], symbol: str, way: tuple[str, ...]) -> None:
    if symbol in way:
        ring = " -> ".join((*way[way.index(symbol) :], symbol))
        raise BadInputError(f"entries need one another: {ring}", _WHERE, "leave one need out")
    for need in entries[symbol].needs:
        if need != SHAPE:
            _refuse_ring(entries, need, (*way, symbol))


def evaluate(
    entries: Mapping[str, FormParameter],
    wanted: Iterable[str],
    shape: object,
    known: dict[str, FormValue],
) -> dict[str, FormValue]:
    """Give the values of wanted entries, by symbol, in that order.

    `entries` is a checked catalogue; without a `shape`, a `FloatingShape`, what needs it is absent.
    What is `known` is not computed again; what is computed is added to it.

    Raises
    ------
    UnknownNameError
        A symbol that is no entry.

    Examples
    --------
    >>> from assoc_hull.analysis.form.form_parameters import CATALOGUE
    >>> from assoc_hull.analysis.form.parameter import evaluate
    >>> from assoc_hull.analysis.form.parameter import FormValue
    >>> printed = {s: FormValue(v, "m", s) for s, v in {"B": 46.0, "T": 16.0}.items()}
    >>> round(evaluate(CATALOGUE, ["B'"], None, printed)["B'"].number, 4)
    28.0179
    """
    found: dict[str, FormValue] = {}
    for symbol in wanted:
        if symbol not in entries:
            raise UnknownNameError("form parameter", symbol, tuple(entries))
        found[symbol] = _value(entries, symbol, shape, known)
    return found


def _value(
    entries: Mapping[str, FormParameter], symbol: str, shape: object, known: dict[str, FormValue]
) -> FormValue:
    value = known.get(symbol)
    if value is None:
        value = known[symbol] = _computed(entries, entries[symbol], shape, known)
    return value


def _computed(
    entries: Mapping[str, FormParameter],
    entry: FormParameter,
    shape: object,
    known: dict[str, FormValue],
) -> FormValue:
    taken: list[object] = []
    for need in entry.needs:
        if need == SHAPE:
            if shape is None:
                return _as_value(entry, Absent("not among the values given"))
            taken.append(shape)
            continue
        value = _value(entries, need, shape, known)
        if value.number is None:
            return _as_value(entry, Absent(_because(need, value.reason or "")))
        taken.append(value.number)
    return _as_value(entry, _found(entry, taken))


def _found(entry: FormParameter, taken: list[object]) -> MeasuredValue:
    """Call the entry; a formula may divide by zero, but a measure that does is wrong and raises."""
    try:
        return entry.compute(*taken)
    except ZeroDivisionError:
        if SHAPE in entry.needs:
            raise
        return Absent("the definition divides by nil here")


def _because(need: str, reason: str) -> str:
    """Pass a reason on; the entry it came from is named once."""
    return reason if ": " in reason else f"{need}: {reason}"


def _as_value(entry: FormParameter, found: MeasuredValue) -> FormValue:
    if isinstance(found, Absent):
        return FormValue(None, entry.unit, entry.symbol, reason=found.reason)
    warning = found.warning if isinstance(found, Warned) else None
    given: object = found.number if isinstance(found, Warned) else found
    if isinstance(given, bool) or not isinstance(given, float | int | np.floating | np.integer):
        raise WrongTypeError(
            f"{entry.symbol!r} gives {shown(given)}", _WHERE,
            "let the entry give a number, Absent or Warned",
        )  # fmt: skip
    number = float(given)
    if not math.isfinite(number):
        why = f"the definition gives no finite number ({number:g}) here"
        return FormValue(None, entry.unit, entry.symbol, reason=why)
    return FormValue(number, entry.unit, entry.symbol, warning=warning)
