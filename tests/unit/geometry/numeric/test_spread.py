"""Labels on a rail are moved apart as little as possible."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.geometry.numeric.interval_spacing import space_intervals

LABELS = st.lists(st.tuples(st.floats(-50.0, 50.0), st.floats(0.5, 8.0)), min_size=0, max_size=20)


@given(LABELS, st.floats(0.0, 1.0))
def test_labels_do_not_touch_and_keep_their_order(
    labels: list[tuple[float, float]], gap: float
) -> None:
    """Neighbours are a gap or more apart, in the order of the wanted places."""
    wanted = np.array([place for place, _ in labels])
    size = np.array([length for _, length in labels])
    found = space_intervals(wanted, size, gap)
    order = np.argsort(wanted, kind="stable")
    apart = np.diff(found[order]) - 0.5 * (size[order][1:] + size[order][:-1])
    assert (apart >= gap - 1e-9).all()


@given(LABELS)
def test_labels_are_not_moved_without_need(labels: list[tuple[float, float]]) -> None:
    """The movements sum to nil, and spread labels stay where they are when spread again."""
    wanted = np.array([place for place, _ in labels])
    size = np.array([length for _, length in labels])
    found = space_intervals(wanted, size)
    assert abs((found - wanted).sum()) < 1e-6
    assert np.allclose(space_intervals(found, size), found, atol=1e-9)
