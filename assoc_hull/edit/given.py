"""What a designer gives as a handle or an address, found in the tables of the hull."""

from __future__ import annotations

from collections.abc import Sequence

import attrs

from assoc_hull.arguments import shown, shown_name
from assoc_hull.errors import BadInputError, ForeignPointError, UnknownNameError, WrongTypeError
from assoc_hull.model.address import Place, resolve
from assoc_hull.model.curve import Curve
from assoc_hull.model.handles import place_of
from assoc_hull.model.line import Group, Line
from assoc_hull.model.point import Crossing, Point
from assoc_hull.model.state import HullState

__all__ = ["Given"]

_HANDLE = "give a handle or an address"


@attrs.frozen(eq=False)
class Given:
    """Finds numbers in the tables; each method raises what fits a wrong argument.

    Raises
    ------
    WrongTypeError
        Neither a handle nor an address.
    UnknownNameError
        An address that leads nowhere, or to something else.
    ForeignPointError
        A handle of another hull.

    Examples
    --------
    >>> from assoc_hull.edit.given import Given
    >>> from assoc_hull.shipped.wigley import wigley
    >>> Given(wigley()).group("sections")
    'sections'
    """

    tables: HullState

    def place(self, thing: object) -> Place:
        """Find what a handle or an address leads to."""
        if isinstance(thing, str):
            return resolve(self.tables, thing)
        if isinstance(thing, Group | Line | Curve | Point | Crossing):
            self.own(thing)
            return place_of(thing)
        raise WrongTypeError(f"the object is {shown(thing)}", "in an edit", _HANDLE)

    def group(self, group: Group | str) -> str:
        """Take the name of a group; lines are associated by their groups only."""
        if isinstance(group, str) and group in self.tables.groups.name.data:
            return group
        try:
            place = self.place(group)
        except UnknownNameError:
            return str(group)
        name = str(self.tables.groups.name.data[place.group])
        if place.line >= 0:
            raise BadInputError(
                f"{shown_name(getattr(group, 'name', group))!r} lies in the group {name!r}",
                "in an edit",
                f"associations run between whole groups, and lines join them; say {name!r}",
            )
        return name

    def point(self, point: Point | str) -> tuple[int, int]:
        """Give the row of a point and its side: 0 on its first curve, 1 on its second."""
        found = self._found(point, Point, "point")
        if found.row < 0:
            raise UnknownNameError("point", str(point))
        return found.row, found.side

    def curve(self, curve: Curve | str) -> int:
        """Give the number of a curve, or of the only curve of a line."""
        found = self._found(curve, Curve, "curve")
        if found.curve >= 0:
            return found.curve
        found_pieces = self.tables.lines.curves.data[found.line] if found.line >= 0 else ()
        pieces: tuple[int, ...] = tuple(found_pieces)
        if len(pieces) != 1:
            known = tuple(f"{curve} [{i + 1}]" for i in range(len(pieces)))
            raise UnknownNameError("curve", str(curve), known)
        return int(pieces[0])

    def line(self, line: Line | str) -> int:
        """Give the number of a line."""
        found = self._found(line, Line, "line")
        if found.line < 0 or found.curve >= 0:
            raise UnknownNameError("line", str(line))
        return found.line

    def _found(self, thing: object, kind: type[Point | Curve | Line], what: str) -> Place:
        """Find what a handle of one kind, or an address, leads to."""
        if not isinstance(thing, kind | str):
            raise WrongTypeError(f"the {what} is {shown(thing)}", "in an edit", _HANDLE)
        return self.place(thing)

    def driving(self, drivers: Sequence[Group | Line | str]) -> list[int]:
        """Give the lines of groups and lines given as handles or names."""
        if isinstance(drivers, (str, Group, Line)) or not isinstance(drivers, Sequence):
            raise BadInputError(
                f"drivers is {shown(drivers)}", "in transform", "give a list of names"
            )
        tables, found = self.tables, list[int]()
        names = tables.groups.name.data
        for each in drivers:
            if isinstance(each, Group) and each.tables is not tables:
                raise ForeignPointError(repr(each))
            name = each.name if isinstance(each, Group) else each
            if isinstance(name, str) and name in names:
                live = tables.live("lines")
                found += live[tables.lines.group.data[live] == names.index(name)].tolist()
            else:
                found.append(self.line(name))
        return found

    def own(self, handle: Group | Line | Curve | Point | Crossing) -> None:
        """Refuse a handle of another hull."""
        if handle.tables is not self.tables:
            raise ForeignPointError(repr(handle))
