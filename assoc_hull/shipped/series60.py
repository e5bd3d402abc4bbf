"""Series 60 parents CB 0.60 and 0.70: Todd's table of offsets, and the nets adopted from it.

`todd_table` gives the offsets as their author published them, scaled to a length of ship;
`series60_net` adopts them, with profile, ends and flats by rule, and adds waterlines, stations
and buttocks. Source: F.H. Todd, "Series 60: Methodical Experiments with Models of Single-Screw
Merchant Ships", DTMB Report 1712, 1963.
"""

from __future__ import annotations

from importlib.resources import files

import attrs

from assoc_hull.arguments import number
from assoc_hull.edit.adoption.adopt_lines import AdoptionReport
from assoc_hull.edit.document import Document
from assoc_hull.edit.lines.add_line import add_line
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError
from assoc_hull.io.offsets.complete_table import net_from_table
from assoc_hull.io.offsets.read import read_offsets
from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.io.reports import OffsetReport
from assoc_hull.model.tables import HullState
from assoc_hull.tolerance import Tolerances

__all__ = [
    "LENGTH",
    "series60",
    "series60_adopted",
    "series60_net",
    "todd_table",
]

# --------------------------------------------------------------------------------------
# The offsets of two Series 60 parents, as their author published them.
#
# F.H. Todd, "Series 60: Methodical Experiments with Models of Single-Screw Merchant Ships",
# DTMB Report 1712, 1963. Length between perpendiculars 400 ft = 121.92 m, B/T = 2.5, L/B = 7.5
# and 7.0 for the block coefficients 0.60 and 0.70.

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
    >>> from assoc_hull.shipped.series60 import todd_table
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


# --------------------------------------------------------------------------------------
# Series 60 parents CB 0.60 and 0.70 as nets, from Todd's table of offsets.
#
# F.H. Todd, "Series 60: Methodical Experiments with Models of Single-Screw Merchant Ships",
# DTMB Report 1712, 1963.

_WATERLINES = (
    0.15, 0.20, 0.30, 0.35, 0.42, 0.58, 0.625, 0.66, 0.84, 0.92, 1.08, 1.16, 1.33, 1.41,
)  # fmt: skip
_STATIONS = (
    0.25, 0.75, 1.25, 1.75, 2.5, 3.5, 4.5, 5.5, 14.5, 15.5, 16.5, 17.5, 18.25, 18.75, 19.25, 19.75,
)  # fmt: skip
_BUTTOCKS = (0.06, 0.12, 0.20, 0.28, 0.36, 0.44, 0.52, 0.60, 0.68, 0.76, 0.84, 0.92)


def series60_adopted(cb: float = 0.70) -> tuple[HullState, AdoptionReport]:
    """Adopt the table alone: 25 stations, 6 waterlines, the boundary curves.

    Completed beyond the table, at Lpp 121.92 m:

    - the centre-line profile: stem and stern contour run through the places where the
      table's half-breadths end; the overhang abaft the AP is closed so that the waterline
      z = T ends at -0.01675 Lpp (LWL/Lpp 1.01675);
    - the deck edge: level, the table's waterline 1.5 T;
    - the flat of bottom: its border is the table's WL 0, whose plane touches the hull;
    - the flat of side: y = B/2 where the table says 1.0000; its border is made to widen
      upward by at least 0.15 m from one waterline to the next.

    Parameters
    ----------
    cb : float
        0.60 or 0.70.

    Returns
    -------
    HullState, AdoptionReport

    Raises
    ------
    BadInputError
        Another block coefficient.
    """
    table = todd_table(cb)[0]
    # The report counts its stations from the FP; the lines of this hull are counted from the AP.
    from_ap = attrs.evolve(table, station=20.0 * table.x / table.length)
    return net_from_table(from_ap, _TOLERANCES, deck="closed")


def series60(cb: float = 0.70) -> HullState:
    """Make the net of 41 stations, 20 waterlines and 12 buttocks.

    Lines the table does not have are cut from those it has. Sections are named by station
    (AP = 0, FP = 20), waterlines by z/T, buttocks by y/(B/2).

    Parameters
    ----------
    cb : float
        0.60 or 0.70.

    Returns
    -------
    HullState
        Lpp 121.92 m; completed as told under `series60_adopted`.

    Raises
    ------
    BadInputError
        Another block coefficient.
    """
    return series60_net(cb)[0]


def series60_net(cb: float = 0.70) -> tuple[HullState, AdoptionReport]:
    """Make the net of `series60`, with the report of how the table was adopted.

    Parameters
    ----------
    cb : float
        0.60 or 0.70.

    Returns
    -------
    HullState, AdoptionReport

    Raises
    ------
    BadInputError
        Another block coefficient.
    """
    state, report = series60_adopted(cb)
    document, ship = Document(state), state.particulars
    for group, prefix, parts, unit in (
        ("waterlines", "WL", _WATERLINES, ship.draught),
        ("sections", "ST", _STATIONS, ship.length / 20.0),
        ("buttocks", "BTK", _BUTTOCKS, ship.breadth / 2.0),
    ):
        with Transaction(document, f"cut {group}") as edit:
            for part in parts:
                add_line(edit, group, part * unit, f"{prefix} {part:g}", _KEEP)
    return state, report


_TOLERANCES = Tolerances(spacing=0.35, turn_spacing=0.3)
"""Three lines of this dense net often pass near one place; an edit of centimetres then lets
driven crossings slide by decimetres along a buttock, so they must not stand too close."""

_KEEP = 0.6e-3
"""How far (m) one crossing of a line that is cut may move a line that was there."""
