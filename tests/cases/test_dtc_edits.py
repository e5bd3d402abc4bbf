"""Edits on the DTC at 24 seeded places a kind, 48 in the long form: a table; and a long session."""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from tests.cases import places
from tests.long_forms import LONG
from tests.properties.test_i01_consistency import assert_consistent

EVERY = 1 if LONG else 24
PLACES = 48 if LONG else 24
SEED = 1
REACH = (20.0, 8.0)
"""How far pulls reach and re-shapes fade, along the length and the girth, m."""

LEAST_ACCEPTED = {
    "drag 5 mm": 46, "drag 20 mm": 44, "drag 50 mm": 40, "pull 20 mm": 47, "pull 50 mm": 45,
    "re-shape 20 mm": 47, "re-shape 50 mm": 44,
}  # fmt: skip
MOST_INFLECTIONS = {
    "drag 5 mm": 2.0, "drag 20 mm": 4.0, "drag 50 mm": 6.0, "pull 20 mm": 3.0, "pull 50 mm": 6.0,
    "re-shape 20 mm": 2.0, "re-shape 50 mm": 5.0,
}  # fmt: skip
"""In the mean over the accepted edits of a kind, of all curves of the ship together."""


def _cases(hull: ah.Hull, at: list[int]) -> dict[str, places.Act]:
    """Drags are pinned; re-shapes take the three families turn about."""
    acts: dict[str, tuple[tuple[float, ...], Callable[[float], places.Act]]] = {
        "drag": ((0.005, 0.02, 0.05), lambda amount: places.drag(hull, amount)),
        "pull": ((0.02, 0.05), lambda amount: places.pull(hull, amount, REACH)),
        "re-shape": (
            (0.02, 0.05),
            lambda amount: places.reshape_mixed(hull, at, amount, REACH),
        ),
    }
    return {
        f"{kind} {1e3 * amount:.0f} mm": act(amount)
        for kind, (amounts, act) in acts.items()
        for amount in amounts
    }


@pytest.fixture(scope="module")
def table(dtc: ah.Hull) -> list[places.Row]:
    """Run every kind of edit at its places; I6 at some of them, in the long form I1 and I6 at all.

    Undo brings the old hull back to the bit, I7.
    """
    before, at = dtc.fingerprint, places.places(dtc, places.PAIRS, PLACES, SEED)

    def check(number: int) -> None:
        if number % EVERY == 0:
            assert dtc.verify() == ()
        if LONG:
            assert_consistent(dtc)

    rows = [places.run(dtc, kind, act, at, check) for kind, act in _cases(dtc, at).items()]
    assert dtc.fingerprint == before
    print(places.table(rows))
    return rows


def test_the_places_are_of_all_pairs_and_at_the_ends(dtc: ah.Hull) -> None:
    """A third of each pair of families, and each family re-shaped at a third of the places."""
    at = np.array(places.places(dtc, places.PAIRS, PLACES, SEED))
    for pair in places.PAIRS:
        mine = np.intersect1d(places.shared_rows(dtc, pair), at)
        assert len(mine) == PLACES // 3
        assert places.at_ends(dtc, mine).any()
    turn = np.arange(PLACES) % 2
    names = [places.family(dtc, c) for c in dtc.state.rows.curve[at, turn].tolist()]
    assert {name: names.count(name) for name in names} == dict.fromkeys(names, PLACES // 3)


def test_most_edits_of_each_kind_are_accepted(table: list[places.Row]) -> None:
    """Tried at shared crossings, each from the adopted hull; the limits are counts of 48."""
    assert [row.places for row in table] == [PLACES] * len(LEAST_ACCEPTED)
    part = {row.kind: row.accepted / PLACES for row in table}
    assert {kind: each for kind, each in part.items() if each < LEAST_ACCEPTED[kind] / 48} == {}


def test_no_edit_folds_a_curve(table: list[places.Row]) -> None:
    """Counted on every re-lofted curve after each accepted edit."""
    assert {row.kind: row.folds for row in table if row.folds} == {}


def test_no_accepted_edit_leaves_a_gap_over_its_limit(table: list[places.Row]) -> None:
    """Each watched crossing has a limit of its own; it was set at adoption."""
    assert {row.kind: row.wide for row in table if row.wide} == {}


def test_edits_add_few_inflections(table: list[places.Row]) -> None:
    """Lobes of 0.2 degrees and more; curves that lose some do not make up for others."""
    most = MOST_INFLECTIONS
    found = {row.kind: row.inflections for row in table if row.inflections > most[row.kind]}
    assert found == {}


PULLS = 200
LAST = 50


@attrs.frozen
class Session:
    """How a session of pulls went.

    Attributes
    ----------
    accepted : list of bool
        Of every pull that was tried.
    part : float
        The largest watched gap after the last one, as a part of its limit.
    largest : float, m
        The largest watched gap after any of them.
    """

    accepted: list[bool]
    part: float
    largest: float


@pytest.fixture(scope="module")
def session(dtc: ah.Hull) -> Session:
    """Pull the hull 200 times by 20 to 50 mm, outward or inward, at any shared crossing."""
    rng, before, largest = np.random.default_rng(SEED), dtc.fingerprint, 0.0
    accepted: list[bool] = []
    while accepted.count(True) < PULLS and len(accepted) < 2 * PULLS:
        rows = np.concatenate([places.shared_rows(dtc, pair) for pair in places.PAIRS])
        row, amount = int(rng.choice(rows)), rng.uniform(0.02, 0.05) * rng.choice((-1.0, 1.0))
        try:
            with dtc.edit("pull") as edit:
                places.pull(dtc, float(amount), REACH)(edit, row)
        except ah.errors.RefusedEditError:
            accepted.append(False)
            continue
        assert edit.report is not None
        accepted.append(True)
        largest = max(largest, edit.report.largest_gap)
    part = _largest_part(dtc)
    dtc.undo(accepted.count(True))
    assert dtc.fingerprint == before
    print(f"\n{len(accepted)} pulls tried, {accepted.count(False)} refused", end=", ")
    print(f"{accepted[-LAST:].count(False)} of the last {LAST}; gap {1e3 * largest:.2f} mm")
    return Session(accepted, part, largest)


def _largest_part(hull: ah.Hull) -> float:
    """Give the largest watched gap of all, as a part of its limit."""
    rows = hull.state.rows
    watched = rows.alive.data & np.isfinite(rows.gap.data)
    return float((rows.gap[watched] / rows.limit[watched]).max())


def test_gaps_do_not_drift_over_200_pulls(session: Session) -> None:
    """Limits are absolute, so many small edits cannot widen a gap."""
    assert session.accepted.count(True) == PULLS
    assert session.part <= 1.0


def test_the_hull_stays_workable_over_200_pulls(session: Session) -> None:
    """Fewer than 5 % of the last 50 are refused."""
    assert session.accepted[-LAST:].count(False) < 0.05 * LAST
