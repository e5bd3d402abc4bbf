"""Named parameters of a box: most have no meaning on it, and each says why in words of ships."""

from __future__ import annotations

import pytest

import assoc_hull as ah
from assoc_hull.edit.checks.update_findings import MOVE_ADVICE
from assoc_hull.errors import BadInputError, RefusedEditError
from assoc_hull.variation import vary
from assoc_hull.variation.carrying.admissible_values import (
    AdmissibleValues,
    ListedParameter,
    list_parameters,
)
from tests.cases.test_hydrostatics_of_a_box import box_net

WHY = {
    "entrance_deg": "where the side is that far out nothing moves",
    "run_deg": "where the side is that far out nothing moves",
    "waterline_fullness": "leaves no room",
    "parallel_body_start": "reaches the AP",
    "parallel_body_end": "reaches the FP",
    "parallel_body_length": "reaches the AP",
    "transom_height": "reaches down to the base line",
    "transom_half_breadth": "reaches down to the base line",
}


@pytest.fixture(scope="module")
def box() -> ah.Hull:
    """A box with both ends as transoms from the base line up."""
    return box_net(9)


@pytest.fixture(scope="module")
def listed(box: ah.Hull) -> dict[str, ListedParameter]:
    """Its parameters by name."""
    return {each.name: each for each in list_parameters(box.document.state)}


@pytest.mark.parametrize("name", WHY)
def test_a_parameter_without_meaning_on_a_box_is_listed_with_a_reason_in_words_of_ships(
    box: ah.Hull, listed: dict[str, ListedParameter], name: str
) -> None:
    """The reason is that of the refusal when it is asked for."""
    reason = listed[name].reason or ""
    assert WHY[name] in reason
    with pytest.raises(BadInputError, match=WHY[name]):
        box.vary(set={name: 0.9 * (listed[name].value or 10.0)})


def test_no_reason_speaks_of_nodes_or_boundary_curves(listed: dict[str, ListedParameter]) -> None:
    """A designer has set neither."""
    for each in listed.values():
        assert "after" not in (each.reason or "")
        assert "boundary curves" not in (each.reason or "")


def test_no_interval_is_listed_the_wrong_way_round(listed: dict[str, ListedParameter]) -> None:
    """What has no room has a reason instead."""
    for each in listed.values():
        if each.low is not None and each.high is not None and each.reason is None:
            assert each.low < each.high


@pytest.mark.parametrize(
    "fault", [ZeroDivisionError("by zero"), KeyError("x"), BadInputError("a", "b", "c")]
)
def test_a_fault_at_one_parameter_leaves_the_list_of_the_others(
    box: ah.Hull, monkeypatch: pytest.MonkeyPatch, fault: Exception
) -> None:
    """It is told beside that parameter."""
    whole = AdmissibleValues.interval

    def faulty(self: AdmissibleValues, name: str) -> tuple[float, float]:
        if name == "depth":
            raise fault
        return whole(self, name)

    monkeypatch.setattr(AdmissibleValues, "interval", faulty)
    found = list_parameters(box.document.state, limits=("depth", "breadth"))
    by = {each.name: each for each in found}
    assert (by["depth"].reason or "").startswith("cannot be varied: ")
    assert by["breadth"].reason is None
    assert by["breadth"].low is not None


FOLD = "ST 4 folds back on itself at (40.000, 2.040, 2.500) m (cosine -0.20)"


def test_a_variation_that_folds_lines_is_answered_with_values_and_not_with_points_to_move(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """What a designer typed is a value, so the advice is one as well."""

    def folding(*_: object) -> None:
        raise RefusedEditError("vary", (f"{FOLD}{MOVE_ADVICE} or move the neighbouring points",))

    monkeypatch.setattr(vary, "choose_plan", folding)
    with pytest.raises(RefusedEditError) as caught:
        ah.examples.wigley().vary(set={"breadth": 900.0})
    [told] = caught.value.findings
    assert told.startswith(f"{FOLD}: ask for breadth from ")
    assert "point" not in told
