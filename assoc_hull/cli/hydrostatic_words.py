"""Hydrostatics in words: one position with errors and meanings, or a table of many."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterator
from typing import Any

from assoc_hull.analysis.hydrostatics.hydrostatic_table import HydrostaticTable
from assoc_hull.analysis.hydrostatics.record_fields import FIELDS, Field

__all__ = ["document", "table_words"]

_WIDTH = 160
_ACROSS = 8
"""Positions side by side."""


def document(table: HydrostaticTable, angle: float | None) -> dict[str, Any]:
    """Give a table as it stands in a JSON document; `angle` is that of the deck edge, degrees."""
    return {
        "header": table.header,
        "shape": table.shape,
        "positions": table.positions,
        "rows": table.rows,
        "freeboards": table.freeboards,
        "deck_edge_angle": angle,
        "shares": table.shares,
        "notes": table.notes,
    }


def table_words(table: HydrostaticTable, angle: float | None) -> str:
    """Say what a table holds.

    Parameters
    ----------
    table : HydrostaticTable
        Of one position or many.
    angle : float or None, degrees
        Heel at which the deck edge goes under, of one position.
    """
    single = len(table) == 1
    body = [_one(table)] if single else list(_many(table))
    lines = [*_head(table), "", *body, *_deck(table, angle), *_shares(table)]
    return "\n".join([*lines, *(f"note: {note}" for note in table.notes)])


def _head(table: HydrostaticTable) -> Iterator[str]:
    for title, words in table.header.lines():
        yield textwrap.fill(f"{title:14} {words}", 100, subsequent_indent=" " * 15)


def _one(table: HydrostaticTable) -> str:
    """Lay out one position: a row per value, with its error and what it is."""
    columns: list[tuple[str, Any]] = [
        ("", "left"), ("", "right"), ("", "left"), ("may be off by", "right"), ("", "left")
    ]  # fmt: skip
    rows = [
        [name, f"{float(values[0]):.4f}", "deg" if name == "heel_deg" else "m", "", ""]
        for name, values in table.draughts.items()
    ]
    for name, field in FIELDS.items():
        error = float(table.errors[name][0]) if name in table.errors else math.nan
        rows.append([name, _number(float(table.columns[name][0]), field), field.unit,
                     "" if math.isnan(error) else f"{error:.1e}", field.title])  # fmt: skip
    return _laid_out(columns, rows)


def _many(table: HydrostaticTable) -> Iterator[str]:
    """Lay out many positions side by side, some at a time: a column each."""
    for first in range(0, len(table), _ACROSS):
        part = range(first, min(first + _ACROSS, len(table)))
        columns: list[tuple[str, Any]] = [("", "left"), ("", "left"), *[("", "right")] * len(part)]
        rows = [
            [name, "deg" if name == "heel_deg" else "m", *(f"{values[i]:.4f}" for i in part)]
            for name, values in table.draughts.items()
        ]
        rows += [
            [name, field.unit, *(_number(float(table.columns[name][i]), field) for i in part)]
            for name, field in FIELDS.items()
        ]
        free = [f"{table.freeboards[i].least:.4f}" for i in part]
        yield _laid_out(columns, [*rows, ["freeboard", "m", *free]])
        yield ""


def _number(value: float, field: Field) -> str:
    return "-" if math.isnan(value) else f"{round(value, field.digits) + 0.0:.{field.digits}f}"


def _laid_out(columns: list[tuple[str, Any]], rows: list[list[str]]) -> str:
    from rich import box
    from rich.console import Console
    from rich.table import Table

    shown = any(title for title, _ in columns)
    grid = Table(box=box.SIMPLE_HEAD, pad_edge=False, show_edge=False, show_header=shown)
    for k, (title, justify) in enumerate(columns):
        grid.add_column(title, justify=justify, no_wrap=k < len(columns) - 1)
    for row in rows:
        grid.add_row(*row)
    console = Console(width=_WIDTH, color_system=None, force_terminal=False, legacy_windows=False)
    with console.capture() as text:
        console.print(grid)
    return "\n".join(row.rstrip() for row in text.get().splitlines())


def _deck(table: HydrostaticTable, angle: float | None) -> Iterator[str]:
    """Tell freeboard and deck edge of one position."""
    if len(table) != 1:
        return
    least, (x, y, z) = table.freeboards[0].least, table.freeboards[0].place
    yield ""
    yield f"freeboard {least:.4f} m, least at ({x:.3f}, {y:.3f}, {z:.3f}) m"
    if angle is None:
        yield "the deck edge stays dry to 89 degrees of heel"
    elif math.isnan(angle):
        yield "at these draughts the ship does not float upright: no angle of the deck edge"
    else:
        yield f"the deck edge goes under at {angle:.2f} degrees of heel, at this displacement"


def _shares(table: HydrostaticTable) -> Iterator[str]:
    """Tell what each appendage adds, at the deepest position."""
    where = " (at the last position)" if len(table) > 1 else ""
    for share in table.shares:
        volume, area, part = share.volume[-1], share.area[-1], share.percent[-1]
        words = f"adds {volume:g} m3, {part:.4g} % of the volume, and {area:g} m2 of surface"
        yield f"{share.appendage.name}: {words}{where}"
