"""Patches solved and joined, for the tests of joining."""

from collections import Counter
from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.cell_subdivision import (
    subdivide_again,
    subdivide_patches,
    zero_edges,
)
from assoc_hull.geometry.patches.cells import SignCells, ZeroSetArcs
from assoc_hull.geometry.patches.components import ZeroSetComponent, join_arcs
from assoc_hull.geometry.patches.curvature_functions import IsoFunction, gauss_function
from assoc_hull.geometry.patches.line_ends import positive_on_left
from assoc_hull.geometry.patches.zero_set_arcs import arcs_of, sample_arcs

KINDS = ("closed", "open", "junction", "isolated")


@attrs.frozen(eq=False)
class Joined:
    """Patches with all that is found of them for one level."""

    patches: Patches
    function: IsoFunction
    cells: SignCells
    arcs: ZeroSetArcs
    components: tuple[ZeroSetComponent, ...]

    def polyline(
        self, component: ZeroSetComponent, chain: int, chord_tol: float = 1e-3
    ) -> FloatArray:
        """The points (p, 2), in parameters of the surface, of one line, with positive left."""
        start, uv = sample_arcs(self.patches, self.cells, self.arcs, chord_tol)
        along = positive_on_left(self.arcs)
        patch = self.cells.patch[self.arcs.cell]
        parts = []
        for arc in component.chains[chain].tolist():
            part = uv[start[arc] : start[arc + 1]]
            part = part if along[arc] else part[::-1]
            parts.append(self.patches.parameters(np.full(len(part), patch[arc]), part))
        return np.concatenate(parts)


def join(patches: Patches, level: float = 0.0, known_to: float = 0.0) -> Joined:
    """Solve and join patches; control points are known to a part of 1 m."""
    function = gauss_function(patches, level)
    nil = gauss_function(patches, level, known_to).err if known_to else function.err
    return joined_of(patches, function, nil)


def joined_of(patches: Patches, function: IsoFunction, nil: FloatArray | None = None) -> Joined:
    """Solve and join for any polynomials."""
    cells = subdivide_again(function, subdivide_patches(function, nil=nil), nil=nil)
    arcs = arcs_of(cells)
    edges = zero_edges(function.b, function.err if nil is None else nil)
    return Joined(patches, function, cells, arcs, join_arcs(patches, cells, arcs, edges))


def join_nets(nets: FloatArray, known_to: float = 0.0) -> Joined:
    """Solve and join nets (k, m + 1, n + 1, 3), each a surface of its own."""
    return join(apart(nets), 0.0, known_to)


def apart(nets: FloatArray) -> Patches:
    """Patches of nets, each on the unit square of a surface of its own."""
    box = np.tile(np.array([[0.0, 1.0], [0.0, 1.0]]), (len(nets), 1, 1))
    return Patches(nets.copy(), box, np.arange(len(nets)))


def counts(components: Sequence[ZeroSetComponent]) -> tuple[int, ...]:
    """How many components are closed, open, junctions, isolated."""
    found = Counter(each.kind.value for each in components)
    return tuple(found[kind] for kind in KINDS)


def by_patch(components: Sequence[ZeroSetComponent], count: int) -> list[tuple[int, ...]]:
    """The counts of each patch, of components that lie on one patch each."""
    return [counts([c for c in components if c.patches.tolist() == [k]]) for k in range(count)]


def winding(loop: FloatArray) -> float:
    """Twice the area that a closed polygon encloses, positive counter-clockwise."""
    after: IntArray = np.roll(np.arange(len(loop)), -1)
    return float((loop[:, 0] * loop[after, 1] - loop[:, 1] * loop[after, 0]).sum())
