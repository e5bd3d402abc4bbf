"""An association is switched: what defines what at its crossings, while no curve moves.

One-way, the taker is driven at each crossing that defined it, and the giver is held there by a
stand-in with the bits of the crossing. A crossing that defined the giver alone defines neither from
then on, unless a stand-in of the taker lies there. The role of before is stored with the crossing,
and returns, in the place of the stand-in, when it is switched back.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.edit.crossings.adopted_points import (
    insert_defining_point,
    renew_anchors,
    swap_anchors,
)
from assoc_hull.edit.crossings.settle_crossings import make_latent, may_define
from assoc_hull.edit.transaction import Transaction
from assoc_hull.geometry.curves import IntArray
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.model.address import address
from assoc_hull.model.gaps import gap_at
from assoc_hull.model.keys import crossing_key
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.links import crossing_ways
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.tables import HullState

__all__ = ["Ways", "follow_ways", "leave_stand_ins", "switch_crossings", "take_up_stand_ins"]

Ways = np.typing.NDArray[np.bool_]
"""Of crossings (k, 2): whether a generates points on b, and b on a."""

_DEFINES = {
    Role.SHARED: (True, True), Role.DRIVES_A: (True, False), Role.DRIVES_B: (False, True),
    Role.WATCHED: (False, False),
}  # fmt: skip
_TOLD = 6
"""So many crossings are named in a note."""

_BESIDE = 0.15
"""Times `Tolerances.factor`: a stand-in as near as this (m) was of a crossing that is born."""


def switch_crossings(edit: Transaction, rows: IntArray, ways: Ways) -> None:
    """Give crossings (k,) the roles that follow from which of their curves generates on which.

    Raises
    ------
    BadInputError
        The same edit moves one of them.
    """
    edit.refuse_moved(rows)
    work = _Switch(edit)
    order = np.argsort([str(edit.state.rows.key[row]) for row in rows.tolist()], kind="stable")
    for row, way in zip(rows[order].tolist(), ways[order].tolist(), strict=True):
        work.back(row)
        if not all(way):
            work.one_way(row, taker=int(way[0]))
    work.finish()


def follow_ways(edit: Transaction, rows: IntArray, before: Ways) -> None:
    """Switch those of some crossings (k,) that are otherwise than associations and rulings say.

    These are crossings whose ways differ from those `before` the statement, that define the curve
    which is to give alone, and that were switched where nothing rules any more: an edit can have
    carried them out of the box in which they were.
    """
    state, alone = edit.state, ~edit.state.rows.contact[rows]
    rows, before = rows[alone], before[alone]
    if not len(rows):
        return
    ways = crossing_ways(state, rows)
    free = ways.all(axis=1)
    defines = np.array([_DEFINES[Role(role)] for role in state.rows.role[rows].tolist()])
    giver = (~ways[:, 0]).astype(np.int64)
    odd = ~free & defines[np.arange(len(rows)), giver]
    odd |= free & (state.rows.first_role[rows] >= 0)
    odd |= (ways != before).any(axis=1)
    switch_crossings(edit, rows[odd], ways[odd])


def take_up_stand_ins(edit: Transaction, rows: IntArray) -> None:
    """Let crossings (k,) that were just born take the places of stand-ins of dead ones.

    Those of the same pair of lines and sense are meant. A crossing that has one on both curves is
    shared, one that has it on b is driven by a; where the two curves do not pass at one place it
    stays watched, as no curve is to move.
    """
    work = _Switch(edit)
    for row in rows.tolist():
        work.revive(row)
    work.finish(tell=False)


def leave_stand_ins(edit: Transaction, rows: IntArray) -> None:
    """Take crossings (k,) out; stand-ins hold the curves that they defined, with their bits."""
    edit.refuse_moved(rows)
    work, table = _Switch(edit), edit.state.rows
    for row in rows.tolist():
        work.assign(row, Role.WATCHED)
        for curve in table.curve[row].tolist():
            make_latent(edit.maker, curve, row)
    edit.maker.remove_rows(rows)
    edit.pending.computed -= set(rows.tolist())
    work.finish(tell=False)


@attrs.define(eq=False)
class _Switch:
    """The crossings of an association while it is switched."""

    edit: Transaction
    stand_ins: dict[tuple[str, int], int] = attrs.field(init=False)
    linked: set[int] = attrs.field(factory=set)
    touched: set[int] = attrs.field(factory=set)
    watched: list[int] = attrs.field(factory=list)
    loose: list[int] = attrs.field(factory=list)
    held: list[int] = attrs.field(factory=list)
    beside: list[tuple[int, int]] = attrs.field(factory=list)

    def __attrs_post_init__(self) -> None:
        table = self.edit.state.rows
        self.stand_ins = {
            (table.stands_for[row], int(table.curve[row, 0])): row
            for row in sorted(table.stands_for.data.given)
            if table.alive[row]
        }

    @property
    def state(self) -> HullState:
        """The tables."""
        return self.edit.state

    @property
    def maker(self) -> Maker:
        """Writes to them."""
        return self.edit.maker

    def one_way(self, row: int, taker: int) -> None:
        """Let a crossing define the curve of one side only, or none."""
        role = Role(int(self.state.rows.role[row]))
        mine, others = _DEFINES[role][taker], _DEFINES[role][1 - taker]
        if not others:
            self.watched += [] if mine else [row]
            return
        if not mine and not self._may_take(row, taker):
            self.loose.append(row)
            new = Role.WATCHED
        else:
            new = Role.DRIVES_B if taker else Role.DRIVES_A
        self.edit.journal.put(self.state.rows.first_role, [row], int(role))
        self.assign(row, new)

    def _may_take(self, row: int, taker: int) -> bool:
        """Tell whether the taker may be made through a crossing that only drove the giver.

        The role rule has to allow it, and a stand-in with the same bits has to lie there: another
        point would move the curve.
        """
        state = self.state
        point = self._stand_in_at(row, taker)
        if point is None or (state.rows.xyz[point] != state.rows.xyz[row]).any():
            return False
        curve, other = state.rows.curve[row][[taker, 1 - taker]].tolist()
        return may_define(state, curve, state.line_of(other), row, taker)

    def back(self, row: int) -> None:
        """Give a crossing the role that it had before it was switched."""
        table = self.state.rows
        first = int(table.first_role[row])
        if first < 0:
            return
        curves = table.curve[row].tolist()
        for side, curve in enumerate(curves):
            point = self.stand_ins.get((str(table.key[row]), curve))
            held = point is not None and table.sort[point] == Sort.PLACED
            if held and _DEFINES[Role(first)][side]:
                # It is the designer's now, and stays; so does what it stood in for.
                self.held.append(row)
                return
        self.edit.journal.put(table.first_role, [row], -1)
        self.assign(row, Role(first))

    def revive(self, row: int) -> None:
        """Give a crossing that was just born the place and role of a dead one."""
        table, points = self.state.rows, [self._stand_in_at(row, side) for side in (0, 1)]
        one, other = (point is not None for point in points)
        step = table.spot[row, 0] - table.spot[row, 1]
        apart = float(np.sqrt((step * step).sum()))
        if not other or apart > self.state.tolerances.prune:
            return
        for side in (0, 1):
            if (point := points[side]) is not None:
                curve = int(table.curve[row, side])
                self.stand_ins[str(table.key[row]), curve] = point
        new = Role.SHARED if one else Role.DRIVES_B
        self.assign(row, new)
        first = points[0] if one else points[1]
        assert first is not None, "there is one on b"
        near = np.abs(table.xyz[first] - table.xyz[row]).max() <= self.state.tolerances.coincident
        if near:
            self.edit.journal.put(table.xyz, [row], table.xyz[first][None])
        if new is Role.SHARED:
            self.edit.journal.put(table.faired, [row], table.faired[first][None])

    def _stand_in_at(self, row: int, side: int) -> int | None:
        """Give the nearest stand-in of the pair of lines of a crossing on one of its curves."""
        state, table = self.state, self.state.rows
        curve = int(table.curve[row, side])
        lines = [state.lines.key[state.line_of(each)] for each in table.curve[row].tolist()]
        title = crossing_key(lines[0], lines[1], int(table.sign[row]), 1)[:-1]
        best: tuple[float, int] | None = None
        for point in state.curves.rows[curve].tolist():
            stood = table.stands_for[point]
            if not (stood[: len(title)] == title and stood[len(title) :].isdigit()):
                continue
            if table.sort[point] != Sort.ADOPTED:
                continue
            away = float(np.sqrt(((table.xyz[point] - table.spot[row, side]) ** 2).sum()))
            if away <= _BESIDE * state.tolerances.factor and (best is None or away < best[0]):
                best = away, point
        return None if best is None else best[1]

    def assign(self, row: int, new: Role) -> None:
        """Give a crossing a role; stand-ins and it take one another's places."""
        state, table, journal = self.state, self.state.rows, self.edit.journal
        if Role(int(table.role[row])) is Role.WATCHED and new is not Role.WATCHED:
            side = int(new is Role.DRIVES_A)
            journal.put(table.xyz, [row], table.spot[row, side][None])
        self.maker.roles(np.array([row]), np.array([int(new)]))
        for side, curve in enumerate(table.curve[row].tolist()):
            rows: IntArray = state.curves.rows[curve]
            inside, wanted = bool((rows == row).any()), _DEFINES[new][side]
            self.linked.add(curve)
            if inside and not wanted:
                point = int(self.maker.stand_ins(np.array([row]), np.array([side]))[0])
                self.stand_ins[str(table.key[row]), curve] = point
                self._swap(curve, row, point)
            elif wanted and not inside:
                stand_in = self.stand_ins.pop((str(table.key[row]), curve), None)
                if stand_in is not None and (rows == stand_in).any():
                    # A kind can have been set at it meanwhile, and the crossing can be a new one.
                    for column in (table.kind, table.direction):
                        value = column[[row]].copy()
                        value[0, side] = column[stand_in, 0]
                        journal.put(column, [row], value)
                    self._swap(curve, stand_in, row)
                    self.maker.remove_rows([stand_in])
                else:
                    insert_defining_point(self.maker, curve, row)
                    self.touched.add(curve)
        if new in (Role.DRIVES_A, Role.DRIVES_B):
            self.edit.pending.computed.add(row)
        limit = 2.0 * state.tolerances.adoption if new is Role.WATCHED else np.nan
        journal.put(table.limit, [row], limit)
        gap = gap_at(state, np.array([row])) if new is Role.WATCHED else np.nan
        journal.put(table.gap, [row], gap)
        if new is Role.WATCHED:  # it is published where it lies on a
            journal.put(table.xyz, [row], table.spot[row, :1])

    def _swap(self, curve: int, old: int, new: int) -> None:
        """Let a curve be made through another point that lies where one of its points does."""
        state, rows = self.state, self.state.curves.rows[curve]
        self.maker.define(curve, np.where(rows == old, new, rows))
        swap_anchors(state, curve, {old: new}, self.edit.journal)
        if state.rows.xyz[old].tobytes() != state.rows.xyz[new].tobytes():
            self.touched.add(curve)
            self.beside.append((curve, new))

    def finish(self, *, tell: bool = True) -> None:
        """Link what rides anew, and note what is watched."""
        pending = self.edit.pending
        pending.structural = True
        pending.curves |= self.touched
        for curve in sorted(self.linked):
            renew_anchors(self.state, curve, self.edit.journal)
        if not tell:
            return
        for rows, what in (
            (self.watched, "was watched and stays so"),
            (self.loose, "drove the giver only, and is watched now: no role of it keeps all bits"),
            (self.held, "keeps its role: a point that was placed holds the curve there"),
        ):
            if rows:
                pending.notes.append(f"{self._named(rows)}: {what}")
        self._tell_beside()

    def _tell_beside(self) -> None:
        """Note how far crossings lie off curves that are made through them again."""
        state = self.state
        away = {
            row: float(closest_points(state.spline(curve), 0, state.rows.xyz[[row]])[2][0])
            for curve, row in self.beside
        }
        order = sorted(away, key=lambda row: (-away[row], address(state, row)))
        order = [row for row in order if away[row] > state.tolerances.coincident]
        if order:
            self.edit.pending.notes.append(
                f"{self._named(order)}: its curve, which edits since have left up to "
                f"{1e3 * away[order[0]]:.2g} mm beside it, passes through it again"
            )

    def _named(self, rows: Sequence[int]) -> str:
        """Name the first crossings, and say how many there are."""
        names = ", ".join(address(self.state, row) for row in rows[:_TOLD])
        more = len(rows) - _TOLD
        return names + (f" and {more} more" if more > 0 else "")
