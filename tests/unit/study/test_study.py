"""Studies: every variant is a hull, has what was asked, and stands in its row as it is."""

import json
from collections.abc import Callable, Iterator
from typing import Any

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.study import Study
from tests.unit.study.test_design import fuller

FREE = ["breadth", "fore_shift", "aft_shift"]
BOUNDS = {"breadth": (16.5, 18.5), "fore_shift": (-1.5, 1.5), "aft_shift": (-1.5, 1.5)}


@pytest.fixture(scope="module")
def parent(shipped: Callable[[str], ah.Hull]) -> ah.Hull:
    """Series 60; no test changes it."""
    return shipped("series60_70")


@pytest.fixture(scope="module")
def small() -> ah.Hull:
    """A hull of few lines; no test changes it."""
    return ah.examples.wigley(stations=9, waterlines=6)


@pytest.fixture(scope="module")
def asked(parent: ah.Hull) -> dict[str, Any]:
    """Two targets within reach, and one beyond the bounds."""
    now = parent.hydrostatics(estimate=False)
    drawn = ah.study.sample({"volume": (0.99 * now.volume, 1.01 * now.volume),
                       "lcb": (now.lcb - 0.3, now.lcb + 0.3)}, 2, seed=5)  # fmt: skip
    far = {"volume": now.volume, "lcb": now.lcb + 3.0}
    return {name: [*column, far[name]] for name, column in drawn.items()}


@pytest.fixture(scope="module")
def found(parent: ah.Hull, asked: dict[str, Any]) -> Study:
    """The study of these."""
    return parent.study(reach=asked, free=FREE, bounds=BOUNDS)


def test_targets_are_met_on_the_hull_itself(
    parent: ah.Hull, found: Study, asked: dict[str, Any]
) -> None:
    """To 1e-10, by hydrostatics of the hull made once more; its outputs are those of the row."""
    for row in found.rows[:2]:
        assert row.failure == ""
        hull = found.hull(row.number)
        record = hull.hydrostatics(estimate=False)
        for name in asked:
            missed = getattr(record, name) / asked[name][row.number] - 1.0
            assert abs(missed) <= 1e-10
        told = [getattr(record, name) for name in found.design.outputs]
        np.testing.assert_allclose(row.outputs, told, rtol=1e-12)
        assert row.margin > 0.05
        assert hull.check() == ()
        assert [step.name for step in hull.history] == [f"variant {row.number}"]
        hull.undo()
        assert hull.fingerprint == parent.fingerprint


def test_a_variant_that_is_none_is_a_row_with_its_reason(parent: ah.Hull, found: Study) -> None:
    """The bound in the way is named; the others are not touched by it, nor is the parent."""
    row = found.rows[2]
    assert row.failure == "out of range"
    assert any(name in row.reason for name in FREE)
    assert "would be needed to reach the targets" in row.reason
    assert np.isnan(row.outputs).all()
    assert found.failed == (row,)
    assert str(found) == "2 of 3 variants, 1 out of range"
    with pytest.raises(ah.errors.BadInputError, match=r"variant 2 has no hull: \w+ of"):
        found.hull(2)
    assert parent.history == ()


def test_a_study_says_that_it_fairs_no_followers(small: ah.Hull) -> None:
    """What `vary` takes and a study does not is refused with what does it."""
    with pytest.raises(ah.errors.BadInputError, match=r"hull\.vary\(set=\.\.\., fair=True\)"):
        small.study(set={"draught": [6.0, 6.1]}, fair=True)


def test_the_change_is_nearly_the_least(small: ah.Hull) -> None:
    """Of one more free parameter than targets: `vary`, which seeks it exactly, changes the same."""
    asked = {"reach": {"volume": 2820.0}, "free": ["breadth", fuller()]}
    alone = small.vary(**asked).report.aim  # type: ignore[arg-type]
    found = small.study(**asked)  # type: ignore[arg-type]
    assert alone is not None
    change = (found.rows[0].values - found.run.ground.present) / found.run.ground.usual
    assert np.sqrt((change**2).sum()) == pytest.approx(alone.change, rel=1e-4)


def test_a_parameter_at_its_bound_stays_there(small: ah.Hull) -> None:
    """What else is free does the rest; where nothing is, the bound in the way is named."""
    reach, bounds = {"volume": [2820.0, 2900.0]}, {"breadth": (9.9, 10.02), "fuller": (-9.0, 9.0)}
    found = small.study(reach=reach, free=["breadth", fuller()], bounds=bounds)
    assert found.rows[0].values[0] == pytest.approx(10.02, abs=1e-9)
    assert found.rows[0].residual <= 1e-10
    assert found.rows[1].reason.startswith("fuller of ")


def test_an_interrupt_leaves_what_is_done(small: ah.Hull) -> None:
    """Rows that were finished are there, and told to be not all."""

    def stop(what: str, done: int, of: int) -> None:
        if done == 2:
            raise KeyboardInterrupt

    found = small.study(set={"breadth": [10.0, 10.1, 10.2, 10.3]}, progress=stop)
    assert [row.number for row in found.rows] == [0, 1]
    assert found.interrupted
    assert "interrupted" in str(found)
    with pytest.raises(ah.errors.BadInputError, match="variant 3 was not made"):
        found.hull(3)


def test_a_variant_is_what_vary_makes() -> None:
    """Where lines need no further points to keep to their images; only its name is another."""
    parent, values, layer = ah.examples.wigley(), {"breadth": 10.4}, fuller()
    found = parent.study(set=values, layers=[layer])
    alone = parent.vary(set=values, layers=[layer])
    assert alone.report.added == 0
    one, two = (hull.state.rows.xyz.data for hull in (found.hull(0), alone.hull))
    np.testing.assert_allclose(one, two, rtol=0.0, atol=1e-9)
    name = parent.particulars.name
    assert found.hull(0).particulars == attrs.evolve(alone.hull.particulars, name=name)


def small_studies(hull: ah.Hull) -> Iterator[Study]:
    """The same study of a hull by one process and by two."""
    for workers in (1, 2):
        yield hull.study(
            reach={"volume": [2760.0, 2790.0, 2820.0]}, free=["breadth", fuller()],
            bounds={"fuller": (-2.0, 2.0)}, outputs=["Cp", "A x=42.5"], workers=workers,
        )  # fmt: skip


def test_the_number_of_processes_does_not_show(small: ah.Hull) -> None:
    """The same bytes come of one and of two, in CSV and JSON."""
    one, two = small_studies(small)
    assert one.to_json() == two.to_json()
    assert one.to_csv() == two.to_csv()
    facts = json.loads(one.to_json())
    assert facts["columns"]["volume"] == pytest.approx([2760.0, 2790.0, 2820.0], rel=1e-10)
    assert [facts["units"][name] for name in ("volume", "A x=42.5", "shift")] == ["m3", "m2", "m"]
    assert max(facts["columns"]["residual"]) <= 1e-10


def test_a_map_that_folds_is_a_row(small: ah.Hull) -> None:
    """With nan where numbers would stand."""
    found = small.study(layers=[fuller()], set={"fuller": [1.0, -60.0]}, outputs=["cb"])
    assert [row.failure for row in found.rows] == ["", "map folds"]
    assert np.isnan(found.table()["cb"]).tolist() == [False, True]
