"""Tables of hulls with hard knuckles: built as they are, or told; none folds by itself."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.splines.evaluation import sample
from assoc_hull.io.offsets.complete_table import net_from_table
from assoc_hull.io.offsets.read import read_offsets

LENGTH, DRAUGHT = 60.0, 3.0
CHAMFER = np.array([[0.0, 0.0], [4.0, 0.0], [5.5, 1.2], [5.5, 5.0]])
"""Half-breadth and height (m) of corners amidships: a flat bottom and a bilge cut off."""


def fullness(x: float) -> float:
    """Part of the midship breadth at x (m): a parallel body from 22 to 34 m."""
    fore, aft = np.clip([(LENGTH - x) / 26.0, x / 22.0], 0.0, 1.0)
    return float(min(1.0 - (1.0 - fore) ** 2, 1.0 - (1.0 - aft) ** 2.5))


def table(corners: FloatArray, levels: Sequence[float]) -> str:
    """Write 21 stations of a hull of straight sides between corners (n, 2), m, to the mm."""
    first = int(np.flatnonzero(corners[:, 1] == 0.0)[-1])
    across = np.interp(levels, corners[first:, 1], corners[first:, 0])
    rows = ["x_m," + ",".join(f"wl_{z:g}" for z in levels)]
    for x in np.linspace(0.0, LENGTH, 21).tolist():
        rows.append(f"{x:g}," + ",".join(f"{fullness(x) * y:.3f}" for y in across))
    return "\n".join(["# x from AP, half-breadths and heights in m", *rows]) + "\n"


def test_a_level_flat_of_side_does_not_sink_between_its_corners() -> None:
    """Identical stations of a parallel body make identical sections, none of them folded."""
    text = table(CHAMFER, [0.0, 0.4, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0])
    state = net_from_table(read_offsets(text, length=LENGTH, draught=DRAUGHT)[0], straight=True)[0]
    sections = {
        str(state.lines.name.data[state.line_of(curve)]): sample(state.spline(curve), 16)[1][:, 1:]
        for curve in state.live("curves").tolist()
    }
    assert sections["ST 11"] == pytest.approx(sections["ST 10"], abs=1e-4)
    assert sections["ST 11"][:, 1].min() >= -1e-9
