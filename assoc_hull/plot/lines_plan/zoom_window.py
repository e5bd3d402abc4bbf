"""A stretch of a hull along x, drawn larger: its lines cut off at two stations."""

from __future__ import annotations

from collections.abc import Iterator

import attrs
import numpy as np

from assoc_hull.arguments import pair
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.plot.lines_plan.drawing import Drawing, PlotCrossings, PlotLine

__all__ = ["clipped", "zoomed"]


def zoomed(plan: Drawing, x: tuple[float, float] | None) -> Drawing:
    """Give a drawing of what lies between two x, m; all of it where x is None.

    Raises
    ------
    BadInputError
        The two are no span, or no line lies there.
    """
    if x is None:
        return plan
    low, high = pair(x, "x", "in a picture", positive=False)
    lines = tuple(line for line in (_cut(each, low, high) for each in plan.lines) if line.polylines)
    if not any(line.boundary is None for line in lines):
        aft, fore = plan.bounds[:, 0]
        raise BadInputError(
            f"no line lies between x = {low:g} and {high:g} m", "in a picture",
            f"name a stretch of the hull, which lies between {aft:.2f} and {fore:.2f} m",
        )  # fmt: skip
    every = plan.crossings
    inside = np.flatnonzero((every.xyz[:, 0] >= low) & (every.xyz[:, 0] <= high))
    some = PlotCrossings(
        tuple(every.key[i] for i in inside.tolist()),
        tuple(every.line[i] for i in inside.tolist()),
        every.xyz[inside],
        every.normal[inside],
    )
    return attrs.evolve(plan, lines=lines, crossings=some, window=(low, high))


def _cut(line: PlotLine, low: float, high: float) -> PlotLine:
    """Give what of a line lies between two x; its splines stay whole, one for each piece."""
    found = [
        (spline, piece)
        for spline, points in zip(line.splines, line.polylines, strict=True)
        for piece, _ in clipped(points, low, high)
    ]
    splines, pieces = tuple(each[0] for each in found), tuple(each[1] for each in found)
    return attrs.evolve(line, splines=splines, polylines=pieces)


def clipped(points: FloatArray, low: float, high: float) -> Iterator[tuple[FloatArray, IntArray]]:
    """Give the pieces of a polyline (n, 3) between two x, and for each chord the one it lies on."""
    x = points[:, 0]
    rise = np.diff(x)
    cuts = [np.arange(len(points), dtype=np.float64)]
    for edge in (each for each in (low, high) if np.isfinite(each)):
        part = (edge - x[:-1]) / np.where(rise == 0.0, np.inf, rise)
        inner = np.flatnonzero((part > 0.0) & (part < 1.0))
        cuts.append(inner + part[inner])
    place = np.unique(np.concatenate(cuts))
    every = np.column_stack(
        [np.interp(place, np.arange(len(points)), points[:, axis]) for axis in range(3)]
    )
    middle = 0.5 * (every[1:, 0] + every[:-1, 0])
    inside = np.concatenate([[False], (middle >= low) & (middle <= high), [False]])
    begins, ends = (
        np.flatnonzero(~inside[:-1] & inside[1:]),
        np.flatnonzero(inside[:-1] & ~inside[1:]),
    )
    for begin, end in zip(begins.tolist(), ends.tolist(), strict=True):
        chord = np.floor(0.5 * (place[begin:end] + place[begin + 1 : end + 1])).astype(np.int64)
        yield every[begin : end + 1], chord
