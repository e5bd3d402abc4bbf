"""A waterline with end points of its own and a parallel part: two splines and a line between.

Without the parting, one spline over shoulder and parallel part swings beyond the half-breadth.
Both splines leave the parallel part in its direction; their other end is free, without second
derivative, or has a given slope. Where every chord rises less than it runs, a spline is the cubic
y(x); blunter ends are bent as a batten over their chords. Source: Kim & Chang, "Some
Representations of Ship Hulls by Mathematical Method for Design and Production", J. SNAK.

Examples
--------
>>> from assoc_hull.geometry.classical.parallel_waterline import ParallelWaterline
>>> run = [(0, 0), (5, 5.1), (12, 10.2), (20, 13.6), (30, 15), (50, 15)]
>>> line = ParallelWaterline.make(6.0, run, parallel=(30, 50), method="graph")
>>> round(float(line.at(8)), 8), line.slope([30, 40]).round(9).tolist()
(7.58802432, [0.0, 0.0])
"""

from __future__ import annotations

from typing import Literal, Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import figure, finite, inside
from assoc_hull.geometry.classical.choices import one_of
from assoc_hull.geometry.classical.waterline_piece import Chorded, Graph, Level, Piece
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["ParallelWaterline"]

Method = Literal["graph", "chord"]

_SAME = 1e-9
"""Places (m) that differ by less are one."""

_BLUNT = 1.0
"""From this slope of a chord on a piece is a batten over its chords."""


@attrs.frozen(eq=False)
class ParallelWaterline:
    """A waterline; x forward, y outward, m.

    Attributes
    ----------
    z : float, m
        Its height.
    points : (n, 2), m
        All points that it passes, rows (x, y), ends among them.
    pieces : tuple of Piece
        From aft forward: cubic, level or bent over chords.
    parallel : (float, float) or None, m
        Where the parallel part begins and ends.
    """

    z: float
    points: FloatArray
    pieces: tuple[Piece, ...]
    parallel: tuple[float, float] | None

    def __attrs_post_init__(self) -> None:
        freeze(self.points)

    @classmethod
    def make(
        cls, z: float, points: ArrayLike, *, aft_end: ArrayLike | None = None,
        fwd_end: ArrayLike | None = None, parallel: tuple[float, float] | None = None,
        parallel_half_breadth: float | None = None,
        end_slope: tuple[float | None, float | None] = (None, None), method: Method | None = None,
    ) -> Self:  # fmt: skip
        """Lay a waterline through points.

        Parameters
        ----------
        z : float, m
            Its height.
        points : (n, 2) array_like, m
            Rows (x, y), x increasing.
        aft_end, fwd_end : (2,) array_like or None, m
            Ends (x, y); they take the place of all points at or beyond them.
        parallel : (float, float) or None, m
            Where the parallel part begins and ends.
        parallel_half_breadth : float or None, m
            Its half-breadth; that of the points in it if None.
        end_slope : (float or None, float or None)
            dy/dx at the two ends; None leaves an end without second derivative.
        method : "graph", "chord" or None
            The cubic y(x), the batten over chords, or for each piece what its chords ask for.

        Raises
        ------
        GeometryError
            ``"waterline z={z}: x not strictly increasing at row {i}"``, ``"...: negative
            half-breadth at row {i}"``, ``"...: parallel part [{p},{q}] outside the ends"``,
            ``"...: point ({x},{y}) lies in the parallel part but y differs from {y_p}"``,
            ``"...: needs at least 2 points {side} of the parallel part"``; a batten that its
            points turn too sharply.
        """
        height = float(finite(z, "waterline", ()))
        name = f"waterline z={figure(height)}"
        given = _with_ends(_checked(points, name), aft_end, fwd_end, name)
        if method is not None:
            one_of(method, ("graph", "chord"), f"{name}: method is")
        ends = _slopes(end_slope, name)
        if parallel is None:
            if len(given) < 2:
                what = f"{name}: has {len(given)} point(s)"
                raise GeometryError(what, "give two or more", {"points": len(given)})
            return cls(height, given, (_spline(given, ends, method, name),), None)
        first, last, level = _parallel(given, parallel, parallel_half_breadth, name)
        pieces: list[Piece] = [Level(first, last, level)]
        aft, fore = given[given[:, 0] < first - _SAME], given[given[:, 0] > last + _SAME]
        joint = np.array([[first, level], [last, level]])
        if len(aft):
            _enough(given[given[:, 0] <= first + _SAME], "aft", name)
            aft = np.concatenate([aft, joint[:1]])
            pieces.insert(0, _spline(aft, (ends[0], 0.0), method, name))
        if len(fore):
            _enough(given[given[:, 0] >= last - _SAME], "forward", name)
            fore = np.concatenate([joint[1:], fore])
            pieces.append(_spline(fore, (0.0, ends[1]), method, name))
        between = given[(given[:, 0] > first + _SAME) & (given[:, 0] < last - _SAME)]
        parts = [aft if len(aft) else joint[:1], between, fore if len(fore) else joint[1:]]
        return cls(height, np.concatenate(parts), tuple(pieces), (first, last))

    @property
    def name(self) -> str:
        """What it is called in messages."""
        return f"waterline z={figure(self.z)}"

    @property
    def ends(self) -> tuple[float, float]:
        """The least and the greatest x, m."""
        return float(self.points[0, 0]), float(self.points[-1, 0])

    def covers(self, x: ArrayLike) -> np.typing.NDArray[np.bool_]:
        """Tell whether it has a point at x (m)."""
        place = finite(x, self.name, None)
        return np.asarray((place >= self.ends[0] - _SAME) & (place <= self.ends[1] + _SAME))

    def at(self, x: ArrayLike) -> FloatArray:
        """Give half-breadths (m) at x (m), of the same shape.

        Raises
        ------
        GeometryError
            ``"waterline z={z}: x={x} outside [{a}, {b}]"``.
        """
        return self._of(x, 0)

    def slope(self, x: ArrayLike) -> FloatArray:
        """Give dy/dx at x (m), of the same shape; continuous."""
        return self._of(x, 1)

    def _of(self, x: ArrayLike, order: int) -> FloatArray:
        place = inside(x, self.name, *self.ends, slack=_SAME)
        flat = place.ravel()
        found = np.empty(flat.shape)
        number = np.searchsorted([each.last for each in self.pieces[:-1]], flat, side="right")
        for index in np.unique(number).tolist():
            mine = number == index
            found[mine] = self.pieces[index].of(flat[mine], order)
        return found.reshape(place.shape)


def _checked(points: ArrayLike, name: str) -> FloatArray:
    given = finite(points, name, (None, 2))
    back = np.flatnonzero(np.diff(given[:, 0]) <= 0.0)
    if len(back):
        row = int(back[0]) + 1
        what = f"{name}: x not strictly increasing at row {row}"
        raise GeometryError(what, "put the points in order from aft", {"row": row})
    negative = np.flatnonzero(given[:, 1] < 0.0)
    if len(negative):
        row = int(negative[0])
        what = f"{name}: negative half-breadth at row {row}"
        raise GeometryError(what, "give 0 or more", {"row": row, "y": float(given[row, 1])})
    return given


def _with_ends(
    given: FloatArray, aft: ArrayLike | None, fore: ArrayLike | None, name: str
) -> FloatArray:
    """Put given ends in the place of the points at and beyond them."""
    for end, sign in ((aft, 1.0), (fore, -1.0)):
        if end is None:
            continue
        place = _checked(np.atleast_2d(finite(end, f"{name}, end", (2,))), f"{name}, end")
        kept = given[sign * given[:, 0] > sign * place[0, 0] + _SAME]
        given = np.concatenate([place, kept] if sign > 0.0 else [kept, place])
    return given


def _slopes(given: object, name: str) -> tuple[float | None, float | None]:
    if not isinstance(given, tuple | list) or len(given) != 2:
        raise GeometryError(f"{name}: end_slope is no pair", "give a slope or None for each end")
    first, last = (
        None if each is None else float(finite(each, f"{name}, end slope", ())) for each in given
    )
    return first, last


def _parallel(
    given: FloatArray, parallel: tuple[float, float], breadth: float | None, name: str
) -> tuple[float, float, float]:
    """Take the parallel part: where it begins, ends, and its half-breadth."""
    first, last = finite(parallel, f"{name}, parallel part", (2,)).tolist()
    outside = not len(given) or first < given[0, 0] - _SAME or last > given[-1, 0] + _SAME
    if outside or not first < last:
        what = f"{name}: parallel part [{figure(first)},{figure(last)}] outside the ends"
        if not outside:
            what = f"{name}: parallel part [{figure(first)},{figure(last)}] has no length"
        raise GeometryError(what, "let it lie between the ends", {"p": first, "q": last})
    within = given[(given[:, 0] >= first - _SAME) & (given[:, 0] <= last + _SAME)]
    if breadth is None and not len(within):
        what = f"{name}: no point lies in the parallel part"
        raise GeometryError(what, "give its half-breadth", {"p": first, "q": last})
    level = float(within[0, 1] if breadth is None else finite(breadth, name, ()))
    for x, y in within.tolist():
        if abs(y - level) > _SAME:
            raise GeometryError(
                f"{name}: point ({figure(x)},{figure(y)}) lies in the parallel part but y differs "
                f"from {figure(level)}",
                "move the point or the end of the parallel part", {"x": x, "y": y, "y_p": level},
            )  # fmt: skip
    return first, last, level


def _enough(points: FloatArray, side: str, name: str) -> None:
    """Ask for two given points from an end of the waterline to the parallel part."""
    if len(points) < 2:
        what = f"{name}: needs at least 2 points {side} of the parallel part"
        raise GeometryError(what, "the end of the parallel part counts if it is a point", {})


def _spline(
    points: FloatArray, ends: tuple[float | None, float | None], method: Method | None, name: str
) -> Piece:
    """Lay a spline as its chords ask for, or as is forced."""
    chords = np.abs(np.diff(points[:, 1]) / np.diff(points[:, 0]))
    graph = method == "graph" or (method is None and bool((chords < _BLUNT).all()))
    return Graph.through(points, ends) if graph else Chorded.through(points, ends, name)
