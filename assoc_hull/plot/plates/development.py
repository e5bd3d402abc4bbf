"""A plate laid flat: its outline, and maps of the strain that forming must put in."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from assoc_hull.arguments import instance
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.plates.colour_legend import BLOCK, STRAIN, colour_bar, shades
from assoc_hull.plot.plates.paint_tiles import fill_outline
from assoc_hull.plot.plates.plate_layout import SheetArea
from assoc_hull.plot.plates.plate_picture import area_words
from assoc_hull.plot.sheet.labels import wrap_words
from assoc_hull.plot.sheet.paper import MARGIN, PaperName, Pen, View, scale_of
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, save
from assoc_hull.plot.sheet.title_block import frame, scale_bar, title_block
from assoc_hull.surface.plating.development import LABEL, Development

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["development_figure", "development_sheet"]

_OUTLINE = Pen(0.3, over=2.6)
_CAPTION, _BAR = 7.0, 20.0  # room above a map, and below both, mm at A3
_ROUND = (1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)
_LEAST = 1e-6
"""The bar reaches at least to this strain: less is rounding, and shows as none."""


def development_figure(
    flat: Development, path: Path_ | None = None, *, paper: PaperName = "A4"
) -> Figure:
    """Draw a plate laid flat, with its strains along and across.

    Parameters
    ----------
    flat : Development
        Of a plate.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    paper : "A4", "A3" or "A1"
        Size of the sheet, landscape.

    Returns
    -------
    matplotlib.figure.Figure
        The picture: two maps to one scale, purple where the flat plate is to be shrunk, orange
        where it is to be stretched, labelled as a geometric estimate.

    Raises
    ------
    BadInputError, WrongTypeError
        No development, an unknown paper or ending.
    MissingExtraError
        Matplotlib is not installed.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
    >>> from assoc_hull.plot.plates.development import development_figure
    >>> from assoc_hull.surface.plating.development import development
    >>> x, y = np.mgrid[-1:1:3j, -1:1:3j]
    >>> net = np.stack([3 * x, y, 0.3 * x * y], axis=-1)
    >>> figure = development_figure(development(SplineSurface.bezier(net, "hypar"), (9, 5)))
    """
    sheet = development_sheet(flat, paper=paper)
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def development_sheet(flat: Development, *, paper: PaperName = "A4") -> Sheet:
    """Draw the same as a sheet; arguments and errors as of `development_figure`."""
    instance(flat, Development, "flat", "in development_figure")
    sheet = Sheet(paper)
    factor, size = sheet.paper.factor, sheet.paper
    frame(sheet, MARGIN * factor)
    _block(sheet, flat)
    edge = (MARGIN + 6.0) * factor
    right = size.width - (MARGIN + BLOCK + 6.0) * factor
    field = SheetArea(edge, edge + _BAR * factor, right, size.height - edge)
    most = _reach(flat)
    long, broad = flat.size.tolist()
    room = 0.5 * (field.top - field.low) - _CAPTION * factor
    denominator = max(scale_of(long, field.right - field.left), scale_of(broad, room))
    for row, drawn in enumerate(_maps(flat)):
        _map(sheet, field.part(row, 0, 2, 1, 0.0), flat, drawn, (1e3 / denominator, most))
    _foot(sheet, field, denominator, most)
    return sheet


def _reach(flat: Development) -> float:
    """Give a round strain that is no less than any."""
    most = max(flat.largest_strain, _LEAST)
    power = 10.0 ** np.floor(np.log10(most))
    return float(next(k * power for k in _ROUND if k * power >= most * (1.0 - 1e-9)))


def _maps(flat: Development) -> Iterator[tuple[str, FloatArray, FloatArray]]:
    """Give both strains with a tile around each spring: (p, q), corners (p, q, 4, 2), m."""
    yield "strain along", flat.longitudinal, _tiles(_between(flat.flat))
    across = _tiles(_between(np.swapaxes(flat.flat, 0, 1)))
    yield "strain across", flat.transverse, np.swapaxes(across, 0, 1)


def _between(node: FloatArray) -> FloatArray:
    """Give places midway between the rows of nodes (p, q, 2), and the outer rows: (p, q + 1, 2)."""
    middle = 0.5 * (node[:, 1:] + node[:, :-1])
    return np.concatenate([node[:, :1], middle, node[:, -1:]], axis=1)


def _tiles(node: FloatArray) -> FloatArray:
    """Give the corners of the cells of a grid (p, q, 2), going round."""
    return np.stack([node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]], axis=2)


def _map(
    sheet: Sheet,
    field: SheetArea,
    flat: Development,
    drawn: tuple[str, FloatArray, FloatArray],
    scale: tuple[float, float],
) -> None:
    """Draw one map in the middle of a field; scale: mm for a metre, and the largest strain."""
    factor, (name, value, corner), (unit, most) = sheet.paper.factor, drawn, scale
    box = np.array([flat.flat.min(axis=(0, 1)), flat.flat.max(axis=(0, 1))])
    centre = np.array([field.left + field.right, field.low + field.top - _CAPTION * factor]) / 2.0
    origin = centre - unit * box.mean(axis=0)
    place = origin + unit * corner
    colour = shades(value / most, STRAIN)
    fill_outline(sheet, place.reshape(-1, 4, 2), colour.reshape(-1, 3), f"{name}/tiles")
    outline = origin + unit * flat.outline
    sheet.line(np.concatenate([outline, outline[:1]]), _OUTLINE, f"{name}/outline")
    if np.ptp(value) > _LEAST:
        for spot in (value.argmin(), value.argmax()):
            x, y = place.reshape(-1, 4, 2)[spot].mean(axis=0).tolist()
            sheet.dots(np.array([[x, y]]), "black", 0.8, f"{name}/extreme")
            left = x < centre[0]
            beside = (x + 1.2 * factor * (1.0 if left else -1.0), y)
            words = _signed(float(value.flat[spot]))
            sheet.text(beside, words, size=0.95, across="left" if left else "right",
                       halo=True, name=f"label/extreme/{name}")  # fmt: skip
    words = f"{name}: {_signed(float(value.min()))} to {_signed(float(value.max()))}"
    sheet.text((field.left, field.top - 1.0 * factor), words, size=1.1, bold=True, across="left",
               up="top", name=f"label/map/{name}")  # fmt: skip


def _signed(strain: float) -> str:
    """Write a strain in thousandths."""
    return f"{1e3 * strain:+.2f}‰".replace("-", "−")


def _foot(sheet: Sheet, field: SheetArea, denominator: float, most: float) -> None:
    """Draw the scale and the colours below both maps."""
    factor = sheet.paper.factor
    edge = (MARGIN + 6.0) * factor
    view = View("plan", (0, 1), denominator, (0.0, 0.0))
    scale_bar(sheet, view, (edge, edge), 60.0 * factor, f"1:{denominator:g}")
    bar = SheetArea(field.right - 80.0 * factor, edge, field.right, edge + 3.5 * factor)
    marks = [(side, _signed(side * most) if side else "0") for side in (-1.0, 0.0, 1.0)]
    title = "strain to be put in: − shrinking, + stretching"
    colour_bar(sheet, bar, STRAIN, marks, title)


def _block(sheet: Sheet, flat: Development) -> None:
    """Write sizes, strains and what the picture is not."""
    paper, factor = sheet.paper, sheet.paper.factor
    long, broad = flat.size.tolist()
    nodes = " x ".join(str(count) for count in flat.flat.shape[:2])
    rows = [
        ("Flat plate, length, breadth", f"{long:.3f}, {broad:.3f} m"),
        ("Area, flat", area_words(flat.flat_area)),
        ("Area, formed", area_words(flat.area)),
        ("Forming changes the area by", f"{100.0 * flat.area_change:+.2g} %".replace("-", "−")),
        ("Largest strain along", f"{np.abs(flat.longitudinal).max():.2e}"),
        ("Largest strain across", f"{np.abs(flat.transverse).max():.2e}"),
        ("Nodes", nodes),
    ]
    room = (BLOCK - 7.0) * factor
    notes = [f"A {LABEL}.", *flat.notes]
    lines = [line for words in notes for line in wrap_words(sheet, words, room, 1.0)]
    corner = (paper.width - MARGIN * factor, paper.height - MARGIN * factor)
    title_block(sheet, corner, BLOCK * factor, flat.name or "Development", rows, lines)
