"""The command that compares a variant with its parent."""

from __future__ import annotations

import argparse
from pathlib import Path

from assoc_hull.cli.arguments import Commands, add_command, add_json
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.problems import check_other_target, check_target
from assoc_hull.cli.screw_terms import add_screw, screw_of
from assoc_hull.sources import open as open_hull

__all__ = ["add"]


def add(commands: Commands) -> None:
    """Add ``compare``."""
    parser = add_command(
        commands, "compare", "tell how a variant differs from its parent", _compare,
        """assoc-hull compare parent.hull variant.hull
        assoc-hull compare parent.hull variant.hull --draught 16.5 --lines 50
        assoc-hull compare parent.hull variant.hull --pdf comparison.pdf --json""",
    )  # fmt: skip
    for name in ("parent", "variant"):
        parser.add_argument(
            name, metavar=name.upper(), type=Path, help="a .hull or .hull.json file"
        )
    parser.add_argument(
        "--draught", type=float, metavar="T",
        help="moulded, even keel, for the numbers of both, m (default: the design draught of each)",
    )  # fmt: skip
    add_screw(parser)
    parser.add_argument(
        "--lines", type=int, default=10, metavar="N",
        help="list so many lines, those that moved farthest (default: 10)",
    )  # fmt: skip
    parser.add_argument(
        "--pdf", type=Path, metavar="FILE", help="both lines plans and all tables, a .pdf file"
    )
    add_json(parser)


def _compare(arguments: argparse.Namespace) -> int:
    from assoc_hull.arguments import integer
    from assoc_hull.variation.comparing.compare import compare
    from assoc_hull.variation.comparing.json import comparison_document
    from assoc_hull.variation.comparing.text import comparison_text

    integer(arguments.lines, "lines", "in --lines", least=0)
    screw = screw_of(arguments)
    _check_target(arguments)
    parent, variant = open_hull(arguments.parent), open_hull(arguments.variant)
    with progress("comparing"):
        found = compare(parent, variant, draught=arguments.draught, screw=screw)
    saved: list[str] = []
    if arguments.pdf is not None:
        from assoc_hull.io.write_file import write_whole
        from assoc_hull.plot.lines_plan.comparison_sheet import comparison_pdf

        with progress(f"writing {arguments.pdf}"):
            write_whole(arguments.pdf, comparison_pdf(parent, variant, found))
        saved.append(str(arguments.pdf))
    words = [comparison_text(found, arguments.lines), *(f"written: {each}" for each in saved)]
    emit(arguments, comparison_document(found) | {"saved": saved}, "\n".join(words))
    return 0


def _check_target(arguments: argparse.Namespace) -> None:
    """Refuse, before anything is computed, what could not be written."""
    if arguments.pdf is not None:
        check_target(arguments.pdf, (".pdf",))
        for hull in (arguments.parent, arguments.variant):
            check_other_target(arguments.pdf, hull)
