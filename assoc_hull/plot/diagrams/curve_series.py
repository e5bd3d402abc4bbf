"""A curve, its series, and the coefficients of the series as bars."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assoc_hull.analysis.form.curve_transform import CurveTransform
from assoc_hull.arguments import instance, integer
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.sheet.chart import (
    Chart,
    ChartScale,
    chart_on,
    level_grid,
    scale_to,
    upright_grid,
)
from assoc_hull.plot.sheet.paper import AXIS, GRID, MARGIN, TINT, PaperName, Pen
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, save
from assoc_hull.plot.sheet.title_block import BLOCK, title_block

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["curve_series"]

_CURVE = Pen(1.1, "#9dbfe0", over=3.0)
_SERIES = Pen(0.25, TINT, over=3.5)
_SHARE, _BETWEEN = 0.6, 0.13  # of the height: the curve, and the room above the bars
_PLACES = 800
_FEWEST = 1e-7  # of the largest coefficient: shorter bars are not drawn
_TITLES = {"chebyshev": "Chebyshev series", "sine": "Half-range sine series",
           "fourier": "Fourier descriptors"}  # fmt: skip
_SYMBOLS = {"chebyshev": "|c_k|", "sine": "|b_k|", "fourier": "|X_k|, m"}


def curve_series(
    found: CurveTransform,
    path: Path_ | None = None,
    *,
    terms: int | None = None,
    paper: PaperName = "A4",
) -> Figure:
    """Draw a curve with the first terms of its series, and all coefficients as bars.

    Parameters
    ----------
    found : CurveTransform
        The curve and its series.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    terms : int or None
        With so many terms the series is drawn; all if None.
    paper : "A3", "A1" or "A4"
        Size of the sheet, landscape.

    Raises
    ------
    BadInputError
        More terms than there are, an unknown paper or ending.
    MissingExtraError
        Matplotlib is not installed.
    """
    where = "in a picture of a series"
    instance(found, CurveTransform, "found", where)
    most = found.terms
    count = most if terms is None else integer(terms, "terms", where, least=1, most=most)
    sheet = Sheet(paper)
    field = chart_on(sheet, 12.0)
    low = field.low + (1.0 - _SHARE) * field.tall
    upper = Chart(sheet, field.left, low, field.wide, _SHARE * field.tall)
    tall = (1.0 - _SHARE - _BETWEEN) * field.tall
    _curve(upper, found, count)
    _bars(Chart(sheet, field.left, field.low, field.wide, tall), found, count)
    _block(sheet, found, count)
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def _curve(chart: Chart, found: CurveTransform, terms: int) -> None:
    """Draw the curve and its series over one another."""
    own, series = found.places, _series(found, terms)
    both = np.concatenate([own, series])
    (left, low), (right, high) = both.min(axis=0).tolist(), both.max(axis=0).tolist()
    closed = found.kind == "fourier"
    if closed:  # true to shape: neither way has more room than it needs
        unit = min(chart.wide / (right - left), chart.tall / (high - low)) / 1.1
        middle, half = 0.5 * (left + right), 0.5 * chart.wide / unit
        left, right = middle - half, middle + half
        middle, half = 0.5 * (low + high), 0.5 * chart.tall / unit
        low, high = middle - half, middle + half
    else:
        low, high = min(low, 0.0), high + 0.08 * (high - low)
    along = scale_to(left, right, chart.left, chart.wide, 12, whole=False)
    up = scale_to(low, high, chart.low, chart.tall, 10, whole=False)
    title = (
        found.across if found.unit != 1.0 else found.across + (", m2" if _areas(found) else ", m")
    )
    level_grid(chart, up, f"{title} / {found.unit:.5g}" if found.unit != 1.0 else title)
    upright_grid(chart, along, f"{found.along}, m")
    if low < 0.0 < high:
        chart.level(float(up.at(0.0)), AXIS, "nil")
    chart.border()
    for places, pen, name in ((own, _CURVE, "curve"), (series, _SERIES, "series")):
        points = np.column_stack([along.at(places[:, 0]), up.at(places[:, 1])])
        chart.sheet.line(points, pen, name)


def _areas(found: CurveTransform) -> bool:
    return found.across == "A"


def _series(found: CurveTransform, terms: int) -> FloatArray:
    """Give places along the series, (n, 2)."""
    at = np.linspace(found.low, found.high, _PLACES)
    value = found.evaluate(at, terms)
    return value if value.ndim == 2 else np.column_stack([at, value])


def _bars(chart: Chart, found: CurveTransform, terms: int) -> None:
    """Draw the sizes of the coefficients on a scale of decades; those left out are pale."""
    sheet, factor = chart.sheet, chart.sheet.paper.factor
    size, order = np.abs(found.coefficients), np.array(found.orders)
    top = float(np.ceil(np.log10(max(float(size.max()), 1e-300)) + 1e-9))
    least = max(float(size[size > 0.0].min(initial=size.max())), _FEWEST * float(size.max()))
    foot = min(float(np.floor(np.log10(max(least, 1e-300)))), top - 1.0)
    along = ChartScale(order[0] - 1.0, order[-1] + 1.0, _step(len(order)), chart.left, chart.wide)
    up = ChartScale(foot, top, 1.0, chart.low, chart.tall)
    for value in up.marks.tolist():
        y = float(up.at(value))
        chart.level(y, GRID, f"decade/{value:g}")
        place = (chart.left - 1.2 * factor, y)
        sheet.take(sheet.text(place, f"1e{value:.0f}", across="right", name="label/decade"))
    kept = np.abs(order) <= terms if found.kind == "fourier" else np.arange(len(order)) < terms
    width = min(4.0, 0.6 * chart.wide / (len(order) + 1) / factor)
    for k, value, inside in zip(order.tolist(), size.tolist(), kept.tolist(), strict=True):
        x = float(along.at(k))
        if value > 10.0**foot:
            colour = _SERIES.colour if inside else "0.75"
            y = float(up.at(np.log10(value)))
            sheet.axes.bar(x, y - chart.low, width * factor, chart.low, color=colour, zorder=3.0)
        if k % int(along.step) == 0:
            place = (x, chart.low - 1.2 * factor)
            sheet.take(sheet.text(place, str(k), up="top", name="label/order"))
    head = (chart.left - 1.2 * factor, chart.top + 2.2 * factor)
    words = sheet.text(head, _SYMBOLS[found.kind], across="right", up="bottom", bold=True,
                       name="label/size")  # fmt: skip
    sheet.take(words)
    foot_ = (chart.right, chart.low - 4.6 * factor)
    sheet.take(sheet.text(foot_, "k", across="right", up="top", bold=True, name="label/k"))
    chart.border()


def _step(count: int) -> float:
    """Give how many orders lie between two that are written."""
    return float(next(step for step in (1, 2, 5, 10, 20, 50, 100) if count <= 26 * step))


def _block(sheet: Sheet, found: CurveTransform, terms: int) -> None:
    """Write what is drawn, and what the series leaves out."""
    factor = sheet.paper.factor
    margin = MARGIN * factor
    closed = found.kind == "fourier"
    rows = [
        ("Series", _TITLES[found.kind]),
        ("Length around" if closed else "Range", _range(found)),
        ("Harmonics drawn" if closed else "Terms drawn", f"{terms} of {found.terms}"),
        ("Left out, root mean square", f"{found.truncation.rms[terms - 1]:.3g}"),
        ("Left out, largest", f"{found.truncation.largest[terms - 1]:.3g}"),
    ]
    notes = ["Blue: the curve. Red: its series, and the bars of the terms drawn."]
    notes = [f"Floating {found.position}.", *notes] if found.position else notes
    corner = (sheet.paper.width - margin, sheet.paper.height - margin)
    title_block(sheet, corner, BLOCK * factor, found.name, rows, notes)


def _range(found: CurveTransform) -> str:
    if found.kind == "fourier":
        return f"{found.high:.3f} m"
    return f"{found.along} {found.low:.3f} to {found.high:.3f} m"
