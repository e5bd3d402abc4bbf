"""Points of patches with derivatives: what every quantity of a surface at a point is made of.

Derivatives come from the control points by the rule of de Casteljau, taken from a corner of the
patch, so that it costs no digits to be 100 m away from the origin.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.patches import Patches
>>> from assoc_hull.geometry.patches.pointwise import jets
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0], net[:, 1, 1], net[1, 1, 2] = 2.0, 1.0, 1.0
>>> found = jets(Patches.single(net), np.array([0]), np.array([[0.5, 0.5]]))
>>> found.r, found.element.round(6)
(array([[1.  , 0.5 , 0.25]]), array([2.291288]))
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.patches import Patches

__all__ = ["Jets", "inner", "jets"]


def inner(a: FloatArray, b: FloatArray) -> FloatArray:
    """Give scalar products of vectors (p, 3), (p,), each added in the same order."""
    return np.asarray(a[:, 0] * b[:, 0] + a[:, 1] * b[:, 1] + a[:, 2] * b[:, 2])


@attrs.frozen(eq=False)
class Jets:
    """Points of patches and derivatives there.

    Attributes
    ----------
    r : (p, 3), m
        Points.
    ru, rv : (p, 3), m
        First derivatives with respect to the parameters of the patch, 0 to 1.
    ruu, ruv, rvv : (p, 3), m
        Second derivatives.
    """

    r: FloatArray
    ru: FloatArray
    rv: FloatArray
    ruu: FloatArray
    ruv: FloatArray
    rvv: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.r, self.ru, self.rv, self.ruu, self.ruv, self.rvv)

    @property
    def s(self) -> FloatArray:
        """The normal S = r_u x r_v, not of unit length, (p, 3), m2."""
        return np.cross(self.ru, self.rv)

    @property
    def element(self) -> FloatArray:
        """The area of the surface for a unit of parameters, |S|, (p,), m2."""
        return np.asarray(np.sqrt(inner(self.s, self.s)))


def _along(a: FloatArray, t: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give values and two derivatives of Bezier polygons (p, d + 1, ...) at parameters (p,)."""
    degree = a.shape[1] - 1
    t = t.reshape(-1, 1, *(1,) * (a.ndim - 2))
    while a.shape[1] > 3:
        a = (1.0 - t) * a[:, :-1] + t * a[:, 1:]
    second = np.zeros_like(a[:, 0])
    if degree > 1:
        second = degree * (degree - 1) * ((a[:, 2] - a[:, 1]) - (a[:, 1] - a[:, 0]))
        a = (1.0 - t) * a[:, :-1] + t * a[:, 1:]
    first = degree * (a[:, 1] - a[:, 0])
    return (1.0 - t[:, 0]) * a[:, 0] + t[:, 0] * a[:, 1], first, second


def jets(patches: Patches, row: IntArray, uv: FloatArray) -> Jets:
    """Give points of patches and derivatives there.

    Parameters
    ----------
    patches : Patches
        The patches, polynomial or rational.
    row : (p,) int
        The patch of each point.
    uv : (p, 2)
        Parameters in the patch, 0 to 1.

    Returns
    -------
    Jets
        Points and derivatives; those of a point do not depend on the others, to the last bit.
    """
    local = patches.net[row]
    corner = local[:, 0, 0]
    local = local - corner[:, None, None]
    if patches.weight is not None:
        weight = patches.weight[row][..., None]
        local = np.concatenate([local * weight, weight], axis=-1)
    u, v = uv[:, 0], uv[:, 1]
    in_u = np.stack(_along(local, u), axis=2)
    (r, ru, ruu), (rv, ruv, _), (rvv, _, _) = (np.moveaxis(each, 1, 0) for each in _along(in_u, v))
    if patches.weight is not None:
        r, ru, rv, ruu, ruv, rvv = _quotients(r, ru, rv, ruu, ruv, rvv)
    return Jets(r + corner, ru, rv, ruu, ruv, rvv)


def _quotients(*homogeneous: FloatArray) -> tuple[FloatArray, ...]:
    """Divide weighted points by their weights, with derivatives: each (p, 4) gives (p, 3)."""
    (r, ru, rv, ruu, ruv, rvv), (w, wu, wv, wuu, wuv, wvv) = (
        [each[:, part] for each in homogeneous] for part in (slice(3), slice(3, 4))
    )
    r = r / w
    ru, rv = (ru - wu * r) / w, (rv - wv * r) / w
    ruu = (ruu - 2.0 * wu * ru - wuu * r) / w
    ruv = (ruv - wu * rv - wv * ru - wuv * r) / w
    rvv = (rvv - 2.0 * wv * rv - wvv * r) / w
    return r, ru, rv, ruu, ruv, rvv
