"""One plate: what it measures, which class it is, how it may be formed.

Examples
--------
>>> import assoc_hull as ah
>>> import numpy as np
>>> x, y = np.mgrid[0:6:3j, 0:2:3j]
>>> (plate,) = ah.plates(np.stack([x, y, 0.1 * x * y], axis=-1))
>>> plate.kind, plate.order, round(plate.roll_axis, 1)
('saddle', 3, 135.7)
"""

from __future__ import annotations

import attrs

from assoc_hull.arguments import integer
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.plates.curvature_nodes import curvature_nodes
from assoc_hull.surface.plates.development import Development, development
from assoc_hull.surface.plates.plate_class import Shares
from assoc_hull.surface.plates.roll_axis import Rulings, rulings
from assoc_hull.surface.regions.region_areas import RegionAreas

__all__ = ["Plate"]


@attrs.frozen(eq=False)
class Plate:
    """A plate of a shell: regions, class, roll axis, what forming takes.

    Attributes
    ----------
    name : str
        Its name; "plate 3" of the third that has none.
    surface : SplineSurface
        Its shape.
    number : int
        The number of this surface in its `RegionResult`.
    areas : RegionAreas
        The areas of its regions, m2.
    length, breadth : float, m
        The larger and the smaller extent, of control points along e1 and e2; of a plate between
        seams the mean lengths of opposite borders.
    axes : (3, 3)
        The axes e1 (along), e2, e3 of the plate, as rows; e2 lies to the right of e1 for who
        looks at the side that r_u x r_v points to.
    k0 : float, 1/m2
        Half the width of the band of Gaussian curvatures that count as none.
    band_breadth : float, m
        The breadth that the band, and the sagitta of what is flat, are meant for.
    shares : Shares
        Convex, saddle, cylinder, flat and unresolved parts of the area, together 1.
    kind : {"flat", "cylinder", "saddle", "convex", "mixed"}
        The class: the region that has the asked share.
    order : {1, 2, 3}
        1 flat, 2 bent one way, 3 bent both ways.
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
        The integral of |K| dA, nil for developable plates.
    mean_strain, largest_strain : float
        |K| b**2 / 8 with the plate's own breadth b, mean and largest.
    heating : bool
        Whether there are regions where the strain exceeds the tolerance: convex or saddle parts.
    lines : int
        How many lines part its regions.
    suggestion : str
        Advice, no instruction.
    notes : tuple of str
        What is to be known of it, each a sentence.
    """

    name: str
    surface: SplineSurface
    number: int
    areas: RegionAreas
    length: float
    breadth: float
    axes: FloatArray
    k0: float
    band_breadth: float
    shares: Shares
    kind: str
    order: int
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
    lines: int
    suggestion: str
    notes: tuple[str, ...]

    def __attrs_post_init__(self) -> None:
        freeze(self.axes)
        if self.roll_direction is not None:
            freeze(self.roll_direction)

    @property
    def area(self) -> float:
        """Its area, m2."""
        return self.areas.total

    @property
    def unresolved_area(self) -> float:
        """The area of which the search did not tell the region, m2."""
        return self.areas.unresolved

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
        >>> (plate,) = ah.plates(np.stack([x, y * (1 + x / 6), 0.2 * y * y * (1 + x / 6)], axis=-1))
        >>> plate.rulings(3).radius.shape
        (3,)
        """
        integer(count, "count", "in Plate.rulings", least=1, most=100)
        return rulings(curvature_nodes(self.surface.patches()), self.axes, count)

    def development(self, grid: tuple[int, int] | None = None) -> Development:
        """Lay the plate flat; see `assoc_hull.surface.plates.development.development`.

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
            Another grid.
        """
        return attrs.evolve(development(self.surface, grid), name=self.name)

    def __str__(self) -> str:
        """Say in a line what it is."""
        if self.roll_axis is None:
            axis = "no roll axis"
        else:
            axis = f"roll axis {self.roll_axis:.1f} deg"
        strain = self.mean_strain if self.mean_strain > 1e-12 else 0.0  # rounding of nil
        return (
            f"{self.name}: {self.length:.2f} x {self.breadth:.2f} m, {self.area:.3f} m2, "
            f"{self.kind}, order {self.order}, {axis}, mean strain {strain:.1e}"
        )
