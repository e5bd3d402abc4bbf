r"""Names of entities of an IGES file, and the unit of their lengths.

Source: IGES 5.3 (US PRO, 1996), sections 2.2.4.3 (units) and 4.104 (names).

Examples
--------
>>> from assoc_hull.io.iges.names import readable
>>> readable("b\xc3\xbcrge")
'bürge'
"""

from __future__ import annotations

import contextlib

from assoc_hull.errors import BadInputError
from assoc_hull.io.iges.file import UNITS, IgesFile
from assoc_hull.io.iges.record import Record
from assoc_hull.io.units import METRES, unit_note

__all__ = ["name_property", "readable", "scale_note", "unit_of"]


def unit_of(file: IgesFile, unit: str | None) -> tuple[str, float, tuple[str, ...]]:
    """Settle the unit: its name, the length of one of the file in m, and what is to be told.

    Parameters
    ----------
    file : IgesFile
        The file.
    unit : str or None
        The unit that was asked for; None: as the file says.

    Raises
    ------
    BadInputError
        Neither tells one.
    """
    if unit is not None:
        told = UNITS[file.unit][0] if file.metres is not None else None
        return unit, METRES[unit] / file.scale, unit_note(file.source, told, unit)
    if file.metres is None:
        what = f"the file tells no unit of length (its flag is {file.unit})"
        raise BadInputError(what, f"in {file.source}", f"give unit: {', '.join(METRES)}")
    return UNITS[file.unit][0], file.metres / file.scale, ()


def scale_note(file: IgesFile) -> tuple[str, ...]:
    """Tell of a scale of the model, if there is one."""
    if file.scale == 1.0:
        return ()
    return (f"{file.source} has a model scale of {file.scale:g}: lengths are divided by it.",)


def readable(name: str) -> str:
    """Give a name as it was meant: the file is taken byte by byte, and a letter may be two."""
    with contextlib.suppress(UnicodeError):
        name = name.encode("latin-1").decode("utf-8")
    return "".join(letter for letter in name if letter.isprintable()).strip()


def name_property(file: IgesFile, record: Record, after: int) -> str:
    """Give the name that a property, entity 406 of form 15, gives an entity; empty if none.

    Parameters
    ----------
    file : IgesFile
        The file.
    record : Record
        Of the entity.
    after : int
        Where pointers to groups and properties begin in it.

    Raises
    ------
    BadInputError
        The pointers are damaged.
    """
    if len(record) <= after + 1:
        return ""
    groups = record.count(after, "the number of groups", len(file.entries))
    if len(record) <= after + 1 + groups:
        return ""
    count = record.count(after + 1 + groups, "the number of properties", len(file.entries))
    for each in record.pointers(after + 2 + groups, count, "the properties"):
        entry = file.entries.get(each)
        if entry is not None and (entry.kind, entry.form) == (406, 15):
            return file.record(each).text(2)
    return ""
