"""A chart on a sheet: a field with level and upright lines, beside the block of particulars."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.record import HydrostaticHeader
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.sheet.paper import GRID, LINE, MARGIN, WATER, Pen
from assoc_hull.plot.sheet.sheet_figure import Sheet
from assoc_hull.plot.sheet.title_block import BLOCK, frame, title_block

__all__ = [
    "Chart",
    "ChartScale",
    "chart_block",
    "chart_on",
    "level_grid",
    "scale_to",
    "smooth_course",
    "upright_grid",
]

_LEFT, _RIGHT, _ABOVE = 16.0, 9.0, 14.0  # of the field, for labels, mm at A3
_STEPS = (1.0, 2.0, 2.5, 5.0)


@attrs.frozen
class ChartScale:
    """From values to millimetres along one side of a field.

    Attributes
    ----------
    low, high, step : float
        Values at both ends, and between two marks.
    start, size : float, mm
        Where the scale begins, and its length.
    """

    low: float
    high: float
    step: float
    start: float
    size: float

    def at(self, value: FloatArray | float) -> FloatArray:
        """Give the places of values, mm."""
        found: FloatArray = self.start + self.size * (np.asarray(value) - self.low) / (
            self.high - self.low
        )
        return found

    @property
    def marks(self) -> FloatArray:
        """The values that are marked."""
        first = np.ceil(self.low / self.step - 1e-9)
        last = np.floor(self.high / self.step + 1e-9)
        return self.step * np.arange(first, last + 1.0) + 0.0

    def word(self, value: float) -> str:
        """Give a mark as it is written."""
        digits = max(0, int(-np.floor(np.log10(self.step) + 1e-9)))
        digits += round(self.step * 10**digits, 6) % 1.0 != 0.0
        return f"{value:.{digits}f}"


def scale_to(
    low: float, high: float, start: float, size: float, marks: int, *, whole: bool = True
) -> ChartScale:
    """Choose a scale that holds two values, with about so many marks at round numbers.

    Parameters
    ----------
    low, high : float
        The values.
    start, size : float, mm
        Where the scale lies.
    marks : int
        At most so many steps between the two.
    whole : bool
        The scale begins and ends at marks.

    Examples
    --------
    >>> from assoc_hull.plot.sheet.chart import scale_to
    >>> scale_to(3.2, 17.9, 0.0, 100.0, 10).marks.tolist()
    [2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0]
    """
    span = max(high - low, 1e-9)
    power = 10.0 ** np.floor(np.log10(span / marks))
    step = next(s * power for s in (*_STEPS, 10.0, 20.0) if s * power * marks >= span * (1 - 1e-9))
    if whole:
        low = step * float(np.floor(low / step + 1e-9))
        high = max(step * float(np.ceil(high / step - 1e-9)), low + step)
    return ChartScale(low, high, step, start, size)


@attrs.frozen
class Chart:
    """A field of a sheet: left lower corner and size, mm."""

    sheet: Sheet
    left: float
    low: float
    wide: float
    tall: float

    @property
    def right(self) -> float:
        """Right edge, mm."""
        return self.left + self.wide

    @property
    def top(self) -> float:
        """Upper edge, mm."""
        return self.low + self.tall

    def border(self) -> None:
        """Draw the edges of the field."""
        corners = [(self.left, self.low), (self.right, self.low), (self.right, self.top),
                   (self.left, self.top), (self.left, self.low)]  # fmt: skip
        self.sheet.line(np.array(corners), LINE, "field")

    def level(self, y: float, pen: Pen, name: str) -> None:
        """Draw a level line across the field."""
        self.sheet.rule((self.left, y), (self.right, y), pen, name)


def chart_on(sheet: Sheet, below: float) -> Chart:
    """Make room for a chart left of the block, and `below` mm at A3 for what stands under it."""
    factor, margin = sheet.paper.factor, MARGIN * sheet.paper.factor
    frame(sheet, margin)
    left, low = margin + _LEFT * factor, margin + below * factor
    wide = sheet.paper.width - margin - (BLOCK + _RIGHT) * factor - left
    return Chart(sheet, left, low, wide, sheet.paper.height - margin - _ABOVE * factor - low)


def level_grid(chart: Chart, scale: ChartScale, title: str, draught: float | None = None) -> None:
    """Draw level lines at the marks of a scale, its title above, and the design draught."""
    sheet, factor = chart.sheet, chart.sheet.paper.factor
    for value in scale.marks.tolist():
        y = float(scale.at(value))
        chart.level(y, GRID, f"level/{value:g}")
        place = (chart.left - 1.2 * factor, y)
        sheet.take(sheet.text(place, scale.word(value), across="right", name="label/level"))
    head = (chart.left - 1.2 * factor, chart.top + 3.9 * factor)
    sheet.take(sheet.text(head, title, across="right", up="bottom", bold=True, name="label/up"))
    if draught is not None and scale.low < draught < scale.high:
        y = float(scale.at(draught))
        chart.level(y, WATER, "design draught")
        place = (chart.right + 1.0 * factor, y)
        words = f"T {draught:.4g}"
        sheet.take(sheet.text(place, words, size=0.9, across="left", name="label/design"))


def upright_grid(chart: Chart, along: ChartScale, title: str) -> None:
    """Draw upright lines at the marks of the abscissa, with their values below."""
    sheet, factor = chart.sheet, chart.sheet.paper.factor
    for value in along.marks.tolist():
        x = float(along.at(value))
        sheet.rule((x, chart.low), (x, chart.top), GRID, f"upright/{value:g}")
        place = (x, chart.low - 1.2 * factor)
        sheet.take(sheet.text(place, along.word(value), up="top", name="label/upright"))
    place = (chart.right, chart.low - 4.6 * factor)
    words = sheet.text(place, title, across="right", up="top", bold=True, name="label/along")
    sheet.take(words)


def smooth_course(x: FloatArray, y: FloatArray, count: int = 400) -> FloatArray:
    """Give a smooth curve through points, (count + n, 2), straight where they lie level.

    Parameters
    ----------
    x, y : (n,)
        The points; x rises.
    count : int
        So many points are drawn besides the given ones.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.plot.sheet.chart import smooth_course
    >>> course = smooth_course(np.array([0.0, 1, 2, 3]), np.array([0.0, 5, 5, 0]), 7)
    >>> course[3:5, 1].tolist()  # between the two that are level
    [5.0, 5.0]
    """
    from scipy.interpolate import CubicHermiteSpline

    rise = np.diff(y) / np.diff(x)
    if len(x) == 2:
        return np.column_stack([x, y])
    step = np.diff(x)
    middle = (rise[:-1] * step[1:] + rise[1:] * step[:-1]) / (step[1:] + step[:-1])
    least = np.minimum(np.abs(rise[:-1]), np.abs(rise[1:]))
    most = np.where(rise[:-1] * rise[1:] > 0.0, 3.0, 1.0) * least  # else it swings out
    middle = np.clip(middle, -most, most)
    slope = np.concatenate([[2 * rise[0] - middle[0]], middle, [2 * rise[-1] - middle[-1]]])
    level = np.abs(np.diff(y)) <= 1e-6 * np.abs(y).max(initial=0.0)
    slope[:-1][level] = slope[1:][level] = 0.0
    at = np.union1d(np.linspace(x[0], x[-1], count), x)
    return np.column_stack([at, CubicHermiteSpline(x, y, slope)(at)])


class HasHeader(Protocol):
    """What has a head that says what its numbers hold good for."""

    @property
    def header(self) -> HydrostaticHeader:
        """The head."""
        ...


def chart_block(
    sheet: Sheet, table: HasHeader, title: str, rows: Sequence[tuple[str, str]]
) -> float:
    """Draw the block of a chart: ship, rows, and what the numbers hold good for."""
    head, factor = table.header, sheet.paper.factor
    margin = MARGIN * factor
    corner = (sheet.paper.width - margin, sheet.paper.height - margin)
    added = ", ".join(each.name for each in head.appendages) or "none"
    notes = [
        f"{head.water}; shell factor {head.shell_factor:g}.",
        "Draughts moulded; x from AP, + forward; z from the base line.",
        f"Appendages: {added if len(added) < 60 else f'{len(head.appendages)} of them'}.",
        f"Deck {head.deck}; {'with' if head.transom else 'without'} the transom in S.",
        f"Hull {head.fingerprint[:16]}" + (f"; {head.date}" if head.date else "") + ".",
    ]
    ship = [
        ("Length between perpendiculars", f"{head.length:.3f} m"),
        ("Breadth, moulded", f"{head.breadth:.3f} m"),
        ("Design draught, moulded", f"{head.draught:.3f} m"),
    ]
    sheet.take(
        sheet.text(
            (MARGIN * factor + 4.0 * factor, corner[1] - 4.0 * factor), title, size=1.3, bold=True,
            across="left", up="top", name="label/chart",
        )
    )  # fmt: skip
    return title_block(sheet, corner, BLOCK * factor, head.ship, [*ship, *rows], notes)
