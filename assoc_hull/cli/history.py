"""Commands that go through the history of a hull file."""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from assoc_hull.cli.arguments import Commands, add_command, add_hull, add_json, add_wait
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.words import edit_words
from assoc_hull.edit.report import EditReport
from assoc_hull.errors import BadInputError
from assoc_hull.hull import Hull
from assoc_hull.sources import open as open_hull

__all__ = ["add", "open_with_history"]


def add(commands: Commands) -> None:
    """Add ``undo``, ``redo``, ``history``, ``checkpoint``, ``go`` and ``diff``."""
    for name, about in (("undo", "take back the last edits"), ("redo", "make them again")):
        turn = add_command(
            commands, name, about, _turn,
            f"assoc-hull {name} ship.hull\nassoc-hull {name} ship.hull 3",
        )  # fmt: skip
        _add_common(turn, writes=True)
        turn.add_argument("count", metavar="N", type=int, nargs="?", default=1, help="default: 1")
        turn.set_defaults(act=name)
    history = add_command(
        commands, "history", "list the edits, checkpoints and branches", _history,
        "assoc-hull history ship.hull\nassoc-hull history ship.hull --step 3 --json",
    )  # fmt: skip
    _add_common(history, writes=False)
    history.add_argument(
        "--step", metavar="N", type=int, help="tell one edit in full: what was asked for, and done"
    )
    check = add_command(
        commands, "checkpoint", "name the present state", _checkpoint,
        'assoc-hull checkpoint ship.hull "before the bulb"',
    )  # fmt: skip
    _add_common(check, writes=True)
    check.add_argument("name", metavar="NAME", help="a name that is free")
    go = add_command(
        commands, "go", "return to a checkpoint or branch", _go,
        'assoc-hull go ship.hull "before the bulb"',
    )  # fmt: skip
    _add_common(go, writes=True)
    go.add_argument("name", metavar="NAME", help="as `history` lists it")
    diff = add_command(
        commands, "diff", "tell how two states differ", _diff,
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
        "history": [_facts(report) for report in done],
        "undone": [_facts(report) for report in undone],
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
    facts = _facts(report) | {
        "parent": step.parent, "policy": script.policy, "gaps": script.gaps,
        "edits": script.edits, "report": report, "fingerprint": step.fingerprint,
    }  # fmt: skip
    asked = [f"  {json.dumps(each, ensure_ascii=False)}" for each in script.edits]
    told = [
        f"{report.number}  {report.time}  {report.author}  {report.name}",
        *(asked or ["  (what was asked for is not known)"]),
        edit_words(hull, report),
    ]
    emit(arguments, facts, "\n".join(told))
    return 0


def _facts(report: EditReport) -> dict[str, Any]:
    return {
        "number": report.number, "name": report.name, "author": report.author,
        "time": report.time, "relofted": len(report.relofted), "largest": report.largest,
        "notes": report.notes,
    }  # fmt: skip


def _lines(
    reports: tuple[EditReport, ...], names: dict[int, list[str]], mark: str
) -> Iterator[str]:
    """Give a line for each edit, and one for each name of the state after it."""
    for each in reports:
        moved = f", {1e3 * each.largest.distance:.1f} mm" if each.largest else ""
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
    with progress("comparing"):
        found = hull.diff(arguments.before, arguments.after)
    emit(arguments, {"diff": found}, str(found))
    return 0
