"""A ship by boundary data: no section is given, all are built from lines along the ship.

Contour and flat of bottom, waterlines, knuckle lines and the deck side are curves over x; where
a frame is asked for, they are cut and a section goes through. Over a parallel part the section is
the midship section, if there is one. Source: Kim & Chang, "Some Representations of Ship Hulls by
Mathematical Method for Design and Production", J. SNAK.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import all_of, instance
from assoc_hull.creation.classical.report import ClassicalReport
from assoc_hull.creation.classical.seaking_sections import MidshipSection, Section
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.appendage import Appendage
from assoc_hull.geometry.classical.camber import KINDS
from assoc_hull.geometry.classical.checks import figure, finite, inside
from assoc_hull.geometry.classical.choices import one_of
from assoc_hull.geometry.classical.frame import Frame
from assoc_hull.geometry.classical.keel_outline import KeelOutline
from assoc_hull.geometry.classical.knuckle_codes import KnuckleLine
from assoc_hull.geometry.classical.midship import Midship
from assoc_hull.geometry.classical.parallel_waterline import ParallelWaterline
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.model.source import LineSource
from assoc_hull.model.state import HullState, Particulars

__all__ = ["Attached", "DeckCamber", "Knuckle", "Parallel", "Seaking"]

_SAME = 1e-6
"""Places (m) that differ by less are one."""


_WHERE = "in a ship by boundary data"


def _of(kind: type) -> Callable[[object, attrs.Attribute[Any], object], None]:
    """Give a validator: a value of this class."""

    def look(_: object, field: attrs.Attribute[Any], value: object) -> None:
        instance(value, kind, field.name, _WHERE)

    return look


def _all_of(kind: type, name: str) -> Callable[[object], tuple[Any, ...]]:
    """Give a converter: values of this class as a tuple."""

    def take(given: object) -> tuple[Any, ...]:
        return tuple(all_of(given, kind, name, _WHERE))

    return take


def _place(given: object) -> float:
    return float(finite(given, "midship", ()))  # type: ignore[arg-type]


def _places(given: ArrayLike) -> FloatArray:
    return finite(given, "frames", (None,))


def _numbers(given: ArrayLike) -> tuple[float, ...]:
    if isinstance(given, tuple | list) and not given:
        return ()
    return tuple(finite(given, "buttocks", (None,)).tolist())


@attrs.frozen
class Knuckle:
    """A knuckle line: its name, and half-breadths and heights over x."""

    name: str = attrs.field(validator=_of(str))
    line: KnuckleLine = attrs.field(validator=_of(KnuckleLine))


@attrs.frozen
class Parallel:
    """A midship section, and from where to where (m) the ship has it."""

    section: Midship = attrs.field(validator=_of(Midship))
    first: float = attrs.field(converter=_place)
    last: float = attrs.field(converter=_place)


@attrs.frozen
class Attached:
    """An appendage: its name, and whether it is drawn on one side and stands on both."""

    name: str = attrs.field(validator=_of(str))
    body: Appendage = attrs.field(validator=_of(Appendage))
    both: bool = attrs.field(default=True, validator=_of(bool))

    @property
    def volume(self) -> float:
        """With its sign, of both sides, m3."""
        return (2.0 if self.both else 1.0) * self.body.volume


def _rows(given: ArrayLike) -> FloatArray:
    return finite(given, "deck", (None, 2))


@attrs.frozen(eq=False)
class DeckCamber:
    """Camber and rounded corners of the deck, in straight lines between given places.

    Attributes
    ----------
    rise : (n, 2), m
        Rows (x, c), c from the side to the centre line; empty for a deck straight across.
    kind : {"line", "parabola"}
        Of the camber.
    corner : (k, 2), m
        Rows (x, r), radii of the corner; empty for none. Beyond its ends there is none.
    """

    rise: FloatArray = attrs.field(factory=lambda: np.zeros((0, 2)), converter=_rows)
    kind: str = "parabola"
    corner: FloatArray = attrs.field(factory=lambda: np.zeros((0, 2)), converter=_rows)

    def __attrs_post_init__(self) -> None:
        freeze(self.rise, self.corner)
        one_of(self.kind, KINDS, "camber: kind")
        for rows, name in ((self.rise, "camber"), (self.corner, "corner radius")):
            if (np.diff(rows[:, 0]) <= 0.0).any():
                row = int(np.argmax(np.diff(rows[:, 0]) <= 0.0)) + 1
                what = f"{name}: x not strictly increasing at row {row}"
                raise GeometryError(what, "put the rows in order from aft", {"row": row})

    def at(self, x: float) -> tuple[float | None, float]:
        """Give rise (m; None without camber) and corner radius (m) at x (m)."""
        rise = float(np.interp(x, *self.rise.T)) if len(self.rise) else None
        if not len(self.corner) or not self.corner[0, 0] <= x <= self.corner[-1, 0]:
            return rise, 0.0
        return rise, float(np.interp(x, *self.corner.T))


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

    particulars: Particulars = attrs.field(validator=_of(Particulars))
    keel: KeelOutline = attrs.field(validator=_of(KeelOutline))
    waterlines: tuple[ParallelWaterline, ...] = attrs.field(
        converter=_all_of(ParallelWaterline, "waterlines")
    )
    deck: KnuckleLine = attrs.field(validator=_of(KnuckleLine))
    frames: FloatArray = attrs.field(converter=_places)
    parallel: Parallel | None = attrs.field(
        default=None, validator=attrs.validators.optional(_of(Parallel))
    )
    knuckles: tuple[Knuckle, ...] = attrs.field(default=(), converter=_all_of(Knuckle, "knuckles"))
    camber: DeckCamber = attrs.field(factory=DeckCamber, validator=_of(DeckCamber))
    appendages: tuple[Attached, ...] = attrs.field(
        default=(), converter=_all_of(Attached, "appendages")
    )
    buttocks: tuple[float, ...] = attrs.field(default=(), converter=_numbers)
    told: tuple[str, ...] = attrs.field(default=(), converter=_all_of(str, "told"))

    def __attrs_post_init__(self) -> None:
        freeze(self.frames)
        _check_heights(self.waterlines)
        _check_deck(self.deck, self.keel)
        _check_frames(self.frames, self.keel.ends)
        if self.parallel is not None:
            _check_parallel(self.parallel, self.deck, self.keel)

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
        return self.sections([x])[0]

    def sections(self, x: ArrayLike) -> list[Section]:
        """Build sections at places (n,), m; as `section`, with lines cut all at once."""
        place = inside(np.atleast_1d(np.asarray(x, np.float64)), "frame", *self.ends)
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
        return np.array([each.area(level) for each in self.sections(x)])

    def volume(self, draught: float | None = None) -> float:
        """Give the volume below a draught (m), m3, without appendages; whole if None.

        By quadrature over exact areas of sections; `report` states the error.
        """
        from assoc_hull.creation.classical.seaking_sums import sums

        return sums(self, [draught])[0].volume

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


def _check_heights(waterlines: Sequence[ParallelWaterline]) -> None:
    for one, other in itertools.pairwise(waterlines):
        if other.z - one.z <= _SAME:
            raise GeometryError(
                f"waterline z={figure(other.z)}: stands at or below the one before it",
                "give waterlines upward, each once", {"z": other.z},
            )  # fmt: skip


def _check_deck(deck: KnuckleLine, keel: KeelOutline) -> None:
    if deck.single:
        what = "deck side: has one column of values"
        raise GeometryError(what, "give half-breadths and heights", {})
    first, last = keel.ends
    if deck.ends[0] > first + _SAME or deck.ends[1] < last - _SAME:
        raise GeometryError(
            f"deck side: must cover [{figure(first)}, {figure(last)}]",
            "let it run as far as the contour", {"ends": deck.ends},
        )  # fmt: skip
    if (deck.v[:, 0] < 0.0).any():
        row = int(np.argmax(deck.v[:, 0] < 0.0))
        raise GeometryError(
            f"deck side: negative half-breadth at row {row}", "give 0 or more", {"row": row}
        )
    for x in (first, last):
        top, bottom = float(deck.at(x)[1]), float(keel.height(x))
        if top < bottom - _SAME:
            what = f"deck side: z={figure(top)} at x={figure(x)} lies below the contour"
            raise GeometryError(what, "raise it or lower the contour", {"x": x, "z": top})


def _check_frames(frames: FloatArray, ends: tuple[float, float]) -> None:
    finite(frames, "frames", (None,))
    step = np.diff(frames)
    if len(frames) < 2 or (step <= _SAME).any():
        row = int(np.argmax(step <= _SAME)) + 1 if len(frames) > 1 else 0
        what = f"frames: x not strictly increasing at row {row}"
        raise GeometryError(what, "give two frames or more, in order from aft", {"row": row})
    inside(frames, "frames", *ends)


def _check_parallel(parallel: Parallel, deck: KnuckleLine, keel: KeelOutline) -> None:
    first, last, half = parallel.first, parallel.last, parallel.section.half_breadth
    if not keel.x_a - _SAME <= first < last <= keel.x_b + _SAME:
        raise GeometryError(
            f"midship: its part [{figure(first)}, {figure(last)}] leaves the level keel",
            f"let it lie between {figure(keel.x_a)} and {figure(keel.x_b)}", {},
        )  # fmt: skip
    nodes = deck.x[(deck.x > first) & (deck.x < last)]
    for x in (first, *nodes.tolist(), last):
        y, z = deck.at(x).tolist()
        if abs(y - half) > _SAME:
            raise GeometryError(
                f"midship: the deck side at x={figure(x)} has y={figure(y)}, not a={figure(half)}",
                "let the deck side run parallel there", {"x": x, "y": y, "a": half},
            )  # fmt: skip
        if parallel.section.centre[1] > z:
            raise GeometryError(
                f"midship: bilge centre z={figure(parallel.section.centre[1])} above the side "
                f"height {figure(z)}", "give a smaller radius or rise", {"x": x, "D": z},
            )  # fmt: skip
