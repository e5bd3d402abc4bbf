"""The front: nothing on it is dominated, all else is, whatever the order of rows."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

import assoc_hull as ah
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.study.pareto import front_of

COSTS = arrays(
    np.float64, array_shapes(min_dims=2, max_dims=2, max_side=30),
    elements=st.one_of(st.integers(0, 5).map(float), st.just(float("nan"))),
)  # fmt: skip


def dominated(row: FloatArray, others: FloatArray) -> bool:
    """Whether one of others is at least as good in all, and better in one."""
    return bool(((others <= row).all(axis=1) & (others < row).any(axis=1)).any())


@given(COSTS)
def test_a_row_is_on_the_front_if_no_other_is_better_in_every_respect(cost: FloatArray) -> None:
    """By the definition, row by row; rows with nan are neither on it, nor count."""
    whole = [bool(np.isfinite(row).all()) for row in cost]
    known = cost[whole]
    expected = [count and not dominated(row, known)
                for row, count in zip(cost, whole, strict=True)]  # fmt: skip
    assert front_of(cost).tolist() == expected


def test_long_tables_are_looked_at_in_parts() -> None:
    """More rows, and a longer front, than are compared at once."""
    angle = np.random.default_rng(1).permutation(np.linspace(0.0, 1.5, 1500))
    arc = np.column_stack([1.0 - np.sin(angle), 1.0 - np.cos(angle)])
    found = front_of(np.concatenate([arc + 0.01, arc, arc + 0.5]))
    assert np.flatnonzero(found).tolist() == list(range(1500, 3000))


TABLE: dict[str, Any] = {
    "number": np.arange(4),
    "cb": np.array([0.80, 0.70, 0.60, np.nan]),
    "kmt": np.array([5.0, 6.0, 7.0, 9.0]),
    "failure": np.array(["", "", "", "refused"], object),
}


def test_limits_take_rows_off_the_front() -> None:
    """Those beyond do not keep others from it; nor do variants without a hull."""
    better = {"kmt": "more"}
    front = ah.study.pareto_front
    assert front(TABLE, better).tolist() == [False, False, True, False]
    assert front(TABLE, better, {"cb": (0.65, None)}).tolist() == [False, True, False, False]
    assert not front(TABLE, better, {"cb": (0.9, 0.95)}).any()


@pytest.mark.parametrize(
    ("better", "within", "words"),
    [
        ({}, None, "no column is named"),
        ({"kmt": "up"}, None, "better of kmt"),
        ({"kmf": "more"}, None, "'kmt'"),
        ({"failure": "more"}, None, "failure"),
        ({"kmt": "more"}, {"cb": (0.9, 0.1)}, "limits of cb"),
        ({"kmt": "more"}, {"cb": 0.9}, "limits of cb"),
        ({"kmt": "more"}, {"cp": (0.1, 0.9)}, "'cb'"),
    ],
    ids=["nothing", "direction", "name", "words", "reversed", "one end", "name of a limit"],
)
def test_what_cannot_be_judged_is_refused(better: Any, within: Any, words: str) -> None:
    """With the name of what is wrong."""
    with pytest.raises(ah.AssocHullError, match=words):
        ah.study.pareto_front(TABLE, better, within)
