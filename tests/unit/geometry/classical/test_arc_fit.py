"""Plane curves as chains of arcs: what every chain keeps, whatever the curve."""

import math

import numpy as np
import pytest
from scipy.spatial import cKDTree

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.arc_chain_search import FitPieces
from assoc_hull.geometry.classical.arc_fit import ArcFit, fit_arcs
from assoc_hull.geometry.classical.biarc_family import (
    BiarcChords,
    biarcs_by_ratio,
    biarcs_of_shares,
)
from assoc_hull.geometry.classical.checked_input import wrap_angle
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import power_coefficients

WITHIN = 0.0005


def splines(curves: list[SplineBatch]) -> tuple[FloatArray, IntArray]:
    """Cubics of curves in x and y, and where those of each begin."""
    batch = SplineBatch.join(curves)
    return power_coefficients(batch)[:, :, :2], batch.start - np.arange(batch.count + 1)


def through(points: FloatArray, kind: list[int] | None = None) -> SplineBatch:
    """The curve of the kernel through points (n, 2)."""
    return loft(CurveData.single(np.column_stack([points, np.zeros(len(points))]), kind))


def drawn(seed: int, count: int) -> list[SplineBatch]:
    """Random curves of ships' size: gentle ones, wavy ones, ends turned sharply in."""
    rng = np.random.default_rng(seed)
    found = []
    for number in range(count):
        n = int(rng.integers(4, 14))
        step = np.exp(rng.uniform(-1.5, 1.5, n)) * (30.0 / n)
        turn = np.cumsum(rng.normal(0.0, (0.05, 0.3, 0.6)[number % 3], n))
        points = np.cumsum(step[:, None] * np.column_stack([np.cos(turn), np.sin(turn)]), axis=0)
        kind = [int(each) for each in np.where(rng.random(n) < 0.1, 2, 0)]
        found.append(through(points + rng.uniform(-300.0, 300.0, 2), kind))
    return found


@pytest.fixture(scope="module")
def curves() -> tuple[FloatArray, IntArray]:
    """Sixty random curves."""
    return splines(drawn(3, 60))


@pytest.fixture(scope="module")
def fit(curves: tuple[FloatArray, IntArray]) -> ArcFit:
    """Their arcs."""
    return fit_arcs(*curves, WITHIN)


def along(cubic: FloatArray, per: int) -> FloatArray:
    """Dense places on cubics, (p * per + 1, 2)."""
    u = np.arange(per) / per
    powers = np.stack([u**k for k in range(4)], axis=1)
    return np.concatenate([(powers @ cubic).reshape(-1, 2), cubic[-1].sum(axis=0)[None]])


def on_arcs(arcs: PlaneArcs, step: float) -> FloatArray:
    """Dense places on arcs."""
    count = np.maximum(np.ceil(arcs.length / step).astype(int), 8)
    arc = np.repeat(np.arange(len(arcs)), count)
    part = np.concatenate([np.arange(each) / each for each in count])
    return np.concatenate([arcs.at(arc, part * arcs.length[arc]), arcs.ends()[-1:]])


def farthest(places: FloatArray, others: FloatArray) -> float:
    """Largest distance of places from the polyline of others, near whose points they lie."""
    number = cKDTree(others).query(places)[1]
    best = np.full(len(places), np.inf)
    for shift in (-1, 0):
        low = np.clip(number + shift, 0, len(others) - 2)
        step = others[low + 1] - others[low]
        size = np.maximum((step * step).sum(axis=1), 1e-300)
        part = np.clip(((places - others[low]) * step).sum(axis=1) / size, 0.0, 1.0)
        best = np.minimum(best, np.hypot(*(others[low] + part[:, None] * step - places).T))
    return float(best.max())


def test_curves_and_arcs_keep_the_tolerance_both_ways(
    curves: tuple[FloatArray, IntArray], fit: ArcFit
) -> None:
    """Measured by polylines of both, finer than the search; the reported figure is that one."""
    cubic, start = curves
    assert not fit.stuck.any()
    for number in range(len(start) - 1):
        own = along(cubic[start[number] : start[number + 1]], 800)
        arcs = on_arcs(fit.of(number), 0.005)
        found = np.array([farthest(own, arcs), farthest(arcs, own)])
        assert (found <= WITHIN + 2e-6).all()
        assert found.max() == pytest.approx(fit.deviation[number].max(), rel=0.02, abs=2e-6)


def test_neighbours_join_and_are_tangent(fit: ArcFit) -> None:
    """Joints close to rounding, tangents to 1e-9 rad, but for corners of the curve."""
    smooth = np.flatnonzero(fit.smooth)
    inner = np.setdiff1d(np.arange(1, len(fit.arcs)), fit.start)
    ends, angles = fit.arcs.ends(), fit.arcs.end_angles()
    assert np.abs(ends[inner - 1] - fit.arcs.start[inner]).max() < 1e-12
    turn = np.abs(wrap_angle(angles[smooth - 1] - fit.arcs.angle[smooth]))
    assert turn.max() < 1e-9
    corner = np.setdiff1d(inner, smooth)
    assert np.abs(wrap_angle(angles[corner - 1] - fit.arcs.angle[corner])).min() > 1e-9


def test_ends_and_corners_keep_their_tangents(
    curves: tuple[FloatArray, IntArray], fit: ArcFit
) -> None:
    """A chain begins and ends where its curve does, in its direction; on both sides of corners."""
    cubic, start = curves
    pieces = FitPieces.of(cubic, start, 1e-6)
    first, last = start[:-1], start[1:] - 1
    begin, end = fit.start[:-1], fit.start[1:] - 1
    assert np.abs(fit.arcs.start[begin] - cubic[first, 0]).max() == 0.0
    assert np.abs(fit.arcs.ends()[end] - cubic[last].sum(axis=1)).max() < 1e-12
    corners = np.flatnonzero(~fit.smooth)
    piece = (
        np.flatnonzero(np.abs(wrap_angle(pieces.angle[1:, 0] - pieces.angle[:-1, 1])) > 1e-9) + 1
    )
    assert len(corners) >= len(piece)
    turn = wrap_angle(fit.arcs.angle[corners][:, None] - pieces.angle[:, 0])
    assert np.abs(turn).min(axis=1).max() < 1e-9
    turn = wrap_angle(fit.arcs.end_angles()[corners[1:] - 1][:, None] - pieces.angle[:, 1])
    assert np.abs(turn).min(axis=1).max() < 1e-9


def test_the_batch_does_not_matter(curves: tuple[FloatArray, IntArray], fit: ArcFit) -> None:
    """A curve by itself has the arcs it has among others, to rounding."""
    cubic, start = curves
    for number in (0, 17, 41):
        own = cubic[start[number] : start[number + 1]]
        alone = fit_arcs(own, np.array([0, len(own)]), WITHIN)
        assert len(alone.arcs) == len(fit.of(number))
        assert alone.arcs.length == pytest.approx(fit.of(number).length, rel=1e-6)


def test_a_wider_tolerance_takes_fewer_arcs(curves: tuple[FloatArray, IntArray]) -> None:
    """By about the cube root of the tolerance, as for arcs that join on the curve."""
    cubic, start = curves[0], curves[1][:21]
    few, many = (len(fit_arcs(cubic[: start[-1]], start, e).arcs) for e in (0.004, 0.0005))
    assert 1.5 < many / few < 2.4


def test_a_straight_run_is_one_line() -> None:
    """Of points on a line, at any spacing; what joins it smoothly begins in its direction."""
    x = np.array([0.0, 0.1, 40.0, 41.0, 90.0, 100.0])
    bent = np.column_stack([[104.0, 107.0, 109.0], [1.0, 3.0, 6.0]])
    points = np.concatenate([np.column_stack([x, 0.0 * x]), bent])
    ahead = np.zeros((9, 3))
    ahead[5, 0] = 1.0
    data = CurveData.single(
        np.column_stack([points, np.zeros(9)]), [0, 0, 0, 0, 0, 1, 0, 0, 0], ahead
    )
    found = fit_arcs(*splines([loft(data)]), WITHIN)
    assert found.arcs.curvature[0] == 0.0
    assert found.arcs.length[0] >= 90.0
    assert found.deviation.max() <= WITHIN


def test_a_circle_is_one_arc() -> None:
    """A spline through many points of a circle is one arc of it."""
    angle = np.linspace(0.0, 2.0, 120)
    points = 7.0 * np.column_stack([np.cos(angle), np.sin(angle)])
    ends = np.zeros((1, 2, 3))
    ends[0, :, :2] = [[0.0, 1.0], [-math.sin(2.0), math.cos(2.0)]]
    data = CurveData.single(
        np.column_stack([points, 0.0 * angle]), end_kind=(1, 1), end_vector=ends[0]
    )
    found = fit_arcs(*splines([loft(data)]), WITHIN)
    assert len(found.arcs) == 1
    assert found.arcs.curvature[0] == pytest.approx(1.0 / 7.0, rel=1e-6)


def test_both_tangents_of_a_knuckle_are_kept() -> None:
    """Two straight lines and their corner stay what they are."""
    points = np.array([[0.0, 0.0], [5.0, 0.0], [5.0, 3.0]])
    found = fit_arcs(*splines([through(points, [0, int(PointKind.KNUCKLE), 0])]), WITHIN)
    assert found.arcs.curvature.tolist() == [0.0, 0.0]
    assert found.arcs.angle == pytest.approx([0.0, 0.5 * math.pi])
    assert found.smooth.tolist() == [False, False]


def test_the_least_radius_is_kept_or_the_place_is_named() -> None:
    """A bend of 0.4 m radius: arcs of 0.3 m follow it, arcs of 0.8 m cannot."""
    angle = np.linspace(0.0, 1.6, 9)
    bend = 0.4 * np.column_stack([np.sin(angle), 1.0 - np.cos(angle)])
    way = np.array([np.cos(1.6), np.sin(1.6)])
    after = bend[-1] + np.array([[1.0], [3.0]]) * way
    points = np.concatenate([[[-3.0, 0.0], [-1.0, 0.0]], bend, after])
    given = splines([through(points)])
    found = fit_arcs(*given, WITHIN, 0.3)
    assert not found.stuck.any()
    assert 1.0 / np.abs(found.arcs.curvature).max() >= 0.3
    refused = fit_arcs(*given, WITHIN, 0.8)
    assert refused.stuck.all()
    assert len(refused.arcs) == 0
    x, y, radius = refused.sharpest[0]
    assert 0.2 < radius < 0.5
    assert -0.2 < x < 0.6
    assert -0.1 < y < 0.6


def test_radii_may_be_any() -> None:
    """A bend of a millimetre over a hundred metres is followed, and joins to rounding."""
    x = np.linspace(0.0, 100.0, 9)
    points = np.column_stack([x + 350.0, 25.5 + 1e-3 * np.sin(0.06 * x)])
    found = fit_arcs(*splines([through(points)]), 2e-5)
    assert found.deviation.max() <= 2e-5
    gap = np.abs(found.arcs.ends()[:-1] - found.arcs.start[1:]).max()
    assert gap < 1e-12
    assert (np.abs(wrap_angle(found.arcs.end_angles()[:-1] - found.arcs.angle[1:])) < 1e-9).all()


def test_biarcs_by_ratio_are_those_of_the_family() -> None:
    """Every ratio of chords, any angles, parallel ones too: the biarcs that ship elsewhere."""
    rng = np.random.default_rng(5)
    n = 500
    alpha, beta = rng.uniform(-1.5, 1.5, (2, n))
    beta[:100] = alpha[:100]
    chord, ratio = np.exp(rng.uniform(-4.0, 6.0, n)), rng.uniform(0.05, 0.95, n)
    zero = np.zeros((n, 2))
    ends = np.column_stack([chord, np.zeros(n)])
    arcs, tau = biarcs_of_shares(BiarcChords.of(zero, alpha, ends, beta), ratio, 1.0 - ratio)
    found = biarcs_by_ratio(chord, alpha, beta, ratio)
    assert found.tau == pytest.approx(tau, abs=1e-13)
    assert found.bend.T.ravel() * np.repeat(chord, 2) == pytest.approx(
        arcs.curvature * np.repeat(chord, 2), abs=1e-11
    )
    assert found.length.T.ravel() == pytest.approx(arcs.length, rel=1e-12)
    assert np.abs(found.join.T - arcs.start[1::2]).max() < 1e-11


LINE = np.array([[[0.0, 0.0], [1.0, 0.0], [0.0, 0.0], [0.0, 0.0]]])


@pytest.mark.parametrize(
    ("cubic", "start", "within", "radius", "message"),
    [
        (None, [0, 1], WITHIN, 0.0, "arcs: expected shape"),
        (LINE[:, :3], [0, 1], WITHIN, 0.0, "arcs: expected shape"),
        (LINE * np.nan, [0, 1], WITHIN, 0.0, "arcs: non-finite value"),
        (LINE, [0, 2], WITHIN, 0.0, "do not part 1 cubics"),
        (LINE, [], WITHIN, 0.0, "do not part 1 cubics"),
        (LINE, [0, 0.5, 1], WITHIN, 0.0, "do not part 1 cubics"),
        (LINE * 0.0, [0, 1], WITHIN, 0.0, "arcs: cubic 0 is a point"),
        (LINE, [0, 1], 0.0, 0.0, "arcs: within is 0"),
        (LINE, [0, 1], -1.0, 0.0, "arcs: within is -1"),
        (LINE, [0, 1], math.nan, 0.0, "arcs: within: non-finite"),
        (LINE, [0, 1], WITHIN, -2.0, "arcs: least_radius is -2"),
        (LINE, [0, 1], "a", 0.0, "arcs: within: expected shape"),
    ],
    ids=[
        "nothing", "quadratics", "no number", "too many", "no curve", "half a cubic", "point",
        "no tolerance", "negative", "nan", "negative radius", "word",
    ],
)  # fmt: skip
def test_what_makes_no_arcs_is_refused(
    cubic: FloatArray, start: IntArray, within: float, radius: float, message: str
) -> None:
    """By a message that says what is wrong, never from within numpy."""
    with pytest.raises(GeometryError, match=message):
        fit_arcs(cubic, start, within, radius)
