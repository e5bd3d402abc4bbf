"""A ship by main types: sections of lines and arcs, decks, boundaries, boxes and deck houses.

Source: the PRELIKON system in Kim & Chang, "Some Representations of Ship Hulls by Mathematical
Method for Design and Production", J. SNAK.

Examples
--------
>>> from assoc_hull.creation.classical.prelikon import Prelikon
>>> from assoc_hull.creation.classical.prelikon_stations import Station
>>> from assoc_hull.geometry.classical.arc_section import through_points
>>> from assoc_hull.model.state import Particulars
>>> bilge = through_points([(0, 0), (8, 0), (10, 2), (10, 9)], kind=["line", "arc", "line"],
...                        radius=[None, 2.0, None])
>>> body = Prelikon.make(Particulars("Body", 40, 20, 9, 6),
...                      [Station(x, bilge) for x in (0.0, 20.0, 40.0)])
>>> round(body.volume_below(6.0).volume, 6)
4731.327412
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Self

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.appendage import Appendage
from assoc_hull.arguments import all_of, instance
from assoc_hull.creation.classical.main_types import require_types
from assoc_hull.creation.classical.prelikon_lines import lies_on, lines_of
from assoc_hull.creation.classical.prelikon_notes import asked_cuts, default_cuts, notes_of
from assoc_hull.creation.classical.prelikon_profile import Profile, profile_of
from assoc_hull.creation.classical.prelikon_report import report_of
from assoc_hull.creation.classical.prelikon_stations import (
    Station,
    sorted_stations,
    trimmed,
    upper_deck,
)
from assoc_hull.creation.classical.prelikon_sums import Sum, volume_below, volume_to_deck
from assoc_hull.creation.classical.report import ClassicalReport
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.appendage_box import AppendageBox
from assoc_hull.geometry.classical.arc_boundary import ArcBoundary
from assoc_hull.geometry.classical.checks import finite
from assoc_hull.geometry.classical.deck_house import DeckHouse
from assoc_hull.geometry.classical.deck_surface import Deck, require_apart
from assoc_hull.geometry.classical.space_curve import SpaceCurve
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.state import HullState, Particulars

__all__ = ["Prelikon"]

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
    curves : tuple of SpaceCurve
        Space curves (9).
    profile : Profile
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
    curves: tuple[SpaceCurve, ...]
    profile: Profile
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
        given_curves = tuple(all_of(curves, SpaceCurve, "curves", _WHERE))
        types = {1, *([5] if given else []), *([8] if given_houses else [])}
        require_types(types | ({2, 3, 4} if given_decks else set()))
        if len(given) < 2:
            what = f"transverse sections: {len(given)} of them"
            raise GeometryError(what, "give two or more", {"count": len(given)})
        deck = upper_deck(given_decks)
        cut = tuple(trimmed(each, deck) for each in given)
        profile = profile_of(cut, bounds, deck)
        _require_decks(given, given_decks, given_houses)
        chosen = default_cuts(cut, particulars.draught) | asked_cuts(cuts)
        before = all_of(notes, str, "notes", _WHERE)
        told = (*before, *notes_of(cut, profile, bounds, given_curves, given_boxes, given_houses))
        return cls(
            particulars, cut, given_decks, bounds, given_boxes, given_houses, given_curves, profile,
            chosen, told,
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
        return tuple(each for each in self.curves if lies_on(each, self.stations).is_knuckle)

    @property
    def appendages(self) -> tuple[Appendage, ...]:
        """The appendage boxes as `ah.hydrostatics` takes them: whole, by their centroids."""
        return tuple(
            Appendage(each.name, each.volume, each.centroid, each.surface) for each in self.boxes
        )

    def volume_below(self, z: float) -> Sum:
        """Give the moulded volume below a height (m), without appendages, and its centre.

        Raises
        ------
        GeometryError
            A height that is no finite number.
        """
        return volume_below(self.stations, self.profile, float(finite(z, "draught", ())))

    def volume_to_deck(self) -> Sum:
        """Give the whole moulded volume, up to the cambered deck, and its centre."""
        return volume_to_deck(self.stations, self.profile, self.deck)

    def lines(self) -> tuple[LineSource, ...]:
        """Give profile, deck edge, flat ends, knuckle lines and sections.

        Raises
        ------
        GeometryError
            A deck whose sheer or camber does not reach as far as the hull.
        """
        return lines_of(self.stations, self.profile, self.deck, self.knuckles)

    def report(self, state: HullState | None = None) -> ClassicalReport:
        """Give volumes and centres of hull, boxes and houses, beside those of a net of it."""
        given = None if state is None else instance(state, HullState, "state", "in a report")
        return report_of(self, given)


def _require_decks(
    stations: Sequence[Station], decks: Sequence[Deck], houses: Sequence[DeckHouse]
) -> None:
    """Check that decks do not meet, and that they are wide enough for what stands on them."""
    if not decks:
        return
    x = np.array([each.x for each in stations])
    edges = {
        deck.number: np.array([
            trimmed(each, deck).curve.arcs.ends()[-1, 0] for each in stations
        ])
        for deck in decks
        if len(decks) > 1 or any(house.deck.number == deck.number for house in houses)
    }  # fmt: skip
    if len(decks) > 1:
        require_apart(decks, x, np.min(list(edges.values()), axis=0))
    for house in houses:
        if house.deck.number not in edges:
            what = f"deck house: unknown deck {house.deck.number}"
            raise GeometryError(what, "give the deck to the ship", {"deck": house.deck.number})
        house.require_breadth(x, edges[house.deck.number])
