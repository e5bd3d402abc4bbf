"""The flats of a hull given by offsets: flat of side in y = B/2, flat of bottom in z = 0.

Where a waterline leaves the flat of side lies between two stations. Near that place the
distance from the flat grows with the square of the distance along the line, so its square
root is laid through the two nearest offsets that are clearly off the flat (by more than
three times the rounding) and the zero of that straight line is taken, clamped between the
last station off the flat and the first one on it. Likewise upward along each station.

Examples
--------
>>> from assoc_hull.io.offsets.flats import flat_of_side
>>> from assoc_hull.shipped.series60_table import todd_table
>>> flat = flat_of_side(todd_table(0.70)[0])
>>> [round(float(end[5]) / 121.92 * 20, 2) for end in (flat.x_aft, flat.x_forward)]
[6.92, 13.08]
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.io.offsets.table import OffsetTable

__all__ = ["FlatOfSide", "flat_of_bottom", "flat_of_side"]

_CLEAR = 3.0
_INSIDE = 0.1
"""The border stays this part of the interval clear of the last offset off the flat: a curve
cannot come onto the flat where its offset is not on it."""


@attrs.frozen(eq=False)
class FlatOfSide:
    """The border of the flat of side.

    Attributes
    ----------
    x_aft, x_forward : (w,), m
        Where each waterline of the table enters and leaves the flat; nan where it has none.
    z_lower : (s,), m
        Where each station of the table enters the flat from below; nan where it has none.
    border : (n, 3), m
        Points of the border in y = B/2: down the aft side from the highest waterline,
        forward along the lower side, up to the highest waterline again. Empty without flat.
    """

    x_aft: FloatArray
    x_forward: FloatArray
    z_lower: FloatArray
    border: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.x_aft, self.x_forward, self.z_lower, self.border)


def flat_of_side(table: OffsetTable) -> FlatOfSide:
    """Find the flat of side of a table.

    Parameters
    ----------
    table : OffsetTable
        An offset counts as on the flat when it is B/2 within its rounding.

    Returns
    -------
    FlatOfSide
        The border holds the ends on the waterlines, and of the stations those below the
        lowest waterline that has a flat. A waterline that touches B/2 at one station only
        has a flat too, as long as the neighbours let it be.

    Examples
    --------
    >>> from assoc_hull.io.offsets.flats import flat_of_side
    >>> from assoc_hull.shipped.series60_table import todd_table
    >>> flat_of_side(todd_table(0.60)[0]).border.shape
    (12, 3)
    """
    off = np.maximum(table.breadth / 2.0 - table.half_breadth, 0.0)
    aft, forward = np.full(len(table.z), np.nan), np.full(len(table.z), np.nan)
    for j, rounding in enumerate(table.rounding):
        aft[j] = _entry(table.x, off[:, j], float(rounding))
        forward[j] = -_entry(-table.x[::-1], off[::-1, j], float(rounding))
    coarsest = float(table.rounding.max())
    lower = np.array([_entry(table.z, row, coarsest) for row in off])
    return FlatOfSide(aft, forward, lower, _border(table, aft, forward, lower))


def _entry(place: FloatArray, off: FloatArray, rounding: float) -> float:
    """Give the place where a line, followed in ascending order, first comes onto the flat."""
    known = np.isfinite(off)
    place, off = place[known], off[known]
    on = np.flatnonzero(off <= rounding * (1 + 1e-6) + 1e-12)
    if not len(on):
        return float("nan")
    first = int(on[0])
    clear = np.flatnonzero(off[:first] > _CLEAR * rounding)[-2:]
    if len(clear) < 2:
        return float(place[first])
    (u, v), (p, q) = place[clear], np.sqrt(off[clear])
    zero = v + (v - u) * q / (p - q) if p > q else place[first]
    off_flat, on_flat = float(place[first - 1]), float(place[first])
    return float(np.clip(zero, off_flat + _INSIDE * (on_flat - off_flat), on_flat))


def _border(
    table: OffsetTable, aft: FloatArray, forward: FloatArray, lower: FloatArray
) -> FloatArray:
    has = np.flatnonzero(np.isfinite(aft))
    if not len(has):
        return np.empty((0, 3))
    down, up = has[::-1], has
    lowest = table.z[has[0]]
    below = np.flatnonzero(lower < lowest)
    inside = (table.x[below] > aft[has[0]]) & (table.x[below] < forward[has[0]])
    below = below[inside]
    x = np.concatenate([aft[down], table.x[below], forward[up]])
    z = np.concatenate([table.z[down], lower[below], table.z[up]])
    return np.column_stack([x, np.full(len(x), table.breadth / 2.0), z])


def flat_of_bottom(table: OffsetTable) -> FloatArray:
    """Give the border of the flat of bottom: the waterline at the base line.

    Parameters
    ----------
    table : OffsetTable
        Its lowest waterline lies at z = 0.

    Returns
    -------
    (n, 3), m
        Points in z = 0 from stern to stem; stations without a number are left out, and of
        the zeros at either end all but the innermost.

    Raises
    ------
    BadInputError
        The table has no waterline at the base line, or no number above 0 on it.

    Examples
    --------
    >>> from assoc_hull.io.offsets.flats import flat_of_bottom
    >>> from assoc_hull.shipped.series60_table import todd_table
    >>> flat_of_bottom(todd_table(0.70)[0])[[0, -1]].tolist()
    [[0.0, 0.0, 0.0], [121.92, 0.0, 0.0]]
    """
    y = table.half_breadth[:, 0]
    wide = np.flatnonzero(y > 0)
    if abs(table.z[0]) > 1e-9 or not len(wide):
        raise BadInputError(
            f"the lowest waterline, at {table.z[0]:g} m, is no flat of bottom",
            f"table {table.name!r}",
            "give the half-breadths of the flat of bottom as waterline 0",
        )
    rows = np.arange(max(wide[0] - 1, 0), min(wide[-1] + 2, len(y)))
    rows = rows[np.isfinite(y[rows])]
    points = np.column_stack([table.x[rows], y[rows], np.zeros(len(rows))])
    freeze(points)
    return points
