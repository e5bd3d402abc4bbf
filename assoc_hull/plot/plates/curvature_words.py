"""What is said of curvature regions beside their picture: areas, band, lines, notes, colours."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.plates.plate_entries import REGIONS, Picture, area_words
from assoc_hull.plot.plates.plate_paint import BORDER, SIGNS, TINTS, hatched
from assoc_hull.plot.sheet.form_flow import wrapped
from assoc_hull.plot.sheet.paper import MARGIN
from assoc_hull.plot.sheet.pens import LINE
from assoc_hull.plot.sheet.sheet import Sheet
from assoc_hull.plot.sheet.title_block import ROW, title_block

__all__ = ["BLOCK", "legend", "region_block", "strip"]

BLOCK = 84.0
"""Width of the block, mm at A3."""

_BANDED = {1: "K > K0", 0: "|K| ≤ K0", -1: "K < −K0"}
_SHARP = {1: "K > 0", 0: "K = 0", -1: "K < 0"}
_MOST = 16  # lines of notes


def region_block(sheet: Sheet, picture: Picture, title: str) -> float:
    """Write what holds for the whole picture into the right upper corner; give the lower edge."""
    paper, factor = sheet.paper, sheet.paper.factor
    corner = (paper.width - MARGIN * factor, paper.height - MARGIN * factor)
    room = (BLOCK - 7.0) * factor
    lines = [line for words in picture.notes for line in wrapped(sheet, words, room, 1.0)]
    if len(lines) > _MOST:
        lines = [*lines[:_MOST], "... and more, in the notes of the result"]
    return title_block(sheet, corner, BLOCK * factor, title, picture.facts, lines)


def legend(sheet: Sheet, picture: Picture, top: float, *, filled: bool = True) -> float:
    """Draw the colours with what they mean and how large each region is; give the lower edge.

    Of a continuous map, the colours of regions are left out (`filled` is false).
    """
    factor, areas = sheet.paper.factor, picture.areas
    right = sheet.paper.width - MARGIN * factor
    left, step = right - (BLOCK - 3.0) * factor, 1.35 * ROW * factor
    where = _BANDED if picture.banded else _SHARP
    found = {1: areas.positive, 0: areas.zero, -1: areas.negative}
    y = top - 1.1 * step
    for sign, area in found.items():
        _swatch(sheet, left, y, sign, filled)
        _row(sheet, left, y, f"{REGIONS[sign]}, {where[sign]}", area, areas.total)
        y -= step
    hatched(sheet, _rectangle(left, y, factor), "legend/unresolved")
    _row(sheet, left, y, "unresolved", areas.unresolved, areas.total)
    return _line(sheet, left, y - step, "K = K0 and K = −K0" if picture.banded else "K = 0")


def _line(sheet: Sheet, left: float, y: float, words: str) -> float:
    factor = sheet.paper.factor
    sheet.rule((left, y), (left + 7.0 * factor, y), BORDER, "legend/line")
    sheet.text((left + 9.0 * factor, y), words, size=1.1, across="left", name="label/legend/line")
    return y - 0.95 * ROW * factor


def _rectangle(left: float, y: float, factor: float) -> FloatArray:
    wide, tall = 7.0 * factor, 2.1 * factor
    return np.array([(left, y - tall), (left + wide, y - tall), (left + wide, y + tall),
                     (left, y + tall)])  # fmt: skip


def _swatch(sheet: Sheet, left: float, y: float, sign: int, filled: bool) -> None:
    factor = sheet.paper.factor
    ring = _rectangle(left, y, factor)
    if filled:
        sheet.axes.fill(ring[:, 0], ring[:, 1], color=TINTS[sign], linewidth=0.0, zorder=1.5,
                        gid=f"legend/{sign}")  # fmt: skip
    sheet.line(np.concatenate([ring, ring[:1]]), LINE, "legend")
    place = (left + 3.5 * factor, y)
    sheet.text(place, SIGNS[sign], size=1.5, bold=True, name=f"label/legend/{sign}")


def _row(sheet: Sheet, left: float, y: float, words: str, area: float, total: float) -> None:
    factor = sheet.paper.factor
    right = sheet.paper.width - (MARGIN + 3.0) * factor
    share = 100.0 * area / total if total > 0.0 else 0.0
    sheet.text((left + 9.0 * factor, y), words, size=1.1, across="left", name="label/legend")
    sheet.text((right - 15.0 * factor, y), area_words(area), size=1.1, across="right",
               name="label/legend/area")  # fmt: skip
    sheet.text((right, y), f"{share:.2f} %", size=1.1, across="right", name="label/legend/share")


def strip(sheet: Sheet, picture: Picture, place: tuple[float, float], colour: str) -> None:
    """Explain the colours in a line from a place to the right, without areas."""
    factor, (x, y) = sheet.paper.factor, place
    where = _BANDED if picture.banded else _SHARP
    for sign in (1, 0, -1):
        _swatch(sheet, x, y, sign, True)
        words = f"{REGIONS[sign]}, {where[sign]}"
        sheet.text((x + 9.0 * factor, y), words, across="left", name="label/legend")
        x += 15.0 * factor + sheet.width(words)
    hatched(sheet, _rectangle(x, y, factor), "legend/unresolved")
    words = "unresolved"
    sheet.text((x + 9.0 * factor, y), words, across="left", name="label/legend")
    x += 15.0 * factor + sheet.width(words)
    if any(entry.axis is not None for entry in picture.entries):
        sheet.text((x, y), "dash-dotted: roll axis", across="left", colour=colour,
                   name="label/legend")  # fmt: skip
