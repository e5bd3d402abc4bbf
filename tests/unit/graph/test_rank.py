"""Levels by longest path, and the ring that forbids them."""

from __future__ import annotations

import itertools
import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.errors import RingError
from assoc_hull.graph.run_update import levels

Edges = list[tuple[int, int]]


def rank(count: int, edges: Edges) -> list[int]:
    """Call `levels` with pairs of source and reader."""
    found = levels(count, [a for a, _ in edges], [b for _, b in edges], "n{}".format)
    return [int(level) for level in found]


@st.composite
def graphs(draw: st.DrawFn) -> tuple[int, Edges]:
    """Give graphs without a ring: edges run up a random order."""
    count = draw(st.integers(1, 12))
    order = draw(st.permutations(range(count)))
    number = st.integers(0, count - 1)
    pairs = draw(st.lists(st.tuples(number, number), max_size=30))
    return count, [(order[min(a, b)], order[max(a, b)]) for a, b in pairs if a != b]


def longest(node: int, edges: Edges) -> int:
    """The longest path that leads to a node, by walking back."""
    return max((1 + longest(a, edges) for a, b in edges if b == node), default=0)


@given(graphs())
def test_a_level_is_the_longest_path_that_leads_there(graph: tuple[int, Edges]) -> None:
    """As a walk back from every node finds it; every edge runs upward."""
    count, edges = graph
    found = rank(count, edges)
    assert found == [longest(node, edges) for node in range(count)]
    assert all(found[a] < found[b] for a, b in edges)


@given(graphs(), st.randoms(use_true_random=False))
def test_the_order_of_the_edges_says_nothing(graph: tuple[int, Edges], rng: random.Random) -> None:
    """Shuffled, and each twice."""
    count, edges = graph
    other = edges * 2
    rng.shuffle(other)
    assert rank(count, other) == rank(count, edges)


@given(graphs(), st.data())
def test_a_ring_is_refused_with_its_path(graph: tuple[int, Edges], data: st.DataObject) -> None:
    """Each step of the path is an edge, it ends where it begins, at its lowest node."""
    count, edges = graph
    if not edges:
        edges, count = [(0, 1)], max(count, 2)
    first, last = data.draw(st.sampled_from(edges))
    ring = [*edges, (last, first)]
    with pytest.raises(RingError) as caught:
        rank(count, ring)
    path = [int(name[1:]) for name in caught.value.path]
    assert path[0] == path[-1] == min(path)
    assert len(path) == len(set(path)) + 1
    assert all(step in ring for step in itertools.pairwise(path))


def test_a_node_that_reads_itself_is_a_ring() -> None:
    """Of one node."""
    with pytest.raises(RingError) as caught:
        rank(2, [(0, 1), (1, 1)])
    assert caught.value.path == ("n1", "n1")


def test_no_edges_no_levels() -> None:
    """All nodes are free."""
    assert rank(3, []) == [0, 0, 0]
    assert rank(0, []) == []
