"""The middle vertex of a form-parameter curve: by area and centroid, by area, or fairest.

The area is affine in the middle vertex P3, so all vertices with an area lie on a line p + s D; on
it the moment is quadratic in s, because N_3 vanishes at both ends of the curve. Of two roots the
one nearer to (P2 + P4)/2 is taken; the other is normally 10 to 10,000 chords away, and loses
digits. `required_middle` gives the vertex or raises with the reason why there is none; the other
functions give nan there. Ends (n, 6, 2) are P0, P1, P2, P4, P5, P6. All is elementwise.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import DegenerateEndsError, NoMiddleVertexError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.integrals import MiddleTerms, middle_terms

__all__ = [
    "area_vertex",
    "centroid_extreme",
    "centroid_limit",
    "fair_vertex",
    "middle_vertex",
    "only_area",
    "required_middle",
    "slide_vertex",
    "with_middle",
]

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
