"""The numbers of layers in two flat arrays, as compiled code reads them.

One array holds whole numbers (kinds, counts, and where things stand in both arrays), the other the
real ones (m, radians, factors). A layer, field or function of a kind that is not known here has no
flat form. A contour has none either: what scipy makes of it differs between processors in the last
bit.

Examples
--------
>>> from assoc_hull.variation.fields.flat_layers import FlatSheet
>>> FlatSheet.of(()).arrays()[0].tolist()
[0, 7, 0, 7, 0, 7, 0]
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import Self

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
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

__all__ = ["FlatSheet", "UnknownKindError", "flat_layers"]


class UnknownKindError(Exception):
    """A kind that has no flat form; it is never shown to anybody."""


@attrs.frozen(eq=False)
class FlatSheet:
    """Both arrays while they are written; each method tells where in `code` its thing stands."""

    code: list[int] = attrs.field(factory=lambda: [0] * 7)
    number: list[float] = attrs.field(factory=list)

    @classmethod
    def of(cls, layers: Sequence[Layer]) -> Self:
        """Lay out layers, in the order in which they act; raises `UnknownKindError`."""
        sheet = cls()
        sheet.table(0, [sheet.layer(each) for each in layers])
        for k in (1, 2):
            sheet.table(k, [])
        return sheet

    def table(self, k: int, places: Sequence[int]) -> None:
        """Tell where things of the k-th kind stand: layers, arcs, circles."""
        self.code[2 * k : 2 * k + 2] = len(places), len(self.code)
        self.code.extend(places)

    def arrays(self) -> tuple[IntArray, FloatArray]:
        """Give both arrays."""
        code, number = np.array(self.code, np.int64), np.array(self.number, np.float64)
        freeze(code, number)
        return code, number

    def put(self, code: Iterable[int], number: Iterable[float]) -> int:
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
                return self.put((0, 1, 0), v[:1])
            width = [b - a for a, b in pairwise(x)]
            rise = [b - a for a, b in pairwise(v)]
            return self.put((1, len(x), blend_kind(course.blend)), [*x, *v, *width, *rise])
        if type(course) is Polyline:
            x, v = course.x.tolist(), course.v.tolist()
            pairs = zip(pairwise(x), pairwise(v), strict=True)
            slopes = [(d - c) / (b - a) for (a, b), (c, d) in pairs]
            return self.put((2, len(x), 0), [*x, *v, *slopes])
        if type(course) is Polynomial:
            c = course.c.tolist()
            slope = [each * k for k, each in enumerate(c[1:], 1)] or [0.0]
            return self.put((3, len(c), len(slope)), [*c, *slope])
        if type(course) is Ramp:
            parts = course.begin, course.width, course.slope_, course.slope_ * course.width
            return self.put((4, 0, blend_kind(course.blend)), parts)
        if type(course) is Bump:
            factor, m, n = BUMP_SHAPES[course.shape]
            span = course.end - course.begin
            parts = course.begin, span, course.size, factor
            return self.put((5, m, n), (*parts, course.size * factor / span))
        raise UnknownKindError

    def layer(self, layer: Layer) -> int:
        """Put a layer: its kind first."""
        if type(layer) is FieldLayer:
            fields = [self._field(each) for each in layer.fields]
            return self.put((0, len(fields), *fields), ())
        if type(layer) is CornerLayer:
            functions = self.function(layer.course), self.function(layer.fade)
            cos, sin, tan = math.cos(layer.rise), math.sin(layer.rise), math.tan(layer.rise)
            sizes = layer.eta_ratio - 1.0, layer.zeta_ratio - 1.0
            return self.put((1, *functions), (layer.y, layer.z, cos, sin, tan, *sizes))
        if type(layer) is DeadriseLayer:
            functions = self.function(layer.course), self.function(layer.fade)
            code = 2, *functions, blend_kind(layer.blend)
            return self.put(code, (layer.q, layer.keel, layer.width))
        if type(layer) is AdditiveLayer:
            given = layer.x, *_three(layer.y), *_three(layer.z)
            return self.put((3, *(self.function(each) for each in given)), ())
        raise UnknownKindError

    def _field(self, field: StackedField | Rake) -> int:
        """Put a field: its kind, the coordinate that it moves, and so on."""
        if type(field) is Rake:
            numbers = field.q, field.z0, field.w, field.q * field.w
            return self.put((1, 0, self.function(field.course), blend_kind(field.blend)), numbers)
        if type(field) is not StackedField:
            raise UnknownKindError
        region, tube = field.region(), field.tube
        parts = [
            (self.function(b.height), self.function(p.a), self.function(p.d))
            for b, p in zip(field.boundaries, field.pieces, strict=True)
        ]
        code = [0, "xyz".index(field.axis), len(parts), blend_kind(field.blend)]
        code += [
            -1 if tube is None else blend_kind(tube.blend),
            *(f for part in parts for f in part),
        ]
        wide = (0.0, 0.0) if tube is None else (tube.radius, tube.n - 1.0)
        self.code[6] = max(self.code[6], len(parts))
        pivots = (each.pivot for each in field.pieces)
        return self.put(code, [*region.x, *region.z, *wide, wide[0] * wide[1], *pivots])


def blend_kind(blend: Blend) -> int:
    """Give 0 for a cubic blend, 1 for a quintic one."""
    return 0 if blend.name == "cubic" else 1


def _three(factors: Factors | None) -> tuple[BoundedFunction | None, ...]:
    return (None, None, None) if factors is None else factors


def flat_layers(layers: Sequence[Layer]) -> tuple[IntArray, FloatArray] | None:
    """Lay out layers; None where one is of no known kind."""
    try:
        return FlatSheet.of(layers).arrays()
    except UnknownKindError:
        return None
