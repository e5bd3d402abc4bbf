"""What stands at the top and at the foot of upright pages."""

from __future__ import annotations

from collections.abc import Sequence

from assoc_hull.plot.sheet.form_flow import LEFT, RIGHT
from assoc_hull.plot.sheet.pens import FRAME, LINE
from assoc_hull.plot.sheet.sheet import Sheet

__all__ = ["GREY", "page_foot", "page_head"]

GREY = "0.3"
"""Colour of words that matter less."""

_TOP, _LOW = 285.0, 17.0  # mm


def page_head(sheet: Sheet, ship: str, title: str, *, first: bool) -> float:
    """Write ship and title over a rule, larger on the first page; give its height, mm."""
    size, y = (2.3, _TOP - 7.0) if first else (1.3, _TOP - 4.0)
    name = " ".join(ship.split())
    room = RIGHT - LEFT - sheet.width(title, size=0.75 * size) - 6.0
    wide = sheet.width(name, size=size, bold=True)
    sheet.text((LEFT, y), name, size=size * min(1.0, room / max(wide, 1.0)), across="left",
               up="baseline", bold=True, name="label/ship")  # fmt: skip
    sheet.text((RIGHT, y), title, size=0.75 * size, across="right", up="baseline",
               name="label/form")  # fmt: skip
    y -= 2.6
    sheet.rule((LEFT, y), (RIGHT, y), FRAME, "head")
    return y


def page_foot(sheet: Sheet, lines: Sequence[str], number: str) -> None:
    """Write lines below a rule, and the number of the page."""
    sheet.rule((LEFT, _LOW), (RIGHT, _LOW), LINE, "foot")
    for k, line in enumerate(lines):
        sheet.text((LEFT, _LOW - 3.2 - 2.5 * k), line, size=0.72, across="left", up="baseline",
                   colour=GREY, name="label/foot")  # fmt: skip
    sheet.text((RIGHT, _LOW - 3.2), number, across="right", up="baseline", name="label/page")
