"""Form parameters read off hulls: the hull made again of them, refusals, notes."""

from collections.abc import Sequence

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.net.curve_net import gather_net
from assoc_hull.creation.design_reading import DesignReading
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.model.forms.closure import coefficients
from tests.conftest import Shipped
from tests.long_forms import long_form

SHIPS = [
    "series60_70",
    pytest.param("series60_60", marks=long_form),
    pytest.param("bulk_carrier", marks=long_form),
]
GOALS = (5e-3, 2e-3, 2.5e-3)
"""Of the volume, of Lpp for LCB, and root mean square distance of the breadth."""


@pytest.fixture(scope="module")
def reading(series60_70: ah.Hull) -> DesignReading:
    """What is read off Series 60 CB .70."""
    return series60_70.design()


@pytest.fixture(scope="module")
def again(reading: DesignReading) -> ah.Hull:
    """That ship made again; a test that edits it undoes its edits."""
    return ah.create(reading.design)


def distances_of_sections(parent: ah.Hull, other: ah.Hull) -> np.ndarray:
    """Give how far (m) places on sections lie from those of another hull, by station."""
    mine, theirs = gather_net(parent.state), gather_net(other.state)
    found = []
    for number in np.flatnonzero(np.array(mine.family) == "sections").tolist():
        same = np.flatnonzero(np.abs(theirs.x - mine.x[number]) < 1e-6).tolist()
        if not same:
            continue
        points = sample(mine.batch.curve(number), 4)[1]
        curves = [theirs.batch.curve(each) for each in same if theirs.family[each] == "sections"]
        found.append(np.min([closest_points(each, 0, points)[2] for each in curves], axis=0))
    return np.concatenate(found)


@pytest.mark.parametrize("ship", SHIPS)
def test_a_hull_is_made_again_of_its_own_form_parameters(
    ship: str, shipped: Shipped, request: pytest.FixtureRequest
) -> None:
    """Volume, centre of buoyancy and distance lie within what is asked of the method."""
    parent = shipped(ship)
    reading = request.getfixturevalue("reading") if ship == "series60_70" else parent.design()
    again = request.getfixturevalue("again") if ship == "series60_70" else ah.create(reading.design)
    before, after, main = parent.hydrostatics(), again.hydrostatics(), parent.particulars
    assert abs(after.volume / before.volume - 1.0) < GOALS[0]
    assert abs(after.lcb - before.lcb) < GOALS[1] * main.length
    off = distances_of_sections(parent, again)
    assert np.sqrt((off * off).mean()) < GOALS[2] * main.breadth
    assert again.check() == ()
    # Flats and the end of a bossing are no lines of a created ship; a note tells each other loss.
    left_out = sum("was left out" in note for note in reading.notes)
    borders = {"flat of bottom", "flat of side", "bossing end"} & set(parent.lines)
    assert len(again.lines) == len(parent.lines) - len(borders) - left_out
    assert left_out <= 2


@long_form
def test_the_dtc_is_made_again_of_her_own_form_parameters(dtc: ah.Hull) -> None:
    """With bulb, transom and an aperture of which the section is left out."""
    reading = dtc.design()
    again, main = ah.create(reading.design), dtc.particulars
    before, after = dtc.hydrostatics(), again.hydrostatics()
    assert abs(after.volume / before.volume - 1.0) < GOALS[0]
    assert abs(after.lcb - before.lcb) < GOALS[1] * main.length
    off = distances_of_sections(dtc, again)
    assert np.sqrt((off * off).mean()) < GOALS[2] * main.breadth
    assert [note.partition(" was left out")[0] for note in reading.notes] == ["ST 11.52"]


def test_areas_have_volume_and_centre_of_the_hull(
    reading: DesignReading, series60_70: ah.Hull
) -> None:
    """The curve of areas closes to them, whatever its fit leaves at stations."""
    ship = reading.design.particulars
    closed = coefficients(reading.design.definition("sectional_area"), ship)
    found = series60_70.hydrostatics()
    assert closed.block == pytest.approx(found.cb, abs=1e-8)
    assert closed.centroid == pytest.approx(found.lcb - 0.5 * ship.length, abs=1e-6)


def test_each_curve_has_a_residual(reading: DesignReading) -> None:
    """Of definitions and of sections; what is left out is told of with a reason."""
    names = [each.name for each in reading.residuals]
    assert names[:5] == ["profile", "deck_side", "deck_height", "flat_of_side", "flat_of_bottom"]
    assert {"sectional_area", "design_waterline", "bilge_radius"} < set(names)
    sections = [each for each in reading.residuals if each.name.startswith("ST ")]
    assert len(sections) == len(reading.design.stations) == 39
    assert max(each.rms for each in sections) < 0.035
    assert [note.partition(" was left out: ")[0] for note in reading.notes] == ["ST 0", "ST 20"]
    assert reading.residual("ST 10").unit == "m"
    assert "sectional_area" in str(reading)
    with pytest.raises(ah.errors.UnknownNameError, match="ST 21"):
        reading.residual("ST 21")


def test_a_bilge_radius_is_that_of_the_area(reading: DesignReading) -> None:
    """A midship section of flats and an arc has no other."""
    design = reading.design
    radius = design.definition("bilge_radius").value("body_y")
    full = design.definition("sectional_area").value("full")
    assert radius is not None
    ship = design.particulars
    assert full == pytest.approx(
        ship.breadth * ship.draught - (2.0 - 0.5 * np.pi) * radius**2, rel=1e-9
    )


def test_a_changed_value_does_what_it_says(again: ah.Hull) -> None:
    """More area of the run: the net has it, and no section of the entrance changes a bit."""
    areas = again.definitions["sectional areas"]
    old, fore = again.creation, bits_of(again, "ST 13", "ST 18")
    asked = (areas.value("run_area") or 0.0) * 1.002
    with again.edit("fuller run") as edit:
        edit.set_form("sectional areas", run_area=asked)
    try:
        new = again.creation
        for name in ("CB", "LCB"):
            closure = new.figure(name).closure - old.figure(name).closure
            net = new.figure(name).net - old.figure(name).net
            assert net == pytest.approx(closure, rel=0.05)
        assert bits_of(again, "ST 13", "ST 18") == fore
    finally:
        again.undo()


def bits_of(hull: ah.Hull, *names: str) -> list[bytes]:
    """Give the points of lines."""
    net = gather_net(hull.state)
    return [net.batch.curve(net.name.index(name)).xyz.tobytes() for name in names]


@pytest.mark.parametrize("change", [{"cb": 0.002}, {"lcb": -0.24}], ids=["fuller", "aft"])
def test_a_block_coefficient_or_centre_of_buoyancy_is_reached_by_a_swing(
    reading: DesignReading, again: ah.Hull, change: dict[str, float]
) -> None:
    """The net has the change that was asked of one of both, and the other as before."""
    ship = reading.design.particulars
    old = coefficients(reading.design.definition("sectional_area"), ship)
    was = {"cb": old.block or 0.0, "lcb": old.centroid}
    swung = reading.design.swung(**{name: was[name] + by for name, by in change.items()})
    before, after = again.hydrostatics(), ah.create(swung).hydrostatics()
    assert after.cb - before.cb == pytest.approx(change.get("cb", 0.0), abs=5e-5)
    assert after.lcb - before.lcb == pytest.approx(change.get("lcb", 0.0), abs=5e-3)


def test_a_swing_beyond_reason_is_refused(reading: DesignReading) -> None:
    """With what was asked for and what there is; nothing asked for changes nothing."""
    with pytest.raises(ah.errors.BadInputError, match="ask for less than this change"):
        reading.design.swung(cb=0.4, lcb=5.0)
    assert reading.design.swung() is reading.design


def test_a_design_that_was_read_is_kept_as_json(reading: DesignReading) -> None:
    """To the last bit."""
    text = reading.design.to_json()
    assert ah.creation.Design.from_json(text) == reading.design


def test_a_created_hull_gives_its_own_design(plain_ship: ah.Hull) -> None:
    """Nothing is read off, and the same hull comes of it."""
    reading = plain_ship.design()
    assert reading.residuals == ()
    assert "created from definitions" in reading.notes[0]
    assert ah.create(reading).fingerprint == plain_ship.fingerprint
    assert ah.create(reading.design).fingerprint == plain_ship.fingerprint


def test_a_hull_is_no_design(plain_ship: ah.Hull) -> None:
    """What is made of `hull.design()` is not made of the hull, nor of its method."""
    for given in (plain_ship, plain_ship.design):
        with pytest.raises(ah.errors.WrongTypeError, match=r"give a Design") as caught:
            ah.create(given)  # type: ignore[arg-type]
        assert "bound method" not in str(caught.value) or given is not plain_ship


def barge(
    stations: Sequence[float] = (5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0),
    leave_out: str = "", deck_end: float = 40.0, stem: float = 4.0,
) -> ah.Hull:  # fmt: skip
    """Give a hull of parabolas with upright ends, or one that lacks something."""
    along = np.linspace(0.0, 40.0, 9)
    breadth = 3.0 * (1.0 - ((along - 20.0) / 20.0) ** 2)
    deck = np.column_stack([along * deck_end / 40.0, breadth, np.full(9, 4.0)])
    profile: list[list[float]] = [[0, 0, 4], [0, 0, 0], [40, 0, 0], [40, 0, stem]]
    lines = [
        ah.LineSource.make(
            "boundary", "deck edge", deck, plane=((0, 0, 1), 4.0), boundary=ah.BoundaryKind.END
        ),
        ah.LineSource.make(
            "boundary", "profile", profile, plane=((0, 1, 0), 0.0),
            boundary=ah.BoundaryKind.END, kind=[0, ah.PointKind.KNUCKLE, ah.PointKind.KNUCKLE, 0],
        ),
    ]  # fmt: skip
    lines = [each for each in lines if each.name != leave_out]
    for x in stations:
        y = 3.0 * (1.0 - ((x - 20.0) / 20.0) ** 2)
        points = [[x, 0.0, 0.0], [x, 0.7 * y, 1.0], [x, 0.9 * y, 2.0], [x, y, 4.0]]
        lines.append(ah.LineSource.make("sections", f"ST {x:g}", points))
    ship = ah.Particulars("barge", 40.0, 6.0, 4.0, 3.0)
    return ah.Hull.from_lines(
        lines, particulars=ship, associations=[ah.Association("boundary", "sections")]
    )


@pytest.mark.parametrize(
    ("hull", "words"),
    [
        ({"leave_out": "deck edge"}, "there is no deck edge"),
        ({"leave_out": "profile"}, "there is no profile"),
        ({"stations": (10.0, 20.0, 30.0)}, "3 section"),
        ({"deck_end": 38.0, "stations": (5.0, 10.0, 15.0, 20.0, 25.0)}, "open ahead"),
        ({"stem": 2.0}, "open ahead"),
    ],
    ids=["no deck edge", "no profile", "few sections", "a gap at the bow", "a low stem"],
)
def test_a_hull_that_cannot_be_read_is_refused(hull: dict[str, object], words: str) -> None:
    """With what is missing, and what to do; the hull stays as it is."""
    made = barge(**hull)  # type: ignore[arg-type]
    before = made.fingerprint
    with pytest.raises(ah.errors.BadInputError, match=words):
        made.design()
    assert made.fingerprint == before


def test_a_hull_of_few_lines_that_flares_is_read() -> None:
    """Seven sections, no parallel part, and a waterline narrower than the breadth."""
    parent = barge()
    reading = parent.design()
    again = ah.create(reading.design)
    assert again.hydrostatics().volume == pytest.approx(parent.hydrostatics().volume, rel=1e-2)
    assert max(each.largest for each in reading.residuals if each.unit == "m") < 0.03
