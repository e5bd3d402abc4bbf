"""One plate: its length and breadth, class, roll axis, strains and notes.

`plate_of` makes a `Plate` of a surface, `assoc_hull.surface.plating.hull_plate` one of a hull; what
both find in the same way from curvature at nodes is in `assemble_plate`.
What is found of a plate does not depend on the others that are asked for with it.
The axis e1 runs along the plate, e2 across, by the second moments of area.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import attrs
import numpy as np

from assoc_hull.arguments import integer
from assoc_hull.display import ShownAsText
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.plating.curvature_nodes import CurvatureNodes, curvature_nodes
from assoc_hull.surface.plating.development import Development, development
from assoc_hull.surface.plating.hull_seams import PlateRange
from assoc_hull.surface.plating.options import PlateOptions
from assoc_hull.surface.plating.plate_class import (
    COHERENT,
    PlateShares,
    Rulings,
    roll_axis,
    rulings,
    shares_of,
    suggestion_key,
)
from assoc_hull.surface.regions.level_lines import RegionAreas
from assoc_hull.surface.regions.options import ZeroBand
from assoc_hull.surface.regions.result import RegionResult

__all__ = [
    "COARSE",
    "SLIVER",
    "HullExtent",
    "Plate",
    "PlateDraft",
    "assemble_plate",
    "draft_plate",
    "plate_axes",
    "plate_extents",
    "plate_notes",
    "plate_of",
    "radius_of",
    "seam_lengths",
]


_LOOKS = 257
"""Places along a seam; its length is off by a few millionths."""


def plate_axes(nodes: CurvatureNodes) -> FloatArray:
    """Give the axes of a plate, those of the second moments of area: e1, e2, e3 as rows, (3, 3).

    e1 runs along the plate, its component with the largest amount is positive. Seen from the side
    that r_u x r_v points to, e2 runs to the right of e1, and e3 = e1 x e2 away from the viewer.
    """
    weight = nodes.area.ravel() / nodes.area.sum()
    place = nodes.place.reshape(-1, 3)
    off = place - weight @ place
    _, vectors = np.linalg.eigh((off * weight[:, None]).T @ off)
    e1 = vectors[:, 2] * np.sign(vectors[np.abs(vectors[:, 2]).argmax(), 2])
    e2 = vectors[:, 1]
    e3 = np.cross(e1, e2)
    if e3 @ nodes.normal.sum(axis=(0, 1, 2)) > 0.0:
        e2, e3 = -e2, -e3
    return np.stack([e1, e2, e3])


def plate_extents(net: FloatArray, axes: FloatArray) -> FloatArray:
    """Give what control points (..., 3), m, extend along e1 and e2, (2,), m.

    Never less than what the plate itself does.
    """
    return np.asarray(np.ptp(net.reshape(-1, 3) @ axes[:2].T, axis=0))


def seam_lengths(surface: SplineSurface) -> FloatArray:
    """Give the mean lengths of opposite borders of a surface: along u and along v, (2,), m."""
    (u0, u1), (v0, v1) = surface.domain
    u, v = np.linspace(u0, u1, _LOOKS), np.linspace(v0, v1, _LOOKS)
    along_u = surface.at(u[:, None], np.array([v0, v1]))
    along_v = np.swapaxes(surface.at(np.array([[u0], [u1]]), v), 0, 1)
    steps = np.diff(np.stack([along_u, along_v]), axis=1)
    return np.asarray(np.linalg.norm(steps, axis=-1).sum(axis=1).mean(axis=1))


# --------------------------------------------------------------------------------------
# Notes: slivers, poles, squares, regions side by side.

SLIVER = 0.05
"""m: a plate that is less broad is none that is formed."""

_SQUARE = 1.02
"""Sides whose ratio is below this do not tell which is the longer."""

_WIDE = 1.5
"""Times the strain tolerance that a plate may show within the band before it is reported."""

_SEEN = 0.01
"""A region below this part of the plate is not reported."""


def plate_notes(
    name: str,
    nodes: CurvatureNodes,
    extents: FloatArray,
    areas: RegionAreas,
    band: ZeroBand,
    shares: PlateShares,
    kind: str,
) -> tuple[str, ...]:
    """Give what is to be known of a plate, a sentence each."""
    return (
        *_size(name, extents),
        *_poles(name, nodes),
        *_breadth(name, float(extents[1]), band),
        *_regions(name, areas, shares, kind),
    )


def _size(name: str, extents: FloatArray) -> Iterator[str]:
    """Tell slivers and squares."""
    length, breadth = extents.tolist()
    if breadth < SLIVER:
        yield (
            f"{name} is {length:.3g} m long and {breadth:.3g} m broad: a sliver, of which a class "
            "tells little."
        )
    if length < _SQUARE * breadth:
        yield (
            f"{name} is as long as it is broad ({length:.4g} and {breadth:.4g} m): its axis e1 may "
            "lie either way; take the roll direction in space."
        )


def _poles(name: str, nodes: CurvatureNodes) -> Iterator[str]:
    """Tell nodes without a normal."""
    count = int((nodes.area == 0.0).sum())
    if count:
        yield (
            f"{name} has {count} nodes without a normal, at a border or spot of no length: its "
            "curvature is not evaluated there, and may be larger than is told."
        )


def _breadth(name: str, breadth: float, band: ZeroBand) -> Iterator[str]:
    """Tell plates that are much broader than the band is meant for."""
    if band.strain_tol is None:
        return
    strain = band.k0 * breadth**2 / 8.0
    if strain > _WIDE * band.strain_tol:
        yield (
            f"{name} is {breadth:.3g} m broad, the band is made for {band.breadth:g} m: what "
            f"counts as developable may take a strain of {strain:.2g}; give breadth=None for the "
            "breadth of each plate."
        )


def _regions(name: str, areas: RegionAreas, shares: PlateShares, kind: str) -> Iterator[str]:
    """Tell convex and saddle regions side by side."""
    if kind == "mixed" and min(shares.convex, shares.saddle) > _SEEN:
        yield (
            f"{name} has {areas.positive:.3g} m2 of convex beside {areas.negative:.3g} m2 of "
            "saddle regions: heating patterns deviate where they meet."
        )


# --------------------------------------------------------------------------------------
# The plate.


COARSE = 0.2
"""The class of a plate of which so much is in doubt is that of the fitted surface alone."""


@attrs.frozen(eq=False)
class HullExtent:
    """Where on a hull a plate lies, and what the fit of the hull leaves open there.

    Attributes
    ----------
    range : PlateRange
        Between which places it lies.
    blocks : tuple of str
        The blocks of the surface that it has a part of.
    nodes : CurvatureNodes
        Curvature at nodes; those outside the plate have no area.
    dk : float or None, 1/m2
        By how much Gaussian curvature changes between fits of the same net, on 95 % of the plate;
        None if no other fit was given.
    contested : float
        The part of the area with K0/2 <= |K| <= 2 K0: which region it belongs to is in doubt.
    changed : float
        The part outside that, of which another fit tells another region, or a curvature that
        differs by more than the K0 that was asked for.
    """

    range: PlateRange
    blocks: tuple[str, ...]
    nodes: CurvatureNodes = attrs.field(repr=False)
    dk: float | None
    contested: float
    changed: float


@attrs.frozen(eq=False, repr=False)
class Plate(ShownAsText):
    """A plate of a shell: regions, class, roll axis, what forming takes.

    Attributes
    ----------
    name : str
        Its name; "plate 3" of the third that has none. On a hull its number along the ship, and,
        after a point, up the girth.
    areas : RegionAreas
        The areas of its regions, m2; on a hull what lies beside borders of blocks is unresolved.
    length, breadth : float, m
        The larger and the smaller extent along e1 and e2, of control points, on a hull of the
        plate itself; of a plate between seams of parameters the mean lengths of opposite borders.
    axes : (3, 3)
        The axes e1 (along), e2, e3 of the plate, as rows; seen from the side that r_u x r_v points
        to, outside of a hull, e2 lies to the right of e1.
    k0 : float, 1/m2
        Half the width of the band of Gaussian curvatures that count as none; on a hull that which
        was asked for, doubled until it is not below `dk`.
    band_breadth : float, m
        The breadth that the band, and the sagitta of what is flat, are meant for.
    shares : PlateShares
        Convex, saddle, cylinder, flat and unresolved parts of the area, together 1.
    kind : {"flat", "cylinder", "saddle", "convex", "mixed"} or None
        The class: the region that has the asked share. On a hull that of the fitted surface, in
        doubt where `is_doubtful`; None where too much is unresolved.
    order : {1, 2, 3} or None
        1 flat, 2 bent one way, 3 bent both ways; None without a class.
    rollable : bool
        Whether cylinder and flat parts together have the asked share.
    roll_axis : float or None, degrees
        The direction it is rolled about, from e1 towards e2, 0 to 180; None of a flat plate, and
        where no single direction serves.
    roll_direction : (3,) or None
        The same in space.
    coherence : float
        How well the directions of bending agree, 0 to 1; of noise on a flat plate.
    least_radius, largest_radius : float or None, m
        One over the larger principal curvature, where it is most and where it is least; None
        above 1,000 km, and no largest one where a part is flat.
    total_curvature : float
        The integral of |K| dA, zero for developable plates.
    mean_strain, largest_strain : float
        |K| b**2 / 8 with the plate's own breadth b, mean and largest.
    heating : bool
        Whether there are regions where the strain exceeds the tolerance: convex or saddle parts.
    suggestion : str
        Advice, no instruction.
    notes : tuple of str
        What is to be known of it, each a sentence.
    surface : SplineSurface or None
        Its shape; None on a hull, of whose blocks it has parts.
    number : int
        The number of this surface in its `RegionResult`; 0 on a hull, where blocks are surfaces.
    lines : int or None
        How many lines part its regions; None on a hull, where they are not counted by plate.
    extent : HullExtent or None
        Where on a hull it lies; None of a plate of single surfaces.
    """

    name: str
    areas: RegionAreas
    length: float
    breadth: float
    axes: FloatArray
    k0: float
    band_breadth: float
    shares: PlateShares
    kind: str | None
    order: int | None
    rollable: bool
    roll_axis: float | None
    roll_direction: FloatArray | None
    coherence: float
    least_radius: float | None
    largest_radius: float | None
    total_curvature: float
    mean_strain: float
    largest_strain: float
    heating: bool
    suggestion: str
    notes: tuple[str, ...]
    surface: SplineSurface | None = None
    number: int = 0
    lines: int | None = None
    extent: HullExtent | None = None

    def __attrs_post_init__(self) -> None:
        freeze(self.axes)
        if self.roll_direction is not None:
            freeze(self.roll_direction)

    @property
    def area(self) -> float:
        """Its area, m2."""
        return self.areas.total

    @property
    def area_error(self) -> float:
        """What its area and those of its regions may be off by, m2."""
        return self.areas.error_estimate

    @property
    def unresolved_area(self) -> float:
        """The area of which the region is not told, m2."""
        return self.areas.unresolved

    @property
    def nodes(self) -> CurvatureNodes:
        """Curvature at nodes; on a hull those outside the plate have no area."""
        return self.extent.nodes if self.extent else curvature_nodes(self._shape().patches())

    @property
    def range(self) -> PlateRange | None:
        """Between which places of a hull it lies; None of a plate of single surfaces."""
        return self.extent.range if self.extent else None

    @property
    def blocks(self) -> tuple[str, ...]:
        """The blocks of a hull that it has a part of; none of a plate of single surfaces."""
        return self.extent.blocks if self.extent else ()

    @property
    def dk(self) -> float | None:
        """What curvature changes by between fits, 1/m2; None without other fits."""
        return self.extent.dk if self.extent else None

    @property
    def contested(self) -> float:
        """The part with K0/2 <= |K| <= 2 K0; nil of a surface that is given, not fitted."""
        return self.extent.contested if self.extent else 0.0

    @property
    def changed(self) -> float:
        """The part outside that, which other fits tell otherwise; nil without a fit."""
        return self.extent.changed if self.extent else 0.0

    @property
    def doubt(self) -> float:
        """The part of the area of which the region is in doubt: contested and changed parts."""
        return self.contested + self.changed

    @property
    def is_doubtful(self) -> bool:
        """Whether so much is in doubt (a fifth) that the net does not tell the class for certain.

        It is that of the fitted surface then, the best that is known.
        """
        return self.doubt > COARSE

    def rulings(self, count: int = 9) -> Rulings:
        """Give the mean direction of rulings in stretches along the plate.

        What a cone, or another plate without a common roll axis, is bent by.

        Parameters
        ----------
        count : int
            How many stretches, 1 to 100.

        Returns
        -------
        Rulings
            Stations along e1, angles from e1 towards e2, radii.

        Raises
        ------
        BadInputError
            No number of stretches.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> import numpy as np
        >>> x, y = np.mgrid[0:6:3j, -1:1:3j]
        >>> (plate,) = ah.surface.plates(
        ...     np.stack([x, y * (1 + x / 6), 0.2 * y * y * (1 + x / 6)], axis=-1)
        ... )
        >>> plate.rulings(3).radius.shape
        (3,)
        """
        integer(count, "count", "in Plate.rulings", least=1, most=100)
        return rulings(self.nodes, self.axes, count)

    def development(self, grid: tuple[int, int] | None = None) -> Development:
        """Lay the plate flat; see `assoc_hull.surface.plating.development.development`.

        Parameters
        ----------
        grid : (along, across), optional
            Nodes of the grid, 3 to 257 each; 17 across and square cells by default.

        Returns
        -------
        Development
            Outline and strains: a geometric estimate, no springback, no plasticity.

        Raises
        ------
        BadInputError
            Another grid; a plate of a hull, which has no surface of its own.
        """
        return attrs.evolve(development(self._shape(), grid), name=self.name)

    def _shape(self) -> SplineSurface:
        if self.surface is None:
            raise BadInputError(
                f"plate {self.name} of a hull is no surface of its own", "in Plate.development",
                "cut the surface along parameters: surface.plates(hull.surface(), Seams(u=...))",
            )  # fmt: skip
        return self.surface

    def __str__(self) -> str:
        """Say in a line what it is."""
        size = f"{self.length:.2f} x {self.breadth:.2f} m, {self.area:.3f} m2"
        axis = "no roll axis" if self.roll_axis is None else f"roll axis {self.roll_axis:.1f} deg"
        if self.extent is None:
            strain = self.mean_strain if self.mean_strain > 1e-12 else 0.0  # rounding of zero
            about = f"{self.kind}, order {self.order}, {axis}, mean strain {strain:.1e}"
            return f"{self.name}: {size}, {about}"
        kind = self.kind or "unresolved"
        if self.is_doubtful:
            kind += f" (in doubt on {100.0 * self.doubt:.0f} %)"
        about = f"{kind}, {axis}, {100.0 * self.contested:.1f} % contested"
        return f"{self.name} ({self.extent.range}): {size}, {about}"


# --------------------------------------------------------------------------------------
# How it is put together.

_STRAIGHT = 1e6
"""m: a radius above this is none."""

_POINT = 1e-9
"""m: a line that is no longer lies at a pole, and is none of the shape."""

_LINES = ("closed", "open", "junction", "edge_line")
"""Components that are lines."""


@attrs.frozen(eq=False)
class PlateDraft:
    """What a plate measures before its regions are known.

    Attributes
    ----------
    name : str
        Its name.
    surface : SplineSurface
        Its shape.
    nodes : CurvatureNodes
        Curvature at nodes of all its patches.
    axes : (3, 3)
        e1, e2, e3 as rows.
    extents : (2,), m
        Length and breadth.
    """

    name: str
    surface: SplineSurface
    nodes: CurvatureNodes
    axes: FloatArray
    extents: FloatArray

    @property
    def breadth(self) -> float:
        """The smaller extent, m."""
        return float(self.extents[1])


def draft_plate(surface: SplineSurface, name: str, cut: bool) -> PlateDraft:
    """Measure a plate; of one that is cut, between seams, the lengths of these are its extents."""
    nodes = curvature_nodes(surface.patches())
    axes = plate_axes(nodes)
    extents = seam_lengths(surface) if cut else plate_extents(surface.net, axes)
    return PlateDraft(name, surface, nodes, axes, np.sort(extents)[::-1])


def radius_of(bent: float) -> float | None:
    """Give the radius of a curvature, m; None above 1,000 km."""
    return 1.0 / bent if bent * _STRAIGHT > 1.0 else None


def plate_of(
    measured: PlateDraft, regions: RegionResult, number: int, breadth: float, options: PlateOptions
) -> Plate:
    """Put a plate together, number `number` of the surfaces that have these regions.

    `breadth`, m, is what the band was made for.
    """
    areas, nodes = regions.of_surface(number), measured.nodes
    shares = shares_of(areas, nodes, regions.k0, options.flat_bend(breadth))
    kind = shares.kind(options.share)
    return assemble_plate(
        nodes, shares, kind, options,
        name=measured.name, areas=areas, length=float(measured.extents[0]),
        breadth=measured.breadth, axes=measured.axes, k0=regions.k0, band_breadth=breadth,
        heating=areas.positive + areas.negative > regions.options.area_tol * areas.total,
        notes=plate_notes(
            measured.name, nodes, measured.extents, areas, regions.band, shares, kind
        ),
        surface=measured.surface, number=number,
        lines=sum(
            each.surface == number and each.kind in _LINES and each.length > _POINT
            for each in regions.components
        ),
    )  # fmt: skip


def assemble_plate(
    nodes: CurvatureNodes,
    shares: PlateShares,
    kind: str | None,
    options: PlateOptions,
    *,
    axes: FloatArray,
    breadth: float,
    extent: HullExtent | None = None,
    **known: Any,
) -> Plate:
    """Find roll axis, radii, strains and advice from curvature at nodes; the rest is `known`."""
    axis, rollable = roll_axis(nodes, axes), shares.rollable(options.share)
    single = kind != "flat" and axis.coherence >= COHERENT
    strain, amount = breadth**2 / 8.0, np.abs(nodes.gauss)
    whole = float((nodes.area * amount).sum())
    within = nodes.area > 0.0
    there = nodes.bent[within]
    doubt = extent.contested + extent.changed if extent else 0.0
    return Plate(
        axes=axes, breadth=breadth, shares=shares, kind=kind,
        order=None if kind is None else shares.order(options.share), rollable=rollable,
        roll_axis=axis.angle_deg if single else None,
        roll_direction=axis.direction if single else None, coherence=axis.coherence,
        least_radius=radius_of(float(there.max())),
        largest_radius=radius_of(0.0 if shares.flat > 0.0 else float(there.min())),
        total_curvature=whole, mean_strain=strain * whole / float(nodes.area.sum()),
        largest_strain=strain * float(amount[within].max()),
        suggestion=_advice(kind, doubt, rollable, single, options), extent=extent, **known,
    )  # fmt: skip


def _advice(
    kind: str | None, doubt: float, rollable: bool, single: bool, options: PlateOptions
) -> str:
    """Give the suggestion, with the doubt where it is large; none for a plate without a class."""
    if kind is None:
        return "none: too much of it is unresolved"
    advice = options.suggestions[suggestion_key(kind, rollable, single)]
    return f"{advice} (in doubt on {100.0 * doubt:.0f} % of it)" if doubt > COARSE else advice
