"""Tables of offsets: half-breadths by station and waterline, heights by station and buttock.

`read_offsets` reads comma-, semicolon- or tab-separated text in metres, millimetres or
normalised form (y/(B/2), z/T) into ship axes and reports whatever it had to assume, what
it mended and what looks wrong.

Examples
--------
>>> from assoc_hull.io.offsets.read import read_offsets
>>> text = '''# station 0 = AP
... station,wl_0,wl_3,wl_6
... 0,0,0,0.4
... 5,3.0,7.0,8.0
... 10,0,0,0
... '''
>>> table, report = read_offsets(text, unit="m", length=100.0, breadth=16.0)
>>> table.x.tolist(), table.half_breadth[1].tolist()
([0.0, 50.0, 100.0], [3.0, 7.0, 8.0])
>>> [note.kind for note in report.assumptions]
['station zero', 'station numbers']
"""

from __future__ import annotations

from pathlib import Path

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.io.offset_report import Note, Notebook, OffsetReport
from assoc_hull.io.offsets.build import build_table
from assoc_hull.io.offsets.hints import read_hints
from assoc_hull.io.offsets.sheet import Sheet, read_sheet
from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.io.offsets.units import check_argument, find_scale
from assoc_hull.io.tables.offset_text import read_text, split_blocks

__all__ = ["Note", "OffsetReport", "OffsetTable", "read_offsets"]


def read_offsets(
    path_or_text: str | Path,
    *,
    length: float | None = None,
    breadth: float | None = None,
    draught: float | None = None,
    unit: str = "auto",
    station_zero: str = "auto",
    name: str | None = None,
    buttocks: str | Path | None = None,
) -> tuple[OffsetTable, OffsetReport]:
    """Read a table of offsets.

    Parameters
    ----------
    path_or_text : str or Path
        A file, or the text itself (a string with a line break).
    length, breadth, draught : float or None
        Lpp, moulded breadth and design draught, m; they override what the comments say.
    unit : {"auto", "m", "mm", "normalised"}
        Unit of half-breadths, waterlines and heights; "normalised" is y/(B/2), z/T, x/Lpp.
    station_zero : {"auto", "ap", "fp"}
        Perpendicular of station 0, or of x = 0 where the file gives x.
    name : str or None
        Name of the table; by default the name of the file without its ending.
    buttocks : str, Path or None
        A second file or text with columns ``bt_<y>`` for the same stations; such a block may
        also follow the waterlines in the first.

    Returns
    -------
    OffsetTable, OffsetReport
        The table in ship axes, and every assumption, repair and suspicion.

    Raises
    ------
    BadInputError
        The input cannot be read, or cannot be read in one way only; the message names row,
        column, number and remedy.
    """
    for key, value in (("length", length), ("breadth", breadth), ("draught", draught)):
        check_argument(key, value)
    book = Notebook()
    text, source = read_text(path_or_text, book)
    comments, blocks = split_blocks(text, source, book)
    hints = read_hints(comments)
    if buttocks is not None:
        blocks += split_blocks(*read_text(buttocks, book), book)[1]
    sheets = [read_sheet(block, book) for block in blocks]
    main, extra = _sort_out(sheets, source)
    _refuse_negative(main)
    largest = float(np.nanmax(main.offsets, initial=0.0))
    broad = float(np.nanpercentile(main.offsets, 95))
    scale = find_scale(unit, largest, broad, hints, length, breadth, draught, book, source)
    table = build_table(main, extra, scale, hints, station_zero, book)
    default = Path(source).stem if source != "text" else "offsets"
    return attrs.evolve(table, name=default if name is None else name), book.report()


def _sort_out(sheets: list[Sheet], source: str) -> tuple[Sheet, Sheet | None]:
    mains = [sheet for sheet in sheets if sheet.columns.waterlines]
    extras = [sheet for sheet in sheets if not sheet.columns.waterlines]
    if len(mains) != 1 or len(extras) > 1:
        raise BadInputError(
            f"{len(mains)} block(s) hold waterlines and {len(extras)} do not",
            source,
            "give one block with columns wl_<height> and at most one with columns bt_<y>",
        )
    shape = mains[0].offsets.shape
    if min(shape) < 2:
        raise BadInputError(
            f"the table has {shape[0]} station(s) and {shape[1]} waterline(s)",
            source,
            "give at least two of each",
        )
    if not np.any(np.nan_to_num(mains[0].offsets) != 0.0):
        raise BadInputError("no half-breadth is above 0", source, "give half-breadths")
    return mains[0], extras[0] if extras else None


def _refuse_negative(sheet: Sheet) -> None:
    for i, j in np.argwhere(sheet.offsets < 0):
        column = sheet.columns.waterlines[j]
        raise BadInputError(
            f"the half-breadth {sheet.offsets[i, j]:g} is negative",
            sheet.where(int(i), column),
            "give half-breadths to port, 0 or more; leave the cell empty below the keel",
        )
