"""B-spline curves as they come from drawings of other programs: of any degree, rational or not.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.spline_curve import SplineCurve
>>> knots, points = np.array([0.0, 0, 0, 1, 1, 1]), np.array([[0.0, 0, 0], [1, 2, 0], [2, 0, 0]])
>>> curve = SplineCurve("arch", 2, knots, points)
>>> curve.at(np.array([0.5])).tolist()
[[1.0, 1.0, 0.0]]
>>> len(curve.polyline(0.01))
11
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.patches.knots import (
    bezier_pieces,
    blossom,
    cut_spline,
    knot_domain,
    span_at,
    span_limits,
)

__all__ = ["SplineCurve"]

_MOST = 64
"""A span is drawn in no more pieces."""

_TURN = 1e-3
"""Legs of control points that turn by more (rad) at a full knot make a knuckle."""


@attrs.frozen(eq=False)
class SplineCurve:
    """A B-spline curve; what made it has checked its knots.

    Attributes
    ----------
    name : str
        Its name; curves of one line share it.
    degree : int
        Of its pieces.
    knots : (k + degree + 1,)
        Not falling.
    points : (k, 3), m
        Control points.
    weights : (k,) or None
        Above 0; None for a polynomial curve.
    """

    name: str
    degree: int
    knots: FloatArray
    points: FloatArray
    weights: FloatArray | None = None

    def __attrs_post_init__(self) -> None:
        freeze(self.knots, self.points, *([] if self.weights is None else [self.weights]))

    @property
    def domain(self) -> tuple[float, float]:
        """The least and the greatest parameter."""
        return knot_domain(self.knots, self.degree)

    def _homogeneous(self) -> FloatArray:
        if self.weights is None:
            return self.points
        weights = self.weights[:, None]
        return np.concatenate([self.points * weights, weights], axis=1)

    def at(self, t: FloatArray) -> FloatArray:
        """Give the points (n, 3) at parameters (n,) in the domain."""
        span = span_at(self.knots, self.degree, t)
        local = self._homogeneous()[span[:, None] + np.arange(-self.degree, 1)]
        found = blossom(local, self.knots, self.degree, span, np.repeat(t[:, None], self.degree, 1))
        return found if self.weights is None else np.asarray(found[:, :3] / found[:, 3:])

    def restricted(self, low: float, high: float) -> SplineCurve:
        """Give the part between two parameters, by knot insertion."""
        points, knots = cut_spline(self._homogeneous(), self.knots, self.degree, low, high)
        if self.weights is None:
            return attrs.evolve(self, knots=knots, points=points)
        weights = points[:, 3].copy()
        return attrs.evolve(
            self, knots=knots, points=points[:, :3] / points[:, 3:], weights=weights
        )

    def polyline(self, chord: float) -> FloatArray:
        """Give points (n, 3) on the curve, all knots among them, that leave it by about `chord`, m.

        A span is cut into equal parts, as many as second differences of its control points ask
        for, and 64 at most.
        """
        polygon = bezier_pieces(self.points, self.knots, self.degree)
        second = np.linalg.norm(np.diff(polygon, 2, axis=1), axis=2).max(axis=1, initial=0.0)
        needed = np.sqrt(0.125 * self.degree * (self.degree - 1) * second / chord)
        many = np.clip(np.ceil(needed), 1, _MOST).astype(np.int64)
        ends = span_limits(self.knots, self.degree)
        span = np.repeat(np.arange(len(many)), many)
        part = (np.arange(len(span)) - (np.cumsum(many) - many)[span]) / many[span]
        t = ends[span, 0] * (1.0 - part) + ends[span, 1] * part
        return self.at(np.append(t, ends[-1, 1]))

    def knuckles(self) -> FloatArray:
        """Give the places (k, 3) within the curve where its direction jumps, m."""
        d, knots = self.degree, self.knots
        inner = np.arange(1, len(self.points) - 1)
        full = inner[knots[inner + 1] == knots[inner + d]]
        legs = np.diff(self.points, axis=0)
        before, behind = legs[full - 1], legs[full]
        sine = np.linalg.norm(np.cross(before, behind), axis=1)
        turn = np.arctan2(sine, np.einsum("ij,ij->i", before, behind))
        return np.asarray(self.points[full[turn > _TURN]])
