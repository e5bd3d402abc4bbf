"""Curvature at the nodes of a rule of quadrature on patches: what plates are measured by.

The rule is Lobatto's, so that borders and corners, where curvature is often largest, are nodes. At
a node without a normal (a pole) the curvature is not evaluated; its area is nil there.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.bezier_patches import Patches
>>> from assoc_hull.surface.plating.curvature_nodes import curvature_nodes
>>> x, y = np.mgrid[-1:1:3j, -1:1:3j]
>>> nodes = curvature_nodes(Patches.single(np.stack([x, y, 0.2 * x * y], axis=-1)))
>>> bool(nodes.gauss.max() < 0.0), round(float(nodes.area.sum()), 3)
(True, 4.053)
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.numeric.quadrature import lobatto
from assoc_hull.geometry.patches.bezier_patches import Patches, curvatures

__all__ = ["CurvatureNodes", "curvature_nodes", "map_value"]

COUNT = 24
"""Nodes each way on a patch."""


@attrs.frozen(eq=False)
class CurvatureNodes:
    """Curvature at q by q nodes on each of k patches.

    Attributes
    ----------
    place : (k, q, q, 3), m
        The nodes.
    normal : (k, q, q, 3), m2
        The unit normal, along r_u x r_v, times `area`.
    area : (k, q, q), m2
        The area that each node stands for.
    gauss : (k, q, q), 1/m2
        Gaussian curvature; nil where there is no normal.
    mean : (k, q, q), 1/m
        Mean curvature, positive where the surface bends towards its normal; nil likewise.
    bent : (k, q, q), 1/m
        The larger principal curvature in amount, without sign.
    other : (k, q, q), 1/m
        The smaller one in amount, without sign.
    bending : (k, q, q, 3)
        The unit direction of the larger one; any tangent where both are alike.
    """

    place: FloatArray
    normal: FloatArray
    area: FloatArray
    gauss: FloatArray
    mean: FloatArray
    bent: FloatArray
    other: FloatArray
    bending: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.place, self.normal, self.area, self.gauss)
        freeze(self.mean, self.bent, self.other, self.bending)


def map_value(gauss: FloatArray, k0: float) -> FloatArray:
    """Give asinh(K/K0), which a continuous map shows: the band about 0 stays visible.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.surface.plating.curvature_nodes import map_value
    >>> map_value(np.array([-1e-3, 0.0, 1e-3]), 1e-3).round(3).tolist()
    [-0.881, 0.0, 0.881]
    """
    return np.asarray(np.arcsinh(np.asarray(gauss) / k0))


def curvature_nodes(patches: Patches, count: int = COUNT) -> CurvatureNodes:
    """Evaluate curvature at the nodes of Lobatto's rule.

    Parameters
    ----------
    patches : Patches
        The patches; each by itself, to the last bit.
    count : int
        Nodes each way.

    Returns
    -------
    CurvatureNodes
        Places, areas and curvatures.
    """
    at, weight = lobatto(count)
    k, each = len(patches), count * count
    uv = np.stack(np.meshgrid(at, at, indexing="ij"), axis=-1).reshape(each, 2)
    found = curvatures(patches, np.repeat(np.arange(k), each), np.tile(uv, (k, 1)))
    there = np.isfinite(found.gauss)
    rows = np.arange(k * each)
    amount = np.abs(np.where(there[:, None], found.principal, 0.0))
    larger = amount.argmax(axis=1)
    bending = np.nan_to_num(found.axes[rows, larger])
    area = np.where(there, found.element, 0.0) * np.tile(np.outer(weight, weight).ravel(), k)
    normal = np.nan_to_num(found.normal) * area[:, None]
    values = (
        found.position, normal, area, np.where(there, found.gauss, 0.0),
        np.where(there, found.mean, 0.0),
        amount[rows, larger], amount[rows, 1 - larger], bending,
    )  # fmt: skip
    return CurvatureNodes(*(value.reshape(k, count, count, *value.shape[1:]) for value in values))
