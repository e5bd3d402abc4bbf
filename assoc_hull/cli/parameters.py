"""The command that tells the form parameters of a hull."""

from __future__ import annotations

import argparse
import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from assoc_hull.cli.arguments import Commands, add_command, add_json
from assoc_hull.cli.floating_terms import add_draughts
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.problems import check_other_target, check_target
from assoc_hull.cli.screw_terms import add_screw, screw_of
from assoc_hull.errors import BadInputError
from assoc_hull.sources import open as open_hull

if TYPE_CHECKING:
    from assoc_hull.analysis.form.parameter import Parameter
    from assoc_hull.analysis.form.report import FormReport

__all__ = ["add"]

_ENDINGS = (".txt", ".pdf", ".csv", ".xlsx", ".json")
_TABLES = ("particulars", "hydrostatic", "hull form", "bulb and resistance", "measures")
_CALL = "in the call"


def add(commands: Commands) -> None:
    """Add ``parameters``."""
    parser = add_command(
        commands, "parameters", "tell the form parameters of a hull", _parameters,
        """assoc-hull parameters ship.hull --draught 18
        assoc-hull parameters ship.hull --draughts 18.5 17.5 --only Cb,Cp,LCB --json
        assoc-hull parameters ship.hull --table "hull form" -o form.pdf
        assoc-hull parameters ship.hull --shaft-height 4.2 --propeller-diameter 8.5 -o form.txt
        assoc-hull parameters --catalogue --json""",
    )  # fmt: skip
    parser.add_argument(
        "hull", metavar="HULL", type=Path, nargs="?", help="a .hull or .hull.json file"
    )
    _add_position(parser)
    add_screw(parser)
    _add_output(parser)


def _add_position(parser: argparse.ArgumentParser) -> None:
    add_draughts(parser)
    parser.add_argument(
        "--rho", type=float, default=1.025, metavar="R",
        help="density of the water, t/m3 (default: 1.025)",
    )  # fmt: skip
    parser.add_argument(
        "--shell-factor", type=float, default=1.0, metavar="F",
        help="displacement over that of the moulded volume (default: 1)",
    )  # fmt: skip
    parser.add_argument(
        "--transom", action="store_true", help="count the immersed transom as wetted surface"
    )


def _add_output(parser: argparse.ArgumentParser) -> None:
    group = parser.add_mutually_exclusive_group()
    group.add_argument(
        "--only", metavar="SYMBOLS", help="entries wanted, as Cb,Cp (default: all of them)"
    )
    group.add_argument(
        "--table", action="append", choices=_TABLES,
        help="a part of the catalogue; may be given again",
    )  # fmt: skip
    parser.add_argument(
        "--catalogue", action="store_true", help="tell the definitions instead; takes no HULL"
    )
    parser.add_argument(
        "-o", "--out", type=Path, metavar="FILE", help="a .txt, .pdf, .csv, .xlsx or .json file"
    )
    add_json(parser)


def _parameters(arguments: argparse.Namespace) -> int:
    if arguments.catalogue:
        return _catalogue(arguments)
    from assoc_hull.io.tables.form_json import form_document
    from assoc_hull.io.tables.form_text import form_text

    _check_target(arguments)
    report = _report(arguments)
    words, saved = form_text(report), []
    if arguments.out is not None:
        from assoc_hull.plot.diagrams.form_files import write_form_report

        with progress(f"writing {arguments.out}"):
            write_form_report(report, arguments.out)
        saved.append(str(arguments.out))
    words += "".join(f"\nwritten: {each}" for each in saved)
    emit(arguments, form_document(report) | {"saved": saved}, words.rstrip("\n"))
    return 0


def _check_target(arguments: argparse.Namespace) -> None:
    """Refuse, before anything is computed, what could not be done."""
    if arguments.hull is None:
        raise BadInputError("no hull is named", _CALL, "give HULL, or --catalogue")
    if arguments.out is not None:
        check_target(arguments.out, _ENDINGS)
        check_other_target(arguments.out, arguments.hull)


def _report(arguments: argparse.Namespace) -> FormReport:
    """Measure what was asked."""
    from assoc_hull.analysis.form.report import form_report

    screw = screw_of(arguments)
    hull = open_hull(arguments.hull)
    with progress("measuring"):
        return form_report(
            hull, draught=arguments.draught, draughts=arguments.draughts, screw=screw,
            rho=arguments.rho, shell_factor=arguments.shell_factor, transom=arguments.transom,
            only=_symbols(arguments), tables=arguments.table,
            date=datetime.date.today().isoformat(),
        )  # fmt: skip


def _symbols(arguments: argparse.Namespace) -> list[str] | None:
    if arguments.only is None:
        return None
    found = [each.strip() for each in arguments.only.split(",") if each.strip()]
    if not found:
        raise BadInputError("no symbol is named", "in --only", "give some, as Cb,Cp")
    return found


def _catalogue(arguments: argparse.Namespace) -> int:
    """Tell the definitions."""
    from assoc_hull.io.tables.form_json import catalogue_document, catalogue_json
    from assoc_hull.io.tables.form_text import catalogue_text
    from assoc_hull.io.write_file import write_whole

    if arguments.hull is not None:
        raise BadInputError("a hull and --catalogue are both given", _CALL, "give one of them")
    entries = _entries(arguments)
    words, saved = catalogue_text(entries).rstrip("\n"), []
    if arguments.out is not None:
        check_target(arguments.out, (".txt", ".json"))
        as_json = arguments.out.suffix == ".json"
        text = catalogue_json(entries) if as_json else catalogue_text(entries)
        write_whole(arguments.out, text.encode())
        saved.append(str(arguments.out))
    document = catalogue_document(entries) | {"saved": saved}
    emit(arguments, document, "\n".join([words, *(f"written: {each}" for each in saved)]))
    return 0


def _entries(arguments: argparse.Namespace) -> list[Parameter]:
    """Give the entries wanted."""
    from assoc_hull.analysis.form.catalogue import CATALOGUE

    symbols = _symbols(arguments)
    if symbols is not None:
        return [CATALOGUE[symbol] for symbol in symbols]
    tables = arguments.table or _TABLES
    return [each for each in CATALOGUE.values() if each.table in tables]
