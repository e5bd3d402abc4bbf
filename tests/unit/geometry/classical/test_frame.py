"""Frames: parabolas between given points, knuckles, the rounded corner, the camber, the areas."""

from __future__ import annotations

import math

import numpy as np
import pytest

from assoc_hull.geometry.classical.frame_section import (
    FrameSection,
    Quadratics,
    deck_corner,
    run_bends,
    tangent_jumps,
)

WATER = [(11, 0.8), (13.5, 2.5), (14.8, 5), (15, 9)]


def polygon(frame: FrameSection, count: int = 400) -> np.ndarray:
    """The whole curve as a polygon: side, corner, deck, to the centre line."""
    parts = [frame.drawn(count)]
    if frame.corner is not None:
        arc = frame.corner.arc()
        parts.append(arc.at(np.zeros(count, int), np.linspace(0, arc.length[0], count)))
    if frame.deck is not None:
        parts.append(
            frame.deck.at(np.zeros(count, int), np.linspace(0, frame.deck.length[0], count))
        )
    return np.concatenate(parts)


def area_below(points: np.ndarray, level: float) -> tuple[float, float]:
    """Area of both sides below a level, and its moment, of a fine polygon cut off there."""
    y, z = points[:, 0], np.minimum(points[:, 1], level)
    dz = np.diff(z)
    middle, height = (y[1:] + y[:-1]) / 2, (z[1:] + z[:-1]) / 2
    return 2 * float(middle @ dz), 2 * float((middle * height) @ dz)


FRAMES = {
    "flat of bottom": FrameSection.make(20, WATER, deck_side=(15, 14), flat=7.5),
    "camber and corner": FrameSection.make(
        20, WATER, deck_side=(15, 14), flat=7.5, camber=0.4, corner_radius=1.0
    ),
    "ridged camber": FrameSection.make(
        20, WATER, deck_side=(15.6, 14), flat=7.5, camber=0.5, camber_kind="line", corner_radius=0.8
    ),
    "hollow deck": FrameSection.make(20, WATER, deck_side=(15, 14), flat=7.5, camber=-0.3),
    "from the keel": FrameSection.make(5, [(1, 3), (3, 6)], keel=1.2, deck_side=(5, 9), camber=0.2),
    "a knuckle": FrameSection.make(20, WATER, deck_side=(14, 14), flat=7.5, knuckles=[(15.2, 10)]),
    "a shelf": FrameSection.make(
        20, [(3, 1), (4, 3)], deck_side=(7, 9), keel=0.0, knuckles=[(5, 5), (6, 5)]
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", FRAMES)
def test_areas_and_moments_of_a_frame_are_those_of_its_curve(name: str) -> None:
    """Below any level, whole; against a polygon of the curve, which is off by its chords."""
    frame = FRAMES[name]
    points = polygon(frame)
    for level in (1.5, 4.2, 9.0, 13.3, 13.9, 14.2, 20.0):
        area, moment = area_below(points, level)
        assert frame.area(level) == pytest.approx(area, rel=3e-5, abs=1e-5)
        assert frame.moment(level) == pytest.approx(moment, rel=3e-5, abs=1e-5)
    assert frame.area() == pytest.approx(frame.area(1e3), rel=1e-12)


@pytest.mark.parametrize("name", FRAMES)
def test_a_frame_passes_all_its_points_and_is_continuous(name: str) -> None:
    """Each run begins where the one before it ends; the pieces join."""
    frame = FRAMES[name]
    for one, other in zip(frame.runs[:-1], frame.runs[1:], strict=True):
        assert one.points[-1].tolist() == other.points[0].tolist()
    side = frame.side
    piece = np.arange(len(side) - 1)
    ends, starts = side.at(piece, side.length[:-1]), side.at(piece + 1, np.zeros(len(piece)))
    assert ends == pytest.approx(starts, abs=1e-12)
    given = np.concatenate([run.points for run in frame.runs])
    if frame.corner is None:
        for place in given:
            assert np.hypot(*(frame.drawn(1) - place).T).min() < 1e-12


def test_a_frame_leaves_its_flat_horizontally() -> None:
    """The bend by the level start and that by the neighbour are meant: .127328 and .121976."""
    bends = run_bends([(7.5, 0), *WATER, (15, 14)], 0.0)[0]
    assert bends[0] == pytest.approx((0.1273284580012235 + 0.121976048046298) / 2, rel=1e-12)
    assert FRAMES["flat of bottom"].level_start
    assert not FRAMES["from the keel"].level_start


def test_a_frame_is_straight_between_knuckles_without_a_waterline() -> None:
    """Two points make a run of no bend; knuckles are no jumps of the corrugation."""
    frame = FRAMES["a knuckle"]
    assert [len(run.points) for run in frame.runs] == [6, 2]
    first, last = frame.side.angles()
    assert first[-1] == pytest.approx(last[-1], abs=1e-12)
    assert len(frame.jumps) == 5


def test_the_bends_do_not_depend_on_the_place_or_heading_of_the_axes() -> None:
    """Turned and moved, a run has the same bends; mirrored, the opposite ones."""
    run = np.array([(7.5, 0), *WATER, (15, 14)], float)
    c, s = math.cos(0.7), math.sin(0.7)
    turned = run @ np.array([[c, s], [-s, c]]) + [3.0, -8.0]
    assert run_bends(turned)[0] == pytest.approx(run_bends(run)[0], abs=1e-12)
    assert run_bends(run * [-1, 1])[0] == pytest.approx(-run_bends(run)[0], abs=1e-12)


def test_the_jumps_fall_with_the_square_of_the_spacing() -> None:
    """On a quarter of an ellipse; an eighth of the spacing makes them about 64 times less."""
    largest = []
    for count in (9, 17, 33, 65):
        angle = np.linspace(-math.pi / 2, 0, count)
        run = np.column_stack([10 * np.cos(angle), 6 + 6 * np.sin(angle)])
        jumps = tangent_jumps(Quadratics.over(run, run_bends(run)[0]))
        largest.append(float(np.abs(jumps[1:-1]).max()))
    order = np.log2(np.array(largest[:-1]) / largest[1:])
    assert (order > 1.8).all(), order


def test_a_neighbour_beside_the_chord_is_left_out_and_told() -> None:
    """The piece then bends by its other neighbour; without any it is straight."""
    bends, notes = run_bends([(0, 0), (5, 0.2), (5.2, 3), (2, 3.1)])
    assert len(notes) == 2
    assert all("lies beside its chord and was left out" in each for each in notes)
    assert bends[2] == 0.0
    assert run_bends([(0, 0), (1, 1), (2, 2.5)])[1] == ()


def test_uneven_waterlines_are_told() -> None:
    """Beyond a ratio of four, with the height."""
    frame = FrameSection.make(12, [(3, 1), (4, 1.5), (5, 4)], deck_side=(6, 6))
    assert frame.notes == ("frame x=12: waterline spacing ratio 5 exceeds 4 at z=1.5",)
    assert FRAMES["flat of bottom"].notes == ()


def test_waterlines_below_the_keel_and_above_the_deck_do_not_count() -> None:
    """Nor does one that stands at a knuckle of its own place."""
    plain = FrameSection.make(9, [(2, 3), (4, 5)], deck_side=(5, 7), keel=1.0, knuckles=[(3, 4)])
    more = FrameSection.make(
        9, [(1, 0.5), (2, 3), (3, 4), (4, 5), (9, 8)], deck_side=(5, 7), keel=1.0, knuckles=[(3, 4)]
    )
    assert plain.area() == more.area()


@pytest.mark.parametrize("seed", range(20))
def test_a_corner_touches_deck_and_side(seed: int) -> None:
    """The arc meets the camber in its tangent, and the side, inclined or not, in its own."""
    rng = np.random.default_rng(seed)
    b, rise, r = rng.uniform(4, 20), rng.uniform(0.01, 0.9), rng.uniform(0.2, 2.0)
    lean, kind = rng.uniform(1.2, 1.9), ("line", "parabola")[seed % 2]
    found = deck_corner(b, 12.0, rise, r, side_angle=lean, kind=kind)
    arc = found.arc()
    assert float(arc.angle[0]) == pytest.approx(lean, abs=1e-10)
    assert arc.ends()[0] == pytest.approx(found.deck_point, abs=1e-9)
    y, z = found.deck_point
    part = y / b
    slope = -2 * rise * part / b if kind == "parabola" else -rise / b
    assert z == pytest.approx(12 + rise * (1 - (part**2 if kind == "parabola" else part)))
    assert math.tan(float(arc.end_angles()[0])) == pytest.approx(slope, abs=1e-9)
    off = (np.array(found.side_point) - (b, 12.0)) @ (-math.sin(lean), math.cos(lean))
    assert off == pytest.approx(0.0, abs=1e-9)
