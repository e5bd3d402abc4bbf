"""Least principal minors of the corner, deadrise and additive layers.

In each kind some coordinates stay, so few minors are left to check; their formulas stand above the
functions. Where a minor is a product of functions of one coordinate the exact bounds of these are
enough; else polynomials or boxes are searched as for fields.
"""

from __future__ import annotations

import math
from itertools import pairwise, product

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.intervals import (
    Interval,
    interval_difference,
    interval_product,
    interval_sum,
)
from assoc_hull.variation.certificate.field_minors import half_breadths, search_boxes
from assoc_hull.variation.certificate.minor_search import LeastMinor, Minor, find_least_minor
from assoc_hull.variation.fields.bounded_functions import BoundedFunction
from assoc_hull.variation.fields.layers import AdditiveLayer, CornerLayer, DeadriseLayer, Factors

__all__ = [
    "additive_minors",
    "corner_minors",
    "shear_minors",
    "skew_box",
]

# --------------------------------------------------------------------------------------
# Corner layer: in the skew coordinates along bottom (eta) and side (zeta) it stretches both by a
# product of fades, and x stays. With A along the ship, the fades c and k, and p and q the ratios
# less one, the minors of eta, of zeta and of both are polynomials of A, eta and zeta:
#
#     1 + p A k (c + eta c'),   1 + q A c (k + zeta k'),
#     their product less p q A^2 (eta c k') (zeta k c')

_PLACES = 2000
"""Places along the ship, to find where A has a value."""

_ZOOMS = 4
_FINER = np.linspace(-1.0, 1.0, 41)


def skew_box(layer: CornerLayer, box: FloatArray) -> tuple[tuple[float, float], ...]:
    """Give least and greatest eta and zeta, m, of a box."""
    low, high = half_breadths(box)
    inward = layer.y - high, layer.y - low
    lift = sorted(each * math.tan(layer.rise) for each in inward)
    eta = inward[0] / math.cos(layer.rise), inward[1] / math.cos(layer.rise)
    return eta, (float(box[0, 2]) - layer.z + lift[0], float(box[1, 2]) - layer.z + lift[1])


def corner_minors(layer: CornerLayer, box: FloatArray, margin: float) -> list[LeastMinor]:
    """Give the least value of every principal minor, and a fold at the centre plane if any."""
    found = [find_least_minor(each, margin) for each in _minors(layer, box)]
    centre = _centre(layer, box)
    return found if centre is None else [*found, centre]


def _minors(layer: CornerLayer, box: FloatArray) -> list[Minor]:
    """Give Y_y, Z_z and D over the parameters A, eta and zeta, which vary independently."""
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
    """Give both entries of the diagonal, and the product of the other two."""
    a, eta, zeta = parameters.T
    c, c_eta = layer.fade.at(eta), layer.fade.slope(eta)
    k, k_zeta = layer.fade.at(zeta), layer.fade.slope(zeta)
    p, q = (layer.eta_ratio - 1.0) * a, (layer.zeta_ratio - 1.0) * a
    across = p * q * (eta * c * k_zeta) * (zeta * k * c_eta)
    return 1.0 + p * k * (c + eta * c_eta), 1.0 + q * c * (k + zeta * k_zeta), across


def _place(layer: CornerLayer, box: FloatArray, parameters: FloatArray) -> FloatArray:
    """Give the places (n, 3), m, of parameters A, eta, zeta; any x that has that A."""
    a, eta, zeta = parameters.T
    inward = eta * math.cos(layer.rise)
    z = zeta + layer.z - inward * math.tan(layer.rise)
    return np.stack([_along(layer.course, box[:, 0], a), layer.y - inward, z], axis=1)


def _along(course: BoundedFunction, span: FloatArray, a: FloatArray) -> FloatArray:
    """Find x, m, where a function along the ship has given values (n,), on ever finer grids."""
    every = np.append(np.linspace(span[0], span[1], _PLACES), np.clip(course.nodes, *span))
    x = np.broadcast_to(every, (len(a), len(every)))
    reach = float(span[1] - span[0]) / _PLACES
    found = _nearest(course, x, a)
    for _ in range(_ZOOMS):
        found = _nearest(course, np.clip(found[:, None] + reach * _FINER, *span), a)
        reach *= 2.0 / (len(_FINER) - 1)
    return found


def _nearest(course: BoundedFunction, x: FloatArray, a: FloatArray) -> FloatArray:
    """Choose of places (n, m) those, (n,), whose values are nearest to given ones."""
    chosen = np.abs(course.at(x) - a[:, None]).argmin(axis=1)
    return np.asarray(x[np.arange(len(a)), chosen])


def _centre(layer: CornerLayer, box: FloatArray) -> LeastMinor | None:
    """Give a fold (minus infinity) where the layer moves the centre plane off itself; else None."""
    low, _ = half_breadths(box)
    reach = layer.y / math.cos(layer.rise)
    if low > 0.0 or layer.eta_ratio == 1.0 or float(layer.fade.at(np.array([reach]))[0]) == 0.0:
        return None
    least, most = layer.course.bounds(box[0, :1], box[1, :1])
    if float(least[0]) == float(most[0]) == 0.0:
        return None
    x = float(_along(layer.course, box[:, 0], np.where(most > -least, most, least))[0])
    return LeastMinor("Y_y", -math.inf, -math.inf, (x, 0.0, layer.z), 1, 0)


# --------------------------------------------------------------------------------------
# Deadrise layer: heights alone move, so Z_z = 1 + A(x) q r(y) c'(z) is all there is to check: a
# product of functions of one coordinate each, with exact bounds.

_WITNESS_PLACES = 101
"""Looked at along either coordinate for a witness; the bound does not depend on them."""


def shear_minors(layer: DeadriseLayer, box: FloatArray) -> list[LeastMinor]:
    """Give the least Z_z, and a place that has it."""
    y = np.array(half_breadths(box))
    out = np.stack([np.zeros(2), y, np.zeros(2)], axis=1)
    ramp = layer.ramp(out[:, 1])[0]
    along = layer.course.bounds(box[:1, 0], box[1:, 0])
    fall = layer.fade.slope_bounds(box[:1, 2], box[1:, 2])
    lift = layer.q * ramp[:1], layer.q * ramp[1:]
    one = np.ones(1), np.ones(1)
    bound = float(
        interval_sum(one, interval_product(interval_product(along, _ordered(*lift)), fall))[0][0]
    )
    x, z = _places(layer.course, box[:, 0]), _places(layer.fade, box[:, 2])
    grid = np.stack(np.meshgrid(x, y, z, indexing="ij"), axis=-1).reshape(-1, 3)
    minor = layer.jacobian(grid)[:, 2, 2]
    least = int(minor.argmin())
    where = float(grid[least, 0]), float(grid[least, 1]), float(grid[least, 2])
    return [LeastMinor("Z_z", float(minor[least]), min(bound, float(minor[least])), where, 1, 0)]


def _ordered(one: FloatArray, other: FloatArray) -> tuple[FloatArray, FloatArray]:
    return np.minimum(one, other), np.maximum(one, other)


def _places(course: BoundedFunction, span: FloatArray) -> FloatArray:
    """Give places near which a function has its extremes: ends, nodes, middles between, a grid."""
    nodes = course.nodes
    middles = 0.5 * (nodes[1:] + nodes[:-1])
    others = np.linspace(span[0], span[1], _WITNESS_PLACES)
    return np.unique(np.clip(np.concatenate([others, nodes, middles]), *span))


# --------------------------------------------------------------------------------------
# Additive layer: the Jacobian has an x of its own and a block of y and z,
#
#     1 + F1'                        at the place x
#     [1 + F2 F3' F4    F2 F3 F4']
#     [F5 F6' F7    1 + F5 F6 F7']   at the place (x, |y|, z)
#
# so the principal minors are 1 + F1', both entries of the block's diagonal and its determinant.
# Each F has exact bounds on an interval; the box is divided where their pieces join, and further
# where bounds do not decide.


def additive_minors(layer: AdditiveLayer, box: FloatArray, margin: float) -> list[LeastMinor]:
    """Give the least value of every principal minor that is not 1 throughout."""
    cells = _cells(layer, box)
    names = [] if layer.x is None else ["X_x"]
    names += [] if layer.y is None else ["Y_y"]
    names += [] if layer.z is None else ["Z_z"]
    if layer.y is not None and layer.z is not None:
        names.append("D")
    return [_minor(layer, name, cells, margin) for name in names]


def _minor(layer: AdditiveLayer, name: str, cells: Interval, margin: float) -> LeastMinor:
    """Search a minor on boxes of x, half-breadth and z."""

    def lows(lower: FloatArray, upper: FloatArray) -> FloatArray:
        return _enclosed(layer, name, lower, upper)[0]

    def values(places: FloatArray) -> FloatArray:
        j = layer.jacobian(places)
        if name == "D":
            return np.asarray(j[:, 1, 1] * j[:, 2, 2] - j[:, 1, 2] * j[:, 2, 1])
        axis = ("X_x", "Y_y", "Z_z").index(name)
        return np.asarray(j[:, axis, axis])

    least, bound, where, boxes, splits = search_boxes(lows, values, cells, margin)
    x, y, z = where.tolist()
    return LeastMinor(name, least, min(bound, least), (x, y, z), boxes, splits)


def _cells(layer: AdditiveLayer, box: FloatArray) -> Interval:
    """Divide the port half of a box at the nodes of the functions."""
    low, high = half_breadths(box)
    sides = (box[0, 0], box[1, 0]), (low, high), (box[0, 2], box[1, 2])
    parts = []
    for axis, span in enumerate(sides):
        courses = [each[axis] for each in (layer.y, layer.z) if each is not None]
        if axis == 0 and layer.x is not None:
            courses.append(layer.x)
        nodes = np.concatenate([span, *(each.nodes for each in courses)])
        edges = np.unique(np.clip(nodes, *span)).tolist()
        parts.append(list(pairwise(edges)) if len(edges) > 1 else [span])
    cells = np.array(list(product(*parts)), np.float64)
    return cells[:, :, 0], cells[:, :, 1]


def _enclosed(layer: AdditiveLayer, name: str, lower: FloatArray, upper: FloatArray) -> Interval:
    """Enclose a minor on boxes."""
    one = np.ones(len(lower)), np.ones(len(lower))
    if name == "X_x":
        if layer.x is None:
            return one
        return interval_sum(one, layer.x.slope_bounds(lower[:, 0], upper[:, 0]))
    y_y, y_z = _slopes(layer.y, lower, upper)
    z_y, z_z = _slopes(layer.z, lower, upper)
    along, up = interval_sum(one, y_y), interval_sum(one, z_z)
    if name == "Y_y":
        return along
    return (
        up
        if name == "Z_z"
        else interval_difference(interval_product(along, up), interval_product(y_z, z_y))
    )


def _slopes(
    factors: Factors | None, lower: FloatArray, upper: FloatArray
) -> tuple[Interval, Interval]:
    """Enclose the derivatives of a product by half-breadth and by z."""
    if factors is None:
        zero = np.zeros(len(lower)), np.zeros(len(lower))
        return zero, zero
    first, second, third = (
        course.bounds(lower[:, axis], upper[:, axis]) for axis, course in enumerate(factors)
    )
    by_y, by_z = (factors[axis].slope_bounds(lower[:, axis], upper[:, axis]) for axis in (1, 2))
    return interval_product(interval_product(first, by_y), third), interval_product(
        interval_product(first, second), by_z
    )
