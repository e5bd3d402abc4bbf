"""The program of a net: a run gives the bits of the full way, or says that it cannot tell.

Live drags are the full way's judge: `Drag.to` runs the program where it can, and a drag that has no
program carries out the whole edit. Both look at the same hull, which neither changes.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import Any

import attrs
import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.edit.drag import Drag, Live
from assoc_hull.edit.published_program import published_program
from assoc_hull.geometry.curves import EndKind, FloatArray, SplineBatch
from assoc_hull.geometry.splines.curve_order import curve_folds
from assoc_hull.model.feature_geometry import off_shapes, places_off
from assoc_hull.model.index import build_index
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.program.run_program import (
    Doubt,
    NumpyProgram,
    ProgramRun,
    RunProgram,
    differs,
    features_left,
    run_program,
    write_points,
)
from assoc_hull.model.program.structure import (
    CompiledFeatures,
    Program,
    PublishedProgram,
    Values,
    compile_program,
)
from assoc_hull.model.tables import HullState, copy_state
from tests.conftest import Shipped
from tests.long_forms import LONG, draws
from tests.net_strategies import POOL, SHAPES, STRUCTURE, Act, Task, carry_out, fresh, tasks

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


@settings(max_examples=draws(40))
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


# A straight run that a drag bends by little is drawn anew on its moved ends.
@example(number=0, edits=[Task((Act("straighten", 2, 1, 0.0),), "refuse")], seed=17)
@example(number=0, edits=[Task((Act("straighten", 0, 0, 0.0),), "refuse")], seed=136)
@settings(max_examples=draws(25), deadline=None)
@given(number=st.integers(0, POOL - 1), edits=tasks_of_all_kinds, seed=st.integers(0, 2**32 - 1))
def test_a_step_of_a_drag_is_the_whole_edit_to_the_bit(
    number: int, edits: list[Task], seed: int
) -> None:
    """On random nets after random edits; refusals have the same words."""
    hull = fresh(number)
    for each in edits:
        carry_out(hull, each)
    assert_drags_agree(hull, np.random.default_rng(seed), 4)


@pytest.mark.parametrize(
    "name", ["series60_70", "bulk_carrier", *(["container_ship_225m"] if LONG else [])]
)
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
            watched, curves = one.watched[::2], rng.permutation(one.curves)
            told = [
                attrs.astuple(runner.compare(values, before, one.rows, watched, curves))
                for runner, values in zip(runners, numbers, strict=True)
            ]
            assert told[0][0].tolist() == one.rows.tolist()
            for mine, others in zip(*told, strict=True):
                assert (mine.dtype, mine.tolist()) == (others.dtype, others.tolist())
        for runner, values, run in zip(runners, numbers, runs, strict=True):
            runner.restore(values, before, run)
            same_numbers(values, before)
    assert len(doubts) >= 4, doubts


@pytest.mark.parametrize(
    ("role", "side"),
    [("shared", 0), ("shared", 1), ("driven", 0), ("watched", 0), ("watched", 1)],
    ids=["shared, a", "shared, b", "driven, the driver", "watched, a", "watched, b"],
)
def test_curves_that_lack_a_meeting_go_the_full_way(role: str, side: int, shipped: Shipped) -> None:
    """A crossing that one of its curves does not meet: no run can tell where it goes."""
    state = copy_state(shipped("bulk_carrier").state)
    table, lacked = state.rows, 0
    crossing = table.alive.data & (table.sort.data == Sort.CROSSING) & ~table.contact.data
    for row in np.flatnonzero(crossing).tolist():
        curves, driver = table.curve[row].tolist(), int(table.driver[row])
        is_role = "shared" if driver < 0 else "driven"
        if table.role[row] == Role.WATCHED:
            is_role = "watched"
        if is_role != role or (role == "driven" and driver != curves[side]):
            continue
        curve, lacked = curves[side], lacked + 1
        met = state.curves.meets[curve]
        without = attrs.evolve(met, row=np.where(met.row == row, -1, met.row))
        state.curves.meets.store[curve] = without
        program = compile_program(state, build_index(state))
        state.curves.meets.store[curve] = met
        assert program is not None
        unsure = program.number[program.unsure != 0].tolist()
        assert sorted(unsure) == (sorted(curves) if role == "watched" else [curve])
        if lacked == 3:
            break
    assert lacked


def test_curves_whose_watched_crossings_went_with_a_line_go_by_the_program(
    shipped: Shipped,
) -> None:
    """Crossings that are gone stay in the tables, but nothing is to be measured there."""
    hull = shipped("bulk_carrier")
    table = hull.state.rows
    watched = table.alive.data & (table.sort.data == Sort.CROSSING)
    rows = np.flatnonzero(watched & (table.role.data == Role.WATCHED))
    with hull.edit("fewer") as edit:
        edit.remove_line(str(table.key[int(rows[0])]).split(" x ")[0])
    left = rows[hull.state.rows.alive[rows]]
    found = program_of(hull)
    assert found is not None
    assert 0 < len(left) < len(rows)
    assert found.program.watch.tolist() == left.tolist()
    assert not found.program.unsure.any()


@pytest.mark.parametrize("arithmetic", ["numpy", "compiled"])
def test_points_are_off_a_feature_by_what_it_says_itself(arithmetic: str, shipped: Shipped) -> None:
    """Whichever of its points has moved; a run has a doubt of those that are off, and no other."""
    hull = shipped("bulk_carrier")
    found, features = program_of(hull), hull.state.features
    assert found is not None
    table, values, shapes = found.program.features, found.values.copy(), set[int]()
    owners: dict[int, list[int]] = {}
    for number, each in enumerate(features):
        for row in set(each.points):
            owners.setdefault(row, []).append(number)
    assert [each.points for each in features] == [
        tuple(table.point[a:b].tolist()) for a, b in itertools.pairwise(table.start.tolist())
    ]
    for number, each in enumerate(features):
        shape = int(table.shape[number])
        for row in {each.points[0], each.points[len(each.points) // 2], each.points[-1]}:
            values.xyz[row] += (0.02, 0.03, -0.01)
            places = values.xyz[list(each.points)]
            wanted = float(places_off(each, places).max())
            if arithmetic == "numpy":
                off = float(off_shapes(shape, table.numbers[number], places).max())
                left = [
                    i for i in owners[row]
                    if places_off(features[i], values.xyz[list(features[i].points)]).max()
                    > table.limit[i]
                ]  # fmt: skip
                told, _ = features_left(found.program, values, np.array([row]))
                assert told.tolist() == left
            else:
                off = compiled_off(table, number, values.xyz)
            assert abs(off - wanted) <= 1e-12
            shapes.add(shape)
            values.xyz[row] = found.values.xyz[row]
    assert shapes >= {0, 1, 2}


def compiled_off(table: CompiledFeatures, number: int, xyz: FloatArray) -> float:
    """What the compiled form measures; as Python, which spares the compiler."""
    pytest.importorskip("numba")
    from assoc_hull.model.program.compiled_program import _off_feature

    measure: Callable[..., float] = _off_feature.py_func  # type: ignore[attr-defined]
    return measure(number, table.start, table.point, table.shape, table.numbers, xyz)


def test_a_meeting_in_another_sense_is_another_structure(shipped: Shipped) -> None:
    """Each curve that meets what it did, but passes a plane the other way, is doubted."""
    found = program_of(shipped("bulk_carrier"))
    assert found is not None
    program, before = found.program, found.values
    for curve in np.unique(program.meet_curve)[::40].tolist():
        sign, meeting = program.meet_sign.copy(), int(program.meet_start[curve])
        sign[meeting] = -sign[meeting]
        flipped = attrs.evolve(program, meet_sign=sign)
        run = run_program(flipped, before.copy(), before, NONE, NONE, np.array([curve]))
        assert (run.doubt.name, run.where) == ("MEETINGS", curve)


@pytest.mark.parametrize("by", [1, -1], ids=["one more", "one fewer"])
def test_a_plane_met_once_more_and_its_neighbour_once_less_is_another_structure(
    by: int, shipped: Shipped
) -> None:
    """Each curve that meets as many planes in the same senses, but not the same ones, is doubted.

    Curves of which segments lie in planes, as those of flats do, are cut in a way of their own.
    """
    pytest.importorskip("numba")
    from assoc_hull.model.program.compiled_program import CompiledProgram

    found = program_of(shipped("bulk_carrier"))
    assert found is not None
    program, before, tried = found.program, found.values, 0
    cell, owner = program.cell.copy(), np.repeat(
        np.arange(program.curves), np.diff(program.set_start)
    )  # fmt: skip
    view = cell.view()
    view.setflags(write=False)
    runner, values = CompiledProgram(attrs.evolve(program, cell=view)), before.copy()
    for q, (cells, each) in enumerate(zip(program.cell_start, program.sets, strict=True)):
        planes = int(program.first[each + 1] - program.first[each])
        counts = np.diff(cell[cells : cells + planes + 1])
        giving = counts[1:] if by > 0 else counts[:-1]
        for between in np.flatnonzero(giving)[:2].tolist():
            cell[cells + between + 1] += by
            run = runner.run(values, before, NONE, NONE, owner[q : q + 1])
            assert (run.doubt.name, run.where) == ("MEETINGS", owner[q]), (q, between)
            cell[cells + between + 1] -= by
            tried += 1
    assert tried > 100
    run = runner.run(values, before, NONE, NONE, np.arange(program.curves))
    assert run.kept


def test_numbers_that_are_read_tell_of_folds_and_of_the_centre_plane(shipped: Shipped) -> None:
    """A curve that turns back on itself, or lies beyond, does so before any edit."""
    state = copy_state(shipped("series60_70").state)
    curve = int(state.live("curves")[7])
    spline = state.spline(curve)
    xyz = spline.xyz - np.array([0.0, 1.0 + spline.xyz[:, 1].max(), 0.0])
    turned = SplineBatch(spline.start, spline.knot, xyz, -spline.leave, -spline.arrive)
    state.curves.spline.store[curve] = turned
    found = program_of(ah.Hull(state))
    assert found is not None
    here = found.program.local[curve]
    assert found.values.folds[here] == len(xyz)
    assert found.values.lowest[here] == xyz[:, 1].min() < -1.0
    assert np.flatnonzero(found.values.folds).tolist() == [here]


def runner_in(arithmetic: str, program: Program) -> RunProgram:
    """What runs a program in one of the two arithmetics."""
    if arithmetic == "numpy":
        return NumpyProgram(program)
    pytest.importorskip("numba")
    from assoc_hull.model.program.compiled_program import CompiledProgram

    return CompiledProgram(program)


@pytest.mark.parametrize("arithmetic", ["numpy", "compiled"])
def test_what_a_run_has_written_is_put_back_and_nothing_else(
    arithmetic: str, shipped: Shipped
) -> None:
    """Beside it may lie numbers that somebody else has written: they stay."""
    found = program_of(shipped("bulk_carrier"))
    assert found is not None
    program, before = found.program, found.values
    values, wanted = before.copy(), before.copy()
    for name in NUMBERS:
        getattr(values, name)[:] += 1
        getattr(wanted, name)[:] += 1
    rows, curves = np.unique(program.row)[5::7], np.arange(3, program.curves, 4)
    watched = np.arange(1, len(program.watch), 2)
    for items in (rows, program.watch[watched]):
        wanted.xyz[items] = before.xyz[items]
    wanted.gap[watched] = before.gap[watched]
    for c in curves.tolist():
        knots, met = (slice(*each[c : c + 2]) for each in (program.start, program.meet_start))
        wanted.knot[knots] = before.knot[knots]
        block = slice(9 * knots.start, 9 * knots.stop)
        wanted.block[block] = before.block[block]
        for name in ("at", "place", "segment"):
            getattr(wanted, name)[met] = getattr(before, name)[met]
        wanted.folds[c], wanted.lowest[c] = before.folds[c], before.lowest[c]
    assert len(watched) > 0
    run = ProgramRun(Doubt.NONE, -1, curves, rows, watched)
    runner_in(arithmetic, program).restore(values, before, run)
    same_numbers(values, wanted)


@pytest.mark.parametrize("arithmetic", ["numpy", "compiled"])
@pytest.mark.parametrize("side", [0, 1])
def test_the_first_point_of_all_is_an_anchor_as_any_other(
    arithmetic: str, side: int, shipped: Shipped
) -> None:
    """What rides with it alone goes where it goes."""
    found = program_of(shipped("series60_70"))
    assert found is not None
    program, before = found.program, found.values.copy()
    row = int(np.flatnonzero((program.anchor >= 0).any(axis=1))[0])
    anchor, weight, start = program.anchor.copy(), program.weight.copy(), program.rider_start.copy()
    anchor[row], weight[row] = (-1, -1), side
    anchor[row, side] = 0
    start[1:] += 1
    rider = np.concatenate([[row], program.rider])
    before.base[row], before.anchor_from[row, side] = before.xyz[row], before.xyz[0]
    arrays: dict[str, Any] = {
        "anchor": anchor, "weight": weight, "rider_start": start, "rider": rider,
    }  # fmt: skip
    for each in arrays.values():
        each.setflags(write=False)
    values, away = before.copy(), np.array([[0.0, 1e-6, 0.0]])
    moved = write_points(values, np.array([0]), before.xyz[:1] + away)
    run = runner_in(arithmetic, attrs.evolve(program, **arrays)).run(values, before, moved, NONE)
    assert run.kept
    assert row in run.rows.tolist()
    np.testing.assert_allclose(values.xyz[row] - before.xyz[row], away[0], atol=1e-12)


@pytest.mark.parametrize("arithmetic", ["numpy", "compiled"])
def test_latent_meetings_that_come_as_near_as_may_be_are_doubted(
    arithmetic: str, shipped: Shipped
) -> None:
    """They may be one crossing then; a little farther apart nothing is doubted."""
    found = program_of(shipped("bulk_carrier"))
    assert found is not None
    program, before = found.program, found.values
    one, other = program.meet_start[[2, 9]]
    start = np.zeros(program.curves + 1, np.int64)
    start[program.meet_curve[one] + 1 :] += 1
    start[program.meet_curve[other] + 1 :] += 1
    arrays: dict[str, Any] = {
        "pair_a": np.array([one]), "pair_b": np.array([other]), "pair_start": start,
        "paired": np.zeros(2, np.int64),
    }  # fmt: skip
    for each in arrays.values():
        each.setflags(write=False)
    least = float(np.linalg.norm(before.place[one] - before.place[other]))
    assert least > 0.0
    for near, doubt in ((1.001 * least, Doubt.LATENT), (0.999 * least, Doubt.NONE)):
        runner = runner_in(arithmetic, attrs.evolve(program, near=near, **arrays))
        run = runner.run(before.copy(), before, NONE, NONE, np.arange(program.curves))
        assert run.doubt is doubt


@pytest.mark.parametrize("arithmetic", ["numpy", "compiled"])
def test_a_curve_that_is_not_finite_in_any_one_coordinate_is_not_made(
    arithmetic: str, shipped: Shipped
) -> None:
    """As by a curvature at its end that is too large for a number when it meets the chord."""
    found = program_of(shipped("series60_70"))
    assert found is not None
    program, before = found.program, found.values
    curve = int(np.argmax(before.knot[program.start[:-1] + 1]))
    for axis in range(3):
        kind, vector = program.end_kind.copy(), program.end_vector.copy()
        kind[curve, 0] = EndKind.CURVATURE
        vector[curve, 0] = 1.7e308 * np.eye(3)[axis]
        for each in (kind, vector):
            each.setflags(write=False)
        runner = runner_in(arithmetic, attrs.evolve(program, end_kind=kind, end_vector=vector))
        with np.errstate(all="ignore"):
            run = runner.run(before.copy(), before, NONE, NONE, np.array([curve]))
        assert (run.doubt, run.where) == (Doubt.NOT_MADE, curve), axis


def test_a_run_counts_the_folds_that_the_order_along_a_curve_tells() -> None:
    """None and several, at ends, at smooth points and at both sides of knuckles."""
    pytest.importorskip("numba")
    from assoc_hull.model.program.compiled_program import _folds

    compiled: Callable[..., int] = _folds.py_func  # type: ignore[attr-defined]
    rng, counts = np.random.default_rng(3), set[int]()
    for number in range(200):
        size, rough = int(rng.integers(2, 9)), 10.0 ** rng.uniform(-1.0, 0.5)
        steps, leave = np.array([1.0, 0.0, 0.0]) + rough * rng.normal(size=(2, size, 3))
        arrive = np.where(rng.random((size, 1)) < 0.3, leave + rough * rng.normal(size=3), leave)
        xyz, knot = np.cumsum(steps, axis=0), np.arange(float(size))
        batch = SplineBatch(np.array([0, size]), knot, xyz, leave, arrive)
        folds = compiled(np.concatenate([xyz.T, leave.T, arrive.T]), size)
        assert folds == len(curve_folds(batch)), number
        counts.add(folds)
    assert counts >= {0, 1, 2, 3}


def test_nil_has_a_sign_for_both_arithmetics() -> None:
    """A bit that differs passes a change on, whatever the numbers are worth."""
    pytest.importorskip("numba")
    from assoc_hull.model.program.compiled_program import _differs

    compiled: Callable[..., bool] = _differs.py_func  # type: ignore[attr-defined]
    cases = [0.0, -0.0, 1.0, np.nextafter(1.0, 2.0), -1.0]
    for one, other in itertools.product(cases, cases):
        told = differs(np.array([[one]]), np.array([[other]]))[0]
        assert compiled(one, other) == told, (one, other)


def test_the_first_meeting_of_all_gives_a_point_as_any_other(shipped: Shipped) -> None:
    """Here those before it, which give none, are left out of the tables."""
    state = copy_state(shipped("series60_70").state)
    program = compile_program(state, build_index(state))
    assert program is not None
    mine = np.sort(program.drive[: program.drive_start[1]])
    curve, first = int(program.number[0]), int(mine[0])
    met = state.curves.meets[curve]
    state.curves.meets.store[curve] = met.take(np.arange(first, len(met.line)))
    found = compile_program(state, build_index(state))
    assert found is not None
    assert np.sort(found.drive[: found.drive_start[1]]).tolist() == (mine - first).tolist()
