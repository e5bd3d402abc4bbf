"""Which part of the developable region of a plate is flat.

An inflected plate has a narrow flat strip that nodes of a rule of quadrature miss, or count as a
twentieth of the plate. So Gaussian and mean curvature, which are smooth, are interpolated by the
polynomials through the nodes at 128 by 128 places of each patch, and the principal curvatures are
taken from them there.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.patches import Patches
>>> from assoc_hull.surface.plates.curvature_nodes import curvature_nodes
>>> from assoc_hull.surface.plates.flat_share import flat_share
>>> x, y = np.mgrid[0:6:4j, -1:1:4j]
>>> cubic = np.array([-1.0, 1.0, -1.0, 1.0]) / 15.0  # z = y**3 / 15, curvature 0.4 y
>>> nodes = curvature_nodes(Patches.single(np.stack([x, y, cubic + 0.0 * x], axis=-1)))
>>> round(flat_share(nodes, 1e-3, 0.04), 2)
0.1
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.polynomial.legendre import legvander

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.numeric.quadrature import lobatto
from assoc_hull.surface.plates.curvature_nodes import CurvatureNodes

__all__ = ["flat_share"]

_FINE = 128
"""Places each way on a patch."""

_AT_ONCE = 32
"""Patches that are sampled in one go: 30 MB."""


def flat_share(nodes: CurvatureNodes, k0: float, flat_bend: float) -> float:
    """Give the flat part of the region without Gaussian curvature.

    Parameters
    ----------
    nodes : CurvatureNodes
        Those of all patches of a plate.
    k0 : float, 1/m2
        Half the width of the band of what counts as none; with 0 the whole plate is looked at.
    flat_bend : float, 1/m
        The principal curvature up to which a plate is flat.

    Returns
    -------
    float
        0 to 1; 0 without such a region.
    """
    parts = [
        _areas(nodes, slice(first, first + _AT_ONCE), k0, flat_bend)
        for first in range(0, len(nodes.area), _AT_ONCE)
    ]
    zero, flat = np.concatenate(parts, axis=1).sum(axis=1).tolist()
    return flat / zero if zero > 0.0 else 0.0


def _areas(nodes: CurvatureNodes, rows: slice, k0: float, flat_bend: float) -> FloatArray:
    """Give the areas without Gaussian curvature and the flat ones of some patches, (2, k), m2."""
    count = nodes.area.shape[-1]
    _, weight = lobatto(count)
    density, gauss, mean = (
        _finer(each[rows])
        for each in (nodes.area / np.outer(weight, weight), nodes.gauss, nodes.mean)
    )
    bent = np.abs(mean) + np.sqrt(np.maximum(mean**2 - gauss, 0.0))
    zero = np.maximum(density, 0.0) * ((np.abs(gauss) <= k0) if k0 else 1.0)
    return np.stack([zero.sum(axis=(1, 2)), (zero * (bent <= flat_bend)).sum(axis=(1, 2))])


def _finer(values: FloatArray) -> FloatArray:
    """Interpolate values (k, q, q) at nodes to the middles of even steps, (k, n, n)."""
    rows = _through(values.shape[-1])
    return np.asarray(rows @ values @ rows.T)


@lru_cache
def _through(count: int) -> FloatArray:
    """Give the matrix from nodes of Lobatto's rule to the middles of even steps, (n, count)."""
    at, _ = lobatto(count)
    middles = (np.arange(_FINE) + 0.5) / _FINE
    vander = legvander(2.0 * at - 1.0, count - 1)
    found = np.linalg.solve(vander.T, legvander(2.0 * middles - 1.0, count - 1).T).T
    freeze(found)
    return np.asarray(found)
