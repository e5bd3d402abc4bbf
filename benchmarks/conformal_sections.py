"""Lewis sections: a batch against one at a time, and how time grows with the number."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.classical.conformal_sections import lewis_sections
from assoc_hull.geometry.curves import FloatArray
from benchmarks.clock import Figure, side_by_side

__all__ = ["figures"]

COUNT = 1000


def _drawn(count: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give half-breadths, draughts and area coefficients of sections that are simple."""
    rng = np.random.default_rng(1)
    return rng.uniform(4, 9, count), rng.uniform(5, 8, count), rng.uniform(0.7, 0.9, count)


def figures(quick: bool = False) -> list[Figure]:
    """Measure."""
    whole, half = _drawn(COUNT), _drawn(COUNT // 2)
    ones = [tuple(each[k : k + 1] for each in whole) for k in range(COUNT // 10)]
    t = np.linspace(0.0, 0.5 * np.pi, 25)
    found = side_by_side(
        {
            "batch": lambda: lewis_sections(*whole).at(t),
            "half": lambda: lewis_sections(*half).at(t),
            "each": lambda: [lewis_sections(*one).at(t) for one in ones],
        },
        3 if quick else 15,
    )
    return [
        Figure("a Lewis section with 25 points, in a batch of 1,000",
               1e6 * found["batch"] / COUNT, "us"),
        Figure("one at a time / in a batch", 10.0 * found["each"] / found["batch"], "x", 2.0),
        Figure("1,000 sections / 500 sections", found["batch"] / found["half"], "x", 2.6, "most"),
    ]  # fmt: skip
