"""The parent as layouts of fields know it: dimensions, and places measured on its curves.

`parent_of` takes both from the measured parameters of a hull, with a reason for each place that
the hull lacks. A parent can be mapped: local fields are laid out on the one that the principal
dimensions have scaled. Lengths in m, x from AP forward, z from the base line up.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.tables import HullState
from assoc_hull.variation.parameters.hull_and_end_measures import bulb_frame, design_waterline
from assoc_hull.variation.parameters.measurement import (
    DrawnCurves,
    MeasuredParameter,
    Measures,
    SectionFrames,
    measure_frames,
)
from assoc_hull.variation.parameters.parameter_measures import measure_all

__all__ = [
    "Parent",
    "cannot_vary",
    "parent_of",
]

_MEASURED_AS = {
    "body start": "parallel_body_start", "body end": "parallel_body_end",
    "corner": "bilge_radius", "bilge low": "bilge_radius", "bilge high": "bilge_radius",
    "deck": "depth", "bulb tip": "bulb_height", "bulb top": "bulb_height",
    "boss": "shaft_height", "boss top": "bossing_radius", "transom": "transom_height",
}  # fmt: skip
"""The parameter whose measure gives a place; where the place is missing, its reason says why."""


def cannot_vary(name: str, why: str, remedy: str = "leave it out") -> BadInputError:
    """Give the error of a parameter that has no field on this parent, with the reason."""
    return BadInputError(f"cannot vary '{name}': {why}", "in vary", remedy)


def _no_frames() -> SectionFrames:
    none: FloatArray = np.zeros(0)
    return SectionFrames(none, np.zeros(1, np.int64), np.zeros((0, 3)), none)


@attrs.frozen(eq=False)
class Parent:
    """Dimensions and measured places of a parent.

    Attributes
    ----------
    length, breadth, depth, draught : float, m
    top : float, m
        Greatest height of the hull.
    places : mapping of str to (3,) array, m
        Where parameters are measured, by what lies there: ``"boss"``, ``"bulb tip"`` ...
    absent : mapping of str to str
        Parameters that the parent has not, with the reason.
    frames : callable
        Gives the sections up to the draught; sampled when they are asked for.
    waterline : callable
        Gives places of the design waterline, (n, 3), m, from aft, close together.
    bulb : callable
        Gives the section at FP up to the draught, of a ship with a bulb.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.parameters.parent import Parent
    >>> ship = Parent(300, 50, 27, 18, 27, {"boss": np.array([6.0, 0.0, 5.0])})
    >>> ship.at("boss", "shaft_height").tolist()
    [6.0, 0.0, 5.0]
    """

    length: float
    breadth: float
    depth: float
    draught: float
    top: float
    places: Mapping[str, FloatArray]
    absent: Mapping[str, str] = attrs.field(factory=dict)
    frames: Callable[[], SectionFrames] = attrs.field(default=_no_frames, repr=False)
    waterline: Callable[[], FloatArray] = attrs.field(default=lambda: np.zeros((0, 3)), repr=False)
    bulb: Callable[[], SectionFrames] = attrs.field(default=_no_frames, repr=False)

    def at(self, place: str, parameter: str) -> FloatArray:
        """Give a place that a parameter needs.

        Raises
        ------
        BadInputError
            The parent has none; the message has the reason.
        """
        found = self.places.get(place)
        if found is None or parameter in self.absent:
            measured = self.absent.get(_MEASURED_AS.get(place, ""), f"the parent has no {place}")
            why = self.absent.get(parameter, measured)
            raise cannot_vary(parameter, why, "leave it out, or give the parent one")
        return found

    def has(self, place: str) -> bool:
        """Tell whether the parent has a place."""
        return place in self.places

    def mapped(self, move: Callable[[FloatArray], FloatArray], **dimensions: float) -> Parent:
        """Give the parent with its places mapped, and some dimensions that were asked for."""
        keys = list(self.places)
        moved = move(np.array([self.places[key] for key in keys]).reshape(-1, 3))
        places = dict(zip(keys, moved, strict=True))
        top = float(move(np.array([[0.5 * self.length, 0.0, self.top]]))[0, 2])
        return Parent(
            dimensions.get("length", self.length), dimensions.get("breadth", self.breadth),
            dimensions.get("depth", self.depth), dimensions.get("draught", self.draught),
            top, places, self.absent, cache(lambda: self.frames().mapped(move)),
            cache(lambda: np.array(move(self.waterline()))),
            cache(lambda: self.bulb().mapped(move)),
        )  # fmt: skip


_LEVEL = 1e-6
"""m: the keel is level as far as it rises no more above its lowest place; also, radii and heights
of circles that differ by no more are alike."""

_ALIKE = 1e-6
"""Areas of two stations that differ by less than this part of the largest are alike."""

_CLOSE = 8
"""Chords that stand for a segment of the design waterline."""

_FEWEST = 3
"""Stations that a hull must have for its areas to tell anything."""


def parent_of(state: HullState, measures: Measures | None = None) -> Parent:
    """Give dimensions and measured places of a hull.

    Parameters
    ----------
    state : HullState
        The tables.
    measures : Measures or None
        All named parameters, if they have been measured.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.variation.parameters.parent import parent_of
    >>> parent_of(wigley()).at("deck", "depth").tolist()
    [50.0, 5.0, 9.375]
    """
    found = measure_all(state) if measures is None else measures
    ship = state.particulars
    every = state.rows.xyz[state.live("rows")]
    places = dict[str, FloatArray]()
    for anchor in found.anchors.values():
        if anchor.value is not None:
            places.update(_PLACES.get(anchor.name, _nothing)(anchor))
    places.update(_terminals(state))
    if "body start" not in places:
        places.update(_largest_stations(state))
    places.update(_cylinder(state, places.get("boss side")))
    depth = float(found["depth"]) if "depth" in found else ship.depth
    top = float(every[:, 2].max())
    return Parent(
        ship.length, ship.breadth, depth, ship.draught, top, places, dict(found.absent),
        cache(lambda: measure_frames(DrawnCurves(state))),
        cache(lambda: _waterline(DrawnCurves(state))),
        cache(lambda: bulb_frame(DrawnCurves(state)) or _no_frames()),
    )  # fmt: skip


def _waterline(hull: DrawnCurves) -> FloatArray:
    """Give places of the design waterline, (n, 3), m, from aft."""
    waterline = hull.take(design_waterline)
    xyz = np.zeros((0, 3)) if isinstance(waterline, str) else sample(waterline, _CLOSE)[1]
    return np.array(xyz[np.argsort(xyz[:, 0], kind="stable")])


def _place(x: float, y: float, z: float) -> FloatArray:
    return np.array([x, y, z], np.float64)


def _nothing(anchor: MeasuredParameter) -> dict[str, FloatArray]:
    """Give no places: of a parameter that fields are not anchored at."""
    return {}


def _one(name: str, anchor: MeasuredParameter) -> dict[str, FloatArray]:
    """Give the first place of a measure under a name."""
    return {name: anchor.places[0]}


def _decks(anchor: MeasuredParameter) -> dict[str, FloatArray]:
    """Give the deck at AP, midship and FP, those that were measured."""
    names = {"at_AP": "deck aft", "at_midship": "deck", "at_FP": "deck fore"}
    return {names[key]: anchor.places[i] for i, key in enumerate(anchor.numbers)}


def _shaft(anchor: MeasuredParameter) -> dict[str, FloatArray]:
    """Give the centre of the boss end, and its upper side if it is drawn."""
    found, r = _one("boss", anchor), anchor.numbers.get("r", 0.0)
    if r:
        found["boss top"] = anchor.places[0] + _place(0.0, 0.0, r)
    return found


def _bossing(anchor: MeasuredParameter) -> dict[str, FloatArray]:
    """Give the side of the bossing's end, at the height of its centre."""
    r = float(anchor.value or 0.0)
    return {"boss side": anchor.places[0] + _place(0.0, r, 0.0)}


def _cylinder(state: HullState, side: FloatArray | None) -> dict[str, FloatArray]:
    """Give where the bossing ceases to be the cylinder that it ends as: its foremost circle."""
    found = [] if side is None else [
        np.array(each.centre) for each in state.features
        if each.kind == "circle" and each.centre is not None and each.radius is not None
        and abs(each.radius - side[1]) <= _LEVEL and abs(each.centre[2] - side[2]) <= _LEVEL
    ]  # fmt: skip
    return {"boss fore": max(found, key=lambda place: float(place[0]))} if found else {}


def _bulb(anchor: MeasuredParameter) -> dict[str, FloatArray]:
    """Give the tip of the bulb, and the top of the bulb above it."""
    tip = anchor.places[0]
    return {"bulb tip": tip, "bulb top": _place(tip[0], 0.0, anchor.numbers["top"])}


def _bilge(anchor: MeasuredParameter) -> dict[str, FloatArray]:
    """Give where the bilge begins and ends, and the corner of its tangents."""
    of = anchor.numbers
    corner = _place(of["x"], of["corner_y"], of["corner_z"])
    return {"bilge low": anchor.places[0], "bilge high": anchor.places[1], "corner": corner}


def _deadrise(anchor: MeasuredParameter) -> dict[str, FloatArray]:
    """Give the keel's side and two places of the bottom between which its slope is measured."""
    of, inner = anchor.numbers, anchor.places[0]
    slope = np.tan(np.radians(float(anchor.value or 0.0)))
    outer = anchor.places[1] if len(anchor.places) > 1 else inner + _place(0.0, 1.0, slope)
    keel = _place(of["x"], of["keel"], 0.0)
    return {"keel side": keel, "bottom": inner, "bottom edge": outer}


_PLACES: Mapping[str, Callable[[MeasuredParameter], dict[str, FloatArray]]] = {
    "depth": lambda anchor: _one("deck", anchor),
    "deck_height": _decks,
    "shaft_height": _shaft,
    "bossing_radius": _bossing,
    "transom_height": lambda anchor: _one("transom", anchor),
    "transom_half_breadth": lambda anchor: _one("transom side", anchor),
    "bulb_height": _bulb,
    "bulb_half_breadth": lambda anchor: _one("bulb side", anchor),
    "bilge_radius": _bilge,
    "deadrise_deg": _deadrise,
    "flat_of_bottom": lambda anchor: _one("flat edge", anchor),
    "parallel_body_start": lambda anchor: _one("body start", anchor),
    "parallel_body_end": lambda anchor: _one("body end", anchor),
    "stem_rake_deg": lambda anchor: {"stem": anchor.places[0], "stem top": anchor.places[1]},
    "entrance_deg": lambda anchor: {
        "entrance": anchor.places[0],
        "waterline fore": anchor.places[1],
    },
    "run_deg": lambda anchor: {"run": anchor.places[0], "waterline aft": anchor.places[1]},
}


def _terminals(state: HullState) -> dict[str, FloatArray]:
    """Give where the profile begins to rise; the perpendiculars if it is nowhere level."""
    length = state.particulars.length
    boundary = state.lines.boundary.data == BoundaryKind.END
    found = list[FloatArray]()
    for curve in state.live("curves").tolist():
        if boundary[state.line_of(curve)]:
            xyz = state.rows.xyz[state.curves.rows[curve]]
            if len(xyz) and bool((np.abs(xyz[:, 1]) <= _LEVEL).all()):
                found.append(xyz)
    aft, fore = 0.0, length
    if found:
        profile = np.concatenate(found)
        level = profile[profile[:, 2] <= profile[:, 2].min() + _LEVEL, 0]
        # a keel that is level over less than a tenth of the ship counts as nowhere level
        if level.max() - level.min() > 0.1 * length:
            aft, fore = max(0.0, float(level.min())), min(length, float(level.max()))
    return {"aft terminal": _place(aft, 0.0, 0.0), "fore terminal": _place(fore, 0.0, 0.0)}


def _largest_stations(state: HullState) -> dict[str, FloatArray]:
    """Give the two stations with the largest areas, which stand for the ends of a parallel body.

    If two are second alike, the largest alone stands for both.
    """
    level = FloatingPlanes(np.array([state.particulars.draught]), np.zeros(1), np.zeros(1))
    try:
        found = flotation(state).stations(level)
    except AssocHullError:
        return {}  # what has no areas cannot be shifted by them
    area = found.area[0]
    order = np.argsort(-area, kind="stable")
    if len(order) < _FEWEST:
        return {}
    first, second, third = order[:3].tolist()
    if area[second] - area[third] <= _ALIKE * area[first] < area[first] - area[second]:
        second = first
    aft, fore = np.sort(found.x[[first, second]]).tolist()
    return {"largest aft": _place(aft, 0.0, 0.0), "largest fore": _place(fore, 0.0, 0.0)}
