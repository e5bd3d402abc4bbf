"""The pictures that go with hydrostatics, by name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from assoc_hull.analysis.hydrostatics.bonjean import bonjean, sectional_areas
from assoc_hull.analysis.hydrostatics.hydrostatic_table import HydrostaticTable
from assoc_hull.arguments import choice
from assoc_hull.hull import Hull
from assoc_hull.plot.diagrams.hydrostatic_curves import hydrostatic_curves
from assoc_hull.plot.diagrams.section_areas import bonjean_curves, sectional_area_curve
from assoc_hull.plot.sheet.sheet import Path_

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["PICTURES", "plot_hydrostatics"]

PICTURES = ("curves", "areas", "bonjean")


def plot_hydrostatics(
    hull: Hull, table: HydrostaticTable, picture: str, path: Path_ | None = None
) -> Figure:
    """Draw one of the pictures that go with a table of hydrostatics.

    Parameters
    ----------
    hull : Hull
        The hull.
    table : HydrostaticTable
        Of it.
    picture : "curves", "areas" or "bonjean"
        Hydrostatic curves, the sectional-area curve of the first position, or Bonjean curves.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.

    Raises
    ------
    BadInputError
        Another picture; one draught for curves; what `save` raises.
    """
    if choice(picture, "picture", PICTURES) == "curves":
        return hydrostatic_curves(table, path)
    if picture == "areas":
        return sectional_area_curve(sectional_areas(hull, table.positions[0]), table, path)
    return bonjean_curves(hull, bonjean(hull), table, path)
