"""The command that writes the objects of a hull and their links as a graph."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from assoc_hull.cli.arguments import Commands, add_command, add_hull
from assoc_hull.cli.output import progress
from assoc_hull.cli.problems import UsageError, check_other_target
from assoc_hull.sources import open as open_hull

__all__ = ["add"]

_FORMATS = ("dot", "graphml", "mermaid", "json")
_ONLY = ("two-way", "one-way", "latent", "changed")


def add(commands: Commands) -> None:
    """Add ``graph``."""
    parser = add_command(
        commands, "graph", "write objects and links as a graph", _graph,
        """assoc-hull graph ship.hull --format dot --around "WL 0.5 x ST 7" --hops 2
        assoc-hull graph ship.hull --only one-way --around "WL 0.5" --hops 2 --format mermaid
        assoc-hull graph ship.hull --format graphml -o ship.graphml""",
    )  # fmt: skip
    add_hull(parser)
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--format", choices=_FORMATS, help="default: dot")
    form.add_argument(
        "--json", dest="format", action="store_const", const="json", help="as --format json"
    )
    _add_filters(parser)
    parser.add_argument("-o", "--out", type=Path, metavar="FILE", help="a file to write to")


def _add_filters(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--around", metavar="ID", help="only what lies near this object: its address or key"
    )
    parser.add_argument("--hops", type=_count, metavar="K", help="how near, in links (default: 1)")
    parser.add_argument(
        "--up", type=_count, metavar="K", help="how near against the links (default: as --hops)"
    )
    parser.add_argument(
        "--down", type=_count, metavar="K", help="how near along the links (default: as --hops)"
    )
    parser.add_argument(
        "--only", choices=_ONLY,
        help="links by which both sides generate points, only one does, or none yet does; or "
        "what an edit changed",
    )  # fmt: skip
    parser.add_argument(
        "--edit", type=int, metavar="N",
        help="only what this edit changed: 1 is the first, -1 the last (default with --only "
        "changed: the last)",
    )  # fmt: skip


def _count(text: str) -> int:
    """Take a whole number, 0 or more."""
    number = int(text) if text.isdecimal() else -1
    if number < 0:
        raise argparse.ArgumentTypeError(f"{text!r} is no number of links, 0 or more")
    return number


def _graph(arguments: argparse.Namespace) -> int:
    from assoc_hull.graph.graph_text import export
    from assoc_hull.io.write_file import write_whole

    up, down = _hops(arguments)
    if arguments.out is not None:
        check_other_target(arguments.out, arguments.hull)
    hull = open_hull(arguments.hull)
    with progress("writing the graph"):
        found = hull.graph(
            around=arguments.around, up=up, down=down, only=arguments.only, edit=arguments.edit
        )
        text = export(found, arguments.format or _FORMATS[0])
    if not len(found):
        print("nothing passes these filters: the graph is empty", file=sys.stderr)
    if arguments.out is None:
        _print(text)
    else:
        write_whole(arguments.out, text.encode())
    return 0


def _print(text: str) -> None:
    """Print UTF-8, as the forms demand, whatever the terminal prefers."""
    bare = getattr(sys.stdout, "buffer", None)
    if bare is None:
        print(text, end="")
        return
    sys.stdout.flush()
    bare.write(text.encode())
    bare.flush()


def _hops(arguments: argparse.Namespace) -> tuple[int, int]:
    """Give most hops against and along the links."""
    given = [name for name in ("hops", "up", "down") if getattr(arguments, name) is not None]
    if given and arguments.around is None:
        raise UsageError(f"--{given[0]} without an object, in assoc-hull graph; add --around ID")
    both = 1 if arguments.hops is None else arguments.hops
    return (
        both if arguments.up is None else arguments.up,
        both if arguments.down is None else arguments.down,
    )
