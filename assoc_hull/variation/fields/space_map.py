"""The map of a variation, and its inverse.

A map is a tuple of layers that act one after the other on places (n, 3), m. Its inverse undoes
them in reverse order by Newton's method, block by block of the coordinates that a layer couples,
with nested bracketed roots where Newton's method stalls. The fold check makes these brackets safe:
if all principal minors are positive, the innermost equation rises in its unknown, and so does
every outer one once the inner ones are solved.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import places
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.polynomials import false_position
from assoc_hull.variation.fields.field import FieldRegion
from assoc_hull.variation.fields.layers import (
    AdditiveLayer,
    CornerLayer,
    DeadriseLayer,
    FieldLayer,
    Layer,
)

__all__ = [
    "SlopedMap",
    "VariationMap",
    "inverse_map",
    "moved_coordinates",
    "solve_coordinates",
]

# --------------------------------------------------------------------------------------
# A layer of fields moves x and z by what depends on x and z alone: these two are solved first,
# then y. Corner and deadrise layers leave x, additive functions have an x of their own; all three
# couple y and z. Any other layer is solved for all three at once. A step is halved while the
# residual grows.

Axes = tuple[int, ...]

_EPS = float(np.finfo(np.float64).eps)

_ENOUGH = 8.0
"""Residuals of so many roundings of the coordinates come from evaluating the map itself."""

_MOST = 128.0
"""So many roundings are accepted at last: a steep field makes its own rounding larger."""

_STEPS = 40
_HALVINGS = 40
_DOUBLINGS = 64

_FAR = 1e6
"""A bracket reaches so far at most, m: beyond, no place has a meaning for a ship."""

_BLOCKS: dict[type, tuple[Axes, ...]] = {
    AdditiveLayer: ((0,), (1, 2)),
    FieldLayer: ((0, 2), (1,)),
    CornerLayer: ((0,), (1, 2)),
    DeadriseLayer: ((0,), (1, 2)),
}
"""Which coordinates a layer couples, in the order in which they can be solved."""


def inverse_map(layers: tuple[Layer, ...], xyz: ArrayLike) -> FloatArray:
    """Give the places that a map of layers takes to given ones.

    Parameters
    ----------
    layers : tuple of Layer
        In the order in which they act.
    xyz : (n, 3), m
        Places after the map.

    Returns
    -------
    (n, 3), m
        Places before it, frozen; those outside every region keep their bits.

    Raises
    ------
    BadInputError
        Places that are no places, or a map that folds there.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.bounded_functions import BlendChain
    >>> from assoc_hull.variation.fields.layers import FieldLayer
    >>> from assoc_hull.variation.fields.anchor_fields import hat_field
    >>> from assoc_hull.variation.fields.space_map import inverse_map
    >>> fade = BlendChain.through([6, 66], [1, 0])
    >>> shaft = hat_field("shaft", [("base", 0, 0), ("shaft", 5, 1), ("T", 18, 0)], fade)
    >>> inverse_map((FieldLayer("local", (shaft,)),), [[6.0, 0.7, 6.0]]).round(12).tolist()
    [[6.0, 0.7, 5.0]]
    """
    found = places(xyz, "xyz", "in inverse") if np.size(xyz) else np.zeros((0, 3))
    for layer in reversed(layers):
        image, found = found, found.copy()
        for axes in _BLOCKS.get(type(layer), ((0, 1, 2),)):
            solve_coordinates(layer, image, found, axes)
    freeze(found)
    return found


def solve_coordinates(layer: Layer, image: FloatArray, found: FloatArray, axes: Axes) -> None:
    """Solve for some coordinates of the places before a layer, the others being known.

    Parameters
    ----------
    layer : Layer
    image : (n, 3), m
        Places after the layer; only the coordinates of `axes` count.
    found : (n, 3), m
        Places before it: the start in the coordinates of `axes`, which are overwritten.
    axes : tuple of int
        Coordinates, outermost first.

    Raises
    ------
    BadInputError
        Neither Newton's method nor nested bracketed roots find a place.
    """
    enough = _ENOUGH * _EPS * (np.abs(image[:, axes]).sum(axis=1) + 1.0)
    rows = _newton(layer, image, found, axes, enough)
    if not len(rows):
        return
    with np.errstate(all="ignore"):
        found[rows] = _nested(layer, image[rows], found[rows], axes, enough[rows])
    left = np.abs(_residual(layer, image[rows], found[rows], axes)).sum(axis=1)
    bad = np.flatnonzero(~(left <= _MOST / _ENOUGH * enough[rows]))
    if len(bad):
        worst = bad[int(np.argmax(left[bad]))]
        x, _, z = image[rows[worst]].tolist()
        raise BadInputError(
            f"inverse did not converge at (x', z') = ({x:.3f}, {z:.3f}): {left[worst]:.2g} m after "
            f"nested bracketing", f"in layer '{layer.name}'",
            "certify the map: one that folds has no inverse",
        )  # fmt: skip


def _residual(layer: Layer, image: FloatArray, found: FloatArray, axes: Axes) -> FloatArray:
    """Give the residual of places before a layer: their images less the places after, (n, k), m."""
    away: FloatArray = (found + layer.displacement(found) - image)[:, axes]
    return away


def _newton(
    layer: Layer, image: FloatArray, found: FloatArray, axes: Axes, enough: FloatArray
) -> IntArray:
    """Step by Newton's method in place; give the rows that it does not solve.

    Those it solves make one step more, if that still lessens the residual: it costs little, and
    roundings of several layers add up.
    """
    away = _residual(layer, image, found, axes)
    open_ = np.flatnonzero(~(np.abs(away).sum(axis=1) <= enough))
    stalled = list[IntArray]()
    for _ in range(_STEPS):
        if not len(open_):
            break
        better = _damped(layer, image, found, axes, open_, away, _HALVINGS)
        stalled.append(open_[~better])
        open_ = open_[better]
        open_ = open_[~(np.abs(away[open_]).sum(axis=1) <= enough[open_])]
    size = np.abs(away).sum(axis=1)
    _damped(layer, image, found, axes, np.flatnonzero((size > 0.0) & (size <= enough)), away, 1)
    return np.sort(np.concatenate([*stalled, open_]))


def _damped(
    layer: Layer, image: FloatArray, found: FloatArray, axes: Axes, open_: IntArray,
    away: FloatArray, trials: int,
) -> np.typing.NDArray[np.bool_]:  # fmt: skip
    """Take the largest of the halved steps that lessen the residual; say where there is one."""
    step = _cramer(layer.jacobian(found[open_])[:, axes][:, :, axes], away[open_])
    before = np.abs(away[open_]).sum(axis=1)
    better = np.zeros(len(open_), bool)
    left, part = np.flatnonzero(np.isfinite(step).all(axis=1)), 1.0
    for _ in range(trials):
        if not len(left):
            break
        rows = open_[left]
        trial = found[rows]
        trial[:, axes] -= part * step[left]
        miss = _residual(layer, image[rows], trial, axes)
        good = np.abs(miss).sum(axis=1) < before[left]
        found[rows[good]], away[rows[good]] = trial[good], miss[good]
        better[left[good]] = True
        left, part = left[~good], 0.5 * part
    return better


def _cramer(slope: FloatArray, away: FloatArray) -> FloatArray:
    """Solve one, two or three linear equations a row; not finite where they are singular."""
    with np.errstate(all="ignore"):
        if slope.shape[1] == 1:
            return np.asarray(away / slope[:, 0])
        if slope.shape[1] == 2:
            (a, b), (c, d) = slope[:, 0].T, slope[:, 1].T
            p, q = away.T
            return np.asarray(np.stack([d * p - b * q, a * q - c * p], axis=1)
                              / (a * d - b * c)[:, None])  # fmt: skip
        first, second, third = slope[:, :, 0], slope[:, :, 1], slope[:, :, 2]
        across = np.cross(second, third), np.cross(third, first), np.cross(first, second)
        volume = (first * across[0]).sum(axis=1)
        return np.asarray(np.stack([(away * each).sum(axis=1) for each in across], axis=1)
                          / volume[:, None])  # fmt: skip


def _nested(
    layer: Layer, image: FloatArray, xyz: FloatArray, axes: Axes, enough: FloatArray
) -> FloatArray:
    """Solve the outermost coordinate in a bracket; the inner ones anew for each of its trials."""
    if not axes:
        return xyz
    axis, inner = axes[0], axes[1:]

    def give(rows: IntArray, at: FloatArray) -> FloatArray:
        trial = xyz[rows]
        trial[:, axis] = at
        trial = _nested(layer, image[rows], trial, inner, enough[rows])
        return _residual(layer, image[rows], trial, (axis,))[:, 0]

    every = np.arange(len(xyz))
    low = image[:, axis].copy()
    at_low = give(every, low)
    high, at_high = low.copy(), at_low.copy()
    # the residual rises in the unknown, so its sign says on which side the root lies
    reach = np.where(at_low >= 0.0, -1.0, 1.0) * (np.abs(at_low) + enough)
    for _ in range(_DOUBLINGS):
        rows = np.flatnonzero(((at_low >= 0.0) == (at_high >= 0.0)) & (np.abs(reach) < _FAR))
        if not len(rows):
            break
        high[rows] += reach[rows]
        at_high[rows] = give(rows, high[rows])
        reach[rows] *= 2.0
    found = xyz.copy()
    found[:, axis] = false_position(give, low, high, at_low, at_high, enough)
    return _nested(layer, image, found, inner, enough)


class SlopedMap(Protocol):
    """A map of places, with its Jacobian."""

    def __call__(self, xyz: FloatArray, /) -> FloatArray:
        """Map places (n, 3), m."""
        ...

    def jacobian(self, xyz: FloatArray, /) -> FloatArray:
        """Give the derivatives of the places after by those before, (n, 3, 3)."""
        ...


def moved_coordinates(layers: Sequence[Layer]) -> tuple[bool, bool, bool]:
    """Tell whether layers may change x, y and z of places; those that are not known change all."""
    found = set[str]()
    for layer in layers:
        if type(layer) is FieldLayer:
            found |= {each.axis for each in layer.fields}
        elif type(layer) is CornerLayer:
            found |= {"y", "z"}
        elif type(layer) is DeadriseLayer:
            found.add("z")
        else:
            found |= {"x", "y", "z"}
    return "x" in found, "y" in found, "z" in found


@attrs.frozen(eq=False)
class VariationMap:
    """Layers in the order in which they act.

    Attributes
    ----------
    layers : tuple of Layer

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.bounded_functions import BlendChain
    >>> from assoc_hull.variation.fields.layers import FieldLayer
    >>> from assoc_hull.variation.fields.anchor_fields import hat_field
    >>> from assoc_hull.variation.fields.space_map import VariationMap
    >>> fade = BlendChain.through([6, 66], [1, 0])
    >>> shaft = hat_field("shaft", [("base", 0, 0), ("shaft", 5, 1), ("T", 18, 0)], fade)
    >>> vmap = VariationMap((FieldLayer("local", (shaft,)),))
    >>> vmap(np.array([[6.0, 0.7, 5.0], [200.0, 20.0, 5.0]])).tolist()
    [[6.0, 0.7, 6.0], [200.0, 20.0, 5.0]]
    """

    layers: tuple[Layer, ...]

    def __call__(self, xyz: FloatArray) -> FloatArray:
        """Map places (n, 3), m; outside the regions they keep their bits."""
        for layer in self.layers:
            xyz = xyz + layer.displacement(xyz)
        return xyz

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        """Give the derivatives of the places after by those before, (n, 3, 3)."""
        found = np.tile(np.eye(3), (len(xyz), 1, 1))
        for layer in self.layers:
            found = (layer.jacobian(xyz)[:, :, :, None] * found[:, None, :, :]).sum(axis=2)
            xyz = xyz + layer.displacement(xyz)
        return found

    def inverse(self, xyz: ArrayLike) -> FloatArray:
        """Give the places (n, 3), m, that are mapped to given ones.

        Raises
        ------
        BadInputError
            Places that are no places, or a map that folds there.
        """
        return inverse_map(self.layers, xyz)

    def regions(self) -> tuple[FieldRegion, ...]:
        """Give the boxes of the profile plane outside which nothing moves."""
        return tuple(region for layer in self.layers for region in layer.regions())
