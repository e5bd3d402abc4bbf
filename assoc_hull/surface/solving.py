"""One batch of patches solved: polynomials, cells, arcs for each level, areas.

Examples
--------
>>> from assoc_hull.surface.solving import KNOWN_TO
>>> KNOWN_TO
1e-09
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.arcs import arcs_of
from assoc_hull.geometry.patches.areas import areas as areas_of
from assoc_hull.geometry.patches.curvature_functions import gauss_functions
from assoc_hull.geometry.patches.patches import Patches
from assoc_hull.geometry.patches.solve import solve
from assoc_hull.surface.band_areas import band_areas
from assoc_hull.surface.given_surfaces import diagonals
from assoc_hull.surface.region_options import RegionOptions
from assoc_hull.surface.region_parts import AREAS, Solution
from assoc_hull.surface.zero_band import ZeroBand

__all__ = ["KNOWN_TO", "deltas", "levels_of", "solved"]

KNOWN_TO = 1e-9
"""Control points count as known to this part of the diagonal of their patch, without a band."""


def levels_of(band: ZeroBand, options: RegionOptions) -> tuple[float, ...]:
    """Give the levels to be solved for: those of the band, then the further ones, each once."""
    return tuple(dict.fromkeys((*band.levels, *options.levels)))


def deltas(patches: Patches, band: ZeroBand) -> FloatArray:
    """Give what a coordinate of a control point may be off by, for each patch, (k,), m."""
    if band.delta is None:
        return KNOWN_TO * diagonals(patches)
    return np.full(len(patches), band.delta)


def solved(
    patches: Patches, band: ZeroBand, options: RegionOptions
) -> tuple[tuple[Solution, ...], FloatArray]:
    """Solve for all levels, and give the areas (k, 8) of the regions that the band parts."""
    levels = levels_of(band, options)
    delta = deltas(patches, band)
    solutions = []
    for level, function in zip(levels, gauss_functions(patches, levels, delta), strict=True):
        cells = solve(function, options.depth, options.budget)
        solutions.append(Solution(level, function, cells, arcs_of(cells)))
    return tuple(solutions), _areas(patches, solutions[: len(band.levels)], options)


def _areas(patches: Patches, solutions: list[Solution], options: RegionOptions) -> FloatArray:
    """Give the areas of the regions, (k, 8), m2."""
    found = [
        np.column_stack([getattr(areas, name) for name in AREAS])
        for areas in (areas_of(patches, each.cells, options.area_tol) for each in solutions)
    ]
    return found[0] if len(found) == 1 else band_areas(*found)
