"""What tests of aiming share: a small hull, layers that are free, and the problem they make."""

from __future__ import annotations

from typing import Any

import assoc_hull as ah
from assoc_hull.variation.aiming.hull_problem import HullProblem
from assoc_hull.variation.aiming.reach_targets import problem_of
from assoc_hull.variation.request import VariationRequest

FULLER = {
    "name": "fuller",
    "fields": [
        {
            "stack": {
                "name": "fuller", "axis": "y", "boundaries": [["keel", 0], ["T", 6.25]],
                "pieces": [{"a": {"x": [50, 80, 100], "v": [0, 0.1, 0]}}, {}],
            }
        }
    ],
}  # fmt: skip
"""The fore body of the small hull broader, at the keel most: its buttocks bend."""

SHIFTED = {
    "name": "shifted",
    "fields": [
        {
            "stack": {
                "name": "shifted", "axis": "x", "boundaries": [["keel", 0]],
                "pieces": [{"d": {"x": [0, 30, 60], "v": [0, 1, 0]}}],
            }
        }
    ],
}  # fmt: skip
"""The stations of its after body moved."""


def small() -> ah.Hull:
    """Give a Wigley hull of few lines."""
    return ah.examples.wigley(stations=9, waterlines=6)


def problem(hull: ah.Hull, reach: list[str], free: list[Any], **more: Any) -> HullProblem:
    """Give the problem of outputs by what is free."""
    ask = VariationRequest.of(
        more.pop("set", None), reach=dict.fromkeys(reach, 1.0), free=free, **more
    )
    return problem_of(hull.state, ask)
