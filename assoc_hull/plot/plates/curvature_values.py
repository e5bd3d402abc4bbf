"""Continuous maps of curvature: values at the middles of tiles, colours on both sides of nil."""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.curvatures import curvatures
from assoc_hull.plot.plates.colour_bar import CURVATURE, colour_bar, shades
from assoc_hull.plot.plates.curvature_words import BLOCK
from assoc_hull.plot.plates.plate_entries import Entry
from assoc_hull.plot.plates.plate_grid import Field
from assoc_hull.plot.plates.plate_panels import Look
from assoc_hull.plot.plates.plate_scene import Scene, ground, steps_of
from assoc_hull.plot.sheet.paper import MARGIN
from assoc_hull.plot.sheet.sheet import Sheet
from assoc_hull.surface.plates.curvature_nodes import map_value
from assoc_hull.surface.regions.zero_band import zero_band

__all__ = ["valued"]

_STEPS, _STEPS_OF_MANY = 96, 40
"""Tiles along a side of a plate, if it is the only one, and if it is one of several."""


@attrs.frozen(eq=False)
class _Values:
    """A plate as a grid of tiles with their Gaussian curvature, 1/m2."""

    scene: Scene
    gauss: FloatArray


def valued(sheet: Sheet, entries: Sequence[Entry], top: float) -> Look:
    """Draw the bar of a continuous map below a height, and give how plates are drawn for it.

    Shown is asinh(K / K0), so that the band stays visible beside large curvatures; both signs
    reach equally far.
    """
    k0 = max(entry.result.k0 for entry in entries) or zero_band().k0
    steps = _STEPS if len(entries) == 1 else _STEPS_OF_MANY
    found = {id(entry): _values(entry, steps) for entry in entries}
    largest = max(float(np.nanmax(np.abs(each.gauss))) for each in found.values())
    most = max(largest, 2.0 * k0)
    reach = float(map_value(np.array(most), k0))
    factor = sheet.paper.factor
    right = sheet.paper.width - (MARGIN + 6.0) * factor
    high = top - 10.0 * factor
    bar = Field(right - (BLOCK - 12.0) * factor, high - 4.0 * factor, right, high)
    colour_bar(sheet, bar, CURVATURE, _marks(k0, most, reach), "K, 1/m²; scale asinh(K/K0)")

    def look(entry: Entry) -> tuple[Scene, FloatArray]:
        values = found[id(entry)]
        level = np.nan_to_num(map_value(values.gauss, k0) / reach)
        return values.scene, shades(level, CURVATURE)

    return look


def _marks(k0: float, most: float, reach: float) -> list[tuple[float, str]]:
    """Give the ends, nil, and K0 where there is room."""
    marks = [(0.0, "0")]
    place = float(map_value(np.array(k0), k0)) / reach
    for side, sign in ((-1.0, "−"), (1.0, "")):
        marks.append((side, f"{sign}{most:.2g}"))
        if 0.15 < place < 0.75:
            marks.append((side * place, f"{sign}K0"))
    return marks


def _values(entry: Entry, steps: int) -> _Values:
    """Give the curvature in the middles of tiles; nan where there is no tangent plane."""
    uv, gauss = [], []
    for part in entry.result.parts:
        patches = part.patches[np.flatnonzero(part.patches.surface == entry.number)]
        if len(patches):
            row, corner = ground(len(patches), steps_of(patches, steps))
            gauss.append(curvatures(patches, row, corner.mean(axis=1)).gauss)
            flat = corner.reshape(-1, 2)
            uv.append(patches.parameters(np.repeat(row, 4), flat).reshape(-1, 4, 2))
    corners = np.concatenate(uv)
    count = len(corners)
    scene = attrs.evolve(
        entry.scene, uv=corners, tint=np.zeros(count, np.intp), under=np.zeros(count, np.bool_)
    )
    return _Values(scene, np.concatenate(gauss))
