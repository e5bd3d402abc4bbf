"""An entry of the catalogue of form parameters.

An entry is a function with a description. What the function takes is told by `needs`: values of
other entries, by symbol, or `SHAPE`, the hull itself at its floating position. So a formula is
written once and serves a measured hull as well as printed values of a ship.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Literal, get_args

import attrs

from assoc_hull.analysis.form.value import Found
from assoc_hull.arguments import choice

__all__ = ["SHAPE", "Parameter", "Table", "entries_in", "parameter"]

SHAPE = "shape"
"""Among `needs`: the `assoc_hull.analysis.form.shape.Shape`."""

Table = Literal["particulars", "hydrostatic", "hull form", "bulb and resistance", "measures"]
"""Part of the catalogue: what is given, Tables 3 and 4 of Son and Kim (2008), what others use,
and what only serves other entries."""


@attrs.frozen(eq=False)
class Parameter:
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
    compute: Callable[..., Found]


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
) -> Callable[[Callable[..., Found]], Parameter]:
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

    def entry(compute: Callable[..., Found]) -> Parameter:
        return Parameter(
            symbol, name, unit, table, definition, datum, source, ittc, needs, digits, compute
        )

    return entry


def entries_in(names: Mapping[str, object]) -> tuple[Parameter, ...]:
    """Give the entries among the names of a module, in the order in which they stand there."""
    return tuple(each for each in names.values() if isinstance(each, Parameter))
