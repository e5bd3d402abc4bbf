"""The elastica: a thin rod bent by forces at its ends, in closed form by elliptic integrals.

With modulus k, amplitude phi and rate beta (1/m), F and E the elliptic integrals of the first
and second kind of parameter k^2, an inflecting elastica is, in axes along its force and from
phi0 on,

    beta xi = 2 (E - E0) - (F - F0),  beta eta = 2 k (cos phi0 - cos phi),  beta s = F - F0,

its direction psi = 2 asin(k sin phi), its curvature 2 beta k cos phi. The one without
inflections has p = 1 / k < 1, psi = 2 phi, and with D = sqrt(1 - p^2 sin^2 phi)

    B xi = (1 - 2 / p^2) (F - F0) + 2 / p^2 (E - E0),  B eta = 2 / p^2 (D0 - D),  B s = F - F0,

its curvature 2 B D. Along both the second derivative of the direction is -beta^2 sin psi, with
B p for beta.

Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK, eq. 9.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.classical.elastica import Elastica
>>> rod = Elastica.make(k=0.6, phi0=-0.4, phi1=1.9)
>>> round(rod.length, 9), rod.frame_point(1.9).round(9).tolist()
(2.562086709, [1.598496575, 1.493220673])
"""

from __future__ import annotations

from typing import Literal, Self

import attrs
import numpy as np
from numpy.typing import ArrayLike
from scipy.special import ellipeinc, ellipj, ellipkinc

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import bearable
from assoc_hull.geometry.classical.checks import figure, finite, inside
from assoc_hull.geometry.classical.choices import one_of
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["Elastica", "Family", "check_modulus", "force_frame", "frame_direction"]

Family = Literal["inflecting", "not inflecting"]

_MOST_TURNS = 1e6
"""rad: beyond, an amplitude has lost the digits of its angle."""


def check_modulus(k: float) -> float:
    """Take a modulus between 0 and 1, neither included.

    Raises
    ------
    GeometryError
        ``"elastica: modulus k must lie in (0,1)"``.
    """
    found = float(finite(k, "elastica", ()))
    if not 0.0 < found < 1.0:
        raise GeometryError(
            f"elastica: modulus k must lie in (0,1), not {figure(found)}",
            "give k between these; one without inflections takes p = 1 / k", {"k": found},
        )  # fmt: skip
    return found


def force_frame(
    phi0: FloatArray, phi1: FloatArray, k: FloatArray | float, family: Family = "inflecting"
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give xi, eta and s from one amplitude to another at unit rate, any shape.

    Parameters
    ----------
    phi0, phi1 : (...), rad
        Amplitudes.
    k : (...) or float
        Modulus; for the family without inflections its inverse, p.
    family : "inflecting" or "not inflecting"
        Which.
    """
    m = np.asarray(k * k)
    first, second = (
        f(phi1, m) - f(phi0, m) for f in (ellipkinc, ellipeinc)
    )  # differences of F and of E
    if family == "inflecting":
        # The difference of cosines as a product keeps its digits on a short segment.
        eta = 4.0 * k * np.sin(0.5 * (phi1 + phi0)) * np.sin(0.5 * (phi1 - phi0))
        return 2.0 * second - first, eta, first
    root0, root1 = (np.sqrt(1.0 - m * np.sin(phi) ** 2) for phi in (phi0, phi1))
    return first + 2.0 / m * (second - first), 2.0 / m * (root0 - root1), first


def frame_direction(
    phi: FloatArray, k: FloatArray | float, family: Family = "inflecting"
) -> FloatArray:
    """Give directions (rad) from the line of the force, any shape."""
    if family == "inflecting":
        return np.asarray(2.0 * np.arcsin(k * np.sin(phi)))
    return np.asarray(2.0 * phi)


@attrs.frozen(eq=False)
class Elastica:
    """A segment of an elastica in the plane, or a straight line.

    Attributes
    ----------
    start : (2,), m
        Its first point.
    rotation : float, rad
        Direction of the line of force.
    k : float
        Modulus; for the family without inflections its inverse, p.
    phi0, phi1 : float, rad
        Amplitudes at both ends, ascending.
    rate : float, 1/m
        Beta, or B; 0 for a straight line along `rotation`.
    length : float, m
        Along the curve.
    family : "inflecting" or "not inflecting"
        Of the two kinds above.
    """

    start: FloatArray
    rotation: float
    k: float
    phi0: float
    phi1: float
    rate: float
    length: float
    family: Family = "inflecting"

    def __attrs_post_init__(self) -> None:
        freeze(self.start)

    @classmethod
    def make(
        cls,
        k: float,
        phi0: float,
        phi1: float,
        rate: float = 1.0,
        *,
        start: ArrayLike = (0.0, 0.0),
        rotation: float = 0.0,
        family: Family = "inflecting",
    ) -> Self:
        """Make a segment from its amplitudes.

        Parameters
        ----------
        k, phi0, phi1, rate, start, rotation, family
            As the attributes; phi1 above phi0, the rate above 0.

        Raises
        ------
        GeometryError
            ``"elastica: modulus k must lie in (0,1)"``; amplitudes that do not ascend; a rate
            that is not above 0; an unknown family.

        Examples
        --------
        >>> from assoc_hull.geometry.classical.elastica import Elastica
        >>> loop = Elastica.make(0.8, -0.3, 1.2, 1.1, family="not inflecting")
        >>> round(loop.length, 9)
        1.547657369
        """
        modulus = check_modulus(k)
        low, high, speed, turn = (
            float(finite(each, "elastica", ())) for each in (phi0, phi1, rate, rotation)
        )
        one_of(family, ("inflecting", "not inflecting"), "elastica: no family")
        if not -_MOST_TURNS < low < high < _MOST_TURNS or not speed > 0.0:
            raise GeometryError(
                f"elastica: amplitudes {figure(low)} to {figure(high)} at a rate of "
                f"{figure(speed)}", "give ascending amplitudes below 1e6 and a rate above 0",
                {"phi0": low, "phi1": high, "rate": speed},
            )  # fmt: skip
        ends = np.array(low), np.array(high)
        length = float(force_frame(*ends, modulus, family)[2]) / speed
        bearable(np.array([speed, max(abs(low), abs(high))]), "elastica")
        first = bearable(finite(start, "elastica", (2,)), "elastica")
        return cls(first, turn, modulus, low, high, speed, length, family)

    @classmethod
    def straight(cls, start: ArrayLike, end: ArrayLike) -> Self:
        """Give the straight line between two points (2,), m."""
        first, last = (
            bearable(finite(each, "elastica", (2,)), "elastica") for each in (start, end)
        )
        step = last - first
        angle, size = float(np.arctan2(step[1], step[0])), float(np.hypot(*step))
        return cls(first, angle, 1.0, 0.0, 0.0, 0.0, size)

    @property
    def is_straight(self) -> bool:
        """Whether it is a straight line."""
        return self.rate == 0.0

    def amplitude(self, s: ArrayLike) -> FloatArray:
        """Give amplitudes (rad) at arc lengths s of any shape, m.

        Raises
        ------
        GeometryError
            ``"elastica: x={x} outside [{a}, {b}]"``.
        """
        along = inside(s, "elastica", 0.0, self.length, slack=1e-12 * self.length)
        if self.is_straight:
            return np.zeros_like(along)
        m = self.k * self.k
        found = ellipj(ellipkinc(self.phi0, m) + self.rate * along, m)[3]
        return np.clip(found, self.phi0, self.phi1)

    def frame_point(self, phi: ArrayLike) -> FloatArray:
        """Give xi, eta (..., 2), m, in axes of the force from the start, at amplitudes phi."""
        at = inside(phi, "elastica", self.phi0, self.phi1, slack=1e-12)
        if self.is_straight:
            return np.zeros((*at.shape, 2))
        xi, eta, _ = force_frame(np.array(self.phi0), at, self.k, self.family)
        return np.stack([xi, eta], axis=-1) / self.rate

    def at(self, s: ArrayLike) -> FloatArray:
        """Give points (..., 2), m, at arc lengths s of any shape, m."""
        phi = self.amplitude(s)
        if self.is_straight:
            local = np.stack([np.asarray(s, np.float64), phi], axis=-1)
        else:
            local = self.frame_point(phi)
        cosine, sine = np.cos(self.rotation), np.sin(self.rotation)
        found: FloatArray = self.start + local @ np.array([[cosine, sine], [-sine, cosine]])
        return found

    def direction(self, s: ArrayLike) -> FloatArray:
        """Give directions (rad), not wrapped, at arc lengths s of any shape, m."""
        return self.rotation + self._psi(s)

    def _psi(self, s: ArrayLike) -> FloatArray:
        phi = self.amplitude(s)
        return phi if self.is_straight else frame_direction(phi, self.k, self.family)

    def curvature(self, s: ArrayLike) -> FloatArray:
        """Give curvature (1/m, positive to the left) at arc lengths s of any shape, m."""
        phi = self.amplitude(s)
        if self.family == "inflecting":
            return np.asarray(2.0 * self.rate * self.k * np.cos(phi))
        return np.asarray(2.0 * self.rate * np.sqrt(1.0 - (self.k * np.sin(phi)) ** 2))

    def curvature_rate(self, s: ArrayLike) -> FloatArray:
        """Give the derivative of curvature by arc length (1/m2) at arc lengths s, m."""
        beta = self.rate if self.family == "inflecting" else self.rate * self.k
        return np.asarray(-(beta**2) * np.sin(self._psi(s)))

    @property
    def energy(self) -> float:
        """The integral of the square of curvature along it, 1/m."""
        if self.is_straight:
            return 0.0
        m = self.k * self.k
        first, second = (
            float(f(self.phi1, m)) - float(f(self.phi0, m)) for f in (ellipkinc, ellipeinc)
        )
        if self.family == "inflecting":
            return 4.0 * self.rate * (second - (1.0 - m) * first)
        return 4.0 * self.rate * second
