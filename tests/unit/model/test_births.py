"""Counts of crossings by pairs of lines: they answer as a dict does."""

from __future__ import annotations

import pickle

import pytest
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.model.births import Births

LINES = ["WL 1", "WL 2", "ST 1 x", "x"]
PAIRS = st.tuples(st.sampled_from(LINES), st.sampled_from(LINES))
COUNTS = st.dictionaries(PAIRS, st.integers(0, 3))


@given(first=COUNTS, changes=st.lists(COUNTS, max_size=4))
def test_counts_are_those_of_a_dict(
    first: dict[tuple[str, str], int], changes: list[dict[tuple[str, str], int]]
) -> None:
    """Whatever pairs are counted anew; what was there before stays as it was."""
    births, wanted = Births.of({}).counted(first), {p: n for p, n in first.items() if n}
    for change in changes:
        before, then = births, dict(wanted)
        births = births.counted(change)
        wanted = {pair: count for pair, count in {**wanted, **change}.items() if count}
        odd = sorted(p for p in {*then, *wanted} if then.get(p) != wanted.get(p))
        assert before.differing(births) == odd
        assert births.differing(before) == odd
        assert before == then
    assert births == wanted
    assert dict(births.items()) == wanted
    assert len(births) == len(wanted)
    assert [births.get((a, b), 0) for a in LINES for b in LINES] == [
        wanted.get((a, b), 0) for a in LINES for b in LINES
    ]
    assert pickle.loads(pickle.dumps(births)) == wanted


def test_a_pair_that_had_no_crossing_is_not_there() -> None:
    """Neither one of known lines, nor one of lines that were never seen."""
    births = Births.of({("WL 1", "ST 1"): 2})
    for pair in (("ST 1", "WL 1"), ("WL 1", "other")):
        assert pair not in births
        with pytest.raises(KeyError):
            births[pair]
