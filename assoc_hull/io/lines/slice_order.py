"""Points out of order, lines that cross themselves, joins and gaps: mended or named.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.offset_report import Notebook
>>> from assoc_hull.io.lines.slice_order import put_in_order
>>> book = Notebook()
>>> line = np.array([[0.0, 0, 0], [2, 1, 0], [1, 0.4, 0], [3, 1.8, 0], [4, 3, 0]])
>>> put_in_order("WL 0", line, book)[:, 0].tolist()
[0.0, 1.0, 2.0, 3.0, 4.0]
>>> print(book.report().repairs[0])
order: WL 0: turned back at (2, 1, 0) m; 2 of 5 points put in order along the line
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.polylines.operations import order_paths, self_crossings
from assoc_hull.io.lines.slices import Join, Piece
from assoc_hull.io.offset_report import Notebook

__all__ = ["put_in_order", "tell_crossings", "tell_joins"]

_BACK = np.cos(np.deg2rad(135.0))
"""A line that turns by more than this between two points turns back."""

_STEP = 1e-4
"""Steps shorter than this part of the extent may turn back by noise."""

_MOST = 3000
"""Longer pieces are not put in order: their points are too many to be compared in pairs."""


def put_in_order(name: str, points: FloatArray, book: Notebook) -> FloatArray:
    """Put the points of a piece in order where the line turns back and one order is plain.

    The order is plain where joining each point with its nearest ones gives a single path that
    turns back nowhere.

    Parameters
    ----------
    name : str
        The line.
    points : (n, 3), m
        As given, none twice in a row.
    book : Notebook
        Takes what was mended, or the place where the line turns back.
    """
    back = _turns_back(points)
    if not len(back):
        return points
    x, y, z = points[back[0]].tolist()
    where = f"turned back at ({x:.4g}, {y:.4g}, {z:.4g}) m"
    order = _path(points) if len(points) <= _MOST else None
    if order is not None and not len(_turns_back(points[order])):
        moved = int((order != np.arange(len(points))).sum())
        what = f"{where}; {moved} of {len(points)} points put in order along the line"
        book.repair("order", name, what, moved)
        return np.asarray(points[order])
    what = (
        f"{where} and at {len(back) - 1} places more; no one order is plain, left as it is: "
        "give the points in order along the line, and a piece for each branch"
    )
    book.suspect("order", name, what, len(back))
    return points


def _turns_back(points: FloatArray) -> IntArray:
    """Give the points at which a line turns back."""
    step = np.diff(points, axis=0)
    length = np.sqrt((step * step).sum(axis=1))
    least = _STEP * float(np.ptp(points, axis=0).max(initial=0.0))
    ahead = step / np.maximum(length, 1e-300)[:, None]
    cosine = (ahead[1:] * ahead[:-1]).sum(axis=1)
    long = np.minimum(length[1:], length[:-1]) > least
    return np.asarray(np.flatnonzero((cosine < _BACK) & long) + 1)


def _path(points: FloatArray) -> IntArray | None:
    """Give the order along the shortest tree that joins all points, if it does not branch."""
    from scipy.sparse.csgraph import minimum_spanning_tree
    from scipy.spatial.distance import cdist

    tree = minimum_spanning_tree(cdist(points, points)).tocoo()
    edges = np.column_stack([tree.row, tree.col]).astype(np.int64)
    if len(edges) != len(points) - 1 or np.bincount(edges.ravel()).max() > 2:
        return None
    ((order, _),) = order_paths(edges, len(points))
    return order if np.flatnonzero(order == 0)[0] < 0.5 * len(order) else order[::-1].copy()


def tell_crossings(name: str, pieces: list[Piece], axis: int, book: Notebook) -> None:
    """Tell of a line that crosses itself, with the first place.

    Parameters
    ----------
    name : str
        The line.
    pieces : list of Piece
        In the plane where coordinate `axis` is constant.
    axis : int
        0, 1 or 2.
    book : Notebook
        Takes what was found.
    """
    plane = [other for other in range(3) if other != axis]
    start = np.concatenate([piece.points[:-1, plane] for piece in pieces])
    end = np.concatenate([piece.points[1:, plane] for piece in pieces])
    places = self_crossings(start, end)
    if len(places):
        letters = " ".join(f"{'xyz'[a]} = {v:.4g}" for a, v in zip(plane, places[0], strict=True))
        what = f"the line crosses itself {len(places)} times, first at {letters} m"
        book.suspect("self-crossing", name, what, len(places))


def tell_joins(joins: list[Join], book: Notebook) -> None:
    """Tell how many ends were joined across gaps, and the widest of these.

    Parameters
    ----------
    joins : list of Join
        Those that were made.
    book : Notebook
        Takes them as one repair.
    """
    wide = [join for join in joins if join.gap > 5e-3]
    if joins:
        widest = max(joins, key=lambda each: each.gap)
        what = (
            f"{len(joins)} joins, {len(wide)} of them over 5 mm, the widest "
            f"{1e3 * widest.gap:.3g} mm in {widest.line}"
        )
        book.repair("join", "the lines", what, widest.gap)
