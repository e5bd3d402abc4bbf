"""The parts of the catalogue of form parameters: their order and their headings."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import get_args

from assoc_hull.analysis.form.parameter import Parameter, Table

__all__ = ["GIVEN", "TABLES", "TITLES", "by_table"]

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


def by_table(entries: Iterable[Parameter]) -> dict[str, list[Parameter]]:
    """Sort entries into the parts of the catalogue, whose order they keep.

    Parts that an entry of a caller's own names come last, parts without entries do not come.

    Examples
    --------
    >>> from assoc_hull.analysis.form.catalogue import CATALOGUE
    >>> from assoc_hull.analysis.form.tables import by_table
    >>> [each.symbol for each in by_table(CATALOGUE.values())["particulars"]][:2]
    ['Lpp', 'B']
    """
    found: dict[str, list[Parameter]] = {table: [] for table in TABLES}
    for each in entries:
        found.setdefault(each.table, []).append(each)
    return {table: some for table, some in found.items() if some}
