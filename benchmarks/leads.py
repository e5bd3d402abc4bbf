"""Random leads on five hulls: how many are taken, and how many leave every line as fair.

``python -m benchmarks.leads [--ship carrier|dtc|series60|180m|225m] [--count 20]`` draws places
half-way between two free points of a waterline, a buttock and a section in turns, by a seed, and
leads the line through a place 5, 20 or 50 mm beside, inwards or outwards, over the stretch that the
edit finds. New sign changes are counted over all lines of the hull, at lobes of .2 degree, against
the hull with a point inserted on the line there; at 1 degree as well. Each is undone to the bit.

Then the last of each family is kept, and the hull is edited 50 times from the lines that cross the
led ones: shared crossings are moved, others are pulled, by 2 mm, each undone. With lines under
other names, a lead gives the same bits. That the order in which lines were made changes none is
shown by ``tests/properties/test_order_of_creation.py``.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from time import process_time

import attrs
import numpy as np

import assoc_hull as ah
from assoc_hull.edit.displacement_field import level_with_flats
from assoc_hull.edit.hull_normals import hull_normals
from assoc_hull.edit.net_battens import fairable_rows
from assoc_hull.edit.step import EditReport
from assoc_hull.errors import AssocHullError, PointRoleError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.model.address import address
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.tables import HullState
from benchmarks.clock import Figure
from benchmarks.fair_edits import sign_changes
from benchmarks.ships import duisburg_test_case

__all__ = ["SHIPS", "Tally", "figures", "intervals", "main", "measure"]

SHIPS: dict[str, Callable[[], ah.Hull | None]] = {
    "carrier": ah.examples.bulk_carrier_207k,
    "dtc": duisburg_test_case,
    "series60": lambda: ah.examples.series60(cb=0.7),
    "180m": ah.examples.bulk_carrier_180m,
    "225m": ah.examples.container_ship_225m,
}
GOALS = {"carrier": 97, "dtc": 95, "series60": 85}
"""Percent of the leads that are to leave all lines without a new sign change."""

_TAKEN = 99
_FAMILIES = ("waterlines", "buttocks", "sections")
_AMOUNTS = (0.005, 0.02, 0.05)
_APART = 0.3
"""m, at least, between the two points."""

_EXACT = 1e-9

_AFTER, _STEP = 50, 0.002
"""So many edits from crossing lines, m each."""


@attrs.define
class Tally:
    """What the leads of one hull did.

    Attributes
    ----------
    leads : int
        How many were asked for.
    refused : list of str
        Why some were refused.
    gained, count : list of int
        By lobe: leads with a new sign change, and how many came.
    off, apart : float, m
        The farthest that a led line passed its place, and that a shared crossing lay off it.
    driven, watched : float
        Driven crossings of led lines: the farthest that one lay off the line, m; watched ones: how
        much of its limit a gap had at most.
    faults : int
        Leads with another role, or a finding, afterwards.
    kinds : Counter
        Crossings of led lines that followed, by role.
    gap : float, m
        The largest gap.
    edits, for_role, other : int
        Edits from crossing lines afterwards, and those refused for a role and otherwise.
    named : bool
        Whether other names changed no bit.
    """

    leads: int = 0
    refused: list[str] = attrs.field(factory=list)
    gained: list[int] = attrs.field(factory=lambda: [0, 0])
    count: list[int] = attrs.field(factory=lambda: [0, 0])
    off: float = 0.0
    apart: float = 0.0
    driven: float = 0.0
    watched: float = 0.0
    faults: int = 0
    kinds: Counter[str] = attrs.field(factory=Counter)
    gap: float = 0.0
    milliseconds: list[float] = attrs.field(factory=list)
    edits: int = 0
    for_role: int = 0
    other: int = 0
    named: bool = True
    refused_after: Counter[str] = attrs.field(factory=Counter)

    @property
    def taken(self) -> int:
        """Leads that were carried out."""
        return self.leads - len(self.refused)

    def share(self, count: int) -> float:
        """Give a number of leads in percent of all."""
        return 100.0 * count / max(self.leads, 1)

    def lines(self, name: str) -> Iterator[str]:
        """Say it."""
        fair = self.taken - self.gained[0]
        goal = f" (goal {GOALS[name]})" if name in GOALS else ""
        every = max(sum(self.kinds.values()), 1)
        kinds = ", ".join(
            f"{kind} {100 * n / every:.0f} %" for kind, n in sorted(self.kinds.items())
        )
        median = float(np.median(self.milliseconds)) if self.milliseconds else 0.0
        yield (
            f"{name}: {self.leads} leads, {self.share(self.taken):.0f} % taken (goal {_TAKEN}), "
            f"{self.share(fair):.0f} % without a new sign change{goal}; {self.count[0]} new ones, "
            f"at 1 degree {self.gained[1]} leads gained {self.count[1]}"
        )
        yield (
            f"  off the led line: asked points {self.off:.1e} m, shared crossings {self.apart:.1e}"
            f" m, driven {self.driven:.1e} m (goal {_EXACT:g}); watched at most "
            f"{100 * self.watched:.0f} % of their limit; largest gap {1e3 * self.gap:.2f} mm"
        )
        yield (
            f"  followed: {kinds}; {self.faults} leads with another role or a finding; "
            f"median {median:.0f} ms"
        )
        yield (
            f"  then {self.edits} edits from crossing lines: {self.for_role} refused for a role, "
            f"{self.other} for something else; other names: "
            f"{'the same bits' if self.named else 'OTHER BITS'}"
        )
        for why, count in Counter(self.refused).items():
            yield f"  refused {count}: {why[:150]}"
        for why, count in self.refused_after.items():
            yield f"  afterwards refused {count}: {why}"


def measure(hull: ah.Hull, count: int, seed: int = 1) -> Tally:
    """Lead lines, each on the hull as it was."""
    state, rng, found = hull.document.state, np.random.default_rng(seed), Tally()
    first = hull.fingerprint
    drawn = {family: list(intervals(state, family)) for family in _FAMILIES}
    families = [family for family in _FAMILIES if drawn[family]]
    last: dict[str, tuple[int, FloatArray]] = {}
    for turn in range(count):
        family = families[turn % len(families)]
        curve, place = drawn[family][int(rng.integers(len(drawn[family])))]
        amount = _AMOUNTS[turn // len(families) % 3] * float(rng.choice([-1.0, 1.0]))
        goal = _lead(hull, curve, place, amount, found)
        assert hull.fingerprint == first, "it was undone to the bit"
        if goal is not None:
            last[family] = curve, goal
    found.named = _same_under_other_names(hull, list(last.values()))
    _edit_from_crossing_lines(hull, list(last.values()), rng, found)
    return found


def _same_under_other_names(hull: ah.Hull, leads: list[tuple[int, FloatArray]]) -> bool:
    """Tell whether leads give the bits that they give where all lines have other names."""
    state, keys = hull.document.state, hull.document.state.curves.key
    bits = []
    for named in (False, True):
        done = len(hull.history)
        if named:
            with hull.edit("other names") as edit:
                for turn, line in enumerate(list(hull.lines.values())):
                    edit.rename(line, f"L{len(hull.lines) - turn}")
        for curve, goal in leads:
            with hull.edit("lead") as edit:
                edit.lead(str(keys[curve]), [goal])
        live = state.live("rows")
        bits.append((str(sorted(keys.data)), np.sort(state.rows.xyz.data[live], axis=0).tobytes()))
        hull.undo(len(hull.history) - done)
    return bits[0] == bits[1]


def _edit_from_crossing_lines(
    hull: ah.Hull, leads: list[tuple[int, FloatArray]], rng: np.random.Generator, tally: Tally
) -> None:
    """Keep the leads, and edit their crossings from the lines that cross, each undone."""
    state, done = hull.document.state, len(hull.history)
    rows = list[int]()
    for curve, goal in leads:
        with hull.edit("lead") as edit:
            edit.lead(str(state.curves.key[curve]), [goal])
        assert edit.report is not None
        followed = {key for led in edit.report.led for key, _ in led.crossings}
        table = state.rows
        rows += [row for row in state.live("rows").tolist() if str(table.key[row]) in followed]
    for row in rng.choice(rows, _AFTER) if rows else ():
        point = address(state, int(row))
        shared = state.rows.role[int(row)] == Role.SHARED
        tally.edits += 1
        try:
            with hull.edit("from a crossing line") as edit:
                if shared:
                    way = np.eye(3)["xyz".index(hull.points[point].free[0])]
                    edit.move(point, by=_STEP * way)
                else:
                    edit.pull(point, _STEP)
        except PointRoleError:
            tally.for_role += 1
        except AssocHullError as error:
            tally.other += 1
            tally.refused_after[str(error)[:150]] += 1
        else:
            hull.undo()
    hull.undo(len(hull.history) - done)


def intervals(state: HullState, family: str) -> Iterator[tuple[int, float]]:
    """Give the curves of a family, and the middles between two free points of each."""
    free = fairable_rows(state)
    free = free[~level_with_flats(state, free, hull_normals(state)[free])]
    for curve in state.live("curves").tolist():
        if state.family(state.line_of(curve)).name != family:
            continue
        rows, knot = state.curves.rows.data[curve], state.spline(curve).knot
        may = np.isin(rows, free)
        for place in np.flatnonzero(may[:-1] & may[1:] & (np.diff(knot) > _APART)).tolist():
            yield curve, 0.5 * float(knot[place] + knot[place + 1])


def _lead(hull: ah.Hull, curve: int, at: float, amount: float, tally: Tally) -> FloatArray | None:
    """Lead a line, look at what came of it, and undo it; None if it is refused."""
    state = hull.document.state
    key = state.curves.key[curve]
    handle = next(
        each for line in hull.lines.values() for each in line.curves if each.number == curve
    )
    foot, along = np.array(handle.at(at)), np.array(handle.tangent(at))
    across = np.cross(state.lines.normal[state.line_of(curve)], along)
    goal: FloatArray = foot + amount * across / np.sqrt((across * across).sum())
    with hull.edit("on the line") as edit:
        edit.insert(key, foot)
    before, roles = sign_changes(state), state.rows.role.data.astype(np.int64)
    hull.undo()
    tally.leads += 1
    begin = process_time()
    try:
        with hull.edit("lead") as edit:
            edit.lead(key, [goal])
    except AssocHullError as error:
        tally.refused.append(f"{key}: {error}")
        return None
    tally.milliseconds.append(1e3 * (process_time() - begin))
    assert edit.report is not None
    _count(hull, curve, goal, before, roles, edit.report, tally)
    hull.undo()
    return goal


def _count(
    hull: ah.Hull, curve: int, goal: FloatArray, before: dict[str, tuple[int, int]],
    roles: IntArray, report: EditReport, tally: Tally,
) -> None:  # fmt: skip
    state, table = hull.document.state, hull.document.state.rows
    now = sign_changes(state)
    for lobe in range(2):
        more = sum(max(now[key][lobe] - was[lobe], 0) for key, was in before.items() if key in now)
        tally.count[lobe] += more
        tally.gained[lobe] += more > 0
    spline = state.spline(curve)
    rows = state.curves.rows.data[curve]
    shared = rows[(table.sort.data[rows] == Sort.CROSSING) & (table.role.data[rows] == Role.SHARED)]
    places = np.concatenate([goal[None], table.xyz.data[shared]])
    away = closest_points(spline, 0, places)[2]
    tally.off = max(tally.off, float(away[0]))
    tally.apart = max(tally.apart, float(away[1:].max(initial=0.0)))
    same = min(len(roles), len(table.role.data))
    crossing = table.alive.data[:same] & (table.sort.data[:same] == Sort.CROSSING)
    other = (table.role.data[:same] != roles[:same])[crossing].any()
    # A line that is led leaves its definitions, as with any edit of its shape.
    finding = any(each.kind != "detached" for each in hull.check())
    tally.faults += bool(other or finding)
    tally.gap = max(tally.gap, report.largest_gap)
    here = np.flatnonzero(crossing & (table.curve.data[:same] == curve).any(axis=1))
    role = table.role.data[here]
    driven = here[(role != Role.SHARED) & (role != Role.WATCHED)]
    if len(driven):
        beside = closest_points(spline, 0, table.xyz.data[driven])[2]
        tally.driven = max(tally.driven, float(beside.max()))
    watched = here[role == Role.WATCHED]
    part = np.nan_to_num(table.gap.data[watched] / table.limit.data[watched])
    tally.watched = max(tally.watched, float(part.max(initial=0.0)))
    numbers = {str(table.key[row]): row for row in np.flatnonzero(crossing).tolist()}
    tally.kinds.update(
        Role(int(table.role[numbers[key]])).text for led in report.led for key, _ in led.crossings
    )


def figures(quick: bool = False) -> list[Figure]:
    """Give the shares of leads that are taken and that stay fair."""
    found: list[Figure] = []
    for name, make in SHIPS.items():
        hull = make()
        if hull is None:
            continue
        told = measure(hull, 6 if quick else 40)
        fair = told.share(told.taken - told.gained[0])
        found += [
            Figure(f"{name}: leads taken", told.share(told.taken), "%", _TAKEN),
            Figure(f"{name}: without a new sign change", fair, "%", GOALS.get(name)),
            Figure(f"{name}: farthest off", max(told.off, told.apart), "m", _EXACT, "most"),
        ]
    return found


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the tallies."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.leads")
    parser.add_argument("--ship", choices=tuple(SHIPS), action="append")
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    chosen = parser.parse_args(arguments)
    for name in chosen.ship or SHIPS:
        hull = SHIPS[name]()
        if hull is None:
            print(f"{name}: the data folder is not there")
            continue
        for line in measure(hull, chosen.count, chosen.seed).lines(name):
            print(line, flush=True)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
