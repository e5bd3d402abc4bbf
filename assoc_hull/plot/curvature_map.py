"""Maps of the curvature regions of plates: convex, developable, saddle, with exact borders."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal

import numpy as np

from assoc_hull.arguments import all_of, choice, instance, text
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.plot.block import frame, scale_bar
from assoc_hull.plot.curvature_words import BLOCK, legend, region_block, share_words
from assoc_hull.plot.form_flow import wrapped
from assoc_hull.plot.paper import MARGIN, PaperName
from assoc_hull.plot.plate_grid import Cell, Field, Sight, lay_plates
from assoc_hull.plot.plate_paint import colours, paint, signs
from assoc_hull.plot.plate_scene import Scene, scene_of
from assoc_hull.plot.plate_view import plate_frame, relief_of, upright
from assoc_hull.plot.sheet import Path_, Sheet, save
from assoc_hull.plot.view import View
from assoc_hull.surface.region_result import RegionResult

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["ViewName", "curvature_figure"]

ViewName = Literal["plan", "space", "parameters"]

_VIEWS = ("plan", "space", "parameters")
_WHERE = "in curvature_figure"


def curvature_figure(
    result: RegionResult,
    path: Path_ | None = None,
    *,
    views: Sequence[ViewName] = ("plan", "space"),
    title: str = "Curvature regions",
    paper: PaperName = "A4",
) -> Figure:
    """Draw the curvature regions of plates.

    Convex regions are red with the sign +, developable ones green with 0, saddles blue with -.
    Their borders are those that were found, not those of a grid; what is unresolved is hatched,
    with a ring where it is too small to be seen. Areas, shares and the band stand beside.

    Parameters
    ----------
    result : RegionResult
        Of `curvature_regions`.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    views : sequence of {"plan", "space", "parameters"}
        What is drawn of each plate: true to scale along its normal; from aside, where heights
        are drawn larger so that its shape is seen, by a factor that is told; or over the
        parameters u (to the right) and v (upward) of the surface.
    title : str
        Stands over the block.
    paper : "A4", "A3" or "A1"
        Size of the sheet, landscape.

    Returns
    -------
    matplotlib.figure.Figure
        The picture.

    Raises
    ------
    BadInputError, WrongTypeError
        No such result, an unknown view, paper or ending.
    MissingExtraError
        Matplotlib is not installed.

    Examples
    --------
    >>> import numpy as np
    >>> import assoc_hull as ah
    >>> from assoc_hull.plot.curvature_map import curvature_figure
    >>> x, y = np.mgrid[0:4, 0:4] / 3.0
    >>> net = np.stack([6 * x, 2 * y, 0.1 * (6 * x) * (2 * y)], axis=-1)
    >>> figure = curvature_figure(ah.curvature_regions(net))
    """
    instance(result, RegionResult, "result", _WHERE)
    shown = _views(views)
    sheet = Sheet(paper)
    frame(sheet, MARGIN * sheet.paper.factor)
    low = region_block(sheet, result, text(title, "title", _WHERE))
    legend(sheet, result, low)
    plates = [_sights(scene_of(result, k), shown) for k in range(len(result.surfaces))]
    single = len(plates) == 1
    cells = lay_plates(plates, _field(sheet), sheet.paper.factor, _below(sheet, single))
    for k, (cell, plate) in enumerate(zip(cells, plates, strict=True)):
        _plate(sheet, cell, plate, _name(result.surfaces[k], k, single))
        if not single:
            _shares(sheet, cell, share_words(result.of_surface(k)))
    _scale(sheet, cells[0])
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def _views(views: object) -> list[str]:
    """Take the kinds of views, each once."""
    found = [choice(each, "a view", _VIEWS, _WHERE) for each in all_of(views, str, "views", _WHERE)]
    if not found or len(set(found)) < len(found):
        remedy = f"give some of {', '.join(_VIEWS)}, each once"
        raise BadInputError(f"views are {', '.join(found) or 'none'}", _WHERE, remedy)
    return found


def _sights(scene: Scene, views: Sequence[str]) -> list[Sight]:
    """Give the views of a plate."""
    shape = scene.drawn()
    normal = shape.normal
    middle = shape.corner.mean(axis=1)
    plan = plate_frame(middle, np.sqrt((normal**2).sum(axis=-1)), normal.sum(axis=0))
    found = {
        "plan": lambda: Sight("plan", shape, plan),
        "space": lambda: Sight("space", shape, plan.in_space(relief_of(plan, middle))),
        "parameters": lambda: _over_parameters(scene),
    }
    return [found[view]() for view in views]


def _over_parameters(scene: Scene) -> Sight:
    """Give a plate over its parameters, about as long and broad as it is."""
    (u0, u1), (v0, v1) = scene.surface.domain
    corner = scene.surface.at([[u0, u0], [u1, u1]], [[v0, v1], [v0, v1]])
    along, across = (np.linalg.norm(np.diff(corner, axis=axis), axis=-1).mean() for axis in (0, 1))
    least = 0.1 * max(along, across, 1e-9)
    size = np.array([max(along, least) / (u1 - u0), max(across, least) / (v1 - v0)])

    def chart(uv: FloatArray) -> FloatArray:
        flat = (uv - (u0, v0)) * size
        return np.concatenate([flat, np.zeros_like(flat[..., :1])], axis=-1)

    shape = scene.drawn(chart)
    return Sight("parameters", shape, upright(shape.corner.mean(axis=(0, 1))))


def _field(sheet: Sheet) -> Field:
    """Give the part of the sheet for plates."""
    factor, paper = sheet.paper.factor, sheet.paper
    edge = (MARGIN + 5.0) * factor
    right = paper.width - (MARGIN + BLOCK + 5.0) * factor
    return Field(edge, edge + 8.0 * factor, right, paper.height - edge + 1.0 * factor)


def _below(sheet: Sheet, single: bool) -> float:
    """Give the room for words below a plate, mm."""
    return 0.0 if single else 6.0 * sheet.paper.factor


def _name(surface: SplineSurface, number: int, single: bool) -> str:
    return surface.name or ("" if single else f"{number + 1}")


def _plate(sheet: Sheet, cell: Cell, plate: Sequence[Sight], name: str) -> None:
    """Draw the views of a plate with their captions."""
    factor = sheet.paper.factor
    for place, sight in zip(cell.places, plate, strict=True):
        paint(sheet, place, sight.shape, colours(sight.shape), f"{name}/{sight.kind}",
              shaded=sight.kind == "space")  # fmt: skip
        signs(sheet, place, sight.shape, f"{name}/{sight.kind}")
    words = [name] if name else []
    words += [_told(sight, cell.denominator) for sight in plate]
    field = cell.field
    lines = wrapped(sheet, " · ".join(words), field.right - field.left, 1.1)
    sheet.text((field.left, field.top - 1.0 * factor), lines[0], size=1.1, bold=True, across="left",
               up="top", name="label/plate")  # fmt: skip


def _told(sight: Sight, denominator: float) -> str:
    """Say how a view shows the plate."""
    if sight.kind == "plan":
        return f"plan 1:{denominator:g}"
    if sight.kind == "parameters":
        return "over u, v"
    relief = sight.eye.relief
    return "in space" if relief == 1.0 else f"in space, heights × {relief:g}"


def _shares(sheet: Sheet, cell: Cell, words: str) -> None:
    """Write what the regions of a plate take of it below."""
    field, factor = cell.field, sheet.paper.factor
    place = (0.5 * (field.left + field.right), field.low + 1.0 * factor)
    sheet.text(place, words, up="bottom", name="label/shares")


def _scale(sheet: Sheet, cell: Cell) -> None:
    """Draw the scale of the plans."""
    if cell.denominator:
        edge, factor = MARGIN * sheet.paper.factor, sheet.paper.factor
        place = (edge + 5.0 * factor, edge + 5.0 * factor)
        view = View("plan", (0, 1), cell.denominator, (0.0, 0.0))
        scale_bar(sheet, view, place, 60.0 * factor, f"plan 1:{cell.denominator:g}")
