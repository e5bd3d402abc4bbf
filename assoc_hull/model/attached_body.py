"""Bodies beside the net: hatches, deck houses, boxes, bossings, as closed outlines of their own.

They are no part of the shell. No plane cuts them, no line ends on them, and hydrostatics do not see
them; they stand where they were put, and only a mapping of space carries them.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import attrs
import numpy as np

from assoc_hull.arguments import checked, shown, word
from assoc_hull.display import ShownAsText
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["AttachedBody"]

Corner = tuple[float, float, float]

_WHERE = "in a body beside the net"


def _rings(given: Any) -> tuple[tuple[Corner, ...], ...]:
    """Take closed sections, (k, m, 3), as plain numbers."""
    try:
        points = np.asarray(given, np.float64)
    except (TypeError, ValueError):
        points = np.zeros(0)
    if points.ndim != 3 or points.shape[2] != 3 or points.shape[0] < 2 or points.shape[1] < 3:
        what = f"sections have the shape {points.shape}"
        raise BadInputError(what, _WHERE, "give two or more of three points or more: (k, m, 3)")
    if not np.isfinite(points).all():
        raise BadInputError("a section has a point that is no place", _WHERE, "give finite numbers")
    # Nothing is told apart by the sign of a zero.
    return tuple(tuple((x, y, z) for x, y, z in ring) for ring in (points + 0.0).tolist())


def _numbers(given: Any) -> tuple[int, ...]:
    return tuple(int(each) for each in given)


@attrs.frozen
class AttachedBody(ShownAsText):
    """A body between closed sections, straight along the ship from each to the next.

    Attributes
    ----------
    name, group : str
        What it is called; ``"hatches"``, ``"deck houses"``, ``"boxes"``, ``"bossings"`` and so on.
    sections : tuple of tuple of (float, float, float), m
        Two or more from aft forward, of as many points each, closed from the last to the first.
    corners : tuple of int
        Points of a section at which an edge runs along.
    both : bool
        Its mirror image stands on the other side.
    sign : int
        1 stands on the hull, -1 is taken from it.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.model.attached_body import AttachedBody
    >>> ring = np.array([[0, -3, 9], [0, 3, 9], [0, 3, 11], [0, -3, 11]])
    >>> hatch = AttachedBody("hold 1", "hatches", [ring, ring + [8, 0, 0]], range(4), False, 1)
    >>> list(hatch.outlines), round(hatch.volume, 9)
    (['aft end', 'fore end', 'edge 1', 'edge 2', 'edge 3', 'edge 4'], 96.0)
    """

    name: str = attrs.field(validator=checked(word, _WHERE))
    group: str = attrs.field(validator=checked(word, _WHERE))
    sections: tuple[tuple[Corner, ...], ...] = attrs.field(converter=_rings, repr=False)
    corners: tuple[int, ...] = attrs.field(converter=_numbers)
    both: bool = attrs.field(converter=bool)
    sign: int = attrs.field(converter=int)

    def __attrs_post_init__(self) -> None:
        count = len(self.sections[0])
        if any(not 0 <= each < count for each in self.corners):
            what = f"corners are {shown(list(self.corners))} of {count} points"
            raise BadInputError(what, f"in the body {self.name!r}", f"give 0 to {count - 1}")
        if self.sign not in (1, -1):
            what = f"sign is {self.sign}"
            raise BadInputError(what, f"in the body {self.name!r}", "give 1 or -1")

    @property
    def points(self) -> FloatArray:
        """Its sections, (k, m, 3), m."""
        return np.array(self.sections)

    @property
    def carriers(self) -> FloatArray:
        """Its points, (k m, 3), m: the places that a mapping of space carries."""
        return self.points.reshape(-1, 3)

    def carried(self, places: FloatArray) -> AttachedBody:
        """Give it where a mapping took these places."""
        return attrs.evolve(self, sections=places.reshape(self.points.shape))

    @property
    def outlines(self) -> Mapping[str, FloatArray]:
        """Its lines by name, (n, 3), m each: both ends, closed, and the edges along."""
        points = self.points
        found = {
            name: np.concatenate([points[k], points[k, :1]])
            for name, k in (("aft end", 0), ("fore end", -1))
        }
        edges = {f"edge {k}": points[:, at] for k, at in enumerate(self.corners, start=1)}
        return found | edges

    @property
    def volume(self) -> float:
        """What its faces enclose, m3, of both sides, without sign."""
        return abs(self.flux) * (2 if self.both else 1)

    @property
    def flux(self) -> float:
        """What its faces enclose as they are turned, m3, of one side; above 0 if they are right."""
        corner = self.points.reshape(-1, 3)[self.triangles]
        return float((corner[:, 0] * np.cross(corner[:, 1], corner[:, 2])).sum()) / 6.0

    def __str__(self) -> str:
        return f"{self.name}: {self.summary}"

    @property
    def summary(self) -> str:
        """What it is in a line, but for its name."""
        low, high = (each(axis=(0, 1)).tolist() for each in (self.points.min, self.points.max))
        spans = zip("xyz", low, high, strict=True)
        reach = ", ".join(f"{axis} {a:.6g} to {b:.6g}" for axis, a, b in spans)
        side = " on both sides" if self.both else ""
        taken = ", taken from the hull" if self.sign < 0 else ""
        return f"{self.group}, {reach} m{side}, {self.volume:.6g} m3{taken}"

    @property
    def triangles(self) -> IntArray:
        """Corners of closed triangles, (f, 3), among its points in their order; facing outward."""
        points = self.points
        k, m = points.shape[:2]
        first = np.arange(m)
        after = np.roll(first, -1)
        low = m * np.arange(k - 1)[:, None]
        a, b, c, d = low + first, low + after, low + m + after, low + m + first
        sides = np.concatenate([np.stack([a, b, c], -1), np.stack([a, c, d], -1)], axis=1)
        aft, fore = _ears(points[0, :, 1:]), _ears(points[-1, :, 1:]) + m * (k - 1)
        # Seen from forward a section that turns to the left has its aft cap turned away.
        found = np.concatenate([sides.reshape(-1, 3), aft[:, ::-1], fore])
        y, z = points[:, :, 1], points[:, :, 2]
        # Of all sections: the first may be a point, as a deck is at the stem.
        left = (y * np.roll(z, -1, axis=1) - np.roll(y, -1, axis=1) * z).sum() > 0.0
        return np.asarray(found if left else found[:, ::-1])


def _ears(yz: FloatArray) -> IntArray:
    """Part a simple polygon, (m, 2), into triangles of its corners, (m - 2, 3), in its sense."""
    left = list(range(len(yz)))
    y, z = yz[:, 0], yz[:, 1]
    way = 1.0 if (y * np.roll(z, -1) - np.roll(y, -1) * z).sum() > 0.0 else -1.0
    found: list[tuple[int, int, int]] = []
    while len(left) > 3:
        corner = np.array(left)
        before, after = np.roll(corner, 1), np.roll(corner, -1)
        turn = way * _turn(yz[before], yz[corner], yz[after])
        # A corner is cut off where no other one lies in its triangle; the sharpest comes first.
        order = np.argsort(-turn, kind="stable").tolist()
        at = next((k for k in order if _empty(yz, left, k, way)), order[0])
        found.append((int(before[at]), left[at], int(after[at])))
        del left[at]
    return np.array([*found, tuple(left)])


def _empty(yz: FloatArray, left: list[int], at: int, way: float) -> bool:
    """Whether a corner points outward and no other of the polygon lies in its triangle."""
    a, b, c = left[at - 1], left[at], left[(at + 1) % len(left)]
    if way * float(_turn(yz[a], yz[b], yz[c])) < 0.0:
        return False
    rest = yz[[each for each in left if each not in (a, b, c)]]
    turns = [way * _turn(yz[p], yz[q], rest) for p, q in ((a, b), (b, c), (c, a))]
    return not bool((np.array(turns) > 0.0).all(axis=0).any())


def _turn(p: FloatArray, q: FloatArray, r: FloatArray) -> FloatArray:
    """Give twice the signed area of triangles."""
    u, v = q - p, r - p
    return np.asarray(u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0])
