"""The edit a designer works with: handles and addresses in, one transaction behind.

Every method checks its arguments, names what is wrong, and changes nothing until the
``with`` block ends; then one update runs.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Mapping, Sequence
from types import TracebackType
from typing import TYPE_CHECKING, Literal, Self

from numpy.typing import ArrayLike

from assoc_hull.arguments import all_of, choice, flag, number, places, positive, shown
from assoc_hull.edit.arguments import GivenObjects, line_name
from assoc_hull.edit.document import Document
from assoc_hull.edit.lines import add_line as _cut
from assoc_hull.edit.lines import knuckle_lines as _knuckles
from assoc_hull.edit.lines import remove_line as _lines
from assoc_hull.edit.lines import shift_line as _shift
from assoc_hull.edit.modifications import associations as _associate
from assoc_hull.edit.modifications import attachments as _attachments
from assoc_hull.edit.modifications import attachments as _bodies
from assoc_hull.edit.modifications import attachments as _tunnels
from assoc_hull.edit.modifications import definitions as _reattach
from assoc_hull.edit.modifications import definitions as _set_form
from assoc_hull.edit.modifications import draw_runs as _draw
from assoc_hull.edit.modifications import lead as _lead
from assoc_hull.edit.modifications import names as _groups
from assoc_hull.edit.modifications import names as _rename
from assoc_hull.edit.modifications import points as _ends
from assoc_hull.edit.modifications import points as _points
from assoc_hull.edit.modifications import pull as _pull
from assoc_hull.edit.modifications import reshape as _reshape
from assoc_hull.edit.modifications import roles as _renew
from assoc_hull.edit.modifications import roles as _set_role
from assoc_hull.edit.modifications import spread as _spread
from assoc_hull.edit.recording import Said, Script, Settings, VariedValues, recorded
from assoc_hull.edit.recut import transform as _transform
from assoc_hull.edit.space_map import Jacobian, PointMapping, space_map
from assoc_hull.edit.step import EditReport, Step
from assoc_hull.edit.transaction import Transaction
from assoc_hull.edit.write_lock import LOOK_AGAIN, PATIENCE
from assoc_hull.errors import (
    AbsentParameterError,
    AssocHullError,
    BadInputError,
    FileBusyError,
    ForeignPointError,
    HullBusyError,
    HullFileError,
    MissingExtraError,
    RefusedEditError,
    StaleHullError,
    UnknownNameError,
    WrongTypeError,
)
from assoc_hull.model.attached_body import AttachedBody
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.objects import Crossing, Curve, Group, Line, Point
from assoc_hull.model.tables import HullState
from assoc_hull.model.tunnel_definition import TunnelDefinition

if TYPE_CHECKING:
    from assoc_hull.edit.modifications.fair import Faired

__all__ = ["Edit", "join_edit", "open_edit", "refusal_of"]

Bounds = tuple[float | None, float | None]
"""From where to where along an axis, m; None for no bound."""

_USE = "use it in a with statement"


_RAISED = (
    WrongTypeError, UnknownNameError, AbsentParameterError, ForeignPointError, HullFileError,
    FileBusyError, HullBusyError, StaleHullError, MissingExtraError,
)  # fmt: skip
"""Of these the asking is wrong, or the file, and not what was asked for."""


def join_edit(edit: Edit, settings: Settings, author: str | None) -> Edit:
    """Give the edit that is open to one that begins inside it, if that asks for nothing else.

    Raises
    ------
    BadInputError
        It would be carried out in another way, or by somebody else.
    """
    held = edit._held
    where = f"inside the edit {held.name!r}"
    if settings != edit.settings:
        what = "policy= or gaps= differ from those of the edit that is open"
        raise BadInputError(what, where, "leave them out, or give them to the outer edit")
    outer = held.document.author if held.author is None else held.author
    if author is not None and author != outer:
        what = f"author is {author!r} and that of the edit that is open is {outer!r}"
        raise BadInputError(what, where, "leave author= out, or end the outer edit first")
    return edit


def refusal_of(error: AssocHullError) -> tuple[str, ...]:
    """Give why an edit that only looks would be refused; raise what is no refusal."""
    if isinstance(error, _RAISED):
        raise error
    return error.findings if isinstance(error, RefusedEditError) else (str(error),)


def open_edit(document: Document) -> Edit | None:
    """Give the edit of a hull that this thread and task have open, if there is one."""
    writer = document.writer
    if not isinstance(writer, Transaction) or not document.lock.held_here:
        return None
    return writer.face if isinstance(writer.face, Edit) else None


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
        For a preview: called with the step, or None if nothing changed, when the update has
        run, before everything is taken back.
    stopped : callable or None
        Asked before each pass: whether the update is to end there, with a refusal.
    author : str or None
        Who edits; None for who does at this hull.
    wait : float, s
        For how long another thread may be at work, or in ``async with`` anybody else.
    """

    def __init__(
        self,
        document: Document,
        name: str,
        settings: Settings | None = None,
        look: Callable[[Step | None], None] | None = None,
        stopped: Callable[[], bool] | None = None,
        *,
        author: str | None = None,
        wait: float = PATIENCE,
    ) -> None:
        self._held = Transaction(document, name, settings, look, author=author, wait=wait)
        self._held.face = self
        if stopped is not None:
            self._held.pending.stopped = stopped

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

    async def __aenter__(self) -> Self:
        begin, lock, held = time.monotonic(), self._held.document.lock, self._held
        lock.line_up(held, f"the edit {held.name!r}")
        try:
            while True:
                try:
                    held.enter(0.0)
                except HullBusyError as error:
                    # The loop goes on meanwhile: a task of it may be the one that is waited for.
                    error.waited = time.monotonic() - begin
                    if error.waited >= held.wait:
                        raise
                else:
                    return self
                await asyncio.sleep(LOOK_AGAIN)
        finally:
            lock.leave(held)

    async def __aexit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._held.__exit__(kind, error, trace)

    @property
    def settings(self) -> Settings:
        """How it is carried out."""
        return self._held.settings

    @property
    def report(self) -> EditReport | None:
        """What the edit did; None until it is committed."""
        return self._held.report

    @property
    def active(self) -> bool:
        """Whether the ``with`` block is open."""
        return self._held.active

    @property
    def asked(self) -> Script:
        """What it was asked for so far, as data."""
        held = self._held
        return Script.of(held.script, held.settings, VariedValues(), VariedValues())

    def _note(self, change: dict[str, Said]) -> None:
        """Keep a modification that was asked for, as data."""
        self._held.note(change)

    @property
    def _transaction(self) -> Transaction:
        """The transaction, for a modification: only while the edit is open, and where it is."""
        where = f"in the edit {self._held.name!r}"
        if not self.active:
            raise BadInputError("it is not open", where, _USE)
        self._held.document.lock.refuse_others(where)
        if self._held.pending.alone:
            raise BadInputError(*self._held.pending.not_alone(self._held.name))
        return self._held

    @property
    def _tables(self) -> HullState:
        return self._transaction.state

    @property
    def _given(self) -> GivenObjects:
        return GivenObjects(self._transaction.state)

    @recorded
    def move(
        self,
        point: Point | str | Sequence[Point | str],
        *,
        x: float | None = None,
        y: float | None = None,
        z: float | None = None,
        by: ArrayLike | None = None,
        lead: bool = True,
    ) -> None:
        """Move a point along its freedom to a place, or points by vectors.

        A placed or an adopted point leads its line, see `lead`, but for one on a flat, the profile
        or a boundary curve; a crossing is pinned: its two lines take it along.

        Parameters
        ----------
        point : Point or str, or sequence of them
            The point; several only with `by`.
        x, y, z : float or None, m
            Where it goes: exactly the coordinates in which it is free.
        by : (3,) or (k, 3) or None, m
            Instead: the vector from where the points were before the edit, one for all or one
            for each. Along coordinates in which a point is not free it must be 0.
        lead : bool
            False: placed and adopted points are pinned, too.

        Raises
        ------
        PointRoleError
            A point is driven or watched.
        FreedomError
            Other coordinates than those it is free in.
        BadInputError
            A place and a vector, several points and a place, or not as many vectors as points.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> with hull.edit("5 mm out") as edit:
        ...     edit.move(["WL 2.5 x ST 7", "WL 2.5 x ST 8"], by=(0, 0.005, 0))
        >>> hull.undo()
        """
        asked = {"x": x, "y": y, "z": z}
        given = {
            axis: number(value, axis, "in move")
            for axis, value in asked.items()
            if value is not None
        }
        if isinstance(point, str) or not isinstance(point, Sequence):
            point, several = (point,), False
        else:
            several = True
        if (by is None and several) or (by is not None and given):
            what = "several points to one place" if by is None else "coordinates, and by= as well"
            remedy = "give one point and its coordinates, or points and by=(x, y, z)"
            raise BadInputError(what, "in move", remedy)
        rows = [self._given.point(each)[0] for each in point]
        put = _lead.put if flag(lead, "lead", "in move") else _lead.put_pinned
        with self._transaction.whole() as held:
            if by is None:
                _points.move(held, rows[0], given, put)
            else:
                _points.move_by(held, rows, places(by, "by", "in move"), put)

    @recorded
    def insert(self, curve: Curve | str, place: ArrayLike, *, lead: bool = True) -> Point:
        """Insert a placed point at (x, y, z), m; it is never moved by an update.

        A place off the curve, by more than 1e-5 Lpp, leads the line there, see `lead`; in the plane
        of a crossing line it is asked of that crossing, which is given. On boundary curves, flats
        and the profile, and with ``lead=False``, the point is pinned: the curve bends between its
        neighbours.
        """
        number, leads = self._given.curve(curve), flag(lead, "lead", "in insert")
        with self._transaction.whole() as held:
            row = (_lead.insert if leads else _lead.insert_pinned)(held, number, place)
        return Point.of(self._tables, row)

    @recorded
    def delete(self, point: Point | str) -> None:
        """Delete a placed or adopted point."""
        _points.delete(self._transaction, self._given.point(point)[0])

    @recorded
    def set_kind(
        self, point: Point | str, kind: str, *, direction: ArrayLike | None = None
    ) -> None:
        """Make a point ``"smooth"``, ``"tangent"`` or ``"knuckle"`` on the curve it lies on."""
        row, side = self._given.point(point)
        _points.set_kind(self._transaction, row, side, kind, direction)

    @recorded
    def pin(self, point: Point | str) -> None:
        """Make an adopted point a placed one."""
        _points.pin(self._transaction, self._given.point(point)[0])

    @recorded
    def unpin(self, point: Point | str) -> None:
        """Make a placed point an adopted one."""
        _points.unpin(self._transaction, self._given.point(point)[0])

    @recorded
    def pull(
        self,
        point: Point | str,
        d: float,
        radius: tuple[float, float] | None = None,
        *,
        across_flats: bool = False,
        fair: bool = False,
    ) -> None:
        """Pull the hull at a point along its normal; points around follow, less and less.

        Parameters
        ----------
        point : Point, Crossing or address
            Where. Of a crossing both curves are pulled.
        d : float, m
            By how much, + outward.
        radius : (float, float) or None, m
            How far the pull reaches along the ship and along the girth of sections; nothing beyond
            moves. None: three times the distance of the points around it, which is little where
            lines are dense.
        across_flats : bool
            Whether points on the flats of side and bottom move as well.
        fair : bool
            Whether the hull around answers as fairly as it was, see `reshape`; the radius is where
            the search for that answer begins.

        Raises
        ------
        PointRoleError
            The point lies on the profile, or on a flat that is not to move.
        BadInputError
            A radius that is not above 0; `fair` and `across_flats` at once.
        UnknownNameError, ForeignPointError
            There is no such point; a point of another hull.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> with hull.edit("fuller shoulder") as edit:
        ...     edit.pull("WL 2.5 x ST 12", 0.02, radius=(20.0, 5.0))
        >>> round(1e3 * edit.report.largest_normal.distance, 1)
        20.0
        """
        row, _ = self._given.point(point)
        flag(across_flats, "across_flats", "in pull")
        _pull.pull(
            self._transaction, row, number(d, "d", "in pull"), radius, across_flats=across_flats,
            fair=flag(fair, "fair", "in pull"),
        )  # fmt: skip

    @recorded
    def reshape(
        self,
        curve: Curve | str,
        points: ArrayLike,
        *,
        span: tuple[float, float],
        fade: Literal["auto"] | tuple[float, float] | None = "auto",
        across_flats: bool = False,
        fair: bool = False,
    ) -> tuple[Point, ...]:
        """Give a curve a new shape through points (k, 3), m, within a span; the hull follows.

        With ``fair=True`` the curve passes the points, and it and all around answer with the least
        change of their batten residuals: no line gains a wave, where such an answer is found;
        the report names those that do. All that one edit asks for fairly is answered at once.

        Returns the placed points that were made.
        """
        flag(across_flats, "across_flats", "in reshape")
        made = _reshape.reshape(
            self._transaction,
            self._given.curve(curve),
            points,
            span,
            fade,
            across_flats=across_flats,
            fair=flag(fair, "fair", "in reshape"),
        )
        return tuple(Point.of(self._tables, row) for row in made)

    @recorded
    def lead(
        self,
        line: Line | Curve | str,
        points: ArrayLike | Sequence[ArrayLike | tuple[Point | str, ArrayLike]],
        span: tuple[float, float] | None = None,
    ) -> tuple[Point, ...]:
        """Lead a line through places; all lines around follow as fairly as they were.

        The line keeps its points and roles; its crossings in the stretch give up their values.
        What one edit leads, several lines too, is one solve with what it pulls or re-shapes
        fairly; the report says what led, over which stretch, and what followed by how much.

        Parameters
        ----------
        line : Line, Curve or str
            A section, waterline, buttock or diagonal.
        points : sequence of (3,) m, or of (Point or str, (3,) m)
            Each a place ``(x, y, z)`` in the plane of the line, or a pair of a crossing, a placed
            or an adopted point of the line and the place where it is to come. A place in the
            plane of a crossing line is asked of that crossing; other places become placed points,
            and so do adopted ones.
        span : (float, float) or None, m
            Where the line may change: x, or z of a section. None: out to placed points, knuckles,
            tangent points, flats or ends.

        Returns
        -------
        tuple of Point
            The placed points that were made.

        Raises
        ------
        BadInputError
            Places off the plane of the line or of a crossing, beyond its ends or outside the span;
            points of another line; a place beside a placed point; a boundary curve.
        PointRoleError
            A crossing that another line drives, a point on a flat or on the profile, or one that
            can move almost along the hull only.
        RefusedEditError
            When the edit ends: no answer that was tried is sound.

        Notes
        -----
        docs/leading.md tells what a lead does, docs/fair_edits_method.md how it is solved.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> x, y, z = hull["WL 2.5 x ST 7"].position
        >>> with hull.edit("5 mm out, and the hull with it") as edit:
        ...     edit.lead("WL 2.5", [("WL 2.5 x ST 7", (x, y + 0.005, z))])
        ()
        >>> bool(hull["WL 2.5 x ST 7"].y - y > 0.00499), len(edit.report.led)
        (True, 1)
        """
        given = self._given
        asked = [given.led_point(each) for each in all_of(points, object, "points", "in lead")]
        with self._transaction.whole() as held:
            made = _lead.lead(held, given.pieces(line), asked, span)
        return tuple(Point.of(self._tables, row) for row in made)

    @recorded
    def fair(
        self,
        lines: Sequence[Group | Line | str] | None = None,
        *,
        noise: float | Literal["auto"] | None = None,
        tolerance: float | Mapping[Line | Point | str, float] | None = None,
        at: Point | str | ArrayLike | None = None,
        radius: tuple[float, float] | None = None,
        keep: Sequence[Line | Point | str] = (),
        hold: Sequence[Literal["volume", "lcb"]] = (),
        since: str | None = None,
    ) -> Faired:
        """Take noise out of the lines, all together while they stay crossing.

        Points that carry the shape move, each along its own freedom, and no farther than the
        noise lets them; placed points, flats, features and the profile stay. Each move counts
        from the value that a point was given, so that to fair twice is to fair once.

        Parameters
        ----------
        lines : sequence of Group, Line or str, or None
            The lines whose points may move; None: all.
        noise : float, "auto" or None, m
            The standard deviation of the noise, as offsets are read; ``"auto"`` estimates it;
            None: that of rounding, where all half-breadths of the hull are rounded to one unit.
        tolerance : float, mapping or None, m
            How far points may move along their freedom, all or by line or point; three times
            the noise if None.
        at : Point, address or (x, y, z) in m, or None
            The middle of a window, outside of which nothing moves.
        radius : (float, float) or None, m
            How far the window reaches along the length and the girth.
        keep : sequence of Line, Point or str
            What stays besides.
        hold : sequence of "volume" or "lcb"
            What the hull is to have as before, at the design draught.
        since : str or None
            A checkpoint: points count as given where they were then.

        Returns
        -------
        Faired
            What was found; it is carried out when the edit ends.

        Raises
        ------
        BadInputError
            Nothing can move; the noise is not known or cannot be told from the shape; a tolerance
            below half the noise; a number that is not above 0, a radius without a place; volume
            or centre that cannot be held.
        UnknownNameError
            No such line, point or checkpoint.

        Notes
        -----
        docs/fairing_method.md tells the method. Waves longer than about six points are shape to it,
        and stay.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> with hull.edit("fair") as edit:
        ...     found = edit.fair(noise=0.001)
        >>> found.unknowns, found.at_bound
        (171, ())
        """
        # What solves sparse systems is imported by whoever fairs a hull.
        from assoc_hull.edit.fair_arguments import fair_request
        from assoc_hull.edit.modifications.fair import fair

        asked = fair_request(self._tables, lines, noise, tolerance, at, radius, keep, hold, since)
        return fair(self._transaction, asked)

    @recorded
    def straighten(
        self,
        line: Line | Curve | str,
        a: Point | str,
        b: Point | str,
        *,
        fade: Literal["auto"] | tuple[float, float] = "auto",
    ) -> None:
        """Let a line run straight from one of its points to another; the hull follows.

        Parameters
        ----------
        line : Line, Curve or str
            A section, waterline, buttock or diagonal.
        a, b : Point or str
            Two points that define it. They stay, and become tangent points along the run.
        fade : "auto" or (r_x, r_g), m
            How the change of the hull fades along the length and the girth, as in `reshape`.

        Raises
        ------
        BlockedRunError
            Placed points, a feature, a flat or the centre plane in the run.
        BadInputError
            Points that are not on the line, or too near one another.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> with hull.edit("straight") as edit:
        ...     edit.straighten("WL 2.5", "WL 2.5 x ST 4", "WL 2.5 x ST 7")
        >>> hull.features["WL 2.5 straight"].kind
        'straight'
        """
        points = self._given.point(a)[0], self._given.point(b)[0]
        with self._transaction.whole() as held:
            _draw.straighten(held, self._given.line_of(line), points, fade)

    @recorded
    def round(
        self,
        line: Line | Curve | str,
        a: Point | str,
        b: Point | str,
        *,
        radius: float,
        fade: Literal["auto"] | tuple[float, float] = "auto",
    ) -> None:
        """Let a line turn from one side to another in an arc that touches both; the hull follows.

        Parameters
        ----------
        line, a, b, fade
            As for `straighten`. The sides are the straight lines along which the line comes to
            its first point and leaves its second; a knuckle between them gives way.
        radius : float, m
            Of the arc.

        Raises
        ------
        BlockedRunError, BadInputError
            As `straighten`.
        GeometryError
            The sides do not meet in a corner, or the arc does not fit; with the radius that does.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> with hull.edit("round") as edit:
        ...     edit.round("ST 10", "ST 10 x WL 0.625", "ST 10 x WL 5.625", radius=5.5)
        >>> hull.features["ST 10 arc"].parameters["radius"]
        5.5
        """
        points = self._given.point(a)[0], self._given.point(b)[0]
        size = positive(radius, "radius", "in round")
        with self._transaction.whole() as held:
            _draw.round_corner(held, self._given.line_of(line), points, size, fade)

    @recorded
    def spread(
        self,
        point: Point | str,
        *,
        length: float,
        fade: Literal["auto"] | tuple[float, float] = "auto",
    ) -> None:
        """Make the hollow or the bump of a line at a point longer and shallower.

        Its area stays (the area between the old and the new line is zero), and its ends are tangent
        to the line; the hull follows.

        Parameters
        ----------
        point : Point or str
            A point of the line in the hollow; ``"WL 1 x ST 3"`` is one of WL 1.
        length : float, m
            The new length, along the line that touches both sides of the hollow.
        fade : "auto" or (r_x, r_g), m
            As in `reshape`.

        Raises
        ------
        BadInputError
            The line has no hollow or bump there, or the length reaches beyond an end of it.
        OutOfRangeError
            The hollow is as long already, or would not be shallower.
        BlockedRunError
            Placed points, a feature, a flat or the centre plane within the length.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> with hull.edit("a dent") as edit:
        ...     edit.move("WL 2.5 x ST 7", by=(0, -0.1, 0))
        >>> with hull.edit("longer") as edit:
        ...     edit.spread("WL 2.5 x ST 7", length=40.0)
        """
        row, side = self._given.point(point)
        size = positive(length, "length", "in spread")
        with self._transaction.whole() as held:
            _spread.spread(held, row, side, size, fade)

    @recorded
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
            self._transaction, self._given.curve(curve), end, tangent=tangent, curvature=curvature
        )

    @recorded
    def set_role(self, crossing: Point | Crossing | str, role: str | None) -> None:
        """Override what a crossing defines; None gives it back to the rule."""
        if isinstance(crossing, Crossing):
            row = self._given.place(crossing).row
        else:
            row, _ = self._given.point(crossing)
        _set_role.set_role(self._transaction, row, role)

    @recorded
    def renew_roles(self, lines: Sequence[Line | str]) -> int:
        """Apply the role rule again to all crossings of lines; gives how many changed."""
        if isinstance(lines, (str, Line)) or not isinstance(lines, Sequence):
            what = f"the lines are {shown(lines)}"
            raise WrongTypeError(what, "in renew_roles", "give a list of lines")
        return _renew.renew_roles(self._transaction, [self._given.line(line) for line in lines])

    @recorded
    def associate(self, a: Group | str, b: Group | str, *, two_way: bool = True) -> None:
        """Declare that a generates points on b, and b on a if two-way."""
        first, second = self._given.group(a), self._given.group(b)
        _associate.associate(self._transaction, first, second, two_way=two_way)

    @recorded
    def rule(
        self, a: Group | Line | str, b: Group | Line | str,
        where: Sequence[tuple[Group | Line | str | None, Mapping[str, Bounds]]],
    ) -> None:  # fmt: skip
        """Say which of two groups or lines rules where; no curve moves by a bit.

        Where one rules, its lines generate points on those of the other and take none from them.
        What is said takes the place of what was said of the two before; an empty list takes it
        back, and `associate` and `dissociate` of their groups do.

        Parameters
        ----------
        a, b : Group, Line or str
            The two; their groups are associated.
        where : sequence of (Group, Line, str or None, mapping)
            Who rules, `a` or `b` or None for both, and in which box: bounds by ``"x"``, ``"y"`` and
            ``"z"`` as (from, to), m, None for no bound. A crossing belongs to the first box that
            holds it, on a border to the lower one; in no box it follows the association.

        Raises
        ------
        BadInputError
            Two that do not meet, somebody else who rules, or bounds that are none.
        UnknownNameError
            No such group or line.
        RingError
            When the edit ends, if lines would drive one another in a ring.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> with hull.edit("waterlines rule the stern") as edit:
        ...     edit.rule("waterlines", "sections", [("waterlines", {"x": (None, 40.0)})])
        >>> hull.crossings["WL 2.5 x ST 7"].role, hull.crossings["WL 2.5 x ST 12"].role
        ('drives a', 'shared')
        """
        given = self._given
        first, second = given.group_or_line(a), given.group_or_line(b)
        if isinstance(where, (str, Mapping)) or not isinstance(where, Sequence):
            what = f"where is {shown(where)}"
            raise WrongTypeError(what, "in rule", "give a list of (who rules, box)")
        rulings = given.rulings(first, second, where)
        with self._transaction.whole() as held:
            _associate.rule(held, first, second, rulings)

    @recorded
    def group(self, name: str, lines: Sequence[Group | Line | str]) -> Group:
        """Make a group of one's own of lines and groups, for instance ``"stern lines"``.

        It may be named wherever lines are: in `rule`, as drivers, in `fair`, in pictures.

        Parameters
        ----------
        name : str
            What it is called.
        lines : sequence of Group, Line or str
            What it holds. A line may be in several groups; one that is removed leaves them.

        Raises
        ------
        NameTakenError
            A group, a line or a point has the name.
        BadInputError
            A name that is empty or could be read as an address; nothing in it, or one thing twice.
        UnknownNameError
            No such line or group.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> with hull.edit("groups") as edit:
        ...     _ = edit.group("stern lines", ["ST 1", "ST 2", "WL 2.5"])
        ...     _ = edit.group("all of it", ["stern lines", "buttocks"])
        >>> [each.name for each in hull.groups["stern lines"].members]
        ['ST 1', 'ST 2', 'WL 2.5']
        >>> hull.groups["stern lines"].container
        <Group all of it>
        """
        title = line_name(name)
        members = self._given.members(lines, "in group")
        return Group.of(self._tables, _groups.group(self._transaction, title, members))

    @recorded
    def regroup(self, group: Group | str, lines: Sequence[Group | Line | str]) -> None:
        """Let a group of one's own hold other lines and groups.

        Where it rules, crossings of the lines that it gains or loses are switched.

        Raises
        ------
        BadInputError
            The group of a family, or one that would hold itself, with the path.
        UnknownNameError
            No such group or line.
        """
        members = self._given.members(lines, "in regroup")
        with self._transaction.whole() as held:
            _groups.regroup(held, self._given.group_or_line(group), members)

    @recorded
    def ungroup(self, group: Group | str) -> None:
        """Take a group of one's own away; its lines stay.

        Raises
        ------
        BadInputError
            The group of a family, or one that a ruling names.
        UnknownNameError
            No such group.
        """
        with self._transaction.whole() as held:
            _groups.ungroup(held, self._given.group_or_line(group))

    @recorded
    def dissociate(self, a: Group | str, b: Group | str) -> None:
        """Take an association back."""
        _associate.dissociate(self._transaction, self._given.group(a), self._given.group(b))

    @recorded
    def set_form(self, /, definition: FormDefinition | str, **values: float | None) -> None:
        """Give a definition other values; all that is generated from it follows.

        Parameters
        ----------
        definition : FormDefinition or str
            The definition, its name or its use.
        **values : float or None
            As `FormDefinition.values` names them; of the curve of sectional areas also ``cb``,
            ``cp`` and ``lcb`` (m from midship, forward positive), of the design waterline
            ``cw`` and ``lcf``: the entrance then closes the curve.

        Raises
        ------
        UnknownNameError
            The hull has no such definition, or this no such value.
        BadInputError, OutOfRangeError
            A number that is not finite, or a curve that cannot be made.
        """
        _set_form.set_form(self._transaction, definition, values)

    @recorded
    def reattach(self, line: Line | str) -> None:
        """Let the points of a line come from the definitions again.

        Raises
        ------
        BadInputError
            No definition makes it, or a point was placed on it.
        """
        _reattach.reattach(self._transaction, self._given.line(line))

    @recorded
    def rename(self, obj: object, name: str) -> None:
        """Give a line, a point, a tunnel, a body or the hull itself another name; keys stay.

        Parameters
        ----------
        obj : Line, Point, Crossing, Curve, address, name of a tunnel or body, the hull or None
            A curve is renamed with its line, whose only one it must be. Groups keep their
            names. None stands for the hull.
        name : str
            The name.
        """
        if obj is None or getattr(obj, "document", None) is self._held.document:
            _rename.rename_hull(self._transaction, name)
            return
        if isinstance(obj, str) and _attachments.is_attachment(self._tables, obj):
            _attachments.rename_attachment(self._transaction, obj, line_name(name))
            return
        _rename.rename(self._transaction, self._given.place(obj), name)

    @recorded
    def set_particulars(
        self, *, draught: float | None = None, deck: Literal["open", "closed"] | None = None
    ) -> None:
        """Say at which draught the ship is to float, and whether she has a deck; no line moves.

        `Hull.vary` changes the form with the draught, and length, breadth and depth, which are
        those of the lines; `rename` gives another name.

        Parameters
        ----------
        draught : float or None, m
            The moulded design draught, from the base line; None: as it is.
        deck : {"open", "closed"} or None
            Closed: a deck between the deck edges keeps water out; None: as it is.

        Raises
        ------
        OutOfRangeError
            A draught above the highest point of the hull.
        BadInputError
            Nothing is given; another word for the deck; a draught for lines that are made from
            form parameters, which hold below their design draught.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> with hull.edit("scantling draught, deck") as edit:
        ...     edit.set_particulars(draught=6.8, deck="closed")
        >>> hull.particulars.draught, hull.particulars.deck
        (6.8, 'closed')
        """
        with self._transaction.whole() as held:
            _rename.set_particulars(held, draught, deck)

    @recorded
    def add_line(
        self, group: Group | str, position: float | tuple[float, float], name: str | None = None
    ) -> Line:
        """Cut a new line at a position (m) along its family's axis.

        Without a name it is called as its group counts: ``WL 0.478`` among waterlines in parts of
        the draught, ``ST 5.413`` among stations, ``BTK 2.5`` where names are metres.

        A diagonal takes ``(height, angle)``: where its plane meets the centre plane, m, and by
        how many degrees it falls outward from the horizontal.
        """
        if isinstance(group, str):
            found = self._given.group_named(group)
            title = group if found is None else self._given.group(found)
        else:
            title = self._given.group(group)
        line = _cut.add_line(self._transaction, title, position, name)
        return Line.of(self._tables, line)

    @recorded
    def shift_line(self, line: Line | str, position: float) -> None:
        """Shift a line to another position (m); the hull keeps its shape.

        A diagonal keeps its angle; its position is the height at the centre plane.
        """
        _shift.shift_line(self._transaction, self._given.line(line), number(position, "position"))

    @recorded
    def remove_line(self, line: Line | str) -> None:
        """Remove a line; what it held stays behind as adopted points."""
        _lines.remove_line(self._transaction, self._given.line(line))

    @recorded
    def knuckle_line(self, name: str, points: Sequence[Point | str]) -> Line:
        """Draw a knuckle line through points of neighbouring sections.

        It is a boundary curve. The sections turn in a knuckle at it, and so do lines that pass
        it between sections; `remove_knuckle_line` makes all smooth again.

        Parameters
        ----------
        name : str
            Of the line.
        points : sequence of Point or str
            A point of each of three or more neighbouring sections, in any order: crossings,
            placed or adopted points.

        Raises
        ------
        BadInputError
            Too few points, points of no section or two of one, a section left out between two.
        BlockedRunError
            Points that cannot become knuckles, as the end of a section or one on a flat.
        NameTakenError
            There is a line of that name.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> with hull.edit("chine") as edit:
        ...     line = edit.knuckle_line("chine", [f"ST {x} x WL 2.5" for x in (6, 7, 8)])
        >>> hull.features["chine"].kind
        'knuckle'
        """
        if isinstance(points, str | Point) or not isinstance(points, Sequence):
            what = f"the points are {shown(points)}"
            raise WrongTypeError(what, "in knuckle_line", "give a list of points")
        rows = [self._given.point(each)[0] for each in points]
        with self._transaction.whole() as held:
            return Line.of(self._tables, _knuckles.knuckle_line(held, name, rows))

    @recorded
    def remove_knuckle_line(self, line: Line | str) -> None:
        """Take a knuckle line away: what it split is smooth again, through the points of before.

        Raises
        ------
        BadInputError
            It is another kind of line.
        """
        with self._transaction.whole() as held:
            _knuckles.remove_knuckle_line(held, self._given.line(line))

    @recorded
    def tunnel(self, name: str, *, x: float, z: float, radius: float) -> None:
        """Keep a tunnel athwartships through the hull, as a bow thruster has.

        Hydrostatics take off what of it is immersed, the lines plan shows its mouth. The mouth is
        where the cylinder meets the shell, whatever becomes of that; a mapping and a variation
        carry the middle of the axis, and the radius stays. `Hull.tunnel` only measures.

        Parameters
        ----------
        name : str
            What it is called.
        x, z, radius : float, m
            As `Hull.tunnel` takes them.

        Raises
        ------
        NameTakenError
            A group, a line, a point, a tunnel or a body has the name.
        OutOfRangeError
            x lies outside the ship.
        BadInputError
            A name that is none, a radius that is not above 0; the mouth leaves the hull below,
            above or at its ends; another tunnel is met.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> bare = hull.hydrostatics(draught=6.25).volume
        >>> with hull.edit("bow thruster") as edit:
        ...     edit.tunnel("bow thruster", x=88.0, z=3.0, radius=0.8)
        >>> print(hull["bow thruster"])
        bow thruster: 1.6 m across at x 88, z 3 m: 6.15981 m3, wall 15.3104 m2, openings 4.28877 m2
        >>> round(bare - hull.hydrostatics(draught=6.25).volume, 5)
        6.15981
        """
        with self._transaction.whole() as held:
            _tunnels.add_tunnel(held, line_name(name), x, z, radius)

    @recorded
    def set_tunnel(
        self, name: str, *, x: float | None = None, z: float | None = None,
        radius: float | None = None,
    ) -> None:  # fmt: skip
        """Give a tunnel another axis or radius, as `tunnel` takes them; what is not given stays.

        Raises
        ------
        UnknownNameError
            There is no tunnel of that name.
        OutOfRangeError, BadInputError
            As for `tunnel`; or nothing is given.
        """
        with self._transaction.whole() as held:
            _tunnels.set_tunnel(held, name, x, z, radius)

    @recorded
    def remove_tunnel(self, name: str) -> None:
        """Take a tunnel away; `UnknownNameError` if there is none of that name."""
        with self._transaction.whole() as held:
            _attachments.remove(held, TunnelDefinition, name)

    @recorded
    def body(
        self,
        name: str,
        group: str,
        *,
        x: tuple[float, float] | None = None,
        y: tuple[float, float] | None = None,
        z: tuple[float, float] | None = None,
        sections: ArrayLike | None = None,
        corners: ArrayLike | None = None,
        both: bool = False,
        sign: float = 1,
    ) -> None:
        """Put a body beside the net: a hatch, a deck house, a skeg, a sea chest.

        It stands where it is put: no line moves, and hydrostatics do not see it. The lines plan
        and closed meshes have it; a mapping and a variation carry its points.

        Parameters
        ----------
        name : str
            What it is called.
        group : str
            What it is one of, as ``"hatches"``, ``"deck houses"``, ``"boxes"``, ``"appendages"``.
        x, y, z : (float, float) or None, m
            A box between two places from AP, from the centre plane (port above 0) and from the
            base line.
        sections : (k, m, 3) or None, m
            Instead of a box: two or more closed sections from aft forward, of as many points each.
            The body is straight from each to the next.
        corners : (n,) or None
            Numbers of points of a section, from 0, at which an edge runs along; all if None.
        both : bool
            Its mirror image stands on the other side.
        sign : {1, -1}
            1 stands on the hull; -1 is taken from it, as a sea chest is.

        Raises
        ------
        NameTakenError
            A group, a line, a point, a tunnel or a body has the name.
        BadInputError
            A name that is none, no shape, sections that run aft or enclose nothing, a body on
            both sides that crosses the centre plane.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> with hull.edit("hatch") as edit:
        ...     edit.body("hatch 1", "hatches", x=(40, 52), y=(-3, 3), z=(10, 11.2))
        >>> print(hull["hatch 1"])
        hatch 1: hatches, x 40 to 52, y -3 to 3, z 10 to 11.2 m, 86.4 m3
        """
        shape = _bodies.BodyShape(sections, x, y, z, corners, both, sign)
        with self._transaction.whole() as held:
            _bodies.add_body(held, line_name(name), group, shape)

    @recorded
    def set_body(
        self,
        name: str,
        *,
        by: ArrayLike | None = None,
        group: str | None = None,
        x: tuple[float, float] | None = None,
        y: tuple[float, float] | None = None,
        z: tuple[float, float] | None = None,
        sections: ArrayLike | None = None,
        corners: ArrayLike | None = None,
        both: bool | None = None,
        sign: float | None = None,
    ) -> None:
        """Move a body, or give it another shape or group; what is not given stays.

        Parameters
        ----------
        name : str
            Of the body.
        by : (3,) or None, m
            How far it is to go.
        x, y, z : (float, float) or None, m
            From where to where it is to reach; it is stretched along these axes.
        group, sections, corners, both, sign
            As `body` takes them.

        Raises
        ------
        UnknownNameError
            There is no body of that name.
        BadInputError
            As for `body`; or nothing is given, or both a movement and a new place.
        """
        shape = _bodies.BodyShape(sections, x, y, z, corners, both, sign)
        with self._transaction.whole() as held:
            _bodies.set_body(held, name, by, group, shape)

    @recorded
    def remove_body(self, name: str) -> None:
        """Take a body away; `UnknownNameError` if there is none of that name."""
        with self._transaction.whole() as held:
            _attachments.remove(held, AttachedBody, name)

    @recorded
    def transform(
        self,
        mapping: PointMapping | None = None,
        drivers: Sequence[Group | Line | str] = (),
        *,
        scale: ArrayLike | None = None,
        shift: ArrayLike | None = None,
        planes: Literal["stay", "follow"] = "stay",
        jacobian: Jacobian | None = None,
        tolerance: float | None = None,
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
        scale, shift : float or (3,), (3,), m
            Instead of a mapping: a factor about the origin, or one along each axis, then a shift.
        planes : {"stay", "follow"}
            Followers are cut again at their own planes, or at parallel ones where the
            mapping sends their planes to such.
        jacobian : callable or None
            Gives d mapping_i / d x_j as (n, 3, 3); central differences over 1 mm if None.
        tolerance : float or None, m
            How far a driver may leave its exact image; adopted points hold it. None: 2 mm, of a
            hull under 100 m less in proportion.

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
        particulars stay as they are, and so do the names of lines: a pure shift says in
        ``edit.step`` how many lines that go by a number it moved.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> hull = ah.examples.wigley()
        >>> with hull.edit("10 % broader") as edit:
        ...     edit.transform(lambda p: p * [1, 1.1, 1], drivers=["sections", "profile"])
        >>> hull.half_breadth(50.0, 6.25)
        5.5
        """
        space = space_map(mapping, jacobian, scale, shift)
        follow = choice(planes, "planes", ("stay", "follow"), "in transform") == "follow"
        _transform.transform(
            self._transaction, space, self._given.driving(drivers), follow=follow,
            tolerance=(
                None if tolerance is None else positive(tolerance, "tolerance", "in transform")
            ),
        )  # fmt: skip
