"""The middle vertex of form-parameter curves, or the reason why there is none.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.form_curves.solve import required_middle
>>> ends = np.array([[[-1.0, 0], [0, 0], [1, 0], [3, 1], [4, 1], [5, 1]]])
>>> [round(float(each), 6) for each in required_middle(ends, np.array([2.0]))[0]]
[2.0, 0.5]
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.errors import DegenerateEndsError, NoMiddleVertexError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.middle import (
    area_vertex,
    centroid_limit,
    middle_vertex,
    only_area,
)

__all__ = ["required_middle"]

_CURVE = "a form-parameter curve"


def required_middle(
    ends: FloatArray,
    area: FloatArray,
    centroid: FloatArray | None = None,
    where: Sequence[str] | str = _CURVE,
) -> FloatArray:
    """Give the middle vertices of an area, and a centroid.

    Parameters
    ----------
    ends : (n, 6, 2)
        P0, P1, P2, P4, P5, P6.
    area : (n,)
        int y dx.
    centroid : (n,) or None
        int x y dx / area; None for the fairest of the area.
    where : sequence of str, or str
        What the curves are, for the message.

    Returns
    -------
    (n, 2)

    Raises
    ------
    DegenerateEndsError
        The area of a curve does not depend on its middle vertex.
    NoMiddleVertexError
        Area and centroid of a curve cannot both be met; the nearest centroid is named.
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
