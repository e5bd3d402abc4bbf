"""The command that makes the edits of one hull again on another."""

from __future__ import annotations

import argparse
from pathlib import Path

from assoc_hull.cli.arguments import (
    Commands,
    add_command,
    add_json,
    add_replace,
    add_wait,
)
from assoc_hull.cli.changed import open_to_change
from assoc_hull.cli.history import open_with_history
from assoc_hull.cli.output import emit, progress

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
    changed = open_to_change(arguments)
    source = open_with_history(arguments.source)
    hull = changed.hull
    with progress("replaying"):
        found = hull.replay(source, skip=arguments.skip)
    changed.save()
    failed = [each for each in found if each.report is None]
    left = len(source.history) - len(found)
    facts = {
        "edits": [{"name": e.name, "made": e.report is not None, "why": e.why} for e in found],
        "left": left, "fingerprint": hull.fingerprint, "saved": changed.target,
    }  # fmt: skip
    told = [*map(str, found), *([f"{left} more were not tried"] if left else [])]
    emit(arguments, facts, "\n".join([*told, f"written: {changed.target}"]))
    return 1 if failed else 0
