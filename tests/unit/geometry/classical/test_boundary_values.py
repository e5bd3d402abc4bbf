"""Curves of a definition from boundary data: every printed value, and the full digits behind it."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
import pytest

from assoc_hull.creation.classical.middle_body import Midship
from assoc_hull.geometry.classical.appendages import LoftedAppendage
from assoc_hull.geometry.classical.boundary_lines import CodedKnuckleLine, KeelOutline
from assoc_hull.geometry.classical.camber import Camber
from assoc_hull.geometry.classical.frame_section import (
    Quadratics,
    deck_corner,
    run_bends,
    tangent_jumps,
)
from assoc_hull.geometry.classical.parallel_waterline import ParallelWaterline

AFT, FORWARD = [(0, 8), (5, 3), (10, 0)], [(120, 0), (126, 1.5), (130, 9)]
TANGENT = [(10, 0), (30, 7.5), (90, 7.5), (120, 0)]
KEEL = KeelOutline.make(10, 120, AFT, FORWARD, TANGENT)
MIDSHIP = Midship(16, 2, 0.3, 2.5)
RUN = [(0, 0), (5, 5.1), (12, 10.2), (20, 13.6), (30, 15)]
ENTRANCE = [(80, 15), (90, 11), (100, 0)]
LINE = ParallelWaterline.make(6, RUN + ENTRANCE, parallel=(30, 80), method="graph")
WHOLE = ParallelWaterline.make(6, RUN + ENTRANCE, method="graph")
SIDE = [(7.5, 0), (11, 0.8), (13.5, 2.5), (14.8, 5), (15, 9), (15, 14)]
BENDS = run_bends(SIDE)[0]
PIECES = Quadratics.over(SIDE, BENDS)
CORNER = deck_corner(15, 14, 0.4, 1)
BASE = [(0, 0), (0.4, 0), (0.4, 2), (0, 2)]
MIDDLE = [(0, 0), (0.8, 0.2), (0.7, 2.5), (0, 2.4)]
LAST = [(0, 0), (0.3, 0.1), (0.2, 1.6), (0, 1.5)]
ROUND = LoftedAppendage.make([BASE, MIDDLE, LAST], (0, 2.4, 6))
BLENDS: tuple[Literal["overhauser"] | None, ...] = (None, "overhauser")


def knuckle(code: int, blend: Literal["overhauser"] | None = None) -> float:
    """Value at x = 16, in the second of three intervals."""
    line = CodedKnuckleLine.make([0, 10, 25, 40], [5, 8, 9.5, 9], [1, code, 1], blend)
    return float(line.at(16))


def deck(kind: str) -> Camber:
    """A deck of half-breadth 15 m, 18 m high at the side."""
    return Camber.make([0, 100], 15, 18, 0.45, kind)


VALUES = {
    "flat of bottom at 20": (KEEL.flat(20), 3.75),
    "keel at 7": (KEEL.height(7), 1.8),
    "keel at 128": (KEEL.height(128), 5.25),
    "floor angle": (MIDSHIP.floor_angle, 0.021425292448534566),
    "bilge centre y": (MIDSHIP.centre[0], 13.5),
    "bilge centre z": (MIDSHIP.centre[1], 2.747002485145017),
    "floor point y": (MIDSHIP.floor_point[0], 13.553559133242945),
    "floor point z": (MIDSHIP.floor_point[1], 0.24757626714092007),
    "largest radius": (MIDSHIP.most_radius, 14.306497441074546),
    "midship area to 9": (MIDSHIP.area(9), 281.2485565389397),
    "waterline at 8": (LINE.at(8), 7.588024322420377),
    "waterline at 25": (LINE.at(25), 14.662064578621482),
    "slope of the free end": (LINE.slope(0), 1.071529235104371),
    "slope at the parallel part": (LINE.slope(30), 0.0),
    "overshoot of one spline": (WHOLE.at(55) - 15, 1.6729711526817077),
    "step": (knuckle(0), 8.0),
    "straight": (knuckle(1), 8.6),
    "parabola with the next": (knuckle(2), 8.84),
    "parabola with the last": (knuckle(3), 9.032),
    "mean parabola": (knuckle(4), 8.936),
    "blended parabolas": (knuckle(4, "overhauser"), 8.9552),
    "parabolic camber": (deck("parabola").height(50, 6), 18.378),
    "straight camber": (deck("line").height(50, 6), 18.27),
    "area of a parabolic camber": (deck("parabola").area(50), 9.0),
    "area of a straight camber": (deck("line").area(50), 6.75),
    "prism": (LoftedAppendage.make([BASE], (0, 6)).volume, 4.8),
    "ruled appendage": (LoftedAppendage.make([BASE, MIDDLE], (0, 6)).volume, 7.58),
    "parabolic appendage": (ROUND.volume, 8.006527777777778),
    "a point of it": (ROUND.at(4.2)[1, 0], 0.715),
    "bend 0": (BENDS[0], 0.121976048046298),
    "bend 1": (BENDS[1], 0.15922822891944277),
    "bend 2": (BENDS[2], 0.1692300557392119),
    "bend 3": (BENDS[3], 0.07531478939091713),
    "bend 4": (BENDS[4], 0.011111111111111072),
    "middle of a piece, y": (PIECES.at(np.array([1]), PIECES.length[1:2] / 2)[0, 0],
                             12.352294455918093),
    "middle of a piece, z": (PIECES.at(np.array([1]), PIECES.length[1:2] / 2)[0, 1],
                             1.49956697659104),
    "area beside a run": (PIECES.area(), 199.87150818013845),
    "largest jump": (np.abs(tangent_jumps(PIECES)).max(), 0.12750184614427562),
    "bend of a level start": (run_bends(SIDE[:2], 0.0)[0][0], 0.1273284580012235),
    "corner on the deck, y": (CORNER.deck_point[0], 14.049892959330798),
    "corner on the deck, z": (CORNER.deck_point[1], 14.04906756947795),
    "centre of the corner": (CORNER.centre[1], 13.050312998720342),
}  # fmt: skip


@pytest.mark.parametrize("name", VALUES)
def test_a_value_is_the_printed_one(name: str) -> None:
    """To 1e-12 of the full digits, which is far below every printed digit."""
    found, wanted = VALUES[name]
    assert float(found) == pytest.approx(wanted, rel=1e-12, abs=1e-12)


def test_the_keel_passes_its_points() -> None:
    """Exactly, and it is continuous where the parts meet."""
    for x, z in (*AFT, *FORWARD):
        assert float(KEEL.height(x)) == z
    for x, b in TANGENT:
        assert float(KEEL.flat(x)) == b
    assert KEEL.part([0, 9.999, 10, 120, 120.001]).tolist() == [1, 1, 2, 2, 3]
    assert abs(KEEL.height([10 - 1e-9, 120 + 1e-9])).max() < 1e-8


def test_an_upright_end_of_the_keel_gives_its_lower_height() -> None:
    """At the outer end the lowest row; at the level keel, the level keel."""
    stern, stem = [(0, 8), (0, 5), (10, 2), (10, 0)], [(120, 0), (120, 1), (130, 3), (130, 9)]
    keel = KeelOutline.make(10, 120, stern, stem, TANGENT)
    assert keel.height([0, 10, 120, 130]).tolist() == [5, 0, 0, 3]
    assert keel.height([5, 125]).tolist() == [3.5, 2.0]


def test_a_flat_of_bottom_that_ends_in_a_step_is_told() -> None:
    """A sentence for each end, with its numbers."""
    keel = KeelOutline.make(10, 120, AFT, FORWARD, [(10, 1), (120, 2)])
    assert [each[:36] for each in keel.notes] == [
        "bottom tangent line: b=1 at x=10, wh", "bottom tangent line: b=2 at x=120, w",
    ]  # fmt: skip
    assert KEEL.notes == ()


def test_the_bilge_touches_floor_and_side() -> None:
    """In point and direction, to 1e-12."""
    bilge = MIDSHIP.bilge()
    assert bilge is not None
    assert bilge.ends()[0] == pytest.approx(MIDSHIP.side_point, abs=1e-12)
    assert float(bilge.angle[0]) == pytest.approx(MIDSHIP.floor_angle, abs=1e-12)
    assert float(bilge.end_angles()[0]) == pytest.approx(math.pi / 2, abs=1e-12)
    slope = MIDSHIP.floor_point[1] / (MIDSHIP.floor_point[0] - MIDSHIP.flat)
    assert slope == pytest.approx(math.tan(MIDSHIP.floor_angle), rel=1e-12)


@pytest.mark.parametrize("shape", [(16, 2, 0.3, 2.5), (8, 5, 0, 2), (8, 0, 1, 0), (5, 0, 0, 0)])
def test_areas_and_moments_of_a_midship_are_those_of_its_half_breadths(
    shape: tuple[float, float, float, float],
) -> None:
    """At any draught, through the bilge too; against a dense sum of half-breadths."""
    midship = Midship(*shape)
    for level in (0.1, 0.5 * midship.centre[1], midship.centre[1], 6.0):
        z = (np.arange(200_000) + 0.5) / 200_000 * level
        y = midship.half_breadths(z)
        assert midship.area(level) == pytest.approx(2 * y.mean() * level, rel=1e-6)
        assert midship.moment(level) == pytest.approx(2 * (y * z).mean() * level, rel=1e-6)


def test_a_midship_of_the_largest_radius_begins_its_bilge_at_the_flat() -> None:
    """A rounding more is refused; a radius of nil is a chine."""
    widest = Midship(16, 2, 0.3, MIDSHIP.most_radius)
    assert widest.floor_point == pytest.approx((2.0, 0.0), abs=1e-12)
    assert Midship(16, 2, 0.3, 0).bilge() is None


def test_a_waterline_passes_its_points_and_is_smooth_at_the_parallel_part() -> None:
    """C2 inside a piece; slope, but not curvature, goes on where the parallel part begins."""
    given = np.array(RUN + ENTRANCE, float)
    assert LINE.at(given[:, 0]) == pytest.approx(given[:, 1], abs=1e-12)
    step = 1e-6
    for x, smooth in ((12.0, True), (90.0, True), (30.0, False), (80.0, False)):
        before, at, after = LINE.slope([x - step, x, x + step])
        assert after - before == pytest.approx(0.0, abs=1e-5)
        jump = abs((after - at) - (at - before)) / step
        assert (jump < 1e-3) == smooth
    assert LINE.at([30, 47.3, 80]).tolist() == [15, 15, 15]


def test_blunt_ends_are_bent_over_their_chords() -> None:
    """Without a method the chords decide; the batten still passes all points, level at the side."""
    line = ParallelWaterline.make(6, RUN + ENTRANCE, parallel=(30, 80))
    assert [type(each).__name__ for each in line.pieces] == [
        "ChordedPiece",
        "LevelPiece",
        "ChordedPiece",
    ]
    given = np.array(RUN, float)
    assert line.at(given[:, 0]) == pytest.approx(given[:, 1], abs=1e-9)
    assert line.slope([30 - 1e-9, 80 + 1e-9]) == pytest.approx([0, 0], abs=1e-8)
    fine = ParallelWaterline.make(6, [(0, 0), (10, 3), (20, 5)], end_slope=(0.4, 0.1))
    assert type(fine.pieces[0]).__name__ == "GraphPiece"
    assert fine.slope([0, 20]) == pytest.approx([0.4, 0.1], abs=1e-12)


def test_ends_of_their_own_take_the_place_of_points_beyond_them() -> None:
    """Also of a point at the same x."""
    line = ParallelWaterline.make(
        6, [(0, 0), (5, 3), (9, 4), (14, 2)], aft_end=(2, 1), fwd_end=(14, 1.5), method="graph"
    )
    assert line.points.tolist() == [[2, 1], [5, 3], [9, 4], [14, 1.5]]
    assert line.covers([1.9, 2, 14, 14.1]).tolist() == [False, True, True, False]


def test_codes_2_to_4_reproduce_parabolas() -> None:
    """Exactly, with the blend too; slopes as well."""
    x = np.array([0.0, 3, 7, 12, 14, 20])
    rng = np.random.default_rng(3)
    for codes in np.array([[2, 2, 3, 4, 3], [1, 4, 2, 3, 3], [2, 4, 4, 4, 3]]):
        a, b, c = rng.normal(size=3)
        for blend in BLENDS:
            line = CodedKnuckleLine.make(x, a + b * x + c * x * x, codes, blend)
            at = rng.uniform(3.0 if codes[0] == 1 else 0.0, 20.0, 50)
            assert line.at(at) == pytest.approx(a + b * at + c * at * at, abs=1e-10)
            assert line.slopes(at)[0] == pytest.approx(b + 2 * c * at, abs=1e-10)


def test_codes_1_to_4_are_continuous_and_their_jumps_of_slope_told() -> None:
    """Nil between blended intervals, by a polynomial of each interval elsewhere."""
    x = [0.0, 4, 9, 15, 22]
    v = np.array([[1.0, 9], [4, 8], [5, 8.5], [4.5, 9], [3, 9.8]])
    plain = CodedKnuckleLine.make(x, v, [2, 4, 4, 3])
    blended = CodedKnuckleLine.make(x, v, [2, 4, 4, 3], "overhauser")
    for line in (plain, blended):
        assert line.at(x[1:-1], "left") == pytest.approx(line.at(x[1:-1]), abs=1e-12)
    jumps = plain.slope_jumps()
    assert jumps.shape == (3, 2)
    step = 1e-6
    at = np.array(x[1:-1])
    rough = (plain.at(at + step) - 2 * plain.at(at) + plain.at(at - step)) / step
    assert jumps == pytest.approx(rough, abs=1e-5)
    assert abs(blended.slope_jumps()[1]).max() < 1e-12 < abs(jumps[1]).max()


def test_a_step_falls_at_the_end_of_its_interval() -> None:
    """Right-continuous; the limit from the left on demand; no length, or some."""
    line = CodedKnuckleLine.make([0, 10, 10, 20, 30], [1, 2, 5, 5, 7], [1, 0, 1, 0])
    assert line.at([10, 20, 29.9, 30]).tolist() == [5, 5, 5, 7]
    assert line.at([0, 10, 30], "left").tolist() == [1, 2, 5]
    before, after = line.slopes([10])
    assert (before.tolist(), after.tolist()) == ([0.1], [0.0])


def test_a_negative_camber_is_told() -> None:
    """It is allowed."""
    hollow = Camber.make([0, 50], [9, 10], 12, [0.2, -0.1])
    assert hollow.notes[0].startswith("camber: c=-0.1 at x=50 is negative")
    assert float(hollow.height(50, 0)) == 11.9
    assert deck("line").notes == ()


def test_cambers_are_straight_between_stations() -> None:
    """Half-breadth, side and rise; both sides alike."""
    bow = Camber.make([0, 10], [8, 4], [10, 11], [0.4, 0.2])
    assert float(bow.height(5, 3)) == pytest.approx(10.5 + 0.3 * (1 - 0.25))
    assert float(bow.height(5, -3)) == float(bow.height(5, 3))


def test_an_appendage_passes_its_sections_and_is_exact() -> None:
    """Volume and moments against a dense sum; a sign of -1 turns all of them."""
    for place, section in zip((0, 2.4, 6), (BASE, MIDDLE, LAST), strict=True):
        assert ROUND.at(place) == pytest.approx(np.array(section), abs=1e-12)
    x = (np.arange(20_000) + 0.5) * 6 / 20_000
    assert ROUND.area(x).mean() * 6 == pytest.approx(ROUND.volume, rel=1e-8)
    assert (ROUND.area(x) * x).mean() * 6 == pytest.approx(ROUND.moment[0], rel=1e-8)
    box = LoftedAppendage.make([[(1, 2), (3, 2), (3, 5), (1, 5)]], (10, 14), -1)
    assert (box.volume, *box.moment) == pytest.approx((-24, -288, -48, -84))
    assert ROUND.at([[0, 1], [2, 3]]).shape == (2, 2, 4, 2)
