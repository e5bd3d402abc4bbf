"""Waterlines of straight, quintic and conic, cubic conics too: test values, joins, refusals."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.optimize import least_squares

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.combined_waterline import combined_waterline
from assoc_hull.geometry.classical.pieced_curve import (
    FormulaPiece,
    PiecedCurve,
    conic,
    conic_coefficients,
    cubic_conic,
    cubic_conic_coefficients,
    fit_cubic_conic,
)
from tests.piece_values import PIECES

OFFSETS = [(24, 11.97), (30, 11.72), (36, 11.2), (42, 10.4), (48, 9.3), (54, 8)]


def fore(**other: Any) -> PiecedCurve:
    """The waterline of the test values, or one that differs."""
    given = {"x0": 20, "x1": 60, "x2": 75, "y0": 12, "y1": 6.5, "offsets": OFFSETS}
    return combined_waterline(**{**given, **other})


@pytest.fixture(scope="module")
def line() -> PiecedCurve:
    """The waterline of the test values."""
    return fore()


def test_the_test_values_of_the_waterline_are_met(line: PiecedCurve) -> None:
    """Coefficients, slopes, values, nose, area and both second derivatives at the change."""
    body, nose = line.pieces
    np.testing.assert_allclose(
        body.coefficients[3:], [PIECES[f"W.a{k}"] for k in (3, 4, 5)], rtol=1e-9
    )
    found = {
        "dyu": float(body.at(60.0, 1)) * 40.0,
        "dyv": -float(nose.at(60.0, 1)) * 15.0,
        "b1": nose.coefficients[1],
        "b2": nose.coefficients[2],
        "slope": float(line.at(60.0, 1)),
        "y50": float(line.at(50.0)),
        "y70": float(line.at(70.0)),
        "rho": nose.nose_radius(),
        "area": line.area(),
        "d2l": line.joins()[0].before,
        "d2r": line.joins()[0].after,
    }
    for name, value in found.items():
        assert value == pytest.approx(PIECES[f"W.{name}"], rel=1e-10), name
    assert line.notes == ()
    assert float(line.at(60.0, 2)) == line.joins()[0].after  # at a join: of the piece after


def test_a_cubic_conic_meets_its_test_values_and_the_curvature() -> None:
    """Its three coefficients, its middle; and the second derivative agrees at the change."""
    line = fore(last="cubic conic")
    nose = line.pieces[-1]
    wanted = [PIECES[f"K.b{k}"] for k in (1, 2, 3)]
    np.testing.assert_allclose(nose.coefficients[1:], wanted, rtol=1e-9)
    assert float(line.at(67.5)) == pytest.approx(PIECES["K.y"], rel=1e-11)
    join = line.joins()[0]
    assert abs(join.gap) < 1e-13
    assert abs(join.turn) < 1e-14
    assert join.after == pytest.approx(join.before, rel=1e-12)


def test_value_and_slope_agree_at_every_join() -> None:
    """4,000 random conics, ellipses to hyperbolas, with any s < y1: to 1e-12."""
    rng = np.random.default_rng(3)
    height = rng.uniform(0.1, 10.0, 4000)
    slope = height * rng.uniform(-2.0, 0.999, 4000)
    b1, b2 = conic_coefficients(height, slope).T
    assert (b1 > 0.0).all()
    value = np.sqrt(b1 + b2)
    np.testing.assert_allclose(value, height, rtol=1e-12)
    np.testing.assert_allclose((b1 + 2.0 * b2) / (2.0 * value), slope, atol=1e-12 * 10.0)
    # It is real all the way: v (b1 + b2 v) is linear in the bracket, positive at both ends.
    assert (b1 + b2 > 0.0).all()


def test_cubic_conics_meet_value_slope_and_bend() -> None:
    """Random ones, by the derivatives of the square; the bend nil is the parabola's and so on."""
    rng = np.random.default_rng(4)
    y, s, c = rng.uniform(0.1, 5.0, 500), rng.uniform(-5, 5, 500), rng.uniform(-9, 9, 500)
    b1, b2, b3 = cubic_conic_coefficients(y, s, c).T
    np.testing.assert_allclose(b1 + b2 + b3, y * y, rtol=0, atol=1e-12 * 200)
    np.testing.assert_allclose(b1 + 2 * b2 + 3 * b3, 2 * y * s, rtol=0, atol=1e-12 * 200)
    np.testing.assert_allclose(2 * b2 + 6 * b3, 2 * (s * s + y * c), rtol=0, atol=1e-12 * 400)


def test_straight_part_quintic_and_conic_join_with_value_and_slope() -> None:
    """Also where the straight part is not level, and where the end has a breadth."""
    offsets = [(x, y + 0.01 * (20 - x)) for x, y in OFFSETS]
    line = fore(start=0.0, slope=-0.01, end=0.5, offsets=offsets, y1=6.1)
    for join in line.joins():
        assert abs(join.gap) < 1e-12
        assert abs(join.turn) < 1e-12
    assert [piece.formula for piece in line.pieces] == ["line", "quintic", "conic"]
    assert line.at([0.0, 75.0]).tolist() == pytest.approx([12.2, 0.5])
    assert math.isinf(float(line.at(75.0, 1)))
    dense = np.linspace(0.0, 75.0, 200_001)
    assert line.area() == pytest.approx(float(np.trapezoid(line.at(dense), dense)), rel=1e-7)


def test_a_conic_of_the_slope_to_the_end_is_the_straight_line() -> None:
    """Equality is allowed: b1 is nil; and circles and parabolas are conics of their slope."""
    piece = conic(10.0, 14.0, 2.0, -0.5)
    assert piece.formula == "line"
    assert float(piece.at(12.0)) == 1.0
    quarter = conic(0.0, 3.0, 3.0, 0.0)
    x = np.linspace(0.0, 3.0, 7)
    np.testing.assert_allclose(quarter.at(x), np.sqrt(9.0 - x * x), atol=1e-14)
    assert quarter.area() == pytest.approx(9.0 * math.pi / 4.0, rel=1e-12)
    assert quarter.nose_radius() == pytest.approx(3.0)


def test_derivatives_are_those_of_the_values(line: PiecedCurve) -> None:
    """By differences of the curve itself, on both pieces; the nose by an offset beside it."""
    x, h = np.array([25.0, 45.0, 62.0, 70.0, 74.0]), 1e-4
    low, middle, high = line.at(x - h), line.at(x), line.at(x + h)
    np.testing.assert_allclose(line.at(x, 1), (high - low) / (2 * h), rtol=1e-6)
    np.testing.assert_allclose(line.at(x, 2), (high - 2 * middle + low) / h**2, rtol=1e-4)
    near = line.last - 1e-7
    nose = line.pieces[-1].nose_radius()
    assert float(line.at(near)) ** 2 / (2e-7) == pytest.approx(nose, rel=1e-6)


def test_notes_tell_of_bulges_and_waves() -> None:
    """A conic that swells beyond its beginning, a quintic that rises: told, not refused."""
    rising = fore(offsets=[(24, 11.97), (36, 9.0), (42, 6.0), (48, 4.8), (54, 5.0)])
    wave, bulge = rising.notes
    assert "waterline: y1'<0: conic bulges beyond y1 (y1' = -" in bulge
    assert "waterline: quintic is not monotone at u=" in wave
    assert bulge.endswith(".")
    u = float(wave.partition("u=")[2].partition(";")[0])
    assert float(rising.at(20.0 + 40.0 * u, 1)) > 0.0
    nose = rising.pieces[-1]
    assert float(nose.at(60.5)) > 6.5


def test_offsets_of_a_cubic_conic_are_fitted() -> None:
    """Exact data give it back; noise is met as by a search in y itself, to second order."""
    true = cubic_conic(0.0, 10.0, 4.0, -0.1, -0.02, 0.3)
    x = np.linspace(0.5, 9.5, 12)
    for held in ({}, {"value": 4.0}, {"value": 4.0, "slope": -0.1}):
        again = fit_cubic_conic(x, true.at(x), 0.0, 10.0, 0.3, **held)
        np.testing.assert_allclose(again.coefficients, true.coefficients, atol=1e-9)
    y = true.at(x) + 1e-3 * np.sin(17.0 * x)
    v = (10.0 - x) / 10.0
    powers = np.stack([v, v**2, v**3], axis=1)

    def off(b: np.ndarray) -> np.ndarray:
        height: np.ndarray = np.sqrt(powers @ b) + 0.3 - y
        return height

    best = least_squares(off, true.coefficients[1:], xtol=1e-14, ftol=1e-14, gtol=1e-14)
    mine = off(fit_cubic_conic(x, y, 0.0, 10.0, 0.3).coefficients[1:])
    assert float(mine @ mine) <= (1 + 1e-4) * 2.0 * best.cost


REFUSED: dict[str, tuple[str, Callable[[], object]]] = {
    "order of x": ("waterline: need x0 < x1 < x2; x0, x1, x2 are 60,", lambda: fore(x0=60)),
    "conic not real": (
        r"waterline: y1' = [0-9.]+ >= y1 = 6.5: conic is not real near the end; move x1",
        lambda: fore(x2=100),
    ),
    "conic not real, end of a breadth": (
        r"waterline: y1' = 5 >= y1 - A = 2: conic is not real",
        lambda: conic(0, 10, 3, -0.5, 1.0),
    ),
    "two offsets": (
        "waterline: fewer than 3 offsets in the quintic part", lambda: fore(offsets=OFFSETS[:2])
    ),
    "one place thrice": (
        "waterline: fewer than 3 offsets in the quintic part",
        lambda: fore(offsets=[(30, 11.7), (30, 11.7), (30, 11.7)]),
    ),
    "no offsets": (
        "waterline: fewer than 3 offsets", lambda: fore(offsets=np.zeros((0, 2))),
    ),
    "offset elsewhere": (
        r"waterline: x=64 outside \[20, 60\]", lambda: fore(offsets=[*OFFSETS, (64, 5)])
    ),
    "asked outside": (r"waterline: x=80 outside \[20, 75\]", lambda: fore().at(80.0)),
    "breadth that rises": ("half-breadths 12, 13, 0 at x0, x1, x2", lambda: fore(y1=13)),
    "straight part behind": ("straight part begins at x=25, after x0=20", lambda: fore(start=25)),
    "no such piece": ("last piece 'circle'", lambda: fore(last="circle")),
    "conic backward": ("conic from x=5 to x=5", lambda: conic(5, 5, 1, 0)),
    "conic that widens": ("half-breadth 1 not above 2", lambda: conic(0, 5, 1, 0, 2)),
    "radicand": (
        r"cubic conic: radicand negative at v=0\.\d+",
        lambda: cubic_conic(0.0, 1.0, 1.0, -5.0, 1.0),
    ),
    "no upright end": (
        r"cubic conic: b1 <= 0 at the end \(b1 = -", lambda: cubic_conic(0, 1, 1.0, -2.0, 0.0)
    ),
    "slope alone": (
        "cubic conic: a slope without a value",
        lambda: fit_cubic_conic([1, 2, 3], [3, 2, 1], 0, 4, slope=1.0),
    ),
    "offset beyond": (
        "cubic conic: offset at x=5 outside the piece",
        lambda: fit_cubic_conic([1, 2, 5], [3, 2, 1], 0, 4),
    ),
    "too few": ("cubic conic: rank-def", lambda: fit_cubic_conic([1, 2], [3, 2], 0, 4)),
    "cubic backward": ("cubic conic: from x=4 to x=0", lambda: cubic_conic(4, 0, 1, 0, 0)),
    "fit backward": ("cubic conic: from x=4 to", lambda: fit_cubic_conic([1], [1], 4, 0)),
    "no pieces": ("waterline: no pieces", lambda: PiecedCurve.make(())),
    "gap": (
        "waterline: a piece ends at x=1, the next begins at 2",
        lambda: PiecedCurve.make(
            tuple(FormulaPiece("line", a, a + 1.0, np.array([1.0])) for a in (0.0, 2.0))
        ),
    ),
    "third derivative": ("waterline: derivative of order 3", lambda: fore().at(30.0, 3)),
    "no number": ("waterline: non-finite value at index 0", lambda: fore().at([np.nan])),
    "shape of offsets": (r"expected shape \(n, 2\), got", lambda: fore(offsets=[1, 2, 3])),
}  # fmt: skip


@pytest.mark.parametrize(("message", "call"), REFUSED.values(), ids=REFUSED)
def test_what_makes_no_waterline_is_refused(message: str, call: Callable[[], object]) -> None:
    """With the numbers and what to do."""
    with pytest.raises(GeometryError, match=message):
        call()
