"""Curves through points are pulled through places: their defining points change least.

The shape depends on the points directly and through the chord-length parameters, so a place on the
curve is not linear in them. With the exact derivatives of the loft, Newton's method takes the
least step to what is asked and squares what is left of it, step by step. `pull_through` does it to
a curve of a hull within an open edit: only points that the designer may move are moved.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import all_of, instance, integer, number, place, places
from assoc_hull.edit.session import Edit
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.dual import Dual
from assoc_hull.geometry.numeric.polynomials import differentiate, horner
from assoc_hull.geometry.plane import AXES
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.loft_tangents import loft_tangents
from assoc_hull.geometry.splines.segments import locate_parameters, power_coefficients
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.links import free_axes
from assoc_hull.model.network import curve_data
from assoc_hull.model.objects import Curve, Point
from assoc_hull.model.tables import HullState
from assoc_hull.variation.direct.least_change import least_change

__all__ = [
    "HeldPlace",
    "PulledCurve",
    "all_free",
    "pass_places",
    "pass_through",
    "pull_through",
]

# What is held of a place is its segment and the fraction along it: a fraction of the whole length
# would slide.

_STEPS = 20
_DONE = 1e-13
"""Residual that may be left, as a part of the largest coordinate."""

_UNREACHED = 1e-9
"""A motion (relative) as small as this has no effect; without one, a distance (m) up to this may
be left."""


@attrs.frozen(eq=False)
class HeldPlace:
    """A place of a curve, and where it is to come to.

    Attributes
    ----------
    segment : int
        Between defining points `segment` and `segment + 1`.
    fraction : float
        Along the segment's chord-length parameter, 0 to 1.
    place : (3,), m
        Where it is to come to.
    """

    segment: int
    fraction: float
    place: FloatArray


@attrs.frozen(eq=False)
class PulledCurve:
    """Defining points that make a curve pass where it was asked.

    Attributes
    ----------
    xyz : (n, 3), m
        The points.
    residuals : tuple of float, m
        What was left before each step and after the last, at the worst place.
    """

    xyz: FloatArray
    residuals: tuple[float, ...]

    def __attrs_post_init__(self) -> None:
        freeze(self.xyz)


@attrs.frozen(eq=False)
class _Asked:
    """Equations at one stage: rows (k, m), residuals (k, 1), names, and the largest residual."""

    rows: FloatArray
    left: FloatArray
    names: list[str]
    largest: float


def all_free(data: CurveData, fixed: Sequence[int] = ()) -> FloatArray:
    """Give the freedom of points that may move anywhere, but for fixed ones, (m, n, 3).

    Raises
    ------
    BadInputError
        There is no such point.
    """
    count = len(data.xyz)
    stays = {integer(each, "fixed", "in pull", least=0, most=count - 1) for each in fixed}
    free = [i for i in range(count) if i not in stays]
    freedom = np.zeros((3 * len(free), count, 3))
    for column, point in enumerate(free):
        freedom[3 * column : 3 * column + 3, point] = np.eye(3)
    return freedom


def pass_through(
    data: CurveData, targets: Sequence[HeldPlace], freedom: FloatArray | None = None
) -> PulledCurve:
    """Move the defining points of a curve least, so that held places come where they are asked.

    Parameters
    ----------
    data : CurveData
        One curve of n points.
    targets : sequence of HeldPlace
        What is asked; a place that is asked to stay where it is pins the curve there.
    freedom : (m, n, 3) or None
        How the points may move: m unit motions, orthogonal to one another. Anywhere if None.

    Returns
    -------
    PulledCurve
        The points, and how Newton's method came to them.

    Raises
    ------
    BadInputError
        No such segment, two targets on one point, a place out of reach of what may move, or no
        solution near by.
    TooFewPointsError, CoincidentPointsError
        As for `assoc_hull.geometry.splines.loft.loft`.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.curves import CurveData
    >>> from assoc_hull.variation.direct.pull_curve_through import HeldPlace, pass_through
    >>> line = CurveData.single(np.array([[0.0, 0, 0], [1, 1, 0], [2, 0, 0]]))
    >>> passed = pass_through(line, [HeldPlace(0, 0.5, np.array([0.4, 0.8, 0.0]))])
    >>> passed.residuals[-1] < 1e-12
    True
    """
    _check(data, targets)
    segment = np.array([each.segment for each in targets], np.int64)
    fraction = np.array([each.fraction for each in targets])
    wanted = np.stack([each.place for each in targets])
    return _newton(data, wanted, freedom, (segment, fraction))


def pass_places(
    data: CurveData, wanted: FloatArray, freedom: FloatArray | None = None
) -> PulledCurve:
    """Move the defining points of a curve least, so that it passes through places anywhere on it.

    Unlike in `pass_through`, where on the curve a place comes to lie is free: only the distance
    of the curve from it counts.

    Parameters
    ----------
    data : CurveData
        One curve of n points.
    wanted : (k, 3), m
        The places.
    freedom : (m, n, 3) or None
        As for `pass_through`.

    Returns
    -------
    PulledCurve
        The points, and how Newton's method came to them.

    Raises
    ------
    BadInputError, TooFewPointsError, CoincidentPointsError
        As for `pass_through`.
    """
    return _newton(data, np.asarray(wanted, np.float64), freedom, None)


def _check(data: CurveData, targets: Sequence[HeldPlace]) -> None:
    if data.count != 1 or not len(targets):
        what = f"pull: {data.count} curves and {len(targets)} targets"
        raise BadInputError(what, "in pull", "give one curve, and a target or more")
    for each in targets:
        integer(each.segment, "segment", "in pull", least=0, most=len(data.xyz) - 2)
        place(each.place, "place", "in pull")
        if not 0.0 <= number(each.fraction, "fraction", "in pull") <= 1.0:
            what = f"fraction is {each.fraction:g}"
            raise BadInputError(what, "in pull", "give 0 to 1")


def _newton(
    data: CurveData,
    wanted: FloatArray,
    freedom: FloatArray | None,
    held: tuple[IntArray, FloatArray] | None,
) -> PulledCurve:
    """Step until nothing is left, or no step leaves less."""
    motions = all_free(data) if freedom is None else freedom
    done = _DONE * max(1.0, float(np.abs(data.xyz).max()))
    asked = _equations(data, wanted, motions, held)
    residuals = [asked.largest]
    for _ in range(_STEPS):
        if asked.largest <= done:
            return PulledCurve(data.xyz.copy(), tuple(residuals))
        step = least_change(asked.rows, asked.left, labels=asked.names)
        moved = np.tensordot(step[:, 0], motions, axes=1)
        factor, after = 1.0, asked
        while factor > 1e-3:
            trial = attrs.evolve(data, xyz=data.xyz + factor * moved)
            after = _equations(trial, wanted, motions, held)
            if after.largest < asked.largest:
                break
            factor *= 0.5
        else:
            break
        data, asked = trial, after
        residuals.append(asked.largest)
    if asked.largest <= 1e3 * done:
        return PulledCurve(data.xyz.copy(), tuple(residuals))
    raise BadInputError(
        f"pull: {asked.largest:.3g} m left after {len(residuals) - 1} steps", "in pull",
        "ask for less at once, or free more points",
    )  # fmt: skip


def _equations(
    data: CurveData,
    wanted: FloatArray,
    motions: FloatArray,
    held: tuple[IntArray, FloatArray] | None,
) -> _Asked:
    """Set up the equations for the motions, without those that no motion changes."""
    if held is None:
        spline = loft(data)
        at = closest_points(spline, 0, wanted)[0]
        segment, fraction = locate_parameters(spline, np.zeros(len(at), np.int64), at)
    else:
        segment, fraction = held
    reached, along = _places(data, motions, segment, fraction)
    left = wanted - reached.value
    # held places need all three coordinates, others only what lies across the tangent
    axes = np.tile(np.eye(3), (len(wanted), 1, 1)) if held else _across(along)
    rows, right, names = [], [], []
    for i, frame in enumerate(axes):
        name = f"({wanted[i, 0]:g}, {wanted[i, 1]:g}, {wanted[i, 2]:g})"
        own, rest = _reachable(frame @ reached.dot[:, i].T, frame @ left[i], name)
        rows.append(own)
        right.append(rest)
        names += [name] * len(own)
    largest = max(float(np.sqrt(rest @ rest)) for rest in right)
    return _Asked(np.concatenate(rows), np.concatenate(right)[:, None], names, largest)


def _places(
    data: CurveData, motions: FloatArray, segment: IntArray, fraction: FloatArray
) -> tuple[Dual, FloatArray]:
    """Give places (k, 3) with their derivatives by the motions, and unit tangents (k, 3)."""
    cubics = power_coefficients(loft_tangents(data, motions).batch())[segment]
    reached = horner(cubics, fraction[:, None])[:, 0]
    slope = horner(differentiate(cubics), fraction[:, None])[:, 0]
    assert isinstance(reached, Dual)
    assert isinstance(slope, Dual)
    return reached, slope.value / np.sqrt((slope.value**2).sum(axis=1))[:, None]


def _across(along: FloatArray) -> FloatArray:
    """Give two unit vectors across each tangent, (k, 2, 3)."""
    least = np.eye(3)[np.abs(along).argmin(axis=1)]
    first = np.cross(along, least)
    first /= np.sqrt((first**2).sum(axis=1))[:, None]
    return np.stack([first, np.cross(along, first)], axis=1)


def _reachable(rows: FloatArray, left: FloatArray, name: str) -> tuple[FloatArray, FloatArray]:
    """Turn the equations of one target so that those that nothing changes can be left out."""
    turn, value, _ = np.linalg.svd(rows, full_matrices=True)
    value = np.pad(value, (0, len(rows) - len(value)))
    kept = value > _UNREACHED * max(1.0, float(value.max()))
    rest = turn.T @ left
    if np.abs(rest[~kept]).max(initial=0.0) > _UNREACHED:
        raise BadInputError(
            f"pull: {np.abs(rest[~kept]).max():.3g} m that no point can move", f"at {name}",
            "give a place in the plane of the curve, or free more points",
        )  # fmt: skip
    return (turn.T @ rows)[kept], rest[kept]


# --------------------------------------------------------------------------------------
# The curve of a hull: shared crossings and placed points may move, each along its freedom. Driven
# points stay, adopted ones that have to move become placed.

_MOVED = 1e-12
"""A point moved by less (m) is left alone."""


def pull_through(
    edit: Edit,
    curve: Curve,
    targets: ArrayLike,
    *,
    pins: ArrayLike | None = None,
    fixed: Sequence[Point] = (),
) -> tuple[Point, ...]:
    """Make a curve pass through places, with the least change of its defining points.

    Parameters
    ----------
    edit : Edit
        An open edit.
    curve : Curve
        The curve.
    targets : (k, 3), m
        Places that it is to pass through.
    pins : (p, 3) or None, m
        Places on the curve that it is to keep passing through.
    fixed : sequence of Point
        Points that stay; ends of the curve, for instance.

    Returns
    -------
    tuple of Point
        The points that move, in order along the curve.

    Raises
    ------
    BadInputError
        A place off the plane of the curve, two on one point, or no point that may move.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.variation.direct.pull_curve_through import pull_through
    >>> hull = ah.examples.wigley()
    >>> with hull.edit("a little fuller") as edit:
    ...     moved = pull_through(edit, hull.find("WL 2.5").curves[0], [[52.0, 3.25, 2.5]])
    >>> round(hull.half_breadth(52.0, 2.5), 9)
    3.25
    """
    own = instance(curve, Curve, "curve", "in pull_through")
    state, number = own.tables, own.row
    wanted = places(targets, "targets", "in pull_through")
    if pins is not None:
        wanted = np.concatenate([wanted, places(pins, "pins", "in pull_through")])
    data = curve_data(state, np.array([number]))
    rows: list[int] = state.curves.rows[number].tolist()
    stays = {each.row for each in all_of(fixed, Point, "fixed", "in pull_through")}
    motions = _motions(state, [-1 if row in stays else row for row in rows])
    if not len(motions):
        raise BadInputError(
            "pull: no point that may move", f"on {own.name}", "free a point, or pull its driver"
        )
    xyz = pass_places(data, wanted, motions).xyz
    moved = np.flatnonzero(np.abs(xyz - data.xyz).max(axis=1) > _MOVED)
    handles = {point.row: point for point in own.defining}
    for i in moved.tolist():
        to = {axis: float(xyz[i, AXES.index(axis)]) for axis in free_axes(state, rows[i])}
        edit.move(handles[rows[i]], lead=False, **to)
    return tuple(handles[rows[i]] for i in moved.tolist())


def _motions(state: HullState, rows: Sequence[int]) -> FloatArray:
    """Give the unit motions (m, n, 3) of the points that may move; -1 stands for one that stays."""
    motions = []
    for i, row in enumerate(rows):
        for direction in _directions(state, row):
            motion = np.zeros((len(rows), 3))
            motion[i] = direction
            motions.append(motion)
    return np.array(motions).reshape(-1, len(rows), 3)


def _directions(state: HullState, row: int) -> FloatArray:
    """Give orthogonal unit directions in which a point may move, (f, 3)."""
    table = state.rows
    if row < 0 or (table.sort[row] == Sort.CROSSING and table.role[row] != Role.SHARED):
        return np.zeros((0, 3))
    lines = [state.line_of(curve) for curve in table.curve[row].tolist() if curve >= 0]
    normals = [state.lines.normal[line] for line in lines if state.lines.planar[line]]
    if not normals:
        return np.eye(3)
    # the normals of the planes span what is forbidden; the rest of a full basis is free

    _, value, right = np.linalg.svd(np.array(normals), full_matrices=True)
    free: FloatArray = right[int((value > 1e-9).sum()) :]
    return free
