"""Batches of what curves are made from."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import CurveData, EndKind, PointKind


def test_curves_through_some_of_their_points_are_those_points_and_ends() -> None:
    """A curve that keeps no point goes; the others keep kinds, directions and end conditions."""
    rng = np.random.default_rng(3)
    start, n = np.array([0, 4, 7, 12]), 12
    kind = rng.integers(0, 3, n).astype(np.int8)
    ends = np.array([[0, 1], [1, 0], [2, 1]], np.int8)
    data = CurveData(
        start, rng.normal(size=(n, 3)), kind, rng.normal(size=(n, 3)), ends,
        rng.normal(size=(3, 2, 3)),
    )  # fmt: skip
    keep = np.ones(n, bool)
    keep[[1, 4, 5, 6, 9, 10]] = False
    some = data.through(keep)
    assert some.start.tolist() == [0, 3, 6]
    for name in ("xyz", "kind", "direction"):
        assert np.array_equal(getattr(some, name), getattr(data, name)[keep])
    for name in ("end_kind", "end_vector"):
        assert np.array_equal(getattr(some, name), getattr(data, name)[[0, 2]])
    assert not some.xyz.flags.writeable


def test_a_curve_through_all_its_points_is_itself() -> None:
    """To the bit."""
    end = (EndKind.TANGENT, EndKind.FREE)
    one = CurveData.single(
        np.eye(3), [PointKind.SMOOTH] * 3, end_kind=end, end_vector=np.ones((2, 3))
    )
    same = one.through(np.ones(3, bool))
    for name in ("start", "xyz", "kind", "direction", "end_kind", "end_vector"):
        assert np.array_equal(getattr(same, name), getattr(one, name))
