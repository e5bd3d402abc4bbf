"""What a picture of plates is made of: tiles, lines between regions, edges, facts and notes.

A patch is filled with tiles of one colour each, with the borders of curvature as their edges.
`scene_of` makes the scene of one plate in its parameters and in metres; `picture_of` takes
regions, or plates with class and roll axis, and gives entries with areas and what is to be
said of them.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.tensor_bernstein import bernstein_basis
from assoc_hull.geometry.patches.bernstein_polynomials import sign_change_roots
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.cells import CellKind, SignCells
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.plating.plate import Plate
from assoc_hull.surface.plating.plate_table import PlateTable
from assoc_hull.surface.regions.level_lines import LevelLine, RegionAreas
from assoc_hull.surface.regions.result import RegionResult

__all__ = [
    "REGIONS",
    "STEPS",
    "Chart",
    "CurvatureTiles",
    "PlateEntry",
    "PlateLine",
    "PlatePicture",
    "PlateScene",
    "PlateShape",
    "area_words",
    "grid_tiles",
    "picture_of",
    "points_of",
    "scene_of",
    "shares_of",
    "steps_of",
    "tiles_of",
]

# --------------------------------------------------------------------------------------
# Tiles of one colour each that fill a patch, with the borders of curvature as their edges.
#
# A cell of one sign gives a grid of tiles. In a cell with one arc u = g(v) every line v = constant
# meets the arc at most once, so it is filled by strips on both sides of g: no tile lies across a
# border, however coarse the tiles are.

_LEAST = 8
"""Strips along an arc in the smallest of cells."""

_MOVES = 3
"""How often places on an arc are moved to lie equally far apart."""

_SLIVER = 1e-9
"""Of a cell: what is thinner is left out."""


@attrs.frozen(eq=False)
class CurvatureTiles:
    """Four-sided tiles that fill patches.

    Attributes
    ----------
    patch : (k,) int
        The patch of each.
    uv : (k, 4, 2)
        Corners in parameters of the patch, going round anticlockwise.
    sign : (k,) int
        1 where the polynomial is positive, -1 where it is negative, 0 where it is nil.
    """

    patch: IntArray
    uv: FloatArray
    sign: IntArray

    def __attrs_post_init__(self) -> None:
        freeze(self.patch, self.uv, self.sign)

    def __len__(self) -> int:
        """Count the tiles."""
        return len(self.patch)


def tiles_of(cells: SignCells, steps: int) -> CurvatureTiles:
    """Fill all cells whose sign is known, or changes along one arc; the unresolved stay free.

    Parameters
    ----------
    cells : Cells
        Of any patches.
    steps : int
        About so many tiles lie along a side of a patch.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.curvature_functions import gauss_function
    >>> from assoc_hull.geometry.patches.bezier_patches import Patches
    >>> from assoc_hull.geometry.patches.cell_subdivision import subdivide_patches
    >>> from assoc_hull.plot.plates.plate_picture import tiles_of
    >>> net = np.zeros((3, 3, 3))
    >>> net[..., 0], net[..., 1] = np.mgrid[0:3, 0:3]
    >>> net[1, 1, 2] = 1.0
    >>> tiles = tiles_of(subdivide_patches(gauss_function(Patches.single(net), 0.0)), 8)
    >>> tiles.uv.shape[1:], sorted(set(tiles.sign.tolist()))
    ((4, 2), [-1, 1])
    """
    parts = [*_pure(cells, steps), *_simple(cells, steps)]
    if not parts:
        return CurvatureTiles(np.zeros(0, np.intp), np.zeros((0, 4, 2)), np.zeros(0, np.intp))
    patch, uv, sign = (np.concatenate(each) for each in zip(*parts, strict=True))
    return CurvatureTiles(patch, uv, sign)


_Part = tuple[IntArray, FloatArray, IntArray]


def _groups(cells: SignCells, chosen: NDArray[np.bool_]) -> Iterator[tuple[int, IntArray]]:
    """Give cells level by level: those of one level get equally many tiles."""
    for level in np.unique(cells.level[chosen]).tolist():
        yield level, np.flatnonzero(chosen & (cells.level == level))


def _pure(cells: SignCells, steps: int) -> Iterator[_Part]:
    for level, rows in _groups(cells, cells.kind <= 1):
        count = max(1, -(-steps // 2**level))
        side = np.linspace(0.0, 1.0, count + 1)
        grid = np.broadcast_arrays(side[:, None], side)
        local = np.broadcast_to(np.stack(grid, axis=-1), (len(rows), count + 1, count + 1, 2))
        sign = np.repeat(cells.kind[rows], count * count)
        yield np.repeat(cells.patch[rows], count * count), _placed(cells, rows, local), sign


def _simple(cells: SignCells, steps: int) -> Iterator[_Part]:
    for kind, swapped in ((CellKind.U_SIMPLE, False), (CellKind.V_SIMPLE, True)):
        for level, rows in _groups(cells, cells.kind == kind):
            b = cells.b[cells.row[rows]]
            count = -(-steps // 2**level)
            yield from _strips(cells, rows, np.swapaxes(b, 1, 2) if swapped else b, count, swapped)


def _strips(
    cells: SignCells, rows: IntArray, b: FloatArray, count: int, swapped: bool
) -> Iterator[_Part]:
    """Fill both sides of u = g(v), or swapped of v = g(u)."""
    rising = b[:, -1].sum(axis=-1) > b[:, 0].sum(axis=-1)
    across = np.linspace(0.0, 1.0, count + 1)[None, :, None]
    t, g = _arc(np.where(rising[:, None, None], b, -b), max(_LEAST, count))
    for low, high, side in ((np.zeros_like(g), g, -1), (g, np.ones_like(g), 1)):
        u = low[:, None] + across * (high - low)[:, None]
        local = np.stack(np.broadcast_arrays(u, t[:, None]), axis=-1)
        # Exchanged parameters turn the corners round; all are to go the same way.
        uv = (
            _placed(cells, rows, local[..., ::-1])[:, ::-1]
            if swapped
            else _placed(cells, rows, local)
        )
        each = count * (t.shape[1] - 1)
        sign = np.repeat(np.where(rising, side, -side), each)
        patch = np.repeat(cells.patch[rows], each)
        width = np.repeat((high - low)[:, None], count, axis=1)
        wide = ((width[..., 1:] + width[..., :-1]) > _SLIVER).ravel() & _long(t, count)
        yield patch[wide], uv[wide], sign[wide]


def _long(t: FloatArray, count: int) -> NDArray[np.bool_]:
    """Tell the tiles of strips that are not of no length."""
    return np.repeat((np.diff(t) > _SLIVER)[:, None], count, axis=1).ravel()


def _arc(b: FloatArray, count: int) -> tuple[FloatArray, FloatArray]:
    """Give v from 0 to 1 and g there, (c, count + 3), of polynomials that rise with u.

    Where the arc leaves the cell through u = 0 or 1 stands a place of its own; the others are
    moved so that they lie equally far apart along the arc, which may run along v = constant.
    """
    ends = np.stack([_leaving(b[:, 0]), _leaving(b[:, -1])], axis=-1)
    even = np.broadcast_to(np.linspace(0.0, 1.0, count + 1), (len(b), count + 1))
    t = np.sort(np.concatenate([even, ends], axis=1), axis=1)
    for _ in range(_MOVES):
        t = np.sort(np.concatenate([_apart(t, _heights(b, t), even), ends], axis=1), axis=1)
    return t, _heights(b, t)


def _apart(t: FloatArray, g: FloatArray, even: FloatArray) -> FloatArray:
    """Give places at these shares of the lengths of polylines (t, g), row by row."""
    steps = np.hypot(np.diff(t, axis=1), np.diff(g, axis=1))
    way = np.concatenate([np.zeros((len(t), 1)), np.cumsum(steps, axis=1)], axis=1)
    start = 4.0 * np.arange(len(t))[:, None]  # rows one behind the other: none is longer
    wanted = start + even * way[:, -1:]
    found = np.interp(wanted.ravel(), (start + way).ravel(), t.ravel())
    return np.asarray(found.reshape(even.shape))


def _heights(b: FloatArray, t: FloatArray) -> FloatArray:
    """Give g at places (c, k): 0 where a polynomial is positive all along, 1 where negative."""
    lines = _along(b, t)
    g = np.where(lines[..., 0] >= 0.0, 0.0, 1.0)
    inner = (lines[..., 0] < 0.0) & (lines[..., -1] > 0.0)
    if inner.any():
        g[inner] = sign_change_roots(lines[inner], np.ones(int(inner.sum()), np.bool_))
    return g


def _leaving(edge: FloatArray) -> FloatArray:
    """Give where polynomials (c, n + 1) on an edge change sign; 0 for those that do not."""
    found = np.zeros(len(edge))
    cut = edge[:, 0] * edge[:, -1] < 0.0
    if cut.any():
        found[cut] = sign_change_roots(edge[cut], edge[cut, -1] > 0.0)
    return found


def _along(b: FloatArray, t: FloatArray) -> FloatArray:
    """Restrict polynomials (c, m + 1, n + 1) to lines v = t, (c, k): (c, k, m + 1)."""
    values = bernstein_basis(b.shape[-1] - 1, t.ravel()).reshape(*t.shape, -1)
    return np.asarray(values @ np.swapaxes(b, 1, 2))


def _placed(cells: SignCells, rows: IntArray, local: FloatArray) -> FloatArray:
    """Give the tiles (k, 4, 2) between places (c, p, q, 2) of cells, in parameters of the patch."""
    box = cells.box[rows][:, None, None]
    uv = box[..., 0] + (box[..., 1] - box[..., 0]) * local
    corners = uv[:, :-1, :-1], uv[:, 1:, :-1], uv[:, 1:, 1:], uv[:, :-1, 1:]
    return np.stack(corners, axis=3).reshape(-1, 4, 2)


# --------------------------------------------------------------------------------------
# What is drawn of a plate, in metres: tiles, lines between regions, edges, unresolved cells.

STEPS = 40
"""Tiles along a side of a whole surface, about, where it is the only one of a picture."""

_FEWEST = 4
"""Tiles along a side of a patch at least."""

_ALONG = 64  # points of an edge

Chart = Callable[[FloatArray], FloatArray]
"""From parameters (..., 2) of a surface to where they are drawn, (..., 3), m."""


@attrs.frozen(eq=False)
class PlateScene:
    """A plate as tiles and lines in its parameters.

    Attributes
    ----------
    surface : SplineSurface
        The plate.
    uv : (k, 4, 2)
        Corners of the tiles, going round.
    tint : (k,) int
        1 convex, 0 developable, -1 saddle.
    under : (k,) bool
        Whether other tiles may lie on it.
    unresolved : (m, 4, 2)
        Corners of cells whose sign is not known.
    lines : tuple of Component
        Borders between regions, lines of further levels, spots.
    levels : tuple of float, 1/m2
        Of the lines, those of these levels are borders between regions.
    """

    surface: SplineSurface
    uv: FloatArray
    tint: IntArray
    under: NDArray[np.bool_]
    unresolved: FloatArray
    lines: tuple[LevelLine, ...]
    levels: tuple[float, ...]

    def __attrs_post_init__(self) -> None:
        freeze(self.uv, self.tint, self.under, self.unresolved)

    @property
    def edges(self) -> tuple[FloatArray, ...]:
        """The four sides of the surface, (n, 2) each."""
        (u0, u1), (v0, v1) = self.surface.domain
        along = np.linspace(0.0, 1.0, _ALONG)
        u, v = u0 + (u1 - u0) * along, v0 + (v1 - v0) * along
        sides = ((u, v0), (u1, v), (u[::-1], v1), (u0, v[::-1]))
        return tuple(np.stack(np.broadcast_arrays(*side), axis=-1) for side in sides)

    def drawn(self, chart: Chart | None = None) -> PlateShape:
        """Give it in space, or on another chart."""
        at = chart or (lambda uv: points_of(self.surface, uv))
        return PlateShape(
            at(self.uv), self.tint, self.under, at(self.unresolved),
            tuple(PlateLine(each.level, each.level in self.levels, at(uv))
                  for each in self.lines for uv in each.uv),
            tuple(at(edge) for edge in self.edges),
        )  # fmt: skip


@attrs.frozen(eq=False)
class PlateLine:
    """A line K = level, or a spot of one point.

    Attributes
    ----------
    level : float, 1/m2
        The curvature.
    parting : bool
        Whether it parts regions.
    points : (n, 3), m
        Where it is drawn.
    """

    level: float
    parting: bool
    points: FloatArray


@attrs.frozen(eq=False)
class PlateShape:
    """A scene in space: points, m, where the scene has parameters.

    Attributes
    ----------
    corner : (k, 4, 3), m
        Of the tiles.
    tint, under : (k,)
        As of the scene.
    unresolved : (m, 4, 3), m
        Cells whose sign is not known.
    lines : tuple of Line
        Lines of constant curvature.
    edges : tuple of (n, 3), m
        Sides of the plate.
    """

    corner: FloatArray
    tint: IntArray
    under: NDArray[np.bool_]
    unresolved: FloatArray
    lines: tuple[PlateLine, ...]
    edges: tuple[FloatArray, ...]

    @property
    def normal(self) -> FloatArray:
        """The normals of the tiles, as long as their areas, (k, 3), m2."""
        first, second = (self.corner[:, k + 2] - self.corner[:, k] for k in (0, 1))
        return np.asarray(0.5 * np.cross(first, second))


def grid_tiles(count: int, steps: int) -> tuple[IntArray, FloatArray]:
    """Give a grid of tiles on so many patches: the patch (k,), corners (k, 4, 2) in it."""
    side = np.linspace(0.0, 1.0, steps + 1)
    grid = np.stack(np.meshgrid(side, side, indexing="ij"), axis=-1)
    corner = np.stack([grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]], axis=2)
    return np.repeat(np.arange(count), steps * steps), np.tile(
        corner.reshape(-1, 4, 2), (count, 1, 1)
    )


def scene_of(result: RegionResult, number: int, steps: int = STEPS) -> PlateScene:
    """Give what is drawn of one surface of a result.

    Regions are drawn of the cells that were proven to have one sign, and of both sides of the
    arcs in the others: their borders are those of the result, not of a grid. About so many
    tiles (`steps`) lie along a side of the surface.
    """
    surface = result.surfaces[number]
    parts = [_tiles(*search, steps) for search in _searches(result, number)]
    uv, tint, under, unresolved = (np.concatenate(each) for each in zip(*parts, strict=True))
    lines = tuple(each for each in result.components if each.surface == number)
    return PlateScene(surface, uv, tint, under, unresolved, lines, result.band.levels)


def _tiles(
    patches: Patches, cells: SignCells, side: int, steps: int
) -> tuple[FloatArray, IntArray, NDArray[np.bool_], FloatArray]:
    """Give tiles of one search: corners on the surface, tints, which lie below; unresolved cells.

    Above the band (side 1) they lie on ground that is developable all over.
    """
    each = steps_of(patches, steps)
    tiles = tiles_of(cells, each)
    shown = (tiles.sign == side) | (side == 0)
    uv, tint = _on_surface(patches, tiles.patch, tiles.uv)[shown], tiles.sign[shown]
    under = np.zeros(len(uv), np.bool_)
    if side > 0:
        base = _on_surface(patches, *grid_tiles(len(patches), each))
        uv = np.concatenate([base, uv])
        tint, under = (
            np.concatenate([np.full(len(base), first, rest.dtype), rest])
            for first, rest in ((0, tint), (1, under))
        )
    return uv, tint, under, _unresolved(patches, cells)


def points_of(surface: SplineSurface, uv: FloatArray) -> FloatArray:
    """Give points (..., 3), m, at parameters (..., 2), which rounding may put outside."""
    if not uv.size:
        return np.zeros((*uv.shape[:-1], 3))
    (u0, u1), (v0, v1) = surface.domain
    return surface.at(np.clip(uv[..., 0], u0, u1), np.clip(uv[..., 1], v0, v1))


def steps_of(patches: Patches, steps: int) -> int:
    """Give how many tiles lie along a side of a patch, of so many for a whole surface."""
    return max(_FEWEST, round(steps / float(np.sqrt(max(len(patches), 1)))))


def _searches(result: RegionResult, number: int) -> Iterator[tuple[Patches, SignCells, int]]:
    """Give the searches of a surface by level: 1 above the band, -1 below it, 0 without one."""
    for part in result.parts:
        chosen = np.flatnonzero(part.patches.surface == number)
        if not len(chosen):
            continue
        patches = part.patches[chosen]
        for solution in part.solutions:
            if solution.level in result.band.levels:
                yield patches, _of_patches(solution.cells, chosen), int(np.sign(solution.level))


def _of_patches(cells: SignCells, chosen: IntArray) -> SignCells:
    """Keep the cells of some patches, and number these anew."""
    place = np.full(len(cells.stopped), -1)
    place[chosen] = np.arange(len(chosen))
    kept = place[cells.patch] >= 0
    return attrs.evolve(
        cells, patch=place[cells.patch][kept], box=cells.box[kept], level=cells.level[kept],
        kind=cells.kind[kept], row=cells.row[kept], stopped=cells.stopped[chosen],
    )  # fmt: skip


def _on_surface(patches: Patches, patch: IntArray, uv: FloatArray) -> FloatArray:
    """Take corners (k, 4, 2) from parameters of patches (k,) to those of the surface."""
    return patches.parameters(np.repeat(patch, 4), uv.reshape(-1, 2)).reshape(-1, 4, 2)


def _unresolved(patches: Patches, cells: SignCells) -> FloatArray:
    """Give the corners of unresolved cells in parameters of the surface, (m, 4, 2)."""
    rows = np.flatnonzero(cells.kind == CellKind.UNRESOLVED)
    (u0, u1), (v0, v1) = np.moveaxis(cells.box[rows], 0, -1)
    ring = ((u0, v0), (u1, v0), (u1, v1), (u0, v1))
    uv = np.stack([np.stack(corner, axis=-1) for corner in ring], axis=1)
    return _on_surface(patches, cells.patch[rows], uv)


# --------------------------------------------------------------------------------------
# What a picture of plates is made of: from regions, or from plates with class and roll axis.

REGIONS = {1: "convex", 0: "developable", -1: "saddle"}
"""The regions by their sign."""

_ROUNDING = 1e-12
"""m: what control points are off by, if it is no more than this, is rounding."""

_STEPS_OF_MANY = 20
"""Tiles along a side of a plate that is one of several: it is drawn small."""


@attrs.frozen(eq=False)
class PlateEntry:
    """One plate of a picture.

    Attributes
    ----------
    name : str
        Stands above it; may be empty.
    scene : Scene
        What is drawn.
    words : str
        Stands below it.
    axis : (3,) or None
        The direction it is rolled about.
    frame : (3, 3) or None
        Rows: along the plate, across it, its normal; None where it is found from the shape.
    result : RegionResult
        What holds the plate.
    number : int
        Its number there.
    """

    name: str
    scene: PlateScene
    words: str
    axis: FloatArray | None
    frame: FloatArray | None
    result: RegionResult
    number: int


@attrs.frozen(eq=False)
class PlatePicture:
    """All plates of a picture, and what holds for all of them.

    Attributes
    ----------
    entries : tuple of Entry
        The plates.
    areas : RegionAreas
        Of all plates.
    banded : bool
        Whether there is a band about K = 0.
    facts : tuple of (str, str)
        Names and values of the block.
    notes : tuple of str
        Sentences below it.
    """

    entries: tuple[PlateEntry, ...]
    areas: RegionAreas
    banded: bool
    facts: tuple[tuple[str, str], ...]
    notes: tuple[str, ...]


def picture_of(found: RegionResult | PlateTable) -> PlatePicture:
    """Take a result, or plates, apart into what is drawn."""
    count = len(found) if isinstance(found, PlateTable) else len(found.surfaces)
    steps = STEPS if count == 1 else _STEPS_OF_MANY
    if isinstance(found, PlateTable):
        entries = tuple(_of_plate(found, number, steps) for number in range(count))
        results, notes = found.results, found.notes
        axes = any(entry.axis is not None for entry in entries)
        notes = (*(("Dash-dotted: the axis a plate is rolled about.",) if axes else ()), *notes)
    else:
        entries = tuple(_of_surface(found, number, steps) for number in range(count))
        results, notes = (found,), found.notes
    areas = RegionAreas.added(attrs.astuple(each.areas) for each in results)
    facts = tuple(_facts(results, areas, len(entries)))
    return PlatePicture(entries, areas, results[0].k0 > 0.0, facts, notes)


def _of_surface(result: RegionResult, number: int, steps: int) -> PlateEntry:
    name = result.surfaces[number].name or (f"{number + 1}" if len(result.surfaces) > 1 else "")
    words = shares_of(result.of_surface(number))
    return PlateEntry(name, scene_of(result, number, steps), words, None, None, result, number)


def _of_plate(plates: PlateTable, number: int, steps: int) -> PlateEntry:
    plate, result = plates[number], plates.result_of(number)
    scene = scene_of(result, plate.number, steps)
    frame = plate.axes * np.array([[1.0], [-1.0], [-1.0]])  # e2 runs down, e3 away from the eye
    words = _told(plate)
    return PlateEntry(plate.name, scene, words, plate.roll_direction, frame, result, plate.number)


def _told(plate: Plate) -> str:
    """Say of which class a plate is, and how it is rolled."""
    parts = [plate.kind or "unresolved", shares_of(plate.areas)]
    if plate.roll_axis is not None:
        parts.append(f"roll axis {plate.roll_axis:.1f}°")
    return "; ".join(parts)


def area_words(area: float) -> str:
    """Give an area as it is written; a small one is not made nil."""
    return f"{area:.4f} m²" if area == 0.0 or area >= 1e-3 else f"{area:.2e} m²"


def shares_of(areas: RegionAreas) -> str:
    """Give the shares of regions in words; those that are nil are left out."""
    shares = {1: areas.positive_share, 0: areas.zero_share, -1: areas.negative_share}
    words = [f"{REGIONS[sign]} {100.0 * share:.2f} %" for sign, share in shares.items() if share]
    if areas.unresolved:
        words.append(f"unresolved {100.0 * areas.unresolved_share:.1g} %")
    return ", ".join(words)


def _facts(
    results: tuple[RegionResult, ...], areas: RegionAreas, many: int
) -> Iterator[tuple[str, str]]:
    """Give the rows of the block."""
    first, one = results[0], len(results) == 1
    yield ("Area" if many == 1 else f"Area of {many} plates"), area_words(areas.total)
    yield "Error estimate of areas", f"{areas.error_estimate:.1e} m²"
    if first.k0 == 0.0:
        yield "Band", "none: K = 0"
    elif one:
        yield "Band, K0", f"{first.k0:.4g} 1/m²"
    else:
        least, most = (f"{pick(each.k0 for each in results):.3g}" for pick in (min, max))
        yield "Band, K0 of each plate", f"{least} to {most} 1/m²"
    if first.strain_tol is not None and first.breadth is not None:
        own = f"{first.breadth:g} m" if one else "its own"
        yield "K0 = 8 ε/b²", f"ε {first.strain_tol:g}, b {own}"
    delta = max(each.delta for each in results)
    if delta > _ROUNDING:
        yield "Control points known to", f"{delta:.1e} m"
    yield "Lines and spots", _counted([each for result in results for each in result.components])


def _counted(components: list[LevelLine]) -> str:
    """Count lines by their kind."""
    kinds = Counter(each.kind.replace("_", " ") for each in components)
    return ", ".join(f"{count} {kind}" for kind, count in sorted(kinds.items())) or "none"
