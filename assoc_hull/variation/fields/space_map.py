"""The map of a variation: layers, one after the other."""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.field import Region
from assoc_hull.variation.fields.inverse import inverse
from assoc_hull.variation.fields.layer import Layer

__all__ = ["VMap"]


@attrs.frozen(eq=False)
class VMap:
    """Layers in the order in which they act.

    Attributes
    ----------
    layers : tuple of Layer

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.piecewise_linear import Chain
    >>> from assoc_hull.variation.fields.fields_layer import FieldLayer
    >>> from assoc_hull.variation.fields.hat import hat
    >>> from assoc_hull.variation.fields.space_map import VMap
    >>> fade = Chain.through([6, 66], [1, 0])
    >>> shaft = hat("shaft", [("base", 0, 0), ("shaft", 5, 1), ("T", 18, 0)], fade)
    >>> vmap = VMap((FieldLayer("local", (shaft,)),))
    >>> vmap(np.array([[6.0, 0.7, 5.0], [200.0, 20.0, 5.0]])).tolist()
    [[6.0, 0.7, 6.0], [200.0, 20.0, 5.0]]
    """

    layers: tuple[Layer, ...]

    def __call__(self, xyz: FloatArray) -> FloatArray:
        """Map places (n, 3), m; outside the regions they keep their bits."""
        for layer in self.layers:
            xyz = xyz + layer.displacement(xyz)
        return xyz

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        """Give the derivatives of the places after by those before, (n, 3, 3)."""
        found = np.tile(np.eye(3), (len(xyz), 1, 1))
        for layer in self.layers:
            found = (layer.jacobian(xyz)[:, :, :, None] * found[:, None, :, :]).sum(axis=2)
            xyz = xyz + layer.displacement(xyz)
        return found

    def inverse(self, xyz: ArrayLike) -> FloatArray:
        """Give the places (n, 3), m, that are mapped to given ones.

        Raises
        ------
        BadInputError
            Places that are no places, or a map that folds there.
        """
        return inverse(self.layers, xyz)

    def regions(self) -> tuple[Region, ...]:
        """Give the boxes of the profile plane outside which nothing moves."""
        return tuple(region for layer in self.layers for region in layer.regions())
