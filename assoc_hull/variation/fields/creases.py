"""Where the pieces of a layer join: functions of the place that change sign there.

Between its creases a layer is a smooth function without narrow parts, which is what a search
for roots along a curve needs to know.
"""

from __future__ import annotations

from typing import Protocol, runtime_checkable

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.corner import CornerLayer
from assoc_hull.variation.fields.field import Field, Piece, Tube
from assoc_hull.variation.fields.fields_layer import FieldLayer, Rake
from assoc_hull.variation.fields.layer import Layer
from assoc_hull.variation.fields.shear import DeadriseLayer

__all__ = ["Creased", "creases"]


@runtime_checkable
class Creased(Protocol):
    """A layer of another kind that says itself where its pieces join."""

    def creases(self, xyz: FloatArray) -> FloatArray:
        """Give functions of places (n, 3), m, that are nil on the creases, (n, k)."""
        ...


def creases(layer: Layer, xyz: FloatArray) -> FloatArray:
    """Give functions of places that are nil where pieces of a layer join.

    Parameters
    ----------
    layer : Layer
    xyz : (n, 3), m
        Places before the layer.

    Returns
    -------
    (n, k), m
        One column a crease; none for a layer of unknown kind.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.piecewise_linear import Chain
    >>> from assoc_hull.variation.fields.creases import creases
    >>> from assoc_hull.variation.fields.fields_layer import FieldLayer, Rake
    >>> rake = Rake("rake", Chain.through([200, 230], [0, 1]), 0.05, 11.0, 3.0)
    >>> creases(FieldLayer("stem", (rake,)), np.array([[210.0, 0.0, 12.0]])).tolist()
    [[10.0, -20.0, 1.0, -2.0]]
    """
    if isinstance(layer, FieldLayer):
        return _joined(xyz, [part for field in layer.fields for part in _field(field, xyz)])
    if isinstance(layer, CornerLayer):
        return _joined(xyz, _corner(layer, xyz))
    if isinstance(layer, DeadriseLayer):
        out = np.abs(xyz[:, 1]) - layer.keel
        parts = [_less(xyz[:, 0], layer.course.nodes), _less(xyz[:, 2], layer.fade.nodes)]
        return _joined(xyz, [*parts, _less(out, np.unique([0.0, layer.width]))])
    return layer.creases(xyz) if isinstance(layer, Creased) else _joined(xyz, [])


def _less(value: FloatArray, places: FloatArray) -> FloatArray:
    found: FloatArray = value[:, None] - places
    return found


def _joined(xyz: FloatArray, parts: list[FloatArray]) -> FloatArray:
    return np.concatenate([np.zeros((len(xyz), 0)), *parts], axis=1)


def _field(field: Field | Rake, xyz: FloatArray) -> list[FloatArray]:
    x, z = xyz[:, 0], xyz[:, 2]
    if isinstance(field, Rake):
        ramp = np.array([field.z0, field.z0 + field.w])
        return [_less(x, field.course.nodes), _less(z, ramp)]
    nodes = np.unique(np.concatenate([part for each in field.pieces for part in _nodes(each)]))
    heights = np.stack([each.height.at(x) for each in field.boundaries], axis=1)
    tube = [_less(np.abs(xyz[:, 1]), _radii(field.tube))] if field.tube else []
    return [_less(x, nodes), z[:, None] - heights, *tube]


def _nodes(piece: Piece) -> list[FloatArray]:
    return [piece.a.nodes, piece.d.nodes]


def _radii(tube: Tube) -> FloatArray:
    return np.array([tube.radius, tube.n * tube.radius])


def _corner(layer: CornerLayer, xyz: FloatArray) -> list[FloatArray]:
    _, eta, zeta = layer.skew(xyz)
    fade = layer.fade.nodes
    return [_less(xyz[:, 0], layer.course.nodes), _less(eta, fade), _less(zeta, fade)]
