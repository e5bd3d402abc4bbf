"""Fields of displacement normal to the hull, fading along the length and the girth.

Every point in reach moves along its own freedom by the shortest way that gives the normal
displacement d: with n the outward normal and U an orthonormal basis of the freedom,
delta = U U^T n d / |U^T n|^2. The update runs a `NormalField` in sub-steps where it is large;
`PullField` is the one of a soft pull, that of a re-shaped curve stands with that modification.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Iterator, Sequence
from typing import TYPE_CHECKING, Protocol, TypeVar, cast

import attrs
import numpy as np

from assoc_hull.edit.hull_normals import SHORT, free_normals, normals_at
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.graph.derived import Objects
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.table import BLOCK
from assoc_hull.model.address import address
from assoc_hull.model.kinds import BoundaryKind, Role, Sort, State
from assoc_hull.model.program.engine import fields_of
from assoc_hull.model.program.structure import Program, Values
from assoc_hull.model.tables import HullState

if TYPE_CHECKING:
    from assoc_hull.model.program.compiled_fields import Borders, CompiledFields

__all__ = [
    "CLOSE",
    "FieldContext",
    "NormalField",
    "PointDisplacements",
    "PullField",
    "SolvedField",
    "add_displacements",
    "fixed_places",
    "flat_distance",
    "land_points",
    "level_with_flats",
    "move_normal",
    "on_flat",
    "on_profile",
    "quintic_fade",
    "row_spacing",
    "spacing_along",
    "station_spacing",
    "sub_step_count",
    "unreached",
]

# --------------------------------------------------------------------------------------
# Any field. Shared crossings and adopted points move. Driven ones are computed from their driver,
# watched ones have no value, placed points stay; a flat is moved as a feature, never dented, and
# ends on the profile move with the profile only. Re-shaping a curve and letting only its shared
# crossings follow was measured to leave up to 80 % of the edit as gaps elsewhere.

BoolArray = np.typing.NDArray[np.bool_]

_IN_PLANE = 1e-9
"""Points as near to a plane (m) lie in it."""

_LEVEL, _LEVEL_SLOPE = 1e-3, 2e-3
"""Within such a distance, m, and such a slope to it a hull runs on in the plane of a flat."""

_FEW_BLOCKS = 16
"""Points of a hull of so few blocks of rows are looked at one by one."""

_ALONG = 0.02
"""A spacing seen along x below this part of that in space is none: the lines run along x."""


def quintic_fade(part: FloatArray) -> FloatArray:
    """Give 1 - (10 s^3 - 15 s^4 + 6 s^5) for s below 1, else 0: a fade with flat ends.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.edit.displacement_field import quintic_fade
    >>> quintic_fade(np.array([0.0, 0.5, 1.0, 2.0])).tolist()
    [1.0, 0.5, 0.0, 0.0]
    """
    s = np.minimum(np.abs(part), 1.0)
    value: FloatArray = 1.0 - s * s * s * (10.0 - s * (15.0 - 6.0 * s))
    return np.where(s < 1.0, value, 0.0)


T = TypeVar("T")


@attrs.frozen(eq=False)
class PointFreedoms:
    """Points with the normals of the hull, and what their freedom is of these.

    Attributes
    ----------
    normal, along : (k, 3)
        n and U U^T n.
    square : (k,)
        The square of the length of `along`; 1 for points that are not `good`.
    good : (k,) bool
        Whether a point may be moved: the freedom of the others is almost tangential.
    """

    normal: FloatArray
    along: FloatArray
    square: FloatArray
    good: BoolArray

    def __attrs_post_init__(self) -> None:
        freeze(self.normal, self.along, self.square, self.good)


@attrs.frozen(eq=False)
class FieldContext:
    """What all fields of one (sub-)step read of a hull, as far as they ask for it.

    Attributes
    ----------
    state : HullState
        The tables as they stand; they stay so.
    across_flats : bool
        Whether flats are moved too.
    numbers : (Program, Values) or None
        A program of the hull, and its curves as they are in the tables: where it is compiled it
        gives the same bits.
    """

    state: HullState
    across_flats: bool
    numbers: tuple[Program, Values] | None = None
    _known: dict[Hashable, object] = attrs.field(factory=dict, init=False, repr=False)

    def _once(self, key: Hashable, make: Callable[[], T]) -> T:
        """Give what was asked for before, or make it."""
        if key not in self._known:
            self._known[key] = make()
        # One key is made by one function, so its type is that of `make`.
        return cast("T", self._known[key])

    def compiled(self) -> CompiledFields | None:
        """Give what has the bits of all this in a compiled form, if it is at hand."""
        if self.numbers is None:
            return None
        program, state = self.numbers[0], self.state
        return self._once(
            "compiled", lambda: fields_of(state, program, state.tolerances.factor * SHORT)
        )

    def freedoms(self, rows: IntArray) -> PointFreedoms:
        """Give the normals at points (k,), and along what these points are free."""
        return self._once(("freedoms", rows.tobytes()), lambda: self._find_freedoms(rows))

    def _find_freedoms(self, rows: IntArray) -> PointFreedoms:
        compiled = self.compiled()
        if compiled is not None and self.numbers is not None:
            found = compiled.freedoms(self.state.rows.xyz.data, self.numbers[1], rows)
            if found is not None:
                return PointFreedoms(*found)
        normal = normals_at(self.state, rows)
        along = free_normals(self.state, rows, normal)
        square = (along * along).sum(axis=1)
        good = np.sqrt(square) >= self.state.tolerances.field_normal
        return PointFreedoms(normal, along, np.where(good, square, 1.0), good)

    def pulled(
        self, place: FloatArray, radius: tuple[float, float], amount: float, flat_fade: float
    ) -> tuple[IntArray, FloatArray] | None:
        """Give the points that a pull reaches, and how far each is to move; None if not compiled.

        Towards flats it fades within `flat_fade`, m; nothing does so where that is infinite.
        """
        compiled = self.compiled()
        if compiled is None:
            return None
        state, planes = self.state, [] if self.across_flats else _flat_planes(self.state)
        return compiled.pulled(
            state.rows.xyz.data, _movable_near(state, self.across_flats, place, radius), place,
            radius, amount,
            np.array(planes).reshape(-1, 4), self._borders(compiled), flat_fade, _IN_PLANE,
        )  # fmt: skip

    def _borders(self, compiled: CompiledFields) -> Borders:
        state, borders = self.state, _flat_borders(self.state)[0]
        return state.derived(
            ("runs of flat borders",), (Objects([borders]),), lambda: compiled.runs_of(borders)
        )

    def flat_distance(self, row: int, within: float) -> float:
        """Give the distance of a point from the nearest border, m; beyond `within` perhaps inf."""
        compiled = self.compiled()
        if compiled is None:
            return float(self.flat_distances(np.array([row]), within)[0])
        return compiled.distance(self.state.rows.xyz.data[row], self._borders(compiled), within)

    def free(self) -> IntArray:
        """Give the points that fields may move, ascending."""
        rows = _movable(self.state, self.across_flats)
        return self._once("free", lambda: self._off_planes(rows))

    def free_near(self, place: FloatArray, radius: tuple[float, float]) -> IntArray:
        """Give those within a distance along the length, and about within one seen along x."""
        return self._once(("near", place.tobytes(), radius), lambda: self._near(place, radius))

    def may_move(self, row: int) -> bool:
        """Tell whether fields may move a point."""
        movable = _movable(self.state, self.across_flats)
        place = int(movable.searchsorted(row))
        here = movable[place : place + 1]
        return bool(len(self._off_planes(here[here == row])))

    def normals(self, rows: IntArray) -> FloatArray:
        """Give the unit outward normals at points (k,): (k, 3)."""
        return self.freedoms(rows).normal

    def flat_distances(self, rows: IntArray, within: float = np.inf) -> FloatArray:
        """Give the distances of points (k,) from the nearest border, as `flat_distance`, m."""
        return self._once(
            ("flats", rows.tobytes(), within),
            lambda: flat_distance(self.state, self.state.rows.xyz[rows], within),
        )

    def _near(self, place: FloatArray, radius: tuple[float, float]) -> IntArray:
        rows = _movable_near(self.state, self.across_flats, place, radius)
        xyz = self.state.rows.xyz.data
        rows = rows[np.abs(xyz[:, 0].take(rows) - place[0]) < radius[0]]
        step = xyz.take(rows, axis=0) - place
        return self._off_planes(rows[(np.abs(step[:, 1:]) < radius[1]).all(axis=1)])

    def _off_planes(self, rows: IntArray) -> IntArray:
        """Leave out points in the centre plane, and in the planes of flats."""
        xyz = self.state.rows.xyz.data.take(rows, axis=0)
        out = np.abs(xyz[:, 1]) < _IN_PLANE
        if not self.across_flats:
            out |= _in_flat_planes(self.state, xyz)
        return rows[~out]


@attrs.frozen(eq=False)
class PointDisplacements:
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


class NormalField(Protocol):
    """A displacement of the hull."""

    @property
    def across_flats(self) -> bool:
        """Whether flats are moved too."""

    @property
    def strict(self) -> bool:
        """Whether nothing but its own points may move: no gap is mended, each is reported."""

    def shift(self, ground: FieldContext, part: float) -> PointDisplacements:
        """Give the displacements for a part (of 1) of the whole field."""

    def exact(self) -> tuple[IntArray, FloatArray]:
        """Give points that must land in given places, to the bit, and the places."""

    def left(self, state: HullState, done: float) -> float:
        """Give the part (of 1) that the hull still lacks, when a part was asked for as `done`."""


def _movable(state: HullState, across_flats: bool) -> IntArray:
    """Give the points that fields may move by what they are, and by the lines that they lie on."""
    rows, lines = state.rows, state.lines
    depends_on = (
        rows.alive, rows.sort, rows.role, rows.curve, state.curves.line, lines.alive,
        lines.boundary, lines.planar, lines.normal,
    )  # fmt: skip

    def find() -> IntArray:
        shared = (rows.sort.data == Sort.CROSSING) & (rows.role.data == Role.SHARED)
        free = rows.alive.data & (shared | (rows.sort.data == Sort.ADOPTED))
        free &= ~_of_lines(state, _profile_lines(state))
        if not across_flats:
            free &= ~_of_lines(state, _boundary_lines(state, BoundaryKind.FLAT))
        return np.flatnonzero(free)

    return state.derived(("movable", across_flats), depends_on, find)


def _movable_near(
    state: HullState, across_flats: bool, place: FloatArray, radius: tuple[float, float]
) -> IntArray:
    """Give those in blocks of rows that come within a distance of a place, ascending."""
    rows = _movable(state, across_flats)
    if state.rows.count <= _FEW_BLOCKS * BLOCK:
        return rows
    low, high = _block_boxes(state)
    reach = np.array([radius[0], radius[1], radius[1]])
    # By the differences that the points are judged by: none within reach is lost by rounding.
    near = np.flatnonzero(((low - place < reach) & (high - place > -reach)).all(axis=1))
    first, last = rows.searchsorted(near * BLOCK), rows.searchsorted((near + 1) * BLOCK)
    parts = [rows[a:b] for a, b in zip(first.tolist(), last.tolist(), strict=True)]
    found = np.concatenate([rows[:0], *parts])
    found.setflags(write=False)
    return found


@attrs.define(eq=False)
class _LastBoxes:
    """The least and largest coordinates of blocks of rows, as the places were last looked at."""

    known: tuple[IntArray, FloatArray, FloatArray] | None = None


def _block_boxes(state: HullState) -> tuple[FloatArray, FloatArray]:
    """Give the least and largest coordinates (b, 3), m, of the rows of each block of the table."""
    places = state.rows.xyz
    last = state.derived(("boxes of blocks",), (state.rows.count,), _LastBoxes, most=1)
    xyz, known = places.data, last.known
    blocks = places.blocks[: -(-len(xyz) // BLOCK)]
    if known is None or len(known[0]) != len(blocks):
        begins = np.arange(0, len(xyz), BLOCK)
        # what is not a number is no place: rows of nothing
        low, high = np.fmin.reduceat(xyz, begins), np.fmax.reduceat(xyz, begins)
    else:
        low, high = known[1].copy(), known[2].copy()
        for block in np.flatnonzero(known[0] != blocks).tolist():
            mine = xyz[block * BLOCK : (block + 1) * BLOCK].T.copy()  # numpy likes long rows
            low[block], high[block] = np.fmin.reduce(mine, axis=1), np.fmax.reduce(mine, axis=1)
    last.known = blocks, low, high
    return low, high


def _boundary_lines(state: HullState, kind: BoundaryKind) -> IntArray:
    found: IntArray = np.flatnonzero(state.lines.alive.data & (state.lines.boundary.data == kind))
    return found


def _of_lines(state: HullState, lines: IntArray) -> BoolArray:
    """Tell which points lie on curves of the given lines."""
    curve = state.rows.curve.data
    line = np.where(curve >= 0, state.curves.line[np.maximum(curve, 0)], -1)
    found = np.isin(line, lines)
    return np.asarray(found[:, 0] | found[:, 1])


def _profile_lines(state: HullState) -> IntArray:
    """Give the boundary lines in the centre plane on which others end."""
    ends = _boundary_lines(state, BoundaryKind.END)
    centre = np.abs(state.lines.normal[ends, 1]) == 1.0
    found: IntArray = ends[state.lines.planar[ends] & centre]
    return found


def on_profile(state: HullState) -> BoolArray:
    """Tell which points lie in the centre plane: they move with the profile only."""
    on_line = _of_lines(state, _profile_lines(state))
    return np.asarray(on_line | (np.abs(state.rows.xyz[:, 1]) < _IN_PLANE))


def on_flat(state: HullState) -> BoolArray:
    """Tell which points lie in a flat or on its border."""
    found = _of_lines(state, _boundary_lines(state, BoundaryKind.FLAT))
    return found | _in_flat_planes(state, state.rows.xyz.data)


def fixed_places(state: HullState, xyz: FloatArray) -> BoolArray:
    """Tell which places (k, 3), m, lie in the centre plane or in that of a flat."""
    return _in_flat_planes(state, xyz) | (np.abs(xyz[:, 1]) < _IN_PLANE)


def _in_flat_planes(state: HullState, xyz: FloatArray) -> BoolArray:
    """Tell which places (k, 3), m, lie in the plane of a flat."""
    found = np.zeros(len(xyz), np.bool_)
    for x, y, z, offset in _flat_planes(state):
        off = x * xyz[:, 0] + y * xyz[:, 1] + z * xyz[:, 2] - offset
        found |= np.abs(off) < _IN_PLANE
    return found


def level_with_flats(state: HullState, rows: IntArray, normals: FloatArray) -> BoolArray:
    """Tell which points (k,), with the hull's normals there (k, 3), run on in the plane of a flat.

    Those of a hull that was measured lie beside it by the last digit of the measurement.
    """
    found = np.zeros(len(rows), np.bool_)
    for *normal, offset in _flat_planes(state):
        off = np.abs(state.rows.xyz[rows] @ np.array(normal) - offset)
        slope = np.linalg.norm(np.cross(normals, normal), axis=1)
        found |= (off < _LEVEL) & (slope < _LEVEL_SLOPE)
    return found


def _flat_planes(state: HullState) -> list[tuple[float, float, float, float]]:
    """Give the planes in which flats lie, each once: normal and offset, m."""
    lines = state.lines
    depends_on = lines.alive, lines.boundary, lines.planar, lines.normal, lines.offset

    def find() -> list[tuple[float, float, float, float]]:
        flats = _boundary_lines(state, BoundaryKind.FLAT)
        flats = flats[lines.planar[flats]]
        planes = np.column_stack([lines.normal[flats], lines.offset[flats]])
        return [(x, y, z, offset) for x, y, z, offset in np.unique(planes, axis=0).tolist()]

    return state.derived(("flat planes",), depends_on, find)


def flat_distance(state: HullState, places: FloatArray, within: float = np.inf) -> FloatArray:
    """Measure how far places (k, 3) lie from the nearest border of a flat, (k,), m.

    inf where there is none; one beyond `within`, m, may be left out.
    """
    distance = np.full(len(places), np.inf)
    if not len(places):
        return distance
    low, high = places.min(axis=0) - within, places.max(axis=0) + within
    borders, least, most = _flat_borders(state)
    near = ~((least > high) | (most < low)).any(axis=1)
    for border in (borders[i] for i in np.flatnonzero(near).tolist()):
        # coordinate by coordinate: numpy runs several times as fast over long rows
        square = np.zeros((len(places), len(border)))
        for axis in range(3):
            step = places[:, axis, None] - border[:, axis]
            step *= step
            square += step
        nearest = np.sqrt(square.min(axis=1))
        distance = np.minimum(distance, nearest)
    return distance


def _flat_borders(state: HullState) -> tuple[list[FloatArray], FloatArray, FloatArray]:
    """Give places (k, 3), m, along each border curve of flats; the least and largest of each."""
    lines, shape = state.lines, state.curves.spline.data
    curves = state.derived(
        ("curves of flats",), (lines.alive, lines.boundary, lines.curves),
        lambda: [
            curve for line in _boundary_lines(state, BoundaryKind.FLAT).tolist()
            for curve in lines.curves.data[line]
        ],
    )  # fmt: skip
    # A published curve has a shape.
    splines = cast("list[SplineBatch]", list(map(shape.__getitem__, curves)))

    def find() -> tuple[list[FloatArray], FloatArray, FloatArray]:
        borders = [sample(each, 4)[1] for each in splines]
        low, high = ([end(each, axis=0) for each in borders] for end in (np.min, np.max))
        return borders, np.array(low).reshape(-1, 3), np.array(high).reshape(-1, 3)

    return state.derived(("flat borders",), (Objects(splines),), find)


def move_normal(ground: FieldContext, rows: IntArray, amount: FloatArray) -> PointDisplacements:
    """Move points (k,) by the shortest way along their freedom that gives a normal displacement.

    `amount` (k,), m, is positive outward. Points whose freedom is almost tangential stay.
    """
    free = ground.freedoms(rows)
    delta = free.along * (amount / free.square)[:, None]
    asked = amount != 0.0
    moved = free.good & asked
    if moved.all():
        return PointDisplacements(rows, delta, rows[:0])
    return PointDisplacements(rows[moved], delta[moved], rows[~free.good & asked])


def row_spacing(state: HullState, place: FloatArray) -> float:
    """Give the median distance, seen along x, of the nearest points from a place, m.

    Where most lines run along x, as on a parallel side, it is that of the lines across.
    """
    chord = _chords_near(state, place)
    gap, whole = _lengths(chord[:, 1:]), _lengths(chord)
    chosen = gap > 1e-6
    found = float(np.median(gap[chosen])) if chosen.any() else 1.0
    across = gap > 0.5 * whole
    if across.any() and found < _ALONG * float(np.median(whole)):
        found = max(found, float(np.median(gap[across])))
    return found


def spacing_along(state: HullState, place: FloatArray) -> float:
    """Give the median distance along x of the points that lie nearest to a place, m; 0 if none."""
    chord = _chords_near(state, place)
    step = np.abs(chord[:, 0])
    along = step > 0.5 * _lengths(chord)
    return float(np.median(step[along])) if along.any() else 0.0


def _chords_near(state: HullState, place: FloatArray) -> FloatArray:
    """Give the chords (k, 3), m, on both sides of a place of the curves that come near it."""
    rows = state.live("rows")
    step = state.rows.xyz[rows] - place
    near = rows[np.argsort((step * step).sum(axis=1), kind="stable")[:24]]
    curves = np.unique(state.rows.curve[near].ravel())
    found = [np.zeros((0, 3))]
    for curve in curves[curves >= 0].tolist():
        xyz = state.spline(curve).xyz
        at = int(np.argmin(((xyz - place) ** 2).sum(axis=1)))
        found.append(np.diff(xyz[max(at - 1, 0) : at + 2], axis=0))
    return np.concatenate(found)


def _lengths(steps: FloatArray) -> FloatArray:
    found: FloatArray = np.sqrt((steps * steps).sum(axis=1))
    return found


def station_spacing(state: HullState) -> float:
    """Give the median spacing of lines across the ship, m; Lpp / 20 of fewer than two."""
    lines = state.live("lines")
    across = lines[state.lines.planar[lines] & (state.lines.normal[lines, 0] == 1.0)]
    offsets = np.sort(state.lines.offset[across])
    return (
        float(np.median(np.diff(offsets))) if len(offsets) > 1 else state.particulars.length / 20.0
    )


def add_displacements(shifts: list[PointDisplacements], pinned: set[int]) -> PointDisplacements:
    """Add up displacements per point; points that the edit sets itself stay out.

    Summed in the order in which the fields were asked for, so the bits do not depend on
    anything else.
    """
    if len(shifts) == 1 and not pinned:
        only = shifts[0]
        ascends = bool((only.rows[1:] > only.rows[:-1]).all())
        if ascends and not len(only.left):
            return PointDisplacements(only.rows, 0.0 + only.delta, only.left)
    rows = np.unique(np.concatenate([shift.rows for shift in shifts]))
    rows = rows[~np.isin(rows, sorted(pinned))]
    total = np.zeros((len(rows), 3))
    for shift in shifts:
        mine = np.isin(shift.rows, rows)
        total[np.searchsorted(rows, shift.rows[mine])] += shift.delta[mine]
    return PointDisplacements(
        rows, total, np.unique(np.concatenate([shift.left for shift in shifts]))
    )


def land_points(state: HullState, journal: Journal, fields: list[NormalField]) -> None:
    """Put the points that one field, and no other, must land in given places there, to the bit.

    So each of several curves that are re-shaped at once takes its own new shape, though the
    field of a neighbour reaches it.
    """
    found = [field.exact() for field in fields]
    rows = np.concatenate([mine for mine, _ in found])
    places = np.concatenate([goals for _, goals in found])
    alone = (rows[:, None] == rows[None, :]).sum(axis=1) == 1
    journal.put(state.rows.xyz, rows[alone], places[alone])


def sub_step_count(state: HullState, shift: PointDisplacements) -> int:
    """Give the number of steps of a field: halved while one exceeds `Tolerances.substep`."""
    far = np.sqrt((shift.delta * shift.delta).sum(axis=1))
    largest, steps = float(far.max(initial=0.0)), 1
    while largest / steps > state.tolerances.substep:
        steps *= 2
    if steps > _STEPS:
        most = _STEPS * state.tolerances.substep
        raise BadInputError(
            f"points would move by up to {largest:.4g} m",
            f"at {address(state, int(shift.rows[far.argmax()]))}",
            f"ask for less than {100.0 * most / largest:.2g} % of it at a time, so that none moves "
            f"by more than {most:g} m; lengths are in m, 50 mm is 0.05",
        )
    return steps


_STEPS = 64
"""A field of more sub-steps than this is no fairing any more."""


@attrs.frozen(eq=False)
class SolvedField:
    """A displacement of points that was solved for.

    Attributes
    ----------
    rows : (k,) int
        The points.
    delta : (k, 3), m
        By how much they move.
    landing, places : (l,) int, (l, 3), m
        Points that land in given places, to the bit.
    """

    rows: IntArray
    delta: FloatArray
    landing: IntArray = attrs.field(factory=lambda: np.zeros(0, np.int64))
    places: FloatArray = attrs.field(factory=lambda: np.zeros((0, 3)))
    across_flats: bool = False
    strict: bool = False

    def __attrs_post_init__(self) -> None:
        freeze(self.rows, self.delta, self.landing, self.places)

    def shift(self, ground: FieldContext, part: float) -> PointDisplacements:
        """Give the displacements for a part of the whole."""
        alive = ground.state.rows.alive.data[self.rows]
        return PointDisplacements(self.rows[alive], part * self.delta[alive], np.zeros(0, np.int64))

    def exact(self) -> tuple[IntArray, FloatArray]:
        """Give the points that land, and where."""
        return self.landing, self.places

    def left(self, state: HullState, done: float) -> float:
        """Give the part that is still to come, when a part is `done`."""
        return 1.0 - done


# --------------------------------------------------------------------------------------
# Soft pulls.

CLOSE = 2e-3
"""The part of the way that a pulled point may lack without needing another sub-step."""

_NEARLY = 0.01
"""A point that came within this part of the way it was pulled is where it was asked to be."""


@attrs.frozen(eq=False)
class PullField:
    """The field d(P) = d b(|x - x0| / r_x) b(rho / r_g).

    Attributes
    ----------
    row : int
        The point that is pulled.
    place : (3,), m
        Where it lay before.
    amount : float, m
        d, outward positive.
    normal : (3,)
        Outward unit normal of the hull there, before.
    radius : (float, float), m
        r_x along the length, r_g seen along x.
    flat_fade : float, m
        Towards the border of a flat the field fades to zero within this distance.
    across_flats : bool
        Whether flats are moved too.
    strict : bool
        Never: what lies around follows.
    """

    row: int
    place: FloatArray
    amount: float
    normal: FloatArray
    radius: tuple[float, float]
    flat_fade: float
    across_flats: bool
    strict: bool = False

    def shift(self, ground: FieldContext, part: float) -> PointDisplacements:
        """Give the displacements for a part of the whole pull."""
        fade = np.inf if self.across_flats else self.flat_fade
        found = ground.pulled(self.place, self.radius, part * self.amount, fade)
        if found is not None:
            return move_normal(ground, *found)
        rows = ground.free_near(self.place, self.radius)
        step = ground.state.rows.xyz[rows] - self.place
        girth = np.sqrt(step[:, 1] * step[:, 1] + step[:, 2] * step[:, 2])
        amount = (
            part
            * self.amount
            * quintic_fade(step[:, 0] / self.radius[0])
            * quintic_fade(girth / self.radius[1])
        )
        rows, amount = rows[amount != 0.0], amount[amount != 0.0]
        if not self.across_flats and np.isfinite(self.flat_fade):
            amount = amount * (
                1.0 - quintic_fade(ground.flat_distances(rows, self.flat_fade) / self.flat_fade)
            )
        reach = amount != 0.0
        return move_normal(ground, rows[reach], amount[reach])

    def exact(self) -> tuple[IntArray, FloatArray]:
        """Nothing: every point moves by what the field says."""
        return np.zeros(0, np.int64), np.zeros((0, 3))

    def left(self, state: HullState, done: float) -> float:
        """Give the part of the pull that the point lacks, whatever part was `done`."""
        if not state.rows.alive.data[self.row]:
            return 1.0 - done
        return 1.0 - self.reached(state) / self.amount

    def reached(self, state: HullState) -> float:
        """Give how far the point has come along the normal, m.

        A watched crossing has no value: it lies where its first curve passes.
        """
        table = state.rows
        watched = table.role.data[self.row] == Role.WATCHED
        watched = watched and table.sort.data[self.row] == Sort.CROSSING
        now = table.spot.data[self.row, 0] if watched else table.xyz.data[self.row]
        way = zip(now.tolist(), self.place.tolist(), self.normal.tolist(), strict=True)
        x, y, z = [(to - at) * along for to, at, along in way]
        return float(x + y + z)


def unreached(
    state: HullState, fields: Sequence[NormalField], pinned: Collection[int]
) -> Iterator[str]:
    """Say which point did not come where it was pulled, if one was and nothing else moved it.

    Several fields in one edit add, so none of their points goes where one of them pulls.
    """
    pull = fields[0] if len(fields) == 1 else None
    if not isinstance(pull, PullField) or pull.row in pinned:
        return
    if not state.rows.alive[pull.row]:
        yield f"{address(state, pull.row)} was pulled and has gone: pull by less, or another point"
        return
    driver = int(state.rows.driver.data[pull.row])
    if driver >= 0 and state.curves.state[driver] != State.CLEAN:
        return
    reached = pull.reached(state)
    if abs(reached - pull.amount) > _NEARLY * abs(pull.amount):
        yield (
            f"{address(state, pull.row)} came {1e3 * reached:.1f} mm along the normal where "
            f"{1e3 * pull.amount:.1f} mm were asked{_what_held(state, pull)}"
        )


def _what_held(state: HullState, pull: PullField) -> str:
    """Say why a point did not come where it was pulled, and what to do."""
    driver = int(state.rows.driver[pull.row])
    if driver < 0 and _slides(state, pull):
        return (
            ": it is free almost along the hull only, so it stays and dents the hull; make it "
            "watched (edit.set_role), or pull another point"
        )
    name = "" if driver < 0 else f", {state.lines.name.data[state.line_of(driver)]} drives it"
    return (
        f"{name}: placed points, ends and flats beside it stay; pull one of the points that can "
        "move, by less, or with another radius"
    )


def _slides(state: HullState, pull: PullField) -> bool:
    """Tell whether fields leave the pulled point alone, as the hull was or as it is now."""
    if state.rows.sort[pull.row] != Sort.CROSSING:
        return False
    if state.rows.role[pull.row] == Role.WATCHED:
        return False
    normal = np.stack([pull.normal, normals_at(state, np.array([pull.row]))[0]])
    along = free_normals(state, np.array([pull.row, pull.row]), normal)
    least = float(np.sqrt((along * along).sum(axis=1)).min())
    return least < state.tolerances.field_normal
