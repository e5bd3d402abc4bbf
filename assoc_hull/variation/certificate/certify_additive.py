"""The minors of a layer of additive functions: one of x alone, and three of all coordinates.

The Jacobian has an x of its own and a block of y and z,

    1 + F1'                        at the place x
    [1 + F2 F3' F4    F2 F3 F4']
    [F5 F6' F7    1 + F5 F6 F7']   at the place (x, |y|, z)

so the principal minors are positive if 1 + F1', both entries of the block's diagonal and its
determinant are. Each F has exact bounds on an interval; the box is parted where their pieces join,
and further where bounds do not decide.
"""

from __future__ import annotations

from itertools import pairwise, product

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.intervals import Interval, minus, plus, times
from assoc_hull.variation.certificate.certify_boxes import search_boxes
from assoc_hull.variation.certificate.certify_breadth import half_breadths
from assoc_hull.variation.certificate.minor_search import Found
from assoc_hull.variation.fields.additive import AdditiveLayer, Factors

__all__ = ["additive_minors"]


def additive_minors(layer: AdditiveLayer, box: FloatArray, margin: float) -> list[Found]:
    """Give the least value of every principal minor that is not 1 throughout."""
    cells = _cells(layer, box)
    names = [] if layer.x is None else ["X_x"]
    names += [] if layer.y is None else ["Y_y"]
    names += [] if layer.z is None else ["Z_z"]
    if layer.y is not None and layer.z is not None:
        names.append("D")
    return [_minor(layer, name, cells, margin) for name in names]


def _minor(layer: AdditiveLayer, name: str, cells: Interval, margin: float) -> Found:
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
    return Found(name, least, min(bound, least), (x, y, z), boxes, splits)


def _cells(layer: AdditiveLayer, box: FloatArray) -> Interval:
    """Part the port half of a box where pieces of the functions join."""
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
        return plus(one, layer.x.slope_bounds(lower[:, 0], upper[:, 0]))
    y_y, y_z = _slopes(layer.y, lower, upper)
    z_y, z_z = _slopes(layer.z, lower, upper)
    along, up = plus(one, y_y), plus(one, z_z)
    if name == "Y_y":
        return along
    return up if name == "Z_z" else minus(times(along, up), times(y_z, z_y))


def _slopes(
    factors: Factors | None, lower: FloatArray, upper: FloatArray
) -> tuple[Interval, Interval]:
    """Enclose the derivatives of a product by half-breadth and by z."""
    if factors is None:
        nil = np.zeros(len(lower)), np.zeros(len(lower))
        return nil, nil
    first, second, third = (
        course.bounds(lower[:, axis], upper[:, axis]) for axis, course in enumerate(factors)
    )
    by_y, by_z = (factors[axis].slope_bounds(lower[:, axis], upper[:, axis]) for axis in (1, 2))
    return times(times(first, by_y), third), times(times(first, second), by_z)
