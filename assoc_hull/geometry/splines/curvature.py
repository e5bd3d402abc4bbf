"""Curvature of splines: the vector in space, or the signed value in a plane.

The signed curvature is that of the curve's projection onto the plane, positive where the
curve turns to the left as seen from the tip of the normal. For a curve that lies in the
plane its amount is the length of the vector.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.geometry.curves import FloatArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.polynomials import differentiate, horner
from assoc_hull.geometry.numeric.vectors import check_normals, dot
from assoc_hull.geometry.splines.segments import locate, power

__all__ = ["curvature", "plane_curvature", "space_curvature"]


def curvature(
    batch: SplineBatch,
    normal: ArrayLike | None = None,
    at: tuple[ArrayLike, ArrayLike] | None = None,
) -> FloatArray:
    """Give the curvature at places on curves.

    At a knuckle it is the curvature after the knot; at the end of a curve, before it.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    normal : (3,) or (k, 3), optional
        Unit normal of the plane, one for all places or one for each. Without it the
        curvature vector is given.
    at : ((k,) int, (k,) m), optional
        Curve index and chord-length parameter of each place; every knot by default.

    Returns
    -------
    (k, 3) or (k,), 1/m
        The vector, which points to the centre of curvature, or the signed value. It is nan
        where the curve has no direction (a cusp).

    Raises
    ------
    BadInputError
        There is no such curve, a parameter lies off its curve, or a normal is not of unit
        length.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.splines.curvature import curvature
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> xyz = np.array([[0.0, 0, 0], [2, 0, 0]])
    >>> leave, arrive = np.array([[1.0, -2, 0]] * 2), np.array([[1.0, 2, 0]] * 2)
    >>> parabola = SplineBatch(np.array([0, 2]), np.array([0.0, 2]), xyz, leave, arrive)
    >>> curvature(parabola, normal=[0, 0, 1], at=([0], [1.0]))
    array([2.])
    """
    if at is None:
        at = np.repeat(np.arange(batch.count), np.diff(batch.start)), batch.knot
    segment, u = locate(batch, *at)
    slopes = differentiate(power(batch)[segment])
    first = horner(slopes, u[:, None])[:, 0]
    second = horner(differentiate(slopes), u[:, None])[:, 0]
    if normal is None:
        return space_curvature(first, second)
    return plane_curvature(first, second, check_normals(normal, len(u)))


def space_curvature(first: FloatArray, second: FloatArray) -> FloatArray:
    """Give the curvature vector from the derivatives with respect to any parameter.

    Parameters
    ----------
    first, second : (..., 3)
        First and second derivative.

    Returns
    -------
    (..., 3), 1/m
        The vector; nan where the first derivative is nil.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.splines.curvature import space_curvature
    >>> space_curvature(np.array([2.0, 0, 0]), np.array([1.0, 4.0, 0])).tolist()
    [0.0, 1.0, 0.0]
    """
    squared = dot(first, first)[..., None]
    with np.errstate(invalid="ignore", divide="ignore"):
        along = dot(first, second)[..., None] / squared
        vector: FloatArray = (second - along * first) / squared
    freeze(vector)
    return vector


def plane_curvature(first: FloatArray, second: FloatArray, normal: FloatArray) -> FloatArray:
    """Give the signed curvature of the projection onto a plane, from two derivatives.

    Parameters
    ----------
    first, second : (..., 3)
        First and second derivative with respect to any parameter.
    normal : (..., 3)
        Unit normals.

    Returns
    -------
    (...), 1/m
        Signed curvature; nan where the projection has no direction or the normal is nan.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.splines.curvature import plane_curvature
    >>> up = np.array([0.0, 0, 1])
    >>> float(plane_curvature(np.array([2.0, 0, 0]), np.array([1.0, 4.0, 0]), up))
    1.0
    """
    flat = first - dot(first, normal)[..., None] * normal
    speed = np.sqrt(dot(flat, flat))
    with np.errstate(invalid="ignore", divide="ignore"):
        value = np.asarray(dot(normal, np.cross(first, second)) / speed**3)
    freeze(value)
    return value
