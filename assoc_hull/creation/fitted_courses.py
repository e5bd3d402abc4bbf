"""Courses and curves of two halves, fitted to curves that were drawn.

A course goes through nodes on the curve, with the angles and curvatures that the curve has there;
nodes are added until no piece passes the curve by more than a tolerance. A curve of two halves is
fitted by least squares to ordinates at stations: its ends lie where the drawn curve ends.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import attrs
import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.form_curves.curve import FormEnd, form_at, form_vertices
from assoc_hull.geometry.form_curves.shape import least_coordinate, least_rate
from assoc_hull.geometry.splines.segments import power_coefficients
from assoc_hull.model.form_definition import FormDefinition

__all__ = [
    "DrawnPath",
    "PathNode",
    "distances",
    "fit_halves",
    "fit_path",
]

# --------------------------------------------------------------------------------------
# Drawn curves as dense points in a plane.

_PLACES = 12
"""Points that are looked at on each segment of a spline."""

_CORNER = math.radians(3.0)
"""What turns by more at a point is a corner."""


@attrs.frozen(eq=False)
class DrawnPath:
    """A drawn curve in a plane, as dense points in order.

    Attributes
    ----------
    at : (n, 2), m
        Points; at a corner there are two, one for each side.
    angle : (n,), rad
        Of the tangent.
    bend : (n,), 1/m
        Signed curvature.
    begins : (k,) int
        Where runs without a corner begin.
    """

    at: FloatArray
    angle: FloatArray
    bend: FloatArray
    begins: NDArray[np.int64]

    @classmethod
    def of(cls, splines: Sequence[SplineBatch], axes: tuple[int, int]) -> DrawnPath:
        """Take curves that follow one another, each along the first axis."""
        parts = list[tuple[FloatArray, FloatArray, FloatArray]]()
        for spline in splines:
            cubic = power_coefficients(spline)[:, :, list(axes)]
            backward = spline.xyz[-1, axes[0]] < spline.xyz[0, axes[0]]
            u = np.linspace(0.0, 1.0, _PLACES + 1)[None, :, None]
            c0, c1, c2, c3 = (cubic[:, None, k] for k in range(4))
            at = c0 + u * (c1 + u * (c2 + u * c3))
            first = c1 + u * (2.0 * c2 + 3.0 * u * c3)
            second = 2.0 * c2 + 6.0 * u * c3
            if backward:
                at, first, second = at[::-1, ::-1], -first[::-1, ::-1], second[::-1, ::-1]
            parts += list(zip(at, first, second, strict=True))
        return cls._joined(parts)

    @classmethod
    def _joined(cls, parts: Sequence[tuple[FloatArray, FloatArray, FloatArray]]) -> DrawnPath:
        at, angle, bend, begins = list[FloatArray](), list[FloatArray](), list[FloatArray](), [0]
        count = 0
        for points, first, second in parts:
            pace = np.hypot(first[:, 0], first[:, 1])
            if float(pace.max()) < 1e-9:
                continue
            turn = np.arctan2(first[:, 1], first[:, 0])
            with np.errstate(divide="ignore", invalid="ignore"):
                curve = (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / pace**3
            skip = 0
            if at:
                gap = points[0] - at[-1][-1]
                if float(np.hypot(*gap)) > 1e-4:
                    # Curves that do not meet are joined by a straight piece.
                    way = math.atan2(gap[1], gap[0])
                    share = np.linspace(0.0, 1.0, _PLACES + 1)[:, None]
                    at.append(at[-1][-1] + share * gap)
                    angle.append(np.full(len(share), way))
                    bend.append(np.zeros(len(share)))
                    begins += [count, count + len(share)]
                    count += len(share)
                elif abs(math.remainder(turn[0] - angle[-1][-1], 2.0 * math.pi)) > _CORNER:
                    begins.append(count)
                else:
                    skip = 1
            at.append(points[skip:])
            angle.append(turn[skip:])
            bend.append(np.where(np.isfinite(curve), curve, 0.0)[skip:])
            count += len(points) - skip
        place = np.concatenate(at)
        # What is zero but for rounding lies on the base line.
        place[np.abs(place) < 1e-7] = 0.0
        return cls(place, np.unwrap(np.concatenate(angle)), np.concatenate(bend), np.array(begins))


@attrs.frozen
class PathNode:
    """A node of a course: the values by the names of `NODE_FIELDS`."""

    x: float
    y: float
    angle_deg: float | None = None
    curvature: float | None = None
    tangent: float | None = None
    leave_angle_deg: float | None = None
    leave_curvature: float | None = None
    leave_tangent: float | None = None

    def fields(self) -> dict[str, float | None]:
        """Give the values that are given."""
        return {name: value for name, value in attrs.asdict(self).items() if value is not None}


def distances(points: FloatArray, line: FloatArray) -> FloatArray:
    """Give signed distances of points (..., m, 2) from polylines (..., p, 2), m, by the nearest.

    A point to the left of the polyline has a positive one.
    """
    begin, way = line[..., None, :-1, :], np.diff(line, axis=-2)[..., None, :, :]
    apart = points[..., :, None, :] - begin
    size = (way * way).sum(-1)
    share = np.clip((apart * way).sum(-1) / np.where(size > 0.0, size, 1.0), 0.0, 1.0)
    off = apart - share[..., None] * way
    square = (off * off).sum(-1)
    near = square.argmin(-1)[..., None]
    cross = way[..., 0] * apart[..., 1] - way[..., 1] * apart[..., 0]
    sign = np.where(np.take_along_axis(cross, near, -1)[..., 0] < 0.0, -1.0, 1.0)
    found: FloatArray = sign * np.sqrt(np.take_along_axis(square, near, -1)[..., 0])
    return found


# --------------------------------------------------------------------------------------
# Courses through drawn paths.

_PACES = (0.5, 0.75, 1.0, 1.3, 1.7)
"""Tangents of a piece that are tried, in quarters of the chord."""

_T = np.linspace(0.0, 4.0, 33)

_STRAIGHT = 1e-6
"""m: what passes its chord by less is straight."""


def fit_path(
    path: DrawnPath, tolerance: float, onward: bool = False
) -> tuple[list[PathNode], FloatArray]:
    """Give nodes of a course through a path, and the distances (n,), m, of the path from it.

    With `onward` the course has one ordinate at each abscissa.
    """
    ends = [*path.begins.tolist()[1:], len(path.at)]
    pieces = [
        piece
        for low, high in zip(path.begins.tolist(), ends, strict=True)
        for piece in _pieces(path, low, high - 1, tolerance, onward)
    ]
    nodes, off = list[PathNode](), list[FloatArray]()
    for number, piece in enumerate(pieces):
        off.append(piece.off)
        leave = _angle(piece.angles[0])
        if not number:
            nodes.append(PathNode(*piece.ends[0], leave, piece.bends[0], piece.paces[0]))
        else:
            before = nodes[-1]
            corner = piece.first in path.begins.tolist()
            nodes[-1] = attrs.evolve(
                before, leave_angle_deg=leave if corner else None,
                leave_curvature=piece.bends[0], leave_tangent=piece.paces[0],
            )  # fmt: skip
        nodes.append(
            PathNode(*piece.ends[1], _angle(piece.angles[1]), piece.bends[1], piece.paces[1])
        )
    return [
        attrs.evolve(each, x=_binary(each.x), y=_binary(each.y)) for each in nodes
    ], np.concatenate(off)


def _binary(value: float) -> float:
    """Round to a micrometre in binary: levels then stay level to the last bit."""
    return round(value * 2.0**20) / 2.0**20 + 0.0


def _angle(radians: float) -> float:
    """Give an angle in degrees, exact where it lies along an axis."""
    degrees = math.degrees(math.remainder(radians, 2.0 * math.pi))
    level = round(degrees / 90.0) * 90.0
    return level + 0.0 if abs(degrees - level) < 1e-6 else round(degrees, 6)


@attrs.frozen(eq=False)
class _Piece:
    """A piece between two nodes: their points, angles, curvatures, tangents; what it misses."""

    first: int
    ends: tuple[tuple[float, float], tuple[float, float]]
    angles: tuple[float, float]
    bends: tuple[float, float]
    paces: tuple[float, float]
    off: FloatArray


def _pieces(path: DrawnPath, low: int, high: int, tolerance: float, onward: bool) -> list[_Piece]:
    found = _piece(path, low, high, onward)
    worst = float(np.abs(found.off).max())
    if (worst <= tolerance) or high - low < 4:
        return [found]
    step = np.hypot(*np.diff(path.at[low : high + 1], axis=0).T).cumsum()
    middle = low + 1 + int(np.searchsorted(step, 0.5 * step[-1]))
    middle = min(max(middle, low + 2), high - 2)
    return [
        *_pieces(path, low, middle, tolerance, onward),
        *_pieces(path, middle, high, tolerance, onward),
    ]


def _piece(path: DrawnPath, low: int, high: int, onward: bool) -> _Piece:
    """Give the piece that passes the path between two of its points by least."""
    points = path.at[low : high + 1]
    start, finish = points[0], points[-1]
    chord = float(np.hypot(*(finish - start)))
    ends = (float(start[0]), float(start[1])), (float(finish[0]), float(finish[1]))
    line = np.stack([start, finish])
    if float(np.abs(distances(points, line)).max()) < _STRAIGHT:
        way = math.atan2(finish[1] - start[1], finish[0] - start[0])
        return _Piece(low, ends, (way, way), (0.0, 0.0), (1.0, 1.0), np.zeros(len(points)))
    angle = np.array([path.angle[low], path.angle[high]])
    bends = [(path.bend[low], path.bend[high]), (0.0, 0.0)]
    tried = [(one, two, bend) for one in _PACES for two in _PACES for bend in bends]
    one, two, bend = (np.array([each[k] for each in tried]) for k in range(3))
    begin = FormEnd.of(start[0], start[1], angle[0], bend[:, 0], 0.25 * chord * one)
    end = FormEnd.of(finish[0], finish[1], angle[1], bend[:, 1], 0.25 * chord * two)
    vertices = form_vertices(begin, end)
    line = np.stack([form_at(vertices, np.full(len(vertices), t)) for t in _T.tolist()], axis=1)
    off = distances(np.broadcast_to(points, (len(tried), *points.shape)), line)
    worst = np.abs(off).max(axis=1)
    if onward:
        # The angles at the ends may be upright; in between it runs ahead.
        worst = np.where(least_rate(vertices, 0) < -1e-9, worst + chord, worst)
    best = int(worst.argmin())
    round_start, round_finish = np.round(bend[best], 9).tolist()
    return _Piece(
        low, ends, (float(angle[0]), float(angle[1])), (round_start, round_finish),
        (float(one[best]), float(two[best])), off[best],
    )  # fmt: skip


# --------------------------------------------------------------------------------------
# Curves of two halves through ordinates at stations.


def fit_halves(
    name: str, use: str, full: float, x: FloatArray, y: FloatArray,
    ends: tuple[tuple[float, float], tuple[float, float]], level: tuple[float, float],
    pinned: bool, most: FloatArray | None = None,
    sums: tuple[tuple[float, float], tuple[float, float]] | None = None,
) -> tuple[FormDefinition, FloatArray]:  # fmt: skip
    """Fit a curve of two halves; also give what is left of the ordinates, (n,).

    All in the frame of the ship: abscissae `x` from -1 to 1 and ordinates `y` in parts of `full`;
    the points `ends` between which it lies; `level`, between which it is full: exactly there if
    `pinned`, else about there. At no abscissa is it to be above `most`, (n,). `sums` are area and
    moment abaft and ahead of the middle of `level`, which it then has; else they are fitted.
    """
    most = np.full(len(x), np.inf) if most is None else most
    values: dict[str, float | None] = {"full": full, "top": 1.0}
    left = np.full(len(x), np.nan)
    low, high = level
    middle = 0.5 * (low + high)
    for number, half in enumerate(("run", "entrance")):
        # The entrance is fitted as its mirror image, a run.
        sign = 1.0 if half == "run" else -1.0
        end, top = (ends[0], low) if half == "run" else ((-ends[1][0], ends[1][1]), -high)
        mine = (x < low) if half == "run" else (x > high)
        at, want = sign * x[mine], y[mine]
        room = 0.0 if pinned else max(0.5 * (high - low), 1e-9)
        whole = None if sums is None else (sums[number][0], sign * sums[number][1], sign * middle)
        found = _half(at, want, most[mine], end, top, room, whole)
        left[mine] = found.left
        begin, stop = ("start", "end") if half == "run" else ("end", "start")
        values |= {
            f"{half}_{begin}": sign * end[0], f"{half}_{begin}_ordinate": end[1],
            f"{half}_{begin}_angle_deg": sign * math.degrees(found.angle),
            f"{half}_{begin}_curvature": found.bend, f"{half}_{begin}_tangent": found.paces[0],
            f"{half}_{stop}": sign * found.top, f"{half}_{stop}_curvature": found.top_bend,
            f"{half}_{stop}_tangent": found.paces[1], f"{half}_area": found.area,
            f"{half}_centroid": sign * found.centroid,
        }  # fmt: skip
    values = {
        key: value if value is None else round(value, 10) + 0.0
        for key, value in values.items() if not key.endswith(("run_end_ordinate",))
    }  # fmt: skip
    left = np.where(np.isnan(left), y - 1.0, left)
    return FormDefinition(name, use, "halves", values), left


@attrs.frozen(eq=False)
class _HalfFound:
    angle: float
    bend: float
    paces: tuple[float, float]
    top: float
    top_bend: float
    area: float
    centroid: float
    left: FloatArray


_SHARES = np.array([
    form_at(np.stack([np.eye(7), np.eye(7)], axis=-1), np.full(7, t))[:, 0]
    for t in np.linspace(0.0, 4.0, 161).tolist()
])  # fmt: skip
"""Shares of vertices in points of a half, (161, 7)."""

_STEP = 1e-6
"""Of values of a half, for rates."""

_ONWARD = 2e-3
"""Of its span by t: so fast the abscissa of a half is to run at least."""


@attrs.frozen(eq=False)
class _HalfFit:
    """A half that rises from its end to 1, to be fitted to ordinates.

    Its eight unknowns are angle, curvature and logarithm of the pace at its end, logarithm of the
    pace and curvature at its top, by how much it is full beyond `top`, area and centroid.

    Attributes
    ----------
    x, y, most : (n,)
        Abscissae, ascending, ordinates there, and what these are not to pass.
    end : (float, float)
        Where it begins.
    top, room : float
        It may become full up to `room` before or after `top`.
    whole : (float, float, float) or None
        Area and moment up to a place in the parallel part, and that place.
    weight : (n,)
        Of the ordinates.
    first : (8,)
        Where the search begins.
    """

    x: FloatArray
    y: FloatArray
    most: FloatArray
    end: tuple[float, float]
    top: float
    room: float
    whole: tuple[float, float, float] | None
    weight: FloatArray
    first: FloatArray
    low: FloatArray
    high: FloatArray

    @classmethod
    def of(
        cls, x: FloatArray, y: FloatArray, most: FloatArray, end: tuple[float, float], top: float,
        room: float, whole: tuple[float, float, float] | None,
    ) -> _HalfFit:  # fmt: skip
        """Set up the search; `x` ascends."""
        place = np.concatenate([[end[0]], x, [top]])
        height = np.concatenate([[end[1]], y, [1.0]])
        area = float(np.trapezoid(height, place))
        centroid = float(np.trapezoid(height * place, place)) / area
        span = top - end[0]
        chord = math.hypot(span, 1.0 - end[1])
        # Stations stand closer where more happens; a share of the span each lets the rest count.
        weight = np.sqrt(np.gradient(place)[1:-1] / span) + 0.05 if len(x) else np.empty(0)
        slope = math.atan2(height[1] - height[0], max(place[1] - place[0], 1e-9))
        first = np.array([
            min(slope, 1.5), 0.0, math.log(0.125 * chord), math.log(0.25 * chord), 0.0, 0.0, area,
            centroid,
        ])  # fmt: skip
        # Without a parallel part both halves end at one place, or short of it.
        slack = (room if room > 1e-8 else 0.0) if room else 1e-9
        low = np.array([0.0, -60.0, math.log(0.02 * chord), math.log(0.02 * chord), -8.0,
                        -0.15 * span if room else -1e-9, 0.8 * area, centroid - 0.1])  # fmt: skip
        high = np.array([1.57, 60.0, math.log(0.5 * chord), math.log(0.5 * chord), 0.0,
                         slack, 1.2 * area, centroid + 0.1])  # fmt: skip
        return cls(x, y, most, end, top, room, whole, weight, first, low, high)

    def full_at(self, p: FloatArray) -> FloatArray:
        """Give where halves become full; `p` (s, 8) here and below."""
        return self.top + (p[:, 5] if self.room else 0.0 * p[:, 5])

    def sums(self, p: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give areas and centroids of halves, which may follow from those of the whole."""
        if self.whole is None:
            return p[:, 6], p[:, 7]
        total, moment, place = self.whole
        full = self.full_at(p)
        size = total - (place - full)
        return size, (moment - 0.5 * (place * place - full * full)) / size

    def vertices(self, p: FloatArray) -> FloatArray:
        """Give the vertices of halves, (s, 7, 2)."""
        start = FormEnd.of(self.end[0], self.end[1], p[:, 0], p[:, 1], np.exp(p[:, 2]))
        finish = FormEnd.of(self.full_at(p), 1.0, 0.0, p[:, 4], np.exp(p[:, 3]))
        return form_vertices(start, finish, *self.sums(p))

    def ordinates(self, p: FloatArray, vertices: FloatArray) -> FloatArray:
        """Give the ordinates of halves at the abscissae, (s, n)."""
        line = np.einsum("st,ntk->nsk", _SHARES, vertices)
        found = np.array([
            np.interp(self.x, np.maximum.accumulate(each[:, 0]), each[:, 1]) for each in line
        ])  # fmt: skip
        return np.where(self.x >= self.full_at(p)[:, None], 1.0, found)

    def residuals(self, p: FloatArray) -> FloatArray:
        """Give what least squares are of: misfits, then what a half must not do, then its size."""
        vertices = np.nan_to_num(self.vertices(p), nan=10.0, posinf=10.0, neginf=10.0)
        got, span = self.ordinates(p, vertices), self.top - self.end[0]
        back = np.minimum(least_rate(vertices, 0) - _ONWARD * span, 0.0)
        over = np.maximum(-least_coordinate(vertices * np.array([1.0, -1.0]), 1) - 1.0, 0.0)
        below = np.minimum(least_coordinate(vertices, 1), 0.0)
        move = 1e-3 * (p - self.first) / np.array([1e3, 10.0, 1.0, 1.0, 10.0, 1.0, 1.0, 1.0])
        return np.concatenate([
            self.weight * (got - self.y), 10.0 * np.maximum(got - self.most, 0.0),
            30.0 * back[:, None], 30.0 * over[:, None], 30.0 * below[:, None], move,
        ], axis=1)  # fmt: skip

    def misfit(self, p: FloatArray) -> FloatArray:
        """Give the residuals of one half `p` (8,)."""
        return np.asarray(self.residuals(p[None])[0])

    def rates(self, p: FloatArray) -> FloatArray:
        """Give the derivatives of the residuals of one half `p` (8,)."""
        # Within the limits: a step inward from the upper ones.
        step = np.where(p + _STEP < self.high, _STEP, -_STEP)
        found = self.residuals(np.concatenate([p[None], p + np.diag(step)]))
        return np.asarray(((found[1:] - found[0]) / step[:, None]).T)

    def fitted(self) -> FloatArray:
        """Give the best of searches that begin at three angles, (8,)."""
        best = None
        for angle in (self.first[0], 0.3 * self.first[0], 0.9):
            begin = self.first.copy()
            begin[0] = angle
            found = least_squares(
                self.misfit, np.clip(begin, self.low + 1e-12, self.high - 1e-12), self.rates,
                bounds=(self.low, self.high),
                x_scale=[0.3, 3.0, 0.3, 0.3, 1.0, 0.05, 0.01, 0.01], max_nfev=150,
            )  # fmt: skip
            if best is None or found.cost < best.cost:
                best = found
        assert best is not None
        return np.asarray(best.x)


def _half(
    x: FloatArray, y: FloatArray, most: FloatArray, end: tuple[float, float], top: float,
    room: float, whole: tuple[float, float, float] | None,
) -> _HalfFound:  # fmt: skip
    """Fit a half to ordinates in any order; the arguments are those of `_HalfFit`."""
    order = np.argsort(x)
    fit = _HalfFit.of(x[order], y[order], most[order], end, top, room, whole)
    best = fit.fitted()
    p = best[None]
    left = np.empty(len(x))
    left[order] = fit.ordinates(p, fit.vertices(p))[0] - fit.y
    angle, bend, pace, top_pace, top_bend = best[:5].tolist()
    area, centroid = (float(each[0]) for each in fit.sums(p))
    return _HalfFound(
        angle, bend, (math.exp(pace), math.exp(top_pace)), float(fit.full_at(p)[0]), top_bend, area,
        centroid, left,
    )  # fmt: skip
