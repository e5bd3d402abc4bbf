"""The layout of a surface whose lines have moved: the same cells, where the lines are now.

Which lines bound which cell stays. Where a line ends between the knots of another, the place
moves with the point in which they cross; how cells carry on between their anchors depends on
how far up the rails these lie. Both are computed in the arithmetic of the moved lines.
"""

from __future__ import annotations

import itertools

import attrs
import numpy as np

from assoc_hull.analysis.net.cells import Layout, blends
from assoc_hull.analysis.net.gather import Net
from assoc_hull.geometry.coons import Cells
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.dual import real
from assoc_hull.geometry.paths import Paths, bit_lengths
from assoc_hull.geometry.segments import power, segment_curve, segment_start
from assoc_hull.geometry.tile_sums import nil

__all__ = ["followed"]

_INSIDE = 1e-12
"""An end of a bit that is not so near to a knot, in parts of the segment, lies inside."""

_STEPS = 3
"""Towards the point on a curve that is nearest: points hardly leave their curves."""


def followed(layout: Layout, net: Net, batch: SplineBatch, points: FloatArray) -> Cells:
    """Put the cells of a net on its lines as they have become.

    Parameters
    ----------
    layout : Layout
        Of the net.
    net : Net
        The lines in plain numbers.
    batch : SplineBatch
        The lines as they have become, in any arithmetic.
    points : (n, 3), m
        Places of all points of the tables, in the same arithmetic.
    """
    paths = _moved(layout.cells.paths, net, batch, points)
    length = np.add.reduceat(bit_lengths(paths, batch), paths.start[:-1])
    blend = []
    anchor = itertools.pairwise(layout.cells.anchor_start.tolist())
    for begin, end in itertools.pairwise(layout.cell_start.tolist()):
        own = slice(*next(anchor))
        aft, fore = (_heights(length[layout.rails[begin:end, i]]) for i in (0, 1))
        either = [each for each in (aft, fore) if each is not None]
        height = 0.5 * (either[0] + either[-1])
        blend.append(blends(height, layout.flat[own], layout.knuckle[own])[1])
    return attrs.evolve(layout.cells, paths=paths, blend=np.concatenate(blend)[layout.cell])


def _heights(length: FloatArray) -> FloatArray | None:
    """Give how far up a rail its cells begin and end, from 0 to 1; None if it is a point."""
    up = np.concatenate([np.zeros(1), np.cumsum(length)])
    return None if real(up)[-1] == 0.0 else up / up[-1]


def _moved(paths: Paths, net: Net, batch: SplineBatch, points: FloatArray) -> Paths:
    """Move the ends of bits that lie inside segments, with the crossings there."""
    bits = len(paths.segment)
    end = np.concatenate([paths.low, paths.high])
    inside = np.flatnonzero((end > _INSIDE) & (end < 1.0 - _INSIDE))
    if not len(inside):
        return paths
    segment = paths.segment[inside % bits]
    row = _crossings(net, segment, end[inside])
    u = _nearest(power(batch)[segment], points[row], end[inside])
    # Where no crossing is known the place stays.
    u = np.where(row >= 0, u, end[inside])
    moved = nil((2 * bits,), u) + end
    moved[inside] = u
    return attrs.evolve(paths, low=moved[:bits], high=moved[bits:])


def _crossings(net: Net, segment: IntArray, u: FloatArray) -> IntArray:
    """Give the rows of the crossings at places of segments, (k,); -1 where there is none."""
    first = segment_start(net.batch)[segment]
    t = net.batch.knot[first] + u * (net.batch.knot[first + 1] - net.batch.knot[first])
    own = segment_curve(net.batch)[segment]
    known = ~net.watched  # a watched crossing lies on one of the two only
    curve, place = net.meets[known].T.ravel(), net.place[known].T.ravel()
    row = np.tile(net.row[known], 2)
    order = np.lexsort((place, curve))
    curve, place, row = curve[order], place[order], row[order]
    begin, end = np.searchsorted(curve, own), np.searchsorted(curve, own, "right")
    # Places of one curve lie between its number and the next: one search for all.
    scale = 1.0 + max(place.max(initial=0.0), t.max(initial=0.0))
    near = np.searchsorted(curve + place / scale, own + t / scale)
    found = np.full(len(own), -1)
    for at in (near - 1, near):
        good = (at >= begin) & (at < end)
        good[good] &= np.abs(place[at[good]] - t[good]) <= _SAME
        found[good] = row[at[good]]
    return found


_SAME = 1e-7
"""A crossing is at a place if it is so near, m along the curve."""


def _nearest(cubic: FloatArray, point: FloatArray, u: FloatArray) -> FloatArray:
    """Give where cubics (k, 4, 3) come nearest to points (k, 3), from places nearby."""
    for _ in range(_STEPS):
        w = u[:, None]
        place = ((cubic[:, 3] * w + cubic[:, 2]) * w + cubic[:, 1]) * w + cubic[:, 0]
        slope = (3.0 * cubic[:, 3] * w + 2.0 * cubic[:, 2]) * w + cubic[:, 1]
        u = u + ((point - place) * slope).sum(axis=1) / (slope * slope).sum(axis=1)
    return u
