"""The table of all commands, and the commands about it: completion and schemas.

`make_parser` makes the parser of the command line from the table; each command sets `run`.
`completion` prints a script for the shell from that parser; `schema` prints the JSON Schema of
any document that commands read or write.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NoReturn

from assoc_hull.cli.arguments import Commands, add_command
from assoc_hull.cli.demo import add_demo
from assoc_hull.cli.doctor import add_doctor
from assoc_hull.cli.edits import add_edit, add_history, add_replay
from assoc_hull.cli.export import add_export
from assoc_hull.cli.fairing import add_fair
from assoc_hull.cli.form_parameters import add_curve, add_parameters, add_transform
from assoc_hull.cli.hydrostatics import add_hydrostatics
from assoc_hull.cli.inspection import (
    add_fairness,
    add_graph,
    add_inspection,
    add_plot,
    add_sensitivities,
    add_why,
)
from assoc_hull.cli.make_hull import add_classical, add_create, add_example_and_import
from assoc_hull.cli.page import add_page
from assoc_hull.cli.panels import add_panels
from assoc_hull.cli.plates import add_plates
from assoc_hull.cli.problems import UsageError, check_target
from assoc_hull.cli.resistance import add_resistance
from assoc_hull.cli.stability import add_stability
from assoc_hull.cli.study import add_study
from assoc_hull.cli.surface import add_surface
from assoc_hull.cli.variants import add_compare, add_shift_and_swing, add_vary

__all__ = [
    "add_completion_and_schema",
    "make_parser",
]

# --------------------------------------------------------------------------------------
# Commands for the shell and for other programs: completion, and the form of a hull file.

_SHELLS = ("bash", "zsh", "fish")
_DOCUMENTS = (
    "hull", "form-catalogue", "form-parameters", "comparison", "design", "surfaces", "plates",
    "hull-surface", "hull-plates",
)  # fmt: skip


def add_completion_and_schema(commands: Commands) -> None:
    """Add ``completion`` and ``schema``."""
    completion = add_command(
        commands, "completion", "print a script that lets the shell complete commands", _complete,
        """assoc-hull completion bash > ~/.local/share/bash-completion/completions/assoc-hull
        assoc-hull completion zsh > ~/.zfunc/_assoc-hull
        assoc-hull completion fish > ~/.config/fish/completions/assoc-hull.fish""",
    )  # fmt: skip
    completion.add_argument("shell", metavar="SHELL", choices=_SHELLS, help=", ".join(_SHELLS))
    schema = add_command(
        commands, "schema", "print the JSON Schema of .hull.json files, or of other documents",
        _schema,
        """assoc-hull schema
        assoc-hull schema -o hull_json.schema.json
        assoc-hull schema --of form-parameters""",
    )  # fmt: skip
    schema.add_argument(
        "--of", choices=_DOCUMENTS, default="hull", metavar="DOCUMENT",
        help=f"{', '.join(_DOCUMENTS)} (default: hull)",
    )  # fmt: skip
    schema.add_argument("-o", "--out", type=Path, metavar="FILE", help="a .json file to write to")


def _complete(arguments: argparse.Namespace) -> int:
    import shtab

    parser = make_parser()
    for action in _actions(parser):
        if action.type is Path:
            folder = action.metavar == "DIR"
            action.complete = shtab.DIRECTORY if folder else shtab.FILE  # type: ignore[attr-defined]
    print(shtab.complete(parser, arguments.shell))
    return 0


def _actions(parser: argparse.ArgumentParser) -> Iterator[argparse.Action]:
    """Give every argument of a parser and of its commands."""
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            choices: dict[str, Any] = action.choices
            for each in choices.values():
                yield from _actions(each)
        else:
            yield action


def _schema(arguments: argparse.Namespace) -> int:
    from assoc_hull.io.tables.json_schema import dumps_schema
    from assoc_hull.io.write_file import write_whole

    text = dumps_schema(_schema_of(arguments.of))
    if arguments.out is None:
        print(text, end="")
        return 0
    check_target(arguments.out, (".json",))
    write_whole(arguments.out, text.encode())
    return 0


def _schema_of(document: str) -> dict[str, Any]:
    """Give the schema of a document."""
    if document == "hull":
        from assoc_hull.io.hull_json import hull_json_schema

        return hull_json_schema()
    if document == "comparison":
        from assoc_hull.io.tables.comparison import comparison_schema

        return comparison_schema()
    if document == "design":
        from assoc_hull.creation.design import design_schema

        return design_schema()
    if document == "surfaces":
        from assoc_hull.io.surfaces.surface_json import surfaces_schema

        return surfaces_schema()
    if document == "plates":
        from assoc_hull.io.tables.plates import plates_schema

        return plates_schema()
    if document == "hull-surface":
        from assoc_hull.io.surfaces.hull_surface import net_surface_schema

        return net_surface_schema()
    if document == "hull-plates":
        from assoc_hull.io.tables.hull_plates import hull_plates_schema

        return hull_plates_schema()
    from assoc_hull.io.tables.form_parameters import catalogue_schema, form_schema

    return catalogue_schema() if document == "form-catalogue" else form_schema()


# --------------------------------------------------------------------------------------
# The arguments of all commands.

_ABOUT = "Associative ship hull forms: lines that follow one another when one is changed."
_EXAMPLES = """
examples:
  assoc-hull demo --out demo
  assoc-hull example series60-070 -o ship.hull
  assoc-hull edit ship.hull edits.json --why "BTK 0.44"
  assoc-hull undo ship.hull
  assoc-hull check ship.hull --json
  assoc-hull plot ship.hull -o lines.pdf

exit codes: 0 done; 1 findings (check, doctor, verify, an edit refused or not made); 2 bad input or
usage; 3 an imported hull is not sound
"""

_COMMANDS = (
    add_demo,
    add_example_and_import,
    add_doctor,
    add_create,
    add_classical,
    add_curve,
    add_inspection,
    add_edit,
    add_fair,
    add_history,
    add_replay,
    add_why,
    add_graph,
    add_hydrostatics,
    add_parameters,
    add_stability,
    add_resistance,
    add_transform,
    add_page,
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
    >>> from assoc_hull.cli.commands import make_parser
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
