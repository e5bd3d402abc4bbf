"""Form-parameter curves: vertices or parameters, with one change or some."""

from __future__ import annotations

import copy
import json
from random import Random
from typing import Any

from tests.form_curves import CURVES
from tests.fuzz.kind import Kind
from tests.fuzz.text import change_text
from tests.fuzz.values import change_value

__all__ = ["CURVE"]

PARAMETERS = {
    "start_x": -1.0, "start_y": 0.0, "start_angle_deg": 60.0, "start_curvature": -2.0,
    "start_tangent": 0.15, "start_stretch": 0.01, "finish_x": -0.3, "finish_y": 1.0,
    "finish_angle_deg": 0.0, "finish_curvature": 0.0, "finish_tangent": 0.15,
    "finish_stretch": 0.0, "area": 0.55, "centroid": -0.59,
}  # fmt: skip
GOOD: tuple[dict[str, Any], ...] = (
    {"parameters": PARAMETERS}, PARAMETERS, {"vertices": CURVES["T2_ent"]["P"]},
    {"vertices": CURVES["T1_run"]["P"], "parameters": PARAMETERS},
)  # fmt: skip


def make(rng: Random) -> bytes:
    """A curve with changed values; seldom with changed letters."""
    found = change_value(rng, copy.deepcopy(rng.choice(GOOD)), rng.choice((1, 1, 2, 3)))
    try:
        text = json.dumps(found)
    except RecursionError:
        text = "[" * 3000 + "]" * 3000
    return change_text(rng, text) if rng.random() < 0.1 else text.encode("utf-8", "surrogatepass")


def commands(data: bytes) -> list[list[str]]:
    """Make it; drag a vertex; make it fairest."""
    more = (["--json"], ["--drag", "1", "-0.9", "0.1", "--keep", "area"], ["--set", "area=0.5"])
    return [["curve", "curve.json"], ["curve", "curve.json", *more[len(data) % 3]]]


CURVE = Kind("curve", "curve.json", make, commands, weight=10)
