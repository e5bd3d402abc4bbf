"""I10: the same shared values give the same bits, whichever way they were set."""

from __future__ import annotations

import random

import attrs
from hypothesis import given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.model.objects import Point
from tests.cases import places
from tests.long_forms import draws
from tests.net_strategies import POOL, fresh, live_points


@attrs.frozen
class Wish:
    """A shared crossing, modulo their number, and how far it is to lie from where it was."""

    which: int
    amount: float


wishes = st.lists(
    st.builds(Wish, st.integers(0, 2**16), st.floats(-0.004, 0.004)), min_size=1, max_size=5
)


def targets(hull: ah.Hull, wanted: list[Wish]) -> dict[str, dict[str, float]]:
    """Give the new coordinates of crossings by key."""
    points = shared(hull)
    chosen = {(point := points[wish.which % len(points)]).id: (point, wish) for wish in wanted}
    return {
        key: {axis: float(getattr(point, axis)) + wish.amount for axis in point.free}
        for key, (point, wish) in chosen.items()
    }


def shared(hull: ah.Hull) -> list[Point]:
    """Give the shared crossings that may be moved, by key.

    Points of features stay where they are: moved by hand they dissolve them, for good.
    """
    owned = {hull.state.rows.key[point] for each in hull.state.features for point in each.points}
    points = [p for p in live_points(hull, "crossing") if p.crossing_role == "shared"]
    return [point for point in points if point.free and point.id not in owned]


def move(hull: ah.Hull, to: dict[str, dict[str, float]], side: int = 0) -> bool:
    """Set values in one edit, through the handles on one side; False if it was not quiet."""
    try:
        with hull.edit("move") as edit:
            for key, value in to.items():
                point = hull.find(key)
                assert isinstance(point, Point)
                handle = point if side == 0 else point.friend_point
                assert handle is not None
                edit.move(handle, lead=False, **value)
    except ah.errors.RefusedEditError:
        return False
    report = edit.report
    assert report is not None
    return not (report.born or report.gone or report.mended)


def one_by_one(hull: ah.Hull, to: dict[str, dict[str, float]], rng: random.Random) -> bool:
    """Set values in edits of their own, in any order, through any handle, with detours."""
    keys = sorted(to)
    rng.shuffle(keys)
    quiet = True
    for key in keys:
        for part in rng.sample((0.3, -0.7, 1.4), rng.randrange(3)):
            away = {axis: value + 0.002 * part for axis, value in to[key].items()}
            quiet &= move(hull, {key: away}, rng.randrange(2))
        quiet &= move(hull, {key: to[key]}, rng.randrange(2))
    return quiet


@settings(max_examples=draws(25))
@given(st.integers(0, POOL - 1), wishes, st.randoms(use_true_random=False))
def test_the_same_values_give_the_same_bits(
    number: int, wanted: list[Wish], rng: random.Random
) -> None:
    """In one edit or several, through either handle, in any order, with other values between."""
    hulls = [fresh(number) for _ in range(3)]
    to = targets(hulls[0], wanted)
    quiet = [move(hulls[0], to, 0), move(hulls[1], dict(reversed(to.items())), 1)]
    assert hulls[0].fingerprint == hulls[1].fingerprint
    quiet.append(one_by_one(hulls[2], to, rng))
    if all(quiet):
        assert hulls[2].fingerprint == hulls[0].fingerprint


@settings(max_examples=draws(15))
@given(st.integers(0, POOL - 1), wishes, st.randoms(use_true_random=False))
def test_there_and_back_is_exact(number: int, wanted: list[Wish], rng: random.Random) -> None:
    """The values of the start bring the bits of the start back, without any undo."""
    hull = fresh(number)
    start = hull.fingerprint
    to = targets(hull, wanted)
    home = {key: {axis: getattr(hull.points[key], axis) for axis in to[key]} for key in to}
    quiet = one_by_one(hull, to, rng)
    quiet &= one_by_one(hull, home, rng)
    if quiet:
        assert hull.fingerprint == start


@settings(max_examples=draws(8))
@given(st.integers(0, POOL - 1), st.integers(0, 2**16), st.floats(-0.02, 0.02))
def test_leads_and_switches_of_a_net_give_the_same_bits_in_any_order(
    number: int, which: int, amount: float
) -> None:
    """Leads of one edit in any order, by any handle, and with a switch there and back before."""
    hulls = [fresh(number) for _ in range(2)]
    prints = []
    for turn, hull in enumerate(hulls):
        points = [point for point in shared(hull) if len(point.free) == 1]
        chosen = [points[which % len(points)], points[(which * 7 + 3) % len(points)]]
        asked = [lead_asked(hull, point, amount, turn) for point in chosen[:: 1 - 2 * turn]]
        with hull.edit("groups") as edit:
            edit.group("some", list(hull.groups["sections"].lines)[:2])
            edit.group("all", ["some", "waterlines"])
        if turn:
            start = hull.fingerprint
            there_and_back(hull)
            assert hull.fingerprint == start
        try:
            with hull.edit("lead") as edit:
                for line, place in asked:
                    edit.lead(line, place)
        except ah.AssocHullError as error:
            prints.append(type(error).__name__)
            continue
        prints.append(hull.fingerprint)
    assert prints[0] == prints[1]


def lead_asked(
    hull: ah.Hull, point: Point, amount: float, turn: int
) -> tuple[str, list[tuple[str | Point, list[float]]]]:
    """Give a line through a crossing and a new place of that, by one handle or the other."""
    place = [float(getattr(point, axis)) + amount * (axis in point.free) for axis in "xyz"]
    handle = point if turn == 0 else point.friend_point
    assert handle is not None
    return point.container_curve.line.name, [(handle, place)]


def there_and_back(hull: ah.Hull) -> None:
    """Let waterlines rule a part of the hull, and no more, in two edits."""
    half = 0.5 * hull.particulars.length
    with hull.edit("there") as edit:
        edit.rule("waterlines", "sections", [("waterlines", {"x": (None, half)})])
    with hull.edit("back") as edit:
        edit.rule("waterlines", "sections", [])


def test_most_ways_are_quiet() -> None:
    """So that the two properties above say something."""
    rng, quiet = random.Random(10), 0
    for number in range(POOL):
        hull = fresh(number)
        wanted = [Wish(rng.randrange(2**16), rng.uniform(-0.004, 0.004)) for _ in range(3)]
        quiet += one_by_one(hull, targets(hull, wanted), rng)
    assert quiet >= 0.75 * POOL


def assert_both_directions(hull: ah.Hull, count: int, seed: int) -> None:
    """Set values at seeded places through the first and the second handles, and go back.

    Points of features stay where they are: moved by hand they dissolve them, for good.
    """
    owned = {point for feature in hull.state.features for point in feature.points}
    rows = [row for row in places.places(hull, places.PAIRS, count, seed) if row not in owned]
    assert len(rows) > count / 2
    keys = [hull.state.rows.key[row] for row in rows]
    start, found = hull.fingerprint, set[str]()
    home = {
        key: {axis: getattr(hull.points[key], axis) for axis in hull.points[key].free}
        for key in keys
    }
    to = {key: {axis: value + 0.001 for axis, value in each.items()} for key, each in home.items()}
    for turn in range(2):
        for key in keys[:: 1 - 2 * turn]:
            assert move(hull, {key: to[key]}, turn)
        found.add(hull.fingerprint)
        assert move(hull, home)
        assert hull.fingerprint == start
    assert len(found) == 1
    hull.undo(len(hull.history))


def test_both_directions_on_series_60(series60_70: ah.Hull) -> None:
    """Through the section and through the waterline; the way back is exact."""
    assert_both_directions(series60_70, 6, 4)
