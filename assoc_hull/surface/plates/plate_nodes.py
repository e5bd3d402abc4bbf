"""The nodes that lie in a plate, and how far it reaches along its axes.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.surface.plates.hull_seams import PlateRange
>>> from assoc_hull.surface.plates.plate_nodes import nodes_in
>>> from assoc_hull.surface.plates.shell import NODES, Shell
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
from assoc_hull.surface.plates.curvature_nodes import CurvatureNodes, curvature_nodes
from assoc_hull.surface.plates.hull_seams import AXES, PlateRange
from assoc_hull.surface.plates.shell import NODES, Shell
from assoc_hull.surface.plates.tally import patches_in

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

    @property
    def axes(self) -> FloatArray:
        """e1 (along), e2 (across) and e3 (into the hull) as rows, (3, 3), right-handed.

        e3 goes against the mean normal, e1 and e2 are those of the second moments of area in the
        plane across it: also of a narrow strip that is bent along, whose moment is the larger
        along the normal. Of e1 the component with the largest amount is positive.
        """
        weight = self.nodes.area.ravel() / self.nodes.area.sum()
        place = self.nodes.place.reshape(-1, 3)
        inward = -self.nodes.normal.sum(axis=(0, 1, 2))
        e3 = inward / np.sqrt(inward @ inward)
        off = place - weight @ place
        off = off - (off @ e3)[:, None] * e3
        _, vectors = np.linalg.eigh((off * weight[:, None]).T @ off)
        e1 = vectors[:, 2] - (vectors[:, 2] @ e3) * e3
        e1 /= np.sqrt(e1 @ e1) * np.sign(e1[np.abs(e1).argmax()])
        return np.stack([e1, np.cross(e3, e1), e3])

    def extents(self, axes: FloatArray) -> FloatArray:
        """Give how far the plate reaches along the first two axes, (2,), m."""
        places = np.concatenate([self.nodes.place[self.inside], self.edge])
        return np.asarray(np.ptp(places @ axes[:2].T, axis=0))


def nodes_in(shell: Shell, wanted: PlateRange, count: int = NODES) -> PlateNodes:
    """Find the nodes of a plate, `count` each way on a patch."""
    rows, _ = patches_in(shell, wanted)
    if count == NODES:
        nodes = CurvatureNodes(*(np.array(each[rows]) for each in attrs.astuple(shell.nodes)))
    else:
        nodes = curvature_nodes(shell.patches[rows], count)
    bounds = _bounds(shell, wanted, rows, count)
    inside = np.all([bound <= 0.0 for bound in bounds], axis=0) & np.ones(nodes.area.shape, bool)
    kept = attrs.evolve(
        nodes,
        area=np.where(inside, nodes.area, 0.0),
        normal=np.where(inside[..., None], nodes.normal, 0.0),
    )
    edges = [_crossings(nodes.place, bound, bounds, axis) for bound in bounds for axis in (1, 2)]
    return PlateNodes(rows, inside, kept, np.concatenate([np.zeros((0, 3)), *edges]))


def _bounds(shell: Shell, wanted: PlateRange, rows: IntArray, count: int) -> list[FloatArray]:
    """Give by how much nodes lie beyond each seam of a range, (p, q, q), m; nil or less inside."""
    found = []
    for axis in AXES:
        low, high = getattr(wanted, axis)
        if np.isinf(low) and np.isinf(high):
            continue
        value = shell.at(axis, rows, count)
        found += [low - value] if np.isfinite(low) else []
        found += [value - high] if np.isfinite(high) else []
    return found


def _crossings(
    place: FloatArray, beyond: FloatArray, bounds: list[FloatArray], axis: int
) -> FloatArray:
    """Give where steps between nodes along an axis cross a seam within the others, (e, 3), m."""
    count = place.shape[axis]

    def steps(values: FloatArray) -> tuple[FloatArray, FloatArray]:
        return np.take(values, range(count - 1), axis), np.take(values, range(1, count), axis)

    (p, q), (a, b) = steps(place), steps(beyond)
    out = (a > 0.0) != (b > 0.0)
    t = a[out] / (a[out] - b[out])
    kept = np.ones(len(t), bool)
    for other in bounds:
        if other is not beyond:
            c, d = steps(other)
            kept &= c[out] + t * (d[out] - c[out]) <= 0.0
    found = p[out] + t[:, None] * (q[out] - p[out])
    return np.asarray(found[kept])
