"""Points, crossings, curves, lines, groups and features as a designer sees them.

Each is a handle: it holds no geometry, knows the tables of its hull and the number of its
object, looks everything up when asked, and gives out frozen values. Two handles on one object
are equal; a handle whose object has gone says so. The two friend points of a crossing are
handles on one row of the table of points, so they cannot disagree.

Reference: Choi & Lee, "A Study on the Hull Form Design System on the Basis of the
Associative Geometry Objects", J. SNAK 36(4), 1999.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import ItemsView, Iterator, Mapping, Sequence, ValuesView
from typing import ClassVar, Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import instance, integer, numbers, word
from assoc_hull.arguments import place as one_place
from assoc_hull.errors import BadInputError, ForeignPointError, UnknownNameError
from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind, SplineBatch, freeze
from assoc_hull.geometry.plane import Plane, as_plane
from assoc_hull.geometry.splines.arc_length import arc_length
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.plane_intersections import on_plane, points_on_plane
from assoc_hull.geometry.splines.segments import curvature, evaluate, sample
from assoc_hull.model.address import AddressBook, ResolvedAddress, resolve_address
from assoc_hull.model.dirty_cause import DirtyCause, cause_of
from assoc_hull.model.feature_geometry import line_numbers
from assoc_hull.model.features import Feature, Place
from assoc_hull.model.gaps import tangents
from assoc_hull.model.kinds import OWN, BoundaryKind, Role, Sort, State
from assoc_hull.model.links import (
    crossing_ways,
    defines,
    free_axes,
    generates_on,
    holders,
    latent_curves,
    live_group,
    named_lines,
    point_positions,
    points_on,
)
from assoc_hull.model.named_mapping import NamedMapping
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState

__all__ = [
    "Crossing",
    "Curve",
    "FeatureHandle",
    "GeneratedPoints",
    "Group",
    "Handle",
    "Line",
    "Point",
    "Points",
    "features_by_name",
    "handle",
    "is_in",
    "numbers_of",
]


def _home(tables: HullState) -> HullState:
    """Give the tables that live on when those of a published state are past."""
    return instance(tables, HullState, "tables", "in a handle").live_tables


@attrs.frozen(repr=False)
class Handle:
    """A handle on one object of a hull.

    Attributes
    ----------
    home : HullState
        The tables of the hull, those that are written to.
    number : int
        Row of the object in its table.
    id : str
        Key of the object; it outlives renaming and shifting.
    """

    _table: ClassVar[str]
    home: HullState = attrs.field(alias="tables", converter=_home)
    number: int
    id: str

    def __attrs_post_init__(self) -> None:
        if not isinstance(self.number, int):
            integer(self.number, "number", "in a handle", least=0)
        word(self.id, "id", "in a handle")

    @classmethod
    def of(cls, tables: HullState, number: int) -> Self:
        """Give the handle on a row of the table."""
        table = getattr(instance(tables, HullState, "tables", "in a handle"), cls._table)
        integer(number, "number", "in a handle", least=0, most=table.count - 1)
        column = table.name if cls._table == "groups" else table.key
        return cls(tables, int(number), column.data[int(number)])

    @property
    def tables(self) -> HullState:
        """The published tables; for an open edit, of what it has made itself, those it writes."""
        found = self.home.published()
        return found if is_in(self, found) else self.home.seen_here()

    @property
    def alive(self) -> bool:
        """Whether the object is still there."""
        return is_in(self, self.tables)

    @property
    def row(self) -> int:
        """The number of the object, which is checked to be alive.

        Raises
        ------
        ForeignPointError
            It has gone.
        """
        return self._here()[1]

    @property
    def container(self) -> Handle | None:
        """What it is a part of; None for the outermost."""
        return None

    @property
    def holders(self) -> tuple[Group, ...]:
        """The groups of a designer's own that hold it, by name."""
        tables, row = self._here()
        if self._table not in ("lines", "groups"):
            return ()
        name = tables.groups.name[row] if self._table == "groups" else self.id
        return tuple(Group.of(tables, group) for group in holders(tables, name).tolist())

    def _here(self) -> tuple[HullState, int]:
        """Give tables and `row`, for all that one call reads: another thread may commit meanwhile.

        Raises
        ------
        ForeignPointError
            It has gone.
        """
        tables = self.tables
        if not is_in(self, tables):
            raise ForeignPointError(f"{type(self).__name__.lower()} {self.id!r}")
        return tables, self.number

    def __repr__(self) -> str:
        try:
            name = getattr(self, "name", self.id)
        except ForeignPointError:
            name = f"{self.id}, gone"
        return f"<{type(self).__name__} {name}>"


def is_in(handle: Handle, tables: HullState) -> bool:
    """Tell whether an object is there in tables of its hull."""
    table, number = getattr(tables, handle._table), handle.number
    if number >= table.count or not table.alive[number]:
        return False
    return handle._table == "groups" or bool(table.key[number] == handle.id)


def _dirty(handle: Handle, node: int) -> DirtyCause | None:
    """Give because of what a node of whoever edits here is dirty."""
    return cause_of(handle.home.seen_here(), handle.home.dirty_here(), node)


# --------------------------------------------------------------------------------------
# Points and crossings.


def _curve(tables: HullState, number: int) -> Curve:
    return Curve.of(tables, number)


def _handles(tables: HullState, rows: IntArray, sides: IntArray) -> tuple[Point, ...]:
    keys = tables.rows.key.data.for_looks(len(rows))
    places = zip(rows.tolist(), sides.tolist(), strict=True)
    return tuple(Point(tables, row, keys[row], side) for row, side in places)


def _points_along(tables: HullState, curve: int) -> tuple[Point, ...]:
    on = points_on(tables, curve)
    return _handles(tables, on.row, on.side)


@attrs.frozen(repr=False)
class Point(Handle):
    """A point on one curve; a crossing is two of these, each the other's friend.

    Attributes
    ----------
    side : int
        Whether the curve is the crossing's a (0) or b (1).

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.objects import Line
    >>> line = Line.of(wigley(), 3)
    >>> line.curves[0].points[1].free
    ('y',)
    """

    _table: ClassVar[str] = "rows"
    side: int = 0

    @property
    def name(self) -> str:
        """The label that was given, else the address, for instance ``WL 0.5 x ST 7``."""
        tables, row = self._here()
        label = tables.rows.label[row]
        return str(label) if label else AddressBook(tables).address(row, self.side)

    @property
    def position(self) -> FloatArray:
        """The place, (3,), m; frozen."""
        tables, row = self._here()
        found: FloatArray = point_positions(tables, np.array([row]), np.array([self.side]))[0]
        freeze(found)
        return found

    @property
    def x(self) -> float:
        """Coordinate forward from the after perpendicular, m."""
        return float(self.position[0])

    @property
    def y(self) -> float:
        """Coordinate to port from the centre plane, m."""
        return float(self.position[1])

    @property
    def z(self) -> float:
        """Coordinate up from the base line, m."""
        return float(self.position[2])

    @property
    def kind(self) -> str:
        """How its curve passes: ``"smooth"``, ``"tangent"`` or ``"knuckle"``."""
        tables, row = self._here()
        return PointKind(int(tables.rows.kind[row, self.side])).name.lower()

    @property
    def sort(self) -> str:
        """``"crossing"``, ``"placed"`` or ``"adopted"``."""
        tables, row = self._here()
        return Sort(int(tables.rows.sort[row])).name.lower()

    @property
    def role(self) -> str:
        """``"defining"`` if its curve is made through it, else ``"derived"``."""
        tables, row = self._here()
        return "defining" if defines(tables, row, self.side) else "derived"

    @property
    def crossing_role(self) -> str | None:
        """``"shared"``, ``"drives a"``, ``"drives b"`` or ``"watched"``; None if no crossing."""
        tables, row = self._here()
        if tables.rows.sort[row] != Sort.CROSSING:
            return None
        return Role(int(tables.rows.role[row])).text

    @property
    def crossing(self) -> Crossing | None:
        """The crossing this point belongs to, if it does."""
        tables, row = self._here()
        if tables.rows.sort[row] != Sort.CROSSING:
            return None
        return Crossing(tables, row, self.id)

    @property
    def container(self) -> Curve:
        """The curve it lies on."""
        return self.container_curve

    @property
    def container_curve(self) -> Curve:
        """The curve it lies on."""
        tables, row = self._here()
        return _curve(tables, int(tables.rows.curve[row, self.side]))

    @property
    def parent_curve(self) -> Curve | None:
        """The curve that generated it; None for a placed or adopted point."""
        tables, row = self._here()
        parent = int(tables.rows.curve[row, 1 - self.side])
        return None if parent < 0 else _curve(tables, parent)

    @property
    def friend_point(self) -> Point | None:
        """The same crossing on the parent curve; None for a placed or adopted point."""
        tables, row = self._here()
        if tables.rows.curve[row, 1 - self.side] < 0:
            return None
        return Point(tables, row, self.id, 1 - self.side)

    @property
    def free(self) -> tuple[str, ...]:
        """Coordinates along which it may move; an edit gives exactly these."""
        tables, row = self._here()
        return free_axes(tables, row)

    @property
    def driver(self) -> Curve | None:
        """The curve it is computed from, if it is."""
        tables, row = self._here()
        driver = int(tables.rows.driver[row])
        return None if driver < 0 else _curve(self.tables, driver)

    @property
    def state(self) -> str:
        """``"clean"``, ``"failed"`` or ``"blocked"``."""
        tables, row = self._here()
        return State(int(tables.rows.state[row])).name.lower()

    @property
    def dirty(self) -> DirtyCause | None:
        """Because of what it is dirty: reached by what the open edit asked for; None if clean."""
        return _dirty(self, Node.point(self.number))

    @property
    def revision(self) -> int:
        """Rises by one each time it really moved."""
        tables, row = self._here()
        return tables.revision_row.get(row, 0)


@attrs.frozen(repr=False)
class Crossing(Handle):
    """One intersection of two associated curves: one value that both read."""

    _table: ClassVar[str] = "rows"

    @property
    def name(self) -> str:
        """Its address, the line of higher rank first."""
        tables, row = self._here()
        return AddressBook(tables).address(row)

    @property
    def points(self) -> tuple[Point, Point]:
        """The friend points on curve a and on curve b."""
        tables, row = self._here()
        first, second = (Point(tables, row, self.id, side) for side in (0, 1))
        return first, second

    @property
    def a(self) -> Curve:
        """The curve of lower rank."""
        return self._curve(0)

    @property
    def b(self) -> Curve:
        """The curve of higher rank."""
        return self._curve(1)

    def _curve(self, side: int) -> Curve:
        tables, row = self._here()
        return _curve(tables, int(tables.rows.curve[row, side]))

    @property
    def role(self) -> str:
        """``"shared"``, ``"drives a"``, ``"drives b"`` or ``"watched"``."""
        tables, row = self._here()
        return Role(int(tables.rows.role[row])).text

    @property
    def override(self) -> str | None:
        """The role the designer gave it in place of the rule's, if so."""
        tables, row = self._here()
        role = int(tables.rows.override[row])
        return None if role < 0 else Role(role).text

    @property
    def sign(self) -> int:
        """+1 where a passes to the positive side of b's plane, else -1; 0 if neither."""
        tables, row = self._here()
        return int(tables.rows.sign[row])

    @property
    def birth(self) -> int:
        """Number of its birth for this pair of lines, from 1."""
        tables, row = self._here()
        return int(tables.rows.birth[row])

    @property
    def gap(self) -> float | None:
        """How far its curves pass each other along the hull's normal (m), if it is watched."""
        return self._length("gap")

    @property
    def limit(self) -> float | None:
        """The largest gap it may have (m), if it is watched."""
        return self._length("limit")

    def _length(self, column: str) -> float | None:
        tables, row = self._here()
        if tables.rows.role[row] != Role.WATCHED:
            return None
        value = float(getattr(tables.rows, column).data[row])
        return value if np.isfinite(value) else None

    @property
    def dirty(self) -> DirtyCause | None:
        """Because of what it is dirty: reached by what the open edit asked for; None if clean."""
        return _dirty(self, Node.point(self.number))

    @property
    def state(self) -> str:
        """``"clean"``, ``"failed"`` or ``"blocked"``."""
        tables, row = self._here()
        return State(int(tables.rows.state[row])).name.lower()


# --------------------------------------------------------------------------------------
# Curves, and what a curve generates on others.


@attrs.frozen
class GeneratedPoints:
    """What a curve generates on others.

    Attributes
    ----------
    actual : tuple of Point
        The points it has generated on other curves.
    latent : tuple of Curve
        The curves it may come to meet.
    """

    actual: tuple[Point, ...]
    latent: tuple[Curve, ...]


@attrs.frozen(repr=False)
class Curve(Handle):
    """One connected curve of a line.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.objects import Line
    >>> line = Line.of(wigley(), 3)
    >>> line.curves[0].at(0.0)
    array([10.,  0.,  0.])
    """

    _table: ClassVar[str] = "curves"

    @property
    def name(self) -> str:
        """The name of its line, with a number if it is one of several."""
        tables, row = self._here()
        return AddressBook(tables).curve_name(row)

    @property
    def line(self) -> Line:
        """The line it belongs to."""
        tables, row = self._here()
        return Line.of(tables, tables.line_of(row))

    @property
    def container(self) -> Line:
        """The line it belongs to."""
        return self.line

    @property
    def points(self) -> tuple[Point, ...]:
        """All its points in order along it, those that define it and those that lie on it."""
        return _points_along(*self._here())

    @property
    def defining(self) -> tuple[Point, ...]:
        """The points it is made through, in order."""
        tables, row = self._here()
        rows, side = (getattr(tables.curves, name).data[row] for name in ("rows", "side"))
        return _handles(tables, rows, side)

    @property
    def touch_objects(self) -> GeneratedPoints:
        """The points it has generated on other curves, and the curves it may come to meet."""
        tables, row = self._here()
        # a one-way association generates points on the lines of the other group only
        reach = generates_on(tables, int(tables.lines.group[tables.line_of(row)]))
        on = points_on(tables, row)
        there = tables.rows.curve.data[on.row, 1 - on.side]
        line = tables.curves.line.data[there]
        met = (there >= 0) & np.isin(tables.lines.group.data[line], reach)
        if tables.rulings:
            met = there >= 0
            met[met] = crossing_ways(tables, on.row[met])[np.arange(met.sum()), on.side[met]]
        actual = _handles(tables, on.row[met], 1 - on.side[met])
        latent = latent_curves(tables, row).tolist()
        return GeneratedPoints(actual, tuple(_curve(tables, curve) for curve in latent))

    @property
    def spline(self) -> SplineBatch:
        """The published spline, a batch of one."""
        tables, row = self._here()
        return tables.spline(row)

    @property
    def length(self) -> float:
        """Length along the curve, m."""
        return float(arc_length(self.spline)[0])

    @property
    def ends(self) -> FloatArray:
        """First and last point, (2, 3), m; frozen."""
        found = self.spline.xyz[[0, -1]]
        freeze(found)
        return found

    @property
    def span(self) -> float:
        """Largest chord parameter, m; the least is 0."""
        return float(self.spline.knot[-1])

    def at(self, t: ArrayLike) -> FloatArray:
        """Give the place at chord parameter t (m): (3,), or (k, 3) for k parameters."""
        many, one = self._parameters(t)
        return self._shaped(evaluate(self.spline, np.zeros(len(many), np.int64), many), one)

    def tangent(self, t: ArrayLike) -> FloatArray:
        """Give the unit tangent at chord parameter t (m): (3,) or (k, 3)."""
        many, one = self._parameters(t)
        tables, row = self._here()
        return self._shaped(tangents(tables, np.full(len(many), row), many), one)

    def curvature(self, t: ArrayLike) -> FloatArray:
        """Give the curvature vector at chord parameter t (m), 1/m: (3,) or (k, 3)."""
        many, one = self._parameters(t)
        place = np.zeros(len(many), np.int64), many
        return self._shaped(curvature(self.spline, at=place), one)

    def _parameters(self, t: object) -> tuple[FloatArray, bool]:
        """Take parameters as an array (k,), and tell whether a single number was given."""
        found = numbers(t, "t", f"on {self.name}")
        return np.atleast_1d(found), found.ndim == 0

    @staticmethod
    def _shaped(found: FloatArray, one: bool) -> FloatArray:
        out: FloatArray = np.array(found[0] if one else found)
        freeze(out)
        return out

    def closest(self, p: ArrayLike) -> tuple[float, FloatArray, float]:
        """Give parameter, place (3,) and distance of the point closest to p (3,), m."""
        place = one_place(p, "p", f"in closest of {self.name}")
        t, xyz, distance = closest_points(self.spline, 0, place[None])
        return float(t[0]), xyz[0], float(distance[0])

    def meet(self, plane: Plane | tuple[ArrayLike, float]) -> FloatArray:
        """Give the places where it meets a plane, (k, 3), m, in order along it; as `Line.meet`."""
        tables, row = self._here()
        return _met(tables, [row], as_plane(plane))

    def polyline(self, per_segment: int = 8) -> FloatArray:
        """Give places along the curve for drawing, (n, 3), m; frozen."""
        where = f"in polyline of {self.name}"
        return sample(self.spline, integer(per_segment, "per_segment", where, least=1, most=1000))[
            1
        ]

    @property
    def state(self) -> str:
        """``"clean"``, ``"failed"`` or ``"blocked"``."""
        tables, row = self._here()
        return State(int(tables.curves.state[row])).name.lower()

    @property
    def dirty(self) -> DirtyCause | None:
        """Because of what it is dirty: reached by what the open edit asked for; None if clean."""
        return _dirty(self, Node.curve(self.number))

    @property
    def revision(self) -> int:
        """Rises by one each time its geometry really changed."""
        tables, row = self._here()
        return tables.revision_curve.get(row, 0)


# --------------------------------------------------------------------------------------
# Lines and groups of lines.


@attrs.frozen(repr=False)
class Line(Handle):
    """A line: one or more curves in one plane, or one space curve."""

    _table: ClassVar[str] = "lines"

    @property
    def name(self) -> str:
        """Its name, unique in its group."""
        tables, row = self._here()
        return str(tables.lines.name[row])

    @property
    def group(self) -> Group:
        """The group it belongs to."""
        tables, row = self._here()
        return Group.of(tables, int(tables.lines.group[row]))

    @property
    def container(self) -> Group:
        """The group of its family; `holders` are a designer's own."""
        return self.group

    @property
    def plane(self) -> Plane | None:
        """The plane it lies in, ``normal . P = offset``; None for a space curve."""
        tables, row = self._here()
        table = tables.lines
        return Plane(table.normal[row], table.offset[row]) if table.planar[row] else None

    @property
    def position(self) -> float | None:
        """Offset of its plane (m): x of a section, z of a waterline, y of a buttock."""
        plane = self.plane
        return None if plane is None else plane.offset

    @property
    def boundary(self) -> str | None:
        """What it does to lines that meet it: ``"end"``, ``"flat"``, ``"knuckle"`` or None."""
        tables, row = self._here()
        kind = int(tables.lines.boundary[row])
        return None if kind < 0 else BoundaryKind(kind).name.lower()

    @property
    def note(self) -> str:
        """What was assumed when it was made; empty if nothing."""
        tables, row = self._here()
        return str(tables.lines.note[row])

    @property
    def curves(self) -> tuple[Curve, ...]:
        """Its curves."""
        tables, curves = self._curves()
        return tuple(_curve(tables, curve) for curve in curves)

    def _curves(self) -> tuple[HullState, list[int]]:
        tables, row = self._here()
        alive = tables.curves.alive.data
        return tables, [int(curve) for curve in tables.lines.curves[row] if alive[curve]]

    @property
    def points(self) -> tuple[Point, ...]:
        """The points of all its curves, curve by curve."""
        tables, curves = self._curves()
        return tuple(point for curve in curves for point in _points_along(tables, curve))

    @property
    def dirty(self) -> DirtyCause | None:
        """Because of what its first dirty curve is that; None if all are clean."""
        causes = (curve.dirty for curve in self.curves)
        return next((each for each in causes if each is not None), None)

    def meet(self, plane: Plane | tuple[ArrayLike, float]) -> FloatArray:
        """Give the places where its curves pass a plane, (k, 3), m; frozen.

        Parameters
        ----------
        plane : Plane, or (normal (3,) of unit length, offset m)
            The plane.

        Examples
        --------
        >>> from assoc_hull.shipped.wigley import wigley
        >>> from assoc_hull.model.objects import Line
        >>> Line.of(wigley(), 3).meet(((0, 0, 1), 7.0)).round(3).tolist()
        [[10.0, 1.8, 7.0]]
        """
        cut = as_plane(plane)
        tables, curves = self._curves()
        return _met(tables, curves, cut)


def _met(tables: HullState, curves: Sequence[int], plane: Plane) -> FloatArray:
    """Give the places where curves pass, touch or end on a plane, (k, 3), m; frozen.

    Of a run along the plane its two ends count, of a curve that lies in it none.
    """
    found = []
    for curve in curves:
        spline = tables.spline(curve)
        on = on_plane(spline, plane.normal, plane.offset)
        if not on.all():
            met = points_on_plane(spline, plane.normal, plane.offset)
            inside = spline.knot[1:-1][on[:-2] & on[1:-1] & on[2:]]
            found.append(met.xyz[~np.isin(met.t, inside)])
    places = np.concatenate([*found, np.zeros((0, 3))])
    freeze(places)
    return places


@attrs.frozen(repr=False)
class Group(Handle):
    """A group of lines: the unit of associations and of global modifications.

    A group of a designer's own (`Edit.group`) holds lines of any family, and groups.
    """

    _table: ClassVar[str] = "groups"

    @property
    def name(self) -> str:
        """Its name."""
        tables, row = self._here()
        return str(tables.groups.name[row])

    @property
    def family(self) -> str:
        """The family of its lines, for instance ``"waterlines"``; ``"own"`` of one's own."""
        tables, row = self._here()
        return str(tables.groups.family[row])

    @property
    def members(self) -> tuple[Line | Group, ...]:
        """The lines and groups that it holds itself, in the order in which they were given."""
        tables, row = self._here()
        if tables.groups.family[row] != OWN:
            return tuple(self.lines.values())
        numbers = {tables.lines.key[line]: line for line in tables.live("lines").tolist()}
        found = list[Line | Group]()
        for name in tables.groups.members[row]:
            if name in numbers:
                found.append(Line.of(tables, numbers[name]))
            elif (group := live_group(tables, name)) is not None:
                found.append(Group.of(tables, group))
        return tuple(found)

    @property
    def lines(self) -> Mapping[str, Line]:
        """Its lines by name, those of the groups in it too; by family and position; read-only."""
        tables, row = self._here()
        table, book = tables.lines, AddressBook(tables)
        mine = named_lines(tables, str(tables.groups.name[row])).tolist()
        # space curves have no position and come last
        place = np.where(table.planar.data, table.offset.data, np.inf).tolist()
        own = tables.groups.family[row] == OWN
        rank = {line: tables.family(line).rank if own else 0 for line in mine}
        order = sorted(mine, key=lambda i: (rank[i], place[i], table.key[i]))
        names = {i: book.line_name(i) if own else table.name[i] for i in order}
        return NamedMapping("line", {names[i]: Line.of(tables, i) for i in order}, spoken=True)

    @property
    def container(self) -> Group | None:
        """The group that holds it, the first by name; None if none does."""
        return next(iter(self.holders), None)


# --------------------------------------------------------------------------------------
# Features. Unlike the handles above, these do not follow their object through edits.


@attrs.frozen(repr=False)
class FeatureHandle:
    """A feature as it was when it was asked for: name, kind, numbers, its points and lines.

    Attributes
    ----------
    tables : HullState
        The tables of the hull.
    feature : Feature
        What the tables hold.
    """

    tables: HullState
    feature: Feature

    @property
    def id(self) -> str:
        """Its key, which outlives renaming."""
        return self.feature.key

    @property
    def name(self) -> str:
        """What it is called."""
        return self.feature.name

    @property
    def kind(self) -> str:
        """``"circle"``, ``"arc"``, ``"flat"``, ``"straight"``, ``"knuckle"`` or ``"tangent"``."""
        return self.feature.kind

    @property
    def parameters(self) -> Mapping[str, float | Place]:
        """What its kind has, lengths in m: `assoc_hull.model.features.PARAMETERS` lists it."""
        return self.feature.parameters

    @property
    def side(self) -> int:
        """Where centre or region lie, seen against the normal: 1 left of its points, -1 right."""
        return self.feature.side

    @property
    def gap(self) -> float:
        """How far the farthest of its points lay off it when it was found, m."""
        return self.feature.gap

    @property
    def lines(self) -> tuple[Line, ...]:
        """The lines that it lies on."""
        numbers = line_numbers(self.tables)
        return tuple(Line.of(self.tables, numbers[key]) for key in self.feature.lines)

    @property
    def points(self) -> tuple[Point, ...]:
        """The points that it owns, in order along its line, on the curve that they lie on there."""
        table, mine = self.tables.rows, set(self.feature.lines)
        found = []
        for row in self.feature.points:
            first = int(table.curve[row, 0])
            side = 0 if self.tables.lines.key[self.tables.line_of(first)] in mine else 1
            found.append(Point(self.tables, row, str(table.key[row]), side))
        return tuple(found)

    def __repr__(self) -> str:
        return f"<{self.kind} {self.name}, {len(self.feature.points)} points>"


def features_by_name(state: HullState) -> NamedMapping[FeatureHandle]:
    """Give the features of a hull by name, in the order of their keys.

    One whose name features of two lines have is found by group and name, as such lines are.
    """
    features = state.features
    count = Counter(each.name for each in features)
    title = {
        state.lines.key[line]: state.groups.name[int(state.lines.group[line])]
        for line in state.live("lines").tolist()
    }
    return NamedMapping(
        "feature",
        {
            each.name if count[each.name] < 2 else f"{title[each.lines[0]]}/{each.name}":
            FeatureHandle(state, each)
            for each in features
        },
    )  # fmt: skip


# --------------------------------------------------------------------------------------
# From addresses to handles and back.


def handle(state: HullState, text: str) -> Group | Line | Curve | Point:
    """Give the handle that an address leads to.

    Parameters
    ----------
    state : HullState
        The tables.
    text : str
        An address, see `assoc_hull.model.address`, or a key.

    Returns
    -------
    Group, Line, Curve or Point
        The deepest object that the address names.

    Raises
    ------
    UnknownNameError
        Nothing has this address; near ones are named.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.objects import handle
    >>> handle(wigley(), "waterlines"), handle(wigley(), "ST 7 [1]")
    (<Group waterlines>, <Curve ST 7>)
    """
    place = resolve_address(state, text)
    if place.row >= 0:
        return Point(state, place.row, state.rows.key[place.row], place.side)
    if place.curve >= 0:
        return Curve.of(state, place.curve)
    if place.line >= 0:
        return Line.of(state, place.line)
    return Group.of(state, place.group)


def numbers_of(
    thing: Group | Line | Curve | Point | Crossing, tables: HullState | None = None
) -> ResolvedAddress:
    """Give the numbers of what a handle stands for, as its address would; in `tables` if given.

    Raises
    ------
    ForeignPointError
        It has gone.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.objects import handle, numbers_of
    >>> numbers_of(handle(wigley(), "sections"))
    ResolvedAddress(group=1, line=-1, curve=-1, row=-1, side=-1)
    """
    state, number = (tables, thing.number) if tables is not None else thing._here()
    if isinstance(thing, Group):
        return ResolvedAddress(number)
    row = number if isinstance(thing, Point | Crossing) else -1
    side = thing.side if isinstance(thing, Point) else 0
    if isinstance(thing, Line):
        return ResolvedAddress(int(state.lines.group[number]), number)
    curve = number if row < 0 else int(state.rows.curve[row, side])
    line = state.line_of(curve)
    return ResolvedAddress(int(state.lines.group[line]), line, curve, row, side if row >= 0 else -1)


_ROLES = ("shared", "driven", "watched", "pinned", "adopted")


def _role(state: HullState, row: int) -> str:
    """Give what decides where a point lies."""
    sort = state.rows.sort[row]
    if sort != Sort.CROSSING:
        return "pinned" if sort == Sort.PLACED else "adopted"
    role = Role(int(state.rows.role[row]))
    return "driven" if role in (Role.DRIVES_A, Role.DRIVES_B) else role.text


class Points(Mapping[str, Point]):
    """The points of a hull by address; a crossing stands under its line of higher rank.

    Any address leads to a point, also the other way round: ``points["ST 7 x WL 0.5"]``.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.objects import Points
    >>> points = Points(wigley())
    >>> next(iter(points)), points["ST 7 x WL 2.5"].parent_curve
    ('ST 1 x profile', <Curve WL 2.5>)
    """

    def __init__(self, state: HullState) -> None:
        self._home = state.live_tables

    def __repr__(self) -> str:
        return f"<{len(self)} points by address>"

    @property
    def _state(self) -> HullState:
        return self._home.published()

    def __getitem__(self, address: str) -> Point:
        found = handle(self._state, address)
        if isinstance(found, Point):
            return found
        raise BadInputError(f"{address!r} names no point", "in points", "ask hull.find for it")

    def __contains__(self, address: object) -> bool:
        try:
            return isinstance(address, str) and bool(self[address])
        except (BadInputError, UnknownNameError):
            return False

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)

    def items(self) -> ItemsView[str, Point]:
        """Give addresses with their points."""
        return dict(self._all()).items()

    def values(self) -> ValuesView[Point]:
        """Give the points."""
        return dict(self._all()).values()

    def by_role(self) -> Mapping[str, tuple[Point, ...]]:
        """Sort the points by what decides where they lie.

        Returns
        -------
        mapping of str to tuple of Point
            Each point once, under its line of higher rank, in the order of the tables, by

            - ``"shared"``: crossings that both curves are made through;
            - ``"driven"``: crossings computed from one curve, which the other is made through;
            - ``"watched"``: crossings that neither curve is made through; their gap is measured;
            - ``"pinned"``: points that a designer placed; no edit of others moves them;
            - ``"adopted"``: points of the shape as it came, which go with fields.

        See Also
        --------
        Point.crossing_role, Point.driver : of one point.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> {role: len(points) for role, points in hull.points.by_role().items()}
        {'shared': 219, 'driven': 29, 'watched': 0, 'pinned': 0, 'adopted': 25}
        """
        found: dict[str, list[Point]] = {role: [] for role in _ROLES}
        state = self._state
        for _, point in self._all():
            found[_role(state, point.row)].append(point)
        return NamedMapping("role", {role: tuple(points) for role, points in found.items()})

    def _all(self) -> Iterator[tuple[str, Point]]:
        """Give all points by address from one book: a look-up each would make one each."""
        state = self._state
        rows = state.live("rows").tolist()
        book, keys = AddressBook(state), state.rows.key.data.for_looks(len(rows))
        for row in rows:
            side = book.usual_side(row)
            yield book.address(row, side), Point(state, row, keys[row], side)

    def __iter__(self) -> Iterator[str]:
        state = self._state
        book = AddressBook(state)
        return (book.address(row) for row in state.live("rows").tolist())

    def __len__(self) -> int:
        return len(self._state.live("rows"))
