"""The edit a designer works with: handles and addresses in, one transaction behind.

Every method checks its arguments, names what is wrong, and changes nothing until the
``with`` block ends; then one update runs.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from types import TracebackType
from typing import Literal, Self

from numpy.typing import ArrayLike

from assoc_hull.edit import associate as _associate
from assoc_hull.edit import cut as _cut
from assoc_hull.edit import ends as _ends
from assoc_hull.edit import lines as _lines
from assoc_hull.edit import points as _points
from assoc_hull.edit import pull as _pull
from assoc_hull.edit import renew as _renew
from assoc_hull.edit import reshape as _reshape
from assoc_hull.edit import set_role as _set_role
from assoc_hull.edit import shift as _shift
from assoc_hull.edit import transform as _transform
from assoc_hull.edit.arguments import number
from assoc_hull.edit.document import Document
from assoc_hull.edit.mapping import Jacobian, Mapping, SpaceMap, affine
from assoc_hull.edit.report import EditReport
from assoc_hull.edit.transaction import Transaction
from assoc_hull.edit.update import Settings
from assoc_hull.errors import BadInputError, ForeignPointError, UnknownNameError
from assoc_hull.model.address import resolve
from assoc_hull.model.handles import Crossing, Curve, Group, Line, Point
from assoc_hull.model.state import HullState

__all__ = ["Edit"]

_USE = "use it in a with statement"


class Edit:
    """One named edit, to be used in a ``with`` statement; one undo step.

    Points, curves and lines are given as handles or as addresses, for instance
    ``"WL 0.5 x ST 7"``.

    Parameters
    ----------
    document : Document
        The hull.
    name : str
        Name of the edit.
    settings : Settings
        Policy and treatment of gaps.
    look : callable or None
        For a preview: called when the update has run, before everything is taken back.
    """

    def __init__(
        self,
        document: Document,
        name: str,
        settings: Settings | None = None,
        look: Callable[[], None] | None = None,
    ) -> None:
        self._held = Transaction(document, name, settings, look)

    def __enter__(self) -> Self:
        self._held.__enter__()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._held.__exit__(kind, error, trace)

    @property
    def report(self) -> EditReport | None:
        """What the edit did; None until it is committed."""
        return self._held.report

    @property
    def active(self) -> bool:
        """Whether the ``with`` block is open."""
        return self._held.active

    @property
    def _transaction(self) -> Transaction:
        """The transaction, for a modification: only while the edit is open."""
        if not self.active:
            raise BadInputError("it is not open", f"in the edit {self._held.name!r}", _USE)
        if self._held.pending.alone:
            raise BadInputError(*self._held.pending.not_alone(self._held.name))
        return self._held

    @property
    def _tables(self) -> HullState:
        return self._held.state

    def move(
        self,
        point: Point | str,
        *,
        x: float | None = None,
        y: float | None = None,
        z: float | None = None,
    ) -> None:
        """Move a point along its freedom; give exactly the coordinates it is free in, m.

        Raises
        ------
        PointRoleError
            The point is driven or watched.
        FreedomError
            Other coordinates than those it is free in.
        """
        asked = {"x": x, "y": y, "z": z}
        row, _ = self._point(point)
        given = {axis: number(value, axis) for axis, value in asked.items() if value is not None}
        _points.move(self._transaction, row, given)

    def insert(self, curve: Curve | str, place: ArrayLike) -> Point:
        """Insert a placed point at (x, y, z), m; it is never moved by an update."""
        row = _points.insert(self._transaction, self._curve(curve), place)
        return Point.of(self._tables, row)

    def delete(self, point: Point | str) -> None:
        """Delete a placed or adopted point."""
        _points.delete(self._transaction, self._point(point)[0])

    def set_kind(
        self, point: Point | str, kind: str, *, direction: ArrayLike | None = None
    ) -> None:
        """Make a point ``"smooth"``, ``"tangent"`` or ``"knuckle"`` on the curve it lies on."""
        row, side = self._point(point)
        _points.set_kind(self._transaction, row, side, kind, direction)

    def pin(self, point: Point | str) -> None:
        """Make an adopted point a placed one."""
        _points.pin(self._transaction, self._point(point)[0])

    def unpin(self, point: Point | str) -> None:
        """Make a placed point an adopted one."""
        _points.unpin(self._transaction, self._point(point)[0])

    def pull(
        self,
        point: Point | str,
        d: float,
        radius: tuple[float, float] | None = None,
        *,
        across_flats: bool = False,
    ) -> None:
        """Pull the hull at a point by d (m, outward), fading over (r_x, r_girth) in m."""
        row, _ = self._point(point)
        _pull.pull(self._transaction, row, number(d, "d"), radius, across_flats=across_flats)

    def reshape(
        self,
        curve: Curve | str,
        points: ArrayLike,
        *,
        span: tuple[float, float],
        fade: Literal["auto"] | tuple[float, float] | None = "auto",
        across_flats: bool = False,
    ) -> tuple[Point, ...]:
        """Give a curve a new shape through points (k, 3), m, within a span; the hull follows.

        Returns the placed points that were made.
        """
        made = _reshape.reshape(
            self._transaction, self._curve(curve), points, span, fade, across_flats=across_flats
        )
        return tuple(Point.of(self._tables, row) for row in made)

    def set_end(
        self,
        curve: Curve | str,
        end: str,
        *,
        tangent: ArrayLike | None = None,
        curvature: ArrayLike | None = None,
    ) -> None:
        """Give a curve a tangent or a curvature at its start or finish; free without either."""
        _ends.set_end(
            self._transaction, self._curve(curve), end, tangent=tangent, curvature=curvature
        )

    def set_role(self, crossing: Point | Crossing | str, role: str | None) -> None:
        """Override what a crossing defines; None gives it back to the rule."""
        row = crossing.row if isinstance(crossing, Crossing) else self._point(crossing)[0]
        _set_role.set_role(self._transaction, row, role)

    def renew_roles(self, lines: Sequence[Line | str]) -> int:
        """Apply the role rule again to all crossings of lines; gives how many changed."""
        if isinstance(lines, (str, Line)) or not isinstance(lines, Sequence):
            raise BadInputError(f"the lines {lines!r}", "in renew_roles", "give a list of lines")
        return _renew.renew_roles(self._transaction, [self._line(line) for line in lines])

    def associate(self, a: Group | str, b: Group | str, *, two_way: bool = True) -> None:
        """Declare that a generates points on b, and b on a if two-way."""
        names = [each.name if isinstance(each, Group) else each for each in (a, b)]
        _associate.associate(self._transaction, names[0], names[1], two_way=two_way)

    def dissociate(self, a: Group | str, b: Group | str) -> None:
        """Take an association back."""
        names = [each.name if isinstance(each, Group) else each for each in (a, b)]
        _associate.dissociate(self._transaction, names[0], names[1])

    def rename(self, line: Line | str, name: str) -> None:
        """Give a line another name."""
        _lines.rename_line(self._transaction, self._line(line), name)

    def add_line(self, group: Group | str, position: float, name: str | None = None) -> Line:
        """Cut a new line at a position (m) along its family's axis."""
        title = group.name if isinstance(group, Group) else group
        line = _cut.add_line(self._transaction, title, number(position, "position"), name)
        return Line.of(self._tables, line)

    def shift_line(self, line: Line | str, position: float) -> None:
        """Shift a line to another position (m); the hull keeps its shape."""
        _shift.shift_line(self._transaction, self._line(line), number(position, "position"))

    def remove_line(self, line: Line | str) -> None:
        """Remove a line; what it held stays behind as adopted points."""
        _lines.remove_line(self._transaction, self._line(line))

    def transform(
        self,
        mapping: Mapping | None = None,
        drivers: Sequence[Group | Line | str] = (),
        *,
        scale: ArrayLike | None = None,
        shift: ArrayLike | None = None,
        planes: Literal["stay", "follow"] = "stay",
        jacobian: Jacobian | None = None,
        tolerance: float = 2e-3,
    ) -> None:
        """Carry driving groups or lines by a mapping of space; all other lines follow.

        Parameters
        ----------
        mapping : callable or None
            Takes places (n, 3), m, and gives where they come to; (0, y, z) stays at y = 0.
        drivers : sequence of Group, Line or str
            Whose images are taken exactly; their planes go along, and one that is bent out
            of a plane becomes a space curve. Boundary curves are features of the hull and
            no cuts of it: they are carried with the drivers, named or not.
        scale, shift : (3,), (3,), m
            Instead of a mapping: factors about the origin, then a shift.
        planes : {"stay", "follow"}
            Followers are cut again at their own planes, or at parallel ones where the
            mapping sends their planes to such.
        jacobian : callable or None
            Gives d mapping_i / d x_j as (n, 3, 3); central differences over 1 mm if None.
        tolerance : float, m
            How far a driver may leave its exact image; adopted points hold it.

        Raises
        ------
        BadInputError
            No driver, a mapping that fails, folds, or moves the centre plane, a follower
            that no driver defines.
        UnknownNameError
            A driver that does not exist.

        Notes
        -----
        It is an edit of its own: nothing else may stand in the same ``with`` block. The
        particulars stay as they are.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> with hull.edit("10 % broader") as edit:
        ...     edit.transform(lambda p: p * [1, 1.1, 1], drivers=["sections", "profile"])
        >>> hull.half_breadth(50.0, 6.25)
        5.5
        """
        if (mapping is None) == (scale is None and shift is None):
            raise BadInputError(
                "neither or both of a mapping and factors", "in transform",
                "give mapping, or scale and shift",
            )  # fmt: skip
        if mapping is None:
            linear = affine(scale, shift)
            space = SpaceMap(linear, linear.jacobian)
        else:
            space = SpaceMap(mapping, jacobian)
        if planes not in ("stay", "follow"):
            raise BadInputError(f"planes={planes!r}", "in transform", "use 'stay' or 'follow'")
        _transform.transform(
            self._transaction, space, self._driving(drivers), follow=planes == "follow",
            tolerance=number(tolerance, "tolerance"),
        )  # fmt: skip

    def _driving(self, drivers: Sequence[Group | Line | str]) -> list[int]:
        """Give the lines of groups and lines given as handles or names."""
        if isinstance(drivers, (str, Group, Line)) or not isinstance(drivers, Sequence):
            raise BadInputError(f"drivers={drivers!r}", "in transform", "give a list of names")
        tables, found = self._tables, list[int]()
        names = tables.groups.name.data
        for each in drivers:
            if isinstance(each, Group) and each.tables is not tables:
                raise ForeignPointError(repr(each))
            name = each.name if isinstance(each, Group) else each
            if isinstance(name, str) and name in names:
                live = tables.live("lines")
                found += live[tables.lines.group.data[live] == names.index(name)].tolist()
            else:
                found.append(self._line(name))
        return found

    def _point(self, point: Point | str) -> tuple[int, int]:
        if isinstance(point, Point):
            self._check_own(point)
            return point.row, point.side
        if not isinstance(point, str):
            raise BadInputError(f"the point {point!r}", "in an edit", "give a handle or an address")
        found = resolve(self._tables, point)
        if found.row < 0:
            raise UnknownNameError("point", point)
        return found.row, found.side

    def _curve(self, curve: Curve | str) -> int:
        if isinstance(curve, Curve):
            self._check_own(curve)
            return curve.row
        if not isinstance(curve, str):
            raise BadInputError(f"the curve {curve!r}", "in an edit", "give a handle or an address")
        found = resolve(self._tables, curve)
        if found.curve >= 0:
            return found.curve
        found_pieces = self._tables.lines.curves.data[found.line] if found.line >= 0 else ()
        pieces: tuple[int, ...] = tuple(found_pieces)
        if len(pieces) != 1:
            known = tuple(f"{curve} [{i + 1}]" for i in range(len(pieces)))
            raise UnknownNameError("curve", curve, known)
        return int(pieces[0])

    def _line(self, line: Line | str) -> int:
        if isinstance(line, Line):
            self._check_own(line)
            return line.row
        if not isinstance(line, str):
            raise BadInputError(f"the line {line!r}", "in an edit", "give a handle or an address")
        found = resolve(self._tables, line)
        if found.line < 0:
            raise UnknownNameError("line", line)
        return found.line

    def _check_own(self, handle: Point | Curve | Line) -> None:
        if handle.tables is not self._tables:
            raise ForeignPointError(repr(handle))
