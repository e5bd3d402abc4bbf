"""Bow, stern and single sections of the 207,000 TDW bulk carrier, read off its formulas."""

from __future__ import annotations

import math

import attrs
import numpy as np
from scipy.optimize import brentq

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.shipped import bulk_carrier_207k_form as form
from tests import carrier_truth

__all__ = [
    "HalfSection", "bluntness", "bulb_area", "foremost", "overhang", "run_angle", "slope_at_ap",
    "transom_below",
]  # fmt: skip

DRAUGHT = form.DRAUGHT


@attrs.frozen
class HalfSection:
    """The half section at a place below the design waterline."""

    x: float

    def at(self, z: float) -> float:
        """Half-breadth; m."""
        return float(form.carrier_half_breadth(self.x, z))

    @property
    def area(self) -> float:
        """Of one side; m2."""
        return 0.5 * carrier_truth.area_of(self.x)

    def off_chord(self, low: float) -> float:
        """Area between the section and its chord from the keel to the waterline; m2.

        The keel is on the base line here, and the flat of bottom narrow or none.
        """
        z, dz = carrier_truth.between(np.linspace(low, DRAUGHT, 60).tolist())
        return float((form.carrier_half_breadth(self.x, z) - self.at(DRAUGHT) * z / DRAUGHT) @ dz)

    def radius(self) -> float:
        """Of the circle through the places at a quarter, a half and three quarters of T."""
        low, middle, high = (complex(self.at(part * DRAUGHT), part * DRAUGHT) for part in
                             (0.25, 0.5, 0.75))  # fmt: skip
        one, other = middle - low, high - low
        twice = one.real * other.imag - one.imag * other.real
        return abs(one) * abs(other) * abs(high - middle) / (2.0 * twice)

    def inclination(self, low: float) -> float:
        """Of the line between the places at a height and at the waterline; degrees."""
        return math.degrees(math.atan2(self.at(DRAUGHT) - self.at(low), DRAUGHT - low))

    def diagonal(self) -> tuple[float, float]:
        """How far out the section meets its diagonal, and the diagonal's length; m."""
        half = self.at(DRAUGHT)
        part = brentq(lambda t: self.at(DRAUGHT * (1.0 - t)) - half * t, 0.05, 0.999, xtol=1e-14)
        whole = math.hypot(half, DRAUGHT)
        return float(part) * whole, whole


def foremost(area: float) -> HalfSection:
    """The foremost section that has so much area; m2."""
    return HalfSection(
        float(brentq(lambda x: carrier_truth.area_of(x) - area, 260.0, 299.0, xtol=1e-12))
    )


def bulb_area() -> float:
    """Of the profile before FP below the design waterline; m2."""
    levels = [0.0, form.NOSE[1], 12.0, DRAUGHT]
    z = np.linspace(0.0, DRAUGHT, 4001)
    ahead = form.fore_end(z) - form.LENGTH
    turns = z[:-1][np.diff(np.sign(ahead)) != 0.0]
    step = z[1] - z[0]
    roots = [
        float(brentq(lambda at: float(form.fore_end(at)) - form.LENGTH, low - step, low + step))
        for low in turns.tolist()
        if 0.0 < low < DRAUGHT - 2.0 * step
    ]
    nodes, weights = carrier_truth.between(sorted([*levels, *roots]))
    return float(np.maximum(form.fore_end(nodes) - form.LENGTH, 0.0) @ weights)


def transom_below(draught: float) -> tuple[float, float]:
    """Area of the transom below a waterline, and its breadth there; m2, m."""
    z, dz = carrier_truth.between([form.TRANSOM_LOW, draught])
    y = form.carrier_half_breadth(np.full_like(z, form.TRANSOM), z)
    return 2.0 * float(y @ dz), 2.0 * float(form.carrier_half_breadth(form.TRANSOM, draught))


def overhang(x: float) -> float:
    """Height of the bottom over a place abaft the aperture; m."""
    return float(brentq(lambda z: float(form.contour_over_bossing(z)) - x, 9.0, 18.4, xtol=1e-13))


def slope_at_ap() -> float:
    """Of the profile to the base line; degrees."""
    z, step = overhang(0.0), 1e-4
    ends = [float(form.contour_over_bossing(z + sign * step)) for sign in (1.0, -1.0)]
    return math.degrees(math.atan2(2.0 * step, abs(ends[0] - ends[1])))


def _bow() -> tuple[FloatArray, FloatArray]:
    """Many places of the design waterline forward of its shoulder, dense at the stem; m."""
    shoulder, end = float(form.fore_shoulder(DRAUGHT)), float(form.fore_end(DRAUGHT))
    x = end - (end - shoulder) * np.linspace(1.0, 0.0, 200001) ** 4
    return x, form.carrier_half_breadth(x, np.full_like(x, DRAUGHT))


def bluntness() -> float:
    """(2 / B) times the integral of sin^2 of the waterline's angle over the half-breadth."""
    dx, dy = (np.diff(each) for each in _bow())
    dx, dy = dx[dy < 0.0], dy[dy < 0.0]
    return float((-dy * dy**2 / (dx**2 + dy**2)).sum()) / (0.5 * form.BREADTH)


def run_angle(fore: float) -> float:
    """Of the chord of the waterline at T/2 from its after end to a place; degrees."""
    x, y = form.aft_end(0.5 * DRAUGHT)
    return math.degrees(
        math.atan2(float(form.carrier_half_breadth(fore, 0.5 * DRAUGHT)) - y, fore - x)
    )
