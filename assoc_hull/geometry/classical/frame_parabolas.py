"""How far the pieces of a frame bend between given points: means of parabolas with neighbours.

Over each chord stands q = K/2 p (p - l), p along the chord of length l, q to its left. A parabola
through both ends and a neighbour at (p_n, q_n) has K = 2 q_n / (p_n (p_n - l)); the mean of the
two neighbours is taken, or the only one at an end, or with a given direction at the start
K = -2 tan(alpha) / l, alpha from the chord to it. Source: Kim & Chang, "Some Representations of
Ship Hulls by Mathematical Method for Design and Production", J. SNAK.

The curve passes all points and turns sharply at each of them: a frame is corrugated, however
little, and never fair.

Examples
--------
>>> from assoc_hull.geometry.classical.frame_parabolas import run_bends
>>> run = [(7.5, 0), (11, 0.8), (13.5, 2.5), (14.8, 5), (15, 9), (15, 14)]
>>> run_bends(run)[0].round(9).tolist()
[0.121976048, 0.159228229, 0.169230056, 0.075314789, 0.011111111]
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import figure, finite, wrap
from assoc_hull.geometry.classical.quadratics import Quadratics
from assoc_hull.geometry.curves import FloatArray

__all__ = ["run_bends", "tangent_jumps"]


def run_bends(
    points: ArrayLike, start_angle: float | None = None, name: str = "frame"
) -> tuple[FloatArray, tuple[str, ...]]:
    """Give the bend of each piece of a run.

    Parameters
    ----------
    points : (n + 1, 2) array_like, m
        From one knuckle, or end, to the next.
    start_angle : float or None, rad
        Direction at the start, if it is known.
    name : str
        What it is called in messages.

    Returns
    -------
    bend : (n,), 1/m
        K of each; 0 where nothing tells.
    notes : tuple of str
        Neighbours that were left out, as they lie beside the chord.

    Raises
    ------
    GeometryError
        Fewer than two points, or two that coincide.
    """
    place = finite(points, name, (None, 2))
    if len(place) < 2:
        what = f"{name}: fewer than 2 points on the section"
        raise GeometryError(what, "give waterlines that reach it", {"points": len(place)})
    step = np.diff(place, axis=0)
    length = np.hypot(*step.T)
    if (length == 0.0).any():
        row = int(np.argmax(length == 0.0))
        what = f"{name}: points {row} and {row + 1} coincide"
        raise GeometryError(what, "leave one of them out", {"row": row})
    along = step / length[:, None]
    before, after = np.full((2, len(length)), np.nan)
    before[1:], low = _with_neighbour(place[:-2], place[1:-1], along[1:], length[1:], ahead=False)
    after[:-1], high = _with_neighbour(place[2:], place[:-2], along[:-1], length[:-1], ahead=True)
    if start_angle is not None:
        lean = float(
            wrap(float(finite(start_angle, name, ())) - np.arctan2(step[0, 1], step[0, 0]))
        )
        if abs(lean) < 0.5 * np.pi:
            before[0] = -2.0 * np.tan(lean) / length[0]
    both = np.stack([before, after])
    count = np.isfinite(both).sum(axis=0)
    bend = np.where(count > 0, np.nansum(both, axis=0) / np.maximum(count, 1), 0.0)
    dropped = [*(np.flatnonzero(low) + 1).tolist(), *np.flatnonzero(high).tolist()]
    notes = tuple(
        f"{name}: a neighbour of the piece from ({figure(place[i, 0])}, {figure(place[i, 1])}) "
        "lies beside its chord and was left out"
        for i in sorted(dropped)
    )
    return bend, notes


def _with_neighbour(
    neighbour: FloatArray, foot: FloatArray, along: FloatArray, length: FloatArray, *, ahead: bool
) -> tuple[FloatArray, np.typing.NDArray[np.bool_]]:
    """Give K by a neighbour of each chord, nan where it does not lie beyond it; and where not."""
    away = neighbour - foot
    p = (away * along).sum(axis=1)
    q = along[:, 0] * away[:, 1] - along[:, 1] * away[:, 0]
    beyond = p > length if ahead else p < 0.0
    with np.errstate(divide="ignore", invalid="ignore"):
        bend = 2.0 * q / (p * (p - length))
    return np.where(beyond, bend, np.nan), ~beyond


def tangent_jumps(pieces: Quadratics) -> FloatArray:
    """Give by how much the direction turns at each inner point (rad), (n - 1,).

    Examples
    --------
    >>> from assoc_hull.geometry.classical.frame_parabolas import run_bends, tangent_jumps
    >>> from assoc_hull.geometry.classical.quadratics import Quadratics
    >>> run = [(7.5, 0), (11, 0.8), (13.5, 2.5), (14.8, 5), (15, 9), (15, 14)]
    >>> jumps = tangent_jumps(Quadratics.over(run, run_bends(run)[0]))
    >>> round(float(abs(jumps).max()), 9)
    0.127501846
    """
    leave, arrive = pieces.angles()
    return wrap(leave[1:] - arrive[:-1])
