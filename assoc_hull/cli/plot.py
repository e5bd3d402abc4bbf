"""The command that draws a hull."""

from __future__ import annotations

import argparse
from pathlib import Path

from assoc_hull.cli.arguments import PICTURE_ENDINGS, Commands, add_command, add_hull, add_json
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.problems import UsageError, check_target
from assoc_hull.sources import open as open_hull

__all__ = ["add"]


def add(commands: Commands) -> None:
    """Add ``plot``."""
    parser = add_command(
        commands, "plot", "draw the lines plan, or lines with their curvature combs", _plot,
        """assoc-hull plot ship.hull -o lines.pdf --paper A1
        assoc-hull plot ship.hull -o combs.svg --combs "WL 0.5" "BTK 0.44"
        assoc-hull plot ship.hull -o definitions.pdf --view definitions""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument(
        "-o", "--out", type=Path, required=True, metavar="FILE", help="a .pdf, .svg or .png file"
    )
    parser.add_argument("--paper", choices=("A3", "A1"), default="A3", help="default: A3")
    parser.add_argument(
        "--combs", nargs="+", metavar="LINE", help="draw these lines with their curvature"
    )
    parser.add_argument(
        "--view", choices=("lines", "definitions"), default="lines",
        help="the lines, or the definitions of a created hull with their curvature",
    )  # fmt: skip
    add_json(parser)


def _plot(arguments: argparse.Namespace) -> int:
    from assoc_hull.plot import lines_plan

    check_target(arguments.out, PICTURE_ENDINGS)
    if arguments.combs and arguments.view != "lines":
        raise UsageError("--combs needs --view lines, in plot; leave one out")
    hull = open_hull(arguments.hull)
    with progress(f"drawing {arguments.out}"):
        if arguments.view == "definitions":
            from assoc_hull.plot import definition_curves

            definition_curves(hull.state, arguments.out, paper=arguments.paper)
        elif arguments.combs:
            from assoc_hull.plot import curvature_combs

            curvature_combs(hull, arguments.combs, arguments.out, paper=arguments.paper)
        else:
            lines_plan(hull, arguments.out, paper=arguments.paper)
    emit(arguments, {"saved": str(arguments.out)}, f"written: {arguments.out}")
    return 0
