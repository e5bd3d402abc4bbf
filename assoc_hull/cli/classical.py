"""The command that reads a classical definition and tells its own numbers."""

from __future__ import annotations

import argparse
from pathlib import Path

from assoc_hull.cli.arguments import Commands, add_command, add_json, add_replace
from assoc_hull.cli.output import emit, progress, say
from assoc_hull.cli.problems import UsageError, check_hull_target
from assoc_hull.cli.words import hull_words

__all__ = ["add"]


def add(commands: Commands) -> None:
    """Add ``classical``."""
    parser = add_command(
        commands, "classical", "tell volumes, areas and centroids of a classical definition",
        _classical,
        """assoc-hull classical --example sfolds > ferry.txt
        assoc-hull classical ferry.txt
        assoc-hull classical ferry.txt -o ferry.hull --json""",
    )  # fmt: skip
    parser.add_argument(
        "file", metavar="FILE", type=Path, nargs="?",
        help="a text of cards that begins with SEAKING, SFOLDS or PRELIKON",
    )  # fmt: skip
    parser.add_argument(
        "-o", "--out", metavar="HULL", type=Path,
        help="make the net as well, tell its numbers beside, and write it",
    )  # fmt: skip
    parser.add_argument(
        "--example", metavar="KIND", help="print a text to start from: seaking, sfolds, prelikon"
    )
    add_replace(parser)
    add_json(parser)


def _classical(arguments: argparse.Namespace) -> int:
    from assoc_hull.sources import create, read_classical

    if arguments.example is not None:
        return _example(arguments)
    if arguments.file is None:
        raise UsageError("FILE is missing, in classical; see: assoc-hull classical --help")
    if arguments.out is not None:
        check_hull_target(arguments.out, replace=arguments.replace)
    definition = read_classical(arguments.file)
    facts = {"format": "assoc-hull report", "schema": 1, "source": arguments.file}
    if arguments.out is None:
        report = definition.report()
        emit(arguments, facts | {"definition": report.as_dict()}, str(report).rstrip("\n"))
        return 0
    with progress(f"making {definition.particulars.name}"):
        hull = create(definition)
        report = definition.report(hull.state)
    hull.save(arguments.out, replace=arguments.replace)
    facts |= {
        "definition": report.as_dict(), "hull": arguments.out, "fingerprint": hull.fingerprint,
    }  # fmt: skip
    emit(arguments, facts, f"{report}\n{hull_words(hull)}\nwritten: {arguments.out}")
    return 0


def _example(arguments: argparse.Namespace) -> int:
    """Print the text of an example."""
    from assoc_hull.shipped.classical_ships import SHIPS, classical_text

    if arguments.file is not None or arguments.out is not None or arguments.json:
        raise UsageError("--example stands alone, in classical; leave the rest out")
    kinds = {name.partition("_")[0]: name for name in SHIPS}
    if arguments.example not in kinds:
        known = ", ".join(kinds)
        raise UsageError(f"there is no example {arguments.example!r}, in classical; give {known}")
    say(classical_text(kinds[arguments.example]).rstrip("\n"))
    return 0
