"""Tangent lengths of form-parameter curves where none are given.

How long the tangent vectors at the ends are decides how full a curve is near its ends, and is
nothing one could read off a ship. The *pace* f is the tangent by a quarter of the chord: 1 is that
of a straight line. By default it is 1/2, which is robust. Else the paces are those of the fairest
curve: of least energy, with area and centroid held, f within `SLOWEST` and `FASTEST`, and the
abscissa never slower than 2 % of an even pace. Without a lower bound hollow ends would draw the
tangent to zero, and the curvature beyond all bounds.

The least is searched for on nodes of ln f, from the best of 8 by 8 in windows of 7 by 7 that
follow the best node and shrink once it lies inside. All curves and all nodes are one batch.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.form_curves.curve import FormEnd
>>> from assoc_hull.geometry.form_curves.tangents import fairest_tangents
>>> start, finish = FormEnd.of(0.0, 0.0, 0.0), FormEnd.of(4.0, 0.0, 0.0)
>>> fairest_tangents(start, finish).tangents.round(6).tolist()
[[1.0, 1.0]]
"""

from __future__ import annotations

import math

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.curve import FormEnd, form_vertices
from assoc_hull.geometry.form_curves.shape import form_energy, least_rate

__all__ = [
    "FASTEST",
    "SLOWEST",
    "FairTangents",
    "chord_lengths",
    "fairest_tangents",
    "usual_tangents",
]

SLOWEST, FASTEST = 0.15, 1.6
"""Bounds of a pace."""

_USUAL = 0.5
_NODES = (0.15, 0.2, 0.35, 0.5, 0.75, 1.0, 1.3, 1.6)
_LEAST_PACE, _PENALTY = 0.02, 1e3
_HALF = 3  # nodes of a window to each side of its middle
_WINDOW, _SMALLEST = 0.4, 1e-8
_ROUNDS = 120


@attrs.frozen(eq=False)
class FairTangents:
    """Tangents of the fairest curves.

    Attributes
    ----------
    tangents : (n, 2)
        At start and finish, in the unit of the plane; nan where no curve was found.
    energy : (n,)
        Of the curves.
    at_bound : (n, 2) bool
        Whether the pace is at a bound.
    """

    tangents: FloatArray
    energy: FloatArray
    at_bound: NDArray[np.bool_]


def chord_lengths(start: FormEnd, finish: FormEnd) -> FloatArray:
    """Give the distances of both ends, (n,)."""
    x, y = finish.x - start.x, finish.y - start.y
    return np.asarray(np.sqrt(x * x + y * y))


def usual_tangents(start: FormEnd, finish: FormEnd) -> FloatArray:
    """Give tangents of an eighth of the chord, (n, 2)."""
    return np.asarray(np.repeat(_USUAL * chord_lengths(start, finish)[:, None] / 4.0, 2, axis=1))


@attrs.frozen(eq=False)
class _Task:
    """Curves whose tangents are looked for."""

    start: FormEnd
    finish: FormEnd
    area: FloatArray
    centroid: FloatArray
    kind: str

    def cost(self, pace: FloatArray) -> FloatArray:
        """Give the energy and the penalty of paces, (n, k, 2): (n, k), infinite if no curve."""
        count = pace.shape[1]
        even = np.repeat(chord_lengths(self.start, self.finish) / 4.0, count)
        each = [np.repeat(part, count) for part in (self.area, self.centroid)]
        start = _with(self.start, count, even * pace[:, :, 0].reshape(-1))
        finish = _with(self.finish, count, even * pace[:, :, 1].reshape(-1))
        vertices = form_vertices(start, finish, *each)
        width = np.abs(finish.x - start.x) / 4.0
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            lack = _LEAST_PACE - np.where(width > 0.0, least_rate(vertices, 0) / width, np.inf)
            # E2 and E3 are squares of lengths, J is a number: so is what is added to it.
            scale = 1.0 if self.kind == "J" else 16.0 * even * even
            cost = form_energy(vertices, self.kind) + scale * _PENALTY * np.maximum(lack, 0.0) ** 2
        return np.where(np.isfinite(cost), cost, np.inf).reshape(-1, count)


def _with(end: FormEnd, count: int, tangent: FloatArray) -> FormEnd:
    parts = (end.x, end.y, end.angle, end.curvature)
    x, y, angle, curvature = (np.repeat(part, count) for part in parts)
    return FormEnd(x, y, angle, curvature, tangent, np.repeat(end.stretch, count))


def fairest_tangents(
    start: FormEnd,
    finish: FormEnd,
    area: FloatArray | None = None,
    centroid: FloatArray | None = None,
    kind: str = "E3",
    *,
    bounds: tuple[float, float] = (SLOWEST, FASTEST),
) -> FairTangents:
    """Find the tangents of the fairest curves.

    Parameters
    ----------
    start, finish : FormEnd
        The ends; their tangents are not looked at.
    area, centroid : (n,) or None
        As `form_vertices` takes them.
    kind : str
        Energy that is to be least: one of `assoc_hull.geometry.form_curves.shape.ENERGIES`.
    bounds : (float, float)
        Of the paces.

    Returns
    -------
    FairTangents
        The energy is flat about its least: tangents are good to some 1e-6.
    """
    none = np.full(len(start.x), np.nan)
    given = (none if area is None else area, none if centroid is None else centroid)
    task = _Task(start, finish, *given, kind)
    low, high = (math.log(each) for each in bounds)
    nodes = np.clip([math.log(each) for each in _NODES], low, high)
    grid = np.stack(np.meshgrid(nodes, nodes, indexing="ij"), axis=-1).reshape(1, -1, 2)
    best, least, _ = _best(task, np.repeat(grid, len(none), axis=0))
    half, steps = np.full(len(none), _WINDOW), np.arange(-_HALF, _HALF + 1.0) / _HALF
    window = np.stack(np.meshgrid(steps, steps, indexing="ij"), axis=-1).reshape(1, -1, 2)
    for _ in range(_ROUNDS):
        around = best[:, None] + half[:, None, None] * window
        at, found, place = _best(task, np.clip(around, low, high))
        # A curve that has settled stays: it must not depend on the others.
        better = (found < least) & (half >= _SMALLEST)
        best, least = np.where(better[:, None], at, best), np.where(better, found, least)
        outside = better & (np.abs(window[0, place]).max(axis=1) == 1.0)
        half = np.where(outside, half, 0.5 * half)
        if (half < _SMALLEST).all():
            break
    pace = _exponential(best)
    bound = (best <= low + 1e-7) | (best >= high - 1e-7)
    lost = ~np.isfinite(least)
    tangents = np.where(lost[:, None], np.nan, pace * chord_lengths(start, finish)[:, None] / 4.0)
    return FairTangents(tangents, least, bound & ~lost[:, None])


def _best(task: _Task, nodes: FloatArray) -> tuple[FloatArray, FloatArray, NDArray[np.intp]]:
    """Give the best of the nodes of each curve, (n, k, 2) in ln f, its cost and its number."""
    cost = task.cost(_exponential(nodes))
    place = cost.argmin(axis=1)
    rows = np.arange(len(nodes))
    return nodes[rows, place], cost[rows, place], place


def _exponential(values: FloatArray) -> FloatArray:
    """Give e to the power; numpy's own may differ with the machine in the last bit."""
    flat = [math.exp(each) for each in values.ravel().tolist()]
    return np.array(flat).reshape(values.shape)
