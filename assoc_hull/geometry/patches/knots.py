"""Knots of B-splines: what is wrong with them, and the pieces between them as Bezier polygons.

A spline of degree d with points P_0 ... P_(c-1) has knots t_0 <= ... <= t_(c+d); its parameter runs
from t_d to t_c. In the span t_s <= t < t_(s+1) it is a polynomial, whose blossom (the symmetric
function of d parameters, linear in each, that gives the polynomial where all are equal) is found
from d + 1 points alone, by the rule of de Boor. The points of the Bezier polygon of a span [a, b]
are blossoms of a and b only, so that all factors lie between 0 and 1 and rounding stays small.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.knots import bezier_pieces
>>> bezier_pieces(np.array([0.0, 2.0, 4.0, 4.0]), np.array([0.0, 0, 0, 1, 2, 2, 2]), 2)
array([[0., 2., 3.],
       [3., 4., 4.]])
"""

from __future__ import annotations

import numpy as np

from assoc_hull.arguments import numbers
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = [
    "bezier_pieces",
    "blossom",
    "checked_knots",
    "cut_spline",
    "insert_knot",
    "knot_domain",
    "nonempty_spans",
    "span_at",
    "span_limits",
]  # fmt: skip

_SAME = 1e-12
"""Knots nearer than this part of their size are one knot: no surface is drawn so finely."""

_LARGEST = 1e12


def knot_domain(knots: FloatArray, degree: int) -> tuple[float, float]:
    """Give the least and the greatest parameter of a spline."""
    return float(knots[degree]), float(knots[-1 - degree])


def checked_knots(values: object, degree: int, count: int, name: str, where: str) -> FloatArray:
    """Take the knots of a spline, or say what is wrong with them.

    Knots that differ by rounding only, 1e-12 of their size, become one knot.

    Parameters
    ----------
    values : (count + degree + 1,) numbers
        What was given as knots.
    degree, count : int
        The degree, at least 1, and the number of control points.
    name, where : str
        The argument, and the surface it belongs to, for messages.

    Returns
    -------
    (count + degree + 1,) float
        The knots, not falling.

    Raises
    ------
    BadInputError
        Knots that are not finite, too few or too many, falling, or so often repeated that the
        surface is torn or has a control point that moves nothing.

    Examples
    --------
    >>> from assoc_hull.geometry.patches.knots import checked_knots
    >>> checked_knots([0, 0, 1, 1], 1, 2, "knots_u", "in a surface")
    array([0., 0., 1., 1.])
    """
    knots = np.atleast_1d(numbers(values, name, where, most=_LARGEST)) + 0.0
    if len(knots) != count + degree + 1:
        raise BadInputError(
            f"{name} has {len(knots)} knots for {count} control points of degree {degree}",
            where, f"give {count + degree + 1}",
        )  # fmt: skip
    steps = np.diff(knots)
    if (steps < 0.0).any():
        at = int(np.argmin(steps))
        raise BadInputError(
            f"{name} falls from {knots[at]:g} to {knots[at + 1]:g} at place {at + 1}",
            where, "sort the knots",
        )  # fmt: skip
    _join_near(knots)
    _require_held(knots, degree, name, where)
    return knots


def _join_near(knots: FloatArray) -> None:
    """Give knots that rounding only keeps apart the value of the first of them."""
    same = np.diff(knots) <= _SAME * np.abs(knots).max(initial=0.0)
    first = np.maximum.accumulate(np.where(np.append(False, same), 0, np.arange(len(knots))))
    knots[:] = knots[first]


def _require_held(knots: FloatArray, degree: int, name: str, where: str) -> None:
    """Refuse knots repeated more than `degree` times between the ends."""
    torn = np.flatnonzero(knots[1 + degree : -1] <= knots[1 : -1 - degree])
    if len(torn):
        value = knots[1 + torn[0]]
        raise BadInputError(
            f"{name} holds {value:g} {np.count_nonzero(knots == value)} times, for degree {degree}",
            where,
            f"repeat a knot at most {degree} times, and {degree + 1} times at both ends",
        )


def nonempty_spans(knots: FloatArray, degree: int) -> IntArray:
    """Give the spans of the parameter that are not empty, each by its first knot, (k,)."""
    inner = slice(degree, len(knots) - degree)
    return np.flatnonzero(np.diff(knots[inner]) > 0.0) + degree


def span_limits(knots: FloatArray, degree: int) -> FloatArray:
    """Give the least and the greatest parameter of each span, (k, 2)."""
    return np.asarray(knots[nonempty_spans(knots, degree)[:, None] + [0, 1]])


def span_at(knots: FloatArray, degree: int, t: FloatArray) -> IntArray:
    """Give the span that holds each parameter (k,); the last also holds its upper end."""
    known = nonempty_spans(knots, degree)
    return known[np.clip(np.searchsorted(knots[known], t, "right") - 1, 0, len(known) - 1)]


def blossom(
    local: FloatArray, knots: FloatArray, degree: int, span: IntArray, at: FloatArray
) -> FloatArray:
    """Evaluate blossoms of a spline, each of the polynomial of one span.

    Parameters
    ----------
    local : (k, degree + 1, ...)
        The control points of each span s: those of numbers s - degree to s.
    knots : (count + degree + 1,)
        The knots.
    degree : int
        The degree.
    span : (k,) int
        The span of each blossom.
    at : (k, degree)
        Its arguments; the spline itself where all of a row are equal.

    Returns
    -------
    (k, ...)
        Values.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.knots import blossom
    >>> local, knots = np.array([[0.0, 1.0]]), np.array([0.0, 0, 2, 2])
    >>> blossom(local, knots, 1, np.array([1]), np.array([[0.5]]))
    array([0.25])
    """
    shape = (len(span), -1) + (1,) * (local.ndim - 2)
    for step in range(1, degree + 1):
        left = span[:, None] + np.arange(step - degree, 1)
        low, high = knots[left], knots[left + degree - step + 1]
        share = ((at[:, step - 1, None] - low) / (high - low)).reshape(shape)
        local = (1.0 - share) * local[:, :-1] + share * local[:, 1:]
    return np.asarray(local[:, 0])


def bezier_pieces(points: FloatArray, knots: FloatArray, degree: int) -> FloatArray:
    """Give a spline as Bezier polygons, one for each span.

    Parameters
    ----------
    points : (count, ...)
        Control points, or rows of a net.
    knots : (count + degree + 1,)
        The knots.
    degree : int
        The degree.

    Returns
    -------
    (k, degree + 1, ...)
        The polygons. The last point of each is the first of the next, to the last bit. A control
        point has a share in at most `degree + 1` of them, and no other one changes with it.

    Notes
    -----
    Point j of a span [a, b] is the blossom of a, degree - j times, and of b, j times: what knot
    insertion gives (W. Boehm, Inserting new knots into B-spline curves, Comput. Aided Des. 12,
    1980), all at once.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.knots import bezier_pieces
    >>> bezier_pieces(np.array([1.0, 2.0, 4.0]), np.array([0.0, 0, 1, 2, 2]), 1)
    array([[1., 2.],
           [2., 4.]])
    """
    known, j = nonempty_spans(knots, degree), np.arange(degree + 1)
    high = np.arange(degree) >= degree - j[:, None]
    at = np.where(high, knots[known + 1][:, None, None], knots[known][:, None, None])
    rows = np.repeat(known, degree + 1)
    local = points[rows[:, None] + np.arange(-degree, 1)]
    found = blossom(local, knots, degree, rows, at.reshape(-1, degree))
    return found.reshape(len(known), degree + 1, *points.shape[1:])


def insert_knot(
    points: FloatArray, knots: FloatArray, degree: int, t: float
) -> tuple[FloatArray, FloatArray]:
    """Insert a knot once: the spline is the same, with one control point more.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.knots import insert_knot
    >>> insert_knot(np.array([0.0, 1.0]), np.array([0.0, 0, 1, 1]), 1, 0.25)
    (array([0.  , 0.25, 1.  ]), array([0.  , 0.  , 0.25, 1.  , 1.  ]))
    """
    span = int(np.searchsorted(knots, t, "right")) - 1
    present = int(np.count_nonzero(knots == t))
    i = np.arange(span - degree + 1, span - present + 1)
    share = (t - knots[i]) / (knots[i + degree] - knots[i])
    share = share.reshape(-1, *(1,) * (points.ndim - 1))
    made = (1.0 - share) * points[i - 1] + share * points[i]
    grown = np.concatenate([points[: span - degree + 1], made, points[span - present :]])
    return grown, np.insert(knots, span + 1, t)


def cut_spline(
    points: FloatArray, knots: FloatArray, degree: int, low: float, high: float
) -> tuple[FloatArray, FloatArray]:
    """Give the part of a spline between two parameters of its domain, as a spline.

    Parameters
    ----------
    points : (count, ...)
        Control points, or rows of a net.
    knots : (count + degree + 1,)
        The knots.
    degree : int
        The degree.
    low, high : float
        The part, in parameters of the spline; each becomes a knot, `degree + 1` times.

    Returns
    -------
    points : (c, ...)
        Control points of the part; those that no new knot touches are the given ones, bit for bit.
    knots : (c + degree + 1,)
        Its knots, of the same parameter.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.knots import cut_spline
    >>> points, knots = cut_spline(
    ...     np.array([0.0, 1.0, 1.0]), np.array([0.0, 0, 0, 1, 1, 1]), 2, 0.0, 0.5
    ... )
    >>> points, knots
    (array([0.  , 0.5 , 0.75]), array([0. , 0. , 0. , 0.5, 0.5, 0.5]))
    """
    for t in (low, high):
        for _ in range(degree - int(np.count_nonzero(knots == t))):
            points, knots = insert_knot(points, knots, degree, t)
    first = int(np.searchsorted(knots, low, "right")) - 1 - degree
    last = int(np.searchsorted(knots, high, "left")) - 1
    inner = knots[first + 1 : last + degree + 1]
    return points[first : last + 1], np.concatenate([[low], inner, [high]])
