"""The layers that a map is composed of: fields that add, corner, deadrise, additive functions.

A layer gives displacements (m) and their derivatives at the places before it; the next layer acts
on the places after it. Fields of one layer add. The corner layer stretches about the corner of
side and bottom, the deadrise layer turns the bottom, additive functions are those of Soeding and
Rabien (1977). A layer of any of these kinds can be scaled: a solver finds its strength.
"""

from __future__ import annotations

import math
from typing import Protocol, runtime_checkable

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.bounded_functions import (
    QUINTIC,
    Blend,
    BlendChain,
    BoundedFunction,
    Polynomial,
)
from assoc_hull.variation.fields.field import Axis, FieldRegion, StackedField, nonzero_span

__all__ = [
    "AdditiveLayer",
    "CornerLayer",
    "DeadriseLayer",
    "Factors",
    "FieldLayer",
    "Layer",
    "Rake",
    "scaled_layer",
]


def scaled_layer(layer: Layer, factor: float) -> Layer:
    """Give a layer with its displacement times a factor.

    Raises
    ------
    BadInputError
        A layer of no known kind.

    Examples
    --------
    >>> from assoc_hull.variation.fields.layers import scaled_layer
    >>> from assoc_hull.variation.fields.layers import AdditiveLayer
    >>> from assoc_hull.variation.fields.bounded_functions import BlendChain
    >>> longer = AdditiveLayer("longer", x=BlendChain.through([0.0, 100.0], [0.0, 1.0]))
    >>> scaled_layer(longer, 2.5).x.v.tolist()
    [0.0, 2.5]
    """
    if isinstance(layer, FieldLayer):
        return attrs.evolve(layer, fields=tuple(each.scaled(factor) for each in layer.fields))
    if isinstance(layer, AdditiveLayer):
        x = None if layer.x is None else layer.x.scaled(factor)
        return attrs.evolve(layer, x=x, y=_scaled(layer.y, factor), z=_scaled(layer.z, factor))
    if isinstance(layer, CornerLayer):
        eta, zeta = ((ratio - 1.0) * factor for ratio in (layer.eta_ratio, layer.zeta_ratio))
        return attrs.evolve(layer, eta_ratio=1.0 + eta, zeta_ratio=1.0 + zeta)
    if isinstance(layer, DeadriseLayer):
        return attrs.evolve(layer, q=layer.q * factor)
    raise BadInputError(
        f"'{layer.name}' is a {type(layer).__name__}", "in vary", "free a layer of a known kind"
    )


def _scaled(factors: Factors | None, factor: float) -> Factors | None:
    return None if factors is None else (factors[0].scaled(factor), factors[1], factors[2])


@runtime_checkable
class Layer(Protocol):
    """What a map is composed of.

    Outside its regions a layer's displacement is exactly zero and its Jacobian exactly the unit
    matrix, so that places there stay the same to the last bit.
    """

    @property
    def name(self) -> str:
        """For reports and messages."""
        ...

    def displacement(self, xyz: FloatArray) -> FloatArray:
        """Give by how much places (n, 3), m, move, (n, 3), m."""
        ...

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        """Give the derivatives of the places after by those before, (n, 3, 3)."""
        ...

    def regions(self) -> tuple[FieldRegion, ...]:
        """Give the boxes of the profile plane outside which nothing moves."""
        ...


@attrs.frozen(eq=False)
class Rake:
    """An x-field that grows upward as a ramp: ``A(x) q w ramp((z - z0) / w)``.

    Attributes
    ----------
    name : str
    course : BoundedFunction
        A(x): how much of it acts along the ship, 1 where all of it.
    q : float
        Tangent of the angle that is added; positive leans forward.
    z0, w : float, m
        Where the ramp begins, and over what height it becomes straight.
    blend : Blend
    """

    name: str
    course: BoundedFunction
    q: float
    z0: float
    w: float
    blend: Blend = QUINTIC

    @property
    def axis(self) -> Axis:
        """The coordinate that it moves."""
        return "x"

    def scaled(self, factor: float) -> Rake:
        """Give the field times a factor."""
        return attrs.evolve(self, q=self.q * factor)

    def displacement(self, xyz: FloatArray) -> FloatArray:
        """Give u, (n,), m, at places (n, 3), m."""
        t = (xyz[:, 2] - self.z0) / self.w
        u: FloatArray = self.course.at(xyz[:, 0]) * (self.q * self.w) * self.blend.ramp(t)
        return u

    def gradient(self, xyz: FloatArray) -> FloatArray:
        """Give du/dx, du/dy, du/dz, (n, 3)."""
        t = (xyz[:, 2] - self.z0) / self.w
        found = np.zeros((len(xyz), 3))
        slope = self.course.slope(xyz[:, 0])
        found[:, 0] = slope * (self.q * self.w) * self.blend.ramp(t)
        found[:, 2] = self.course.at(xyz[:, 0]) * self.q * self.blend.value(t)
        return found

    def region(self) -> FieldRegion:
        """Give the box of the profile plane outside which u is exactly zero."""
        nodes, value = self.course.nodes, self.course.at(self.course.nodes)
        first = -np.inf if value[0] != 0.0 else float(nodes[0])
        last = np.inf if value[-1] != 0.0 else float(nodes[-1])
        return FieldRegion(self.name, (first, last), (self.z0, np.inf))


@attrs.frozen(eq=False)
class FieldLayer:
    """Fields that add, a layer of a map.

    Attributes
    ----------
    name : str
    fields : tuple of StackedField or Rake

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.bounded_functions import BlendChain
    >>> from assoc_hull.variation.fields.layers import FieldLayer
    >>> from assoc_hull.variation.fields.anchor_fields import hat_field
    >>> fade = BlendChain.through([6, 66], [1, 0])
    >>> shaft = hat_field("shaft", [("base", 0, 0), ("shaft", 5, 1), ("T", 18, 0)], fade)
    >>> FieldLayer("local", (shaft,)).displacement(np.array([[6.0, 0.7, 5.0]])).tolist()
    [[0.0, 0.0, 1.0]]
    """

    name: str
    fields: tuple[StackedField | Rake, ...]

    def displacement(self, xyz: FloatArray) -> FloatArray:
        """Give by how much places (n, 3), m, move, (n, 3), m."""
        moved = np.zeros_like(xyz)
        for field in self.fields:
            moved[:, "xyz".index(field.axis)] += field.displacement(xyz)
        return moved

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        """Give the derivatives of the places after by those before, (n, 3, 3)."""
        found = np.tile(np.eye(3), (len(xyz), 1, 1))
        for field in self.fields:
            found[:, "xyz".index(field.axis)] += field.gradient(xyz)
        return found

    def regions(self) -> tuple[FieldRegion, ...]:
        """Give the boxes of the profile plane outside which nothing moves."""
        return tuple(field.region() for field in self.fields)


# A circular fillet between two straight lines is homothetic about their corner: with equal ratios
# along both lines an arc of radius r becomes one of radius r', exactly, as far as the fade is 1.


@attrs.frozen(eq=False)
class CornerLayer:
    """Stretch about the corner of side and bottom; both lines stay lines.

    With eta inward along the bottom and zeta up the side from the corner, and the weight
    ``w = A(x) c(eta) c(zeta)``, ``eta' = eta + (r_eta - 1) w eta`` and
    ``zeta' = zeta + (r_zeta - 1) w zeta``.

    Attributes
    ----------
    name : str
    course : BoundedFunction
        A(x): 1 where the bilge is full.
    y, z : float, m
        The corner, to port; starboard is its mirror.
    rise : float, rad
        Of the bottom line, outward from the keel.
    eta_ratio, zeta_ratio : float
        r' / r along the bottom and up the side.
    fade : BlendChain
        c: 1 as far as the bilge reaches (m), 0 beyond.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.bounded_functions import BlendChain
    >>> from assoc_hull.variation.fields.layers import CornerLayer
    >>> fade = BlendChain.through([2.4, 12.0], [1.0, 0.0])
    >>> bilge = CornerLayer("bilge", BlendChain.constant(1.0), 29.0, 0.0, 0.0, 1.25, 1.25, fade)
    >>> place = np.array([[150.0, 24.0, 0.0]])
    >>> (place + bilge.displacement(place))[0].round(10).tolist()
    [150.0, 22.9083703653, 0.0]
    """

    name: str
    course: BoundedFunction
    y: float
    z: float
    rise: float
    eta_ratio: float
    zeta_ratio: float
    fade: BlendChain

    def skew(self, xyz: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Give the side (+1 port, -1 starboard), eta and zeta (m) of places; each (n,)."""
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

    def regions(self) -> tuple[FieldRegion, ...]:
        """Give the box of the profile plane outside which nothing moves."""
        nodes, value = self.course.nodes, self.course.at(self.course.nodes)
        first = -np.inf if value[0] != 0.0 else float(nodes[0])
        last = np.inf if value[-1] != 0.0 else float(nodes[-1])
        top = self.z + float(self.fade.nodes[-1])
        return (FieldRegion(self.name, (first, last), (-np.inf, top)),)


@attrs.frozen(eq=False)
class DeadriseLayer:
    """Turn the bottom about the side of the keel, in planes across the ship.

    It is a shear ``z' = z + A(x) q r(|y| - y_k) c(z)``: r is max(., 0), or a ramp of width w.

    Attributes
    ----------
    name : str
    course : BoundedFunction
        A(x): 1 where the whole change acts.
    q : float
        Change of the tangent of the deadrise.
    keel : float, m
        y_k, half-breadth of the level keel plate.
    width : float, m
        Over what half-breadth the ramp becomes straight; 0 for a corner at the keel's side.
    fade : BlendChain
        c(z): 1 up to the top of the bilge, 0 above.
    blend : Blend
    """

    name: str
    course: BoundedFunction
    q: float
    keel: float
    width: float
    fade: BlendChain
    blend: Blend = QUINTIC

    def ramp(self, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give r (m) and its derivative by the half-breadth, (n,) each."""
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

    def regions(self) -> tuple[FieldRegion, ...]:
        """Give the box of the profile plane outside which nothing moves."""
        nodes, value = self.course.nodes, self.course.at(self.course.nodes)
        first = -np.inf if value[0] != 0.0 else float(nodes[0])
        last = np.inf if value[-1] != 0.0 else float(nodes[-1])
        return (FieldRegion(self.name, (first, last), (-np.inf, float(self.fade.nodes[-1]))),)


# --------------------------------------------------------------------------------------
# Additive functions: displacements are products of functions of one coordinate each.
#
#     x' = x + F1(x)
#     y' = y + F2(x) F3(y) F4(z)
#     z' = z + F5(x) F6(y) F7(z)
#
# H. Soeding, U. Rabien, "Hull surface design by modifying an existing hull", First International
# Symposium on Computer-Aided Hull Surface Definition, Annapolis 1977. A place moves by what is
# asked without a pivot, but there is no affine part unless F3(y) = y: a half-breadth that fades in
# over the half-breadth by a blend leaves the scaled hull by a tenth of what the side moves.

Factors = tuple[BoundedFunction, BoundedFunction, BoundedFunction]
"""Functions of x, of the half-breadth, and of z."""


@attrs.frozen(eq=False)
class AdditiveLayer:
    """A layer of additive functions; of y the half-breadth counts, so both sides stay alike.

    Attributes
    ----------
    name : str
    x : BoundedFunction or None
        F1, m.
    y : Factors or None
        F2, F3, F4: their product is m. F3 is zero at the centre plane, which stays.
    z : Factors or None
        F5, F6, F7: their product is m.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.layers import AdditiveLayer
    >>> from assoc_hull.variation.fields.bounded_functions import BlendChain
    >>> fade, hump = BlendChain.through([6, 66], [1, 0]), BlendChain.through([0, 5, 18], [0, 1, 0])
    >>> shaft = AdditiveLayer("shaft", z=(fade, BlendChain.constant(1.0), hump))
    >>> shaft.displacement(np.array([[6.0, 0.7, 5.0], [6.0, 0.7, 18.0]])).tolist()
    [[0.0, 0.0, 1.0], [0.0, 0.0, 0.0]]
    """

    name: str
    x: BoundedFunction | None = None
    y: Factors | None = None
    z: Factors | None = None

    def __attrs_post_init__(self) -> None:
        if self.y is not None and float(self.y[1].at(np.zeros(1))[0]) != 0.0:
            raise BadInputError(
                f"layer '{self.name}' moves the centre plane", "in vary",
                "give an F3 that is nil at y = 0",
            )  # fmt: skip

    def displacement(self, xyz: FloatArray) -> FloatArray:
        """Give by how much places (n, 3), m, move, (n, 3), m."""
        moved = np.zeros_like(xyz)
        side, at = _sided(xyz)
        if self.x is not None:
            moved[:, 0] = self.x.at(xyz[:, 0])
        if self.y is not None:
            moved[:, 1] = side * _product(self.y, at)
        if self.z is not None:
            moved[:, 2] = _product(self.z, at)
        return moved

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        """Give the derivatives of the places after by those before, (n, 3, 3)."""
        found = np.tile(np.eye(3), (len(xyz), 1, 1))
        side, at = _sided(xyz)
        one = np.ones_like(side)
        if self.x is not None:
            found[:, 0, 0] += self.x.slope(xyz[:, 0])
        if self.y is not None:
            found[:, 1] += _gradient(self.y, at) * np.stack([side, one, side], axis=1)
        if self.z is not None:
            found[:, 2] += _gradient(self.z, at) * np.stack([one, side, one], axis=1)
        return found

    def regions(self) -> tuple[FieldRegion, ...]:
        """Give the boxes of the profile plane outside which nothing moves."""
        found = []
        if self.x is not None:
            found.append(FieldRegion(f"{self.name} x", _span(self.x), (-np.inf, np.inf)))
        for axis, factors in (("y", self.y), ("z", self.z)):
            if factors is not None:
                title = f"{self.name} {axis}"
                found.append(FieldRegion(title, _span(factors[0]), _span(factors[2])))
        return tuple(found)


def _sided(xyz: FloatArray) -> tuple[FloatArray, tuple[FloatArray, FloatArray, FloatArray]]:
    """Give the side (1 to port and at the centre, -1 to starboard), and x, half-breadth and z."""
    side = np.where(xyz[:, 1] < 0.0, -1.0, 1.0)
    return side, (xyz[:, 0], np.abs(xyz[:, 1]), xyz[:, 2])


def _product(factors: Factors, at: tuple[FloatArray, FloatArray, FloatArray]) -> FloatArray:
    """Give the product of three factors at x, half-breadth and z, (n,), m."""
    first, second, third = (course.at(c) for course, c in zip(factors, at, strict=True))
    return np.asarray(first * second * third)


def _gradient(factors: Factors, at: tuple[FloatArray, FloatArray, FloatArray]) -> FloatArray:
    """Give the derivatives of a product by x, half-breadth and z, (n, 3)."""
    first, second, third = (course.at(c) for course, c in zip(factors, at, strict=True))
    by_x, by_y, by_z = (course.slope(c) for course, c in zip(factors, at, strict=True))
    return np.stack([by_x * second * third, first * by_y * third, first * second * by_z], axis=1)


def _span(course: BoundedFunction) -> tuple[float, float]:
    """Give between which x or z, m, a function is not zero; infinite where there is no end."""
    if isinstance(course, Polynomial):
        return (-np.inf, np.inf) if course.c.any() else (np.inf, -np.inf)
    return nonzero_span(course)
