"""Folds beyond the hull: harmless to it, but worth a warning."""

from __future__ import annotations

import math

from numpy.typing import ArrayLike

from assoc_hull.arguments import places
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.certificate.certify import certify
from assoc_hull.variation.certificate.record import Certificate
from assoc_hull.variation.fields.layer import Layer
from assoc_hull.variation.fields.space_map import VMap

__all__ = ["fold_outside"]

_BEYOND = 0.25
"""Where a region has no end, so much of the box's own extent is looked at."""


def fold_outside(what: VMap | Layer, box: ArrayLike) -> Certificate | None:
    """Tell whether a map that is certified in the hull's box folds in its regions beyond.

    Parameters
    ----------
    what : VMap or Layer
    box : (2, 3), m
        Least and greatest coordinates of the hull.

    Returns
    -------
    Certificate or None
        Of a fold outside the box; None if there is none.

    Examples
    --------
    >>> from assoc_hull.variation.fields.piecewise_linear import Chain
    >>> from assoc_hull.variation.fields.fields_layer import FieldLayer
    >>> from assoc_hull.variation.certificate.fold_outside import fold_outside
    >>> from assoc_hull.variation.fields.hat import hat
    >>> deck = hat("deck", [("T", 18, 0), ("deck", 28, 2), ("mast", 30, 0)], Chain.constant(1.0))
    >>> layer = FieldLayer("local", (deck,))
    >>> fold_outside(layer, [[0, -25, 0], [300, 25, 27]]).reason
    'folds'
    """
    corners = places(box, "box", "in certify")
    wide = _reach(what, corners)
    if (wide == corners).all():
        return None
    found = certify(what, wide, least=0.0)
    return found if found.reason == "folds" else None


def _reach(what: VMap | Layer, box: FloatArray) -> FloatArray:
    """Give the box that holds the hull's and all regions."""
    wide = box.copy()
    size = _BEYOND * (box[1] - box[0])
    for region in what.regions():
        for axis, (low, high) in ((0, region.x), (2, region.z)):
            if low > high:
                continue
            wide[0, axis] = min(wide[0, axis], _end(low, float(box[0, axis] - size[axis])))
            wide[1, axis] = max(wide[1, axis], _end(high, float(box[1, axis] + size[axis])))
    return wide


def _end(place: float, instead: float) -> float:
    return place if math.isfinite(place) else instead
