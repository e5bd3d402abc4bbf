"""Outlines of the regions of a surface, over the borders of its patches, for export.

Examples
--------
>>> import assoc_hull as ah
>>> import numpy as np
>>> u, v = np.mgrid[0:4, 0:4] / 3.0
>>> wave = np.array([0.0, -0.5, -0.5, 0.8])[:, None]
>>> net = np.stack([2 * u, v, wave + 0.1 * v * (v > 0.5)], axis=-1)
>>> result = ah.curvature_regions(net, zero="exact")
>>> [len(result.outlines(region)) for region in ("positive", "negative", "zero")]
[1, 1, 0]
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.patches.cells import CellKind
from assoc_hull.geometry.patches.outlines import Outlines, Region, outlines, rest
from assoc_hull.geometry.patches.sampling import sampled
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.regions.region_parts import RegionPart

__all__ = ["REGIONS", "Outline", "outlines_of"]

REGIONS = ("positive", "negative", "zero")
"""The regions that have outlines."""

# A border is halved so often at most.
_MOST = 12


@attrs.frozen(eq=False)
class Outline:
    """One closed outline of a region; a hole is an outline of its own.

    Attributes
    ----------
    surface : int
        The number of the surface, from 0.
    uv : (n, 2)
        Corners in parameters of the surface, with the region on the left where u runs to the
        right and v upward; the last leads to the first.
    xyz : (n, 3), m
        The same points in space; chords stray by no more than the tolerance of polylines.
    hole : bool
        Whether it goes round a hole of the region.
    """

    surface: int
    uv: FloatArray
    xyz: FloatArray
    hole: bool

    def __attrs_post_init__(self) -> None:
        freeze(self.uv, self.xyz)


def outlines_of(
    surfaces: Sequence[SplineSurface], part: RegionPart, region: str, banded: bool, tol: float
) -> list[Outline]:
    """Give the outlines of one region of the patches of a part.

    Parameters
    ----------
    surfaces : sequence of SplineSurface
        All surfaces of the result.
    part : RegionPart
        Patches of one bidegree.
    region : str
        One of `REGIONS`.
    banded : bool
        Whether the first two solutions are those of a band: K0 and -K0.
    tol : float, m
        How far chords may stray.

    Returns
    -------
    list of Outline
        Surface by surface, holes last.
    """
    found = _found(part, region, banded, tol)
    surface = part.patches.surface[found.patch]
    order = np.lexsort([found.enclosed < 0.0, surface])
    return [
        _outline(surfaces, int(surface[i]), found.loop(i), bool(found.enclosed[i] < 0.0), tol)
        for i in order.tolist()
    ]


def _found(part: RegionPart, region: str, banded: bool, tol: float) -> Outlines:
    """Give the outlines over parameters."""
    if not banded:
        kind = {"positive": CellKind.POSITIVE, "negative": CellKind.NEGATIVE}
        return outlines(part.patches, _region(part, 0, kind.get(region, CellKind.ZERO), tol), True)
    above, below = (
        _region(part, 0, CellKind.POSITIVE, tol),
        _region(part, 1, CellKind.NEGATIVE, tol),
    )
    if region == "zero":
        return rest(part.patches, [above, below], True)
    return outlines(part.patches, above if region == "positive" else below, True)


def _region(part: RegionPart, number: int, kind: CellKind, tol: float) -> Region:
    """Give the region of one solution."""
    solution, patches = part.solutions[number], part.patches
    samples = sampled(patches, solution.cells, solution.arcs, tol)
    return Region(solution.cells, solution.arcs, kind, samples)


def _outline(
    surfaces: Sequence[SplineSurface], number: int, uv: FloatArray, hole: bool, tol: float
) -> Outline:
    """Put an outline on its surface, with points between its corners where chords would stray."""
    surface = surfaces[number]
    low, high = np.transpose(surface.domain)
    uv = np.clip(uv, low, high)
    xyz = surface.at(uv[:, 0], uv[:, 1])
    for _ in range(_MOST):
        next_uv, next_xyz = np.roll(uv, -1, axis=0), np.roll(xyz, -1, axis=0)
        middle = 0.5 * (uv + next_uv)
        place = surface.at(middle[:, 0], middle[:, 1])
        stray = np.linalg.norm(place - 0.5 * (xyz + next_xyz), axis=1)
        wide = np.flatnonzero(stray > tol)
        if not len(wide):
            break
        uv = np.insert(uv, wide + 1, middle[wide], axis=0)
        xyz = np.insert(xyz, wide + 1, place[wide], axis=0)
    return Outline(number, uv, xyz, hole)
