"""Associations switched one-way on three hulls: bits, roles, there and back, leads of the driver.

``python -m benchmarks.switches [--ship carrier|dtc|series60] [--leads 40]`` switches every pair of
groups in both directions, unless that makes a ring, and counts the curves that keep their bits and
the crossings that are watched and were not; it switches back, parts the pair and joins it one-way,
and leads lines of the driver. After each lead all driven crossings must lie on both their curves.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Iterator, Sequence

import attrs
import numpy as np

import assoc_hull as ah
from assoc_hull.errors import AssocHullError, RingError
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.tables import HullState
from benchmarks.clock import Figure
from benchmarks.leads import SHIPS, intervals

__all__ = ["Pair", "figures", "main", "measure"]

GOALS = {
    ("series60", "waterlines", "sections"): 150, ("series60", "sections", "waterlines"): 0,
    ("carrier", "waterlines", "sections"): 4, ("carrier", "sections", "waterlines"): 0,
}  # fmt: skip
"""So many crossings at most may come to be watched."""

_NAMES = ("series60", "carrier", "dtc")
_AMOUNTS = (0.005, 0.02, 0.05)
_EXACT = 1e-9
_EVERY = 10
"""Every so many leads the hull is made again from its definition."""


@attrs.define
class Pair:
    """What a switch did: curves that kept their bits of all, crossings watched more than before.

    `off` is the farthest that a driven crossing lay off a curve of it after a lead, m.
    """

    ship: str
    giver: str
    taker: str
    ring: str = ""
    kept: int = 0
    curves: int = 0
    loose: int = 0
    back: bool = False
    rejoined: bool = False
    leads: int = 0
    refused: int = 0
    off: float = 0.0
    verified: bool = True

    @property
    def name(self) -> str:
        """What was switched."""
        return f"{self.ship}, {self.giver} -> {self.taker}"

    def __str__(self) -> str:
        if self.ring:
            return f"{self.name}: refused, {self.ring}"
        goal = GOALS.get((self.ship, self.giver, self.taker))
        said = f" (at most {goal})" if goal is not None else ""
        return (
            f"{self.name}: {self.kept} of {self.curves} curves keep their bits, {self.loose} more "
            f"crossings watched{said}, there and back {_word(self.back)}, parted and joined "
            f"{_word(self.rejoined)}; {self.leads} leads of the driver, {self.refused} refused, "
            f"driven crossings off by {self.off:.1e} m at most, rebuilt {_word(self.verified)}"
        )


def _word(holds: bool) -> str:
    return "the same" if holds else "OTHER"


def measure(ship: str, hull: ah.Hull, leads: int) -> Iterator[Pair]:
    """Switch every pair of groups."""
    for link in hull.state.associations:
        if "boundary" not in (link.a, link.b):
            for giver, taker in ((link.a, link.b), (link.b, link.a)):
                found = Pair(ship, giver, taker)
                _switch(hull, found, leads)
                yield found


def _switch(hull: ah.Hull, pair: Pair, leads: int) -> None:
    first, shapes, roles = hull.fingerprint, _shapes(hull.state), _roles(hull.state)
    try:
        with hull.edit("one way") as edit:
            edit.associate(pair.giver, pair.taker, two_way=False)
    except RingError as error:
        pair.ring = str(error)
        return
    now, then = _shapes(hull.state), _roles(hull.state)
    pair.curves, pair.kept = len(shapes), sum(now[key] == shape for key, shape in shapes.items())
    pair.loose = sum(then[key] is Role.WATCHED is not role for key, role in roles.items())
    _lead(hull, pair, leads)
    with hull.edit("both ways") as edit:
        edit.associate(pair.giver, pair.taker)
    pair.back = hull.fingerprint == first
    hull.undo(2)
    with hull.edit("parted") as edit:
        edit.dissociate(pair.giver, pair.taker)
    with hull.edit("joined") as edit:
        edit.associate(pair.giver, pair.taker, two_way=False)
    pair.rejoined = _by_pair(_roles(hull.state)) == _by_pair(then)
    pair.rejoined &= _shapes(hull.state) == shapes
    hull.undo(2)
    assert hull.fingerprint == first, "it was undone to the bit"


def _shapes(state: HullState) -> dict[str, bytes]:
    found = {}
    for curve in state.live("curves").tolist():
        spline = state.spline(curve)
        parts = spline.knot, spline.xyz, spline.leave, spline.arrive
        found[state.curves.key[curve]] = b"".join(each.tobytes() for each in parts)
    return found


def _roles(state: HullState) -> dict[str, Role]:
    table = state.rows
    rows = np.flatnonzero(table.alive.data & (table.sort.data == Sort.CROSSING)).tolist()
    return {str(table.key[row]): Role(int(table.role[row])) for row in rows}


def _by_pair(roles: dict[str, Role]) -> Counter[tuple[str, Role]]:
    """Count roles by pair of lines: who comes later has another number."""
    return Counter((key.rpartition(" ")[0], role) for key, role in roles.items())


def _lead(hull: ah.Hull, pair: Pair, leads: int) -> None:
    """Lead lines of the driver, each on the hull as it was switched."""
    state, rng = hull.document.state, np.random.default_rng(1)
    drawn, first = list(intervals(state, pair.giver)), hull.fingerprint
    if not drawn:
        return
    for turn in range(leads):
        curve, at = drawn[int(rng.integers(len(drawn)))]
        handle = next(c for line in hull.lines.values() for c in line.curves if c.number == curve)
        across = np.cross(state.lines.normal[state.line_of(curve)], handle.tangent(at))
        amount = _AMOUNTS[turn % 3] * float(rng.choice([-1.0, 1.0]))
        goal = np.array(handle.at(at)) + amount * across / np.sqrt((across * across).sum())
        pair.leads += 1
        try:
            with hull.edit("lead") as edit:
                edit.lead(state.curves.key[curve], [goal])
        except AssocHullError:
            pair.refused += 1
            continue
        pair.off = max(pair.off, _off(state))
        if turn % _EVERY == 0:
            pair.verified &= hull.verify() == ()
        hull.undo()
        assert hull.fingerprint == first, "it was undone to the bit"


def _off(state: HullState) -> float:
    """Give how far a driven crossing lies off one of its curves, at most, m."""
    table, most = state.rows, 0.0
    driven = np.flatnonzero(table.alive.data & (table.driver.data >= 0))
    for side in (0, 1):
        on = table.curve.data[driven, side]
        for curve in np.unique(on).tolist():
            places = table.xyz.data[driven[on == curve]]
            most = max(most, float(closest_points(state.spline(curve), 0, places)[2].max()))
    return most


def figures(quick: bool = False) -> list[Figure]:
    """Give what each switch kept."""
    found: list[Figure] = []
    for ship in _NAMES:
        if (hull := SHIPS[ship]()) is None:
            continue
        for each in measure(ship, hull, 4 if quick else 40):
            if each.ring:
                continue
            goal = GOALS.get((ship, each.giver, each.taker))
            same = each.kept == each.curves and each.back and each.rejoined and each.verified
            found += [
                Figure(f"{each.name}: all as before", float(same), "", 1.0, "equal"),
                Figure(f"{each.name}: more watched", float(each.loose), "", goal, "most"),
                Figure(f"{each.name}: driven crossings off", each.off, "m", _EXACT, "most"),
            ]
    return found


def main(arguments: Sequence[str] | None = None) -> int:
    """Print what each switch did."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.switches")
    parser.add_argument("--ship", choices=_NAMES, action="append")
    parser.add_argument("--leads", type=int, default=40)
    chosen = parser.parse_args(arguments)
    for ship in chosen.ship or _NAMES:
        if (hull := SHIPS[ship]()) is None:
            print(f"{ship}: the data folder is not there")
            continue
        for each in measure(ship, hull, chosen.leads):
            print(each, flush=True)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
