"""A variant over its parent: both lines plans on one sheet, and the comparison as a PDF.

The plan has the variant in full and the parent in grey, with the numbers that differ in the
block. The PDF adds upright pages: all lines that moved, hydrostatics, form parameters that
differ. The numbers come from `assoc_hull.variation`; nothing is computed here.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Literal

import attrs
import numpy as np

from assoc_hull.arguments import instance, shown
from assoc_hull.errors import WrongTypeError
from assoc_hull.model.tables import HasState, HullState
from assoc_hull.plot.lines_plan.before_after import (
    LEAST,
    ExaggeratedMovement,
    exaggerated,
    overlay,
    pairs_of,
)
from assoc_hull.plot.lines_plan.drawing import Drawable, Drawing, drawing, zoomed
from assoc_hull.plot.lines_plan.plan import captions, window_rows
from assoc_hull.plot.lines_plan.three_views import ViewLayout, Views, body_halves, lay_out_views
from assoc_hull.plot.sheet.labels import wrap_words
from assoc_hull.plot.sheet.paper import MARGIN, PaperName, Pen
from assoc_hull.plot.sheet.report_pages import GREY, LEFT, RIGHT, PageFlow, page_foot, page_head
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, pdf_of, require_matplotlib, save
from assoc_hull.plot.sheet.title_block import BLOCK, ROW, block_height, frame, title_block
from assoc_hull.variation.comparing.comparison import (
    LINE_HEAD,
    NUMBER_HEAD,
    PRINCIPAL,
    HullComparison,
    alike_words,
    amount,
    compare,
    counts,
    hull_words,
    line_cells,
    line_words,
    number_cells,
    object_words,
    reason_words,
    that_differ,
    visibly_moved,
)
from assoc_hull.variation.comparing.line_comparison import LineComparison
from assoc_hull.variation.comparing.number_comparison import NumberComparison

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = [
    "comparison_pdf",
    "comparison_plan",
    "comparison_plan_sheet",
    "comparison_sheets",
]

# --------------------------------------------------------------------------------------
# The lines plan of a variant over that of its parent.

_PARENT = Pen(0.16, "0.45", over=1.8)
_NUMBERS = ("volume", "lcb", "kmt", "wetted_surface", "cb", "cp", "cw")
_WORST = 8
_ABOVE = 12.0  # of the profile, for the names of its buttocks, mm at A3


def comparison_plan(
    parent: Drawable,
    variant: Drawable,
    path: Path_ | None = None,
    *,
    paper: PaperName = "A3",
    title: str | None = None,
    found: HullComparison | None = None,
    exaggerate: float | None = None,
    x: tuple[float, float] | None = None,
) -> Figure:
    """Draw the lines plan of a variant, and in grey what its parent was where they differ.

    Profile, half-breadth plan and body plan as in `lines_plan`. Lines of the variant are red
    where they lie off the parent's.

    Parameters
    ----------
    parent, variant : Hull, HullState or Drawing
        The hulls.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    paper : "A3", "A1" or "A4"
        Size of the sheet, landscape.
    title : str, optional
        Instead of the name of the ship.
    found : HullComparison, optional
        What `Hull.compare` tells of both: numbers, and the lines that moved farthest, then
        stand in the block.
    exaggerate : float, optional
        How many times as large movements are drawn: teeth along the hull's normal, red out, blue
        in, in place of two lines that coincide on paper.
    x : (float, float), m, optional
        Draw only what lies between these stations, larger.

    Returns
    -------
    matplotlib.figure.Figure
        The picture; a line of the parent has an id ``view/before/name``, what moved
        ``view/moved/name``.

    Raises
    ------
    MissingExtraError
        Matplotlib is not installed.
    BadInputError
        An unknown paper or ending; no line between the stations; a factor not above 0.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.plot.lines_plan.comparison import comparison_plan
    >>> figure = comparison_plan(wigley(), wigley(breadth=11.0))
    """
    figure = comparison_plan_sheet(
        parent, variant, paper=paper, title=title, found=found, exaggerate=exaggerate, x=x
    ).figure
    if path is not None:
        save(figure, path)
    return figure


def comparison_plan_sheet(
    parent: Drawable,
    variant: Drawable,
    *,
    paper: PaperName = "A3",
    title: str | None = None,
    found: HullComparison | None = None,
    exaggerate: float | None = None,
    x: tuple[float, float] | None = None,
) -> Sheet:
    """Give the plan as a sheet; arguments and errors as for `comparison_plan`."""
    was, now = drawing(parent), drawing(variant)
    old, new = zoomed(was, x), zoomed(now, x)
    large = exaggerated(new, exaggerate)
    sheet = Sheet(paper)
    layout = lay_out_views(attrs.evolve(new, lines=(*new.lines, *old.lines)), sheet.paper)
    frame(sheet, MARGIN * sheet.paper.factor)
    rows = [*_dimensions(was, now), *window_rows(new.window)]
    _block(sheet, layout, title or new.particulars.name, rows, found, large)
    captions(sheet, new, layout, (lambda view: "") if large is None else large.words)
    views = Views(sheet, new, layout.low, layout.high)
    views.profile(layout.profile)
    views.half_breadth(layout.half)
    views.body(layout.body)
    _overlay(views, layout, old, large)
    return sheet


def _overlay(
    views: Views, layout: ViewLayout, old: Drawing, large: ExaggeratedMovement | None
) -> None:
    """Draw what the parent was, and what of the variant lies elsewhere."""
    for view, families in (
        (layout.profile, ("boundary", "buttocks")),
        (layout.half, ("boundary", "waterlines")),
    ):
        for family in families:
            pairs = pairs_of(old.of(family), views.drawing.of(family))
            overlay(views.sheet, view, pairs, _PARENT, large)
    before = Views(views.sheet, old, layout.low, layout.high)
    halves = (body_halves(each.sections, views.middle) for each in (before, views))
    for half, was, now in zip((layout.body.mirrored(), layout.body), *halves, strict=True):
        overlay(views.sheet, half, pairs_of(was, now), _PARENT, large)


Rows = list[tuple[str, str]]


def _block(
    sheet: Sheet, layout: ViewLayout, title: str, dimensions: Rows, found: HullComparison | None,
    large: ExaggeratedMovement | None,
) -> None:  # fmt: skip
    """Write what both are, and what is known of their differences."""
    profile, body = layout.profile.denominator, layout.body.denominator
    rows = [*dimensions, ("Scale", f"1:{profile:g}, body plan 1:{body:g}, {sheet.paper.name}")]
    notes = [
        *_colours(large),
        "Moulded lines, m; x forward from AP, z upward from the base line.",
    ]
    if found is not None:
        notes.append(f"Lines: {counts(found)}.")
        rows += [_number(found.hydrostatic(name)) for name in _NUMBERS]
        rows += [_line(line) for line in found.worst(_WORST)]
    width = BLOCK * sheet.paper.factor
    title_block(sheet, layout.corner, width, title, rows[: _room(layout, sheet, len(notes))], notes)


def _colours(large: ExaggeratedMovement | None) -> list[str]:
    if large is not None:
        return [large.note]
    return [
        "Grey: the parent, where they differ.",
        f"Red: the variant where it lies off the parent by more than {1e3 * LEAST:g} mm.",
    ]


def _room(layout: ViewLayout, sheet: Sheet, notes: int) -> int:
    """Give how many rows the block may have above the profile and the names over it."""
    factor = sheet.paper.factor
    top = layout.profile.up(float(layout.high[2])) + _ABOVE * factor
    if top > layout.corner[1]:
        top = MARGIN * factor  # the block stands below the body plan
    free = (layout.corner[1] - top) / factor - block_height(0, notes)
    return max(int(free / ROW), 0)


def _dimensions(old: Drawing, new: Drawing) -> Rows:
    """Give principal dimensions before and after."""
    was, now = old.particulars, new.particulars
    return [
        (words, f"{a:.3f} m" if f"{a:.3f}" == f"{b:.3f}" else f"{a:.3f} > {b:.3f} m")
        for words, a, b in (
            ("Length between perpendiculars", was.length, now.length),
            ("Length of hull, moulded", _extent(old), _extent(new)),
            ("Breadth, moulded", was.breadth, now.breadth),
            ("Depth, moulded", was.depth, now.depth),
            ("Design draught, moulded", was.draught, now.draught),
        )
    ]


def _extent(plan: Drawing) -> float:
    return float(np.ptp(plan.bounds[:, 0]))


def _number(number: NumberComparison) -> tuple[str, str]:
    unit = "" if number.unit == "-" else f" {number.unit}"
    values = f"{amount(number.before, number.digits)} > {amount(number.after, number.digits)}"
    return number.printed_symbol, values + unit


def _line(line: LineComparison) -> tuple[str, str]:
    way = "" if line.shift is None else f" {line.shift.direction}"
    return line.name, f"{1e3 * line.length:.1f} mm{way}"


# --------------------------------------------------------------------------------------
# A comparison of two hulls as a PDF: both lines plans on one sheet, then tables.

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


def comparison_pdf(
    parent: HasState, variant: HasState, found: HullComparison | None = None
) -> bytes:
    """Give a comparison as a PDF; the same bytes each time.

    The first page, A3, has the lines plan of the variant over the parent's; upright A4 pages
    with all lines that moved, hydrostatics, and the form parameters that differ follow.

    Parameters
    ----------
    parent, variant : Hull
        The hulls.
    found : HullComparison, optional
        What `Hull.compare` tells of them, if it is at hand.

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
    >>> comparison_pdf(parent, parent.vary(set={"breadth": 11.0}).hull)[:5]
    b'%PDF-'
    """
    sheets = comparison_sheets(parent, variant, found)
    return pdf_of(sheets, f"{_TITLE}: {variant.state.particulars.name}")


def comparison_sheets(
    parent: HasState, variant: HasState, found: HullComparison | None = None
) -> list[Sheet]:
    """Give a comparison as pages; arguments and errors as for `comparison_pdf`."""
    require_matplotlib()
    for name, hull in (("parent", parent), ("variant", variant)):
        if not isinstance(getattr(hull, "state", None), HullState):
            raise WrongTypeError(f"{name} is {shown(hull)}", "in a picture", "give a Hull")
    if found is None:
        found = compare(parent, variant)
    instance(found, HullComparison, "found", "in a picture")
    flow = PageFlow(lambda sheet, first: _begin(found, sheet, first))
    flow.turn()
    _lines(flow, found)
    principal = [found.hydrostatic(name) for name in PRINCIPAL]
    _numbers(flow, "Hydrostatics that differ", principal)
    _numbers(flow, "Form parameters that differ", found.parameters)
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
                for line in wrap_words(sheet, words, 0.94 * (RIGHT - LEFT), 1.0):
                    y -= 4.0
                    sheet.text((LEFT, y), line, across="left", up="baseline", name="label/place")
    return y - 4.0


def _lines(flow: PageFlow, found: HullComparison) -> None:
    """Tell all lines that moved, the farthest first, and in words what else there is."""
    moved = visibly_moved(found)
    rows = [_Row(tuple((cell,) for cell in line_cells(line)), _LINE_COLUMNS) for line in moved]
    head = _Row(tuple((cell,) for cell in LINE_HEAD), _LINE_COLUMNS, GREY)
    flow.part("Lines that moved, the farthest first", rows, columns=1, head=head)
    _words(flow, "All lines", [counts(found), *line_words(found)])


def _numbers(flow: PageFlow, title: str, numbers: Sequence[NumberComparison]) -> None:
    differ = that_differ(numbers)
    rows = [_Row(_named(flow.sheet, each), _NUMBER_COLUMNS) for each in differ]
    name, symbol, *cells = NUMBER_HEAD
    head = _Row(tuple((cell,) for cell in (symbol, name, *cells)), _NUMBER_COLUMNS, GREY)
    flow.part(title, rows, columns=1, head=head)
    remarks = [*reason_words(differ), *alike_words(numbers)]
    if remarks:
        _words(flow, f"{title}: remarks", remarks)


def _named(sheet: Sheet, number: NumberComparison) -> tuple[tuple[str, ...], ...]:
    """Give the cells of a number, its name in as many lines as it needs."""
    _, symbol, *cells = number_cells(number)
    name = tuple(wrap_words(sheet, number.title, _NAME, _SMALL))
    return ((symbol,), name, *((cell.replace("-", "−"),) for cell in cells))


def _words(flow: PageFlow, title: str, words: Iterable[str]) -> None:
    """Write sentences over the whole width."""
    room = 0.94 * (RIGHT - LEFT)  # the same words are a little wider on a screen
    rows = [_Row((tuple(wrap_words(flow.sheet, each, room, _SMALL)),), ((1.0, "left"),))
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
