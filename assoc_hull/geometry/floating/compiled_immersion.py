"""What lies below floating planes of a Coons surface, by compiled code: `integrate_immersed` of it.

Importing this module imports numba. The numbers are those of numpy but for rounding: some 1e-13 of
the whole. No curve of the surface is kept, so a surface that is measured once costs no more than
that.

Examples
--------
>>> from assoc_hull.geometry.floating.compiled_immersion import integrate_surface
>>> callable(integrate_surface)
True
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import TypeVar

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.floating.compiled_strips import (
    find_events,
    greatest_breadth,
    integrate_curves_of_strips,
)
from assoc_hull.geometry.floating.immersed_strips import (
    CLOSE,
    LEVEL,
    MORE,
    POINT,
    POINTS,
    SEVERAL,
    TRIALS,
)
from assoc_hull.geometry.floating.immersion import (
    FloatingPlanes,
    ImmersedIntegrals,
    in_plane,
    join_sides,
)
from assoc_hull.geometry.floating.strip_events import LADDER, REACH, STILL
from assoc_hull.geometry.floating.tiles import HEELED, PLAIN
from assoc_hull.geometry.floating.waterplane_cuts import FLAT, TIE, HalfIntegrals
from assoc_hull.geometry.numeric.jit import was_loaded
from assoc_hull.geometry.numeric.polynomials import FLOOR, MOST_TRIALS, RELATIVE, STEPS
from assoc_hull.geometry.numeric.quadrature import bunched_rule, gauss, lobatto
from assoc_hull.geometry.splines.paths import QUICK, SMALL
from assoc_hull.geometry.surfaces.compiled_cells import PutCells
from assoc_hull.geometry.surfaces.coons import CoonsStrips

__all__ = ["SurfaceRows", "integrate_each", "integrate_surface", "read_only", "warm"]

Scalar = TypeVar("Scalar", bound=np.generic)

_WHOLE = np.array([QUICK, STEPS, MOST_TRIALS, LADDER, POINTS, TRIALS, SEVERAL], np.int64)
_LIMITS = np.array(
    [FLOOR, RELATIVE, FLAT, SMALL, LEVEL, POINT, REACH, CLOSE, TIE, STILL], np.float64
)
_GAUSS = gauss(6)
freeze(_WHOLE, _LIMITS, *_GAUSS)

_integrate: Callable[..., None] = integrate_curves_of_strips
_find_events: Callable[..., int] = find_events
"""They are called with the arrays of a surface, in the order of their arguments."""

_MOST = 64
"""Planes at a time, which bounds the memory."""

_ROOM = 256
"""Curves of finer rules that room is made for at first."""


@attrs.frozen(eq=False)
class SurfaceRows:
    """A Coons surface as compiled code takes it: see `compiled_strips.integrate_curves_of_strips`.

    Attributes
    ----------
    arrays : tuple of arrays
        Its structure and its shape.
    rules : tuple of arrays
        How it is integrated along its strips.
    """

    arrays: tuple[np.typing.NDArray[np.generic], ...]
    rules: tuple[np.typing.NDArray[np.generic], ...]

    @property
    def plain_rule(self) -> tuple[IntArray, FloatArray, FloatArray, IntArray]:
        """Where the nodes of each strip begin, places and weights of these, and their strips."""
        start, node, weight, strip_of = self.rules[:4]
        return (
            np.asarray(start, np.int64), np.asarray(node, np.float64),
            np.asarray(weight, np.float64), np.asarray(strip_of, np.int64),
        )  # fmt: skip

    @property
    def most(self) -> int:
        """The tiles of the strip that has most."""
        return int(np.diff(self.arrays[2]).max())

    @classmethod
    def of(cls, strips: CoonsStrips) -> SurfaceRows:
        """Take a surface."""
        cells, walked = strips.cells, strips.walked
        tiles = np.diff(cells.tile_start)
        edge = np.where(cells.deck[cells.tile_start[1:] - 1], tiles - 1, -1)
        arrays = (
            cells.anchor_start, cells.anchor, cells.tile_start, cells.first, cells.plane,
            cells.deck, edge, walked.paths.start, walked.cubic, walked.begin, walked.finish,
            _rows(strips.aft.transpose(2, 1, 0)), _rows(strips.span.transpose(2, 1, 0)),
            _rows(strips.blend.transpose(1, 2, 0)),
        )  # fmt: skip
        return cls(tuple(map(read_only, arrays)), _rules(cells.order.tobytes()))

    @classmethod
    def put(cls, cells: PutCells) -> SurfaceRows:
        """Take a surface whose cells were put on other lines."""
        was, tiles = cells.structure.cells, cells.tiles
        arrays = (
            was.anchor_start, was.anchor, cells.tile_start, cells.whole[0, :tiles], was.plane,
            cells.deck[:tiles], cells.edge, was.paths.start, cells.cubic, cells.begin,
            cells.finish, cells.aft, cells.span, cells.blend,
        )  # fmt: skip
        return cls(arrays, _rules(was.order.tobytes()))


def _rows(array: FloatArray) -> FloatArray:
    return np.ascontiguousarray(array).reshape(-1, array.shape[2])


def read_only(array: np.typing.NDArray[Scalar]) -> np.typing.NDArray[Scalar]:
    """Give a contiguous read-only view: one version is compiled."""
    found = np.ascontiguousarray(array).view()
    found.setflags(write=False)
    return found


@lru_cache(maxsize=64)
def _rules(order: bytes) -> tuple[np.typing.NDArray[np.generic], ...]:
    """Give the rules of strips one behind the other: the plain ones, with the strip of each node.

    Then the fine ones.
    """
    each = np.frombuffer(order, np.int64).tolist()
    found: list[np.typing.NDArray[np.generic]] = []
    for rules in ([lobatto(n + 1) for n in each], [bunched_rule(n + MORE) for n in each]):
        start = np.cumsum([0, *(len(nodes) for nodes, _ in rules)]).astype(np.int64)
        found += [start, *(np.concatenate(parts) for parts in zip(*rules, strict=True))]
        if len(found) == 3:
            found.append(np.arange(len(each)).repeat(np.diff(start)))
    freeze(*found)
    return tuple(found)


def integrate_surface(surface: SurfaceRows, planes: FloatingPlanes) -> ImmersedIntegrals:
    """Integrate both sides below d planes, as `integrate_immersed` does; planes are plain."""
    count, other, inclined = _both_sides(planes)
    parts = [
        _halves(surface, tuple(each[i : i + _MOST] for each in inclined))
        for i in range(0, len(inclined[0]), _MOST)
    ]
    columns, extent = (np.concatenate([each[k] for each in parts]) for k in (0, 1))
    rows = _columns(columns.T, inclined[2])
    port = HalfIntegrals(rows[:, :count], extent[:count].T)
    found = join_sides(port, HalfIntegrals(rows[:, other], extent[other].T))
    return ImmersedIntegrals(**found)


def integrate_each(surface: SurfaceRows, planes: FloatingPlanes) -> FloatArray:
    """Integrate both sides of each curve of the plain rule below d planes, (d, 13, k).

    Each is a strip of weight 1, see `integrate_curves`.
    """
    count, other, inclined = _both_sides(planes)
    halves, (_, node, _, strip_of) = len(inclined[0]), surface.plain_rule
    every = np.empty((len(node), 2), np.int64)
    every[:] = 0, halves
    none, known = np.empty((halves, 1, 2, 0, 2)), np.empty((halves, 1, 2), np.int64)
    columns = _integrated(
        surface, inclined, (strip_of, node, read_only(every)), halves, np.empty((halves, 4)),
        np.empty((len(surface.arrays[4]), 2)), none, known,
    )[0]  # fmt: skip
    rows = _columns(columns.transpose(2, 1, 0), inclined[2][:, None])
    return (rows[:, :count] + rows[:, other]).transpose(1, 0, 2)


def _both_sides(planes: FloatingPlanes) -> tuple[int, IntArray, tuple[FloatArray, ...]]:
    """Give planes below which the port half is to be integrated, for both sides.

    Starboard is a port half below the plane heeled the other way: which of them, (d,).
    """
    count, heel = len(planes.tan_heel), planes.tan_heel
    heeled = np.flatnonzero(heel != 0.0)
    halves, other = np.concatenate([np.arange(count), heeled]), np.arange(count)
    other[heeled] = np.arange(count, len(halves))
    sides = np.concatenate([heel, -heel[heeled]])
    inclined = planes.height[halves], planes.tan_trim[halves], sides
    return count, other, tuple(read_only(each) for each in inclined)


def _columns(columns: FloatArray, heel: FloatArray) -> FloatArray:
    """Give columns as of `HalfIntegrals`, (13, h) or (13, h, k), from those with heel, of 17."""
    rows = np.concatenate([columns[:PLAIN], columns[HEELED:]])
    heeled = np.flatnonzero(heel.ravel() != 0.0)
    if len(heeled):
        rows[:, heeled] = in_plane(columns[:, heeled], heel[heeled])
    return rows


def _halves(
    surface: SurfaceRows, inclined: tuple[FloatArray, ...]
) -> tuple[FloatArray, FloatArray]:
    """Integrate the port half below planes: columns (h, 17) and extents (h, 4)."""
    rule_start, node, weight, strip_of = surface.plain_rule
    fine = surface.rules[4:]
    halves, strips, curves = len(inclined[0]), len(rule_start) - 1, len(node)
    extent = np.empty((halves, 4))
    extent[:] = np.inf, -np.inf, np.inf, -np.inf
    reach = np.empty((strips, 2))
    reach[:] = np.inf, -np.inf
    most = 3 * surface.most + 3
    points, known = np.empty((halves, strips, 2, most, 2)), np.empty((halves, strips, 2), np.int64)
    every = np.empty((curves, 2), np.int64)
    every[:] = 0, halves
    columns, states, cuts, heights = _integrated(
        surface, inclined, (strip_of, node, read_only(every)), halves, extent, reach, points, known
    )
    for h in range(halves):
        breadth = greatest_breadth(cuts[h], states[h], strip_of, node, float(extent[h, 3]), TIE)
        extent[h, 3] = max(extent[h, 3], breadth)
    share, room = np.empty((halves, strips)), _ROOM
    while True:
        own, v, part = np.empty(room, np.int64), np.empty(room), np.empty(room)
        where = np.empty((room, 2), np.int64)
        events = _find_events(
            *surface.arrays, rule_start, node, weight, *fine, _WHOLE, _LIMITS, *inclined, states,
            heights, reach, points, known, extent, share, own, v, part, where,
        )  # fmt: skip
        if events <= room:
            break
        room = events
    factor = weight * (1.0 - share[:, strip_of])
    found = (columns.transpose(1, 0, 2) * factor[..., None]).sum(axis=1)
    if events:
        curve = read_only(own[:events]), read_only(v[:events]), read_only(where[:events])
        none = np.empty((halves, strips, 2, 0, 2))
        more = _integrated(surface, inclined, curve, 1, extent, reach, none, known)[0]
        np.add.at(found, where[:events, 0], more[:, 0] * part[:events, None])
    return found, extent


def _integrated(
    surface: SurfaceRows,
    inclined: tuple[FloatArray, ...],
    curves: tuple[np.typing.NDArray[np.generic], ...],
    width: int,
    extent: FloatArray,
    reach: FloatArray,
    points: FloatArray,
    known: IntArray,
) -> tuple[FloatArray, IntArray, FloatArray, FloatArray]:
    """Integrate curves: their columns, states, cuts, and the heights that decide."""
    count, halves = len(curves[0]), len(inclined[0])
    columns, states = np.empty((count, width, 17)), np.empty((halves, count), np.int64)
    cuts, heights = np.empty((halves, count, 2)), np.empty((halves, count, 3))
    _integrate(
        *surface.arrays, *_GAUSS, _WHOLE, _LIMITS, *inclined, *curves, columns, extent, states,
        cuts, heights, reach, points, known,
    )  # fmt: skip
    return columns, states, cuts, heights


def warm() -> bool:
    """Compile all, or load what was compiled; tell whether it was loaded."""
    one, start = np.zeros(1, np.int64), np.array([0, 1])
    flag, wide, none = np.zeros(1, np.bool_), np.zeros((12, 1)), np.zeros(1)
    cubic = np.zeros((1, 4, 3))
    cubic[:, 1] = 1.0
    arrays = (
        start, one - 1, start, one, flag, flag, one - 1, start, cubic, none, none + 1.0, wide, wide,
        np.zeros((16, 1)),
    )  # fmt: skip
    rules = map(read_only, _rules(np.array([2]).tobytes()))
    surface = SurfaceRows(tuple(map(read_only, arrays)), tuple(rules))
    integrate_surface(surface, FloatingPlanes(np.ones(1), np.zeros(1), np.zeros(1)))
    return all(was_loaded(each) for each in (_integrate, _find_events, greatest_breadth))
