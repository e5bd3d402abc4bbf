"""What encloses a field's displacement and derivatives on boxes of the profile plane.

Chains, contours and bumps give exact bounds on intervals, blends too. In every strip that a box
reaches into, the place between the boundaries is enclosed, and from it all else; the box has the
union of its strips.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.intervals import (
    Interval,
    interval_difference,
    interval_product,
    interval_sum,
    interval_union,
)
from assoc_hull.variation.fields.bounded_functions import BlendChain, BoundedFunction
from assoc_hull.variation.fields.field import AffinePiece, StackedField
from assoc_hull.variation.fields.layers import Rake

__all__ = ["FieldEnclosure", "enclose_field"]

_Indices = np.typing.NDArray[np.int64]
_Sum = tuple[BoundedFunction, ...]

_SLACK = 1e-13
"""For rounding of the place between two boundaries, as a part of their gap."""


@attrs.frozen(eq=False)
class FieldEnclosure:
    """Of a field on m boxes.

    Attributes
    ----------
    u : Interval of (m,), m
        Displacement; nil for a y-field, whose displacement is `own` times psi.
    own : Interval of (m,)
        Derivative of u by the field's own coordinate alone, that is with strip and courses held;
        of a y-field by psi.
    along, up : Interval of (m,)
        Whole derivatives by x and z; nil for a y-field.
    """

    u: Interval
    own: Interval
    along: Interval
    up: Interval


def enclose_field(
    field: StackedField | Rake, lower: FloatArray, upper: FloatArray
) -> FieldEnclosure:
    """Enclose a field on boxes.

    Parameters
    ----------
    field : StackedField or Rake
    lower, upper : (m, 2), m
        x and z of the boxes.
    """
    if isinstance(field, Rake):
        return _rake(field, lower, upper)
    count = len(lower)
    ends = [each.height.bounds(lower[:, 0], upper[:, 0]) for each in field.boundaries]
    parts = [(np.full(count, np.inf), np.full(count, -np.inf)) for _ in range(4)]
    for k in range(-1, len(ends)):
        inside = np.ones(count, np.bool_)
        if k >= 0:
            inside &= upper[:, 1] >= ends[k][0]
        if k + 1 < len(ends):
            inside &= lower[:, 1] <= ends[k + 1][1]
        some = np.flatnonzero(inside)
        if len(some):
            found = _in_strip(field, k, ends, lower[some], upper[some], some)
            for part, one in zip(parts, found, strict=True):
                part[0][some], part[1][some] = interval_union((part[0][some], part[1][some]), one)
    return FieldEnclosure(*parts)


def _in_strip(
    field: StackedField, k: int, ends: Sequence[Interval], lower: FloatArray, upper: FloatArray,
    some: _Indices,
) -> tuple[Interval, Interval, Interval, Interval]:  # fmt: skip
    """Enclose u, own, along and up where boxes reach into strip k; -1 is below the stack."""
    x = lower[:, 0], upper[:, 0]
    z = lower[:, 1].copy(), upper[:, 1].copy()
    if k >= 0:
        z = np.maximum(z[0], ends[k][0][some]), z[1]
    if k + 1 < len(ends):
        z = z[0], np.minimum(z[1], ends[k + 1][1][some])
    c = x if field.axis == "x" else z
    first, last = max(k, 0), min(k + 1, len(ends) - 1)
    pivot = field.pieces[first].pivot
    e, e_x, a = _piece(field.pieces[first], pivot, x, c, field.axis)
    if first == last or k < 0:
        nil = np.zeros(len(some)), np.zeros(len(some))
        return _whole(field, (e, a, e_x, nil))
    s = _within(z, *((ends[each][0][some], ends[each][1][some]) for each in (k, last)))
    b, rise = field.blend.value_range(*s), field.blend.slope_range(*s)
    f, f_x, a_above = _piece(field.pieces[last], pivot, x, c, field.axis)
    turn = interval_product(rise, _step(field.pieces[k], field.pieces[last], x, c))
    gap = _gap(field, k, x)
    with np.errstate(divide="ignore", invalid="ignore"):
        known = gap[0] > 0.0
        inverse = np.where(known, 1.0 / gap[1], -np.inf), np.where(known, 1.0 / gap[0], np.inf)
        up = _known(interval_product(turn, inverse), known)
        leans = [field.boundaries[each].height.slope_bounds(*x) for each in (k, last)]
        lean = _mix(leans[0], leans[1], s)
        along = interval_difference(_mix(e_x, f_x, b), _known(interval_product(up, lean), known))
    return _whole(field, (_mix(e, f, b), _mix(a, a_above, b), along, up))


def _whole(
    field: StackedField, parts: tuple[Interval, Interval, Interval, Interval]
) -> tuple[Interval, Interval, Interval, Interval]:
    """Add what comes of the field's own coordinate to the derivatives by x and z."""
    u, own, along, up = parts
    if field.axis == "x":
        along = interval_sum(along, own)
    if field.axis == "z":
        up = interval_sum(up, own)
    return u, own, along, up


def _known(one: Interval, known: np.typing.NDArray[np.bool_]) -> Interval:
    return np.where(known, one[0], -np.inf), np.where(known, one[1], np.inf)


def _within(z: Interval, foot: Interval, crown: Interval) -> Interval:
    """Enclose s: it grows with z, and falls with the height of either boundary."""
    least, most = _place(z[0], foot[1], crown[1], 0.0), _place(z[1], foot[0], crown[0], 1.0)
    return np.maximum(least - _SLACK, 0.0), np.minimum(most + _SLACK, 1.0)


def _place(z: FloatArray, foot: FloatArray, crown: FloatArray, unknown: float) -> FloatArray:
    gap = crown - foot
    s = np.clip((z - foot) / np.where(gap > 0.0, gap, 1.0), 0.0, 1.0)
    return np.where(gap > 0.0, s, unknown)


def _mix(one: Interval, other: Interval, b: Interval) -> Interval:
    """Enclose one (1 - b) + other b: linear in each, so ends of b are enough."""
    low = np.minimum(*(one[0] + (other[0] - one[0]) * end for end in b))
    high = np.maximum(*(one[1] + (other[1] - one[1]) * end for end in b))
    return interval_sum((low, high), (np.zeros_like(low), np.zeros_like(low)))


def _piece(
    piece: AffinePiece, pivot: float, x: Interval, c: Interval, axis: str
) -> tuple[Interval, Interval, Interval]:
    """Enclose e, its derivative by x with c held, and a; about a pivot shared by two pieces."""
    shift = _sum([(piece.d, 1.0), (piece.a, pivot - piece.pivot)])
    lever = c[0] - pivot, c[1] - pivot
    a = piece.a.bounds(*x)
    e = interval_sum(interval_product(a, lever), _bounds(shift, x))
    along = interval_sum(interval_product(piece.a.slope_bounds(*x), lever), _slopes(shift, x))
    return e, along, a


def _step(one: AffinePiece, other: AffinePiece, x: Interval, c: Interval) -> Interval:
    """Enclose the difference of two pieces, with what they share taken together."""
    rise = _sum([(other.a, 1.0), (one.a, -1.0)])
    shift = _sum([(other.d, 1.0), (one.d, -1.0), (other.a, one.pivot - other.pivot)])
    lever = c[0] - one.pivot, c[1] - one.pivot
    return interval_sum(interval_product(_bounds(rise, x), lever), _bounds(shift, x))


def _gap(field: StackedField, k: int, x: Interval) -> Interval:
    low, high = (field.boundaries[each].height for each in (k, k + 1))
    return _bounds(_sum([(high, 1.0), (low, -1.0)]), x)


def _sum(terms: Sequence[tuple[BoundedFunction, float]]) -> _Sum:
    """Add functions: chains of the same nodes and blend become one, whose bounds are exact."""
    found, constant = dict[tuple[object, ...], BoundedFunction](), 0.0
    rest = list[BoundedFunction]()
    for course, factor in terms:
        if factor == 0.0:
            continue
        if not isinstance(course, BlendChain):
            rest.append(course.scaled(factor))
        elif course.level:
            constant += factor * float(course.v[0])
        else:
            key = (course.blend.name, course.x.tobytes())
            part = course.scaled(factor)
            last = found.get(key)
            if isinstance(last, BlendChain):
                part = BlendChain(part.x, part.v + last.v, part.blend)
            found[key] = part
    return *found.values(), *rest, BlendChain.constant(constant)


def _bounds(terms: _Sum, x: Interval) -> Interval:
    total = terms[0].bounds(*x)
    for course in terms[1:]:
        total = interval_sum(total, course.bounds(*x))
    return total


def _slopes(terms: _Sum, x: Interval) -> Interval:
    total = terms[0].slope_bounds(*x)
    for course in terms[1:]:
        total = interval_sum(total, course.slope_bounds(*x))
    return total


def _rake(field: Rake, lower: FloatArray, upper: FloatArray) -> FieldEnclosure:
    x = lower[:, 0], upper[:, 0]
    t = (lower[:, 1] - field.z0) / field.w, (upper[:, 1] - field.z0) / field.w
    ramp = field.blend.ramp(t[0]), field.blend.ramp(t[1])
    size = field.q * field.w
    fade, slope = field.course.scaled(size).bounds(*x), field.course.scaled(size).slope_bounds(*x)
    turn = field.course.scaled(field.q).bounds(*x)
    nil = np.zeros(len(lower)), np.zeros(len(lower))
    up = interval_product(turn, field.blend.value_range(*t))
    return FieldEnclosure(interval_product(fade, ramp), nil, interval_product(slope, ramp), up)
