"""Units of length of surface files.

Examples
--------
>>> from assoc_hull.io.units import checked_unit, METRES
>>> METRES[checked_unit("mm", "in read_surfaces")]
0.001
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from assoc_hull.arguments import choice, positive
from assoc_hull.errors import BadInputError

__all__ = [
    "METRES",
    "check_particular",
    "checked_unit",
    "refuse_other_unit",
    "unit_note",
]


def check_particular(name: str, value: float | None) -> None:
    """Refuse a particular that is not a positive number.

    Raises
    ------
    BadInputError
        The value is nil, negative, NaN or infinite.
    """
    if value is not None:
        positive(value, name, "as an argument")


METRES: Mapping[str, float] = MappingProxyType(
    {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "ft": 0.3048, "in": 0.0254}
)
"""What can be asked for, and its length in m."""


def checked_unit(unit: object, where: str) -> str:
    """Take a unit of length.

    Raises
    ------
    BadInputError
        Anything else.
    """
    return choice(unit, "unit", tuple(METRES), where)


def refuse_other_unit(source: str, told: str | None, unit: str | None) -> None:
    """Refuse a unit that was asked for against the one that a file declares.

    Raises
    ------
    BadInputError
        They differ.
    """
    if told is None or unit is None or told == unit:
        return
    times = METRES[unit] / METRES[told]
    raise BadInputError(
        f"the unit {unit!r} was given and the file says that its unit is {told!r}",
        f"in {source}",
        f"leave the unit out; if the file is wrong, correct it there or give scale={times:.6g}",
    )


def unit_note(source: str, told: str | None, unit: str) -> tuple[str, ...]:
    """Tell that a unit was asked for which is not the one of the file, if so."""
    if told is None or told == unit:
        return ()
    return (f"{source} says that its unit is {told}; it is read in {unit}, as asked.",)
