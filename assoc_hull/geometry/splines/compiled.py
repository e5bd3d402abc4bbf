"""The compiled backend: the operations of the numpy backend, with the same bits.

`compiled_loft` and `compiled_intersections` repeat the arithmetic of `loft`, `tridiagonal`,
`plane_heights`, `polynomials` and `plane_intersections` in the same order, without fastmath and
fused multiplication, so that the last bit agrees; the tests compare them. Change both together.

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
from assoc_hull.geometry.numeric.polynomials import FLOOR, MOST_TRIALS, RELATIVE, STEPS
from assoc_hull.geometry.numeric.tridiagonal import MOST_LEVELS, Workspace
from assoc_hull.geometry.splines.compiled_intersections import meet_curves, place_meetings
from assoc_hull.geometry.splines.compiled_loft import loft_curves
from assoc_hull.geometry.splines.loft_rules import LEAST_COSINE, NO_DIRECTION
from assoc_hull.geometry.splines.paths import QUICK, SMALL, PathShapes
from assoc_hull.geometry.splines.plane_heights import CONTACT, MonotoneParts, PlaneRoots
from assoc_hull.tolerance import Tolerances

if TYPE_CHECKING:
    from assoc_hull.geometry.splines.paths import StripTiles
from assoc_hull.geometry.curves import IntArray
from assoc_hull.geometry.numeric.jit import jit

__all__ = ["loft_compiled", "meet", "set_bows", "set_tiles", "tiles", "warm"]

# --------------------------------------------------------------------------------------
# Curves across a Coons surface, compiled; numpy's of `coons` to rounding.
#
# Unlike splines and meetings these need not have the same bits: nothing that is kept of a hull
# depends on them.


@jit
def _root(cubic: FloatArray, target: float, steps: int, small: float) -> float:
    """Find where x of one monotone cubic reaches a value; beyond 2 where Newton's rule fails."""
    c0, c1, c2, c3 = cubic[0, 0] - target, cubic[1, 0], cubic[2, 0], cubic[3, 0]
    slope = c1 + c2 + c3
    if slope == 0.0:
        return 3.0
    u = -c0 / slope
    for _ in range(steps):
        step = (((c3 * u + c2) * u + c1) * u + c0) / ((3.0 * c3 * u + 2.0 * c2) * u + c1)
        u -= step
        if abs(step) <= small:
            if -small <= u <= 1.0 + small:
                return 0.0 if u < 0.0 else (1.0 if u > 1.0 else float(u))
            return 3.0
    return 3.0


@jit
def set_bows(
    chosen: IntArray,
    path: IntArray,
    curve: IntArray,
    v: FloatArray,
    start: IntArray,
    cubic: FloatArray,
    steps: int,
    small: float,
    bow: FloatArray,
) -> bool:
    """Set by what anchors that are walked by x leave their chords; False if one is lost."""
    for k in range(len(chosen)):
        p, w = path[k], v[curve[k]]
        first, last = start[p], start[p + 1] - 1
        begin = cubic[first, 0]
        finish = cubic[last, 0] + cubic[last, 1] + cubic[last, 2] + cubic[last, 3]
        target = begin[0] + w * (finish[0] - begin[0])
        rising = finish[0] >= begin[0]
        bit = first
        while bit < last and ((cubic[bit + 1, 0, 0] <= target) == rising):
            bit += 1
        u = _root(cubic[bit], target, steps, small)
        if u > 2.0:
            return False
        row = bow[chosen[k]]
        c0, c1, c2, c3 = cubic[bit, 0], cubic[bit, 1], cubic[bit, 2], cubic[bit, 3]
        rate = (3.0 * c3[0] * u + 2.0 * c2[0]) * u + c1[0]
        share = (finish[0] - begin[0]) / rate
        for i in range(3):
            chord = finish[i] - begin[i]
            place = ((c3[i] * u + c2[i]) * u + c1[i]) * u + c0[i]
            row[i] = place - (begin[i] + w * chord)
            row[3 + i] = ((3.0 * c3[i] * u + 2.0 * c2[i]) * u + c1[i]) * share - chord
    return True


@jit
def set_tiles(
    tile: IntArray,
    curve: IntArray,
    anchor: IntArray,
    v: FloatArray,
    aft: FloatArray,
    span: FloatArray,
    blend: FloatArray,
    bow: FloatArray,
    point: FloatArray,
    across: FloatArray,
) -> None:
    """Set the cubics of tiles: what lies between the rails, and what the anchors add."""
    for s in range(len(tile)):
        t, w, a = tile[s], v[curve[s]], anchor[s]
        for i in range(4):
            for c in range(3):
                rise = 0.0
                turn = 0.0
                for j in range(4):
                    rise += blend[t, i, j] * bow[a + j, c]
                    turn += blend[t, i, j] * bow[a + j, 3 + c]
                point[s, i, c] = aft[t, i, c] + w * span[t, i, c] + rise
                across[s, i, c] = span[t, i, c] + turn


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
