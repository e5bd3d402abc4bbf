"""Knuckle lines drawn through points of sections, and taken away again."""

from __future__ import annotations

import random
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.errors import (
    AssocHullError,
    BadInputError,
    BlockedRunError,
    NameTakenError,
    UnknownNameError,
    WrongTypeError,
)
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.address import address
from tests.formed import formed
from tests.long_forms import draws
from tests.net_strategies import POOL, fresh, refused

Shipped = Callable[[str], ah.Hull]

LINES = [
    ("wigley", ["ST 6 x WL 2.5", "ST 7 x WL 2.5", "ST 8 x WL 2.5"], []),
    ("wigley", ["ST 6 x WL 2.5", "ST 7 x WL 3.125", "ST 8 x WL 3.75", "ST 9 x WL 4.375"], []),
    (
        "series60_70",
        ["ST 15 x WL 0.5", "ST 15.5 x WL 0.58", "ST 16 x WL 0.625", "ST 16.5 x WL 0.75"],
        ["BTK 0.76", "BTK 0.84", "WL 0.66"],
    ),
    (
        "bulk_carrier",
        ["ST 18 x WL 9", "ST 18.25 x WL 10", "ST 18.5 x WL 11", "ST 18.75 x WL 12"],
        ["BTK 18.5"],
    ),
]


def ship(name: str, shipped: Shipped) -> ah.Hull:
    """A hull of its own."""
    return ah.examples.wigley() if name == "wigley" else shipped(name)


def splines(hull: ah.Hull) -> dict[str, bytes]:
    """The shapes of all curves but the chine, to the bit."""
    return {
        curve.id: b"".join(getattr(curve.spline, part).tobytes() for part in ("xyz", "leave"))
        for line in hull.lines.values()
        if line.name != "chine"
        for curve in line.curves
    }


def turn(hull: ah.Hull, line: str, place: FloatArray) -> float:
    """By how many degrees a line turns at one of its points."""
    for curve in hull.lines[line].curves:
        off = np.linalg.norm(curve.spline.xyz - place, axis=1)
        at = int(off.argmin())
        if off[at] < 1e-9:
            leave, arrive = curve.spline.leave[at], curve.spline.arrive[at]
            cosine = leave @ arrive / np.linalg.norm(leave) / np.linalg.norm(arrive)
            return float(np.degrees(np.arccos(min(cosine, 1.0))))
    raise AssertionError(f"{line} does not pass {place}")


@pytest.mark.parametrize(("name", "points", "passing"), LINES)
def test_a_knuckle_line_goes_through_its_points_and_can_be_taken_back(
    name: str, points: list[str], passing: list[str], shipped: Shipped
) -> None:
    """A knuckle on each section, passing lines split; removed, all lines have their bits."""
    hull = ship(name, shipped)
    before, shapes = hull.fingerprint, splines(hull)
    places = [hull.points[point].position for point in points]
    asked = [{"op": "knuckle_line", "name": "chine", "points": points}]
    seen = hull.preview(asked, name="chine")
    hull.apply("chine", asked)
    after = hull.fingerprint
    assert (seen.fingerprint, seen.refused) == (after, ())
    assert hull.check() == ()
    assert hull.verify() == ()
    (curve,) = hull.lines["chine"].curves
    assert [each.position.tolist() for each in curve.defining] == [at.tolist() for at in places]
    assert hull.lines["chine"].boundary == "knuckle"
    assert hull.features["chine"].kind == "knuckle"
    for point, place in zip(points, places, strict=True):
        section, other = point.split(" x ")
        assert hull.points[f"chine x {section}"].position.tolist() == place.tolist()
        kinds = [hull.points[f"{line} x {crossed}"].kind for line, crossed in
                 ((section, "chine"), (other, section))]  # fmt: skip
        assert kinds == ["knuckle", "knuckle"]
        assert np.abs(hull.points[point].position - place).max() < 1e-12
        assert turn(hull, section, place) > 0.0
    split = {point.container_curve.line.name for point in hull.points.values()
             if point.parent_curve is not None and point.parent_curve.line.name == "chine"
             and point.crossing_role == "drives b"}  # fmt: skip
    assert split == set(passing)
    for line in passing:
        contact = hull.points[f"{line} x chine"]
        assert contact.kind == "knuckle"
        assert curve.closest(contact.position)[2] < 1e-9
        assert turn(hull, line, contact.position) > 0.0
    hull.undo()
    assert hull.fingerprint == before
    hull.redo()
    assert hull.fingerprint == after
    hull.apply("smooth", [{"op": "remove_knuckle_line", "line": "chine"}])
    assert splines(hull) == shapes
    assert [hull.points[point].crossing_role for point in points] == ["shared"] * len(points)
    assert "chine" not in hull.features
    assert hull.check() == ()
    assert hull.verify() == ()
    hull.undo(2)
    assert hull.fingerprint == before


def test_the_points_may_come_in_any_order_and_move_the_line() -> None:
    """A contact is free in the plane of its section, and both lines follow."""
    prints = set()
    for order in (1, -1):
        hull = ah.examples.wigley()
        with hull.edit("chine") as edit:
            line = edit.knuckle_line("chine", LINES[1][1][::order])
        assert line.name == "chine"
        prints.add(hull.fingerprint)
        with hull.edit("out") as edit:
            edit.move("chine x ST 7", by=(0.0, 0.05, -0.02))
        assert turn(hull, "ST 7", hull.points["chine x ST 7"].position) > 1.0
        assert hull.check() == ()
    assert len(prints) == 1


def test_placed_points_become_knuckles_and_come_back_as_adopted_ones() -> None:
    """At their place, smooth; they are no crossings that could be given back."""
    hull = ah.examples.wigley()
    places = []
    with hull.edit("points") as edit:
        points = [
            edit.insert(f"ST {x}", hull.lines[f"ST {x}"].curves[0].at(4.0)) for x in (6, 7, 8)
        ]
    places = [point.position for point in points]
    with hull.edit("chine") as edit:
        edit.knuckle_line("chine", points)
    assert hull.check() == ()
    with hull.edit("smooth") as edit:
        edit.remove_knuckle_line("chine")
    assert hull.check() == ()
    for x, place in zip((6, 7, 8), places, strict=True):
        (back,) = [each for each in hull.lines[f"ST {x}"].curves[0].defining
                   if (each.position == place).all()]  # fmt: skip
        assert (back.sort, back.kind) == ("adopted", "smooth")


def test_remove_line_takes_the_line_and_leaves_the_shape() -> None:
    """The knuckles stay, as points of the sections."""
    hull = ah.examples.wigley()
    hull.apply("chine", [{"op": "knuckle_line", "name": "chine", "points": LINES[1][1]}])
    with hull.edit("out") as edit:
        edit.move("chine x ST 7", by=(0.0, 0.05, 0.0))
    place = hull.points["chine x ST 7"].position
    hull.apply("line", [{"op": "remove_line", "line": "chine"}])
    assert turn(hull, "ST 7", place) > 1.0


BAD: dict[str, tuple[object, type[AssocHullError], str]] = {
    "two sections": (["ST 6 x WL 2.5", "ST 7 x WL 2.5"], BadInputError, "3 sections or more"),
    "a gap": (
        ["ST 6 x WL 2.5", "ST 7 x WL 2.5", "ST 9 x WL 2.5"], BadInputError, "it would pass ST 8"
    ),
    "two of one": (
        ["ST 6 x WL 2.5", "ST 7 x WL 2.5", "ST 7 x WL 5"], BadInputError, "lie on one section"
    ),
    "no section": (
        ["WL 2.5 x profile", "ST 7 x WL 2.5", "ST 8 x WL 2.5"], BadInputError, "lies on no section"
    ),
    "an end": (
        ["ST 6 x deck edge", "ST 7 x WL 2.5", "ST 8 x WL 2.5"], BlockedRunError, "ends of sections"
    ),
    "unknown": (
        ["ST 6 x WL 99", "ST 7 x WL 2.5", "ST 8 x WL 2.5"], UnknownNameError, "ST 6 x WL 99"
    ),
    "one point": ("ST 6 x WL 2.5", WrongTypeError, "give a list of points"),
}  # fmt: skip


@pytest.mark.parametrize("case", BAD)
def test_what_cannot_be_a_knuckle_line_is_told(case: str) -> None:
    """What, and what to give; the hull is as it was."""
    points, error, words = BAD[case]
    hull = ah.examples.wigley()
    text = refused(hull, lambda edit: edit.knuckle_line("chine", points), error)  # type: ignore[arg-type]
    assert words in text


def test_names_and_kinds_are_checked() -> None:
    """A name that is taken, none at all, a line of another kind, points that turn already."""
    hull = ah.examples.wigley()
    points = LINES[0][1]
    refused(hull, lambda edit: edit.knuckle_line("profile", points), NameTakenError)
    refused(hull, lambda edit: edit.knuckle_line("a x b", points), BadInputError)
    text = refused(hull, lambda edit: edit.remove_knuckle_line("profile"), BadInputError)
    assert "edit.remove_line" in text
    hull.apply("chine", [{"op": "knuckle_line", "name": "chine", "points": points}])
    contacts = [f"chine x ST {x}" for x in (6, 7, 8)]
    text = refused(hull, lambda edit: edit.knuckle_line("second", contacts), BlockedRunError)
    assert "knuckles or tangent points already" in text


def test_where_sections_shape_no_boundary_curve_single_points_are_made_knuckles() -> None:
    """As the message says."""
    hull = ah.Hull(formed())
    points = [hull.lines[f"ST {x}"].curves[0].defining[5] for x in (35, 45, 55)]
    text = refused(hull, lambda edit: edit.knuckle_line("second", points), BadInputError)
    assert "edit.set_kind" in text
    with hull.edit("single") as edit:
        edit.set_kind(points[0], "knuckle")
    assert points[0].kind == "knuckle"


def test_what_is_refused_half_way_leaves_no_trace(fresh_series60_70: ah.Hull) -> None:
    """Caught inside the edit, which then goes on with something else."""
    hull, other = fresh_series60_70, {"op": "move", "point": "WL 1 x ST 5", "by": (0, 0.001, 0)}
    hull.apply("other", [other])
    after = hull.fingerprint
    hull.undo()
    points = ["ST 15 x WL 0.5", "ST 15.5 x WL 1.25", "ST 16 x WL 0.25", "ST 16.5 x WL 1"]
    with hull.edit("other") as edit:
        with pytest.raises(BadInputError, match="choose points that lie on one line"):
            edit.knuckle_line("chine", points)
        edit.move("WL 1 x ST 5", by=(0.0, 0.001, 0.0))
    assert hull.fingerprint == after
    assert "chine" not in hull.lines


@settings(max_examples=draws(12), deadline=None)
@given(st.integers(0, POOL - 1), st.randoms(use_true_random=False))
def test_on_any_hull_a_knuckle_line_is_drawn_whole_or_refused(
    number: int, rng: random.Random
) -> None:
    """Sound; removed, every line passes its points again; undone to the bit."""
    hull = fresh(number)
    state, before = hull.state, hull.fingerprint
    lines = sorted(
        hull.groups["sections"].lines.values(),
        key=lambda each: float(state.lines.offset[each.number]),
    )
    first = rng.randrange(len(lines) - 2)
    points = []
    for line in lines[first : first + rng.randint(3, 5)]:
        rows = state.curves.rows[line.curves[0].number].tolist()
        points.append(address(state, rng.choice(rows[1:-1])))
    known = [hull.points[point].position for point in points]
    try:
        with hull.edit("chine") as edit:
            edit.knuckle_line("chine", points)
    except AssocHullError:
        assert hull.fingerprint == before
        return
    assert hull.check() == ()
    assert hull.verify() == ()
    mended = hull.history[-1].mended
    try:
        hull.apply("smooth", [{"op": "remove_knuckle_line", "line": "chine"}])
    except AssocHullError:
        pass
    else:
        assert hull.check() == ()
        assert hull.verify() == ()
        if not mended and not hull.history[-1].mended:
            places = np.array([xyz for line in hull.lines.values() for curve in line.curves
                               for xyz in curve.spline.xyz])  # fmt: skip
            for xyz in known:
                assert np.linalg.norm(places - xyz, axis=1).min() < 1e-9
    for _ in hull.history:
        hull.undo()
    assert hull.fingerprint == before
