"""How a foreign file is to be taken: every option of `ah.read` and of the command, in one value.

Examples
--------
>>> from assoc_hull.io.importing.options import ImportOptions
>>> ImportOptions(length=100.0, unit="mm").named("length", "draught", "unit")
{'length': 100.0, 'unit': 'mm'}
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, ClassVar

import attrs

from assoc_hull.errors import BadInputError
from assoc_hull.io.slicing.cut_planes import Places
from assoc_hull.io.slicing.read import require_file

__all__ = ["ImportOptions"]


@attrs.frozen(kw_only=True)
class ImportOptions:
    """What the caller says of a file; None or "auto" where it is to be found.

    Attributes
    ----------
    length, breadth, draught : float or None, m
        Particulars: between perpendiculars, moulded, design.
    deck : {"open", "closed"} or None
        Whether a deck lies between the deck edges; open by default.
    unit : str or None
        Of the numbers in the file.
    station_zero : {"ap", "fp"} or None
        Perpendicular of station 0, of a table.
    scale, axes, stations, waterlines, buttocks, tolerance, join
        As for `assoc_hull.io.slicing.read.read_slices`.
    accept : bool
        Take a hull that is not sound; the verdict is kept in its notes.
    strict : bool
        Refuse a hull under suspicion too.
    """

    SIZES: ClassVar[tuple[str, ...]] = ("length", "breadth", "draught")
    CUTS: ClassVar[tuple[str, ...]] = (
        "stations", "waterlines", "buttocks", "scale", "axes", "tolerance", "join",
    )  # fmt: skip

    length: float | None = None
    breadth: float | None = None
    draught: float | None = None
    deck: str | None = None
    unit: str | None = None
    station_zero: str | None = None
    scale: float | None = None
    axes: str | None = None
    stations: Places | None = None
    waterlines: Places | None = None
    buttocks: Places | None = None
    tolerance: float | None = None
    join: float | None = None
    accept: bool = False
    strict: bool = False

    def named(self, *names: str) -> dict[str, Any]:
        """Give those of some options that were given, by name."""
        every = {name: getattr(self, name) for name in names}
        return {name: value for name, value in every.items() if value is not None}

    def given(self) -> tuple[str, ...]:
        """Name the options that are not as by default."""
        fields = attrs.fields(ImportOptions)
        return tuple(each.name for each in fields if getattr(self, each.name) != each.default)

    def refuse(self, why: str, path: Path, names: tuple[str, ...] | None = None) -> None:
        """Refuse options that a form does not take; None: any at all.

        Raises
        ------
        BadInputError
            One of `names` was given.
        """
        wrong = [name for name in self.given() if names is None or name in names]
        if wrong:
            require_file(path)
            raise BadInputError(
                f"{', '.join(wrong)} cannot be given", f"for {path.name}", f"leave it out: {why}"
            )
