"""The command that writes a hull in the form of another program."""

from __future__ import annotations

import argparse
from pathlib import Path

from assoc_hull.cli.arguments import Commands, add_command, add_hull, add_json
from assoc_hull.cli.lengths import length
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.problems import check_other_target
from assoc_hull.errors import BadInputError
from assoc_hull.io.export_book import ExportReport
from assoc_hull.sources import open as open_hull

__all__ = ["add", "export_words"]

_FORMS = (
    "hull", "csv", "xlsx", "britfair", "delftship", "delftship-offsets", "gf", "dxf",
    "dxf-polylines", "dxf-plan",
)  # fmt: skip


def add(commands: Commands) -> None:
    """Add ``export``."""
    parser = add_command(
        commands, "export", "write offsets or sections for other programs", _export,
        """assoc-hull export ship.hull -o offsets.csv
        assoc-hull export ship.hull -o offsets.xlsx
        assoc-hull export ship.hull -o ship.bri
        assoc-hull export ship.hull -o ship.gf --json
        assoc-hull export ship.hull -o ship.txt --format delftship-offsets
        assoc-hull export ship.hull -o lines.dxf --biarcs 0.5mm
        assoc-hull export ship.hull -o arcs.csv --biarcs 1mm --least-radius 5cm --lines sections""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument(
        "-o", "--out", type=Path, required=True, metavar="FILE",
        help="a .csv, .xlsx, .bri, .gf, .txt (delftship) or .hull.json file; "
        "a .dxf or .csv file with --biarcs",
    )  # fmt: skip
    parser.add_argument(
        "--format", choices=_FORMS, help="where the ending of the name does not tell it"
    )
    arcs = parser.add_argument_group("arcs for production")
    arcs.add_argument(
        "--biarcs", type=length, metavar="TOL",
        help="write lines as circular arcs and straight lines that leave them by no more than "
        "TOL, such as 0.5mm; m without a unit",
    )  # fmt: skip
    arcs.add_argument(
        "--least-radius", type=length, metavar="R", help="radius of the sharpest arc, such as 50mm"
    )
    arcs.add_argument(
        "--entities", choices=("polylines", "arcs"),
        help="of a .dxf: a polyline per curve (default), or ARC and LINE one by one",
    )  # fmt: skip
    arcs.add_argument("--lines", nargs="+", metavar="NAME", help="lines or groups (default: all)")
    add_json(parser)


def _export(arguments: argparse.Namespace) -> int:
    _check_arcs(arguments)
    if arguments.biarcs is not None:
        from assoc_hull.cli.export_arcs import export_arcs

        return export_arcs(arguments)
    from assoc_hull.io.export import export, form_of

    form = form_of(arguments.out, arguments.format)
    check_other_target(arguments.out, arguments.hull)
    hull = open_hull(arguments.hull)
    with progress(f"writing {arguments.out}"):
        report = export(hull.state, arguments.out, form)
    emit(arguments, {"export": report}, export_words(report))
    return 0


def _check_arcs(arguments: argparse.Namespace) -> None:
    """Refuse what means nothing without, or beside, a tolerance for arcs.

    Raises
    ------
    BadInputError
        A drawing, radius or lines without the tolerance; a format with it.
    """
    name = str(arguments.out)
    if arguments.biarcs is None:
        told = {
            "a .dxf file holds arcs": name.lower().endswith(".dxf") and arguments.format is None,
            "--least-radius is one of arcs": arguments.least_radius is not None,
            "--lines chooses lines for arcs": arguments.lines is not None,
            "--entities is for a drawing of arcs": arguments.entities is not None,
        }
        for what, given in told.items():
            if given:
                raise BadInputError(what, f"at {name}", "add --biarcs 0.5mm")
    elif arguments.format is not None:
        what = "--format is none of arcs"
        raise BadInputError(what, f"at {name}", "leave it out, and end the file in .dxf or .csv")


def export_words(report: ExportReport) -> str:
    """Say what was written, how it was rounded, and what is not in the file."""
    rows = [
        f"{report.lines} lines in {report.curves} curves, {report.points} points",
        f"rounded by {1e3 * report.largest:.4f} mm at most (half a digit is "
        f"{1e3 * report.rounding:.4f} mm)",
    ]
    if report.chord:
        rows.append(
            f"straight lines between points leave the curves by {1e3 * report.chord:.2f} mm"
        )
    for title, notes in (("left out", report.left_out), ("otherwise", report.mended)):
        rows += [f"{title} ({len(notes)})", *(f"  {note}" for note in notes)]
    return "\n".join([*rows, f"written: {report.path} ({report.form})"])
