"""Solved courses: sections fair along the ship, and what is held stays."""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.creation.design import Design
from assoc_hull.creation.fair_courses import _Family, _Windows, fair_courses
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.shipped.fair_designs import fair_plain_ship_design
from assoc_hull.shipped.plain_ship import plain_ship_design


def _worse() -> Design:
    """Give the plain ship with one node of a course moved."""
    design = fair_plain_ship_design()
    angle = design.definition("waterline_angle")
    return design.having(angle.having({"ST 3.2_y": (angle.value("ST 3.2_y") or 0.0) - 6.0}))


@pytest.fixture(scope="module")
def solved() -> Design:
    """Give the ship with the moved node, solved."""
    return fair_courses(_worse())


def test_a_design_without_splines_comes_back_as_it_is() -> None:
    """Courses of other rules are nobody's to change."""
    design = plain_ship_design()
    assert fair_courses(design) is design


def test_solving_holds_areas_waterline_contour_flats_and_nodes_with_an_angle(
    solved: Design,
) -> None:
    """Only ordinates of free nodes of splines differ."""
    before = _worse()
    for one, other in zip(before.definitions, solved.definitions, strict=True):
        if one.rule != "spline" or one.kind == "halves":
            assert other == one
            continue
        moved = {name for name, value in one.values.items() if other.values[name] != value}
        assert all(name.endswith("_y") for name in moved)
        assert not any(
            f"{node}_y" in moved for node in one.nodes if one.value(f"{node}_angle_deg") is not None
        )
    assert solved != before


def test_solving_takes_a_wave_out_of_the_family(solved: Design) -> None:
    """A batten lifted off a section turns by less, over all waterlines and buttocks."""
    assert _turned(solved) < 0.9 * _turned(_worse())


def test_solving_twice_gives_the_same_bits(solved: Design) -> None:
    """Nothing depends on order or time."""
    assert fair_courses(_worse()) == solved


def test_ship_from_six_numbers_is_fair_along_the_ship() -> None:
    """Sign changes (lobes of .2 degree) of a line: waterlines 4, buttocks 4 in the median."""
    hull = ah.create(
        length=100.0, breadth=16.0, draught=6.5, depth=9.0, cb=0.70, lcb=0.4, type="general cargo"
    )
    assert np.median(_counts(hull, "waterlines")) <= 4.0
    assert max(_counts(hull, "waterlines")) <= 7
    assert np.median(_counts(hull, "buttocks")) <= 4.0
    assert max(_counts(hull, "sections")) <= 3


def _counts(hull: ah.Hull, family: str) -> list[int]:
    found = []
    for line in hull.lines.values():
        if line.group.family == family:
            normal = hull.state.lines.normal[line.row]
            found.append(
                sum(int(inflections(hull.state.spline(c.row), normal)[0][0]) for c in line.curves)
            )
    return found


def _turned(design: Design) -> float:
    """Give the mean of |rho|, the largest twentieth left out: shoulders and stern post."""
    family = _Family.of(design, ["keel_angle"])
    values = np.stack([family.forms.value("keel_angle", family.x)])
    found = family.found(values, rates=False)
    rho = np.abs(_Windows.of(family, found).turned(found))
    return float(np.mean(rho[rho < np.percentile(rho, 95.0)]))
