"""A comparison of two hulls as JSON. Its schema is `assoc_hull.io.tables.comparison`.

Examples
--------
>>> import json
>>> import assoc_hull as ah
>>> hull = ah.examples.wigley()
>>> json.loads(ah.compare(hull, hull).to_json())["lines"][0]["what"]
'same'
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import Any

import attrs

from assoc_hull.variation.comparing.compare import ComparedHull, HullComparison
from assoc_hull.variation.comparing.line_fairness import LineFairness
from assoc_hull.variation.comparing.line_shift import LineShift
from assoc_hull.variation.comparing.lines import LineComparison
from assoc_hull.variation.comparing.number_comparison import NumberComparison
from assoc_hull.variation.comparing.object_comparison import FeatureComparison, PointsComparison

__all__ = ["COMPARISON_FORMAT", "SCHEMA", "comparison_document", "comparison_json"]

COMPARISON_FORMAT = "assoc-hull comparison"
SCHEMA = 1
"""Version of the form."""


def comparison_json(found: HullComparison) -> str:
    """Give a comparison as JSON text; it ends with a newline."""
    return json.dumps(comparison_document(found), indent=1, allow_nan=False) + "\n"


def comparison_document(found: HullComparison) -> dict[str, Any]:
    """Give a comparison as JSON says it: every number to its last bit, derived ones as well."""
    return {
        "format": COMPARISON_FORMAT,
        "schema": SCHEMA,
        "parent": _hull(found.parent),
        "variant": _hull(found.variant),
        "lines": [_line(each) for each in found.lines],
        "hydrostatics": [_number(each) for each in found.hydrostatics],
        "parameters": [_number(each) for each in found.parameters],
        "points": _told(found.points),
        "features": [_told(each) for each in found.features],
    }


def _told(thing: PointsComparison | FeatureComparison) -> dict[str, Any]:
    """Give the attributes of a thing; mappings that nobody can change become dicts."""
    told = attrs.asdict(thing, recurse=False)
    return {
        name: dict(value) if isinstance(value, Mapping) else value for name, value in told.items()
    }


def _hull(hull: ComparedHull) -> dict[str, Any]:
    return {
        **attrs.asdict(hull.particulars), "fingerprint": hull.fingerprint,
        "at_draught": hull.draught, "doubts": list(hull.doubts),
    }  # fmt: skip


def _line(line: LineComparison) -> dict[str, Any]:
    ratio = line.comb_ratio
    return {
        "name": line.name,
        "was": line.was,
        "group": line.group,
        "what": line.what,
        "shift": None if line.shift is None else _shift(line.shift),
        "before": _fairness(line.before, line.points[0]),
        "after": _fairness(line.after, line.points[1]),
        "comb_ratio": None if ratio is None or math.isinf(ratio) else ratio,
    }


def _shift(shift: LineShift) -> dict[str, Any]:
    return {
        **attrs.asdict(shift), "vector": shift.vector, "length": shift.length,
        "direction": shift.direction,
    }  # fmt: skip


def _fairness(fairness: LineFairness | None, points: int) -> dict[str, Any] | None:
    if fairness is None:
        return None
    return {"points": points, "sign_changes": fairness.sign_changes, "comb": fairness.comb}


def _number(number: NumberComparison) -> dict[str, Any]:
    derived = {"difference": number.difference, "percent": number.percent}
    return {**attrs.asdict(number), **derived}
