"""One batch of patches solved: polynomials, cells, arcs for each level, areas.

Examples
--------
>>> from assoc_hull.surface.regions.solving import KNOWN_TO
>>> KNOWN_TO
1e-09
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.algebra import cross, u_derivative, v_derivative
from assoc_hull.geometry.patches.arcs import arcs_of
from assoc_hull.geometry.patches.area_ground import AreaGround
from assoc_hull.geometry.patches.areas import areas
from assoc_hull.geometry.patches.curvature_functions import IsoFunction, gauss_functions
from assoc_hull.geometry.patches.patches import Patches
from assoc_hull.geometry.patches.refining import refined
from assoc_hull.geometry.patches.signs import edge_lines
from assoc_hull.geometry.patches.solve import solve
from assoc_hull.surface.regions.arc_points import ArcPoints
from assoc_hull.surface.regions.band_areas import band_areas
from assoc_hull.surface.regions.region_options import RegionOptions
from assoc_hull.surface.regions.region_parts import AREAS, Solution
from assoc_hull.surface.regions.surface_batches import diagonals
from assoc_hull.surface.regions.zero_band import ZeroBand

__all__ = ["KNOWN_TO", "deltas", "levels_of", "solved"]

KNOWN_TO = 1e-9
"""Control points count as known to this part of the diagonal of their patch, without a band."""

_ROUNDING = 2.0**-52
"""No coordinate is known better than to its rounding: this part of the largest of its patch."""

_NIL = 1e-9
"""A side where |r_u x r_v| stays below this part of its largest has no direction across it."""


def levels_of(band: ZeroBand, options: RegionOptions) -> tuple[float, ...]:
    """Give the levels to be solved for: those of the band, then the further ones, each once."""
    return tuple(dict.fromkeys((*band.levels, *options.levels)))


def deltas(patches: Patches, band: ZeroBand) -> FloatArray:
    """Give what a coordinate of a control point may be off by, for each patch, (k,), m."""
    known = KNOWN_TO * diagonals(patches) if band.delta is None else band.delta
    rounding = _ROUNDING * np.abs(patches.net).max(axis=(1, 2, 3))
    return np.asarray(np.maximum(known, rounding))


def solved(
    patches: Patches, band: ZeroBand, options: RegionOptions
) -> tuple[tuple[Solution, ...], FloatArray]:
    """Solve for all levels, and give the areas (k, 8) of the regions that the band parts."""
    delta = deltas(patches, band)
    levels = levels_of(band, options)
    functions = gauss_functions(patches, levels)
    known = gauss_functions(patches, levels, delta)
    sound = ~_collapsed(patches)
    found = tuple(
        _solution(patches, level, function, nil.err, options, sound)
        for level, function, nil in zip(levels, functions, known, strict=True)
    )
    return found, _areas(patches, found[: len(band.levels)], options.area_tol)


def _solution(
    patches: Patches,
    level: float,
    function: IsoFunction,
    nil: FloatArray,
    options: RegionOptions,
    sound: NDArray[np.bool_],
) -> Solution:
    """Solve for one level; `sound` are the sides (k, 4) along which K has a meaning."""
    cells = solve(function, options.depth, options.budget, nil=nil)
    cells = refined(function, cells, options.depth, options.budget, nil)
    arcs = arcs_of(cells)
    points = ArcPoints.of(patches, cells, arcs, options.chord_tol)
    return Solution(level, cells, arcs, points, edge_lines(function.b, nil) & sound)


def _collapsed(patches: Patches) -> NDArray[np.bool_]:
    """Tell along which sides (k, 4) of patches the normal vanishes, as where one is a point."""
    r = patches.components
    normal = np.abs(cross(u_derivative(r), v_derivative(r))).max(axis=1)
    sides = normal[:, 0], normal[:, -1], normal[:, :, 0], normal[:, :, -1]
    largest = np.stack([side.max(axis=1) for side in sides], axis=1)
    return np.asarray(largest <= _NIL * normal.max(axis=(1, 2))[:, None])


def _areas(patches: Patches, solutions: Sequence[Solution], area_tol: float) -> FloatArray:
    """Give the areas of the regions, (k, 8), m2."""
    ground = AreaGround.of(patches, area_tol)
    tables = [areas(patches, each.cells, each.arcs, area_tol, ground) for each in solutions]
    found = [np.column_stack([getattr(table, name) for name in AREAS]) for table in tables]
    return found[0] if len(found) == 1 else band_areas(*found)
