"""Measures that others need and that are not measured yet."""

from __future__ import annotations

from assoc_hull.analysis.form.parameter import Parameter
from assoc_hull.analysis.form.value import Absent

__all__ = ["PARAMETERS"]

_MEASURES = {
    "m": "b_st5 B_tr SO SCH TH TRZ L Ldiag BCL B07 PI SA SBx SBD BR Hap "
    "HSKEG LSKEG XSKEG RSKEG Rfwd Raft",
    "m2": "ATT S3.A1 S3.A2 S3'.A1 S3'.A2 ASKEG",
    "m3": "V_PR",
    "m4": "I_T I_L",
    "deg": "Eangle Tau Rangle TTLS StemA TwVSA TwLSA",
    "-": "S3 S3' L/Ldiag Bluntness",
    "st": "TwTTL",
    "% D": "PTC",
    "% B": "TwDS",
}


def _absent() -> Absent:
    return Absent("not measured yet")


PARAMETERS = tuple(
    Parameter(symbol, symbol, unit, "measures", "not measured yet", "-", "-", None, (), 4, _absent)
    for unit, symbols in _MEASURES.items()
    for symbol in symbols.split()
)
