"""The help of each command: `python docs/commands.py` prints it.

`docs/site_hook.py` puts it below the heading of the command in `docs/cli.md` when the site is
built: usage, options and examples are always those of the program.
"""

import argparse
import os

from assoc_hull.cli.command_table import COMMANDS
from assoc_hull.cli.commands import make_parser

PAGE = "cli.md"
MARK = r"<!-- help of (\w+) -->\n"


def tables(name: str) -> str:
    """Give what a command does, its usage, options and examples."""
    os.environ["COLUMNS"] = "100"  # argparse asks for the width of the terminal
    (found,) = (
        each for each in make_parser([name])._actions
        if isinstance(each, argparse._SubParsersAction)
    )  # fmt: skip
    parser = found.choices[name]
    about, parser.description = parser.description, None
    return f"{about}\n\n```text\n{parser.format_help().rstrip()}\n```\n"


if __name__ == "__main__":
    print("\n".join(f"## {name}\n\n{tables(name)}" for name in COMMANDS))
