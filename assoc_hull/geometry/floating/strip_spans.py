"""Where along the ship strips lie, and at which v a plane across the ship meets them."""

from __future__ import annotations

from functools import cached_property

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.floating.prepared_strips import Prepared
from assoc_hull.geometry.floating.raked import Raked, raked

__all__ = ["Spans", "level_at", "spans"]

_FLAT = 1e-9
"""m: curves that leave their planes by less lie in them."""

_CLOSE = 1e-12
"""Of how far a strip lies from AP: rounding."""

_TRIALS = 60

_BEZIER = np.array([[1.0, 0, 0, 0], [1.0, 1 / 3, 0, 0], [1.0, 2 / 3, 1 / 3, 0], [1.0, 1, 1, 1]])


@attrs.frozen(eq=False)
class Spans:
    """How far the strips of a body reach along the ship, (n,) each.

    Attributes
    ----------
    prepared : Prepared
        The body.
    aft, fore : m
        Least and greatest x.
    flat : bool
        All curves v = const lie in planes across the ship.
    """

    prepared: Prepared
    aft: FloatArray
    fore: FloatArray
    flat: NDArray[np.bool_]

    def __attrs_post_init__(self) -> None:
        freeze(self.aft, self.fore, self.flat)

    @cached_property
    def near(self) -> FloatArray:
        """So near to one another places on a strip cannot be told apart, (n,), m."""
        found: FloatArray = _CLOSE * np.maximum(np.abs(self.aft), np.abs(self.fore))
        return found

    @cached_property
    def raked(self) -> dict[int, Raked]:
        """The strips that are not flat and lie between two places."""
        rest = np.flatnonzero(~self.flat & (self.fore > self.aft + _FLAT))
        return {strip: raked(self.prepared.strips, strip) for strip in rest.tolist()}


def spans(prepared: Prepared) -> Spans:
    """Give how far strips reach, as the curves tell on which they are integrated.

    Parameters
    ----------
    prepared : Prepared
        The strips.
    """
    tiles, count = prepared.tiles, prepared.strips.count
    strip = prepared.strip[tiles.curve]
    control = _BEZIER @ tiles.coefficients[0]
    aft, fore = np.full(count, np.inf), np.full(count, -np.inf)
    np.minimum.at(aft, strip, control.min(axis=0))
    np.maximum.at(fore, strip, control.max(axis=0))
    begin = tiles.coefficients[0, 0, tiles.start[tiles.curve]]
    lean = np.abs(tiles.coefficients[::3, 1:]).max(axis=(0, 1)) > _FLAT
    lean |= np.abs(tiles.coefficients[0, 0] - begin) > _FLAT
    return Spans(prepared, aft, fore, np.bincount(strip, lean, count) == 0.0)


def level_at(body: Spans, strip: IntArray, x: FloatArray | float) -> FloatArray:
    """Give the v at which flat strips (k,) stand at places in them, (k,) or one for all."""
    strips, begin, end = body.prepared.strips, body.aft[strip], body.fore[strip]
    low, high = np.zeros(len(strip)), np.ones(len(strip))
    v = np.clip((x - begin) / (end - begin), 0.0, 1.0)
    for _ in range(_TRIALS):
        curves = strips.curves(strip, v)
        first = curves.start[:-1]
        over = curves.point[first, 0, 0] - x
        if (np.abs(over) <= body.near[strip]).all():
            break
        low, high = np.where(over < 0.0, v, low), np.where(over > 0.0, v, high)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = v - over / curves.across[first, 0, 0]
        v = np.where((step >= low) & (step <= high), step, 0.5 * (low + high))
    return v
