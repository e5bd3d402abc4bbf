"""Maps of the curvature of plates: regions with exact borders, or continuous values.

Regions are convex, developable and saddle. The continuous map shows asinh(K / K0), so that the
band of developable stays visible beside large curvatures; values are those at the middles of
tiles.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal

import attrs
import numpy as np

from assoc_hull.arguments import choice, instance, text
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.bezier_patches import curvatures
from assoc_hull.plot.plates.colour_legend import (
    BLOCK,
    CURVATURE,
    colour_bar,
    legend,
    region_block,
    shades,
)
from assoc_hull.plot.plates.plate_layout import SheetArea
from assoc_hull.plot.plates.plate_panels import (
    PlateLook,
    draw_plates,
    field_beside,
    regions,
    views_of,
)
from assoc_hull.plot.plates.plate_picture import (
    PlateEntry,
    PlateScene,
    grid_tiles,
    picture_of,
    steps_of,
)
from assoc_hull.plot.sheet.paper import MARGIN, PaperName
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, save
from assoc_hull.plot.sheet.title_block import frame
from assoc_hull.surface.plating.curvature_nodes import map_value
from assoc_hull.surface.plating.hull_plates import HullPlateTable
from assoc_hull.surface.plating.plate_table import PlateTable
from assoc_hull.surface.regions.options import zero_band
from assoc_hull.surface.regions.result import RegionResult

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = [
    "curvature_figure",
    "value_map",
]

# --------------------------------------------------------------------------------------
# Continuous maps of curvature: values at the middles of tiles, colours on both sides of nil.

_STEPS, _STEPS_OF_MANY = 96, 40
"""Tiles along a side of a plate, if it is the only one, and if it is one of several."""


@attrs.frozen(eq=False)
class _Values:
    """A plate as a grid of tiles with their Gaussian curvature, 1/m2."""

    scene: PlateScene
    gauss: FloatArray


def value_map(sheet: Sheet, entries: Sequence[PlateEntry], top: float) -> PlateLook:
    """Draw the bar of a continuous map below a height, and give how plates are drawn for it.

    Shown is asinh(K / K0), so that the band stays visible beside large curvatures; both signs
    reach equally far.
    """
    k0 = max(entry.result.k0 for entry in entries) or zero_band().k0
    steps = _STEPS if len(entries) == 1 else _STEPS_OF_MANY
    found = {id(entry): _values(entry, steps) for entry in entries}
    largest = max(float(np.nanmax(np.abs(each.gauss))) for each in found.values())
    most = max(largest, 2.0 * k0)
    reach = float(map_value(np.array(most), k0))
    factor = sheet.paper.factor
    right = sheet.paper.width - (MARGIN + 6.0) * factor
    high = top - 10.0 * factor
    bar = SheetArea(right - (BLOCK - 12.0) * factor, high - 4.0 * factor, right, high)
    colour_bar(sheet, bar, CURVATURE, _marks(k0, most, reach), "K, 1/m²; scale asinh(K/K0)")

    def look(entry: PlateEntry) -> tuple[PlateScene, FloatArray]:
        values = found[id(entry)]
        level = np.nan_to_num(map_value(values.gauss, k0) / reach)
        return values.scene, shades(level, CURVATURE)

    return look


def _marks(k0: float, most: float, reach: float) -> list[tuple[float, str]]:
    """Give the ends, nil, and K0 where there is room."""
    marks = [(0.0, "0")]
    place = float(map_value(np.array(k0), k0)) / reach
    for side, sign in ((-1.0, "−"), (1.0, "")):
        marks.append((side, f"{sign}{most:.2g}"))
        if 0.15 < place < 0.75:
            marks.append((side * place, f"{sign}K0"))
    return marks


def _values(entry: PlateEntry, steps: int) -> _Values:
    """Give the curvature in the middles of tiles; nan where there is no tangent plane."""
    uv, gauss = [], []
    for part in entry.result.parts:
        patches = part.patches[np.flatnonzero(part.patches.surface == entry.number)]
        if len(patches):
            row, corner = grid_tiles(len(patches), steps_of(patches, steps))
            gauss.append(curvatures(patches, row, corner.mean(axis=1)).gauss)
            flat = corner.reshape(-1, 2)
            uv.append(patches.parameters(np.repeat(row, 4), flat).reshape(-1, 4, 2))
    corners = np.concatenate(uv)
    count = len(corners)
    scene = attrs.evolve(
        entry.scene, uv=corners, tint=np.zeros(count, np.intp), under=np.zeros(count, np.bool_)
    )
    return _Values(scene, np.concatenate(gauss))


# --------------------------------------------------------------------------------------
# Maps of the curvature regions of plates: convex, developable, saddle, with exact borders.

_WHERE = "in curvature_figure"


def curvature_figure(
    found: RegionResult | PlateTable,
    path: Path_ | None = None,
    *,
    views: Sequence[Literal["plan", "space", "parameters"]] = ("plan", "space"),
    quantity: Literal["regions", "curvature"] = "regions",
    title: str = "Curvature regions",
    paper: PaperName = "A4",
) -> Figure:
    """Draw the curvature regions of plates.

    Convex regions are red with the sign +, developable ones green with 0, saddles blue with -.
    Their borders are those that were found, not those of a grid; what is unresolved is hatched,
    with a ring where it is too small to be seen. Areas, shares and the band stand beside; of
    `Plates` also the class of each and the axis it is rolled about. Lines of further levels are
    thin and bear their curvature.

    Parameters
    ----------
    found : RegionResult or Plates
        Of `curvature_regions`, or of `plates`.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    views : sequence of {"plan", "space", "parameters"}
        What is drawn of each plate: true to scale along its normal; from aside, where heights
        are drawn larger so that its shape is seen, by a factor that is told; or over the
        parameters u (to the right) and v (upward) of the surface.
    quantity : {"regions", "curvature"}
        The colours tell the region, or the Gaussian curvature itself in the middle of each tile;
        the lines are exact in both.
    title : str
        Stands over the block.
    paper : "A4", "A3" or "A1"
        Size of the sheet, landscape.

    Returns
    -------
    matplotlib.figure.Figure
        The picture; what belongs to a plate has the id ``name/view/...``.

    Raises
    ------
    BadInputError, WrongTypeError
        No such result, an unknown view, quantity, paper or ending.
    MissingExtraError
        Matplotlib is not installed.

    Examples
    --------
    >>> import numpy as np
    >>> import assoc_hull as ah
    >>> from assoc_hull.plot.plates.curvature_map import curvature_figure
    >>> x, y = np.mgrid[-1:1:3j, -1:1:3j]
    >>> net = np.stack([3 * x, y, 0.1 * x * y], axis=-1)
    >>> figure = curvature_figure(ah.surface.curvature_regions(net))
    """
    if not isinstance(found, PlateTable) or isinstance(found, HullPlateTable):
        instance(found, RegionResult, "found", _WHERE)
    shown = views_of(views, _WHERE)
    continuous = choice(quantity, "quantity", ("regions", "curvature"), _WHERE) == "curvature"
    named = text(title, "title", _WHERE)
    sheet, picture = Sheet(paper), picture_of(found)
    frame(sheet, MARGIN * sheet.paper.factor)
    low = region_block(sheet, picture, named)
    low = legend(sheet, picture, low, filled=not continuous)
    look = value_map(sheet, picture.entries, low) if continuous else regions
    draw_plates(sheet, picture.entries, field_beside(sheet, BLOCK), shown, look)
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure
