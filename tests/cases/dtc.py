"""The Duisburg Test Case container ship, as the tests adopt it."""

from __future__ import annotations

from pathlib import Path

import assoc_hull as ah

__all__ = ["read_dtc"]


def read_dtc(data_folder: Path) -> ah.Hull:
    """Read the ship from its mesh of model scale: 41 stations, 20 waterlines, 12 buttocks."""
    return ah.read(
        data_folder / "dtc" / "DTC-scaled.stl.gz", scale=59.407, stations=41, waterlines=20,
        buttocks=12, draught=14.5, tolerance=0.01,
    )  # fmt: skip
