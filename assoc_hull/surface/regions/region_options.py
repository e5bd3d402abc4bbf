"""How finely regions are searched for: tolerances, each for one thing, none for another.

Examples
--------
>>> from assoc_hull.surface.regions.region_options import region_options
>>> region_options(area_tol=1e-8).area_tol
1e-08
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.arguments import integer, numbers, positive
from assoc_hull.errors import BadInputError

__all__ = ["RegionOptions", "region_options"]

_FINEST, _COARSEST = 1e-13, 0.1
"""Of area_tol: finer is the rounding of a sum of areas, coarser is no area."""

_FINEST_CHORD = 1e-9
"""m: finer is the rounding of coordinates."""


@attrs.frozen
class RegionOptions:
    """Tolerances and limits of a search.

    Attributes
    ----------
    area_tol : float
        Of areas, relative to that of the patch (quadrature).
    depth : int
        How often a patch is halved at most: what is unresolved is 2**-depth of a patch wide.
    budget : int
        So many cells of a patch are looked at, at most.
    chord_tol : float, m
        How far chords of the polylines may stray from the lines; areas do not depend on it.
    levels : tuple of float, 1/m2
        Curvatures for which lines are given beside those of the band.
    """

    area_tol: float
    depth: int
    budget: int
    chord_tol: float
    levels: tuple[float, ...]


def region_options(
    area_tol: object = 1e-6,
    depth: object = 16,
    budget: object = 6000,
    chord_tol: object = 0.001,
    levels: object = (),
    where: str = "in curvature_regions",
) -> RegionOptions:
    """Check what is given; see `RegionOptions`.

    Raises
    ------
    BadInputError
        Numbers that are none, or out of range; a level that is given twice.
    """
    tolerance = positive(area_tol, "area_tol", where)
    if not _FINEST <= tolerance <= _COARSEST:
        remedy = f"give {_FINEST:g} to {_COARSEST:g}, relative to the area of a patch"
        raise BadInputError(f"area_tol is {tolerance:g}", where, remedy)
    chord = positive(chord_tol, "chord_tol", where)
    if chord < _FINEST_CHORD:
        raise BadInputError(f"chord_tol is {chord:g} m", where, f"give {_FINEST_CHORD:g} m or more")
    return RegionOptions(
        tolerance,
        integer(depth, "depth", where, least=1, most=30),
        integer(budget, "budget", where, least=1, most=10**6),
        chord,
        _levels(levels, where),
    )


def _levels(levels: object, where: str) -> tuple[float, ...]:
    """Take curvatures, each once, in the order they are given in."""
    found = np.atleast_1d(numbers(levels, "levels", where)) + 0.0
    for level, count in zip(*np.unique(found, return_counts=True), strict=True):
        if count > 1:
            what = f"levels holds {level:g} 1/m2 {count} times"
            raise BadInputError(what, where, "give each curvature once")
    return tuple(found.tolist())
