"""From a catalogue and a hull to values: each entry once, after what it needs."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

import numpy as np

from assoc_hull.analysis.form.parameter import SHAPE, Parameter
from assoc_hull.analysis.form.value import Absent, Found, Value, Warned
from assoc_hull.arguments import shown
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError

__all__ = ["check_catalogue", "evaluate"]

_WHERE = "in the catalogue of form parameters"


def check_catalogue(entries: Iterable[Parameter]) -> dict[str, Parameter]:
    """Give entries by symbol, in their order.

    Raises
    ------
    BadInputError
        A symbol that stands twice, a need that is no entry, or entries that need one another.
    """
    found: dict[str, Parameter] = {}
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


def _refuse_ring(entries: Mapping[str, Parameter], symbol: str, way: tuple[str, ...]) -> None:
    if symbol in way:
        ring = " -> ".join((*way[way.index(symbol) :], symbol))
        raise BadInputError(f"entries need one another: {ring}", _WHERE, "leave one need out")
    for need in entries[symbol].needs:
        if need != SHAPE:
            _refuse_ring(entries, need, (*way, symbol))


def evaluate(
    entries: Mapping[str, Parameter],
    wanted: Iterable[str],
    shape: object,
    known: dict[str, Value],
) -> dict[str, Value]:
    """Give the values of entries.

    Parameters
    ----------
    entries : mapping of symbol to Parameter
        The catalogue, checked.
    wanted : iterable of str
        Symbols.
    shape : Shape or None
        The hull; None: what needs it is absent.
    known : dict of symbol to Value
        What is known already, and is not computed again; what is computed is added.

    Returns
    -------
    dict of symbol to Value
        What was wanted, in that order.

    Raises
    ------
    UnknownNameError
        A symbol that is no entry.

    Examples
    --------
    >>> from assoc_hull.analysis.form.catalogue import CATALOGUE
    >>> from assoc_hull.analysis.form.evaluate import evaluate
    >>> from assoc_hull.analysis.form.value import Value
    >>> printed = {s: Value(v, "m", s) for s, v in {"B": 46.0, "T": 16.0}.items()}
    >>> round(evaluate(CATALOGUE, ["B'"], None, printed)["B'"].number, 4)
    28.0179
    """
    found: dict[str, Value] = {}
    for symbol in wanted:
        if symbol not in entries:
            raise UnknownNameError("form parameter", symbol, tuple(entries))
        found[symbol] = _value(entries, symbol, shape, known)
    return found


def _value(
    entries: Mapping[str, Parameter], symbol: str, shape: object, known: dict[str, Value]
) -> Value:
    value = known.get(symbol)
    if value is None:
        value = known[symbol] = _computed(entries, entries[symbol], shape, known)
    return value


def _computed(
    entries: Mapping[str, Parameter], entry: Parameter, shape: object, known: dict[str, Value]
) -> Value:
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


def _found(entry: Parameter, taken: list[object]) -> Found:
    """Ask the entry; a formula may divide by nil, but a measure that does is wrong and raises."""
    try:
        return entry.compute(*taken)
    except ZeroDivisionError:
        if SHAPE in entry.needs:
            raise
        return Absent("the definition divides by nil here")


def _because(need: str, reason: str) -> str:
    """Pass a reason on; where it came from is named once."""
    return reason if ": " in reason else f"{need}: {reason}"


def _as_value(entry: Parameter, found: Found) -> Value:
    if isinstance(found, Absent):
        return Value(None, entry.unit, entry.symbol, reason=found.reason)
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
        return Value(None, entry.unit, entry.symbol, reason=why)
    return Value(number, entry.unit, entry.symbol, warning=warning)
