"""Runs of the program of a net for many variants, and its derivatives, beside single runs.

A single run is the judge of both: variants have its bits and its doubts, and its differences are
what derivatives must be.
"""

from __future__ import annotations

import attrs
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from assoc_hull.edit.published_program import published_program
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.program.run_many import ManyPrograms, many_values, run_many, write_many
from assoc_hull.model.program.run_program import ProgramRun, run_program, write_points
from assoc_hull.model.program.structure import Program, PublishedProgram, Values
from assoc_hull.model.program.tangents import ValueTangents, jacobian, tangents
from tests.conftest import Shipped
from tests.net_strategies import POOL, SHAPES, STRUCTURE, Task, carry_out, fresh, tasks

NUMBERS = tuple(each.name for each in attrs.fields(Values))
NONE = np.zeros(0, np.int64)

tasks_of_all_kinds = tasks(SHAPES + STRUCTURE)


@attrs.frozen
class Variant:
    """What is written to a variant: which points, where they go, and which riders stay there."""

    rows: IntArray
    places: FloatArray
    held: IntArray


def random_variant(found: PublishedProgram, rng: np.random.Generator) -> Variant:
    """A few points moved by a tenth of a millimetre to a metre, some of them onto others."""
    program, xyz = found.program, found.values.xyz
    rows = np.unique(rng.choice(program.row, rng.integers(0, 4)))
    away = rng.normal(0.0, 10.0 ** rng.uniform(-4.0, 0.0), (len(rows), 3))
    places = xyz[rows] + away * rng.integers(0, 2, 3)
    if len(rows) and rng.random() < 0.1:
        here = int(np.flatnonzero(program.row == rows[0])[0])
        places[0] = xyz[program.row[here - 1 if here else 1]]
    return Variant(rows, places, rows[rng.random(len(rows)) < 0.3])


def same_run(one: ProgramRun, other: ProgramRun) -> None:
    """Fail unless two runs tell the same."""
    assert (one.doubt, one.where) == (other.doubt, other.where)
    for part in ("curves", "rows", "watched"):
        assert getattr(one, part).tolist() == getattr(other, part).tolist(), part


def assert_many_are_single_runs(
    found: PublishedProgram, variants: list[Variant], together: int, curves: IntArray | None = None
) -> set[str]:
    """Variants side by side and one by one: numbers to the bit, and all that is told."""
    program, before = found.program, found.values
    many, doubts = many_values(before, len(variants)), set[str]()
    single = [before.copy() for _ in variants]
    moved = [
        write_points(values, each.rows, each.places)
        for values, each in zip(single, variants, strict=True)
    ]
    for v, each in enumerate(variants):
        many.xyz[v, each.rows] = single[v].xyz[each.rows]
    held = [each.held for each in variants]
    told = ManyPrograms.of(program, together).run(many, before, moved, held, curves)
    assert len(told) == len(variants)
    for v, values in enumerate(single):
        alone = run_program(program, values, before, moved[v], held[v], curves)
        same_run(told[v], alone)
        doubts.add(alone.doubt.name)
        for name in NUMBERS:
            assert getattr(values, name).tobytes() == getattr(many, name)[v].tobytes(), name
    return doubts


@settings(max_examples=60)
@given(
    number=st.integers(0, POOL - 1), edits=tasks_of_all_kinds, seed=st.integers(0, 2**32 - 1),
    count=st.integers(1, 7), together=st.integers(1, 4), whole=st.booleans(),
)  # fmt: skip
def test_variants_have_the_bits_and_the_doubts_of_single_runs(
    number: int, edits: list[Task], seed: int, count: int, together: int, whole: bool
) -> None:
    """On random nets after random edits, a last tile that is not full among them."""
    hull, rng = fresh(number), np.random.default_rng(seed)
    for each in edits:
        carry_out(hull, each)
    found = published_program(hull.document)
    if found is None:
        return
    variants = [random_variant(found, rng) for _ in range(count)]
    curves = np.arange(found.program.curves) if whole else None
    assert_many_are_single_runs(found, variants, together, curves)


@pytest.mark.parametrize("name", ["series60_70", "bulk_carrier", "container_ship_225m"])
def test_variants_of_ships_have_the_bits_and_the_doubts_of_single_runs(
    name: str, shipped: Shipped
) -> None:
    """Forty variants in tiles of twelve; most kinds of doubts occur."""
    found = published_program(shipped(name).document)
    assert found is not None
    rng = np.random.default_rng(5)
    variants = [random_variant(found, rng) for _ in range(40)]
    doubts = assert_many_are_single_runs(found, variants, 12)
    # Definitions give the points of the container ship: most of its curves are unsure.
    assert len(doubts) >= (3 if name == "container_ship_225m" else 4), doubts


def test_every_doubt_is_told_of_its_own_variant(shipped: Shipped) -> None:
    """A net that keeps its structure stands between two that do not, for each kind of doubt."""
    found = published_program(shipped("bulk_carrier").document)
    assert found is not None
    rng, by_doubt = np.random.default_rng(8), dict[str, Variant]()
    for _ in range(300):
        each = random_variant(found, rng)
        values = found.values.copy()
        moved = write_points(values, each.rows, each.places)
        run = run_program(found.program, values, found.values, moved, each.held)
        by_doubt.setdefault(run.doubt.name, each)
    kept = by_doubt.pop("NONE")
    assert len(by_doubt) >= 5, by_doubt.keys()
    mixed = [part for each in by_doubt.values() for part in (each, kept)]
    assert_many_are_single_runs(found, mixed, len(mixed))
    assert_many_are_single_runs(found, mixed[::-1], 5)
    # Two that are in doubt of the same, at the same level, stop each by itself.
    assert_many_are_single_runs(found, mixed + mixed, 2 * len(mixed))


def test_what_was_so_before_is_doubted_of_no_variant(shipped: Shipped) -> None:
    """A curve beyond the centre plane, or one that folds, was it before: the doubt is of others."""
    found = published_program(shipped("series60_70").document)
    assert found is not None
    program = attrs.evolve(found.program, limit=np.full_like(found.program.limit, np.inf))
    before = attrs.evolve(found.values, folds=np.full_like(found.values.folds, 99))
    near = np.unique(program.row[(before.xyz[program.row, 1] > 0.0)])
    beyond = dict[int, Variant]()
    for row in near[np.argsort(before.xyz[near, 1])][:200].tolist():
        place = before.xyz[[row]] - (0.0, before.xyz[row, 1] + 0.01, 0.0)
        values = before.copy()
        run = run_program(
            program, values, before, write_points(values, np.array([row]), place), NONE
        )
        if run.doubt.name == "BEYOND":
            beyond[run.where] = Variant(np.array([row]), place, NONE)
    assert len(beyond) >= 2
    variants = [*beyond.values()][:6]
    for curve in [*beyond][:2]:
        so = before.lowest.copy()
        so[curve] = -1e3
        known = attrs.evolve(before, lowest=so)
        assert_many_are_single_runs(PublishedProgram(program, known), variants, len(variants))
        each, values = beyond[curve], before.copy()
        moved = write_points(values, each.rows, each.places)
        run = run_program(program, values, known, moved, NONE)
        assert (run.doubt.name, run.where) != ("BEYOND", curve)
    folds = found.values.folds.copy()
    folds[3] = -1
    fewer = attrs.evolve(before, folds=folds)
    still = [Variant(NONE, np.zeros((0, 3)), NONE)] * 4
    every = np.arange(program.curves)
    told = assert_many_are_single_runs(PublishedProgram(program, fewer), still, 4, every)
    assert told == {"FOLD"}
    assert run_program(program, before.copy(), fewer, NONE, NONE, every).where == 3


def test_the_same_points_are_written_to_all_variants(shipped: Shipped) -> None:
    """`write_many` and `run_many` say of each variant what its own call says; others stay."""
    found = published_program(shipped("series60_70").document)
    assert found is not None
    rows = np.unique(found.program.row[::400])
    places = np.repeat(found.values.xyz[rows][None], 3, axis=0)
    places[1, 0, 1] += 1e-3
    places[2, :, 1] += 1e-4
    many = many_values(found.values, 3)
    moved = write_many(many, rows, places)
    assert [each.tolist() for each in moved] == [[], rows[:1].tolist(), rows.tolist()]
    told = run_many(found.program, many, found.values, moved, [NONE] * 3)
    assert not len(told[0].curves)
    for name in NUMBERS:
        assert getattr(many, name)[0].tobytes() == getattr(found.values, name).tobytes(), name
    for v in (1, 2):
        values = found.values.copy()
        same_run(
            told[v],
            run_program(
                found.program, values, found.values, write_points(values, rows, places[v]), NONE
            ),
        )


VARYING = ("xyz", "knot", "block", "at", "place")
STEP = 1e-3
"""The largest step of a difference, m: points lie farther apart, and 1e-14 m are well below it."""


def random_moves(
    program: Program, values: Values, rng: np.random.Generator, count: int
) -> tuple[IntArray, FloatArray]:
    """Moves of a few points in the planes of the curves that are made through them, or drive them.

    A point that leaves such a plane leaves the knot on it, and meetings pass on to a neighbouring
    segment: there is a second derivative no longer, and differences converge slowly.
    """
    driver = np.full(len(values.xyz), -1)
    driver[program.meet_row[program.drive]] = program.meet_curve[program.drive]
    seeds = np.flatnonzero((program.reader >= 0).any(axis=1))
    if program.unsure.any():  # curves are made anew then, and so are all points that these give
        seeds = seeds[driver[seeds] < 0]
    rows = np.sort(rng.choice(seeds, min(len(seeds), int(rng.integers(1, 6))), replace=False))
    moves = rng.normal(size=(count, len(rows), 3)) * rng.integers(0, 2, (count, len(rows), 1))
    for curve in (*program.reader[rows].T, driver[rows]):
        axis = np.where(curve >= 0, program.own_axis[curve], -1)
        flat = np.flatnonzero(axis >= 0)
        moves[:, flat, axis[flat]] = 0.0
    return rows, moves


def differences(
    found: PublishedProgram, rows: IntArray, move: FloatArray, held: IntArray
) -> tuple[dict[str, FloatArray], IntArray] | None:
    """Central differences of runs, extrapolated twice, and the curves that were made anew.

    None where a run says that the structure is another.
    """
    program, before = found.program, found.values
    sizes = np.array([STEP, -STEP, STEP / 2, -STEP / 2, STEP / 4, -STEP / 4])
    many = many_values(before, len(sizes))
    moved = write_many(many, rows, before.xyz[rows] + sizes[:, None, None] * move)
    curves = np.arange(program.curves) if program.unsure.any() else None
    runs = run_many(program, many, before, moved, [held] * len(sizes), curves)
    if {run.doubt.name for run in runs} & {"UNSURE", "NOT_MADE", "MEETINGS"}:
        return None
    quotients = {}
    for name in VARYING:
        numbers = getattr(many, name)
        one, two, three = (
            (numbers[i] - numbers[i + 1]) / (sizes[i] - sizes[i + 1]) for i in (0, 2, 4)
        )
        first, second = (4.0 * two - one) / 3.0, (4.0 * three - two) / 3.0
        quotients[name] = (16.0 * second - first) / 15.0
    return quotients, runs[0].curves


def assert_derivatives_are_differences(
    found: PublishedProgram, rng: np.random.Generator, count: int = 3
) -> int:
    """Compare derivatives with differences of runs; give how many moves could be compared."""
    program, before = found.program, found.values
    rows, moves = random_moves(program, before, rng, count)
    held = rows[rng.random(len(rows)) < 0.5]
    # A riding point goes where it was put, or where its anchors lead it, as soon as a bit of these
    # changes: which of the two no derivative tells. So it is held, or not moved.
    rides = (program.anchor[rows] >= 0).any(axis=1)
    moves[:, rides & ~np.isin(rows, held)] = 0.0
    told = tangents(program, before, rows, moves, held)
    compared = 0
    for k in range(count):
        judge = differences(found, rows, moves[k], held)
        if judge is None:
            continue
        compared += 1
        for name, wanted in judge[0].items():
            given_ = getattr(told, name)[k]
            # Rounding of the differences: 1e-14 of lengths of 100 m, over half a millimetre.
            limit = 1e-7 * np.abs(wanted) + 2e-9 * max(1.0, np.abs(wanted).max(initial=0.0))
            assert (np.abs(given_ - wanted) <= limit).all(), (name, np.abs(given_ - wanted).max())
        assert_reach(program, told, k)
        if not program.unsure.any():
            assert told.curves[k, judge[1]].all()
    return compared


def assert_reach(program: Program, told: ValueTangents, k: int) -> None:
    """What is told not to be reached by a move has no derivative."""
    still = ~told.curves[k]
    owner = np.repeat(np.arange(program.curves), np.diff(program.start))
    assert not told.knot[k, still[owner]].any()
    assert not told.block[k, np.repeat(still, 9 * np.diff(program.start))].any()
    assert not told.at[k, still[program.meet_curve]].any()


@settings(max_examples=60)
@given(number=st.integers(0, POOL - 1), edits=tasks_of_all_kinds, seed=st.integers(0, 2**32 - 1))
def test_derivatives_are_differences_of_runs(number: int, edits: list[Task], seed: int) -> None:
    """On random nets after random edits: points, knots, curves and meetings."""
    hull = fresh(number)
    for each in edits:
        carry_out(hull, each)
    found = published_program(hull.document)
    assume(found is not None)
    assert found is not None
    assert_derivatives_are_differences(found, np.random.default_rng(seed))


SHIPS = ("series60_60", "series60_70", "bulk_carrier", "bulk_carrier_180m", "container_ship_225m")


@pytest.mark.parametrize("name", SHIPS)
def test_derivatives_are_differences_of_runs_of_ships(name: str, shipped: Shipped) -> None:
    """Most random moves keep the structure, so that these can be compared."""
    found = published_program(shipped(name).document)
    assert found is not None
    rng = np.random.default_rng(12)
    assert sum(assert_derivatives_are_differences(found, rng) for _ in range(5)) >= 10


def test_meetings_stay_in_the_planes_of_their_curves(shipped: Shipped) -> None:
    """Also where a point of the curve is led out of its plane: a run puts its meetings back."""
    found = published_program(shipped("series60_70").document)
    assert found is not None
    program, rows = found.program, np.unique(found.program.row)[::50]
    told = tangents(program, found.values, rows, np.ones((1, len(rows), 3)), rows)
    axis = program.own_axis[program.meet_curve]
    flat = np.flatnonzero(axis >= 0)
    assert told.place[0, flat].any()
    assert not told.place[0, flat, axis[flat]].any()


def test_a_jacobian_has_the_derivatives_by_each_coordinate(shipped: Shipped) -> None:
    """Column by column those of single moves, of a point that rides too; all else is left out."""
    found = published_program(shipped("series60_70").document)
    assert found is not None
    program, values = found.program, found.values
    rows = np.unique(program.row)[::97]
    assert (program.anchor[rows] >= 0).any()
    matrix = jacobian(program, values, rows)
    assert matrix.shape == (len(values.block), 3 * len(rows))
    for column in range(0, 3 * len(rows), 5):
        row, move = rows[column // 3 : column // 3 + 1], np.zeros((1, 1, 3))
        move[0, 0, column % 3] = 1.0
        wanted = tangents(program, values, row, move, row).block[0]
        np.testing.assert_allclose(matrix[:, [column]].toarray()[:, 0], wanted, 1e-9, 1e-12)
    assert matrix.nnz < 0.1 * matrix.shape[0] * matrix.shape[1]
    assert matrix.nnz == np.count_nonzero(matrix.data)
