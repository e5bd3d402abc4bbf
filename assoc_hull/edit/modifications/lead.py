"""Leads: a designer draws some points of a line, and the hull answers as fairly as it was.

A lead is one solve (`fair_answer`) in the place of a pinned point, which is a bump between its
neighbours: the line keeps its points and roles, while its crossings give up their values within a
stretch. What lies in the plane of a crossing line is asked of the crossing.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import pair, shown
from assoc_hull.arguments import place as one_place
from assoc_hull.edit.crossings.adopted_points import insert_defining_point, insertion_index
from assoc_hull.edit.displacement_field import fixed_places
from assoc_hull.edit.led_lines import LineLed
from assoc_hull.edit.lines.line_planes import checked_in_planes
from assoc_hull.edit.modifications import points
from assoc_hull.edit.modifications.points import PointFreedom, pin
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, PointRoleError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.model.address import address
from assoc_hull.model.kinds import BoundaryKind, Role, Sort
from assoc_hull.model.links import crossing_ways, free_axes
from assoc_hull.model.make_objects import PointSpec
from assoc_hull.model.tables import HullState
from assoc_hull.tolerance import IN_PLANE

__all__ = ["insert", "insert_pinned", "lead", "put", "put_pinned"]

_OFF = 1e-5
"""Times Lpp: a place that is nearer to a line (m) lies on it, and is pinned."""

_BESIDE = 0.2
"""Times `Tolerances.factor`: between two points as near as this (m) no curve is led fairly."""


def lead(
    edit: Transaction,
    curves: Sequence[int],
    asked: Sequence[tuple[int | None, FloatArray]],
    span: tuple[float, float] | None = None,
) -> list[int]:
    """Ask for a line to be led through places.

    Parameters
    ----------
    edit : Transaction
        The edit.
    curves : sequence of int
        The curves of the line that may be meant; a new point goes to the nearest.
    asked : sequence of (int or None, (3,) m)
        Each a crossing, a placed or an adopted point of the line and where it is to come, or None
        and the place of a new point. An adopted one becomes placed.
    span : (float, float) or None, m
        The stretch: x; z of a section. None: see `led_lines`.

    Returns
    -------
    list of int
        The placed points that were made.

    Raises
    ------
    BadInputError
        Places off the plane of the line or of a crossing one, beyond its ends or the span; a point
        of another line, or one beside a placed point; a boundary curve.
    PointRoleError
        A crossing that another line drives.
    """
    line = edit.state.line_of(curves[0])
    name = str(edit.state.lines.name[line])
    where = f"in lead of {name}"
    if edit.state.lines.boundary[line] >= 0:
        what = f"{name} is a boundary curve"
        raise BadInputError(what, where, "lead the lines that meet it, or re-shape it")
    if span is not None:
        span = pair(span, "span", positive=False)
    if not asked:
        raise BadInputError("no place is given", where, "give (x, y, z), or (point, (x, y, z))")
    chooser = _Chooser(edit, name, where, curves)
    for row, xyz in asked:
        chooser.refuse_outside(xyz, span)
        chooser.take(row, xyz)
    _ask(edit, [chooser], span)
    return chooser.made


def insert(edit: Transaction, curve: int, place: ArrayLike) -> int:
    """Insert a point into a curve; off the curve it leads.

    A place on the curve, on a flat, the profile or a feature, beyond the ends or on a boundary
    curve is pinned, as `points.insert` does. Else see `lead`: in the plane of a crossing line the
    crossing is asked for, and given.
    """
    state, line = edit.state, edit.state.line_of(curve)
    name = str(state.lines.name[line])
    xyz = one_place(place, f"the place of a point of {name}")
    chooser = _Chooser(edit, name, f"in insert into {name}", [curve], by_lead=False)
    spline = state.spline(curve)
    at, foot, away = closest_points(spline, 0, xyz[None])
    inside = 0.0 < float(at[0]) < float(spline.knot[-1])
    held = bool(fixed_places(state, np.concatenate([foot, xyz[None]])).any())
    rows = state.curves.rows.data[curve]
    index = insertion_index(state.rows.xyz.data[rows], foot[0])
    held |= set(rows[index - 1 : index + 1].tolist()) <= _feature_rows(state)
    if not inside or held or not _leads(state, line) or not _is_off(state, float(away[0])):
        return points.insert(edit, curve, xyz)
    chooser.take(None, xyz)
    _ask(edit, [chooser], None)
    (row,) = chooser.asked[curve]
    return row


def insert_pinned(edit: Transaction, curve: int, place: ArrayLike) -> int:
    """Insert a point without leading, and say so where it is off the curve."""
    state, line = edit.state, edit.state.line_of(curve)
    row = points.insert(edit, curve, place)
    away = closest_points(state.spline(curve), 0, state.rows.xyz[[row]])[2]
    if _leads(state, line) and _is_off(state, float(away[0])):
        points.note_pinned(edit, f"a point of {state.lines.name[line]}")
    return row


def put(edit: Transaction, freedoms: Sequence[PointFreedom], places: FloatArray) -> None:
    """Put points to places (k, 3), m: placed and adopted ones lead, where they can."""
    state = edit.state
    rows = np.array([each.row for each in freedoms])
    led = np.array([_can_lead(state, each) for each in freedoms])
    if (~led).any():
        pinned = [each for each, mine in zip(freedoms, led.tolist(), strict=True) if not mine]
        _refuse_led(edit, pinned, places[~led])
        points.put_pinned(edit, pinned, places[~led])
    choosers: dict[int, _Chooser] = {}
    for row, place in zip(rows[led].tolist(), places[led], strict=True):
        curve = int(state.rows.curve[row, 0])
        if curve not in choosers:
            name = str(state.lines.name[state.line_of(curve)])
            choosers[curve] = _Chooser(edit, name, f"in move on {name}", [curve], by_lead=False)
        choosers[curve].take(row, place)
    if choosers:
        _ask(edit, list(choosers.values()), None)


def put_pinned(edit: Transaction, freedoms: Sequence[PointFreedom], places: FloatArray) -> None:
    """Put points to places (k, 3), m, without leading, and say so where they could lead."""
    _refuse_led(edit, freedoms, places)
    points.put_pinned(edit, freedoms, places)
    for each, place in zip(freedoms, places, strict=True):
        if _can_lead(edit.state, each) and (place != edit.state.rows.xyz[each.row]).any():
            points.note_pinned(edit, each.name)


def _refuse_led(edit: Transaction, freedoms: Sequence[PointFreedom], places: FloatArray) -> None:
    """Refuse to put points elsewhere than to where the same edit leads them: it leads last."""
    goals = {} if edit.pending.answer is None else edit.pending.answer.goals()
    for each, place in zip(freedoms, places, strict=True):
        if each.row in goals and (goals[each.row] != place).any():
            raise _two_places(edit.state, each.row, f"in move of {each.name}")


def _two_places(state: HullState, row: int, where: str) -> BadInputError:
    what = f"{address(state, row)} is asked to be in two places"
    return BadInputError(what, where, "leave one of the two out, or use two edits")


def _can_lead(state: HullState, freedom: PointFreedom) -> bool:
    """Tell whether the move of a point leads: not of crossings, on flats, profile, features."""
    if state.rows.sort[freedom.row] == Sort.CROSSING or freedom.row in _feature_rows(state):
        return False
    held = fixed_places(state, state.rows.xyz[[freedom.row]])[0]
    return not held and all(_leads(state, line) for line in freedom.lines)


def _feature_rows(state: HullState) -> set[int]:
    """Give the points that features hold: what is put among them by hand dissolves these."""
    if not state.features:
        return set()
    # What solves sparse systems is imported by whoever asks for it.
    from assoc_hull.edit.net_battens import feature_rows

    return set(feature_rows(state).tolist())


def _leads(state: HullState, line: int) -> bool:
    return bool(state.lines.boundary[line] < 0)


def _is_off(state: HullState, away: float) -> bool:
    """Tell whether a place is off a curve, and not on it but for rounding."""
    return away > _OFF * state.particulars.length


def _ask(edit: Transaction, choosers: Sequence[_Chooser], span: tuple[float, float] | None) -> None:
    """Ask for what was chosen; what is asked of one curve over one stretch is one lead."""
    # What solves sparse systems is imported by whoever asks for it.
    from assoc_hull.edit.modifications.fair_answer import FairAnswer

    answer = FairAnswer.of(edit)
    leads = {(each.curve, each.span): each for each in answer.leads}
    for chooser in choosers:
        for curve, asked in chooser.asked.items():
            before = leads.get((curve, span))
            goals = {} if before is None else before.goals()
            for row, goal in asked.items():
                chooser.put(goals, row, goal)
            rows = sorted(goals)
            to = np.array([goals[row] for row in rows])
            leads[curve, span] = LineLed(chooser.name, curve, np.array(rows, np.int64), to, span)
    answer.leads = list(leads.values())
    edit.pending.moved_curves |= {curve for chooser in choosers for curve in chooser.asked}


@attrs.define(eq=False)
class _Chooser:
    """Finds the points of a line that places are meant for, and makes those that are new.

    `asked` are their goals by curve and point; `by_lead` tells that of `edit.lead`, which errors
    name, from points that could be pinned instead.
    """

    edit: Transaction
    name: str
    where: str
    curves: Sequence[int]
    by_lead: bool = True
    asked: dict[int, dict[int, FloatArray]] = attrs.field(factory=dict)
    made: list[int] = attrs.field(factory=list)

    @property
    def state(self) -> HullState:
        """The tables."""
        return self.edit.state

    def refuse_outside(self, xyz: FloatArray, span: tuple[float, float] | None) -> None:
        """Refuse a place outside a named stretch."""
        if span is None:
            return
        section = self.state.family(self.state.line_of(self.curves[0])).axis == 0
        if not span[0] < float(xyz[2 if section else 0]) < span[1]:
            what = f"the place {xyz.tolist()} lies outside the span {shown(span)}"
            raise BadInputError(what, self.where, "widen the span or leave the point out")

    def take(self, row: int | None, xyz: FloatArray) -> None:
        """Take a point and the place that it is to come to."""
        line = self.state.line_of(self.curves[0])
        xyz = checked_in_planes(self.state, [line], xyz, self.where)
        if row is None:
            curve, foot = self._foot(xyz)
            row = self._own(curve, foot, xyz)
            if row is None:
                self._refuse_driven(curve, foot)
                self._ask(curve, self._new(curve, foot), xyz)
                return
        else:
            curve = self._curve_of(row)
        table = self.state.rows
        if table.sort[row] == Sort.CROSSING:
            lines = [self.state.line_of(each) for each in table.curve[row].tolist()]
            xyz = checked_in_planes(self.state, lines, xyz, self.where)
            crossing = str(table.key[row])
            if table.role[row] != Role.SHARED:
                row = self._at_crossing(curve, row)
            if table.stands_for[row] == crossing:
                # It stays what it is, as the crossing would.
                self._ask(curve, row, xyz)
                return
        if table.sort[row] == Sort.ADOPTED:
            pin(self.edit, row)
        self._ask(curve, row, xyz)

    def _ask(self, curve: int, row: int, xyz: FloatArray) -> None:
        put = self.edit.pending.values.get(row)
        if put is not None and (put != xyz).any() and not self._is_new(row):
            raise _two_places(self.state, row, self.where)
        self.put(self.asked.setdefault(curve, {}), row, xyz)

    def put(self, goals: dict[int, FloatArray], row: int, xyz: FloatArray) -> None:
        """Note a goal; a point that the same edit has made comes where it is asked last."""
        moved = row in goals and (goals[row] != xyz).any()
        if moved and (row in self.made or not self._is_new(row)):
            raise _two_places(self.state, row, self.where)
        goals[row] = xyz

    def _is_new(self, row: int) -> bool:
        """Tell whether the edit has made a point."""
        known = self.state.published().rows
        return row >= known.count or not known.alive[row]

    def _curve_of(self, row: int) -> int:
        """Give the curve of the line that a point lies on."""
        found = [each for each in self.state.rows.curve[row].tolist() if each in self.curves]
        if not found:
            what = f"{address(self.state, row)} is no point of {self.name}"
            raise BadInputError(
                what, self.where, "give a point of the line, or the place of a new one"
            )
        return int(found[0])

    def _foot(self, xyz: FloatArray) -> tuple[int, FloatArray]:
        """Give the nearest curve of the line, and the place on it."""
        best: tuple[float, int, FloatArray] | None = None
        for curve in self.curves:
            spline = self.state.spline(curve)
            at, foot, away = closest_points(spline, 0, xyz[None])
            if (best is None or away[0] < best[0]) and 0.0 < at[0] < spline.knot[-1]:
                best = float(away[0]), curve, foot[0]
        if best is None:
            what = f"the place {xyz.tolist()} lies beyond the ends of {self.name}"
            raise BadInputError(what, self.where, "give one beside the line")
        return best[1:]

    def _own(self, curve: int, foot: FloatArray, xyz: FloatArray) -> int | None:
        """Give the point of the curve that a place is meant for, if there is one."""
        table = self.state.rows
        on = table.alive.data & (table.curve.data == curve).any(axis=1)
        crossing = np.flatnonzero(on & (table.sort.data == Sort.CROSSING))
        side = (table.curve.data[crossing, 1] == curve).astype(np.int64)
        apart = np.sqrt(((table.spot.data[crossing, side] - xyz) ** 2).sum(axis=1))
        for index in np.argsort(apart, kind="stable").tolist():
            if np.isfinite(apart[index]) and self._in_plane(curve, int(crossing[index]), xyz):
                return int(crossing[index])
        rows: IntArray = self.state.curves.rows[curve]
        rows = rows[np.isin(table.sort[rows], (Sort.PLACED, Sort.ADOPTED))]
        rows = rows[~np.isin(rows, self.made)]
        if not len(rows):
            return None
        away = np.sqrt(((table.xyz[rows] - foot) ** 2).sum(axis=1))
        row = int(rows[away.argmin()])
        same = min(float(away.min()), float(np.abs(table.xyz[row] - xyz).max()))
        if same <= self.state.tolerances.coincident:
            return row
        if away.min() >= self.state.tolerances.factor * _BESIDE:
            return None
        if table.sort[row] == Sort.PLACED:
            name = address(self.state, row)
            what = f"the placed point {name} lies {away.min():.3g} m beside it"
            raise BadInputError(what, self.where, self._instead(row, xyz))
        return row

    def _instead(self, row: int, xyz: FloatArray) -> str:
        """Say what to do where a place is meant that lies beside a placed point."""
        if self._is_new(row):
            return "leave one of the two out, or use two edits and move the point"
        name, place = repr(address(self.state, row)), [round(each, 6) for each in xyz.tolist()]
        if self.by_lead:
            return f"lead that point: ({name}, {tuple(place)})"
        free = free_axes(self.state, row)
        to = ", ".join(f"{axis}={place['xyz'.index(axis)]}" for axis in free)
        return f"move that point: edit.move({name}, {to}), or pin another (lead=False)"

    def _in_plane(self, curve: int, row: int, xyz: FloatArray) -> bool:
        """Tell whether a place lies in the plane of the line that crosses."""
        first, second = self.state.rows.curve[row].tolist()
        other = self.state.line_of(second if first == curve else first)
        if not self.state.lines.planar[other]:
            return False
        away = self.state.lines.normal[other] @ xyz - self.state.lines.offset[other]
        return bool(abs(away) <= IN_PLANE)

    def _refuse_driven(self, curve: int, foot: FloatArray) -> None:
        """Refuse a new place between two crossings that one-way associations drive."""
        state, rows = self.state, self.state.curves.rows[curve]
        at = closest_points(state.spline(curve), 0, foot[None])[0][0]
        after = int(np.searchsorted(state.spline(curve).knot, at))
        beside: IntArray = rows[max(after - 1, 0) : after + 1]
        drivers = state.rows.driver[beside]
        if ((drivers < 0) | (drivers == curve)).any() or state.rows.contact[beside].any():
            return
        if not crossing_ways(state, beside).all(axis=1).any():
            title = str(state.lines.name[state.line_of(int(drivers[0]))])
            ways = f"lead {title}, or associate the two both ways (edit.associate)"
            raise PointRoleError(f"{self.name} beside {address(state, int(beside[0]))}", "driven",
                                 title, ways)  # fmt: skip

    def _at_crossing(self, curve: int, row: int) -> int:
        """Give a point of the curve where a crossing lies that it drives, or that is watched."""
        table = self.state.rows
        driver = int(table.driver[row])
        if table.role[row] != Role.WATCHED and driver != curve:
            title = str(self.state.lines.name[self.state.line_of(driver)])
            pinned = "" if self.by_lead else ", or pin a point beside it (lead=False)"
            kind = self.state.lines.boundary[self.state.line_of(driver)]
            if kind >= 0:
                flats = " with across_flats=True" if kind == BoundaryKind.FLAT else ""
                ways = f"re-shape {title} (edit.reshape{flats}), or ask for another point{pinned}"
            else:
                ways = f"lead {title}, or make it shared (edit.set_role){pinned}"
            raise PointRoleError(address(self.state, row), "driven", title, ways)
        spot = table.spot[row, int(table.curve[row, 1] == curve)]
        rows: IntArray = self.state.curves.rows[curve]
        away = np.sqrt(((table.xyz[rows] - spot) ** 2).sum(axis=1))
        if away.min() <= self.state.tolerances.coincident:
            return int(rows[away.argmin()])
        return self._new(curve, spot)

    def _new(self, curve: int, place: FloatArray) -> int:
        """Place a point on the curve as it is."""
        line = self.state.line_of(curve)
        xyz = checked_in_planes(self.state, [line], place, self.where)
        row = int(self.edit.maker.points([PointSpec(curve, xyz, Sort.PLACED)])[0])
        insert_defining_point(self.edit.maker, curve, row)
        self.edit.pending.structural = True
        self.edit.pending.curves.add(curve)
        self.edit.pending.by_hand.add((row, curve))
        self.made.append(row)
        return row
