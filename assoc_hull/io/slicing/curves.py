"""Boundary curves drawn through marks: places that neighbouring lines show one by one."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import CurveData, FloatArray, PointKind, SplineBatch, freeze
from assoc_hull.geometry.polylines.borders import bends, fit_border
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import meet_planes
from assoc_hull.io.lines.slices import AXES
from assoc_hull.io.slicing.features import FeatureRules, PieceFeatures
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource

__all__ = ["Border", "Course", "draw", "loft_source", "meet"]

_OVER = 0.05
"""By which part of its last step a border is led on beyond its last mark."""

_SURE = 0.2
"""A border is adopted within this part of the doubt of its marks."""


@attrs.frozen(eq=False)
class Border:
    """A boundary curve made from what neighbouring lines show.

    Attributes
    ----------
    name : str
        Such as "flat of side" or "knuckle 1".
    kind : BoundaryKind
        FLAT or KNUCKLE.
    lines : tuple of str
        The lines whose marks it was drawn from, in order along it.
    places : (n, 3), m
        The curve at these marks.
    doubt : (n,), m
        How far each mark may lie off the border, 2 standard deviations.
    residual : float, m
        Largest distance of a mark from the curve.
    taken : int
        Tangent or knuckle points of lines that lie on it.
    """

    name: str
    kind: BoundaryKind
    lines: tuple[str, ...]
    places: FloatArray
    doubt: FloatArray
    residual: float
    taken: int = 0

    def __attrs_post_init__(self) -> None:
        freeze(self.places, self.doubt)


@attrs.frozen(eq=False)
class Course:
    """Marks in order along a border.

    Attributes
    ----------
    lines : tuple of str
        The lines they are on.
    places : (n, 3), m
        Where.
    doubt : (n,), m
        How far each may lie off the border.
    plane : ((3,), float) or None
        Unit normal and offset (m) of its plane, if it has one.
    """

    lines: tuple[str, ...]
    places: FloatArray
    doubt: FloatArray
    plane: tuple[FloatArray, float] | None

    def reversed(self) -> Course:
        """Give the marks the other way round."""
        return Course(
            self.lines[::-1], self.places[::-1].copy(), self.doubt[::-1].copy(), self.plane
        )


def draw(
    name: str, kind: BoundaryKind, course: Course, rules: FeatureRules, tolerance: float
) -> tuple[LineSource, Border]:
    """Draw a boundary curve through marks, from aft, as smooth as their doubt allows.

    Parameters
    ----------
    name, kind
        Of the curve.
    course : Course
        The marks.
    rules : FeatureRules
        With the turn at which it is split.
    tolerance : float, m
        How far the adopted curve may pass it, where it is not less sure itself.

    Returns
    -------
    LineSource, Border
        The source leads on beyond both ends by a little, so that the lines of the first and
        last mark cross it.
    """
    if course.places[0, 0] > course.places[-1, 0]:
        course = course.reversed()
    corners = bends(course.places, course.doubt, rules.border_deg)
    xyz = fit_border(course.places, course.doubt, corners)
    away = np.sqrt(((xyz - course.places) ** 2).sum(axis=1))
    before, after = xyz[0] - xyz[1], xyz[-1] - xyz[-2]
    whole = np.concatenate([[xyz[0] + _OVER * before], xyz, [xyz[-1] + _OVER * after]])
    kinds = np.full(len(whole), int(PointKind.SMOOTH))
    kinds[np.array(corners, np.int64) + 1] = int(PointKind.KNUCKLE)
    sure = np.maximum(tolerance, _SURE * course.doubt)
    source = LineSource.make(
        "boundary", name, _in_plane(whole, course.plane), plane=course.plane, boundary=kind,
        kind=kinds.tolist(), tolerance=np.concatenate([sure[:1], sure, sure[-1:]]),
    )  # fmt: skip
    return source, Border(name, kind, course.lines, xyz, course.doubt, float(away.max()))


def _in_plane(xyz: FloatArray, plane: tuple[FloatArray, float] | None) -> FloatArray:
    if plane is None:
        return xyz
    normal, offset = plane
    out = xyz + (offset - (xyz * normal).sum(axis=1))[:, None] * normal
    out[:, normal == 1.0] = offset
    return np.asarray(out)


def loft_source(source: LineSource) -> SplineBatch:
    """Loft a line through its own points."""
    return loft(
        CurveData(
            np.array([0, len(source.points)]), source.points, source.kind, source.direction,
            np.array([source.ends.kind], np.int8), np.array([source.ends.vector], np.float64),
        )
    )  # fmt: skip


def meet(spline: SplineBatch, part: PieceFeatures) -> FloatArray:
    """Give the places where a boundary curve crosses the plane of a piece, (k, 3), m."""
    normal = np.eye(3)[AXES[part.line.group]]
    return np.asarray(meet_planes(spline, normal, np.array([part.line.offset])).xyz)
