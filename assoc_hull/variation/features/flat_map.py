"""The numbers of a map in two flat arrays: layers, functions, bilge arcs and circles.

`compiled_map` reads them. One array holds whole numbers (kinds, counts, and where things stand in
both arrays), the other the real ones (m, radians, factors). A layer, field or function of a kind
that is not known here has no flat form; such a map stays with numpy. A contour has none either:
what scipy makes of it differs between processors in the last bit.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import pairwise

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.variation.features.redrawn_bilges import CURVE, BilgeArc, BilgeFillet
from assoc_hull.variation.features.redrawn_circles import JOIN, RedrawnCircle
from assoc_hull.variation.fields.bounded_functions import (
    Blend,
    BlendChain,
    BoundedFunction,
    Polynomial,
    Ramp,
)
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
from assoc_hull.variation.fields.shift_shapes import BUMP_SHAPES, Bump, Polyline

__all__ = ["FlatMap"]


class _UnknownKindError(Exception):
    """A kind that has no flat form; it never leaves this module."""


@attrs.frozen(eq=False)
class FlatMap:
    """A map in flat arrays.

    Attributes
    ----------
    code : (k,) int
        First the numbers of layers, of arcs and of circles, each followed by where the table
        begins that tells where they stand; then the largest number of boundaries of a field.
    number : (m,)
        Lengths (m), angles (radians) and factors.
    arcs, circles : bool
        Whether there are any.

    Examples
    --------
    >>> from assoc_hull.variation.features.flat_map import FlatMap
    >>> FlatMap.of(()).code.tolist()
    [0, 7, 0, 7, 0, 7, 0]
    """

    code: IntArray
    number: FloatArray
    arcs: bool = False
    circles: bool = False

    @classmethod
    def of(
        cls,
        layers: Sequence[Layer],
        arcs: Sequence[tuple[BilgeArc, BlendChain]] = (),
        circles: Sequence[RedrawnCircle] = (),
    ) -> FlatMap | None:
        """Lay out a map; None where something is of no known kind.

        Parameters
        ----------
        layers : sequence of Layer
            In the order in which they act.
        arcs : sequence of (BilgeArc, BlendChain)
            Bilges that are drawn again after them, and how much each counts along the ship.
        circles : sequence of RedrawnCircle
            Circles that are drawn again after that.
        """
        sheet = _Sheet([0] * 7, [])
        try:
            places = (
                [sheet.layer(each) for each in layers],
                [sheet.arc(arc, share) for arc, share in arcs],
                [sheet.circle(each) for each in circles],
            )
        except _UnknownKindError:
            return None
        for k, table in enumerate(places):
            sheet.code[2 * k : 2 * k + 2] = len(table), len(sheet.code)
            sheet.code.extend(table)
        code = np.array(sheet.code, np.int64)
        number = np.array(sheet.number, np.float64)
        freeze(code, number)
        return cls(code, number, len(arcs) > 0, len(circles) > 0)


@attrs.frozen(eq=False)
class _Sheet:
    """Both arrays while they are written; each method tells where in `code` its thing stands."""

    code: list[int]
    number: list[float]

    def _put(self, code: Iterable[int], number: Iterable[float]) -> int:
        """Put a thing behind all others; its numbers are found by the last entry of its code."""
        place = len(self.code)
        self.code.extend(code)
        self.code.append(len(self.number))
        self.number.extend(number)
        return place

    def function(self, course: BoundedFunction | None) -> int:
        """Put a function: its kind, a count, a choice, and where its numbers are; -1 for none."""
        if course is None:
            return -1
        if type(course) is BlendChain:
            x, v = course.x.tolist(), course.v.tolist()
            if v.count(v[0]) == len(v):
                return self._put((0, 1, 0), v[:1])
            width = [b - a for a, b in pairwise(x)]
            rise = [b - a for a, b in pairwise(v)]
            return self._put((1, len(x), _blend(course.blend)), [*x, *v, *width, *rise])
        if type(course) is Polyline:
            x, v = course.x.tolist(), course.v.tolist()
            pairs = zip(pairwise(x), pairwise(v), strict=True)
            slopes = [(d - c) / (b - a) for (a, b), (c, d) in pairs]
            return self._put((2, len(x), 0), [*x, *v, *slopes])
        if type(course) is Polynomial:
            c = course.c.tolist()
            slope = [each * k for k, each in enumerate(c[1:], 1)] or [0.0]
            return self._put((3, len(c), len(slope)), [*c, *slope])
        if type(course) is Ramp:
            parts = course.begin, course.width, course.slope_, course.slope_ * course.width
            return self._put((4, 0, _blend(course.blend)), parts)
        if type(course) is Bump:
            factor, m, n = BUMP_SHAPES[course.shape]
            span = course.end - course.begin
            parts = course.begin, span, course.size, factor
            return self._put((5, m, n), (*parts, course.size * factor / span))
        raise _UnknownKindError

    def layer(self, layer: Layer) -> int:
        """Put a layer: its kind first."""
        if type(layer) is FieldLayer:
            fields = [self._field(each) for each in layer.fields]
            return self._put((0, len(fields), *fields), ())
        if type(layer) is CornerLayer:
            functions = self.function(layer.course), self.function(layer.fade)
            cos, sin, tan = math.cos(layer.rise), math.sin(layer.rise), math.tan(layer.rise)
            sizes = layer.eta_ratio - 1.0, layer.zeta_ratio - 1.0
            return self._put((1, *functions), (layer.y, layer.z, cos, sin, tan, *sizes))
        if type(layer) is DeadriseLayer:
            functions = self.function(layer.course), self.function(layer.fade)
            code = 2, *functions, _blend(layer.blend)
            return self._put(code, (layer.q, layer.keel, layer.width))
        if type(layer) is AdditiveLayer:
            given = layer.x, *_three(layer.y), *_three(layer.z)
            return self._put((3, *(self.function(each) for each in given)), ())
        raise _UnknownKindError

    def _field(self, field: StackedField | Rake) -> int:
        """Put a field: its kind, the coordinate that it moves, and so on."""
        if type(field) is Rake:
            numbers = field.q, field.z0, field.w, field.q * field.w
            return self._put((1, 0, self.function(field.course), _blend(field.blend)), numbers)
        if type(field) is not StackedField:
            raise _UnknownKindError
        region, tube = field.region(), field.tube
        parts = [
            (self.function(b.height), self.function(p.a), self.function(p.d))
            for b, p in zip(field.boundaries, field.pieces, strict=True)
        ]
        code = [0, "xyz".index(field.axis), len(parts), _blend(field.blend)]
        code += [-1 if tube is None else _blend(tube.blend), *(f for part in parts for f in part)]
        wide = (0.0, 0.0) if tube is None else (tube.radius, tube.n - 1.0)
        self.code[6] = max(self.code[6], len(parts))
        pivots = (each.pivot for each in field.pieces)
        return self._put(code, [*region.x, *region.z, *wide, wide[0] * wide[1], *pivots])

    def arc(self, arc: BilgeArc, share: BlendChain) -> int:
        """Put a bilge arc: its share, and the numbers of both circles."""
        old, new = arc.before, arc.after
        down = (old.floor - [old.y, old.z]) / old.radius
        below, beside = down.tolist()
        return self._put(
            (self.function(share),),
            (arc.x, *_fillet(old), *_fillet(new), *arc.reach, below, beside, CURVE * old.radius),
        )

    def circle(self, circle: RedrawnCircle) -> int:
        """Put a circle: whether the map itself makes it, and its numbers before and after."""
        old, new = circle.before, circle.after
        numbers = (
            *old.centre.tolist(), *old.normal.tolist(), old.radius, *new.centre.tolist(),
            new.radius, circle.gap, JOIN * old.radius,
        )  # fmt: skip
        return self._put((int(circle.carried),), numbers)


def _blend(blend: Blend) -> int:
    """Give 0 for a cubic blend, 1 for a quintic one."""
    return 0 if blend.name == "cubic" else 1


def _three(factors: Factors | None) -> tuple[BoundedFunction | None, ...]:
    return (None, None, None) if factors is None else factors


def _fillet(arc: BilgeFillet) -> tuple[float, ...]:
    """Give centre, radius, angle at the floor, its product with the radius, and both ends."""
    first = arc.first
    ends = *arc.floor.tolist(), *arc.side.tolist()
    return (arc.y, arc.z, arc.radius, first, first * arc.radius, *ends)
