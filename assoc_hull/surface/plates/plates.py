"""Plates of a shell: regions, classes, roll axes and strains of surfaces, one row a plate.

Examples
--------
>>> import assoc_hull as ah
>>> import numpy as np
>>> x, y = np.mgrid[-3:3:3j, -1:1:3j]
>>> found = ah.plates(np.stack([x, y, 0.2 * np.abs(y)], axis=-1))
>>> found[0].kind, found[0].roll_axis, found[0].suggestion
('cylinder', 0.0, 'roll or press-brake about the roll axis, to the radii given')
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from assoc_hull.arguments import choice, instance
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.plates.options import SAGITTA_TOL, SHARE, PlateOptions, plate_options
from assoc_hull.surface.plates.plate_of import Draft, draft, plate_of
from assoc_hull.surface.plates.plate_table import Plates
from assoc_hull.surface.plates.seams import Seams, cut_at, seams_of
from assoc_hull.surface.regions.curvature_regions import curvature_regions
from assoc_hull.surface.regions.region_result import RegionResult
from assoc_hull.surface.regions.surface_batches import batches_of, given_surfaces, require_area
from assoc_hull.surface.regions.zero_band import BREADTH, MODES, STRAIN_TOL

__all__ = ["plates"]

_WHERE = "in plates"


def plates(
    surfaces: SplineSurface | Sequence[SplineSurface] | FloatArray,
    seams: Seams | Sequence[Seams | None] | None = None,
    zero: str = "strain",
    strain_tol: float = STRAIN_TOL,
    breadth: float | None = BREADTH,
    k0: float | None = None,
    delta: float | None = None,
    sagitta_tol: float = SAGITTA_TOL,
    sagitta_length: float | None = None,
    share: float = SHARE,
    suggestions: Mapping[str, str] | None = None,
    area_tol: float = 1e-6,
    depth: int = 16,
    budget: int = 6000,
    chord_tol: float = 0.001,
    previous: Plates | None = None,
) -> Plates:
    """Tell of each plate which part is convex, saddle, cylinder and flat, and how it may be formed.

    One surface is one plate, unless seams cut it. The areas of the regions are those of
    `curvature_regions`, with their error estimate; all else (cylinder or flat, roll axis, radii,
    strains) is found at 24 by 24 nodes on each Bezier patch.

    Parameters
    ----------
    surfaces : SplineSurface, sequence of SplineSurface, or (m + 1, n + 1, 3) float, m
        The surfaces; one control net is a Bezier patch.
    seams : Seams, or a sequence with Seams or None for each surface, optional
        Lines of constant parameter that cut the surfaces into plates.
    zero : {"strain", "absolute", "exact"}
        What counts as no Gaussian curvature; see `curvature_regions`.
    strain_tol : float
        The strain of the mode "strain", K0 = 8 strain_tol / breadth**2.
    breadth : float or None, m
        The breadth that K0, and the sagitta of what is flat, are meant for; None takes the own
        breadth of each plate, with a K0 of its own.
    k0 : float, 1/m2
        Half the width of the band of the mode "absolute".
    delta : float, m
        What each coordinate of a control point may be off by.
    sagitta_tol : float, m
        A developable part is flat where no principal curvature exceeds 8 sagitta_tol / breadth**2.
    sagitta_length : float, m
        The length that takes the place of the breadth in this, such as that of the plate.
    share : float
        A plate has the class of the region that has this part of its area, above 0.5 to 1.
    suggestions : mapping of str to str, optional
        Texts of advice by "flat", "cylinder", "cone", "saddle", "convex", "mixed".
    area_tol, depth, budget, chord_tol
        Tolerances and limits of the search; see `curvature_regions`.
    previous : Plates, optional
        Earlier plates; patches with the same nets under the same options are taken from them.

    Returns
    -------
    Plates
        A row for each plate, in the order of surfaces, u and v.

    Raises
    ------
    BadInputError, WrongTypeError
        No surfaces, seams off the surface, numbers that are none or that the mode does not use.

    Notes
    -----
    With `HullSeams` for its seams, `assoc_hull.plates` takes a hull or the surface of one, and cuts
    it by planes and girths: see `assoc_hull.surface.plates.hull_plates.hull_plates`.

    Source: the idea of the percentages and of the advice is that of "Curvature Region Analysis for
    Application of Plates Forming", J. SNAK; classes and measures are our own.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> import numpy as np
    >>> x, y = np.mgrid[-4:4:3j, -1:1:3j]
    >>> bowl = np.stack([x, y, 0.05 * (x * x + y * y)], axis=-1)
    >>> ah.plates(bowl)[0].kind
    'convex'
    """
    given = given_surfaces(surfaces, _WHERE)
    options = plate_options(breadth, sagitta_tol, sagitta_length, share, suggestions, _WHERE)
    if previous is not None:
        instance(previous, Plates, "previous", _WHERE)
    drafts = _drafts(given, seams_of(seams, given, _WHERE))
    search = dict[str, Any](
        zero=choice(zero, "zero", MODES, _WHERE), strain_tol=strain_tol, k0=k0, delta=delta,
        area_tol=area_tol, depth=depth, budget=budget, chord_tol=chord_tol,
    )  # fmt: skip
    results = _results(drafts, search, options, previous)
    rows = tuple(
        plate_of(each, *_own(results, number), options.breadth or each.breadth, options)
        for number, each in enumerate(drafts)
    )
    return Plates(rows, options, results)


def _drafts(surfaces: tuple[SplineSurface, ...], seams: tuple[Seams, ...]) -> list[Draft]:
    """Cut surfaces at their seams and measure the plates."""
    cut = [
        (plate, bool(own))
        for surface, own in zip(surfaces, seams, strict=True)
        for plate in cut_at(surface, own)
    ]
    surfaces = tuple(surface for surface, _ in cut)
    require_area(surfaces, batches_of(surfaces))
    return [
        draft(surface, surface.name or f"plate {number}", between)
        for number, (surface, between) in enumerate(cut, start=1)
    ]


def _results(
    drafts: list[Draft], search: dict[str, Any], options: PlateOptions, previous: Plates | None
) -> tuple[RegionResult, ...]:
    """Find the regions of all plates at once, or plate by plate where each has its own band."""
    old = () if previous is None else previous.results
    if search["zero"] != "strain" or options.breadth is not None:
        if search["zero"] == "strain":
            search = search | {"breadth": options.breadth}
        surfaces = [each.surface for each in drafts]
        return (curvature_regions(surfaces, previous=next(iter(old), None), **search),)
    return tuple(
        curvature_regions(
            each.surface, breadth=each.breadth, previous=old[i] if i < len(old) else None, **search
        )
        for i, each in enumerate(drafts)
    )


def _own(results: tuple[RegionResult, ...], number: int) -> tuple[RegionResult, int]:
    """Give the result that holds a plate, and its number there."""
    return (results[0], number) if len(results) == 1 else (results[number], 0)
