"""The corner layer: a bilge made larger or smaller about the corner of side and bottom.

A circular fillet between two straight lines is homothetic about their corner. So with equal
ratios along both lines an arc of radius r becomes one of radius r', exactly, as far as the
factor of the fade is one.
"""

from __future__ import annotations

import math

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.field import Region
from assoc_hull.variation.fields.piecewise_linear import Chain, Course

__all__ = ["CornerLayer"]


@attrs.frozen(eq=False)
class CornerLayer:
    """Stretch about the corner of side and bottom; both lines stay lines.

    With eta inward along the bottom and zeta up the side from the corner, and the weight
    ``w = A(x) c(eta) c(zeta)``, ``eta' = eta + (r_eta - 1) w eta`` and
    ``zeta' = zeta + (r_zeta - 1) w zeta``.

    Attributes
    ----------
    name : str
    course : Course
        A(x): 1 where the bilge is full.
    y, z : float, m
        The corner, to port; starboard is its mirror.
    rise : float, rad
        Of the bottom line, outward from the keel.
    eta_ratio, zeta_ratio : float
        r' / r along the bottom and up the side.
    fade : Chain
        c: 1 as far as the bilge reaches (m), 0 beyond.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.piecewise_linear import Chain
    >>> from assoc_hull.variation.fields.corner import CornerLayer
    >>> fade = Chain.through([2.4, 12.0], [1.0, 0.0])
    >>> bilge = CornerLayer("bilge", Chain.constant(1.0), 29.0, 0.0, 0.0, 1.25, 1.25, fade)
    >>> place = np.array([[150.0, 24.0, 0.0]])
    >>> (place + bilge.displacement(place))[0].round(10).tolist()
    [150.0, 22.9083703653, 0.0]
    """

    name: str
    course: Course
    y: float
    z: float
    rise: float
    eta_ratio: float
    zeta_ratio: float
    fade: Chain

    def skew(self, xyz: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Give the side (+1 port), eta and zeta of places."""
        side = np.where(xyz[:, 1] < 0.0, -1.0, 1.0)
        inward = self.y - np.abs(xyz[:, 1])
        return side, inward / math.cos(self.rise), xyz[:, 2] - self.z + inward * math.tan(self.rise)

    def displacement(self, xyz: FloatArray) -> FloatArray:
        """Give by how much places (n, 3), m, move, (n, 3), m."""
        side, eta, zeta = self.skew(xyz)
        weight = self.course.at(xyz[:, 0]) * self.fade.at(eta) * self.fade.at(zeta)
        along = (self.eta_ratio - 1.0) * weight * eta
        moved = np.zeros_like(xyz)
        moved[:, 1] = -side * along * math.cos(self.rise)
        moved[:, 2] = (self.zeta_ratio - 1.0) * weight * zeta - along * math.sin(self.rise)
        return moved

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        """Give the derivatives of the places after by those before, (n, 3, 3)."""
        side, eta, zeta = self.skew(xyz)
        cos, sin, tan = math.cos(self.rise), math.sin(self.rise), math.tan(self.rise)
        a, a_x = self.course.at(xyz[:, 0]), self.course.slope(xyz[:, 0])
        c, c_eta = self.fade.at(eta), self.fade.slope(eta)
        k, k_zeta = self.fade.at(zeta), self.fade.slope(zeta)
        found = np.tile(np.eye(3), (len(xyz), 1, 1))
        for ratio, lever, u, v in (
            (self.eta_ratio, eta, -side * cos, -sin),
            (self.zeta_ratio, zeta, 0.0 * side, 1.0),
        ):
            size = ratio - 1.0
            by_x = size * a_x * c * k * lever
            by_eta = size * a * k * (c_eta * lever + (c if lever is eta else 0.0))
            by_zeta = size * a * c * (k_zeta * lever + (k if lever is zeta else 0.0))
            by_y = -side * (by_eta / cos + by_zeta * tan)
            for row, part in ((1, u), (2, v)):
                found[:, row, 0] += part * by_x
                found[:, row, 1] += part * by_y
                found[:, row, 2] += part * by_zeta
        return found

    def regions(self) -> tuple[Region, ...]:
        """Give the box of the profile plane outside which nothing moves."""
        nodes, value = self.course.nodes, self.course.at(self.course.nodes)
        first = -np.inf if value[0] != 0.0 else float(nodes[0])
        last = np.inf if value[-1] != 0.0 else float(nodes[-1])
        top = self.z + float(self.fade.nodes[-1])
        return (Region(self.name, (first, last), (-np.inf, top)),)
