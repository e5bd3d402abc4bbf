"""Where the planes of lines come to under a mapping, and what a mapping may not do.

The plane of a driver moves where the mapping sends it to a plane; a driver whose image
lies in no plane becomes a space curve. The plane of a follower stays, or moves where the
mapping sends most of it to a parallel plane, whichever is asked.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from functools import cached_property

import attrs
import numpy as np

from assoc_hull.edit.space_map import SpaceMap
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.tables import HullState

__all__ = [
    "IN_PLANE",
    "PlaneSamples",
    "TransformedPlanes",
    "carry_planes",
    "flat_borders",
    "mostly_in_one_plane",
    "planar_lines",
    "plane_heights",
    "snap_into_planes",
]

IN_PLANE = 1e-9
"""A place as near to a plane as this (m) lies in it."""

_APART = 1e-6
"""Parallel lines of one group lie farther apart than this (m)."""

BoolArray = np.typing.NDArray[np.bool_]


@attrs.frozen(eq=False)
class TransformedPlanes:
    """The planes of all lines after a transformation.

    Attributes
    ----------
    normal : (l, 3)
        Unit normals; zero for space curves.
    offset : (l,), m
        Offsets; nan for space curves.
    planar : (l,) bool
        Whether a line lies in a plane.
    bent : dict of int to float, m
        Lines that come to lie in no plane any more, and how far their images leave one.
    """

    normal: FloatArray
    offset: FloatArray
    planar: BoolArray
    bent: dict[int, float]


def plane_heights(xyz: FloatArray, normal: FloatArray) -> FloatArray:
    """Give ``normal . P`` of places (n, 3), by one normal or one each, (n,), m."""
    found: FloatArray = xyz[:, 0] * normal[..., 0] + xyz[:, 1] * normal[..., 1]
    return found + xyz[:, 2] * normal[..., 2]


def carry_planes(
    state: HullState,
    space: SpaceMap,
    drivers: IntArray,
    *,
    follow: bool,
    levels: Mapping[int, float] | None = None,
    samples: PlaneSamples | None = None,
) -> TransformedPlanes:
    """Find where the planes of all lines come to.

    Parameters
    ----------
    state : HullState
        The tables.
    space : SpaceMap
        The mapping.
    drivers : (d,) int
        The driving lines.
    follow : bool
        Whether the planes of followers move where the mapping moves them.
    levels : mapping of int to float, m, or None
        Offsets that planes of followers get, by line.
    samples : PlaneSamples or None
        Places along the planar lines of these tables, if they are at hand.

    Raises
    ------
    BadInputError
        The mapping moves the centre plane, or lines of a group through one another.
    """
    lines = state.lines
    normal, offset = lines.normal.data.copy(), lines.offset.data.copy()
    planar, bent = lines.planar.data.copy(), dict[int, float]()
    drive, asked = set(drivers.tolist()), levels or {}
    flat = planar_lines(state)
    apart = [line for line in flat if line in asked and line not in drive]
    # A driver goes where the mapping sends it, whatever is asked of followers.
    offset[apart] = [asked[line] for line in apart]
    going = [line for line in flat if (follow or line in drive) and line not in apart]
    samples = PlaneSamples.of(state, going) if samples is None else samples.some(going)
    samples = samples.moving(space, normal, offset)
    after, heights = samples.mapped(space, normal)
    even, told = heights.even()
    offset[samples.number[even]] = told[even]
    centre = _are_centre(state, samples.number)
    # Most lines stay in planes, and nothing more is asked of them.
    for i in np.flatnonzero(~even | centre).tolist():
        line, span = samples.lines[i], slice(samples.start[i], samples.start[i + 1])
        if even[i]:
            offset[line] = _centre_kept(state, line, float(told[i]))
            continue
        level = np.sort(heights.level[span])
        spread = float(level[-1] - level[0])
        if spread <= IN_PLANE:
            offset[line] = _centre_kept(state, line, float(level[len(level) // 2]))
        elif line in drive:
            found = _oblique(state, space, line, samples.before[span], after[span])
            if found is None:
                # Only one side of a hull is stored: what lies in the centre plane may not leave it.
                _refuse_centre(state, line, spread)
                bent[line], planar[line] = spread, False
                normal[line], offset[line] = 0.0, np.nan
            else:
                normal[line], offset[line] = found
        # One feature may bend a part of a follower: its plane goes with the rest, or stays.
        elif mostly_in_one_plane(level):
            offset[line] = _centre_kept(state, line, float(level[len(level) // 2]))
    planes = TransformedPlanes(normal, offset, planar, bent)
    _check_order(state, planes)
    return planes


def planar_lines(state: HullState) -> list[int]:
    """Give the lines that lie in planes, in their order."""
    lines = state.live("lines")
    found: list[int] = lines[state.lines.planar[lines]].tolist()
    return found


def mostly_in_one_plane(level: FloatArray) -> bool:
    """Tell whether at least half of sorted heights (m) are one height."""
    return bool((np.abs(level - level[len(level) // 2]) <= IN_PLANE).mean() >= 0.5)


@attrs.frozen(eq=False)
class PlaneSamples:
    """Places along lines, by which it is told whether these stay in planes.

    Attributes
    ----------
    lines : tuple of int
    start : tuple of int
        Where the places of each line begin, and their end.
    before : (n, 3), m
    """

    lines: tuple[int, ...]
    start: tuple[int, ...]
    before: FloatArray
    _some: dict[tuple[int, ...], PlaneSamples] = attrs.field(factory=dict, init=False, repr=False)

    @classmethod
    def of(cls, state: HullState, lines: Sequence[int]) -> PlaneSamples:
        """Take places along lines, which the tables hold."""
        if not lines:
            return cls((), (0,), np.zeros((0, 3)))
        curves = [state.lines.curves[line] for line in lines]
        splines = [state.spline(curve) for part in curves for curve in part]
        start, before = sample(SplineBatch.join(splines), 4)
        cut = start[np.cumsum([0, *map(len, curves)])]
        return cls(tuple(lines), tuple(cut.tolist()), np.array(before))

    def some(self, lines: Sequence[int]) -> PlaneSamples:
        """Give those of some of its lines."""
        if self.lines == tuple(lines):
            return self
        found = self._some.get(tuple(lines))
        if found is None:
            found = self._chosen(lines)
            self._some.clear()
            self._some[tuple(lines)] = found
        return found

    def _chosen(self, lines: Sequence[int]) -> PlaneSamples:
        at = {line: i for i, line in enumerate(self.lines)}
        spans = [(self.start[at[line]], self.start[at[line] + 1]) for line in lines]
        parts = [self.before[begin:end] for begin, end in spans]
        start = itertools.accumulate((len(each) for each in parts), initial=0)
        return PlaneSamples(tuple(lines), tuple(start), np.concatenate([np.zeros((0, 3)), *parts]))

    @cached_property
    def number(self) -> IntArray:
        """The lines, (l,)."""
        return np.array(self.lines, np.int64)

    @cached_property
    def _owner(self) -> IntArray:
        """The line of each place, (n,)."""
        return self.number.repeat(np.diff(self.start))

    def mapped(self, space: SpaceMap, normal: FloatArray) -> tuple[FloatArray, LineHeights]:
        """Give where a mapping sends the places, (n, 3), m, and how high over planes these lie.

        `normal` (l, 3) is of all lines of the tables.
        """
        after = space.places(self.before) if self.lines else self.before
        level = plane_heights(after, normal[self._owner])
        return after, LineHeights(level, np.array(self.start[:-1], np.int64))

    @cached_property
    def _levels(self) -> tuple[tuple[BoolArray, FloatArray], ...]:
        """Of which lines each coordinate of all places is one, to the bit, and which it is."""
        start = np.array(self.start[:-1], np.int64)
        return tuple(LineHeights(level, start).even() for level in self.before.T)

    def moving(self, space: SpaceMap, normal: FloatArray, offset: FloatArray) -> PlaneSamples:
        """Give those of lines whose planes may move: not across an axis along which nothing moves.

        `normal` (l, 3) and `offset` (l,), m, are of all lines of the tables.
        """
        if all(space.moves) or not self.lines:
            return self
        across, still = normal[self.number] == 1.0, np.zeros(len(self.lines), bool)
        for axis in np.flatnonzero(~np.array(space.moves)).tolist():
            even, level = self._levels[axis]
            still |= across[:, axis] & even & (level == offset[self.number])
        return self.some([line for line, stays in zip(self.lines, still, strict=True) if not stays])


@attrs.frozen(eq=False)
class LineHeights:
    """Heights of places along lines, (n,), m; those of each line begin at `start` (l,)."""

    level: FloatArray
    start: IntArray

    def even(self) -> tuple[BoolArray, FloatArray]:
        """Tell of which lines all heights are one, to the bit, and give it, (l,) each."""
        if not len(self.start):
            return np.zeros(0, bool), np.zeros(0)
        least = np.minimum.reduceat(self.level, self.start)
        # There are two zeros: which of them it is, the places in their order tell.
        most = np.maximum.reduceat(self.level, self.start)
        found: BoolArray = (least == most) & (least != 0.0)
        return found, least


def _are_centre(state: HullState, lines: IntArray) -> BoolArray:
    """Tell which lines lie in the centre plane."""
    level = state.lines.offset[lines] == 0.0
    found: BoolArray = (np.abs(state.lines.normal[lines, 1]) == 1.0) & level
    return found


def _is_centre(state: HullState, line: int) -> bool:
    return bool(_are_centre(state, np.array([line]))[0])


def _centre_kept(state: HullState, line: int, level: float) -> float:
    """Give the new offset of a line; the centre plane stays to the bit."""
    if not _is_centre(state, line):
        return level
    _refuse_centre(state, line, abs(level))
    return 0.0


def _refuse_centre(state: HullState, line: int, away: float) -> None:
    if _is_centre(state, line) and away > IN_PLANE:
        raise BadInputError(
            f"the mapping moves {state.lines.name[line]} {away:.3g} m out of the centre plane",
            "in transform", "keep y = 0 where y = 0: only one side of a hull is stored",
        )  # fmt: skip


def _oblique(
    state: HullState, space: SpaceMap, line: int, before: FloatArray, after: FloatArray
) -> tuple[FloatArray, float] | None:
    """Give the oblique plane a diagonal comes to lie in; None for other lines, or without one.

    Sections, waterlines and buttocks have planes of one direction, and boundary curves
    need none. Under a map with the Jacobian J a normal n goes to one along cof(J) n.
    """
    if state.family(line).axis is not None or state.lines.boundary[line] >= 0:
        return None
    slope = space.jacobians(before[:1])[0]
    old = state.lines.normal[line]
    cofactor = np.array([np.cross(slope[1], slope[2]), np.cross(slope[2], slope[0]),
                         np.cross(slope[0], slope[1])])  # fmt: skip
    new = (cofactor * old).sum(axis=1)
    new = new / np.sqrt((new * new).sum())
    level = np.sort(plane_heights(after, new))
    if float(level[-1] - level[0]) > IN_PLANE:
        return None
    return new, float(level[len(level) // 2])


def _check_order(state: HullState, planes: TransformedPlanes) -> None:
    """See that parallel lines of a group stay apart and in order."""
    live, lines = state.live("lines"), state.lines
    mine = live[planes.planar[live] & (lines.boundary[live] < 0)]
    group, normal, offset = lines.group[mine], planes.normal[mine], lines.offset[mine]
    order = np.lexsort((offset, *normal.T, group))
    mine, group, normal = mine[order], group[order], normal[order]
    beside = (group[1:] == group[:-1]) & (normal[1:] == normal[:-1]).all(axis=1)
    step = np.where(beside, np.diff(planes.offset[mine]), np.inf)
    if len(step) and step.min() <= _APART:
        near = int(step.argmin())
        one, other = mine[near : near + 2].tolist()
        names = lines.name.data
        raise BadInputError(
            f"{names[other]} comes to {float(planes.offset[other]):.4f} m and "
            f"{names[one]} to {float(planes.offset[one]):.4f} m", "in transform",
            "keep the order of the lines of a group, or name the whole group as driver",
        )  # fmt: skip


def snap_into_planes(
    state: HullState, planes: TransformedPlanes, rows: IntArray, xyz: FloatArray
) -> FloatArray:
    """Put points that lie in the planes of their lines up to rounding exactly into them.

    Parameters
    ----------
    state : HullState
        The tables.
    planes : TransformedPlanes
        The planes.
    rows : (k,) int
        The points.
    xyz : (k, 3), m
        Their places.
    """
    out = np.array(xyz)
    curve = state.rows.curve[rows]
    line = np.where(curve >= 0, state.curves.line[np.maximum(curve, 0)], -1)
    held = (line >= 0) & planes.planar[line]
    along = (np.abs(planes.normal[line]) == 1.0).any(axis=2)
    for side in (0, 1):
        tilted = np.flatnonzero(held[:, side] & ~along[:, side])
        normal = planes.normal[line[tilted, side]]
        off = plane_heights(out[tilted], normal) - planes.offset[line[tilted, side]]
        out[tilted] -= normal * off[:, None]
    for side in (0, 1):
        for axis in range(3):
            exact = held[:, side] & (planes.normal[line[:, side], axis] == 1.0)
            out[exact, axis] = planes.offset[line[exact, side]]
    return out


def flat_borders(state: HullState, planes: TransformedPlanes) -> IntArray:
    """Give the lines that border a flat and still lie in its plane."""
    found: IntArray = np.flatnonzero(
        state.lines.alive.data & (state.lines.boundary.data == BoundaryKind.FLAT) & planes.planar
    )
    return found
