"""Ships of portions: their numbers, their lines, and the nets made of them."""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.creation.classical.line_outline import point_kinds_along
from assoc_hull.creation.classical.sfolds import Sfolds, portion_frames, section_points
from assoc_hull.creation.classical.sfolds_portion import Portion
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.ordinate_section import OrdinateSection
from assoc_hull.shipped.classical_ships import classical_ship

SECTION = OrdinateSection.make(
    hb=0.9, sb=3, sw=2, hd=12.4, bd=15.2, cam=0.4, zb=[0, 0.02, 0.10, 0.31, 0.80],
    yw=[12.3, 14.2, 14.8, 15, 15.1, 15.2, 15.2],
)  # fmt: skip
X = np.arange(5) * 8.0
BODY = ah.Particulars("Body", 32.0, 30.4, 12.4, 9.0, "closed")


def prism(number: int = 3, start: float = 0.0) -> Portion:
    """Five times the section of the published values, 8 m apart."""
    return Portion.make(number, X + start, [SECTION] * 5)


def body(**options: float) -> Sfolds:
    """A ship of this one portion."""
    return Sfolds.make(BODY, [prism()], **options)  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def ferry() -> Sfolds:
    """The ship that comes with the package."""
    found = classical_ship("sfolds_ship")
    assert isinstance(found, Sfolds)
    return found


@pytest.fixture(scope="module")
def hull(ferry: Sfolds) -> ah.Hull:
    """Its net."""
    return ah.create(ferry)


def test_the_volume_by_hand() -> None:
    """363.0914583 m2 over 32 m, to full height; and without the camber, up to the deck side."""
    found = body()
    assert round(found.volume, 4) == 11618.9267
    assert found.centre[0] == pytest.approx(16.0, rel=1e-14)
    assert found.volume_below(12.4) == pytest.approx(
        (363.0914583333 - 8.1066666667) * 32, rel=1e-12
    )


@pytest.mark.parametrize(("corner", "near"), [(10.0, 1e-4), (0.0, 2e-5)])
def test_the_net_of_the_portion_has_its_volume(corner: float, near: float) -> None:
    """With the corner at the bilge kept, within 1e-4; with all corners kept, within 2e-5."""
    ship = body(corner=corner)
    made = ah.create(ship)
    assert made.check() == ()
    report = ship.report(made.state)
    for name in ("the draught 9 m", "the lowest deck side 12.4 m"):
        figure = report.figure(f"main body below {name}: volume")
        assert figure.net == pytest.approx(figure.value, rel=near), name
    centre = report.figure("main body below the draught 9 m: centre x")
    assert centre.net == pytest.approx(16.0, abs=1e-9)
    assert report.worst is not None
    assert report.worst.distance < (0.08 if corner else 0.004)


def test_a_net_without_its_corner_is_ten_times_as_far() -> None:
    """Why corners sharper than ten degrees stay: a smooth bilge has 1e-3 more."""
    ship = body(corner=90.0)
    below = ship.report(ah.create(ship).state).figure("main body below the draught 9 m: volume")
    assert below.net is not None
    assert 1e-3 < below.net / below.value - 1.0 < 2e-3


def test_the_shipped_ferry_is_sound(ferry: Sfolds, hull: ah.Hull) -> None:
    """Nothing is found; volumes and centres of net and definition agree to 4e-4."""
    assert hull.check() == ()
    assert hull.adoption is not None
    assert hull.adoption.notes == ()
    report = ferry.report(hull.state)
    beside = [each for each in report.figures if each.net is not None]
    assert len(beside) == 4
    for each in beside:
        assert each.net == pytest.approx(each.value, rel=4e-4), each.name
    assert len(report.departures) == 30
    assert max(each.distance for each in report.departures) < 0.03
    assert max(abs(each.net - each.area) for each in report.departures) < 0.011


def test_the_net_passes_all_given_points(ferry: Sfolds, hull: ah.Hull) -> None:
    """Within 0.1 mm, which a waterline that is cut may bend its sections by."""
    for frame in portion_frames(ferry.portions)[1:-1:3]:
        (curve,) = hull.lines[f"ST {frame.x:g}"].curves
        for y, z in frame.section.outline().tolist():
            assert curve.closest((frame.x, y, z))[2] < 1e-4


def test_the_net_is_associative(hull: ah.Hull) -> None:
    """Sections make waterlines and buttocks; a point that is pulled leaves a sound hull."""
    assert {group: len(each.lines) for group, each in hull.groups.items()} == {
        "boundary": 3, "sections": 29, "waterlines": 8, "buttocks": 3
    }  # fmt: skip
    before = hull.fingerprint
    with hull.edit("pull") as edit:
        edit.pull("WL 5 x ST 53", 0.02, radius=(8.0, 3.0))
    assert hull.check() == ()
    assert hull.fingerprint != before
    hull.undo()
    assert hull.fingerprint == before


def test_numbers_are_sums_over_portions(ferry: Sfolds) -> None:
    """Main body, other bodies and whole; the report tells each portion."""
    report = ferry.report()
    volumes = [each.volume for each in ferry.portions]
    assert report.figure("main body: volume, with camber").value == pytest.approx(sum(volumes[:6]))
    assert report.figure("other bodies: volume").value == pytest.approx(sum(volumes[6:]))
    assert report.figure("whole: volume, with camber").value == pytest.approx(ferry.volume)
    assert report.figure("7. forecastle: volume").value == pytest.approx(volumes[6])
    moment = sum(each.volume * each.centre_x for each in ferry.portions)
    assert report.figure("whole: centre x").value == pytest.approx(moment / ferry.volume)
    assert "6. bow: volume" in str(report)
    assert all(each.net is None for each in report.figures)


def test_other_bodies_are_told_and_left_out_of_the_net(ferry: Sfolds) -> None:
    """A note each; the lines are those of the main body."""
    assert ferry.notes == (
        "portion 12 (forecastle) is a body of its own: its volume is given here, "
        "and it is outlined beside the net",
        "portion 13 (bossing) is a body of its own: its volume is given here, "
        "and it is outlined beside the net",
    )
    assert len([each for each in ferry.lines() if each.group == "sections"]) == 29


def test_oddities_of_a_section_are_noted_once() -> None:
    """With the place where it stands first."""
    odd = OrdinateSection.make(
        hb=0, sb=1, sw=2, hd=3.5, bd=5, cam=0.1, zb=[0], yw=[3, 4, 5]
    )  # fmt: skip
    found = Sfolds.make(BODY, [Portion.make(3, X, [odd] * 5)])
    assert found.notes == (
        "section: y(hd)=4.75 at the deck side differs from bd=5 by more than 0.001 bd, at x=0 of "
        "portion 3",
    )


def test_a_net_that_cannot_be_measured_is_noted() -> None:
    """One section between two flat ends makes a net, but no hydrostatics."""
    ship = Sfolds.make(BODY, [Portion.make(3, X[:3], [SECTION] * 3)])
    report = ship.report(ah.create(ship).state)
    assert report.notes == ("the net cannot be measured: 1 section(s)",)
    assert report.figures[-1].net is None
    assert len(report.departures) == 3


def test_gaps_are_noted_and_bridged() -> None:
    """The net runs on between the sections on both sides."""
    ship = Sfolds.make(BODY, [prism(), prism(5, 40.0)])
    assert ship.notes == ("portions 3 and 5 of the main body leave a gap in x: [32,40]",)
    assert [frame.x for frame in portion_frames(ship.portions)] == [*X, *(X + 40.0)]


def test_a_joint_is_one_section() -> None:
    """Where one portion ends and the next begins."""
    ship = Sfolds.make(BODY, [prism(4, 32.0), prism()])
    assert [frame.x for frame in portion_frames(ship.portions)] == [*X, *(X[1:] + 32.0)]


def test_a_ship_of_areas_alone_tells_its_volume() -> None:
    """There are no lines, and no volume below a draught."""
    ship = Sfolds.make(BODY, [Portion.of_areas(3, X, [120.0, 160.0, 185.0, 190.0, 178.0])])
    assert ship.report().figure("main body: volume, with camber").value == pytest.approx(
        5514.6666667
    )
    assert ship.report().figure("whole: centre x").value == pytest.approx(16.91295938)
    assert len(ship.report().figures) == 5
    assert ship.cuts == {"waterlines": (), "buttocks": ()}


def test_planes_are_those_of_the_widest_section() -> None:
    """Waterlines above the bottom part and one at the draught, buttocks; or those asked for."""
    assert body().cuts["waterlines"] == pytest.approx((2.9, 4.9, 6.9, 8.9, 10.9))
    assert body().cuts["buttocks"] == (3.0, 6.0, 9.0, 12.0)
    deep = Sfolds.make(attrs.evolve(BODY, draught=6.0), [prism()])
    assert deep.cuts["waterlines"] == pytest.approx((2.9, 4.9, 6.0, 6.9, 8.9, 10.9))
    asked = Sfolds.make(BODY, [prism()], cuts={"waterlines": [5.0]})
    assert asked.cuts == {"waterlines": (5.0,), "buttocks": (3.0, 6.0, 9.0, 12.0)}


def test_corners_of_a_section_stay_where_they_are_sharp() -> None:
    """At ten degrees that at the foot of the main part; at nil all even ordinates."""
    points, kind = section_points(SECTION, 10.0)
    assert points[kind == 2].tolist() == [[12.3, 0.9]]
    points, kind = section_points(SECTION, 0.0)
    assert points[kind == 2][:, 1].tolist() == pytest.approx([0.1, 0.8, 0.9, 4.9, 8.9])
    assert len(points) == 4 * 11 + 1


def test_straight_runs_stay_straight() -> None:
    """A curve is tangent to a run; two runs that meet, and sharp turns, have a knuckle."""
    runs = [[0, 0, 5], [10, 0, 1], [20, 0, 0], [30, 0, 0], [40, 0, 0], [50, 0, 10]]
    kind, direction = point_kinds_along(runs, 30.0)
    assert kind.tolist() == [0, 0, 1, 0, 2, 0]
    assert direction[2].tolist() == [1.0, 0.0, 0.0]
    level = [[0, 0, 0], [10, 0, 0], [20, 0, 0], [30, 0, 3], [40, 0, 6]]
    assert point_kinds_along(level, 30.0)[0].tolist() == [0, 0, 2, 0, 0]
    assert point_kinds_along(level[:2], 30.0)[0].tolist() == [0, 0]


def narrow(y: float) -> OrdinateSection:
    """A section of half the breadth `y` at all heights."""
    return OrdinateSection.make(hb=0, sb=1, sw=2, hd=3.5, bd=y, cam=0, zb=[0], yw=[y, y, y])


REFUSED: dict[str, tuple[Callable[[], object], str]] = {
    "no portion": (lambda: Sfolds.make(BODY, []), "a ship of portions has none"),
    "overlap": (
        lambda: Sfolds.make(BODY, [prism(), prism(4, 24.0)]),
        "portions 3 and 4 of the main body overlap in x: [24,32]",
    ),
    "other planes": (
        lambda: Sfolds.make(BODY, [prism()], cuts={"sections": [1.0]}),
        "a net is not cut by 'sections'",
    ),
    "a step at a joint": (
        lambda: Sfolds.make(BODY, [prism(), Portion.make(4, X + 32.0, [narrow(4.0)] * 5)]).lines(),
        "sections of two portions differ at x=32",
    ),
    "no breadth": (
        lambda: Sfolds.make(BODY, [Portion.make(3, X, [narrow(0.0)] * 5)]).lines(),
        "main body: 0 section(s) with a breadth",
    ),
    "no breadth amidships": (
        lambda: Sfolds.make(BODY, [Portion.make(3, X, [*map(narrow, (3, 2, 0, 2, 3))])]).lines(),
        "section at x=16 has no breadth, and the hull goes on beyond",
    ),
    "lines of areas alone": (
        lambda: Sfolds.make(BODY, [Portion.of_areas(3, X, [1.0] * 5)]).lines(),
        "portion 3: no sections, only areas",
    ),
    "no main body": (
        lambda: Sfolds.make(BODY, [Portion.make(12, X, [narrow(2.0)] * 5)]).lines(),
        "main body: 0 section(s) with a breadth",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_makes_no_ship_is_refused(case: str) -> None:
    """With these words."""
    call, what = REFUSED[case]
    with pytest.raises(GeometryError) as caught:
        call()
    assert caught.value.what == what


def test_a_hull_that_ends_on_its_stem() -> None:
    """Sections without breadth at the ends: the profile runs up there, no flat end is made."""
    breadth = [0.0, 3.0, 4.0, 3.0, 0.0]
    ship = Sfolds.make(
        attrs.evolve(BODY, depth=3.5, draught=2.0), [Portion.make(3, X, [*map(narrow, breadth)])],
        cuts={"waterlines": [1.0, 2.0], "buttocks": []},
    )  # fmt: skip
    names = [each.name for each in ship.lines()]
    assert names == ["profile", "deck edge", "ST 8", "ST 16", "ST 24"]
    keel = [[x, 0.0, 0.0] for x in X.tolist()]
    assert ship.lines()[0].points.tolist() == [[0.0, 0.0, 3.5], *keel, [32.0, 0.0, 3.5]]
    assert ah.create(ship).check() == ()
