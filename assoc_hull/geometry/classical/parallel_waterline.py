"""A waterline with end points of its own and a parallel part: two splines and a line between.

One spline over shoulder and parallel part would swing beyond the half-breadth. Both splines leave
the parallel part in its direction; their other end is free, without second derivative, or has a
given slope. A spline is a cubic y(x) where every chord rises less than it runs, else a batten over
its chords. x forward, y outward, m. Source: Kim & Chang, "Some Representations of Ship Hulls by
Mathematical Method for Design and Production", J. SNAK.
"""

from __future__ import annotations

from typing import Literal, Self

import attrs
import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CubicSpline

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import digits, finite_array, one_of, within_range
from assoc_hull.geometry.classical.chord_spline import ChordSpline
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = [
    "ChordedPiece",
    "GraphPiece",
    "LevelPiece",
    "ParallelWaterline",
    "WaterlinePiece",
]

# --------------------------------------------------------------------------------------
# The three kinds of pieces.


@attrs.frozen
class LevelPiece:
    """A line along the ship: from `first` to `last`, at a half-breadth, m."""

    first: float
    last: float
    half_breadth: float

    def of(self, x: FloatArray, order: int) -> FloatArray:
        """Give half-breadths (m), or with `order` 1 slopes, at x (n,), m."""
        return np.full(len(x), 0.0 if order else self.half_breadth)


@attrs.frozen(eq=False)
class GraphPiece:
    """A cubic spline y(x) from `first` to `last`, m."""

    first: float
    last: float
    spline: CubicSpline

    @classmethod
    def through(cls, points: FloatArray, ends: tuple[float | None, float | None]) -> Self:
        """Lay it through points (n, 2), m; an end has a slope, or no second derivative."""
        first, last = ((2, 0.0) if each is None else (1, each) for each in ends)
        x, y = points.T
        spline = CubicSpline(x, y, bc_type=(first, last))  # type: ignore[arg-type]
        return cls(float(x[0]), float(x[-1]), spline)

    def of(self, x: FloatArray, order: int) -> FloatArray:
        """Give half-breadths (m), or with `order` 1 slopes, at x (n,), m."""
        return np.asarray(self.spline(x, order))


@attrs.frozen(eq=False)
class ChordedPiece:
    """A batten over chords from `first` to `last`, m."""

    first: float
    last: float
    spline: ChordSpline
    name: str

    @classmethod
    def through(
        cls, points: FloatArray, ends: tuple[float | None, float | None], name: str
    ) -> Self:
        """Bend it over points (n, 2), m; an end has a slope, or is free.

        Raises
        ------
        GeometryError
            The points turn it too sharply; what is wrong begins with `name`.
        """
        first, last = (None if each is None else float(np.arctan(each)) for each in ends)
        try:
            spline = ChordSpline.through(points, first, last)
        except GeometryError as error:
            raise GeometryError(f"{name}: {error.what}", error.remedy, error.values) from None
        return cls(float(points[0, 0]), float(points[-1, 0]), spline, name)

    def of(self, x: FloatArray, order: int) -> FloatArray:
        """Give half-breadths (m), or with `order` 1 slopes, at x (n,), m.

        Raises
        ------
        GeometryError
            The batten passes an x more than once.
        """
        intersections = self.spline.where("x", x)
        if len(intersections) != len(x):
            twice = np.flatnonzero(np.bincount(intersections.index, minlength=len(x)) > 1)
            place = float(x[twice[0]])
            what = f"{self.name}: the batten turns back and passes x={place:.10g} more than once"
            raise GeometryError(what, "give more points near the end", {"x": place})
        if order:
            return np.asarray(np.tan(self.spline.direction(intersections.t)))
        return np.asarray(intersections.points[:, 1])


WaterlinePiece = LevelPiece | GraphPiece | ChordedPiece
"""A piece of any kind."""


# --------------------------------------------------------------------------------------
# The waterline.

Method = Literal["graph", "chord"]

_SAME = 1e-9
"""Places (m) that differ by less are one."""

_BLUNT = 1.0
"""A spline with a chord of this slope or more is a batten over its chords."""


@attrs.frozen(eq=False)
class ParallelWaterline:
    """A waterline; x forward, y outward, m.

    Attributes
    ----------
    z : float, m
        Its height.
    points : (n, 2), m
        All points that it passes, rows (x, y), ends among them.
    pieces : tuple of WaterlinePiece
        From aft forward: cubic, level or bent over chords.
    parallel : (float, float) or None, m
        Where the parallel part begins and ends.
    """

    z: float
    points: FloatArray
    pieces: tuple[WaterlinePiece, ...]
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
        height = float(finite_array(z, "waterline", ()))
        name = f"waterline z={digits(height)}"
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
        pieces: list[WaterlinePiece] = [LevelPiece(first, last, level)]
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
        return f"waterline z={digits(self.z)}"

    @property
    def ends(self) -> tuple[float, float]:
        """The least and the greatest x, m."""
        return float(self.points[0, 0]), float(self.points[-1, 0])

    def covers(self, x: ArrayLike) -> np.typing.NDArray[np.bool_]:
        """Tell whether it has a point at x (m)."""
        place = finite_array(x, self.name, None)
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
        place = within_range(x, self.name, *self.ends, slack=_SAME)
        flat = place.ravel()
        found = np.empty(flat.shape)
        number = np.searchsorted([each.last for each in self.pieces[:-1]], flat, side="right")
        for index in np.unique(number).tolist():
            mine = number == index
            found[mine] = self.pieces[index].of(flat[mine], order)
        return found.reshape(place.shape)


def _checked(points: ArrayLike, name: str) -> FloatArray:
    given = finite_array(points, name, (None, 2))
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
        place = _checked(np.atleast_2d(finite_array(end, f"{name}, end", (2,))), f"{name}, end")
        kept = given[sign * given[:, 0] > sign * place[0, 0] + _SAME]
        given = np.concatenate([place, kept] if sign > 0.0 else [kept, place])
    return given


def _slopes(given: object, name: str) -> tuple[float | None, float | None]:
    if not isinstance(given, tuple | list) or len(given) != 2:
        raise GeometryError(f"{name}: end_slope is no pair", "give a slope or None for each end")
    first, last = (
        None if each is None else float(finite_array(each, f"{name}, end slope", ()))
        for each in given
    )
    return first, last


def _parallel(
    given: FloatArray, parallel: tuple[float, float], breadth: float | None, name: str
) -> tuple[float, float, float]:
    """Take the parallel part: where it begins, ends, and its half-breadth."""
    first, last = finite_array(parallel, f"{name}, parallel part", (2,)).tolist()
    outside = not len(given) or first < given[0, 0] - _SAME or last > given[-1, 0] + _SAME
    if outside or not first < last:
        what = f"{name}: parallel part [{digits(first)},{digits(last)}] outside the ends"
        if not outside:
            what = f"{name}: parallel part [{digits(first)},{digits(last)}] has no length"
        raise GeometryError(what, "let it lie between the ends", {"p": first, "q": last})
    within = given[(given[:, 0] >= first - _SAME) & (given[:, 0] <= last + _SAME)]
    if breadth is None and not len(within):
        what = f"{name}: no point lies in the parallel part"
        raise GeometryError(what, "give its half-breadth", {"p": first, "q": last})
    level = float(within[0, 1] if breadth is None else finite_array(breadth, name, ()))
    for x, y in within.tolist():
        if abs(y - level) > _SAME:
            raise GeometryError(
                f"{name}: point ({digits(x)},{digits(y)}) lies in the parallel part but y differs "
                f"from {digits(level)}",
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
) -> WaterlinePiece:
    """Lay a spline as its chords ask for, or as is forced."""
    chords = np.abs(np.diff(points[:, 1]) / np.diff(points[:, 0]))
    graph = method == "graph" or (method is None and bool((chords < _BLUNT).all()))
    return GraphPiece.through(points, ends) if graph else ChordedPiece.through(points, ends, name)
