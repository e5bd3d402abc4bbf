"""Branch identity against a known truth: which meeting is which while a line is shifted.

The hull has a valley amidships, so a buttock meets a waterline at two places or at four:
outside and inside of either hump. The true branches follow from the formula of the hull.
Steps of 1 cm are for long runs.
"""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from tests.cases.valley import LENGTH, breadth_at, valley_hull
from tests.long_forms import LONG

LOW, LAST, HIGH = 2.2, 2.7, 3.3
"""Half-breadths (m): before the first two branches meet, past the last, and far past it."""
LEVELS = tuple(float(z) for z in np.linspace(0.0, 8.0, 9)[2:-1])


def true_branches(level: float, breadth: float) -> set[str]:
    """Name the places where the formula has a half-breadth at a height."""
    x = np.linspace(0.0, LENGTH, 40001)
    inside = breadth_at(x, np.full(len(x), level)) > breadth
    if not inside.any():
        return set()
    both = {"aft outer", "forward outer"}
    return both if inside[20000] else both | {"aft inner", "forward inner"}


def branch(point: ah.Point, level: float) -> str:
    """Name the branch a crossing is on, by its place and the slope of the formula there."""
    x = np.array([point.x - 1e-4, point.x + 1e-4])
    y = breadth_at(x, np.full(2, level))
    end = "aft" if point.x < LENGTH / 2.0 else "forward"
    rising = bool(y[1] > y[0])
    return f"{end} {'outer' if rising == (end == 'aft') else 'inner'}"


def present(hull: ah.Hull) -> dict[str, tuple[float, str]]:
    """Give the live crossings of the buttock with waterlines: id -> (height, branch)."""
    found: dict[str, tuple[float, str]] = {}
    for curve in hull.lines["BTK"].curves:
        for point in curve.points:
            other = point.parent_curve
            if other is not None and other.line.group.name == "waterlines":
                height = float(other.line.position or 0.0)
                found[point.id] = (height, branch(point, height))
    return found


def clear_of_merging(breadth: float) -> bool:
    """Tell whether no waterline is within 2 mm of touching the buttock's plane."""
    middle = breadth_at(np.full(len(LEVELS), LENGTH / 2.0), np.array(LEVELS))
    return bool(np.abs(middle - breadth).min() > 2e-3)


STEPS = {"50 cm": (0.5, HIGH), "3 cm": (0.03, LAST), **({"1 cm": (0.01, LAST)} if LONG else {})}


@pytest.mark.parametrize(("step", "high"), STEPS.values(), ids=STEPS)
def test_no_crossing_changes_its_branch_and_births_and_deaths_are_the_true_ones(
    step: float, high: float
) -> None:
    """Out and back: an id keeps its branch for life, a dead one never comes back."""
    hull = valley_hull(LOW)
    before = hull.fingerprint
    count = max(1, round((high - LOW) / step))
    out = [LOW + (high - LOW) * i / count for i in range(1, count + 1)]
    places = [p for p in [*out, *out[-2::-1]] if clear_of_merging(p)]
    life = dict(present(hull))
    alive, dead = set(life), set[str]()
    for place in places:
        with hull.edit("shift") as edit:
            edit.shift_line("BTK", place)
        now = present(hull)
        assert {(z, b) for z, b in now.values()} == {
            (z, b) for z in LEVELS for b in true_branches(z, place)
        }
        assert not dead & set(now)
        for key, where in now.items():
            assert life.setdefault(key, where) == where
        report = edit.report
        assert report is not None
        assert set(now) - alive <= set(report.born)
        assert alive - set(now) <= set(report.gone)
        dead |= alive - set(now)
        alive = set(now)
    assert hull.check() == ()
    assert hull.verify() == ()
    hull.undo(len(places))
    assert hull.fingerprint == before


def test_births_and_deaths_are_as_few_as_the_truth_has() -> None:
    """An engine that gives every meeting a new id would fail: the outer ones keep theirs."""
    hull = valley_hull(LOW)
    start = {key: where for key, where in present(hull).items() if "outer" in where[1]}
    with hull.edit("shift") as edit:
        edit.shift_line("BTK", HIGH)
    left = present(hull)
    lasting = {key for key, (z, b) in start.items() if b in true_branches(z, HIGH)}
    assert lasting <= set(left)


def test_a_buttock_over_the_valley_has_two_curves_and_one_below_it() -> None:
    """The piece that keeps most crossings keeps the curve's id; a merged one dies for good."""
    hull = valley_hull(LOW)
    first = hull.lines["BTK"].curves[0].id
    with hull.edit("out") as edit:
        edit.shift_line("BTK", HIGH)
    assert len(hull.lines["BTK"].curves) == 2
    assert first in {curve.id for curve in hull.lines["BTK"].curves}
    born = {curve.id for curve in hull.lines["BTK"].curves} - {first}
    assert edit.report is not None
    assert born <= set(edit.report.born)
    with hull.edit("back") as edit:
        edit.shift_line("BTK", LOW)
    assert [curve.id for curve in hull.lines["BTK"].curves] == [first]
    assert edit.report is not None
    assert born <= set(edit.report.gone)
    with hull.edit("out again") as edit:
        edit.shift_line("BTK", HIGH)
    assert not born & {curve.id for curve in hull.lines["BTK"].curves}
