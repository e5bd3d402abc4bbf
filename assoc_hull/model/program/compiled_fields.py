"""Displacements of points normal to the hull, compiled: the bits of the numpy of `edit`.

Which curves cross in a point, where it stands on them and along what it is free changes with the
structure only: `FieldStructure` has it in flat arrays. The numbers of the curves are those of the
program; places of points come from the tables, as points may have been set there already. What is
met on few hulls only (a curve that ends where it began) is not answered: numpy serves then.

As for `compiled_program`, arrays come in one by one, and constants as arguments.
"""

from __future__ import annotations

from collections.abc import Callable
from math import sqrt

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.jit import jit, was_loaded
from assoc_hull.model.gaps import crossing_normals
from assoc_hull.model.kinds import Sort
from assoc_hull.model.program.compiled_program import read_only, tangent_at
from assoc_hull.model.program.structure import Program, Values
from assoc_hull.model.tables import HullState

__all__ = ["Borders", "CompiledFields", "FieldStructure", "warm"]

Flags = NDArray[np.int8]

_ANY, _LINE, _PLANE = 0, 1, 2
"""How a point is free: in space, along a line, in a plane."""

_CROSSING, _OWN = 1, 2
"""What gives the normal at a point: its two curves, or the crossings beside it on one curve."""


@attrs.frozen(eq=False)
class FieldStructure:
    """What the normal and the freedom of every point are made from.

    Attributes
    ----------
    sort : (rows,) int8
        What gives the normal: 0 nothing, 1 the two curves, 2 crossings beside it.
    curve : (rows, 2) int
        The curves of each point, as the program counts them, -1 for none.
    knot, meeting : (rows, 2) int
        Where the point defines its curves; else the meetings where they pass it; -1 for none.
    freedom, free : (rows,) int8, (rows, 3)
        0 in space, 1 along the line `free`, 2 in the plane of the normal `free`.
    told, across : (m,) int8
        Whether the plane of a curve tells which way is outward, and whether it is a section.
    plane : (m, 3)
        The normals of these planes.
    live : (k,) int
        All points that are alive.
    short, depth, least : float, m
        Nearer ends tell nothing of a curve's course; the depth of the hull; the least part of a
        normal along the freedom with which a point is moved.
    """

    sort: Flags
    curve: IntArray
    knot: IntArray
    meeting: IntArray
    freedom: Flags
    free: FloatArray
    told: Flags
    across: Flags
    plane: FloatArray
    live: IntArray
    short: float
    depth: float
    least: float

    @classmethod
    def of(cls, state: HullState, program: Program, short: float) -> FieldStructure | None:
        """Read the tables; None where these and the program are of two states."""
        table, lines, count = state.rows, state.lines, state.rows.count
        owner = np.repeat(np.arange(program.curves), np.diff(program.start))
        knot, meeting = np.full((count, 2), -1), np.full((count, 2), -1)
        sides = [state.curves.side.data[each] for each in program.number.tolist()]
        side = np.concatenate([np.zeros(0, np.int64), *sides])
        knot[program.row, side] = np.arange(len(owner))
        held = np.flatnonzero(program.meet_row >= 0)
        row = program.meet_row[held]
        other = table.curve.data[row, 0] != program.number[program.meet_curve[held]]
        meeting[row, other.astype(np.int64)] = held
        curve = np.where(table.curve.data >= 0, program.local[table.curve.data], -1)
        alive, crossing = table.alive.data, table.sort.data == Sort.CROSSING
        passes = (knot < 0) & (table.curve.data >= 0) & alive[:, None]
        passes &= np.isfinite(table.parameter.data)
        if ((meeting < 0) & passes & crossing[:, None]).any():
            return None
        meeting[~passes] = -1
        sort = np.where(crossing, _CROSSING, np.where(knot[:, 0] >= 0, _OWN, 0))
        freedom, free = _freedom(state)
        line = state.curves.line.data[program.number]
        told = lines.planar.data[line] & (lines.boundary.data[line] < 0)
        plane = np.where(told[:, None], lines.normal.data[line], 0.0)
        across = np.abs(lines.normal.data[line, 0]) > 0.5
        found = cls(
            np.where(alive, sort, 0).astype(np.int8), curve, knot, meeting, freedom, free,
            told.astype(np.int8), across.astype(np.int8), plane, np.flatnonzero(alive), short,
            float(state.particulars.depth), float(state.tolerances.field_normal),
        )  # fmt: skip
        freeze(sort, *found.arrays())
        return found

    def arrays(self) -> tuple[NDArray[np.generic], ...]:
        """Give the arrays in the order in which `find_freedoms` takes them."""
        return (
            self.sort, self.curve, self.knot, self.meeting, self.freedom, self.free, self.told,
            self.across, self.plane, self.live,
        )  # fmt: skip


def _freedom(state: HullState) -> tuple[Flags, FloatArray]:
    """Give how all points are free: what `free_normals` finds of their planes."""
    curve, lines = state.rows.curve.data, state.lines
    line = state.curves.line.data[np.maximum(curve, 0)]
    planar = (curve >= 0) & lines.planar.data[line]
    normal = np.where(planar[:, :, None], lines.normal.data[line], 0.0)
    both, one = planar[:, 0] & planar[:, 1], planar[:, 0] | planar[:, 1]
    free = np.where(planar[:, 0, None], normal[:, 0], normal[:, 1])
    free = np.where(both[:, None], crossing_normals(normal[:, 0], normal[:, 1]), free)
    kind = np.where(both, _LINE, np.where(one, _PLANE, _ANY)).astype(np.int8)
    return kind, np.ascontiguousarray(free)


# --------------------------------------------------------------------------------------
# Normals and displacements.


Vector = tuple[float, float, float]


@jit
def _unit(x: float, y: float, z: float, least: float) -> Vector:
    """Give a vector at length 1; as it is if it is no longer than `least`."""
    length = sqrt(x * x + y * y + z * z)
    if length > least:
        return x / length, y / length, z / length
    return x, y, z


@jit
def _unit_tangent(
    row: int, side: int, curve: IntArray, knot_of: IntArray, meeting: IntArray, start: IntArray,
    knot: FloatArray, block: FloatArray, at: FloatArray, segment: IntArray,
) -> Vector:  # fmt: skip
    """Give the unit tangent of a curve of a point; nil where it is not known."""
    j, m, c = knot_of[row, side], meeting[row, side], curve[row, side]
    if j >= 0:
        b = start[c]
        count = start[c + 1] - b
        after, before = 9 * b + 3 * count + (j - b), 9 * b + 6 * count + (j - b)
        if j == b:
            x, y, z = block[after], block[after + count], block[after + 2 * count]
        elif j == b + count - 1:
            x, y, z = block[before], block[before + count], block[before + 2 * count]
        else:
            x = block[after] + block[before]
            y = block[after + count] + block[before + count]
            z = block[after + 2 * count] + block[before + 2 * count]
        return _unit(x, y, z, 0.0)
    if m >= 0:
        return tangent_at(m, c, start, knot, block, at, segment)
    return 0.0, 0.0, 0.0


@jit
def _way_out(
    c: int, told: Flags, across: Flags, plane: FloatArray, start: IntArray, row: IntArray,
    xyz: FloatArray, short: float, t: Vector,
) -> Vector:  # fmt: skip
    """Give the way out in the plane of a curve; nil if that tells none, nan if numpy has to say."""
    if c < 0 or told[c] == 0:
        return 0.0, 0.0, 0.0
    first, last = row[start[c]], row[start[c + 1] - 1]
    axis = 2 if across[c] != 0 else 0
    run = xyz[last, axis] - xyz[first, axis]
    if abs(run) < short:
        return np.nan, np.nan, np.nan
    sense = np.copysign(1.0, -run if across[c] != 0 else run)
    x, y, z = plane[c, 0], plane[c, 1], plane[c, 2]
    return (
        (y * t[2] - z * t[1]) * sense, (z * t[0] - x * t[2]) * sense, (x * t[1] - y * t[0]) * sense
    )  # fmt: skip


@jit
def _normal(
    r: int, curve: IntArray, knot_of: IntArray, meeting: IntArray, told: Flags, across: Flags,
    plane: FloatArray, live: IntArray, short: float, depth: float, start: IntArray, row: IntArray,
    xyz: FloatArray, knot: FloatArray, block: FloatArray, at: FloatArray, segment: IntArray,
    top: FloatArray,
) -> Vector:  # fmt: skip
    """Give the outward unit normal at a crossing: nil where its curves touch, nan if not known.

    `top` (1,), m, is the height of the hull as soon as that was asked for; nan until then.
    """
    f = _unit_tangent(r, 0, curve, knot_of, meeting, start, knot, block, at, segment)
    s = _unit_tangent(r, 1, curve, knot_of, meeting, start, knot, block, at, segment)
    x, y, z = f[1] * s[2] - f[2] * s[1], f[2] * s[0] - f[0] * s[2], f[0] * s[1] - f[1] * s[0]
    length = sqrt(x * x + y * y + z * z)
    if not length > 1e-12:
        x, y, z = 0.0, 0.0, 0.0
    else:
        x, y, z = x / length, y / length, z / length
    a = _way_out(curve[r, 0], told, across, plane, start, row, xyz, short, f)
    b = _way_out(curve[r, 1], told, across, plane, start, row, xyz, short, s)
    if np.isnan(a[0]) or np.isnan(b[0]):
        return np.nan, np.nan, np.nan
    one, other = x * a[0] + y * a[1] + z * a[2], x * b[0] + y * b[1] + z * b[2]
    # Of two plane curves, the one to which the normal is less oblique decides.
    away = other if abs(other) > abs(one) else one
    if a[0] == a[1] == a[2] == b[0] == b[1] == b[2] == 0.0:
        if np.isnan(top[0]):
            top[0] = 0.0
            for i in range(len(live)):
                top[0] = xyz[live[i], 2] if xyz[live[i], 2] > top[0] else top[0]
            top[0] = top[0] if top[0] > depth else depth
        away = y * xyz[r, 1] + z * (xyz[r, 2] - top[0])
    if away < 0.0:
        return -x, -y, -z
    return x, y, z


@jit
def _normal_between(
    r: int, sort: Flags, curve: IntArray, knot_of: IntArray, meeting: IntArray, told: Flags,
    across: Flags, plane: FloatArray, live: IntArray, short: float, depth: float, start: IntArray,
    row: IntArray, meet_start: IntArray, meet_row: IntArray, xyz: FloatArray, knot: FloatArray,
    block: FloatArray, at: FloatArray, segment: IntArray, top: FloatArray,
) -> Vector:  # fmt: skip
    """Give the normal at a point on one curve, from the crossings beside it; as `_normal`.

    Crossings are taken by parameter, of equal ones those that define the curve first; one whose
    normal is nil is passed over. Beyond the outermost, that one is taken.
    """
    c = curve[r, 0]
    place = knot[knot_of[r, 0]]
    knots, begin = start[c + 1] - start[c], meet_start[c]
    count = knots + meet_start[c + 1] - begin
    low = high = (0.0, 0.0, 0.0)
    low_at, high_at = -np.inf, np.inf
    for turn in range(2):
        # The last one at the point or before it, then the first one behind that. What has been
        # tried and has no normal is the bound of the next try.
        bound, last = (np.inf, count) if turn == 0 else (low_at, count)
        while True:
            best, which, there = -1, np.inf, 0
            for i in range(count):
                where = knot[start[c] + i] if i < knots else at[begin + i - knots]
                if turn == 0:
                    fits = where <= place and (where < bound or (where == bound and i < last))
                    fits = fits and (best < 0 or where >= which)
                else:
                    fits = where > bound or (where == bound and i > last)
                    fits = fits and (best < 0 or where < which)
                if not fits:
                    continue
                other = row[start[c] + i] if i < knots else meet_row[begin + i - knots]
                if other >= 0 and sort[other] == 1:
                    best, which, there = i, where, other
            if best < 0:
                break
            found = _normal(
                there, curve, knot_of, meeting, told, across, plane, live, short, depth, start, row,
                xyz, knot, block, at, segment, top,
            )  # fmt: skip
            if np.isnan(found[0]):
                return found
            bound, last = which, best
            if found[0] == 0.0 and found[1] == 0.0 and found[2] == 0.0:
                continue
            if turn == 0:
                low, low_at = found, which
            else:
                high, high_at = found, which
            break
    if low_at == -np.inf:
        low = high
    elif high_at < np.inf and place > low_at:
        step, way = high_at - low_at, place - low_at
        low = (
            (high[0] - low[0]) / step * way + low[0], (high[1] - low[1]) / step * way + low[1],
            (high[2] - low[2]) / step * way + low[2],
        )  # fmt: skip
    return _unit(low[0], low[1], low[2], 1e-12)


@jit
def find_freedoms(
    # The structure.
    sort: Flags, curve: IntArray, knot_of: IntArray, meeting: IntArray, freedom: Flags,
    free: FloatArray, told: Flags, across: Flags, plane: FloatArray, live: IntArray, short: float,
    depth: float, least: float, start: IntArray, row: IntArray, meet_start: IntArray,
    meet_row: IntArray,
    # The numbers, and what is asked.
    xyz: FloatArray, knot: FloatArray, block: FloatArray, at: FloatArray, segment: IntArray,
    rows: IntArray,
    # Room to work in, and what is answered.
    top: FloatArray, normal: FloatArray, along: FloatArray, squares: FloatArray, good: Flags,
) -> bool:  # fmt: skip
    """Set normals at points (k,) and what their freedom is of these, both (k, 3).

    `good` tells which may move: the freedom of the others is almost tangential. False where a
    normal is left to numpy.
    """
    top[0] = np.nan
    for i in range(len(rows)):
        r = rows[i]
        n = (0.0, 0.0, 0.0)
        if sort[r] == 1:
            n = _normal(
                r, curve, knot_of, meeting, told, across, plane, live, short, depth, start, row,
                xyz, knot, block, at, segment, top,
            )  # fmt: skip
        elif sort[r] == 2:
            n = _normal_between(
                r, sort, curve, knot_of, meeting, told, across, plane, live, short, depth, start,
                row, meet_start, meet_row, xyz, knot, block, at, segment, top,
            )  # fmt: skip
        if np.isnan(n[0]):
            return False
        x, y, z = n
        normal[i, 0], normal[i, 1], normal[i, 2] = x, y, z
        if freedom[r] != 0:
            dot = x * free[r, 0] + y * free[r, 1] + z * free[r, 2]
            x, y, z = dot * free[r, 0], dot * free[r, 1], dot * free[r, 2]
            if freedom[r] == 2:
                x, y, z = n[0] - x, n[1] - y, n[2] - z
        square = x * x + y * y + z * z
        good[i] = 1 if sqrt(square) >= least else 0
        squares[i] = square if good[i] != 0 else 1.0
        along[i, 0], along[i, 1], along[i, 2] = x, y, z
    return True


_find_freedoms: Callable[..., bool] = find_freedoms


# --------------------------------------------------------------------------------------
# How far points are to move.


@jit
def _fade(part: float) -> float:
    """Give the fade of `edit.displacement_field.quintic_fade`."""
    s = abs(part)
    if not s < 1.0:
        return 0.0
    return float(1.0 - s * s * s * (10.0 - s * (15.0 - 6.0 * s)))


@jit
def _nearest(
    x: float, y: float, z: float, border: FloatArray, box_start: IntArray, box: FloatArray,
    chosen: IntArray, count: int, best: float,
) -> float:  # fmt: skip
    """Give the square of the distance from the chosen runs of borders, m2; `best` if no less."""
    for i in range(count):
        q = chosen[i]
        a = max(box[q, 0, 0] - x, x - box[q, 1, 0], 0.0)
        b = max(box[q, 0, 1] - y, y - box[q, 1, 1], 0.0)
        c = max(box[q, 0, 2] - z, z - box[q, 1, 2], 0.0)
        if (a * a + b * b + c * c) * 0.999999 >= best:
            continue
        for j in range(box_start[q], box_start[q + 1]):
            a, b, c = x - border[j, 0], y - border[j, 1], z - border[j, 2]
            best = min(best, a * a + b * b + c * c)
    return best


@jit
def distance(
    place: FloatArray, border: FloatArray, box_start: IntArray, box: FloatArray, within: float
) -> float:
    """Give the distance of a place from the nearest border, m; inf far beyond `within`."""
    chosen, reach = np.arange(len(box)), (within * 1.000001) ** 2
    best = _nearest(
        place[0], place[1], place[2], border, box_start, box, chosen, len(box), reach
    )  # fmt: skip
    return sqrt(best) if best < reach else np.inf


@jit
def pull(
    movable: IntArray, xyz: FloatArray, place: FloatArray, planes: FloatArray, border: FloatArray,
    box_start: IntArray, box: FloatArray, amount: float, r_x: float, r_girth: float,
    flat_fade: float, in_plane: float, rows: IntArray, amounts: FloatArray,
) -> int:  # fmt: skip
    """Set the points that a pull reaches, and by how much they move, m; give how many there are."""
    count = 0
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for i in range(len(movable)):
        r = movable[i]
        x, y, z = xyz[r, 0] - place[0], xyz[r, 1] - place[1], xyz[r, 2] - place[2]
        if not abs(x) < r_x or not abs(y) < r_girth or not abs(z) < r_girth:
            continue
        if abs(xyz[r, 1]) < in_plane:
            continue
        inside = False
        for p in range(len(planes)):
            off = planes[p, 0] * xyz[r, 0] + planes[p, 1] * xyz[r, 1] + planes[p, 2] * xyz[r, 2]
            inside = inside or abs(off - planes[p, 3]) < in_plane
        if inside:
            continue
        mine = amount * _fade(x / r_x) * _fade(sqrt(y * y + z * z) / r_girth)
        if mine == 0.0:
            continue
        rows[count], amounts[count] = r, mine
        count += 1
        for k in range(3):
            low[k] = min(low[k], xyz[r, k])
            high[k] = max(high[k], xyz[r, k])
    if not np.isfinite(flat_fade) or not len(border):
        return count
    # What lies farther than the fade reaches has no part in it; by rounding nothing is missed.
    reach = (flat_fade * 1.000001) ** 2
    chosen, near = np.empty(len(box), np.int64), 0
    for q in range(len(box)):
        apart = False
        for k in range(3):
            apart = apart or box[q, 0, k] > high[k] + flat_fade
            apart = apart or box[q, 1, k] < low[k] - flat_fade
        if not apart:
            chosen[near] = q
            near += 1
    kept = 0
    for i in range(count):
        r, mine = rows[i], amounts[i]
        best = _nearest(
            xyz[r, 0], xyz[r, 1], xyz[r, 2], border, box_start, box, chosen, near, reach
        )  # fmt: skip
        if best < reach:
            mine = mine * (1.0 - _fade(sqrt(best) / flat_fade))
        if mine != 0.0:
            rows[kept], amounts[kept] = r, mine
            kept += 1
    return kept


_pull: Callable[..., int] = pull
_distance: Callable[..., float] = distance


@attrs.frozen(eq=False)
class Borders:
    """Places along the borders of flats, in short runs with a box around each.

    Attributes
    ----------
    place : (n, 3), m
        The places, border by border.
    start, box : (q + 1,) int, (q, 2, 3) m
        Where each run begins, its least and largest coordinates.
    """

    place: FloatArray
    start: IntArray
    box: FloatArray

    @classmethod
    def of(cls, borders: list[FloatArray], run: int = 12) -> Borders:
        """Cut borders (k, 3), m, into runs."""
        runs = [each[i : i + run] for each in borders for i in range(0, len(each), run)]
        start = np.zeros(len(runs) + 1, np.int64)
        np.cumsum([len(each) for each in runs], out=start[1:])
        box = np.array([(each.min(axis=0), each.max(axis=0)) for each in runs]).reshape(-1, 2, 3)
        found = cls(np.concatenate([np.zeros((0, 3)), *borders]), start, box)
        freeze(*found.arrays())
        return found

    def arrays(self) -> tuple[NDArray[np.generic], ...]:
        """Give the arrays in the order in which `pull` takes them."""
        return self.place, self.start, self.box


class CompiledFields:
    """Normals, freedoms and pulls of the points of a program; for one thread at a time."""

    def __init__(self, structure: FieldStructure, program: Program) -> None:
        self._structure = (
            *structure.arrays(), structure.short, structure.depth, structure.least,
            program.start, program.row, program.meet_start, program.meet_row,
        )  # fmt: skip
        self._room = np.zeros(1)

    def freedoms(
        self, xyz: FloatArray, values: Values, rows: IntArray
    ) -> tuple[FloatArray, FloatArray, FloatArray, NDArray[np.bool_]] | None:
        """Give what `edit.displacement_field.PointFreedoms` has; None where numpy has to tell.

        Parameters
        ----------
        xyz : (n, 3), m
            Places of all points.
        values : Values
            The numbers of the curves.
        rows : (k,) int
            The points.
        """
        count = len(rows)
        normal, along = np.empty((count, 3)), np.empty((count, 3))
        square, good = np.empty(count), np.empty(count, np.int8)
        numbers = (xyz, values.knot, values.block, values.at, values.segment, rows)
        known = _find_freedoms(
            *self._structure, *map(read_only, numbers), self._room, normal, along, square, good
        )
        return (normal, along, square, good.view(np.bool_)) if known else None

    def pulled(
        self, xyz: FloatArray, movable: IntArray, place: FloatArray, radius: tuple[float, float],
        amount: float, planes: FloatArray, borders: Borders, flat_fade: float, in_plane: float,
    ) -> tuple[IntArray, FloatArray]:  # fmt: skip
        """Give the points that a pull reaches, ascending, and by how much each is to move, m.

        Parameters
        ----------
        xyz : (n, 3), m
            Places of all points.
        movable : (k,) int
            Those that may be moved but for where they lie.
        place, radius, amount : (3,) m, (float, float) m, float m
            Of the pull.
        planes : (p, 4), m
            Normals and offsets of planes that points stay in, `in_plane` (m) to either side.
        borders, flat_fade : Borders, float m
            Within this distance of them the pull fades.
        """
        rows, amounts = np.empty(len(movable), np.int64), np.empty(len(movable))
        count = _pull(
            *map(read_only, (movable, xyz, place, planes)), *borders.arrays(), amount, *radius,
            flat_fade, in_plane, rows, amounts,
        )  # fmt: skip
        return rows[:count], amounts[:count]

    def distance(self, place: FloatArray, borders: Borders, within: float) -> float:
        """Give how far a place (3,), m, lies from the nearest border; inf far beyond `within`."""
        return _distance(read_only(place), *borders.arrays(), within)

    def runs_of(self, borders: list[FloatArray]) -> Borders:
        """Give borders (k, 3), m, as the others take them."""
        return Borders.of(borders)


def warm() -> bool:
    """Compile all, or load what was compiled; tell whether it was loaded."""
    none, nowhere = np.zeros(0, np.int64), np.zeros((0, 3))
    flags, two, wide = np.zeros(0, np.int8), np.zeros((0, 2), np.int64), np.zeros(0)
    structure = FieldStructure(flags, two, two, two, flags, nowhere, flags, flags, nowhere, none,
                               0.0, 0.0, 0.0)  # fmt: skip
    freeze(none, nowhere, flags, two, wide)
    room = (np.zeros(1), np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0),
            np.zeros(0, np.int8))  # fmt: skip
    _find_freedoms(
        *structure.arrays(), 0.0, 0.0, 0.0, none, none, none, none, nowhere, wide, wide, wide, none,
        none, *room,
    )  # fmt: skip
    place, planes, borders = np.zeros(3), np.zeros((0, 4)), Borders.of([])
    freeze(place, planes)
    _pull(none, nowhere, place, planes, *borders.arrays(), 0.0, 1.0, 1.0, 1.0, 0.0,
          np.zeros(0, np.int64), np.zeros(0))  # fmt: skip
    _distance(place, *borders.arrays(), 1.0)
    return was_loaded(find_freedoms) and was_loaded(pull) and was_loaded(distance)
