"""The minor of a deadrise layer: heights alone move, so Z_z is all there is to check.

``Z_z = 1 + A(x) q r(y) c'(z)`` is a product of functions of one coordinate each, whose exact
bounds give exact bounds of it.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.intervals import plus, times
from assoc_hull.variation.certificate.certify_breadth import half_breadths
from assoc_hull.variation.certificate.minor_search import Found
from assoc_hull.variation.fields.piecewise_linear import Course
from assoc_hull.variation.fields.shear import DeadriseLayer

__all__ = ["shear_minors"]

_PLACES = 101
"""Looked at along either coordinate for a witness; the bound does not depend on them."""


def shear_minors(layer: DeadriseLayer, box: FloatArray) -> list[Found]:
    """Give the least Z_z, and a place that has it."""
    y = np.array(half_breadths(box))
    out = np.stack([np.zeros(2), y, np.zeros(2)], axis=1)
    ramp = layer.ramp(out[:, 1])[0]
    along = layer.course.bounds(box[:1, 0], box[1:, 0])
    fall = layer.fade.slope_bounds(box[:1, 2], box[1:, 2])
    lift = layer.q * ramp[:1], layer.q * ramp[1:]
    one = np.ones(1), np.ones(1)
    bound = float(plus(one, times(times(along, _ordered(*lift)), fall))[0][0])
    x, z = _places(layer.course, box[:, 0]), _places(layer.fade, box[:, 2])
    grid = np.stack(np.meshgrid(x, y, z, indexing="ij"), axis=-1).reshape(-1, 3)
    minor = layer.jacobian(grid)[:, 2, 2]
    least = int(minor.argmin())
    where = float(grid[least, 0]), float(grid[least, 1]), float(grid[least, 2])
    return [Found("Z_z", float(minor[least]), min(bound, float(minor[least])), where, 1, 0)]


def _ordered(one: FloatArray, other: FloatArray) -> tuple[FloatArray, FloatArray]:
    return np.minimum(one, other), np.maximum(one, other)


def _places(course: Course, span: FloatArray) -> FloatArray:
    """Give places near which a course has its extremes: ends, nodes, middles between, others."""
    nodes = course.nodes
    middles = 0.5 * (nodes[1:] + nodes[:-1])
    others = np.linspace(span[0], span[1], _PLACES)
    return np.unique(np.clip(np.concatenate([others, nodes, middles]), *span))
