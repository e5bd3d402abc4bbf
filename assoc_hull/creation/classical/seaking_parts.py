"""What a ship by boundary data (SEAKING) is made of, and its sections.

Its parts besides keel and waterlines are knuckles, parallel part, appendages and deck camber. A
section is a frame or, over the parallel part, the midship section. x forward from AP, y outward,
z up from the base line, m.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any, Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import instance
from assoc_hull.creation.classical.bodies_beside import (
    ACROSS,
    DECK_PARTS,
    block_body,
    camber_body,
)
from assoc_hull.creation.classical.line_outline import PlaneOutline, smooth_piece, straight_piece
from assoc_hull.creation.classical.middle_body import Midship, midship_outline
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.appendages import LoftedAppendage
from assoc_hull.geometry.classical.boundary_lines import CodedKnuckleLine, KeelOutline
from assoc_hull.geometry.classical.camber import KINDS
from assoc_hull.geometry.classical.checked_input import (
    bounded_height,
    digits,
    finite_array,
    one_of,
    within_range,
)
from assoc_hull.geometry.classical.circular_arcs import arc_area, arc_moment
from assoc_hull.geometry.classical.frame_section import (
    DeckCorner,
    FrameSection,
    Quadratics,
    deck_corner,
    deck_pieces,
)
from assoc_hull.geometry.classical.parallel_waterline import ParallelWaterline
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.model.attached_body import AttachedBody

__all__ = [
    "WHERE",
    "AttachedAppendage",
    "DeckBlock",
    "DeckCamber",
    "Knuckle",
    "MidshipSection",
    "ParallelPart",
    "SeakingSection",
    "camber_of_deck",
    "check_deck",
    "check_frames",
    "check_heights",
    "check_parallel",
    "half_area",
    "instance_validator",
    "section_outline",
    "section_samples",
]


WHERE = "in a ship by boundary data"
"""Where errors of type say that they occurred."""


def instance_validator(kind: type) -> Callable[[object, attrs.Attribute[Any], object], None]:
    """Give a validator: the value of a field is of this class."""

    def look(_: object, field: attrs.Attribute[Any], value: object) -> None:
        instance(value, kind, field.name, WHERE)

    return look


def _place(given: object) -> float:
    return float(finite_array(given, "midship", ()))  # type: ignore[arg-type]


@attrs.frozen
class Knuckle:
    """A knuckle line: its name, and half-breadths and heights over x."""

    name: str = attrs.field(validator=instance_validator(str))
    line: CodedKnuckleLine = attrs.field(validator=instance_validator(CodedKnuckleLine))


@attrs.frozen
class ParallelPart:
    """A midship section, and from where to where (m) the ship has it."""

    section: Midship = attrs.field(validator=instance_validator(Midship))
    first: float = attrs.field(converter=_place)
    last: float = attrs.field(converter=_place)


@attrs.frozen
class AttachedAppendage:
    """An appendage: its name, and whether it is drawn on one side and stands on both."""

    name: str = attrs.field(validator=instance_validator(str))
    body: LoftedAppendage = attrs.field(validator=instance_validator(LoftedAppendage))
    both: bool = attrs.field(default=True, validator=instance_validator(bool))

    @property
    def volume(self) -> float:
        """With its sign, of both sides, m3."""
        return (2.0 if self.both else 1.0) * self.body.volume


_LOOKED = 33
"""Places along a block or a deck, ends among them; no block may be broader than its deck there."""


@attrs.frozen
class DeckBlock:
    """A hatch or a deck house: its foot follows the deck, its sides are upright.

    Attributes
    ----------
    name, group : str
        What it is called; ``"hatches"`` or ``"deck houses"``.
    first, last : float, m
        From where to where it stands.
    breadth, height : float, m
        Over both sides; of its sides, above the deck.
    rise : float, m
        Camber of its top, from its sides up to the centre line, of the kind of the deck's.
    """

    name: str
    group: str
    first: float
    last: float
    breadth: float
    height: float
    rise: float = 0.0

    def __attrs_post_init__(self) -> None:
        sizes = (
            ("length", self.last - self.first),
            ("breadth", self.breadth),
            ("height", self.height),
        )
        for word, value in sizes:
            if not value > 0.0:
                what = f"{self.name}: {word} {digits(value)}"
                raise GeometryError(what, "give one above 0", {word: value})

    def require_deck(self, deck: CodedKnuckleLine) -> None:
        """Check that it stands on the deck; raises GeometryError with what is there."""
        low, high = deck.ends
        for word, x in (("from", self.first), ("to", self.last)):
            if not low <= x <= high:
                what = f"{self.name}: {word} is x={digits(x)}, where no deck is"
                raise GeometryError(what, f"give {digits(low)} to {digits(high)}", {"x": x})
        places = np.linspace(self.first, self.last, _LOOKED)
        wide = 2.0 * deck.at(places)[:, 0]
        k = int(wide.argmin())
        if wide[k] < self.breadth * (1.0 - 1e-12):
            at, most = float(places[k]), float(wide[k])
            told = {"breadth": self.breadth, "x": at, "deck_breadth": most}
            broad = f"{self.name}: breadth {digits(self.breadth)}"
            what = f"{broad} exceeds the deck breadth at x={digits(at)}"
            raise GeometryError(what, f"give at most {digits(most)}", told)

    def body(self, deck: CodedKnuckleLine, camber: DeckCamber) -> AttachedBody:
        """Make its outlines on a deck."""
        inner = deck.x[(deck.x > self.first) & (deck.x < self.last)]
        x = np.union1d(np.linspace(self.first, self.last, _LOOKED), inner)
        y = np.linspace(-0.5 * self.breadth, 0.5 * self.breadth, ACROSS)
        side = deck.at(x)
        rise = np.array([camber.at(each)[0] or 0.0 for each in x.tolist()])
        half = np.maximum(side[:, 0], 0.5 * self.breadth)
        foot = side[:, 1:] + rise[:, None] * _crown(y / half[:, None], camber.kind)
        top = foot[:, :1] + self.height + self.rise * _crown(y / (0.5 * self.breadth), camber.kind)
        return block_body(self.name, self.group, x, foot, np.broadcast_to(top, foot.shape), y)


def camber_of_deck(deck: CodedKnuckleLine, camber: DeckCamber) -> tuple[AttachedBody, ...]:
    """Make the camber of a deck as a body beside the net, if it has any; corners are not rounded.

    Along the ship it is taken where deck side and camber have their points, and between.
    """
    if not len(camber.rise):
        return ()
    low, high = deck.ends
    knots = np.concatenate([deck.x, camber.rise[:, 0]])
    inner = knots[(knots > low) & (knots < high)]
    x = np.union1d(np.linspace(low, high, _LOOKED), inner)
    side, rise = deck.at(x), np.interp(x, *camber.rise.T)
    z = side[:, 1:] + rise[:, None] * _crown(DECK_PARTS, camber.kind)
    found = camber_body(x, side[:, 0], z)
    return () if found is None else (found,)


def _crown(part: FloatArray, kind: str) -> FloatArray:
    """Give camber at parts of the half-breadth, as a part of its rise."""
    return np.asarray(1.0 - (part * part if kind == "parabola" else np.abs(part)))


def _rows(given: ArrayLike) -> FloatArray:
    return finite_array(given, "deck", (None, 2))


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


# --------------------------------------------------------------------------------------
# Sections.

_DRAWN = 64
"""Chords that a bilge is drawn by for a comparison."""


@attrs.frozen
class MidshipSection:
    """The midship section where the ship is parallel.

    Attributes
    ----------
    x : float, m
        Where it stands.
    midship : Midship
        Its shape.
    depth : float, m
        Height of the deck side.
    deck : Quadratics or None
        Camber; None of a deck straight across.
    corner : DeckCorner or None
        Between side and deck.
    """

    x: float
    midship: Midship
    depth: float
    deck: Quadratics | None
    corner: DeckCorner | None

    @classmethod
    def make(
        cls, x: float, midship: Midship, depth: float, rise: float | None = None,
        kind: str = "parabola", radius: float = 0.0,
    ) -> Self:  # fmt: skip
        """Put a deck with a rise (m; None without) and a corner radius (m, 0 without) on it.

        Raises
        ------
        GeometryError
            ``"frame x={x}: corner radius {r} does not fit"``.
        """
        instance(midship, Midship, "midship", "in a section")
        given = (depth, radius, x, 0.0 if rise is None else rise)
        height, round_off, place, crown = (bounded_height(each, "frame") for each in given)
        top, corner = np.array([midship.half_breadth, height]), None
        if round_off:
            name = f"frame x={digits(place)}"
            corner = deck_corner(
                midship.half_breadth, height, crown, round_off, kind=kind, name=name
            )
            if corner.side_point[1] < midship.centre[1]:
                what = f"{name}: corner radius {digits(round_off)} does not fit"
                raise GeometryError(what, "give a smaller radius", {"r": round_off})
        one_of(kind, KINDS, "camber: kind")
        bare = rise is None and corner is None
        deck = None if bare else deck_pieces(top, crown, kind, corner)
        return cls(place, midship, height, deck, corner)

    @property
    def largest_jump(self) -> float:
        """0 rad: the corners that it has are meant."""
        return 0.0

    @property
    def notes(self) -> tuple[str, ...]:
        """There are none."""
        return ()

    def area(self, level: float | None = None) -> float:
        """Give the area of both sides below a height (m), m2; all of it if None."""
        height = math.inf if level is None else level
        found = self.midship.area(min(max(height, 0.0), self._side))
        if self.corner is not None:
            found += 2.0 * arc_area(self.corner.arc(), self.corner.centre, height)
        return found + (0.0 if self.deck is None else 2.0 * self.deck.area_below(height))

    def moment(self, level: float) -> float:
        """Give the moment of that area about the base, m3."""
        found = self.midship.moment(min(max(level, 0.0), self._side))
        if self.corner is not None:
            found += 2.0 * arc_moment(self.corner.arc(), self.corner.centre, level)
        return found + (0.0 if self.deck is None else 2.0 * self.deck.moment_below(level))

    @property
    def _side(self) -> float:
        """Height (m) up to which the side is upright: the deck side, or where the corner begins."""
        return self.depth if self.corner is None else self.corner.side_point[1]

    def half_breadth(self, level: float) -> float:
        """Give the half-breadth at a height (m), m; nan where it has none."""
        if not 0.0 <= level <= self.depth:
            return math.nan
        return float(self.midship.half_breadths(level))


SeakingSection = FrameSection | MidshipSection
"""Either kind."""


def section_outline(section: SeakingSection) -> PlaneOutline:
    """Give a section from the centre line to the deck side as the net draws it.

    Its given points are points of the line, corners are knuckles; a flat of bottom is left
    horizontally. Between points the kernel's smooth curve runs in the place of parabolas.
    """
    if isinstance(section, MidshipSection):
        return midship_outline(section.midship, section.depth)
    pieces = [straight_piece((0.0, 0.0), (section.flat, 0.0))]
    for number, run in enumerate(section.runs):
        level = number == 0 and section.level_start
        if len(run.points) == 2 and not level:
            pieces.append(straight_piece(*run.points))
        else:
            pieces.append(smooth_piece(run.points, start=0.0 if level else None))
    return PlaneOutline.of(pieces)


def section_samples(section: SeakingSection) -> FloatArray:
    """Give points close together on the definition's curve, (n, 2), m."""
    if isinstance(section, FrameSection):
        return section.drawn()
    outline = midship_outline(section.midship, section.depth)
    bilge = section.midship.bilge()
    if bilge is None:
        return outline.points
    along = np.linspace(0.0, float(bilge.length[0]), _DRAWN + 1)
    return np.concatenate([outline.points, bilge.at(np.zeros(len(along), np.int64), along)])


def half_area(section: SeakingSection) -> float:
    """Give the area of one side up to the deck side, without camber and corner, m2."""
    if isinstance(section, MidshipSection):
        return 0.5 * section.midship.area(section.depth)
    return section.side_area


# --------------------------------------------------------------------------------------
# Checks of what must go together.

_SAME = 1e-6
"""Places (m) that differ by less are one."""


def check_heights(waterlines: Sequence[ParallelWaterline]) -> None:
    """Refuse waterlines that do not stand one above the other."""
    for one, other in pairwise(waterlines):
        if other.z - one.z <= _SAME:
            raise GeometryError(
                f"waterline z={digits(other.z)}: stands at or below the one before it",
                "give waterlines upward, each once", {"z": other.z},
            )  # fmt: skip


def check_deck(deck: CodedKnuckleLine, keel: KeelOutline) -> None:
    """Refuse a deck side that is too short, of negative half-breadth or below the keel's ends."""
    if deck.single:
        what = "deck side: has one column of values"
        raise GeometryError(what, "give half-breadths and heights", {})
    first, last = keel.ends
    if deck.ends[0] > first + _SAME or deck.ends[1] < last - _SAME:
        raise GeometryError(
            f"deck side: must cover [{digits(first)}, {digits(last)}]",
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
            what = f"deck side: z={digits(top)} at x={digits(x)} lies below the contour"
            raise GeometryError(what, "raise it or lower the contour", {"x": x, "z": top})


def check_frames(frames: FloatArray, ends: tuple[float, float]) -> None:
    """Refuse frames that are out of order or beyond the ends."""
    finite_array(frames, "frames", (None,))
    step = np.diff(frames)
    if len(frames) < 2 or (step <= _SAME).any():
        row = int(np.argmax(step <= _SAME)) + 1 if len(frames) > 1 else 0
        what = f"frames: x not strictly increasing at row {row}"
        raise GeometryError(what, "give two frames or more, in order from aft", {"row": row})
    within_range(frames, "frames", *ends)


def check_parallel(parallel: ParallelPart, deck: CodedKnuckleLine, keel: KeelOutline) -> None:
    """Refuse a midship section off the level keel, or of another breadth than the deck side."""
    first, last, half = parallel.first, parallel.last, parallel.section.half_breadth
    if not keel.x_a - _SAME <= first < last <= keel.x_b + _SAME:
        raise GeometryError(
            f"midship: its part [{digits(first)}, {digits(last)}] leaves the level keel",
            f"let it lie between {digits(keel.x_a)} and {digits(keel.x_b)}", {},
        )  # fmt: skip
    nodes = deck.x[(deck.x > first) & (deck.x < last)]
    for x in (first, *nodes.tolist(), last):
        y, z = deck.at(x).tolist()
        if abs(y - half) > _SAME:
            raise GeometryError(
                f"midship: the deck side at x={digits(x)} has y={digits(y)}, not a={digits(half)}",
                "let the deck side run parallel there", {"x": x, "y": y, "a": half},
            )  # fmt: skip
        if parallel.section.centre[1] > z:
            raise GeometryError(
                f"midship: bilge centre z={digits(parallel.section.centre[1])} above the side "
                f"height {digits(z)}", "give a smaller radius or rise", {"x": x, "D": z},
            )  # fmt: skip
