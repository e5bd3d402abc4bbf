"""I3: nothing is lofted that need not be, and nothing twice; told by a walk of the role table."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from unittest import mock

import numpy as np
from hypothesis import given, settings

import assoc_hull as ah
from assoc_hull.edit import modification as work
from assoc_hull.edit.program_edit import ProgramEdit
from assoc_hull.edit.step import EditReport
from assoc_hull.graph import run_update as engine
from assoc_hull.graph.run_update import UpdatePass
from assoc_hull.model.node import Node
from tests.cases import places
from tests.independent import closure, relofted, snapshot
from tests.long_forms import draws
from tests.net_strategies import (
    SHAPES,
    STRUCTURE,
    Task,
    carry_out,
    hulls,
    knuckled,
    tasks,
)


@contextmanager
def passes() -> Iterator[list[UpdatePass]]:
    """Listen to the passes of the engine."""
    heard: list[UpdatePass] = []
    run = engine.run_update

    def listen(*given: object, **named: object) -> UpdatePass:
        heard.append(run(*given, **named))  # type: ignore[arg-type]
        return heard[-1]

    full_way = mock.patch.object(ProgramEdit, "of", return_value=None)
    with full_way, mock.patch.object(work, "run_update", listen):
        yield heard


def quiet(report: EditReport) -> bool:
    """Whether an edit needed no second pass."""
    return not (report.born or report.gone or report.mended)


@settings(max_examples=draws(25))
@given(hulls(), tasks((*SHAPES, "set_role")))
def test_the_curves_lofted_are_those_whose_inputs_changed(hull: ah.Hull, edits: list[Task]) -> None:
    """The report lists exactly the curves that the walk over the tables gives."""
    for task in edits:
        before = snapshot(hull)
        report = carry_out(hull, task)
        if report is not None:
            wanted = relofted(before, hull)
            assert len(report.relofted) == len(set(report.relofted))
            assert wanted <= set(report.relofted)
            if quiet(report):
                assert needless(report, wanted, task) == set()


def needless(report: EditReport, wanted: set[str], task: Task) -> set[str]:
    """Curves lofted although the walk does not ask for it.

    An edit that says again what is so already, or takes back what it did, may loft a curve
    whose inputs come out as they were.
    """
    if {act.op for act in task.acts} & {"set_end", "set_kind", "insert", "delete", "set_role"}:
        return set()
    return set(report.relofted) - wanted


MOVES_IN_STEPS = {"pull", "reshape", "lead", "straighten", "round", "spread"}


@settings(max_examples=draws(25))
@given(hulls(), tasks((*SHAPES, *STRUCTURE)))
def test_no_pass_evaluates_a_node_twice(hull: ah.Hull, edits: list[Task]) -> None:
    """In the main pass and in each that follows; an edit that stays quiet has only one."""
    for task in edits:
        with passes() as heard:
            report = carry_out(hull, task)
        for part in heard:
            assert len(part.evaluated) == len(np.unique(part.evaluated))
        fields = any(act.op in MOVES_IN_STEPS for act in task.acts)
        if report is not None and quiet(report) and not fields:
            assert len(heard) == 1


@settings(max_examples=draws(15))
@given(hulls(), tasks(("move",)))
def test_a_second_pass_lofts_only_what_births_deaths_and_mends_touch(
    hull: ah.Hull, edits: list[Task]
) -> None:
    """Each curve in it reads a point that came, went, or was moved by mending."""
    for task in edits:
        with passes() as heard:
            report = carry_out(hull, task)
        if report is None:
            continue
        keys = hull.state.curves.key.data
        for part in heard[1:]:
            pushed = set(part.cause.reader.tolist())
            seeds = [n for n in part.evaluated.tolist() if Node.is_curve(n) and n not in pushed]
            touched = set(report.mended) | _curves_of(hull, (*report.born, *report.gone))
            assert {keys[Node.number(node)] for node in seeds} <= touched


def _curves_of(hull: ah.Hull, rows: tuple[str, ...]) -> set[str]:
    table = hull.state.rows
    numbers = [table.key.data.index(key) for key in rows]
    return {hull.state.curves.key[c] for c in table.curve[numbers].ravel().tolist()}


@settings(max_examples=draws(20))
@given(hulls(), tasks(("move",), most=3, acts=1))
def test_a_move_stays_within_the_closure_of_the_role_table(
    hull: ah.Hull, edits: list[Task]
) -> None:
    """The closure is what an update without cut-off would loft; more is never lofted."""
    for task in edits:
        report = carry_out(hull, task)
        if report is None or not quiet(report):
            continue
        step = hull.document.history[-1]
        seeds = {hull.state.rows.key[Node.number(node)] for node in step.seeds.tolist()}
        assert set(report.relofted) <= closure(hull, seeds)


def test_a_value_that_comes_out_as_it_was_stops_the_update() -> None:
    """Early cut-off: below a knuckle a section changes, above it drives what stays as it is."""
    hull = ah.Hull(knuckled(5, 4, two_way=False).adopt())
    low = hull.points["ST 3 @ adopted 2"]
    above, beside = (hull.lines[name].curves[0].id for name in ("WL 5.000", "WL 2.500"))
    assert {above, beside} <= closure(hull, {low.id})
    with hull.edit("below the knuckle") as edit:
        edit.move(low, y=low.y + 0.01, z=low.z, lead=False)
    report = edit.report
    assert report is not None
    assert report.cut_off > 0
    assert beside in report.relofted
    assert above not in report.relofted


def test_the_lofted_curves_of_series_60_are_those_of_the_walk(series60_70: ah.Hull) -> None:
    """For drags and pulls at crossings of all three pairs."""
    hull = series60_70
    for row in places.places(hull, places.PAIRS, 9, 2):
        for act in (places.drag(hull, 0.005), places.pull(hull, 0.02)):
            before = snapshot(hull)
            try:
                with hull.edit("act") as edit:
                    act(edit, row)
            except ah.errors.RefusedEditError:
                continue
            report = edit.report
            assert report is not None
            wanted = relofted(before, hull)
            assert set(report.relofted) >= wanted
            assert not quiet(report) or set(report.relofted) == wanted
            hull.undo()
