"""The curvature map of a hull with its plates, and the sheets that go with it.

The map has the shell expansion, both ends, profile and bottom, with seams and names of plates.
The sheets are one PDF: the map, then the table of plates, then notes.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, TypeVar

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.arguments import instance, text
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.write_file import form_by_ending, write_whole
from assoc_hull.plot.plates.paint_tiles import (
    CONTESTED,
    MARGIN_TINT,
    SIGNS,
    TINTS,
    HullTiles,
    hatch_in_view,
    hull_tiles,
    paint_in_view,
    segments_in_view,
)
from assoc_hull.plot.sheet.labels import wrap_words
from assoc_hull.plot.sheet.paper import LINE, MARGIN, PaperName, Pen, View, scale_of
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, pdf_of, save
from assoc_hull.plot.sheet.title_block import caption, frame, scale_bar, title_block
from assoc_hull.surface.plating.hull_plates import HullPlateTable
from assoc_hull.surface.plating.hull_seams import AXES
from assoc_hull.surface.plating.plate_class import CAVEAT
from assoc_hull.surface.plating.plate_table import HULL_COLUMNS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from assoc_hull.surface.plating.plate import Plate

__all__ = [
    "hull_map",
    "hull_sheet",
    "hull_sheets",
    "map_sheet",
]

# --------------------------------------------------------------------------------------
# The curvature map of a hull with its plates: shell expansion, both ends, profile, bottom.

_BLOCK, _SIDE = 96.0, 14.0
"""Width of the block, and room beside the long views, mm at A3."""

_STRETCH = 2.0
"""Girth is drawn so many times larger than x in the shell expansion."""

_ENDS = 0.22
"""The part of the height of the sheet that is kept for both ends of the hull."""

_SEAM = Pen(0.28, "0.1", over=2.8)
_LEVEL = Pen(0.16, "0.25", over=2.5)
_NAMES = 400
"""More plates than these bear no names."""

_COLUMN = {"x": 0, "z": 2, "girth": 3}


def hull_map(
    found: HullPlateTable,
    path: Path_ | None = None,
    *,
    title: str = "Curvature of the shell",
    paper: PaperName = "A3",
) -> Figure:
    """Draw the regions of Gaussian curvature of a hull, and its plates.

    Convex regions are red, developable ones green, saddles blue, by the K0 of the whole hull;
    hatched where |K| lies within a factor of 2 of K0, grey beside borders of blocks, where
    curvature is not settled. The shell expansion has x to the right and girth upward; below it lie
    profile and bottom, above both ends of the hull. A plate whose class is in doubt has a question
    mark.

    Parameters
    ----------
    found : HullPlates
        Of `plates` with `HullSeams`.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    title : str
        Stands over the block.
    paper : "A3", "A1" or "A4"
        Size of the sheet, landscape.

    Returns
    -------
    matplotlib.figure.Figure
        The picture; what belongs to a view has the id ``view/...``.

    Raises
    ------
    BadInputError, WrongTypeError
        No plates of a hull, an unknown paper or ending.
    MissingExtraError
        Matplotlib is not installed.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
    >>> from assoc_hull.plot.plates.hull_map import hull_map
    >>> from assoc_hull.surface.plating.hull_plates import hull_plates
    >>> from assoc_hull.surface.plating.hull_seams import HullSeams
    >>> x, z = np.mgrid[0:30:2j, 0:9:2j]
    >>> side = SplineSurface.bezier(np.stack([x, 8.0 + 0.5 * z, z], axis=-1), "body")
    >>> figure = hull_map(hull_plates((side,), HullSeams(x=12.0)))
    """
    instance(found, HullPlateTable, "found", "in hull_map")
    sheet = map_sheet(found, text(title, "title", "in hull_map"), paper)
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def map_sheet(found: HullPlateTable, title: str, paper: PaperName) -> Sheet:
    """Draw the map as a page."""
    sheet = Sheet(paper)
    scene = _Scene.of(found)
    frame(sheet, MARGIN * sheet.paper.factor)
    low = _legend(sheet, _block(sheet, found, title))
    _body(sheet, scene, _long_views(sheet, scene), low)
    return sheet


@attrs.frozen(eq=False)
class _Scene:
    """What is drawn: tiles with their colours, which are contested, lines."""

    found: HullPlateTable
    tiles: HullTiles
    colour: FloatArray
    contested: NDArray[np.bool_]
    stretch: float = 1.0

    @classmethod
    def of(cls, found: HullPlateTable) -> _Scene:
        """Colour the tiles."""
        from matplotlib.colors import to_rgb

        shell, k0 = found.shell, found.regions.k0
        tiles = hull_tiles(shell.patches)
        gauss = tiles.middle_gauss
        region = np.where(np.abs(gauss) > k0, np.sign(gauss), 0.0).astype(np.intp)
        palette = np.array([to_rgb(TINTS[sign]) for sign in (-1, 0, 1)])
        margin = shell.margin[tiles.patch]
        colour = np.where(margin[:, None], to_rgb(MARGIN_TINT), palette[region + 1])
        near = (np.abs(gauss) >= 0.5 * k0) & (np.abs(gauss) <= 2.0 * k0) & ~margin
        return cls(found, tiles, colour, near)

    def draw(self, sheet: Sheet, view: View, shown: NDArray[np.bool_], toward: FloatArray) -> None:
        """Draw the tiles that face the eye, nearer ones over others, with lines and names."""
        near = self.tiles.corner[..., :3].mean(axis=1) @ toward
        rows = np.flatnonzero(shown)
        rows = rows[np.argsort(near[rows], kind="stable")]
        corner = self.tiles.corner
        paint_in_view(sheet, view, corner[rows], self.colour[rows])
        rows = np.flatnonzero(shown & self.contested)
        hatch_in_view(sheet, view, corner[rows])
        for level in (self.found.regions.k0, -self.found.regions.k0):
            self._line(sheet, view, toward, self.tiles.gauss, level, _LEVEL)
        for axis in AXES:
            for place in getattr(self.found.seams, axis):
                values = self.tiles.grid[..., _COLUMN[axis]]
                larger = self.stretch if axis == "girth" else 1.0
                self._line(sheet, view, toward, values, larger * place, _SEAM)

    def _line(
        self, sheet: Sheet, view: View, toward: FloatArray, values: FloatArray, level: float,
        pen: Pen,
    ) -> None:  # fmt: skip
        piece, normal = self.tiles.contour(values, level)
        seen = normal @ toward > -1e-9 if toward.any() else np.ones(len(piece), np.bool_)
        segments_in_view(sheet, view, piece[seen], pen)

    def names(self, sheet: Sheet, view: View) -> None:
        """Write the names of plates in their middles."""
        if len(self.found) > _NAMES or not self.found.seams:
            return
        stretch = np.array([1.0, _STRETCH])
        for plate in self.found:
            if plate.range is None:
                continue
            ends = np.array([plate.range.x, plate.range.girth])
            middle = self._middle(plate.name)
            room = np.where(np.isfinite(ends).all(axis=1), np.ptp(ends, axis=1) * stretch, np.inf)
            sure = plate.kind is not None and not plate.is_doubtful
            words = plate.name if sure else f"{plate.name}?"
            if view.unit * room.min() < 3.0 * sheet.paper.factor:
                continue
            place = view.across(middle[0]), view.up(middle[3] * _STRETCH)
            sheet.text(place, words, size=0.75, halo=True, name=f"label/plate/{plate.name}")

    def _middle(self, name: str) -> FloatArray:
        """Give the middle of a plate: x, y, z and girth, m."""
        plate = self.found[name]
        weight, place = plate.nodes.area, plate.nodes.place
        middle = (weight[..., None] * place).sum(axis=(0, 1, 2)) / weight.sum()
        whole = self.tiles.grid.reshape(-1, 4)
        nearest = ((whole[:, :3] - middle) ** 2).sum(axis=1).argmin()
        return np.asarray(whole[nearest])


def _long_views(sheet: Sheet, scene: _Scene) -> float:
    """Draw bottom, profile and shell expansion; give the height they reach, mm."""
    paper, tiles = sheet.paper, scene.tiles
    factor = paper.factor
    low, high = (end(tiles.grid, axis=(0, 1, 2)) for end in (np.min, np.max))
    width = paper.width - 2.0 * (MARGIN + _SIDE) * factor
    room = paper.height - (2.0 * MARGIN + 42.0) * factor - _ENDS * paper.height
    tall = float(high[1] + high[2] - low[2] + _STRETCH * high[3])
    scale = max(scale_of(float(high[0] - low[0]), width), scale_of(tall, room))
    unit = 1e3 / scale
    across = 0.5 * (paper.width - unit * (high[0] - low[0])) - unit * low[0]
    foot = (MARGIN + 14.0) * factor
    bottom = View("bottom", (0, 1), scale, (across, foot))
    deep = bottom.up(float(high[1])) + 11.0 * factor
    profile = View("profile", (0, 2), scale, (across, deep - unit * low[2]))
    middle = bottom.across(0.5 * float(low[0] + high[0]))
    wide = profile.up(float(high[2])) + 11.0 * factor
    expansion = View("expansion", (0, 3), scale, (across, wide))
    stretched = attrs.evolve(scene, tiles=_stretched(tiles), stretch=_STRETCH)
    facing = tiles.facing
    scene.draw(sheet, bottom, facing[:, 2] <= 1e-9, np.array([0.0, 0.0, -1.0]))
    scene.draw(sheet, profile, facing[:, 1] >= -1e-9, np.array([0.0, 1.0, 0.0]))
    stretched.draw(sheet, expansion, np.ones(len(facing), np.bool_), np.zeros(3))
    scene.names(sheet, expansion)
    for place, words in (
        (foot - 3.0 * factor, "BOTTOM, FROM BELOW"),
        (deep - 3.0 * factor, "PROFILE"),
        (wide - 3.0 * factor, f"SHELL EXPANSION, GIRTH × {_STRETCH:g}"),
    ):
        caption(sheet, (middle, place), words)
    at = (bottom.across(float(low[0])), foot - 8.0 * factor)
    scale_bar(sheet, bottom, at, 60.0 * factor, f"1:{scale:g}")
    return expansion.up(float(high[3]) * _STRETCH) + 4.0 * factor


def _stretched(tiles: HullTiles) -> HullTiles:
    """Give tiles with their girth drawn larger."""
    return attrs.evolve(tiles, grid=tiles.grid * np.array([1.0, 1.0, 1.0, _STRETCH]))


def _body(sheet: Sheet, scene: _Scene, low: float, block: float) -> None:
    """Draw both ends of the hull, aft body left, left of the block."""
    paper, grid = sheet.paper, scene.tiles.grid
    factor = paper.factor
    half = float(grid[..., 1].max())
    bottom, top = float(grid[..., 2].min()), float(grid[..., 2].max())
    left, right = (MARGIN + 6.0) * factor, paper.width - (MARGIN + _BLOCK + 6.0) * factor
    room = paper.height - (MARGIN + 3.0) * factor - low - 8.0 * factor
    scale = max(scale_of(2.1 * half, right - left), scale_of(top - bottom, room))
    middle = 0.5 * (left + right)
    unit = 1e3 / scale
    up = low + 7.0 * factor - unit * bottom
    gap = 2.0 * factor
    facing = scene.tiles.facing[:, 0]
    ahead = scene.tiles.corner[:, :, 0].mean(axis=1) >= 0.5 * float(
        grid[..., 0].min() + grid[..., 0].max()
    )
    for sign, name in ((1.0, "fore"), (-1.0, "aft")):
        view = View(name, (1, 2), scale, (middle + sign * gap, up), sign)
        shown = (ahead == (sign > 0.0)) & (sign * facing >= -1e-9)
        scene.draw(sheet, view, shown, np.array([sign, 0.0, 0.0]))
    caption(sheet, (middle, low + 4.0 * factor), f"AFT BODY, FORE BODY  1:{scale:g}")


def _block(sheet: Sheet, found: HullPlateTable, title: str) -> float:
    """Write what holds for all plates into the right upper corner; give the lower edge, mm."""
    paper = sheet.paper
    kinds = Counter(
        (plate.kind or "unresolved") + (", in doubt" if plate.is_doubtful else "")
        for plate in found
    )
    rows = [
        ("Plates", str(len(found))),
        ("Area of half the hull", f"{found.area:.1f} m2"),
        *((f"  {kind}", str(count)) for kind, count in sorted(kinds.items())),
        ("K0", f"{found.regions.k0:.4g} 1/m2"),
        ("Other fits compared", str(found.fits)),
        ("Bezier patches", str(found.regions.count)),
    ]
    notes = (
        "x forward from AP, girth from the lowest point of a section, m.",
        "A question mark: the class is in doubt, or none is given.",
    )
    corner = (paper.width - MARGIN * paper.factor, paper.height - MARGIN * paper.factor)
    return title_block(sheet, corner, _BLOCK * paper.factor, title, rows, notes)


def _legend(sheet: Sheet, top: float) -> float:
    """Explain the colours below the block; give the lower edge, mm."""
    factor = sheet.paper.factor
    left = sheet.paper.width - (MARGIN + _BLOCK - 3.0) * factor
    words = {
        1: (TINTS[1], f"convex, K > K0  ({SIGNS[1]})"),
        0: (TINTS[0], "developable, |K| ≤ K0  (0)"),
        -1: (TINTS[-1], f"saddle, K < −K0  ({SIGNS[-1]})"),
        2: (MARGIN_TINT, "beside a border of blocks: unresolved"),
        3: ("white", "contested, K0/2 ≤ |K| ≤ 2 K0"),
    }
    y = top - 4.0 * factor
    for key, (colour, told) in words.items():
        right, low, high = left + 7.0 * factor, y - 1.5 * factor, y + 1.5 * factor
        ring = np.array([(left, low), (right, low), (right, high), (left, high)])
        sheet.axes.fill(
            ring[:, 0], ring[:, 1], facecolor=colour, edgecolor=CONTESTED, linewidth=0.0,
            hatch="//////" if key == 3 else None, zorder=1.5, gid=f"legend/{key}",
        )  # fmt: skip
        sheet.line(np.concatenate([ring, ring[:1]]), LINE, "legend")
        sheet.text((left + 9.0 * factor, y), told, size=1.1, across="left", name="label/legend")
        y -= 4.4 * factor
    return y


# --------------------------------------------------------------------------------------
# Plates of a hull on sheets: the map, then the table, then notes; one PDF.

_ROWS, _STEP = 62, 3.9
"""Plates on a page, and the height of a row, mm at A3."""

_LINES = 64
"""Of notes on a page."""

Item = TypeVar("Item")


def hull_sheet(
    found: HullPlateTable,
    path: Path_,
    *,
    title: str = "Curvature of the shell",
    paper: PaperName = "A3",
) -> None:
    """Write plates of a hull as a PDF: the map, the table with advice, notes.

    Parameters
    ----------
    found : HullPlates
        Of `plates` with `HullSeams`.
    path : path
        A ``.pdf`` file; what was there is replaced by the whole of it, or stays.
    title : str
        Stands on every page.
    paper : "A3", "A1" or "A4"
        Size of the sheets, landscape.

    Raises
    ------
    BadInputError, WrongTypeError
        No plates of a hull, another ending, a file that cannot be written.
    MissingExtraError
        Matplotlib is not installed.
    """
    where = "in hull_sheet"
    instance(found, HullPlateTable, "found", where)
    named = text(title, "title", where)
    form_by_ending(path, None, ("pdf",), {".pdf": "pdf"}, where)
    write_whole(path, pdf_of(hull_sheets(found, named, paper), named))


def hull_sheets(found: HullPlateTable, title: str, paper: PaperName = "A3") -> list[Sheet]:
    """Draw the map, and write the table with advice and the notes, as pages."""
    notes = _wrapped((*found.notes, CAVEAT), paper)
    return [
        map_sheet(found, title, paper),
        *(_table(rows, title, paper) for rows in _parts(found.rows, _ROWS)),
        *(_notes(lines, title, paper) for lines in _parts(notes, _LINES)),
    ]


def _parts(items: Sequence[Item], size: int) -> Iterator[Sequence[Item]]:
    for first in range(0, len(items), size):
        yield items[first : first + size]


def _page(title: str, paper: PaperName) -> tuple[Sheet, float]:
    """Begin a page; give the height below its title, mm."""
    sheet = Sheet(paper)
    factor = sheet.paper.factor
    frame(sheet, MARGIN * factor)
    top = sheet.paper.height - (MARGIN + 8.0) * factor
    left = (MARGIN + 5.0) * factor
    sheet.text((left, top), title, size=2.2, bold=True, across="left", name="label/title")
    return sheet, top - 9.0 * factor


def _table(rows: Sequence[Plate], title: str, paper: PaperName) -> Sheet:
    """Write some rows of the table."""
    sheet, top = _page(title, paper)
    factor = sheet.paper.factor
    x = (MARGIN + 5.0) * factor
    advice = ("advice", "", [plate.suggestion.partition(":")[0] for plate in rows])
    seen = [
        (each.head, each.unit, [each.printed(plate) for plate in rows])
        for each in HULL_COLUMNS
        if each.head
    ]
    for number, (head, unit, body) in enumerate([*seen, advice]):
        wide = max(sheet.width(words) for words in (head, unit, *body))
        first = number in (0, len(seen))
        place = x if first else x + wide
        for row, words in enumerate((head, unit, *body)):
            y = top - (row + (0.4 if row > 1 else 0.0)) * _STEP * factor
            if words:
                sheet.text((place, y), words, across="left" if first else "right", bold=row == 0,
                           name=f"table/{head}")  # fmt: skip
        x += wide + 4.0 * factor
    rule = top - 1.7 * _STEP * factor
    sheet.rule((MARGIN * factor, rule), (sheet.paper.width - MARGIN * factor, rule), LINE, "table")
    return sheet


def _wrapped(words: Sequence[str], paper: PaperName) -> list[str]:
    """Break notes into lines of a page."""
    sheet = Sheet(paper)
    room = sheet.paper.width - 2.0 * (MARGIN + 5.0) * sheet.paper.factor
    return [line for each in words for line in wrap_words(sheet, each, room, 1.15)]


def _notes(lines: Sequence[str], title: str, paper: PaperName) -> Sheet:
    """Write lines of notes."""
    sheet, top = _page(title, paper)
    factor = sheet.paper.factor
    for number, line in enumerate(lines):
        place = ((MARGIN + 5.0) * factor, top - number * _STEP * factor)
        sheet.text(place, line, size=1.15, across="left", name="label/note")
    return sheet
