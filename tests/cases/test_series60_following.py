"""What follows an edit of Series 60 CB .70: all that must, where it was asked, with its causes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.hull_normals import hull_normals
from assoc_hull.edit.step import EditReport
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.address import address
from assoc_hull.model.objects import Curve
from tests.cases import places
from tests.independent import relofted, snapshot

SEED = 1
COUNT = 12
Kind = Callable[[ah.Hull], places.Act]
FIELDS: dict[str, Kind] = {
    "a pull": lambda hull: places.pull(hull, 0.05),
    "a re-shape of a waterline": lambda hull: places.reshape(hull, "waterlines", 0.05),
    "a re-shape of a buttock": lambda hull: places.reshape(hull, "buttocks", 0.05),
    "a re-shape of a section": lambda hull: places.reshape(hull, "sections", 0.05),
}
DRAGS: dict[str, Kind] = {"a drag": lambda hull: places.drag(hull, 0.02)}
KINDS = {**FIELDS, **DRAGS}
PAIRS = {
    "a pull": places.PAIRS,
    "a drag": places.PAIRS,
    "a re-shape of a waterline": tuple(pair for pair in places.PAIRS if "waterlines" in pair),
    "a re-shape of a buttock": tuple(pair for pair in places.PAIRS if "buttocks" in pair),
    "a re-shape of a section": tuple(pair for pair in places.PAIRS if "sections" in pair),
}


@contextmanager
def edited(hull: ah.Hull, kind: str, row: int) -> Iterator[EditReport | None]:
    """Carry out an edit at a place, and undo it; None if it was refused."""
    act = KINDS[kind](hull)
    try:
        with hull.edit(kind) as edit:
            act(edit, row)
    except ah.errors.RefusedEditError:
        yield None
        return
    yield edit.report
    hull.undo()


def at(hull: ah.Hull, kind: str, count: int = COUNT) -> list[int]:
    """The places at which a kind of edit is tried."""
    return places.places(hull, PAIRS[kind], count, SEED)


@pytest.mark.parametrize("kind", list(KINDS))
def test_the_relofted_set_is_the_closure_of_the_role_table(series60_70: ah.Hull, kind: str) -> None:
    """By an independent walk over the tables before and after; each curve once."""
    for row in at(series60_70, kind):
        before = snapshot(series60_70)
        with edited(series60_70, kind, row) as report:
            if report is None:
                continue
            wanted = relofted(before, series60_70)
            assert len(set(report.relofted)) == len(report.relofted)
            assert wanted <= set(report.relofted)
            if not (report.born or report.gone or report.mended):
                assert wanted == set(report.relofted)


@pytest.mark.parametrize("kind", list(KINDS))
def test_why_names_what_moved_each_curve_back_to_the_edit(series60_70: ah.Hull, kind: str) -> None:
    """Causes are points that lie on the curve and moved; the chain ends at one the edit set."""
    hull, state = series60_70, series60_70.document.state
    number = {state.curves.key[curve]: curve for curve in state.live("curves").tolist()}
    for row in at(hull, kind, 6):
        start = state.rows.xyz.data.copy()
        with edited(hull, kind, row) as report:
            if report is None or report.born or report.gone or report.mended:
                continue
            for key in report.relofted:
                why = hull.why(Curve.of(state, number[key]))
                own = {state.rows.key[r] for r in state.curves.rows[number[key]].tolist()}
                assert why.edit == kind
                assert why.causes
                assert {cause.object for cause in why.causes} <= own & _moved(hull, start)
                assert all(cause.moved is None or cause.moved > 0.0 for cause in why.causes)
                assert why.chain()[-1] in _moved(hull, start)


def _moved(hull: ah.Hull, start: FloatArray) -> set[str]:
    rows = hull.state.rows
    differs = (rows.xyz[: len(start)] != start).any(axis=1)
    return {rows.key[row] for row in np.flatnonzero(differs).tolist()}


def _free_shared(hull: ah.Hull) -> IntArray:
    """Shared crossings on no flat."""
    return np.concatenate([places.shared_rows(hull, pair) for pair in places.PAIRS])


def _taken(hull: ah.Hull, report: EditReport, rows: IntArray) -> IntArray:
    """Points but for those that the edit says it left alone."""
    told = [row for row in rows.tolist() if _left(hull, report, row)]
    return np.setdiff1d(rows, np.array(told, np.int64))


def _left(hull: ah.Hull, report: EditReport, row: int) -> bool:
    name = address(hull.state, row)
    return any(note.startswith(f"{name}: left alone") for note in report.notes)


def test_every_line_with_a_shared_crossing_in_reach_of_a_pull_has_moved(
    series60_70: ah.Hull,
) -> None:
    """Both lines of each such crossing, and the crossing by what the field says there."""
    hull, state = series60_70, series60_70.document.state
    for row in at(hull, "a pull"):
        start, place = state.rows.xyz.data.copy(), state.rows.xyz[row].copy()
        free, bits = _free_shared(hull), snapshot(hull).curves
        with edited(hull, "a pull", row) as report:
            if report is None:
                continue
            free = _taken(hull, report, free)
            step = start[free] - place
            girth = np.hypot(step[:, 1], step[:, 2])
            reach = free[(np.abs(step[:, 0]) < 19.0) & (girth < 7.0)]
            after = snapshot(hull).curves
            assert len(reach) > 3
            for each in reach.tolist():
                assert (state.rows.xyz[each] != start[each]).any()
                for curve in state.rows.curve[each].tolist():
                    key = state.curves.key[curve]
                    assert bits[key] != after[key]


@pytest.mark.parametrize("kind", list(FIELDS)[1:])
def test_every_line_with_a_shared_crossing_on_a_reshaped_stretch_has_moved(
    series60_70: ah.Hull, kind: str
) -> None:
    """Each partner takes the new place of the crossing, where the curve was asked to change."""
    hull, state = series60_70, series60_70.document.state
    name = next(name for name in ("waterlines", "buttocks", "sections") if name[:-1] in kind)
    axis, reach = (2, 3.0) if name == "sections" else (0, 15.0)
    for row in at(hull, kind):
        start, bits = state.rows.xyz.data.copy(), snapshot(hull).curves
        free = _free_shared(hull)
        curve = next(int(c) for c in state.rows.curve[row] if places.family(hull, int(c)) == name)
        with edited(hull, kind, row) as report:
            if report is None:
                continue
            free = np.intersect1d(_taken(hull, report, free), state.curves.rows[curve])
            free = free[np.abs(start[free, axis] - start[row, axis]) < reach]
            after = snapshot(hull).curves
            assert row in free
            for each in free.tolist():
                for partner in state.rows.curve[each].tolist():
                    key = state.curves.key[partner]
                    assert bits[key] != after[key]


@pytest.mark.parametrize("amount", [0.005, 0.02])
def test_every_drag_puts_its_point_where_it_was_asked(series60_70: ah.Hull, amount: float) -> None:
    """To 1e-9 m, at all 24 places."""
    hull, table = series60_70, series60_70.document.state.rows
    for row in places.places(hull, places.PAIRS, 24, SEED):
        target = table.xyz[row] + amount * places.normal_step(hull, row)
        try:
            with hull.edit("drag") as edit:
                places.drag(hull, amount)(edit, row)
        except ah.errors.RefusedEditError:
            continue
        assert np.abs(table.xyz[row] - target).max() < 1e-9
        hull.undo()


@pytest.mark.parametrize("amount", [0.02, 0.05])
def test_every_pull_gives_its_normal_displacement(series60_70: ah.Hull, amount: float) -> None:
    """Along the outward normal at the pulled point, within 1 %, at all 24 places."""
    hull, table = series60_70, series60_70.document.state.rows
    normal = hull_normals(hull.state)
    for row in places.places(hull, places.PAIRS, 24, SEED):
        start = table.xyz[row].copy()
        try:
            with hull.edit("pull") as edit:
                places.pull(hull, amount)(edit, row)
        except ah.errors.RefusedEditError:
            continue
        moved = float((table.xyz[row] - start) @ normal[row])
        hull.undo()
        assert moved == pytest.approx(amount, rel=0.01)


def test_the_places_include_the_ends_of_the_ship_and_the_bilge(series60_70: ah.Hull) -> None:
    """Of each pair of families that has shared crossings there."""
    hull = series60_70
    drawn = places.places(hull, places.PAIRS, 24, SEED)
    for pair in places.PAIRS:
        mine = np.intersect1d(places.shared_rows(hull, pair), drawn)
        for there in (places.at_ends, places.at_bilge):
            some = there(hull, places.shared_rows(hull, pair))
            assert there(hull, mine).any() == some.any()
