"""Stages of a plan that stand as they would be carried out again are not carried out again."""

from __future__ import annotations

import pytest

import assoc_hull as ah
from assoc_hull.edit.transaction import Transaction
from assoc_hull.variation.carrying.carry_stages import DoneStage, StagedCarry
from assoc_hull.variation.parameters.stages import Stage
from assoc_hull.variation.request import VariationRequest

PLAN = (Stage(("length",)), Stage(("breadth",)), Stage(("depth",)))
AIMS = {"length": 101.0, "breadth": 10.5, "depth": 9.5}


@pytest.mark.parametrize(
    ("plan", "aims", "kept"),
    [
        (PLAN, AIMS, 3),
        (PLAN, {**AIMS, "depth": 9.6}, 2),
        (PLAN, {**AIMS, "breadth": 10.6}, 1),
        (PLAN, {**AIMS, "length": 101.5}, 0),
        ((PLAN[0], Stage(("breadth",), 2), PLAN[2]), AIMS, 1),
        (PLAN[::-1], AIMS, 0),
        (PLAN[:1], AIMS, 1),
    ],
)
def test_the_first_stages_that_are_the_same_stand(
    plan: tuple[Stage, ...], aims: dict[str, float], kept: int
) -> None:
    """What another plan then makes has the bits of that plan carried out from the parent."""
    found = set[str]()
    for before in (True, False):
        hull = ah.examples.wigley(stations=9, waterlines=6)
        done = list[DoneStage]()
        with Transaction(hull.document, "vary") as edit:
            ask = VariationRequest.of(AIMS)
            if before:
                StagedCarry(edit, ask, PLAN, done=done).run(AIMS)
            there = edit.steps
            carry = StagedCarry(edit, ask, plan, done=done)
            carry.run(aims)
            same = sum(a is b for a, b in zip(there, edit.steps, strict=False))
            assert same == (kept if before else 0)
            assert len(carry.carried) == edit.stages == sum(stage.parts for stage in plan)
        found.add(hull.fingerprint)
    assert len(found) == 1


def test_a_stage_that_somebody_took_back_is_carried_out_again() -> None:
    """Though the edit holds as many stages as before."""
    hull = ah.examples.wigley(stations=9, waterlines=6)
    with Transaction(hull.document, "vary") as edit:
        ask = VariationRequest.of(AIMS)
        carry = StagedCarry(edit, ask, PLAN)
        carry.run(AIMS)
        there = edit.steps
        StagedCarry(edit, ask, PLAN[::-1]).run(AIMS)
        carry.run(AIMS)
        assert not any(a is b for a, b in zip(there, edit.steps, strict=True))
        assert [stage.stage for stage in carry.done] == list(PLAN)
