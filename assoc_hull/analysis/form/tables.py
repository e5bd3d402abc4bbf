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


def by_table(entries: Iterable[Parameter]) -> dict[str, list[Parameter]]:
    """Sort entries into the parts of the catalogue, in the order of the paper's tables.

    What stands in none of them follows, in the order of the catalogue.

    Parts that an entry of a caller's own names come last, parts without entries do not come.

    Examples
    --------
    >>> from assoc_hull.analysis.form.catalogue import CATALOGUE
    >>> from assoc_hull.analysis.form.tables import by_table
    >>> [each.symbol for each in by_table(CATALOGUE.values())["particulars"]][:2]
    ['Lpp', 'B']
    """
    found: dict[str, list[Parameter]] = {table: [] for table in TABLES}
    for each in sorted(entries, key=lambda entry: _PLACE.get(entry.symbol, len(_PLACE))):
        found.setdefault(each.table, []).append(each)
    return {table: some for table, some in found.items() if some}
