"""All looks at an imported hull, and the verdict: the reader's notes, particulars, lines, net."""

from __future__ import annotations

from pathlib import Path

from assoc_hull.edit.adoption.adopt_lines import AdoptionReport
from assoc_hull.io.importing.cut_ends import examine_ends
from assoc_hull.io.importing.overshoots import examine_overshoots
from assoc_hull.io.importing.proportions import examine_certainty, examine_particulars
from assoc_hull.io.importing.soundness import examine_net, look
from assoc_hull.io.importing.stated import stated_in
from assoc_hull.io.importing.verdict import Findings, ImportFinding, Verdict, told_verdict
from assoc_hull.io.lines.boundary_holes import HOLE
from assoc_hull.io.lines.ship_frame import ShipFrame
from assoc_hull.io.offsets.suspicions import BLANK_INSIDE
from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.io.reports import Note, OffsetReport
from assoc_hull.io.slicing.net import LOFTED, SliceReport
from assoc_hull.model.tables import HullState

__all__ = ["finding_of", "judge", "judge_definition", "verdict_notes"]

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
