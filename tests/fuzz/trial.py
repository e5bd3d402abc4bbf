"""One input: the commands are run on it, and whatever they may not do is named."""

from __future__ import annotations

import argparse
import contextlib
import functools
import gc
import io
import json
import re
import time
import traceback
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from unittest import mock

import attrs

from assoc_hull import cli
from assoc_hull.cli.commands import make_parser
from assoc_hull.errors import AssocHullError
from assoc_hull.io.hull_file.saving import open_hull_file
from assoc_hull.io.hull_json import read_hull_json
from tests.fuzz.kind import TARGET, Kind
from tests.fuzz.measure import MOST_MEMORY, MOST_TIME, peak_memory, processor_time, reset_peak
from tests.fuzz.taken import verdict_in, wrong_volume

__all__ = ["Outcome", "signature", "trial"]

MASKS = ("inside the program", "these values cannot be used (", "Traceback")
"""What a message says when nobody foresaw the input."""

LONGEST = 2000
"""So many letters may a message have: it is to be read."""

_all_commands = functools.cache(make_parser)


def _parser(words: Sequence[str]) -> argparse.ArgumentParser:
    """Give the parser of all commands, made once."""
    return _all_commands()


@attrs.frozen
class Outcome:
    """What became of an input.

    Attributes
    ----------
    code : int
        The last exit code.
    fault : str
        What was wrong; empty if nothing was.
    seconds : float, s
        How long it took, by the clock.
    word : str
        The verdict on what was imported, if any.
    spent : float, s
        Of processors.
    memory : float, MB
        Taken at most.
    """

    code: int
    fault: str = ""
    seconds: float = 0.0
    word: str = ""
    spent: float = 0.0
    memory: float = 0.0


def signature(fault: str) -> str:
    """A fault without names and numbers: two inputs of one signature show one fault."""
    return re.sub(r"'[^']*'|\"[^\"]*\"|[-+]?\d[\d.e+-]*(?![^ ]*\.py)", "~", fault)[:200]


def trial(kind: Kind, data: bytes, folder: Path) -> Outcome:
    """Run the commands of a kind on an input, in an empty folder; the folder is emptied again."""
    given = {**kind.beside(), kind.file: data}
    for name, content in given.items():
        (folder / name).write_bytes(content)
    held = reset_peak()
    start, spent, code, fault, word = time.perf_counter(), processor_time(), 0, "", ""
    try:
        with _inside(folder):
            for command in kind.commands(data):
                code, fault, told = _run(command)
                fault = fault or _files(kind, folder, given, command, code)
                if command[:1] == ["import"] and not fault:
                    word, fault = _taken(folder, code, told)
                if code or fault:
                    break
    finally:
        for path in folder.iterdir():
            path.unlink()
    taken, memory = processor_time() - spent, peak_memory() - held
    if not fault and (taken > MOST_TIME or memory > MOST_MEMORY):
        fault = f"it took {taken:.1f} s of processor time and {memory:.0f} MB"
    return Outcome(code, fault, time.perf_counter() - start, word, taken, memory)


def _taken(folder: Path, code: int, told: str) -> tuple[str, str]:
    """Give the verdict on an import, and what is wrong with a hull that was taken."""
    target = folder / TARGET
    word = verdict_in(told) if told else ""
    if code or not target.exists() or "taken from" in told or '"source"' in told:
        return word, ""
    if not word:
        return "", "import: taken without a verdict"
    # Of a hull that is not sound, and was taken on demand, the verdict says what is wrong.
    wrong = "" if word == "not sound" else wrong_volume(target)
    return word, f"import: {wrong}" if wrong else ""


@contextlib.contextmanager
def _inside(folder: Path) -> Iterator[None]:
    """Run in a folder, with a parser that is made once: making it takes most of the time."""
    with contextlib.chdir(folder), mock.patch.object(cli, "make_parser", _parser):
        yield


def _run(command: list[str]) -> tuple[int, str, str]:
    """Run a command; gives its exit code, what is wrong with what it said, and what it told."""
    out, err = io.StringIO(), io.StringIO()
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = cli.main(command)
    except BaseException as error:
        if isinstance(error, KeyboardInterrupt):
            raise
        place = traceback.extract_tb(error.__traceback__)[-1]
        at = f"{Path(place.filename).name}:{place.lineno}"
        return -1, f"{command[0]}: {type(error).__name__} left the program: {error} ({at})", ""
    wrong = _said(code, out.getvalue(), err.getvalue())
    return code, f"{command[0]}: {wrong}" if wrong else "", out.getvalue()


def _said(code: int, out: str, err: str) -> str:
    """What is wrong with what a command said."""
    if any(each in err for each in MASKS):
        return err.strip()[-600:]
    if code not in (0, 1, 2, 3):
        return f"exit code {code}: {err[:200]}"
    if code == 0 and err:
        return f"it was done, and yet said: {err[:200]}"
    if code in (1, 3) and not out:
        return f"no findings were told: {err[:200]}"
    if code == 2 and out:
        return f"it told facts and failed: {out[:200]}"
    if code in (2, 3) and not (err.startswith("error: ") and err.count("\n") == 1):
        return f"no single line of error: {err[:200]!r}"
    if code in (2, 3) and len(err) > LONGEST:
        return f"a message of {len(err)} letters: {err[:200]}"
    return ""


def _files(
    kind: Kind, folder: Path, given: Mapping[str, bytes], command: list[str], code: int
) -> str:
    """What is wrong with the files after a command."""
    found = {path.name for path in folder.iterdir()}
    if found - set(given) - {TARGET, *kind.extra}:
        gc.collect()  # what an error still holds is let go of when a program ends
        found = {path.name for path in folder.iterdir()}
    wanted = {name for name in (TARGET, *kind.extra) if name in command}
    for name, content in given.items():
        if name in found and (folder / name).read_bytes() == content:
            continue
        if code or name != kind.file or command[0] not in kind.rewrites or TARGET in command:
            return f"{command[0]}: it changed {name}"
        wanted.add(name)
    left = found - set(given) - {TARGET, *kind.extra}
    if left:
        return f"{command[0]}: it left {', '.join(sorted(left))} behind"
    for name in wanted & found:
        # Of a hull that is refused the report is written all the same, to mend the file by.
        if code and not (code == 3 and name != TARGET):
            return f"{command[0]}: it failed and left {name}"
        try:
            _whole(folder / name)
        except (AssocHullError, ValueError) as error:
            return f"{command[0]}: it wrote a {name} that cannot be read: {error}"
    missing = wanted - found if code == 0 else set()
    return f"{command[0]}: it was done and wrote no {', '.join(missing)}" if missing else ""


def _whole(path: Path) -> None:
    """Read what was written."""
    if path.name.endswith(".hull.json"):
        read_hull_json(path)
    elif path.suffix == ".hull":
        open_hull_file(path)
    elif path.suffix == ".json":
        json.loads(path.read_text("utf-8"))
