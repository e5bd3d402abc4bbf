"""Curvature at the nodes of a rule of quadrature on patches: what plates are measured by.

The rule is Lobatto's, so that borders and corners, where curvature is often largest, are nodes. At
a node without a normal (a pole) the curvature is not evaluated; its area is nil there.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.patches import Patches
>>> from assoc_hull.surface.curvature_nodes import curvature_nodes
>>> x, y = np.mgrid[-1:1:3j, -1:1:3j]
>>> nodes = curvature_nodes(Patches.single(np.stack([x, y, 0.2 * x * y], axis=-1)))
>>> bool(nodes.gauss.max() < 0.0), round(float(nodes.area.sum()), 3)
(True, 4.053)
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.patches.algebra import u_derivative, v_derivative
from assoc_hull.geometry.patches.patches import Patches
from assoc_hull.geometry.quadrature import lobatto
from assoc_hull.geometry.tensor_bernstein import basis

__all__ = ["CurvatureNodes", "curvature_nodes", "map_value"]

COUNT = 24
"""Nodes each way on a patch."""

_NO_NORMAL = 1e-9
"""Where |S| is below this part of its largest on the patch there is no normal."""


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
    bent: FloatArray
    other: FloatArray
    bending: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.place, self.normal, self.area, self.gauss)
        freeze(self.bent, self.other, self.bending)


def map_value(gauss: FloatArray, k0: float) -> FloatArray:
    """Give asinh(K/K0), which a continuous map shows: the band about 0 stays visible.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.surface.curvature_nodes import map_value
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
    place, ru, rv, ruu, ruv, rvv = _derivatives(patches, count)
    s = np.cross(ru, rv)
    size = np.sqrt(_dot(s, s))
    there = size > _NO_NORMAL * size.max(axis=(1, 2), keepdims=True)
    normal = _over(s, size, there)
    e, f = _dot(ru, ru), _dot(ru, rv)
    # Curvature in the orthonormal frame of r_u and what lies to its left.
    h11 = _over(_dot(normal, ruu), e, there)
    h12 = _over(_dot(normal, ruv) - f * h11, size, there)
    h22 = _over(_dot(normal, rvv) * e - f * (2.0 * size * h12 + f * h11), size**2, there)
    mean, half = 0.5 * (h11 + h22), 0.5 * np.hypot(h11 - h22, 2.0 * h12)
    angle = 0.5 * np.arctan2(2.0 * h12, h11 - h22) + np.where(mean < 0.0, 0.5 * np.pi, 0.0)
    ahead = _over(ru, np.sqrt(e), there)
    bending = np.cos(angle)[..., None] * ahead
    bending = bending + np.sin(angle)[..., None] * np.cross(normal, ahead)
    _, weight = lobatto(count)
    area = np.where(there, size, 0.0) * weight[:, None] * weight
    return CurvatureNodes(
        place, normal * area[..., None], area, h11 * h22 - h12**2,
        np.abs(mean) + half, np.abs(np.abs(mean) - half), bending,
    )  # fmt: skip


def _dot(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.asarray((a * b).sum(axis=-1))


def _over(a: FloatArray, b: FloatArray, where: np.typing.NDArray[np.bool_]) -> FloatArray:
    """Divide where it makes sense, and give 0 elsewhere."""
    if a.ndim > b.ndim:
        b, where = b[..., None], np.broadcast_to(where[..., None], a.shape)
    return np.asarray(np.divide(a, b, out=np.zeros_like(a), where=where))


def _derivatives(patches: Patches, count: int) -> tuple[FloatArray, ...]:
    """Give r, r_u, r_v, r_uu, r_uv, r_vv at the nodes, (k, q, q, 3) each."""
    r = patches.components
    if patches.weight is None:
        return tuple(np.moveaxis(each, 1, -1) for each in _grids(r, count))
    w = patches.weight[:, None]
    homogeneous = _grids(np.concatenate([r * w, w], axis=1), count)
    return _projected([np.moveaxis(each, 1, -1) for each in homogeneous])


def _grids(r: FloatArray, count: int) -> list[FloatArray]:
    """Evaluate coefficients (k, c, m + 1, n + 1) and their derivatives, (k, c, q, q) each."""
    ru, rv = u_derivative(r), v_derivative(r)
    second = u_derivative(ru), v_derivative(ru), v_derivative(rv)
    at, _ = lobatto(count)
    found = []
    for each in (r, ru, rv, *second):
        rows, columns = (basis(size - 1, at) for size in each.shape[-2:])
        found.append(np.asarray(rows @ each @ columns.T))
    return found


def _projected(homogeneous: list[FloatArray]) -> tuple[FloatArray, ...]:
    """Give points and derivatives of what has coordinates (w x, w y, w z, w)."""
    (r, ru, rv, ruu, ruv, rvv), (w, wu, wv, wuu, wuv, wvv) = (
        [each[..., part] for each in homogeneous] for part in (slice(3), slice(3, 4))
    )
    r = r / w
    ru, rv = (ru - wu * r) / w, (rv - wv * r) / w
    ruu = (ruu - 2.0 * wu * ru - wuu * r) / w
    ruv = (ruv - wu * rv - wv * ru - wuv * r) / w
    rvv = (rvv - 2.0 * wv * rv - wvv * r) / w
    return r, ru, rv, ruu, ruv, rvv
