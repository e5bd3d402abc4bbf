"""Areas and moments of plane regions by Green's theorem, along the curves that bound them.

The integrands are polynomials in the parameter of a segment. The Gauss rules have as many points
as make them exact: three suffice for the area only (degree 5), second moments need six
(degree 11). Arrays that carry tangents pass through.

Source: H.J. Son, H.C. Kim, "hull form parameter modules for performance analysis", J. of
CAD/CAM (Korea) 13(6), 2008, which uses three points throughout.
"""

from __future__ import annotations

from typing import Any

import attrs
import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.dual import Dual, real
from assoc_hull.geometry.numeric.polynomials import (
    differentiate,
    horner,
    roots_with_tangents,
    unit_roots,
)
from assoc_hull.geometry.numeric.quadrature import gauss
from assoc_hull.geometry.splines.segments import (
    bezier_points,
    power_coefficients,
    segment_curve,
    sum_per_curve,
)

__all__ = [
    "AreaMoments",
    "line_integral",
    "plane_integrals",
    "section_area",
]

_POINTS = 6  # exact to degree 11: second moments of cubics


@attrs.frozen(eq=False)
class AreaMoments:
    """Area and moments of plane regions, counter-clockwise positive; u, v are the two axes.

    Attributes
    ----------
    area : (m,), m2
        Area.
    moment_u, moment_v : (m,), m3
        Integral of u and of v over the area.
    second_uu, second_uv, second_vv : (m,), m4
        Integral of u u, u v and v v over the area.
    """

    area: FloatArray
    moment_u: FloatArray
    moment_v: FloatArray
    second_uu: FloatArray
    second_uv: FloatArray
    second_vv: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(*attrs.astuple(self, recurse=False))

    @property
    def centroid(self) -> FloatArray:
        """Centre of the area, (m, 2) in m; nan where the area is zero."""
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.stack([self.moment_u / self.area, self.moment_v / self.area], axis=1)


def line_integral(
    batch: SplineBatch,
    exponents: tuple[int, int],
    axes: tuple[int, int] = (0, 1),
    along: int = 0,
) -> FloatArray:
    """Integrate ``u^p v^q du``, or ``dv``, along each curve, exactly.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    exponents : (p, q)
        Powers of the two coordinates, from 0.
    axes : (int, int)
        Which coordinates u and v are: 0 for x, 1 for y, 2 for z.
    along : int
        0 for du, 1 for dv.

    Returns
    -------
    (m,), m to the power p + q + 1
        The integrals.

    Raises
    ------
    BadInputError
        An axis, an exponent or `along` is none of the above.
    TooFewPointsError
        A curve has fewer than two points.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.geometry.integrals.area_moments import line_integral
    >>> xyz = np.array([[0.0, 2, 0], [3, 2, 0]])
    >>> ahead = np.array([[1.0, 0, 0], [1, 0, 0]])
    >>> line = SplineBatch(np.array([0, 2]), np.array([0.0, 3]), xyz, ahead, ahead.copy())
    >>> line_integral(line, (0, 1)).round(12).tolist()  # y dx
    [6.0]
    """
    _check_axes(axes)
    if min(exponents) < 0 or along not in (0, 1):
        raise BadInputError(
            f"exponents {exponents} and along={along}",
            "in a line integral",
            "give exponents from 0, and 0 or 1 for du or dv",
        )
    degree = 3 * sum(exponents) + 2
    plane = power_coefficients(batch)[:, :, list(axes)]
    nodes, weights = gauss(max(_POINTS, degree // 2 + 1))
    first, second, step_first, step_second = _at_nodes(plane, nodes)
    step = step_second if along else step_first
    value = first ** exponents[0] * second ** exponents[1] * step * weights
    return sum_per_curve(batch, value.sum(axis=1))


def plane_integrals(
    batch: SplineBatch, axes: tuple[int, int] = (0, 1), close: bool = False
) -> AreaMoments:
    """Give area and moments of the region inside each curve.

    A closed curve bounds its region. An open one bounds what the line from the origin to a
    point sweeps as the point runs along the curve, unless it is closed by a straight line
    from its end to its beginning. So the pieces of a loop may be added up.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    axes : (int, int)
        Which coordinates u and v are: 0 for x, 1 for y, 2 for z.
    close : bool
        Close each curve by a straight line.

    Returns
    -------
    AreaMoments
        One value per curve.

    Raises
    ------
    BadInputError
        The axes are not two different ones of 0, 1, 2.
    TooFewPointsError
        A curve has fewer than two points.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.geometry.integrals.area_moments import plane_integrals
    >>> xyz = np.array([[0.0, 0, 0], [3, 0, 0], [3, 2, 0]])
    >>> along = np.array([[1.0, 0, 0], [0, 1, 0], [0, 1, 0]])
    >>> back = np.array([[1.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    >>> bend = SplineBatch(np.array([0, 3]), np.array([0.0, 3, 5]), xyz, along, back)
    >>> plane_integrals(bend, close=True).area.round(12).tolist()
    [3.0]
    """
    _check_axes(axes)
    sums = sum_per_curve(batch, _sectors(power_coefficients(batch)[:, :, list(axes)]))
    if close:
        begin, end = batch.xyz[batch.start[:-1]], batch.xyz[batch.start[1:] - 1]
        nil = np.zeros(begin.shape)
        line = np.stack([end, begin - end, nil, nil], axis=1)
        sums = sums + _sectors(line[:, :, list(axes)])
    return AreaMoments(*(sums[:, column].copy() for column in range(6)))


def section_area(
    batch: SplineBatch, level: ArrayLike, axes: tuple[int, int] = (1, 2)
) -> FloatArray:
    """Give the area between each section curve, the centre plane and a level.

    It is the integral of y dz along those parts of the curve that lie at or below the
    level, so a section may run down and up again (a twin skeg, a bulb). An end that lies
    off the centre plane or below the level is closed by a horizontal line.

    Parameters
    ----------
    batch : SplineBatch
        Section curves, from keel to deck or from deck to keel. Its arrays may be complex or
        `Dual`, as `DualSplines.batch` gives them: then so is the area.
    level : float or (m,), m
        Height of the water, one for all or one for each curve; may be complex or `Dual`.
    axes : (int, int)
        Which coordinates are the half breadth and the height.

    Returns
    -------
    (m,), m2
        Area of the half section.

    Raises
    ------
    BadInputError
        The levels are not finite or not one per curve, or the axes are no pair.
    TooFewPointsError
        A curve has fewer than two points.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.geometry.integrals.area_moments import section_area
    >>> xyz = np.array([[0.0, 0, 0], [0, 4, 4]])  # a wedge
    >>> up = np.full((2, 3), [0.0, 0.5**0.5, 0.5**0.5])
    >>> wedge = SplineBatch(np.array([0, 2]), np.array([0.0, 32**0.5]), xyz, up, up.copy())
    >>> section_area(wedge, 2.0).round(12).tolist()
    [2.0]
    """
    _check_axes(axes)
    heights: Any = level if isinstance(level, Dual) else np.asarray(level)
    if heights.shape not in ((), (batch.count,)) or not np.isfinite(real(level)).all():
        raise BadInputError(
            f"levels of shape {heights.shape}, or not finite",
            f"for {batch.count} section curves",
            "give one height for all or one for each",
        )
    top = np.broadcast_to(heights, (batch.count,))[segment_curve(batch)]
    below: NDArray[np.bool_] = real(bezier_points(batch))[:, :, axes[1]] <= real(top)[:, None]
    whole = np.asarray(below.all(axis=1))
    cut = ~whole & below.any(axis=1)
    plane = power_coefficients(batch)[:, :, list(axes)]
    uncut = _strips(plane[~cut], np.zeros(int((~cut).sum())), np.where(whole[~cut], 1.0, 0.0))
    strips = np.concatenate([uncut, _cut_strips(plane[cut], top[cut])])
    order = np.argsort(np.concatenate([np.flatnonzero(~cut), np.flatnonzero(cut)]))
    sums = sum_per_curve(batch, strips[order])
    area = np.where(np.signbit(real(sums)), -sums, sums)
    freeze(area)
    return area


def _check_axes(axes: tuple[int, int]) -> None:
    """Refuse anything but two different coordinates."""
    if axes[0] == axes[1] or not set(axes) <= {0, 1, 2}:
        raise BadInputError(
            f"axes {axes}", "in a plane integral", "give two different ones of 0, 1 and 2"
        )


def _at_nodes(plane: FloatArray, u: FloatArray) -> tuple[FloatArray, ...]:
    """Give both coordinates and both derivatives, (s, k) each, of cubics (s, 4, 2)."""
    places = np.broadcast_to(u, (len(plane), u.shape[-1]))
    slopes = differentiate(plane)
    return tuple(
        horner(cubics[:, :, axis], places) for cubics in (plane, slopes) for axis in range(2)
    )


def _sectors(plane: FloatArray) -> FloatArray:
    """Give area and moments swept from the origin by each cubic (s, 4, 2), as (s, 6)."""
    nodes, weights = gauss(_POINTS)
    first, second, step_first, step_second = _at_nodes(plane, nodes)
    swept = (first * step_second - second * step_first) * weights
    # A sliver from the origin to (u, v) has its centre at 2/3, its mean squares at 1/2.
    columns = [
        swept / 2.0,
        first * swept / 3.0,
        second * swept / 3.0,
        first * first * swept / 4.0,
        first * second * swept / 4.0,
        second * second * swept / 4.0,
    ]
    return np.stack([column.sum(axis=1) for column in columns], axis=1)


def _strips(plane: FloatArray, low: FloatArray, high: FloatArray) -> FloatArray:
    """Integrate the first coordinate over the second between two parameters, (s,)."""
    nodes, weights = gauss(_POINTS)
    u = low[:, None] + (high - low)[:, None] * nodes
    first, step = horner(plane[:, :, 0], u), horner(differentiate(plane[:, :, 1]), u)
    integral: FloatArray = (first * step * weights).sum(axis=1) * (high - low)
    return integral


def _cut_strips(plane: FloatArray, top: FloatArray) -> FloatArray:
    """Integrate y dz over the parts of each cubic at or below its level, (c,)."""
    height = np.concatenate([plane[:, :1, 1] - top[:, None], plane[:, 1:, 1]], axis=1)
    end = np.ones((len(top), 1))
    edge = np.concatenate([0.0 * end, unit_roots(real(height)), end], axis=1)
    below = horner(real(height), 0.5 * (edge[:, :-1] + edge[:, 1:])) <= 0.0
    crossing = np.zeros(edge.shape, bool)
    crossing[:, 1:-1] = below[:, :-1] != below[:, 1:]
    edge = roots_with_tangents(height, edge, crossing)
    total = np.zeros(len(top))
    for part in range(edge.shape[1] - 1):
        strip = _strips(plane, edge[:, part], edge[:, part + 1])
        total = total + np.where(below[:, part], strip, 0.0)
    return total
