"""What an import that was taken owes: a verdict, and a volume that its own points can hold."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from assoc_hull.analysis.hydrostatics.hull_hydrostatics import hydrostatics
from assoc_hull.errors import AssocHullError
from assoc_hull.hull import Hull
from assoc_hull.io.hull_json import read_hull_json

__all__ = ["verdict_in", "wrong_volume"]

_WORDS = ("not sound", "sound with suspicions", "sound")
_SLACK = 1.02
"""Curves pass their points a little at turns; no more than this part of the box."""


def verdict_in(told: str) -> str:
    """Give the word of the verdict that an import told, as text or as JSON; "" if there is none."""
    if told.startswith("{"):
        report = json.loads(told).get("report") or {}
        return str(report.get("verdict", {}).get("word", ""))
    last = told.rstrip().rpartition("\n")[2]
    found = last.removeprefix("verdict: ") if last.startswith("verdict: ") else ""
    return next((word for word in _WORDS if found.startswith(word)), "")


def wrong_volume(path: Path) -> str:
    """Tell how the volume at the design draught leaves the box of the hull's points; "" if not."""
    state = read_hull_json(path)
    xyz = np.asarray(state.rows.xyz[: state.rows.count])
    draught = state.particulars.draught
    try:
        volume = hydrostatics(Hull(state), on_error="report", estimate=False).volume
    except AssocHullError:
        return ""  # it is said that there is none
    under = draught - min(0.0, float(xyz[:, 2].min()))
    box = np.ptp(xyz[:, 0]) * 2.0 * np.abs(xyz[:, 1]).max() * under
    if 0.0 < volume <= _SLACK * box:
        return ""
    return f"taken with a volume of {volume:.6g} m3 in a box of {box:.6g} m3"
