"""The cubic composite spline of the kernel: chord length, knuckles, tangent points, all at once.

A curve is cut into pieces at tangent and knuckle points; each piece has continuous second
derivatives. A curve is a pure function of its own data: its bits are the same alone and in
any batch, because all arithmetic is elementwise ``+ - * /`` and square root in one fixed
order per curve.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.curves import CurveData
>>> from assoc_hull.geometry.splines.segments import evaluate
>>> from assoc_hull.geometry.splines.loft import loft
>>> spline = loft(CurveData.single(np.array([[0.0, 0, 0], [3, 4, 0]])))
>>> evaluate(spline, np.array([0]), np.array([2.5]))
array([[1.5, 2. , 0. ]])
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError, CoincidentPointsError, TooFewPointsError
from assoc_hull.geometry.curves import CurveData, FloatArray, SplineBatch
from assoc_hull.geometry.numeric.tridiagonal import (
    Slots,
    Workspace,
    running_sums,
    slots_of,
    solve_tridiagonal,
)
from assoc_hull.geometry.splines.backend import compiled
from assoc_hull.geometry.splines.loft_rules import (
    OPEN,
    add_curvature,
    curve_name,
    curved_weights,
    is_curved,
    set_known,
    states_of,
)
from assoc_hull.geometry.splines.segments import derivative, evaluate, sample
from assoc_hull.tolerance import Tolerances

__all__ = ["derivative", "evaluate", "loft", "loft_with_signed_zeros", "sample"]

_COINCIDENT = Tolerances().coincident


def loft(data: CurveData, names: Sequence[str] | None = None) -> SplineBatch:
    """Make the cubic composite splines through the points of a batch of curves.

    Parameters
    ----------
    data : CurveData
        Points (n, 3) in m, kinds and end conditions of m curves.
    names : sequence of m str, optional
        What error messages call the curves; "curve i of the batch" otherwise.

    Returns
    -------
    SplineBatch
        Knots (n,) in m, points (n, 3) in m and derivatives (n, 3); frozen.

    Raises
    ------
    TooFewPointsError
        If a curve has fewer than two points.
    CoincidentPointsError
        If neighbouring points of a curve lie closer than 1e-6 m.
    BadInputError
        If a number is not finite, a needed direction is nil, or a kind is unknown.

    Notes
    -----
    Given directions become unit derivatives with respect to chord length. A knuckle side
    or free end takes the derivative that minimises the integral of the squared second
    derivative over its first interval while the direction at the neighbour is kept.
    Source: H.J. Son, H.C. Kim, "hull form parameter modules for performance analysis",
    J. of CAD/CAM (Korea) 13(6), 2008, eq. 1-2.

    Examples
    --------
    >>> line = loft(CurveData.single(np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0]])))
    >>> line.knot
    array([0., 1., 2.])
    >>> line.leave[1]
    array([1., 0., 0.])
    """
    kernels = compiled()
    if kernels is not None:
        spline: SplineBatch | None = kernels.loft_compiled(data)
        if spline is not None:
            return spline
    return _loft(data, names)


def loft_with_signed_zeros(data: CurveData) -> SplineBatch:
    """Loft as once was done: zeros of derivatives had signs, which hung on the company of a curve.

    For files that hold fingerprints of such splines.
    """
    return _loft(data, None, signed_zeros=True)


def _loft(
    data: CurveData, names: Sequence[str] | None, *, signed_zeros: bool = False
) -> SplineBatch:
    """Loft with numpy."""
    slots = slots_of(data.start)
    if slots.shortest < 2:
        raise _too_few(data, names)
    # One block for all results: four smaller ones go back to the operating system each time.
    block = np.empty((9, len(data.xyz)))
    points, leave, arrive = block[:3], block[3:6], block[6:]
    points[:] = data.xyz.T
    block[3:] = 0.0
    with Workspace() as workspace:
        chord, slope = _chords(data, points, slots, names, workspace)
        state = states_of(data, slots)
        set_known(data, slots, state, chord, slope, names, leave, arrive)
        rows = _rows(data, slots, state, chord, slope, workspace)
        _detach_known(rows, state, leave, arrive, workspace)
        solved = solve_tridiagonal(slots, rows, workspace)
        # A sum, not a choice: known rows solve to zero. The sign of that zero hangs on the company
        # of the curve, and shows where a direction is given as -0.0: so no zero keeps its sign.
        for derivatives in (leave, arrive):
            derivatives += solved
            if not signed_zeros:
                derivatives += 0.0
    chord[slots.first] = 0.0
    chord[-1] = 0.0
    return SplineBatch(data.start, running_sums(slots, chord), points.T, leave.T, arrive.T)


def _chords(
    data: CurveData,
    points: FloatArray,
    slots: Slots,
    names: Sequence[str] | None,
    workspace: Workspace,
) -> tuple[FloatArray, FloatArray]:
    """Give length (n + 1,) and direction (3, n + 1) of the chord before each point.

    Entries between two curves are 1 and finite, so that arithmetic may run across them.
    """
    size = points.shape[1]
    chord, slope = np.ones(size + 1), workspace.array(3, size + 1)
    slope[:, 0] = slope[:, size] = 0.0
    step = slope[:, 1:-1]
    np.subtract(points[:, 1:], points[:, :-1], out=step)
    squares = np.multiply(step, step, out=workspace.array(3, size - 1))
    length = chord[1:-1]
    np.add(squares[0], squares[1], out=length)
    length += squares[2]
    np.sqrt(length, out=length)
    chord[slots.first] = 1.0
    if not chord.min() >= _COINCIDENT or not chord.max() < np.inf:
        raise _bad_points(data, chord, names)
    slope /= chord
    return chord, slope


def _rows(
    data: CurveData,
    slots: Slots,
    state: NDArray[np.int8],
    chord: FloatArray,
    slope: FloatArray,
    workspace: Workspace,
) -> FloatArray:
    """Set up the rows of continuous curvature, in the form that `solve_tridiagonal` takes."""
    size = len(state)
    rows = workspace.array(5, size + 1)
    rows[:, size] = 0.0
    before, right, after = rows[0, :size], rows[1:4, :size], rows[4, :size]
    total = chord[:-1] + chord[1:]
    np.divide(chord[1:], total, out=before)
    np.divide(chord[:-1], total, out=after)
    curved = is_curved(state)
    if curved:
        curved_weights(slots, state, before, after)
    np.multiply(before, slope[:, :-1], out=right)
    right += np.multiply(after, slope[:, 1:], out=workspace.array(3, size))
    right *= 1.5
    before *= -0.5
    after *= -0.5
    if curved:
        add_curvature(data, slots, state, chord, right)
    return rows


def _detach_known(
    rows: FloatArray,
    state: NDArray[np.int8],
    leave: FloatArray,
    arrive: FloatArray,
    workspace: Workspace,
) -> None:
    """Move what is known to the right-hand sides of the neighbours; known rows become zero.

    Where nothing is known the derivatives are zero still, and adding zero changes no bit.
    """
    size = len(state)
    open_ = OPEN.take(state)
    product = workspace.array(3, size - 1)
    right = rows[1:4, :size]
    right[:, 1:] += np.multiply(rows[0, 1:size], leave[:, :-1], out=product)
    right[:, :-1] += np.multiply(rows[4, : size - 1], arrive[:, 1:], out=product)
    rows[:, :size] *= open_
    rows[0, 1:size] *= open_[:-1]
    rows[4, : size - 1] *= open_[1:]


def _too_few(data: CurveData, names: Sequence[str] | None) -> TooFewPointsError:
    counts = np.diff(data.start)
    curve = int(np.argmin(counts))
    return TooFewPointsError(curve_name(curve, names), int(counts[curve]))


def _bad_points(data: CurveData, chord: FloatArray, names: Sequence[str] | None) -> Exception:
    broken = np.flatnonzero(~np.isfinite(data.xyz).all(axis=1))
    if len(broken):
        place = int(broken[0])
        return BadInputError(
            f"point {place} at {data.xyz[place].tolist()} is not finite",
            f"in {curve_name(_curve_of(data, place), names)}",
            "correct or delete the point",
        )
    short = np.flatnonzero(chord < _COINCIDENT)
    if not len(short):
        return BadInputError(
            "two points lie too far apart for floating point",
            "in the curve data",
            "give coordinates in metres",
        )
    place = int(short[0])
    x, y, z = data.xyz[place].tolist()
    name = curve_name(_curve_of(data, place), names)
    return CoincidentPointsError(name, (x, y, z), float(chord[place]), _COINCIDENT)


def _curve_of(data: CurveData, place: int) -> int:
    return int(np.searchsorted(data.start, place, side="right")) - 1
