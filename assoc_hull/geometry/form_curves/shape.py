"""What a form-parameter curve is like: least values, energies, length, inflections, loops.

Functions take the 7 vertices of a curve, (7, 2), or of many, (n, 7, 2). A negative least rate of
the abscissa means that a curve folds back. Inflections are exact: between knots x' y'' - y' x'' is
quadratic. The length and the energy of bending are integrated by Gauss's rule.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.polynomial.legendre import leggauss

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.integrals import power_form
from assoc_hull.geometry.numeric.roots import quadratic_roots

__all__ = [
    "ENERGIES",
    "crosses_itself",
    "form_energy",
    "form_inflections",
    "form_length",
    "least_coordinate",
    "least_rate",
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
