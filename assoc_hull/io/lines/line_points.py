"""The lines of a hull as points, for forms that hold no splines.

Every defining point is given, and as many places between two of them as are needed for the
polyline to stay within a given distance of the curve.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.io.lines.line_points import lines_as_points
>>> line = lines_as_points(wigley(), ("sections",))[0]
>>> line.name, line.offset, line.pieces[0].points[-1].round(3).tolist()
('ST 1', 5.0, [5.0, 0.95, 9.375])
"""

from __future__ import annotations

from collections.abc import Iterable

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.splines.segments import positions
from assoc_hull.io.lines.slices import AXES
from assoc_hull.model.kinds import State
from assoc_hull.model.tables import HullState

__all__ = ["CHORD", "CurvePolyline", "LinePolylines", "lines_as_points", "splines_of"]

CHORD = 5e-4
"""How far (m) a polyline may leave its curve unless asked otherwise."""

_MOST = 64
"""A segment between two defining points is cut into no more parts."""

_LOOKED_AT = 9
"""So many places of a segment tell how far it leaves its chord."""

_TRIES = 4
"""Where curvature varies along a segment the first count is not enough."""


@attrs.frozen(eq=False)
class CurvePolyline:
    """One curve as points.

    Attributes
    ----------
    points : (n, 3), m
        In order: sections upward, other lines from aft forward.
    knuckle : (n,) bool
        Where the line has a knuckle; never at its ends.
    chord : float, m
        How far the polyline leaves the curve.
    """

    points: FloatArray
    knuckle: NDArray[np.bool_]
    chord: float

    def __attrs_post_init__(self) -> None:
        freeze(self.points, self.knuckle)


@attrs.frozen(eq=False)
class LinePolylines:
    """A line as points.

    Attributes
    ----------
    group, name : str
        Its family, such as "sections" or "boundary", and its name.
    offset : float, m
        Place of its plane: x of a section, z of a waterline, y of a buttock; nan else.
    pieces : tuple of CurvePolyline
        The lowest first, then the aftmost.
    """

    group: str
    name: str
    offset: float
    pieces: tuple[CurvePolyline, ...]


def splines_of(state: HullState, line: int) -> list[SplineBatch]:
    """Give the splines of a line.

    Raises
    ------
    BadInputError
        A curve of it has failed, or holds a number that is not finite.
    """
    curves = [c for c in state.lines.curves[line] if state.curves.alive[c]]
    for curve in curves:
        spline: SplineBatch | None = state.curves.spline[curve]
        clean = int(state.curves.state[curve]) == State.CLEAN
        if not clean or spline is None or not np.isfinite(spline.xyz).all():
            raise BadInputError(
                "the line has a curve that failed", f"in {state.lines.name[line]}",
                "mend it first: check the hull",
            )  # fmt: skip
    return [state.spline(curve) for curve in curves]


def lines_as_points(
    state: HullState, families: Iterable[str], chord: float = CHORD
) -> list[LinePolylines]:
    """Give lines as points.

    Parameters
    ----------
    state : HullState
        The hull.
    families : iterable of str
        Which, such as "sections"; they come in this order.
    chord : float, m
        How far polylines may leave the curves. Segments longer than 64 such chords leave more;
        the pieces tell.

    Returns
    -------
    list of LinePolylines
        Within a family by place, then by name.

    Raises
    ------
    BadInputError
        A curve has failed.
    """
    found: list[LinePolylines] = []
    live = state.live("lines").tolist()
    for family in families:
        mine = [_line(state, line, family, chord) for line in live if _is_of(state, line, family)]
        found += sorted(mine, key=lambda each: (np.nan_to_num(each.offset, nan=0.0), each.name))
    return found


def _is_of(state: HullState, line: int, family: str) -> bool:
    return state.family(line).name == family


def _line(state: HullState, line: int, family: str, chord: float) -> LinePolylines:
    planar = bool(state.lines.planar[line]) and family in AXES
    offset = float(state.lines.offset[line]) if planar else float("nan")
    upward = 2 if family == "sections" else 0
    pieces = [_piece(spline, upward, chord) for spline in splines_of(state, line)]
    pieces.sort(key=lambda each: (each.points[:, 2].min(), each.points[:, 0].min()))
    return LinePolylines(family, str(state.lines.name[line]), offset, tuple(pieces))


def _piece(spline: SplineBatch, way: int, chord: float) -> CurvePolyline:
    count = _parts(spline, chord)
    segment = np.repeat(np.arange(len(count)), count)
    first = np.repeat(np.cumsum(count) - count, count)
    fraction = (np.arange(len(segment)) - first) / count[segment]
    last = len(count) - 1
    points = positions(spline, np.append(segment, last), np.append(fraction, 1.0)).T.copy()
    knuckle = np.append((fraction == 0.0) & _turns(spline)[segment], False)
    off = float(_leaves(spline, segment, fraction, 1.0 / count[segment]).max())
    if points[-1, way] < points[0, way]:
        points, knuckle = points[::-1].copy(), knuckle[::-1].copy()
    return CurvePolyline(points, knuckle, off)


def _turns(spline: SplineBatch) -> NDArray[np.bool_]:
    """Tell at which knots the direction jumps, (n,); not at the ends."""
    found: NDArray[np.bool_] = (spline.leave != spline.arrive).any(axis=1)
    found[[0, -1]] = False
    return found


def _parts(spline: SplineBatch, chord: float) -> IntArray:
    """Say into how many parts each segment is cut: the error falls with their square."""
    segment = np.arange(len(spline.knot) - 1)
    many = np.ones(len(segment), np.int64)
    for _ in range(_TRIES):
        place = np.repeat(segment, many)
        first = np.cumsum(many) - many
        begin = (np.arange(len(place)) - first[place]) / many[place]
        off = np.maximum.reduceat(_leaves(spline, place, begin, 1.0 / many[place]), first)
        if off.max() <= chord:
            break
        many = np.minimum(np.ceil(many * np.sqrt(np.maximum(off / chord, 1.0))), _MOST)
        many = many.astype(np.int64)
    return many


def _leaves(
    spline: SplineBatch, segment: IntArray, begin: FloatArray, step: FloatArray
) -> FloatArray:
    """Give how far parts of segments leave their chords, (k,), m."""
    part = np.linspace(0.0, 1.0, _LOOKED_AT + 2)
    at = np.minimum(begin[:, None] + step[:, None] * part, 1.0)
    places = positions(spline, np.repeat(segment, len(part)), at.ravel()).T
    places = places.reshape(len(segment), len(part), 3)
    along = places[:, -1] - places[:, 0]
    off = places - places[:, :1]
    square = np.maximum((along * along).sum(axis=1), 1e-30)
    share = np.clip((off * along[:, None]).sum(axis=2) / square[:, None], 0.0, 1.0)
    away = off - share[:, :, None] * along[:, None]
    found: FloatArray = np.sqrt((away * away).sum(axis=2)).max(axis=1)
    return found
