"""The catalogue of form parameters: all entries in their order, and the tables they stand in.

Entries stand in modules by subject (`assoc_hull.analysis.form.entries`). An entry of one's own is
handed to `form_parameters` and needs no change anywhere.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import get_args

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
from assoc_hull.analysis.form.entries.skeg import SKEG
from assoc_hull.analysis.form.entries.stern import STERN
from assoc_hull.analysis.form.entries.waterline import WATERLINE
from assoc_hull.analysis.form.parameter import FormParameter, Table, check_catalogue
from assoc_hull.model.named_mapping import NamedMapping

__all__ = [
    "CATALOGUE",
    "GIVEN",
    "TABLES",
    "TITLES",
    "by_table",
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
    >>> from assoc_hull.analysis.form.catalogue import CATALOGUE
    >>> from assoc_hull.analysis.form.catalogue import by_table
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
