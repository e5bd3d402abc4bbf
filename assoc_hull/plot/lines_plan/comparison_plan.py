"""The lines plan of a variant over that of its parent."""

from __future__ import annotations

from typing import TYPE_CHECKING

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.record_fields import FIELDS
from assoc_hull.plot.lines_plan.compare import overlay, pairs_of
from assoc_hull.plot.lines_plan.drawing import Drawing, Sketchable, drawing
from assoc_hull.plot.lines_plan.layout import BLOCK, Layout, lay_out
from assoc_hull.plot.lines_plan.movement import LEAST
from assoc_hull.plot.lines_plan.plan import captions
from assoc_hull.plot.lines_plan.views import Views, body_halves
from assoc_hull.plot.sheet.paper import MARGIN, PaperName, Pen
from assoc_hull.plot.sheet.sheet import Path_, Sheet, save
from assoc_hull.plot.sheet.title_block import ROW, block_height, frame, title_block
from assoc_hull.variation.comparing.cells import amount, counts
from assoc_hull.variation.comparing.compare import HullComparison
from assoc_hull.variation.comparing.lines import LineComparison
from assoc_hull.variation.comparing.number_comparison import NumberComparison

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["comparison_plan", "comparison_plan_sheet"]

_PARENT = Pen(0.16, "0.45", over=1.8)
_NUMBERS = ("volume", "lcb", "kmt", "wetted_surface", "cb", "cp", "cw")
_WORST = 8
_ABOVE = 12.0  # of the profile, for the names of its buttocks, mm at A3


def comparison_plan(
    parent: Sketchable,
    variant: Sketchable,
    path: Path_ | None = None,
    *,
    paper: PaperName = "A3",
    title: str | None = None,
    found: HullComparison | None = None,
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
        What `assoc_hull.compare` tells of both: numbers, and the lines that moved farthest, then
        stand in the block.

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
        An unknown paper or ending.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.plot import comparison_plan
    >>> figure = comparison_plan(wigley(), wigley(breadth=11.0))
    """
    figure = comparison_plan_sheet(parent, variant, paper=paper, title=title, found=found).figure
    if path is not None:
        save(figure, path)
    return figure


def comparison_plan_sheet(
    parent: Sketchable,
    variant: Sketchable,
    *,
    paper: PaperName = "A3",
    title: str | None = None,
    found: HullComparison | None = None,
) -> Sheet:
    """Give the plan as a sheet; arguments and errors as for `comparison_plan`."""
    old, new = drawing(parent), drawing(variant)
    sheet = Sheet(paper)
    layout = lay_out(attrs.evolve(new, lines=(*new.lines, *old.lines)), sheet.paper)
    frame(sheet, MARGIN * sheet.paper.factor)
    _block(sheet, layout, title or new.particulars.name, _dimensions(old, new), found)
    captions(sheet, new, layout)
    views = Views(sheet, new, layout.low, layout.high)
    views.profile(layout.profile)
    views.half_breadth(layout.half)
    views.body(layout.body)
    _overlay(views, layout, old)
    return sheet


def _overlay(views: Views, layout: Layout, old: Drawing) -> None:
    """Draw what the parent was, and what of the variant lies elsewhere."""
    for view, families in (
        (layout.profile, ("boundary", "buttocks")),
        (layout.half, ("boundary", "waterlines")),
    ):
        for family in families:
            pairs = pairs_of(old.of(family), views.drawing.of(family))
            overlay(views.sheet, view, pairs, _PARENT)
    before = Views(views.sheet, old, layout.low, layout.high)
    halves = (body_halves(each.sections, views.middle) for each in (before, views))
    for half, was, now in zip((layout.body.mirrored(), layout.body), *halves, strict=True):
        overlay(views.sheet, half, pairs_of(was, now), _PARENT)


Rows = list[tuple[str, str]]


def _block(
    sheet: Sheet, layout: Layout, title: str, dimensions: Rows, found: HullComparison | None
) -> None:
    """Write what both are, and what is known of their differences."""
    profile, body = layout.profile.denominator, layout.body.denominator
    rows = [*dimensions, ("Scale", f"1:{profile:g}, body plan 1:{body:g}, {sheet.paper.name}")]
    notes = [
        "Grey: the parent, where they differ.",
        f"Red: the variant where it lies off the parent by more than {1e3 * LEAST:g} mm.",
        "Moulded lines, m; x forward from AP, z upward from the base line.",
    ]
    if found is not None:
        notes.append(f"Lines: {counts(found)}.")
        rows += [_number(found.hydrostatic(name)) for name in _NUMBERS]
        rows += [_line(line) for line in found.worst(_WORST)]
    width = BLOCK * sheet.paper.factor
    title_block(sheet, layout.corner, width, title, rows[: _room(layout, sheet, len(notes))], notes)


def _room(layout: Layout, sheet: Sheet, notes: int) -> int:
    """Give how many rows the block may have above the profile and the names over it."""
    factor = sheet.paper.factor
    top = layout.profile.up(float(layout.high[2])) + _ABOVE * factor
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
    return FIELDS[number.symbol].symbol, values + unit


def _line(line: LineComparison) -> tuple[str, str]:
    way = "" if line.shift is None else f" {line.shift.direction}"
    return line.name, f"{1e3 * line.length:.1f} mm{way}"
