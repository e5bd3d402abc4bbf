"""Shell plates of the kinds that a ship has: flat, rolled, conical, convex, hollow and mixed."""

from __future__ import annotations

from importlib.resources import files

from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.surfaces.control_nets import nets_of_table

__all__ = ["typical_plates"]


def typical_plates() -> tuple[SplineSurface, ...]:
    """Give six plates by name, each a Bezier surface in ship coordinates, m.

    A flat of side; a bilge (a cylinder) and a fore bilge (a cone); the shoulder of a bulb (convex);
    a hollow stern (a saddle); the flare of a bow, convex below and hollow above.

    Returns
    -------
    tuple of SplineSurface
        Plates of 3 to 8 m by 1.8 to 2.6 m; they belong to no ship in particular.

    Examples
    --------
    >>> from assoc_hull.shipped.typical_plates import typical_plates
    >>> [plate.name for plate in typical_plates()][:3]
    ['flat of side', 'bilge', 'fore bilge']
    """
    name = "typical_plates.csv"
    text = files("assoc_hull.shipped").joinpath(f"data/{name}").read_text("utf-8")
    surfaces, _ = nets_of_table(text, name)
    return tuple(surfaces)
