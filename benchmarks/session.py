"""A session of a thousand edits in a hull file: what a commit costs, and opening it afterwards.

Series 60 CB .70 with further lines cut between its own, 170 in all. Three of four edits drag a
shared crossing by millimetres, most others pull the hull over 12 x 5 m; now and then a line
is removed and cut again, and an edit is undone and redone.
"""

from __future__ import annotations

import os
import random
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from unittest import mock

import attrs
import numpy as np

import assoc_hull as ah
from assoc_hull.edit.document import Document
from assoc_hull.edit.step import Step
from assoc_hull.errors import AssocHullError
from assoc_hull.io.hull_file.storage import HullFile
from benchmarks.clock import Figure

__all__ = ["figures"]

LINES = 170
EDITS = 1000
FURTHER = {"sections": 45, "waterlines": 30, "buttocks": 18}


@attrs.define
class Session:
    """What was measured, by kind of edit."""

    commit: dict[str, list[float]] = attrs.field(factory=dict)
    edit: dict[str, list[float]] = attrs.field(factory=dict)
    kept: dict[str, list[int]] = attrs.field(factory=dict)

    def note(self, kind: str, edit: float, commit: float, kept: int) -> None:
        for table, value in ((self.edit, edit), (self.commit, commit), (self.kept, kept)):
            table.setdefault(kind, []).append(value)  # type: ignore[attr-defined]


def figures(quick: bool = False) -> list[Figure]:
    """Measure."""
    count = EDITS // 10 if quick else EDITS
    with tempfile.TemporaryDirectory() as folder:
        path, hull = Path(folder) / "ship.hull", _net()
        hull.save(path)
        hull.close()
        whole = os.path.getsize(path)
        session = _edit(path, count)
        opened, history = _open(path)
        grown = os.path.getsize(path) - whole
    found = [
        Figure("curves of the net", len(hull.lines), "", LINES),
        Figure("crossings of the net", len(hull.crossings), ""),
        Figure("edits", count, ""),
        Figure("file before the edits", whole / 1024, "kB"),
        Figure("grown by, per edit", grown / count / 1024, "kB"),
        Figure("grown by, per edit / file", grown / count / whole, "x", 0.05, "most"),
    ]
    for kind in sorted(session.edit):
        edit, commit = np.median(session.edit[kind]), np.median(session.commit[kind])
        found += [
            Figure(f"{kind}: kept", float(np.median(session.kept[kind])) / 1024, "kB"),
            Figure(f"{kind}: edit without commit", 1e3 * float(edit), "ms"),
            Figure(f"{kind}: commit", 1e3 * float(commit), "ms"),
            Figure(f"{kind}: commit / edit", float(commit / edit)),
        ]
    found += [
        Figure("opening it, by the clock", 1e3 * opened, "ms", 500.0, "most"),
        Figure("reading all reports then", 1e3 * history, "ms"),
    ]
    return [attrs.evolve(each, name=f"session: {each.name}") for each in found]


def _net() -> ah.Hull:
    """Cut further lines midway between those that there are, widest gaps first; no history."""
    hull = ah.examples.series60(cb=0.70)
    for group, count in FURTHER.items():
        for _ in range(count):
            _cut(hull, group)
    return ah.Hull(hull.state)


def _cut(hull: ah.Hull, group: str) -> None:
    places = sorted(line.position or 0.0 for line in hull.groups[group].lines.values())
    gaps = sorted(zip(np.diff(places), places, strict=False), reverse=True)
    for gap, low in gaps:
        try:
            with hull.edit("a further line") as edit:
                edit.add_line(group, low + 0.5 * float(gap))
        except AssocHullError:
            continue
        return


def _edit(path: Path, count: int) -> Session:
    """Edit; each commit is timed by itself."""
    session, rng, hull = Session(), random.Random(1), ah.open(path)
    points = [
        name
        for name, point in hull.points.items()
        if point.free == ("y",) and point.driver is None and point.role == "defining"
    ]
    taken: list[float] = []
    commit = HullFile.commit

    def timed(self: HullFile, step: Step, *rest: object) -> None:
        start = time.perf_counter()
        commit(self, step, *rest)  # type: ignore[arg-type]
        taken.append(time.perf_counter() - start)

    with mock.patch.object(HullFile, "commit", timed):
        while len(hull.document.history) < count:
            kind, act = _choose(hull, points, rng)
            before, start = len(taken), time.perf_counter()
            try:
                with hull.edit(kind) as edit:
                    act(edit)
            except AssocHullError:
                continue
            if len(taken) > before:
                whole = time.perf_counter() - start
                session.note(kind, whole - taken[-1], taken[-1], _kept(hull.document))
            if rng.random() < 0.05:
                hull.undo()
                hull.redo()
    hull.close()
    return session


def _choose(
    hull: ah.Hull, points: list[str], rng: random.Random
) -> tuple[str, Callable[..., object]]:
    name, part = rng.choice(points), rng.random()
    by = rng.uniform(-0.002, 0.002)
    if part < 0.75:
        return "drag", lambda edit: edit.move(name, y=hull.points[name].y + by)
    if part < 0.97:
        return "pull", lambda edit: edit.pull(name, d=by, radius=(12.0, 5.0))
    extra = [line for line in hull.lines if line.startswith("extra")]
    if extra:
        return "line removed", lambda edit: edit.remove_line(extra[0])
    place = rng.uniform(1.0, 6.0)
    return "line added", lambda edit: edit.add_line("waterlines", place, f"extra {place:.4f}")


def _kept(document: Document) -> int:
    """Give the bytes that the last step has in the file."""
    file = document.keeper
    assert isinstance(file, HullFile)
    row = file.database.execute(
        "SELECT length(change) + length(trace) + length(report) + length(script) "
        "FROM steps WHERE number = ?", (document.head,),
    ).fetchone()  # fmt: skip
    return int(row[0])


def _open(path: Path) -> tuple[float, float]:
    """Give the least time of several openings, and of reading all reports after one."""
    opened, history = [], []
    for _ in range(7):
        start = time.perf_counter()
        hull = ah.open(path)
        opened.append(time.perf_counter() - start)
        start = time.perf_counter()
        assert hull.history
        history.append(time.perf_counter() - start)
        hull.close()
    return min(opened), min(history)
