"""The command that tells how a hull floats."""

from __future__ import annotations

import argparse
import datetime
import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from assoc_hull.cli.arguments import PICTURE_ENDINGS, Commands, add_command, add_hull, add_json
from assoc_hull.cli.floating_terms import add_draughts, add_water, appendages_of, density_of, levels
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.problems import check_other_target, check_target
from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.hull import Hull
from assoc_hull.sources import open as open_hull

if TYPE_CHECKING:
    from assoc_hull.analysis.hydrostatics.appendage import Appendage
    from assoc_hull.analysis.hydrostatics.hydrostatic_table import HydrostaticTable

__all__ = ["add"]

_TABLES = (".csv", ".xlsx")
_PICTURES = ("curves", "areas", "bonjean")


def add(commands: Commands) -> None:
    """Add ``hydrostatics``."""
    parser = add_command(
        commands, "hydrostatics", "tell how a hull floats: volume, centres, stability at rest",
        _hydrostatics,
        """assoc-hull hydrostatics ship.hull --draught 18
        assoc-hull hydrostatics ship.hull --draughts 18.5 17.5 --heel 5 --kg 11.2 --json
        assoc-hull hydrostatics ship.hull --table 4:18:1 --trims -1 0 1 -o table.xlsx
        assoc-hull hydrostatics ship.hull --table 4:18:1 --water fresh --plot curves.pdf
        assoc-hull hydrostatics ship.hull --weight 150000 --lcg 148 --kg 11
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
        "--trims", type=float, nargs="+", metavar="M", help="with --table: + by the stern, m"
    )
    parser.add_argument("--lcg", type=float, metavar="X", help="with --weight: from AP, m")
    parser.add_argument("--heel", type=float, default=0.0, metavar="DEG", help="+ starboard down")


def _add_terms(parser: argparse.ArgumentParser) -> None:
    add_water(parser)
    parser.add_argument("--kg", type=float, metavar="Z", help="centre of gravity above base, m")
    parser.add_argument(
        "--transom", action="store_true", help="count the immersed transom as wetted surface"
    )
    parser.add_argument(
        "--keel-thickness", type=float, default=0.0, metavar="M",
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
    parser.add_argument("-o", "--out", type=Path, metavar="FILE", help="a .csv or .xlsx file")
    parser.add_argument("--plot", type=Path, metavar="FILE", help="a .pdf, .svg or .png file")
    parser.add_argument(
        "--plot-of", choices=_PICTURES,
        help="hydrostatic curves (default for a table), sectional areas (default for one "
        "position) or Bonjean curves",
    )  # fmt: skip
    add_json(parser)


def _hydrostatics(arguments: argparse.Namespace) -> int:
    from assoc_hull.cli.hydrostatic_words import document, table_words

    _check_targets(arguments)
    hull = open_hull(arguments.hull)
    with progress("integrating"):
        table = _table(hull, arguments)
        angle = _deck_edge(hull, table)
    saved = _saved(hull, table, arguments)
    words = "\n".join([table_words(table, angle), *(f"written: {each}" for each in saved)])
    emit(arguments, document(table, angle) | {"saved": saved}, words)
    return 0


def _deck_edge(hull: Hull, table: HydrostaticTable) -> float | None:
    """Give the heel at which the deck edge goes under; nan where she does not float upright."""
    from assoc_hull.analysis.hydrostatics.equilibrium import deck_edge_angle

    if len(table) != 1:
        return None
    try:
        return deck_edge_angle(hull, table.positions[0], table.header.appendages)
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


def _table(hull: Hull, arguments: argparse.Namespace) -> HydrostaticTable:
    """Compute what was asked."""
    from assoc_hull.analysis.hydrostatics.hydrostatics import hydrostatic_table

    rho, appendages = density_of(arguments), appendages_of(arguments)
    draughts, trims, moulded = _draughts(hull, arguments, rho, appendages)
    return hydrostatic_table(
        hull, draughts, trims, heel_deg=arguments.heel, rho=rho,
        shell_factor=arguments.shell_factor, kg=arguments.kg, transom=arguments.transom,
        on_error=arguments.on_error, appendages=appendages,
        keel_thickness=arguments.keel_thickness,
        draught_to="moulded" if moulded else arguments.draught_to,
        estimate=not arguments.no_estimate, date=datetime.date.today().isoformat(),
    )  # fmt: skip


def _draughts(
    hull: Hull, arguments: argparse.Namespace, rho: float, appendages: Sequence[Appendage]
) -> tuple[list[float], Sequence[float], bool]:
    """Give mean draughts and trims, and whether they are moulded whatever was asked."""
    if arguments.table is not None:
        return levels(arguments.table, "--table"), arguments.trims or (0.0,), False
    if arguments.weight is not None:
        from assoc_hull.analysis.hydrostatics.equilibrium import immersion

        found = immersion(
            hull, arguments.weight, lcg=arguments.lcg, kg=arguments.kg, heel_deg=arguments.heel,
            rho=rho, shell_factor=arguments.shell_factor, appendages=appendages,
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
