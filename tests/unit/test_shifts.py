"""Section shifts and swinging on whole hulls: what is met, what stays, what is refused."""

import json
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.hydrostatics.record import Hydrostatics
from assoc_hull.errors import AssocHullError, BadInputError, OutOfRangeError
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.variation import Shifted
from assoc_hull.variation.comparing.line_fairness import compare_fairness, measure_fairness
from assoc_hull.variation.shifts.shift_hull import swung_dimensions
from tests.conftest import Shipped


@pytest.fixture(scope="module")
def parent(series60_70: ah.Hull) -> ah.Hull:
    """Series 60 .70; nothing here changes it."""
    return series60_70


@pytest.fixture(scope="module")
def fuller(parent: ah.Hull) -> Shifted:
    """Its variant: CB +.02 and LCB +.5 % Lpp together."""
    return parent.shift_sections(by={"cb": 0.02, "lcb_percent": 0.5})


@pytest.fixture(scope="module")
def wigley(shipped: Shipped) -> ah.Hull:
    """A hull without a parallel body; nothing here changes it."""
    return shipped("wigley")


def _measured(hull: ah.Hull) -> Hydrostatics:
    """The record, without the estimate of its errors."""
    return hull.hydrostatics(estimate=False)


def test_volume_and_centre_are_met_together(parent: ah.Hull, fuller: Shifted) -> None:
    """To 1e-10, by the hydrostatics of the net as anyone measures them."""
    before, after = _measured(parent), _measured(fuller.hull)
    assert after.cb - before.cb == pytest.approx(0.02, abs=1e-10)
    assert after.lcb_percent - before.lcb_percent == pytest.approx(0.5, abs=1e-10)
    assert [each.asked for each in fuller.report.targets] == pytest.approx(
        [before.cb + 0.02, before.lcb_percent + 0.5], abs=1e-12
    )
    assert fuller.report.residual < 1e-10


def test_newton_takes_few_steps_from_the_closed_form(fuller: Shifted) -> None:
    """The closed form is off by what lofting changes; a step leaves 1e-3 of that at most."""
    left = [step.residual for step in fuller.report.steps]
    assert left[0] < 1e-4
    assert all(after < 1e-3 * before for before, after in pairwise(left))


def test_the_end_profile_keeps_its_bits(parent: ah.Hull, fuller: Shifted) -> None:
    """Points and curves of stem and stern beyond the terminals, where `c2` leaves smoothly."""
    at = fuller.report.shift.terms.terminals
    profiles = [hull.lines["profile"].curves[0] for hull in (parent, fuller.hull)]
    points = [np.array([point.position for point in curve.points]) for curve in profiles]
    for sign, end in ((-1.0, at.aft), (1.0, at.fore)):
        ends = [each[sign * (each[:, 0] - end) >= 0.0] for each in points]
        assert len(ends[0]) > 10
        assert (ends[0] == ends[1]).all()
        drawn = [sample(curve.spline, 8)[1] for curve in profiles]
        beyond = [each[sign * (each[..., 0] - end) > -1e-9] for each in drawn]
        assert len(beyond[0]) >= 40
        assert (beyond[0] == beyond[1]).all()


def test_sections_keep_their_shape_to_the_last_bit(parent: ah.Hull, fuller: Shifted) -> None:
    """All that is no computed point keeps y and z, and moves along the ship by delta(x)."""
    rows = parent.state.rows
    live = parent.state.live("rows")
    own = live[(rows.driver[live] < 0) & (rows.role[live] != 3)]
    before, after = rows.xyz[own], fuller.hull.state.rows.xyz[own]
    assert len(own) > 1000
    assert (before[:, 1:] == after[:, 1:]).all()
    moved = before[:, 0] + fuller.report.shift.moved(before[:, 0])
    assert after[:, 0] == pytest.approx(moved, abs=1e-12)


def test_stations_stay_plane_and_in_order(parent: ah.Hull, fuller: Shifted) -> None:
    """They keep their names and stand where delta(x) takes them."""
    before = parent.groups["sections"].lines
    after = fuller.hull.groups["sections"].lines
    x = np.array([line.position or 0.0 for line in before.values()])
    moved = np.array([after[name].position for name in before])
    assert moved == pytest.approx(x + fuller.report.shift.moved(x), abs=1e-12)
    assert (np.diff(np.sort(x)) > 0.0).all()
    assert (np.diff(moved[np.argsort(x)]) > 0.0).all()


def test_lines_wave_no_more_than_before(parent: ah.Hull, fuller: Shifted) -> None:
    """Changes of the sign of curvature, over all waterlines."""
    fair = measure_fairness(parent.state)
    table = compare_fairness(fair, measure_fairness(fuller.hull.state, like=fair))
    assert table.added <= 0


def test_a_script_repeats_the_shift_to_the_last_bit(parent: ah.Hull, fuller: Shifted) -> None:
    """What was done is a variation by raw layers, also as text."""
    script = json.loads(json.dumps(dict(fuller.report.variation.script or {})))
    assert (
        parent.vary_by(script, ship=parent.particulars.name).hull.fingerprint
        == fuller.hull.fingerprint
    )


def test_it_is_one_step(wigley: ah.Hull) -> None:
    """A copy is shifted, or the hull itself; undo gives the parent back, to the last bit."""
    start, steps = wigley.fingerprint, len(wigley.history)
    copy = wigley.shift_sections(by={"lcb_percent": -0.4}, name="aft")
    assert (wigley.fingerprint, len(wigley.history)) == (start, steps)
    own = wigley.shift_sections(by={"lcb_percent": -0.4}, name="aft", in_place=True)
    assert own.hull is wigley
    assert wigley.fingerprint == copy.hull.fingerprint != start
    assert len(wigley.history) == steps + 1
    wigley.undo()
    assert wigley.fingerprint == start


def test_bodies_on_their_own(wigley: ah.Hull) -> None:
    """CP of the fore body as asked, that of the after body held; nothing aft of midship moves."""
    before = wigley.form_parameters(only=["Cpf", "Cpa"])
    found = wigley.shift_sections(by={"Cpf": 0.01}, shape="c1")
    after = found.hull.form_parameters(only=["Cpf", "Cpa"])
    gained = [(after[name].number or 0.0) - (before[name].number or 0.0) for name in before]
    assert gained == pytest.approx([0.01, 0.0], abs=1e-10)


def test_the_parallel_body_is_lengthened_alone(wigley: ah.Hull) -> None:
    """What stands for it: both its ends move as asked, volume and centre stay to 1e-10."""
    found = wigley.shift_sections(
        by={"parallel_body_start": -0.5}, to={"parallel_body_end": 57.0},
        terminals=[0.0, 45.0, 55.0, 100.0],
    )  # fmt: skip
    before, after = _measured(wigley), _measured(found.hull)
    assert after.volume == pytest.approx(before.volume, rel=1e-10)
    assert after.lcb == pytest.approx(before.lcb, abs=1e-8)
    ends = found.report.targets[2:]
    assert [(each.before, each.reached) for each in ends] == [(45.0, 44.5), (55.0, 57.0)]
    assert found.hull.lines["ST 9"].position == 44.5


def test_a_hull_without_parallel_body_says_what_stands_for_it(wigley: ah.Hull) -> None:
    """Its largest station, for shifts as for the named parameters; both tell it."""
    told = "no parallel middle body: the largest station stands for it, at 50 m"
    shifted = wigley.shift_sections(by={"cp": 0.005})
    assert told in shifted.report.notes
    named = wigley.vary(set={"fore_shift": 1.0, "aft_shift": -0.5})
    assert told in named.report.notes
    assert named.map(np.array([[75.0, 1.0, 2.0], [25.0, 1.0, 2.0]]))[:, 0].tolist() == [76.0, 24.5]


@pytest.mark.parametrize(
    ("given", "kind", "says"),
    [
        ({}, BadInputError, "nothing is asked for, in shift_sections; give some of cb, cp,"),
        ({"by": {"cb": 0.3}}, OutOfRangeError, "a change of 0.3 in CB makes sections cross at x="),
        ({"by": {"lcb_percent": 12.0}}, OutOfRangeError, "a change of 12 % Lpp in LCB makes sect"),
        ({"to": {"Cpf": 0.99}}, OutOfRangeError, "in CP of the fore body; give one|give one from"),
        ({"by": {"cb": 0.01}, "to": {"cp": 0.6}}, BadInputError, "'cp' and 'cb' ask for one thing"),
        ({"by": {"cb": 0.01}, "to": {"cb": 0.6}}, BadInputError, "'cb' is in to and in by"),
        ({"by": {"cb": 0.01, "Cpa": 0.01}}, BadInputError, "cannot be asked for together"),
        ({"by": {"cd": 0.01}}, AssocHullError, "there is no value that shifts set named 'cd'"),
        ({"by": [0.01]}, AssocHullError, "by is list, in shift_sections; give numbers by cb,"),
        ({"to": {"cb": float("nan")}}, BadInputError, "cb is nan"),
        ({"by": {"cb": 0.01}, "shape": "c3"}, BadInputError, "shape is 'c3'"),
        ({"by": {"cb": 0.01}, "shape": "1-cp"}, BadInputError, "pushes both bodies from one place"),
        ({"by": {"parallel_body_end": 1.0}}, BadInputError, "give two places for them"),
        ({"by": {"parallel_body_end": 90.0}, "terminals": [0, 45, 55, 100]}, BadInputError,
         r"moving the ends of the parallel body by \+0 and \+90 m makes sections cross"),
        ({"by": {"cb": 0.01}, "terminals": [0, 60, 50, 100]}, BadInputError, "do not rise"),
        ({"by": {"cb": 0.01}, "terminals": [200, 210, 220, 230]}, BadInputError,
         "the sections from 220 to 230 m are all alike, or there are none"),
    ],
    ids=lambda each: str(each) if isinstance(each, dict) else "",
)  # fmt: skip
def test_what_is_refused(
    wigley: ah.Hull, given: dict[str, Any], kind: type[AssocHullError], says: str
) -> None:
    """In one line that tells what is wrong and what to do; the hull is unchanged."""
    start, steps = wigley.fingerprint, len(wigley.history)
    with pytest.raises(kind, match=says) as caught:
        wigley.shift_sections(in_place=True, **given)
    assert "\n" not in str(caught.value)
    assert (wigley.fingerprint, len(wigley.history)) == (start, steps)


def test_the_range_that_is_told_can_be_had(wigley: ah.Hull) -> None:
    """Just within the refused range a hull comes out, beyond it none."""
    with pytest.raises(OutOfRangeError) as caught:
        wigley.shift_sections(by={"cb": 0.2})
    most = caught.value.most
    assert 0.08 < most < 0.09
    found = wigley.shift_sections(by={"cb": 0.999 * most})
    assert found.report.shift.least == pytest.approx(0.05, abs=2e-3)


def test_a_hull_that_is_swung_keeps_volume_and_coefficients(wigley: ah.Hull) -> None:
    """CB, volume and LCB / Lpp to 1e-10; what was not asked for gives way."""
    found = wigley.swing(length=121.0)
    before, after = _measured(wigley), _measured(found.hull)
    assert after.volume == pytest.approx(before.volume, rel=1e-10)
    assert after.cb == pytest.approx(before.cb, abs=1e-10)
    assert after.lcb_percent == pytest.approx(before.lcb_percent, abs=1e-8)
    assert after.cw == pytest.approx(before.cw, abs=1e-5)
    ship = found.hull.state.particulars
    assert ship.length == 121.0
    assert (ship.breadth, ship.draught) == pytest.approx((10.0 / 1.1, 6.25 / 1.1), rel=1e-12)


@pytest.mark.parametrize(
    ("asked", "gives"),
    [
        ({"breadth": 12.5}, {"breadth": 12.5, "draught": 5.0, "depth": 7.5}),
        ({"draught": 5.0}, {"breadth": 12.5, "draught": 5.0, "depth": 7.5}),
        ({"length": 121.0}, {"length": 121.0, "breadth": 10 / 1.1, "draught": 6.25 / 1.1,
                             "depth": 9.375 / 1.1}),
        ({"length": 125.0, "draught": 5.0}, {"length": 125.0, "breadth": 10.0, "draught": 5.0,
                                             "depth": 7.5}),
    ],
    ids=["breadth", "draught", "length", "length and draught"],
)  # fmt: skip
def test_what_gives_way(asked: dict[str, float], gives: dict[str, float]) -> None:
    """The product of length, breadth and draught is held; the depth goes with the draught."""
    now = {"length": 100.0, "breadth": 10.0, "draught": 6.25, "depth": 9.375}
    assert swung_dimensions(now, asked) == pytest.approx(gives, rel=1e-14)


@pytest.mark.parametrize(
    ("asked", "says"),
    [
        ({}, "none of length, breadth, draught are given, in swing"),
        ({"length": 90.0, "breadth": 9.0, "draught": 7.0}, "all of length, breadth, draught are"),
        ({"breadth": -1.0}, "breadth is -1.0, in swing; give a number above 0"),
    ],
)
def test_what_cannot_be_swung(wigley: ah.Hull, asked: dict[str, Any], says: str) -> None:
    """Refused in one line; the hull is unchanged."""
    start = wigley.fingerprint
    with pytest.raises(BadInputError, match=says):
        wigley.swing(in_place=True, **asked)
    assert wigley.fingerprint == start
