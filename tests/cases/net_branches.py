"""The branches of a net as it stands: where a moving plane meets its lines, every millimetre.

A line that is shifted changes no shape of another by more than the tolerance of shifts. So
where its plane meets the others can be followed beforehand, in steps of 1 mm, on their
splines alone: roots come from scipy's polynomials, and the kernel is not asked. A meeting
slides along the stretch of its line on which the plane's coordinate rises or falls; where
that turns, two stretches meet, and a pair is born or dies.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PPoly

import assoc_hull as ah
from tests.cases.true_branches import Branch
from tests.independent import polynomial

__all__ = ["STEP", "branches_of_net"]

Floats = NDArray[np.float64]

STEP = 1e-3
"""The path is followed in steps of this (m); what goes back by less is no turn."""

_HALVINGS = 45
"""From the length of the longest stretch to less than a nanometre."""


def branches_of_net(
    hull: ah.Hull, group: str, axis: int, low: float, high: float
) -> dict[str, list[Branch]]:
    """Give the branches of the lines that a plane across an axis meets between two places (m).

    Lines of the group whose plane moves, and boundary curves along it, have none.
    """
    found: dict[str, list[Branch]] = {}
    for name, line in hull.lines.items():
        plane = line.plane
        along = plane is not None and abs(float(plane.normal[axis])) == 1.0
        if line.group.name == group or along:
            continue
        found[name] = []
        for curve in line.curves:
            for at, place in _paths(polynomial(curve.spline), axis, low, high):
                number = len(found[name]) + 1
                found[name].append(Branch(f"{name} #{number}", number, at, place))
    return found


def _paths(curve: PPoly, axis: int, low: float, high: float) -> list[tuple[Floats, Floats]]:
    """Follow the places of a curve at every millimetre of a coordinate, stretch by stretch."""
    height = PPoly(curve.c[:, :, axis], curve.x)
    still = height.derivative().roots(discontinuity=True, extrapolate=False)
    t = np.unique(np.concatenate([curve.x, still[np.isfinite(still)]]))
    found = []
    for first, last in pairwise(_turns(height(t).tolist())):
        begin, end = float(height(t[first])), float(height(t[last]))
        bottom, top = min(begin, end), max(begin, end)
        if top < low or bottom > high:
            continue
        inner = np.arange(np.ceil(max(bottom, low - 1.0) / STEP), min(top, high + 1.0) / STEP)
        at = np.concatenate([[bottom], (STEP * inner)[STEP * inner > bottom], [top]])
        where = _roots(height, t[first], t[last], at, begin < end)
        found.append((at, np.asarray(curve(where), np.float64)))
    return found


def _roots(height: PPoly, first: float, last: float, at: Floats, rising: bool) -> Floats:
    """Halve the stretch until it is clear where its height is what is asked for."""
    low, high = np.full(len(at), first), np.full(len(at), last)
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        before = (height(middle) < at) == rising
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    found: Floats = 0.5 * (low + high)
    return found


def _turns(height: list[float]) -> list[int]:
    """Give where a height turns for more than a step, with its first and last place."""
    kept, best, sense = [0], 0, 0.0
    for i, each in enumerate(height):
        step = each - height[best]
        if step * sense > 0.0 or (not sense and abs(step) > STEP):
            best, sense = i, step
        elif sense and abs(step) > STEP:
            kept.append(best)
            best, sense = i, step
    return [*kept, best] if best != kept[-1] else kept
