"""The compiled backend: the operations of the numpy backend, with the same bits.

`compiled_loft` and `compiled_intersections` repeat the arithmetic of `loft`, `tridiagonal`,
`plane_heights`, `roots` and `plane_intersections` in the same order, without fastmath and fused
multiplication, so that the last bit agrees; the tests compare them. Change both together.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.curves import CurveData
>>> from assoc_hull.geometry.splines.compiled import loft_compiled
>>> loft_compiled(CurveData.single(np.array([[0.0, 0, 0], [3, 4, 0]]))).knot
array([0., 5.])
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

import numpy as np

from assoc_hull.geometry.curves import CurveData, FloatArray, SplineBatch
from assoc_hull.geometry.numeric.compiled_roots import find_roots
from assoc_hull.geometry.numeric.roots import FLOOR, MOST_TRIALS, RELATIVE, STEPS
from assoc_hull.geometry.numeric.tridiagonal import MOST_LEVELS, Workspace
from assoc_hull.geometry.splines.compiled_coons import set_bows, set_tiles
from assoc_hull.geometry.splines.compiled_intersections import meet_curves, place_meetings
from assoc_hull.geometry.splines.compiled_loft import loft_curves
from assoc_hull.geometry.splines.loft_rules import LEAST_COSINE, NO_DIRECTION
from assoc_hull.geometry.splines.paths import QUICK, SMALL, PathShapes
from assoc_hull.geometry.splines.plane_heights import CONTACT, MonotoneParts, PlaneRoots
from assoc_hull.tolerance import Tolerances

if TYPE_CHECKING:
    from assoc_hull.geometry.splines.paths import StripTiles

__all__ = ["loft_compiled", "meet", "tiles", "warm"]

Scalar = TypeVar("Scalar", bound=np.generic)


def _plain(array: np.typing.NDArray[Scalar]) -> np.typing.NDArray[Scalar]:
    """Give a contiguous read-only view, so that only one version is ever compiled."""
    flags = array.flags
    if flags.c_contiguous and not flags.writeable:
        return array
    result = np.ascontiguousarray(array).view()
    result.setflags(write=False)
    return result


def loft_compiled(data: CurveData) -> SplineBatch | None:
    """Make the splines of a batch.

    Parameters
    ----------
    data : CurveData
        Points (n, 3) in m, kinds and end conditions.

    Returns
    -------
    SplineBatch or None
        The splines; None if anything is wrong with the data, which the numpy backend
        then finds and names.

    Examples
    --------
    >>> loft_compiled(CurveData.single(np.array([[0.0, 0, 0]]))) is None
    True
    """
    size = len(data.xyz)
    knot, block = np.empty(size), np.empty((9, size))
    with Workspace() as workspace:
        done = loft_curves(
            _plain(data.start),
            _plain(data.xyz),
            _plain(data.kind),
            _plain(data.direction),
            _plain(data.end_kind),
            _plain(data.end_vector),
            Tolerances().coincident,
            LEAST_COSINE,
            NO_DIRECTION,
            MOST_LEVELS,
            workspace.array(9, size + 2),
            knot,
            block,
        )
    if not done:
        return None
    return SplineBatch(data.start, knot, block[:3].T, block[3:6].T, block[6:].T)


def meet(
    batch: SplineBatch, normal: FloatArray, offsets: FloatArray, factor: float = 1.0
) -> PlaneRoots:
    """Find the meetings of curves with planes.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    normal : (3,)
        Unit normal of the planes.
    offsets : (p,), m
        Their offsets, ascending.
    factor : float
        Of lengths, by the size of the hull.

    Returns
    -------
    PlaneRoots
        All intersections, and the monotone parts of segments that they lie in.

    Examples
    --------
    >>> line = loft_compiled(CurveData.single(np.array([[0.0, 0, 0], [3, 4, 0]])))
    >>> meet(line, np.array([1.0, 0.0, 0.0]), np.array([1.5])).t
    array([2.5])
    """
    parts = normal.tolist()
    axis = parts.index(1.0) if parts.count(0.0) == 2 and 1.0 in parts else -1
    start, knot, offsets = _plain(batch.start), _plain(batch.knot), _plain(offsets)
    vectors = _plain(batch.xyz.T), _plain(batch.leave.T), _plain(batch.arrive.T)
    with Workspace() as workspace:
        scratch = workspace.array(4, len(knot))
        places, numbers, owner, plane, cubics = meet_curves(
            start, knot, *vectors, _plain(normal), axis, offsets, CONTACT, scratch
        )
    roots = find_roots(cubics, STEPS, factor * FLOOR, RELATIVE, MOST_TRIALS)
    told, sign, t, points, near = place_meetings(
        start, knot, *vectors, places, numbers, offsets, owner, plane, roots, CONTACT
    )
    segment, order, below_begin, below_end = places
    lower, upper, begin, end = numbers
    parts = MonotoneParts(segment, order, lower, upper, begin, end, below_begin, below_end)
    return PlaneRoots(parts, owner, plane, told[0], told[1], sign, t, points, near)


def tiles(
    where: StripTiles,
    v: FloatArray,
    walked: PathShapes,
    shapes: tuple[FloatArray, FloatArray, FloatArray],
    bow: FloatArray,
) -> tuple[FloatArray, FloatArray] | None:
    """Give the tiles of curves across the strips of a Coons surface.

    Parameters
    ----------
    where : StripTiles
        What the curves consist of.
    v : (k,)
        Where they lie across their strips.
    walked : PathShapes
        The anchors.
    shapes : ((t, 4, 3), (t, 4, 3), (t, 4, 4))
        The rails aft, from there to those forward, and the weights of the anchors.
    bow : (a + 3, 6)
        Nil; room for what the anchors leave their chords by.

    Returns
    -------
    ((s, 4, 3), (s, 4, 3)) or None
        Coefficients of P and of P_v; None if a place on an anchor needs more care.
    """
    chosen, path, curve = where.plane
    start, cubic = _plain(walked.paths.start), _plain(walked.cubic)
    v = _plain(v)
    if not set_bows(
        _plain(chosen), _plain(path), _plain(curve), v, start, cubic, QUICK, SMALL, bow
    ):
        return None
    point, across = np.empty((2, len(where.tile), 4, 3))
    aft, span, blend = (_plain(each) for each in shapes)
    numbers = (_plain(where.tile), _plain(where.curve), _plain(where.first))
    set_tiles(*numbers, v, aft, span, blend, bow, point, across)
    return point, across


def warm() -> None:
    """Compile the backend, or load what was compiled before.

    Examples
    --------
    >>> warm()
    """
    line = loft_compiled(CurveData.single(np.array([[0.0, 0, 0], [3, 4, 0]])))
    if line is not None:
        meet(line, np.array([1.0, 0.0, 0.0]), np.array([1.5]))
    none, nil = _plain(np.zeros(0, np.int64)), _plain(np.zeros(1))
    cubic, room = _plain(np.zeros((1, 4, 3))), np.zeros((4, 6))
    set_bows(none, none, none, nil, none, cubic, QUICK, SMALL, room)
    blend, tiles_of_none = _plain(np.zeros((1, 4, 4))), np.zeros((2, 0, 4, 3))
    set_tiles(none, none, none, nil, cubic, cubic, blend, room, *tiles_of_none)
