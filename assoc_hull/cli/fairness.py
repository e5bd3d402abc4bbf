"""The command that tells how fair lines are."""

from __future__ import annotations

import argparse
from pathlib import Path

from assoc_hull.cli.arguments import Commands, add_command, add_hull, add_json
from assoc_hull.cli.output import emit, progress
from assoc_hull.sources import open as open_hull

__all__ = ["add"]


def add(commands: Commands) -> None:
    """Add ``fairness``."""
    parser = add_command(
        commands, "fairness", "tell how fair lines are, by five criteria in numbers", _fairness,
        """assoc-hull fairness ship.hull
        assoc-hull fairness ship.hull "WL 5" "WL 7.5" --allowed 1
        assoc-hull fairness ship.hull --compare faired.hull
        assoc-hull fairness ship.hull --json""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument(
        "lines", metavar="LINE", nargs="*", help="names of lines (default: all of them)"
    )
    parser.add_argument(
        "--allowed", type=int, default=0, metavar="N",
        help="inflections that are wanted on each curve (default: 0)",
    )  # fmt: skip
    parser.add_argument(
        "--compare", type=Path, metavar="OTHER",
        help="another .hull or .hull.json file: the same lines after an edit, side by side",
    )  # fmt: skip
    add_json(parser)


def _fairness(arguments: argparse.Namespace) -> int:
    from assoc_hull.analysis.fairness.fairness import hull_fairness

    lines = arguments.lines or None
    hull = open_hull(arguments.hull)
    after = None if arguments.compare is None else open_hull(arguments.compare)
    with progress("looking at lines"):
        found = hull_fairness(hull, lines, arguments.allowed)
        other = None if after is None else hull_fairness(after, lines, arguments.allowed)
    if other is None:
        emit(arguments, found.data(), str(found))
        return 0
    emit(arguments, found.compared(other), found.comparison(other))
    return 0
