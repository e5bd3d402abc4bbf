"""The queue of rows: each number is handed out, and once more if it comes back."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.study.side_processes import MOST_ROWS, RowQueue


@given(
    st.sets(st.integers(0, 3000), max_size=600),
    st.integers(1, 9),
    st.lists(st.floats(1e-4, 9.0), min_size=1, max_size=9),
    st.integers(2, 7),
)
def test_each_row_is_handed_out_until_it_is_made(
    numbers: set[int], sharers: int, seconds: list[float], lost: int
) -> None:
    """Whatever batches take, and though each n-th is lost once; none is longer than 64 rows."""
    queue = RowQueue(np.array(sorted(numbers), np.int64), sharers)
    made: list[int] = []
    tried: set[tuple[int, ...]] = set()
    while batch := queue.take():
        assert len(batch) <= MOST_ROWS
        if batch not in tried and len(tried) % lost == 0:
            queue.give_back(batch)
        else:
            made += batch
            queue.learn(len(batch), seconds[len(made) % len(seconds)])
        tried.add(batch)
    assert sorted(made) == sorted(numbers)


def test_batches_come_to_take_as_long_as_is_wanted() -> None:
    """From one row, by doubling; shorter at the end, where processes share what is left."""
    queue = RowQueue(np.arange(1000), 2, seconds=0.5)
    sizes = []
    while batch := queue.take():
        sizes.append(len(batch))
        queue.learn(len(batch), 0.02 * len(batch))
    assert sizes[:6] == [1, 2, 4, 8, 16, 25]
    assert max(sizes) == 25
    assert sizes[-1] == 1
