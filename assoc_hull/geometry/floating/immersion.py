"""What lies below floating planes: any strips of curves, integrated.

`prepare` integrates every tile of the curves once; `immersed` cuts them by planes and adds
up. Only tiles that a plane crosses are integrated anew, up to the cut, exactly. Both sides
are integrals over the port half: starboard's are those of the plane heeled the other way.

V and its moments are fluxes through the shell alone, along a direction in the plane.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.floating.immersed import Planes
>>> from assoc_hull.geometry.surfaces.isocurves import IsoCurves
>>> class Wedge:  # 8 m long, 3 m deep, 2 m wide at either side
...     count, order = 1, np.array([2])
...     def curves(self, strip, v):
...         point, across = np.zeros((2, len(v), 4, 3))
...         point[:, 0, 0], point[:, 1], across[:, 0, 0] = 8.0 * v, [0.0, 2.0, 3.0], 8.0
...         return IsoCurves(np.arange(len(v) + 1), point, across, np.zeros(len(v), bool))
>>> below = immersed(prepare(Wedge()), Planes(np.array([1.5, 2.25]), np.zeros(2), np.zeros(2)))
>>> below.volume.round(12).tolist(), below.area.round(12).tolist()
([12.0, 27.0], [16.0, 24.0])
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.immersed import Immersed, Planes
from assoc_hull.geometry.floating.immersion_columns import Half
from assoc_hull.geometry.floating.immersion_half import half
from assoc_hull.geometry.floating.prepared_strips import Prepared, prepare
from assoc_hull.geometry.numeric.dual import is_plain, real

__all__ = ["Prepared", "immersed", "prepare"]

_MOST = 256  # planes at a time, which bounds the memory
_ODD = frozenset({"moment_y", "area_y", "area_xy"})


def immersed(prepared: Prepared, planes: Planes) -> Immersed:
    """Integrate both sides of a body below floating planes.

    Parameters
    ----------
    prepared : Prepared
        The body.
    planes : Planes
        d planes; those of one inclination are worked on together.

    Returns
    -------
    Immersed
        The integrals, (d,) each.

    Notes
    -----
    Points on a plane are below it: at the very height of a flat bottom or a flat deck all
    values are those just above. Every integral changes continuously with the plane.

    The numbers may be complex or carry tangents; decisions are taken on their real values.

    Extents are those of the cuts of all curves, of the ends of strips, and of the places where
    pieces appear, which are exact. Between curves only the greatest half breadth is looked
    for: its error goes with the fourth power of the distance of the curves.

    A body must be closed: an end that lies off the centre plane has to lie in a plane
    x = const, or under heel it lacks the flux and the waterline there.
    """
    height, trim, heel = planes.height, planes.tan_trim, planes.tan_heel
    parts, places = [], []
    for rows in _groups(planes):
        for begin in range(0, len(rows), _MOST):
            some = rows[begin : begin + _MOST]
            parts.append(_both_sides(prepared, height[some], trim[some[:1]], heel[some[:1]]))
            places.append(some)
    return _joined(parts, places)


def _groups(planes: Planes) -> list[IntArray]:
    """Part planes by inclination, each group by ascending height."""
    trim, heel = planes.tan_trim, planes.tan_heel
    if len(trim) == 1 or not (is_plain(trim) and is_plain(heel)):
        # The derivatives that inclinations carry along may be different ones.
        return [np.array([row]) for row in range(len(trim))]
    order = np.lexsort((real(planes.height), heel, trim))
    new = (np.diff(trim[order]) != 0.0) | (np.diff(heel[order]) != 0.0)
    return np.split(order, np.flatnonzero(new) + 1)


def _joined(parts: list[dict[str, FloatArray]], places: list[IntArray]) -> Immersed:
    """Put the planes back into their order."""
    if len(parts) == 1 and len(places[0]) == 1:
        return Immersed(**parts[0])
    if not parts:
        return Immersed(*np.zeros((len(attrs.fields(Immersed)), 0)))
    order = np.argsort(np.concatenate(places))
    return Immersed(
        **{name: np.concatenate([part[name] for part in parts])[order] for name in parts[0]}
    )


def _both_sides(
    prepared: Prepared, height: FloatArray, trim: FloatArray, heel: FloatArray
) -> dict[str, FloatArray]:
    """Integrate below planes of one inclination, by ascending height."""
    port = half(prepared, height, trim, heel)
    upright = is_plain(heel) and heel[0] == 0.0
    starboard = port if upright else half(prepared, height, trim, -heel)
    return _sums(port.columns, starboard.columns) | _extents(port, starboard)


def _sums(port: FloatArray, starboard: FloatArray) -> dict[str, FloatArray]:
    """Add both sides; what is odd in y changes its sign to starboard."""
    names = ("volume", "moment_x", "moment_y", "moment_z", "shell", "girth", "wet_deck")
    plane = ("area", "area_x", "area_y", "area_xx", "area_xy", "area_yy")
    both, odd = port + starboard, port - starboard
    rows = zip((*names, *plane), both, odd, strict=True)
    return {name: alone if name in _ODD else even for name, even, alone in rows}


def _extents(port: Half, starboard: Half) -> dict[str, FloatArray]:
    """Give the extents of the waterplane of both sides."""
    one, other = port.extent, starboard.extent
    none = ~np.isfinite(real(one[1])) & ~np.isfinite(real(other[1]))
    rows = {
        "x_least": -_larger(-one[0], -other[0]),
        "x_most": _larger(one[1], other[1]),
        "y_least": -_larger(-one[2], other[3]),
        "y_most": _larger(one[3], -other[2]),
    }
    return {name: np.where(none, np.nan, row) for name, row in rows.items()}


def _larger(one: FloatArray, other: FloatArray) -> FloatArray:
    return np.where(real(one) >= real(other), one, other)
