"""What is to be known of regions: searches that ended early, spots, knots, borders.

Surfaces are told by their names, or by numbers; these, as those of patches, are counted from one.

Examples
--------
>>> from assoc_hull.surface.regions.region_notes import listed
>>> listed([1, 2, 3, 4, 5, 6, 7])
'1, 2, 3, 4, 5 and 2 more'
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.cells import CellKind
from assoc_hull.geometry.patches.curvatures import curvatures
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.regions.region_areas import RegionAreas
from assoc_hull.surface.regions.region_component import Component
from assoc_hull.surface.regions.region_options import RegionOptions
from assoc_hull.surface.regions.region_parts import AREAS, RegionPart
from assoc_hull.surface.regions.surface_batches import name_of

__all__ = ["listed", "region_notes"]

_SHOWN = 5
# Where in a cell curvature is looked at.
_NODES = np.stack(np.meshgrid([0.1, 0.5, 0.9], [0.1, 0.5, 0.9]), axis=-1).reshape(-1, 2)


def region_notes(
    surfaces: Sequence[SplineSurface],
    parts: Sequence[RegionPart],
    components: Sequence[Component],
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


def listed(items: Sequence[object]) -> str:
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
                f"({listed(patches)}): what is left stays unresolved; a band, or a larger budget, "
                "may resolve it."
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


def _spots(pieces: Sequence[Component], name: str) -> Iterator[str]:
    """Tell spots where the surface has no tangent plane."""
    singular = (piece for piece in pieces if piece.singular)
    # Lines of several levels meet in one spot.
    places = list(dict.fromkeys(_place(spot) for piece in singular for spot in piece.spots))
    if places:
        yield (
            f"{name[0].upper()}{name[1:]} has no tangent plane at "
            f"{_plural(len(places), 'spot', 'spots')} ({listed(places)}): "
            "the lines that end there are none of its shape."
        )


def _place(spot: FloatArray) -> str:
    """Give the place of a spot in space."""
    x, y, z = spot
    return f"x {x:.3f}, y {y:.3f}, z {z:.3f} m"


def _jumps(pieces: Sequence[Component], name: str) -> Iterator[str]:
    """Tell lines that end at knots, where curvature jumps."""
    lines = [piece for piece in pieces if "knot-line" in piece.tags]
    if lines:
        yield (
            f"In {name} {_plural(len(lines), 'line ends', 'lines end')} at knots where the surface "
            "is not curvature-continuous: the curvature jumps there, and so do the regions."
        )


def _borders(pieces: Sequence[Component], name: str) -> Iterator[str]:
    """Tell borders of patches along which the curvature has the level."""
    for level in dict.fromkeys(piece.level for piece in pieces):
        lines = [piece for piece in pieces if piece.kind == "edge_line" and piece.level == level]
        if lines:
            patches = sorted({patch + 1 for piece in lines for patch in piece.patches})
            yield (
                f"In {name} K = {level:.4g} 1/m2 along {_plural(len(lines), 'border', 'borders')} "
                f"of patches ({listed(patches)}): regions end there without a line of their own."
            )
