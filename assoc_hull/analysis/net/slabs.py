"""Where sections stand, and the boundary curves cut there."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.net.gather import Net, Part
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.numeric.polynomials import horner
from assoc_hull.geometry.numeric.roots import unit_roots
from assoc_hull.geometry.splines.evaluation import evaluate
from assoc_hull.geometry.splines.segments import bernstein, power

__all__ = ["ON_PLANE", "Arc", "arcs", "planes"]

ON_PLANE = 1e-6
"""So near to a section's plane (m) a boundary curve lies in it."""

_SAME = 1e-3
"""Curves in one plane whose ends lie so near (m) are one."""

_KNUCKLE = 1e-9
"""Derivatives that differ by more at a knot have a corner between them."""


@attrs.frozen
class Arc:
    """A part of a curve that bounds the hull between two planes.

    Attributes
    ----------
    part : (int, float, float)
        Curve of the net, and the parameters (m) between which it runs.
    slab : int
        Between the planes `slab` - 1 and `slab`; -1 for an arc that lies on a plane.
    plane : int
        The plane it lies on; -1 for an arc between planes.
    """

    part: Part
    slab: int
    plane: int


def planes(net: Net) -> FloatArray:
    """Give where sections stand, ascending, m."""
    every = np.sort(net.x[np.isfinite(net.x) & ~net.end])
    found: FloatArray = every[np.diff(every, prepend=-np.inf) > ON_PLANE]
    return found


def arcs(net: Net, x: FloatArray) -> list[Arc]:
    """Cut all boundary curves at which the hull ends at the planes; sections are arcs too.

    A section that a transom or another end covers is left out: there the hull ends.
    """
    found: list[Arc] = []
    ends = _covering(net)
    for curve in range(net.batch.count):
        if net.end[curve]:
            found += _cut(net, curve, x)
        elif np.isfinite(net.x[curve]) and not _covered(net, curve, ends):
            found.append(Arc((curve, 0.0, net.length(curve)), -1, _nearest(x, net.x[curve])))
    return found


def _covering(net: Net) -> FloatArray:
    """Give first and last places of the ends in planes across the ship, (k, 2, 3), m."""
    chosen = np.flatnonzero(net.end & np.isfinite(net.x))
    start = net.batch.start
    return np.stack([net.batch.xyz[start[chosen]], net.batch.xyz[start[chosen + 1] - 1]], axis=1)


def _covered(net: Net, curve: int, ends: FloatArray) -> bool:
    """Tell whether a section begins and ends where such an end does."""
    own = net.batch.xyz[[net.batch.start[curve], net.batch.start[curve + 1] - 1]]
    away = [np.abs(ends - each).max(axis=(1, 2), initial=0.0) for each in (own, own[::-1])]
    return bool(len(ends)) and float(np.min(away)) <= _SAME


def _nearest(x: FloatArray, place: float) -> int:
    return int(np.abs(x - place).argmin())


def _cut(net: Net, curve: int, x: FloatArray) -> list[Arc]:
    """Cut one boundary curve at the planes and at its corners."""
    one = net.batch.part(curve, curve + 1)
    edge = _edges(one, x)
    middle = 0.5 * (edge[1:] + edge[:-1])
    place = _x_at(one, np.concatenate([edge, middle]))
    at, between = place[: len(edge)], place[len(edge) :]
    found = []
    for i, (begin, finish) in enumerate(zip(edge[:-1].tolist(), edge[1:].tolist(), strict=True)):
        near = _nearest(x, float(between[i])) if len(x) else -1
        spread = np.abs(np.array([at[i], between[i], at[i + 1]]) - x[near]).max()
        plane = near if spread <= ON_PLANE else -1
        slab = -1 if plane >= 0 else int(np.searchsorted(x, between[i]))
        found.append(Arc((curve, begin, finish), slab, plane))
    return found


def _edges(one: SplineBatch, x: FloatArray) -> FloatArray:
    """Give the parameters at which a curve meets the planes or has a corner, with its ends."""
    cubic, control = power(one)[:, :, 0], bernstein(one)[:, :, 0]
    low, high = control.min(axis=1), control.max(axis=1)
    segment, plane = np.nonzero((low[:, None] <= x) & (high[:, None] >= x))
    shifted = cubic[segment].copy()
    shifted[:, 0] -= x[plane]
    roots = unit_roots(shifted)
    roots = np.where(np.abs(horner(shifted, roots)) <= ON_PLANE, roots, np.nan)
    step = np.diff(one.knot)[segment]
    at = (one.knot[segment][:, None] + roots * step[:, None]).ravel()
    corner = np.flatnonzero(np.abs(one.leave - one.arrive).max(axis=1) > _KNUCKLE)
    on = np.flatnonzero((np.abs(one.xyz[:, 0][:, None] - x) <= ON_PLANE).any(axis=1))
    fixed = np.unique(np.concatenate([one.knot[[0, -1]], one.knot[corner], one.knot[on]]))
    at = at[np.isfinite(at)]
    apart = np.abs(at[:, None] - fixed).min(axis=1) > 10.0 * ON_PLANE
    every = np.sort(np.concatenate([fixed, at[apart]]))
    edges: FloatArray = every[np.diff(every, prepend=-np.inf) > 10.0 * ON_PLANE]
    return edges


def _x_at(one: SplineBatch, t: FloatArray) -> FloatArray:
    found: FloatArray = evaluate(one, np.zeros(len(t), np.int64), t)[:, 0]
    return found
