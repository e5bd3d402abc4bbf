"""Ships of main types: their own numbers, their nets, and what is refused."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.creation.classical.classical_net import classical_net
from assoc_hull.creation.classical.prelikon import Prelikon
from assoc_hull.creation.classical.prelikon_lines import ArcJoint, Station, arc_joints
from assoc_hull.errors import AssocHullError, GeometryError
from assoc_hull.geometry.classical.appendages import AppendageBox
from assoc_hull.geometry.classical.arc_curve import ArcBoundary, round_corners, through_points
from assoc_hull.geometry.classical.boundary_lines import SpaceCurve
from assoc_hull.geometry.classical.camber import CamberKind
from assoc_hull.geometry.classical.deck import Deck, DeckHouse, Sheer
from assoc_hull.shipped.classical_ships import classical_ship

SIZES = ah.Particulars("Body", 40.0, 20.0, 9.0, 6.0, "closed")
BILGE = round_corners([(0, 0), (10, 0), (10, 12)], radius=[2.0])
LOST = (1.0 - 0.25 * np.pi) * 4.0
"""What the bilge of 2 m takes from a corner, m2."""

LEVEL = Sheer.make([(-10, 0), (50, 0)])
DECK = Deck.make(1, 9.5, LEVEL, CamberKind.make(1, 10.0, 0.5))


def body(**given: Any) -> Prelikon:
    """A middle body of 40 m with a bilge of 2 m."""
    stations = given.pop("stations", None) or [Station(x, BILGE) for x in (0.0, 10.0, 30.0, 40.0)]
    return Prelikon.make(given.pop("sizes", SIZES), stations, **given)


def boundary(name: str, *points: tuple[float, float], y: float = 0.0) -> ArcBoundary:
    """A boundary curve of lines."""
    return ArcBoundary(name, through_points(points, kind="line"), y)


def house(breadth: float, deck: Deck = DECK) -> DeckHouse:
    """A deck house of some breadth."""
    return DeckHouse.make([deck], deck.number, (10, 20), breadth=breadth, height=2.0)


@pytest.fixture(scope="module")
def supply() -> Prelikon:
    """The supply ship that comes with the package."""
    found = classical_ship("prelikon_ship")
    assert isinstance(found, Prelikon)
    return found


@pytest.fixture(scope="module")
def net(supply: Prelikon) -> ah.Hull:
    """Its net."""
    return ah.create(supply)


def test_a_middle_body_has_the_volume_of_its_section() -> None:
    """Both ends flat, stations at unequal steps: exact to rounding, its centre in the middle."""
    found = body().volume_below(6.0)
    area = 2.0 * (60.0 - LOST)
    assert found.volume == pytest.approx(40.0 * area, rel=1e-14)
    assert (found.x, found.error) == pytest.approx((20.0, 0.0), abs=1e-9)
    corner = 2.0 * (10.0 - 3.0 * np.pi) / (12.0 - 3.0 * np.pi)
    assert found.z == pytest.approx((2 * 180.0 - 2.0 * LOST * corner) / area, rel=1e-13)


@pytest.mark.parametrize(
    ("camber", "mean"),
    [
        pytest.param(CamberKind.make(1, 10.0, 0.5), 0.5 / 3.0, id="parabola"),
        pytest.param(CamberKind.make(3, 10.0, 0.5), 0.25, id="two lines"),
        pytest.param(CamberKind.make(4, 10.0, 0.5, joint=4.0), 0.15, id="three lines"),
        pytest.param(CamberKind.make(1, 4.0, 0.5, scale="local"), 0.5 / 3.0, id="scaled"),
    ],
)
def test_the_space_under_the_camber_counts_exactly(camber: CamberKind, mean: float) -> None:
    """Deck at 9.5 m on the centre line: all of the rectangle, less the mean drop and the bilges."""
    found = body(decks=[Deck.make(1, 9.5, LEVEL, camber)]).volume_to_deck()
    assert found.volume == pytest.approx(40.0 * 2.0 * (95.0 - 10.0 * mean - LOST), rel=1e-12)


def test_the_net_of_a_middle_body_is_sound_and_has_its_volume() -> None:
    """No finding; volume and centre to 1e-6: the bilge is an arc within 0.01 mm."""
    ship = body(decks=[DECK], boxes=[AppendageBox.make((5, 9), (1, 2), (-1, 0), symmetric=True)])
    hull = ah.create(ship)
    assert hull.check() == ()
    report = ship.report(hull.state)
    for name in ("volume", "centre x", "centre z"):
        figure = report.figure(f"hull below the draught 6 m: {name}")
        assert figure.net == pytest.approx(figure.value, rel=1e-6)
    assert report.worst is not None
    assert report.worst.distance < 1e-5
    bare = hull.hydrostatics(draught=6.0)
    dressed = hull.hydrostatics(draught=6.0, appendages=ship.appendages)
    assert dressed.volume - bare.volume == pytest.approx(8.0, rel=1e-9)


def test_a_net_of_two_ends_alone_is_made_and_not_measured() -> None:
    """The report keeps the numbers of the definition, and says why the net has none."""
    ship = body(stations=[Station(x, BILGE) for x in (0.0, 40.0)])
    report = ship.report(ah.create(ship).state)
    assert report.notes[-1].startswith("the net cannot be measured: 0 section(s)")
    figure = report.figure("hull below the draught 6 m: volume")
    assert figure.value == pytest.approx(40.0 * 2.0 * (60.0 - LOST))
    assert figure.net is None


@pytest.mark.parametrize("name", ["length", "breadth", "draught"])
def test_the_supply_ship_takes_other_dimensions(net: ah.Hull, name: str) -> None:
    """Two hundredths more: its stern is no circle, which would stay one and bend the planes."""
    asked = 1.02 * getattr(net.particulars, name)
    varied = net.vary(set={name: asked}).hull
    assert (varied.check(), varied.verify()) == ((), ())
    assert getattr(varied.particulars, name) == pytest.approx(asked, rel=1e-3)


def test_the_supply_ship_has_the_printed_numbers(supply: Prelikon) -> None:
    """Deck house 624 m3 with its centre at 14.90666667, box 32 m3 taken away, sheer and camber."""
    (house_,), (box,), (deck,) = supply.houses, supply.boxes, supply.decks
    assert (house_.volume, house_.profile_area) == (624.0, 52.0)
    assert house_.centroid == pytest.approx((17.0, 0.0, 14.906666666666665), rel=1e-14)
    assert (box.volume, box.centroid) == (-32.0, (73.0, 2.0, 1.5))
    assert float(deck.sheer.at(57.0 + 42.0)) == pytest.approx(1.9, rel=1e-13)
    assert float(deck.camber.drop(9.0)) == pytest.approx(0.18, rel=1e-14)
    np.testing.assert_allclose(
        deck.at([99.0, 57.0, 27.0], [9.0, 0.0, 0.0]), [14.22, 12.5, 13.1], rtol=1e-13
    )
    assert supply.notes == (
        "x counted from midship was moved by +57 m: x is now from AP",
        "1 appendage box is outlined beside the net",
        "1 deck house is outlined beside the net",
    )


def test_sections_of_the_supply_ship_end_on_its_deck(supply: Prelikon) -> None:
    """z = height + sheer - camber at the end of every section, and of the stem."""
    assert supply.deck is not None
    for station in supply.stations:
        y, z = station.curve.arcs.ends()[-1]
        assert float(supply.deck.at(station.x, y)) == pytest.approx(z, abs=1e-9)
    x, z = supply.profile.ends[1]
    assert float(supply.deck.centre(x)) == pytest.approx(z, abs=1e-9)


def test_the_net_of_the_supply_ship_is_sound(supply: Prelikon, net: ah.Hull) -> None:
    """No finding; sections within 0.02 mm of their arcs; volume within 5e-4 of its own."""
    assert net.check() == ()
    report = supply.report(net.state)
    assert report.worst is not None
    assert len(report.departures) == len(supply.stations) == 40
    assert report.worst.distance < 2e-5
    assert max(abs(each.net / each.area - 1.0) for each in report.departures) < 1e-6
    for level in ("the draught 7 m", "the lowest deck side 12.2311 m"):
        volume = report.figure(f"hull below {level}: volume")
        assert volume.net == pytest.approx(volume.value, rel=5e-4)
        centre = report.figure(f"hull below {level}: centre z")
        assert centre.net == pytest.approx(centre.value, rel=5e-4)
    assert "centre z                             14.906667" in str(report)
    bounds = {"profile", "deck edge", "aft end", "upper knuckle"}
    assert bounds == set(net.groups["boundary"].lines)


def test_the_knuckle_of_the_supply_ship_is_a_corner_of_its_sections(net: ah.Hull) -> None:
    """Where the knuckle line passes a section of the fore body, the section turns."""
    point = net.find("ST 105 x upper knuckle")
    assert isinstance(point, ah.Point)
    assert point.z == pytest.approx(10.039819, abs=1e-9)
    assert str(point.kind) == "knuckle"


def test_the_deck_edge_has_a_knuckle_at_each_break_of_the_sheer() -> None:
    """Between stations too, where the edge has no section."""
    sheer = Sheer.make([(-10, 1.0), (17, 0.0), (50, 1.0)])
    ship = body(decks=[Deck.make(1, 9.5, sheer, CamberKind.make(1, 10.0, 0.5))])
    edge = next(line for line in ship.lines() if line.name == "deck edge")
    np.testing.assert_allclose(edge.points[2], [17.0, 10.0, 9.0], atol=1e-9)
    assert edge.kind.tolist() == [0, 0, 2, 0, 0]
    assert ah.create(ship).check() == ()


def test_mean_circles_go_into_the_net_smoothly() -> None:
    """Arcs through points of an ellipse turn at each of them; the net does not, and it is told."""
    turn = np.linspace(0.0, 0.5 * np.pi, 9)
    points = np.stack([10.0 * np.sin(turn), 6.0 - 6.0 * np.cos(turn)], axis=1)
    curve = through_points([*points, (10.0, 9.0)], kind=["arc"] * 8 + ["line"], knuckles=[8])
    assert set(arc_joints(curve)[:-1]) == {ArcJoint.SMOOTH}
    ship = body(stations=[Station(x, curve) for x in (0.0, 10.0, 25.0, 40.0)])
    assert ship.notes[0].startswith("sections have 28 joints at which their direction jumps, by up")
    hull = ah.create(ship)
    assert hull.check() == ()
    worst = ship.report(hull.state).worst
    assert worst is not None
    assert 1e-5 < worst.distance < 0.02


def test_a_hull_may_end_in_a_stem_and_a_stern() -> None:
    """Sections of a wedge: volume by parabolas is exact, both ends lie on the profile."""
    stern, stem = boundary("stern", (0, 9), (0, 0)), boundary("stem", (40, 9), (40, 0))
    half = {10.0: 5.0, 20.0: 10.0, 30.0: 5.0}
    stations = [
        Station(x, through_points([(0, 0), (y, 0), (y, 9)], kind="line")) for x, y in half.items()
    ]
    ship = body(stations=stations, boundaries=[stern, stem])
    assert ship.profile.flat == (False, False)
    found = ship.volume_below(6.0)
    # Parabolas of the areas 0, 60, 120, 60, 0: Simpson's rule.
    assert found.volume == pytest.approx(10.0 / 3.0 * (4 * 60 + 2 * 120 + 4 * 60), rel=1e-14)
    assert found.error > abs(found.volume - 2400.0)
    edge = next(line for line in ship.lines() if line.name == "deck edge")
    np.testing.assert_allclose(edge.points[[0, -1]], [[0, 0, 9], [40, 0, 9]], atol=1e-12)


NOTES: dict[str, tuple[str, Callable[[], Prelikon]]] = {
    "space curve off the hull": (
        'space curve "rail" is not in the net: it leaves the sections by up to 1 m at x=40',
        lambda: body(curves=[SpaceCurve.make([(0, 10, 7), (40, 11, 7)], name="rail")]),
    ),
    "space curve without corners": (
        'space curve "belt" is not in the net: it lies on the sections, of which not all have a '
        "corner there",
        lambda: body(curves=[SpaceCurve.make([(0, 10, 7), (40, 10, 7)], name="belt")]),
    ),
    "space curve between sections": (
        'space curve "pad" is not in the net: it passes 0 section(s)',
        lambda: body(curves=[SpaceCurve.make([(12, 10, 7), (18, 10, 7)], name="pad")]),
    ),
    "buttock": (
        'boundary "buttock 3" is not in the net: it leaves the sections by up to 0.25 m at x=40',
        lambda: body(boundaries=[boundary("buttock 3", (0, 0), (40, 0.25), y=3.0)]),
    ),
    "buttock beyond": (
        'boundary "buttock 30" is not in the net: it passes no section',
        lambda: body(boundaries=[boundary("buttock 30", (0, 0), (40, 0.25), y=30.0)]),
    ),
    "boxes": (
        "2 appendage boxes are outlined beside the net",
        lambda: body(boxes=[AppendageBox.make((1, 2), (0, 1), (0, 1))] * 2),
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", NOTES)
def test_what_the_net_leaves_out_is_told(case: str) -> None:
    """A note says what, and how it lies to the sections."""
    note, make = NOTES[case]
    assert note in make().notes


SHORT = through_points([(0, 0), (10, 0), (10, 8)], kind="line")
MESSAGES: dict[str, tuple[str, Callable[[], object]]] = {
    "no sections": (
        "main type 5 is required", lambda: Prelikon.make(SIZES, [])
    ),
    "house without a deck": (
        "main type 8 needs main type 2", lambda: body(houses=[house(8.0)])
    ),
    "one section": (
        "transverse sections: 1 of them", lambda: body(stations=[Station(0.0, BILGE)])
    ),
    "two at a place": (
        "two sections at x=10", lambda: body(stations=[Station(x, BILGE) for x in (0, 10, 10)])
    ),
    "section off the centre line": (
        "section at x=5: begins at y=1",
        lambda: body(stations=[
            Station(0.0, BILGE), Station(5.0, through_points([(1, 0), (9, 0), (9, 9)]))
        ]),
    ),
    "section below the deck": (
        "section at x=0: does not reach deck 1",
        lambda: body(decks=[DECK], stations=[Station(x, SHORT) for x in (0.0, 40.0)]),
    ),
    "section above the deck": (
        "section at x=0: begins above deck 2",
        lambda: body(decks=[Deck.make(2, -1.0, LEVEL, CamberKind.make(1, 10.0, 0.5))]),
    ),
    "section off the profile": (
        "section at x=30: begins at z=0, off the profile; the profile lies at 3.6 there",
        lambda: body(boundaries=[boundary("stem", (20, 0), (45, 9))]),
    ),
    "stem aft of a section": (
        "boundary stem: ends at x=39, not forward of the section at x=40; end it forward of",
        lambda: body(boundaries=[boundary("stem", (40, 0), (41, 7), (39, 14))]),
    ),
    "no stem but a stern that goes on": (
        "boundary stern: ends at x=44, not aft of the section at x=0; end it aft of all "
        "sections, and give the stem as a boundary of its own",
        lambda: body(boundaries=[boundary("stern", (0, 0), (40, 0), (44, 14))]),
    ),
    "stem below the deck": (
        "boundary stem: does not reach deck 1",
        lambda: body(
            decks=[DECK], boundaries=[boundary("stem", (40, 0), (41, 7))]
        ),
    ),
    "sheer too short": (
        "deck 1: sheer does not cover x=40",
        lambda: body(decks=[
            Deck.make(1, 9.5, Sheer.make([(0, 0), (39, 0)]), CamberKind.make(1, 10.0, 0.5))
        ]),
    ),
    "camber too narrow": (
        "camber: y=10 beyond reference half-breadth 9",
        lambda: body(decks=[Deck.make(1, 9.5, LEVEL, CamberKind.make(1, 9.0, 0.5))]),
    ),
    "decks meet": (
        "decks 1 and 2 intersect near x=30",
        lambda: body(decks=[
            DECK,
            Deck.make(2, 8.0, Sheer.make([(-10, 0), (50, 3)]), CamberKind.make(1, 10.0, 0.5)),
        ]),
    ),
    "house too wide": (
        "deck house: breadth 20.5 exceeds the deck breadth at x=10",
        lambda: body(
            decks=[Deck.make(1, 9.5, LEVEL, CamberKind.make(1, 11.0, 0.5))],
            houses=[house(20.5, Deck.make(1, 9.5, LEVEL, CamberKind.make(1, 11.0, 0.5)))],
        ),
    ),
    "house on another deck": (
        "deck house: unknown deck 7",
        lambda: body(
            decks=[DECK], houses=[house(8.0, Deck.make(7, 9.5, LEVEL, DECK.camber))]
        ),
    ),
    "cut by diagonals": (
        "a net is not cut by 'diagonals'", lambda: body(cuts={"diagonals": [1.0]})
    ),
    "no draught": (
        "draught: non-finite value at index 0", lambda: body().volume_below(float("nan"))
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", MESSAGES)
def test_what_makes_no_ship_is_refused_in_words(case: str) -> None:
    """Each message begins as it is printed, with its numbers, and goes on with a remedy."""
    message, call = MESSAGES[case]
    with pytest.raises(GeometryError) as caught:
        call()
    assert str(caught.value).startswith(message)
    assert caught.value.remedy


@pytest.mark.parametrize("given", [None, 3, "a", [None], {}], ids=repr)
@pytest.mark.parametrize("name", ["stations", "decks", "boxes", "houses", "curves", "boundaries"])
def test_parts_of_another_type_are_refused(name: str, given: object) -> None:
    """An error of the family."""
    with pytest.raises(AssocHullError):
        Prelikon.make(SIZES, **({"stations": [Station(0.0, BILGE)]} | {name: given}))  # type: ignore[arg-type]


def test_the_net_of_a_definition_is_made_anew_the_same(supply: Prelikon) -> None:
    """Lines of a definition are values: made twice they are the same to the bit."""
    first, second = supply.lines(), supply.lines()
    assert [each.name for each in first] == [each.name for each in second]
    for one, two in zip(first, second, strict=True):
        np.testing.assert_array_equal(one.points, two.points)
    assert classical_net(body())[1].notes == ()
