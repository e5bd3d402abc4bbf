"""Plates of a hull as a table: names, units, text.

Examples
--------
>>> from assoc_hull.surface.plates.hull_plate_table import COLUMNS
>>> [column.name for column in COLUMNS][:4]
['name', 'range', 'area', 'length']
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import attrs

from assoc_hull.surface.plates.columns import Column, column_of, own, plate_at, printed_rows, share
from assoc_hull.surface.plates.hull_plate import HullPlate
from assoc_hull.surface.plates.hull_seams import HullSeams
from assoc_hull.surface.plates.options import PlateOptions
from assoc_hull.surface.plates.shell import Shell
from assoc_hull.surface.plates.suggestions import CAVEAT
from assoc_hull.surface.regions.region_result import RegionResult

__all__ = ["COLUMNS", "HullPlates"]

_SEEN = 1e-3
"""m2: slivers below this are not told."""


COLUMNS: tuple[Column, ...] = (
    Column("name", "", "plate", "s", own("name")),
    Column("range", "", "", "s", lambda plate: str(plate.range)),
    Column("area", "m2", "area", ".3f", own("area")),
    Column("length", "m", "a", ".2f", own("length")),
    Column("breadth", "m", "b", ".2f", own("breadth")),
    Column("k0", "1/m2", "K0", ".3g", own("k0")),
    Column("dk", "1/m2", "dK", ".1e", own("dk")),
    Column("convex", "%", "convex", ".1f", share("convex")),
    Column("saddle", "%", "saddle", ".1f", share("saddle")),
    Column("cylinder", "%", "cyl.", ".1f", share("cylinder")),
    Column("flat", "%", "flat", ".1f", share("flat")),
    Column("unresolved", "%", "unres.", ".1f", share("unresolved")),
    Column("contested", "%", "contested", ".1f", lambda plate: 100.0 * plate.contested),
    Column("changed", "%", "changed", ".1f", lambda plate: 100.0 * plate.changed),
    Column("kind", "", "class", "s", own("kind")),
    Column("roll_axis", "deg", "axis", ".1f", own("roll_axis")),
    Column("coherence", "", "coh.", ".2f", own("coherence")),
    Column("least_radius", "m", "R least", ".2f", own("least_radius")),
    Column("mean_strain", "", "strain", ".1e", own("mean_strain")),
    Column("order", "", "", "", own("order")),
    Column("rollable", "", "", "", own("rollable")),
    Column("largest_radius", "m", "", "", own("largest_radius")),
    Column("total_curvature", "", "", "", own("total_curvature")),
    Column("largest_strain", "", "", "", own("largest_strain")),
    Column("area_error", "m2", "", "", own("area_error")),
    Column("suggestion", "", "", "", own("suggestion")),
)
"""The columns, in the order of files; those with a head are printed."""


@attrs.frozen(eq=False)
class HullPlates:
    """Plates of a hull, one row each, from aft forward and from below upward.

    Attributes
    ----------
    rows : tuple of HullPlate
        The plates.
    seams : HullSeams
        What cuts them.
    options : PlateOptions
        By what they were told apart.
    regions : RegionResult
        The regions of the whole surface, with lines at K0/2 and 2 K0, too.
    fits : int
        With how many other fits of the net curvature was compared.
    shell : Shell
        The surface as it was cut.
    slivers : float, m2
        What is too narrow for a plate, and in none of the rows.
    """

    rows: tuple[HullPlate, ...]
    seams: HullSeams
    options: PlateOptions
    regions: RegionResult = attrs.field(repr=False)
    fits: int
    shell: Shell = attrs.field(repr=False)
    slivers: float = 0.0

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[HullPlate]:
        return iter(self.rows)

    def __getitem__(self, which: int | str) -> HullPlate:
        """Give a plate by its number from 0, or by its name.

        Raises
        ------
        BadInputError, UnknownNameError, WrongTypeError
            No such number or name.
        """
        return plate_at(self.rows, which, "in HullPlates")

    @property
    def area(self) -> float:
        """The area of all plates, m2; of half the hull."""
        return float(sum(plate.area for plate in self.rows))

    @property
    def computed(self) -> int:
        """How many Bezier patches were computed; the others were taken from earlier plates."""
        return self.regions.computed

    @property
    def notes(self) -> tuple[str, ...]:
        """What is to be known of the plates, each a sentence."""
        found = [note for plate in self.rows for note in plate.notes]
        if self.slivers > _SEEN:
            found.append(
                f"Slivers of together {self.slivers:.2g} m2 between seams are no plates: they are "
                "narrower than a few centimetres."
            )
        if not self.fits:
            found.append(
                "Curvature was compared with no other fit of the net: dK is not known, and what "
                "is contested is told by the factor of 2 alone."
            )
        return tuple(found)

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
        """Write the table, and what is to be known."""
        advice = (f"{plate.name}, {plate.range}: {plate.suggestion}." for plate in self.rows)
        return "\n".join(
            [*printed_rows(COLUMNS, self.rows), "", *advice, CAVEAT, *self._facts(), *self.notes]
        )

    def _facts(self) -> Iterator[str]:
        """Say what counted as no curvature, and of what the areas are."""
        yield f"{self.regions.band}; doubled where dK is larger."
        yield (
            f"{len(self.rows)} plates of {self.area:.6g} m2 of half the hull, on "
            f"{self.regions.count} Bezier patches, of which {self.computed} were computed."
        )
