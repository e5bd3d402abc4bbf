"""What is refused by curves of a definition from boundary data, each with its message."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from assoc_hull.creation.classical.middle_body import Midship
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.appendages import LoftedAppendage
from assoc_hull.geometry.classical.boundary_lines import CodedKnuckleLine, KeelOutline
from assoc_hull.geometry.classical.camber import Camber
from assoc_hull.geometry.classical.frame_section import FrameSection, deck_corner, run_bends
from assoc_hull.geometry.classical.parallel_waterline import ParallelWaterline

AFT, FORWARD, TANGENT = [(0, 8), (10, 0)], [(120, 0), (130, 9)], [(10, 0), (120, 0)]
RUN = [(0, 0), (5, 3), (30, 15), (60, 15), (80, 4)]
BOX = [(0, 0), (1, 0), (1, 1), (0, 1)]
NAN = float("nan")


def keel(aft: object = AFT, forward: object = FORWARD, tangent: object = TANGENT) -> KeelOutline:
    """A keel that is level from 10 to 120."""
    return KeelOutline.make(10, 120, aft, forward, tangent)  # type: ignore[arg-type]


def line(points: object = RUN, **options: object) -> ParallelWaterline:
    """A waterline at 6 m."""
    return ParallelWaterline.make(6, points, **options)  # type: ignore[arg-type]


def knuckle(code: list[object], x: object = (0, 10, 25, 40)) -> CodedKnuckleLine:
    """A knuckle line of four points."""
    return CodedKnuckleLine.make(x, [5, 8, 9.5, 9], code)  # type: ignore[arg-type]


def frame(water: object, **options: object) -> FrameSection:
    """A frame at 20 m, its deck side at (15, 14)."""
    given = {"deck_side": (15, 14)} | options
    return FrameSection.make(20, water, **given)  # type: ignore[arg-type]


REFUSED: dict[str, tuple[str, Callable[[], object]]] = {
    "contour runs back": (
        "contour: x must be non-decreasing (row 2)",
        lambda: keel(aft=[(0, 8), (5, 3), (4, 2), (10, 0)]),
    ),
    "contour aft ends above": (
        "contour: part 1 must end at x=10 with z=0, got z=1", lambda: keel(aft=[(0, 8), (10, 1)]),
    ),
    "contour forward begins elsewhere": (
        "contour: part 3 must end at x=120 with z=0, got z=0 at x=121",
        lambda: keel(forward=[(121, 0), (130, 9)]),
    ),
    "contour of no rows": (
        "contour: part 1 has 0 row(s)", lambda: keel(aft=np.zeros((0, 2))),
    ),
    "contour upright in the middle": (
        "contour: part 1 is upright at row 2, x=5",
        lambda: keel(aft=[(0, 8), (5, 5), (5, 3), (10, 0)]),
    ),
    "limits in the wrong order": (
        "contour: the level keel runs from x=120 to 10",
        lambda: KeelOutline.make(120, 10, AFT, FORWARD, TANGENT),
    ),
    "flat below nil": (
        "bottom tangent line: negative half-width at row 1",
        lambda: keel(tangent=[(10, 0), (30, -1), (120, 0)]),
    ),
    "flat too short": (
        "bottom tangent line: must cover [10, 120]", lambda: keel(tangent=[(10, 0), (90, 0)]),
    ),
    "flat runs back": (
        "bottom tangent line: x must be increasing (row 1)",
        lambda: keel(tangent=[(10, 0), (10, 1), (120, 0)]),
    ),
    "beyond the contour": (
        "contour: x=131 outside [0, 130]", lambda: keel().height([5, 131]),
    ),
    "contour of a nan": (
        "contour: part 1: non-finite value at index (0, 1)", lambda: keel(aft=[(0, NAN), (10, 0)]),
    ),
    "flat too wide": ("midship: b=16 must lie in [0, a)", lambda: Midship(16, 16, 0.3, 2.5)),
    "bilge past the flat": (
        "midship: R=14.4 exceeds the limit 14.30649744", lambda: Midship(16, 2, 0.3, 14.4),
    ),
    "bilge above the side": (
        "midship: bilge centre z=2.747002485 above the side height 2.5",
        lambda: Midship(16, 2, 0.3, 2.5, 2.5),
    ),
    "rise below nil": ("midship: c=-1 must be 0 or more", lambda: Midship(16, 2, -1, 2.5)),
    "radius below nil": ("midship: R=-1 must be 0 or more", lambda: Midship(16, 2, 0, -1)),
    "no half-breadth": ("midship: a=0 must be above 0", lambda: Midship(0, 0, 0, 0)),
    "midship of words": (
        "midship: expected shape (), got no array of numbers", lambda: Midship("a", 0, 0, 0),
    ),
    "waterline runs back": (
        "waterline z=6: x not strictly increasing at row 2",
        lambda: line([(0, 0), (5, 3), (5, 4)]),
    ),
    "waterline below nil": (
        "waterline z=6: negative half-breadth at row 1", lambda: line([(0, 0), (5, -3), (9, 4)]),
    ),
    "parallel part beyond the ends": (
        "waterline z=6: parallel part [30,90] outside the ends", lambda: line(parallel=(30, 90)),
    ),
    "parallel part of no length": (
        "waterline z=6: parallel part [30,30] has no length", lambda: line(parallel=(30, 30)),
    ),
    "point off the parallel part": (
        "waterline z=6: point (5,3) lies in the parallel part but y differs from 15",
        lambda: line(parallel=(4, 60), parallel_half_breadth=15),
    ),
    "parallel part without a point": (
        "waterline z=6: no point lies in the parallel part", lambda: line(parallel=(31, 59)),
    ),
    "one point aft": (
        "waterline z=6: needs at least 2 points aft of the parallel part",
        lambda: line([(0, 0), (50, 15), (70, 15), (90, 5)], parallel=(30, 70)),
    ),
    "one point forward": (
        "waterline z=6: needs at least 2 points forward of the parallel part",
        lambda: line([(0, 0), (30, 15), (50, 15), (90, 5)], parallel=(30, 70)),
    ),
    "waterline of one point": ("waterline z=6: has 1 point(s)", lambda: line([(0, 0)])),
    "another method": ("waterline z=6: method is 'best'", lambda: line(method="best")),
    "end slope alone": ("waterline z=6: end_slope is no pair", lambda: line(end_slope=0.5)),
    "beyond the waterline": (
        "waterline z=6: x=81 outside [0, 80]", lambda: line(method="graph").at(81),
    ),
    "batten bent too far": (
        "waterline z=6: spline: turn of", lambda: line([(0, 0), (0.1, 9), (0.2, 0)]),
    ),
    "no such code": (
        "knuckle line: code 5 at interval 1 not in 0..4", lambda: knuckle([1, 5, 1]),
    ),
    "code 2 in the last": (
        "knuckle line: code 2 at interval 2 needs point 4; use code 3", lambda: knuckle([1, 1, 2]),
    ),
    "code 4 in the last": (
        "knuckle line: code 4 at interval 2 needs point 4; use code 3", lambda: knuckle([1, 1, 4]),
    ),
    "code 3 in the first": (
        "knuckle line: code 3 at interval 0 needs point -1; use code 2", lambda: knuckle([3, 1, 1]),
    ),
    "code 4 in the first": (
        "knuckle line: code 4 at interval 0 needs point -1; use code 2", lambda: knuckle([4, 1, 1]),
    ),
    "line of no length": (
        "knuckle line: zero-length interval 1 allowed only with code 0",
        lambda: knuckle([1, 1, 1], (0, 10, 10, 40)),
    ),
    "parabola across a step ahead": (
        "knuckle line: code 2 at interval 0 reaches across a step",
        lambda: knuckle([2, 0, 1], (0, 10, 10, 40)),
    ),
    "parabola across a step behind": (
        "knuckle line: code 3 at interval 2 reaches across a step",
        lambda: knuckle([1, 0, 3], (0, 10, 10, 40)),
    ),
    "knuckle line runs back": (
        "knuckle line: x must be non-decreasing (row 2)",
        lambda: knuckle([1, 1, 1], (0, 10, 9, 40)),
    ),
    "knuckle line of one point": (
        "knuckle line: 1 point(s)", lambda: CodedKnuckleLine.make([0], [1], []),
    ),
    "another blend": (
        "knuckle line: blend is 'mean'",
        lambda: CodedKnuckleLine.make([0, 1], [1, 2], [1], "mean"),  # type: ignore[arg-type]
    ),
    "codes too few": ("knuckle line: expected shape (3), got (2,)", lambda: knuckle([1, 1])),
    "beyond the side": (
        "camber: |y|=16 exceeds half-breadth 15",
        lambda: Camber.make([0], 15, 18, 0.45).height(0, -16),
    ),
    "camber of no breadth": (
        "camber: half-breadth must be positive", lambda: Camber.make([0, 9], [5, 0], 18, 0.45),
    ),
    "another camber": ("camber: kind is 'flat'", lambda: Camber.make([0], 15, 18, 0.45, "flat")),
    "camber runs back": (
        "camber: x not strictly increasing at row 1", lambda: Camber.make([0, 0], 15, 18, 0.45),
    ),
    "beyond the camber": (
        "camber: x=10 outside [0, 9]", lambda: Camber.make([0, 9], 15, 18, 0.45).area(10),
    ),
    "four sections": (
        "appendage: 1, 2 or 3 sections expected, got 4",
        lambda: LoftedAppendage.make([BOX] * 4, (0, 1, 2)),
    ),
    "sections of other sizes": (
        "appendage: sections have 4 and 3 points",
        lambda: LoftedAppendage.make([BOX, BOX[:3]], (0, 1)),
    ),
    "appendage of no length": (
        "appendage: x must be strictly increasing", lambda: LoftedAppendage.make([BOX], (1, 1)),
    ),
    "sections that cross themselves": (
        "appendage: section at x=0 self-intersects",
        lambda: LoftedAppendage.make([[(0, 0), (2, 2), (2, 0), (0, 3)]] , (0, 1)),
    ),
    "sections that cross themselves between": (
        "appendage: section at x=1.125 self-intersects",
        lambda: LoftedAppendage.make([BOX, [(0, 0), (1, 0), (0.02, 1), (0, 1)], BOX], (0, 1, 6)),
    ),
    "sections the other way round": (
        "appendage: sections have opposite orientation",
        lambda: LoftedAppendage.make([BOX, BOX[::-1]], (0, 1)),
    ),
    "sections of two points": (
        "appendage: a section has 2 point(s)", lambda: LoftedAppendage.make([BOX[:2]], (0, 1)),
    ),
    "a number for sections": (
        "appendage: sections are no row of arrays",
        lambda: LoftedAppendage.make(np.array(5.0), (0, 1)),  # type: ignore[arg-type]
    ),
    "another sign": ("appendage: sign is 2", lambda: LoftedAppendage.make([BOX], (0, 1), 2)),
    "beyond the appendage": (
        "appendage: x=3 outside [0, 1]", lambda: LoftedAppendage.make([BOX], (0, 1)).area(3),
    ),
    "frame of one point": (
        "frame x=20: fewer than 2 points on the section",
        lambda: frame([], keel=14.0, deck_side=(0, 14)),
    ),
    "frame with two points at a height": (
        "frame x=20: section points not increasing in z at 3",
        lambda: frame([(4, 3), (5, 3)]),
    ),
    "corner too large": (
        "frame x=20: corner radius 16 does not fit",
        lambda: frame([(11, 3)], flat=7.5, camber=0.4, corner_radius=16.0),
    ),
    "corner larger than the top of the side": (
        "frame x=20: corner radius 3 does not fit",
        lambda: frame([(11, 3), (14.8, 12.9)], flat=7.5, camber=0.4, corner_radius=3.0),
    ),
    "corner of no radius": (
        "frame: corner radius 0 does not fit", lambda: deck_corner(15, 14, 0.4, 0),
    ),
    "run of one point": (
        "frame: fewer than 2 points on the section", lambda: run_bends([(0, 0)]),
    ),
    "points that coincide": (
        "frame: points 1 and 2 coincide", lambda: run_bends([(0, 0), (1, 1), (1, 1)]),
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_what_makes_no_curve_is_refused_with_its_message(case: str) -> None:
    """The quoted message with its numbers, in one line, and a remedy behind it."""
    message, make = REFUSED[case]
    with pytest.raises(GeometryError) as caught:
        make()
    assert caught.value.what.startswith(message), caught.value.what
    assert caught.value.remedy
    assert "\n" not in str(caught.value)
