"""The arguments of all commands."""

from __future__ import annotations

import argparse
import sys
from typing import NoReturn

from assoc_hull.cli.arguments import Commands
from assoc_hull.cli.classical import add as add_classical
from assoc_hull.cli.compare import add as add_compare
from assoc_hull.cli.create import add as add_create
from assoc_hull.cli.curve import add as add_curve
from assoc_hull.cli.demo import add as add_demo
from assoc_hull.cli.edit import add as add_edit
from assoc_hull.cli.export import add as add_export
from assoc_hull.cli.fairness import add as add_fairness
from assoc_hull.cli.graph import add as add_graph
from assoc_hull.cli.history import add as add_history
from assoc_hull.cli.hydrostatics import add as add_hydrostatics
from assoc_hull.cli.look import add as add_inspection
from assoc_hull.cli.make import add as add_example_and_import
from assoc_hull.cli.panels import add as add_panels
from assoc_hull.cli.parameters import add as add_parameters
from assoc_hull.cli.plates import add as add_plates
from assoc_hull.cli.plot import add as add_plot
from assoc_hull.cli.problems import UsageError
from assoc_hull.cli.replay import add as add_replay
from assoc_hull.cli.sensitivities import add as add_sensitivities
from assoc_hull.cli.shell import add as add_completion_and_schema
from assoc_hull.cli.shift import add as add_shift_and_swing
from assoc_hull.cli.stability import add as add_stability
from assoc_hull.cli.study import add as add_study
from assoc_hull.cli.surface import add as add_surface
from assoc_hull.cli.transform import add as add_transform
from assoc_hull.cli.vary import add as add_vary
from assoc_hull.cli.why import add as add_why

__all__ = ["make_parser"]

_ABOUT = "Associative ship hull forms: lines that follow one another when one is changed."
_EXAMPLES = """
examples:
  assoc-hull demo --out demo
  assoc-hull example series60-070 -o ship.hull
  assoc-hull edit ship.hull edits.json --why "BTK 0.44"
  assoc-hull undo ship.hull
  assoc-hull check ship.hull --json
  assoc-hull plot ship.hull -o lines.pdf

exit codes: 0 done; 1 findings (check, verify, an edit refused or not made); 2 bad input or usage
"""


_COMMANDS = (
    add_demo,
    add_example_and_import,
    add_create,
    add_classical,
    add_curve,
    add_inspection,
    add_edit,
    add_history,
    add_replay,
    add_why,
    add_graph,
    add_hydrostatics,
    add_parameters,
    add_stability,
    add_transform,
    add_panels,
    add_vary,
    add_shift_and_swing,
    add_study,
    add_compare,
    add_sensitivities,
    add_fairness,
    add_surface,
    add_plates,
    add_plot,
    add_export,
    add_completion_and_schema,
)
"""What adds the commands, in the order of the help."""


class _Parser(argparse.ArgumentParser):
    """Raises where argparse would print several lines and leave."""

    def error(self, message: str) -> NoReturn:
        raise UsageError(f"{message}, in {self.prog}; see: {self.prog} --help")


def make_parser() -> argparse.ArgumentParser:
    """Make the parser of the command line; each command sets ``run``.

    Examples
    --------
    >>> from assoc_hull.cli.parser import make_parser
    >>> make_parser().parse_args(["info", "ship.hull.json"]).hull.name
    'ship.hull.json'
    """
    parser = _Parser(
        prog="assoc-hull",
        description=_ABOUT,
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"assoc-hull {_version()}")
    commands: Commands = parser.add_subparsers(
        metavar="COMMAND", required=True, parser_class=_Parser
    )
    for add in _COMMANDS:
        add(commands)
    return parser


def _version() -> str:
    """Give the version of the package this module belongs to."""
    package = sys.modules[__name__.partition(".")[0]]
    return str(vars(package)["__version__"])
