"""The half-breadth anywhere: read off a line that is there, else off a waterline cut for it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NoReturn

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import NoMeetingError
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.geometry.splines.segments import derivative
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.tables import HullState

__all__ = ["half_breadth", "half_breadth_rows", "half_breadths"]

_X, _Z = np.eye(3)[0], np.eye(3)[2]
_APART = 1e-3
"""Times `Tolerances.factor`: marks of a cut nearer in x than this (m) count as one."""


@attrs.frozen(eq=False)
class _Marks:
    """Where a level plane meets sections and boundary curves, by x."""

    xyz: FloatArray
    boundary: IntArray


def half_breadth(state: HullState, x: float, z: float) -> float:
    """Give the half-breadth at a place of the centre plane.

    Parameters
    ----------
    state : HullState
        The tables.
    x, z : float, m
        The place.

    Returns
    -------
    float, m
        Of a waterline at z or a section at x, if there is one; else of a waterline that is
        cut from sections and boundary curves. The largest, where there are several.

    Raises
    ------
    NoMeetingError
        The hull does not come there.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.half_breadth import half_breadth
    >>> round(half_breadth(wigley(), 40.0, 2.5), 6)
    3.072
    """
    for family, at, normal, other in (("waterlines", z, _X, x), ("sections", x, _Z, z)):
        curves = _at(state, family, at)
        met = _meet(state, curves, normal, other)[1]
        if len(met):
            return float(met[:, 1].max())
    return _cut(state, float(x), float(z))


def _families(state: HullState, curves: IntArray) -> list[str]:
    return [state.family(state.line_of(curve)).name for curve in curves.tolist()]


def _at(state: HullState, family: str, position: float) -> IntArray:
    """Give the curves of a family in the plane at a position."""
    curves = state.live("curves")
    there = state.lines.offset[state.curves.line[curves]] == position
    mine = np.array([name == family for name in _families(state, curves)], bool)
    found: IntArray = curves[there & mine]
    return found


def _meet(
    state: HullState, curves: IntArray, normal: FloatArray, position: float
) -> tuple[IntArray, FloatArray]:
    """Meet curves with a plane; give the curve and the place of each meeting."""
    owner, _, xyz = _meet_planes(state, curves, normal, np.array([float(position)]))
    return owner, xyz


def _meet_planes(
    state: HullState, curves: IntArray, normal: FloatArray, position: FloatArray
) -> tuple[IntArray, IntArray, FloatArray]:
    """Meet curves with planes (p,); give curve, plane and place of each meeting."""
    if not len(curves):
        return np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros((0, 3))
    batch = SplineBatch.join([state.spline(curve) for curve in curves.tolist()])
    planes, which = np.unique(position, return_inverse=True)
    met = intersect_planes(batch, normal, planes)
    if len(planes) == len(position):
        return curves[met.curve], np.argsort(which)[met.plane], met.xyz
    # A height that was asked for twice is met twice.
    at = [np.flatnonzero(met.plane == each) for each in which.tolist()]
    every = np.concatenate(at)
    plane = np.repeat(np.arange(len(position)), [len(each) for each in at])
    return curves[met.curve[every]], plane, met.xyz[every]


def _cut(state: HullState, x: float, z: float) -> float:
    apart = state.tolerances.factor * _APART
    marks = _marks(state, z, apart)
    low, high = _ends(marks)
    if not low <= x <= high or _between_pieces(marks, np.array([x]), apart)[0]:
        _refuse(x, z, low, high)
    met = intersect_planes(loft(_data(marks)), _X, np.array([x])).xyz
    ends = marks.xyz[np.abs(marks.xyz[:, 0] - x) == 0.0]
    return float(np.concatenate([met, ends])[:, 1].max())


def half_breadths(state: HullState, x: FloatArray, z: float) -> tuple[FloatArray, FloatArray]:
    """Give half-breadths along a waterline that is cut at a height, and their slopes along x.

    Parameters
    ----------
    state : HullState
        The tables.
    x : (n,), m
        Places along the waterline, in any order.
    z : float, m
        Its height.

    Returns
    -------
    (n,) m, (n,)
        The largest half-breadth where there are several, and dy/dx there.

    Raises
    ------
    NoMeetingError
        The hull does not come to one of the places.
    """
    found, slope = half_breadth_rows(state, x[None, :], np.array([z]))
    return found[0], slope[0]


def half_breadth_rows(
    state: HullState, x: FloatArray, z: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give half-breadths along several waterlines at once, with the bits of `half_breadths`.

    Parameters
    ----------
    state : HullState
        The tables.
    x : (m, n), m
        Places along each waterline, in any order.
    z : (m,), m
        Their heights.

    Returns
    -------
    (m, n) m, (m, n)
        The largest half-breadth where there are several, and dy/dx there.

    Raises
    ------
    NoMeetingError
        The hull does not come to one of the places; the first that is met is told.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.half_breadth import half_breadth_rows
    >>> half_breadth_rows(wigley(), np.array([[40.0], [50.0]]), np.array([2.5, 6.25]))[0].round(6)
    array([[3.072],
           [5.   ]])
    """
    apart = state.tolerances.factor * _APART
    marks = _level_marks(state, z, apart)
    for places, level, each in zip(x, z.tolist(), marks, strict=True):
        low, high = _ends(each)
        outside = ~((low <= places) & (places <= high))
        if not outside.all():
            outside |= _between_pieces(each, places, apart)
        if outside.any():
            _refuse(float(places[outside.argmax()]), level, low, high)
    planes, which = np.unique(x, return_inverse=True)
    batch = loft(_joined([_data(each) for each in marks]))
    met = intersect_planes(batch, _X, planes)
    code = met.curve * len(planes) + met.plane
    order = np.lexsort((-met.xyz[:, 1], code))
    known, first = np.unique(code[order], return_index=True)
    wanted = np.arange(len(z))[:, None] * len(planes) + which.reshape(x.shape)
    place = np.searchsorted(known, wanted)
    lost = known[np.minimum(place, len(known) - 1)] != wanted if len(known) else x == x
    if lost.any():
        row, column = np.unravel_index(int(lost.argmax()), x.shape)
        _refuse(float(x[row, column]), float(z[row]), *_ends(marks[row]))
    chosen = order[first[place]]
    along = derivative(batch, met.curve[chosen].ravel(), met.t[chosen].ravel())
    return met.xyz[chosen, 1], (along[:, 1] / along[:, 0]).reshape(x.shape)


def _joined(parts: Sequence[CurveData]) -> CurveData:
    """Put the data of curves one behind the other."""
    count = [len(each.xyz) for each in parts]
    columns = [
        np.concatenate([getattr(each, name) for each in parts])
        for name in ("xyz", "kind", "direction", "end_kind", "end_vector")
    ]
    return CurveData(np.concatenate([[0], np.cumsum(count)]), *columns)


def _ends(marks: _Marks) -> tuple[float, float]:
    """Give the least and the largest x of a cut; nothing lies between them if there is none."""
    if len(marks.xyz) < 2:
        return np.inf, -np.inf
    return float(marks.xyz[0, 0]), float(marks.xyz[-1, 0])


def _refuse(x: float, z: float, low: float, high: float) -> NoReturn:
    away = max(low - x, x - high, 0.0)
    raise NoMeetingError(f"the hull at x = {x:g}, z = {z:g} m", float(away), _ASK)


_ASK = "ask for a place between the ends of the hull and below the deck"


def _marks(state: HullState, z: float, apart: float) -> _Marks:
    """Cut sections and boundary curves at a height; one mark at each x, boundaries first."""
    return _level_marks(state, np.array([float(z)]), apart)[0]


def _level_marks(state: HullState, z: FloatArray, apart: float) -> list[_Marks]:
    """Cut sections and boundary curves at heights (m,); see `_marks`."""
    curves = state.live("curves")
    wanted = [name in ("sections", "boundary") for name in _families(state, curves)]
    owner, plane, xyz = _meet_planes(state, curves[np.array(wanted, bool)], _Z, z)
    return [_thinned(state, owner[plane == i], xyz[plane == i], apart) for i in range(len(z))]


def _thinned(state: HullState, owner: IntArray, xyz: FloatArray, apart: float) -> _Marks:
    """Leave one mark at each x, of boundaries before others, of those the broadest."""
    kind = state.lines.boundary[state.curves.line[owner]].astype(np.int64)
    order = np.lexsort((-xyz[:, 1], xyz[:, 0]))
    kept: list[int] = []
    for item in order.tolist():
        if kept and xyz[item, 0] - xyz[kept[-1], 0] < apart:
            if xyz[item, 1] > xyz[kept[-1], 1] or kind[item] > kind[kept[-1]]:
                kept[-1] = item
            continue
        kept.append(item)
    return _Marks(xyz[kept], kind[kept])


def _between_pieces(marks: _Marks, x: FloatArray, apart: float) -> NDArray[np.bool_]:
    """Tell which places (n,) lie between the end of one piece and the beginning of the next."""
    after = np.clip(np.searchsorted(marks.xyz[:, 0], x), 1, len(marks.xyz) - 1)
    ends = (marks.boundary == BoundaryKind.END) & (marks.xyz[:, 1] <= apart)
    between: NDArray[np.bool_] = ends[after - 1] & ends[after]
    return between


def _data(marks: _Marks) -> CurveData:
    flat = marks.boundary == BoundaryKind.FLAT
    kind = np.where(flat, int(PointKind.TANGENT), int(PointKind.SMOOTH))
    kind = np.where(marks.boundary == BoundaryKind.KNUCKLE, int(PointKind.KNUCKLE), kind)
    direction = np.where(flat[:, None], _X, 0.0)
    return CurveData.single(marks.xyz, kind.astype(np.int8), direction)
