"""I8: with a failure injected at every node in turn, the hull is as it was, to the last bit.

Under `keep_going` only what is made from the failed curve is blocked, and the next edit works.
"""

from __future__ import annotations

import itertools
import random
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from unittest import mock

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit import update
from assoc_hull.edit.document import Document
from assoc_hull.edit.program_edit import ProgramEdit
from assoc_hull.edit.script import PolicyName
from assoc_hull.edit.session import Edit
from assoc_hull.errors import AssocHullError, TooFewPointsError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.run_update import Evaluation
from assoc_hull.graph.table import Column
from assoc_hull.model import network
from assoc_hull.model.kinds import State
from assoc_hull.model.network import HullNetwork
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState
from tests.cases import places
from tests.independent import closure, curve_bits, snapshot
from tests.net_strategies import live_points
from tests.properties.test_i03_minimality import passes
from tests.properties.test_program_edits import Count, by_program
from tests.strategies import wigley_sources


@pytest.fixture(autouse=True)
def by_the_full_way(request: pytest.FixtureRequest) -> Iterator[None]:
    """Failures are put where the full way passes; the program has a test of its own."""
    if "program" in request.node.name:
        yield
        return
    with mock.patch.object(ProgramEdit, "of", return_value=None):
        yield


Change = Callable[[Edit], object]
FAILED = TooFewPointsError("the injected failure", 1)


@attrs.frozen
class Whole:
    """All that must be as it was."""

    fingerprint: str
    points: tuple[str, ...]
    curves: tuple[str, ...]
    counts: tuple[int, ...]
    revisions: tuple[dict[int, int], dict[int, int]]
    history: tuple[str, ...]
    undone: tuple[str, ...]
    levels: bytes


def whole(hull: ah.Hull) -> Whole:
    """Take it down: bits, ids, tables, revisions, journal and look-ups."""
    state, document = hull.state, hull.document
    return Whole(
        hull.fingerprint,
        tuple(state.rows.key.data),
        tuple(state.curves.key.data),
        tuple(table.count for table in (state.rows, state.curves, state.lines, state.groups)),
        (dict(state.revision_row), dict(state.revision_curve)),
        tuple(step.name for step in document.history),
        tuple(step.name for step in document.undone),
        document.index.level.tobytes(),
    )


@contextmanager
def failing_at(stage: str, node: int, error: BaseException = FAILED) -> Iterator[None]:
    """Let one stage of the update fail where it comes to one node."""
    with _STAGES[stage](node, error):
        yield


def _evaluate(node: int, error: BaseException) -> mock._patch[object]:
    original = HullNetwork.evaluate

    def fail(self: HullNetwork, nodes: IntArray, journal: Journal) -> Evaluation:
        if node in nodes.tolist():
            raise error
        return original(self, nodes, journal)

    return mock.patch.object(HullNetwork, "evaluate", fail)


def _after(node: int, error: BaseException) -> mock._patch[object]:
    """Fail when the node has been evaluated and its value written."""
    original = HullNetwork.evaluate

    def fail(self: HullNetwork, nodes: IntArray, journal: Journal) -> Evaluation:
        found = original(self, nodes, journal)
        if node in nodes.tolist():
            raise error
        return found

    return mock.patch.object(HullNetwork, "evaluate", fail)


def _in_network(name: str, argument: int) -> Callable[[int, BaseException], mock._patch[object]]:
    """Fail in a function that the network calls with the curves of a batch."""

    def patch(node: int, error: BaseException) -> mock._patch[object]:
        original = getattr(network, name)

        def fail(*given: object, **named: object) -> object:
            curves = given[argument]
            assert isinstance(curves, np.ndarray)
            if Node.is_curve(node) and Node.number(node) in curves.tolist():
                raise error
            return original(*given, **named)

        return mock.patch.object(network, name, fail)

    return patch


def _in_check(name: str) -> Callable[[int, BaseException], mock._patch[object]]:
    """Fail in a check that looks at the curve of the node."""

    def patch(node: int, error: BaseException) -> mock._patch[object]:
        original = getattr(update, name)

        def fail(state: HullState, curves: IntArray, *rest: object) -> object:
            if Node.is_curve(node) and Node.number(node) in curves.tolist():
                raise error
            return original(state, curves, *rest)

        return mock.patch.object(update, name, fail)

    return patch


def _publish(node: int, error: BaseException) -> mock._patch[object]:
    """Fail when the points have been revised and the curves have not, or before both."""
    original = Document._revise

    def fail(self: Document, revised: list[tuple[dict[int, int], dict[int, int]]]) -> None:
        points, curves = revised
        if node & 1 and node >> 1 in curves[1]:
            original(self, [points, (curves[0], {})])
            raise error
        if not node & 1 and node >> 1 in points[1]:
            raise error
        original(self, revised)

    return mock.patch.object(Document, "_revise", fail)


_STAGES = {
    "evaluate": _evaluate,
    "evaluated": _after,
    "loft": _in_network("loft_curves", 1),
    "intersection": _in_network("cut_curves", 2),
    "gaps": _in_check("measure_gaps"),
    "folds": _in_check("find_folds"),
    "sense": _in_check("find_turned"),
    "numbers": _in_check("find_unbounded"),
    "publish": _publish,
}
_CHECKS = ("gaps", "folds", "sense", "numbers")
_GONE_PAST = ("loft", "intersection")


def smallest() -> ah.Hull:
    """Give the smallest net of three families."""
    net = wigley_sources(3, 2, 1)
    loose = tuple(attrs.evolve(each, tolerance=0.03) for each in net.sources)
    return ah.Hull(attrs.evolve(net, sources=loose).adopt())


@attrs.frozen
class Reach:
    """What an edit comes to, by carrying it out once: nodes, points even and curves odd."""

    evaluated: tuple[int, ...]
    touched: tuple[int, ...]
    changed: tuple[int, ...]

    def of(self, stage: str) -> list[int]:
        """Give the nodes at which a stage can fail."""
        if stage == "publish":
            return list(self.changed)
        if stage in _CHECKS:
            return list(self.touched)
        return [
            node
            for node in self.evaluated
            if Node.is_curve(node) or stage in ("evaluate", "evaluated")
        ]


def reach_of(hull: ah.Hull, change: Change) -> Reach:
    """Carry an edit out, listen to its passes, and take it back."""
    with passes() as heard, hull.edit("reference", gaps="report") as edit:
        change(edit)
    report, step = edit.report, hull.document.history[-1]
    assert report is not None
    number = {key: i for i, key in enumerate(hull.state.curves.key.data)}
    evaluated = {node for part in heard for node in part.evaluated.tolist()}
    touched = {2 * number[key] + 1 for key in report.relofted}
    hull.undo()
    hull.document.undone.clear()
    return Reach(
        tuple(sorted(evaluated)), tuple(sorted(touched)), tuple(sorted(set(step.changed.tolist())))
    )


def shared(hull: ah.Hull) -> list[ah.Point]:
    """Give the shared crossings of sections and waterlines."""
    points = [p for p in live_points(hull, "crossing") if p.crossing_role == "shared"]
    return [p for p in points if p.free == ("y",) and not hull.state.rows.contact[p.row]]


def pull_wide(hull: ah.Hull) -> Change:
    """A pull that reaches most of a small net."""
    point = shared(hull)[0]
    return lambda edit: edit.pull(point, 0.004, (60.0, 10.0))


def structural(hull: ah.Hull) -> Change:
    """A new line, a point and a role in one edit."""
    line = next(iter(hull.groups["waterlines"].lines.values())).curves[0]
    point = shared(hull)[0]

    def change(edit: Edit) -> None:
        edit.add_line("waterlines", 0.37 * hull.particulars.draught)
        edit.insert(line, line.at(0.43 * line.span))
        edit.set_role(point, "watched")

    return change


def drag(hull: ah.Hull) -> Change:
    """A pinned move."""
    points = shared(hull)
    point = points[len(points) // 2]
    return lambda edit: edit.move(point, y=point.y + 0.004)


def lead(hull: ah.Hull) -> Change:
    """A waterline that leads: trials beside the hull, then the field that they chose."""
    point = shared(hull)[0]
    x, y, z = point.position
    lines = (side.container_curve.line for side in (point, point.friend_point) if side is not None)
    line = next(each for each in lines if each.group.name == "waterlines")
    return lambda edit: edit.lead(line, [(point, (x, y + 0.003, z))])


def switch(hull: ah.Hull) -> Change:
    """Who rules where, a group, an association parted and joined, and a line that comes."""

    def change(edit: Edit) -> None:
        edit.group("aft", ["ST 1"])
        edit.rule("waterlines", "sections", [("waterlines", {"z": (None, 4.0)})])
        edit.dissociate("waterlines", "buttocks")
        edit.associate("waterlines", "buttocks", two_way=False)
        edit.add_line("waterlines", 0.37 * hull.particulars.draught)

    return change


CHANGES = {
    "drag": drag, "pull": pull_wide, "structure": structural, "lead": lead, "switch": switch,
}  # fmt: skip


def refuse(
    hull: ah.Hull,
    change: Change,
    stage: str,
    node: int,
    error: BaseException = FAILED,
    policy: PolicyName = "all_or_nothing",
    *,
    before: tuple[object, ...],
) -> None:
    """Carry out an edit that fails at a node: the tables must be what they were before."""
    try:
        with failing_at(stage, node, error), hull.edit("failing", policy, "report") as edit:
            change(edit)
    except (AssocHullError, ArithmeticError, RuntimeError, KeyboardInterrupt):
        assert tables(hull) == before, f"{stage} at {node}"
        return
    raise AssertionError(f"{stage} never came to {node}")


def tables(hull: ah.Hull) -> tuple[object, ...]:
    """Give every bit of the tables, of lists the very objects, with revisions and history.

    Keys of points are made when they are asked for: of these the texts.

    Of the published state and of the live tables that edits write to.
    """
    state, document = hull.state, hull.document
    columns = [
        column.data.tobytes()
        if isinstance(column, Column)
        else [x if isinstance(x, str) else id(x) for x in column.data]
        for state in (hull.state, hull.document.state)
        for table in (state.rows, state.curves, state.lines, state.groups, state.settings)
        for column in table.columns.values()
    ]
    revisions = dict(state.revision_row), dict(state.revision_curve)
    steps = list(map(id, document.history)), list(map(id, document.undone))
    return columns, revisions, steps, document.index.level.tobytes(), document.writer


@pytest.mark.parametrize("policy", ["all_or_nothing", "keep_going"])
@pytest.mark.parametrize("name", CHANGES)
def test_a_failure_at_any_node_leaves_the_hull_as_it_was(name: str, policy: PolicyName) -> None:
    """At every node that a stage comes to, on the smallest three-family net.

    With `keep_going` only curves that cannot be lofted or met are gone past, see below; a
    failure in a check or on publication takes all back.
    """
    hull = smallest()
    change = CHANGES[name](hull)
    reach, before, there = reach_of(hull, change), whole(hull), tables(hull)
    apart = 8 if name == "lead" else 1  # it comes to the same nodes in each of its trials
    for stage in _STAGES if policy == "all_or_nothing" else (*_CHECKS, "publish"):
        assert reach.of(stage) or (name == "switch" and stage in _GONE_PAST)
        for node in reach.of(stage)[::apart]:
            refuse(hull, change, stage, node, policy=policy, before=there)
    assert whole(hull) == before
    with hull.edit("after all", gaps="report") as edit:
        change(edit)
    assert hull.verify() == ()


@pytest.mark.parametrize(
    "error",
    [
        pytest.param(FloatingPointError("divide by zero"), id="arithmetic"),
        pytest.param(RuntimeError("a defect"), id="defect"),
        pytest.param(KeyboardInterrupt(), id="interrupt"),
    ],
)
def test_any_kind_of_failure_is_taken_back(error: BaseException) -> None:
    """A defect of the kernel or an interrupt too, at the first and the last node of each stage."""
    hull = smallest()
    for change in (drag(hull), structural(hull)):
        reach, before, there = reach_of(hull, change), whole(hull), tables(hull)
        for stage in _STAGES:
            for node in (reach.of(stage)[0], reach.of(stage)[-1]):
                refuse(hull, change, stage, node, error, before=there)
        assert whole(hull) == before


def test_a_curve_that_failed_goes_with_its_line(tmp_path: Path) -> None:
    """It is none of the failed ones any more, and the hull file opens."""
    hull = smallest()
    node = next(node for node in reach_of(hull, drag(hull)).of("loft"))
    change = drag(hull)
    with failing_at("loft", node), hull.edit("failing", "keep_going", "report") as edit:
        change(edit)
    assert hull.state.failed == (Node.number(node),)
    hull.save(tmp_path / "ship.hull")
    name = ah.Curve.of(hull.state, Node.number(node)).line.name
    with hull.edit("without it", gaps="report") as edit:
        edit.remove_line(name)
    assert len(hull.state.failed) == 0
    hull.close()
    again = ah.open(tmp_path / "ship.hull")
    assert name not in again.lines
    assert again.verify() == ()
    again.close()


@pytest.mark.parametrize("stage", _GONE_PAST)
@pytest.mark.parametrize("name", ["drag", "pull"])
def test_keep_going_blocks_readers_only(name: str, stage: str) -> None:
    """Each curve in turn cannot be lofted or met: it keeps its shape, its readers are blocked.

    All else updates as without the failure, the next edit works, and undo restores all.
    """
    hull = smallest()
    change = CHANGES[name](hull)
    curves = reach_of(hull, change).of(stage)
    with hull.edit("reference", gaps="report") as edit:
        change(edit)
    reference = snapshot(hull)
    hull.undo()
    assert curves
    for node in curves:
        keeps_going(hull, change, stage, node, reference.curves)


def keeps_going(
    hull: ah.Hull, change: Change, stage: str, node: int, wanted: dict[str, bytes]
) -> None:
    """Carry out an edit while one curve fails, and look at all the others; mend it after."""
    before, old = whole(hull), snapshot(hull).curves
    with failing_at(stage, node), hull.edit("failing", "keep_going", "report") as edit:
        change(edit)
    report, state = edit.report, hull.state
    assert report is not None
    key = state.curves.key[Node.number(node)]
    assert report.failed
    reach = readers_of(hull, Node.number(node))
    assert state.failed == (Node.number(node),)
    assert {name for name in report.blocked if name in old} == reach
    for curve in state.live("curves").tolist():
        name, handle = state.curves.key[curve], ah.Curve.of(state, curve)
        assert handle.state == (
            "failed" if name == key else "blocked" if name in reach else "clean"
        )
        kept = name == key or name in reach
        assert curve_bits(state, curve) == (old if kept else wanted)[name]
    assert {finding.kind for finding in hull.check()} >= {"failed"}
    next_edits_work(hull, Node.number(node))
    hull.undo()
    assert attrs.evolve(whole(hull), revisions=before.revisions, undone=()) == attrs.evolve(
        before, undone=()
    )


def readers_of(hull: ah.Hull, curve: int) -> set[str]:
    """Walk the role table from the points computed from a curve."""
    rows = hull.state.rows
    driven = {
        rows.key[row] for row in hull.state.live("rows").tolist() if rows.driver[row] == curve
    }
    return closure(hull, driven) - {hull.state.curves.key[curve]}


def next_edits_work(hull: ah.Hull, failed: int) -> None:
    """One that leaves the failed curve alone; one that mends it; both are taken back."""
    far = [
        point
        for point in live_points(hull, "crossing")
        if point.crossing_role == "shared"
        and point.free == ("y",)
        and failed not in hull.state.rows.curve[point.row].tolist()
    ]
    with hull.edit("elsewhere", "keep_going", "report") as edit:
        edit.move(far[0], y=far[0].y + 0.001)
    assert hull.state.failed == (failed,)
    curve = ah.Curve.of(hull.state, failed)
    with hull.edit("mend", gaps="report") as edit:
        edit.set_end(curve, "start", tangent=curve.tangent(0.0))
    assert len(hull.state.failed) == 0
    assert {finding.kind for finding in hull.check()} <= {"gap", "fold"}
    assert hull.verify() == ()
    hull.undo(2)
    assert hull.state.failed == (failed,)


def test_a_sample_of_80_nodes_of_series_60(series60_70: ah.Hull) -> None:
    """Both policies and every stage, on a pull that reaches some 700 nodes.

    A node fails before or after it is evaluated, under one policy or the other, turn about; the
    smallest net has them all.
    """
    hull, rng = series60_70, random.Random(60)
    row = places.places(hull, places.PAIRS[:1], 3, 11)[2]

    def change(edit: Edit) -> None:
        places.pull(hull, 0.02, (40.0, 12.0))(edit, row)

    reach, before, there = reach_of(hull, change), whole(hull), tables(hull)
    every = sorted({*reach.evaluated, *reach.changed})
    sample = set(rng.sample(every, 80))
    for stage in _STAGES:
        one, other = turn_about(sample & set(reach.of(stage)))
        for node in () if stage == "evaluated" else one:
            refuse(hull, change, stage, node, before=there)
        for node in () if stage == "evaluate" else other:
            on = stage in (*_CHECKS, "publish")
            policy: PolicyName = "keep_going" if on else "all_or_nothing"
            refuse(hull, change, stage, node, policy=policy, before=there)
    assert whole(hull) == before
    for stage in _GONE_PAST:
        for node in sorted(sample & set(reach.of(stage))):
            with failing_at(stage, node), hull.edit("failing", "keep_going", "report") as edit:
                change(edit)
            assert blocked(hull) == (
                readers_of(hull, Node.number(node)) if hull.state.failed else set()
            )
            hull.undo()
    assert hull.fingerprint == before.fingerprint
    hull.document.undone.clear()


def turn_about(nodes: set[int]) -> tuple[list[int], list[int]]:
    """Deal out nodes in two parts."""
    every = sorted(nodes)
    return every[::2], every[1::2]


def blocked(hull: ah.Hull) -> set[str]:
    """Keys of the curves that are not up to date."""
    table = hull.state.curves
    return {table.key[i] for i in np.flatnonzero(table.state.data == State.BLOCKED)}


def break_off(hull: ah.Hull, change: Change) -> None:
    """Raise an error in the block, after the change was asked for."""
    with hull.edit("broken") as edit:
        change(edit)
        raise ZeroDivisionError


def catch_and_go_on(hull: ah.Hull, change: Change) -> None:
    """Catch the error of a nested edit in the outer one, and ask for more."""
    with hull.edit("outer"):
        with pytest.raises(ZeroDivisionError):
            break_off(hull, change)
        with hull.edit("again") as again:
            change(again)


def test_an_exception_in_the_block_takes_everything_back() -> None:
    """Also what was written before it: lines, points, roles."""
    hull = smallest()
    before = whole(hull)
    with pytest.raises(ZeroDivisionError):
        break_off(hull, structural(hull))
    assert whole(hull) == before


def test_a_failed_nested_edit_takes_the_outer_one_with_it() -> None:
    """Also what is asked for after the failure was caught."""
    hull = smallest()
    before, change = whole(hull), structural(hull)
    with pytest.raises(ah.errors.RefusedEditError, match="nested"):
        catch_and_go_on(hull, change)
    assert whole(hull) == before
    with hull.edit("after") as edit:
        change(edit)
    assert hull.verify() == ()


def test_a_failure_at_any_write_of_a_switch_is_taken_back() -> None:
    """Of every seventh write: roles, stand-ins, groups and rulings are as before; then it works."""
    hull = smallest()
    change, before, at = switch(hull), whole(hull), 0
    while True:
        at += 7
        with _failing_write(at):
            try:
                with hull.edit("failing", gaps="report") as edit:
                    change(edit)
            except MemoryError:
                assert whole(hull) == before
            else:
                break
    assert at > 100
    assert hull.verify() == ()


@contextmanager
def _failing_write(number: int) -> Iterator[None]:
    """Let the write of that number to the tables fail."""
    calls = itertools.count(1)

    def failing(write: Callable[..., object]) -> Callable[..., object]:
        def run(*given: object) -> object:
            if next(calls) == number:
                raise MemoryError  # not of the family: such the full way would serve
            return write(*given)

        return run

    with ExitStack() as stack:
        for name in ("put", "set", "put_parts"):
            write = failing(getattr(Journal, name))
            stack.enter_context(mock.patch.object(Journal, name, write))
        yield


@pytest.mark.parametrize("act", ["move", "pull"])
def test_a_failure_at_any_write_of_the_program_is_taken_back(act: str) -> None:
    """Whichever write of an edit by the program fails, the hull is as it was; then it works."""
    hull = smallest()
    point = shared(hull)[0]
    name, place = point.id, point.y

    def edit() -> None:
        with by_program(Count(), always=True), hull.edit("by the program") as opened:
            if act == "move":
                opened.move(name, y=place - 0.004)
            else:
                opened.pull(name, -0.004, (20.0, 4.0))

    edit()
    hull.undo()
    hull.document.undone.clear()
    before, done = whole(hull), False
    for at in range(1, 60):
        with _failing_write(at):
            try:
                edit()
            except MemoryError:
                assert whole(hull) == before
            else:
                done = True
        if done:
            break
    assert done
    assert at > 4
    assert hull.verify() == ()
