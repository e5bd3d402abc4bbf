"""A comparison of two hulls as a PDF: both lines plans on one sheet, then tables."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Literal

import attrs

from assoc_hull.arguments import instance
from assoc_hull.hull import Hull
from assoc_hull.plot.lines_plan.comparison_plan import comparison_plan_sheet
from assoc_hull.plot.sheet.form_flow import LEFT, RIGHT, Flow, wrapped
from assoc_hull.plot.sheet.page_ends import GREY, page_foot, page_head
from assoc_hull.plot.sheet.pages import pdf_of
from assoc_hull.plot.sheet.sheet import Sheet, require_matplotlib
from assoc_hull.variation.comparing.cells import (
    LINE_HEAD,
    NUMBER_HEAD,
    PRINCIPAL,
    counts,
    hull_words,
    line_cells,
    line_words,
    number_cells,
    object_words,
    reason_words,
)
from assoc_hull.variation.comparing.compare import HullComparison, compare
from assoc_hull.variation.comparing.number_comparison import NumberComparison

__all__ = ["comparison_pdf", "comparison_sheets"]

_LINE, _PAD, _SMALL = 2.7, 1.3, 0.88  # of a row, mm; size of its letters
_TITLE = "Parent and variant"

Side = Literal["left", "right"]
Column = tuple[float, Side]

_LINE_COLUMNS: tuple[Column, ...] = (
    (1.0, "left"), (46.0, "right"), (50.0, "left"), (80.0, "left"), (128.0, "right"),
    (145.0, "right"), (161.0, "right"), (181.0, "right"),
)  # fmt: skip
"""Where the cells of a line stand, mm from the left edge, and which side of them."""

_NAME = 62.0
"""Room for the name of a number, mm; on a screen it is a little wider."""

_NUMBER_COLUMNS: tuple[Column, ...] = (
    (1.0, "left"), (24.0, "left"), (92.0, "left"), (125.0, "right"), (145.0, "right"),
    (165.0, "right"), (181.0, "right"),
)  # fmt: skip


def comparison_pdf(parent: Hull, variant: Hull, found: HullComparison | None = None) -> bytes:
    """Give a comparison as a PDF; the same bytes each time.

    The first page, A3, has the lines plan of the variant over the parent's; upright A4 pages
    with all lines that moved, hydrostatics, and the form parameters that differ follow.

    Parameters
    ----------
    parent, variant : Hull
        The hulls.
    found : HullComparison, optional
        What `assoc_hull.compare` tells of them, if it is at hand.

    Raises
    ------
    MissingExtraError
        Matplotlib is not installed.
    BadInputError
        No hull, or a comparison that is none.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.plot import comparison_pdf
    >>> parent = ah.examples.wigley()
    >>> comparison_pdf(parent, ah.vary(parent, set={"breadth": 11.0}).hull)[:5]
    b'%PDF-'
    """
    sheets = comparison_sheets(parent, variant, found)
    return pdf_of(sheets, f"{_TITLE}: {variant.particulars.name}")


def comparison_sheets(
    parent: Hull, variant: Hull, found: HullComparison | None = None
) -> list[Sheet]:
    """Give a comparison as pages; arguments and errors as for `comparison_pdf`."""
    require_matplotlib()
    for name, hull in (("parent", parent), ("variant", variant)):
        instance(hull, Hull, name, "in a picture")
    if found is None:
        found = compare(parent, variant)
    instance(found, HullComparison, "found", "in a picture")
    flow = Flow(lambda sheet, first: _begin(found, sheet, first))
    flow.turn()
    _lines(flow, found)
    principal = [found.hydrostatic(name) for name in PRINCIPAL]
    _numbers(flow, "Hydrostatics", principal)
    _numbers(flow, "Form parameters that differ", [n for n in found.parameters if not n.is_same])
    _words(flow, "Points and features", object_words(found))
    total = len(flow.pages) + 1
    for k, page in enumerate(flow.pages, 2):
        marks = (found.parent.fingerprint, found.variant.fingerprint)
        page_foot(page, [f"parent {marks[0]}", f"variant {marks[1]}"], f"{k} / {total}")
    return [comparison_plan_sheet(parent, variant, found=found), *flow.pages]


def _begin(found: HullComparison, sheet: Sheet, first: bool) -> float:
    """Draw what stands at the top of a page; give where it ends, mm."""
    y = page_head(sheet, found.variant.particulars.name, _TITLE, first=first)
    if first:
        for title, hull in (("Parent", found.parent), ("Variant", found.variant)):
            for words in (f"{title}: {hull_words(hull)}", *hull.doubts):
                for line in wrapped(sheet, words, 0.94 * (RIGHT - LEFT), 1.0):
                    y -= 4.0
                    sheet.text((LEFT, y), line, across="left", up="baseline", name="label/place")
    return y - 4.0


def _lines(flow: Flow, found: HullComparison) -> None:
    """Tell all lines that moved, the farthest first, and in words what else there is."""
    moved = found.worst(len(found.lines))
    rows = [_Row(tuple((cell,) for cell in line_cells(line)), _LINE_COLUMNS) for line in moved]
    head = _Row(tuple((cell,) for cell in LINE_HEAD), _LINE_COLUMNS, GREY)
    flow.part("Lines that moved, the farthest first", rows, columns=1, head=head)
    _words(flow, "All lines", [counts(found), *line_words(found)])


def _numbers(flow: Flow, title: str, numbers: Sequence[NumberComparison]) -> None:
    rows = [_Row(_named(flow.sheet, each), _NUMBER_COLUMNS) for each in numbers]
    symbol, *cells = NUMBER_HEAD
    head = _Row(tuple((cell,) for cell in (symbol, "", *cells)), _NUMBER_COLUMNS, GREY)
    flow.part(title, rows, columns=1, head=head)
    reasons = list(reason_words(numbers))
    if reasons:
        _words(flow, f"{title}: no value", reasons)


def _named(sheet: Sheet, number: NumberComparison) -> tuple[tuple[str, ...], ...]:
    """Give the cells of a number, its name in as many lines as it needs."""
    symbol, *cells = number_cells(number)
    name = tuple(wrapped(sheet, number.title, _NAME, _SMALL))
    return ((symbol,), name, *((cell.replace("-", "−"),) for cell in cells))


def _words(flow: Flow, title: str, words: Iterable[str]) -> None:
    """Write sentences over the whole width."""
    room = 0.94 * (RIGHT - LEFT)  # the same words are a little wider on a screen
    rows = [_Row((tuple(wrapped(flow.sheet, each, room, _SMALL)),), ((1.0, "left"),))
            for each in words]  # fmt: skip
    flow.part(title, rows, ruled=False, columns=1)


@attrs.frozen
class _Row:
    """A row over the whole width: the lines of each cell, and where each stands."""

    cells: tuple[tuple[str, ...], ...]
    columns: tuple[Column, ...]
    colour: str = "black"

    @property
    def tall(self) -> float:
        return _PAD + _LINE * max(len(cell) for cell in self.cells)

    def draw(self, sheet: Sheet, x: float, top: float) -> None:
        y = top - 0.5 * _PAD - 0.78 * _LINE
        for (at, side), cell in zip(self.columns, self.cells, strict=True):
            for k, words in enumerate(cell):
                sheet.text((x + at, y - k * _LINE), words, size=_SMALL, across=side, up="baseline",
                           colour=self.colour, name=f"label/cell/{self.cells[0][0]}")  # fmt: skip
