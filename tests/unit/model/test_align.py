"""Which root is which, against trying every pairing there is."""

from __future__ import annotations

from itertools import combinations, pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.model.network import align_curve, align_plane_roots
from assoc_hull.model.tables import CurveIntersections

Roots = tuple[np.typing.NDArray[np.int8], np.typing.NDArray[np.float64]]


@st.composite
def roots(draw: st.DrawFn) -> Roots:
    """Give roots along a line, with signs that alternate as on a curve."""
    at = sorted(draw(st.lists(st.integers(0, 60), max_size=6, unique=True)))
    first = draw(st.sampled_from((-1, 1)))
    sign = np.array([first * (-1) ** i for i in range(len(at))], np.int8)
    return sign, np.column_stack([np.array(at, float), np.zeros((len(at), 2))])


def pairings(old: Roots, new: Roots) -> list[list[tuple[int, int]]]:
    """All pairings of equal signs in which no two cross."""
    every = [(i, j) for i, a in enumerate(old[0]) for j, b in enumerate(new[0]) if a == b]
    return [
        list(chosen)
        for size in range(min(len(old[0]), len(new[0])) + 1)
        for chosen in combinations(every, size)
        if all(a[0] < b[0] and a[1] < b[1] for a, b in pairwise(chosen))
    ]


def moved(pairs: list[tuple[int, int]], old: Roots, new: Roots) -> float:
    """How far the paired roots have moved in all."""
    return float(sum(np.linalg.norm(old[1][i] - new[1][j]) for i, j in pairs))


@given(roots(), roots())
def test_most_pairs_then_the_least_movement(old: Roots, new: Roots) -> None:
    """The fewest births and deaths; among these the least total displacement."""
    found = align_plane_roots(*old, *new)
    every = pairings(old, new)
    assert found in every
    most = max(len(pairs) for pairs in every)
    assert len(found) == most
    if np.array_equal(old[0], new[0]):
        assert found == [(i, i) for i in range(len(old[0]))]
        return
    least = min(moved(pairs, old, new) for pairs in every if len(pairs) == most)
    assert moved(found, old, new) <= least + 1e-9


def line_of(places: list[float], first: int = 1) -> Roots:
    """Roots at given places, signs in turn."""
    sign = np.array([first * (-1) ** i for i in range(len(places))], np.int8)
    return sign, np.column_stack([places, np.zeros((len(places), 2))])


def test_a_pair_born_between_two_roots_is_told_from_them() -> None:
    """The outer ones stay what they were."""
    assert align_plane_roots(*line_of([10.0, 60.0]), *line_of([9.0, 30.0, 40.0, 61.0])) == [
        (0, 0),
        (1, 3),
    ]


def test_a_pair_that_dies_at_one_end_leaves_the_others() -> None:
    """Ordinals would shift."""
    assert align_plane_roots(*line_of([1.0, 2.0, 30.0, 50.0]), *line_of([31.0, 50.0])) == [
        (2, 0),
        (3, 1),
    ]


def test_a_root_lost_over_the_end_of_a_curve() -> None:
    """Alone, without its like."""
    assert align_plane_roots(*line_of([1.0, 20.0]), *line_of([20.5], -1)) == [(1, 0)]


def meets(line: list[int], sign: list[int], row: list[int], x: list[float]) -> CurveIntersections:
    """Meetings of a curve."""
    at = np.array(x)
    return CurveIntersections(
        np.array(line), np.array(sign, np.int8), np.array(row), at,
        np.column_stack([at, 0.0 * at, 0.0 * at]),
    )  # fmt: skip


def test_a_curve_is_aligned_plane_by_plane() -> None:
    """What has gone and come is told with the crossings they were."""
    old = meets([4, 4, 7], [1, -1, 1], [40, 41, 70], [1.0, 5.0, 3.0])
    new = meets([4, 4, 4, 4, 8], [1, -1, 1, -1, 1], [-1] * 5, [1.1, 2.0, 2.5, 5.1, 6.0])
    found = align_curve(3, old, new)
    assert found.row.tolist() == [40, -1, -1, 41, -1]
    assert found.gone.tolist() == [70]
    assert found.come.tolist() == [1, 2, 4]


def test_a_latent_meeting_that_goes_is_no_crossing_gone() -> None:
    """And one that stays is still latent, and did not come."""
    old = meets([4, 4], [1, -1], [-1, -1], [1.0, 5.0])
    new = meets([4], [-1], [-1], [5.0])
    found = align_curve(3, old, new)
    assert (found.row.tolist(), found.gone.tolist(), found.come.tolist()) == ([-1], [], [])
