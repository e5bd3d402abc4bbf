"""A length of parallel body inserted or taken out: what moves, what stays, what is refused."""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import AssocHullError, BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation import Jumboised
from tests.conftest import Shipped


def _sections(hull: ah.Hull) -> dict[str, float]:
    return {name: line.position or 0.0 for name, line in hull.groups["sections"].lines.items()}


def _points(hull: ah.Hull, line: str) -> FloatArray:
    return np.concatenate([
        [point.position for point in curve.points] for curve in hull.lines[line].curves
    ])  # fmt: skip


def _volume_ahead(parent: ah.Hull, found: Jumboised) -> float:
    """Give the volume forward of the cut, m3, by how the moment about the AP has grown."""
    report, now, after = found.report, parent.hydrostatics(), found.hull.hydrostatics()
    grown = after.volume * after.lcb - now.volume * now.lcb
    own = report.area * report.length * (report.at + 0.5 * report.length)
    return (grown - own) / report.length


@pytest.fixture(scope="module")
def longer(bulk_carrier: ah.Hull) -> Jumboised:
    """The bulk carrier with 75 m more."""
    return bulk_carrier.jumboise(75.0, at=150.0)


def test_the_fore_part_moves_as_a_whole(bulk_carrier: ah.Hull, longer: Jumboised) -> None:
    """Every point that was forward of the cut: half-breadth and height to the bit."""
    before, after = bulk_carrier.state.rows, longer.hull.state.rows
    live = bulk_carrier.state.live("rows")
    was, now = before.xyz[live], after.xyz[live]
    fore = was[:, 0] > 150.0
    assert (now[:, 1:] == was[:, 1:]).all()
    assert (now[~fore] == was[~fore]).all()
    assert np.abs(now[fore, 0] - was[fore, 0] - 75.0).max() < 1e-12
    assert longer.report.moved_off < 1e-12
    # So do the lines between the points.
    for x, z in ((271.3, 7.0), (302.0, 9.0), (212.0, 1.0)):
        assert longer.hull.half_breadth(x + 75.0, z) == pytest.approx(
            bulk_carrier.half_breadth(x, z), abs=1e-12
        )
    ship = longer.hull.particulars
    assert (ship.length, ship.breadth, ship.draught) == (375.0, 50.0, 18.0)


def test_volume_grows_by_length_times_section(bulk_carrier: ah.Hull, longer: Jumboised) -> None:
    """And its centre moves by the moment of the parts."""
    before, after = bulk_carrier.hydrostatics(), longer.hull.hydrostatics()
    assert after.volume - before.volume == pytest.approx(75.0 * longer.report.area, rel=1e-12)
    assert longer.report.volume == (before.volume, after.volume)
    ahead = _volume_ahead(bulk_carrier, longer)
    for length, at in ((12.0, 150.0), (12.0, 180.0), (30.0, 180.0)):
        other = _volume_ahead(bulk_carrier, bulk_carrier.jumboise(length, at))
        assert ahead - other == pytest.approx(longer.report.area * (at - 150.0), abs=1e-3)
    # There and back: the centre is where it was.
    back = longer.hull.jumboise(-75.0, at=150.0)
    assert back.hull.hydrostatics().lcb == pytest.approx(before.lcb, abs=1e-9)
    assert back.hull.hydrostatics().volume == pytest.approx(before.volume, rel=1e-12)
    assert set(_sections(back.hull)) == set(_sections(bulk_carrier))


def test_sections_come_at_the_spacing_there_was(bulk_carrier: ah.Hull, longer: Jumboised) -> None:
    """Each the same as the one at the cut to the bit, with its features."""
    hull = longer.hull
    assert longer.report.added == ("ST 10+30", "ST 10+60", "ST 10+75")
    where = _sections(hull)
    assert [where[name] for name in longer.report.added] == [180.0, 210.0, 225.0]
    model = _points(bulk_carrier, "ST 10")
    for name in longer.report.added:
        assert (_points(hull, name)[:, 1:] == model[:, 1:]).all()
        features = [each for each in hull.features if each.startswith(name)]
        assert len(features) == sum(each.startswith("ST 10 ") for each in bulk_carrier.features)
    assert hull.measure()["parallel_body_end"] == bulk_carrier.measure()["parallel_body_end"] + 75.0


def test_it_is_one_sound_step(bulk_carrier: ah.Hull, longer: Jumboised) -> None:
    """Nothing is found by `check`, nothing differs when all is made anew; undo is to the bit."""
    hull = longer.hull
    assert hull.check() == ()
    assert hull.verify() == ()
    assert len(hull.history) == 1
    made = hull.fingerprint
    hull.undo()
    assert hull.fingerprint == bulk_carrier.fingerprint
    hull.redo()
    assert hull.fingerprint == made
    assert bulk_carrier.jumboise(75.0, at=150.0).hull.fingerprint == made


@pytest.mark.parametrize(
    ("length", "at", "gone", "cut"),
    [(-12.0, None, (), "ST 10"), (-30.0, 150.0, ("ST 12",), "ST 10"),
     (-60.0, 190.0, ("ST 10", "ST 12"), "ST 8"), (-29.95, 150.0, ("ST 12",), "ST 10")],
    ids=["between", "to a section", "no room forward", "sections that meet become one"],
)  # fmt: skip
def test_a_length_is_taken_out(
    bulk_carrier: ah.Hull, length: float, at: float | None, gone: tuple[str, ...], cut: str
) -> None:
    """With the sections on it; the rest keeps its shape."""
    found = bulk_carrier.jumboise(length, at)
    report, hull = found.report, found.hull
    assert (report.removed, report.added, report.section) == (gone, (), cut)
    assert report.volume[1] - report.volume[0] == pytest.approx(length * report.area, rel=1e-7)
    assert report.moved_off < 1e-9
    assert hull.particulars.length == 300.0 + length
    assert hull.check() == ()
    assert hull.verify() == ()
    hull.undo()
    assert hull.fingerprint == bulk_carrier.fingerprint


def test_sections_are_numbered_by_the_new_length(bulk_carrier: ah.Hull) -> None:
    """By twentieths of Lpp, as they were; each then says where it stands."""
    found = bulk_carrier.jumboise(12.0, names="number")
    for name, x in _sections(found.hull).items():
        assert float(name.removeprefix("ST ")) == pytest.approx(x * 20.0 / 312.0, abs=6e-4)
    assert found.report.renamed["ST 12"] == "ST 12.308"
    assert found.report.added == ("ST 10.385",)
    features = [each for each in found.hull.features if each.startswith("ST 12.308 ")]
    assert features


def test_a_parallel_body_without_flats_is_cut(series60_70: ah.Hull) -> None:
    """Its lines are not quite straight there: they swing within the new piece, and nowhere else."""
    found = series60_70.jumboise(6.0)
    report, hull = found.report, found.hull
    assert report.volume[1] - report.volume[0] == pytest.approx(6.0 * report.area, rel=1e-8)
    for name in ("WL 0.075", "WL 0.25", "WL 1"):
        z = series60_70.groups["waterlines"].lines[name].position or 0.0
        for x in (50.0, 64.0, 69.0, 90.0):
            moved = hull.half_breadth(x + (6.0 if x > 60.96 else 0.0), z)
            assert moved == pytest.approx(series60_70.half_breadth(x, z), abs=2e-6)
    assert hull.check() == ()
    with pytest.raises(OutOfRangeError, match=r"parallel body, which is 6.096 m long"):
        series60_70.jumboise(-7.0)


def test_a_hull_without_parallel_body_is_cut_where_its_waterlines_are_parallel(
    container: ah.Hull,
) -> None:
    """At the largest section, which the refusal names; following it works."""
    with pytest.raises(BadInputError, match=r"give at=112\.5: there ST 10 stands"):
        container.jumboise(14.0)
    _cut(container, 112.5)


def test_a_parallel_body_that_adoption_knows_no_nearer_is_cut(dtc: ah.Hull) -> None:
    """The two sections in it are 6.6 mm apart."""
    _cut(dtc, 165.14)


def _cut(hull: ah.Hull, x: float) -> None:
    """Insert 14 m: volume grows by the section, and undo brings the hull back."""
    found = hull.jumboise(14.0, at=x)
    report = found.report
    assert report.volume[1] - report.volume[0] == pytest.approx(14.0 * report.area, rel=1e-8)
    assert all("detached" in str(each) for each in found.hull.check())
    assert found.hull.verify() == ()
    found.hull.undo()
    assert found.hull.fingerprint == hull.fingerprint


@pytest.fixture
def container(shipped: Shipped) -> ah.Hull:
    """The container ship; it is only read."""
    return shipped("container_ship_225m")


@pytest.mark.parametrize(
    ("asked", "says"),
    [
        ({"length": 0.0}, "a length of 0 m, in jumboise; give 0.1 m or more to insert"),
        ({"length": -95.0}, "length of -95 m is more than the parallel body, which is 90.5 m long"),
        ({"length": 5.0, "at": 230.0}, "at of 230 m lies outside the parallel body"),
        ({"length": 5.0, "names": "new"}, "names is 'new', in jumboise; use keep or number"),
        ({"length": float("nan")}, "length is nan"),
    ],
    ids=["nothing", "too much", "elsewhere", "names", "nan"],
)
def test_what_cannot_be_done_is_refused(
    bulk_carrier: ah.Hull, asked: dict[str, object], says: str
) -> None:
    """In words that tell what can; the hull is as it was."""
    before = bulk_carrier.fingerprint
    with pytest.raises(AssocHullError, match=says):
        bulk_carrier.jumboise(in_place=True, **asked)  # type: ignore[arg-type]
    assert bulk_carrier.fingerprint == before


def test_curved_waterlines_are_not_cut(series60_60: ah.Hull) -> None:
    """They would have a corner at both ends of the piece."""
    with pytest.raises(BadInputError, match=r"waterlines leave the parallel by 0.74 degrees"):
        series60_60.jumboise(5.0, at=60.96)


def test_it_goes_on_with_variations(bulk_carrier: ah.Hull) -> None:
    """A longer ship is a parent like any other."""
    hull = bulk_carrier.jumboise(20.0, at=150.0).hull
    varied = hull.vary(set={"breadth": 51.0, "draught": 18.5}, in_place=True)
    assert varied.hull.measure()["breadth"] == pytest.approx(51.0, abs=1e-6)
    assert varied.hull.check() == ()
    hull.undo(2)
    assert hull.fingerprint == bulk_carrier.fingerprint


def test_one_section_is_cut_again_and_again(bulk_carrier: ah.Hull) -> None:
    """A copy's usual name may have gone to one made before, which has moved on; the next is free.

    All are numbered by their places when that is asked for.
    """
    once = bulk_carrier.jumboise(30.0, at=150.0)
    twice = once.hull.jumboise(30.0, at=150.0)
    assert (once.report.added, twice.report.added) == (("ST 10+30",), ("ST 10+30(2)",))
    where = _sections(twice.hull)
    assert (where["ST 10+30"], where["ST 10+30(2)"]) == (210.0, 180.0)
    thrice = twice.hull.jumboise(30.0, at=150.0, names="number").hull
    for name, x in _sections(thrice).items():
        assert float(name.removeprefix("ST ")) == pytest.approx(x * 20.0 / 390.0, abs=6e-4)
    assert thrice.check() == ()
    assert thrice.verify() == ()
