"""The doctor of offsets for a file: reads a table as printed, tells its slips, writes a mended one.

Neither unit nor length of the ship need be known: half-breadths are judged in their own unit.
"""

from __future__ import annotations

import os
from pathlib import Path

import attrs

from assoc_hull.arguments import file_path, flag, integer, regular_file
from assoc_hull.errors import BadInputError
from assoc_hull.fairing.offsets_doctor import DoctorReport, examine
from assoc_hull.io.offsets.mend_table import write_mended
from assoc_hull.io.offsets.read import read_printed
from assoc_hull.io.open_databases import is_hull_file

__all__ = ["doctor"]

_MOST_LISTED = 1000


def doctor(
    path: str | os.PathLike[str],
    *,
    top: int = 10,
    centre: float | str | None = None,
    mend: str | os.PathLike[str] | None = None,
    replace: bool = False,
) -> DoctorReport:
    r"""Look for slips of the hand in a table of offsets, before a hull is made of it.

    Each half-breadth is judged by the battens through five neighbouring cells along its station
    and its waterline, and by what these do on the lines beside. A number with a score above 15 is
    called a slip; beside the number that its neighbours ask for stand up to three that one slip
    makes of the printed one: two digits exchanged, one digit other, decimal point, the cell beside.
    Nothing is changed. A run of cells shorter than five, heights of buttocks, keel and deck are not
    looked at.

    The batten is lifted off a point as in the loft; the likelihood is that of Cauchy's
    distribution: P.J. Huber, "Robust Statistics", Wiley, 1981.

    Parameters
    ----------
    path : path or str
        A table of offsets (CSV, TSV, XLSX), or its text, with line breaks. Units, length and
        draught need not be known.
    top : int
        So many findings are listed at least, those that are no slips after those that are.
    centre : float, str or None
        From where half-breadths of one of two hulls are counted, as for `assoc_hull.read`.
    mend : path or None
        Where to write the table with all slips put right, each to the first number of one slip, or
        to the one that its neighbours ask for; comments above it list every change. A table without
        a slip is written as it is.
    replace : bool
        Write over a file at `mend`; the table itself is never written over.

    Returns
    -------
    DoctorReport
        With ``findings``, ``alarms``, ``remarks``, ``unchecked``; as text, all of them.

    Raises
    ------
    BadInputError
        The file cannot be read or is no table of offsets; `mend` is the table itself, or there is
        a file and `replace` is not given; so many slips that whole lines must be wrong.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> rows = [[i, *(round(50 * i * (10 - i) * (1 - (6 - j) ** 2 / 50)) for j in range(7))]
    ...         for i in range(11)]
    >>> rows[4][4] = 948  # for 984
    >>> text = "station,wl_0,wl_1,wl_2,wl_3,wl_4,wl_5,wl_6"
    >>> [slip] = ah.doctor("\n".join([text, *(",".join(map(str, row)) for row in rows)])).alarms
    >>> slip.station, slip.waterline, slip.printed, slip.proposed, slip.numbers[0].slip
    ('4', '3', '948', '984', 'two digits exchanged')
    """
    count = integer(top, "top", "in doctor", least=0, most=_MOST_LISTED)
    over = flag(replace, "replace", "in doctor")
    given = path if isinstance(path, str) and "\n" in path else _file(path)
    sheet, printed = read_printed(given, centre)
    found = examine(printed, count)
    if mend is None:
        return found
    target = file_path(mend, "in doctor, mend")
    if found.overrun:
        raise BadInputError(
            f"{len(found.alarms)} slips are called and more are there: whole rows or columns are "
            "wrong", f"in {found.name}", "put these right by hand; nothing was written",
        )  # fmt: skip
    write_mended(given, target, sheet, found.alarms, centre, replace=over)
    return attrs.evolve(found, written=target)


def _file(path: str | os.PathLike[str]) -> Path:
    file = regular_file(Path(file_path(path, "in doctor")))
    if is_hull_file(file):
        raise BadInputError(
            "this is a hull and no table of offsets", f"at {file}",
            "ask the hull itself: assoc_hull.open(...).doctor()",
        )  # fmt: skip
    return file
