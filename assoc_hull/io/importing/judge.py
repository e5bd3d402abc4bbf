"""All looks at an imported hull, and the verdict: the reader's notes, particulars, lines, net."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.edit.adoption.adopt_lines import AdoptionReport
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.operations import runs_where
from assoc_hull.geometry.splines.evaluation import sample
from assoc_hull.io.importing.cut_ends import examine_ends
from assoc_hull.io.importing.proportions import examine_certainty, examine_particulars
from assoc_hull.io.importing.soundness import deepest_lines, examine_net, look
from assoc_hull.io.importing.stated import stated_in
from assoc_hull.io.importing.verdict import Findings, ImportFinding, Verdict, told_verdict
from assoc_hull.io.lines.boundary_holes import HOLE
from assoc_hull.io.lines.ship_frame import ShipFrame
from assoc_hull.io.offsets.knuckles import points_of_station
from assoc_hull.io.offsets.suspicions import BLANK_INSIDE
from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.io.reports import Note, OffsetReport
from assoc_hull.io.slicing.net import LOFTED, SliceReport
from assoc_hull.model.address import AddressBook
from assoc_hull.model.tables import HullState

__all__ = ["finding_of", "judge", "judge_definition", "verdict_notes"]

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
    found = Findings([*map(finding_of, notes.faults)])
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
    (found.faults if broken else found.suspicions).append(finding_of(note))


def _put_causes_first(found: Findings) -> None:
    """Make blanks between numbers the first faults where a section is open: they opened it."""
    if not any(each.kind == "open net" for each in found.faults):
        return
    causes = [each for each in found.suspicions if each.what.startswith(BLANK_INSIDE)]
    found.suspicions = [each for each in found.suspicions if each not in causes]
    found.faults[:0] = causes


def finding_of(note: Note) -> ImportFinding:
    """Give a note as a finding."""
    return ImportFinding(note.kind, note.where, note.what, note.amount)


def verdict_notes(notes: OffsetReport, verdict: Verdict) -> tuple[str, ...]:
    """Give what was assumed and found, and the verdict, as lines of text."""
    return (*(f"assumed: {note}" for note in notes.assumptions), *told_verdict(verdict))
