"""The command that fairs a hull, or tells what fairing would do.

Exit code 1 if the hull that would come of it is refused. Noise and tolerance are typed in mm, as
offsets are read.
"""

from __future__ import annotations

import argparse
import math
import sys
from pathlib import Path
from typing import Any

from assoc_hull.cli.arguments import (
    Commands,
    add_command,
    add_hull,
    add_json,
    add_replace,
    add_wait,
)
from assoc_hull.cli.edits import open_to_change
from assoc_hull.cli.output import emit, progress
from assoc_hull.errors import RefusedEditError
from assoc_hull.hull.sources import open as open_hull

__all__ = ["add_fair"]


def add_fair(commands: Commands) -> None:
    """Add ``fair``."""
    parser = add_command(
        commands, "fair", _fair,
        """assoc-hull fair ship.hull --noise 1.6 --dry-run
        assoc-hull fair ship.hull --noise auto --tolerance 3 -o faired.hull
        assoc-hull fair ship.hull "WL 9" buttocks --noise 1.6
        assoc-hull fair ship.hull --noise 2 --at "WL 9 x ST 17" --radius 20 6 --hold volume lcb""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument(
        "lines", metavar="LINE", nargs="*",
        help="lines, or groups of lines, whose points may move (default: all)",
    )  # fmt: skip
    parser.add_argument(
        "--noise", metavar="MM", type=_noise,
        help="standard deviation of the noise of the offsets in mm, or auto (default: that of "
        "rounding, if all half-breadths are rounded to one unit)",
    )  # fmt: skip
    parser.add_argument(
        "--tolerance", metavar="MM", type=_millimetres,
        help="how far points may move, in mm (default: three times the noise)",
    )  # fmt: skip
    parser.add_argument(
        "--at", metavar="POINT", help="the middle of a window, outside of which nothing moves"
    )
    parser.add_argument(
        "--radius", metavar=("X", "GIRTH"), nargs=2, type=float,
        help="how far the window reaches along the length and the girth, m",
    )  # fmt: skip
    parser.add_argument(
        "--keep", metavar="OBJECT", nargs="+", default=[], help="points and lines that stay"
    )
    parser.add_argument(
        "--hold", nargs="+", choices=("volume", "lcb"), default=[],
        help="what stays as it is, at the design draught",
    )  # fmt: skip
    parser.add_argument(
        "--since", metavar="CHECKPOINT", help="count movements from the points as they were there"
    )
    parser.add_argument("--name", default="fair", help="name of the edit (default: fair)")
    parser.add_argument(
        "-o", "--out", metavar="OUT", type=Path, help="where to write the hull (default: HULL)"
    )
    parser.add_argument(
        "--dry-run", action="store_true", help="tell what would come of it; write nothing"
    )
    add_wait(parser)
    add_replace(parser)
    add_json(parser)


def _millimetres(text: str) -> float:
    """Take a number of mm, with or without the unit, and give it in m."""
    try:
        # Through its decimal digits, so that 1.6 is the number 0.0016.
        found = float(f"{float(text.lower().removesuffix('mm').strip())!r}e-3")
    except ValueError:
        found = math.nan
    if not (math.isfinite(found) and found > 0.0):
        raise argparse.ArgumentTypeError(f"{text!r} is no length above 0 in mm, such as 1.6")
    return found


def _noise(text: str) -> float | str:
    return text if text == "auto" else _millimetres(text)


def _fair(arguments: argparse.Namespace) -> int:
    changed = None if arguments.dry_run else open_to_change(arguments)
    hull = open_hull(arguments.hull) if changed is None else changed.hull
    try:
        with progress("fairing"):
            report = hull.fair(
                arguments.lines or None, noise=arguments.noise, tolerance=arguments.tolerance,
                at=arguments.at, radius=arguments.radius, keep=arguments.keep,
                hold=arguments.hold, since=arguments.since, name=arguments.name,
                dry_run=arguments.dry_run,
            )  # fmt: skip
    except RefusedEditError as error:
        facts: dict[str, Any] = {"refused": True, "findings": error.findings, "saved": None}
        emit(arguments, facts, "\n".join(error.findings))
        print(f"refused: edit {error.edit!r}; the hull is unchanged", file=sys.stderr)
        return 1
    target = None if changed is None else changed.target
    facts = {"refused": False, **report.data(), "saved": target}
    told = [str(report), "nothing written" if target is None else f"written: {target}"]
    if changed is not None:
        changed.save()  # last: what cannot be told leaves no file
    emit(arguments, facts, "\n".join(told))
    return 0
