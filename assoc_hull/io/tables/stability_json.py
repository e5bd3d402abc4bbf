"""Stability and cross curves as JSON says them; names and units are those of the records."""

from __future__ import annotations

import math
from typing import Any

import attrs

from assoc_hull.analysis.stability.criteria import Criterion
from assoc_hull.analysis.stability.cross_curves import CrossCurves
from assoc_hull.analysis.stability.equilibrium import Equilibrium
from assoc_hull.analysis.stability.result import Stability
from assoc_hull.geometry.curves import FloatArray

__all__ = ["FORMAT", "SCHEMA", "equilibrium_document", "stability_document"]

FORMAT = {"stability": "assoc-hull stability", "cross curves": "assoc-hull cross curves",
          "equilibrium": "assoc-hull equilibrium"}  # fmt: skip
SCHEMA = 1
"""Version of the forms."""


def stability_document(found: Stability | CrossCurves) -> dict[str, Any]:
    """Give stability or cross curves as JSON says it; numbers that there are not are null.

    Examples
    --------
    >>> from assoc_hull.analysis.stability.stability import stability
    >>> from assoc_hull.io.tables.stability_json import stability_document
    >>> from assoc_hull.sources import examples
    >>> found = stability_document(stability(examples.wigley(), kg=5.0, heels=[0, 20]))
    >>> [each["code"] for each in found["criteria"] if each["passed"] is False]
    ['2.2.1', '2.2.1']
    """
    if isinstance(found, CrossCurves):
        return {
            "format": FORMAT["cross curves"],
            "schema": SCHEMA,
            "header": attrs.asdict(found.header),
            "trim": found.trim,
            "conditions": [attrs.asdict(each) for each in found.conditions],
            "heel_deg": found.heel_deg.tolist(),
            "kn": [_numbers(row) for row in found.kn],
            "notes": list(found.notes),
        }
    return {
        "format": FORMAT["stability"],
        "schema": SCHEMA,
        "header": attrs.asdict(found.header),
        "condition": attrs.asdict(found.condition),
        "trim": found.trim,
        "side": found.side,
        "gm": found.gm,
        "gz_max": found.gz_max,
        "angles": {**attrs.asdict(found.angles), "range": found.angles.range},
        "columns": {name: _numbers(values) for name, values in found.columns.items()},
        "criteria": [_criterion(each) for each in found.criteria],
        "passed": found.passed,
        "floodings": [attrs.asdict(each) for each in found.floodings],
        "notes": list(found.notes),
    }


def equilibrium_document(found: Equilibrium) -> dict[str, Any]:
    """Give an equilibrium as JSON says it."""
    return {
        "format": FORMAT["equilibrium"],
        "schema": SCHEMA,
        "position": attrs.asdict(found.position),
        "kind": found.kind,
        "gm": found.gm,
        "gm_upright": found.gm_upright,
        "condition": attrs.asdict(found.condition),
        "notes": list(found.notes),
    }


def _criterion(criterion: Criterion) -> dict[str, Any]:
    return {**attrs.asdict(criterion), "margin": criterion.margin, "passed": criterion.passed}


def _numbers(values: FloatArray) -> list[float | None]:
    return [value if math.isfinite(value) else None for value in values.tolist()]
