"""Columns of a table of plates, and what any such table does: printing, choosing a row or a column.

Examples
--------
>>> from types import SimpleNamespace
>>> from assoc_hull.surface.plating.columns import attribute_getter, PlateColumn
>>> PlateColumn("area", "m2", "area", ".3f", attribute_getter("area")).printed(
...     SimpleNamespace(area=1e-14)
... )
'0.000'
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, Protocol, TypeVar

import attrs
import numpy as np

from assoc_hull.arguments import shown, shown_name
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError

__all__ = [
    "PlateColumn",
    "attribute_getter",
    "column_of",
    "plate_at",
    "printed_rows",
    "share_getter",
]

_NIL = 1e-12
"""Below this a number is printed as 0."""


class _Named(Protocol):
    @property
    def name(self) -> str: ...


Row = TypeVar("Row", bound=_Named)


@attrs.frozen
class PlateColumn:
    """A column of a table of plates.

    Attributes
    ----------
    name : str
        Its name in files and of `PlateTable.column`.
    unit : str
        Its unit; "" of words and of numbers without one.
    head : str
        What stands over it in print; "" of a column that is in files only.
    style : str
        The format of its numbers in print.
    value : callable
        What a plate has there.
    """

    name: str
    unit: str
    head: str
    style: str
    value: Callable[[Any], Any]

    def printed(self, plate: Any) -> str:
        """Write the value: a dash where there is none, 0 for what rounding leaves of nil."""
        value = self.value(plate)
        if isinstance(value, float) and abs(value) < _NIL:
            value = 0.0
        return "-" if value is None else format(value, self.style)


def share_getter(name: str) -> Callable[[Any], float]:
    """Give what takes a share of a plate, in per cent."""
    return lambda plate: 100.0 * float(getattr(plate.shares, name))


def attribute_getter(name: str) -> Callable[[Any], Any]:
    """Give what takes an attribute of a plate."""
    return lambda plate: getattr(plate, name)


def column_of(columns: Sequence[PlateColumn], rows: Sequence[Any], name: str) -> list[Any]:
    """Give what all plates have in a column.

    Raises
    ------
    UnknownNameError
        No such column.
    """
    wanted = shown_name(name)
    for each in columns:
        if each.name == wanted:
            return [each.value(plate) for plate in rows]
    raise UnknownNameError("column", wanted, tuple(each.name for each in columns))


def plate_at(rows: Sequence[Row], which: int | str, where: str) -> Row:
    """Give a plate by its number from 0, or by its name.

    Raises
    ------
    BadInputError, UnknownNameError, WrongTypeError
        No such number or name; a name that several have.
    """
    if isinstance(which, str):
        found = [plate for plate in rows if plate.name == which]
        if not found:
            raise UnknownNameError("plate", shown_name(which), tuple(plate.name for plate in rows))
        if len(found) > 1:
            what = f"{len(found)} plates are named {which!r}"
            raise BadInputError(what, where, "give the number of one")
        return found[0]
    if isinstance(which, bool) or not isinstance(which, int | np.integer):
        raise WrongTypeError(f"a plate is {shown(which)}", where, "give a number or a name")
    if not -len(rows) <= which < len(rows):
        remedy = f"give 0 to {len(rows) - 1}"
        raise BadInputError(f"there is no plate {shown(which)}", where, remedy)
    return rows[which]


def printed_rows(columns: Sequence[PlateColumn], rows: Sequence[Any]) -> Iterator[str]:
    """Write the columns that have a head: heads, units, a row a plate."""
    seen = [each for each in columns if each.head]
    body = [[each.printed(plate) for each in seen] for plate in rows]
    table = [[each.head for each in seen], [each.unit for each in seen], *body]
    wide = [max(map(len, column)) for column in zip(*table, strict=True)]
    for row in table:
        first, *others = (
            f"{text:<{width}}" if i == 0 else f"{text:>{width}}"
            for i, (text, width) in enumerate(zip(row, wide, strict=True))
        )
        yield "  ".join([first, *others]).rstrip()
