"""A hull from a file of another program, in one call: read, placed, adopted, checked, judged.

`import_hull` is the one way in, for the library and the command line. What holds a hull already, or
a classical definition, does not come through here.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import attrs

from assoc_hull.analysis.hydrostatics.hull_hydrostatics import hydrostatics
from assoc_hull.arguments import positive, regular_file
from assoc_hull.edit.adoption.adopt_lines import AdoptionReport
from assoc_hull.edit.adoption.latent_crossings import make_latent_crossings
from assoc_hull.errors import AssocHullError, BadInputError, NotSoundError
from assoc_hull.geometry.numeric.blas_threads import one_thread
from assoc_hull.io.digitised.body_plan import BodyPlanRules, is_body_plan, read_body_plan
from assoc_hull.io.importing.judge import judge, verdict_notes
from assoc_hull.io.importing.options import ImportOptions
from assoc_hull.io.importing.own_files import read_own_file
from assoc_hull.io.importing.soundness import deepest_note, greatest_note, open_net_note
from assoc_hull.io.importing.stated import stated_places
from assoc_hull.io.importing.verdict import Verdict, grouped, require_sound
from assoc_hull.io.lines.ship_frame import ShipFrame
from assoc_hull.io.offsets.complete_table import net_from_table
from assoc_hull.io.offsets.knuckles import knuckle_notes
from assoc_hull.io.offsets.place_table import place_table, table_particulars
from assoc_hull.io.offsets.read import read_offsets
from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.io.placing.options import FileAxes, FrameOptions
from assoc_hull.io.reports import Note, OffsetReport, Tell, no_progress
from assoc_hull.io.slicing.net import SliceReport
from assoc_hull.io.slicing.read import holds_lines, read_slices
from assoc_hull.io.units import METRES
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
    frame : ShipFrame or None
        Where the ship lay in its file: perpendiculars, base line, design waterline.
    own_notes : tuple of str
        The notes that adoption itself made.
    """

    notes: OffsetReport
    adoption: AdoptionReport
    verdict: Verdict
    slices: SliceReport | None = None
    table: OffsetTable | None = None
    frame: ShipFrame | None = None
    own_notes: tuple[str, ...] = ()


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
    regular_file(path)
    wanted = options or ImportOptions()
    # The same file gives the same hull to the last bit, however many cores there are.
    with one_thread():
        return _import(path, wanted, tell)


def _import(path: Path, wanted: ImportOptions, tell: Tell) -> tuple[HullState, ImportReport]:
    own = read_own_file(path, wanted)
    if own is not None and own.state is not None and own.adoption is not None:
        state, report = own.state, ImportReport(own.notes, own.adoption, Verdict())
    elif holds_lines(path):
        state, report = _import_lines(path, wanted, tell)
    else:
        with _file_named(path):
            state, report = _import_table(path, wanted)
    if own is not None and own.state is None:
        report = attrs.evolve(report, notes=own.added_to(report.notes))
    tell("checking", 0, 0)
    restored = own is not None and own.state is not None
    if wanted.deck is None and not restored:
        report = attrs.evolve(report, notes=_with_deck(report.notes, state))
    made = () if restored else make_latent_crossings(state)
    verdict = judge(
        state, path, report.notes, report.adoption, report.slices, report.frame, table=report.table
    )
    require_sound(verdict, path.name, accept=wanted.accept, strict=wanted.strict)
    mine = (*report.adoption.notes, *(f"{name}: made, since both lines end there" for name in made))
    lcb = (*_place_of_lcb(state, report.frame), *open_net_note(state))
    if not restored:
        noise = _noise(state, report.table)
        lcb = (*lcb, *greatest_note(state, noise), *deepest_note(state, noise))
    notes = (*verdict_notes(report.notes, verdict), *lcb, *mine)
    adoption = attrs.evolve(report.adoption, notes=notes)
    return state, attrs.evolve(report, verdict=verdict, adoption=adoption, own_notes=(*lcb, *mine))


def _with_deck(notes: OffsetReport, state: HullState) -> OffsetReport:
    """Add that an open deck is an assumption: what heels beyond its edge has no levers."""
    if state.particulars.deck != DECKS[0]:
        return notes
    what = "open, as the file tells of none; give deck='closed' (--deck closed) if she has one"
    return attrs.evolve(notes, assumptions=(*notes.assumptions, Note("deck", "the hull", what)))


def _import_lines(path: Path, options: ImportOptions, tell: Tell) -> tuple[HullState, ImportReport]:
    if is_body_plan(path):
        return _import_body_plan(path, options, tell)
    options.refuse("it is for tables of offsets", path, options.TABLES)
    named = options.named(*options.CUTS, "deck", "unit", "deck_edge")
    state, slices = read_slices(
        path, frame=options.frame, **named, stated=stated_places(path), tell=tell
    )
    return state, ImportReport(
        slices.slices, slices.adoption, Verdict(), slices=slices, frame=slices.frame
    )


def _import_body_plan(
    path: Path, options: ImportOptions, tell: Tell
) -> tuple[HullState, ImportReport]:
    """Read the sections of a flat drawing, and adopt them as digitised lines."""
    options.refuse("sections stand where the drawing has them", path, options.PLANES)
    plan = read_body_plan(path, BodyPlanRules(
        _scale(options), options.unit, options.length, options.station_spacings,
        options.frame_spacing, options.station_zero,
    ))  # fmt: skip
    # Stations are counted from AP, whatever a frame would find of sections alone.
    frame = options.frame
    if options.ap is options.fp is options.origin is None and options.length is not None:
        frame = attrs.evolve(frame, ap="0 m")
    wanted = attrs.evolve(options, unit=plan.unit)
    named = wanted.named(*options.CUTS, "deck", "unit", "deck_edge")
    with TemporaryDirectory() as folder:
        lines = Path(folder) / f"{path.stem}.csv"
        lines.write_text(plan.text, encoding="utf-8")
        state, slices = read_slices(lines, frame=frame, **named, tell=tell)
    notes = plan.notes.then(slices.slices)
    return state, ImportReport(
        notes, slices.adoption, Verdict(), slices=attrs.evolve(slices, slices=notes),
        frame=slices.frame,
    )  # fmt: skip


def _scale(options: ImportOptions) -> float:
    """Give full scale over that of the file: 1 where nobody says it, and above 0."""
    given = 1.0 if options.scale is None else options.scale
    return positive(given, "scale", "as an argument")


def _import_table(path: Path, options: ImportOptions) -> tuple[HullState, ImportReport]:
    options.refuse("it is for meshes, surfaces and digitised lines", path, options.ONLY_CUTS)
    table, notes, frame = _placed_table(path, options)
    notes = attrs.evolve(notes, assumptions=(*notes.assumptions, *knuckle_notes(table)))
    deck = options.deck or DECKS[0]
    ship = table_particulars(table, frame, deck)
    try:
        state, adoption = net_from_table(table, deck=deck, particulars=ship, imported=True)
    except AssocHullError as error:
        if not notes.faults:
            raise
        # No hull can be made of numbers that are not right: all that is wrong is told.
        found = (
            *grouped(notes.faults),
            Note("not adopted", "the table", str(error)),
        )
        besides = tuple(map(str, grouped(notes.suspicions)))
        raise NotSoundError(path.name, tuple(map(str, found)), suspicions=besides) from error
    unused = (Note("deck edge", "the table", each) for each in adoption.unused)
    notes = attrs.evolve(notes, suspicions=(*notes.suspicions, *unused))
    return state, ImportReport(notes, adoption, Verdict(), table=table, frame=frame)


@contextmanager
def _file_named(path: Path) -> Iterator[None]:
    """Let errors of a table name its file: where many are read, "in the table" is no place."""
    try:
        yield
    except BadInputError as error:
        if error.where.removeprefix("in ") == "the table":
            error.where = f"in the table {path.name}"
        raise


def _placed_table(
    path: Path, options: ImportOptions
) -> tuple[OffsetTable, OffsetReport, ShipFrame]:
    """Read a table at the scale of the file, bring it to full scale and into ship axes."""
    scale = _scale(options)
    zero, frame = _table_origin(options)
    named: dict[str, Any] = {name: getattr(frame, name) for name in options.SIZES}
    named["draught"] = frame.mean_draught
    named["frame_spacing"] = options.frame_spacing
    sizes = {name: value / scale for name, value in named.items() if value is not None}
    more = options.named("unit", "station_spacings", "centre") | (
        {} if zero is None else {"station_zero": zero}
    )
    table, notes = read_offsets(path, **sizes, **more)
    if scale != 1.0:
        table = table.scaled(scale)
    unit = options.unit or next((n.what for n in notes.assumptions if n.kind == "unit"), "m")
    factor = scale * METRES.get(unit.split(",")[0], 1.0)
    turned = "bow at negative x" in notes.kinds("repairs")
    axes = FileAxes(factor=factor, x_sign=-1.0 if turned else 1.0)
    return place_table(table, notes, frame, axes)


def _table_origin(options: ImportOptions) -> tuple[str | None, FrameOptions]:
    """Give where station 0 or x = 0 of a table is, for its reader, and what is left to be found."""
    frame, zero = options.frame, options.station_zero
    if frame.origin not in ("ap", "fp"):
        return zero, frame
    if zero is not None and zero != frame.origin:
        raise BadInputError(
            f"station_zero is {zero!r} and origin {frame.origin!r}", "as arguments", "give one"
        )
    return frame.origin, attrs.evolve(frame, origin=None)


def _noise(state: HullState, table: OffsetTable | None) -> float:
    """Give what a file leaves open of a breadth, m: a printed digit, or what adoption allows."""
    if table is None:
        return state.tolerances.adoption
    return 2.0 * float(table.rounding.max())


@attrs.frozen(eq=False)
class _Adopted:
    """A hull, for what measures hulls."""

    state: HullState


def _place_of_lcb(state: HullState, frame: ShipFrame | None) -> tuple[str, ...]:
    """Tell LCB by its place where nobody knows the perpendiculars: a percentage hangs on them."""
    if frame is None or frame.stem is None or frame.origins["ap"] != "assumed":
        return ()
    try:
        found = hydrostatics(_Adopted(state), on_error="report", estimate=False)
    except AssocHullError as error:
        return (f"LCB is not known, since no hydrostatics can be made: {error}",)
    away = frame.stem - frame.ap - found.lcb
    if not math.isfinite(away):
        return ()
    part = 100.0 * (found.lcb / frame.length - 0.5)
    return (
        f"LCB at the draught of {frame.draught:.6g} m lies {away:.6g} m aft of the place where the "
        f"stem meets the waterline; {part:+.3g} % from amidships if Lpp is {frame.length:.6g} m",
    )
