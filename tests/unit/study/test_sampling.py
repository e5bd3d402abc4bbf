"""Samples: within their intervals, the same for the same seed, evenly spread."""

import itertools
import json
from typing import Any

import numpy as np
import pandas as pd
import pytest

import assoc_hull as ah
from assoc_hull.study.design import METHODS, StudyDesign

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


def test_a_sample_tells_how_it_was_drawn() -> None:
    """The method and the seed; the table of a study that takes it tells so, too."""
    drawn = ah.study.sample(RANGES, 2, seed=5, method="latin")
    assert drawn.drawn == "latin, seed 5"
    found = ah.examples.wigley(stations=7, waterlines=5).study(set=drawn, outputs=["cb"])
    assert json.loads(found.to_json())["drawn"] == "latin, seed 5"


def test_a_grid_has_every_combination_once() -> None:
    """The last name runs fastest."""
    found = ah.study.grid({"breadth": [9.0, 10.0, 11.0], "draught": np.array([6.0, 6.5])})
    pairs = list(zip(found["breadth"].tolist(), found["draught"].tolist(), strict=True))
    assert pairs == list(itertools.product([9.0, 10.0, 11.0], [6.0, 6.5]))
    assert found.drawn == "grid of 3 x 2"


@pytest.mark.parametrize(
    ("axes", "words"),
    [
        ({}, "there are no axes"),
        ({"breadth": []}, "0 combinations"),
        ({"breadth": [1.0, float("nan")]}, "breadth is"),
        ({name: np.arange(1.0, 200.0) for name in "abc"}, "with c there are 7880599"),
    ],
    ids=["nothing", "no values", "nan", "too many"],
)
def test_what_is_no_grid_is_refused(axes: dict[str, Any], words: str) -> None:
    """With the name of what is wrong."""
    with pytest.raises(ah.errors.BadInputError, match=words):
        ah.study.grid(axes)


def test_rows_come_as_mappings_arrays_and_frames() -> None:
    """All are the same design; rows that do not name the same are refused."""
    drawn = ah.study.sample(RANGES, 3, seed=1)
    array = np.empty(3, [(name, float) for name in drawn])
    for name, column in drawn.items():
        array[name] = column
    rows = [dict(zip(drawn, row, strict=True)) for row in zip(*drawn.values(), strict=True)]
    for given in (array, rows, pd.DataFrame(drawn)):
        found = StudyDesign.of(set=given)
        assert found.given == tuple(drawn)
        assert found.values.tobytes() == StudyDesign.of(set=drawn).values.tobytes()
    with pytest.raises(ah.errors.BadInputError, match="same parameters"):
        StudyDesign.of(set=[{"breadth": 9.0}, {"draught": 6.0}])


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
