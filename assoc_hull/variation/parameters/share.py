"""What one named parameter puts into a map: fields, and where they must give what change."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.field import Axis, Field
from assoc_hull.variation.fields.fields_layer import Rake

__all__ = ["Share"]


@attrs.frozen(eq=False)
class Share:
    """Fields of one parameter, laid out for the change that is asked.

    Attributes
    ----------
    name : str
        The parameter.
    axis : {"x", "y", "z"}
        The coordinate of the anchor that must change.
    change : float, m
        By how much.
    places : (k, 3), m
        The anchor; further places are subtracted by their weights.
    weights : (k,)
        1 for the anchor itself.
    fields : tuple of Field or Rake
        Which alone give the change.
    """

    name: str
    axis: Axis
    change: float
    places: FloatArray
    weights: FloatArray
    fields: tuple[Field | Rake, ...]

    @classmethod
    def at(
        cls, name: str, axis: Axis, change: float, place: FloatArray, *fields: Field | Rake
    ) -> Share:
        """Give a share whose anchor is one place."""
        return cls(name, axis, change, place[None, :].copy(), np.ones(1), fields)

    def scaled(self, factor: float) -> Share:
        """Give the share with its fields times a factor; bits stay with a factor of 1."""
        if factor == 1.0:
            return self
        return attrs.evolve(self, fields=tuple(each.scaled(factor) for each in self.fields))

    def effect(self, other: Share) -> float:
        """Give what these fields change at the anchor of another share, m."""
        axis = other.axis
        moved = np.zeros(len(other.places))
        for field in self.fields:
            if field.axis == axis:
                moved = moved + field.displacement(other.places)
        return float((moved * other.weights).sum())
