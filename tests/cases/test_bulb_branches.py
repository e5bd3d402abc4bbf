"""Branch identity on a hull with a bulb: a waterline and a buttock shifted through it.

What is true follows from the function of the hull (`true_branches`). The lines of the net
may pass the true ones by the tolerance of adoption; so where the truth has an event within
that distance of a place, the line is shifted there but nothing is compared until the next.
Steps of 2 cm are taken by the buttock, where events are closest together; with
`make test-long` steps of 1 cm by both, from before the neck.
"""

from __future__ import annotations

from pathlib import Path

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.step import EditReport
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.tolerance import Tolerances
from tests.cases.bulb import breadth_at, bulb_hull, contour
from tests.cases.true_branches import Branch, branches_of, neck, on_ring
from tests.long_forms import LONG

CLOSE = Tolerances().adoption
"""Events nearer (m) to a place than this may have happened on the net or not."""

PARTING = 0.01
"""So may the parting of a buttock (m): it happens between the lines, at no line's turn."""

BEFORE = {"waterlines": ("deck edge",), "buttocks": ("profile",)}
"""Boundary curves that lie along the planes of a family."""


@attrs.frozen
class Seen:
    """What was found at a place (m): the crossing of each branch, the branches of each curve."""

    place: float
    crossings: dict[str, str]
    pieces: dict[str, frozenset[str]]

    @property
    def ids(self) -> set[str]:
        """The crossings and curves that are there."""
        return {*self.crossings.values(), *self.pieces}


def heirs(
    before: dict[str, frozenset[str]], now: dict[str, frozenset[str]]
) -> dict[str, str | None]:
    """Say for each piece which earlier one it is: the one it shares most branches with."""
    shared = sorted(
        ((-len(was & part), list(before).index(old), new) for new, part in now.items()
         for old, was in before.items() if was & part),
    )  # fmt: skip
    found: dict[str, str | None] = dict.fromkeys(now)
    for _, number, new in shared:
        old = list(before)[number]
        if found[new] is None and old not in found.values():
            found[new] = old
    return found


class Watch:
    """Looks at a line while it is shifted, and compares with the truth."""

    def __init__(self, hull: ah.Hull, line: str) -> None:
        self.hull, self.line = hull, line
        group = hull.lines[line].group.name
        axis = {"waterlines": 2, "buttocks": 1}[group]
        self.branches = {
            name: branches_of(each.group.name, each.position or 0.0, name, axis)
            for name, each in hull.lines.items()
            if each.group.name != group and name not in BEFORE[group]
        }
        self.neck = neck() if group == "buttocks" else float("nan")
        self.seen = self.look(float(hull.lines[line].position or 0.0))
        self.ever, self.born, self.gone = set(self.seen.ids), list[str](), list[str]()

    def every(self) -> list[Branch]:
        """Give all branches of all lines."""
        return [branch for some in self.branches.values() for branch in some]

    def events(self) -> list[float]:
        """Give the places of the moving plane at which branches begin or end."""
        return [end for each in self.every() for end in (each.low, each.high)]

    def clear(self, place: float) -> bool:
        """Tell whether no event is close to a place."""
        near = any(abs(end - place) <= CLOSE for end in self.events())
        return not near and not abs(self.neck - place) <= PARTING

    def true(self, place: float) -> set[str]:
        """Name the branches that a plane meets."""
        return {branch.name for branch in self.every() if branch.low < place < branch.high}

    def passing(self, one: float, other: float) -> int:
        """Count the branches that begin and end between two places."""
        low, high = min(one, other), max(one, other)
        return sum(low < each.low and each.high < high for each in self.every())

    def look(self, place: float) -> Seen:
        """Give the branch of every crossing; each true branch has one."""
        found: dict[str, str] = {}
        pieces: dict[str, frozenset[str]] = {}
        for curve in self.hull.lines[self.line].curves:
            mine: set[str] = set()
            for point in curve.points:
                other = point.parent_curve
                if other is not None:
                    name = self.branch(other.line.name, point.position, place)
                    assert name not in found, (place, name, point.id, found[name])
                    found[name] = point.id
                    mine.add(name)
            pieces[curve.id] = frozenset(mine)
        assert set(found) == self.true(place), place
        assert sorted(map(sorted, pieces.values())) == sorted(map(sorted, self.runs(place))), place
        return Seen(place, found, pieces)

    def runs(self, place: float) -> list[set[str]]:
        """Give the branches that a plane meets, piece by piece of its true line."""
        met = [each for each in self.every() if each.low < place < each.high]
        along = {each.name: float(each.where(place)[0]) for each in met}
        if "profile" not in self.branches:
            if place < self.neck:
                return [set(along)]
            apart = on_ring(place, np.array([each.where(place) for each in met]))
            ring = {each.name for each, off in zip(met, apart.tolist(), strict=True) if off}
            return [set(along) - ring, ring]
        ends = sorted(along[each.name] for each in self.branches["profile"] if each in met)
        return [
            {name for name, x in along.items() if first <= x <= last}
            for first, last in zip(ends[::2], ends[1::2], strict=True)
        ]

    def branch(self, line: str, at: FloatArray, place: float) -> str:
        """Name the branch of a line that a crossing is on."""
        alive = [each for each in self.branches[line] if each.low < place < each.high]
        assert alive, (place, line)
        away = [float(np.linalg.norm(each.where(place) - at)) for each in alive]
        assert off_hull(at) < 2.0 * CLOSE, (place, line, at)
        return alive[int(np.argmin(away))].name

    def shift(self, place: float) -> None:
        """Shift the line, and compare what came and went with the truth where that is sure."""
        with self.hull.edit("shift") as edit:
            edit.shift_line(self.line, place)
        assert edit.report is not None
        self.born += edit.report.born
        self.gone += edit.report.gone
        assert not set(edit.report.born) & self.ever
        self.ever |= set(edit.report.born)
        if self.clear(place):
            self.compare(place)

    def compare(self, place: float) -> None:
        """A branch that was there keeps its crossing; one that was not has a new one."""
        before, now = self.seen, self.look(place)
        for name, key in now.crossings.items():
            if name in before.crossings:
                assert key == before.crossings[name], (place, name)
            else:
                assert key in self.born, (place, name)
        for key, heir in heirs(before.pieces, now.pieces).items():
            assert key == heir if heir else key in self.born, (place, key)
        brief = sorted(set(self.born) & set(self.gone))
        assert len(brief) <= self.passing(before.place, place), (place, brief)
        assert (place, sorted(self.born)) == (place, sorted([*(now.ids - before.ids), *brief]))
        assert (place, sorted(self.gone)) == (place, sorted([*(before.ids - now.ids), *brief]))
        self.seen, self.born, self.gone = now, [], []


def off_hull(at: FloatArray) -> float:
    """Give how far a place lies from the true hull, across it (m)."""
    step = 1e-4 * np.array([[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]])
    y = breadth_at(at[0] + step[:, 0], at[2] + step[:, 1])
    slope = np.array([y[1] - y[2], y[3] - y[4]]) / 2e-4
    return float(abs(y[0] - at[1]) / np.sqrt(1.0 + (slope * slope).sum()))


def there_and_back(low: float, high: float, step: float) -> list[float]:
    """Give the places of a line that is shifted up and back in steps (m), without the first."""
    count = round((high - low) / step)
    up = [low + (high - low) * i / count for i in range(count + 1)]
    return [*up[1:], *up[-2::-1]]


def watch(hull: ah.Hull, group: str, places: list[float]) -> Watch:
    """Shift a new line from place to place; undo all at the end."""
    with hull.edit("cut") as edit:
        edit.add_line(group, places[-1], "moved")
    start, watched = hull.fingerprint, Watch(hull, "moved")
    assert watched.clear(min(places))
    assert watched.clear(max(places))
    for place in places:
        watched.shift(place)
    assert hull.check() == ()
    assert hull.verify() == ()
    hull.undo(len(places))
    assert hull.fingerprint == start
    return watched


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The hull in a file: it takes long to make."""
    made = tmp_path_factory.mktemp("bulb") / "bulb.hull.json"
    bulb_hull().save(made)
    return made


@pytest.mark.parametrize(
    ("low", "high", "step"),
    [(4.155, 6.155, 0.5), *([(5.255, 6.105, 0.01)] if LONG else [])],
    ids="{}".format,
)
def test_a_waterline_through_the_neck_and_over_the_bulb(
    path: Path, low: float, high: float, step: float
) -> None:
    """Up and back down: it parts in two, and the forward piece dies at the bulb's top."""
    watched = watch(ah.open(path), "waterlines", there_and_back(low, high, step))
    assert watched.ever, "nothing was born on the way"


@pytest.mark.parametrize(
    ("low", "high", "step"),
    [(0.203, 1.203, 0.5), (0.603, 1.003, 0.01) if LONG else (0.863, 1.003, 0.02)],
    ids=["50 cm", "1 cm" if LONG else "2 cm"],
)
def test_a_buttock_from_the_centre_plane_out_through_the_neck(
    path: Path, low: float, high: float, step: float
) -> None:
    """Out and back: it comes to meet lines in the neck twice more, and parts from a ring."""
    watched = watch(ah.open(path), "buttocks", there_and_back(low, high, step))
    assert watched.ever, "nothing was born on the way"


def raise_bulb(hull: ah.Hull, by: float) -> EditReport:
    """Move the top of the bulb in the centre plane up or down (m)."""
    with hull.edit("raise the bulb", gaps="report") as edit:
        for point in hull.lines["profile"].curves[0].points:
            other = point.parent_curve
            across = other is not None and other.line.group.name == "sections"
            if across and 94.5 < point.x < 97.5 and 5.0 < point.z < 6.1:
                edit.move(point, z=point.z + by, lead=False)
    assert edit.report is not None
    return edit.report


def test_a_profile_that_comes_to_meet_a_waterline_is_told_and_cut_anew_on_a_shift(
    path: Path,
) -> None:
    """The edit makes no piece, says where one is missing; shifting the line bears it."""
    hull = ah.open(path)
    with hull.edit("cut") as edit:
        edit.add_line("waterlines", 6.07, "moved")
    notes = raise_bulb(hull, 0.12).notes
    assert [note.startswith("profile has come to meet the plane of moved") for note in notes] == [
        True,
        True,
    ]
    assert len(hull.lines["moved"].curves) == 1
    with hull.edit("shift") as edit:
        edit.shift_line("moved", 6.06)
    assert len(hull.lines["moved"].curves) == 2
    assert hull.verify() == ()


def test_a_profile_that_leaves_a_piece_without_ends_is_refused(path: Path) -> None:
    """The error names the piece, and the hull is as it was."""
    hull = ah.open(path)
    with hull.edit("cut") as edit:
        edit.add_line("waterlines", 5.97, "moved")
    before = hull.fingerprint
    with pytest.raises(ah.errors.RefusedEditError, match=r"moved \[2\] has no end any more"):
        raise_bulb(hull, -0.08)
    assert hull.fingerprint == before


@pytest.mark.parametrize("breadth", [0.2603, 0.303, 0.803, 0.93, 0.98, 1.2, 1.4])
def test_a_buttock_follows_the_line_of_equal_breadth(path: Path, breadth: float) -> None:
    """The points of its first curve are in the order of the true line; a ring is told."""
    hull = ah.open(path)
    with hull.edit("cut") as edit:
        edit.add_line("buttocks", breadth, "moved")
    true = contour(breadth)
    curve = hull.lines["moved"].curves[0]
    at = [int(np.hypot(*(true - point.position[::2]).T).argmin()) for point in curve.defining]
    assert at == sorted(at)
    assert edit.report is not None
    rings = [note for note in edit.report.notes if "a ring of" in note]
    assert len(rings) == len(hull.lines["moved"].curves) - 1 == int(breadth > neck())
