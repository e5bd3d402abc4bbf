"""Where thinned curves pass what was given too far off, and which given point would mend it.

Three faults are looked for: a given point farther off than the tolerance, a watched gap between two
densely drawn lines, and chords of a dense line that would fold. Parameters are those (m) of the
lines as given. `ThinningState` has what was given, `CurveItem` one defining point of a trial.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from assoc_hull.edit.adoption.match_crossings import LineIntersection
from assoc_hull.edit.adoption.thinning_state import (
    CurveItem,
    OmittedPoint,
    ReferenceNet,
    ThinningState,
    knots_of,
    thinned_at,
)
from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.splines.distance import closest_points_each
from assoc_hull.geometry.splines.segments import derivative
from assoc_hull.model.gaps import crossing_normals
from assoc_hull.model.kinds import Role

__all__ = [
    "chord_cosines",
    "distances",
    "find_wide",
    "find_worst",
    "has_room",
    "point_amid_interval",
    "point_near",
    "sharp_turn",
    "wide_gaps",
]

# --------------------------------------------------------------------------------------
# Dense lines. A digitised line has many more points than should define a curve. Taken where the
# curve passes them worst, they would come to lie in close pairs; so one is taken from the middle
# of the interval in question, and none where the interval is short.

BoolArray = np.typing.NDArray[np.bool_]

_FOLD = 0.2
"""Chords whose directions have a smaller cosine are taken for a fold."""

_SHORTEST = 0.02
"""Times `Tolerances.factor`: no point is set in an interval shorter than this (m)."""


def has_room(edges: FloatArray, at: FloatArray, spacing: float) -> BoolArray:
    """Tell which given points, at (n,) m, lie in an interval that has room for another point.

    `edges` (k,), m, are the parameters of the defining points, ascending; `spacing` (m) is the
    least length of an interval.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.edit.adoption.thinned_deviations import has_room
    >>> has_room(np.array([0.0, 0.1, 5.0]), np.array([0.05, 2.0]), 0.2).tolist()
    [False, True]
    """
    number = np.searchsorted(edges, at).clip(1, len(edges) - 1)
    return np.asarray(edges[number] - edges[number - 1] >= spacing)


def chord_cosines(xyz: FloatArray) -> FloatArray:
    """Give the cosines between neighbouring chords through places (n, 3), (n - 2,)."""
    step = np.diff(xyz, axis=0)
    step = step / np.maximum(np.linalg.norm(step, axis=1), 1e-12)[:, None]
    return np.asarray((step[1:] * step[:-1]).sum(axis=1))


def sharp_turn(
    known: FloatArray, edges: FloatArray, at: FloatArray, knuckle: BoolArray, factor: float = 1.0
) -> int:
    """Give a given point, at (n,) m, beside a smooth place where the chords fold; -1 if none do.

    `known` (k, 3) and `edges` (k,), m, are the defining points and their parameters; those at a
    `knuckle` (k,) may turn as they like. `factor` is that of the tolerances of the hull.
    """
    cosine = chord_cosines(known)
    for i in np.flatnonzero((cosine < _FOLD) & ~knuckle[1:-1]).tolist():
        wide = i if edges[i + 1] - edges[i] > edges[i + 2] - edges[i + 1] else i + 1
        low, high = float(edges[wide]), float(edges[wide + 1])
        inside = _inside(at, low, high)
        if len(inside) and high - low > factor * _SHORTEST:
            return int(inside[len(inside) // 2])
    return -1


def point_amid_interval(edges: FloatArray, at: FloatArray, point: int) -> tuple[int, float, float]:
    """Give a given point for the interval of one, `point`, that is passed badly.

    That is the one nearest to it in the middle part of the interval. Also given are `target` and
    `reach`, m: where a point is wanted, and how near to it a crossing will do as well.
    """
    here = float(at[point])
    low = float(edges[edges <= here].max(initial=-np.inf))
    high = float(edges[edges >= here].min(initial=np.inf))
    low, high = (here if not np.isfinite(end) else end for end in (low, high))
    target = min(max(here, low + 0.3 * (high - low)), high - 0.3 * (high - low))
    inside = _inside(at, low, high)
    if len(inside):
        point = int(inside[np.argmin(np.abs(at[inside] - target))])
    return point, target, 0.2 * (high - low)


def point_near(edges: FloatArray, at: FloatArray, place: float, spacing: float) -> int:
    """Give a given point by which a curve can be held at a place; -1 if there is no room.

    Arguments as of `has_room`; `place` is the parameter of the place, m.
    """
    above = int(np.searchsorted(edges, place).clip(1, len(edges) - 1))
    low, high = float(edges[above - 1]), float(edges[above])
    inside = _inside(at, low, high)
    if high - low < spacing or not len(inside):
        return -1
    return int(inside[np.argmin(np.abs(at[inside] - place))])


def _inside(at: FloatArray, low: float, high: float) -> np.typing.NDArray[np.int64]:
    """Give the given points in the middle half of an interval."""
    quarter = 0.25 * (high - low)
    return np.flatnonzero((at > low + quarter) & (at < high - quarter))


# --------------------------------------------------------------------------------------
# Watched gaps. Two densely drawn lines that meet may each keep within its tolerance, one on this
# side and one on the other; the gap between them is then twice as large.


def wide_gaps(
    reference: SplineBatch, trial: SplineBatch, meetings: Sequence[LineIntersection], limit: float
) -> list[tuple[int, float]]:
    """Find the curves that need another point because of gaps over a limit (m), the widest first.

    `reference` are the lines as given, `trial` the curves as thinned so far, `meetings` crossings
    that define neither curve. Gives curves with the parameter of the crossing on their reference;
    the curve that passes its own line farther off comes first, the other of the pair after it.
    """
    if not meetings:
        return []
    curve, at, normal = _places(reference, meetings)
    off = _off(trial, meetings, normal)
    apart = np.array([float((each.spots[0] - each.spots[1]) @ n)
                      for each, n in zip(meetings, normal, strict=True)])  # fmt: skip
    gap = np.abs(off[:, 0] - off[:, 1] + apart)
    found: list[tuple[int, float]] = []
    for i in np.argsort(-gap, kind="stable")[: int((gap > limit).sum())].tolist():
        first = int(abs(off[i, 1]) >= abs(off[i, 0]))
        found += [(int(curve[i, j]), float(at[i, j])) for j in (first, 1 - first)]
    return found


def _places(
    reference: SplineBatch, meetings: Sequence[LineIntersection]
) -> tuple[IntArray, FloatArray, FloatArray]:
    """Give curves and parameters, (k, 2), and normals of the hull, (k, 3), of meetings."""
    curve = np.array([[each.a, each.b] for each in meetings])
    at = np.array([each.at for each in meetings])
    one, other = (_tangents(reference, curve[:, i], at[:, i]) for i in (0, 1))
    return curve, at, crossing_normals(one, other)


def _tangents(reference: SplineBatch, curve: IntArray, at: FloatArray) -> FloatArray:
    slope = derivative(reference, curve, at)
    return np.asarray(slope / np.sqrt((slope * slope).sum(axis=1))[:, None])


def _off(
    trial: SplineBatch, meetings: Sequence[LineIntersection], normal: FloatArray
) -> FloatArray:
    """Give how far each of the two curves lies off its own line along the normal, (k, 2), m."""
    sides = [[each.a, each.b] for each in meetings]
    spots = np.array([each.spots for each in meetings]).reshape(-1, 3)
    foot = closest_points_each(trial, np.array(sides, np.int64).ravel(), spots)[1]
    away = (foot - spots).reshape(-1, 2, 3)
    return np.asarray((away * normal[:, None]).sum(axis=2))


# --------------------------------------------------------------------------------------
# Where thinned curves pass what was given too far off.

_GAP = 0.4
"""Densely drawn curves are held so that watched gaps keep below this part of the tolerance."""


def find_worst(
    net: ReferenceNet, splines: SplineBatch, orders: list[list[CurveItem]], work: ThinningState
) -> tuple[list[tuple[int, int]], list[OmittedPoint]]:
    """Give, per curve that passes given points too far off, the worst one to be taken in.

    Also given are the points that cannot be: beside a point that defines the curve already a
    second one would only make it turn.
    """
    found: list[tuple[int, int]] = []
    left: list[OmittedPoint] = []
    numbers = [[item.number for item in order] for order in orders]
    # a curve made through the same points as when it held its line holds it still
    todo = [i for i, order in enumerate(numbers) if work.held.get(i) != order]
    measured = distances(work, todo, [orders[i] for i in todo], splines, todo)
    for curve, (away, beside) in zip(todo, measured, strict=True):
        source = net.sources[curve]
        for point in np.flatnonzero(away > source.tolerance).tolist():
            close = beside[point] < net.state.tolerances.adopted_spacing
            # `distances` has looked at the room on dense lines; a crossing there can be let in.
            if close and not source.dense and thinned_at(work, curve, point) is None:
                left.append(OmittedPoint(curve, point, float(away[point]), float(beside[point])))
                # Else it would hide the worst of those that can be taken in.
                away[point] = 0.0
        # In parts of the tolerance, which may differ from point to point.
        worst = int((away / source.tolerance).argmax())
        if not (away > source.tolerance).any():
            worst = _sharp(work, curve, orders[curve]) if source.dense else -1
        if worst >= 0:
            found.append((curve, worst))
        # Points that cannot be taken in are told of the last round only: it is measured again.
        elif not any(each.curve == curve for each in left):
            work.held[curve] = numbers[curve]
    return found, left


def find_wide(
    net: ReferenceNet,
    splines: SplineBatch,
    orders: list[list[CurveItem]],
    work: ThinningState,
    roles: list[Role],
) -> list[tuple[int, int]]:
    """Give, per curve, a given point to be taken in because a watched gap is wide."""
    watched = [
        meeting
        for meeting, role in zip(net.meetings, roles[len(net.contacts) :], strict=True)
        if role is Role.WATCHED and net.sources[meeting.a].dense and net.sources[meeting.b].dense
    ]
    found = iter(wide_gaps(net.reference, splines, watched, _GAP * net.state.tolerances.adoption))
    return _points_with_room(work, orders, zip(found, found, strict=True))


def _points_with_room(
    work: ThinningState,
    orders: list[list[CurveItem]],
    places: Iterable[tuple[tuple[int, float], ...]],
) -> list[tuple[int, int]]:
    """Give a given point for the first curve of each place that has room; one per curve."""
    found: dict[int, int] = {}
    for choice in places:
        for curve, at in choice:
            edges = np.array([item.at for item in orders[curve]])
            spacing = work.net.state.tolerances.adopted_spacing
            point = point_near(edges, knots_of(work, curve), at, spacing)
            if point >= 0:
                found.setdefault(curve, point)
                break
    return sorted(found.items())


def distances(
    work: ThinningState,
    curves: Sequence[int],
    orders: Sequence[list[CurveItem]],
    splines: SplineBatch,
    numbers: Sequence[int],
) -> list[tuple[FloatArray, FloatArray]]:
    """Give, per curve, distances (n,), m, of its given points from it and from defining points.

    `orders` are what defines each of the m curves, `numbers` (m,) which curves of `splines` they
    are. The first distance is zero at a defining point; of a dense line, also where there is no
    room for one more.
    """
    pairs = list(zip(curves, orders, strict=True))
    measured = [_beside(work, curve, order) for curve, order in pairs]
    asked = [
        work.net.sources[curve].points[there]
        for curve, (there, _) in zip(curves, measured, strict=True)
    ]
    sizes = [len(points) for points in asked]
    off = closest_points_each(
        splines,
        np.repeat(np.array(numbers, np.int64), sizes),
        np.concatenate([np.zeros((0, 3)), *asked]),
    )[2]
    found, begin = [], 0
    for (curve, order), (there, beside) in zip(pairs, measured, strict=True):
        away = np.zeros(len(beside))
        away[there] = off[begin : begin + len(there)]
        begin += len(there)
        _close_off(work, curve, order, away)
        found.append((away, beside))
    return found


def _beside(work: ThinningState, curve: int, order: list[CurveItem]) -> tuple[IntArray, FloatArray]:
    """Find the given points that do not define a curve, and how far all are from defining ones.

    The distances are (n,), m.
    """
    known = work.given.xyz[work.numbers(order)]
    step = work.net.sources[curve].points[:, None, :] - known[None, :, :]
    there = np.flatnonzero(np.abs(step).max(axis=2).min(axis=1) > work.same_place)
    return there, np.sqrt((step * step).sum(axis=2)).min(axis=1)


def _close_off(work: ThinningState, curve: int, order: list[CurveItem], away: FloatArray) -> None:
    """Set the distance of points of a dense line to zero where there is no room for one more."""
    if work.net.sources[curve].dense:
        edges = np.array([item.at for item in order])
        spacing = work.net.state.tolerances.adopted_spacing
        away[~has_room(edges, knots_of(work, curve), spacing)] = 0.0


def _sharp(work: ThinningState, curve: int, order: list[CurveItem]) -> int:
    """Give a given point where the chords of a dense line would fold; -1 if nowhere."""
    edges = np.array([item.at for item in order])
    numbers = work.numbers(order)
    kind, _ = work.given.on(np.array(curve), numbers)
    known = work.given.xyz[numbers]
    corner, factor = kind == PointKind.KNUCKLE, work.net.state.tolerances.factor
    return sharp_turn(known, edges, knots_of(work, curve), corner, factor)
