"""Commands that edit a hull and go through its history.

`edit` carries out edits given as JSON, or tells what they would do; `undo`, `redo`, `history`,
`checkpoint`, `go`, `diff` move between steps; `replay` makes the edits of one hull again on
another. A hull is read from one file and written to it or to another; it is sure before
anything is computed that it can be written there.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import groupby
from operator import attrgetter
from pathlib import Path
from typing import Any

import attrs

from assoc_hull.cli.arguments import (
    Commands,
    add_command,
    add_hull,
    add_json,
    add_replace,
    add_wait,
    read_json,
)
from assoc_hull.cli.hull_words import edit_words, lists, wrap_text
from assoc_hull.cli.inspection import why_words
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.problems import (
    HULL_ENDINGS,
    InFileError,
    check_hull_target,
    check_target,
    is_apart,
)
from assoc_hull.cli.typed_edits import is_operation, typed_edit, unknown_edit
from assoc_hull.edit.arguments import GivenObjects
from assoc_hull.edit.explain.causes import Why
from assoc_hull.edit.explain.compare_states import state_at
from assoc_hull.edit.explain.preview import LineChange, Preview
from assoc_hull.edit.modifications.pull import usual_radius
from assoc_hull.edit.script import carry_out
from assoc_hull.edit.session import Edit
from assoc_hull.edit.step import EditReport
from assoc_hull.errors import AssocHullError, BadInputError, RefusedEditError
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import open as open_hull
from assoc_hull.model.address import AddressBook
from assoc_hull.model.definition.fingerprint import fingerprint

__all__ = [
    "HullToChange",
    "add_edit",
    "add_history",
    "add_replay",
    "open_to_change",
    "open_with_history",
    "preview_words",
]

# --------------------------------------------------------------------------------------
# A hull that a command changes: read from one file, written to it or to another.


@attrs.frozen(eq=False)
class HullToChange:
    """A hull, and where it goes once it is changed.

    Attributes
    ----------
    hull : Hull
        The hull; what is done to it is not in the file that it came from if it goes elsewhere.
    target : Path
        Where it goes.
    apart : bool
        Whether that is another file.
    replace : bool
        Whether that file may be there already.
    """

    hull: Hull
    target: Path
    apart: bool
    replace: bool

    def save(self) -> None:
        """Write the hull, unless it is in its file already."""
        if self.apart or self.hull.path is None:
            self.hull.save(self.target, replace=self.replace)


def open_to_change(arguments: argparse.Namespace) -> HullToChange:
    """Open a hull after it is sure that it can be written where it is to go.

    Parameters
    ----------
    arguments : Namespace
        With ``hull``, ``out``, ``wait`` and ``replace``.

    Raises
    ------
    AssocHullError
        The hull cannot be read, or not be written there.
    """
    target: Path = arguments.out or arguments.hull
    apart = is_apart(arguments.out, arguments.hull)
    check_target(target, HULL_ENDINGS)
    if apart:
        check_hull_target(target, replace=arguments.replace)
    hull = open_hull(arguments.hull, wait=arguments.wait)
    if apart:
        hull.detach()
    return HullToChange(hull, target, apart, arguments.replace)


# --------------------------------------------------------------------------------------
# What an edit would do, in words: which lines, how far, where, and what the hull displaces.

_SMALL = 1e-4
"""Lines that move less than this (m) are counted, and not named."""


def preview_words(hull: Hull, found: Preview, indent: str = "  ") -> Iterator[str]:
    """Say what an edit would do, in lines.

    Parameters
    ----------
    hull : Hull
        The hull as it is.
    found : Preview
        What was found; not refused.
    indent : str
        What every line begins with.
    """
    report = found.report
    if report is None or not report.changed:
        yield f"{indent}nothing would change"
        return
    yield f"{indent}would change {len(found.lines)} lines"
    for group, lines in groupby(found.lines, attrgetter("group")):
        yield from _group(group, tuple(lines), indent)
    yield from _remains(hull, report, indent)
    yield from _displaces(hull, found, indent)
    yield from lists(hull, report, indent)
    yield from _beside(hull, found.plain, indent)


def _group(name: str, lines: Sequence[LineChange], indent: str) -> Iterator[str]:
    """Name the lines of a group that would move, and say where most."""
    moved = [each for each in lines if each.distance is None or each.distance >= _SMALL]
    yield f"{indent}{name:12} {len(lines)}" + _less(len(lines) - len(moved))
    pad = indent + "  "
    if moved:
        yield wrap_text("lines", [each.line for each in moved], pad)
    yield from _most(lines, pad)


def _less(count: int) -> str:
    return f", {count} of them by less than {1e3 * _SMALL:g} mm" if count else ""


def _most(lines: Iterable[LineChange], pad: str) -> Iterator[str]:
    """Say which of some lines would move most, and where."""
    known = [each for each in lines if each.distance is not None and each.place is not None]
    if not known:
        return
    most = max(known, key=lambda each: each.distance or 0.0)
    x, y, z = most.place or (0.0, 0.0, 0.0)
    where = f"{most.line}, between its points," if most.point is None else most.point
    yield (
        f"{pad}{'most':12} {1e3 * (most.distance or 0.0):.3f} mm at {where} "
        f"({x:.3f}, {y:.3f}, {z:.3f}) m"
    )


def _remains(hull: Hull, report: EditReport, indent: str) -> Iterator[str]:
    """Name the curves that would turn more often than they do, and the largest gap."""
    added, book = report.inflections, AddressBook(hull.state)
    yield f"{indent}inflections  {sum(count for _, count in added)} new"
    if added:
        names = [f"{book.curve_name(book.keys[key].curve)} ({count})" for key, count in added]
        yield wrap_text("on", names, indent + "  ")
    yield f"{indent}largest gap  {1e3 * report.largest_gap:.2f} mm"


def _beside(hull: Hull, plain: Preview | None, indent: str) -> Iterator[str]:
    """Say what the plain field would do in place of the fair answer."""
    if plain is None:
        return
    if plain.report is None:
        yield f"{indent}with the plain field it would be refused: {'; '.join(plain.refused)}"
        return
    yield f"{indent}with the plain field"
    yield f"{indent}  would change {len(plain.lines)} lines"
    yield from _remains(hull, plain.report, indent + "  ")


def _displaces(hull: Hull, found: Preview, indent: str) -> Iterator[str]:
    if found.volume_change is None or found.lcb_change is None:
        yield f"{indent}volume       not known: it takes two sections or more"
        return
    draught = hull.particulars.draught
    yield (
        f"{indent}volume       {found.volume_change:+.4g} m3 (both sides, draught {draught:g} m); "
        f"LCB {1e3 * found.lcb_change:+.4g} mm"
    )


# --------------------------------------------------------------------------------------
# The command that carries out edits given as JSON.

Changes = Sequence[Mapping[str, Any]]


def add_edit(commands: Commands) -> None:
    """Add ``edit``."""
    parser = add_command(
        commands, "edit",
        _edit,
        """assoc-hull edit ship.hull pull "WL 0.5 x ST 16" 20mm --radius 20 8
        assoc-hull edit ship.hull move "WL 0.5 x ST 16" y=6.79 --dry-run
        assoc-hull edit ship.hull edits.json --why "BTK 0.44"
        assoc-hull edit ship.hull edits.json -o fairer.hull
        assoc-hull edit ship.hull edits.json --dry-run --json

        edits.json: [{"op": "move", "point": "WL 0.5 x ST 16", "y": 6.79},
        {"op": "pull", "point": "WL 0.5 x ST 17", "d": 0.02, "radius": [20, 8]}]
        (lengths in m; all modifications are one edit)""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument(
        "edits", metavar="EDITS", type=Path,
        help="a .json file with a list of modifications, or one of them: move, insert, delete, "
        "pull, reshape, lead, fair, straighten, round, spread, ... with its VALUES",
    )  # fmt: skip
    parser.add_argument(
        "values", metavar="VALUE", nargs="*",
        help="in the order of the arguments, or NAME=VALUE: a length (20mm, .02), a place (x,y,z), "
        "several (x,y,z;x,y,z), a name",
    )  # fmt: skip
    parser.add_argument(
        "-o", "--out", metavar="OUT", type=Path, help="where to write the hull (default: HULL)"
    )
    parser.add_argument("--name", help="its name (default: that of the file, or what is typed)")
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
    typed = str(arguments.edits)
    # With values it is typed; alone a file of that name is read.
    if is_operation(typed) and (arguments.values or not arguments.edits.exists()):
        changes: Changes = [typed_edit(typed, arguments.values)]
        name = arguments.name or " ".join([typed, *map(str.strip, arguments.values)])[:80]
    elif arguments.values or not (arguments.edits.suffix or arguments.edits.exists()):
        raise unknown_edit(typed)
    else:
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
    reach = list(_radii(hull, changes))
    with progress("updating"), _values_of(str(arguments.edits)), hull.edit(name) as edit:
        _modify_all(edit, changes, arguments.edits)
    assert edit.report is not None, "an edit without an error has a report"
    causes = {each: hull.why(each) for each in arguments.why}
    facts = _facts(edit.report, causes, hull.fingerprint, changed.target)
    told = [
        *reach, edit_words(hull, edit.report), *why_words(causes), f"written: {changed.target}",
    ]  # fmt: skip
    changed.save()  # last: what cannot be told leaves no file
    emit(arguments, facts, "\n".join([name, *told]))
    return 0


def _try(arguments: argparse.Namespace, name: str, changes: Changes) -> int:
    """Tell what the edit would do; nothing is written."""
    hull, wrong = open_hull(arguments.hull), list[InFileError]()

    def ask(edit: Edit) -> None:
        try:
            _modify_all(edit, changes, arguments.edits)
        except InFileError as error:  # a preview tells it as refused; here the file is wrong
            wrong.append(error)
            raise

    with progress("updating"), _values_of(str(arguments.edits)):
        found = hull.preview(ask, name=name, why=arguments.why)
    if wrong:
        raise wrong[0]
    if found.report is None:
        return _refused(arguments, name, found.refused)
    facts = _facts(found.report, found.why, found.fingerprint, None) | {
        "lines": found.lines, "volume_change": found.volume_change, "lcb_change": found.lcb_change,
        "plain": _plain_facts(found.plain),
    }  # fmt: skip
    told = [
        *_radii(hull, changes), *preview_words(hull, found), *why_words(found.why),
        "nothing written",
    ]  # fmt: skip
    emit(arguments, facts, "\n".join([name, *told]))
    return 0


def _radii(hull: Hull, changes: Changes) -> Iterator[str]:
    """Say how far pulls reach that are given no radius; nothing of points still to come."""
    for change in changes:
        if change.get("op") == "pull" and not change.get("radius"):
            with contextlib.suppress(AssocHullError):
                row, _ = GivenObjects(hull.state).point(change.get("point", ""))
                reach = usual_radius(hull.state, row)[0]
                yield f"  radius       {reach:.3g} m along the ship and the girth, as none is given"


def _plain_facts(plain: Preview | None) -> dict[str, Any] | None:
    """Give what the plain field would do; None where nothing is asked to be answered fairly."""
    if plain is None:
        return None
    report = plain.report
    return {
        "refused": plain.refused, "report": report, "lines": plain.lines,
        "inflections": None if report is None else report.inflections,
    }  # fmt: skip


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


# --------------------------------------------------------------------------------------
# Commands that go through the history of a hull file.


def add_history(commands: Commands) -> None:
    """Add ``undo``, ``redo``, ``history``, ``checkpoint``, ``go`` and ``diff``."""
    for name in ("undo", "redo"):
        turn = add_command(
            commands, name, _turn,
            f"assoc-hull {name} ship.hull\nassoc-hull {name} ship.hull 3",
        )  # fmt: skip
        _add_common(turn, writes=True)
        turn.add_argument("count", metavar="N", type=int, nargs="?", default=1, help="default: 1")
        turn.set_defaults(act=name)
    history = add_command(
        commands, "history", _history,
        "assoc-hull history ship.hull\nassoc-hull history ship.hull --step 3 --json",
    )  # fmt: skip
    _add_common(history, writes=False)
    history.add_argument(
        "--step", metavar="N", type=int, help="tell one edit in full: what was asked for, and done"
    )
    check = add_command(
        commands, "checkpoint", _checkpoint,
        'assoc-hull checkpoint ship.hull "before the bulb"',
    )  # fmt: skip
    _add_common(check, writes=True)
    check.add_argument("name", metavar="NAME", help="a name that is free")
    go = add_command(
        commands, "go", _go,
        'assoc-hull go ship.hull "before the bulb"',
    )  # fmt: skip
    _add_common(go, writes=True)
    go.add_argument("name", metavar="NAME", help="as `history` lists it")
    diff = add_command(
        commands, "diff", _diff,
        """assoc-hull diff ship.hull "before the bulb"
        assoc-hull diff ship.hull "before the bulb" "branch 1" --json""",
    )  # fmt: skip
    _add_common(diff, writes=False)
    diff.add_argument("before", metavar="NAME", help="a checkpoint or branch")
    diff.add_argument("after", metavar="NAME", nargs="?", help="default: the present state")


def _add_common(parser: argparse.ArgumentParser, *, writes: bool) -> None:
    add_hull(parser)
    if writes:
        add_wait(parser)
    add_json(parser)


def _open(arguments: argparse.Namespace) -> Hull:
    return open_with_history(arguments.hull, wait=getattr(arguments, "wait", 0.0))


def open_with_history(path: Path, wait: float = 0.0) -> Hull:
    """Open a hull file.

    Raises
    ------
    BadInputError
        It is text, which holds no history.
    """
    hull = open_hull(path, wait=wait)
    if hull.path is None:
        raise BadInputError(
            "this is text, and holds no history", f"at {path}",
            "make a hull file of it: assoc-hull import SHIP.hull.json -o SHIP.hull",
        )  # fmt: skip
    return hull


def _turn(arguments: argparse.Namespace) -> int:
    hull = _open(arguments)
    before = [step.name for step in hull.document.history]
    with progress(arguments.act):
        getattr(hull, arguments.act)(arguments.count)
    after = [step.name for step in hull.document.history]
    names = after[len(before) :] if len(after) > len(before) else before[len(after) :][::-1]
    word = "made again" if arguments.act == "redo" else "taken back"
    facts = {arguments.act: names, "fingerprint": hull.fingerprint, "steps": len(after)}
    emit(arguments, facts, "\n".join(f"{word}: {name}" for name in names))
    return 0


def _history(arguments: argparse.Namespace) -> int:
    hull = _open(arguments)
    if arguments.step is not None:
        return _one_step(arguments, hull)
    done, undone = hull.history, hull.undone[::-1]
    names: dict[int, list[str]] = {label.step: [] for label in hull.labels.values()}
    for label in hull.labels.values():
        names[label.step].append(label.name)
    facts = {
        "history": [_history_facts(report) for report in done],
        "undone": [_history_facts(report) for report in undone],
        "labels": list(hull.labels.values()),
    }
    lines = [*_named(names.pop(0, [])), *_lines(done, names, " "), "> the present state"]
    lines += _lines(undone, names, "-")
    lines += [f"branch or checkpoint elsewhere: {name}" for each in names.values() for name in each]
    emit(arguments, facts, "\n".join(lines))
    return 0


def _one_step(arguments: argparse.Namespace, hull: Hull) -> int:
    steps = hull.document.steps
    if arguments.step not in steps:
        what = f"step {arguments.step} was asked, and there are {len(steps)}"
        raise BadInputError(what, f"in {arguments.hull}", "see: assoc-hull history HULL")
    step = steps[arguments.step]
    report, script = step.report, step.script
    facts = _history_facts(report) | {
        "parent": step.parent, "policy": script.policy, "gaps": script.gaps,
        "edits": script.edits, "report": report,
        "fingerprint": fingerprint(state_at(hull.document, step.number)),
    }  # fmt: skip
    asked = [f"  {json.dumps(each, ensure_ascii=False)}" for each in script.edits]
    told = [
        f"{report.number}  {report.time}  {report.author}  {report.name}",
        *(asked or ["  (what was asked for is not known)"]),
        edit_words(hull, report),
    ]
    emit(arguments, facts, "\n".join(told))
    return 0


def _history_facts(report: EditReport) -> dict[str, Any]:
    return {
        "number": report.number, "name": report.name, "author": report.author,
        "time": report.time, "relofted": len(report.relofted), "largest": report.largest,
        "largest_normal": report.largest_normal, "notes": report.notes,
    }  # fmt: skip


def _lines(
    reports: tuple[EditReport, ...], names: dict[int, list[str]], mark: str
) -> Iterator[str]:
    """Give a line for each edit, and one for each name of the state after it."""
    for each in reports:
        most = each.largest_normal or each.largest
        moved = f", {1e3 * most.distance:.1f} mm" if most else ""
        who = f"  {each.author}" if each.author else ""
        yield (
            f"{mark} {each.number:4}  {each.time}{who}  {each.name}"
            f"  ({len(each.relofted)} curves{moved})"
        )
        yield from _named(names.pop(each.number, []))


def _named(names: list[str]) -> Iterator[str]:
    yield from (f"       [{name}]" for name in names)


def _checkpoint(arguments: argparse.Namespace) -> int:
    hull = _open(arguments)
    hull.checkpoint(arguments.name)
    facts = {"checkpoint": arguments.name, "step": hull.labels[arguments.name].step}
    emit(arguments, facts, f"checkpoint {arguments.name!r} after step {facts['step']}")
    return 0


def _go(arguments: argparse.Namespace) -> int:
    hull = _open(arguments)
    known = set(hull.labels)
    with progress("going there"):
        hull.go(arguments.name)
    left = sorted(set(hull.labels) - known)
    facts = {
        "at": arguments.name, "steps": len(hull.document.history), "fingerprint": hull.fingerprint,
        "left": left,
    }  # fmt: skip
    told = [f"at {arguments.name!r}, after {len(hull.document.history)} edits"]
    told += [f"what was left is on {name!r}" for name in left]
    emit(arguments, facts, "\n".join(told))
    return 0


def _diff(arguments: argparse.Namespace) -> int:
    hull = _open(arguments)
    for name in (arguments.before, arguments.after):
        if name and name not in hull.labels and name.endswith(HULL_ENDINGS):
            both = f"assoc-hull compare {arguments.hull} {name}"
            raise BadInputError(f"{name} is a file, not a checkpoint", "in diff", f"say: {both}")
    with progress("comparing"):
        found = hull.diff(arguments.before, arguments.after)
    emit(arguments, {"diff": found}, str(found))
    return 0


# --------------------------------------------------------------------------------------
# The command that makes the edits of one hull again on another.


def add_replay(commands: Commands) -> None:
    """Add ``replay``."""
    parser = add_command(
        commands, "replay",
        _replay,
        """assoc-hull replay ship.hull sister.hull
        assoc-hull replay ship.hull sister.hull.json -o faired.hull --skip""",
    )  # fmt: skip
    parser.add_argument("source", metavar="FROM", type=Path, help="the hull file with the edits")
    parser.add_argument("hull", metavar="HULL", type=Path, help="the hull to edit")
    parser.add_argument(
        "-o", "--out", metavar="OUT", type=Path, help="where to write the hull (default: HULL)"
    )
    parser.add_argument(
        "--skip", action="store_true", help="go on behind an edit that cannot be made"
    )
    add_wait(parser)
    add_replace(parser)
    add_json(parser)


def _replay(arguments: argparse.Namespace) -> int:
    changed = open_to_change(arguments)
    source = open_with_history(arguments.source)
    hull = changed.hull
    with progress("replaying"):
        found = hull.replay(source, skip=arguments.skip)
    failed = [each for each in found if each.report is None]
    left = len(source.history) - len(found)
    made = len(found) > len(failed)
    if made:
        changed.save()
    facts = {
        "edits": [{"name": e.name, "made": e.report is not None, "why": e.why} for e in found],
        "left": left, "fingerprint": hull.fingerprint, "saved": changed.target if made else None,
    }  # fmt: skip
    told = [*map(str, found), *([f"{left} more were not tried"] if left else [])]
    if made:
        told.append(f"written: {changed.target}")
    else:
        told.append("nothing written" if failed else f"{arguments.source} has no edits to make")
    emit(arguments, facts, "\n".join(told))
    return 1 if failed else 0
