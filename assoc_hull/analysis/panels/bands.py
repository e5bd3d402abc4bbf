"""Strips that follow one another without a branch, joined to long ones.

Between two stations of a net the surface has one strip, or several where the hull has come apart
(bulb and stem, bossing and counter). Where the rail of one strip is that of the next the two are
one *band*; a band ends where the hull ends, branches or joins.

Along a band runs the parameter q: strip number and v, from 0 to the number of strips.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.flotation import Flotation
from assoc_hull.analysis.net.gather import Part
from assoc_hull.analysis.net.loops import Frame
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.floating.wetted_curves import WetRuns, wet_runs
from assoc_hull.geometry.surfaces.isocurves import IsoCurves, Strips

__all__ = ["Band", "Waterplane", "bands", "bands_of_strips"]

_SAME = 1e-6
"""Parameters of one curve so near to one another (m) are one."""


@attrs.frozen
class Waterplane:
    """A floating plane ``z = height + tan_trim x - tan_heel y``, m."""

    height: float
    tan_trim: float = 0.0
    tan_heel: float = 0.0

    def over(self, places: FloatArray) -> FloatArray:
        """Give the heights of places (k, 3) over the plane, in z, (k,), m."""
        x, y, z = places.T
        found: FloatArray = z - self.height - self.tan_trim * x + self.tan_heel * y
        return found

    def on_starboard(self) -> Waterplane:
        """Give the same plane as the starboard half sees it, y to starboard."""
        return attrs.evolve(self, tan_heel=-self.tan_heel)


@attrs.frozen(eq=False)
class Band:
    """A run of strips.

    Attributes
    ----------
    surface : Strips
        One half of the hull.
    strips : (n,) int
        Their numbers, from aft forward.
    x : (n + 1,), m
        Where they begin and end; at a raked end the outermost place that is wet.
    """

    surface: Strips
    strips: IntArray
    x: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.strips, self.x)

    @property
    def count(self) -> int:
        """Number of strips, and the last q."""
        return len(self.strips)

    def curves(self, q: FloatArray) -> IsoCurves:
        """Give the curves across the band at (k,) parameters."""
        number = np.minimum(np.floor(q).astype(np.int64), self.count - 1)
        return self.surface.curves(self.strips[number], q - number)

    def wet(self, q: FloatArray, plane: Waterplane) -> WetRuns:
        """Give what of those curves lies below a plane."""
        return wet_runs(self.curves(q), plane.height, plane.tan_trim, plane.tan_heel)

    def q_at(self, x: FloatArray) -> FloatArray:
        """Give the parameters at places along the ship (k,), m, that lie inside the band."""
        inside = x[(x > self.x[0]) & (x < self.x[-1])]
        found: FloatArray = np.interp(inside, self.x, np.arange(self.count + 1.0))
        return found


def bands(body: Flotation, plane: Waterplane) -> list[Band]:
    """Join the strips of a hull, from aft forward."""
    frames = body.layout.frames
    deck = body.layout.edge & body.closed
    after = _followers(frames, [bool(each) for each in deck])
    followed = set(after.values())
    found = []
    for first in range(len(frames)):
        if first in followed:
            continue
        run = [first]
        while run[-1] in after:
            run.append(after[run[-1]])
        found.append(_band(body.strips, run, plane))
    return found


def bands_of_strips(surface: Strips, plane: Waterplane) -> list[Band]:
    """Take all strips of a surface without branches as one band."""
    return [_band(surface, list(range(surface.count)), plane)]


def _followers(frames: tuple[Frame, ...], deck: list[bool]) -> dict[int, int]:
    """Say which strip each is followed by along its whole rail."""
    after: dict[int, int] = {}
    for i, aft in enumerate(frames):
        for j, fore in enumerate(frames):
            if fore.slab == aft.slab + 1 and deck[i] == deck[j] and _same(aft.fore, fore.aft):
                after[i] = j
    return after


def _same(one: tuple[Part, ...], other: tuple[Part, ...]) -> bool:
    return len(one) == len(other) and all(
        a[0] == b[0] and abs(a[1] - b[1]) <= _SAME and abs(a[2] - b[2]) <= _SAME
        for a, b in zip(one, other, strict=True)
    )


def _band(surface: Strips, run: list[int], plane: Waterplane) -> Band:
    """Make a band; where its strips begin and end is seen on their curves."""
    bare = Band(surface, np.array(run, np.int64), np.zeros(len(run) + 1))
    q = np.arange(len(run) + 1.0)
    reach = [_extents(bare, q, plane), _extents(bare, q, plane.on_starboard())]
    low = np.minimum(reach[0][0], reach[1][0])
    high = np.maximum(reach[0][1], reach[1][1])
    x = np.concatenate([low[:1], 0.5 * (low + high)[1:-1], high[-1:]])
    return attrs.evolve(bare, x=np.maximum.accumulate(x))


def _extents(band: Band, q: FloatArray, plane: Waterplane) -> tuple[FloatArray, FloatArray]:
    """Give the least and the most x of what is wet of curves, of all of them if nothing is."""
    curves = band.curves(q)
    part = np.linspace(0.0, 1.0, 5)[:, None, None]
    wet = band.wet(q, plane)
    low, high = np.full(len(q), np.inf), np.full(len(q), -np.inf)
    for cubic, start, curve in (
        (wet.chains.cubic, wet.chains.start, wet.curve),
        (curves.point, curves.start, np.arange(len(q))),
    ):
        c = cubic[:, :, 0]
        x = ((c[:, 3] * part[:, 0] + c[:, 2]) * part[:, 0] + c[:, 1]) * part[:, 0] + c[:, 0]
        for run, number in enumerate(curve.tolist()):
            if cubic is curves.point and np.isfinite(low[number]):
                continue
            piece = x[:, start[run] : start[run + 1]]
            low[number] = min(low[number], float(piece.min()))
            high[number] = max(high[number], float(piece.max()))
    return low, high
