"""Mouths of tunnels cut out of the triangles of a shell, and the walls behind them.

A tunnel is a prism of many sides, with its edges on the cylinder. Each triangle is cut by the
planes of the sides, one after the other: what lies outside of a plane is kept, the rest goes on,
and what is left in the end lies in the mouth. Cuts of an edge are kept by its two vertices, so that
neighbours are cut alike, and one that needed no cut takes the vertex as well: no crack is left.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.surfaces.triangles import Triangles

__all__ = ["CutShell", "cut_mouth", "wall_of"]

_ON = 1e-9
"""Parts of the radius: a vertex so near to a plane lies in it."""

_EDGE = 1e-6
"""Parts of the radius: open edges no farther beyond the cylinder are those of the mouth."""

_THIN = 1e-3
"""A quadrilateral is halved if the smaller half is more than this part of it."""


@attrs.frozen(eq=False)
class CutShell:
    """Triangles of a shell without a mouth.

    Attributes
    ----------
    xyz : (v, 3), m
        Vertices; the first are those of before.
    triangle : (f, 3) int
    source : (f,) int
        Of which triangle of before each is a part.
    """

    xyz: FloatArray
    triangle: IntArray
    source: IntArray


def cut_mouth(
    xyz: FloatArray, triangle: IntArray, centre: tuple[float, float], radius: float, sides: int
) -> CutShell:
    """Cut the mouth of a tunnel out of triangles on one side of a hull.

    Parameters
    ----------
    xyz : (v, 3), m
        Vertices.
    triangle : (f, 3) int
        Triangles.
    centre : (float, float), m
        x and z of the axis.
    radius : float, m
        Of the tunnel.
    sides : int
        Of the prism that stands for the cylinder.
    """
    cut = _Cut.of(xyz, centre, radius, sides)
    away = xyz[triangle][:, :, [0, 2]] - np.array(centre)
    near = ((away.min(axis=1) <= radius) & (away.max(axis=1) >= -radius)).all(axis=1)
    pieces: list[tuple[int, list[int]]] = []
    for number in np.flatnonzero(near).tolist():
        pieces += [(number, each) for each in cut.outside(triangle[number].tolist())]
    rest = np.flatnonzero(~near)
    beside = rest[cut.is_split(triangle[rest])]
    pieces += [(number, triangle[number].tolist()) for number in beside.tolist()]
    stays = np.setdiff1d(rest, beside)
    found, source = [triangle[stays]], [stays]
    for number, polygon in pieces:
        parts = cut.triangles(cut.with_splits(polygon))
        found.append(np.array(parts, np.int64).reshape(-1, 3))
        source.append(np.full(len(parts), number))
    return CutShell(np.array(cut.places), np.concatenate(found), np.concatenate(source))


def wall_of(
    xyz: FloatArray, triangle: IntArray, centre: tuple[float, float], radius: float
) -> tuple[FloatArray, IntArray, IntArray]:
    """Give the wall behind the mouth of a port half, to the centre plane.

    It begins at open edges within the cylinder; such edges elsewhere are left open.

    Returns
    -------
    (v, 3) xyz, m, (f, 3) triangles, (k,) int
        All vertices, with those in the centre plane behind the old ones; the triangles of the wall;
        which vertices are new.
    """
    mesh = Triangles(xyz, triangle)
    ends, key = mesh.edges(), mesh.edge_keys()
    alone = np.unique(key, return_counts=True)
    open_ = ends[np.isin(key, alone[0][alone[1] == 1])]
    away = np.hypot(xyz[open_, 0] - centre[0], xyz[open_, 2] - centre[1])
    rim = open_[(xyz[open_, 1] != 0.0).any(axis=1) & (away <= radius * (1.0 + _EDGE)).all(axis=1)]
    outer = np.unique(rim)
    foot = np.zeros(len(xyz), np.int64)
    foot[outer] = len(xyz) + np.arange(len(outer))
    begin, finish = rim.T
    wall = np.concatenate(
        [
            np.column_stack([finish, begin, foot[begin]]),
            np.column_stack([finish, foot[begin], foot[finish]]),
        ]
    )
    return np.concatenate([xyz, xyz[outer] * [1.0, 0.0, 1.0]]), wall, foot[outer]


@attrs.frozen(eq=False)
class _Cut:
    """Vertices, and the cuts of edges so far.

    Attributes
    ----------
    places : list of (3,), m
        Vertices.
    normal : (n, 2)
        Of the sides of the prism, outward, in x and z.
    centre : (2,), m
        Of the prism.
    inner : float, m
        From its axis to its sides.
    on : float, m
        So near to a side a vertex lies in it.
    splits : dict of (int, int) to int
        The vertex that cuts an edge, by its two vertices, the lower first.
    """

    places: list[FloatArray]
    normal: FloatArray
    centre: FloatArray
    inner: float
    on: float
    splits: dict[tuple[int, int], int] = attrs.field(factory=dict)
    _heights: dict[int, FloatArray] = attrs.field(factory=dict)

    @classmethod
    def of(cls, xyz: FloatArray, centre: tuple[float, float], radius: float, sides: int) -> _Cut:
        turn = 2.0 * np.pi * (np.arange(sides) + 0.5) / sides
        normal = np.column_stack([np.cos(turn), np.sin(turn)])
        inner = radius * float(np.cos(np.pi / sides))
        return cls(list(xyz), normal, np.array(centre), inner, _ON * radius)

    def heights(self, vertex: int) -> FloatArray:
        """Give how far a vertex lies outside each side, (n,), m; zero in a side."""
        found = self._heights.get(vertex)
        if found is None:
            away = self.places[vertex][[0, 2]] - self.centre
            found = self.normal @ away - self.inner
            found[np.abs(found) <= self.on] = 0.0
            self._heights[vertex] = found
        return found

    def outside(self, polygon: list[int]) -> Iterator[list[int]]:
        """Give the parts of a convex polygon that lie outside the prism."""
        for side in range(len(self.normal)):
            over = np.array([self.heights(each) for each in polygon])
            if (over >= 0.0).all(axis=0).any():
                yield polygon  # it lies outside of one side altogether
                return
            high = over[:, side]
            if not (high > 0.0).any():
                continue
            out, polygon = self._parted(polygon, side, high)
            yield out

    def _parted(
        self, polygon: Sequence[int], side: int, high: FloatArray
    ) -> tuple[list[int], list[int]]:
        """Part a polygon in a side: give what lies outside and what lies inside."""
        out, inside = list[int](), list[int]()
        for i, (one, two) in enumerate(zip(polygon, [*polygon[1:], polygon[0]], strict=True)):
            first, second = float(high[i]), float(high[(i + 1) % len(polygon)])
            if first >= 0.0:
                out.append(one)
            if first <= 0.0:
                inside.append(one)
            if first * second < 0.0:
                between = self._split(one, two, side)
                out.append(between)
                inside.append(between)
        return out, inside

    def _split(self, one: int, two: int, side: int) -> int:
        """Give the vertex where an edge passes a side, from either of its ends the same."""
        key = (one, two) if one < two else (two, one)
        found = self.splits.get(key)
        if found is None:
            low, high = (float(self.heights(each)[side]) for each in key)
            begin, end = (self.places[each] for each in key)
            found = len(self.places)
            self.places.append(begin + (end - begin) * (low / (low - high)))
            # To rounding it lies in the side; that it does must not hang on rounding.
            self.heights(found)[side] = 0.0
            self.splits[key] = found
        return found

    def is_split(self, triangle: IntArray) -> np.typing.NDArray[np.bool_]:
        """Tell which triangles (f, 3) have an edge that was cut, (f,)."""
        count = len(self.places)
        known = np.array([a * count + b for a, b in self.splits], np.int64)
        ends = np.stack([triangle, np.roll(triangle, -1, axis=1)], axis=2)
        ends = np.sort(ends, axis=2)
        found = np.isin(ends[:, :, 0] * count + ends[:, :, 1], known).any(axis=1)
        return np.asarray(found)

    def with_splits(self, polygon: Sequence[int]) -> list[int]:
        """Give a polygon with all vertices that cut its edges."""
        found = list[int]()
        for one, two in zip(polygon, [*polygon[1:], polygon[0]], strict=True):
            found += self._along(one, two)
        return found

    def _along(self, one: int, two: int) -> list[int]:
        """Give an edge from one vertex on, without the last, with what cuts it."""
        between = self.splits.get((one, two) if one < two else (two, one))
        if between is None:
            return [one]
        return [*self._along(one, between), *self._along(between, two)]

    def triangles(self, polygon: list[int]) -> list[list[int]]:
        """Cut a convex polygon, which may have flat corners, into triangles that are none."""
        if len(polygon) == 3:
            return [polygon]
        if len(polygon) == 4:
            a, b, c, d = polygon
            ways = [[a, b, c], [a, c, d]], [[b, c, d], [b, d, a]]
            least = [min(self._area(each) for each in way) for way in ways]
            best = int(least[1] > least[0])
            if least[best] > _THIN * sum(self._area(each) for each in ways[best]):
                return ways[best]
        middle = len(self.places)
        self.places.append(np.mean([self.places[each] for each in polygon], axis=0))
        return [
            [one, two, middle] for one, two in zip(polygon, [*polygon[1:], polygon[0]], strict=True)
        ]

    def _area(self, corners: Sequence[int]) -> float:
        a, b, c = (self.places[each] for each in corners)
        return float(np.linalg.norm(np.cross(b - a, c - a)))
