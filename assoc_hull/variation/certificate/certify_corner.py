"""The minors of a corner layer: polynomials of the fade along the ship, of eta and of zeta.

In the skew coordinates along bottom and side the layer stretches both by a product of fades, and
x stays. So of the principal minors there are those of eta, of zeta and of both; with the course
A, the fades c and k, and p and q the ratios less one,

    1 + p A k (c + eta c'),   1 + q A c (k + zeta k'),
    their product less p q A^2 (eta c k') (zeta k c')
"""

from __future__ import annotations

import math
from itertools import pairwise, product

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.certificate.certify_breadth import half_breadths
from assoc_hull.variation.certificate.minor_search import Found, Minor, search
from assoc_hull.variation.fields.corner import CornerLayer
from assoc_hull.variation.fields.piecewise_linear import Course

__all__ = ["corner_minors", "skew_box"]

_PLACES = 2000
"""Along the ship, to find where the course has a value."""

_ZOOMS = 4
_FINER = np.linspace(-1.0, 1.0, 41)


def skew_box(layer: CornerLayer, box: FloatArray) -> tuple[tuple[float, float], ...]:
    """Give least and greatest eta and zeta of a box."""
    low, high = half_breadths(box)
    inward = layer.y - high, layer.y - low
    lift = sorted(each * math.tan(layer.rise) for each in inward)
    eta = inward[0] / math.cos(layer.rise), inward[1] / math.cos(layer.rise)
    return eta, (float(box[0, 2]) - layer.z + lift[0], float(box[1, 2]) - layer.z + lift[1])


def corner_minors(layer: CornerLayer, box: FloatArray, margin: float) -> list[Found]:
    """Give the least value of every principal minor, and of the grip at the centre plane."""
    found = [search(each, margin) for each in _minors(layer, box)]
    centre = _centre(layer, box)
    return found if centre is None else [*found, centre]


def _minors(layer: CornerLayer, box: FloatArray) -> list[Minor]:
    low, high = layer.course.bounds(box[0, :1], box[1, :1])
    spans = [(float(low[0]), float(high[0])), *skew_box(layer, box)]
    parts = [[spans[0]]]
    for span in spans[1:]:
        ends = np.unique(np.clip([*span, *layer.fade.nodes], *span)).tolist()
        parts.append(list(pairwise(ends)) if len(ends) > 1 else [span])
    cells = np.array(list(product(*parts)))
    n = layer.fade.degree
    single, double = (1, n, n), (2, 2 * n, 2 * n)

    def along(parameters: FloatArray) -> FloatArray:
        return _derivatives(layer, parameters)[0]

    def up(parameters: FloatArray) -> FloatArray:
        return _derivatives(layer, parameters)[1]

    def both(parameters: FloatArray) -> FloatArray:
        one, other, across = _derivatives(layer, parameters)
        return one * other - across

    def place(parameters: FloatArray) -> FloatArray:
        return _place(layer, box, parameters)

    chosen = (("Y_y", single, along), ("Z_z", single, up), ("D", double, both))
    return [
        Minor(name, cells[:, :, 0], cells[:, :, 1], degrees, at, place)
        for name, degrees, at in chosen
    ]


def _derivatives(
    layer: CornerLayer, parameters: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give both entries of the diagonal, and the product of the others."""
    a, eta, zeta = parameters.T
    c, c_eta = layer.fade.at(eta), layer.fade.slope(eta)
    k, k_zeta = layer.fade.at(zeta), layer.fade.slope(zeta)
    p, q = (layer.eta_ratio - 1.0) * a, (layer.zeta_ratio - 1.0) * a
    across = p * q * (eta * c * k_zeta) * (zeta * k * c_eta)
    return 1.0 + p * k * (c + eta * c_eta), 1.0 + q * c * (k + zeta * k_zeta), across


def _place(layer: CornerLayer, box: FloatArray, parameters: FloatArray) -> FloatArray:
    a, eta, zeta = parameters.T
    inward = eta * math.cos(layer.rise)
    z = zeta + layer.z - inward * math.tan(layer.rise)
    return np.stack([_along(layer.course, box[:, 0], a), layer.y - inward, z], axis=1)


def _along(course: Course, span: FloatArray, a: FloatArray) -> FloatArray:
    """Find where a course has given values (n,), on ever finer grids."""
    every = np.append(np.linspace(span[0], span[1], _PLACES), np.clip(course.nodes, *span))
    x = np.broadcast_to(every, (len(a), len(every)))
    reach = float(span[1] - span[0]) / _PLACES
    found = _nearest(course, x, a)
    for _ in range(_ZOOMS):
        found = _nearest(course, np.clip(found[:, None] + reach * _FINER, *span), a)
        reach *= 2.0 / (len(_FINER) - 1)
    return found


def _nearest(course: Course, x: FloatArray, a: FloatArray) -> FloatArray:
    """Choose of places (n, m) those, (n,), whose values are nearest to given ones."""
    chosen = np.abs(course.at(x) - a[:, None]).argmin(axis=1)
    return np.asarray(x[np.arange(len(a)), chosen])


def _centre(layer: CornerLayer, box: FloatArray) -> Found | None:
    """Tell that the layer pulls the centre plane apart, or across itself."""
    low, _ = half_breadths(box)
    reach = layer.y / math.cos(layer.rise)
    if low > 0.0 or layer.eta_ratio == 1.0 or float(layer.fade.at(np.array([reach]))[0]) == 0.0:
        return None
    least, most = layer.course.bounds(box[0, :1], box[1, :1])
    if float(least[0]) == float(most[0]) == 0.0:
        return None
    x = float(_along(layer.course, box[:, 0], np.where(most > -least, most, least))[0])
    return Found("Y_y", -math.inf, -math.inf, (x, 0.0, layer.z), 1, 0)
