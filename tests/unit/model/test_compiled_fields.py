"""Normals and displacements of fields, compiled: they are those of numpy, to the bit."""

from collections.abc import Callable
from unittest import mock

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.displacement_field import FieldContext, PullField
from assoc_hull.edit.modifications.pull import pull_field
from assoc_hull.edit.published_program import published_program
from assoc_hull.errors import AssocHullError
from assoc_hull.model.program import engine
from assoc_hull.model.program.structure import Program, Values
from assoc_hull.model.tables import copy_state
from tests.net_strategies import fresh

pytest.importorskip("numba")

HULLS: dict[str, Callable[[], ah.Hull]] = {
    "Series 60": ah.examples.series60,
    "bulk carrier": ah.examples.bulk_carrier_207k,
    "random net": lambda: fresh(3),
    "a net with flats": lambda: fresh(7),
}


@pytest.fixture(autouse=True)
def _compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(engine, "_is_ready", lambda: True)


def numbers_of(hull: ah.Hull) -> tuple[Program, Values]:
    """Give the program of a hull with its numbers."""
    found = published_program(hull.document)
    assert found is not None
    return found.program, found.values


def field(
    hull: ah.Hull, row: int, radius: tuple[float, float], across: bool,
    numbers: tuple[Program, Values] | None,
) -> PullField | str:  # fmt: skip
    """Give the field of a pull, or why there is none."""
    try:
        return pull_field(
            hull.state, row, 0.02, radius, across_flats=across, numbers=numbers
        )  # fmt: skip
    except AssocHullError as error:
        return str(error)


@pytest.mark.parametrize("name", HULLS)
def test_normals_are_those_of_numpy(name: str) -> None:
    """At every point of a hull, and of one that was edited by then."""
    hull = HULLS[name]()
    for _ in range(2):
        state = hull.state
        one, other = FieldContext(state, False), FieldContext(state, False, numbers_of(hull))
        rows = state.live("rows")
        assert other.compiled() is not None
        assert one.normals(rows).tobytes() == other.normals(rows).tobytes()
        free = one.free()
        with hull.edit("pull") as edit:
            edit.pull(state.rows.key[int(free[len(free) // 2])], 1e-3, (20.0, 5.0))


@pytest.mark.parametrize("depth", [1.0, 100.0], ids=["above the depth", "below it"])
def test_normals_that_no_curve_turns_are_turned_away_from_the_deck_as_in_numpy(
    depth: float,
) -> None:
    """Where all lines are boundaries; the deck is at the highest point, or at the depth."""
    state = copy_state(fresh(3).state)
    told = FieldContext(state, False).normals(state.live("rows"))
    state.lines.boundary.store[:] = 0
    state.settings.particulars.store[0] = attrs.evolve(state.particulars, depth=depth)
    hull = ah.Hull(state)
    state, numbers = hull.state, numbers_of(hull)
    rows = state.live("rows")
    assert state.rows.xyz.data[rows, 2].max() > 1.0
    one, other = FieldContext(state, False), FieldContext(state, False, numbers)
    normals = one.normals(rows)
    assert other.compiled() is not None
    assert other.normals(rows).tobytes() == normals.tobytes()
    assert ((normals == -told) & (told != 0.0)).any()


@pytest.mark.parametrize("name", HULLS)
def test_a_pull_is_that_of_numpy(name: str) -> None:
    """Fields at many points, narrow and wide, with flats and without."""
    hull, draw, felt = HULLS[name](), np.random.default_rng(5), 0
    state, numbers = hull.state, numbers_of(hull)
    for row in draw.choice(state.live("rows"), 30).tolist():
        radius = float(draw.uniform(1.0, 40.0)), float(draw.uniform(1.0, 12.0))
        for across in (False, True):
            mine, theirs = (field(hull, row, radius, across, each) for each in (numbers, None))
            if isinstance(mine, str) or isinstance(theirs, str):
                assert mine == theirs
                continue
            assert mine.normal.tobytes() == theirs.normal.tobytes()
            assert mine.flat_fade == theirs.flat_fade
            one = mine.shift(FieldContext(state, across, numbers), 0.5)
            two = theirs.shift(FieldContext(state, across), 0.5)
            for part in ("rows", "delta", "left"):
                assert getattr(one, part).tobytes() == getattr(two, part).tobytes(), part
            felt += len(one.rows)
    assert felt > 100


@pytest.mark.parametrize("compiled", [True, False], ids=["compiled", "numpy"])
def test_points_in_reach_are_found_by_blocks_as_one_by_one(compiled: bool) -> None:
    """On a hull that is edited, tried and taken back in between: the blocks follow."""
    hull, draw, felt = ah.examples.series60(), np.random.default_rng(9), 0
    for turn in range(12):
        state = hull.state
        numbers = numbers_of(hull) if compiled else None
        rows = draw.choice(state.live("rows"), 12).tolist()
        for row in rows:
            radius = float(draw.uniform(1.0, 40.0)), float(draw.uniform(1.0, 12.0))
            shifts = []
            for few in (0, 1000):
                with mock.patch("assoc_hull.edit.displacement_field._FEW_BLOCKS", few):
                    found = field(hull, row, radius, turn % 2 == 0, numbers)
                    if not isinstance(found, str):
                        shifts.append(found.shift(FieldContext(state, turn % 2 == 0, numbers), 0.5))
            for part in ("rows", "delta", "left") if shifts else ():
                assert getattr(shifts[0], part).tobytes() == getattr(shifts[1], part).tobytes()
            felt += len(shifts[0].rows) if shifts else 0
        asked = [{"op": "pull", "point": "WL 1.08 x ST 4", "d": 0.01, "radius": [40.0, 16.0]}]
        hull.preview(asked)
        if turn % 3 == 2:
            hull.undo()
        else:
            with hull.edit("pull") as edit:
                edit.pull("WL 1.08 x ST 4", 4e-3 * (-1) ** turn, (40.0, 16.0))
    assert felt > 100


def test_what_is_not_known_is_left_to_numpy() -> None:
    """A curve whose ends tell nothing of its course, as that of a closed one."""
    hull = ah.examples.wigley()
    state, numbers = hull.state, numbers_of(hull)
    with mock.patch("assoc_hull.edit.displacement_field.SHORT", 1e9):
        ground = FieldContext(state, False, numbers)
        rows = ground.free()
        compiled = ground.compiled()
        assert compiled is not None
        assert compiled.freedoms(state.rows.xyz.data, numbers[1], rows) is None
        assert ground.normals(rows).tobytes() == FieldContext(state, False).normals(rows).tobytes()


def test_nothing_is_compiled_for_what_an_edit_asks() -> None:
    """The arrays of an edit are of the kinds for which all was compiled beforehand."""
    from assoc_hull.model.program import compiled_fields as made

    hull = ah.examples.wigley()
    made.warm()
    with mock.patch("assoc_hull.edit.program_edit.ProgramEdit.of") as of:
        from assoc_hull.edit.program_edit import ProgramEdit

        of.side_effect = ProgramEdit.begun
        for _ in range(3):
            with hull.edit("pull") as edit:
                edit.pull("WL 2.5 x ST 7", 1e-3, (20.0, 5.0))
    found = [
        getattr(each, "signatures", ()) for each in (made.find_freedoms, made.pull, made.distance)
    ]
    assert [len(each) for each in found] == [1, 1, 1]
