"""Curvature combs: teeth along curves that show how they bend."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, SplineBatch, freeze
from assoc_hull.geometry.numeric.polynomials import differentiate, horner
from assoc_hull.geometry.numeric.vectors import check_normals, dot
from assoc_hull.geometry.splines.curvature import plane_curvature, space_curvature
from assoc_hull.geometry.splines.segments import power, segment_curve, segment_start

__all__ = ["combs"]


def combs(
    batch: SplineBatch, normals: ArrayLike, per_segment: int = 8, scale: float = 1.0
) -> tuple[FloatArray, FloatArray]:
    """Give curvature combs: points of the curves, and the tips of the teeth on them.

    A tooth points to the centre of curvature and is `scale` times the curvature long; with
    a negative scale the comb stands on the outside. Both ends of each segment have a tooth,
    so that a knuckle shows both of its curvatures.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    normals : (m, 3) or (3,)
        Unit normal of the plane of each curve; a row of nan for the comb of a space curve.
    per_segment : int
        Teeth on each segment, two or more.
    scale : float
        Length of a tooth (m) at unit curvature (1/m), m2.

    Returns
    -------
    base : (s, per_segment, 3), m
        Points at equal steps of the parameter, segment by segment.
    tip : (s, per_segment, 3), m
        The tips; nan where the curve has no direction.

    Raises
    ------
    BadInputError
        A normal is not of unit length, or there are fewer than two teeth per segment.
    TooFewPointsError
        A curve has fewer than two points.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.geometry.fairness.combs import combs
    >>> xyz = np.array([[0.0, 0, 0], [2, 0, 0]])
    >>> leave, arrive = np.array([[1.0, -2, 0]] * 2), np.array([[1.0, 2, 0]] * 2)
    >>> parabola = SplineBatch(np.array([0, 2]), np.array([0.0, 2]), xyz, leave, arrive)
    >>> base, tip = combs(parabola, [0, 0, 1], per_segment=3, scale=0.5)
    >>> base[0, 1].tolist(), tip[0, 1].tolist()
    ([1.0, -1.0, 0.0], [1.0, 0.0, 0.0])
    """
    if per_segment < 2:
        raise BadInputError(
            f"{per_segment} teeth per segment", "in a curvature comb", "give two or more"
        )
    normal = check_normals(normals, batch.count)[segment_curve(batch), None]
    cubics = power(batch)
    u = np.broadcast_to(np.linspace(0.0, 1.0, per_segment), (len(cubics), per_segment))
    slopes = differentiate(cubics)
    base = horner(cubics, u).copy()
    base[:, -1] = batch.xyz[segment_start(batch) + 1]
    tooth = _teeth(horner(slopes, u), horner(differentiate(slopes), u), normal)
    tip = base + scale * tooth
    freeze(base, tip)
    return base, tip


def _teeth(first: FloatArray, second: FloatArray, normal: FloatArray) -> FloatArray:
    """Give curvature vectors: in the plane where there is one, else in space."""
    left = np.cross(normal, first)
    size = np.sqrt(dot(left, left))
    with np.errstate(invalid="ignore", divide="ignore"):
        signed = plane_curvature(first, second, normal) / size
    return np.where(np.isnan(normal), space_curvature(first, second), signed[..., None] * left)
