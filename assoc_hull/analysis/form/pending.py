"""Measures that others need and that are not measured yet."""

from __future__ import annotations

from assoc_hull.analysis.form.parameter import Parameter
from assoc_hull.analysis.form.value import Absent

__all__ = ["PARAMETERS"]

_MEASURES = {
    "m3": "V_PR",
}


def _absent() -> Absent:
    return Absent("not measured yet")


PARAMETERS = tuple(
    Parameter(symbol, symbol, unit, "measures", "not measured yet", "-", "-", None, (), 4, _absent)
    for unit, symbols in _MEASURES.items()
    for symbol in symbols.split()
)
