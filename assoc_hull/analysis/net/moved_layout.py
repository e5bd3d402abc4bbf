"""The layout of a surface whose lines have moved: the same cells, where the lines are now.

Which lines bound which cell stays. Where a line ends between the knots of another, the place
moves with the point in which they cross; how cells carry on between their anchors depends on
how far up the rails these lie. Both are computed in the arithmetic of the moved lines.
"""

from __future__ import annotations

import itertools

import attrs
import numpy as np

from assoc_hull.analysis.net.curve_net import CurveNet
from assoc_hull.analysis.net.surface_layout import SurfaceLayout, blend_cubics
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.numeric.dual import real
from assoc_hull.geometry.numeric.generic_sums import common_zeros
from assoc_hull.geometry.splines.paths import Paths, bit_lengths
from assoc_hull.geometry.splines.segments import (
    locate_parameters,
    power_coefficients,
    segment_curve,
    segment_start,
)
from assoc_hull.geometry.surfaces.coons import CoonsCells

__all__ = ["evaluate_cubics", "move_cells"]

_INSIDE = 1e-12
"""An end of a bit that is not so near to a knot, in parts of the segment, lies inside."""

_SAME = 1e-7
"""A crossing is at a place if it is so near, m along the curve, of a short hull less."""

_STEPS = 3
"""Towards the point on a curve that is nearest: points hardly leave their curves."""


def move_cells(
    layout: SurfaceLayout, net: CurveNet, batch: SplineBatch, points: FloatArray
) -> CoonsCells:
    """Put the cells of a net on its lines as they have become.

    Parameters
    ----------
    layout : SurfaceLayout
        Of the net.
    net : CurveNet
        The lines in plain numbers.
    batch : SplineBatch
        The lines as they have become, in any arithmetic.
    points : (n, 3), m
        Places of all points of the tables, in the same arithmetic.
    """
    paths = _moved(layout.cells.paths, net, batch, points)
    length = np.add.reduceat(bit_lengths(paths, batch), paths.start[:-1])
    height = []
    for begin, end in itertools.pairwise(layout.cell_start.tolist()):
        aft, fore = (_heights(length[layout.rails[begin:end, i]]) for i in (0, 1))
        either = [each for each in (aft, fore) if each is not None]
        height.append(0.5 * (either[0] + either[-1]))
    start = layout.cells.anchor_start
    blend = blend_cubics(np.concatenate(height), layout.flat, layout.knuckle, start)[1]
    return attrs.evolve(layout.cells, paths=paths, blend=blend[layout.cell])


def _heights(length: FloatArray) -> FloatArray | None:
    """Give how far up a rail its cells begin and end, from 0 to 1; None if it is a point."""
    up = np.concatenate([np.zeros(1), np.cumsum(length)])
    return None if real(up)[-1] == 0.0 else up / up[-1]


def _moved(paths: Paths, net: CurveNet, batch: SplineBatch, points: FloatArray) -> Paths:
    """Move the ends of bits that lie inside segments, with the crossings there."""
    bits = len(paths.segment)
    end = np.concatenate([paths.low, paths.high])
    inside = np.flatnonzero((end > _INSIDE) & (end < 1.0 - _INSIDE))
    segment = paths.segment[inside % bits]
    crossing, side = _crossings(net, segment, end[inside])
    # Where no crossing is known the place stays.
    inside, segment, side = (each[crossing >= 0] for each in (inside, segment, side))
    crossing = crossing[crossing >= 0]
    if not len(inside):
        return paths
    target, normal = _targets(net, batch, points, crossing, side)
    u = _nearest(power_coefficients(batch)[segment], target, normal, end[inside])
    moved = common_zeros((2 * bits,), u) + end
    moved[inside] = u
    return attrs.evolve(paths, low=moved[:bits], high=moved[bits:])


def _crossings(net: CurveNet, segment: IntArray, u: FloatArray) -> tuple[IntArray, IntArray]:
    """Give the crossings at places of segments, and on which side; -1 where there is none."""
    first = segment_start(net.batch)[segment]
    t = net.batch.knot[first] + u * (net.batch.knot[first + 1] - net.batch.knot[first])
    own = segment_curve(net.batch)[segment]
    curve, place = net.meets.T.ravel(), net.place.T.ravel()
    order = np.lexsort((place, curve))
    curve, place = curve[order], place[order]
    begin, end = np.searchsorted(curve, own), np.searchsorted(curve, own, "right")
    # Places of one curve lie between its number and the next: one search for all.
    scale = 1.0 + max(place.max(initial=0.0), t.max(initial=0.0))
    near = np.searchsorted(curve + place / scale, own + t / scale)
    found = np.full(len(own), -1)
    for at in (near - 1, near):
        good = (at >= begin) & (at < end)
        good[good] &= np.abs(place[at[good]] - t[good]) <= net.factor * _SAME
        found[good] = order[at[good]]
    count = len(net.meets)
    return np.where(found < 0, -1, found % max(count, 1)), found // max(count, 1)


def _targets(
    net: CurveNet, batch: SplineBatch, points: FloatArray, crossing: IntArray, side: IntArray
) -> tuple[FloatArray, FloatArray]:
    """Give what places of crossings keep to: points, and normals of planes through them.

    A defining crossing is a point of both lines. A watched one lies on each line in the plane
    of the other; there the normal is given, which is nan for the others.
    """
    other = net.meets[crossing, 1 - side]
    segment, u = locate_parameters(net.batch, other, net.place[crossing, 1 - side])
    watched = net.watched[crossing]
    beside = evaluate_cubics(power_coefficients(batch)[segment], u)[0]
    target = np.where(watched[:, None], beside, points[net.row[crossing]])
    return target, np.where(watched[:, None], net.normal[other], np.nan)


def _nearest(cubic: FloatArray, point: FloatArray, normal: FloatArray, u: FloatArray) -> FloatArray:
    """Give where cubics (k, 4, 3) meet planes through points (k, 3), from places nearby.

    Where there is no normal: where they come nearest to the points.
    """
    for _ in range(_STEPS):
        place, slope = evaluate_cubics(cubic, u)
        across = np.where(np.isnan(normal), slope, normal)
        u = u + ((point - place) * across).sum(axis=1) / (slope * across).sum(axis=1)
    return u


def evaluate_cubics(cubic: FloatArray, u: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give places and slopes of cubics (k, 4, 3) at one u each, (k, 3); in any arithmetic."""
    w = u[:, None]
    place = ((cubic[:, 3] * w + cubic[:, 2]) * w + cubic[:, 1]) * w + cubic[:, 0]
    return place, (3.0 * cubic[:, 3] * w + 2.0 * cubic[:, 2]) * w + cubic[:, 1]
