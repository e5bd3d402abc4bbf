"""Lines that lead: over which stretch each may change, and what followed it.

The stretch bounds a lead, it does not shape it: the answer dies out by itself. It runs along the
line from the points that are asked for to where the line is held: an end, a knuckle, a tangent
point, a flat, the profile, or a placed point with room enough before it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import attrs
import numpy as np

from assoc_hull.edit.displacement_field import on_flat, on_profile
from assoc_hull.edit.document import Document
from assoc_hull.edit.hull_normals import hull_normals
from assoc_hull.edit.step import SAME_MOVEMENT, Led, Step
from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind
from assoc_hull.model.address import address
from assoc_hull.model.kinds import Sort
from assoc_hull.model.tables import HullState

__all__ = ["LineLed", "NetBefore", "Stretch", "find_stretch", "second_doses"]

_ROOM = 2
"""So many free points of the line, at least, lie between an asked point and an end, if there are
so many: a stretch with less makes a dimple."""

_PART, _PART_OF_GIRTH = 0.1, 0.25
"""Of Lpp, and of a section: a placed point bounds no stretch that is shorter."""

_RIM = 0.3
"""Of the way from an end of the stretch to the next point that is asked for: there it fades."""

_TOLD = 0.5e-3
"""m; crossings that moved less are counted only."""


@attrs.frozen(eq=False)
class LineLed:
    """What an edit asks of one curve that leads.

    Attributes
    ----------
    name : str
        The line.
    curve : int
        The curve.
    rows, to : (k,) int, (k, 3), m
        Points that define it, and where they are to come.
    span : (float, float) or None, m
        The stretch where it was named: x; z of a section.
    """

    name: str
    curve: int
    rows: IntArray
    to: FloatArray
    span: tuple[float, float] | None

    def goals(self) -> dict[int, FloatArray]:
        """Give the places by point."""
        return dict(zip(self.rows.tolist(), self.to, strict=True))


@attrs.frozen(eq=False)
class Stretch:
    """Where a curve that leads may change.

    Attributes
    ----------
    along : {"x", "z", "girth"}
        What `ends` and `rim` are measured along.
    ends : (float, float), m
        Its ends.
    bounds : (float, float), m
        The same, but without bound where the end of the curve takes part.
    rim : (float, float), m
        How far from each the change fades.
    room : int
        Free points of the curve on the side that has fewer.
    stayed : (k,) int
        Placed points in it that are not asked for.
    """

    along: str
    ends: tuple[float, float]
    bounds: tuple[float, float]
    rim: tuple[float, float]
    room: int
    stayed: IntArray


def find_stretch(state: HullState, led: LineLed, asked: IntArray, free: IntArray) -> Stretch:
    """Give the stretch of a line; `asked` are all points that are asked for, `free` may move."""
    order: IntArray = state.curves.rows.data[led.curve]
    mine = np.flatnonzero(np.isin(order, led.rows))
    section = state.family(state.line_of(led.curve)).axis == 0
    may = np.isin(order, free) & ~np.isin(order, asked)
    placed = (state.rows.sort.data[order] == Sort.PLACED) & ~np.isin(order, asked)
    if led.span is not None:
        along, ends, bounds = ("z" if section else "x"), led.span, led.span
        place = state.rows.xyz.data[order, 2 if section else 0]
        inner = (place > ends[0]) & (place < ends[1])
    else:
        along, knot = ("girth" if section else "x"), state.spline(led.curve).knot
        held = placed, _breaks(state, led.curve, order)
        part = _PART_OF_GIRTH * float(knot[-1]) if section else _PART * state.particulars.length
        first, last = (
            _walk(int(mine[side]), step, held, may, knot, 0.5 * part)
            for side, step in ((0, -1), (-1, 1))
        )
        place = knot if section else state.rows.xyz.data[order, 0]
        inner = np.zeros(len(order), np.bool_)
        inner[first + 1 : last] = True
        inside = place[first : last + 1]
        ends = float(inside.min()), float(inside.max())
        bounds = ends
        # An end of the line that may move takes part.
        for end, at in ((0, first), (len(order) - 1, last)):
            if at == end and may[at]:
                inner[at] = True
                bounds = (
                    -np.inf if place[at] == ends[0] else bounds[0],
                    np.inf if place[at] == ends[1] else bounds[1],
                )
    at = place[mine]
    rim = tuple(
        _RIM * max(way, 1e-9) if np.isfinite(way) else 1.0
        for way in (float(at.min()) - bounds[0], bounds[1] - float(at.max()))
    )
    room = may & inner
    room = min(int(room[: mine[0]].sum()), int(room[mine[-1] :].sum()))
    return Stretch(along, ends, bounds, (rim[0], rim[1]), room, order[placed & inner])


def _breaks(state: HullState, curve: int, order: IntArray) -> np.typing.NDArray[np.bool_]:
    """Tell where a curve is held, whatever room there is: ends, knuckles, tangents, flats."""
    side = state.curves.side.data[curve]
    found = state.rows.kind.data[order, side] != PointKind.SMOOTH
    found |= (on_flat(state) | on_profile(state))[order]
    found[[0, -1]] = True
    return np.asarray(found)


def _walk(
    start: int, step: int,
    held: tuple[np.typing.NDArray[np.bool_], np.typing.NDArray[np.bool_]],
    may: np.typing.NDArray[np.bool_], knot: FloatArray, least: float,
) -> int:  # fmt: skip
    """Give where a stretch ends, from an asked point on; `held` are placed points and breaks."""
    placed, broken = held
    room, at = 0, start
    while 0 <= at + step < len(knot):
        at += step
        if broken[at]:
            break
        room += int(may[at])
        if placed[at] and room >= _ROOM and abs(knot[at] - knot[start]) >= least:
            break
    return at


# --------------------------------------------------------------------------------------
# What followed.


@attrs.frozen(eq=False)
class NetBefore:
    """Where all points lay before a lead, and the normals of the hull there.

    Attributes
    ----------
    xyz, spot, normal : (n, 3), (n, 2, 3), (n, 3), m
        Places of points, where each curve passes them, and outward unit normals.
    """

    xyz: FloatArray
    spot: FloatArray
    normal: FloatArray

    @classmethod
    def of(cls, state: HullState) -> NetBefore:
        """Keep those of a net as it is."""
        table = state.rows
        return cls(table.xyz.data.copy(), table.spot.data.copy(), hull_normals(state).copy())

    def outward(self, state: HullState, rows: IntArray) -> FloatArray:
        """Give how far points (k,) have come along the normal, (k,), m; nil of later ones."""
        old = rows < len(self.xyz)
        found = np.zeros(len(rows))
        was = rows[old]
        step = state.rows.xyz.data[was] - self.xyz[was]
        found[old] = np.nan_to_num((step * self.normal[was]).sum(axis=1))
        return found

    def led(self, state: HullState, lead: LineLed, stretch: Stretch) -> Led:
        """Say what led and which of its crossings followed, in their order along the line."""
        table, key = state.rows, state.rows.key
        asked = [
            (str(key[row]), amount)
            for row, amount in zip(
                lead.rows.tolist(), self.outward(state, lead.rows).tolist(), strict=True
            )
        ]
        known = table.alive.data[: len(self.xyz)] & (table.sort.data[: len(self.xyz)] == 0)
        rows = np.flatnonzero(known & (table.curve.data[: len(known)] == lead.curve).any(axis=1))
        rows = rows[~np.isin(rows, lead.rows)]
        side = (table.curve.data[rows, 1] == lead.curve).astype(np.int64)
        step = table.spot.data[rows, side] - self.spot[rows, side]
        amount = np.nan_to_num((step * self.normal[rows]).sum(axis=1))
        order = np.argsort(np.nan_to_num(table.parameter.data[rows, side]), kind="stable")
        order = order[np.abs(amount[order]) > SAME_MOVEMENT]
        return Led(
            str(state.lines.key[state.line_of(lead.curve)]), stretch.along, stretch.ends,
            tuple(asked), tuple((str(key[int(rows[i])]), float(amount[i])) for i in order),
        )  # fmt: skip

    def followed(self, state: HullState, leads: Sequence[LineLed]) -> tuple[tuple[str, float], ...]:
        """Give the lines that followed, by key, each with the farthest way of its points, m."""
        mine = {state.line_of(lead.curve) for lead in leads}
        found: dict[str, float] = {}
        for curve in state.live("curves").tolist():
            line = state.line_of(curve)
            amount = self.outward(state, state.curves.rows.data[curve])
            most = float(amount[np.abs(amount).argmax()])
            key = str(state.lines.key[line])
            if line not in mine and abs(most) > max(SAME_MOVEMENT, abs(found.get(key, 0.0))):
                found[key] = most
        return tuple(sorted(found.items()))

    def notes(self, state: HullState, lead: LineLed, stretch: Stretch, led: Led) -> Iterator[str]:
        """Say it in words."""
        asked = ", ".join(
            f"{address(state, row)} {1e3 * amount:+.1f} mm"
            for row, (_, amount) in zip(lead.rows.tolist(), led.asked, strict=True)
        )
        low, high = stretch.ends
        yield f"{lead.name} leads over {stretch.along} {low:.2f} to {high:.2f} m: {asked}"
        numbers = {str(state.rows.key[row]): row for row in self._crossings(state, lead)}
        far = [
            f"{self._other(state, lead, numbers[key])} {1e3 * amount:+.1f} mm"
            for key, amount in led.crossings
            if abs(amount) >= _TOLD
        ]
        few = len(led.crossings) - len(far)
        less = f", and {few} by less than {1e3 * _TOLD:g} mm" if few else ""
        yield f"{lead.name}: {len(far)} crossings followed: {', '.join(far) or 'none'}{less}"
        if len(stretch.stayed):
            names = ", ".join(address(state, row) for row in stretch.stayed.tolist())
            yield f"{lead.name}: placed points in the stretch stay, and dent it: {names}"
        if stretch.room < _ROOM:
            yield (
                f"{lead.name}: the stretch holds {stretch.room} free points of the line on a "
                "side of what is asked: with less than 2 it makes a dimple, name a longer one"
            )

    def reach(self, state: HullState, leads: Sequence[LineLed]) -> str:
        """Say where points have moved by more than 1 mm, and how far any has the other way."""
        asked = self.outward(state, np.concatenate([lead.rows for lead in leads]))
        rows = np.flatnonzero(state.rows.alive.data[: len(self.xyz)])
        amount = self.outward(state, rows)
        far = state.rows.xyz.data[rows[np.abs(amount) > 1e-3], 0]
        where = f"from x {far.min():.1f} to {far.max():.1f} m" if len(far) else "nowhere"
        most = float(asked[np.abs(asked).argmax()])
        other = float((-np.sign(most) * amount).max(initial=0.0))
        return f"points move by more than 1 mm {where}, and by {1e3 * other:.1f} mm the other way"

    def _crossings(self, state: HullState, lead: LineLed) -> list[int]:
        here = (state.rows.curve.data[: len(self.xyz)] == lead.curve).any(axis=1)
        return np.flatnonzero(here & state.rows.alive.data[: len(self.xyz)]).tolist()

    @staticmethod
    def _other(state: HullState, lead: LineLed, row: int) -> str:
        """Name the line that crosses."""
        first, second = state.rows.curve.data[row].tolist()
        return str(state.lines.name[state.line_of(second if first == lead.curve else first)])


# --------------------------------------------------------------------------------------
# Second doses.


def second_doses(document: Document, lines: Mapping[str, str]) -> Iterator[str]:
    """Say which lines, names by key, have followed others since the last checkpoint."""
    marks = {label.step for label in document.labels.values() if not label.branch}
    way: dict[str, float] = {}
    leaders: dict[str, list[str]] = {}
    names = _names(document.state)
    for step in reversed(document.path(document.head)):
        if step.number in marks:
            break
        report = step.report if _leads(step) else None
        for key, amount in () if report is None else report.followed:
            if report is not None and key in lines:
                way[key] = way.get(key, 0.0) + amount
                leaders.setdefault(key, []).extend(
                    names.get(led.line, led.line) for led in report.led
                )
    for key, amount in way.items():
        if abs(amount) >= _TOLD:
            others = ", ".join(dict.fromkeys(leaders[key]))
            yield (
                f"{lines[key]} has followed {others} by up to {1e3 * amount:+.1f} mm since the "
                "last checkpoint: what is asked as a distance from where it is now adds to that"
            )


def _names(state: HullState) -> dict[str, str]:
    lines = state.live("lines").tolist()
    return {str(state.lines.key[line]): str(state.lines.name[line]) for line in lines}


def _leads(step: Step) -> bool:
    """Tell whether a step may hold a lead, by what was asked for: its report may be in a file."""
    return any(each.get("op") == "lead" or each.get("lead") for each in step.script.edits)
