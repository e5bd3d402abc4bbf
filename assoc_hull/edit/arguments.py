"""Check what a designer hands to an edit, before anything is changed.

Numbers and words are checked by `assoc_hull.arguments`; here come names of lines, directions in
the plane of a curve, and `GivenObjects`, which turns handles and addresses into the numbers of
the tables. Every refusal says what was given, where, and what to give instead.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import attrs
import numpy as np

from assoc_hull.arguments import number, place, shown, shown_name
from assoc_hull.errors import BadInputError, ForeignPointError, UnknownNameError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.plane import AXES
from assoc_hull.model.address import AddressBook, ResolvedAddress, address, resolve_address
from assoc_hull.model.kinds import OWN
from assoc_hull.model.links import live_group, named_lines
from assoc_hull.model.objects import Crossing, Curve, Group, Line, Point, is_in, numbers_of
from assoc_hull.model.tables import Corner, HullState, Ruling

__all__ = [
    "GivenObjects",
    "box_corners",
    "direction_in",
    "line_name",
]


def line_name(name: object) -> str:
    """Take a name for a line: text that no address could be read from.

    Raises
    ------
    BadInputError
        No text, blanks at its ends, or what addresses and keys are made with: " x ", " @ ",
        "#", "/", "[", "]", ":".
    """
    taken = (" x ", " @ ", "#", "/", "[", "]", ":")
    if not isinstance(name, str) or name != name.strip() or not name.isprintable() or not name:
        raise BadInputError(
            f"the name {shown(name)}", "in an edit", "give printable text without outer blanks"
        )
    if any(part in name for part in taken):
        raise BadInputError(
            f"the name {name!r} could be read as an address", "in an edit",
            "leave out ' x ', ' @ ', '#', '/', '[' and ']'",
        )  # fmt: skip
    return name


def direction_in(state: HullState, curve: int, value: object, name: str) -> FloatArray:
    """Take a vector in the plane of a curve, (3,); any length but zero.

    Raises
    ------
    BadInputError
        No vector, one without length, or one that leaves the plane.
    """
    found = place(value, name)
    length = float(np.sqrt((found * found).sum()))
    if length == 0.0:
        raise BadInputError(f"{name} has no length", "in an edit", "give a direction")
    line = state.line_of(curve)
    if state.lines.planar[line]:
        off = float((found * state.lines.normal[line]).sum()) / length
        if abs(off) > 1e-9:
            raise BadInputError(
                f"{name} leaves the plane of {state.lines.name[line]} (sine {off:.3g})",
                "in an edit",
                "give a vector in that plane",
            )
    return found


_HANDLE = "give a handle or an address"


def box_corners(box: object) -> tuple[Corner, Corner]:
    """Take bounds of a box by axis, (from, to) in m with None for no bound; give its corners."""
    if not isinstance(box, Mapping) or not set(box) <= set(AXES):
        remedy = "give bounds by axis, as {'x': (0.0, 60.0)}, None for no bound; {} for all"
        raise BadInputError(f"a box is {shown(box)}", "in rule", remedy)
    corners: list[list[float | None]] = [[None] * 3, [None] * 3]
    for axis, bounds in box.items():
        if not isinstance(bounds, Sequence) or isinstance(bounds, str) or len(bounds) != 2:
            remedy = "give (from, to) in m, None for no bound"
            raise BadInputError(f"the bounds of {axis} are {shown(bounds)}", "in rule", remedy)
        for corner, bound in zip(corners, bounds, strict=True):
            if bound is not None:
                corner[AXES.index(axis)] = number(bound, axis, "in rule")
        least, most = (corner[AXES.index(axis)] for corner in corners)
        if least is not None and most is not None and least >= most:
            what = f"the box runs from {axis} {least:g} to {most:g} m"
            raise BadInputError(what, "in rule", "give the lower bound first")
    low, high = ((each[0], each[1], each[2]) for each in corners)
    return low, high


@attrs.frozen(eq=False)
class GivenObjects:
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
    >>> from assoc_hull.edit.arguments import GivenObjects
    >>> from assoc_hull.shipped.wigley import wigley
    >>> GivenObjects(wigley()).group("sections")
    'sections'
    """

    tables: HullState

    def place(self, thing: object) -> ResolvedAddress:
        """Find what a handle or an address leads to."""
        if isinstance(thing, str):
            return resolve_address(self.tables, thing)
        if isinstance(thing, Group | Line | Curve | Point | Crossing):
            self.own(thing)
            return numbers_of(thing, self.tables)
        raise WrongTypeError(f"the object is {shown(thing)}", "in an edit", _HANDLE)

    def group(self, group: Group | str) -> str:
        """Take the name of a group; lines are associated by their groups only."""
        try:
            place = self.place(group)
        except UnknownNameError:
            return str(group)  # the edit names the groups there are in its own error
        name = str(self.tables.groups.name[place.group])
        if place.line < 0 and self.tables.groups.family[place.group] == OWN:
            raise BadInputError(
                f"{name!r} is a group of one's own", "in an edit",
                "name the group of a family; edit.rule says where own groups rule",
            )  # fmt: skip
        if place.line >= 0:
            raise BadInputError(
                f"{shown_name(getattr(group, 'name', group))!r} lies in the group {name!r}",
                "in an edit",
                f"associations run between whole groups, and lines join them; say {name!r}",
            )
        return name

    def group_or_line(self, thing: Group | Line | str) -> str:
        """Take the name of a group, or the key of a line."""
        if isinstance(thing, str) and live_group(self.tables, thing) is not None:
            return thing
        if not isinstance(thing, str | Group | Line):
            raise WrongTypeError(f"the lines are {shown(thing)}", "in an edit", _HANDLE)
        found = self.place(thing)
        if found.curve >= 0 or found.row >= 0:
            what = f"{shown(thing)} is no group and no line"
            raise BadInputError(what, "in an edit", "name a group or a line")
        if found.line >= 0:
            return str(self.tables.lines.key[found.line])
        return str(self.tables.groups.name[found.group])

    def members(self, lines: Sequence[Group | Line | str], where: str) -> tuple[str, ...]:
        """Take what a group is to hold: keys of lines and names of groups, each once."""
        if isinstance(lines, str | Group | Line) or not isinstance(lines, Sequence):
            remedy = "give a list of lines and groups"
            raise WrongTypeError(f"the lines are {shown(lines)}", where, remedy)
        found = [self.group_or_line(each) for each in lines]
        if not found:
            raise BadInputError("the group would hold nothing", where, "name lines or groups")
        for each in found:
            if found.count(each) > 1:
                title = shown(lines[found.index(each)])
                raise BadInputError(f"{title} is named twice", where, "name it once")
        return tuple(found)

    def rulings(self, a: str, b: str, where: Sequence[object]) -> list[Ruling]:
        """Take who rules in which boxes: pairs of a name or None, and of bounds by axis."""
        found = list[Ruling]()
        for each in where:
            if not isinstance(each, Sequence) or isinstance(each, str) or len(each) != 2:
                remedy = "give (who rules, {'x': (from, to)}), None for who where both do"
                raise BadInputError(f"an item is {shown(each)}", "in rule", remedy)
            ruler, box = each
            giver = a if ruler is None else self.group_or_line(ruler)
            if giver not in (a, b):
                what = f"{shown(ruler)} rules, and is neither of the two"
                raise BadInputError(what, "in rule", f"name {a!r} or {b!r}, or None for both")
            low, high = box_corners(box)
            found.append(Ruling(giver, b if giver == a else a, ruler is None, low, high))
        return found

    def group_named(self, name: object) -> str | None:
        """Give the group that a name means, however it is written; None if it means none."""
        names = self.tables.groups.name.data
        if not isinstance(name, str) or live_group(self.tables, name) is not None:
            return name if isinstance(name, str) else None
        try:
            found = resolve_address(self.tables, name)
        except (UnknownNameError, BadInputError):
            return None
        return str(names[found.group]) if found.line < 0 else None

    def point(self, point: Point | str) -> tuple[int, int]:
        """Give the row of a point and its side: 0 on its first curve, 1 on its second."""
        found = self._found(point, Point, "point")
        if found.row < 0:
            raise UnknownNameError("point", str(point), self._points_of(found))
        return found.row, found.side

    def _points_of(self, found: ResolvedAddress) -> tuple[str, ...]:
        """Give the points on what was named in place of a point."""
        lines = self.tables.lines.curves
        curves = [found.curve] if found.curve >= 0 else lines[found.line] if found.line >= 0 else ()
        rows = self.tables.rows
        on = rows.alive.data & np.isin(rows.curve.data, np.array(curves, np.int64)).any(axis=1)
        return tuple(address(self.tables, row) for row in np.flatnonzero(on).tolist())

    def _lines_of(self, found: ResolvedAddress) -> tuple[str, ...]:
        """Give the lines of the group that was named in place of a line, else all of them."""
        tables, book = self.tables, AddressBook(self.tables)
        live = tables.live("lines").tolist()
        own = [i for i in live if found.line < 0 and tables.lines.group[i] == found.group]
        return tuple(book.line_name(i) for i in own or live)

    def led_point(self, asked: object) -> tuple[int | None, FloatArray]:
        """Take a place, or a point and the place where it is to come: its row or None, (3,), m."""
        if isinstance(asked, str | Point):
            what, remedy = f"{shown(asked)} has no place", "give (point, (x, y, z))"
            raise BadInputError(what, "in lead", remedy)
        if isinstance(asked, Sequence) and len(asked) == 2 and isinstance(asked[0], str | Point):
            return self.point(asked[0])[0], place(asked[1], "the place of a point", "in lead")
        return None, place(asked, "an item of points", "in lead")

    def curve(self, curve: Curve | str) -> int:
        """Give the number of a curve, or of the only curve of a line."""
        found = self._found(curve, Curve, "curve")
        if found.curve >= 0:
            return found.curve
        found_pieces = self.tables.lines.curves[found.line] if found.line >= 0 else ()
        pieces: tuple[int, ...] = tuple(found_pieces)
        if len(pieces) != 1:
            known = tuple(f"{curve} [{i + 1}]" for i in range(len(pieces)))
            raise UnknownNameError("curve", str(curve), known)
        return int(pieces[0])

    def pieces(self, line: Line | Curve | str) -> list[int]:
        """Give the number of a curve, or those of all curves of a line."""
        found = self._found(line, Curve if isinstance(line, Curve) else Line, "line")
        if found.line < 0 or found.row >= 0:
            raise UnknownNameError("line", str(line), self._lines_of(found))
        if found.curve >= 0:
            return [found.curve]
        return [int(each) for each in self.tables.lines.curves[found.line]]

    def line(self, line: Line | str) -> int:
        """Give the number of a line."""
        found = self._found(line, Line, "line")
        if found.line < 0 or found.curve >= 0:
            raise UnknownNameError("line", str(line), self._lines_of(found))
        return found.line

    def line_of(self, line: Line | Curve | str) -> int:
        """Give the number of a line, or of the line that a curve belongs to."""
        found = self._found(line, Curve if isinstance(line, Curve) else Line, "line")
        if found.line < 0 or found.row >= 0:
            raise UnknownNameError("line", str(line), self._lines_of(found))
        return found.line

    def _found(self, thing: object, kind: type[Point | Curve | Line], what: str) -> ResolvedAddress:
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
        for each in drivers:
            if isinstance(each, Group) and each.home is not tables.live_tables:
                raise ForeignPointError(repr(each))
            name = each.name if isinstance(each, Group) else self.group_named(each)
            if isinstance(each, Group) or name is not None:
                found += [i for i in named_lines(tables, str(name)).tolist() if i not in found]
            else:
                found.append(self.line(each))
        return found

    def own(self, handle: Group | Line | Curve | Point | Crossing) -> None:
        """Refuse a handle of another hull, or on what is no more in these tables."""
        if handle.home is not self.tables.live_tables or not is_in(handle, self.tables):
            raise ForeignPointError(repr(handle))
