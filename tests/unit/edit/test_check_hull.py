"""A check names every defect that is planted, and finds none in a sound hull."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import ArrayLike

from assoc_hull.edit.check_hull import Finding, check
from assoc_hull.edit.document import Document
from assoc_hull.edit.transaction import Transaction
from assoc_hull.examples.wigley import wigley
from assoc_hull.graph.journal import Journal
from assoc_hull.model.address import resolve
from assoc_hull.model.family import Role, Sort, State
from assoc_hull.model.make import Maker, PointSpec
from assoc_hull.model.state import Association, HullState

POINT = "WL 2.5 x ST 7"


@pytest.fixture
def state() -> HullState:
    """A hull of its own, to be spoilt."""
    return wigley()


def row_of(state: HullState, address: str = POINT) -> int:
    """The row of a point."""
    return resolve(state, address).row


def curve_of(state: HullState, name: str = "WL 2.5") -> int:
    """The first curve of a line."""
    return resolve(state, f"{name} [1]").curve


def put(state: HullState, table: str, column: str, row: int, value: ArrayLike) -> None:
    """Write one cell past all rules."""
    Journal().put(getattr(getattr(state, table), column), [row], np.asarray(value)[None])


def fail(state: HullState) -> None:
    """A curve that could not be lofted."""
    put(state, "curves", "state", curve_of(state), State.FAILED)


def block(state: HullState) -> None:
    """A point made from it."""
    put(state, "rows", "state", row_of(state), State.BLOCKED)


def widen(state: HullState) -> None:
    """A watched crossing whose limit is less than its gap."""
    row = row_of(state)
    Maker(state, Journal()).roles(np.array([row]), np.array([Role.WATCHED]))
    for curve in state.rows.curve.data[row].tolist():
        rows = state.curves.rows.data[curve]
        Maker(state, Journal()).define(curve, rows[rows != row])
    spot = state.rows.spot.data[row].copy()
    spot[0, 1] += 0.02
    put(state, "rows", "spot", row, spot)
    put(state, "rows", "limit", row, 0.01)


def spoil_number(state: HullState) -> None:
    """A point without a finite place."""
    put(state, "rows", "xyz", row_of(state), (35.0, np.nan, 2.5))


def lift(state: HullState) -> None:
    """A point out of its plane, off its curves."""
    xyz = state.rows.xyz.data[row_of(state)] + np.array([0.0, 0.0, 1e-6])
    put(state, "rows", "xyz", row_of(state), xyz)


def slide(state: HullState) -> None:
    """A point in its planes, off its curves."""
    xyz = state.rows.xyz.data[row_of(state)] + np.array([0.0, 1e-6, 0.0])
    put(state, "rows", "xyz", row_of(state), xyz)


def double(state: HullState) -> None:
    """Two points of one curve at one place."""
    curve, maker = curve_of(state), Maker(state, Journal())
    rows = state.curves.rows.data[curve]
    xyz = state.rows.xyz.data[rows[3]] + np.array([1e-8, 0.0, 0.0])
    point = maker.points([PointSpec(curve, xyz, Sort.PLACED)])[0]
    maker.define(curve, np.insert(rows, 4, point))


def unlink(state: HullState) -> None:
    """A shared crossing that only one of its curves reads."""
    reader = state.rows.reader.data[row_of(state)].copy()
    reader[0] = -1
    put(state, "rows", "reader", row_of(state), reader)


def misdrive(state: HullState) -> None:
    """A shared crossing that has a driver."""
    put(state, "rows", "driver", row_of(state), curve_of(state, "ST 7"))


def lose(state: HullState) -> None:
    """A crossing that a curve it defines does not know."""
    curve = curve_of(state)
    rows = state.curves.rows.data[curve]
    Maker(state, Journal()).define(curve, rows[rows != row_of(state)])


def strand(state: HullState) -> None:
    """A point on a curve that has gone."""
    put(state, "curves", "alive", curve_of(state), False)


def disown_curve(state: HullState) -> None:
    """A curve that its line does not list."""
    line = state.line_of(curve_of(state))
    Journal().set(state.lines.curves, [line], [()])


def disown_line(state: HullState) -> None:
    """A line of a group that has gone."""
    put(state, "groups", "alive", resolve(state, "waterlines").group, False)


def untwin(state: HullState) -> None:
    """A crossing that one of its curves does not list among its meetings."""
    from assoc_hull.edit.topology import unmeet

    unmeet(Maker(state, Journal()), curve_of(state), row_of(state))


def dissociate(state: HullState) -> None:
    """Crossings of groups that are not associated."""
    kept = tuple(
        each for each in state.associations if {each.a, each.b} != {"sections", "waterlines"}
    )
    Journal().set(state.settings.associations, [0], [kept])


def turn_one_way(state: HullState) -> None:
    """Shared crossings under a one-way association."""
    Maker(state, Journal()).associate(Association("sections", "waterlines", two_way=False))


def close_ring(state: HullState) -> None:
    """Two crossings by which two curves drive one another."""
    a, b = curve_of(state, "ST 7"), curve_of(state)
    for address, driver, reader in ((POINT, a, b), ("WL 5 x ST 7", b, a)):
        put(state, "rows", "driver", row_of(state, address), driver)
        put(state, "rows", "reader", row_of(state, address), (-1, reader))


DEFECTS: list[tuple[Callable[[HullState], None], str, str]] = [
    (fail, "failed", "WL 2.5"),
    (block, "blocked", POINT),
    (widen, "gap", POINT),
    (spoil_number, "not finite", POINT),
    (lift, "off plane", POINT),
    (slide, "off curve", POINT),
    (double, "close", "WL 2.5"),
    (unlink, "links", POINT),
    (misdrive, "links", POINT),
    (lose, "orphan", POINT),
    (strand, "orphan", "x waterlines:2.500000"),
    (disown_curve, "orphan", "waterlines:2.500000"),
    (disown_line, "orphan", "waterlines:2.500000"),
    (untwin, "twin", POINT),
    (dissociate, "association", POINT),
    (turn_one_way, "association", POINT),
    (close_ring, "ring", "sections:35.000000/1"),
]


@pytest.mark.parametrize(
    ("plant", "kind", "object_"), DEFECTS, ids=[each[0].__name__ for each in DEFECTS]
)
def test_a_planted_defect_is_named(
    state: HullState, plant: Callable[[HullState], None], kind: str, object_: str
) -> None:
    """Kind and object are told, in words too."""
    plant(state)
    found = [each for each in check(state) if each.kind == kind]
    assert any(object_ in each.object for each in found), check(state)
    assert all(each.message and str(each) for each in found)


def test_a_sound_hull_has_no_findings(state: HullState) -> None:
    """Neither when made nor after an edit."""
    document = Document(state)
    assert check(document) == ()
    row = row_of(state)
    with Transaction(document, "move") as edit:
        edit.write(np.array([row]), state.rows.xyz.data[[row]] + [[0.0, 0.01, 0.0]], "move")
    assert check(document) == ()


def test_a_fold_is_named_with_its_place(state: HullState) -> None:
    """A spline whose tangent turns back; sharp knuckles on purpose are none."""
    import attrs

    curve = curve_of(state)
    spline = state.spline(curve)
    leave = spline.leave.copy()
    leave[5] = -leave[5]
    Journal().set(state.curves.spline, [curve], [attrs.evolve(spline, leave=leave)])
    folds = [each for each in check(state) if each.kind == "fold"]
    assert [each.object for each in folds] == ["WL 2.5"]
    assert folds[0].place == pytest.approx(spline.xyz[5])
    assert folds[0].amount is not None
    assert folds[0].amount < 0.0


def test_lengths_are_given_in_metres(state: HullState) -> None:
    """The amount is the number the message tells."""
    widen(state)
    finding = next(each for each in check(state) if each.kind == "gap")
    assert finding.amount is not None
    assert 0.01 < finding.amount < 0.02, "the part of 0.02 m along the normal"
    assert "mm" in finding.message


def test_notes_tell_roles_the_rule_would_not_choose(state: HullState) -> None:
    """A crossing crowded by a placed point is noted, and is no finding."""
    curve, maker = curve_of(state), Maker(state, Journal())
    rows = state.curves.rows.data[curve]
    at = int(np.flatnonzero(rows == row_of(state))[0])
    place = state.spline(curve)
    middle = state.rows.xyz.data[rows[at]] + 0.02 * (place.xyz[at + 1] - place.xyz[at])
    maker.define(
        curve, np.insert(rows, at + 1, maker.points([PointSpec(curve, middle, Sort.PLACED)])[0])
    )
    assert not any(each.kind == "role" for each in check(state))
    notes = [each for each in check(state, notes=True) if each.kind == "role"]
    assert [each.object for each in notes] == [POINT]


def test_findings_come_in_one_order(state: HullState) -> None:
    """Two checks of one hull are equal."""
    turn_one_way(state)
    first: tuple[Finding, ...] = check(state)
    assert first == check(state)
    assert len(first) == 171
