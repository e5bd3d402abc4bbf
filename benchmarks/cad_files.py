"""A half hull for CAD programs: bytes and time, with and without OpenCASCADE, and how both grow."""

from __future__ import annotations

from functools import partial

import numpy as np

from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.cad.check_file import measure_file
from assoc_hull.io.cad.faces import sew_surfaces
from assoc_hull.io.cad.kernel import quiet_kernel
from assoc_hull.io.cad.write import cad_bytes, step_bytes
from assoc_hull.io.iges.surfaces import surfaces_of_iges
from assoc_hull.io.iges.write import iges_text
from benchmarks.clock import Figure, side_by_side

__all__ = ["figures"]

LENGTH, HALF_BREADTH, DRAUGHT = 300.0, 20.0, 16.0


def _knots(end: float, spans: int) -> np.typing.NDArray[np.float64]:
    return np.concatenate([np.zeros(3), np.linspace(0.0, end, spans + 1), np.full(3, end)])


def blocks(spans: int) -> list[SplineSurface]:
    """Give a half of Wigley's kind in three blocks, two of them side by side before the third."""
    u, v = np.linspace(0.0, 1.0, spans + 3), np.linspace(0.0, 1.0, spans // 2 + 3)
    net = np.zeros((len(u), len(v), 3))
    net[..., 0] = LENGTH * (1.0 - u[:, None])
    net[..., 1] = 4.0 * HALF_BREADTH * np.outer(u * (1.0 - u), v * (2.0 - v))
    net[..., 2] = DRAUGHT * v
    whole = SplineSurface("side", (3, 3), _knots(LENGTH, spans), _knots(25.0, spans // 2), net)
    return [
        whole.restricted((0.0, 180.0), (0.0, 10.0), "bow, below"),
        whole.restricted((0.0, 180.0), (10.0, 25.0), "bow, above"),
        whole.restricted((180.0, LENGTH), (0.0, 25.0), "stern"),
    ]


def figures(quick: bool = False) -> list[Figure]:
    """Measure."""
    small, large = blocks(20), blocks(80)
    names = [each.name for each in large]
    points, fewer = (sum(each.net[..., 0].size for each in some) for some in (large, small))
    with quiet_kernel():
        joined = sew_surfaces(large)
    step = step_bytes(joined, names, "mm", "hull")
    iges, bare = cad_bytes(large, "iges", half=True)[0], iges_text(large, "mm")
    times = side_by_side(
        {
            "sew": partial(sew_surfaces, large),
            "write": partial(step_bytes, joined, names, "mm", "hull"),
            "back": partial(measure_file, step, "step"),
            "all": partial(cad_bytes, large, "step", half=True),
            "fewer": partial(cad_bytes, small, "step", half=True),
            "own": partial(iges_text, large, "mm"),
            "own back": partial(surfaces_of_iges, bare, "bare.igs"),
            "iges back": partial(measure_file, iges, "iges"),
        },
        3 if quick else 9,
    )
    growth = times["all"] / times["fewer"] * fewer / points
    return [
        Figure("cad: STEP, bytes a control point", len(step) / points, "bytes"),
        Figure("cad: IGES 128, bytes a control point", len(bare) / points, "bytes"),
        Figure(f"cad: {points:,} control points: faces made and sewn", 1e3 * times["sew"], "ms"),
        Figure("cad: written as STEP", 1e3 * times["write"], "ms"),
        Figure("cad: read back and measured", 1e3 * times["back"], "ms"),
        Figure("cad: all of it", 1e3 * times["all"], "ms"),
        Figure(f"cad: a point of {points:,} / of {fewer:,}", growth, goal=1.5, sense="most"),
        Figure("cad: IGES 128 by our own writer", 1e3 * times["own"], "ms"),
        Figure("cad: the same read by our own reader", 1e3 * times["own back"], "ms"),
        Figure(
            "cad: OpenCASCADE reads IGES and measures / ours",
            times["iges back"] / times["own back"],
        ),
    ]
