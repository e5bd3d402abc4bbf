"""A study in pictures: two columns of its table with the Pareto front, and parallel coordinates.

`study_scatter` puts a dot for each variant, `study_parallel` a course across as many scales as
there are columns. What is better is what the user says; variants outside limits are grey.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from assoc_hull.arguments import shown
from assoc_hull.errors import BadInputError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.sheet.chart import Chart, chart_on, level_grid, scale_to, upright_grid
from assoc_hull.plot.sheet.labels import wrap_words
from assoc_hull.plot.sheet.paper import LINE, MARGIN, TINT, PaperName, Pen
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, save
from assoc_hull.plot.sheet.title_block import BLOCK, title_block
from assoc_hull.study.pareto import column_of, limits_of, pareto_front, within_limits

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["HasStudyTable", "study_parallel", "study_scatter"]

_WHERE = "in a picture of a study"
_GOOD, _OUT = "#0b5fa5", "#b8b8b8"
_FRONT = Pen(0.25, TINT, over=3.5)
_COURSE = Pen(0.1, _GOOD, over=2.0)
_GREY = Pen(0.06, _OUT, over=1.5)
_MOST = 16
"""Scales side by side."""

_COURSES = 2000
"""Courses that are drawn of each kind: more would be one colour; each n-th of more."""


class HasStudyTable(Protocol):
    """What has the table of a study, and the units of its columns."""

    @property
    def units(self) -> Mapping[str, str]:
        """Units of the columns that have one."""
        ...

    def table(self) -> Mapping[str, NDArray[Any]]:
        """All rows as arrays (n,) by name."""
        ...


def study_scatter(
    found: HasStudyTable,
    x: str,
    y: str,
    *,
    better: Mapping[str, str] | None = None,
    within: Mapping[str, object] | None = None,
    path: Path_ | None = None,
    paper: PaperName = "A4",
) -> Figure:
    """Draw two columns of a study against one another, and the Pareto front.

    Parameters
    ----------
    found : Study
        What `hull.study` gives.
    x, y : str
        Names of columns: parameters, outputs, or what else has numbers.
    better : mapping of str to {"less", "more"}
        Which direction is better, by the names of columns, of these two or of others; without it no
        front is drawn.
    within : mapping of str to (float or None, float or None)
        Least and greatest value by column; variants outside are grey, and not on the front.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    paper : "A4", "A3" or "A1"
        Size of the sheet, landscape.

    Returns
    -------
    matplotlib.figure.Figure
        Dots have the ids ``variants``, ``outside`` and ``front``.

    Raises
    ------
    UnknownNameError, BadInputError, WrongTypeError
        No such column, no such direction, limits that are none; no variant has a hull; an unknown
        paper or ending.
    MissingExtraError
        Matplotlib is not installed.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> parent = ah.examples.wigley(stations=9, waterlines=6)
    >>> found = parent.study(set={"breadth": [9.0, 10.0, 11.0]})
    >>> better = {"kmt": "more", "wetted_surface": "less"}
    >>> figure = ah.plot.study_scatter(found, "wetted_surface", "kmt", better=better)
    """
    table = _table_of(found)
    values = np.column_stack([column_of(table, name) for name in (x, y)])
    good, front = _judged(table, better, within)
    shown_rows = _shown(values, table)
    sheet = Sheet(paper)
    chart = chart_on(sheet, 14.0)
    (left, low), (right, high) = values[shown_rows].min(axis=0), values[shown_rows].max(axis=0)
    along = scale_to(float(left), float(right), chart.left, chart.wide, 10)
    up = scale_to(float(low), float(high), chart.low, chart.tall, 10)
    level_grid(chart, up, "")
    head = (chart.left, chart.top + 2.0 * sheet.paper.factor)
    words = _title(found, y, better)
    sheet.take(sheet.text(head, words, across="left", up="bottom", bold=True, name="label/up"))
    upright_grid(chart, along, _title(found, x, better))
    chart.border()
    places = np.column_stack([along.at(values[:, 0]), up.at(values[:, 1])])
    for rows, colour, size, name in (
        (shown_rows & ~good, _OUT, 0.9, "outside"),
        (shown_rows & good & ~front, _GOOD, 1.1, "variants"),
        (shown_rows & front, TINT, 1.7, "front"),
    ):
        sheet.dots(places[rows], colour, size, name)
    if better is not None and set(better) <= {x, y} and (shown_rows & front).sum() > 1:
        course = places[shown_rows & front]
        sheet.line(course[np.argsort(course[:, 0], kind="stable")], _FRONT, "front/course")
    _block(sheet, table, (good, front), better, within)
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def study_parallel(
    found: HasStudyTable,
    columns: Sequence[str],
    *,
    better: Mapping[str, str] | None = None,
    within: Mapping[str, object] | None = None,
    path: Path_ | None = None,
    paper: PaperName = "A4",
) -> Figure:
    """Draw each variant as a course across a scale for each of some columns.

    Parameters
    ----------
    found : Study
        What `hull.study` gives.
    columns : sequence of str
        Names of two to sixteen columns, in their order from the left.
    better, within, path, paper
        As for `study_scatter`: courses on the front are drawn heavier, on top.

    Returns
    -------
    matplotlib.figure.Figure
        Of many variants each n-th is drawn, of those on the front all up to 2,000.

    Raises
    ------
    UnknownNameError, BadInputError, WrongTypeError
        As `study_scatter`; fewer than two columns, or more than sixteen.
    MissingExtraError
        Matplotlib is not installed.
    """
    table = _table_of(found)
    if isinstance(columns, str) or not isinstance(columns, Sequence):
        raise WrongTypeError(f"columns is {shown(columns)}", _WHERE, "give a list of names")
    if not 2 <= len(columns) <= _MOST:
        what = f"{len(columns)} columns were named"
        raise BadInputError(what, _WHERE, f"name 2 to {_MOST}")
    values = np.column_stack([column_of(table, name) for name in columns])
    good, front = _judged(table, better, within)
    shown_rows = _shown(values, table)
    sheet = Sheet(paper)
    chart = chart_on(sheet, 14.0)
    x = np.linspace(chart.left, chart.right, len(columns))
    low, high = values[shown_rows].min(axis=0), values[shown_rows].max(axis=0)
    flat = high == low
    part = np.where(flat, 0.5, (values - low) / np.where(flat, 1.0, high - low))
    y = chart.low + chart.tall * part
    for rows, pen, name in (
        (shown_rows & ~good, _GREY, "outside"),
        (shown_rows & good & ~front, _COURSE, "variants"),
        (shown_rows & front, _FRONT, "front"),
    ):
        _courses(sheet, x, y[rows], pen, name)
    _uprights(chart, x, list(columns), found, better, (low, high))
    _block(sheet, table, (good, front), better, within)
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def _table_of(found: HasStudyTable) -> Mapping[str, NDArray[Any]]:
    """Give the table of a study, and nothing else's."""
    if isinstance(found, type) or not all(hasattr(found, part) for part in ("units", "table")):
        raise WrongTypeError(f"found is {shown(found)}", _WHERE, "give what hull.study gives")
    return found.table()


def _judged(
    table: Mapping[str, NDArray[Any]],
    better: Mapping[str, str] | None,
    within: Mapping[str, object] | None,
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Tell which rows are within limits, and which are on the front."""
    good = within_limits(table, within)
    front = np.zeros_like(good) if better is None else pareto_front(table, better, within)
    return good, front


def _shown(values: FloatArray, table: Mapping[str, NDArray[Any]]) -> NDArray[np.bool_]:
    """Tell which rows can be drawn; there must be one."""
    found = np.asarray(np.isfinite(values).all(axis=1))
    if not found.any():
        what = f"none of {len(values)} variants has these numbers"
        raise BadInputError(what, _WHERE, "see the reasons in its table")
    return found


def _title(found: HasStudyTable, name: str, better: Mapping[str, str] | None) -> str:
    """Name a column, its unit, and which direction is better."""
    unit, way = found.units.get(name, ""), (better or {}).get(name)
    words = name.replace("_", " ") + (f", {unit}" if unit.strip("-") else "")
    return f"{words} ({way} is better)" if way else words


def _courses(sheet: Sheet, x: FloatArray, y: FloatArray, pen: Pen, name: str) -> None:
    """Draw courses, (n, k), as one line that breaks off between them."""
    y = y[:: max(1, -(-len(y) // _COURSES))]
    if not len(y):
        return
    across = np.tile(np.append(x, np.nan), (len(y), 1))
    up = np.column_stack([y, np.full(len(y), np.nan)])
    sheet.line(np.column_stack([across.ravel(), up.ravel()]), pen, name)


def _uprights(
    chart: Chart,
    x: FloatArray,
    names: list[str],
    found: HasStudyTable,
    better: Mapping[str, str] | None,
    ends: tuple[FloatArray, FloatArray],
) -> None:
    """Draw the scales, each with its least and greatest value, and its name below."""
    sheet, factor = chart.sheet, chart.sheet.paper.factor
    room = chart.wide / (len(names) - 1) - 2.0 * factor
    for place, name, low, high in zip(x.tolist(), names, *(each.tolist() for each in ends),
                                      strict=True):  # fmt: skip
        sheet.rule((place, chart.low), (place, chart.top), LINE, f"scale/{name}")
        sheet.take(sheet.text((place, chart.top + 1.0 * factor), f"{high:.6g}", up="bottom",
                              name=f"label/high/{name}"))  # fmt: skip
        sheet.take(sheet.text((place, chart.low - 1.0 * factor), f"{low:.6g}", up="top",
                              name=f"label/low/{name}"))  # fmt: skip
        lines = wrap_words(sheet, _title(found, name, better), max(room, 6.0 * factor), 0.9)
        for i, words in enumerate(lines[:3]):
            spot = (place, chart.low - (3.6 + 2.4 * i) * factor)
            sheet.take(sheet.text(spot, words, size=0.9, bold=True, up="top",
                                  name=f"label/scale/{name}/{i}"))  # fmt: skip


def _block(
    sheet: Sheet,
    table: Mapping[str, NDArray[Any]],
    judged: tuple[NDArray[np.bool_], NDArray[np.bool_]],
    better: Mapping[str, str] | None,
    within: Mapping[str, object] | None,
) -> None:
    """Write how many variants there are, which limits hold, and which are on the front."""
    factor, margin = sheet.paper.factor, MARGIN * sheet.paper.factor
    (good, front), made = judged, table["failure"] == ""
    rows = [("Variants with a hull", f"{made.sum()} of {len(made)}")]
    if within:
        rows.append(("Within limits", f"{good.sum()}"))
        rows += [(f"  {name}", _limits(limits_of(ends, name))) for name, ends in within.items()]
    if better:
        rows.append(("On the front", f"{front.sum()}"))
        rows += [(f"  {name}", f"{way} is better") for name, way in better.items()]
    notes = [f"No. {', '.join(map(str, table['number'][front][:12]))}"
             f"{' ...' if front.sum() > 12 else ''}."] if front.any() else []  # fmt: skip
    corner = (sheet.paper.width - margin, sheet.paper.height - margin)
    title_block(sheet, corner, BLOCK * factor, "STUDY", rows, notes)


def _limits(ends: tuple[float, float]) -> str:
    """Write two limits."""
    low, high = ends
    if np.isinf(low):
        return "any" if np.isinf(high) else f"up to {high:g}"
    return f"from {low:g}" if np.isinf(high) else f"{low:g} to {high:g}"
