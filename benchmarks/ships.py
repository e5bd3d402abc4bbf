"""Ships that are varied in benchmarks."""

from __future__ import annotations

import os
from pathlib import Path

import assoc_hull as ah

__all__ = ["duisburg_test_case"]

_LENGTH = 355.0
"""Lpp as published, m; the mesh itself reaches from the transom to the bulb."""


def duisburg_test_case() -> ah.Hull | None:
    """Give the Duisburg Test Case; None unless ASSOC_HULL_DATA names the folder of hulls."""
    folder = os.environ.get("ASSOC_HULL_DATA")
    if not folder:
        return None
    return ah.read(
        Path(folder) / "dtc" / "DTC-scaled.stl.gz", scale=59.407, length=_LENGTH, draught=14.5,
        stations=41, waterlines=20, buttocks=12, tolerance=0.01,
    )  # fmt: skip
