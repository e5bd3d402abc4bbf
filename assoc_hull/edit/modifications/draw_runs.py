"""Straighten a run of a line, or round a corner of it; the hull around it follows.

The points of the line between two of its points are put on the shape that is drawn: shared
crossings where it meets their planes; where another line drives, that line is given a point there,
or the crossing stops defining this one. Adopted points give way. What lies around takes the normal
change of the line as in a re-shape.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import attrs
import numpy as np

from assoc_hull.edit.crossings.adopted_points import insert_defining_point
from assoc_hull.edit.displacement_field import flat_distance, on_flat, on_profile
from assoc_hull.edit.drawn_runs import AskedRun, DrawnRuns, features_on
from assoc_hull.edit.field_moves import FieldMoves
from assoc_hull.edit.hull_normals import normals_at
from assoc_hull.edit.lines.line_planes import checked_in_planes
from assoc_hull.edit.modifications.reshape import Fade, ReshapeField, fade_radii, whole_curve
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, BlockedRunError, GeometryError
from assoc_hull.geometry.curves import EndKind, FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.polylines.drawn_run import DrawnRun
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.evaluation import evaluate
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.model.address import address
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.lofting import curve_data
from assoc_hull.model.make_objects import PointSpec
from assoc_hull.model.tables import Ends, HullState

__all__ = ["round_corner", "straighten"]

_SHORTEST = 1e-3
"""A run has this part of the length of the ship at least."""

_NEAR = 0.15
"""Times `Tolerances.factor`: a curve with a point as near as this (m) is given no other."""

_SAME = 1e-6
"""Times the same: places as near as this (m) are one."""

_ALONG = 1e-9
"""A tangent point whose direction differs from that of a run by less than this is along it."""

_STEP = np.radians(15.0)
"""An arc has a point after this angle at least; a spline then lies on it within 1e-5 of its
radius."""

_LEAST = 5
"""So many points an arc has at least."""

_AROUND = 3
"""So many points beyond its ends a run changes the line, as far as is worth following."""


def straighten(edit: Transaction, line: int, points: tuple[int, int], fade: Fade = "auto") -> None:
    """Let a line run straight between two of its points, with tangent points at both.

    Parameters
    ----------
    edit : Transaction
        The edit.
    line : int
        A section, waterline, buttock or diagonal.
    points : (int, int)
        The two points; they stay where they are.
    fade : "auto" or (r_x, r_g) in m
        How the change of the hull around fades.

    Raises
    ------
    BlockedRunError
        Placed points, features, flats or the centre plane in the run, or lines that it would no
        longer cross in their order; with what to do.
    BadInputError
        Points that are not of one curve of the line, or too near one another.
    """
    asked = _Asked.of(edit, line, points, "straighten")
    at = edit.state.rows.xyz
    drawn = DrawnRun.straight(at[asked.ends[0]].copy(), at[asked.ends[1]].copy())
    if asked.is_drawn():
        edit.pending.notes.append(f"{asked.name} runs straight there already")
        return
    asked.refuse_blocked(knuckles=False)
    _draw(edit, asked, drawn, fade)


def round_corner(
    edit: Transaction, line: int, points: tuple[int, int], radius: float, fade: Fade = "auto"
) -> None:
    """Let a line turn between two of its points in an arc that touches both sides.

    The sides are the straight lines along which the line comes to the first point and leaves the
    second; they stay as far as the arc leaves room. Knuckles between them give way.

    Parameters
    ----------
    edit, line, points, fade
        As `straighten` takes them.
    radius : float, m
        Of the arc.

    Raises
    ------
    BlockedRunError, BadInputError
        As `straighten`; and where the sides do not meet in a corner, or the arc does not fit.
    """
    asked = _Asked.of(edit, line, points, "round")
    old, at = asked.old, edit.state.rows.xyz
    i, j = asked.first, asked.last
    came = old.leave[i] if i == 0 else old.arrive[i]
    goes = old.arrive[j] if j == len(old.knot) - 1 else old.leave[j]
    try:
        drawn = DrawnRun.rounded(
            at[asked.ends[0]].copy(), _unit(came), at[asked.ends[1]].copy(), _unit(goes), radius
        )
    except GeometryError as error:
        raise error.at(asked.where) from None
    asked.refuse_blocked(knuckles=True)
    _draw(edit, asked, drawn, fade)


def _unit(vector: FloatArray) -> FloatArray:
    found: FloatArray = vector / np.sqrt((vector * vector).sum())
    return found


# --------------------------------------------------------------------------------------
# What is asked for, and what stands in its way.


@attrs.frozen(eq=False)
class _Asked:
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
    def of(cls, edit: Transaction, line: int, points: tuple[int, int], verb: str) -> _Asked:
        """Find the run, or say why there is none."""
        state = edit.state
        name = str(state.lines.name[line])
        where = f"in {verb} of {name}"
        if state.lines.boundary[line] >= 0 or not state.lines.planar[line]:
            what = f"{name} is a boundary curve or a curve in space"
            remedy = "draw runs of sections, waterlines, buttocks and diagonals; re-shape this one"
            raise BadInputError(what, where, remedy)
        curve = _curve_of(state, line, points, where)
        asked = edit.pending.asked(DrawnRuns)
        if asked is not None and any(run.curve == curve for run in asked.runs):
            raise BadInputError(f"a run of {name} is drawn already", where, "use two edits")
        rows: IntArray = state.curves.rows[curve]
        first, last = sorted(int(np.flatnonzero(rows == row)[0]) for row in points)
        step = state.rows.xyz[rows[last]] - state.rows.xyz[rows[first]]
        length, least = float(np.sqrt((step * step).sum())), _SHORTEST * state.particulars.length
        if length < least:
            what = f"the run is {length:.3g} m long"
            remedy = f"choose points of {name} that lie {least:.3g} m apart or more"
            raise BadInputError(what, where, remedy)
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

    def is_drawn(self) -> bool:
        """Tell whether a straight run is a feature there already."""
        return any(
            each.kind == "straight" and (each.points[0], each.points[-1]) == self.ends
            for each in features_on(self.state, self.curve, self.ends)
        )

    def refuse_blocked(self, *, knuckles: bool) -> None:
        """Refuse where something between the ends is not to be moved, naming all of one sort.

        `knuckles` may give way if so.
        """
        state, inner = self.state, self.inner
        ends = np.array(self.ends)
        computed = (state.rows.driver[ends] >= 0) & ~state.rows.contact[ends]
        kinds = np.array([self.kind(row) for row in inner.tolist()], np.int64)
        bends = (kinds == PointKind.TANGENT) | ((kinds == PointKind.KNUCKLE) & (not knuckles))
        names = sorted(each.name for each in features_on(state, self.curve, inner.tolist()))
        drawn = f"the feature {names[0]!r} lies in the run" if names else "it has kinks in the run"
        for rows, why, remedy in (
            (ends[computed], "another line drives an end of the run",
             "choose another end, or make it shared (edit.set_role)"),
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

    def refuse_bent_ends(self, drawn: DrawnRun) -> None:
        """Refuse where a tangent point at an end has another direction than the run."""
        for row, way in zip(self.ends, (drawn.first, drawn.last), strict=True):
            if self.kind(row) is PointKind.TANGENT and row not in self.rows[[0, -1]]:
                given = _unit(self.state.rows.direction[row, self.side(row)])
                if float(np.abs(given - way).max()) > _ALONG:
                    why = "an end is a tangent point with another direction"
                    remedy = "make it smooth or a knuckle (edit.set_kind), or choose another"
                    self.blocked([row], why, remedy)

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


# --------------------------------------------------------------------------------------
# Drawing it.


@attrs.define(eq=False)
class _Mark:
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


def _draw(edit: Transaction, asked: _Asked, drawn: DrawnRun, fade: Fade) -> None:
    """Give the curve its new recipe, and ask for the field that brings its points there."""
    asked.refuse_bent_ends(drawn)
    state, curve, old = edit.state, asked.curve, asked.old
    middle = closest_points(old, 0, 0.5 * (drawn.start + drawn.end)[None])[1]
    radius = fade_radii(state, fade, middle)
    flat, normals = flat_distance(state, old.xyz), normals_at(state, asked.rows)
    marks = _held(edit, asked, _marks(asked, drawn))
    marks, breaks, arc = _with_arc(edit, asked, drawn, marks)
    _define(edit, asked, marks)
    for row, way in breaks.items():
        _set_tangent(edit, asked, row, way)
    own = np.array([mark.mover for mark in marks[1:-1]], np.int64)
    goals = np.array([mark.goal for mark in marks[1:-1]]).reshape(-1, 3)
    section = state.family(state.line_of(curve)).axis == 0
    first, last = max(asked.first - _AROUND, 0), min(asked.last + _AROUND, len(old.knot) - 1)
    edit.pending.ask(FieldMoves).fields.append(
        ReshapeField(
            curve, old, _designed(state, curve, marks), normals, own, goals,
            state.rows.xyz[own].copy(), radius, section,
            (float(old.knot[first]), float(old.knot[last])), flat, False,
        )
    )  # fmt: skip
    edit.pending.ask(DrawnRuns).runs.append(AskedRun(curve, tuple(breaks), arc, drawn))
    edit.pending.moved_curves.add(curve)


def _marks(asked: _Asked, drawn: DrawnRun) -> list[_Mark]:
    """Give both ends, and where the run takes the crossings between them."""
    state, knot = asked.state, asked.old.knot
    found = [_Mark(asked.ends[0], drawn.start, 0.0, float(knot[asked.first]))]
    for place in range(asked.first + 1, asked.last):
        row = int(asked.rows[place])
        if state.rows.sort[row] == Sort.CROSSING:
            goal = _goal(asked, drawn, row)
            along = float(drawn.length(goal[None])[0])
            found.append(_Mark(row, goal, along, float(knot[place])))
    whole = float(drawn.length(drawn.end[None])[0])
    found.append(_Mark(asked.ends[1], drawn.end, whole, float(knot[asked.last])))
    back = np.diff([mark.at for mark in found]) <= state.tolerances.coincident
    for at in np.flatnonzero(back).tolist():
        why = "the run does not cross these lines one after the other"
        remedy = "choose other ends, or remove one of the lines (edit.remove_line)"
        asked.blocked([mark.row for mark in found[at : at + 2]], why, remedy)
    return found


def _goal(asked: _Asked, drawn: DrawnRun, row: int) -> FloatArray:
    """Give where the run meets the plane of the line that crosses at a point."""
    state, lines = asked.state, asked.state.lines
    other = state.line_of(int(state.rows.curve[row, 1 - asked.side(row)]))
    if not lines.planar[other]:
        asked.blocked([row], "a curve in space crosses the run", "choose ends on one side of it")
    normal, offset = lines.normal[other], float(lines.offset[other])
    met = drawn.meet(normal, offset)
    if not len(met):
        why = "the run does not come to the plane of this line"
        asked.blocked([row], why, "choose other ends, or remove the line (edit.remove_line)")
    step = met - state.rows.xyz[row]
    goal: FloatArray = met[int((step * step).sum(axis=1).argmin())].copy()
    for line in (other, state.line_of(asked.curve)):
        goal[lines.normal[line] == 1.0] = lines.offset[line]
    return goal


def _held(edit: Transaction, asked: _Asked, marks: list[_Mark]) -> list[_Mark]:
    """Give the lines that drive points of the run a point of their own there.

    One that has a point near by is given none: then the crossing is watched from now on.
    """
    state, kept = edit.state, list[_Mark]()
    for mark in marks:
        driver = int(state.rows.driver[mark.row])
        if driver < 0 or mark in (marks[0], marks[-1]):
            kept.append(mark)
            continue
        place = state.rows.xyz[mark.row].copy()
        step = state.rows.xyz[state.curves.rows[driver]] - place
        if float(np.sqrt((step * step).sum(axis=1)).min()) >= state.tolerances.factor * _NEAR:
            mark.holder = int(edit.maker.points([PointSpec(driver, place, Sort.ADOPTED)])[0])
            insert_defining_point(edit.maker, driver, mark.holder)
            edit.pending.curves.add(driver)
            kept.append(mark)
            continue
        edit.maker.roles(np.array([mark.row]), np.array([int(Role.WATCHED)]))
        edit.journal.put(state.rows.limit, [mark.row], [2.0 * state.tolerances.adoption])
        edit.pending.notes.append(
            f"{address(state, mark.row)} is watched now: it drove the run, and has no room there"
        )
    return kept


def _with_arc(
    edit: Transaction, asked: _Asked, drawn: DrawnRun, marks: list[_Mark]
) -> tuple[list[_Mark], dict[int, FloatArray], int]:
    """Add the points that hold an arc; give also the ends of pieces, and which of these it is.

    With each end comes the direction there.
    """
    first, last = marks[0], marks[-1]
    if not drawn.radius:
        return marks, {first.row: drawn.first, last.row: drawn.last}, -1
    state = edit.state
    low, high = drawn.length(drawn.joins).tolist()
    same = _SAME * state.tolerances.factor
    at = np.array([mark.at for mark in marks])
    places = np.concatenate([[low, high], _between(at, low, high, drawn.radius)])
    places = places[np.abs(places[:, None] - at).min(axis=1) > same]
    goals = drawn.on_arc((places - low) / drawn.radius)
    goals = checked_in_planes(state, [state.line_of(asked.curve)], goals, asked.where)
    starts = np.interp(places, at, [mark.start for mark in marks])
    old = evaluate(asked.old, np.zeros(len(places), np.int64), starts)
    made = edit.maker.points([PointSpec(asked.curve, place, Sort.ADOPTED) for place in old])
    fresh = [
        _Mark(row, goal, place, start)
        for row, goal, place, start in zip(
            made.tolist(), goals, places.tolist(), starts.tolist(), strict=True
        )
    ]
    found = sorted([*marks, *fresh], key=lambda mark: mark.at)
    joins = [min(found, key=lambda mark: abs(mark.at - place)) for place in (low, high)]
    breaks = {first.row: drawn.first, joins[0].row: drawn.first}
    arc = list(breaks).index(joins[0].row)
    return found, breaks | {joins[1].row: drawn.last, last.row: drawn.last}, arc


def _between(at: FloatArray, low: float, high: float, radius: float) -> FloatArray:
    """Give the places, m, at which an arc from `low` to `high` wants points besides those `at`."""
    inside = at[(at > low) & (at < high)]
    edges = np.concatenate([[low], inside, [high]])
    least = (_LEAST - 1 + len(edges) - 2) // (len(edges) - 1)
    found = [np.zeros(0)]
    for begin, end in pairwise(edges.tolist()):
        parts = max(int(np.ceil((end - begin) / (radius * _STEP) - 1e-9)), 1)
        parts = max(parts, least) if end - begin > 0.5 * (high - low) / (len(edges) - 1) else parts
        found.append(np.linspace(begin, end, parts + 1)[1:-1])
    return np.concatenate(found)


def _define(edit: Transaction, asked: _Asked, marks: list[_Mark]) -> None:
    """Let the curve be made through the marks; adopted points between its ends have gone."""
    state, curve = edit.state, asked.curve
    run = np.array([mark.row for mark in marks], np.int64)
    beside = asked.rows[: asked.first], asked.rows[asked.last + 1 :]
    whole = np.concatenate([beside[0], run, beside[1]])
    edit.maker.define(curve, whole)
    inner = asked.inner
    edit.maker.remove_rows(inner[state.rows.sort[inner] == Sort.ADOPTED])
    for row in inner[state.rows.alive[inner]].tolist():
        kinds = state.rows.kind[row].copy()
        kinds[asked.side(row)] = PointKind.SMOOTH
        edit.journal.put(state.rows.kind, [row], kinds[None])
    edit.pending.structural = True
    edit.pending.curves.add(curve)
    # Its other adopted points stay, though driven ones beside them move.
    edit.pending.held |= set(whole[state.rows.sort[whole] == Sort.ADOPTED].tolist())


def _set_tangent(edit: Transaction, asked: _Asked, row: int, way: FloatArray) -> None:
    """Let the curve pass a point along a direction; a knuckle stays one."""
    state, curve = edit.state, asked.curve
    at = [int(state.curves.rows[curve][end]) for end in (0, -1)]
    if row in at:
        ends: Ends = state.curves.ends[curve]
        kinds, vectors = list(ends.kind), list(ends.vector)
        x, y, z = way.tolist()
        kinds[at.index(row)], vectors[at.index(row)] = int(EndKind.TANGENT), (x, y, z)
        new = Ends((kinds[0], kinds[1]), (vectors[0], vectors[1]))
        edit.journal.set(state.curves.ends, [curve], [new])
    elif asked.kind(row) is PointKind.SMOOTH:
        side = asked.side(row)
        kinds_of, directions = state.rows.kind[row].copy(), state.rows.direction[row].copy()
        kinds_of[side], directions[side] = PointKind.TANGENT, way
        edit.journal.put(state.rows.kind, [row], kinds_of[None])
        edit.journal.put(state.rows.direction, [row], directions[None])


def _designed(state: HullState, curve: int, marks: list[_Mark]) -> SplineBatch:
    """Loft the curve as it is to be."""
    data = curve_data(state, np.array([curve]))
    xyz, goal = data.xyz.copy(), {mark.row: mark.goal for mark in marks}
    for place, row in enumerate(state.curves.rows[curve].tolist()):
        xyz[place] = goal.get(row, xyz[place])
    return loft(attrs.evolve(data, xyz=xyz), [f"the new shape of {state.curves.key[curve]}"])
