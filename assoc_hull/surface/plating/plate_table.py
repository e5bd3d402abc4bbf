"""Plates as a table: what its columns are, in print and in files, and choosing a row or a column.

Names and units of columns are also those of files. `PlateTable` holds plates of single surfaces;
that of a hull, `assoc_hull.surface.plating.hull_plates.HullPlateTable`, adds seams and fits.

Examples
--------
>>> from types import SimpleNamespace
>>> from assoc_hull.surface.plating.plate_table import COLUMNS
>>> COLUMNS[1].name, COLUMNS[1].printed(SimpleNamespace(area=1e-14))
('area', '0.000')
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from operator import attrgetter
from typing import Any

import attrs
import numpy as np

from assoc_hull.arguments import shown, shown_name
from assoc_hull.display import ShownAsText
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.plating.options import PlateOptions
from assoc_hull.surface.plating.plate import Plate
from assoc_hull.surface.plating.plate_class import CAVEAT
from assoc_hull.surface.regions.result import RegionResult

__all__ = ["COLUMNS", "HULL_COLUMNS", "PlateColumn", "PlateTable"]

_NIL = 1e-12
"""Below this a number is printed as 0."""


@attrs.frozen
class PlateColumn:
    """A column of a table of plates.

    Attributes
    ----------
    name : str
        Its name in files and of `PlateTable.column`.
    unit : str
        Its unit; "" of words and of numbers without one.
    head : str
        What stands over it in print; "" of a column that is in files only.
    style : str
        The format of its numbers in print.
    value : callable
        What a plate has there.
    """

    name: str
    unit: str
    head: str
    style: str
    value: Callable[[Any], Any]

    def printed(self, plate: Any) -> str:
        """Write the value: a dash for none, 0 for what rounding leaves of nil, ? after a doubt."""
        value = self.value(plate)
        if isinstance(value, float) and abs(value) < _NIL:
            value = 0.0
        words = "-" if value is None else format(value, self.style)
        return words + "?" * (self.name == "kind" and plate.is_doubtful)


def _column(
    name: str,
    unit: str = "",
    head: str = "",
    style: str = "",
    of: Callable[[Any], Any] | None = None,
) -> PlateColumn:
    return PlateColumn(name, unit, head, style, of or attrgetter(name))


def _percent(name: str, head: str = "", of: str = "") -> PlateColumn:
    """Give the column of a part of the area, in per cent."""
    part = attrgetter(of or f"shares.{name}")
    return _column(name, "%", head, ".1f", lambda plate: 100.0 * part(plate))


_KNOWN = {each.name: each for each in (
    _column("name", "", "plate", "s"),
    _column("range", "", "", "s", lambda plate: str(plate.range)),
    _column("area", "m2", "area", ".3f"),
    _column("length", "m", "a", ".2f"),
    _column("breadth", "m", "b", ".2f"),
    _column("k0", "1/m2", "K0", ".3g"),
    _column("dk", "1/m2", "dK", ".1e"),
    _percent("convex", "convex"),
    _percent("saddle", "saddle"),
    _percent("cylinder", "cyl."),
    _percent("flat", "flat"),
    _percent("unresolved", "unres."),
    _percent("developable"),
    _percent("contested", "contested", "contested"),
    _percent("changed", "changed", "changed"),
    _column("kind", "", "class", "s"),
    _column("order", "", "order", "d"),
    _column("rollable"),
    _column("roll_axis", "deg", "axis", ".1f"),
    _column("coherence", "", "coh.", ".2f"),
    _column("least_radius", "m", "R least", ".2f"),
    _column("largest_radius", "m"),
    _column("total_curvature", "", "int |K|", ".2e"),
    _column("mean_strain", "", "strain", ".1e"),
    _column("largest_strain"),
    _column("lines", "", "lines", "d"),
    _column("unresolved_area", "m2", "unres.", ".2g"),
    _column("band_breadth", "m"),
    _column("heating"),
    _column("area_error", "m2"),
    _column("suggestion"),
)}  # fmt: skip
"""Every column that a table of plates may have."""


def _laid_out(printed: str, filed: str) -> tuple[PlateColumn, ...]:
    """Choose columns by name: those that are printed too, then those of files only."""
    quiet = (attrs.evolve(_KNOWN[name], head="", style="") for name in filed.split())
    return (*(_KNOWN[name] for name in printed.split()), *quiet)


COLUMNS = _laid_out(
    "name area length breadth k0 convex saddle cylinder flat kind order roll_axis coherence "
    "least_radius total_curvature mean_strain lines unresolved_area",
    "band_breadth unresolved developable rollable largest_radius largest_strain heating area_error "
    "suggestion",
)
"""The columns of plates of surfaces, in the order of files; those with a head are printed."""

HULL_COLUMNS = _laid_out(
    "name range area length breadth k0 dk convex saddle cylinder flat unresolved contested changed "
    "kind roll_axis coherence least_radius mean_strain",
    "order rollable largest_radius total_curvature largest_strain area_error suggestion",
)
"""The columns of plates of a hull, likewise."""


@attrs.frozen(eq=False, repr=False)
class PlateTable(ShownAsText):
    """Plates of a shell, one row each.

    Attributes
    ----------
    rows : tuple of Plate
        The plates.
    options : PlateOptions
        By what they were told apart.
    results : tuple of RegionResult
        The regions: one result for all, or one for each plate where each has its own band.
    """

    rows: tuple[Plate, ...]
    options: PlateOptions
    results: tuple[RegionResult, ...] = attrs.field(repr=False)

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[Plate]:
        return iter(self.rows)

    def __getitem__(self, which: int | str) -> Plate:
        """Give a plate by its number from 0, or by its name.

        Raises
        ------
        BadInputError, UnknownNameError, WrongTypeError
            No such number or name; a name that several have.
        """
        rows, where = self.rows, f"in {self._called}"
        if isinstance(which, str):
            found = [plate for plate in rows if plate.name == which]
            if not found:
                names = tuple(plate.name for plate in rows)
                raise UnknownNameError("plate", shown_name(which), names)
            if len(found) > 1:
                what = f"{len(found)} plates are named {which!r}"
                raise BadInputError(what, where, "give the number of one")
            return found[0]
        if isinstance(which, bool) or not isinstance(which, int | np.integer):
            raise WrongTypeError(f"a plate is {shown(which)}", where, "give a number or a name")
        if not -len(rows) <= which < len(rows):
            remedy = f"give 0 to {len(rows) - 1}"
            raise BadInputError(f"there is no plate {shown(which)}", where, remedy)
        return rows[which]

    @property
    def columns(self) -> tuple[PlateColumn, ...]:
        """The columns, in the order of files; those with a head are printed."""
        return COLUMNS

    @property
    def area(self) -> float:
        """The area of all plates, m2; of a hull that of its half."""
        return float(sum(plate.area for plate in self.rows))

    @property
    def computed(self) -> int:
        """How many patches were computed; the others were taken from earlier plates."""
        return sum(each.computed for each in self.results)

    @property
    def notes(self) -> tuple[str, ...]:
        """What is to be known of regions and plates, each a sentence."""
        regions = (note for each in self.results for note in each.notes)
        return (*regions, *(note for plate in self.rows for note in plate.notes))

    @property
    def surfaces(self) -> tuple[SplineSurface, ...]:
        """The surface of each plate; none of a hull, whose plates are cut from its blocks."""
        return tuple(plate.surface for plate in self.rows if plate.surface is not None)

    def result_of(self, number: int) -> RegionResult:
        """Give the regions that hold a plate, by its number from 0; its `Plate.number` is there."""
        self[number]
        return self.results[0] if len(self.results) == 1 else self.results[number]

    def column(self, name: str) -> list[Any]:
        """Give what all plates have in a column.

        Raises
        ------
        UnknownNameError
            No such column.
        """
        wanted = shown_name(name)
        for each in self.columns:
            if each.name == wanted:
                return [each.value(plate) for plate in self.rows]
        raise UnknownNameError("column", wanted, tuple(each.name for each in self.columns))

    def table(self) -> list[dict[str, Any]]:
        """Give all as plain values, a dictionary for each plate; units are those of `columns`."""
        return [{each.name: each.value(plate) for each in self.columns} for plate in self.rows]

    def __str__(self) -> str:
        """Write the table, the advice, and what is to be known."""
        rows = _printed_rows(self.columns, self.rows)
        return "\n".join([*rows, "", *self._advice(), CAVEAT, *self._facts(), *self.notes])

    @property
    def _called(self) -> str:
        return "Plates"

    def _advice(self) -> Iterator[str]:
        """Write the suggestion of each plate, with rulings where no single axis serves."""
        for plate in self.rows:
            yield f"{plate.name}: {plate.suggestion}."
            if plate.rollable and plate.kind != "flat" and plate.roll_axis is None:
                yield f"  rulings: {plate.rulings(5)}"

    def _facts(self) -> Iterator[str]:
        """Say what counted as no curvature."""
        band = self.results[0].band
        if len(self.results) == 1:
            yield f"{band}; strains are those of each plate's own breadth b."
        else:
            tol = band.strain_tol
            yield f"K0 by strain {tol:g} over the breadth b of each plate; strains likewise."


def _printed_rows(columns: Sequence[PlateColumn], rows: Sequence[Plate]) -> Iterator[str]:
    """Write the columns that have a head: heads, units, a row a plate."""
    seen = [each for each in columns if each.head]
    body = [[each.printed(plate) for each in seen] for plate in rows]
    table = [[each.head for each in seen], [each.unit for each in seen], *body]
    wide = [max(map(len, column)) for column in zip(*table, strict=True)]
    for row in table:
        first, *others = (
            f"{text:<{width}}" if i == 0 else f"{text:>{width}}"
            for i, (text, width) in enumerate(zip(row, wide, strict=True))
        )
        yield "  ".join([first, *others]).rstrip()
