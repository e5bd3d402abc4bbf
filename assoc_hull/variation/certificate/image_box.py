"""The box that a layer makes of a box: what encloses the image, for the layer after it."""

from __future__ import annotations

import math

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.intervals import Interval, minus, plus, times
from assoc_hull.variation.certificate.certify_breadth import half_breadths
from assoc_hull.variation.certificate.certify_corner import skew_box
from assoc_hull.variation.certificate.certify_layer import cells
from assoc_hull.variation.certificate.field_enclosures import enclose
from assoc_hull.variation.fields.additive import AdditiveLayer, Factors
from assoc_hull.variation.fields.corner import CornerLayer
from assoc_hull.variation.fields.fields_layer import FieldLayer
from assoc_hull.variation.fields.layer import Layer
from assoc_hull.variation.fields.shear import DeadriseLayer

__all__ = ["image_box"]

_PARTS = 8
"""Every cell is looked at in so many parts a side: bounds of sums become sharper."""


def image_box(layer: Layer, box: FloatArray) -> FloatArray:
    """Enclose the image of a box, (2, 3), m, by a box.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.piecewise_linear import Chain
    >>> from assoc_hull.variation.fields.field import Field, Piece, stack
    >>> from assoc_hull.variation.fields.fields_layer import FieldLayer
    >>> from assoc_hull.variation.certificate.image_box import image_box
    >>> longer = Piece.along(Chain.constant(1.0), 0.02, 0.0)
    >>> layer = FieldLayer("longer", (Field("x", "x", stack(["base"], [0.0]), (longer,)),))
    >>> image_box(layer, np.array([[0.0, -20, 0], [200, 20, 30]])).round(9).tolist()
    [[0.0, -20.0, 0.0], [204.0, 20.0, 30.0]]
    """
    if isinstance(layer, FieldLayer):
        return _of_fields(layer, box)
    if isinstance(layer, CornerLayer):
        return _of_corner(layer, box)
    if isinstance(layer, DeadriseLayer):
        return _of_shear(layer, box)
    assert isinstance(layer, AdditiveLayer)
    return _of_additive(layer, box)


def _parted(low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Part boxes (m, k) into equal ones."""
    k = low.shape[1]
    step = np.array(list(np.ndindex(*(_PARTS,) * k)))
    size = (high - low)[:, None, :] / _PARTS
    first = low[:, None, :] + step[None, :, :] * size
    return first.reshape(-1, k), (first + size).reshape(-1, k)


def _around(x: Interval, y: Interval, z: Interval) -> FloatArray:
    """Give the box around intervals of x, of the half-breadth and of z."""
    side = float(max(y[1].max(), -y[0].min()))
    return np.array(
        [
            [float(x[0].min()), -side, float(z[0].min())],
            [float(x[1].max()), side, float(z[1].max())],
        ]
    )


def _of_fields(layer: FieldLayer, box: FloatArray) -> FloatArray:
    lower, upper = _parted(*cells(layer.fields, box))
    x, z = (lower[:, 0], upper[:, 0]), (lower[:, 1], upper[:, 1])
    out = half_breadths(box)
    y = np.full(len(lower), out[0]), np.full(len(lower), out[1])
    wide = y
    for field in layer.fields:
        found = enclose(field, lower, upper)
        if field.axis == "x":
            x = plus(x, found.u)
        elif field.axis == "z":
            z = plus(z, found.u)
        else:
            # psi lies between nil and the half-breadth
            wide = plus(wide, times(found.own, (np.zeros(len(lower)), y[1])))
    return _around(x, wide, z)


def _of_corner(layer: CornerLayer, box: FloatArray) -> FloatArray:
    spans = np.array(skew_box(layer, box))
    lower, upper = _parted(spans[None, :, 0], spans[None, :, 1])
    eta, zeta = (lower[:, 0], upper[:, 0]), (lower[:, 1], upper[:, 1])
    course = layer.course.bounds(box[:1, 0], box[1:, 0])
    weight = times(course, times(layer.fade.bounds(*eta), layer.fade.bounds(*zeta)))
    new = []
    for ratio, part in ((layer.eta_ratio, eta), (layer.zeta_ratio, zeta)):
        size = np.array([ratio - 1.0])
        new.append(plus(part, times(times((size, size), weight), part)))
    cos, sin = (np.array([part(layer.rise)]) for part in (math.cos, math.sin))
    corner = np.array([layer.y]), np.array([layer.z])
    y = minus((corner[0], corner[0]), times((cos, cos), new[0]))
    z = minus(plus((corner[1], corner[1]), new[1]), times((sin, sin), new[0]))
    inner = half_breadths(box)
    return _around((box[:1, 0], box[1:, 0]), (np.minimum(y[0], inner[0]), y[1]), z)


def _of_shear(layer: DeadriseLayer, box: FloatArray) -> FloatArray:
    lower, upper = _parted(box[:1, 2:], box[1:, 2:])
    z = lower[:, 0], upper[:, 0]
    ramp = layer.ramp(np.array(half_breadths(box)))[0] * layer.q
    lift = ramp.min(keepdims=True), ramp.max(keepdims=True)
    course = layer.course.bounds(box[:1, 0], box[1:, 0])
    z = plus(z, times(times(course, lift), layer.fade.bounds(*z)))
    return _around((box[:1, 0], box[1:, 0]), (box[:1, 1], box[1:, 1]), z)


def _of_additive(layer: AdditiveLayer, box: FloatArray) -> FloatArray:
    out = half_breadths(box)
    spans = np.array([box[:, 0], out, box[:, 2]])
    lower, upper = _parted(spans[None, :, 0], spans[None, :, 1])
    x, y, z = ((lower[:, axis], upper[:, axis]) for axis in range(3))
    sides = x, y, z
    if layer.x is not None:
        x = plus(x, layer.x.bounds(*x))
    if layer.y is not None:
        y = plus(y, _product(layer.y, sides))
    if layer.z is not None:
        z = plus(z, _product(layer.z, sides))
    return _around(x, y, z)


def _product(factors: Factors, sides: tuple[Interval, Interval, Interval]) -> Interval:
    first, second, third = (part.bounds(*side) for part, side in zip(factors, sides, strict=True))
    return times(times(first, second), third)
