"""Pinned modifications: points moved, inserted, deleted, of another kind; ends of curves.

A pinned edit changes the two curves of a point and what these drive; all other points keep
their values. It is right for millimetres: it is inherently a local bump.

End conditions of curves.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import choice, word
from assoc_hull.arguments import place as one_place
from assoc_hull.edit.arguments import direction_in
from assoc_hull.edit.crossings.adopted_points import insertion_index, link_adopted_points
from assoc_hull.edit.lines.line_planes import checked_in_planes, completed_in_planes
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import (
    BadInputError,
    CoincidentPointsError,
    FreedomError,
    PointRoleError,
    TooFewPointsError,
)
from assoc_hull.geometry.curves import (
    EndKind,
    FloatArray,
    IntArray,
    PointKind,
)
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.model.address import AddressBook, address
from assoc_hull.model.gaps import tangents
from assoc_hull.model.generated_curves import attached_curves
from assoc_hull.model.kinds import Role, Sort, State
from assoc_hull.model.links import free_axes
from assoc_hull.model.make_objects import PointSpec
from assoc_hull.model.tables import Ends, HullState
from assoc_hull.tolerance import IN_PLANE

__all__ = [
    "PointFreedom",
    "delete",
    "insert",
    "move",
    "move_by",
    "note_pinned",
    "pin",
    "put_pinned",
    "set_end",
    "set_kind",
    "unpin",
]


def set_end(
    edit: Transaction,
    curve: int,
    end: str,
    *,
    tangent: ArrayLike | None = None,
    curvature: ArrayLike | None = None,
) -> None:
    """Give a curve a direction or a curvature at an end, or leave that end free.

    What is so already is not done again, but for a curve that has failed.

    Parameters
    ----------
    edit : Transaction
        The edit.
    curve : int
        The curve.
    end : {"start", "finish"}
        Which end.
    tangent : (3,) or None
        Direction along the sense of the curve, any length.
    curvature : (3,) or None, 1/m
        Second derivative with respect to chord length.

    Raises
    ------
    BadInputError
        An unknown end, both conditions, or a vector that is not three finite numbers.
    """
    where = f"in set_end of {AddressBook(edit.state).curve_name(curve)}"
    choice(end, "end", ("start", "finish"), where)
    if tangent is not None and curvature is not None:
        raise BadInputError("both a tangent and a curvature", where, "give one of the two")
    kind, vector = EndKind.FREE, np.zeros(3)
    if tangent is not None:
        kind, vector = EndKind.TANGENT, direction_in(edit.state, curve, tangent, "tangent")
    elif curvature is not None:
        kind, vector = EndKind.CURVATURE, direction_in(edit.state, curve, curvature, "curvature")
    old: Ends = edit.state.curves.ends[curve]
    at = 0 if end == "start" else 1
    x, y, z = vector.tolist()
    given = (int(kind), (x, y, z))
    kept = (old.kind[1 - at], old.vector[1 - at])
    first, last = (given, kept) if at == 0 else (kept, given)
    new = Ends((first[0], last[0]), (first[1], last[1]))
    if new == old and edit.state.curves.state[curve] == State.CLEAN:
        return
    edit.journal.set(edit.state.curves.ends, [curve], [new])
    edit.pending.by_hand.add((int(edit.state.curves.rows[curve][-at]), curve))
    edit.pending.curves.add(curve)
    edit.pending.moved_curves.add(curve)


_AXES = {"x": 0, "y": 1, "z": 2}
_BY_DEFINITION = "set the definitions its driver is made of (edit.set_form)"
_WAYS_OUT = "move the driver, pull it (edit.pull), or make it shared (edit.set_role)"


def move(edit: Transaction, row: int, to: Mapping[str, float], put: Put | None = None) -> None:
    """Move a point along its freedom.

    Parameters
    ----------
    edit : Transaction
        The edit.
    row : int
        A shared crossing, a placed or an adopted point. An adopted one becomes placed.
    to : mapping of str to float, m
        New coordinates: exactly those in which the point is free.
    put : callable or None
        What puts it there; None: it is pinned.

    Raises
    ------
    PointRoleError
        The point is driven or watched; the message names its driver.
    FreedomError
        Other coordinates were given than those it is free in.
    BadInputError
        A number that is not finite.
    """
    freedom = PointFreedom.of(edit.state, row)
    (put or put_pinned)(edit, [freedom], freedom.place(to)[None])


def move_by(edit: Transaction, rows: Sequence[int], by: FloatArray, put: Put | None = None) -> None:
    """Move points by vectors from where they were before the edit; all of them, or none.

    Parameters
    ----------
    edit : Transaction
        The edit.
    rows : sequence of int
        The points, each as `move` takes it.
    by : (1, 3) or (k, 3), m
        One vector for all, or one for each.
    put : callable or None
        As `move` takes it.

    Raises
    ------
    PointRoleError
        A point is driven or watched; the message names its driver.
    FreedomError
        A vector leads out of the freedom of its point.
    BadInputError
        Neither one vector nor as many as points; a point stands there twice.
    """
    if len(by) not in (1, len(rows)):
        what = f"{len(by)} vectors for {len(rows)} points"
        raise BadInputError(what, "in move", "give one vector for all, or one for each point")
    each = np.broadcast_to(by, (len(rows), 3))
    freedoms = [PointFreedom.of(edit.state, row) for row in rows]
    places = [freedom.moved(way) for freedom, way in zip(freedoms, each, strict=True)]
    if places:
        (put or put_pinned)(edit, freedoms, np.array(places))


def put_pinned(edit: Transaction, freedoms: Sequence[PointFreedom], places: FloatArray) -> None:
    """Set points to places (k, 3), m, by hand; adopted ones are placed from then on."""
    state, rows = edit.state, np.array([each.row for each in freedoms])
    edit.write(rows, places, lambda: f"move of {', '.join(each.name for each in freedoms[:3])}")
    curves = state.rows.curve[rows]
    edit.pending.moved_curves |= set(curves[curves >= 0].tolist())
    for row in rows[state.rows.sort[rows] == Sort.ADOPTED].tolist():
        pin(edit, row)


def note_pinned(edit: Transaction, name: str) -> None:
    """Say that a point is put between others that stay."""
    note = (
        f"{name} is put between points that stay: the line bends there and the hull does not "
        "follow; with lead=True it does"
    )
    if note not in edit.pending.notes:
        edit.pending.notes.append(note)


Put = Callable[[Transaction, Sequence["PointFreedom"], FloatArray], None]
"""Puts points to places (k, 3), m."""


@attrs.frozen(eq=False)
class PointFreedom:
    """How a point may be moved.

    Attributes
    ----------
    state, row : HullState, int
        The tables and the point.
    axes : tuple of str
        The coordinates that it is free in.
    lines : list of int
        The lines that it lies on.
    """

    state: HullState
    row: int
    axes: tuple[str, ...]
    lines: list[int]

    @classmethod
    def of(cls, state: HullState, row: int) -> Self:
        """Read the tables; a driven or watched point raises a PointRoleError."""
        _refuse_computed(state, row)
        curves = [curve for curve in state.rows.curve[row].tolist() if curve >= 0]
        lines = [state.line_of(curve) for curve in curves]
        return cls(state, row, free_axes(state, row), lines)

    @property
    def name(self) -> str:
        """Its address."""
        return address(self.state, self.row)

    def place(self, to: Mapping[str, float]) -> FloatArray:
        """Give where the point comes to lie, (3,), m; it raises as `move` does."""
        if set(to) != set(self.axes):
            raise FreedomError(self.name, tuple(to), self.axes)
        given = {_AXES[axis]: value for axis, value in to.items()}
        now = self.state.rows.xyz[self.row]
        place = completed_in_planes(self.state, self.lines, now, given)
        return checked_in_planes(self.state, self.lines, place, lambda: f"in a move of {self.name}")

    def moved(self, by: FloatArray) -> FloatArray:
        """Give where a vector (3,), m, takes the point; what else an oblique plane says follows.

        A component along another coordinate than those that it is free in must be 0, or what
        follows; else it raises a FreedomError.
        """
        now = self.state.rows.xyz[self.row]
        place = self.place({axis: float(now[_AXES[axis]] + by[_AXES[axis]]) for axis in self.axes})
        lost = (by != 0.0) & (np.abs(place - now - by) > IN_PLANE)
        if lost.any():
            asked = tuple(axis for axis, at in _AXES.items() if by[at] != 0.0)
            raise FreedomError(self.name, asked, self.axes)
        return place


def _refuse_computed(state: HullState, row: int) -> None:
    if state.rows.sort[row] != Sort.CROSSING:
        return
    role = Role(int(state.rows.role[row]))
    if role is Role.SHARED:
        return
    driver = int(state.rows.driver[row])
    title = None if driver < 0 else str(state.lines.name[state.line_of(driver)])
    kind = "watched" if role is Role.WATCHED else "driven"
    ways = (
        _WAYS_OUT if driver not in attached_curves(state) else f"{_BY_DEFINITION}, or {_WAYS_OUT}"
    )
    raise PointRoleError(address(state, row), kind, title, ways)


def insert(edit: Transaction, curve: int, place: ArrayLike) -> int:
    """Insert a placed point into a curve, between the two points it lies between.

    Returns
    -------
    int
        The new point.

    Raises
    ------
    BadInputError
        A place that is not three finite numbers, or lies off the curve's plane.
    CoincidentPointsError
        Another point of the curve lies there.
    """
    state = edit.state
    name = str(state.lines.name[state.line_of(curve)])
    given = one_place(place, f"the place of a point of {name}")
    xyz = checked_in_planes(state, [state.line_of(curve)], given, "in insert")
    rows: IntArray = state.curves.rows[curve]
    away = np.sqrt(((state.rows.xyz[rows] - xyz) ** 2).sum(axis=1))
    if away.min() < state.tolerances.coincident:
        x, y, z = xyz.tolist()
        raise CoincidentPointsError(name, (x, y, z), float(away.min()), state.tolerances.coincident)
    row = int(edit.maker.points([PointSpec(curve, xyz, Sort.PLACED)])[0])
    index = insertion_index(state.rows.xyz[rows], xyz)
    edit.maker.define(curve, np.insert(rows, index, row))
    edit.pending.by_hand.add((row, curve))
    _changed(edit, curve)
    return row


def _changed(edit: Transaction, curve: int) -> None:
    """Note that other points define a curve now."""
    edit.pending.structural = True
    edit.pending.curves.add(curve)
    edit.pending.moved_curves.add(curve)


def delete(edit: Transaction, row: int) -> None:
    """Delete a placed or adopted point.

    Raises
    ------
    PointRoleError
        The point is a crossing, which goes with its line or its association only, or an end.
    TooFewPointsError
        The curve would be left with fewer than two points.
    """
    state = edit.state
    if state.rows.sort[row] == Sort.CROSSING:
        raise PointRoleError(
            address(state, row), "a crossing", None, "remove the line, or the association"
        )
    curve = int(state.rows.curve[row, 0])
    rows: IntArray = state.curves.rows[curve]
    if len(rows) < 3:
        raise TooFewPointsError(str(state.lines.name[state.line_of(curve)]), len(rows) - 1)
    if row in rows[[0, -1]]:
        raise PointRoleError(
            address(state, row), "an end of its curve", None, "move it, or remove the line"
        )
    edit.maker.define(curve, rows[rows != row])
    edit.maker.remove_rows([row])
    edit.pending.values.pop(row, None)
    edit.pending.by_hand.add((row, curve))
    _changed(edit, curve)


def set_kind(
    edit: Transaction, row: int, side: int, kind: str, direction: ArrayLike | None = None
) -> None:
    """Make a point smooth, tangent or a knuckle on one of its curves, unless it is so already.

    Parameters
    ----------
    edit : Transaction
        The edit.
    row, side : int
        The point, and whether the curve is its a (0) or b (1).
    kind : {"smooth", "tangent", "knuckle"}
        How the curve is to pass.
    direction : (3,) or None
        Direction at a tangent point, along the sense of the curve; as it is now if None.

    Raises
    ------
    BadInputError
        An unknown kind, a direction of no length, or a point that does not define the curve.
    """
    state = edit.state
    curve = int(state.rows.curve[row, side])
    where = f"at {address(state, row)}"
    if word(kind, "kind") not in {each.name.lower() for each in PointKind}:
        raise BadInputError(f"the kind {kind!r}", where, "use smooth, tangent or knuckle")
    rows: IntArray = state.curves.rows[curve]
    if row not in rows.tolist():
        raise BadInputError("the point does not define the curve", where, "set its role first")
    given = np.zeros(3)
    old = PointKind(int(state.rows.kind[row, side]))
    if kind == "tangent":
        if direction is None and old is PointKind.TANGENT:
            direction = state.rows.direction[row, side]
        elif direction is None:
            direction = _direction(state, curve, state.rows.xyz[row])
        given = direction_in(state, curve, direction, "direction")
    if old is PointKind[kind.upper()] and (given == state.rows.direction[row, side]).all():
        return
    kinds, directions = state.rows.kind[row].copy(), state.rows.direction[row].copy()
    kinds[side], directions[side] = PointKind[kind.upper()], given
    edit.journal.put(state.rows.kind, [row], kinds[None])
    edit.journal.put(state.rows.direction, [row], directions[None])
    edit.pending.by_hand.add((row, curve))
    edit.pending.curves.add(curve)
    edit.pending.moved_curves.add(curve)


def _direction(state: HullState, curve: int, place: FloatArray) -> FloatArray:
    """Give the direction of a curve at a place on it; a new point may not be in it yet."""
    spline = state.spline(curve)
    at = np.flatnonzero((spline.xyz == place).all(axis=1))
    if len(at):
        return np.array(spline.leave[at[0]])
    found: FloatArray = tangents(
        state, np.array([curve]), closest_points(spline, 0, place[None])[0]
    )[0]
    return found


def pin(edit: Transaction, row: int) -> None:
    """Make an adopted point a placed one: no update moves it any more."""
    _resort(edit, row, Sort.ADOPTED, Sort.PLACED)


def unpin(edit: Transaction, row: int) -> None:
    """Make a placed point an adopted one: it belongs to the shape and goes with fields."""
    edit.refuse_moved(np.array([row]))
    _resort(edit, row, Sort.PLACED, Sort.ADOPTED)


def _resort(edit: Transaction, row: int, old: Sort, new: Sort) -> None:
    state = edit.state
    if state.rows.sort[row] != old:
        sort = Sort(int(state.rows.sort[row])).name.lower()
        raise PointRoleError(
            address(state, row),
            f"a {sort} point",
            None,
            f"only {old.name.lower()} points can change",
        )
    edit.journal.put(state.rows.sort, [row], int(new))
    edit.journal.put(state.rows.anchor, [row], -1)
    edit.pending.structural = True
    link_adopted_points(state, state.rows.curve[row, :1], edit.journal)
