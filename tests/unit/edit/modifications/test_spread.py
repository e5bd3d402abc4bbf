"""Hollows and bumps made longer and shallower: the area stays, the ends are tangent."""

from __future__ import annotations

import math
import re
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicHermiteSpline

import assoc_hull as ah
from assoc_hull.errors import (
    AssocHullError,
    BadInputError,
    BlockedRunError,
    OutOfRangeError,
    UnknownNameError,
)
from assoc_hull.geometry.curves import SplineBatch
from assoc_hull.model.objects import Curve
from tests.long_forms import draws
from tests.net_strategies import POOL, fresh, live_points, refused

Shipped = Callable[[str], ah.Hull]

DENTS = [
    ("wigley", "WL 2.5", "ST 7", 1, -0.1, 40.0),
    ("wigley", "WL 2.5", "ST 7", 1, 0.1, 40.0),
    ("wigley", "ST 7", "WL 2.5", 1, -0.1, 4.0),
    ("series60_70", "WL 0.5", "ST 15", 1, -0.05, 20.0),
    ("bulk_carrier", "WL 9", "ST 18", 1, -0.05, 40.0),
]


def ship(name: str, shipped: Shipped) -> ah.Hull:
    """A hull of its own."""
    return ah.examples.wigley() if name == "wigley" else shipped(name)


def curve_of(hull: ah.Hull, line: str, point: str) -> Curve:
    """The curve of a line on which a point lies."""
    found = hull.points[point].container_curve
    friend = hull.points[point].friend_point
    return found if found.line.name == line or friend is None else friend.container_curve


def area(spline: SplineBatch, along: int, up: int) -> float:
    """The area below a curve, by scipy's splines, m2."""
    total = 0.0
    for i in range(len(spline.knot) - 1):
        slopes = np.array([spline.leave[i], spline.arrive[i + 1]])
        piece = CubicHermiteSpline(spline.knot[i : i + 2], spline.xyz[i : i + 2], slopes)
        x, w = np.polynomial.legendre.leggauss(4)
        t = spline.knot[i] + 0.5 * (x + 1.0) * (spline.knot[i + 1] - spline.knot[i])
        half = 0.5 * (spline.knot[i + 1] - spline.knot[i])
        total += float((piece(t)[:, up] * piece(t, 1)[:, along] * w).sum() * half)
    return total


def bend(spline: SplineBatch, at: int, up: int) -> float:
    """How far a point lies off the chord of those beside it, m."""
    return float(spline.xyz[at, up] - 0.5 * (spline.xyz[at - 1, up] + spline.xyz[at + 1, up]))


@pytest.mark.parametrize(("name", "line", "other", "up", "dent", "length"), DENTS)
def test_a_spread_hollow_keeps_its_area_and_is_shallower(
    name: str, line: str, other: str, up: int, dent: float, length: float, shipped: Shipped
) -> None:
    """Net area to 1e-9 of the hollow's; bits of the line beyond its length; sound; undone."""
    hull, point = ship(name, shipped), f"{line} x {other}"
    sound = curve_of(hull, line, point).spline
    hull.apply("dent", [{"op": "move", "point": point, "by": [dent * (i == up) for i in range(3)]}])
    curve, place, before = (
        curve_of(hull, line, point),
        hull.points[point].position,
        hull.fingerprint,
    )
    old = curve.spline
    along = 2 if line.startswith("ST") else 0
    asked = [{"op": "spread", "point": point, "length": length}]
    seen = hull.preview(asked, name="spread")
    hull.apply("spread", asked)
    assert (seen.fingerprint, seen.refused) == (hull.fingerprint, ())
    new = curve.spline
    kept = area(new, along, up) - area(old, along, up)
    assert abs(kept) < 1e-8 * abs(dent) * length
    assert (hull.points[point].y - place[1]) * dent < 0.0
    at = int(np.linalg.norm(old.xyz - place, axis=1).argmin())
    left, dented = (bend(each, at, up) - bend(sound, at, up) for each in (new, old))
    assert abs(left) < abs(dented)
    far = np.abs(old.xyz[:, along] - place[along]) > length
    assert np.array_equal(new.xyz[far], old.xyz[far])
    assert hull.check() == ()
    assert hull.verify() == ()
    hull.undo()
    assert hull.fingerprint == before


def test_the_ends_are_tangent_to_the_line() -> None:
    """Beyond the new length the tangent of a densely made line is what it was."""
    hull = ah.examples.wigley(stations=81, waterlines=6)
    point = "WL 2.5 x ST 30"
    assert point in hull.points
    with hull.edit("dent") as edit:
        edit.pull(point, -0.05, (8.0, 2.0))
    curve, place = curve_of(hull, "WL 2.5", point), hull.points[point].position
    old = curve.spline
    with hull.edit("spread") as edit:
        edit.spread(point, length=30.0)
    outside = np.abs(old.xyz[:, 0] - place[0]) > 16.0
    assert np.abs(curve.spline.leave - old.leave)[outside].max() < 1e-4


def test_a_length_that_is_too_short_is_told_with_the_least_one() -> None:
    """Which is then taken."""
    hull = ah.examples.wigley()
    hull.apply("dent", [{"op": "move", "point": "WL 2.5 x ST 7", "by": (0, -0.1, 0)}])
    text = refused(hull, lambda edit: edit.spread("WL 2.5 x ST 7", length=5.0), OutOfRangeError)
    for _ in range(5):
        found = re.search(r"give one from ([0-9.]+) to", text)
        assert found
        least = float(found[1])
        try:
            hull.apply("spread", [{"op": "spread", "point": "WL 2.5 x ST 7", "length": least}])
            break
        except OutOfRangeError as error:
            text = str(error)
    assert hull.history[-1].name == "spread"


def test_where_there_is_no_hollow_or_no_room_it_is_said() -> None:
    """What to do instead; the hull is as it was."""
    hull = ah.examples.wigley()
    text = refused(hull, lambda edit: edit.spread("WL 2.5 x ST 7", length=40.0), BadInputError)
    assert "choose a point in a hollow" in text
    hull.apply("dent", [{"op": "move", "point": "WL 2.5 x ST 7", "by": (0, -0.1, 0)}])
    text = refused(hull, lambda edit: edit.spread("WL 2.5 x ST 7", length=99.0), BadInputError)
    assert "reaches beyond an end" in text
    refused(hull, lambda edit: edit.spread("WL 2.5 x ST 7", length=math.nan), BadInputError)
    refused(hull, lambda edit: edit.spread("WL 9 x ST 7", length=9.0), UnknownNameError)
    with hull.edit("place") as edit:
        edit.insert("WL 2.5", curve_of(hull, "WL 2.5", "WL 2.5 x ST 7").at(38.0))
    text = refused(hull, lambda edit: edit.spread("WL 2.5 x ST 7", length=40.0), BlockedRunError)
    assert "placed points" in text


@settings(max_examples=draws(12), deadline=None)
@given(
    st.integers(0, POOL - 1), st.integers(0, 999), st.sampled_from([-0.15, -0.08, 0.08, 0.15]),
    st.floats(0.1, 0.5),
)  # fmt: skip
def test_on_any_hull_the_area_is_kept_or_the_edit_refused_whole(
    number: int, which: int, dent: float, part: float
) -> None:
    """Dents at any crossing of a waterline with a section; to 2 % where other lines drive."""
    hull = fresh(number)
    points = [each for each in live_points(hull, "crossing")
              if each.crossing_role == "shared" and each.free == ("y",)
              and each.container_curve.line.group.name == "waterlines"]  # fmt: skip
    if not points:
        return
    point = points[which % len(points)]
    try:
        hull.apply("dent", [{"op": "move", "point": point.id, "by": (0.0, dent, 0.0)}])
    except AssocHullError:
        return
    before, old = hull.fingerprint, point.container_curve.spline
    try:
        with hull.edit("spread") as edit:
            edit.spread(point, length=part * hull.particulars.length)
    except AssocHullError:
        assert hull.fingerprint == before
        return
    kept = area(point.container_curve.spline, 0, 1) - area(old, 0, 1)
    assert abs(kept) < 0.02 * abs(dent) * part * hull.particulars.length
    assert hull.check() == ()
    assert hull.verify() == ()
    hull.undo()
    assert hull.fingerprint == before
