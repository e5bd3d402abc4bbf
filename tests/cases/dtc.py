"""The Duisburg Test Case container ship, as the tests adopt it."""

from __future__ import annotations

from pathlib import Path

import assoc_hull as ah
from assoc_hull.io.slicing.net import SliceReport
from assoc_hull.io.slicing.read import read_slices

__all__ = ["read_dtc", "read_dtc_with_report"]


def read_dtc(data_folder: Path) -> ah.Hull:
    """Read the ship from its mesh of model scale: 41 stations, 20 waterlines, 12 buttocks."""
    return ah.read(
        data_folder / "dtc" / "DTC-scaled.stl.gz", scale=59.407, stations=41, waterlines=20,
        buttocks=12, draught=14.5, tolerance=0.01,
    )  # fmt: skip


def read_dtc_with_report(data_folder: Path) -> tuple[ah.Hull, SliceReport]:
    """Read the ship with what is told of its slices; lines and tolerance are the defaults."""
    state, report = read_slices(
        data_folder / "dtc" / "DTC-scaled.stl.gz", scale=59.407, draught=14.5
    )
    hull = ah.Hull(state)
    hull.adoption = report.adoption
    return hull, report
