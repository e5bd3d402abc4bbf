"""The parallel middle body: flat bottom, a bilge that is an arc of a circle, upright sides.

Examples
--------
>>> from assoc_hull.model.forms.middle_body import bilge_area
>>> round(2.0 * bilge_area(14.0, 10.5, 1.8125), 3)
292.59
"""

from __future__ import annotations

import math
from typing import TypeVar

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.forms.forms import Forms

__all__ = ["bilge_area", "bilge_radius_for", "breadth_at", "in_middle_body", "span_of"]

Number = TypeVar("Number", float, FloatArray)

_CORNER = 1.0 - 0.25 * math.pi
"""What an arc of radius 1 leaves of the square around it."""


def span_of(forms: Forms) -> tuple[float, float]:
    """Give where (x, m) the parallel part of the curve of areas begins and ends."""
    areas = forms.needed("sectional_area", "for a section")
    half = 0.5 * forms.particulars.length
    low, high = (
        0.0 if each is None else (each + 1.0) * half
        for each in (areas.value("run_end"), areas.value("entrance_start"))
    )
    return low, high


def in_middle_body(forms: Forms, x: float) -> bool:
    """Tell whether a place (x, m) lies in the parallel middle body."""
    low, high = span_of(forms)
    return low - 1e-9 <= x <= high + 1e-9


def bilge_area(half_breadth: Number, height: Number, radius: Number) -> Number:
    """Give the area (m2) of half a midship section up to a height above its bottom."""
    return half_breadth * height - _CORNER * (radius * radius)


def bilge_radius_for(half_breadth: float, height: float, area: float) -> float:
    """Give the radius (m) with which half a midship section has an area; nan if none has."""
    square = (half_breadth * height - area) / _CORNER
    return math.sqrt(square) if square >= 0.0 else math.nan


def breadth_at(forms: Forms, z: float) -> float:
    """Give the half-breadth (m) of the parallel middle body at a height; nan below its bottom."""
    x = np.array([0.5 * sum(span_of(forms))])
    heights = forms.contour(float(x[0]))
    radius, full = (float(forms.value(use, x)[0]) for use in ("bilge_radius", "design_waterline"))
    up = z - heights[0] if heights else math.nan
    if not up >= 0.0:
        return math.nan
    if up >= radius:
        return full
    return full - radius + math.sqrt(radius * radius - (radius - up) ** 2)
