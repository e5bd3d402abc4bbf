"""What commands that make a variant share: where it goes, how it is made, what a refusal says."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from assoc_hull.cli.arguments import add_json, add_replace, add_wait
from assoc_hull.cli.changed import open_to_change
from assoc_hull.cli.output import emit, progress
from assoc_hull.errors import RefusedEditError
from assoc_hull.hull import Hull

__all__ = ["add_out", "told_if_refused", "varied_into"]

Done = TypeVar("Done")


def add_out(parser: argparse.ArgumentParser) -> None:
    """Add the name of the step, and where the variant goes."""
    parser.add_argument("--name", help="name of the step in the history")
    parser.add_argument(
        "-o", "--out", metavar="OUT", type=Path, help="where to write the hull (default: HULL)"
    )
    add_wait(parser)
    add_replace(parser)
    add_json(parser)


def varied_into(
    arguments: argparse.Namespace, doing: str, act: Callable[[Hull], Done]
) -> tuple[Hull, Done]:
    """Open the hull, vary it in place, and write it where it is to go.

    Parameters
    ----------
    arguments : Namespace
        With those of `add_out` and the hull.
    doing : str
        What is done, for who waits.
    act : callable
        Varies the hull in place.
    """
    changed = open_to_change(arguments)
    hull = changed.hull
    with progress(doing):
        found = act(hull)
    changed.save()
    return hull, found


def told_if_refused(arguments: argparse.Namespace, run: Callable[[], int]) -> int:
    """Run what may be refused; then tell the findings, and exit with 1."""
    try:
        return run()
    except RefusedEditError as error:
        facts = {"refused": True, "edit": error.edit, "findings": error.findings, "saved": None}
        emit(arguments, facts, "\n".join(error.findings))
        print(f"refused: {error.edit!r}; the hull is unchanged", file=sys.stderr)
        return 1
