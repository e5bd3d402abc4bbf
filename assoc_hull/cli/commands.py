"""The parser of the command line, made of the table of commands.

With the words that were typed only the module of their command is loaded; help, and a name that is
no command, load none.
"""

from __future__ import annotations

import argparse
import difflib
import importlib
import re
import shutil
import sys
import textwrap
from collections.abc import Sequence
from typing import Any, NoReturn

from assoc_hull.cli.command_table import COMMANDS, GROUPS, SYNONYMS, Command
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

exit codes: 0 done; 1 findings (check, doctor, verify, an edit refused or not made); 2 bad input or
usage; 3 an imported hull is not sound
"""


_OWN = ("-h", "--help", "--version")
"""Options of the program itself."""


class _Parser(argparse.ArgumentParser):
    """Raises where argparse would print several lines and leave."""

    def __init__(self, **given: Any) -> None:
        # an option in short may be another one tomorrow: --to was taken for --tolerance
        super().__init__(**{"allow_abbrev": False, **given})

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Refuse what is left over here, where the options of the command are known."""
        found, rest = super().parse_known_args(args, namespace)
        if rest:
            self.error(f"unrecognized arguments: {' '.join(rest)}{self._meant(rest)}")
        if "options" not in found:  # of the command, which is parsed first
            found.options = {
                action.dest: max(action.option_strings, key=len)
                for action in self._actions if action.option_strings
            }  # fmt: skip
        return found, rest

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        """Name the choices that are nearest to a word that is none."""
        try:
            super()._check_value(action, value)
        except argparse.ArgumentError as error:
            near = difflib.get_close_matches(str(value), list(map(str, action.choices or ())), 3)
            if not near:
                raise
            meant = " or ".join(f"'{each}'" for each in near)
            said = f"did you mean {meant}? {error.message}"
            raise argparse.ArgumentError(action, said) from None

    def _meant(self, rest: Sequence[str]) -> str:
        """Say which option a word that was not known stands for, perhaps."""
        unknown = [each.partition("=")[0] for each in rest if each.startswith("-")]
        if any(each.startswith("=") or each.endswith("=") for each in rest):
            return "; write NAME=VALUE without blanks around the sign"
        if not unknown:
            takes = any("NAME=VALUE" in str(action.metavar) for action in self._actions)
            if takes and len(rest) > 1 and re.fullmatch(r"[-+]?[\d.,]+[a-z%]*", rest[1]):
                return f"; write {rest[0]}={rest[1]}"
            return "; options stand behind all values"
        # Whoever types --KG means --kg.
        options = {each.lower(): each for action in self._actions for each in action.option_strings}
        near = difflib.get_close_matches(unknown[0].lower(), list(options), 3, 0.6)
        meant = " or ".join(f"'{options[each]}'" for each in near)
        return f"; did you mean {meant}?" if meant else "; there is no such option"

    def error(self, message: str) -> NoReturn:
        raise UsageError(f"{message}, in {self.prog}; see: {self.prog} --help")


class _MainParser(_Parser):
    """Its help lists the commands by what a person wants to do."""

    def format_help(self) -> str:
        wide = min(shutil.get_terminal_size().columns - 2, 100)
        indent = max(map(len, COMMANDS)) + 4
        parts = [f"usage: {self.prog} COMMAND ...", _ABOUT]
        for title, commands in GROUPS.items():
            lines = [
                textwrap.fill(
                    command.about, wide, initial_indent=f"  {name:<{indent - 2}}",
                    subsequent_indent=" " * indent,
                )
                for name, command in commands.items()
            ]  # fmt: skip
            parts.append("\n".join([f"{title}:", *lines]))
        parts.append(f"options of all commands:\n  -h, --help   show help\n\n{self.prog} --version")
        return "\n\n".join([*parts, (self.epilog or "").strip()]) + "\n"


def make_parser(words: Sequence[str] | None = None) -> argparse.ArgumentParser:
    """Make the parser of the command line; each command sets ``run``.

    Parameters
    ----------
    words : sequence of str or None
        What was typed: only its command is there then. All are if None.

    Raises
    ------
    UsageError
        The first word is no command.

    Examples
    --------
    >>> from assoc_hull.cli.commands import make_parser
    >>> make_parser().parse_args(["info", "ship.hull.json"]).hull.name
    'ship.hull.json'
    """
    parser = _MainParser(prog="assoc-hull", epilog=_EXAMPLES)
    parser.add_argument("--version", action="version", version=f"assoc-hull {_version()}")
    commands: argparse._SubParsersAction[argparse.ArgumentParser] = parser.add_subparsers(
        metavar="COMMAND", required=True, parser_class=_Parser
    )
    for module, adder in dict.fromkeys((c.module, c.adder) for c in _chosen(words)):
        getattr(importlib.import_module(f"assoc_hull.cli.{module}"), adder)(commands)
    return parser


def _chosen(words: Sequence[str] | None) -> list[Command]:
    """Give the commands whose arguments are needed."""
    if words is None:
        return list(COMMANDS.values())
    name = words[0] if words else ""
    if name in COMMANDS:
        return [COMMANDS[name]]
    if words and (not name or (name.startswith("-") and name not in _OWN)):
        raise UsageError(f"the first word is {name!r}; the command comes first, options behind it")
    if name and not name.startswith("-"):
        name = name.lower()
        near = [SYNONYMS[name]] if name in SYNONYMS else []
        near += difflib.get_close_matches(name, COMMANDS, 3, 0.6)
        near += [each for each in COMMANDS if each.startswith(name)]
        meant = " or ".join(f"'{each}'" for each in dict.fromkeys(near))
        ask = f"did you mean {meant}? " if meant else ""
        raise UsageError(f"there is no command {name[:60]!r}; {ask}see: assoc-hull --help")
    return []


def _version() -> str:
    """Give the version of the package this module belongs to."""
    package = sys.modules[__name__.partition(".")[0]]
    return str(vars(package)["__version__"])
