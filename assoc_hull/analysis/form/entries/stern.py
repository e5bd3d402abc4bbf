"""Entries of the stern: transom, overhang, aperture, screw."""

from __future__ import annotations

from assoc_hull.analysis.form.entries.skeg import edge_reaches, twin_skeg
from assoc_hull.analysis.form.floating_shape import FloatingShape
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
from assoc_hull.geometry.splines.plane_intersections import points_at_coordinate
from assoc_hull.tolerance import length_factor

__all__ = ["STERN"]

_NO_SCREW = Absent("no screw given")
_UPRIGHT = 1e-9
"""A direction with a smaller part along the ship stands upright."""

_BASE = 1e-6
"""So near to the base line (m) a place is on it."""


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


STERN = entries_in(vars())
"""The entries of this module, in order."""
