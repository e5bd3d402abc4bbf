"""A column of a table of plates: its name, unit, and how it is printed.

Examples
--------
>>> from types import SimpleNamespace
>>> from assoc_hull.surface.plate_column import Column, own
>>> Column("area", "m2", "area", ".3f", own("area")).printed(SimpleNamespace(area=1e-14))
'0.000'
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import attrs

__all__ = ["Column", "own", "share"]

_NIL = 1e-12
"""Below this a number is printed as 0."""


@attrs.frozen
class Column:
    """A column of a table of plates.

    Attributes
    ----------
    name : str
        Its name in files and of `Plates.column`.
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


def share(name: str) -> Callable[[Any], float]:
    """Give what takes a share of a plate, in per cent."""
    return lambda plate: 100.0 * float(getattr(plate.shares, name))


def own(name: str) -> Callable[[Any], Any]:
    """Give what takes an attribute of a plate."""
    return lambda plate: getattr(plate, name)
