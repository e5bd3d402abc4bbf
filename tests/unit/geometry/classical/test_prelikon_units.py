"""Sheer, camber, deck, box, deck house and space curve of the PRELIKON system."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from assoc_hull.creation.classical.prelikon import require_types
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.appendages import AppendageBox
from assoc_hull.geometry.classical.arc_curve import through_points
from assoc_hull.geometry.classical.boundary_lines import SpaceCurve
from assoc_hull.geometry.classical.camber import CamberKind
from assoc_hull.geometry.classical.deck import Deck, DeckHouse, Sheer, require_decks_apart

ROWS = [(-60, 2.2), (-30, 0.6), (0, 0), (30, 0.9), (60, 3.4)]
SHEER = Sheer.make(ROWS)
PARABOLA = CamberKind.make(1, 15.0, 0.5)
DECK = Deck.make(1, 12.5, SHEER, PARABOLA)
SPACE = [(0, 0, 0), (3, 1, 0.5), (6, 3, 2), (8, 6, 5)]
CAMBERS = {
    "parabola": PARABOLA,
    "parabola and line": CamberKind.make(2, 15.0, 0.5, joint=6.0),
    "two lines": CamberKind.make(3, 15.0, 0.5),
    "three lines": CamberKind.make(4, 15.0, 0.5, joint=5.0),
}


def house(**changed: object) -> DeckHouse:
    """The deck house of the printed values, with something changed."""
    given: dict[str, object] = {"deck": 1, "x": (-50, -30), "breadth": 12.0, "height": 2.6}
    given |= changed
    return DeckHouse.make([DECK], **given)  # type: ignore[arg-type]


MESSAGES: dict[str, tuple[str, Callable[[], object]]] = {
    "sheer not increasing": (
        "sheer: x not strictly increasing at row 2", lambda: Sheer.make([(0, 1), (2, 1), (2, 0)])
    ),
    "sheer of one point": ("sheer: expected shape (n >= 2, 2), got", lambda: Sheer.make([(0, 1)])),
    "sheer not finite": (
        "sheer: non-finite value at index (1, 0)", lambda: Sheer.make([(0, 1), (np.nan, 1)])
    ),
    "sheer outside": ("sheer: x=61 outside [-60, 60]", lambda: SHEER.at(61.0)),
    "sheer mean of nothing": ("sheer: mean between 3 and 3", lambda: SHEER.mean(3.0, 3.0)),
    "no such camber": ("camber: kind 5 not in 1..4", lambda: CamberKind.make(5, 15.0, 0.5)),
    "camber joint outside": (
        "camber: y1=15 must be inside (0, 15)",
        lambda: CamberKind.make(2, 15.0, 0.5, joint=15.0),
    ),
    "camber joint on the centre line": (
        "camber: y1=0 must be inside (0, 15)", lambda: CamberKind.make(4, 15.0, 0.5)
    ),
    "beyond the reference": (
        "camber: y=15.1 beyond reference half-breadth 15", lambda: PARABOLA.drop([1.0, -15.1])
    ),
    "camber joint next to the centre line": (
        "camber: y1=1e-308 must be inside (0, 15)",
        lambda: CamberKind.make(2, 15.0, 0.5, joint=1e-308),
    ),
    "camber of no ship": (
        "camber: half-breadth 1e+308", lambda: CamberKind.make(2, 1e308, 0.5, joint=1.0)
    ),
    "house in no decks": (
        "deck house: non-finite value at index 0", lambda: house().moved(float("nan"))
    ),
    "camber without breadth": ("camber: half-breadth 0", lambda: CamberKind.make(1, 0.0, 0.5)),
    "camber half of kind 1": (
        "camber: kind 1 read on the half-breadth", lambda: CamberKind.through(1, [(0, 0)])
    ),
    "camber points inward": (
        "camber: points do not run from (0, 0) outward",
        lambda: CamberKind.through(3, [(0, 0), (9, 0.1), (8, 0.5)]),
    ),
    "camber scale": (
        "camber: scale is 'none'", lambda: CamberKind.make(1, 15.0, 0.5, scale="none")
    ),
    "scaled without breadth": (
        "camber: scaled to the deck, whose half-breadth is not given",
        lambda: CamberKind.make(1, 15.0, 0.5, scale="local").drop(3.0),
    ),
    "camber mean of nothing": ("camber: mean up to y=0", lambda: PARABOLA.mean(0.0)),
    "deck without sheer": ("deck 1: sheer does not cover x=60.5", lambda: DECK.at(60.5, 0.0)),
    "places that do not fit": (
        "deck 1: expected shape (2,), got (3,)", lambda: DECK.at([1.0, 2.0], [1.0, 2.0, 3.0])
    ),
    "breadths that do not fit": (
        "camber: expected shape (2,), got (3,)",
        lambda: CamberKind.make(1, 15.0, 0.5, scale="local").drop([1.0, 2.0], [9.0] * 3),
    ),
    "decks that meet": (
        "decks 1 and 2 intersect near x=0",
        lambda: require_decks_apart(
            [DECK, Deck.make(2, 12.4, Sheer.make([(-60, 0), (60, 0.6)]), PARABOLA)],
            [-30.0, 0.0, 10.0], [9.0, 9.0, 9.0],
        ),
    ),
    "box reversed": (
        "appendage box: y limits reversed", lambda: AppendageBox.make((1, 2), (3, 1), (0, 1))
    ),
    "box without a sign": (
        "appendage box: sign is 0", lambda: AppendageBox.make((1, 2), (0, 1), (0, 1), sign=0)
    ),
    "box through its image": (
        "appendage box: y -1 to 1 overlaps its mirror image",
        lambda: AppendageBox.make((1, 2), (-1, 1), (0, 1), symmetric=True),
    ),
    "house on no deck": ("deck house: unknown deck 3", lambda: house(deck=3)),
    "house wider than the deck": (
        "deck house: breadth 12 exceeds the deck breadth at x=-50",
        lambda: house().require_breadth([-60.0, -20.0], [4.0, 10.0]),
    ),
    "house before the deck": (
        "deck house: breadth 12 exceeds the deck breadth at x=-50",
        lambda: house().require_breadth([-45.0, -20.0], [9.0, 10.0]),
    ),
    "house of no length": ("deck house: length 0", lambda: house(x=(-50, -50))),
    "house of no breadth": ("deck house: breadth 0", lambda: house(breadth=0.0)),
    "house of no height": ("deck house: height -2", lambda: house(height=-2.0)),
    "house beyond the sheer": ("deck 1: sheer does not cover x=-70", lambda: house(x=(-70, -30))),
    "house beyond the camber": (
        "camber: y=20 beyond reference half-breadth 15", lambda: house(breadth=40.0)
    ),
    "repeated point": (
        "space curve: repeated point 1", lambda: SpaceCurve.make([(0, 0, 0), (0, 0, 0), (1, 0, 0)])
    ),
    "space curve of a point": (
        "space curve: expected shape (n >= 2, 3)", lambda: SpaceCurve.make([(0, 0, 0)])
    ),
    "space curve of no kind": (
        "space curve: kind is 'arc'", lambda: SpaceCurve.make(SPACE, kind="arc")
    ),
    "space curve outside": (
        "space curve: x=20 outside [0, ", lambda: SpaceCurve.make(SPACE).at(20.0)
    ),
    "space curve of four axes": (
        "space curve: axis is 3", lambda: SpaceCurve.make(SPACE).where(3, 1.0)
    ),
    "sections missing": ("main type 5 is required", lambda: require_types({1})),
    "origin missing": ("main type 1 is required", lambda: require_types({5})),
    "deck without its sheer": ("main type 4 needs main type 2", lambda: require_types({1, 4, 5})),
    "deck without its camber": (
        "main type 4 needs main type 3", lambda: require_types({1, 2, 4, 5})
    ),
    "house without a deck": (
        "main type 8 needs main type 4", lambda: require_types({1, 2, 3, 5, 8})
    ),
    "house without sheer": ("main type 8 needs main type 2", lambda: require_types({1, 5, 8})),
    "no such main type": ("main type 10: unknown", lambda: require_types({1, 5, 10})),
    "no main types": ("main types: expected numbers", lambda: require_types(5)),  # type: ignore[arg-type]
}  # fmt: skip


@pytest.mark.parametrize("case", MESSAGES)
def test_what_makes_no_curve_is_refused_in_words(case: str) -> None:
    """Each message begins as it is printed, with its numbers, and goes on with a remedy."""
    message, call = MESSAGES[case]
    with pytest.raises(GeometryError) as caught:
        call()
    assert str(caught.value).startswith(message)
    assert caught.value.remedy


ASKED: dict[str, Callable[[Any], Any]] = {
    "sheer": lambda x: SHEER.at(x),
    "camber": lambda y: PARABOLA.drop(y),
    "deck": lambda x: DECK.at(x, 0.0),
    "deck across": lambda y: DECK.at(0.0, y),
    "space curve": lambda t: SpaceCurve.make(SPACE).at(t),
    "section": lambda s: through_points([(0, 0), (9, 0)]).at(s),
}


@pytest.mark.parametrize("case", ASKED)
def test_places_may_have_any_shape_and_must_be_numbers(case: str) -> None:
    """Scalars and tables come back in their shape; what is no number is refused in words."""
    ask = ASKED[case]
    last = (3,) if case == "space curve" else (2,) if case == "section" else ()
    for given in (1.0, [1.0, 2.0], np.ones((2, 3))):
        assert np.shape(ask(given)) == np.shape(given) + last
    for bad in ([1, [2]], "a", None, [np.nan], object()):
        with pytest.raises(GeometryError):
            ask(bad)


def test_a_job_of_the_required_types_is_enough() -> None:
    """Origin and sections; all nine; given in any order, once or twice."""
    assert require_types({1, 5}) == (1, 5)
    assert require_types([*range(9, 0, -1), 5]) == tuple(range(1, 10))


def test_sheer_has_the_printed_values() -> None:
    """On a given point, between two, and at the ends."""
    np.testing.assert_allclose(
        SHEER.at([42.0, -30.0, 15.0, -60.0, 60.0]), [1.9, 0.6, 0.45, 2.2, 3.4], rtol=1e-14
    )


@pytest.mark.parametrize(
    ("case", "value"),
    list(zip(CAMBERS, (0.18, 0.25, 0.3, 0.2), strict=True)),
    ids=list(CAMBERS),
)
def test_camber_has_the_printed_values(case: str, value: float) -> None:
    """At 9 of 15 m, on either side; the whole drop at the reference, rounding beyond it."""
    camber = CAMBERS[case]
    np.testing.assert_allclose(camber.drop([9.0, -9.0]), value, rtol=1e-14)
    assert float(camber.drop(15.0 * (1.0 + 1e-10))) == pytest.approx(0.5, rel=1e-14)
    assert float(camber.drop(0.0)) == 0.0


@pytest.mark.parametrize("case", CAMBERS)
def test_a_camber_is_as_smooth_as_its_kind_says(case: str) -> None:
    """Values never jump; tangents do in three lines only. Means are those of many samples."""
    camber = CAMBERS[case]
    y = np.linspace(0.0, 15.0, 30001)
    drop = camber.drop(y)
    slope = np.diff(drop) / np.diff(y)
    assert np.abs(np.diff(drop)).max() < 1e-3 / 30.0
    assert bool((np.abs(np.diff(slope)) < 1e-5).all()) == (case != "three lines")
    for most in (4.0, 6.0, 11.5):
        inner = np.linspace(0.0, most, 20001)
        wanted = np.trapezoid(camber.drop(inner), inner) / most
        assert camber.mean(most) == pytest.approx(wanted, rel=1e-7)


def test_camber_through_points_of_the_half_breadth() -> None:
    """Kind 3 is two lines there, kind 4 three."""
    three = CamberKind.through(4, [(0, 0), (4, 0.1), (9, 0.3), (15, 0.9)])
    np.testing.assert_allclose(three.drop([2.0, 6.5, 12.0]), [0.05, 0.2, 0.6], rtol=1e-14)
    assert (three.total, three.half_breadth, three.reading) == (0.9, 15.0, "half")


def test_a_camber_may_be_scaled_to_the_deck() -> None:
    """The whole drop stands at the deck edge of every x then."""
    camber = CamberKind.make(1, 15.0, 0.5, scale="local")
    np.testing.assert_allclose(camber.drop([5.0, 2.5], [5.0, 5.0]), [0.5, 0.125], rtol=1e-14)
    assert camber.mean(5.0, 5.0) == pytest.approx(0.5 / 3.0, rel=1e-14)


def test_deck_has_the_printed_values() -> None:
    """At both sides, on a given point of the sheer, at the origin."""
    np.testing.assert_allclose(
        DECK.at([42.0, 42.0, 0.0, -30.0], [9.0, -9.0, 0.0, 0.0]), [14.22, 14.22, 12.5, 13.1],
        rtol=1e-14,
    )  # fmt: skip


def test_decks_that_lie_apart_are_let_be() -> None:
    """One 2.6 m below the other, and one of another camber that reaches less far."""
    below = Deck.make(2, 9.9, SHEER, CamberKind.make(3, 6.0, 0.3))
    require_decks_apart([DECK, below], np.linspace(-60, 60, 9), np.full(9, 11.0))


def test_box_has_the_printed_values() -> None:
    """32 m3 about (16, 2, 1.5), 16 m2 at z = 1; twice that on both sides, less if taken away."""
    box = AppendageBox.make((12, 20), (1, 3), (0.5, 2.5))
    assert (box.volume, box.centroid, box.waterplane_area(1.0)) == (32.0, (16.0, 2.0, 1.5), 16.0)
    assert [box.waterplane_area(z) for z in (0.4, 2.6)] == [0.0, 0.0]
    assert [box.volume_below(z) for z in (0.0, 1.0, 9.0)] == [0.0, 8.0, 32.0]
    both = AppendageBox.make((12, 20), (1, 3), (0.5, 2.5), sign=-1, symmetric=True)
    assert (both.volume, both.centroid, both.surface) == (-64.0, (16.0, 0.0, 1.5), 2.0 * 72.0)
    assert both.moved(57.0).x == (69.0, 77.0)


def test_deck_house_has_the_printed_values() -> None:
    """624 m3, 52 m2, z_c 14.90666667; the same wherever x is counted from."""
    found = house()
    assert (found.volume, found.profile_area) == (624.0, 52.0)
    assert found.centroid == pytest.approx((-40.0, 0.0, 14.906666666666665), rel=1e-14)
    assert found.moved(60.0).centroid == pytest.approx((20.0, 0.0, 14.906666666666665), rel=1e-14)
    found.require_breadth([-60.0, -20.0], [6.0, 10.0])


def test_space_curve_has_the_printed_values() -> None:
    """Length and place at x = 5, straight and as a spline; given points are kept."""
    straight, spline = (SpaceCurve.make(SPACE, kind=kind) for kind in ("polyline", "spline"))
    assert straight.length == pytest.approx(11.797102716493182, rel=1e-14)
    np.testing.assert_allclose(straight.where(0, 5.0), [[5.0, 7.0 / 3.0, 1.5]], rtol=1e-13)
    np.testing.assert_allclose(
        spline.where(0, 5.0), [[5.0, 2.149786509088457, 1.2967963210654416]], rtol=1e-12
    )
    for curve in (straight, spline):
        np.testing.assert_allclose(curve.at(curve.t), SPACE, atol=1e-14)
        np.testing.assert_allclose(
            curve.moved(60.0).where(0, 65.0)[:, 1:], curve.where(0, 5.0)[:, 1:]
        )
    assert spline.length > straight.length


def test_a_space_curve_gives_every_place_of_a_coordinate() -> None:
    """There and back again: three places, two at a turn that lies in the plane, none beyond."""
    curve = SpaceCurve.make([(0, 0, 0), (4, 0, 1), (2, 1, 2), (6, 1, 3), (6, 2, 4)])
    assert curve.where(0, 3.0)[:, 2].tolist() == pytest.approx([0.75, 1.5, 2.25])
    assert curve.where(0, 6.0)[:, 2].tolist() == pytest.approx([3.0, 4.0])
    assert curve.where(0, 7.0).shape == (0, 3)


def test_a_spline_has_no_jump_of_curvature() -> None:
    """C2 in its parameter at given points, free of bending at both ends."""
    curve = SpaceCurve.make(SPACE, kind="spline")
    second = [curve.pieces(curve.t + side, 2) for side in (-1e-9, 1e-9)]
    np.testing.assert_allclose(second[0][1:-1], second[1][1:-1], atol=1e-7)
    np.testing.assert_allclose(curve.pieces(curve.t[[0, -1]], 2), 0.0, atol=1e-12)
