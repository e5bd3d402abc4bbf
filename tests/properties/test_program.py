"""The program of a net: a run gives the bits of the full way, or says that it cannot tell.

Live drags are the full way's judge: `Drag.to` runs the program where it can, and a drag that has no
program carries out the whole edit. Both look at the same hull, which neither changes.
"""

from __future__ import annotations

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.edit.drag import Drag, Live
from assoc_hull.edit.published_program import published_program
from assoc_hull.model.program.run_program import NumpyProgram, RunProgram, run_program, write_points
from assoc_hull.model.program.structure import PublishedProgram, Values
from assoc_hull.model.tables import HullState
from tests.conftest import Shipped
from tests.net_strategies import POOL, SHAPES, STRUCTURE, Task, carry_out, fresh, tasks

NUMBERS = tuple(each.name for each in attrs.fields(Values))
NONE = np.zeros(0, np.int64)

tasks_of_all_kinds = tasks(SHAPES + STRUCTURE)


def program_of(hull: ah.Hull) -> PublishedProgram | None:
    """The program of a hull as it is."""
    return published_program(hull.document)


def same_numbers(one: Values, other: Values) -> None:
    """Fail unless two sets of numbers agree to the last bit."""
    for name in NUMBERS:
        first, second = getattr(one, name), getattr(other, name)
        assert first.tobytes() == second.tobytes(), name


def assert_run_of_all_is_published(hull: ah.Hull) -> None:
    """Making every curve anew gives what the tables hold, and no doubt."""
    found = program_of(hull)
    if found is None:
        assert hull.state.failed
        return
    values = found.values.copy()
    values.block[:] = values.at[:] = values.knot[:] = values.gap[:] = np.nan
    values.place[:] = np.nan
    run = run_program(
        found.program, values, found.values, NONE, NONE, np.arange(found.program.curves)
    )
    # A hull may hold what an edit would be refused for; its numbers are what they are.
    assert run.doubt.name not in ("NOT_MADE", "MEETINGS"), run
    # A place is never asked for its segment where it is a knot: that before or behind will do.
    odd = values.segment != found.values.segment
    at = found.program.start[found.program.meet_curve] + found.values.segment
    assert (found.values.knot[at[odd]] == values.at[odd]).all()
    same_numbers(attrs.evolve(values, segment=found.values.segment), found.values)


@settings(max_examples=40)
@given(number=st.integers(0, POOL - 1), edits=tasks_of_all_kinds)
def test_a_run_of_all_curves_gives_the_published_numbers(number: int, edits: list[Task]) -> None:
    """On random nets, after edits of every kind, one program after the other."""
    hull = fresh(number)
    assert_run_of_all_is_published(hull)
    for each in edits:
        carry_out(hull, each)
        assert_run_of_all_is_published(hull)
    while hull.history:
        hull.undo()
        assert_run_of_all_is_published(hull)


SHIPS = ("series60_60", "series60_70", "bulk_carrier", "bulk_carrier_180m", "container_ship_225m")


@pytest.mark.parametrize("name", SHIPS)
def test_a_run_of_all_curves_gives_the_published_numbers_of_ships(
    name: str, shipped: Shipped
) -> None:
    """The shipped ships, those of which definitions give the points among them."""
    assert_run_of_all_is_published(shipped(name))


def drags(hull: ah.Hull, point: str, how: str) -> tuple[Drag, Drag]:
    """The same drag twice; the second one always goes the full way."""
    one, other = (hull.drag(point, how) for _ in range(2))  # type: ignore[arg-type]
    other._quick = None
    return one, other


def same_live(one: Live, other: Live) -> None:
    """Fail unless two answers of a drag agree to the last bit."""
    for name in ("refused", "born", "gone", "relofted"):
        assert getattr(one, name) == getattr(other, name), name
    for name in ("curves", "rows", "xyz"):
        assert getattr(one, name).tobytes() == getattr(other, name).tobytes(), name
    for name in ("start", "knot", "xyz", "leave", "arrive"):
        first, second = getattr(one.spline, name), getattr(other.spline, name)
        assert first.tobytes() == second.tobytes(), name


def assert_drags_agree(hull: ah.Hull, rng: np.random.Generator, count: int) -> int:
    """Drag random points; give how many steps the program answered for."""
    before, quick = hull.fingerprint, 0
    state: HullState = hull.state
    rows = state.live("rows")
    for number in range(count):
        row = int(rng.choice(rows))
        how = ("pull", "move")[number % 2]
        one, other = drags(hull, str(state.rows.key[row]), how)
        if how == "move" and not one.free:
            continue
        for size in rng.normal(0.0, 0.02, 3).tolist():
            asked = {"d": size}
            if how == "move":
                asked = {axis: float(one.start["xyz".index(axis)]) + size for axis in one.free}
            same_live(one.to(**asked), other.to(**asked))
            quick += one._quick is not None and one._run() is not None
        with one, other:
            pass
    assert hull.fingerprint == before
    return quick


@settings(max_examples=25, deadline=None)
@given(number=st.integers(0, POOL - 1), edits=tasks_of_all_kinds, seed=st.integers(0, 2**32 - 1))
def test_a_step_of_a_drag_is_the_whole_edit_to_the_bit(
    number: int, edits: list[Task], seed: int
) -> None:
    """On random nets after random edits; refusals have the same words."""
    hull = fresh(number)
    for each in edits:
        carry_out(hull, each)
    assert_drags_agree(hull, np.random.default_rng(seed), 4)


@pytest.mark.parametrize("name", ["series60_70", "bulk_carrier", "container_ship_225m"])
def test_a_step_of_a_drag_of_a_ship_is_the_whole_edit_to_the_bit(
    name: str, shipped: Shipped, backend_in_use: str
) -> None:
    """The program answers for most steps where definitions do not give the points."""
    quick = assert_drags_agree(shipped(name), np.random.default_rng(5), 24)
    assert quick >= 15 or name == "container_ship_225m"


@pytest.mark.parametrize("name", ["series60_70", "bulk_carrier", "container_ship_225m"])
def test_compiled_and_numpy_give_the_same_bits_and_doubts(name: str, shipped: Shipped) -> None:
    """Whatever is written where, and the numbers are put back after every run."""
    pytest.importorskip("numba")
    from assoc_hull.model.program.compiled_program import CompiledProgram

    found = program_of(shipped(name))
    assert found is not None
    program, before = found.program, found.values
    runners: tuple[RunProgram, ...] = (NumpyProgram(program), CompiledProgram(program))
    numbers = before.copy(), before.copy()
    rng, doubts = np.random.default_rng(9), set[str]()
    for _ in range(120):
        rows = np.unique(rng.choice(program.row, rng.integers(1, 4)))
        away = rng.normal(0.0, 10.0 ** rng.uniform(-4.0, 0.0), (len(rows), 3))
        away *= rng.integers(0, 2, 3)
        held = rows[rng.random(len(rows)) < 0.3]
        runs = []
        for runner, values in zip(runners, numbers, strict=True):
            moved = write_points(values, rows, before.xyz[rows] + away)
            runs.append(runner.run(values, before, moved, held))
        one, other = runs
        assert one.doubt is other.doubt
        doubts.add(one.doubt.name)
        if one.kept:
            same_numbers(*numbers)
            for part in ("curves", "rows", "watched"):
                assert getattr(one, part).tolist() == getattr(other, part).tolist()
        for runner, values, run in zip(runners, numbers, runs, strict=True):
            runner.restore(values, before, run)
            same_numbers(values, before)
    assert len(doubts) >= 4, doubts
