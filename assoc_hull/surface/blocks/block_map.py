"""A block laid out on its rectangle, bays beyond its sides on rectangles beside it."""

from __future__ import annotations

from collections.abc import Mapping

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.vectors import dot
from assoc_hull.surface.blocks.harmonic import laid_out
from assoc_hull.surface.blocks.plan import BlockPlan
from assoc_hull.surface.blocks.quad import SIDES, Quad

__all__ = ["BlockMap", "Laid", "block_map"]

_GIRTH = 40
"""Parts of a girth at which the distance of neighbouring sections is taken."""


@attrs.frozen(eq=False)
class Laid:
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
    core : Laid
        The block.
    bays : dict of str to Laid
        The bays, by the side or corner they lie beyond.
    """

    plan: BlockPlan
    core: Laid
    bays: dict[str, Laid]

    @property
    def reach(self) -> FloatArray:
        """The rectangle that holds the block and its bays, (2, 2), m."""
        boxes = np.stack([self.core.box, *(bay.box for bay in self.bays.values())])
        return np.stack([boxes[:, :, 0].min(axis=0), boxes[:, :, 1].max(axis=0)], axis=1)


def block_map(plan: BlockPlan) -> BlockMap:
    """Lay a block and its bays out.

    Parameters
    ----------
    plan : BlockPlan
        The block.
    """
    core = _with_rails(plan) if plan.rails else _laid(plan.core, _box(plan.core))
    bays = {name: _beside(core, name, quad) for name, quad in plan.bays.items() if " " not in name}
    for name, quad in plan.bays.items():
        if " " in name:
            across, along = (bays.get(part) for part in name.split())
            if across is not None and along is not None:
                bays[name] = _laid(quad, np.stack([across.box[0], along.box[1]]))
    return BlockMap(plan, core, bays)


def _box(quad: Quad) -> FloatArray:
    u, v = quad.extent()
    return np.array([[0.0, u], [0.0, v]])


def _laid(quad: Quad, box: FloatArray, inside: Mapping[int, FloatArray] | None = None) -> Laid:
    """Lay a quad out, sides by their length; nodes inside it may be given."""
    uv = np.full((len(quad.region.graph.place), 2), np.nan)
    for node, place in (inside or {}).items():
        uv[node] = place
    for side in SIDES:
        axis = 0 if side[0] == "v" else 1
        along = quad.along(side)
        nodes = quad.nodes(side)
        low, high = box[axis]
        if inside is None or axis == 1:
            uv[nodes, axis] = low + (high - low) * along / along[-1]
        uv[nodes, 1 - axis] = box[1 - axis, int(side[1])]
    if inside is not None:
        for side in ("v0", "v1"):
            _between(quad, side, uv)
    return Laid(quad, box, laid_out(quad.region, uv))


def _between(quad: Quad, side: str, uv: FloatArray) -> None:
    """Give the nodes of a side between sections their u, by length."""
    nodes, along = quad.nodes(side), quad.along(side)
    given = np.isfinite(uv[nodes, 0])
    uv[nodes, 0] = np.interp(along, along[given], uv[nodes[given], 0])


def _with_rails(plan: BlockPlan) -> Laid:
    """Lay a body out: u by the mean distance of sections, v by parts of the mean girth."""
    quad = plan.core
    graph = quad.region.graph
    halves = [quad.side("u0"), *(rail.half for rail in plan.rails), quad.side("u1")]
    lines = [_even(quad, half) for half in halves]
    step = [float(np.sqrt(dot(b - a, b - a)).mean()) for a, b in zip(lines, lines[1:], strict=False)]
    u = np.append(0.0, np.cumsum(step))
    length = [np.append(0.0, np.cumsum(graph.length[half >> 1])) for half in halves]
    girth = np.array([each[-1] for each in length])
    v = float((0.5 * (girth[1:] + girth[:-1]) * step).sum() / u[-1])
    inside = {}
    for i, half in enumerate(halves):
        nodes = np.append(quad.region.begin(half), quad.region.end(half[-1:]))
        for node, along in zip(nodes.tolist(), length[i].tolist(), strict=True):
            inside[node] = np.array([u[i], v * along / girth[i]])
    return _laid(quad, np.array([[0.0, u[-1]], [0.0, v]]), inside)


def _even(quad: Quad, half: np.ndarray) -> FloatArray:
    """Give places at equal parts of the length of a chain, (41, 3), m."""
    place = quad.region.path(half)
    step = np.diff(place, axis=0)
    along = np.append(0.0, np.cumsum(np.sqrt(dot(step, step))))
    wanted = np.linspace(0.0, along[-1], _GIRTH + 1)
    return np.stack([np.interp(wanted, along, c) for c in place.T], axis=-1)


def _beside(core: Laid, side: str, quad: Quad) -> Laid:
    """Lay a bay out beside a side of the block, as wide as the block's own lines go on."""
    axis = 0 if side[0] == "u" else 1
    other = ("v0", "v1") if axis == 0 else ("u0", "u1")
    width = 0.5 * sum(float(quad.along(each)[-1]) for each in other) * _pace(core, side, axis)
    box = np.empty((2, 2))
    edge = core.box[axis, int(side[1])]
    box[axis] = (edge - width, edge) if side[1] == "0" else (edge, edge + width)
    touching = {"u0": "u1", "u1": "u0", "v0": "v1", "v1": "v0"}[side]
    ends = core.uv[quad.nodes(touching)[[0, -1]], 1 - axis]
    box[1 - axis] = ends
    return _laid(quad, box)


def _pace(core: Laid, side: str, axis: int) -> float:
    """Give by how much a parameter rises along a metre of the lines that leave a side."""
    graph, region = core.quad.region.graph, core.quad.region
    on = np.zeros(len(graph.place), np.bool_)
    on[core.quad.nodes(side)] = True
    leaving = np.flatnonzero(region.interior & (on[graph.edge[:, 0]] != on[graph.edge[:, 1]]))
    step = core.uv[graph.edge[leaving, 1]] - core.uv[graph.edge[leaving, 0]]
    pace = np.hypot(step[:, 0], step[:, 1]) / graph.length[leaving]
    good = np.abs(step[:, axis]) > np.abs(step[:, 1 - axis])
    return float(np.median(pace[good])) if good.any() else 1.0
