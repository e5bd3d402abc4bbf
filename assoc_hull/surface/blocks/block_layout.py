"""Blocks with the samples they are fitted to: points of lines with parameters and weights.

`lay_out` parts the half hull, maps each block to a rectangle and samples its lines.
Parameters along a line are monotone cubics between its nodes (Fritsch and Butland 1984).
Ends of lines beyond their last crossing bound no cell, but are sampled as well.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.curve_net import CurveNet
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.fitting.fit_input import Samples
from assoc_hull.geometry.splines.segments import evaluate
from assoc_hull.surface.blocks.block_map import GRID, BlockMap, LaidQuad, block_map
from assoc_hull.surface.blocks.block_plan import block_plans
from assoc_hull.surface.blocks.cell_regions import BRIDGE, SIDES
from assoc_hull.surface.cells.net_faces import sound_cells
from assoc_hull.surface.cells.net_graph import NetGraph

__all__ = [
    "HullBlock",
    "LooseEnds",
    "SideStretch",
    "block_samples",
    "lay_out",
    "loose_ends",
    "slopes_along",
    "with_loose_ends",
]


@attrs.frozen
class SideStretch:
    """A part of a side of a block.

    Attributes
    ----------
    low, high : float, m
        Where along the side it lies: v on ``"u0"`` and ``"u1"``, u on the others.
    centre : bool
        It lies on the centreline: y = 0.
    master : str
        The block whose border it takes over; empty if it is free.
    master_side : str
        The side of that block.
    master_low, master_high : float, m
        Where along that side; between them both parameters run in proportion.
    crease : bool
        Only the border is taken over, not the tangent planes: it is a knuckle line.
    """

    low: float
    high: float
    centre: bool = False
    master: str = ""
    master_side: str = ""
    master_low: float = 0.0
    master_high: float = 0.0
    crease: bool = False


@attrs.frozen(eq=False)
class HullBlock:
    """A part of the half hull that one surface is fitted to.

    u runs forward, v from the deck edge down to the keel, so that S_u x S_v points out of the hull;
    both are lengths.

    Attributes
    ----------
    name : str
        ``"body"``, ``"bow"``, ``"bow stem"``, ``"bow bulb"``, ``"stern"``, ``"stern counter"``,
        ``"stern boss"``; behind it `` below knuckle 1``, of the knuckle line along its upper side.
    kind : {"body", "bow", "stern"}
        Where it lies.
    extent : (2, 2), m
        Least and greatest u, least and greatest v of the block.
    reach : (2, 2), m
        The same with the bays beyond its sides, for which it has samples as well.
    samples : Samples
        Points on its lines and on those in the bays; `line` numbers the curves of the net.
    inside : (k,) bool
        Which of them lie on the block itself.
    sides : dict of str to tuple of SideStretch
        The sides ``"u0"``, ``"u1"``, ``"v0"``, ``"v1"``, towards rising parameters.
    stations, levels : (n,), m
        Mean u of sections and mean v of waterlines and buttocks: where knots are worth most.
    corners : (4, 3), m
        The places of the corners: least u and v, greatest u, both greatest, greatest v.
    turns : (4,), degrees
        By how much the border turns there, 90 for a rectangle, little where it is round.
    singular : tuple of (float, float), m
        Parameters of corners at which the sides are tangent, or nearly.
    notes : tuple of str
        What is to be known.
    """

    name: str
    kind: str
    extent: FloatArray
    reach: FloatArray
    samples: Samples
    inside: NDArray[np.bool_]
    sides: Mapping[str, tuple[SideStretch, ...]]
    stations: FloatArray
    levels: FloatArray
    corners: FloatArray
    turns: FloatArray
    singular: tuple[tuple[float, float], ...]
    notes: tuple[str, ...]

    def __attrs_post_init__(self) -> None:
        freeze(self.extent, self.reach, self.inside, self.stations, self.levels)
        freeze(self.corners, self.turns)

    @property
    def area(self) -> float:
        """The area of its rectangle, m2."""
        return float(np.prod(np.diff(self.extent, axis=1)))

    @property
    def masters(self) -> tuple[str, ...]:
        """The blocks whose borders it takes over, each once."""
        every = [stretch.master for side in self.sides.values() for stretch in side]
        return tuple(dict.fromkeys(name for name in every if name))


# --------------------------------------------------------------------------------------
# Slopes of parameters along lines, by monotone cubics: F. N. Fritsch and R. E. Carlson, Monotone
# piecewise cubic interpolation, SIAM Journal on Numerical Analysis 17, 1980; the weighted harmonic
# mean is that of Fritsch and Butland (1984).

_TINY = 1e-200
"""Slopes whose product is less count as zero: their inverse may have no number."""


def slopes_along(
    curve: IntArray,
    edge: IntArray,
    begin: FloatArray,
    length: FloatArray,
    value: FloatArray,
    straight: NDArray[np.bool_],
) -> tuple[FloatArray, FloatArray]:
    """Give the slopes at both ends of each edge, (e, d) and (e, d), a metre.

    Neighbouring edges of a curve share theirs, and no value overshoots. For edges of `length` (e,),
    m, on `curve` (e,) from node to node, `edge` (e, 2), that begin there at `begin` (e,), m, with
    `value` (e, 2, d) at the ends; those beside `straight` edges (e,), along which values run
    straight, take over their slope.
    """
    order = np.lexsort((begin, curve))
    size = np.maximum(length, 1e-12)[:, None]
    step = (value[:, 1] - value[:, 0]) / size
    leave, arrive = step.copy(), step.copy()
    a, b = order[:-1], order[1:]
    joined = (curve[a] == curve[b]) & (edge[a, 1] == edge[b, 0]) & ~straight[a] & ~straight[b]
    a, b = a[joined], b[joined]
    weight = 2.0 * size[b] + size[a], size[b] + 2.0 * size[a]
    same = step[a] * step[b] > _TINY
    down = np.where(same, weight[0] / np.where(same, step[a], 1.0), 1.0)
    down = down + np.where(same, weight[1] / np.where(same, step[b], 1.0), 0.0)
    slope = np.where(same, (weight[0] + weight[1]) / down, 0.0)
    arrive[a] = slope
    leave[b] = slope
    return leave, arrive


# --------------------------------------------------------------------------------------
# Samples of a block and its bays.

_ACROSS, _ALONG = 0.25, 0.6
"""Distance of points, m, on a hull of 300 m; the latter on lines along the body."""

_SHIP = 300.0
_BORDER = 3.5
"""Points on borders weigh so many times more."""

_FAINT = 0.1
"""Points on a bridge, whose place is a guess, weigh so much of what others do."""


@attrs.frozen(eq=False)
class _Edges:
    """Edges of a block, those of its bays too, each once."""

    edge: IntArray
    uv: FloatArray
    held: NDArray[np.bool_]
    border: NDArray[np.bool_]
    inside: NDArray[np.bool_]


def block_samples(
    found: BlockMap, length: float, cuts: IntArray
) -> tuple[Samples, NDArray[np.bool_]]:
    """Give points on the lines of a block and of its bays, at even steps along every edge.

    The ends of edges are among them. Also which points lie on the block itself, (k,). Along edges
    `cuts` blocks meet: points there hold both parameters, in both blocks. `length`, m, is that of
    the ship.
    """
    graph = found.core.quad.region.graph
    edges = _edges(found, cuts)
    family = np.array(graph.net.family)[graph.curve[edges.edge]]
    coarse = (family != "sections") & (found.plan.kind == "body")
    step = np.where(coarse, _ALONG, _ACROSS) * (length / _SHIP)
    count = np.maximum(np.ceil(graph.length[edges.edge] / step).astype(np.int64), 2)
    owner = np.repeat(np.arange(len(count)), count + 1)
    first = np.append(0, np.cumsum(count + 1))
    rank = np.arange(len(owner)) - first[owner]
    part = rank / count[owner]
    point = _points(graph, edges.edge, count, first)
    uv = _parameters(graph, edges, owner, part)
    weight = graph.length[edges.edge][owner] / count[owner]
    weight = np.where((rank == 0) | (rank == count[owner]), 0.5 * weight, weight)
    weight = np.where(edges.border[owner], _BORDER * weight, weight)
    bridge = family == BRIDGE
    weight = np.where(bridge[owner], _FAINT * weight, weight)
    line = _lines(graph)[graph.curve[edges.edge]][owner]
    inside = edges.inside & ~bridge
    good = weight > 0.0
    low, high = found.reach.T
    uv = np.clip(uv, low, high)
    samples = Samples.of(uv[good], point[good], weight[good], line[good], edges.held[owner][good])
    return samples, inside[owner][good]


def _edges(found: BlockMap, cuts: IntArray) -> _Edges:
    """Gather the edges of the block and its bays with the parameters of their ends."""
    graph = found.core.quad.region.graph
    count = len(graph.edge)
    uv = np.full((count, 2, 2), np.nan)
    held = np.zeros((count, 2), np.bool_)
    border, seen = np.zeros(count, np.bool_), np.zeros(count, np.bool_)
    core = found.core.quad.region
    left = core.left.copy()
    for laid in found.bays.values():
        left |= laid.quad.region.left
    outer = left[0::2] ^ left[1::2]
    cut = core.left[0::2] ^ core.left[1::2]
    for laid in (found.core, *found.bays.values()):
        own = laid.quad.region.edges & ~seen
        uv[own] = laid.uv[graph.edge[own]]
        seen |= own
        for side in SIDES:
            edge = laid.quad.side(side) >> 1
            edge = edge[outer[edge] | cut[edge]]
            held[edge, 0 if side[0] == "u" else 1] = True
            border[edge] = True
    held[cut & ~outer] = True
    for rail in found.plan.rails:
        held[rail.half >> 1, 0] = True
    chosen = np.flatnonzero(seen)
    held[cuts[core.edges[cuts]]] = True
    return _Edges(chosen, uv[chosen], held[chosen], border[chosen], core.edges[chosen])


def _lines(graph: NetGraph) -> IntArray:
    """Give the line that points of each curve count as of: a bridge goes with its waterline."""
    first = {name: i for i, name in reversed(list(enumerate(graph.net.name)))}
    return np.array(
        [
            first[name] if family == BRIDGE else i
            for i, (name, family) in enumerate(zip(graph.net.name, graph.net.family, strict=True))
        ],
        np.int64,
    )


def _points(graph: NetGraph, edge: IntArray, count: IntArray, first: IntArray) -> FloatArray:
    """Give the points, edges of one number of steps at a time, (k, 3), m."""
    found = np.empty((int(first[-1]), 3))
    for steps in np.unique(count).tolist():
        own = np.flatnonzero(count == steps)
        place = graph.pieces.chosen(edge[own]).points(np.linspace(0.0, 1.0, steps + 1))
        place[:, [0, -1]] = graph.place[graph.edge[edge[own]]]
        found[first[own][:, None] + np.arange(steps + 1)] = place
    return found


def _parameters(graph: NetGraph, edges: _Edges, owner: IntArray, part: FloatArray) -> FloatArray:
    """Give parameters along the edges: cubics through the nodes, straight on borders, (k, 2), m."""
    length = graph.length[edges.edge]
    leave, arrive = slopes_along(
        graph.curve[edges.edge], graph.edge[edges.edge], graph.t[edges.edge, 0], length, edges.uv,
        edges.border,
    )  # fmt: skip
    p = part[:, None]
    a, b = edges.uv[owner, 0], edges.uv[owner, 1]
    da, db = (each[owner] * length[owner, None] for each in (leave, arrive))
    q = 1.0 - p
    cubic = a + (b - a) * p * p * (3.0 - 2.0 * p) + p * q * (q * da - p * db)
    return np.asarray(np.where(edges.border[owner, None], a + (b - a) * p, cubic))


# --------------------------------------------------------------------------------------
# Loose ends. The map of a block knows nodes and edges of cells only; a point of a loose end gets
# the parameters of a plane through those of its nearest neighbours on the block's lines. As with
# all points, the fit corrects them.

_LEAST = 0.01
"""Ends that are shorter, m on a hull of 300 m, are none."""
_STEP = 0.25
"""Distance of points, m, on a hull of 300 m."""

_NEIGHBOURS = 24
"""Points on the lines of a block that tell the parameters of a point."""


@attrs.frozen(eq=False)
class LooseEnds:
    """Points on pieces of lines that are no edges of a graph.

    Attributes
    ----------
    point : (k, 3), m
        The points, at even steps; not those where the pieces begin at a crossing.
    weight : (k,), m
        The length of line that each stands for.
    line : (k,) int
        The curve of the net that it is on.
    """

    point: FloatArray
    weight: FloatArray
    line: IntArray


def loose_ends(graph: NetGraph, length: float) -> LooseEnds:
    """Give points on what of the lines of a graph lies before their first or after their last edge.

    Lines without any edge are not looked at; `length`, m, is that of the ship.
    """
    net, scale = graph.net, length / _SHIP
    parts = []
    for curve in np.unique(graph.curve[graph.curve >= 0]).tolist():
        t = graph.t[graph.curve == curve]
        for begin, end in ((float(t.min()), 0.0), (float(t.max()), net.length(curve))):
            if abs(end - begin) > _LEAST * scale:
                parts.append(_piece_points(net, curve, begin, end, _STEP * scale))
    if not parts:
        return LooseEnds(np.zeros((0, 3)), np.zeros(0), np.zeros(0, np.int64))
    return LooseEnds(*(np.concatenate(each) for each in zip(*parts, strict=True)))


def _piece_points(
    net: CurveNet, curve: int, begin: float, end: float, step: float
) -> tuple[FloatArray, FloatArray, IntArray]:
    """Give points of a piece, the lengths they stand for, and its number as often."""
    count = max(int(np.ceil(abs(end - begin) / step)), 1)
    t = np.linspace(begin, end, count + 1)
    place = evaluate(net.batch, np.full(count + 1, curve), t)
    step_length = np.linalg.norm(np.diff(place, axis=0), axis=1)
    weight = 0.5 * (step_length + np.append(step_length[1:], 0.0))
    return place[1:], weight, np.full(count, curve, np.int64)


def with_loose_ends(
    blocks: Sequence[HullBlock], found: LooseEnds, grid: float
) -> tuple[HullBlock, ...]:
    """Give blocks their nearest loose ends; parameters are rounded to `grid`, m."""
    if not len(found.point):
        return tuple(blocks)
    near = [_nearest(found.point, block, 1) for block in blocks]
    home = np.stack([away[:, 0] for away, _ in near]).argmin(axis=0)
    return tuple(
        _with_points(block, found, np.flatnonzero(home == i), grid)
        for i, block in enumerate(blocks)
    )


def _nearest(point: FloatArray, block: HullBlock, count: int) -> tuple[FloatArray, IntArray]:
    """Give the nearest points of the lines of a block, and how far they are, (k, count) each."""
    from scipy.spatial import cKDTree

    inside = np.flatnonzero(block.inside)
    # A list of ranks, not a count: the answer has two axes for a single neighbour, too.
    away, at = cKDTree(block.samples.point[inside]).query(point, [*range(1, count + 1)])
    return np.asarray(away, np.float64), np.asarray(inside[at], np.int64)


def _with_points(block: HullBlock, found: LooseEnds, mine: IntArray, grid: float) -> HullBlock:
    if not len(mine):
        return block
    old, point = block.samples, found.point[mine]
    uv = np.round(_parameters_of_neighbours(block, point) / grid) * grid
    uv = np.clip(uv, *block.extent.T)
    samples = Samples(
        np.concatenate([old.uv, uv]),
        np.concatenate([old.point, point]),
        np.concatenate([old.weight, found.weight[mine]]),
        np.concatenate([old.line, found.line[mine]]),
        np.concatenate([old.held, np.zeros((len(mine), 2), np.bool_)]),
    )
    inside = np.concatenate([block.inside, np.ones(len(mine), np.bool_)])
    return attrs.evolve(block, samples=samples, inside=inside)


def _parameters_of_neighbours(block: HullBlock, point: FloatArray) -> FloatArray:
    """Give parameters by the plane that fits those of the neighbours best, (k, 2), m."""
    away, at = _nearest(point, block, min(_NEIGHBOURS, int(block.inside.sum())))
    # A tenth of the farthest distance keeps the weight of a neighbour at no distance finite.
    weight = 1.0 / (away + away[:, -1:] * 0.1)
    uv, place = block.samples.uv[at], block.samples.point[at] - point[:, None]
    share = weight[..., None] / weight.sum(axis=1)[:, None, None]
    middle, centre = (uv * share).sum(axis=1), (place * share).sum(axis=1)
    slope = np.linalg.pinv((place - centre[:, None]) * weight[..., None], rcond=0.05) @ (
        (uv - middle[:, None]) * weight[..., None]
    )
    return np.asarray(middle - np.einsum("ki,kij->kj", centre, slope))


# --------------------------------------------------------------------------------------
# From the net to blocks with samples.

_TANGENT = 25.0
"""A border that turns by fewer degrees at a corner has its sides tangent there."""


def lay_out(
    net: CurveNet, length: float, leave_out: NDArray[np.bool_] | None = None
) -> tuple[HullBlock, ...]:
    """Part a half hull into blocks and sample their lines.

    Parameters
    ----------
    net : CurveNet
        Curves and crossings.
    length : float, m
        Of the ship.
    leave_out : (m,) bool or None
        Curves to do without.

    Returns
    -------
    tuple of HullBlock
        Masters before those that follow them.

    Raises
    ------
    BadInputError
        The lines bound no half hull, or a part of it is no disc with four corners.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.analysis.net.curve_net import gather_net
    >>> from assoc_hull.surface.blocks.block_layout import lay_out
    >>> hull = ah.examples.series60()
    >>> [block.name for block in lay_out(gather_net(hull.state), hull.particulars.length)]
    ['body', 'stern counter']
    """
    found = sound_cells(net, leave_out)
    maps = dict[str, BlockMap]()
    for plan in block_plans(found, length):
        maps[plan.name] = block_map(plan, length, maps)
    halves = [half for each in maps.values() for seam in each.plan.seams for half in seam.half]
    cuts = np.array(halves, np.int64) >> 1
    blocks = [_block(each, maps, length, cuts) for each in maps.values()]
    return with_loose_ends(blocks, loose_ends(found.graph, length), GRID * length)


def _block(found: BlockMap, every: dict[str, BlockMap], length: float, cuts: IntArray) -> HullBlock:
    samples, inside = block_samples(found, length, cuts)
    plan, box = found.plan, found.core.box
    place = found.core.quad.region.graph.place
    ends = ((0, 0), (1, 0), (1, 1), (0, 1))
    singular = tuple(
        (float(box[0, i]), float(box[1, j]))
        for (i, j), turn in zip(ends, plan.turns, strict=True)
        if turn < _TANGENT
    )
    return HullBlock(
        plan.name, plan.kind, box.copy(), found.reach, samples, inside,
        {side: _stretches(found, side, every) for side in SIDES},
        _means(found, 0, GRID * length), _means(found, 1, GRID * length),
        place[list(plan.core.corner)], np.array(plan.turns), singular, plan.notes,
    )  # fmt: skip


def _stretches(found: BlockMap, side: str, every: dict[str, BlockMap]) -> tuple[SideStretch, ...]:
    """Give the parts of a side: those that follow a block, and those on the centreline."""
    quad, graph = found.core.quad, found.core.quad.region.graph
    master = {half: seam for seam in found.plan.seams if seam.side == side for half in seam.half}
    half = quad.side(side).tolist()
    axis = 1 if side[0] == "u" else 0
    at = found.core.uv[quad.nodes(side), axis]
    seams = [master.get(h, master.get(h ^ 1)) for h in half]
    centre = [bool(graph.net.centre[graph.curve[h >> 1]]) for h in half]
    keys = [
        ("" if seam is None else seam.master, seam is not None and seam.crease, on)
        for seam, on in zip(seams, centre, strict=True)
    ]
    parts = []
    begin = 0
    for i in range(1, len(half) + 1):
        if i < len(half) and keys[i] == keys[begin]:
            continue
        name, crease, on_centre = keys[begin]
        low, high = float(at[begin]), float(at[i])
        if name:
            nodes = quad.nodes(side)[[begin, i]]
            found_part = _following(every[name].core, low, high, nodes, name)
            parts.append(attrs.evolve(found_part, crease=crease))
        else:
            parts.append(SideStretch(low, high, on_centre))
        begin = i
    return tuple(parts)


def _following(
    master: LaidQuad, low: float, high: float, nodes: IntArray, name: str
) -> SideStretch:
    """Find the side of a master on which two nodes lie, and where."""
    for side in SIDES:
        own = master.quad.nodes(side).tolist()
        if all(node in own for node in nodes.tolist()):
            at = master.uv[nodes, 1 if side[0] == "u" else 0]
            return SideStretch(low, high, False, name, side, float(at[0]), float(at[1]))
    raise AssertionError(name)


def _means(found: BlockMap, axis: int, grid: float) -> FloatArray:
    """Give the mean parameter of each line that runs across an axis, rising, (n,), m."""
    graph, core = found.core.quad.region.graph, found.core
    family = np.array(graph.net.family)
    wanted = family == "sections" if axis == 0 else np.isin(family, ["waterlines", "buttocks"])
    edge = np.flatnonzero(core.quad.region.interior & wanted[graph.curve])
    middle = core.uv[graph.edge[edge], axis].mean(axis=1)
    curves, index = np.unique(graph.curve[edge], return_inverse=True)
    weight = graph.length[edge]
    total = np.bincount(index, weight, len(curves))
    mean = np.bincount(index, weight * middle, len(curves)) / np.maximum(total, 1e-12)
    return np.sort(np.round(mean / grid) * grid)
