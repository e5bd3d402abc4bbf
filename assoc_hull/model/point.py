"""Handles on points and crossings.

The two friend points of a crossing are two handles on one row of the table of points, so
they cannot disagree.

Reference: Choi & Lee, "A Study on the Hull Form Design System on the Basis of the
Associative Geometry Objects", J. SNAK 36(4), 1999.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, PointKind, freeze
from assoc_hull.model.address import AddressBook
from assoc_hull.model.handle import Handle
from assoc_hull.model.kinds import Role, Sort, State
from assoc_hull.model.links import defines, free_axes, places
from assoc_hull.model.state import HullState

if TYPE_CHECKING:
    from assoc_hull.model.curve import Curve

__all__ = ["Crossing", "Point"]


def _curve(tables: HullState, number: int) -> Curve:
    """Give the handle on a curve; points and curves know one another."""
    from assoc_hull.model.curve import Curve

    return Curve.of(tables, number)


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
    >>> from assoc_hull.model.line import Line
    >>> line = Line.of(wigley(), 3)
    >>> line.curves[0].points[1].free
    ('y',)
    """

    _table: ClassVar[str] = "rows"
    side: int = 0

    @property
    def name(self) -> str:
        """The label that was given, else the address, for instance ``WL 0.5 x ST 7``."""
        label = self.tables.rows.label.data[self.row]
        return str(label) if label else AddressBook(self.tables).address(self.row, self.side)

    @property
    def position(self) -> FloatArray:
        """The place, (3,), m; frozen."""
        found: FloatArray = places(self.tables, np.array([self.row]), np.array([self.side]))[0]
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
        return PointKind(int(self.tables.rows.kind.data[self.row, self.side])).name.lower()

    @property
    def sort(self) -> str:
        """``"crossing"``, ``"placed"`` or ``"adopted"``."""
        return Sort(int(self.tables.rows.sort.data[self.row])).name.lower()

    @property
    def role(self) -> str:
        """``"defining"`` if its curve is made through it, else ``"derived"``."""
        return "defining" if defines(self.tables, self.row, self.side) else "derived"

    @property
    def crossing_role(self) -> str | None:
        """``"shared"``, ``"drives a"``, ``"drives b"`` or ``"watched"``; None if no crossing."""
        return None if self.crossing is None else self.crossing.role

    @property
    def crossing(self) -> Crossing | None:
        """The crossing this point belongs to, if it does."""
        if self.tables.rows.sort.data[self.row] != Sort.CROSSING:
            return None
        return Crossing(self.tables, self.number, self.id)

    @property
    def container_curve(self) -> Curve:
        """The curve it lies on."""
        return _curve(self.tables, int(self.tables.rows.curve.data[self.row, self.side]))

    @property
    def parent_curve(self) -> Curve | None:
        """The curve that generated it; None for a placed or adopted point."""
        return None if self.friend_point is None else self.friend_point.container_curve

    @property
    def friend_point(self) -> Point | None:
        """The same crossing on the parent curve; None for a placed or adopted point."""
        if self.tables.rows.curve.data[self.row, 1 - self.side] < 0:
            return None
        return Point(self.tables, self.number, self.id, 1 - self.side)

    @property
    def free(self) -> tuple[str, ...]:
        """Coordinates along which it may move; an edit gives exactly these."""
        return free_axes(self.tables, self.row)

    @property
    def driver(self) -> Curve | None:
        """The curve it is computed from, if it is."""
        driver = int(self.tables.rows.driver.data[self.row])
        return None if driver < 0 else _curve(self.tables, driver)

    @property
    def state(self) -> str:
        """``"clean"``, ``"failed"`` or ``"blocked"``."""
        return State(int(self.tables.rows.state.data[self.row])).name.lower()

    @property
    def revision(self) -> int:
        """Rises by one each time it really moved."""
        return self.tables.revision_row.get(self.row, 0)


@attrs.frozen(repr=False)
class Crossing(Handle):
    """One meeting of two associated curves: one value that both read."""

    _table: ClassVar[str] = "rows"

    @property
    def name(self) -> str:
        """Its address, the line of higher rank first."""
        return AddressBook(self.tables).address(self.row)

    @property
    def points(self) -> tuple[Point, Point]:
        """The friend points on curve a and on curve b."""
        first, second = (Point(self.tables, self.row, self.id, side) for side in (0, 1))
        return first, second

    @property
    def a(self) -> Curve:
        """The curve of lower rank."""
        return self.points[0].container_curve

    @property
    def b(self) -> Curve:
        """The curve of higher rank."""
        return self.points[1].container_curve

    @property
    def role(self) -> str:
        """``"shared"``, ``"drives a"``, ``"drives b"`` or ``"watched"``."""
        return Role(int(self.tables.rows.role.data[self.row])).text

    @property
    def override(self) -> str | None:
        """The role the designer gave it in place of the rule's, if so."""
        role = int(self.tables.rows.override.data[self.row])
        return None if role < 0 else Role(role).text

    @property
    def sign(self) -> int:
        """+1 where a passes to the positive side of b's plane, else -1; 0 if neither."""
        return int(self.tables.rows.sign.data[self.row])

    @property
    def birth(self) -> int:
        """Number of its birth for this pair of lines, from 1."""
        return int(self.tables.rows.birth.data[self.row])

    @property
    def gap(self) -> float | None:
        """How far its curves pass each other along the hull's normal (m), if it is watched."""
        return self._length("gap")

    @property
    def limit(self) -> float | None:
        """The largest gap it may have (m), if it is watched."""
        return self._length("limit")

    def _length(self, column: str) -> float | None:
        if self.tables.rows.role.data[self.row] != Role.WATCHED:
            return None
        value = float(getattr(self.tables.rows, column).data[self.number])
        return value if np.isfinite(value) else None

    @property
    def state(self) -> str:
        """``"clean"``, ``"failed"`` or ``"blocked"``."""
        return State(int(self.tables.rows.state.data[self.row])).name.lower()
