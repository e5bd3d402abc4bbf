"""The net of a design: what is generated, who drives whom, how near it is to the definitions."""

from __future__ import annotations

from typing import Any

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.creation.design_net import LINKS
from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.hull import Hull
from assoc_hull.model.forms.closure import coefficients
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.shipped.plain_ship import plain_ship_design

DESIGN = plain_ship_design()


def small(**changes: Any) -> ah.creation.Design:
    """The plain ship with few lines."""
    few: dict[str, Any] = {"stations": (0.0, 5.0, 10.0), "waterlines": (3.6,), "buttocks": ()}
    return attrs.evolve(DESIGN, **{**few, **changes})


def test_the_net_is_sound(plain_ship: Hull) -> None:
    """Nothing is found, and all that is derived can be made again."""
    assert plain_ship.check() == ()
    assert plain_ship.verify() == ()
    assert plain_ship.adoption is not None
    assert plain_ship.adoption.notes == ()


def test_the_definitions_are_the_hulls(plain_ship: Hull) -> None:
    """By name, as the design has them."""
    assert dict(plain_ship.definitions) == {each.name: each for each in DESIGN.definitions}


def test_every_line_of_the_design_is_there(plain_ship: Hull) -> None:
    """Sections are named by station, waterlines and buttocks by metres."""
    lines = set(plain_ship.lines)
    assert {"profile", "deck edge", "transom", "ST -0.4", "ST 19.5"} < lines
    assert {f"WL {z:g}" for z in DESIGN.waterlines} < lines
    assert {f"BTK {y:g}" for y in DESIGN.buttocks} < lines
    assert len(lines) == 3 + sum(
        len(each) for each in (DESIGN.stations, DESIGN.waterlines, DESIGN.buttocks)
    )


def test_points_of_sections_are_adopted_ones_between_two_contacts(plain_ship: Hull) -> None:
    """Nothing is placed: the designer has not drawn yet. Ends are driven by the boundary."""
    state = plain_ship.state
    assert not (state.rows.sort[state.live("rows")] == Sort.PLACED).any()
    for each in state.generated:
        rows = state.curves.rows[each.curve]
        assert each.attached
        assert set(each.rows) <= set(rows.tolist())
        if each.what != "section":
            continue
        assert tuple(rows[1:-1].tolist()) == each.rows
        assert (state.rows.role[rows[[0, -1]]] == Role.DRIVES_B).all()


def test_points_are_driven_one_way(plain_ship: Hull) -> None:
    """Boundary curves and sections are made of nothing but definitions and what bounds them."""
    assert plain_ship.state.associations == tuple(sorted(LINKS, key=lambda each: (each.a, each.b)))
    drawn = {each.curve for each in plain_ship.state.generated if each.what != "waterline"}
    state = plain_ship.state
    for curve in drawn:
        rows = state.curves.rows[curve]
        sort = state.rows.sort[rows]
        inner = sort[1:-1]
        assert (inner == Sort.ADOPTED).all()


def test_the_net_has_what_the_closure_says(plain_ship: Hull) -> None:
    """Block coefficient within 0.05 %, its centre within 2 cm; the waterline likewise."""
    report = plain_ship.creation
    closed = coefficients(DESIGN.definition("sectional_area"), DESIGN.particulars)
    assert report.figure("CB").closure == closed.block == pytest.approx(0.68, abs=1e-12)
    assert report.figure("LCB").closure == pytest.approx(-0.6, abs=1e-12)
    assert report.figure("CB").net == pytest.approx(0.68, rel=5e-4)
    assert report.figure("LCB").net == pytest.approx(-0.6, abs=0.02)
    assert report.figure("CW").net == pytest.approx(0.8, rel=5e-4)
    assert report.figure("LCF").difference == pytest.approx(0.0, abs=0.02)


def test_sections_have_the_areas_of_the_curve(plain_ship: Hull) -> None:
    """To a millionth of each; beyond the ends of the curve none is wanted."""
    for each in plain_ship.creation.sections:
        if each.x < 0.0:
            assert np.isnan(each.wanted)
        else:
            assert each.area == pytest.approx(each.wanted, rel=1e-6)


def test_hydrostatics_trust_the_net(plain_ship: Hull) -> None:
    """Two routes to the volume agree, so that no doubt is told; abaft AP lies a little more."""
    found = plain_ship.hydrostatics(draught=7.2)
    assert 0.6800 < found.cb < 0.6815


def test_waterlines_run_straight_along_the_flat(plain_ship: Hull) -> None:
    """Between the two generated points a waterline keeps its half-breadth to rounding."""
    state = plain_ship.state
    made = {each.curve: each for each in state.generated if each.what == "waterline"}
    for curve in plain_ship.lines["WL 5.4"].curves:
        number = next(i for i in made if state.curves.key[i] == curve.id)
        aft, fore = state.rows.xyz[list(made[number].rows)]
        assert aft[1] == fore[1] == 9.0
        met = intersect_planes(
            state.spline(number), np.array([1.0, 0.0, 0.0]), np.linspace(aft[0], fore[0], 40)[1:-1]
        )
        assert np.abs(met.xyz[:, 1] - 9.0).max() < 1e-12


def test_the_same_design_gives_the_same_bits() -> None:
    """Also if the definitions come in another order."""
    one = ah.create(small())
    other = ah.create(small(definitions=DESIGN.definitions[::-1]))
    assert one.fingerprint == other.fingerprint
    assert ah.create(ah.creation.Design.from_json(small().to_json())).fingerprint == one.fingerprint


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        pytest.param({"stations": (10.0, 40.0)}, "no hull, at station 40", id="no hull there"),
        pytest.param({"stations": (10.0, 20.5)}, "station 20.5", id="at the very end"),
    ],
)
def test_stations_that_cannot_be(changes: dict[str, object], words: str) -> None:
    """The station is named."""
    with pytest.raises(BadInputError, match=words):
        ah.create(small(**changes))


def test_an_area_that_no_section_has() -> None:
    """The error names the station, the area that is wanted, and what there can be."""
    line = DESIGN.definition("design_waterline").having({"entrance_area": 0.12})
    with pytest.raises((OutOfRangeError, BadInputError)) as caught:
        ah.create(small(definitions=DESIGN.having(line).definitions, stations=(10.0, 17.0)))
    assert "x = 102" in str(caught.value) or "design waterline" in str(caught.value)


def test_a_report_is_for_hulls_with_definitions() -> None:
    """Others have nothing to be set beside."""
    with pytest.raises(BadInputError, match="no definitions"):
        _ = ah.examples.wigley(stations=5, waterlines=4).creation


def test_a_figure_by_name(plain_ship: Hull) -> None:
    """The report knows its figures, and says them as text and as plain values."""
    report = plain_ship.creation
    with pytest.raises(BadInputError, match="no figure 'KB'"):
        report.figure("KB")
    assert "ST 10" in str(report)
    assert report.data()["sections"][0]["wanted"] is None
