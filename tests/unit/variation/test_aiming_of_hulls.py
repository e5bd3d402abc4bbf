"""Targets reached on the hulls of the kernel: exact derivatives, one step, all or nothing."""

from __future__ import annotations

import json
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.errors import (
    AssocHullError,
    BadInputError,
    TooFewFreeError,
    UnknownNameError,
    UnreachableError,
    WrongTypeError,
)
from assoc_hull.variation import Variation
from assoc_hull.variation.fields.field_data import fields_from_data
from assoc_hull.variation.fields.layers import FieldLayer
from tests.aims import FULLER, SHIFTED, problem, small

HERE = np.array([0.2, 0.4, 0.3])


def test_derivatives_are_those_of_nudged_hulls() -> None:
    """Within 1e-7 of central differences, at a hull that was nudged itself."""
    hulls = problem(small(), ["volume", "lcb", "kmt", "cw"], ["breadth", SHIFTED, FULLER])
    hulls.at(HERE)
    here = HERE + np.array([1e-3, 2e-3, -1e-3])
    found = hulls.at(here).jacobian
    differences = np.zeros_like(found)
    for j, free in enumerate(hulls.maps.free):
        step = np.zeros(3)
        step[j] = 1e-4 * free.usual
        ends = [hulls.at(here + by).values for by in (step, -step)]
        differences[:, j] = (ends[0] - ends[1]) / (2.0 * step[j])
    size = np.abs(found).max(axis=1, keepdims=True)
    assert np.abs((found - differences) / size).max() <= 1e-7
    assert hulls.carries == 1


@pytest.fixture(scope="module")
def parent() -> ah.Hull:
    """A hull that nothing changes."""
    return small()


@pytest.fixture(scope="module")
def wanted(parent: ah.Hull) -> dict[str, float]:
    """Targets near the parent."""
    found = parent.hydrostatics()
    return {
        "volume": 1.01 * found.volume, "lcb": found.lcb + 0.3, "kmt": (found.kmt or 0.0) + 0.05,
    }  # fmt: skip


@pytest.fixture(scope="module")
def aimed(parent: ah.Hull, wanted: dict[str, float]) -> Variation:
    """Three targets, three that are free."""
    return parent.vary(reach=wanted, free=["breadth", SHIFTED, FULLER])


def test_targets_are_met_on_the_hull_that_comes_out(
    aimed: Variation, wanted: dict[str, float]
) -> None:
    """To 1e-10 of their size, by the hydrostatics that a designer asks for."""
    found = aimed.hull.hydrostatics()
    for name, value in wanted.items():
        assert getattr(found, name) == pytest.approx(value, rel=1e-10)
    assert aimed.hull.check() == ()


def test_convergence_is_quadratic(aimed: Variation) -> None:
    """At most six steps, each residual within 200 times the square of the one before."""
    assert aimed.report.aim is not None
    residuals = [each.residual for each in aimed.report.aim.steps]
    assert len(residuals) <= 7
    for one, other in pairwise(residuals):
        if one < 1e-2:
            assert other <= max(200.0 * one * one, 1e-12)


def test_the_report_tells_what_was_changed(aimed: Variation) -> None:
    """Outputs with their values, and the free parameters, in the report and its text."""
    report = aimed.report.aim
    assert report is not None
    assert report.free == ("breadth", "fuller", "shifted")
    assert report.reached
    text = str(aimed.report)
    assert "volume 2773.92 -> 2801.66" in text
    assert "shifted by " in text
    assert aimed.report.certificate.certified


def test_the_map_is_that_of_the_hull(aimed: Variation, parent: ah.Hull) -> None:
    """Nudges are part of it: it takes places of the parent to the variant within a micron."""
    before, after = (hull.state.rows.xyz.data for hull in (parent, aimed.hull))
    assert aimed.map(before) == pytest.approx(after[: len(before)], abs=2e-5)


def test_it_is_one_step_that_undo_takes_back(aimed: Variation, parent: ah.Hull) -> None:
    """Undo gives the parent to the bit, redo the variant."""
    varied = aimed.hull.fingerprint
    assert len(aimed.hull.history) == 1
    aimed.hull.undo()
    assert aimed.hull.fingerprint == parent.fingerprint
    aimed.hull.redo()
    assert aimed.hull.fingerprint == varied


def test_a_script_makes_the_same_hull(aimed: Variation, parent: ah.Hull, tmp_path: Path) -> None:
    """To the last bit, from data and from a file."""
    script = aimed.report.script
    assert script is not None
    file = tmp_path / "aim.json"
    file.write_text(json.dumps(dict(script)))
    assert parent.vary_by(file).hull.fingerprint == aimed.hull.fingerprint


def test_bounds_and_compromise_are_in_the_script(parent: ah.Hull) -> None:
    """An open end is null; a layer that is no data leaves no script."""
    volume = parent.hydrostatics().volume
    found = parent.vary(
        reach={"volume": 1.01 * volume}, free="breadth",
        bounds={"breadth": (None, 10.05)}, exact=False,
    )  # fmt: skip
    script = found.report.script
    assert script is not None
    assert (script["free"], script["exact"]) == (["breadth"], False)
    assert script["bounds"] == {"breadth": [None, 10.05]}
    assert found.hull.particulars.breadth == 10.05
    layer = FieldLayer("fuller", fields_from_data(FULLER["fields"]))
    again = parent.vary(reach={"volume": 1.001 * volume}, free=[layer])
    assert again.report.script is None


def test_what_is_set_holds_beside_what_is_reached(parent: ah.Hull) -> None:
    """The draught to 1e-6, the volume and its centre to 1e-10."""
    before = parent.hydrostatics()
    found = parent.vary(
        set={"draught": 6.4}, reach={"volume": 1.03 * before.volume, "lcb": before.lcb},
        free=["breadth", SHIFTED],
    )  # fmt: skip
    after = found.hull.hydrostatics()
    assert after.volume == pytest.approx(1.03 * before.volume, rel=1e-10)
    assert after.lcb == pytest.approx(before.lcb, rel=1e-10)
    assert found.hull.particulars.draught == 6.4
    assert [each.name for each in found.report.targets] == ["draught"]


def test_a_target_is_told_from_what_the_parent_has_whichever_plan_reaches_it() -> None:
    """A second plan is not measured by what the first one has left of the hull."""
    parent = ah.examples.series60(0.6)
    found = parent.vary(reach={"volume": 9000.0}, free=["draught", "breadth"])
    assert found.report.aim is not None
    assert found.report.aim.before.tolist() == [parent.hydrostatics().volume]
    size = found.hull.particulars
    [told] = [each for each in found.report.edit.notes if each.startswith("the particulars are")]
    assert f"breadth {size.breadth:g}, depth {size.depth:g}, draught {size.draught:g} m" in told


def test_what_the_hull_has_already_changes_nothing(parent: ah.Hull) -> None:
    """Targets that are met are no step."""
    volume = parent.hydrostatics().volume
    found = parent.vary(reach={"volume": volume}, free=["breadth"])
    assert found.hull.fingerprint == parent.fingerprint
    assert not found.hull.history


def test_an_unreachable_target_leaves_the_hull_as_it_was() -> None:
    """Both bounds are named, and what comes nearest; no bit and no step is left."""
    hull = small()
    before, volume = hull.fingerprint, hull.hydrostatics().volume
    with pytest.raises(UnreachableError) as caught:
        hull.vary(
            reach={"volume": 1.1 * volume}, free=["breadth", FULLER], in_place=True,
            bounds={"breadth": (9.9, 10.1), "fuller": (-1.0, 0.5)},
        )  # fmt: skip
    assert caught.value.bounds == ("breadth", "fuller")
    assert hull.fingerprint == before
    assert not hull.history
    nearest = hull.vary(set={"breadth": 10.1}, layers=[_half_of(FULLER)]).hull
    assert caught.value.best == pytest.approx(nearest.hydrostatics().volume, rel=1e-9)


def _half_of(layer: dict[str, Any]) -> FieldLayer:
    return FieldLayer("half", tuple(each.scaled(0.5) for each in fields_from_data(layer["fields"])))


WRONG: list[tuple[str, dict[str, Any], type[AssocHullError], str]] = [
    ("set and free", {"set": {"breadth": 10.1}, "reach": {"volume": 2800}, "free": ["breadth"]},
     BadInputError, "'breadth' is set and free"),
    ("nothing free", {"reach": {"volume": 2800}}, BadInputError, "nothing is free to reach volume"),
    ("nothing to reach", {"set": {"breadth": 11}, "free": ["draught"]}, BadInputError,
     "free is given, but nothing to reach"),
    ("an output that is none", {"reach": {"volumen": 1.0}, "free": ["breadth"]},
     UnknownNameError, "nearest names are 'volume'"),
    ("a parameter that is none", {"reach": {"volume": 2800}, "free": ["bredth"]},
     UnknownNameError, "nearest names are 'breadth'"),
    ("a parameter that the hull has not", {"reach": {"volume": 2800}, "free": ["bulb_length"]},
     BadInputError, "cannot free 'bulb_length': no profile"),
    ("a parameter that the hull has and that no field moves",
     {"reach": {"volume": 2800}, "free": ["breadth", "deadrise_deg"]}, BadInputError,
     "cannot free 'deadrise_deg': parent has no parallel middle body"),
    ("free twice", {"reach": {"volume": 2800}, "free": ["breadth", "breadth"]}, BadInputError,
     "'breadth' is free twice"),
    ("no number", {"reach": {"volume": float("nan")}, "free": ["breadth"]}, BadInputError,
     "volume is nan"),
    ("a text", {"reach": {"volume": "much"}, "free": ["breadth"]}, BadInputError,
     "volume is 'much'"),
    ("no mapping", {"reach": 2800, "free": ["breadth"]}, WrongTypeError, "reach is int"),
    ("something free that is nothing", {"reach": {"volume": 2800}, "free": [3]}, WrongTypeError,
     "free holds 3"),
    ("bounds of something else",
     {"reach": {"volume": 2800}, "free": ["breadth"], "bounds": {"draught": (6, 7)}},
     UnknownNameError, "no free parameter named 'draught'"),
    ("bounds upside down",
     {"reach": {"volume": 2800}, "free": ["breadth"], "bounds": {"breadth": (11, 10)}},
     BadInputError, "give the lower first"),
    ("bounds that are no pair",
     {"reach": {"volume": 2800}, "free": ["breadth"], "bounds": {"breadth": 11}}, BadInputError,
     "bounds of 'breadth' are 11"),
    ("a number beyond all", {"reach": {"volume": 10**400}, "free": ["breadth"]}, BadInputError,
     "give a finite number"),
    ("bounds of arrays",
     {"reach": {"volume": 2800}, "free": ["breadth"], "bounds": {"breadth": (np.zeros(4), 11)}},
     BadInputError, "a bound of 'breadth'"),
    ("bounds that are an array", {"set": {"breadth": 11}, "bounds": np.zeros(4)}, WrongTypeError,
     "bounds is ndarray"),
    ("exact that is no flag",
     {"reach": {"volume": 2800}, "free": ["breadth"], "exact": 1}, BadInputError, "exact"),
    ("two parameters that are one number",
     {"reach": {"volume": 2800}, "free": ["depth", "deck_height"]}, BadInputError,
     "both set the deck edge"),
    ("a layer with the name of a parameter",
     {"reach": {"volume": 2800}, "free": [{"name": "breadth", "fields": []}]}, BadInputError,
     "has the name of the parameter 'breadth'"),
    ("more targets than freedoms",
     {"reach": {"volume": 2800, "lcb": 50.0}, "free": ["breadth"]}, TooFewFreeError, "2 targets"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("asked", "error", "words"), [each[1:] for each in WRONG], ids=[each[0] for each in WRONG]
)
def test_what_cannot_be_meant_is_told(
    parent: ah.Hull, asked: dict[str, Any], error: type[AssocHullError], words: str
) -> None:
    """One line that names what is wrong; the hull is as it was."""
    before = parent.fingerprint
    with pytest.raises(error, match=words) as caught:
        parent.vary(in_place=True, **asked)
    assert "\n" not in str(caught.value)
    assert parent.fingerprint == before


@settings(max_examples=5, deadline=None, phases=[Phase.explicit, Phase.reuse, Phase.generate])
@given(st.floats(-0.3, 0.3), st.floats(-1.0, 1.0), st.floats(-0.4, 0.4))
def test_what_some_hull_has_can_be_reached(wider: float, shifted: float, fuller: float) -> None:
    """Met to 1e-10 in one step, with the changes of that hull; undo gives the parent back."""
    hull, free = small(), ["breadth", SHIFTED, FULLER]
    before, changes = hull.fingerprint, np.array([wider, shifted, fuller])
    hulls = problem(hull, ["volume", "lcb", "kmt"], free)
    values = hulls.at(changes).values
    wanted = dict(zip(hulls.outputs, values.tolist(), strict=True))
    report = hull.vary(reach=wanted, free=free, in_place=True).report.aim
    assert report is not None
    assert report.amplitudes == pytest.approx(changes, abs=0.02)
    after = hull.hydrostatics()
    assert [getattr(after, name) for name in wanted] == pytest.approx(values, rel=1e-10)
    assert len(hull.history) <= 1
    for _ in hull.history:
        hull.undo()
    assert hull.fingerprint == before


def test_the_order_of_targets_and_of_what_is_free_changes_no_bit() -> None:
    """As that of set values: in `vary`, in its report and in the rows of a study."""
    hull = ah.examples.wigley(stations=9, waterlines=6)
    now = hull.hydrostatics(estimate=False)
    reach = {"volume": 1.01 * now.volume, "lcb": now.lcb - 0.3}
    free = ["breadth", "fore_shift", "aft_shift"]
    ways = [(reach, free), (dict(reversed(reach.items())), free[::-1])]
    made = [hull.vary(reach=to, free=by, name="x") for to, by in ways]
    assert made[0].hull.fingerprint == made[1].hull.fingerprint
    assert str(made[0].report) == str(made[1].report)
    rows = [hull.study(reach=to, free=by, outputs=["cb"]) for to, by in ways]
    assert rows[0].to_json() == rows[1].to_json()
