"""The directions of chord splines at their points: Newton's rule on one banded system.

On chord i, of length l and direction th, let m0 and m1 be the slopes of the spline to the chord
at its ends. Moments over the stiffness are Ms = -(4 m0 + 2 m1) / l at its start and
Me = (2 m0 + 4 m1) / l at its end. At an inner point the moments of both chords agree, or the
curvatures, Me / (1 + m1^2)^1.5 and Ms / (1 + m0^2)^1.5. A free end has no moment, a clamped one
a given direction. The slopes are tangents of angles, so this is not linear, but each equation
knows its neighbours only. Many splines are solved as one system: nothing couples them, and
each has the same bits as alone.

Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK, eqs 1 to 7.
"""

from __future__ import annotations

from typing import Literal

import attrs
import numpy as np
from scipy.linalg import LinAlgError, solve_banded

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["Chords", "Mode", "slopes", "solve_directions"]

Mode = Literal["moment", "curvature"]

_MOST_STEP = 0.3  # rad: the most that a direction turns in one step
_AGREED = 1e-13  # rad: a step below this ends the search
_MOST_STEPS = 50


@attrs.frozen(eq=False)
class Chords:
    """Chords of many splines, one behind the other.

    Attributes
    ----------
    start : (m + 1,) int
        Where the points of each spline begin; the last entry is n.
    owner : (n,) int
        The spline that each point belongs to.
    begin : (c,) int
        The point at which each chord begins; it ends at the next.
    length : (c,), m
        Of the chords.
    angle : (c,), rad
        Their directions, unwrapped along each spline.
    clamp : (m, 2), rad
        Directions given at both ends; nan where an end is free.
    """

    start: IntArray
    owner: IntArray
    begin: IntArray
    length: FloatArray
    angle: FloatArray
    clamp: FloatArray

    @property
    def ends(self) -> tuple[IntArray, IntArray]:
        """First and last point of each spline, (m,) each."""
        return self.start[:-1], self.start[1:] - 1


def slopes(chords: Chords, phi: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give the slopes to each chord at its start and end, (c,) each, for directions `phi` (n,)."""
    at = chords.begin
    return np.tan(phi[at] - chords.angle), np.tan(phi[at + 1] - chords.angle)


def solve_directions(chords: Chords, mode: Mode) -> FloatArray:
    """Find the directions at all points, (n,), rad.

    Parameters
    ----------
    chords : Chords
        Of one or many splines.
    mode : "moment" or "curvature"
        What is continuous at inner points.

    Raises
    ------
    GeometryError
        ``"spline: Newton did not converge"``.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.chord_spline_solve import Chords, solve_directions
    >>> free = np.full((1, 2), np.nan)
    >>> zero = np.zeros(3, int)
    >>> up_and_down = Chords(
    ...     np.array([0, 3]), zero, np.array([0, 1]), np.ones(2), np.array([0.2, -0.2]), free
    ... )
    >>> phi = solve_directions(up_and_down, "curvature")
    >>> float(phi[1]) + 0.0, bool(phi[0] > 0.2)
    (0.0, True)
    """
    phi = _first_guess(chords)
    alive = np.ones(len(chords.start) - 1, np.bool_)
    scale = np.maximum(1.0, np.maximum.reduceat(np.abs(phi), chords.start[:-1]))
    for _ in range(_MOST_STEPS):
        step = _step(chords, phi, mode)
        size = np.maximum.reduceat(np.abs(step), chords.start[:-1])
        # A spline that has settled stays: its bits must not depend on its neighbours.
        factor = np.where(alive, np.minimum(1.0, _MOST_STEP / np.maximum(size, _AGREED)), 0.0)
        phi = phi + factor[chords.owner] * step
        alive &= ~(size <= _AGREED * scale)
        if not alive.any():
            return phi
    raise _astray(int(np.argmax(alive)))


def _astray(spline: int) -> GeometryError:
    return GeometryError(
        "spline: Newton did not converge", "give points closer together, or other end directions",
        {"spline": spline},
    )  # fmt: skip


def _first_guess(chords: Chords) -> FloatArray:
    """Give the directions of circles through three points, roughly; ends mirror theirs."""
    first, last = chords.ends
    phi = np.zeros(len(chords.owner))
    inner = _inner(chords)
    before, after = inner - chords.owner[inner] - 1, inner - chords.owner[inner]
    length, angle = chords.length, chords.angle
    phi[inner] = (length[after] * angle[before] + length[before] * angle[after]) / (
        length[before] + length[after]
    )
    # Of a spline of one chord both ends lie on it: their neighbour is no inner point.
    opening, closing = _end_chords(chords)
    lone = last - first == 1
    phi[first] = np.where(lone, angle[opening], 2.0 * angle[opening] - phi[first + 1])
    phi[last] = np.where(lone, angle[closing], 2.0 * angle[closing] - phi[last - 1])
    phi[first] = np.where(np.isnan(chords.clamp[:, 0]), phi[first], chords.clamp[:, 0])
    phi[last] = np.where(np.isnan(chords.clamp[:, 1]), phi[last], chords.clamp[:, 1])
    return phi


def _inner(chords: Chords) -> IntArray:
    is_end = np.zeros(len(chords.owner), np.bool_)
    is_end[chords.start[:-1]] = True
    is_end[chords.start[1:] - 1] = True
    return np.flatnonzero(~is_end)


def _end_chords(chords: Chords) -> tuple[IntArray, IntArray]:
    """Give the first and the last chord of each spline."""
    first, last = chords.ends
    number = np.arange(len(first))
    return first - number, last - number - 1


def _step(chords: Chords, phi: FloatArray, mode: Mode) -> FloatArray:
    """Give one step of Newton's rule, (n,), rad."""
    rest, table = _equations(chords, phi, mode)
    try:
        with np.errstate(all="ignore"):
            found = np.asarray(solve_banded((1, 1), table, -rest, check_finite=False))
    except LinAlgError:
        raise _astray(0) from None
    if not np.isfinite(found).all():
        raise _astray(int(chords.owner[np.argmin(np.isfinite(found))]))
    return found


def _equations(chords: Chords, phi: FloatArray, mode: Mode) -> tuple[FloatArray, FloatArray]:
    """Give what is left of each equation, (n,), and its derivatives as bands, (3, n)."""
    rest, table = np.zeros(len(phi)), np.zeros((3, len(phi)))
    m0, m1 = slopes(chords, phi)
    turn0, turn1 = 1.0 + m0 * m0, 1.0 + m1 * m1
    start, by0_start, by1_start = _bend(m0, m1, chords.length, mode)
    # Seen from its end a chord bends the other way.
    end, by1_end, by0_end = (-each for each in _bend(m1, m0, chords.length, mode))
    inner = _inner(chords)
    before, after = inner - chords.owner[inner] - 1, inner - chords.owner[inner]
    rest[inner] = end[before] - start[after]
    table[2, inner - 1] = (by0_end * turn0)[before]
    table[1, inner] = (by1_end * turn1)[before] - (by0_start * turn0)[after]
    table[0, inner + 1] = -(by1_start * turn1)[after]
    first, last = chords.ends
    opening, closing = _end_chords(chords)
    free = np.isnan(chords.clamp)
    rest[first] = np.where(free[:, 0], 2.0 * m0[opening] + m1[opening], 0.0)
    table[1, first] = np.where(free[:, 0], 2.0 * turn0[opening], 1.0)
    table[0, first + 1] = np.where(free[:, 0], turn1[opening], 0.0)
    rest[last] = np.where(free[:, 1], m0[closing] + 2.0 * m1[closing], 0.0)
    table[1, last] = np.where(free[:, 1], 2.0 * turn1[closing], 1.0)
    table[2, last - 1] = np.where(free[:, 1], turn0[closing], 0.0)
    return rest, table


def _bend(
    near: FloatArray, far: FloatArray, length: FloatArray, mode: Mode
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give moment or curvature at an end of chords, and its derivatives by both slopes."""
    moment = -(4.0 * near + 2.0 * far) / length
    if mode == "moment":
        return moment, -4.0 / length, -2.0 / length
    square = 1.0 + near * near
    shrink = square**-1.5
    by_near = -4.0 / length * shrink - 3.0 * near * moment * shrink / square
    return moment * shrink, by_near, -2.0 / length * shrink
