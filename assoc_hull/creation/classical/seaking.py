"""A ship by boundary data: no section is given, all are built from lines along the ship.

Contour and flat of bottom, waterlines, knuckle lines and the deck side are curves over x; where
a frame is asked for, they are cut and a section goes through. Over a parallel part the section is
the midship section, if there is one. Source: Kim & Chang, "Some Representations of Ship Hulls by
Mathematical Method for Design and Production", J. SNAK.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import all_of
from assoc_hull.creation.classical.report import ClassicalReport
from assoc_hull.creation.classical.seaking_checks import (
    check_deck,
    check_frames,
    check_heights,
    check_parallel,
)
from assoc_hull.creation.classical.seaking_parts import (
    WHERE,
    Attached,
    DeckCamber,
    Knuckle,
    Parallel,
    is_a,
)
from assoc_hull.creation.classical.seaking_sections import MidshipSection, Section
from assoc_hull.geometry.classical.checks import finite, inside
from assoc_hull.geometry.classical.choices import height_of
from assoc_hull.geometry.classical.frame import Frame
from assoc_hull.geometry.classical.keel_outline import KeelOutline
from assoc_hull.geometry.classical.knuckle_codes import KnuckleLine
from assoc_hull.geometry.classical.parallel_waterline import ParallelWaterline
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.state import HullState, Particulars

__all__ = ["Seaking"]


def _places(given: ArrayLike) -> FloatArray:
    return finite(given, "frames", (None,))


def _numbers(given: ArrayLike) -> tuple[float, ...]:
    if isinstance(given, tuple | list) and not given:
        return ()
    return tuple(finite(given, "buttocks", (None,)).tolist())


def _waterlines(given: object) -> tuple[ParallelWaterline, ...]:
    return tuple(all_of(given, ParallelWaterline, "waterlines", WHERE))


def _knuckles(given: object) -> tuple[Knuckle, ...]:
    return tuple(all_of(given, Knuckle, "knuckles", WHERE))


def _appendages(given: object) -> tuple[Attached, ...]:
    return tuple(all_of(given, Attached, "appendages", WHERE))


def _told(given: object) -> tuple[str, ...]:
    return tuple(all_of(given, str, "told", WHERE))


@attrs.frozen(eq=False, kw_only=True)
class Seaking:
    """A ship by boundary data; x forward from AP, y outward, z up from the base line, m.

    Attributes
    ----------
    particulars : Particulars
        Name and principal dimensions.
    keel : KeelOutline
        Contour, level keel, flat of bottom.
    waterlines : tuple of ParallelWaterline
        At ascending heights.
    deck : KnuckleLine
        The deck side: half-breadths and heights over the length of the contour.
    frames : (n,), m
        Where frames stand.
    parallel : Parallel or None
        The midship section and its part of the ship.
    knuckles : tuple of Knuckle
        Further lines at which frames have a corner.
    camber : DeckCamber
        Of the deck.
    appendages : tuple of Attached
        What is added to or taken from the hull.
    buttocks : tuple of float, m
        Where the net is cut.
    told : tuple of str
        Notes of whoever made it.
    """

    particulars: Particulars = attrs.field(validator=is_a(Particulars))
    keel: KeelOutline = attrs.field(validator=is_a(KeelOutline))
    waterlines: tuple[ParallelWaterline, ...] = attrs.field(converter=_waterlines)
    deck: KnuckleLine = attrs.field(validator=is_a(KnuckleLine))
    frames: FloatArray = attrs.field(converter=_places)
    parallel: Parallel | None = attrs.field(
        default=None, validator=attrs.validators.optional(is_a(Parallel))
    )
    knuckles: tuple[Knuckle, ...] = attrs.field(default=(), converter=_knuckles)
    camber: DeckCamber = attrs.field(factory=DeckCamber, validator=is_a(DeckCamber))
    appendages: tuple[Attached, ...] = attrs.field(default=(), converter=_appendages)
    buttocks: tuple[float, ...] = attrs.field(default=(), converter=_numbers)
    told: tuple[str, ...] = attrs.field(default=(), converter=_told)

    def __attrs_post_init__(self) -> None:
        freeze(self.frames)
        check_heights(self.waterlines)
        check_deck(self.deck, self.keel)
        check_frames(self.frames, self.keel.ends)
        if self.parallel is not None:
            check_parallel(self.parallel, self.deck, self.keel)

    @property
    def kind(self) -> str:
        """The first word of its text."""
        return "SEAKING"

    @property
    def cuts(self) -> Mapping[str, Sequence[float]]:
        """The buttocks of the net."""
        return {"buttocks": self.buttocks}

    @property
    def ends(self) -> tuple[float, float]:
        """From where to where the hull reaches, m."""
        return self.keel.ends

    @property
    def notes(self) -> tuple[str, ...]:
        """What was moved, left out, looks odd or is not in the net."""
        from assoc_hull.creation.classical.seaking_notes import notes_of

        return notes_of(self)

    def section(self, x: float) -> Section:
        """Build the section at any x (m) of the hull.

        Raises
        ------
        GeometryError
            x beyond the ends; lines of which no frame can be made there.
        """
        return self.sections([float(finite(x, "frame", ()))])[0]

    def sections(self, x: ArrayLike) -> list[Section]:
        """Build sections at places (n,), m; as `section`, with lines cut all at once."""
        place = inside(finite(x, "frame", (None,)), "frame", *self.ends)
        keel, flat, part = self.keel.height(place), self.keel.flat(place), self.keel.part(place)
        deck = self.deck.at(place)
        water = [_over(each.at, each.ends, place) for each in self.waterlines]
        knuckles = [_over(each.line.at, each.line.ends, place) for each in self.knuckles]
        heights = np.array([each.z for each in self.waterlines])
        table = np.array(water).reshape(len(heights), len(place))
        found: list[Section] = []
        for i, here in enumerate(place.tolist()):
            rise, radius = self.camber.at(here)
            if self.parallel is not None and self.parallel.first <= here <= self.parallel.last:
                midship, depth = self.parallel.section, float(deck[i, 1])
                kind = self.camber.kind
                found.append(MidshipSection.make(here, midship, depth, rise, kind, radius))
                continue
            there = np.isfinite(table[:, i])
            corners = [each[i] for each in knuckles if np.isfinite(each[i]).all()]
            found.append(
                Frame.make(
                    here, np.column_stack([table[there, i], heights[there]]), deck_side=deck[i],
                    keel=float(keel[i]), flat=float(flat[i]) if part[i] == 2 else None,
                    knuckles=np.array(corners).reshape(-1, 2), camber=rise,
                    camber_kind=self.camber.kind, corner_radius=radius,
                )
            )  # fmt: skip
        return found

    def areas(self, x: ArrayLike, level: float | None = None) -> FloatArray:
        """Give areas of sections, both sides, below a height (m), m2; whole if None."""
        height = None if level is None else height_of(level, "area")
        return np.array([each.area(height) for each in self.sections(x)])

    def volume(self, draught: float | None = None) -> float:
        """Give the volume below a draught (m), m3, without appendages; whole if None.

        By quadrature over exact areas of sections; `report` states the error.
        """
        from assoc_hull.creation.classical.seaking_sums import sums

        height = None if draught is None else height_of(draught, "volume")
        return sums(self, [height])[0].volume

    def lines(self) -> tuple[LineSource, ...]:
        """Give frames, waterlines, profile, deck edge, knuckle lines, flat of bottom, transoms."""
        from assoc_hull.creation.classical.seaking_lines import lines_of

        return lines_of(self)

    def report(self, state: HullState | None = None) -> ClassicalReport:
        """Give its own numbers, beside those of a net of it if one is handed in."""
        from assoc_hull.creation.classical.seaking_report import report_of

        return report_of(self, state)


def _over(at: object, ends: tuple[float, float], place: FloatArray) -> FloatArray:
    """Take values of a line where it reaches, nan elsewhere."""
    there = (place >= ends[0]) & (place <= ends[1])
    found = at(np.clip(place, *ends))  # type: ignore[operator]
    found = np.array(found, np.float64)
    found[~there] = np.nan
    return found
