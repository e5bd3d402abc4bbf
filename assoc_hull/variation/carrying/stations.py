"""Where the stations of a net go: by what a map moves along the ship alike at all heights."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.state import HullState
from assoc_hull.variation.fields.additive import AdditiveLayer
from assoc_hull.variation.fields.field import Field
from assoc_hull.variation.fields.fields_layer import FieldLayer
from assoc_hull.variation.fields.layer import Layer

__all__ = ["section_planes", "stations_along"]


def stations_along(layers: Iterable[Layer], x: FloatArray) -> FloatArray:
    """Carry stations by the part of a map that keeps their planes.

    A field that lengthens the bulb bends the planes of sections through it; one that lengthens
    the ship does not. A section that both act on is cut again where the second sends it, so that
    it keeps its place among the others.

    Parameters
    ----------
    layers : iterable of Layer
        The map.
    x : (n,), m
        Stations before, forward from AP.

    Returns
    -------
    (n,), m
        Stations after.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.piecewise_linear import Chain
    >>> from assoc_hull.variation.fields.field import Boundary, Field, Piece
    >>> from assoc_hull.variation.fields.fields_layer import FieldLayer
    >>> from assoc_hull.variation.carrying.stations import stations_along
    >>> base = Boundary("base", Chain.constant(0.0))
    >>> by = Piece.along(Chain.constant(1.0), 0.02, 0.0)
    >>> longer = Field("length", "x", (base,), (by,))
    >>> stations_along([FieldLayer("size", (longer,))], np.array([0.0, 50.0])).tolist()
    [0.0, 51.0]
    """
    for layer in layers:
        x = x + _moved(layer, x)
    return x


def _moved(layer: Layer, x: FloatArray) -> FloatArray:
    """Give by how much a layer moves whole planes, (n,), m."""
    moved = np.zeros_like(x)
    if isinstance(layer, AdditiveLayer) and layer.x is not None:
        moved += layer.x.at(x)
    elif isinstance(layer, FieldLayer):
        places = np.zeros((len(x), 3))
        places[:, 0] = x
        for field in layer.fields:
            if field.axis == "x" and isinstance(field, Field) and len(field.pieces) == 1:
                moved += field.displacement(places)
    return moved


def section_planes(state: HullState, layers: Iterable[Layer]) -> dict[int, float]:
    """Give where the planes of sections go, by the number of the line, m from AP.

    Parameters
    ----------
    state : HullState
        The tables.
    layers : iterable of Layer
        The map.
    """
    lines = [
        line for line in state.live("lines").tolist()
        if state.family(line).axis == 0 and state.lines.boundary.data[line] < 0
        and state.lines.planar.data[line]
    ]  # fmt: skip
    after = stations_along(layers, state.lines.offset.data[lines])
    return dict(zip(lines, after.tolist(), strict=True))
