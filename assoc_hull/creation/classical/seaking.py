"""A ship by boundary data (SEAKING): no section is given, all are built from lines along the ship.

Contour and flat of bottom, waterlines, knuckle lines and the deck side are curves over x; where a
frame is asked for they are cut and a section goes through. Over a parallel part the section is the
midship section, if there is one. Source: Kim & Chang, "Some Representations of Ship Hulls by
Mathematical Method for Design and Production", J. SNAK.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import all_of
from assoc_hull.creation.classical.bodies_beside import lofted_body
from assoc_hull.creation.classical.line_outline import (
    CLOSE,
    OutlinePiece,
    PlaneOutline,
    smooth_piece,
    straight_piece,
)
from assoc_hull.creation.classical.report import (
    ClassicalReport,
    DefinedSection,
    ReportFigure,
    departures,
    measure_net,
)
from assoc_hull.creation.classical.seaking_parts import (
    WHERE,
    AttachedAppendage,
    DeckBlock,
    DeckCamber,
    Knuckle,
    MidshipSection,
    ParallelPart,
    SeakingSection,
    camber_of_deck,
    check_deck,
    check_frames,
    check_heights,
    check_parallel,
    half_area,
    instance_validator,
    section_outline,
    section_samples,
)
from assoc_hull.geometry.classical.boundary_lines import CodedKnuckleLine, KeelOutline
from assoc_hull.geometry.classical.checked_input import (
    bounded_height,
    digits,
    finite_array,
    within_range,
)
from assoc_hull.geometry.classical.circular_arcs import arc_area, arc_moment
from assoc_hull.geometry.classical.frame_section import FrameSection, Quadratics
from assoc_hull.geometry.classical.parallel_waterline import LevelPiece, ParallelWaterline
from assoc_hull.geometry.curves import FloatArray, PointKind, freeze
from assoc_hull.model.attached_body import AttachedBody
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import HullState, Particulars

__all__ = [
    "Seaking",
    "SeakingSums",
    "area_breaks",
    "corrugation",
    "frame_name",
    "seaking_lines",
    "seaking_notes",
    "seaking_report",
    "seaking_sums",
]


def _places(given: ArrayLike) -> FloatArray:
    return finite_array(given, "frames", (None,))


def _numbers(given: ArrayLike) -> tuple[float, ...]:
    if isinstance(given, tuple | list) and not given:
        return ()
    return tuple(finite_array(given, "buttocks", (None,)).tolist())


def _waterlines(given: object) -> tuple[ParallelWaterline, ...]:
    return tuple(all_of(given, ParallelWaterline, "waterlines", WHERE))


def _knuckles(given: object) -> tuple[Knuckle, ...]:
    return tuple(all_of(given, Knuckle, "knuckles", WHERE))


def _appendages(given: object) -> tuple[AttachedAppendage, ...]:
    return tuple(all_of(given, AttachedAppendage, "appendages", WHERE))


def _blocks(given: object) -> tuple[DeckBlock, ...]:
    return tuple(all_of(given, DeckBlock, "blocks", WHERE))


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
    deck : CodedKnuckleLine
        The deck side: half-breadths and heights over the length of the contour.
    frames : (n,), m
        Where frames stand.
    parallel : ParallelPart or None
        The midship section and its part of the ship.
    knuckles : tuple of Knuckle
        Further lines at which frames have a corner.
    camber : DeckCamber
        Of the deck.
    appendages : tuple of AttachedAppendage
        What is added to or taken from the hull.
    blocks : tuple of DeckBlock
        Hatches and deck houses.
    buttocks : tuple of float, m
        Where the net is cut.
    told : tuple of str
        Notes of whoever made it.
    """

    particulars: Particulars = attrs.field(validator=instance_validator(Particulars))
    keel: KeelOutline = attrs.field(validator=instance_validator(KeelOutline))
    waterlines: tuple[ParallelWaterline, ...] = attrs.field(converter=_waterlines)
    deck: CodedKnuckleLine = attrs.field(validator=instance_validator(CodedKnuckleLine))
    frames: FloatArray = attrs.field(converter=_places)
    parallel: ParallelPart | None = attrs.field(
        default=None, validator=attrs.validators.optional(instance_validator(ParallelPart))
    )
    knuckles: tuple[Knuckle, ...] = attrs.field(default=(), converter=_knuckles)
    camber: DeckCamber = attrs.field(factory=DeckCamber, validator=instance_validator(DeckCamber))
    appendages: tuple[AttachedAppendage, ...] = attrs.field(default=(), converter=_appendages)
    blocks: tuple[DeckBlock, ...] = attrs.field(default=(), converter=_blocks)
    buttocks: tuple[float, ...] = attrs.field(default=(), converter=_numbers)
    told: tuple[str, ...] = attrs.field(default=(), converter=_told)

    def __attrs_post_init__(self) -> None:
        freeze(self.frames)
        check_heights(self.waterlines)
        check_deck(self.deck, self.keel)
        for each in self.blocks:
            each.require_deck(self.deck)
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
        return seaking_notes(self)

    def section(self, x: float) -> SeakingSection:
        """Build the section at any x (m) of the hull.

        Raises
        ------
        GeometryError
            x beyond the ends; lines of which no frame can be made there.
        """
        return self.sections([float(finite_array(x, "frame", ()))])[0]

    def sections(self, x: ArrayLike) -> list[SeakingSection]:
        """Build sections at places (n,), m; as `section`, with lines cut all at once."""
        place = within_range(finite_array(x, "frame", (None,)), "frame", *self.ends)
        keel, flat, part = self.keel.height(place), self.keel.flat(place), self.keel.part(place)
        deck = self.deck.at(place)
        water = [_over(each.at, each.ends, place) for each in self.waterlines]
        knuckles = [_over(each.line.at, each.line.ends, place) for each in self.knuckles]
        heights = np.array([each.z for each in self.waterlines])
        table = np.array(water).reshape(len(heights), len(place))
        found: list[SeakingSection] = []
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
                FrameSection.make(
                    here, np.column_stack([table[there, i], heights[there]]), deck_side=deck[i],
                    keel=float(keel[i]), flat=float(flat[i]) if part[i] == 2 else None,
                    knuckles=np.array(corners).reshape(-1, 2), camber=rise,
                    camber_kind=self.camber.kind, corner_radius=radius,
                )
            )  # fmt: skip
        return found

    def areas(self, x: ArrayLike, level: float | None = None) -> FloatArray:
        """Give areas of sections, both sides, below a height (m), m2; whole if None."""
        height = None if level is None else bounded_height(level, "area")
        return np.array([each.area(height) for each in self.sections(x)])

    def volume(self, draught: float | None = None) -> float:
        """Give the volume below a draught (m), m3, without appendages; whole if None.

        By quadrature over exact areas of sections; `report` states the error.
        """
        height = None if draught is None else bounded_height(draught, "volume")
        return seaking_sums(self, [height])[0].volume

    def lines(self) -> tuple[LineSource, ...]:
        """Give frames, waterlines, profile, deck edge, knuckle lines, flat of bottom, transoms."""
        return seaking_lines(self)

    def bodies(self) -> tuple[AttachedBody, ...]:
        """Give appendages, camber, deck houses and hatches, as they stand beside a net."""
        hung = [
            lofted_body(each.name, each.body, each.both, "appendages") for each in self.appendages
        ]
        blocks = [each.body(self.deck, self.camber) for each in self.blocks]
        return (*hung, *camber_of_deck(self.deck, self.camber), *blocks)

    def report(self, state: HullState | None = None) -> ClassicalReport:
        """Give its own numbers, beside those of a net of it if one is handed in."""
        return seaking_report(self, state)


def _over(at: object, ends: tuple[float, float], place: FloatArray) -> FloatArray:
    """Give values of a line over x where it reaches, nan elsewhere."""
    there = (place >= ends[0]) & (place <= ends[1])
    found = at(np.clip(place, *ends))  # type: ignore[operator]
    found = np.array(found, np.float64)
    found[~there] = np.nan
    return found


# --------------------------------------------------------------------------------------
# Volumes. The curve of areas has corners wherever a line has a point, begins or ends, or where the
# keel passes a waterline. Between these places it is smooth, and two rules of Gauss show how far
# it is off; where they differ too much the interval is halved.

_LESS, _MORE = np.polynomial.legendre.leggauss(4), np.polynomial.legendre.leggauss(7)
"""Nodes and weights of the two rules."""

_ABOVE = 1e6
"""A height (m) above any ship."""

_ENOUGH = 1e-8
"""Each interval is halved until it is off by no more than this part of the whole."""

_HALVINGS = 8

_SAME_BREAK = 1e-9
"""Places of corners (m) that differ by less are one."""


@attrs.frozen
class SeakingSums:
    """Integrals of the part of a hull below a height, both sides, without appendages.

    Attributes
    ----------
    volume : float, m3
        Its volume.
    x, z : float, m
        Its centre.
    waterplane : float, m2
        Area at the height; 0 if all of the hull was asked for.
    error : float, m3
        How far the volume may be off: the sum over intervals of what two rules differ by.
    """

    volume: float
    x: float
    z: float
    waterplane: float
    error: float


def seaking_sums(ship: Seaking, levels: Sequence[float | None]) -> tuple[SeakingSums, ...]:
    """Integrate below heights (m), None for the whole, decks included.

    Sections are built once for all heights.
    """
    heights = [_ABOVE if each is None else float(each) for each in levels]
    places = area_breaks(ship, heights)
    low, high = places[:-1], places[1:]
    total, error = np.zeros((len(heights), 4)), np.zeros(len(heights))
    whole = np.zeros(len(heights))
    for turn in range(_HALVINGS + 1):
        fine, coarse = (_gauss_rule(ship, low, high, heights, each) for each in (_MORE, _LESS))
        off = np.abs(fine[..., 0] - coarse[..., 0])
        # Later turns hold halved intervals only: the first sum stays the whole.
        whole = np.maximum(whole, fine[..., 0].sum(axis=0))
        done = (off <= _ENOUGH * whole).all(axis=1) | (turn == _HALVINGS)
        total += fine[done].sum(axis=0)
        error += off[done].sum(axis=0)
        if done.all():
            break
        middle = 0.5 * (low + high)[~done]
        low, high = (
            np.concatenate([low[~done], middle]), np.concatenate([middle, high[~done]])
        )  # fmt: skip
    return tuple(
        SeakingSums(
            float(volume), float(x / volume) if volume else 0.0,
            float(z / volume) if volume else 0.0, 0.0 if level is None else float(plane),
            float(doubt),
        )
        for (volume, x, z, plane), doubt, level in zip(total, error, levels, strict=True)
    )  # fmt: skip


def _gauss_rule(
    ship: Seaking, low: FloatArray, high: FloatArray, levels: Sequence[float],
    rule: tuple[FloatArray, FloatArray],
) -> FloatArray:  # fmt: skip
    """Integrate area, its moments over x and z, and breadth over each interval, (n, levels, 4)."""
    node, weight = rule
    half = 0.5 * (high - low)
    place = (0.5 * (low + high)[:, None] + half[:, None] * node).ravel()
    built = ship.sections(place)
    values = np.empty((len(place), len(levels), 4))
    for number, level in enumerate(levels):
        values[:, number] = _measured_sections(built, level)
    values[..., 1] *= values[..., 0]
    values[..., 3] = 2.0 * np.nan_to_num(values[..., 3])
    shape = (len(low), len(weight), len(levels), 4)
    summed = np.einsum("nklc,k->nlc", values.reshape(shape), weight)
    return np.asarray(summed * half[:, None, None])


def _measured_sections(built: Sequence[SeakingSection], level: float) -> FloatArray:
    """Give area, x, moment and half-breadth of each section below a level, (n, 4).

    Pieces of all frames go through at once.
    """
    found = np.empty((len(built), 4))
    frames = [i for i, each in enumerate(built) if isinstance(each, FrameSection)]
    for i, each in enumerate(built):
        # A midship section is no run of such pieces: it measures itself.
        if not isinstance(each, FrameSection):
            found[i] = each.area(level), each.x, each.moment(level), each.half_breadth(level)
    if not frames:
        return found
    chosen = [each for each in built if isinstance(each, FrameSection)]
    # A deck straight across adds nothing: along it z does not change.
    parts = [[each.side] if each.deck is None else [each.side, each.deck] for each in chosen]
    joined = Quadratics.join([part for several in parts for part in several])
    count = np.array([sum(len(part) for part in several) for several in parts])
    first = np.cumsum(count) - count
    # Twice: the pieces are of one side.
    area, moment = (2.0 * np.add.reduceat(each, first) for each in joined.each_below(level))
    # `fmax` passes over nan, which stands where a piece does not come to the level.
    widest = np.fmax.reduceat(np.fmax.reduce(joined.crossings(level), axis=1), first)
    for i, each in enumerate(chosen):
        # The arc is no quadratic: it comes by itself, between side and deck.
        if each.corner is not None:
            arc, centre = each.corner.arc(), each.corner.centre
            area[i] += 2.0 * arc_area(arc, centre, level)
            moment[i] += 2.0 * arc_moment(arc, centre, level)
    found[frames] = np.column_stack([area, [each.x for each in chosen], moment, widest])
    return found


def area_breaks(ship: Seaking, levels: Sequence[float]) -> FloatArray:
    """Give the places (m) at which the curve of areas below heights (m) is not smooth."""
    first, last = ship.ends
    keel = ship.keel
    lines = [keel.aft, keel.forward]
    found = [
        np.array([first, last, keel.x_a, keel.x_b]), keel.aft[:, 0], keel.forward[:, 0],
        keel.tangent[:, 0], ship.deck.x, ship.camber.rise[:, 0], ship.camber.corner[:, 0],
        *(each.points[:, 0] for each in ship.waterlines),
        *(each.line.x for each in ship.knuckles),
    ]  # fmt: skip
    if ship.parallel is not None:
        found.append(np.array([ship.parallel.first, ship.parallel.last]))
    heights = np.array([*(each.z for each in ship.waterlines), *levels])
    found += [_level_intersections(line, heights) for line in lines]
    places = np.unique(np.concatenate(found))
    places = places[(places >= first) & (places <= last)]
    return np.asarray(places[np.append(True, np.diff(places) > _SAME_BREAK)])


def _level_intersections(line: FloatArray, heights: FloatArray) -> FloatArray:
    """Give x where straight pieces of a contour (n, 2) pass heights."""
    (x, z), (v, w) = line[:-1].T, line[1:].T
    with np.errstate(divide="ignore", invalid="ignore"):
        part = (heights[:, None] - z) / (w - z)
    inside = np.isfinite(part) & (part > 0.0) & (part < 1.0)
    return np.asarray((x + part * (v - x))[inside])


# --------------------------------------------------------------------------------------
# Lines for the net. Points of the definition are points of lines. Frames are smooth from knuckle to
# knuckle; contour and straight intervals of knuckle lines keep their corners; waterlines follow the
# definition's splines closely, their parallel part is straight. Flat ends are transoms.

_SAME_POINT = 1e-6
"""Places (m) that differ by less are one."""

_DENSE = 4
"""Chords between two points of a waterline."""

_CLEAR = 0.05
"""Points of a line over x that are closer (m) to given ones are left out."""

_EVEN = 1e-3
"""Tolerance (m) of lines that are smooth through points."""


def frame_name(x: float) -> str:
    """Give the name of the section at x (m).

    Examples
    --------
    >>> from assoc_hull.creation.classical.seaking import frame_name
    >>> frame_name(12.5)
    'FR 12.5'
    """
    return f"FR {x:g}"


def seaking_lines(ship: Seaking) -> tuple[LineSource, ...]:
    """Give all lines of a definition: boundaries, transoms, sections, waterlines."""
    first, last = ship.ends
    ends = [x for x in (first, last) if float(ship.deck.at(x)[0]) > _SAME_POINT]
    inner = ship.frames[(ship.frames > first + _SAME_POINT) & (ship.frames < last - _SAME_POINT)]
    sections = [
        section_outline(each).section(
            frame_name(each.x),
            each.x,
            tolerance=CLOSE if isinstance(each, MidshipSection) else _EVEN,
        )
        for each in ship.sections(inner)
    ]
    transoms = [
        section_outline(ship.section(x)).boundary("transom" if x == first else "fore end", 0, x)
        for x in ends
    ]
    waterlines = [_waterline(each) for each in ship.waterlines]
    along = [_profile(ship), *_flat_of_bottom(ship)]
    along.append(_space_line("deck edge", ship.deck, BoundaryKind.END, ship.frames))
    along += [
        _space_line(each.name, each.line, BoundaryKind.KNUCKLE, ship.frames)
        for each in ship.knuckles
    ]
    return (*along, *transoms, *sections, *waterlines)


def _profile(ship: Seaking) -> LineSource:
    """Run from the transom, or the deck, along the keel to the stem head."""
    rows = np.concatenate([ship.keel.aft, ship.keel.forward])
    (half, top), (breadth, head) = ship.deck.at(ship.ends).tolist()
    # Below a flat end the contour has nothing to draw: that is the middle of the transom.
    rows = rows[_lowest_row(rows, ship.ends[0]) if half > _SAME_POINT else 0 :]
    rows = rows[: _lowest_row(rows, ship.ends[1]) + 1 if breadth > _SAME_POINT else len(rows)]
    if half <= _SAME_POINT and top > rows[0, 1] + _SAME_POINT:
        rows = np.concatenate([[(ship.ends[0], top)], rows])
    if breadth <= _SAME_POINT and head > rows[-1, 1] + _SAME_POINT:
        rows = np.concatenate([rows, [(ship.ends[1], head)]])
    pieces = [straight_piece(a, b) for a, b in itertools.pairwise(rows)]
    return PlaneOutline.of(pieces).boundary("profile", 1, 0.0)


def _lowest_row(rows: FloatArray, x: float) -> int:
    """Give the row of a contour that stands lowest at an end."""
    there = np.flatnonzero(np.abs(rows[:, 0] - x) <= _SAME_POINT)
    return int(there[rows[there, 1].argmin()])


def _space_line(
    name: str, line: CodedKnuckleLine, kind: BoundaryKind, frames: FloatArray
) -> LineSource:
    """Give a line over x: corners at steps and at the ends of straight intervals.

    On parabolas it has a point at each frame as well: frames end there.
    """
    rows: list[tuple[float, FloatArray, bool]] = []
    # Codes of intervals: 0 a step, 1 straight, above 1 a parabola; only those are smooth at ends.
    hard = np.concatenate([[True], line.code <= 1, [True]])
    for i, x in enumerate(line.x.tolist()):
        if i and line.code[i - 1] == 0 and x > line.x[i - 1]:
            rows.append((x, line.v[i - 1], True))
        rows.append((x, line.v[i], bool(hard[i] or hard[i + 1])))
        if i < len(line.code) and line.code[i] > 1:
            inner = frames[(frames > x + _CLEAR) & (frames < line.x[i + 1] - _CLEAR)]
            rows += [(each, line.at(each), False) for each in inner.tolist()]
    points = np.array([[x, *v] for x, v, _ in rows])
    corner = np.array([each for *_, each in rows])
    step = np.diff(points, axis=0)
    step /= np.linalg.norm(step, axis=1)[:, None]
    # Straight intervals in one line need no corner between them.
    corner[1:-1] &= np.einsum("ij,ij->i", step[1:], step[:-1]) <= 1.0 - 1e-14
    corner[[0, -1]] = False
    kinds = np.where(corner, int(PointKind.KNUCKLE), 0).tolist()
    return LineSource.make("boundary", name, points, boundary=kind, kind=kinds, tolerance=_EVEN)


def _flat_of_bottom(ship: Seaking) -> list[LineSource]:
    """Give the edge of the flat of bottom, if there is one."""
    keel = ship.keel
    inner = keel.tangent[(keel.tangent[:, 0] > keel.x_a) & (keel.tangent[:, 0] < keel.x_b)]
    ends = [(x, float(keel.flat(x))) for x in (keel.x_a, keel.x_b)]
    rows = np.concatenate([ends[:1], inner, ends[1:]])
    if not (rows[:, 1] > _SAME_POINT).any():
        return []
    pieces = [straight_piece(a, b) for a, b in itertools.pairwise(rows)]
    parallel = ship.parallel
    # A rise of floor makes the edge of the flat a corner.
    risen = parallel is not None and parallel.section.rise > 0.0
    kind = BoundaryKind.KNUCKLE if risen else BoundaryKind.FLAT
    return [PlaneOutline.of(pieces).boundary("flat of bottom", 2, 0.0, kind=kind)]


def _waterline(line: ParallelWaterline) -> LineSource:
    """Give a waterline by points between those given, straight where it is parallel."""
    pieces: list[OutlinePiece] = []
    for each in line.pieces:
        if isinstance(each, LevelPiece):
            level = each.half_breadth
            pieces.append(straight_piece((each.first, level), (each.last, level)))
            continue
        given = line.points[
            (line.points[:, 0] >= each.first - _SAME_POINT)
            & (line.points[:, 0] <= each.last + _SAME_POINT),
            0,
        ]
        x = _intermediate_places(given)
        points = np.column_stack([x, line.at(x)])
        angles = np.arctan(each.of(x[[0, -1]], 1))
        pieces.append(smooth_piece(points, float(angles[0]), float(angles[1])))
    return PlaneOutline.of(pieces).waterline(f"WL {line.z:g}", line.z, tolerance=_EVEN)


def _intermediate_places(x: FloatArray) -> FloatArray:
    part = np.arange(_DENSE) / _DENSE
    return np.append((x[:-1, None] + np.diff(x)[:, None] * part).ravel(), x[-1])


# --------------------------------------------------------------------------------------
# Notes and report.

_NOTED_DISTANCE = 1e-3
"""A waterline that lies farther (m) than this from the midship section is reported."""


def seaking_notes(ship: Seaking) -> tuple[str, ...]:
    """Say of a definition what is odd, and what its net leaves out, a sentence each."""
    built = ship.sections(ship.frames)
    of_frames = [each for section in built for each in section.notes]
    return (
        *ship.told, *ship.keel.notes, *_midship_notes(ship), *_grouped_notes(of_frames),
        *corrugation(built), *_omission_notes(ship),
    )  # fmt: skip


def corrugation(sections: list[SeakingSection]) -> tuple[str, ...]:
    """Report the largest tangent jump of frames that are built of parabolas, if there are any."""
    built = [each for each in sections if isinstance(each, FrameSection)]
    if not built:
        return ()
    worst = max(built, key=lambda each: each.largest_jump)
    return (
        f"frames are continuous only: their direction jumps by up to "
        f"{digits(round(worst.largest_jump, 4))} rad at given points (frame x={digits(worst.x)})",
    )


def _grouped_notes(notes: list[str]) -> list[str]:
    """Let notes that differ in the frame only stand once, with their number."""
    parted: dict[str, list[str]] = {}
    for each in notes:
        what = each.partition(": ")[2].partition(" at z=")[0].partition(" (")[0]
        parted.setdefault(what, []).append(each)
    return [
        several[0] if len(several) == 1 else f"{several[0]} (and {len(several) - 1} more like it)"
        for several in parted.values()
    ]


def _midship_notes(ship: Seaking) -> list[str]:
    """Report waterlines and the edge of the flat that miss the midship section, and knuckles."""
    if ship.parallel is None:
        return []
    first, last = ship.parallel.first, ship.parallel.last
    found = []
    for line in ship.waterlines:
        x = np.clip([first, 0.5 * (first + last), last], *line.ends)
        wanted = float(ship.parallel.section.half_breadths(line.z))
        away = float(np.abs(line.at(x) - wanted).max())
        if away > _NOTED_DISTANCE:
            found.append(
                f"{line.name}: lies up to {1e3 * away:.1f} mm off the midship section over its "
                "parallel part"
            )
    inner = np.append(ship.keel.tangent[:, 0], [first, last])
    inner = inner[(inner >= first) & (inner <= last)]
    section = ship.parallel.section
    flat = section.flat if section.rise else section.floor_point[0]
    away = float(np.abs(ship.keel.flat(inner) - flat).max())
    if away > _NOTED_DISTANCE:
        found.append(
            f"bottom tangent line: lies up to {1e3 * away:.1f} mm off the edge of the flat of "
            "the midship section"
        )
    found += [
        f"knuckle line {each.name!r}: is not looked at between x={digits(first)} and "
        f"{digits(last)}, where the midship section stands"
        for each in ship.knuckles
        if each.line.ends[0] < last and each.line.ends[1] > first
    ]
    return found


def _omission_notes(ship: Seaking) -> list[str]:
    """Report what the net does not hold."""
    found = []
    if len(ship.camber.rise) or len(ship.camber.corner):
        found.append(
            "camber and rounded corners of the deck are not in the net: it ends at the deck side; "
            "the camber stands beside it"
            if len(ship.camber.rise)
            else "rounded corners of the deck are not in the net: it ends at the deck side"
        )
    steps = ship.deck.x[1:][ship.deck.code == 0].tolist()
    if steps:
        found.append(
            f"deck side: it steps at x={', '.join(map(digits, steps))}; near there the net is "
            "rough above the lower deck"
        )
    if ship.appendages:
        names = ", ".join(each.name for each in ship.appendages)
        found.append(f"appendages are outlined beside the net: {names}")
    if ship.blocks:
        names = ", ".join(each.name for each in ship.blocks)
        found.append(f"hatches and deck houses are outlined beside the net: {names}")
    return found


def seaking_report(ship: Seaking, state: HullState | None) -> ClassicalReport:
    """Measure a definition, and a net of it if one is handed in.

    Volumes and centres are without appendages; theirs stand below, with their sign.
    """
    draught = ship.particulars.draught
    wet, whole = seaking_sums(ship, [draught, None])
    net = None if state is None else measure_net(state, draught)
    built = ship.sections(ship.frames)
    areas = np.array([each.area(draught) for each in built])
    largest = int(areas.argmax())
    worst = max(built, key=lambda each: each.largest_jump)
    at = f"below {draught:g} m"
    own = (wet.volume, wet.x, wet.z, wet.waterplane)
    nets = (None,) * 4 if net is None else (net.volume, net.x, net.z, net.area)
    names = (
        (f"volume {at}", "m3", wet.error), (f"centre of volume {at}, x", "m", None),
        (f"centre of volume {at}, z", "m", None), (f"waterplane area at {draught:g} m", "m2", None),
    )  # fmt: skip
    figures = [
        ReportFigure(name, value, unit, beside, error)
        for (name, unit, error), value, beside in zip(names, own, nets, strict=True)
    ]
    figures += [
        ReportFigure(f"largest frame area {at}", float(areas[largest]), "m2"),
        ReportFigure(f"largest frame area {at}, x", float(ship.frames[largest]), "m"),
        ReportFigure("volume with its decks", whole.volume, "m3", None, whole.error),
        ReportFigure("largest tangent jump of a frame", worst.largest_jump, "rad"),
        ReportFigure("largest tangent jump of a frame, x", worst.x, "m"),
    ]
    for each in ship.appendages:
        figures.append(ReportFigure(f"volume of {each.name}", each.volume, "m3"))
        if each.volume:
            x, _, z = (part / each.body.volume for part in each.body.moment)
            figures += [
                ReportFigure(f"centre of {each.name}, x", x, "m"),
                ReportFigure(f"centre of {each.name}, z", z, "m"),
            ]
    for body in (each.body(ship.deck, ship.camber) for each in ship.blocks):
        figures.append(ReportFigure(f"volume of {body.name}", body.volume, "m3"))
    away = () if state is None else departures(state, _defined_sections(ship))
    return ClassicalReport(
        ship.kind, ship.particulars.name, tuple(figures), ship.notes, away
    )  # fmt: skip


def _defined_sections(ship: Seaking) -> list[DefinedSection]:
    """Give the frames between the ends as the definition has them."""
    first, last = ship.ends
    inner = ship.frames[(ship.frames > first) & (ship.frames < last)]
    return [
        DefinedSection(
            frame_name(each.x), np.insert(section_samples(each), 0, each.x, axis=1), half_area(each)
        )
        for each in ship.sections(inner)
    ]
