"""Minors of layers on dense grids, computed otherwise than the fold check computes them.

Derivatives are sums over the strips of a stack, ``u = e_0 + sum of (e_{k+1} - e_k) b_k``, on whole
grids at once; a layer's own Jacobian takes the piece of each place instead. As all layers are
linear in their strength, they are sampled once and looked at in any strength.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.bounded_functions import BoundedFunction
from assoc_hull.variation.fields.field import StackedField
from assoc_hull.variation.fields.layers import (
    AdditiveLayer,
    CornerLayer,
    DeadriseLayer,
    Factors,
    FieldLayer,
    Layer,
    Rake,
)

__all__ = ["Samples", "sample"]

_EVEN = 9
"""Places of a third coordinate that are looked at beside those where something is extreme."""

_SHORT = 40
"""An axis with fewer places than that keeps them all."""

_Entries = dict[str, FloatArray]


@attrs.frozen(eq=False)
class Samples:
    """Derivatives of a layer of strength 1 on a grid of three coordinates.

    Attributes
    ----------
    sides : three arrays
        Places along the axes of the grid, rising.
    entries : dict of str to (n, m, k), or what is broadcast to it
        Derivatives of displacements: ``"xz"`` is that of u_x by z.
    pair : {"xz", "yz"}
        Which two axes the determinant is of.
    skew : (3, 3)
        Columns: the directions of the grid's axes in x, y, z.
    origin : (3,), m
        Where the grid's coordinates are nil.
    torn : bool
        Whether the layer pulls the two sides of the hull apart.
    """

    sides: tuple[FloatArray, FloatArray, FloatArray]
    entries: _Entries
    pair: str
    skew: FloatArray = attrs.field(factory=lambda: np.eye(3))
    origin: FloatArray = attrs.field(factory=lambda: np.zeros(3))
    torn: bool = False

    def minors(self, strength: float = 1.0, every: int = 1) -> dict[str, FloatArray]:
        """Give the principal minors that are not 1 by themselves, all or those of some places."""
        some = {name: _thinned(part, every) for name, part in self.entries.items()}
        found = {
            f"{axis.upper()}_{axis}": 1.0 + strength * some[axis + axis]
            for axis in "xyz"
            if axis + axis in some
        }
        one, other = self.pair[0], self.pair[1]
        if one + one in some and other + other in some:
            first, last = found[f"{one.upper()}_{one}"], found[f"{other.upper()}_{other}"]
            turn = some[one + other] * some[other + one]
            found["D"] = first * last - strength * strength * turn
        return found

    def least(self, strength: float, every: int = 1) -> float:
        """Give the least of all minors sampled."""
        found = self.minors(strength, every)
        return min((float(each.min()) for each in found.values()), default=1.0)

    def places(self, parameters: FloatArray) -> FloatArray:
        """Give the places (n, 3), m, of coordinates (n, 3) of the grid."""
        turned = (parameters[:, None, :] * self.skew[None, :, :]).sum(axis=2)
        return np.asarray(self.origin + turned)

    def holds(self, place: FloatArray, near: float = 1e-6) -> bool:
        """Tell whether a place (3,), m, lies in the grid, or as near to it as that."""
        where = np.linalg.solve(self.skew, place - self.origin)
        return all(
            len(side) == 1 or side[0] - near <= at <= side[-1] + near
            for at, side in zip(where.tolist(), self.sides, strict=True)
        )


def _thinned(part: FloatArray, every: int) -> FloatArray:
    steps = (slice(None, None, every if n > _SHORT else 1) for n in part.shape)
    return part[tuple(steps)]


def sample(layer: Layer, box: FloatArray, count: int = 400) -> Samples:
    """Sample a layer's derivatives in a box, on `count` places along each of two axes."""
    if isinstance(layer, FieldLayer):
        return _of_fields(layer, box, count)
    if isinstance(layer, CornerLayer):
        return _of_corner(layer, box, count)
    if isinstance(layer, DeadriseLayer):
        return _of_shear(layer, box, count)
    assert isinstance(layer, AdditiveLayer)
    return _of_additive(layer, box, count)


def _line(box: FloatArray, axis: int, count: int) -> FloatArray:
    low, high = box[:, axis].tolist()
    if axis == 1:
        low, high = 0.0, max(-low, high)
    return np.linspace(low, high, count)


def _extremes(places: FloatArray, values: Sequence[FloatArray], even: int = _EVEN) -> FloatArray:
    """Give where values are least and greatest, and some more places."""
    some = [int(find(each)) for each in values for find in (np.argmin, np.argmax)]
    more = np.linspace(0, len(places) - 1, even).astype(int).tolist()
    return np.asarray(places[np.unique([*some, *more])])


def _of_fields(layer: FieldLayer, box: FloatArray, count: int) -> Samples:
    x, z = _line(box, 0, count), _line(box, 2, count)
    out = _line(box, 1, count)
    tubes = [each.tube for each in layer.fields if isinstance(each, StackedField) and each.tube]
    y = _extremes(out, [tube.slope(out) for tube in tubes]) if tubes else out[:1]
    entries = _Entries()
    for field in layer.fields:
        if isinstance(field, Rake):
            parts = _of_rake(field, x[:, None, None], z[None, None, :])
        else:
            parts = _of_field(field, x[:, None, None], y[None, :, None], z[None, None, :])
        for name, part in parts.items():
            whole = np.broadcast_to(part, (count, part.shape[1], count))
            entries[name] = entries[name] + whole if name in entries else whole
    return Samples((x, y, z), entries, "xz")


def _level(course: BoundedFunction, x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give values and slopes, once if they are the same everywhere."""
    if len(course.nodes) == 1:
        x = x[:1]
    return course.at(x), course.slope(x)


def _of_field(field: StackedField, x: FloatArray, y: FloatArray, z: FloatArray) -> _Entries:
    """Sum the derivatives of a field over its strips."""
    c = x if field.axis == "x" else z
    heights = [_level(each.height, x) for each in field.boundaries]
    pieces = []
    for piece in field.pieces:
        (a, a_x), (d, d_x) = _level(piece.a, x), _level(piece.d, x)
        lever = c - piece.pivot
        pieces.append((a, a * lever + d, a_x * lever + d_x))
    own, _, along = pieces[0]
    up: FloatArray = np.zeros((1, 1, 1))
    for k in range(len(pieces) - 1):
        (h, h_x), (top, top_x) = heights[k], heights[k + 1]
        gap = top - h
        s = (z - h) / gap
        b, turn = field.blend.value(s), field.blend.slope(s) / gap
        da, de, de_x = (after - before for after, before in zip(pieces[k + 1], pieces[k]))  # noqa
        own = own + da * b
        if field.axis == "y":
            continue
        rise = de * turn
        along = along + de_x * b - rise * (h_x + s * (top_x - h_x))
        up = up + rise
    if field.axis == "y":
        return {"yy": own * (field.tube.slope(y) if field.tube else np.ones((1, 1, 1)))}
    if field.axis == "x":
        return {"xx": along + own, "xz": up}
    return {"zx": along, "zz": up + own}


def _of_rake(field: Rake, x: FloatArray, z: FloatArray) -> _Entries:
    t = (z - field.z0) / field.w
    along = field.course.slope(x) * (field.q * field.w) * field.blend.ramp(t)
    return {"xx": along, "xz": field.course.at(x) * field.q * field.blend.value(t)}


def _of_corner(layer: CornerLayer, box: FloatArray, count: int) -> Samples:
    """Sample along bottom and side, over all of both that the box reaches."""
    cos, tan = math.cos(layer.rise), math.tan(layer.rise)
    inward = layer.y - _line(box, 1, 2)
    lift = inward * tan
    eta = np.linspace(inward.min() / cos, inward.max() / cos, count)
    low, high = box[0, 2] - layer.z + lift.min(), box[1, 2] - layer.z + lift.max()
    zeta = np.linspace(low, high, count)
    every = _line(box, 0, count)
    x = _extremes(every, [layer.course.at(every)], 3)
    a = layer.course.at(x)[:, None, None]
    c, k = layer.fade.at(eta)[None, :, None], layer.fade.at(zeta)[None, None, :]
    c_eta, k_zeta = layer.fade.slope(eta)[None, :, None], layer.fade.slope(zeta)[None, None, :]
    p, q = (layer.eta_ratio - 1.0) * a, (layer.zeta_ratio - 1.0) * a
    e, s = eta[None, :, None], zeta[None, None, :]
    entries = {
        "yy": p * (c + e * c_eta) * k, "yz": p * (e * c) * k_zeta,
        "zy": q * (s * k) * c_eta, "zz": q * c * (k + s * k_zeta),
    }  # fmt: skip
    skew = np.array([[1.0, 0.0, 0.0], [0.0, -cos, 0.0], [0.0, -math.sin(layer.rise), 1.0]])
    centre = np.stack(np.meshgrid(x, [0.0], zeta + layer.z, indexing="ij"), axis=-1)
    torn = bool((layer.displacement(centre.reshape(-1, 3))[:, 1] != 0.0).any())
    return Samples(
        (x, eta, zeta), entries, "yz", skew, np.array([0.0, layer.y, layer.z]), torn
    )  # fmt: skip


def _of_shear(layer: DeadriseLayer, box: FloatArray, count: int) -> Samples:
    x, y, z = _line(box, 0, count), _line(box, 1, _EVEN), _line(box, 2, count)
    ramp = layer.ramp(y)[0][None, :, None]
    along = layer.course.at(x)[:, None, None] * layer.q
    return Samples((x, y, z), {"zz": along * ramp * layer.fade.slope(z)[None, None, :]}, "yz")


def _of_additive(layer: AdditiveLayer, box: FloatArray, count: int) -> Samples:
    every, y, z = (_line(box, axis, count) for axis in range(3))
    given = [layer.x.slope(every)] if layer.x is not None else []
    given += [each[0].at(every) for each in (layer.y, layer.z) if each is not None]
    x = _extremes(every, given)
    entries = _Entries()
    if layer.x is not None:
        entries["xx"] = layer.x.slope(x)[:, None, None]
    for axis, factors in (("y", layer.y), ("z", layer.z)):
        if factors is not None:
            by_y, by_z = _product(factors, x, y, z)
            entries |= {f"{axis}y": by_y, f"{axis}z": by_z}
    return Samples((x, y, z), entries, "yz")


def _product(
    factors: Factors, x: FloatArray, y: FloatArray, z: FloatArray
) -> tuple[FloatArray, FloatArray]:
    first, second, third = factors
    along = first.at(x)[:, None, None]
    by_y = second.slope(y)[None, :, None] * third.at(z)[None, None, :]
    by_z = second.at(y)[None, :, None] * third.slope(z)[None, None, :]
    return along * by_y, along * by_z
