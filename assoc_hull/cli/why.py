"""The command that tells why an object is as it is."""

from __future__ import annotations

import argparse
from collections.abc import Mapping

from assoc_hull.cli.arguments import Commands, add_command, add_hull, add_json
from assoc_hull.cli.output import can_print, emit, progress, why_document
from assoc_hull.edit.explain.cause import Why
from assoc_hull.sources import open as open_hull

__all__ = ["add", "why_words"]


def add(commands: Commands) -> None:
    """Add ``why``."""
    parser = add_command(
        commands, "why", "tell through what the last edit reached an object", _why,
        """assoc-hull why ship.hull "BTK 0.44"
        assoc-hull why ship.hull "WL 0.5 x ST 16" --tree
        assoc-hull why ship.hull "WL 0.5" --json""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument(
        "object", metavar="OBJECT",
        help="a point, a curve, a line (of which the first curve is meant) or a definition: its "
        "address, name or key",
    )  # fmt: skip
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--tree", action="store_true", help="draw the tree of causes")
    add_json(form)


def _why(arguments: argparse.Namespace) -> int:
    hull = open_hull(arguments.hull)
    with progress("looking through the history"):
        cause = hull.why(arguments.object)
    text = cause.tree(plain=not can_print("│├└─")) if arguments.tree else str(cause)
    emit(arguments, why_document(cause), text)
    return 0


def why_words(causes: Mapping[str, Why]) -> list[str]:
    """Tell the causes of several objects, each under the name by which it was asked for."""
    return [f"why {name}\n{cause}" for name, cause in causes.items()]
