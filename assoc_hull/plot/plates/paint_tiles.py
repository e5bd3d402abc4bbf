"""The surface of a hull in small tiles, and how tiles of plates and hulls are painted.

Convex regions are red with a plus, developable ones green with a nought, saddles blue with a
minus; what is unresolved is hatched. Tiles of a hull are so many that they are kept as dots also
in PDF and SVG; words, seams and frames stay lines.

The surface of a hull in small tiles, for pictures: places, girth, normals, curvature.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.bezier_patches import Patches
>>> from assoc_hull.plot.plates.paint_tiles import hull_tiles
>>> x, z = np.mgrid[0:30:4j, 0:3:4j]
>>> tiles = hull_tiles(Patches.single(np.stack([x, 1.0 + 0.0 * x, z], axis=-1)), aim=4)
>>> tiles.corner.shape, tiles.contour(tiles.grid[..., 0], 7.5)[0].shape
((4, 4, 4), (4, 2, 4))
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, cast

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.tensor_bernstein import bernstein_basis
from assoc_hull.geometry.patches.bezier_patches import Patches, curvatures
from assoc_hull.plot.plates.plate_layout import PlatePlacement
from assoc_hull.plot.plates.plate_picture import PlateShape
from assoc_hull.plot.sheet.labels import resample
from assoc_hull.plot.sheet.paper import POINT, Pen, View
from assoc_hull.plot.sheet.sheet_figure import Sheet
from assoc_hull.surface.plating.hull_shell import girth_of

__all__ = [
    "AIM",
    "BORDER",
    "CONTESTED",
    "LEVEL",
    "MARGIN_TINT",
    "SIGNS",
    "TINTS",
    "HullTiles",
    "colours",
    "draw_signs",
    "fill_outline",
    "hatch_in_view",
    "hatch_outline",
    "hull_tiles",
    "paint_in_view",
    "paint_plate",
    "paint_quads",
    "segments_in_view",
]

AIM = 24_000
"""So many tiles are seen as a smooth surface."""

_LEAST, _MOST_TILES = 2, 12


@attrs.frozen(eq=False)
class HullTiles:
    """Tiles of half a hull: each of k patches is cut in n by n.

    Attributes
    ----------
    grid : (k, n + 1, n + 1, 4), m
        x, y, z and girth of their corners.
    normal : (k, n + 1, n + 1, 3)
        Unit normals, out of the hull.
    gauss : (k, n + 1, n + 1), 1/m2
        Gaussian curvature; nil where there is no normal.
    """

    grid: FloatArray
    normal: FloatArray
    gauss: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.grid, self.normal, self.gauss)

    @property
    def corner(self) -> FloatArray:
        """The corners of each tile in turn, (t, 4, 4), m."""
        return _corners(self.grid)

    @property
    def patch(self) -> IntArray:
        """The patch of each tile, (t,)."""
        k, n = self.grid.shape[:2]
        return np.repeat(np.arange(k), (n - 1) ** 2)

    @property
    def facing(self) -> FloatArray:
        """The mean normal of each tile, (t, 3)."""
        return np.asarray(_corners(self.normal).mean(axis=1))

    @property
    def middle_gauss(self) -> FloatArray:
        """The mean curvature of the corners of each tile, (t,) 1/m2."""
        return np.asarray(_corners(self.gauss[..., None]).mean(axis=(1, 2)))

    def contour(self, values: FloatArray, level: float) -> tuple[FloatArray, FloatArray]:
        """Give where values at the corners of tiles have a level.

        Parameters
        ----------
        values : (k, n + 1, n + 1)
            The values; linear on both halves of a tile.
        level : float
            The level.

        Returns
        -------
        (s, 2, 4), m, and (s, 3)
            Pieces of line, and the normals of their tiles.
        """
        place, off = self.corner, _corners(values[..., None])[..., 0] - level
        halves = [(0, 1, 2), (0, 2, 3)]
        found = [_crossed(place[:, half], off[:, half]) for half in halves]
        pieces = np.concatenate([piece for piece, _ in found])
        return pieces, np.concatenate([self.facing[rows] for _, rows in found])


def _corners(grid: FloatArray) -> FloatArray:
    """Give the four corners of each tile in turn, (t, 4, ...)."""
    parts = grid[:, :-1, :-1], grid[:, 1:, :-1], grid[:, 1:, 1:], grid[:, :-1, 1:]
    return np.stack(parts, axis=3).reshape(-1, 4, grid.shape[-1])


def _crossed(place: FloatArray, off: FloatArray) -> tuple[FloatArray, IntArray]:
    """Give where triangles (t, 3, d) are crossed by the zero of a linear function, and which."""
    above = off > 0.0
    count = above.sum(axis=1)
    rows = np.flatnonzero((count == 1) | (count == 2))
    alone = np.where(count[rows] == 1, above[rows].argmax(axis=1), above[rows].argmin(axis=1))
    ends = []
    for step in (1, 2):
        other = (alone + step) % 3
        a, b = off[rows, alone], off[rows, other]
        t = (a / (a - b))[:, None]
        ends.append(place[rows, alone] + t * (place[rows, other] - place[rows, alone]))
    return np.stack(ends, axis=1), rows


def hull_tiles(patches: Patches, aim: int = AIM) -> HullTiles:
    """Cut patches into tiles.

    Parameters
    ----------
    patches : Patches
        Those of half a hull, polynomial.
    aim : int
        About how many tiles there are to be.
    """
    steps = int(np.clip(round((aim / len(patches)) ** 0.5), _LEAST, _MOST_TILES))
    at = np.arange(steps + 1) / steps
    uv = np.stack(np.meshgrid(at, at, indexing="ij"), axis=-1).reshape(-1, 2)
    rows = np.repeat(np.arange(len(patches)), len(uv))
    found = curvatures(patches, rows, np.tile(uv, (len(patches), 1)))
    shape = (len(patches), steps + 1, steps + 1)
    along = bernstein_basis(3, at)
    girth = along @ girth_of(patches).b @ along.T
    place = found.position.reshape(*shape, 3)
    return HullTiles(
        np.concatenate([place, girth[..., None]], axis=-1),
        np.nan_to_num(found.normal).reshape(*shape, 3),
        np.nan_to_num(found.gauss).reshape(shape),
    )


# --------------------------------------------------------------------------------------
# Painting plates onto a sheet: regions in red, green and blue, each with its sign.

TINTS = {1: "#d5604f", 0: "#d3e8b6", -1: "#74a9d8"}
"""Red, green and blue that differ in lightness too."""

SIGNS = {1: "+", 0: "0", -1: "−"}
"""What is written on regions, so that colour alone does not carry what they are."""

BORDER = Pen(0.32, "black", over=2.6)
LEVEL = Pen(0.16, "0.15", over=2.5)
_EDGE = Pen(0.2, "0.2", over=2.4)
_DARKEST = 0.72
_CLEAR, _APART, _MOST = 2.2, 32.0, 5
"""mm at A3: a sign from the border of its region, and from the next one; so many at most."""

_BEHIND = 0.06
"""Of the depth of a plate: a line so far behind a tile is hidden by it."""

_LOWER = 1e-3
"""Of the depth of a plate: ground lies so much lower than what is on it."""

_RINGS = 8
"""More spots than these are a line or an area, which is seen without rings."""

_SEEN = 1.5
"""mm at A3: smaller cells are too small for hatching."""


def colours(tint: IntArray) -> FloatArray:
    """Give the colours (k, 3) of regions."""
    from matplotlib.colors import to_rgb

    palette = np.array([to_rgb(TINTS[sign]) for sign in (-1, 0, 1)])
    return np.asarray(palette[tint + 1])


def fill_outline(
    sheet: Sheet, corner: FloatArray, colour: FloatArray, name: str, *, over: float = 1.5
) -> None:
    """Fill polygons (k, c, 2), mm, with colours (k, 3); no gap is seen between neighbours."""
    from matplotlib.collections import PolyCollection

    if len(corner):
        sheet.axes.add_collection(
            PolyCollection(
                cast("Any", corner), facecolors=colour, edgecolors=colour,
                linewidths=0.12 * sheet.paper.factor / POINT, joinstyle="bevel",
                snap=False, zorder=over, gid=name,
            ),
            autolim=False,
        )  # fmt: skip


def paint_plate(
    sheet: Sheet,
    place: PlatePlacement,
    shape: PlateShape,
    colour: FloatArray,
    name: str,
    *,
    shaded: bool = False,
) -> None:
    """Paint a plate.

    Parameters
    ----------
    sheet : Sheet
        Where to draw.
    place : Place
        Where the plate lies on it, and from where it is seen.
    shape : Shape
        The plate.
    colour : (k, 3)
        Of the tiles.
    name : str
        Begins the ids of what is drawn.
    shaded : bool
        Whether there is light on the plate.
    """
    if shaded:
        bright = _DARKEST + (1.0 - _DARKEST) * place.eye.lit(shape.normal)
        colour = colour * bright[:, None]
    lines = _hiding(place, shape) if shaded else place.on_paper
    order = _order(place, shape)
    fill_outline(sheet, place.on_paper(shape.corner)[order], colour[order], f"{name}/tiles")
    for edge in shape.edges:
        sheet.line(lines(edge), _EDGE, f"{name}/edge")
    for line in shape.lines:
        pen = BORDER if line.parting else LEVEL
        sheet.line(lines(line.points), pen, f"{name}/line/{line.level:g}")
    spots = [line.points for line in shape.lines if len(line.points) == 1]
    spots.append(shape.unresolved.mean(axis=1))
    _unresolved(sheet, place, shape.unresolved, np.concatenate(spots), name)


def _hiding(place: PlatePlacement, shape: PlateShape) -> Callable[[FloatArray], FloatArray]:
    """Give what puts lines on paper with nan where the plate itself lies before them."""
    tile, far = place.on_paper(shape.corner), place.toward(shape.corner).min(axis=1)
    low, high = tile.min(axis=1), tile.max(axis=1)
    edge = np.roll(tile, -1, axis=1) - tile
    depth = np.ptp(far)

    def seen(points: FloatArray) -> FloatArray:
        found, near = place.on_paper(points), place.toward(points)
        before = far[:, None] > near + _BEHIND * depth
        before &= (low[:, None] < found).all(axis=-1) & (high[:, None] > found).all(axis=-1)
        k, p = np.nonzero(before)
        off = found[p, None] - tile[k]
        turn = edge[k, :, 0] * off[..., 1] - edge[k, :, 1] * off[..., 0]
        inside = (turn > 0.0).all(axis=1) | (turn < 0.0).all(axis=1)
        found[p[inside]] = np.nan
        return found

    return seen


def _order(place: PlatePlacement, shape: PlateShape) -> IntArray:
    """Give the tiles from the farthest to the nearest, the ground before what lies on it."""
    near = place.toward(shape.corner)
    if _spread_out(place.on_paper(shape.corner)):
        return np.lexsort((near.max(axis=1), ~shape.under))
    low = near.min(axis=1) - _LOWER * np.ptp(near)
    key = np.where(shape.under, low, near.max(axis=1))
    return np.argsort(key, kind="stable")


def _spread_out(corner: FloatArray) -> bool:
    """Tell whether all tiles show the same side, so that none lies before another."""
    first, second = (corner[:, k + 2] - corner[:, k] for k in (0, 1))
    turn = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    return bool((turn >= 0.0).all() or (turn <= 0.0).all())


def _unresolved(
    sheet: Sheet, place: PlatePlacement, corner: FloatArray, spots: FloatArray, name: str
) -> None:
    """Hatch cells that are unresolved; small ones are made black, few of them get rings."""
    from matplotlib.collections import PolyCollection

    seen = place.on_paper(corner)
    large = np.ptp(seen, axis=1).min(axis=1) > _SEEN * sheet.paper.factor
    if large.any():
        hatch_outline(sheet, seen[large], f"{name}/unresolved")
    if (~large).any():
        sheet.axes.add_collection(
            PolyCollection(cast("Any", seen[~large]), facecolors="0.15", edgecolors="0.15",
                           linewidths=0.4 * sheet.paper.factor / POINT, zorder=2.2,
                           gid=f"{name}/unresolved"),
            autolim=False,
        )  # fmt: skip
    around = place.on_paper(spots)
    _, first = np.unique(np.round(around / 3.0), axis=0, return_index=True)
    if 0 < len(first) <= _RINGS:
        _rings(sheet, around[np.sort(first)], f"{name}/ring")


def hatch_outline(sheet: Sheet, corner: FloatArray, name: str) -> None:
    """Hatch polygons (k, c, 2), or one (c, 2), mm."""
    from matplotlib.collections import PolyCollection

    rings = corner.reshape(-1, *corner.shape[-2:])
    sheet.axes.add_collection(
        PolyCollection(cast("Any", rings), facecolors="white", edgecolors="black", hatch="xxxxxx",
                       linewidths=0.0, zorder=2.2, gid=name),
        autolim=False,
    )  # fmt: skip


def _rings(sheet: Sheet, centre: FloatArray, name: str) -> None:
    from matplotlib.lines import Line2D

    wide = 2.0 * sheet.paper.factor / POINT
    sheet.axes.add_line(
        Line2D(
            centre[:, 0], centre[:, 1], linestyle="", marker="o", markersize=wide, fillstyle="none",
            markeredgecolor="black", markeredgewidth=0.14 / POINT, zorder=4.0, gid=name,
        )
    )  # fmt: skip


def draw_signs(
    sheet: Sheet,
    place: PlatePlacement,
    shape: PlateShape,
    name: str,
    clear: Sequence[FloatArray] = (),
) -> None:
    """Write the sign of each region where it is widest, once or a few times.

    Parameters
    ----------
    sheet : Sheet
        Where to draw.
    place : Place
        Where the plate lies on it.
    shape : Shape
        The plate.
    name : str
        Begins the ids.
    clear : sequence of (n, 2), mm
        Further lines that signs keep clear of.
    """
    factor, tint, under = sheet.paper.factor, shape.tint, shape.under
    corner = place.on_paper(shape.corner)
    middle = corner.mean(axis=1)
    room = _nearest(_borders(place, shape, clear), middle)
    halves = 0.5 * (corner + np.roll(corner, 1, axis=1))
    dense = np.concatenate([corner, halves, middle[:, None]], axis=1)
    for sign in np.unique(tint).tolist():
        own, others = tint == sign, dense[(tint != sign) & ~under].reshape(-1, 2)
        free, beside = room[own], _nearest(others, middle[own])
        # Ground is covered where other tiles are nearer than any border.
        free = np.where(under[own], np.where(beside < free, 0.0, free), np.minimum(free, beside))
        for x, y in _apart(middle[own], free, _CLEAR * factor, _APART * factor):
            sheet.text((x, y), SIGNS[sign], size=1.9, bold=True, colour="0.1",
                       name=f"{name}/sign/{sign}")  # fmt: skip


def _nearest(places: FloatArray, points: FloatArray) -> FloatArray:
    """Give how far points (k, 2) are from the nearest of places; inf if there is none."""
    from scipy.spatial import cKDTree

    if not len(places):
        return np.full(len(points), np.inf)
    return np.array(cKDTree(places).query(points)[0], np.float64)


def _borders(place: PlatePlacement, shape: PlateShape, clear: Sequence[FloatArray]) -> FloatArray:
    """Give close places along all lines and edges of a plate, (k, 2), mm."""
    lines = [line.points for line in shape.lines]
    seen = [place.on_paper(line) for line in (*lines, *shape.edges)]
    return np.concatenate([resample(line, 0.7) for line in (*seen, *clear)])


def _apart(
    places: FloatArray, room: FloatArray, least: float, apart: float
) -> list[tuple[float, float]]:
    """Choose places with most room, some way from one another."""
    chosen: list[tuple[float, float]] = []
    for k in np.argsort(-np.round(room, 2), kind="stable").tolist():
        if room[k] < least or len(chosen) == _MOST:
            break
        x, y = places[k].tolist()
        if all(math.hypot(x - a, y - b) > apart for a, b in chosen):
            chosen.append((x, y))
    return chosen


# --------------------------------------------------------------------------------------
# Painting tiles of a hull onto a sheet: colours, hatching, pieces of line.
#
# Tiles are so many that they are kept as dots also in pictures of lines (PDF, SVG); words, seams
# and frames stay lines.

CONTESTED = "#7a5200"
"""Colour of the hatching of what is contested."""

MARGIN_TINT = "#c9c9c9"
"""Colour of what lies beside borders of blocks."""


def paint_quads(sheet: Sheet, corner: FloatArray, colour: FloatArray, name: str) -> None:
    """Fill tiles (k, 4, 2), mm, with colours (k, 3), in their order."""
    from matplotlib.collections import PolyCollection

    if not len(corner):
        return
    sheet.axes.add_collection(
        PolyCollection(
            cast("Any", corner), facecolors=colour, edgecolors=colour, linewidths=0.15,
            snap=False, zorder=1.5, gid=name, rasterized=True,
        ),
        autolim=False,
    )  # fmt: skip


def paint_in_view(sheet: Sheet, view: View, corner: FloatArray, colour: FloatArray) -> None:
    """Fill tiles (k, 4, 4), m, in a view."""
    flat = view.on_paper(corner.reshape(-1, corner.shape[-1])).reshape(-1, 4, 2)
    paint_quads(sheet, flat, colour, f"{view.name}/tiles")


def hatch_in_view(sheet: Sheet, view: View, corner: FloatArray) -> None:
    """Hatch tiles (k, 4, 4), m, in a view: all as one shape, so that hatching runs through."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    if not len(corner):
        return
    flat = view.on_paper(corner.reshape(-1, corner.shape[-1])).reshape(-1, 4, 2)
    rings = np.concatenate([flat, flat[:, :1]], axis=1).reshape(-1, 2)
    codes = np.tile([Path.MOVETO, *[Path.LINETO] * 3, Path.CLOSEPOLY], len(flat))
    sheet.axes.add_patch(
        PathPatch(
            Path(rings, codes), facecolor="none", edgecolor=CONTESTED, linewidth=0.0,
            hatch="//////", zorder=1.8, gid=f"{view.name}/contested", rasterized=True,
        )
    )  # fmt: skip


def segments_in_view(sheet: Sheet, view: View, piece: FloatArray, pen: Pen) -> None:
    """Draw pieces of line (s, 2, 4), m, in a view."""
    from matplotlib.collections import LineCollection

    if not len(piece):
        return
    flat = view.on_paper(piece.reshape(-1, piece.shape[-1])).reshape(-1, 2, 2)
    sheet.axes.add_collection(
        LineCollection(
            cast("Any", flat), colors=pen.colour, linewidths=pen.width * sheet.paper.factor / POINT,
            capstyle="round", zorder=pen.over, gid=f"{view.name}/lines", rasterized=True,
        ),
        autolim=False,
    )  # fmt: skip
