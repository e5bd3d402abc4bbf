"""The rows of a study as columns."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import freeze
from assoc_hull.study.design import Design
from assoc_hull.study.run import Row

__all__ = ["columns_of"]


def columns_of(design: Design, rows: Sequence[Row]) -> dict[str, NDArray[Any]]:
    """Give arrays (n,) by name; see `assoc_hull.studies.Study.table`."""
    number = np.array([row.number for row in rows], np.int64)
    values = np.array([row.values for row in rows]).reshape(len(rows), len(design.names))
    outputs = np.array([row.outputs for row in rows]).reshape(len(rows), len(design.outputs))
    found: dict[str, NDArray[Any]] = {"number": number}
    found |= dict(zip(design.names, values.T, strict=True))
    found |= {f"asked {name}": design.targets[number, i] for i, name in enumerate(design.aims)}
    found |= dict(zip(design.outputs, outputs.T, strict=True))
    for name in ("margin", "shift", "residual", "trials"):
        found[name] = np.array([getattr(row, name) for row in rows])
    for name in ("failure", "reason"):
        found[name] = np.array([getattr(row, name) for row in rows], object)
    found = {name: np.array(column) for name, column in found.items()}
    freeze(*found.values())
    return found
