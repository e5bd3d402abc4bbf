r"""Numbers as tables of offsets print them: decimals, fractions, feet-inches-eighths, commas.

Examples
--------
>>> from assoc_hull.io.tables.cell_numbers import cell_value, label_number
>>> cell_value("12-6-3+"), cell_value("1.52"), label_number("9 1/2")
(12.536458333333334, 1.52, 9.5)
"""

from __future__ import annotations

import math
import re

__all__ = [
    "BLANKS",
    "EIGHTH",
    "cell_value",
    "is_eighths",
    "label_number",
    "number_like",
    "with_points",
]

BLANKS = frozenset({"", "-", "--", "\N{EN DASH}", "\N{EM DASH}"})
"""Cells that hold no number."""

EIGHTH = 1.0 / 96.0
"""An eighth of an inch in feet: the unit of cells such as ``12-6-3``."""

_NUMBER = re.compile(r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]{1,3})?")
_EIGHTHS = re.compile(r"(-?)([0-9]{1,3})-([0-9]{1,2})-([0-9])([-+]?)")
_FRACTION = re.compile(r"(-?)(?:([0-9]{1,4})[ -]?)??([0-9]{1,2})/([0-9]{1,2})")
_SIGNS = {"\N{VULGAR FRACTION ONE HALF}": " 1/2", "\N{VULGAR FRACTION ONE QUARTER}": " 1/4",
          "\N{VULGAR FRACTION THREE QUARTERS}": " 3/4"}  # fmt: skip
_COMMA = re.compile(r"(?<=[0-9]),(?=[0-9]+([eE][-+]?[0-9]{1,3})?$)|^(-?),(?=[0-9]+$)")


_DASH = re.compile(r"\s*-\s*(?=[0-9.])")


def _closed(cell: str) -> str:
    """Give a cell without blanks beside its dashes: ``12 - 6 - 3``."""
    return _DASH.sub("-", cell)


def is_eighths(cell: str) -> bool:
    """Tell whether a cell is in feet, inches and eighths: ``12-6-3``, with ``+`` a sixteenth."""
    found = _EIGHTHS.fullmatch(_closed(cell))
    return found is not None and int(found[3]) < 12 and int(found[4]) < 8


def cell_value(cell: str) -> float | None:
    """Give the number in a cell, nan for a blank, None for anything else.

    Feet-inches-eighths are in feet; ``+`` is a sixteenth of an inch more, ``-`` one less.
    """
    if cell in BLANKS:
        return math.nan
    cell = _closed(cell)
    if _NUMBER.fullmatch(cell):
        return float(cell)
    if not is_eighths(cell):
        return None
    sign, feet, inches, eighths, more = _EIGHTHS.fullmatch(cell).groups()  # type: ignore[union-attr]
    half = {"+": 0.5, "-": -0.5, "": 0.0}[more]
    value = int(feet) + int(inches) / 12.0 + (int(eighths) + half) * EIGHTH
    return -value if sign else value


def number_like(cell: str) -> bool:
    """Say whether a cell is blank or a number."""
    return cell_value(cell) is not None


def label_number(label: str) -> float | None:
    """Give the number that a label shows: as a cell, or with a fraction such as ``9 1/2``."""
    for sign, plain in _SIGNS.items():
        label = label.replace(sign, plain)
    label = label.strip()
    if label in BLANKS:
        return None
    value = cell_value(with_points(label))
    found = _FRACTION.fullmatch(label)
    if value is not None or not found or int(found[4]) == 0:
        return value
    value = int(found[2] or 0) + int(found[3]) / int(found[4])
    return -value if found[1] else value


def with_points(cell: str) -> str:
    """Give a cell with its decimal comma, if it has one, turned into a point."""
    return _COMMA.sub(lambda found: f"{found[2] or ''}.", cell)
