"""Sets of named values: what people ask for at once is met, in any order, as one step."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError, RefusedSetError
from assoc_hull.hull.variants import Variation
from assoc_hull.variation.parameters.catalogue import NAMES
from assoc_hull.variation.parameters.stages import (
    CLASSES,
    Stage,
    class_plan,
    finer_plan,
    refined_plan,
    single_plan,
)
from tests.long_forms import LONG, long_form
from tests.variation_sets import outcome


@pytest.fixture(scope="module")
def parent() -> ah.Hull:
    """The bulk carrier; it is only read."""
    return ah.examples.bulk_carrier_207k()


ByPaper = Callable[[dict[str, float]], Variation[ah.Hull]]


@pytest.fixture(scope="module")
def by_paper(parent: ah.Hull) -> ByPaper:
    """Give variations by the form of the paper, each made once; they are only read."""
    made = dict[str, Variation[ah.Hull]]()

    def give(values: dict[str, float]) -> Variation[ah.Hull]:
        if str(values) not in made:
            made[str(values)] = parent.vary(set=values, layout={"blend": "paper"})
        return made[str(values)]

    return give


SEVEN = {
    "breadth": 51.0, "bulb_length": 6.9, "transom_half_breadth": 12.52, "shaft_height": 5.5,
    "draught": 18.9, "bilge_radius": 2.8, "parallel_body_end": 209.0,
}  # fmt: skip


# Plans.


def test_every_parameter_stands_in_one_class() -> None:
    """A new parameter needs its place among the others."""
    placed = [name for each in CLASSES for end in each for name in end]
    assert sorted(placed) == sorted(NAMES)


@pytest.mark.parametrize("names", [("shaft_height",), tuple(SEVEN), NAMES])
def test_a_plan_has_every_parameter_once_however_fine(names: tuple[str, ...]) -> None:
    """Refined stage by stage until nothing can be finer; then it says so."""
    plan = class_plan(names)
    for _ in range(200):
        assert sorted(name for stage in plan for name in stage.names) == sorted(names)
        finer = next((f for i in range(len(plan)) if (f := refined_plan(plan, i))), None)
        if finer is None:
            break
        plan = finer
    assert all(len(stage.names) == 1 for stage in plan)
    assert finer_plan(plan) == plan
    assert max(stage.parts for stage in plan) in (1, 8)
    # What is a ratio of the whole hull, or a movement, is not the same in parts.
    whole = {"length", "breadth", "draught", "depth", "deck_height", "fore_shift", "aft_shift"}
    assert all(stage.parts == 1 for stage in plan if stage.names[0] in whole)


def test_raw_layers_act_last_and_can_be_taken_apart() -> None:
    """They belong to the last stage, unless that is refused."""
    plan = class_plan(["breadth", "shaft_height"], layers=True)
    assert [stage.layers for stage in plan] == [False, True]
    assert single_plan(["breadth"], layers=True) == (Stage(("breadth",), 1, layers=True),)
    assert class_plan([], layers=True) == (Stage((), layers=True),)
    finer = refined_plan(plan, 1)
    assert finer is not None
    assert [(stage.names, stage.layers) for stage in finer[1:]] == [
        (("shaft_height",), False), ((), True),
    ]  # fmt: skip


# What people ask for.


def test_seven_everyday_changes_are_met_at_once(parent: ah.Hull) -> None:
    """To 1e-6, sound, fair, one step that is undone to the bit."""
    found = outcome(parent, SEVEN)
    assert found.good, found
    assert found.comb < 10.0
    assert len(found.words.split("; ")) == 5


def test_the_order_of_arguments_changes_no_bit(parent: ah.Hull) -> None:
    """Values are taken in the order of the classes; in two orders each pair stands both ways."""
    values = {"shaft_height": 5.5, "breadth": 51.0, "bulb_length": 6.9}
    orders = list(itertools.permutations(values))
    made = {
        parent.vary(set={name: values[name] for name in order}, name="x").hull.fingerprint
        for order in (orders if LONG else (orders[0], orders[-1]))
    }
    assert len(made) == 1


def test_it_is_one_step_that_tells_its_stages(parent: ah.Hull) -> None:
    """With cause, report and history as any edit; a look at the hull between is nobody's."""
    varied = parent.vary(set={"breadth": 51.0, "bulb_length": 6.9})
    hull, report = varied.hull, varied.report
    assert report.stages == ("breadth", "bulb_length")
    assert report.maps == 2
    assert "in stages: breadth; bulb_length" in str(report)
    assert len(hull.history) == 1
    told = hull.history[-1]
    assert told.largest is not None
    assert report.edit.largest is not None
    assert told.largest.distance == report.edit.largest.distance
    assert set(told.carried).isdisjoint(told.cut_again)
    after = hull.fingerprint
    hull.undo()
    assert hull.fingerprint == parent.fingerprint
    hull.redo()
    assert hull.fingerprint == after


def test_a_value_that_is_there_already_is_a_pin(parent: ah.Hull) -> None:
    """It is solved for with what would move it, and met in the first round."""
    now = parent.measure()
    varied = parent.vary(set={"shaft_height": 6.0, "transom_height": now["transom_height"]})
    assert varied.hull.measure()["transom_height"] == pytest.approx(18.4, abs=1e-6)
    assert varied.report.rounds == 1


@pytest.mark.parametrize("more", [{"length": 101.0}, {"breadth": 10.5}, {"depth": 9.5}])
def test_a_draught_that_is_to_stay_moves_no_waterline(more: dict[str, float]) -> None:
    """No field of a size that is set moves it, so nothing is solved for: not by 50 nm."""
    hull = ah.examples.wigley(stations=9, waterlines=6)
    alone = hull.vary(set=more, name="x", ship="x")
    pinned = hull.vary(set={**more, "draught": 6.25}, name="x", ship="x")
    assert pinned.hull.fingerprint == alone.hull.fingerprint
    assert pinned.report.notes == alone.report.notes
    kept = hull.vary(set={"draught": 6.5, "depth": 9.375}).hull.measure()
    assert kept["depth"] == pytest.approx(9.375, abs=1e-6)


@pytest.mark.parametrize(
    "asked",
    [
        {"shaft_height": 5.2, "bulb_length": 6.6},
        # Five runs; the page of variations has it as well.
        *([{"shaft_height": 5.5, "bulb_length": 6.9}] if LONG else []),
    ],
)
def test_set_and_reach_are_one_problem(parent: ah.Hull, asked: dict[str, float]) -> None:
    """What is set is held while what is free reaches: no second call, no order of calls."""
    now = parent.hydrostatics()
    target = {"volume": 1.01 * now.volume, "lcb": now.lcb - 0.5}
    varied = parent.vary(set=asked, reach=target, free=["breadth", "fore_shift", "aft_shift"])
    there, found = varied.hull.measure(), varied.hull.hydrostatics()
    assert {name: there[name] for name in asked} == pytest.approx(asked, abs=1e-6)
    assert found.volume == pytest.approx(target["volume"], rel=1e-9)
    assert found.lcb == pytest.approx(target["lcb"], rel=1e-9)
    assert not varied.hull.check()
    assert len(varied.hull.history) == 1


@pytest.mark.parametrize(
    ("values", "parts"),
    [
        pytest.param({"shaft_height": 6.0}, 4, marks=long_form),
        ({"bossing_radius": 1.0}, 2),
        pytest.param({"shaft_height": 6.0, "bossing_radius": 1.0}, 1, marks=long_form),
    ],
)
def test_the_form_of_the_paper_is_carried_in_parts(
    by_paper: ByPaper, values: dict[str, float], parts: int
) -> None:
    """Ratios fold where the change is large; each part is laid out on what is there.

    The bossing comes to touch BTK 1 where WL 6 (or WL 5) ends on it, and the two lines run in one
    another's planes from there on: no crossing of them can be made, and none is missed.
    """
    varied = by_paper(values)
    told = ", ".join(values)
    assert varied.report.stages == (told if parts == 1 else f"{told} in {parts} parts",)
    assert varied.report.maps == parts
    assert varied.report.certificate.certified
    there = varied.hull.measure()
    assert {name: there[name] for name in values} == pytest.approx(values, abs=1e-6)
    assert not varied.hull.check()


@pytest.mark.parametrize("blend", ["quintic", "paper"])
def test_a_bossing_stays_the_cylinder_that_it_is(parent: ah.Hull, blend: str) -> None:
    """All its circles get the asked radius, also where ratios make all of them too small alike."""
    varied = parent.vary(set={"bossing_radius": 0.9}, layout={"blend": blend}).hull
    circles = [each for each in varied.document.state.features if each.kind == "circle"]
    assert len(circles) == 3
    assert {each.radius for each in circles} == {0.9}


def test_lines_with_a_kink_are_named(by_paper: ByPaper) -> None:
    """`check` sees none; the report names the line, and by how much."""
    varied = by_paper({"shaft_height": 6.0})
    assert varied.report.worst_comb > 10.0
    assert any("less fair than those of the parent" in note for note in varied.report.notes)


# Refusals.


def test_what_cannot_be_had_together_is_refused_with_what_can(parent: ah.Hull) -> None:
    """Both remedies of the message work."""
    asked = {"draught": 24.0, "depth": 24.75}
    before = parent.fingerprint
    with pytest.raises(RefusedSetError, match="cannot be had together") as caught:
        parent.vary(set=asked)
    error = caught.value
    assert parent.fingerprint == before
    assert error.leave_out in asked
    rest = {name: value for name, value in asked.items() if name != error.leave_out}
    assert parent.vary(set=rest).report.edit.changed
    assert 0.0 < error.part < 1.0
    assert f"draught={error.values['draught']:.6g}" in str(error)
    assert parent.vary(set=error.values).report.edit.changed


def test_what_no_one_would_take_alone_is_no_remedy(parent: ah.Hull) -> None:
    """Neither draught nor depth can be had without the other here: no name is left out for it."""
    with pytest.raises(RefusedSetError, match="cannot be had together") as caught:
        parent.vary(set={"draught": 30.0, "depth": 22.5})
    assert caught.value.leave_out is None
    assert parent.vary(set=caught.value.values).report.edit.changed


def test_what_is_set_cannot_be_free(parent: ah.Hull) -> None:
    """By its name."""
    with pytest.raises(BadInputError, match="'breadth' is set and free"):
        parent.vary(set={"breadth": 51.0}, reach={"volume": 2e5}, free=["breadth"])


# Studies take what `vary` takes.


def test_a_study_of_breadth_and_draught_keeps_the_structure(parent: ah.Hull) -> None:
    """Both at once bend no circle that one of them alone would not."""
    found = parent.study(
        set={"breadth": [49.5, 50.5, 51.0], "draught": [17.5, 18.5, 18.2]}, outputs=["volume"]
    )
    assert found.table()["failure"].tolist() == [""] * 3
    assert not found.table()["anew"].any()


def test_a_study_carries_anew_what_needs_other_points(parent: ah.Hull) -> None:
    """The row says so, and is the hull that `vary` makes."""
    found = parent.study(set={"shaft_height": [6.0]}, outputs=["volume"])
    assert found.table()["failure"].tolist() == [""]
    assert found.table()["anew"].tolist() == [True]
    volume = parent.vary(set={"shaft_height": 6.0}).hull.hydrostatics().volume
    assert found.table()["volume"][0] == pytest.approx(volume, rel=1e-12)
