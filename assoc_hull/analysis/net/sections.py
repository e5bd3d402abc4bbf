"""The sections of a net as curves that planes can cut: as drawn, not as the surface has them."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.net.gather import Net
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.floating.immersed import Planes
from assoc_hull.geometry.floating.immersed_sections import sections_below
from assoc_hull.geometry.numeric.dual import real
from assoc_hull.geometry.splines.segments import power
from assoc_hull.geometry.surfaces.isocurves import IsoCurves

__all__ = ["CENTRE", "Sections", "areas_of_ends", "flat_ends_below", "sections_of"]

CENTRE = 1e-4
"""A curve that ends so near to the centre plane (m) ends on it."""


@attrs.frozen(eq=False)
class Sections:
    """Sections, piece by piece.

    Attributes
    ----------
    curves : IsoCurves
        k pieces, from keel to deck, with the closed deck where there is one.
    curve : (k,) int
        Their curves in the net.
    station : (k,) int
        The station of each piece.
    x : (n,), m
        Where the stations are, rising.
    names : tuple of n str
        Their names.
    """

    curves: IsoCurves
    curve: IntArray
    station: IntArray
    x: FloatArray
    names: tuple[str, ...]

    def __attrs_post_init__(self) -> None:
        freeze(self.curve, self.station, self.x)

    def per_station(self, values: FloatArray) -> FloatArray:
        """Add up what belongs to the pieces of each station: (d, k) to (d, n)."""
        member = (self.station[:, None] == np.arange(len(self.x))).astype(np.float64)
        found: FloatArray = values @ member
        return found


def sections_of(net: Net, closed: bool) -> Sections:
    """Take the sections of a net; `closed` joins deck edges to the centre plane."""
    chosen = np.flatnonzero(np.isfinite(net.x) & ~net.end)
    chosen = chosen[np.argsort(net.x[chosen], kind="stable")]
    x, station = np.unique(net.x[chosen], return_inverse=True)
    names = tuple(net.name[int(chosen[np.argmax(station == i)])] for i in range(len(x)))
    parts = [net.batch.part(curve, curve + 1) for curve in chosen.tolist()]
    return Sections(_curves(SplineBatch.join(parts), closed), chosen, station, x, names)


def flat_ends_below(net: Net, closed: bool, planes: Planes) -> FloatArray:
    """Give the area of transom and other ends in planes across the ship, (d,), m2."""
    chosen = np.flatnonzero(np.isfinite(net.x) & net.end)
    if not len(chosen):
        return np.zeros(len(planes.height))
    parts = [net.batch.part(curve, curve + 1) for curve in chosen.tolist()]
    return areas_of_ends(SplineBatch.join(parts), closed, planes)


def areas_of_ends(edges: SplineBatch, closed: bool, planes: Planes) -> FloatArray:
    """Give the area inside the edges of ends across the ship, (d,), m2."""
    area: FloatArray = sections_below(_curves(edges, closed), planes).sum(axis=1)
    return area


def _curves(batch: SplineBatch, closed: bool) -> IsoCurves:
    """Give curves as tiles from keel to deck, with a deck where they end off the centre plane."""
    tiles: list[FloatArray] = []
    start, deck = [0], []
    for curve in range(batch.count):
        cubic = _upward(power(batch.part(curve, curve + 1)))
        last = cubic[-1].sum(axis=0)
        covered = bool(closed and abs(last[1]) > CENTRE)
        if covered:
            across = last * np.array([0.0, -1.0, 0.0])
            lid = np.stack([last, across, 0.0 * last, 0.0 * last])
            cubic = np.concatenate([cubic, lid[None]])
        tiles.append(cubic)
        deck += [False] * (len(cubic) - covered) + [True] * covered
        start.append(len(deck))
    point = np.concatenate(tiles)
    return IsoCurves(np.array(start), point, np.zeros_like(point), np.array(deck, np.bool_))


def _upward(cubic: FloatArray) -> FloatArray:
    """Turn a curve so that it runs from keel to deck: it encloses area to port."""
    first, last = cubic[:, 0], cubic.sum(axis=1)
    swept = (0.5 * (first[:, 1] + last[:, 1]) * (last[:, 2] - first[:, 2])).sum()
    if real(swept) >= 0.0:
        return cubic
    c0, c1, c2, c3 = (cubic[::-1, i] for i in range(4))
    return np.stack([c0 + c1 + c2 + c3, -(c1 + 2.0 * c2 + 3.0 * c3), c2 + 3.0 * c3, -c3], axis=1)
