"""Outlines of bodies beside the net on a lines plan: what of them stands to port."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.attached_body import AttachedBody

__all__ = ["drawn_outlines"]


def drawn_outlines(body: AttachedBody) -> Iterator[FloatArray]:
    """Give the polylines (n, 3), m, of a body on the side that a plan shows.

    A body that stands to starboard alone is drawn in its mirror image.
    """
    mirrored = bool((body.points[..., 1] <= 0.0).all())
    for points in body.outlines.values():
        yield from _to_port(points * [1.0, -1.0, 1.0] if mirrored else points)


def _to_port(points: FloatArray) -> Iterator[FloatArray]:
    """Give the pieces of a polyline (n, 3) with y not below 0."""
    y = points[:, 1]
    crossed = np.flatnonzero(y[:-1] * y[1:] < 0.0)
    part = y[crossed] / (y[crossed] - y[crossed + 1])
    cuts = points[crossed] + part[:, None] * (points[crossed + 1] - points[crossed])
    cuts[:, 1] = 0.0
    every = np.insert(points, crossed + 1, cuts, axis=0)
    keep = np.concatenate([[False], 0.5 * (every[1:, 1] + every[:-1, 1]) >= 0.0, [False]])
    begins, ends = np.flatnonzero(~keep[:-1] & keep[1:]), np.flatnonzero(keep[:-1] & ~keep[1:])
    for begin, end in zip(begins.tolist(), ends.tolist(), strict=True):
        yield every[begin : end + 1]
