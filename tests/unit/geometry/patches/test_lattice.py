"""Places of patches, boxes that touch, arcs in order, loops: the ground that joining stands on."""

import numpy as np
import pytest

from assoc_hull.geometry.patches.cells import (
    Lattice,
    box_clusters,
    cancel_opposite_walks,
    connected_labels,
    shared_borders,
    touching_pairs,
)
from assoc_hull.geometry.patches.line_ends import chain_arcs, next_pieces


def test_patches_of_a_surface_lie_side_by_side() -> None:
    """Borders that two patches share have one place; surfaces and gaps keep patches apart."""
    spans = [(0.0, 0.3), (0.3, 0.7), (0.9, 1.0)]
    box = np.array([[span, (0.0, 1.0)] for span in [*spans, (0.3, 0.7)]])
    surface = np.array([0, 0, 0, 1])
    lattice = Lattice.of(surface, box)
    assert lattice.neighbours[:, :2].tolist() == [
        [False, True], [True, False], [False, False], [False, False],
    ]  # fmt: skip
    assert not lattice.neighbours[:, 2:].any()
    edge = lattice.place(np.array([0, 1]), np.array([[1.0, 0.4], [0.0, 0.4]]))
    assert edge[0].tolist() == edge[1].tolist()
    apart = np.abs(np.subtract.outer(lattice.corner[:, 0], lattice.corner[:, 0]))
    assert apart[2:, :2].min() > 1
    back = lattice.on_surface(box, lattice.place(np.arange(4), np.full((4, 2), 0.5)))
    np.testing.assert_allclose(back[:, 0], [0.15, 0.5, 0.95, 0.5], rtol=1e-15)
    assert lattice.borders(edge).tolist() == [1, 1]
    assert lattice.borders(lattice.place(np.array([0]), np.array([[0.0, 0.4]]))).tolist() == [0]
    assert lattice.patch_at(lattice.place(np.arange(4), np.full((4, 2), 0.5))).tolist() == [
        0, 1, 2, 3,
    ]  # fmt: skip


@pytest.mark.parametrize("seed", range(3))
def test_touching_boxes_are_those_of_all_pairs(seed: int) -> None:
    """Trees find the pairs that a comparison of each with each finds, of boxes of any size."""
    draw = np.random.default_rng(seed)
    low = draw.integers(0, 64, (150, 2)) / 64.0
    size = 2.0 ** -draw.integers(1, 7, (150, 1)) * draw.integers(0, 2, (150, 1))
    high = low + size
    meet = (low[:, None] <= high + 1e-9) & (low <= high[:, None] + 1e-9)
    a, b = np.nonzero(np.triu(meet.all(axis=2), 1))
    want = {frozenset(pair) for pair in zip(a.tolist(), b.tolist(), strict=True)}
    found = touching_pairs(low, high, 1e-9)
    assert {frozenset(pair) for pair in found.tolist()} == want
    assert len(found) == len(want)


def test_parts_are_numbered_by_their_first() -> None:
    """The number of a part tells in which order parts begin."""
    assert connected_labels(5, np.array([[4, 0], [3, 1]])).tolist() == [0, 1, 2, 1, 0]
    assert box_clusters(np.zeros((0, 2)), np.zeros((0, 2)), 1e-9).tolist() == []


@pytest.mark.parametrize("count", [0, 1, 2, 7, 500])
def test_arcs_come_in_the_order_of_their_chain(count: int) -> None:
    """Each arc of a chain is followed by the next; the last of a closed one by the first."""
    draw = np.random.default_rng(count)
    following = draw.permutation(count)
    following[draw.random(count) < 0.1] = -1
    chains = chain_arcs(following)
    assert sorted(chains.arcs.tolist()) == list(range(count))
    for i in range(len(chains)):
        arcs = chains.of(i)
        assert (following[arcs[:-1]] == arcs[1:]).all()
        assert following[arcs[-1]] == (arcs[0] if chains.closed[i] else -1)
        assert not chains.closed[i] or arcs[0] == arcs.min()


def test_loops_that_touch_in_a_point_stay_apart() -> None:
    """Two squares that share a corner are two loops, not one that crosses itself."""
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    both = np.concatenate([square, square + 1.0])
    after = np.concatenate([np.roll(square, -1, axis=0), np.roll(square, -1, axis=0) + 1.0])
    pieces = np.stack([both, after], axis=1)
    order = np.array([5, 0, 7, 2, 4, 1, 3, 6])
    pieces = pieces[order]
    along = pieces[:, 1] - pieces[:, 0]
    chains = chain_arcs(next_pieces(pieces, along, along))
    assert chains.closed.tolist() == [True, True]
    assert sorted(sorted(order[chains.of(i)].tolist()) for i in (0, 1)) == [
        [0, 1, 2, 3],
        [4, 5, 6, 7],
    ]


def test_what_is_walked_both_ways_cancels() -> None:
    """Of two squares with half a side in common the outline is left; the common part is between."""
    corners = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    one = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
    other = one + np.array([1.0, 0.5])
    left = cancel_opposite_walks(np.concatenate([one, other]))
    a, b = left[:, 0], left[:, 1]
    assert 0.5 * (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum() == 2.0
    assert np.abs(b - a).sum() == 7.0
    assert shared_borders(one, other).tolist() == [[[1.0, 0.5], [1.0, 1.0]]]
    assert shared_borders(other, one).tolist() == [[[1.0, 1.0], [1.0, 0.5]]]
