"""The parts of a booklet: what each holds in numbers, tables and pictures, before it is laid out.

A part is computed once and then laid out as pages of a PDF or as sheets of a workbook, so that both
say the same. Tables keep unrounded numbers with the digits they are printed with; a cell that is
None is blank. Pictures are drawn when their page is made.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, Literal

import attrs
import numpy as np

from assoc_hull.analysis.form.form_parameters import FormReport, form_report
from assoc_hull.analysis.hydrostatics.floating_body import Appendage, FloatingPosition
from assoc_hull.analysis.hydrostatics.flotation import body_of
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import hydrostatic_table
from assoc_hull.analysis.hydrostatics.record import FIELDS, HydrostaticTable
from assoc_hull.analysis.hydrostatics.section_areas import (
    bonjean,
    sectional_area_course,
    sectional_areas,
)
from assoc_hull.analysis.stability.condition import OnError
from assoc_hull.analysis.stability.criteria import Criterion, unjudged_criteria
from assoc_hull.analysis.stability.cross_curves import CrossCurves, cross_curves
from assoc_hull.analysis.stability.flooding import FloodingPoint
from assoc_hull.analysis.stability.stability_report import Stability, stability
from assoc_hull.edit.adoption.adopt_lines import AdoptionReport
from assoc_hull.edit.checks.hull_findings import check
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.volume_below import integrate_below
from assoc_hull.io.reports import Tell, no_progress
from assoc_hull.model.tables import HasState
from assoc_hull.plot.diagrams.hydrostatics import (
    bonjean_curves,
    hydrostatic_curves,
    sectional_area_curve,
)
from assoc_hull.plot.diagrams.stability import cross_curve_picture, lever_picture
from assoc_hull.plot.lines_plan.plan import lines_plan
from assoc_hull.plot.plates.hull_map import hull_map
from assoc_hull.plot.plates.lit_surface import surface_figure
from assoc_hull.surface.blocks.fitted_surface import FittedSurface, surface_faults
from assoc_hull.surface.plating.hull_plates import HullPlateTable
from assoc_hull.surface.plating.plate_class import CAVEAT

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = [
    "PARTS",
    "BookColumn",
    "BookPart",
    "BookPicture",
    "BookRequest",
    "BookTable",
    "PartName",
    "Rounded",
    "hydrostatic_part",
    "parts_of",
]

PartName = Literal[
    "lines", "hydrostatics", "bonjean", "areas", "form", "stability", "surface", "plates",
    "accuracy",
]  # fmt: skip

PARTS: tuple[str, ...] = (
    "lines", "hydrostatics", "bonjean", "areas", "form", "stability", "surface", "plates",
    "accuracy",
)  # fmt: skip
"""The parts in their order."""


# --------------------------------------------------------------------------------------
# What a part is made of.


@attrs.frozen
class Rounded:
    """A number with digits of its own, after the point."""

    value: float
    digits: int


Cell = float | Rounded | str | None


@attrs.frozen
class BookColumn:
    """A column: what stands over it, its unit, and digits after the point; None: words."""

    name: str
    unit: str = ""
    digits: int | None = None


@attrs.frozen(eq=False)
class BookTable:
    """A table.

    Attributes
    ----------
    title : str
        Stands over it.
    columns : tuple of BookColumn
        What each holds.
    rows : tuple of tuple
        Cells: numbers, words, or None.
    lead : int
        So many columns are said again where a wide table goes on below.
    turned : bool
        On paper columns run down and rows across, as hydrostatic tables are printed.
    notes : tuple of str
        Stand below it.
    """

    title: str
    columns: tuple[BookColumn, ...]
    rows: tuple[tuple[Cell, ...], ...]
    lead: int = 1
    turned: bool = False
    notes: tuple[str, ...] = ()


@attrs.frozen(eq=False)
class BookPicture:
    """A picture on a sheet of its own."""

    title: str
    draw: Callable[[], Figure]


@attrs.frozen(eq=False)
class BookPart:
    """A part: facts, tables, pictures, and notes at its end."""

    name: str
    title: str
    facts: tuple[tuple[str, str], ...] = ()
    tables: tuple[BookTable, ...] = ()
    pictures: tuple[BookPicture, ...] = ()
    notes: tuple[str, ...] = ()


@attrs.frozen(eq=False)
class BookRequest:
    """What a booklet is to hold, and what its numbers hold good for; see `Hull.report`."""

    names: tuple[str, ...]
    draughts: tuple[float, ...] | None
    draught: float
    kg: float | None
    flooding: tuple[FloodingPoint, ...]
    rho: float
    shell_factor: float
    appendages: tuple[Appendage, ...]
    on_error: OnError
    surface: FittedSurface | None
    plates: HullPlateTable | None
    adoption: AdoptionReport | None
    date: str | None

    @property
    def terms(self) -> dict[str, Any]:
        """Give what all hydrostatic computations take."""
        return {"rho": self.rho, "shell_factor": self.shell_factor, "appendages": self.appendages,
                "on_error": self.on_error}  # fmt: skip


def parts_of(
    hull: HasState, asked: BookRequest, tell: Tell = no_progress
) -> tuple[tuple[BookPart, ...], HydrostaticTable]:
    """Compute the parts asked for; and the hydrostatics at the design draught, for the title."""
    design = hydrostatic_table(
        hull, [asked.draught], (0.0,), kg=asked.kg, date=asked.date, **asked.terms
    )

    @functools.cache
    def table() -> HydrostaticTable:
        levels = asked.draughts or usual_draughts(hull, asked.draught)
        return hydrostatic_table(hull, levels, (0.0,), kg=asked.kg, date=asked.date, **asked.terms)

    makers: dict[str, Callable[[], BookPart]] = {
        "lines": lambda: _lines(hull),
        "hydrostatics": lambda: hydrostatic_part(table()),
        "bonjean": lambda: _bonjean(hull, design),
        "areas": lambda: _areas(hull, design),
        "form": lambda: _form(hull, asked, design),
        "stability": lambda: _stability(hull, asked, table()),
        "surface": lambda: _surface(asked, design),
        "plates": lambda: _plates(asked),
        "accuracy": lambda: _accuracy(hull, asked, design, table()),
    }
    made, count = list[BookPart](), len(asked.names)
    for k, name in enumerate(asked.names):
        tell(f"computing {name}", k, 2 * count)  # drawing is the other half
        made.append(makers[name]())
    return tuple(made), design


_STEPS = (0.05, 0.1, 0.2, 0.25, 0.5, 1.0, 2.0, 2.5, 5.0)
_MOST = 14
_SHALLOW, _DEEP = 0.2, 1.2
"""Parts of the design draught between which hydrostatics are told if no draughts are named."""
_DRY = 1e-3
"""m: so far the deck edge stays above the water."""


def usual_draughts(hull: HasState, design: float) -> list[float]:
    """Give round draughts around a design draught, with it among them, below the deck edge."""
    limits = body_of(hull).limits
    deck, bottom = float(limits.deck[:, 2].min()), float(limits.bottom[:, 2].min())
    low, high = bottom + _SHALLOW * (design - bottom), min(_DEEP * design, deck - _DRY)
    step, round_ones = _round_heights(low, high, _MOST)
    near = np.abs(round_ones - design) < 0.1 * step
    return sorted([*round_ones[~near].tolist(), design])


def _round_heights(low: float, high: float, most: int) -> tuple[float, FloatArray]:
    """Give a round step, m, and its multiples between two heights, (n,), about so many at most."""
    step = next((each for each in _STEPS if (high - low) / each <= most), _STEPS[-1])
    count = np.arange(np.ceil(low / step), np.floor(high / step) + 1.0)
    return step, np.asarray((step * count).round(6))


# --------------------------------------------------------------------------------------
# Lines, hydrostatics, areas.


def _lines(hull: HasState) -> BookPart:
    return BookPart(
        "lines", "Lines plan", pictures=(BookPicture("Lines plan", lambda: lines_plan(hull)),)
    )


def hydrostatic_part(table: HydrostaticTable) -> BookPart:
    """Give a table of hydrostatics as a part, with its curves if it has several draughts."""
    facts = tuple(each for each in table.header.lines() if each[0] not in ("ship", "fingerprint"))
    freeboard = np.array([each.least for each in table.freeboards])
    columns = [_column(name) for name in FIELDS]
    draughts = [
        BookColumn(_DRAUGHTS.get(name, name), "deg" if name == "heel_deg" else "m", 4)
        for name in table.draughts
    ]
    values = [*table.draughts.values(), *(table.columns[name] for name in FIELDS), freeboard]
    found = BookTable(
        "Hydrostatics",
        (*draughts, *columns, BookColumn("freeboard", "m", 4)), _rows(values),
        lead=len(draughts), turned=True,
    )  # fmt: skip
    meaning = BookTable(
        "Meaning of the values",
        (BookColumn("value"), BookColumn("unit"), BookColumn("meaning"), BookColumn("formula")),
        tuple(
            (_symbol(name), each.unit, each.title, each.formula) for name, each in FIELDS.items()
        ),
    )
    curves = [
        BookPicture(f"Hydrostatic curves{_trim_words(table, i)}",
                    functools.partial(hydrostatic_curves, table, trim=i))
        for i in range(table.shape[1] if table.shape[0] > 1 else 0)
    ]  # fmt: skip
    return BookPart(
        "hydrostatics", "Hydrostatics", facts, (found, meaning), tuple(curves), table.notes
    )


_DRAUGHTS = {
    "draught_aft": "T_A", "draught_fore": "T_F", "draught_aft_extreme": "T_A keel",
    "draught_fore_extreme": "T_F keel", "heel_deg": "heel",
}  # fmt: skip


def _trim_words(table: HydrostaticTable, i: int) -> str:
    """Name a trim where a table has several."""
    if table.shape[1] == 1:
        return ""
    return f", trim {table.positions[i].trim_by_stern + 0.0:+.3f} m by the stern"


def _symbol(name: str) -> str:
    return name if FIELDS[name].symbol == "-" else FIELDS[name].symbol


def _column(name: str, more: int = 0) -> BookColumn:
    field = FIELDS[name]
    return BookColumn(_symbol(name), "" if field.unit == "-" else field.unit, field.digits + more)


def _rows(columns: Sequence[Any]) -> tuple[tuple[Cell, ...], ...]:
    """Give rows of columns of numbers, blank where there is none."""
    return tuple(
        tuple(None if np.isnan(each) else float(each) for each in row)
        for row in zip(*columns, strict=True)
    )


_LEVELS = 11
"""About so many heights stand in a row of the table of Bonjean curves."""


def _bonjean(hull: HasState, design: HydrostaticTable) -> BookPart:
    """Tell areas and moments of the stations up to levels; curves are of more of them."""
    whole = bonjean(hull)
    some = bonjean(hull, _round_heights(float(whole.z[0]), float(whole.z[-1]), _LEVELS)[1])
    stations = list(zip(some.stations.names, some.stations.x.tolist(), strict=True))
    heads = (
        BookColumn("station"), BookColumn("x", "m", 3),
        *(BookColumn(f"z {z:.6g}", "", 2) for z in some.z.tolist()),
    )  # fmt: skip
    tables = [
        BookTable(
            title, heads,
            tuple((name, x, *map(float, column))
                  for (name, x), column in zip(stations, values.T, strict=True)),
            lead=2,
        )
        for title, values in (
            ("Areas of the stations up to heights z in m, both sides, m2", some.stations.area),
            ("Moments of these areas about the base line, m3", some.moment),
        )
    ]  # fmt: skip
    curves = BookPicture("Bonjean curves", lambda: bonjean_curves(hull, whole, design))
    return BookPart("bonjean", "Bonjean curves", (), tuple(tables), (curves,))


def _areas(hull: HasState, design: HydrostaticTable) -> BookPart:
    """Tell the sectional areas at the design draught."""
    found = sectional_areas(hull, design.positions[0])
    area, most = found.area[0], float(found.area.max())
    length = design.header.length
    table = BookTable(
        f"Sectional areas at a draught of {design.positions[0].draught_mean:.3f} m, both sides",
        (BookColumn("station"), BookColumn("x", "m", 3), BookColumn("x / Lpp", "", 4),
         BookColumn("area", "m2", 3), BookColumn("area / largest", "", 4)),
        tuple((name, float(x), float(x) / length, float(each), float(each) / most)
              for name, x, each in zip(found.names, found.x, area, strict=True)),
    )  # fmt: skip

    def drawn() -> Figure:
        course = sectional_area_course(hull, design.positions[0])
        return sectional_area_curve(found, design, course=course)

    curve = BookPicture("Sectional-area curve", drawn)
    return BookPart("areas", "Sectional areas", (), (table,), (curve,))


# --------------------------------------------------------------------------------------
# Form parameters, stability.


def _form(hull: HasState, asked: BookRequest, design: HydrostaticTable) -> BookPart:
    report = form_report(
        hull, draught=asked.draught, rho=asked.rho, shell_factor=asked.shell_factor,
        date=asked.date,
    )  # fmt: skip
    heads = (BookColumn("symbol"), BookColumn("form parameter"), BookColumn("value", "", 4),
             BookColumn("unit"), BookColumn("note"))  # fmt: skip
    tables = tuple(
        BookTable(part.title, heads, tuple(_form_rows(report, k, design))) for k, part in
        enumerate(report.parts)
    )  # fmt: skip
    notes = tuple(f"{k}) {words}" for k, words in enumerate(report.notes, 1))
    facts = tuple(each for each in report.lines() if each[0] not in ("ship", "fingerprint"))
    return BookPart("form", "Form parameters", facts, tables, (), notes)


def _form_rows(
    report: FormReport, part: int, design: HydrostaticTable
) -> Iterator[tuple[Cell, ...]]:
    for row in report.parts[part].rows:
        number, entry = row.value.number, row.entry
        name = entry.placed_name
        if entry.symbol == "MTC":
            # Form parameters know no KG: one document has one MTC, that of its hydrostatics.
            number = float(design.columns["mtc"][0])
            name += ", by BM_L" if np.isnan(design.columns["gml"][0]) else ", by GM_L"
        value = None if number is None else Rounded(number, entry.digits)
        yield (entry.symbol, name, value, row.value.unit if value else "", row.mark)


_KG = "KG was not given"
_CROSSED = 7  # displacements at most
_HEELS = (5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0, 50.0, 60.0, 70.0, 80.0, 90.0)


def _stability(hull: HasState, asked: BookRequest, table: HydrostaticTable) -> BookPart:
    """Judge the ship at the design draught if KG is known; cross curves need none."""
    levels = np.unique([each.draught_mean for each in table.positions])
    # Cross curves are smooth in the displacement: some of many draughts tell them.
    levels = levels[:: -(-len(levels) // _CROSSED)]
    crossed = cross_curves(
        hull, draughts=levels.tolist(), heels=_HEELS, kg=asked.kg, date=asked.date, **asked.terms
    )
    facts: list[tuple[str, str]] = []
    tables: list[BookTable] = []
    pictures: list[BookPicture] = []
    notes = list(crossed.notes)
    if asked.kg is None:
        tables.append(_criteria(unjudged_criteria(_KG)))
        facts.append(("condition", f"{_KG}: no righting levers, and no criterion is evaluated"))
    else:
        found = stability(hull, kg=asked.kg, draught=asked.draught, flooding=asked.flooding,
                          date=asked.date, **asked.terms)  # fmt: skip
        head = dict(found.header.lines())
        facts += [each for each in found.lines() if each[0] not in (*head, "criterion", "note")]
        tables += [_criteria(found.criteria), _levers(found)]
        pictures.append(BookPicture("Righting levers", functools.partial(lever_picture, found)))
        notes += found.notes
    tables.append(_crossed(crossed))
    if len(crossed.conditions) > 1 and np.isfinite(crossed.kn).any():
        pictures.append(
            BookPicture("Cross curves", functools.partial(cross_curve_picture, crossed))
        )
    return BookPart(
        "stability", "Stability", tuple(facts), tuple(tables), tuple(pictures),
        tuple(dict.fromkeys(notes)),
    )  # fmt: skip


_JUDGED = {True: "passed", False: "FAILED", None: "not evaluated"}


def _criteria(criteria: Sequence[Criterion]) -> BookTable:
    """List every criterion; what was not evaluated says so, and why."""
    return BookTable(
        "Criteria of the 2008 IS Code, part A",
        (BookColumn("A"), BookColumn("criterion"), BookColumn("required", "", 3),
         BookColumn("value", "", 4), BookColumn("unit"), BookColumn("result"), BookColumn("note")),
        tuple((each.code, each.name, each.required, each.value, each.unit, _JUDGED[each.passed],
               each.note) for each in criteria),
    )  # fmt: skip


def _levers(found: Stability) -> BookTable:
    heads = {
        "heel_deg": BookColumn("heel", "deg", 2), "kn": BookColumn("KN", "m", 4),
        "gz": BookColumn("GZ", "m", 4), "arm": BookColumn("dynamic arm", "m rad", 5),
        "draught_aft": BookColumn("T_A", "m", 4), "draught_fore": BookColumn("T_F", "m", 4),
    }  # fmt: skip
    columns = found.columns
    return BookTable(
        "Righting levers", tuple(heads[name] for name in columns), _rows(list(columns.values()))
    )


def _crossed(found: CrossCurves) -> BookTable:
    heads = (
        BookColumn("displacement", "t", 1), BookColumn("T", "m", 3),
        *(BookColumn(f"{heel:g}°", "m", 3) for heel in found.heel_deg.tolist()),
    )  # fmt: skip
    return BookTable(
        f"Cross curves: KN in m over heel to starboard, trim {found.trim}", heads,
        _rows([found.displacement, found.draught, *found.kn.T]), lead=2,
    )  # fmt: skip


# --------------------------------------------------------------------------------------
# Surface and plates, if they are there; how far numbers may be off.

_MM = 1e3


def _surface(asked: BookRequest, design: HydrostaticTable) -> BookPart:
    found = asked.surface
    if found is None:
        raise BadInputError("no surface is given", "in report", "give surface=hull.surface()")
    level = design.positions[0].draught_mean
    # of the bare hull, as the surface is
    bare = float(design.columns["volume"][0]) - sum(float(each.volume[0]) for each in design.shares)
    volume = 2.0 * integrate_below(found.patches, level).volume
    facts = [
        ("blocks", str(len(found.blocks))),
        ("patches", f"{sum(len(each.patches()) for each in found.patches)} of Bezier, of one half"),
        ("volume", f"{volume:.2f} m3 at {level:.3f} m, {volume - bare:+.2f} m3 beside the lines'"),
    ]
    if found.left_out:
        facts.append(("left out", ", ".join(found.left_out)))
    heads = (
        BookColumn("block"), BookColumn("lines"), BookColumn("points", "", 0),
        *(BookColumn(name, "mm", 2) for name in ("median", "p95", "p99", "largest")),
        BookColumn("limit", "mm", 1), BookColumn("largest on"),
    )  # fmt: skip
    rows = tuple(
        (block.name, each.kind, float(each.count),
         *(_MM * value for value in (each.median, each.p95, each.p99, each.largest)),
         _MM * block.limit if block.limit and each.kind == "fitted" else None, each.line)
        for block in found.blocks for each in block.residuals if each.count
    )  # fmt: skip
    table = BookTable("Distances of the lines from the surface", heads, rows)
    faults = surface_faults(found)
    notes = [f"{block.name}: {note}" for block in found.blocks for note in block.notes]
    return BookPart(
        "surface", "Surface", tuple(facts), (table,),
        (BookPicture("Surface", lambda: surface_figure(found, paper="A3")),),
        tuple(dict.fromkeys([*faults, *notes, *found.notes])),
    )  # fmt: skip


def _plates(asked: BookRequest) -> BookPart:
    found = asked.plates
    if found is None:
        raise BadInputError("no plates are given", "in report", "give plates=hull.plates(...)")
    heads = tuple(
        BookColumn(each.head, each.unit, None if each.style == "s" else 3)
        for each in found.columns if each.head
    )  # fmt: skip
    rows = tuple(
        tuple(each.printed(plate) for each in found.columns if each.head) for plate in found.rows
    )
    advice = BookTable(
        "What to do with each plate",
        (BookColumn("plate"), BookColumn("range"), BookColumn("advice")),
        tuple((plate.name, str(plate.range), plate.suggestion) for plate in found.rows),
    )
    facts = [("plates", str(len(found))), ("area", f"{found.area:.3f} m2, of half the hull")]
    return BookPart(
        "plates", "Shell plates", tuple(facts), (BookTable("Plates", heads, rows), advice),
        (BookPicture("Curvature of the shell", lambda: hull_map(found)),), (CAVEAT, *found.notes),
    )  # fmt: skip


def _accuracy(
    hull: HasState, asked: BookRequest, design: HydrostaticTable, table: HydrostaticTable
) -> BookPart:
    """Tell how far values may be off, what is wrong with the hull, and how lines were adopted."""
    at: FloatingPosition = design.positions[0]
    once = tuple(
        (_symbol(name), _rounded(value, field.digits),
         _error(design.errors[name][0] if name in design.errors else np.nan),
         "" if field.unit == "-" else field.unit, field.title)
        for name, field in FIELDS.items()
        if name not in _STATED and not np.isnan(value := design.columns[name][0])
    )  # fmt: skip
    errors = {name: each for name, each in table.errors.items() if name not in _STATED}
    tables = [
        BookTable(
            f"How far values may be off, at a draught of {at.draught_mean:.3f} m",
            (BookColumn("value"), BookColumn("number", "", 4), BookColumn("± off by", "", 6),
             BookColumn("unit"), BookColumn("meaning")), once,
        ),
        BookTable(
            "How far values may be off, over the draughts",
            (BookColumn("T", "m", 4), *(_column(name, 2) for name in errors)),
            _rows([[each.draught_mean for each in table.positions], *errors.values()]),
            turned=True,
        ),
    ]  # fmt: skip
    if asked.adoption is not None:
        tables.append(_adopted(asked.adoption))
    findings = [str(each) for each in check(hull.state)]
    facts = (
        ("hull", design.header.fingerprint),
        ("findings", f"{len(findings)}, listed below" if findings else "none in the net"),
        *_verdict(asked.adoption),
        ("errors", "by integrating these lines by a second rule; they do not say how true the "
                   "lines are to a ship"),
    )  # fmt: skip
    told = () if asked.adoption is None else asked.adoption.notes
    doubted = [each for each in told if each.startswith(("fault: ", "suspicion: "))]
    notes = (*findings, *doubted, *design.notes, *table.notes)
    return BookPart(
        "accuracy", "Error bars and findings", facts, tuple(tables), (),
        tuple(dict.fromkeys(notes)),
    )  # fmt: skip


def _verdict(adoption: AdoptionReport | None) -> Iterator[tuple[str, str]]:
    """Give the verdict on a hull that was read, with its words."""
    for note in () if adoption is None else adoption.notes:
        title, told, words = note.partition(": ")
        if told and title == "verdict":
            yield "import", f"{words}{_LISTED if '(' in words else ''}"


_LISTED = ", listed below"
_STATED = ("draught_mean", "trim_by_stern")
"""Values that are stated, not computed."""

_NO_ERROR = 1e-9
_WHOLE = 1.0 + 1e-9


def _rounded(value: float, digits: int) -> Rounded:
    return Rounded(float(value), digits)


def _error(value: float) -> Cell:
    """Give an error with one digit that counts."""
    if np.isnan(value):
        return None
    if value < _NO_ERROR:
        return Rounded(0.0, 0)
    digits = 0 if value >= 1.0 else min(9, int(-np.floor(np.log10(value))))
    return Rounded(float(value), digits)


def _adopted(report: AdoptionReport) -> BookTable:
    names = [each.line for each in report.lines]
    rows = tuple(
        # a line of several curves has a row for each
        (each.line if names.count(each.line) == 1
         else f"{each.line}, curve {names[:number].count(each.line) + 1}",
         float(each.given), _MM * each.deviation_median, _MM * each.deviation_p95,
         _MM * each.deviation, _MM * each.tolerance,
         "beyond its tolerance" if each.tolerance_used > _WHOLE else "")
        for number, each in enumerate(report.lines)
    )  # fmt: skip
    heads = (
        BookColumn("line"), BookColumn("points", "", 0),
        *(BookColumn(name, "mm", 2) for name in ("median", "p95", "largest", "tolerance")),
        BookColumn("note"),
    )  # fmt: skip
    return BookTable("How far the curves pass the points they were made of", heads, rows)
