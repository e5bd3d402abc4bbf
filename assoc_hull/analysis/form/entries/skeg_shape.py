"""Measures of twin skegs: the tunnel between them, their lower edge, their centre planes.

A ship has twin skegs if the half sections of her after body run down from the centre plane to a
lowest place off it. Between the profile, which is the tunnel's top line there, and the lowest
places lies the skeg as seen from the side.
"""

from __future__ import annotations

import attrs
import numpy as np
from scipy.optimize import brentq

from assoc_hull.analysis.form.profile import NO_PROFILE, profile_at
from assoc_hull.analysis.form.section_shape import section_at
from assoc_hull.analysis.form.shape import Shape
from assoc_hull.analysis.form.value import Absent
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.numeric.circle_fit import fit_circle
from assoc_hull.geometry.numeric.quadrature import gauss

__all__ = [
    "SINGLE",
    "Skeg",
    "edge_radius",
    "edge_reaches",
    "middle_of_skeg",
    "skeg",
    "tunnel_meets_base",
    "twin_skeg",
]  # fmt: skip

SINGLE = Absent("single skeg")

_DEEP = 0.02
"""A section of the after body whose lowest place lies deeper below its centre (in design
draughts) is one of twin skegs."""

_SHALLOW = 5e-6
"""So deep a skeg (in design draughts) has ended."""

_STRAIGHT = 1e-5
"""A lower edge that leaves its chord by less (in lengths of the chord) is straight."""

_BASE = 1e-6
"""So near to the base line (m) a place is on it."""

_POINTS, _EDGE = 4, 49
"""Gauss points between stations, and places on the lower edge to which a circle is fitted."""


def _depth(shape: Shape, x: float) -> float:
    """Give how deep the skeg at a place hangs below the tunnel, m."""
    section = section_at(shape, x)
    top = None if section is None else section.at_centre
    return 0.0 if section is None or top is None else top - float(section.lowest[2])


def _stations(shape: Shape) -> FloatArray:
    x = shape.body.sections.x
    found: FloatArray = x[x < 0.5 * shape.length]
    return found


def _depths(shape: Shape) -> FloatArray:
    return np.array([_depth(shape, x) for x in _stations(shape).tolist()])


def twin_skeg(shape: Shape) -> bool:
    """Tell whether the ship has twin skegs."""
    depth = shape.take(_depths)
    return bool(len(depth) and depth.max() > _DEEP * shape.header.draught)


def tunnel_meets_base(shape: Shape) -> float | Absent:
    """Give x where the tunnel's top line comes down to the base line, m."""
    if not shape.take(twin_skeg):
        return SINGLE
    places = profile_at(shape, 2, 0.0)
    if places is None:
        return NO_PROFILE
    on = places.xyz[np.abs(places.xyz[:, 2]) <= _BASE, 0]
    return float(on.min()) if len(on) else Absent("the profile does not reach the base line")


@attrs.frozen(eq=False)
class Skeg:
    """A skeg as seen from the side, between tunnel top line and lower edge.

    Attributes
    ----------
    aft, fore : float, m
        x of its ends.
    area : float, m2
        Lateral area.
    centroid : float, m
        x of its centre.
    edge : (n, 2), m
        x and z along the lower edge, from its aft end forward.
    """

    aft: float
    fore: float
    area: float
    centroid: float
    edge: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.edge)


def skeg(shape: Shape) -> Skeg | Absent:
    """Measure the skeg from the side."""
    fore = shape.take(tunnel_meets_base)
    if isinstance(fore, Absent):
        return fore
    aft = _aft_end(shape)
    if aft >= fore:
        return Absent("the tunnel's top line meets the base line abaft the skeg")
    stations = _stations(shape)
    bounds = np.concatenate([[aft], stations[(stations > aft) & (stations < fore)], [fore]])
    node, weight = gauss(_POINTS)
    width = np.diff(bounds)[:, None]
    x, step = (bounds[:-1, None] + width * node).ravel(), (width * weight).ravel()
    depth = np.array([_depth(shape, each) for each in x.tolist()]) * step
    area = float(depth.sum())
    along = np.linspace(aft, fore, _EDGE)
    edge = np.column_stack([along, [_lowest(shape, each) for each in along.tolist()]])
    return Skeg(aft, fore, area, float((depth * x).sum()) / area, edge)


def _aft_end(shape: Shape) -> float:
    """Find where the skeg, followed aft from where it is deepest, has ended, m."""
    x, depth = _stations(shape), shape.take(_depths)
    shallow = _SHALLOW * shape.header.draught
    last = int(depth.argmax())
    while last > 0 and depth[last - 1] > shallow:
        last -= 1
    if last == 0:
        return float(x[0])
    return float(brentq(lambda at: _depth(shape, at) - shallow, x[last - 1], x[last], xtol=1e-9))


def _lowest(shape: Shape, x: float) -> float:
    section = section_at(shape, x)
    return np.nan if section is None else float(section.lowest[2])


def edge_reaches(shape: Shape, height: float) -> float | Absent:
    """Give x where the lower edge of the skeg, followed aft, comes up to a height, m."""
    side = shape.take(skeg)
    if isinstance(side, Absent):
        return side
    edge = side.edge[np.isfinite(side.edge[:, 1])]
    above = np.flatnonzero(edge[:, 1] > height)
    if not len(above) or above[-1] + 1 >= len(edge):
        return Absent("the skeg does not reach the height of the shaft")
    low, high = edge[above[-1] : above[-1] + 2, 0].tolist()
    return float(brentq(lambda at: _lowest(shape, at) - height, low, high, xtol=1e-9))


def edge_radius(side: Skeg) -> float | Absent:
    """Give the radius of the circle fitted to the lower edge, m."""
    edge = side.edge[np.isfinite(side.edge[:, 1])]
    chord = edge[-1] - edge[0]
    off = (edge - edge[0]) @ np.array([-chord[1], chord[0]])
    if float(np.abs(off).max()) <= _STRAIGHT * float(chord @ chord):
        return Absent("the lower edge is straight")
    return fit_circle(edge).radius


def middle_of_skeg(shape: Shape, x: float, z: float) -> float | None:
    """Give y half-way between the inner and the outer skin of a skeg, m; None if it has no two."""
    section = section_at(shape, x)
    skins = np.zeros(0) if section is None else section.skins(z)
    return 0.5 * float(skins[0] + skins[1]) if len(skins) == 2 else None
