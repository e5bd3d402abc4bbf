"""A length of parallel body inserted, or taken out: a ship is cut open, and both its ends stay.

What lies forward of the cut moves as a whole; nothing of it is laid out, mapped or cut again. The
section at the cut is copied to where the fore part begins now, so that the piece between is a
cylinder, and lines that are drawn along the ship keep the tangents that they have at the cut: both
parts keep their shape. Where lines are not quite parallel at the cut, they swing within the new
piece.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Literal

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.floating_body import StationAreas
from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import hydrostatics
from assoc_hull.arguments import choice, number, text
from assoc_hull.display import ShownAsText
from assoc_hull.edit.crossings.adopted_points import insert_defining_point
from assoc_hull.edit.document import Document
from assoc_hull.edit.lines.add_line import add_line, copy_section
from assoc_hull.edit.lines.remove_line import remove_line
from assoc_hull.edit.modifications.names import rename_lines
from assoc_hull.edit.recut.transform import transform
from assoc_hull.edit.space_map import SpaceMap
from assoc_hull.edit.step import EditReport
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray, PointKind
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.splines.segments import derivative
from assoc_hull.model.kinds import Sort
from assoc_hull.model.make_objects import PointSpec
from assoc_hull.model.tables import CurveIntersections, HullState
from assoc_hull.variation.parameters.measurement import DrawnCurves
from assoc_hull.variation.parameters.midship_measures import parallel_body_start

__all__ = ["JumboiseReport", "Names", "jumboise_document"]

Names = Literal["keep", "number"]
"""What becomes of the names of sections: they stay, or are numbered by the new length."""

_WHERE = "in jumboise"

_STEEPEST = 0.2
"""Degrees; without a parallel body, waterlines may leave the parallel by so much at the cut."""

_LEAST = 0.1
"""Times `Tolerances.factor`: so many m must be inserted or taken out, and be left of the body;
sections that come nearer become one."""

_PARALLEL = 1e-9
"""A unit tangent as near as this to the direction of the ship is that."""

_AT = 1e-6
"""m: a section as near as this to a place stands there."""

_NEAR = 0.25
"""A section nearer to the next than this part of the spacing is not added."""

_STATIONS = 20
"""Stations in Lpp, by which sections are numbered."""

_MISNAMED = 0.01
"""A number is that of a place if it differs from it by no more than this part of its unit."""

_ANY = 1e5
"""m: lines are held to no image, as they are to keep their own shape."""


@attrs.frozen(repr=False)
class JumboiseReport(ShownAsText):
    """What was inserted or taken out.

    Attributes
    ----------
    length : float, m
        Inserted; below 0: taken out.
    at : float, m
        The cut, from AP: what lies forward of it has moved by `length`.
    section : str
        The section at the cut.
    area : float, m2
        Of that section up to the design draught.
    volume, lcb : (float, float), m3 and m from AP
        Before and after, at the design draught.
    moved_off : float, m
        The farthest that a point of the fore part lies from where a rigid movement takes it, or one
        of the after part from where it was: 0, but for points that are computed from curves.
    added, removed : tuple of str
        Names of sections.
    renamed : mapping of str to str
        New names of sections by those they had.
    edit : EditReport
        What changed, as of any edit.
    notes : tuple of str
        What else there is to know.
    """

    length: float
    at: float
    section: str
    area: float
    volume: tuple[float, float]
    lcb: tuple[float, float]
    moved_off: float
    added: tuple[str, ...]
    removed: tuple[str, ...]
    renamed: Mapping[str, str]
    edit: EditReport
    notes: tuple[str, ...] = ()

    @property
    def told(self) -> tuple[str, ...]:
        """What was done, in lines."""
        did = "inserted" if self.length > 0.0 else "taken out"
        grown = self.volume[1] - self.volume[0]
        lines = [
            f"{abs(self.length):.6g} m of parallel body {did} at {self.section} ({self.at:.6g} m)",
            f"volume {self.volume[0]:.6g} -> {self.volume[1]:.6g} m3: {grown:+.9g}, length times "
            f"section {self.length * self.area:+.9g}; LCB {self.lcb[0]:.6g} -> {self.lcb[1]:.6g} m",
        ]
        for word, names in (("added", self.added), ("removed", self.removed)):
            lines += [f"sections {word}: {', '.join(names)}"] if names else []
        if self.renamed:
            lines.append(f"{len(self.renamed)} sections numbered by the new length")
        return (*lines, *self.notes)

    def __str__(self) -> str:
        return "\n".join([*self.told, str(self.edit)])


@attrs.frozen(eq=False)
class _Body:
    """Where a hull is a cylinder: between two places; they are one where only a section is."""

    start: float
    end: float


@attrs.frozen(eq=False)
class _Zone:
    """What is stretched or squeezed: between its ends the hull is a cylinder.

    With ends in one place the fore part is taken off there.
    """

    aft: float
    fore: float
    by: float

    def __call__(self, xyz: FloatArray) -> FloatArray:
        """Map places, (n, 3), m."""
        found, x = np.array(xyz), xyz[:, 0]
        wide = self.fore - self.aft
        inside = (x > self.aft) & (x < self.fore)
        if wide > 0.0:
            found[inside, 0] = self.aft + (x[inside] - self.aft) * ((wide + self.by) / wide)
        ahead = x >= self.fore if wide > 0.0 else x > self.aft + 0.5 * _AT
        found[ahead, 0] = x[ahead] + self.by
        return found

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        """Give the derivatives, (n, 3, 3)."""
        found, wide = np.tile(np.eye(3), (len(xyz), 1, 1)), self.fore - self.aft
        if wide > 0.0:
            inside = (xyz[:, 0] > self.aft) & (xyz[:, 0] < self.fore)
            found[inside, 0, 0] = (wide + self.by) / wide
        return found


def jumboise_document(
    document: Document,
    length: object,
    at: object = None,
    *,
    names: object = "keep",
    name: object = None,
) -> JumboiseReport:
    """Insert or take out a length of parallel body in place, as one step that can be undone.

    The arguments and what is raised are those of `Hull.jumboise`.
    """
    by = number(length, "length", _WHERE)
    place = None if at is None else number(at, "at", _WHERE)
    how = choice(names, "names", ("keep", "number"), _WHERE)
    title = f"jumboise by {by:g} m" if name is None else text(name, "the name", _WHERE)
    with Transaction(document, title) as edit:
        state = edit.state
        least = _LEAST * state.tolerances.factor
        if abs(by) < least:
            raise BadInputError(
                f"a length of {by:g} m", _WHERE,
                f"give {least:g} m or more to insert, {-least:g} m or less to take out",
            )  # fmt: skip
        before, was = _measured(state), state.rows.xyz.data.copy()
        stations = flotation(state).stations(_design(state))
        lines, unit = set(state.live("lines").tolist()), _number_unit(state)
        body = _body(state, place)
        work = _Cut(edit, by, body)
        cut = work.insert(place) if by > 0.0 else work.take_out(place)
        # The names of what goes and comes are told as they were before numbering.
        added = [str(state.lines.name[each]) for each in cut.added]
        removed = [str(state.lines.name[each]) for each in sorted(lines & cut.removed)]
        section = str(state.lines.name[cut.line]) if cut.line >= 0 else f"x = {cut.x:.6g} m"
        renamed = _numbered(edit, unit) if how == "number" else {}
        edit.end_stage()
        after, off = _measured(state), _moved_off(state, was, cut.zone)
    area = _area(stations, body, cut.x)
    report = edit.report
    if report is None:
        raise BadInputError("an edit is open", _WHERE, "finish it before")
    notes = () if place is None or abs(place - cut.x) <= _AT else (
        f"cut at {section}, not at {place:.6g} m: "
        "the nearest section of the parallel body"
        + (" with room enough forward of it" if by < 0.0 else ""),
    )  # fmt: skip
    return JumboiseReport(
        by, cut.x, section, area, (before[0], after[0]), (before[1], after[1]), off,
        tuple(renamed.get(each, each) for each in added), tuple(removed), renamed, report, notes,
    )  # fmt: skip


# --------------------------------------------------------------------------------------
# Where a hull may be cut.


def _sections(state: HullState) -> dict[int, float]:
    """Give the sections that stand across the ship, with their places, m, from aft."""
    lines = [
        line for line in state.live("lines").tolist()
        if state.family(line).name == "sections" and state.lines.planar[line]
        and abs(float(state.lines.normal[line, 0])) == 1.0
    ]  # fmt: skip
    found = {line: float(state.lines.offset[line]) for line in lines}
    return dict(sorted(found.items(), key=lambda each: each[1]))


def _body(state: HullState, at: float | None) -> _Body:
    """Give where the hull is a cylinder, or refuse."""
    measured = parallel_body_start(DrawnCurves(state))
    if measured.value is not None:
        body = _Body(measured.numbers["start"], measured.numbers["end"])
        if at is not None and not body.start - _AT <= at <= body.end + _AT:
            raise OutOfRangeError(
                "at", at, _WHERE, "lies outside the parallel body", body.start, body.end, "m"
            )
        return body
    return _largest(state, at, measured.reason or "the hull has no parallel body")


def _largest(state: HullState, at: float | None, why: str) -> _Body:
    """Let the largest section stand for a parallel body, where waterlines are parallel there."""
    stations = flotation(state).stations(_design(state))
    area, where = stations.area[0], _sections(state)
    areas = {line: _nearest(stations.x, area, x) for line, x in where.items()}
    if not areas:
        raise BadInputError(why, _WHERE, "add sections: one is to be copied")
    largest = max(areas, key=lambda line: areas[line])
    x, title = where[largest], str(state.lines.name[largest])
    off = _steepest(state, largest)
    if off > _STEEPEST:
        raise BadInputError(
            f"{why}, and at the largest section, {title} at {x:.6g} m, waterlines leave the "
            f"parallel by {off:.3g} degrees", _WHERE,
            f"make them parallel there to {_STEEPEST:g} degrees, or vary length",
        )  # fmt: skip
    if at is None or abs(at - x) > _AT:
        raise BadInputError(
            why if at is None else f"{why}, and {at:.6g} m is not its largest section", _WHERE,
            f"give at={x:.10g}: there {title} stands, the largest section, where waterlines leave "
            f"the parallel by {off:.2g} degrees",
        )  # fmt: skip
    return _Body(x, x)


def _design(state: HullState) -> FloatingPlanes:
    return FloatingPlanes(np.array([state.particulars.draught]), np.zeros(1), np.zeros(1))


def _nearest(x: FloatArray, area: FloatArray, place: float) -> float:
    """Give the area of the station at a place, m2; nil if none stands there."""
    near = np.abs(x - place) <= _AT
    return float(area[near].max()) if near.any() else 0.0


def _area(stations: StationAreas, body: _Body, x: float) -> float:
    """Give the area (m2) of the station nearest to a place, of those of the body if it has any."""
    within = (stations.x >= body.start - _AT) & (stations.x <= body.end + _AT)
    some = np.flatnonzero(within) if within.any() else np.arange(len(stations.x))
    return float(stations.area[0][some[np.abs(stations.x[some] - x).argmin()]])


def _measured(state: HullState) -> tuple[float, float]:
    """Give volume (m3) and its centre (m from AP) at the design draught."""
    found = hydrostatics(_Tables(state), estimate=False, on_error="report")
    return float(found.volume or 0.0), float(found.lcb or 0.0)


@attrs.frozen
class _Tables:
    """Tables of a hull, in the form that is measured."""

    state: HullState


@attrs.frozen(eq=False)
class _Passage:
    """Where a curve that is drawn along the ship passes a section."""

    curve: int
    xyz: FloatArray
    tangent: FloatArray
    row: int


def _passages(state: HullState, line: int) -> list[_Passage]:
    """Give where curves pass a section; `row`: the point of the curve there, -1 for none."""
    found, x = list[_Passage](), float(state.lines.offset[line])
    for curve in state.live("curves").tolist():
        own = state.line_of(curve)
        if state.lines.planar[own] and abs(float(state.lines.normal[own, 0])) == 1.0:
            continue
        meets: CurveIntersections = state.curves.meets[curve]
        rows: list[int] = state.curves.rows[curve].tolist()
        for i in np.flatnonzero(meets.line == line).tolist():
            way = derivative(state.spline(curve), np.zeros(1, np.int64), meets.parameter[[i]])[0]
            way = way / np.sqrt((way * way).sum())
            ahead = np.array([math.copysign(1.0, float(way[0])), 0.0, 0.0])
            near = [
                each for each in rows if np.abs(state.rows.xyz[each] - meets.xyz[i]).max() < _AT
            ]
            row = int(meets.row[i])
            found.append(_Passage(
                curve, np.array([x, *meets.xyz[i][1:]]),
                ahead if np.abs(way - ahead).max() <= _PARALLEL else way,
                row if row in rows else next(iter(near), -1),
            ))  # fmt: skip
    return found


def _steepest(state: HullState, line: int) -> float:
    """Give how far waterlines leave the direction of the ship at a section, degrees."""
    found = [
        math.degrees(math.acos(min(1.0, abs(float(each.tangent[0])))))
        for each in _passages(state, line)
        if state.family(state.line_of(each.curve)).name == "waterlines"
    ]
    return max(found, default=0.0)


# --------------------------------------------------------------------------------------
# Cutting, moving, joining.


@attrs.frozen(eq=False)
class _Done:
    """Where a hull was cut, and the lines that came and went; -1 where no section stands."""

    x: float
    line: int
    zone: _Zone
    added: tuple[int, ...] = ()
    removed: frozenset[int] = frozenset()


@attrs.frozen(eq=False)
class _Cut:
    """A cut under way."""

    edit: Transaction
    by: float
    body: _Body

    def insert(self, at: float | None) -> _Done:
        """Insert a length forward of a section, and copy that to both its ends and between."""
        edit, state = self.edit, self.edit.state
        line = self._section(at)
        x = float(state.lines.offset[line])
        spacing = _spacing(state, line)
        bare = self._hold(line)
        zone = _Zone(x, x, self.by)
        self._move(zone)
        count = max(0, math.ceil(self.by / spacing - _NEAR) - 1)
        places = [spacing * (k + 1) for k in range(count)]
        places = [each for each in places if self.by - each > _NEAR * spacing]
        title, group = str(state.lines.name[line]), int(state.lines.group[line])
        added = [
            copy_section(edit, line, each, _copy_name(state, group, f"{title}+{each:g}"))
            for each in (*places, self.by)
        ]
        for curve, row in bare:
            self._adopt(curve, state.rows.xyz[row] + np.array([self.by, 0.0, 0.0]), row)
        return _Done(x, line, zone, tuple(added))

    def take_out(self, at: float | None) -> _Done:
        """Take out a length; sections within it go, and those that come together become one."""
        state, body, out = self.edit.state, self.body, -self.by
        room = body.end - body.start - _LEAST * state.tolerances.factor
        if out > room:
            raise OutOfRangeError(
                "length", self.by, _WHERE, "is more than the parallel body, which is "
                f"{body.end - body.start:.6g} m long, from {body.start:.6g} to {body.end:.6g} m",
                -max(room, 0.0), 0.0, "m",
            ) if room > 0.0 else BadInputError(
                f"{out:g} m cannot be taken out: there is no parallel body", _WHERE,
                "insert a length, or vary length",
            )  # fmt: skip
        where = _sections(state)
        middle = 0.5 * (body.start + body.end - out) if at is None else at
        x = min(max(middle, body.start), body.end - out - _LEAST * state.tolerances.factor)
        inside = {
            line: each for line, each in where.items()
            if body.start - _AT <= each <= body.end - out - _AT
        }  # fmt: skip
        line = min(inside, key=lambda each: abs(inside[each] - x), default=-1)
        x = where[line] if line >= 0 else x
        gone = {each for each, place in where.items() if x + _AT < place <= x + out + _AT}
        ahead = [each for each, place in where.items() if x + out + _AT < place <= body.end + _AT]
        if line >= 0 and ahead and where[ahead[0]] - x - out < _LEAST * state.tolerances.factor:
            gone.add(ahead.pop(0))
        beyond = ahead[0] if ahead else -1
        fore = where[beyond] if ahead else body.end
        abaft = [place for place in where.values() if body.start <= place <= x + _AT]
        aft = max([body.start, *abaft])
        for each in (line, beyond):
            if each >= 0:
                self._hold(each)
        for each in sorted(gone):
            remove_line(self.edit, each)
        self.edit.end_stage()
        zone = _Zone(aft, fore, self.by)
        self._move(zone)
        return _Done(x, line, zone, (), frozenset(gone))

    def _section(self, at: float | None) -> int:
        """Give the section of the body nearest to a place; one is cut where there is none."""
        state, body = self.edit.state, self.body
        place = 0.5 * (body.start + body.end) if at is None else at
        inside = {
            line: x for line, x in _sections(state).items()
            if body.start - _AT <= x <= body.end + _AT
        }  # fmt: skip
        if inside:
            return min(inside, key=lambda line: abs(inside[line] - place))
        group = next(
            name for name, family in zip(
                state.groups.name.data, state.groups.family.data, strict=True
            ) if family == "sections"
        )  # fmt: skip
        line = add_line(self.edit, group, place)
        self.edit.end_stage()
        return line

    def _hold(self, line: int) -> list[tuple[int, int]]:
        """Let lines that pass a section keep their tangents there, whatever comes beyond it.

        Gives curves with the points that were set on them where the section has none.
        """
        edit, state = self.edit, self.edit.state
        table, bare = state.rows, list[tuple[int, int]]()
        for each in _passages(state, line):
            row = each.row
            if row < 0:
                row = self._adopt(each.curve, each.xyz)
            if table.sort[row] != Sort.CROSSING:
                bare.append((each.curve, row))
            rows: list[int] = state.curves.rows[each.curve].tolist()
            side = int(table.curve[row, 0] != each.curve)
            kind, direction = table.kind[row].copy(), table.direction[row].copy()
            if row in (rows[0], rows[-1]) or kind[side] == PointKind.KNUCKLE:
                continue
            kind[side], direction[side] = PointKind.TANGENT, each.tangent
            if (kind != table.kind[row]).any() or (direction != table.direction[row]).any():
                edit.journal.put(table.kind, [row], kind[None])
                edit.journal.put(table.direction, [row], direction[None])
                edit.pending.structural = True
                edit.pending.curves.add(each.curve)
        edit.end_stage()
        return bare

    def _adopt(self, curve: int, place: FloatArray, like: int = -1) -> int:
        """Let a curve pass a place as it does at another of its points."""
        edit, table = self.edit, self.edit.state.rows
        spec = PointSpec(curve, place, Sort.ADOPTED)
        if like >= 0:
            kind, way = int(table.kind[like, 0]), table.direction[like, 0].copy()
            spec = attrs.evolve(spec, kind=kind, direction=way)
        row = int(edit.maker.points([spec])[0])
        insert_defining_point(edit.maker, curve, row)
        edit.pending.structural = True
        edit.pending.curves.add(curve)
        return row

    def _move(self, zone: _Zone) -> None:
        """Move the fore part, and the fore perpendicular with it."""
        edit, ship = self.edit, self.edit.state.particulars
        transform(
            edit, SpaceMap(zone, zone.jacobian), edit.state.live("lines").tolist(), tolerance=_ANY,
            particulars=attrs.evolve(ship, length=ship.length + self.by), keep_features=True,
        )  # fmt: skip
        edit.end_stage()


def _spacing(state: HullState, line: int) -> float:
    """Give how far the next section stands from one: the next forward, if there is one, m."""
    where = _sections(state)
    x = where[line]
    ahead = [place - x for place in where.values() if place > x + _AT]
    abaft = [x - place for place in where.values() if place < x - _AT]
    return min(ahead or abaft or [state.particulars.length / _STATIONS])


def _moved_off(state: HullState, was: FloatArray, zone: _Zone) -> float:
    """Give how far points lie from where the movement takes them, m, outside the zone."""
    live = state.live("rows")
    live = live[live < len(was)]
    x = was[live][:, 0]
    live = live[(x <= zone.aft) | (x >= zone.fore)]
    off = np.abs(state.rows.xyz[live] - zone(was[live]))
    return float(off.max()) if len(off) else 0.0


# --------------------------------------------------------------------------------------
# Names.


def _copy_name(state: HullState, group: int, wish: str) -> str:
    """Give a copy a name that is free: a copy made before may have the first, and has moved on."""
    lines = state.live("lines").tolist()
    taken = {str(state.lines.name[each]) for each in lines if state.lines.group[each] == group}
    marks = ("", *(f"({k})" for k in range(2, len(taken) + 3)))
    return next(wish + mark for mark in marks if wish + mark not in taken)


def _numbered(edit: Transaction, unit: float | None) -> dict[str, str]:
    """Give sections that go by numbers those of the new length; tell new names by old ones."""
    state, found = edit.state, dict[int, str]()
    step = unit or state.particulars.length / _STATIONS
    for line, x in _sections(state).items():
        *words, last = str(state.lines.name[line]).split(" ")
        name = " ".join([*words, f"{round(x / step, 3):g}"])
        if words and _value(last.partition("+")[0]) is not None and name != state.lines.name[line]:
            found[line] = name
    old = {line: str(state.lines.name[line]) for line in found}
    rename_lines(edit, found)
    edit.pending.structural = True
    return {old[line]: name for line, name in found.items()}


def _number_unit(state: HullState) -> float | None:
    """Give 1 m if sections are named by their places, None if by twentieths of Lpp."""
    step = state.particulars.length / _STATIONS
    numbers = [
        (value, x) for line, x in _sections(state).items()
        if (value := _value(str(state.lines.name[line]).split(" ")[-1])) is not None
    ]  # fmt: skip
    metres = sum(abs(value - x) <= _MISNAMED for value, x in numbers)
    twentieths = sum(abs(value - x / step) <= _MISNAMED for value, x in numbers)
    return 1.0 if metres > twentieths else None


def _value(word: str) -> float | None:
    try:
        return float(word)
    except ValueError:
        return None
