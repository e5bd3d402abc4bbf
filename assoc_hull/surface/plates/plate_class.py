"""What kind of plate shares of its area make it: flat, cylinder, saddle, convex or mixed.

Examples
--------
>>> from assoc_hull.surface.plates.plate_class import Shares
>>> inflected = Shares(convex=0.0, saddle=0.0, cylinder=0.94, flat=0.06, unresolved=0.0)
>>> inflected.kind(0.95), inflected.rollable(0.95), inflected.order(0.95)
('mixed', True, 2)
"""

from __future__ import annotations

import attrs

from assoc_hull.surface.plates.curvature_nodes import CurvatureNodes
from assoc_hull.surface.plates.flat_share import flat_share
from assoc_hull.surface.regions.region_areas import RegionAreas

__all__ = ["KINDS", "Shares", "shares_of"]

KINDS = ("flat", "cylinder", "saddle", "convex", "mixed")
"""The classes of plates."""

_ROUNDING = 1e-9
"""A share is not below a limit by rounding."""


@attrs.frozen
class Shares:
    """Parts of the area of a plate; together 1, within the tolerance of areas.

    Attributes
    ----------
    convex : float
        Where K > K0.
    saddle : float
        Where K < -K0.
    cylinder : float
        Where |K| <= K0, but bent. Parted from `flat` by samples, 128 each way on a patch: the
        border between both may be off by half a step.
    flat : float
        Where |K| <= K0, and no curvature exceeds that of the sagitta which is neglected.
    unresolved : float
        What may belong to any of these.
    """

    convex: float
    saddle: float
    cylinder: float
    flat: float
    unresolved: float

    @property
    def developable(self) -> float:
        """What can be made without straining the plate: cylinder and flat."""
        return self.cylinder + self.flat

    def kind(self, share: float) -> str:
        """Give the class: the region that has this share at least, else "mixed"."""
        for kind in KINDS[:-1]:
            if getattr(self, kind) >= share - _ROUNDING:
                return kind
        return "mixed"

    def rollable(self, share: float) -> bool:
        """Tell whether so much is developable, whatever the plate is called."""
        return self.developable >= share - _ROUNDING

    def order(self, share: float) -> int:
        """Give 1 for a flat plate, 2 for one bent one way, 3 for one bent both ways.

        A mixed plate of cylinder and flat parts is bent one way.
        """
        if self.kind(share) == "flat":
            return 1
        return 2 if self.rollable(share) else 3


def shares_of(areas: RegionAreas, nodes: CurvatureNodes, k0: float, flat_bend: float) -> Shares:
    """Give the shares of regions; the developable part is split into cylinder and flat by samples.

    Parameters
    ----------
    areas : RegionAreas
        The areas of the plate's regions.
    nodes : CurvatureNodes
        Those of all its patches.
    k0 : float, 1/m2
        Half the width of the band; with 0 all samples tell which part of the zero region is flat.
    flat_bend : float, 1/m
        The principal curvature up to which a plate counts as flat.
    """
    flat = flat_share(nodes, k0, flat_bend)
    zero = areas.zero_share
    return Shares(
        areas.positive_share, areas.negative_share, zero * (1.0 - flat), zero * flat,
        areas.unresolved_share,
    )  # fmt: skip
