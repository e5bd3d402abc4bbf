"""Re-shape a curve: it takes the designer's new shape, and the hull around it follows.

The designer gives points within a span. Between them, and out to its ends, their displacements are
blended (quintic, curvature-continuous) and added to the present shape, so the curve keeps its
detail. `ReshapeField` lets the other points take the curve's normal change, fading with the
distance; what defines lines of a group that takes nothing from the curve's group stays.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import pair, places, shown
from assoc_hull.edit.crossings.adopted_points import insert_defining_point, insertion_index
from assoc_hull.edit.displacement_field import (
    FieldContext,
    PointDisplacements,
    flat_distance,
    move_normal,
    on_flat,
    on_profile,
    quintic_fade,
    row_spacing,
    station_spacing,
)
from assoc_hull.edit.field_moves import FieldMoves
from assoc_hull.edit.hull_normals import normals_at
from assoc_hull.edit.lines.line_planes import checked_in_planes
from assoc_hull.edit.modifications.points import pin
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.geometry.splines.segments import evaluate
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.links import generates
from assoc_hull.model.make_objects import PointSpec
from assoc_hull.model.network import curve_data
from assoc_hull.model.tables import HullState

__all__ = [
    "Fade",
    "ReshapeField",
    "fade_radii",
    "reshape",
    "whole_curve",
]

# --------------------------------------------------------------------------------------
# The field. For a waterline or a buttock the other points take the curve's normal change at the
# same x, fading with the distance seen along x; for a section the change at its nearest point seen
# along x, fading along the length.


@attrs.frozen(eq=False)
class ReshapeField:
    """The field of a re-shaped curve.

    Attributes
    ----------
    curve : int
        The curve.
    old, new : SplineBatch
        Its spline before, and the designer's.
    normal : (k, 3)
        Outward normals of the hull at the knots of `old`.
    rows, places : (r,) int, (r, 3), m
        The curve's own points, and where the designer's curve has them.
    start : (r, 3), m
        Where they were.
    radius : (float, float), m, or None
        Fade along the length and the girth; None: no other point moves.
    along_x : bool
        Whether the curve is a section, whose change fades along the length.
    span : (float, float), m
        Parameters on `old` between which the curve changes.
    flat : (k,), m
        Distance of the knots of `old` from the nearest border of a flat. Where another
        point is as far from it as the curve, it moves as much as the curve.
    across_flats : bool
        Whether flats are moved too.
    """

    curve: int
    old: SplineBatch
    new: SplineBatch
    normal: FloatArray
    rows: IntArray
    places: FloatArray
    start: FloatArray
    radius: tuple[float, float] | None
    along_x: bool
    span: tuple[float, float]
    flat: FloatArray
    across_flats: bool

    @property
    def strict(self) -> bool:
        """Whether the curve's own points move and no other."""
        return self.radius is None

    def shift(self, ground: FieldContext, part: float) -> PointDisplacements:
        """Give the displacements for a part of the whole change."""
        own = part * (self.places - self.start)
        if self.radius is None:
            return PointDisplacements(self.rows, own, np.zeros(0, np.int64))
        others = np.setdiff1d(ground.free(), self.rows, assume_unique=True)
        others = others[~(ground.state.rows.reader[others] == self.curve).any(axis=1)]
        others = others[~_define_givers(ground.state, others, self.curve)]
        distance = ground.flat_distances(others)
        amount, at = self._amount(ground.state.rows.xyz[others])
        amount = part * amount
        if not self.across_flats:
            own_distance = np.interp(at, self.old.knot, self.flat)
            fade = np.minimum(self.radius[1], own_distance)
            # The border of a flat lies on it: all around moves as much.
            share = np.divide(distance, fade, out=np.ones(len(fade)), where=fade > 0.0)
            amount = amount * (1.0 - quintic_fade(share))
        reach = amount != 0.0
        rest = move_normal(ground, others[reach], amount[reach])
        return PointDisplacements(
            np.concatenate([self.rows, rest.rows]), np.concatenate([own, rest.delta]), rest.left
        )

    def exact(self) -> tuple[IntArray, FloatArray]:
        """Give the curve's own points, which land on the designer's curve."""
        return self.rows, self.places

    def left(self, state: HullState, done: float) -> float:
        """Give the part of the change that is still to come, when a part is `done`."""
        return 1.0 - done

    def _amount(self, xyz: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give the faded normal change at points, and the parameter it comes from, (k,), m."""
        assert self.radius is not None
        if self.along_x:
            fade = quintic_fade((xyz[:, 0] - self.old.xyz[0, 0]) / self.radius[0])
            near = np.flatnonzero(fade != 0.0)
            flat = np.array(xyz[near])
            flat[:, 0] = self.old.xyz[0, 0]
            at, amount = np.zeros(len(xyz)), np.zeros(len(xyz))
            at[near] = closest_points(self.old, 0, flat)[0] if len(near) else 0.0
            amount[near] = fade[near] * self._change(at[near])
            return amount, at
        return self._at_same_x(xyz)

    def _at_same_x(self, xyz: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Take the change where the old curve has the same x, nearest seen along x."""
        assert self.radius is not None
        levels, place = np.unique(xyz[:, 0], return_inverse=True)
        met = intersect_planes(self.old, np.array([1.0, 0.0, 0.0]), levels)
        first = np.searchsorted(met.plane, np.arange(len(levels) + 1))
        amount, at = np.zeros(len(xyz)), np.zeros(len(xyz))
        change = self._change(met.t) if len(met.t) else np.zeros(0)
        for turn in range(int(np.diff(first).max(initial=0))):
            index = first[:-1][place] + turn
            has = np.flatnonzero(index < first[1:][place])
            step = xyz[has, 1:] - met.xyz[index[has], 1:]
            girth = np.sqrt((step * step).sum(axis=1))
            value = change[index[has]] * quintic_fade(girth / self.radius[1])
            stronger = np.abs(value) > np.abs(amount[has])
            amount[has[stronger]] = value[stronger]
            at[has[stronger]] = met.t[index[has[stronger]]]
        return amount, at

    def _change(self, at: FloatArray) -> FloatArray:
        """Give the normal change of the curve at parameters of the old one, (k,), m."""
        zero = np.zeros(len(at), np.int64)
        here = evaluate(self.old, zero, np.clip(at, 0.0, self.old.knot[-1]))
        inside = (at > self.span[0]) & (at < self.span[1])
        there = closest_points(self.new, 0, here)[1]
        normal = np.column_stack(
            [np.interp(at, self.old.knot, self.normal[:, i]) for i in range(3)]
        )
        length = np.sqrt((normal * normal).sum(axis=1))
        normal = normal / np.where(length > 1e-12, length, 1.0)[:, None]
        change: FloatArray = ((there - here) * normal).sum(axis=1)
        return np.where(inside, change, 0.0)


def _define_givers(state: HullState, rows: IntArray, curve: int) -> np.typing.NDArray[np.bool_]:
    """Tell which points define a line that generates on a curve there and takes nothing from it."""
    line, places = state.line_of(curve), state.rows.xyz[rows]
    found, known = np.zeros(len(rows), np.bool_), dict[int, bool]()
    for side in (0, 1):
        reader = state.rows.reader[rows, side]
        for other in np.unique(state.curves.line[reader[reader >= 0]]).tolist():
            mine = np.flatnonzero((reader >= 0) & (state.curves.line[reader] == other))
            if not state.rulings:
                group = int(state.lines.group[other])
                if group not in known:
                    known[group] = generates(state, other, line) == (True, False)
                found[mine] |= known[group]
                continue
            for i in mine.tolist():
                found[i] |= generates(state, other, line, places[i]) == (True, False)
    return found


# --------------------------------------------------------------------------------------
# The curve itself. Its own shared points take the exact intersections of the new shape with the
# planes of their other lines.

_NEAR = 0.5
"""A point of the new shape as near as this (m) to a crossing, in its plane, is that crossing."""

_CROWDED = 0.2
"""Old points as near as this (m) to a given one do not shape the designer's curve."""

Fade = Literal["auto"] | tuple[float, float] | None


@attrs.frozen(eq=False)
class _Design:
    """A curve's displacement: given points, their parameters, and how they blend.

    Attributes
    ----------
    at : (k,), m
        Parameters on the old curve, ascending; the ends of the stretch stand first and last.
    shift : (k, 3), m
        Displacements there.
    shape : (g, 3), m
        The designer's points, in order along the curve.
    shape_at : (g,), m
        Their parameters.
    """

    at: FloatArray
    shift: FloatArray
    shape: FloatArray
    shape_at: FloatArray

    def at_parameters(self, parameters: FloatArray) -> FloatArray:
        """Blend the displacements, (k, 3), m; zero outside the stretch."""
        index = np.clip(np.searchsorted(self.at, parameters, side="right") - 1, 0, len(self.at) - 2)
        low, high = self.at[index], self.at[index + 1]
        part = (parameters - low) / np.where(high > low, high - low, 1.0)
        fade = quintic_fade(part)[:, None]
        value = self.shift[index] * fade + self.shift[index + 1] * (1.0 - fade)
        inside = (parameters >= self.at[0]) & (parameters <= self.at[-1])
        return np.where(inside[:, None], value, 0.0)


def reshape(
    edit: Transaction,
    curve: int,
    points: ArrayLike,
    span: tuple[float, float],
    fade: Fade = "auto",
    *,
    across_flats: bool = False,
    fair: bool = False,
) -> list[int]:
    """Ask for a curve to take a new shape.

    Parameters
    ----------
    edit : Transaction
        The edit.
    curve : int
        The curve.
    points : (k, 3), m
        Points of the new shape, in the curve's plane. One that lies in the plane of a
        shared crossing gives that crossing its value; the others become placed points.
    span : (float, float), m
        Where the curve may change: x for waterlines, buttocks and boundary curves, z for
        sections.
    fade : "auto", (r_x, r_g) in m, or None
        How the change fades; None, the strict form: only this curve's own points move. No
        gap is mended in such an edit: those over their limit refuse it, or are kept as
        defects with ``gaps="report"``.
    across_flats : bool
        Whether the edit may move flats.
    fair : bool
        Whether the hull answers fairly, in place of the blend: the curve passes the points, and
        it and all others take the least change of their batten residuals.

    Returns
    -------
    list of int
        The placed points that were made.

    Raises
    ------
    BadInputError
        Points off the curve's plane, outside the span or beside a flat that stays, an empty span,
        radii not above 0;
        or points of the curve came or went in the same edit; fair with a fade or across flats.
    """
    state = edit.state
    section = state.family(state.line_of(curve)).axis == 0
    axis = 2 if section else 0
    span = pair(span, "span", positive=False)
    shape = _checked(state, curve, points, span, axis)
    old = whole_curve(state, curve, "reshape")
    if fair:
        _refuse_field(fade, across_flats=across_flats)
        return _ask_fairly(edit, curve, shape, span)
    radius = fade_radii(state, fade, shape)
    design = _design(old, shape, span, axis, _free_ends(state, curve))
    flat = flat_distance(state, old.xyz)
    if not across_flats:
        _refuse_on_flats(state, curve, old, design, flat)
    moved = _displaced(old, design, np.full(len(flat), np.inf) if across_flats else flat)
    moved[[0, -1]] = _slide(state, curve, old, moved[[0, -1]])
    new = _designed(state, curve, old, design, moved)
    rows = _own_rows(state, curve, old, design, across_flats=across_flats)
    goals = _goals(state, curve, rows, old.xyz + moved, new)
    start = state.rows.xyz[rows].copy()
    normals = normals_at(state, state.curves.rows[curve])
    made = _place(edit, curve, design.shape, rows, goals)
    edit.pending.ask(FieldMoves).fields.append(
        ReshapeField(
            curve, old, new, normals, rows, goals, start, radius, section,
            (float(design.at[0]), float(design.at[-1])), flat, across_flats,
        )
    )  # fmt: skip
    edit.pending.moved_curves.add(curve)
    return made


def _refuse_on_flats(
    state: HullState, curve: int, old: SplineBatch, design: _Design, flat: FloatArray
) -> None:
    """Refuse points that would move a flat: it stays as it is, and they would not be passed."""
    least = state.tolerances.coincident
    feet = evaluate(old, np.zeros(len(design.shape), np.int64), design.shape_at)
    away = np.abs(design.shape - feet).max(axis=1)
    held = (np.interp(design.shape_at, old.knot, flat) <= least) & (away > least)
    if held.any():
        name = state.lines.name[state.line_of(curve)]
        raise BadInputError(
            f"the point {design.shape[held][0].tolist()} lies beside a flat, which stays as it is",
            f"in reshape of {name}",
            "let the edit move flats (across_flats=True), or leave the point out",
        )


def _refuse_field(fade: Fade, *, across_flats: bool) -> None:
    """Refuse what a fair answer does not take: it finds its own reach, and keeps flats."""
    if across_flats or fade != "auto":
        name = "across_flats" if across_flats else "fade"
        what = "a fair answer finds its own reach and keeps flats as they are"
        raise BadInputError(what, "in reshape", f"leave fair or {name} out")


def _ask_fairly(
    edit: Transaction, curve: int, shape: FloatArray, span: tuple[float, float]
) -> list[int]:
    """Ask for a fair answer; give the placed points that were made where the curve has none."""
    # What solves sparse systems is imported by whoever asks for it.
    from assoc_hull.edit.modifications.fair_answer import FairAnswer, ShapeAsked

    state = edit.state
    made: list[int] = []
    asked: list[int] = []
    feet = closest_points(state.spline(curve), 0, shape)[1]
    for point, foot in zip(shape, feet, strict=True):
        row = _own_point(state, curve, point, asked)
        if row is None:
            row = int(edit.maker.points([PointSpec(curve, foot, Sort.PLACED)])[0])
            insert_defining_point(edit.maker, curve, row)
            edit.pending.structural = True
            edit.pending.curves.add(curve)
            made.append(row)
        elif state.rows.sort[row] == Sort.ADOPTED:
            pin(edit, row)
        asked.append(row)
    edit.pending.moved_curves.add(curve)
    section = state.family(state.line_of(curve)).axis == 0
    spacing = station_spacing(state) if section else None
    rows = np.array(asked, np.int64)
    name = str(state.lines.name[state.line_of(curve)])
    FairAnswer.of(edit).asked.append(ShapeAsked(name, rows, shape, curve, span, spacing))
    return made


def _own_point(state: HullState, curve: int, point: FloatArray, taken: Sequence[int]) -> int | None:
    """Give the curve's own point that a place is meant for: a crossing in its plane, or near by."""
    rows: IntArray = state.curves.rows[curve]
    rows = rows[~np.isin(rows, taken)]
    table = state.rows
    apart = np.abs(table.xyz[rows] - point).max(axis=1)
    for index in np.argsort(apart, kind="stable").tolist():
        row = int(rows[index])
        if apart[index] >= state.tolerances.factor * _NEAR:
            return None
        if table.sort[row] in (Sort.ADOPTED, Sort.PLACED):
            return row
        if table.role[row] == Role.SHARED and _in_other_plane(state, curve, row, point):
            return row
    return None


def _in_other_plane(state: HullState, curve: int, row: int, point: FloatArray) -> bool:
    """Tell whether a place lies in the plane of the other line of a crossing."""
    pair = state.rows.curve[row]
    other = state.line_of(int(pair[0] if pair[1] == curve else pair[1]))
    if not state.lines.planar[other]:
        return False
    away = float(state.lines.normal[other] @ point) - float(state.lines.offset[other])
    return abs(away) < 1e-9


def _checked(
    state: HullState, curve: int, points: ArrayLike, span: tuple[float, float], axis: int
) -> FloatArray:
    """Check the points against the span and the plane of the curve."""
    name = state.lines.name[state.line_of(curve)]
    shape = places(points, f"the new shape of {name}")
    off = (shape[:, axis] <= span[0]) | (shape[:, axis] >= span[1])
    if off.any():
        raise BadInputError(
            f"the point {shape[off][0].tolist()} lies outside the span {shown(span)}",
            f"in reshape of {name}",
            "widen the span or leave the point out",
        )
    return checked_in_planes(state, [state.line_of(curve)], shape, f"in reshape of {name}")


def _free_ends(state: HullState, curve: int) -> tuple[bool, bool]:
    """Tell whether each end may move: it does not if it lies on the profile."""
    rows: IntArray = state.curves.rows[curve]
    fixed = on_profile(state)[rows[[0, -1]]]
    return not fixed[0], not fixed[1]


def whole_curve(state: HullState, curve: int, verb: str) -> SplineBatch:
    """Give the published spline of a curve through the points that define it now.

    Raises
    ------
    BadInputError
        Points of it came or went in this edit.
    """
    old = state.spline(curve)
    if not np.array_equal(old.xyz, state.rows.xyz[state.curves.rows[curve]]):
        where = f"in {verb} of {state.lines.name[state.line_of(curve)]}"
        raise BadInputError("its points have changed in this edit", where, "use two edits")
    return old


def _slide(state: HullState, curve: int, old: SplineBatch, moved: FloatArray) -> FloatArray:
    """Let displaced ends slide along the curve into the plane of their boundary curve."""
    rows: IntArray = state.curves.rows[curve][[0, -1]]
    slopes = np.array([old.leave[0], old.arrive[-1]])
    out = moved.copy()
    for i, row in enumerate(rows.tolist()):
        other = state.line_of(int(state.rows.curve[row, 0]))
        if not state.rows.contact[row] or not state.lines.planar[other]:
            continue
        normal = state.lines.normal[other]
        along = float(slopes[i] @ normal)
        # a curve that runs along the plane would slide far
        if abs(along) > 0.1 * float(np.sqrt((slopes[i] * slopes[i]).sum())):
            out[i] = moved[i] - slopes[i] * (float(moved[i] @ normal) / along)
    return out


def _design(
    old: SplineBatch,
    shape: FloatArray,
    span: tuple[float, float],
    axis: int,
    free: tuple[bool, bool],
) -> _Design:
    """Find the stretch of the old curve, and how far each given point lies from it.

    Where the span reaches past a free end, the blend does too, and that end moves along.
    """
    at, foot, _ = closest_points(old, 0, shape)
    order = np.argsort(at, kind="stable")
    at, foot, shape = at[order], foot[order], shape[order]
    met = intersect_planes(old, np.eye(3)[axis], np.array(span))
    before, after = met.t[met.t < at[0]], met.t[met.t > at[-1]]
    reach = [float(np.abs(np.array(span) - end).min()) for end in old.xyz[[0, -1], axis]]
    low = float(before.max()) if len(before) else float(old.knot[0]) - free[0] * reach[0]
    high = float(after.min()) if len(after) else float(old.knot[-1]) + free[1] * reach[1]
    first, last = int(at[0] > low), int(at[-1] < high)
    zeros = np.zeros((1, 3))
    return _Design(
        np.concatenate([np.full(first, low), at, np.full(last, high)]),
        np.concatenate([zeros[:first], shape - foot, zeros[:last]]),
        shape,
        at,
    )


def _displaced(old: SplineBatch, design: _Design, flat: FloatArray) -> FloatArray:
    """Give the displacement of the old curve's points; it fades towards flats."""
    moved = design.at_parameters(old.knot)
    reference = float(np.interp(design.shape_at, old.knot, flat).min())
    if np.isfinite(reference) and reference > 0.0:
        moved = moved * (1.0 - quintic_fade(flat / reference))[:, None]
    return moved


def _designed(
    state: HullState, curve: int, old: SplineBatch, design: _Design, moved: FloatArray
) -> SplineBatch:
    """Loft the designer's curve: the old points displaced, and the given points."""
    data = curve_data(state, np.array([curve]))
    apart = np.abs(old.knot[:, None] - design.shape_at[None, :]).min(axis=1)
    free = data.kind == PointKind.SMOOTH
    inner = (old.knot > old.knot[0]) & (old.knot < old.knot[-1])
    replaced = apart < np.where(free & inner, state.tolerances.factor * _CROWDED, 1e-9)
    keep = ~replaced
    order = np.argsort(np.concatenate([old.knot[keep], design.shape_at]), kind="stable")
    given = len(design.shape)
    return loft(
        CurveData(
            np.array([0, len(order)]),
            np.concatenate([(old.xyz + moved)[keep], design.shape])[order],
            np.concatenate([data.kind[keep], np.zeros(given, np.int8)])[order],
            np.concatenate([data.direction[keep], np.zeros((given, 3))])[order],
            data.end_kind.copy(),
            data.end_vector.copy(),
        ),
        [f"the new shape of {state.lines.name[state.line_of(curve)]}"],
    )


def _own_rows(
    state: HullState, curve: int, old: SplineBatch, design: _Design, *, across_flats: bool
) -> IntArray:
    """Give the curve's own points that take the new shape: shared and adopted ones."""
    rows: IntArray = state.curves.rows[curve]
    inside = (old.knot >= design.at[0]) & (old.knot <= design.at[-1])
    shared = state.rows.role[rows] == Role.SHARED
    sort = state.rows.sort[rows]
    mine = inside & ((sort == Sort.ADOPTED) | ((sort == Sort.CROSSING) & shared))
    mine &= ~on_profile(state)[rows]
    if not across_flats:
        mine &= ~on_flat(state)[rows]
    chosen: IntArray = rows[mine]
    return chosen


def _goals(
    state: HullState, curve: int, rows: IntArray, displaced: FloatArray, new: SplineBatch
) -> FloatArray:
    """Give where own points go, (k, 3), m: crossings where the new shape meets their plane."""
    order: IntArray = state.curves.rows[curve]
    index = {row: i for i, row in enumerate(order.tolist())}
    goals = np.array([displaced[index[row]] for row in rows.tolist()]).reshape(-1, 3)
    for i, row in enumerate(rows.tolist()):
        if state.rows.sort[row] == Sort.CROSSING:
            goals[i] = _nearest_intersection(state, curve, row, goals[i], new)
    line = state.line_of(curve)
    if state.lines.planar[line]:
        goals[:, state.lines.normal[line] == 1.0] = state.lines.offset[line]
    return goals


def _nearest_intersection(
    state: HullState, curve: int, row: int, place: FloatArray, new: SplineBatch
) -> FloatArray:
    """Give the intersection of the new shape with the other line's plane nearest to a place."""
    pair = state.rows.curve[row]
    other = state.line_of(int(pair[0] if pair[1] == curve else pair[1]))
    if not state.lines.planar[other]:
        return place
    normal, offset = state.lines.normal[other].copy(), state.lines.offset[[other]].copy()
    met = intersect_planes(new, normal, offset)
    ends = new.xyz[[0, -1]]
    found = np.concatenate([met.xyz, ends[np.abs(ends @ normal - offset) < 1e-9]])
    out = place.copy()
    if len(found):
        step = found - place
        out = found[int(np.argmin((step * step).sum(axis=1)))].copy()
    out[normal == 1.0] = offset
    return out


def fade_radii(state: HullState, fade: Fade, shape: FloatArray) -> tuple[float, float] | None:
    """Give the radii of the fade, m: by default three spacings of sections, and of points."""
    if fade is None:
        return None
    if isinstance(fade, str) and fade == "auto":
        middle = shape[len(shape) // 2]
        girth = 3.0 * row_spacing(state, middle)
        return 3.0 * station_spacing(state), girth
    return pair(fade, "fade", positive=True)


def _place(
    edit: Transaction, curve: int, shape: FloatArray, rows: IntArray, goals: FloatArray
) -> list[int]:
    """Make placed points of the designer's points that no crossing holds.

    An adopted point near by takes the place, and is placed from then on; `goals` is
    changed accordingly.
    """
    state = edit.state
    made: list[int] = []
    for point in shape:
        held = len(goals) and float(np.abs(goals - point).max(axis=1).min()) < 1e-9
        if held or _at_crossing(state, curve, point):
            continue
        near = _adopted_near(state, rows, goals, point)
        if near is not None:
            goals[near] = point
            pin(edit, int(rows[near]))
            continue
        row = int(edit.maker.points([PointSpec(curve, point, Sort.PLACED)])[0])
        order: IntArray = state.curves.rows[curve]
        index = insertion_index(state.rows.xyz[order], point)
        edit.maker.define(curve, np.insert(order, index, row))
        edit.pending.structural = True
        edit.pending.curves.add(curve)
        made.append(row)
    return made


def _adopted_near(
    state: HullState, rows: IntArray, goals: FloatArray, point: FloatArray
) -> int | None:
    """Give the index of the nearest adopted point, if it is near enough."""
    mine = np.flatnonzero(state.rows.sort[rows] == Sort.ADOPTED)
    if not len(mine):
        return None
    step = goals[mine] - point
    away = np.sqrt((step * step).sum(axis=1))
    best = int(away.argmin())
    return int(mine[best]) if away[best] < state.tolerances.factor * _NEAR else None


def _at_crossing(state: HullState, curve: int, point: FloatArray) -> bool:
    """Tell whether a point lies where a crossing is that the curve does not define.

    Such a crossing comes along with its driver, which the field moves.
    """
    table = state.rows
    rows = np.flatnonzero(
        table.alive.data
        & (table.curve.data == curve).any(axis=1)
        & (table.sort.data == Sort.CROSSING)
    )
    least = state.tolerances.factor * _NEAR
    near = rows[np.abs(table.xyz[rows] - point).max(axis=1) < least]
    return any(_in_other_plane(state, curve, row, point) for row in near.tolist())
