"""The deadrise layer: the bottom turned about the side of the keel, in planes across the ship."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.blend import QUINTIC, Blend
from assoc_hull.variation.fields.field import Region
from assoc_hull.variation.fields.piecewise_linear import Chain, Course

__all__ = ["DeadriseLayer"]


@attrs.frozen(eq=False)
class DeadriseLayer:
    """A shear ``z' = z + A(x) q r(|y| - y_k) c(z)``: r is max(., 0), or a ramp of width w.

    Attributes
    ----------
    name : str
    course : Course
        A(x).
    q : float
        Change of the tangent of the deadrise.
    keel : float, m
        y_k, half-breadth of the level keel plate.
    width : float, m
        Over what half-breadth the ramp becomes straight; 0 for a corner at the keel's side.
    fade : Chain
        c(z): 1 up to the top of the bilge, 0 above.
    blend : Blend
    """

    name: str
    course: Course
    q: float
    keel: float
    width: float
    fade: Chain
    blend: Blend = QUINTIC

    def ramp(self, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give r and its derivative by the half-breadth."""
        out = np.abs(y) - self.keel
        if self.width == 0.0:
            return np.maximum(out, 0.0), np.where(out >= 0.0, 1.0, 0.0)
        t = out / self.width
        return self.width * self.blend.ramp(t), self.blend.value(t)

    def displacement(self, xyz: FloatArray) -> FloatArray:
        """Give by how much places (n, 3), m, move, (n, 3), m."""
        moved = np.zeros_like(xyz)
        ramp, _ = self.ramp(xyz[:, 1])
        moved[:, 2] = self.course.at(xyz[:, 0]) * self.q * ramp * self.fade.at(xyz[:, 2])
        return moved

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        """Give the derivatives of the places after by those before, (n, 3, 3)."""
        ramp, rise = self.ramp(xyz[:, 1])
        a, c = self.course.at(xyz[:, 0]), self.fade.at(xyz[:, 2])
        found = np.tile(np.eye(3), (len(xyz), 1, 1))
        found[:, 2, 0] += self.course.slope(xyz[:, 0]) * self.q * ramp * c
        found[:, 2, 1] += a * self.q * np.where(xyz[:, 1] < 0.0, -rise, rise) * c
        found[:, 2, 2] += a * self.q * ramp * self.fade.slope(xyz[:, 2])
        return found

    def regions(self) -> tuple[Region, ...]:
        """Give the box of the profile plane outside which nothing moves."""
        nodes, value = self.course.nodes, self.course.at(self.course.nodes)
        first = -np.inf if value[0] != 0.0 else float(nodes[0])
        last = np.inf if value[-1] != 0.0 else float(nodes[-1])
        return (Region(self.name, (first, last), (-np.inf, float(self.fade.nodes[-1]))),)
