"""Moves by a vector: of one point, of several by one vector, by a table of vectors."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.errors import BadInputError, FreedomError, PointRoleError, UnknownNameError
from assoc_hull.geometry.curves import FloatArray
from tests.long_forms import draws
from tests.net_strategies import POOL, fresh, live_points, refused

SHIPS = {
    "wigley": ("WL 2.5", ("ST 6", "ST 7", "ST 8")),
    "series60_70": ("WL 0.5", ("ST 15", "ST 16", "ST 17")),
    "bulk_carrier": ("WL 9", ("ST 17", "ST 17.5", "ST 18")),
}

OUT = (0.0, 0.004, 0.0)


def ship(name: str, shipped: Callable[[str], ah.Hull]) -> ah.Hull:
    """A hull of its own."""
    return ah.examples.wigley() if name == "wigley" else shipped(name)


@pytest.mark.parametrize("name", SHIPS)
def test_one_vector_for_several_points_gives_what_single_moves_give(
    name: str, shipped: Callable[[str], ah.Hull]
) -> None:
    """To the bit, and in any order; a preview tells it; one undo takes it back."""
    hull = ship(name, shipped)
    line, stations = SHIPS[name]
    points, before = [f"{line} x {each}" for each in stations], hull.fingerprint
    asked = [{"op": "move", "point": points, "by": OUT}]
    seen = hull.preview(asked, name="out")
    hull.apply("out", asked)
    together = hull.fingerprint
    assert seen.fingerprint == together
    assert hull.check() == ()
    assert hull.document.history[-1].script.edits == (
        {"op": "move", "point": points, "by": list(OUT), "lead": False},
    )
    hull.undo()
    assert hull.fingerprint == before
    with hull.edit("out") as edit:
        for each in reversed(points):
            edit.move(each, y=hull.points[each].y + OUT[1])
    assert hull.fingerprint == together


def test_a_table_gives_each_point_its_own_vector() -> None:
    """In the order of the points."""
    hull = ah.examples.wigley()
    points = [f"WL 2.5 x ST {number}" for number in (5, 6, 7)]
    before = [hull.points[each].position for each in points]
    table = np.array([[0.0, 0.001, 0.0], [0.0, 0.002, 0.0], [0.0, -0.003, 0.0]])
    with hull.edit("table") as edit:
        edit.move(points, by=table)
    for each, place, by in zip(points, before, table, strict=True):
        assert np.array_equal(hull.points[each].position, place + by)


def test_on_an_oblique_plane_the_other_coordinate_follows(fresh_series60_70: ah.Hull) -> None:
    """One component says it; the whole vector may be given as well."""
    hull = fresh_series60_70
    hull.apply("diagonal", [{"op": "add_line", "group": "diagonals", "position": (9.0, 30.0)}])
    shared = [p for p in hull.lines["DIA 9 30"].curves[0].points
              if p.crossing_role == "shared" and p.free == ("y",)]  # fmt: skip
    point = shared[len(shared) // 2]
    start = point.position
    hull.apply("y", [{"op": "move", "point": point.id, "by": (0.0, 0.004, 0.0)}])
    way, done = point.position - start, hull.fingerprint
    assert way[1] == pytest.approx(0.004, abs=1e-12)
    assert way[2] == pytest.approx(-0.004 * np.tan(np.radians(30.0)), abs=1e-9)
    hull.undo()
    hull.apply("way", [{"op": "move", "point": point.id, "by": (0.0, 0.004, way[2])}])
    assert hull.fingerprint == done


BAD: dict[str, tuple[dict[str, Any], type[ah.AssocHullError], str]] = {
    "out of its freedom": ({"by": (0.01, 0.01, 0.0)}, FreedomError, "give exactly y"),
    "too few vectors": ({"by": [OUT, OUT]}, BadInputError, "2 vectors for 3 points"),
    "a number": ({"by": 0.01}, BadInputError, r"give \(x, y, z\) each"),
    "a place": ({"y": 3.0}, BadInputError, "several points to one place"),
    "both": ({"by": OUT, "y": 3.0}, BadInputError, "coordinates, and by="),
}


@pytest.mark.parametrize("case", BAD)
def test_what_is_asked_amiss_is_told(case: str) -> None:
    """What, and what to give; the hull is as it was."""
    arguments, error, words = BAD[case]
    points = [f"WL 2.5 x ST {number}" for number in (5, 6, 7)]
    hull = ah.examples.wigley(stations=9, waterlines=6)
    text = refused(hull, lambda edit: edit.move(points, **arguments), error)
    assert re.search(words, text)


def test_a_point_that_cannot_move_stops_all_of_them() -> None:
    """Caught inside the edit, none of the others has moved."""
    hull = fresh(2)
    names = ["WL 3.343 x ST 3", "WL 3.343 x ST 4"]
    wrong = {"BTK 3.423 x WL 6.685": PointRoleError, "WL 3.343 x ST 99": UnknownNameError,
             names[0]: BadInputError}  # fmt: skip
    before = hull.fingerprint
    for name, error in wrong.items():
        with hull.edit("some") as edit, pytest.raises(error):
            edit.move([*names, name], by=OUT)
        assert hull.fingerprint == before
        assert hull.history == ()


def moves(hull: ah.Hull, chosen: list[int], amounts: list[float]) -> dict[str, FloatArray]:
    """Vectors by the ids of points that can move."""
    points = [each for each in live_points(hull, "crossing", "placed", "adopted")
              if each.free and each.driver is None and each.crossing_role != "watched"]  # fmt: skip
    found = {}
    for which, amount in zip(chosen, amounts, strict=True):
        point = points[which % len(points)]
        found[point.id] = np.array([amount * (axis in point.free) for axis in "xyz"])
    return found


@settings(max_examples=draws(12), deadline=None)
@given(
    st.integers(0, POOL - 1),
    st.lists(st.integers(0, 999), min_size=4, max_size=4),
    st.lists(st.floats(-0.005, 0.005), min_size=4, max_size=4),
)
def test_a_table_gives_what_single_moves_give_or_is_refused_as_they_are(
    number: int, chosen: list[int], amounts: list[float]
) -> None:
    """On any hull, points of any kind."""
    outcome = []
    for together in (True, False):
        hull = fresh(number)
        table = moves(hull, chosen, amounts)
        before = hull.fingerprint
        try:
            with hull.edit("moves") as edit:
                if together:
                    edit.move(list(table), by=list(table.values()))
                else:
                    for name, by in table.items():
                        edit.move(name, by=by)
        except ah.AssocHullError as error:
            assert hull.fingerprint == before
            outcome.append(str(error))
            continue
        outcome.append(hull.fingerprint)
        for _ in hull.history:
            hull.undo()
        assert hull.fingerprint == before
    assert outcome[0] == outcome[1]
