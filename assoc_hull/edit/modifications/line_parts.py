"""A part of a line that is to be drawn anew, what stands in its way, and the field that leads it.

The points between the ends of the part get given places. Where another line drives one, that line
is given a point there, or the crossing stops defining this one. What lies around takes the normal
change of the line as in a re-shape.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.edit.crossings.adopted_points import insert_defining_point
from assoc_hull.edit.displacement_field import flat_distance, on_flat, on_profile
from assoc_hull.edit.field_moves import FieldMoves, features_on
from assoc_hull.edit.modifications.reshape import ReshapeField, whole_curve
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, BlockedRunError
from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.model.address import address
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.make_objects import PointSpec
from assoc_hull.model.network import curve_data
from assoc_hull.model.tables import HullState

__all__ = ["LinePart", "Mark", "designed", "held_marks", "lead"]

_SHORTEST = 1e-3
"""A run has this part of the length of the ship at least."""

_NEAR = 0.15
"""Times `Tolerances.factor`: a curve with a point as near as this (m) is given no other."""

_AROUND = 3
"""So many points beyond its ends a part changes the line, as far as is worth following."""


@attrs.frozen(eq=False)
class LinePart:
    """A run between two points of a curve.

    Attributes
    ----------
    state, curve, verb : HullState, int, str
        The tables, the curve, and what is to be done to it.
    rows : (n,) int
        The points of the curve.
    first, last : int
        Places of the two points among them.
    old : SplineBatch
        The curve as it is.
    """

    state: HullState
    curve: int
    verb: str
    rows: IntArray
    first: int
    last: int
    old: SplineBatch

    @classmethod
    def of(cls, edit: Transaction, line: int, points: tuple[int, int], verb: str) -> LinePart:
        """Find the part between two points of a line, or say why there is none."""
        state = edit.state
        name = str(state.lines.name[line])
        where = f"in {verb} of {name}"
        curve = _curve_of(state, line, points, where)
        rows: IntArray = state.curves.rows[curve]
        first, last = sorted(int(np.flatnonzero(rows == row)[0]) for row in points)
        step = state.rows.xyz[rows[last]] - state.rows.xyz[rows[first]]
        length, least = float(np.sqrt((step * step).sum())), _SHORTEST * state.particulars.length
        if length < least:
            what = f"the run is {length:.3g} m long"
            remedy = f"choose points of {name} that lie {least:.3g} m apart or more"
            raise BadInputError(what, where, remedy)
        return cls.of_curve(edit, curve, first, last, verb)

    @classmethod
    def of_curve(cls, edit: Transaction, curve: int, first: int, last: int, verb: str) -> LinePart:
        """Take the part between two places among the points of a curve."""
        state = edit.state
        line = state.line_of(curve)
        name = str(state.lines.name[line])
        where = f"in {verb} of {name}"
        if state.lines.boundary[line] >= 0 or not state.lines.planar[line]:
            what = f"{name} is a boundary curve or a curve in space"
            remedy = "draw on sections, waterlines, buttocks and diagonals; re-shape this one"
            raise BadInputError(what, where, remedy)
        asked = edit.pending.asked(FieldMoves)
        fields = [] if asked is None else asked.fields
        if any(isinstance(each, ReshapeField) and each.curve == curve for each in fields):
            what = f"{name} is given another shape in this edit already"
            raise BadInputError(what, where, "use two edits")
        rows: IntArray = state.curves.rows[curve]
        return cls(state, curve, verb, rows, first, last, whole_curve(state, curve, verb))

    @property
    def name(self) -> str:
        """The name of the line."""
        return str(self.state.lines.name[self.state.line_of(self.curve)])

    @property
    def where(self) -> str:
        """For errors."""
        return f"in {self.verb} of {self.name}"

    @property
    def ends(self) -> tuple[int, int]:
        """The two points, in order along the curve."""
        return int(self.rows[self.first]), int(self.rows[self.last])

    @property
    def inner(self) -> IntArray:
        """The points between them."""
        return self.rows[self.first + 1 : self.last]

    def side(self, row: int) -> int:
        """Give the side of a point on which the curve stands."""
        return int(self.state.rows.curve[row, 0] != self.curve)

    def kind(self, row: int) -> PointKind:
        """Give how the curve passes a point."""
        return PointKind(int(self.state.rows.kind[row, self.side(row)]))

    def refuse_blocked(self, *, knuckles: bool) -> None:
        """Refuse where something between the ends is not to be moved, naming all of one sort.

        `knuckles` may give way if so.
        """
        state, inner = self.state, self.inner
        kinds = np.array([self.kind(row) for row in inner.tolist()], np.int64)
        bends = (kinds == PointKind.TANGENT) | ((kinds == PointKind.KNUCKLE) & (not knuckles))
        names = sorted(each.name for each in features_on(state, self.curve, inner.tolist()))
        drawn = f"the feature {names[0]!r} lies in the run" if names else "it has kinks in the run"
        for rows, why, remedy in (
            (inner[state.rows.sort[inner] == Sort.PLACED], "placed points lie in the run",
             "delete or unpin them (edit.delete, edit.unpin), or choose other ends"),
            (inner[on_profile(state)[inner]], "points in the centre plane lie in the run",
             "choose ends between which the line is clear of the profile"),
            (inner[on_flat(state)[inner]], "points of a flat lie in the run",
             "choose ends outside the flat, or move its border (edit.reshape)"),
            (inner[state.rows.contact[inner]], "boundary curves cross the run",
             "choose ends on one side of them"),
            (inner[bends], drawn, "make its points smooth (edit.set_kind), or choose other ends"),
            (inner[: len(names)], drawn, "choose ends outside it"),
        ):  # fmt: skip
            self.blocked(rows, why, remedy)

    def refuse_driven_ends(self) -> None:
        """Refuse where an end is computed from a line that has no room to be held there."""
        ends = [row for row in self.ends if self.driver(row) >= 0 and not self.has_room(row)]
        remedy = "choose another end, or make it shared (edit.set_role)"
        self.blocked(ends, "another line drives an end of the run", remedy)

    def driver(self, row: int) -> int:
        """Give the curve that a point is computed from and that fields move; -1 if none."""
        still = on_profile(self.state)[row] or on_flat(self.state)[row]
        return -1 if still else int(self.state.rows.driver[row])

    def has_room(self, row: int) -> bool:
        """Tell whether the driver of a point has no other point near it."""
        state = self.state
        step = state.rows.xyz[state.curves.rows[self.driver(row)]] - state.rows.xyz[row]
        return float(np.sqrt((step * step).sum(axis=1)).min()) >= state.tolerances.factor * _NEAR

    def blocked(self, rows: Sequence[int] | IntArray, why: str, remedy: str) -> None:
        """Refuse if there are such points."""
        names = tuple(address(self.state, int(row)) for row in rows)
        if names:
            raise BlockedRunError(self.name, names, why, remedy)


def _curve_of(state: HullState, line: int, points: tuple[int, int], where: str) -> int:
    """Find the one curve of a line that two points define."""
    name = str(state.lines.name[line])
    if points[0] == points[1]:
        raise BadInputError("both ends are one point", where, f"give two points of {name}")
    on: list[int] = []
    for row in points:
        curves = [each for each in state.lines.curves[line] if each in state.rows.curve[row]]
        if not curves:
            what = f"{address(state, row)} is no point of {name}"
            raise BadInputError(what, where, f"give two points of {name}")
        if row not in state.curves.rows[curves[0]]:
            what = f"{address(state, row)} does not define {name}"
            remedy = "give it another role (edit.set_role), or choose a point that does"
            raise BadInputError(what, where, remedy)
        on.append(int(curves[0]))
    if on[0] != on[1]:
        what = f"the points lie on two pieces of {name}"
        raise BadInputError(what, where, "choose two points of one piece")
    return on[0]


@attrs.define(eq=False)
class Mark:
    """A place of the run at which the curve has a point.

    Attributes
    ----------
    row : int
        The point.
    goal : (3,), m
        The place.
    at : float, m
        How far along the run.
    start : float, m
        Parameter on the old curve from which it comes.
    holder : int
        The point that its driver is given there; -1 if it moves by itself.
    """

    row: int
    goal: FloatArray
    at: float
    start: float
    holder: int = -1

    @property
    def mover(self) -> int:
        """The point that is moved."""
        return self.row if self.holder < 0 else self.holder

    def moves(self, state: HullState) -> bool:
        """Tell whether it can be moved: by itself, or by what its driver was given."""
        return self.holder >= 0 or int(state.rows.driver[self.row]) < 0


def held_marks(
    edit: Transaction, asked: LinePart, marks: Sequence[Mark], *, drop: bool
) -> list[Mark]:
    """Give the lines that drive points of the part a point of their own there.

    One that has a point near by is given none: if `drop`, the crossing is watched from now on,
    else it goes where its driver goes.
    """
    state, kept = edit.state, list[Mark]()
    for mark in marks:
        driver = asked.driver(mark.row)
        if driver < 0:
            kept.append(mark)
            continue
        if asked.has_room(mark.row):
            place = state.rows.xyz[mark.row].copy()
            mark.holder = int(edit.maker.points([PointSpec(driver, place, Sort.ADOPTED)])[0])
            insert_defining_point(edit.maker, driver, mark.holder)
            edit.pending.curves.add(driver)
            edit.pending.structural = True
        elif drop:
            edit.maker.roles(np.array([mark.row]), np.array([int(Role.WATCHED)]))
            edit.journal.put(state.rows.limit, [mark.row], [2.0 * state.tolerances.adoption])
            edit.pending.notes.append(
                f"{address(state, mark.row)} is watched now: what drives it has a point beside it"
            )
            continue
        kept.append(mark)
    return kept


def lead(
    edit: Transaction, asked: LinePart, marks: Sequence[Mark], new: SplineBatch,
    radius: tuple[float, float] | None, normals: FloatArray,
) -> None:  # fmt: skip
    """Ask for the field that brings marks where they are to be, and takes along what is around.

    `new` is the curve as it is to be, `normals` (n, 3) are those of the hull at its old points.
    """
    state, curve, old = edit.state, asked.curve, asked.old
    own = np.array([mark.mover for mark in marks], np.int64)
    first, last = max(asked.first - _AROUND, 0), min(asked.last + _AROUND, len(old.knot) - 1)
    edit.pending.ask(FieldMoves).fields.append(
        ReshapeField(
            curve, old, new, normals, own,
            np.array([mark.goal for mark in marks]).reshape(-1, 3), state.rows.xyz[own].copy(),
            radius, state.family(state.line_of(curve)).axis == 0,
            (float(old.knot[first]), float(old.knot[last])), flat_distance(state, old.xyz), False,
        )
    )  # fmt: skip
    edit.pending.moved_curves.add(curve)
    # Its adopted points stay where they are put, though driven ones beside them move.
    rows: IntArray = state.curves.rows[curve]
    edit.pending.held |= set(rows[state.rows.sort[rows] == Sort.ADOPTED].tolist())


def designed(state: HullState, curve: int, marks: list[Mark]) -> SplineBatch:
    """Loft the curve as it is to be."""
    data = curve_data(state, np.array([curve]))
    xyz, goal = data.xyz.copy(), {mark.row: mark.goal for mark in marks}
    for place, row in enumerate(state.curves.rows[curve].tolist()):
        xyz[place] = goal.get(row, xyz[place])
    return loft(
        attrs.evolve(data, xyz=xyz), [f"the new shape of {state.lines.name[state.line_of(curve)]}"]
    )
