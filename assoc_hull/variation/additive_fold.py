"""Whether additive functions fold a hull: bounds of all principal minors, box by box.

The Jacobian of additive functions has an x of its own and a block of y and z,

    1 + F1'                        at the place x
    [1 + F2 F3' F4    F2 F3 F4']
    [F5 F6' F7    1 + F5 F6 F7']   at the place (x, |y|, z)

so the principal minors are positive everywhere, and the map is one to one, if F1' > -1 and both
entries of the diagonal and the determinant of the block are positive. Each F has exact bounds on
an interval; what is not decided by them on a box is halved.

Reference: D. Gale, H. Nikaido, "The Jacobian matrix and global univalence of mappings",
Mathematische Annalen 159 (1965).
"""

from __future__ import annotations

from typing import Literal

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import number, places
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.additive import AdditiveLayer, Factors

__all__ = ["AdditiveFold", "additive_fold"]

Bounds = tuple[FloatArray, FloatArray]
"""Least and greatest values, box by box."""

_NAMES = ("X_x", "Y_y", "Z_z", "Y_y Z_z - Y_z Z_y")
_ROUNDING = 64.0 * float(np.finfo(np.float64).eps)
_DEPTH = 42
"""Halvings of a box: fourteen of each of its sides."""

_MOST_BOXES = 200_000


@attrs.frozen
class AdditiveFold:
    """What the fold check of a layer of additive functions found.

    Attributes
    ----------
    verdict : {"certified", "refused", "undecided"}
    least : float
        Certified: all minors are at least this. Else the least minor that was met.
    minor : str
        Which minor that is.
    place : (float, float, float) or None, m
        Refused: where it is.
    boxes : int
        Boxes that were looked at.
    """

    verdict: Literal["certified", "refused", "undecided"]
    least: float
    minor: str
    place: tuple[float, float, float] | None
    boxes: int

    @property
    def holds(self) -> bool:
        """Tell whether the layer is certified."""
        return self.verdict == "certified"


def additive_fold(layer: AdditiveLayer, box: ArrayLike, least: float = 0.05) -> AdditiveFold:
    """Check that a layer keeps space the right way round in a box, with something to spare.

    Parameters
    ----------
    layer : AdditiveLayer
        The layer.
    box : (2, 3), m
        Least and greatest coordinates; both sides of the ship are checked as one.
    least : float
        What every principal minor is to reach.

    Returns
    -------
    AdditiveFold
        The verdict.

    Raises
    ------
    BadInputError
        A box that is none.

    Examples
    --------
    >>> from assoc_hull.variation.additive import AdditiveLayer
    >>> from assoc_hull.variation.additive_fold import additive_fold
    >>> from assoc_hull.variation.chain import Chain
    >>> hump = Chain.through([0, 5, 18], [0, 1, 0])
    >>> layer = AdditiveLayer("shaft", z=(Chain.constant(2), Chain.constant(1), hump))
    >>> round(additive_fold(layer, [[0, 0, 0], [60, 20, 18]]).least, 3)
    0.712
    """
    corners = places(box, "box", "in additive_fold")
    if corners.shape != (2, 3) or (corners[1] < corners[0]).any():
        raise BadInputError(
            "the box has no extent", "in additive_fold", "give least and greatest coordinates"
        )
    number(least, "least", "in additive_fold")
    port = _to_port(corners)
    todo, depth, boxes, certified = port[None], 0, 0, np.inf
    name = _NAMES[0]
    while len(todo):
        boxes += len(todo)
        lows = _lower_bounds(layer, todo)
        values = _at_centres(layer, todo)
        if (values < least).any():
            minor, row = np.unravel_index(int(values.argmin()), values.shape)
            x, y, z = todo[row].mean(axis=0).tolist()
            return AdditiveFold(
                "refused", float(values.min()), _NAMES[int(minor)], (x, y, z), boxes
            )
        done = (lows >= least).all(axis=0)
        if done.any() and lows[:, done].min() < certified:
            certified = float(lows[:, done].min())
            name = _NAMES[int(lows[:, done].min(axis=1).argmin())]
        todo, depth = _halved(todo[~done]), depth + 1
        if len(todo) and (depth > _DEPTH or boxes > _MOST_BOXES):
            worst = lows[:, ~done]
            name = _NAMES[int(worst.min(axis=1).argmin())]
            return AdditiveFold("undecided", float(worst.min()), name, None, boxes)
    return AdditiveFold("certified", certified, name, None, boxes)


def _to_port(box: FloatArray) -> FloatArray:
    """Give the box of half-breadths."""
    found = box.copy()
    reach = np.abs(box[:, 1])
    found[0, 1] = 0.0 if box[0, 1] <= 0.0 <= box[1, 1] else reach.min()
    found[1, 1] = reach.max()
    return found


def _halved(boxes: FloatArray) -> FloatArray:
    """Halve boxes (m, 2, 3) across the longest of their sides."""
    if not len(boxes):
        return boxes
    row = np.arange(len(boxes))
    axis = (boxes[:, 1] - boxes[:, 0]).argmax(axis=1)
    middle = 0.5 * (boxes[row, 0, axis] + boxes[row, 1, axis])
    lower, upper = boxes.copy(), boxes.copy()
    lower[row, 1, axis] = middle
    upper[row, 0, axis] = middle
    return np.concatenate([lower, upper])


def _at_centres(layer: AdditiveLayer, boxes: FloatArray) -> FloatArray:
    """Give the four minors at the centres of boxes, (4, m)."""
    j = layer.jacobian(boxes.mean(axis=1))
    block = j[:, 1, 1] * j[:, 2, 2] - j[:, 1, 2] * j[:, 2, 1]
    return np.stack([j[:, 0, 0], j[:, 1, 1], j[:, 2, 2], block])


def _lower_bounds(layer: AdditiveLayer, boxes: FloatArray) -> FloatArray:
    """Give what the four minors are at least on boxes, (4, m)."""
    nil = np.zeros(len(boxes))
    one = 1.0 + nil, 1.0 + nil
    along = one
    if layer.x is not None:
        along = _plus(one, layer.x.slope_bounds(boxes[:, 0, 0], boxes[:, 1, 0]))
    y_y, y_z = _slopes(layer.y, boxes)
    z_y, z_z = _slopes(layer.z, boxes)
    y_y, z_z = _plus(one, y_y), _plus(one, z_z)
    cross = _times(y_z, z_y)
    block = _plus(_times(y_y, z_z), (-cross[1], -cross[0]))
    return np.stack([along[0], y_y[0], z_z[0], block[0]])


def _slopes(factors: Factors | None, boxes: FloatArray) -> tuple[Bounds, Bounds]:
    """Bound the derivatives of a product by half-breadth and by z."""
    if factors is None:
        nil = np.zeros(len(boxes))
        return (nil, nil), (nil, nil)
    sides = [(boxes[:, 0, axis], boxes[:, 1, axis]) for axis in range(3)]
    first, second, third = (
        course.bounds(*side) for course, side in zip(factors, sides, strict=True)
    )
    by_y, by_z = (factors[axis].slope_bounds(*sides[axis]) for axis in (1, 2))
    return _times(_times(first, by_y), third), _times(_times(first, second), by_z)


def _plus(one: Bounds, other: Bounds) -> Bounds:
    low, high = one[0] + other[0], one[1] + other[1]
    return low - _ROUNDING * np.abs(low), high + _ROUNDING * np.abs(high)


def _times(one: Bounds, other: Bounds) -> Bounds:
    products = np.stack([a * b for a in one for b in other])
    low, high = products.min(axis=0), products.max(axis=0)
    slack = _ROUNDING * np.abs(products).max(axis=0)
    return low - slack, high + slack
