"""A ship by main types (PRELIKON): sections of lines and arcs, decks, boundaries, boxes, houses.

`Prelikon` is the definition; its lines come from `prelikon_lines`. Volumes are exact areas of
sections integrated by parabolas along the ship, without appendages. x from AP, y outward, z up from
the base line, m. Source: the PRELIKON system in Kim & Chang, "Some Representations of Ship Hulls by
Mathematical Method for Design and Production", J. SNAK.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from types import MappingProxyType
from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import simpson
from scipy.interpolate import PchipInterpolator

from assoc_hull.analysis.hydrostatics.floating_body import Appendage
from assoc_hull.arguments import all_of, instance, shown
from assoc_hull.creation.classical.bodies_beside import (
    DECK_PARTS,
    box_body,
    camber_body,
    house_body,
)
from assoc_hull.creation.classical.prelikon_lines import (
    ENDS,
    SAME_PLACE,
    ArcJoint,
    CentrelineProfile,
    Station,
    arc_joints,
    make_profile,
    prelikon_lines,
    section_contact,
    sorted_stations,
    station_name,
    trim_station,
    upper_deck,
)
from assoc_hull.creation.classical.report import (
    ClassicalReport,
    DefinedSection,
    ReportFigure,
    departures,
    measure_net,
    with_net_figures,
)
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.appendages import AppendageBox
from assoc_hull.geometry.classical.arc_curve import ArcBoundary
from assoc_hull.geometry.classical.boundary_lines import SpaceCurve
from assoc_hull.geometry.classical.checked_input import digits, finite_array
from assoc_hull.geometry.classical.deck import Deck, DeckHouse, require_decks_apart
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.attached_body import AttachedBody
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import HullState, Particulars

__all__ = [
    "LATER",
    "MAIN_TYPES",
    "HullVolume",
    "LongitudinalIntegral",
    "Prelikon",
    "area_above_side",
    "checked_cuts",
    "integrate_along",
    "prelikon_cuts",
    "prelikon_notes",
    "prelikon_report",
    "require_types",
    "volume_below",
    "volume_to_deck",
]

# --------------------------------------------------------------------------------------
# Main types, and which of them needs which.

MAIN_TYPES: Mapping[int, str] = MappingProxyType({
    1: "general",
    2: "sheer",
    3: "camber",
    4: "deck",
    5: "transverse sections",
    6: "boundary curves",
    7: "appendages",
    8: "deck houses",
    9: "space curves",
})  # fmt: skip
"""Number and name of every main type."""

LATER = (7, 8)
"""Main types that are better given after the others, when the body plan has been looked at."""

_REQUIRED = (1, 5)
_NEEDS = {4: (2, 3), 8: (2, 3, 4)}


def require_types(given: Iterable[object]) -> tuple[int, ...]:
    """Check that a job has the main types that it needs; give them sorted, each once.

    Origin and units (1) and transverse sections (5) must be there; a deck (4) needs sheer and
    camber, a deck house (8) those and a deck. Raises GeometryError with the type that is missing.
    """
    try:
        listed = list(given)
    except TypeError:
        what = f"main types: expected numbers, got {shown(given)}"
        raise GeometryError(what, "give a set of numbers") from None
    numbers = sorted({_known(each) for each in listed})
    for needed in _REQUIRED:
        if needed not in numbers:
            raise GeometryError(
                f"main type {needed} is required", f"give the {MAIN_TYPES[needed]}",
                {"type": needed},
            )  # fmt: skip
    for each in numbers:
        for needed in _NEEDS.get(each, ()):
            if needed not in numbers:
                raise GeometryError(
                    f"main type {each} needs main type {needed}",
                    f"give the {MAIN_TYPES[needed]}, or leave out the {MAIN_TYPES[each]}",
                    {"type": each, "needs": needed},
                )  # fmt: skip
    return tuple(numbers)


def _known(each: object) -> int:
    if isinstance(each, bool) or not isinstance(each, int) or each not in MAIN_TYPES:
        raise GeometryError(f"main type {shown(each)}: unknown", "use 1 to 9", {"type": each})
    return each


# --------------------------------------------------------------------------------------
# Volumes and centres.

_ABOVE = 1e6
"""A height (m) above all hulls."""


@attrs.frozen
class LongitudinalIntegral:
    """An integral along the ship.

    Attributes
    ----------
    total, moment : float
        Integrals of f and of x f.
    error : float
        How far `total` may be off: three times what another interpolation of the same values
        differs by, or half of what every second station gives, if that is more; no bound.
    """

    total: float
    moment: float
    error: float


@attrs.frozen
class HullVolume:
    """A volume, both sides.

    Attributes
    ----------
    volume : float, m3
        Of it.
    x, z : float, m
        Its centre, from AP or wherever x is counted from, and from the base line.
    error : float, m3
        How far the volume may be off by the rule of integration.
    """

    volume: float
    x: float
    z: float
    error: float


def integrate_along(x: ArrayLike, values: ArrayLike) -> LongitudinalIntegral:
    """Integrate values at stations by parabolas through each three of them.

    With an odd number of stations at equal distances this is Simpson's first rule; where
    distances differ the parabolas are those through unequal steps, and an even number of stations
    has its last interval under the parabola of the last three. Two stations make a trapezium;
    `x`, (m,), increases.
    """
    at, given = finite_array(x, "stations", (None,)), finite_array(values, "stations", (None,))
    total = float(simpson(given, x=at))
    other = float(PchipInterpolator(at, given).integrate(at[0], at[-1]))
    error = 3.0 * abs(total - other)
    if len(at) > 4:
        some = np.append(np.arange(0, len(at) - 1, 2), len(at) - 1)
        error = max(error, 0.5 * abs(total - float(simpson(given[some], x=at[some]))))
    return LongitudinalIntegral(total, float(simpson(at * given, x=at)), error)


def area_above_side(station: Station, deck: Deck, level: float = np.inf) -> tuple[float, float]:
    """Give area (m2) and moment (m3, about z = 0) between deck and the level of the deck edge.

    One side; the station is cut off at the deck. Above `level` (m) nothing counts.
    """
    y, z = station.curve.arcs.ends()[-1].tolist()
    if y <= 0.0 or level <= z:
        return 0.0, 0.0
    nodes, weights = np.polynomial.legendre.leggauss(32)
    breaks = deck.camber.y
    scale = y / deck.camber.half_breadth if deck.camber.scale == "local" else 1.0
    inner = breaks[1:-1] * scale
    ends = np.concatenate([[0.0], inner[inner < y], [y]])
    half = 0.5 * np.diff(ends)
    at = (ends[:-1, None] + half[:, None] * (1.0 + nodes)).ravel()
    weight = (half[:, None] * weights).ravel()
    top = np.minimum(deck.at(station.x, at, np.full(len(at), y)), level)
    return float((weight * (top - z)).sum()), float((weight * 0.5 * (top**2 - z**2)).sum())


def volume_below(
    stations: Sequence[Station], profile: CentrelineProfile, draught: float
) -> HullVolume:
    """Give what lies below a height (m): exact areas, parabolas along the ship.

    The integral runs between the places where the profile is farthest out below that height; areas
    go to zero there, unless the hull ends flat.
    """
    area, moment = np.array([_areas_below(each, draught) for each in stations]).T
    return _hull_volume(stations, profile, draught, area, moment)


def volume_to_deck(
    stations: Sequence[Station], profile: CentrelineProfile, deck: Deck | None
) -> HullVolume:
    """Give all of the hull, the space under the camber included."""
    found = []
    for each in stations:
        area, moment = _areas_below(each, np.inf)
        more, above = (0.0, 0.0) if deck is None else area_above_side(each, deck)
        found.append((area + more, moment + above))
    area, moment = np.array(found).T
    return _hull_volume(stations, profile, np.inf, area, moment)


def _areas_below(station: Station, level: float) -> tuple[float, float]:
    """Give area (m2) and moment (m3, about z = 0) of half a section, closed at the level (m)."""
    area, _, moment = station.curve.moments_below(level)
    return area, moment


def _hull_volume(
    stations: Sequence[Station], profile: CentrelineProfile, draught: float, area: FloatArray,
    moment: FloatArray,
) -> HullVolume:  # fmt: skip
    """Integrate areas and moments of halves of sections between the ends of the profile below."""
    x = np.array([each.x for each in stations])
    level = min(draught, _ABOVE)
    after, fore = profile.aftermost(level), profile.foremost(level)
    # A station at an end of the profile counts with its area: the hull ends flat there.
    within = (x > after + SAME_PLACE) & (x < fore - SAME_PLACE)
    ends = [np.abs(x - place) <= SAME_PLACE for place in (after, fore)]
    sides = [np.concatenate([area[at][:1], np.zeros(1)])[0] for at in ends]
    tops = [np.concatenate([moment[at][:1], np.zeros(1)])[0] for at in ends]
    x = np.concatenate([[after], x[within], [fore]])
    area = np.concatenate([sides[:1], area[within], sides[1:]])
    moment = np.concatenate([tops[:1], moment[within], tops[1:]])
    if len(x) < 3 and not area.any():
        return HullVolume(0.0, float(x.mean()), draught, 0.0)
    volume, height = integrate_along(x, 2.0 * area), integrate_along(x, 2.0 * moment)
    if volume.total == 0.0:
        return HullVolume(0.0, float(x.mean()), draught, 0.0)
    return HullVolume(
        volume.total, volume.moment / volume.total, height.total / volume.total, volume.error
    )


# --------------------------------------------------------------------------------------
# The definition.

_WHERE = "in a ship of main types"


@attrs.frozen(eq=False)
class Prelikon:
    """A ship of main types; x is counted from AP.

    Attributes
    ----------
    particulars : Particulars
        Name and principal dimensions (main type 1).
    stations : tuple of Station
        Transverse sections (5), from aft forward, cut off at the upper deck.
    decks : tuple of Deck
        Decks (4), each with its sheer (2) and camber (3).
    boundaries : tuple of ArcBoundary
        Boundary curves (6): those named stern and stem are the ends of the profile.
    boxes : tuple of AppendageBox
        Appendages (7).
    houses : tuple of DeckHouse
        Deck houses (8).
    hatches : tuple of DeckHouse
        Hatches (8); blocks on a deck as deck houses are.
    curves : tuple of SpaceCurve
        Space curves (9).
    profile : CentrelineProfile
        Stern, keel and stem.
    cuts : mapping of str to tuple of float, m
        Heights of waterlines, half-breadths of buttocks that the net is cut by.
    notes : tuple of str
        What was moved, what the net leaves out.
    """

    particulars: Particulars
    stations: tuple[Station, ...]
    decks: tuple[Deck, ...]
    boundaries: tuple[ArcBoundary, ...]
    boxes: tuple[AppendageBox, ...]
    houses: tuple[DeckHouse, ...]
    hatches: tuple[DeckHouse, ...]
    curves: tuple[SpaceCurve, ...]
    profile: CentrelineProfile
    cuts: Mapping[str, tuple[float, ...]]
    notes: tuple[str, ...]

    @classmethod
    def make(
        cls,
        particulars: Particulars,
        stations: Sequence[Station],
        *,
        decks: Sequence[Deck] = (),
        boundaries: Sequence[ArcBoundary] = (),
        boxes: Sequence[AppendageBox] = (),
        houses: Sequence[DeckHouse] = (),
        hatches: Sequence[DeckHouse] = (),
        curves: Sequence[SpaceCurve] = (),
        cuts: Mapping[str, Sequence[float]] | None = None,
        notes: Sequence[str] = (),
    ) -> Self:
        """Put a ship together; arguments as the attributes.

        Parameters
        ----------
        cuts : mapping of str to sequence of float or None
            ``"waterlines"`` and ``"buttocks"``, m; some are chosen for what is left out.
        notes : sequence of str
            What to say beforehand.

        Raises
        ------
        GeometryError
            A main type that another one needs; sections that begin off the profile or end below
            the deck; decks that meet; a deck house wider than its deck.
        """
        instance(particulars, Particulars, "particulars", _WHERE)
        given = sorted_stations(all_of(stations, Station, "stations", _WHERE))
        given_decks = tuple(all_of(decks, Deck, "decks", _WHERE))
        bounds = tuple(all_of(boundaries, ArcBoundary, "boundaries", _WHERE))
        given_boxes = tuple(all_of(boxes, AppendageBox, "boxes", _WHERE))
        given_houses = tuple(all_of(houses, DeckHouse, "houses", _WHERE))
        given_hatches = tuple(all_of(hatches, DeckHouse, "hatches", _WHERE))
        blocks = (*given_houses, *given_hatches)
        given_curves = tuple(all_of(curves, SpaceCurve, "curves", _WHERE))
        types = {1, *([5] if given else []), *([8] if blocks else [])}
        require_types(types | ({2, 3, 4} if given_decks else set()))
        if len(given) < 2:
            what = f"transverse sections: {len(given)} of them"
            raise GeometryError(what, "give two or more", {"count": len(given)})
        deck = upper_deck(given_decks)
        cut = tuple(trim_station(each, deck) for each in given)
        profile = make_profile(cut, bounds, deck)
        _require_decks(given, given_decks, blocks)
        chosen = prelikon_cuts(cut, particulars.draught) | checked_cuts(cuts)
        before = all_of(notes, str, "notes", _WHERE)
        told = (
            *before,
            *prelikon_notes(
                cut, profile, bounds, given_curves, given_boxes, given_houses, given_hatches
            ),
        )
        return cls(
            particulars, cut, given_decks, bounds, given_boxes, given_houses, given_hatches,
            given_curves, profile, chosen, told,
        )  # fmt: skip

    @property
    def kind(self) -> str:
        """What its texts begin with."""
        return "PRELIKON"

    @property
    def deck(self) -> Deck | None:
        """The uppermost deck, at which sections end."""
        return upper_deck(self.decks)

    @property
    def knuckles(self) -> tuple[SpaceCurve, ...]:
        """The space curves at which all sections they pass have a corner: lines of the net."""
        return tuple(
            each for each in self.curves if section_contact(each, self.stations).is_knuckle
        )

    @property
    def appendages(self) -> tuple[Appendage, ...]:
        """The appendage boxes as `Hull.hydrostatics` takes them: whole, by their centroids."""
        return tuple(
            Appendage(each.name, each.volume, each.centroid, each.surface) for each in self.boxes
        )

    def volume_below(self, z: float) -> HullVolume:
        """Give the moulded volume below a height (m), without appendages, and its centre.

        Raises
        ------
        GeometryError
            A height that is no finite number.
        """
        return volume_below(self.stations, self.profile, float(finite_array(z, "draught", ())))

    def volume_to_deck(self) -> HullVolume:
        """Give the whole moulded volume, up to the cambered deck, and its centre."""
        return volume_to_deck(self.stations, self.profile, self.deck)

    def lines(self) -> tuple[LineSource, ...]:
        """Give profile, deck edge, flat ends, knuckle lines and sections.

        Raises
        ------
        GeometryError
            A deck whose sheer or camber does not reach as far as the hull.
        """
        return prelikon_lines(self.stations, self.profile, self.deck, self.knuckles)

    def bodies(self) -> tuple[AttachedBody, ...]:
        """Give boxes, camber, deck houses and hatches, as they stand beside a net."""
        boxes = [box_body(each, "boxes") for each in self.boxes]
        houses = [house_body(each, "deck houses") for each in self.houses]
        camber = [] if self.deck is None else [_camber(self.stations, self.deck)]
        hatches = [house_body(each, "hatches") for each in self.hatches]
        return (*boxes, *(each for each in camber if each is not None), *houses, *hatches)

    def report(self, state: HullState | None = None) -> ClassicalReport:
        """Give volumes and centres of hull, boxes and houses, beside those of a net of it."""
        given = None if state is None else instance(state, HullState, "state", "in a report")
        return prelikon_report(self, given)


def _camber(stations: Sequence[Station], deck: Deck) -> AttachedBody | None:
    """Make the camber of a deck between the first and the last section."""
    ends = np.array([trim_station(each, deck).curve.arcs.ends()[-1] for each in stations])
    x, half = np.array([each.x for each in stations]), np.maximum(ends[:, 0], 0.0)
    wide = np.maximum(half, 1e-9)[:, None]
    z = deck.at(x[:, None], half[:, None] * DECK_PARTS, np.broadcast_to(wide, (len(x), 1)))
    # The side as the section has it, to the last bit.
    z[:, [0, -1]] = ends[:, 1:]
    return camber_body(x, half, z)


def _require_decks(
    stations: Sequence[Station], decks: Sequence[Deck], houses: Sequence[DeckHouse]
) -> None:
    """Check that decks do not meet, and that they are wide enough for what stands on them."""
    if not decks:
        return
    x = np.array([each.x for each in stations])
    edges = {
        deck.number: np.array([
            trim_station(each, deck).curve.arcs.ends()[-1, 0] for each in stations
        ])
        for deck in decks
        if len(decks) > 1 or any(house.deck.number == deck.number for house in houses)
    }  # fmt: skip
    if len(decks) > 1:
        require_decks_apart(decks, x, np.min(list(edges.values()), axis=0))
    for house in houses:
        if house.deck.number not in edges:
            what = f"deck house: unknown deck {house.deck.number}"
            raise GeometryError(what, "give the deck to the ship", {"deck": house.deck.number})
        house.require_breadth(x, edges[house.deck.number])


# --------------------------------------------------------------------------------------
# Notes, and the planes that the net is cut by.

_REPORTED_TURN = 1e-4
"""Jumps of direction (rad) above this are reported."""


def prelikon_cuts(stations: Sequence[Station], draught: float) -> dict[str, tuple[float, ...]]:
    """Give heights of waterlines and half-breadths of buttocks where none are given, m."""
    top = min(float(each.curve.arcs.ends()[-1, 1]) for each in stations)
    wide = max(float(each.curve.joints()[:, 0].max()) for each in stations)
    heights = [part * draught for part in (0.15, 0.4, 0.7, 1.0)]
    heights.append(0.5 * (draught + top))
    return {
        "buttocks": tuple(part * wide for part in (0.25, 0.5, 0.75)),
        "waterlines": tuple(z for z in heights if z < top - SAME_PLACE),
    }


def checked_cuts(cuts: object) -> dict[str, tuple[float, ...]]:
    """Take heights of waterlines and half-breadths of buttocks as they are asked for, m.

    Raises GeometryError for another family of lines and for places that are no finite numbers.
    """
    if cuts is None:
        return {}
    if not isinstance(cuts, Mapping):
        what = f"the planes of a net are {shown(cuts)}"
        raise GeometryError(what, "give places by family of lines")
    found = {}
    for group, places in cuts.items():
        if group not in ("buttocks", "waterlines"):
            what = f"a net is not cut by {shown(group)}"
            raise GeometryError(what, "use one of buttocks, waterlines")
        found[group] = tuple(finite_array(places, group, (None,)).tolist())
    return found


def prelikon_notes(
    stations: Sequence[Station],
    profile: CentrelineProfile,
    boundaries: Sequence[ArcBoundary],
    curves: Sequence[SpaceCurve],
    boxes: Sequence[AppendageBox],
    houses: Sequence[DeckHouse],
    hatches: Sequence[DeckHouse] = (),
) -> tuple[str, ...]:
    """Report what the net leaves out, and how far that lies off the sections."""
    found = _joint_notes(stations)
    found += [note for each in curves if (note := _curve_notes(each, stations))]
    found += [_boundary_notes(each, stations) for each in boundaries if each.name not in ENDS]
    counts = {"appendage box": len(boxes), "deck house": len(houses), "hatch": len(hatches)}
    for name, count in counts.items():
        if count:
            plural = {"appendage box": "appendage boxes", "hatch": "hatches"}.get(name, f"{name}s")
            title = f"1 {name} is" if count == 1 else f"{count} {plural} are"
            found.append(f"{title} outlined beside the net")
    return tuple(found)


def _joint_notes(stations: Sequence[Station]) -> list[str]:
    """Report the corners between mean circles that the net passes smoothly."""
    passed = [
        abs(float(turn))
        for each in stations
        for joint, turn in zip(arc_joints(each.curve), each.curve.turns(), strict=True)
        if joint != ArcJoint.CORNER and abs(turn) > _REPORTED_TURN
    ]
    if not passed:
        return []
    most = digits(round(max(passed), 4))
    return [
        f"sections have {len(passed)} joints at which their direction jumps, by up to {most} rad: "
        "the net is smooth there"
    ]


def _curve_notes(curve: SpaceCurve, stations: Sequence[Station]) -> str:
    """Report a space curve that is no line of the net; empty where it is one."""
    contact = section_contact(curve, stations)
    title = f'space curve "{curve.name}" is not in the net'
    if contact.is_knuckle:
        return ""
    if contact.count < 2:
        return f"{title}: it passes {contact.count} section(s)"
    if contact.distance > SAME_PLACE:
        off = f"{digits(round(contact.distance, 4))} m at x={digits(contact.where)}"
        return f"{title}: it leaves the sections by up to {off}"
    return f"{title}: it lies on the sections, of which not all have a corner there"


def _boundary_notes(boundary: ArcBoundary, stations: Sequence[Station]) -> str:
    """Report how far a boundary curve in another plane lies off the sections."""
    title = f'boundary "{boundary.name}" is not in the net'
    worst, where = -1.0, np.nan
    for each in stations:
        given = boundary.curve.where(0, each.x)[:, 1]
        crossings = each.curve.where(0, boundary.y)[:, 1]
        if len(given) and len(crossings):
            off = float(np.abs(given[:, None] - crossings).min(axis=1).max())
            if off > worst:
                worst, where = off, each.x
    if worst < 0.0:
        return f"{title}: it passes no section"
    return (
        f"{title}: it leaves the sections by up to {digits(round(worst, 4))} m at x={digits(where)}"
    )


# --------------------------------------------------------------------------------------
# The report.

_STEP = 0.1
"""Distance (m) of the places of a section that are sought in the net."""


def prelikon_report(ship: Prelikon, state: HullState | None) -> ClassicalReport:
    """Give volumes and centres of hull, boxes and houses, beside those of a net if there is one."""
    hull, notes = with_net_figures(partial(_hull_figures, ship), state)
    figures = (*hull, *_box_figures(ship), *_house_figures(ship))
    away = () if state is None else departures(state, _defined_sections(ship))
    return ClassicalReport(ship.kind, ship.particulars.name, figures, (*ship.notes, *notes), away)


def _hull_figures(ship: Prelikon, state: HullState | None) -> list[ReportFigure]:
    draught = ship.particulars.draught
    side = min(float(each.curve.arcs.ends()[-1, 1]) for each in ship.stations)
    found = []
    for name, height in (("the draught", draught), ("the lowest deck side", side)):
        if height > side:
            continue
        # At the deck itself a closed deck would lie in the plane.
        net = None if state is None else measure_net(state, height - 1e-9)
        own = ship.volume_below(height)
        title = f"hull below {name} {height:g} m"
        found += _volume_figure(title, own, None if net is None else (net.volume, net.x, net.z))
    return [*found, *_volume_figure("hull to the deck, with camber", ship.volume_to_deck(), None)]


def _volume_figure(
    title: str, own: HullVolume, net: tuple[float, float, float] | None
) -> list[ReportFigure]:
    beside = (None, None, None) if net is None else net
    return [
        ReportFigure(f"{title}: volume", own.volume, "m3", beside[0], own.error),
        ReportFigure(f"{title}: centre x", own.x, "m", beside[1]),
        ReportFigure(f"{title}: centre z", own.z, "m", beside[2]),
    ]


def _box_figures(ship: Prelikon) -> list[ReportFigure]:
    found = []
    for each in ship.boxes:
        found.append(ReportFigure(f"{each.name}: volume", each.volume, "m3"))
        for axis, at in zip("xyz", each.centroid, strict=True):
            found.append(ReportFigure(f"{each.name}: centre {axis}", at, "m"))
    return found


def _house_figures(ship: Prelikon) -> list[ReportFigure]:
    found = []
    for each in (*ship.houses, *ship.hatches):
        found.append(ReportFigure(f"{each.name}: volume", each.volume, "m3"))
        found.append(ReportFigure(f"{each.name}: profile area", each.profile_area, "m2"))
        found.append(ReportFigure(f"{each.name}: centre x", each.centroid[0], "m"))
        found.append(ReportFigure(f"{each.name}: centre z", each.centroid[2], "m"))
    return found


def _defined_sections(ship: Prelikon) -> list[DefinedSection]:
    found = []
    for k, each in enumerate(ship.stations):
        yz = each.curve.sampled(_STEP)
        area = each.curve.moments_below(np.inf)[0]
        name = station_name(ship.stations, k, ship.profile.flat)
        found.append(DefinedSection(name, np.column_stack([np.full(len(yz), each.x), yz]), area))
    return found
