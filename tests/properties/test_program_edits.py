"""Edits whose numbers come from the program: they leave what the full way leaves, to the bit.

The same edits are made on two equal hulls. One always takes the program where it answers for the
edit; the other always goes the full way. Tables, steps, causes and reports must not differ.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from contextlib import contextmanager
from unittest import mock

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.edit import published_program as published_program_module
from assoc_hull.edit.document import Document
from assoc_hull.edit.modification import Pending
from assoc_hull.edit.program_edit import ProgramEdit
from assoc_hull.edit.published_program import known_numbers, published_program
from assoc_hull.edit.step import Step
from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.program.structure import Program, Values
from assoc_hull.model.tables import HullState
from tests.conftest import Shipped
from tests.long_forms import LONG, draws
from tests.net_strategies import POOL, SHAPES, STRUCTURE, Task, carry_out, fresh, tasks

COLUMNS = ("xyz", "parameter", "spot", "gap", "base", "anchor_from", "alive", "role", "driver")


@attrs.define
class Count:
    """How many edits a program has answered for, and for how many it was asked."""

    kept: int = 0
    asked: int = 0
    runs: int = 0


@contextmanager
def by_program(count: Count, *, always: bool) -> Iterator[None]:
    """Let every edit that sets places take the program, or none."""

    def of(document: Document, pending: Pending) -> ProgramEdit | None:
        return (
            ProgramEdit.begun(document, pending) if always and ProgramEdit.serves(pending) else None
        )

    run = ProgramEdit.run

    def counted(self: ProgramEdit, *given: object) -> Step | None:
        step = run(self, *given)  # type: ignore[arg-type]
        count.asked += 1
        count.kept += step is not None
        return step

    one = ProgramEdit._run

    def once(self: ProgramEdit, rows: IntArray) -> bool:
        count.runs += 1
        return one(self, rows)

    with (
        mock.patch.object(ProgramEdit, "of", of),
        mock.patch.object(ProgramEdit, "run", counted),
        mock.patch.object(ProgramEdit, "_run", once),
    ):
        yield


def content(hull: ah.Hull) -> dict[str, object]:
    """All numbers of the tables; splines and meetings by their bits."""
    state = hull.state
    found: dict[str, object] = {name: getattr(state.rows, name).data.tobytes() for name in COLUMNS}
    for curve in state.live("curves").tolist():
        spline, met = state.curves.spline[curve], state.curves.meets[curve]
        for name in ("knot", "xyz", "leave", "arrive"):
            found[f"{curve} {name}"] = None if spline is None else getattr(spline, name).tobytes()
        for name in ("line", "sign", "row", "parameter", "xyz"):
            found[f"{curve} met {name}"] = getattr(met, name).tobytes()
    found["revisions"] = dict(state.revision_row), dict(state.revision_curve)
    found["history"] = [told(step) for step in hull.document.history]
    return found


def told(step: Step) -> tuple[object, ...]:
    """What a step says of itself; not when it was made, and how long that took."""
    report = attrs.evolve(step.report, seconds={}, time="", fairness=None)
    fairness = step.report.fairness
    lines = None if fairness is None else str(fairness)
    numbers = (step.changed, step.moved, step.seeds, step.cause.reader, step.cause.source)
    assert (step.report.number, bool(step.report.time)) == (step.number, True)
    entered = step.number, step.author, step.report.author
    return step.name, step.structural, entered, report, lines, [each.tobytes() for each in numbers]


def assert_same(one: ah.Hull, other: ah.Hull) -> None:
    """Fail with the first part that differs."""
    mine, theirs = content(one), content(other)
    assert mine.keys() == theirs.keys()
    for name, value in mine.items():
        assert value == theirs[name], name
    assert one.fingerprint == other.fingerprint


def assert_numbers_are_those_of_the_tables(hull: ah.Hull) -> None:
    """What was kept as the published numbers is what would be read of the tables."""
    kept = published_program(hull.document)
    if kept is None:
        return
    assert_read_of(hull.document.state, kept.program, kept.values)


def assert_read_of(state: HullState, program: Program, values: Values) -> None:
    """Numbers are those of the tables; a segment may be the one behind, at a knot."""
    anew = published_program(ah.Hull(state.snapshot()).document)
    assert anew is not None
    at = program.start[program.meet_curve] + anew.values.segment
    for name in (each.name for each in attrs.fields(Values)):
        one, two = getattr(values, name), getattr(anew.values, name)
        if name == "segment":
            assert (anew.values.knot[at[one != two]] == anew.values.at[one != two]).all()
        else:
            assert one.tobytes() == two.tobytes(), name


@settings(max_examples=draws(30), deadline=None)
@given(number=st.integers(0, POOL - 1), edits=tasks(SHAPES + STRUCTURE), back=st.integers(0, 2))
def test_an_edit_by_the_program_is_that_of_the_full_way(
    number: int, edits: list[Task], back: int
) -> None:
    """Edits of every kind on random nets, refusals among them; then undo, redo and one more."""
    one, other, count = fresh(number), fresh(number), Count()
    for hull, always in ((one, True), (other, False)):
        with by_program(count, always=always):
            for each in edits:
                carry_out(hull, each)
            for _ in range(min(back, len(hull.history))):
                hull.undo()
            for _ in range(min(back, len(hull.document.undone))):
                hull.redo()
            carry_out(hull, edits[0])
    assert_same(one, other)
    assert one.verify() == ()
    assert_numbers_are_those_of_the_tables(one)


SHIPS = ("series60_70", "bulk_carrier", *(("series60_60",) if LONG else ()))


@pytest.mark.parametrize("name", SHIPS)
def test_edits_of_ships_by_the_program(name: str, shipped: Shipped, backend_in_use: str) -> None:
    """Moves and pulls of random points, large ones with sub-steps among them."""
    hulls, count = (shipped(name), shipped(name)), Count()
    points = [key for key, point in hulls[0].points.items() if point.free == ("y",)]
    for hull, always in zip(hulls, (True, False), strict=True):
        rng = np.random.default_rng(28)
        with by_program(count, always=always):
            made = 0
            for number in range(60):
                point = points[int(rng.integers(len(points)))]
                size = float(rng.normal(0.0, 0.01 if number % 4 else 0.3))
                try:
                    with hull.edit(f"edit {number}", author="x") as edit:
                        if number % 2:
                            edit.pull(point, size, (20.0, 8.0))
                        else:
                            edit.move(point, y=hull.points[point].y + size)
                except ah.errors.AssocHullError:
                    continue
                made += 1
                if made == 12:
                    break
    assert_same(*hulls)
    assert count.kept > 5
    assert_numbers_are_those_of_the_tables(hulls[0])


def test_pulls_in_several_sub_steps_by_the_program(shipped: Shipped) -> None:
    """What is told of them begins before the first sub-step."""
    hulls, several = (shipped("bulk_carrier"), shipped("bulk_carrier")), 0
    points = [key for key, point in hulls[0].points.items() if point.free == ("y",)]
    for hull, always in zip(hulls, (True, False), strict=True):
        rng = np.random.default_rng(29)
        for number in range(10):
            point, count = points[int(rng.integers(len(points)))], Count()
            size, radius = float(rng.normal(0.0, 0.2)), float(rng.uniform(10.0, 60.0))
            with contextlib.suppress(ah.errors.AssocHullError), by_program(count, always=always):
                with hull.edit(f"edit {number}", author="x") as edit:
                    edit.pull(point, size, (radius, 0.4 * radius))
                several += count.kept == 1 < count.runs
    assert_same(*hulls)
    assert several >= 1
    assert_numbers_are_those_of_the_tables(hulls[0])


def _watched_points(hull: ah.Hull, free: list[str]) -> list[str]:
    """Points of curves that pass one another, whose gaps are measured when the points move."""
    table = hull.state.rows
    watched = table.alive.data & (table.sort.data == Sort.CROSSING)
    watched &= table.role.data == Role.WATCHED
    curves = set(table.curve[np.flatnonzero(watched)].ravel().tolist())
    return [key for key in free if table.curve[hull.points[key].row, 0] in curves]


APART = (
    ("WL 10 x ST 18.75", "WL 22 x ST 2"), ("WL 20 x ST 1.75", "WL 22 x ST 17"),
    ("WL 10 x ST 19.2", "WL 11 x ST 16.5"), ("WL 20 x ST 1.75", "WL 11 x ST 16.5"),
)  # fmt: skip
"""Points near watched gaps, and others far from them that are pulled in several sub-steps."""


def test_what_only_the_first_sub_step_reaches_is_kept_like_the_rest(shipped: Shipped) -> None:
    """A point moved far from a pull: gaps near it are measured once, and numbers written once."""
    hulls, several = (shipped("bulk_carrier"), shipped("bulk_carrier")), 0
    for hull, always in zip(hulls, (True, False), strict=True):
        for number, (moved, pulled) in enumerate(APART + APART[::-1]):
            count, way = Count(), 1 if number < len(APART) else -1
            with contextlib.suppress(ah.errors.AssocHullError), by_program(count, always=always):
                with hull.edit(f"edit {number}", author="x") as edit:
                    edit.move(moved, y=hull.points[moved].y + way * 2e-4)
                    edit.pull(pulled, way * 0.2, (20.0, 8.0))
                several += count.kept == 1 < count.runs
    # Whoever looks at numbers keeps them: those that edits hand on are looked at in the end only.
    assert_numbers_are_those_of_the_tables(hulls[0])
    assert_same(*hulls)
    assert several >= 4


def test_numbers_read_after_a_pull_and_its_undo_are_those_of_the_tables(shipped: Shipped) -> None:
    """The structure stays, so most are known; points that ride do so from other places then."""
    hull = shipped("series60_70")
    first = published_program(hull.document)
    assert first is not None
    with by_program(Count(), always=False), hull.edit("carry") as edit:
        edit.pull("WL 0.58 x ST 2", 0.01, (20.0, 8.0))
    second = published_program(hull.document)
    assert second is not None
    assert second.program is first.program
    odd = second.values.anchor_from != first.values.anchor_from
    assert np.count_nonzero(odd.any(axis=(1, 2))) > 5
    assert_numbers_are_those_of_the_tables(hull)
    hull.undo()
    assert_numbers_are_those_of_the_tables(hull)


ACTS = st.lists(
    st.tuples(
        st.sampled_from(["move", "pull", "undo", "redo", "preview", "full", "drag"]),
        st.integers(0, 2**20), st.floats(-0.01, 0.01),
    ),
    min_size=8, max_size=24,
)  # fmt: skip


FIRST = [("pull", 1, 1e-3), ("pull", 1, -1e-3), ("undo", 0, 0.0), ("pull", 1, 2e-3)]


@settings(max_examples=draws(10), deadline=None)
@given(acts=ACTS)
def test_numbers_carried_on_after_undo_are_those_of_the_tables(
    acts: list[tuple[str, int, float]], shipped: Shipped
) -> None:
    """Undo, redo and edits of the full way, between edits by the program, previews and drags."""
    hull, carried = shipped("series60_70"), 0
    free = [key for key, point in hull.points.items() if point.free == ("y",)]
    points = free[::40] + _watched_points(hull, free)[:8]
    carry = published_program_module._carry

    def looked_at(document: Document, state: HullState) -> object:
        nonlocal carried
        found = carry(document, state)
        if found is not None:
            carried += 1
            spare = document.program.spare
            numbers = [found.found.values, *([] if spare is None else [spare.values])]
            for values in numbers:
                assert_read_of(state, found.found.program, values)
        return found

    with (
        by_program(Count(), always=True),
        mock.patch.object(published_program_module, "_carry", looked_at),
    ):
        # The first two edits bring numbers that may be written to.
        for act, number, size in [*FIRST, *acts]:
            point = points[number % len(points)]
            with contextlib.suppress(ah.errors.AssocHullError):
                _one_act(hull, act, point, size)
            assert_numbers_at_hand_are_those_of_the_tables(hull)
    assert carried >= 1
    assert hull.verify() == ()


def assert_numbers_at_hand_are_those_of_the_tables(hull: ah.Hull) -> None:
    """The published ones, and those that the next edit would write."""
    known, spare = known_numbers(hull.document), hull.document.program.spare
    if known is None:
        return
    assert_read_of(hull.state, *known)
    if spare is not None and spare.published.values is known[1] and not spare.written:
        for name in (each.name for each in attrs.fields(Values)):
            if name != "segment":
                mine, theirs = getattr(spare.values, name), getattr(known[1], name)
                assert mine.tobytes() == theirs.tobytes(), name


def _one_act(hull: ah.Hull, act: str, point: str, size: float) -> None:
    if act in ("undo", "redo"):
        if len(hull.history if act == "undo" else hull.document.undone):
            getattr(hull, act)()
    elif act == "preview":
        hull.preview([{"op": "pull", "point": point, "d": size, "radius": [20.0, 8.0]}])
    elif act == "drag":
        with hull.drag(point, radius=(20.0, 8.0)) as drag:
            drag.to(d=size)
            if size > 0.0:
                with contextlib.suppress(ah.errors.AssocHullError):
                    drag.to(d=30.0 * size)
                    drag.commit("too far, maybe")
                    return
                assert_numbers_at_hand_are_those_of_the_tables(hull)
                drag.to(d=size)
                drag.commit("drag")
    else:
        with by_program(Count(), always=act != "full"), hull.edit(act) as edit:
            if act == "move":
                edit.move(point, y=hull.points[point].y + size)
            else:
                edit.pull(point, size, (20.0, 8.0))


@pytest.mark.parametrize("always", [True, False], ids=["by the program", "the full way"])
def test_where_a_segment_is_thought_to_be_changes_no_bit(always: bool, shipped: Shipped) -> None:
    """Gaps are measured alike whatever segments the search for their parameters begins at."""
    hulls = shipped("series60_70"), shipped("series60_70")
    free = [key for key, point in hulls[0].points.items() if point.free == ("y",)]
    points = _watched_points(hulls[0], free)[:8]
    for hull, wrong in zip(hulls, (True, False), strict=True):
        rng = np.random.default_rng(33)
        with by_program(Count(), always=always):
            for number, point in enumerate(points * 2):
                if wrong:
                    guess = hull.document.index.guess
                    guess[:] = rng.integers(-5, 200, guess.shape)
                with contextlib.suppress(ah.errors.AssocHullError), hull.edit(f"{number}") as edit:
                    edit.move(point, y=hull.points[point].y + 1e-3 * (-1) ** number)
    assert len(hulls[0].history) > 5
    assert_same(*hulls)
    assert hulls[0].verify() == ()


def test_an_edit_that_no_program_can_try_is_refused_as_the_full_way_does() -> None:
    """A pull over more sub-steps than there may be is refused in the same words."""
    told = list[tuple[type[Exception], str]]()
    for always in (True, False):
        hull = ah.examples.wigley()
        refused = pytest.raises(ah.errors.AssocHullError)
        with by_program(Count(), always=always), refused as raised, hull.edit("far") as edit:
            edit.pull("WL 2.5 x ST 7", 1e3, (20.0, 4.0))
        told.append((raised.type, str(raised.value)))
        assert hull.verify() == ()
    assert told[0] == told[1]
    assert told[0][0] is ah.errors.RefusedEditError
