"""The 207,000 TDW bulk carrier below its design waterline, integrated from its formulas.

Waterline by waterline, each along x by Gauss's rule between all places where a formula changes;
a substitution makes both ends of every interval smooth. No net, no loft, no section of either.
"""

from __future__ import annotations

from functools import cache

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.shipped import bulk_carrier_207k_form as form

__all__ = [
    "Sums", "Waterline", "area_of", "between", "flotation_of", "inertias", "volumes",
]  # fmt: skip

DRAUGHT = form.DRAUGHT
PLACES = (form.BOSS_FORE, 10.0, 24.0, 150.0, form.KEEL_FORE)
"""Where formulas change along x."""

LEVELS = (0.0, form.BILGE, 3.0, form.SHAFT - form.BOSS, form.SHAFT, form.SHAFT + form.BOSS,
          form.NOSE[1], form.CORNER, 12.0, 16.0, form.DRAUGHT)  # fmt: skip

NODES, WEIGHTS = np.polynomial.legendre.leggauss(32)
STEP = 0.5 * (1.0 + NODES)
PLACE = STEP**3 * (10.0 - 15.0 * STEP + 6.0 * STEP**2)
RATE = 15.0 * STEP**2 * (1.0 - STEP) ** 2 * WEIGHTS
"""Nodes and weights between 0 and 1: both ends are approached with nil slope and curvature."""


@attrs.frozen
class Waterline:
    """Nodes along a waterline: x, half-breadth and dx."""

    x: FloatArray
    y: FloatArray
    dx: FloatArray


def between(breaks: list[float]) -> tuple[FloatArray, FloatArray]:
    """Nodes and weights in all intervals between sorted places."""
    low, size = np.array(breaks[:-1])[:, None], np.diff(breaks)[:, None]
    return (low + size * PLACE).ravel(), (size * RATE).ravel()


@cache
def waterline(z: float, aft: float = -np.inf, fore: float = np.inf) -> Waterline:
    """The part of the waterline at a height that lies between two places."""
    low, high = max(aft, form.aft_end(z)[0]), min(fore, float(form.fore_end(z)))
    places = {*PLACES, float(form.aft_shoulder(z)), float(form.fore_shoulder(z))}
    inner = sorted(each for each in places if low < each < high)
    x, dx = between([low, *inner, high] if low < high else [low, low])
    return Waterline(x, form.carrier_half_breadth(x, np.full_like(x, z)), dx)


@attrs.frozen
class Sums:
    """Volume and its centroid, or an area and its centroid (no z)."""

    amount: float
    x: float
    z: float = 0.0


def flotation_of(aft: float = -np.inf, fore: float = np.inf) -> Sums:
    """The waterplane between two places; m2, m."""
    part = waterline(DRAUGHT, aft, fore)
    area = 2.0 * float(part.y @ part.dx)
    return Sums(area, 2.0 * float((part.x * part.y) @ part.dx) / area)


def inertias() -> tuple[float, float]:
    """Of the waterplane across the centre line, and along about its centroid; m4."""
    line, plane = waterline(DRAUGHT), flotation_of()
    across = 2.0 / 3.0 * float(line.y**3 @ line.dx)
    return across, 2.0 * float(((line.x - plane.x) ** 2 * line.y) @ line.dx)


def volumes(aft: float = -np.inf, fore: float = np.inf) -> Sums:
    """The ship below the design waterline between two places; m3, m."""
    z, dz = between(list(LEVELS))
    parts = [waterline(height, aft, fore) for height in z.tolist()]
    area = np.array([2.0 * part.y @ part.dx for part in parts])
    moment = np.array([2.0 * (part.x * part.y) @ part.dx for part in parts])
    volume = float(area @ dz)
    return Sums(volume, float(moment @ dz) / volume, float((area * z) @ dz) / volume)


@cache
def area_of(x: float) -> float:
    """The section at a place below the design waterline; m2."""
    total = 0.0
    for low, high in form.height_ranges(x):
        top = min(high, DRAUGHT)
        side = form.side_height(x)
        levels = {*LEVELS, 0.0 if side is None else side}
        z, dz = between([low, *sorted(each for each in levels if low < each < top), top])
        total += (
            2.0 * float(form.carrier_half_breadth(np.full_like(z, x), z) @ dz) if top > low else 0.0
        )
    return total
