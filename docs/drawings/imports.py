"""What a bad import looks like: one table of offsets, as it is and spoilt in five ways."""

import csv
import io
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import assoc_hull as ah
from drawings.common import ACCENT, INK, PALE, SHARED

__all__ = ["bad_imports"]

Rows = list[list[str]]

_FIRST = 1
"""Row of the first station, behind the header; stations stand in the first column."""


def bad_imports() -> Figure:
    """Draw sections, and waterlines where a station is wrong, of hulls that were accepted."""
    panels: tuple[tuple[str, Callable[[Rows], None], str], ...] = (
        ("as it is", lambda rows: None, "sections"),
        ("a decimal point slipped", _slip, "sections"),
        ("two columns exchanged", _exchange, "sections"),
        ("two stations exchanged", _stations, "waterlines"),
        ("a station twice, the rest a row lower", _shift, "waterlines"),
        ("a station left out", _lose, "waterlines"),
    )
    figure, axes = plt.subplots(2, 3, figsize=(9.4, 4.9), layout="constrained")
    head, table = _table()
    for ax, (title, spoil, view) in zip(axes.flat, panels, strict=True):
        rows = [list(row) for row in table]
        spoil(rows)
        hull = _read(head, rows)
        _draw(ax, hull, view)
        ax.set_title(title, fontsize=9, color=INK)
        ax.set_xlabel(_told(hull), fontsize=7, color=INK)
    return figure


def _table() -> tuple[str, Rows]:
    """Give comments and cells of the table of Series 60 CB .70, waterlines alone."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "offsets.csv"
        ah.examples.series60(cb=0.70).export(path)
        lines = path.read_text("utf-8").splitlines()
    head = "\n".join(line for line in lines if line.startswith("#"))
    rows = list(csv.reader(line for line in lines if line and not line.startswith("#")))
    ends = [k for k, row in enumerate(rows) if k and row[0] == rows[0][0]]
    return head, rows[: ends[0]] if ends else rows


def _read(head: str, rows: Rows) -> ah.Hull:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "offsets.csv"
        path.write_text(f"{head}\n{text.getvalue()}", "utf-8")
        return ah.read(path, length=121.92, accept=True)


def _columns(rows: Rows) -> list[int]:
    return [k for k, name in enumerate(rows[0]) if name.startswith("wl")]


def _slip(rows: Rows) -> None:
    row, column = len(rows) // 2, _columns(rows)[5]
    rows[row][column] = f"{10.0 * float(rows[row][column]):g}"


def _exchange(rows: Rows) -> None:
    one, other = _columns(rows)[3:5]
    for row in rows[_FIRST:]:
        row[one], row[other] = row[other], row[one]


def _stations(rows: Rows) -> None:
    for column in _columns(rows):
        rows[12][column], rows[14][column] = rows[14][column], rows[12][column]


def _shift(rows: Rows) -> None:
    columns, first = _columns(rows), 9
    for row in range(len(rows) - 1, first, -1):
        for column in columns:
            rows[row][column] = rows[row - 1][column]


def _lose(rows: Rows) -> None:
    del rows[5]


def _told(hull: ah.Hull) -> str:
    """Give the verdict of an import, and the kinds of what it found."""
    notes = hull.adoption.notes if hull.adoption else ()
    verdict = next(note for note in notes if note.startswith("verdict"))
    found = [note.split(": ")[1] for note in notes if note.startswith(("fault", "suspicion"))]
    kinds = list(dict.fromkeys(found))
    more = ", ..." if len(kinds) > 3 else ""
    return verdict.removeprefix("verdict: ") + ("\n" + ", ".join(kinds[:3]) + more if kinds else "")


def _draw(ax: Axes, hull: ah.Hull, view: str) -> None:
    """Draw lines of a group: sections as a body plan, waterlines from above."""
    for line in hull.groups[view].lines.values():
        for curve in line.curves:
            points = np.array(curve.polyline(16))
            if view == "sections":
                side = -1.0 if points[0, 0] < 60.96 else 1.0
                ax.plot(side * points[:, 1], points[:, 2], color=SHARED, linewidth=0.7)
            else:
                ax.plot(points[:, 0], points[:, 1], color=ACCENT, linewidth=0.7)
    ax.axvline(0.0, color=PALE, linewidth=0.5)
    if view == "sections":
        # One scale for all: a section that leaves the picture is what the eye is to see.
        ax.set(xlim=(-10.0, 14.0), ylim=(-2.0, 12.0))
    ax.set_aspect("equal" if view == "sections" else 6.0)
    ax.tick_params(labelsize=7)
