"""Integrals under form-parameter curves, and the middle vertex that they ask for.

Area and moment are sums of products of the vertices and of integrals of their basis functions N_i
on [0, 4]. Since N_3 vanishes at both ends of a curve, the area is affine in the middle vertex and
the moment has two quadratic terms only (`MiddleTerms`). `area_table` and `moment_table` have the
integrals of basis functions as fractions: tests compare with them.

The middle vertex of a form-parameter curve: by area and centroid, by area, or fairest.

The area is affine in the middle vertex P3, so all vertices with an area lie on a line p + s D; on
it the moment is quadratic in s, because N_3 vanishes at both ends of the curve. Of two roots the
one nearer to (P2 + P4)/2 is taken; the other is normally 10 to 10,000 chords away, and loses
digits. `required_middle` gives the vertex or raises with the reason why there is none; the other
functions give nan there. Ends (n, 6, 2) are P0, P1, P2, P4, P5, P6. All is elementwise.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import DegenerateEndsError, NoMiddleVertexError
from assoc_hull.geometry.curves import FloatArray

__all__ = [
    "VERTICES",
    "FormIntegrals",
    "MiddleTerms",
    "area_table",
    "area_vertex",
    "centroid_extreme",
    "centroid_limit",
    "fair_vertex",
    "form_basis",
    "form_integrals",
    "middle_terms",
    "middle_vertex",
    "moment_table",
    "only_area",
    "power_form",
    "required_middle",
    "slide_vertex",
    "with_middle",
]

# --------------------------------------------------------------------------------------
# Integrals of products of basis functions, as fractions: they give the numbers of `MiddleTerms`.
#
#     A  = sum y_i x_j a_ij          a_ij  = int N_i N_j' dt        denominators divide 720
#     My = sum y_i x_j x_k b_ijk     b_ijk = int N_i N_j N_k' dt    denominators divide 181440

VERTICES = 7
_SEGMENTS = 4
_PARTS = ((1, -3, 3, -1), (4, 0, -6, 3), (1, 3, 3, -3), (0, 0, 0, 1))
"""Six times the basis functions of a segment, in ascending powers of u."""

Power = tuple[Fraction, ...]
"""A polynomial in ascending powers."""


def form_basis(vertex: int, segment: int) -> Power:
    """Give the basis function of a vertex on a segment, in ascending powers of u = t - segment."""
    part = vertex - segment
    inside = 0 <= part < len(_PARTS)
    return tuple(Fraction(each, 6) for each in _PARTS[part]) if inside else (Fraction(0),)


def _times(one: Power, other: Power) -> Power:
    found = [Fraction(0)] * (len(one) + len(other) - 1)
    for i, left in enumerate(one):
        for j, right in enumerate(other):
            found[i + j] += left * right
    return tuple(found)


def _slope(power: Power) -> Power:
    return tuple(n * each for n, each in enumerate(power))[1:] or (Fraction(0),)


def _integral(power: Power) -> Fraction:
    """Integrate from 0 to 1."""
    return sum((each / (n + 1) for n, each in enumerate(power)), Fraction(0))


@lru_cache(maxsize=1)
def area_table() -> tuple[tuple[Fraction, ...], ...]:
    """Give a_ij = int N_i N_j' dt, 7 rows of 7."""
    return tuple(
        tuple(
            sum(
                (
                    _integral(_times(form_basis(i, s), _slope(form_basis(j, s))))
                    for s in range(_SEGMENTS)
                    if 0 <= i - s < 4 and 0 <= j - s < 4
                ),
                Fraction(0),
            )
            for j in range(VERTICES)
        )
        for i in range(VERTICES)
    )


@lru_cache(maxsize=1)
def moment_table() -> tuple[tuple[tuple[Fraction, ...], ...], ...]:
    """Give b_ijk = int N_i N_j N_k' dt, 7 tables of 7 rows of 7."""
    found = [[[Fraction(0)] * VERTICES for _ in range(VERTICES)] for _ in range(VERTICES)]
    for s in range(_SEGMENTS):
        for i in range(s, s + 4):
            for j in range(s, s + 4):
                both = _times(form_basis(i, s), form_basis(j, s))
                for k in range(s, s + 4):
                    found[i][j][k] += _integral(_times(both, _slope(form_basis(k, s))))
    return tuple(tuple(tuple(row) for row in table) for table in found)


# --------------------------------------------------------------------------------------
# Integrals of curves, segment by segment, with the middle vertex (x3, y3) set apart:
#
#     A  = A0 + D_x y3 - D_y x3
#     My = M0 + m1 x3 + m2 y3 + x3 (C_x y3 - C_y x3) / 2
#
# In this form they keep their digits where the middle vertex lies far away.


def power_form(vertices: FloatArray) -> FloatArray:
    """Give the segments in powers of u = t - s: (n, 7, 2) to (n, 4 segments, 4 powers, 2).

    In the matrix of the paper (Kim & Kang 1992) the number for the second power of the second
    vertex is -6: with +6, as a scan of it reads, the basis functions would not add up to 1.
    """
    a, b, c, d = (vertices[:, part : part + 4] for part in range(4))
    found = np.empty((len(vertices), 4, 4, 2))
    found[:, :, 0] = (a + 4.0 * b + c) / 6.0
    found[:, :, 1] = (c - a) / 2.0
    found[:, :, 2] = (a - 2.0 * b + c) / 2.0
    found[:, :, 3] = (d - a + 3.0 * (b - c)) / 6.0
    return found


_MIDDLE = power_form(np.repeat(np.eye(7)[3, :, None], 2, axis=1)[None])[..., 0]
"""N_3 in powers, (1, 4 segments, 4 powers)."""

_BLOCK = 256
"""So many curves at once: what lies between their powers and their sums stays near at hand."""


def _shares(powers: int) -> FloatArray:
    """Give what y^p and the slope of z^m contribute, m / (p + m) for m from 1: (4, powers)."""
    p, m = np.arange(4.0)[:, None], np.arange(1.0, powers + 1.0)
    return np.asarray(m / (p + m))


_AREA, _MOMENT = _shares(3), _shares(6)


def _under(y: FloatArray, z: FloatArray, shares: FloatArray) -> FloatArray:
    """Give int y z' dt along curves, (n,); both in powers, (n, 4, .)."""
    parts = y[:, :, :, None] * (z[:, :, None, 1:] * shares)
    sums = parts.reshape(len(parts), 4, shares.size).sum(axis=2)
    return np.asarray(((sums[:, 0] + sums[:, 1]) + sums[:, 2]) + sums[:, 3])


def _product(one: FloatArray, other: FloatArray) -> FloatArray:
    """Multiply cubics in powers: (n, 4, 7)."""
    found = np.zeros((len(one), 4, 7))
    for power in range(4):
        found[:, :, power : power + 4] += one[:, :, power, None] * other
    return found


@attrs.frozen(eq=False)
class MiddleTerms:
    """How area and moment of curves depend on their middle vertices.

    Attributes
    ----------
    area : (n,)
        A0, the area with the middle vertex in the origin.
    lever : (n, 2)
        D.
    moment : (n,)
        M0.
    slope : (n, 2)
        m1 and m2.
    twist : (n, 2)
        C.
    """

    area: FloatArray
    lever: FloatArray
    moment: FloatArray
    slope: FloatArray
    twist: FloatArray

    def area_at(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Give the areas with middle vertices, (n,) each."""
        return np.asarray(self.area + (self.lever[:, 0] * y - self.lever[:, 1] * x))

    def moment_at(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Give the moments with middle vertices, (n,) each."""
        square = 0.5 * x * (self.twist[:, 0] * y - self.twist[:, 1] * x)
        return np.asarray(self.moment + (self.slope[:, 0] * x + self.slope[:, 1] * y) + square)


def middle_terms(ends: FloatArray) -> MiddleTerms:
    """Give how area and moment depend on the middle vertices; ends (n, 6, 2) without P3."""
    if len(ends) <= _BLOCK:
        return _terms(ends)
    parts = [_terms(ends[row : row + _BLOCK]) for row in range(0, len(ends), _BLOCK)]
    names = [field.name for field in attrs.fields(MiddleTerms)]
    return MiddleTerms(*(np.concatenate([getattr(p, name) for p in parts]) for name in names))


def _terms(ends: FloatArray) -> MiddleTerms:
    vertices = np.zeros((len(ends), 7, 2))
    vertices[:, :3], vertices[:, 4:] = ends[:, :3], ends[:, 3:]
    power = power_form(vertices)
    x, y = power[..., 0], power[..., 1]
    four, five, six = ends[:, 3] - ends[:, 2], ends[:, 4] - ends[:, 1], ends[:, 5] - ends[:, 0]
    half_square, by_middle = 0.5 * _product(x, x), _product(x, _MIDDLE + 0.0 * x)
    return MiddleTerms(
        _under(y, x, _AREA),
        49.0 / 144.0 * four + 7.0 / 90.0 * five + six / 720.0,
        _under(y, half_square, _MOMENT),
        np.stack([_under(y, by_middle, _MOMENT), _under(_MIDDLE, half_square, _MOMENT)], axis=1),
        5947.0 / 30240.0 * four + 3.0 / 140.0 * five + six / 18144.0,
    )


@attrs.frozen(eq=False)
class FormIntegrals:
    """Integrals under curves.

    Attributes
    ----------
    area : (n,)
        int y dx.
    moment : (n,)
        int x y dx.
    moment_y : (n,)
        1/2 int y^2 dx.
    """

    area: FloatArray
    moment: FloatArray
    moment_y: FloatArray


def form_integrals(vertices: FloatArray) -> FormIntegrals:
    """Integrate under curves (n, 7, 2), exactly: each segment is a cubic."""
    ends, x, y = vertices[:, [0, 1, 2, 4, 5, 6]], vertices[:, 3, 0], vertices[:, 3, 1]
    terms, turned = middle_terms(ends), middle_terms(ends[:, :, ::-1])
    # By parts: half the integral of y^2 dx is half of y^2 x at the ends less that of x y dy.
    first, last = (vertices[:, k] + 4.0 * vertices[:, k + 1] + vertices[:, k + 2] for k in (0, 4))
    at_ends = (last[:, 1] * last[:, 1] * last[:, 0] - first[:, 1] * first[:, 1] * first[:, 0]) / 432
    return FormIntegrals(
        terms.area_at(x, y), terms.moment_at(x, y), at_ends - turned.moment_at(y, x)
    )


_LINEAR = 1e-13
"""Below this part of the linear coefficient the quadratic one is rounding."""

_ROUNDING = 2e-15
"""Of the moment, and of the discriminant: less is rounding."""

_STEP = 1e-6
"""Of the size of a vertex: no digits that were lost move it farther."""

_STILL = 1e-14
"""Of the size of a curve: a lever below this is rounding."""


def with_middle(ends: FloatArray, x: ArrayLike, y: ArrayLike) -> FloatArray:
    """Put middle vertices (x, y) between those of the ends, (n, 6, 2): gives (n, 7, 2)."""
    found = np.empty((len(ends), 7, 2))
    found[:, :3], found[:, 4:] = ends[:, :3], ends[:, 3:]
    found[:, 3, 0], found[:, 3, 1] = x, y
    return found


def _square(ends: FloatArray, terms: MiddleTerms) -> FloatArray:
    """Give the square of the lever; nan where it is zero, and the area fixed."""
    dx, dy = terms.lever.T
    still = np.maximum(np.abs(dx), np.abs(dy)) <= _STILL * np.abs(ends).max(axis=(1, 2))
    return np.where(still, np.nan, dx * dx + dy * dy)


@attrs.frozen(eq=False)
class _Line:
    """The middle vertices p + s D of an area, and the moment m0 + c1 s + c2 s^2 on it."""

    terms: MiddleTerms
    p: FloatArray
    m0: FloatArray
    c1: FloatArray
    c2: FloatArray

    @property
    def linear(self) -> np.typing.NDArray[np.bool_]:
        """Whether the moment is, but for rounding, linear."""
        return np.asarray(np.abs(self.c2) <= _LINEAR * np.abs(self.c1))


def _line(ends: FloatArray, area: FloatArray) -> _Line:
    """Find the middle vertices of an area; nan where the area does not depend on them."""
    terms = middle_terms(ends)
    (dx, dy), (cx, cy) = terms.lever.T, terms.twist.T
    m1, m2 = terms.slope.T
    with np.errstate(divide="ignore", invalid="ignore"):
        share = (area - terms.area) / _square(ends, terms)
        px, py = -dy * share, dx * share
        c2 = 0.5 * dx * (cx * dy - cy * dx)
        c1 = m1 * dx + m2 * dy + 0.5 * (cx * (px * dy + dx * py) - 2.0 * cy * px * dx)
        m0 = terms.moment_at(px, py)
    return _Line(terms, np.stack([px, py], axis=1), m0, c1, c2)


def middle_vertex(
    ends: FloatArray, area: FloatArray, centroid: FloatArray, *, other: bool = False
) -> tuple[FloatArray, FloatArray]:
    """Give the middle vertices by which curves have an area and a centroid.

    The area is int y dx, the centroid int x y dx / area. The vertices (n, 2) are nan where there is
    none. The discriminants (n,) are negative where no curve has both, nan where the area does not
    depend on the vertex. `other` gives the other root, for diagnosis.
    """
    line = _line(ends, area)
    with np.errstate(divide="ignore", invalid="ignore"):
        want = 0.5 * (ends[:, 2] + ends[:, 3]) - line.p
        near, far, disc = _roots(line, area * centroid, want)
    s = far if other else near
    vertex = line.p + s[:, None] * line.terms.lever
    return _polished(line.terms, vertex, area, area * centroid), disc


def _polished(
    terms: MiddleTerms, vertex: FloatArray, area: FloatArray, moment: FloatArray
) -> FloatArray:
    """Give back the digits that a root loses: a step of Newton's rule in the plane."""
    x, y = vertex.T
    lack, want = area - terms.area_at(x, y), moment - terms.moment_at(x, y)
    gx, gy = -terms.lever[:, 1], terms.lever[:, 0]
    hx = terms.slope[:, 0] + 0.5 * terms.twist[:, 0] * y - terms.twist[:, 1] * x
    hy = terms.slope[:, 1] + 0.5 * terms.twist[:, 0] * x
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        spread = gx * hy - gy * hx
        step = np.stack([lack * hy - want * gy, want * gx - lack * hx], axis=1) / spread[:, None]
        small = np.abs(step).max(axis=1) <= _STEP * np.abs(vertex).max(axis=1)
    return np.asarray(np.where(small[:, None], vertex + step, vertex))


def _roots(
    line: _Line, moment: FloatArray, want: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Solve for s, the root nearer to a wanted vertex first; and the discriminant."""
    c2, c1, c0, d = line.c2, line.c1, line.m0 - moment, line.terms.lever
    best = (want[:, 0] * d[:, 0] + want[:, 1] * d[:, 1]) / (d[:, 0] * d[:, 0] + d[:, 1] * d[:, 1])
    rounding = _ROUNDING * (np.abs(line.m0) + np.abs(moment))
    disc = np.where(line.linear, c1 * c1, c1 * c1 - 4.0 * c2 * c0)
    # A double root, and a straight curve: its moment is the same all along the line.
    touching = np.abs(disc) <= _ROUNDING * c1 * c1 + 4.0 * np.abs(c2) * rounding
    disc = np.where(touching, 0.0, disc)
    exact = np.abs(c0 + best * (c1 + best * c2)) <= rounding
    q = -0.5 * (c1 + np.copysign(np.sqrt(disc), c1))
    two = np.where(line.linear, np.nan, q / c2)
    one = np.where(line.linear, -c0 / c1, np.where(q == 0.0, two, c0 / q))
    swap = np.abs(two - best) < np.abs(one - best)
    near = np.where(exact, best, np.where(swap, two, one))
    return near, np.where(swap, one, two), np.where(exact, np.maximum(disc, 0.0), disc)


def centroid_limit(ends: FloatArray, area: FloatArray) -> FloatArray:
    """Give the extreme centroids that curves of an area can have, (n,).

    Where the discriminant of `middle_vertex` is negative, this is the nearest one that can be
    reached; nan where there is no limit.
    """
    line = _line(ends, area)
    with np.errstate(divide="ignore", invalid="ignore"):
        extreme = line.m0 - line.c1 * line.c1 / (4.0 * line.c2)
        return np.where(line.linear, np.nan, extreme / area)


def centroid_extreme(ends: FloatArray, area: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give the abscissae of two middle vertices of an area, (n,) each.

    The first is that of the vertex with the extreme centroid, nan where there is none; the second
    that of the vertex nearest to (P2 + P4)/2, on the side of which the roots of `middle_vertex`
    lie.
    """
    line = _line(ends, area)
    dx, dy = line.terms.lever.T
    with np.errstate(divide="ignore", invalid="ignore"):
        want = 0.5 * (ends[:, 2] + ends[:, 3]) - line.p
        best = (want[:, 0] * dx + want[:, 1] * dy) / (dx * dx + dy * dy)
        extreme = np.where(line.linear, np.nan, -0.5 * line.c1 / line.c2)
    return line.p[:, 0] + extreme * dx, line.p[:, 0] + best * dx


def only_area(ends: FloatArray) -> FloatArray:
    """Give the areas under curves whose area does not depend on the middle vertex, else nan."""
    terms = middle_terms(ends)
    return np.where(np.isnan(_square(ends, terms)), terms.area, np.nan)


def fair_vertex(ends: FloatArray, order: int = 3) -> FloatArray:
    """Give the middle vertices (n, 2) of least int |Q''|^2 dt (order 2) or int |Q'''|^2 dt (3)."""
    p0, p1, p2, p4, p5, p6 = (ends[:, each] for each in range(6))
    if order == 2:
        return np.asarray((9.0 * (p2 + p4) - (p0 + p6)) / 16.0)
    return np.asarray((p0 + p6 - 6.0 * (p1 + p5) + 15.0 * (p2 + p4)) / 20.0)


def area_vertex(ends: FloatArray, area: FloatArray) -> FloatArray:
    """Give the middle vertices of least int |Q'''|^2 dt with an area, (n, 2)."""
    return slide_vertex(ends, fair_vertex(ends), area)


def slide_vertex(ends: FloatArray, middle: FloatArray, area: FloatArray) -> FloatArray:
    """Give the middle vertices nearest to given ones by which curves have an area, (n, 2).

    The integrals of |Q''|^2 and |Q'''|^2 rise alike in all directions from their least, so the
    fairest vertex of an area is the nearest one to the fairest of all.
    """
    terms = middle_terms(ends)
    g = np.stack([-terms.lever[:, 1], terms.lever[:, 0]], axis=1)
    lack = area - terms.area_at(middle[:, 0], middle[:, 1])
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(middle + g * (lack / _square(ends, terms))[:, None])


# --------------------------------------------------------------------------------------
# The middle vertex, or the reason why there is none.

_CURVE = "a form-parameter curve"


def required_middle(
    ends: FloatArray,
    area: FloatArray,
    centroid: FloatArray | None = None,
    where: Sequence[str] | str = _CURVE,
) -> FloatArray:
    """Give the middle vertices (n, 2) of an area, and a centroid; None for the fairest of the area.

    `where` says what the curves are, for the message.

    Raises
    ------
    DegenerateEndsError
        The area of a curve does not depend on its middle vertex.
    NoMiddleVertexError
        No curve has both the area and the centroid; the nearest centroid is named.
    """
    if centroid is None:
        found, missing = area_vertex(ends, area), np.zeros(len(ends))
    else:
        found, missing = middle_vertex(ends, area, centroid)
    bad = np.flatnonzero(~np.isfinite(found).all(axis=1))
    if not len(bad):
        return found
    row = int(bad[0])
    name = where if isinstance(where, str) else where[row]
    one = ends[row : row + 1]
    only = float(only_area(one)[0])
    if np.isfinite(only) or centroid is None:
        raise DegenerateEndsError(name, float(area[row]), only)
    nearest = float(centroid_limit(one, area[row : row + 1])[0])
    given = (float(area[row]), float(centroid[row]))
    raise NoMiddleVertexError(name, *given, nearest, float(missing[row]))
