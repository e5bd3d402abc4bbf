"""A net from a table of offsets alone: what the table leaves open is completed by rule."""

from __future__ import annotations

import attrs

from assoc_hull.edit.adoption.report import AdoptionReport
from assoc_hull.errors import BadInputError
from assoc_hull.io.offsets.border import fair_border
from assoc_hull.io.offsets.contours import centre_profile, end_contours
from assoc_hull.io.offsets.flats import flat_of_bottom, flat_of_side
from assoc_hull.io.offsets.lines import net_of_lines
from assoc_hull.io.offsets.net import Completion, net_from_offsets, particulars_of_table
from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.model.state import HullState
from assoc_hull.tolerance import Tolerances

__all__ = ["net_from_table"]


def net_from_table(
    table: OffsetTable, tolerances: Tolerances | None = None, *, deck: str = "open"
) -> tuple[HullState, AdoptionReport]:
    """Adopt a table of offsets; profile, ends and flats as for the Series 60 example.

    A table that these rules do not fit, as of a rising keel, a bulb or a bottom without a flat,
    is adopted as it stands: its lines, and no profile. The first note tells why.

    Parameters
    ----------
    table : OffsetTable
        Offsets in metres.
    tolerances : Tolerances or None
        Defaults if None.
    deck : {"open", "closed"}
        Closed: there is a deck between the deck edges; a table does not tell.

    Returns
    -------
    HullState, AdoptionReport

    Raises
    ------
    BadInputError
        A table that holds too little for a net, or another word for the deck.
    """
    ship = particulars_of_table(table, deck)
    try:
        completion = _completion(table)
    except BadInputError as error:
        state, report = net_of_lines(table, ship, tolerances)
        note = f"profile, ends and flats are left open: {error.what}"
        return state, attrs.evolve(report, notes=(note, *report.notes))
    return net_from_offsets(table, completion, ship, tolerances)


def _completion(table: OffsetTable) -> Completion:
    stern, stem = end_contours(table)
    profile, kinds = centre_profile(table)
    border = flat_of_side(table).border
    side = fair_border(table, border) if len(border) else None
    return Completion(profile, kinds, stern, stem, flat_of_bottom(table), side)
