"""A table of one of two hulls, of which half-breadths are counted from the ship's centre plane.

Such a table has the outer side alone: at both ends all waterlines come in to the centre plane of
the demihull, not to 0. It is refused with that place, and read with ``centre=`` so that they are
half-breadths of the demihull.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.arguments import number
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.offsets.sheet import OffsetSheet
from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.io.reports import Notebook

__all__ = ["about_centre", "deck_about_centre"]

_SAME = 1e-3
"""Ends this part of the greatest half-breadth apart are one place."""

_OFF, _FULLER = 0.05, 1.05
"""The centre plane is this part of the greatest half-breadth off; the ship is this much broader."""


def about_centre(
    sheet: OffsetSheet, centre: float | str | None, source: str, book: Notebook
) -> OffsetSheet:
    """Count half-breadths from a centre plane, in the unit of the table, or find that they must be.

    Raises
    ------
    BadInputError
        Half-breadths of one of two hulls and no centre; a centre with a unit, or inside of which
        half-breadths lie.
    """
    if centre is None:
        place = _common_end(sheet)
        if place is not None:
            raise BadInputError(
                f"there are two hulls side by side: at both ends all half-breadths come in to "
                f"{place:g}, not to 0", source,
                f"give one demihull with centre={place:g}; if this is one hull with blunt ends, "
                "centre=0",
            )  # fmt: skip
        return sheet
    off = _in_unit(centre)
    if off == 0.0:
        return sheet
    # Digits as printed, so that offsets on a flat stay equal.
    y = np.round(sheet.offsets - off, 10)
    slack = _SAME * float(np.nanmax(sheet.offsets, initial=0.0))
    if float(np.nanmin(y, initial=0.0)) < -slack:
        i, j = np.unravel_index(int(np.nanargmin(y)), y.shape)
        label = sheet.columns.waterlines[int(j)].label
        raise BadInputError(
            f"the half-breadth {sheet.offsets[i, j]:g} lies inside centre={off:g}",
            f"{source}, station {sheet.labels[int(i)]}, column {label!r}",
            "give the centre plane of the demihull, to whose outer side half-breadths go",
        )  # fmt: skip
    what = (
        f"half-breadths are counted from y = {off:g} of the table, the centre plane of one of two "
        "hulls; its inner side is the image of the outer"
    )
    book.assume("one hull", "the table", what, off)
    y = np.maximum(y, 0.0)
    # A waterline that is all in the centre plane tells no digits: it has those of the others.
    digits, none = sheet.half_unit.copy(), ~(np.nan_to_num(y) > 0.0).any(axis=0)
    if none.any() and not none.all():
        digits[none] = digits[~none].min()
    return attrs.evolve(sheet, offsets=y, half_unit=digits)


def deck_about_centre(table: OffsetTable, off: float) -> OffsetTable:
    """Count half-breadths of the deck edge from a centre plane, m."""
    if table.deck_half_breadth is None or off == 0.0:
        return table
    return attrs.evolve(table, deck_half_breadth=table.deck_half_breadth - off)


def _in_unit(centre: float | str) -> float:
    if isinstance(centre, str):
        try:
            return float(centre)
        except ValueError:
            raise BadInputError(
                f"centre is {centre!r}", "for a table of offsets",
                "give a number in the unit of its half-breadths",
            ) from None  # fmt: skip
    return number(centre, "centre", "as an argument")


def _common_end(sheet: OffsetSheet) -> float | None:
    """Give the half-breadth to which all waterlines come in at both ends, if it is one above 0."""
    y = sheet.offsets[np.argsort(sheet.place, kind="stable")]
    known = y[np.isfinite(y).any(axis=1)]
    if len(known) < 5:
        return None
    ends: FloatArray = np.concatenate([known[0], known[-1]])
    ends = ends[np.isfinite(ends)]
    most, place = float(np.nanmax(y)), float(np.median(ends))
    apart = max(_SAME * most, 2.0 * float(sheet.half_unit.max()))
    same = bool((np.abs(ends - place) <= apart).all())
    outside = float(np.nanmin(y)) >= place - apart
    off = place > _OFF * most and most > _FULLER * place
    return place if same and outside and off else None
