"""Field edits: a displacement normal to the hull that fades along the length and the girth.

Every point in reach moves along its own freedom by the shortest way that gives the normal
displacement d: with n the outward normal and U the orthonormal basis of the freedom,

    delta = U U^T n d / |U^T n|^2.

Shared crossings and adopted points move. Driven ones are computed from their driver,
watched ones have no value, placed points stay; a flat is moved as a feature, never dented,
and ends on the profile move with the profile only. Re-shaping a curve and letting only its
shared crossings follow was measured to leave up to 80 % of the edit as gaps elsewhere.
"""

from __future__ import annotations

from collections.abc import Hashable
from typing import Protocol

import attrs
import numpy as np

from assoc_hull.edit.normals import free_normals, hull_normals, shape_stamp
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.splines.evaluation import sample
from assoc_hull.graph.journal import Journal
from assoc_hull.model.kinds import BoundaryKind, Role, Sort
from assoc_hull.model.state import HullState

__all__ = [
    "Field",
    "FieldContext",
    "Shift",
    "add_shifts",
    "bell",
    "context",
    "flat_distance",
    "land",
    "move_normal",
    "on_flat",
    "on_profile",
    "row_spacing",
    "sub_steps",
]

BoolArray = np.typing.NDArray[np.bool_]


def bell(part: FloatArray) -> FloatArray:
    """Give 1 - (10 s^3 - 15 s^4 + 6 s^5) for s below 1, else 0: a fade with flat ends.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.edit.field import bell
    >>> bell(np.array([0.0, 0.5, 1.0, 2.0])).tolist()
    [1.0, 0.5, 0.0, 0.0]
    """
    s = np.minimum(np.abs(part), 1.0)
    value: FloatArray = 1.0 - s * s * s * (10.0 - s * (15.0 - 6.0 * s))
    return np.where(s < 1.0, value, 0.0)


@attrs.frozen(eq=False)
class FieldContext:
    """What all fields of one (sub-)step read.

    Attributes
    ----------
    state : HullState
        The tables as they stand.
    normal : (rows, 3)
        Unit outward normals.
    free : (k,) int
        Points that fields may move.
    flat_distance : (k,), m
        Distance of each of these from the nearest border of a flat; inf if there is none.
    """

    state: HullState
    normal: FloatArray
    free: IntArray
    flat_distance: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.normal, self.free, self.flat_distance)


@attrs.frozen(eq=False)
class Shift:
    """Points with their displacements.

    Attributes
    ----------
    rows : (k,) int
        The points.
    delta : (k, 3), m
        Displacements, each along the point's freedom.
    left : (l,) int
        Points in reach that were left alone: their freedom is almost tangential.
    """

    rows: IntArray
    delta: FloatArray
    left: IntArray


class Field(Protocol):
    """A displacement of the hull."""

    @property
    def across_flats(self) -> bool:
        """Whether flats are moved too."""

    @property
    def strict(self) -> bool:
        """Whether nothing but its own points may move: no gap is mended, each is told."""

    def shift(self, ground: FieldContext, part: float) -> Shift:
        """Give the displacements for a part (of 1) of the whole field."""

    def exact(self) -> tuple[IntArray, FloatArray]:
        """Give points that must land in given places, to the bit, and the places."""

    def left(self, state: HullState, done: float) -> float:
        """Give the part (of 1) that the hull still lacks, when a part was asked for as `done`."""


def context(state: HullState, *, across_flats: bool = False) -> FieldContext:
    """Find the points that fields may move; kept as long as the hull stays as it is."""
    stamp = shape_stamp(state), state.rows.role.writes, across_flats
    known: tuple[Hashable, FieldContext] | None = state.kept.get(_KEPT)
    if known is None or known[0] != stamp:
        known = stamp, _context(state, across_flats)
        state.kept[_KEPT] = known
    return known[1]


_KEPT = "field context"


def _context(state: HullState, across_flats: bool) -> FieldContext:
    table = state.rows
    shared = (table.sort.data == Sort.CROSSING) & (table.role.data == Role.SHARED)
    free = table.alive.data & (shared | (table.sort.data == Sort.ADOPTED))
    free &= ~on_profile(state)
    if not across_flats:
        free &= ~on_flat(state)
    rows = np.flatnonzero(free)
    return FieldContext(
        state, hull_normals(state), rows, flat_distance(state, state.rows.xyz.data[rows])
    )


def _boundary_lines(state: HullState, kind: BoundaryKind) -> IntArray:
    found: IntArray = np.flatnonzero(state.lines.alive.data & (state.lines.boundary.data == kind))
    return found


def _of_lines(state: HullState, lines: IntArray) -> BoolArray:
    """Tell which points lie on curves of the given lines."""
    curve = state.rows.curve.data
    line = np.where(curve >= 0, state.curves.line.data[np.maximum(curve, 0)], -1)
    found = np.isin(line, lines)
    return np.asarray(found[:, 0] | found[:, 1])


def on_profile(state: HullState) -> BoolArray:
    """Tell which points lie in the centre plane: they move with the profile only."""
    ends = _boundary_lines(state, BoundaryKind.END)
    centre = np.abs(state.lines.normal.data[ends, 1]) == 1.0
    on_line = _of_lines(state, ends[state.lines.planar.data[ends] & centre])
    return np.asarray(on_line | (np.abs(state.rows.xyz.data[:, 1]) < 1e-9))


def on_flat(state: HullState) -> BoolArray:
    """Tell which points lie in a flat or on its border."""
    flats = _boundary_lines(state, BoundaryKind.FLAT)
    found = _of_lines(state, flats)
    for line in flats.tolist():
        if state.lines.planar.data[line]:
            off = (
                state.rows.xyz.data @ state.lines.normal.data[line] - state.lines.offset.data[line]
            )
            found |= np.abs(off) < 1e-9
    return found


def flat_distance(state: HullState, places: FloatArray) -> FloatArray:
    """Measure how far places (k, 3) lie from the nearest border of a flat, (k,), m."""
    distance = np.full(len(places), np.inf)
    for line in _boundary_lines(state, BoundaryKind.FLAT).tolist():
        for curve in state.lines.curves.data[line]:
            border = sample(state.spline(curve), 4)[1]
            # Coordinate by coordinate: long rows are worked on several times as fast.
            square = np.zeros((len(places), len(border)))
            for axis in range(3):
                step = places[:, axis, None] - border[:, axis]
                step *= step
                square += step
            nearest = np.sqrt(square.min(axis=1))
            distance = np.minimum(distance, nearest)
    return distance


def move_normal(ground: FieldContext, rows: IntArray, amount: FloatArray) -> Shift:
    """Move points by the shortest way along their freedom that gives a normal displacement.

    Parameters
    ----------
    ground : FieldContext
        Normals.
    rows : (k,) int
        The points.
    amount : (k,), m
        Displacement along the outward normal.
    """
    normal = ground.normal[rows]
    along = free_normals(ground.state, rows, normal)
    square = (along * along).sum(axis=1)
    good = np.sqrt(square) >= ground.state.tolerances.field_normal
    delta = along * (amount / np.where(good, square, 1.0))[:, None]
    moved = good & (amount != 0.0)
    return Shift(rows[moved], delta[moved], rows[~good & (amount != 0.0)])


def row_spacing(state: HullState, place: FloatArray) -> float:
    """Give the median distance, seen along x, of the nearest points from a place, m."""
    rows = state.live("rows")
    step = state.rows.xyz.data[rows] - place
    near = rows[np.argsort((step * step).sum(axis=1), kind="stable")[:24]]
    curves = np.unique(state.rows.curve.data[near].ravel())
    gaps: list[float] = []
    for curve in curves[curves >= 0].tolist():
        spline: SplineBatch = state.spline(curve)
        chord = np.diff(spline.xyz[:, 1:], axis=0)
        length = np.sqrt((chord * chord).sum(axis=1))
        at = int(np.argmin(((spline.xyz - place) ** 2).sum(axis=1)))
        gaps += length[max(at - 1, 0) : at + 1].tolist()
    positive = [gap for gap in gaps if gap > 1e-6]
    return float(np.median(positive)) if positive else 1.0


def add_shifts(shifts: list[Shift], pinned: set[int]) -> Shift:
    """Add up displacements per point; points that the edit sets itself stay out.

    Summed in the order in which the fields were asked for, so the bits do not depend on
    anything else.
    """
    rows = np.unique(np.concatenate([shift.rows for shift in shifts]))
    rows = rows[~np.isin(rows, sorted(pinned))]
    total = np.zeros((len(rows), 3))
    for shift in shifts:
        mine = np.isin(shift.rows, rows)
        total[np.searchsorted(rows, shift.rows[mine])] += shift.delta[mine]
    return Shift(rows, total, np.unique(np.concatenate([shift.left for shift in shifts])))


def land(state: HullState, journal: Journal, fields: list[Field]) -> None:
    """Put the points that one field, and no other, must land in given places there, to the bit.

    So each of several curves that are re-shaped at once takes its own new shape, though the
    field of a neighbour reaches it.
    """
    found = [field.exact() for field in fields]
    rows = np.concatenate([mine for mine, _ in found])
    places = np.concatenate([goals for _, goals in found])
    alone = (rows[:, None] == rows[None, :]).sum(axis=1) == 1
    journal.put(state.rows.xyz, rows[alone], places[alone])


def sub_steps(state: HullState, shift: Shift) -> int:
    """Say in how many steps a field is run: while a step exceeds 0.1 m, it is halved."""
    largest = float(np.sqrt((shift.delta * shift.delta).sum(axis=1)).max(initial=0.0))
    steps = 1
    while largest / steps > state.tolerances.substep:
        steps *= 2
    if steps > _STEPS:
        raise BadInputError(
            f"a field that moves a point by {largest:.4g} m",
            "in an edit",
            f"move by less than {_STEPS * state.tolerances.substep:g} m at a time",
        )
    return steps


_STEPS = 64
"""A field of more sub-steps than this is no fairing any more."""
