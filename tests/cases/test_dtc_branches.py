"""Branch identity on a real hull: lines of the DTC shifted through its bulb and its bossing.

The truth is the path of every meeting in steps of 1 mm (`net_branches`), along which it can
be followed without doubt. Shifts of 1, 10 and 50 cm must attach each crossing to the branch
that this path leads to. The steps of 50 cm go along the whole ranges, those of 10 cm where many
events are, those of 1 cm where they are closest together; ``ASSOC_HULL_LONG=1`` takes all along
the whole ranges, and the shifts also in steps of 1 mm round every event, in a quarter of an hour.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest

import assoc_hull as ah
from tests.cases.net_watch import CLOSE, NetWatch

LONG = os.environ.get("ASSOC_HULL_LONG") == "1"

RANGES = {
    "bulb": ("waterlines", 12.003, 15.203),
    "bossing": ("waterlines", 3.003, 7.003),
    "buttock": ("buttocks", 0.503, 4.503),
}
"""Group and range (m); by 3 mm beside the planes that other lines have."""

WITHIN = {
    0.5: RANGES,
    0.1: {
        "bulb": ("waterlines", 13.403, 14.603),
        "bossing": ("waterlines", 4.003, 5.003),
        "buttock": ("buttocks", 3.003, 4.003),
    },
    0.01: {
        "bulb": ("waterlines", 14.093, 14.253),
        "bossing": ("waterlines", 5.803, 6.003),
        "buttock": ("buttocks", 2.103, 2.223),
    },
}
"""For each step: the range on its own, some of its 12, 7 and 25 events, the closest of them."""


@pytest.fixture(scope="module")
def path(dtc: ah.Hull, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The hull in a file: what is tried here stays here."""
    made = tmp_path_factory.mktemp("dtc") / "dtc.hull.json"
    dtc.save(made)
    return made


def steps(low: float, high: float, step: float) -> list[float]:
    """Give places (m) from low up to high and back; the last step up may be a short one."""
    up = [low + step * i for i in range(round((high - low) / step + 0.499))]
    return [*up[1:], high, *up[::-1]]


def watch(path: Path, where: str, places: list[float]) -> NetWatch:
    """Shift a new line from place to place; say how it went; undo all at the end."""
    hull, (group, low, high) = ah.open(path), RANGES[where]
    with hull.edit("cut") as edit:
        edit.add_line(group, places[-1], "moved")
    start, watched = hull.fingerprint, NetWatch(hull, "moved", low, high)
    for place in places:
        watched.shift(place)
    print(f"\n{where}: {dict(watched.count)}, {len(watched.wrong)} wrong, {watched.off:.1e} m off")
    assert hull.check() == ()
    assert hull.verify() == ()
    assert sum(len(each.born) for each in hull.history[-len(places) :]) >= watched.count["births"]
    hull.undo(len(places))
    assert hull.fingerprint == start
    return watched


@pytest.mark.parametrize("step", [0.5, 0.1, 0.01], ids=["50 cm", "10 cm", "1 cm"])
@pytest.mark.parametrize("where", list(RANGES))
def test_no_crossing_is_attached_wrongly_against_the_path_of_1_mm(
    path: Path, where: str, step: float
) -> None:
    """There and back: every crossing keeps its branch, and every branch its crossing."""
    low, high = (RANGES if LONG else WITHIN[step])[where][1:]
    watched = watch(path, where, steps(low, high, step))
    assert watched.wrong == []
    assert watched.off < CLOSE


if LONG:

    @pytest.mark.parametrize("where", list(RANGES))
    def test_in_steps_of_1_mm_round_every_event_none_is_either(path: Path, where: str) -> None:
        """There and back over 1 cm on either side of every birth and death, by leaps between."""
        group, low, high = RANGES[where]
        hull = ah.open(path)
        with hull.edit("cut") as edit:
            edit.add_line(group, low, "moved")
        around = [
            round(event + 1e-3 * i, 4)
            for event in NetWatch(hull, "moved", low, high).events(low, high)
            for i in range(-10, 11)
        ]
        up = sorted({place for place in around if low < place < high})
        watched = watch(path, where, [low, *up, high, *up[::-1], low][1:])
        assert watched.wrong == []
