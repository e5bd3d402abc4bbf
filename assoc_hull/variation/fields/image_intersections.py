"""Intersections of the exact image of curves with planes, without lofting anything again.

The image of a parent curve P(t) under the map M intersects the plane x, y or z = c where ``g(t) =
M(P(t)) - c``, of that coordinate, has a root. Where no pieces of a layer join (between its
creases) g is smooth, so brackets begin and end at creases, at knots, and where g turns toward the
plane. The result tells how far a line that was lofted again is from the exact one.
"""

from __future__ import annotations

from typing import Protocol, runtime_checkable

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import choice, number, places
from assoc_hull.edit.recut.driver_image import ImageIntersections
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.polynomials import false_position
from assoc_hull.geometry.splines.segments import derivative, evaluate, segment_curve, segment_start
from assoc_hull.variation.fields.field import AffinePiece, Axis, FieldRegion, StackedField, Tube
from assoc_hull.variation.fields.layers import CornerLayer, DeadriseLayer, FieldLayer, Layer, Rake
from assoc_hull.variation.fields.space_map import VariationMap, solve_coordinates

__all__ = [
    "Creased",
    "creases",
    "intersect_images",
    "plane_source",
]

# --------------------------------------------------------------------------------------
# Creases: where pieces of a layer join. Between them a layer is a smooth function without narrow
# parts, which is what a search for roots along a curve needs to know.


@runtime_checkable
class Creased(Protocol):
    """A layer of another kind that says itself where its pieces join."""

    def creases(self, xyz: FloatArray) -> FloatArray:
        """Give functions of places (n, 3), m, that are zero on the creases, (n, k)."""
        ...


def creases(layer: Layer, xyz: FloatArray) -> FloatArray:
    """Give functions of places that are zero where pieces of a layer join.

    Parameters
    ----------
    layer : Layer
    xyz : (n, 3), m
        Places before the layer.

    Returns
    -------
    (n, k), m
        One column a crease; none for a layer of unknown kind.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.bounded_functions import BlendChain
    >>> from assoc_hull.variation.fields.image_intersections import creases
    >>> from assoc_hull.variation.fields.layers import FieldLayer, Rake
    >>> rake = Rake("rake", BlendChain.through([200, 230], [0, 1]), 0.05, 11.0, 3.0)
    >>> creases(FieldLayer("stem", (rake,)), np.array([[210.0, 0.0, 12.0]])).tolist()
    [[10.0, -20.0, 1.0, -2.0]]
    """
    if isinstance(layer, FieldLayer):
        return _joined(xyz, [part for field in layer.fields for part in _field(field, xyz)])
    if isinstance(layer, CornerLayer):
        return _joined(xyz, _corner(layer, xyz))
    if isinstance(layer, DeadriseLayer):
        out = np.abs(xyz[:, 1]) - layer.keel
        parts = [_less(xyz[:, 0], layer.course.nodes), _less(xyz[:, 2], layer.fade.nodes)]
        return _joined(xyz, [*parts, _less(out, np.unique([0.0, layer.width]))])
    return layer.creases(xyz) if isinstance(layer, Creased) else _joined(xyz, [])


def _less(value: FloatArray, places: FloatArray) -> FloatArray:
    """Give a value less each of some places, (n, k), m: zero at them."""
    found: FloatArray = value[:, None] - places
    return found


def _joined(xyz: FloatArray, parts: list[FloatArray]) -> FloatArray:
    """Put columns beside one another, (n, k); none give (n, 0)."""
    return np.concatenate([np.zeros((len(xyz), 0)), *parts], axis=1)


def _field(field: StackedField | Rake, xyz: FloatArray) -> list[FloatArray]:
    x, z = xyz[:, 0], xyz[:, 2]
    if isinstance(field, Rake):
        ramp = np.array([field.z0, field.z0 + field.w])
        return [_less(x, field.course.nodes), _less(z, ramp)]
    nodes = np.unique(np.concatenate([part for each in field.pieces for part in _nodes(each)]))
    heights = np.stack([each.height.at(x) for each in field.boundaries], axis=1)
    tube = [_less(np.abs(xyz[:, 1]), _radii(field.tube))] if field.tube else []
    return [_less(x, nodes), z[:, None] - heights, *tube]


def _nodes(piece: AffinePiece) -> list[FloatArray]:
    return [piece.a.nodes, piece.d.nodes]


def _radii(tube: Tube) -> FloatArray:
    return np.array([tube.radius, tube.n * tube.radius])


def _corner(layer: CornerLayer, xyz: FloatArray) -> list[FloatArray]:
    _, eta, zeta = layer.skew(xyz)
    fade = layer.fade.nodes
    return [_less(xyz[:, 0], layer.course.nodes), _less(eta, fade), _less(zeta, fade)]


# --------------------------------------------------------------------------------------
# Roots along the curves. Turns of g (roots of g') end brackets as well, so that a curve that only
# just passes a plane and comes back is found twice.

_SAMPLES = 8
"""Intervals a segment; between creases a map has no narrow parts."""

_NARROW = 4
"""Parts of every interval that ends on a crease."""

_ASIDE = 1e-9
"""Slopes are taken so far inside an interval, in parts of it: a knuckle has two at its place."""


def intersect_images(
    vmap: VariationMap, batch: SplineBatch, axis: Axis, value: float
) -> ImageIntersections:
    """Intersect the exact images of curves with a plane.

    Parameters
    ----------
    vmap : VariationMap
    batch : SplineBatch
        Curves of the parent.
    axis : {"x", "y", "z"}
        What is constant on the plane.
    value : float, m
        Its value, on the varied hull.

    Returns
    -------
    ImageIntersections
        Sorted by curve and parameter; a curve that only touches the plane has none.

    Raises
    ------
    BadInputError
        No axis, or a number that is none.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import CurveData
    >>> from assoc_hull.geometry.splines.loft import loft
    >>> from assoc_hull.variation.fields.bounded_functions import BlendChain
    >>> from assoc_hull.variation.fields.image_intersections import intersect_images
    >>> from assoc_hull.variation.fields.layers import FieldLayer
    >>> from assoc_hull.variation.fields.anchor_fields import hat_field
    >>> from assoc_hull.variation.fields.space_map import VariationMap
    >>> fade = BlendChain.through([6, 66], [1, 0])
    >>> shaft = hat_field("shaft", [("base", 0, 0), ("shaft", 5, 1), ("T", 18, 0)], fade)
    >>> vmap = VariationMap((FieldLayer("local", (shaft,)),))
    >>> post = loft(CurveData.single(np.array([[6.0, 0, 0], [6, 0, 18]])))
    >>> intersect_images(vmap, post, "z", 6.0).t.round(9).tolist()
    [5.0]
    """
    row = "xyz".index(choice(axis, "axis", "xyz", "in cut"))
    walk = _HeightAlong(vmap, batch, row, number(value, "value", "in cut"))
    begin, end = segment_start(batch), segment_start(batch) + 1
    low, high = _parts(batch.knot[begin], batch.knot[end], _SAMPLES)
    owner = np.repeat(segment_curve(batch), _SAMPLES)
    owner, low, high = _split_at_creases(walk, owner, low, high)
    owner, low, high = _split_at_turns(walk, owner, low, high)
    return _roots(walk, owner, low, high)


@attrs.frozen(eq=False)
class _HeightAlong:
    """The signed height g of images over a plane along curves, m; parameters t (n,), m."""

    vmap: VariationMap
    batch: SplineBatch
    row: int
    value: float

    def height(self, curve: IntArray, t: FloatArray) -> FloatArray:
        """Give g, (n,), m; its sign says on which side of the plane an image lies."""
        level: FloatArray = self.vmap(evaluate(self.batch, curve, t))[:, self.row] - self.value
        return level

    def rise(self, curve: IntArray, t: FloatArray) -> FloatArray:
        """Give g', the derivative of g by the parameter, (n,)."""
        slope = self.vmap.jacobian(evaluate(self.batch, curve, t))[:, self.row]
        found: FloatArray = (slope * derivative(self.batch, curve, t)).sum(axis=1)
        return found

    def creases(self, curve: IntArray, t: FloatArray) -> FloatArray:
        """Give the functions of all layers that change sign on their creases."""
        xyz, found = np.asarray(evaluate(self.batch, curve, t)), list[FloatArray]()
        for layer in self.vmap.layers:
            found.append(creases(layer, xyz))
            xyz = xyz + layer.displacement(xyz)
        return np.concatenate([np.zeros((len(t), 0)), *found], axis=1)


Intervals = tuple[IntArray, FloatArray, FloatArray]


def _parts(low: FloatArray, high: FloatArray, count: int) -> tuple[FloatArray, FloatArray]:
    """Divide intervals into equal ones; the outer ends keep their bits."""
    cuts = low[:, None] + (high - low)[:, None] * (np.arange(count + 1) / count)
    cuts[:, -1] = high
    return cuts[:, :-1].ravel(), cuts[:, 1:].ravel()


def _split(owner: IntArray, low: FloatArray, high: FloatArray, rows: IntArray,
           at: FloatArray) -> Intervals:  # fmt: skip
    """Divide intervals (rows) at places within them; one interval may have several places."""
    curve = np.concatenate([owner, owner[rows]])
    begin, end = np.concatenate([low, at]), np.concatenate([high, high[rows]])
    order = np.lexsort((begin, curve))
    curve, begin, end = curve[order], begin[order], end[order]
    same = curve[1:] == curve[:-1]
    end[:-1] = np.where(same, begin[1:], end[:-1])
    some = begin < end
    return curve[some], begin[some], end[some]


def _split_at_creases(
    walk: _HeightAlong, owner: IntArray, low: FloatArray, high: FloatArray
) -> Intervals:
    """Divide where a crease function changes sign, and intervals beside that more finely."""
    first, last = walk.creases(owner, low), walk.creases(owner, high)
    rows, column = np.nonzero((first >= 0.0) != (last >= 0.0))
    if not len(rows):
        return owner, low, high

    def give(some: IntArray, at: FloatArray) -> FloatArray:
        found = walk.creases(owner[rows[some]], at)
        return np.asarray(found[np.arange(len(some)), column[some]])

    at = false_position(give, low[rows], high[rows], first[rows, column], last[rows, column])
    owner, low, high = _split(owner, low, high, rows, at)
    near = np.flatnonzero(np.isin(low, at) | np.isin(high, at))
    begin, _ = _parts(low[near], high[near], _NARROW)
    inner = begin.reshape(-1, _NARROW)[:, 1:].ravel()
    return _split(owner, low, high, np.repeat(near, _NARROW - 1), inner)


def _split_at_turns(
    walk: _HeightAlong, owner: IntArray, low: FloatArray, high: FloatArray
) -> Intervals:
    """Divide where the height turns toward the plane and away again on one side of it."""
    above = walk.height(owner, low) >= 0.0
    near = _ASIDE * (high - low)
    begin, end = low + near, high - near
    first, last = walk.rise(owner, begin), walk.rise(owner, end)
    toward = np.where(above, (first < 0.0) & (last >= 0.0), (first >= 0.0) & (last < 0.0))
    rows = np.flatnonzero(toward & (above == (walk.height(owner, high) >= 0.0)))
    if not len(rows):
        return owner, low, high
    at = false_position(
        lambda some, t: walk.rise(owner[rows[some]], t),
        begin[rows], end[rows], first[rows], last[rows],
    )  # fmt: skip
    return _split(owner, low, high, rows, at)


def _roots(
    walk: _HeightAlong, owner: IntArray, low: FloatArray, high: FloatArray
) -> ImageIntersections:
    """Find one root in every interval at whose ends the height has other signs."""
    first, last = walk.height(owner, low), walk.height(owner, high)
    rows = np.flatnonzero((first >= 0.0) != (last >= 0.0))
    curve = owner[rows]
    t = false_position(
        lambda some, at: walk.height(curve[some], at),
        low[rows], high[rows], first[rows], last[rows],
    )  # fmt: skip
    xyz = walk.vmap(evaluate(walk.batch, curve, t)) if len(t) else np.zeros((0, 3))
    return ImageIntersections(curve, t, xyz, np.where(first[rows] >= 0.0, -1, 1).astype(np.int8))


@attrs.frozen(eq=False)
class _Whole:
    """A whole map as one layer, to solve for one coordinate of it."""

    vmap: VariationMap
    name: str = "whole map"

    def displacement(self, xyz: FloatArray) -> FloatArray:
        moved: FloatArray = self.vmap(xyz) - xyz
        return moved

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        return self.vmap.jacobian(xyz)

    def regions(self) -> tuple[FieldRegion, ...]:
        return self.vmap.regions()


def plane_source(vmap: VariationMap, axis: Axis, value: float, xyz: ArrayLike) -> FloatArray:
    """Give where on the parent a plane of the varied hull comes from.

    For ``z = c`` this is ``zeta(x; c)``: where no layer couples y and z, a cylinder over the
    profile plane, by which the curves of the parent can be cut instead.

    Parameters
    ----------
    vmap : VariationMap
    axis : {"x", "y", "z"}
        What is constant on the plane.
    value : float, m
        Its value, on the varied hull.
    xyz : (n, 3), m
        Places on the parent, of which the coordinate of `axis` does not count.

    Returns
    -------
    (n,), m
        That coordinate such that the place is mapped into the plane. Frozen.

    Raises
    ------
    BadInputError
        No axis, no places, or a map that folds there.

    Examples
    --------
    >>> from assoc_hull.variation.fields.bounded_functions import BlendChain
    >>> from assoc_hull.variation.fields.image_intersections import plane_source
    >>> from assoc_hull.variation.fields.layers import FieldLayer
    >>> from assoc_hull.variation.fields.anchor_fields import hat_field
    >>> from assoc_hull.variation.fields.space_map import VariationMap
    >>> fade = BlendChain.through([6, 66], [1, 0])
    >>> shaft = hat_field("shaft", [("base", 0, 0), ("shaft", 5, 1), ("T", 18, 0)], fade)
    >>> vmap = VariationMap((FieldLayer("local", (shaft,)),))
    >>> plane_source(vmap, "z", 6.0, [[6, 0, 0], [36, 0, 0], [99, 0, 0]]).round(9).tolist()
    [5.0, 5.504916393, 6.0]
    """
    row = "xyz".index(choice(axis, "axis", "xyz", "in plane_source"))
    image = places(xyz, "xyz", "in plane_source")
    image[:, row] = number(value, "value", "in plane_source")
    found = image.copy()
    solve_coordinates(_Whole(vmap), image, found, (row,))
    source: FloatArray = found[:, row].copy()
    freeze(source)
    return source
