"""The report of an adoption as a table, one row per curve."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import zip_longest

from assoc_hull.edit.adoption.report import AdoptionReport, LineReport
from assoc_hull.io.slicing.sources import SmoothReport

__all__ = ["line_table"]

_WIDTH = 160
"""Room for every column, whatever is printed to: a table that is cut tells nothing."""

_SMOOTHED = ("points", "noise", "smoothed", "band")
_ADOPTED = (
    "median", "p95", "max", "allowed", "at x, y, z (m)", "crossings", "adopted", "placed",
    "inflections",
)  # fmt: skip


def line_table(adoption: AdoptionReport, smoothing: Sequence[SmoothReport] = ()) -> str:
    """Write a row per curve; lengths in mm but for places.

    Parameters
    ----------
    adoption : AdoptionReport
        Per curve.
    smoothing : sequence of SmoothReport
        Of the piece behind each curve, if it was smoothed.

    Examples
    --------
    >>> from assoc_hull.cli.line_table import line_table
    >>> from assoc_hull.shipped.series60 import series60_adopted
    >>> print(line_table(series60_adopted(0.70)[1]).splitlines()[0].split()[:4])
    ['line', 'median', 'p95', 'max']
    """
    from rich import box
    from rich.console import Console
    from rich.table import Table

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, show_edge=False)
    table.add_column("line")
    for title in (*(_SMOOTHED if smoothing else ()), *_ADOPTED):
        table.add_column(title, justify="right", no_wrap=True)
    for line, piece in zip_longest(adoption.lines, smoothing):
        table.add_row(line.line, *_smoothed(piece, line), *_adopted(line))
    console = Console(width=_WIDTH, color_system=None, force_terminal=False, legacy_windows=False)
    with console.capture() as text:
        console.print(table)
    rows = [row.rstrip() for row in text.get().splitlines()]
    return "\n".join([*rows, "", *_legend(bool(smoothing))])


def _legend(smoothed: bool) -> Iterator[str]:
    """Say what the columns mean."""
    given = "smooth" if smoothed else "given"
    if smoothed:
        yield "points: given > of the smooth line; noise: of the given points, mm; smoothed: how"
        yield "far the smooth line passes the farthest of them, mm; band: how far the hull may lie"
        yield "off the adopted curve, mm"
    yield f"median, p95, max: distances of the {given} line's points from the adopted curve, mm;"
    yield "allowed, at: for the farthest of them; crossings, adopted, placed: points that define"
    yield f"the curve; inflections: of the {given} line > of the adopted curve"


def _smoothed(piece: SmoothReport | None, line: LineReport) -> Iterator[str]:
    if piece is not None:
        yield f"{piece.given} > {piece.points}"
        yield f"{1e3 * piece.noise:.2f}"
        yield f"{1e3 * piece.residual:.2f}"
        yield f"{1e3 * (piece.band + line.deviation):.2f}"


def _adopted(line: LineReport) -> Iterator[str]:
    yield f"{1e3 * line.deviation_median:.2f}"
    yield f"{1e3 * line.deviation_p95:.2f}"
    yield f"{1e3 * line.deviation:.2f}"
    yield f"{1e3 * line.tolerance:.1f}"
    yield ", ".join(f"{value:.2f}" for value in line.place)
    for count in (line.crossings, line.adopted, line.placed):
        yield str(count)
    yield f"{line.inflections_given} > {line.inflections}"
