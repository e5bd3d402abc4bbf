"""What a layout of fields knows of the parent: dimensions, and places measured on its curves."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray

__all__ = ["Parent"]

_MEASURED_AS = {
    "body start": "parallel_body_start", "body end": "parallel_body_end",
    "corner": "bilge_radius", "bilge low": "bilge_radius", "bilge high": "bilge_radius",
    "deck": "depth", "bulb tip": "bulb_height", "bulb top": "bulb_height",
    "boss": "shaft_height", "boss top": "bossing_radius", "transom": "transom_height",
}  # fmt: skip
"""The parameter by whose measure a place is known: if it is missing, that tells why."""


@attrs.frozen(eq=False)
class Parent:
    """Dimensions and measured places; those of a scaled parent are laid out on.

    Attributes
    ----------
    length, breadth, depth, draught : float, m
    top : float, m
        Greatest height of the hull.
    places : mapping of str to (3,) array, m
        Where parameters are measured, by what lies there: ``"boss"``, ``"bulb tip"`` ...
    absent : mapping of str to str
        Parameters that the parent has not, with the reason.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.parameters.parent_places import Parent
    >>> ship = Parent(300, 50, 27, 18, 27, {"boss": np.array([6.0, 0.0, 5.0])})
    >>> ship.at("boss", "shaft_height").tolist()
    [6.0, 0.0, 5.0]
    """

    length: float
    breadth: float
    depth: float
    draught: float
    top: float
    places: Mapping[str, FloatArray]
    absent: Mapping[str, str] = attrs.field(factory=dict)

    def at(self, place: str, parameter: str) -> FloatArray:
        """Give a place that a parameter needs.

        Raises
        ------
        BadInputError
            The parent has none; the message has the reason.
        """
        found = self.places.get(place)
        if found is None or parameter in self.absent:
            measured = self.absent.get(_MEASURED_AS.get(place, ""), f"the parent has no {place}")
            raise BadInputError(
                f"cannot vary '{parameter}': {self.absent.get(parameter, measured)}", "in vary",
                "leave it out, or give the parent one",
            )  # fmt: skip
        return found

    def has(self, place: str) -> bool:
        """Tell whether the parent has a place."""
        return place in self.places

    def mapped(self, move: Callable[[FloatArray], FloatArray], **dimensions: float) -> Parent:
        """Give the parent with its places mapped, and some dimensions that were asked for."""
        keys = list(self.places)
        moved = move(np.array([self.places[key] for key in keys]).reshape(-1, 3))
        places = dict(zip(keys, moved, strict=True))
        top = float(move(np.array([[0.5 * self.length, 0.0, self.top]]))[0, 2])
        return Parent(
            dimensions.get("length", self.length), dimensions.get("breadth", self.breadth),
            dimensions.get("depth", self.depth), dimensions.get("draught", self.draught),
            top, places, self.absent,
        )  # fmt: skip
