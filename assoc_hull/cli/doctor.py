"""The command that looks for slips of the hand in a table of offsets, and mends them beside."""

from __future__ import annotations

import argparse
from pathlib import Path

from assoc_hull.cli.arguments import Commands, add_command, add_json
from assoc_hull.cli.output import emit, plain
from assoc_hull.cli.problems import check_target

__all__ = ["add_doctor"]

_ENDINGS = (".csv", ".tsv", ".txt")


def add_doctor(commands: Commands) -> None:
    """Add ``doctor``."""
    parser = add_command(
        commands, "doctor", "look for slips of the hand in a table of offsets; exit 1 if any",
        _doctor,
        """assoc-hull doctor offsets.csv
        assoc-hull doctor offsets.csv --top 20 --json
        assoc-hull doctor offsets.csv --mend mended.csv""",
    )  # fmt: skip
    parser.add_argument(
        "table", metavar="TABLE", type=Path, help="a table of offsets: CSV, TSV or XLSX"
    )
    parser.add_argument(
        "--top", type=int, default=10, metavar="N",
        help="list so many findings at least, slips first (default: 10)",
    )  # fmt: skip
    parser.add_argument(
        "--mend", type=Path, metavar="OUT",
        help="write the table with all slips put right, and a comment for each; never over TABLE",
    )  # fmt: skip
    parser.add_argument(
        "--replace", action="store_true", help="write over a file that is at OUT already"
    )
    parser.add_argument(
        "--centre", metavar="Y",
        help="centre plane from which half-breadths of one of two hulls are counted",
    )  # fmt: skip
    add_json(parser)


def _doctor(arguments: argparse.Namespace) -> int:
    from assoc_hull.fairing.offsets_doctor import ALARM
    from assoc_hull.io.offsets.doctor import doctor

    if arguments.mend is not None:
        check_target(arguments.mend, _ENDINGS)
    found = doctor(
        arguments.table, top=arguments.top, centre=arguments.centre, mend=arguments.mend,
        replace=arguments.replace,
    )  # fmt: skip
    facts = {
        "format": "assoc-hull report", "schema": 1, "alarm": ALARM, "slips": len(found.alarms),
        **plain(found),
    }  # fmt: skip
    text = str(found)
    if arguments.mend is not None and not found.written:
        text += f"\nno slip is called: {arguments.mend} was not written"
    emit(arguments, facts, text)
    return 1 if found.alarms else 0
