"""A boundary curve of lines and arcs in a plane along the ship: stern, stem, a buttock.

Examples
--------
>>> from assoc_hull.geometry.classical.arc_boundary import ArcBoundary
>>> from assoc_hull.geometry.classical.arc_section import through_points
>>> stem = ArcBoundary("stem", through_points([(0, 0), (3, 0), (5, 4)], kind="line"))
>>> stem.x(2.0).tolist(), round(stem.length, 9)
([4.0], 7.472135955)
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.arc_curve import ArcCurve
from assoc_hull.geometry.classical.arcs import Arcs
from assoc_hull.geometry.classical.checks import figure, finite
from assoc_hull.geometry.curves import FloatArray

__all__ = ["ArcBoundary"]


@attrs.frozen(eq=False)
class ArcBoundary:
    """A curve (x, z) in any direction of travel; x may turn back.

    The boundary curve of the PRELIKON system in Kim & Chang, "Some Representations of Ship
    Hulls by Mathematical Method for Design and Production", J. SNAK.

    Attributes
    ----------
    name : str
        "stern", "stem" ..., for messages.
    curve : ArcCurve
        Its lines and arcs, m.
    y : float, m
        Of the plane it lies in; 0 is the centre line.
    """

    name: str
    curve: ArcCurve
    y: float = 0.0

    @property
    def length(self) -> float:
        """Along the curve, m."""
        return self.curve.length

    def x(self, z: float) -> FloatArray:
        """Give x (k,), m, of all intersections with a height (m), sorted.

        Raises
        ------
        GeometryError
            ``"boundary {name}: does not reach z={z}"``.
        """
        return self._all(1, z)

    def z(self, x: float) -> FloatArray:
        """Give z (k,), m, of all intersections with a plane x (m), sorted.

        Raises
        ------
        GeometryError
            ``"boundary {name}: does not reach x={x}"``.
        """
        return self._all(0, x)

    def _all(self, axis: int, value: float) -> FloatArray:
        found = self.curve.where(axis, value)[:, 1 - axis]
        if not len(found):
            letter = "xz"[axis]
            raise GeometryError(
                f"boundary {self.name}: does not reach {letter}={figure(value)}",
                "extend it, or ask elsewhere", {letter: float(value)},
            )  # fmt: skip
        return np.asarray(found)

    def moved(self, by: float) -> Self:
        """Give the same curve with `by` (m) added to every x."""
        step = float(finite(by, f"boundary {self.name}", ()))
        arcs, shift = self.curve.arcs, np.array([step, 0.0])
        moved = Arcs(
            arcs.start + shift, arcs.angle.copy(), arcs.curvature.copy(), arcs.length.copy()
        )
        curve = attrs.evolve(self.curve, arcs=moved, points=self.curve.points + shift)
        return attrs.evolve(self, curve=curve)
