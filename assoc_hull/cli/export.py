"""The command that writes a hull in the form of another program."""

from __future__ import annotations

import argparse
from pathlib import Path

from assoc_hull.cli.arguments import Commands, add_command, add_hull, add_json
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.problems import check_other_target
from assoc_hull.io.export_book import ExportReport
from assoc_hull.sources import open as open_hull

__all__ = ["add", "export_words"]

_FORMS = ("hull", "csv", "xlsx", "britfair", "delftship", "delftship-offsets", "gf")


def add(commands: Commands) -> None:
    """Add ``export``."""
    parser = add_command(
        commands, "export", "write offsets or sections for other programs", _export,
        """assoc-hull export ship.hull -o offsets.csv
        assoc-hull export ship.hull -o offsets.xlsx
        assoc-hull export ship.hull -o ship.bri
        assoc-hull export ship.hull -o ship.gf --json
        assoc-hull export ship.hull -o ship.txt --format delftship-offsets""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument(
        "-o", "--out", type=Path, required=True, metavar="FILE",
        help="a .csv, .xlsx, .bri, .gf, .txt (delftship) or .hull.json file",
    )  # fmt: skip
    parser.add_argument(
        "--format", choices=_FORMS, help="where the ending of the name does not tell it"
    )
    add_json(parser)


def _export(arguments: argparse.Namespace) -> int:
    from assoc_hull.io.export import export, form_of

    form = form_of(arguments.out, arguments.format)
    check_other_target(arguments.out, arguments.hull)
    hull = open_hull(arguments.hull)
    with progress(f"writing {arguments.out}"):
        report = export(hull.state, arguments.out, form)
    emit(arguments, {"export": report}, export_words(report))
    return 0


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
