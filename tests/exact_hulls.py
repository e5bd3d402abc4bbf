"""Hulls known by formulas, as strips: Wigley's, an ellipsoid and a box.

On every tile P and P_v are cubics without error (Wigley, box) or to 1e-10 (ellipsoid). No
net, no loft: what is tested with them is the integration alone.
"""

from __future__ import annotations

from functools import cached_property

import attrs
import numpy as np
from numpy.polynomial import Polynomial

from assoc_hull.geometry.curves import FloatArray, IntArray, IsoCurves

__all__ = ["FormStrips", "box", "ellipsoid", "wigley"]


@attrs.frozen
class ExactStrips:
    """One strip from aft to forward: x(v), and tiles whose y and z scale along v.

    y = breadth(v) * eta(u), z = base + depth(v) * zeta(u), tile by tile.
    """

    eta: FloatArray
    zeta: FloatArray
    deck: tuple[bool, ...]
    base: float
    points: int
    kind: str

    @property
    def count(self) -> int:
        return 1

    @property
    def order(self) -> IntArray:
        return np.array([self.points])

    def curves(self, strip: IntArray, v: FloatArray) -> IsoCurves:
        """Curves at v."""
        assert not strip.any()
        (x, x_v), (breadth, breadth_v), (depth, depth_v) = self._shape(v)
        size = len(self.eta)
        point, across = np.zeros((2, len(v), size, 4, 3))
        point[:, :, 0, 0], across[:, :, 0, 0] = x[:, None], x_v[:, None]
        point[..., 1], across[..., 1] = _times(breadth, self.eta), _times(breadth_v, self.eta)
        point[..., 2], across[..., 2] = _times(depth, self.zeta), _times(depth_v, self.zeta)
        point[:, :, 0, 2] += self.base
        return IsoCurves(
            np.arange(len(v) + 1) * size,
            point.reshape(-1, 4, 3),
            across.reshape(-1, 4, 3),
            np.tile(np.array(self.deck), len(v)),
        )

    def _shape(self, v: FloatArray) -> tuple[tuple[FloatArray, FloatArray], ...]:
        """x, breadth and depth with their derivatives."""
        length = 100.0 + 0.0 * v
        one, none = 1.0 + 0.0 * v, 0.0 * v
        if self.kind == "wigley":
            # y = B/2 (1 - (2 v - 1)^2) = 2 B v (1 - v)
            return (100.0 * v, length), (4.0 * v * (1.0 - v), 4.0 - 8.0 * v), (one, none)
        if self.kind == "box":
            return (100.0 * v, length), (one, none), (one, none)
        sine, cosine = np.sin(np.pi * v), np.cos(np.pi * v)
        round_ = (sine, np.pi * cosine)
        return (50.0 - 50.0 * cosine, 50.0 * np.pi * sine), round_, round_


def _times(scale: FloatArray, tiles: FloatArray) -> FloatArray:
    scaled: FloatArray = scale[:, None, None] * tiles
    return scaled


def wigley(points: int = 192, top: float = 12.5) -> ExactStrips:
    """L 100, B 10, T 6.25, wall-sided above; one tile for the parabola, one for the wall."""
    draught, half = 6.25, 5.0
    # 1 - (u - 1)^2 = 2 u - u^2
    eta = half * np.array([[0.0, 2.0, -1.0, 0.0], [1.0, 0.0, 0.0, 0.0]])
    zeta = np.array([[0.0, draught, 0.0, 0.0], [draught, top - draught, 0.0, 0.0]])
    return ExactStrips(eta, zeta, (False, False), 0.0, points, "wigley")


def box(points: int = 4) -> ExactStrips:
    """100 x 20 x 12 with bottom, side and closed deck; open at both ends."""
    eta = np.array([[0.0, 10.0, 0, 0], [10.0, 0, 0, 0], [10.0, -10.0, 0, 0]])
    zeta = np.array([[0.0, 0, 0, 0], [0.0, 12.0, 0, 0], [12.0, 0, 0, 0]])
    return ExactStrips(eta, zeta, (False, False, True), 0.0, points, "box")


def ellipsoid(points: int = 32, tiles: int = 300) -> ExactStrips:
    """Semi-axes 50, 8 and 6 about (50, 0, 6): the section from keel to top in Hermite tiles."""
    angle = np.linspace(0.0, np.pi, tiles + 1)
    step = np.pi / tiles
    eta = _hermite(8.0 * np.sin(angle), 8.0 * np.cos(angle) * step)
    zeta = _hermite(-6.0 * np.cos(angle), 6.0 * np.sin(angle) * step)
    return ExactStrips(eta, zeta, (False,) * tiles, 6.0, points, "ellipsoid")


def _hermite(value: FloatArray, slope: FloatArray) -> FloatArray:
    """Cubics through values with slopes per tile, (tiles, 4)."""
    begin, end, out, into = value[:-1], value[1:], slope[:-1], slope[1:]
    rise = end - begin
    return np.stack([begin, out, 3.0 * rise - 2.0 * out - into, out + into - 2.0 * rise], axis=1)


@attrs.frozen
class FormStrips:
    """A ship-like body, its half cut into equal strips; every tile is exact.

    With t = x / length along the ship, sections are y = breadth(t) * eta(u),
    z = keel(t) + height(t) * zeta(u) in tiles of a bilge-like profile, from which the curves
    lean forward by rake(t) * zeta(u). All along t are polynomials.
    """

    breadth: Polynomial
    keel: Polynomial
    height: Polynomial
    rake: Polynomial
    tiles: int = 8
    strips: int = 10
    points: int = 6
    length: float = 100.0
    closed: bool = True

    @property
    def count(self) -> int:
        return self.strips

    @property
    def order(self) -> IntArray:
        return np.full(self.strips, self.points)

    @cached_property
    def profile(self) -> tuple[FloatArray, FloatArray]:
        """Eta and zeta of the tiles: a superellipse in Hermite tiles, then the deck."""
        angle = np.linspace(0.0, 0.5 * np.pi, self.tiles + 1)
        step = 0.5 * np.pi / self.tiles
        bow, sine, cosine = 0.15 * np.sin(2.0 * angle), np.sin(angle), np.cos(angle)
        eta = _hermite(sine + bow, (cosine + 0.3 * np.cos(2.0 * angle)) * step)
        zeta = _hermite(1.0 - cosine, sine * step)
        if not self.closed:
            return eta, zeta
        deck = np.array([[1.0, -1.0, 0.0, 0.0]]), np.array([[1.0, 0.0, 0.0, 0.0]])
        return np.concatenate([eta, deck[0]]), np.concatenate([zeta, deck[1]])

    def curves(self, strip: IntArray, v: FloatArray) -> IsoCurves:
        """Curves at v."""
        t = (strip + v) / self.strips
        place = self.length * t
        point = self._points(place, t, 0)
        rate = np.full(len(strip), self.length) + 0.0 * t
        across = self._points(rate, t, 1) * (1.0 / self.strips)
        size = len(self.profile[0])
        deck = np.zeros((len(strip), size), bool)
        deck[:, -1] = self.closed
        starts = np.arange(len(strip) + 1) * size
        return IsoCurves(starts, point, across, deck.ravel())

    def _points(self, x: FloatArray, t: FloatArray, order: int) -> FloatArray:
        """Coefficients of points or, of order 1, of their derivatives by t."""
        eta, zeta = self.profile
        forms = (self.breadth, self.keel, self.height, self.rake)
        breadth, keel, height, rake = (_polynomial(form.deriv(order), t) for form in forms)
        first = np.zeros((len(eta), 4))
        first[:, 0] = 1.0
        rows = [
            _times(rake, zeta) + _times(x, first),
            _times(breadth, eta),
            _times(height, zeta) + _times(keel, first),
        ]
        points: FloatArray = np.stack(rows, axis=-1).reshape(-1, 4, 3)
        return points


def _polynomial(form: Polynomial, t: FloatArray) -> FloatArray:
    """Values of a polynomial, in any arithmetic."""
    coefficients = form.coef.tolist()
    value: FloatArray = coefficients[-1] + 0.0 * t
    for each in coefficients[-2::-1]:
        value = value * t + each
    return value
