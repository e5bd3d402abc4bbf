"""Rows of plates, as a table: names, units, text.

Examples
--------
>>> from assoc_hull.surface.plates.plate_table import COLUMNS
>>> [column.name for column in COLUMNS][:4]
['name', 'area', 'length', 'breadth']
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import attrs

from assoc_hull.surface.plates.columns import Column, column_of, own, plate_at, printed_rows, share
from assoc_hull.surface.plates.options import PlateOptions
from assoc_hull.surface.plates.plate import Plate
from assoc_hull.surface.plates.suggestions import CAVEAT
from assoc_hull.surface.regions.region_result import RegionResult

__all__ = ["COLUMNS", "Plates"]

COLUMNS: tuple[Column, ...] = (
    Column("name", "", "plate", "s", own("name")),
    Column("area", "m2", "area", ".3f", own("area")),
    Column("length", "m", "a", ".2f", own("length")),
    Column("breadth", "m", "b", ".2f", own("breadth")),
    Column("k0", "1/m2", "K0", ".3g", own("k0")),
    Column("convex", "%", "convex", ".1f", share("convex")),
    Column("saddle", "%", "saddle", ".1f", share("saddle")),
    Column("cylinder", "%", "cyl.", ".1f", share("cylinder")),
    Column("flat", "%", "flat", ".1f", share("flat")),
    Column("kind", "", "class", "s", own("kind")),
    Column("order", "", "order", "d", own("order")),
    Column("roll_axis", "deg", "axis", ".1f", own("roll_axis")),
    Column("coherence", "", "coh.", ".2f", own("coherence")),
    Column("least_radius", "m", "R least", ".2f", own("least_radius")),
    Column("total_curvature", "", "int |K|", ".2e", own("total_curvature")),
    Column("mean_strain", "", "strain", ".1e", own("mean_strain")),
    Column("lines", "", "lines", "d", own("lines")),
    Column("unresolved_area", "m2", "unres.", ".2g", own("unresolved_area")),
    Column("band_breadth", "m", "", "", own("band_breadth")),
    Column("unresolved", "%", "", "", share("unresolved")),
    Column("developable", "%", "", "", lambda plate: 100.0 * plate.shares.developable),
    Column("rollable", "", "", "", own("rollable")),
    Column("largest_radius", "m", "", "", own("largest_radius")),
    Column("largest_strain", "", "", "", own("largest_strain")),
    Column("heating", "", "", "", own("heating")),
    Column("area_error", "m2", "", "", lambda plate: plate.areas.error_estimate),
    Column("suggestion", "", "", "", own("suggestion")),
)
"""The columns, in the order of files; those with a head are printed."""


@attrs.frozen(eq=False)
class Plates:
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
    results: tuple[RegionResult, ...]

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
        return plate_at(self.rows, which, "in Plates")

    def result_of(self, number: int) -> RegionResult:
        """Give the regions that hold a plate, by its number from 0; its `Plate.number` is there."""
        self[number]
        return self.results[0] if len(self.results) == 1 else self.results[number]

    @property
    def computed(self) -> int:
        """How many patches were computed; the others were taken from earlier plates."""
        return sum(each.computed for each in self.results)

    @property
    def notes(self) -> tuple[str, ...]:
        """What is to be known of regions and plates, each a sentence."""
        regions = (note for each in self.results for note in each.notes)
        return (*regions, *(note for plate in self.rows for note in plate.notes))

    def column(self, name: str) -> list[Any]:
        """Give what all plates have in a column.

        Raises
        ------
        UnknownNameError
            No such column.
        """
        return column_of(COLUMNS, self.rows, name)

    def table(self) -> list[dict[str, Any]]:
        """Give all as plain values, a dictionary for each plate; units are those of `COLUMNS`."""
        return [{each.name: each.value(plate) for each in COLUMNS} for plate in self.rows]

    def __str__(self) -> str:
        """Write the table, the advice, and what is to be known."""
        lines = [*printed_rows(COLUMNS, self.rows), "", *self._advice(), CAVEAT, str(self._band())]
        return "\n".join([*lines, *self.notes])

    def _advice(self) -> Iterator[str]:
        """Write the suggestion of each plate, with rulings where no single axis serves."""
        for plate in self.rows:
            yield f"{plate.name}: {plate.suggestion}."
            if plate.rollable and plate.kind != "flat" and plate.roll_axis is None:
                yield f"  rulings: {plate.rulings(5)}"

    def _band(self) -> str:
        """Say what counted as no curvature."""
        if len(self.results) == 1:
            return f"{self.results[0].band}; strains are those of each plate's own breadth b."
        tol = self.results[0].band.strain_tol
        return f"K0 by strain {tol:g} over the breadth b of each plate; strains likewise."
