"""Polylines: arc length, resampling, order along a path, crossings of itself, straight sides.

Polylines that are polygons: straight sides, and corners that no smooth curve is meant by.

A plane cuts a mesh with flat sides, a barge or a deck, in a few long straight sides. Where so few
points lie on a line, its corners would be taken for the facets of a curve.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.polylines.operations import cumulative_lengths, resample
>>> corner = np.array([[0.0, 0, 0], [3, 0, 0], [3, 4, 0]])
>>> cumulative_lengths(corner)
array([0., 3., 7.])
>>> resample(corner, np.array([5.0]))
array([[3., 2., 0.]])
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = [
    "PolygonRule",
    "crossing_segments",
    "cumulative_lengths",
    "distinct_points",
    "drop_repeats",
    "filled_polygon",
    "order_paths",
    "polygon_corners",
    "project_on_polyline",
    "resample",
    "runs_where",
    "self_crossings",
]


def cumulative_lengths(points: FloatArray) -> FloatArray:
    """Give the length from the first point to each, (n,), m.

    Parameters
    ----------
    points : (n, k), m
        A polyline.
    """
    out = np.zeros(len(points))
    step = np.diff(points, axis=0)
    np.cumsum(np.sqrt((step * step).sum(axis=1)), out=out[1:])
    return out


def resample(points: FloatArray, at: FloatArray) -> FloatArray:
    """Give the places at lengths `at` (m) along a polyline, (len(at), k), m."""
    length = cumulative_lengths(points)
    return np.column_stack([np.interp(at, length, column) for column in points.T])


def project_on_polyline(
    points: FloatArray, length: FloatArray, place: FloatArray
) -> tuple[float, float]:
    """Give the length along a polyline that is nearest to a place, and the distance, m.

    Parameters
    ----------
    points, length : (n, k), (n,), m
        The polyline, and the length to each point as `cumulative_lengths` gives it.
    place : (k,), m
        The place.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polylines.operations import cumulative_lengths, project_on_polyline
    >>> line = np.array([[0.0, 0], [3, 0], [3, 4]])
    >>> project_on_polyline(line, cumulative_lengths(line), np.array([2.0, 1.0]))
    (2.0, 1.0)
    """
    start, step = points[:-1], np.diff(points, axis=0)
    part = ((place - start) * step).sum(axis=1) / np.maximum((step * step).sum(axis=1), 1e-24)
    part = np.clip(part, 0.0, 1.0)
    away = np.sqrt(((start + part[:, None] * step - place) ** 2).sum(axis=1))
    i = int(away.argmin())
    return float(length[i] + part[i] * (length[i + 1] - length[i])), float(away[i])


def drop_repeats(points: FloatArray, least: float) -> FloatArray:
    """Leave out points closer than `least` (m) to the one before; both ends stay.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polylines.operations import drop_repeats
    >>> drop_repeats(np.array([[0.0], [1e-9], [1.0], [1.0]]), 1e-6).tolist()
    [[0.0], [1.0]]
    """
    return np.asarray(points[distinct_points(points, least)])


def distinct_points(points: FloatArray, least: float) -> IntArray:
    """Give the numbers of the points that `drop_repeats` keeps."""
    step = np.diff(points, axis=0)
    keep = np.flatnonzero(np.append(True, (step * step).sum(axis=1) > least * least))
    if len(keep) > 1:
        keep[-1] = len(points) - 1
    return keep


def runs_where(held: NDArray[np.bool_]) -> IntArray:
    """Give first place and the one past the last (k, 2) of each run of places that hold.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polylines.operations import runs_where
    >>> runs_where(np.array([True, False, True, True])).tolist()
    [[0, 1], [2, 4]]
    """
    edges = np.diff(np.concatenate([[False], held, [False]]).astype(np.int8))
    return np.flatnonzero(edges).reshape(-1, 2)


def order_paths(edges: IntArray, count: int) -> list[tuple[IntArray, bool]]:
    """Put the edges of a graph in order: one path per chain, with whether it is closed.

    Parameters
    ----------
    edges : (e, 2) int
        Pairs of nodes; a node where three or more edges meet ends the chains that meet it.
    count : int
        Number of nodes.

    Returns
    -------
    list of ((k,) int, bool)
        Nodes in order; those of a closed path once.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polylines.operations import order_paths
    >>> [(path.tolist(), closed) for path, closed in order_paths(np.array([[2, 0], [1, 2]]), 3)]
    [([0, 2, 1], False)]
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components, depth_first_order

    if not len(edges):
        return []
    nodes, edges, origin = _split_branches(edges, count)
    ones = np.ones(len(edges), np.int8)
    graph = coo_array((ones, (edges[:, 0], edges[:, 1])), shape=(nodes, nodes)).tocsr()
    degree = np.bincount(edges.ravel(), minlength=nodes)
    _, label = connected_components(graph, directed=False)
    used = np.flatnonzero(degree > 0)
    # Per component the start: an end of the path where there is one, the lowest node else.
    order = used[np.lexsort((used, degree[used], label[used]))]
    starts = order[np.unique(label[order], return_index=True)[1]]
    both = (graph + graph.T).tocsr()
    found: list[tuple[IntArray, bool]] = []
    for start in starts.tolist():
        path = depth_first_order(both, start, directed=True, return_predecessors=False)
        found.append((origin[path.astype(np.int64)], bool(degree[start] == 2)))
    return found


def _split_branches(edges: IntArray, count: int) -> tuple[int, IntArray, IntArray]:
    """Give every edge its own copy of a node where three or more edges meet."""
    edges = np.unique(np.sort(edges, axis=1), axis=0)
    edges = edges[edges[:, 0] != edges[:, 1]]
    degree = np.bincount(edges.ravel(), minlength=count)
    flat = edges.ravel().copy()
    branch = np.flatnonzero(degree[flat] > 2)
    origin = np.concatenate([np.arange(count, dtype=np.int64), flat[branch]])
    flat[branch] = count + np.arange(len(branch))
    return len(origin), flat.reshape(-1, 2), origin


def self_crossings(start: FloatArray, end: FloatArray) -> FloatArray:
    """Give the places where segments of a plane cross that do not share an end, (k, 2), m.

    Parameters
    ----------
    start, end : (n, 2), m
        Both ends of each segment.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polylines.operations import self_crossings
    >>> bow_tie = np.array([[0.0, 0], [2, 2], [2, 0], [0, 2]])
    >>> self_crossings(bow_tie[:-1], bow_tie[1:]).tolist()
    [[1.0, 1.0]]
    """
    i, _, t = crossing_segments(start, end)
    return np.asarray(start[i] + t[:, None] * (end[i] - start[i]))


def crossing_segments(start: FloatArray, end: FloatArray) -> tuple[IntArray, IntArray, FloatArray]:
    """Give the pairs of segments that cross, (k,) each, and where on the first, 0 to 1.

    Arguments as for `self_crossings`.
    """
    i, j = _overlapping(start, end)
    along, beside = end[i] - start[i], end[j] - start[j]
    offset = start[j] - start[i]
    cross = along[:, 0] * beside[:, 1] - along[:, 1] * beside[:, 0]
    with np.errstate(invalid="ignore", divide="ignore"):
        t = (offset[:, 0] * beside[:, 1] - offset[:, 1] * beside[:, 0]) / cross
        u = (offset[:, 0] * along[:, 1] - offset[:, 1] * along[:, 0]) / cross
    margin = 1e-6
    inside = (t > margin) & (t < 1.0 - margin) & (u > margin) & (u < 1.0 - margin)
    return i[inside], j[inside], np.asarray(t[inside])


def _overlapping(start: FloatArray, end: FloatArray) -> tuple[IntArray, IntArray]:
    """Give the pairs of segments whose boxes overlap, found by a sweep along the longer side."""
    low, high = np.minimum(start, end), np.maximum(start, end)
    axis = int(np.argmax(np.ptp(low, axis=0))) if len(low) else 0
    order = np.argsort(low[:, axis], kind="stable")
    low, high = low[order], high[order]
    stop = np.searchsorted(low[:, axis], high[:, axis], side="right")
    first = np.arange(len(low))
    many = np.maximum(stop - first - 1, 0)
    i = np.repeat(first, many)
    j = i + 1 + np.arange(len(i)) - np.repeat(np.cumsum(many) - many, many)
    other = 1 - axis
    near = (low[j, other] <= high[i, other]) & (low[i, other] <= high[j, other])
    return order[i[near]], order[j[near]]


_MOST, _FEW = 6, 3
"""A polygon has so many corners at most; so many, where they may turn little."""


@attrs.frozen
class PolygonRule:
    """What counts as a polygon.

    Attributes
    ----------
    off : float, m
        Points this near to the line between two corners lie on it.
    least : float, m
        Length of a side, at least.
    turn_deg : float
        What a corner turns by, at least.
    long, slight_deg : float, m and degrees
        The same of few long sides, which may turn less: the rakes of a barge.
    close, reach, spaced : float, m
        Points that fill a side stand so close up to so far from its corners, else so far apart.
    """

    off: float = 1e-4
    least: float = 0.3
    turn_deg: float = 10.0
    long: float = 3.0
    slight_deg: float = 4.0
    close: float = 0.1
    reach: float = 1.5
    spaced: float = 2.0


def polygon_corners(points: FloatArray, rule: PolygonRule) -> IntArray | None:
    """Give the corners (k,) of a polyline (n, d), m, that is a polygon, its ends not among them.

    None where it is none: a curve, or without a corner.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polylines.operations import PolygonRule, polygon_corners
    >>> bent = np.array([[0.0, 0.0], [3.0, 0.0], [6.0, 0.0], [6.0, 4.0]])
    >>> polygon_corners(bent, PolygonRule()).tolist()
    [2]
    """
    kept = np.array(_chorded(points, rule.off), np.int64)
    if not 3 <= len(kept) <= _MOST + 2:
        return None
    side = np.diff(points[kept], axis=0)
    length = np.sqrt((side * side).sum(axis=1))
    if length.min() < rule.least:
        return None
    unit = side / length[:, None]
    turn = np.arccos(np.clip((unit[1:] * unit[:-1]).sum(axis=1), -1.0, 1.0))
    few = length.min() >= rule.long and len(turn) <= _FEW
    least = np.deg2rad(rule.slight_deg if few else rule.turn_deg)
    return kept[1:-1] if turn.min() >= least else None


def _chorded(points: FloatArray, within: float) -> list[int]:
    """Give the points between which the chords pass all others within a distance, m."""
    kept, open_ends = [0], [len(points) - 1]
    while open_ends:
        if len(kept) > _MOST + 2:
            return kept
        low, high = kept[-1], open_ends[-1]
        along = points[high] - points[low]
        size = max(float(along @ along), 1e-300)
        off = points[low : high + 1] - points[low]
        part = np.clip(off @ along / size, 0.0, 1.0)
        away = off - part[:, None] * along
        away = np.sqrt((away * away).sum(axis=1))
        far = int(away.argmax())
        if away[far] > within:
            open_ends.append(low + far)
        else:
            kept.append(open_ends.pop())
    return kept


def filled_polygon(
    points: FloatArray, corners: IntArray, values: FloatArray, rule: PolygonRule
) -> tuple[FloatArray, FloatArray]:
    """Put points on the sides of a polygon, closer near its corners; with values (n,) at each."""
    at = cumulative_lengths(points)
    edges = at[[0, *corners.tolist(), len(points) - 1]]
    near = rule.close * np.arange(1.0, np.rint(rule.reach / rule.close) + 1.0)
    found = [at, np.arange(rule.spaced, at[-1], rule.spaced)]
    found += [edge + sign * near for edge in edges.tolist() for sign in (-1.0, 1.0)]
    wanted = np.sort(np.concatenate(found))
    wanted = wanted[(wanted >= 0.0) & (wanted <= at[-1])]
    # Given points stay to the bit; what would crowd them is left out.
    gap = np.abs(wanted[:, None] - at).min(axis=1)
    extra = wanted[gap > 0.5 * rule.close]
    extra = extra[np.diff(extra, prepend=-np.inf) > 0.5 * rule.close]
    places = np.concatenate([at, extra])
    order = np.argsort(places, kind="stable")
    every = np.concatenate([points, resample(points, extra)])
    return every[order], np.concatenate([values, np.interp(extra, at, values)])[order]
