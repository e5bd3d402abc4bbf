"""What is asked of an aimed variant, a shift, a swing or a study: good values, or an error."""

from __future__ import annotations

import contextlib
import inspect
import warnings
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np
import pytest

import assoc_hull as ah

NAN, INF, HUGE, VAST = float("nan"), float("inf"), 2**70, 10**400
WRONG: dict[str, Any] = {
    "nan": NAN, "inf": INF, "text": "a", "line of text": "\n", "bytes": b"a", "complex": 1j,
    "truth": True, "huge": HUGE, "vast": VAST, "less than vast": -VAST, "long text": "a" * 500,
    "empty list": [],
    "list in a list": [[1.0]], "mapping": {"a": 1}, "set": {1, 2}, "object": object(),
    "class": type, "function": lambda: 1.0, "flat array": np.zeros(4),
    "nan array": np.full((2, 3), NAN), "array of text": np.array(["a"]),
}  # fmt: skip
"""None of these is a number for a ship, a name, a list of names, or a mapping of good values."""

TARGET, FREE = {"volume": 2800.0}, ["breadth"]
AIM: dict[str, Any] = {"reach": TARGET, "free": FREE}
ROW: dict[str, Any] = {**AIM, "outputs": ["volume"]}
RAW = {"name": "a", "fields": []}

PLACES: dict[str, Callable[[ah.Hull, Any], object]] = {
    "reach": lambda hull, bad: hull.vary(reach=bad, free=FREE),
    "value to reach": lambda hull, bad: hull.vary(reach={"volume": bad}, free=FREE),
    "free": lambda hull, bad: hull.vary(reach=TARGET, free=bad),
    "one that is free": lambda hull, bad: hull.vary(reach=TARGET, free=["breadth", bad]),
    "name of a free layer": lambda hull, bad: hull.vary(
        reach=TARGET, free=[{**RAW, "name": bad}]
    ),
    "field of a free layer": lambda hull, bad: hull.vary(
        reach=TARGET, free=[{**RAW, "fields": [bad]}]
    ),
    "bounds": lambda hull, bad: hull.vary(**AIM, bounds=bad),
    "pair of bounds": lambda hull, bad: hull.vary(**AIM, bounds={"breadth": bad}),
    "lower bound": lambda hull, bad: hull.vary(**AIM, bounds={"breadth": (bad, 11.0)}),
    "exact": lambda hull, bad: hull.vary(**AIM, exact=bad),
    "script": lambda hull, bad: hull.vary_by({**AIM, "bounds": bad}),
    "to": lambda hull, bad: hull.shift_sections(to=bad),
    "value to shift to": lambda hull, bad: hull.shift_sections(to={"cb": bad}),
    "value to shift by": lambda hull, bad: hull.shift_sections(by={"lcb": bad}),
    "terminals": lambda hull, bad: hull.shift_sections(by={"cb": 0.005}, terminals=bad),
    "shape": lambda hull, bad: hull.shift_sections(by={"cb": 0.005}, shape=bad),
    "length": lambda hull, bad: hull.swing(length=bad),
    "draught to swing to": lambda hull, bad: hull.swing(draught=bad),
    "values of a study": lambda hull, bad: hull.study(set={"breadth": [10.1, bad]}),
    "targets of a study": lambda hull, bad: hull.study(**{**ROW, "reach": {"volume": bad}}),
    "row of a study": lambda hull, bad: hull.study(**{**ROW, "reach": [TARGET, bad]}),
    "bounds of a study": lambda hull, bad: hull.study(**ROW, bounds={"breadth": (9.0, bad)}),
    "output of a study": lambda hull, bad: hull.study(**{**ROW, "outputs": [bad]}),
    "file of a study": lambda hull, bad: hull.study(set={"breadth": 10.1}, file=bad),
    "workers of a study": lambda hull, bad: hull.study(set={"breadth": 10.1}, workers=bad),
    "cluster of a study": lambda hull, bad: hull.study(set={"breadth": 10.1}, cluster=bad),
    "values of a grid": lambda hull, bad: ah.study.grid({"breadth": bad}),
    "range": lambda hull, bad: ah.study.sample({"breadth": bad}, 2),
    "end of a range": lambda hull, bad: ah.study.sample({"breadth": (bad, 11.0)}, 2),
}  # fmt: skip
GOOD = {
    "exact": {"truth"}, "bounds of a study": {"inf"},
    "targets of a study": {"huge", "flat array"}, "values of a grid": {"flat array"},
    "file of a study": {"text", "line of text", "long text"},
    "name of a free layer": {"text", "line of text", "long text"},
}  # fmt: skip
"""What is good in this place alone."""

STUDY = {"hull": "number", "to_csv": "path", "to_json": "path", "to_parquet": "path"}
"""The argument of each method."""
FILES = {"text", "line of text", "long text"}


@pytest.fixture(scope="module")
def hull() -> ah.Hull:
    """A small net."""
    return ah.examples.wigley(stations=9, waterlines=6)


@pytest.fixture(scope="module")
def study(hull: ah.Hull) -> ah.study.Study:
    """A variant that is made, and one that is refused."""
    return hull.study(set={"breadth": [10.1, -3.0]}, outputs=["volume"])


def refused(what: str, act: Callable[[], object]) -> None:
    """An error of the family is raised, in one line, without a warning."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            with pytest.raises(ah.AssocHullError) as caught:
                act()
        except BaseException as error:
            error.add_note(what)
            raise
    assert "\n" not in str(caught.value), what
    assert 10 < len(str(caught.value)) < 400, what


@pytest.mark.parametrize("place", PLACES)
def test_what_is_asked_for_is_good_or_refused(hull: ah.Hull, place: str) -> None:
    """By an error that tells it, before anything is changed."""
    before = hull.fingerprint
    for kind, value in WRONG.items():
        if kind not in GOOD.get(place, set()):
            refused(kind, partial(PLACES[place], hull, value))
    assert hull.fingerprint == before
    assert hull.history == ()


@pytest.mark.parametrize(
    "bounds",
    [(11.0, 9.0), (9.0,), (9.0, 10.0, 11.0), ("low", "high"), (INF, -INF), (10.5, 11.0, None)],
    ids=str,
)
def test_bounds_are_a_lower_and_an_upper_one(hull: ah.Hull, bounds: Any) -> None:
    """Reversed ones are refused too; as are those of a parameter that is not free."""
    for name, given in (("breadth", bounds), ("draught", (4.0, 6.0))):
        refused(name, partial(ah.Hull.vary, hull, **AIM, bounds={name: given}))
        refused(name, partial(ah.Hull.study, hull, **ROW, bounds={name: given}))


@pytest.mark.parametrize(
    "given",
    [
        {"to": {"cb": 0.45}, "by": {"cb": 0.01}},
        {"by": {"cb": 0.01, "volume": 3.0}},
        {"by": {}},
        {"by": {"Cb": 0.01}},
        {"by": {"cb": 0.01}, "terminals": (100.0, 60.0, 40.0, 0.0)},
        {"by": {"cb": 0.01}, "terminals": (0.0, 40.0, 60.0)},
        {"by": {"cb": 0.01}, "terminals": 3.0},
    ],
    ids=str,
)
def test_a_shift_is_asked_for_once_and_clearly(hull: ah.Hull, given: dict[str, Any]) -> None:
    """Contradictions, other names, and terminals that are not four that rise."""
    refused("shift", partial(ah.Hull.shift_sections, hull, **given))


def test_a_swing_takes_one_dimension_or_two(hull: ah.Hull) -> None:
    """Of three none would be left to give way; none asks for nothing."""
    refused("none", partial(ah.Hull.swing, hull))
    refused("three", partial(ah.Hull.swing, hull, length=100.0, breadth=10.0, draught=5.0))


@pytest.mark.parametrize("method", STUDY)
def test_a_study_gives_its_variants_and_tables_only(
    study: ah.study.Study, method: str, tmp_path: Any
) -> None:
    """A number that none has, and a path that is none, are refused."""
    call = getattr(study, method)
    assert list(inspect.signature(call).parameters) == [STUDY[method]]
    good = FILES if STUDY[method] == "path" else set()
    with contextlib.chdir(tmp_path):
        for kind, value in WRONG.items():
            if kind not in good:
                refused(kind, partial(call, value))


def test_a_study_has_no_hull_of_a_refused_variant(study: ah.study.Study) -> None:
    """Its reason stands in the row; nor has it one of a number beyond."""
    assert study.rows[1].failure
    for number in (1, 2, -1):
        refused(str(number), partial(study.hull, number))


@pytest.mark.parametrize("kind", [kind for kind in WRONG if WRONG[kind].__hash__])
def test_names_are_text(hull: ah.Hull, kind: str) -> None:
    """Whatever else can be the key of a mapping is refused; as are names of nothing."""
    name = WRONG[kind]
    calls: Mapping[str, Callable[[], object]] = {
        "reach": lambda: hull.vary(reach={name: 1.0}, free=FREE),
        "bounds": lambda: hull.vary(**AIM, bounds={name: (9.0, 11.0)}),
        "shift": lambda: hull.shift_sections(by={name: 1.0}),
        "set": lambda: hull.study(set={name: 1.0}),
        "targets": lambda: hull.study(**{**ROW, "reach": {name: 1.0}}),
    }
    for what, call in calls.items():
        refused(what, call)
    if not isinstance(name, str):
        refused("range", lambda: ah.study.sample({name: (9.0, 11.0)}, 2))


def test_another_hull_is_no_value(hull: ah.Hull) -> None:
    """Nor a number, a list of names, or bounds."""
    other = ah.examples.wigley(stations=7, waterlines=5)
    for place in PLACES:
        refused(place, partial(PLACES[place], hull, other))
