"""Entries of twin skegs and the tunnel between them."""

from __future__ import annotations

import math

from assoc_hull.analysis.form.entries.skeg_shape import (
    SINGLE,
    edge_radius,
    middle_of_skeg,
    skeg,
    tunnel_meets_base,
    twin_skeg,
)
from assoc_hull.analysis.form.literature import TABLE_3, TABLE_4
from assoc_hull.analysis.form.parameter import SHAPE, entries_in, parameter
from assoc_hull.analysis.form.profile import profile_at, slope_deg
from assoc_hull.analysis.form.section_shape import section_at
from assoc_hull.analysis.form.shape import Shape
from assoc_hull.analysis.form.value import Absent, Found

__all__ = ["PARAMETERS"]

_NO_SKEG = Absent("no skeg at station 1")

_SIDE = "between the tunnel's top line and the lower edge of the skeg, from where the two meet "
_ENDS = "aft to where the top line meets the base line"


@parameter(
    "TTLS", name="slope of the tunnel's top line", unit="deg", table="hydrostatic",
    definition="of the profile between twin skegs at z = T/2", datum="to the base line",
    source=TABLE_3,
)  # fmt: skip
def tunnel_slope(shape: Shape) -> Found:
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
def skeg_length(shape: Shape) -> Found:
    side = shape.take(skeg)
    return side if isinstance(side, Absent) else side.fore - side.aft


@parameter(
    "ASKEG", name="lateral area of the skeg", unit="m2", table="hull form",
    definition=f"of what lies {_SIDE}{_ENDS}", datum="of one skeg, seen from the side",
    source=TABLE_4,
)  # fmt: skip
def skeg_area(shape: Shape) -> Found:
    side = shape.take(skeg)
    return side if isinstance(side, Absent) else side.area


@parameter(
    "XSKEG", name="centre of the skeg's lateral area", unit="m", table="hull form",
    definition="Lpp / 2 - x of the centre of ASKEG", datum="from midship, + aft",
    source=TABLE_4,
)  # fmt: skip
def skeg_centre(shape: Shape) -> Found:
    side = shape.take(skeg)
    return side if isinstance(side, Absent) else 0.5 * shape.length - side.centroid


@parameter(
    "RSKEG", name="radius of the skeg's lower edge", unit="m", table="hull form",
    definition="of the circle fitted to the lower edge over LSKEG, by least squares of distances",
    source=TABLE_4,
)  # fmt: skip
def skeg_radius(shape: Shape) -> Found:
    side = shape.take(skeg)
    return side if isinstance(side, Absent) else edge_radius(side)


@parameter(
    "TwDS", name="distance between the shafts", unit="% B", table="hull form",
    definition="100 (spacing of the shafts, as given) / B", source=TABLE_4, needs=(SHAPE, "B"),
)  # fmt: skip
def shaft_distance(shape: Shape, breadth: float) -> Found:
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
def tunnel_end(shape: Shape) -> Found:
    x = shape.take(tunnel_meets_base)
    return x if isinstance(x, Absent) else shape.station_of(x)


@parameter(
    "TwVSA", name="inclination of the skeg in the section", unit="deg", table="hull form",
    definition="at station 1, of the line half-way between inner and outer skin, from a quarter "
    "to three quarters of the height from the lowest place to the tunnel's top",
    datum="to the vertical, + if its upper end lies farther out", source=TABLE_4,
)  # fmt: skip
def upright_angle(shape: Shape) -> Found:
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


def _heights(shape: Shape) -> tuple[float, float, float] | None:
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
def plan_angle(shape: Shape) -> Found:
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


PARAMETERS = entries_in(vars())
"""The entries of this module, in order."""
