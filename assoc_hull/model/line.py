"""Handles on lines and groups of lines."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.plane import Plane, as_plane
from assoc_hull.geometry.splines.plane_intersections import meet_planes
from assoc_hull.model.curve import Curve
from assoc_hull.model.handle import Handle
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.named_mapping import Named
from assoc_hull.model.point import Point

__all__ = ["Group", "Line"]


@attrs.frozen(repr=False)
class Line(Handle):
    """A line: one or more curves in one plane, or one space curve."""

    _table: ClassVar[str] = "lines"

    @property
    def name(self) -> str:
        """Its name, unique in its group."""
        return str(self.tables.lines.name.data[self.row])

    @property
    def group(self) -> Group:
        """The group it belongs to."""
        return Group.of(self.tables, int(self.tables.lines.group.data[self.row]))

    @property
    def plane(self) -> Plane | None:
        """The plane it lies in, ``normal . P = offset``; None for a space curve."""
        table, row = self.tables.lines, self.row
        return (
            Plane(table.normal.data[row], table.offset.data[row])
            if table.planar.data[row]
            else None
        )

    @property
    def position(self) -> float | None:
        """Offset of its plane (m): x of a section, z of a waterline, y of a buttock."""
        return None if self.plane is None else self.plane.offset

    @property
    def boundary(self) -> str | None:
        """What it does to lines that meet it: ``"end"``, ``"flat"``, ``"knuckle"`` or None."""
        kind = int(self.tables.lines.boundary.data[self.row])
        return None if kind < 0 else BoundaryKind(kind).name.lower()

    @property
    def note(self) -> str:
        """What was assumed when it was made; empty if nothing."""
        return str(self.tables.lines.note.data[self.row])

    @property
    def curves(self) -> tuple[Curve, ...]:
        """Its curves."""
        alive = self.tables.curves.alive.data
        numbers = self.tables.lines.curves.data[self.row]
        return tuple(Curve.of(self.tables, curve) for curve in numbers if alive[curve])

    @property
    def points(self) -> tuple[Point, ...]:
        """The points of all its curves, curve by curve."""
        return tuple(point for curve in self.curves for point in curve.points)

    def meet(self, plane: Plane | tuple[ArrayLike, float]) -> FloatArray:
        """Give the places where its curves pass a plane, (k, 3), m; frozen.

        Parameters
        ----------
        plane : Plane, or (normal (3,) of unit length, offset m)
            The plane.

        Examples
        --------
        >>> from assoc_hull.shipped.wigley import wigley
        >>> from assoc_hull.model.line import Line
        >>> Line.of(wigley(), 3).meet(((0, 0, 1), 7.0)).round(3).tolist()
        [[10.0, 1.8, 7.0]]
        """
        cut = as_plane(plane)
        offsets = np.array([cut.offset])
        found = [meet_planes(curve.spline, cut.normal, offsets).xyz for curve in self.curves]
        out = np.concatenate([*found, np.zeros((0, 3))])
        freeze(out)
        return out


@attrs.frozen(repr=False)
class Group(Handle):
    """A group of lines: the unit of associations and of global modifications."""

    _table: ClassVar[str] = "groups"

    @property
    def name(self) -> str:
        """Its name."""
        return str(self.tables.groups.name.data[self.row])

    @property
    def family(self) -> str:
        """The family of its lines, for instance ``"waterlines"``."""
        return str(self.tables.groups.family.data[self.row])

    @property
    def lines(self) -> Mapping[str, Line]:
        """Its lines by name, by position; read-only."""
        table = self.tables.lines
        live = self.tables.live("lines")
        mine = live[table.group.data[live] == self.row]
        place = np.where(table.planar.data, table.offset.data, np.inf).tolist()
        order = sorted(mine.tolist(), key=lambda i: (place[i], table.key.data[i]))
        return Named("line", {table.name.data[i]: Line.of(self.tables, i) for i in order})
