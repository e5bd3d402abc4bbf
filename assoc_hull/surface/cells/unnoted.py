"""Crossings of lines that the table of a hull does not hold.

Borders of flats are found on some lines and drawn through; the lines between may know nothing
of them. Elsewhere a crossing that is missing is a fault of the net, and is told by name.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.gather import Net
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.splines.closest import closest_each
from assoc_hull.geometry.splines.plane_intersections import meet_planes

__all__ = ["REACH", "Unnoted", "unnoted_crossings"]

REACH = 80e-3 / 300.0
"""Curves that pass one another so near cross, in lengths of the hull."""

_BESIDE = 1e-3
"""A row so near along the curve is the crossing, in lengths of the hull."""


@attrs.frozen(eq=False)
class Unnoted:
    """Crossings without a row.

    Attributes
    ----------
    pair : (j, 2) int
        The two curves of the net.
    t : (j, 2), m
        Where on them.
    xyz : (j, 3), m
        The place on the first.
    gap : (j,), m
        How far from the second it is.
    """

    pair: IntArray
    t: FloatArray
    xyz: FloatArray
    gap: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.pair, self.t, self.xyz, self.gap)


def unnoted_crossings(
    net: Net, keep: NDArray[np.bool_], curves: IntArray, reach: float = REACH
) -> Unnoted:
    """Find crossings without a row.

    Parameters
    ----------
    net : Net
        Curves and crossings.
    keep : (m,) bool
        The curves that are asked for.
    curves : (c,) int
        Those that are looked along: where they meet the planes of other lines.
    reach : float
        Lines no farther away there cross, in lengths of the hull: 80 mm on 300 m.

    Returns
    -------
    Unnoted
        All of them.
    """
    length = float(np.ptp(net.batch.xyz[:, 0]))
    lines = keep & np.isfinite(net.normal).all(axis=1) & (np.array(net.family) != "boundary")
    found = [(np.empty((0, 2), np.int64), np.empty((0, 2)), np.empty((0, 3)), np.empty(0))]
    for normal in np.unique(net.normal[lines], axis=0):
        own = np.flatnonzero(lines & (net.normal == normal).all(axis=1))
        others = np.setdiff1d(curves, own)
        if len(others):
            found.append(_of_planes(net, own, others, (length, reach)))
    return Unnoted(*(np.concatenate([each[i] for each in found]) for i in range(4)))


def _of_planes(
    net: Net, lines: IntArray, curves: IntArray, scale: tuple[float, float]
) -> tuple[IntArray, FloatArray, FloatArray, FloatArray]:
    """Find those with lines in parallel planes; `scale` is the length, m, and the reach in it."""
    length, reach = scale
    normal = net.normal[lines[0]]
    height = net.batch.xyz[net.batch.start[lines]] @ normal
    offset, plane = np.unique(height.round(9), return_inverse=True)
    number = np.full(net.batch.count, -1, np.int64)
    number[lines] = plane
    batch = SplineBatch.join([net.batch.part(c, c + 1) for c in curves.tolist()])
    met = meet_planes(batch, normal, offset)
    own = curves[met.curve]
    lost = np.flatnonzero(~_held(net, number, own, met.plane, met.t, _BESIDE * length))
    which, line = np.nonzero(met.plane[lost][:, None] == plane)
    at, other = lost[which], lines[line]
    t, _, distance = closest_each(net.batch, other, met.xyz[at])
    good = distance <= reach * length
    pair = np.column_stack([own[at], other])[good]
    return pair, np.column_stack([met.t[at], t])[good], met.xyz[at][good], distance[good]


def _held(
    net: Net, number: IntArray, own: IntArray, plane: IntArray, t: FloatArray, near: float
) -> NDArray[np.bool_]:
    """Tell which meetings of curves with planes are crossings of the net."""
    every, other = net.meets.ravel(), net.meets[:, ::-1].ravel()
    chosen = number[other] >= 0
    # Curve, plane and place in one number: places on one curve and plane stay together.
    width = 4.0 * float(net.batch.knot.max())
    count = int(number.max()) + 1
    held = (every * count + number[other])[chosen] * width + net.place.ravel()[chosen]
    held = np.concatenate([[-np.inf], np.sort(held), [np.inf]])
    asked = (own * count + plane) * width + t
    after = np.searchsorted(held, asked)
    return np.asarray(np.minimum(asked - held[after - 1], held[after] - asked) <= near)
