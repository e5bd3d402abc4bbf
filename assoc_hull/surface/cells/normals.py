"""Normals of a hull at the nodes of its net, from the directions of the lines that meet there."""

from __future__ import annotations

import heapq

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.vectors import dot

__all__ = ["edge_angles", "node_normals"]

_TANGENT = 0.02
"""Lines whose directions have a smaller cross product do not tell a normal."""

_CROWDED = 0.02
"""Edges that leave a node with so small an angle between them (radians) lie on one another, seen
along its normal: at the foot of a stem the keel does, and the border of a flat bottom."""


def node_normals(place: FloatArray, edge: IntArray, leave: FloatArray) -> FloatArray:
    """Give unit normals at the nodes, all to one side of the surface, outward.

    Parameters
    ----------
    place : (n, 3), m
        The nodes.
    edge : (e, 2) int
        The nodes at the ends of each edge.
    leave : (e, 2, 3)
        Unit directions in which it leaves them.

    Returns
    -------
    (n, 3)
        The mean of the neighbours where all lines are tangent to one another, and where some lie
        on one another as seen along the normal of the others: at corners of the hull.
    """
    if not len(place):
        return np.empty((0, 3))
    normal, size = _widest(len(place), edge, leave)
    good = size >= _TANGENT
    sign = _one_side(normal, good, edge, leave)
    normal = normal * sign[:, None]
    normal = _from_neighbours(normal, good, edge)
    corner = _crowded(edge_angles(normal, edge, leave), edge.ravel(), len(place))
    normal = _from_neighbours(normal, ~corner, edge)
    return normal if _outward(place, normal) else -normal


def edge_angles(normal: FloatArray, edge: IntArray, leave: FloatArray) -> FloatArray:
    """Give angles of edges in the tangent planes of their nodes, (2 e,), radians.

    Both ends of an edge one after the other; counter-clockwise as seen against the normal.
    """
    node, away = edge.ravel(), leave.reshape(-1, 3)
    least = np.abs(normal).argmin(axis=1)
    first = np.cross(np.eye(3)[least], normal)
    first /= np.sqrt(dot(first, first))[:, None]
    second = np.cross(normal, first)
    return np.arctan2(dot(away, second[node]), dot(away, first[node]))


def _crowded(angle: FloatArray, node: IntArray, count: int) -> NDArray[np.bool_]:
    """Tell at which nodes two edges lie on one another, (n,)."""
    order = np.lexsort((angle, node))
    first = np.append(True, np.diff(node[order]) != 0)
    after = np.append(angle[order][1:], 0.0)
    start = np.flatnonzero(first)
    last = np.append(start[1:], len(order)) - 1
    after[last] = angle[order][start] + 2.0 * np.pi
    found = np.zeros(count, bool)
    found[node[order][after - angle[order] < _CROWDED]] = True
    return found


def _widest(count: int, edge: IntArray, leave: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give at each node the normal of the two edges that stand most squarely, and their sine."""
    node, away = edge.ravel(), leave.reshape(-1, 3)
    order = np.argsort(node, kind="stable")
    degree = np.bincount(node, minlength=count)
    start = np.concatenate([[0], np.cumsum(degree)])
    best, size = np.zeros((count, 3)), np.zeros(count)
    for i in range(int(degree.max(initial=0))):
        for j in range(i):
            own = np.flatnonzero(degree > i)
            cross = np.cross(away[order[start[own] + j]], away[order[start[own] + i]])
            sine = np.sqrt(dot(cross, cross))
            better = sine > size[own]
            size[own[better]] = sine[better]
            best[own[better]] = cross[better] / sine[better, None]
    return best, size


def _one_side(
    normal: FloatArray, good: NDArray[np.bool_], edge: IntArray, leave: FloatArray
) -> FloatArray:
    """Give signs that turn all normals to one side: along edges, the surest first."""
    # From one end of an edge to the other the normal turns as the edge does.
    carried = _turned(normal[edge[:, 0]], leave[:, 0], -leave[:, 1])
    alike = dot(carried, normal[edge[:, 1]])
    alike[~good[edge].all(axis=1)] = 0.0
    beside: list[list[tuple[float, int, float]]] = [[] for _ in range(len(normal))]
    for (a, b), each in zip(edge.tolist(), alike.tolist(), strict=True):
        beside[a].append((-abs(each), b, each))
        beside[b].append((-abs(each), a, each))
    sign = np.zeros(len(normal))
    for seed in np.flatnonzero(good).tolist():
        if sign[seed]:
            continue
        waiting = [(-2.0, seed, 1.0)]
        while waiting:
            _, node, own = heapq.heappop(waiting)
            if sign[node]:
                continue
            sign[node] = own
            for rank, other, each in beside[node]:
                if not sign[other] and good[other]:
                    heapq.heappush(waiting, (rank, other, own if each >= 0.0 else -own))
    return sign


def _turned(vector: FloatArray, before: FloatArray, after: FloatArray) -> FloatArray:
    """Turn vectors as `before` is turned to `after` by the shortest way."""
    axis = np.cross(before, after)
    cosine = dot(before, after)[:, None]
    once = np.cross(axis, vector)
    share = 1.0 / np.maximum(1.0 + cosine, 1e-9)
    found: FloatArray = vector + once + np.cross(axis, once) * share
    return found


def _from_neighbours(normal: FloatArray, good: NDArray[np.bool_], edge: IntArray) -> FloatArray:
    """Give nodes without a normal the mean of those beside them, ring after ring."""
    normal, known = normal.copy(), good.copy()
    while not known.all():
        total = np.zeros_like(normal)
        for a, b in ((0, 1), (1, 0)):
            own = known[edge[:, b]] & ~known[edge[:, a]]
            np.add.at(total, edge[own, a], normal[edge[own, b]])
        size = np.sqrt(dot(total, total))
        new = (size > 1e-9) & ~known
        if not new.any():
            break
        normal[new] = total[new] / size[new, None]
        known |= new
    return normal


def _outward(place: FloatArray, normal: FloatArray) -> bool:
    """Tell whether normals point away from the middle of the ship on the whole."""
    return float((normal[:, 1] * place[:, 1]).sum()) >= 0.0
