"""A ship of portions (SFOLDS), each a row of sections given by ordinates.

`Sfolds` is the definition; x from AP, heights from the base line, m. Sections of its net pass all
given ordinates; where no planes are asked for, the net is cut on those that the widest section is
given on. Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design
and Production", J. SNAK.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Self

import attrs
import numpy as np

from assoc_hull.arguments import all_of, instance, not_negative, shown
from assoc_hull.creation.classical.bodies_beside import DECK_PARTS, camber_body, sections_body
from assoc_hull.creation.classical.line_outline import point_kinds_along
from assoc_hull.creation.classical.report import (
    ClassicalReport,
    DefinedSection,
    ReportFigure,
    departures,
    measure_net,
    with_net_figures,
)
from assoc_hull.creation.classical.sfolds_portion import Portion, require_portions_apart
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import digits, finite_array
from assoc_hull.geometry.classical.ordinate_section import OrdinateSection
from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind
from assoc_hull.model.attached_body import AttachedBody
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import HullState, Particulars

__all__ = [
    "AFT",
    "CORNER",
    "FORE",
    "PortionFrame",
    "Sfolds",
    "frame_line_name",
    "portion_frames",
    "section_points",
    "sfolds_cuts",
    "sfolds_lines",
    "sfolds_notes",
    "sfolds_report",
]

CORNER = 10.0
"""Degrees; sections of the net keep corners of the definition that are sharper."""


@attrs.frozen(eq=False)
class Sfolds:
    """A ship of portions.

    Attributes
    ----------
    particulars : Particulars
        Name and principal dimensions; x is counted from AP.
    portions : tuple of Portion
        As given.
    corner : float, degrees
        Sections of the net keep corners that are sharper; at 0 all of them.
    cuts : mapping of str to tuple of float, m
        Heights of waterlines, half-breadths of buttocks that the net is cut by.
    notes : tuple of str
        Gaps, what is odd about a section, what the net leaves out.
    """

    particulars: Particulars
    portions: tuple[Portion, ...]
    corner: float
    cuts: Mapping[str, tuple[float, ...]]
    notes: tuple[str, ...]

    @classmethod
    def make(
        cls,
        particulars: Particulars,
        portions: Sequence[Portion],
        *,
        corner: float = CORNER,
        cuts: Mapping[str, Sequence[float]] | None = None,
        notes: Sequence[str] = (),
    ) -> Self:
        """Put portions together.

        Parameters
        ----------
        particulars : Particulars
            Name and principal dimensions.
        portions : sequence of Portion
            In any order.
        corner : float, degrees
            As the attribute.
        cuts : mapping of str to sequence of float or None
            ``"waterlines"`` and ``"buttocks"``, m; those that the widest section is given on for
            what is left out.
        notes : sequence of str
            What to say beforehand.

        Raises
        ------
        GeometryError
            No portion, or portions of the main body that overlap.
        """
        instance(particulars, Particulars, "particulars", "in a ship of portions")
        given = tuple(all_of(portions, Portion, "portions", "in a ship of portions"))
        if not given:
            raise GeometryError("a ship of portions has none", "give one or more")
        angle = not_negative(corner, "corner", "in a ship of portions")
        gaps = require_portions_apart(given)
        chosen = sfolds_cuts(given, particulars.draught)
        chosen |= _checked_cuts(cuts)
        before = all_of(notes, str, "notes", "in a ship of portions")
        return cls(particulars, given, angle, chosen, (*before, *gaps, *sfolds_notes(given)))

    @property
    def kind(self) -> str:
        """What its texts begin with."""
        return "SFOLDS"

    @property
    def volume(self) -> float:
        """Sum of all portions, camber included, m3."""
        return float(sum(each.volume for each in self.portions))

    @property
    def centre(self) -> tuple[float, float]:
        """Of that volume: x from AP and z from base, m; nan for z where areas alone are given."""
        moments = [(each.moment_x, each.moment_z) for each in self.portions]
        x, z = (np.array(moments).sum(axis=0) / self.volume).tolist()
        return x, z

    def volume_below(self, z: float) -> float:
        """Give the volume of the main body below a height (m), without camber, m3.

        Raises
        ------
        GeometryError
            A portion of areas alone.
        """
        return float(sum(each.volume_below(z) for each in self.portions if each.is_main))

    def lines(self) -> tuple[LineSource, ...]:
        """Give the lines of the main body; see `sfolds_lines`.

        Raises
        ------
        GeometryError
            Portions of which no net can be made.
        """
        return sfolds_lines(self.portions, self.corner)

    def bodies(self) -> tuple[AttachedBody, ...]:
        """Give the portions that are bodies of their own and have sections; the camber."""
        portions = [each for each in self.portions if not each.is_main and each.sections]
        camber = _camber([each for each in self.portions if each.is_main and each.sections])
        return (*map(portion_body, portions), *(() if camber is None else (camber,)))

    def report(self, state: HullState | None = None) -> ClassicalReport:
        """Give volumes and centres of portions and of the whole, beside those of a net of it."""
        if state is not None:
            instance(state, HullState, "state", "in a report of portions")
        return sfolds_report(self, state)


def _checked_cuts(cuts: object) -> dict[str, tuple[float, ...]]:
    """Take the planes of the net by group; m."""
    found: dict[str, tuple[float, ...]] = {}
    if cuts is None:
        return found
    if not isinstance(cuts, Mapping):
        what = f"the planes of a net are {shown(cuts)}"
        raise GeometryError(what, "give places by group, as {'waterlines': (1.0, 2.0)}")
    for group, places in cuts.items():
        if group not in ("waterlines", "buttocks"):
            what = f"a net is not cut by {shown(group)}"
            raise GeometryError(what, "use waterlines or buttocks")
        found[group] = tuple(finite_array(places, group, (None,)).tolist())
    return found


# --------------------------------------------------------------------------------------
# Lines for the net. A portion is smooth along itself as the ordinates are; a section bends at every
# second of them, by a few degrees in a good table, and the spline of the kernel runs smoothly
# through. Only corners sharper than a limit stay corners.

AFT, FORE = "aft end", "fore end"
"""Lines that bound a hull where it ends flat."""

_SAME = 1e-6
"""Places (m) that differ by less are one."""

_PROFILE_CORNER = 30.0
"""Keel, stem and deck edge have a knuckle where chords turn by more than this, degrees."""

_PASSED = 1e-5
"""Lines pass the given points within this, m."""

_NO_CORNER = 1e-6
"""Degrees; a turn by no more is rounding."""

_BETWEEN = 3
"""Where corners stay, so many points are added to each step: areas are kept within 1e-5."""


@attrs.frozen(eq=False)
class PortionFrame:
    """A section of the main body where it stands."""

    x: float
    section: OrdinateSection

    @property
    def is_point(self) -> bool:
        """Whether it has no breadth: the hull ends there on its centre line."""
        return bool((self.section.outline()[:, 0] <= _SAME).all())


def portion_frames(portions: Sequence[Portion]) -> tuple[PortionFrame, ...]:
    """Give the sections of the main body from aft forward, those at joints once.

    Raises GeometryError for two portions with different sections where they join, and for a
    portion of areas alone.
    """
    main = sorted((each for each in portions if each.is_main), key=lambda each: each.stations[0])
    found: list[PortionFrame] = []
    for portion in main:
        if not portion.sections:
            what = f"portion {portion.number}: no sections, only areas"
            raise GeometryError(what, "give its sections", {"number": portion.number})
        for x, section in zip(portion.stations.tolist(), portion.sections, strict=True):
            if found and x - found[-1].x <= _SAME:
                _require_same(found[-1].section, section, x)
                continue
            found.append(PortionFrame(x, section))
    return tuple(found)


def _require_same(one: OrdinateSection, two: OrdinateSection, x: float) -> None:
    first, second = one.outline(), two.outline()
    if first.shape == second.shape and np.abs(first - second).max() <= _SAME:
        return
    what = f"sections of two portions differ at x={digits(x)}"
    remedy = "give the same section to both, or leave a step of a spacing between them"
    raise GeometryError(what, remedy, {"x": x})


def sfolds_lines(portions: Sequence[Portion], corner: float) -> tuple[LineSource, ...]:
    """Give profile, deck edge, flat ends and sections of the main body.

    Sections keep corners of the definition that are sharper than `corner` (degrees); at 0 all of
    them, with more points of its parabolas between. Raises GeometryError for fewer than two
    sections with a breadth, or one without between others.
    """
    frames = portion_frames(portions)
    wide = [frame for frame in frames if not frame.is_point]
    if len(wide) < 2:
        what = f"main body: {len(wide)} section(s) with a breadth"
        raise GeometryError(what, "give two or more", {"count": len(wide)})
    inner = [frame.x for frame in frames[1:-1] if frame.is_point]
    if inner:
        what = f"section at x={digits(inner[0])} has no breadth, and the hull goes on beyond"
        raise GeometryError(what, "give it a breadth, or end the hull there", {"x": inner[0]})
    found = [_profile(frames), _deck_edge(frames)]
    found += [
        _section(frame, corner, frame_line_name(frames, k))
        for k, frame in enumerate(frames)
        if not frame.is_point
    ]
    return tuple(found)


def frame_line_name(frames: Sequence[PortionFrame], index: int) -> str:
    """Give the name of the line that a section becomes; the first and the last are flat ends."""
    if index == 0:
        return AFT
    return FORE if index == len(frames) - 1 else f"ST {frames[index].x:g}"


def _profile(frames: Sequence[PortionFrame]) -> LineSource:
    """Run along the keel; up to the deck at ends without breadth."""
    keel = [[frame.x, 0.0, frame.section.keel] for frame in frames]
    if frames[0].is_point:
        keel.insert(0, [frames[0].x, 0.0, frames[0].section.hd])
    if frames[-1].is_point:
        keel.append([frames[-1].x, 0.0, frames[-1].section.hd])
    points = np.array(keel)
    kind, direction = point_kinds_along(points, _PROFILE_CORNER)
    return LineSource.make(
        "boundary", "profile", points, plane=((0.0, 1.0, 0.0), 0.0), boundary=BoundaryKind.END,
        kind=kind.tolist(), direction=direction, tolerance=_PASSED,
    )  # fmt: skip


def _deck_edge(frames: Sequence[PortionFrame]) -> LineSource:
    """Join the upper ends of the sections."""
    points = np.array([[frame.x, *frame.section.outline()[-1]] for frame in frames])
    kind, direction = point_kinds_along(points, _PROFILE_CORNER)
    plane = ((0.0, 0.0, 1.0), float(points[0, 2])) if np.ptp(points[:, 2]) <= 1e-9 else None
    return LineSource.make(
        "boundary", "deck edge", points, plane=plane, boundary=BoundaryKind.END,
        kind=kind.tolist(), direction=direction, tolerance=_PASSED,
    )  # fmt: skip


def _section(frame: PortionFrame, corner: float, name: str) -> LineSource:
    """Draw a section; where the hull ends flat it bounds the hull."""
    outline, kind = section_points(frame.section, corner)
    points = np.column_stack([np.full(len(outline), frame.x), outline])
    # Straight runs only: at 180 degrees nothing is a knuckle, those come from the section itself.
    straight, direction = point_kinds_along(points, 180.0)
    tangent = (straight == int(PointKind.TANGENT)) & (kind == int(PointKind.SMOOTH))
    kind = np.where(tangent, straight, kind)
    direction = np.where(tangent[:, None], direction, 0.0)
    plane = ((1.0, 0.0, 0.0), frame.x)
    if name in (AFT, FORE):
        return LineSource.make(
            "boundary", name, points, plane=plane, boundary=BoundaryKind.END, kind=kind.tolist(),
            direction=direction, tolerance=_PASSED,
        )  # fmt: skip
    return LineSource.make(
        "sections", name, points, plane=plane, kind=kind.tolist(),
        direction=direction, tolerance=_PASSED,
    )  # fmt: skip


def section_points(section: OrdinateSection, corner: float) -> tuple[FloatArray, IntArray]:
    """Give the points of a section, (n, 2) as y, z in m, and a `PointKind` each.

    `corner` (degrees) as for `sfolds_lines`.
    """
    steps = section.steps()
    before, after = (steps[:-1, 1] + 2.0 * steps[:-1, 2]), steps[1:, 1]
    across = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    turn = np.degrees(np.abs(np.arctan2(across, (before * after).sum(axis=1))))
    sharp = np.concatenate([[False], turn > max(corner, _NO_CORNER), [False]])
    kind = np.where(sharp, int(PointKind.KNUCKLE), int(PointKind.SMOOTH))
    if corner > 0.0:
        return section.outline(), kind
    count = _BETWEEN + 1
    u = np.arange(count)[:, None, None] / count
    c0, c1, c2 = steps.transpose(1, 0, 2)
    many = (c0 + u * (c1 + u * c2)).transpose(1, 0, 2).reshape(-1, 2)
    kinds = np.full(len(many) + 1, int(PointKind.SMOOTH))
    kinds[::count] = kind
    return np.concatenate([many, section.outline()[-1:]]), kinds


# --------------------------------------------------------------------------------------
# Planes that the net is cut by.

_MOST = 12
"""More lines of a family than this are thinned out."""

_APART = 0.05
"""No waterline is inserted at a draught that one is nearer to than this part of it."""


def sfolds_cuts(portions: Sequence[Portion], draught: float) -> dict[str, tuple[float, ...]]:
    """Give half-breadths of buttocks and heights of waterlines, m, by the widest section.

    Buttocks come first: where the bottom rises slowly, as at a broad stern, they run along it and
    waterlines turn sharply. So the net gets its shape there from the lines that are smooth.
    """
    sections = [each for portion in portions if portion.is_main for each in portion.sections]
    if not sections:
        return {"buttocks": (), "waterlines": ()}
    widest = max(sections, key=lambda each: each.area)
    top = min(each.hd for each in sections)
    heights = widest.side.places[1:]
    # The last given waterline may lie so near the deck that nothing is left between.
    heights = heights[heights < top - 0.25 * widest.sw]
    if draught < top and np.abs(heights - draught).min(initial=np.inf) > _APART * draught:
        heights = np.sort(np.append(heights, draught))
    return {
        "buttocks": _thinned_places(_buttocks(widest)),
        "waterlines": _thinned_places(heights.tolist()),
    }


def _buttocks(widest: OrdinateSection) -> list[float]:
    if widest.bottom is None:
        return [part * widest.deck_breadth for part in (0.25, 0.5, 0.75)]
    inside = widest.bottom.places <= widest.side.values[0] + 1e-9 * widest.sb
    return [float(y) for y in widest.bottom.places[inside][1:]]


def _thinned_places(places: Sequence[float]) -> tuple[float, ...]:
    return tuple(places[:: -(-len(places) // _MOST)] if places else ())


# --------------------------------------------------------------------------------------
# Bodies of their own, notes and report.

_AROUND = 48
"""Parts of the half outline of a section of a body of its own, up to the deck side."""

_TOP = 8
"""Parts of its half breadth at the top."""


def portion_body(portion: Portion) -> AttachedBody:
    """Give a portion that is a body of its own, as it stands beside a net."""
    rings = np.stack([_ring(each) for each in portion.sections])
    group = f"{portion.kind}s"
    return sections_body(portion.kind, group, portion.stations, rings, _ring_corners())


def _camber(portions: Sequence[Portion]) -> AttachedBody | None:
    """Make the camber of the main body, from its first section to its last."""
    stations = sorted(
        (
            (x, section)
            for each in portions
            for x, section in zip(each.stations.tolist(), each.sections, strict=False)
        ),
        key=lambda each: each[0],
    )
    if len(stations) < 2:
        return None
    half = np.array([section.bd for _, section in stations])
    z = np.array([section.camber(section.bd * DECK_PARTS) for _, section in stations])
    return camber_body(np.array([x for x, _ in stations]), half, z)


def _ring(section: OrdinateSection) -> FloatArray:
    """Give a closed section, (m, 2), m: up to port, over the top, down to starboard."""
    c0, c1, c2 = section.steps().transpose(1, 0, 2)
    u = (np.arange(_SAMPLES + 1) / _SAMPLES)[:, None, None]
    drawn = (c0 + u * (c1 + u * c2)).transpose(1, 0, 2).reshape(-1, 2)
    along = np.concatenate([[0.0], np.hypot(*np.diff(drawn, axis=0).T).cumsum()])
    at = np.linspace(0.0, along[-1], _AROUND + 1)
    side = np.column_stack([np.interp(at, along, drawn[:, axis]) for axis in range(2)])
    y = section.bd * (1.0 - np.arange(1, _TOP + 1) / _TOP)
    port = np.concatenate([side, np.column_stack([y, section.camber(y)])])
    return np.concatenate([port, port[-2:0:-1] * [-1.0, 1.0]])


def _ring_corners() -> tuple[int, ...]:
    """Where edges run along: the keel, the sides of the top."""
    return 0, _AROUND, _AROUND + 2 * _TOP


def sfolds_notes(portions: Sequence[Portion]) -> tuple[str, ...]:
    """Give what is odd about sections, once each, and what a net leaves out."""
    found, seen = [], set[int]()
    for portion in portions:
        for x, section in zip(portion.stations.tolist(), portion.sections, strict=False):
            if id(section) not in seen:
                seen.add(id(section))
                found += [
                    f"{n}, at x={digits(x)} of portion {portion.number}" for n in section.notes
                ]
    for portion in portions:
        if not portion.is_main:
            where = "is outlined beside the net" if portion.sections else "has no outline"
            found.append(
                f"portion {portion.number} ({portion.kind}) is a body of its own: its volume is "
                f"given here, and it {where}"
            )
    return tuple(found)


_SAMPLES = 16
"""Places on each step of a section that are sought in the net."""


def sfolds_report(ship: Sfolds, state: HullState | None) -> ClassicalReport:
    """Give volumes and centres of portions and of the whole, beside those of a net of them."""
    figures = [*_portion_figures(ship), *_whole_figures(ship)]
    notes: tuple[str, ...] = ()
    if any(each.is_main and each.sections for each in ship.portions):
        below, notes = with_net_figures(partial(_volumes_below, ship), state)
        figures += below
    away = () if state is None else departures(state, _defined_sections(ship))
    return ClassicalReport(
        ship.kind, ship.particulars.name, tuple(figures), (*ship.notes, *notes), away
    )


def _portion_figures(ship: Sfolds) -> list[ReportFigure]:
    found = []
    for number, each in enumerate(ship.portions, start=1):
        title = f"{number}. {each.kind}"
        found.append(ReportFigure(f"{title}: volume", each.volume, "m3"))
        if each.volume:
            found.append(ReportFigure(f"{title}: centre x", each.centre_x, "m"))
        if each.volume and each.sections:
            found.append(ReportFigure(f"{title}: centre z", each.centre_z, "m"))
    return found


def _whole_figures(ship: Sfolds) -> list[ReportFigure]:
    main = sum(each.volume for each in ship.portions if each.is_main)
    rest = [each.volume for each in ship.portions if not each.is_main]
    found = [ReportFigure("main body: volume, with camber", float(main), "m3")]
    if rest:
        found.append(ReportFigure("other bodies: volume", float(sum(rest)), "m3"))
    x, z = ship.centre if ship.volume else (np.nan, np.nan)
    found.append(ReportFigure("whole: volume, with camber", ship.volume, "m3"))
    named = (("x", x), ("z", z))
    found += [
        ReportFigure(f"whole: centre {axis}", at, "m") for axis, at in named if np.isfinite(at)
    ]
    return found


def _volumes_below(ship: Sfolds, state: HullState | None) -> list[ReportFigure]:
    """Give the volume of the main body below draught and deck, and that of the net."""
    main = [each for each in ship.portions if each.is_main]
    if not all(each.sections for each in main):
        return []
    deck = min(section.hd for each in main for section in each.sections)
    heights = {"the lowest deck side": deck}
    if ship.particulars.draught < deck:
        heights = {"the draught": ship.particulars.draught} | heights
    found = []
    for name, height in heights.items():
        # At the deck itself a closed deck would lie in the plane.
        net = None if state is None else measure_net(state, height - 1e-9)
        title = f"main body below {name} {height:g} m"
        volume = ship.volume_below(height)
        found.append(
            ReportFigure(f"{title}: volume", volume, "m3", None if net is None else net.volume)
        )
        if volume:
            x = sum(each.moment_x_below(height) for each in main) / volume
            found.append(ReportFigure(f"{title}: centre x", x, "m", None if net is None else net.x))
    return found


def _defined_sections(ship: Sfolds) -> list[DefinedSection]:
    frames = portion_frames(ship.portions)
    return [
        DefinedSection(
            frame_line_name(frames, k),
            _section_places(frame),
            frame.section.area_below(frame.section.hd) / 2,
        )
        for k, frame in enumerate(frames)
        if not frame.is_point
    ]


def _section_places(frame: PortionFrame) -> FloatArray:
    """Give places on the curve of a section, (n, 3), m."""
    c0, c1, c2 = frame.section.steps().transpose(1, 0, 2)
    u = (np.arange(_SAMPLES + 1) / _SAMPLES)[:, None, None]
    yz = (c0 + u * (c1 + u * c2)).transpose(1, 0, 2).reshape(-1, 2)
    return np.column_stack([np.full(len(yz), frame.x), yz])
