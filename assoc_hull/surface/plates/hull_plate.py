"""A plate of a hull: what is known of its shape, and how sure that is.

Examples
--------
>>> from assoc_hull.surface.plates.hull_plate import COARSE
>>> COARSE
0.2
"""

from __future__ import annotations

import attrs

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.surface.plates.curvature_nodes import CurvatureNodes
from assoc_hull.surface.plates.hull_seams import PlateRange
from assoc_hull.surface.plates.plate_class import Shares
from assoc_hull.surface.plates.roll_axis import Rulings, rulings

__all__ = ["COARSE", "TOO_COARSE", "HullPlate"]

COARSE = 0.2
"""A plate of which so much is in doubt has no class."""

TOO_COARSE = "net too coarse for regions"
"""What is said of it."""


@attrs.frozen(eq=False)
class HullPlate:
    """What lies between two butts and two seams of a hull.

    Attributes
    ----------
    name : str
        Its number along the ship, and, after a point, up the girth.
    range : PlateRange
        Between which places it lies.
    blocks : tuple of str
        The blocks of the surface that it has a part of.
    area : float, m2
        Its area.
    area_error : float, m2
        What its area and those of its regions may be off by, as areas of this surface.
    length, breadth : float, m
        The larger and the smaller extent along e1 and e2.
    axes : (3, 3)
        The axes e1 (along), e2, e3 of the plate, as rows; e2 lies to the right of e1 for who
        looks at the plate from outside.
    dk : float or None, 1/m2
        By how much Gaussian curvature changes between fits of the same net, on 95 % of the plate;
        None if no other fit was given.
    k0 : float, 1/m2
        Half the width of the band that counts as no curvature: that which was asked for, doubled
        until it is not below `dk`.
    shares : Shares
        Convex, saddle, cylinder, flat and unresolved parts of the area, together 1.
    contested : float
        The part of the area with K0/2 <= |K| <= 2 K0: which region it belongs to is in doubt.
    changed : float
        The part outside that, of which another fit tells another region, or a curvature that
        differs by more than the K0 that was asked for.
    kind : {"flat", "cylinder", "saddle", "convex", "mixed"} or None
        The class; None where the net is too coarse for regions, or too much is unresolved.
    order : {1, 2, 3} or None
        1 flat, 2 bent one way, 3 bent both ways.
    rollable : bool
        Whether cylinder and flat parts together have the asked share.
    roll_axis : float or None, degrees
        The direction it is rolled about, from e1 towards e2, 0 to 180; None where no single one
        serves.
    roll_direction : (3,) or None
        The same in space.
    coherence : float
        How well the directions of bending agree, 0 to 1.
    least_radius, largest_radius : float or None, m
        One over the larger principal curvature, where it is most and where it is least.
    total_curvature : float
        The integral of |K| dA.
    mean_strain, largest_strain : float
        |K| b**2 / 8 with the plate's own breadth b, mean and largest.
    suggestion : str
        Advice, no instruction.
    notes : tuple of str
        What is to be known of it, each a sentence.
    nodes : CurvatureNodes
        Curvature at nodes; those outside the plate have no area.
    """

    name: str
    range: PlateRange
    blocks: tuple[str, ...]
    area: float
    area_error: float
    length: float
    breadth: float
    axes: FloatArray
    dk: float | None
    k0: float
    shares: Shares
    contested: float
    changed: float
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
    suggestion: str
    notes: tuple[str, ...]
    nodes: CurvatureNodes = attrs.field(repr=False)

    def __attrs_post_init__(self) -> None:
        freeze(self.axes)
        if self.roll_direction is not None:
            freeze(self.roll_direction)

    @property
    def too_coarse(self) -> bool:
        """Whether so much is in doubt that no class is given."""
        return self.contested + self.changed > COARSE

    def rulings(self, count: int = 9) -> Rulings:
        """Give the mean direction of rulings in stretches along the plate; see `Plate.rulings`."""
        return rulings(self.nodes, self.axes, count)

    def __str__(self) -> str:
        """Say in a line what it is."""
        kind = self.kind or (TOO_COARSE if self.too_coarse else "unresolved")
        axis = "no roll axis" if self.roll_axis is None else f"roll axis {self.roll_axis:.1f} deg"
        return (
            f"{self.name} ({self.range}): {self.length:.2f} x {self.breadth:.2f} m, "
            f"{self.area:.3f} m2, {kind}, {axis}, {100.0 * self.contested:.1f} % contested"
        )
