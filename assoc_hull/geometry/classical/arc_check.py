"""How far chains of arcs and the curves they stand for lie apart, both ways, densely sampled.

What is given is never too small: the distance to a link is that to its own arcs, and a place on an
arc is as far from the curve as from the foot that was found.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.classical.arc_links import Links
from assoc_hull.geometry.classical.arc_pieces import Pieces
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["Apart", "apart"]

_STEPS = 4


@attrs.frozen(eq=False)
class Apart:
    """Largest distances per link.

    Attributes
    ----------
    curve : (n,), m
        Of places on the curve from the arcs.
    arcs : (n,), m
        Of places on the arcs from the curve.
    w : (n,)
        The place on the curve that is farthest.
    """

    curve: FloatArray
    arcs: FloatArray
    w: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.curve, self.arcs, self.w)

    @property
    def most(self) -> FloatArray:
        """The larger of both, (n,), m."""
        return np.asarray(np.maximum(self.curve, self.arcs))


def apart(pieces: Pieces, links: Links, samples: int) -> Apart:
    """Measure links against their stretches of the curves, at so many places each way."""
    if not len(links.piece):
        return Apart(np.zeros(0), np.zeros(0), np.zeros(0))
    w = _places(links, samples)
    piece = links.piece[:, None]
    places = pieces.at(piece, w)
    off = _from_arcs(links, places)
    row, worst = np.arange(len(w)), np.argmax(off, axis=1)
    return Apart(off[row, worst], _from_curve(pieces, links, w, places), w[row, worst])


def _places(links: Links, samples: int) -> FloatArray:
    """Give parameters along the links, (n, samples), points of the curves among them.

    Cubics may be of very different lengths: what lies between two parameters belongs to one.
    """
    step = (links.high - links.low)[:, None] / (samples - 1)
    w = links.low[:, None] + step * np.arange(samples)
    w[:, -1] = links.high
    whole = np.round(w)
    near = np.abs(w - whole) <= 0.5 * step
    near[:, [0, -1]] = False
    w[near] = whole[near]
    # The ends stay; a point of the curve beside one takes the place next to it.
    for end, beside, point in ((0, 1, np.ceil(w[:, 0])), (-1, -2, np.floor(w[:, -1]))):
        gap = np.abs(point - w[:, end])
        close = (gap > 0.0) & (gap <= 0.5 * step[:, 0])
        w[close, beside] = point[close]
    return w


def _from_arcs(links: Links, places: FloatArray) -> FloatArray:
    """Give the distances of places, (n, k, 2), from the arcs of their links, (n, k)."""
    flat = places.reshape(-1, 2)
    found = [
        links.arcs.distance(np.repeat(links.arc[:, end], places.shape[1]), flat) for end in (0, 1)
    ]
    return np.asarray(np.minimum(*found).reshape(places.shape[:2]))


def _from_curve(pieces: Pieces, links: Links, w: FloatArray, places: FloatArray) -> FloatArray:
    """Give the largest distance of places on the arcs of each link from its curve, (n,), m."""
    count = w.shape[1]
    length = links.arcs.length
    first, last = links.arc.T
    whole = np.where(first == last, length[first], length[first] + length[last])
    t = whole[:, None] * np.linspace(0.0, 1.0, count)
    behind = (t > length[first][:, None]) & (first != last)[:, None]
    arc = np.where(behind, last[:, None], first[:, None])
    on = np.where(behind, t - length[first][:, None], t)
    q = links.arcs.at(arc.ravel(), on.ravel()).reshape(*t.shape, 2)
    # Arcs and curve run side by side: the same part of the way is a good guess of the foot.
    step = np.diff(places, axis=1)
    run = np.concatenate(
        [np.zeros((len(w), 1)), np.cumsum(np.hypot(step[..., 0], step[..., 1]), axis=1)], axis=1
    )
    run /= run[:, -1:]
    shift = 2.0 * np.arange(len(w))[:, None]
    part = (t / whole[:, None] + shift).ravel()
    foot = np.interp(part, (run + shift).ravel(), w.ravel()).reshape(t.shape)
    # From there by no more than a place to either side: beyond a point all is of another length.
    number = np.searchsorted((run + shift).ravel(), part, "right") - 1
    own = number.reshape(t.shape) - count * np.arange(len(w))[:, None]
    low, high = (np.take_along_axis(w, np.clip(own + by, 0, count - 1), axis=1) for by in (-1, 2))
    piece = np.broadcast_to(links.piece[:, None], t.shape)
    least = np.full(t.shape, np.inf)
    for step_number in range(_STEPS + 1):
        away = pieces.at(piece, foot) - q
        least = np.minimum(least, np.hypot(away[..., 0], away[..., 1]))
        if step_number == _STEPS:
            break
        slope = pieces.slope(piece, foot)
        gain = (away * slope).sum(axis=-1) / np.maximum((slope * slope).sum(axis=-1), 1e-300)
        foot = np.clip(foot - gain, low, high)
    return np.asarray(least.max(axis=1))
