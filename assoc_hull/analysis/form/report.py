"""Form parameters of a hull as a report: what they hold good for, parts with headings, notes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from typing import Any

import attrs

from assoc_hull.analysis.form.catalogue import CATALOGUE
from assoc_hull.analysis.form.form_parameters import form_parameters, shape_of
from assoc_hull.analysis.form.parameter import Parameter
from assoc_hull.analysis.form.screw import Screw
from assoc_hull.analysis.form.tables import GIVEN, TABLES, TITLES, by_table
from assoc_hull.analysis.form.value import Value
from assoc_hull.analysis.hydrostatics.floating import FloatingPosition, planes_of
from assoc_hull.analysis.hydrostatics.hydrostatic_header import SALT, HydrostaticHeader
from assoc_hull.analysis.hydrostatics.measured_hull import HasState, state_of
from assoc_hull.arguments import all_of, choice, text
from assoc_hull.errors import BadInputError
from assoc_hull.model.definition.definition import fingerprint

__all__ = ["FormReport", "Part", "Row", "form_report", "number_text"]

_HEAD = (
    "ship", "design draught", "datum", "water", "shell factor", "wetted surface", "deck", "date",
    "fingerprint",
)  # fmt: skip
_WHERE = "in a report of form parameters"


@attrs.frozen
class Row:
    """A line of a report.

    Attributes
    ----------
    entry : Parameter
        What it is.
    value : Value
        A number, or the reason why there is none.
    notes : tuple of int
        Numbers of the notes that stand below the report for it, from 1.
    """

    entry: Parameter
    value: Value
    notes: tuple[int, ...]

    @property
    def mark(self) -> str:
        """The notes as they are marked in the line."""
        return ",".join(map(str, self.notes)) + ")" if self.notes else ""


@attrs.frozen
class Part:
    """Lines of a report below a heading; `table` is the part of the catalogue."""

    table: str
    title: str
    rows: tuple[Row, ...]


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
    entries : mapping of str to Parameter
        The entries of all values, by symbol.
    particulars, values : mapping of str to Value
        Principal particulars, which stand in the head whatever is wanted; what was wanted.
    doubts : tuple of str
        What makes the integrals doubtful.
    """

    header: HydrostaticHeader
    position: FloatingPosition
    screw: Screw | None
    entries: Mapping[str, Parameter]
    particulars: Mapping[str, Value]
    values: Mapping[str, Value]
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
    def parts(self) -> tuple[Part, ...]:
        """The particulars, and the parts of the catalogue of which something was wanted."""
        number = {words: k for k, words in enumerate(self.notes, 1)}

        def row(entry: Parameter) -> Row:
            value = self._value(entry)
            return Row(entry, value, tuple(number[words] for words in _remarks(value)))

        return tuple(
            Part(table, TITLES.get(table, table), tuple(map(row, entries)))
            for table, entries in self._by_table.items()
        )

    @cached_property
    def _by_table(self) -> dict[str, list[Parameter]]:
        """The entries that stand in the report: as they were wanted, below the particulars."""
        symbols = {**self.particulars, **self.values}
        return by_table(self.entries[symbol] for symbol in symbols)

    def _value(self, entry: Parameter) -> Value:
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
    further: Iterable[Parameter] = (),
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
    >>> from assoc_hull.analysis.form.report import form_report
    >>> from assoc_hull.sources import examples
    >>> report = form_report(examples.wigley(), draught=6.25, only=["V", "Cb"])
    >>> [part.title for part in report.parts]
    ['Principal particulars', 'Hydrostatic values']
    """
    if date is not None:
        text(date, "date", _WHERE)
    some = (further,) if isinstance(further, Parameter) else further
    own = tuple(all_of(some, Parameter, "further", _WHERE))
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
    entries: Mapping[str, Parameter], only: Iterable[str] | None, tables: Iterable[str] | None
) -> Iterable[str] | None:
    """Give the symbols wanted; None: all."""
    if tables is None:
        return only
    if only is not None:
        raise BadInputError("only and tables are both given", _WHERE, "give one of them")
    some = (tables,) if isinstance(tables, str) else all_of(tables, str, "tables", _WHERE)
    chosen = [choice(each, "a table", TABLES, _WHERE) for each in some]
    return [symbol for symbol, each in entries.items() if each.table in chosen]


def number_text(row: Row) -> str:
    """Give the number of a line as it is printed; a dash where there is none."""
    if row.value.number is None:
        return "-"
    digits = row.entry.digits
    return f"{round(row.value.number, digits) + 0.0:.{digits}f}"


def _remarks(value: Value) -> Iterator[str]:
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
