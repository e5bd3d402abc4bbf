"""A hull from a file of another program, in one call: read, placed, adopted, checked, judged.

`import_hull` is the one way in, for the library and the command line. What holds a hull already, or
a classical definition, does not come through here.
"""

from __future__ import annotations

from pathlib import Path

import attrs

from assoc_hull.edit.adoption.adopt_lines import AdoptionReport
from assoc_hull.io.importing.options import ImportOptions
from assoc_hull.io.importing.verdict import Finding, Verdict, require_sound
from assoc_hull.io.offsets.complete_table import net_from_table
from assoc_hull.io.offsets.read import read_offsets
from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.io.reports import Note, OffsetReport, Tell, no_progress
from assoc_hull.io.slicing.net import SliceReport
from assoc_hull.io.slicing.read import holds_lines, read_slices
from assoc_hull.model.tables import DECKS, HullState

__all__ = ["ImportReport", "import_hull"]


@attrs.frozen(eq=False)
class ImportReport:
    """What became of a file.

    Attributes
    ----------
    notes : OffsetReport
        What was assumed, repaired and found suspicious in reading and placing.
    adoption : AdoptionReport
        How closely each line is held; its notes tell assumptions, suspicions and verdict too.
    verdict : Verdict
        Whether the hull is sound.
    slices : SliceReport or None
        How lines were cut and smoothed; None for a table of offsets.
    table : OffsetTable or None
        The table, in ship axes; None for other forms.
    """

    notes: OffsetReport
    adoption: AdoptionReport
    verdict: Verdict
    slices: SliceReport | None = None
    table: OffsetTable | None = None


def import_hull(
    path: Path, options: ImportOptions | None = None, tell: Tell = no_progress
) -> tuple[HullState, ImportReport]:
    """Read a foreign file, told by its content, and adopt it as a hull.

    Raises
    ------
    BadInputError
        The file cannot be read, or an option does not fit its form.
    NotSoundError
        The hull is not sound and was not accepted, or is under suspicion and `strict`.
    """
    wanted = options or ImportOptions()
    if holds_lines(path):
        state, report = _import_lines(path, wanted, tell)
    else:
        state, report = _import_table(path, wanted)
    verdict = _judge(report)
    require_sound(verdict, path.name, accept=wanted.accept, strict=wanted.strict)
    notes = (*_told(report.notes), f"verdict: {verdict}", *report.adoption.notes)
    adoption = attrs.evolve(report.adoption, notes=notes)
    return state, attrs.evolve(report, verdict=verdict, adoption=adoption)


def _import_lines(
    path: Path, options: ImportOptions, tell: Tell
) -> tuple[HullState, ImportReport]:
    options.refuse("it is for tables of offsets", path, options.TABLES)
    state, slices = read_slices(
        path, frame=options.frame, **options.named(*options.CUTS, "deck", "unit"), tell=tell
    )
    return state, ImportReport(slices.slices, slices.adoption, Verdict(), slices=slices)


def _import_table(path: Path, options: ImportOptions) -> tuple[HullState, ImportReport]:
    options.refuse("it is for meshes, surfaces and digitised lines", path, options.CUTS)
    table, notes = read_offsets(path, **options.named(*options.SIZES, "unit", "station_zero"))
    # A table that cannot be right is refused with all that is wrong in it before it is adopted.
    faults = tuple(map(_finding, notes.faults))
    require_sound(Verdict(faults), path.name, accept=options.accept, strict=False)
    state, adoption = net_from_table(table, deck=options.deck or DECKS[0])
    return state, ImportReport(notes, adoption, Verdict(), table=table)


def _judge(report: ImportReport) -> Verdict:
    notes = report.notes
    return Verdict(tuple(map(_finding, notes.faults)), tuple(map(_finding, notes.suspicions)))


def _finding(note: Note) -> Finding:
    return Finding(note.kind, note.where, note.what, note.amount)


def _told(notes: OffsetReport) -> tuple[str, ...]:
    """Give what was assumed and suspected, as lines of text."""
    assumed = (f"assumed: {note}" for note in notes.assumptions)
    return (*assumed, *(f"suspicion: {note}" for note in notes.suspicions))


