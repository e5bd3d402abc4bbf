"""The command that tells what of a hull changes with what."""

from __future__ import annotations

import argparse

from assoc_hull.cli.arguments import Commands, add_command, add_hull, add_json
from assoc_hull.cli.output import emit, progress
from assoc_hull.sources import open as open_hull

__all__ = ["add"]


def add(commands: Commands) -> None:
    """Add ``sensitivities``."""
    parser = add_command(
        commands, "sensitivities", "tell how outputs change with parameters of a hull", _tell,
        """assoc-hull sensitivities ship.hull
        assoc-hull sensitivities ship.hull --of volume lcb Cpa "A ST 5" --by breadth fore_shift
        assoc-hull sensitivities ship.hull --by mean_draught trim --percent
        assoc-hull sensitivities ship.hull --of kmt --point "WL 6 x ST 14" --json""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument(
        "--of", metavar="OUTPUT", nargs="+", default=None,
        help='fields of hydrostatics, symbols of form parameters, "A ST 5" or "A x=42.5"',
    )  # fmt: skip
    parser.add_argument(
        "--by", metavar="PARAMETER", nargs="+", default=None,
        help="named parameters of vary, mean_draught, trim (default: all that the hull has)",
    )  # fmt: skip
    parser.add_argument(
        "--point", metavar="ADDRESS", action="append", default=[],
        help="a point that moves where it is free, others follow; may be given more than once",
    )  # fmt: skip
    parser.add_argument("--kg", type=float, metavar="M", help="centre of gravity above base, m")
    scale = parser.add_mutually_exclusive_group()
    scale.add_argument(
        "--usual", action="store_true", help="changes with a usual change of each parameter"
    )
    scale.add_argument(
        "--percent", action="store_true", help="these in percent of the present values"
    )
    add_json(parser)


def _tell(arguments: argparse.Namespace) -> int:
    from assoc_hull.analysis.derivatives.parameters import PointMove
    from assoc_hull.variation.sensitivities import sensitivities

    points = [PointMove(each, follow=True) for each in arguments.point]
    by = None if arguments.by is None and not points else [*(arguments.by or ()), *points]
    hull = open_hull(arguments.hull)
    with progress("differentiating"):
        found = sensitivities(hull, arguments.of, by, kg=arguments.kg)
    scale = "percent" if arguments.percent else "usual" if arguments.usual else "unit"
    emit(arguments, found.document(), found.table(scale))
    return 0
