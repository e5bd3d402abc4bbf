"""The surface of a hull made ready to be cut: Bezier patches, places in x, z and girth, curvature.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.surface.plates.shell import Shell
>>> x, z = np.mgrid[0:30:4j, 0:3:4j]
>>> shell = Shell.of((SplineSurface.bezier(np.stack([x, 1.0 + 0.0 * x, z], axis=-1), "side"),))
>>> len(shell.patches), float(shell.nodes.area.sum().round(9))
(1, 90.0)
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.quadrature import lobatto
from assoc_hull.geometry.numeric.tensor_bernstein import basis
from assoc_hull.geometry.patches.patches import Patches
from assoc_hull.geometry.patches.running_bounds import EPS, Running
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.plates.curvature_nodes import CurvatureNodes, curvature_nodes
from assoc_hull.surface.plates.girth import girth_of
from assoc_hull.surface.plates.margins import margins
from assoc_hull.surface.regions.surface_batches import batches_of

__all__ = ["NODES", "Shell"]

NODES = 7
"""Nodes each way on a patch: a plate of 10 by 2.5 m has some hundreds of them."""


@attrs.frozen(eq=False, slots=False)
class Shell:
    """A surface of k Bezier patches.

    Attributes
    ----------
    surfaces : tuple of SplineSurface
        The surfaces of its blocks.
    patches : Patches
        Their patches; `Patches.surface` numbers the blocks.
    nodes : CurvatureNodes
        Curvature at `NODES` by `NODES` places of each.
    margin : (k,) bool
        Patches whose curvature is not settled: beside a border of blocks, or at a corner where
        the sides of a block are tangent.
    places : mapping of str to Running
        x, z and, where it is asked for, girth, as polynomials over each patch, m.
    """

    surfaces: tuple[SplineSurface, ...]
    patches: Patches
    nodes: CurvatureNodes
    margin: NDArray[np.bool_]
    places: Mapping[str, Running]

    def __attrs_post_init__(self) -> None:
        freeze(self.margin)

    @cached_property
    def extremes(self) -> dict[str, tuple[FloatArray, FloatArray]]:
        """The least and greatest coefficient of each patch, (k,) and (k,) m, by axis."""
        return {
            axis: (place.b.min(axis=(1, 2)), place.b.max(axis=(1, 2)))
            for axis, place in self.places.items()
        }

    @classmethod
    def of(
        cls,
        surfaces: Sequence[SplineSurface],
        singular: Sequence[Sequence[tuple[float, float]]] = (),
        girth: bool = False,
    ) -> Self:
        """Make surfaces ready.

        Parameters
        ----------
        surfaces : sequence of SplineSurface
            Those of the blocks of a half hull, polynomial and of one bidegree.
        singular : sequence of sequences of (float, float), optional
            Parameters of tangent corners, block by block.
        girth : bool
            Whether girth is wanted.

        Raises
        ------
        BadInputError
            Rational surfaces, or several bidegrees.
        """
        batches = batches_of(surfaces)
        if len(batches) != 1 or batches[0].patches.weight is not None:
            what = "the surfaces are rational, or of several bidegrees"
            remedy = "give surfaces of one bidegree, without weights"
            raise BadInputError(what, "in plates of a hull", remedy)
        patches = batches[0].patches
        places = {axis: _exact(patches.net[..., i]) for axis, i in (("x", 0), ("z", 2))}
        if girth:
            places["girth"] = girth_of(patches)
        found = curvature_nodes(patches, NODES)
        return cls(tuple(surfaces), patches, found, margins(patches, singular), places)

    def at(self, axis: str, rows: IntArray, count: int = NODES) -> FloatArray:
        """Give x, z or girth at `count` by `count` nodes of some patches, (p, q, q), m."""
        b, (at, _) = self.places[axis].b[rows], lobatto(count)
        return np.asarray(basis(b.shape[1] - 1, at) @ b @ basis(b.shape[2] - 1, at).T)


def _exact(coordinate: FloatArray) -> Running:
    """Take a coordinate of control points, (k, m + 1, n + 1), for exact."""
    b = np.ascontiguousarray(coordinate)
    return Running(b, 4.0 * EPS * (np.abs(b) + 1.0))
