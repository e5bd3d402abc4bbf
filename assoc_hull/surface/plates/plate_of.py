"""A plate made of a surface, the regions that were found on it, and curvature at nodes.

Each plate by itself: what is found does not depend on the others that are asked for with it.

Examples
--------
>>> from assoc_hull.surface.plates.plate_of import radius
>>> radius(0.2), radius(1e-12)
(5.0, None)
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.plates.curvature_nodes import CurvatureNodes, curvature_nodes
from assoc_hull.surface.plates.options import PlateOptions
from assoc_hull.surface.plates.plate import Plate
from assoc_hull.surface.plates.plate_class import shares_of
from assoc_hull.surface.plates.plate_extents import plate_axes, plate_extents, seam_lengths
from assoc_hull.surface.plates.plate_notes import plate_notes
from assoc_hull.surface.plates.roll_axis import COHERENT, roll_axis
from assoc_hull.surface.plates.suggestions import suggestion_key
from assoc_hull.surface.regions.region_result import RegionResult

__all__ = ["Draft", "draft", "plate_of", "radius"]

_STRAIGHT = 1e6
"""m: a radius above this is none."""

_POINT = 1e-9
"""m: a line that is no longer lies at a pole, and is none of the shape."""

_LINES = ("closed", "open", "junction", "edge_line")
"""Components that are lines."""


@attrs.frozen(eq=False)
class Draft:
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


def draft(surface: SplineSurface, name: str, cut: bool) -> Draft:
    """Measure a plate.

    Parameters
    ----------
    surface : SplineSurface
        The plate.
    name : str
        Its name.
    cut : bool
        Whether it lies between seams, whose lengths then are its extents.
    """
    nodes = curvature_nodes(surface.patches())
    axes = plate_axes(nodes)
    extents = seam_lengths(surface) if cut else plate_extents(surface.net, axes)
    return Draft(name, surface, nodes, axes, np.sort(extents)[::-1])


def radius(bent: float) -> float | None:
    """Give the radius of a curvature, m; None above 1,000 km."""
    return 1.0 / bent if bent * _STRAIGHT > 1.0 else None


def plate_of(
    measured: Draft, regions: RegionResult, number: int, breadth: float, options: PlateOptions
) -> Plate:
    """Put a plate together.

    Parameters
    ----------
    measured : Draft
        What was measured of it.
    regions : RegionResult
        The regions of some surfaces.
    number : int
        Which of them is the plate.
    breadth : float, m
        What the band was made for.
    options : PlateOptions
        By what plates are told apart.
    """
    areas, nodes = regions.of_surface(number), measured.nodes
    shares = shares_of(areas, nodes, regions.k0, options.flat_bend(breadth))
    kind, rollable = shares.kind(options.share), shares.rollable(options.share)
    axis = roll_axis(nodes, measured.axes)
    single = kind != "flat" and axis.coherence >= COHERENT
    strain, amount = measured.breadth**2 / 8.0, np.abs(nodes.gauss)
    whole = float((nodes.area * amount).sum())
    there = nodes.bent[nodes.area > 0.0]
    return Plate(
        name=measured.name, surface=measured.surface, number=number, areas=areas,
        length=float(measured.extents[0]), breadth=measured.breadth, axes=measured.axes,
        k0=regions.k0, band_breadth=breadth, shares=shares, kind=kind,
        order=shares.order(options.share), rollable=rollable,
        roll_axis=axis.angle_deg if single else None,
        roll_direction=axis.direction if single else None, coherence=axis.coherence,
        least_radius=radius(float(there.max())),
        largest_radius=radius(0.0 if shares.flat > 0.0 else float(there.min())),
        total_curvature=whole, mean_strain=strain * whole / float(nodes.area.sum()),
        largest_strain=strain * float(amount.max()),
        heating=areas.positive + areas.negative > regions.options.area_tol * areas.total,
        lines=sum(
            each.surface == number and each.kind in _LINES and each.length > _POINT
            for each in regions.components
        ),
        suggestion=options.suggestions[suggestion_key(kind, rollable, single)],
        notes=plate_notes(
            measured.name, nodes, measured.extents, areas, regions.band, shares, kind
        ),
    )  # fmt: skip
