"""Arguments that several commands share."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    Commands = argparse._SubParsersAction[argparse.ArgumentParser]
else:
    Commands = argparse._SubParsersAction

__all__ = ["HULL_ENDINGS", "PICTURE_ENDINGS", "Commands", "add_command", "add_hull", "add_json"]

HULL_ENDINGS = (".hull.json",)
PICTURE_ENDINGS = (".pdf", ".svg", ".png")


def add_command(
    commands: Commands,
    name: str,
    about: str,
    run: Callable[[argparse.Namespace], int],
    examples: str,
) -> argparse.ArgumentParser:
    """Add a command: one sentence about it, examples that can be copied, and what runs it."""
    lines = "".join(f"\n  {line.strip()}" for line in examples.strip().splitlines())
    parser = commands.add_parser(
        name,
        help=about,
        description=about[0].upper() + about[1:] + ".",
        epilog=f"examples:{lines}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.set_defaults(run=run)
    return parser


def add_hull(parser: argparse.ArgumentParser) -> None:
    """Add the hull to be read."""
    parser.add_argument("hull", metavar="HULL", type=Path, help="a .hull.json file")


def add_json(parser: argparse._ActionsContainer) -> None:
    """Add the wish for one JSON document on standard output."""
    parser.add_argument("--json", action="store_true", help="print one JSON document")
