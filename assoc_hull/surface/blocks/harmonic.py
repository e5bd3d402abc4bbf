"""A part of a net laid out flat: nodes at the mean of their neighbours, the border given.

    Tutte, W.T.: How to draw a graph. Proceedings of the London Mathematical Society 13 (1963):
    with positive weights and a convex border nothing folds.

The weight of an edge is the width of the strips on both sides of it over its length: that of
finite volumes, so that a net of any density is laid out as the smooth (harmonic) map would be.
Weights are rounded to powers of two: a line that moves a little changes none.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.surface.blocks.region import Region

__all__ = ["edge_weights", "laid_out"]

_LEAST = 1e-3
"""Of the mean weight: no edge counts for less."""


def edge_weights(region: Region) -> FloatArray:
    """Give the weights of all edges for what a region holds, (e,); nil outside it.

    Parameters
    ----------
    region : Region
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


def _areas(region: Region) -> FloatArray:
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


def laid_out(region: Region, uv: FloatArray) -> FloatArray:
    """Give all nodes of a region parameters, (n, 2), m; nan outside it.

    Parameters
    ----------
    region : Region
        The part of the net.
    uv : (n, 2), m
        Where given nodes lie, those of its border among them; nan elsewhere.
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
