"""Commands for the shell and for other programs: completion, and the JSON Schema of documents.

`completion` prints a script for the shell from the parser of all commands; `schema` prints the JSON
Schema of any document that commands read or write.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from assoc_hull.cli.arguments import Commands, add_command
from assoc_hull.cli.commands import make_parser
from assoc_hull.cli.problems import check_target

__all__ = ["add_completion_and_schema"]

_SHELLS = ("bash", "zsh", "fish")
_ASK = 'assoc-hull info "$each" --names 2>/dev/null'
_NAMES = {
    "bash": f"""_assoc_hull_names() {{
  local each name quote="${{1:0:1}}" typed="${{1//\\\\}}" before=""
  [[ $quote == [\\"\\'] ]] && typed="${{typed:1}}" || quote=""
  [[ $typed == *" x "* ]] && before="${{typed%" x "*}} x "
  for each in "${{COMP_WORDS[@]}}"; do
    [[ $each == *.hull || $each == *.hull.json ]] && [[ -f $each ]] || continue
    {_ASK} | while IFS= read -r name; do
      name="$before$name"
      [[ $name == "$typed"* ]] || continue
      if [[ $quote ]]; then printf '%s\\n' "$name"; else printf '%q\\n' "$name"; fi
    done
    return
  done
}}""",
    "zsh": f"""_assoc_hull_names() {{
  local each=${{words[(r)*.hull(|.json)]}}
  local -a names=("${{(@f)$({_ASK})}}")
  compadd -a names
}}""",
    "fish": f"""function __assoc_hull_names
  for each in (string match -r '.*\\.hull(?:\\.json)?$' -- (commandline -opc))
    {_ASK}
  end
end""",
}
"""What lists the lines of the hull that stands on the command line, in the language of a shell."""
_CALLS = {"bash": "_assoc_hull_names", "zsh": "_assoc_hull_names", "fish": "(__assoc_hull_names)"}
_NAMED = ("OBJECT", "LINE", "VALUE")
"""Arguments that are names of lines, or hold them."""
_DOCUMENTS = (
    "hull", "form-catalogue", "form-parameters", "comparison", "design", "surfaces", "plates",
    "hull-surface", "hull-plates",
)  # fmt: skip


def add_completion_and_schema(commands: Commands) -> None:
    """Add ``completion`` and ``schema``."""
    completion = add_command(
        commands, "completion", _complete,
        """assoc-hull completion bash > ~/.local/share/bash-completion/completions/assoc-hull
        assoc-hull completion zsh > ~/.zfunc/_assoc-hull
        assoc-hull completion fish > ~/.config/fish/completions/assoc-hull.fish""",
    )  # fmt: skip
    completion.add_argument("shell", metavar="SHELL", choices=_SHELLS, help=", ".join(_SHELLS))
    schema = add_command(
        commands, "schema",
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
        elif action.metavar in _NAMED:
            action.complete = {**_CALLS, "preamble": _NAMES}  # type: ignore[attr-defined]
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
        from assoc_hull.io.surfaces.hull_surface import fitted_surface_schema

        return fitted_surface_schema()
    if document == "hull-plates":
        from assoc_hull.io.tables.plates import hull_plates_schema

        return hull_plates_schema()
    from assoc_hull.io.tables.form_parameters import catalogue_schema, form_schema

    return catalogue_schema() if document == "form-catalogue" else form_schema()
