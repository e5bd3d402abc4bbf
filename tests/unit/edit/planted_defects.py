"""Defects, each planted into the tables of a hull past all rules: what a check must name.

Each function spoils a Wigley hull in one way. They write the tables as a file changed by other
hands would hold them; no edit alone can do any of this.
"""

from __future__ import annotations

import functools
from collections.abc import Callable

import attrs
import numpy as np
import pytest
from numpy.typing import ArrayLike

from assoc_hull.edit.crossings.settle_crossings import make_latent
from assoc_hull.edit.document import Document
from assoc_hull.edit.session import Edit
from assoc_hull.graph.journal import Journal
from assoc_hull.model.address import resolve_address
from assoc_hull.model.change import shape_curves
from assoc_hull.model.definition.records import definition, published
from assoc_hull.model.definition.restore import from_definition
from assoc_hull.model.kinds import Role, Sort, State
from assoc_hull.model.make_objects import Maker, PointSpec
from assoc_hull.model.tables import Association, HullState, Ruling
from assoc_hull.shipped.wigley import wigley

__all__ = ["DEFECTS", "POINT", "Defect", "every_defect", "planted", "sound"]

POINT = "WL 2.5 x ST 7"
FAR = 10_000
"""A number that no table has."""


def row_of(state: HullState, address: str = POINT) -> int:
    """The row of a point."""
    return resolve_address(state, address).row


def curve_of(state: HullState, name: str = "WL 2.5") -> int:
    """The first curve of a line."""
    return resolve_address(state, f"{name} [1]").curve


def line_of(state: HullState, name: str = "WL 2.5") -> int:
    """A line."""
    return resolve_address(state, name).line


def put(state: HullState, table: str, column: str, row: int, value: ArrayLike) -> None:
    """Write one cell of numbers past all rules."""
    Journal().put(getattr(getattr(state, table), column), [row], np.asarray(value)[None])


def put_object(state: HullState, table: str, column: str, row: int, value: object) -> None:
    """Write one cell of anything else past all rules."""
    Journal().set(getattr(getattr(state, table), column), [row], [value])


def fail(state: HullState) -> None:
    """A curve that could not be lofted."""
    curve = curve_of(state)
    put(state, "curves", "state", curve, State.FAILED)
    put_object(state, "settings", "failed", 0, (curve,))


def block(state: HullState) -> None:
    """A point made from one that failed."""
    put(state, "rows", "state", row_of(state), State.BLOCKED)


def lose_spline(state: HullState) -> None:
    """A curve without a spline."""
    put_object(state, "curves", "spline", curve_of(state), None)


def spoil_spline(state: HullState) -> None:
    """A curve whose spline holds a number that is not finite."""
    curve = curve_of(state)
    spline = state.spline(curve)
    leave = spline.leave.copy()
    leave[3, 1] = np.inf
    put_object(state, "curves", "spline", curve, attrs.evolve(spline, leave=leave))


def fold(state: HullState) -> None:
    """A spline whose tangent turns back."""
    curve = curve_of(state)
    spline = state.spline(curve)
    leave = spline.leave.copy()
    leave[5] = -leave[5]
    put_object(state, "curves", "spline", curve, attrs.evolve(spline, leave=leave))


def loop(state: HullState) -> None:
    """A segment whose tangents are five times its chord: it crosses itself, and folds nowhere."""
    curve = curve_of(state)
    spline = state.spline(curve)
    chord = (spline.xyz[6] - spline.xyz[5]) / (spline.knot[6] - spline.knot[5])
    out = np.array([-chord[1], chord[0], 0.0])
    leave, arrive = spline.leave.copy(), spline.arrive.copy()
    leave[5], arrive[6] = 5.0 * (chord + out), 5.0 * (chord - out)
    shape = attrs.evolve(spline, leave=leave, arrive=arrive)
    put_object(state, "curves", "spline", curve, shape)


def fold_through(state: HullState) -> None:
    """A curve through a point that lies far beyond the next ones: its tangent turns back."""
    curve = curve_of(state)
    row, beyond = state.curves.rows[curve][[4, 6]].tolist()
    put(state, "rows", "xyz", row, state.rows.xyz[beyond] + [-1.0, 0.0, 0.0])
    shape_curves(state, state.rows.curve[row], {})


def widen(state: HullState) -> None:
    """A watched crossing whose limit is half its gap, after one of its curves was moved."""
    document = Document(state)
    with Edit(document, "watch") as edit:
        edit.set_role(POINT, "watched")
    with Edit(document, "fill out") as edit:
        x, y, _ = state.rows.xyz[row_of(state, "WL 2.5 @ adopted 1")].tolist()
        edit.move("WL 2.5 @ adopted 1", x=x, y=y + 0.005, lead=False)
    put(state, "rows", "limit", row_of(state), 0.5 * state.rows.gap[row_of(state)])


def spoil_number(state: HullState) -> None:
    """A point without a finite place."""
    put(state, "rows", "xyz", row_of(state), (35.0, np.nan, 2.5))


def lift(state: HullState) -> None:
    """A point out of its plane, off its curves."""
    xyz = state.rows.xyz[row_of(state)] + np.array([0.0, 0.0, 1e-6])
    put(state, "rows", "xyz", row_of(state), xyz)


def slide(state: HullState) -> None:
    """A point in its planes, off its curves."""
    xyz = state.rows.xyz[row_of(state)] + np.array([0.0, 1e-6, 0.0])
    put(state, "rows", "xyz", row_of(state), xyz)


def double(state: HullState) -> None:
    """Two points of one curve at one place."""
    curve, maker = curve_of(state), Maker(state, Journal())
    rows = state.curves.rows[curve]
    xyz = state.rows.xyz[rows[3]] + np.array([1e-8, 0.0, 0.0])
    point = maker.points([PointSpec(curve, xyz, Sort.PLACED)])[0]
    maker.define(curve, np.insert(rows, 4, point))


def unlink(state: HullState) -> None:
    """A shared crossing that only one of its curves reads."""
    reader = state.rows.reader[row_of(state)].copy()
    reader[0] = -1
    put(state, "rows", "reader", row_of(state), reader)


def misdrive(state: HullState) -> None:
    """A shared crossing that has a driver."""
    put(state, "rows", "driver", row_of(state), curve_of(state, "ST 7"))


def drive_nothing(state: HullState) -> None:
    """A crossing that has a driver and is read by no curve."""
    put(state, "rows", "driver", row_of(state), curve_of(state, "ST 7"))
    put(state, "rows", "reader", row_of(state), (-1, -1))


def lose(state: HullState) -> None:
    """A crossing that a curve it defines does not know."""
    curve = curve_of(state)
    rows = state.curves.rows[curve]
    Maker(state, Journal()).define(curve, rows[rows != row_of(state)])


def unhang(state: HullState) -> None:
    """A point on no curve."""
    put(state, "rows", "curve", row_of(state), (-1, -1))


def bury_point(state: HullState) -> None:
    """Curves made through a point that has gone."""
    put(state, "rows", "alive", row_of(state), False)


def strand(state: HullState) -> None:
    """Points on a curve that has gone."""
    put(state, "curves", "alive", curve_of(state), False)


def unline(state: HullState) -> None:
    """A curve of no line."""
    put(state, "curves", "line", curve_of(state), -1)


def bury_line(state: HullState) -> None:
    """A curve of a line that has gone."""
    put(state, "lines", "alive", line_of(state), False)


def disown_curve(state: HullState) -> None:
    """A curve that its line does not list."""
    put_object(state, "lines", "curves", line_of(state), ())


def disown_line(state: HullState) -> None:
    """Lines of a group that has gone."""
    put(state, "groups", "alive", resolve_address(state, "waterlines").group, False)


def ungroup(state: HullState) -> None:
    """A line of no group."""
    put(state, "lines", "group", line_of(state), -1)


def ride_away(state: HullState) -> None:
    """A point that rides with one that has gone."""
    curve, maker = curve_of(state), Maker(state, Journal())
    rows = state.curves.rows[curve]
    middle = state.rows.xyz[rows[3:5]].mean(axis=0)
    made = maker.points([PointSpec(curve, middle, Sort.ADOPTED) for _ in range(2)])
    maker.define(curve, np.insert(rows, 4, made[0]))
    put(state, "rows", "anchor", int(made[0]), (int(made[1]), -1))
    put(state, "rows", "alive", int(made[1]), False)


def untwin(state: HullState) -> None:
    """A crossing that one of its curves does not list among its meetings."""
    make_latent(Maker(state, Journal()), curve_of(state), row_of(state))


def cut_off(state: HullState) -> None:
    """A crossing that lies on one curve only."""
    put(state, "rows", "curve", row_of(state), (curve_of(state, "ST 7"), -1))


def meet_wrongly(state: HullState) -> None:
    """A curve that lists a crossing of two others among its meetings."""
    curve = curve_of(state, "ST 9")
    meets = state.curves.meets[curve]
    row = meets.row.copy()
    row[np.flatnonzero(row >= 0)[0]] = row_of(state)
    put_object(state, "curves", "meets", curve, attrs.evolve(meets, row=row))


def forget(state: HullState) -> None:
    """A crossing that neither table nor curve knows any more, of groups that are associated."""
    row = row_of(state)
    for curve in state.rows.curve[row].tolist():
        make_latent(Maker(state, Journal()), curve, row)
        rows = state.curves.rows[curve]
        point = PointSpec(curve, state.rows.xyz[row].copy(), Sort.ADOPTED)
        made = Maker(state, Journal()).points([point])[0]
        Maker(state, Journal()).define(curve, np.where(rows == row, made, rows))
    put(state, "rows", "alive", row, False)


def dissociate(state: HullState) -> None:
    """Crossings of groups that are not associated."""
    kept = tuple(
        each for each in state.associations if {each.a, each.b} != {"sections", "waterlines"}
    )
    put_object(state, "settings", "associations", 0, kept)


def turn_one_way(state: HullState) -> None:
    """Shared crossings under a one-way association."""
    Maker(state, Journal()).associate(Association("sections", "waterlines", two_way=False))


def turn_round(state: HullState) -> None:
    """A crossing driven against a one-way association."""
    every = np.array([row_of(state)])
    Maker(state, Journal()).associate(Association("waterlines", "sections", two_way=False))
    Maker(state, Journal()).roles(every, np.array([Role.DRIVES_B]))


def rule_alone(state: HullState) -> None:
    """Waterlines rule within a box, and its crossings were not switched."""
    put_object(state, "settings", "rulings", 0, (Ruling("waterlines", "sections", two_way=False),))


def rule_round(state: HullState) -> None:
    """A crossing that drives the waterline which rules there."""
    rule_alone(state)
    put(state, "rows", "first_role", row_of(state), int(Role.SHARED))
    Maker(state, Journal()).roles(np.array([row_of(state)]), np.array([Role.DRIVES_B]))


def rule_elsewhere(state: HullState) -> None:
    """A crossing that is switched, outside of the box in which waterlines rule."""
    box = Ruling("waterlines", "sections", two_way=False, high=(1.0, None, None))
    put_object(state, "settings", "rulings", 0, (box,))
    put(state, "rows", "first_role", row_of(state), int(Role.SHARED))
    Maker(state, Journal()).roles(np.array([row_of(state)]), np.array([Role.DRIVES_A]))


def associate_nothing(state: HullState) -> None:
    """An association of a group that does not exist."""
    links = (*state.associations, Association("sections", "cant frames"))
    put_object(state, "settings", "associations", 0, links)


def associate_twice(state: HullState) -> None:
    """Two groups associated two-way, and one-way again."""
    links = (*state.associations, Association("waterlines", "sections", two_way=False))
    put_object(state, "settings", "associations", 0, links)


def close_ring(state: HullState) -> None:
    """Two crossings by which two curves drive one another."""
    a, b = curve_of(state, "ST 7"), curve_of(state)
    for address, driver, reader in ((POINT, a, b), ("WL 5 x ST 7", b, a)):
        put(state, "rows", "driver", row_of(state, address), driver)
        put(state, "rows", "reader", row_of(state, address), (-1, reader))


def lead_astray(state: HullState) -> None:
    """A point on a curve whose number no table has."""
    put(state, "rows", "curve", row_of(state), (FAR, FAR))


def list_astray(state: HullState) -> None:
    """A curve through a point whose number no table has."""
    curve = curve_of(state)
    rows = state.curves.rows[curve].copy()
    rows[4] = FAR
    put_object(state, "curves", "rows", curve, rows)


def meet_astray(state: HullState) -> None:
    """A meeting that is a crossing whose number no table has."""
    curve = curve_of(state)
    meets = state.curves.meets[curve]
    row = meets.row.copy()
    row[2] = FAR
    put_object(state, "curves", "meets", curve, attrs.evolve(meets, row=row))


def line_astray(state: HullState) -> None:
    """A curve of a line whose number no table has."""
    put(state, "curves", "line", curve_of(state), FAR)


def group_astray(state: HullState) -> None:
    """A line of a group whose number no table has."""
    put(state, "lines", "group", line_of(state), FAR)


def unknown_role(state: HullState) -> None:
    """A crossing with a role that there is not."""
    put(state, "rows", "role", row_of(state), 9)


def unknown_sort(state: HullState) -> None:
    """A point of a sort that there is not."""
    put(state, "rows", "sort", row_of(state), 9)


def unknown_state(state: HullState) -> None:
    """A curve in a state that there is not."""
    put(state, "curves", "state", curve_of(state), 9)


def unknown_family(state: HullState) -> None:
    """A group of a family that there is not."""
    put_object(state, "groups", "family", resolve_address(state, "waterlines").group, "cant frames")


def share_key(state: HullState) -> None:
    """Two points of one key."""
    key = state.rows.key[row_of(state)]
    put_object(state, "rows", "key", row_of(state, "WL 5 x ST 7"), key)


@attrs.frozen
class Defect:
    """A defect, and by what finding a check names it: its kind, and a part of the object."""

    plant: Callable[[HullState], None]
    kind: str
    object: str


KEY = "waterlines:2.500000"
DEFECTS: dict[str, Defect] = {
    "a failed curve": Defect(fail, "failed", "WL 2.5"),
    "a blocked point": Defect(block, "blocked", POINT),
    "a curve without a spline": Defect(lose_spline, "not finite", "WL 2.5"),
    "a spline that is not finite": Defect(spoil_spline, "not finite", "WL 2.5"),
    "a fold": Defect(fold, "fold", "WL 2.5"),
    "a fold through its points": Defect(fold_through, "fold", "WL 2.5"),
    "a loop": Defect(loop, "loop", "WL 2.5"),
    "a gap": Defect(widen, "gap", POINT),
    "a point that is not finite": Defect(spoil_number, "not finite", POINT),
    "a point out of its plane": Defect(lift, "off plane", POINT),
    "a point off its curve": Defect(slide, "off curve", POINT),
    "two points at one place": Defect(double, "close", "WL 2.5"),
    "a friend that does not read": Defect(unlink, "links", POINT),
    "a shared crossing with a driver": Defect(misdrive, "links", POINT),
    "a driver of nothing": Defect(drive_nothing, "links", POINT),
    "an orphan: a point its curve does not know": Defect(lose, "orphan", POINT),
    "an orphan: a point on no curve": Defect(unhang, "orphan", f"x {KEY}"),
    "an orphan: a curve through a point that has gone": Defect(bury_point, "links", "WL 2.5"),
    "an orphan: points on a curve that has gone": Defect(strand, "orphan", f"x {KEY}"),
    "an orphan: a curve of no line": Defect(unline, "orphan", f"{KEY}/1"),
    "an orphan: a curve of a line that has gone": Defect(bury_line, "orphan", f"{KEY}/1"),
    "an orphan: a curve its line does not list": Defect(disown_curve, "orphan", f"{KEY}/1"),
    "an orphan: lines of a group that has gone": Defect(disown_line, "orphan", KEY),
    "an orphan: a line of no group": Defect(ungroup, "orphan", KEY),
    "an orphan: a point that rides with nothing": Defect(ride_away, "orphan", "WL 2.5 @ adopted"),
    "a missing twin link: one curve does not list the crossing": Defect(untwin, "twin", POINT),
    "a missing twin link: a crossing of one curve": Defect(cut_off, "twin", "x " + KEY),
    "a missing twin link: a crossing of two other curves": Defect(meet_wrongly, "twin", POINT),
    "a broken association: crossings without one": Defect(dissociate, "association", POINT),
    "a broken association: a meeting without its crossing": Defect(
        forget, "association", "ST 7 x WL 2.5"
    ),
    "a broken association: one-way, and shared": Defect(turn_one_way, "association", POINT),
    "a broken association: driven against it": Defect(turn_round, "association", POINT),
    "a ruling that was not carried out": Defect(rule_alone, "ruling", POINT),
    "a ruling: a crossing against it": Defect(rule_round, "ruling", POINT),
    "a ruling: a switched crossing out of its box": Defect(rule_elsewhere, "ruling", POINT),
    "a broken association: of no group": Defect(associate_nothing, "association", "cant frames"),
    "a broken association: declared twice": Defect(
        associate_twice, "association", "waterlines - sections"
    ),
    "a ring": Defect(close_ring, "ring", "ST 7"),
    "a point that leads nowhere": Defect(lead_astray, "tables", f"x {KEY}"),
    "a curve through nothing": Defect(list_astray, "tables", f"{KEY}/1"),
    "a meeting that is nothing": Defect(meet_astray, "tables", f"{KEY}/1"),
    "a curve that leads nowhere": Defect(line_astray, "tables", f"{KEY}/1"),
    "a line that leads nowhere": Defect(group_astray, "tables", KEY),
    "a role that there is not": Defect(unknown_role, "tables", f"x {KEY}"),
    "a sort that there is not": Defect(unknown_sort, "tables", f"x {KEY}"),
    "a state that there is not": Defect(unknown_state, "tables", f"{KEY}/1"),
    "a family that there is not": Defect(unknown_family, "tables", "waterlines"),
    "a key that two points have": Defect(share_key, "tables", f"x {KEY}"),
}
"""All defects, by what they are."""


@functools.cache
def _sound() -> tuple[dict[str, object], dict[str, object]]:
    """Definition and published values of a small hull."""
    state = wigley(stations=11, waterlines=6)
    return definition(state), published(state)


def sound() -> HullState:
    """A small hull of one's own, to be spoilt."""
    return from_definition(*_sound())


def planted(name: str, state: HullState) -> Defect:
    """Plant a defect into a hull; give it."""
    DEFECTS[name].plant(state)
    return DEFECTS[name]


every_defect = pytest.mark.parametrize("name", DEFECTS)
"""Run a test with the name of each defect, as `name`."""
