"""Branch identity on a real hull: lines of the DTC shifted through its bulb and its bossing.

The truth is the path of every meeting in steps of 1 mm (`net_branches`), along which it can
be followed without doubt. Shifts of 50 cm through the bulb must attach each crossing to the branch
that this path leads to. `make test-long` goes along all ranges, in steps of 10 and 1 cm as well,
and in steps of 1 mm round every event, in a quarter of an hour. Fine steps are always taken through
the bulb of a hull whose function is known (`test_bulb_branches`).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import pytest

import assoc_hull as ah
from tests.cases.net_branches import branches_of_net
from tests.cases.net_watch import AXIS, CLOSE, NetWatch, events
from tests.cases.true_branches import Branch
from tests.long_forms import LONG
from tests.taken_back import taken_back

RANGES = {
    "bulb": ("waterlines", 12.003, 15.203),
    "bossing": ("waterlines", 3.003, 7.003),
    "buttock": ("buttocks", 0.503, 4.503),
}
"""Group and range (m); by 3 mm beside the planes that other lines have."""

STEPS = [(step, where) for step in (0.5, 0.1, 0.01) for where in RANGES]
if not LONG:
    STEPS = [(0.5, "bulb")]


Truth = Callable[[str], dict[str, list[Branch]]]


@pytest.fixture(scope="module")
def truth(dtc: ah.Hull) -> Truth:
    """The path along each range, followed once: every watch takes its shifts back."""
    start = dtc.fingerprint

    @cache
    def follow(where: str) -> dict[str, list[Branch]]:
        assert dtc.fingerprint == start
        group, low, high = RANGES[where]
        return branches_of_net(dtc, group, AXIS[group], low, high)

    return follow


def steps(low: float, high: float, step: float) -> list[float]:
    """Give places (m) from low up to high and back; the last step up may be a short one."""
    up = [low + step * i for i in range(round((high - low) / step + 0.499))]
    return [*up[1:], high, *up[::-1]]


def watch(
    hull: ah.Hull, where: str, truth: dict[str, list[Branch]], places: list[float]
) -> NetWatch:
    """Shift a new line from place to place; say how it went; undo all at the end."""
    with hull.edit("cut") as edit:
        edit.add_line(RANGES[where][0], places[-1], "moved")
    start, watched = hull.fingerprint, NetWatch(hull, "moved", truth)
    for place in places:
        watched.shift(place)
    print(f"\n{where}: {dict(watched.count)}, {len(watched.wrong)} wrong, {watched.off:.1e} m off")
    assert hull.check() == ()
    assert hull.verify() == ()
    assert sum(len(each.born) for each in hull.history[-len(places) :]) >= watched.count["births"]
    hull.undo(len(places))
    assert hull.fingerprint == start
    return watched


@pytest.mark.parametrize(("step", "where"), STEPS, ids=[f"{w}-{s} m" for s, w in STEPS])
def test_no_crossing_is_attached_wrongly_against_the_path_of_1_mm(
    dtc: ah.Hull, truth: Truth, where: str, step: float
) -> None:
    """There and back: every crossing keeps its branch, and every branch its crossing."""
    low, high = RANGES[where][1:]
    with taken_back(dtc) as hull:
        watched = watch(hull, where, truth(where), steps(low, high, step))
    assert watched.wrong == []
    assert watched.off < CLOSE


if LONG:

    @pytest.mark.parametrize("where", list(RANGES))
    def test_in_steps_of_1_mm_round_every_event_none_is_either(
        dtc: ah.Hull, truth: Truth, where: str
    ) -> None:
        """There and back over 1 cm on either side of every birth and death, by leaps between."""
        low, high = RANGES[where][1:]
        around = [
            round(event + 1e-3 * i, 4)
            for event in events(truth(where), low, high)
            for i in range(-10, 11)
        ]
        up = sorted({place for place in around if low < place < high})
        with taken_back(dtc) as hull:
            watched = watch(hull, where, truth(where), [low, *up, high, *up[::-1], low][1:])
        assert watched.wrong == []
