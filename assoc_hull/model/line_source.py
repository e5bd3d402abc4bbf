"""Lines as they are handed in: arrays of points, before they become a net."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import choice, flag, instance, numbers, places, positive, shown, text
from assoc_hull.errors import BadInputError, TooFewPointsError
from assoc_hull.geometry.curves import CurveData, FloatArray, PointKind, freeze
from assoc_hull.geometry.plane import as_plane
from assoc_hull.model.kinds import FAMILIES, BoundaryKind, Sort
from assoc_hull.model.tables import Ends

__all__ = ["LineSource", "Origin", "line_curve_data"]

Origin = tuple[str, str] | Sort
"""What a defining point was in the net that it comes from: a crossing with a line, by group and
name, or a placed or adopted point."""


@attrs.frozen(eq=False)
class LineSource:
    """One curve of a line, as points.

    Attributes
    ----------
    group : str
        The group it belongs to, for instance ``"waterlines"``.
    name : str
        Name of the line; several sources of one name are the curves of one line.
    points : (n, 3), m
        In order along the curve: sections upward, other lines from aft forward.
    family : str
        Family of the group; the group's name by default.
    normal, offset : (3,), m, or None
        The plane of the line, normal . P = offset; for sections, waterlines and buttocks
        found from the points.
    boundary : BoundaryKind or None
        What a boundary curve does to the lines that meet it.
    kind : (n,) int8
        A `PointKind` per point.
    direction : (n, 3)
        Given directions at tangent points.
    ends : Ends
        End conditions.
    placed : bool
        Whether the points are the designer's own: they then define the curve, all of them,
        and no update moves them.
    tolerance : float or (n,)
        How far (m) the adopted curve may pass the points, all of them or each.
    dense : bool
        Whether the points draw the line closely, so that any of them may be adopted: then
        points are adopted in the middle of an interval, none in one without room.
    origin : tuple of Origin, or None
        Per point, what it was in the net that the line was written from. The points then define
        the curve, all of them and no others.
    """

    group: str
    name: str
    points: FloatArray
    family: str
    normal: FloatArray | None
    offset: float
    boundary: BoundaryKind | None
    kind: np.typing.NDArray[np.int8]
    direction: FloatArray
    ends: Ends
    placed: bool
    tolerance: float | FloatArray
    dense: bool = False
    origin: tuple[Origin, ...] | None = None

    @classmethod
    def make(
        cls,
        group: str,
        name: str,
        points: ArrayLike,
        *,
        family: str | None = None,
        plane: tuple[ArrayLike, float] | None = None,
        boundary: BoundaryKind | None = None,
        kind: Sequence[int] | None = None,
        direction: ArrayLike | None = None,
        ends: Ends | None = None,
        placed: bool = False,
        tolerance: float | FloatArray = 1e-3,
        dense: bool = False,
        origin: Sequence[Origin] | None = None,
    ) -> Self:
        """Check and complete what is given; arguments as the attributes of the class.

        Raises
        ------
        BadInputError
            Points that are not an (n, 3) array of finite numbers, an unknown family, or
            points that do not lie in one plane of the family.
        TooFewPointsError
            Fewer than two points.

        Examples
        --------
        >>> from assoc_hull.model.line_source import LineSource
        >>> LineSource.make("waterlines", "WL 1", [[0, 0, 1], [5, 2, 1], [9, 0, 1]]).offset
        1.0
        """
        where = f"{text(group, 'group', 'of a line')} {text(name, 'name', 'of a line')!r}"
        title = group if family is None else choice(family, "family", tuple(FAMILIES), where)
        if title not in FAMILIES:
            remedy = f"use one of {', '.join(FAMILIES)}"
            raise BadInputError(f"the family {title!r} is unknown", where, remedy)
        chosen = FAMILIES[title]
        xyz = _points(points, where)
        normal, offset = _plane(xyz, chosen.axis, plane, where)
        kinds, given = _kinds(kind, len(xyz), where), _directions(direction, len(xyz), where)
        if boundary is not None:
            boundary = BoundaryKind(instance(boundary, int, "boundary", where))
        freeze(xyz, kinds, given)
        if origin is not None:
            _one_each(np.empty(len(origin)), (len(xyz),), "origins", where)
        return cls(
            group, name, xyz, chosen.name, normal, offset, boundary, kinds, given,
            Ends() if ends is None else instance(ends, Ends, "ends", where),
            flag(placed, "placed", where), _tolerance(tolerance, len(xyz), where),
            flag(dense, "dense", where), None if origin is None else tuple(origin),
        )  # fmt: skip

    def scaled(self, factor: float, offset: float | None = None) -> LineSource:
        """Give the line with every length times a factor, in its plane at `offset` (m) exactly.

        Examples
        --------
        >>> from assoc_hull.model.line_source import LineSource
        >>> line = LineSource.make("waterlines", "WL 1", [[0, 0, 1], [5, 2, 1], [9, 0, 1]])
        >>> line.scaled(0.3, 0.3).points[1].tolist()
        [1.5, 0.6, 0.3]
        """
        points, place = factor * self.points, factor * self.offset
        if offset is not None and self.normal is not None and 1.0 in self.normal.tolist():
            # Scaled up and down again a place may have lost its last bit.
            points[:, self.normal == 1.0], place = offset, offset
        freeze(points)
        return attrs.evolve(self, points=points, offset=place, tolerance=factor * self.tolerance)


def line_curve_data(sources: Sequence[LineSource]) -> CurveData:
    """Give what a loft of lines through all their own points needs.

    Examples
    --------
    >>> from assoc_hull.geometry.splines.loft import loft
    >>> from assoc_hull.model.line_source import line_curve_data, LineSource
    >>> line = LineSource.make("waterlines", "WL 1", [[0, 0, 1], [5, 2, 1], [9, 0, 1]])
    >>> loft(line_curve_data([line])).count
    1
    """
    start = np.zeros(len(sources) + 1, np.int64)
    np.cumsum([len(source.points) for source in sources], out=start[1:])
    return CurveData(
        start,
        np.concatenate([source.points for source in sources]),
        np.concatenate([source.kind for source in sources]),
        np.concatenate([source.direction for source in sources]),
        np.array([source.ends.kind for source in sources], np.int8),
        np.array([source.ends.vector for source in sources], np.float64),
    )


def _tolerance(tolerance: ArrayLike, count: int, where: str) -> float | FloatArray:
    """Take one tolerance, or one a point, m, each above 0."""
    if not isinstance(tolerance, list | tuple | np.ndarray):
        return positive(tolerance, "tolerance", where)
    found = numbers(tolerance, "tolerance", where)
    if found.shape != (count,) or not (found > 0.0).all():
        raise BadInputError(
            f"tolerance has the shape {found.shape}", where, f"give {count} numbers above 0, m"
        )
    freeze(found)
    return found


def _kinds(kind: ArrayLike | None, count: int, where: str) -> np.typing.NDArray[np.int8]:
    """Take a `PointKind` per point; all smooth if None."""
    if kind is None:
        return np.zeros(count, np.int8)
    try:
        kinds = np.array(kind, np.float64)
    except (TypeError, ValueError, OverflowError):
        kinds = np.full(1, np.nan)
    if not np.isin(kinds, list(PointKind)).all():
        known = ", ".join(f"{each.name.lower()} {each.value}" for each in PointKind)
        raise BadInputError(f"kind is {shown(kind)}", where, f"give one of {known} per point")
    _one_each(kinds, (count,), "kinds", where)
    return kinds.astype(np.int8)


def _directions(direction: ArrayLike | None, count: int, where: str) -> FloatArray:
    """Take a direction per point; nil if None."""
    if direction is None:
        return np.zeros((count, 3))
    given = places(direction, "direction", where)
    _one_each(given, (count, 3), "directions", where)
    return given


def _one_each(given: FloatArray, shape: tuple[int, ...], what: str, where: str) -> None:
    if given.shape != shape:
        found = len(given) if given.ndim else 1
        raise BadInputError(f"{shape[0]} points have {found} {what}", where, "give one per point")


def _points(points: ArrayLike, where: str) -> FloatArray:
    try:
        xyz = np.array(points, np.float64) + 0.0
    except (TypeError, ValueError, OverflowError) as error:
        raise BadInputError("the points are not numbers", where, "give an (n, 3) array") from error
    if xyz.ndim != 2 or xyz.shape[1] != 3:
        raise BadInputError(f"the points have the shape {xyz.shape}", where, "give an (n, 3) array")
    if len(xyz) < 2:
        raise TooFewPointsError(where, len(xyz))
    bad = np.flatnonzero(~np.isfinite(xyz).all(axis=1))
    if len(bad):
        raise BadInputError(f"point {bad[0]} is not finite", where, "leave it out or mend it")
    return xyz


def _plane(
    xyz: FloatArray, axis: int | None, plane: tuple[ArrayLike, float] | None, where: str
) -> tuple[FloatArray | None, float]:
    """Find or check the plane of a line."""
    if plane is not None:
        given = as_plane(plane)
        normal, offset = np.array(given.normal), given.offset
        off = float(np.abs(xyz @ normal - offset).max())
    elif axis is not None:
        normal = np.eye(3)[axis]
        offset = float(xyz[0, axis])
        off = float(np.abs(xyz[:, axis] - offset).max())
    else:
        return None, float("nan")
    if off > 1e-9:
        raise BadInputError(
            f"a point lies {off:.3g} m off the plane at {offset:g} m", where, "put it in the plane"
        )
    return normal, offset
