"""A block laid out on its rectangle, with its bays beside it: parameters for every node.

Inner nodes lie at the weighted mean of their neighbours (Tutte 1963), so nothing folds.
Parameters are rounded to about a centimetre, so far from an edit they stay the same to the bit.
Along a border that follows another block they are those of that block, in proportion.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.surface.blocks.block_plan import BlockPlan
from assoc_hull.surface.blocks.cell_regions import SIDES, CellRegion, Quad

__all__ = [
    "GRID",
    "BlockMap",
    "LaidQuad",
    "block_map",
    "edge_weights",
    "harmonic_map",
]

# W. T. Tutte, How to draw a graph, Proceedings of the London Mathematical Society 13, 1963: with
# positive weights and a convex border nothing folds.

_LEAST = 1e-3
"""Of the mean weight: no edge counts for less."""


def edge_weights(region: CellRegion) -> FloatArray:
    """Give the weights of all edges for what a region holds, (e,); zero outside it.

    The weight of an edge is the width of the strips on both sides of it over its length: that of
    finite volumes, so that a net of any density is laid out as the smooth (harmonic) map would be.
    Weights are rounded to powers of two: a line that moves a little changes none.

    Parameters
    ----------
    region : CellRegion
        The part of the net.
    """
    graph, cells = region.graph, region.cells
    edge = cells.half >> 1
    area = _areas(region)
    owner = np.repeat(np.arange(cells.count), cells.sides)
    length = np.maximum(graph.length, 1e-9)
    share = 0.5 * area[owner] / (length[edge] * length[edge]) * (4.0 / cells.sides[owner])
    found = np.zeros(len(graph.edge))
    np.add.at(found, edge, np.where(region.inside[owner], share, 0.0))
    used = found > 0.0
    middle = float(np.exp2(np.round(np.log2(np.median(found[used]))))) if used.any() else 1.0
    even = np.exp2(np.round(np.log2(np.clip(found, _LEAST * middle, middle / _LEAST))))
    return np.where(region.edges, even, 0.0)


def _areas(region: CellRegion) -> FloatArray:
    """Give the area of each cell, as that of the polygon of its nodes, (c,), m2."""
    cells, graph = region.cells, region.graph
    node = graph.edge.ravel()[cells.half]
    after = graph.edge.ravel()[cells.half ^ 1]
    owner = np.repeat(np.arange(cells.count), cells.sides)
    origin = graph.place[node[cells.start[:-1]]][owner]
    twice = np.cross(graph.place[node] - origin, graph.place[after] - origin)
    total = np.zeros((cells.count, 3))
    np.add.at(total, owner, twice)
    return np.asarray(0.5 * np.sqrt(dot(total, total)))


def harmonic_map(region: CellRegion, uv: FloatArray) -> FloatArray:
    """Give all nodes of a region parameters, (n, 2), m; nan outside it.

    `uv` (n, 2), m, is where given nodes lie, those of the border among them; nan elsewhere.
    """
    from scipy.sparse import csc_matrix  # costs a start of the program
    from scipy.sparse.linalg import splu

    graph = region.graph
    own = np.flatnonzero(region.edges)
    pair = graph.edge[own]
    weight = edge_weights(region)[own]
    nodes = np.unique(pair)
    given = np.isfinite(uv[nodes, 0])
    number = np.full(len(graph.place), -1, np.int64)
    free = nodes[~given]
    number[free] = np.arange(len(free))
    found = np.full_like(uv, np.nan)
    found[nodes[given]] = uv[nodes[given]]
    if not len(free):
        return found
    row, column, value, right = _equations(pair, weight, number, np.nan_to_num(uv))
    matrix = csc_matrix((value, (row, column)), shape=(len(free), len(free)))
    found[free] = splu(matrix).solve(right)
    return found


def _equations(
    pair: IntArray, weight: FloatArray, number: IntArray, uv: FloatArray
) -> tuple[IntArray, IntArray, FloatArray, FloatArray]:
    """Give the entries of the matrix of free nodes, and the right sides."""
    both = np.concatenate([pair, pair[:, ::-1]])
    weight = np.concatenate([weight, weight])
    here, there = number[both[:, 0]], number[both[:, 1]]
    mine = here >= 0
    inner = mine & (there >= 0)
    count = int(number.max(initial=-1)) + 1
    right = np.zeros((count, 2))
    fixed = mine & (there < 0)
    np.add.at(right, here[fixed], weight[fixed, None] * uv[both[fixed, 1]])
    row = np.concatenate([here[mine], here[inner]])
    column = np.concatenate([here[mine], there[inner]])
    return row, column, np.concatenate([weight[mine], -weight[inner]]), right


# --------------------------------------------------------------------------------------
# The block and its bays.

_GIRTH = 40
"""Parts of a girth at which the distance of neighbouring sections is taken."""

GRID, _COARSE = 2.0**-15, 2.0**-11
"""Parts of the ship's length to which nodes and the sides of rectangles are rounded; the fit
corrects parameters of nodes anyway."""

_TOUCHING = {"u0": "u1", "u1": "u0", "v0": "v1", "v1": "v0"}


@attrs.frozen(eq=False)
class LaidQuad:
    """A quad on a rectangle.

    Attributes
    ----------
    quad : Quad
        The quad.
    box : (2, 2), m
        Least and greatest u, least and greatest v.
    uv : (n, 2), m
        Where its nodes lie; nan for all others.
    """

    quad: Quad
    box: FloatArray
    uv: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.box, self.uv)


@attrs.frozen(eq=False)
class BlockMap:
    """A block and its bays.

    Attributes
    ----------
    plan : BlockPlan
        What is laid out.
    core : LaidQuad
        The block.
    bays : dict of str to LaidQuad
        The bays, by the side or corner they lie beyond.
    """

    plan: BlockPlan
    core: LaidQuad
    bays: dict[str, LaidQuad]

    @property
    def reach(self) -> FloatArray:
        """The rectangle that holds the block and its bays, (2, 2), m."""
        boxes = np.stack([self.core.box, *(bay.box for bay in self.bays.values())])
        return np.stack([boxes[:, :, 0].min(axis=0), boxes[:, :, 1].max(axis=0)], axis=1)


@attrs.frozen(eq=False)
class _Sheet:
    """What is laid out so far: parameters of nodes, nan where there are none yet, (n, 2), m."""

    uv: FloatArray
    grid: float

    def rounded(self, value: FloatArray) -> FloatArray:
        return np.asarray(np.round(value / self.grid) * self.grid)


def block_map(plan: BlockPlan, length: float, masters: Mapping[str, BlockMap]) -> BlockMap:
    """Lay a block and its bays out; `masters` are the blocks it follows, laid out, by their names.

    `length`, m, is that of the ship.
    """
    count = len(plan.core.region.graph.place)
    sheet = _Sheet(np.full((count, 2), np.nan), GRID * length)
    box = _railed(plan, sheet, masters) if plan.rails else _box(plan.core, sheet)
    for seam in plan.seams:
        _follow(plan.core, seam.side, masters[seam.master].core, box, sheet)
    core = _laid(plan.core, box, sheet)
    if plan.rails:
        core = _paced(core, plan, sheet)
    bays = dict[str, LaidQuad]()
    for name in sorted(plan.bays, key=len):
        if " " not in name:
            bays[name] = _laid(plan.bays[name], _beside(core, name, plan.bays[name], sheet), sheet)
        elif all(part in bays for part in name.split()):
            across, along = (bays[part] for part in name.split())
            corner = np.stack([across.box[0], along.box[1]])
            bays[name] = _laid(plan.bays[name], corner, sheet)
    return BlockMap(plan, core, bays)


def _box(quad: Quad, sheet: _Sheet) -> FloatArray:
    """Give the rectangle of a quad: the mean lengths of opposite sides, roughly."""
    coarse = sheet.grid * (_COARSE / GRID)
    size = [max(round(each / coarse), 1) * coarse for each in quad.extent()]
    return np.array([[0.0, size[0]], [0.0, size[1]]])


def _follow(quad: Quad, side: str, master: LaidQuad, box: FloatArray, sheet: _Sheet) -> None:
    """Give the nodes of a side the parameters of its master, in proportion."""
    nodes, axis = quad.nodes(side), _axis(side)
    others = [each for each in SIDES if np.isin(nodes, master.quad.nodes(each)).all()]
    if not others:
        raise BadInputError(
            "a border bends round a corner of the block that it follows",
            "in the blocks of a surface", "look for a profile that turns nowhere else",
        )  # fmt: skip
    other = others[0]
    at = master.uv[nodes, _axis(other)]
    low, high = box[axis]
    sheet.uv[nodes, axis] = low + (high - low) * ((at - at[0]) / (at[-1] - at[0]))
    sheet.uv[nodes, 1 - axis] = box[1 - axis, int(side[1])]


def _axis(side: str) -> int:
    """Tell which parameter runs along a side."""
    return 0 if side[0] == "v" else 1


def _laid(quad: Quad, box: FloatArray, sheet: _Sheet) -> LaidQuad:
    """Lay a quad out: sides by their length, but for nodes that lie somewhere already."""
    uv = np.full_like(sheet.uv, np.nan)
    inner = np.unique(quad.region.graph.edge[quad.region.edges])
    uv[inner] = sheet.uv[inner]
    for side in SIDES:
        nodes, along, axis = quad.nodes(side), quad.along(side, 8.0 * sheet.grid), _axis(side)
        low, high = box[axis]
        even = sheet.rounded(low + (high - low) * along / along[-1])
        even[0], even[-1] = low, high
        known = np.isfinite(uv[nodes, axis])
        uv[nodes, axis] = np.where(known, uv[nodes, axis], even)
        uv[nodes, 1 - axis] = box[1 - axis, int(side[1])]
    found = harmonic_map(quad.region, uv)
    free = inner[~np.isfinite(uv[inner]).all(axis=1)]
    found[free] = sheet.rounded(found[free])
    sheet.uv[inner] = found[inner]
    return LaidQuad(quad, box, found)


def _railed(plan: BlockPlan, sheet: _Sheet, masters: Mapping[str, BlockMap]) -> FloatArray:
    """Lay the sections of a body: u by their mean distance, v by parts of the mean girth.

    Below a knuckle line u is that of the block above it.
    """
    quad = plan.core
    graph = quad.region.graph
    halves = [quad.side("u0"), *(rail.half for rail in plan.rails), quad.side("u1")]
    lines = [_even(quad, half) for half in halves]
    step = [float(np.sqrt(dot(b - a, b - a)).mean()) for a, b in itertools.pairwise(lines)]
    length = [np.append(0.0, np.cumsum(graph.length[half >> 1])) for half in halves]
    girth = np.array([each[-1] for each in length])
    coarse = sheet.grid * (_COARSE / GRID)
    u = np.append(0.0, np.cumsum(np.maximum(np.round(np.array(step) / coarse), 1.0) * coarse))
    for seam in plan.seams:
        nodes = np.concatenate([quad.region.begin(half[:1]) for half in halves])
        u = masters[seam.master].core.uv[nodes, 0]
    mean = float((0.5 * (girth[1:] + girth[:-1]) * step).sum() / sum(step))
    v = max(round(mean / coarse), 1) * coarse
    for i, half in enumerate(halves):
        nodes = np.append(quad.region.begin(half), quad.region.end(half[-1:]))
        at = sheet.rounded(v * length[i] / girth[i])
        at[0], at[-1] = 0.0, v
        sheet.uv[nodes] = np.column_stack([np.full(len(nodes), u[i]), at])
    for side in ("v0", "v1"):
        _between(quad, side, sheet)
    return np.array([[0.0, u[-1]], [0.0, v]])


def _paced(found: LaidQuad, plan: BlockPlan, sheet: _Sheet) -> LaidQuad:
    """Let u run in proportion to x between sections: lines along the ship keep an even pace.

    Not on a side that follows another block.
    """
    graph = found.quad.region.graph
    nodes = [found.quad.nodes("u0"), found.quad.nodes("u1")]
    nodes += [np.append(found.quad.region.begin(rail.half), rail.last) for rail in plan.rails]
    flat = [each for each in nodes if np.ptp(graph.place[each, 0]) == 0.0]
    pairs = np.unique([[graph.place[each[0], 0], found.uv[each[0], 0]] for each in flat], axis=0)
    if len(pairs) < 2 or (np.diff(pairs, axis=0) <= 0.0).any():
        return found
    x, uv = graph.place[:, 0], found.uv.copy()
    on = np.unique(graph.edge[found.quad.region.edges])
    on = on[(x[on] > pairs[0, 0]) & (x[on] < pairs[-1, 0])]
    for seam in plan.seams:
        on = np.setdiff1d(on, found.quad.nodes(seam.side))
    at = np.interp(x[on], pairs[:, 0], pairs[:, 1])
    uv[on, 0] = np.where(np.isin(x[on], pairs[:, 0]), at, sheet.rounded(at))
    sheet.uv[on] = uv[on]
    return LaidQuad(found.quad, found.box, uv)


def _between(quad: Quad, side: str, sheet: _Sheet) -> None:
    """Give the nodes of a side between sections their u, by length."""
    nodes, along = quad.nodes(side), quad.along(side)
    given = np.isfinite(sheet.uv[nodes, 0])
    at = np.interp(along, along[given], sheet.uv[nodes[given], 0])
    sheet.uv[nodes, 0] = np.where(given, sheet.uv[nodes, 0], sheet.rounded(at))


def _even(quad: Quad, half: IntArray) -> FloatArray:
    """Give places at equal parts of the length of a chain, (41, 3), m."""
    place = quad.region.path(half)
    step = np.diff(place, axis=0)
    along = np.append(0.0, np.cumsum(np.sqrt(dot(step, step))))
    wanted = np.linspace(0.0, along[-1], _GIRTH + 1)
    return np.stack([np.interp(wanted, along, c) for c in place.T], axis=-1)


def _beside(core: LaidQuad, side: str, quad: Quad, sheet: _Sheet) -> FloatArray:
    """Give the rectangle of a bay, as wide as the block's own lines would go on."""
    axis = 1 - _axis(side)
    other = ("v0", "v1") if axis == 0 else ("u0", "u1")
    coarse = sheet.grid * (_COARSE / GRID)
    width = 0.5 * sum(float(quad.along(each)[-1]) for each in other) * _pace(core, side, axis)
    width = max(round(width / coarse), 1) * coarse
    box = np.empty((2, 2))
    edge = core.box[axis, int(side[1])]
    box[axis] = (edge - width, edge) if side[1] == "0" else (edge, edge + width)
    box[1 - axis] = core.uv[quad.nodes(_TOUCHING[side])[[0, -1]], 1 - axis]
    return box


def _pace(core: LaidQuad, side: str, axis: int) -> float:
    """Give by how much a parameter rises along a metre of the lines that leave a side."""
    graph, region = core.quad.region.graph, core.quad.region
    on = np.zeros(len(graph.place), np.bool_)
    on[core.quad.nodes(side)] = True
    leaving = np.flatnonzero(region.interior & (on[graph.edge[:, 0]] != on[graph.edge[:, 1]]))
    step = core.uv[graph.edge[leaving, 1]] - core.uv[graph.edge[leaving, 0]]
    pace = np.hypot(step[:, 0], step[:, 1]) / graph.length[leaving]
    good = np.abs(step[:, axis]) > np.abs(step[:, 1 - axis])
    return float(np.median(pace[good])) if good.any() else 1.0
