"""Entries of the stern: transom, overhang, aperture, screw, and twin skegs.

Twin skegs and the tunnel between them: measures, and the entries made of them.

A ship has twin skegs if the half sections of her after body run down from the centre plane to a
lowest point off it. Between the profile, which is the tunnel's top line there, and these lowest
points lies the skeg as seen from the side. Lengths in m, x from the AP. Entries of the stern use
two of the measures.
"""

from __future__ import annotations

import math

import attrs
import numpy as np

from assoc_hull.analysis.form.floating_shape import FloatingShape
from assoc_hull.analysis.form.half_section import section_at
from assoc_hull.analysis.form.parameter import (
    SHAPE,
    TABLE_3,
    TABLE_4,
    Absent,
    MeasuredValue,
    Warned,
    entries_in,
    parameter,
)
from assoc_hull.analysis.form.profile import (
    NO_PROFILE,
    aft_end,
    boss,
    bottom_at,
    height_above,
    leaves_boss,
    profile_at,
    slope_deg,
    transom,
)
from assoc_hull.analysis.net.curve_net import ON_CENTRE, areas_of_flat_ends
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.numeric.circle_fit import fit_circle
from assoc_hull.geometry.numeric.polynomials import brent_root
from assoc_hull.geometry.numeric.quadrature import gauss
from assoc_hull.geometry.splines.plane_intersections import points_at_coordinate
from assoc_hull.tolerance import length_factor

__all__ = [
    "SINGLE",
    "SKEG",
    "STERN",
    "Skeg",
    "edge_radius",
    "edge_reaches",
    "middle_of_skeg",
    "skeg",
    "tunnel_meets_base",
    "twin_skeg",
]

# --------------------------------------------------------------------------------------
# Measures.

SINGLE = Absent("single skeg")

_DEEP = 0.02
"""A section of the after body whose lowest place lies deeper below its centre (in design
draughts) is one of twin skegs."""

_SHALLOW = 5e-6
"""A skeg no deeper than this (in design draughts) has ended."""

_STRAIGHT = 1e-5
"""A lower edge that leaves its chord by less (in lengths of the chord) is straight."""

_BASE = 1e-6
"""A point this near to the base line (m) is on it."""

_POINTS, _EDGE = 4, 49
"""Gauss points between stations, and places on the lower edge to which a circle is fitted."""


def _depth(shape: FloatingShape, x: float) -> float:
    """Give how deep the skeg at a place hangs below the tunnel, m."""
    section = section_at(shape, x)
    top = None if section is None else section.at_centre
    return 0.0 if section is None or top is None else top - float(section.lowest[2])


def _stations(shape: FloatingShape) -> FloatArray:
    x = shape.body.sections.x
    found: FloatArray = x[x < 0.5 * shape.length]
    return found


def _depths(shape: FloatingShape) -> FloatArray:
    return np.array([_depth(shape, x) for x in _stations(shape).tolist()])


def twin_skeg(shape: FloatingShape) -> bool:
    """Tell whether the ship has twin skegs."""
    depth = shape.take(_depths)
    return bool(len(depth) and depth.max() > _DEEP * shape.header.draught)


def tunnel_meets_base(shape: FloatingShape) -> float | Absent:
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


def skeg(shape: FloatingShape) -> Skeg | Absent:
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


def _aft_end(shape: FloatingShape) -> float:
    """Find where the skeg, followed aft from where it is deepest, has ended, m."""
    x, depth = _stations(shape), shape.take(_depths)
    shallow = _SHALLOW * shape.header.draught
    last = int(depth.argmax())
    while last > 0 and depth[last - 1] > shallow:
        last -= 1
    if last == 0:
        return float(x[0])
    return brent_root(lambda at: _depth(shape, at) - shallow, x[last - 1], x[last], xtol=1e-9)


def _lowest(shape: FloatingShape, x: float) -> float:
    section = section_at(shape, x)
    return np.nan if section is None else float(section.lowest[2])


def edge_reaches(shape: FloatingShape, height: float) -> float | Absent:
    """Give x where the lower edge of the skeg, followed aft, comes up to a height, m."""
    side = shape.take(skeg)
    if isinstance(side, Absent):
        return side
    edge = side.edge[np.isfinite(side.edge[:, 1])]
    above = np.flatnonzero(edge[:, 1] > height)
    if not len(above) or above[-1] + 1 >= len(edge):
        return Absent("the skeg does not reach the height of the shaft")
    low, high = edge[above[-1] : above[-1] + 2, 0].tolist()
    return brent_root(lambda at: _lowest(shape, at) - height, low, high, xtol=1e-9)


def edge_radius(side: Skeg) -> float | Absent:
    """Give the radius of the circle fitted to the lower edge, m."""
    edge = side.edge[np.isfinite(side.edge[:, 1])]
    chord = edge[-1] - edge[0]
    off = (edge - edge[0]) @ np.array([-chord[1], chord[0]])
    if float(np.abs(off).max()) <= _STRAIGHT * float(chord @ chord):
        return Absent("the lower edge is straight")
    return fit_circle(edge).radius


def middle_of_skeg(shape: FloatingShape, x: float, z: float) -> float | None:
    """Give y half-way between the inner and the outer skin of a skeg, m; None if it has no two."""
    section = section_at(shape, x)
    skins = np.zeros(0) if section is None else section.skins(z)
    return 0.5 * float(skins[0] + skins[1]) if len(skins) == 2 else None


# --------------------------------------------------------------------------------------
# Entries.

_NO_SKEG = Absent("no skeg at station 1")

_SIDE = "between the tunnel's top line and the lower edge of the skeg, from where the two meet "
_ENDS = "aft to where the top line meets the base line"


@parameter(
    "TTLS", name="slope of the tunnel's top line", unit="deg", table="hydrostatic",
    definition="of the profile between twin skegs at z = T/2", datum="to the base line",
    source=TABLE_3,
)  # fmt: skip
def tunnel_slope(shape: FloatingShape) -> MeasuredValue:
    if not shape.take(twin_skeg):
        return SINGLE
    places = profile_at(shape, 2, 0.5 * shape.draught)
    aft = [] if places is None else [
        along
        for place, along in zip(places.xyz, places.along, strict=True)
        if place[0] < 0.5 * shape.length
    ]  # fmt: skip
    return slope_deg(aft[0]) if aft else Absent("the tunnel does not reach half the draught")


@parameter(
    "HSKEG", name="height of the skeg", unit="m", table="hull form",
    definition="Hap: of the tunnel's top line at AP", datum="from the base line, up",
    source=TABLE_4, needs=("Hap", "TwTTL"),
)  # fmt: skip
def skeg_height(height: float, meets: float) -> float:
    return height


@parameter(
    "LSKEG", name="length of the skeg", unit="m", table="hull form",
    definition=f"of what lies {_SIDE}{_ENDS}", datum="along x", source=TABLE_4, digits=3,
)  # fmt: skip
def skeg_length(shape: FloatingShape) -> MeasuredValue:
    side = shape.take(skeg)
    return side if isinstance(side, Absent) else side.fore - side.aft


@parameter(
    "ASKEG", name="lateral area of the skeg", unit="m2", table="hull form",
    definition=f"of what lies {_SIDE}{_ENDS}", datum="of one skeg, seen from the side",
    source=TABLE_4,
)  # fmt: skip
def skeg_area(shape: FloatingShape) -> MeasuredValue:
    side = shape.take(skeg)
    return side if isinstance(side, Absent) else side.area


@parameter(
    "XSKEG", name="centre of the skeg's lateral area", unit="m", table="hull form",
    definition="Lpp / 2 - x of the centre of ASKEG", datum="from midship, + aft",
    source=TABLE_4,
)  # fmt: skip
def skeg_centre(shape: FloatingShape) -> MeasuredValue:
    side = shape.take(skeg)
    return side if isinstance(side, Absent) else 0.5 * shape.length - side.centroid


@parameter(
    "RSKEG", name="radius of the skeg's lower edge", unit="m", table="hull form",
    definition="of the circle fitted to the lower edge over LSKEG, by least squares of distances",
    source=TABLE_4,
)  # fmt: skip
def skeg_radius(shape: FloatingShape) -> MeasuredValue:
    side = shape.take(skeg)
    return side if isinstance(side, Absent) else edge_radius(side)


@parameter(
    "TwDS", name="distance between the shafts", unit="% B", table="hull form",
    definition="100 (spacing of the shafts, as given) / B", source=TABLE_4, needs=(SHAPE, "B"),
)  # fmt: skip
def shaft_distance(shape: FloatingShape, breadth: float) -> MeasuredValue:
    if shape.screw is None:
        return Absent("no screw given")
    if shape.screw.spacing == 0.0:
        return Absent("single screw")
    return 100.0 * shape.screw.spacing / breadth


@parameter(
    "TwTTL", name="station where the tunnel's top line meets the base line", unit="st",
    table="hull form", definition="of the aftmost place of the profile on the base line",
    datum="AP is 0, FP is 20", source=TABLE_4,
)  # fmt: skip
def tunnel_end(shape: FloatingShape) -> MeasuredValue:
    x = shape.take(tunnel_meets_base)
    return x if isinstance(x, Absent) else shape.station_of(x)


@parameter(
    "TwVSA", name="inclination of the skeg in the section", unit="deg", table="hull form",
    definition="at station 1, of the line half-way between inner and outer skin, from a quarter "
    "to three quarters of the height from the lowest place to the tunnel's top",
    datum="to the vertical, + if its upper end lies farther out", source=TABLE_4,
)  # fmt: skip
def upright_angle(shape: FloatingShape) -> MeasuredValue:
    if not shape.take(twin_skeg):
        return SINGLE
    heights = _heights(shape)
    if heights is None:
        return _NO_SKEG
    low, _, high = heights
    x = shape.x_of(1.0)
    inner, outer = middle_of_skeg(shape, x, low), middle_of_skeg(shape, x, high)
    if inner is None or outer is None:
        return _NO_SKEG
    return math.degrees(math.atan2(outer - inner, high - low))


def _heights(shape: FloatingShape) -> tuple[float, float, float] | None:
    """Give a quarter, half and three quarters of the height of the skeg at station 1."""
    section = section_at(shape, shape.x_of(1.0))
    if section is None or section.at_centre is None:
        return None
    low, top = float(section.lowest[2]), section.at_centre
    return low + 0.25 * (top - low), low + 0.5 * (top - low), low + 0.75 * (top - low)


@parameter(
    "TwLSA", name="inclination of the skeg in plan", unit="deg", table="hull form",
    definition="of the line half-way between inner and outer skin from station 0.9 to 1.1, half "
    "as high as the skeg at station 1", datum="to the centre line, + if it runs out forward",
    source=TABLE_4,
)  # fmt: skip
def plan_angle(shape: FloatingShape) -> MeasuredValue:
    if not shape.take(twin_skeg):
        return SINGLE
    heights = _heights(shape)
    if heights is None:
        return _NO_SKEG
    aft, fore = shape.x_of(0.9), shape.x_of(1.1)
    behind, before = (middle_of_skeg(shape, x, heights[1]) for x in (aft, fore))
    if behind is None or before is None:
        return _NO_SKEG
    return math.degrees(math.atan2(before - behind, fore - aft))


SKEG = entries_in(vars())
"""The entries of this module, in order."""


_NO_SCREW = Absent("no screw given")
_UPRIGHT = 1e-9
"""A direction with a smaller part along the ship stands upright."""


@parameter(
    "ATT", name="immersed area of the transom", unit="m2", table="hydrostatic", ittc="A_T",
    definition="area of the transom below the floating plane; nil if the transom is dry",
    datum="both sides", source=TABLE_3,
)  # fmt: skip
def transom_area(shape: FloatingShape) -> MeasuredValue:
    edge = shape.take(transom)
    if isinstance(edge, Absent):
        return edge
    return float(areas_of_flat_ends(edge, shape.body.closed, shape.planes)[0])


@parameter(
    "B_tr", name="breadth of the transom on the waterline", unit="m", table="measures",
    definition="greatest full breadth of the transom in the floating plane", datum="both sides",
    source=TABLE_3,
)  # fmt: skip
def transom_breadth(shape: FloatingShape) -> MeasuredValue:
    edge = shape.take(transom)
    if isinstance(edge, Absent):
        return edge
    rise = -shape.position.trim_by_stern / shape.length
    level = shape.position.draught_aft + rise * float(edge.xyz[0, 0])
    half = points_at_coordinate(edge, 2, level).xyz[:, 1]
    near = length_factor(shape.length) * ON_CENTRE
    if len(half) and half.max() > near:
        return 2.0 * float(half.max())
    dry = level <= edge.xyz[:, 2].min() + near
    return Absent("transom is dry" if dry else "transom is under water")


@parameter(
    "TH", name="height of the transom", unit="m", table="hull form",
    definition="lowest z of the transom on the centre line", datum="from the base line, up",
    source=TABLE_4,
)  # fmt: skip
def transom_height(shape: FloatingShape) -> MeasuredValue:
    edge = shape.take(transom)
    if isinstance(edge, Absent):
        return edge
    centre = edge.xyz[abs(edge.xyz[:, 1]) <= length_factor(shape.length) * ON_CENTRE]
    if not len(centre):
        return Absent("the transom does not reach the centre plane")
    return float(centre[:, 2].min())


@parameter(
    "TRZ", name="immersion of the transom", unit="m", table="hydrostatic",
    definition="T_A - TH", datum="+ if its lower edge is below T_A", source=TABLE_3,
    needs=("T_A", "TH"),
)  # fmt: skip
def transom_immersion(draught: float, height: float) -> float:
    return draught - height


@parameter(
    "SO", name="stern overhang", unit="m", table="hull form",
    definition="from AP to the aft end of the profile", datum="from AP, + aft", source=TABLE_4,
)  # fmt: skip
def overhang(shape: FloatingShape) -> MeasuredValue:
    x = shape.take(aft_end)
    return x if isinstance(x, Absent) else 0.0 - x


@parameter(
    "Hap", name="height of the bottom at AP", unit="m", table="hull form",
    definition="lowest z of the profile at AP", datum="from the base line, up", source=TABLE_4,
)  # fmt: skip
def bottom_height(shape: FloatingShape) -> MeasuredValue:
    found = bottom_at(shape, 0.0)
    return found if isinstance(found, Absent) else found[0]


@parameter(
    "StemA", name="slope of the stern profile", unit="deg", table="hull form",
    definition="of the profile at AP, where the bottom's rise ends at the height Hap",
    datum="to the base line", source=TABLE_4,
)  # fmt: skip
def stern_slope(shape: FloatingShape) -> MeasuredValue:
    found = bottom_at(shape, 0.0)
    if isinstance(found, Absent):
        return found
    if found[0] <= _BASE:
        return Absent("the bottom does not rise to AP")
    if abs(found[1][0]) <= _UPRIGHT:
        return Absent("the stern stands upright at AP")
    return slope_deg(found[1])


# The screw and what is about it.


@parameter(
    "SCH", name="height of the shaft's centre", unit="m", table="hull form",
    definition="at the screw, as given; else of the circle through the boss end that is drawn",
    datum="from the base line, up", source=TABLE_4,
)  # fmt: skip
def shaft_height(shape: FloatingShape) -> MeasuredValue:
    if shape.screw is not None:
        return shape.screw.height
    end = shape.take(boss)
    return Absent("no screw given, no boss end drawn") if end is None else end.height


@parameter(
    "D_p", name="diameter of the screw", unit="m", table="measures", definition="as given",
    source=TABLE_3, ittc="D",
)  # fmt: skip
def screw_diameter(shape: FloatingShape) -> MeasuredValue:
    return _NO_SCREW if shape.screw is None else shape.screw.diameter


@parameter(
    "PI", name="immersion of the screw's tip", unit="m", table="hydrostatic",
    definition="T_A - SCH - D_p / 2", datum="from the tip, up", source=TABLE_3,
    needs=("T_A", "SCH", "D_p"),
)  # fmt: skip
def tip_immersion(draught: float, height: float, diameter: float) -> float:
    return draught - height - 0.5 * diameter


@parameter(
    "PTC", name="clearance of the screw's tip", unit="% D", table="hull form",
    definition="100 (z - SCH - D_p / 2) / D_p, z the height of the hull over the shaft in the "
    "plane of the screw", datum="from the tip, up", source=TABLE_4,
    needs=(SHAPE, "SCH", "D_p"),
)  # fmt: skip
def tip_clearance(shape: FloatingShape, height: float, diameter: float) -> MeasuredValue:
    if shape.screw is None or shape.screw.x is None:
        return Absent("the plane of the screw is not given")
    above = height_above(shape, shape.screw.x, 0.5 * shape.screw.spacing, height)
    if isinstance(above, Absent):
        return above
    clearance = 100.0 * (above - height - 0.5 * diameter) / diameter
    if clearance < 0.0:
        return Warned(clearance, "the tip of the screw lies within the hull")
    return clearance


@parameter(
    "SA", name="fore edge of the screw's aperture", unit="m", table="hull form",
    definition="foremost x of the after profile at the height SCH; where a boss end is drawn, "
    "where the profile above leaves the boss; of twin skegs, where their lower edge reaches SCH",
    datum="from AP, + forward", source=TABLE_4, needs=(SHAPE, "SCH"),
)  # fmt: skip
def aperture(shape: FloatingShape, height: float) -> MeasuredValue:
    if shape.take(twin_skeg):
        return edge_reaches(shape, height)
    end = shape.take(boss)
    if end is not None:
        return leaves_boss(shape, end)
    places = profile_at(shape, 2, height)
    x = [] if places is None else [each for each in places.xyz[:, 0] if each < 0.5 * shape.length]
    return float(max(x)) if x else Absent("no profile at the height of the shaft")


@parameter(
    "SBx", name="aft face of the stern boss", unit="m", table="hull form",
    definition="x of the boss end that is drawn, else as given with the screw",
    datum="from AP, + forward", source=TABLE_4,
)  # fmt: skip
def boss_face(shape: FloatingShape) -> MeasuredValue:
    end = shape.take(boss)
    if end is not None:
        return end.x
    if shape.screw is None or shape.screw.boss_x is None:
        return Absent("no boss end drawn or given")
    return shape.screw.boss_x


@parameter(
    "SBD", name="diameter of the stern boss", unit="m", table="hull form",
    definition="of the circle through the boss end that is drawn, else as given with the screw",
    source=TABLE_4,
)  # fmt: skip
def boss_diameter(shape: FloatingShape) -> MeasuredValue:
    end = shape.take(boss)
    if end is not None:
        return end.diameter
    if shape.screw is None or shape.screw.boss_diameter is None:
        return Absent("no boss end drawn or given")
    return shape.screw.boss_diameter


STERN = entries_in(vars())[len(SKEG) :]
"""The entries of this module, in order."""
