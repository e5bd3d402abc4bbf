"""A line of a net is watched while it is shifted: is each crossing on the branch it was on?

A crossing is on the branch whose place is nearest to its own on the other line. Within
`CLOSE` of where a branch begins or ends it may be there or not; elsewhere it must be, by the
identity it has had on that branch, and by none that was on another one or that has died.
"""

from __future__ import annotations

from collections import Counter

import attrs
import numpy as np

import assoc_hull as ah
from assoc_hull.edit.step import EditReport
from assoc_hull.geometry.curves import FloatArray
from tests.cases.true_branches import Branch

__all__ = ["AXIS", "CLOSE", "NetWatch", "events"]

CLOSE = 3e-3
"""Shifts may change other lines by millimetres, and with them where a branch ends (m)."""

AXIS = {"waterlines": 2, "buttocks": 1}
"""Of the planes of a group."""


@attrs.frozen
class Seen:
    """What is there: crossings, the one on each branch that is sure, and the curves."""

    ids: frozenset[str]
    on: dict[str, str]
    curves: frozenset[str]


class NetWatch:
    """Watches a line that is shifted between two places, along the branches of all others.

    Attributes
    ----------
    wrong : list of str
        What is not as it should be; none if all is well.
    count : Counter of str
        Shifts, attachments looked at, births and deaths.
    off : float, m
        The farthest that a crossing was from its branch: how far the other lines moved.
    """

    def __init__(self, hull: ah.Hull, line: str, branches: dict[str, list[Branch]]) -> None:
        self.hull, self.line, self.branches = hull, line, branches
        lines = hull.lines
        self.bounds = [
            branch
            for name, some in self.branches.items()
            for branch in some
            if lines[name].boundary == "end"
        ]
        self.wrong, self.count, self.off = list[str](), Counter[str](), 0.0
        self.life, self.dead = dict[str, str](), set[str]()
        self.seen = self.look(float(hull.lines[line].position or 0.0))

    def shift(self, place: float) -> None:
        """Shift the line, and note all that is wrong."""
        with self.hull.edit("shift") as edit:
            edit.shift_line(self.line, place)
        assert edit.report is not None
        self.count["shifts"] += 1
        before, self.seen = self.seen, self.look(place)
        for name in before.on.keys() & self.seen.on.keys():
            if before.on[name] != self.seen.on[name]:
                self._say(place, f"{name} had {before.on[name]}, has {self.seen.on[name]}")
        self._compare(place, before, edit.report)

    def _compare(self, place: float, before: Seen, report: EditReport) -> None:
        """Compare what came and went with the report; what is dead does not come back."""
        was, now = before.ids | before.curves, self.seen.ids | self.seen.curves
        if set(report.born) - set(report.gone) != now - was:
            self._say(place, f"born {sorted(now - was)}, told {report.born}")
        if set(report.gone) - set(report.born) != was - now:
            self._say(place, f"gone {sorted(was - now)}, told {report.gone}")
        self.dead |= was - now
        if self.dead & now:
            self._say(place, f"back from the dead: {sorted(self.dead & now)}")
        self.count["births"] += len(self.seen.ids - before.ids)
        self.count["deaths"] += len(before.ids - self.seen.ids)
        self.count["pieces born"] += len(self.seen.curves - before.curves)
        self.count["pieces gone"] += len(before.curves - self.seen.curves)

    def look(self, place: float) -> Seen:
        """Find the crossing of each branch; each that is sure has just one."""
        found: dict[str, str] = {}
        pieces: dict[str, set[str]] = {}
        ids: set[str] = set()
        for curve in self.hull.lines[self.line].curves:
            for point in curve.points:
                if point.friend_point is None:
                    continue
                ids.add(point.id)
                branch = self._branch(point, place)
                if branch is None or not _sure(branch, place):
                    continue
                pieces.setdefault(curve.id, set()).add(branch.name)
                self._attach(place, branch, point, found)
        self._complete(place, found, pieces)
        return Seen(
            frozenset(ids), found, frozenset(c.id for c in self.hull.lines[self.line].curves)
        )

    def _attach(self, place: float, branch: Branch, point: ah.Point, found: dict[str, str]) -> None:
        """Note what is on a branch, and that it has always been on that one."""
        name, was = branch.name, self.life.setdefault(point.id, branch.name)
        if was != name:
            self._say(place, f"{point.id} was on {was}, is on {name}")
        if name in found:
            self._say(place, f"{name} has both {found[name]} and {point.id}")
        found[name] = point.id
        self.count["attachments"] += 1
        self.off = max(self.off, _away(branch, place, point))

    def _branch(self, point: ah.Point, place: float) -> Branch | None:
        """Give the branch of the other line that a crossing is on."""
        other = point.friend_point
        assert other is not None
        line = other.container_curve.line.name
        near = [b for b in self.branches[line] if b.low - CLOSE < place < b.high + CLOSE]
        if not near:
            self._say(place, f"{point.id} is where {line} does not pass")
            return None
        return min(near, key=lambda branch: _away(branch, place, point))

    def _complete(self, place: float, found: dict[str, str], pieces: dict[str, set[str]]) -> None:
        """See that no branch lacks its crossing, and that the pieces are the true ones."""
        alive = [b for some in self.branches.values() for b in some if b.low < place < b.high]
        lost = sorted(each.name for each in alive if _sure(each, place) and each.name not in found)
        if lost:
            self._say(place, f"no crossing on {lost}")
        if any(min(abs(end - place) for end in _ends(each)) <= CLOSE for each in self.bounds):
            return
        along = {each.name: float(each.where(place)[0]) for each in alive if each.name in found}
        ends = sorted(along[each.name] for each in self.bounds if each.name in along)
        true = [
            {name for name, x in along.items() if first <= x <= last}
            for first, last in zip(ends[::2], ends[1::2], strict=False)
        ]
        if sorted(map(sorted, true)) != sorted(map(sorted, pieces.values())):
            self._say(place, f"{len(true)} pieces hold other crossings than {sorted(pieces)}")

    def _say(self, place: float, text: str) -> None:
        self.wrong.append(f"at {place:.4f} m: {text}")


def events(branches: dict[str, list[Branch]], low: float, high: float) -> list[float]:
    """Give the places between two others at which branches begin or end, ascending."""
    every = [end for some in branches.values() for each in some for end in _ends(each)]
    return sorted({round(end, 3) for end in every if low < end < high})


def _ends(branch: Branch) -> tuple[float, float]:
    return branch.low, branch.high


def _sure(branch: Branch, place: float) -> bool:
    return branch.low + CLOSE < place < branch.high - CLOSE


def _away(branch: Branch, place: float, point: ah.Point) -> float:
    other = point.friend_point
    assert other is not None
    at: FloatArray = branch.where(place)
    return float(np.linalg.norm(at - other.position))
