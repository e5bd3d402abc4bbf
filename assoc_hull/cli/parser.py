"""The arguments of all commands."""

from __future__ import annotations

import argparse
import sys
from typing import NoReturn

from assoc_hull.cli import (
    classical,
    compare,
    create,
    curve,
    demo,
    edit,
    export,
    fairness,
    graph,
    history,
    hydrostatics,
    look,
    make,
    panels,
    parameters,
    plates,
    plot,
    replay,
    sensitivities,
    shell,
    shift,
    stability,
    study,
    surface,
    transform,
    vary,
    why,
)
from assoc_hull.cli.problems import UsageError

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
    commands = parser.add_subparsers(metavar="COMMAND", required=True, parser_class=_Parser)
    modules = (
        demo, make, create, classical, curve, look, edit, history, replay, why, graph, hydrostatics,
        parameters, stability, transform, panels, vary, shift, study, compare, sensitivities,
        fairness, surface, plates, plot, export, shell,
    )  # fmt: skip
    for module in modules:
        module.add(commands)
    return parser


def _version() -> str:
    """Give the version of the package this module belongs to."""
    package = sys.modules[__name__.partition(".")[0]]
    return str(vars(package)["__version__"])
