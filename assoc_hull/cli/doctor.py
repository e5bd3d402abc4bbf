"""The command that looks for slips in a table of offsets, and mends them beside; and in a net."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from assoc_hull.cli.arguments import Commands, add_command, add_json, parse_length
from assoc_hull.cli.output import emit, plain
from assoc_hull.cli.problems import check_target
from assoc_hull.errors import BadInputError

if TYPE_CHECKING:
    from assoc_hull.fairing.net_doctor import NetDoctorReport
    from assoc_hull.fairing.offsets_doctor import DoctorReport

__all__ = ["add_doctor"]

_ENDINGS = (".csv", ".tsv", ".txt")


def add_doctor(commands: Commands) -> None:
    """Add ``doctor``."""
    parser = add_command(
        commands, "doctor", _doctor,
        """assoc-hull doctor offsets.csv
        assoc-hull doctor offsets.csv --top 20 --json
        assoc-hull doctor offsets.csv --mend mended.csv
        assoc-hull doctor ship.hull --noise 2mm""",
    )  # fmt: skip
    parser.add_argument(
        "file",
        metavar="FILE",
        type=Path,
        help="a table of offsets (CSV, TSV or XLSX), or a .hull or .hull.json file",
    )
    parser.add_argument(
        "--top", type=int, default=10, metavar="N",
        help="list so many findings at least, slips first (default: 10)",
    )  # fmt: skip
    parser.add_argument(
        "--mend", type=Path, metavar="OUT",
        help="write the table with all slips put right, and a comment for each; never over FILE",
    )  # fmt: skip
    parser.add_argument(
        "--replace", action="store_true", help="write over a file that is at OUT already"
    )
    parser.add_argument(
        "--centre", metavar="Y",
        help="centre plane from which half-breadths of one of two hulls are counted",
    )  # fmt: skip
    parser.add_argument(
        "--noise", type=parse_length, metavar="LENGTH",
        help="of a hull: to what its points are known (default: 1mm, of shorter ships than 100 m "
        "in proportion)",
    )  # fmt: skip
    add_json(parser)


def _doctor(arguments: argparse.Namespace) -> int:
    from assoc_hull.fairing.offsets_doctor import ALARM
    from assoc_hull.io.hull_file.saving import holds_hull

    if arguments.mend is not None:
        check_target(arguments.mend, _ENDINGS)
    found, last = (_net if holds_hull(arguments.file) else _table)(arguments)
    facts = {
        "format": "assoc-hull report", "schema": 1, "alarm": ALARM, "called": len(found.alarms),
        **plain(found),
    }  # fmt: skip
    emit(arguments, facts, f"{found}{last}")
    return 1 if found.alarms else 0


def _table(arguments: argparse.Namespace) -> tuple[DoctorReport, str]:
    from assoc_hull.io.offsets.doctor import doctor

    if arguments.noise is not None:
        what = "--noise cannot be given"
        raise BadInputError(what, f"with {arguments.file}, a table of offsets", "leave it out")
    found = doctor(
        arguments.file, top=arguments.top, centre=arguments.centre, mend=arguments.mend,
        replace=arguments.replace,
    )  # fmt: skip
    same = arguments.mend is not None and not found.alarms
    return found, f"\nno slip is called: {arguments.mend} is the table as it is" if same else ""


def _net(arguments: argparse.Namespace) -> tuple[NetDoctorReport, str]:
    from assoc_hull.hull.sources import open as open_hull

    for name in ("mend", "centre"):
        if getattr(arguments, name) is not None:
            what = f"--{name} cannot be given"
            raise BadInputError(what, f"with {arguments.file}, a hull", "leave it out")
    return open_hull(arguments.file).doctor(top=arguments.top, noise=arguments.noise), ""
