"""The curve of a section of ordinates, from the centre line up, step by step as parabolas."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.classical.paired_parabolas import PairedParabolas
from assoc_hull.geometry.curves import FloatArray

__all__ = ["outline_steps"]

_NOTHING = 1e-9
"""A step shorter than this, m, is none."""


def outline_steps(
    bottom: PairedParabolas | None, side: PairedParabolas, deck: float, keel: float
) -> FloatArray:
    """Give the steps from one given point to the next, (k, 3, 2): p(u) = c0 + c1 u + c2 u^2.

    Parameters
    ----------
    bottom : PairedParabolas or None
        Height over y, m.
    side : PairedParabolas
        Half-breadth over z, m.
    deck : float, m
        Height at which the side ends.
    keel : float, m
        Height on the centre line.

    Returns
    -------
    (k, 3, 2)
        Coefficients of (y, z) in m, with u from 0 to 1; the joining line has no c2.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.ordinate_outline import outline_steps
    >>> from assoc_hull.geometry.classical.paired_parabolas import PairedParabolas
    >>> side = PairedParabolas.make("side", 0.0, 2.0, [3, 4, 5])
    >>> outline_steps(None, side, 3.0, 0.0)[:, 0].tolist()
    [[0.0, 0.0], [3.0, 0.0], [4.0, 2.0]]
    """
    parts = [_side_steps(side, deck)]
    foot = np.array([0.0, keel])
    if bottom is not None:
        rising = bottom.coefficients()
        across = np.zeros_like(rising)
        across[:, 0], across[:, 1] = bottom.places[:-1], bottom.step
        parts.insert(0, np.stack([across, rising], axis=2))
        foot = np.array([bottom.last, bottom.values[-1]])
    close = parts[-1][0, 0] - foot
    if np.hypot(*close) > _NOTHING:
        parts.insert(-1, np.stack([foot, close, np.zeros(2)])[None])
    return np.concatenate(parts)


def _side_steps(side: PairedParabolas, deck: float) -> FloatArray:
    """Cut the steps of the side off at the deck."""
    begin = side.places[:-1]
    used = begin < deck - _NOTHING
    part = np.minimum((deck - begin[used]) / side.step, 1.0)
    breadth = side.coefficients()[used] * part[:, None] ** np.arange(3)
    upward = np.zeros_like(breadth)
    upward[:, 0], upward[:, 1] = begin[used], side.step * part
    return np.stack([breadth, upward], axis=2)
