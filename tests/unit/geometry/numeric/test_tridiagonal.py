"""Many tridiagonal systems at once."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.linalg import solve_banded

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.tridiagonal import (
    Workspace,
    running_sums,
    slots_of,
    solve_tridiagonal,
)

COUNTS = (1, 2, 3, 4, 5, 7, 8, 9, 16, 17, 63, 64, 65, 100, 129, 300)


def random_rows(count: int, seed: int) -> FloatArray:
    """Rows of one system whose couplings sum to at most one half."""
    rng = np.random.default_rng(seed)
    rows = rng.normal(size=(5, count + 1))
    share = rng.random(count + 1)
    rows[0], rows[4] = -0.5 * share, -0.5 * (1.0 - share)
    rows[0, 0] = rows[4, count - 1] = 0.0
    rows[:, count] = 0.0
    return rows


def solved(start: list[int], rows: FloatArray) -> FloatArray:
    """The solution, outside scratch memory."""
    with Workspace() as workspace:
        return solve_tridiagonal(slots_of(np.array(start)), rows, workspace) + 0.0


@pytest.mark.parametrize("count", COUNTS)
def test_one_system_is_solved_to_rounding(count: int) -> None:
    """Six reductions are enough for systems of any length."""
    rows = random_rows(count, count)
    banded = np.zeros((3, count))
    banded[0, 1:], banded[1], banded[2, :-1] = -rows[4, : count - 1], 1.0, -rows[0, 1:count]
    expected = solve_banded((1, 1), banded, rows[1:4, :count].T).T
    np.testing.assert_allclose(solved([0, count], rows), expected, rtol=0, atol=1e-14)


def test_a_geometric_chain_is_solved_to_rounding() -> None:
    """The couplings that decay slowest, all on one side, still vanish in six reductions."""
    count = 200
    rows = np.zeros((5, count + 1))
    rows[0, 1:count] = 0.5
    rows[1, 0] = 1.0
    expected = 0.5 ** np.arange(count)
    np.testing.assert_allclose(solved([0, count], rows)[0], expected, rtol=1e-15, atol=1e-18)


def test_a_system_alone_has_the_bits_it_has_among_others() -> None:
    """What else is in the batch changes no bit of a solution."""
    systems = [random_rows(count, count)[:, :count] for count in COUNTS]
    start = [0, *np.cumsum(COUNTS).tolist()]
    together = solved(start, np.hstack([*systems, np.zeros((5, 1))]))
    for system, (begin, end) in zip(systems, pairwise(start), strict=True):
        alone = solved([0, end - begin], np.hstack([system, np.zeros((5, 1))]))
        assert alone.tobytes() == together[:, begin:end].tobytes()


def test_sums_run_strictly_one_after_the_other() -> None:
    """The running sum has the bits of a plain loop, for systems of any length."""
    rng = np.random.default_rng(1)
    steps = rng.random(sum(COUNTS) + 1)
    start = np.array([0, *np.cumsum(COUNTS)])
    steps[start] = 0.0
    got = running_sums(slots_of(start), steps)
    for begin, end in pairwise(start.tolist()):
        total = 0.0
        for place in range(begin, end):
            total += float(steps[place])
            assert got[place] == total


def test_the_layout_holds_every_row_once() -> None:
    """Every flat row has a slotted place of its own, at a multiple of the slot length."""
    slots = slots_of(np.array([0, 3, 3, 12, 13]))
    assert len(set(slots.home.tolist())) == 13
    assert slots.source[slots.home].tolist() == list(range(13))
    assert slots.shortest == 0
