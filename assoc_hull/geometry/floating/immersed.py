"""Floating planes, and what a body has below them: plain integrals, no ship's words yet.

Axes: x forward from AP, y to port, z up from the base line; m.
"""

from __future__ import annotations

import attrs

from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["Immersed", "Planes"]


@attrs.frozen(eq=False)
class Planes:
    """Floating planes ``z = height + tan_trim x - tan_heel y``.

    Attributes
    ----------
    height : (d,), m
        Height of the plane at x = 0, y = 0: the draught at AP.
    tan_trim : (d,)
        Rise of the plane per metre forward, (T_F - T_A) / Lpp.
    tan_heel : (d,)
        Tangent of the heel, + starboard down.
    """

    height: FloatArray
    tan_trim: FloatArray
    tan_heel: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.height, self.tan_trim, self.tan_heel)


@attrs.frozen(eq=False)
class Immersed:
    """Integrals of both sides of a body below each of d planes, all (d,).

    Attributes
    ----------
    volume : m3
        Below the plane.
    moment_x, moment_y, moment_z : m4
        Integrals of x, y, z over that volume.
    area : m2
        Of the waterplane, projected on z = 0 ("in plan").
    area_x, area_y : m3
        Integrals of x and y over the waterplane in plan.
    area_xx, area_xy, area_yy : m4
        Integrals of x x, x y and y y over the waterplane in plan.
    shell : m2
        True area of the surface below the plane: strips only, neither faces nor the plane.
    girth : m2
        Integral of the girth over the length, ``sqrt(n_y^2 + n_z^2) dS`` over the same surface.
    wet_deck : m2
        How much of `shell` is closed deck.
    x_least, x_most, y_least, y_most : m
        Extent of the waterplane; nan where there is none.
    """

    volume: FloatArray
    moment_x: FloatArray
    moment_y: FloatArray
    moment_z: FloatArray
    area: FloatArray
    area_x: FloatArray
    area_y: FloatArray
    area_xx: FloatArray
    area_xy: FloatArray
    area_yy: FloatArray
    shell: FloatArray
    girth: FloatArray
    wet_deck: FloatArray
    x_least: FloatArray
    x_most: FloatArray
    y_least: FloatArray
    y_most: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(*attrs.astuple(self, recurse=False))
