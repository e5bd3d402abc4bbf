"""Carry a design to other main dimensions: every definition goes along with the ship.

Lengthwise a section goes to where the new ship has its share of the midship area, so that it keeps
its shape; contours at the stern go with the length. Breadths go with B; heights with T below the
draught and with D - T above it; angles by their tangents; what hangs on the bilge with its radius.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from functools import cached_property

import attrs
import numpy as np
from scipy.interpolate import PchipInterpolator

from assoc_hull.creation.area_swing import scaled_half
from assoc_hull.creation.design import Design
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.curve import form_at
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.forms.two_halves import half_fault, half_number, half_vertices
from assoc_hull.model.tables import Particulars

__all__ = ["CarriedDesign", "carried_places", "carry_design"]

_STEP = 1e-6
"""For slopes, m."""


@attrs.frozen(slots=False)
class CarriedDesign:
    """How places of one design go to another.

    Attributes
    ----------
    old, new : Particulars
        Of the two ships.
    old_bilge, new_bilge : float, m
        Radius of the bilge amidships.
    places : tuple of (float, float)
        Abscissae of the first ship and of the second, in the frame from -1 to 1, in order.
    full : float
        Area of the new midship section over that of the old one.
    """

    old: Particulars
    new: Particulars
    old_bilge: float
    new_bilge: float
    places: tuple[tuple[float, float], ...]
    full: float

    def x(self, x: float) -> float:
        """Carry a place along the ship, m from AP; beyond the last places by the length."""
        frame = 2.0 * x / self.old.length - 1.0
        return 0.5 * self.new.length * (1.0 + self.frame(frame))

    def frame(self, at: float) -> float:
        """Carry an abscissa in the frame from -1 to 1."""
        inside = float(np.clip(at, -1.0, 1.0))
        return float(self._course(inside)) + at - inside

    @cached_property
    def _course(self) -> PchipInterpolator:
        return PchipInterpolator(*np.array(self.places).T)

    def z(self, z: float) -> float:
        """Carry a height, m."""
        if z <= self.old.draught:
            return z * self.new.draught / self.old.draught
        over = (self.new.depth - self.new.draught) / (self.old.depth - self.old.draught)
        return self.new.draught + (z - self.old.draught) * over

    def y(self, y: float) -> float:
        """Carry a half-breadth, m."""
        return y * self.new.breadth / self.old.breadth

    def side(self, z: float) -> float:
        """Carry a height of the border of the flat of side, which begins at the bilge."""
        if z > self.old.draught:
            return self.z(z)
        old = (0.0, self.old_bilge, self.old.draught)
        return float(np.interp(z, old, (0.0, self.new_bilge, self.new.draught)))

    def bottom(self, y: float) -> float:
        """Carry a half-breadth of the flat of bottom."""
        flat = [0.5 * ship.breadth - r for ship, r in self._bilges]
        return y * flat[1] / flat[0]

    @property
    def _bilges(self) -> tuple[tuple[Particulars, float], ...]:
        return ((self.old, self.old_bilge), (self.new, self.new_bilge))

    @property
    def turn(self) -> float:
        """Give by what tangents of angles of sections below the draught grow."""
        return (self.new.breadth / self.old.breadth) / (self.new.draught / self.old.draught)

    @property
    def upper_turn(self) -> float:
        """Give the same above the draught."""
        above = [ship.depth - ship.draught for ship in (self.old, self.new)]
        return (self.new.breadth / self.old.breadth) / (above[1] / above[0])


def carried_places(
    old: FormDefinition, new: FormDefinition, stern: float
) -> tuple[tuple[float, float], ...]:
    """Give places of one curve of areas and, at the same ordinates, of another.

    Abaft `stern` places stay; the change sets in over a fifteenth of the length ahead of it.
    """
    places = [(-1.0, -1.0), (stern, stern)]
    halves = (("run", "run_end", stern), ("entrance", "entrance_start", 1.0))
    for half, inner, outer in halves:
        graphs = [_graph(each, half) for each in (old, new)]
        ends = [half_number(each, inner) for each in (old, new)]
        found = [(ends[0], ends[1])]
        rising = [graph if half == "run" else graph[::-1] for graph in graphs]
        for part in _PARTS:
            at = outer + part * (ends[0] - outer)
            ordinate = float(np.interp(at, graphs[0][:, 0], graphs[0][:, 1]))
            if ordinate > _NEARLY_FULL:
                continue
            to = float(np.interp(ordinate, rising[1][:, 1], rising[1][:, 0]))
            if half == "run":
                share = min((at - stern) / _SETS_IN, 1.0)
                to = at + share * (to - at)
            found.append((at, to))
        places += sorted(found)
    return tuple([*places, (1.0, 1.0)])


def _graph(definition: FormDefinition, half: str) -> FloatArray:
    """Give points of a half, (n, 2), from aft."""
    vertices = half_vertices(definition, half)
    return form_at(np.broadcast_to(vertices, (len(_FINE), 7, 2)), _FINE)


_PARTS = (0.15, 0.3, 0.45, 0.6, 0.75, 0.85)
"""Of the length of a half, from its end."""

_NEARLY_FULL = 0.985
"""Ordinate above which a curve of areas is too flat to tell places."""

_SETS_IN = 0.13


def carry_design(design: Design, areas: FormDefinition, carried: CarriedDesign) -> Design:
    """Give the design of the new ship, with this curve of areas; its lines are those of the old."""
    found = [
        areas if each.use == "sectional_area"
        else _waterline(each, carried) if each.use == "design_waterline"
        else _course(each, carried)
        for each in design.definitions
    ]  # fmt: skip
    stations = tuple(20.0 * carried.x(x) / carried.new.length for x in design.station_places)
    return Design(
        carried.new, found, stations,
        tuple(carried.z(z) for z in design.waterlines),
        tuple(carried.y(y) for y in design.buttocks),
        None if design.transom is None else carried.x(design.transom),
        design.tolerances,
    )  # fmt: skip


def _waterline(line: FormDefinition, carried: CarriedDesign) -> FormDefinition:
    """Carry the waterline: each half has area and centroid of its half-breadths, carried."""
    found = line.having({"full": 0.5 * carried.new.breadth})
    for half, inner in (("run", "run_end"), ("entrance", "entrance_start")):
        found = scaled_half(found, half, carried.frame(half_number(line, inner)))
        curve = _graph(line, half)
        x = np.array([carried.frame(each) for each in curve[:, 0].tolist()])
        area = float(np.trapezoid(curve[:, 1], x))
        centroid = float(np.trapezoid(curve[:, 1] * x, x)) / area
        for values in ((area, centroid), (area, None)):
            other = found.having(
                dict(zip((f"{half}_area", f"{half}_centroid"), values, strict=True))
            )
            if not half_fault(other, half):
                found = other
                break
    return found


_FINE = np.linspace(0.0, 4.0, 801)
"""Parameters of a half at which it is integrated."""

Carry = Callable[[float], float]


def _course(course: FormDefinition, carried: CarriedDesign) -> FormDefinition:
    """Carry the nodes of a course: place, ordinate, direction, curvature."""
    ordinate = _ordinate(course.use, carried)
    changes: dict[str, float | None] = {}
    for node in course.nodes:
        x, y = (course.value(f"{node}_{name}") for name in ("x", "y"))
        assert x is not None
        assert y is not None
        changes |= {f"{node}_x": carried.x(x), f"{node}_y": ordinate(y)}
        # Downward from the node: the draught belongs to what lies below it.
        slopes = _slope(carried.x, x), (ordinate(y) - ordinate(y - _STEP)) / _STEP
        for leave in ("", "leave_"):
            changes |= _turned(course, f"{node}_{leave}", *slopes)
    found = course.having(changes)
    return found.having(_paces(course, found)) if course.rule == "form" else found


def _paces(old: FormDefinition, new: FormDefinition) -> dict[str, float | None]:
    """Give the tangents with which each piece of a course is that of the old one, stretched.

    They are parts of chords, and a chord grows by another factor than a level or upright tangent:
    kept, a flatter forefoot would run below the base line.
    """
    found: dict[str, float | None] = {}
    for first, last in itertools.pairwise(old.nodes):
        steps = np.array([
            [_plain(each, f"{last}_{axis}") - _plain(each, f"{first}_{axis}") for axis in "xy"]
            for each in (old, new)
        ])  # fmt: skip
        if not steps.all():
            continue
        chords = np.hypot(*steps.T)
        stretch = steps[1] / steps[0] * chords[0] / chords[1]
        for node, prefixes in ((first, ("leave_", "")), (last, ("",))):
            angle, pace = (
                next(
                    (
                        v
                        for each in prefixes
                        if (v := old.value(f"{node}_{each}{name}")) is not None
                    ),
                    None,
                )
                for name in ("angle_deg", "tangent")
            )
            if angle is None:
                continue
            radians = math.radians(angle)
            size = math.hypot(stretch[0] * math.cos(radians), stretch[1] * math.sin(radians))
            found[f"{node}_{prefixes[0]}tangent"] = (1.0 if pace is None else pace) * size
    return found


def _plain(course: FormDefinition, name: str) -> float:
    found = course.value(name)
    assert found is not None
    return found


def _slope(carry: Carry, at: float) -> float:
    # From abaft: at FP the contour below the draught counts, not the stem's rake above it.
    return (carry(at) - carry(at - _STEP)) / _STEP


def _turned(course: FormDefinition, name: str, along: float, up: float) -> dict[str, float | None]:
    """Give direction and curvature of a node in stretched axes; those not given stay so."""
    angle = course.value(f"{name}angle_deg")
    if angle is None:
        return {}
    turned = (along * math.cos(math.radians(angle)), up * math.sin(math.radians(angle)))
    found: dict[str, float | None] = {
        f"{name}angle_deg": math.degrees(math.atan2(turned[1], turned[0]))
    }
    curvature = course.value(f"{name}curvature")
    if curvature is not None:
        found[f"{name}curvature"] = curvature * along * up / math.hypot(*turned) ** 3
    return found


def _ordinate(use: str, carried: CarriedDesign) -> Carry:
    """Give how an ordinate of a definition of this use goes along."""
    old, new = carried.old, carried.new
    bend = carried.old_bilge / carried.new_bilge
    known: dict[str, Carry] = {
        "profile": carried.z, "deck_height": carried.z, "deck_centre": carried.z,
        "centroid": carried.z, "bulb_height": carried.z,
        "deck_side": carried.y, "half_siding": carried.y, "bulb_neck": carried.y,
        "flat_of_side": carried.side, "flat_of_bottom": carried.bottom,
        "bilge_radius": lambda r: r / bend,
        "keel_angle": lambda a: _leaned(a, carried.turn),
        "waterline_angle": lambda a: _leaned(a, carried.turn),
        "bulb_neck_angle": lambda a: _leaned(a, carried.turn),
        "deck_angle": lambda a: _leaned(a, carried.upper_turn),
        "keel_curvature": lambda k: k * bend,
        "waterline_curvature": lambda k: k * bend,
        "deck_curvature": lambda k: k * old.depth / new.depth,
        "bulb_area": lambda a: a * carried.full,
    }  # fmt: skip
    # Tangents are parts of chords: they stay.
    return known.get(use, lambda value: value)


def _leaned(angle: float, turn: float) -> float:
    """Give an angle (degrees, 0 upright) when breadths grow by `turn` more than heights."""
    radians = math.radians(angle)
    return math.degrees(math.atan2(turn * math.sin(radians), math.cos(radians)))
