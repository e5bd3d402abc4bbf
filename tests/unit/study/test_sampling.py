"""Samples: within their intervals, the same for the same seed, evenly spread."""

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.study.sampling import METHODS

RANGES = {"breadth": (9.0, 11.0), "draught": (6.0, 6.5)}


@pytest.mark.parametrize("method", METHODS)
def test_the_seed_alone_decides(method: str) -> None:
    """The same seed gives the same bits, another one other numbers, all within the intervals."""
    one, again, other = (
        ah.study.sample(RANGES, 20, seed=seed, method=method) for seed in (3, 3, 4)
    )
    for name, (low, high) in RANGES.items():
        assert one[name].tobytes() == again[name].tobytes()
        assert not (one[name] == other[name]).any()
        assert ((low <= one[name]) & (one[name] <= high)).all()
        assert not one[name].flags.writeable


def test_a_longer_sequence_begins_with_the_shorter_one() -> None:
    """So a study of Sobol's numbers can be carried on."""
    short, long = (ah.study.sample(RANGES, count, seed=1) for count in (5, 37))
    assert all((long[name][:5] == short[name]).all() for name in RANGES)


def test_a_latin_hypercube_has_one_value_in_each_part() -> None:
    """Of as many equal parts of every interval as there are values."""
    drawn = ah.study.sample(RANGES, 16, seed=1, method="latin")
    for name, (low, high) in RANGES.items():
        part = np.floor((drawn[name] - low) / (high - low) * 16)
        assert sorted(part.tolist()) == list(range(16))


@pytest.mark.parametrize(
    ("ranges", "count", "words"),
    [
        ({}, 3, "there are no ranges"),
        ({"breadth": (3.0, 3.0)}, 3, "the range of breadth"),
        ({"breadth": (3.0, float("nan"))}, 3, "the range of breadth"),
        ({"breadth": 3.0}, 3, "the range of breadth"),
        ({"breadth": (3.0, 4.0)}, 0, "count is 0"),
    ],
    ids=["nothing", "empty", "nan", "one number", "no count"],
)
def test_what_cannot_be_drawn_is_refused(ranges: dict[str, object], count: int, words: str) -> None:
    """With the name of what is wrong."""
    with pytest.raises(ah.errors.BadInputError, match=words):
        ah.study.sample(ranges, count)  # type: ignore[arg-type]
