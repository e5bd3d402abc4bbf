"""Inflections of curves, counted exactly.

The five criteria of fairness are computed in `assoc_hull.geometry.fairness.criteria`; curvature
combs in `assoc_hull.geometry.fairness.combs`.

The numerator of the signed curvature of a cubic, ``n . (P' x P'')``, is a quadratic in the
segment's parameter: of the products of P' (degree 2) and P'' (degree 1) the term of degree 3
is the cross product of a vector with itself. So its roots, and the angles by which the
tangent turns between them, are exact; nothing is sampled.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.fairness.criteria import FairnessRecord, criteria
from assoc_hull.geometry.numeric.polynomials import differentiate, horner, quadratic_roots
from assoc_hull.geometry.numeric.vectors import check_normals, dot
from assoc_hull.geometry.splines.segments import power_coefficients, segment_curve, segment_start

__all__ = ["LOBE", "FairnessRecord", "InflectionPoints", "criteria", "inflections"]

_STRAIGHT = 1e-9  # rad: a turn below this is the rounding of a straight stretch


@attrs.frozen(eq=False)
class InflectionPoints:
    """Places on curves of a batch, in the order of the curves.

    Attributes
    ----------
    curve : (p,) int
        The curve.
    t : (p,), m
        Chord-length parameter.
    """

    curve: IntArray
    t: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.curve, self.t)

    def __len__(self) -> int:
        return len(self.curve)


@attrs.frozen(eq=False)
class _Parts:
    """Stretches of curves of one sign of curvature: the turn (rad) and both ends (m)."""

    curve: IntArray
    turn: FloatArray
    begin: FloatArray
    end: FloatArray


LOBE = 0.2
"""degrees: what turns by less is no lobe, where nothing else is asked for."""


def inflections(
    batch: SplineBatch, normals: ArrayLike, lobe_deg: float = LOBE
) -> tuple[IntArray, InflectionPoints]:
    """Count the changes of the sign of curvature along each plane curve.

    A lobe is a stretch that bends to one side. The count is one less than the greatest
    number of lobes, of alternating sign, that each turn by `lobe_deg` or more between their
    ends; what turns by less is part of the lobe around it. A knuckle neither begins a new
    lobe nor counts as a turn. For a curve that does not lie in its plane, the projection
    onto it is looked at.

    Parameters
    ----------
    batch : SplineBatch
        The curves.
    normals : (m, 3) or (3,)
        Unit normal of the plane of each curve. A row of nan marks a space curve: its
        curvature has no sign, so it has no inflection and counts 0.
    lobe_deg : float
        Least turn of a lobe, in degrees.

    Returns
    -------
    count : (m,) int
        Inflections of each curve.
    places : InflectionPoints
        Where they are. Between two lobes that a straight stretch parts, its middle.

    Raises
    ------
    BadInputError
        A normal is not of unit length, or `lobe_deg` is negative.
    TooFewPointsError
        A curve has fewer than two points.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import SplineBatch
    >>> from assoc_hull.geometry.fairness.inflections import inflections
    >>> xyz = np.array([[0.0, 0, 0], [4, 2, 0]])
    >>> flat = np.array([[1.0, 0, 0], [1, 0, 0]])
    >>> s_shape = SplineBatch(np.array([0, 2]), np.array([0.0, 4]), xyz, flat, flat.copy())
    >>> count, places = inflections(s_shape, [0, 0, 1])
    >>> count.tolist(), places.t.tolist()
    ([1], [2.0])
    """
    if not lobe_deg >= 0.0:
        raise BadInputError(
            f"a least lobe of {lobe_deg} degrees",
            "where inflections were counted",
            "give 0 or more",
        )
    lobes = _lobes(_parts(batch, check_normals(normals, batch.count)))
    before = _changes(lobes, max(float(np.deg2rad(lobe_deg)), _STRAIGHT))
    places = InflectionPoints(
        lobes.curve[before], 0.5 * (lobes.end[before] + lobes.begin[before + 1])
    )
    count = np.bincount(places.curve, minlength=batch.count)
    freeze(count)
    return count, places


def _hodographs(batch: SplineBatch, normals: FloatArray) -> FloatArray:
    """Give P'(u) of each segment in axes of its curve's plane, power form (s, 3, 2)."""
    axis = np.zeros_like(normals)
    axis[np.arange(len(normals)), np.argmin(np.abs(normals), axis=1)] = 1.0
    across = np.cross(normals, axis)
    across /= np.sqrt(dot(across, across))[:, None]
    ahead = np.cross(across, normals)
    curve, slopes = segment_curve(batch), differentiate(power_coefficients(batch))
    return np.stack([dot(slopes, plane[curve, None]) for plane in (ahead, across)], axis=2)


def _parts(batch: SplineBatch, normals: FloatArray) -> _Parts:
    """Split the segments so that each part bends to one side, by less than 180 degrees."""
    hodograph = _hodographs(batch, normals)
    edge = _edges(hodograph)
    ahead, across = (horner(hodograph[:, :, axis], edge) for axis in range(2))
    sine = ahead[:, :-1] * across[:, 1:] - across[:, :-1] * ahead[:, 1:]
    cosine = ahead[:, :-1] * ahead[:, 1:] + across[:, :-1] * across[:, 1:]
    turn = np.arctan2(sine, cosine)
    # The comparison is false for nan, which drops the curves that have no plane.
    segment, part = np.nonzero(np.abs(turn) > _STRAIGHT)
    knot = segment_start(batch)[segment]
    low, high = batch.knot[knot], batch.knot[knot + 1]
    begin, end = (
        np.where(u == 1.0, high, low + u * (high - low))
        for u in (edge[segment, part], edge[segment, part + 1])
    )
    return _Parts(segment_curve(batch)[segment], turn[segment, part], begin, end)


def _edges(hodograph: FloatArray) -> FloatArray:
    """Give 0, the roots of the curvature with the vertex between them, and 1, (s, 5).

    The vertex of the curvature's numerator is where the hodograph, a parabola, runs against
    its own axis as seen from the origin: a part that stays on one side of it turns by less
    than 180 degrees, so the arc tangent of its ends is the whole turn.
    """
    constant, linear, square = (hodograph[:, row] for row in range(3))
    numerator = _cross(constant, linear), 2.0 * _cross(constant, square), _cross(linear, square)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        vertex = -numerator[1] / (2.0 * numerator[2])
    roots = quadratic_roots(*numerator)
    # Sorted, nan comes last: if the first is nan there is no root, and the vertex is enough.
    roots = np.where(np.isnan(roots[:, :1]), vertex[:, None], roots)
    inner = np.stack([roots[:, 0], vertex, roots[:, 1]], axis=1)
    inner = np.sort(np.clip(np.where(np.isnan(inner), 0.0, inner), 0.0, 1.0), axis=1)
    end = np.ones((len(inner), 1))
    return np.concatenate([0.0 * end, inner, end], axis=1)


def _cross(left: FloatArray, right: FloatArray) -> FloatArray:
    """Give the cross products of rows of the plane, (s,)."""
    product: FloatArray = left[:, 0] * right[:, 1] - left[:, 1] * right[:, 0]
    return product


def _lobes(parts: _Parts) -> _Parts:
    """Join neighbouring parts of one curve that bend to the same side."""
    if len(parts.turn) == 0:
        return parts
    other_side = np.diff(np.sign(parts.turn)) != 0.0
    new = np.ones(len(parts.turn), np.bool_)
    new[1:] = other_side | (np.diff(parts.curve) != 0)
    first = np.flatnonzero(new)
    last = np.append(first[1:], len(new)) - 1
    turn = np.add.reduceat(parts.turn, first)
    return _Parts(parts.curve[first], turn, parts.begin[first], parts.end[last])


def _changes(lobes: _Parts, least: float) -> IntArray:
    """Give the lobes after which the sign changes, small lobes taken into their neighbours.

    The direction of the tangent goes up and down along the lobes. A change is a summit or a
    valley of it from which it has come and goes by `least` or more, the farthest such place.
    """
    found: list[int] = []
    curve, side, at = -1, 0, -1
    heading = high = low = peak = 0.0
    rows = zip(lobes.curve.tolist(), lobes.turn.tolist(), strict=True)
    for index, (owner, turn) in enumerate(rows):
        if owner != curve:
            curve, side = owner, 0
            heading = high = low = 0.0
        heading += turn
        if side == 0:
            high, low = max(high, heading), min(low, heading)
            if max(heading - low, high - heading) >= least:
                side, peak, at = (1 if turn > 0.0 else -1), heading, index
        elif side * (heading - peak) > 0.0:
            peak, at = heading, index
        elif side * (peak - heading) >= least:
            found.append(at)
            side, peak, at = -side, heading, index
    return np.array(found, np.int64)
