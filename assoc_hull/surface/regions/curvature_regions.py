"""Where surfaces are convex, saddles or developable: the search, batch by batch.

`curvature_regions` is what is called. Each batch of patches of one bidegree is solved for all
levels; patches with a net that an earlier result holds are taken from it.
Areas inside a band follow from the areas above and below its two limits.
Notes say where a search ended early and what lies on knots and borders.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from assoc_hull.arguments import instance
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.area_integrals import AreaIntegrator
from assoc_hull.geometry.patches.areas_by_sign import sign_areas
from assoc_hull.geometry.patches.bernstein_polynomials import (
    cross_polynomials,
    u_derivative,
    v_derivative,
)
from assoc_hull.geometry.patches.bezier_patches import Patches, curvatures
from assoc_hull.geometry.patches.cell_subdivision import (
    subdivide_again,
    subdivide_patches,
    zero_edges,
)
from assoc_hull.geometry.patches.cells import CellKind, select_patches
from assoc_hull.geometry.patches.curvature_functions import IsoFunction, gauss_functions
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.patches.zero_set_arcs import arcs_of
from assoc_hull.surface.regions.level_lines import (
    AREAS,
    ArcPoints,
    LevelLine,
    LevelSolution,
    RegionAreas,
    RegionPart,
    level_lines_of,
)
from assoc_hull.surface.regions.options import (
    BREADTH,
    STRAIN_TOL,
    RegionOptions,
    ZeroBand,
    region_options,
    zero_band,
)
from assoc_hull.surface.regions.result import RegionResult
from assoc_hull.surface.regions.surface_batches import (
    Kind,
    PatchBatch,
    batches_of,
    diagonals,
    given_surfaces,
    kind_of,
    name_of,
    require_area,
)

__all__ = [
    "KNOWN_TO",
    "band_areas",
    "coordinate_errors",
    "curvature_regions",
    "keys_of",
    "levels_of",
    "list_in_words",
    "region_notes",
    "solve_part",
    "solve_patches",
    "usable_parts",
]


def band_areas(upper: FloatArray, lower: FloatArray) -> FloatArray:
    """Give the areas (k, 8) of regions from those of searches for K0 and for -K0, m2.

    Of a search for K = K0 come P (K > K0), N (K < K0), Z (K = K0 to rounding) and U (unresolved),
    of one for K = -K0 likewise p, n, z, u. Then

        positive = P,  negative = n,  unresolved = U + u,  zero = N + Z - n - u

    so that the four add up to P + N + Z + U, which has to be the whole area, found by itself. A
    spot that is unresolved in both searches counts twice as such, never as zero.

    Parameters
    ----------
    upper, lower : (k, 8), m2
        Positive, negative, zero, unresolved, both estimates, error estimate and total of each.

    Returns
    -------
    (k, 8), m2
        The same columns for K > K0, K < -K0 and what lies between.
    """
    above, not_above = upper[:, 0], upper[:, 1] + upper[:, 2]
    below = lower[:, 1]
    between = not_above - below - lower[:, 3]
    zero = np.maximum(between, 0.0)
    unresolved = np.maximum(upper[:, 3] + lower[:, 3] + np.minimum(between, 0.0), 0.0)
    return np.column_stack([
        above, below, zero, unresolved, upper[:, 4], lower[:, 5], upper[:, 6] + lower[:, 6],
        upper[:, 7],
    ])  # fmt: skip


# --------------------------------------------------------------------------------------
# One batch of patches.

KNOWN_TO = 1e-9
"""Control points count as known to this part of the diagonal of their patch, without a band."""

_ROUNDING = 2.0**-52
"""No coordinate is known better than to its rounding: this part of the largest of its patch."""

_NIL = 1e-9
"""A side where |r_u x r_v| stays below this part of its largest has no direction across it."""


def levels_of(band: ZeroBand, options: RegionOptions) -> tuple[float, ...]:
    """Give the levels to be solved for: those of the band, then the further ones, each once."""
    return tuple(dict.fromkeys((*band.levels, *options.levels)))


def coordinate_errors(patches: Patches, band: ZeroBand) -> FloatArray:
    """Give what a coordinate of a control point may be off by, for each patch, (k,), m."""
    known = KNOWN_TO * diagonals(patches) if band.delta is None else band.delta
    rounding = _ROUNDING * np.abs(patches.net).max(axis=(1, 2, 3))
    return np.asarray(np.maximum(known, rounding))


def solve_patches(
    patches: Patches, band: ZeroBand, options: RegionOptions
) -> tuple[tuple[LevelSolution, ...], FloatArray]:
    """Solve for all levels, and give the areas (k, 8) of the regions that the band parts."""
    delta = coordinate_errors(patches, band)
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
) -> LevelSolution:
    """Solve for one level; `sound` are the sides (k, 4) along which K has a meaning."""
    cells = subdivide_patches(function, options.depth, options.budget, nil=nil)
    cells = subdivide_again(function, cells, options.depth, options.budget, nil)
    arcs = arcs_of(cells)
    points = ArcPoints.of(patches, cells, arcs, options.chord_tol)
    return LevelSolution(level, cells, arcs, points, zero_edges(function.b, nil) & sound)


def _collapsed(patches: Patches) -> NDArray[np.bool_]:
    """Tell along which sides (k, 4) of patches the normal vanishes, as where one is a point."""
    r = patches.components
    normal = np.abs(cross_polynomials(u_derivative(r), v_derivative(r))).max(axis=1)
    sides = normal[:, 0], normal[:, -1], normal[:, :, 0], normal[:, :, -1]
    largest = np.stack([side.max(axis=1) for side in sides], axis=1)
    return np.asarray(largest <= _NIL * normal.max(axis=(1, 2))[:, None])


def _areas(patches: Patches, solutions: Sequence[LevelSolution], area_tol: float) -> FloatArray:
    """Give the areas of the regions, (k, 8), m2."""
    ground = AreaIntegrator.of(patches, area_tol)
    tables = [sign_areas(patches, each.cells, each.arcs, area_tol, ground) for each in solutions]
    found = [np.column_stack([getattr(table, name) for name in AREAS]) for table in tables]
    return found[0] if len(found) == 1 else band_areas(*found)


# --------------------------------------------------------------------------------------
# Patches taken from an earlier result, where their nets and the options are the same.


def keys_of(patches: Patches) -> list[bytes]:
    """Give what the findings of each patch depend on: the bits of its net and weights."""
    if patches.weight is None:
        return [net.tobytes() for net in patches.net]
    pairs = zip(patches.net, patches.weight, strict=True)
    return [net.tobytes() + weight.tobytes() for net, weight in pairs]


def usable_parts(
    previous: RegionResult | None, band: ZeroBand, options: RegionOptions
) -> dict[Kind, RegionPart]:
    """Give the parts of an earlier result by their kind; none if it was made with other options."""
    if previous is None or previous.band != band or previous.options != options:
        return {}
    return {kind_of(part.patches): part for part in previous.parts}


def solve_part(
    batch: PatchBatch, band: ZeroBand, options: RegionOptions, old: RegionPart | None
) -> tuple[RegionPart, int]:
    """Give a part, and how many patches had to be computed: each net once."""
    held = len(old) if old is not None else 0
    rows, fresh = _sources(keys_of(batch.patches), keys_of(old.patches) if old else [], held)
    found = [(old.solutions, old.areas)] if old is not None else []
    if len(fresh):
        found.append(solve_patches(batch.patches[fresh], band, options))
    solutions = tuple(
        _gathered([solution_row[level] for solution_row, _ in found], rows)
        for level in range(len(found[0][0]))
    )
    areas = np.concatenate([rows_of_areas for _, rows_of_areas in found])[rows]
    delta = coordinate_errors(batch.patches, band)
    return RegionPart(batch.patches, batch.number, solutions, areas, delta), len(fresh)


def _sources(keys: list[bytes], held: list[bytes], first: int) -> tuple[IntArray, IntArray]:
    """Give for each patch its row among what is held and then computed, and what to compute."""
    # Reversed: of equal nets the first row counts.
    known = {key: row for row, key in reversed(list(enumerate(held)))}
    rows: list[int] = []
    fresh: list[int] = []
    for place, key in enumerate(keys):
        if key not in known:
            known[key] = first + len(fresh)
            fresh.append(place)
        rows.append(known[key])
    return np.array(rows, np.intp), np.array(fresh, np.intp)


def _gathered(tables: Sequence[LevelSolution], rows: IntArray) -> LevelSolution:
    """Give what is known of chosen patches for one level."""
    cells, arcs = select_patches(
        [each.cells for each in tables], [each.arcs for each in tables], rows
    )
    edges = np.concatenate([each.edges for each in tables])[rows]
    before = np.cumsum([0, *(len(each.edges) for each in tables[:-1])])
    patch = [each.cells.patch[each.arcs.cell] + n for each, n in zip(tables, before, strict=True)]
    points = ArcPoints.gathered([each.points for each in tables], np.concatenate(patch), rows)
    return LevelSolution(tables[0].level, cells, arcs, points, edges)


# --------------------------------------------------------------------------------------
# Notes. Surfaces go by their names, or by numbers; these, as those of patches, count from one.

_SHOWN = 5
# Where in a cell curvature is looked at.
_NODES = np.stack(np.meshgrid([0.1, 0.5, 0.9], [0.1, 0.5, 0.9]), axis=-1).reshape(-1, 2)


def region_notes(
    surfaces: Sequence[SplineSurface],
    parts: Sequence[RegionPart],
    components: Sequence[LevelLine],
    options: RegionOptions,
) -> tuple[str, ...]:
    """Give what is to be known of a result, a sentence each, by surface."""
    found: list[str] = []
    for number in range(len(surfaces)):
        name = name_of(surfaces, number)
        own = next(part for part in parts if (part.patches.surface == number).any())
        pieces = [piece for piece in components if piece.surface == number]
        found += _stops(own, number, name, options)
        found += _unresolved(own, number, name, options)
        found += _nil(own, number, name, options)
        found += _spots(pieces, name)
        found += _jumps(pieces, name)
        found += _borders(pieces, name)
    return tuple(found)


def list_in_words(items: Sequence[object]) -> str:
    """Give the first few items in words, and how many more there are."""
    shown = ", ".join(str(item) for item in items[:_SHOWN])
    more = len(items) - _SHOWN
    return f"{shown} and {more} more" if more > 0 else shown


def _plural(count: int, one: str, many: str) -> str:
    return f"{count} {one if count == 1 else many}"


def _stops(part: RegionPart, number: int, name: str, options: RegionOptions) -> Iterator[str]:
    """Tell searches that the budget ended."""
    own = part.patches.surface == number
    for each in part.solutions:
        patches = (part.number[own & each.cells.stopped] + 1).tolist()
        if patches:
            yield (
                f"In {name} the search for K = {each.level:.4g} 1/m2 ended at its budget of "
                f"{options.budget} cells in {_plural(len(patches), 'patch', 'patches')} "
                f"({list_in_words(patches)}): what is left stays unresolved; a band, or a larger "
                "budget, may resolve it."
            )


def _unresolved(part: RegionPart, number: int, name: str, options: RegionOptions) -> Iterator[str]:
    """Tell areas that are unresolved beyond the tolerance."""
    areas = RegionAreas.added(part.areas[part.patches.surface == number].tolist())
    if areas.unresolved > options.area_tol * areas.total:
        yield (
            f"Of {name} {areas.unresolved:.3g} m2 ({100.0 * areas.unresolved_share:.2g} %) are "
            f"unresolved, more than area_tol ({options.area_tol:g}) of its {areas.total:.6g} m2: "
            "the estimates share them out by samples."
        )


def _nil(part: RegionPart, number: int, name: str, options: RegionOptions) -> Iterator[str]:
    """Tell parts of patches that count as K = 0 because of what points are known to."""
    total = part.areas[part.patches.surface == number].sum(axis=0)[AREAS.index("total")]
    for cells in (each.cells for each in part.solutions if each.level == 0.0):
        own = part.patches.surface[cells.patch] == number
        rows = np.flatnonzero((cells.kind == CellKind.ZERO) & (cells.level > 0) & own)
        if not len(rows):
            continue
        box = cells.box[rows]
        uv = box[:, None, :, 0] + _NODES * (box[:, None, :, 1] - box[:, None, :, 0])
        found = curvatures(part.patches, cells.patch[rows].repeat(len(_NODES)), uv.reshape(-1, 2))
        size = (box[..., 1] - box[..., 0]).prod(axis=1)
        area = float((found.element.reshape(len(rows), -1).mean(axis=1) * size).sum())
        if area > options.area_tol * total:
            yield (
                f"Of {name} {area:.3g} m2, parts of patches, count as K = 0, since points that are "
                f"off by delta = {part.delta[cells.patch[rows]].max():.2g} m may make it so; K as "
                f"given reaches {np.nanmax(np.abs(found.gauss), initial=0.0):.2g} 1/m2 there: a "
                "smaller delta, or a band, tells more."
            )


def _spots(pieces: Sequence[LevelLine], name: str) -> Iterator[str]:
    """Tell spots where the surface has no tangent plane."""
    singular = (piece for piece in pieces if piece.singular)
    # Lines of several levels meet in one spot.
    places = list(dict.fromkeys(_place(spot) for piece in singular for spot in piece.spots))
    if places:
        yield (
            f"{name[0].upper()}{name[1:]} has no tangent plane at "
            f"{_plural(len(places), 'spot', 'spots')} ({list_in_words(places)}): "
            "the lines that end there are none of its shape."
        )


def _place(spot: FloatArray) -> str:
    """Give the place of a spot in space."""
    x, y, z = spot
    return f"x {x:.3f}, y {y:.3f}, z {z:.3f} m"


def _jumps(pieces: Sequence[LevelLine], name: str) -> Iterator[str]:
    """Tell lines that end at knots, where curvature jumps."""
    lines = [piece for piece in pieces if "knot-line" in piece.tags]
    if lines:
        yield (
            f"In {name} {_plural(len(lines), 'line ends', 'lines end')} at knots where the surface "
            "is not curvature-continuous: the curvature jumps there, and so do the regions."
        )


def _borders(pieces: Sequence[LevelLine], name: str) -> Iterator[str]:
    """Tell borders of patches along which the curvature has the level."""
    for level in dict.fromkeys(piece.level for piece in pieces):
        lines = [piece for piece in pieces if piece.kind == "edge_line" and piece.level == level]
        if lines:
            patches = sorted({patch + 1 for piece in lines for patch in piece.patches})
            yield (
                f"In {name} K = {level:.4g} 1/m2 along {_plural(len(lines), 'border', 'borders')} "
                f"of patches ({list_in_words(patches)}): regions end there without a line of "
                "their own."
            )


# --------------------------------------------------------------------------------------
# The search.


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
    >>> found = ah.surface.curvature_regions(net, zero="absolute", k0=1e-4)
    >>> round(found.areas.negative_share, 6), len(found.components), found.computed
    (1.0, 0, 1)
    >>> ah.surface.curvature_regions(net, zero="absolute", k0=1e-4, previous=found).computed
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
    old = usable_parts(previous, band, options)
    found = [solve_part(batch, band, options, old.get(batch.kind)) for batch in batches]
    parts = tuple(part for part, _ in found)
    components = level_lines_of(parts, options)
    notes = region_notes(given, parts, components, options)
    computed = sum(count for _, count in found)
    return RegionResult(given, band, options, parts, components, computed, notes)
