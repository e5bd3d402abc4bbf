"""The nodes that lie in a plate, and how far it reaches along its axes.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.surface.hull_plates.hull_seams import PlateRange
>>> from assoc_hull.surface.hull_plates.plate_nodes import nodes_in
>>> from assoc_hull.surface.hull_plates.shell import Shell
>>> x, z = np.mgrid[0:30:4j, 0:3:4j]
>>> shell = Shell.of((SplineSurface.bezier(np.stack([x, 1.0 + 0.0 * x, z], axis=-1), "side"),))
>>> found = nodes_in(shell, PlateRange("1", x=(4.0, 10.0)))
>>> np.sort(found.extents(np.eye(3)[[0, 2, 1]])).round(6).tolist()
[3.0, 6.0]
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.surface.curvature_nodes import CurvatureNodes
from assoc_hull.surface.hull_plates.hull_seams import AXES, PlateRange
from assoc_hull.surface.hull_plates.shell import Shell
from assoc_hull.surface.hull_plates.tally import patches_in

__all__ = ["PlateNodes", "nodes_in"]


@attrs.frozen(eq=False)
class PlateNodes:
    """Nodes of the patches that have a part in a plate.

    Attributes
    ----------
    rows : (p,) int
        The patches.
    inside : (p, q, q) bool
        Which nodes lie in the plate.
    nodes : CurvatureNodes
        Those of these patches; outside the plate they have no area.
    edge : (e, 3), m
        Places where lines of nodes leave the plate.
    """

    rows: IntArray
    inside: NDArray[np.bool_]
    nodes: CurvatureNodes
    edge: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.rows, self.inside, self.edge)

    def extents(self, axes: FloatArray) -> FloatArray:
        """Give how far the plate reaches along the first two axes, (2,), m."""
        places = np.concatenate([self.nodes.place[self.inside], self.edge])
        return np.asarray(np.ptp(places @ axes[:2].T, axis=0))


def nodes_in(shell: Shell, wanted: PlateRange) -> PlateNodes:
    """Find the nodes of a plate."""
    rows, _ = patches_in(shell, wanted)
    nodes = CurvatureNodes(*(np.array(each[rows]) for each in attrs.astuple(shell.nodes)))
    beyond = _beyond(shell, wanted, rows)
    inside = beyond <= 0.0
    kept = attrs.evolve(
        nodes,
        area=np.where(inside, nodes.area, 0.0),
        normal=np.where(inside[..., None], nodes.normal, 0.0),
    )
    edges = [_crossings(nodes.place, beyond, axis) for axis in (1, 2)]
    return PlateNodes(rows, inside, kept, np.concatenate(edges))


def _beyond(shell: Shell, wanted: PlateRange, rows: IntArray) -> FloatArray:
    """Give how far nodes lie outside a range, m; nil or below inside."""
    found = np.full(shell.nodes.area[rows].shape, -np.inf)
    for axis in AXES:
        low, high = getattr(wanted, axis)
        if np.isfinite(low) or np.isfinite(high):
            value = shell.at_nodes[axis][rows]
            found = np.maximum(found, np.maximum(low - value, value - high))
    return found


def _crossings(place: FloatArray, beyond: FloatArray, axis: int) -> FloatArray:
    """Give where steps between nodes along an axis cross the border of a range, (e, 3), m."""
    count = place.shape[axis]
    (p, q), (a, b) = (
        (np.take(each, range(count - 1), axis), np.take(each, range(1, count), axis))
        for each in (place, beyond)
    )
    out = (a > 0.0) != (b > 0.0)
    t = (a[out] / (a[out] - b[out]))[:, None]
    return np.asarray(p[out] + t * (q[out] - p[out]))
