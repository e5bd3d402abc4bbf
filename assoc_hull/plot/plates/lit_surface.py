"""The surface of a hull with light on it, seen from ahead and from astern, with lines over it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import attrs
import numpy as np

from assoc_hull.arguments import all_of, text
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.plot.plates.paint_tiles import HullTiles, hull_tiles, paint_quads
from assoc_hull.plot.sheet.paper import MARGIN, POINT, PaperName, Pen
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, save
from assoc_hull.plot.sheet.title_block import caption, frame
from assoc_hull.surface.blocks.fitted_surface import FittedSurface
from assoc_hull.surface.regions.surface_batches import batches_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["surface_figure"]

_EYES = (
    ("FROM AHEAD, PORT SIDE", (0.80, 0.58, -0.13)),
    ("FROM ASTERN, PORT SIDE", (-0.66, 0.73, -0.16)),
)
"""Toward the eye, which lies a little below: no deck hides the far side."""

_LIGHT = (0.40, 0.25, 0.88)
"""Of the light: towards the side that is seen, upward, toward the eye."""

_TINT = np.array([0.60, 0.71, 0.80])
_DARK = 0.42
_SHINE = 0.35

_LINE = Pen(0.10, "0.25", over=2.2)
_BORDER = Pen(0.30, "#b03a2e", over=2.6)

_STATIONS, _WATERLINES = 24, 10
_LOOKS = 129


def surface_figure(
    surface: FittedSurface | Sequence[SplineSurface],
    path: Path_ | None = None,
    *,
    title: str | None = None,
    paper: PaperName = "A4",
) -> Figure:
    """Draw the surface of a hull, both sides, from ahead and from astern.

    Thin lines are sections and waterlines of the surface, even steps apart; heavy red ones the
    borders of its blocks.

    Parameters
    ----------
    surface : FittedSurface, or sequence of SplineSurface
        The half hull, as `surface` gives it; or its blocks, with normals out of the hull.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    title : str, optional
        Stands in the upper left corner; the name of the ship if none is given.
    paper : "A4", "A3" or "A1"
        Size of the sheet, landscape.

    Returns
    -------
    matplotlib.figure.Figure
        The picture.

    Raises
    ------
    BadInputError, WrongTypeError
        No surface, an unknown paper or ending.
    MissingExtraError
        Matplotlib is not installed.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
    >>> from assoc_hull.plot.plates.lit_surface import surface_figure
    >>> x, z = np.mgrid[0:30:2j, 9:0:2j]
    >>> side = SplineSurface.bezier(np.stack([x, 8.0 + 0.5 * z, z], axis=-1), "body")
    >>> figure = surface_figure((side,))
    """
    where = "in surface_figure"
    name = "" if title is None else text(title, "title", where)
    if isinstance(surface, FittedSurface):
        surfaces, name = surface.patches, name or surface.particulars.name
    else:
        surfaces = tuple(all_of(surface, SplineSurface, "surface", where))
    if not surfaces:
        raise BadInputError("surface is empty", where, "give at least one block")
    sheet = Sheet(paper)
    frame(sheet, MARGIN * sheet.paper.factor)
    scene = _Scene.of(surfaces)
    edge = (MARGIN + 5.0) * sheet.paper.factor
    middle, top = 0.5 * sheet.paper.height, sheet.paper.height - edge
    halves = ((middle, top - 6.0 * sheet.paper.factor), (edge, middle))
    for (words, toward), (low, high) in zip(_EYES, halves, strict=True):
        scene.draw(sheet, np.array(toward), (low, high), words)
    if name:
        sheet.text((edge, top), name, size=2.2, bold=True, across="left", up="top",
                   name="label/title")  # fmt: skip
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


@attrs.frozen(eq=False)
class _Scene:
    """Tiles of both sides, lines on them with normals, and borders of blocks; m."""

    corner: FloatArray
    normal: FloatArray
    lines: FloatArray
    line_normal: FloatArray
    borders: tuple[FloatArray, ...]

    @classmethod
    def of(cls, surfaces: Sequence[SplineSurface]) -> _Scene:
        """Cut surfaces into tiles, and mirror them."""
        patches = Patches.joined([batch.patches for batch in batches_of(surfaces)])
        tiles = hull_tiles(patches)
        lines, normals = _lines(tiles)
        borders = [line for surface in surfaces for line in _borders(surface)]
        mirror = np.array([1.0, -1.0, 1.0])
        corner, normal = tiles.corner[..., :3], tiles.facing
        return cls(
            np.concatenate([corner, corner * mirror]), np.concatenate([normal, normal * mirror]),
            np.concatenate([lines, lines * mirror]), np.concatenate([normals, normals * mirror]),
            tuple(borders),
        )  # fmt: skip

    def draw(self, sheet: Sheet, toward: FloatArray, room: tuple[float, float], words: str) -> None:
        """Draw the hull from one side, between two heights of the sheet, mm."""
        turn, factor = _turned(toward), sheet.paper.factor
        flat = self.corner @ turn.T
        low, high = flat[..., :2].min(axis=(0, 1)), flat[..., :2].max(axis=(0, 1))
        wide = sheet.paper.width - 2.0 * (MARGIN + 8.0) * factor
        foot = room[0] + 8.0 * factor
        unit = float(min(wide / (high[0] - low[0]), (room[1] - foot) / (high[1] - low[1])))
        centre = np.array([0.5 * sheet.paper.width, 0.5 * (foot + room[1])])
        origin = centre - unit * 0.5 * (low + high)
        seen = np.flatnonzero(self.normal @ turn[2] > 0.0)
        seen = seen[np.argsort(flat[seen, :, 2].mean(axis=1), kind="stable")]
        colour = _lit(self.normal[seen] @ turn.T, float(np.sign(turn[0, 1])))
        paint_quads(sheet, origin + unit * flat[seen, :, :2], colour, f"{words}/tiles")
        shown = self.line_normal @ turn[2] > 0.02
        _strokes(sheet, origin + unit * (self.lines[shown] @ turn.T)[..., :2], _LINE)
        for border in self.borders:
            sheet.line(origin + unit * (border @ turn.T)[:, :2], _BORDER, f"{words}/border")
        caption(sheet, (0.5 * sheet.paper.width, room[0] + 5.0 * factor), words)


def _lines(tiles: HullTiles) -> tuple[FloatArray, FloatArray]:
    """Give sections and waterlines of the surface: pieces (s, 2, 3), and normals (s, 3)."""
    found = []
    for axis, count in ((0, _STATIONS), (2, _WATERLINES)):
        values = tiles.grid[..., axis]
        places = np.linspace(values.min(), values.max(), count + 2)[1:-1]
        found += [tiles.contour(values, place) for place in places.tolist()]
    pieces = np.concatenate([piece[..., :3] for piece, _ in found])
    return pieces, np.concatenate([normal for _, normal in found])


def _borders(surface: SplineSurface) -> list[FloatArray]:
    """Give the sides of a surface, (n, 3), m."""
    (u0, u1), (v0, v1) = surface.domain
    u, v = np.linspace(u0, u1, _LOOKS), np.linspace(v0, v1, _LOOKS)
    return [surface.at(u, v0), surface.at(u, v1), surface.at(u0, v), surface.at(u1, v)]


def _turned(toward: FloatArray) -> FloatArray:
    """Give the axes of a picture: to the right, upward, toward the eye."""
    toward = toward / np.sqrt(toward @ toward)
    right = np.cross([0.0, 0.0, 1.0], toward)
    right /= np.sqrt(right @ right)
    return np.array([right, np.cross(toward, right), toward])


def _lit(normal: FloatArray, side: float) -> FloatArray:
    """Give the colours (k, 3) of tiles by their normals in the axes of the picture.

    `side` is 1 where the port side looks to the right, -1 where to the left.
    """
    light = np.array([side, 1.0, 1.0]) * _LIGHT / np.sqrt(np.dot(_LIGHT, _LIGHT))
    bright = np.clip(normal @ light, 0.0, 1.0)
    half = light + np.array([0.0, 0.0, 1.0])
    shine = np.clip(normal @ (half / np.sqrt(half @ half)), 0.0, 1.0) ** 24
    colour = (_DARK + (1.0 - _DARK) * bright)[:, None] * _TINT * 1.15
    return np.asarray(np.clip(colour + _SHINE * shine[:, None], 0.0, 1.0))


def _strokes(sheet: Sheet, pieces: FloatArray, pen: Pen) -> None:
    """Draw pieces of line (s, 2, 2), mm."""
    from matplotlib.collections import LineCollection

    sheet.axes.add_collection(
        LineCollection(
            list(pieces), colors=pen.colour, linewidths=pen.width * sheet.paper.factor / POINT,
            zorder=pen.over, rasterized=True,
        ),
        autolim=False,
    )  # fmt: skip
