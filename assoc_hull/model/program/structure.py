"""The structure of a net as flat arrays, compiled once, and the numbers that it is run on.

Which curve is made through which points, which planes it meets and where these meetings go changes
seldom; the numbers change with every move of the hand. So the structure is compiled, in the order
in which curves are made, and every question about numbers is a run of it: see `run_program`. A run
never changes structure. Where a curve comes to meet other planes than before, a gap grows over its
limit or something else asks for more than new numbers, it says so, and the edit goes the full way.

Curves stand in the order of their levels here, and are counted in it: `number` leads back to the
tables. Points keep the numbers of their rows.
"""

from __future__ import annotations

from collections.abc import Iterable

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.model.feature_geometry import rounding_of
from assoc_hull.model.generated_curves import attached_curves
from assoc_hull.model.index import Index
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = [
    "KEEP_THEIR_SHAPE",
    "CompiledFeatures",
    "Program",
    "PublishedProgram",
    "Values",
    "compile_program",
    "plane_lines",
]

Flags = NDArray[np.int8]

_NEAR = 2.0
"""Times `Tolerances.factor`: latent meetings as near as this (m) may be one crossing."""

_CIRCLE, _FLAT, _STRAIGHT, _NO_SHAPE = 0, 1, 2, 3

KEEP_THEIR_SHAPE = (_FLAT, _STRAIGHT)
"""A flat has its plane, a straight run the chord of its ends, wherever points go."""


@attrs.frozen(eq=False)
class CompiledFeatures:
    """The features of a hull, by number: what their points must lie on.

    Attributes
    ----------
    owner_start : (rows + 1,) int
        Where the features that own each point begin in `owner`.
    owner : (k,) int
        Numbers of features.
    start, point : (f + 1,), (p,) int
        The points of each feature, in order.
    shape : (f,) int8
        0 a circle, 1 a flat, 2 a straight run, 3 nothing to lie off.
    numbers : (f, 7)
        Centre and radius of a circle, or nil and the offset of a flat, m; then the unit normal.
    limit : (f,), m
        How far points may lie off.
    """

    owner_start: IntArray
    owner: IntArray
    start: IntArray
    point: IntArray
    shape: Flags
    numbers: FloatArray
    limit: FloatArray

    @classmethod
    def none(cls, points: int) -> CompiledFeatures:
        """Give those of a hull with so many points that has no features."""
        none, begin = np.zeros(0, np.int64), np.zeros(1, np.int64)
        start, shape = np.zeros(points + 1, np.int64), np.zeros(0, np.int8)
        numbers, limit = np.zeros((0, 7)), np.zeros(0)
        freeze(none, begin, start, shape, numbers, limit)
        return cls(start, none, begin, none, shape, numbers, limit)

    def own(self, rows: IntArray) -> bool:
        """Tell whether some of the points (k,) are owned by a feature."""
        return bool((self.owner_start.take(rows + 1) != self.owner_start.take(rows)).any())


@attrs.frozen(eq=False)
class Program:
    """The structure of a net.

    Attributes
    ----------
    number : (m,) int
        The curves, by level, then by number.
    local : (curves,) int
        Where each curve of the tables stands here; -1 for one that is not there.
    level : (l + 1,) int
        Where the curves of each level begin.
    start, row : (m + 1,), (n,) int
        The defining points of each curve, in order.
    kind, direction : (n,) int8, (n, 3)
        How the curve passes them.
    end_kind, end_vector : (m, 2) int8, (m, 2, 3)
        End conditions.
    own_axis, own_offset : (m,) int, (m,) m
        The coordinate that the plane of a curve fixes, -1 if none, and its value.
    reader : (rows, 2) int
        The curves made through each point, -1 if none.
    rider_start, rider : (rows + 1,), (k,) int
        The points that ride with each point.
    riding_start, riding : (m + 1,), (k,) int
        The points of each curve that ride.
    anchor, weight : (rows, 2) int, (rows,)
        What they ride with.
    normal, axis, first : (s, 3), (s,) int, (s + 1,) int
        Sets of parallel planes: normal, the axis along which it points or -1, first plane.
    offset : (p,), m
        Of the planes, ascending within a set.
    set_start, sets : (m + 1,), (k,) int
        The sets of planes that each curve is cut with.
    cell_start, cell : (k,), (c,) int
        For each of these sets, where in `cell` its planes begin; `cell` has the first meeting of
        the curve with each plane, and behind the last plane the end of these meetings.
    meet_start : (m + 1,) int
        Where the meetings of each curve begin.
    meet_curve, meet_plane, meet_row : (q,) int
        Curve and plane of each meeting, and its crossing, -1 if it is latent.
    meet_sign : (q,) int8
        The sense in which the curve passes the plane.
    drive_start, drive : (m + 1,), (k,) int
        The meetings of each curve from which points are computed.
    watch, watch_a, watch_b : (w,) int
        Watched crossings, and their meetings on both curves.
    limit : (w,), m
        Their largest gaps.
    watch_start, watched : (m + 1,), (k,) int
        Numbers of the watched crossings on each curve.
    pair_a, pair_b : (k,) int
        Latent meetings of two curves with one another's planes: should they come together, a
        crossing is born.
    pair_start, paired : (m + 1,), (k,) int
        Numbers of these pairs on each curve.
    sense_start, sense : (m + 1,), (k,) int
        Meetings that must lie where their crossings do: the curve is made through these.
    unsure : (m,) int8
        Curves whose edits always go the full way.
    unsure_row : (rows,) int8
        Points whose moves do.
    features : CompiledFeatures
        What points must lie on.
    near : float, m
        Meetings of a latent pair as near as this may be one crossing.
    factor : float
        Of lengths, by the size of the hull.
    """

    number: IntArray
    local: IntArray
    level: IntArray
    start: IntArray
    row: IntArray
    kind: Flags
    direction: FloatArray
    end_kind: Flags
    end_vector: FloatArray
    own_axis: IntArray
    own_offset: FloatArray
    reader: IntArray
    rider_start: IntArray
    rider: IntArray
    riding_start: IntArray
    riding: IntArray
    anchor: IntArray
    weight: FloatArray
    normal: FloatArray
    axis: IntArray
    first: IntArray
    offset: FloatArray
    set_start: IntArray
    sets: IntArray
    cell_start: IntArray
    cell: IntArray
    meet_start: IntArray
    meet_curve: IntArray
    meet_plane: IntArray
    meet_row: IntArray
    meet_sign: Flags
    drive_start: IntArray
    drive: IntArray
    watch: IntArray
    watch_a: IntArray
    watch_b: IntArray
    limit: FloatArray
    watch_start: IntArray
    watched: IntArray
    pair_a: IntArray
    pair_b: IntArray
    pair_start: IntArray
    paired: IntArray
    sense_start: IntArray
    sense: IntArray
    unsure: Flags
    unsure_row: Flags
    features: CompiledFeatures
    near: float
    factor: float

    @property
    def curves(self) -> int:
        """Number of curves."""
        return len(self.number)


@attrs.frozen(eq=False)
class Values:
    """The numbers of a net, in the arrays that a run writes.

    Attributes
    ----------
    xyz : (rows, 3), m
        Places of points.
    base, anchor_from : (rows, 3), (rows, 2, 3), m
        What riding points ride from.
    knot : (n,), m
        Chord parameters of defining points.
    block : (9 n,)
        Curve by curve (9, k): its points and its derivatives after and before them, coordinate by
        coordinate.
    at, place, segment : (q,) m, (q, 3) m, (q,) int
        Meetings: chord parameter, place, and the segment of the curve, from 0.
    gap : (w,), m
        Of watched crossings.
    folds, lowest : (m,) int, (m,) m
        So often each curve turns back on itself, and its least half-breadth.
    """

    xyz: FloatArray
    base: FloatArray
    anchor_from: FloatArray
    knot: FloatArray
    block: FloatArray
    at: FloatArray
    place: FloatArray
    segment: IntArray
    gap: FloatArray
    folds: IntArray
    lowest: FloatArray

    @classmethod
    def blank(cls, program: Program, state: HullState) -> Values:
        """Take the places of points from the tables; all else is still to be run."""
        table, knots, meetings = state.rows, len(program.row), len(program.meet_row)
        return cls(
            table.xyz.data.copy(), table.base.data.copy(), table.anchor_from.data.copy(),
            np.zeros(knots), np.zeros(9 * knots), np.zeros(meetings), np.zeros((meetings, 3)),
            np.zeros(meetings, np.int64), np.zeros(len(program.watch)),
            np.zeros(program.curves, np.int64), np.zeros(program.curves),
        )  # fmt: skip

    def copy(self) -> Values:
        """Give the same numbers in arrays of their own."""
        return Values(*(getattr(self, each.name).copy() for each in attrs.fields(Values)))


def _listed(groups: Iterable[Iterable[int]]) -> tuple[IntArray, IntArray]:
    """Put lists one behind the other: where each begins, and all of them."""
    lists = [np.array(list(group), np.int64) for group in groups]
    start = np.zeros(len(lists) + 1, np.int64)
    np.cumsum([len(each) for each in lists], out=start[1:])
    return start, np.concatenate([np.zeros(0, np.int64), *lists])


def _grouped(owner: IntArray, item: IntArray, count: int) -> tuple[IntArray, IntArray]:
    """Give the items of each owner, in the order in which they stand: begins, and items."""
    order = np.argsort(owner, kind="stable")
    start = np.searchsorted(owner[order], np.arange(count + 1))
    return start.astype(np.int64), item[order].astype(np.int64)


@attrs.frozen(eq=False)
class PublishedProgram:
    """The structure of a hull, and its numbers as they are published; never written to."""

    program: Program
    values: Values


def compile_program(state: HullState, index: Index) -> Program | None:
    """Compile the structure of a net; None while it has curves that cannot be made.

    Parameters
    ----------
    state : HullState
        The tables, in a published state.
    index : Index
        Look-ups derived from them.
    """
    curves = state.live("curves")
    spline = state.curves.spline.data
    if state.failed or not len(curves) or any(spline[each] is None for each in curves.tolist()):
        return None
    order = np.lexsort((curves, index.level[curves]))
    number, level = curves[order], index.level[curves[order]]
    count = len(number)
    local = np.full(state.curves.count + 1, -1)  # the last entry stands for no curve
    local[number] = np.arange(count)
    edges = np.flatnonzero(np.diff(level)) + 1
    begins = np.concatenate([[0], edges, [count]]).astype(np.int64)
    start, row = _listed(state.curves.rows[each] for each in number.tolist())
    part = 2 * row + np.concatenate([state.curves.side[each] for each in number.tolist()])
    table, lines = state.rows, state.curves.line[number]
    ends = [state.curves.ends[each] for each in number.tolist()]
    planes = _Planes.of(state, index, number)
    meets = _Meetings.of(state, number, planes)
    if meets is None:
        return None
    drives, undriven = _drives(state, local, meets)
    watch, watch_a, watch_b, unwatched = _watches(state, local, meets)
    pair_a, pair_b = _latent_pairs(state, number, meets).T.copy()
    sense, unsensed = _senses(state, start, row, part, meets)
    unsure, unsure_row = np.zeros(count, np.int8), np.zeros(table.count, np.int8)
    unsure[np.concatenate([undriven, unwatched, unsensed])] = 1
    # Generated curves, and the ends that these are made between, are read from definitions.
    unsure[local[np.array(list(attached_curves(state)), np.int64)]] = 1
    unsure_row[list(index.makes)] = 1
    normal = state.lines.normal[lines]
    flat = (normal == 1.0).any(axis=1)
    program = Program(
        number=number, local=local[:-1].copy(), level=begins, start=start, row=row,
        kind=table.kind.data.reshape(-1)[part],
        direction=table.direction.take_parts(part),
        end_kind=np.array([end.kind for end in ends], np.int8),
        end_vector=np.array([end.vector for end in ends], np.float64),
        own_axis=np.where(flat, np.argmax(normal == 1.0, axis=1), -1),
        own_offset=np.where(flat, state.lines.offset[lines], 0.0),
        reader=local[np.where(table.alive[:, None], table.reader.data, -1)],
        **dict(zip(_RIDING, _riders(state, index, local, count), strict=True)),
        anchor=table.anchor.data.copy(), weight=table.anchor_weight.data.copy(),
        normal=planes.normal, axis=planes.axis, first=planes.first, offset=planes.offset,
        set_start=planes.set_start, sets=planes.sets,
        **_paired("cell_start", "cell", _cells(planes, meets)),
        meet_start=meets.start, meet_curve=meets.curve, meet_plane=meets.plane,
        meet_row=meets.row, meet_sign=meets.sign, drive_start=drives[0], drive=drives[1],
        watch=watch, watch_a=watch_a, watch_b=watch_b, limit=table.limit[watch],
        **_paired("watch_start", "watched", meets.pairs_by_curve(watch_a, watch_b)),
        pair_a=pair_a, pair_b=pair_b,
        **_paired("pair_start", "paired", meets.pairs_by_curve(pair_a, pair_b)),
        **_paired("sense_start", "sense", meets.by_curve(sense)),
        unsure=unsure, unsure_row=unsure_row, features=_features(state),
        near=_NEAR * state.tolerances.factor, factor=state.tolerances.factor,
    )  # fmt: skip
    freeze(
        *(each for each in attrs.astuple(program, recurse=False) if isinstance(each, np.ndarray))
    )
    return program


def plane_lines(state: HullState, index: Index, program: Program) -> IntArray:
    """Give the line of each plane of a compiled structure, (p,)."""
    of_line = _Planes.of(state, index, program.number).of_line
    lines = np.flatnonzero(of_line >= 0)
    found = np.zeros(len(program.offset), np.int64)
    found[of_line[lines]] = lines
    return found


_RIDING = ("rider_start", "rider", "riding_start", "riding")


def _paired(one: str, other: str, arrays: tuple[IntArray, IntArray]) -> dict[str, IntArray]:
    return {one: arrays[0], other: arrays[1]}


@attrs.frozen(eq=False)
class _Planes:
    """Sets of parallel planes, in the order of the names of their groups."""

    normal: FloatArray
    axis: IntArray
    first: IntArray
    offset: FloatArray
    of_line: IntArray
    set_start: IntArray
    sets: IntArray

    @classmethod
    def of(cls, state: HullState, index: Index, number: IntArray) -> _Planes:
        names, place = state.groups.name.data, dict[int, int]()
        found = {id(each): each for sets in index.partners.values() for each in sets}
        group = {key: int(state.lines.group[each.lines[0]]) for key, each in found.items()}
        ordered = sorted(found, key=lambda key: (names[group[key]], tuple(found[key].normal)))
        for rank, key in enumerate(ordered):
            place[key] = rank
        each_set = [found[key] for key in ordered]
        first, line = _listed(each.lines.tolist() for each in each_set)
        of_line = np.full(state.lines.count, -1)
        of_line[line] = np.arange(len(line))
        groups = state.lines.group[state.curves.line[number]].tolist()
        set_start, sets = _listed(
            [place[id(each)] for each in index.partners.get(mine, ())] for mine in groups
        )
        normal = np.array([each.normal for each in each_set], np.float64).reshape(-1, 3)
        offset = np.concatenate([np.zeros(0), *(each.offsets for each in each_set)])
        along = np.array([_axis(each) for each in normal.tolist()], np.int64)
        return cls(normal, along, first, offset, of_line, set_start, sets)


def _axis(normal: list[float]) -> int:
    """Give the axis along or against which a normal points, -1 if it is askew."""
    sizes = [abs(part) for part in normal]
    return sizes.index(1.0) if sizes.count(0.0) == 2 and 1.0 in sizes else -1


@attrs.frozen(eq=False)
class _Meetings:
    """Where curves meet planes; `known` has the meeting at twice a point plus the side."""

    start: IntArray
    curve: IntArray
    line: IntArray
    plane: IntArray
    row: IntArray
    sign: Flags
    known: IntArray

    @classmethod
    def of(cls, state: HullState, number: IntArray, planes: _Planes) -> _Meetings | None:
        """Read the tables; None if these and the planes are of two states."""
        found: list[CurveIntersections] = [state.curves.meets[curve] for curve in number.tolist()]
        start, line = _listed(each.line.tolist() for each in found)
        curve = np.repeat(np.arange(len(number)), np.diff(start))
        plane = planes.of_line[line]
        if (plane < 0).any() or ((np.diff(plane) < 0) & (np.diff(curve) == 0)).any():
            return None
        row = np.concatenate([np.zeros(0, np.int64), *(each.row for each in found)])
        sign = np.concatenate([np.zeros(0, np.int8), *(each.sign for each in found)])
        held = np.flatnonzero(row >= 0)
        side = state.rows.curve[row[held], 0] != number[curve[held]]
        known = np.full(2 * state.rows.count, -1)
        known[2 * row[held] + side] = held
        return cls(start, curve, line, plane, row, sign, known)

    def by_curve(self, meeting: IntArray) -> tuple[IntArray, IntArray]:
        """Give some meetings curve by curve."""
        return _grouped(self.curve[meeting], meeting, len(self.start) - 1)

    def pairs_by_curve(self, one: IntArray, other: IntArray) -> tuple[IntArray, IntArray]:
        """Give the numbers of pairs of meetings by the curves of both."""
        owner = self.curve[np.concatenate([one, other])]
        return _grouped(owner, np.tile(np.arange(len(one)), 2), len(self.start) - 1)


def _cells(planes: _Planes, meets: _Meetings) -> tuple[IntArray, IntArray]:
    """Give where the meetings of each curve with each plane of its sets begin."""
    owner = np.repeat(np.arange(len(planes.set_start) - 1), np.diff(planes.set_start)).tolist()
    begins, cells, place = list[int](), list[IntArray](), 0
    for curve, each in zip(owner, planes.sets.tolist(), strict=True):
        low, high = int(meets.start[curve]), int(meets.start[curve + 1])
        wanted = np.arange(planes.first[each], planes.first[each + 1] + 1)
        begins.append(place)
        cells.append(low + np.searchsorted(meets.plane[low:high], wanted))
        place += len(wanted)
    return np.array(begins, np.int64), np.concatenate([np.zeros(0, np.int64), *cells])


def _riders(
    state: HullState, index: Index, local: IntArray, count: int
) -> tuple[IntArray, IntArray, IntArray, IntArray]:
    """Give the points that ride with each point, and those that ride on each curve."""
    table = state.rows
    start, rider = _listed(index.riders.get(row, ()) for row in range(table.count))
    riding = np.flatnonzero(table.alive.data & (table.anchor.data >= 0).any(axis=1))
    return start, rider, *_grouped(local[table.curve[riding, 0]], riding, count)


def _drives(
    state: HullState, local: IntArray, meets: _Meetings
) -> tuple[tuple[IntArray, IntArray], IntArray]:
    """Give the meetings that points are computed from, and curves that lack one of these."""
    table = state.rows
    driven = np.flatnonzero(table.alive.data & (table.driver.data >= 0))
    driver = table.driver[driven]
    meeting = meets.known[2 * driven + (table.curve[driven, 0] != driver)]
    there = meeting >= 0
    return meets.by_curve(meeting[there]), local[driver[~there]]


def _watches(
    state: HullState, local: IntArray, meets: _Meetings
) -> tuple[IntArray, IntArray, IntArray, IntArray]:
    """Give the watched crossings with their meetings on both curves, and curves that lack one."""
    table = state.rows
    watched = table.alive.data & (table.sort.data == Sort.CROSSING)
    rows = np.flatnonzero(watched & (table.role.data == Role.WATCHED))
    one, other = meets.known[2 * rows], meets.known[2 * rows + 1]
    both = (one >= 0) & (other >= 0)
    lacking = local[table.curve[rows[~both]].ravel()]
    return rows[both], one[both], other[both], lacking[lacking >= 0]


def _latent_pairs(state: HullState, number: IntArray, meets: _Meetings) -> IntArray:
    """Give the latent meetings of two curves with one another's planes, (k, 2)."""
    latent = np.flatnonzero(meets.row < 0)
    mine = state.curves.line[number[meets.curve[latent]]]
    by_lines: dict[tuple[int, int], list[int]] = {}
    for each, own, met in zip(
        latent.tolist(), mine.tolist(), meets.line[latent].tolist(), strict=True
    ):
        by_lines.setdefault((own, met), []).append(each)
    pairs = [
        (one, other)
        for (own, met), ones in by_lines.items()
        if own < met
        for one in ones
        for other in by_lines.get((met, own), ())
    ]
    return np.array(sorted(pairs), np.int64).reshape(-1, 2)


def _senses(
    state: HullState, start: IntArray, row: IntArray, part: IntArray, meets: _Meetings
) -> tuple[IntArray, IntArray]:
    """Give the meetings that must lie where their crossings do, and curves that lack one.

    As in the check of senses, contacts are left out where a line ends or turns on a boundary.
    """
    table = state.rows
    owner = np.repeat(np.arange(len(start) - 1), np.diff(start))
    hit = meets.known[part]
    contact = table.contact[row]
    needed = (table.sort[row] == Sort.CROSSING) & ~(contact & ((part & 1 == 1) | (hit < 0)))
    return hit[needed & (hit >= 0)], owner[needed & (hit < 0)]


def _features(state: HullState) -> CompiledFeatures:
    """Put the features into arrays."""
    features = state.features
    start, point = _listed(each.points for each in features)
    owner = np.repeat(np.arange(len(features)), np.diff(start))
    owner_start, owners = _grouped(point, owner, state.rows.count)
    shape, numbers = np.full(len(features), _NO_SHAPE, np.int8), np.zeros((len(features), 7))
    for i, each in enumerate(features):
        if each.centre is not None and each.normal is not None and each.radius is not None:
            shape[i], numbers[i] = _CIRCLE, (*each.centre, each.radius, *each.normal)
        elif each.kind == "flat" and each.normal is not None and each.offset is not None:
            shape[i], numbers[i] = _FLAT, (0.0, 0.0, 0.0, each.offset, *each.normal)
        elif each.kind == "straight":
            shape[i] = _STRAIGHT
    limit = np.array([each.gap + rounding_of(state) for each in features], np.float64)
    found = CompiledFeatures(owner_start, owners, start, point, shape, numbers, limit)
    freeze(owner_start, owners, start, point, shape, numbers, limit)
    return found
