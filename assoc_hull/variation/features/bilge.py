"""The bilge as it is drawn: an arc between a bottom, level or rising, and an upright side."""

from __future__ import annotations

import math

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import number, positive
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["Bilge", "bilge"]


@attrs.frozen(eq=False)
class Bilge:
    """A bilge circle between a floor and a flat side.

    Attributes
    ----------
    y, z : float, m
        The centre.
    radius : float, m
    floor : (2,), m
        y and z at which it leaves the floor.
    side : (2,), m
        y and z at which it comes onto the side.
    """

    y: float
    z: float
    radius: float
    floor: FloatArray
    side: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.floor, self.side)

    @property
    def first(self) -> float:
        """The angle (radians) at which it leaves the floor; it comes onto the side at 0."""
        return math.atan2(float(self.floor[1]) - self.z, float(self.floor[0]) - self.y)

    def at(self, part: ArrayLike) -> FloatArray:
        """Give places y, z (n, 2), m, at parts of the arc, 0 on the floor and 1 on the side.

        The ends are exactly the tangent points.
        """
        t = np.asarray(part, np.float64)
        angle = self.first * (1.0 - t)
        inner = np.column_stack([np.cos(angle), np.sin(angle)]) * self.radius
        inner = inner + np.array([self.y, self.z])
        inner = np.where((t == 0.0)[:, None], self.floor, inner)
        return np.where((t == 1.0)[:, None], self.side, inner)

    def ahead(self, part: ArrayLike) -> FloatArray:
        """Give the derivatives of `at` by the part, (n, 2), m."""
        angle = self.first * (1.0 - np.asarray(part, np.float64))
        turn = np.column_stack([np.sin(angle), -np.cos(angle)])
        return np.asarray(self.first * self.radius * turn)


def bilge(
    half_breadth: float, radius: float, deadrise_deg: float = 0.0, keel: float = 0.0,
    base: float = 0.0,
) -> Bilge:  # fmt: skip
    """Draw a bilge circle that is tangent to the floor and to the side.

    Parameters
    ----------
    half_breadth : float, m
        y of the flat side.
    radius : float, m
    deadrise_deg : float
        By how much the floor rises outward, degrees; negative if it falls.
    keel : float, m
        Half-width of the keel, from where the floor rises.
    base : float, m
        z of the keel.

    Raises
    ------
    BadInputError
        Not finite, or an arc that begins within the keel's half-width.

    Examples
    --------
    >>> from assoc_hull.variation.features.bilge import bilge
    >>> arc = bilge(25.0, 2.4, deadrise_deg=2.0, keel=1.0)
    >>> round(arc.z, 10), arc.floor.round(10).tolist()
    (3.1557515273, [22.6837587921, 0.7572135425])
    """
    where = "in the bilge"
    side, foot = positive(half_breadth, "half_breadth", where), number(keel, "keel", where)
    r, low = positive(radius, "radius", where), number(base, "base", where)
    beta = math.radians(number(deadrise_deg, "deadrise_deg", where))
    if not abs(beta) < math.pi / 2.0:
        raise BadInputError(f"deadrise_deg is {deadrise_deg:g}", where, "give less than 90 degrees")
    y = side - r
    z = low + math.tan(beta) * (y - foot) + r / math.cos(beta)
    floor = np.array([y + r * math.sin(beta), z - r * math.cos(beta)])
    if beta == 0.0:
        floor[1] = low
    if float(floor[0]) < foot:
        raise BadInputError(
            f"bilge: radius {r:.1f} m leaves no bottom (keel half-width {foot:.1f})", "in vary",
            "make the radius smaller",
        )  # fmt: skip
    return Bilge(y, z, r, floor, np.array([side, z]))
