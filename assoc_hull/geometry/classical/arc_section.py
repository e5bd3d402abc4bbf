"""Curves through points, or round the corners of a polygon, by lines and arcs; the mean circle.

Examples
--------
>>> from assoc_hull.geometry.classical.arc_section import mean_curvatures
>>> points = [(0, 0), (6, 0.2), (10, 1.5), (12, 4), (12.4, 8)]
>>> float(mean_curvatures(points)[1].round(10))
0.1047945258
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any, TypeGuard

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import shown
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.arc_curve import ArcCurve
from assoc_hull.geometry.classical.arcs import Arcs, sinc
from assoc_hull.geometry.classical.checks import figure, finite, wrap
from assoc_hull.geometry.curves import FloatArray

__all__ = ["mean_curvatures", "round_corners", "three_point_curvatures", "through_points"]

_STRAIGHT = 1e-12
"""A curvature times a chord below this is a line."""

_ROUNDING = 1e-12
"""By so much, as a part, a radius may be below half its chord."""


def three_point_curvatures(points: ArrayLike, *, name: str = "section") -> FloatArray:
    """Give the signed curvature (1/m) of the circle through each three points in a row.

    Parameters
    ----------
    points : (n, 2), m
        In order.
    name : str
        For messages.

    Returns
    -------
    (n - 2,), 1/m
        Positive turns left; 0 where three points are in line.

    Raises
    ------
    GeometryError
        ``"section: coincident points {i},{i+1}"``.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.arc_section import three_point_curvatures
    >>> three_point_curvatures([(1, 0), (0, 1), (-1, 0)]).round(12).tolist()
    [1.0]
    """
    given = _points(points, name)
    step, across = np.diff(given, axis=0), given[2:] - given[:-2]
    length, base = np.hypot(*step.T), np.hypot(*across.T)
    cross = step[:-1, 0] * step[1:, 1] - step[:-1, 1] * step[1:, 0]
    back = np.flatnonzero(base == 0.0)
    if len(back):
        raise _coincident(name, int(back[0]), int(back[0]) + 2)
    return np.asarray(2.0 * cross / (length[:-1] * length[1:] * base))


def mean_curvatures(
    points: ArrayLike, knuckles: Collection[int] = (), *, name: str = "section"
) -> FloatArray:
    """Give the curvature (1/m) of the mean circle of each interval.

    It is the mean of the curvatures of the circles through three points at its two ends; at an
    end of the curve and at a knuckle the one that there is, 0 where there is none. Curvatures
    are meant, not radii: so it is known for points in line and at inflections, and it is exact on
    circles. The rule of Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method
    for Design and Production", J. SNAK, as it is read here.

    Parameters
    ----------
    points : (n, 2), m
        In order.
    knuckles : collection of int
        Indices of points across which nothing is looked at.
    name : str
        For messages.

    Returns
    -------
    (n - 1,), 1/m

    Raises
    ------
    GeometryError
        ``"section: coincident points {i},{i+1}"``.
    """
    given = _points(points, name)
    at = np.full(len(given), np.nan)
    at[1:-1] = three_point_curvatures(given, name=name)
    at[_indices(knuckles, len(given), name)] = np.nan
    known = np.isfinite(at)
    value = np.where(known, at, 0.0)
    count = np.maximum(known[:-1].astype(np.int64) + known[1:], 1)
    return np.asarray((value[:-1] + value[1:]) / count)


def through_points(
    points: ArrayLike,
    *,
    kind: str | Sequence[str] = "arc",
    radius: Sequence[float | None] | None = None,
    knuckles: Collection[int] = (),
    name: str = "section",
) -> ArcCurve:
    """Give the curve through points (C0), a line or a minor arc in each interval.

    Parameters
    ----------
    points : (n, 2), m
        (y, z) of a transverse section, (x, z) of a boundary curve.
    kind : {"line", "arc"} or sequence of such
        Of all intervals, or of each.
    radius : sequence of (float or None), m, optional
        Of each interval, positive where it turns left; None for the mean circle.
    knuckles : collection of int
        Indices of points at which the mean circles of the two sides do not know each other.
    name : str
        For messages.

    Returns
    -------
    ArcCurve
        Keeps the points; circles and lines are reproduced.

    Raises
    ------
    GeometryError
        ``"section: radius {R} smaller than half the chord {l/2} at interval {i}"``;
        ``"section: mean circle at interval {i} has |K| l/2 >= 1"``;
        ``"section: coincident points {i},{i+1}"``; kinds or radii that do not fit the points.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.arc_section import through_points
    >>> bilge = through_points([(0, 0), (8, 0), (10, 2), (10, 9)],
    ...                        kind=["line", "arc", "line"], radius=[None, 2.0, None])
    >>> round(bilge.moments_below(9.0)[0], 9)
    89.141592654
    """
    given = _points(points, name)
    kinds, radii = _kinds(kind, len(given) - 1, name), _radii(radius, len(given) - 1, name)
    step = np.diff(given, axis=0)
    chord, way = np.hypot(*step.T), np.arctan2(step[:, 1], step[:, 0])
    arc = np.array([each == "arc" for each in kinds])
    free = arc & np.isnan(radii)
    mean = mean_curvatures(given, knuckles, name=name) if free.any() else np.zeros(len(chord))
    with np.errstate(divide="ignore"):
        bend = np.where(free, mean, np.where(arc, 1.0 / radii, 0.0))
    sine = 0.5 * bend * chord
    _require_circles(sine, free, radii, chord, name)
    bend = np.where(np.abs(2.0 * sine) < _STRAIGHT, 0.0, bend)
    half = np.arcsin(np.clip(0.5 * bend * chord, -1.0, 1.0))
    arcs = Arcs(given[:-1].copy(), way - half, bend, chord / sinc(half))
    return ArcCurve(arcs, given, name, frozenset(_indices(knuckles, len(given), name)))


def round_corners(
    points: ArrayLike, *, radius: Sequence[float | None] | None = None, name: str = "section"
) -> ArcCurve:
    """Give the polygon of the points with its corners rounded: tangents without a jump (G1).

    The points between the ends are left, but where the curve runs straight on.

    Parameters
    ----------
    points : (n, 2), m
        Corners of the polygon.
    radius : sequence of (float or None), m, optional
        Of the n - 2 corners, positive where they turn left; None for the largest that uses
        half of the shorter leg.
    name : str
        For messages.

    Raises
    ------
    GeometryError
        ``"section: fillets {i} and {j} overlap"`` (by index of points; the ends count as fillets
        of no length); coincident points; a radius that turns to the other side.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.arc_section import round_corners
    >>> curve = round_corners([(0, 0), (10, 0), (12, 6)], radius=[2.5])
    >>> curve.arcs.centres()[1].round(8).tolist()
    [8.19810195, 2.5]
    """
    given = _points(points, name)
    step = np.diff(given, axis=0)
    legs, way = np.hypot(*step.T), np.arctan2(step[:, 1], step[:, 0])
    turn = wrap(np.diff(way))
    radii = _radii(radius, len(given) - 2, name)
    reach = np.zeros(len(given))
    reach[1:-1] = _reaches(radii, turn, legs, name)
    over = np.flatnonzero(reach[:-1] + reach[1:] > legs * (1.0 + _ROUNDING))
    if len(over):
        i = int(over[0])
        raise GeometryError(
            f"{name}: fillets {i} and {i + 1} overlap",
            f"their tangents of {figure(reach[i])} and {figure(reach[i + 1])} have "
            f"{figure(legs[i])}: give smaller radii",
            {"i": i, "j": i + 1},
        )  # fmt: skip
    return ArcCurve(_rounded(given, legs, way, turn, reach), given, name)


def _rounded(
    given: FloatArray, legs: FloatArray, way: FloatArray, turn: FloatArray, reach: FloatArray
) -> Arcs:
    """Give straight pieces and fillets in turn, without those of no length."""
    along = np.stack([np.cos(way), np.sin(way)], axis=1)
    straight = np.maximum(legs - reach[:-1] - reach[1:], 0.0)
    inner = reach[1:-1]
    with np.errstate(divide="ignore", invalid="ignore"):
        bend = np.where(inner > 0.0, np.tan(0.5 * turn) / inner, 0.0)
        round_ = np.where(inner > 0.0, turn / bend, 0.0)
    count = 2 * len(legs) - 1
    start, angle = np.empty((count, 2)), np.empty(count)
    curvature, length = np.zeros(count), np.empty(count)
    start[::2] = given[:-1] + along * reach[:-1, None]
    start[1::2] = given[1:-1] - along[:-1] * inner[:, None]
    angle[::2], angle[1::2] = way, way[:-1]
    curvature[1::2] = bend
    length[::2], length[1::2] = straight, round_
    keep = length > 1e-12 * float(legs.max())
    return Arcs(start[keep], angle[keep], curvature[keep], length[keep])


def _reaches(radii: FloatArray, turn: FloatArray, legs: FloatArray, name: str) -> FloatArray:
    """Give the tangent length (m) of each corner."""
    wrong = np.flatnonzero((np.abs(turn) > _STRAIGHT) & (radii * turn < 0.0))
    if len(wrong):
        corner = int(wrong[0]) + 1
        raise GeometryError(
            f"{name}: radius {figure(radii[wrong[0]])} turns against the corner at point {corner}",
            "change its sign", {"point": corner},
        )  # fmt: skip
    back = np.flatnonzero(np.abs(turn) > np.pi - 1e-9)
    if len(back):
        corner = int(back[0]) + 1
        what = f"{name}: the polygon turns back on itself at point {corner}"
        raise GeometryError(what, "leave the point out", {"point": corner})
    half = 0.5 * np.minimum(legs[:-1], legs[1:])
    asked = np.abs(radii) * np.tan(0.5 * np.abs(turn))
    reach = np.where(np.isnan(radii), half, asked)
    return np.asarray(np.where(np.abs(turn) <= _STRAIGHT, 0.0, reach))


def _require_circles(
    sine: FloatArray,
    free: np.typing.NDArray[np.bool_],
    radii: FloatArray,
    chord: FloatArray,
    name: str,
) -> None:
    over = np.abs(sine) > np.where(free, 1.0 - 1e-15, 1.0 + _ROUNDING)
    if not over.any():
        return
    i = int(np.argmax(over))
    if free[i]:
        raise GeometryError(
            f"{name}: mean circle at interval {i} has |K| l/2 >= 1",
            "give a radius there, a knuckle, or a point between", {"interval": i},
        )  # fmt: skip
    raise GeometryError(
        f"{name}: radius {figure(radii[i])} smaller than half the chord {figure(0.5 * chord[i])} "
        f"at interval {i}",
        "give a larger one", {"radius": float(radii[i]), "interval": i},
    )  # fmt: skip


def _points(points: ArrayLike, name: str) -> FloatArray:
    given = finite(points, name, (None, 2))
    if len(given) < 2:
        what = f"{name}: expected shape (n >= 2, 2), got {given.shape}"
        raise GeometryError(what, "give two points or more", {"got": given.shape})
    same = np.flatnonzero((np.diff(given, axis=0) == 0.0).all(axis=1))
    if len(same):
        raise _coincident(name, int(same[0]), int(same[0]) + 1)
    return given


def _coincident(name: str, i: int, j: int) -> GeometryError:
    return GeometryError(
        f"{name}: coincident points {i},{j}", "leave one of them out", {"i": i, "j": j}
    )


def _kinds(kind: object, count: int, name: str) -> list[str]:
    found: list[Any] = [kind] * count if isinstance(kind, str) else []
    if _listed(kind):
        found = list(kind)
    bad = [each for each in found if shown(each) not in ("'line'", "'arc'")]
    if bad or len(found) != count:
        what = f"{name}: kind is {shown(kind)}"
        raise GeometryError(what, f'give "line" or "arc" for {count} interval(s)')
    return found


def _radii(radius: object, count: int, name: str) -> FloatArray:
    """Give radii, nan where there is none."""
    if radius is None:
        return np.full(count, np.nan)
    if not _listed(radius) or len(radius) != count:
        what = f"{name}: radius is {shown(radius)}"
        raise GeometryError(what, f"give a list of {count}, None where there is none")
    given = [each is not None for each in radius]
    found = np.full(count, np.nan)
    found[given] = finite([each for each in radius if each is not None], name, (None,))
    if (found == 0.0).any():
        index = int(np.argmax(found == 0.0))
        what = f"{name}: radius 0 at interval {index}"
        raise GeometryError(what, "leave it out, or give a knuckle", {"interval": index})
    return found


def _indices(knuckles: object, count: int, name: str) -> list[int]:
    found: list[Any] = [None]
    if _listed(knuckles) or isinstance(knuckles, set | frozenset):
        found = list(knuckles)
    if any(isinstance(k, bool) or not isinstance(k, int) or not 0 <= k < count for k in found):
        what = f"{name}: knuckles are {shown(knuckles)}"
        raise GeometryError(what, f"give indices of points, 0 to {count - 1}")
    return found


def _listed(value: object) -> TypeGuard[Sequence[Any]]:
    return isinstance(value, list | tuple) or (isinstance(value, np.ndarray) and value.ndim > 0)
