"""The command that creates a hull from a design, by form parameters."""

from __future__ import annotations

import argparse
from pathlib import Path

from assoc_hull.cli.arguments import Commands, add_command, add_json, add_replace
from assoc_hull.cli.output import emit, progress, say
from assoc_hull.cli.problems import UsageError, check_hull_target
from assoc_hull.cli.words import hull_words

__all__ = ["add"]


def add(commands: Commands) -> None:
    """Add ``create``."""
    parser = add_command(
        commands, "create", "make a hull from a design: definitions by form parameters", _create,
        """assoc-hull create --example > design.json
        assoc-hull create design.json -o ship.hull
        assoc-hull create design.json -o ship.hull --json""",
    )  # fmt: skip
    parser.add_argument(
        "design", metavar="DESIGN.json", type=Path, nargs="?", help="particulars and definitions"
    )
    parser.add_argument(
        "-o", "--out", metavar="HULL", type=Path,
        help="the hull to write: .hull keeps the history, .hull.json is text",
    )  # fmt: skip
    parser.add_argument(
        "--example", action="store_true", help="print a design to start from, and make nothing"
    )
    add_replace(parser)
    add_json(parser)


def _create(arguments: argparse.Namespace) -> int:
    from assoc_hull.creation.design import Design
    from assoc_hull.sources import create

    if arguments.example:
        return _example(arguments)
    if arguments.design is None or arguments.out is None:
        missing = "DESIGN.json" if arguments.design is None else "-o HULL"
        raise UsageError(f"{missing} is missing, in create; see: assoc-hull create --help")
    check_hull_target(arguments.out, replace=arguments.replace)
    design = Design.from_json(arguments.design)
    with progress(f"creating {design.particulars.name}"):
        hull = create(design)
        report = hull.creation
    hull.save(arguments.out, replace=arguments.replace)
    facts = {
        "format": "assoc-hull report", "schema": 1, "hull": arguments.out,
        "fingerprint": hull.fingerprint, "report": report.data(),
    }  # fmt: skip
    text = f"{report}\n{hull_words(hull)}\nwritten: {arguments.out}"
    emit(arguments, facts, text)
    return 0


def _example(arguments: argparse.Namespace) -> int:
    """Print the design of an example."""
    from assoc_hull.shipped.plain_ship import plain_ship_design

    if arguments.design is not None or arguments.out is not None or arguments.json:
        raise UsageError("--example stands alone, in create; leave the rest out")
    say(plain_ship_design().to_json().rstrip("\n"))
    return 0
