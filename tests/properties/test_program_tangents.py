"""Derivatives of the program of a net: what differences of its runs must be."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from assoc_hull.edit.published_program import published_program
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.program.run_program import ProgramRun, run_program, write_points
from assoc_hull.model.program.structure import Program, PublishedProgram, Values
from assoc_hull.model.program.tangents import ValueTangents, jacobian, tangents
from tests.conftest import Shipped
from tests.long_forms import draws
from tests.net_strategies import POOL, SHAPES, STRUCTURE, Task, carry_out, fresh, tasks

tasks_of_all_kinds = tasks(SHAPES + STRUCTURE)

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
    curves = np.arange(program.curves) if program.unsure.any() else None
    many, runs = [before.copy() for _ in sizes], list[ProgramRun]()
    for values, size in zip(many, sizes.tolist(), strict=True):
        moved = write_points(values, rows, before.xyz[rows] + size * move)
        runs.append(run_program(program, values, before, moved, held, curves))
    if {run.doubt.name for run in runs} & {"UNSURE", "NOT_MADE", "MEETINGS"}:
        return None
    quotients = {}
    for name in VARYING:
        numbers = [getattr(values, name) for values in many]
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


@settings(max_examples=draws(60))
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
