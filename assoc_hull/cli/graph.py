"""The command that writes the objects of a hull and their links as a graph."""

from __future__ import annotations

import argparse
from pathlib import Path

from assoc_hull.cli.arguments import Commands, add_command, add_hull
from assoc_hull.cli.output import progress
from assoc_hull.cli.problems import check_target
from assoc_hull.sources import open as open_hull

__all__ = ["add"]

_FORMATS = ("dot", "graphml", "mermaid", "json")


def add(commands: Commands) -> None:
    """Add ``graph``."""
    parser = add_command(
        commands, "graph", "write objects and links as a graph", _graph,
        """assoc-hull graph ship.hull.json --format dot --around "WL 0.5 x ST 7" --hops 2
        assoc-hull graph ship.hull.json --format graphml -o ship.graphml""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument("--format", choices=_FORMATS, default="dot", help="default: dot")
    parser.add_argument("--around", metavar="ID", help="only what lies near this object")
    parser.add_argument(
        "--hops", type=_count, default=1, metavar="K", help="how near, in links (default: 1)"
    )
    parser.add_argument("-o", "--out", type=Path, metavar="FILE", help="a file to write to")


def _count(text: str) -> int:
    """Take a whole number, 0 or more."""
    number = int(text) if text.isdecimal() else -1
    if number < 0:
        raise argparse.ArgumentTypeError(f"{text!r} is no number of links, 0 or more")
    return number


def _graph(arguments: argparse.Namespace) -> int:
    from assoc_hull.graph.view import export

    if arguments.out is not None:
        check_target(arguments.out, ("",))
    hull, hops = open_hull(arguments.hull), arguments.hops
    with progress("writing the graph"):
        found = hull.graph(around=arguments.around, up=hops, down=hops)
        text = export(found, arguments.format)
    if arguments.out is None:
        print(text, end="")
    else:
        arguments.out.write_text(text, "utf-8")
    return 0
