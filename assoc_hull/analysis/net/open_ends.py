"""Ends of a hull that no line closes: from the last section to where the hull's extent ends.

A hull given by sections alone has no profile and no transom. Volumes would stop at its first and
last section; here the shell goes on from there by straight lines to an upright stem or stern, a
wedge. What a wedge adds is stated as its error, too: the true end may have none of it, or as much
again. Where any strip of the surface reaches beyond the section, or a transom covers it, nothing is
added.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.curve_net import CurveNet, sections_of
from assoc_hull.analysis.net.surface_layout import OpenEnd
from assoc_hull.geometry.curves import FloatArray, IntArray, IsoCurves, Strips
from assoc_hull.geometry.numeric.dual import common_zeros

__all__ = ["StripsWithEnds", "with_ends"]

_ORDER = 4


@attrs.frozen(eq=False)
class StripsWithEnds:
    """Strips of a surface, and one more for each piece of a section at an open end.

    Attributes
    ----------
    inner : Strips
        The surface.
    pieces : tuple of IsoCurves
        The section of each added strip, one curve.
    span : tuple of (x aft, x fore, whether the section is the aft one)
        From where to where it goes, m.
    """

    inner: Strips
    pieces: tuple[IsoCurves, ...]
    span: tuple[tuple[float, float, bool], ...]

    @property
    def count(self) -> int:
        """Number of strips."""
        return self.inner.count + len(self.pieces)

    @property
    def order(self) -> IntArray:
        """How many Gauss points along v each strip wants, (count,)."""
        return np.append(self.inner.order, np.full(len(self.pieces), _ORDER)).astype(np.int64)

    def curves(self, strip: IntArray, v: FloatArray) -> IsoCurves:
        """Give one curve for each pair of a strip and a v, (k,) each."""
        added = np.flatnonzero(strip >= self.inner.count)
        if not len(added):
            return self.inner.curves(strip, v)
        parts: dict[int, tuple[FloatArray, FloatArray, NDArray[np.bool_]]] = {}
        plain = np.flatnonzero(strip < self.inner.count)
        if len(plain):
            known = self.inner.curves(strip[plain], v[plain])
            for i, k in enumerate(plain.tolist()):
                own = slice(int(known.start[i]), int(known.start[i + 1]))
                parts[k] = known.point[own], known.across[own], known.deck[own]
        for k in added.tolist():
            parts[k] = self._wedge(int(strip[k]) - self.inner.count, v[k])
        order = [parts[k] for k in range(len(strip))]
        start = np.zeros(len(order) + 1, np.int64)
        np.cumsum([len(each[2]) for each in order], out=start[1:])
        point, across, deck = (np.concatenate([each[i] for each in order]) for i in range(3))
        return IsoCurves(start, point, across, deck)

    def _wedge(
        self, number: int, v: FloatArray
    ) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
        """Give a curve of an added strip: the section, the narrower the farther out it stands."""
        piece, (aft, fore, begins) = self.pieces[number], self.span[number]
        part = 1.0 - v if begins else v
        point = common_zeros(piece.point.shape, piece.point, v) + piece.point
        across = 0.0 * point
        across[:, :, 1] = (-1.0 if begins else 1.0) * piece.point[:, :, 1]
        across[:, 0, 0] = fore - aft
        point[:, :, 1] = part * point[:, :, 1]
        point[:, 0, 0] = aft + (fore - aft) * v
        return point, across, piece.deck


def with_ends(strips: Strips, net: CurveNet, closed: bool, ends: tuple[OpenEnd, ...]) -> Strips:
    """Give strips with those that close the open ends of a net; `closed`: it has a deck."""
    if not ends:
        return strips
    found = sections_of(net, closed)
    pieces, span = list[IsoCurves](), list[tuple[float, float, bool]]()
    for end in ends:
        own = found.station == int(np.abs(found.x - end.x).argmin())
        for k in np.flatnonzero(own).tolist():
            tiles = slice(int(found.curves.start[k]), int(found.curves.start[k + 1]))
            point, deck = found.curves.point[tiles], found.curves.deck[tiles]
            pieces.append(IsoCurves(np.array([0, len(deck)]), point, 0.0 * point, deck))
            x = point[0, 0, 0]
            span.append((x, end.end, True) if end.fore else (end.end, x, False))
    return StripsWithEnds(strips, tuple(pieces), tuple(span))
