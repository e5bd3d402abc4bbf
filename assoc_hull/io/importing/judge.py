"""All looks at an imported hull, ends that its file lacks among them, and the verdict.

Ends that a file does not have: sections alone may stop before the hull does.

Beyond the last section hydrostatics go on by straight lines to a perpendicular, or end flat where
nothing tells of one. Both may be right, as at a transom; what it costs if they are not is told.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.hydrostatics.record import Hydrostatics
from assoc_hull.analysis.net.surface_layout import BROAD_END
from assoc_hull.edit.adoption.adopt_lines import AdoptionReport
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.operations import runs_where
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.io.importing.proportions import examine_certainty, examine_particulars
from assoc_hull.io.importing.soundness import deepest_lines, examine_net, look
from assoc_hull.io.importing.stated import stated_in
from assoc_hull.io.importing.verdict import (
    Findings,
    Verdict,
    told_verdict,
)
from assoc_hull.io.lines.mend_lines import HOLE
from assoc_hull.io.lines.ship_frame import ShipFrame
from assoc_hull.io.offsets.knuckles import points_of_station
from assoc_hull.io.offsets.suspicions import BLANK_INSIDE
from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.io.reports import Note, OffsetReport
from assoc_hull.io.slicing.net import LOFTED, SliceReport
from assoc_hull.model.address import AddressBook
from assoc_hull.model.tables import HullState

__all__ = ["examine_ends", "judge", "judge_definition", "verdict_notes"]

_VOLUME, _SURFACE = 5e-4, 5e-3
"""An end is told where more of V or of S may hang on it: so closely imports are to be right."""

_CLOSED = 2e-3
"""Lines that reach this part of Lpp beyond a section close the hull there."""

_FINE_AT_ENDS = 16


@attrs.frozen
class _LastSection:
    """The last section at an end: its place, what is immersed of it, and how far the hull goes on.

    `area` (m2) and `girth` (m) are of both sides below the water, `broad` (m) there, `half` of the
    whole section; `beyond` is where a perpendicular puts the end, `spacing` the distance of the
    section before it, `drawn` tells whether lines along the ship end here.
    """

    name: str
    fore: bool
    x: float
    area: float
    girth: float
    broad: float
    half: float
    beyond: float
    spacing: float
    drawn: bool

    @property
    def reach(self) -> float:
        """How far the hull may go on, m."""
        return abs(self.beyond - self.x) or self.spacing

    @property
    def part(self) -> float:
        """Of what lies within reach, how much may be wrong: half where it is closed by lines."""
        return 0.5 if self.beyond != self.x else 1.0


def examine_ends(state: HullState, record: Hydrostatics | None, found: Findings) -> None:
    """Suspect the ends of a hull whose profile is not drawn, where sections stop before it does."""
    if record is None:
        return
    widest = max(float(state.spline(c).xyz[:, 1].max()) for c in state.live("curves").tolist())
    ends = []
    for fore in (False, True):
        end = _last_section(state, record.draught_mean, fore=fore)
        if end is None or (not fore and end.drawn and end.half >= BROAD_END * widest):
            continue  # an end aft that is broad, be it over the water, is a transom
        volume, surface = end.area * end.reach, end.girth * end.reach
        if volume > _VOLUME * record.volume or surface > _SURFACE * record.wetted_surface:
            ends.append(end)
    if ends:
        _tell(ends, record, found)


def _tell(ends: list[_LastSection], record: Hydrostatics, found: Findings) -> None:
    taken = [
        f"{'forward of' if end.fore else 'abaft'} {end.name}, still {end.broad:.4g} m broad in the "
        "water, " + (
            f"it is closed by straight lines to the perpendicular, x = {end.beyond:.6g} m"
            if end.beyond != end.x else "it ends flat"
        )
        for end in ends
    ]  # fmt: skip
    volume = sum(end.part * end.area * end.reach for end in ends) / record.volume
    surface = sum(end.part * end.girth * end.reach for end in ends) / record.wetted_surface
    what = (
        f"nothing tells how the hull ends: {'; '.join(taken)}; V may be off by "
        f"{100.0 * volume:.2g} % and S by {100.0 * surface:.2g} %: give the profile, or sections "
        "as far as the ends; or length= and ap= if it ends at the perpendiculars"
    )
    where = " and ".join(f"{end.name} at x = {end.x:.6g} m" for end in ends)
    found.suspect("open end", where, what, volume)


def _last_section(state: HullState, draught: float, *, fore: bool) -> _LastSection | None:
    """Give the last section at an end, None where lines along the ship close the hull beyond it."""
    book, sign = AddressBook(state), 1.0 if fore else -1.0
    across: dict[float, list[tuple[str, FloatArray]]] = {}
    along, flats = [], []
    for curve in state.live("curves").tolist():
        line = state.line_of(curve)
        xyz = sample(state.spline(curve), _FINE_AT_ENDS)[1]
        family = state.family(line).name
        level = state.lines.planar[line] and abs(state.lines.normal[line][0]) == 1.0
        if family == "sections" or (level and not fore):
            name = str(state.lines.name[line]) or book.curve_name(curve)
            across.setdefault(float(xyz[:, 0].mean()), []).append((name, xyz))
        elif level:
            flats.append(float(xyz[:, 0].mean()))
        else:
            along.append(float((sign * xyz[:, 0]).max()))
    if len(across) < 2:
        return None
    places = sorted(across, key=lambda x: -sign * x)
    x, near = places[0], _CLOSED * state.particulars.length
    perpendicular = state.particulars.length if fore else 0.0
    if any(each > sign * x + near for each in along) or any(abs(f - x) <= near for f in flats):
        return None
    measured = [_immersed(xyz, draught) for _, xyz in across[x]]
    area, girth, broad = np.array(measured).sum(axis=0).tolist()
    half = max(float(xyz[:, 1].max()) for _, xyz in across[x])
    on = sign * (perpendicular - x) > near
    return _LastSection(
        across[x][0][0], fore, x, area, girth, broad, half, perpendicular if on else x,
        abs(places[1] - x), bool(along) and max(along) >= sign * x - near,
    )  # fmt: skip


def _immersed(xyz: FloatArray, draught: float) -> tuple[float, float, float]:
    """Give area and girth below the water, both sides, and the greatest breadth there; m."""
    y, z = xyz[:, 1], np.minimum(xyz[:, 2], draught)
    wet = np.minimum(xyz[:-1, 2], xyz[1:, 2]) < draught
    area = abs(float((0.5 * (y[1:] + y[:-1]) * np.diff(z)).sum()))
    girth = float(np.hypot(np.diff(y), np.diff(z))[wet].sum())
    below = xyz[:, 2] <= draught
    return 2.0 * area, 2.0 * girth, 2.0 * float(y[below].max(initial=0.0))


# --------------------------------------------------------------------------------------
# Lines of a table that swing: a smooth curve leaves the box of two offsets between which it rises.
#
# Where offsets only rise, or only fall, a fair line lies between neighbours of them. One that does
# not most often has a knuckle there, beside which a smooth curve swings.

_FINE = 32
"""Places on each segment of a curve that are looked at."""

_TIMES = 2.0
"""A swing is told beyond so many times what the file and adoption leave open."""

_ROW = 3
"""So many neighbouring stations must swing: single ones do at the ends of good coarse tables."""


def greatest_overshoot(
    given: FloatArray, places: FloatArray, noise: float
) -> tuple[float, int] | None:
    """Find by how much (m) a curve leaves the box of two given points, and after which of them.

    `given` (n, 2), m, and `places` (k, 2) along the curve; neighbours of which a third turns back
    by more than `noise` (m) tell no box, as at a greatest breadth.
    """
    away = np.abs(given[:, None] - places[None]).sum(axis=2)
    at = away.argmin(axis=1)
    if (np.diff(at) <= 0).any():
        return None
    found: list[tuple[float, int]] = []
    for k in range(len(given) - 1):
        step = np.diff(given[max(k - 1, 0) : k + 3], axis=0)
        monotone = ~((step > noise).any(axis=0) & (step < -noise).any(axis=0))
        box, part = given[k : k + 2], places[at[k] + 1 : at[k + 1]]
        if not len(part):
            continue
        # Between them: the place nearest to a given point may lie beyond it.
        over = np.maximum(part - box.max(axis=0), box.min(axis=0) - part).max(axis=0)
        found.append((float(over[monotone].max(initial=0.0)), k))
    return max(found, default=None)


def examine_overshoots(state: HullState, table: OffsetTable, found: Findings) -> None:
    """Suspect sections that swing between given points, side by side between the same heights."""
    noise = 2.0 * float(table.rounding.max())
    least = _TIMES * max(noise, state.tolerances.adoption)
    alike: dict[tuple[float, float], list[_Swing]] = {}
    for each in _swings(state, table, noise):
        if each.over > least:
            alike.setdefault(each.heights, []).append(each)
    for (below, above), swings in alike.items():
        stations = np.zeros(len(table.x), np.bool_)
        stations[[each.row for each in swings]] = True
        if int(np.diff(runs_where(stations), axis=1).max()) < _ROW:
            continue
        worst = max(swings, key=lambda each: each.over)
        others = f" and {len(swings) - 1} more" if len(swings) > 1 else ""
        what = (
            f"swings {1e3 * worst.over:.3g} mm out between the given heights {below:.6g} and "
            f"{above:.6g} m, where its offsets only rise or fall: a knuckle may stand at one of "
            "these; it is found where a waterline lies on it and two more on either side of it, "
            "straight to the last digit: else give more waterlines there, or the lines with a "
            "knuckle line"
        )
        found.suspect("overshoot", f"{worst.name}{others}", what, worst.over)


@attrs.frozen
class _Swing:
    """The greatest swing of a section, m, its name, station, and between which heights it is."""

    over: float
    name: str
    row: int
    heights: tuple[float, float]


def _swings(state: HullState, table: OffsetTable, noise: float) -> Iterator[_Swing]:
    """Give the greatest swing of each section."""
    book = AddressBook(state)
    for curve in state.live("curves").tolist():
        if state.family(state.line_of(curve)).name != "sections":
            continue
        spline = state.spline(curve)
        row = int(np.abs(table.x - spline.xyz[0, 0]).argmin())
        given = _given(table, row, spline.xyz)
        if len(given) < _ROW:
            continue
        over = greatest_overshoot(given, sample(spline, _FINE)[1][:, 1:], noise)
        if over is not None:
            below, above = given[over[1] : over[1] + 2, 1].tolist()
            yield _Swing(over[0], book.curve_name(curve), row, (below, above))


def _examine_depths(state: HullState, table: OffsetTable, found: Findings) -> None:
    """Take lines that hang below the keel of a table for faults: it says how deep the hull is."""
    least = _TIMES * max(2.0 * float(table.rounding.max()), state.tolerances.adoption)
    heights = [0.0, float(table.z[0])]
    if table.keel is not None and np.isfinite(table.keel).any():
        heights = [float(np.nanmin(table.keel)), float(table.z[0])]
    found.faults.extend(deepest_lines(state, least, min(heights)))


def _given(table: OffsetTable, row: int, points: FloatArray) -> FloatArray:
    """Give the offsets (n, 2), m, of a station that lie on a curve, with the place it begins at."""
    at = points_of_station(table, row)
    y = np.column_stack([table.half_breadth[row, at], table.z[at]])
    inside: NDArray[np.bool_] = (y[:, 1] >= points[0, 2] - 1e-9) & (y[:, 1] <= points[-1, 2] + 1e-9)
    first = points[:1, 1:]
    rest = y[inside & (np.abs(y - first).sum(axis=1) > 1e-6)]
    return np.concatenate([first, rest])


_COMPARED = ("L/B", "B/T")
"""What the reader of tables compares itself, with the numbers as printed."""

_WILD = 0.3
"""A half-breadth off its neighbours by more, in half-breadths of the ship, is no half-breadth: of
sound ships a knuckle or the edge of a transom stands off by .13 at most."""


def judge(
    state: HullState, path: Path, notes: OffsetReport, adoption: AdoptionReport,
    slices: SliceReport | None, frame: ShipFrame | None,
    *, table: OffsetTable | None,
) -> Verdict:  # fmt: skip
    """Look at all of a hull that was read from a file; `table`: its offsets if it was a table."""
    found = Findings([*notes.faults])
    for note in notes.suspicions:
        _take_up(note, state, found)
    for doubt in () if slices is None else slices.suspicions:
        kind, _, what = doubt.partition(": ")
        found.suspect(kind, "the lines", what, state.tolerances.adoption)
    stated = stated_in(path)
    if table is not None:
        stated = {name: said for name, said in stated.items() if name not in _COMPARED}
    known = frame is not None and frame.origins.get("breadth") in ("given", "stated")
    record = examine_particulars(state, found, stated, broad=known)
    drawn = slices is not None and LOFTED not in notes.kinds("assumptions")
    if not drawn and table is None:
        look(lambda: examine_ends(state, record, found), "the ends", found)
    borders = () if slices is None else slices.borders
    sized = frame is not None and frame.given_length is not None
    examine_net(state, adoption, found, borders, drawn=drawn, sized=sized)
    if table is not None:
        look(lambda: examine_overshoots(state, table, found), "the sections", found)
        look(lambda: _examine_depths(state, table, found), "the sections", found)
    look(lambda: examine_certainty(record, found), "the net", found)
    _put_causes_first(found)
    return found.verdict()


def judge_definition(state: HullState, adoption: AdoptionReport) -> Verdict:
    """Look at a hull that was made of a definition: its particulars and its net."""
    found = Findings()
    examine_particulars(state, found, {}, broad=True)
    examine_net(state, adoption, found, drawn=False)
    return found.verdict()


def _take_up(note: Note, state: HullState, found: Findings) -> None:
    """Take what the reader suspects; an offset of another size than its neighbours is a fault."""
    half = 0.5 * state.particulars.breadth
    wild = note.kind == "outlier" and note.amount is not None and abs(note.amount) > _WILD * half
    # Of an open profile neither surface nor closed mesh can be made, and volumes leak there.
    broken = wild or note.kind == HOLE
    (found.faults if broken else found.suspicions).append(note)


def _put_causes_first(found: Findings) -> None:
    """Make blanks between numbers the first faults where a section is open: they opened it."""
    if not any(each.kind == "open net" for each in found.faults):
        return
    causes = [each for each in found.suspicions if each.what.startswith(BLANK_INSIDE)]
    found.suspicions = [each for each in found.suspicions if each not in causes]
    found.faults[:0] = causes


def verdict_notes(notes: OffsetReport, verdict: Verdict) -> tuple[str, ...]:
    """Give what was assumed and found, and the verdict, as lines of text."""
    return (*(f"assumed: {note}" for note in notes.assumptions), *told_verdict(verdict))
