"""The command that carries out edits given as JSON."""

from __future__ import annotations

import argparse
import contextlib
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from assoc_hull.cli.arguments import (
    Commands,
    add_command,
    add_hull,
    add_json,
    add_replace,
    add_wait,
)
from assoc_hull.cli.changed import open_to_change
from assoc_hull.cli.json_file import read_json
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.preview_words import preview_words
from assoc_hull.cli.problems import InFileError
from assoc_hull.cli.why import why_words
from assoc_hull.cli.words import edit_words
from assoc_hull.edit.explain.cause import Why
from assoc_hull.edit.report import EditReport
from assoc_hull.edit.script import carry_out
from assoc_hull.edit.session import Edit
from assoc_hull.errors import AssocHullError, BadInputError, RefusedEditError
from assoc_hull.sources import open as open_hull

__all__ = ["add"]

Changes = Sequence[Mapping[str, Any]]


def add(commands: Commands) -> None:
    """Add ``edit``."""
    parser = add_command(
        commands, "edit", "carry out edits and let the hull follow; exit 1 if they are refused",
        _edit,
        """assoc-hull edit ship.hull edits.json --why "BTK 0.44"
        assoc-hull edit ship.hull edits.json -o fairer.hull
        assoc-hull edit ship.hull edits.json --dry-run --json

        edits.json: [{"op": "move", "point": "WL 0.5 x ST 16", "y": 6.79},
        {"op": "pull", "point": "WL 0.5 x ST 17", "d": 0.02, "radius": [20, 8]}]
        (lengths in m; all modifications are one edit)""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument("edits", metavar="EDITS.json", type=Path, help="a list of modifications")
    parser.add_argument(
        "-o", "--out", metavar="OUT", type=Path, help="where to write the hull (default: HULL)"
    )
    parser.add_argument("--name", help="name of the edit (default: that of the file)")
    parser.add_argument(
        "--why", metavar="OBJECT", action="append", default=[],
        help="tell why this object changed; may be given more than once",
    )  # fmt: skip
    parser.add_argument(
        "--dry-run",
        action="store_true",
        help="tell what would change, by how much and where; write nothing",
    )
    add_wait(parser)
    add_replace(parser)
    add_json(parser)


def _edit(arguments: argparse.Namespace) -> int:
    changes = _read(arguments.edits)
    name = arguments.name or arguments.edits.stem
    try:
        if arguments.dry_run:
            return _try(arguments, name, changes)
        return _carry_out(arguments, name, changes)
    except RefusedEditError as error:
        return _refused(arguments, error.edit, error.findings)


def _carry_out(arguments: argparse.Namespace, name: str, changes: Changes) -> int:
    """Edit the hull and write it."""
    changed = open_to_change(arguments)
    hull = changed.hull
    for each in arguments.why:
        hull.find(each)  # before anything is edited
    with progress("updating"), _values_of(str(arguments.edits)), hull.edit(name) as edit:
        _modify_all(edit, changes, arguments.edits)
    assert edit.report is not None, "an edit without an error has a report"
    causes = {each: hull.why(each) for each in arguments.why}
    facts = _facts(edit.report, causes, hull.fingerprint, changed.target)
    told = [edit_words(hull, edit.report), *why_words(causes), f"written: {changed.target}"]
    changed.save()  # last: what cannot be told leaves no file
    emit(arguments, facts, "\n".join([name, *told]))
    return 0


def _try(arguments: argparse.Namespace, name: str, changes: Changes) -> int:
    """Tell what the edit would do; nothing is written."""
    hull = open_hull(arguments.hull)
    with progress("updating"), _values_of(str(arguments.edits)):
        found = hull.preview(
            lambda edit: _modify_all(edit, changes, arguments.edits), name=name, why=arguments.why
        )
    if found.report is None:
        return _refused(arguments, name, found.refused)
    facts = _facts(found.report, found.why, found.fingerprint, None) | {
        "lines": found.lines, "volume_change": found.volume_change, "lcb_change": found.lcb_change,
    }  # fmt: skip
    told = [*preview_words(hull, found), *why_words(found.why), "nothing written"]
    emit(arguments, facts, "\n".join([name, *told]))
    return 0


def _modify_all(edit: Edit, changes: Changes, file: Path) -> None:
    for number, change in enumerate(changes, start=1):
        with _values_of(f"{file}, modification {number}"):
            _modify(edit, change, f"{file}, modification {number}")


def _modify(edit: Edit, change: Mapping[str, Any], place: str) -> None:
    """Carry out one modification; whatever is wrong with it, say which one it is."""
    try:
        carry_out(edit, [change])
    except AssocHullError as error:
        raise InFileError(error, place) from error


@contextlib.contextmanager
def _values_of(place: str) -> Iterator[None]:
    """Name the place of values that no check foresaw."""
    try:
        yield
    except AssocHullError:
        raise
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        what = f"these values cannot be used ({type(error).__name__}: {error})"
        raise BadInputError(what, f"in {place}", "mend them") from error


def _refused(arguments: argparse.Namespace, name: str, findings: Sequence[str]) -> int:
    facts = {"refused": True, "edit": name, "findings": findings, "saved": None}
    emit(arguments, facts, "\n".join(findings))
    what = "would be refused" if arguments.dry_run else "refused"
    count = len(findings)
    print(
        f"{what}: edit {name!r}, {count} finding{'s' if count > 1 else ''}; the hull is unchanged",
        file=sys.stderr,
    )
    return 1


def _facts(
    report: EditReport, causes: Mapping[str, Why], fingerprint: str | None, saved: Path | None
) -> dict[str, Any]:
    return {
        "refused": False, "edit": report.name,
        "report": report, "inflections": report.inflections, "why": causes,
        "fingerprint": fingerprint, "saved": saved,
    }  # fmt: skip


def _read(path: Path) -> Changes:
    """Read a list of modifications.

    Raises
    ------
    BadInputError
        With file, place and remedy.
    """
    found = read_json(path, "list of edits")
    if not isinstance(found, list) or not found:
        what = "this is no list of modifications, or an empty one"
        raise BadInputError(what, f"in {path}", 'give [{"op": "move", "point": ...}, ...]')
    for number, change in enumerate(found, start=1):
        if not isinstance(change, dict) or not isinstance(change.get("op"), str):
            where = f"in {path}, modification {number}"
            raise BadInputError("it has no 'op'", where, 'give {"op": "move", "point": ...}')
    return found
