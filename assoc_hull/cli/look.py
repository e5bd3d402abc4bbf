"""Commands that look at a hull: its facts, its findings, and whether it is what it says."""

from __future__ import annotations

import argparse

from assoc_hull.cli.arguments import Commands, add_command, add_hull, add_json
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.words import hull_facts, hull_words
from assoc_hull.sources import open as open_hull

__all__ = ["add"]

_NOTE = "role"


def add(commands: Commands) -> None:
    """Add ``info``, ``check`` and ``verify``."""
    info = add_command(
        commands, "info", "tell what a hull holds", _info,
        """assoc-hull info ship.hull
        assoc-hull info ship.hull --json""",
    )  # fmt: skip
    check = add_command(
        commands, "check", "tell what is wrong with a hull; exit 1 if anything is", _check,
        """assoc-hull check ship.hull
        assoc-hull check ship.hull --notes --json""",
    )  # fmt: skip
    check.add_argument("--notes", action="store_true", help="tell also what is only worth knowing")
    verify = add_command(
        commands, "verify", "rebuild a hull from its definition and compare; exit 1 if it differs",
        _verify, "assoc-hull verify ship.hull\nassoc-hull verify ship.hull --json",
    )  # fmt: skip
    verify.add_argument(
        "--relative", type=float, default=0.0, metavar="PART",
        help="allow differences of this part of the largest number (0 compares bits; "
        "1e-12 for a hull that was written on another machine)",
    )  # fmt: skip
    for parser in (info, check, verify):
        add_hull(parser)
        add_json(parser)


def _info(arguments: argparse.Namespace) -> int:
    hull = open_hull(arguments.hull)
    emit(arguments, hull_facts(hull), hull_words(hull, names=True))
    return 0


def _check(arguments: argparse.Namespace) -> int:
    hull = open_hull(arguments.hull, damaged=True)
    with progress("checking"):
        found = hull.check(notes=arguments.notes)
    wrong = sum(each.kind != _NOTE for each in found)
    count = f"{wrong} finding{'s' if wrong > 1 else ''}" if wrong else "no findings"
    lines = [*map(str, found), count]
    emit(arguments, {"findings": found}, "\n".join(lines))
    return 1 if wrong else 0


def _verify(arguments: argparse.Namespace) -> int:
    hull = open_hull(arguments.hull)
    with progress("rebuilding"):
        found = hull.verify(arguments.relative)
    lines = [f"{each.key}: {each.field} differs by {each.amount:.3g}" for each in found]
    plural = "s" if len(found) > 1 else ""
    lines.append(f"{len(found)} difference{plural}" if found else "no differences")
    facts = {"fingerprint": hull.fingerprint, "differences": found}
    emit(arguments, facts, "\n".join(lines))
    return 1 if found else 0
