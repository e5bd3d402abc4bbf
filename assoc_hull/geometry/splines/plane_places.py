"""Places on curves that measures of a form start from: where they reach a plane, where they turn.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.curves import CurveData
>>> from assoc_hull.geometry.splines.plane_places import places_on
>>> from assoc_hull.geometry.splines.loft import loft
>>> stem = loft(CurveData.single(np.array([[98.0, 0, 0], [100, 0, 5], [102, 0, 10]])))
>>> places_on(stem, np.array([0.0, 0.0, 1.0]), 5.0).xyz.tolist()
[[100.0, 0.0, 5.0]]
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.polynomials import differentiate, horner
from assoc_hull.geometry.numeric.roots import unit_roots
from assoc_hull.geometry.splines.evaluation import derivative
from assoc_hull.geometry.splines.plane_intersections import meet_planes
from assoc_hull.geometry.splines.segments import power, segment_curve

__all__ = ["Places", "across", "places_on", "turning_places"]

_ON = 1e-6
"""A knot so near to a plane (m) is on it."""


@attrs.frozen(eq=False)
class Places:
    """Places on curves, in order along each.

    Attributes
    ----------
    curve : (k,) int
        The curve of each.
    t : (k,), m
        Chord parameter.
    xyz : (k, 3), m
        Where.
    along : (k, 3)
        Derivative with respect to chord length; after the place, where the curve has a corner.
    """

    curve: IntArray
    t: FloatArray
    xyz: FloatArray
    along: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.curve, self.t, self.xyz, self.along)


def places_on(batch: SplineBatch, normal: FloatArray, offset: float) -> Places:
    """Find where curves pass or touch a plane ``normal . P = offset``, their ends included.

    Of a stretch that lies in the plane the knots are given.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    normal : (3,)
        Unit normal.
    offset : float, m
        Of the plane.

    Returns
    -------
    Places
        In order.
    """
    found = meet_planes(batch, normal, np.array([offset]))
    owner = np.repeat(np.arange(batch.count), np.diff(batch.start))
    on = np.abs(batch.xyz @ normal - offset) <= _ON
    curve = np.concatenate([owner[on], found.curve])
    t = np.concatenate([batch.knot[on], found.t])
    xyz = np.concatenate([batch.xyz[on], found.xyz])
    order = np.lexsort((t, curve))
    curve, t, xyz = curve[order], t[order], xyz[order]
    new = np.ones(len(t), np.bool_)
    new[1:] = (np.diff(curve) != 0) | (np.diff(t) > _ON)
    curve, t, xyz = curve[new], t[new], xyz[new]
    return Places(curve, t, xyz, derivative(batch, curve, t))


def across(batch: SplineBatch, axis: int, value: float) -> Places:
    """Find where curves pass or touch the plane on which a coordinate (0, 1, 2) has a value, m."""
    return places_on(batch, np.eye(3)[axis], value)


def turning_places(batch: SplineBatch, axis: int) -> tuple[FloatArray, ...]:
    """Give places of each curve between which a coordinate only rises or only falls.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    axis : int
        0, 1 or 2.

    Returns
    -------
    tuple of (k, 3), m
        For each curve, in order: knots, and where the derivative of the coordinate is nil.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.geometry.splines.plane_places import turning_places
    >>> xyz = np.array([[0.0, 0, 0], [2, 0, 0]])
    >>> leave, arrive = np.array([[1.0, 2, 0]] * 2), np.array([[1.0, -2, 0]] * 2)
    >>> parabola = SplineBatch(np.array([0, 2]), np.array([0.0, 2]), xyz, leave, arrive)
    >>> round(float(turning_places(parabola, 1)[0][:, 1].max()), 12)
    1.0
    """
    cubic = power(batch)
    inner = unit_roots(differentiate(cubic)[:, :, axis])
    place = horner(cubic, np.concatenate([np.zeros((len(cubic), 1)), inner], axis=1))
    owner = segment_curve(batch)
    last = batch.xyz[batch.start[1:] - 1]
    found = tuple(
        np.concatenate([place[owner == i].reshape(-1, 3), last[i : i + 1]])
        for i in range(batch.count)
    )
    freeze(*found)
    return found
