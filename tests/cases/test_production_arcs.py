"""Arcs of ships' lines: the DTC, whose net was cut from a mesh, and Series 60."""

import numpy as np
import pytest

from assoc_hull.geometry.classical.arc_chain_search import FitPieces
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.segments import power_coefficients
from assoc_hull.hull import Hull
from assoc_hull.hull.results import ProductionArcs
from tests.arc_optimum import PlaneCurve, fewest_exact

WITHIN = 0.0005
DENSER = 260
"""Places per arc: the search looks at 24, or at most 24 to a biarc."""


@pytest.fixture(scope="module")
def arcs(dtc: Hull) -> ProductionArcs:
    """All lines of the DTC."""
    return dtc.production_arcs(within=WITHIN)


def curve_of(hull: Hull, name: str) -> tuple[FloatArray, FloatArray]:
    """Dense places of a curve and the cubics, by its name."""
    found = hull.find(name)
    spline = getattr(found, "curves", [found])[0].spline
    u = np.linspace(0.0, 1.0, DENSER)
    cubic = power_coefficients(spline)
    return (np.stack([u**k for k in range(4)], axis=1) @ cubic).reshape(-1, 3), cubic


def test_the_waterlines_of_the_dtc_keep_half_a_millimetre(dtc: Hull, arcs: ProductionArcs) -> None:
    """Both ways on ten times as many places as the search had: arcs from the curve by its nearest
    place, the curve from the arcs by the distance to the nearest of them."""
    lines = [line for line in arcs.lines if line.group == "waterlines"]
    worst = 0.0
    for line in lines:
        own = line.arcs
        arc = np.repeat(np.arange(len(own)), DENSER)
        t = np.tile(np.linspace(0.0, 1.0, DENSER), len(own)) * own.length[arc]
        found = dtc.find(line.name)
        spline = getattr(found, "curves", [found])[0].spline
        worst = max(worst, float(closest_points(spline, 0, line.in_space(own.at(arc, t)))[2].max()))
        places = curve_of(dtc, line.name)[0] @ line.axes[:2].T
        worst = max(worst, nearest(own, places))
    print(f"{len(lines)} waterlines, at most {1e3 * worst:.4f} mm off")
    assert worst <= WITHIN
    assert worst == pytest.approx(max(line.deviation.max() for line in lines), rel=0.01)


def nearest(arcs: PlaneArcs, places: FloatArray) -> float:
    """The largest distance of places from the nearest of arcs: of three by where they begin."""
    begin = np.concatenate([[0.0], np.cumsum(arcs.length)])
    run = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(places, axis=0).T))])
    run *= begin[-1] / run[-1]
    number = np.clip(np.searchsorted(begin, run, "right") - 1, 0, len(arcs) - 1)
    near = [arcs.distance(np.clip(number + by, 0, len(arcs) - 1), places) for by in (-1, 0, 1)]
    return float(np.min(near, axis=0).max())


def test_all_lines_of_the_dtc_come_out(arcs: ProductionArcs) -> None:
    """Sections, waterlines, buttocks, boundary: joined, tangent to 1e-9 rad but for knuckles."""
    assert arcs.left_out == arcs.notes == ()
    assert {line.group for line in arcs.lines} == {
        "boundary", "sections", "waterlines", "buttocks"
    }  # fmt: skip
    assert arcs.deviation <= WITHIN
    for line in arcs.lines:
        own = line.arcs
        turn = np.angle(np.exp(1j * (own.end_angles()[:-1] - own.angle[1:])))
        assert np.abs(own.ends()[:-1] - own.start[1:]).max(initial=0.0) < 1e-12
        assert np.abs(turn[line.smooth[1:]]).max(initial=0.0) < 1e-9


def test_waterlines_take_half_the_arcs_of_a_biarc_per_interval(arcs: ProductionArcs) -> None:
    """Of one biarc between neighbouring points of the net, in all and nearly line by line."""
    lines = [line for line in arcs.lines if line.group == "waterlines"]
    ours = sum(len(line.arcs) for line in lines)
    one = sum(2 * (line.points - 1) for line in lines)
    print(f"{ours} arcs, {one} with one biarc per interval of the net")
    assert ours <= 0.5 * one
    assert sum(len(line.arcs) > line.points - 1 for line in lines) <= 1


@pytest.mark.parametrize("name", ["WL 0.85", "WL 17.85", "WL 33.15"])
def test_no_chain_of_biarcs_has_fewer_arcs(dtc: Hull, arcs: ProductionArcs, name: str) -> None:
    """The optimum by dynamic programming over all pairs of 4 break points a cubic, as long as
    biarcs keep the tangents of the curve at break points; so 1.25 of it is kept by far."""
    line = next(each for each in arcs.lines if each.name == name)
    cubic = np.ascontiguousarray(curve_of(dtc, name)[1] @ line.axes[:2].T)
    pieces = FitPieces.of(cubic, np.array([0, len(cubic)]), 1e-6)
    optimum = 0
    for first, stop, straight in zip(pieces.first, pieces.stop, pieces.straight, strict=True):
        curve = PlaneCurve(cubic[first:stop], 4, 8)
        optimum += 1 if straight else fewest_exact(curve, WITHIN, 20, np.linspace(0.2, 0.8, 7))
    print(f"{name}: {len(line.arcs)} arcs, optimum {optimum}, {2 * line.points - 2} by intervals")
    assert len(line.arcs) <= optimum


def test_the_least_radius_of_the_dtc_is_kept(dtc: Hull) -> None:
    """1 m: lines that bend more sharply are named with their place, all others keep it."""
    lines = ["WL 4.25", "WL 5.95", "WL 26.35", "WL 33.15", "buttocks"]
    found = dtc.production_arcs(lines[1:4], WITHIN, 1.0)
    assert found.least_radius >= 1.0
    assert found.deviation <= WITHIN
    with pytest.raises(ValueError, match=r"WL 4.25 has a radius of 0.3397 m at \(9.685, 0.155"):
        dtc.production_arcs(lines[0], WITHIN, 1.0)


def test_all_lines_of_series60_come_out(series60_70: Hull) -> None:
    """With a quarter of the arcs of one biarc per interval of the net."""
    found = series60_70.production_arcs(within=WITHIN)
    assert found.left_out == found.notes == ()
    assert found.deviation <= WITHIN
    assert found.count <= 0.26 * found.one_per_interval
