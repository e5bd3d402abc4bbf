"""How a surface lies over its parameters: elements of area, folds, corners without a normal.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.fitting.folds import surface_elements
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> net = np.zeros((4, 4, 3))
>>> net[..., 0], net[..., 1] = np.mgrid[0:4, 0:4]
>>> knots = [0, 0, 0, 0, 3, 3, 3, 3]
>>> found = surface_elements(SplineSurface("plane", (3, 3), knots, knots, net))
>>> round(found.least, 9), len(found.folded)
(1.0, 0)
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.fitting.foot_points import derivatives
from assoc_hull.geometry.patches.knots import span_limits
from assoc_hull.geometry.patches.spline_surface import SplineSurface

__all__ = ["SurfaceElements", "surface_elements"]

_PART = 4
"""Places a span each way."""

_SINGULAR = 0.1
"""A corner whose element is less than this part of the median has sides that are tangent."""


@attrs.frozen(eq=False)
class SurfaceElements:
    """Normals of a surface on a grid of places, borders among them.

    Attributes
    ----------
    u, v : (m,), (n,), m
        Parameters of the grid.
    normal : (m, n, 3)
        S_u x S_v.
    median : float
        The median of its size.
    least : float
        The least of its size, as a part of the median.
    place : (float, float), m
        Parameters of that place.
    folded : (f, 2), m
        Places whose normal turns by more than 90 degrees to that of a neighbour on the grid.
    singular : tuple of (float, float)
        Corners at which the element is below a tenth of the median: their sides are tangent.
    """

    u: FloatArray
    v: FloatArray
    normal: FloatArray
    median: float
    least: float
    place: tuple[float, float]
    folded: FloatArray
    singular: tuple[tuple[float, float], ...]

    def __attrs_post_init__(self) -> None:
        freeze(self.u, self.v, self.normal, self.folded)


def surface_elements(surface: SplineSurface, part: int = _PART) -> SurfaceElements:
    """Measure a bicubic surface on a grid of some places a span.

    Parameters
    ----------
    surface : SplineSurface
        A bicubic B-spline.
    part : int
        Places a span each way.

    Raises
    ------
    BadInputError
        Weights, or degrees other than 3.
    """
    u, v = (_places(span_limits(knots, 3), part) for knots in (surface.knots_u, surface.knots_v))
    uv = np.stack(np.meshgrid(u, v, indexing="ij"), axis=-1)
    _, along, across = derivatives(surface, uv.reshape(-1, 2))
    normal = np.cross(along, across).reshape(len(u), len(v), 3)
    size = np.sqrt((normal * normal).sum(axis=-1))
    median = float(np.median(size))
    worst = np.unravel_index(int(np.argmin(size)), size.shape)
    at = float(u[worst[0]]), float(v[worst[1]])
    corners = tuple(
        (float(u[i]), float(v[j])) for i in (0, -1) for j in (0, -1)
        if size[i, j] < _SINGULAR * median
    )  # fmt: skip
    least = float(size[worst]) / median if median > 0.0 else 0.0
    return SurfaceElements(u, v, normal, median, least, at, uv[_turned(normal)], corners)


def _places(spans: FloatArray, part: int) -> FloatArray:
    """Give `part` places a span, and the last end."""
    share = np.arange(part) / part
    low, high = spans[:, :1], spans[:, 1:]
    return np.append((low + share * (high - low)).ravel(), spans[-1, 1])


def _turned(normal: FloatArray) -> np.typing.NDArray[np.bool_]:
    """Say where a normal turns by more than a right angle to the next, in u or in v."""
    found = np.zeros(normal.shape[:2], np.bool_)
    found[1:] |= (normal[1:] * normal[:-1]).sum(axis=-1) < 0.0
    found[:, 1:] |= (normal[:, 1:] * normal[:, :-1]).sum(axis=-1) < 0.0
    return found
