"""The offsets of two Series 60 parents, as their author published them.

F.H. Todd, "Series 60: Methodical Experiments with Models of Single-Screw Merchant Ships",
DTMB Report 1712, 1963. Length between perpendiculars 400 ft = 121.92 m, B/T = 2.5, L/B = 7.5
and 7.0 for the block coefficients 0.60 and 0.70.

Examples
--------
>>> from assoc_hull.shipped.series60_table import todd_table
>>> table, report = todd_table(0.70)
>>> table.name, table.half_breadth.shape, round(table.breadth, 3)
('Series 60 CB 0.70', (25, 8), 17.417)
"""

from __future__ import annotations

from importlib.resources import files

from assoc_hull.arguments import number
from assoc_hull.errors import BadInputError
from assoc_hull.io.offset_report import OffsetReport
from assoc_hull.io.offsets.read import read_offsets
from assoc_hull.io.offsets.table import OffsetTable

__all__ = ["LENGTH", "todd_table"]

LENGTH = 121.92
"""Length between perpendiculars of the published hulls: 400 ft in m."""

_FILES = {0.60: "series60_060.csv", 0.70: "series60_070.csv"}


def todd_table(cb: float) -> tuple[OffsetTable, OffsetReport]:
    """Give the published offsets of a Series 60 parent.

    Parameters
    ----------
    cb : float
        Block coefficient, 0.60 or 0.70.

    Returns
    -------
    OffsetTable, OffsetReport
        25 stations by 8 waterlines (0, .075, .25, .5, .75, 1, 1.25 and 1.5 T) in ship axes.

    Raises
    ------
    BadInputError
        There is no table for this block coefficient.

    Examples
    --------
    >>> from assoc_hull.shipped.series60_table import todd_table
    >>> round(float(todd_table(0.60)[0].half_breadth.max()), 3)
    8.128
    """
    name = _FILES.get(number(cb, "cb", "in series60"))
    if name is None:
        known = " and ".join(f"{value:.2f}" for value in _FILES)
        raise BadInputError(
            f"there is no Series 60 table of block coefficient {cb!r}",
            "argument cb",
            f"give one of {known}",
        )
    text = (files("assoc_hull.shipped") / "data" / name).read_text("utf-8")
    return read_offsets(text, length=LENGTH, name=f"Series 60 CB {cb:.2f}")
