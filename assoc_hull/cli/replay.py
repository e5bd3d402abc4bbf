"""The command that makes the edits of one hull again on another."""

from __future__ import annotations

import argparse
from pathlib import Path

from assoc_hull.cli.arguments import (
    HULL_ENDINGS,
    Commands,
    add_command,
    add_json,
    add_replace,
    add_wait,
)
from assoc_hull.cli.history import open_with_history
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.problems import check_hull_target, check_target, is_apart
from assoc_hull.sources import open as open_hull

__all__ = ["add"]


def add(commands: Commands) -> None:
    """Add ``replay``."""
    parser = add_command(
        commands, "replay", "make the edits of one hull again on another; exit 1 if one fails",
        _replay,
        """assoc-hull replay ship.hull sister.hull
        assoc-hull replay ship.hull sister.hull.json -o faired.hull --skip""",
    )  # fmt: skip
    parser.add_argument("source", metavar="FROM", type=Path, help="the hull file with the edits")
    parser.add_argument("hull", metavar="HULL", type=Path, help="the hull to edit")
    parser.add_argument(
        "-o", "--out", metavar="OUT", type=Path, help="where to write the hull (default: HULL)"
    )
    parser.add_argument(
        "--skip", action="store_true", help="go on behind an edit that cannot be made"
    )
    add_wait(parser)
    add_replace(parser)
    add_json(parser)


def _replay(arguments: argparse.Namespace) -> int:
    target: Path = arguments.out or arguments.hull
    apart = is_apart(arguments.out, arguments.hull)
    check_target(target, HULL_ENDINGS)
    if apart:
        check_hull_target(target, replace=arguments.replace)
    source = open_with_history(arguments.source)
    hull = open_hull(arguments.hull, wait=arguments.wait)
    if apart:
        hull.detach()
    with progress("replaying"):
        found = hull.replay(source, skip=arguments.skip)
    if apart or hull.path is None:
        hull.save(target, replace=arguments.replace)
    failed = [each for each in found if each.report is None]
    left = len(source.history) - len(found)
    facts = {
        "edits": [{"name": e.name, "made": e.report is not None, "why": e.why} for e in found],
        "left": left, "fingerprint": hull.fingerprint, "saved": target,
    }  # fmt: skip
    told = [*map(str, found), *([f"{left} more were not tried"] if left else [])]
    emit(arguments, facts, "\n".join([*told, f"written: {target}"]))
    return 1 if failed else 0
