"""Straighten a run of a line, or round a corner of it; the hull around it follows.

The points of the line between two of its points are put on the shape that is drawn, shared
crossings where it meets their planes. Adopted points give way.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from assoc_hull.edit.field_moves import AskedRun, DrawnRuns, features_on
from assoc_hull.edit.hull_normals import normals_at
from assoc_hull.edit.lines.line_planes import checked_in_planes
from assoc_hull.edit.modifications.line_parts import LinePart, Mark, designed, held_marks, lead
from assoc_hull.edit.modifications.reshape import Fade, fade_radii
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.curves import EndKind, FloatArray, PointKind
from assoc_hull.geometry.polylines.drawn_run import DrawnRun
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.segments import evaluate
from assoc_hull.model.kinds import Sort
from assoc_hull.model.make_objects import PointSpec
from assoc_hull.model.tables import Ends

__all__ = ["round_corner", "straighten"]

_SAME = 1e-6
"""Times `Tolerances.factor`: places as near as this (m) are one."""

_ALONG = 1e-9
"""A tangent point whose direction differs from that of a run by less than this is along it."""

_STEP = np.radians(15.0)
"""An arc has a point after this angle at least; a spline then lies on it within 1e-5 of its
radius."""

_LEAST = 5
"""So many points an arc has at least."""


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
    asked = LinePart.of(edit, line, points, "straighten")
    at = edit.state.rows.xyz
    drawn = DrawnRun.straight(at[asked.ends[0]].copy(), at[asked.ends[1]].copy())
    if _is_drawn(asked):
        edit.pending.notes.append(f"{asked.name} runs straight there already")
        return
    asked.refuse_driven_ends()
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
    asked = LinePart.of(edit, line, points, "round")
    # first: a radius that fits beside what is in the way would be of no use
    asked.refuse_driven_ends()
    asked.refuse_blocked(knuckles=True)
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
    _draw(edit, asked, drawn, fade)


def _is_drawn(asked: LinePart) -> bool:
    """Tell whether a straight run is a feature there already."""
    return any(
        each.kind == "straight" and (each.points[0], each.points[-1]) == asked.ends
        for each in features_on(asked.state, asked.curve, asked.ends)
    )


def _refuse_bent_ends(asked: LinePart, drawn: DrawnRun) -> None:
    """Refuse where a tangent point at an end has another direction than the run."""
    for row, way in zip(asked.ends, (drawn.first, drawn.last), strict=True):
        if asked.kind(row) is PointKind.TANGENT and row not in asked.rows[[0, -1]]:
            given = _unit(asked.state.rows.direction[row, asked.side(row)])
            if float(np.abs(given - way).max()) > _ALONG:
                why = "an end is a tangent point with another direction"
                remedy = "make it smooth or a knuckle (edit.set_kind), or choose another"
                asked.blocked([row], why, remedy)


def _unit(vector: FloatArray) -> FloatArray:
    found: FloatArray = vector / np.sqrt((vector * vector).sum())
    return found


# --------------------------------------------------------------------------------------
# Drawing it.


def _draw(edit: Transaction, asked: LinePart, drawn: DrawnRun, fade: Fade) -> None:
    """Give the curve its new recipe, and ask for the field that brings its points there."""
    _refuse_bent_ends(asked, drawn)
    state, curve, old = edit.state, asked.curve, asked.old
    middle = closest_points(old, 0, 0.5 * (drawn.start + drawn.end)[None])[1]
    radius = fade_radii(state, fade, middle)
    normals = normals_at(state, asked.rows)
    marks = held_marks(edit, asked, _marks(asked, drawn), drop=True)
    marks, breaks, arc = _with_arc(edit, asked, drawn, marks)
    _define(edit, asked, marks)
    for row, way in breaks.items():
        _set_tangent(edit, asked, row, way)
    moved = [mark for mark in marks if mark.holder >= 0 or mark.row not in asked.ends]
    lead(edit, asked, moved, designed(state, curve, marks), radius, normals)
    edit.pending.ask(DrawnRuns).runs.append(AskedRun(curve, tuple(breaks), arc, drawn))


def _marks(asked: LinePart, drawn: DrawnRun) -> list[Mark]:
    """Give both ends, and where the run takes the crossings between them."""
    state, knot = asked.state, asked.old.knot
    found = [Mark(asked.ends[0], drawn.start, 0.0, float(knot[asked.first]))]
    for place in range(asked.first + 1, asked.last):
        row = int(asked.rows[place])
        if state.rows.sort[row] == Sort.CROSSING:
            goal = _goal(asked, drawn, row)
            along = float(drawn.length(goal[None])[0])
            found.append(Mark(row, goal, along, float(knot[place])))
    whole = float(drawn.length(drawn.end[None])[0])
    found.append(Mark(asked.ends[1], drawn.end, whole, float(knot[asked.last])))
    back = np.diff([mark.at for mark in found]) <= state.tolerances.coincident
    for at in np.flatnonzero(back).tolist():
        why = "the run does not cross these lines one after the other"
        remedy = "choose other ends, or remove one of the lines (edit.remove_line)"
        asked.blocked([mark.row for mark in found[at : at + 2]], why, remedy)
    return found


def _goal(asked: LinePart, drawn: DrawnRun, row: int) -> FloatArray:
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
    goal: FloatArray = met[int((step * step).sum(axis=1).argmin())]
    return checked_in_planes(state, [other, state.line_of(asked.curve)], goal, asked.where)


def _with_arc(
    edit: Transaction, asked: LinePart, drawn: DrawnRun, marks: list[Mark]
) -> tuple[list[Mark], dict[int, FloatArray], int]:
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
        Mark(row, goal, place, start)
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


def _define(edit: Transaction, asked: LinePart, marks: list[Mark]) -> None:
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


def _set_tangent(edit: Transaction, asked: LinePart, row: int, way: FloatArray) -> None:
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
