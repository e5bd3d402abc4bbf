"""Maps of the curvature regions of plates: convex, developable, saddle, with exact borders."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal

from assoc_hull.arguments import choice, instance, text
from assoc_hull.plot.plates.curvature_values import valued
from assoc_hull.plot.plates.curvature_words import BLOCK, legend, region_block
from assoc_hull.plot.plates.plate_entries import picture_of
from assoc_hull.plot.plates.plate_panels import draw_plates, field_beside, regions, views_of
from assoc_hull.plot.sheet.paper import MARGIN, PaperName
from assoc_hull.plot.sheet.sheet import Path_, Sheet, save
from assoc_hull.plot.sheet.title_block import frame
from assoc_hull.surface.plates.plate_table import Plates
from assoc_hull.surface.regions.region_result import RegionResult

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["curvature_figure"]

_WHERE = "in curvature_figure"


def curvature_figure(
    found: RegionResult | Plates,
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
    >>> figure = curvature_figure(ah.curvature_regions(net))
    """
    if not isinstance(found, Plates):
        instance(found, RegionResult, "found", _WHERE)
    shown = views_of(views, _WHERE)
    continuous = choice(quantity, "quantity", ("regions", "curvature"), _WHERE) == "curvature"
    named = text(title, "title", _WHERE)
    sheet, picture = Sheet(paper), picture_of(found)
    frame(sheet, MARGIN * sheet.paper.factor)
    low = region_block(sheet, picture, named)
    low = legend(sheet, picture, low, filled=not continuous)
    look = valued(sheet, picture.entries, low) if continuous else regions
    draw_plates(sheet, picture.entries, field_beside(sheet, BLOCK), shown, look)
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure
