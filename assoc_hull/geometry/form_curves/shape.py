"""What a form-parameter curve is like, and the tangent lengths that make it fairest.

Functions take the 7 vertices of a curve, (7, 2), or of many, (n, 7, 2). A negative least rate of
the abscissa means that a curve folds back. Inflections are exact: between knots x' y'' - y' x'' is
quadratic. The length and the energy of bending are integrated by Gauss's rule.

Tangent lengths of form-parameter curves where none are given.

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
>>> from assoc_hull.geometry.form_curves.shape import fairest_tangents
>>> start, finish = FormEnd.of(0.0, 0.0, 0.0), FormEnd.of(4.0, 0.0, 0.0)
>>> fairest_tangents(start, finish).tangents.round(6).tolist()
[[1.0, 1.0]]
"""

from __future__ import annotations

import math
from typing import Literal

import attrs
import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.curve import FormEnd, form_vertices
from assoc_hull.geometry.form_curves.integrals import power_form
from assoc_hull.geometry.numeric.polynomials import quadratic_roots

__all__ = [
    "ENERGIES",
    "FASTEST",
    "SLOWEST",
    "FairTangents",
    "chord_lengths",
    "crosses_itself",
    "fairest_tangents",
    "form_energy",
    "form_inflections",
    "form_length",
    "least_coordinate",
    "least_rate",
    "usual_tangents",
]


def least_rate(vertices: FloatArray, axis: int) -> FloatArray:
    """Give the least derivative by t of the abscissa (axis 0) or ordinate (1) of curves, (n,)."""
    power = power_form(vertices)[..., axis]
    a, b, c = power[..., 1], 2.0 * power[..., 2], 3.0 * power[..., 3]
    with np.errstate(divide="ignore", invalid="ignore"):
        turn = -b / (2.0 * c)
    turn = np.where((turn > 0.0) & (turn < 1.0), turn, 0.0)
    found = np.minimum(np.minimum(a, a + b + c), a + turn * (b + turn * c))
    return np.asarray(found.min(axis=1))


def least_coordinate(vertices: FloatArray, axis: int) -> FloatArray:
    """Give the least value of a coordinate along curves; arguments as of `least_rate`."""
    power = power_form(vertices)[..., axis]
    a, b, c = power[..., 1], 2.0 * power[..., 2], 3.0 * power[..., 3]
    found = np.minimum(power[..., 0], power.sum(axis=-1))
    with np.errstate(divide="ignore", invalid="ignore"):
        half = -0.5 * (b + np.copysign(np.sqrt(b * b - 4.0 * a * c), b))
        for root in (half / c, a / half):
            u = np.where((root > 0.0) & (root < 1.0), root, 0.0)
            at = power[..., 0] + u * (power[..., 1] + u * (power[..., 2] + u * power[..., 3]))
            found = np.minimum(found, at)
    return np.asarray(found.min(axis=1))


# --------------------------------------------------------------------------------------
# Energies, length, inflections, loops.

ENERGIES: tuple[Literal["E2", "E3", "J"], ...] = ("E2", "E3", "J")
"""int |Q''|^2 dt, int |Q'''|^2 dt, and length times int curvature^2 ds."""

_NODES, _WEIGHTS = (0.5 * each for each in leggauss(16))
_STRAIGHT = 1e-9
"""rad: a stretch that turns less is straight."""

_STEPS = 48
"""Chords of a segment, in looking for loops."""


def _total(parts: FloatArray) -> FloatArray:
    """Add the four segments in their order."""
    return np.asarray(((parts[:, 0] + parts[:, 1]) + parts[:, 2]) + parts[:, 3])


def form_energy(vertices: FloatArray, kind: str = "E3") -> FloatArray:
    """Give the energies of curves, (n,), of a kind in `ENERGIES`."""
    if kind == "J":
        return _bending(vertices)
    power = power_form(vertices)
    if kind == "E3":
        jump = 6.0 * power[:, :, 3]
        return _total(jump[..., 0] * jump[..., 0] + jump[..., 1] * jump[..., 1])
    first = 2.0 * power[:, :, 2]
    last = first + 6.0 * power[:, :, 3]
    square = first * first + first * last + last * last
    return _total((square[..., 0] + square[..., 1]) / 3.0)


def _bending(vertices: FloatArray) -> FloatArray:
    power = power_form(vertices)
    length, bent = (np.zeros(power.shape[:2]) for _ in range(2))
    for node, weight in zip((_NODES + 0.5).tolist(), _WEIGHTS.tolist(), strict=True):
        pace, turn = _pace(power, node)
        with np.errstate(divide="ignore", invalid="ignore"):
            length += weight * pace
            bent += weight * (turn * turn) / (pace * pace * pace * pace * pace)
    return np.asarray(_total(length) * _total(bent))


def _pace(power: FloatArray, node: float) -> tuple[FloatArray, FloatArray]:
    """Give |Q'| and x' y'' - y' x'' in all segments at a fraction of them."""
    first = power[:, :, 1] + node * (2.0 * power[:, :, 2] + 3.0 * node * power[:, :, 3])
    second = 2.0 * power[:, :, 2] + 6.0 * node * power[:, :, 3]
    pace = np.sqrt(first[..., 0] * first[..., 0] + first[..., 1] * first[..., 1])
    return pace, first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]


def form_length(vertices: FloatArray) -> FloatArray:
    """Give the lengths of curves, (n,)."""
    power = power_form(vertices)
    length = np.zeros(power.shape[:2])
    for node, weight in zip((_NODES + 0.5).tolist(), _WEIGHTS.tolist(), strict=True):
        length += weight * _pace(power, node)[0]
    return _total(length)


def form_inflections(vertices: FloatArray) -> tuple[float, ...]:
    """Give where the curvature of a curve (7, 2) changes its sign: parameters t, rising.

    A stretch that turns by less than 1e-9 rad counts as straight.
    """
    power = power_form(vertices[None])
    c1, c2, c3 = (power[0, :, each] for each in (1, 2, 3))
    bend = [2.0 * _cross(c1, c2), 6.0 * _cross(c1, c3), 6.0 * _cross(c2, c3)]
    roots = quadratic_roots(*bend)
    inside = np.where((roots > 0.0) & (roots < 1.0), roots, 0.0)
    cuts = np.unique([*(inside + np.arange(4.0)[:, None]).ravel().tolist(), 4.0])
    found, sign = list[float](), 0.0
    for low, high in zip(cuts[:-1].tolist(), cuts[1:].tolist(), strict=True):
        turn = _turn(power[0], bend, low, high)
        if abs(turn) > _STRAIGHT:
            if sign * turn < 0.0:
                found.append(low)
            sign = turn
    return tuple(found)


def _cross(one: FloatArray, other: FloatArray) -> FloatArray:
    return np.asarray(one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0])


def _turn(power: FloatArray, bend: list[FloatArray], low: float, high: float) -> float:
    """Give by how much the tangent turns in a stretch of one segment, nearly."""
    segment = min(int(low), 3)
    u = 0.5 * (low + high) - segment
    first = power[segment, 1] + u * (2.0 * power[segment, 2] + 3.0 * u * power[segment, 3])
    square = float(first[0] * first[0] + first[1] * first[1])
    turn = float(bend[0][segment] + u * (bend[1][segment] + u * bend[2][segment]))
    return turn / square * (high - low) if square else 0.0


def crosses_itself(vertices: FloatArray) -> bool:
    """Say whether a curve, (7, 2), intersects itself.

    Where all its tangents lie in a half plane it cannot; else chords are compared, 48 a segment.
    """
    hodograph = np.diff(vertices, axis=0)
    if (hodograph @ (vertices[-1] - vertices[0]) > 0.0).all():
        return False
    u = np.arange(_STEPS + 1) / _STEPS
    power = power_form(vertices[None])[0]
    points = np.concatenate([
        sum((power[s, each] * u[:-1, None] ** each for each in range(4)), np.zeros(2))
        for s in range(4)
    ])  # fmt: skip
    points = np.concatenate([points, power[3].sum(axis=0)[None]])
    return _chords_intersect(points)


def _chords_intersect(points: FloatArray) -> bool:
    """Say whether two chords of a polyline intersect that are no neighbours."""
    start, way = points[:-1], np.diff(points, axis=0)
    apart = start[None] - start[:, None]
    cross = _cross(way[:, None], way[None])
    with np.errstate(divide="ignore", invalid="ignore"):
        s, t = _cross(apart, way[None]) / cross, _cross(apart, way[:, None]) / cross
    far = np.abs(np.subtract.outer(np.arange(len(way)), np.arange(len(way)))) > 1
    return bool((far & (s >= 0.0) & (s <= 1.0) & (t >= 0.0) & (t <= 1.0)).any())


SLOWEST, FASTEST = 0.15, 1.6
"""Bounds of a pace."""

_USUAL = 0.5
_TANGENT_NODES = (0.15, 0.2, 0.35, 0.5, 0.75, 1.0, 1.3, 1.6)
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
    nodes = np.clip([math.log(each) for each in _TANGENT_NODES], low, high)
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
