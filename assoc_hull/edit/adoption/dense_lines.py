"""Where a densely given line takes another point: amid an interval, never beside a point.

A digitised line has many more points than should define a curve. Taken where the curve passes
them worst, they would come to lie in close pairs; so one is taken from the middle of the
interval in question, and none where the interval is short.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = ["amid", "near", "room", "sharp"]

BoolArray = np.typing.NDArray[np.bool_]

_FOLD = 0.2
"""Chords whose directions have a smaller cosine are taken for a fold."""

_SHORTEST = 0.02
"""No point is set in an interval shorter than this (m)."""


def room(edges: FloatArray, at: FloatArray, spacing: float) -> BoolArray:
    """Say which given points lie in an interval that has room for another point.

    Parameters
    ----------
    edges : (k,), m
        Parameters of the defining points, ascending.
    at : (n,), m
        Parameters of the given points.
    spacing : float, m
        Least length of an interval.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.edit.adoption.dense_lines import room
    >>> room(np.array([0.0, 0.1, 5.0]), np.array([0.05, 2.0]), 0.2).tolist()
    [False, True]
    """
    number = np.searchsorted(edges, at).clip(1, len(edges) - 1)
    return np.asarray(edges[number] - edges[number - 1] >= spacing)


def sharp(known: FloatArray, edges: FloatArray, at: FloatArray, knuckle: BoolArray) -> int:
    """Give a given point beside a smooth place where the chords turn so much as to fold.

    Parameters
    ----------
    known : (k, 3), m
        The defining points.
    edges : (k,), m
        Their parameters.
    at : (n,), m
        Parameters of the given points.
    knuckle : (k,) bool
        Which of the defining points may turn as they like.

    Returns
    -------
    int
        -1 if the chords turn nowhere so much.
    """
    step = np.diff(known, axis=0)
    step = step / np.maximum(np.linalg.norm(step, axis=1), 1e-12)[:, None]
    cosine = (step[1:] * step[:-1]).sum(axis=1)
    for i in np.flatnonzero((cosine < _FOLD) & ~knuckle[1:-1]).tolist():
        wide = i if edges[i + 1] - edges[i] > edges[i + 2] - edges[i + 1] else i + 1
        low, high = float(edges[wide]), float(edges[wide + 1])
        inside = _inside(at, low, high)
        if len(inside) and high - low > _SHORTEST:
            return int(inside[len(inside) // 2])
    return -1


def amid(edges: FloatArray, at: FloatArray, point: int) -> tuple[int, float, float]:
    """Give a given point for the interval of one that is passed badly.

    Parameters
    ----------
    edges : (k,), m
        Parameters of the defining points.
    at : (n,), m
        Parameters of the given points.
    point : int
        The given point that is passed badly.

    Returns
    -------
    point : int
        The given point nearest to it in the middle part of the interval.
    target, reach : float, m
        Where a point is wanted; a crossing within the reach will do as well.
    """
    here = float(at[point])
    low = float(edges[edges <= here].max(initial=-np.inf))
    high = float(edges[edges >= here].min(initial=np.inf))
    low, high = (here if not np.isfinite(end) else end for end in (low, high))
    target = min(max(here, low + 0.3 * (high - low)), high - 0.3 * (high - low))
    inside = _inside(at, low, high)
    if len(inside):
        point = int(inside[np.argmin(np.abs(at[inside] - target))])
    return point, target, 0.2 * (high - low)


def near(edges: FloatArray, at: FloatArray, place: float, spacing: float) -> int:
    """Give a given point by which a curve can be held at a place; -1 if there is no room.

    Parameters
    ----------
    edges : (k,), m
        Parameters of the defining points, ascending.
    at : (n,), m
        Parameters of the given points.
    place : float, m
        Parameter of the place.
    spacing : float, m
        Least length of an interval.
    """
    above = int(np.searchsorted(edges, place).clip(1, len(edges) - 1))
    low, high = float(edges[above - 1]), float(edges[above])
    inside = _inside(at, low, high)
    if high - low < spacing or not len(inside):
        return -1
    return int(inside[np.argmin(np.abs(at[inside] - place))])


def _inside(at: FloatArray, low: float, high: float) -> np.typing.NDArray[np.int64]:
    quarter = 0.25 * (high - low)
    return np.flatnonzero((at > low + quarter) & (at < high - quarter))
