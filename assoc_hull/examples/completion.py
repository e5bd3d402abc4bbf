"""A net from a table of offsets alone: what the table leaves open is completed by rule."""

from __future__ import annotations

from assoc_hull.edit.adopt import AdoptionReport
from assoc_hull.examples.contours import centre_profile, end_contours
from assoc_hull.examples.flats import flat_of_bottom, flat_of_side
from assoc_hull.io.offset_net import Completion, net_from_offsets
from assoc_hull.io.offset_table import OffsetTable
from assoc_hull.model.state import HullState

__all__ = ["net_from_table"]


def net_from_table(table: OffsetTable) -> tuple[HullState, AdoptionReport]:
    """Adopt a table of offsets; profile, ends and flats as for the Series 60 example.

    Parameters
    ----------
    table : OffsetTable
        Offsets in metres.

    Returns
    -------
    HullState, AdoptionReport

    Raises
    ------
    BadInputError
        A table that holds too little for a net.
    """
    stern, stem = end_contours(table)
    profile, kinds = centre_profile(table)
    border = flat_of_side(table).border
    side = border if len(border) else None
    return net_from_offsets(
        table, Completion(profile, kinds, stern, stem, flat_of_bottom(table), side)
    )
