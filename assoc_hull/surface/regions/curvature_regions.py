"""Regions of Gaussian curvature of surfaces: the face of what finds, keeps and joins them.

Examples
--------
>>> import assoc_hull as ah
>>> import numpy as np
>>> x, y = np.mgrid[0:4, 0:4] / 3.0
>>> net = np.stack([6 * x, 2 * y, np.zeros_like(x)], axis=-1)
>>> ah.curvature_regions(net).zero
12.0
"""

from __future__ import annotations

from collections.abc import Sequence

from assoc_hull.arguments import instance
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.regions.previous import part_of, usable
from assoc_hull.surface.regions.region_components import components_of
from assoc_hull.surface.regions.region_notes import region_notes
from assoc_hull.surface.regions.region_options import region_options
from assoc_hull.surface.regions.region_result import RegionResult
from assoc_hull.surface.regions.surface_batches import batches_of, given_surfaces, require_area
from assoc_hull.surface.regions.zero_band import BREADTH, STRAIN_TOL, zero_band

__all__ = ["curvature_regions"]


def curvature_regions(
    surfaces: SplineSurface | Sequence[SplineSurface] | FloatArray,
    zero: str = "strain",
    strain_tol: float = STRAIN_TOL,
    breadth: float = BREADTH,
    k0: float | None = None,
    delta: float | None = None,
    area_tol: float = 1e-6,
    depth: int = 16,
    budget: int = 6000,
    chord_tol: float = 0.001,
    levels: Sequence[float] = (),
    previous: RegionResult | None = None,
) -> RegionResult:
    """Find where surfaces are convex (K > 0), saddles (K < 0) or developable (K = 0), and how much.

    No grid of samples is used: polynomials that have the sign of the Gaussian curvature K are
    divided until each part of a patch is proven to have one sign, to hold one piece of line, or is
    given up as unresolved and listed as such. Areas are those of the surface itself.

    Parameters
    ----------
    surfaces : SplineSurface, sequence of SplineSurface, or (m + 1, n + 1, 3) float, m
        The surfaces; one control net is a Bezier patch.
    zero : {"strain", "absolute", "exact"}
        What counts as no curvature. "strain": |K| <= K0 = 8 strain_tol / breadth**2, so that a
        strip of this breadth has to be strained by no more to be flat. "absolute": |K| <= k0.
        "exact": nothing but K = 0, to what the control points are known to; on developable plates
        the sign of K then means nothing.
    strain_tol : float
        The strain of the mode "strain".
    breadth : float, m
        The breadth of the mode "strain".
    k0 : float, 1/m2
        Half the width of the band of the mode "absolute", which alone uses it.
    delta : float, m
        What each coordinate of a control point may be off by; its rounding at least. In the mode
        "exact" 1e-9 of the diagonal of each Bezier patch's own box by default, with a band 0.
    area_tol : float
        Tolerance of areas, relative to that of each patch (quadrature), 1e-13 to 0.1.
    depth : int
        How often a patch is halved at most, 1 to 30: what is unresolved is 2**-depth of its
        parameters wide.
    budget : int
        So many cells of a patch are looked at, at most.
    chord_tol : float, m
        How far the chords of polylines may stray; areas do not depend on it.
    levels : sequence of float, 1/m2
        Curvatures for which lines are given beside those that part the regions.
    previous : RegionResult, optional
        An earlier result. Patches whose control net is the same to the bit, under the same options,
        are taken from it.

    Returns
    -------
    RegionResult
        Areas with their error estimate, lines, what was computed, notes.

    Raises
    ------
    BadInputError, WrongTypeError
        No surfaces, numbers that are none, numbers that the mode does not use; a patch without
        area.
    DanglingArcError
        A line that ends where none can: a fault of this program.

    Notes
    -----
    Source: the idea of curvature regions of plates is that of "Curvature Region Analysis for
    Application of Plates Forming", J. SNAK; equations and bounds are our own. Areas in cut cells
    follow R. I. Saye, SIAM J. Sci. Comput. 37(2), 2015, and J. Comput. Phys. 448, 2022.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> import numpy as np
    >>> x, y = np.mgrid[0:4, 0:4] / 3.0
    >>> net = np.stack([6 * x, 2 * y, 0.02 * (6 * x) * (2 * y)], axis=-1)
    >>> found = ah.curvature_regions(net, zero="absolute", k0=1e-4)
    >>> round(found.areas.negative_share, 6), len(found.components), found.computed
    (1.0, 0, 1)
    >>> ah.curvature_regions(net, zero="absolute", k0=1e-4, previous=found).computed
    0
    """
    where = "in curvature_regions"
    given = given_surfaces(surfaces, where)
    band = zero_band(zero, strain_tol, breadth, k0, delta, where)
    options = region_options(area_tol, depth, budget, chord_tol, levels, where)
    if previous is not None:
        instance(previous, RegionResult, "previous", where)
    batches = batches_of(given)
    require_area(given, batches)
    old = usable(previous, band, options)
    found = [part_of(batch, band, options, old.get(batch.kind)) for batch in batches]
    parts = tuple(part for part, _ in found)
    components = components_of(parts, options)
    notes = region_notes(given, parts, components, options)
    computed = sum(count for _, count in found)
    return RegionResult(given, band, options, parts, components, computed, notes)
