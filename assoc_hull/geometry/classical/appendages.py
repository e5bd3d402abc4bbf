"""Appendages that are added to a hull or taken from it: bodies through sections, and boxes.

`LoftedAppendage` runs through one, two or three closed sections along x (SEAKING). `AppendageBox`
has faces parallel to the axes (PRELIKON). Both know volume and centre exactly, with a sign: 1 adds,
-1 takes away. Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for
Design and Production", J. SNAK.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.arguments import flag, shown
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import digits, finite_array, one_of, within_range
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = [
    "AppendageBox",
    "LoftedAppendage",
]

_CHECKED_STATIONS = 17
"""Stations, ends among them, at which a section is checked for crossing itself."""


@attrs.frozen(eq=False)
class LoftedAppendage:
    """A prism through one section, a ruled body through two, a parabolic one through three.

    Sections have the same number of points, in the same order, and are closed from the last to
    the first; between them each point runs along x on a straight line or a parabola.

    Attributes
    ----------
    sections : (k, m, 2), m
        One, two or three sections (y, z).
    x : (2,) or (3,), m
        Where it begins and ends, and where the middle one of three sections stands.
    sign : int
        1 adds its volume, -1 takes it away.
    """

    sections: FloatArray
    x: FloatArray
    sign: int

    def __attrs_post_init__(self) -> None:
        freeze(self.sections, self.x)

    @classmethod
    def make(cls, sections: Sequence[ArrayLike], x: ArrayLike, sign: float = 1) -> Self:
        """Check the arguments, which are as the attributes.

        Raises
        ------
        GeometryError
            ``"appendage: 1, 2 or 3 sections expected, got {n}"``, ``"appendage: sections have
            {m0} and {m1} points"``, ``"appendage: x must be strictly increasing"``, ``"appendage:
            section at x={x} self-intersects"``, ``"appendage: sections have opposite
            orientation"``; fewer than three points, another sign.
        """
        if not isinstance(sections, list | tuple | np.ndarray) or getattr(sections, "ndim", 1) == 0:
            raise GeometryError("appendage: sections are no row of arrays", "give 1, 2 or 3", {})
        drawn = [finite_array(each, "appendage", (None, 2)) for each in sections]
        if len(drawn) not in (1, 2, 3):
            what = f"appendage: 1, 2 or 3 sections expected, got {len(drawn)}"
            raise GeometryError(what, "leave some out or add one", {"sections": len(drawn)})
        for each in drawn[1:]:
            if len(each) != len(drawn[0]):
                what = f"appendage: sections have {len(drawn[0])} and {len(each)} points"
                told = {"m0": len(drawn[0]), "m1": len(each)}
                raise GeometryError(what, "give the same number in the same order", told)
        if len(drawn[0]) < 3:
            what = f"appendage: a section has {len(drawn[0])} point(s)"
            raise GeometryError(what, "give three or more", {"points": len(drawn[0])})
        places = finite_array(x, "appendage", (3 if len(drawn) == 3 else 2,))
        if (np.diff(places) <= 0.0).any():
            what = "appendage: x must be strictly increasing"
            raise GeometryError(what, "give the places from aft forward", {"x": places.tolist()})
        made = cls(np.stack(drawn), places, int(one_of(sign, (1, -1), "appendage: sign is")))
        made._refuse_crossing()
        return made

    def at(self, x: ArrayLike) -> FloatArray:
        """Give sections (..., m, 2), m, at x (...), m.

        Raises
        ------
        GeometryError
            ``"appendage: x={x} outside [{a}, {b}]"``, as from `area`.
        """
        place = within_range(x, "appendage", float(self.x[0]), float(self.x[-1]))
        part = (place - self.x[0]) / (self.x[-1] - self.x[0])
        return np.asarray(np.tensordot(self._weights(part), self.sections, axes=1))

    def area(self, x: ArrayLike) -> FloatArray:
        """Give areas of sections, m2, without sign, at x (m)."""
        return np.abs(_shoelace(self.at(x)))

    @property
    def volume(self) -> float:
        """Its volume with its sign, m3; exact."""
        return self.sign * float(self._nodes()[1].sum())

    @property
    def moment(self) -> tuple[float, float, float]:
        """Integrals of x, y and z over the volume, with its sign, m4."""
        place, weighed = self._nodes()
        points = self.at(place)
        along = (place * weighed).sum()
        across = (_centres(points) * weighed[:, None]).sum(axis=0)
        return tuple(self.sign * float(each) for each in (along, *across))  # type: ignore[return-value]

    def _nodes(self) -> tuple[FloatArray, FloatArray]:
        """Give places along it, and areas there times weights.

        Areas go with the fourth power of x at most, their first moments with the sixth: four
        nodes of Gauss are exact.
        """
        node, weight = np.polynomial.legendre.leggauss(4)
        half = 0.5 * (self.x[-1] - self.x[0])
        place = self.x[0] + half * (1.0 + node)
        return place, half * weight * self.area(place)

    def _weights(self, t: FloatArray) -> FloatArray:
        """Give Lagrange's weights of the sections at parts of the length, (..., k)."""
        if len(self.sections) == 1:
            return np.ones((*t.shape, 1))
        if len(self.sections) == 2:
            return np.stack([1.0 - t, t], axis=-1)
        m = (self.x[1] - self.x[0]) / (self.x[2] - self.x[0])
        parts = [
            (t - m) * (t - 1.0) / m, t * (t - 1.0) / (m * (m - 1.0)), t * (t - m) / (1.0 - m),
        ]  # fmt: skip
        return np.stack(parts, axis=-1)

    def _refuse_crossing(self) -> None:
        """Refuse sections that turn round or cross themselves anywhere."""
        signs = np.sign(_shoelace(self.sections))
        if (signs != signs[0]).any():
            remedy = "draw all of them in the same sense of rotation"
            raise GeometryError("appendage: sections have opposite orientation", remedy, {})
        places = np.union1d(np.linspace(self.x[0], self.x[-1], _CHECKED_STATIONS), self.x)
        bad = np.flatnonzero(_self_intersects(self.at(places)))
        if len(bad):
            place = float(places[bad[0]])
            what = f"appendage: section at x={digits(place)} self-intersects"
            raise GeometryError(what, "move the points, or add a section", {"x": place})


def _shoelace(points: FloatArray) -> FloatArray:
    """Give signed areas of closed polygons (..., m, 2)."""
    return np.asarray(0.5 * _sweeps(points).sum(axis=-1))


def _sweeps(points: FloatArray) -> FloatArray:
    """Give twice the signed area that each side spans with the origin, (..., m)."""
    after = np.roll(points, -1, axis=-2)
    return np.asarray(points[..., 0] * after[..., 1] - after[..., 0] * points[..., 1])


def _centres(points: FloatArray) -> FloatArray:
    """Give centroids of closed polygons (..., m, 2); the mean of the points where there is none."""
    area = _shoelace(points)[..., None]
    swept = _sweeps(points)[..., None] * (points + np.roll(points, -1, axis=-2))
    with np.errstate(divide="ignore", invalid="ignore"):
        found = swept.sum(axis=-2) / (6.0 * area)
    return np.asarray(np.where(area != 0.0, found, points.mean(axis=-2)))


def _self_intersects(points: FloatArray) -> NDArray[np.bool_]:
    """Tell which polygons (k, m, 2) have two sides that cross one another."""
    one, other = np.triu_indices(points.shape[-2], 2)
    # Neighbouring sides share a point: the first and the last are such a pair too.
    apart = ~((one == 0) & (other == points.shape[-2] - 1))
    a, b = points, np.roll(points, -1, axis=-2)
    p, q, r, s = a[:, one[apart]], b[:, one[apart]], a[:, other[apart]], b[:, other[apart]]
    found = (_turn(p, q, r) * _turn(p, q, s) < 0.0) & (_turn(r, s, p) * _turn(r, s, q) < 0.0)
    return np.asarray(found.any(axis=1))


def _turn(p: FloatArray, q: FloatArray, r: FloatArray) -> FloatArray:
    """Give twice the signed area of triangles."""
    u, v = q - p, r - p
    return np.asarray(u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0])


# --------------------------------------------------------------------------------------
# Boxes.

Limits = tuple[float, float]


@attrs.frozen
class AppendageBox:
    """A box; the appendage of the PRELIKON system in Kim & Chang, J. SNAK.

    Attributes
    ----------
    x, y, z : (float, float), m
        Limits, the lower one first; y as given, on one side.
    sign : int
        +1 adds to the hull, -1 takes from it.
    symmetric : bool
        The same box stands on the other side as well.
    name : str
        For tables.
    """

    x: Limits
    y: Limits
    z: Limits
    sign: int = 1
    symmetric: bool = False
    name: str = "appendage box"

    @classmethod
    def make(
        cls,
        x: ArrayLike,
        y: ArrayLike,
        z: ArrayLike,
        *,
        sign: int = 1,
        symmetric: bool = False,
        name: str = "appendage box",
    ) -> Self:
        """Check the arguments, which are as the attributes.

        Raises
        ------
        GeometryError
            ``"appendage box: {axis} limits reversed"``; a sign that is not 1 or -1; a box
            across the centre line that is to stand on both sides.
        """
        limits = [_limits(pair, axis) for pair, axis in ((x, "x"), (y, "y"), (z, "z"))]
        if shown(sign) not in ("1", "-1"):
            what = f"appendage box: sign is {shown(sign)}"
            raise GeometryError(what, "give 1 or -1", {"sign": sign})
        low, high = limits[1]
        both = flag(symmetric, "symmetric", "in an appendage box")
        if both and low < 0.0 < high:
            what = f"appendage box: y {digits(low)} to {digits(high)} overlaps its mirror image"
            remedy = "give it on one side, or without symmetric"
            raise GeometryError(what, remedy, {"y": (low, high)})
        return cls(limits[0], limits[1], limits[2], sign, both, str(name))

    @property
    def sides(self) -> int:
        """How many such boxes there are: 1, or 2 if it is symmetric."""
        return 2 if self.symmetric else 1

    @property
    def volume(self) -> float:
        """With its sign, both sides if symmetric, m3."""
        return self.waterplane_area(self.z[0]) * (self.z[1] - self.z[0])

    @property
    def centroid(self) -> tuple[float, float, float]:
        """Its centre, m; y is 0 if it stands on both sides."""
        x, y, z = (0.5 * (low + high) for low, high in (self.x, self.y, self.z))
        return x, 0.0 if self.symmetric else y, z

    @property
    def surface(self) -> float:
        """Of all six faces, both sides if symmetric, m2."""
        a, b, c = (high - low for low, high in (self.x, self.y, self.z))
        return 2.0 * self.sides * (a * b + b * c + c * a)

    def waterplane_area(self, z: float) -> float:
        """Give the area (m2, with the sign) cut at height `z` (m); 0 above and below it.

        Raises
        ------
        GeometryError
            A height that is no finite number.
        """
        level = float(finite_array(z, "appendage box", ()))
        if not self.z[0] <= level <= self.z[1]:
            return 0.0
        return self.sign * self.sides * (self.x[1] - self.x[0]) * (self.y[1] - self.y[0])

    def volume_below(self, z: float) -> float:
        """Give the volume (m3, with the sign) below height `z` (m).

        Raises
        ------
        GeometryError
            A height that is no finite number.
        """
        level = float(finite_array(z, "appendage box", ()))
        depth = float(np.clip(level, *self.z)) - self.z[0]
        return self.waterplane_area(self.z[0]) * depth

    def moved(self, by: float) -> Self:
        """Give the same box with `by` (m) added to x."""
        step = float(finite_array(by, "appendage box", ()))
        return attrs.evolve(self, x=(self.x[0] + step, self.x[1] + step))


def _limits(pair: ArrayLike, axis: str) -> Limits:
    low, high = finite_array(pair, f"appendage box {axis}", (2,)).tolist()
    if not low < high:
        raise GeometryError(
            f"appendage box: {axis} limits reversed",
            f"give the lower one of {digits(low)} and {digits(high)} first, and apart",
            {"axis": axis, "limits": (low, high)},
        )  # fmt: skip
    return low, high
