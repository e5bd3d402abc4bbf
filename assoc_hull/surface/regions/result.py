"""What is found of the curvature regions of surfaces: areas, level lines, outlines, notes.

`RegionResult` is handed to the user, drawn, written, and taken as `previous` by the next search.
Outlines of regions are made when they are asked for.

Examples
--------
>>> import assoc_hull as ah
>>> import numpy as np
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0] = net[:, 1, 1] = net[1, 1, 2] = 1.0
>>> print(ah.surface.curvature_regions(net))
1 surface, 1.28079 m2: 0 % convex, 100 % saddle, 0 % developable, 0 % unresolved; \
K0 = 0.00128 1/m2 (strain 0.001 over 2.5 m)
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import attrs
import numpy as np

from assoc_hull.arguments import choice, integer
from assoc_hull.display import ShownAsText
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.patches.cells import CellKind
from assoc_hull.geometry.patches.outlines import (
    Outlines,
    SignRegion,
    outlines_of_region,
    outlines_of_rest,
)
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.patches.zero_set_arcs import sample_arcs
from assoc_hull.surface.regions.level_lines import LevelLine, RegionAreas, RegionPart
from assoc_hull.surface.regions.options import RegionOptions, ZeroBand

__all__ = [
    "REGIONS",
    "RegionOutline",
    "RegionResult",
    "outlines_of",
]


REGIONS = ("positive", "negative", "zero")
"""The regions that have outlines."""

# A border is halved so often at most.
_MOST = 12


@attrs.frozen(eq=False)
class RegionOutline:
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
) -> list[RegionOutline]:
    """Give the outlines of one of `REGIONS` of the patches of a part, surface by surface.

    Holes come last. With `banded` the first two solutions are those of a band, K0 and -K0. Chords
    stray by `tol` at most, m.
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
        return outlines_of_region(
            part.patches, _region(part, 0, kind.get(region, CellKind.ZERO), tol), True
        )
    above, below = (
        _region(part, 0, CellKind.POSITIVE, tol),
        _region(part, 1, CellKind.NEGATIVE, tol),
    )
    if region == "zero":
        return outlines_of_rest(part.patches, [above, below], True)
    return outlines_of_region(part.patches, above if region == "positive" else below, True)


def _region(part: RegionPart, number: int, kind: CellKind, tol: float) -> SignRegion:
    """Give the region of one solution."""
    solution, patches = part.solutions[number], part.patches
    samples = sample_arcs(patches, solution.cells, solution.arcs, tol)
    return SignRegion(solution.cells, solution.arcs, kind, samples)


def _outline(
    surfaces: Sequence[SplineSurface], number: int, uv: FloatArray, hole: bool, tol: float
) -> RegionOutline:
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
    return RegionOutline(number, uv, xyz, hole)


# --------------------------------------------------------------------------------------
# The result.


@attrs.frozen(eq=False, slots=False, repr=False)
class RegionResult(ShownAsText):
    """Regions of Gaussian curvature of some surfaces.

    What is certain: in `positive` is K > K0 and in `negative` K < -K0, but for what quadrature may
    be off by (`error_estimate`) and within what control points are known to (`delta`); every
    piece of a border between regions is a component, unless it lies inside the unresolved spots.
    What is not: `positive_estimate` and `negative_estimate` share out the unresolved part by
    samples.

    Attributes
    ----------
    surfaces : tuple of SplineSurface
        The surfaces, in the order they were given in.
    band : ZeroBand
        What counts as no curvature: mode, K0, strain, breadth, delta.
    options : RegionOptions
        Tolerances and limits.
    parts : tuple of RegionPart
        What is known of each patch, for pictures and for `previous`: a part for each bidegree.
    components : tuple of LevelLine
        The connected pieces of the lines K = K0 and K = -K0 (of K = 0 without a band), and of the
        further levels.
    computed : int
        How many patches were computed; the others were taken from the earlier result, or have
        the net of another patch.
    notes : tuple of str
        What is to be known of the result, each a sentence.
    """

    surfaces: tuple[SplineSurface, ...] = attrs.field(repr=False)
    band: ZeroBand
    options: RegionOptions
    parts: tuple[RegionPart, ...] = attrs.field(repr=False)
    components: tuple[LevelLine, ...] = attrs.field(repr=False)
    computed: int
    notes: tuple[str, ...]

    @cached_property
    def areas(self) -> RegionAreas:
        """The areas of all surfaces together."""
        return RegionAreas.added(np.concatenate([part.areas for part in self.parts]).tolist())

    def of_surface(self, number: int) -> RegionAreas:
        """Give the areas of one surface, numbered from 0.

        Raises
        ------
        BadInputError
            No number of a surface.
        """
        where = "in RegionResult.of_surface"
        which = integer(number, "number", where, least=0, most=len(self.surfaces) - 1)
        rows = [part.areas[part.patches.surface == which] for part in self.parts]
        return RegionAreas.added(np.concatenate(rows).tolist())

    def outlines(self, region: str) -> tuple[RegionOutline, ...]:
        """Give the outlines of a region, over the borders of patches.

        Parameters
        ----------
        region : str
            "positive": K > K0. "negative": K < -K0. "zero": all that is left between them (without
            a band, cells in which K is zero).

        Returns
        -------
        tuple of RegionOutline
            Closed polygons, surface by surface; chords keep the tolerance of polylines.

        Raises
        ------
        BadInputError
            Another region.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> import numpy as np
        >>> u, v = np.mgrid[0:3, 0:3] / 2.0
        >>> net = np.stack([2 * u, v, 0.3 * u * v], axis=-1)
        >>> [outline.surface for outline in ah.surface.curvature_regions(net).outlines("negative")]
        [0]
        """
        choice(region, "region", REGIONS, "in RegionResult.outlines")
        tol, banded = self.options.chord_tol, len(self.band.levels) > 1
        found = [
            outline
            for part in self.parts
            for outline in outlines_of(self.surfaces, part, region, banded, tol)
        ]
        return tuple(sorted(found, key=lambda outline: outline.surface))

    @property
    def positive(self) -> float:
        """Where K > K0 for certain, m2."""
        return self.areas.positive

    @property
    def negative(self) -> float:
        """Where K < -K0 for certain, m2."""
        return self.areas.negative

    @property
    def zero(self) -> float:
        """Where |K| <= K0, m2."""
        return self.areas.zero

    @property
    def unresolved(self) -> float:
        """Where the search ended, m2."""
        return self.areas.unresolved

    @property
    def positive_estimate(self) -> float:
        """The positive area with its share of what is unresolved by samples, m2."""
        return self.areas.positive_estimate

    @property
    def negative_estimate(self) -> float:
        """The negative area with its share of what is unresolved by samples, m2."""
        return self.areas.negative_estimate

    @property
    def error_estimate(self) -> float:
        """What quadrature may be off by, m2."""
        return self.areas.error_estimate

    @property
    def total(self) -> float:
        """The whole area, m2."""
        return self.areas.total

    @property
    def zero_mode(self) -> str:
        """How the band was given: "strain", "absolute" or "exact"."""
        return self.band.mode

    @property
    def k0(self) -> float:
        """Half the width of the band, 1/m2; 0 without one."""
        return self.band.k0

    @property
    def strain_tol(self) -> float | None:
        """The strain that is neglected; None if the band was not given by it."""
        return self.band.strain_tol

    @property
    def breadth(self) -> float | None:
        """The breadth of the strip that has this strain, m; None likewise."""
        return self.band.breadth

    @property
    def delta(self) -> float:
        """What control points were taken to be off by, m; the most of all patches."""
        return float(max(part.delta.max() for part in self.parts))

    @property
    def depth(self) -> int:
        """How often a patch was halved at most."""
        return self.options.depth

    @property
    def area_tol(self) -> float:
        """The tolerance of areas, relative to that of a patch."""
        return self.options.area_tol

    @property
    def chord_tol(self) -> float:
        """The tolerance of polylines, m."""
        return self.options.chord_tol

    @property
    def count(self) -> int:
        """The number of patches."""
        return sum(len(part) for part in self.parts)

    def __str__(self) -> str:
        """Give areas, shares and the band in a line."""
        many = "s" if len(self.surfaces) != 1 else ""
        return f"{len(self.surfaces)} surface{many}, {self.areas}; {self.band}"
