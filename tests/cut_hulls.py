"""The surface of a plain half hull, cut into blocks as nets are: also where three of them meet."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface

LENGTH, HALF_BREADTH, DEPTH = 100.0, 8.0, 12.0


def half_hull() -> SplineSurface:
    """A half hull in one surface: u from the stem aft, v from the keel to the deck edge.

    Keel and stem lie on the centre plane, the stern ends in a transom; normals point out.
    """
    along, up = np.linspace(1.0, 0.0, 14), np.linspace(0.0, 1.0, 9)
    full = np.sqrt(1.0 - along**4)
    round_bilge = np.minimum(1.0, 1.6 * np.sqrt(up))
    net = np.zeros((14, 9, 3))
    net[..., 0] = LENGTH * along[:, None] + 4.0 * up * along[:, None] ** 8
    net[..., 1] = HALF_BREADTH * full[:, None] * round_bilge
    net[..., 2] = DEPTH * up**1.5
    return SplineSurface("hull", (3, 3), knots(LENGTH, 11), knots(20.0, 6), net)


def knots(end: float, spans: int) -> FloatArray:
    """Knots of a cubic spline, equally spaced."""
    inner = np.linspace(0.0, end, spans + 1)[1:-1]
    return np.concatenate([np.zeros(4), inner, np.full(4, end)])


def three_blocks() -> list[SplineSurface]:
    """The stern, and beside it the lower and the upper part of all before: a joint like a T."""
    whole = half_hull()
    return [
        whole.restricted((58.0, 100.0), (0.0, 20.0), "stern"),
        whole.restricted((0.0, 58.0), (0.0, 8.0), "bow, below"),
        whole.restricted((0.0, 58.0), (8.0, 20.0), "bow, above"),
    ]
