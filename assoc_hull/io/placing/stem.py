"""Where the stem meets a waterline: behind a bulb that pierces it, and above one that it cuts."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.placing.outline import HullOutline, Level

__all__ = ["StemPlace", "find_stem"]

_BOW = 0.15
"""A bulb and the stem behind it lie in this part of the length from forward."""

_DROP = 3e-3
"""The contour steps back by more than this part of the length above a bulb."""

_SOON = 0.4
"""Above a bulb it steps back within this part of the height above the waterline."""

_SAMPLES = 60
_EXACT = 1e-3
"""A vertex of the waterline this part of the length near the contour's crossing is its end."""


@attrs.frozen
class StemPlace:
    """Where the stem meets the waterline.

    Attributes
    ----------
    x : float, m
        In coordinates of the file.
    note, doubt : str or None
        What is to be told of it, or doubted.
    """

    x: float
    note: str | None = None
    doubt: str | None = None


def find_stem(outline: HullOutline, z: float, level: Level) -> StemPlace:
    """Find where the stem meets the waterline at a height, m."""
    size, z = level.fore - level.aft, outline.inside(z)
    crossing = outline.contour(z)
    bow = crossing[crossing > level.fore - _BOW * size]
    if not len(bow):
        return StemPlace(level.fore)  # no contour forward: an open end, or half of two hulls
    if len(bow) == 3:
        x = _exact(outline, z, float(bow[0]), size)
        what = f"the waterline passes a bulb at x = {bow[2]:.6g} m; the stem is behind it"
        return StemPlace(x, f"{what}, at {x:.6g} m of the file")
    x = float(bow[-1])
    stepped = _step_above(outline, z, x, size)
    if stepped is not None:
        back, height = stepped
        what = (
            f"the design waterline ends on a bulb at x = {x:.6g} m of the file; the FP goes by the "
            f"stem above it, at x = {back:.6g} m, z = {height:.6g} m: check draught="
        )
        return StemPlace(back, doubt=what)
    return StemPlace(_exact(outline, z, x, size))


def _exact(outline: HullOutline, z: float, x: float, size: float) -> float:
    """Take the end of the waterline itself: the contour was cut a little beside y = 0."""
    places = outline.cut(2, z)
    near = places[np.abs(places[:, 0] - x) <= _EXACT * size]
    if not len(near):
        return x
    least = np.abs(near[:, 1]).min()
    on = near[np.abs(near[:, 1]) <= least + 1e-9 * size]
    return float(on[int(np.abs(on[:, 0] - x).argmin()), 0])


def _step_above(
    outline: HullOutline, z: float, x: float, size: float
) -> tuple[float, float] | None:
    """Give place and height of the stem's foot where the waterline ends on a bulb below it."""
    top = float(outline.high[2])
    heights = np.linspace(z, top, _SAMPLES + 1)[1:-1]
    # Only the bow: where sections end in the centre plane the contour has their keels too.
    bow = x - _BOW * size
    fore = np.array([_foremost(outline.contour(height), bow) for height in heights.tolist()])
    known = np.isfinite(fore)
    heights, fore = heights[known], fore[known]
    if not len(fore):
        return None
    # The foot of the stem is the first place from which the contour goes back no further.
    row = int(fore.argmin())
    drop = x - float(fore[row])
    if drop <= _DROP * size:
        return None
    soon = fore[heights <= z + _SOON * (top - z)]
    early = len(soon) > 0 and x - float(soon.min()) > 0.8 * drop
    rises = float(fore[row:].max()) - float(fore[row]) > _DROP * size
    return (float(fore[row]), float(heights[row])) if early or rises else None


def _foremost(crossing: FloatArray, least: float) -> float:
    """Give the foremost crossing forward of `least` (m), nan where there is none."""
    return float(crossing[-1]) if len(crossing) and crossing[-1] > least else float("nan")
