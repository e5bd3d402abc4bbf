"""Smooth curves that are fitted all at once, so that they meet."""

import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.smoothing import FitTie, PolylineFit, fit_polyline, join_fits

RADIUS, NOISE = 20.0, 2e-3
OFFSETS = np.linspace(2.0, 16.0, 8)


def _line(axis: int, offset: float, draw: np.random.Generator) -> tuple[PolylineFit, FloatArray]:
    """Fit the noisy cut of a sphere at x = offset (axis 0: (y, z)) or z = offset ((x, y))."""
    radius = np.sqrt(RADIUS**2 - offset**2)
    t = np.linspace(0.0, np.pi / 2, 160)
    round_ = np.column_stack([np.cos(t), np.sin(t)]) * radius
    points = round_ + np.where(t[:, None] % (np.pi / 2) > 1e-9, 1.0, 0.0) * draw.normal(
        0.0, NOISE, (160, 2)
    )
    fitted = fit_polyline(points, 3.0 * NOISE)
    assert fitted is not None
    return fitted, points


def _net(seed: int) -> tuple[list[PolylineFit], list[FitTie]]:
    """Sections (y, z) and waterlines (x, y) of a sphere, tied wherever they cross."""
    draw = np.random.default_rng(seed)
    sections = [_line(0, x, draw) for x in OFFSETS]
    waterlines = [_line(2, z, draw) for z in OFFSETS]
    ties = []
    for i, x in enumerate(OFFSETS):
        for j, z in enumerate(OFFSETS):
            if x * x + z * z > 0.9 * RADIUS**2:
                continue
            y = np.sqrt(RADIUS**2 - x * x - z * z)
            normal = np.array([x, y, z]) / RADIUS
            at_a = _length(sections[i][1], np.array([y, z]))
            at_b = _length(waterlines[j][1], np.array([x, y]))
            offset = normal[2] * z - normal[0] * x
            ties.append(FitTie(i, at_a, normal[1:], 8 + j, at_b, normal[:2], float(offset)))
    return [each for each, _ in sections + waterlines], ties


def _length(points: FloatArray, place: FloatArray) -> float:
    """Length along a polyline of the place nearest in direction from its centre."""
    at = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    angle = np.arctan2(points[:, 1], points[:, 0])
    return float(np.interp(np.arctan2(place[1], place[0]), angle, at))


def _gaps(fits: list[PolylineFit], ties: list[FitTie]) -> FloatArray:
    out = []
    for tie in ties:
        a = fits[tie.a].fit.rows(np.array([tie.at_a])) @ fits[tie.a].control
        b = fits[tie.b].fit.rows(np.array([tie.at_b])) @ fits[tie.b].control
        out.append(abs(float(a[0] @ tie.way_a - b[0] @ tie.way_b) - tie.offset))
    return np.array(out)


@pytest.mark.parametrize("seed", range(5))
def test_lines_of_a_noisy_sphere_meet(seed: int) -> None:
    """Gaps of single fits, of the size of the noise, shrink to a tenth and less."""
    fits, ties = _net(seed)
    before, after = _gaps(fits, ties), _gaps(join_fits(fits, ties, 1e-4), ties)
    assert np.percentile(before, 95) > 0.5 * NOISE
    assert np.percentile(after, 95) < 0.1 * np.percentile(before, 95)


@pytest.mark.parametrize("seed", range(5))
def test_joined_lines_lie_closer_to_the_surface(seed: int) -> None:
    """What one line has of noise the others lack: the mean distance from the sphere falls."""
    fits, ties = _net(seed)
    joined = join_fits(fits, ties, 1e-4)
    radius = [np.sqrt(RADIUS**2 - offset**2) for offset in (*OFFSETS, *OFFSETS)]

    def off(lines: list[PolylineFit]) -> float:
        away = [
            np.abs(np.linalg.norm(each.draw().points, axis=1) - r).mean() * r / RADIUS
            for each, r in zip(lines, radius, strict=True)
        ]
        return float(np.mean(away))

    assert off(joined) < off(fits)


def test_without_ties_nothing_changes() -> None:
    """The fits are given back as they are."""
    fits, _ = _net(0)
    assert all(a is b for a, b in zip(join_fits(fits, [], 1e-4), fits, strict=True))


def test_a_tie_to_a_place_that_may_not_move_pulls_the_line_there() -> None:
    """With b = -1 the line alone gives way, within what its data allow."""
    fits, ties = _net(0)
    tie = ties[5]
    place = fits[tie.a].fit.rows(np.array([tie.at_a])) @ fits[tie.a].control
    wanted = float(place[0] @ tie.way_a) + 1e-3
    alone = FitTie(tie.a, tie.at_a, tie.way_a, -1, 0.0, tie.way_b, wanted)
    moved = join_fits(fits, [alone], 1e-5)[tie.a]
    now = float((moved.fit.rows(np.array([tie.at_a])) @ moved.control)[0] @ tie.way_a)
    assert now == pytest.approx(wanted, abs=1e-5)


def test_the_ends_of_the_lines_stay() -> None:
    """They lie on boundary curves, which are smoothed before."""
    fits, ties = _net(1)
    for one, other in zip(fits, join_fits(fits, ties, 1e-4), strict=True):
        np.testing.assert_array_equal(one.draw().points[[0, -1]], other.draw().points[[0, -1]])
