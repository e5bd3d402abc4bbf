"""What of a tunnel lies below floating planes: volume, moments, waterplane, walls, mouths.

A tunnel is the part of the cylinder (x - x0)^2 + (z - z0)^2 < r^2 with |y| <= b(x, z), b the
half-breadth of the shell. The plane is z = c(x) - y tan(heel). At one x, going up, the tunnel is
wet from side to side, then from the lower side to the water, then dry. `_Column` finds the two
heights between, and Gauss's rule takes each part by itself; along x it takes the stretches between
the places where the water passes the mouths. So all is exact to rounding where b is a polynomial of
low degree: in a box the parts are segments of a cylinder.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import attrs
import numpy as np
from numpy.polynomial.legendre import legvander
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.floating.immersion import FloatingPlanes, ImmersedIntegrals
from assoc_hull.geometry.numeric.polynomials import false_position
from assoc_hull.geometry.numeric.quadrature import gauss

__all__ = ["ImmersedTunnel", "MouthShape", "disc_places"]

_RULE = 16
"""Places of Gauss's rule on each stretch."""

_LOOKS = 128
"""Places around a mouth between which the water is looked for."""

_ROUNDING = 1e-14
"""Of lengths: a root that is met this near is met."""

_NIL = 1e-15
"""Parts of the largest coefficient: smaller ones are rounding."""

_LEVEL = 1e-14
"""Heel of a smaller tangent is none: it lifts no side of a ship by a bit."""

_NONE: IntArray = np.zeros(0, np.int64)

_WET = tuple(
    each.name for each in attrs.fields(ImmersedIntegrals)
    if each.name not in ("girth", "wet_deck", "x_least", "x_most", "y_least", "y_most")
)  # fmt: skip
"""What a tunnel changes: it ends in the shell, so the extent of a waterplane stays."""


def disc_places(x: float, z: float, radius: float, count: int) -> tuple[FloatArray, FloatArray]:
    """Give places of a disc by level chords at z + r cos t: Gauss's nodes in t and along each.

    Returns
    -------
    (count, count) x, m, (count,) z, m
        A chord to a row.
    """
    node, _ = _both_ways(count)
    turn = 0.5 * np.pi * (1.0 + node)
    return x + radius * np.sin(turn)[:, None] * node, z + radius * np.cos(turn)


@attrs.frozen(eq=False)
class MouthShape:
    """The shell within the mouth of a tunnel, port side.

    Attributes
    ----------
    x, z, radius : float, m
        Of the cylinder.
    breadth : (n, n), m
        Half-breadths at `disc_places`.
    element : (n, n)
        True area of the shell over its area in profile, there.
    """

    x: float
    z: float
    radius: float
    breadth: FloatArray
    element: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.breadth, self.element)

    @cached_property
    def _series(self) -> FloatArray:
        """Coefficients of both in Legendre polynomials of t and of the place on a chord.

        Those behind the last that is more than rounding are left out: few of a plane side remain.
        """
        node, weight = _both_ways(len(self.breadth))
        own = legvander(node, len(node) - 1) * weight[:, None] * (np.arange(len(node)) + 0.5)
        whole: FloatArray = own.T @ np.stack([self.breadth, self.element]) @ own
        told = (np.abs(whole) > _NIL * np.abs(whole).max(axis=(1, 2), keepdims=True)).any(axis=0)
        rows, columns = (int(np.flatnonzero(told.any(axis=way)).max()) + 1 for way in (1, 0))
        found: FloatArray = np.ascontiguousarray(whole[:, :rows, :columns])
        return found

    def breadth_at(self, x: FloatArray, z: FloatArray) -> FloatArray:
        """Give the half-breadth at places within the disc, of any one shape, m."""
        rows, columns = self._terms(x, z)
        return self._value(0, rows, columns)

    def at(self, x: FloatArray, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give half-breadth and element at places within the disc, of any one shape."""
        rows, columns = self._terms(x, z)
        return self._value(0, rows, columns), self._value(1, rows, columns)

    def _terms(self, x: FloatArray, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give the polynomials of t and of the place on a chord at places, (..., n) each."""
        up = np.clip((z - self.z) / self.radius, -1.0, 1.0)
        half = self.radius * np.sqrt(1.0 - up * up)
        # At the top and the bottom of the disc a chord is a point, and any place on it will do.
        along = (x - self.x) / np.where(half > 0.0, half, np.inf)
        _, rows, columns = self._series.shape
        turn = 2.0 / np.pi * np.arccos(up) - 1.0
        return _legendre(turn, rows - 1), _legendre(along, columns - 1)

    def _value(self, which: int, rows: FloatArray, columns: FloatArray) -> FloatArray:
        found: FloatArray = (rows @ self._series[which] * columns).sum(axis=-1)
        return found


@attrs.frozen(eq=False)
class ImmersedTunnel:
    """A tunnel, ready to be cut by planes.

    Attributes
    ----------
    shape : MouthShape
        Its cylinder and the shell around its mouths.
    """

    shape: MouthShape

    def measure(self, planes: FloatingPlanes) -> dict[str, FloatArray]:
        """Give what it takes of the integrals below each of d planes, by their names, (d,).

        ``shell`` is less by the wet mouths and more by the wet wall; what stays is left out.
        """
        found = {name: np.zeros(len(planes.height)) for name in _WET}
        for k, plane in enumerate(_rows(planes)):
            for name, value in self._below(*plane).items():
                found[name][k] = value
        return found

    def section_areas(self, x: float, planes: FloatingPlanes) -> tuple[FloatArray, FloatArray]:
        """Give what it takes of a section at x below each plane, and its moment of z, (d,) each.

        Both sides, m2, m3.
        """
        shape, count = self.shape, len(planes.height)
        area, moment = np.zeros(count), np.zeros(count)
        away = x - shape.x
        if abs(away) >= shape.radius:
            return area, moment
        half = np.array([np.sqrt(shape.radius**2 - away**2)])
        for k, (height, trim, heel) in enumerate(_rows(planes)):
            column = _Column(shape, np.array([x]), half, np.array([height + trim * x]), abs(heel))
            sums = column.sums()
            area[k], moment[k] = float(sums["volume"][0]), float(sums["moment_z"][0])
        return area, moment

    @cached_property
    def _whole(self) -> dict[str, float]:
        """What it has where all of it is wet."""
        return self._integrated(1e3 * (abs(self.shape.z) + self._reach), 0.0, 0.0, ())

    @cached_property
    def _reach(self) -> float:
        """How far it reaches from its middle at most, m, and a little more."""
        angle = np.linspace(0.0, 2.0 * np.pi, _LOOKS)
        rim = self._rim(angle)[2]
        broad = max(float(rim.max()), float(self.shape.breadth.max()))
        return 1.01 * broad + self.shape.radius

    def _below(self, height: float, trim: float, heel: float) -> dict[str, float]:
        shape = self.shape
        over = height + trim * shape.x - shape.z
        tilt = float(np.hypot(trim, heel))
        away = shape.radius * float(np.hypot(1.0, trim)) + abs(heel) * self._reach
        if over >= away + 1e-9 * tilt:
            return self._whole
        if over <= -away:
            return {}
        return self._integrated(height, trim, heel, self._passes(height, trim, abs(heel)))

    def _rim(self, angle: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Give places of the mouth's edge to port: x, z and y, m."""
        shape = self.shape
        x, z = shape.x + shape.radius * np.cos(angle), shape.z + shape.radius * np.sin(angle)
        return x, z, shape.breadth_at(x, z)

    def _passes(self, height: float, trim: float, heel: float) -> tuple[float, ...]:
        """Give where the water passes the edges of the mouths, as angles from ahead, upward."""
        found: list[float] = []
        angle = np.linspace(0.0, 2.0 * np.pi, _LOOKS + 1)
        for side in (heel, -heel) if heel else (0.0,):

            def over(_: IntArray, at: FloatArray, side: float = side) -> FloatArray:
                x, z, y = self._rim(at)
                return height + trim * x - z - side * y

            depth = over(_NONE, angle)
            turn = np.flatnonzero((depth[:-1] >= 0.0) != (depth[1:] >= 0.0))
            ends = angle[turn], angle[turn + 1], depth[turn], depth[turn + 1]
            found += false_position(over, *ends, _ROUNDING * self._reach).tolist()
        return tuple(sorted(found))

    def _integrated(
        self, height: float, trim: float, heel: float, passes: Sequence[float]
    ) -> dict[str, float]:
        """Integrate between the places where the water passes the mouths."""
        shape, steep = self.shape, abs(heel)
        cuts = np.unique(np.arccos(np.clip(np.cos(passes), -1.0, 1.0)))
        turn, share = _stretches(np.concatenate([[0.0], cuts, [np.pi]]))
        x, half = shape.x + shape.radius * np.cos(turn), shape.radius * np.sin(turn)
        column = _Column(shape, x, half, height + trim * x, steep)
        strip, sums = share * half, column.sums()
        # Starboard is the lower side of a heel that is positive.
        side = 1.0 if heel >= 0.0 else -1.0
        found = {name: float((strip * each).sum()) for name, each in sums.items()}
        for name, x_power in (("moment_x", 1), ("area_x", 1), ("area_xx", 2), ("area_xy", 1)):
            source = {"moment_x": "volume", "area_xy": "area_y"}.get(name, "area")
            found[name] = float((strip * sums[source] * x**x_power).sum())
        for name in ("moment_y", "area_y", "area_xy"):
            found[name] *= side
        wall = self._wall(height, trim, steep, passes)
        found["shell"] = found.pop("opening") - wall
        return found

    def _wall(self, height: float, trim: float, heel: float, passes: Sequence[float]) -> float:
        """Give the wet wall, m2."""
        ends = np.concatenate([[0.0], passes, [2.0 * np.pi]])
        angle, share = _stretches(ends)
        x, z, y = self._rim(angle)
        wet = _reached(height + trim * x - z, heel, y)
        return self.shape.radius * float((share * (wet + y)).sum())


@attrs.frozen(eq=False)
class _Column:
    """Upright chords of a tunnel at several x, and what of them is wet.

    Attributes
    ----------
    shape : MouthShape
    x, half, water : (n,), m
        Where they are, half their length, and the height of the water in the centre plane.
    heel : float
        Tangent of the heel, not negative: the side with y < 0 is the lower one.
    """

    shape: MouthShape
    x: FloatArray
    half: FloatArray
    water: FloatArray
    heel: float

    def sums(self) -> dict[str, FloatArray]:
        """Integrate over each chord, (n,) each; the x of moments is left to the caller."""
        low, high = self.shape.z - self.half, self.shape.z + self.half
        from_, to = self._water_span(low, high)
        # Wet from side to side up to where the water leaves the higher mouth.
        whole = np.clip(self.water - self.heel * to, low, high)
        some = np.clip(self.water - self.heel * from_, low, high)
        x = self.x[:, None]
        z, share = _between(low, whole)
        y, element = self.shape.at(x + 0.0 * z, z)
        found = {
            "volume": (share * 2.0 * y).sum(axis=1),
            "moment_z": (share * 2.0 * y * z).sum(axis=1),
            "opening": (share * 2.0 * element).sum(axis=1),
        }
        z, share = _between(whole, some)
        y, element = self.shape.at(x + 0.0 * z, z)
        wet = _reached(self.water[:, None] - z, self.heel, y)
        found["volume"] += (share * (wet + y)).sum(axis=1)
        found["moment_z"] += (share * (wet + y) * z).sum(axis=1)
        found["moment_y"] = (share * 0.5 * (wet * wet - y * y)).sum(axis=1)
        found["opening"] += (share * element).sum(axis=1)
        across, part = _between(from_, to)
        for name, power in (("area", 0), ("area_y", 1), ("area_yy", 2)):
            found[name] = (part * across**power).sum(axis=1)
        return found

    def _water_span(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give from where to where (y, m) the water lies within the tunnel, (n,) each.

        Two equal values where it does not; those are such that the heights are right still.
        """
        upper, lower = (self._edge(side, low, high) for side in (1.0, -1.0))
        if self.heel == 0.0:
            inside = (low < self.water) & (self.water < high)
            return np.where(inside, lower, 0.0), np.where(inside, upper, 0.0)
        # Above the chord and below it the water does not lie in the tunnel.
        least, most = (self.water - high) / self.heel, (self.water - low) / self.heel
        return np.clip(lower, least, most), np.clip(upper, least, most)

    def _edge(self, side: float, low: FloatArray, high: FloatArray) -> FloatArray:
        """Give where the water meets the shell on one side, y, (n,), m.

        Beyond the ends of a chord the shell counts as upright.
        """

        def beyond(some: IntArray, y: FloatArray) -> FloatArray:
            z = np.clip(self.water[some] - self.heel * y, low[some], high[some])
            return self.shape.breadth_at(self.x[some], z) - side * y

        every, middle = np.arange(len(self.x)), np.zeros(len(self.x))
        near = beyond(every, middle)
        if self.heel == 0.0:
            return side * near
        far = np.full(len(self.x), side * 2.0 * float(self.shape.breadth.max()))
        ends = middle, far, near, beyond(every, far)
        return false_position(beyond, *ends, _ROUNDING * float(np.abs(far).max(initial=0.0)))


def _legendre(at: FloatArray, last: int) -> FloatArray:
    """Give Legendre polynomials to degree `last` at places from -1 to 1, along a new last axis."""
    found: NDArray[np.float64] = np.asarray(legvander(np.clip(at, -1.0, 1.0), last), np.float64)
    return found


def _rows(planes: FloatingPlanes) -> list[tuple[float, float, float]]:
    """Give height and the tangents of trim and heel, plane by plane."""
    heel = np.where(np.abs(planes.tan_heel) > _LEVEL, planes.tan_heel, 0.0)
    columns = planes.height.tolist(), planes.tan_trim.tolist(), heel.tolist()
    return list(zip(*columns, strict=True))


def _reached(over: FloatArray, heel: float, y: FloatArray) -> FloatArray:
    """Give how far the water reaches from the lower side, as a place from -y to y, m.

    `over` is how far it stands over a place in the centre plane.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        at = np.where(over > 0.0, np.inf, -np.inf) if heel == 0.0 else over / heel
    return np.clip(at, -y, y)


def _both_ways(count: int) -> tuple[FloatArray, FloatArray]:
    """Give places and weights of Gauss's rule from -1 to 1, (n,) each."""
    node, weight = gauss(count)
    return 2.0 * node - 1.0, 2.0 * weight


def _between(low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give places and weights (n, r) of a rule from each low (n,) to its high."""
    node, weight = gauss(_RULE)
    size = (high - low)[:, None]
    return low[:, None] + size * node, size * weight


def _stretches(ends: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give places and weights (k,) of a rule on each stretch between neighbours."""
    places, weights = _between(ends[:-1], ends[1:])
    return places.ravel(), weights.ravel()
