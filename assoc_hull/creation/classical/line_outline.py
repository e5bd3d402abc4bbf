"""Plane curves of a classical definition as the points of a line of the net.

`PlaneOutline` puts straight, circular and smooth pieces together: where two join in one direction
the line has a tangent point, else a knuckle. A straight piece stays straight; a circular one gets
as many points as its deviation asks for. `point_kinds_along` gives kinds to bare points of any line
in space.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.geometry.classical.checked_input import wrap_angle
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs
from assoc_hull.geometry.curves import EndKind, FloatArray, IntArray, PointKind, freeze
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import Ends

__all__ = [
    "CLOSE",
    "OutlinePiece",
    "PlaneOutline",
    "circular_piece",
    "point_kinds_along",
    "smooth_piece",
    "straight_piece",
]


_STRAIGHT = 1e-7
"""Neighbouring chords that differ by this angle, rad, are one straight run."""


def point_kinds_along(points: ArrayLike, corner: float) -> tuple[IntArray, FloatArray]:
    """Give a `PointKind` per point, and the directions at those that are tangent.

    Three points in a row on a straight line are a straight run. Where a run goes over into a curve,
    the curve is tangent to it; where two runs meet, or chords turn sharply, there is a knuckle.

    Neighbouring points (n, 3), m, differ; a turn from chord to chord of more than `corner`
    (degrees) is a knuckle. Directions (n, 3) are zero where none is given.
    """
    at = np.asarray(points, np.float64)
    step = np.diff(at, axis=0)
    way = step / np.linalg.norm(step, axis=1)[:, None]
    kind = np.full(len(at), int(PointKind.SMOOTH), np.int64)
    direction = np.zeros_like(at)
    if len(at) < 3:
        return kind, direction
    turn = np.arctan2(
        np.linalg.norm(np.cross(way[:-1], way[1:]), axis=1), (way[:-1] * way[1:]).sum(axis=1)
    )
    level = turn <= _STRAIGHT
    straight = np.zeros(len(way), bool)
    straight[:-1] |= level
    straight[1:] |= level
    inner = np.arange(1, len(at) - 1)
    before, after = straight[:-1], straight[1:]
    # Between two runs that are not one the line has a corner, however small.
    sharp = (turn > np.radians(corner)) | (before & after & ~level)
    tangent = (before ^ after) & ~sharp
    kind[inner[sharp]] = int(PointKind.KNUCKLE)
    kind[inner[tangent]] = int(PointKind.TANGENT)
    along = np.where(before[:, None], way[:-1], way[1:])
    direction[inner[tangent]] = along[tangent]
    return kind, direction


# --------------------------------------------------------------------------------------
# Outlines of pieces.

CLOSE = 1e-6
"""Tolerance (m) of lines whose pieces are straight or circular."""

_ONE = 1e-7
"""Directions (rad) that differ by less are one."""

_SAME = 1e-9
"""Points (m) that differ by less are one."""


@attrs.frozen(eq=False)
class OutlinePiece:
    """A piece of a plane curve.

    Attributes
    ----------
    points : (n, 2), m
        In order along it, its ends among them.
    start, finish : float or None, rad
        Its direction at either end; None where it follows from the points alone.
    """

    points: FloatArray
    start: float | None
    finish: float | None


def straight_piece(first: ArrayLike, last: ArrayLike) -> OutlinePiece:
    """Give the straight line between two points (u, v), m."""
    points = np.array([first, last], np.float64)
    step = points[1] - points[0]
    angle = float(np.arctan2(step[1], step[0]))
    return OutlinePiece(points, angle, angle)


def smooth_piece(
    points: ArrayLike, start: float | None = None, finish: float | None = None
) -> OutlinePiece:
    """Give the kernel's own smooth curve through points (n, 2), m, with directions (rad) or not."""
    return OutlinePiece(np.array(points, np.float64), start, finish)


def circular_piece(arcs: PlaneArcs, index: int = 0, within: float = 1e-5) -> OutlinePiece:
    """Give one of `arcs`; with a curvature of 0 it is straight.

    The kernel's curve through its points leaves it by at most `within` (m).

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.creation.classical.line_outline import circular_piece
    >>> from assoc_hull.geometry.classical.circular_arcs import PlaneArcs
    >>> quarter = circular_piece(PlaneArcs.make([[0, 0]], [0.0], [0.4], [np.pi / 0.8]))
    >>> len(quarter.points), quarter.points[-1].round(9).tolist()
    (11, [2.5, 2.5])
    """
    bend, length = float(arcs.curvature[index]), float(arcs.length[index])
    first = float(arcs.angle[index])
    # A cubic spline through points at a distance of an angle w leaves the circle by less than
    # R w^4 / 160.
    step = (160.0 * within * abs(bend)) ** 0.25
    count = 1 if bend == 0.0 else max(int(np.ceil(abs(bend) * length / step)), 2)
    along = np.linspace(0.0, length, count + 1)
    points = arcs.at(np.full(count + 1, index), along)
    return OutlinePiece(points, first, first + bend * length)


@attrs.frozen(eq=False)
class PlaneOutline:
    """A plane curve as points, ready to become a line.

    Attributes
    ----------
    points : (n, 2), m
        In order along it.
    kind : (n,) int8
        A `PointKind` each.
    direction : (n, 2)
        Unit vectors at tangent points, zero elsewhere.
    ends : (float or None, float or None), rad
        Directions at the two ends, None where they are free.
    """

    points: FloatArray
    kind: NDArray[np.int8]
    direction: FloatArray
    ends: tuple[float | None, float | None] = (None, None)

    def __attrs_post_init__(self) -> None:
        freeze(self.points, self.kind, self.direction)

    @classmethod
    def of(cls, pieces: Sequence[OutlinePiece]) -> Self:
        """Put pieces together, each beginning where the one before it ends.

        Pieces of no length are left out.
        """
        kept = [each for each in pieces if np.ptp(each.points, axis=0).max() > _SAME]
        points, kinds, ways = [kept[0].points[:1]], [[0]], [np.zeros((1, 2))]
        for number, piece in enumerate(kept):
            inner = np.zeros(len(piece.points) - 1, np.int8)
            way = np.zeros((len(inner), 2))
            after = kept[number + 1] if number + 1 < len(kept) else None
            if after is not None:
                inner[-1], way[-1] = _joint(piece.finish, after.start)
            points.append(piece.points[1:])
            kinds.append(inner.tolist())
            ways.append(way)
        return cls(
            np.concatenate(points) + 0.0, np.concatenate(kinds).astype(np.int8),
            np.concatenate(ways), (kept[0].start, kept[-1].finish),
        )  # fmt: skip

    def section(self, name: str, x: float, *, tolerance: float = CLOSE) -> LineSource:
        """Give it as a section at `x` (m): u is the half-breadth, v the height."""
        return self._line("sections", name, 0, x, tolerance, None)

    def waterline(self, name: str, z: float, *, tolerance: float = CLOSE) -> LineSource:
        """Give it as a waterline at `z` (m): u lies along the ship, v is the half-breadth."""
        return self._line("waterlines", name, 2, z, tolerance, None)

    def boundary(
        self, name: str, axis: int, place: float, *,
        kind: BoundaryKind = BoundaryKind.END, tolerance: float = CLOSE,
    ) -> LineSource:  # fmt: skip
        """Give it as a boundary line in a plane.

        Parameters
        ----------
        name : str
            Of the line.
        axis : int
            0: a flat end in the plane x = `place`, u is y and v is z. 1: a profile in y =
            `place`, u is x and v is z. 2: a level line in z = `place`, u is x and v is y.
        place : float, m
            Where the plane stands.
        kind : BoundaryKind
            What it does to the lines that end on it.
        tolerance : float, m
            How far the adopted curve may pass the points.
        """
        return self._line("boundary", name, axis, place, tolerance, kind)

    def placed(self, axis: int, place: float, uv: FloatArray) -> FloatArray:
        """Give points (n, 2) of the plane in space, (n, 3), m."""
        return np.insert(uv, axis, place, axis=1)

    def _line(
        self, group: str, name: str, axis: int, place: float, tolerance: float,
        kind: BoundaryKind | None,
    ) -> LineSource:  # fmt: skip
        vectors = [
            np.zeros((1, 2)) if each is None else np.array([[np.cos(each), np.sin(each)]])
            for each in self.ends
        ]
        first, last = (tuple(self.placed(axis, 0.0, each)[0].tolist()) for each in vectors)
        kinds = tuple(int(EndKind.FREE if each is None else EndKind.TANGENT) for each in self.ends)
        return LineSource.make(
            group, name, self.placed(axis, place, self.points),
            plane=(np.eye(3)[axis], place) if kind is not None else None,
            boundary=kind, kind=[int(each) for each in self.kind],
            direction=self.placed(axis, 0.0, self.direction),
            ends=Ends((kinds[0], kinds[1]), (first, last)), tolerance=tolerance,
        )  # fmt: skip


def _joint(arriving: float | None, leaving: float | None) -> tuple[int, FloatArray]:
    """Tell the kind of the point between two pieces, and the direction there."""
    if arriving is None or leaving is None or abs(float(wrap_angle(leaving - arriving))) > _ONE:
        return int(PointKind.KNUCKLE), np.zeros(2)
    return int(PointKind.TANGENT), np.array([np.cos(leaving), np.sin(leaving)])
