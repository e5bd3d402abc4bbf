"""The command that tells how a hull floats: one position, a table of many, or pictures.

Words come first: one position with errors and meanings, or a table as wide as a terminal. The
command takes draughts, trim, heel, water and appendages, and writes tables and pictures.
"""

from __future__ import annotations

import argparse
import datetime
import math
import textwrap
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from assoc_hull.analysis.hydrostatics.record import FIELDS, HydrostaticTable, RecordField
from assoc_hull.cli.arguments import (
    PICTURE_ENDINGS,
    Commands,
    add_command,
    add_draughts,
    add_hull,
    add_json,
    add_water,
    appendages_of,
    density_of,
    metres,
    number_range,
)
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.problems import check_other_target, check_target
from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import open as open_hull

if TYPE_CHECKING:
    from assoc_hull.analysis.hydrostatics.floating_body import Appendage

__all__ = [
    "add_hydrostatics",
    "hydrostatic_document",
    "table_words",
]

# --------------------------------------------------------------------------------------
# Hydrostatics in words: one position with errors and meanings, or a table of many.

_WIDTH = 160
_ACROSS = 8
"""Positions side by side."""


def hydrostatic_document(table: HydrostaticTable, angle: float | None) -> dict[str, Any]:
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


def _number(value: float, field: RecordField) -> str:
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


# --------------------------------------------------------------------------------------
# The command that tells how a hull floats.

_TABLES = (".csv", ".xlsx", ".pdf")
_PICTURES = ("curves", "areas", "bonjean")


def add_hydrostatics(commands: Commands) -> None:
    """Add ``hydrostatics``."""
    parser = add_command(
        commands, "hydrostatics",
        _hydrostatics,
        """assoc-hull hydrostatics ship.hull --draught 18
        assoc-hull hydrostatics ship.hull --draughts 18.5 17.5 --heel 5 --kg 11.2 --json
        assoc-hull hydrostatics ship.hull --table 4:18:1 --trims -1 0 1 -o table.xlsx
        assoc-hull hydrostatics ship.hull --table 4:18:1 -o table.pdf
        assoc-hull hydrostatics ship.hull --table 4:18:1 --water fresh --plot curves.pdf
        assoc-hull hydrostatics ship.hull --weight 150000 --lcg 148 --kg 11
        assoc-hull hydrostatics demihull.hull --draught 2.1 --demihulls 2 --separation 8.4
        assoc-hull hydrostatics ship.hull --appendage "rudder,38,2.5,0,7,120" --transom""",
    )  # fmt: skip
    add_hull(parser)
    _add_position(parser)
    _add_terms(parser)
    _add_output(parser)


def _add_position(parser: argparse.ArgumentParser) -> None:
    group = add_draughts(parser)
    group.add_argument("--table", metavar="FROM:TO:STEP", help="mean draughts of a table, m")
    group.add_argument(
        "--weight", type=float, metavar="W", help="find the draughts that carry it, t"
    )
    parser.add_argument(
        "--trims", type=metres, nargs="+", metavar="M", help="with --table: + by the stern, m"
    )
    parser.add_argument("--lcg", type=metres, metavar="X", help="with --weight: from AP, m")
    parser.add_argument("--heel", type=float, default=0.0, metavar="DEG", help="+ starboard down")


def _add_terms(parser: argparse.ArgumentParser) -> None:
    add_water(parser)
    parser.add_argument("--kg", type=metres, metavar="Z", help="centre of gravity above base, m")
    parser.add_argument(
        "--transom", action="store_true", help="count the immersed transom as wetted surface"
    )
    parser.add_argument(
        "--demihulls", type=int, choices=(1, 2), default=1,
        help="2: tell the numbers of a ship of two such demihulls",
    )  # fmt: skip
    parser.add_argument(
        "--separation", type=metres, metavar="M", help="between the centre planes of two, m"
    )
    parser.add_argument(
        "--keel-thickness", type=metres, default=0.0, metavar="M",
        help="from the base line to the underside of keel, m",
    )  # fmt: skip
    parser.add_argument(
        "--draught-to", choices=("moulded", "keel"), default="moulded",
        help="where the draughts given are measured from (default: the base line)",
    )  # fmt: skip


def _add_output(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--no-estimate",
        action="store_true",
        help="neither estimate how far values may be off, nor compare numbers by other routes",
    )
    parser.add_argument("-o", "--out", type=Path, metavar="FILE", help="a .csv, .xlsx or .pdf file")
    parser.add_argument("--plot", type=Path, metavar="FILE", help="a .pdf, .svg or .png file")
    parser.add_argument(
        "--plot-of", choices=_PICTURES,
        help="hydrostatic curves (default for a table), sectional areas (default for one "
        "position) or Bonjean curves",
    )  # fmt: skip
    add_json(parser)


def _hydrostatics(arguments: argparse.Namespace) -> int:

    _check_targets(arguments)
    hull = open_hull(arguments.hull)
    with progress("integrating"):
        table = _table(hull, arguments)
        angle = _deck_edge(hull, table)
    saved = _saved(hull, table, arguments)
    words = "\n".join([table_words(table, angle), *(f"written: {each}" for each in saved)])
    emit(arguments, hydrostatic_document(table, angle) | {"saved": saved}, words)
    return 0


def _deck_edge(hull: Hull, table: HydrostaticTable) -> float | None:
    """Give the heel at which the deck edge goes under; nan where she does not float upright."""
    from assoc_hull.analysis.hydrostatics.draughts_from_weight import deck_edge_angle

    if len(table) != 1:
        return None
    header = table.header
    try:
        return deck_edge_angle(
            hull, table.positions[0], header.appendages,
            demihulls=header.demihulls, separation=header.separation,
        )  # fmt: skip
    except OutOfRangeError:
        return math.nan


def _check_targets(arguments: argparse.Namespace) -> None:
    """Refuse, before anything is computed, what could not be done."""
    if arguments.out is not None:
        check_target(arguments.out, _TABLES)
        check_other_target(arguments.out, arguments.hull)
    if arguments.plot is not None:
        check_target(arguments.plot, PICTURE_ENDINGS)
    elif arguments.plot_of is not None:
        raise BadInputError("--plot-of is given without --plot", "in the call", "name a file")
    for name, needed in (("trims", "table"), ("lcg", "weight")):
        if getattr(arguments, name) is not None and getattr(arguments, needed) is None:
            what = f"--{name} is given without --{needed}"
            raise BadInputError(what, "in the call", "give both, or neither")
    _check_demihulls(arguments)


def _check_demihulls(arguments: argparse.Namespace) -> None:
    """Refuse what is not there for two demihulls: drawings are of one, weights are even."""
    if arguments.demihulls == 1:
        return
    if arguments.plot is not None and (arguments.plot_of or "curves") != "curves":
        what = f"--plot-of {arguments.plot_of} is given with --demihulls 2"
        raise BadInputError(what, "in the call", "draw it of one demihull")
    if arguments.plot is not None and arguments.table is None:
        what = "--plot is given with --demihulls 2 and one position"
        raise BadInputError(what, "in the call", "give --table, or draw one demihull")
    if arguments.weight is not None and (arguments.heel or arguments.appendage):
        what = "--weight is given with --demihulls 2 and a heel or an appendage"
        raise BadInputError(what, "in the call", "give draughts, or leave these out")


def _table(hull: Hull, arguments: argparse.Namespace) -> HydrostaticTable:
    """Compute what was asked."""
    from assoc_hull.analysis.hydrostatics.hull_hydrostatics import hydrostatic_table

    rho, appendages = density_of(arguments), appendages_of(arguments)
    draughts, trims, moulded = _draughts(hull, arguments, rho, appendages)
    return hydrostatic_table(
        hull, draughts, trims, heel_deg=arguments.heel, rho=rho,
        shell_factor=arguments.shell_factor, kg=arguments.kg, transom=arguments.transom,
        on_error=arguments.on_error, appendages=appendages,
        keel_thickness=arguments.keel_thickness,
        draught_to="moulded" if moulded else arguments.draught_to,
        demihulls=arguments.demihulls, separation=arguments.separation,
        estimate=not arguments.no_estimate, date=datetime.date.today().isoformat(),
    )  # fmt: skip


def _draughts(
    hull: Hull, arguments: argparse.Namespace, rho: float, appendages: Sequence[Appendage]
) -> tuple[list[float], Sequence[float], bool]:
    """Give mean draughts and trims, and whether they are moulded whatever was asked."""
    if arguments.table is not None:
        return number_range(arguments.table, "--table"), arguments.trims or (0.0,), False
    if arguments.weight is not None:
        from assoc_hull.analysis.hydrostatics.draughts_from_weight import immersion

        found = immersion(
            # Upright, each demihull carries its share as if it were alone.
            hull, arguments.weight / arguments.demihulls, lcg=arguments.lcg, kg=arguments.kg,
            heel_deg=arguments.heel, rho=rho, shell_factor=arguments.shell_factor,
            appendages=appendages,
        )  # fmt: skip
        return [found.draught_mean], (found.trim_by_stern,), True
    if arguments.draughts is not None:
        aft, fore = arguments.draughts
        return [0.5 * (aft + fore)], (aft - fore,), False
    if arguments.draught is not None:
        return [arguments.draught], (0.0,), False
    return [hull.particulars.draught], (0.0,), True


def _saved(hull: Hull, table: HydrostaticTable, arguments: argparse.Namespace) -> list[str]:
    """Write table and picture, where they were asked; name the files."""
    saved: list[Any] = []
    if arguments.out is not None:
        if arguments.out.suffix.lower() == ".pdf":
            from assoc_hull.plot.booklet.write import write_hydrostatic_book

            write_hydrostatic_book(hull, table, arguments.out)
        else:
            from assoc_hull.io.tables.hydrostatics import write_hydrostatic_table

            write_hydrostatic_table(table, arguments.out)
        saved.append(arguments.out)
    if arguments.plot is not None:
        from assoc_hull.plot.diagrams.hydrostatics import plot_hydrostatics

        kind = arguments.plot_of or ("curves" if table.shape[0] > 1 else "areas")
        with progress(f"drawing {arguments.plot}"):
            plot_hydrostatics(hull, table, kind, arguments.plot)
        saved.append(arguments.plot)
    return [str(each) for each in saved]
