"""The catalogue of form parameters, their values for a hull, and the report of them.

`form_parameters` gives values by symbol, upright at a draught; they are kept until a line of the
hull changes. `form_report` puts them into parts with headings and notes, and says what they hold
good for.

The catalogue of form parameters: all entries in their order, and the tables they stand in.

Entries stand in modules by subject (`assoc_hull.analysis.form.entries`). An entry of one's own is
handed to `form_parameters` and needs no change anywhere.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from types import MappingProxyType
from typing import Any, get_args

import attrs

from assoc_hull.analysis.form.entries.bow import BOW
from assoc_hull.analysis.form.entries.coefficients import (
    PROPORTIONS,
    VOLUME_COEFFICIENTS,
    WATERPLANE_COEFFICIENTS,
)
from assoc_hull.analysis.form.entries.particulars import PARTICULARS, RECORD_VALUES
from assoc_hull.analysis.form.entries.resistance import RESISTANCE
from assoc_hull.analysis.form.entries.sections import AFTER_SECTION, FORE_SECTION, MIDSHIP
from assoc_hull.analysis.form.entries.ship_parts import SHIP_PARTS
from assoc_hull.analysis.form.entries.stern import SKEG, STERN
from assoc_hull.analysis.form.entries.waterline import WATERLINE
from assoc_hull.analysis.form.floating_shape import FloatingShape, Screw
from assoc_hull.analysis.form.parameter import (
    FormParameter,
    FormValue,
    Table,
    check_catalogue,
    evaluate,
)
from assoc_hull.analysis.hydrostatics.floating_body import (
    FloatingPosition,
    planes_of,
    require_numbers,
)
from assoc_hull.analysis.hydrostatics.flotation import flotation, header_of
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import position_of
from assoc_hull.analysis.hydrostatics.record import SALT, HydrostaticHeader
from assoc_hull.arguments import (
    all_of,
    choice,
    shown,
    text,
)
from assoc_hull.errors import BadInputError, WrongTypeError
from assoc_hull.model.definition.fingerprint import fingerprint
from assoc_hull.model.named_mapping import NamedMapping
from assoc_hull.model.tables import HasState, state_of

__all__ = [
    "CATALOGUE",
    "GIVEN",
    "TABLES",
    "TITLES",
    "FormReport",
    "ReportPart",
    "ReportRow",
    "by_table",
    "form_parameters",
    "form_report",
    "number_text",
    "shape_of",
]

# --------------------------------------------------------------------------------------
# Tables: their order and their headings.

TABLES: tuple[str, ...] = get_args(Table)
"""Parts of the catalogue, in their order."""

GIVEN = TABLES[0]
"""The part of the principal particulars."""

TITLES: Mapping[str, str] = MappingProxyType(
    {
        "particulars": "Principal particulars",
        "hydrostatic": "Hydrostatic values",
        "hull form": "Hull form",
        "bulb and resistance": "Bulb and resistance",
        "measures": "Measures on which others rest",
    }
)
"""Headings of the parts."""

_PAPER = (
    "V Disp Cb Amax Cm LWL Cp LCB Cpa Cpf LCBa LCBf Ea Ef Ea' B' As Cb/(L/B) BAR Cb4 ATT Br03 "
    "Cpa' CPR CPE Cw LCF Cwa Cwf LCFa LCFf Eangle Cwa' Sigma_a Sigma_f Cvpa' Sigma_a' WSA KMT "
    "Bluntness VCB PI LIBA TRZ TRHL TRAR TRAR_paper TTLS "
    "BR Abulb Tau L Ldiag L/Ldiag BCL B07 S3.A1 S3.A2 S3 S3'.A1 S3'.A2 S3' Rfwd Raft SCH PMBs "
    "PMBe SO TH SA SBx SBD BL BLR BH BW StemA LBA Hap Rangle PTC HSKEG LSKEG ASKEG XSKEG RSKEG "
    "TwDS TwTTL TwVSA TwLSA"
)
_PLACE = {symbol: place for place, symbol in enumerate(_PAPER.split())}
"""Where entries stand in Tables 3 and 4 of Son and Kim (2008); others follow them."""


def by_table(entries: Iterable[FormParameter]) -> dict[str, list[FormParameter]]:
    """Sort entries into the parts of the catalogue, in the order of the paper's tables.

    What stands in none of them follows, in the order of the catalogue. Parts that only entries of a
    caller's own name come last; parts without entries do not come.

    Examples
    --------
    >>> from assoc_hull.analysis.form.form_parameters import CATALOGUE
    >>> from assoc_hull.analysis.form.form_parameters import by_table
    >>> [each.symbol for each in by_table(CATALOGUE.values())["particulars"]][:2]
    ['Lpp', 'B']
    """
    found: dict[str, list[FormParameter]] = {table: [] for table in TABLES}
    for each in sorted(entries, key=lambda entry: _PLACE.get(entry.symbol, len(_PLACE))):
        found.setdefault(each.table, []).append(each)
    return {table: some for table, some in found.items() if some}


# --------------------------------------------------------------------------------------
# All entries: whatever a part of a module of entries holds is taken.

CATALOGUE = NamedMapping(
    "form parameter",
    # The order of reports, of tables and of JSON.
    check_catalogue(
        (
            *PARTICULARS,
            *RECORD_VALUES,
            *VOLUME_COEFFICIENTS,
            *WATERPLANE_COEFFICIENTS,
            *PROPORTIONS,
            *RESISTANCE,
            *SHIP_PARTS,
            *WATERLINE,
            *BOW,
            *MIDSHIP,
            *STERN,
            *FORE_SECTION,
            *AFTER_SECTION,
            *SKEG,
        )
    ),
)
"""The catalogue, by symbol."""


# --------------------------------------------------------------------------------------
# Values.

_WHERE = "in form parameters"
_MOST = 8
"""Number of positions of a hull that are kept, until a line changes."""


def form_parameters(
    hull: HasState,
    *,
    draught: float | None = None,
    draughts: tuple[float, float] | None = None,
    screw: Screw | None = None,
    rho: float = SALT,
    shell_factor: float = 1.0,
    transom: bool = False,
    only: Iterable[str] | None = None,
    further: Iterable[FormParameter] = (),
) -> Mapping[str, FormValue]:
    """Give the form parameters of a hull, upright at a draught.

    The arguments and what is raised are those of `Hull.form_parameters`.
    """
    shape, known = _shape(hull, draught, draughts, screw, rho, shell_factor, transom)
    own = _entries(further)
    entries: Mapping[str, FormParameter] = CATALOGUE
    if own:
        entries = NamedMapping("form parameter", check_catalogue([*CATALOGUE.values(), *own]))
        known = dict(known)  # another call may bring another entry of this name
    wanted = tuple(entries) if only is None else _symbols(only)
    return NamedMapping("form parameter", evaluate(entries, wanted, shape, known))


def _entries(further: object) -> tuple[FormParameter, ...]:
    """Take entries of a caller's own."""
    found = tuple(further) if isinstance(further, Iterable) else (further,)
    for each in found:
        if not isinstance(each, FormParameter):
            raise WrongTypeError(
                f"further holds {shown(each)}", _WHERE, "give entries made by `parameter`"
            )
    return found


def _symbols(only: object) -> tuple[str, ...]:
    """Take symbols; one alone may come without a list."""
    found = (only,) if isinstance(only, str) or not isinstance(only, Iterable) else tuple(only)
    for each in found:
        if not isinstance(each, str):
            raise WrongTypeError(f"only holds {shown(each)}", _WHERE, "give symbols of entries")
    return found


def shape_of(
    hull: HasState,
    *,
    draught: float | None = None,
    draughts: tuple[float, float] | None = None,
    screw: Screw | None = None,
    rho: float = SALT,
    shell_factor: float = 1.0,
    transom: bool = False,
) -> FloatingShape:
    """Give what entries of the catalogue measure; arguments as for `form_parameters`."""
    return _shape(hull, draught, draughts, screw, rho, shell_factor, transom)[0]


def _shape(
    hull: HasState,
    draught: float | None,
    draughts: tuple[float, float] | None,
    screw: Screw | None,
    rho: float,
    shell_factor: float,
    transom: bool,
) -> tuple[FloatingShape, dict[str, FormValue]]:
    """Give a hull at its position, and what is known of it."""
    if not (screw is None or isinstance(screw, Screw)):
        raise WrongTypeError(f"screw is {shown(screw)}", _WHERE, "give a Screw")
    state = state_of(hull)
    body = flotation(state)
    terms = {"rho": rho, "shell_factor": shell_factor, "transom": transom, "fingerprint": "",
             "appendages": ()}  # fmt: skip
    header = header_of(hull, body, terms)
    require_numbers(draughts if draught is None else draught, body.limits)
    position = position_of(header, draught, draughts, 0.0, "moulded")
    key = ("form", position, screw, header.rho, header.shell_factor, header.transom)
    depth = state.particulars.depth
    # the values come into the dict as they are asked for; nothing else changes what is kept
    return state.derived(
        key, (body,), lambda: (FloatingShape(body, header, position, depth, screw), {}), _MOST
    )


# --------------------------------------------------------------------------------------
# The report.

_HEAD = (
    "ship", "design draught", "datum", "water", "shell factor", "wetted surface", "deck", "date",
    "fingerprint",
)  # fmt: skip
_IN_REPORT = "in a report of form parameters"


@attrs.frozen
class ReportRow:
    """A line of a report.

    Attributes
    ----------
    entry : FormParameter
        What it is.
    value : FormValue
        A number, or the reason why there is none.
    notes : tuple of int
        Numbers of the notes that stand below the report for it, from 1.
    """

    entry: FormParameter
    value: FormValue
    notes: tuple[int, ...]

    @property
    def mark(self) -> str:
        """The notes as they are marked in the line."""
        return ",".join(map(str, self.notes)) + ")" if self.notes else ""


@attrs.frozen
class ReportPart:
    """Lines of a report below a heading; `table` is the part of the catalogue."""

    table: str
    title: str
    rows: tuple[ReportRow, ...]


@attrs.frozen(eq=False)
class FormReport:
    """Form parameters of a hull, upright at a draught.

    Attributes
    ----------
    header : HydrostaticHeader
        Ship, dimensions, water, fingerprint, date.
    position : FloatingPosition
        Where it floats.
    screw : Screw or None
        If it was given.
    entries : mapping of str to FormParameter
        The entries of all values, by symbol.
    particulars, values : mapping of str to FormValue
        Principal particulars, which stand in the head whatever is wanted; what was wanted.
    doubts : tuple of str
        What makes the integrals doubtful.
    """

    header: HydrostaticHeader
    position: FloatingPosition
    screw: Screw | None
    entries: Mapping[str, FormParameter]
    particulars: Mapping[str, FormValue]
    values: Mapping[str, FormValue]
    doubts: tuple[str, ...]

    @cached_property
    def notes(self) -> tuple[str, ...]:
        """Reasons and warnings, each once, as they come up from part to part."""
        found = dict[str, None]()
        for entries in self._by_table.values():
            for each in entries:
                found.update(dict.fromkeys(_remarks(self._value(each))))
        return tuple(found)

    @cached_property
    def parts(self) -> tuple[ReportPart, ...]:
        """The particulars, and the parts of the catalogue of which something was wanted."""
        number = {words: k for k, words in enumerate(self.notes, 1)}

        def row(entry: FormParameter) -> ReportRow:
            value = self._value(entry)
            return ReportRow(entry, value, tuple(number[words] for words in _remarks(value)))

        return tuple(
            ReportPart(table, TITLES.get(table, table), tuple(map(row, entries)))
            for table, entries in self._by_table.items()
        )

    @cached_property
    def _by_table(self) -> dict[str, list[FormParameter]]:
        """The entries that stand in the report: as they were wanted, below the particulars."""
        symbols = {**self.particulars, **self.values}
        return by_table(self.entries[symbol] for symbol in symbols)

    def _value(self, entry: FormParameter) -> FormValue:
        """Give the value of an entry, a particular or what was wanted."""
        chosen = self.values if entry.symbol in self.values else self.particulars
        return chosen[entry.symbol]

    def lines(self) -> Iterator[tuple[str, str]]:
        """Give the head, but for the particulars, as pairs of a title and words."""
        known = {**dict(self.header.lines()), "design draught": f"{self.header.draught:.3f} m"}
        yield from ((title, known[title]) for title in _HEAD if title in known)
        yield "screw", _screw_words(self.screw)
        yield from (("doubt", each) for each in self.doubts)


def form_report(
    hull: HasState,
    *,
    draught: float | None = None,
    draughts: tuple[float, float] | None = None,
    screw: Screw | None = None,
    rho: float = SALT,
    shell_factor: float = 1.0,
    transom: bool = False,
    only: Iterable[str] | None = None,
    tables: Iterable[str] | None = None,
    further: Iterable[FormParameter] = (),
    date: str | None = None,
) -> FormReport:
    """Report the form parameters of a hull, upright at a draught.

    Parameters
    ----------
    hull : Hull
        The hull.
    draught, draughts, screw, rho, shell_factor, transom, further
        As for `form_parameters`.
    only : iterable of str or None
        Symbols of the entries wanted.
    tables : iterable of str or None
        Or parts of the catalogue, such as "hull form"; all entries if neither is given.
    date : str or None
        For the head.

    Raises
    ------
    BadInputError
        As `form_parameters`; also `only` beside `tables`, or a part that is none.

    Examples
    --------
    >>> from assoc_hull.analysis.form.form_parameters import form_report
    >>> from assoc_hull.hull.sources import examples
    >>> report = form_report(examples.wigley(), draught=6.25, only=["V", "Cb"])
    >>> [part.title for part in report.parts]
    ['Principal particulars', 'Hydrostatic values']
    """
    if date is not None:
        text(date, "date", _IN_REPORT)
    some = (further,) if isinstance(further, FormParameter) else further
    own = tuple(all_of(some, FormParameter, "further", _IN_REPORT))
    entries = {**CATALOGUE, **{each.symbol: each for each in own}}
    place: dict[str, Any] = {"draught": draught, "draughts": draughts, "screw": screw, "rho": rho,
             "shell_factor": shell_factor, "transom": transom}  # fmt: skip
    values = form_parameters(
        hull,
        **place,
        only=_wanted(entries, only, tables),
        further=own,
    )
    given = [s for s, each in entries.items() if each.table == GIVEN]
    particulars = form_parameters(hull, **place, only=given, further=own)
    shape = shape_of(hull, **place)
    header = attrs.evolve(shape.header, fingerprint=fingerprint(state_of(hull)), date=date)
    doubts = shape.body.doubts(planes_of([shape.position], shape.length), False)
    return FormReport(header, shape.position, screw, entries, particulars, values, tuple(doubts))


def _wanted(
    entries: Mapping[str, FormParameter], only: Iterable[str] | None, tables: Iterable[str] | None
) -> Iterable[str] | None:
    """Give the symbols wanted; None: all."""
    if tables is None:
        return only
    if only is not None:
        raise BadInputError("only and tables are both given", _IN_REPORT, "give one of them")
    some = (tables,) if isinstance(tables, str) else all_of(tables, str, "tables", _IN_REPORT)
    chosen = [choice(each, "a table", TABLES, _IN_REPORT) for each in some]
    return [symbol for symbol, each in entries.items() if each.table in chosen]


def number_text(row: ReportRow) -> str:
    """Give the number of a line as it is printed; a dash where there is none."""
    if row.value.number is None:
        return "-"
    digits = row.entry.digits
    return f"{round(row.value.number, digits) + 0.0:.{digits}f}"


def _remarks(value: FormValue) -> Iterator[str]:
    yield from (each for each in (value.reason, value.warning) if each is not None)


def _screw_words(screw: Screw | None) -> str:
    if screw is None:
        return "not given"
    words = [f"diameter {screw.diameter:g} m", f"shaft {screw.height:g} m above the base line"]
    if screw.x is not None:
        words.append(f"x {screw.x:g} m")
    words.append(f"two, {screw.spacing:g} m apart" if screw.spacing else "one")
    if screw.boss_diameter is not None:
        words.append(f"boss {screw.boss_diameter:g} m")
    if screw.boss_x is not None:
        words.append(f"its aft face at x {screw.boss_x:g} m")
    return ", ".join(words)
