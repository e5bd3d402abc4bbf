"""A middle body of the midship section: the definition exact, its net beside it."""

from __future__ import annotations

import json

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.creation.classical.classical_net import classical_net
from assoc_hull.creation.classical.line_outline import (
    PlaneOutline,
    circular_piece,
    smooth_piece,
    straight_piece,
)
from assoc_hull.creation.classical.middle_body import MiddleBody, Midship, midship_outline
from assoc_hull.creation.classical.report import DefinedSection, departures
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs
from assoc_hull.geometry.curves import PointKind
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.model.line_source import line_curve_data

MIDSHIP = Midship(16.0, 2.0, 0.3, 2.5)
VOLUME = 11249.94226


@pytest.fixture(scope="module")
def body() -> MiddleBody:
    """Forty metres of it."""
    return MiddleBody(MIDSHIP, length=40.0, depth=14.0, draught=9.0)


@pytest.fixture(scope="module")
def hull(body: MiddleBody) -> ah.Hull:
    """Its net."""
    return ah.Hull(classical_net(body)[0])


def test_a_middle_body_has_the_volume_by_hand(body: MiddleBody) -> None:
    """281.2485565 m2 over 40 m, to every printed digit."""
    assert f"{body.volume(9.0):.5f}" == f"{VOLUME:.5f}"


def test_the_net_of_a_middle_body_is_sound_and_has_its_volume(
    body: MiddleBody, hull: ah.Hull
) -> None:
    """No finding; to 1e-7 of the volume, the bilge being points on a circle."""
    assert hull.check() == ()
    found = hull.hydrostatics(draught=9.0)
    assert found.volume == pytest.approx(body.volume(9.0), rel=1e-7)
    figure = body.report(hull.state).figure("volume")
    assert figure.net == pytest.approx(found.volume, rel=1e-12)


def test_the_net_of_a_middle_body_is_associative(hull: ah.Hull) -> None:
    """Sections, waterlines and buttocks meet; both ends are boundary lines."""
    assert {
        len(hull.groups[each].lines) > 2 for each in ("sections", "waterlines", "buttocks")
    } == {True}
    assert {"aft end", "fore end", "flat of bottom", "bilge below"} <= set(hull.lines)


def test_sections_of_the_net_stay_on_the_definition(body: MiddleBody, hull: ah.Hull) -> None:
    """Within a hundredth of a millimetre, and their areas to 1e-7."""
    bilge = MIDSHIP.bilge()
    assert bilge is not None
    uv = bilge.at(np.zeros(200, np.int64), np.linspace(0.0, bilge.length[0], 200))
    half = 0.5 * MIDSHIP.area(14.0)
    name = next(each for each in hull.lines if each.startswith("FR"))
    x = float(hull.state.lines.offset[hull.lines[name].row])
    found = departures(hull.state, [DefinedSection(name, np.insert(uv, 0, x, axis=1), half)])
    assert found[0].distance < 1e-5
    assert found[0].net == pytest.approx(half, rel=1e-7)


@pytest.mark.parametrize("radius", [0.05, 0.4, 2.5, 12.0])
@pytest.mark.parametrize("turn", [0.1, 1.0, 1.5, 3.0])
def test_an_arc_of_points_stays_within_what_is_asked(radius: float, turn: float) -> None:
    """The kernel's curve through them leaves the circle by less than a hundredth of a mm."""
    arc = PlaneArcs.make([[3.0, 1.0]], [0.3], [1.0 / radius], [radius * turn])
    line = PlaneOutline.of([circular_piece(arc, within=1e-5)]).section("FR", 0.0)
    places = sample(loft(line_curve_data([line])), 16)[1][:, 1:]
    away = np.hypot(*(places - arc.centres()[0]).T) - radius
    assert np.abs(away).max() < 1e-5


def test_pieces_meet_as_their_directions_say() -> None:
    """One direction makes a tangent point, two make a knuckle, as does one that is not known."""
    line = PlaneOutline.of(
        [
            straight_piece((0, 0), (2, 0)),
            smooth_piece([(2, 0), (4, 1), (5, 3)], start=0.0),
            straight_piece((5, 3), (5, 6)),
            straight_piece((5, 6), (9, 6)),
        ]
    )
    assert line.kind.tolist() == [
        0, PointKind.TANGENT, 0, PointKind.KNUCKLE, PointKind.KNUCKLE, 0,
    ]  # fmt: skip
    assert line.direction[1].tolist() == [1.0, 0.0]


def test_a_chine_is_a_middle_body_without_a_bilge() -> None:
    """A box: its outline has three points."""
    box = Midship(10.0, 0.0, 0.0, 0.0)
    assert midship_outline(box, 12.0).points.tolist() == [[0, 0], [10, 0], [10, 12]]
    assert MiddleBody(box, length=100.0, depth=12.0, draught=6.0).volume(6.0) == 12000.0


def test_a_middle_body_of_impossible_dimensions_is_refused() -> None:
    """One line, with what to do."""
    with pytest.raises(ah.errors.BadInputError, match="let bilge < draught <= depth"):
        MiddleBody(MIDSHIP, length=40.0, depth=14.0, draught=15.0)
    with pytest.raises(ah.errors.BadInputError, match="length"):
        MiddleBody(MIDSHIP, length=0.0, depth=14.0, draught=9.0)


def test_a_report_is_plain_values_too(body: MiddleBody) -> None:
    """It goes to JSON, and prints a line for each number."""
    report = body.report()
    assert json.loads(json.dumps(report.as_dict()))["figures"][0]["value"] == body.volume(9.0)
    assert str(report).count("\n") == 3
    with pytest.raises(ah.errors.UnknownNameError):
        report.figure("none")
