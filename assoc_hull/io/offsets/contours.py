"""The ends of a hull given by offsets: stem and stern contour, and the centre profile.

A table of offsets stops at its outermost stations. Where a waterline is 0 there, it ends
at the first zero next to a positive offset. Where it is not, it overhangs:

- Forward, the straight line through the last two offsets is carried on to y = 0.
- Aft, the waterline z = T is closed at a given part of Lpp abaft the AP; Series 60 has
  LWL/Lpp = 1.01675 (F.H. Todd, "Series 60: Methodical Experiments with Models of
  Single-Screw Merchant Ships", DTMB Report 1712, 1963). The stern contour leaves the AP at the
  height z0 where the straight line through the two lowest positive offsets at the last station
  becomes 0 (clamped between them and the waterline below), and follows the parabola
  e = e_T sqrt((z - z0) / (T - z0)) of the overhang e, level at z0 and steeper upward. The
  published numbers do not hold the contour; this rule is ours. It keeps higher waterlines
  farther aft. At 1.25 T and 1.5 T it gives 3.7 m and 4.8 m; the parabola through the last
  three offsets of those waterlines would run on to 4.3 to 4.5 m and 5.5 to 6.4 m, and a
  waterline that ends round ends before that.

Examples
--------
>>> from assoc_hull.io.offsets.contours import end_contours
>>> from assoc_hull.shipped.series60_table import todd_table
>>> stern, stem = end_contours(todd_table(0.70)[0])
>>> stern.round(3).tolist()
[0.0, 0.0, 0.0, 0.0, 0.0, -2.042, -3.661, -4.757]
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, PointKind, freeze
from assoc_hull.io.offsets.table import OffsetTable

__all__ = ["CLOSING", "centre_profile", "end_contours", "stem_contour", "stern_contour"]

_UPRIGHT = 1e-9
CLOSING = 0.01675
"""Overhang of the waterline z = T abaft the AP, as a part of Lpp (DTMB Report 1712)."""


def stem_contour(table: OffsetTable) -> FloatArray:
    """Give the forward end of every waterline.

    Parameters
    ----------
    table : OffsetTable
        Any table.

    Returns
    -------
    (w,), m
        x where the half-breadth becomes 0: the first zero station before the last positive
        one; before a blank the straight line through the last two offsets, no farther than
        the blank station; from the last station of the table the same line, no farther than
        one more station spacing. nan where no offset is positive.

    Examples
    --------
    >>> from assoc_hull.io.offsets.contours import stem_contour
    >>> from assoc_hull.shipped.series60_table import todd_table
    >>> stem_contour(todd_table(0.60)[0])[-3:].round(3).tolist()
    [121.92, 123.009, 123.561]
    """
    ends = _run_out(table.x, table.half_breadth)
    freeze(ends)
    return ends


def stern_contour(table: OffsetTable, closing: float = CLOSING) -> FloatArray:
    """Give the after end of every waterline.

    Parameters
    ----------
    table : OffsetTable
        Any table.
    closing : float
        Overhang of the waterline z = T abaft x = 0, as a part of Lpp; it counts where that
        waterline is positive at the aftermost station.

    Returns
    -------
    (w,), m
        As in `stem_contour`, and by the parabola of the module's head for waterlines that are
        positive at the aftermost station where the design waterline is.

    Raises
    ------
    BadInputError
        The closing lies forward of the aftermost station.

    Examples
    --------
    >>> from assoc_hull.io.offsets.contours import stern_contour
    >>> from assoc_hull.shipped.series60_table import todd_table
    >>> round(float(stern_contour(todd_table(0.60)[0])[5] / 121.92), 5)
    -0.01675
    """
    ends = -_run_out(-table.x[::-1], table.half_breadth[::-1]) + 0.0
    leaving = _leaving_height(table)
    if leaving is not None:
        over = table.z > leaving
        overhang = _overhang(table, leaving, closing, table.z[over])
        ends[over] = table.x[0] - overhang
    freeze(ends)
    return ends


def end_contours(table: OffsetTable, closing: float = CLOSING) -> tuple[FloatArray, FloatArray]:
    """Give `stern_contour` and `stem_contour`, each (w,), m.

    Raises
    ------
    BadInputError
        The closing lies forward of the aftermost station.

    Examples
    --------
    >>> from assoc_hull.io.offsets.contours import end_contours
    >>> from assoc_hull.shipped.series60_table import todd_table
    >>> [round(float(end[-1]), 3) for end in end_contours(todd_table(0.60)[0])]
    [-4.826, 123.561]
    """
    return stern_contour(table, closing), stem_contour(table)


def _run_out(x: FloatArray, y: FloatArray) -> FloatArray:
    """Give where each column of y (s, w) ends in the direction of ascending x (s,)."""
    return np.array([_last_zero(x, column) for column in y.T])


def _last_zero(x: FloatArray, y: FloatArray) -> float:
    positive = np.flatnonzero(y > 0)
    if not len(positive):
        return float("nan")
    last = int(positive[-1])
    if last + 1 < len(x) and y[last + 1] == 0:
        return float(x[last + 1])
    limit = x[last + 1] if last + 1 < len(x) else 2 * x[last] - x[last - 1]
    fall = y[last - 1] - y[last] if last else np.nan
    if not fall > 0:
        return float(x[last])
    return float(min(x[last] + (x[last] - x[last - 1]) * y[last] / fall, limit))


def _leaving_height(table: OffsetTable) -> float | None:
    """Give the height (m) where the stern contour leaves the aftermost station, if it does."""
    y, z, draught = table.half_breadth[0], table.z, table.draught
    positive = np.flatnonzero(y > 0)
    if draught is None or not len(positive) or positive[0] == 0 or len(positive) < 2:
        return None
    low, high = int(positive[0]), int(positive[1])
    rise = (y[high] - y[low]) / (z[high] - z[low])
    zero = z[low] - y[low] / rise if rise > 0 else z[low - 1]
    zero = float(np.clip(zero, z[low - 1], z[low]))
    return zero if zero < draught else None


def _overhang(table: OffsetTable, leaving: float, closing: float, z: FloatArray) -> FloatArray:
    """Give the overhang (m) abaft the aftermost station at the heights z above `leaving`."""
    at_draught = closing * table.length + float(table.x[0])
    if not at_draught > 0 or table.draught is None:
        raise BadInputError(
            f"the closing {closing:g} ends the design waterline at x = "
            f"{-closing * table.length:.6g} m, not abaft the last station, {table.x[0]:.6g} m",
            f"table {table.name!r}",
            "give a larger closing",
        )
    return np.asarray(at_draught * np.sqrt((z - leaving) / (table.draught - leaving)))


def centre_profile(
    table: OffsetTable, closing: float = CLOSING
) -> tuple[FloatArray, NDArray[np.int8]]:
    """Give the profile in the centre plane, from the stern at the deck round to the stem.

    Parameters
    ----------
    table : OffsetTable
        With a level keel in z = 0 and positive offsets on its lowest waterline.
    closing : float
        As in `stern_contour`.

    Returns
    -------
    points : (n, 3), m
        In y = 0: from the highest waterline down the stern contour, where every second point
        is half-way in x between two ends of waterlines; down the upright at the AP to the keel;
        forward along the keel; up the upright stem; out along the rake to the highest
        waterline. A table whose end is not upright gives the ends of all its waterlines.
    kinds : (n,) int8
        A `PointKind` each: knuckles where the contour leaves the upright at the AP, at both
        ends of the keel and where the stem begins to rake; smooth elsewhere.

    Raises
    ------
    BadInputError
        The keel is not level, or the lowest waterline does not lie in z = 0, or an end of a
        waterline is unknown.

    Examples
    --------
    >>> from assoc_hull.io.offsets.contours import centre_profile
    >>> from assoc_hull.shipped.series60_table import todd_table
    >>> points, kinds = centre_profile(todd_table(0.70)[0])
    >>> points[kinds == 2].round(2).tolist()
    [[0.0, 0.0, 6.18], [0.0, 0.0, 0.0], [121.92, 0.0, 0.0], [121.92, 0.0, 6.97]]
    """
    stern, stem = end_contours(table, closing)
    _refuse_rising(table, stern, stem)
    aft, forward = _stern_points(table, stern, closing), _stem_points(table, stem)
    xz = np.concatenate([aft, [[stern[0], 0.0], [stem[0], 0.0]], forward])
    kinds = np.full(len(xz), PointKind.SMOOTH, np.int8)
    corner = len(aft)
    kinds[[corner, corner + 1]] = PointKind.KNUCKLE
    for leaves, foot in ((corner - 1, corner), (corner + 2, corner + 1)):
        if leaves not in (0, len(xz) - 1) and abs(xz[leaves, 0] - xz[foot, 0]) <= _UPRIGHT:
            kinds[leaves] = PointKind.KNUCKLE
    points = np.column_stack([xz[:, 0], np.zeros(len(xz)), xz[:, 1]])
    freeze(points, kinds)
    return points, kinds


def _refuse_rising(table: OffsetTable, stern: FloatArray, stem: FloatArray) -> None:
    known = np.isfinite(stern).all() and np.isfinite(stem).all()
    if table.keel is not None or abs(table.z[0]) > 1e-9 or not known:
        raise BadInputError(
            "the keel is not level or the table does not reach down to it",
            f"table {table.name!r}",
            "draw the centre profile through the keel heights of the table instead",
        )


def _stern_points(table: OffsetTable, stern: FloatArray, closing: float) -> FloatArray:
    """Give (x, z) from the deck down to where the contour meets the upright, (n, 2), m."""
    leaving = _leaving_height(table)
    if leaving is None:
        return _bends(np.column_stack([stern, table.z]))[::-1]
    over = table.z > leaving
    ends = np.concatenate([[0.0], _overhang(table, leaving, closing, table.z[over])])
    overhang = np.sort(np.concatenate([ends, (ends[1:] + ends[:-1]) / 2.0]))
    at_draught = closing * table.length + float(table.x[0])
    z = leaving + (overhang / at_draught) ** 2 * ((table.draught or 0.0) - leaving)
    z[::2] = np.concatenate([[leaving], table.z[over]])
    return np.column_stack([table.x[0] - overhang, z])[::-1]


def _stem_points(table: OffsetTable, stem: FloatArray) -> FloatArray:
    """Give (x, z) from where the stem leaves the upright to the deck, (n, 2), m."""
    return _bends(np.column_stack([stem, table.z]))


def _bends(xz: FloatArray) -> FloatArray:
    """Leave out the points of an upright contour below its last one, (n, 2)."""
    upright = np.flatnonzero(np.abs(xz[:, 0] - xz[0, 0]) <= _UPRIGHT)
    run = int(upright[np.flatnonzero(upright == np.arange(len(upright)))][-1])
    return xz[run:] if run else xz[1:]
