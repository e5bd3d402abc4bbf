"""Straight runs and arcs drawn on a line: exact shapes, what follows, what is in the way."""

from __future__ import annotations

import random
import re
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.edit.session import Edit
from assoc_hull.errors import BadInputError, BlockedRunError, GeometryError, RefusedEditError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.objects import Curve, Point
from tests.long_forms import draws
from tests.net_strategies import POOL, fresh, refused

Shipped = Callable[[str], ah.Hull]
Asked = Mapping[str, Any]

STRAIGHT = [
    ("wigley", "WL 2.5", "WL 2.5 x ST 4", "WL 2.5 x ST 7"),
    ("wigley", "ST 10", "ST 10 x WL 5", "ST 10 x WL 2.5"),
    ("series60_70", "WL 0.5", "WL 0.5 x ST 15", "WL 0.5 x ST 17"),
    ("series60_70", "BTK 0.52", "BTK 0.52 x WL 0.625", "BTK 0.52 x ST 3"),
    ("bulk_carrier", "WL 9", "WL 9 x ST 18", "WL 9 x ST 18.5"),
]
ROUND = [
    ("wigley", "ST 10", "ST 10 x WL 0.625", "ST 10 x WL 5.625", 5.5),
    ("series60_70", "WL 0.42", "WL 0.42 x ST 14.5", "WL 0.42 x ST 16.5", 30.0),
    ("bulk_carrier", "ST 18.25", "WL 9 x ST 18.25", "WL 13.5 x ST 18.25", 4.0),
    ("bulk_carrier", "WL 5", "WL 5 @ adopted 1", "WL 5 x ST 0.75", 4.0),
]


def ship(name: str, shipped: Shipped) -> ah.Hull:
    """A hull of its own."""
    return ah.examples.wigley() if name == "wigley" else shipped(name)


def apply_once(hull: ah.Hull, asked: Asked) -> None:
    """Preview an edit and make it: the same bits; sound; undone and made again to the bit."""
    before = hull.fingerprint
    seen = hull.preview([asked], name="run")
    assert hull.fingerprint == before
    hull.apply("run", [asked])
    after = hull.fingerprint
    assert (seen.fingerprint, seen.refused) == (after, ())
    assert hull.check() == ()
    assert hull.verify() == ()
    hull.undo()
    assert hull.fingerprint == before
    hull.redo()
    assert hull.fingerprint == after
    assert hull.document.history[-1].script.edits[0] == {**asked}


def curve_of(hull: ah.Hull, line: str, *points: FloatArray) -> Curve:
    """The curve of a line that passes places."""
    away = [
        max(float(np.linalg.norm(curve.spline.xyz - place, axis=1).min()) for place in points)
        for curve in hull.lines[line].curves
    ]
    return hull.lines[line].curves[int(np.argmin(away))]


def between(curve: Curve, a: FloatArray, b: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Places (400, 3) and tangents of a curve from one of its points to another."""
    knot, xyz = curve.spline.knot, curve.spline.xyz
    ends = sorted(float(knot[np.linalg.norm(xyz - place, axis=1).argmin()]) for place in (a, b))
    at = np.linspace(ends[0], ends[1], 400)
    return np.array([curve.at(t) for t in at]), np.array([curve.tangent(t) for t in at])


@pytest.mark.parametrize(("name", "line", "a", "b"), STRAIGHT)
def test_a_straightened_run_lies_on_its_chord(
    name: str, line: str, a: str, b: str, shipped: Shipped
) -> None:
    """To 1e-9 m between its points too, with tangent points at both ends, which stay."""
    hull = ship(name, shipped)
    ends = [hull.points[each].position for each in (a, b)]
    apply_once(hull, {"op": "straighten", "line": line, "a": a, "b": b})
    assert [hull.points[each].position.tolist() for each in (a, b)] == [
        end.tolist() for end in ends
    ]
    curve = curve_of(hull, line, *ends)
    xyz, tangent = between(curve, *ends)
    way = (xyz[-1] - xyz[0]) / np.linalg.norm(xyz[-1] - xyz[0])
    assert np.linalg.norm(np.cross(xyz - xyz[0], way), axis=1).max() < 1e-9
    assert np.abs(tangent - way).max() < 1e-9
    runs = [each for each in hull.features.values()
            if each.kind == "straight" and line in {on.name for on in each.lines}]  # fmt: skip
    assert any(
        {tuple(each.points[i].position) for i in (0, -1)} == {tuple(end) for end in ends}
        for each in runs
    )
    kinds = [point.kind for point in curve.defining
             if any((point.position == end).all() for end in ends)]  # fmt: skip
    assert kinds == ["tangent", "tangent"]


@pytest.mark.parametrize(("name", "line", "a", "b", "radius"), ROUND)
def test_an_arc_has_the_asked_radius_and_touches_both_sides(
    name: str, line: str, a: str, b: str, radius: float, shipped: Shipped
) -> None:
    """Points to 1e-9 m, the curve between them to 1e-5 of the radius; sides as they were."""
    hull = ship(name, shipped)
    ends = [hull.points[each].position for each in (a, b)]
    old = curve_of(hull, line, *ends)
    _, before = between(old, *ends)
    known = set(hull.features)
    apply_once(hull, {"op": "round", "line": line, "a": a, "b": b, "radius": radius})
    new = curve_of(hull, line, *ends)
    (arc,) = [hull.features[each] for each in set(hull.features) - known
              if hull.features[each].kind == "arc"]  # fmt: skip
    points = np.array([point.position for point in arc.points])
    centre = np.array(arc.parameters["centre"])
    assert arc.parameters["radius"] == radius
    assert len(points) >= 5
    assert np.abs(np.linalg.norm(points - centre, axis=1) - radius).max() < 1e-9
    places, _ = between(new, points[0], points[-1])
    assert np.abs(np.linalg.norm(places - centre, axis=1) - radius).max() < 1e-5 * radius
    _, tangent = between(new, *ends)
    assert np.abs(tangent[[0, -1]] - before[[0, -1]]).max() < 1e-9
    path, _ = between(new, *ends)
    for at, place in ((0, points[0]), (-1, points[-1])):
        assert np.abs(np.cross(place - path[at], tangent[at])).max() < 1e-9
        assert abs(float((place - centre) @ tangent[at])) < 1e-9


def test_the_hull_around_follows_and_what_lies_farther_stays(
    fresh_series60_70: ah.Hull,
) -> None:
    """Crossings of the neighbouring waterlines move; a line beyond the fade keeps its bits."""
    hull = fresh_series60_70
    places = {name: hull.points[name].position for name in
              ("WL 0.42 x ST 16", "WL 0.5 x ST 16", "WL 0.58 x ST 16", "WL 1 x ST 16")}  # fmt: skip
    far = hull.lines["ST 2"].curves[0].revision
    with hull.edit("straight") as edit:
        edit.straighten("WL 0.5", "WL 0.5 x ST 15", "WL 0.5 x ST 17", fade=(20.0, 2.5))
    moved = {name: float(np.linalg.norm(hull.points[name].position - place))
             for name, place in places.items()}  # fmt: skip
    middle = moved["WL 0.5 x ST 16"]
    assert middle > 0.02
    assert 0.1 * middle < moved["WL 0.42 x ST 16"] < middle
    assert 0.1 * middle < moved["WL 0.58 x ST 16"] < middle
    assert moved["WL 1 x ST 16"] == 0.0
    assert hull.lines["ST 2"].curves[0].revision == far


def test_the_order_of_the_two_points_plays_no_part() -> None:
    """Nor does naming the curve instead of the line."""
    prints = set()
    for a, b in (("ST 4", "ST 7"), ("ST 7", "ST 4")):
        hull = ah.examples.wigley()
        with hull.edit("straight") as edit:
            edit.straighten(hull.lines["WL 2.5"].curves[0], f"WL 2.5 x {a}", f"WL 2.5 x {b}")
        prints.add(hull.fingerprint)
    assert len(prints) == 1


def test_a_run_that_is_straight_already_is_left_as_it_is() -> None:
    """There is nothing to undo, and a note says so."""
    hull = ah.examples.wigley()
    asked = {"op": "straighten", "line": "WL 2.5", "a": "WL 2.5 x ST 4", "b": "WL 2.5 x ST 7"}
    hull.apply("once", [asked])
    report = hull.apply("twice", [asked])
    assert report is not None
    assert not report.changed
    assert "runs straight there already" in report.notes[0]


def test_runs_of_several_lines_in_one_edit_give_the_bits_of_any_order() -> None:
    """Each is drawn on the hull as it was before."""
    asked = [
        {"op": "straighten", "line": f"WL {z}", "a": f"WL {z} x ST 4", "b": f"WL {z} x ST 7"}
        for z in ("1.25", "5")
    ]
    prints = set()
    for order in (asked, asked[::-1]):
        hull = ah.examples.wigley()
        hull.apply("two", order)
        assert hull.check() == ()
        prints.add(hull.fingerprint)
    assert len(prints) == 1


def test_a_knuckle_between_the_sides_is_rounded() -> None:
    """It gives way, and its crossing lies on the arc."""
    hull = ah.examples.wigley()
    with hull.edit("corner") as edit:
        edit.set_kind("ST 10 x WL 2.5", "knuckle")
    hull.apply("round", [{"op": "round", "line": "ST 10", "a": "ST 10 x WL 1.25",
                          "b": "ST 10 x WL 4.375", "radius": 2.0}])  # fmt: skip
    assert hull.points["ST 10 x WL 2.5"].kind == "smooth"
    assert hull.features["ST 10 arc"].parameters["radius"] == 2.0
    assert hull.check() == ()


WIGLEY: dict[str, tuple[Asked, type[ah.AssocHullError], str]] = {
    "not on the line": (
        {"a": "WL 5 x ST 4"}, BadInputError, "WL 5 x ST 4 is no point of WL 2.5"
    ),
    "one point": ({"a": "WL 2.5 x ST 7"}, BadInputError, "both ends are one point"),
    "a boundary": (
        {"line": "deck edge", "a": "deck edge x ST 4", "b": "deck edge x ST 7"},
        BadInputError, "boundary curve",
    ),
    "unknown point": ({"a": "WL 2.5 x ST 99"}, ah.errors.UnknownNameError, "WL 2.5 x ST 99"),
    "unknown line": ({"line": "WL 99"}, ah.errors.UnknownNameError, "WL 99"),
    "radii": ({"fade": (0.0, 1.0)}, BadInputError, "radii above 0"),
}  # fmt: skip


@pytest.mark.parametrize("case", WIGLEY)
def test_a_run_that_is_asked_amiss_is_refused(case: str) -> None:
    """With what to do."""
    changes, error, words = WIGLEY[case]
    given = {"line": "WL 2.5", "a": "WL 2.5 x ST 4", "b": "WL 2.5 x ST 7", **changes}
    text = refused(ah.examples.wigley(), lambda edit: edit.straighten(**given), error)
    assert words in text


def test_an_arc_that_does_not_fit_names_the_radius_that_does() -> None:
    """Which then is taken."""
    hull = ah.examples.wigley()
    given = {"line": "ST 10", "a": "ST 10 x WL 0.625", "b": "ST 10 x WL 5.625"}
    text = refused(
        hull, lambda edit: edit.round("ST 10", given["a"], given["b"], radius=8.0), GeometryError
    )  # fmt: skip
    found = re.search(r"give a radius up to ([0-9.]+) m", text)
    assert found
    hull.apply("round", [{"op": "round", **given, "radius": float(found[1])}])
    assert hull.check() == ()
    text = refused(
        hull, lambda edit: edit.round("WL 5", "WL 5 x ST 9", "WL 5 x ST 9", radius=1.0),
        BadInputError,
    )  # fmt: skip
    assert "one point" in text


def test_placed_points_in_the_run_are_named_and_unpinned_ones_give_way() -> None:
    """Nothing that a designer placed is lost unasked."""
    hull = ah.examples.wigley()
    with hull.edit("place") as edit:
        point = edit.insert("WL 2.5", hull.lines["WL 2.5"].curves[0].at(27.0))
    name = "WL 2.5 @ placed 1"
    assert hull.points[name] == point
    text = refused(
        hull, lambda edit: edit.straighten("WL 2.5", "WL 2.5 x ST 4", "WL 2.5 x ST 7"),
        BlockedRunError,
    )  # fmt: skip
    assert name in text
    assert "edit.unpin" in text
    hull.apply("unpin", [{"op": "unpin", "point": name}])
    hull.apply("straight", [{"op": "straighten", "line": "WL 2.5", "a": "WL 2.5 x ST 4",
                             "b": "WL 2.5 x ST 7"}])  # fmt: skip
    assert hull.check() == ()


def _straighten(line: str, a: str, b: str, edit: Edit) -> None:
    edit.straighten(line, a, b)


def test_features_and_flats_are_in_the_way(shipped: Shipped) -> None:
    """Each with the way out."""
    carrier = shipped("bulk_carrier")
    for line, a, b, words in (
        ("ST 10", "ST 10 x WL 0.5", "ST 10 x WL 2", "the feature 'ST 10 arc' lies"),
        ("WL 9", "WL 9 x ST 14", "WL 9 x ST 18", "points of a flat lie in the run"),
        ("WL 9", "WL 9 x flat of side #2", "WL 9 x ST 18", "tangent point with another"),
    ):
        text = refused(carrier, partial(_straighten, line, a, b), ah.AssocHullError)
        assert words in text


@pytest.mark.parametrize("radius", [2.0, 500.0])
def test_a_flat_is_told_before_a_radius_that_would_fit(shipped: Shipped, radius: float) -> None:
    """Who took the radius of the message would be refused for the flat after all."""
    ask = partial(_round, "ST 8", "ST 8 x BTK 16", "ST 8 x WL 5", radius)
    text = refused(shipped("bulk_carrier"), ask, BlockedRunError)
    assert "points of a flat lie in the run" in text


def _round(line: str, a: str, b: str, radius: float, edit: Edit) -> None:
    edit.round(line, a, b, radius=radius)


def test_an_end_that_cannot_be_held_is_made_shared_first(fresh_series60_70: ah.Hull) -> None:
    """As the message says; what cannot be held within the run is watched, and told."""
    hull = fresh_series60_70
    hull.apply("diagonal", [{"op": "add_line", "group": "diagonals", "position": (9.0, 30.0)}])
    ends = ["DIA 9 30 x ST 2.5", "DIA 9 30 x ST 4"]
    text = refused(hull, lambda edit: edit.straighten("DIA 9 30", *ends), BlockedRunError)
    assert "another line drives an end" in text
    assert "edit.set_role" in text
    hull.apply("shared", [{"op": "set_role", "crossing": end, "role": "shared"} for end in ends])
    report = hull.apply("run", [{"op": "straighten", "line": "DIA 9 30", "a": ends[0],
                                 "b": ends[1]}])  # fmt: skip
    assert report is not None
    assert "DIA 9 30 x ST 3 is watched now" in report.notes[0]
    assert hull.check() == ()
    assert hull.verify() == ()


def test_one_point_is_not_moved_and_put_on_a_run_in_one_edit() -> None:
    """Neither is lost unseen, in any order."""
    hull = ah.examples.wigley()
    move = {"op": "move", "point": "WL 2.5 x ST 5", "by": (0, 0.01, 0)}
    run = {"op": "straighten", "line": "WL 2.5", "a": "WL 2.5 x ST 4", "b": "WL 2.5 x ST 7"}
    goal = hull.points["WL 2.5 x ST 5"].position + np.array([0.0, 0.05, 0.0])
    bend = {"op": "reshape", "curve": "WL 2.5", "span": (5, 45), "points": [goal]}
    both: list[list[Asked]] = [[move, run], [run, move], [bend, move]]
    for asked in both:
        with pytest.raises(RefusedEditError, match="is moved, and given another place"):
            hull.apply("both", asked)
    with pytest.raises(BadInputError, match="use two edits"):
        hull.apply("both", [run, {**run, "a": "WL 2.5 x ST 10", "b": "WL 2.5 x ST 12"}])
    assert hull.history == ()


def runs(hull: ah.Hull, rng: random.Random) -> dict[str, Any]:
    """A run of a few points of some line."""
    state = hull.state
    curves = [curve for curve in state.live("curves").tolist()
              if state.lines.boundary[state.line_of(curve)] < 0]  # fmt: skip
    curve = rng.choice(curves)
    rows = state.curves.rows[curve].tolist()
    first = rng.randrange(len(rows) - 1)
    last = min(first + rng.randint(1, 4), len(rows) - 1)
    ends = [Point.of(state, row) for row in (rows[first], rows[last])]
    return {"line": Curve.of(state, curve), "a": ends[0], "b": ends[1]}


@settings(max_examples=draws(12), deadline=None)
@given(st.integers(0, POOL - 1), st.randoms(use_true_random=False))
def test_on_any_hull_a_run_is_drawn_exactly_or_refused_whole(
    number: int, rng: random.Random
) -> None:
    """Sound, undone to the bit."""
    hull = fresh(number)
    before, given = hull.fingerprint, runs(hull, rng)
    verb = rng.choice(("straighten", "round"))
    if verb == "round":
        given["radius"] = 10.0 ** rng.uniform(-1.0, 3.0)
    ends = [given[each].position for each in "ab"]
    try:
        with hull.edit("run") as edit:
            getattr(edit, verb)(**given)
    except (BadInputError, BlockedRunError, GeometryError, RefusedEditError):
        assert hull.fingerprint == before
        assert hull.history == ()
        return
    assert hull.check() == ()
    assert hull.verify() == ()
    if verb == "straighten":
        xyz, _ = between(curve_of(hull, given["line"].line.name, *ends), *ends)
        way = (xyz[-1] - xyz[0]) / np.linalg.norm(xyz[-1] - xyz[0])
        assert np.linalg.norm(np.cross(xyz - xyz[0], way), axis=1).max() < 1e-9
    for _ in hull.history:
        hull.undo()
    assert hull.fingerprint == before
