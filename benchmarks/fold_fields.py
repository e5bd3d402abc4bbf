"""Layers of a map drawn at random, as the fold check meets them; of strength 1, to be scaled.

The hull is 240 m long, 40 m wide and 20 m high. Fields are hats, steps, ratios and ramps between
level, sloping and curved boundaries, one to four in a layer, along x, y and z. A layer is of such
fields, or a corner, a shear of the bottom, or additive functions.
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.anchor_fields import hat_field
from assoc_hull.variation.fields.bounded_functions import (
    CUBIC,
    QUINTIC,
    Blend,
    BlendChain,
    BoundedFunction,
    Contour,
    Polynomial,
    Ramp,
)
from assoc_hull.variation.fields.field import AffinePiece, Axis, Boundary, StackedField, Tube
from assoc_hull.variation.fields.layers import (
    AdditiveLayer,
    CornerLayer,
    DeadriseLayer,
    Factors,
    FieldLayer,
    Layer,
    Rake,
)
from assoc_hull.variation.fields.shift_shapes import Bump, BumpShape

__all__ = ["LENGTH", "draw_box", "draw_layer", "scaled"]

LENGTH, BEAM, DEPTH = 240.0, 40.0, 20.0

_Rng = np.random.Generator
_SHAPES: tuple[BumpShape, ...] = ("c1", "c2", "end", "half", "lackenby")
_NONE = BlendChain.constant(0.0)


def draw_box(rng: _Rng) -> FloatArray:
    """Draw the box of a hull, (2, 3), m: with and without what lies below the base line."""
    low = [rng.uniform(-10.0, 5.0), -0.5 * BEAM, rng.uniform(-3.0, 1.0)]
    return np.array([low, [LENGTH + rng.uniform(-5.0, 8.0), 0.5 * BEAM, rng.uniform(14.0, 22.0)]])


def draw_layer(rng: _Rng, name: str) -> Layer:
    """Draw a layer of strength 1; four of five are of fields."""
    others = _corner, _shear, _additive
    kind = int(rng.integers(0, 15))
    if kind < len(others):
        return others[kind](rng, name)
    if kind < 6:
        return FieldLayer(name, (*_crossed(rng), *_fields(rng, int(rng.integers(0, 3)))))
    if kind < 9:
        return FieldLayer(name, _alike(rng))
    return FieldLayer(name, _fields(rng, int(rng.integers(1, 5))))


def scaled(layer: Layer, strength: float) -> Layer:
    """Give a layer times a factor."""
    if isinstance(layer, FieldLayer):
        fields = tuple(each.scaled(strength) for each in layer.fields)
        return FieldLayer(layer.name, fields)
    if isinstance(layer, CornerLayer):
        ratios = (1.0 + strength * (each - 1.0) for each in (layer.eta_ratio, layer.zeta_ratio))
        eta_ratio, zeta_ratio = ratios
        return attrs.evolve(layer, eta_ratio=eta_ratio, zeta_ratio=zeta_ratio)
    if isinstance(layer, DeadriseLayer):
        return attrs.evolve(layer, q=strength * layer.q)
    assert isinstance(layer, AdditiveLayer)
    x = None if layer.x is None else layer.x.scaled(strength)
    return AdditiveLayer(layer.name, x, _times(layer.y, strength), _times(layer.z, strength))


def _times(factors: Factors | None, strength: float) -> Factors | None:
    return None if factors is None else (factors[0].scaled(strength), *factors[1:])


def _blend(rng: _Rng) -> Blend:
    return QUINTIC if rng.random() < 0.5 else CUBIC


def _chance(rng: _Rng, part: float) -> bool:
    return bool(rng.random() < part)


def _nodes(rng: _Rng, least: float = 8.0, most: int = 4) -> FloatArray:
    """Draw places along the ship, from aft of the AP on."""
    steps = rng.uniform(least, 60.0, int(rng.integers(1, most)))
    return rng.uniform(-20.0, 190.0) + np.concatenate([[0.0], np.cumsum(steps)])


def _course(rng: _Rng, size: float) -> BoundedFunction:
    """Draw a function along the ship: chains that fade, others, and the same everywhere."""
    kind = rng.random()
    if kind < 0.15:
        return BlendChain.constant(rng.uniform(-size, size))
    nodes = _nodes(rng)
    if kind < 0.25:
        begin, end = rng.permutation(nodes[[0, -1]]).tolist()
        return Bump(begin, end, rng.uniform(-size, size), _SHAPES[rng.integers(0, 5)])
    values = rng.uniform(-size, size, len(nodes))
    if kind < 0.35 and len(nodes) > 2:
        return Contour(nodes, values)
    if _chance(rng, 0.7):
        values[-1 if _chance(rng, 0.5) else 0] = 0.0
    return BlendChain(nodes, values, _blend(rng))


def _boundaries(rng: _Rng, level: bool) -> tuple[Boundary, ...]:
    """Draw a stack, all level or with curves that slope or follow a contour."""
    gaps = rng.uniform(1.0, 8.0, int(rng.integers(0, 4)))
    heights = rng.uniform(-2.0, 10.0) + np.concatenate([[0.0], np.cumsum(gaps)])
    room = 0.45 * float(gaps.min(initial=8.0))
    curves = []
    for k, height in enumerate(heights.tolist()):
        nodes = _nodes(rng, 20.0, 5)
        curve: BoundedFunction = BlendChain.constant(height)
        if not level and _chance(rng, 0.6):
            curve = BlendChain(nodes[:2], height + rng.uniform(-room, room, 2), _blend(rng))
        elif not level and len(nodes) > 2:
            curve = Contour(nodes, height + rng.uniform(-room, room, len(nodes)))
        curves.append(Boundary(f"h{k}", curve))
    return tuple(curves)


def _fields(rng: _Rng, count: int) -> tuple[StackedField | Rake, ...]:
    kinds: tuple[Callable[[_Rng], StackedField | Rake], ...] = (
        _hat,
        _steps,
        _affine,
        _affine,
        _rake,
    )
    return tuple(kinds[rng.integers(0, len(kinds))](rng) for _ in range(count))


def _alike(rng: _Rng) -> tuple[StackedField, ...]:
    """Draw one to three fields that move the same coordinate, with boundaries of their own."""
    axis: Axis = ("x", "y", "z")[rng.integers(0, 3)]
    return tuple(_affine(rng, axis, level=False) for _ in range(int(rng.integers(1, 4))))


def _hat(rng: _Rng) -> StackedField:
    """Draw a rounded hat of z or x, with windows about its anchors or outward of one."""
    gaps = rng.uniform(2.0, 8.0, int(rng.integers(2, 5)))
    z = rng.uniform(-2.0, 5.0) + np.concatenate([[0.0], np.cumsum(gaps)])
    moved = np.concatenate([[0.0], rng.uniform(-1.0, 1.0, len(z) - 2), [0.0]])
    anchors = [(f"a{k}", float(z[k]), float(moved[k])) for k in range(len(z))]
    axis: Axis = "z" if _chance(rng, 0.8) else "x"
    outward = ["a1"] if _chance(rng, 0.2) else []
    return hat_field(
        "hat", anchors, _course(rng, 1.0), axis=axis, blend=_blend(rng), outward=outward
    )


def _steps(rng: _Rng) -> StackedField:
    """Draw shifts of z or x, that are other at every boundary."""
    axis: Axis = "z" if _chance(rng, 0.6) else "x"
    return _laid(rng, axis, lambda _: AffinePiece(_NONE, 0.0, _course(rng, 1.0)))


def _affine(rng: _Rng, axis: Axis | None = None, *, level: bool | None = None) -> StackedField:
    """Draw ratios, of z and x with shifts and pivots, of y in a tube or not."""
    moved: Axis = ("x", "y", "z")[rng.integers(0, 3)] if axis is None else axis
    if moved == "y":
        return _laid(rng, moved, lambda _: AffinePiece(_course(rng, 0.2), 0.0, _NONE), level)
    if moved == "x":
        pivot = float(rng.uniform(0.0, LENGTH))
        return _laid(
            rng, moved, lambda _: AffinePiece(_course(rng, 0.02), pivot, _course(rng, 0.5)), level
        )
    return _laid(
        rng, moved, lambda height: AffinePiece(_course(rng, 0.1), height, _course(rng, 0.5)), level
    )


def _laid(
    rng: _Rng, axis: Axis, piece: Callable[[float], AffinePiece], level: bool | None = None
) -> StackedField:
    """Lay a field out over boundaries that keep their order; its outer pieces may be nil."""
    while True:
        boundaries = _boundaries(rng, _chance(rng, 0.5) if level is None else level)
        pieces = [piece(float(each.height.at(np.zeros(1))[0])) for each in boundaries]
        for k in (0, -1):
            if len(pieces) > 1 and _chance(rng, 0.5):
                pieces[k] = AffinePiece(_NONE, 0.0, _NONE)
        tube = None
        if axis == "y" and _chance(rng, 0.6):
            tube = Tube(rng.uniform(0.5, 4.0), rng.uniform(3.0, 8.0), _blend(rng))
        try:
            return StackedField.checked(
                "laid", axis, boundaries, pieces, blend=_blend(rng), tube=tube
            )
        except BadInputError:
            continue


def _rake(rng: _Rng) -> Rake:
    """Draw a rake of stem or stern."""
    q, z0, w = rng.uniform(-0.3, 0.3), rng.uniform(2.0, 14.0), rng.uniform(1.0, 6.0)
    return Rake("rake", _course(rng, 1.0), q, z0, w, _blend(rng))


def _crossed(rng: _Rng) -> tuple[StackedField | Rake, StackedField]:
    """Draw two fields of which only the determinant suffers.

    Lengths move by height alone and heights along the ship alone.
    """
    z, size = float(rng.uniform(2.0, 12.0)), float(rng.uniform(1.0, 4.0))
    along: StackedField | Rake = Rake(
        "lean", BlendChain.constant(1.0), 0.3 * size, z, 2.0, _blend(rng)
    )
    if _chance(rng, 0.7):
        heights = z, z + float(rng.uniform(1.0, 4.0))
        walls = [Boundary(f"s{k}", BlendChain.constant(each)) for k, each in enumerate(heights)]
        sizes = 0.0, size * float(rng.choice([-1.0, 1.0]))
        pieces = [AffinePiece(_NONE, 0.0, BlendChain.constant(each)) for each in sizes]
        along = StackedField.checked("slide", "x", walls, pieces, blend=_blend(rng))
    nodes = _nodes(rng)
    rise = BlendChain(nodes, rng.uniform(-3.0, 3.0, len(nodes)), _blend(rng))
    return along, StackedField(
        "lift", "z", (Boundary("foot", _NONE),), (AffinePiece(_NONE, 0.0, rise),)
    )


def _corner(rng: _Rng, name: str) -> CornerLayer:
    """Draw a bilge that becomes larger or smaller, with rise of floor or none."""
    radius = float(rng.uniform(1.0, 3.0))
    reach = radius * float(rng.uniform(3.0, 8.0))
    fade = BlendChain(np.array([radius, reach]), np.array([1.0, 0.0]), _blend(rng))
    eta_ratio, zeta_ratio = rng.uniform(0.5, 1.5, 2).tolist()
    rise = 0.0 if _chance(rng, 0.5) else float(rng.uniform(-0.02, 0.05))
    course = _course(rng, 1.0)
    return CornerLayer(name, course, 0.5 * BEAM, rng.uniform(0.0, 1.0), rise, eta_ratio, zeta_ratio,
                       fade)  # fmt: skip


def _shear(rng: _Rng, name: str) -> DeadriseLayer:
    """Draw a bottom that rises outward from the keel, ramped or not."""
    fade = BlendChain(
        np.array([rng.uniform(1.0, 5.0), rng.uniform(8.0, 16.0)]), np.array([1.0, 0.0]), _blend(rng)
    )
    width = 0.0 if _chance(rng, 0.3) else float(rng.uniform(0.5, 4.0))
    return DeadriseLayer(name, _course(rng, 1.0), rng.uniform(-0.1, 0.1), rng.uniform(0.0, 3.0),
                         width, fade, _blend(rng))  # fmt: skip


def _additive(rng: _Rng, name: str) -> AdditiveLayer:
    """Draw additive functions: shifts of x, and products of functions for y and z."""
    x = _course(rng, 2.0) if _chance(rng, 0.5) else None
    y: Factors | None = None
    if _chance(rng, 0.6):
        out = rng.choice(np.array(["ratio", "ramp", "chain"]))
        factors: dict[str, BoundedFunction] = {
            "ratio": Polynomial(np.array([0.0, 0.1])),
            "ramp": Ramp(rng.uniform(0.0, 5.0), rng.uniform(1.0, 8.0), 0.1, _blend(rng)),
            "chain": BlendChain(np.array([2.0, rng.uniform(8.0, 18.0)]), np.array([0.0, 1.0])),
        }
        y = _course(rng, 1.0), factors[str(out)], _upright(rng)
    z: Factors | None = None
    if y is None or _chance(rng, 0.6):
        wide = BlendChain(np.array([rng.uniform(0.0, 6.0), 15.0]), rng.uniform(-1.0, 1.0, 2))
        z = _course(rng, 1.0), wide, _upright(rng)
    return AdditiveLayer(name, x, y, z)


def _upright(rng: _Rng) -> BoundedFunction:
    """Draw a function of the height."""
    steps = rng.uniform(2.0, 6.0, int(rng.integers(1, 4)))
    z = rng.uniform(-2.0, 8.0) + np.concatenate([[0.0], np.cumsum(steps)])
    return BlendChain(z, rng.uniform(-1.0, 1.0, len(z)), _blend(rng))
