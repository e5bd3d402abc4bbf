"""Folds of curves."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.errors import TooFewPointsError
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.splines.curve_order import curve_folds


def curve_of(
    xyz: list[list[float]], leave: list[list[float]], arrive: list[list[float]] | None = None
) -> SplineBatch:
    """A plane curve through points (x, y) with given derivatives at unit knot spans."""

    def space(rows: list[list[float]]) -> FloatArray:
        return np.column_stack([np.array(rows, float), np.zeros(len(rows))])

    return SplineBatch(
        np.array([0, len(xyz)]),
        np.arange(float(len(xyz))),
        space(xyz),
        space(leave),
        space(leave if arrive is None else arrive),
    )


def fair() -> SplineBatch:
    """A curve without a fold."""
    return curve_of([[0, 0], [2, 1], [4, 1]], [[1, 0.6], [1, 0.3], [1, -0.2]])


def test_a_fair_curve_has_none() -> None:
    """Chords and tangents that go on ahead are no fold."""
    assert len(curve_folds(fair())) == 0


def test_chords_that_turn_back() -> None:
    """Two chords at more than 90 degrees are a fold at the smooth point between them."""
    hook = curve_of([[0, 0], [4, 0], [1, 3]], [[1, 0], [0.1, 1], [-1, 1]])
    found = curve_folds(SplineBatch.join([fair(), hook]))
    assert (found.curve.tolist(), found.knot.tolist()) == ([1], [1])
    assert found.cosine[0] == pytest.approx(-(0.5**0.5), rel=1e-14)


def test_chords_at_a_right_angle_are_no_fold() -> None:
    """Exactly 90 degrees between chords is allowed."""
    assert len(curve_folds(curve_of([[0, 0], [4, 0], [4, 4]], [[1, 0], [1, 1], [0, 1]]))) == 0


def test_a_knuckle_may_be_sharp() -> None:
    """Where the derivatives differ, the chords may turn back."""
    chine = curve_of(
        [[0, 0], [4, 0], [1, 3]], [[1, 0], [-1, 1], [-1, 1]], [[1, 0], [1, 0], [-1, 1]]
    )
    assert len(curve_folds(chine)) == 0


@pytest.mark.parametrize(
    ("leave", "knot", "cosine"),
    [
        pytest.param([[-1, 0.1], [1, 0], [1, 0]], 0, -1 / 1.01**0.5, id="beginning"),
        pytest.param([[1, 0], [1, 0], [0, 2]], 2, 0.0, id="right angle at the end"),
        pytest.param([[1, 0], [-1, 0], [1, 0]], 1, -1.0, id="both sides of a smooth point"),
        pytest.param([[1, 0], [0, 0], [1, 0]], 1, 0.0, id="no direction"),
    ],
)
def test_tangents_that_turn_back(leave: list[list[float]], knot: int, cosine: float) -> None:
    """A tangent at 90 degrees or more to its chord is a fold, told once per point."""
    found = curve_folds(curve_of([[0, 0], [2, 0], [4, 0]], leave))
    assert found.knot.tolist() == [knot]
    assert found.cosine[0] == pytest.approx(cosine, abs=1e-15)


def test_a_tangent_at_a_knuckle_is_looked_at() -> None:
    """A knuckle excuses the turn of the chords, not a segment that starts backwards."""
    chine = curve_of([[0, 0], [4, 0], [4, 3]], [[1, 0], [0, -1], [0, 1]], [[1, 0], [1, 0], [0, 1]])
    assert curve_folds(chine).knot.tolist() == [1]


@given(st.integers(0, 2**32 - 1), st.integers(1, 8))
def test_the_rest_of_the_batch_does_not_matter(seed: int, count: int) -> None:
    """The folds of a batch are those of its curves, bit by bit."""
    random = np.random.default_rng(seed)
    curves = []
    for _ in range(count):
        size = int(random.integers(2, 9))
        rows = random.normal(size=(3, size, 2)).round(1)
        curves.append(curve_of(rows[0].tolist(), rows[1].tolist(), rows[2].tolist()))
    together = curve_folds(SplineBatch.join(curves))
    for index, curve in enumerate(curves):
        mine, alone = together.curve == index, curve_folds(curve)
        assert together.knot[mine].tolist() == alone.knot.tolist()
        assert together.cosine[mine].tolist() == alone.cosine.tolist()


@given(st.integers(0, 2**32 - 1))
def test_reversing_keeps_the_folds(seed: int) -> None:
    """Run the other way, a curve folds at the same points."""
    rows = np.random.default_rng(seed).normal(size=(3, 7, 2)).round(1)
    rows[2, 2:5] = rows[1, 2:5]
    there = curve_folds(curve_of(rows[0].tolist(), rows[1].tolist(), rows[2].tolist()))
    back = (rows[0, ::-1].tolist(), (-rows[2, ::-1]).tolist(), (-rows[1, ::-1]).tolist())
    again = curve_folds(curve_of(*back))
    assert sorted(6 - again.knot) == there.knot.tolist()


def test_one_point_is_refused() -> None:
    """A curve of one point is an error of the package."""
    with pytest.raises(TooFewPointsError):
        curve_folds(curve_of([[0, 0]], [[1, 0]]))
