"""What is to be known of a plate: slivers, poles, squares, regions side by side.

Examples
--------
>>> from assoc_hull.surface.plates.plate_notes import SLIVER
>>> SLIVER
0.05
"""

from __future__ import annotations

from collections.abc import Iterator

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.surface.plates.curvature_nodes import CurvatureNodes
from assoc_hull.surface.plates.plate_class import Shares
from assoc_hull.surface.regions.region_areas import RegionAreas
from assoc_hull.surface.regions.zero_band import ZeroBand

__all__ = ["SLIVER", "plate_notes"]

SLIVER = 0.05
"""m: a plate that is less broad is none that is formed."""

_SQUARE = 1.02
"""Sides whose ratio is below this do not tell which is the longer."""

_WIDE = 1.5
"""Times the strain tolerance that a plate may show within the band before it is told."""

_SEEN = 0.01
"""A region below this part of the plate is not told."""


def plate_notes(
    name: str,
    nodes: CurvatureNodes,
    extents: FloatArray,
    areas: RegionAreas,
    band: ZeroBand,
    shares: Shares,
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


def _regions(name: str, areas: RegionAreas, shares: Shares, kind: str) -> Iterator[str]:
    """Tell convex and saddle regions side by side."""
    if kind == "mixed" and min(shares.convex, shares.saddle) > _SEEN:
        yield (
            f"{name} has {areas.positive:.3g} m2 of convex beside {areas.negative:.3g} m2 of "
            "saddle regions: heating patterns deviate where they meet."
        )
