"""Arguments that several commands share."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    Commands = argparse._SubParsersAction[argparse.ArgumentParser]
else:
    Commands = argparse._SubParsersAction

__all__ = [
    "FILE_ENDING",
    "HULL_ENDINGS",
    "PICTURE_ENDINGS",
    "TEXT_ENDING",
    "Commands",
    "add_command",
    "add_hull",
    "add_json",
    "add_replace",
    "add_wait",
]

FILE_ENDING, TEXT_ENDING = ".hull", ".hull.json"
HULL_ENDINGS = (FILE_ENDING, TEXT_ENDING)
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
    parser.add_argument("hull", metavar="HULL", type=Path, help="a .hull or .hull.json file")


def add_wait(parser: argparse.ArgumentParser) -> None:
    """Add how long to wait for another writer."""
    parser.add_argument(
        "--wait", type=_seconds, default=0.0, metavar="S",
        help="wait so long (s) while another process writes to HULL (default: 0)",
    )  # fmt: skip


def _seconds(text: str) -> float:
    """Take a time in seconds."""
    try:
        found = float(text)
    except ValueError:
        found = math.nan
    if not 0.0 <= found < 1e6:
        raise argparse.ArgumentTypeError(f"{text!r} is no time in seconds")
    return found


def add_replace(parser: argparse.ArgumentParser) -> None:
    """Add the leave to write over a hull file."""
    parser.add_argument(
        "--replace", action="store_true",
        help="write over a .hull file that is there, with its history",
    )  # fmt: skip


def add_json(parser: argparse._ActionsContainer) -> None:
    """Add the wish for one JSON document on standard output."""
    parser.add_argument("--json", action="store_true", help="print one JSON document")
