"""How lofted curves change when their points move: the loft itself, differentiated exactly.

Everything varies: chord lengths, and with them the parameters; the directions of the local
rule; the solution of the tridiagonal rows. Where the loft decides (a knuckle side that would
fold back, a parabola without a direction), it decides here as it did there. Chord-length
parameters kept as they were would give an area that is wrong in the third digit.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.curves import CurveData
>>> from assoc_hull.geometry.splines.loft_tangents import loft_tangents
>>> line = CurveData.single(np.array([[0.0, 0, 0], [2, 0, 0]]))
>>> stretched = np.array([[[0.0, 0, 0], [1, 0, 0]]])  # one tangent: the second point, forward
>>> loft_tangents(line, stretched).knot.dot.tolist()
[[0.0, 1.0]]
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.numeric.dual import Dual, as_array
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.loft_at import LoftAt, Moves, Tangents

__all__ = ["DualSplines", "loft_tangents"]


@attrs.frozen(eq=False)
class DualSplines:
    """Lofted curves with tangents; the fields are those of a `SplineBatch`.

    Attributes
    ----------
    start : (m + 1,) int
        Where each curve's knots begin.
    knot : Dual (n,), m
        Chord-length parameter.
    xyz : Dual (n, 3), m
        The defining points.
    leave, arrive : Dual (n, 3)
        Derivative after and before each knot with respect to the chord-length parameter.
    """

    start: IntArray
    knot: Dual
    xyz: Dual
    leave: Dual
    arrive: Dual

    def __attrs_post_init__(self) -> None:
        for each in (self.knot, self.xyz, self.leave, self.arrive):
            each.setflags(write=False)

    @property
    def count(self) -> int:
        """Number of curves."""
        return len(self.start) - 1

    def batch(self) -> SplineBatch:
        """Give it as a batch, for functions that compute with its arrays alike.

        Returns
        -------
        SplineBatch
            Its arrays are `Dual`, and so is what `assoc_hull.geometry.splines.segments.power` and
            `assoc_hull.geometry.integrals.area_moments.section_area` give of it.
        """
        knot, xyz = as_array(self.knot), as_array(self.xyz)
        return SplineBatch(self.start, knot, xyz, as_array(self.leave), as_array(self.arrive))


_FEW = 0.4
"""If tangents move fewer of their points than this part, each curve is taken for itself."""


def loft_tangents(
    data: CurveData,
    xyz: FloatArray,
    direction: FloatArray | None = None,
    end_vector: FloatArray | None = None,
) -> DualSplines:
    """Loft curves, and differentiate the result with respect to k parameters.

    Parameters
    ----------
    data : CurveData
        Points (n, 3) in m, kinds and end conditions of m curves.
    xyz : (k, n, 3), m per unit of its parameter
        How the points move with each parameter.
    direction : (k, n, 3) or None
        How the given directions of tangent points change; not at all if None.
    end_vector : (k, m, 2, 3) or None
        How the vectors of the end conditions change; not at all if None.

    Returns
    -------
    DualSplines
        The splines of `loft`, bit for bit, with tangents.

    Raises
    ------
    TooFewPointsError, CoincidentPointsError, BadInputError
        As for `loft`; or tangents of another shape or that are not finite.

    Notes
    -----
    Where there are many tangents, each costs about as much as lofting the curves that it moves;
    curves that it leaves alone cost next to nothing.
    """
    spline = loft(data)
    moves = Moves(
        _checked("the points", xyz, data.xyz, len(xyz)),
        None if direction is None else _checked("directions", direction, data.xyz, len(xyz)),
        None
        if end_vector is None
        else _checked("end vectors", end_vector, data.end_vector, len(xyz)),
    )
    knot, leave, arrive = _differentiated(data, spline, moves)
    return DualSplines(
        spline.start,
        Dual(spline.knot, knot),
        Dual(spline.xyz, moves.xyz),
        Dual(spline.leave, leave.swapaxes(1, 2)),
        Dual(spline.arrive, arrive.swapaxes(1, 2)),
    )


def _checked(name: str, given: FloatArray, value: FloatArray, count: int) -> FloatArray:
    """Give tangents of an array; views, as they are going to be read-only."""
    shape, dot = (count, *value.shape), np.asarray(given, np.float64)[...]
    if dot.shape != shape or not np.isfinite(dot).all():
        raise BadInputError(
            f"tangents of {name} of shape {dot.shape}, or not finite",
            "in loft_tangents",
            f"give {shape}",
        )
    return dot


def _differentiated(data: CurveData, spline: SplineBatch, moves: Moves) -> Tangents:
    """Choose the way: all tangents of all curves, or each curve for those that move it."""
    touched = moves.touched(data.start)
    if (touched @ np.diff(data.start)).sum() < _FEW * moves.xyz[..., 0].size:
        tangent, curve = np.nonzero(touched)
        return _by_pairs(data, spline, moves, tangent, curve)
    return LoftAt.of(data, spline.leave.T, spline.arrive.T).tangents(moves)


def _by_pairs(
    data: CurveData, spline: SplineBatch, moves: Moves, tangent: IntArray, curve: IntArray
) -> Tangents:
    """Differentiate curves for the tangents that move them, side by side in one batch."""
    counts = np.diff(data.start)[curve]
    start = np.concatenate([[0], np.cumsum(counts)])
    rows = np.arange(start[-1]) + np.repeat(data.start[curve] - start[:-1], counts)
    which = np.repeat(tangent, counts)
    count, size = moves.xyz.shape[:2]
    found = np.zeros((count, size)), *np.zeros((2, count, 3, size))
    if len(rows):
        pairs = CurveData(
            start,
            data.xyz[rows],
            data.kind[rows],
            data.direction[rows],
            data.end_kind[curve],
            data.end_vector[curve],
        )
        mine = moves.take(which[None], rows[None], tangent[None], curve[None])
        loft_at = LoftAt.of(pairs, spline.leave[rows].T, spline.arrive[rows].T)
        for whole, dot in zip(found, loft_at.tangents(mine), strict=True):
            whole[which, ..., rows] = dot[0].T
    return found
