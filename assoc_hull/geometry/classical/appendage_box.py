"""A box with faces parallel to the axes, added to a hull or taken from it.

Examples
--------
>>> from assoc_hull.geometry.classical.appendage_box import AppendageBox
>>> box = AppendageBox.make((12, 20), (1, 3), (0.5, 2.5))
>>> box.volume, box.centroid, box.waterplane_area(1.0)
(32.0, (16.0, 2.0, 1.5), 16.0)
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import flag, shown
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import figure, finite

__all__ = ["AppendageBox"]

Limits = tuple[float, float]


@attrs.frozen
class AppendageBox:
    """A box; the appendage of the PRELIKON system in Kim & Chang, J. SNAK.

    Attributes
    ----------
    x, y, z : (float, float), m
        Limits, the lower one first; y as given, on one side.
    sign : int
        +1 adds to the hull, -1 takes from it.
    symmetric : bool
        The same box stands on the other side as well.
    name : str
        For tables.
    """

    x: Limits
    y: Limits
    z: Limits
    sign: int = 1
    symmetric: bool = False
    name: str = "appendage box"

    @classmethod
    def make(
        cls,
        x: ArrayLike,
        y: ArrayLike,
        z: ArrayLike,
        *,
        sign: int = 1,
        symmetric: bool = False,
        name: str = "appendage box",
    ) -> Self:
        """Check what is handed in; arguments as the attributes.

        Raises
        ------
        GeometryError
            ``"appendage box: {axis} limits reversed"``; a sign that is not 1 or -1; a box
            across the centre line that is to stand on both sides.
        """
        limits = [_limits(pair, axis) for pair, axis in ((x, "x"), (y, "y"), (z, "z"))]
        if shown(sign) not in ("1", "-1"):
            what = f"appendage box: sign is {shown(sign)}"
            raise GeometryError(what, "give 1 or -1", {"sign": sign})
        low, high = limits[1]
        both = flag(symmetric, "symmetric", "in an appendage box")
        if both and low < 0.0 < high:
            what = f"appendage box: y {figure(low)} to {figure(high)} overlaps its mirror image"
            remedy = "give it on one side, or without symmetric"
            raise GeometryError(what, remedy, {"y": (low, high)})
        return cls(limits[0], limits[1], limits[2], sign, both, str(name))

    @property
    def sides(self) -> int:
        """How many such boxes there are: 1, or 2 if it is symmetric."""
        return 2 if self.symmetric else 1

    @property
    def volume(self) -> float:
        """With its sign, both sides if symmetric, m3."""
        return self.waterplane_area(self.z[0]) * (self.z[1] - self.z[0])

    @property
    def centroid(self) -> tuple[float, float, float]:
        """Its centre, m; y is 0 if it stands on both sides."""
        x, y, z = (0.5 * (low + high) for low, high in (self.x, self.y, self.z))
        return x, 0.0 if self.symmetric else y, z

    @property
    def surface(self) -> float:
        """Of all six faces, both sides if symmetric, m2."""
        a, b, c = (high - low for low, high in (self.x, self.y, self.z))
        return 2.0 * self.sides * (a * b + b * c + c * a)

    def waterplane_area(self, z: float) -> float:
        """Give the area (m2, with the sign) cut at height `z` (m); 0 above and below it.

        Raises
        ------
        GeometryError
            A height that is no finite number.
        """
        level = float(finite(z, "appendage box", ()))
        if not self.z[0] <= level <= self.z[1]:
            return 0.0
        return self.sign * self.sides * (self.x[1] - self.x[0]) * (self.y[1] - self.y[0])

    def volume_below(self, z: float) -> float:
        """Give the volume (m3, with the sign) below height `z` (m).

        Raises
        ------
        GeometryError
            A height that is no finite number.
        """
        level = float(finite(z, "appendage box", ()))
        depth = float(np.clip(level, *self.z)) - self.z[0]
        return self.waterplane_area(self.z[0]) * depth

    def moved(self, by: float) -> Self:
        """Give the same box with `by` (m) added to x."""
        step = float(finite(by, "appendage box", ()))
        return attrs.evolve(self, x=(self.x[0] + step, self.x[1] + step))


def _limits(pair: ArrayLike, axis: str) -> Limits:
    low, high = finite(pair, f"appendage box {axis}", (2,)).tolist()
    if not low < high:
        raise GeometryError(
            f"appendage box: {axis} limits reversed",
            f"give the lower one of {figure(low)} and {figure(high)} first, and apart",
            {"axis": axis, "limits": (low, high)},
        )  # fmt: skip
    return low, high
