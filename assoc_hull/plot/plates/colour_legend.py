"""What stands beside a map: the bar of its colours, the legend of regions, areas and notes.

Colour bars run from -1 to 1 through zero. The legend says what each colour means and how large
each region is; the block holds what is true of the whole picture.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.plates.paint_tiles import BORDER, SIGNS, TINTS, hatch_outline
from assoc_hull.plot.plates.plate_picture import REGIONS, PlatePicture, area_words
from assoc_hull.plot.sheet.labels import wrap_words
from assoc_hull.plot.sheet.paper import LINE, MARGIN
from assoc_hull.plot.sheet.sheet_figure import Sheet
from assoc_hull.plot.sheet.title_block import ROW, title_block

if TYPE_CHECKING:
    from assoc_hull.plot.plates.plate_layout import SheetArea

__all__ = [
    "BLOCK",
    "CURVATURE",
    "STRAIN",
    "colour_bar",
    "legend",
    "legend_strip",
    "region_block",
    "shades",
]

# --------------------------------------------------------------------------------------
# Colours for values on both sides of nil, and the bar that says which is which.

CURVATURE = ("#1f5e9e", "#74a9d8", "#e6f0d4", "#d5604f", "#96281b")
"""From saddle over developable to convex."""

STRAIN = ("#4a2a82", "#9b86c4", "#f6f5f3", "#eda55d", "#a8500a")
"""From shrinking over none to stretching; not to be taken for regions."""

_STEPS = 96


def shades(value: FloatArray, palette: Sequence[str]) -> FloatArray:
    """Give colours (..., 3) of values from -1 to 1; what lies beyond has the last colour.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.plot.plates.colour_legend import shades
    >>> shades(np.array([-5.0, 0.0]), ("#000000", "#ffffff", "#ff0000")).tolist()
    [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]]
    """
    from matplotlib.colors import to_rgb

    colours = np.array([to_rgb(each) for each in palette])
    at = np.linspace(-1.0, 1.0, len(colours))
    found = [np.interp(value, at, colours[:, k]) for k in range(3)]
    return np.stack(found, axis=-1)


def colour_bar(
    sheet: Sheet,
    field: SheetArea,
    palette: Sequence[str],
    marks: Sequence[tuple[float, str]],
    title: str,
) -> None:
    """Draw a level bar from -1 to 1 with marks below it and a title above.

    Parameters
    ----------
    sheet : Sheet
        Where to draw.
    field : Field
        The bar itself.
    palette : sequence of str
        The colours.
    marks : sequence of (float, str)
        Values from -1 to 1, and what is written there.
    title : str
        Above it.
    """
    from matplotlib.collections import PolyCollection

    factor = sheet.paper.factor
    edge = np.linspace(field.left, field.right, _STEPS + 1)
    low, top = np.full(_STEPS, field.low), np.full(_STEPS, field.top)
    x = np.stack([edge[:-1], edge[1:], edge[1:], edge[:-1]], axis=-1)
    y = np.stack([low, low, top, top], axis=-1)
    colour = shades(np.linspace(-1.0, 1.0, _STEPS), palette)
    sheet.axes.add_collection(
        PolyCollection(cast("Any", np.stack([x, y], axis=-1)), facecolors=colour, edgecolors=colour,
                       linewidths=0.2, zorder=1.5, gid="bar"),
        autolim=False,
    )  # fmt: skip
    ring = [(field.left, field.low), (field.right, field.low), (field.right, field.top),
            (field.left, field.top), (field.left, field.low)]  # fmt: skip
    sheet.line(np.array(ring), LINE, "bar/edge")
    for value, words in marks:
        across = 0.5 * (field.left + field.right + value * (field.right - field.left))
        sheet.rule((across, field.low), (across, field.low - 0.9 * factor), LINE, "bar/mark")
        sheet.text((across, field.low - 1.4 * factor), words, up="top", name="label/bar")
    sheet.text((field.left, field.top + 1.2 * factor), title, across="left", up="bottom",
               name="label/bar/title")  # fmt: skip


# --------------------------------------------------------------------------------------
# What is said of curvature regions beside their picture: areas, band, lines, notes, colours.

BLOCK = 84.0
"""Width of the block, mm at A3."""

_BANDED = {1: "K > K0", 0: "|K| ≤ K0", -1: "K < −K0"}
_SHARP = {1: "K > 0", 0: "K = 0", -1: "K < 0"}
_MOST = 16  # lines of notes


def region_block(sheet: Sheet, picture: PlatePicture, title: str) -> float:
    """Write what holds for the whole picture into the right upper corner; give the lower edge."""
    paper, factor = sheet.paper, sheet.paper.factor
    corner = (paper.width - MARGIN * factor, paper.height - MARGIN * factor)
    room = (BLOCK - 7.0) * factor
    lines = [line for words in picture.notes for line in wrap_words(sheet, words, room, 1.0)]
    if len(lines) > _MOST:
        lines = [*lines[:_MOST], "... and more, in the notes of the result"]
    return title_block(sheet, corner, BLOCK * factor, title, picture.facts, lines)


def legend(sheet: Sheet, picture: PlatePicture, top: float, *, filled: bool = True) -> float:
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
    hatch_outline(sheet, _rectangle(left, y, factor), "legend/unresolved")
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


def legend_strip(
    sheet: Sheet, picture: PlatePicture, place: tuple[float, float], colour: str
) -> None:
    """Explain the colours in a line from a place to the right, without areas."""
    factor, (x, y) = sheet.paper.factor, place
    where = _BANDED if picture.banded else _SHARP
    for sign in (1, 0, -1):
        _swatch(sheet, x, y, sign, True)
        words = f"{REGIONS[sign]}, {where[sign]}"
        sheet.text((x + 9.0 * factor, y), words, across="left", name="label/legend")
        x += 15.0 * factor + sheet.width(words)
    hatch_outline(sheet, _rectangle(x, y, factor), "legend/unresolved")
    words = "unresolved"
    sheet.text((x + 9.0 * factor, y), words, across="left", name="label/legend")
    x += 15.0 * factor + sheet.width(words)
    if any(entry.axis is not None for entry in picture.entries):
        sheet.text((x, y), "dash-dotted: roll axis", across="left", colour=colour,
                   name="label/legend")  # fmt: skip
