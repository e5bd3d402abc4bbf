"""The sections of a hull below the draught, as sums: for areas, and for what a field does to them.

A section is a set of places with weights dz, so that the sum of y dz is the area of its half and
that of y z dz its moment about the base line. Between knots places are those of Gauss, with which
both sums are exact for the drawn curves.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.splines.evaluation import derivative, evaluate
from assoc_hull.geometry.splines.plane_intersections import points_at_coordinate
from assoc_hull.variation.parameters.measurement import DrawnCurves

__all__ = ["GAUSS", "SectionFrames", "frames_beside", "measure_frames"]

GAUSS = np.polynomial.legendre.leggauss(5)
"""Nodes and weights, exact for y z dz of cubics, a polynomial of degree 8."""

_APART = 1e-6
"""m: sections nearer than this are one station."""


@attrs.frozen(eq=False)
class SectionFrames:
    """Sections up to the draught.

    Attributes
    ----------
    x : (k,), m
        Where they stand, rising.
    start : (k + 1,) int
        Where the places of each begin.
    xyz : (n, 3), m
        Places of the port half.
    dz : (n,), m
        Their weights.
    """

    x: FloatArray
    start: IntArray
    xyz: FloatArray
    dz: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.x, self.start, self.xyz, self.dz)

    def mapped(self, move: Callable[[FloatArray], FloatArray]) -> SectionFrames:
        """Give the sections mapped; weights stay, as only their ratios count."""
        xyz = np.array(move(self.xyz))
        x = np.array([xyz[self.start[i], 0] for i in range(len(self.x))])
        return SectionFrames(x, self.start.copy(), xyz, self.dz.copy())

    def sums(self, values: FloatArray) -> FloatArray:
        """Give the integral of values (n,) over z, section by section, (k,)."""
        total = np.concatenate([[0.0], np.cumsum(values * self.dz)])
        return np.asarray(np.diff(total[self.start]))

    @property
    def areas(self) -> FloatArray:
        """Areas of the halves, (k,), m2."""
        return self.sums(self.xyz[:, 1])

    @property
    def heights(self) -> FloatArray:
        """Heights of the centres of area, (k,), m."""
        return np.asarray(self.sums(self.xyz[:, 1] * self.xyz[:, 2]) / self.areas)

    def beside(self, x: float) -> FloatArray:
        """Give the weights (k,) with which the two sections beside a place stand for it."""
        after = int(np.clip(np.searchsorted(self.x, x), 1, len(self.x) - 1))
        part = (x - self.x[after - 1]) / (self.x[after] - self.x[after - 1])
        found = np.zeros(len(self.x))
        found[after - 1], found[after] = 1.0 - part, part
        return found


def measure_frames(hull: DrawnCurves) -> SectionFrames:
    """Give all sections of a hull."""
    return _frames(hull, _stations(hull))


def frames_beside(hull: DrawnCurves, x: float) -> SectionFrames | None:
    """Give the two sections beside a place; None where it does not lie between two."""
    stations = _stations(hull)
    places = np.array([each for each, _ in stations])
    after = int(np.searchsorted(places, x))
    return _frames(hull, stations[after - 1 : after + 1]) if 0 < after < len(places) else None


def _stations(hull: DrawnCurves) -> list[tuple[float, list[int]]]:
    """Give the places at which sections stand, with their curves, from aft."""
    curves = hull.sections[np.argsort(hull.net.x[hull.sections], kind="stable")]
    found = list[tuple[float, list[int]]]()
    for curve in curves.tolist():
        x = float(hull.net.x[curve])
        if found and x - found[-1][0] <= _APART:
            found[-1][1].append(curve)
        else:
            found.append((x, [curve]))
    return found


def _frames(hull: DrawnCurves, stations: Sequence[tuple[float, list[int]]]) -> SectionFrames:
    chosen = [curve for _, curves in stations for curve in curves]
    batch = hull.some(chosen)
    curve, begin, end = _intervals(batch, hull.ship.draught)
    half = 0.5 * (end - begin)
    t = (0.5 * (begin + end))[:, None] + half[:, None] * GAUSS[0]
    owner = np.repeat(curve, len(GAUSS[0]))
    xyz = evaluate(batch, owner, t.ravel())
    slope = derivative(batch, owner, t.ravel())[:, 2]
    # from the keel up, whichever way a curve runs
    low, high = batch.xyz[batch.start[:-1], 2], batch.xyz[batch.start[1:] - 1, 2]
    dz = slope * (half[:, None] * GAUSS[1]).ravel() * np.where(high < low, -1.0, 1.0)[owner]
    station = np.repeat(np.arange(len(stations)), [len(curves) for _, curves in stations])[owner]
    start = np.searchsorted(station, np.arange(len(stations) + 1))
    # A station that lies wholly above the draught has no area.
    some = np.flatnonzero(np.diff(start) > 0)
    return SectionFrames(
        np.array([stations[i][0] for i in some.tolist()]),
        np.append(start[:-1][some], len(xyz)).astype(np.int64), np.array(xyz), dz,
    )  # fmt: skip


def _intervals(batch: SplineBatch, top: float) -> tuple[IntArray, FloatArray, FloatArray]:
    """Give the pieces of curves below a height: curve, begin and end along it."""
    met = points_at_coordinate(batch, 2, top)
    owner = np.repeat(np.arange(batch.count), np.diff(batch.start))
    curve = np.concatenate([owner, met.curve])
    t = np.concatenate([batch.knot, met.t])
    order = np.lexsort((t, curve))
    curve, t = curve[order], t[order]
    inside = (curve[1:] == curve[:-1]) & (t[1:] > t[:-1])
    which, begin, end = curve[:-1][inside], t[:-1][inside], t[1:][inside]
    below = evaluate(batch, which, 0.5 * (begin + end))[:, 2] < top
    return which[below], begin[below], end[below]
