"""A net from a table of offsets alone: what the table leaves open is completed by rule."""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.adopt import AdoptionReport
from assoc_hull.examples.contours import centre_profile, end_contours
from assoc_hull.examples.flats import flat_of_bottom, flat_of_side
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.offset_net import Completion, net_from_offsets
from assoc_hull.io.offset_table import OffsetTable
from assoc_hull.model.state import HullState
from assoc_hull.tolerance import Tolerances

__all__ = ["net_from_table", "widening"]

_WIDENS = 0.15


def net_from_table(
    table: OffsetTable, tolerances: Tolerances | None = None
) -> tuple[HullState, AdoptionReport]:
    """Adopt a table of offsets; profile, ends and flats as for the Series 60 example.

    Parameters
    ----------
    table : OffsetTable
        Offsets in metres.
    tolerances : Tolerances or None
        Defaults if None.

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
    side = widening(border) if len(border) else None
    completion = Completion(profile, kinds, stern, stem, flat_of_bottom(table), side)
    return net_from_offsets(table, completion, tolerances=tolerances)


def widening(border: FloatArray) -> FloatArray:
    """Let the flat of side widen upward, so that every plane passes its border cleanly.

    Parameters
    ----------
    border : (n, 3), m
        From the deck aft, down, forward along the lower side, up to the deck.

    Returns
    -------
    (n, 3), m
        From one point to the next upward at least 0.15 m wider to either side.
    """
    out = np.array(border)
    lowest = int(np.argmin(out[:, 2]))
    for i in range(lowest - 1, -1, -1):
        out[i, 0] = min(out[i, 0], out[i + 1, 0] - _WIDENS)
    for i in range(lowest + 1, len(out)):
        out[i, 0] = max(out[i, 0], out[i - 1, 0] + _WIDENS)
    return out
