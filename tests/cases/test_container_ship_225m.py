"""The 225 m container ship: created from definitions, with a bulb and flared sections."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.model.forms.form_values import chain_of
from assoc_hull.shipped.container_ship_225m import container_ship_225m_design
from tests.taken_back import taken_back

LPP, BREADTH, DRAUGHT, FULL = 225.0, 32.0, 10.8, 0.975 * 32.0 * 10.8
HEIGHTS = np.linspace(0.05, 21.0, 420)
BREADTHS = np.linspace(0.05, 15.95, 160)

Sections = dict[float, list[FloatArray]]


@pytest.fixture(scope="module")
def kept(shipped: Callable[[str], ah.Hull]) -> ah.Hull:
    """The container ship; a test that edits it undoes its edits."""
    return shipped("container_ship_225m")


@pytest.fixture
def ship(kept: ah.Hull) -> Iterator[ah.Hull]:
    """The container ship, taken back when the test is over."""
    with taken_back(kept) as hull:
        yield hull


@pytest.fixture(scope="module")
def sections(kept: ah.Hull) -> Sections:
    """By x: points of the curves of the sections, from below, dense along each cubic."""
    found = {}
    for line in kept.groups["sections"].lines.values():
        curves = [sample(curve.spline, 48)[1] for curve in line.curves]
        found[round(float(curves[0][0, 0]), 6)] = sorted(curves, key=lambda p: float(p[0, 2]))
    return dict(sorted(found.items()))


def _below(points: FloatArray) -> float:
    """Give the area (m2) of both sides of a section's curve below the draught."""
    y, z = points[:, 1], np.minimum(points[:, 2], DRAUGHT)
    return 2.0 * float(np.trapezoid(y, z))


def _reach(curves: list[FloatArray], at: FloatArray, axis: int, *, largest: bool) -> FloatArray:
    """Give the outermost (or lowest) meeting of a section with lines z = at (or y = at)."""
    found = np.full(len(at), -np.inf if largest else np.inf)
    for points in curves:
        along, across = points[:, axis], points[:, 3 - axis]
        low, high = along[:-1, None] - at, along[1:, None] - at
        hit = low * high <= 0.0
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.where(low == high, 0.0, low / (low - high))
        met = across[:-1, None] + share * np.diff(across)[:, None]
        worst = -np.inf if largest else np.inf
        pick = np.where(hit, met, worst)
        found = np.maximum(found, pick.max(axis=0)) if largest else np.minimum(
            found, pick.min(axis=0)
        )  # fmt: skip
    return np.where(np.isfinite(found), found, np.nan)


def test_closure_has_the_block_coefficient_and_the_centre_of_buoyancy() -> None:
    """CB 0.65 and 1.25 % of the length abaft midship to 1e-12, by the integrals of the curve."""
    design = container_ship_225m_design()
    areas = chain_of(design.definition("sectional_area"), design.particulars)
    assert areas.area() / (LPP * BREADTH * DRAUGHT) == pytest.approx(0.65, abs=1e-12)
    lcb = areas.moment() / areas.area() - 0.5 * LPP
    assert lcb / LPP == pytest.approx(-0.0125, abs=1e-12)


def test_sections_of_the_net_have_the_areas_of_the_curve(sections: Sections) -> None:
    """One in a million, and what dense trapezoids leave out."""
    design = container_ship_225m_design()
    areas = chain_of(design.definition("sectional_area"), design.particulars)
    inside = [x for x in sections if 0.0 <= x <= LPP]
    found = np.array([sum(_below(curve) for curve in sections[x]) for x in inside])
    np.testing.assert_allclose(found, areas.ordinate(np.array(inside)), rtol=5e-6)


def test_the_net_floats_as_the_closure_says(kept: ah.Hull) -> None:
    """CB within 0.05 %, LCB within 0.02 m, between the perpendiculars; CW is printed."""
    report = kept.creation
    print("\n" + "\n".join(str(report).splitlines()[:6]))
    assert report.figure("CB").net == pytest.approx(0.65, rel=5e-4)
    assert report.figure("LCB").net == pytest.approx(-0.0125 * LPP, abs=0.02)
    assert report.figure("CW").net == pytest.approx(report.figure("CW").closure, rel=5e-4)


def test_the_bulb_has_the_size_of_a_bulb(kept: ah.Hull, sections: Sections) -> None:
    """8 to 12 % of the midship section at FP, its tip 5 to 7 m ahead; measured on the net."""
    bulb, above = sections[LPP]
    assert bulb[-1, 1] == pytest.approx(0.0, abs=1e-9)
    assert bulb[-1, 2] < above[0, 2]
    share = _below(bulb) / FULL
    (profile,) = kept.lines["profile"].curves
    points = sample(profile.spline, 64)[1]
    tip = float(points[points[:, 2] < DRAUGHT, 0].max()) - LPP
    print(f"\nA_BT/A_M {share:.4f}, tip {tip:.2f} m ahead of FP")
    assert 0.08 <= share <= 0.12
    assert 5.0 <= tip <= 7.0


def test_sections_turn_as_often_as_they_should(kept: ah.Hull) -> None:
    """At most twice near the ends, once between; lobes of 0.2 degrees count. All are listed."""
    across = np.array([1.0, 0.0, 0.0])
    turns = {
        name: (float(line.curves[0].at(0.0)[0]), sum(
            int(inflections(curve.spline, across)[0][0]) for curve in line.curves
        ))
        for name, line in kept.groups["sections"].lines.items()
    }  # fmt: skip
    print("\n" + ", ".join(f"{name} {count}" for name, (_, count) in turns.items()))
    for name, (x, count) in turns.items():
        assert count <= (2 if x < 0.15 * LPP or x > 0.95 * LPP else 1), name


def test_no_half_breadth_is_negative(kept: ah.Hull) -> None:
    """Along all lines."""
    for line in kept.lines.values():
        for curve in line.curves:
            assert float(sample(curve.spline, 16)[1][:, 1].min()) >= -1e-9, line.name


def test_neighbouring_sections_do_not_cross(sections: Sections) -> None:
    """From midship to either end half-breadths fall at all heights, and heights rise."""
    for one, other in itertools.pairwise(sections):
        inner, outer = (one, other) if one >= 0.5 * LPP else (other, one)
        for at, axis, sign in ((HEIGHTS, 2, 1.0), (BREADTHS, 1, -1.0)):
            if axis == 1 and one >= 0.5 * LPP:
                continue  # ahead, a bulb lies beneath the flare: heights have two sides there
            ends = [_reach(sections[x], at, axis, largest=axis == 2) for x in (inner, outer)]
            gain = sign * (ends[1] - ends[0])
            gain = gain[np.isfinite(gain)]
            assert not len(gain) or float(gain.max()) <= 1e-6, (inner, outer, axis)


def test_it_is_sound(kept: ah.Hull) -> None:
    """Nothing to be found, and what is kept is what its data give."""
    assert kept.check() == ()
    assert kept.verify() == ()


def test_a_fuller_bulb_reaches_the_bulb_and_nothing_else(ship: ah.Hull) -> None:
    """Sections that stand where it differs are made anew, others keep their bits; undone, all."""
    before, sections = ship.fingerprint, ship.groups["sections"].lines
    old = {name: [c.spline.xyz.tobytes() for c in line.curves] for name, line in sections.items()}
    with ship.edit("fuller bulb") as edit:
        edit.set_form("bulb area", **{"x 228_y": 23.0})
    new = {name: [c.spline.xyz.tobytes() for c in line.curves] for name, line in sections.items()}
    moved = {name for name in old if old[name] != new[name]}
    assert moved == {"ST 20.2", "ST 20.35", "ST 20.45"}, "the curve bends up to the next nodes"
    assert old["ST 20.2"][-1] == new["ST 20.2"][-1], "the topside above it"
    assert ship.verify() == ()
    ship.undo()
    assert ship.fingerprint == before


def test_a_longer_bulb_is_made_in_one_edit(ship: ah.Hull) -> None:
    """The tip moves; sections ahead of FP end on the new contour; nothing is found amiss."""
    with ship.edit("longer bulb") as edit:
        edit.set_form("profile", tip_x=231.0)
        edit.set_form("bulb area", tip_x=231.0)
    assert ship.check() == ()
    assert ship.verify() == ()
    (profile,) = ship.lines["profile"].curves
    points = sample(profile.spline, 64)[1]
    assert float(points[points[:, 2] < 9.0, 0].max()) == pytest.approx(231.0, abs=2e-3)
